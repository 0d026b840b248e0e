"""Numbers put in at the end: exact until they are rounded, and only when no letter is left."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import Expr, Integer, Rational, Symbol, acos, pi, sin, sqrt

from derive.algebra.equality import Grade
from derive.algebra.expressions import Amount, Relation, bound
from derive.algebra.rounding import decimal_text
from derive.errors import Unverified
from derive.steps import numeric as numbers
from derive.steps.establish import Lines, establish
from derive.steps.numeric import coefficient_of, comparison_of, value_of
from derive.steps.step import Quantity
from tests.mechanics.block import AMOUNTS, M, a, known_block, omega
from tests.rules import made_up

ONE, CENTI = Integer(1), Rational(1, 100)


def valued(
    key: str, unit: str = "", factor: Any = ONE, figures: int = 4, amounts: Any = AMOUNTS, **variant: Any
) -> Quantity:
    found = value_of(known_block(**variant)[key], amounts, unit, factor, figures)
    assert found is not None
    return found


def printed(quantity: Quantity) -> str:
    shown = quantity.step.result
    number, unit = (shown.args[0], shown.args[1].name) if isinstance(shown, Amount) else (shown, "")
    return f"{decimal_text(number)} {unit}".strip()


def test_numbers_are_put_in_and_rounded_once() -> None:
    """3 kg, 2 cm, 900 rpm: 3 * 0.02^2 * (30 pi)^2 = 10.659... N m, times sqrt(42)/28 and 7/24."""
    assert printed(valued("magnitude", "N m")) == "2.467 N m"
    assert printed(valued("energy_about_axis", "J")) == "3.109 J"


def test_a_value_is_given_in_the_unit_that_is_asked_for() -> None:
    assert printed(valued("magnitude", "N cm", Rational(1, 100))) == "246.7 N cm"
    assert printed(valued("angle_between", "degree", pi / 180, amounts={})) == "21.64 degree"
    assert printed(valued("angle_between", "rad", amounts={})) == "0.3777 rad"


def test_a_number_without_letters_needs_no_amounts() -> None:
    found = valued("cosine", figures=5, amounts={})
    assert printed(found) == "0.92951"
    assert found.step.outcome == "exact"
    assert valued("magnitude", "N m").step.outcome == "measured"


def test_each_entry_of_a_vector_is_rounded() -> None:
    shown = valued("torque", "N m", figures=3).step.result
    assert [decimal_text(entry) for entry in shown.args[0]] == ["-1.90", "1.52", "-0.381"]
    assert shown.args[1].name == "N m"


def test_there_is_no_value_while_letters_are_left() -> None:
    for key in ("magnitude", "torque", "kinetic_energy"):
        assert value_of(known_block()[key], {a: AMOUNTS[a], M: AMOUNTS[M]}, "N m", ONE, 4) is None


def test_a_plain_whole_number_needs_no_value() -> None:
    assert value_of(known_block(sides=(a, a, a))["cosine"], {}, "", ONE, 4) is None


def test_the_exact_value_stays_behind_the_rounded_one() -> None:
    found = valued("magnitude", "N m")
    exact = known_block()["magnitude"].value.subs({a: Rational(1, 50), M: 3, omega: 30 * pi})
    assert found.value == exact
    assert found.step.key == "magnitude_value"
    assert found.parents == (known_block()["magnitude"],)


def test_a_value_is_an_approximation_checked_in_floating_point() -> None:
    grades = {e.claim: e.grade for e in valued("magnitude", "N m").step.evidence}
    assert grades.pop("floats") in {Grade.PROVED, Grade.SAMPLED}
    assert grades.pop("line 1 equals the left side") is Grade.PROVED
    assert list(grades.values()) == [Grade.APPROXIMATION]


def test_a_value_that_is_exact_in_so_many_figures_is_not_called_rounded() -> None:
    block = known_block()
    inertia = value_of(
        block["inertia_tensor_xx"], {a: Amount(ONE, "m", ONE), M: Amount(Integer(12), "kg", ONE)}, "kg m^2", ONE, 4
    )
    assert inertia is not None
    assert inertia.step.chain[-1].because == "value"
    assert printed(inertia) == "13.00 kg m^2"


def test_a_coefficient_is_rounded_in_front_of_its_letters() -> None:
    assert coefficient_of(known_block()["magnitude"], 4) is None  # sqrt(42)/28 M a^2 omega^2
    found = coefficient_of(known_block()["magnitude"], 4, of_vectors=True)
    assert found is not None
    number, letters = found.step.result.args
    assert (decimal_text(number), letters) == ("0.2315", M * a**2 * omega**2)
    assert found.value == known_block()["magnitude"].value


@pytest.mark.parametrize("key", ["energy_about_axis", "torque", "kinetic_energy", "cosine", "inertia_tensor"])
def test_a_rational_coefficient_a_sum_a_vector_and_a_plain_number_have_none(key: str) -> None:
    assert coefficient_of(known_block()[key], 4) is None


def test_a_vector_of_rational_numbers_is_rounded_behind_its_letters_where_that_is_asked() -> None:
    found = coefficient_of(known_block()["torque"], 4, of_vectors=True)
    assert found is not None
    letters, numbers = found.step.result.args
    assert ([decimal_text(n) for n in numbers], letters) == (["-0.1786", "0.1429", "-0.03571"], M * a**2 * omega**2)
    assert found.value == known_block()["torque"].value


c = Symbol("c", positive=True)
NEAR = [Rational(39_999, 1000), 40 - Rational(1, 10**12), 40 + Rational(1, 10**30)]


def near_critical(value: Any, width: Expr) -> Quantity | None:
    """The value of what vanishes where c = 2 a, for a = 20 cm and a width of nearly 40 cm."""
    made = establish(made_up("test.made"), Symbol("s"), lambda: value, {})
    return value_of(made, {a: Amount(Integer(20), "cm", CENTI), c: Amount(width, "cm", CENTI)}, "", ONE, 6)


@pytest.mark.parametrize("width", NEAR, ids=str)
@pytest.mark.parametrize(
    "value",
    [(4 * a**2 - c**2) / a**2, sqrt(abs(2 * a - c)) / a, 1 / (2 * a - c), acos(c / (2 * a)), 1 - sin(pi * c / a / 4)],
)
def test_what_nearly_cancels_is_compared_in_digits_enough(value: Expr, width: Expr) -> None:
    found = near_critical(value, width)
    if found is not None:  # else it is imaginary
        exact = value.subs({a: Rational(1, 5), c: width / 100}).evalf(30)
        assert abs(found.step.result.args[0] / exact - 1) < Rational(1, 10**5)


def test_a_value_that_differs_by_little_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    value = (4 * a**2 - c**2) / a**2
    for slip in (Integer(2), 1 + Rational(1, 10**9), 1 - Rational(1, 10**14)):
        monkeypatch.setattr(numbers, "bound", lambda expr, values, slip=slip: bound(expr, values) * slip)
        with pytest.raises(Unverified) as refused:
            near_critical(value, NEAR[0])
        assert "its check `floats` disagrees" in refused.value.complaints[0].message


@pytest.mark.parametrize("width", [*NEAR, Integer(40)], ids=str)
def test_an_inequality_is_told_by_numbers_however_near(width: Expr) -> None:
    condition = establish(
        made_up("test.condition"),
        None,
        lambda: Relation(sqrt(2) * c, ">", sqrt(8) * a),
        {},
        lines=Lines(arranged=lambda r: r),
    )
    found = comparison_of(condition, {a: Amount(Integer(20), "cm", CENTI), c: Amount(width, "cm", CENTI)})
    assert found is not None
    assert found.value.operator == (">" if width > 40 else "<" if width < 40 else "=")
    assert found.step.outcome == ("fulfilled" if width > 40 else "not_fulfilled")


@settings(max_examples=30, deadline=None, derandomize=True)
@given(st.integers(1, 10**6), st.integers(-9, 9), st.integers(2, 9))
def test_any_number_put_in_agrees_with_plain_arithmetic(number: int, power: int, figures: int) -> None:
    side = Rational(number) * Rational(10) ** power
    found = valued("energy_about_axis", "J", figures=figures, amounts={**AMOUNTS, a: Amount(side, "m", ONE)})
    plain = 7 / 24 * 3 * float(side) ** 2 * (30 * 3.141592653589793) ** 2
    assert abs(float(printed(found).split()[0]) / plain - 1) < 0.51 * 10.0 ** (1 - figures) + 1e-12


@pytest.mark.parametrize(("width", "word"), [(41, "fulfilled"), (40, "not_fulfilled"), (39, "not_fulfilled")])
def test_of_a_condition_it_is_told_whether_the_given_number_fulfils_it(width: int, word: str) -> None:
    condition = establish(
        made_up("test.condition"), None, lambda: Relation(c, ">", 2 * a), {}, lines=Lines(arranged=lambda r: r)
    )
    amounts = {a: Amount(Integer(20), "cm", CENTI), c: Amount(Integer(width), "cm", CENTI)}
    found = value_of(condition, amounts, "m", ONE, 4, more=[("cm", CENTI)])
    assert found is not None
    told = dict(found.step.roles)["given"]
    assert (told.left, printed_amount(told.right)) == (c, f"{width} cm")
    assert dict(found.step.words)["seen"] == word
    alone = value_of(condition, {a: amounts[a]}, "m", ONE, 4)
    assert alone is not None and "given" not in dict(alone.step.roles), "the letter has no number"


def printed_amount(amount: Amount) -> str:
    return f"{amount.args[0]} {amount.args[1].name}"
