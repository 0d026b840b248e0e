"""`variants:`: what may vary, and the choices of each student."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

from derive.course.problem import Problem, load_problem
from derive.course.variants import chosen_for
from derive.errors import Rejected

BEAD = """\
title: A bead
solve: system
symbols: {m: mass, g: acceleration, b: length}
values: {b: 20 cm, g: 9.81 m/s^2}
VARIANTS
given:
  coordinates: {x: length}
  particles:
    bead: {mass: m, at: [x, x**2/(2*b)]}
  gravity: g
statement: A bead of mass <<m>> on a wire, bent to $y = x^2/(2b)$ with <<b>>; the acceleration of free fall is <<g>>.
parts:
  - ask: Find the angular frequency.
    answer: frequency
    form: {unit: rad/s}
"""


def bead(root: Path, variants: str, **chosen: int) -> Problem:
    folder = root / "problems" / "week1"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "set.yaml").write_text("course: A\ntitle: B\nproblems: [bead]\n")
    (folder / "bead.yaml").write_text(BEAD.replace("VARIANTS", f"variants: {variants}"))
    return load_problem(root, "week1/bead", chosen or None)


def texts(problem: Problem, name: str) -> list[str]:
    (found,) = [each for each in problem.variations if each.name == name]
    return [found.told(choice) for choice in range(len(found.choices))]


@pytest.mark.parametrize(
    ("written", "choices"),
    [
        ("10..30 cm in steps of 10", ["10 cm", "20 cm", "30 cm"]),
        ("0.1..0.3 m in steps of 0.1", ["0.1 m", "0.2 m", "0.3 m"]),
        ("1.50..2 m in steps of 0.25", ["1.5 m", "1.75 m", "2 m"]),
        ("[20 cm, 2 m]", ["20 cm", "2 m"]),
    ],
)
def test_a_range_or_a_list_has_these_choices(tmp_path: Path, written: str, choices: list[str]) -> None:
    assert texts(bead(tmp_path, f"{{b: {written}}}"), "b") == choices


def test_a_choice_replaces_the_value_of_the_file(tmp_path: Path) -> None:
    variants = "{b: 10..30 cm in steps of 10, particles.bead.mass: [m, 2*m]}"
    plain = bead(tmp_path, variants)
    varied = bead(tmp_path, variants, b=2, **{"particles.bead.mass": 1})
    numbers = [{each.symbol.name: each.number for each in problem.measured} for problem in (plain, varied)]
    assert [each["b"] for each in numbers] == [20, 30]
    assert numbers[0]["g"] == numbers[1]["g"]
    assert (plain.is_variant, varied.is_variant) == (False, True)
    assert plain.described != varied.described


@pytest.mark.parametrize(
    ("written", "message", "text"),
    [
        ("{c: 1..2 m in steps of 1}", "neither `values` nor `given` has `c`", "c"),
        ("{particles.ring.mass: [m, 2*m]}", "has `particles.ring.mass`", "particles.ring.mass"),
        ("{b: 30..10 cm in steps of 1}", "a range must increase", "30..10 cm in steps of 1"),
        ("{b: 10..30 cm in steps of 0}", "with a positive step", "10..30 cm in steps of 0"),
        ("{b: 10..30 cm in steps of 0.0001}", "must have 2 to 10000 values", "10..30 cm in steps of 0.0001"),
        ("{b: 10..29 cm in steps of 10}", "lead from 10 to 20 cm, not to 29 cm", "10..29 cm in steps of 10"),
        ("{b: 10..30 kg in steps of 10}", "must be a length, but `10 kg` is a mass", "10..30 kg in steps of 10"),
        ("{b: [20 cm, 30 mm, 2 s]}", "must be a length, but `2 s` is a time", "2 s"),
        ("{particles.bead: [{mass: m, at: [x, 0]}, {mas: m, at: [x, 0]}]}", "has no key `mas`", "mas"),
        ("{b: 0,8..1,6 m in steps of 0,1}", "has a comma in it", "0,8..1,6 m in steps of 0,1"),
        ("{b: [0,8 m, 0,9 m]}", "has a comma in it", "0,8 m"),
        ("{b: 10..30 cm}", "must be a range such as", "10..30 cm"),
        ("{b: [20 cm]}", "it has one value", "[20 cm]"),
        ("{b: 9e999..9e9999 cm in steps of 1}", "must be a range such as", "9e999"),
        ("[b]", "must be a mapping", "[b]"),
        ("{}", "must be a mapping", "{}"),
    ],
)
def test_a_wrong_variation_is_an_error_at_its_place(tmp_path: Path, written: str, message: str, text: str) -> None:
    with pytest.raises(Rejected) as caught:
        bead(tmp_path, written)
    (complaint,) = caught.value.complaints
    assert message in complaint.message
    place = complaint.place
    assert place and place.line == 5
    assert place.text[place.column - 1 :].startswith(text[:1])


def test_an_error_in_a_choice_is_reported_at_the_range(tmp_path: Path) -> None:
    with pytest.raises(Rejected) as caught:
        bead(tmp_path, "{b: 10..30 s in steps of 10}", b=1)
    place = caught.value.complaints[0].place
    assert place
    assert (place.line, place.column) == (5, len("variants: {b: ") + 1)


def test_the_choice_of_a_student_depends_on_nothing_else(tmp_path: Path) -> None:
    one = bead(tmp_path, "{b: 10..30 cm in steps of 1}").variations
    more = bead(tmp_path, "{g: [9.81 m/s^2, 1.62 m/s^2], b: 10..30 cm in steps of 1}").variations
    for student in ("Ada", "Emmy", "Lise"):
        chosen = chosen_for("week1", "bead", more, student, "2026")
        assert chosen["b"] == chosen_for("week1", "bead", one, student, "2026")["b"]
        assert chosen == chosen_for("week1", "bead", more, student, "2026")
    others = [chosen_for("week1", "bead", one, "Ada", seed)["b"] for seed in map(str, range(20))]
    assert len(set(others)) > 5


def test_all_choices_are_about_equally_frequent(tmp_path: Path) -> None:
    variations = bead(tmp_path, "{b: 10..19 cm in steps of 1}").variations
    counts = Counter(chosen_for("week1", "bead", variations, str(number), "")["b"] for number in range(5000))
    assert set(counts) == set(range(10))
    assert max(abs(count - 500) for count in counts.values()) < 100  # more than four standard deviations


@pytest.mark.parametrize(("choice", "printed"), [(0, "m"), (1, "2*m")])
def test_prose_can_mention_a_given_value_by_its_path(tmp_path: Path, choice: int, printed: str) -> None:
    bead(tmp_path, "{particles.bead.mass: [m, 2*m]}")
    file = tmp_path / "problems" / "week1" / "bead.yaml"
    file.write_text(file.read_text().replace("<<m>>", "<<particles.bead.mass>>"))
    (mentioned,) = load_problem(tmp_path, "week1/bead", {"particles.bead.mass": choice}).in_prose
    assert (mentioned.name, str(mentioned.value)) == ("particles.bead.mass", printed)
