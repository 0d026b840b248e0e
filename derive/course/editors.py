"""JSON schemas of the files that an instructor writes; editors use them to complete and check these files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from derive.course.problem_file import SCRIPT, ProblemKeys
from derive.course.problem_set import CourseKeys, SetKeys
from derive.course.reference.keys import DocumentKeys, GroupKeys, OwnKeys
from derive.course.schema import LEFT_EMPTY, object_schema, schema_for_editors
from derive.course.stock import stock_names, stock_script


def problem_schema() -> str:
    """Return the schema of a problem's file; which keys are allowed under `given:` depends on the value of `solve:`."""
    schema = object_schema(ProblemKeys)
    schema["properties"]["solve"] |= {"anyOf": [{"enum": list(stock_names())}, {"pattern": f"^{SCRIPT.pattern}$"}]}
    schema["properties"]["reference"] |= {**object_schema(OwnKeys), "type": ["object", LEFT_EMPTY]}
    given = {"additionalProperties": schema["properties"]["given"].pop("additionalProperties")}
    of_script = {"if": {"properties": {"solve": {"pattern": r"\.py$"}}}, "then": {"properties": {"given": given}}}
    rules = [of_script, *(_given_of(name) for name in stock_names())]
    return schema_for_editors("A problem", {**schema, "allOf": rules})


def set_schema() -> str:
    """Return the schema of a set's own file."""
    return schema_for_editors("A set of problems", object_schema(SetKeys))


def course_schema() -> str:
    """Return the schema of `course.yaml`: what all sets of a course share."""
    return schema_for_editors("A course", object_schema(CourseKeys))


def reference_schema() -> str:
    """Return the schema of `reference.yaml`: the statements of a document about the problems of a set."""
    items = {"anyOf": [object_schema(DocumentKeys), object_schema(GroupKeys)]}
    groups = {"type": "array", "items": items, "minItems": 1}
    return schema_for_editors("What a document states", groups)


SCHEMAS = {
    "problem.schema.json": problem_schema,
    "set.schema.json": set_schema,
    "course.schema.json": course_schema,
    "reference.schema.json": reference_schema,
}


def schema_folder(root: Path) -> Path:
    """Return the folder of a course's schemas: `templates` if it has a folder `new`, as in a checkout of derive;
    otherwise `problems/schemas`."""
    return root / "templates" if (root / "templates" / "new").is_dir() else root / "problems" / "schemas"


def _given_of(name: str) -> dict[str, Any]:
    return {
        "if": {"properties": {"solve": {"const": name}}, "required": ["solve"]},
        "then": {"properties": {"given": object_schema(stock_script(name).keys)}},
    }
