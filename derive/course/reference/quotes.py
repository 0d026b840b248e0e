"""Quotations from a document, and remarks on claims that cannot be compared as formulas."""

from __future__ import annotations

import re
from dataclasses import asdict, dataclass
from typing import Any

from derive.course.schema import TEXT, Reader, one_or_more, wrong_type
from derive.course.yaml_tree import Scalar, Sequence, Tree, Word
from derive.errors import Faults, Place

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


@dataclass(frozen=True)
class Lines:
    """The lines of a document that an entry cites: ranges of lines, or the number of a section such as `0.2.1`."""

    ranges: tuple[tuple[int, int], ...]
    section: str
    place: Place


_RANGE = re.compile(r"([1-9]\d{0,4})(?:\s*-\s*([1-9]\d{0,4}))?", re.ASCII)
_SECTION = re.compile(r"\d+(\.\d+)+", re.ASCII)
_WANTED_LINES = "a line, a range such as `123-130`, a list of these, or a section such as `0.2.1`"


def _lines(node: Tree, name: str, faults: Faults) -> Lines | None:
    items = node.items if isinstance(node, Sequence) else (node,)
    texts = [item.text.strip() if isinstance(item, Scalar) else "" for item in items]
    if len(texts) == 1 and _SECTION.fullmatch(texts[0]):
        return Lines((), texts[0], node.place)
    found = [_RANGE.fullmatch(text) for text in texts]
    ranges = [(int(each[1]), int(each[2] or each[1])) for each in found if each]
    odd = next((item for item, each in zip(items, found, strict=True) if not each), None)
    odd = odd or next((item for item, (first, last) in zip(items, ranges, strict=True) if last < first), None)
    if odd is not None or not items:
        wrong_type(faults, f"`{name}`", _WANTED_LINES, odd or node)
        return None
    return Lines(tuple(ranges), "", node.place)


def _sides(node: Tree, name: str, faults: Faults) -> tuple[int, ...] | None:
    items = node.items if isinstance(node, Sequence) else (node,)
    texts = [item.text.strip() if isinstance(item, Scalar) else "" for item in items]
    if texts and all(re.fullmatch(r"[1-9]\d?", text, re.ASCII) for text in texts):
        return tuple(map(int, texts))
    wrong_type(faults, f"`{name}`", "the number of a side (the first is 1), or a list of them", node)
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
    from derive.course.latex.quoting import Unquotable, quoted  # imported here because few files need it

    try:
        quoted(text)
    except Unquotable as error:
        return str(error)
    return None


LINE = Reader({"type": "integer", "minimum": 1, "maximum": LAST_LINE}, _line)
_ONE_OR_MORE_LINES = {"type": ["integer", "string"], "pattern": r"^[0-9][0-9. -]*$"}
LINES = Reader(one_or_more(_ONE_OR_MORE_LINES), _lines)
SIDES = Reader(one_or_more({"type": "integer", "minimum": 1, "maximum": 99}), _sides, tuple)
QUOTATION = Reader({"type": "string", "pattern": r"\S"}, _quotation)
