"""Left sides that only name what is meant are passed over; what could be a value is not."""

from __future__ import annotations

import pytest

from derive.course.latex.titles import is_derivative, without_title
from tests.course.latex.test_cursor import run
from tests.course.latex.test_tokens import tokens

TITLES = [
    r"U(\theta)",
    r"U(\theta=0)",
    "U(a,b)",
    "U'",
    r"U^{\prime}(a)",
    r"\frac{d}{dt} L",
    r"\frac{dU}{da}",
    r"\frac{\partial L}{\partial a}",
    r"\frac{d}{dt}\frac{\partial L}{\partial a}",
]
VALUES = [
    "U",
    "2",
    "U(2)",
    "U(a+b)",
    "2U(a)",
    "U(a)b",
    "-U(a)",
    "(a)",
    r"\frac{a}{b}",
    r"\frac{d}{dt} 2",
    r"\frac{d}{2}",
]


@pytest.mark.parametrize("title", TITLES)
def test_a_name_is_passed_over_up_to_its_relation(title: str) -> None:
    here = run(f"{title} = b = c")
    without_title(here)
    assert here.written == "="
    assert here.at == len(tokens(title))


@pytest.mark.parametrize("value", VALUES)
def test_what_could_be_a_value_stays(value: str) -> None:
    here = run(f"{value} = b")
    without_title(here)
    assert here.at == 0


@pytest.mark.parametrize("title", TITLES)
def test_without_a_relation_nothing_is_a_title(title: str) -> None:
    here = run(title)
    without_title(here)
    assert here.at == 0


@pytest.mark.parametrize(
    ("text", "derivative"),
    [(r"\dfrac{d}{dt}", True), (r"\frac{da}{\partial b}", False), (r"\frac{a}{d}", False), (r"\sqrt{d}", False)],
)
def test_a_derivative_has_the_same_d_above_and_below(text: str, derivative: bool) -> None:
    assert is_derivative(tokens(text)[0]) is derivative
