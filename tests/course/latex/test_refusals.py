"""What is refused: where the caret stands, and that nothing is guessed or left to run away."""

from __future__ import annotations

from contextlib import suppress

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from derive.course.latex.strict import LONGEST_FORMULA
from derive.course.latex.vocabulary import KNOWN, MATRICES
from derive.errors import Rejected
from tests.course.latex.formula import complaint, marked, read, value

AMBIGUOUS = [
    (r"a/2b", "/"),
    (r"1/2 M a^2", "/"),
    (r"a/b/h", "/"),
    (r"a/2 \cdot b", "/"),
    (r"\sin\theta\phi", r"\theta\phi"),
    (r"\sin\theta^2", r"\theta^"),
    (r"\sin(\theta)^2", r"(\theta)^"),
    (r"\sin\theta/2", r"\theta/"),
    (r"\sin 2(\theta+\phi)", "2"),
    (r"\sin^{-1} n", "{-1}"),
    (r"2\frac12 a", r"2\frac12"),
    (r"2 3 a", "2 3"),
    (r"a2", "a2"),
    (r"a^23", "23"),
    (r"\omega_12", "12"),
    (r"b(a)", "b(a)"),
]


@pytest.mark.parametrize(("text", "under_the_caret"), AMBIGUOUS, ids=[text for text, _ in AMBIGUOUS])
def test_what_could_be_read_in_two_ways_is_refused_with_help(text: str, under_the_caret: str) -> None:
    assert marked(text) == ("ambiguous", under_the_caret)
    assert complaint(text).help


REFUSED = [
    # letters
    ("q + a", "undeclared-symbol", "q"),
    (r"\dot{q}", "undeclared-symbol", r"\dot{q}"),
    (r"\omega_{1}", "undeclared-symbol", r"\omega_{1}"),
    (r"28 \mathrm{rad}", "undeclared-symbol", r"\mathrm{rad}"),
    (r"I_{a+b}", "latex", "{a+b}"),
    (r"\dot{\ddot{\dot{a}}}", "latex", r"\dot{\ddot{\dot{a}}}"),
    (r"\hat{\omega}", "latex", r"\hat{\omega}"),
    (r"\boldsymbol\omega \times \vec{r}", "shape", r"\boldsymbol\omega \times \vec{r}"),
    (r"\frac12 \vec a \cdot 2\vec b", "shape", r"\frac12 \vec a \cdot 2\vec b"),
    # dimensions and shapes
    ("M + a", "dimension", "a"),
    (r"\sin a", "ambiguous", "a"),
    (r"\sin(a)", "dimension", "(a)"),
    (r"\int_0^M z dz", "dimension", "M"),
    (r"\{a,b\}", "shape", r"\{a,b\}"),
    (r"a + \{a,b,h\}", "shape", r"\{a,b,h\}"),
    (r"\{a,b,h\}\{a,b,h\}", "shape", r"\{a,b,h\}"),
    (r"\frac{a}{\{a,b,h\}}", "shape", r"{\{a,b,h\}}"),
    (r"\begin{pmatrix} a & b \\ h \end{pmatrix}", "shape", r"\begin{pmatrix} a & b \\ h \end{pmatrix}"),
    (r"\begin{vmatrix} a \end{vmatrix}", "latex", r"\begin{vmatrix}"),
    # integrals
    (r"\int z dz", "integral", r"\int"),
    (r"\int_0^h z", "integral", r"\int_0^h"),
    (r"z\int_0^h z dz", "integral", "z"),
    (r"\int_0^h \int_0^z x\,dz\,dx", "integral", "z"),
    (r"\int_{x=0}^{h} z dz", "integral", "z"),
    (r"\int_0^h dz\,dz", "undeclared-symbol", "d"),
    (r"\int_0^h \frac{1}{z} dz", "integral", r"\frac{1}{z}"),
    (r"\int_0^n \sin^5(3\theta+n)\cos^4\theta d\theta", "integral", r"\sin^5"),
    (r"\int_0^n \theta^{12}\sin^9\theta d\theta", "integral", r"\theta^{12}"),
    (r"\left[a z\right]_0^h", "integral", r"\left[a z\right]"),
    (r"\left[a\right]_0^{a}", "integral", r"\left[a\right]"),
    # what is no formula
    (r"\foo a", "latex", r"\foo"),
    (r"\frac{d}{dt} a", "latex", r"\frac{d}{dt}"),
    (r"\frac{\partial M}{\partial\theta}", "latex", r"\frac{\partial M}"),
    (r"a \partial M", "latex", r"\partial"),
    (r"a'", "latex", "'"),
    (r"a^\prime", "latex", "^"),
    (r"\log a", "latex", r"\log"),
    (r"$a$", "latex", "$"),
    ("a % twice", "latex", "%"),
    (r"a \text{ where } b", "latex", r"\text{ where }"),
    (r"a \\ b", "latex", r"\\"),
    ("a = ", "latex", "="),
    ("= = a", "latex", "="),
    ("a + ", "latex", "+"),
    ("+ * a", "latex", "*"),
    ("ω a", "latex", "ω"),
    (r"a^b", "dimension", "b"),
    (r"a^2^3", "latex", "^"),
    (r"(a+b)_2", "integral", "(a+b"),
    (r"(a+b", "latex", "("),
    (r"\left(a\right]", "latex", r"\right]"),
    (r"(a]", "latex", "]"),
    ("{a", "latex", "{"),
    ("a}", "latex", "}"),
    (r"\frac{a}", "latex", "\\"),
    (r"\begin{array}{c} a", "latex", r"\begin{array}"),
    ("a\\", "latex", "\\"),
    (r"a \pm b \text{ or } h", "latex", "a"),
    (r"\frac{a}{0}", "division-by-zero", "{0}"),
    (r"\sqrt{-1}", "not-real", r"\sqrt{-1}"),
    ("", "latex", ""),
]


@pytest.mark.parametrize(("text", "code", "under_the_caret"), REFUSED, ids=[text for text, *_ in REFUSED])
def test_what_cannot_be_read_is_told_at_its_place(text: str, code: str, under_the_caret: str) -> None:
    found, there = marked(text)
    assert (found, there[: len(under_the_caret)]) == (code, under_the_caret)


def test_every_undeclared_letter_is_told_at_once() -> None:
    with pytest.raises(Rejected) as caught:
        read(r"q a + p \dot{u}")
    assert [c.message for c in caught.value.complaints] == [f"`{q}` is not declared" for q in "qpu"]


def test_a_mistyped_command_has_its_nearest() -> None:
    assert complaint(r"\omgea").help == r"did you mean `\omega`?"


def test_dimensions_are_not_compared_where_they_mean_nothing() -> None:
    assert read("S^2 - 9.8 a", homogeneous=False)
    assert marked("S^2 - 9.8 a")[0] == "dimension"


# -- bounds -----------------------------------------------------------------------------------------------------------

LARGE = [
    "{" * 50 + "a" + "}" * 50,
    "(" * 60 + "a" + ")" * 60,
    r"\frac{1}{" * 45 + "2" + "}" * 45,
    "a+" * (LONGEST_FORMULA // 2) + "a",
    r"9^{9^9}",
    r"9^{12}" * 200,
    r"(a+b+h+l)^{12}",
    r"\int_0^h (z+a)^{12}(z+b)^{12} dz",
    r"\int_{-a-b-h-l}^{a+b+h+l} z^{12} dz",
    r"\left[z^{12}z^{12}\right]_{z=0}^{a+b+h+l}",
    "1" * 31,
    "=".join(["a"] * 50),
    r"\begin{pmatrix}" + r" \\ ".join(["a"] * 7) + r"\end{pmatrix}",
]


@pytest.mark.parametrize("text", LARGE, ids=[text[:30] for text in LARGE])
def test_what_would_be_too_large_is_refused_before_it_is_worked_out(text: str) -> None:
    assert complaint(text).code in {"too-large", "shape"}


def test_integrals_and_powers_of_a_usual_size_are_read() -> None:
    assert value(r"\int_{-a}^{a+b} (z+h)^4 dz \int_0^R r^3 dr") is not None


# -- anything at all --------------------------------------------------------------------------------------------------

PIECES = st.sampled_from(
    [
        *(f"\\{name} " for name in sorted(KNOWN)),
        *(f"\\begin{{{name}}}" for name in sorted(MATRICES)),
        *(f"\\end{{{name}}}" for name in sorted(MATRICES)),
        *"abhzdeM0123456789+-*/=<>^_{}()[]|&,.'!$%~#@ \n",
        "\\\\", "\\{", "\\}", "\\|", "\\,", "\\", "\\left(", "\\right)", "\\left[", "\\right]", "_{", "^{", "{}",
        "\\int_0^h ", "dz", "\\frac{a}{b}", "_0^h", "^\\circ", "\\text{or}", "\\text{a}", "\\theta", "0.5", "ω", "\x00",
    ]
)  # fmt: skip


@given(st.lists(PIECES, max_size=25).map("".join))
@settings(max_examples=200, deadline=None)
def test_any_text_is_read_or_told_in_one_place_each(text: str) -> None:
    try:
        found = read(text)
    except Rejected as refused:
        for told in refused.complaints:
            assert told.place is not None
            assert 1 <= told.place.line <= text.count("\n") + 1
            assert told.message[:1] not in " ABCDEFGHIJKLMNOPQRSTUVWXYZ" and not told.message.endswith(".")
    else:
        assert len(found.sides) == len(found.marks)


@given(st.text(max_size=60))
@settings(max_examples=100, deadline=None)
def test_text_that_was_never_mathematics_is_no_danger(text: str) -> None:
    with suppress(Rejected):
        read(text)
