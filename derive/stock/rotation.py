"""Rigid bodies that rotate: angular momentum, energy, torque, Euler's equations, and the stability of a rotation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, MatrixBase

from derive.algebra.expressions import column, component_names
from derive.algebra.kinds import Asked
from derive.course.expression import Declared
from derive.course.given import Given
from derive.course.placement import POLHODES, Placement
from derive.course.schema import SCALAR, TEXT, Record, key, list_of
from derive.course.stock import Described, InLetters, Stock, attempted, each, told_at
from derive.course.yaml_tree import Sequence as SequenceNode
from derive.course.yaml_tree import Tree, Word
from derive.errors import Faults, Place, rejected
from derive.figures.rigid_bodies import semi_axes
from derive.mechanics import (
    RigidBody,
    angle_between,
    angular_momentum,
    axis_of_symmetry,
    body_cone_rate,
    changing_angular_velocity,
    constant_angular_velocity,
    euler_equations,
    inertia_tensor,
    kinetic_energy,
    linearised_rotation,
    magnitude,
    momentary_angular_velocity,
    period,
    perturbation_rate,
    perturbation_rate_squared,
    precession_rate,
    rate_in_body,
    rate_in_space,
    rate_under,
    spin,
    squared_magnitude,
    tangent_between,
    torque,
    vector_component,
)
from derive.mechanics.bodies.body import Body, axis_vector
from derive.steps.step import Quantity
from derive.stock.answering.answers import StockAnswers, answer, answer_for_each
from derive.stock.keys.bodies import BODY, Bodies, BodyKeys, DescribedBody
from derive.stock.keys.directions import DIRECTION, Axis, Directions
from derive.stock.keys.outlines import drawn_free, drawn_polhodes, drawn_turning
from derive.stock.keys.results import RESULTS, read_results

AXES = "xyz"
VECTORS = ("spin", "angular_momentum", "torque")
CONES = {"body_cone": "alpha_b", "space_cone": "alpha_s", "tilt": "alpha_L"}  # angles, and their symbols
MOVING = tuple((letter.name, letter) for letter in component_names("omega"))  # components of a changing omega
KINDS_OF_COMPONENTS = {
    "moments": "moment of inertia",
    "rates": "angular speed",
    "start": "angular speed",
    "torque": "torque",
}
EXCLUDE_EACH_OTHER = (
    ("body", "moments"),
    ("rates", "rate"),
    ("rates", "along"),
    ("start", "rates"),
    ("start", "along"),
    ("start", "torque"),
)
CENTRE_OF_MASS, FIXED_POINT = "centre_of_mass", "fixed_point"


@dataclass(frozen=True)
class RotationKeys(Record):
    """The keys of a body that rotates."""

    body: BodyKeys | None = key("the body", BODY)
    moments: tuple[Tree, ...] = key(
        "the principal moments of inertia of any body, about x, y and z, in place of `body`",
        list_of(SCALAR, "three moments of inertia, `[A, B, C]`", length=3),
    )
    about: Word | None = key("the fixed point; by default the centre of mass", TEXT)
    rate: Tree | None = key("the constant rate of rotation", SCALAR)
    along: Tree | None = key("the axis of rotation: `diagonal`, `x` or components", DIRECTION)
    rates: tuple[Tree, ...] = key(
        "the components of a constant angular velocity, in place of `rate` and `along`",
        list_of(SCALAR, "three angular speeds", length=3),
    )
    start: tuple[Tree, ...] = key(
        "the components of the angular velocity at one instant, for a body on which no torque acts",
        list_of(SCALAR, "three angular speeds", length=3),
    )
    torque: tuple[Tree, ...] = key(
        "the components, along the body's axes, of the torque on a body whose rotation is not given; by default 0",
        list_of(SCALAR, "three torques", length=3),
    )
    results: Mapping[Word, Record] = key("quantities computed from answers, by names that you choose", RESULTS)


@dataclass(frozen=True)
class DescribedRotation(Described):
    """A described rotation, whose values are expressions in the declared symbols."""

    body: DescribedBody | None = None
    moments: tuple[Expr, ...] = ()
    about: str = "centre"
    rate: Expr | None = None
    along: Axis | None = None
    rates: tuple[Expr, ...] = ()
    start: tuple[Expr, ...] = ()
    torque: tuple[Expr, ...] = ()
    place: Place | None = field(default=None, repr=False, compare=False)


def read(written: RotationKeys, symbols: Mapping[str, Declared], faults: Faults) -> DescribedRotation:
    """Return the description with its values as expressions in the declared symbols."""
    known = InLetters(symbols)
    _check_together(written, faults)
    body = attempted(faults, Bodies(known).body, written.body) if written.body else None
    found: dict[str, Any] = {
        name: attempted(faults, _components, written, name, kind, known) or ()
        for name, kind in KINDS_OF_COMPONENTS.items()
    }
    if written.rate is not None:
        found["rate"] = attempted(faults, known.of_kind, written.rate, "rate", "angular speed")
    along = attempted(faults, Directions(known).axis, written.along, "along") if written.along else None
    about = attempted(faults, _point, written, body) or CENTRE_OF_MASS
    told = ((name, kind) for name, kind in {"rate": "angular speed", **KINDS_OF_COMPONENTS}.items() if found.get(name))
    moving = {name: Declared(name, letter, "angular speed") for name, letter in MOVING}
    return DescribedRotation(
        results=read_results(written.results, known.also({**moving, **symbols}), faults),
        without=_without(written),
        chosen=known.chosen,
        measured=tuple(known.numbers.measured),
        told=tuple(Given(name, Asked(kind), found[name]) for name, kind in told),
        place=written.places[""],
        body=body,
        along=along,
        about=about,
        **found,
    )


def _check_together(written: RotationKeys, faults: Faults) -> None:
    there = written.values_at.keys()
    for first, second in EXCLUDE_EACH_OTHER:
        if {first, second} <= there:
            message = f"`{second}` and `{first}` cannot be combined"
            faults.error("unknown-key", message, written.places[first], help="leave one of them out")
    for steady in ("rates", "along"):
        if written.torque and steady in there:
            message = f"`torque` has no effect with `{steady}`: the torque that maintains a given rotation is derived"
            faults.error("unused-key", message, written.places["torque"], help=f"leave `torque` or `{steady}` out")
    if not {"body", "moments"} & there:
        faults.error("missing-key", "`given` needs `body` or `moments`", written.places[""])
    if written.along is not None and written.rate is None:
        message = "a rotation about an axis needs its `rate`"
        faults.error("missing-key", message, written.places["along"], help="write `rate: omega`")


def _components(written: RotationKeys, name: str, kind: str, known: InLetters) -> tuple[Expr, ...]:
    """Read the three components of a key; reject moments of inertia that no body can have."""
    reading = known.value if name == "moments" else known.of_kind
    found = tuple(each([partial(reading, node, f"each of {name}", kind, 3) for node in getattr(written, name)]))
    if found and name == "moments":
        with told_at(written.places["moments"]):
            RigidBody(moments=found)
    return found


def _without(written: RotationKeys) -> tuple[tuple[Word, set[str]], ...]:
    """Return the keys `rate` and `torque`, if the author wrote them, each with answers that do not depend on it."""
    asks = {*RotationAnswers(DescribedRotation()).asks()}
    of_rate = {name for name in asks if name.startswith(("stability", "wobble"))}
    without_torque = ("inertia_tensor", "spin", "angular_momentum", "kinetic_energy", "angle_between", "torque")
    found = {
        "rate": asks - of_rate if written.along is None else set[str](),
        "torque": {name for name in asks if name.startswith(without_torque)},
    }
    return tuple((Word.at(name, written.places[name]), found[name]) for name in found if name in written.values_at)


def _point(written: RotationKeys, body: DescribedBody | None) -> str:
    """Return the name of the point about which the body rotates."""
    if written.body is not None:
        return body.point(written.about) if body is not None and written.about else "centre"
    if written.about is None:
        return CENTRE_OF_MASS
    name = {"centre": CENTRE_OF_MASS}.get(written.about, written.about.replace(" ", "_"))
    if name not in (CENTRE_OF_MASS, FIXED_POINT):
        message = f"moments must be about `centre_of_mass` or `fixed_point`, not about `{written.about}`"
        rejected("no-such-point", message, written.about.place)
    return name


class RotationAnswers(StockAnswers[DescribedRotation]):
    """The quantities of a rotation."""

    what = "a rotation"

    def solve(self, asked: Sequence[Word], drawings: Sequence[Placement] = ()) -> dict[str, object]:
        """Return the answers by the requested names, and draw the body."""
        found = super().solve(asked, drawings)
        described = self.described
        if described.body is not None:
            drawn_turning(self, "angle_between" in asked)
        elif described.about in ("centre", CENTRE_OF_MASS):
            turns = {"changing", "angular_momentum"} <= vars(self).keys()  # whether both answers were derived
            drawn_free(self, turns and not (described.rate or described.start or described.torque))
        for drawing in (drawing for drawing in drawings if drawing.key == POLHODES):
            with told_at(drawing.place):
                self._draw_polhodes(asked)
        return found

    def place_of_mark(self, node: Tree, name: str, letters: InLetters) -> MatrixBase:
        """Return a place relative to the origin of the drawing. For a body that is described by its moments, the
        written components are multiples of the semi-axes of the drawn ellipsoid."""
        if not self.described.moments or not isinstance(node, SequenceNode):
            return super().place_of_mark(node, name, letters)
        sizes = semi_axes(self.described.moments)
        parts = each([partial(letters.of_kind, item, name, "number") for item in node.items])
        return ImmutableDenseMatrix([part * size for part, size in zip(parts, sizes, strict=False)])

    def _draw_polhodes(self, asked: Sequence[Word]) -> None:
        """Draw the curves on which the tip of the angular momentum of a free body stays."""
        if self.described.torque or self.is_given:
            message = "polhodes need a body that rotates freely"
            rejected("wrong-argument", message, None, "leave out `torque`, `along`, `rates` and `start`")
        if not self.inertia_tensor.value.is_diagonal():
            message = "the polhodes need principal axes, but the axes of this body are not principal"
            rejected("not-principal", message, None, "give `about: centre_of_mass`, or principal moments as `moments`")
        led_by = ("stability_", "wobble_", "energy_rate", "squared_momentum_rate")
        named = [name for name in asked if name.startswith(led_by)]
        keys = [q.key for name in named for q in self.by_name.named(name)] or [self.angular_momentum.key]
        drawn_polhodes(self.inertia_tensor, self.angular_momentum.symbol, keys)

    @property
    def about(self) -> str:
        return self.described.about

    @cached_property
    def body(self) -> Body | None:
        return self.described.body.body() if self.described.body else None

    @answer
    def inertia_tensor(self) -> Quantity:
        if self.body is not None:
            return inertia_tensor(self.body, self.about)
        with told_at(self.described.place):
            return RigidBody(moments=self.described.moments, about=self.about).tensor

    @property
    def is_given(self) -> bool:
        """Return whether the angular velocity is given, as a constant or at one instant."""
        return bool(self.described.along or self.described.rates or self.described.start)

    @answer
    def spin(self) -> Quantity:
        """Return the given angular velocity, which is constant or known at one instant."""
        if self.described.start:
            return momentary_angular_velocity(self.described.start, self.about, key="spin")
        if self.described.rates:
            return constant_angular_velocity(self.described.rates, self.about, key="spin")
        rate, along = self.described.rate, self.described.along
        if rate is None or along is None:
            message = "the rotation of this body is not specified"
            rejected("missing-key", message, self.described.place, "give `rate` and `along`, `rates`, or `start`")
        if self.body is not None:
            return spin(rate, along=self.body.direction(along.named), through=self.about)
        if along.named.name == "diagonal":
            message = "a body specified by its moments has no diagonal"
            rejected("no-such-axis", message, self.described.place, "write `along: x`, or components")
        components = along.components if not along.is_name else tuple(int(along.named.name == axis) for axis in AXES)
        name = along.named.name or "components"
        return spin(rate, along=axis_vector(None, column(*components), name), through=self.about)

    @cached_property
    def changing(self) -> Quantity:
        """Return an angular velocity that may change in any way."""
        return changing_angular_velocity(self.about)

    @answer
    def angular_momentum(self) -> Quantity:
        return angular_momentum(self.inertia_tensor, self.spin if self.is_given else self.changing)

    @answer
    def angular_momentum_size(self) -> Quantity:
        return magnitude(self.angular_momentum, key="angular_momentum_size")

    @answer
    def kinetic_energy(self) -> Quantity:
        return kinetic_energy(self.inertia_tensor, self.spin if self.is_given else self.changing)

    @answer
    def angle_between(self) -> Quantity:
        return angle_between(self.spin, self.angular_momentum)

    @answer
    def torque(self) -> Quantity:
        return torque(self.spin, self.angular_momentum)

    @answer
    def torque_size(self) -> Quantity:
        return magnitude(self.torque, key="torque_size")

    # -- a rotation that changes ----------------------------------------------------------------------------------

    @cached_property
    def changing_momentum(self) -> Quantity:
        if not self.described.start:
            return self.angular_momentum
        return angular_momentum(self.inertia_tensor, self.changing, "L_t", "momentum_at_all_times")

    @answer
    def euler_equations(self) -> tuple[Quantity, Quantity, Quantity]:
        if not self.inertia_tensor.value.is_diagonal():
            message = "Euler's equations need principal axes, but the axes of this body are not principal"
            rejected("not-principal", message, None, "give `about: centre_of_mass`, or principal moments as `moments`")
        if self.described.along or self.described.rates:
            message = "Euler's equations describe an unknown rotation, but the rotation of this body is given"
            rejected("is-steady", message, None, "leave out `along` or `rates`")
        rate = rate_in_space(self.changing_momentum, self.changing)
        acting = self.described.torque
        return euler_equations(rate, acting) if acting else euler_equations(rate)

    @answer_for_each("euler_{}", lambda self: AXES)
    def euler_equation(self, axis: str) -> Quantity:
        return self.euler_equations[AXES.index(axis)]

    @answer
    def energy_rate(self) -> Quantity:
        if not self.described.start:
            return rate_under(self.kinetic_energy, self.euler_equations)
        energy = kinetic_energy(self.inertia_tensor, self.changing, "T_t", "energy_at_all_times")
        return rate_under(energy, self.euler_equations)

    @answer
    def squared_momentum_rate(self) -> Quantity:
        return rate_under(squared_magnitude(self.changing_momentum, key="squared_momentum"), self.euler_equations)

    @answer
    def momentum_rate_in_body(self) -> Quantity:
        return rate_in_body(self.changing_momentum, self.changing, self.euler_equations)

    @answer
    def momentum_rate_in_space(self) -> Quantity:
        in_body = self.momentum_rate_in_body
        return rate_in_space(self.changing_momentum, self.changing, in_body, key="momentum_rate_in_space")

    @answer_for_each("stability_{}", lambda self: AXES)
    def stability(self, axis: str) -> Quantity:
        if self.described.rate is None:
            message = "the stability of a rotation depends on its `rate`, which is not given"
            rejected("missing-key", message, self.described.place, "write `rate: omega`")
        linear = linearised_rotation(self.euler_equations, axis, self.described.rate, key=f"disturbed_{axis}")
        return perturbation_rate_squared(linear, f"Omega_{axis}", f"stability_{axis}")

    @answer_for_each("wobble_{}", lambda self: AXES)
    def wobble(self, axis: str) -> Quantity:
        grows = self.stability(axis).step.outcome == "unstable"
        return perturbation_rate(self.stability(axis), f"kappa_{axis}" if grows else None, key=f"wobble_{axis}")

    @answer_for_each("wobble_period_{}", lambda self: AXES)
    def wobble_period(self, axis: str) -> Quantity:
        return period(self.wobble(axis), f"tau_{axis}", key=f"wobble_period_{axis}")

    # -- components -------------------------------------------------------------------------------------------------

    @answer_for_each("{}", lambda self: [f"{vector}_{axis}" for axis in AXES for vector in VECTORS])
    def component(self, name: str) -> Quantity:
        vector, _, axis = name.rpartition("_")
        return vector_component(getattr(self, vector), axis, key=name)

    # -- a free symmetric body ------------------------------------------------------------------------------------

    @answer
    def body_cone_rate(self) -> Quantity:
        return body_cone_rate(self.euler_equations)

    @answer
    def axis_of_symmetry(self) -> Quantity:
        return axis_of_symmetry(self.inertia_tensor)

    @answer_for_each("{}", lambda self: CONES)
    def cone(self, name: str) -> Quantity:
        return angle_between(*self._sides(name), symbol=CONES[name], key=name)

    @answer_for_each("{}_tangent", lambda self: CONES)
    def cone_tangent(self, name: str) -> Quantity:
        return tangent_between(*self._sides(name), angle=CONES[name], key=f"{name}_tangent")

    def _sides(self, name: str) -> tuple[Quantity, Quantity]:
        """Return the two vectors whose angle has this name."""
        axis, omega, L = self.axis_of_symmetry, self.spin, self.angular_momentum
        return {"body_cone": (axis, omega), "space_cone": (L, omega), "tilt": (axis, L)}[name]

    @answer
    def precession_rate(self) -> Quantity:
        if not self.described.start:
            message = "free precession needs the angular velocity at one instant, with no torque on the body"
            rejected("missing-key", message, self.described.place, "write `start: [omega_x, 0, omega_z]`")
        return precession_rate(self.inertia_tensor, self.angular_momentum)


STOCK = Stock(RotationKeys, read, RotationAnswers)
