"""A key and its reader are one thing: what it may hold, for editors and for the reading, and where it is documented."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

import pytest

from derive.course.parts import AnswerForm, Question
from derive.course.problem import load_problem
from derive.course.problem_file import DrawingKeys, ProblemKeys
from derive.course.problem_set import SetKeys
from derive.course.reference.keys import DocumentKeys, EntryKeys, ErratumKeys, GroupKeys, OwnKeys
from derive.course.reference.statements import stated_groups
from derive.course.schema import FIGURES, TEXT, Record, key, list_of, mapping_of, object_schema, one_of, read_record
from derive.course.stock import stock_names, stock_script
from derive.course.yaml_tree import Mapping, Scalar, Sequence, Source, Word, yaml_tree
from derive.errors import Faults
from derive.stock.keys.bodies import PartKeys
from derive.stock.keys.connections import (
    ContactKeys,
    DashpotKeys,
    FrictionKeys,
    JointKeys,
    MasslessRodKeys,
    MotorKeys,
    StringKeys,
    SurfaceKeys,
)
from derive.stock.keys.parts import (
    CentralKeys,
    ChargeKeys,
    ConstraintKeys,
    DampingKeys,
    ForceKeys,
    ParticleKeys,
    SpringKeys,
)
from derive.stock.keys.placed_bodies import MovingBodyKeys
from derive.stock.keys.places import WayKeys
from derive.stock.keys.results import ResultKeys
from tests.courses import ROOT

DOCUMENTED = {
    "docs/problems.md": (ProblemKeys, Question, AnswerForm, DrawingKeys, SetKeys),
    "docs/references.md": (DocumentKeys, GroupKeys, EntryKeys, ErratumKeys),
    "docs/yaml-alone.md": (
        OwnKeys,
        *(stock_script(name).keys for name in stock_names()),
        *(ParticleKeys, SpringKeys, CentralKeys, ForceKeys, DampingKeys, ChargeKeys, ConstraintKeys),
        *(MovingBodyKeys, PartKeys, ResultKeys, WayKeys),
        *(SurfaceKeys, ContactKeys, FrictionKeys, StringKeys, MasslessRodKeys, JointKeys, MotorKeys, DashpotKeys),
    ),
}


@dataclass(frozen=True)
class Kettle(Record):
    name: Word | None = key("what it is called", TEXT, required=True)
    litres: int | None = key("how much it holds", FIGURES, called="in")
    colours: dict[Word, str] = key("of its parts", mapping_of(one_of(("red", "blue", "green"))))
    uses: tuple[Word, ...] = key("what it is for", list_of(TEXT, "two uses", "a use", length=2))


def read(text: str) -> tuple[Kettle, list[str]]:
    node = yaml_tree(Source("k.yaml", text))
    assert isinstance(node, Mapping)
    faults = Faults()
    kettle = read_record(Kettle, node, "a kettle", faults)
    try:
        faults.stop()
    except Exception as error:
        return kettle, [complaint.message for complaint in error.complaints]  # type: ignore[attr-defined]
    return kettle, []


def test_a_key_is_read_by_its_own_reader_and_knows_its_place() -> None:
    kettle, faults = read("name:  Tom \nin: 3\ncolours: {lid: red}\nuses: [tea, soup]\n")
    assert (kettle.name, kettle.litres, kettle.colours, kettle.uses) == ("Tom", 3, {"lid": "red"}, ("tea", "soup"))
    assert (faults, kettle.name and kettle.name.place.column) == ([], 8)
    assert (kettle.places["colours.lid"].line, kettle.values_at["in"].column, kettle.places[""].line) == (3, 5, 1)


def test_a_key_that_is_left_out_has_what_stands_for_nothing() -> None:
    kettle, faults = read("name: Tom\ncolours:\n")
    assert (kettle.litres, kettle.colours, kettle.uses, faults) == (None, {}, (), [])


def test_every_fault_is_told_and_a_mistyped_key_once() -> None:
    assert read("nam: Tom\nin: 16\ncolours: {lid: rad}\nuses: [tea]\n")[1] == [
        "a kettle has no key `nam`",
        "`in` must be a whole number from 1 to 15, but it is `16`",
        "`lid` must be red, blue or green, but it is `rad`",
        "`uses` must be two uses, but it is a list",
    ]
    assert read("in: 3")[1] == ["a kettle needs `name`: what it is called"]


def test_the_schema_for_editors_is_that_of_the_readers() -> None:
    schema = object_schema(Kettle)
    assert (schema["required"], list(schema["properties"])) == (["name"], ["name", "in", "colours", "uses"])
    assert schema["properties"]["in"]["maximum"] == 15
    assert schema["properties"]["colours"]["additionalProperties"] == {"enum": ["red", "blue", "green"]}
    assert schema["properties"]["uses"] == {
        "description": "what it is for",
        "type": "array",
        "items": TEXT.schema,
        "minItems": 2,
        "maxItems": 2,
    }


@pytest.mark.parametrize("page", DOCUMENTED)
def test_every_key_is_documented(page: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    names = [name for record in DOCUMENTED[page] for name in object_schema(record)["properties"]]
    assert [name for name in names if not re.search(rf"`{name}:?`|\b{name}:\s", text)] == []


def parts_of(value: Any) -> Iterator[Any]:
    yield value
    inner: list[Any] = []
    if is_dataclass(value) and not isinstance(value, type):
        inner = [getattr(value, f.name) for f in fields(value)]
    elif isinstance(value, dict):
        inner = [*value, *value.values()]
    elif isinstance(value, tuple | list):
        inner = list(value)
    for each in inner:
        yield from parts_of(each)


@pytest.mark.parametrize("name", ["block", "slab"])
def test_what_is_read_holds_no_yaml(name: str) -> None:
    problem = load_problem(ROOT, f"hw9/{name}")
    read = [*parts_of(problem), *parts_of(stated_groups(problem))]
    assert len(read) > 1000
    assert [type(part) for part in read if isinstance(part, Scalar | Sequence | Mapping)] == []
