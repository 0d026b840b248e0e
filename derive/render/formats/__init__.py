"""Each format in which a page is given out alone; each module here is one, and nothing else names it.

A module says `FORMAT = Format(...)`, and from this follow `--format`, what `Rendered` holds, and, if it is
`built`, the files of a build.
Modules are imported wherever formats are listed, even by `--help`: what renders a page is imported when it renders.
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

# A document is made from a page and its set; a format is made from a page alone.
TYPESET, HTML = ("latex", "pdf"), "html"
WRITTEN = "Written by derive"  # first line of files that derive may replace, unlike handwritten files


@dataclass(frozen=True)
class Solution:
    """A page as a tree, with its sources: the numbers of answers by key, and how a reference compares.

    warnings   warnings for the author, next to the page
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


@dataclass(frozen=True)
class Format:
    """The name of a format in `--format`, the suffix of its files, and the function that renders a page.

    built     whether a build writes it for each problem; otherwise it is made only on request
    drawings  the suffix of the drawings to which it refers, in the same folder
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
