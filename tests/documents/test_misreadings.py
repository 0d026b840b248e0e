r"""Formulas that are easily misread: each has a reading that is wrong in physics and looks right to a parser."""

from __future__ import annotations

import pytest

from derive.audit.claims import Outcome
from tests.documents.reading import audit, values


def sides(text: str) -> list[tuple[str, str]]:
    return values(text)


def test_a_value_at_an_instant_is_not_a_product_with_zero() -> None:
    assert dict(sides("Let $x(t)$ be the place, $x(0) = a$, $\\dot x(0) = 0$."))["x(0)"] == "a"
    assert audit("The place $x$ starts with $x(0) = a$.").claims[0].values is not None
    assert "0*x" not in str(audit("The place $x$ starts with $x(0) = a$.").claims[0].values)


def test_an_angle_at_an_instant_is_not_a_product() -> None:
    found = sides("Let $\\theta(t)$ be the angle. Then $\\theta(t_0) = b$.")
    assert found == [("theta(t_0)", "b")]


def test_a_function_of_a_sum_is_not_a_product() -> None:
    assert sides("Let $x(t)$ be the place. Then $x(a+h) = b$.") == [("x(a + h)", "b")]


def test_a_potential_at_a_place_is_not_a_product() -> None:
    assert sides("The energy $V(q)$ is $V(q) = k q^2$, so that $V(q_r) = b$.")[-1] == ("V(q_r)", "b")


def test_a_vector_minus_its_length_is_not_zero() -> None:
    (claim,) = audit("$\\vec a - a = 0$").claims
    assert claim.verdict is not None and claim.verdict.outcome is Outcome.DEFINES  # an equation between two letters


def test_the_square_of_a_vector_is_not_the_square_of_an_edge() -> None:
    claims = audit("The edge is $a = 2$. Then $\\vec a^2 = b$.").claims
    assert claims[1].values is not None and str(claims[1].values[0]) == "a_1**2 + a_2**2 + a_3**2"


def test_a_scalar_product_of_vectors_is_not_a_product_of_numbers() -> None:
    text = "Let $\\vec\\omega = (0, 0, b)$ and $\\vec L = (d, 0, f)$. Then $T = \\frac12 \\vec\\omega \\cdot \\vec L$."
    claims = audit(text).claims
    assert claims[2].values is not None and {str(each) for each in claims[2].values[1].free_symbols} == {
        "omega_1", "omega_2", "omega_3", "L_1", "L_2", "L_3",
    }  # fmt: skip
    assert audit(text + " So $T = \\frac12 b f$.").claims[3].verdict.outcome is Outcome.HOLDS  # type: ignore[union-attr]


def test_a_segment_between_two_points_is_one_length() -> None:
    ((left, right),) = sides("The distance is $\\overline{PB} = 2 a$.")
    assert (left, right) == ("bar PB", "2*a")
    (claim,) = audit("The distance $\\mathrm{PB} = 2 a$.").claims
    assert claim.values is not None and str(claim.values[0]) == "PB"


def test_a_difference_of_a_letter_is_one_letter() -> None:
    ((left, right),) = sides("$\\Delta y = y_2 - y_1$")
    assert "*" not in left and right == "-y_1 + y_2"
    assert sides("$v = \\frac{\\Delta x}{\\Delta t}$")[0][1] == f"{_delta('x')}/{_delta('t')}"


def _delta(letter: str) -> str:
    ((left, _),) = values(f"$\\Delta {letter} = b$")
    return left


@pytest.mark.parametrize(
    ("written", "value"),
    [("3\\,\\mathrm{m}", "3"), ("20\\,\\text{cm}", "1/5"), ("5\\ \\mathrm{km}", "5000"), ("\\SI{2}{\\kg}", "2")],
)
def test_a_unit_is_not_a_letter(written: str, value: str) -> None:
    claims = audit(f"The mass is $m$. Let $a = {written}$.").claims
    assert claims[0].values is not None and str(claims[0].values[1]) == value


@pytest.mark.parametrize("written", ["v \\cos\\theta t", "v \\cos\\theta\\, t", "v t \\cos\\theta", "v\\cos(\\theta)t"])
def test_a_factor_after_an_angle_is_not_part_of_it(written: str) -> None:
    ((_, right),) = sides(f"$x = {written}$")
    assert right == "t*v*cos(theta)"


def test_a_comma_in_a_subscript_is_a_label() -> None:
    ((left, right),) = sides("$S_{,q} = p$")
    assert "*" not in left and "S" in left and right == "p"


@pytest.mark.parametrize("written", ["A \\sin 2\\omega t", "A\\sin\\omega t + b", "\\cos \\omega_1 t"])
def test_a_rate_times_the_time_is_the_argument(written: str) -> None:
    ((_, right),) = sides(f"$x = {written}$")
    assert "t)" in right


def test_a_factor_before_a_bracket_is_no_function() -> None:
    assert sides("$F = k(a - x)$, $k = 2 b$")[0][1] == "k*(a - x)"


def test_a_derivative_by_an_index_letter_is_one_symbol() -> None:
    ((left, _),) = sides("$\\frac{dU}{dq_r} = b$")
    assert left == "dU/dq_r"


def test_a_derivative_by_a_rate_finds_the_rate_with_its_argument() -> None:
    text = "The function $y(x)$ is not known.\n\n$$f = \\sqrt{1 + y'(x)^2}$$\n\n"
    row = "$$\\frac{\\partial f}{\\partial y'} = \\frac{\\partial}{\\partial y'} \\sqrt{1 + y'(x)^2}$$"
    claims = audit(text + row).claims
    assert claims[1].values is not None and claims[1].values[1] != 0
    assert claims[1].verdict is not None and claims[1].verdict.outcome is Outcome.HOLDS


def test_no_change_is_suggested_that_repeats_a_side_of_the_chain() -> None:
    text = "$$\\frac{df}{dY} = \\frac{df}{dy} \\frac{dy}{dY} = \\frac{df}{dy}$$"
    assert all(each.verdict is None or each.verdict.outcome is not Outcome.DIFFERS for each in audit(text).claims)


@pytest.mark.parametrize("zero", [r"\vec 0", r"\mathbf{0}", r"\bm{0}"])
def test_a_bold_zero_is_the_vector_zero_and_not_a_letter(zero: str) -> None:
    (claim,) = audit(rf"$\vec r \times \vec r = {zero}$").claims
    assert claim.values is not None and not claim.values[1].free_symbols
    assert claim.verdict is not None and claim.verdict.outcome is Outcome.HOLDS


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("x(1)", "x(1)"),
        ("G(x_0, y_0) - G(x, y)", "-G + G(x_0,y_0)"),
        ("\\frac{\\partial L}{\\partial q^j}", "dL/dq^j"),
        ("S[q] - S", "0"),
        ("c[a + b]", "c*(a + b)"),
        ("O(b^2) + 1", "1"),
    ],
)
def test_a_function_of_an_argument_is_not_a_product(written: str, value: str) -> None:
    assert values(f"$${written} = k$$")[0][0] == value


def test_a_vector_that_is_differentiated_by_time_changes() -> None:
    assert "r_1." in values("$$ \\frac{d \\mathbf r}{dt} = 0 $$")[0][0]


def test_a_function_of_the_variable_of_an_integral_is_not_constant() -> None:
    text = "$$ f = \\int_0^a g(x)\\, dx $$ $$ \\mathbf{h} = \\int_0^t \\mathbf r(t') dt' $$"
    scalar, vector = values(text)
    assert scalar[1].startswith("Integral(g") and "Integral(r_1" in vector[1]
