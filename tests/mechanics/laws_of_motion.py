"""Wrong laws of coordinates and of motion: see `test_wrong_laws.py`."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

from sympy import Symbol, cos, sin

Verbs = SimpleNamespace
COORDINATES = "mechanics.coordinates"
R = Symbol("R", positive=True)


def height(verbs: Verbs) -> Any:
    """Of a point on a rolling body: R(theta sin theta + cos theta)."""
    from derive.step import establish

    theta = verbs.coordinate("theta")
    q = theta.symbol
    return establish(
        "equations.let",
        Symbol("y", real=True),
        lambda: R * (q * sin(q) + cos(q)),
        {},
        key="y",
        definition=True,
        kind="length",
        coordinates=theta.letters,
    )


RUNS: dict[str, Callable[[Verbs], Any]] = {"rate_of": lambda verbs: verbs.rate_of(height(verbs))}
LAWS: list[tuple[str, str, str, str, str]] = [
    ("rate_of", COORDINATES, "lambda x: TimeRate(x, *moving)", "lambda x: 2 * TimeRate(x, *moving)", "y_rate"),
    ("rate_of", COORDINATES, "lambda x: TimeRate(x, *moving)", "lambda x: TimeRate(x**2, *moving)", "y_rate"),
]
ROUTES: list[tuple[str, str, str, str, str]] = [
    ("rate_of", COORDINATES, "for _ in range(order):", "for _ in range(order + 1):", "y_rate"),
]
