"""What must be true of the letters and places that only a sentence names, by rule and role.

Such a letter or place is in no line of the step, and there is no other way to it; the result and the inputs judge it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import islice
from typing import Any

from sympy import Expr, I, Integer, MatrixBase, Rational, Symbol, cos, diff, oo, sign, sin

from derive.algebra.equality import equal
from derive.algebra.expansion import Approach
from derive.algebra.expressions import TIME, At, Relation, explicit, rate
from derive.algebra.ordered_roots import OrderedRoot
from derive.algebra.samples import letters_of, seed_of, value_at
from derive.mechanics.outcomes.signs import points_as_assumed, same_equation
from derive.mechanics.outcomes.told import (
    given_as_the_condition_has_it,
    is_a_root_just_where_told,
    sum_of_the_equations_times_their_factors,
)
from derive.mechanics.outcomes.told_of_motion import starts_as_told
from derive.steps.known_numbers import sign_known
from derive.steps.outcomes import Judged, Naming, named_by
from derive.steps.step import is_zero

TRIED, LITTLE = 6, Rational(1, 10**9)


def _as_told(predicate: Callable[[Judged, str], bool]) -> Naming:
    """What the sentence of the rule is judged by as a whole."""
    return lambda facts, _: predicate(facts, "")


def _value(facts: Judged, role: str) -> Any:
    return explicit(facts.inputs[role])


def _parallel(one: Mapping[Any, Expr], other: Mapping[Any, Expr]) -> bool:
    """Whether two rows of numbers are proportional, and the second is not zero."""
    first = next((k for k, value in other.items() if not is_zero(value)), None)
    return first is not None and all(is_zero(one[k] * other[first] - one[first] * other[k]) for k in other)


# --- coordinates ---


def _equation_of(facts: Judged, q: Any) -> bool:
    """The accelerations stand in Lagrange's equation for q with the second derivatives of L by q_dot and each rate."""
    L, moving = _value(facts, "lagrangian"), facts.quantities["lagrangian"].coordinates
    residual = explicit(facts.result).residual
    inertia = {s: diff(L, rate(q), rate(s)) for s in moving}
    if all(is_zero(value) for value in inertia.values()):  # a coordinate that nothing has a mass along
        return q in moving and (q in residual.free_symbols or rate(q) in residual.free_symbols)
    return q in moving and _parallel({s: diff(residual, rate(s, 2)) for s in moving}, inertia)


def _differentiated_by(facts: Judged, q: Any) -> bool:
    return bool(facts.symbol.args[1] == q)


def _momentum_of(facts: Judged, q: Any) -> bool:
    """The rates stand in the jump with the second derivatives of T by q_dot and each rate, in that moment."""
    T, there = _value(facts, "kinetic"), dict(facts.inputs["at"])
    moving = facts.quantities["kinetic"].coordinates
    inertia = {s: diff(T, rate(q), rate(s)).subs(there, simultaneous=True) for s in moving}
    return q in moving and _parallel({s: diff(explicit(facts.result).left, rate(s)) for s in moving}, inertia)


def _impulse_of_its_condition(facts: Judged, letter: Any) -> bool:
    """The power of the impulse has each rate with the factor that it has in the condition."""
    power, left = diff(_value(facts, "power"), letter), explicit(facts.result).left
    rates = power.free_symbols | left.free_symbols
    return _parallel({v: diff(power, v) for v in rates}, {v: diff(left, v) for v in rates})


def _only_coordinate(facts: Judged, q: Any) -> bool:
    """The one coordinate that the potential energy contains."""
    of = facts.quantities.get("potential") or facts.quantities["condition_0"].parents[0]
    return {s for s in of.coordinates if explicit(of.value).has(s)} == {q}


def _solved_for(facts: Judged, unknown: Any) -> bool:
    return bool(unknown == facts.symbol)


def _alone_in_its_equation(facts: Judged, q: Any) -> bool:
    motion = facts.quantities["motion"]
    return {s for s in motion.coordinates if explicit(motion.value).residual.has(s, rate(s), rate(s, 2))} == {q}


def _small_function(of: Callable[[Any], Any]) -> Naming:
    def is_so(facts: Judged, value: Any) -> bool:
        motion = explicit(facts.quantities["motion"].value).residual
        return bool(value == of(facts.inputs["alone"])) and motion.has(value)

    return is_so


# --- places and values ---


def _level_there(role: str) -> Naming:
    """The slope of the energy vanishes at the place that is named."""

    def is_so(facts: Judged, place: Any) -> bool:
        slope = diff(_value(facts, role), place.left).subs(place.left, explicit(place.right))
        return place.mark == "=" and (_vanishes_as_assumed(slope) if slope.has(sign) else is_zero(slope))

    return is_so


def _vanishes_as_assumed(slope: Expr) -> bool:
    """With numbers for the letters: which side of a point of the spring the place is on may be assumed."""
    drawn = islice(points_as_assumed(letters_of(slope), seed_of(slope)), TRIED)
    seen = [abs(value_at(slope, point)) < LITTLE for point in drawn]
    return bool(seen) and all(seen)


def _extreme_there(facts: Judged, place: Any) -> bool:
    there = _value(facts, "potential").subs(place.left, explicit(place.right))
    return _level_there("potential")(facts, place) and is_zero(there - explicit(facts.result))


def _flat_in_that_case(facts: Judged, case: Any) -> bool:
    """On the border the curvature vanishes too, and the left side shows that border."""
    q, place = facts.inputs["coordinate"], facts.inputs["place"]
    curvature = explicit(At(_value(facts, "potential"), case.left, case.right)).diff(q, 2).subs(q, place)
    return case.mark == "=" and is_zero(curvature) and facts.symbol.args[1:] == (case.left, case.right)


def _energy_there(facts: Judged, place: Any) -> bool:
    """The energy has there, with the rate at the start, the value that it keeps."""
    start = {place.left: explicit(place.right), rate(place.left): explicit(facts.inputs["initial"])}
    return place.mark == "=" and is_zero(
        _value(facts, "energy").subs(start, simultaneous=True) - explicit(facts.result).right
    )


def _turns_back_there(facts: Judged, amplitude: Any) -> bool:
    return is_zero(_value(facts, "squared").subs(facts.inputs["coordinate"], amplitude))


def _pushes_there(facts: Judged, place: Any) -> bool:
    """At the start the two touch: the force is not negative."""
    alone = bool(facts.result.left == place.left) and place.mark == "="
    if not isinstance(place.left, Symbol):
        return alone
    return alone and sign_known(_value(facts, "force").subs(place.left, explicit(place.right))) != -1


def _force_vanishes_there(facts: Judged, place: Any) -> bool:
    """At a place that the motion does not reach the force would be zero."""
    return place.mark == "=" and is_zero(_value(facts, "force").xreplace({place.left: explicit(place.right)}))


def _there_on_constraints(facts: Judged) -> dict[Any, Any]:
    return dict(zip(facts.inputs["coordinates"], facts.inputs["place"], strict=True))


def _on_the_constraints(facts: Judged, named: Any) -> bool:
    """The coordinates, their values at rest, at which every constraint holds, or one of the constraints itself."""
    there = _there_on_constraints(facts)
    kept = all(is_zero(explicit(residual).xreplace(there)) for residual in facts.inputs["constraints"])
    if not isinstance(named, Relation):
        return kept and list(explicit(named)) == list(there)
    if isinstance(explicit(named.left), MatrixBase):
        return kept and dict(zip(explicit(named.left), explicit(named.right), strict=True)) == there
    return kept and any(is_zero(explicit(named).residual - explicit(each)) for each in facts.inputs["constraints"])


def _along_the_constraints(facts: Judged, way: Any) -> bool:
    """To first order a displacement in this direction keeps every constraint."""
    there = _there_on_constraints(facts)
    slopes = [
        sum(diff(explicit(residual), q) * dq for q, dq in zip(there, explicit(way), strict=True)).xreplace(there)
        for residual in facts.inputs["constraints"]
    ]
    return all(map(is_zero, slopes))


def _nothing_is_left(facts: Judged, drift: Any) -> bool:
    """In a uniform motion along the zero mode nothing is left of the whole equations of motion."""
    left = facts.inputs["left"]
    return drift == 0 and bool(left) and all(is_zero(explicit(each)) for each in left)


def _root_under_the_sign(facts: Judged, name: Any) -> bool:
    """The square of the result is a root of that letter, and the sentence names the smallest, whose number is 1."""
    square = facts.result**2
    return isinstance(square, OrderedRoot) and str(name) == f"{str(square.name).rpartition('_')[0]}_1"


def _slope_vanishes_by(facts: Judged, letter: Any) -> bool:
    slope = diff(_value(facts, "quantity"), letter)
    return letter != facts.symbol and is_zero(slope.subs(letter, explicit(facts.result)))


def _put_in(facts: Judged, value: Any) -> bool:
    """Where letters alone are replaced, each by a value of others, the original becomes the result, or an equation
    that says the same."""
    told = {v.left: v.right for role, v in facts.inputs.items() if role.rpartition("_")[0] == "value"}
    others = [role for role in facts.quantities if role.rpartition("_")[0] == "other"]
    if value.mark != "=" or value.left.could_extract_minus_sign():
        return False
    plain = all(isinstance(letter, Symbol) for letter in told)
    if others or not plain or any(explicit(at).has(*told) for at in told.values()):
        return True
    before, after = explicit(facts.inputs["original"]), explicit(facts.result)
    names = {s.name for s in before.free_symbols}
    if any({f"{letter.name}_dot", f"{letter.name}_ddot"} & names for letter in told):  # which are replaced with it
        return True
    there = before.xreplace({letter: explicit(at) for letter, at in told.items()})
    if isinstance(after, Relation):
        return isinstance(there, Relation) and same_equation(there.residual, after.residual)
    return bool(equal(there, after))


# --- steady motions ---


def _stays_and_turns(facts: Judged, relation: Any) -> bool:
    """With what stays and what turns as the sentence says, the slope of L vanishes where the result does."""
    told = {v.left: explicit(v.right) for role, v in facts.inputs.items() if role.startswith(("stays_", "turns_"))}
    if relation.mark != "=" or relation.left == relation.right:
        return False
    if "lagrangian" not in facts.quantities:  # of an equation of motion, which holds the rates themselves
        q = facts.inputs["coordinate"]
        still = {rate(q): Integer(0), rate(q, 2): Integer(0), **told}
        left = explicit(facts.inputs["equation"]).residual.subs(still, simultaneous=True)
        return same_equation(left, explicit(facts.result).residual)
    L, q = _value(facts, "lagrangian"), facts.inputs["coordinate"]
    cyclic = {rate(s) for s in facts.quantities["lagrangian"].coordinates if not L.has(s)}
    still = {rate(s): Integer(0) for s in facts.quantities["lagrangian"].coordinates if rate(s) not in cyclic}
    slope = diff(L, q).subs({**still, **told}, simultaneous=True)
    return same_equation(slope, explicit(facts.result).residual)


def _momentum_there(facts: Judged, relation: Any) -> bool:
    """The momentum of that letter, as it was found, in the steady motion; or a letter of the value that it keeps."""
    steady = next((f for f in facts.quantities["where"].facts if hasattr(f, "conditions")), None)
    behind = list(facts.quantities["potential"].ancestors())
    if steady is None or relation.mark != "=":
        return False
    kept = [dict(e.step.roles) for e in behind if e.step.rule == "lagrange.value_kept"]
    values = {roles["momentum"]: explicit(roles["value"]) for roles in kept}
    stated = {relation.left: explicit(relation.right)}
    for letter, value in {**values, relation.left: relation.left}.items():
        momenta = [e for e in behind if e.symbol == letter]
        if not momenta or not value.has(relation.left):
            continue
        moving = {rate(s): Integer(0) for s in momenta[0].coordinates}
        moving |= {rate(s): v for s, v in steady.rates.items()} | dict(steady.values)
        found = next((e for e in momenta if not isinstance(e.value, Symbol)), momenta[0])
        return is_zero(explicit(found.value).subs(moving, simultaneous=True) - value.xreplace(stated))
    return False


def _there_where_it_exists(facts: Judged, exists: Any) -> bool:
    place = explicit(facts.quantities["where"].value)
    inputs = {"positive": Integer(0), "condition": exists}
    return isinstance(place, MatrixBase) or is_a_root_just_where_told(Judged(place, inputs))


def _taken_out(facts: Judged, relation: Any) -> bool:
    """It is in the condition, and no longer in the result."""
    if relation.mark != "=":
        return False
    held = explicit(facts.quantities["where"].value).free_symbols
    return relation.left in held and relation.left not in explicit(facts.result).free_symbols


# --- oscillations ---


def _trial(unit: Any, role: str) -> Naming:
    """It starts from 1, and its rate is the exponent times itself."""

    def is_so(facts: Judged, value: Any) -> bool:
        return value.subs(TIME, 0) == 1 and is_zero(diff(value, TIME) - unit * facts.inputs[role] * value)

    return is_so


def _oscillator(facts: Judged, equation: Any) -> bool:
    """Times the inertia, and with the result for the square of the frequency, it is the linear equation."""
    linear = explicit(facts.quantities["linear"].value).residual
    inertia = explicit(facts.inputs.get("inertia", Integer(1)))
    there = equation.left.doit().subs(facts.symbol, explicit(facts.result))
    return is_zero(linear - inertia * there)


def _divided_by(facts: Judged, inertia: Any) -> bool:
    q = facts.inputs["q"]
    return is_zero(diff(explicit(facts.quantities["linear"].value).residual, rate(q, 2)) - explicit(inertia))


def _its_acceleration(facts: Judged, letter: Any) -> bool:
    return bool(letter == rate(facts.inputs["q"], 2)) and explicit(facts.quantities["linear"].value).has(letter)


def _displacements(facts: Judged) -> list[Any]:
    linear = facts.quantities["linear"]
    return next([s.symbol for s in f.displacements] for f in linear.facts if hasattr(f, "displacements"))


def _moves_alone(facts: Judged, letter: Any) -> bool:
    moved = [s for s, a in zip(_displacements(facts), facts.result, strict=True) if not is_zero(a)]
    return bool(moved[0] == letter)


def _moves_so(facts: Judged, displacements: Any) -> bool:
    """The motion that is told of each displacement satisfies the linear equation."""
    equation = explicit(facts.quantities["linear"].value).residual
    motion: dict[Any, Any] = {}
    for s, course in zip(explicit(displacements), explicit(facts.result), strict=True):
        motion |= {rate(s, n) if n else s: diff(course, TIME, n) for n in range(3)}
    return is_zero(equation.xreplace(motion))


def _moves_as(which: int) -> Naming:
    def is_so(facts: Judged, letter: Any) -> bool:
        told = zip(explicit(facts.inputs["displacements"]), explicit(facts.result), strict=True)
        return bool([s for s, course in told if not is_zero(course)][which] == letter)

    return is_so


def _falls_along(facts: Judged, _: Any) -> bool:
    """Along the line in that direction the second derivative of the energy is what the sentence says."""
    s = Symbol("s_along", real=True)
    names, way = explicit(facts.inputs["moving"]), explicit(facts.inputs["direction"])
    line = {q: p + s * u for q, p, u in zip(names, facts.inputs["place"], way, strict=True)}
    energy = _value(facts, "potential_here").subs(line, simultaneous=True)
    return is_zero(diff(energy, s, 2).subs(s, 0) - explicit(facts.inputs["falling"]))


# --- limits ---


def _small_there(facts: Judged, small: Any) -> bool:
    x, to = facts.inputs["letter"], facts.inputs["to"]
    if to in (oo, -oo):
        return is_zero(small * x - 1)
    return is_zero(small.subs(x, to)) and is_zero(diff(small, x) - 1)


def _near_that(facts: Judged, place: Any) -> bool:
    """What is said to be small vanishes there."""
    return is_zero(facts.inputs["small"].subs(facts.inputs["letter"], place))


def _highest_power(facts: Judged, power: Any) -> bool:
    """No power beyond it is kept, and it is the order that was asked for."""
    order, x, to = (facts.inputs[role] for role in ("order", "letter", "to"))
    if order == -1 or to in (oo, -oo):
        return order in (-1, power)
    return order == power and is_zero(diff(explicit(facts.inputs["kept"]), x, int(power) + 1))


def _for_short_times(facts: Judged, time: Any) -> bool:
    return is_zero(time * facts.inputs["letter"] - 1) and explicit(facts.inputs["kept"]).has(TIME)


def _goes_to(facts: Judged, place: Any) -> bool:
    """What is named comes close to the place that is named."""
    approach = facts.inputs["approach"]
    return isinstance(approach, Approach) and is_zero(approach.args[1] - place)


def _right_of_a_bound(facts: Judged, bound: Any) -> bool:
    of = facts.quantities["quantity"].value
    return isinstance(of, Relation) and of.mark != "=" and is_zero(explicit(of.right) - bound)


def _at_its_place(facts: Judged, state: Any) -> bool:
    """Each coordinate has the value at which the energy is judged, or the name of the state of rest."""
    moving, place = facts.inputs["coordinates"], facts.inputs["place"]
    if state.mark != "=":
        return False
    if len(moving) > 1:
        pairs = zip(state.right.args, place, strict=True)
        return state.left.args == tuple(moving) and all(is_zero(one - other) for one, other in pairs)
    rest = getattr(facts.quantities.get("at"), "symbol", None)
    return state.left == moving[0] and (state.right == rest or is_zero(state.right - place[0]))


_TABLE: dict[str, dict[str, Naming]] = {
    "lagrange.equation_of_motion": {"coordinate": _equation_of},
    "lagrange.generalized_force": {"coordinate": _differentiated_by},
    "lagrange.forced_equation": {"coordinate": _equation_of},
    "impacts.momentum_jump": {"coordinate": _momentum_of},
    "impacts.meeting_condition": {"impulse": _impulse_of_its_condition},
    "rest.condition": {"steady": _only_coordinate},
    "rest.equilibrium": {"steady": _only_coordinate},
    "rest.stability": {"steady": _only_coordinate, "place": _level_there("potential_here"), "state": _at_its_place},
    "rest.stability_on_constraints": {
        "state": _on_the_constraints,
        "moving": _on_the_constraints,
        "constraint": _on_the_constraints,
        "way": _along_the_constraints,
    },
    "rest.stability_of_several": {"state": _at_its_place, "moving": _falls_along, "direction": _falls_along},
    "rest.extreme_value": {"place": _extreme_there},
    "rest.leading_order": {"case": _flat_in_that_case},
    "answers.solved_for": {"unknown": _solved_for},
    "vibrations.linearised": {
        "alone": _alone_in_its_equation,
        "sine": _small_function(sin),
        "cosine": _small_function(cos),
    },
    "motion.energy_kept": {"place": _energy_there},
    "motion.period_by_energy": {"amplitude": _turns_back_there},
    "motion.leaves_contact": {"from": _pushes_there, "place": _force_vanishes_there},
    "answers.extremum_place": {"letter": _slope_vanishes_by},
    "answers.put_in": {"value": _put_in},
    "motion.steady_motion": {"stays": _stays_and_turns, "turns": _stays_and_turns},
    "vibrations.frequency_squared_about": {
        "momentum": _momentum_there,
        "exists": _there_where_it_exists,
        "taken_out": _taken_out,
    },
    "vibrations.damped_characteristic": {"trial": _trial(1, "exponent")},
    "vibrations.gyroscopic_characteristic": {"trial": _trial(I, "omega")},
    "vibrations.gyroscopic_motion": {"displacements": _moves_so, "first": _moves_as(0), "second": _moves_as(1)},
    "vibrations.mode_shape": {"moving": _moves_alone, "drift": _nothing_is_left},
    "vibrations.mode_frequency": {"drift": _nothing_is_left, "root": _root_under_the_sign},
    "vibrations.frequency_squared": {
        "oscillator": _oscillator,
        "inertia": _divided_by,
        "acceleration": _its_acceleration,
    },
    "vibrations.solution": {"start": _as_told(starts_as_told), "start_rate": _as_told(starts_as_told)},
    "motion.sum": {"factor": _as_told(sum_of_the_equations_times_their_factors)},
    "numeric.value": {"given": _as_told(given_as_the_condition_has_it)},
    "answers.equation_in_limit": {
        "small": _small_there,
        "place": _near_that,
        "power": _highest_power,
        "short": _for_short_times,
    },
    "answers.limiting_case": {"place": _goes_to, "bound": _right_of_a_bound},
}

for _rule, _named in _TABLE.items():
    named_by(_rule, _named)
