"""The audit finds slips at their rows, follows what is right, and accuses nothing that it does not know."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from derive.audit.claims import Claim
from derive.audit.report import as_data, as_html, as_json, as_text, exit_code
from derive.cli.options import main
from tests.documents.reading import audit, outcomes

RIGHT = r"""# Problem 1

A rod of mass $M$ and length $l$ turns about one end. Its density is $\lambda = M/l$.

$$
\begin{aligned}
I &= \int_0^l \lambda x^2 \, dx \\
  &= \lambda\left[\frac{x^3}{3}\right]_0^l \\
  &= \frac{1}{3} \lambda l^3 \\
  &= \frac{1}{3} M l^2
\end{aligned}
$$

The height of its centre is $y = -\frac{l}{2}\cos\theta$, so

$$ U = M g y = -\frac{1}{2} M g l \cos\theta $$

and with $T = \frac{1}{2} I \dot\theta^2$ and $L = T - U$ we find

$$
\begin{aligned}
\frac{\partial L}{\partial \dot\theta} &= I \dot\theta = \frac{1}{3} M l^2 \dot\theta \\
\frac{\partial L}{\partial \theta} &= -\frac{1}{2} M g l \sin\theta
\end{aligned}
$$

so that

$$ \frac{1}{3} M l^2 \ddot\theta = -\frac{1}{2} M g l \sin\theta $$

For small angles, $\sin\theta \approx \theta$, hence

$$ \ddot\theta = -\frac{3 g}{2 l} \theta $$
"""

SLIPS = {  # what is changed in the text -> what is proposed
    "a number": (r"\frac{x^3}{3}", r"\frac{x^3}{2}", "3 instead of 2"),
    "an exponent": (r"&= \frac{1}{3} \lambda l^3", r"&= \frac{1}{3} \lambda l^2", "3 instead of 2"),
    "a sign": (r"M g y = -\frac{1}{2} M g l \cos\theta", r"M g y = \frac{1}{2} M g l \cos\theta", None),
    "a function": (r"-\frac{1}{2} M g l \sin\theta\n\\end", r"-\frac{1}{2} M g l \cos\theta\n\\end", None),
    "a factor": (
        r"&= I \dot\theta = \frac{1}{3} M l^2 \dot\theta",
        r"&= I \dot\theta = \frac{1}{3} M l \dot\theta",
        "l^2",
    ),
    "an index": (r"&= \frac{1}{3} M l^2\n", r"&= \frac{1}{3} M l^2 \cdot 2\n", None),
}


def wrong(text: str) -> list[Claim]:
    return [each for each in audit(text).claims if each.verdict is not None and str(each.verdict.outcome) == "differs"]


def test_nothing_is_wrong_in_a_right_document() -> None:
    assert wrong(RIGHT) == []
    assert "unreadable" not in outcomes(RIGHT)


def test_most_claims_of_a_right_document_are_decided() -> None:
    found = outcomes(RIGHT)
    assert found.count("undecided") <= 1


@pytest.mark.parametrize(("right", "slip", "proposal"), list(SLIPS.values()), ids=list(SLIPS))
def test_a_slip_is_found_at_its_row(right: str, slip: str, proposal: str | None) -> None:
    right, slip = (
        right.replace(r"\n", "\n").replace(r"\\end", r"\end"),
        slip.replace(r"\n", "\n").replace(r"\\end", r"\end"),
    )
    text = RIGHT.replace(right, slip, 1)
    assert text != RIGHT
    line = text[: text.index(slip)].count("\n") + 1
    found = wrong(text)
    assert line in [claim.row.line for claim in found] or line + 1 in [claim.row.line for claim in found]
    assert all(claim.row.line >= line - 1 for claim in found)
    if proposal:
        assert any(claim.verdict is not None and proposal in claim.verdict.suggestion for claim in found)


def test_the_row_after_a_slip_is_not_blamed_for_it() -> None:
    text = (
        "$$\n\\begin{aligned}\nE &= (a + b)^2 \\\\\n&= a^2 + 3 a b + b^2 \\\\\n&= b^2 + 2 a b + a^2\n\\end{aligned}\n$$"
    )
    assert [claim.row.line for claim in wrong(text)] == [4]


def test_a_row_that_follows_from_a_wrong_row_carries_its_slip_on() -> None:
    text = "Let $x = a t^2$ change with time $t$. Then $\\dot x = 3 a t$. Hence $\\ddot x = 3 a$."
    claims = audit(text).claims
    assert [str(each.verdict.outcome) for each in claims if each.verdict] == ["defines", "differs", "holds"]
    assert claims[2].verdict is not None and claims[2].verdict.inherits == 1


@pytest.mark.parametrize(
    "text",
    [
        "To first order, $\\sin\\theta = \\theta$.",
        "$\\sqrt{a^2} = a$ for a length $a$.",
        "For $\\theta = 0$ the force $F = m g \\cos\\theta$ becomes $F = m g$.",
        "$x = 0.92951$ and $y = \\frac{7}{12}\\sqrt{\\frac{1008}{397}} = 0.92951$",
        "$\\cos n\\pi = (-1)^n$",
        "$E = \\frac{1}{2} m v^2 + U = \\text{const}$",
        "$S^2 \\geq 4 a \\geq 3 a$",
        "$\\dot\\phi = 49.98 \\pm 48.40$ or $\\dot\\phi = 98.38$ or $1.58$",
        "$\\int_V \\rho \\, dV = M = \\rho V$",
        "The commutator is $k [X, P^2] = k (P [X, P] + [X, P] P) = 2 k h P$.",
        "The Poisson bracket is $\\{f, g h\\} = \\{f, g\\} h + g \\{f, h\\}$, so $\\{f, g^2\\} = 2 g \\{f, g\\}$.",
        "The inner product has $\\langle a, c b \\rangle = c \\langle a, b \\rangle = c d$.",
        "$\\mathbf{J} = \\begin{pmatrix} \\mathbf{0} & \\mathbf{I} \\\\ -\\mathbf{I} & \\mathbf{0} \\end{pmatrix}$, "
        "so $\\mathbf{J}^T = \\mathbf{J}^{-1} = -\\mathbf{J}$",
        "$z_i = x_i$, so $Y = \\sum_i z_i y_i = \\sum_i x_i y_i$",
        "$x_\\nu x^\\nu = s$, so $a = 4 x_\\nu x^\\nu - 2 x^\\nu x_\\nu = 2 x_\\nu x^\\nu$",
        "$$ T = \\frac12 m a^2 \\dot\\theta^2 $$\n\n$$ V = m g a \\cos\\theta $$\n\n$$ L = T - V $$\n\n"
        "$$ E = \\dot q_i \\frac{\\partial L}{\\partial \\dot q_i} - L = T + V $$",
        "$$ \\frac12 m v^2 - \\frac{k}{R} = 0 $$\n\n$$ v_\\theta = \\sqrt{\\frac{k}{m R}} $$",
        "# Notes\n\n**Problem 1**\n\n$$ m \\ddot x = -k x $$\n\n**Problem 2**\n\n$$ m \\ddot x = -2 k x $$",
        "The origin is $P = O$.\n\n$$ f = \\frac{1 + b/2 + O(b^2)}{1 - b/2 + O(b^2)} = 1 + b + O(b^2) $$",
        "$$ h = G(x_0, y_0) - G(x, y) = a $$\n\n$$ \\frac{k}{G(x_0, y_0) - G(x, y)} = \\frac{k}{a} $$",
        "$$ x(1) = 3 $$\n\n$$ x = 3 t^2 $$",
        "$$ \\frac{d \\mathbf r}{dt} = \\mathbf{C} = \\mathbf{v} $$",
        "$$ a = A_{ij} B_{jk} = B_{ij} A_{jk} $$",
        "$$ W = \\int_{\\mathbf{r}_0}^{\\mathbf{r}_1} \\mathbf{F}\\, d\\mathbf{r} = \\frac12 m v^2 $$",
        "$f(x) = x^2$, so $f(a+h) = a^2 + 2 a h + h^2$",
    ],
)
def test_what_is_not_known_is_not_accused(text: str) -> None:
    assert wrong(text) == []


def test_a_potential_of_a_coordinate_is_differentiated() -> None:
    text = (
        "$$ L(r, \\theta) = \\frac12 m \\dot r^2 + \\frac12 m r^2 \\dot\\theta^2 - U(r) $$\n\n"
        "$$ F_r = \\frac{\\partial L}{\\partial r} = m r \\dot\\theta^2 - \\frac{d U}{d r} $$\n\n"
        "$$ m \\ddot r = m r \\dot\\theta^2 - \\frac{d U}{d r} $$"
    )
    assert outcomes(text) == ["defines", "defines", "holds", "holds"]
    assert outcomes(text.replace("- \\frac{d U}", "+ \\frac{d U}", 1))[2] == "differs"


def test_the_variable_of_an_integral_may_get_a_value() -> None:
    text = (
        "$$ \\begin{aligned} \\frac{k}{r^3} &= -\\frac{dV}{dr} \\\\ \\int dV &= -k \\int \\frac{dr}{r^3} \\\\"
        "V &= \\frac{k}{2 r^2} \\end{aligned} $$\n\n$$ E = V + \\int dV $$\n\n$$ E = \\frac{k}{r^2} $$"
    )
    assert "differs" not in outcomes(text)


def test_a_moment_about_an_axis_is_not_an_approximation() -> None:
    text = "The moment of inertia about the end is\n\n$$ I = \\int_0^l \\lambda x^2\\, dx = \\frac12 \\lambda l^3 $$"
    assert outcomes(text) == ["defines", "differs"]
    assert outcomes("It is about $$ a = \\sin x = x $$") == ["defines", "approximates"]


def test_the_limit_of_an_inner_integral_may_depend_on_the_outer_variable() -> None:
    text = (
        "The radius is $r = R z/h$. The volume is\n\n"
        "$$ V = \\int_0^h \\int_0^r 2 \\pi s\\, ds\\, dz = \\int_0^h \\pi r^2\\, dz $$"
    )
    assert outcomes(text)[-1] == "holds"


def test_a_coordinate_stays_fixed_in_a_partial_derivative() -> None:
    text = (
        "The curve is $y(x)$.\n\n$$ F = y^2 + y'^2 $$\n\n$$ \\frac{\\partial F}{\\partial y} = 2 y $$\n\n"
        "$$ \\frac{\\partial F}{\\partial x} = 0 $$"
    )
    assert outcomes(text) == ["defines", "holds", "holds"]


def test_the_derivative_of_a_value_follows_the_chain_rule() -> None:
    text = "$$ U(r) = -\\frac{k}{r} $$\n\n$$ \\frac{d}{du} U\\!\\left( \\frac{1}{u} \\right) = -k $$"
    assert outcomes(text) == ["defines", "holds"]
    unknown = (
        "$$ U(r) + c = 0 $$\n\n$$ c \\frac{d}{du} U(1/u) = -k $$\n\n$$ U = -k/r $$\n\n$$ \\frac{d}{du} U(1/u) = -k $$"
    )
    assert outcomes(unknown)[-1] == "holds"


def test_a_motion_that_satisfies_its_equation_holds() -> None:
    text = "$$ \\ddot x = -\\omega^2 x $$\n\n$$ x = A \\cos\\omega t + B \\sin\\omega t $$"
    assert outcomes(text)[-1] == "holds"
    assert outcomes(text.replace("A \\cos\\omega t", "A \\cos 2\\omega t"))[-1] != "holds"


def test_an_equation_of_motion_follows_from_the_lagrangian_alone() -> None:
    text = "$$ L = \\frac12 m \\dot x^2 - \\frac12 k x^2 $$\n\n$$ m \\ddot x + k x = 0 $$"
    assert outcomes(text)[-1] == "holds"
    assert outcomes(text.replace("m \\ddot x + k", "m \\ddot x + 2 k"))[-1] != "holds"


def test_a_row_goes_on_from_the_chain_and_not_from_an_aside() -> None:
    text = (
        "\\begin{align*}\nT &= m a^2 \\omega^2 \\qquad \\text{where } \\omega^2 = \\frac{g}{a} \\\\\n&= m g a\n"
        "\\end{align*}"
    )
    assert outcomes(text) == ["defines", "defines", "holds"]


def test_an_absolute_value_holds_for_one_sign() -> None:
    (claim,) = audit("$\\sqrt{(L - x)^2} = L - x$").claims
    assert claim.verdict is not None and claim.verdict.because == "the two sides are equal if L - x > 0"


def test_a_letter_is_used_again_in_another_part() -> None:
    assert outcomes("(a) $x = a^2$\n\n(b) $x = a^3$") == ["defines", "defines"]
    assert outcomes("We find $x = a^2$ and $x = a^3$") == ["defines", "undecided"]


def test_a_result_that_is_copied_wrongly_is_found() -> None:
    text = "(a) $T = \\frac{1}{2} m v^2 + m g h$\n\n(b) From part (a) we found $T = \\frac{1}{2} m v + m g h$."
    (claim,) = wrong(text)
    assert claim.verdict is not None and claim.verdict.suggestion == "v^2 instead of v"
    assert wrong(text.replace("we found", "it is clear that now").replace("From part (a)", "Here")) == []


def test_a_case_of_a_sentence_is_not_a_definition() -> None:
    text = (
        "$w = a + b$ and $s = w R$. In the limiting case $R = b$ we get $s = w b$.\n\n"
        "$$\\begin{aligned} s &= w R \\\\ &= (a + b) R \\end{aligned}$$"
    )
    assert outcomes(text)[-2:] == ["holds", "holds"] and wrong(text) == []


def test_a_value_at_a_place_is_not_the_value_elsewhere() -> None:
    text = "$$ U = k x^2 $$\n\n$$ \\left.\\frac{dU}{dx}\\right|_{x=a} = 2 k a $$"
    assert outcomes(text)[-1] == "holds"
    assert outcomes(text.replace("= 2 k a", "= 2 k x"))[-1] != "holds"


def test_a_momentum_stays_fixed_in_a_derivative_by_a_coordinate() -> None:
    text = (
        "$$ l = m r^2 \\dot\\phi $$\n\n$$ U = \\frac{l^2}{2 m r^2} + \\frac12 k r^2 $$\n\n"
        "$$ \\frac{dU}{dr} = -\\frac{l^2}{m r^3} + k r $$"
    )
    assert outcomes(text)[-1] == "holds"


def test_an_example_with_numbers_is_real() -> None:
    (claim,) = wrong("$$\\begin{aligned} E &= \\sqrt{1 - v^2} \\\\ &= 2 \\sqrt{1 - v^2} \\end{aligned}$$")
    assert claim.verdict is not None and "I" not in claim.verdict.counterexample


def test_the_order_of_the_terms_that_are_left_out_is_compared() -> None:
    text = "$\\sqrt{1 + y^2} = 1 + \\frac{y^2}{2} + \\mathcal{O}(y^4)$"
    (claim,) = audit(text).claims
    assert claim.verdict is not None and claim.verdict.because == "the error is of order 4 in `y`"
    ((slip,)) = audit(
        "$$\\begin{aligned} E &= \\sqrt{1 + y^2} \\\\ &= 1 - \\frac{y^2}{2} + \\mathcal{O}(y^4) \\end{aligned}$$"
    ).claims[1:]
    assert slip.verdict is not None and str(slip.verdict.outcome) == "differs"


def test_a_blank_is_not_a_claim() -> None:
    assert outcomes("$p = ?$ and $q = a$") == ["defines"]


def test_a_number_set_equal_to_a_list_is_a_slip() -> None:
    (claim,) = wrong("Let $\\vec L = (a, b, d)$. Then $\\vec L^2 = \\vec L \\cdot \\vec L = (a^2, b^2, d^2)$.")
    assert claim.verdict is not None and "number" in claim.verdict.because


def test_a_lost_differential_is_found() -> None:
    (claim,) = wrong(
        "\\begin{align*}\nI &= \\int_0^a dx \\int_0^b y \\, dy \\\\\n&= \\int_0^a x \\int_0^b y \\, dy\n\\end{align*}"
    )
    assert claim.verdict is not None and claim.verdict.suggestion == "d x instead of x"


def test_the_command_prints_the_slip_with_its_place(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "worked.md"
    file.write_text(RIGHT.replace(r"\frac{x^3}{3}", r"\frac{x^3}{2}", 1), encoding="utf-8")
    assert main(["audit", str(file)]) == 1
    told = capsys.readouterr().out
    assert ":8:30: row[differs]: the two sides are not equal" in told and "probably 3 instead of 2" in told
    file.write_text(RIGHT, encoding="utf-8")
    assert main(["audit", str(file)]) == 0


def test_json_has_each_row_with_its_verdict() -> None:
    data = json.loads(as_json(audit(RIGHT)))
    assert set(data) == {"file", "rows", "summary"} and sum(data["summary"].values()) == len(data["rows"])
    assert {
        "line",
        "latex",
        "reading",
        "verdict",
        "because",
        "given",
        "counterexample",
        "suggestion",
        "inherits",
        "confirmed",
    } == set(data["rows"][0])


def test_the_page_has_notes_beside_the_lines_of_the_document() -> None:
    page = as_html(audit(RIGHT.replace(r"\frac{x^3}{3}", r"\frac{x^3}{2}", 1)))
    line = page.partition('id="L8"')[2].partition("</div>")[0]
    assert "Read as" in line and line.index("Read as") < line.index("Probably 3 instead of 2: a number was mistyped.")
    assert '<a href="#L8">8</a>' in page and "A rod of mass $M$" in page
    assert "I found nothing to correct." in as_html(audit(RIGHT))


def test_every_row_shows_the_evidence_for_its_reading() -> None:
    assert "`f(a)`: " in as_text(audit("$f(x) = x^2$ and $f(a) = a^2$"), every=True)


def test_the_page_escapes_what_the_document_says() -> None:
    page = as_html(audit("$a <b = c$ and $<script> = 1$"))
    assert "<script>" not in page.partition("<body>")[2]
    assert exit_code(audit(RIGHT)) == 0 and "claims" in as_text(audit(RIGHT), every=True)


def test_a_wrong_row_lists_the_rows_that_repeat_it_and_the_summary_the_rows_that_are_not_read() -> None:
    text = (
        "Let $x = a t^2$ change with time $t$. Then $\\dot x = 3 a t$.\n\nHence $\\ddot x = 3 a$.\n\n$$d = (b + ) c$$\n"
    )
    told = as_text(audit(text), every=False)
    assert "repeated in line 3" in told
    assert "  line 5 is not read: " in told


def test_the_summary_lists_the_statements_that_nothing_confirms() -> None:
    text = "$$ N = m g \\cos\\alpha $$\n\n$$ v = \\sqrt{2 g h} $$\n\n$$ p = m v = m \\sqrt{2 g h} $$\n"
    found = audit(text)
    assert [claim.row.line for claim in found.unconfirmed] == [1]
    assert "no other row confirms what is stated in line 1" in as_text(found, every=False)
    assert [row["confirmed"] for row in as_data(found)["rows"]] == [False, True, True, True]


def test_a_letter_with_another_value_in_another_part_has_other_derivatives() -> None:
    text = """(a) The bead is free.
$$L = \\frac12 m \\dot x^2 - \\frac12 k x^2$$
$$\\frac{\\partial L}{\\partial x} = -k x$$
$$\\frac{d}{dt}\\frac{\\partial L}{\\partial \\dot x} = m \\ddot x$$

(b) The wire turns.
$$L = \\frac12 m \\dot x^2 + \\frac12 m \\omega^2 x^2 + m b \\dot x \\dot y - \\frac12 k x^2$$
$$\\frac{\\partial L}{\\partial x} = m \\omega^2 x - k x$$
$$\\frac{d}{dt}\\frac{\\partial L}{\\partial \\dot x} = m \\ddot x + m b \\ddot y$$
"""
    assert outcomes(text) == ["defines", "holds", "holds", "defines", "holds", "holds"]


@pytest.mark.parametrize(
    ("vector", "outcome"),
    [
        ("(-\\sin\\phi, \\cos\\phi, 0)", "differs"),
        ("(b, c, 0)", "defines"),
        ("(\\dot\\phi, 0, 0)", "defines"),
    ],
)
def test_a_vector_that_is_constant_only_in_length_is_not_constant(vector: str, outcome: str) -> None:
    text = f"Let $\\phi(t)$ be the angle, with the rate $\\dot\\phi$. $$\\vec u = {vector} = \\text{{const.}}$$"
    assert outcomes(text)[-1] == outcome


def test_a_step_with_another_letter_for_a_speed_is_not_a_slip() -> None:
    assert outcomes("$$F = -2 m \\Omega u = -2 m \\Omega \\dot x$$")[-1] == "undecided"
    assert outcomes("$$F = -2 m g u = -3 m g u$$")[-1] == "differs"
    assert outcomes("$$F = c - T \\sin\\theta \\approx c - m g \\theta$$")[-1] == "undecided"
    assert outcomes("Let $E(t)$ be the energy. $$E(0) = m g z = m g H$$")[-1] == "undecided"


def test_a_mass_in_italic_grams_has_the_dimension_of_a_mass() -> None:
    rows = "The weight is $F = m g$, and $F = m a$, so $a = g$. $F t = m v$. $v = g t$. "
    assert "differs" not in outcomes(rows + "$$m = 435g \\pm 25g$$")
