"""Names of places on the horizontal axis of a plot: if the solution derives a radius r_0, the plot names it r_0."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from sympy import Expr, Symbol

from derive.algebra.expressions import bound, explicit
from derive.figures.marks import Plot, Recorded
from derive.steps.step import Step

__all__ = ["with_places"]


def with_places(drawing: Recorded, steps: Sequence[Step]) -> Recorded:
    """Return a plot with the values that the steps find for its variable, each with its symbol. Such a symbol is the
    variable with a subscript: r_0 for r. A path, a bifurcation diagram and a drawing that is not a plot are returned
    unchanged."""
    if not isinstance(drawing, Plot) or drawing.across is not None or drawing.diagram is not None:
        return drawing
    names = {name: explicit(value) for step in steps for name, value in step.names}
    found = []
    for step in steps:
        if isinstance(step.symbol, Symbol) and step.symbol.name.startswith(f"{drawing.variable}_"):
            value = explicit(step.result)
            for _ in names:  # the value of a name may contain other names
                value = bound(value, names)
            value = explicit(value)
            if isinstance(value, Expr) and value.free_symbols and drawing.variable not in value.free_symbols:
                found.append((step.symbol, value))
    return replace(drawing, places=tuple(found))
