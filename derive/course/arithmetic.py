"""The parts of an expression while it is read, each with its value and dimension, and the operations that combine them.

The readers of plain expressions and of LaTeX use these operations. The terms of a sum must have the same dimension. A
divisor that is known to be zero is rejected. A value that would be too large is rejected before it is computed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import NoReturn

from sympy import Expr, Integer, Rational, Symbol, expand, nan, oo, zoo

from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.kinds import dimension_of_kind, kind_with_article, named
from derive.algebra.ranges import Range
from derive.course.yaml_tree import Scalar
from derive.errors import Complaint, Rejected

MAX_DIGITS = 30
MAX_TEN_POWER = 50
MAX_EXPONENT = 12
MAX_SIZE = 4096
MAX_TERMS = 1_000_000
MAX_EXP_ARGUMENT = 100


@dataclass(frozen=True)
class Declared:
    """A letter, with its symbol, its kind of quantity and its range."""

    name: str
    symbol: Symbol
    kind: str
    lies: Range | None = None

    @property
    def dimension(self) -> Dimension:
        return dimension_of_kind(self.kind)


@dataclass(frozen=True)
class Term:
    """A value under construction: its expression, its dimension, and its place in the text.

    start, end   the places in the text where the value begins and ends
    size         an estimate of the degree of the value and of the number of its binary digits
    terms        a bound for the number of terms of the value after multiplying out
    kind         the kind of a value that is a single letter; None for other values
    """

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

    @property
    def vanishes(self) -> bool:
        return bool(self.expr.is_zero) or (1 < self.terms < 64 and expand(self.expr) == 0)


class Arithmetic:
    """The operations on the terms of one text. An operation reports operands that it cannot combine, at their place in
    the text."""

    max_terms = MAX_TERMS

    def __init__(self, scalar: Scalar):
        self.scalar = scalar
        self.text = scalar.text

    def refuse(self, code: str, message: str, start: int, end: int | None = None, help: str | None = None) -> NoReturn:
        raise Rejected(self.complaint(code, message, start, end, help))

    def complaint(self, code: str, message: str, start: int, end: int | None, help: str | None) -> Complaint:
        place = self.scalar.place_within(start, max(1, (end or start + 1) - start))
        return Complaint(code, message, place, (), help)

    def shown(self, term: Term) -> str:
        return " ".join(self.text[term.start : term.end].split())

    def fits(self, left: Term, right: Term) -> bool:
        return left.dimension == right.dimension

    def added(self, left: Term, right: Term, sign: str) -> Term:
        if not self.fits(left, right):
            verb = "added" if sign == "+" else "subtracted"
            message = f"`{self.shown(left)}` is {left.is_a}, but `{self.shown(right)}` is {right.is_a}"
            self.refuse("dimension", f"{message}: they cannot be {verb}", right.start, right.end)
        size, terms = max(left.size, right.size) + 1, left.terms + right.terms
        self.bound(left.start, right.end, size, terms)
        value = left.expr + right.expr if sign == "+" else left.expr - right.expr
        return Term(value, left.dimension, left.start, right.end, size, terms)

    def multiplied(self, left: Term, right: Term) -> Term:
        size, terms = left.size + right.size, left.terms * right.terms
        self.bound(left.start, right.end, size, terms)
        dimension = left.dimension * right.dimension
        return Term(left.expr * right.expr, dimension, left.start, right.end, size, terms)

    def negated(self, term: Term, start: int) -> Term:
        return replace(term, expr=-term.expr, start=start, kind=None)

    def reciprocal(self, term: Term) -> Term:
        if term.vanishes:
            message = "division by zero" if self.shown(term) == "0" else f"division by zero: `{self.shown(term)}` is 0"
            self.refuse("division-by-zero", message, term.start, term.end)
        return replace(term, expr=1 / term.expr, dimension=NUMBER / term.dimension)

    def raised(self, base: Term, exponent: Term) -> Term:
        """Return a power. An exponent that is too large is rejected, as in `9**9**9`."""
        number = exponent.expr
        if not number.is_number and exponent.dimension == NUMBER:
            return self._raised_to_letters(base, exponent)
        if not isinstance(number, Rational):
            message = f"the exponent `{self.shown(exponent)}` is not a number such as 2 or 1/2"
            self.refuse(
                "dimension" if exponent.dimension != NUMBER else "expression", message, exponent.start, exponent.end
            )
        if abs(number) > MAX_EXPONENT or number.q > MAX_EXPONENT:
            message = f"an exponent must be from -{MAX_EXPONENT} to {MAX_EXPONENT}"
            message += f", with a denominator of at most {MAX_EXPONENT}"
            self.refuse("too-large", message, exponent.start, exponent.end)
        whole = max(1, -(-abs(number.p) // number.q))
        size, terms = base.size * whole, base.terms**whole
        self.bound(base.start, exponent.end, size, terms)
        if number < 0 and base.vanishes:
            self.refuse("division-by-zero", f"division by zero: `{self.shown(base)}` is 0", base.start, base.end)
        term = replace(base, expr=base.expr**number, start=base.start, end=exponent.end, size=size, terms=terms)
        return self.real(replace(term, dimension=base.dimension ** fraction(number), kind=None))

    def _raised_to_letters(self, base: Term, exponent: Term) -> Term:
        """Return a power whose exponent has letters, such as (r/a)**n. The base must be dimensionless and positive."""
        if base.dimension != NUMBER:
            message = f"`{self.shown(base)}` is {base.is_a}, but the exponent `{self.shown(exponent)}`"
            message += " needs a dimensionless base, as in `(r/a)**n`"
            self.refuse("dimension", message, base.start, exponent.end)
        if not base.expr.is_positive:
            message = f"the base `{self.shown(base)}` of the exponent `{self.shown(exponent)}`"
            self.refuse("expression", f"{message} is not known to be positive", base.start, base.end)
        size = base.size + exponent.size
        self.bound(base.start, exponent.end, size, base.terms)
        return Term(base.expr**exponent.expr, NUMBER, base.start, exponent.end, size, base.terms)

    def applied(self, name: str, function: Callable[[Expr], Expr], inner: Term, start: int, end: int) -> Term:
        """Apply a function to a number or an angle, or take the square root of any quantity."""
        if name == "sqrt":
            root = replace(inner, dimension=inner.dimension ** fraction(Rational(1, 2)))
        elif inner.dimension != NUMBER:
            taken = "an angle or a number" if name in ("sin", "cos", "tan") else "a number"
            message = f"`{name}` takes {taken}, but `{self.shown(inner)}` is {inner.is_a}"
            self.refuse("dimension", message, inner.start, inner.end)
        else:
            root = replace(inner, terms=1)
        if name in ("exp", "sinh", "cosh") and inner.expr.is_number and abs(inner.expr.evalf()) > MAX_EXP_ARGUMENT:
            message = f"the argument of `{name}` must be from -{MAX_EXP_ARGUMENT} to {MAX_EXP_ARGUMENT}"
            self.refuse("too-large", message, inner.start, inner.end)
        return self.real(replace(root, expr=function(inner.expr), start=start, end=end, kind=None))

    def number(self, text: str, start: int, end: int) -> Term:
        digits, _, power = text.lower().partition("e")
        if len(digits.replace(".", "")) > MAX_DIGITS or len(power) > 4 or abs(int(power or 0)) > MAX_TEN_POWER:
            message = (
                f"a number may have at most {MAX_DIGITS} digits, and a power of ten from -{MAX_TEN_POWER} "
                f"to {MAX_TEN_POWER}"
            )
            self.refuse("too-large", message, start, end)
        value = rational(text)
        return Term(value, NUMBER, start, end, max(value.p.bit_length(), value.q.bit_length(), 1))

    def bound(self, start: int, end: int, size: int, terms: int) -> None:
        if size > MAX_SIZE or terms > self.max_terms:
            self.refuse("too-large", "this would be too large to evaluate", start, end)

    def real(self, term: Term) -> Term:
        if term.expr.has(zoo, nan, oo):
            self.refuse("division-by-zero", f"`{self.shown(term)}` is infinite", term.start, term.end)
        if term.expr.is_real is False:
            self.refuse("not-real", f"`{self.shown(term)}` is not a real number", term.start, term.end)
        return term


def rational(text: str) -> Rational:
    """Convert a decimal number exactly: `1.5` is 3/2, `1e-3` is 1/1000."""
    digits, _, power = text.lower().partition("e")
    whole, _, places = digits.partition(".")
    return Rational(int((whole + places) or 0)) * Integer(10) ** (int(power or 0) - len(places))


def fraction(number: Rational) -> Fraction:
    return Fraction(int(number.p), int(number.q))
