"""The eigenvalue problem K a = lambda M a, solved exactly: the roots of det(K - lambda M) = 0 and their columns.

Common factors are taken out of the matrices first, so that mostly numbers are left. Columns are computed with lambda as
a symbol, modulo the irreducible factor that has it as a root: this decides exactly whether a pivot vanishes.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

from sympy import (
    Add,
    Dummy,
    Expr,
    ImmutableDenseMatrix,
    Integer,
    Mul,
    Poly,
    Pow,
    Rational,
    Symbol,
    cos,
    expand,
    factor,
    fraction,
    gcd,
    ilcm,
    lcm,
    pi,
    prime,
    sin,
    sqrt,
    together,
)
from sympy.matrices import MatrixBase
from sympy.polys.constructor import construct_domain
from sympy.polys.polyerrors import PolynomialError
from sympy.polys.polytools import invert
from sympy.simplify.fu import TR5, TR6, TR8

from derive.algebra.amplitudes import determinant_of
from derive.algebra.collect import spread_or_by_terms
from derive.algebra.expressions import Relation, explicit, scalar
from derive.algebra.expressions import Root as RootSign
from derive.algebra.length import length
from derive.algebra.ordered_roots import OrderedRoot
from derive.algebra.ranges import fulfilling
from derive.algebra.squares import with_squares
from derive.algebra.tidy import common_factor, tidied
from derive.errors import Complaint, Rejected
from derive.steps.signs import sign_for_all, sign_where
from derive.steps.step import is_zero

LARGEST, LETTERS = 12, 40  # coordinates; coordinates times symbols of the matrices
FINEST = 60  # most parts of a right angle that are tried for the frequency of a chain


@dataclass(frozen=True)
class Root:
    """A root lambda of det(K - lambda M): its columns, orthogonal with respect to M, and its sign if it is known.

    A root without a formula has no columns.
    """

    value: Expr
    columns: tuple[MatrixBase, ...]
    sign: int | None

    @property
    def multiplicity(self) -> int:
        return max(len(self.columns), 1)

    @property
    def has_formula(self) -> bool:
        return bool(self.columns)


@dataclass(frozen=True)
class Pencil:
    """K - lambda M, with symmetric matrices; the condition `exists` is assumed to hold.

    name   of the numbered roots of a factor without formulas; by default such a factor is rejected
    """

    stiffness: MatrixBase
    mass: MatrixBase
    exists: Relation | None = None
    name: str = ""

    @cached_property
    def scale(self) -> Expr:
        """The unit of lambda, such as k/m, for which as few symbols as possible are left."""
        return common_factor(list(self.stiffness)) / common_factor(list(self.mass))

    @cached_property
    def _reduced(self) -> tuple[MatrixBase, MatrixBase]:
        parts = (each / common_factor(list(each)) for each in (self.stiffness, self.mass))
        stiffness, mass = (ImmutableDenseMatrix(part.applyfunc(tidied)) for part in parts)
        return stiffness, mass

    @cached_property
    def factors(self) -> tuple[tuple[Poly, int], ...]:
        """The irreducible factors of the determinant as a polynomial in lambda/scale, with their powers."""
        stiffness, mass = self._reduced
        size = stiffness.shape[0]
        if size > LARGEST or size > 3 and size * len((stiffness + mass).free_symbols) > LETTERS:
            message = f"the frequencies of {size} coordinates with this many symbols cannot be computed"
            raise Rejected(Complaint("too-large", message, help="use one symbol for equal masses or equal springs"))
        whole = determinant_of(stiffness - _LAMBDA * mass)
        try:
            found = Poly(whole, _LAMBDA).factor_list()[1]
        except PolynomialError:
            found = []
        if sum(part.degree() * times for part, times in found) != size:
            raise Rejected(Complaint("no-closed-form", "the determinant is not a polynomial that can be factored"))
        return tuple((part, times) for part, times in found)

    def factored(self, unknown: Expr) -> Expr:
        """The determinant up to a constant factor, factored, with `unknown` substituted for lambda."""
        parts = []
        for part, times in self.factors:
            value = tidied(part.as_expr().xreplace({_LAMBDA: unknown / self.scale}))
            above = value.as_numer_denom()[0].as_independent(*unknown.free_symbols, as_Add=False)[1]
            parts.append(_by_powers(_leading_positive(above, unknown), unknown) ** times)
        return Mul(*parts)

    @cached_property
    def roots(self) -> tuple[Root, ...]:
        """The roots in ascending order for ordinary values of the symbols; those without a formula come last."""
        found = [root for part, times in self.factors for root in self._roots_of(part, times)]
        return tuple(sorted(found, key=lambda root: (not root.has_formula, _size(root.value))))

    def _roots_of(self, part: Poly, times: int) -> list[Root]:
        values = _roots_of(part)
        if values is not None:
            return [self._root(part, value, times) for value in values]
        degree = part.degree()
        whole = Poly(tidied(part.as_expr().xreplace({_LAMBDA: _LAMBDA / self.scale}) * self.scale**degree), _LAMBDA)
        coefficients = whole.all_coeffs()
        alone = [other.degree() for other, _ in self.factors if _roots_of(other) is None] == [degree]
        if not self.name or times > 1 or not alone or not self._are_positive(coefficients):
            message = f"the squares of {degree} frequencies are the roots of a polynomial that does not factor"
            help_ = "use one symbol for equal masses or equal springs, or give all of them numbers"
            if self.name:
                help_ = "for small oscillations about a stable equilibrium with one such polynomial, give numbers"
            raise Rejected(Complaint("no-closed-form", message, help=help_))
        names = [scalar(f"{self.name}_{n + 1}") for n in range(degree)]
        return [Root(OrderedRoot(coefficients, n + 1, name), (), 1) for n, name in enumerate(names)]

    def _are_positive(self, coefficients: Sequence[Expr]) -> bool:
        """Whether all roots of that factor are positive. They are real if M is positive definite; by Descartes' rule,
        no real root is negative or zero if the signs of the coefficients alternate."""
        signs = [sign_for_all(tidied(each)) for each in coefficients]
        alternate = None not in signs and 0 not in signs and all(u == -v for u, v in pairwise(signs))  # type: ignore[operator]
        return alternate and self._has_positive_minors(self.mass)

    def _root(self, part: Poly, value: Expr, times: int) -> Root:
        stiffness, mass = self._reduced
        columns = [
            ImmutableDenseMatrix(column.applyfunc(lambda entry: _entry_at(entry, value)))
            for column in _null_columns(stiffness - _LAMBDA * mass, part)
        ]
        if len(columns) != times:
            raise Rejected(Complaint("no-closed-form", "a repeated frequency has too few independent mode shapes"))
        exact = _of_plain_sign(tidied(self.scale * value))
        return Root(exact, tuple(_presentable(c) for c in _orthogonal(columns, mass)), self._sign(exact))

    def _sign(self, value: Expr) -> int | None:
        """Return the sign of a root: its own sign if known; else 1 if both matrices have positive leading minors."""
        if is_zero(value):
            return 0
        own = 1 if value.is_positive else -1 if value.is_negative else sign_where(value, self.exists)
        return own if own is not None else 1 if self._is_positive else None

    @cached_property
    def _is_positive(self) -> bool:
        return self._has_positive_minors(self.stiffness) and self._has_positive_minors(self.mass)

    @staticmethod
    def _has_positive_minors(matrix: MatrixBase) -> bool:
        minors = (determinant_of(matrix[:n, :n]) for n in range(1, matrix.shape[0] + 1))
        return all(sign_for_all(tidied(minor)) == 1 for minor in minors)


_LAMBDA = Dummy("lambda")


def _leading_positive(value: Expr, unknown: Expr) -> Expr:
    """The value without a minus sign before the highest power, if its sign is known."""
    letters = unknown.free_symbols
    leading = value.as_poly(*letters)
    return -value if leading is not None and leading.LC().could_extract_minus_sign() else value


def _by_powers(value: Expr, unknown: Expr) -> Expr:
    """Collect by powers, each with one factored coefficient, if that is shorter."""
    polynomial = value.as_poly(*unknown.free_symbols)
    if polynomial is None:
        return value
    terms = [factor(c) * Mul(*(s**n for s, n in zip(polynomial.gens, ns, strict=True))) for ns, c in polynomial.terms()]
    return min((Add(*terms), value), key=length)


def _roots_of(part: Poly) -> list[Expr] | None:
    """The roots of a linear or quadratic polynomial, or of that of a uniform chain; None for any other."""
    if part.degree() == 1:
        a, b = part.all_coeffs()
        return [_of_plain_sign(tidied(-b / a))]
    if part.degree() == 2:
        a, b, c = part.all_coeffs()
        root = sqrt(_discriminant(a, b, c))
        return [_sum_with_root(-b / (2 * a), turn / (2 * a), root) for turn in (-1, 1)]
    return _of_chain(part)


def _of_plain_sign(value: Expr) -> Expr:
    """Replace cos^2 by sin^2, or the reverse, if that shows a sign: M + m sin^2 a, not M + m - m cos^2 a."""
    if sign_for_all(value) is not None:
        return value
    above, below = fraction(together(value))
    if not value.has(sin, cos):
        form = above / with_squares(below)
        return form if sign_for_all(form) is not None else value
    forms = [factor(expand(turned(expand(above)))) / factor(expand(turned(expand(below)))) for turned in (TR5, TR6)]
    return next((form for form in forms if sign_for_all(form) is not None), value)


def _discriminant(a: Expr, b: Expr, c: Expr) -> Expr:
    """b^2 - 4 a c, tidied or with its two terms factored, whichever is shorter."""
    common = gcd(b**2, a * c)
    apart = factor(common) * (factor(b**2 / common) - 4 * factor(a * c / common))
    return min((tidied(b**2 - 4 * a * c), apart), key=length)


def _sum_with_root(plain: Expr, before: Expr, root: Expr) -> Expr:
    """u + v sqrt(D) over one denominator, with u and v factored if that is shorter."""
    below = lcm(*(fraction(together(part))[1] for part in (plain, before)))
    apart = (factor(plain * below) + factor(before * below) * root) / factor(below)
    return min((tidied(plain + before * root), apart), key=length)


def _of_chain(part: Poly) -> list[Expr] | None:
    """The roots if all are 4 sin^2(a pi/2b): then the polynomial divides T_b(1 - lambda/2) -+ 1, with Chebyshev's T_b.

    T_(b + 1) = 2 x T_b - T_(b - 1) is computed modulo the polynomial, so all powers are below its degree.
    """
    if not part.get_domain().is_ZZ and not part.get_domain().is_QQ:
        return None
    part = part.to_field()
    one, twice = (Poly(value, _LAMBDA, domain="QQ") for value in (1, 2 - _LAMBDA))
    before, here = one, (twice * Rational(1, 2)).rem(part)
    for b in range(1, FINEST):
        before, here, now = here, (twice * here - before).rem(part), here
        for parity, sign in ((0, 1), (1, -1)) if b > part.degree() else ():
            if now != sign * one:
                continue
            angles = [a * pi / (2 * b) for a in range(b + 1) if a % 2 == parity]
            values = [4 * sin(angle) ** 2 for angle in angles]
            found = [value for value in values if abs(part.eval(value.evalf(30))) < 1e-20]
            return found if len(found) == part.degree() else None
    return None


def _entry_at(entry: Expr, value: Expr) -> Expr:
    """An entry with the value of lambda substituted; for a chain, 4 sin^2 u, with multiple angles instead of powers."""
    roots = [p for p in value.atoms(Pow) if p.exp == Rational(1, 2) and p.has(Symbol)]
    if len(roots) == 1 and (split := value.as_poly(roots[0])) is not None and split.degree() == 1:
        before, plain = split.all_coeffs()
        inner = entry.as_poly(_LAMBDA)
        slope, constant = inner.coeff_monomial(_LAMBDA), inner.coeff_monomial(1)
        return _sum_with_root(constant + slope * plain, slope * before, roots[0])
    if not value.has(sin):
        return tidied(entry.xreplace({_LAMBDA: value}))
    angle = next(iter(value.atoms(sin))).args[0]
    return TR8(entry.xreplace({_LAMBDA: 2 - 2 * cos(2 * angle)}).expand()).expand()


def _null_columns(matrix: MatrixBase, part: Poly) -> list[MatrixBase]:
    """A basis of the null space of the matrix, where lambda is a root of the irreducible polynomial."""
    size = matrix.shape[0]

    def reduced(entry: Expr) -> Poly:
        return Poly(entry, _LAMBDA, domain=field).rem(modulus)

    polynomials = [part, *(Poly(entry, _LAMBDA) for entry in matrix)]
    field, _ = construct_domain([c for each in polynomials for c in each.all_coeffs()], field=True)
    modulus = Poly(part.as_expr(), _LAMBDA, domain=field)
    rows = [[reduced(matrix[i, j]) for j in range(size)] for i in range(size)]
    pivots: list[int] = []
    for j in range(size):
        at = len(pivots)
        chosen = next((i for i in range(at, size) if not _is_nothing(rows[i][j])), None)
        if chosen is None:
            continue
        rows[at], rows[chosen] = rows[chosen], rows[at]
        inverse = invert(rows[at][j], modulus)
        rows[at] = [(entry * inverse).rem(modulus) for entry in rows[at]]
        for i in range(size):
            if i != at and not _is_nothing(rows[i][j]):
                factor = rows[i][j]
                rows[i] = [(a - factor * b).rem(modulus) for a, b in zip(rows[i], rows[at], strict=True)]
        pivots.append(j)
    free = [j for j in range(size) if j not in pivots]
    columns = []
    for j in free:
        entries = [Poly(1 if i == j else 0, _LAMBDA, domain=field) for i in range(size)]
        for row, pivot in enumerate(pivots):
            entries[pivot] = -rows[row][j]
        columns.append(_first_is_one(entries, modulus))
    return columns


def _is_nothing(entry: Poly) -> bool:
    return bool(entry.is_zero) or all(is_zero(c) for c in entry.all_coeffs())


def _first_is_one(entries: list[Poly], modulus: Poly) -> MatrixBase:
    first = next(entry for entry in entries if not _is_nothing(entry))
    inverse = invert(first, modulus)
    return ImmutableDenseMatrix([(entry * inverse).rem(modulus).as_expr() for entry in entries])


def _orthogonal(columns: Iterable[MatrixBase], mass: MatrixBase) -> list[MatrixBase]:
    """Orthogonalise the columns with respect to M by the Gram-Schmidt method."""
    found: list[MatrixBase] = []
    for column in columns:
        for other in found:
            share = (other.T * mass * column)[0] / (other.T * mass * other)[0]
            column = ImmutableDenseMatrix((column - share * other).applyfunc(tidied))
        found.append(column)
    return found


def _presentable(column: MatrixBase) -> MatrixBase:
    """(2, 3) for (1, 3/2), if all entries are rational numbers."""
    if not all(entry.is_Rational for entry in column):
        return column
    return ImmutableDenseMatrix(column * ilcm(1, *(entry.q for entry in column)))


def _size(value: Expr) -> tuple[float, str]:
    letters = sorted(value.free_symbols, key=str)
    drawn = {s: Integer(prime(n + 20)) / prime(20) for n, s in enumerate(letters)}
    number = explicit(value.subs(fulfilling(drawn))).evalf()
    return (float(number) if number.is_real else 0.0), str(value)


def _is_power_of_one_sum(value: Expr) -> bool:
    """Whether the value is like m A^2/(l^2 + m c A)^(3/2): one root of a sum, with no other factor under a root."""
    halves = [p for p in Mul.make_args(value) if not p.as_base_exp()[1].is_Integer]
    return len(halves) == 1 and halves[0].base.is_Add and abs(halves[0].exp) > 1


def root_of(square: Expr) -> Expr:
    """The square root, with one root sign as in sqrt(k/m); a rational root, or one of a sine, is evaluated."""
    drawn = tidied(sqrt(square))
    if drawn == 0 or square.has(sin) or not is_irrational(drawn):
        return drawn
    if _is_power_of_one_sum(drawn):
        return drawn
    number, letters = square.as_coeff_Mul()
    if number != 1 and sqrt(number).is_Rational and not is_irrational(letters):
        return sqrt(number) * RootSign(spread_or_by_terms(letters))
    return RootSign(square if is_irrational(square) else spread_or_by_terms(square))


def is_irrational(value: Expr) -> bool:
    return any(p.exp.is_Rational and not p.exp.is_Integer for p in value.atoms(Pow))
