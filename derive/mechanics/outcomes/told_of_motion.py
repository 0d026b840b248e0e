"""What must be true of what a sentence about a motion tells besides its chain: where it starts, and that rates,
frequencies and periods have the sign that such quantities have.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from itertools import islice

from sympy import Expr, Symbol, diff, tan

from derive.algebra.expressions import TIME, Relation, explicit, rate
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.mechanics.outcomes.told import POINTS, Told
from derive.steps.known_numbers import sign_known
from derive.steps.outcomes import Judged, told_by
from derive.steps.step import is_zero


def starts_as_told(facts: Judged, outcome: str) -> bool:
    """The motion has the value and the rate at the start that the sentence says."""
    if not _of_an_equation(facts, outcome):
        return False
    told, q = [facts.inputs[role] for role in ("start", "start_rate") if role in facts.inputs], facts.inputs["q"]
    at = [diff(facts.result, TIME, n).subs(TIME, 0) for n in range(len(told))]
    named = [(q, "="), (rate(q), "=")][: len(told)] == [(each.left, each.mark) for each in told]
    return named and all(is_zero(value - each.right) for value, each in zip(at, told, strict=True))


def _starts_as_all_are_told(facts: Judged, outcome: str) -> bool:
    """At the start the coordinate and its rate have the values that the sentence says, or zero where it says none."""
    q = facts.inputs["coordinate"]
    told = {each.left: each.right for role, each in facts.inputs.items() if role.startswith("start_")}
    at_start = {q: facts.result.subs(TIME, 0), rate(q): diff(facts.result, TIME).subs(TIME, 0)}
    others_zero = facts.words["seen"] == "others_zero"
    return all(
        is_zero(value - told[s]) if s in told else others_zero and is_zero(value) for s, value in at_start.items()
    )


def _taken_out_by_its_condition(facts: Judged, outcome: str) -> bool:
    """With what the letter that is taken out is said to be, the condition holds."""
    told, where = facts.inputs.get("taken_out"), facts.quantities["where"].value
    if told is None or not isinstance(where, Relation):
        return True
    return is_zero(explicit(where).residual.subs(told.left, told.right))


def _of_an_equation(facts: Judged, outcome: str) -> bool:
    """What moves is a letter, and what it obeys an equation, or what its rate or acceleration was found to be."""
    q, found = facts.inputs["q"], facts.quantities.get("equation")
    solved_for = isinstance(q, Symbol) and found is not None and found.symbol in (rate(q), rate(q, 2))
    return isinstance(q, Symbol) and (isinstance(facts.inputs["equation"], Relation) or solved_for)


def _swings_of_its_equation(facts: Judged, outcome: str) -> bool:
    return _not_negative(facts, outcome) and _of_an_equation(facts, outcome)


def _not_negative(facts: Judged, outcome: str) -> bool:
    """A period, a frequency or an amplitude; where its sign depends on the letters its condition is told."""
    return sign_known(facts.result) != -1


def _positive_where_real(facts: Judged, outcome: str) -> bool:
    """A frequency is not negative where it is real: in numbers."""
    return all(number >= 0 for number in _real_numbers(facts))


def _somewhere_positive(facts: Judged, outcome: str) -> bool:
    """Which of two frequencies is greater may depend on the letters, but not the wrong one is so for all of them."""
    return _not_negative(facts, outcome) and any(number >= 0 for number in _real_numbers(facts))


def _lag_as_written(facts: Judged, outcome: str) -> bool:
    """With a loss its tangent is told, without one the angle itself."""
    return (getattr(facts.symbol, "func", None) is tan) == (outcome == "damped")


def rates_of_its_equations(facts: Judged, outcome: str) -> bool:
    """Each of the equations that are named is that of its component: the third says that the last is constant."""
    letters = (facts.inputs["around"], facts.inputs["beside"], facts.inputs["along"])
    named = [facts.quantities[role].value for role in ("first", "second", "third")]
    return all(rate(w) in explicit(equation).free_symbols for w, equation in zip(letters, named, strict=True))


def _nowhere_negative(facts: Judged, outcome: str) -> bool:
    """A period or a radius is not negative for any numbers: its sign does not depend on the letters."""
    return _not_negative(facts, outcome) and all(number >= 0 for number in _real_numbers(facts))


def _real_numbers(facts: Judged) -> Iterator[Expr]:
    value = explicit(facts.result)
    for point in islice(points(letters_of(value), seed_of(value)), POINTS):
        with suppress(Undefined, NoNumber):
            number = value_at(value, point)
            if number.is_real:
                yield number


_TABLE: dict[str, Told] = {
    "vibrations.superposition": _starts_as_all_are_told,
    "vibrations.damped_frequency": _positive_where_real,
    "vibrations.mode_frequency": _positive_where_real,
    "vibrations.period": _nowhere_negative,
    "rotation.radius_of_gyration": _nowhere_negative,
    "vibrations.beats": _somewhere_positive,
    "vibrations.solution": starts_as_told,
    "vibrations.frequency_squared_about": _taken_out_by_its_condition,
    "vibrations.steady_amplitude": _swings_of_its_equation,
    "vibrations.lag": _lag_as_written,
    "rotation.body_cone_rate": rates_of_its_equations,
}

for _rule, _told in _TABLE.items():
    told_by(_rule, _told)
