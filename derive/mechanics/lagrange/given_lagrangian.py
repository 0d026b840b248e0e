"""Lagrangians that are given as formulas, without mass points and forces.

Second routes use variations of L instead of bodies: momenta and forces are the first-order changes of L when a rate or
a coordinate varies. The energy identity is dh/dt + dL/dt = sum of q_dot (d/dt dL/dq_dot - dL/dq), where dL/dt is a
partial derivative. This identity checks an equation of motion without the derivative of L with respect to the
coordinate.

Source: Landau, Lifshitz, *Mechanics*, sections 2 and 6; Goldstein, Poole, Safko, *Classical Mechanics*, section 2.3.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from sympy import Add, Dummy, Expr, ImmutableDenseMatrix, Integer, Pow, Symbol, together

from derive.algebra.expressions import TIME, Relation, bound, explicit, rate, scalar
from derive.algebra.ranges import sign_within, take_as_positive
from derive.algebra.taylor import slope
from derive.errors import Complaint, Rejected
from derive.mechanics.lagrange.applied_forces import acting_on
from derive.mechanics.lagrange.facts import Varied
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.description import Described, described
from derive.mechanics.model.forces import Damper, GivenForce
from derive.steps.establish import Lines, Scope, establish
from derive.steps.record import assume, coordinates_in, free_letter
from derive.steps.rule import Rule
from derive.steps.step import Quantity
from derive.steps.subject import Subject

__all__ = ["given_lagrangian"]

ZERO = Integer(0)


@dataclass(frozen=True, eq=False)
class WithoutBodies:
    """The system of a given Lagrangian: the function, its coordinates, and additional forces along these
    coordinates."""

    function: Expr
    given_forces: tuple[GivenForce, ...] = ()
    dampers: tuple[Damper, ...] = ()
    constraints: tuple[Constraint, ...] = ()
    called: str = ""

    @cached_property
    def coordinates(self) -> Mapping[Symbol, str]:
        return coordinates_in(ImmutableDenseMatrix([self.function]))

    @cached_property
    def matter(self) -> Varied:
        moving = tuple(self.coordinates)
        loads = [*(each.load(moving) for each in self.given_forces), *(each.load(moving) for each in self.dampers)]
        return Varied((), (), moving, tuple(loads), (), self.function)

    @cached_property
    def described(self) -> Described:
        """Return the input of the witness, an independent numerical check: the function, and the forces along its
        coordinates."""
        return Described(described((*self.given_forces, *self.dampers), (), (), self.coordinates, self.function))


GIVEN_LAGRANGIAN = Rule(
    "lagrange.given_lagrangian",
    source="Landau, Lifshitz, *Mechanics*, section 2",
)


def given_lagrangian(
    function: Expr,
    *acting: GivenForce | Damper,
    kind: str | None = "energy",
    symbol: str | None = None,
    key: str = "lagrangian",
) -> Quantity:
    """Lagrangian that is given as a formula, L = f(q, q_dot, t): a premise; like a definition, it is not derived.

    function   a formula in coordinates, their rates and the time
    acting     additional forces along coordinates: couples, and drag against a rate
    kind       the kind of L, an energy for a mechanical system

    Expressions under square roots are assumed to be positive, so that L is real.
    Errors: the formula contains no rate of a coordinate, or it contains an acceleration; a force acts along a
    coordinate that the formula does not contain.
    Source: Landau, Lifshitz, *Mechanics*, section 2.
    """
    whole = explicit(function)
    system = WithoutBodies(
        whole,
        tuple(each for each in acting if isinstance(each, GivenForce)),
        tuple(each for each in acting if isinstance(each, Damper)),
    )
    moving = system.coordinates
    if not whole.has(*(rate(q) for q in moving)) if moving else True:
        message = "a given Lagrangian needs the rate of a coordinate"
        raise Rejected(Complaint("wrong-argument", message, help="write the rate of x as `x_dot`"))
    for q in moving:
        if whole.has(rate(q, 2), rate(q, 3)):
            message = f"a given Lagrangian may contain coordinates and their rates, but not {rate(q, 2).name}"
            raise Rejected(Complaint("wrong-argument", message))
    strange = [q for each in acting for c in each.at for q in coordinates_in(ImmutableDenseMatrix([c]))]
    for q in (q for q in strange if q not in moving):
        message = f"a force or drag acts along {q.name}, which is not a coordinate of the Lagrangian"
        raise Rejected(Complaint("wrong-argument", message))
    for base in sorted(_radicands(whole), key=str):
        _take_as_real(base)
    return establish(
        GIVEN_LAGRANGIAN,
        scalar(symbol or free_letter("L")),
        lambda: function,
        {},
        key=key,
        kind=kind,
        lines=Lines(put_in=None, arranged=lambda value: value),
        facts=[system.matter, *acting_on(system), system.described],
        scope=Scope(coordinates=moving, about=Subject(body=system)),
    )


def _radicands(whole: Expr) -> set[Expr]:
    return {p.base for p in whole.atoms(Pow) if p.exp.is_Rational and p.exp.q % 2 == 0}


def _take_as_real(base: Expr) -> None:
    """Assume that an expression under a square root of L is positive, because L is real; the page states this
    assumption."""
    above, below = together(base).as_numer_denom()
    if base.is_nonnegative or sign_within(base) == 1:
        return
    if below.is_positive:
        base = above.expand()
    taken = Add(*(-term for term in Add.make_args(base) if term.could_extract_minus_sign()))
    take_as_positive(base)
    assume(Relation(base + taken, ">", taken))


def energy_of(matter: Varied) -> Expr:
    """Return h, which is the sum of q_dot p, minus L. The sum is the derivative of L with respect to a common factor of
    all rates."""
    stretch = Dummy("u", real=True)
    rates = {rate(q): (1 + stretch) * rate(q) for q in matter.coordinates}
    return slope(bound(matter.function, rates), stretch).xreplace({stretch: ZERO}) - matter.function


def rate_of_energy(matter: Varied) -> Expr:
    """Return dh/dt by the energy identity: the sum of q_dot (dp/dt - dL/dq), minus the partial derivative of L with
    respect to time.

    The identity is true for all functions q(t), not only for motions.
    """
    works = (rate(q) * matter.inertia_along(q) for q in matter.coordinates)
    return Add(*works) - slope(matter.function, TIME)
