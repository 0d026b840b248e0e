"""Integrals of a document: which differential belongs to which sign, and what is too much."""

from __future__ import annotations

import pytest
from sympy import Rational, pi

from tests.course.latex.formula import complaint, letter, marked, value

a, h, n, z = (letter(name) for name in "ahnz")


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        (r"\int_0^h \int_0^z dx\, dz", h**2 / 2),
        (r"\int_0^h dz \int_0^z x\, dx", h**3 / 6),
        (r"2 \int_0^h z\,dz\, a", a * h**2),
        (r"\int_0^\pi \sin\theta\, d\theta \int_0^h dz", 2 * h),
        (r"\int_{z=0}^{h} (z + a)\,dz", h**2 / 2 + a * h),
        (r"\left[z^2 + a z\right]_{z=a}^{h}", h**2 + a * h - 2 * a**2),
        (r"\int_0^{2\pi} d\theta\, \frac{1}{4}", pi / 2),
        (r"\int_0^h \frac{z}{h}\frac{dz}{2}", h / 4),
    ],
)
def test_an_integral_is_what_it_would_be_on_paper(text: str, meant: object) -> None:
    assert (value(text) - meant).expand() == 0


@pytest.mark.parametrize(
    ("text", "under_the_caret", "message"),
    [
        (r"\int_0^h z^2", r"\int_0^h", "this integral has no differential"),
        (r"\int_{x=0}^h dz", "z", "the limits are those of `x`, not of `z`"),
        (r"\int_0^h dz \int_0^a dz", "z", "`z` is already the variable of another integral here"),
        (r"\int_0^h \int_0^z dz\, dx", "z", "the limit `z` contains a variable of this integral or of one inside it"),
        (r"\int^h z dz", r"\int", "the limit after `_` is missing"),
        (r"\int_0^h \frac{1}{z}\, dz", r"\frac{1}{z}", "this integral over `z` cannot be read"),
    ],
)
def test_an_integral_that_cannot_be_meant_is_told_at_its_place(text: str, under_the_caret: str, message: str) -> None:
    assert complaint(text).message == message
    assert marked(text)[0] == "integral"
    assert marked(text)[1].startswith(under_the_caret)


def test_what_is_left_above_the_line_is_one() -> None:
    assert value(r"\int_0^n \frac{dz}{3}".replace("_0^n", "_0^h")) == Rational(1, 3) * h
