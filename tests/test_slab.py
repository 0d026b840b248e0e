"""The slab from YAML alone: edits of an instructor, and the words of the page after them."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.errors import Rejected
from tests.courses import course_in, rendered_once

NUMBERS = {
    "radius: R\n": "radius: 10 cm\n",
    "thickness: a\n": "thickness: 30 cm\n",
    "mass: M\n": "mass: 1 kg\n",
    "inertia: I ": "inertia: 0.01 kg m^2 ",
    "gravity: g\n": "gravity: 9.8 m/s^2\n",
}


def text_of(folder: Path, edits: dict[str, str]) -> str:
    return " ".join(
        rendered_once(course_in(folder, edits, problem="slab"), "hw9/slab", only={"text"}).texts["text"].split()
    )


@pytest.mark.parametrize(
    ("edits", "said"),
    [
        ({"thickness: a\n": "thickness: 2*R\n"}, "small oscillations leave it open whether the equilibrium is stable"),
        ({"radius: R\n": "radius: 2*b\n", "{R: length": "{b: length"}, "b > a/4"),
        ({"radius: R\n": "radius: b - a\n", "{R: length": "{b: length"}, "a < 2/3 b"),
        ({"radius: R\n": "radius: a + b\n", "{R: length": "{b: length"}, "so the equilibrium is stable"),
        ({"inertia: I ": "inertia: M*a**2/3 "}, "R > a/2"),
    ],
)
def test_another_radius_or_thickness_changes_the_words(tmp_path: Path, edits: dict[str, str], said: str) -> None:
    assert said in text_of(tmp_path, edits)


@pytest.mark.parametrize(
    ("radius", "said"),
    [
        ("10 cm", "the condition R > a/2 is not satisfied, 0.1 m < 1/2 (0.3 m)"),
        ("15 cm", "the condition R > a/2 is not satisfied, 0.15 m = 1/2 (0.3 m)"),
    ],
)
def test_with_numbers_the_page_says_once_whether_the_condition_is_fulfilled(
    tmp_path: Path, radius: str, said: str
) -> None:
    text = text_of(tmp_path, {**NUMBERS, "radius: R\n": f"radius: {radius}\n"})
    assert text.count("the condition R > a/2 is") == 1
    assert said in text


def test_a_frequency_that_would_be_imaginary_has_no_number(tmp_path: Path) -> None:
    text = text_of(tmp_path, NUMBERS)
    assert "If ω_0² is positive, the angular frequency of small oscillations" in text
    assert "ω_0 ≈" not in text and "10 cm = 0.1 m" in text
    assert "≈ 3.883 rad/s" in text.replace("√", "")  # only kappa has a number


def test_a_length_that_is_called_as_the_angle_is_refused(tmp_path: Path) -> None:
    with pytest.raises(Rejected) as refusal:
        text_of(tmp_path, {"thickness: a\n": "thickness: theta\n", "a: length": "theta: length"})
    (complaint,) = refusal.value.complaints
    assert complaint.code == "letter-clash"
    assert complaint.message == "`theta` is a symbol of this problem, but a coordinate has the same name"


def test_a_part_alone_shows_the_steps_that_it_rests_on(tmp_path: Path) -> None:
    """Without the first four parts, the last part derives the equation of motion before it refers to it."""
    root = course_in(tmp_path, problem="slab")
    file = root / "problems" / "hw9" / "slab.yaml"
    written = file.read_text(encoding="utf-8")
    head, parts = written.split("parts:\n")
    last = parts.index("  - ask: >-\n      Find the force")
    head = head.replace("points: 15\n", "")
    file.write_text(head + "parts:\n" + parts[last:].split("\nwording:")[0] + "\n", encoding="utf-8")
    text = " ".join(rendered_once(root, "hw9/slab", only={"text"}).texts["text"].split())
    assert text.index("Lagrange's equation for θ is") < text.index(" again")


def test_a_part_that_is_left_out_takes_its_words_with_it(tmp_path: Path) -> None:
    """The file keeps a `wording:` for the steps of that part."""
    ask = "Find the condition for stable equilibrium, assuming that the slab does not slip."
    part = f"  - ask: {ask}\n    answer: stability\n"
    text = text_of(tmp_path, {part: "", "points: 15\n": ""})
    assert "(c) What is the potential energy" in text


def test_inertia_and_width_together_are_refused(tmp_path: Path) -> None:
    edits = {"  gravity: g\n": "  gravity: g\n  width: b\n", "I: moment of inertia": "I: moment of inertia, b: length"}
    with pytest.raises(Rejected, match="give `inertia` or `width`, not both"):
        text_of(tmp_path, edits)


CASES = "{potential: {cases: [{R: 20 cm, a: 5 cm, M: 1 kg, g: 9.8 m/s^2}, {R: 10 cm, a: 30 cm}]}}"
PLOTTED = {
    "answer: extreme_value\n": "answer: extreme_value\n    cases: potential\n",
    "wording:\n": f"drawings: {CASES}\nwording:\n",
}
PLOT = {
    "from derive.given": "from derive.figures import plot\nfrom derive.given",
    "import cos, sin": "import cos, pi, sin",
    "    return L": '    plot("potential", U, theta.symbol, (-pi / 2, pi / 2))\n    return L',
}


def test_an_answer_has_its_number_in_each_case_of_a_plot(tmp_path: Path) -> None:
    root = course_in(tmp_path, PLOTTED, PLOT, problem="slab")
    text = " ".join(rendered_once(root, "hw9/slab", only={"text"}).texts["text"].split())
    assert "In case (i), the minimum is" in text and "= 2.205 J (16)" in text
    assert "In case (ii), the maximum is" in text and "= 2.450 J (17)" in text


GIVEN_IN_CASES = "M = 1 kg, g = 9.8 m/s^2 and (i) R = 20 cm, a = 5 cm; (ii) R = 10 cm, a = 30 cm"


@pytest.mark.parametrize(
    ("question", "printed"),
    [
        ("Plot it for two slabs: <<cases>>.", f"Plot it for two slabs: {GIVEN_IN_CASES}. "),
        ("Plot it for two slabs.", f"Plot it for two slabs. Take {GIVEN_IN_CASES}. "),
        ("Plot it for 1 kg, 9.8 m/s², 20 cm and 5 cm, 10 cm and 30 cm.", "10 cm and 30 cm. ---"),
    ],
)
def test_the_numbers_of_cases_belong_to_the_question_that_plots_them(
    tmp_path: Path, question: str, printed: str
) -> None:
    edits = {**PLOTTED, "What is the potential energy <<potential_energy>> at <<theta>> = 0?": question}
    root = course_in(tmp_path, edits, PLOT, problem="slab")
    text = " ".join(rendered_once(root, "hw9/slab", only={"text"}).texts["text"].split())
    assert printed in text


def test_cases_are_those_of_a_plot(tmp_path: Path) -> None:
    with pytest.raises(Rejected, match="no drawing `potential` has cases"):
        text_of(tmp_path, {"answer: extreme_value\n": "answer: extreme_value\n    cases: potential\n"})


LIMITS = "limits:\n  - {of: frequency, letter: a, to: 0, is: sqrt(M*g*R/I)}\nwording:\n"
OF_WIDTH = {
    "inertia: I   ": "width: b     ",
    "I: moment of inertia": "b: length",
    "Its moment of inertia about the axis through its centre of mass that is parallel to\n": "Its width\n",
    "the cylinder's is <<inertia>>": "is <<width>>",
}


@pytest.mark.parametrize(
    ("edits", "there"),
    [({}, True), ({"radius: R\n": "radius: a/4\n"}, False), pytest.param(OF_WIDTH, False, marks=pytest.mark.long)],
)
def test_a_limit_that_needs_a_letter_no_longer_given_is_left_out(
    tmp_path: Path, edits: dict[str, str], there: bool
) -> None:
    assert ("As a → 0, ω_0 → √(M g R/I)" in text_of(tmp_path, {**edits, "wording:\n": LIMITS})) == there


TOP = """limits:
  - {of: slow_precession, letter: S, to: infinity, is: M*g*l/(I_z*S)}
show:
"""


@pytest.mark.parametrize(
    ("edits", "there"), [({}, True), ({"900 rpm": "200 rpm"}, False), ({"45 deg": "90 deg"}, False)]
)
def test_a_limit_may_be_told_in_the_letters_of_steps(tmp_path: Path, edits: dict[str, str], there: bool) -> None:
    root = course_in(tmp_path, {**edits, "show:\n": TOP}, problem="top")
    text = " ".join(rendered_once(root, "hw9/top", only={"text"}).texts["text"].split())
    assert ("3g/(2a S), which is M g l/(I_z S)" in text) == there
