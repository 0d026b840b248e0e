"""What the tests of documents use: the rows of a text, and the values of its sides."""

from __future__ import annotations

from typing import Any

from derive.audit.auditing import Audit, audited, claims_of
from derive.documents.choices import readings
from derive.documents.layout import Document, read_document
from derive.documents.meaning import Meaning
from derive.documents.source import Format, source_of


def document(text: str, kind: Format = Format.MARKDOWN) -> Document:
    return read_document(source_of(text, kind, "worked.md"))


def values(text: str) -> list[tuple[str, str]]:
    """Return both sides of each claim of a text, as SymPy prints them."""
    claims, facts, unread = claims_of(document(text))
    assert unread == []
    return [(value(claim.left, facts), value(claim.right, facts)) for claim in claims]


def value(node: Any, facts: Any) -> str:
    return str(Meaning(facts).of(readings(node, facts)[0][0]))


def audit(text: str, kind: Format = Format.MARKDOWN) -> Audit:
    return audited(document(text, kind))


def outcomes(text: str) -> list[str]:
    return [str(claim.verdict.outcome) for claim in audit(text).claims if claim.verdict is not None]
