"""Kinetic and potential energy of a system, from the positions of its particles and the rotations of its bodies."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from sympy import Add, Expr, Integer, Mul, Pow, Symbol, cos, expand, factor, preorder_traversal, sin, sqrt, tan

from derive.algebra.collect import (
    by_rates,
    by_terms,
    spread,
    with_constants_in_front,
    with_constants_together,
    with_weights_in_front,
)
from derive.algebra.derivatives import derivative
from derive.algebra.expressions import (
    TIME,
    Dot,
    Factors,
    Relation,
    Terms,
    TimeRate,
    applied,
    as_expr,
    bound,
    depends_on_time,
    explicit,
    rate,
    scalar,
    stand_in,
)
from derive.algebra.length import length
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.placed import PlacedBody
from derive.mechanics.kinematics.coordinates import by_functions_of_time, rate_of
from derive.mechanics.kinematics.places import Axes, Location
from derive.mechanics.lagrange import claims
from derive.mechanics.lagrange.applied_forces import acting_on, squares_of_rates
from derive.mechanics.model.dalembert import MassPoint, Matter
from derive.mechanics.model.distances import long_distances
from derive.mechanics.model.rigid import (
    angular_velocity,
    convenient_axes,
    inertia_of,
    is_about_the_point,
    turning_rate_of,
)
from derive.mechanics.model.system import HALF, ZERO, Eliminated, System
from derive.steps.claims import vanishes
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.level import Manner
from derive.steps.record import assumed, free_letter
from derive.steps.rule import CHECK, ROUTE, Rule, Shown
from derive.steps.step import Form, Level, Quantity, Step, compared_with, lettered, value_behind
from derive.steps.subject import EVERYTHING, Subject

__all__ = ["kinetic_energy_of", "magnetic_term_of", "potential_energy_of"]


SPEEDS = ("v", "u", "w")  # symbols for a speed: the first one that is not in use is chosen
MANY = 8  # greatest number of terms in a line with squares of velocities; a longer line is left out


@dataclass(frozen=True)
class Mover:
    """A particle or a body whose kinetic energy contains the term (1/2) M v^2.

    A body has no such term if it is held at a point about which its inertia is given or can be derived.
    letter   the index of the symbol v; empty if v has no index
    """

    mass: Expr
    at: Location
    letter: str
    is_body: bool

    @property
    def place(self) -> tuple[Expr, ...]:
        return self.at.components


def movers(system: System, lagrangian: str = "") -> list[Mover]:
    """Return the particles and bodies whose kinetic energy has a term (1/2) M v^2. Each has the index of its speed:
    none for v, `1` for v_1, `rod` for v_rod."""
    found = [Mover(particle.mass, particle.at, "", False) for particle in system.particles]
    found += [
        Mover(placed.body.mass, placed.centre, placed.body.called.partition(" ")[0], True)
        for placed in system.bodies
        if not is_about_the_point(placed)
    ]
    own = system.called.partition(" ")[0]

    def index(i: int, mover: Mover) -> str:
        parts = [mover.letter or (str(i + 1) if len(found) > 1 else ""), own, lagrangian]
        return "_".join(part for part in parts if part)

    return [replace(mover, letter=index(i, mover)) for i, mover in enumerate(found)]


def _is_plain(step: Step) -> bool:
    """Whether a squared speed contains only rates of coordinates, x_dot^2 + y_dot^2."""
    return bool(step.result.free_symbols <= {rate(q) for q, _ in step.coordinates})


SQUARED_SPEED = Rule(
    "lagrange.squared_speed",
    source="Taylor, *Classical Mechanics*, section 7.1",
    outcomes={"of_particle": claims.speed_of_particle, "of_centre": claims.speed_of_centre},
    evidence={"functions_of_time": CHECK},
    shown=Shown(brief=Manner.TAKEN_IN, taken_in_if=_is_plain),
)


def _squared_speed(system: System, mover: Mover) -> Quantity:
    """Derive the square of the speed of a particle or of a centre of mass, v^2 = x_dot^2 + y_dot^2."""
    moving = list(system.coordinates)
    entries = [as_expr(c) for place in system.places for c in place.components]
    given = {s.name.partition("_")[0] for entry in entries for s in entry.free_symbols}
    indices = [other.letter for other in movers(system)]
    free = (letter for letter in SPEEDS if letter not in given and free_letter(letter, *indices) == letter)
    base = next(free, SPEEDS[0])
    name = f"{base}_{mover.letter}" if mover.letter else base
    letter = scalar(name)
    matter = Matter((MassPoint(Integer(2), mover.place),), (), tuple(moving))
    velocity = _velocity(mover, moving)
    at = {f"place_{k}": c for k, c in enumerate(mover.place)}
    return establish(
        SQUARED_SPEED,
        Pow(letter, 2),
        (lambda *v: Terms(*(Pow(c, 2) for c in v))) if velocity else (lambda *at: squares_of_rates(at, moving)),
        {f"velocity_{k}": v for k, v in enumerate(velocity)} if velocity else at,
        key=f"squared_speed_{mover.letter}" if mover.letter else "squared_speed",
        outcome="of_centre" if mover.is_body else "of_particle",
        routes={"functions_of_time": compared_with(matter.kinetic_energy)},
        lines=Lines(
            law=Level.BRIEF if velocity else Level.FULL,  # without velocities the sentence states the position
            put_in=Level.STANDARD if velocity else None,
            between=_multiplied_out([v.value for v in velocity]) if velocity else _differentiated(at.values(), moving),
            arranged=lambda value: by_rates(value, moving),
            means={letter: _speed(mover.place, moving)},
        ),
        parents=[known for _, known in mover.at.found] if velocity else [],
        scope=Scope(coordinates=system.coordinates, about=Subject(body=system)),
    )


def _multiplied_out(velocity: Sequence[Expr]) -> list[Form]:
    """Return the line with expanded squares, in which sines and cosines of one angle are not yet combined."""
    terms = [term for v in velocity for term in Add.make_args(expand(v**2))]
    return [Form(Terms(*terms), "multiplied_out", Level.FULL)] if len(velocity) < len(terms) <= MANY else []


def _differentiated(place: Iterable[Expr], moving: Sequence[Symbol]) -> list[Form]:
    """Return the line with the squares of the components of the velocity."""
    velocity = [by_rates(explicit(TimeRate(c, *moving)), moving) for c in place]
    changing = [v for v in velocity if v != 0]
    many = sum(len(Add.make_args(v)) for v in changing) > MANY
    return [Form(Terms(*(Pow(v, 2) for v in changing)), "velocities")] if len(changing) > 1 and not many else []


def _velocity(mover: Mover, moving: list[Symbol]) -> list[Quantity]:
    """Return the steps of the rates of the components that change; empty if fewer than two components change, or if a
    changing component has no step."""
    known = dict(mover.at.found)
    changing = [k for k, c in enumerate(mover.place) if c.has(*moving) or depends_on_time(c)]
    return [rate_of(known[k]) for k in changing] if all(k in known for k in changing) and len(changing) > 1 else []


def _speed(place: tuple[Expr, ...], moving: list[Symbol]) -> Expr:
    return sqrt(Add(*(explicit(TimeRate(c, *moving)) ** 2 for c in place)))


@dataclass(frozen=True)
class Turning:
    """The rotation of a body.

    inertia   a step with the inertia tensor; for plane motion the moment of inertia, a step or a symbol
    omega     a step with the angular velocity; for plane motion the rate of the angle
    """

    inertia: Any
    omega: Any

    @property
    def is_plane(self) -> bool:
        return not isinstance(self.omega, Quantity)

    def energy(self, inertia: Any, omega: Any) -> Expr:
        """Return (1/2) I theta_dot^2 for plane motion, otherwise (1/2) omega . I omega."""
        if self.is_plane:
            return _half_of(inertia, Pow(omega, 2))
        return Factors(HALF, Dot(omega, applied(inertia, omega)))

    def written_out(self) -> Expr:
        """Return the energy in components."""
        tensor, omega = value_behind(self.inertia), value_behind(self.omega)
        if self.is_plane or not tensor.is_diagonal():
            return explicit(self.energy(tensor, omega))
        squares: dict[Expr, list[Expr]] = {}
        for i in range(3):
            if omega[i] != 0:
                squares.setdefault(tensor[i, i], []).append(Pow(_factored(omega[i]), 2))
        return Add(*(Mul(HALF, moment, Add(*of)) for moment, of in squares.items() if moment != 0), evaluate=False)


def _half_of(factor_: Any, square: Expr) -> Expr:
    """Return (1/2) I omega^2 or (1/2) m v^2, with one number in front: (1/4) M R^2 omega^2, not (1/2) (1/2) M R^2
    omega^2."""
    is_product = not any(explicit(each).is_Add for each in (factor_, square))
    return Mul(HALF, explicit(factor_), explicit(square)) if is_product else Factors(HALF, factor_, square)


def weights_of(system: System) -> set[Symbol]:
    """Return the symbols in the masses of a system."""
    return {letter for mass, _ in system.masses for letter in explicit(mass).free_symbols}


def _factored(component: Expr) -> Expr:
    return min((component, factor(component)), key=length)


def _turnings(system: System) -> list[Turning]:
    found: list[Turning] = []
    known: list[tuple[PlacedBody, Any]] = []
    for i, placed in enumerate(system.bodies):
        if placed.is_plane and turning_rate_of(placed) == 0:
            continue
        alike = (
            inertia
            for other, inertia in known
            if (other.body, other.across, other.point.name) == (placed.body, placed.across, placed.point.name)
            and other.body.called == placed.body.called
            and is_about_the_point(other) == is_about_the_point(placed)
        )
        inertia = next(alike, None)
        if inertia is None:
            inertia = inertia_of(placed)
            known.append((placed, inertia))
        turned = placed.turned
        if not isinstance(turned, Axes):
            found.append(Turning(inertia, turning_rate_of(placed)))
        else:
            letter = "omega" if len(system.bodies) == 1 or placed.body.called else f"omega_{i + 1}"
            of = placed.body if placed.body.called else system if system.called else None
            found.append(
                Turning(inertia, angular_velocity(turned, convenient_axes(placed, value_behind(inertia)), of, letter))
            )
    return found


KINETIC_ENERGY = Rule(
    "lagrange.kinetic_energy",
    source="Taylor, *Classical Mechanics*, section 7.1; Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
    evidence={"mass_points": ROUTE},
    statements=[claims.parts_of_the_kinetic_energy],
)


def kinetic_energy_of(system: System, symbol: str | None = None, key: str = "kinetic_energy") -> Quantity:
    """Kinetic energy of a system, T = sum of (1/2) M v^2 + (1/2) omega . I omega over its particles and bodies.

    system   the particles and bodies that move

    Here v is the speed of a particle or of a centre of mass, and I is about the centre of mass. If a body is held at a
    point about which its inertia is given or can be derived, I is about this point, and the body has no term with v.
    Separate steps derive the square of each speed, each inertia that is not given and, in space, each angular velocity.
    Second route: half the sum of m v.v over mass points, with their positions differentiated as functions of t.
    Errors: the moments of inertia of a body are known only about a point other than the required one.
    Source: Taylor, *Classical Mechanics*, section 7.1; Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3.
    """
    moved = movers(system, (symbol or "").partition("_")[2])
    speeds = [_squared_speed(system, mover) for mover in moved]
    turnings = _turnings(system)
    moving = list(system.coordinates)
    inputs: dict[str, Any] = {f"speed_{i}": speed for i, speed in enumerate(speeds)}
    for i, turning in enumerate(turnings):
        inputs |= {f"inertia_{i}": turning.inertia, f"omega_{i}": turning.omega}

    eliminated = [Eliminated(system.eliminated)] if system.eliminated else []

    def law(*given: Expr) -> Expr:
        squares, rest = given[: len(speeds)], given[len(speeds) :]
        terms = [_half_of(mover.mass, square) for mover, square in zip(moved, squares, strict=True)]
        pairs = zip(turnings, rest[::2], rest[1::2], strict=True)
        terms += [turning.energy(inertia, omega) for turning, inertia, omega in pairs]
        return Terms(*terms) if len(terms) > 1 else terms[0]

    def arranged(value: Expr) -> Expr:
        gathered = by_rates(value.replace(tan, lambda a: sin(a) / cos(a)), moving, halves=True)
        gathered = with_weights_in_front(gathered, moving, weights_of(system))
        if all(turning.is_plane for turning in turnings):
            return gathered
        moved_on = [HALF * mover.mass * square.value for mover, square in zip(moved, speeds, strict=True)]
        turned = [turning.written_out() for turning in turnings]
        whole = Add(
            *(part for term in (*moved_on, *turned) for part in Add.make_args(term) if part != 0), evaluate=False
        )
        return min((gathered, whole), key=length)

    return establish(
        KINETIC_ENERGY,
        scalar(symbol or free_letter("T")),
        law,
        inputs,
        key=key,
        kind="energy",
        parents=[*system.put_in, *_behind(system)],
        routes={"mass_points": compared_with(system.matter.kinetic_energy)},
        lines=_lines_of_kinetic_energy(law, inputs, turnings, arranged),
        phrase_data=PhraseData(words={"made": _made_of(system, moved, turnings)}),
        facts=[replace(system.matter, loads=(), others=(), fields=()), *eliminated, system.described],
        scope=Scope(about=Subject(body=system), differ=EVERYTHING, coordinates=system.coordinates),
    )


def _made_of(system: System, moved: Sequence[Mover], turnings: Sequence[Turning]) -> str:
    """Return the word for the parts of the kinetic energy of a single body. The word is "both" for the motion of the
    centre of mass and the rotation about it, and "axis" or "point" for a rotation about a fixed axis or point. The word
    for any other system is "any"."""
    if system.particles or len(system.bodies) != 1 or len(turnings) != 1:
        return "any"
    if moved:
        return "both"
    return "axis" if turnings[0].is_plane else "point"


def _lines_of_kinetic_energy(
    law: Callable[..., Expr], inputs: Mapping[str, Any], turnings: list[Turning], arranged: Callable[[Expr], Expr]
) -> Lines:
    """Return the lines of a kinetic energy. If the line with substituted values is already the result, this line
    appears only once."""
    level = _level_of_values(turnings)
    values = explicit(law(*(value_behind(each) for each in inputs.values()))) if level else ZERO
    if level is Level.STANDARD and (result := arranged(values)) == values:
        return Lines(put_in=None, between=[Form(result, "put_in", Level.BRIEF)], arranged=arranged)
    return Lines(put_in=level, arranged=arranged)


def _level_of_values(turnings: list[Turning]) -> Level | None:
    """Return the lowest level that shows the line with substituted values. A line with matrices appears at full level.
    Return None if no body rotates."""
    if not turnings:
        return None
    return Level.STANDARD if all(turning.is_plane for turning in turnings) else Level.FULL


def _behind(system: System) -> list[Quantity]:
    return [lettered(value) for placed in system.bodies for value in getattr(placed.body, "values", ())]


# Terms with the same coordinate are collected if this makes the `length` of the energy greater by at most this number.
LITTLE_LONGER = 2


def _terms_together(value: Expr, moving: Sequence[Symbol]) -> Expr:
    """Simplify term by term, or expand if terms of several bodies then combine: -(M + m) g l cos(theta)."""
    collected = with_constants_together(value.expand(), moving)
    forms = [by_terms(value), by_terms(value.expand()), collected]
    shortest = min(forms, key=length)
    is_short = length(collected) <= length(shortest) + LITTLE_LONGER
    not_more = len(Add.make_args(collected)) <= len(Add.make_args(shortest))
    if is_short and not_more and _count(collected, moving) < _count(shortest, moving):
        shortest = collected
    together = Add(*(spread(term) for term in Add.make_args(shortest)))
    return min((with_constants_in_front(together, [q for q in moving if q != TIME]), together), key=length)


def _count(value: Expr, letters: Collection[Symbol]) -> int:
    return sum(part in letters for part in preorder_traversal(value))


POTENTIAL_ENERGY = Rule(
    "lagrange.potential_energy",
    source="Taylor, *Classical Mechanics*, section 4.2",
    outcomes={"generic": claims.on_the_sides_that_are_assumed, "zero": vanishes},
    evidence={"work": ROUTE},
    shown=Shown(condition_if=lambda step: dict(step.words)["seen"] == "stretched"),
)


def potential_energy_of(system: System, symbol: str | None = None, key: str = "potential_energy") -> Quantity:
    """Potential energy of a system, U = sum of m g y over the weights + sum of (1/2) k (d - l)^2 over the springs +
    other potential energies.

    system   particles and bodies, with weights, springs and other potential energies

    The height y of a particle or a centre of mass is measured from the origin. By convention U is zero for weights at
    the origin and for springs at their natural length.
    Second route: the forces do the work -dU, so -dU/dq = sum of F . dr/dq for each coordinate, and -dU/dt = sum of
    F . dr/dt for the time t.
    Outcomes: generic, zero.
    Source: Taylor, *Classical Mechanics*, section 4.2.
    """
    moving, matter = [*system.coordinates, TIME], system.matter

    def work(found: Expr) -> tuple[Expr, Expr]:
        marks = [stand_in(f"delta_{q.name}") for q in moving]
        lost = [-derivative(found, q) * mark for q, mark in zip(moving, marks, strict=True)]
        return Add(*lost), Add(*(matter.stored_force_along(q) * mark for q, mark in zip(moving, marks, strict=True)))

    masses = system.masses if system.weights else []
    higher = [(mass, dict(at.found).get(len(at.components) - 1, at.height)) for mass, at in masses if at.height != 0]
    named = {f"height_{i}": y for i, (_, y) in enumerate(higher) if isinstance(y, Quantity)}
    # Factors remain separate if a height is a step or a sum, so that the law shows a sum in brackets.
    as_factors = bool(named) or any(height.is_Add for _, height in higher)
    stored = [bound(each.energy, {each.distance: each.length}) for each in system.between]
    stored += [each.energy for each in system.stored]

    lengths = long_distances(system)
    kept = [each for each in system.between if each.is_spring and Relation(each.length, ">", ZERO) in assumed()]

    def law(*given: Expr) -> Expr:
        known = dict(zip(named, given, strict=True))
        heights = [known.get(f"height_{i}", y) for i, (_, y) in enumerate(higher)]
        weights = [(mass, system.gravity, y) for (mass, _), y in zip(higher, heights, strict=True)]
        terms = [*(Factors(*each) if as_factors else Mul(*each) for each in weights), *stored]
        return Terms(*terms) if len(terms) > 1 else Add(*terms)

    def arranged(value: Expr) -> Expr:
        return explicit(value) if named else _terms_together(value, moving)

    stretches = {} if lengths else _stretches([each for each in system.between if each.is_spring], moving)
    is_result = not named and explicit(law()) == arranged(explicit(law()))
    return establish(
        POTENTIAL_ENERGY,
        scalar(symbol or free_letter("U")),
        law,
        named,
        key=key,
        kind="energy",
        routes={"work": work},
        outcome=lambda value: "zero" if value == 0 else "generic",
        lines=Lines(
            law=Level.FULL if is_result else Level.BRIEF,
            put_in=Level.BRIEF if named else None,
            result=not named,
            arranged=arranged,
        ),
        facts=[replace(matter, points=(), fields=()), *acting_on(system), system.described],
        parents=lengths,
        phrase_data=PhraseData(
            words={"seen": "stretched" if kept else "any"},
            formulas=stretches,
            outcome_data={"branches": tuple(each.branch for each in system.between if each.branch is not None)},
        ),
        scope=Scope(coordinates=system.coordinates, about=Subject(body=system)),
    )


FEW_SPRINGS, SHORT = 4, 6  # greatest number of extensions in a sentence, and greatest `length` of their formulas


def _stretches(springs: Sequence[Any], moving: Sequence[Symbol]) -> dict[str, tuple[Expr, Expr]]:
    """Return two expressions for the extension of each spring: length minus natural length, and force divided by spring
    constant. The result is empty if the sentence does not need the extensions or would be too long."""
    found: dict[str, tuple[Expr, Expr]] = {}
    for i, each in enumerate(springs, 1):
        constant = derivative(each.pull, each.distance)
        natural = tidied(each.distance - each.pull / constant)
        extension = tidied(each.length - natural)
        if natural == 0 or extension.has(Pow) or length(extension) > SHORT or not extension.has(*moving):
            return {}
        found[f"stretch_{i}"] = (extension, each.pull.xreplace({each.distance: each.length}) / constant)
    return found if len(found) <= FEW_SPRINGS else {}


MAGNETIC_TERM = Rule(
    "lagrange.magnetic_term",
    source=(
        "Goldstein, Poole, Safko, *Classical Mechanics*, section 1.5; the gauge is that of Landau, Lifshitz, "
        "*The Classical Theory of Fields*, section 19"
    ),
    outcomes={"alone": claims.magnetic_term_alone, "several": claims.magnetic_term_several},
    evidence={"deflection": ROUTE},
)


def magnetic_term_of(system: System, symbol: str = "L_B", key: str = "magnetic_term") -> Quantity:
    """Term of uniform magnetic fields in a Lagrangian, sum of q v . A with the vector potential A = (1/2) B x r, J.

    system   charges q, in C, in magnetic fields B, in T

    Second route: for this term L_B, dL_B/ds - d/dt dL_B/ds_dot is the virtual work of the forces q v x B along each
    coordinate s.
    Outcomes: alone (one charge in a field), several.
    Errors: no charge of the system is in a magnetic field.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.5; the gauge is that of Landau, Lifshitz, *The
    Classical Theory of Fields*, section 19.
    """
    moving, matter = list(system.coordinates), replace(system.matter, points=(), loads=(), others=())
    if not matter.fields:
        raise Rejected(Complaint("wrong-argument", "`magnetic_term_of` needs a charge in a magnetic field"))

    def law() -> Expr:
        terms = []
        for field in matter.fields:
            pairs = zip(field.vector_potential, field.place, strict=True)
            changing = [(a, c) for a, c in pairs if a != 0 and (c.has(*moving) or depends_on_time(c))]
            rates = [Factors(a, rate(c) if c in moving else TimeRate(c, *moving)) for a, c in changing]
            terms.append(Factors(field.charge, Terms(*rates) if len(rates) > 1 else Add(*rates)))
        return Terms(*terms) if len(terms) > 1 else terms[0]

    def deflection(found: Expr) -> tuple[Expr, Expr]:
        marks = [stand_in(f"delta_{q.name}") for q in moving]
        pairs = list(zip(moving, marks, strict=True))
        slopes = (derivative(found, q) - by_functions_of_time(derivative(found, rate(q)), moving) for q in moving)
        works = (matter.deflection_along(q) * mark for q, mark in pairs)
        return Add(*(slope * mark for slope, mark in zip(slopes, marks, strict=True))), Add(*works)

    return establish(
        MAGNETIC_TERM,
        scalar(symbol),
        law,
        {},
        key=key,
        kind="energy",
        routes={"deflection": deflection},
        outcome="several" if len(matter.fields) > 1 else "alone",
        lines=Lines(put_in=None, arranged=lambda value: with_constants_in_front(by_rates(value, moving), moving)),
        phrase_data=PhraseData(outcome_data={"fields": len(matter.fields)}),
        facts=[matter],
        scope=Scope(coordinates=system.coordinates, about=Subject(body=system)),
    )
