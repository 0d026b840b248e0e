"""The position, caption and alternative text of each drawing on a page.

The alternative text is derived from the marks or the curves, so the text changes with the inputs. A drawing
appears in the statement if it shows only inputs. Some drawings, such as a force diagram, are placed before the steps
that they explain. Any other drawing appears in the part that derives the last of its steps. A problem may move a
drawing to a later part.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import gcd
from typing import Any, TypeGuard

from sympy import Expr, Symbol, lcm

from derive.algebra.expressions import AXES, Amount, Relation, bound, explicit, scalar
from derive.algebra.tidy import tidied
from derive.course.given import Measured
from derive.course.placement import HIDDEN, STATEMENT, Placement, case_label
from derive.course.problem import Problem
from derive.errors import Complaint, Place, Rejected, did_you_mean, nearest
from derive.figures import marks as m
from derive.figures.annotations import PositiveDirection, PositiveRotation
from derive.figures.branches import BranchLine
from derive.figures.extrema import MAXIMUM, MINIMUM
from derive.figures.parts import BarMark
from derive.figures.polhodes import order_of
from derive.figures.surfaces import ThinRod
from derive.page.plots import (
    Axis,
    Curve,
    Curves,
    curve_letters,
    curves_of,
    is_closed,
    plots_with_cases,
    told_value,
    with_unit,
)
from derive.page.wording import EQUALS, Inline, Math, Phrases, Text, filled, joined
from derive.steps.derivation import Derivation
from derive.steps.signs import truth_known

# Greatest number in a ratio of moments that is written with whole numbers. Any other ratio is written with decimals, in
# units of the least moment.
LARGEST = 99
CURVE = "way"  # the key of the phrase for a dashed curve
_VALUE = re.compile(r"value_\d+")  # the role of a value that a step substitutes for a letter: b = 2 sqrt(k m)
# An equation holds for the rounded numbers of a plot if the relative difference of its sides is at most ROUNDED.
ROUNDED = 0.01
CONDITIONS = ("condition", "excluded", "existing", "exists")  # roles of the conditions under which a result holds
FOUND = -1  # the index of the statement; part (a) has the index 0


@dataclass(frozen=True)
class Depicted:
    """A drawing on its page; `number` is the figure number, if the drawing has a caption."""

    drawing: m.Recorded
    placement: Placement | None
    at: str
    alt: tuple[Inline, ...]
    number: int | None = None
    caption: tuple[Inline, ...] = field(default=())

    @property
    def key(self) -> str:
        return self.drawing.key


def caption_numbers(problem: Problem, drawings: Sequence[m.Recorded], derivation: Derivation) -> dict[str, int]:
    """Return the numbers of the figures with a caption, in the order of the page: the author's figure, then the
    drawings.

    A drawing that leaves out conditions or given forces has a caption, which states them.
    """
    captioned = {p.key for p in problem.drawings if p.caption}
    shown = [d for d in drawings if d.key in captioned or _left_out(d) or _has_standard_caption(d)]
    placed = [(index, d) for d in shown if (index := _index(problem, d, derivation)) is not None]
    keys = [d.key for _, d in sorted(placed, key=lambda entry: entry[0])]
    own = [problem.figure.key] if problem.figure and problem.figure.caption else []
    return {key: number for number, key in enumerate([*own, *keys], 1)}


def depictions(
    problem: Problem,
    drawings: Sequence[m.Recorded],
    derivation: Derivation,
    words: Phrases,
    told: Callable[[Any, dict[str, Any]], tuple[Inline, ...]],
) -> tuple[list[Depicted], list[Complaint]]:
    """Return the drawings in the order of the page, and the errors about drawings."""
    faults = _unknown(problem, drawings)
    faults += [f for drawing in drawings for f in (*_without_letter(problem, drawing), *_cases(problem, drawing))]
    outside = {drawing.key: _outside_its_case(problem, drawing, derivation) for drawing in drawings}
    faults += [f for found in outside.values() for f in found]
    numbers = caption_numbers(problem, drawings, derivation)
    found: list[tuple[int, Depicted]] = []
    said: set[str] = set()
    for drawing in drawings:
        placement = placement_of(problem, drawing.key)
        fault = _given_away(problem, drawing, placement, derivation)
        index = _index(problem, drawing, derivation)
        if fault:
            faults.append(fault)
        elif index is not None and not outside[drawing.key]:
            own = placement.caption if placement else None
            caption = told(own.pieces, _lettered(drawing)) if own else _standard_caption(drawing, words, said)
            caption += _positive(drawing, words, said) if caption else ()
            caption += _not_shown(drawing, words, bool(caption))
            at = STATEMENT if index == FOUND else chr(ord("a") + index)
            try:
                alt = alternative(problem, drawing, placement, words)
                if isinstance(drawing, m.Drawing) and drawing.polhodes is not None:
                    caption = caption or _polhodes("polhodes", problem, drawing, placement, words)
                    caption += (Text(" "), *_ratio(problem, drawing, placement, words))
                if caption and isinstance(drawing, m.Plot):
                    if drawing.diagram is not None:
                        caption += (Text(" "), *filled(words.drawings["solid_and_dashed"], {}))
                    caption += _told_of_curves(curves_of(problem, drawing, placement), words)
            except Rejected as error:
                faults += error.complaints
                continue
            alt, caption = words.numbers(alt), caption if own else words.numbers(caption)
            found.append((index, Depicted(drawing, placement, at, alt, numbers.get(drawing.key), caption)))
    return [depicted for _, depicted in sorted(found, key=lambda entry: entry[0])], faults


def _left_out(drawing: m.Recorded) -> Sequence[Any]:
    return (*drawing.left_out, *drawing.undrawn) if isinstance(drawing, m.Drawing) else ()


def _has_standard_caption(drawing: m.Recorded) -> bool:
    if not isinstance(drawing, m.Drawing):
        return False
    return any(each is not None for each in (drawing.forces_on, drawing.mode, drawing.polhodes))


def _standard_caption(drawing: m.Recorded, words: Phrases, said: set[str]) -> tuple[Inline, ...]:
    """Return the standard caption of a force diagram or of the drawing of a normal mode; empty for other drawings.

    said   the sentences in earlier captions, which are not repeated; this function adds new sentences
    """
    if not isinstance(drawing, m.Drawing):
        return ()
    if drawing.forces_on is not None:
        return filled(words.drawings["forces"], {"mass": (Math(drawing.forces_on),)})
    if (mode := drawing.mode) is None:
        return ()
    letters = joined([(Math(each),) for each in mode.letters], words.labels["and"])
    names = {"frequency": (Math(mode.frequency),), "sort": mode.sort, "degenerate": mode.degenerate}
    told = [filled(words.drawings["mode"], names)]
    if mode.is_straight:
        told.append(filled(words.drawings["arrows_of_mode"], {"lengths": mode.lengths, "letters": letters}))
    if mode.turns:
        told.append(filled(words.drawings["turns_of_mode"], {}))
    caption = _spaced([each for each in told if str(each) not in said])
    said.update(map(str, told[1:]))
    return caption


def _positive(drawing: m.Recorded, words: Phrases, said: set[str]) -> tuple[Inline, ...]:
    """Return the sentences about the thin arrows of a drawing, to follow the caption.

    said   the sentences in earlier captions; this function adds new sentences
    """
    marks = drawing.marks if isinstance(drawing, m.Drawing) else ()
    sorts = {PositiveDirection: "positive_direction", PositiveRotation: "positive_rotation"}
    kinds = {type(each) for each in marks}
    told = [filled(words.drawings[name], {}) for sort, name in sorts.items() if sort in kinds]
    new = [each for each in told if str(each) not in said]
    said.update(map(str, new))
    return ((Text(" "),) if new else ()) + _spaced(new)


def _not_shown(drawing: m.Recorded, words: Phrases, follows: bool) -> tuple[Inline, ...]:
    """Return the sentences with the conditions and the given forces that a drawing does not show."""
    if not isinstance(drawing, m.Drawing) or not _left_out(drawing):
        return ()
    last, told = words.labels["and"], []
    if drawing.left_out:
        conditions = joined([(Math(each),) for each in drawing.left_out], last)
        told.append(filled(words.drawings["left_out"], {"conditions": conditions, "count": len(drawing.left_out)}))
    if drawing.undrawn:
        forces = [
            filled(words.drawings[f"undrawn_{sort}"], {"value": _named(value)}) for sort, value in drawing.undrawn
        ]
        told.append(filled(words.drawings["undrawn"], {"forces": joined(forces, last)}))
    return (*((Text(" "),) if follows else ()), *_spaced(told))


def _lettered(drawing: m.Recorded) -> dict[str, Any]:
    """Return the symbols that label the marks of a drawing. The caption may mention them by name: `<<C>>` prints C."""
    labels = (getattr(mark, "label", None) for mark in getattr(drawing, "marks", ()))
    return {label.name: (Math(label),) for label in labels if isinstance(label, Symbol)}


def placement_of(problem: Problem, key: str) -> Placement | None:
    return next((placement for placement in problem.drawings if placement.key == key), None)


# --- positions -------------------------------------------------------------------------------------------------------


def _unknown(problem: Problem, drawings: Sequence[m.Recorded]) -> list[Complaint]:
    names = [drawing.key for drawing in drawings]
    of_engine = problem.described is not None
    none = "the engine cannot show all inputs in a drawing" if of_engine else "the script makes no drawing"
    known = "the drawings are " + ", ".join(f"`{name}`" for name in names) if names else none
    who = "the engine" if of_engine else "the script"
    return [
        Complaint(
            "unknown-drawing",
            f"{who} draws nothing called `{placement.key}`",
            placement.place,
            help=did_you_mean(placement.key, names) or known,
        )
        for placement in problem.drawings
        if placement.key not in names and placement.at != HIDDEN
    ]


def _without_letter(problem: Problem, drawing: m.Recorded) -> list[Complaint]:
    placement = placement_of(problem, drawing.key)
    if isinstance(drawing, m.Plot):
        message = f"`values` has no effect on the plot `{drawing.key}`"
        help_line = "write the numbers in the plot, such as `cases: [{l: 1 m}]`, or under `values` of the problem"
        place = next(iter(placement.names.values()), None) if placement else None
        return [Complaint("unused-key", message, place, help=help_line)] if place else []
    letters = {symbol.name for symbol in drawing.letters}
    return [
        Complaint("unknown-letter", f"the drawing `{drawing.key}` has no symbol `{name}`", place,
                  help=did_you_mean(name, letters) or "its symbols are " + ", ".join(f"`{x}`" for x in sorted(letters)))
        for name, place in (placement.names.items() if placement else ())
        if name not in letters and name not in problem.symbols  # some inputs remove a symbol from a drawing
    ]  # fmt: skip


def _cases(problem: Problem, drawing: m.Recorded) -> list[Complaint]:
    """Return an error for each case of a plot, if the case repeats an earlier case or gives a number for the symbol
    that varies."""
    placement = placement_of(problem, drawing.key)
    found: list[Complaint] = []
    if placement is None or not isinstance(drawing, m.Plot):
        return found
    before: list[dict[Symbol, Expr]] = []
    of_several = bool(drawing.others)  # each case belongs to a different quantity
    for i, case in enumerate(placement.cases):
        for number in (each for each in case if each.symbol == drawing.variable):
            along = "the horizontal axis of" if drawing.across is None else "the path"
            message = f"`{number.symbol}` varies along {along} `{drawing.key}`, so a number for it has no effect"
            found.append(Complaint("unused-key", message, number.place, help="leave it out"))
        numbers = {number.symbol: number.si for number in (*placement.cases[0], *case)}
        if numbers in before and not of_several:
            place = case[0].place if case else placement.place
            same = case_label(before.index(numbers))
            message = f"case {case_label(i)} of the plot `{drawing.key}` is the same as case {same}"
            found.append(Complaint("twice", message, place, help="change a number, or leave the case out"))
        before.append(numbers)
    return found


def _outside_its_case(problem: Problem, drawing: m.Recorded, derivation: Derivation) -> list[Complaint]:
    """Return an error for each curve whose numbers violate a condition under which the plotted result holds, such as
    b^2 < 4 k m for an underdamped motion."""
    placement = placement_of(problem, drawing.key)
    if not isinstance(drawing, m.Plot) or drawing.diagram is not None:  # a diagram shows where its conditions hold
        return []
    names = {name: explicit(value) for step in derivation.steps for name, value in step.names}
    try:
        pairs = plots_with_cases(drawing, placement)
    except Rejected:  # the description of the plot reports this error
        return []
    first, *more = (case for _, case in pairs)
    found: list[Complaint] = []
    for i, (plot, case) in enumerate(pairs):
        numbers = {letter: explicit(amount) for letter, amount in problem.amounts.items()}
        numbers |= {number.symbol: number.si for number in (*first, *case)}
        numbers.pop(drawing.variable, None)
        conditions = _conditions_for(plot, case, derivation)
        broken = next((each for each in conditions if _is_broken(each, names, numbers)), None)
        if broken is not None:
            which = f"case {case_label(i)} of the plot `{drawing.key}`" if more else f"the plot `{drawing.key}`"
            message = f"the numbers of {which} do not satisfy {broken}, which the plotted result requires"
            place = case[0].place if case else placement.place if placement else problem.place_of("solve")
            help_line = "change the numbers, or plot a result that holds for these numbers"
            found.append(Complaint("drawing", message, place, help=help_line))
    return found


def _conditions_for(plot: m.Plot, case: Sequence[Measured], derivation: Derivation) -> list[Relation]:
    """Return the conditions that the plotted steps, and the steps on which they depend, state for their results. Also
    return equations such as b = 2 sqrt(k m) with which a step replaces b, if the case gives b a number and the plot
    does not contain b."""
    steps = {step.key: step for step in derivation.steps}
    waiting, seen = list(plot.keys), dict[str, None]()
    while waiting:
        key = waiting.pop()
        if key in steps and key not in seen:
            seen[key] = None
            waiting += steps[key].inputs
    replaced = {number.symbol for number in case} - plot.letters
    told = [
        each
        for key in seen
        for role, each in steps[key].roles
        if isinstance(each, Relation) and (role in CONDITIONS or _VALUE.fullmatch(role) and each.left in replaced)
    ]
    return list(dict.fromkeys(told))


def _is_broken(condition: Relation, names: Mapping[Any, Any], numbers: Mapping[Symbol, Expr]) -> bool:
    value = explicit(condition)
    for _ in names:  # the value of a name may contain other names
        value = bound(value, names)
    value = explicit(value).xreplace(dict(numbers))
    if value.free_symbols:
        return False
    if condition.operator == "=" and value.left.is_real and value.right.is_real:
        left, right = float(value.left), float(value.right)
        return abs(left - right) > ROUNDED * max(abs(left), abs(right))
    return truth_known(value) is False


def letters_not_drawn(problem: Problem, drawings: Sequence[m.Recorded]) -> list[Complaint]:
    """Return a warning for each symbol of the problem that has a value for a drawing in which it does not occur."""
    found = []
    for drawing in drawings:
        placement = placement_of(problem, drawing.key)
        letters = {symbol.name for symbol in drawing.letters}
        for name, place in _with_values(problem, placement).items() if placement else ():
            if name not in letters and name in problem.symbols:
                message = f"`{name}` does not occur in the drawing `{drawing.key}`, so its value is not used"
                found.append(Complaint("unused-letter", message, place, severity="warning"))
    return found


def _with_values(problem: Problem, placement: Placement) -> dict[str, Place | None]:
    """Return the place in the file of each value of a drawing, by the name of its symbol."""
    is_for_parts = any(part.cases == placement.key for part in problem.parts)
    cases = () if is_for_parts else placement.cases
    return {**placement.names, **{number.symbol.name: number.place for case in cases for number in case}}


def keys_without_effect(problem: Problem, drawings: Sequence[m.Recorded]) -> list[Complaint]:
    """Return a warning for each key that has no effect. These are the keys for plots in a drawing that is not a plot,
    `view` in a drawing that is not in space, and `width` in the force diagram of a particle."""
    found = []
    for placement in problem.drawings:
        no_plot = any(d.key == placement.key and not isinstance(d, m.Plot) for d in drawings)
        said = {"range": placement.range is not None, "cases": bool(placement.cases), "panels": bool(placement.panels)}
        said["up"] = placement.up is not None
        for name in (name for name in said if said[name] and no_plot):
            message = f"`{name}` has no effect on `{placement.key}`, which is not a plot"
            place = placement.range.place if placement.range and name == "range" else placement.place
            found.append(Complaint("unused-key", message, place, help="leave it out", severity="warning"))
        shown = next((d for d in drawings if d.key == placement.key), None)
        ignored: list[tuple[str, Place | None, str]] = []
        if placement.view is not None and shown is not None and not _is_in_space(shown):
            ignored.append(("view", placement.view_place, "which is not a drawing in space"))
        if placement.width is not None and shown is not None and _is_of_a_particle(shown):
            ignored.append(("width", placement.width_place, "because a particle has no size"))
        for name, at, reason in ignored:
            message = f"`{name}` has no effect on `{placement.key}`, {reason}"
            found.append(Complaint("unused-key", message, at, help="leave it out", severity="warning"))
    return found


def _is_in_space(drawing: m.Recorded) -> bool:
    return isinstance(drawing, m.Drawing) and drawing.view == m.SPACE


def _is_of_a_particle(drawing: m.Recorded) -> bool:
    """Whether a drawing is the force diagram of a particle, whose lengths are all in points."""
    if not isinstance(drawing, m.Drawing) or drawing.forces_on is None or drawing.body_size is not None:
        return False
    return not any(isinstance(mark, BarMark | ThinRod) for mark in drawing.marks)


def not_drawn(problem: Problem, drawings: Sequence[m.Recorded]) -> list[Complaint]:
    """Return a warning for polhodes that are not drawn because two moments of inertia are equal."""
    found = []
    for drawing in drawings:
        placement = placement_of(problem, drawing.key)
        if placement is not None and _has_equal_moments(problem, drawing, placement):
            message = f"two moments of inertia are equal, so `{drawing.key}` is not drawn"
            help_line = "leave the drawing out, or change the moments"
            found.append(Complaint("drawing", message, placement.place, help=help_line, severity="warning"))
    return found


def misspelt(problem: Problem, drawings: Sequence[m.Recorded]) -> list[Complaint]:
    """Return a warning for each drawing that consists of marks in a plane, if the engine makes a drawing with a similar
    name."""
    own = {placement.key: placement for placement in problem.drawings}
    others = [drawing.key for drawing in drawings if drawing.key not in own]
    return [
        Complaint(
            "drawing",
            f"`{key}` is a new drawing, which shows only these marks",
            placement.place,
            help=f"to add the marks to the drawing of the engine, write `{meant}`",
            severity="warning",
        )
        for key, placement in own.items()
        if placement.is_sketch and (meant := nearest(key, others))
    ]


def _has_equal_moments(problem: Problem, drawing: m.Recorded, placement: Placement | None) -> bool:
    """Whether a drawing would show polhodes of a body with two equal moments; these polhodes are circles."""
    if not isinstance(drawing, m.Drawing) or drawing.polhodes is None:
        return False
    ratios, _ = _moments(problem, drawing, placement)
    return all(ratio.is_number for ratio in ratios) and order_of([float(ratio) for ratio in ratios]) is None


def placed_after(drawing: m.Recorded, placement: Placement | None = None) -> tuple[str, ...]:
    """Return the keys of the steps that a drawing shows, and of the step that its `at` names. For a normal mode, also
    return the keys of the other modes, so that their drawings are side by side."""
    siblings = drawing.mode.siblings if isinstance(drawing, m.Drawing) and drawing.mode is not None else ()
    chosen = (placement.at,) if placement is not None and _is_step(placement.at) else ()
    return (*drawing.keys, *siblings, *chosen)


def _is_step(at: str | None) -> TypeGuard[str]:
    """Return whether `at` names a step, and not a part, the statement or no place at all."""
    return at is not None and len(at) > 1 and at not in (STATEMENT, HIDDEN)


def leads_to(drawing: m.Recorded) -> tuple[str, ...]:
    """Return the keys of the steps before which a drawing is placed; a plot has none."""
    return drawing.leads_to if isinstance(drawing, m.Drawing) else ()


def _earliest(drawing: m.Recorded, derivation: Derivation) -> int | None:
    """Return the index of the first part in which a drawing may appear, or -1 for the statement; None if there is no
    such part."""
    if leads_to(drawing):
        return next((i for i, keys in enumerate(derivation.parts) if set(keys) & set(leads_to(drawing))), None)
    known: set[str] = set()
    for index, keys in enumerate(((), *derivation.parts), FOUND):
        known |= set(keys)
        if known >= set(drawing.keys):
            return index
    return None


def _index(problem: Problem, drawing: m.Recorded, derivation: Derivation) -> int | None:
    placement = placement_of(problem, drawing.key)
    if _has_equal_moments(problem, drawing, placement):
        return None
    if placement is None or placement.at is None:
        return _earliest(drawing, derivation)
    if placement.at == HIDDEN:
        return None
    if _is_step(placement.at):
        return _part_of(placement.at, problem, derivation)
    return FOUND if placement.at == STATEMENT else ord(placement.at) - ord("a")


def _part_of(key: str, problem: Problem, derivation: Derivation) -> int | None:
    """Return the index of the part that asks for a step or shows the step; None if there is no such part."""
    answered = [derivation.answering(part.answers) for part in problem.parts]
    asked = [index for index, steps in enumerate(answered) if key in [step.key for step in steps]]
    shown = [index for index, keys in enumerate(derivation.parts) if key in keys]
    return next(iter([*asked, *shown]), None)


def _given_away(
    problem: Problem, drawing: m.Recorded, placement: Placement | None, derivation: Derivation
) -> Complaint | None:
    """Return an error if the `at` of a drawing names an unknown step. Also return an error if the drawing shows a step
    that is derived later, or on which no answer depends. Otherwise return None."""
    index, earliest = _index(problem, drawing, derivation), _earliest(drawing, derivation)
    place = (placement.at_place or placement.place) if placement else problem.place_of("solve")
    at = placement.at if placement is not None else None
    if at == HIDDEN:
        return None
    if at is not None and at != STATEMENT and len(at) > 1 and at not in {*derivation.keys, *derivation.unshown}:
        help_line = did_you_mean(at, derivation.keys)
        return Complaint("undefined-name", f"no step of this problem is called `{at}`", place, help=help_line)
    if earliest is None and at is None:
        return None  # a part was left out, so the page lacks steps that the drawing shows
    if earliest is None:
        loose = next(key for key in drawing.keys if key not in derivation.keys)
        message = f"the drawing `{drawing.key}` shows `{loose}`, on which no answer depends"
        return Complaint("drawing", message, place, help=f"let a part ask for this step, or write `at: {HIDDEN}`")
    if index is None or index >= earliest:
        return None
    shown = {key for keys in derivation.parts[: index + 1] for key in keys}
    later = next(key for key in drawing.keys if key not in shown)
    where = "the statement" if index == FOUND else f"part {chr(ord('a') + index)}"
    message = f"in {where} the drawing `{drawing.key}` would show `{later}` before it is derived"
    letter = chr(ord("a") + earliest)
    return Complaint("drawing", message, place, help=f"write `at: {letter}`, the part that derives this step")


# --- contents in words -----------------------------------------------------------------------------------------------


def alternative(
    problem: Problem, drawing: m.Recorded, placement: Placement | None, words: Phrases
) -> tuple[Inline, ...]:
    """Return the alternative text of a drawing."""
    if isinstance(drawing, m.Plot):
        return _curves(problem, drawing, placement, words)
    if drawing.mode is not None:
        return _moves(drawing.mode, words)
    if drawing.polhodes is not None:
        return _polhodes("drawn_polhodes", problem, drawing, placement, words)
    told = [nodes for nodes in (_mark(mark, words) for mark in _told_once(drawing.marks)) if nodes]
    for phrase in dict.fromkeys(mark.together for mark in drawing.marks if mark.together and mark.label is not None):
        names = [_named(mark.label) for mark in drawing.marks if mark.together == phrase and mark.label is not None]
        joint = {"names": joined(names, words.labels["and"]), "several": len(names) > 1}
        told.append(filled(words.drawings[phrase], joint))
    items = joined(told, words.labels["and"])
    return filled(words.drawings[drawing.view], {"marks": items})


def _moves(mode: m.ShownMode, words: Phrases) -> tuple[Inline, ...]:
    """Return words for the directions in which the masses are displaced in a normal mode."""
    last = words.labels["and"]
    told = []
    for mass, ways, sense in mode.moves:
        named = joined([(Text(words.drawings[way]),) for way in ways], last)
        turned = (Text(words.drawings[sense]),) if sense else ()
        told.append(filled(words.drawings["moves"], {"mass": _named(mass), "ways": named, "turned": turned}))
    return filled(words.drawings["drawn_mode"], {"order": mode.order, "moves": joined(told, last)})


def _moments(problem: Problem, drawing: m.Drawing, placement: Placement | None) -> tuple[list[Expr], bool]:
    """Return the ratios of the moments of inertia for which polhodes are drawn, and whether the ratios are only an
    example."""
    assert drawing.polhodes is not None
    given = {letter: explicit(amount) for letter, amount in problem.amounts.items()}
    chosen = dict(placement.values) if placement else {}
    known = {**dict(drawing.values), **given, **chosen}
    ratios = list(drawing.polhodes.ratios)
    letters: set[Any] = set()
    while free := {s for ratio in ratios for s in ratio.free_symbols if s in known}:
        letters |= free
        ratios = [tidied(ratio.xreplace({s: known[s] for s in free})) for ratio in ratios]
    return ratios, any(letter not in given or letter in chosen for letter in letters)


def _polhodes(
    phrase: str, problem: Problem, drawing: m.Drawing, placement: Placement | None, words: Phrases
) -> tuple[Inline, ...]:
    """Return the caption or the alternative text of polhodes, as `phrase` selects."""
    assert drawing.polhodes is not None
    ratios, _ = _moments(problem, drawing, placement)
    if missing := sorted({s.name for ratio in ratios for s in ratio.free_symbols}):
        message = f"the drawing `{drawing.key}` needs a number for {', '.join(f'`{name}`' for name in missing)}"
        help_line = "under `values` of this drawing, use only symbols of the moments of inertia"
        raise Rejected(Complaint("drawing", message, placement.place if placement else None, help=help_line))
    order = order_of([float(ratio) for ratio in ratios])
    assert order is not None
    axes = dict(zip(("least", "middle", "greatest"), (_named(scalar(AXES[i])) for i in order), strict=True))
    return filled(words.drawings[phrase], {**axes, "momentum": _named(drawing.polhodes.momentum)})


def _ratio(problem: Problem, drawing: m.Drawing, placement: Placement | None, words: Phrases) -> tuple[Inline, ...]:
    """Return the sentence with the ratio of the moments for which polhodes are drawn."""
    ratios, is_example = _moments(problem, drawing, placement)
    names: dict[str, Any] = {"ratio": " : ".join(_in_small_numbers(ratios)), "example": is_example}
    names["axes"] = joined([_named(scalar(axis)) for axis in AXES], words.labels["and"])
    return filled(words.drawings["ratio_of_moments"], names)


def _in_small_numbers(ratios: Sequence[Expr]) -> list[str]:
    """Return numbers in the same ratio: whole numbers if they are small, else multiples of the least one."""
    if all(ratio.is_Rational for ratio in ratios):
        whole = lcm([ratio.q for ratio in ratios])
        found = [int(ratio * whole) for ratio in ratios]
        common = gcd(*found)
        if max(found) // common <= LARGEST:
            return [str(each // common) for each in found]
    least = min(float(ratio) for ratio in ratios)
    return [f"{float(ratio) / least:.3g}" for ratio in ratios]


def _told_once(marks: Sequence[m.Mark]) -> list[m.Mark]:
    """Return the marks for the alternative text without repetitions; dashed curves without labels count as one mark."""
    found: dict[Any, m.Mark] = {}
    for mark in marks:
        told = mark.in_words()
        found.setdefault(CURVE if told is not None and told[0] == CURVE and mark.label is None else mark, mark)
    return list(found.values())


def _curves(problem: Problem, plot: m.Plot, placement: Placement | None, words: Phrases) -> tuple[Inline, ...]:
    """Return words for the range of a plot and for the numbers and extrema of each curve."""
    curves = curves_of(problem, plot, placement)
    first = curves.curves[0]
    names = {
        "quantity": joined([_divided(label, curves.up) for label in plot.labels], words.labels["and"]),
        "variable": _divided(plot.named_across, curves.variable),
        "lower": with_unit(first.lower * curves.variable.per_unit, curves.variable.unit),
        "upper": with_unit(first.upper * curves.variable.per_unit, curves.variable.unit),
    }
    if plot.diagram is not None:
        return _spaced([*_diagrams(plot, curves, words, names), *_shared(curves, words)])
    if plot.levels is not None:
        return _spaced([*_portraits(plot, curves, words, names), *_shared(curves, words)])
    if plot.across is not None:
        return _spaced([*_paths(plot, curves, words, names), *_surfaces(plot, words), *_shared(curves, words)])
    told = [filled(words.drawings["plot"], names)]
    for letter, curve in zip(curve_letters(curves), curves.curves, strict=True):
        last = words.labels["and"]
        numbers = _put_in(curve.numbers)
        turns = joined(_turns(plot, curves, curve, words), last)
        own = {"letter": letter, "numbers": joined(numbers, last), "turns": turns, "count": len(curve.extrema)}
        own["own_name"] = _named(curve.label) if curves.labels_differ else ()
        told.append(filled(words.drawings["curve"], own))
        told += [filled(words.drawings["height"], each) for each in _heights(curve, curves)]
    return _spaced([*told, *_shared(curves, words)])


def _heights(curve: Curve, curves: Curves) -> Iterator[dict[str, Any]]:
    """For each range in which the curve is below the line of an energy, yield this energy and the ends of the range.
    The keys are the names that the phrase uses."""
    for energy, ranges in curve.heights:
        for start, end in ranges:
            ends = [with_unit(x * curves.variable.per_unit, curves.variable.unit) for x in (start, end)]
            yield {"value": with_unit(energy * curves.up.per_unit, curves.up.unit), "start": ends[0], "end": ends[1]}


def _divided(label: Any, axis: Axis) -> Any:
    return _named(label if axis.per is None else label / axis.per)


def _spaced(told: Sequence[tuple[Inline, ...]]) -> tuple[Inline, ...]:
    return tuple(node for i, nodes in enumerate(told) for node in ((Text(" "),) if i else ()) + nodes)


def _portraits(plot: m.Plot, curves: Curves, words: Phrases, names: dict[str, Any]) -> Iterator[tuple[Inline, ...]]:
    """Yield words for the axes of a phase portrait, and for the values on the curves of each panel."""
    assert plot.levels is not None
    yield filled(words.drawings["portrait"], names)
    last = words.labels["and"]
    for letter, curve in zip(curve_letters(curves), curves.curves, strict=True):
        assert curve.portrait is not None
        own = {
            "letter": letter,
            "numbers": joined(_put_in(curve.numbers), last),
            "low": with_unit(curve.portrait.low * curves.up.per_unit, curves.up.unit),
            "high": with_unit(curve.portrait.high * curves.up.per_unit, curves.up.unit),
            "up": _divided(plot.label, curves.up),
            "values": joined([(Text(_level(value, curves)),) for value, _ in curve.portrait.values], last),
            "thick": joined(_thick(plot.levels, curve.portrait.values, curves), last),
        }
        yield filled(words.drawings["portrait_values"], own)


def _level(value: float, curves: Curves) -> str:
    return with_unit(value * curves.levels.per_unit, curves.levels.unit)


def _thick(levels: m.Levels, numbers: Sequence[tuple[float, bool]], curves: Curves) -> list[tuple[Inline, ...]]:
    """Return the values on the thick curves: formulas, or numbers with their unit."""
    every = zip(levels.values, numbers, strict=True)
    return [
        (Math(value),) if value.free_symbols else (Text(_level(number, curves)),)
        for (value, _), (number, is_thick) in every
        if is_thick
    ]


def _diagrams(plot: m.Plot, curves: Curves, words: Phrases, names: dict[str, Any]) -> Iterator[tuple[Inline, ...]]:
    """Yield words for the axes of a bifurcation diagram, and for the branches and the bifurcations of each panel."""
    assert plot.diagram is not None
    last = words.labels["and"]
    yield filled(words.drawings["diagram"], names)
    for letter, curve in zip(curve_letters(curves), curves.curves, strict=True):
        assert curve.diagram is not None
        own: dict[str, Any] = {"letter": letter, "numbers": joined(_put_in(curve.numbers), last)}
        told = []
        for i in dict.fromkeys(line.of for line in curve.diagram.lines):
            lines = [line for line in curve.diagram.lines if line.of == i]
            values = {with_unit(y * curves.up.per_unit, curves.up.unit) for line in lines for _, y in line.points}
            parts = [filled(words.drawings["branch_part"], _part(line, curves, len(values) > 1)) for line in lines]
            named: dict[str, Any] = {"name": _named(plot.diagram.branches[i].label), "parts": joined(parts, last)}
            named["value"] = values.pop() if len(values) == 1 else ""
            told.append(filled(words.drawings["branch"], named))
        across = curves.variable
        changes = [(Text(with_unit(each.at * across.per_unit, across.unit)),) for each in curve.diagram.changes]
        own |= {"branches": joined(told, last), "changes": joined(changes, last), "variable": names["variable"]}
        yield filled(words.drawings["diagram_branches"], own)


def _part(line: BranchLine, curves: Curves, varies: bool) -> dict[str, Any]:
    """Return the values, by name, for the phrase about a part of a branch."""
    (start, first), (end, second) = line.points[0], line.points[-1]
    ends = {"start": start, "end": end}
    values = {"first": first, "second": second}
    told = {name: with_unit(x * curves.variable.per_unit, curves.variable.unit) for name, x in ends.items()}
    told |= {name: with_unit(y * curves.up.per_unit, curves.up.unit) for name, y in values.items()}
    return {**told, "stable": line.is_stable, "varies": varies}


def _paths(plot: m.Plot, curves: Curves, words: Phrases, names: dict[str, Any]) -> Iterator[tuple[Inline, ...]]:
    assert plot.across is not None
    names |= {"across": _divided(plot.across.label, curves.across), "several": len(curves.curves) > 1}
    yield filled(words.drawings["path"], names)
    across, up = curves.across, curves.up
    between = "; " if words.sign == "," else ", "
    for letter, curve in zip(curve_letters(curves), curves.curves, strict=True):
        ends = [
            f"({with_unit(x * across.per_unit, across.unit)}{between}{with_unit(y * up.per_unit, up.unit)})"
            for x, y in (curve.path[0], curve.path[-1])
        ]
        own = {
            "letter": letter,
            "numbers": joined(_put_in(curve.numbers), words.labels["and"]),
            "start": ends[0],
            "end": ends[1],
            "closed": is_closed(curve.path),
        }
        yield filled(words.drawings["path_ends"], own)


def _surfaces(plot: m.Plot, words: Phrases) -> Iterator[tuple[Inline, ...]]:
    if plot.outlines:
        names = [(Text(outline.name.replace("_", " ")),) for outline in plot.outlines]
        own = {"names": joined(names, words.labels["and"]), "several": len(names) > 1}
        yield filled(words.drawings["outlines"], own)


def _put_in(numbers: Sequence[Measured]) -> list[tuple[Inline, ...]]:
    """Return `symbol = number` for each of these numbers."""
    return [(Math(n.symbol), EQUALS, Math(Amount(n.number, n.unit, n.factor))) for n in numbers]


def _shared(curves: Curves, words: Phrases) -> list[tuple[Inline, ...]]:
    """Return words for the numbers that all curves share."""
    if not curves.shared:
        return []
    numbers = joined(_put_in(curves.shared), words.labels["and"])
    return [filled(words.drawings["shared"], {"numbers": numbers, "count": len(curves.curves)})]


def _turns(plot: m.Plot, curves: Curves, curve: Curve, words: Phrases) -> list[tuple[Inline, ...]]:
    """Return words for each marked extremum of a curve."""
    return [
        filled(
            words.drawings["extremum"],
            {
                "kind": words.drawings[extremum.kind],
                "variable": _divided(plot.variable, curves.variable),
                "at": with_unit(extremum.at * curves.variable.per_unit, curves.variable.unit) if extremum.at else "0",
                "value": told_value(curves.up, extremum),
            },
        )
        for extremum in curve.marked
    ]


def _told_of_curves(curves: Curves, words: Phrases) -> tuple[Inline, ...]:
    """Return the meaning of the dots, and the numbers that all curves of a plot share."""
    kinds = Counter(turn.kind for curve in curves.curves for turn in curve.marked)
    counts = {"filled": kinds[MINIMUM], "open": kinds[MAXIMUM]}
    dots = [filled(words.drawings["filled_and_open"], counts)] if curves.has_unstable else []
    told = (*dots, *_shared(curves, words))
    return tuple(node for nodes in told for node in (Text(" "), *nodes))


def _mark(mark: m.Mark, words: Phrases) -> tuple[Inline, ...]:
    """Return the words for one mark; an auxiliary line has no words."""
    told = mark.in_words()
    if told is None:
        return ()
    phrase, names = told
    found = {name: _named(value) for name, value in names.items()}
    if "name" in names:
        found["name"] = words.body(names["name"])
    if "measures" in names:
        last, measures = words.labels["and"], names["measures"]
        found["several"] = any(isinstance(value, tuple) for _, value in measures)
        found["measures"] = joined((_measured(words.size(id), value, last) for id, value in measures), last)
    return filled(words.drawings[phrase], found)


def _measured(name: str, value: Any, last: str) -> tuple[Inline, ...]:
    values = value if isinstance(value, tuple) else (value,)
    return (Text(f"{name} "), *joined([Math(each) for each in values], last))


def _named(value: Any) -> Any:
    if value is None or isinstance(value, str):
        return (Text(value),) if value else ()
    return value if isinstance(value, int) else (Math(value),)
