"""Expressions in YAML: text to SymPy by a grammar of our own, with dimensions and exact places.

    sum      product (("+" | "-") product)*
    product  unary (("*" | "/") unary)*
    unary    ("-" | "+") unary | atom ("**" unary)?
    atom     number | name | function "(" sum ")" | "(" sum ")"

Every character is accounted for by the grammar; no text ever reaches Python or SymPy as code. What is built is bounded
before it is built: `size` bounds digits and degrees, `terms` what it would be when multiplied out.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import NoReturn

from sympy import Expr, Integer, Rational, Symbol, cos, exp, expand, nan, oo, pi, sin, sqrt, tan, zoo

from derive.dimensions import NUMBER, Dimension, dimension_of_kind, kind_with_article, named
from derive.errors import Complaint, Rejected
from derive.source import Faults, Scalar, did_you_mean

MAX_LENGTH = 300
MAX_DEPTH = 40
MAX_DIGITS = 30
MAX_TEN_POWER = 50
MAX_EXPONENT = 12
MAX_SIZE = 4096
MAX_TERMS = 1_000_000
MAX_EXP_ARGUMENT = 100

FUNCTIONS: Mapping[str, Callable[[Expr], Expr]] = {"sqrt": sqrt, "sin": sin, "cos": cos, "tan": tan, "exp": exp}
RESERVED = ("pi", *FUNCTIONS)

_TOKEN = re.compile(
    r"(?P<space>\s+)|(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[A-Za-z_][A-Za-z0-9_]*)"
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
    ".": "an expression has no attributes",
    **dict.fromkeys("'\"", "an expression has no text"),
    **dict.fromkeys("=<>!", "an expression has no comparisons"),
}


@dataclass(frozen=True)
class Declared:
    """A symbol that the file declares, and of what kind it is."""

    name: str
    symbol: Symbol
    kind: str

    @property
    def dimension(self) -> Dimension:
        return dimension_of_kind(self.kind)


@dataclass(frozen=True)
class _Token:
    kind: str
    text: str
    start: int

    @property
    def end(self) -> int:
        return self.start + len(self.text)


@dataclass(frozen=True)
class _Term:
    """A value under construction: what it is, where it stands, and how large it could become."""

    expr: Expr
    dimension: Dimension
    start: int
    end: int
    size: int = 1
    terms: int = 1
    kind: str | None = None

    @property
    def is_a(self) -> str:
        return kind_with_article(self.kind) if self.kind else named(self.dimension)


def read_expression(scalar: Scalar, symbols: Mapping[str, Declared]) -> tuple[Expr, Dimension]:
    """The value and dimension of an expression in the declared symbols, or `Rejected` with what is wrong with it."""
    return _Parser(scalar, symbols).whole()


class _Parser:
    def __init__(self, scalar: Scalar, symbols: Mapping[str, Declared]):
        self.scalar = scalar
        self.text = scalar.text
        self.symbols = symbols
        self.at = 0
        if not self.text.strip():
            self.refuse("expression", "an expression is missing", 0)
        if len(self.text) > MAX_LENGTH:
            message = f"this expression has {len(self.text)} characters, and {MAX_LENGTH} are allowed"
            self.refuse("too-large", message, 0)
        found = [_Token(str(m.lastgroup), m[0], m.start()) for m in _TOKEN.finditer(self.text)]
        self.tokens = [token for token in found if token.kind != "space"]
        self.tokens.append(_Token("end", "", len(self.text.rstrip())))
        self.check_vocabulary()

    def refuse(self, code: str, message: str, start: int, end: int | None = None, help: str | None = None) -> NoReturn:
        raise Rejected(self.complaint(code, message, start, end, help))

    def complaint(self, code: str, message: str, start: int, end: int | None, help: str | None) -> Complaint:
        place = self.scalar.place_within(start, max(1, (end or start + 1) - start))
        return Complaint(code, message, place, (), help)

    # -- words ----------------------------------------------------------------------------------------------------

    def check_vocabulary(self) -> None:
        """Every undeclared name at once; a character or call that has no meaning here ends the list."""
        faults = Faults()
        for token, following in zip(self.tokens, self.tokens[1:], strict=False):
            if token.kind == "other":
                faults.add(self.odd_character(token))
                break
            if token.kind != "name" or token.text in RESERVED:
                continue
            declared = token.text in self.symbols
            if following.text == "(" and not (declared and following.start > token.end):
                faults.add(self.odd_call(token, declared))
                break
            if not declared:
                faults.add(self.undeclared(token))
        faults.stop()

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
        help_line = did_you_mean(token.text, FUNCTIONS) or "the functions are " + ", ".join(f"`{f}`" for f in FUNCTIONS)
        return self.complaint("expression", f"unknown function `{token.text}`", token.start, token.end, help_line)

    def undeclared(self, token: _Token) -> Complaint:
        help_line = did_you_mean(token.text, (*self.symbols, *RESERVED)) or "declare it under `symbols:`"
        return self.complaint("undeclared-symbol", f"`{token.text}` is not declared", token.start, token.end, help_line)

    # -- grammar --------------------------------------------------------------------------------------------------

    @property
    def token(self) -> _Token:
        return self.tokens[self.at]

    def taken(self, *texts: str) -> str | None:
        """The operator that stands here, if it is one of these, and step past it."""
        if self.token.text not in texts:
            return None
        self.at += 1
        return self.tokens[self.at - 1].text

    def whole(self) -> tuple[Expr, Dimension]:
        term = self.sum(0)
        if self.token.kind != "end":
            self.refuse("expression", f"`{self.token.text}` is not expected here", self.token.start, self.token.end)
        return term.expr, term.dimension

    def sum(self, depth: int) -> _Term:
        left = self.product(depth)
        while sign := self.taken("+", "-"):
            right = self.product(depth)
            if left.dimension != right.dimension:
                verb = "added" if sign == "+" else "subtracted"
                message = f"`{self.shown(left)}` is {left.is_a}, but `{self.shown(right)}` is {right.is_a}"
                self.refuse("dimension", f"{message}: they cannot be {verb}", right.start, right.end)
            size, terms = max(left.size, right.size) + 1, left.terms + right.terms
            self.bound(left.start, right.end, size, terms)
            value = left.expr + right.expr if sign == "+" else left.expr - right.expr
            left = _Term(value, left.dimension, left.start, right.end, size, terms)
        return left

    def product(self, depth: int) -> _Term:
        left = self.unary(depth)
        while sign := self.taken("*", "/"):
            right = self.unary(depth)
            if sign == "/":
                right = self.reciprocal(right)
            size, terms = left.size + right.size, left.terms * right.terms
            self.bound(left.start, right.end, size, terms)
            dimension = left.dimension * right.dimension
            left = _Term(left.expr * right.expr, dimension, left.start, right.end, size, terms)
        if self.token.kind in ("number", "name") or self.token.text == "(":
            before, here = self.tokens[self.at - 1], self.token
            after = here.text.removesuffix("(") + "(...)" * (here.text == "(" or here.text in FUNCTIONS)
            help_line = f"write `{before.text}*{after}`" if before.kind != "operator" else "write `*` for a product"
            self.refuse("expression", f"an operator is missing before `{here.text}`", here.start, here.end, help_line)
        return left

    def reciprocal(self, term: _Term) -> _Term:
        if _vanishes(term):
            message = "division by zero" if self.shown(term) == "0" else f"division by zero: `{self.shown(term)}` is 0"
            self.refuse("division-by-zero", message, term.start, term.end)
        return replace(term, expr=1 / term.expr, dimension=NUMBER / term.dimension)

    def unary(self, depth: int) -> _Term:
        here = self.token
        if depth > MAX_DEPTH:
            self.refuse("too-large", f"this expression is nested more than {MAX_DEPTH} deep", here.start)
        if sign := self.taken("-", "+"):
            term = self.unary(depth + 1)
            value = -term.expr if sign == "-" else term.expr
            return replace(term, expr=value, start=here.start, kind=None if sign == "-" else term.kind)
        base = self.atom(depth + 1)
        return self.power(base, self.unary(depth + 1)) if self.taken("**") else base

    def power(self, base: _Term, exponent: _Term) -> _Term:
        """`base**exponent`, once it is known to be small; `9**9**9` ends here before it is worked out."""
        number = exponent.expr
        if not isinstance(number, Rational):
            message = f"the exponent `{self.shown(exponent)}` is not a number such as 2 or 1/2"
            self.refuse(
                "dimension" if exponent.dimension != NUMBER else "expression", message, exponent.start, exponent.end
            )
        if abs(number) > MAX_EXPONENT or number.q > MAX_EXPONENT:
            message = f"the exponent is too large: {MAX_EXPONENT} is the most"
            self.refuse("too-large", message, exponent.start, exponent.end)
        whole = max(1, -(-abs(number.p) // number.q))
        size, terms = base.size * whole, base.terms**whole
        self.bound(base.start, exponent.end, size, terms)
        if number < 0 and _vanishes(base):
            self.refuse("division-by-zero", f"division by zero: `{self.shown(base)}` is 0", base.start, base.end)
        term = replace(base, expr=base.expr**number, start=base.start, end=exponent.end, size=size, terms=terms)
        return self.real(replace(term, dimension=base.dimension ** _fraction(number), kind=None))

    def atom(self, depth: int) -> _Term:
        token = self.token
        self.at += 1
        if token.kind == "number":
            return self.number(token)
        if token.text in FUNCTIONS:
            return self.call(token, depth)
        if token.kind == "name":
            if token.text == "pi":
                return _Term(pi, NUMBER, token.start, token.end)
            declared = self.symbols[token.text]
            return _Term(declared.symbol, declared.dimension, token.start, token.end, kind=declared.kind)
        if token.text == "(":
            inner = replace(self.sum(depth), start=token.start)
            return replace(inner, end=self.closed(token))
        self.at -= 1
        found = f"before `{token.text}`" if token.text else "at the end"
        self.refuse("expression", f"something is missing {found}", token.start, token.end)

    def closed(self, opening: _Token) -> int:
        end = self.token.end
        if not self.taken(")"):
            self.refuse("expression", "this `(` is never closed", opening.start)
        return end

    def call(self, name: _Token, depth: int) -> _Term:
        opening = self.token
        if not self.taken("("):
            self.refuse(
                "expression", f"`{name.text}` needs brackets", name.start, name.end, f"write `{name.text}(...)`"
            )
        inner = self.sum(depth)
        if self.token.text == ",":
            self.refuse("expression", f"`{name.text}` takes one value", self.token.start)
        end = self.closed(opening)
        if name.text == "sqrt":
            root = replace(inner, dimension=inner.dimension ** _fraction(Rational(1, 2)))
        elif inner.dimension != NUMBER:
            taken = "a number" if name.text == "exp" else "an angle or a number"
            message = f"`{name.text}` takes {taken}, but `{self.shown(inner)}` is {inner.is_a}"
            self.refuse("dimension", message, inner.start, inner.end)
        else:
            root = replace(inner, terms=1)
        if name.text == "exp" and inner.expr.is_number and abs(inner.expr.evalf()) > MAX_EXP_ARGUMENT:
            self.refuse("too-large", f"`exp` of more than {MAX_EXP_ARGUMENT} is too large", inner.start, inner.end)
        return self.real(replace(root, expr=FUNCTIONS[name.text](inner.expr), start=name.start, end=end, kind=None))

    def number(self, token: _Token) -> _Term:
        digits, _, power = token.text.lower().partition("e")
        if len(digits) > MAX_DIGITS or len(power) > 4 or abs(int(power or 0)) > MAX_TEN_POWER:
            message = f"a number may have {MAX_DIGITS} digits, and a power of ten up to {MAX_TEN_POWER}"
            self.refuse("too-large", message, token.start, token.end)
        value = rational(token.text)
        size = max(value.p.bit_length(), value.q.bit_length(), 1)
        return _Term(value, NUMBER, token.start, token.end, size)

    # -- bounds ---------------------------------------------------------------------------------------------------

    def bound(self, start: int, end: int, size: int, terms: int) -> None:
        if size > MAX_SIZE or terms > MAX_TERMS:
            self.refuse("too-large", "this would be too large when worked out", start, end)

    def real(self, term: _Term) -> _Term:
        if term.expr.has(zoo, nan, oo):
            self.refuse("division-by-zero", f"`{self.shown(term)}` is infinite", term.start, term.end)
        if term.expr.is_real is False:
            self.refuse("not-real", f"`{self.shown(term)}` is not a real number", term.start, term.end)
        return term

    def shown(self, term: _Term) -> str:
        return " ".join(self.text[term.start : term.end].split())


def rational(text: str) -> Rational:
    """A decimal number exactly: `1.5` is 3/2, `1e-3` is 1/1000."""
    digits, _, power = text.lower().partition("e")
    whole, _, places = digits.partition(".")
    return Rational(int((whole + places) or 0)) * Integer(10) ** (int(power or 0) - len(places))


def _fraction(number: Rational) -> Fraction:
    return Fraction(int(number.p), int(number.q))


def _vanishes(term: _Term) -> bool:
    return bool(term.expr.is_zero) or (1 < term.terms < 64 and expand(term.expr) == 0)
