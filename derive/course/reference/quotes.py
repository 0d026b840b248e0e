"""Quotations of a document in its own letters, and remarks on claims that cannot be compared as formulas."""

from __future__ import annotations

import re
from dataclasses import asdict, dataclass
from typing import Any

from derive.course.schema import TEXT, Reader, wrong_type
from derive.course.yaml_tree import Scalar, Tree, Word
from derive.errors import Faults

LAST_LINE = 99_999


@dataclass(frozen=True)
class Remark:
    """A claim of the document that is wrong, right by luck, incomplete or not a formula.

    part    the part of the document, if stated
    line    the line of the document, if stated
    quote   what the document prints: prose with formulas between dollar signs
    why     a comment on the claim: prose with formulas between dollar signs
    """

    part: str | None
    line: int | None
    quote: str
    why: str

    def to_data(self) -> dict[str, Any]:
        return asdict(self)


def _line(node: Tree, name: str, faults: Faults) -> int | None:
    if isinstance(node, Scalar) and re.fullmatch(r"[1-9]\d{0,4}", node.text, re.ASCII):
        return int(node.text)
    wrong_type(faults, f"`{name}`", f"the number of a line, from 1 to {LAST_LINE}", node)
    return None


def _quotation(node: Tree, name: str, faults: Faults) -> Word | None:
    text = TEXT.read(node, name, faults)
    if text is None:
        return None
    if (why := unquotable(text)) is not None:
        faults.error("quotation", f"`{name}`: {why}", node.place)
        return None
    return text


def unquotable(text: str) -> str | None:
    """Return why a text cannot be quoted; None if it can be quoted."""
    from derive.course.latex.quoting import Unquotable, quoted  # needed by few files

    try:
        quoted(text)
    except Unquotable as error:
        return str(error)
    return None


LINE = Reader({"type": "integer", "minimum": 1, "maximum": LAST_LINE}, _line)
QUOTATION = Reader({"type": "string", "pattern": r"\S"}, _quotation)
