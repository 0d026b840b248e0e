"""Directions and rotations, as `given:` describes them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

from sympy import Expr

from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.direction import Direction
from derive.algebra.kinds import named
from derive.course.expression import read_expression
from derive.course.given import DIRECTION_NAMES
from derive.course.schema import SCALAR, as_written
from derive.course.stock import InLetters, each
from derive.course.yaml_tree import Scalar, Sequence, Tree, Word
from derive.errors import Faults, did_you_mean, rejected

DIRECTION = as_written(
    {
        "anyOf": [
            {"enum": list(DIRECTION_NAMES)},
            {"type": "array", "items": SCALAR.schema, "minItems": 3, "maxItems": 3},
        ]
    },
    "a direction or three components",
)


@dataclass(frozen=True)
class Axis:
    """A direction by its name or by its components."""

    named: Direction

    @property
    def is_name(self) -> bool:
        return self.named.name is not None

    @property
    def components(self) -> tuple[Expr, Expr, Expr]:
        assert self.named.components is not None
        return self.named.components


class Directions:
    """Reads directions in the symbols of a description."""

    def __init__(self, letters: InLetters):
        self.letters = letters

    def axis(self, node: Tree, name: str) -> Axis:
        """Return `diagonal`, `x`, `y`, `z`, or three components of one dimension that do not all vanish."""
        names = ", ".join(f"`{known}`" for known in DIRECTION_NAMES)
        if isinstance(node, Scalar) and node.text in DIRECTION_NAMES:
            return Axis(Direction(node.text))
        if isinstance(node, Scalar) and not node.empty:
            help_line = did_you_mean(node.text, DIRECTION_NAMES) or f"the names are {names}"
            rejected("wrong-kind", f"`{name}` must be a direction, but `{node.text}` is not one", node.place, help_line)
        if not isinstance(node, Sequence) or len(node.items) != 3:
            message = f"`{name}` must be a direction or three components"
            rejected("wrong-type", message, node.place, f"write {names}, or `[1, 1, 0]`")
        x, y, z = each([partial(self._component, item, name) for item in node.items])
        faults = Faults()
        dimensions = {dimension for value, dimension in (x, y, z) if not value.is_zero}
        if not dimensions:
            faults.error("zero-axis", f"`{name}` has no direction: every component is zero", node.place)
        if len(dimensions) > 1:
            one, other = sorted(named(dimension) for dimension in dimensions)[:2]
            faults.error(
                "dimension",
                f"the components of `{name}` have different dimensions: one is {one}, another {other}",
                node.place,
            )
        faults.stop()
        return Axis(Direction(None, (x[0], y[0], z[0])))

    def _component(self, node: Tree, name: str) -> tuple[Expr, Dimension]:
        if not isinstance(node, Scalar) or node.empty:
            return self.letters.of_kind(node, f"a component of {name}", "number"), NUMBER
        return read_expression(node, self.letters.letters)

    def turns(self, written: Mapping[Word, Tree]) -> tuple[tuple[str, Expr], ...]:
        """Return each rotation about one of the axes, in the order of the file."""
        return tuple(each([partial(self._turn, axis, node) for axis, node in written.items()]))

    def _turn(self, axis: Word, node: Tree) -> tuple[str, Expr]:
        if axis not in ("x", "y", "z"):
            rejected("no-such-axis", f"axes can rotate about x, y or z, not about `{axis}`", axis.place)
        return str(axis), self.letters.of_kind(node, f"the angle about {axis}", "angle")
