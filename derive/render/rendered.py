"""A solved and printed problem as data, which a worker process returns to its parent, and which builds store.

The data contain only text and numbers, so JSON can store them.
"""

from __future__ import annotations

import base64
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from typing import Any

from derive.errors import Complaint, Place

Files = tuple[tuple[str, bytes], ...]
SourceFault = tuple[str, str, str, str, str]


class Html(str):
    """HTML that templates print unchanged; any other text that an HTML template prints is escaped."""


class Tex(str):
    """TeX that templates print unchanged; any other text that a TeX template prints is escaped."""


@dataclass(frozen=True)
class Rendered:
    """One problem, solved and printed in the requested formats.

    texts                   the page in each format, by the name of the format
    latex, sheet, report    fragments for documents: the solution, the questions alone, and how the solution was checked
    source                  a fragment of the report: errata of the source document, and remarks on it
    html, title_html        the solution and its title, for a page in a browser
    card_html               the statement and its first drawing, for the list of the problems of a set
    documents               fragments of the other requested documents, in TeX by name and in HTML by `name.html`
    counts                  the counts of the checks of the problem, see `Checks.counts`
    steps, compared         the number of steps, and the number of compared statements of the reference and of remarks
    source_faults           errata of the source and remarks on it, each as five texts: the kind, the line, what is
                            printed, what is right (for an erratum), and the reason
    """

    id: str
    detail: str
    title: str
    points: str
    texts: dict[str, str]
    latex: Tex
    title_latex: Tex
    sheet: Tex
    report: Tex
    source: Tex
    html: Html
    title_html: Html
    card_html: Html
    warnings: tuple[Complaint, ...]
    inputs: tuple[str, ...]
    grades: dict[str, int]
    counts: dict[str, int]
    steps: int
    compared: int
    agreed: bool
    files: Files = ()
    documents: dict[str, str] = field(default_factory=dict)
    source_faults: tuple[SourceFault, ...] = ()

    def to_data(self) -> dict[str, Any]:
        files = [[name, base64.b64encode(content).decode()] for name, content in self.files]
        return {**asdict(self), "files": files}

    @classmethod
    def from_data(cls, data: Any) -> Rendered | None:
        """Return the problem from the data of `to_data`; None if the data have a different structure."""
        try:
            return cls(
                id=_text(data["id"]),
                detail=_text(data["detail"]),
                title=_text(data["title"]),
                points=_text(data["points"]),
                texts={_text(name): _text(page) for name, page in dict(data["texts"]).items()},
                latex=Tex(_text(data["latex"])),
                title_latex=Tex(_text(data["title_latex"])),
                sheet=Tex(_text(data["sheet"])),
                report=Tex(_text(data["report"])),
                source=Tex(_text(data["source"])),
                html=Html(_text(data["html"])),
                title_html=Html(_text(data["title_html"])),
                card_html=Html(_text(data["card_html"])),
                documents={_text(name): _text(page) for name, page in dict(data["documents"]).items()},
                warnings=tuple(_complaint(warning) for warning in data["warnings"]),
                inputs=tuple(_text(path) for path in data["inputs"]),
                grades=_counts(data["grades"]),
                counts=_counts(data["counts"]),
                steps=int(data["steps"]),
                compared=int(data["compared"]),
                agreed=data["agreed"] is True,
                files=tuple((_text(name), base64.b64decode(content)) for name, content in data["files"]),
                source_faults=tuple(_source_fault(fault) for fault in data["source_faults"]),
            )
        except (KeyError, TypeError, ValueError):
            return None


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError(value)
    return value


def _source_fault(value: Any) -> SourceFault:
    sort, line, printed, right, why = map(_text, value)
    return sort, line, printed, right, why


def _counts(value: Any) -> dict[str, int]:
    return {_text(name): int(count) for name, count in dict(value).items()}


def _complaint(data: Mapping[str, Any]) -> Complaint:
    known = {field.name for field in fields(Complaint)}
    place = data["place"] and Place(**data["place"])
    return Complaint(**{**{name: data[name] for name in known}, "place": place, "notes": tuple(data["notes"])})
