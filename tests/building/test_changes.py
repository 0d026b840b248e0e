"""In what two pages differ: each sort of change, and none where there is none."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from derive.building.changes import ADDED, CHANGED, EQUAL, REMOVED, Change, changes
from tests.courses import course_in, rendered_once


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, Any]:
    return page_of(tmp_path_factory.mktemp("block"))


def page_of(folder: Path, edits: Mapping[str, str] | None = None) -> dict[str, Any]:
    text = rendered_once(course_in(folder, edits), "hw9/block", only={"json"}).texts["json"]
    found: dict[str, Any] = json.loads(text)
    return found


def since(page: Mapping[str, Any], **edits: Any) -> list[Change]:
    return changes(page, {**page, **edits})


def told(found: list[Change], of: str) -> list[tuple[str, str, str]]:
    return [(change.where, change.before, change.after) for change in found if change.of == of]


def test_a_page_does_not_differ_from_itself(page: Mapping[str, Any]) -> None:
    assert changes(page, json.loads(json.dumps(page))) == []


def test_another_edge_changes_what_rests_on_it(page: Mapping[str, Any], tmp_path: Path) -> None:
    found = changes(page, page_of(tmp_path, {"[a, 2*a, 3*a]": "[a, 2*a, 2*a]"}))
    assert told(found, "given") == [("sides", "[a, 2*a, 3*a]", "[a, 2*a, 2*a]")]
    answers = {where: (before, after) for where, before, after in told(found, "answer")}
    assert answers["magnitude"] == ("|τ⃗| = √42/28 M a² ω²", "|τ⃗| = M a² ω²/(9√2)")
    (density,) = (change for change in found if change.of == "step" and change.where == "density")
    assert density.how == CHANGED
    assert density.facets[0] == ("result", "M/(6a³)", "M/(4a³)")
    outcomes = {c.where: facet[1:] for c in found if c.of == "step" for facet in c.facets if facet[0] == "outcome"}
    assert outcomes["inertia_tensor"] == ("diagonal", "two_equal")
    assert any(change.of == "sentence" for change in found)


def test_other_words_change_a_sentence_and_nothing_else(page: Mapping[str, Any], tmp_path: Path) -> None:
    found = changes(page, page_of(tmp_path, {"Find the inertia tensor": "Compute the inertia tensor"}))
    assert [(change.of, change.where) for change in found] == [("sentence", "part a, question")]
    assert found[0].words[:2] == ((REMOVED, "Find"), (ADDED, "Compute"))
    assert found[0].words[2][0] == EQUAL


def test_points_of_the_problem_and_of_a_part(page: Mapping[str, Any]) -> None:
    parts = [{**page["parts"][0], "points": 99}, *page["parts"][1:]]
    assert told(since(page, points=12, parts=parts), "points") == [
        ("the problem", "10", "12"),
        ("part a", str(page["parts"][0]["points"]), "99"),
    ]


def test_a_part_that_is_taken_out_is_one_change_and_the_others_move_up(page: Mapping[str, Any]) -> None:
    first, gone, *rest = page["parts"]
    moved = [{**part, "label": chr(ord(part["label"]) - 1)} for part in rest]
    found = told(since(page, parts=[first, *moved]), "part")
    assert found[-1] == ("part b", gone["ask"], "")
    assert found[:-1] == [
        (f"part {n['label']}", f"part {o['label']}", f"part {n['label']}") for o, n in zip(rest, moved, strict=True)
    ]


def test_what_a_part_asks_for(page: Mapping[str, Any]) -> None:
    first, *rest = page["parts"]
    more = {**first, "answers": [*first["answers"], "density"]}
    assert told(since(page, parts=[more, *rest]), "asked") == [("part a", "inertia_tensor", "inertia_tensor, density")]


def test_steps_that_come_go_and_change_places(page: Mapping[str, Any]) -> None:
    first, second, *rest = page["steps"]
    (gone,) = since(page, steps=[second, *rest])
    assert (gone.of, gone.where, gone.how) == ("step", first["key"], REMOVED)
    (come,) = changes({**page, "steps": [second, *rest]}, page)
    assert (come.of, come.where, come.how) == ("step", first["key"], ADDED)
    (order,) = since(page, steps=[second, first, *rest])
    assert order.of == "order"


def test_how_sure_a_step_is_is_told(page: Mapping[str, Any]) -> None:
    first, *rest = page["steps"]
    evidence = [{**each, "grade": "sampled"} for each in first["evidence"]]
    (change,) = since(page, steps=[{**first, "evidence": evidence}, *rest])
    assert change.facets == (("evidence", "proved", "sampled"),)


def says(*blocks: tuple[str, list[str]]) -> list[dict[str, Any]]:
    return [{"text": text, "refers_to": keys} for text, keys in blocks]


def test_a_sentence_whose_equation_has_another_number_is_the_same(page: Mapping[str, Any]) -> None:
    before = {**page, "limits_say": says(("By (7) and f(2), all is well.", ["spin"]))}
    assert since(before, limits_say=says(("By (8) and f(2), all is well.", ["spin"]))) == []
    (other,) = since(before, limits_say=says(("By (7) and f(2), all is well.", ["torque"])))
    assert other.words == ((EQUAL, "By"), (REMOVED, "(7)"), (ADDED, "(7)"), (EQUAL, "and f(2), all is well."))


def test_an_edited_sentence_is_beside_the_one_that_it_was(page: Mapping[str, Any]) -> None:
    old = says(("One two three four.", []), ("Quite another.", []), ("The last of them.", []))
    new = says(("A new one here.", []), ("One two three five.", []), ("The last of them.", []))
    found = since({**page, "limits_say": old}, limits_say=new)
    assert [(change.before, change.after) for change in found] == [
        ("", "A new one here."),
        ("One two three four.", "One two three five."),
        ("Quite another.", ""),
    ]


def test_numbers_of_equations_drawings_reference_and_warnings(page: Mapping[str, Any]) -> None:
    warning = {"code": "not-shown", "message": "`x` is nowhere", "line": 3}
    assert told(since(page, warnings=[warning]), "warning") == [("not-shown", "", "`x` is nowhere")]
    assert since({**page, "warnings": [warning]}, warnings=[{**warning, "line": 4}]) == []
    first, *rest = page["drawings"]
    assert told(since(page, drawings=rest), "drawing")[0][0] == first["key"]
    stated = {"document": "a.tex", "line": 3, "states": "x", "outcome": "agrees"}
    found = since({**page, "reference": [stated]}, reference=[{**stated, "outcome": "differs"}])
    assert told(found, "reference") == [("a.tex line 3: x", "agrees", "differs")]
    part = page["parts"][0]
    moved = [{**block, **({"number": "99"} if "number" in block else {})} for block in part["says"]]
    assert {
        after for _, _, after in told(since(page, parts=[{**part, "says": moved}, *page["parts"][1:]]), "number")
    } == {"(99)"}
