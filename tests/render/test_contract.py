"""Tests of the JSON of a page: its keys, and texts that SymPy alone can read."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import sympy
from sympy import Rational, Symbol
from sympy import sympify as sympy_reads  # an independent reader of the texts: the engine never uses `sympify`

from tests.courses import course_in, rendered_once


@pytest.mark.parametrize(
    ("length", "mass", "rate"),
    [
        ("a", "M", "omega"),
        ("S", "I", "E"),
        ("N", "beta", "lambda"),
        ("E", "S", "N"),
        ("lambda", "N", "I"),
        ("l_1", "m_0", "Omega_0"),
    ],
)
def test_every_string_of_the_json_reads_back_whatever_the_letters(
    length: str, mass: str, rate: str, tmp_path: Path
) -> None:
    edits = {
        "{a: length, M: mass, omega: angular speed}": f"{{{length}: length, {mass}: mass, {rate}: angular speed}}",
        "[a, 2*a, 3*a]": f"[{length}, 2*{length}, 3*{length}]",
        "mass: M ": f"mass: {mass} ",
        "rate: omega": f"rate: {rate}",
    }
    pinned = (Path(__file__).parents[1] / "problems" / "block.yaml").read_text(encoding="utf-8")
    edits = {old if old in pinned else old.strip(): new if old in pinned else new.strip() for old, new in edits.items()}
    page = json.loads(rendered_once(course_in(tmp_path, edits), "hw9/block", only={"json"}).texts["json"])
    lines = [(form["sympy"], step["names"]) for step in page["steps"] for form in step["chain"]]
    lines += [(line, {}) for line in page["given"]["sides"]]
    lines += [(meaning, {}) for step in page["steps"] for meaning in step["names"].values()]
    lines += [(answer["sympy"], {}) for answer in page["answers"].values()]
    assert len(lines) > 60
    for line, meanings_of_names in lines:
        back = sympy_reads(line, {name: sympy_reads(meaning) for name, meaning in meanings_of_names.items()})
        names = {str(symbol) for symbol in back.free_symbols}
        assert not names & {"pi", "zoo", "nan"}
    S, I, E = (Symbol(name) for name in (length, mass, rate))
    energy = sympy_reads(page["answers"]["kinetic_energy_about_axis"]["sympy"])
    assert energy == Rational(7, 24) * I * S**2 * E**2
    size = sympy_reads(page["answers"]["magnitude"]["sympy"])
    assert size == sympy.sqrt(42) / 28 * I * S**2 * E**2


def test_the_contract_has_the_keys_that_others_rely_on(tmp_path: Path) -> None:
    page = json.loads(rendered_once(course_in(tmp_path), "hw9/block", only={"json"}).texts["json"])
    assert list(page) == [
        "problem",
        "detail",
        "title",
        "points",
        "statement",
        "strategy",
        "given",
        "parts",
        "assumed",
        "answers",
        "observations",
        "limits",
        "limits_say",
        "note",
        "drawings",
        "steps",
        "reference",
        "warnings",
    ]
    assert {frozenset(part) for part in page["parts"]} == {
        frozenset({"label", "points", "extra", "answers", "ask", "says"})
    }
    assert {frozenset(answer) for answer in page["answers"].values()} == {
        frozenset({"symbol", "sympy", "latex", "text", "unit", "number"})
    }
    for step in page["steps"]:
        assert list(step) == ["key", "rule", "symbol", "outcome", "inputs", "names", "chain", "evidence"]
        assert list(step["symbol"]) == ["sympy", "latex", "formula"]
        assert all(list(form)[:5] == ["sympy", "latex", "text", "because", "level"] for form in step["chain"])
        assert all(list(evidence) == ["claim", "compared", "grade", "detail"] for evidence in step["evidence"])
    assert [key for part in page["parts"] for key in part["answers"]] == list(page["answers"])
    keys = [step["key"] for step in page["steps"]]
    assert all(name in keys[:i] for i, step in enumerate(page["steps"]) for name in step["inputs"])


def test_the_same_problem_gives_the_same_json(tmp_path: Path) -> None:
    first, second = (
        rendered_once(course_in(tmp_path / name), "hw9/block", only={"json"}).texts["json"] for name in ("one", "two")
    )
    assert first == second
