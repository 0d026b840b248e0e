"""Checks of many variants of a problem: the distribution of the answers, and degenerate draws.

A draw is degenerate if the derivation or one of its conditions fails, or if an answer has no real value.
A structure is one choice of everything that varies except numbers. Each structure is derived once, and the numbers of a
draw are substituted. For a comparison, a few draws are also derived completely.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mpmath import mp
from sympy import Symbol
from sympy.matrices.matrixbase import MatrixBase

from derive.algebra.dimensions import Dimension
from derive.algebra.expressions import Amount, Relation, explicit
from derive.algebra.kinds import unit_of_dimension, unit_of_kind
from derive.algebra.rounding import Rounded
from derive.algebra.samples import NoNumber, Undefined, Values
from derive.building.solution import derived
from derive.course.problem import Problem, load_problem
from derive.course.variants import Chosen, Variation, chosen_for
from derive.errors import Complaint, DeriveError
from derive.steps.homogeneity import dimension_table
from derive.steps.numeric import WholeSwing
from derive.steps.step import Quantity

COMPARED = 3  # number of draws that are also derived completely
CLOSE = 1e-9  # the greatest imaginary part, relative to the value, that counts as zero


@dataclass
class OfAnswer:
    """The values of one answer, in the coherent SI unit, in the draws in which it has a real value."""

    key: str
    unit: str
    values: list[float] = field(default_factory=list)


@dataclass
class OfProblem:
    """The results of the draws of one problem.

    structures  the number of different derivations
    same        number of pairs of draws with the same choices
    equal       for each answer, the number of pairs of different variants with the same value
    degenerate  a description of a defect -> descriptions of the draws that have this defect
    outcomes    for each answer, the outcomes of its rule, such as `oscillates`, each with the number of draws
    compared    number of draws that were also derived completely
    """

    id: str
    variations: tuple[Variation, ...]
    draws: int = 0
    structures: int = 0
    same: int = 0
    answers: dict[str, OfAnswer] = field(default_factory=dict)
    equal: dict[str, int] = field(default_factory=dict)
    degenerate: dict[str, list[str]] = field(default_factory=dict)
    outcomes: dict[str, Counter[str]] = field(default_factory=dict)
    compared: int = 0
    complaints: list[Complaint] = field(default_factory=list)

    @property
    def possible(self) -> int:
        """The number of different variants."""
        number = 1
        for each in self.variations:
            number *= len(each.choices)
        return number


def told(variations: Sequence[Variation], chosen: Chosen) -> str:
    return ", ".join(f"{each.name} = {each.told(chosen[each.name])}" for each in variations)


def checked(root: Path, problem_id: str, draws: int, seed: str) -> OfProblem:
    """Draw variants for students with the codes 1, 2, and so on, and evaluate the answers of each draw."""
    problem = load_problem(root, problem_id)
    set_id, _, name = problem_id.partition("/")
    found = OfProblem(problem_id, problem.variations, draws)
    chosen = [chosen_for(set_id, name, problem.variations, str(number), seed) for number in range(1, draws + 1)]
    found.same = _pairs(Counter(tuple(each.items()) for each in chosen))
    letters = {measured.symbol.name for measured in problem.measured}
    of_letters = [each for each in problem.variations if each.name in letters]
    numbers = _numbers_of(root, problem_id, of_letters, found)
    if found.complaints:
        return found
    structures: dict[tuple[tuple[str, int], ...], _Structure | None] = {}
    by_value: dict[str, dict[str, set[tuple[tuple[str, int], ...]]]] = {}
    for number, draw in enumerate(chosen):
        given = tuple((name, choice) for name, choice in draw.items() if name not in letters)
        if given not in structures:
            structures[given] = _structure(root, problem_id, dict(given), found)
        structure = structures[given]
        if structure is None:
            found.degenerate.setdefault("the derivation fails", []).append(told(problem.variations, draw))
            continue
        point = {**structure.point} | {
            letter: value for each in of_letters for letter, value in numbers[each.name, draw[each.name]].items()
        }
        values = structure.values(point, told(problem.variations, draw), found)
        for key, value in values.items():
            found.answers.setdefault(key, OfAnswer(key, structure.units[key])).values.append(value)
            by_value.setdefault(key, {}).setdefault(f"{value:.9g}", set()).add(tuple(draw.items()))
        if number < COMPARED:
            _compare(root, problem_id, draw, values, told(problem.variations, draw), found)
    found.structures = len(structures)
    found.equal = {key: _pairs({value: len(draws) for value, draws in each.items()}) for key, each in by_value.items()}
    return found


def _pairs(counted: Mapping[Any, int]) -> int:
    return sum(number * (number - 1) // 2 for number in counted.values())


def _numbers_of(
    root: Path, problem_id: str, variations: Sequence[Variation], found: OfProblem
) -> dict[tuple[str, int], dict[Symbol, Any]]:
    """Return the value of each choice of the varied numbers, in the coherent SI unit."""
    numbers: dict[tuple[str, int], dict[Symbol, Any]] = {}
    for variation in variations:
        for choice in range(len(variation.choices)):
            try:
                read = load_problem(root, problem_id, {str(variation.name): choice})
            except DeriveError as error:
                found.complaints += error.complaints
                continue
            measured = (each for each in read.measured if each.symbol.name == variation.name)
            numbers[variation.name, choice] = {each.symbol: each.si for each in measured}
    return numbers


@dataclass(frozen=True)
class _Structure:
    problem: Problem
    answers: Mapping[str, Quantity]
    units: Mapping[str, str]
    point: Mapping[Symbol, Any]
    assumed: Sequence[Any]

    def values(self, point: Mapping[Symbol, Any], draw: str, found: OfProblem) -> dict[str, float]:
        """Return the values of the answers in one draw; record the draw if it is degenerate."""
        with mp.workdps(30):
            at = Values(dict(point))
            for condition in self.assumed:
                if condition.free_symbols <= set(point) and not _holds(condition, at):
                    found.degenerate.setdefault("a condition of the derivation fails", []).append(draw)
                    return {}
            values = {}
            for key, answer in self.answers.items():
                found.outcomes.setdefault(key, Counter())[answer.step.outcome] += 1
                try:
                    value = at(explicit(answer.value))
                except (Undefined, NoNumber, ZeroDivisionError):
                    found.degenerate.setdefault(f"`{key}` has no value", []).append(draw)
                    continue
                if abs(mp.im(value)) > CLOSE * abs(value):
                    found.degenerate.setdefault(f"`{key}` is not real", []).append(draw)
                else:
                    values[key] = float(mp.re(value))
        return values


def _holds(condition: Relation, at: Values) -> bool:
    try:
        difference = mp.re(at(explicit(condition.left - condition.right)))
    except (Undefined, NoNumber):
        return False
    return bool({">": difference > 0, "<": difference < 0, ">=": difference >= 0, "<=": difference <= 0}.get(
        condition.operator, True
    ))  # fmt: skip


def _structure(root: Path, problem_id: str, given: Chosen, found: OfProblem) -> _Structure | None:
    try:
        problem = load_problem(root, problem_id, given or None)
        derivation, _, known, _ = derived(problem)
    except DeriveError as error:
        found.complaints += error.complaints
        return None
    letters = {measured.symbol for measured in problem.measured}
    answers = {}
    for part in problem.parts:
        for key in derivation.answering(part.answers):
            quantity = known[key.key]
            if _has_number(quantity, letters):
                answers[key.key] = quantity
    dimensions, _ = dimension_table(problem.dimensions, derivation.steps, problem.script.returns)
    units = {key: _unit(quantity, dimensions) for key, quantity in answers.items()}
    point = {each.symbol: each.si for each in problem.measured}
    return _Structure(problem, answers, units, point, derivation.assumed)


def _has_number(quantity: Quantity, letters: set[Symbol]) -> bool:
    """Return whether an answer is a scalar whose letters all have numbers, and not a period that is given as a
    series."""
    value = quantity.value
    if isinstance(value, MatrixBase | Relation) or quantity.fact(WholeSwing) is not None:
        return False
    return bool(value.free_symbols <= letters)


def _unit(quantity: Quantity, dimensions: Mapping[Any, Dimension | None]) -> str:
    kind, dimension = quantity.step.kind, dimensions.get(quantity.step.symbol)
    return unit_of_kind(kind) if kind else unit_of_dimension(dimension) if dimension is not None else ""


def _compare(
    root: Path, problem_id: str, draw: Chosen, values: Mapping[str, float], words: str, found: OfProblem
) -> None:
    """Derive a draw completely, and compare the printed numbers with the values from the formulas of its structure."""
    try:
        _, printed, _, _ = derived(load_problem(root, problem_id, draw))
    except DeriveError as error:
        found.degenerate.setdefault("the derivation fails", []).append(words)
        found.complaints += error.complaints
        return
    found.compared += 1
    for key, value in values.items():
        for number, figures in _printed(printed[key].result) if key in printed else ():
            if abs(number - value) > 10.0 ** (1 - figures) * abs(value):
                message = f"`{key}` is {value:.9g} by the derived formula, but the page prints {number:.9g}: {words}"
                found.complaints.append(Complaint("variants", message))


def _printed(value: Any) -> Iterator[tuple[float, int]]:
    """Yield the printed number in the coherent SI unit, with its number of significant figures."""

    if isinstance(value, Amount) and isinstance(value.args[0], Rounded):
        yield float(value.args[0].args[0] * value.args[2]), int(value.args[0].args[1])
