"""The key `variants:` of a problem: which numbers and which given values vary, and the choices for each student.

    variants:
      b: 10..30 cm in steps of 2             a number of `values:`, or a given value
      theta: [30 deg, 45 deg, 60 deg]
      axis: [diagonal, x, y]                 a given direction, so the derivation differs, too

A choice replaces the value in the file before the keys of the file are read, so a variant is read and derived like any
other problem. The choice for a student does not depend on other problems or variations.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator
from collections.abc import Mapping as Table
from dataclasses import dataclass
from decimal import Decimal
from itertools import pairwise

from derive.course.schema import Reader, wrong_type
from derive.course.yaml_tree import Mapping, Scalar, Sequence, Tree, Word, decimal_comma
from derive.errors import Faults, Place, did_you_mean

MOST = 10_000  # greatest number of values of a range
WANTED = "a range such as `10..30 cm in steps of 2`, or a list of at least two values"
_NUMBER = r"[+-]?\d{1,15}(?:\.\d{1,15})?"
_RANGE = re.compile(rf"\s*({_NUMBER})\s*\.\.\s*({_NUMBER})\s*(.*?)\s+in\s+steps\s+of\s+({_NUMBER})\s*")

Chosen = Table[str, int]  # the name of a variation -> the number of its choice


@dataclass(frozen=True)
class Variation:
    """A letter of `values:`, or the path of a given value such as `body.inner`, with its choices."""

    name: Word
    choices: tuple[Tree, ...]
    is_range: bool = False

    @property
    def tried(self) -> tuple[int, ...]:
        """The choices that are read with the problem: the ends of a range, or each entry of a list."""
        last = len(self.choices) - 1
        return (0, last) if self.is_range else tuple(range(last + 1))

    def contains(self, choice: int, place: Place) -> bool:
        """Return whether a place in the file is within a choice."""
        within = [*_places(self.choices[choice])]
        last = within[-1]
        ends = (last.line, last.column + last.width)
        return (within[0].line, within[0].column) <= (place.line, place.column) <= ends

    def told(self, choice: int) -> str:
        """Return a choice as text, for a list of the variants."""
        node = self.choices[choice]
        return _told(node)


def _places(node: Tree) -> Iterator[Place]:
    """Yield the places of a value and of the values inside it, in the order of the file."""
    yield node.place
    inner = node.items if isinstance(node, Sequence) else ()
    if isinstance(node, Mapping):
        inner = tuple(each for pair in node.pairs for each in pair)
    for each in inner:
        yield from _places(each)


def _told(node: Tree) -> str:
    if isinstance(node, Scalar):
        return node.text
    if isinstance(node, Sequence):
        return f"[{', '.join(map(_told, node.items))}]"
    return "{" + ", ".join(f"{name.text}: {_told(value)}" for name, value in node.pairs) + "}"


def _read(node: Tree, name: str, faults: Faults) -> tuple[Variation, ...] | None:
    if not isinstance(node, Mapping) or not node.pairs:
        wrong_type(faults, f"`{name}`", "a mapping of names to their choices", node)
        return None
    found = [
        Variation(key.word, _choices(value, key.text, faults), isinstance(value, Scalar)) for key, value in node.pairs
    ]
    return tuple(each for each in found if each.choices)


def _choices(node: Tree, name: str, faults: Faults) -> tuple[Tree, ...]:
    if isinstance(node, Sequence) and len(node.items) > 1:
        cut = next(filter(None, (_cut_at_comma(*pair) for pair in pairwise(node.items))), None)
        if cut is None:
            return node.items
        faults.add(decimal_comma(cut.text, cut.place))
        return ()
    if isinstance(node, Sequence) and node.items:
        faults.error("variants", f"the variation of `{name}` must be {WANTED}, but it has one value", node.place)
        return ()
    if not isinstance(node, Scalar):
        wrong_type(faults, f"the variation of `{name}`", WANTED, node)
        return ()
    found = _RANGE.fullmatch(node.text)
    if not found and re.search(r"\d,\d", node.text):
        faults.add(decimal_comma(node.text, node.place))
        return ()
    if not found:
        faults.error("variants", f"the variation of `{name}` must be {WANTED}", node.place)
        return ()
    first, last, step = (Decimal(found[group]) for group in (1, 2, 4))
    if step <= 0 or last <= first:
        faults.error("variants", "a range must increase, with a positive step", node.place)
        return ()
    count = int((last - first) / step) + 1
    if not 1 < count <= MOST:
        faults.error("variants", f"a range must have 2 to {MOST} values, but this one has {count}", node.place)
        return ()
    if (end := first + (count - 1) * step) != last:
        unit = f" {found[3]}" if found[3] else ""
        message = f"steps of {found[4]} lead from {found[1]} to {_plain(end)}{unit}, not to {found[2]}{unit}"
        help_line = f"write `{found[1]}..{_plain(end)}{unit} in steps of {found[4]}`"
        faults.error("variants", message, node.place, help=help_line)
        return ()
    return tuple(_scalar(f"{_plain(first + number * step)} {found[3]}".strip(), node) for number in range(count))


def _cut_at_comma(first: Tree, second: Tree) -> Scalar | None:
    """Return the complete value, such as `0,8 m`, if a decimal comma has split it into two items of a list such as
    `[0,8 m, 0,9 m]`. Return None if the two items are separate values."""
    if not (isinstance(first, Scalar) and isinstance(second, Scalar)):
        return None
    if not (first.text.isdigit() and second.start == first.end + 1 and re.match(r"\d+\s", second.text)):
        return None
    return Scalar(first.source.text[first.start : second.end], "", first.start, second.end, first.source)


def _plain(number: Decimal) -> str:
    return format(number.normalize(), "f")


def _scalar(text: str, written: Scalar) -> Scalar:
    value = Scalar(text, "", written.start, written.end, written.source)
    value.__dict__["_spans"] = [(written.start, written.end)] * len(text)
    return value


VARIANTS: Reader[tuple[Variation, ...]] = Reader(
    {
        "type": "object",
        "minProperties": 1,
        "additionalProperties": {
            "anyOf": [{"type": "string", "pattern": f"^{_RANGE.pattern}$"}, {"type": "array", "minItems": 2}]
        },
    },
    _read,
    tuple,
)


def check_variations(problem: Mapping, variations: tuple[Variation, ...], faults: Faults) -> None:
    """Report each variation whose name is neither in `values:` nor in `given:`."""
    for variation in variations:
        if _path(problem, variation.name) is None:
            known = [key.text for under in ("values", "given") for key, _ in _pairs(problem.get(under))]
            message = f"neither `values` nor `given` has `{variation.name}`, so it cannot vary"
            help_line = did_you_mean(variation.name, known) or "write the value for the problem itself under `values`"
            faults.error("variants", message, variation.name.place, help=help_line)


def _pairs(node: Tree | None) -> tuple[tuple[Scalar, Tree], ...]:
    return node.pairs if isinstance(node, Mapping) else ()


def _path(problem: Mapping, name: str) -> tuple[str, ...] | None:
    """Return the keys that lead to the value with this name; None if there is no such value."""
    for path in (("values", name), ("given", name), ("given", *name.split("."))):
        node: Tree | None = problem
        for key in path:
            node = node.get(key) if isinstance(node, Mapping) else None
        if node is not None:
            return path
    return None


def chosen_for(set_id: str, problem: str, variations: tuple[Variation, ...], student: str, seed: str) -> Chosen:
    """Return the choices for a student, which are the same at each call."""

    def number(variation: Variation) -> int:
        text = "\0".join((seed, set_id, problem, student, variation.name))
        return int.from_bytes(hashlib.sha256(text.encode()).digest()[:8], "big") % len(variation.choices)

    return {str(variation.name): number(variation) for variation in variations}


def with_choices(problem: Mapping, variations: tuple[Variation, ...], chosen: Chosen) -> Mapping:
    """Return the mapping of a problem with the chosen values in it."""
    for variation in variations:
        path = _path(problem, variation.name)
        if path and variation.name in chosen:
            problem = _replaced(problem, path, variation.choices[chosen[variation.name]])
    return problem


def _replaced(node: Mapping, path: tuple[str, ...], value: Tree) -> Mapping:
    key, *below = path

    def new(old: Tree) -> Tree:
        return _replaced(old, tuple(below), value) if below and isinstance(old, Mapping) else value

    return Mapping(tuple((name, new(old) if name.text == key else old) for name, old in node.pairs), node.place)
