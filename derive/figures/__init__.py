"""Drawings as a script describes them: `drawing("vectors", outline(block), arrow(omega, ...), ...)`."""

from derive.figures.scenes import (
    angle,
    arrow,
    axes,
    axis_of_rotation,
    drawing,
    length,
    outline,
    plot,
    point,
    turn,
)

__all__ = [
    "angle",
    "arrow",
    "axes",
    "axis_of_rotation",
    "drawing",
    "length",
    "outline",
    "plot",
    "point",
    "turn",
]
