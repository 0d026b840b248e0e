"""The parts of a problem: what is asked, which steps answer it, for how many points, in what form."""

from __future__ import annotations

import re
from collections.abc import Mapping as Table
from dataclasses import dataclass, field
from fractions import Fraction

from derive.course.prose import Prose, read_prose
from derive.course.schema import FORM_KEYS, PART_KEYS, check_keys, read_figures, wrong_type
from derive.course.units import read_unit
from derive.course.yaml_tree import Mapping, Node, Scalar, Sequence
from derive.errors import Faults, Place, did_you_mean

_STEP_KEY = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,63}")
_POINTS = re.compile(r"[0-9]{1,4}(\.[05])?")


@dataclass(frozen=True)
class AnswerForm:
    """How a number is to be given, in one unit or in several; nothing leaves it to the problem."""

    units: tuple[str, ...] = ()
    figures: int | None = None
    places: tuple[Place, ...] = field(default=(), compare=False, repr=False)


@dataclass(frozen=True)
class Part:
    """One question; `forms` is keyed by answer, or has one entry for `None`."""

    ask: Prose
    answers: tuple[str, ...]
    points: Fraction | None
    forms: Table[str | None, AnswerForm]
    places: Table[str, Place] = field(repr=False)

    def form_of(self, answer: str) -> AnswerForm:
        return self.forms.get(answer) or self.forms.get(None) or AnswerForm()

    def place_of(self, answer: str) -> Place:
        return self.places[answer]


def read_parts(node: Node | None, faults: Faults) -> tuple[Part, ...]:
    if node is None:
        return ()
    if not isinstance(node, Sequence) or not node.items:
        wrong_type(faults, "`parts`", "a list of parts", node)
        return ()
    return tuple(part for item in node.items if (part := _part(item, faults)))


def _part(node: Node, faults: Faults) -> Part | None:
    if not isinstance(node, Mapping):
        wrong_type(faults, "a part", "a mapping with `ask` and `answer`", node)
        return None
    check_keys(node, PART_KEYS, "a part", faults)
    asked, answer, points, form = (node.get(key) for key in ("ask", "answer", "points", "form"))
    if isinstance(asked, Scalar) and asked.empty:
        wrong_type(faults, "`ask`", "text", asked)
    ask = read_prose(asked, "ask", faults) if asked else None
    places = _answers(answer, faults) if answer else {}
    forms = _forms(form, tuple(places), faults) if form else {}
    number = read_points(points, faults)
    return Part(ask, tuple(places), number, forms, places) if ask else None


def _answers(node: Node, faults: Faults) -> dict[str, Place]:
    places: dict[str, Place] = {}
    items = node.items if isinstance(node, Sequence) else (node,)
    for item in items:
        if not isinstance(item, Scalar) or not _STEP_KEY.fullmatch(item.text):
            wrong_type(faults, "`answer`", "the key of a step, or a list of keys", item)
        elif item.text in places:
            faults.error("duplicate-answer", f"`{item.text}` is listed twice", item.place)
        else:
            places[item.text] = item.place
    if not items:
        wrong_type(faults, "`answer`", "the key of a step, or a list of keys", node)
    return places


def _forms(node: Node, answers: tuple[str, ...], faults: Faults) -> dict[str | None, AnswerForm]:
    if not isinstance(node, Mapping):
        wrong_type(faults, "`form`", "a mapping with `unit` and `figures`", node)
        return {}
    if not any(isinstance(value, Mapping) for _, value in node.pairs):
        return {None: _form(node, faults)}
    forms: dict[str | None, AnswerForm] = {}
    for key, value in node.pairs:
        if key.text not in answers:
            help_line = did_you_mean(key.text, answers)
            faults.error("unknown-key", f"this part has no answer `{key.text}`", key.place, help=help_line)
        if isinstance(value, Mapping):
            forms[key.text] = _form(value, faults)
        else:
            wrong_type(faults, f"the form of `{key.text}`", "a mapping with `unit` and `figures`", value)
    return forms


def _form(node: Mapping, faults: Faults) -> AnswerForm:
    check_keys(node, FORM_KEYS, "a form", faults)
    units = _units(node.get("unit"), faults)
    figures = read_figures(node.get("figures"), faults)
    return AnswerForm(tuple(unit.text.strip() for unit in units), figures, tuple(unit.place for unit in units))


def _units(node: Node | None, faults: Faults) -> tuple[Scalar, ...]:
    """One unit, or a list of them: `rpm`, `[rad/s, rpm]`."""
    if node is None:
        return ()
    items = node.items if isinstance(node, Sequence) else (node,)
    if not items or any(not isinstance(item, Scalar) for item in items):
        wrong_type(faults, "`unit`", "a unit", node)
        return ()
    units = tuple(item for item in items if isinstance(item, Scalar))
    for unit in units:
        with faults:
            read_unit(unit.text, unit.place)
    return units


def read_points(node: Node | None, faults: Faults) -> Fraction | None:
    if node is None:
        return None
    if isinstance(node, Scalar) and _POINTS.fullmatch(node.text):
        return Fraction(node.text)
    wrong_type(faults, "`points`", "a number such as 3 or 2.5", node)
    return None


def points_text(points: Fraction) -> str:
    """`3`, `2.5`."""
    return str(points.numerator) if points.denominator == 1 else str(float(points))
