"""Limiting cases: what the textbooks check an answer by, of numbers, vectors, tensors and equations."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from sympy import Abs, Expr, Integer, Matrix, Rational, Symbol, cos, diag, exp, log, oo, pi, sin, sqrt, symbols, tanh

from derive.algebra.equality import Grade, equal
from derive.algebra.expansion import Approach
from derive.algebra.expressions import TIME, Relation, scalar
from derive.errors import Rejected, Unverified
from derive.mechanics import (
    Cone,
    angular_momentum,
    coordinate,
    inertia_tensor,
    known_case,
    let,
    limiting_case,
    momentary_angular_velocity,
    moved_to,
    principal_moments,
    put_in,
)
from derive.mechanics.answers import limits
from derive.solving import leading
from derive.steps.record import Run, recorded
from derive.steps.step import Form, Quantity

M, m, g, l, R, h, a, b, k, v = symbols("M m g l R h a b k v", positive=True)
I_x, I_z, S, w = symbols("I_x I_z S omega", positive=True)
theta, alpha = symbols("theta alpha", real=True)
ROOT = sqrt(I_z**2 * S**2 - 4 * I_x * M * g * l * cos(theta))
SLOW, FAST = ((I_z * S + sign * ROOT) / (2 * I_x * cos(theta)) for sign in (-1, 1))


def given(value: Any, key: str = "f", **more: Any) -> Quantity:
    return let(key, lambda: value, **more)


@pytest.mark.parametrize(
    ("value", "letter", "to", "found", "outcome"),
    [
        (SLOW, S, oo, M * g * l / (I_z * S), "vanishes"),  # Goldstein, eq. (5.81)
        (FAST, S, oo, I_z * S / (I_x * cos(theta)), "diverges"),  # free precession, eq. (5.82)
        (SLOW, theta, pi / 2, M * g * l / (I_z * S), "finite"),  # exact for a horizontal axis
        (g * (M - m) / (M + m), M, oo, g, "finite"),  # Atwood: free fall
        (g * (M - m) / (M + m), M, m, g * (M - m) / (2 * m), "vanishes"),
        (v * (1 - exp(-k * l / m)), l, oo, v, "finite"),  # terminal speed
        (v * tanh(g * l / v), l, oo, v, "finite"),
        (v * tanh(g * l / v), l, 0, g * l, "vanishes"),  # free fall at first
        (2 * M * (h**5 - R**5) / (5 * (h**3 - R**3)), h, R, 2 * M * R**2 / 3, "finite"),  # a thin shell
        (sqrt(g * M / (R + h)), h, 0, sqrt(g * M / R), "finite"),
        (sin(theta) / theta, theta, 0, Integer(1), "finite"),
        (M * (R**2 / 4 + h**2 / 3), h / R, 0, M * R**2 / 4, "finite"),  # a disc
        (M * (R**2 / 4 + h**2 / 3), h / R, oo, M * h**2 / 3, "diverges"),  # a rod
        (sqrt(R + h) - sqrt(R), h, oo, sqrt(h), "diverges"),  # half a power, which no series has
        (M + m * (h / R) ** Rational(1, 4), h, 0, M, "finite"),  # the rest falls by a quarter of a power
        (5 * m * a, a, 0, Integer(0), "finite"),  # of one power the limit says more than itself
        (5 * m * a, a, oo, 5 * m * a, "exact"),
    ],
)
def test_a_result_goes_to_what_the_textbooks_say(value: Expr, letter: Expr, to: Any, found: Expr, outcome: str) -> None:
    limit = limiting_case(given(value), letter, to)
    assert equal(limit.value, found)
    assert limit.step.outcome == outcome


def test_of_a_condition_the_border_goes_to_a_limit() -> None:
    least, largest = (given(Relation(S, mark, 2 * sqrt(I_x * M * g * l) / I_z)) for mark in (">=", "<="))
    limit = limiting_case(least, l)
    assert (limit.value, limit.symbol.name, limit.step.outcome) == (0, "S_min_lim", "finite")
    largest_limit = limiting_case(largest, l)
    assert (largest_limit.symbol.name, largest_limit.step.approximates.name) == ("S_max_lim", "S_max")
    assert [e.claim for e in limit.step.evidence][-2:] == ["arithmetic", "numbers"]


def test_a_limit_is_proved_and_a_leading_term_said_to_its_order() -> None:
    finite, leading_term = limiting_case(given(FAST, "p"), theta, pi), limiting_case(given(SLOW), S, oo)
    assert (finite.step.grade, leading_term.step.grade) == (Grade.PROVED, Grade.APPROXIMATION)
    assert [e.claim for e in leading_term.step.evidence][-2:] == ["arithmetic", "numbers"]
    assert [limit.step.chain[-1].because for limit in (finite, leading_term)] == ["limit", "series"]


def test_of_a_tensor_what_is_small_beside_its_largest_entry_vanishes() -> None:
    cone = Cone(R, h, M)
    centre = moved_to(inertia_tensor(cone, about="apex", key="apex"), cone.centre)
    needle, flat = limiting_case(centre, R, 0, key="needle"), limiting_case(centre, h, 0, key="flat")
    assert needle.value == 3 * M * h**2 / 80 * diag(1, 1, 0)
    assert flat.value == 3 * M * R**2 / 20 * diag(1, 1, 2)
    assert needle.symbol.name == f"{centre.symbol.name}_lim" and needle.step.kind == "moment of inertia"
    moments = limiting_case(principal_moments(centre), R, 0, key="moments")
    assert moments.value == 3 * M * h**2 / 80 * Matrix([1, 1, 0])
    velocity = momentary_angular_velocity((w, 0, w), through="centre")
    long = limiting_case(angular_momentum(centre, velocity), h, oo, key="long")
    assert long.value == 3 * M * h**2 * w / 80 * Matrix([1, 0, 0])


def test_an_equation_that_gives_a_letter_goes_by_its_right_side() -> None:
    limit = limiting_case(given(Relation(v, "=", sqrt(g * l * (1 + m / M)))), M, oo)
    assert (limit.symbol.name, limit.step.approximates, limit.value) == ("v_infty", v, sqrt(g * l))


def test_any_other_equation_is_that_of_its_leading_terms() -> None:
    with recorded(Run()):
        x = coordinate("x", "length")
        motion = given(Relation((M + m) * x.acceleration + k * x.symbol, "=", 0))
        heavy = limiting_case(motion, m, 0)
        assert equal(heavy.value, Relation(M * x.acceleration + k * x.symbol, "=", Integer(0)))
        with pytest.raises(Rejected, match="has no symbol of its own"):
            limiting_case(motion, m, 0, symbol="y")


def test_letters_that_are_put_equal_are_put_in() -> None:
    cube = put_in(given(M * (b**2 + h**2) / 12), {b: a, h: a})
    assert cube.value == M * a**2 / 6


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda: limiting_case(given(sin(k * a)), a, oo), "no expansion"),  # it oscillates
        (lambda: limiting_case(given(2 + sin(k * a) / a), a, oo), "no expansion"),
        (lambda: limiting_case(given(exp(-k * a)), a, oo), "no expansion"),  # faster than any power
        (lambda: limiting_case(given(log(a)), a, oo), "no expansion"),
        (lambda: limiting_case(given(M * g), S, oo), "does not contain S"),
        (lambda: limiting_case(given(M * g * TIME), TIME), "changes in the motion"),
        (lambda: limiting_case(given(M * a), Symbol("M") + Symbol("a")), "must be a symbol"),
    ],
)
def test_what_has_no_limit_is_refused(wrong: Callable[[], Any], said: str) -> None:
    with pytest.raises(Rejected, match=said):
        wrong()


def test_a_coordinate_is_not_small_all_the_time() -> None:
    with recorded(Run()):
        x = coordinate("x", "length")
        with pytest.raises(Rejected, match="x changes in the motion"):
            limiting_case(given(k * x.symbol**2 / 2 + M * g * x.symbol), x, 0)


def test_a_place_with_two_leading_terms_has_none() -> None:
    """|M - m| falls to 0 from either side; its leading term m - M holds on one side alone."""
    with pytest.raises(Unverified):
        limiting_case(given(g * Abs(M - m)), M, m)


@pytest.mark.parametrize("value", [SLOW, FAST, sqrt(g / l) * (1 + S**-2)])
@pytest.mark.parametrize("slip", [Integer(-1), Integer(2), Rational(1001, 1000)])
def test_a_wrong_leading_term_is_refused(value: Expr, slip: Expr, monkeypatch: pytest.MonkeyPatch) -> None:
    right = leading.expanded
    monkeypatch.setattr(leading, "expanded", lambda *of: {n: slip * c for n, c in right(*of).items()})
    with pytest.raises(Unverified):
        limiting_case(given(value), S, oo)


def test_a_second_route_of_a_wrong_power_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "_as_it_goes", lambda power: "diverges")
    with pytest.raises(Unverified, match="could not be confirmed"):
        limiting_case(given(SLOW), S, oo)


def test_a_letter_within_a_range_is_tried_where_it_may_be() -> None:
    tilt = scalar("theta_0", positive=True)
    assert limiting_case(given(M * g * sin(tilt)), tilt).value == M * g * tilt


def test_a_limit_that_is_known_from_elsewhere_agrees_with_it_by_a_step() -> None:
    """Morin, section 1.1: a heavy block falls as fast as a free one; a shell is a thin hollow sphere."""
    hollow = given(2 * M * (h**5 - R**5) / (5 * (h**3 - R**3)), "hollow", symbol="I")
    shell = given(2 * M * R**2 / 3, "shell", symbol="I_0")
    agreed = known_case(limiting_case(hollow, h, R), shell)
    assert (agreed.value, agreed.step.grade) == (2 * M * R**2 / 3, Grade.PROVED)
    assert agreed.step.inputs == ("hollow_limit", "shell")


def _with_its_own_copy(limit: Quantity) -> tuple[Quantity, Quantity]:
    return limit, let("copy", lambda value: value, limit, symbol="I_0")


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda hollow: known_case(limiting_case(hollow, h, R), given(M * R**2 / 3, "other", symbol="I_0")), "is"),
        (lambda hollow: known_case(limiting_case(hollow, h, R), hollow), "would prove nothing"),
        (lambda hollow: known_case(*_with_its_own_copy(limiting_case(hollow, h, R))), "would prove nothing"),
    ],
)
def test_what_is_not_known_or_not_from_elsewhere_is_refused(wrong: Callable[[Quantity], Any], said: str) -> None:
    hollow = given(2 * M * (h**5 - R**5) / (5 * (h**3 - R**3)), "hollow", symbol="I")
    with pytest.raises(Rejected, match=said):
        wrong(hollow)


SAID_WRONG: dict[str, tuple[str, Any]] = {
    "equal, not in the limit": ("_last_line", lambda found, *_: Form(found, "result")),
    "it vanishes, of two terms": ("_sort_of", lambda place: "vanishes"),
    "no place that it goes to": ("Approach", lambda goes, aim: goes),
    "another letter goes there": ("Approach", lambda goes, aim: Approach(m, aim)),
    "it goes somewhere else": ("Approach", lambda goes, aim: Approach(goes, oo)),
}


@pytest.mark.parametrize("slip", SAID_WRONG)
def test_a_limit_is_told_as_it_is(slip: str, monkeypatch: pytest.MonkeyPatch) -> None:
    name, wrong = SAID_WRONG[slip]
    monkeypatch.setattr(limits, name, wrong)
    with pytest.raises(Unverified):
        limiting_case(given(k + k**2 / (1 + k)), k, 0, order=2)


@pytest.mark.parametrize(("wrong", "at"), [("limit", 1), ("result", 0)])
def test_a_leading_term_is_no_limit_and_a_limit_is_not_equal(wrong: str, at: int, monkeypatch: Any) -> None:
    monkeypatch.setattr(limits, "_last_line", lambda found, *_: Form(found, wrong))
    with pytest.raises(Unverified):
        limiting_case(given(k**at / (1 + k)), k)
