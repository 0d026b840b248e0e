"""What the workers of a build need, loaded before they are forked: once, and not in each of them."""

from __future__ import annotations

from importlib import import_module

__all__ = ["load"]

DERIVING = (
    "derive.building.solution",
    "derive.course.latex",
    "derive.given",
    "derive.mechanics",
    "derive.render.printing.contract",
    "derive.stock.body",
    "derive.stock.rotation",
    "derive.stock.system",
    "sympy.tensor.array.expressions",
    "sympy.tensor.tensor",
)
DRAWING = ("derive.render.drawing.picture", "derive.render.drawing.plotting")


def load(draws: bool) -> None:
    """The modules that derive a problem and print it; and those that draw."""
    for name in (*DERIVING, *(DRAWING if draws else ())):
        import_module(name)
    if draws:
        from derive.render.drawing.lettering import letters_of

        letters_of(["$x$"])  # by the first letter all that sets letters is loaded
