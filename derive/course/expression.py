"""Expressions in YAML, which a grammar of our own converts to SymPy expressions with dimensions.

    sum      product (("+" | "-") product)*
    product  unary (("*" | "/") unary)*
    unary    ("-" | "+") unary | atom ("**" unary)?
    atom     number | number unit | name | function "(" sum ")" | "(" sum ")"

A number may be followed by the unit of an angle, as in `sin(30 deg)`. Another unit is allowed only if the caller has a
letter that replaces the number.

The grammar reads every character; no text ever reaches Python or SymPy as code. The size of every value is bounded
before the value is computed.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise

from sympy import Expr, acos, asin, atan, cos, cosh, exp, log, pi, sin, sinh, sqrt, tan, tanh

from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.kinds import kind_of_dimension
from derive.course.arithmetic import Arithmetic, Declared, Term, rational
from derive.course.yaml_tree import Scalar, Word
from derive.errors import Complaint, Faults, did_you_mean, rejected
from derive.units import UNIT_NAMES, read_unit

__all__ = ["RESERVED", "Declared", "check_constant", "letters_in", "names_in", "rational", "read_expression"]

LONGEST_EXPRESSION = 300
DEEPEST_EXPRESSION = 40

PLAIN_FUNCTIONS: Mapping[str, Callable[[Expr], Expr]] = {
    "sqrt": sqrt, "sin": sin, "cos": cos, "tan": tan, "exp": exp, "ln": log, "arcsin": asin, "arccos": acos,
    "arctan": atan, "asin": asin, "acos": acos, "atan": atan, "sinh": sinh, "cosh": cosh, "tanh": tanh,
}  # fmt: skip
RESERVED = ("pi", *PLAIN_FUNCTIONS)
LetterFor = Callable[[Scalar, str], Expr | None]

_TOKEN = re.compile(
    r"(?P<space>\s+)|(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[A-Za-z_][A-Za-z0-9_]*|°)"
    r"|(?P<operator>\*\*|[-+*/(),])|(?P<other>.)",
    re.ASCII | re.DOTALL,
)
_INSTEAD = {
    "^": "**",
    "·": "*",
    "×": "*",
    "⋅": "*",
    "−": "-",
    "–": "-",
    "÷": "/",
    "²": "**2",
    "³": "**3",
    "√": "sqrt(...)",
    "[": "(",
    "]": ")",
    "{": "(",
    "}": ")",
}
_WHY_NOT = {
    ".": "a dot is allowed only inside a number",
    **dict.fromkeys("'\"", "quotes are not allowed in an expression"),
    **dict.fromkeys("=<>!", "a comparison is not allowed in an expression"),
}


@dataclass(frozen=True)
class _Token:
    kind: str
    text: str
    start: int

    @property
    def end(self) -> int:
        return self.start + len(self.text)


def read_expression(
    scalar: Scalar, symbols: Mapping[str, Declared] | None, letter_for: LetterFor | None = None
) -> tuple[Expr, Dimension]:
    """Return the value and dimension of an expression in the declared symbols; raise `Rejected` if it has an error.

    symbols      the symbols that the expression may contain; None if it must be a number
    letter_for   a function with two arguments, a number with a unit and its kind of quantity; it returns a letter for
                 the number, or None
    """
    return _Parser(scalar, symbols, letter_for).whole()


def check_constant(scalar: Scalar, moving: Collection[str], key: str, help_line: str) -> None:
    """Reject an expression under `key` that contains one of the names in `moving`, which are not constant."""
    if varies := next((name for name in letters_in(scalar) if name in moving), None):
        rejected("changes", f"`{key}` is about constant letters, but `{varies}` varies", varies.place, help_line)


def names_in(scalar: Scalar) -> list[Word]:
    """Return the names of letters and units in an expression, each with its place; leave out `pi` and functions."""
    names = (m for m in _TOKEN.finditer(scalar.text) if m.lastgroup == "name" and m[0] not in RESERVED)
    return [scalar.piece(m.start(), m.end() - m.start()).word for m in names]


def letters_in(scalar: Scalar) -> list[Word]:
    """Return the same names as `names_in`, but without units after numbers, such as `deg` in `30 deg`."""
    tokens = [m for m in _TOKEN.finditer(scalar.text) if m.lastgroup != "space"]
    units = {
        unit.start()
        for number, unit in pairwise(tokens)
        if number.lastgroup == "number" and unit[0].replace("°", "deg") in UNIT_NAMES
    }
    starts = [m.start() for m in tokens if m.lastgroup == "name" and m[0] not in RESERVED]
    return [name for start, name in zip(starts, names_in(scalar), strict=True) if start not in units]


class _Parser(Arithmetic):
    def __init__(self, scalar: Scalar, symbols: Mapping[str, Declared] | None, letter_for: LetterFor | None):
        super().__init__(scalar)
        self.symbols = symbols or {}
        self.is_number = symbols is None
        self.letter_for = letter_for
        self.at = 0
        if not self.text.strip():
            self.refuse("expression", "an expression is missing", 0)
        if len(self.text) > LONGEST_EXPRESSION:
            message = f"this expression has {len(self.text)} characters, but only {LONGEST_EXPRESSION} are allowed"
            self.refuse("too-large", message, 0)
        found = [_Token(str(m.lastgroup), m[0], m.start()) for m in _TOKEN.finditer(self.text)]
        self.tokens = [token for token in found if token.kind != "space"]
        self.tokens.append(_Token("end", "", len(self.text.rstrip())))
        self.check_vocabulary()

    # -- words ----------------------------------------------------------------------------------------------------

    def check_vocabulary(self) -> None:
        faults = Faults()
        pairs = zip(self.tokens, self.tokens[1:], strict=False)
        measured = {unit.start for number, unit in pairs if self.is_measured(number, unit)}
        for token, following in zip(self.tokens, self.tokens[1:], strict=False):
            if token.kind == "other":
                faults.add(self.odd_character(token))
                break
            if token.kind != "name" or token.text in RESERVED or token.start in measured:
                continue
            declared = token.text in self.symbols
            if following.text == "(" and not (declared and following.start > token.end):
                faults.add(self.odd_call(token, declared))
                break
            if not declared:
                faults.add(self.undeclared(token))
        faults.stop()

    def is_measured(self, number: _Token, unit: _Token) -> bool:
        """Return whether two tokens are a number and its unit, as in `30 deg`."""
        is_unit = unit.text not in self.symbols and unit.text.replace("°", "deg") in UNIT_NAMES
        return number.kind == "number" and unit.kind == "name" and is_unit

    def odd_character(self, token: _Token) -> Complaint:
        char = token.text
        instead, why = _INSTEAD.get(char), _WHY_NOT.get(char, f"`{char}` is not part of an expression")
        if greek := re.fullmatch(r"GREEK (SMALL|CAPITAL) LETTER ([A-Z]+)", unicodedata.name(char, "")):
            instead = greek[2].lower() if greek[1] == "SMALL" else greek[2].capitalize()
        help_line = f"write `{instead}`" + (" for a power" if char == "^" else "") if instead else None
        if char == "\\":
            help_line = "write `omega`, not `\\omega`"
        return self.complaint("expression", why, token.start, token.end, help_line)

    def odd_call(self, token: _Token, declared: bool) -> Complaint:
        if declared:
            message, help_line = f"`{token.text}` is not a function", f"write `{token.text}*(...)`"
            return self.complaint("expression", message, token.start, token.end, help_line)
        known = ", ".join(f"`{name}`" for name in PLAIN_FUNCTIONS)
        help_line = did_you_mean(token.text, PLAIN_FUNCTIONS) or f"the functions are {known}"
        return self.complaint("expression", f"unknown function `{token.text}`", token.start, token.end, help_line)

    def undeclared(self, token: _Token) -> Complaint:
        if self.is_number:
            message = f"a number is expected here, but `{token.text}` is not a number"
            return self.complaint("expression", message, token.start, token.end, did_you_mean(token.text, RESERVED))
        help_line = did_you_mean(token.text, (*self.symbols, *RESERVED)) or "declare it under `symbols:`"
        return self.complaint("undeclared-symbol", f"`{token.text}` is not declared", token.start, token.end, help_line)

    # -- grammar --------------------------------------------------------------------------------------------------

    @property
    def token(self) -> _Token:
        return self.tokens[self.at]

    def taken(self, *texts: str) -> str | None:
        if self.token.text not in texts:
            return None
        self.at += 1
        return self.tokens[self.at - 1].text

    def whole(self) -> tuple[Expr, Dimension]:
        term = self.sum(0)
        if self.token.kind != "end":
            self.refuse("expression", f"`{self.token.text}` is not expected here", self.token.start, self.token.end)
        return term.expr, term.dimension

    def sum(self, depth: int) -> Term:
        left = self.product(depth)
        while sign := self.taken("+", "-"):
            right = self.product(depth)
            left = self.added(left, right, sign)
        return left

    def product(self, depth: int) -> Term:
        left = self.unary(depth)
        while sign := self.taken("*", "/"):
            right = self.unary(depth)
            left = self.multiplied(left, self.reciprocal(right) if sign == "/" else right)
        if self.token.kind in ("number", "name") or self.token.text == "(":
            before, here = self.tokens[self.at - 1], self.token
            after = here.text.removesuffix("(") + "(...)" * (here.text == "(" or here.text in PLAIN_FUNCTIONS)
            help_line = f"write `{before.text}*{after}`" if before.kind != "operator" else "write `*` for a product"
            self.refuse("expression", f"an operator is missing before `{here.text}`", here.start, here.end, help_line)
        return left

    def unary(self, depth: int) -> Term:
        here = self.token
        if depth > DEEPEST_EXPRESSION:
            message = f"this expression is nested more than {DEEPEST_EXPRESSION} levels deep"
            self.refuse("too-large", message, here.start)
        if sign := self.taken("-", "+"):
            term = self.unary(depth + 1)
            return self.negated(term, here.start) if sign == "-" else replace(term, start=here.start)
        base = self.atom(depth + 1)
        return self.raised(base, self.unary(depth + 1)) if self.taken("**") else base

    def atom(self, depth: int) -> Term:
        token = self.token
        self.at += 1
        if token.kind == "number" and self.is_measured(token, self.token):
            return self.measured(token)
        if token.kind == "number":
            return self.number(token.text, token.start, token.end)
        if token.text in PLAIN_FUNCTIONS:
            return self.call(token, depth)
        if token.kind == "name":
            if token.text == "pi":
                return Term(pi, NUMBER, token.start, token.end)
            declared = self.symbols[token.text]
            return Term(declared.symbol, declared.dimension, token.start, token.end, kind=declared.kind)
        if token.text == "(":
            inner = replace(self.sum(depth), start=token.start)
            return replace(inner, end=self.closed(token))
        self.at -= 1
        found = f"before `{token.text}`" if token.text else "at the end"
        self.refuse("expression", f"something is missing {found}", token.start, token.end)

    def measured(self, number: _Token) -> Term:
        start, end = number.start, self.token.end
        self.at += 1
        piece = self.scalar.piece(start, end - start)
        unit = read_unit(self.text[number.end : end], self.scalar.place_within(number.end, end - number.end))
        if unit.angles == 1 and unit.dimension == NUMBER:
            value = self.number(number.text, start, number.end)
            return Term(value.expr * unit.factor, NUMBER, start, end, value.size)
        kind = kind_of_dimension(unit.dimension)
        letter = self.letter_for(piece, kind) if self.letter_for and kind else None
        if letter is None:
            message = f"a number with a unit, `{piece.text}`, is not allowed within an expression"
            help_line = None if self.is_number else "declare a letter for it, and give its number in `values`"
            self.refuse("expression", message, start, end, help_line)
        return Term(letter, unit.dimension, start, end, kind=kind)

    def closed(self, opening: _Token) -> int:
        end = self.token.end
        if not self.taken(")"):
            self.refuse("expression", "this `(` is never closed", opening.start)
        return end

    def call(self, name: _Token, depth: int) -> Term:
        opening = self.token
        if not self.taken("("):
            self.refuse(
                "expression", f"`{name.text}` needs brackets", name.start, name.end, f"write `{name.text}(...)`"
            )
        inner = self.sum(depth)
        if self.token.text == ",":
            self.refuse("expression", f"`{name.text}` takes one value", self.token.start)
        end = self.closed(opening)
        return self.applied(name.text, PLAIN_FUNCTIONS[name.text], inner, name.start, end)
