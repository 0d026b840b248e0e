"""A problem file as checked values, its script, its set."""

from __future__ import annotations

import json
import sys
from contextlib import suppress
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sympy import Rational, pi

from derive.course.problem import Problem, load_problem, run_solve
from derive.course.problem_set import problem_ids, problem_set, set_ids
from derive.course.prose import Mention, read_prose
from derive.course.reference.statements import reference_schema
from derive.course.schema import keys_of
from derive.course.written import ANY_OUTCOME, ProblemKeys, problem_schema
from derive.course.yaml_tree import Scalar, Source
from derive.errors import DeriveError, Faults, Misused, Rejected

PROBLEM = """\
title: A block turning about its long diagonal
solve: block.py
points: 10

symbols: {a: length, M: mass, omega: angular speed}
given:
  sides: [a, 2*a, 3*a]
  mass: M
  axis: diagonal
  rate: omega

statement: >
  A uniform block of mass <<mass>> and sides <<sides>> turns
  at the rate <<rate>>.

parts:
  - ask: Find the inertia tensor about the centre.
    answer: inertia_tensor
    points: 3
  - ask: Find the angle between <<spin>> and <<angular_momentum>>.
    answer: angle_between
    form: {unit: degree, figures: 4}
  - ask: What torque must the bearings supply?
    answer: [torque, magnitude]
    form: {magnitude: {unit: N m}}

wording:
  torque:
    zero: No torque is needed.
  spin: It turns.
show: {spin: result}
figures: 3
note: Balance your wheels.
"""
SCRIPT = '''\
"""A script for the tests."""

from derive.given import AngularSpeed, Direction, Lengths, Mass


def solve(sides: Lengths, mass: Mass, axis: Direction, rate: AngularSpeed):
    return sides, mass, axis, rate
'''
SET = "course: Physics 311\ntitle: Homework 9\nproblems: [block]\n"


def at(root: Path, problem: str = PROBLEM, script: str = SCRIPT, heading: str = SET) -> Path:
    folder = root / "problems" / "hw9"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "block.yaml").write_text(problem, encoding="utf-8")
    (folder / "block.py").write_text(script, encoding="utf-8")
    (folder / "set.yaml").write_text(heading, encoding="utf-8")
    return root


def edited(*edits: tuple[str, str]) -> str:
    text = PROBLEM
    for old, new in edits:
        assert old in text
        text = text.replace(old, new, 1)
    return text


def loaded(root: Path, *edits: tuple[str, str]) -> Problem:
    return load_problem(at(root, edited(*edits)), "hw9/block")


def faults(root: Path, problem: str = PROBLEM, script: str = SCRIPT) -> list[str]:
    with pytest.raises(Rejected) as caught:
        run_solve(load_problem(at(root, problem, script), "hw9/block"))
    return [f"{c.place.line if c.place else 0} {c.code}" for c in caught.value.complaints]


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


def test_a_form_is_for_all_answers_of_a_part_or_for_one(tmp_path: Path) -> None:
    _, angle, torque = loaded(tmp_path).parts
    assert (angle.form_of("angle_between").units, angle.form_of("angle_between").figures) == (("degree",), 4)
    assert (torque.form_of("torque").units, torque.form_of("magnitude").units) == ((), ("N m",))


def test_wording_is_by_outcome_or_for_any(tmp_path: Path) -> None:
    wording = loaded(tmp_path).wording
    assert wording["torque"]["zero"].text == "No torque is needed."
    assert wording["spin"][ANY_OUTCOME].text == "It turns."


def test_what_prose_mentions_is_placed(tmp_path: Path) -> None:
    statement = loaded(tmp_path).statement
    assert [mention.name for mention in statement.mentions] == ["mass", "sides", "rate"]
    place = statement.place_of("rate")
    assert (place.line, place.column, place.width) == (14, 15, 8)


def test_prose_is_data_and_tex_in_it_is_text(tmp_path: Path) -> None:
    text = r"100% of _it_ # \input{/etc/passwd} \write18{x} $x$ {{ 7*7 }} ~ ^ &"
    problem = loaded(tmp_path, ("  at the rate <<rate>>.", f"  {text}"))
    assert problem.statement.text.endswith(f"{text}\n")


def test_pieces_of_prose_are_all_of_it_in_order() -> None:
    text = "a << mass >>b<<rate>> >> c"
    prose = read_prose(Scalar(text, "", 0, len(text), Source("p.yaml", text)), "ask", Faults())
    assert prose is not None
    said = [piece.name if isinstance(piece, Mention) else piece for piece in prose.pieces]
    assert said == ["a ", "mass", "b", "rate", " >> c"]


@pytest.mark.parametrize(
    "odd", ["<<mass", "<<>>", "<<mass.__class__>>", "<<mass|x>>", "<% if x %>", "<# x #>", "<<1>>"]
)
def test_whatever_could_be_more_than_a_name_is_refused_in_prose(odd: str, tmp_path: Path) -> None:
    assert faults(tmp_path, edited(("ask: What", f'ask: "{odd}" #'))) == ["23 mention"]


@pytest.mark.parametrize(
    ("total", "parts", "points"),
    [("points: 10\n", "points: 3", 10), ("", "points: 2.5", Fraction(5, 2)), ("", "points: 0", 0)],
)
def test_points_are_stated_or_summed(total: str, parts: str, points: Fraction, tmp_path: Path) -> None:
    assert loaded(tmp_path, ("points: 10\n", total), ("points: 3", parts)).points == points


@pytest.mark.parametrize("points", ["points: 11", "points: 3.3", "points: -1", "points: 1e1", "points: [1]", "points:"])
def test_points_that_do_not_add_up_or_are_none_are_refused(points: str, tmp_path: Path) -> None:
    (fault,) = faults(tmp_path, edited(("points: 3", points)))
    assert fault in ("3 points", "19 wrong-type", "19 missing-value")


def test_points_of_all_parts_must_reach_the_total(tmp_path: Path) -> None:
    every = edited(("answer: angle", "points: 3\n    answer: angle"), ("answer: [", "points: 3\n    answer: ["))
    assert faults(tmp_path, every) == ["3 points"]
    exact = every.replace("points: 10", "points: 9")
    assert load_problem(at(tmp_path, exact), "hw9/block").points == 9


def test_every_fault_of_a_file_and_of_its_names_is_told_at_once(tmp_path: Path) -> None:
    bad = edited(
        ("title:", "titel:"),
        ("points: 10", "points: many"),
        ("M: mass", "M: mas"),
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
        "5 unknown-kind",
        "7 undeclared-symbol",
        "7 wrong-kind",
        "8 unknown-given",
        "13 mention",
        "18 wrong-type",
        "22 unknown-unit",
        "31 wrong-type",
        "32 wrong-type",
    ]


def test_a_fault_of_the_script_is_told_with_those_of_the_problem(tmp_path: Path) -> None:
    assert faults(tmp_path, edited(("title:", "titel:")), "import nowhere\n" + SCRIPT) == ["1 script", "1 unknown-key"]


@pytest.mark.parametrize(
    ("edit", "fault"),
    [
        (("parts:\n", "parts: none\nparty:\n"), "unknown-key"),
        (("  - ask: Find the inertia tensor about the centre.\n", "  - \n"), "missing-key"),
        (("answer: angle_between", "answer: []"), "missing-value"),
        (("answer: [torque, magnitude]", "answer: [magnitude, magnitude]"), "duplicate-answer"),
        (("form: {magnitude: {unit: N m}}", "form: {torq: {unit: N m}}"), "unknown-key"),
        (("form: {magnitude: {unit: N m}}", "form: {magnitude: {}, torque: N m}"), "wrong-type"),
        (("form: {magnitude: {unit: N m}}", "form: N m"), "wrong-type"),
        (("solve: block.py", "solve: ../hw9/block.py"), "wrong-type"),
        (("solve: block.py", "solve: blok.py"), "missing-file"),
        (("symbols: {a", "symbols: {sin: length, a"), "symbol"),
        (("show: {spin: result}", "show: [spin]"), "wrong-type"),
        (("title: A block", "title: A #1 block"), "comment-in-text"),
        (("title: A block turning about its long diagonal", "title:"), "missing-value"),
        (("note: Balance your wheels.", "note: {a: b}"), "wrong-type"),
        (("  axis: diagonal\n", ""), "missing-given"),
        (("  rate: omega", "  rate: omega\n  colour: red"), "unknown-given"),
    ],
)
def test_a_key_of_the_wrong_shape_is_refused(edit: tuple[str, str], fault: str, tmp_path: Path) -> None:
    assert fault in [found.partition(" ")[2] for found in faults(tmp_path, edited(edit))]


def test_optional_mappings_may_be_empty(tmp_path: Path) -> None:
    assert loaded(tmp_path, ("show: {spin: result}", "show:")).show == {}


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


# -- ids and sets -----------------------------------------------------------------------------------------------------


def test_ids_are_the_problem_files_and_nothing_beside_them(tmp_path: Path) -> None:
    folder = at(tmp_path) / "problems" / "hw9"
    (folder / "reference.yaml").write_text("")
    (folder / "odd name.yaml").write_text("")
    (tmp_path / "problems" / "stray.yaml").write_text("")
    assert (problem_ids(tmp_path), set_ids(tmp_path)) == (["hw9/block"], ["hw9"])


@pytest.mark.parametrize(
    ("wanted", "help_line"),
    [
        ("hw9/blok", "did you mean `hw9/block`?"),
        ("block", "did you mean `hw9/block`?"),
        ("hw9/BLOCK", "did you mean `hw9/block`?"),
        ("hw9/set", "`derive list` shows the problems"),
        ("hw9/../hw9/block", "did you mean `hw9/block`?"),
        ("../../etc/passwd", "`derive list` shows the problems"),
        ("", "`derive list` shows the problems"),
    ],
)
def test_a_problem_that_does_not_exist_is_met_with_the_nearest(wanted: str, help_line: str, tmp_path: Path) -> None:
    with pytest.raises(Misused) as caught:
        load_problem(at(tmp_path), wanted)
    (complaint,) = caught.value.complaints
    assert (complaint.code, complaint.help, caught.value.exit_code) == ("no-such-problem", help_line, 2)


def test_a_set_lists_its_problems_in_order(tmp_path: Path) -> None:
    at(tmp_path, heading="course: P\ntitle: T\ndate: 2026-11-21\ninstructor: N. N.\nproblems: [top, block]\n")
    (tmp_path / "problems" / "hw9" / "top.yaml").write_text(PROBLEM)
    found = problem_set(tmp_path, "hw9")
    assert (found.problems, found.date, found.inputs) == (
        ("hw9/top", "hw9/block"),
        "2026-11-21",
        ("problems/hw9/set.yaml",),
    )


def test_every_fault_of_a_set_is_told_at_once(tmp_path: Path) -> None:
    at(tmp_path, heading="corse: P\ntitle:\nproblems: [blok, block, block, [x]]\nday: x\n")
    with pytest.raises(Rejected) as caught:
        problem_set(tmp_path, "hw9")
    assert [c.code for c in caught.value.complaints] == [
        "unknown-key",
        "missing-value",
        "no-such-problem",
        "duplicate-problem",
        "wrong-type",
        "unknown-key",
    ]


def test_a_set_that_does_not_exist_is_met_with_the_nearest(tmp_path: Path) -> None:
    with pytest.raises(DeriveError, match="did you mean `hw9`") as caught:
        problem_set(at(tmp_path), "hw8")
    assert caught.value.exit_code == 2


# -- schema -----------------------------------------------------------------------------------------------------------


def test_the_schema_for_editors_is_current() -> None:
    file = Path(__file__).parents[2] / "templates" / "problem.schema.json"
    assert file.read_text(encoding="utf-8") == problem_schema(), "run `make schemas`"


def test_the_schema_of_references_is_current() -> None:
    file = Path(__file__).parents[2] / "templates" / "reference.schema.json"
    assert file.read_text(encoding="utf-8") == reference_schema(), "run `make schemas`"


def test_the_schema_knows_every_key_and_what_is_required() -> None:
    schema = json.loads(problem_schema())
    assert set(schema["properties"]) == set(keys_of(ProblemKeys))
    assert schema["required"] == ["title", "solve", "statement", "parts"]
