"""Rotation of a rigid body: angular velocity, kinetic energy, angular momentum, and angles between vectors.

All vectors have components along the body axes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from sympy import (
    Expr,
    ImmutableDenseMatrix,
    Integer,
    Rational,
    acos,
    atan2,
    cos,
    pi,
    sin,
    sqrt,
)

from derive.algebra.expressions import (
    BodyRate,
    Cross,
    Dot,
    Factors,
    Norm,
    Ratio,
    Root,
    Terms,
    applied,
    column,
    component_names,
    explicit,
    scalar,
    scaled,
    vector,
)
from derive.algebra.ranges import strict_sign_within
from derive.algebra.tidy import factored_matrix, size_and_rest, tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.facts import AboutPoint, OfBody
from derive.mechanics.rotation import claims
from derive.mechanics.rotation.facts import RateByParticles
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.record import free_letter, require_constant
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Fact, Form, Level, Quantity, compared_with, is_zero, require_kind
from derive.steps.subject import Subject

__all__ = [
    "angle_between",
    "angular_momentum",
    "any_angular_velocity",
    "cosine_between",
    "kinetic_energy",
    "spin",
]


@dataclass(frozen=True)
class Through(Fact):
    """The point of the body that stays at rest during the rotation."""

    missing = "is not an angular velocity"
    point: str


@dataclass(frozen=True)
class Momentary(Fact):
    """An angular velocity that is known at one instant only, and may change afterwards."""

    missing = "is not the angular velocity at one instant"
    point: str


@dataclass(frozen=True)
class RateOfEnergy(RateByParticles):
    """The rate of the kinetic energy, d(1/2 w . I w)/dt: the sum of m v . a. The rate equals w . N, with the torque
    N."""

    inertia: Quantity
    omega: Quantity

    def rate(self) -> Any:
        acceleration = _acceleration(self.omega)
        return _over_the_body(self.inertia, lambda r: Dot(Cross(self.omega.value, r), acceleration(r)))

    def in_any_axes(self, torque: Any) -> Any:
        w = self.omega.value
        return explicit(Dot(w, torque)) + explicit(Dot(w, _left_by_turning(self.omega)[1]))


@dataclass(frozen=True)
class RateOfTurning(RateByParticles):
    """The rate of the angular momentum L = I w in space, as the sum of m r x a. For a torque N, the component of this
    rate along L is N . L/|L|."""

    inertia: Quantity
    omega: Quantity

    def rate(self) -> Any:
        acceleration = _acceleration(self.omega)
        return _over_the_body(self.inertia, lambda r: Cross(r, acceleration(r)))

    def in_any_axes(self, torque: Any) -> Any:
        momentum = applied(self.inertia.value, self.omega.value)
        return explicit(Dot(momentum, torque)) + explicit(Dot(*_left_by_turning(self.omega)))


@dataclass(frozen=True)
class RateOfSquare(RateByParticles):
    """The rate of the square of a vector: d(v.v)/dt = 2 v.dv/dt."""

    vector: Any
    of: RateByParticles

    def rate(self) -> Any:
        return 2 * explicit(Dot(self.vector, self.of.rate()))

    def in_any_axes(self, torque: Any) -> Any:
        return 2 * self.of.in_any_axes(torque)


ANY_ANGULAR_VELOCITY = Rule(
    "rotation.any_angular_velocity",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 4.8",
)


def any_angular_velocity(through: str = "centre", symbol: str = "omega", key: str = "angular_velocity") -> Quantity:
    """An arbitrary angular velocity, omega = (omega_x, omega_y, omega_z), in 1/s: a definition.

    through   the point of the body that stays at rest

    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 4.8.
    """
    components = column(*component_names(symbol))
    return establish(
        ANY_ANGULAR_VELOCITY,
        vector(symbol),
        lambda: components,
        {},
        key=key,
        kind="angular speed",
        facts=[Through(through)],
        scope=Scope(about=Subject(rotation=components)),
    )


SPIN = Rule(
    "rotation.spin",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 4.9",
    outcomes={"right_handed": claims.turns("right"), "left_handed": claims.turns("left")},
    evidence={"length": CHECK, "parallel": CHECK},
)


def spin(rate: Expr, along: Quantity, through: str = "centre", symbol: str = "omega", key: str = "spin") -> Quantity:
    """Angular velocity of a steady rotation, omega d/|d|.

    rate      angular speed omega, 1/s; a negative rate is a left-handed rotation
    along     vector d (3) along the axis
    through   a point of the body on the axis of rotation; this point stays at rest

    Check: the length of the result is the magnitude of the rate; the scalar product of the result with d is the rate
    times |d|.
    Outcomes: left_handed (the rate is known to be negative), right_handed (any other rate).
    Errors: the body has no point of this name.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 4.9.
    """
    body = along.subject.body
    if body is not None:
        body.point(through)  # raises an error if the body has no such point
    length = tidied(Norm(along.value))
    return establish(
        SPIN,
        vector(symbol),
        lambda w, d: scaled(w / Norm(d), d),
        {"rate": rate, "axis": along},
        lines=Lines(
            between=[] if length == 1 else [Form(scaled(Ratio(rate, length), along.value), "length", Level.STANDARD)],
            put_in=None,
        ),
        routes={
            "length": lambda omega: (length_by_turning(omega) ** 2, rate**2),
            "parallel": lambda omega: (explicit(Dot(omega, along.value)), rate * length),
        },
        outcome="left_handed" if rate.is_negative else "right_handed",
        key=key,
        kind="angular speed",
        facts=[Through(through)],
        scope=Scope(about=lambda omega: Subject(rotation=omega)),
    )


def length_by_turning(v: Any) -> Expr:
    """Return the length of a vector: its x component after a rotation about z into the x-z plane and a rotation about y
    onto the x axis."""
    size, (x, y, z) = size_and_rest(v)
    level = _turned_onto_first(x, y)
    return tidied(size * _turned_onto_first(level, z))


def _turned_onto_first(p: Expr, q: Expr) -> Expr:
    """Rotate the vector (p, q) so that its second component vanishes, and return the first component after the
    rotation."""
    radius = tidied(p**2 + q**2) ** Rational(1, 2)
    return p if radius == 0 else p * (p / radius) + q * (q / radius)


def _over_the_body(inertia: Quantity, integrand: Any) -> Any:
    """Return the integral of a function of r over the mass of the body, where r is measured from the point of the
    tensor."""
    return inertia.needed(OfBody).body.over_mass(integrand, inertia.needed(AboutPoint).point)


def _acceleration(omega: Quantity) -> Callable[[Any], Any]:
    turning = explicit(BodyRate(omega.value, *omega.coordinates))
    return lambda r: explicit(Cross(turning, r)) + explicit(Cross(omega.value, Cross(omega.value, r)))


def _left_by_turning(omega: Quantity) -> tuple[Any, Any]:
    """Return L = I omega and, for a free body, I omega_dot = -omega x L; the entries of the tensor I are symbols."""
    xx, xy, xz, yy, yz, zz = (scalar(f"A_{pair}") for pair in ("xx", "xy", "xz", "yy", "yz", "zz"))
    momentum = explicit(applied(ImmutableDenseMatrix([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), omega.value))
    return momentum, -explicit(Cross(omega.value, momentum))


def _check_point(verb: str, inertia: Quantity, omega: Quantity) -> dict[str, str]:
    """Require a tensor about the point that stays at rest, and return the words with which the sentence names this
    point."""
    require_kind(verb, "inertia", inertia, "moment of inertia")
    require_kind(verb, "omega", omega, "angular speed")
    require_constant(verb, "inertia tensor", inertia, "a body whose size or mass changes is not rigid")
    point, at_rest = inertia.needed(AboutPoint).point.name, omega.needed(Through).point
    if point != at_rest:
        message = f"`{inertia.key}` is about the {point}, but the axis of `{omega.key}` goes through the {at_rest}"
        help_line = (
            "move the tensor to the centre of mass with `moved_to`, or away from it with `moved_from_centre`; "
            f'or give the axis with `through="{point}"`'
        )
        raise Rejected(Complaint("wrong-point", message, help=help_line))
    return {"about": point, "point": point}


def whether_zero(v: Any) -> str:
    """Return the outcome: "zero" if v vanishes, "generic" if v is known to be nonzero for all values of its symbols,
    otherwise "in_general"."""
    if is_zero(v):
        return "zero"
    common, rest = factored_matrix(v)
    return "generic" if common.is_nonzero and any(entry.is_nonzero for entry in rest) else "in_general"


KINETIC_ENERGY = Rule(
    "rotation.kinetic_energy",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
    evidence={"speeds": ROUTE},
    statements=[claims.of_their_kinds],
)


def kinetic_energy(
    inertia: Quantity, omega: Quantity, symbol: str | None = None, key: str = "kinetic_energy"
) -> Quantity:
    """Kinetic energy of rotation, T = (1/2) omega . I omega.

    inertia   tensor (3, 3), kg m^2, about the point that stays at rest
    omega     vector (3), 1/s, same axes

    Second route: half the integral of |omega x r|^2 dm over the body.
    Errors: the axis does not go through the point of the tensor; the size or mass of the body changes; `inertia` is not
    an inertia tensor, or `omega` is not an angular velocity.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3.
    """

    words = _check_point("kinetic_energy", inertia, omega)

    def by_speeds() -> Expr:
        return _over_the_body(inertia, lambda r: Dot(Cross(omega.value, r), Cross(omega.value, r))) / 2

    product = scaled(*factored_matrix(tidied(applied(inertia.value, omega.value))))
    return establish(
        KINETIC_ENERGY,
        scalar(symbol or free_letter("T")),
        lambda w, tensor: Factors(Rational(1, 2), Dot(w, applied(tensor, w))),
        {"omega": omega, "inertia": inertia},
        lines=Lines(
            between=[
                Form(Factors(Rational(1, 2), Dot(omega.value, product)), "applied", Level.FULL),
                *_energy_by_components(inertia.value, omega.value),
            ],
            put_in=Level.FULL,
        ),
        routes={"speeds": compared_with(by_speeds)},
        key=key,
        kind="energy",
        phrase_data=PhraseData(words=words),
        facts=[RateOfEnergy(inertia, omega)],
    )


def _energy_by_components(inertia: Any, omega: Any) -> list[Form]:
    """Return a list with the kinetic energy as an explicit sum, such as
    (1/2) (w^2/14) (M a^2/12) (13*1^2 + 10*2^2 + 5*3^2) for a block
    with the edges a, 2a and 3a that rotates about its diagonal.

    The list is empty unless the axes are principal axes and the ratios of all moments and of all components are
    numbers. It is also empty if all moments are equal, or if the angular velocity is along one of the axes.
    """
    (w, along), (I, moments) = size_and_rest(omega), factored_matrix(inertia)
    terms = [Factors(moment, n**2) for moment, n in zip(moments.diagonal(), along, strict=True) if n != 0]
    is_of_numbers = moments.is_diagonal() and not moments.free_symbols | along.free_symbols
    if not is_of_numbers or len(terms) < 2 or len(set(moments.diagonal())) == 1:
        return []
    return [Form(Factors(Rational(1, 2), _as_ratio(w**2), _as_ratio(I), Terms(*terms)), "products", Level.STANDARD)]


def _as_ratio(size: Expr) -> Expr:
    above, below = size.as_numer_denom()
    return size if below == 1 else Ratio(above, below)


ANGULAR_MOMENTUM = Rule(
    "rotation.angular_momentum",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.1",
    outcomes={
        "parallel": claims.angular_momentum_parallel,
        "generic": claims.angular_momentum_generic,
        "in_general": claims.angular_momentum_in_general,
    },
    evidence={"moments": ROUTE},
    statements=[claims.of_their_kinds],
)


def angular_momentum(inertia: Quantity, omega: Quantity, symbol: str = "L", key: str = "angular_momentum") -> Quantity:
    """Angular momentum, L = I omega, which in general is not parallel to omega.

    inertia   tensor (3, 3), kg m^2, about the point that stays at rest
    omega     vector (3), 1/s, same axes

    Second route: the integral of r x (omega x r) dm over the body.
    Outcomes: parallel (L is parallel to omega, which is along a principal axis), generic (L is never parallel to
    omega), in_general (L may be parallel to omega for some values of the symbols).
    Errors: the axis does not go through the point of the tensor; the size or mass of the body changes; `inertia` is not
    an inertia tensor, or `omega` is not an angular velocity.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.1.
    """
    words = _check_point("angular_momentum", inertia, omega)
    by_moments = compared_with(lambda: _over_the_body(inertia, lambda r: Cross(r, Cross(omega.value, r))))
    return establish(
        ANGULAR_MOMENTUM,
        vector(symbol),
        applied,
        {"inertia": inertia, "omega": omega},
        routes={"moments": by_moments},
        outcome=lambda L: "parallel" if (how := whether_zero(tidied(Cross(omega.value, L)))) == "zero" else how,
        key=key,
        kind="angular momentum",
        phrase_data=PhraseData(words=words),
        facts=[inertia.needed(AboutPoint), RateOfTurning(inertia, omega)],
    )


COSINE_BETWEEN = Rule(
    "rotation.cosine_between",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 1",
    outcomes={
        "parallel": claims.cosine_is(1),
        "opposite": claims.cosine_is(-1),
        "perpendicular": claims.cosine_is(0),
        "generic": claims.cosine_is(None),
    },
    evidence={"triangle": CHECK},
)


def cosine_between(a: Quantity, b: Quantity, key: str = "cosine", angle: str = "theta") -> Quantity:
    """Cosine of the angle between two vectors, a.b/(|a||b|).

    a, b    vectors (3) along the same axes, not zero
    angle   the symbol of the angle

    Check: the law of cosines in a triangle with sides along a and b.
    Outcomes: parallel, opposite, perpendicular, generic.
    Errors: a or b vanishes; a and b belong to different bodies.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 1.
    """
    lengths = [tidied(Norm(v.value)) for v in (a, b)]
    for v, length in zip((a, b), lengths, strict=True):
        if length == 0:
            raise Rejected(Complaint("zero-vector", f"`{v.key}` vanishes, so it has no direction"))

    def by_law_of_cosines() -> Expr:
        (f, u), (g, v) = (factored_matrix(q.value) for q in (a, b))
        sign = -1 if (f * g).could_extract_minus_sign() else 1
        beside, opposite = [length_by_turning(w) for w in (u, v)], length_by_turning(u - v)
        return sign * (beside[0] ** 2 + beside[1] ** 2 - opposite**2) / (2 * beside[0] * beside[1])

    return establish(
        COSINE_BETWEEN,
        cos(scalar(angle)),
        lambda u, v: Ratio(Dot(u, v), Factors(Norm(u), Norm(v))),
        {"a": a, "b": b},
        lines=Lines(
            between=_lengths_worked(a, b, lengths),
            put_in=Level.FULL,
            means={scalar(angle): _angle_by_components(a.value, b.value)},
        ),
        routes={"triangle": compared_with(by_law_of_cosines)},
        outcome=_relation_of_directions,
        key=key,
        kind="number",
        scope=Scope(differ={"point", "rotation"}),
    )


def _angle_by_components(u: Any, v: Any) -> Expr:
    """Return the angle between u and v, from 0 to pi."""
    across, along = tidied(Norm(Cross(u, v))), tidied(Dot(u, v))
    return atan2(across, along)


def _lengths_worked(a: Quantity, b: Quantity, lengths: list[Expr]) -> list[Form]:
    """Return the line with a.b and the lengths evaluated. If the components are numbers times a common factor, and a.b
    is a sum, a line with explicit sums comes first; in this line the common factors are cancelled."""
    (size_u, u), (size_v, v) = (size_and_rest(each.value) for each in (a, b))
    forms = [Form(Ratio(tidied(Dot(a.value, b.value)), Factors(*lengths)), "lengths", Level.STANDARD)]
    if u.free_symbols or v.free_symbols:
        return forms
    sign = tidied(factored_matrix(a.value)[0] * factored_matrix(b.value)[0] / (size_u * size_v))
    products = [sign * x * y for x, y in zip(u, v, strict=True) if x * y != 0]
    if len(products) > 1:
        worked = Ratio(Terms(*products), Factors(_as_root_of_squares(u), _as_root_of_squares(v)))
        forms.insert(0, Form(worked, "products", Level.STANDARD))
        forms[1] = Form(forms[1].expr, "lengths", Level.FULL)
    return forms


def _as_root_of_squares(vector: Any) -> Expr:
    squares = [entry**2 for entry in vector if entry != 0]
    return Root(Terms(*squares)) if len(squares) > 1 else sqrt(squares[0])


def _relation_of_directions(cosine: Expr) -> str:
    return {Integer(1): "parallel", Integer(-1): "opposite", Integer(0): "perpendicular"}.get(cosine, "generic")


ANGLE_BETWEEN = Rule(
    "rotation.angle_between",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 1",
    outcomes={
        "parallel": claims.cosine_is(1, claims.rotation_cos),
        "opposite": claims.cosine_is(-1, claims.rotation_cos),
        "perpendicular": claims.cosine_is(0, claims.rotation_cos),
        "generic": claims.cosine_is(None, claims.rotation_cos),
    },
    evidence={"sine": CHECK, "tangent": CHECK},
)


def angle_between(a: Quantity, b: Quantity, symbol: str = "theta", key: str = "angle_between") -> Quantity:
    """Angle between two vectors, theta = arccos(a.b/(|a||b|)), from 0 to pi.

    a, b    vectors (3) along the same axes, not zero

    Check: |a||b| sin theta = |a x b| and a.b sin theta = |a x b| cos theta, which together determine one angle from 0
    to pi.
    Outcomes: parallel, opposite, perpendicular, generic.
    Errors: a or b vanishes; a and b belong to different bodies.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 1.
    """
    cosine = cosine_between(a, b, "cosine" if key == "angle_between" else f"{key}_cosine", symbol)
    across = tidied(Norm(Cross(a.value, b.value)))
    along = tidied(Dot(a.value, b.value))
    lengths = length_by_turning(a.value) * length_by_turning(b.value)
    return establish(
        ANGLE_BETWEEN,
        scalar(symbol),
        lambda: acos(cosine.value),
        {},
        lines=Lines(arranged=_angle_itself),
        parents=[cosine, a, b],
        phrase_data=PhraseData(points_to={"a": a, "b": b}),
        routes={
            "tangent": lambda theta: (sin(theta) * along, cos(theta) * across),
            "sine": lambda theta: (sin(theta) * lengths, across),
        },
        outcome=lambda theta: {Integer(0): "parallel", pi: "opposite", pi / 2: "perpendicular"}.get(theta, "generic"),
        key=key,
        kind="angle",
    )


def _angle_itself(angle: Expr) -> Expr:
    """Return alpha for arccos(cos(alpha)), if alpha is known to be between 0 and pi."""
    inner = angle.args[0] if isinstance(angle, acos) else None
    if not isinstance(inner, cos):
        return tidied(angle)
    within = (inner.args[0], pi - inner.args[0])
    return inner.args[0] if all(strict_sign_within(each) == 1 for each in within) else tidied(angle)


@dataclass(frozen=True)
class Acting(Fact):
    """The torque in the equations of motion of a body, vector (3), N m."""

    torque: Any
