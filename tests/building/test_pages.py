"""The PDF itself: typeset for real with the engine of the wheel, read back, and the answers found in it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from pypdf import PdfReader

from derive.building.set_document import problem_document, set_document
from derive.building.tex import chosen_engine, typeset
from derive.course.problem_set import problem_set
from tests.courses import course_in, rendered_once


def squeezed(path: Path) -> str:
    return re.sub(r"\s+", "", "".join(page.extract_text() for page in PdfReader(path).pages))


@pytest.fixture(scope="module")
def pdf(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = course_in(tmp_path_factory.mktemp("course"))
    target = root / "block.pdf"
    typeset(
        problem_document(root, rendered_once(root, "hw9/block"), problem_set(root, "hw9")), target, chosen_engine(None)
    )
    return target


def test_the_answers_stand_in_the_pdf(pdf: Path) -> None:
    text = squeezed(pdf)
    assert "21.64" in text
    assert "0.92951" in text
    assert "0.9295" in text
    assert "397" in text


def test_every_part_and_every_equation_number_stands_in_the_pdf(pdf: Path) -> None:
    text = squeezed(pdf)
    for label in "abcd":
        assert f"({label})" in text
    for number in range(1, 24):
        assert f"({number})" in text
    assert "(24)" not in text


def test_references_are_links_within_the_document(pdf: Path) -> None:
    reader = PdfReader(pdf)
    links = [
        annotation.get_object()
        for page in reader.pages
        for annotation in page.get("/Annots", [])
        if annotation.get_object()["/Subtype"] == "/Link"
    ]
    targets = set(reader.named_destinations)
    destinations = {str(link["/A"]["/D"]) for link in links if "/A" in link and "/D" in link["/A"]}
    assert destinations, "there is at least one reference"
    assert destinations <= targets


def test_the_set_has_a_cover_block_and_its_problem(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    target = root / "solutions.pdf"
    typeset(
        set_document(root, problem_set(root, "hw9"), [rendered_once(root, "hw9/block")]), target, chosen_engine(None)
    )
    text = squeezed(target)
    assert "Homework9" in text
    assert "Ablockturningaboutalongdiagonal" in text


def test_a_wide_sum_is_broken_and_stays_as_large_as_the_rest(tmp_path: Path) -> None:
    edits = {"[a, 2*a, 3*a]": "[a, b, c]", "{a: length,": "{a: length, b: length, c: length,"}
    root = course_in(tmp_path, edits)
    solution = rendered_once(root, "hw9/block")
    assert r"\Bigl(" in solution.latex
    shrunk = re.findall(r"\\fit\{.*", solution.latex)
    assert all(r"\sqrt" in line for line in shrunk), "a root cannot be broken"
    target = root / "block.pdf"
    typeset(problem_document(root, solution, problem_set(root, "hw9")), target, chosen_engine(None))
    assert target.stat().st_size > 50_000
