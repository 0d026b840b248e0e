"""Inextensible strings and ropes, massless rods, pulleys and smooth wires."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, pairwise, product
from typing import Any, Self

from sympy import Abs, Add, Expr, ImmutableDenseMatrix, Integer, Symbol

from derive.algebra.expressions import as_expr, depends_on_time, explicit, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.bodies.placed import PlacedBody
from derive.mechanics.kinematics.places import Location
from derive.mechanics.model.connection import Connection, PointForce, end_of, is_end, require_bodies
from derive.mechanics.model.constraint import Constraint
from derive.mechanics.model.contact_points import has_radius, radius_of
from derive.mechanics.model.dalembert import Load
from derive.mechanics.model.forces import StoredEnergy
from derive.mechanics.model.no_slip import velocity_at
from derive.mechanics.model.part import Part, moved
from derive.mechanics.model.surfaces import Circle, column_of, direction_between, distance_between, dot, raw_distance
from derive.steps.record import coordinates_in, require_constant, require_no_coordinate
from derive.steps.signs import sign_for_all
from derive.steps.step import is_zero

__all__ = ["massless_rod", "pulley", "string", "wire", "wound_string"]

ZERO = Integer(0)


@dataclass(frozen=True)
class Pulley(Connection):
    """A massless frictionless pulley: a circle over which strings run.

    at       the centre of the pulley
    radius   the radius of the pulley, m
    """

    at: Location
    radius: Expr

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        return replace(super().moved(known), at=self.at.with_values(known), radius=self.radius.subs(known))


@dataclass(frozen=True)
class Rim(Pulley):
    """The rim of a round body on which a string is wound, or over which it runs.

    of   the body
    """

    of: PlacedBody


@dataclass(frozen=True)
class Line(Connection):
    """A string, a rope or a massless rod.

    through   one end, the pulleys or holes in order, and the other end; each is a place, or a pulley with a radius
    is_rod    whether the line is a rod, which can push as well as pull
    rope      the particle whose mass is distributed along the line; None for a line without mass
    drawn     the symbol of the tension in force diagrams, if the coordinates keep the length constant
    pieces    the straight pieces, in order, if `drawn` is given; otherwise empty
    """

    through: tuple[Location | Pulley, ...]
    is_rod: bool
    rope: Any = None
    drawn: Symbol | None = None
    pieces: tuple[Piece, ...] = ()
    lengths: tuple[Expr, ...] = ()

    @property
    def places(self) -> tuple[Location, ...]:
        """The ends, and the holes and centres of pulleys between them."""
        return tuple(each.at if isinstance(each, Pulley) else each for each in self.through)

    def weighed(self, gravity: Expr) -> Sequence[Part]:
        """Return the correction for the weight of a rope; nothing for a line without mass, or if no coordinate changes
        the correction."""
        if self.rope is None:
            return ()
        found = _weight_of_rope(self.places, self.lengths, self.rope, gravity)
        return (found,) if coordinates_in(found.energy) else ()

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        through = (e.moved(known) if isinstance(e, Pulley) else e.with_values(known) for e in self.through)
        pieces = tuple(piece.moved(known) for piece in self.pieces)
        lengths = tuple(length.subs(known) for length in self.lengths)
        line = replace(super().moved(known), through=tuple(through), rope=moved(self.rope, known))
        return replace(line, pieces=pieces, lengths=lengths)

    def drawn_on(self, of: Any) -> list[tuple[Location, Location]]:
        """Return the pieces of the line that pull a body, a particle or a pulley, for its force diagram; none for a
        rope with mass, or without `drawn`. Each item contains the two ends of a piece: the end that pulls, then the
        other end."""
        if self.drawn is None or self.rope is not None:
            return []
        ends = [(piece.start, piece.end) for piece in self.pieces], [(piece.end, piece.start) for piece in self.pieces]
        if not isinstance(of, Pulley):
            owners = [[piece.of[k] for piece in self.pieces] for k in (0, 1)]
            return [end for k in (0, 1) for end, own in zip(ends[k], owners[k], strict=True) if own == of]
        found = []
        for k, each in enumerate(self.through):
            if each == of or isinstance(each, Location) and each.components == of.at.components:
                found += [*ends[1][max(k - 1, 0) : k], *ends[0][k : k + 1]]
        return found


@dataclass(frozen=True)
class WeightOfRope(StoredEnergy):
    """The correction for the weight of a rope. In the system, a particle with the mass of the rope represents the rope.
    The potential energy of this particle is subtracted from the potential energy of the rope.

    energy   the sum of (mass) g (height of the middle) over the straight pieces, minus M g y of the particle, J
    force    a force on the first end, along the rope, that does the work of the weight. Let y_0 and y_1 be the heights
             of the first and the second end. If all pieces move by ds along the rope towards the second end, this work
             is (M/l) g (y_0 - y_1) ds
    at       the position of the first end
    """

    force: tuple[Expr, ...]
    at: tuple[Expr, ...]

    def moved(self, known: Mapping[Symbol, Expr]) -> WeightOfRope:
        force, at = (tuple(c.subs(known) for c in each) for each in (self.force, self.at))
        return WeightOfRope(self.energy.subs(known), force, at)

    def stored_loads(self, moving: Sequence[Symbol]) -> list[Load]:
        return [Load(self.force, self.at)]


def _weight_of_rope(places: Sequence[Location], lengths: Sequence[Expr], particle: Any, gravity: Expr) -> WeightOfRope:
    pieces = list(pairwise(places))
    per_length = particle.mass * gravity / tidied(Add(*lengths))
    middles = [(one.height + other.height) / 2 for one, other in pieces]
    energy = per_length * Add(*(size * y for size, y in zip(lengths, middles, strict=True)))
    along = (c / lengths[0] for c in (places[1] - places[0]).components)
    pull = per_length * (places[0].height - places[-1].height)
    lowest = tidied(energy - particle.mass * gravity * particle.at.height)
    return WeightOfRope(lowest, tuple(tidied(pull * c) for c in along), places[0].components)


@dataclass(frozen=True)
class Wire(Connection):
    """A smooth wire on which a particle is threaded; the wire is the curve on which the particle moves."""

    of: Any

    def moved(self, known: Mapping[Symbol, Expr]) -> Self:
        return replace(super().moved(known), of=moved(self.of, known))


@dataclass(frozen=True)
class Piece:
    """A straight piece of a string or of a rod: its ends, and the bodies to which they belong."""

    start: Location
    end: Location
    of: tuple[Any, Any]

    def moved(self, known: Mapping[Symbol, Expr]) -> Piece:
        of = tuple(moved(each, known) for each in self.of)
        return Piece(self.start.with_values(known), self.end.with_values(known), (of[0], of[1]))

    @property
    def growth(self) -> Expr:
        """The rate at which the distance of the ends would change if the string could stretch, m/s."""
        ends = zip((self.start, self.end), self.of, strict=True)
        first, last = (velocity_at(place if of is None else of, place) for place, of in ends)
        return dot(direction_between(self.start, self.end), last - first)

    def pulls(self, tension: Symbol) -> tuple[PointForce, PointForce]:
        """The forces on the two ends: each is the tension, directed towards the other end."""
        along = direction_between(self.start, self.end)
        return (
            PointForce(tension, along.components, self.start, self.of[0]),
            PointForce(tension, (-along).components, self.end, self.of[1]),
        )


def pulley(at: Location, radius: Any) -> Pulley:
    """A massless frictionless pulley with its centre at a place.

    radius   the radius, m; a string leaves the pulley along a tangent
    """
    if not isinstance(at, Location):
        raise Rejected(Complaint("wrong-argument", "`pulley` needs the place of its centre"))
    size = as_expr(radius)
    require_constant("pulley", "radius", size)
    return Pulley((), at, size)


def wire(of: Any) -> Wire:
    """A smooth wire on which a particle is threaded. The place of the particle must depend on exactly one coordinate.

    of   the particle that is threaded on the wire
    """
    place = getattr(of, "at", None)
    moving = coordinates_in(ImmutableDenseMatrix(place.components)) if isinstance(place, Location) else {}
    if len(moving) != 1:
        message = f"a particle on a `wire` must have one coordinate, but this particle has {len(moving)}"
        help_line = "leave the wire out, or give the place of the particle as a function of one coordinate"
        raise Rejected(Complaint("wrong-argument", message, help=help_line))
    return Wire((), of)


def string(
    start: Any,
    end: Any,
    length: Any = None,
    over: Sequence[Any] = (),
    tension: str = "",
    mass_of: Any = None,
    drawn_tension: str = "",
) -> tuple[Line | Constraint, ...]:
    """A massless inextensible string between two ends, over massless frictionless pulleys or through smooth holes.
    With `mass_of`, it is a uniform rope that has the mass of a particle.

    start, end   particles, bodies, points of bodies, or places; with `tension`, a place must contain no coordinate
    length       the total length of the straight pieces, m; it may be a function of the time, for a string that is
                 pulled in
    over         the pulleys or holes between the ends. For a hole, or for a pulley of negligible radius, give a place,
                 a particle or a point of a body
    tension      the symbol of the tension, N; positive if the string pulls. The symbol and the length are required if
                 the coordinates allow the length to change
    mass_of      for a uniform rope: the particle that has the mass of the rope. All pieces of the rope must have the
                 speed of the particle, so that (1/2) M v^2 of the particle is the kinetic energy of the rope. The
                 height of the particle must be constant; gravity acts on each piece of the rope
    drawn_tension   the symbol of the tension in force diagrams, if the coordinates keep the length of the string
                 constant. No equation contains this tension. For a rope with mass, it is the tension at the bends of
                 the rope

    The tension is the same everywhere in a string without mass. The string pulls each end along the string, and each
    pulley along the two adjacent pieces of the string.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 3.
    """
    if tension and drawn_tension:
        message = f"force diagrams show the tension `{tension}`, so `{drawn_tension}` has no effect"
        raise Rejected(Complaint("twice", message, help="leave out `drawn_tension`"))
    line, *more = _of_length("string", (start, *over, end), length, tension)
    assert isinstance(line, Line)
    if drawn_tension:
        line = replace(line, drawn=scalar(drawn_tension), pieces=tuple(_pieces((start, *over, end))))
    if mass_of is None:
        return line, *more
    _check_rope(line, mass_of, tension)
    if length is None:
        _require_known_signs(line.lengths)
    return (replace(line, rope=mass_of),)


BESIDE_THE_ROPE = (
    "give the particle any constant height and the speed of the rope: `at: [x, 0]` if one end is at `[0, x - l]`"
)


def _check_rope(line: Any, particle: Any, tension: str) -> None:
    """Require each piece of a rope to move along itself, with the speed of the particle that has the mass of the
    rope."""
    if not hasattr(particle, "mass") or not is_end(particle):
        raise Rejected(Complaint("wrong-argument", "`mass_of` must be the particle that has the mass of the rope"))
    if tension:
        message = f"the tension of a rope with mass is not the same everywhere, so `{tension}` does not appear"
        raise Rejected(Complaint("not-an-unknown", message, help="leave out `tension`"))
    still = not any(coordinates_in(at) or depends_on_time(at) for at in map(column_of, line.places[1:-1]))
    if not still or any(_rotates(b - a) for a, b in pairwise(line.places)):
        message = "the pieces of a rope with mass must move along themselves, but a bend moves or a piece rotates"
        help_line = "keep the bends of the rope at rest; describe a rotating rope as several rods"
        raise Rejected(Complaint("wrong-argument", message, help=help_line))
    first, last, own = (velocity_at(each, line.places[0]) for each in (line.places[0], line.places[-1], particle))
    if any(not is_zero(tidied(dot(v, v) - dot(own, own))) for v in (first, last)):
        message = "the speed of the rope differs from the speed of the particle that has the mass of the rope"
        raise Rejected(Complaint("which-body", message, help=BESIDE_THE_ROPE))
    if not is_zero(own.components[-1]):
        message = "the particle that has the mass of the rope must stay at a constant height, but it moves up or down"
        raise Rejected(Complaint("which-body", message, help=BESIDE_THE_ROPE))


def _require_known_signs(lengths: Sequence[Expr]) -> None:
    """Reject a length whose sign is unknown where all coordinates are zero: the length of the rope would be a guess."""
    for each in map(_at_zero, lengths):
        if each != 0 and sign_for_all(each) is None:
            message = (
                f"if all coordinates are zero, a piece of the rope is |{each}| long, but the sign of {each} is unknown"
            )
            help_line = "give the `length` of the rope, or a relation under `assume:` that decides the sign"
            raise Rejected(Complaint("sign", message, help=help_line))


def _at_zero(length: Expr) -> Expr:
    return tidied(length.xreplace(dict.fromkeys(coordinates_in(length), ZERO)))


def _rotates(way: Location) -> bool:
    """Whether the direction of a displacement changes."""
    fast = velocity_at(way, way)
    pairs = combinations(zip(way.components, fast.components, strict=True), 2)
    return any(not is_zero(tidied(a * b_dot - b * a_dot)) for (a, a_dot), (b, b_dot) in pairs)


def massless_rod(start: Any, end: Any, length: Any = None, force: str = "") -> tuple[Line | Constraint, ...]:
    """A massless rigid rod between two hinges, which pulls or pushes only along its direction.

    start, end   particles, bodies, points of bodies, or places; with `force`, a place must contain no coordinate
    length       the length of the rod, m
    force        the symbol of the force in the rod, N; positive in tension. The symbol and the length are required if
                 the coordinates allow the length to change

    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 3.
    """
    return _of_length("massless_rod", (start, end), length, force)


def _of_length(verb: str, ends: Sequence[Any], length: Any, letter: str) -> tuple[Line | Constraint, ...]:
    """Return the line.

    If the symbol of its force is given, also return the constraint l - (length of the line) = 0, whose multiplier is
    this force.
    """
    whole = as_expr(length) if length is not None else None
    if whole is not None:
        require_no_coordinate(verb, "length", whole)
    if not all(is_end(each) or isinstance(each, Pulley) for each in ends):
        message = f"each end of a `{verb}` must be a particle, a body, a point of a body or a place"
        message += "; `over` may also contain pulleys" if len(ends) > 2 else ""
        how = Spelled('give a point of a body as `rod.place_of("end")`', "give a point of a body as `rod.end`")
        raise Rejected(Complaint("wrong-argument", message, help=how))
    for wheel in ends[1:-1]:
        if isinstance(wheel, PlacedBody) and has_radius(wheel):
            message = f"the string runs over {wheel.body.name}, which has a radius"
            help_line = "describe each side as a string that is `wound_on` the body, or give a pulley without mass"
            raise Rejected(Complaint("wrong-argument", message, help=help_line))
    is_rod = verb == "massless_rod"
    pieces = _pieces(ends)
    through = tuple(each if isinstance(each, Pulley) else end_of(each)[0] for each in ends)
    lengths = _kept_lengths([(piece.start, piece.end) for piece in pieces], whole)
    kept = tidied(Add(*lengths)) if lengths is not None else None
    if not letter:
        _require_kept(verb, kept, whole)
        return (Line((), through, is_rod, lengths=tuple(lengths or ())),)
    if whole is None:
        message = f"a `{verb}` with a symbol for its force also needs a `length`"
        raise Rejected(Complaint("missing-key", message, help="give its `length`"))
    if kept is not None:
        message = f"the coordinates determine the length {kept}, so the force `{letter}` does not appear"
        key, what = ("force", "rod") if is_rod else ("tension", "string")
        help_line = f"leave out `{key}`, or give one end a coordinate along the {what}, so that the length can change"
        raise Rejected(Complaint("not-an-unknown", message, help=help_line))
    require_bodies(verb, [pair for piece in pieces for pair in zip((piece.start, piece.end), piece.of, strict=True)])
    force = scalar(letter)
    pulls = tuple(pull for piece in pieces for pull in piece.pulls(force))
    found = tidied(Add(*(distance_between(piece.start, piece.end) for piece in pieces)))
    constraint = Constraint(whole, found, force, forces=pulls, enforcer="rod" if is_rod else "string")
    return Line(pulls, through, is_rod), constraint


def _pieces(ends: Sequence[Any]) -> list[Piece]:
    """Return the straight pieces between neighbouring ends and pulleys."""
    found = []
    for one, other in pairwise(ends):
        tangent = _tangent(one, other)
        bodies = [_owner(each) for each in (one, other)]
        found.append(Piece(*tangent, (bodies[0], bodies[1])))
    for one, other in pairwise(found):
        if one.end == other.start and _is_on_rim(one.end, ends):
            where = ", ".join(map(str, one.end.components))
            message = f"the string leaves a pulley at ({where}), where it also arrives"
            raise Rejected(Complaint("no-contact", message, help="put its two ends on different sides of the pulley"))
    return found


def _owner(each: Any) -> Any:
    """Return the body or particle that a piece of string pulls at one end; None for a massless pulley, or for a place
    that belongs to no body or particle."""
    if isinstance(each, Pulley):
        return each.of if isinstance(each, Rim) else None
    return end_of(each)[1]


def _is_on_rim(place: Location, ends: Sequence[Any]) -> bool:
    return any(isinstance(each, Pulley) and place != each.at for each in ends) and not any(
        place == end_of(each)[0] for each in ends if not isinstance(each, Pulley)
    )


def _tangent(one: Any, other: Any) -> tuple[Location, Location]:
    """Return the ends of the straight piece between two neighbours along a string; a piece at a pulley must be parallel
    to an axis.
    """
    if not isinstance(one, Pulley) and not isinstance(other, Pulley):
        return end_of(one)[0], end_of(other)[0]
    found = [
        (a, b)
        for k in (0, 1)
        for a, b in product(_touched(one, k), _touched(other, k))
        if is_zero(tidied((b - a).components[k]))
    ]
    round_ = next(each for each in (one, other) if isinstance(each, Pulley))
    name = (
        round_.of.body.name
        if isinstance(round_, Rim)
        else f"the pulley at ({', '.join(map(str, round_.at.components))})"
    )
    if not found:
        message = f"no horizontal or vertical tangent of {name} leads to the next end or pulley"
        help_line = (
            "a vertical string must be one radius to the left or right of the centre, a horizontal string one radius "
            "above or below it"
        )
        raise Rejected(Complaint("no-contact", message, help=help_line))
    if len(found) > 1 and any(isinstance(each, Rim) for each in (one, other)):
        message = f"the string to the next end or pulley may be tangent to {name} on either side"
        help_line = "put the centres of the pulleys at different heights and at different horizontal positions"
        raise Rejected(Complaint("no-contact", message, help=help_line))
    return found[0]


def _touched(each: Any, k: int) -> list[Location]:
    """Return the points at which a line perpendicular to axis k may touch an end or a pulley."""
    if not isinstance(each, Pulley):
        return [end_of(each)[0]]
    ways = ([ZERO] * len(each.at.components) for _ in range(2))
    found = []
    for sign, way in zip((1, -1), ways, strict=True):
        way[k] = sign * each.radius
        found.append(each.at + Location(tuple(way)))
    return found


def _kept_lengths(pieces: Sequence[tuple[Location, Location]], whole: Expr | None = None) -> list[Expr] | None:
    """Return the lengths of the pieces if their sum contains no coordinates; otherwise None.

    The length of a piece on a fixed line is u or -u. If the sign of u is unknown, it is chosen so that the coordinates
    cancel. Among several choices, the first criterion is a sum equal to the given length. The second is lengths that
    are not negative where the coordinates are zero. The third is a sum without a leading minus sign.
    """
    kept = []
    for lengths in product(*(_possible_lengths(*piece) for piece in pieces)):
        found = tidied(Add(*lengths))
        if found != 0 and not coordinates_in(ImmutableDenseMatrix([found])):
            negative = any(sign_for_all(_at_zero(each)) == -1 for each in lengths)
            others = whole is None or not is_zero(found - whole)
            kept.append((others, negative, found.could_extract_minus_sign(), list(lengths)))
    return min(kept, key=lambda each: each[:3])[3] if kept else None


def _possible_lengths(start: Location, end: Location) -> tuple[Expr, ...]:
    """Return u and -u for the length |u| of a straight piece, or only the positive of the two, if the sign of u is
    known."""
    length = raw_distance(start, end).replace(Abs, lambda size: size)
    positive = [each for each in (length, -length) if sign_for_all(each) == 1]
    return tuple(positive) or (length, -length)


def _require_kept(verb: str, kept: Expr | None, whole: Expr | None) -> None:
    """Check a string or rod without a symbol for its force: its length must contain no coordinates, and must equal
    the given length."""
    what = "rod" if verb == "massless_rod" else "string"
    key = "force" if verb == "massless_rod" else "tension"
    if kept is None:
        message = f"the coordinates allow the length of the {what} to change, so a force must keep it constant"
        raise Rejected(Complaint("missing-key", message, help=f"give its `length`, and the symbol of its `{key}`"))
    if whole is None and depends_on_time(kept):
        message = f"the length {kept} of the {what} changes with the time, but a {what} is inextensible by default"
        help_line = f"if the length of the {what} is a given function of the time, give this function as `length`"
        raise Rejected(Complaint("missing-key", message, help=help_line))
    if whole is not None and not is_zero(kept - whole):
        message = f"with these coordinates the {what} has the length {kept}, but its `length` is given as {whole}"
        raise Rejected(Complaint("sizes", message))


def wound_string(end: Any, on: Any, tension: str = "T", over: Sequence[Any] = ()) -> tuple[Line, Constraint]:
    """A string from an end to a round body, on which the string is wound or over which it runs without slipping.

    end      a particle, a point of a body, or a place without coordinates; None if the string is wound on two bodies
    on       a round body in a plane: a yo-yo, or a pulley with a moment of inertia; or two such bodies. The piece of
             string at a rim is horizontal or vertical
    tension  the symbol of the tension, N; positive if the string pulls
    over     the massless pulleys or holes between the end and the body, as for `string`

    At the point of contact, the rim and the string have the same velocity component along the string.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 7.
    """
    rims = on if isinstance(on, tuple) else (on,)
    other = (*over,) if end is None else (end, *over)
    flat = all(isinstance(each, PlacedBody) and each.is_plane for each in rims)
    if not flat or len(rims) != 1 + (end is None):
        message = "`wound_string` is for motion in a plane, with an end and one round body, or with two round bodies"
        raise Rejected(Complaint("wrong-argument", message))
    if not all(is_end(each) or isinstance(each, Pulley) and each in over for each in other):
        message = (
            "`end` of a `wound_string` must be a particle, a body, a point of a body or a place; "
            "`over` may also contain pulleys"
        )
        raise Rejected(Complaint("wrong-argument", message))
    wound = [Rim((), each.hub, radius_of(each), each) for each in rims]
    pieces = _pieces([*wound[1:], *other, wound[0]])
    require_bodies("wound_string", [end_of(each) for each in other if not isinstance(each, Pulley)])
    force = scalar(tension)
    pulls = tuple(pull for piece in pieces for pull in piece.pulls(force))
    shrinks = tidied(-Add(*(piece.growth for piece in pieces)))
    kept = Constraint(shrinks, ZERO, force, in_rates=True, forces=pulls, enforcer="string")
    corners = (each if isinstance(each, Pulley) else end_of(each)[0] for each in over)
    return Line(pulls, (pieces[0].start, *corners, pieces[-1].end), False), kept


def circles_of(system: Any, at: Location) -> list[Circle]:
    """Return the circles on which a straight string or rod of given length keeps a moving point; the other end is
    fixed."""
    found = []
    for line in (part for part in system.parts if isinstance(part, Line)):
        fixed = [place for place in line.places if not coordinates_in(ImmutableDenseMatrix(place.components))]
        kept = next((each for each in system.constraints if each.forces and each.forces == line.forces), None)
        is_here = any(place.components == at.components for place in line.places)
        if kept is None or len(line.places) != 2 or len(fixed) != 1 or not is_here or len(at.components) != 2:
            continue
        if not coordinates_in(kept.left):
            found.append(Circle(None, None, fixed[0], explicit(kept.left), True))
    return found
