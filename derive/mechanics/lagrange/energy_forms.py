"""Forms in which an energy is written: squares of rates and momenta first, and the potential energy unchanged."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import (
    Add,
    Dummy,
    Expr,
    Integer,
    Pow,
    Rational,
    Symbol,
    factor,
    together,
)

from derive.algebra.collect import by_rates, with_weights_in_front
from derive.algebra.derivatives import derivative
from derive.algebra.expressions import Terms, bound, explicit, rate
from derive.algebra.length import shortest
from derive.algebra.tidy import tidied
from derive.mechanics.lagrange.facts import energies_of
from derive.mechanics.model.dalembert import Matter
from derive.solving.presentation import by_letters, by_one_square, roots_together
from derive.steps.step import Form, Quantity

ZERO = Integer(0)


def beside_potential(
    value: Expr, of: Quantity, letters: Sequence[Symbol], moving: Sequence[Symbol] = (), sign: int = 1
) -> Expr:
    """Write an energy as a sum of a kinetic part, collected by rates and momenta, and the unchanged potential energy.

    of        the step that derives the Lagrangian
    letters   symbols of momenta, which may be constant or vary
    moving    coordinates whose rates are in the energy
    sign      the sign of the potential energy: -1 in a Lagrangian
    """
    energies = energies_of(of)
    if energies is None:
        return of_given(value, letters, moving)
    potential = explicit(energies.potential.value)
    at_rest = bound(value, {rate(q): ZERO for q in moving})
    kinetic = by_one_square(by_rates(tidied(value - at_rest), list(moving), halves=True)) if moving else ZERO
    kinetic = with_weights_in_front(kinetic, list(moving), of.needed(Matter).weights)
    return Add(kinetic, sign * (by_letters(sign * at_rest - potential, letters) + potential))


def of_given(value: Expr, letters: Sequence[Symbol], moving: Sequence[Symbol]) -> Expr:
    """Write an energy of a given Lagrangian, whose potential energy is unknown: terms with rates or momenta first."""
    fast = [*letters, *(rate(q) for q in moving)]
    terms = Add.make_args(explicit(value).expand())
    alone = tidied(Add(*(term for term in terms if not term.has(*fast))))
    whole = Add(*(term for term in terms if term.has(*fast)))
    forms = [roots_together(whole), tidied(whole), by_letters(whole, letters), factor(together(whole)), whole]
    if moving:
        forms.append(by_rates(whole, list(moving), halves=True))
    return squared_below_roots(shortest([explicit(form) for form in forms]), letters) + alone


def squared_below_roots(value: Expr, letters: Sequence[Symbol]) -> Expr:
    """Complete squares under roots, if this is shorter: sqrt((p_x + b y)^2 + m^2 c^2)."""
    roots = {
        power: by_letters(power.base, letters) ** power.exp
        for power in value.atoms(Pow)
        if power.exp.is_Rational and not power.exp.is_Integer
    }
    return value.xreplace(roots)


def kinetic_first(value: Expr, names: Sequence[Symbol]) -> list[Form]:
    """Return the last line of an energy, with the kinetic terms first."""

    def rank(term: Expr) -> tuple[bool, int, bool, bool, str]:
        first = next((i for i, name in enumerate(names) if term.has(name)), len(names))
        linear = first < len(names) and not any(derivative(term, a, b) != 0 for a in names for b in names)
        mixed = first < len(names) and derivative(term, names[first], 2) == 0
        return linear, first, mixed, term.could_extract_minus_sign(), str(term)

    terms = sorted(Add.make_args(value), key=rank)
    return [Form(Terms(*terms) if len(terms) > 1 else value, "result")]


def part_of_degree(value: Expr, rates: Sequence[Symbol], degree: int) -> Expr:
    """Return the part of this degree in the rates, 0, 1 or 2; the expression must be quadratic in the rates."""
    u = Dummy("u")
    scaled = bound(explicit(value), {v: u * v for v in rates})
    halved = Rational(1, 2) if degree == 2 else Integer(1)
    for _ in range(degree):
        scaled = derivative(scaled, u)
    return halved * bound(scaled, {u: ZERO})
