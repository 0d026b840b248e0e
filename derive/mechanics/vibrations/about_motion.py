"""A steady motion with small oscillations about it: its constant quantities, and the growth of displacements.

Source: Landau, Lifshitz, *Mechanics*, sections 14 and 23.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace

from sympy import Add, Dummy, Expr, ImmutableDenseMatrix, Integer, Symbol, expand

from derive.algebra.amplitudes import determinant_of
from derive.algebra.expressions import bound, explicit, rate
from derive.algebra.taylor import slope
from derive.errors import Complaint, Rejected
from derive.mechanics.hamilton.facts import ReducedMatter
from derive.mechanics.model.dalembert import Matter
from derive.solving.presentation import presented
from derive.solving.relations import solved_for_letter
from derive.steps.step import Quantity, is_zero

ZERO = Integer(0)


@dataclass(frozen=True, eq=False)
class About:
    """A potential energy of one coordinate, its matter, a place, and further conditions there.
    rates     of the cyclic coordinates there
    momenta   letters of their momenta with the values there, if these are not given
    letter    a letter that the condition of the steady motion determines, and its value
    instead   a rate expressed by the letter of a momentum, for a shorter result
    """

    potential: Quantity
    matter: Matter
    q: Symbol
    place: Expr
    rates: Mapping[Symbol, Expr]
    momenta: Mapping[Symbol, Expr]
    letter: Mapping[Symbol, Expr]
    instead: Mapping[Symbol, Expr] = field(default_factory=dict)

    def there(self, value: Expr) -> Expr:
        """Return the value at that place, where only the cyclic coordinates move."""
        still = {rate(s, n): ZERO for s in self.matter.coordinates for n in (1, 2)}
        return bound(explicit(value), still).subs(self.q, self.place)

    def known(self, value: Expr) -> Expr:
        """Substitute the momenta for these rates, and eliminate one letter by the condition."""
        return bound(bound(bound(value, self.momenta), self.letter), self.instead)

    def by_momenta(self) -> Iterator[About]:
        """Yield versions with a rate given by a momentum: s = w - Omega cos(alpha) from w = s + Omega cos(alpha)."""
        for momentum, value in self.momenta.items():
            for turning in self.rates.values():
                found = solved_for_letter(momentum - value, turning) if isinstance(turning, Symbol) else None
                if found is not None and momentum in self.potential.value.free_symbols - self.letter.keys():
                    yield replace(self, instead={turning: found})


def letter_of_value(given: Expr, value: Expr, lagrangian: Quantity, of: Quantity) -> dict[Symbol, Expr]:
    """Return the letter of a given momentum: w = s + Omega cos(alpha) from C w = C (s + Omega cos(alpha))."""
    known = explicit(lagrangian.value).free_symbols | value.free_symbols
    for letter in sorted(given.free_symbols - known, key=str):
        if (found := solved_for_letter(given - value, letter)) is not None:
            return {letter: presented(found)}
    message = f"`frequency_squared_about`: `{of.key}` has the momentum {given}, but in the steady motion it is {value}"
    help_line = "give the momentum by a separate letter, or leave it out"
    raise Rejected(Complaint("wrong-argument", message, help=help_line))


def determinant_about(about: About, found: Expr) -> Expr:
    """Return the determinant of d'Alembert's principle to first order, with displacements e^(s t), s^2 = -omega^2.
    The cyclic coordinates have the factor s in each entry, which is taken out of their rows and columns.
    """
    matter = about.matter.whole if isinstance(about.matter, ReducedMatter) else about.matter
    moving = [about.q, *about.rates]
    s = Dummy("s")
    still = {rate(q, n): ZERO for q in moving for n in (1, 2)} | {rate(q): v for q, v in about.rates.items()}

    def entry(i: int, j: int) -> Expr:
        left = explicit(matter.inertia_along(moving[int(i)]) - matter.force_along(moving[int(i)]))
        other = moving[int(j)]
        slopes = [slope(left, rate(other, n) if n else other) for n in range(3)]
        at_place = [_without_angles(each.xreplace({**still, about.q: about.place}), about.rates) for each in slopes]
        if j:  # a cyclic coordinate occurs only by its rates: its rate is the unknown
            return at_place[1] + s * at_place[2]
        return at_place[0] + s * at_place[1] + s**2 * at_place[2]

    matrix = ImmutableDenseMatrix(len(moving), len(moving), entry)
    polynomial = expand(determinant_of(matrix)).as_poly(s)
    lowest = min(n for (n,) in polynomial.monoms())
    powers = [(n - lowest, c) for (n,), c in polynomial.terms()]
    return Add(*(c * (s**n if n % 2 else (-found) ** (n // 2)) for n, c in powers))


def _without_angles(value: Expr, cyclic: Iterable[Symbol]) -> Expr:
    """Set the cyclic coordinates to zero in the value, if it does not depend on them: most terms vanish."""
    at_zero = value.xreplace(dict.fromkeys(cyclic, ZERO))
    return at_zero if is_zero(value - at_zero) else value
