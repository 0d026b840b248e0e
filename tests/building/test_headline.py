"""What a list tells of a problem: its points and its title, without mathematics where it can."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from derive.building.headline import headline
from derive.errors import Rejected
from tests.courses import ROOT, course_in

TITLE = "title: A block turning about <<axis>>"


def test_a_title_has_its_mentions_filled_with_what_is_given_and_the_keys_of_steps(tmp_path: Path) -> None:
    assert headline(course_in(tmp_path / "given"), "hw9/block") == ("10", "A block turning about a long diagonal")
    root = course_in(tmp_path / "steps", {TITLE: "title: The <<torque>> on <<mass>>"})
    assert headline(root, "hw9/block")[1] == "The torque on M"


def test_points_may_be_halves_or_left_out(tmp_path: Path) -> None:
    text = "title: A  'plain'\\n   title\npoints: 2.5\nsolve: block.py\nstatement: x\nparts: [{ask: y, answer: z}]\n"
    root = course_in(tmp_path)
    file = root / "problems" / "hw9" / "block.yaml"
    file.write_text(text.replace("\\n   ", "\n   "))
    assert headline(root, "hw9/block") == ("2.5", "A 'plain' title")
    file.write_text(file.read_text().replace("points: 2.5\n", ""))
    assert headline(root, "hw9/block")[0] == ""


def test_a_faulty_file_is_told_with_what_is_wrong(tmp_path: Path) -> None:
    root = course_in(tmp_path, {TITLE: "titel: A block"})
    with pytest.raises(Rejected, match="did you mean `title`"):
        headline(root, "hw9/block")


def test_a_plain_title_needs_no_mathematics(tmp_path: Path) -> None:
    root = course_in(tmp_path, {TITLE: "title: A block"})
    program = (
        "import sys; from pathlib import Path; from derive.building.headline import headline; "
        "print(headline(Path(sys.argv[1]), 'hw9/block'), 'sympy' in sys.modules)"
    )
    run = subprocess.run([sys.executable, "-P", "-c", program, str(root)], cwd=ROOT, capture_output=True, text=True)
    assert (run.stdout, run.stderr) == ("('10', 'A block') False\n", "")


PLAIN = {TITLE: "title: A block"}


def test_of_a_plain_file_no_more_is_read_than_its_title_and_its_points(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def read(*_: object, **__: object) -> None:
        raise AssertionError("it is read in full")

    root = course_in(tmp_path, PLAIN)
    monkeypatch.setattr("derive.building.headline.written_problem", read)
    monkeypatch.setattr("derive.course.prose.Prose.pieces", property(lambda prose: iter(())))
    monkeypatch.setattr("derive.course.problem_set.problem_paths", read)
    assert headline(root, "hw9/block") == ("10", "A block")
    assert headline(root, "hw9/block", "problems/hw9/block.yaml") == ("10", "A block")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("points: 10", "points: 11", "the points of the parts add up to 10"),
        ("points: 10", "points: ten", "`points` must be"),
        ("solve: block.py\n", "", "a problem needs `solve`"),
        ("answer: inertia_tensor", "answers: inertia_tensor", "a part has no key `answers`"),
        ("symbols:", "symbols: [", "`[` is not closed"),
    ],
)
def test_what_a_glance_finds_is_told_in_full(tmp_path: Path, old: str, new: str, said: str) -> None:
    root = course_in(tmp_path)
    file = root / "problems" / "hw9" / "block.yaml"
    text = file.read_text().replace(TITLE, "title: A block")
    assert old in text
    file.write_text(text.replace(old, new, 1))
    with pytest.raises(Rejected) as caught:
        headline(root, "hw9/block")
    assert said in str(caught.value)
