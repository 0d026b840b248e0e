"""The slab from its YAML alone: what an instructor may change, and what the page then says."""

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
        ({"radius: R\n": "radius: 2*b\n", "{R: length": "{b: length"}, "b > 1/4 a"),
        ({"radius: R\n": "radius: b - a\n", "{R: length": "{b: length"}, "a < 2/3 b"),
        ({"radius: R\n": "radius: a + b\n", "{R: length": "{b: length"}, "so the equilibrium is stable"),
        ({"inertia: I ": "inertia: M*a**2/3 "}, "R > 1/2 a"),
    ],
)
def test_another_radius_or_thickness_changes_the_words(tmp_path: Path, edits: dict[str, str], said: str) -> None:
    assert said in text_of(tmp_path, edits)


@pytest.mark.parametrize(
    ("radius", "said"),
    [
        ("10 cm", "the condition R > 1/2 a is not satisfied, 0.1 m < 1/2 (0.3 m)"),
        ("15 cm", "the condition R > 1/2 a is not satisfied, 0.15 m = 1/2 (0.3 m)"),
    ],
)
def test_with_numbers_the_page_says_once_whether_the_condition_is_fulfilled(
    tmp_path: Path, radius: str, said: str
) -> None:
    text = text_of(tmp_path, {**NUMBERS, "radius: R\n": f"radius: {radius}\n"})
    assert text.count("the condition R > 1/2 a is") == 1
    assert said in text


def test_a_frequency_that_would_be_imaginary_has_no_number(tmp_path: Path) -> None:
    text = text_of(tmp_path, NUMBERS)
    assert "rad/s" not in text
    assert "If ω_0² is positive, the angular frequency of small oscillations" in text


def test_a_length_that_is_called_as_the_angle_is_refused(tmp_path: Path) -> None:
    with pytest.raises(Rejected) as refusal:
        text_of(tmp_path, {"thickness: a\n": "thickness: theta\n", "a: length": "theta: length"})
    (complaint,) = refusal.value.complaints
    assert complaint.code == "letter-clash"
    assert complaint.message == "`theta` is a letter of this problem, but the script has a coordinate of that name"


def test_a_part_alone_shows_the_steps_that_it_rests_on(tmp_path: Path) -> None:
    """With the first four parts dropped, the last one derives the equation of motion before it points at it."""
    root = course_in(tmp_path, problem="slab")
    file = root / "problems" / "hw9" / "slab.yaml"
    written = file.read_text(encoding="utf-8")
    head, parts = written.split("parts:\n")
    last = parts.index("  - ask: >-\n      Treat")
    head = head.replace("points: 15\n", "points: 3\n")
    file.write_text(head + "parts:\n" + parts[last:].split("\nwording:")[0] + "\n", encoding="utf-8")
    text = " ".join(rendered_once(root, "hw9/slab", only={"text"}).texts["text"].split())
    assert text.index("Lagrange's equation is") < text.index("gives (14) again, (I")


def test_a_part_that_is_left_out_takes_its_words_with_it(tmp_path: Path) -> None:
    """The file keeps a `wording:` for the steps of that part."""
    part = "  - ask: When is the equilibrium of the slab stable?\n    answer: stability\n    points: 2\n"
    text = text_of(tmp_path, {part: "", "points: 15\n": ""})
    assert "(c) Show the same from the potential energy" in text


def test_inertia_and_width_together_are_refused(tmp_path: Path) -> None:
    edits = {"  gravity: g\n": "  gravity: g\n  width: b\n", "I: moment of inertia": "I: moment of inertia, b: length"}
    with pytest.raises(Rejected, match="give `inertia` or `width`, not both"):
        text_of(tmp_path, edits)
