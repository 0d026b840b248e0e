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
DRAWING = (
    "derive.render.drawing.canvas",
    "derive.render.drawing.picture",
    "derive.render.drawing.plotting",
    "matplotlib.backends.backend_pdf",
    "matplotlib.backends.backend_svg",
    "matplotlib.style",
)


def load(draws: bool) -> None:
    """The modules that derive a problem and print it; and those that draw."""
    for name in (*DERIVING, *(DRAWING if draws else ())):
        import_module(name)
