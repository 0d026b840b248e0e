"""What must be true of what a sentence tells besides its chain: roles, formulas and points, by rule.

A role takes part in the law by its place, and in a sentence by its name; a formula that only a sentence shows is in no
line. Here it is said what either must fulfil, with the result as the judge. `establish` asks, whatever the outcome.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sympy import Expr, Integer, Symbol, cos, diff, integrate, pi, sin

from derive.algebra.expressions import Relation, column, explicit, rate
from derive.steps.outcomes import Judged, told_by
from derive.steps.step import is_zero

Told = Callable[[Judged, str], bool]

_KINDS = {"omega": "angular speed", "inertia": "moment of inertia", "momentum": "angular momentum"}


def _of_their_kinds(facts: Judged, outcome: str) -> bool:
    """Whether each role that is a vector or a tensor of rotation is one."""
    return all(q.step.kind == _KINDS.get(role, q.step.kind) for role, q in facts.quantities.items())


def _cylindrical(facts: Judged, outcome: str) -> bool:
    """x = r cos, y = r sin: their area element is that of the integral, and x is r in the first direction."""
    along, edge, x, y = (facts.inputs[role] for role in ("along", "edge", "x_is", "y_is"))
    r, body = facts.inputs["radius"], facts.subject.body
    angles = sorted((x.free_symbols | y.free_symbols) - {r}, key=str)
    if len(angles) != 1 or not isinstance(along, Symbol) or along in {r, *angles}:
        return False
    (theta,) = angles
    area = diff(x, r) * diff(y, theta) - diff(x, theta) * diff(y, r)
    sections = integrate(pi * edge**2, (along, 0, body.height))
    from_start = facts.words["start"] == body.reference and is_zero(x.subs(theta, 0) - r)
    return from_start and is_zero(area - facts.inputs["element"]) and is_zero(sections - explicit(facts.result))


def _of_three_angles(facts: Judged, outcome: str) -> bool:
    phi, theta, psi, sine, cosine = (facts.inputs[role] for role in ("precession", "tilt", "turning", "sine", "cosine"))
    by_angles = column(rate(theta), rate(phi) * sin(theta), rate(psi) + rate(phi) * cos(theta))
    return is_zero(facts.result - by_angles) and is_zero(sine - sin(theta)) and is_zero(cosine - cos(theta))


def _letters_of(value: Any) -> set[Any]:
    return set(explicit(value).free_symbols)


def _one_angle_left(facts: Judged, outcome: str) -> bool:
    """The equation is one for the tilt, and the turning, a rate, has gone from it."""
    present, turning = _letters_of(facts.result), facts.inputs["turning"]
    return rate(facts.inputs["tilt"], 2) in present and isinstance(turning, Symbol) and turning not in present


def _steady(facts: Judged, outcome: str) -> bool:
    tilt, rate_of_it, sine = (facts.inputs[role] for role in ("tilt", "rate", "sine"))
    return rate_of_it in _letters_of(facts.result) and is_zero(sine - sin(tilt)) and rate(tilt) != rate_of_it


def _sine_of_the_tilt(facts: Judged, outcome: str) -> bool:
    """What vanishes with the tilt is the sine of the angle that the rate depends on; the rate is the cyclic one."""
    sine = facts.inputs["sine"]
    of_the_tilt = isinstance(sine, sin) and sine.args[0] in _letters_of(facts.result)
    return of_the_tilt and facts.inputs["carried"] != sine and facts.symbol == rate(facts.inputs["cyclic"])


def _one_part_moves(facts: Judged, outcome: str) -> bool:
    """Of the other two parts of the energy one holds the rate of the coordinate, and one does not."""
    rates = {rate(q) for q in _letters_of(facts.result)}
    moving, constant = (bool(rates & _letters_of(facts.inputs[role])) for role in ("moving", "constant"))
    return moving and not constant


def _as_given(facts: Judged, outcome: str) -> bool:
    return is_zero(facts.result - facts.inputs["given"]) and facts.symbol == facts.inputs["tilt"]


def _for_a_vector(facts: Judged, outcome: str) -> bool:
    return getattr(facts.inputs["vector"], "shape", None) == (3, 1)


def _strict(facts: Judged, outcome: str) -> bool:
    """At the bound itself there is still a steady precession, so only what is beyond it has none."""
    return facts.result.mark in {"<", ">"}


def _component_that_is_kept(facts: Judged, outcome: str) -> bool:
    """The component of the vector keeps the value called the spin, and its moment of inertia has no part in that."""
    spin, moment = facts.inputs["spin"], facts.inputs["along"]
    is_vector = getattr(facts.inputs["omega"], "shape", None) == (3, 1)
    return is_vector and is_zero(facts.result.right - spin) and moment not in _letters_of(facts.result)


def _equation_in_its_unknown(facts: Judged, outcome: str) -> bool:
    equation, unknown = facts.inputs["equation"], facts.inputs["unknown"]
    return isinstance(equation, Relation) and isinstance(unknown, Symbol) and unknown in _letters_of(equation)


def _counted_from_its_point(facts: Judged, outcome: str) -> bool:
    """A length or a position is counted from the point that it is about."""
    return facts.words["start"] == getattr(facts.subject.point, "name", facts.words["start"])


def _from_its_point_along_the_axis(facts: Judged, outcome: str) -> bool:
    along = outcome != "on_axis" or str(facts.symbol.name).endswith("z")
    return _counted_from_its_point(facts, outcome) and along


def _named_as_its_moment(facts: Judged, outcome: str) -> bool:
    """The part is called as the letter of its moment says."""
    return str(facts.symbol.name).endswith("_" + facts.words["name"])


def _momentum_of_a_coordinate(facts: Judged, outcome: str) -> bool:
    return isinstance(facts.inputs["coordinate"], Symbol) and "momentum" in facts.quantities


def _axis_as_named(facts: Judged, outcome: str) -> bool:
    return outcome != "diagonal" or facts.words["axis"] == outcome


def _as_strictly(facts: Judged, outcome: str) -> bool:
    """Where a quantity must be positive zero is left out, where it must not be negative it is allowed."""
    strictly = facts.words.get("strictly")
    return strictly is None or (strictly == "positive") == (facts.result.mark in {"<", ">"})


def _rate_of_the_component(facts: Judged, outcome: str) -> bool:
    return "rate" in facts.quantities and rate(facts.inputs["component"]) in _letters_of(facts.result)


def _inward_or_outward(facts: Judged, outcome: str) -> bool:
    """The tensor exceeds that about the centre of mass, or is less than the other: it depends on where one starts."""
    point = facts.quantities["entry"].subject.point
    return point is None or (point.name in {"centre", "centre_of_mass"}) == (outcome == "outward")


def _difference(facts: Judged, outcome: str) -> bool:
    roles = ("kinetic", "potential", "magnetic")
    kinetic, potential, magnetic = (explicit(facts.inputs.get(role, Integer(0))) for role in roles)
    return is_zero(explicit(facts.result) - kinetic + potential - magnetic)


def _product_of(*roles: str) -> Told:
    def is_so(facts: Judged, outcome: str) -> bool:
        product: Expr = Integer(1)
        for role in roles:
            product *= explicit(facts.inputs[role])
        return is_zero(explicit(facts.result) - product)

    return is_so


def _at_a_place(facts: Judged, outcome: str) -> bool:
    place = facts.inputs["place"]
    return isinstance(place, Relation) and isinstance(place.left, Symbol)


_TABLE: dict[str, Told] = {
    "rotation.kinetic_energy": _of_their_kinds,
    "rotation.angular_momentum": _of_their_kinds,
    "rotation.torque": _of_their_kinds,
    "free_rotation.rate_in_body": _of_their_kinds,
    "bodies.volume": _cylindrical,
    "tops.turning_rate": _of_three_angles,
    "tops.constant_spin": _component_that_is_kept,
    "composed.part_moment": _named_as_its_moment,
    "cyclic.conserved_momentum": _momentum_of_a_coordinate,
    "quadratics.roots_of": _equation_in_its_unknown,
    "bodies.axis_vector": _axis_as_named,
    "bodies.centre_component": _from_its_point_along_the_axis,
    "bodies.centre_of_mass": _counted_from_its_point,
    "bodies.section_radius": _counted_from_its_point,
    "precession.no_steady_precession": _strict,
    "precession.fixed_tilt": _as_given,
    "equations.at": _for_a_vector,
    "tops.tilt_equation": _one_angle_left,
    "precession.steady_precession": _steady,
    "sleeping.upright_rate": _sine_of_the_tilt,
    "sleeping.effective_potential": _one_part_moves,
    "conditions.positive_where": _as_strictly,
    "free_rotation.euler_equation": _rate_of_the_component,
    "inertia.entry_moved": _inward_or_outward,
    "lagrangian.lagrangian": _difference,
    "lagrangian.weight_energy": _product_of("mass", "gravity", "height"),
    "potentials.curvature_at": _at_a_place,
}

for _rule, _told in _TABLE.items():
    told_by(_rule, _told)
