"""Drawings as a script describes them: `drawing("vectors", outline(block), arrow(omega, ...), ...)`."""

from derive.figures.bodies import outline
from derive.figures.machines import leaning_top, slab_on_cylinder
from derive.figures.scenes import (
    arc,
    arrow,
    axes,
    axis_of_rotation,
    drawing,
    length,
    plot,
    point,
    turn,
    vectors_in,
)

__all__ = [
    "arc",
    "arrow",
    "axes",
    "axis_of_rotation",
    "drawing",
    "leaning_top",
    "length",
    "outline",
    "plot",
    "point",
    "slab_on_cylinder",
    "turn",
    "vectors_in",
]
