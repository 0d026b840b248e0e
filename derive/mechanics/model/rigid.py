"""Angular velocity of a body, and the inertia about its centre of mass or about a point at which the body is held."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, TypeAlias

from sympy import Add, Expr, ImmutableDenseMatrix, MatAdd, Mul, cos, eye, factor, sin
from sympy.matrices import ImmutableMatrix
from sympy.simplify.fu import TR5, TR6

from derive.algebra.expressions import TimeRate, as_expr, column, explicit, scaled, vector
from derive.algebra.length import length
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.bodies.placed import XYZ, PlacedBody, after
from derive.mechanics.kinematics.coordinates import by_functions_of_time
from derive.mechanics.kinematics.places import Axes, space
from derive.mechanics.model import claims
from derive.mechanics.rotation.inertia import inertia_tensor, moment_seen
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.record import coordinates_in, established
from derive.steps.rule import ROUTE, Rule
from derive.steps.step import Quantity, compared_with, is_zero
from derive.steps.subject import NOTHING, Subject

__all__ = ["angular_velocity"]

Inertia: TypeAlias = Quantity | Expr  # a step; or the symbol of a moment of inertia about the normal to the plane
MANY_TERMS = 20
_SQUARES = (lambda value: value, TR5, TR6)  # unchanged; sin^2 becomes 1 - cos^2; cos^2 becomes 1 - sin^2


ANGULAR_VELOCITY = Rule(
    "model.angular_velocity",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 4.9",
    outcomes={
        "space": claims.along_space,
        "body": claims.angular_velocity_body,
        "following": claims.angular_velocity_following,
    },
    evidence={"rotation_matrix": ROUTE},
)


def angular_velocity(
    axes: Axes,
    along: Axes | None = None,
    body: Any = None,
    symbol: str = "omega",
    key: str = "angular_velocity",
) -> Quantity:
    """Angular velocity of rotating axes, omega = sum of alpha_i_dot n_i over the rotations of the axes, in 1/s.

    axes    the rotating axes; each rotation is about one of the axes as they are after the previous rotations
    along   the axes of the components: `space`, or the axes after some of the rotations; by default `axes`
    body    the body that rotates with the axes, if it has a name

    Second route: the antisymmetric matrix R_dot R^T, where the rotation matrix R is differentiated as a function of t.
    Outcomes: body (components along `axes`), following (along the axes after some of the rotations), space
    (along fixed axes).
    Errors: the axes do not rotate; `along` is not one of the intermediate axes.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 4.9.
    """
    count = len(axes.turns) if along is None else len(along.turns)
    if along is not None and axes.turns[:count] != along.turns:
        message = "`along` in `angular_velocity` must be an intermediate stage of these axes"
        raise Rejected(Complaint("wrong-axis", message, help="use `along=space`, or axes after some of the rotations"))
    moving = list(coordinates_in(axes.in_space))
    terms = [
        (explicit(TimeRate(angle, *moving)), _seen_from(axes, i, count)) for i, (_, angle) in enumerate(axes.turns)
    ]
    turning = [(speed, around) for speed, around in terms if speed != 0]
    if not turning:
        raise Rejected(Complaint("wrong-argument", "`angular_velocity` needs rotating axes, but these are constant"))
    whole = [scaled(speed, around) for speed, around in turning]

    def by_rotation_matrix() -> ImmutableMatrix:
        matrix, frame = axes.in_space, after(axes.turns[:count])
        rows, columns = frame.T * by_functions_of_time(matrix, moving), matrix.T * frame
        return column(*((rows[i, :] * columns[:, j])[0].expand() for i, j in ((2, 1), (0, 2), (1, 0))))

    return establish(
        ANGULAR_VELOCITY,
        vector(symbol),
        lambda *_: MatAdd(*whole) if len(whole) > 1 else whole[0],
        {f"turn_{n}": angle for n, (_, angle) in enumerate(axes.turns, 1)},
        lines=Lines(put_in=None, arranged=lambda value: ImmutableDenseMatrix(explicit(value).applyfunc(by_squares))),
        routes={"rotation_matrix": compared_with(by_rotation_matrix)},
        outcome="space" if count == 0 else "body" if count == len(axes.turns) else "following",
        phrase_data=PhraseData(outcome_data={"in_space": axes.in_space, "frame": after(axes.turns[:count])}),
        key=key,
        kind="angular speed",
        scope=Scope(
            coordinates=coordinates_in(axes.in_space), about=Subject(body=body) if body is not None else NOTHING
        ),
    )


def by_squares(value: Expr) -> Expr:
    """Rewrite squares of sines or cosines if the result is shorter: -cos^2 a/sin a, not (sin^2 a - 1)/sin a."""
    value = tidied(value)
    above, below = (part.expand() for part in value.as_numer_denom())
    if max(len(Add.make_args(part)) for part in (above, below)) > MANY_TERMS:
        return value  # SymPy may need minutes to factor such a polynomial
    uppers, lowers = (_factored_by_squares(part) for part in (above, below))
    forms = [upper / lower for upper in uppers for lower in lowers]
    return min((value, *forms), key=lambda form: (length(form) + _minuses_below(form), len(form.atoms(Add))))


@lru_cache(maxsize=64)  # solutions of the same linear equations have the same denominator
def _factored_by_squares(value: Expr) -> tuple[Expr, ...]:
    forms = dict.fromkeys(f(value).expand() for f in _SQUARES) if value.has(sin, cos) else [value]
    return tuple(factor(form) for form in forms)


def _minuses_below(value: Expr) -> int:
    sums = [f for f in Mul.make_args(value.as_numer_denom()[1]) if f.is_Add]
    return sum(term.could_extract_minus_sign() for f in sums for term in f.args)


def _seen_from(axes: Axes, i: int, count: int) -> ImmutableMatrix:
    """The unit vector of the axis of rotation i, in components along the axes after `count` rotations."""
    about = column(*(int(k == axes.turns[i][0]) for k in range(3)))
    if i < count:
        return ImmutableDenseMatrix(after(axes.turns[i + 1 : count]).T * about)
    return ImmutableDenseMatrix(after(axes.turns[count : i + 1]) * about)


def convenient_axes(placed: PlacedBody, inertia: ImmutableMatrix) -> Axes:
    """Return axes along which the inertia of a body in space is constant and the angular velocity of this body has
    short components.

    If the last of several rotations is about an axis of symmetry, these are the axes before this rotation.
    """
    axes: Any = placed.turned
    count = len(axes.turns)
    if count > 1:
        last = axes.turns[-1][0]
        while count > 1 and axes.turns[count - 1][0] == last and _is_symmetric(inertia, last):
            count -= 1
    return Axes(after(axes.turns[:count]), axes.turns[:count]) if count else space


def _is_symmetric(inertia: ImmutableMatrix, axis: int) -> bool:
    j, k = (axis + 1) % 3, (axis + 2) % 3
    off = [inertia[axis, j], inertia[axis, k], inertia[j, k], inertia[j, j] - inertia[k, k]]
    return is_zero(ImmutableDenseMatrix(off))


def turning_rate_of(placed: PlacedBody) -> Expr:
    """The rate of the angle of a body in a plane, with the sign chosen so that the expression has no leading minus."""
    angle: Any = placed.turned
    found: Expr = tidied(TimeRate(angle, *coordinates_in(as_expr(angle))))
    return -found if found.could_extract_minus_sign() else found


def is_about_the_point(placed: PlacedBody) -> bool:
    """Whether the body is held at a point about which its inertia is known or can be derived."""
    if not placed.is_held:
        return False
    body, point = placed.body, placed.point
    if hasattr(body, "point_called"):
        return is_zero(point.position - body.point.position) if body.about == "fixed_point" else _at_centre(placed)
    if _at_centre(placed):
        return True
    named = {**body.points()}.get(point.name)
    return named is not None and named.position == point.position and named.axes == ImmutableDenseMatrix(eye(3))


def _at_centre(placed: PlacedBody) -> bool:
    return is_zero(placed.point.position - placed.body.middle.position)


def inertia_of(placed: PlacedBody) -> Inertia:
    """The inertia tensor of a body in space; for a body in a plane, the moment of inertia about the normal to it.

    Errors: the given moments are about the wrong point.
    """
    body, axis = placed.body, placed.across
    about = "centre" if _at_centre(placed) or not is_about_the_point(placed) else placed.point.name
    if hasattr(body, "point_called"):
        _check_moments(placed)
        moments: tuple[Expr, ...] = body.moments
        tensor: Inertia = body.tensor if axis is None else getattr(body, "across_plane", None) or moments[axis]
        return tensor
    if axis is None:
        return inertia_tensor(body, about=about)
    return moment_seen(body, XYZ[axis], about, "I", "moment_of_inertia", {"seen": "across_plane"})


def _check_moments(placed: PlacedBody) -> None:
    """Check moments that are given about a pivot other than the centre of mass."""
    body = placed.body
    if body.about == "fixed_point" and any(body.centre) and not is_about_the_point(placed):
        where = "moves freely" if not placed.is_held else f"is held at its {placed.point.name}"
        message = f"the moments of {body.name} are about its pivot, but the body {where}"
        help_line = Spelled(
            'give the moments about the centre of mass, with `about="centre_of_mass"`',
            "give the moments about the centre of mass, and leave `middle` out",
        )
        raise Rejected(Complaint("wrong-point", message, help=help_line))
    if body.about == "fixed_point" and any(body.centre):
        for found in established():
            at = getattr(found.subject.point, "name", None)
            if found.symbol in body.moments and at in ("centre", "centre_of_mass"):
                message = f"`{found.key}` is about the centre of mass, but {body.name} needs moments about its pivot"
                raise Rejected(Complaint("wrong-point", message, help="derive the moments about the pivot"))
