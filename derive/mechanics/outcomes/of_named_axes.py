"""What must be true of the letters and places that only a sentence about a body or its rotation names."""

from __future__ import annotations

from typing import Any

from sympy import Integer, Matrix, Symbol, cos, diff, sin

from derive.algebra.expressions import AXES, explicit, rate
from derive.algebra.tidy import tidied
from derive.mechanics.outcomes.told_of_motion import rates_of_its_equations
from derive.steps.known_numbers import sign_known
from derive.steps.outcomes import Judged, Naming, named_by
from derive.steps.step import is_zero


def _about_that_axis(facts: Judged, letter: Any) -> bool:
    along = facts.inputs["along"]
    return bool(facts.words["axis"] == letter.name) and along.name.rpartition("_")[2] == letter.name


def _steady_component(facts: Judged, along: Any) -> bool:
    """Its rate is what the equation says that is of second order, and it is not in the linear one."""
    return explicit(facts.quantities["slow"].value).has(rate(along)) and not explicit(facts.result).has(along)


def _to_first_order(facts: Judged, speed: Any) -> bool:
    """With that speed about the axis, what is of first order in the two small components is the linear equation."""
    exact, small = explicit(facts.quantities["motion"].value).residual, Symbol("s_small", real=True)
    across = [facts.inputs["small_1"], facts.inputs["small_2"]]
    along = facts.inputs["along"]
    there = {w: small * w for w in across} | {rate(w): small * rate(w) for w in across}
    there |= {along: speed, rate(along): Integer(0)}
    first = diff(exact.xreplace(there), small).subs(small, 0)
    return is_zero(first - explicit(facts.result).residual)


def _another_component(facts: Judged, letter: Any) -> bool:
    """The two that are small are the two other components of the same vector."""
    named = [facts.inputs[role] for role in ("along", "small_1", "small_2")]
    return len(set(named)) == 3 and letter.name.rpartition("_")[0] == named[0].name.rpartition("_")[0]


def _small_one(which: str) -> Naming:
    """Its rate is that of the linear equation which the sentence names there."""
    return lambda facts, letter: explicit(facts.quantities[which].value).has(rate(letter))


def _moment_across(facts: Judged, moment: Any) -> bool:
    """The angular momentum divided by it goes round with the result, and it is a moment of that angular momentum."""
    L = explicit(facts.inputs["momentum"])
    return is_zero((explicit(facts.result) * explicit(moment)) ** 2 - sum((c**2 for c in L), Integer(0)))


def _turned_by(facts: Judged, angle: Any) -> bool:
    """Turned about the axis that is named by that angle, in components."""
    i = AXES.index(facts.words["along"])
    turn = Matrix.eye(3)
    j, k = (i + 1) % 3, (i + 2) % 3
    turn[j, j], turn[k, k], turn[j, k], turn[k, j] = cos(angle), cos(angle), -sin(angle), sin(angle)
    return is_zero((turn.T * explicit(facts.inputs["inertia"]) * turn - explicit(facts.result)).applyfunc(tidied))


# --- bodies that a map describes ---


def _size_of_a_cell(facts: Judged, size: Any) -> bool:
    """It is not negative, and its square is the determinant of what the result has."""
    square = explicit(facts.result) ** 2 if len(facts.inputs["limits"]) == 3 else explicit(facts.result)
    return is_zero(explicit(size) ** 2 - square) and sign_known(explicit(size)) != -1


def _mapped_to(facts: Judged, place: Any) -> bool:
    """The scalar products of its derivatives by the variables have the determinant that the result has."""
    names = [x for x, _, _ in facts.inputs["limits"]]
    slopes = Matrix([[diff(c, x) for x in names] for c in explicit(place)])
    square = explicit(facts.result) ** 2 if len(names) == 3 else explicit(facts.result)
    return is_zero((slopes.T * slopes).det() - square)


def _variable_of_the_map(facts: Judged, x: Any) -> bool:
    told = [facts.inputs[f"u_{k}"] for k in range(len(facts.inputs["limits"]))]
    moved = any(not is_zero(diff(c, x)) for c in explicit(facts.inputs["place"]))
    return moved and told == [name for name, _, _ in facts.inputs["limits"]]


def _proportional_to(facts: Judged, profile: Any) -> bool:
    ratio = tidied(explicit(facts.result) / explicit(profile))
    return not ratio.free_symbols & {x for x, *_ in facts.subject.body.map()[1]}


def _of_its_equation(facts: Judged, _: Any) -> bool:
    return rates_of_its_equations(facts, "")


_TABLE: dict[str, dict[str, Naming]] = {
    "rotation.perturbed_rotation": {
        "letter": _about_that_axis,
        "along": _steady_component,
        "speed": _to_first_order,
        "small": _another_component,
    },
    "rotation.perturbation_rate_squared": {"small_1": _small_one("first"), "small_2": _small_one("second")},
    "rotation.body_cone_rate": dict.fromkeys(("along", "around", "beside"), _of_its_equation),
    "rotation.precession_rate": {"across": _moment_across},
    "rotation.turned_tensor": {"angle": _turned_by},
    "bodies.cell_of": {"cell": _size_of_a_cell, "place": _mapped_to, "u": _variable_of_the_map},
    "bodies.normalised_density": {"profile": _proportional_to},
}

for _rule, _named in _TABLE.items():
    named_by(_rule, _named)
