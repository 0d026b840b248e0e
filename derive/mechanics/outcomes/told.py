"""What must be true of what a sentence tells besides its chain: roles, formulas and points, by rule.

A role takes part in the law by its place, and in a sentence by its name; a formula that only a sentence shows is in no
line. Here it is said what either must fulfil, with the result as the judge. `establish` asks, whatever the outcome.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from itertools import islice
from typing import Any

from sympy import Integer, Matrix, MatrixBase, Mul, Symbol, cos, diff, factor, factor_terms, integrate, oo, pi, sin

from derive.algebra.expansion import Approach
from derive.algebra.expressions import AXES, PLUS_MINUS, Relation, explicit, rate
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.mechanics.bodies.facts import CountedFrom
from derive.mechanics.outcomes.signs import MARK_OF, is_so
from derive.steps.known_numbers import sign_known, with_numbers
from derive.steps.outcomes import Judged, told_by
from derive.steps.record import assumed
from derive.steps.step import is_zero

POINTS = 24

Told = Callable[[Judged, str], bool]

_KINDS = {"omega": "angular speed", "inertia": "moment of inertia", "momentum": "angular momentum"}


def _of_their_kinds(facts: Judged, outcome: str) -> bool:
    """Whether each role that is a vector or a tensor of rotation is one."""
    return all(q.step.kind == _KINDS.get(role, q.step.kind) for role, q in facts.quantities.items())


def _of_their_kinds_by_euler(facts: Judged, outcome: str) -> bool:
    """Euler's equations are named where the axes are principal ones."""
    along_principal_axes = is_zero(facts.inputs["inertia"] - Matrix.diag(*facts.inputs["inertia"].diagonal()))
    return _of_their_kinds(facts, outcome) and along_principal_axes == ("euler" in facts.words)


def _volume_of_its_sections(facts: Judged, outcome: str) -> bool:
    """The areas of the cross-sections, added up over the height, give the volume."""
    body, z = facts.subject.body, Symbol("z_along", real=True)
    sections = integrate(pi * body.radius_at(z) ** 2, (z, *body.ends))
    return is_zero(sections - explicit(facts.result))


def _section_as_told(facts: Judged, outcome: str) -> bool:
    """x = s cos, y = s sin, where they are told: their area element is that of the integral, and x is s at the first
    direction."""
    if ("polar" in facts.words) != ("x_is" in facts.inputs):
        return False
    if "x_is" in facts.inputs:
        (_, theta, s), x, y = facts.inputs["names"], facts.inputs["x_is"], facts.inputs["y_is"]
        area = diff(x, s) * diff(y, theta) - diff(x, theta) * diff(y, s)
        if not is_zero(area - facts.inputs["element"]) or not is_zero(x.subs(theta, 0) - s):
            return False
    return _counted_from_its_point(facts, outcome)


def _letters_of(value: Any) -> set[Any]:
    return set(explicit(value).free_symbols)


def _for_a_vector(facts: Judged, outcome: str) -> bool:
    return getattr(facts.inputs["vector"], "shape", None) == (3, 1)


def _equation_in_its_unknown(facts: Judged, outcome: str) -> bool:
    equation, unknown = facts.inputs["equation"], facts.inputs["unknown"]
    excluded = unknown in _letters_of(facts.inputs.get("excluded", Integer(0)))
    return isinstance(equation, Relation) and unknown in _letters_of(equation) and not excluded


def _counted_from_its_point(facts: Judged, outcome: str) -> bool:
    """A length or a position is counted from the point that it is about."""
    return facts.words["start"] == getattr(facts.subject.point, "name", facts.words["start"])


def _from_its_point_along_the_axis(facts: Judged, outcome: str) -> bool:
    axis = facts.inputs["along"].name
    along = axis in re.split(r"[_,]", facts.symbol.name) and (outcome != "on_axis" or axis == "z")
    return _counted_from_its_point(facts, outcome) and along


def _says_its_bound(facts: Judged, outcome: str) -> bool:
    """At the bound itself there still is a root, so that only what is beyond it has none."""
    return outcome != "none" or (facts.result.mark == "<" and is_zero(facts.result.right))


def _a_root_of_its_sign(facts: Judged, outcome: str) -> bool:
    """With the upper or the lower sign in both roots there is the one that was found."""
    if "sign" not in facts.words:
        return _says_its_bound(facts, outcome)
    sign = {"upper": 1, "lower": -1}[facts.words["sign"]]
    return is_zero(explicit(facts.inputs["roots"]).xreplace({PLUS_MINUS: Integer(sign)}) - explicit(facts.result))


def _vanish_again(facts: Judged, outcome: str) -> bool:
    """Products of inertia vanish here too where a tensor about another point, from which this one is, has none."""
    tensor = facts.quantities["inertia"]
    before = [e.value for e in tensor.ancestors() if isinstance(e.value, MatrixBase) and e.value.shape == (3, 3)]
    again = any(each.is_diagonal() and each != tensor.value for each in before)
    return facts.words["seen"] == "first" or again and facts.words["seen"] == "kept"


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


def _axis_as_named(facts: Judged, outcome: str) -> bool:
    return outcome != "diagonal" or facts.words["axis"] == outcome


def _rate_of_the_component(facts: Judged, outcome: str) -> bool:
    return "rate" in facts.quantities and rate(facts.inputs["component"]) in _letters_of(facts.result)


def _inward_or_outward(facts: Judged, outcome: str) -> bool:
    """The tensor exceeds that about the centre of mass, or is less than the other: it depends on where one starts."""
    if facts.words["start"] != facts.quantities["centre"].needed(CountedFrom).start.name:
        return False
    if "entry" not in facts.quantities:  # a product that vanishes at the centre of mass
        return outcome == "outward"
    point = facts.quantities["entry"].subject.point
    return point is None or (point.name in {"centre", "centre_of_mass"}) == (outcome == "outward")


def _difference(facts: Judged, outcome: str) -> bool:
    roles = ("kinetic", "potential", "magnetic")
    kinetic, potential, magnetic = (explicit(facts.inputs.get(role, Integer(0))) for role in roles)
    return is_zero(explicit(facts.result) - kinetic + potential - magnetic)


def _names_the_axis_of_the_whole(facts: Judged, outcome: str) -> bool:
    """An axis of the whole, of which a part has a moment, is that in the letter of the moment, I_z, and is parallel to
    the axis of the part."""
    seen, whole, turn = facts.words.get("seen"), facts.words.get("whole"), facts.inputs.get("turn")
    if turn is None:
        in_its_way = seen != "mapped" or not facts.subject.body.is_of_particles
        return whole is None and seen != "part" and in_its_way
    by_letter, own = facts.symbol.name.partition("_")[2], "xyz".index(facts.words["axis"])
    parallel = {"xyz"[k] for k in range(3) if is_zero(turn[own, k] ** 2 - 1)}
    return by_letter == whole and {whole} == parallel if parallel else by_letter == "axial" and whole is None


def _as_asked_for(facts: Judged, outcome: str) -> bool:
    """Roots are those of an equation, zeros those of a result, which does vanish where it is said to elsewhere."""
    given = facts.inputs["equation"]
    beside, whole = facts.inputs.get("elsewhere"), explicit(given)
    whole = whole.residual if isinstance(whole, Relation) else whole
    vanishes = beside is None or all(is_zero(whole.subs(factor, 0)) for factor in Mul.make_args(beside.left))
    return vanishes and facts.words["asked"] == ("roots" if isinstance(given, Relation) else "zeros")


def _as_asked(facts: Judged, outcome: str) -> bool:
    is_letter = isinstance(facts.inputs["unknown"], Symbol)
    numbered = facts.inputs["count"] == 1 or facts.symbol != facts.inputs["unknown"]
    if not is_letter:  # the value of a cosine is called a cosine
        numbered = getattr(facts.symbol, "func", None) == facts.inputs["unknown"].func
    limited = "existing" not in facts.inputs or isinstance(facts.inputs["unknown"], sin | cos)
    held = explicit(facts.inputs["equation"]).has(explicit(facts.inputs["unknown"]))
    return numbered and limited and held and _as_asked_for(facts, outcome) and is_a_root_just_where_told(facts)


def _word_of_its_mark(facts: Judged, outcome: str) -> bool:
    """ "at most" for <=: the first line shows the mark, and what follows is compared with that; and the quantity is
    what is compared, not what it is compared with."""
    difference = explicit(facts.inputs["quantity"]) - explicit(facts.inputs["bound"])
    mark = str(facts.inputs["mark"])
    right_word = MARK_OF.get(facts.words["comparison"]) == mark
    if facts.inputs.get("for_real"):  # roots are real where their discriminant is positive, or not negative
        right_word &= mark in (">", ">=") and facts.quantities["quantity"].step.rule == "answers.discriminant"
    radicand = (
        facts.words.get("seen") == "radicand" and facts.quantities["quantity"].step.rule != "answers.discriminant"
    )
    return right_word and not radicand and is_zero(difference - facts.inputs["difference"])


def is_a_root_just_where_told(facts: Judged) -> bool:
    """In numbers it is real, and positive where it must be, where the condition holds and nowhere else.

    Letters with a number have that: it may have decided what the condition would leave open.
    """
    told, given, value = facts.inputs.get("condition"), facts.inputs.get("existing"), explicit(facts.result)
    conditions = [explicit(each.residual) for each in (told, given) if each is not None]
    letters = letters_of(value).union(*map(letters_of, conditions))
    known = {letter: number for letter in letters if not (number := with_numbers(letter)).free_symbols}
    for drawn in islice(points(letters, seed_of(value)), POINTS):
        try:
            point = {**drawn, **known}
            number = value_at(value, point)
            if given is not None and not is_so(given, point):
                continue
            is_root = bool(number.is_real) and (facts.inputs["positive"] == 0 or number > 0)
            if is_root != (told is None or is_so(told, point)):
                return False
        except (Undefined, NoNumber):
            continue
    return True


def _steady_as_its_potential(facts: Judged, outcome: str) -> bool:
    """Where momenta are kept a coordinate that stays is no rest: the sentence says that others move steadily."""
    of = facts.quantities.get("potential") or facts.quantities["condition_0"].parents[0]
    reduced = [
        e for e in of.ancestors() if (e.step.rule, e.step.outcome) == ("hamilton.effective_potential", "reduced")
    ]
    told = "steady" in facts.inputs
    return bool(reduced) if told else of not in reduced or isinstance(facts.result, MatrixBase)


def _there_where_told(facts: Judged, outcome: str) -> bool:
    """A place where something is extreme is real just where that is said, and between the ends just where that is."""
    told = replace(facts, inputs={"positive": Integer(0), **facts.inputs})
    return is_a_root_just_where_told(told) and _between_the_ends_just_where_told(facts)


def _between_the_ends_just_where_told(facts: Judged) -> bool:
    """By numbers for the letters, where the interval has a width and the place is real."""
    if "within" not in facts.inputs:
        return True
    place, ends = explicit(facts.result), facts.inputs["within"]
    inside = [each for role, each in facts.inputs.items() if role.startswith("inside_")]
    real = [each for role, each in facts.inputs.items() if role == "condition"]
    letters = letters_of(place).union(*map(letters_of, ends), *(letters_of(each.residual) for each in inside))
    for point in islice(points(letters, seed_of(place)), POINTS):
        try:
            low, there, high = (value_at(each, point) for each in (ends[0], place, ends[1]))
            at = {**point, facts.inputs["letter"]: there}
            if not low < high or not all(is_so(each, at) for each in (*real, *assumed())):
                continue
            if (low < there < high) != all(is_so(each, point) for each in inside):
                return False
        except (Undefined, NoNumber, TypeError):
            continue
    return True


def _component_of_its_letter(facts: Judged, outcome: str) -> bool:
    """The axis of the component is the last index of its letter, v_x."""
    index = facts.symbol.name.rpartition("_")[2]
    return index in AXES and is_zero(explicit(facts.inputs["vector"])[AXES.index(index)] - explicit(facts.result))


def _a_second_rate(facts: Judged, outcome: str) -> bool:
    return bool(facts.symbol.name.endswith("_ddot"))


def _says_what_it_divides_by(facts: Judged, outcome: str) -> bool:
    """A factor below the line that might vanish is told not to; the first of several solutions says so for all."""
    below = factor_terms(explicit(facts.result)).as_numer_denom()[1]
    unsure = [f for f in Mul.make_args(factor(below)) if sign_known(f) is None and not f.as_base_exp()[0].is_nonzero]
    return not unsure or outcome == "following" or "excluded" in facts.inputs


def _about_an_energy(facts: Judged, outcome: str) -> bool:
    return not isinstance(facts.inputs["potential"], MatrixBase)


def _goes_where_it_is_said(facts: Judged, outcome: str) -> bool:
    """What is named goes to its limit where the letter that was expanded in does: h/R with h."""
    goes, approach, to = (facts.inputs[role] for role in ("letter", "approach", "to"))
    if not isinstance(approach, Approach) or approach.args[0] != goes:
        return False
    aim = approach.args[1]
    return aim == to if aim in (oo, -oo) else is_zero(aim * facts.inputs["x"] / goes - to)


def given_as_the_condition_has_it(facts: Judged, outcome: str) -> bool:
    """The number that is told is that of the letter, and fulfils the condition as it is said to: both in decimals."""
    condition = facts.inputs.get("condition")
    if condition is None:
        return "seen" not in facts.words
    told = facts.inputs["given"]
    apart = float(explicit(condition.left) - explicit(facts.result.right))
    is_so = {">": apart > 0, ">=": apart >= 0, "<": apart < 0, "<=": apart <= 0}[condition.mark]
    near = abs(float(explicit(told.right)) / float(explicit(condition.left)) - 1) < 0.05
    named = (told.left, told.mark) == (facts.result.left, "=")
    return near and named and is_so == (facts.words["seen"] == "fulfilled")


def sum_of_the_equations_times_their_factors(facts: Judged, outcome: str) -> bool:
    """Each equation that is named, times the factor that is named with it, adds up to the result."""
    named = [role for role in facts.quantities if role.startswith("equation_")]
    products = (facts.inputs[f"factor_{role[9:]}"] * explicit(facts.quantities[role].value).residual for role in named)
    return is_zero(explicit(facts.result).residual - sum(products, Integer(0)))


def _functions_of_its_constraints(facts: Judged, outcome: str) -> bool:
    """What each multiplier has as a factor in the equation is the derivative of a function that is told, by its
    coordinate or by its rate; but for what friction, which is given by the multiplier, adds to it."""
    q = facts.inputs["coordinate"]
    if facts.words["between"] not in ("coordinates", "rates", "both"):
        return False
    by = rate(q) if facts.words.get("between") == "rates" else q
    told = [explicit(value.right) for role, value in facts.inputs.items() if role.startswith("function_")]
    residual = explicit(facts.result).residual + explicit(facts.inputs.get("applied", Integer(0)))
    if facts.words.get("between") == "both":
        return bool(told)
    along = [diff(function, by) for function in told]
    return all(any(is_zero(diff(residual, letter) + f) for f in along) for letter in facts.inputs["letters"])


def _both(one: Told, other: Told) -> Told:
    return lambda facts, outcome: one(facts, outcome) and other(facts, outcome)


_TABLE: dict[str, Told] = {
    "lagrange.forced_equation": _functions_of_its_constraints,
    "answers.roots": _as_asked,
    "answers.roots_absent": _as_asked_for,
    "answers.extremum_place": _there_where_told,
    "answers.solved_for": _says_what_it_divides_by,
    "lagrange.acceleration": _both(_a_second_rate, _says_what_it_divides_by),
    "lagrange.multiplier": _says_what_it_divides_by,
    "hamilton.rate_by_momenta": _says_what_it_divides_by,
    "answers.limiting_case": _goes_where_it_is_said,
    "numeric.value": given_as_the_condition_has_it,
    "rest.stability_of_several": _about_an_energy,
    "rest.stability": _steady_as_its_potential,
    "rest.condition": _steady_as_its_potential,
    "rest.equilibrium": _steady_as_its_potential,
    "rotation.kinetic_energy": _of_their_kinds,
    "rotation.angular_momentum": _of_their_kinds,
    "rotation.torque": _of_their_kinds_by_euler,
    "rotation.rate_in_body": _of_their_kinds,
    "bodies.volume": _volume_of_its_sections,
    "answers.roots_together": _equation_in_its_unknown,
    "answers.one_of_two": _a_root_of_its_sign,
    "answers.where": _word_of_its_mark,
    "rotation.vector_component": _component_of_its_letter,
    "lagrange.value_kept": _of_its_coordinate,
    "bodies.axis_vector": _axis_as_named,
    "bodies.centre_component": _from_its_point_along_the_axis,
    "bodies.centre_of_mass": _counted_from_its_point,
    "bodies.section_radius": _section_as_told,
    "answers.at": _for_a_vector,
    "rotation.euler_equation": _rate_of_the_component,
    "rotation.entry_moved": _inward_or_outward,
    "rotation.moment_of_inertia": _names_the_axis_of_the_whole,
    "rotation.own_moment": _names_the_axis_of_the_whole,
    "rotation.principal_moments": _vanish_again,
    "lagrange.lagrangian": _difference,
    "motion.sum": sum_of_the_equations_times_their_factors,
}

for _rule, _told in _TABLE.items():
    told_by(_rule, _told)
