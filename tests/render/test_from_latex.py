"""Tests of quoted formulas in a terminal: correct formulas look like those of a page, and garbled ones cause no
error."""

from __future__ import annotations

import random
import re

import pytest

from derive.course.latex.vocabulary import KNOWN
from derive.course.reference.quotes import unquotable
from derive.course.yaml_tree import Mapping, Scalar, Sequence, Tree, read_yaml
from derive.render.notation.from_latex import DEEPEST, in_plain_text, layout_of_latex
from derive.render.notation.latex import latex
from derive.render.notation.layout import Array, Fraction, Name, Row
from tests.courses import ROOT


@pytest.mark.parametrize(
    ("tex", "text"),
    [
        (r"\frac{13}{12} M a^{2}", "13/12 M a²"),
        (r"M\left(R-\frac{1}{2} a\right)>0", "M (R - 1/2 a) > 0"),
        (r"I_{z}^{2} S^{2} \geq 4 I_{y} \cos \theta M g l", "I_z² S² ≥ 4I_y cos θ M g l"),
        (r"-\frac{-b \pm \sqrt{b^{2}-4 a c}}{2 a}", "-(-b ± √(b² - 4a c))/(2a)"),
        (r"\dot{\omega} \cdot \boldsymbol{L}", "ω̇·L⃗"),
        (r"\ddot{\theta}=0", "θ̈ = 0"),
        (r"\left\{a, 2 a\right\}", "{a, 2a}"),
        (r"\int_{0}^{h} z^{4} d z", "∫(0..h) z⁴ dz"),
        (r"\left[\frac{r^{4}}{4}\right]_{0}^{\frac{R}{h} z}", "[r⁴/4](0..R/h z)"),
        (r"\left(\begin{array}{c} a \\ b \end{array}\right)", "(a, b)"),
        (r"\left(\begin{array}{cc} a & 0 \\ 0 & b \end{array}\right)", "((a, 0), (0, b))"),
        (r"939.47 \text{ or } 15.13 \mathrm{~rpm}", "939.47 or 15.13 rpm"),
        (r"\sin 2\theta+\sin ^{2} \theta", "sin(2θ) + sin² θ"),
        (r"U^{\prime}(0)=45^{\circ}", "U'(0) = 45°"),
        (r"I_{i j}^{c m}", "I_ij^cm"),
        (r"\left|a\right|", "|a|"),
    ],
)
def test_a_formula_is_told_as_the_text_of_a_page_has_it(tex: str, text: str) -> None:
    assert in_plain_text(f"${tex}$") == text


def test_words_stay_as_they_are() -> None:
    assert in_plain_text(r"For $\theta=0$ (and 5 % more) it holds.") == "For θ = 0 (and 5 % more) it holds."


@pytest.mark.parametrize(
    "tex", [r"(a+b", "a)", r"\left(a\right.", "x^", r"\sqrt[3]{a}", r"\sin", "|a", "{}", r"a \\ & b"]
)
def test_what_has_no_partner_stands_for_itself(tex: str) -> None:
    told = in_plain_text(f"${tex}$")
    assert "\\" not in told and set(re.findall("[a-z]", tex.replace("left", "").replace("right", ""))) >= set(
        re.findall("[ab]", told)
    )


def test_no_command_that_may_be_quoted_is_left_as_it_is() -> None:
    formulas = [rf"$\{name}{{a}}{{b}}$" for name in KNOWN]
    quoted = [formula for formula in formulas if unquotable(formula) is None]
    assert len(quoted) > 60
    assert [formula for formula in quoted if "\\" in in_plain_text(formula)] == []


def test_whatever_may_be_quoted_is_told() -> None:
    chosen = random.Random(9)
    pieces = [*(f"\\{name} " for name in sorted(KNOWN)), *"abd19+-=^_()[]|{}&", r"\\", r"\{", r"\}"]
    tried = 0
    for _ in range(4000):
        tex = "".join(chosen.choices(pieces, k=chosen.randint(1, 9)))
        if unquotable(f"${tex}$") is None:
            tried += 1
            assert isinstance(in_plain_text(f"${tex}$"), str)
    assert tried > 200


def test_what_is_nested_too_deeply_is_quoted_as_it_is_written() -> None:
    deep = "{" * (DEEPEST + 1) + "a" + "}" * (DEEPEST + 1)
    assert in_plain_text(f"${deep}$") == deep


def test_it_is_the_layout_of_what_stands_there() -> None:
    assert layout_of_latex(r"\frac{a}{b}") == Fraction(Name("a"), Name("b"))
    assert layout_of_latex(r"\begin{array}{cc} a & b \\ c \end{array}") == Array(
        ((Name("a"), Name("b")), (Name("c"), Row(())))
    )


def test_all_that_the_homework_says_of_its_source_is_told_without_commands() -> None:
    texts = list(_texts(read_yaml(ROOT / "problems" / "hw9" / "reference.yaml", "reference.yaml")))
    assert len(texts) > 100
    assert [told for told in map(in_plain_text, texts) if re.search(r"[\\$^{]{2}|\\[a-z]", told)] == []


def _texts(node: Tree) -> list[str]:
    if isinstance(node, Sequence):
        return [text for item in node.items for text in _texts(item)]
    if not isinstance(node, Mapping):
        return []
    told = [value.text for name in ("quote", "remark", "why") if isinstance(value := node.get(name), Scalar)]
    inner = [text for name in ("entries", "erratum") if (value := node.get(name)) is not None for text in _texts(value)]
    return [*told, *inner]


def test_a_space_precedes_a_differential() -> None:
    assert latex(layout_of_latex(r"\int_0^l s^3\,ds")).endswith(r"s^{3}\,ds")
    assert latex(layout_of_latex(r"\int d\theta")) == r"\int d\theta"
