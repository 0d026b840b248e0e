"""Pairs of expressions, whether they are equal, and what was said of them: one line of text each.

    family / equal or not / grade that is reached at least / what SymPy decides / left / right

An expression is written with the operation first, `(Add x (Mul 2 y))`; the lines before tell of each letter what is
assumed of it. `python -P -m tests.algebra.make_pairs` writes the file.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import sympy
from sympy import ImmutableDenseMatrix, Integer, MatrixBase, Rational, Symbol, Tuple
from sympy.core.function import AppliedUndef, UndefinedFunction

from derive.algebra.encoding import encoded
from derive.algebra.expressions import Relation

FILE = Path(__file__).with_name("pairs.txt")
_NAMES = "Add Mul Pow Abs sin cos tan sec csc cot asin acos atan atan2 exp log sinh cosh tanh Derivative Tuple sign Max"
_CLASSES: dict[str, Any] = {getattr(sympy, name).__name__: getattr(sympy, name) for name in _NAMES.split()}
_CONSTANTS: dict[str, Any] = {"pi": sympy.pi, "E": sympy.E, "I": sympy.I}
_PARTS = re.compile(r"[()]|[^\s()]+")
_NUMBER = re.compile(r"-?\d+(/\d+)?")


@dataclass(frozen=True)
class Pair:
    family: str
    left: Any
    right: Any
    equal: bool
    grade: str = ""
    by_sympy: str = ""  # by which of `equals` and `simplify` SymPy decides it rightly, in the time it was given


class Letters:
    def __init__(self) -> None:
        self.words: dict[Symbol, str] = {}

    def word(self, letter: Symbol) -> str:
        if letter not in self.words:
            same = sum(other.name == letter.name for other in self.words)
            self.words[letter] = letter.name + "'" * same
        return self.words[letter]

    def lines(self) -> list[str]:
        return [
            " ".join([word, letter.name, *(f"{name}={int(holds)}" for name, holds in encoded(letter)[2].items())])
            for letter, word in self.words.items()
        ]


def written(expr: Any, letters: Letters) -> str:
    if isinstance(expr, Symbol):
        return letters.word(expr)
    if isinstance(expr, Rational):
        return str(expr)
    if isinstance(expr, MatrixBase):
        return f"(Matrix {expr.rows} {expr.cols} {' '.join(written(entry, letters) for entry in expr)})"
    if isinstance(expr, Relation):
        return f"(Relation {expr.operator} {' '.join(written(side, letters) for side in expr.sides)})"
    for word, constant in _CONSTANTS.items():
        if expr == constant:
            return word
    name = type(expr).__name__
    if isinstance(expr, AppliedUndef):
        name = f"${name}"
    elif _CLASSES.get(name) is not type(expr):
        raise TypeError(f"{name} has no text")
    return f"({name} {' '.join(written(arg, letters) for arg in expr.args)})"


def read(text: str, letters: dict[str, Symbol]) -> Any:
    parts = iter(_PARTS.findall(text))

    def made(part: str) -> Any:
        if part != "(":
            return Rational(part) if _NUMBER.fullmatch(part) else _CONSTANTS.get(part) or letters[part]
        name, args = next(parts), []
        if name == "Relation":
            args.append(next(parts))
        while (part := next(parts)) != ")":
            args.append(made(part))
        return _composed(name, args)

    return made(next(parts))


def _composed(name: str, args: list[Any]) -> Any:
    if name == "Matrix":
        return ImmutableDenseMatrix(int(args[0]), int(args[1]), args[2:])
    if name == "Relation":
        return Relation(args[1], args[0], args[2])
    if name.startswith("$"):
        return UndefinedFunction(name[1:])(*args)
    if name == "Tuple":
        return Tuple(*(Integer(arg) if isinstance(arg, int) else arg for arg in args))
    as_written = {"evaluate": False} if name in {"Add", "Mul", "Pow"} else {}
    return _CLASSES[name](*args, **as_written)


def lines_of(pairs: Iterable[Pair]) -> list[str]:
    letters = Letters()
    rows = [
        " | ".join(
            [
                pair.family,
                "=" if pair.equal else "!=",
                pair.grade,
                pair.by_sympy,
                written(pair.left, letters),
                written(pair.right, letters),
            ]
        )
        for pair in pairs
    ]
    return [*letters.lines(), "", *rows]


def pairs_in(text: str) -> list[Pair]:
    head, _, body = text.partition("\n\n")
    letters = {}
    for line in head.splitlines():
        word, name, *assumed = line.split(" ")
        given = (each.split("=") for each in assumed)
        letters[word] = Symbol(name, **{what: holds == "1" for what, holds in given})
    found = []
    for line in body.splitlines():
        family, mark, grade, by_sympy, left, right = line.split(" | ")
        found.append(Pair(family, read(left, letters), read(right, letters), mark == "=", grade, by_sympy))
    return found


def families() -> list[str]:
    _, _, body = FILE.read_text(encoding="utf-8").partition("\n\n")
    return sorted({line.partition(" | ")[0] for line in body.splitlines()})


@cache
def kept() -> list[Pair]:
    return pairs_in(FILE.read_text(encoding="utf-8"))
