"""Brackets: values, triples, matrices, sizes, and antiderivatives between limits."""

from __future__ import annotations

import pytest
from sympy import Abs, Matrix

from derive.course.latex.values import MAX_SIDE
from tests.course.latex.formula import complaint, letter, marked, value

a, b, h, z = (letter(name) for name in "abhz")


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        (r"(a)[b]", a * b),
        (r"\{a,b,h\}", Matrix([a, b, h])),
        (r"|a-b|h", Abs(a - b) * h),
        (r"\left.z\right|_{z=a}^{b}", b - a),
        (r"\left[z\right]^h_a", h - a),
        (r"\begin{pmatrix} a \end{pmatrix}", a),
        (r"\begin{bmatrix} a & b \\ b & a \\ \end{bmatrix}", Matrix([[a, b], [b, a]])),
        (r"\left|\left|a\right| b\right|", Abs(Abs(a) * b)),
    ],
)
def test_what_stands_in_brackets_is_one_value(text: str, meant: object) -> None:
    assert value(text) == meant


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("(a", "this `(` is never closed"),
        ("(a]", "`(` is closed by `]`"),
        (r"\{a,b\}", "a vector has 3 components, but this has 2"),
        (r"(\{a,b,h\},b,h)", "a component must be a scalar, but this is a column of 3"),
        (r"\left.a\right|", "limits are missing after this bar"),
        (r"\begin{pmatrix} a & b \\ h \end{pmatrix}", "rows of 2, 1 entries do not make a matrix"),
        (r"\begin{pmatrix} a & a & a & a & a & a & a \end{pmatrix}", "a matrix has at most 6 rows and 6 columns"),
        (r"\begin{pmatrix} a & \\ b & h \end{pmatrix}", "an entry of this matrix is empty"),
        (r"\left[z+a\right]_0", "the limit after `^` is missing"),
    ],
)
def test_brackets_that_make_no_value_are_refused(text: str, message: str) -> None:
    assert complaint(text).message == message


def test_the_largest_matrix_is_read_and_no_larger_one() -> None:
    rows = [r" \\ ".join(["a"] * n) for n in (MAX_SIDE, MAX_SIDE + 1)]
    assert value(rf"\begin{{pmatrix}}{rows[0]}\end{{pmatrix}}").shape == (MAX_SIDE, 1)
    assert marked(rf"\begin{{pmatrix}}{rows[1]}\end{{pmatrix}}")[0] == "shape"


def test_a_row_may_end_with_the_space_below_it() -> None:
    strut = r"\rule[-.95em]{0pt}{2.45em}"  # as our own pages have it
    assert value(rf"\begin{{pmatrix}} {strut}\displaystyle a \\ b \end{{pmatrix}}") == value(
        r"\begin{pmatrix} a \\ b \end{pmatrix}"
    )
    assert value(r"\begin{pmatrix} a \\[3pt] b \\[ 0.5 em ] 0 \end{pmatrix}") == value(
        r"\begin{pmatrix} a \\ b \\ 0 \end{pmatrix}"
    )
    assert marked(r"\begin{pmatrix} a \\[b] 0 \\ 0 \end{pmatrix}") == ("latex", "[b]")
