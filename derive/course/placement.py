"""`drawings:` of a problem: where each drawing of the script stands, its caption, its width and its numbers."""

from __future__ import annotations

import re
from collections.abc import Mapping as Table
from dataclasses import dataclass, field

from sympy import Expr, Symbol

from derive.algebra.expressions import scalar
from derive.course.expression import Declared
from derive.course.given import Measured, read_measured, read_value
from derive.course.prose import Prose, read_prose
from derive.course.schema import DRAWING_KEYS, check_keys, wrong_type
from derive.course.yaml_tree import Mapping, Node, Scalar, Sequence
from derive.errors import Faults, Place, did_you_mean, rejected

STATEMENT, HIDDEN = "statement", "hidden"
_KEY = re.compile(r"[a-z][a-z0-9_]+", re.ASCII)
WIDEST, NARROWEST = 15.0, 1.0  # centimetres


@dataclass(frozen=True)
class Placement:
    """What a problem says of one drawing; nothing where it leaves the choice to derive."""

    key: str
    place: Place = field(repr=False)
    at: str | None = None
    at_place: Place | None = field(default=None, repr=False)
    caption: Prose | None = None
    width: float | None = None
    values: tuple[tuple[Symbol, Expr], ...] = ()
    names: Table[str, Place] = field(default_factory=dict, repr=False)
    ends: tuple[Node, Node] | None = field(default=None, repr=False)
    cases: tuple[tuple[Measured, ...], ...] = ()


def read_placements(node: Mapping, symbols: Table[str, Declared], parts: int, faults: Faults) -> tuple[Placement, ...]:
    """Every entry of `drawings:`; which drawings there are is known when the script has run."""
    found = []
    for key, entry in node.pairs:
        if not isinstance(entry, Mapping):
            wrong_type(faults, f"the drawing `{key.text}`", "a mapping with `at`, `caption` or `width`", entry)
            continue
        check_keys(entry, DRAWING_KEYS, "a drawing", faults)
        at, caption = entry.get("at"), entry.get("caption")
        found.append(
            Placement(
                key=key.text,
                place=key.place,
                at=_at(at, parts, faults),
                at_place=at.place if at else None,
                caption=read_prose(caption, "caption", faults) if caption else None,
                width=_width(entry.get("width"), faults),
                values=_values(entry.get("values"), symbols, faults),
                names={name.text: name.place for name, _ in _pairs(entry.get("values"), "values", Faults())},
                ends=_ends(entry.get("range"), symbols, faults),
                cases=_cases(entry.get("cases"), symbols, faults),
            )
        )
    return tuple(found)


def _at(node: Node | None, parts: int, faults: Faults) -> str | None:
    letters = [chr(ord("a") + i) for i in range(parts)]
    known = [STATEMENT, *letters, HIDDEN]
    if node is None or (isinstance(node, Scalar) and node.text in known):
        return node.text if node else None
    help_line = did_you_mean(node.text, (STATEMENT, HIDDEN)) if isinstance(node, Scalar) else None
    if isinstance(node, Scalar) and help_line is None and _KEY.fullmatch(node.text):
        return node.text  # a step: whether there is one of that name is known when the script has run
    last = f"part a to {letters[-1]}" if parts > 1 else "part a"
    wrong_type(faults, "`at`", f"statement, {last}, or hidden", node, help_line)
    return None


def _width(node: Node | None, faults: Faults) -> float | None:
    if node is None:
        return None
    with faults:
        width = 100 * float(read_value("width", node, "length", {}))
        if NARROWEST <= width <= WIDEST:
            return width
        rejected("wrong-size", f"`width` must be from {NARROWEST:g} to {WIDEST:g} cm", node.place)
    return None


def _values(node: Node | None, symbols: Table[str, Declared], faults: Faults) -> tuple[tuple[Symbol, Expr], ...]:
    """Numbers or proportions of letters, in the order written; a proportion is in terms of other letters."""
    found: list[tuple[Symbol, Expr]] = []
    for key, value in _pairs(node, "values", faults):
        # A coordinate of the script is not declared; whether the drawing has it is known when the script has run.
        declared = symbols.get(key.text) or Declared(key.text, scalar(key.text), "angle")
        with faults:
            expr = read_value(key.text, value, declared.kind, symbols)
            if declared.symbol in expr.free_symbols:
                rejected("circular", f"`{key.text}` cannot be drawn in terms of itself", value.place)
            found.append((declared.symbol, expr))
    return tuple(found)


def _ends(node: Node | None, symbols: Table[str, Declared], faults: Faults) -> tuple[Node, Node] | None:
    """The two ends of a range as they are written; of what kind they must be is known when the script has run."""
    if node is None:
        return None
    if isinstance(node, Sequence) and len(node.items) == 2:
        return node.items[0], node.items[1]
    wrong_type(faults, "`range`", "the two ends of a range, such as `[-60 deg, 60 deg]`", node)
    return None


def _cases(node: Node | None, symbols: Table[str, Declared], faults: Faults) -> tuple[tuple[Measured, ...], ...]:
    if node is None:
        return ()
    if not isinstance(node, Sequence) or not node.items:
        wrong_type(faults, "`cases`", "a list of mappings such as `{R: 20 cm, a: 5 cm}`", node)
        return ()
    found = []
    for item in node.items:
        case = []
        for key, value in _pairs(item, "a case", faults):
            with faults:
                case.append(read_measured(key, value, symbols))
        found.append(tuple(case))
    return tuple(found)


def _pairs(node: Node | None, what: str, faults: Faults) -> tuple[tuple[Scalar, Node], ...]:
    if node is None or isinstance(node, Mapping):
        return node.pairs if node else ()
    wrong_type(faults, f"`{what}`" if " " not in what else what, "a mapping such as `{R: 20 cm, a: 5 cm}`", node)
    return ()
