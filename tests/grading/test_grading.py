"""Grading stays within its limits, accepts no guesses, reads what derive prints, and writes harmless tables."""

from __future__ import annotations

import csv
import io
import json
from fractions import Fraction
from pathlib import Path

import pytest

from derive.building.solution import answer_key
from derive.cli.options import main
from derive.errors import Rejected
from derive.grading.grading import grade
from derive.grading.outcomes import Outcome, share_of
from derive.grading.table import harmless, read_table, written_table
from derive.render.notation.latex import latex
from tests.grading.test_answers import graded, key
from tests.stock.described import course_with

TOO_LARGE = [
    "9^{9^{9^{9}}}",
    "(((10^40)^40)^40)^40",
    "(M + a + omega)^40",
    "((M + a)^40)^40",
    "(" * 900 + "M" + ")" * 900,
    "x" * 5000,
    "M+" * 900 + "M",
    r"\sqrt{" * 45 + "M" + "}" * 45,
    "((49!)^40)^2",
    "1e99999",
    ";".join("M" for _ in range(100)),
]
HOSTILE = [
    '__import__("os").system("touch pwned")',
    r"\input{/etc/passwd}",
    r"\def\a{\a\a}\a",
    "\x00\x01",
    "M\u202eomega",
    "((((",
    r"\frac{7}{24",
    "1/0",
    "log(0)",
    "|" * 50,
    r"\left(" * 30,
    "= = =",
]
GUESSES = [
    "7/24 M a^2 w^2 or 7/12 M a^2 w^2",
    "7/24 M a^2 w^2, 7/12 M a^2 w^2, M a^2 w^2",
    "7/12 M a^2 w^2 = 7/24 M a^2 w^2",
    r"\pm 7/24 M a^2 w^2",
    "T",
    "T = T",
    "T + 0",
    "7/24 x y^2 z^2",
    "0.3 M a^2 w^2",
]


@pytest.mark.parametrize("answer", TOO_LARGE, ids=range(len(TOO_LARGE)))
def test_a_large_answer_is_refused_in_little_time(answer: str) -> None:
    verdict = graded("hw9/block", "b", answer).verdict
    assert (verdict.outcome, verdict.because[:9]) == (Outcome.UNREADABLE, "too large")


@pytest.mark.parametrize("answer", HOSTILE, ids=range(len(HOSTILE)))
def test_a_hostile_answer_is_unreadable_and_nothing_else_happens(answer: str) -> None:
    assert graded("hw9/block", "b", answer).verdict.outcome is Outcome.UNREADABLE


@pytest.mark.parametrize("answer", GUESSES)
def test_a_guess_or_a_name_is_no_right_answer(answer: str) -> None:
    assert not graded("hw9/block", "b", answer).verdict.is_right


def test_the_caret_is_under_what_is_not_read() -> None:
    text, caret = graded("hw9/block", "b", r"7/24 M \foo a^2").verdict.marked.splitlines()
    assert text[len(caret) - len(caret.lstrip()) :].startswith(r"\foo")


def test_the_reading_shows_what_was_read_for_each_letter() -> None:
    found = graded("hw9/block", "b", "7/24 M a^2 w^2")
    assert found.verdict.reading == r"\frac{7}{24} M a^2 \omega^2 (`w` is read as omega)"


def test_a_part_and_an_answer_of_it_have_several_names() -> None:
    answers = key("hw9/block")
    for name in ("b", "(b)", "B", "2", "part b", " b) "):
        found = answers.part(name)
        assert found is not None
        assert found.label == "b"
    for name in ("d(2)", "4(2)", "d.2", "d(magnitude)"):
        found = answers.part(name)
        assert found is not None
        assert [target.key for target in found.targets] == ["magnitude"]
    assert [answers.part(name) for name in ("z", "", "9", "d(7)", "b b", "²")] == [None] * 6


@pytest.mark.parametrize("problem", ["hw9/block", "library/cart_pendulum", "library/bullet", "library/wedge"])
def test_what_derive_prints_is_right_and_with_another_sign_it_is_not(problem: str) -> None:
    for part in key(problem).parts:
        for i, target in enumerate(part.targets):
            text = latex(key(problem).notation.result(target.value))
            assert graded(problem, f"{part.label}({i + 1})", text).verdict.outcome is Outcome.EQUAL, text
            if target.kind in ("energy", "speed", "acceleration", "angular speed") and target.value != 0:
                wrong = graded(problem, f"{part.label}({i + 1})", f"-({text})")
                assert not wrong.verdict.is_right, text


def test_points_follow_the_rubric() -> None:
    own, whole = Fraction(1), Fraction(3)
    assert share_of(Outcome.CONVENTION, own, whole) == 3
    assert share_of(Outcome.SIGN, own, whole) == 2
    assert share_of(Outcome.FACTOR, whole, whole) == Fraction(3, 2)
    assert share_of(Outcome.ANOTHER, own, whole) == 0


# --- tables ---


def test_no_cell_of_the_table_is_run_by_a_spreadsheet() -> None:
    table = read_table(b'student,part,answer\n"=cmd()",b,-M\n@x,b,"+1"\n', "answers.csv", "hw9/block")
    assert [row.answer for row in table.rows] == ["-M", "+1"]
    text = written_table(table, [("sign", "=1", "-M", "1"), ("different", "", "@", "0")])
    cells = [cell for row in csv.reader(io.StringIO(text)) for cell in row]
    assert not [cell for cell in cells if cell.startswith(("=", "+", "-", "@"))]
    again = read_table(text.encode(), "graded.csv", "hw9/block")
    assert [row.answer for row in again.rows] == ["-M", "+1"]
    assert harmless("  =1") == "'  =1"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"name,x\n1,2\n", "has no column `part`"),
        (b"\xff\xfe,\n", "is not in UTF-8"),
        (b"part,answer\n" + b"b,1\n" * 100_002, "has more than 100000 rows"),
    ],
)
def test_a_table_that_is_not_one_of_answers_is_refused(content: bytes, message: str) -> None:
    with pytest.raises(Rejected, match=message):
        read_table(content, "answers.csv", "hw9/block")


def test_other_separators_and_missing_cells_are_read() -> None:
    table = read_table("\ufeffStudent;Part;Answer\nAda;b;7/24 M, or so\nBob;b\n\n".encode(), "x.csv", "hw9/block")
    assert [(row.student, row.answer) for row in table.rows] == [("Ada", "7/24 M, or so"), ("Bob", "")]


def test_a_row_is_named_by_the_line_where_it_begins() -> None:
    table = read_table(b'student,part,answer\n\nAda,b,"1\nm"\nBob,b,"2\n\nm"\nEve,b,3\n', "x.csv", "hw9/block")
    assert [(row.student, row.line) for row in table.rows] == [("Ada", 3), ("Bob", 5), ("Eve", 8)]


def test_one_bad_row_stops_no_other(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    answers = tmp_path / "answers.csv"
    answers.write_text(
        "student,problem,part,answer\nA,block,b,7/24 M a^2 w^2\nB,block,b,9^{9^{9}}\nC,block,q,1\nD,blok,b,1\n"
        "E,block,(c),21.64°\nF,block,b,(1, 2)\n",
        encoding="utf-8",
    )
    assert main(["grade", "hw9", "--answers", str(answers), "--format", "json"]) == 1
    out, err = capfd.readouterr()
    verdicts = [row["verdict"] for row in json.loads(out)["rows"]]
    assert verdicts == ["equal", "unreadable", "not graded", "not graded", "equal", "not graded"]
    assert "no problem is called `blok`" in err
    assert "has no part `q`" in err
    assert f"line 7 of `{answers}`: the row has more cells than the first line" in err


def test_the_table_of_the_answers_is_not_replaced(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    answers = tmp_path / "answers.csv"
    answers.write_text("student,problem,part,answer\nA,block,b,1\n")
    assert main(["grade", "hw9", "--answers", str(answers), "-o", str(tmp_path / "." / "answers.csv")]) == 2
    assert "is the table of the answers itself" in capfd.readouterr().err
    assert answers.read_text().endswith("A,block,b,1\n")


PLATE = """\
title: A plate
solve: rotation
symbols: {m: mass, a: length, omega: angular speed}
given:
  body: {shape: plate, sides: [a, 2*a], mass: m}
  rate: omega
  along: [1, 2, 0]
statement: A plate <<a>>, <<m>>, <<omega>>.
parts: [{ask: Find L., answer: angular_momentum}]
values: {a: 20 cm, m: 2 kg, omega: 30 rad/s}
"""


def test_the_components_of_a_vector_are_judged_as_numbers_with_its_unit(tmp_path: Path) -> None:
    of_plate = answer_key(course_with(tmp_path, PLATE), "trial/one")

    def outcome(answer: str) -> Outcome:
        return grade(answer, of_plate.parts[0], of_plate).verdict.outcome

    assert outcome("(0.3578, 0.1789, 0) kg m^2/s") is Outcome.EQUAL
    assert outcome(r"\begin{pmatrix} 0.358 \\ 0.179 \\ 0 \end{pmatrix} \mathrm{kg\,m^2/s}") is Outcome.EQUAL
    assert outcome("(0,3578; 0,1789; 0) kg m^2/s") is Outcome.EQUAL
    assert outcome("(0,358, 0,179, 0) kg m^2/s") is Outcome.EQUAL
    assert outcome(r"\begin{pmatrix} 0,358 \\ 0,179 \\ 0 \end{pmatrix} kg m^2/s") is Outcome.EQUAL
    assert outcome("(0,3578; 0,1788; 0) kg m^2/s") is Outcome.DIFFERENT
    assert outcome("m a^2 omega/(6 sqrt(5)) (2; 1,0; 0)") is Outcome.EQUAL
    assert outcome("m a^2 omega/(6 sqrt(5)) (2, 1, 0)") is Outcome.EQUAL
    assert outcome("(0.3578, 0.1788, 0) kg m^2/s") is Outcome.DIFFERENT
    assert outcome("(-0.3578, -0.1789, 0) kg m^2/s") is Outcome.SIGN
    assert outcome("(0.3578, 0.1789, 0)") is Outcome.DIMENSION
    assert outcome("(0.3578, 0.1789) kg m^2/s") is not Outcome.EQUAL


def test_an_answer_may_begin_with_a_minus_sign(capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["grade", "hw9/block", "--part", "b", "-omega^2*M"]) == 1
    assert "read as -\\omega^2 \\cdot M" in capfd.readouterr().out


def test_a_part_that_does_not_exist_is_answered_with_the_parts(capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["grade", "hw9/block", "--part", "z", "1"]) == 2
    assert "(b) Find the kinetic energy." in capfd.readouterr().err


def test_an_answer_that_lacks_a_result_is_not_equal(capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["grade", "library/yoyo", "--part", "b", "2/3 g"]) == 1
    told = capfd.readouterr().out
    assert "missing term" in told and "1 of 2 answers given, no answer to: S" in told and "credit: 2 of 4" in told
