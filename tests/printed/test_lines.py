"""What is printed is what was derived: every line is read back, from LaTeX and from text, and compared.

`python -P -m tests.printed --draws 200` does it for as many variants of every problem.
"""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Integer, MatAdd, Matrix, Rational, cos, pi, sin, sqrt

from derive.algebra import expressions as ex
from derive.algebra.expressions import PLUS_MINUS
from derive.algebra.rounding import rounded_form
from derive.render.notation.latex import latex
from derive.render.notation.text import columns, plain, text_box
from tests.printed.draws import Variant, check_variant
from tests.printed.expressions import LETTERS, NOTATION, Draw
from tests.printed.from_text import TextReader
from tests.printed.lines import Count, check_line
from tests.printed.names import Misprint, names_in, printed_apart

a, b, M, omega, theta, I, n = (LETTERS[name] for name in ("a", "b", "M", "omega", "theta", "I", "n"))
w, L, tensor = ex.vector("omega"), ex.vector("L"), ex.tensor("I")
v = ex.column(1, 2, 3)


def tex(expr: Any) -> str:
    return latex(NOTATION.result(expr))


def text(expr: Any) -> str:
    return plain(NOTATION.result(expr))


# --- misprints that there were ---

MENDED = [
    # a negative factor before a vector, beside another vector or within a product
    (ex.Dot(w, ex.scaled(-omega, v)), "ω⃗·(-ω (1, 2, 3))"),
    (ex.Cross(ex.scaled(-omega, v), L), "(-ω (1, 2, 3)) × L⃗"),
    (ex.applied(tensor, ex.scaled(-omega, v)), "I⃡ (-ω (1, 2, 3))"),
    (ex.Factors(M, -omega, a), "M (-ω) a"),
    # a sign behind a sign
    (ex.Terms(a, ex.Factors(-omega, b)), "a - ω b"),
    (ex.Terms(a, rounded_form(Rational(-3, 2), 2)), "a - 1.5"),
    (ex.Terms(a, ex.Amount(Integer(-2), "cm", Rational(1, 100))), "a - 2 cm"),
    (MatAdd(w, ex.scaled(ex.Factors(Integer(-1), omega), L)), "ω⃗ - ω L⃗"),
    (-ex.Terms(-a, b), "-(-a + b)"),
    # what takes in all that follows, followed by something
    (ex.Factors(ex.Dot(w, L), ex.Dot(w, L)), "(ω⃗·L⃗) ω⃗·L⃗"),
    (ex.applied(tensor, ex.Cross(w, L)), "I⃡ (ω⃗ × L⃗)"),
    (ex.Factors(ex.TimeRate(a**2, a), b), "(d/dt (a²)) b"),
    (ex.Cross(ex.scaled(a, ex.Cross(w, L)), w), "(a ω⃗ × L⃗) × ω⃗"),
    # a function's argument
    (sin(2) * M, "sin(2) M"),
    (cos(theta) * M**n, "M^n cos θ"),
    (sin(theta) ** 2 * theta**n, "θ^n sin² θ"),
    (ex.Ratio(sin(theta), Integer(2)), "(sin θ)/2"),
    (ex.Ratio(Integer(1), sin(theta)), "1/(sin θ)"),
    # numbers behind factors, plus or minus, places
    (ex.Factors(a + b, 2 / sqrt(14)), "(a + b) √(2/7)"),
    (ex.applied(tensor, Rational(1, 2) * Matrix([1, 2, 3])), "I⃡ (1/2 (1, 2, 3))"),
    (PLUS_MINUS * a / 2, "±a/2"),
    (ex.At(a * theta, theta, pi / 2), "(a θ)|(θ = π/2)"),
    # a matrix where there is room for one line only
    (ex.Root(ex.Dot(w, ex.applied(Matrix(3, 3, range(9)), w))), "√(ω⃗·((0, 1, 2), (3, 4, 5), (6, 7, 8)) ω⃗)"),
]


@pytest.mark.parametrize(("expr", "as_text"), MENDED, ids=[row[1] for row in MENDED])
def test_a_line_is_printed_so_that_it_is_read_as_what_it_is(expr: Any, as_text: str) -> None:
    assert text(expr) == as_text
    count = Count()
    check_line(expr, NOTATION, count)
    assert not count.misprints


def test_a_tensor_and_a_scalar_of_one_letter_are_told_apart() -> None:
    line = ex.Relation(tensor, "=", ex.scaled(I * a**2 / 12, Matrix.diag(13, 10, 5)))
    assert text(line).split("\n")[1].startswith("I⃡ = 1/12 I a² ")
    assert len(printed_apart(names_in(line, NOTATION), plain)) == 3


def test_a_line_whose_letters_are_printed_alike_is_a_misprint() -> None:
    line = ex.Terms(ex.scalar("v_C_x"), ex.scalar("v_Cx"))
    with pytest.raises(Misprint, match="stands for"):
        printed_apart(names_in(line, NOTATION), plain)


def test_marks_above_letters_take_no_room_in_a_block_of_lines() -> None:
    block = text_box(NOTATION.layout(ex.applied(tensor, ex.applied(Matrix(3, 3, range(9)), w))))
    assert {columns(line) for line in block.lines} == {block.width}


# --- the readers see what is wrong ---

WRONG_TEXT = ["a + -b", "M -ω a", "a·-b", "a 2", "a 2/3 b", "(a", "a b)", "I a", "sin", "a/", "∫(0..a) b", "|a", "1/2/"]


@pytest.mark.parametrize("line", WRONG_TEXT)
def test_the_reader_of_text_refuses_what_is_misprinted(line: str) -> None:
    names = printed_apart(names_in(ex.Terms(a, b, M * omega), NOTATION), plain)
    with pytest.raises(Misprint):
        TextReader(line, names).chain()


@pytest.mark.parametrize(
    ("line", "meant"),
    [
        ("1/2 M a", M * a / 2),
        ("M a/b ω", M * a * omega / b),
        ("M/(a b)", M / (a * b)),
        ("-a b + M", M - a * b),
        ("√a b", sqrt(a) * b),
        ("sin² a b", sin(a) ** 2 * b),
        ("2a·3b", 6 * a * b),
    ],
)
def test_the_reader_of_text_reads_by_the_usual_precedence(line: str, meant: Any) -> None:
    names = printed_apart(names_in(ex.Terms(a, b, M * omega), NOTATION), plain)
    assert TextReader(line, names).chain() == ([meant], [])


# --- drawn ---


@pytest.mark.parametrize("block", range(4))
def test_drawn_lines_of_every_kind_are_read_back_as_themselves(block: int) -> None:
    count = Count()
    for seed in range(75 * block, 75 * (block + 1)):
        check_line(Draw(seed).line(3), NOTATION, count, f"draw {seed}")
    assert not count.misprints, next(iter(count.misprints.items()))
    assert min(count.read[form] for form in ("display", "inline", "text")) >= 75


SAMPLE = [
    Variant("block", (("sides", "[a, 2*a, 3*a]"), ("mass", "I"), ("axis", "[1, -1, 0]"), ("rate", "-omega"))),
    Variant("cone", (("radius", "2*a"), ("height", "h"), ("mass", "I"))),
    Variant("euler", (("moments", "[A, A - B, 2*C]"),)),
    Variant("slab", (("radius", "R"), ("thickness", "a/3"), ("mass", "I"), ("inertia", "A"), ("gravity", "g"))),
]


@pytest.mark.parametrize("variant", SAMPLE, ids=str)
def test_every_line_of_a_variant_is_read_back_as_what_was_derived(variant: Variant) -> None:
    count = Count()
    assert check_variant(variant, count) > 40
    assert not count.misprints, next(iter(count.misprints.items()))
