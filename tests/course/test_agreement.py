"""The schemas and the loader agree: what editors underline is what derive complains of, in the same lines."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import pytest
import yaml
from jsonschema import Draft7Validator
from jsonschema.exceptions import ValidationError

from derive.course.editors import course_schema, problem_schema, reference_schema, set_schema
from derive.course.problem import load_problem
from derive.course.problem_file import ProblemKeys
from derive.course.problem_set import SetKeys
from derive.course.schema import Record, keys_of, read_record
from derive.course.stock import stock_names, stock_script
from derive.course.yaml_tree import Mapping, Source, yaml_tree
from derive.errors import Faults, Rejected
from tests.courses import ROOT

COMPLAINTS = ROOT / "tests" / "complaints"
STRUCTURAL = {"unknown-key", "missing-key", "wrong-type", "missing-value", "unknown-kind", "empty"}

# What a schema cannot know: the lines of structural complaints that go by more than the file, and why.
BEYOND = {
    "script-outside": "where a script may lie goes by the folder of the problem",
    "wording": "which outcomes a step has is known once it is derived",
}
BROKEN = {"yaml", "tab", "alias", "anchor", "control-character", "documents", "duplicate-key", "merge-key", "tag"}


class Editor(yaml.SafeLoader):
    yaml_implicit_resolvers: dict[str, Any] = {}  # noqa: RUF012


for sort, pattern, first in (
    ("bool", r"true|false", "tf"),
    ("null", r"~|null|Null|NULL|", ["~", "n", "N", ""]),
    ("int", r"[-+]?[0-9]+", "-+0123456789"),
    ("float", r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?", "-+.0123456789"),
):
    Editor.add_implicit_resolver(f"tag:yaml.org,2002:{sort}", re.compile(f"^(?:{pattern})$"), list(first))


@cache
def validator(made: Callable[[], str]) -> Draft7Validator:
    schema = json.loads(made())
    Draft7Validator.check_schema(schema)
    return Draft7Validator(schema)


def refused(text: str, made: Callable[[], str]) -> list[ValidationError]:
    return list(validator(made).iter_errors(yaml.load(text, Editor)))


def schema_of(file: Path) -> Callable[[], str]:
    return {"course": course_schema, "set": set_schema, "reference": reference_schema}.get(file.stem, problem_schema)


def good_files() -> Iterator[Path]:
    for folder in ("problems", "tests/problems", "templates/new"):
        yield from sorted((ROOT / folder).rglob("*.yaml"))


@pytest.mark.parametrize("file", [*good_files()], ids=lambda file: str(file.relative_to(ROOT)))
def test_no_schema_refuses_a_file_that_builds(file: Path) -> None:
    text = file.read_text(encoding="utf-8").replace("{title}", '"A course"')  # as `derive init` fills it in
    assert [error.message for error in refused(text, schema_of(file))] == []


def underlined(text: str, made: Callable[[], str]) -> list[set[int]]:
    top = yaml.compose(text, Editor)
    return [lines for error in refused(text, made) for lines in _lines(error, top)]


def _lines(error: ValidationError, top: Any) -> Iterator[set[int]]:
    if top is None:  # an empty file
        yield {1}
        return
    node = top
    for step in error.absolute_path:
        node = node.value[step] if isinstance(step, int) else next(v for k, v in node.value if k.value == step)
    if error.validator == "additionalProperties":
        known = error.schema["properties"]
        yield from ({key.start_mark.line + 1} for key, _ in node.value if key.value not in known)
    else:
        # A block ends where the next key begins, which is another line.
        last = node.end_mark.line + (node.end_mark.column > 0)
        yield set(range(node.start_mark.line + 1, max(last, node.start_mark.line + 1) + 1))


def complained(file: Path) -> list[tuple[int, str]]:
    text = file.with_suffix(".txt").read_text(encoding="utf-8")
    return [(int(line), code) for line, code in re.findall(r"\.yaml:(\d+):\d+: error\[([a-z-]+)\]", text)]


def golden() -> Iterator[Path]:
    for file in sorted([*COMPLAINTS.glob("*.yaml"), *(COMPLAINTS / "reference").glob("*.yaml")]):
        if BROKEN.isdisjoint(code for _, code in complained(file)):
            yield file


def schema_of_golden(file: Path) -> Callable[[], str]:
    return reference_schema if file.parent.name == "reference" else problem_schema


@pytest.mark.parametrize("file", [*golden()], ids=lambda file: file.stem)
def test_what_is_complained_of_the_shape_of_a_file_its_schema_refuses_too(file: Path) -> None:
    lines = set[int]().union(*underlined(file.read_text(encoding="utf-8"), schema_of_golden(file)))
    missed = {line for line, code in complained(file) if code in STRUCTURAL} - lines
    assert bool(missed) == (file.stem in BEYOND), missed


@pytest.mark.parametrize("file", [*golden()], ids=lambda file: file.stem)
def test_what_a_schema_refuses_is_complained_of(file: Path) -> None:
    told = {line for line, _ in complained(file)}
    text = file.read_text(encoding="utf-8")
    assert [lines for lines in underlined(text, schema_of_golden(file)) if not lines & told] == []


def test_what_lies_beyond_a_schema_has_its_golden_complaint() -> None:
    assert {*BEYOND} <= {file.stem for file in golden()}


# --- every key, with whatever one might write under it ---

PROBLEM = {"title": "A block", "solve": "block.py", "statement": "It turns.", "parts": "[{ask: Find it., answer: T}]"}
SET = {"course": "Physics", "title": "Homework", "problems": "[block]"}
WRITTEN = ("abc", "3", "2.5", "-1", "true", "yes", "[]", "{}", "", "[1]", "[a]", "[[a]]", "[{}]", "[{a: b}]")
WRITTEN += ("{a: b}", "{a: 3}", "{a: [b]}", "{a: {b: c}}", "2015-01-01")
NOTHING = ("", "null", "~", "NULL", '""', "' '", "[]", "{}")
NOTHING += tuple(within % (nothing or "~") for within in ("[%s]", "{a: %s}") for nothing in NOTHING)
# Read when more is known than the file says: which scripts there are, and problems; what goes to a script; a reference.
LATER = {"solve", "reference", "given", "values"}


def loaded(record: type[Record], text: str) -> list[str]:
    node = yaml_tree(Source("x.yaml", text))
    assert isinstance(node, Mapping)
    faults = Faults()
    read_record(record, node, "it", faults)
    try:
        faults.stop()
    except Rejected as error:
        return [complaint.message for complaint in error.complaints]
    return []


def every_key() -> Iterator[tuple[type[Record], Callable[[], str], str]]:
    yield from ((ProblemKeys, problem_schema, key) for key in keys_of(ProblemKeys) if key not in LATER)
    yield from ((SetKeys, set_schema, key) for key in keys_of(SetKeys) if key not in LATER)


@pytest.mark.parametrize(("record", "made", "key"), [*every_key()])
def test_loader_and_schema_take_the_same_under_each_key(
    record: type[Record], made: Callable[[], str], key: str
) -> None:
    base = PROBLEM if record is ProblemKeys else SET
    for written in (*WRITTEN, *NOTHING):
        text = "".join(f"{name}: {value}\n" for name, value in {**base, key: written}.items())
        told, errors = loaded(record, text), [error.message for error in refused(text, made)]
        assert bool(told) == bool(errors), (written, told, errors)


def records(of: type[Record] = Record) -> Iterator[type[Record]]:
    assert all(stock_script(name).keys for name in stock_names())  # which has them imported
    for record in of.__subclasses__():
        yield from records(record)
        if record.__module__.startswith("derive."):
            yield record


@pytest.mark.parametrize("record", sorted(records(), key=str), ids=lambda record: record.__name__)
def test_nothing_is_taken_by_both_or_by_none_under_each_key(record: type[Record]) -> None:
    for (key, known), written in product(keys_of(record).items(), NOTHING):
        if key == "given" and ":" in written:
            continue  # the script knows what that stands for
        text, faults = f"{key}: {written}\n", Faults()
        node = yaml_tree(Source("x.yaml", text))
        known.reader.read(node.get(key), key, faults)  # type: ignore[arg-type,union-attr]
        (value,) = yaml.load(text, Editor).values()
        assert bool(faults) != Draft7Validator(known.reader.schema).is_valid(value), (key, written)


@pytest.mark.parametrize("key", ["bodies", "springs", "at", "conserved", "potential"])
def test_nothing_is_taken_by_both_or_by_none_in_a_description(tmp_path: Path, key: str) -> None:
    whole = (ROOT / "problems/library/constraints/atwood.yaml").read_text(encoding="utf-8")
    file = tmp_path / "problems" / "one" / "atwood.yaml"
    file.parent.mkdir(parents=True)
    for nothing in NOTHING[:8]:
        text = whole.replace("  gravity: g\n", f"  gravity: g\n  {key}: {nothing}\n")
        file.write_text(text, encoding="utf-8")
        told = ""
        try:
            load_problem(tmp_path, "one/atwood")
        except Rejected as error:
            told = str(error)
        assert bool(told) == bool(refused(text, problem_schema)), (nothing, told)


PART_KEYS = ("ask", "answer", "points", "extra", "form", "cases")


@pytest.mark.parametrize("key", PART_KEYS)
def test_loader_and_schema_take_the_same_under_each_key_of_a_part(key: str) -> None:
    for written in WRITTEN:
        part = ", ".join(f"{name}: {value}" for name, value in {"ask": "Find it.", "answer": "T", key: written}.items())
        text = "".join(f"{name}: {value}\n" for name, value in {**PROBLEM, "parts": f"[{{{part}}}]"}.items())
        told, errors = loaded(ProblemKeys, text), [error.message for error in refused(text, problem_schema)]
        assert bool(told) == bool(errors), (written, told, errors)
