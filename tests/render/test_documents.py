"""The documents of a set in TeX and in HTML have the same numbers and the same answers."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from derive.building.set_document import document_on_request, document_page
from derive.building.solution import rendered
from derive.course.names import MORE, SHEET
from derive.course.problem_set import problem_set
from derive.errors import Rejected
from derive.render.printing.figure_numbers import equations_numbered, numbered_in_a_row
from derive.render.printing.theorems_once import told_once
from derive.render.rendered import Rendered
from tests.courses import course_in, kept


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return course_in(tmp_path_factory.mktemp("documents"))


@pytest.fixture(scope="module")
def solved(course: Path) -> Rendered:
    return rendered(course, "hw9/block", cache=kept(), documents=MORE)


@pytest.mark.parametrize("kind", MORE)
def test_a_document_is_there_in_tex_and_in_html(course: Path, solved: Rendered, kind: str) -> None:
    heading = problem_set(course, "hw9")
    tex = document_on_request(course, heading, [solved], kind)
    page = document_page(course, heading, [solved], kind)
    once = told_once([("block", "1", solved.documents[f"{kind}.html"])])
    (body,) = numbered_in_a_row(equations_numbered([("1", *once)]))
    assert tex.rstrip().endswith(r"\end{document}") and solved.documents[kind] in tex
    assert page.rstrip().endswith("</html>") and body in page


def test_the_sheet_is_a_page_too_and_has_no_answer(course: Path) -> None:
    sheet = rendered(course, "hw9/block", cache=kept(), documents=[SHEET])
    page = document_page(course, problem_set(course, "hw9"), [sheet], SHEET)
    assert set(sheet.documents) == {"problems.html"} and numbered_in_a_row(sheet.documents.values())[0] in page
    assert "Find the inertia tensor" in page and 'class="display"' not in page


def test_the_key_has_the_numbers_of_the_solutions(solved: Rendered) -> None:
    numbers = re.findall(r"\\eqnumber\{(\d+)\}", solved.latex)
    in_key = re.findall(r"\\eqnumber\{(\d+)\}", solved.documents["key"])
    assert numbers and set(numbers) <= set(in_key)


def test_only_documents_that_are_asked_for_are_made(course: Path) -> None:
    assert set(rendered(course, "hw9/block", cache=kept(), documents=["hints"]).documents) == {"hints", "hints.html"}
    assert rendered(course, "hw9/block", cache=kept()).documents == {}


@pytest.mark.parametrize(
    ("said", "documents"),
    [
        ("[solutions, hints]", (("solutions", "solutions"), ("hints", "hints"))),
        ("{solutions: hw9-solutions, key: for-us}", (("solutions", "hw9-solutions"), ("key", "for-us"))),
    ],
)
def test_a_set_names_its_documents_and_their_files(tmp_path: Path, said: str, documents: object) -> None:
    root = course_in(tmp_path)
    file = root / "problems" / "hw9" / "set.yaml"
    file.write_text(f"{file.read_text()}\ndocuments: {said}\n")
    assert problem_set(root, "hw9").documents == documents


@pytest.mark.parametrize(
    ("said", "complaint"),
    [
        ("[solution]", "did you mean `solutions`"),
        ("{solutions: a/b}", "cannot be the name of a file"),
        ("{solutions: block}", "name of another file"),
        ("{solutions: x, key: x}", "name of another file"),
        ("solutions", "a list of documents"),
        ("[]", "empty"),
        ("[hints]\npapers: [hints]", "write `documents`"),
    ],
)
def test_documents_that_cannot_be_are_refused_at_their_place(tmp_path: Path, said: str, complaint: str) -> None:
    root = course_in(tmp_path)
    file = root / "problems" / "hw9" / "set.yaml"
    file.write_text(f"{file.read_text()}\ndocuments: {said}\n")
    with pytest.raises(Rejected, match=complaint):
        problem_set(root, "hw9")
