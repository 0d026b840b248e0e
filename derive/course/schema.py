"""The keys of the files that an instructor writes: each key is a field of a record, with a meaning and a reader.

    figures: int | None = key("significant figures of the number", FIGURES)

The JSON schema of a reader shows editors what the key allows; the function of the reader turns the contents of the key
into a checked value.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from collections.abc import Mapping as Table
from dataclasses import dataclass, field, fields
from typing import Any, Generic, TypeVar

from derive.course.yaml_tree import Formula, Mapping, Scalar, Sequence, Tree, Word, abridged, shape_of
from derive.errors import Faults, Place, did_you_mean, nearest

MAX_FIGURES = 15
THE_KEYS_ARE = "the keys are "  # begins the help for an unknown key that is similar to no known key

T = TypeVar("T")
R = TypeVar("R", bound="Record")


@dataclass(frozen=True)
class Reader(Generic[T]):
    """The contents that a key allows: their JSON schema, and the function that reads their value and reports errors.

    `read` takes the contents and the name of their key; `absent` makes the value of a missing key. If `read` returns
    None, the key is treated as missing.
    """

    schema: dict[str, Any]
    read: Callable[[Tree, str, Faults], T | None]
    absent: Callable[[], T | None] = lambda: None


@dataclass(frozen=True)
class Key:
    """One key: its meaning, the contents that it allows, whether it is required, and a wrong name that authors often
    write for it."""

    meaning: str
    reader: Reader[Any]
    required: bool = False
    instead_of: str = ""


def key(meaning: str, reader: Reader[Any], *, required: bool = False, called: str = "", instead_of: str = "") -> Any:
    """Declare a field of a record; the field is read from a key of a file.

    called       the name of the key in the file, if it differs from the name of the field
    instead_of   a name that authors often write by mistake, such as a former name; the error names the correct key
    """
    own = Key(meaning, reader, required, instead_of)
    return field(default_factory=reader.absent, metadata={"called": called, "key": own})


@dataclass(frozen=True)
class Record:
    """The contents of a mapping in a file, one field for each key.

    places     the place of each key, including nested keys such as `show.spin`; the empty name is the mapping itself
    values_at  the place where the value of each key begins
    """

    places: Table[str, Place] = field(repr=False, compare=False)
    values_at: Table[str, Place] = field(repr=False, compare=False)


def keys_of(record: type[Record]) -> dict[str, Key]:
    return {f.metadata["called"] or f.name: f.metadata["key"] for f in fields(record) if f.metadata}


def read_record(record: type[R], node: Mapping, what: str, faults: Faults) -> R:
    """Read the keys of a mapping; report unknown and missing keys."""
    keys = keys_of(record)
    check_keys(node, keys, what, faults)
    read: dict[str, Any] = {}
    for f, (name, known) in zip((f for f in fields(record) if f.metadata), keys.items(), strict=True):
        value = known.reader.read(under, name, faults) if (under := node.get(name)) is not None else None
        if value is not None:
            read[f.name] = value
    values_at = {name.text: value.place for name, value in node.pairs}
    return record({"": node.place, **node.places}, values_at, **read)


def check_keys(node: Mapping, keys: Table[str, Key], what: str, faults: Faults) -> None:
    """Report unknown and missing keys of a mapping."""
    missing = [name for name, wanted in keys.items() if wanted.required and node.get(name) is None]
    by_other_name = {known.instead_of: name for name, known in keys.items()}
    for name, _ in node.pairs:
        if name.text not in keys:
            close = by_other_name.get(name.text) or nearest(
                name.text, [known for known in keys if node.get(known) is None]
            )
            if close in missing:
                missing.remove(close)
            help_line = f"did you mean `{close}`?" if close else THE_KEYS_ARE + ", ".join(f"`{k}`" for k in keys)
            help_line = f"write `{close}`: {keys[close].meaning}" if close and name.text in by_other_name else help_line
            faults.error("unknown-key", f"{what} has no key `{abridged(name.text)}`", name.place, help=help_line)
    for wanted in missing:
        faults.error("missing-key", f"{what} needs `{wanted}`: {keys[wanted].meaning}", node.place)


def wrong_type(faults: Faults, what: str, wanted: str, node: Tree, help: str | None = None) -> None:
    if isinstance(node, Scalar) and node.empty or isinstance(node, Sequence) and not node.items:
        faults.error("missing-value", f"{what} must be {wanted}, but it is empty", node.place, help=help)
    else:
        faults.error("wrong-type", f"{what} must be {wanted}, but it is {shape_of(node)}", node.place, help=help)


# --- readers ---------------------------------------------------------------------------------------------------------


def _text(node: Tree, name: str, faults: Faults) -> Word | None:
    if isinstance(node, Scalar) and not node.empty:
        return Word.at(node.text.strip(), node.place)
    wrong_type(faults, f"`{name}`", "text", node, quotes_needed(node))
    return None


def quotes_needed(node: Tree) -> str | None:
    """Return the advice to quote a text that YAML reads as a mapping or a list because of its first character; None for
    any other node."""
    opening = node.place.text[node.place.column - 1 :][:1]
    return f"quote text that begins with `{opening}`" if opening in ("{", "[") else None


def _line(node: Tree, name: str, faults: Faults) -> Word | None:
    if isinstance(node, Scalar):
        refuse_comment(node, faults)
    return _text(node, name, faults)


def refuse_comment(node: Scalar, faults: Faults) -> None:
    """Report a text that YAML cuts off before a `#`: `Homework #3`, `Homework # 3`.

    A space and a word after the `#` show that the author meant a comment."""
    comment = re.match(r"[ \t]+#(?=[^\s#]|[ \t]+\d)", node.source.text[node.end :])
    if comment and node.style == "" and not node.empty:
        place = node.source.place(node.end + comment.end() - 1)
        help_line = "put the whole text in quotes; in a comment, a space and a word follow the `#`"
        faults.error("comment-in-text", "`#` begins a comment, so the text ends before it", place, help=help_line)


def _figures(node: Tree, name: str, faults: Faults) -> int | None:
    if isinstance(node, Scalar) and re.fullmatch(r"\d{1,3}", node.text, re.ASCII) and 0 < int(node.text) <= MAX_FIGURES:
        return int(node.text)
    wrong_type(faults, f"`{name}`", f"a whole number from 1 to {MAX_FIGURES}", node)
    return None


_YES, _NO = ("true", "True", "TRUE"), ("false", "False", "FALSE")  # the words that editors read as a boolean


def _yes_or_no(node: Tree, name: str, faults: Faults) -> bool | None:
    if isinstance(node, Scalar) and node.text in (*_YES, *_NO):
        return node.text in _YES
    wrong_type(faults, f"`{name}`", "true or false", node)
    return None


def _formula(node: Tree, name: str, faults: Faults) -> Formula | None:
    if isinstance(node, Scalar) and not node.empty:
        return Formula.of(node)
    wrong_type(faults, f"`{name}`", "an expression", node)
    return None


# A text that YAML would read as a number needs no quotes: `title: 2015`.
TEXT = Reader({"type": ["string", "number", "boolean"], "pattern": r"\S"}, _text)
LINE = Reader({"type": ["string", "number", "boolean"], "pattern": r"\S"}, _line)  # printed as the author wrote it
LEFT_EMPTY = "null"  # in JSON schemas, the type of a key with nothing after its `:`
FORMULA = Reader({"type": ["string", "number"], "pattern": r"\S"}, _formula)
YES_OR_NO = Reader({"type": "boolean"}, _yes_or_no, bool)
FIGURES = Reader({"type": "integer", "minimum": 1, "maximum": MAX_FIGURES}, _figures)


def as_written(schema: dict[str, Any], wanted: str) -> Reader[Tree]:
    """Return a reader that checks the shape of a node and returns the node."""

    def read(node: Tree, name: str, faults: Faults) -> Tree | None:
        odd = _misfit(node, schema)
        if odd is None:
            return node
        wrong_type(faults, f"`{name}`" if odd is node else f"an entry of `{name}`", wanted, odd)
        return None

    return Reader(schema, read)


def _misfit(node: Tree, schema: dict[str, Any]) -> Tree | None:
    """Return the first node whose shape (list, mapping, text, or nothing) the schema does not allow; None if there is
    no such node."""
    odd = [_misfit_in_one(node, each) for each in schema.get("anyOf", [schema])]
    return None if None in odd else next((within for within in odd if within is not node), node)


def _misfit_in_one(node: Tree, schema: dict[str, Any]) -> Tree | None:
    written = schema.get("type", "string")
    shapes = {written} if isinstance(written, str) else {*written}
    if isinstance(node, Scalar):
        allowed = {LEFT_EMPTY} if node.left_empty else {"string", "number", "integer"} if not node.empty else set()
        return node if shapes.isdisjoint(allowed) else None
    if isinstance(node, Sequence):
        shape, inner, rule = "array", node.items, "items"
    else:
        shape, inner, rule = "object", tuple(value for _, value in node.pairs), "additionalProperties"
    if shape not in shapes or not inner and "minItems" in schema:
        return node
    return next((odd for each in inner if (odd := _misfit(each, schema[rule])) is not None), None)


SCALAR = as_written(FORMULA.schema, "an expression")


def one_of(words: tuple[str, ...]) -> Reader[str]:
    """Return the reader of a word that must be one of a fixed list."""

    def read(node: Tree, name: str, faults: Faults) -> str | None:
        if isinstance(node, Scalar) and node.text in words:
            return node.text
        help_line = did_you_mean(node.text, words) if isinstance(node, Scalar) else None
        wrong_type(faults, f"`{name}`", f"{', '.join(words[:-1])} or {words[-1]}", node, help_line)
        return None

    return Reader({"enum": list(words)}, read)


def mapping_of(values: Reader[T], wanted: str = "") -> Reader[dict[Word, T]]:
    """Return the reader of a mapping with arbitrary names. The mapping may be left empty, unless `wanted` describes
    the required contents."""

    def read(node: Tree, name: str, faults: Faults) -> dict[Word, T]:
        if isinstance(node, Mapping):
            found = ((name.word, values.read(value, name.text, faults)) for name, value in node.pairs)
            return {name: value for name, value in found if value is not None}
        if wanted or not (isinstance(node, Scalar) and node.left_empty):
            wrong_type(faults, name if " " in name else f"`{name}`", wanted or "a mapping", node)
        return {}

    shape = "object" if wanted else ["object", LEFT_EMPTY]
    return Reader({"type": shape, "additionalProperties": values.schema}, read, dict)


def mapping_node(values: dict[str, Any]) -> Reader[Mapping]:
    """Return a reader that returns the node of a mapping, which may be left empty."""

    def read(node: Tree, name: str, faults: Faults) -> Mapping | None:
        if not isinstance(node, Mapping) and not (isinstance(node, Scalar) and node.left_empty):
            wrong_type(faults, f"`{name}`", "a mapping", node)
        return node if isinstance(node, Mapping) else None

    return Reader({"type": ["object", LEFT_EMPTY], "additionalProperties": values}, read)


def list_of(items: Reader[T], wanted: str, each: str = "", length: int | None = None) -> Reader[tuple[T, ...]]:
    """Return the reader of a list, which must have `length` items or, by default, at least one; `each` is the name of
    an item in messages."""

    def read(node: Tree, name: str, faults: Faults) -> tuple[T, ...] | None:
        if not isinstance(node, Sequence) or not node.items or len(node.items) != (length or len(node.items)):
            wrong_type(faults, f"`{name}`", wanted, node)
            return None
        found = (items.read(item, each, faults) for item in node.items)
        return tuple(item for item in found if item is not None)

    ends = {"minItems": length or 1, **({"maxItems": length} if length else {})}
    return Reader({"type": "array", "items": items.schema, **ends}, read, tuple)


def record_of(record: type[R], what: str, wanted: str, called: str = "") -> Reader[R]:
    """Return the reader of a mapping with the keys of a record. `called` is the name of the mapping in errors; a `{}`
    in it stands for the key of the mapping."""

    def read(node: Tree, name: str, faults: Faults) -> R | None:
        if isinstance(node, Mapping):
            return read_record(record, node, what, faults)
        wrong_type(faults, called.format(name) or what, wanted, node)
        return None

    return Reader(object_schema(record), read)


# --- JSON schemas ----------------------------------------------------------------------------------------------------


def object_schema(record: type[Record]) -> dict[str, Any]:
    keys = keys_of(record)
    return {
        "type": "object",
        "additionalProperties": False,
        "required": [name for name, known in keys.items() if known.required],
        "properties": {name: {"description": known.meaning, **known.reader.schema} for name, known in keys.items()},
    }


def one_or_more(schema: dict[str, Any]) -> dict[str, Any]:
    return {"anyOf": [schema, {"type": "array", "items": schema, "minItems": 1}]}


def schema_for_editors(title: str, schema: dict[str, Any]) -> str:
    """Return the JSON schema that an editor uses to complete and to check a file while you write it."""
    return json.dumps({"$schema": "http://json-schema.org/draft-07/schema#", "title": title, **schema}, indent=2) + "\n"
