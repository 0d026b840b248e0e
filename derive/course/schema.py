"""The keys of the files an instructor writes, in one table: what is checked, and the JSON schema for editors."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping as Table
from dataclasses import dataclass
from typing import Any

from derive.algebra.dimensions import KINDS
from derive.course.units import UNIT_NAMES
from derive.course.yaml_tree import Mapping, Node, Scalar, Sequence, abridged, shape_of
from derive.errors import Faults, nearest

SHOWN = ("full", "result", "hidden")
MAX_FIGURES = 15
DEFAULT_FIGURES = 4

_TEXT = {"type": "string"}
_SCALAR = {"type": ["string", "number"]}
_POINTS = {"type": "number", "minimum": 0, "multipleOf": 0.5}
_UNIT = {"type": "string", "examples": list(UNIT_NAMES)}
_FIGURES = {"type": "integer", "minimum": 1, "maximum": MAX_FIGURES}


@dataclass(frozen=True)
class Key:
    """One key: what it is for, whether it must be there, what an editor may offer."""

    meaning: str
    schema: Any
    required: bool = False


FORM_KEYS: Table[str, Key] = {
    "unit": Key(
        "unit of the number, such as `degree` or `N m`, or a list of units",
        {"anyOf": [_UNIT, {"type": "array", "items": _UNIT, "minItems": 1}]},
    ),
    "figures": Key("significant figures of the number", _FIGURES),
}


def _object(keys: Table[str, Key]) -> dict[str, Any]:
    return {
        "type": "object",
        "additionalProperties": False,
        "required": [name for name, key in keys.items() if key.required],
        "properties": {name: {"description": key.meaning, **key.schema} for name, key in keys.items()},
    }


def _mapping_of(schema: Any) -> dict[str, Any]:
    return {"type": "object", "additionalProperties": schema}


PART_KEYS: Table[str, Key] = {
    "ask": Key("the question, in prose", _TEXT, required=True),
    "answer": Key(
        "key of the step that answers it, or a list of keys",
        {"anyOf": [_TEXT, {"type": "array", "items": _TEXT, "minItems": 1}]},
        required=True,
    ),
    "points": Key("points of this part", _POINTS),
    "form": Key(
        "unit and figures of its numbers, for all answers or by the answer's key",
        {"anyOf": [_object(FORM_KEYS), _mapping_of(_object(FORM_KEYS))]},
    ),
}

DRAWING_KEYS: Table[str, Key] = {
    "at": Key("where it stands: `statement`, the letter of a part, the step that a part asks for, or `hidden`", _TEXT),
    "caption": Key("what it shows, in prose", _TEXT),
    "width": Key("how wide it is without its labels, such as `5 cm`", _TEXT),
    "values": Key("numbers or proportions to draw with: `h: 2*R`, `theta: 40 deg`", _mapping_of(_SCALAR)),
    "range": Key(
        "the two ends of a plot, such as `[-60 deg, 60 deg]`",
        {"type": "array", "items": _SCALAR, "minItems": 2, "maxItems": 2},
    ),
    "cases": Key(
        "the numbers of each curve of a plot, panel by panel",
        {"type": "array", "items": _mapping_of(_SCALAR), "minItems": 1},
    ),
}

PROBLEM_KEYS: Table[str, Key] = {
    "title": Key("the heading of the problem", _TEXT, required=True),
    "solve": Key("the script beside this file whose `solve()` derives the answers", _TEXT, required=True),
    "points": Key("points in all; those of the parts must add up to it", _POINTS),
    "symbols": Key("letters and their kinds: `M: mass`", _mapping_of({"enum": list(KINDS)})),
    "given": Key(
        "what goes to `solve()`, by the names of its parameters: an expression, `2 cm`, or a list of them",
        _mapping_of({"anyOf": [_SCALAR, {"type": "array", "items": _SCALAR}]}),
    ),
    "values": Key("numbers for declared letters, put in at the end: `a: 2 cm`", _mapping_of(_SCALAR)),
    "statement": Key("the problem in prose; `<<mass>>` stands for what is given", _TEXT, required=True),
    "parts": Key("the questions", {"type": "array", "items": _object(PART_KEYS), "minItems": 1}, required=True),
    "wording": Key(
        "sentences that replace the stock ones of a step, by the step's key, or by key and outcome",
        _mapping_of({"anyOf": [_TEXT, _mapping_of(_TEXT)]}),
    ),
    "show": Key("how much of a step is shown, by the step's key", _mapping_of({"enum": list(SHOWN)})),
    "figures": Key("significant figures where `form` says nothing", _FIGURES),
    "drawings": Key("where the drawings of the script stand, by their names", _mapping_of(_object(DRAWING_KEYS))),
    "note": Key("a remark after the last part, in prose", _TEXT),
}

SET_KEYS: Table[str, Key] = {
    "course": Key("the course", _TEXT, required=True),
    "title": Key("the heading of the set", _TEXT, required=True),
    "date": Key("the date as it is to be printed", _TEXT),
    "instructor": Key("who teaches the course", _TEXT),
    "problems": Key("names of the problems in order", {"type": "array", "items": _TEXT, "minItems": 1}, required=True),
}


_VALUE = {"anyOf": [_SCALAR, {"type": "array", "minItems": 3, "maxItems": 3}]}

ERRATUM_KEYS: Table[str, Key] = {
    "why": Key("what is wrong, in a few words", _TEXT, required=True),
    "right": Key("the value that it should state", _VALUE, required=True),
}

ENTRY_KEYS: Table[str, Key] = {
    "part": Key("the part of the document", _SCALAR),
    "answer": Key("the key of the step that has this value", _TEXT, required=True),
    "states": Key("the value: an expression, 3 of them, or 3 rows of 3", _VALUE),
    "latex": Key("the value as the document prints it, in LaTeX; of a chain `a = b` every side is compared", _SCALAR),
    "to": Key(
        "decimals agree to so many figures; a list has one number for each entry, or for each of two branches",
        {"anyOf": [_FIGURES, {"type": "array", "items": _FIGURES, "minItems": 1}]},
    ),
    "in": Key("the unit of the stated value", {"type": "string", "examples": list(UNIT_NAMES)}),
    "with": Key(
        "letters for which the document has put in numbers; those of `values` are put in on both sides",
        {"anyOf": [_TEXT, {"type": "array", "items": _TEXT, "minItems": 1}]},
    ),
    "times": Key("the document's equation is the derived one multiplied by this", _SCALAR),
    "erratum": Key("the document is wrong here", _object(ERRATUM_KEYS)),
}

GROUP_KEYS: Table[str, Key] = {
    "problem": Key("the problem of this set that the document solves", _TEXT, required=True),
    "symbols": Key(
        "letters of the document and their kinds, also those that steps bring in", _mapping_of({"enum": list(KINDS)})
    ),
    "given": Key(
        "what the document starts from, as in the problem's file", PROBLEM_KEYS["given"].schema, required=True
    ),
    "letters": Key("letters of the document that are called otherwise here: `I_1: I_xx`", _mapping_of(_TEXT)),
    "values": Key("numbers for letters, put in where a stated value lacks the letter", _mapping_of(_SCALAR)),
    "entries": Key(
        "the values that the document states", {"type": "array", "items": _object(ENTRY_KEYS), "minItems": 1}, True
    ),
}


def problem_schema() -> str:
    """The JSON schema that an editor uses to complete and to check a problem while it is written."""
    return _schema("A problem", _object(PROBLEM_KEYS))


def reference_schema() -> str:
    """The same for what a document states."""
    return _schema("What a document states", {"type": "array", "items": _object(GROUP_KEYS), "minItems": 1})


def _schema(title: str, schema: dict[str, Any]) -> str:
    return json.dumps({"$schema": "http://json-schema.org/draft-07/schema#", "title": title, **schema}, indent=2) + "\n"


def check_keys(node: Mapping, keys: Table[str, Key], what: str, faults: Faults) -> None:
    """Unknown and missing keys of a mapping; a mistyped key is one fault, not two."""
    missing = [name for name, wanted in keys.items() if wanted.required and node.get(name) is None]
    for key, _ in node.pairs:
        if key.text not in keys:
            close = nearest(key.text, [name for name in keys if node.get(name) is None])
            if close in missing:
                missing.remove(close)
            help_line = f"did you mean `{close}`?" if close else "the keys are " + ", ".join(f"`{k}`" for k in keys)
            faults.error("unknown-key", f"{what} has no key `{abridged(key.text)}`", key.place, help=help_line)
    for name in missing:
        faults.error("missing-key", f"{what} needs `{name}`: {keys[name].meaning}", node.place)


def wrong_type(faults: Faults, what: str, wanted: str, node: Node, help: str | None = None) -> None:
    """The complaint that something is of another shape than its key asks for."""
    if isinstance(node, Scalar) and node.empty or isinstance(node, Sequence) and not node.items:
        faults.error("missing-value", f"{what} must be {wanted}, but it is empty", node.place, help=help)
    else:
        faults.error("wrong-type", f"{what} must be {wanted}, but it is {shape_of(node)}", node.place, help=help)


def read_text(node: Mapping, key: str, faults: Faults) -> str | None:
    """One line of plain text, if the key is there."""
    value = node.get(key)
    if value is None or (isinstance(value, Scalar) and not value.empty):
        return value.text.strip() if value else None
    wrong_type(faults, f"`{key}`", "text", value)
    return None


def read_figures(node: Node | None, faults: Faults) -> int | None:
    """A number of significant figures, if it is given."""
    if isinstance(node, Scalar) and re.fullmatch(r"\d{1,3}", node.text, re.ASCII) and 0 < int(node.text) <= MAX_FIGURES:
        return int(node.text)
    if node is not None:
        wrong_type(faults, "`figures`", f"a whole number from 1 to {MAX_FIGURES}", node)
    return None
