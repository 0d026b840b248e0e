"""Chains, sums, products and factors: what binds how closely, and what is left open is refused."""

from __future__ import annotations

import pytest
from sympy import Rational, pi

from tests.course.latex.formula import complaint, letter, marked, read, value

a, b, h, n = (letter(name) for name in "abhn")


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("-a^2", -(a**2)),
        ("a - b - h", a - b - h),
        ("-a + b", b - a),
        ("a/2 - b", a / 2 - b),
        (r"2 \cdot 3 a", 6 * a),
        (r"\frac{a}{2} b^{-1}", a / (2 * b)),
        (r"\sqrt[3]{n^3 8}", 2 * (n**3) ** Rational(1, 3)),
        (r"60^\circ", pi / 3),
        (r"\frac12\frac12 a", a / 4),
    ],
)
def test_powers_bind_before_products_and_products_before_sums(text: str, meant: object) -> None:
    assert (value(text) - meant).simplify() == 0


@pytest.mark.parametrize("text", ["a/2b", "a/b/h", "1/2 a", "2 3", "a2", r"2\frac12 a", "a^23"])
def test_what_has_two_readings_on_paper_has_none_here(text: str) -> None:
    assert marked(text)[0] == "ambiguous"
    assert complaint(text).help


@pytest.mark.parametrize("text", ["a +", "+ * a", "a = = b", "a =", r"a \cdot", "a,b", "a)", "a^", "^2"])
def test_what_is_not_finished_or_out_of_place_is_refused(text: str) -> None:
    assert marked(text)[0] == "latex"


def test_a_sign_of_both_kinds_is_plus_in_one_branch_and_minus_in_the_other() -> None:
    assert [value(r"a \mp b", branch) for branch in (0, 1)] == [a - b, a + b]
    most_two = "a value can have at most two alternatives, from one `or` or from `\\pm`"
    assert complaint(r"a \pm b \text{ or } h").message == most_two
    assert complaint(r"a \text{ or } b \text{ or } h").message == most_two


def test_every_relation_begins_a_side() -> None:
    assert read(r"a < b \le h").marks == ("", "<", "<=")
    assert read(r"\approx a").marks == ("~",)
