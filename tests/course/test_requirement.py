"""What a script requires of what is given is told where it is given."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from sympy import Symbol, pi
from sympy.logic.boolalg import Boolean

from derive.algebra.expressions import Relation
from derive.course.problem import load_problem, run_solve
from derive.course.requirement import require
from derive.errors import Complaint, Rejected
from derive.steps.record import Run, recorded
from tests.courses import ROOT, course_in, rendered_once

a, b, c = (Symbol(name, positive=True) for name in "abc")


def refused(folder: Path, edits: dict[str, str]) -> Complaint:
    with pytest.raises(Rejected) as caught:
        run_solve(load_problem(course_in(folder, edits, problem="top"), "hw9/top"))
    (complaint,) = caught.value.complaints
    return complaint


@pytest.mark.parametrize("at", ["10*a", "1.2 m", "2*a - a/3"])
def test_the_disc_of_a_top_lies_on_its_rod(at: str, tmp_path: Path) -> None:
    complaint = refused(tmp_path, {"disc_at: a/2 ": f"disc_at: {at} "})
    assert complaint.message == "`disc_at` must not lie beyond the end of the rod"
    assert complaint.place
    assert complaint.place.text.strip().startswith("disc_at:")


@pytest.mark.parametrize("tilt", ["405 deg", "-10 deg", "3*pi/2"])
def test_the_tilt_of_a_top_is_at_most_a_half_turn(tilt: str, tmp_path: Path) -> None:
    assert refused(tmp_path, {"tilt: 45 deg": f"tilt: {tilt}"}).code == "out-of-range"


def test_a_tilt_by_a_letter_is_as_much_as_its_number(tmp_path: Path) -> None:
    edits = {"tilt: 45 deg": "tilt: theta_0", "values: {a: 10 cm}": "values: {a: 10 cm, theta_0: 200 deg}"}
    assert refused(tmp_path, edits).code == "out-of-range"


@pytest.mark.parametrize("condition", [True, a <= 2 * a, a <= b, a < b + pi])
def test_what_holds_or_may_hold_is_accepted(condition: bool) -> None:
    require(condition, "x", "must be less")


def test_of_several_conditions_only_those_left_open_are_assumed() -> None:
    with recorded(Run(numbers={c: pi})) as run:
        require((a <= b) & (c <= 4) & (a <= 2 * a), "x", "must be less")
    assert run.assumed == [Relation(a, "<=", b)]


@pytest.mark.parametrize("condition", [(a < b) | (b < c), ~((a < b) & (b < c))])
def test_a_choice_between_conditions_cannot_be_assumed(condition: Boolean) -> None:
    with recorded() as run, pytest.raises(Rejected, match="takes comparisons that must all hold"):
        require(condition, "x", "must be less")
    assert run.assumed == []


REACHING = '''"""A bob within its reach."""

from derive.given import Length, require
from derive.mechanics import let


def solve(length: Length, reach: Length):
    require(length <= reach, "length", "must not exceed the reach")
    return let("both", lambda: length + reach, symbol="s")
'''
BOB = """title: A bob
solve: bob.py
symbols: {a: length, b: length}
given: {length: a, reach: b}
statement: A bob hangs.
parts:
  - ask: How long are both?
    answer: both
"""


@pytest.mark.parametrize(("reach", "assumed"), [("b", ["Le(a, b, evaluate=False)"]), ("2*a", [])])
def test_what_the_letters_leave_open_is_told_with_the_statement(tmp_path: Path, reach: str, assumed: list[str]) -> None:
    folder = tmp_path / "problems" / "set"
    folder.mkdir(parents=True)
    (tmp_path / "templates").symlink_to(ROOT / "templates")
    (folder / "bob.py").write_text(REACHING, encoding="utf-8")
    (folder / "bob.yaml").write_text(BOB.replace("reach: b", f"reach: {reach}"), encoding="utf-8")
    solved = rendered_once(tmp_path, "set/bob")
    assert ("A bob hangs. Assume that a ≤ b." in solved.texts["text"]) == bool(assumed)
    assert json.loads(solved.texts["json"])["assumed"] == assumed


@pytest.mark.parametrize("condition", [False, 2 * a <= a, a <= b])
def test_what_is_known_to_fail_is_refused(condition: bool) -> None:
    with recorded(Run(numbers={a: pi, b: pi / 2})), pytest.raises(Rejected, match="`x` must be less"):
        require(condition, "x", "must be less")
