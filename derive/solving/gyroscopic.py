"""The exact roots of det(K + i omega G - omega^2 M): frequencies with forces linear in the rates that do no work.

G is antisymmetric, so the determinant is a polynomial in omega^2. It often splits into two mirror-image factors in
omega, one for each sense of rotation; then their roots are simpler than the roots in omega^2.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from sympy import Abs, Add, Dummy, Expr, I, ImmutableDenseMatrix, Integer, Mul, Poly, Symbol, cancel, prime, sqrt
from sympy.matrices import MatrixBase
from sympy.polys.constructor import construct_domain
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.amplitudes import determinant_of
from derive.algebra.definite import is_positive_definite, sign_of_form
from derive.algebra.expressions import Relation, explicit
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.solving.characteristic import is_irrational, root_of
from derive.steps.signs import sign_for_all, sign_where
from derive.steps.step import is_zero

LARGEST = 4  # coordinates
OMEGA = Dummy("omega", positive=True)
ZERO = Integer(0)


@dataclass(frozen=True)
class Part:
    """A factor of the determinant: a polynomial in omega^2, or one of two mirror images in omega."""

    polynomial: Poly
    times: int
    mirrored: bool

    @property
    def is_free(self) -> bool:
        return bool(self.polynomial.as_expr() == OMEGA**2)

    @cached_property
    def coefficients(self) -> tuple[Expr, ...]:
        """From the highest power of omega or omega^2 to the lowest, with the first positive if its sign is known."""
        found = self.polynomial.all_coeffs()
        found = found if self.mirrored else found[::2]
        return tuple(-c for c in found) if sign_for_all(found[0]) == -1 else tuple(found)

    @cached_property
    def needs(self) -> tuple[Expr, ...]:
        """Expressions that must be positive for all roots omega to be real, different and nonzero."""
        if self.is_free:
            return ()
        if len(self.coefficients) == 2:
            a, b = self.coefficients
            return (tidied(-a * b),)
        a, b, c = self.coefficients
        discriminant = tidied(b**2 - 4 * a * c)
        return (discriminant,) if self.mirrored else (discriminant, tidied(-a * b), tidied(a * c))


@dataclass(frozen=True)
class Swing:
    """A root: the frequency, and whether it is real (1), zero (0), imaginary (-1, a growth rate) or unknown (None).

    turn   1 or -1: the root of the factor is the frequency or its negative; 0 if this is unknown
    """

    value: Expr
    sign: int | None
    part: Part
    turn: int
    size: float

    @property
    def needs(self) -> tuple[Expr, ...]:
        return self.part.needs if self.sign is None else ()


@dataclass(frozen=True)
class GyroscopicPencil:
    """K + i omega G - omega^2 M, with G antisymmetric."""

    stiffness: MatrixBase
    turning: MatrixBase
    mass: MatrixBase
    exists: Relation | None = None

    @property
    def matrix(self) -> MatrixBase:
        return self.at(OMEGA)

    def at(self, omega: Expr) -> MatrixBase:
        return ImmutableDenseMatrix(self.stiffness + I * omega * self.turning - omega**2 * self.mass)

    @cached_property
    def parts(self) -> tuple[Part, ...]:
        size = self.mass.shape[0]
        if size > LARGEST:
            message = f"the frequencies of {size} coordinates with forces linear in the rates cannot be computed"
            raise Rejected(Complaint("too-large", message))
        s = Dummy("s")
        whole = Poly(determinant_of(ImmutableDenseMatrix(self.stiffness + s * self.turning + s**2 * self.mass)), s)
        even = Add(*(c * (-1) ** (n // 2) * OMEGA**n for (n,), c in whole.terms()))
        try:
            found = Poly(even, OMEGA).factor_list()[1]
        except PolynomialError:
            found = []
        if sum(part.degree() * times for part, times in found) != 2 * size:
            raise Rejected(Complaint("no-closed-form", "the determinant is not a polynomial that can be factored"))
        return tuple(self._parts(found))

    def _parts(self, found: list[tuple[Poly, int]]) -> list[Part]:
        parts: list[Part] = []
        mirrors: list[Expr] = []
        for part, times in found:
            mirror = part.as_expr().subs(OMEGA, -OMEGA)
            if part.degree() == 1 and is_zero(part.eval(0)):
                parts.append(Part(Poly(OMEGA**2, OMEGA), times // 2, False))
            elif is_zero((mirror - part.as_expr()).expand()):
                parts.append(Part(part, times, False))
            elif not any(is_zero((each - part.as_expr()).expand()) for each in mirrors):
                mirrors += [mirror.expand(), (-mirror).expand()]
                if part.degree() == 1:
                    parts.append(Part(Poly((part.as_expr() * mirror).expand(), OMEGA), times, False))
                else:
                    parts.append(Part(self._forwards(part), times, True))
        return parts

    def _forwards(self, part: Poly) -> Poly:
        """Of two mirror images, the one whose roots have a positive sum, if this is known."""
        a, b = part.all_coeffs()[:2]
        return Poly(part.as_expr().subs(OMEGA, -OMEGA), OMEGA) if sign_for_all(tidied(b / a)) == 1 else part

    @cached_property
    def is_minimum(self) -> bool:
        """Whether the energy has a minimum at rest and the kinetic energy is never negative: then no motion grows."""
        return is_positive_definite(self.stiffness, self.sign) and sign_of_form(self.mass, self.sign) in (0, 1)

    def sign(self, value: Expr) -> int | None:
        return 0 if is_zero(value) else sign_where(value, self.exists)

    @cached_property
    def swings(self) -> tuple[Swing, ...]:
        """The roots in ascending order for ordinary values of the symbols."""
        return tuple(sorted((s for part in self.parts for s in self._swings(part)), key=lambda swing: swing.size))

    def _swings(self, part: Part) -> list[Swing]:
        if part.is_free:
            return [Swing(ZERO, 0, part, 1, 0.0)]
        if len(part.coefficients) > 3:
            message = (
                f"{len(part.coefficients) - 1} of the frequencies are the roots of a polynomial that does not factor"
            )
            raise Rejected(Complaint("no-closed-form", message, help="with equal masses and springs it may factor"))
        return self._mirrored(part) if part.mirrored else self._by_squares(part)

    def _mirrored(self, part: Part) -> list[Swing]:
        """The frequencies |omega| for a omega^2 - b omega + c = 0, with omega = (b +- sqrt(b^2 - 4 a c))/2a."""
        _, minus_b, c = part.coefficients
        (discriminant,) = part.needs
        real = self._is_real(discriminant)
        both_ways = self.sign(tidied(c))
        if both_ways == -1:  # one root of each sign: the sizes do not depend on the sign of b
            pairs = [((-1, 1), -1), ((1, 1), 1)]
            return [self._swing(part, tidied(-minus_b), ways, real, turn) for ways, turn in pairs]
        forwards = self.sign(tidied(-minus_b)) == 1
        middle = tidied(-minus_b) if forwards else Abs(tidied(minus_b))
        slow = self._swing(part, middle, (1, -1), real, int(forwards))
        fast = self._swing(part, middle, (1, 1), real, int(forwards))
        return [slow if both_ways == 1 else replace(slow, value=Abs(slow.value), turn=0), fast]

    def _swing(self, part: Part, middle: Expr, ways: tuple[int, int], real: int | None, turn: int) -> Swing:
        value = _sum_with_root(middle, part.coefficients[0], part.needs[0], ways)
        return Swing(value, real, part, turn, abs(_size(value)))

    def _is_real(self, discriminant: Expr) -> int | None:
        sign = self.sign(discriminant)
        if sign == -1:
            message = "there is no normal mode: two motions of the same frequency spiral, one outwards and one inwards"
            raise Rejected(Complaint("no-oscillation", message, help="use `stability` instead"))
        return 1 if sign == 1 or self.is_minimum else None

    def _by_squares(self, part: Part) -> list[Swing]:
        if len(part.coefficients) == 2:
            a, b = part.coefficients
            squares = [tidied(-b / a)]
        else:
            a, b, _ = part.coefficients
            self._is_real(part.needs[0])
            squares = [_sum_with_root(tidied(-b), a, part.needs[0], (1, way)) for way in (-1, 1)]
        found = []
        for square in squares:
            sign = 1 if self.is_minimum else self._sign_of_square(square, part)
            value = root_of(-square if sign == -1 else square)
            found.append(Swing(value, sign, part, 1, _size(value)))
        return found

    def _sign_of_square(self, square: Expr, part: Part) -> int | None:
        """The sign of a root of a z^2 + b z + c: both are positive if all `needs` are; one is positive if a c < 0."""
        if all(self.sign(need) == 1 for need in part.needs):
            return 1
        if len(part.needs) == 3 and self.sign(part.needs[2]) == -1:
            return 1 if _size(square) > 0 else -1
        return -1 if len(part.needs) == 1 and self.sign(part.needs[0]) == -1 else None

    def column(self, swing: Swing) -> tuple[Expr, ...] | None:
        """The amplitudes in terms of the root OMEGA; the first nonzero amplitude is 1. None if there is not exactly
        one column, or if an amplitude is neither real nor imaginary.

        For a growing motion OMEGA is the rate kappa, with omega = -i kappa: e^(i omega t) = e^(kappa t).
        """
        if swing.part.times > 1 or swing.sign == 0 or not swing.turn:
            return None
        modulus = swing.part.polynomial
        adjugate = self.matrix.adjugate()
        for k in range(self.mass.shape[0]):
            entries = [_reduced(adjugate[j, k], modulus) for j in range(self.mass.shape[0])]
            first = next((j for j, e in enumerate(entries) if not is_zero(e)), None)
            if first is None:
                continue
            known = {OMEGA: explicit(swing.value)} if not is_irrational(explicit(swing.value)) else {}
            if swing.sign == -1:
                entries = [e.subs(OMEGA, -I * OMEGA).expand() for e in entries]
            ratios = tuple(ZERO if is_zero(e) else _tidy_ratio((e / entries[first]).subs(known)) for e in entries)
            return ratios if all(_is_plain(r) and not r.has(Abs) for r in ratios) else None
        return None


def _reduced(entry: Expr, modulus: Poly) -> Expr:
    """A polynomial in the root, reduced modulo the polynomial of this root."""
    parts = [Poly(p.expand(), OMEGA) for p in entry.expand().as_real_imag()]
    field, _ = construct_domain([c for each in (modulus, *parts) for c in each.all_coeffs()], field=True)
    over = Poly(modulus.as_expr(), OMEGA, domain=field)
    real, imaginary = (Poly(p.as_expr(), OMEGA, domain=field).rem(over).as_expr() for p in parts)
    return real + I * imaginary


def _tidy_ratio(ratio: Expr) -> Expr:
    value = cancel(ratio)
    plain = cancel(value / I)
    return I * tidied(plain) if not plain.has(I) else tidied(value) if not value.has(I) else value


def _is_plain(ratio: Expr) -> bool:
    return not ratio.has(I) or not (ratio / I).has(I)


def _sum_with_root(middle: Expr, a: Expr, discriminant: Expr, ways: tuple[int, int]) -> Expr:
    """(b +- sqrt(D))/2a, or b/2a +- sqrt(D/4a^2), whichever is shorter."""
    one, other = ways
    inside = Add(*(tidied(term / (4 * a**2)) for term in Add.make_args(discriminant.expand())))
    apart = one * tidied(middle / (2 * a)) + other * root_of(inside)
    below = tidied((one * middle + other * sqrt(discriminant)) / (2 * a))
    return min((apart, below), key=lambda form: int(explicit(form).count_ops()))


def _size(value: Expr) -> float:
    letters = sorted(value.free_symbols, key=str)
    number = explicit(value).subs({s: Integer(prime(n + 20)) / prime(20) for n, s in enumerate(letters)}).evalf()
    return float(number) if number.is_real else 0.0


def factored(parts: tuple[Part, ...], letter: Symbol) -> Expr:
    """The determinant up to a constant factor, factored."""
    found = []
    for part in parts:
        value = Add(*(c * OMEGA**n for n, c in zip(_powers(part), part.coefficients, strict=True)))
        both = (value, Add(*(c * (-OMEGA) ** n for n, c in zip(_powers(part), part.coefficients, strict=True))))
        found += [
            tidied(each).xreplace({OMEGA: letter}) ** part.times for each in (both if part.mirrored else both[:1])
        ]
    return Mul(*found)


def _powers(part: Part) -> list[int]:
    count = len(part.coefficients)
    return [(count - 1 - i) * (1 if part.mirrored else 2) for i in range(count)]
