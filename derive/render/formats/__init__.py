"""The formats of a single page: each module of this package defines one format.

A module defines `FORMAT = Format(...)`. With this definition, `--format` accepts the name of the format, and
`Rendered.texts` can contain a page in this format. If the format is `built`, each build writes a file in this format
for each problem. The help of a command lists the formats and so imports all these modules. Each module therefore
imports the code that renders a page only when it renders a page.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from derive.course.problem import Problem
    from derive.course.reference.comparison import Told
    from derive.errors import Complaint
    from derive.page.tree import Document
    from derive.page.wording import Phrases
    from derive.render.notation.notation import Notation
    from derive.steps.derivation import Derivation
    from derive.steps.step import Step

# Further formats, which are not modules of this package: for TeX, and for a browser. A format shows the page of one
# problem, so the documents of a set are not formats.
TYPESET, HTML = ("latex", "pdf"), "html"
# `-o` replaces a file of a kind that authors write, such as .md, only if its first line contains this text.
WRITTEN = "Written by derive"


@dataclass(frozen=True)
class Solution:
    """A page as a tree, with the data from which it was made.

    values     the steps that evaluate answers numerically, by key
    compared   outcomes of the comparison with a reference
    warnings   warnings for the author, which are not part of the page
    width      for a fragment, the width of the text in the document that includes it, in centimetres
    """

    document: Document
    words: Phrases
    notation: Notation
    problem: Problem
    derivation: Derivation
    values: Mapping[str, Step]
    compared: Sequence[Told] = ()
    warnings: Sequence[Complaint] = ()
    detail: str = "standard"
    width: float | None = None


@dataclass(frozen=True)
class Format:
    """The name of a format in `--format`, the suffix of its files, and the function that renders a page.

    built     whether a build writes this format for each problem; other formats are written only on request
    drawings  the suffix of the drawings that a file of this format includes from its folder
    """

    name: str
    suffix: str
    render: Callable[[Solution], str]
    built: bool = True
    drawings: str = ""


def formats() -> Mapping[str, Format]:
    """Return every format by its name."""
    return _formats(tuple(__path__))


def built_formats() -> Mapping[str, Format]:
    """Return the formats that a build writes for each problem."""
    return {name: form for name, form in formats().items() if form.built}


@cache
def _formats(folders: tuple[str, ...]) -> Mapping[str, Format]:
    found: list[Format] = [import_module(f"{__name__}.{module.name}").FORMAT for module in iter_modules(folders)]
    return {each.name: each for each in found}
