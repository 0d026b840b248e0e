"""The symmetric top that turns about a fixed point of its axis: Euler's angles, energies, the equation of its tilt.

Space axes have their origin at the pivot and z upwards. Euler's angles are phi about the vertical (precession), theta
about the line of nodes (tilt of the axis from the upward vertical) and psi about the axis of the top (turning). The
axes in which vectors are given follow the axis of the top: x along the line of nodes, z along the axis, away from the
pivot, and y across both, uppermost; they share the precession and the tilt, but not the turning psi.

Convention: Goldstein, Poole, Safko, *Classical Mechanics*, section 4.4.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from sympy import Expr, Integer, MatAdd, Matrix, MatrixSymbol, Pow, Rational, Symbol, cos, sin

from derive.algebra.collect import by_accelerations
from derive.algebra.expressions import (
    Cross,
    Factors,
    Relation,
    Terms,
    column,
    component_names,
    explicit,
    scalar,
    scaled,
    vector,
)
from derive.algebra.kinds import kind_with_article
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.regions import Point
from derive.mechanics.systems.coordinates import Coordinate, by_functions_of_time, coordinate, letters_of
from derive.mechanics.systems.dalembert import symmetric_body
from derive.steps.establish import Lines, Scope, Telling, establish
from derive.steps.record import require_constant
from derive.steps.step import (
    Fact,
    Level,
    Quantity,
    compared_with,
    is_zero,
    lettered,
    only_equation,
    require_kind,
    same_value,
)
from derive.steps.subject import called, united

__all__ = [
    "EulerAngles",
    "Top",
    "centre_height",
    "constant_spin",
    "euler_angles",
    "tilt_equation",
    "top_kinetic_energy",
    "turning_rate",
]

ZERO, ONE, HALF = Integer(0), Integer(1), Rational(1, 2)
_MOMENT = "moment of inertia"


@dataclass(frozen=True)
class EulerAngles(Fact):
    """Precession phi, tilt theta and turning psi. Source: Goldstein, Poole, Safko, section 4.4."""

    missing = "is not in Euler's angles"

    phi: Coordinate
    theta: Coordinate
    psi: Coordinate

    @property
    def coordinates(self) -> tuple[Coordinate, Coordinate, Coordinate]:
        return self.phi, self.theta, self.psi

    def __iter__(self) -> Iterator[Coordinate]:
        return iter(self.coordinates)

    @property
    def names(self) -> list[Symbol]:
        return [q.symbol for q in self.coordinates]

    @property
    def following(self) -> Matrix:
        """The axes that follow the axis of the top, in space: the columns are x, y, z."""
        return _about_z(self.phi.symbol) * _about_x(self.theta.symbol)

    @property
    def of_body(self) -> Matrix:
        """The body's own axes in space."""
        return self.following * _about_z(self.psi.symbol)


def euler_angles() -> EulerAngles:
    return EulerAngles(coordinate("phi"), coordinate("theta"), coordinate("psi"))


def _about_z(angle: Expr) -> Matrix:
    return Matrix([[cos(angle), -sin(angle), 0], [sin(angle), cos(angle), 0], [0, 0, 1]])


def _about_x(angle: Expr) -> Matrix:
    return Matrix([[1, 0, 0], [0, cos(angle), -sin(angle)], [0, sin(angle), cos(angle)]])


@dataclass(frozen=True)
class Top:
    """A symmetric top as its letters M, l, I_x, I_z: what is derived for it holds for every top.

    mass      M of the whole, kg
    distance  l of the centre of mass from the pivot, m
    across    I_x about an axis through the pivot across the axis of symmetry, kg m^2
    along     I_z about the axis of symmetry, kg m^2
    """

    mass: Quantity
    distance: Quantity
    across: Quantity
    along: Quantity

    def __post_init__(self) -> None:
        for role, kind in (("mass", "mass"), ("distance", "length"), ("across", _MOMENT), ("along", _MOMENT)):
            _check_letter_of_top(role, kind, getattr(self, role))
        united("Top", [(q.key, replace(q.subject, mass=None)) for q in self.values], (), same_value)
        if self.distance.value != self.distance.symbol:  # in letters it was checked with its values
            for moment, axes in ((self.across, ("x", "y")), (self.along, ("z",))):
                self._check_moment(moment, axes)

    def _check_moment(self, moment: Quantity, axes: tuple[str, ...]) -> None:
        """It is about a point of the axis that is as far from the centre of mass as the distance says."""
        about, middle = moment.subject, getattr(moment.subject.body, "middle", None)
        if about.axis is not None and about.axis not in axes:
            message = f"`Top` needs a moment about {' or '.join(axes)} here, but `{moment.key}` is about {about.axis}"
            raise Rejected(Complaint("wrong-axis", message))
        if middle is not None and isinstance(about.point, Point):
            apart = middle.position - about.point.position
            if not (is_zero(apart[0]) and is_zero(apart[1]) and is_zero(apart[2] ** 2 - self.distance.value**2)):
                message = f"`{moment.key}` is about {called(about.point)}, which is not the distance "
                message += f"`{self.distance.key}` from the centre of mass"
                help_line = "a top turns about its pivot: give the moments about that point"
                raise Rejected(Complaint("wrong-point", message, help=help_line))
        if about.mass is not None and not is_zero(about.mass - self.mass.value):
            message = f"`{moment.key}` is the moment of a mass {called(about.mass)}, not of `{self.mass.key}`"
            raise Rejected(Complaint("different-subjects", message))

    @property
    def values(self) -> tuple[Quantity, ...]:
        return self.mass, self.distance, self.across, self.along

    def in_letters(self) -> Top:
        return Top(*(lettered(value) for value in self.values))

    def torque(self, gravity: Expr, tilt: Expr) -> Expr:
        """Of the weight about the line of nodes: it pulls the axis down."""
        return self.mass.symbol * gravity * self.distance.symbol * sin(tilt)

    def momentum(self, omega: Matrix) -> Matrix:
        """I omega in the axes that follow the axis of the top."""
        across, along = self.across.symbol, self.along.symbol
        return column(across * omega[0], across * omega[1], along * omega[2])


def _check_letter_of_top(role: str, kind: str, given: Any) -> None:
    if not isinstance(given, Quantity):
        message = f"`Top` needs a step as its `{role}`, but it is {type(given).__name__}"
        help_line = f'`let("{role}", lambda: ..., kind="{kind}")` makes one'
        raise Rejected(Complaint("wrong-argument", message, help=help_line))
    if given.step.kind not in (None, kind):
        is_a = kind_with_article(given.step.kind)
        message = f"`Top` needs {kind_with_article(kind)} as its `{role}`, but `{given.key}` is {is_a}"
        raise Rejected(Complaint("wrong-argument", message))
    require_constant("Top", role, given)


@dataclass(frozen=True)
class ConstantSpin(Fact):
    """The component S of the angular velocity along the axis of the top, which is constant, 1/s."""

    missing = "is not at constant spin"
    rate: Expr


@dataclass(frozen=True)
class HeavyTop(Fact):
    """The top, and the gravity in which it turns, m/s^2."""

    missing = "does not belong to a top"
    top: Top
    gravity: Expr


def turning_rate(angles: EulerAngles, symbol: str = "omega", key: str = "angular_velocity") -> Quantity:
    """Angular velocity in Euler's angles, omega = theta_dot x + phi_dot Z + psi_dot z, in the following axes.

    angles   phi, theta, psi
    Z is the vertical, (0, sin theta, cos theta) in the axes that follow the axis of the top.
    Second route: the rotation matrix R(phi, theta, psi) differentiated as a function of t: the antisymmetric matrix
    R_dot R^T, turned into these axes.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 4.9.
    """
    phi, theta, psi = angles.coordinates
    vertical = column(0, sin(theta.symbol), cos(theta.symbol))
    upwards = angles.following.T * Matrix([0, 0, 1])
    turns = MatAdd(scaled(theta.rate, column(1, 0, 0)), scaled(phi.rate, vertical), scaled(psi.rate, column(0, 0, 1)))

    def by_rotation_matrix() -> Matrix:
        body, following = angles.of_body, angles.following
        turned = by_functions_of_time(body, angles.names) * body.T
        here = following.T * turned * following
        return column(*(entry.expand() for entry in (here[2, 1], here[0, 2], here[1, 0])))

    return establish(
        "tops.turning_rate",
        vector(symbol),
        lambda *_: turns,
        {
            "precession": phi.symbol,
            "tilt": theta.symbol,
            "turning": psi.symbol,
        },
        telling=Telling(formulas={"sine": (vertical[1], upwards[1]), "cosine": (vertical[2], upwards[2])}),
        lines=Lines(put_in=None, arranged=explicit),
        routes={"rotation_matrix": compared_with(by_rotation_matrix)},
        key=key,
        kind="angular speed",
        scope=Scope(coordinates=letters_of(angles.coordinates)),
        facts=[angles],
    )


def top_kinetic_energy(top: Top, omega: Quantity, symbol: str = "T", key: str = "kinetic_energy") -> Quantity:
    """Kinetic energy of a symmetric top, T = (1/2) I_x (omega_x^2 + omega_y^2) + (1/2) I_z omega_z^2.

    top     its moments about the pivot, kg m^2
    omega   in the axes that follow its axis, as `turning_rate` yields it, 1/s
    Second route: half the sum of m v^2 over mass points on the body's own axes, turned by R(phi, theta, psi).
    Errors: the angular velocity is not one in Euler's angles.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7.
    """
    require_kind("top_kinetic_energy", "omega", omega, "angular speed")
    angles = _angles_of("top_kinetic_energy", omega)
    letters = top.in_letters()
    axes = [tuple(angles.of_body[:, i]) for i in range(3)]
    matter = symmetric_body(top.across.symbol, top.along.symbol, axes, angles.names)

    def law(w: object) -> Expr:
        across, along = top.across.symbol, top.along.symbol
        x, y, z = component_names(w.name) if isinstance(w, MatrixSymbol) else list(w)  # type: ignore[call-overload]
        return Terms(Factors(HALF, across, Terms(Pow(x, 2), Pow(y, 2))), Factors(HALF, along, Pow(z, 2)))

    return establish(
        "tops.top_kinetic_energy",
        scalar(symbol),
        law,
        {"omega": omega},
        parents=[letters.mass, letters.distance, letters.along, letters.across],
        lines=Lines(result=False, arranged=explicit),
        routes={"mass_points": compared_with(matter.kinetic_energy)},
        key=key,
        kind="energy",
        facts=[matter, angles],
    )


def _angles_of(verb: str, quantity: Quantity) -> EulerAngles:
    angles = quantity.fact(EulerAngles)
    if angles is not None:
        return angles
    raise Rejected(Complaint("wrong-argument", f"`{verb}` needs a quantity in Euler's angles, not `{quantity.key}`"))


def centre_height(top: Top, angles: EulerAngles, symbol: str = "Z", key: str = "centre_height") -> Quantity:
    """Height of the centre of mass above the pivot, z = l cos theta.

    top      its centre of mass is l from the pivot, m
    angles   theta is the tilt from the upward vertical
    Second route: the vertical component of l along the body's axis, turned by R(phi, theta, psi).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7.
    """
    theta = angles.theta

    def by_rotation() -> Expr:
        return (angles.of_body * Matrix([0, 0, top.distance.symbol]))[2]

    return establish(
        "tops.centre_height",
        scalar(symbol),
        lambda l: l * cos(theta.symbol),
        {"distance": top.in_letters().distance},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"rotation": compared_with(by_rotation)},
        key=key,
        kind="length",
        scope=Scope(coordinates=theta.letters),
    )


def constant_spin(omega: Quantity, rate: Expr, conserved: Quantity, top: Top, key: str = "constant_spin") -> Quantity:
    """Spin about the axis, psi_dot + phi_dot cos theta = S, constant because psi is cyclic.

    omega       in the axes that follow the axis of the top, 1/s
    rate        S, the component of omega along the axis, 1/s
    conserved   d/dt of the momentum that belongs to psi, which vanishes
    top         its moment I_z
    Second route: I_z times the rate of the left side, as functions of t, is the rate of that momentum.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7.
    """
    angles = _angles_of("constant_spin", omega)

    def by_its_rate(found: Relation) -> tuple[Expr, Expr]:
        along = by_functions_of_time(only_equation(found).left, angles.names)
        return top.along.symbol * along, explicit(conserved.value.left)

    def by_component(found: Relation) -> tuple[Relation, Relation]:
        """The value that it keeps is the rate that was given; R^T R_dot has the component along the axis."""
        body = angles.of_body
        turned = body.T * by_functions_of_time(body, angles.names)
        return found, Relation(turned[1, 0].expand(), "=", rate)

    require_constant("constant_spin", "spin", rate)
    return establish(
        "tops.constant_spin",
        None,
        lambda *_: Relation(omega.value[2], "=", rate),
        {"omega": omega, "spin": rate, "along": top.along.symbol},
        lines=Lines(put_in=None, arranged=explicit),
        routes={"rate_of_momentum": by_its_rate, "component": by_component},
        key=key,
        parents=[omega, conserved],
        telling=Telling(points_to={"conserved": conserved}),
        facts=[angles, ConstantSpin(rate)],
    )


def tilt_equation(motion: Quantity, spin: Quantity, top: Top, gravity: Expr, key: str = "tilt_equation") -> Quantity:
    """Equation of motion of the tilt at constant spin,
    I_x theta_ddot - I_x phi_dot^2 sin theta cos theta + I_z S phi_dot sin theta - M g l sin theta = 0.

    motion    Lagrange's equation for theta
    spin      psi_dot + phi_dot cos theta = S, which eliminates psi_dot
    top       its letters
    gravity   g, m/s^2
    Second route: the torque of the weight about the line of nodes is the rate of the angular momentum, seen from the
    following axes and carried round with them, dL/dt + Omega x L.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.7; Fowles, Cassiday, *Analytical Mechanics*, 9.7.
    """
    angles = _angles_of("tilt_equation", spin)
    phi, theta, psi = angles.coordinates
    rate = spin.needed(ConstantSpin).rate
    turning = rate - phi.rate * cos(theta.symbol)

    def by_torque() -> Relation:
        following = column(theta.rate, phi.rate * sin(theta.symbol), phi.rate * cos(theta.symbol))
        momentum = top.momentum(column(following[0], following[1], rate))
        changing = by_functions_of_time(momentum[0], angles.names) + explicit(Cross(following, momentum))[0]
        return Relation(changing - top.torque(gravity, theta.symbol), "=", 0)

    return establish(
        "tops.tilt_equation",
        None,
        lambda *_: Relation(motion.value.left.expand().xreplace({psi.rate: turning}), "=", 0),
        {"tilt": theta.symbol, "turning": psi.rate, "spin": spin},
        lines=Lines(
            put_in=None,
            law=Level.FULL,
            arranged=lambda found: Relation(by_accelerations(found.left, angles.names), "=", 0),
        ),
        routes={"torque": compared_with(by_torque)},
        key=key,
        parents=[spin, motion],
        facts=[angles, ConstantSpin(rate), HeavyTop(top, gravity)],
    )
