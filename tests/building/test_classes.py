"""The documents of a class: each student's own numbers, what is kept, and what students never see."""

from __future__ import annotations

import csv
import json
import os
import re
from collections.abc import Sequence
from pathlib import Path

import pytest
from pypdf import PdfReader

from derive.building import classes
from derive.building.class_record import ClassRecord, class_to_grade
from derive.building.classes import (
    ClassDocuments,
    Made,
    Student,
    class_is_older,
    code_of,
    made_class,
    plain,
    read_roster,
    why_of_class,
)
from derive.building.tex import chosen_engine
from derive.building.workers import Ended
from derive.cli.options import main
from derive.course.variants import chosen_for
from derive.errors import Misused, Rejected
from tests.course.test_variants import bead
from tests.leaks import leaks

NAMES = ("Ada Lovelace", "Emmy Noether")


def roster(folder: Path, text: str) -> Path:
    file = folder / "students.csv"
    file.write_text(text, encoding="utf-8")
    return file


@pytest.mark.parametrize(
    "text",
    [
        "name,code\nAda Lovelace,A1\nEmmy Noether,E2\n",
        "\ufeffcode;name\r\nA1;Ada Lovelace\r\nE2;Emmy  Noether\r\n",
        'Code,Name,group\nA1,"Ada Lovelace",x\nE2, Emmy Noether ,y\n',
        "name\tcode\nAda Lovelace\tA1\n\t\nEmmy Noether\tE2\n",
    ],
)
def test_a_roster_of_any_spreadsheet_is_read(tmp_path: Path, text: str) -> None:
    assert read_roster(roster(tmp_path, text)) == (Student("Ada Lovelace", "A1"), Student("Emmy Noether", "E2"))


def test_a_name_has_the_same_code_however_unicode_encodes_it(tmp_path: Path) -> None:
    composed, decomposed = (read_roster(roster(tmp_path, f"name\n{name}\n")) for name in ("\u00c5sa", "A\u030asa"))
    assert composed == decomposed


def test_without_codes_the_name_gives_the_code(tmp_path: Path) -> None:
    students = read_roster(roster(tmp_path, "name\nAda\nEmmy\n"))
    assert [each.code for each in students] == [code_of("Ada"), code_of("Emmy")]


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ('name,code\n"Ada,A1\nEmmy,E2\n', [2]),
        ("code,name\nA1\n", [2]),
        ("student\nAda\n", [1]),
        ("", [1]),
        ("name\n", [1]),
        ("name\nAda\n\nAda\n", [4]),
        ("name\nAda\nNoether, Emmy\n", [3]),
        ("name,code\nAda,A1\nEmmy,a1\n,C\nLise,../x\n", [3, 4, 5]),
    ],
)
def test_all_errors_of_a_roster_are_reported(tmp_path: Path, text: str, lines: list[int]) -> None:
    with pytest.raises(Rejected) as caught:
        read_roster(roster(tmp_path, text))
    assert [each.place.line for each in caught.value.complaints if each.place] == lines


def test_a_roster_that_is_missing_or_not_text_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "binary.csv").write_bytes(b"\xff\xfe\x00")
    for name in ("none.csv", "binary.csv", "."):
        with pytest.raises(Rejected):
            read_roster(tmp_path / name)


def test_a_class_without_variants_is_warned_of(tmp_path: Path) -> None:
    bead(tmp_path, "{b: [10 cm, 20 cm]}")
    file = tmp_path / "problems" / "week1" / "bead.yaml"
    assert made_class(tmp_path, "week1", [], jobs=1).warnings == []
    file.write_text("".join(line for line in file.read_text().splitlines(True) if not line.startswith("variants:")))
    (warning,) = made_class(tmp_path, "week1", [], jobs=1).warnings
    assert warning.message == "no problem of `week1` has `variants:`, so all students have the same values"


def text_of(pdf: Path) -> str:
    return " ".join(page.extract_text() for page in PdfReader(pdf).pages)


def test_each_student_has_documents_with_own_numbers_and_the_sheet_has_no_answer(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    bead(tmp_path, "{b: [10 cm, 16 cm, 27 cm, 33 cm, 48 cm, 54 cm]}")
    students = [Student(name, code) for name, code in zip(NAMES, ("A1", "E2"), strict=True)]
    report = made_class(tmp_path, "week1", students, seed="3", jobs=1)
    assert (report.made, report.complaints, report.bugs) == (2, [], [])
    build = tmp_path / "build" / "week1"
    with (build / "class" / "answers.csv").open() as file:
        rows = {row["student"]: row for row in csv.DictReader(file)}
    for student in students:
        sheet, solutions = (
            text_of(build / "students" / f"{student.code}.pdf"),
            text_of(build / "class" / f"{student.code}-solutions.pdf"),
        )
        page = (build / "students" / f"{student.code}.html").read_text()
        (length,) = re.findall(r"=\s*(\d+)\s*cm", sheet)
        value = rows[student.code]["value"]
        assert float(value) == pytest.approx((9.81 / (int(length) / 100)) ** 0.5, rel=1e-3)
        assert student.name in sheet and student.name in page and value in solutions
        assert value not in sheet and value not in page
        assert (build / "class" / f"{student.code}-key.pdf").exists()
    assert {file.suffix for file in (build / "students").iterdir()} == {".pdf", ".html"}
    assert {row["formula"] for row in rows.values()} == {"ω_0 = √(g/b)"}
    for row in rows.values():
        answer = {"sympy": "sqrt(g/b)", "text": "√(g/b)", "latex": r"\sqrt{\frac{g}{b}}"}
        page = json.dumps({"answers": {"frequency": {**answer, "number": {"value": row["value"]}}}})
        assert leaks(build / "students", {"json": page}) == []
    assert {each.partition(":")[0] for each in leaks(build / "class", {"json": page})} >= {"E2-solutions.pdf"}
    links = re.findall(r'href="([^"#]*)"', (build / "class" / "index.html").read_text())
    assert all((build / "class" / link).is_file() for link in links if link != "../index.html") and len(links) >= 8

    sheet = build / "students" / "A1.pdf"
    assert (why_of_class(tmp_path, sheet, None) or "").endswith("students/A1.pdf is up to date")
    assert why_of_class(tmp_path, build / "students" / "problems.pdf", None) is None
    made, content = tmp_path / "problems" / "week1" / "bead.yaml", sheet.read_bytes()
    sheet.write_bytes(b"edited")
    assert "a file was edited" in (why_of_class(tmp_path, sheet, None) or "")
    sheet.write_bytes(content)
    made.write_text((before := made.read_text()) + "# edited\n")
    assert "an input of the class has changed" in (why_of_class(tmp_path, sheet, None) or "")
    made.write_text(before)

    monkeypatch.setattr(classes, "_documents_of", lambda *_: pytest.fail("nothing changed"))
    assert made_class(tmp_path, "week1", students, seed="3", jobs=1).made == 0
    (warning,) = made_class(tmp_path, "week1", students[:1], seed="3", jobs=1).warnings
    assert warning.message.endswith("their documents were removed: Emmy Noether (E2)")
    assert made_class(tmp_path, "week1", students[:1], seed="3", jobs=1).warnings == []
    assert not list((build / "students").glob("E2*")) and not list((build / "class").glob("E2*"))
    assert list((build / "students").glob("A1*"))


def test_a_code_cannot_be_the_name_of_the_sheet_of_the_set(tmp_path: Path) -> None:
    bead(tmp_path, "{b: [10 cm, 20 cm]}")
    for code in ("index", "Problems"):
        with pytest.raises(Misused, match="is the name of a document"):
            made_class(tmp_path, "week1", [Student("Ada", code)], jobs=1)


def test_an_error_in_one_variant_stops_no_other_student(tmp_path: Path) -> None:
    with pytest.raises(Rejected):
        bead(tmp_path, "{b: [20 cm, 3 s]}")
    students = [Student(f"Student {number}", f"S{number}") for number in range(4)]
    ended: list[Ended] = []
    report = made_class(tmp_path, "week1", students, jobs=1, ended=ended.append)
    assert report.failed and 0 < report.made < 4
    assert [each.of for each in ended] == [f"{each.name} ({each.code})" for each in students]
    assert [each.how for each in ended].count("made") == report.made
    assert any(note.startswith("in the variant of Student ") for note in report.complaints[0].notes)
    sheets = tmp_path / "build" / "week1" / "students"
    assert len(list(sheets.glob("*.pdf"))) == report.made
    (failed,) = [each.code for each in students if not (sheets / f"{each.code}.pdf").exists()][:1]
    (sheets / f"{failed}.pdf").write_text("of another seed")
    again = made_class(tmp_path, "week1", students, jobs=1)
    assert (again.made, again.kept) == (0, report.made)
    assert any(each.code == "older" and f"({failed})" in each.message for each in again.warnings)
    assert f"{failed}.pdf" not in (tmp_path / "build" / "week1" / "class" / "index.html").read_text()


def test_after_an_interruption_no_input_is_said_to_have_changed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    bead(tmp_path, "{b: [10 cm, 16 cm, 27 cm, 33 cm]}")
    students = [Student(name, code) for name, code in zip(NAMES, ("A1", "E2"), strict=True)]
    monkeypatch.setattr(classes, "AT_ONCE", 1)

    def interrupt(_: Ended) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        made_class(tmp_path, "week1", students, jobs=1, ended=interrupt)
    sheets = tmp_path / "build" / "week1" / "students"
    assert (why_of_class(tmp_path, sheets / "A1.pdf", None) or "").endswith("is up to date")
    assert "did not finish these documents" in (why_of_class(tmp_path, sheets / "E2.pdf", None) or "")
    (warning,) = class_is_older(tmp_path, "week1", chosen_engine(None))
    assert warning.message.endswith("are incomplete: those of Emmy Noether (E2) were not made")


def test_a_student_whose_job_fails_as_a_whole_is_counted_and_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    bead(tmp_path, "{b: [10 cm, 16 cm, 27 cm, 33 cm]}")
    students = [Student(name, code) for name, code in zip(NAMES, ("A1", "E2"), strict=True)]
    documents_of, ended = classes._documents_of, list[Ended]()

    def dies_for_one(shared: ClassDocuments, group: Sequence[Student]) -> list[Made]:
        if students[1] in group:
            os._exit(3)
        return documents_of(shared, group)

    monkeypatch.setattr(classes, "_documents_of", dies_for_one)
    report = made_class(tmp_path, "week1", students, jobs=1, ended=ended.append)
    assert (report.made, report.without) == (1, students[1:])
    assert sorted((each.how, each.of) for each in ended) == [
        ("failed", "Emmy Noether (E2)"),
        ("made", "Ada Lovelace (A1)"),
    ]
    (complaint,) = report.complaints
    assert complaint.code == "worker-died" and "in the variant of Emmy Noether (E2)" in complaint.notes


@pytest.mark.parametrize(
    ("cell", "shown"), [("=1+1", "'=1+1"), ("-2.5", "-2.5"), ("-a", "'-a"), ("@x", "'@x"), ("a", "a"), ("", "")]
)
def test_no_cell_of_the_table_is_a_formula_of_a_spreadsheet(cell: str, shown: str) -> None:
    assert plain(cell) == shown


def test_an_answer_is_graded_with_the_variant_of_its_student(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """The frequency is sqrt(g/b), worked out here from the choice of each student."""
    variations = bead(tmp_path, "{b: [10 cm, 16 cm, 27 cm, 33 cm, 48 cm, 54 cm]}").variations
    rows = []
    for code in ("A1", "E2", "L3"):
        chosen = chosen_for("week1", "bead", variations, code, "3")
        length = float(variations[0].told(chosen["b"]).split()[0]) / 100
        rows += [f"{code},a,{(9.81 / length) ** 0.5:.4g} rad/s", f"{code},a,{(9.81 / length) ** 0.5 * 2:.4g} rad/s"]
    (tmp_path / "answers.csv").write_text("student,part,answer\n" + "\n".join(rows) + "\n")
    of_class = ["--seed", "3", "--roster", str(roster(tmp_path, "name,code\nAda,A1\nEmmy,E2\nLise,L3\n"))]
    main(["--root", str(tmp_path), "grade", "week1/bead", "--answers", str(tmp_path / "answers.csv"), *of_class])
    verdicts = [line.split()[3] for line in capfd.readouterr().out.splitlines()[1:]]
    assert verdicts[::2] == ["equal"] * 3
    assert "equal" not in verdicts[1::2]
    command = ["--root", str(tmp_path), "grade", "week1/bead", rows[0].split(",")[2], *of_class, "--student"]
    assert main([*command, "A1"]) == main([*command, "Ada"]) == 0
    assert len({chosen_for("week1", "bead", variations, code, "3")["b"] for code in ("A1", "E2", "L3")}) > 1


def made_before(root: Path, seed: str = "autumn") -> ClassRecord:
    bead(root, "{b: [10 cm, 16 cm, 27 cm, 33 cm]}")
    record = ClassRecord("week1", seed, {"A1": "Ada Lovelace", "E2": "Emmy Noether"})
    record.save(root)
    return record


def test_the_seed_of_a_class_is_kept_and_another_seed_is_an_error(tmp_path: Path) -> None:
    record = made_before(tmp_path)
    assert ClassRecord.read(tmp_path, "week1") == record == class_to_grade(tmp_path, "week1", None, None)
    with pytest.raises(Misused, match="made with the seed `autumn`, not with `B`"):
        class_to_grade(tmp_path, "week1", "B", None)
    with pytest.raises(Misused) as caught:
        made_class(tmp_path, "week1", [Student("Ada Lovelace", "A1")], seed="B", jobs=1)
    assert "--reseed" in (caught.value.complaints[0].help or "")
    assert ClassRecord.read(tmp_path, "week1") == record


def test_a_seed_without_a_class_needs_the_roster(tmp_path: Path) -> None:
    assert class_to_grade(tmp_path, "week1", None, None) is None
    with pytest.raises(Misused) as caught:
        class_to_grade(tmp_path, "week1", "B", None)
    assert "--roster" in (caught.value.complaints[0].help or "")
    assert class_to_grade(tmp_path, "week1", "B", {"A1": "Ada"}) == ClassRecord("week1", "B", {"A1": "Ada"})


def test_only_students_of_the_class_are_graded(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    made_before(tmp_path)
    rows = ["A1,a,1 rad/s", "emmy noether,a,1 rad/s", "A2,a,1 rad/s", ",a,1 rad/s"]
    (tmp_path / "answers.csv").write_text("student,part,answer\n" + "\n".join(rows) + "\n")
    grade = ["--root", str(tmp_path), "grade", "week1/bead"]
    assert main([*grade, "--answers", str(tmp_path / "answers.csv"), "--format", "csv"]) == 1
    told = capfd.readouterr()
    verdicts = [row["verdict"] for row in csv.DictReader(told.out.splitlines())]
    assert verdicts[:2] != ["not graded"] * 2 and verdicts[2:] == ["not graded"] * 2
    assert "no student with the code or the name `A2`" in told.err
    assert "does not name a student of the class of `week1`" in told.err
    for more in (["--student", "A2"], ["--seed", "autumn"], ["--seed", "B", "--student", "A1"]):
        assert main([*grade, "1 rad/s", *more]) == 2


def test_a_name_is_found_however_unicode_encodes_it_and_two_of_a_name_need_the_code() -> None:
    made = ClassRecord("week1", "", {"O1": "\u00c5sa \u00d6berg", "A1": "Ada", "A2": "Ada"})
    assert made.code_of("A\u030asa  o\u0308berg") == "O1" and made.code_of("Ada") is None
    told = made.unknown("Ada")
    assert told.message.startswith("several students") and told.help is not None and "A1, A2" in told.help


@pytest.mark.long
def test_a_build_warns_of_documents_of_a_class_that_are_older_than_the_set(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    bead(tmp_path, "{b: [20 cm, 30 cm]}")
    (tmp_path / "names.csv").write_text("name\nAda\n")
    make = ["--root", str(tmp_path), "class", "week1", "--roster", str(tmp_path / "names.csv"), "-q"]
    assert main(make) == 0
    capfd.readouterr()
    main(["--root", str(tmp_path), "build", "week1"])
    assert "older" not in capfd.readouterr().err
    file = tmp_path / "problems" / "week1" / "bead.yaml"
    file.write_text(file.read_text().replace("title: A bead", "title: The bead"))
    main(["--root", str(tmp_path), "build", "week1"])
    assert "warning[older]: documents of the class" in capfd.readouterr().err
    assert main(make) == 0
    main(["--root", str(tmp_path), "build", "week1"])
    assert "older" not in capfd.readouterr().err
