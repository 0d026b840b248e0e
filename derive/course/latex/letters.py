"""The letters of a document, and the declared names to which they refer.

A name is a letter, Greek or Latin, with its subscript: `I_{zz}` is `I_zz`, `r_{C,x}` is `r_C_x`. A dot over a letter
denotes the rate of change of the letter; `derive.algebra.expressions.rate` names it `theta_dot`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from derive.algebra.expressions import RATES, rate
from derive.algebra.kinds import dimension_of_kind
from derive.course.arithmetic import Declared, Term
from derive.course.latex.tokens import Argument, Token
from derive.course.latex.vocabulary import ARROW_COMMANDS, BOLD_COMMANDS, DECORATIONS, DOTS, GREEK_COMMANDS, WORDS

_SUBSCRIPT = {"letter", "number", "word"}
MOST_DOTS = len(RATES) - 1
UNIT_VECTORS = {"i": 0, "j": 1, "k": 2, "x": 0, "y": 1, "z": 2}


@dataclass(frozen=True)
class Letter:
    """A letter as the document writes it; `hat` and `vector` are its decorations. `Letters` finds its declared name."""

    base: str
    start: int
    end: int
    subscript: str = ""
    dots: int = 0
    hat: bool = False
    vector: bool = False  # in bold or under an arrow

    @property
    def name(self) -> str:
        return f"{self.base}_{self.subscript}" if self.subscript else self.base

    @property
    def axis(self) -> int | None:
        """The index of the axis if the letter could be a unit vector, otherwise None. Unit vectors are i, j, k with a
        hat, with an arrow or in bold, and x, y, z with a hat."""
        marked = self.hat or (self.vector and self.base in "ijk")
        return UNIT_VECTORS.get(self.base) if marked and not self.subscript and not self.dots else None


class Letters:
    """The declared names. A name is found by its letter and its subscript; `_` and `,` in the subscript are ignored."""

    def __init__(self, declared: Mapping[str, Declared]):
        self.declared = declared
        self._names: dict[tuple[str, str], list[str]] = {}
        for name in declared:
            base, _, subscript = name.partition("_")
            self._names.setdefault((base, _bare(subscript)), []).append(name)

    def named(self, letter: Letter) -> Declared | None:
        found = self._names.get((letter.base, _bare(letter.subscript)), [])
        return self.declared[found[0]] if len(found) == 1 else None

    def __contains__(self, base: str) -> bool:
        return (base, "") in self._names


def _bare(subscript: str) -> str:
    return re.sub(r"[_,]", "", subscript)


def dots_of(letter: Letter, declared: Declared) -> int:
    """Return the number of written dots plus the order of the declared rate, such as 1 for `x_dot`; 0 without a written
    dot."""
    return letter.dots and letter.dots + next(n for n in (3, 2, 1, 0) if declared.symbol.name.endswith(RATES[n]))


def term_of(letter: Letter, declared: Declared) -> Term:
    """Return the declared symbol with its dimension, or the rate of this symbol if the letter has dots."""
    symbol, dimension, kind = declared.symbol, declared.dimension, declared.kind
    if letter.dots:
        symbol, dimension = rate(symbol, letter.dots), dimension / dimension_of_kind("time") ** letter.dots
        return Term(symbol, dimension, letter.start, letter.end)
    return Term(symbol, dimension, letter.start, letter.end, kind=kind)


def letter_at(token: Token | None) -> Letter | None:
    """Return the letter with its decorations and dots; None if the token is not a letter."""
    if token is None:
        return None
    if token.kind == "letter":
        return Letter(token.text, token.start, token.end)
    if token.kind == "command" and token.text in GREEK_COMMANDS:
        return Letter(token.text, token.start, token.end)
    if token.kind == "command" and token.text in ("imath", "jmath"):
        return Letter(token.text[0], token.start, token.end)
    if token.kind == "command" and token.text in DECORATIONS | set(DOTS):
        return _decorated(token)
    return None


def _decorated(token: Token) -> Letter | None:
    argument = token.arguments[0]
    assert argument is not None
    if not argument.tokens:
        return None
    if len(argument.tokens) == 1:
        inner = letter_at(argument.tokens[0])
    else:
        inner = _long_name(argument) or _with_subscript(argument)
    if inner is None:
        return None
    return Letter(
        inner.base,
        token.start,
        token.end,
        inner.subscript,
        inner.dots + DOTS.get(token.text, 0),
        inner.hat or token.text == "hat",
        inner.vector or token.text in ARROW_COMMANDS | BOLD_COMMANDS,
    )


def _long_name(argument: Argument) -> Letter | None:
    r"""Read a name of several letters, set upright or in italics: `\mathit{mass}`."""
    if len(argument.tokens) > 1 and all(token.kind == "letter" for token in argument.tokens):
        return Letter("".join(token.text for token in argument.tokens), argument.start, argument.end)
    return None


def _with_subscript(argument: Argument) -> Letter | None:
    r"""Read `\dot{\omega_1}`, with the subscript inside the braces."""
    base, *rest = argument.tokens
    letter = letter_at(base)
    if letter is None or not rest or rest[0].text != "_" or rest[0].kind != "script":
        return None
    subscript = subscript_of(tuple(rest[1:]))
    return Letter(letter.base, letter.start, argument.end, subscript, letter.dots) if subscript else None


def subscript_of(tokens: tuple[Token, ...]) -> str | None:
    """Return a subscript as text: letters, digits, words and commas, joined; None if it contains anything else."""
    parts: list[str] = []
    for token in tokens:
        if token.kind in _SUBSCRIPT or token.text == "," or token.kind == "command" and token.text in GREEK_COMMANDS:
            parts.append(token.text)
        elif token.kind == "command" and token.text in WORDS | DECORATIONS and token.arguments[0]:
            parts.append(subscript_of(token.arguments[0].tokens) or "?")
        else:
            return None
    text = "".join(parts).replace(" ", "_")
    return text if re.fullmatch(r"[A-Za-z0-9_,]+", text) else None
