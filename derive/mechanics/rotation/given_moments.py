"""Check a derived moment of inertia that is given for a body: the mass, the point and the axis must be correct."""

from __future__ import annotations

from typing import Any

from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.regions import Point
from derive.steps.record import require_constant
from derive.steps.step import Quantity, is_zero, require_kind
from derive.steps.subject import called

__all__: list[str] = []


def check_given_moment(verb: str, mass: Any, inertia: Quantity) -> None:
    """Require a constant moment of this mass about the centre of mass, as far as the mass and the point are known. For
    a flat or straight body, also require an axis normal to the plane of motion."""
    body, about = inertia.subject.body, inertia.subject
    require_kind(verb, "moments", inertia, "moment of inertia")
    require_constant(verb, "moment of inertia", inertia)
    if body is not None and about.point is not None:
        middle = getattr(body, "middle", None)
        if not isinstance(about.point, Point) or not middle or not is_zero(about.point.position - middle.position):
            message = f"`{verb}` needs a moment about the centre of mass, but `{inertia.key}` is about "
            help_line = 'give the moment with about="centre"'
            raise Rejected(Complaint("wrong-point", message + called(about.point), help=help_line))
    if about.mass is not None and mass is not None and not is_zero(about.mass - mass):
        message = f"`{verb}`: `{inertia.key}` is the moment of the mass {called(about.mass)}, not of {called(mass)}"
        raise Rejected(Complaint("different-subjects", message))
    if getattr(body, "filling", "") == "length" and is_zero(inertia.value):
        message = f"`{inertia.key}` is about the axis along {called(body)}, but this axis is in the plane of motion"
        raise Rejected(Complaint("wrong-axis", message, help='give the moment with axis="x"'))
    across = getattr(body, "flat_across", None)
    if across is not None and about.axis not in (None, across):
        message = f"`{inertia.key}` is about an axis in the plane of {called(body)}, but the motion is in that plane"
        raise Rejected(Complaint("wrong-axis", message, help=f'give the moment with axis="{across}"'))
