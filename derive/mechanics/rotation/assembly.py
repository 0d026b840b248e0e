"""The mass, the centre of mass and the inertia tensor of composite bodies, which have parts in any position and
orientation, and cavities.

The tensor of each part about its centre of mass is rotated to the axes of the whole body and shifted by the
parallel-axis theorem. The shifted tensors of the parts are added; the tensors of cavities are subtracted.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar

from sympy import Add, Expr, Identity, ImmutableDenseMatrix, Integer, MatAdd, MatMul, Pow, Symbol, eye
from sympy.matrices import ImmutableMatrix

from derive.algebra.expressions import (
    Dot,
    Factors,
    Outer,
    Ratio,
    Terms,
    as_expr,
    column,
    component_names,
    explicit,
    scaled,
    tensor,
    vector,
)
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.body import Body
from derive.mechanics.bodies.equimomental import Particles, counted_from, squared_distance, summed, tensor_at
from derive.mechanics.bodies.facts import AboutPoint, CountedFrom, OfBody
from derive.mechanics.bodies.mapped_bodies import GeneralBody
from derive.mechanics.bodies.mapping import Map
from derive.mechanics.bodies.parts import PlacedPart, place_of
from derive.mechanics.bodies.possible import check_parts, require_positive
from derive.mechanics.bodies.regions import Point, Region
from derive.mechanics.rotation import claims
from derive.mechanics.rotation.added_moments import moment_of_parts
from derive.mechanics.rotation.inertia import inertia_tensor
from derive.mechanics.rotation.tensors import seen_particles, shape_of, tensor_entry
from derive.mechanics.theorems import PARALLEL_AXES
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.level import Manner
from derive.steps.rule import ROUTE, Quote, Rule, Shown
from derive.steps.step import Level, Quantity, is_zero
from derive.steps.subject import NOTHING, Subject

__all__ = ["Composite", "PointMass", "PointMasses", "minus"]

ORIGIN = Point("origin", column(0, 0, 0))
EVERYTHING_BUT_ROTATION = ("body", "point", "axes", "mass")


@dataclass(frozen=True)
class PointMass(Body):
    """A particle as a part of a body.

    mass   the mass of the particle
    """

    mass: Expr
    id: ClassVar[str] = "particle"

    def map(self) -> Map:
        return ORIGIN.position, ()

    def particles(self) -> Particles:
        return [(self.mass, ORIGIN.position)]

    def over_mass(self, integrand: Callable[[ImmutableMatrix], Any], point: Point) -> Any:
        return self.mass * explicit(integrand(point.seen(ORIGIN.position)))


def minus(part: Body | PlacedPart) -> PlacedPart:
    """Return a part with the opposite sign, as a cavity of a body: `Composite(ball, minus(Ball(r, m).at(0, 0, d)))`."""
    placed = part if isinstance(part, PlacedPart) else _placed(part)
    return replace(placed, sign=-placed.sign)


def _placed(part: Any) -> PlacedPart:
    if isinstance(part, PlacedPart):
        return part
    if not isinstance(part, Body):
        message = f"`Composite` needs bodies, not a {type(part).__name__}"
        raise Rejected(Complaint("wrong-argument", message, help="write Composite(Rod(l, m).at(0, 0, -l/2), ...)"))
    if isinstance(part, PointMass):
        return PlacedPart(part, "centre", ORIGIN.position)
    return PlacedPart.as_it_lies(part)


class Composite(Body):
    """A composite body: `Composite(Rod(l, m).at(0, 0, -l/2), Ball(R, M).at(0, 0, -l), points={"pivot": (0, 0)})`.

    parts    bodies. `.at(x, y, z)` moves the centre of mass of a body to this position; `.at(x, y, z, of="end")` moves
             the point "end" of the body to this position. `.turned("x", angle)` rotates the body about the point that
             `.at` moved. `minus(part)` is a cavity
    mass     the mass of a uniform composite body; the masses of the parts are proportional to their sizes
    points   names for positions in the whole body, such as a pivot

    Two parts of the same shape need names: `Rod(l, m).named("upper rod").at(...)`.
    Errors: there is no part; the names of two parts have the same first word; the parts cannot form a body, for example
    because two of them overlap; the mass of the whole body is not positive; one mass is given, but the parts are not
    all volumes, all areas or all lengths.
    """

    id: ClassVar[str] = "body_of_several_parts"
    reference: ClassVar[str] = "origin"
    other_centre: ClassVar[str] = "origin"

    def __init__(
        self, *parts: Body | PlacedPart, mass: Expr | None = None, points: Mapping[str, Sequence[Any]] | None = None
    ):
        placed = [_placed(part) for part in parts]
        if not placed:
            raise Rejected(Complaint("parts", "a composite body needs parts"))
        self.parts = _told_apart(placed)
        self.shares: tuple[Quantity, ...] = ()
        self._places = {name: Point(name, place_of(*place)) for name, place in (points or {}).items()}
        self.names_given = tuple(self._places)
        check_parts(self.parts)
        if mass is not None:
            self.shares, self.parts = _shared(self, mass)
        self.given_mass = mass
        if is_zero(self.mass):
            raise Rejected(Complaint("no-mass", "the cavities of this body have as much mass as its parts"))
        require_positive(self.name, "mass", self.mass)

    @cached_property
    def mass(self) -> Expr:
        given = getattr(self, "given_mass", None)
        return given if given is not None else tidied(sum((part.mass for part in self.parts), Integer(0)))

    @property
    def measures(self) -> Mapping[str, Any]:
        """Empty: only the parts of a composite body have measures."""
        return {}

    @property
    def boundary(self) -> None:
        """None: only the parts of a composite body have a boundary."""
        return None

    def points(self) -> Mapping[str, Point]:
        return {"origin": ORIGIN, **self._places}

    def particles(self) -> Particles:
        return [particle for part in self.parts for particle in part.particles]

    def region(self, point: Point, coordinates: str | None = None) -> Region:
        raise Rejected(Complaint("no-region", "a body of several parts has no single region of integration"))

    def over_mass(self, integrand: Callable[[ImmutableMatrix], Any], point: Point) -> Any:
        """Return the sum of the integrals over the parts, with cavities subtracted."""
        total: Any = None
        for part in self.parts:
            found = part.body.over_mass(lambda r, part=part: integrand(point.seen(part.seen(r))), ORIGIN)
            total = part.sign * found if total is None else total + part.sign * found
        return total

    @property
    def flat_across(self) -> str | None:
        """The first axis whose coordinate is zero for all particles of the body; None if there is no such axis."""
        return next((axis for k, axis in enumerate("xyz") if all(is_zero(r[k]) for _, r in self.particles())), None)

    @cached_property
    def whole_mass(self) -> Quantity:
        """The step that derives the mass of the whole body, the sum of the masses of the parts."""
        return _total_mass(self)

    @property
    def density(self) -> Quantity:
        """A step for a mass, because a composite body has no single density.

        If one mass is given for the whole body, the step derives the mass of the first part, otherwise the total mass.
        """
        return self.shares[0] if self.shares else self.whole_mass

    def derived_centre(self, start: Point, symbol: str, key: str) -> Quantity:
        return _centre_of_parts(self, start, symbol, key)

    def derived_tensor(self, point: Point, symbol: str, key: str) -> Quantity:
        return _tensor_of_parts(self, point, symbol, key)

    def derived_moment(self, axis: str, point: Point, symbol: str, key: str) -> Quantity:
        added = moment_of_parts(self, axis, point, symbol, key)
        return added or tensor_entry(_tensor_of_parts(self, point, "K", f"{key}_tensor"), axis + axis, symbol, key)


def PointMasses(*masses: tuple[Expr, Sequence[Any]]) -> Composite:
    """Return a body of particles connected by massless links: `PointMasses((m, (a, 0, 0)), (2*m, (0, a, a)))`."""
    return Composite(*(_placed(PointMass(as_expr(mass))).at(*place) for mass, place in masses))


def _told_apart(parts: list[PlacedPart]) -> tuple[PlacedPart, ...]:
    """Return the parts, each with a name unless it is a particle: the given name, or the name of its shape."""
    found = [
        part if isinstance(part.body, PointMass) or part.body.called else part.named(part.body.id.replace("_", " "))
        for part in parts
    ]
    names = [part.body.called for part in found if not isinstance(part.body, PointMass)]
    first_words = [name.partition(" ")[0] for name in names]
    for taken, message in ((names, "two parts are both called"), (first_words, "the names of two parts begin with")):
        twice = next((name for name, times in Counter(taken).items() if times > 1), None)
        if twice is not None:
            message += f" `{twice}`"
            help_line = 'give the parts names whose first words differ: Rod(l, m).named("upper rod")'
            raise Rejected(Complaint("parts", message, help=help_line))
    return tuple(found)


def _index(part: PlacedPart) -> str:
    return str(part.body.called).partition(" ")[0]


def _shared(body: Composite, mass: Expr) -> tuple[tuple[Quantity, ...], tuple[PlacedPart, ...]]:
    """For a uniform body, return the steps that derive the masses of the parts in proportion to their sizes, and the
    parts with these masses."""
    if len({part.body.filling for part in body.parts}) > 1 or any(isinstance(p.body, PointMass) for p in body.parts):
        message = "one mass cannot be divided between volumes, areas, lengths and particles"
        raise Rejected(Complaint("parts", message, help="give each part a mass"))
    shares = tuple(_share_of_mass(body, part, mass) for part in body.parts)
    parts = []
    for part, share in zip(body.parts, shares, strict=True):
        of_part = replace(part.body, mass=share.value)
        object.__setattr__(of_part, "called", part.body.called)
        parts.append(replace(part, body=of_part))
    return shares, tuple(parts)


SHARE_OF_MASS = Rule(
    "rotation.share_of_mass",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4",
    outcomes={"part": claims.part_of_sign(1), "hole": claims.part_of_sign(-1)},
    evidence={"integration": ROUTE},
)


def _share_of_mass(body: Composite, part: PlacedPart, mass: Expr) -> Quantity:
    """Mass of a part of a uniform body, M times the size of the part divided by the size of the whole body.

    body   the whole composite body
    part   one of the parts of the whole body, or a cavity
    mass   the mass M of the whole body

    Second route: the density of the whole body integrated over the part.
    Outcomes: part, hole.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4.
    """
    sizes = [other.sign * other.body.size for other in body.parts]

    def size_of(one: PlacedPart) -> Expr:
        own = one.body
        return explicit(own.region(own.point(own.reference)).with_section_put_in().integral(Integer(1)))

    def by_integration(found: Expr) -> tuple[Expr, Expr]:
        return found * sum((other.sign * size_of(other) for other in body.parts), Integer(0)), mass * size_of(part)

    return establish(
        SHARE_OF_MASS,
        Symbol(f"m_{_index(part)}", positive=True),
        lambda M: Factors(M, Ratio(part.body.size, sizes[0] if len(sizes) == 1 else Terms(*sizes))),
        {"mass": mass},
        key=f"{part.body.called.replace(' ', '_')}_mass",
        kind="mass",
        routes={"integration": by_integration},
        outcome="hole" if part.sign < 0 else "part",
        lines=Lines(put_in=None),
        phrase_data=PhraseData(
            words={"part": part.body.called}, outcome_data={"sign": Integer(part.sign), "part_of": part.body}
        ),
    )


TOTAL_MASS = Rule(
    "rotation.total_mass",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4",
    evidence={"integration": ROUTE},
    shown=Shown(brief=Manner.TOLD, standard=Manner.TOLD),
)


def _total_mass(body: Composite) -> Quantity:
    """Mass of the whole body, the sum of the masses of the parts.

    body   the composite body with its parts

    Second route: the integral of dm over all parts.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4.
    """
    masses = [part.mass for part in body.parts]
    taken = {s.name for mass in masses for s in mass.free_symbols}
    return establish(
        TOTAL_MASS,
        Symbol(next(name for name in ("M", "M_0", "M_total", "M_whole") if name not in taken), positive=True),
        lambda *found: Terms(*found) if len(found) > 1 else found[0],
        {f"part_{i}": mass for i, mass in enumerate(masses)},
        key="total_mass",
        kind="mass",
        routes={"integration": lambda M: (M, body.over_mass(lambda r: Integer(1), ORIGIN))},
        lines=Lines(put_in=None, result=len(Add.make_args(body.mass)) < len(masses)),
        scope=Scope(about=Subject(body=body)),
    )


CENTRE_OF_PARTS = Rule(
    "rotation.centre_of_parts",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4",
    outcomes={"generic": claims.all_is_added, "cut_out": claims.centre_of_parts_cut_out},
    evidence={"integration": ROUTE, "particles": ROUTE},
)


def _centre_of_parts(body: Composite, start: Point, symbol: str, key: str) -> Quantity:
    """Centre of mass relative to a point, r_C = (m_1 r_1 + m_2 r_2 + ...)/M.

    body    the composite body with its parts
    start   the point from which the centre of mass is measured

    Second route: the integral of r dm over all parts; the mean position of the equimomental particles of the parts.
    Outcomes: generic, cut_out (some part is a cavity).
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 4.
    """
    terms = [scaled(part.mass, start.seen(part.centre)) for part in body.parts]
    whole = terms[0] if len(terms) == 1 else MatAdd(*terms)

    def mean_place(found: Any) -> tuple[Any, Any]:
        return body.mass * found, summed(body.particles(), lambda r: counted_from(start, r))

    return establish(
        CENTRE_OF_PARTS,
        vector(symbol),
        lambda M: MatMul(Pow(M, -1), whole, evaluate=False),
        {"mass": body.mass if body.shares else body.whole_mass},
        key=key,
        kind="length",
        parents=[*body.shares, *(part.body.centre for part in body.parts if isinstance(part.body, GeneralBody))],
        routes={
            "integration": lambda r: (body.mass * r, body.over_mass(lambda at: at, start)),
            "particles": mean_place,
        },
        outcome="cut_out" if any(part.sign < 0 for part in body.parts) else "generic",
        lines=Lines(put_in=Level.FULL),
        facts=[CountedFrom(start)],
        phrase_data=PhraseData(words={"start": start.name}),
        scope=Scope(about=Subject(body=body, point=start), differ=EVERYTHING_BUT_ROTATION),
    )


TENSOR_OF_PARTS = Rule(
    "rotation.tensor_of_parts",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
    outcomes=claims.TENSORS,
    evidence={"particles": ROUTE},
)


def _tensor_of_parts(body: Composite, point: Point, symbol: str, key: str) -> Quantity:
    """Inertia tensor of the whole body about a point, the sum of the tensors of the parts.

    body    the composite body with its parts
    point   the point of the tensor; `point.axes` are the axes of the components

    Second route: the moment about any axis n is the sum of m |n x r|^2 over the particles of all parts.
    Outcomes: isotropic, two_equal, diagonal, generic.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3.
    """
    centre = [body.centre] if point.name == "centre" else []
    extended = [part for part in body.parts if not isinstance(part.body, PointMass)]
    moved = [_tensor_of_part(body, part, point, symbol, key) for part in extended]
    at_points = [part for part in body.parts if isinstance(part.body, PointMass)]

    def law(*found: Any) -> Any:
        terms = [one if part.sign > 0 else scaled(Integer(-1), one) for part, one in zip(extended, found, strict=True)]
        terms += [scaled(part.mass, tensor_at(point.seen(part.centre))) for part in at_points]
        return terms[0] if len(terms) == 1 else MatAdd(*terms)

    return establish(
        TENSOR_OF_PARTS,
        tensor(symbol),
        law,
        {f"part_{i}": _for_the_whole(one) for i, one in enumerate(moved)},
        key=key,
        kind="moment of inertia",
        parents=[*body.shares, *centre],
        routes={"particles": lambda found: _about_any_axis(found, seen_particles(body, point))},
        outcome=shape_of,
        lines=Lines(put_in=Level.FULL),
        facts=[OfBody(body), AboutPoint(point)],
        phrase_data=PhraseData(words={"about": _told(point)}),
        scope=Scope(about=Subject(body=body, point=point), differ=EVERYTHING_BUT_ROTATION),
    )


def _told(point: Point) -> str:
    """Return the word for a point. The centre of the whole body is "centre_of_mass", since each part also has a
    centre."""
    return "centre_of_mass" if point.name == "centre" else point.name


def _for_the_whole(part: Quantity) -> Quantity:
    """Return a quantity of a part without its subject, since the sum belongs to the whole body."""
    return replace(part, subject=NOTHING)


def _steiner(mass: Expr, d: Any) -> Any:
    return scaled(mass, MatAdd(scaled(Dot(d, d), Identity(3)), scaled(Integer(-1), Outer(d, d))))


TENSOR_OF_PART = Rule(
    "rotation.tensor_of_part",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3 (parallel axes)",
    outcomes={
        "turned_there": claims.moved(False, True),
        "moved": claims.moved(True, False),
        "turned_moved": claims.moved(True, True),
    },
    evidence={"particles": ROUTE},
    quotes=[Quote(PARALLEL_AXES, frozenset({"moved", "turned_moved"}))],
)


def _tensor_of_part(body: Composite, part: PlacedPart, point: Point, symbol: str, key: str) -> Quantity:
    """Inertia tensor of one part about a point of the whole body, R I R^T + m (d.d 1 - d d). If R is 1 and d is zero,
    the result is the step that derives I, the tensor of the part about its centre of mass.

    body    the whole composite body
    part    one of the parts of the whole body; R is the rotation of the part, and d is the displacement of its centre
            of mass from the point
    point   the point of the tensor; `point.axes` are the axes of the components

    Second route: the moment about any axis n is the sum of m |n x r|^2 over the particles of the part.
    Outcomes: turned_there (the centre of the part is at the point), moved, turned_moved.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3 (parallel axes).
    """
    own = inertia_tensor(part.body, "centre", key="own_tensor")
    turn = ImmutableDenseMatrix((point.axes.T * part.turn).applyfunc(tidied))
    is_turned, d = turn != eye(3), point.seen(part.centre)
    if not is_turned and is_zero(d):
        return own
    way = None if is_zero(d) else _way_to_part(part, point, d)
    here = replace(part, sign=1)

    def law(I: Any, *to_it: Any) -> Any:
        along = MatMul(turn, I, turn.T, evaluate=False) if is_turned else I
        return MatAdd(along, _steiner(part.body.mass, to_it[0])) if to_it else along

    def any_axis(found: Any) -> tuple[Expr, Expr]:
        return _about_any_axis(found, [(m, counted_from(point, r)) for m, r in here.particles])

    return establish(
        TENSOR_OF_PART,
        tensor("J" if symbol.startswith("J") else "I'"),
        law,
        {"own": own, **({"way": way} if way else {})},
        key=f"part_of_{key}",
        kind="moment of inertia",
        routes={"particles": any_axis},
        outcome=_PLACED[is_turned, way is not None],
        lines=Lines(put_in=Level.FULL),
        phrase_data=PhraseData(words={"about": _told(point)}, outcome_data={"turn": turn}),
        scope=Scope(about=Subject(body=part.body, point=point), differ=EVERYTHING_BUT_ROTATION),
    )


_PLACED = {
    (False, True): "moved",
    (True, False): "turned_there",
    (True, True): "turned_moved",
}


WAY_TO_PART = Rule(
    "rotation.way_to_part",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 1.2",
    evidence={"particles": ROUTE},
)


def _way_to_part(part: PlacedPart, point: Point, d: Any) -> Quantity:
    """Displacement of the centre of mass of a part from a point of the whole body.

    part    the part of the composite body
    point   the point of the whole body
    d       the displacement, computed from the position and the rotation of the part

    Second route: the mean position of the particles of the part.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 1.2.
    """

    def mean() -> Any:
        return summed(replace(part, sign=1).particles, point.seen) / part.body.mass

    return establish(
        WAY_TO_PART,
        vector("d"),
        lambda: d,
        {},
        key="way_from_" + point.name.replace(" ", "_"),
        kind="length",
        routes={"particles": lambda found: (found, mean())},
        phrase_data=PhraseData(words={"about": _told(point)}),
        scope=Scope(about=Subject(body=part.body, point=point)),
    )


def _about_any_axis(found: Any, particles: Sequence[tuple[Expr, Any]]) -> tuple[Expr, Expr]:
    n = column(*component_names("n"))
    return explicit(Dot(n, found * n)), summed(particles, lambda r: explicit(squared_distance(r, n)))
