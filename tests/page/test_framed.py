"""The results that a part asks for are framed, and no framed formula repeats another one."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.solution import rendered
from derive.errors import Rejected
from derive.page.document import document_of
from derive.page.template import templates_of
from derive.page.tree import Display, Document
from derive.page.wording import Text, Verdict, phrases, with_verdict
from derive.render.notation.notation import Notation
from derive.render.notation.text import plain
from derive.render.printing.lines import printed_lines
from derive.steps.step import Level
from tests.courses import ROOT, course_in, rendered_once, solved_once
from tests.stock.described import PENDULUM, course_with, edited

Formula = tuple[str, str, str]


def formulas(document: Document) -> list[tuple[bool, Formula]]:
    found: list[tuple[bool, Formula]] = []
    for part in document.parts:
        for display in (block for block in part.blocks if isinstance(block, Display)):
            for group in display.groups:
                left = ""
                for line in printed_lines(group, Notation({}), 1e9):
                    left = plain(line.left) if line.left is not None else left
                    within = len(line.sides) - min(line.framed, 1)  # the result, at the end of a framed equation
                    sides = enumerate(line.sides)
                    found += [(i >= within, (left, relation, plain(side))) for i, (relation, side) in sides]
    return found


def repeated(document: Document) -> list[Formula]:
    found = formulas(document)
    return [formula for i, (framed, formula) in enumerate(found) if framed and formula in [f for _, f in found[:i]]]


@pytest.mark.parametrize("level", Level)
@pytest.mark.parametrize("name", ["block", "cone", "euler", "slab", "top"])
def test_no_framed_formula_repeats_one_above_it(name: str, level: Level, tmp_path: Path) -> None:
    problem, solved = solved_once(course_in(tmp_path, problem=name), f"hw9/{name}")
    words = phrases(templates_of(ROOT))
    document, _ = document_of(problem, solved.derivation, solved.values, words, level, drawings=solved.drawings)
    assert any(framed for framed, _ in formulas(document))
    assert repeated(document) == []


def test_a_second_derivative_that_only_decides_stability_is_not_framed(tmp_path: Path) -> None:
    asked = edited(PENDULUM, ("answer: equations_of_motion", "answer: [equilibria, stability]"))
    page = rendered(course_with(tmp_path, asked), "trial/one", only={"text"}).texts["text"]
    assert page.count("  * ") == 2, "one frame for each equilibrium"
    assert not any("d²U/d" in line for line in page.splitlines() if line.startswith("  * "))
    assert "is stable." in page and "is unstable." in page


def test_a_verdict_that_is_asked_is_framed_as_a_word(tmp_path: Path) -> None:
    asked = edited(PENDULUM, ("answer: equations_of_motion", "answer: [equilibria, stability]"))
    page = rendered(course_with(tmp_path / "asked", asked), "trial/one", only={"latex", "html", "markdown"})
    assert page.latex.count(r"\verdict{stable}") == page.latex.count(r"\verdict{unstable}") == 1
    assert page.html.count('<span class="verdict">stable</span>') == 1
    assert "the equilibrium is **stable**." in page.texts["markdown"]
    unboxed = edited(asked, ("stability]\n", "stability]\n    box: equilibria\n"))
    assert r"\verdict" not in rendered(course_with(tmp_path / "unboxed", unboxed), "trial/one", only={"latex"}).latex


def test_a_sentence_with_two_verdicts_states_a_condition() -> None:
    words = phrases(templates_of(ROOT))
    condition = (Text("It is stable if this is positive, and unstable if it is negative."),)
    assert with_verdict(condition, words) == condition
    assert with_verdict((Text("so it is stable."),), words) == (Text("so it is "), Verdict("stable"), Text("."))


def test_a_part_boxes_only_the_answers_that_it_names(tmp_path: Path) -> None:
    asked = edited(PENDULUM, ("answer: equations_of_motion", "answer: [equations_of_motion, potential_energy]"))
    frames = {}
    for box in ("", "    box: potential_energy\n", "    box: []\n"):
        text = edited(asked, ("potential_energy]\n", f"potential_energy]\n{box}"))
        page = rendered(course_with(tmp_path / str(len(box)), text), "trial/one", only={"text"}).texts["text"]
        frames[box.strip()] = [line for line in page.splitlines() if line.startswith("  * ")]
    assert len(frames[""]) == 2
    assert [line.split()[1] for line in frames["box: potential_energy"]] == ["U"]
    assert frames["box: []"] == []


def test_a_box_names_an_answer_of_its_part(tmp_path: Path) -> None:
    asked = edited(PENDULUM, ("answer: equations_of_motion\n", "answer: equations_of_motion\n    box: period\n"))
    with pytest.raises(Rejected, match="this part has no answer `period`"):
        rendered(course_with(tmp_path, asked), "trial/one", only={"text"})


def test_the_number_of_an_inequality_is_framed_without_the_formula() -> None:
    lines = rendered_once(ROOT, "hw9/top", only={"text"}).texts["text"].splitlines()
    (number,) = [line for line in lines if "28.00 rad/s" in line and line.startswith("  * ")]
    assert number.split()[:3] == ["*", "S", "≥"] and "√" not in number
