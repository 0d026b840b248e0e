"""The parts of a problem: the question, the steps that answer it, the points, and the form of the answers."""

from __future__ import annotations

import re
from collections.abc import Mapping as Table
from collections.abc import Sequence as List
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

from derive.course.prose import PROSE, Prose
from derive.course.schema import (
    FIGURES,
    TEXT,
    YES_OR_NO,
    Reader,
    Record,
    key,
    list_of,
    mapping_of,
    one_of,
    one_or_more,
    read_record,
    record_of,
    wrong_type,
)
from derive.course.yaml_tree import Mapping, Scalar, Sequence, Tree, Word
from derive.errors import Faults, Place, did_you_mean
from derive.steps.level import Level
from derive.units import UNIT_NAMES, read_unit

_STEP_KEY = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,63}")
_POINTS = re.compile(r"[0-9]{1,4}(\.[05])?")
_FORM_IS = "a mapping with `unit` and `figures`"

UNIT = {"type": "string", "pattern": r"\S", "examples": list(UNIT_NAMES)}


def _points(node: Tree, name: str, faults: Faults) -> Fraction | None:
    if isinstance(node, Scalar) and _POINTS.fullmatch(node.text):
        return Fraction(node.text)
    wrong_type(faults, f"`{name}`", "a number from 0 to 9999.5 in steps of 0.5", node)
    return None


def _units(node: Tree, name: str, faults: Faults) -> tuple[Word, ...]:
    items = node.items if isinstance(node, Sequence) else (node,)
    if not items or any(not isinstance(item, Scalar) for item in items):
        wrong_type(faults, f"`{name}`", "a unit", node)
        return ()
    units = tuple(Word.at(item.text.strip(), item.place) for item in items if isinstance(item, Scalar))
    for i, unit in enumerate(units):
        with faults:
            read_unit(unit, unit.place)
        if unit in units[:i]:
            faults.error("duplicate-answer", f"`{unit}` is listed twice", unit.place)
    return units


def _answers(node: Tree, name: str, faults: Faults) -> tuple[Word, ...]:
    answers: dict[str, Word] = {}
    items = node.items if isinstance(node, Sequence) else (node,)
    for item in items:
        if not isinstance(item, Scalar) or not _STEP_KEY.fullmatch(item.text):
            wrong_type(faults, f"`{name}`", "the key of a step, or a list of keys", item)
        elif item.text in answers:
            faults.error("duplicate-answer", f"`{item.text}` is listed twice", item.place)
        else:
            answers[item.text] = item.word
    if not items:
        wrong_type(faults, f"`{name}`", "the key of a step, or a list of keys", node)
    return tuple(answers.values())


def _boxed(node: Tree, name: str, faults: Faults) -> tuple[Word, ...] | None:
    return () if isinstance(node, Sequence) and not node.items else _answers(node, name, faults)


def _level(node: Tree, name: str, faults: Faults) -> Level | None:
    word = _LEVELS.read(node, name, faults)
    return Level(word) if word else None


def _method(node: Tree, name: str, faults: Faults) -> Word | None:
    word = _METHODS.read(node, name, faults)
    return Word.at(word, node.place) if word else None


LAGRANGE, NEWTON, ENERGY, ANGULAR_MOMENTUM, BOTH = METHODS = (
    "lagrange",
    "newton",
    "energy",
    "angular_momentum",
    "both",
)
_METHODS = one_of(METHODS)
METHOD = Reader(_METHODS.schema, _method)
_LEVELS = one_of(tuple(Level))
DETAIL = Reader(_LEVELS.schema, _level, lambda: Level.BRIEF)
POINTS = Reader({"type": "number", "minimum": 0, "maximum": 9999.5, "multipleOf": 0.5}, _points)
KEY_OF_STEP = {"type": ["string", "boolean"], "pattern": f"^{_STEP_KEY.pattern}$"}


def _observations(node: Tree, name: str, faults: Faults) -> tuple[Word, ...] | None:
    items = node.items if isinstance(node, Sequence) else (node,)
    if not items or any(not isinstance(item, Scalar) or not _STEP_KEY.fullmatch(item.text) for item in items):
        wrong_type(faults, f"`{name}`", "`none`, or one or more kinds of observations", node)
        return None
    return tuple(item.word for item in items if isinstance(item, Scalar))


OBSERVATIONS = Reader(one_or_more(KEY_OF_STEP), _observations)
OBSERVATIONS_MEANING = (
    "the kinds of observations after the answers, such as `pendulum`, or `none`; without this key, derive chooses"
)


@dataclass(frozen=True)
class AnswerForm(Record):
    """The required form of a number, in one unit or in several."""

    units: tuple[Word, ...] = key(
        "unit of the number, such as `degree` or `N m`, or a list of units",
        Reader(one_or_more(UNIT), _units, tuple),
        called="unit",
    )
    figures: int | None = key("significant figures of the number", FIGURES)


_FORM = record_of(AnswerForm, "a form", _FORM_IS, "the form of `{}`")
_FORM_BY_ANSWER = mapping_of(_FORM, _FORM_IS)


def _form_of_set(node: Tree, name: str, faults: Faults) -> AnswerForm | None:
    form = _FORM.read(node, name, faults)
    if isinstance(node, Mapping) and not node.pairs:
        faults.error(
            "unused-key", f"`{name}` has no effect without `unit` or `figures`", node.place, help="leave it out"
        )
    return form


FORM_OF_SET = Reader({**_FORM.schema, "minProperties": 1}, _form_of_set)


def _forms(node: Tree, name: str, faults: Faults) -> dict[str | None, AnswerForm]:
    if not isinstance(node, Mapping):
        wrong_type(faults, f"`{name}`", _FORM_IS, node)
        return {}
    if not any(isinstance(value, Mapping) for _, value in node.pairs):
        return {None: read_record(AnswerForm, node, "a form", faults)}
    return dict((_FORM_BY_ANSWER.read(node, name, faults) or {}).items())


@dataclass(frozen=True)
class Question(Record):
    """One part of a problem. `forms` has the form of each answer by its key; the key `None` is for all answers."""

    ask: Prose = key(
        "the question, in prose; `<<cases>>` stands for the numbers in the cases of the part's plot",
        PROSE,
        required=True,
    )
    answers: tuple[Word, ...] = key(
        "key of the step that answers the question, or a list of keys",
        Reader(one_or_more(KEY_OF_STEP), _answers, tuple),
        called="answer",
        required=True,
    )
    boxed: tuple[Word, ...] | None = key(
        "the answers that are boxed, by key, or `[]` for none; by default all of them",
        Reader({"anyOf": [KEY_OF_STEP, {"type": "array", "items": KEY_OF_STEP}]}, _boxed),
        called="box",
    )
    points: Fraction | None = key("points of this part", POINTS)
    extra: bool = key(
        "`true` if the part asks for more than the source does; it carries no points and is marked as extra", YES_OR_NO
    )
    detail: Level = key(
        "`full` or `standard`: an extra part appears only at this detail or a higher one; its steps are always derived",
        DETAIL,
    )
    forms: Table[str | None, AnswerForm] = key(
        "unit and significant figures of the answers: one form for all answers, or one form under each answer's key",
        Reader({"anyOf": [_FORM.schema, _FORM_BY_ANSWER.schema]}, _forms, dict),
        called="form",
    )

    observations: tuple[Word, ...] | None = key(OBSERVATIONS_MEANING, OBSERVATIONS)
    rubric: dict[Word, Fraction] = key(
        "points for some steps, by key; the remaining points are shared among the other steps", mapping_of(POINTS)
    )
    method: Word | None = key("the method of this part, in place of the method of the problem", METHOD)
    cases: Word | None = key(
        "the name of a plot in `drawings:`; the answers get numbers for each of its `cases:`", TEXT
    )

    def form_of(self, answer: str) -> AnswerForm:
        return self.forms.get(answer) or self.forms.get(None) or AnswerForm({}, {})


_PART = record_of(Question, "a part", "a mapping with `ask` and `answer`")


def _part(node: Tree, name: str, faults: Faults) -> Question | None:
    part = _PART.read(node, name, faults)
    for answer in part.forms if part else ():
        if part and isinstance(answer, Word) and answer not in part.answers:
            help_line = did_you_mean(answer, part.answers)
            faults.error("unknown-key", f"this part has no answer `{answer}`", answer.place, help=help_line)
    for answer in (part.boxed or ()) if part else ():
        if part and answer not in part.answers:
            help_line = did_you_mean(answer, part.answers)
            faults.error("unknown-key", f"this part has no answer `{answer}`", answer.place, help=help_line)
    if part and part.extra and part.points is not None:
        message = "a part that is `extra` carries no points"
        faults.error("points", message, part.places["points"], help="leave `points` out, or `extra`")
        part = replace(part, points=None)
    if part and (said := sum(part.rubric.values(), Fraction(0))) > (part.points or 0):
        has = f"has {points_text(part.points)}" if part.points is not None else "has no points"
        message = f"the steps of `rubric` have {points_text(said)} points, but the part {has}"
        faults.error(
            "points",
            message,
            part.places["rubric"],
            help="leave it out" if part.extra else "give the part more points, or lower the points of these steps",
        )
    if part and part.detail is not Level.BRIEF and not part.extra:
        message = "a part that is not `extra` is shown at every detail"
        faults.error("detail", message, part.places["detail"], help="leave `detail` out, or write `extra: true`")
    return part if part and part.ask else None


_LISTED = list_of(Reader(_PART.schema, _part), "a list of parts")


def _parts(node: Tree, name: str, faults: Faults) -> tuple[Question, ...] | None:
    """Return the parts that can be read; None if the value is not a list of parts. Report a part that needs more
    detail than the next part."""
    parts = _LISTED.read(node, name, faults)
    for part, following in pairwise(parts or ()):
        if not following.detail.shows(part.detail):
            message = f"this part is shown at the detail `{part.detail}`, but the next part is shown at less detail"
            faults.error("detail", message, part.places["detail"], help="put this part after the parts of lower detail")
    return parts


PARTS = Reader(_LISTED.schema, _parts, _LISTED.absent)


def points_in_all(
    stated: Fraction | None, place: Place | None, parts: List[Question], faults: Faults
) -> Fraction | None:
    """Return the points of a problem: the stated points, or the sum over its parts; None if no points are
    stated, or if there are no parts."""
    counted = [part.points for part in parts if part.points is not None]
    total = sum(counted, Fraction(0))
    if stated is None or not parts:
        return total if counted else None
    complete = len(counted) == sum(not part.extra for part in parts)
    if total > stated or (complete and total < stated):
        added = f"the points of the parts {'' if complete else 'already '}add up to {points_text(total)}"
        faults.error("points", f"`points` is {points_text(stated)}, but {added}", place)
    return stated


def points_text(points: Fraction) -> str:
    """Return points as text: `3`, `2.5`."""
    return str(points.numerator) if points.denominator == 1 else str(float(points))
