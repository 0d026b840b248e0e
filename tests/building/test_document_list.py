"""What students may see, and the list of documents on the page of a set."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path

import pytest

from derive.building.cache import file_digest
from derive.building.document_list import list_again, papers, there_of
from derive.building.files import write
from derive.building.manifest import Manifest
from derive.building.recipe import recipe_of
from derive.building.set_document import document_page, index_page
from derive.building.sets import Options, built_set
from derive.building.solution import rendered
from derive.course.names import DOCUMENTS, SHEET
from derive.course.problem_set import problem_set
from tests.course.test_variants import bead
from tests.fake_course import stand_in_course
from tests.leaks import forms_of_answers, leaks


def test_the_pages_for_students_show_no_answer_and_link_no_solution(tmp_path: Path) -> None:
    bead(tmp_path, "{b: [20 cm, 30 cm]}")
    page = rendered(tmp_path, "week1/bead", draws=True, only=("json", "html"), documents=(SHEET,))
    heading = problem_set(tmp_path, "week1")
    index = index_page(tmp_path, heading, [page], for_students=True)
    folder = tmp_path / "students"
    folder.mkdir()
    (folder / "index.html").write_text(index)
    (folder / "problems.html").write_text(document_page(tmp_path, heading, [page], SHEET))
    solution = {"json": page.texts["json"], "html": page.html}
    assert len(forms_of_answers(solution)) >= 4, "a number, and the formula as text, in TeX and in MathML"
    assert leaks(folder, solution) == []
    (folder / "solution.html").write_text(page.html)
    assert len(leaks(folder, solution)) >= 2, "the search finds the answers of a solution"
    links = re.findall(r'href="([^"#]*)"', index)
    assert set(links) <= {"index.html"}


@pytest.mark.long
def test_no_file_for_students_of_a_whole_build_shows_an_answer(tmp_path: Path) -> None:
    bead(tmp_path, "{b: [20 cm, 30 cm]}")
    report = built_set(tmp_path, "week1", Options(jobs=1, documents=DOCUMENTS), lambda _: None)
    assert not report.failed
    outputs = tmp_path / "build" / "week1"
    texts = {form: (outputs / f"bead.{form}").read_text() for form in ("json", "html")}
    assert {file.name for file in (outputs / "students").iterdir()} == {"index.html", "problems.html", "problems.pdf"}
    assert leaks(outputs / "students", texts) == []
    for name in ("bead.pdf", "key.pdf", "key.html"):
        write(tmp_path / name / name, (outputs / name).read_bytes())
        assert leaks(tmp_path / name, texts), "the search finds the answers of other documents"


def test_the_page_of_a_set_lists_the_documents_that_any_command_wrote(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    course = stand_in_course(tmp_path, monkeypatch)
    built_set(tmp_path, "hw1", Options(documents=("key",)), lambda _: None)
    page = course.outputs / "index.html"

    def listed() -> list[str]:
        there = there_of(course.outputs, [(kind, kind) for kind in DOCUMENTS])
        return [address for paper in papers(tmp_path, "hw1", there) for address, _ in paper.files]

    assert listed() == ["key.pdf", "key.html", "students/index.html"]
    (course.outputs / "report.pdf").write_bytes(b"")
    (course.outputs / "hw1-qti.zip").write_bytes(b"")
    (course.outputs / "class").mkdir()
    (course.outputs / "class" / "index.html").write_text("")
    assert listed() == [
        "report.pdf", "key.pdf", "key.html", "students/index.html", "class/index.html", "hw1-qti.zip",
    ]  # fmt: skip
    list_again(tmp_path, "hw1")
    text = page.read_text()
    assert text.startswith("<!-- hw1/one -->") and re.findall('href="(.*?)"', text) == listed()
    assert Manifest.read(course.outputs).holds("index.html")
    page.write_text(text + "edited")
    (course.outputs / "hw1-qti.zip").unlink()
    list_again(tmp_path, "hw1")
    assert page.read_text() == text + "edited", "an edited page stays"


def test_the_page_of_a_set_marks_what_is_older_than_its_problems(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    course = stand_in_course(tmp_path, monkeypatch)
    built_set(tmp_path, "hw1", Options(documents=("key", "solutions")), lambda _: None)
    (course.outputs / "hw1-qti.zip").write_bytes(b"")
    inputs = {"problems/hw1/one.yaml": file_digest(course.folder / "one.yaml")}
    of_set = Manifest.read(course.outputs).of_set
    recipe = recipe_of(tmp_path, of_set=of_set)
    record = partial(Manifest.was_exported, file="hw1-qti.zip", recipe=recipe, inputs=inputs, of_set=of_set)
    list_again(tmp_path, "hw1", record)

    def marked() -> list[str]:
        page = (course.outputs / "index.html").read_text()
        return re.findall(r'<a href="([^"]*)">[^<]*</a> [^\n]*older than the problems', page)

    assert marked() == []
    course.problem("one", "another text")
    built_set(tmp_path, "hw1", Options(documents=("solutions",)), lambda _: None)
    assert marked() == ["key.pdf", "hw1-qti.zip"]
    built_set(tmp_path, "hw1", Options(), lambda _: None)
    assert marked() == ["hw1-qti.zip"]
    course.problem("one", "first")
    built_set(tmp_path, "hw1", Options(), lambda _: None)
    assert marked() == []


def test_the_documents_have_names_in_the_language_of_the_set(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    stand_in_course(tmp_path, monkeypatch)
    (tmp_path / "course.yaml").write_text("language: de\n")
    found = papers(tmp_path, "hw1", [("key", "key")])
    assert [paper.name for paper in found] == ["Musterlösung für die Lehrenden", "Für Studierende"]
