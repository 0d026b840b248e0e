"""A notebook satisfies Jupyter's schema, and its cells derive the results of the page."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft4Validator, ValidationError

from derive.render.formats.notebook import FORMAT
from tests.courses import ROOT, course_in, rendered_once
from tests.test_transcripts import PAGES

SCHEMA = json.loads(Path(__file__).with_name("nbformat.v4.5.schema.json").read_text(encoding="utf-8"))  # from nbformat

# Runs the cells of a notebook in order, as Jupyter does, and reports the value of the last line of each cell.
RUN = """
import ast, json, sys

shown, names = [], {}
for cell in json.load(sys.stdin)["cells"]:
    if cell["cell_type"] != "code":
        continue
    tree = ast.parse("".join(cell["source"]))
    last = ast.Expression(tree.body.pop().value) if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)
    value = eval(compile(last, "cell", "eval"), names) if last else None
    if hasattr(value, "svg"):
        shown.append(["drawing", value._repr_svg_()])
    elif last:
        shown.append([value.key, value.sympy, value.number, value._repr_latex_()])
print(json.dumps(shown))
"""


def cells(notebook: dict[str, Any], sort: str) -> list[str]:
    return ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == sort]


def run(notebook: str, folder: Path) -> list[list[Any]]:
    done = subprocess.run(
        [sys.executable, "-P", "-c", RUN],
        input=notebook,
        cwd=folder,
        capture_output=True,
        text=True,
        env={"PYTHONPATH": str(ROOT), "PATH": ""},
    )
    assert done.returncode == 0, done.stderr
    shown: list[list[Any]] = json.loads(done.stdout)
    return shown


LONG = [pytest.param(name, marks=pytest.mark.long) for name in ("block-numbers", "top")]


@pytest.mark.parametrize("name", ["slab", *LONG])
def test_its_cells_derive_the_answers_of_the_page(tmp_path: Path, name: str) -> None:
    problem, (edits, detail) = name.partition("-")[0], PAGES[name]
    course = course_in(tmp_path, edits, problem=problem)
    found = rendered_once(course, f"hw9/{problem}", detail, only={"notebook", "json"})
    page = json.loads(found.texts["json"])
    shown = run(found.texts["notebook"], course / "problems")
    answers = {key: (sympy, number) for key, sympy, number, _ in (each for each in shown if each[0] != "drawing")}
    wanted = {key: (each["sympy"], (each["number"] or {"text": ""})["text"]) for key, each in page["answers"].items()}
    extra = {key for part in page["parts"] if part["extra"] for key in part["answers"]}  # shown only on full pages
    assert answers.keys() >= wanted.keys() - extra
    assert answers == {key: wanted[key] for key in answers}
    assert all(said.startswith(r"$\displaystyle ") for *_, said in (each for each in shown if each[0] != "drawing"))
    drawings = [each[1] for each in shown if each[0] == "drawing"]
    assert len(drawings) == len(page["drawings"])
    assert all(drawing.startswith("<svg") for drawing in drawings)


@pytest.mark.long
def test_a_changed_problem_changes_what_its_cells_show(tmp_path: Path) -> None:
    notebook = rendered_once(course_in(tmp_path / "one"), "hw9/block", only={"notebook"}).texts["notebook"]
    shown = run(notebook, course_in(tmp_path / "two", {"[a, 2*a, 3*a]": "[a, a, 2*a]"}))
    answers = {each[0]: each[1] for each in shown}
    assert answers["kinetic_energy"] == "M*a**2*(5*omega_x**2 + 5*omega_y**2 + 2*omega_z**2)/24"


@pytest.mark.parametrize("name", ["block", "slab"])
def test_it_is_valid_and_has_no_output_stored(tmp_path: Path, name: str) -> None:
    found = rendered_once(course_in(tmp_path, problem=name), f"hw9/{name}", only={"notebook"})
    notebook = json.loads(found.texts["notebook"])
    valid = Draft4Validator(SCHEMA)
    valid.validate(notebook)
    with pytest.raises(ValidationError):
        valid.validate({**notebook, "cells": [{**cell, "id": "no name"} for cell in notebook["cells"]]})
    assert len({cell["id"] for cell in notebook["cells"]}) == len(notebook["cells"])
    assert all(cell["outputs"] == [] for cell in notebook["cells"] if cell["cell_type"] == "code")
    assert cells(notebook, "markdown")[0].startswith("# ")


def test_a_build_does_not_write_it() -> None:
    assert not FORMAT.built
