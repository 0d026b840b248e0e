"""Drawings as JSON data, there and back: the fields of each mark, with expressions as `algebra.encoding` has them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from typing import Any

from sympy import Basic, MatrixBase

from derive.algebra.encoding import decoded, encoded
from derive.figures import marks

_CLASSES = {
    each.__name__: each
    for each in vars(marks).values()
    if isinstance(each, type) and issubclass(each, marks.Mark | marks.Drawing | marks.Plot)
}


def drawings_to_data(drawings: Sequence[marks.Recorded]) -> list[Any]:
    return [_to_data(drawing) for drawing in drawings]


def drawings_from_data(data: Sequence[Any]) -> tuple[marks.Recorded, ...]:
    return tuple(_from_data(each) for each in data)


def _to_data(value: Any) -> Any:
    if isinstance(value, Basic | MatrixBase):
        return {"expr": encoded(value)}
    if isinstance(value, tuple | list):
        return [_to_data(each) for each in value]
    if type(value).__name__ in _CLASSES:
        return {"is": type(value).__name__, **{f.name: _to_data(getattr(value, f.name)) for f in fields(value)}}
    if value is None or isinstance(value, str | bool | int | float):
        return value
    raise TypeError(f"a drawing cannot hold a {type(value).__name__}")


def _from_data(data: Any) -> Any:
    if isinstance(data, list):
        return tuple(_from_data(each) for each in data)
    if not isinstance(data, dict):
        return data
    if "is" not in data:
        return decoded(data["expr"])
    made_of = {name: _from_data(value) for name, value in data.items() if name != "is"}
    return _CLASSES[data["is"]](**made_of)
