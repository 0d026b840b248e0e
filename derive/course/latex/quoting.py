"""Quotations from a document, with the letters of the document: prose with formulas between dollar signs.

A quotation is data and never reaches TeX unchanged: each formula is split into commands and signs and written again
from these pieces. Anything unknown is rejected at its place. A quotation may contain commands that the grammar does not
read, because the quoted formula may be garbled.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from derive.course.latex.vocabulary import ALIGNMENTS, ARGUMENTS, KNOWN, MATRICES, ONLY_PRINTED, SIZES, SPACES, WORDS

LONGEST_QUOTATION = 2000
_COMMANDS = (KNOWN | SPACES | SIZES) - {"\n", "it", "rm", "bf", "limits", "nolimits", "notag", "nonumber"}
_COMMANDS |= ONLY_PRINTED | {"{", "}", "|"}
_PIECE = re.compile(r"\\(?P<name>[A-Za-z]+)|\\(?P<sign>.)|(?P<plain>.)", re.DOTALL)
_ENVIRONMENT = re.compile(r"\s*\{([a-z]+\*?)\}(?:\{([lcr|\s]+)\})?")
_SIGNS = frozenset("+-*/=<>,.'()[]|^_:;! \n&{}~") | frozenset(map(chr, range(48, 58)))
_WORD = re.compile(r"\s*\{([A-Za-z0-9 ,.\-/]*)\}")
_ARGUMENT = re.compile(r"\s*(?:\{|[A-Za-z0-9]|\\[A-Za-z])")


@dataclass(frozen=True)
class Quoted:
    """A piece of a quotation: words, or a formula whose TeX is allowed on a page."""

    text: str
    is_formula: bool


class Unquotable(ValueError):
    """The error for a text that cannot be quoted; `at` is the position of the part that cannot be quoted."""

    def __init__(self, why: str, at: int):
        super().__init__(why)
        self.at = at


def quoted(text: str) -> tuple[Quoted, ...]:
    """Return the words and formulas in order, or raise `Unquotable`."""
    if len(text) > LONGEST_QUOTATION:
        raise Unquotable(f"a quotation has at most {LONGEST_QUOTATION} characters", 0)
    if text.count("$") % 2:
        raise Unquotable("a formula of the quotation has no end: one `$` is missing", text.rindex("$"))
    found, at = [], 0
    for i, piece in enumerate(text.split("$")):
        if piece:
            found.append(Quoted(quoted_formula(piece, at), True) if i % 2 else Quoted(piece, False))
        at += len(piece) + 1
    return tuple(found)


def quoted_formula(text: str, offset: int = 0) -> str:
    """Return the TeX of a formula, rewritten with known signs and commands."""
    pieces, rows = "".join(_pieces(text, offset)).strip(), False
    depth = 0
    for word in re.findall(r"\\begin|\\end|\\\\|\\&|&", pieces):
        depth += {"\\begin": 1, "\\end": -1}.get(word, 0)
        rows = rows or (depth == 0 and word in {"\\\\", "&"})
    return rf"\begin{{aligned}}{pieces}\end{{aligned}}" if rows else pieces


def _pieces(text: str, offset: int) -> Iterator[str]:
    nesting: list[str] = []
    sides = at = 0
    while at < len(text):
        found = _PIECE.match(text, at)
        assert found
        name, sign, plain = found["name"], found["sign"], found["plain"]
        here, at = at, found.end()
        if name in {"begin", "end"}:
            environment = _ENVIRONMENT.match(text, at)
            if not environment or environment[1] not in MATRICES | ALIGNMENTS:
                raise Unquotable(f"`\\{name}` needs a known environment", offset + here)
            at = environment.end()
            yield _environment(name, environment[1], environment[2], nesting, offset + here)
        elif name in WORDS:
            words = _WORD.match(text, at)
            if not words:
                raise Unquotable(f"`\\{name}` needs plain words in braces", offset + here)
            at = words.end()
            yield rf"\text{{{words[1]}}}"
        elif name is not None:
            if name not in _COMMANDS:
                raise Unquotable(f"`\\{name}` cannot be quoted", offset + here)
            if "{" in ARGUMENTS.get(name, "") and not _has_argument(text, at):
                raise Unquotable(f"`\\{name}` needs a value in braces", offset + here)
            sides += {"left": 1, "right": -1}.get(name, 0)
            yield f"\\{name} "
        elif sign is not None:
            if sign not in _COMMANDS | {"\\"}:
                raise Unquotable(f"`\\{sign}` cannot be quoted", offset + here)
            yield f"\\{sign}"
        else:
            if plain not in _SIGNS and not (plain.isascii() and plain.isalpha()):
                raise Unquotable(f"`{plain}` cannot be quoted", offset + here)
            if plain == "{":
                nesting.append(plain)
            elif plain == "}" and (not nesting or nesting.pop() != "{"):
                raise Unquotable("this `}` was never opened", offset + here)
            yield plain
    if nesting or sides:
        why = f"`{nesting[-1]}` of this formula has no end" if nesting else "`\\left` and `\\right` do not match"
        raise Unquotable(why, offset)


def _environment(name: str, environment: str, columns: str | None, nesting: list[str], at: int) -> str:
    if name == "end":
        if not nesting or nesting.pop() != environment:
            raise Unquotable(f"this `\\end{{{environment}}}` has no beginning", at)
        return f"\\end{{{_shown(environment)}}}"
    if environment == "array" and not columns:
        raise Unquotable("`array` needs a specification of its columns, such as `{cc}`", at)
    nesting.append(environment)
    return f"\\begin{{{_shown(environment)}}}" + (f"{{{columns}}}" if environment == "array" else "")


def _shown(environment: str) -> str:
    return "aligned" if environment in ALIGNMENTS else environment


def _has_argument(text: str, at: int) -> bool:
    option = re.compile(r"\s*\[[^\]]*\]").match(text, at)
    return _ARGUMENT.match(text, option.end() if option else at) is not None
