"""Euler's equations, with or without a torque, for a body whose principal moments of inertia are known.

Components are along the principal axes of the body, which rotate with it. The rate of L in space and Euler's equations
have a second route that uses the accelerations of the particles of the body instead of its tensor.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, MatAdd, Mul, Symbol, diag
from sympy.matrices import ImmutableMatrix

from derive.algebra.collect import by_products
from derive.algebra.expressions import (
    AXES,
    BodyRate,
    CarriedRate,
    Component,
    Cross,
    Dot,
    Relation,
    TimeRate,
    bound,
    column,
    component_names,
    explicit,
    rate,
    scaled,
    tensor,
    vector,
)
from derive.algebra.tidy import common_factor, tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.equimomental import OfParticles
from derive.mechanics.bodies.facts import AboutPoint, OfBody
from derive.mechanics.bodies.placed import Placeable
from derive.mechanics.bodies.regions import Point
from derive.mechanics.rotation import claims
from derive.mechanics.rotation.facts import RateByParticles, RateOfMomentum
from derive.mechanics.rotation.given_moments import check_given_moment
from derive.mechanics.rotation.vectors import Acting, Through
from derive.mechanics.theorems import ROTATING_AXES
from derive.solving.highest_rates import highest_rates
from derive.steps.claims import vanishes
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.record import require_constant
from derive.steps.rule import CHECK, ROUTE, Quote, Rule
from derive.steps.signs import sign_known
from derive.steps.step import Fact, Form, Level, Quantity, compared_with, is_zero, require_kind, value_behind
from derive.steps.subject import Subject

__all__ = [
    "RigidBody",
    "changing_angular_velocity",
    "euler_equations",
    "principal_tensor",
    "rate_in_body",
    "rate_in_space",
]

_POINTS = ("centre_of_mass", "fixed_point")
NO_TORQUE = (Integer(0), Integer(0), Integer(0))


@dataclass(frozen=True)
class RigidBody(Placeable, OfParticles):
    """A rigid body given by its principal moments of inertia, not by its shape.

    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.4.

    mass      the mass, kg, which a `System` needs; Euler's equations do not contain it
    moments   the three principal moments of inertia, kg m^2, about the body axes x, y and z. Plane motion needs only
              the moment about the axis perpendicular to the plane: its value, or the step that derived it
    centre    the position of the centre of mass relative to the "pivot", the origin of the body axes, m
    about     the point of the moments: "centre_of_mass", or "fixed_point" for the pivot; the default is the
              centre of mass if `centre` is zero, otherwise the pivot
    look      a body whose shape is drawn for this body, with the centre of the shape at the centre of mass

    Errors: there are neither three moments nor one; `about` is not one of the two points; the mass or a moment is not
    constant; a moment is greater than the sum of the other two.
    """

    mass: Expr | None = None
    moments: tuple[Expr, Expr, Expr] | Expr = ()
    centre: tuple[Expr, ...] = (Integer(0), Integer(0), Integer(0))
    about: str = ""
    id: ClassVar[str] = "rigid_body"
    called: str = ""
    look: Any = field(default=None, compare=False)
    across_plane: ClassVar[Quantity | None] = None  # the step that derived the moment for plane motion
    is_plane: ClassVar[bool] = False  # whether only the moment for plane motion is known

    def __post_init__(self) -> None:
        if not isinstance(self.moments, tuple | list):
            if isinstance(self.moments, Quantity):
                check_given_moment("RigidBody", self.mass, self.moments)
                object.__setattr__(self, "across_plane", self.moments)
            moment = value_behind(self.moments)
            object.__setattr__(self, "is_plane", True)
            object.__setattr__(self, "moments", (moment / 2, moment / 2, moment))
        object.__setattr__(self, "centre", (*self.centre, *(Integer(0),) * (3 - len(self.centre))))
        object.__setattr__(self, "about", self.about or ("fixed_point" if any(self.centre) else "centre_of_mass"))
        if len(self.moments) != 3:
            raise Rejected(Complaint("wrong-argument", "`RigidBody` needs three moments, or one for plane motion"))
        if self.about not in _POINTS:
            known = " or ".join(f'"{point}"' for point in _POINTS)
            raise Rejected(Complaint("wrong-argument", f"the moments of a `RigidBody` must be about {known}"))
        for moment in self.moments:
            require_constant("RigidBody", "moment of inertia", moment)
        if self.mass is not None:
            require_constant("RigidBody", "mass", self.mass)
        for axis, spread in zip(AXES, self.second_moments, strict=True):
            if sign_known(spread) == -1:
                message = f"no body has such moments: the one about {axis} is greater than the sum of the other two"
                raise Rejected(Complaint("no-such-body", message))

    def named(self, called: str) -> RigidBody:
        """Return the same body with a name, such as "upper rod", for a page with several bodies."""
        twin = replace(self, moments=(self.across_plane or self.moments[2]) if self.is_plane else self.moments)
        object.__setattr__(twin, "called", called)
        return twin

    @property
    def middle(self) -> Point:
        return Point("centre", column(*self.centre))

    def point_called(self, name: str) -> Point:
        points = {"pivot": Point("pivot", column(0, 0, 0)), "centre": self.middle}
        if name not in points:
            known = ", ".join(f'"{known}"' for known in points)
            raise Rejected(Complaint("no-such-point", f'{self.name} has no point "{name}"', help=f"it has {known}"))
        return points[name]

    @cached_property
    def central_second_moments(self) -> ImmutableMatrix:
        """The integrals of r_i r_j over the mass, where r is measured from the centre of mass.

        If the moments are about the pivot, M c_i c_j is subtracted from the integrals about the pivot.
        """
        about_point = ImmutableDenseMatrix(diag(*self.second_moments))
        if self.about == "centre_of_mass" or not any(self.centre):
            return about_point
        c = column(*self.centre)
        return ImmutableDenseMatrix(about_point - self.mass * c * c.T)

    @cached_property
    def second_moments(self) -> tuple[Expr, Expr, Expr]:
        """The integrals of x^2, y^2 and z^2 over the mass, from I_x = integral of (y^2 + z^2) dm, and so on."""
        x, y, z = (tidied(sum(self.moments, Integer(0)) / 2 - moment) for moment in self.moments)
        return x, y, z

    @property
    def point(self) -> Point:
        return Point(self.about, column(0, 0, 0))

    @cached_property
    def tensor(self) -> Quantity:
        return principal_tensor(self)

    def particles(self) -> list[tuple[Expr, ImmutableMatrix]]:
        """Return six particles, at +1 and -1 on each axis. Their second moments about the origin are the second moments
        of the body about the point of its moments. The mass and the centre of mass of the particles may differ from
        the mass and the centre of mass of the body."""
        places = [(i, sign) for i in range(3) for sign in (1, -1)]
        return [(self.second_moments[i] / 2, column(*(sign * (k == i) for k in range(3)))) for i, sign in places]

    def over_mass(self, integrand: Callable[[ImmutableMatrix], Any], point: Point) -> Any:
        """Return the sum over the particles of mass times a quadratic function of the position."""
        first, *others = [mass * explicit(integrand(place)) for mass, place in self.particles()]
        return sum(others, first)


@dataclass(frozen=True)
class MotionOfBody(Fact):
    """The angular accelerations from the equations of motion."""

    missing = "does not come from equations of motion"
    motion: Mapping[Symbol, Expr]


PRINCIPAL_TENSOR = Rule(
    "rotation.principal_tensor",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.4",
    outcomes={"generic": claims.tensor(3), "two_equal": claims.tensor(2), "isotropic": claims.tensor(1)},
)


def principal_tensor(body: RigidBody, symbol: str = "I", key: str = "inertia_tensor") -> Quantity:
    """Inertia tensor along principal axes, I = diag(I_x, I_y, I_z), in kg m^2: a definition.

    body    a body with known principal moments about a point

    Outcomes: isotropic (three equal moments), two_equal, generic.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.4.
    """
    return establish(
        PRINCIPAL_TENSOR,
        tensor(symbol),
        lambda: ImmutableDenseMatrix(diag(*body.moments)),
        {},
        outcome=_symmetry(body),
        kind="moment of inertia",
        facts=[OfBody(body), AboutPoint(body.point)],
        phrase_data=PhraseData(words={"about": body.about}),
        key=key,
        scope=Scope(about=Subject(body=body, point=body.point)),
    )


def _symmetry(body: RigidBody) -> str:
    different = len(set(body.moments))
    return "isotropic" if different == 1 else "two_equal" if different == 2 else "generic"


CHANGING_ANGULAR_VELOCITY = Rule(
    "rotation.changing_angular_velocity",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 4.8",
)


def changing_angular_velocity(
    through: str = "centre_of_mass", symbol: str = "omega", key: str = "angular_velocity"
) -> Quantity:
    """An angular velocity with an arbitrary time dependence, omega = (omega_x, omega_y, omega_z), in 1/s: a definition.

    through   the point of the body that is on the axis of rotation at every instant

    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 4.8.
    """
    names = component_names(symbol)
    return establish(
        CHANGING_ANGULAR_VELOCITY,
        vector(symbol),
        lambda: column(*names),
        {},
        kind="angular speed",
        scope=Scope(coordinates=dict.fromkeys(names, "angular speed"), about=Subject(rotation=column(*names))),
        facts=[Through(through)],
        key=key,
    )


RATE_IN_SPACE = Rule(
    "rotation.rate_in_space",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 4.9",
    outcomes={
        "generic": claims.rate_is(None, None),
        "zero": claims.rate_is(True, False),
        "zero_in_both": claims.rate_is(True, True),
        "driven": claims.rate_is(False, None),
    },
    evidence={"carried_round": ROUTE, "matter": ROUTE, "fixed_direction": ROUTE},
    quotes=[Quote(ROTATING_AXES)],
)


def rate_in_space(
    momentum: Quantity, omega: Quantity, in_body: Quantity | None = None, key: str = "momentum_rate"
) -> Quantity:
    """Rate of change of the angular momentum in space, dL/dt = (dL/dt)_body + omega x L.

    momentum   angular momentum L, vector (3), kg m^2/s, body axes
    omega      angular velocity of the body, vector (3), 1/s, body axes
    in_body    the rate of L in the body by the equations of motion; by default the rates of omega remain unknown

    Second route: a rotation matrix rotates L with the body, and the rotated vector is differentiated. The result is
    also compared with the sum of m r x a over particles, and with the rate of L . n for a direction n that is fixed in
    space. In the body, this direction has n_dot = -omega x n.
    Outcomes: zero (L is constant in space), zero_in_both (L is constant in space and in the body), driven (a torque
    acts), generic (the equations of motion are not substituted).
    Errors: `momentum` is not an angular momentum, or `omega` is not an angular velocity.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 4.9.
    """
    require_kind("rate_in_space", "momentum", momentum, "angular momentum")
    require_kind("rate_in_space", "omega", omega, "angular speed")
    moving = list(omega.coordinates)
    motion = in_body.needed(MotionOfBody).motion if in_body else {}
    L, w = momentum, omega
    turned, matter = CarriedRate(L.value, w.value, *moving), L.needed(RateByParticles)

    def law(momentum: Any, omega: Any, seen: Any = None) -> Any:
        return MatAdd(BodyRate(momentum, *moving) if seen is None else seen, Cross(omega, momentum))

    def along_fixed_direction() -> Expr:
        """Return dL/dt . n as the rate of L . n, where n_dot = -omega x n in the body."""
        n = column(*component_names("n"))
        backwards = explicit(Cross(n, w.value))
        changed = explicit(TimeRate(Dot(L.value, n), *moving, *n))
        return bound(changed, {**dict(zip(map(rate, n), backwards, strict=True)), **motion})

    inputs = {"momentum": momentum, "omega": omega, **({"in_body": in_body} if in_body else {})}
    return establish(
        RATE_IN_SPACE,
        CarriedRate(L.symbol, w.symbol, *moving),
        law,
        inputs,
        lines=Lines(
            between=_rates_worked(momentum, omega, in_body),
            put_in=None,
            # The rate in the body is derived from the torque, so adding omega x L gives the torque again, as a check.
            law=Level.FULL if in_body else Level.BRIEF,
            result=in_body is not None,  # without `in_body`, Euler's equations show the components
            arranged=lambda value: value.applyfunc(lambda entry: by_products(entry, moving)),
            means=motion,
        ),
        routes={
            "carried_round": compared_with(lambda: bound(explicit(turned), motion)),
            "matter": compared_with(lambda: bound(explicit(matter.rate()), motion)),
            "fixed_direction": lambda value: (
                explicit(Dot(value, column(*component_names("n")))),
                along_fixed_direction(),
            ),
        },
        outcome=lambda value: _constancy(value, in_body),
        kind="torque",
        phrase_data=PhraseData(words={"about": L.needed(AboutPoint).point.name}),
        facts=[RateOfMomentum(matter, tuple(moving))],
        key=key,
    )


def _constancy(rate: Any, in_body: Quantity | None) -> str:
    """Return the outcome. It states whether L is constant in space and in the body, or is "generic" if the equations of
    motion are not substituted."""
    if in_body is None:
        return "generic"
    if not is_zero(rate):
        return "driven"
    return "zero_in_both" if is_zero(in_body.value) else "zero"


def _rates_worked(momentum: Quantity, omega: Quantity, in_body: Quantity | None) -> list[Form]:
    """Return a list with one line, the terms of the rate: in components, or by symbols if the rate in the body is
    given."""
    if in_body is not None:
        seen = in_body.step.chain[0].expr
        parts = seen.args if isinstance(seen, MatAdd) else (seen,)
        return [Form(MatAdd(*parts, Cross(omega.symbol, momentum.symbol)), "in_body", Level.FULL)]
    in_components = explicit(BodyRate(momentum.value, *omega.coordinates))
    return [Form(MatAdd(in_components, Cross(omega.value, momentum.value)), "differentiated", Level.STANDARD)]


def euler_equations(rate: Quantity, torque: tuple[Expr, Expr, Expr] = NO_TORQUE) -> tuple[Quantity, Quantity, Quantity]:
    """Euler's equations, I_x omega_x_dot - (I_y - I_z) omega_y omega_z = N_x and cyclically: components of dL/dt = N.

    rate     rate of change of the angular momentum in space, vector (3), N m, along the principal axes of the body
    torque   N about the point of L, three components along the same axes, N m; by default zero

    Second route: the components of the sum of m r x a over particles.
    Outcomes: driven (a torque acts); without a torque, coupled (a product of components of omega remains in this
    equation), uncoupled (no product remains in this equation, so this component of omega is constant), isotropic (no
    product remains in any of the three equations).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.5.
    """
    x, y, z = (_euler_equation(rate, i, torque) for i in range(3))
    return x, y, z


EULER_EQUATION = Rule(
    "rotation.euler_equation",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.5",
    outcomes={
        "coupled": claims.euler(False, "here"),
        "driven": claims.euler(True, ""),
        "isotropic": claims.euler(False, "nowhere"),
        "uncoupled": claims.euler(False, "elsewhere"),
    },
    evidence={"matter": ROUTE},
    statements=[claims.rate_of_the_component],
)


def _euler_equation(rate: Quantity, i: int, torque: tuple[Expr, Expr, Expr]) -> Quantity:
    """Derive one component of dL/dt = N."""
    of = rate.needed(RateOfMomentum)
    moving = of.moving
    acting = torque[i]
    return establish(
        EULER_EQUATION,
        None,
        lambda rate, _: Relation(Component(rate, AXES[i]), "=", acting),
        {"rate": rate, "component": moving[i]},
        lines=Lines(
            put_in=None,
            arranged=lambda value: _without_common_factor(by_products(explicit(value.left), moving), value.right),
            law=Level.FULL,
        ),
        routes={"matter": lambda value: (value, Relation(explicit(of.by_particles())[i], "=", acting))},
        outcome=_coupling(rate.value, moving, i, torque),
        phrase_data=PhraseData(
            words={"axis": AXES[i]},
            outcome_data={"torque": column(*torque), "rate": rate.value, "moving": list(moving)},
        ),
        kind="torque",
        key=f"euler_{AXES[i]}",
        facts=[Acting(column(*torque))],
    )


def _without_common_factor(left: Expr, torque: Expr) -> Relation:
    """Return the equation. Without a torque, the equation is divided by the positive factors that its terms have in
    common. For a block with the edges a, 2a and 3a, the first equation is 13 omega_x_dot - 5 omega_y omega_z = 0."""
    terms = Add.make_args(left)
    if torque != 0 or len(terms) < 2:
        return Relation(left, "=", torque)
    common = Mul(*(each for each in Mul.make_args(common_factor(list(terms))) if sign_known(each) == 1))
    return Relation(Add(*(term / common for term in terms)), "=", torque)


def _coupling(rates: Any, moving: Sequence[Expr], i: int, torque: Sequence[Expr]) -> str:
    """Return the outcome: whether a torque acts, and if none acts, in which equations products of components remain."""
    uncoupled = [not entry.has(*moving) for entry in rates]
    if any(component != 0 for component in torque):
        return "driven"
    if all(uncoupled):
        return "isotropic"
    return "uncoupled" if uncoupled[i] else "coupled"


RATE_IN_BODY = Rule(
    "rotation.rate_in_body",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.6",
    outcomes={"zero": vanishes, "in_general": claims.rate_in_body_in_general, "driven": claims.rate_in_body_driven},
    evidence={"motion": CHECK},
    statements=[claims.of_their_kinds],
)


def rate_in_body(
    momentum: Quantity, omega: Quantity, equations: Sequence[Quantity], key: str = "momentum_rate_in_body"
) -> Quantity:
    """Rate of change of the angular momentum in the rotating body, (dL/dt)_body = N - omega x L.

    momentum    angular momentum L, vector (3), kg m^2/s, body axes
    omega       angular velocity of the body, vector (3), 1/s, body axes
    equations   Euler's equations, in the order x, y, z

    Check: differentiate the components I_x omega_x and so on, and substitute the angular accelerations from the
    equations.
    Outcomes: zero (L is constant in the body), in_general (without torque), driven (a torque acts).
    Errors: `momentum` is not an angular momentum, or `omega` is not an angular velocity.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.6.
    """
    require_kind("rate_in_body", "momentum", momentum, "angular momentum")
    require_kind("rate_in_body", "omega", omega, "angular speed")
    moving = list(omega.coordinates)
    motion = highest_rates(equations, moving)
    acting = column(*(equation.value.right for equation in equations))

    def law(omega: Any, momentum: Any) -> Any:
        turning = scaled(Integer(-1), Cross(omega, momentum))
        return turning if is_zero(acting) else MatAdd(acting, turning)

    return establish(
        RATE_IN_BODY,
        BodyRate(momentum.symbol, *moving),
        law,
        {"omega": omega, "momentum": momentum},
        lines=Lines(put_in=Level.FULL, means=motion),
        routes={"motion": compared_with(lambda: bound(explicit(BodyRate(momentum.value, *moving)), motion))},
        outcome=lambda value: "zero" if is_zero(value) else "in_general" if is_zero(acting) else "driven",
        phrase_data=PhraseData(outcome_data={"torque": acting}),
        kind="torque",
        parents=list(equations),
        facts=[MotionOfBody(motion)],
        key=key,
    )
