"""The schemas by which editors complete and check what is written."""

from __future__ import annotations

import json

import pytest

from derive.course.editors import problem_schema, reference_schema
from derive.course.problem_file import ProblemKeys
from derive.course.schema import keys_of
from derive.course.stock import stock_names, stock_script
from tests.courses import ROOT


@pytest.mark.parametrize(("name", "made"), [("problem", problem_schema), ("reference", reference_schema)])
def test_the_schemas_are_current(name: str, made: object) -> None:
    assert callable(made)
    file = ROOT / "templates" / f"{name}.schema.json"
    assert file.read_text(encoding="utf-8") == made(), "run `make schemas`"


def test_the_schema_knows_every_key_and_what_is_required() -> None:
    schema = json.loads(problem_schema())
    assert set(schema["properties"]) == set(keys_of(ProblemKeys))
    assert schema["required"] == ["title", "solve", "statement", "parts"]


def test_what_may_be_described_goes_by_the_script_of_the_engine() -> None:
    of_script, *others = json.loads(problem_schema())["allOf"]
    assert set(of_script["then"]["properties"]["given"]) == {"additionalProperties"}
    rules = {rule["if"]["properties"]["solve"]["const"]: rule["then"] for rule in others}
    assert set(rules) == set(stock_names())
    for name, rule in rules.items():
        assert set(rule["properties"]["given"]["properties"]) == set(keys_of(stock_script(name).keys))
