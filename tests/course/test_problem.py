"""A problem file as checked values, and its script."""

from __future__ import annotations

import sys
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sympy import Rational, pi

from derive.course.problem import load_problem, run_solve
from derive.errors import Rejected
from tests.course.problem_file import PROBLEM, SCRIPT, at, edited, faults, loaded


def test_the_block_problem_is_read_whole(tmp_path: Path) -> None:
    problem = loaded(tmp_path)
    assert (problem.id, problem.set_id, problem.path) == ("hw9/block", "hw9", "problems/hw9/block.yaml")
    assert problem.title.text == "A block turning about its long diagonal"
    assert [part.answers for part in problem.parts] == [
        ("inertia_tensor",),
        ("angle_between",),
        ("torque", "magnitude"),
    ]
    assert [part.points for part in problem.parts] == [3, None, None]
    assert (problem.points, problem.figures, problem.show) == (10, 3, {"spin": "result"})
    assert problem.inputs == ("problems/hw9/block.yaml", "problems/hw9/block.py")
    assert problem.dimensions[problem.symbols["M"].symbol].mass == 1
    assert problem.place_of("show", "spin").line == 31
    assert problem.place_of("wording", "torque", "zero").line == 29


def test_the_given_values_reach_solve_under_their_names(tmp_path: Path) -> None:
    problem = loaded(tmp_path)
    sides, mass, axis, rate = run_solve(problem)  # type: ignore[misc]
    letters = [problem.symbols[name].symbol for name in ("a", "M", "omega")]
    assert (sides[1], mass, rate) == (2 * letters[0], *letters[1:])
    assert axis.name == "diagonal"


def test_numbers_are_kept_beside_their_letters(tmp_path: Path) -> None:
    edits = ("[a, 2*a, 3*a]", "[2 cm, 4 cm, 6 cm]"), ("mass: M", "mass: 1.5 kg"), ("rate: omega", "rate: 900 rpm")
    problem = loaded(tmp_path, *edits)
    assert problem.givens[0].value == tuple(n * problem.measured[0].symbol for n in (1, 2, 3))
    assert {str(m.symbol): m.si for m in problem.measured} == {
        "a": Rational(1, 50),
        "M": Rational(3, 2),
        "omega": 30 * pi,
    }
    assert set(problem.symbols) == {"a", "M", "omega"}


def test_values_put_numbers_on_declared_letters_and_keep_those_letters_from_other_numbers(tmp_path: Path) -> None:
    problem = loaded(tmp_path, ("figures: 3\n", "values: {a: 2 cm}\n"), ("[a, 2*a, 3*a]", "[3 cm, 3 cm, 3 cm]"))
    assert [(str(m.symbol), m.number) for m in problem.measured] == [("a", 2), ("b", 3)]


def test_what_prose_mentions_is_placed(tmp_path: Path) -> None:
    statement = loaded(tmp_path).statement
    assert [mention.name for mention in statement.mentions] == ["mass", "sides", "rate"]
    place = statement.place_of("rate")
    assert (place.line, place.column, place.width) == (14, 15, 8)


def test_prose_is_data_and_tex_in_it_is_text(tmp_path: Path) -> None:
    text = r"100% of _it_ # \input{/etc/passwd} \write18{x} $x$ {{ 7*7 }} ~ ^ &"
    problem = loaded(tmp_path, ("  at the rate <<rate>>.", f"  {text}"))
    assert problem.statement.text.endswith(f"{text}\n")


@pytest.mark.parametrize(
    "odd", ["<<mass", "<<>>", "<<mass.__class__>>", "<<mass|x>>", "<% if x %>", "<# x #>", "<<1>>"]
)
def test_whatever_could_be_more_than_a_name_is_refused_in_prose(odd: str, tmp_path: Path) -> None:
    assert faults(tmp_path, edited(("ask: What", f'ask: "{odd}" #'))) == ["23 mention"]


def test_every_fault_of_a_file_and_of_its_names_is_told_at_once(tmp_path: Path) -> None:
    bad = edited(
        ("title:", "titel:"),
        ("points: 10", "points: many"),
        ("[a, 2*a, 3*a]", "[a, q, M]"),
        ("mass: M", "mas: M"),
        ("<<sides>>", "<<sides"),
        ("answer: inertia_tensor", "answer: inertia tensor"),
        ("unit: degree", "unit: degre"),
        ("show: {spin: result}", "show: {spin: none}"),
        ("figures: 3", "figures: 16"),
    )
    assert faults(tmp_path, bad) == [
        "1 unknown-key",
        "3 wrong-type",
        "7 undeclared-symbol",
        "7 wrong-kind",
        "8 unknown-given",
        "13 mention",
        "18 wrong-type",
        "22 unknown-unit",
        "31 wrong-type",
        "32 wrong-type",
    ]


def test_nothing_is_made_of_a_letter_whose_kind_is_not_known(tmp_path: Path) -> None:
    bad = edited(("M: mass", "M: distance"), ("mass: M", "mass: 2*M + q"), ("figures: 3", "figures: 16"))
    assert faults(tmp_path, bad) == ["5 unknown-kind", "32 wrong-type"]


def test_a_fault_of_the_script_is_told_with_those_of_the_problem(tmp_path: Path) -> None:
    assert faults(tmp_path, edited(("title:", "titel:")), "import nowhere\n" + SCRIPT) == ["1 script", "1 unknown-key"]


@given(st.integers(0, len(PROBLEM) - 1), st.integers(0, 12), st.text("ab:-[]{}<>#*&!|'\" \n\t0,", max_size=6))
def test_any_damage_to_the_file_is_told_or_harmless(
    tmp_path_factory: pytest.TempPathFactory, start: int, length: int, put: str
) -> None:
    root = at(tmp_path_factory.getbasetemp() / "damaged", PROBLEM[:start] + put + PROBLEM[start + length :])
    with suppress(Rejected):
        run_solve(load_problem(root, "hw9/block"))


def test_a_script_leaves_no_bytecode_and_is_read_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    for n in (1, 2):
        problem = load_problem(at(tmp_path, script=SCRIPT.replace("sides, mass, axis, rate\n", f"{n}\n")), "hw9/block")
        assert run_solve(problem) == n
    assert sorted(file.name for file in (tmp_path / "problems" / "hw9").iterdir()) == [
        "block.py",
        "block.yaml",
        "set.yaml",
    ]


def test_a_parameter_with_a_default_may_be_left_out(tmp_path: Path) -> None:
    script = SCRIPT.replace("rate: AngularSpeed", "rate: AngularSpeed = 7").replace(
        "return sides, mass, axis, rate", "return rate"
    )
    assert run_solve(load_problem(at(tmp_path, edited(("  rate: omega\n", "")), script), "hw9/block")) == 7
