"""Drawings as JSON data, there and back: the fields of each mark, with expressions as `algebra.encoding` has them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from typing import Any

from sympy import Basic, MatrixBase

from derive.algebra.encoding import decoded, encoded
from derive.figures.marks import MARK_CLASSES, Drawing, Plot, Recorded

_SCENES: dict[str, Any] = {each.__name__: each for each in (Drawing, Plot)}


def drawings_to_data(drawings: Sequence[Recorded]) -> list[Any]:
    return [_to_data(drawing) for drawing in drawings]


def drawings_from_data(data: Sequence[Any]) -> tuple[Recorded, ...]:
    return tuple(_from_data(each) for each in data)


def _to_data(value: Any) -> Any:
    if isinstance(value, Basic | MatrixBase):
        return {"expr": encoded(value)}
    if isinstance(value, tuple | list):
        return [_to_data(each) for each in value]
    name = type(value).__name__
    if _class_of(name) is type(value):
        return {"is": name, **{f.name: _to_data(getattr(value, f.name)) for f in fields(value)}}
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
    return _class_of(data["is"])(**made_of)


def _class_of(name: str) -> Any:
    return MARK_CLASSES.get(name) or _SCENES.get(name)
