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

# Documents, made of a page and of what its set says; a format is made of a page alone.
TYPESET, HTML = ("latex", "pdf"), "html"
WRITTEN = "Written by derive"  # in the first line of what may be mistaken for written by hand, and may be replaced


@dataclass(frozen=True)
class Solution:
    """A page as a tree, and what it was made from: the numbers of answers by key, and how a reference compares.

    warnings   what whoever wrote it is told beside the page
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
    """What `--format` calls it, the suffix of its files, and the text of a page in it.

    built     whether a build writes it for each problem; else it is made where it is asked for
    drawings  the suffix of the drawings that it refers to, which stand beside it
    """

    name: str
    suffix: str
    render: Callable[[Solution], str]
    built: bool = True
    drawings: str = ""


def formats() -> Mapping[str, Format]:
    """Every format by its name."""
    return _formats(tuple(__path__))


def built_formats() -> Mapping[str, Format]:
    """Those that a build writes for each problem."""
    return {name: form for name, form in formats().items() if form.built}


@cache
def _formats(folders: tuple[str, ...]) -> Mapping[str, Format]:
    found: list[Format] = [import_module(f"{__name__}.{module.name}").FORMAT for module in iter_modules(folders)]
    return {each.name: each for each in found}
