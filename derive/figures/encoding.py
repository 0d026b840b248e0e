"""Encode drawings as JSON data, and decode them; `algebra.encoding` encodes the expressions in the fields of marks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from derive.algebra.encoding import as_data, from_data
from derive.figures.marks import (
    MARK_CLASSES,
    Across,
    Branch,
    Diagram,
    Drawing,
    Further,
    Levels,
    Outline,
    Plot,
    Recorded,
    ShownMode,
    ShownPolhodes,
)


def drawings_to_data(drawings: Sequence[Recorded]) -> Any:
    return as_data(list(drawings), _classes())


def drawings_from_data(data: Any) -> tuple[Recorded, ...]:
    found: tuple[Recorded, ...] = from_data(data, _classes())
    return found


def _classes() -> dict[str, Any]:
    return {
        **MARK_CLASSES,
        "Across": Across,
        "Branch": Branch,
        "Diagram": Diagram,
        "Drawing": Drawing,
        "Further": Further,
        "Levels": Levels,
        "Outline": Outline,
        "Plot": Plot,
        "ShownMode": ShownMode,
        "ShownPolhodes": ShownPolhodes,
    }
