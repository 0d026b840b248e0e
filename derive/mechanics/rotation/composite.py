"""A body made of bodies on one axis: a top of a disc and a rod, and its moments about the point that it spins on.

Every part has its axis of symmetry along the body's z axis and its centre of mass at some height above the pivot.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Integer, Pow, Rational, Symbol
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import Factors, Ratio, Terms, column, scalar, sympify_number
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.body import RoundBody, density
from derive.mechanics.bodies.integration import worked_integral
from derive.mechanics.bodies.regions import Point
from derive.mechanics.rotation.inertia import entry_weight
from derive.steps.establish import Lines, Scope, Telling, establish
from derive.steps.step import Quantity, compared_with
from derive.steps.subject import Subject

__all__ = ["Composed", "Part", "axial_moment", "centre_distance", "part_moment", "total_mass", "transverse_moment"]

AXIAL, TRANSVERSE = (2, 2), (0, 0)
LETTER = {AXIAL: "z", TRANSVERSE: "x"}
PIVOT = Point("pivot", ImmutableDenseMatrix(column(0, 0, 0)))  # in axes of the whole, which begin there


@dataclass(frozen=True)
class Part:
    """One part of a composed body.

    name   what the page calls it: "disc", "rod"
    body   round about its z axis
    at     height of its centre of mass above the pivot, a length
    """

    name: str
    body: RoundBody
    at: Expr

    def __post_init__(self) -> None:
        object.__setattr__(self, "at", sympify_number(self.at))

    @property
    def pivot(self) -> Point:
        """The pivot, in the part's own axes."""
        return Point("pivot", ImmutableDenseMatrix(self.body.middle.position - column(0, 0, self.at)))


class Composed:
    """Parts on one axis, which are turned together about a pivot on it.

    parts   one or more `Part`, of different names
    Errors: a part that is not round about the axis; two parts of one name.
    """

    def __init__(self, *parts: Part):
        for part in parts:
            if not part.body.is_round:
                message = f"`{part.name}` is {part.body.name}, which is not round about the axis of the parts"
                raise Rejected(Complaint("not-round", message))
        names = [part.name for part in parts]
        if len(set(names)) < len(names) or not names:
            message = "a composed body needs parts of different names" if names else "a composed body needs parts"
            raise Rejected(Complaint("parts", message))
        self.parts = parts
        self.name = "the body of " + " and ".join(names)
        letters = [part.body.density_letter for part in parts]
        self._densities = {
            part.name: density(
                part.body,
                symbol=None if letters.count(letter) == 1 else f"{letter}_{part.name}",
                key=f"{part.name}_density",
                part=part.name,
            )
            for part, letter in zip(parts, letters, strict=True)
        }

        self._moments: dict[tuple[str, tuple[int, int]], Quantity] = {}

    def density(self, part: Part) -> Quantity:
        return self._densities[part.name]

    def moment(self, part: Part, pair: tuple[int, int]) -> Quantity:
        """The part's own moment, established once."""
        if (part.name, pair) not in self._moments:
            self._moments[part.name, pair] = part_moment(self, part, pair)
        return self._moments[part.name, pair]

    @property
    def middle(self) -> Point:
        """Its centre of mass, from the pivot, as its particles have it."""
        masses, moments = Integer(0), column(0, 0, 0)
        for mass, place in self.particles():
            masses, moments = masses + mass, moments + mass * place
        return Point("centre", ImmutableDenseMatrix((moments / masses).applyfunc(lambda x: x.cancel())))

    def particles(self) -> Iterator[tuple[Expr, ImmutableMatrix]]:
        """The particles of all parts, seen from the pivot."""
        for part in self.parts:
            for mass, place in part.body.particles():
                yield mass, part.pivot.seen(place)

    def free(self, *letters: str) -> str:
        """The first of some letters that nothing given has."""
        taken = {letter.name for mass, place in self.particles() for letter in mass.free_symbols | place.free_symbols}
        return next((letter for letter in letters if letter not in taken), letters[-1])


def total_mass(body: Composed, symbol: str | None = None, key: str = "total_mass") -> Quantity:
    """Mass of a composed body, M = m_1 + m_2 + ...

    body   its parts
    Second route: the density of each part integrated over the part.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, section 4.2.
    """
    masses = [part.body.mass for part in body.parts]

    def by_integration() -> Expr:
        return sum((part.body.over_mass(lambda _: Integer(1), part.pivot) for part in body.parts), Integer(0))

    return establish(
        "composed.total_mass",
        Symbol(symbol or body.free("M", "M_0", "M_total"), positive=True),
        Terms,
        {part.name: mass for part, mass in zip(body.parts, masses, strict=True)},
        routes={"integration": compared_with(by_integration)},
        kind="mass",
        key=key,
        scope=Scope(about=Subject(body=body)),
    )


def centre_distance(
    body: Composed, mass: Quantity, symbol: str | None = None, key: str = "centre_distance"
) -> Quantity:
    """Distance of the centre of mass from the pivot, l = (m_1 d_1 + m_2 d_2 + ...)/M.

    body   its parts, each with its mass and the distance of its centre
    mass   of the whole
    Second route: the weights of the body's equimomental particles balance about that point.
    Errors: none.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, section 4.2.
    """

    def unbalanced(l: Expr) -> tuple[Expr, Expr]:
        return sum((m * (place[2] - l) for m, place in body.particles()), Integer(0)), Integer(0)

    return establish(
        "composed.centre_distance",
        scalar(symbol or body.free("l", "d", "s")),
        lambda M: Ratio(Terms(*(Factors(part.body.mass, part.at) for part in body.parts)), M),
        {"mass": mass},
        routes={"balance": unbalanced},
        kind="length",
        key=key,
        scope=Scope(about=Subject(body=body, point=PIVOT)),
    )


def axial_moment(body: Composed, symbol: str = "I_z", key: str = "axial_moment") -> Quantity:
    """Moment of inertia about the axis of symmetry, the sum of those of the parts, I_z = I_z1 + I_z2 + ...

    body   its parts
    The moment of each part about the axis is a step of its own.
    Second route: mass times distance squared, summed over the equimomental particles of all parts; the integral of
    the squared distance over the whole body.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, section 6.3.
    """
    moments = {part.name: body.moment(part, AXIAL) for part in body.parts}
    return establish(
        "composed.axial_moment",
        scalar(symbol),
        lambda *found: _sum(list(found)),
        {name: moment for name, moment in moments.items() if moment.value != 0},
        routes={
            "particles": compared_with(lambda: _from_particles(body, AXIAL)),
            "integration": compared_with(lambda: _by_integration(body, AXIAL)),
        },
        parents=list(moments.values()),
        kind="moment of inertia",
        key=key,
        scope=Scope(about=Subject(body=body, point=PIVOT, axis="z"), differ={"body", "point"}),
    )


def transverse_moment(body: Composed, symbol: str = "I_x", key: str = "transverse_moment") -> Quantity:
    """Moment of inertia about an axis through the pivot across the body, part by part with its parallel axis,
    I_x = I_x1 + m_1 d_1^2 + I_x2 + m_2 d_2^2 + ...

    body   its parts; d is the distance of a part's centre from the pivot
    The moment of each part about its own centre is a step of its own.
    Second route: mass times distance squared, summed over the equimomental particles of all parts; the integral of
    the squared distance over the whole body.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, section 6.3 (parallel axes).
    """
    moments = {part.name: body.moment(part, TRANSVERSE) for part in body.parts}

    def by_parallel_axes(*found: Any) -> Any:
        terms: list[Expr] = []
        for part, own in zip(body.parts, found, strict=True):
            terms.append(own)
            if part.at != 0:
                terms.append(Factors(part.body.mass, Pow(part.at, 2, evaluate=not part.at.is_Mul)))
        return _sum(terms)

    return establish(
        "composed.transverse_moment",
        scalar(symbol),
        by_parallel_axes,
        dict(moments),
        routes={
            "particles": compared_with(lambda: _from_particles(body, TRANSVERSE)),
            "integration": compared_with(lambda: _by_integration(body, TRANSVERSE)),
        },
        kind="moment of inertia",
        key=key,
        scope=Scope(about=Subject(body=body, point=PIVOT, axis="x"), differ={"body", "point"}),
    )


def part_moment(body: Composed, part: Part, pair: tuple[int, int]) -> Quantity:
    """Moment of inertia of one part about an axis through its own centre, I = integral of the squared distance dm.

    body   the composed body
    part   one of its parts
    pair   (2, 2) about the axis of symmetry, (0, 0) across it
    A flat part has I_x + I_y = I_z, so half of I_z across its axis.
    Second route: mass times distance squared, summed over the part's equimomental particles; for a flat part the
    integral too.
    Outcomes: moment, flat, none (all of the mass is on the axis).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3.
    """
    centre = part.body.middle
    region = part.body.region(centre)
    weight = entry_weight(region, pair)
    rho = body.density(part)
    is_flat = pair == TRANSVERSE and part.body.filling == "area"
    axial = [body.moment(part, AXIAL)] if is_flat else []

    def directly() -> Expr:
        return part.body.over_mass(lambda r: _squared_distance(r, pair), centre)

    law: Callable[..., Any]
    if is_flat:
        law = lambda along: Factors(Rational(1, 2), along)  # noqa: E731
    else:
        law = lambda density: Factors(density, region.integral(weight)) if weight != 0 else weight  # noqa: E731
    return establish(
        "composed.part_moment",
        scalar(f"I_{LETTER[pair]}_{part.name}"),
        law,
        {"axial": axial[0]} if is_flat else {"density": rho},
        lines=Lines(
            between=[] if is_flat else worked_integral(region, weight, rho.symbol, part.body.size), put_in=None
        ),
        routes={
            "particles": compared_with(
                lambda: sum((m * _squared_distance(centre.seen(r), pair) for m, r in part.body.particles()), Integer(0))
            ),
            "integration": compared_with(directly),
        },
        outcome="flat" if is_flat else "none" if weight == 0 else "moment",
        kind="moment of inertia",
        key=f"{part.name}_moment_{LETTER[pair]}",
        telling=Telling(words={"name": part.name, "axis_letter": LETTER[pair]}),
        scope=Scope(about=Subject(body=part.body, point=centre, axis=LETTER[pair])),
    )


def _sum(terms: list[Expr]) -> Expr:
    return terms[0] if len(terms) == 1 else Terms(*terms) if terms else Integer(0)


def _squared_distance(r: ImmutableMatrix, pair: tuple[int, int]) -> Expr:
    return sum((x**2 for k, x in enumerate(r) if k != pair[0]), Integer(0))


def _from_particles(body: Composed, pair: tuple[int, int]) -> Expr:
    return sum((mass * _squared_distance(place, pair) for mass, place in body.particles()), Integer(0))


def _by_integration(body: Composed, pair: tuple[int, int]) -> Expr:
    return sum(
        (part.body.over_mass(lambda r: _squared_distance(r, pair), part.pivot) for part in body.parts), Integer(0)
    )
