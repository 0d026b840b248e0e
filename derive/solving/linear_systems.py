"""Linear systems M q_ddot + (G + C) q_dot + K q = 0: the characteristic equation, its roots, and the mode shapes.

The matrix G is antisymmetric and describes forces that do no work; the matrix C is symmetric and describes drag. A
motion a e^(s t) with a column a of amplitudes is possible if det(M s^2 + (G + C) s + K) = 0. There are three classes of
systems:

conservative   without G and C: the determinant is a polynomial in lambda = omega^2, where s = i omega; the columns a
               are real
gyroscopic     without C: the determinant is a polynomial in omega^2. This polynomial may be the product of a polynomial
               in omega and its mirror image, one for each sense of rotation; the roots then have simpler formulas
damped         the determinant is a polynomial in s; its factors must be linear or quadratic
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any, TypeVar

from sympy import (
    Abs,
    Add,
    Dummy,
    Expr,
    I,
    ImmutableDenseMatrix,
    Integer,
    Mul,
    Poly,
    Pow,
    Rational,
    Symbol,
    cancel,
    cos,
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
from sympy.simplify.fu import TR8

from derive.algebra.amplitudes import determinant_of
from derive.algebra.collect import spread, spread_or_by_terms
from derive.algebra.definite import is_positive_definite, sign_of_form
from derive.algebra.expressions import Relation, Root, explicit, scalar
from derive.algebra.length import length
from derive.algebra.ordered_roots import OrderedRoot
from derive.algebra.ranges import fulfilling
from derive.algebra.tidy import common_factor, tidied
from derive.errors import Complaint, Rejected
from derive.solving.presentation import by_one_square
from derive.steps.signs import sign_for_all, sign_where
from derive.steps.step import is_zero

ZERO = Integer(0)
LAMBDA, OMEGA, S = (
    Dummy("lambda"),
    Dummy("omega", positive=True),
    Dummy("s", real=True),
)  # the symbol of the root in each of the three classes
# conservative systems: greatest number of coordinates; for more than three coordinates, also the greatest product of
# the number of coordinates and the number of symbols
LARGEST, LETTERS = 12, 40
LARGEST_WITH_RATES = 4  # greatest number of coordinates of any other system
FINEST = 60  # for a uniform chain, the angles (a/b) (pi/2) are tried with whole numbers b below this number


@dataclass(frozen=True)
class Factor:
    """An irreducible factor of the determinant. It is a polynomial in the unknown of the characteristic equation.

    coefficients   from the highest power down; the first coefficient is positive if its sign is known
    times          the power of the factor in the determinant
    even           whether only even powers of omega occur; the coefficients then belong to a polynomial in omega^2
    mirrored       whether the factor also represents its mirror image, in which omega is replaced by -omega
    """

    coefficients: tuple[Expr, ...]
    times: int
    even: bool = False
    mirrored: bool = False

    @classmethod
    def of(cls, polynomial: Poly, times: int, **more: bool) -> Factor:
        found = polynomial.all_coeffs()[:: 2 if more.get("even") else 1]
        return cls(tuple(-c for c in found) if sign_for_all(found[0]) == -1 else tuple(found), times, **more)

    @property
    def degree(self) -> int:
        return len(self.coefficients) - 1

    @property
    def is_free(self) -> bool:
        """Whether zero is the only root of the factor."""
        return all(is_zero(c) for c in self.coefficients[1:])

    @cached_property
    def discriminant(self) -> Expr:
        a, b, c = self.coefficients
        return tidied(b**2 - 4 * a * c)

    @cached_property
    def needs(self) -> tuple[Expr, ...]:
        """Expressions that must be positive for real and distinct roots omega."""
        if self.is_free:
            return ()
        a, b, *rest = self.coefficients
        if not rest:
            return (tidied(-a * b),)
        return (self.discriminant,) if self.mirrored else (self.discriminant, tidied(-a * b), tidied(a * rest[0]))

    def at(self, root: Expr) -> Expr:
        powers = range(self.degree, -1, -1)
        return Add(*(c * root ** (2 * n if self.even else n) for n, c in zip(powers, self.coefficients, strict=True)))

    def written(self, letter: Symbol) -> Expr:
        """The factor as part of the determinant, with its mirror image if it has one."""
        return Mul(*(tidied(self.at(way * letter)) ** self.times for way in ((1, -1) if self.mirrored else (1,))))


@dataclass(frozen=True)
class CharacteristicRoot:
    """A root of the characteristic equation.

    value     for a conservative system, lambda = omega^2; for a gyroscopic system, the frequency or the rate of growth.
              For a damped system, the rate of decay: b/(2 a) for a quadratic factor and b/a for a linear factor
    sign      1 if the motion oscillates, 0 if omega = 0, -1 if it grows; None if this is unknown. For a damped system:
              1 if the motion is underdamped, 0 if critically damped, -1 if overdamped; the sign of b/a for a linear
              factor
    columns   the mode shapes of a conservative system, orthogonal with respect to M; empty if the root has no formula
    turn      1 if the frequency is a root of the factor, -1 if minus the frequency is a root; 0 if this is unknown
    """

    value: Expr
    sign: int | None
    factor: Factor
    columns: tuple[MatrixBase, ...] = ()
    turn: int = 1

    @property
    def times(self) -> int:
        return self.factor.times

    @property
    def has_formula(self) -> bool:
        return self.factor.degree < 3 or bool(self.columns)

    @property
    def needs(self) -> tuple[Expr, ...]:
        """Expressions that must be positive for an oscillation; empty if the sign of the root is known."""
        return self.factor.needs if self.sign is None else ()


Kind = TypeVar("Kind", bound="LinearSystem")


@dataclass(frozen=True)
class LinearSystem:
    """The matrices M, G + C and K; the condition `exists`, if it is given, is assumed to be true."""

    mass: MatrixBase
    turning: MatrixBase
    stiffness: MatrixBase
    exists: Relation | None = None

    @property
    def letters(self) -> set[Symbol]:
        return {s for each in (self.mass, self.turning, self.stiffness) for s in each.free_symbols}

    @property
    def is_conservative(self) -> bool:
        return is_zero(self.turning)

    @property
    def is_gyroscopic(self) -> bool:
        """Whether the forces linear in the rates do no work."""
        return is_zero((self.turning + self.turning.T).applyfunc(tidied))

    def at(self, s: Expr) -> MatrixBase:
        return ImmutableDenseMatrix(self.mass * s**2 + self.turning * s + self.stiffness)

    def sign(self, value: Expr) -> int | None:
        """The sign of an expression, given the condition `exists`; None if the sign is unknown."""
        return 0 if is_zero(value) else sign_where(value, self.exists)

    @cached_property
    def is_minimum(self) -> bool:
        """Whether the potential energy is known to have a minimum and the kinetic energy is known to be nowhere
        negative; then no motion grows.
        """
        return is_positive_definite(self.stiffness, self.sign) and sign_of_form(self.mass, self.sign) in (0, 1)

    def written(self, letter: Symbol) -> Expr:
        """The determinant as a product of its factors; a constant factor may be missing."""
        return Mul(*(each.written(letter) for each in self.factors))

    def of_kind(self, kind: type[Kind], **more: Any) -> Kind:
        """The system of the given class with the same matrices."""
        return kind(self.mass, self.turning, self.stiffness, self.exists, **more)

    @cached_property
    def factors(self) -> tuple[Factor, ...]:
        """The irreducible factors of the determinant, which is a polynomial whose zeros are the roots."""
        raise NotImplementedError  # a system whose class is still unknown has matrices, but no roots

    @cached_property
    def roots(self) -> tuple[CharacteristicRoot, ...]:
        """The roots in ascending order for typical values of the symbols."""
        return tuple(sorted((root for each in self.factors for root in self._roots_of(each)), key=in_order))

    def _roots_of(self, factor: Factor) -> list[CharacteristicRoot]:
        raise NotImplementedError  # each class of systems finds its roots in its own way

    @staticmethod
    def _factored(determinant: Expr, root: Symbol, degree: int) -> list[tuple[Poly, int]]:
        """The irreducible factors of the determinant, each with its power. Rejects a determinant that is not a
        polynomial of this degree."""
        try:
            found = Poly(determinant, root).factor_list()[1]
        except PolynomialError:
            found = []
        if sum(part.degree() * times for part, times in found) != degree:
            message = f"the determinant is not a polynomial of degree {degree} that can be factored"
            raise Rejected(Complaint("no-closed-form", message))
        return [(part, times) for part, times in found]


def in_order(root: CharacteristicRoot) -> tuple[bool, float, str]:
    """Return the key that sorts roots in ascending order for typical values of the symbols; roots without a formula
    come last."""
    size = size_of(root.value)
    return not root.has_formula, size, str(root.value) if size else ""


def _check_size(size: int, fits: bool, what: str, help: str | None = None) -> None:
    if not fits:
        message = f"the frequencies of {size} coordinates {what} cannot be computed"
        raise Rejected(Complaint("too-large", message, help=help))


# --- conservative systems ---------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Conservative(LinearSystem):
    """A conservative system: its matrix is K - lambda M, with symmetric K and M.

    The entries of a mode shape are polynomials in lambda modulo the irreducible factor whose root is lambda. So it is
    decided exactly whether a pivot vanishes.

    name   the name of the numbered roots of a factor without root formulas; by default such a factor is rejected
    """

    name: str = ""

    @cached_property
    def scale(self) -> Expr:
        """The unit of lambda, such as k/m: the common factor of K divided by the common factor of M."""
        return common_factor(list(self.stiffness)) / common_factor(list(self.mass))

    @cached_property
    def _reduced(self) -> tuple[MatrixBase, MatrixBase]:
        parts = (each / common_factor(list(each)) for each in (self.stiffness, self.mass))
        stiffness, mass = (ImmutableDenseMatrix(part.applyfunc(tidied)) for part in parts)
        return stiffness, mass

    @cached_property
    def factors(self) -> tuple[Factor, ...]:
        """The irreducible factors of the determinant, polynomials in lambda/scale."""
        stiffness, mass = self._reduced
        size = stiffness.shape[0]
        _check_size(size, size <= LARGEST, f"(more than {LARGEST})")
        fits = size <= 3 or size * len((stiffness + mass).free_symbols) <= LETTERS
        _check_size(size, fits, "with this many symbols", "use one symbol for equal masses or equal springs")
        found = self._factored(determinant_of(stiffness - LAMBDA * mass), LAMBDA, size)
        return tuple(Factor.of(part, times) for part, times in found)

    def written(self, letter: Symbol) -> Expr:
        parts = []
        for each in self.factors:
            above = tidied(each.at(letter**2 / self.scale)).as_numer_denom()[0]
            parts.append(_by_powers(above.as_independent(letter, as_Add=False)[1], letter) ** each.times)
        return Mul(*parts)

    def _roots_of(self, factor: Factor) -> list[CharacteristicRoot]:
        values = _values_of(factor)
        if values is not None:
            return [self._root(factor, value) for value in values]
        coefficients = Poly(tidied(factor.at(LAMBDA / self.scale) * self.scale**factor.degree), LAMBDA).all_coeffs()
        alone = [each for each in self.factors if _values_of(each) is None] == [factor]
        if not self.name or factor.times > 1 or not alone or not self._are_positive(coefficients):
            message = f"the squares of {factor.degree} frequencies are the roots of a polynomial that does not factor"
            help_ = "use one symbol for equal masses or equal springs, or give numbers to all masses and springs"
            if self.name:
                help_ = "numbers help only if the equilibrium is stable and if there is only one such polynomial"
            raise Rejected(Complaint("no-closed-form", message, help=help_))
        names = [scalar(f"{self.name}_{n + 1}") for n in range(factor.degree)]
        return [CharacteristicRoot(OrderedRoot(coefficients, n + 1, name), 1, factor) for n, name in enumerate(names)]

    def _are_positive(self, coefficients: Sequence[Expr]) -> bool:
        """Whether all roots of the polynomial are known to be positive.

        The roots are real if M is positive definite. By Descartes' rule, no real root is negative or zero if the signs
        of the coefficients alternate.
        """
        signs = [self.sign(tidied(each)) for each in coefficients]
        alternate = None not in signs and 0 not in signs and all(u == -v for u, v in pairwise(signs))  # type: ignore[operator]
        return alternate and is_positive_definite(self.mass, self.sign)

    def _root(self, factor: Factor, value: Expr) -> CharacteristicRoot:
        stiffness, mass = self._reduced
        columns = [
            ImmutableDenseMatrix(column.applyfunc(lambda entry: _entry_at(entry, value)))
            for column in _null_columns(stiffness - LAMBDA * mass, Poly(factor.at(LAMBDA), LAMBDA))
        ]
        if len(columns) != factor.times:
            raise Rejected(Complaint("no-closed-form", "a repeated frequency has too few independent mode shapes"))
        exact = by_one_square(tidied(self.scale * value))
        sign = self.sign(exact)
        sign = 1 if sign is None and self.is_minimum else sign
        return CharacteristicRoot(exact, sign, factor, tuple(_presentable(c) for c in _orthogonal(columns, mass)))


def _by_powers(value: Expr, letter: Symbol) -> Expr:
    """Collect a polynomial by powers of the symbol if this is shorter.

    The sign of the polynomial may change.
    """
    polynomial = value.as_poly(letter)
    if polynomial is None:
        return value
    if polynomial.LC().could_extract_minus_sign():
        value, polynomial = -value, -polynomial
    return min((Add(*(factor(c) * letter**n for (n,), c in polynomial.terms())), value), key=length)


def _values_of(factor: Factor) -> list[Expr] | None:
    """The roots of a linear or quadratic factor, or of the factor of a uniform chain; else None."""
    if factor.degree > 2:
        return _of_chain(Poly(factor.at(LAMBDA), LAMBDA))
    a, b, *rest = factor.coefficients
    if not rest:
        return [by_one_square(tidied(-b / a))]
    root = sqrt(_discriminant(a, b, rest[0]))
    return [_with_root(-b / (2 * a), turn / (2 * a), root) for turn in (-1, 1)]


def _discriminant(a: Expr, b: Expr, c: Expr) -> Expr:
    """The discriminant b^2 - 4 a c in the shorter of two forms."""
    common = gcd(b**2, a * c)
    apart = factor(common) * (factor(b**2 / common) - 4 * factor(a * c / common))
    return min((tidied(b**2 - 4 * a * c), apart), key=length)


def _of_chain(part: Poly) -> list[Expr] | None:
    """The roots 4 sin^2(a pi/(2 b)), with integers a and b < `FINEST`, of the polynomial of a uniform chain, or None.

    Such a polynomial divides T_b(1 - lambda/2) -+ 1, where T_b is a Chebyshev polynomial. The recursion T_(b + 1) = 2 x
    T_b - T_(b - 1) is computed modulo this polynomial.
    """
    if not part.get_domain().is_ZZ and not part.get_domain().is_QQ:
        return None
    part = part.to_field()
    one, twice = (Poly(value, LAMBDA, domain="QQ") for value in (1, 2 - LAMBDA))
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
    """Substitute the value of lambda into an entry."""
    roots = [p for p in value.atoms(Pow) if p.exp == Rational(1, 2) and p.has(Symbol)]
    if len(roots) == 1 and (split := value.as_poly(roots[0])) is not None and split.degree() == 1:
        before, plain = split.all_coeffs()
        inner = entry.as_poly(LAMBDA)
        slope, constant = inner.coeff_monomial(LAMBDA), inner.coeff_monomial(1)
        return _with_root(constant + slope * plain, slope * before, roots[0])
    if value.free_symbols or not value.has(sin):
        return tidied(entry.xreplace({LAMBDA: value}))
    angle = next(iter(value.atoms(sin))).args[0]
    return TR8(entry.xreplace({LAMBDA: 2 - 2 * cos(2 * angle)}).expand()).expand()


def _null_columns(matrix: MatrixBase, part: Poly) -> list[MatrixBase]:
    """A basis of the null space of the matrix, where lambda is a root of the irreducible polynomial `part`."""
    size, root = matrix.shape[0], part.gen

    def reduced(entry: Expr) -> Poly:
        return Poly(entry, root, domain=field).rem(modulus)

    polynomials = [part, *(Poly(entry, root) for entry in matrix)]
    field, _ = construct_domain([c for each in polynomials for c in each.all_coeffs()], field=True)
    modulus = Poly(part.as_expr(), root, domain=field)
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
        entries = [Poly(1 if i == j else 0, root, domain=field) for i in range(size)]
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
    """Clear the denominators if all entries are rational numbers: (2, 3) for (1, 3/2)."""
    if not all(entry.is_Rational for entry in column):
        return column
    return ImmutableDenseMatrix(column * ilcm(1, *(entry.q for entry in column)))


# --- gyroscopic systems -----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Gyroscopic(LinearSystem):
    """A gyroscopic system: its matrix is K + i omega G - omega^2 M, with antisymmetric G."""

    @cached_property
    def factors(self) -> tuple[Factor, ...]:
        """The factors of the determinant, polynomials in omega^2 or pairs of mirror images in omega."""
        size = self.mass.shape[0]
        _check_size(size, size <= LARGEST_WITH_RATES, "with forces linear in the rates")
        whole = Poly(determinant_of(self.at(S)), S)
        even = Add(*(c * (-1) ** (n // 2) * OMEGA**n for (n,), c in whole.terms()))
        found: list[Factor] = []
        mirrors: list[Expr] = []
        for part, times in self._factored(even, OMEGA, 2 * size):
            own, mirror = part.as_expr(), part.as_expr().subs(OMEGA, -OMEGA)
            if part.degree() == 1 and is_zero(part.eval(0)):
                found.append(Factor.of(part**2, times // 2, even=True))
            elif is_zero((mirror - own).expand()):
                found.append(Factor.of(part, times, even=True))
            elif not any(is_zero((other - own).expand()) for other in mirrors):
                mirrors += [mirror.expand(), (-mirror).expand()]
                if part.degree() == 1:
                    found.append(Factor.of(Poly((own * mirror).expand(), OMEGA), times, even=True))
                else:
                    found.append(Factor.of(self._forwards(part), times, mirrored=True))
        return tuple(found)

    @staticmethod
    def _forwards(part: Poly) -> Poly:
        a, b = part.all_coeffs()[:2]
        return Poly(part.as_expr().subs(OMEGA, -OMEGA), OMEGA) if sign_for_all(tidied(b / a)) == 1 else part

    def _roots_of(self, factor: Factor) -> list[CharacteristicRoot]:
        if factor.is_free:
            return [CharacteristicRoot(ZERO, 0, factor)]
        count = factor.degree
        if count > 2:
            message = f"{count} of the frequencies are the roots of a polynomial that does not factor"
            raise Rejected(
                Complaint("no-closed-form", message, help="with equal masses and springs the polynomial may factor")
            )
        return self._mirrored(factor) if factor.mirrored else self._by_squares(factor)

    def _mirrored(self, factor: Factor) -> list[CharacteristicRoot]:
        """The frequencies |omega|, where omega is a root of the polynomial a omega^2 - b omega + c:
        omega = (b +- sqrt(b^2 - 4 a c))/(2 a)."""
        a, minus_b, c = factor.coefficients
        real, both_ways = self._is_real(factor), self.sign(tidied(c))
        middle, root = tidied(-minus_b), sqrt(factor.discriminant)

        def found(middle: Expr, ways: tuple[int, int], turn: int) -> CharacteristicRoot:
            value = _with_root(ways[0] * middle / (2 * a), ways[1] / (2 * a), root, by_terms=True)
            return CharacteristicRoot(value, real, factor, turn=turn)

        if both_ways == -1:  # the roots have opposite signs, and the sign of b does not change their absolute values
            return [found(middle, (-1, 1), -1), found(middle, (1, 1), 1)]
        forwards = self.sign(middle) == 1
        middle = middle if forwards else Abs(tidied(minus_b))
        slow, fast = (found(middle, (1, way), int(forwards)) for way in (-1, 1))
        return [slow if both_ways == 1 else replace(slow, value=Abs(slow.value), turn=0), fast]

    def _is_real(self, factor: Factor) -> int | None:
        sign = self.sign(factor.discriminant)
        if sign == -1:
            message = (
                "one motion spirals outwards, and another motion of the same frequency spirals inwards, "
                "so these motions are not normal modes"
            )
            raise Rejected(Complaint("no-oscillation", message, help="use `stability` instead"))
        return 1 if sign == 1 or self.is_minimum else None

    def _by_squares(self, factor: Factor) -> list[CharacteristicRoot]:
        a, b, *rest = factor.coefficients
        squares = [tidied(-b / a)]
        if rest:
            self._is_real(factor)
            root = sqrt(factor.discriminant)
            squares = [_with_root(-b / (2 * a), way / (2 * a), root, by_terms=True) for way in (-1, 1)]
        signs = [1 if self.is_minimum else self._sign_of_square(square, factor) for square in squares]
        both = zip(squares, signs, strict=True)
        return [CharacteristicRoot(root_of(-square if sign == -1 else square), sign, factor) for square, sign in both]

    def _sign_of_square(self, square: Expr, factor: Factor) -> int | None:
        """The sign of `square`, a root of the polynomial a z^2 + b z + c with z = omega^2; None if the sign is unknown.

        Both roots are positive if all `needs` are positive; exactly one root is positive if a c < 0.
        """
        signs = [self.sign(need) for need in factor.needs]
        if all(sign == 1 for sign in signs):
            return 1
        if len(signs) == 3 and signs[2] == -1:
            return 1 if size_of(square) > 0 else -1
        return -1 if signs == [-1] else None

    def column(self, root: CharacteristicRoot) -> tuple[Expr, ...] | None:
        """The amplitudes in terms of the root OMEGA, or in terms of its formula if this formula is rational; the first
        nonzero amplitude is 1.

        Return None if the root is repeated or zero, if its `turn` is unknown, or if no simple form is found. For
        a growing motion OMEGA is the rate kappa, with omega = -i kappa: e^(i omega t) = e^(kappa t).
        """
        if root.times > 1 or root.sign == 0 or not root.turn:
            return None
        modulus, adjugate, size = (
            Poly(root.factor.at(OMEGA), OMEGA),
            self.at(I * OMEGA).adjugate(),
            len(self.mass[:, 0]),
        )
        columns = ([_remainder(adjugate[j, k], modulus) for j in range(size)] for k in range(size))
        entries = next((column for column in columns if not is_zero(ImmutableDenseMatrix(column))), [])
        first = next((entry for entry in entries if not is_zero(entry)), None)
        ratios = [ZERO if is_zero(entry) else entry / first for entry in entries]
        if root.sign == -1:
            ratios = [ratio.subs(OMEGA, -I * OMEGA) for ratio in ratios]
        if not is_irrational(value := explicit(root.value)):
            ratios = [ratio.subs(OMEGA, value) for ratio in ratios]
        tidy = tuple(map(_tidy_ratio, ratios))
        is_mixed = any(r.has(I) and (r / I).has(I) or r.has(Abs) for r in tidy)
        return tidy if tidy and not is_mixed else None


def _remainder(entry: Expr, modulus: Poly) -> Expr:
    """Reduce the real and imaginary parts of a polynomial in OMEGA modulo the polynomial `modulus`."""
    parts = [Poly(part.expand(), OMEGA) for part in entry.expand().as_real_imag()]
    field, _ = construct_domain([c for each in (modulus, *parts) for c in each.all_coeffs()], field=True)
    over = Poly(modulus.as_expr(), OMEGA, domain=field)
    real, imaginary = (Poly(part.as_expr(), OMEGA, domain=field).rem(over).as_expr() for part in parts)
    return real + I * imaginary


def _tidy_ratio(ratio: Expr) -> Expr:
    value = cancel(ratio)
    plain = cancel(value / I)
    return I * tidied(plain) if not plain.has(I) else tidied(value) if not value.has(I) else value


# --- damped systems ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Damped(LinearSystem):
    """A damped system: its matrix is M s^2 + (G + C) s + K.

    The factor a s^2 + b s + c of the determinant has the roots -b/(2 a) +- i omega, with omega^2 = c/a - b^2/(4 a^2).
    """

    @cached_property
    def factors(self) -> tuple[Factor, ...]:
        """The factors of the determinant, each linear or quadratic in s. Rejects a determinant with any other
        factor."""
        size = self.mass.shape[0]
        _check_size(size, size <= LARGEST_WITH_RATES, "with drag")
        found = [Factor.of(*each) for each in self._factored(determinant_of(self.at(S)), S, 2 * size)]
        worst = max(each.degree for each in found)
        if worst > 2:
            help_line = "with two equal masses, equal springs and equal drags the polynomial may factor"
            message = f"with this drag {worst} exponents are the roots of a polynomial that does not factor"
            raise Rejected(Complaint("no-closed-form", message, help=help_line))
        return tuple(sorted(found, key=lambda each: (not each.is_free, each.degree, len(str(each.at(S))))))

    @cached_property
    def roots(self) -> tuple[CharacteristicRoot, ...]:
        """One `CharacteristicRoot` for each factor, in the order of the factors."""
        return tuple(map(self._root, self.factors))

    def _root(self, factor: Factor) -> CharacteristicRoot:
        a, b = factor.coefficients[:2]
        if factor.degree == 2:
            return CharacteristicRoot(tidied(b / (2 * a)), self.sign(-factor.discriminant), factor)
        return CharacteristicRoot(tidied(b / a), self.sign(tidied(b / a)), factor)

    def square(self, root: CharacteristicRoot) -> Expr:
        """Return omega^2 for a quadratic factor."""
        a, b, c = root.factor.coefficients
        return spread(c / a) - spread(b**2 / (4 * a**2))

    def column(self, root: CharacteristicRoot) -> MatrixBase | None:
        """The amplitudes, if they do not depend on the exponent.

        Return None if the amplitudes depend on the exponent, if the root is repeated, or if there is not exactly one
        column.
        """
        columns = _null_columns(self.at(S), Poly(root.factor.at(S), S)) if root.times == 1 else []
        return None if len(columns) != 1 or columns[0].has(S) else ImmutableDenseMatrix(columns[0].applyfunc(tidied))


# --- how roots are written --------------------------------------------------------------------------------------------


def _with_root(plain: Expr, before: Expr, root: Expr, by_terms: bool = False) -> Expr:
    """Write u + v sqrt(D) in the shortest of a few forms, with u = `plain`, v = `before` and sqrt(D) = `root`.

    by_terms   whether u +- sqrt(v^2 D) is also tried
    """
    below = lcm(*(fraction(together(part))[1] for part in (plain, before)))
    apart = (factor(plain * below) + factor(before * below) * root) / factor(below)
    forms = [tidied(plain + before * root), apart]
    if by_terms:
        inside = Add(*(tidied(term * before**2) for term in Add.make_args((root**2).expand())))
        forms.insert(0, tidied(plain) + (-1 if before.could_extract_minus_sign() else 1) * root_of(inside))
    return min(forms, key=length)


def size_of(value: Expr) -> float:
    """The value of an expression for fixed typical values of the symbols; 0 if it is not real."""
    letters = sorted(value.free_symbols, key=str)
    drawn = {s: Integer(prime(n + 20)) / prime(20) for n, s in enumerate(letters)}
    number = explicit(value.subs(fulfilling(drawn))).evalf()
    return float(number) if number.is_real else 0.0


def _is_power_of_one_sum(value: Expr) -> bool:
    """Whether the only root in the product is a power of a sum with an exponent above 1 or below -1, such as
    m A^2/(l^2 + m c A)^(3/2)."""
    halves = [p for p in Mul.make_args(value) if not p.as_base_exp()[1].is_Integer]
    return len(halves) == 1 and halves[0].base.is_Add and abs(halves[0].exp) > 1


def root_of(square: Expr) -> Expr:
    """Return the square root, if possible with one root sign, as in sqrt(k/m)."""
    drawn = tidied(sqrt(square))
    if drawn == 0 or not any(p.free_symbols for p in _roots_in(drawn)):  # sqrt(3) Omega
        return drawn
    if _is_power_of_one_sum(drawn):
        return drawn
    number, letters = square.as_coeff_Mul()
    if number != 1 and sqrt(number).is_Rational and not is_irrational(letters):
        whole = sqrt(number) * Root(spread_or_by_terms(letters))
    else:
        whole = Root(square if is_irrational(square) else spread_or_by_terms(square))
    return min((drawn, whole), key=length) if square.has(sin) else whole


def is_irrational(value: Expr) -> bool:
    return bool(_roots_in(value))


def _roots_in(value: Expr) -> list[Expr]:
    return [p for p in value.atoms(Pow) if p.exp.is_Rational and not p.exp.is_Integer]
