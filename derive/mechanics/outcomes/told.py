"""What must be true of what a sentence tells besides its chain: roles, formulas and points, by rule.

A role takes part in the law by its place, and in a sentence by its name; a formula that only a sentence shows is in no
line. Here it is said what either must fulfil, with the result as the judge. `establish` asks, whatever the outcome.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sympy import Integer, Symbol, diff, integrate, pi

from derive.algebra.expressions import Relation, explicit, rate
from derive.steps.known_numbers import sign_known
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


def _letters_of(value: Any) -> set[Any]:
    return set(explicit(value).free_symbols)


def _for_a_vector(facts: Judged, outcome: str) -> bool:
    return getattr(facts.inputs["vector"], "shape", None) == (3, 1)


def _equation_in_its_unknown(facts: Judged, outcome: str) -> bool:
    equation, unknown = facts.inputs["equation"], facts.inputs["unknown"]
    return isinstance(equation, Relation) and isinstance(unknown, Symbol) and unknown in _letters_of(equation)


def _counted_from_its_point(facts: Judged, outcome: str) -> bool:
    """A length or a position is counted from the point that it is about."""
    return facts.words["start"] == getattr(facts.subject.point, "name", facts.words["start"])


def _from_its_point_along_the_axis(facts: Judged, outcome: str) -> bool:
    along = outcome != "on_axis" or str(facts.symbol.name).endswith("z")
    return _counted_from_its_point(facts, outcome) and along


def _says_its_bound(facts: Judged, outcome: str) -> bool:
    """At the bound itself there still is a root, so that only what is beyond it has none."""
    return outcome != "none" or (facts.result.mark == "<" and is_zero(facts.result.right))


def _of_its_coordinate(facts: Judged, outcome: str) -> bool:
    """The value that is told is what the momentum is, and the equation holds the rate of its coordinate."""
    moving = rate(facts.inputs["coordinate"]) in _letters_of(facts.result)
    return (
        moving
        and facts.result.mark == "="
        and is_zero(
            (facts.result.left - facts.result.right)
            * diff(explicit(facts.inputs["momentum"]), rate(facts.inputs["coordinate"]))
            / diff(facts.result.left, rate(facts.inputs["coordinate"]))
            - explicit(facts.inputs["momentum"])
            + explicit(facts.inputs["value"])
        )
    )


def _not_negative(facts: Judged, outcome: str) -> bool:
    """A period, a frequency or an amplitude; where its sign depends on the letters its condition is told."""
    return sign_known(facts.result) != -1


def _axis_as_named(facts: Judged, outcome: str) -> bool:
    return outcome != "diagonal" or facts.words["axis"] == outcome


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


def _names_the_axis_of_the_whole(facts: Judged, outcome: str) -> bool:
    """An axis of the whole, of which a part has a moment, is that in the letter of the moment: I_z."""
    seen, whole = facts.words.get("seen"), facts.words.get("whole")
    by_letter = facts.symbol.name.partition("_")[2].partition("_")[0] if facts.symbol is not None else ""
    return (whole is None or whole == by_letter) and (seen != "mapped" or not facts.subject.body.is_of_particles)


def _as_asked(facts: Judged, outcome: str) -> bool:
    """Roots are those of an equation, zeros those of a result, which does vanish where it is said to elsewhere."""
    given = facts.inputs["equation"]
    beside = facts.inputs.get("elsewhere")
    vanishes = beside is None or is_zero(explicit(given).subs(beside.left, 0))
    return vanishes and (facts.words["asked"] == "roots") == isinstance(given, Relation)


_TABLE: dict[str, Told] = {
    "roots.roots": _as_asked,
    "roots.roots_absent": _as_asked,
    "rotation.kinetic_energy": _of_their_kinds,
    "rotation.angular_momentum": _of_their_kinds,
    "rotation.torque": _of_their_kinds,
    "free_rotation.rate_in_body": _of_their_kinds,
    "bodies.volume": _cylindrical,
    "roots.together": _equation_in_its_unknown,
    "roots.one_of_two": _says_its_bound,
    "effective.value_kept": _of_its_coordinate,
    "bodies.axis_vector": _axis_as_named,
    "bodies.centre_component": _from_its_point_along_the_axis,
    "bodies.centre_of_mass": _counted_from_its_point,
    "bodies.section_radius": _counted_from_its_point,
    "equations.at": _for_a_vector,
    "free_rotation.euler_equation": _rate_of_the_component,
    "inertia.entry_moved": _inward_or_outward,
    "inertia.moment_of_inertia": _names_the_axis_of_the_whole,
    "lagrangian.lagrangian": _difference,
    "modes.period": _not_negative,
    "modes.beats": _not_negative,
    "linear_motion.steady_amplitude": _not_negative,
}

for _rule, _told in _TABLE.items():
    told_by(_rule, _told)
