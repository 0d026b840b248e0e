"""Write the table of shapes in the documentation: the sizes, the position and the points of each shape."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from sympy import Expr, Symbol, sstr, symbols

from derive.mechanics import Triangle, Wedge
from derive.mechanics.bodies.body import Body
from derive.stock.keys.bodies import shapes, ways_to_tell

DOCUMENT = Path(__file__).parent.parent / "docs" / "yaml-alone.md"
START, END = "<!-- the shapes, by tools/shapes.py -->\n", "<!-- the end of the shapes -->\n"
LETTERS = {
    "radius": "R", "height": "h", "length": "l", "inner": "a", "outer": "b", "section": "c", "half_angle": "alpha",
}  # fmt: skip
SEVERAL = {"sides": "a b c", "semi_axes": "a b c"}
M = Symbol("M", positive=True)


def table() -> str:
    """Return a table with a line for each shape: its sizes, its position in its body axes, and its named points."""
    lines = ["| `shape` | sizes | in its own axes | points |\n", "|---|---|---|---|\n"]
    return "".join([*lines, *(_line(name, shape) for name, shape in sorted(shapes().items()))])


def _line(name: str, shape: type[Body]) -> str:
    ways = ways_to_tell(shape)
    sizes = ", or ".join(", ".join(f"`{size}`" for size in way) for way in ways if way)
    return f"| `{name}` | {sizes} | {_how_it_lies(shape)} | {_points(shape)} |\n"


def _how_it_lies(shape: type[Body]) -> str:
    """Return the first sentence of the docstring of a shape, without "A", "thin" and "uniform" at its beginning."""
    first = " ".join((shape.__doc__ or "").split(".")[0].split())
    return re.sub(r"^(A|An|The|Half of a) (thin )?(uniform )?", lambda m: "half of a " * ("Half" in m[0]), first)


def _points(shape: type[Body]) -> str:
    body = _made(shape)
    if body is None:
        return "its corners: `first corner`, ..."
    names = [*(known for known in body.points() if known != "centre"), "centre"]
    told = [f"`{'centre_of_mass' if n == 'centre' else n}` {_written(body.point(n).position)}" for n in names]
    return ", ".join(told)


def _made(shape: Any) -> Any:
    """Return a body of this shape with a symbol for each size; None if the sizes of the shape are its corners."""
    if shape in (Triangle, Wedge):
        a, h, d, l = symbols("base height foot length", positive=True)
        face = Triangle.on_base(a, h, M, d)
        return face if shape is Triangle else Wedge(face, l, M)
    (way,) = ways_to_tell(shape)
    if "corners" in way:
        return None
    given: list[Any] = []
    for size in way:
        count = 2 if shape.__name__ == "Plate" else 3
        several = symbols(SEVERAL[size], positive=True)[:count] if size in SEVERAL else ()
        given.append(several or Symbol(LETTERS[size], positive=True))
    return shape(*given, M)


def _written(position: Any) -> str:
    return f"({', '.join(map(_short, position))})"


def _short(x: Expr) -> str:
    return sstr(x)


def updated(text: str) -> str:
    """Return the document with the current table."""
    before, _, rest = text.partition(START)
    return before + START + table() + END + rest.partition(END)[2]


def main() -> None:
    DOCUMENT.write_text(updated(DOCUMENT.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
