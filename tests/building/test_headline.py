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
