"""From a problem's id to its page: load the problem, derive its steps and the numbers of its answers, and print the
page."""

from __future__ import annotations

import time
from collections.abc import Collection, Iterable, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sympy import Expr, Integer, Symbol

from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.expressions import IN_DEGREES, Amount, Relation
from derive.algebra.kinds import dimension_of_kind, unit_of_dimension, unit_of_kind
from derive.building.cache import NO_CACHE, Cache
from derive.building.calls import calls_of
from derive.building.derivations import Solved, steps_key
from derive.building.pages import Wanted, printed, rubric_of
from derive.course.names import EvidenceShown
from derive.course.parts import Question
from derive.course.problem import Problem, problem_and_faults, run_solve
from derive.course.problem_set import language_of
from derive.course.reference.comparison import comparisons
from derive.course.reference.statements import reference_paths
from derive.course.stock import told_at
from derive.course.variants import Chosen
from derive.course.yaml_tree import Word
from derive.errors import Complaint, Faults, OutOfTime, Rejected, did_you_mean, during
from derive.figures.places import with_places
from derive.page.template import templates_of
from derive.page.wording import phrases
from derive.render.notation.latex import unprintable
from derive.render.notation.letters import letter_clashes
from derive.render.rendered import Rendered
from derive.steps import record
from derive.steps.derivation import (
    Derivation,
    answering,
    derivation_of,
    returned_groups,
    returned_quantities,
    with_ancestors,
)
from derive.steps.homogeneity import dimension_table
from derive.steps.memory import Memory
from derive.steps.numeric import COMPARISON, coefficient_of, comparison_of, is_plain, value_of
from derive.steps.step import Quantity, Step
from derive.stock.keys.limits import limits_of
from derive.stock.keys.observations import observations_of, with_known_observations
from derive.units import misfit, read_unit

if TYPE_CHECKING:
    from derive.grading.key import Key


def rendered(
    root: Path,
    problem_id: str,
    detail: str | None = None,
    cache: Cache = NO_CACHE,
    draws: bool = False,
    only: Collection[str] | None = None,
    evidence: EvidenceShown = EvidenceShown.NONE,
    documents: Collection[str] = (),
    chosen: Chosen | None = None,
    width: float | None = None,
) -> Rendered:
    """Derive a problem and print it; raise `DeriveError` if there are errors.

    cache    the cache of the steps and drawings that earlier builds stored
    chosen   the choices of a variant; a variant is not compared with the reference of the problem

    The parameters after `problem_id`, other than these two, are the fields of `Wanted`.
    """
    begun = time.time_ns()
    problem, faults = problem_and_faults(root, problem_id, chosen)
    with faults:
        _check_characters(problem)
    phrases(
        templates_of(root), language_of(root, problem.set_id)
    )  # raises errors in the phrases before anything is derived
    problem = with_known_observations(problem, faults)
    with faults:
        solved, failures = _solved(problem, NO_CACHE if faults else cache, begun, faults)
        page = printed(problem, solved, Wanted(detail, draws, only, evidence, documents, width), cache, failures)
    faults.stop()
    return replace(page, warnings=(*page.warnings, *dict.fromkeys(cache.unkept))) if cache.unkept else page


def answer_key(root: Path, problem_id: str, cache: Cache = NO_CACHE, chosen: Chosen | None = None) -> Key:
    """Return the answers of a problem or of a variant, with their points, for the grader; raise `DeriveError` if there
    are errors."""
    from derive.grading.key import key_of  # imported here, because it loads the reader of formulas

    begun = time.time_ns()
    problem, faults = problem_and_faults(root, problem_id, chosen)
    problem = with_known_observations(problem, faults)
    with faults:
        solved, _ = _solved(problem, NO_CACHE if faults else cache, begun, faults)
    return key_of(problem, solved.derivation, solved.values, rubric_of(problem, solved))


def _solved(problem: Problem, cache: Cache, begun: int, faults: Faults) -> tuple[Solved, tuple[Complaint, ...]]:
    """Return the steps and the disagreements with the reference.

    New steps are stored for later builds, unless there is an error or a disagreement, or a file was edited after the
    time `begun`.
    """
    key = steps_key(problem)
    with suppress(KeyError):
        return _kept(cache, key), ()
    with calls_of(problem.id, cache) as memory:
        derivation, values, known, run = derived(problem, memory, faults)
        with during(lambda: "the comparison with the reference"):
            compared = () if problem.is_variant else comparisons(problem, known, memory)
    failures = tuple(c.complaint for c in compared if c.complaint)
    drawings = tuple(with_places(drawing, derivation.steps) for drawing in run.drawings)
    solved = Solved(derivation, values, tuple(c.told() for c in compared), drawings)
    if not failures and not faults and not _edited(problem, begun):
        with suppress(
            ValueError, TypeError, RecursionError
        ):  # steps that JSON cannot represent are derived again next time
            cache.keep_data(key, solved.to_data())
    return solved, failures


def _edited(problem: Problem, begun: int) -> bool:
    files = [problem.root / path for path in (*problem.inputs, *reference_paths(problem))]
    return any(file.exists() and file.stat().st_ctime_ns > begun for file in files)


@lru_cache(maxsize=4)  # one process may need the same steps more than once
def _kept(cache: Cache, key: str) -> Solved:
    kept = Solved.from_data(cache.get_data(key))
    if kept is None:
        raise KeyError(key)
    return kept


def _check_characters(problem: Problem) -> None:
    faults = []
    for prose in problem.texts:
        at = unprintable(prose.text)
        if at is not None:
            message = f"`{prose.text[at]}` cannot be printed"
            help_line = "use Latin or Greek letters and the usual signs: the fonts of the page have no others"
            faults.append(Complaint("character", message, prose.place_within(at, 1), help=help_line))
    if faults:
        raise Rejected(faults)


def derived(
    problem: Problem, memory: Memory | None = None, faults: Faults | None = None
) -> tuple[Derivation, dict[str, Step], dict[str, Quantity], record.Run]:
    """Return the derivation, the steps that evaluate answers numerically, all results with their ancestors, and the
    record of the run.

    faults   collects the errors that do not affect any step; by default these errors are raised
    """
    run = record.Run(memory=memory)
    try:
        returned = run_solve(problem, run)
    except OutOfTime as late:
        late.finished = late.finished or record.finished_steps(run)
        late.kept = memory is not None
        places = [i for i, part in enumerate(problem.parts) if {*part.answers} & {*late.answers[-1:]}]
        late.doing += [f"part ({chr(ord('a') + i)})" for i in places[:1]]
        raise
    known = with_ancestors(returned_quantities(returned, problem.script.returns), problem.script.returns)
    groups = returned_groups(returned, problem.script.returns)
    steps = [quantity.step for quantity in known.values()]
    asked = [answering(part.answers, steps, groups) for part in problem.parts]
    _check_answers(known, asked)
    if clashes := letter_clashes(problem, known, run.coordinates):
        raise Rejected(clashes)
    closing = limits_of(problem, known, run)
    found = Faults() if faults is None else faults
    observed = observations_of(problem, known, [list(keys) for keys in asked], run, found)
    derivation = derivation_of(asked, known, run, groups, closing, observed)
    values: dict[str, Step] = {}
    dimensions, _ = dimension_table(problem.dimensions, derivation.steps, problem.script.returns)
    for part, answers_of_part in zip(problem.parts, asked, strict=True):
        for key, as_asked in answers_of_part.items():
            cases = problem.cases_of(part)
            value = _value(problem, part, known[key], as_asked, dimensions, found) if not cases else None
            if value is not None and not _compared_before(value.step, values.values()):
                values[key] = value.step
            for case, amounts in cases.items():
                value = _value(problem, part, known[key], as_asked, dimensions, found, amounts, case)
                if value is not None:
                    values[value.key] = value.step
    if faults is None:
        found.stop()
    return derivation, values, known, run


def _compared_before(step: Step, others: Iterable[Step]) -> bool:
    """Return whether another answer has the same comparison of numbers, which a page prints only once."""
    return step.rule == COMPARISON.name and step.chain in [other.chain for other in others]


def _check_answers(known: dict[str, Quantity], asked: list[dict[str, Word]]) -> None:
    short = [name for name in known if "_" not in name]
    faults = [
        Complaint(
            "no-such-answer",
            f"`solve()` returns nothing called `{key}`",
            keys[key].place,
            help=did_you_mean(key, known) or "among the steps are " + ", ".join(f"`{name}`" for name in short or known),
        )
        for keys in asked
        for key in keys
        if key not in known
    ]
    if faults:
        raise Rejected(faults)


def _usual_unit(problem: Problem, kind: str | None, dimension: Dimension) -> tuple[str, Expr]:
    """Return the first fitting unit of the `form:` of the set. If there is none, return degrees for angles if a
    given angle is in degrees, otherwise the coherent SI unit."""
    for unit in problem.units:
        read = read_unit(unit, unit.place)
        if misfit(read, kind, dimension) is None:
            return unit, read.factor
    given = next((m for m in problem.measured if kind == "angle" and m.unit in IN_DEGREES), None)
    if given is not None:
        return given.unit, given.factor
    return (unit_of_kind(kind) if kind else unit_of_dimension(dimension)), Integer(1)


def _value(
    problem: Problem,
    part: Question,
    answer: Quantity,
    asked: str,
    dimensions: Mapping[Any, Dimension | None],
    faults: Faults,
    amounts: Mapping[Symbol, Amount] | None = None,
    case: str = "",
) -> Quantity | None:
    """Return the number of an answer as the part asks for it; None if the answer has no number.

    amounts, case   the numbers of one case of the part, and the label of the case; by default the numbers of the
                    problem
    """
    key = f"{answer.key}_in_case_{case}" if case else None
    numbers = problem.amounts if amounts is None else amounts
    form = part.form_of(asked)
    if isinstance(answer.value, Relation) and not isinstance(answer.value.left, Symbol):
        # This condition is not solved for a letter, so it has no number.
        never = answer.value.operator == "=" and answer.coordinates
        if form.units and never and (asked in part.forms or len(part.answers) == 1):
            message = f"`{answer.key}` is an equation between quantities that vary, so it has no number with a unit"
            faults.error("wrong-unit", message, form.units[0].place, help="leave its `unit` out")
        return None
    kind, dimension = _kind_of(problem, answer, dimensions)
    units: list[tuple[str, Expr]] = []
    for unit in form.units:
        read = read_unit(unit, unit.place)
        wrong = misfit(read, kind, dimension)
        if wrong:
            faults.error(wrong.code, f"`{answer.key}` {wrong.why}", unit.place, help=wrong.help)
        else:
            units.append((unit, read.factor))
    first, *more = units or [_usual_unit(problem, kind, dimension)]
    figures = form.figures or problem.figures
    # The two sides of a condition are compared, unless the part gives a unit for the bound.
    compared = None if units else comparison_of(answer, numbers, key)
    if not numbers and not units and not form.figures and is_plain(answer):
        return None
    with told_at(getattr(asked, "place", None)):
        value = compared or value_of(answer, numbers, *first, figures, key, more, case)
    return value or (coefficient_of(answer, figures, bool(form.figures)) if not numbers else None)


def _kind_of(
    problem: Problem, answer: Quantity, dimensions: Mapping[Any, Dimension | None]
) -> tuple[str | None, Dimension]:
    """Return the kind, if any, and the dimension of an answer; a relation such as R > a/2 has the kind of R."""
    kind, symbol = answer.step.kind, answer.symbol
    if isinstance(answer.value, Relation):
        symbol = answer.value.left
        named = (q.step.kind for q in with_ancestors([answer]).values() if q.symbol == symbol)
        letter = problem.symbols.get(str(symbol))
        kind = next(named, None) or answer.coordinates.get(symbol) or (letter.kind if letter else None)
    return kind, dimension_of_kind(kind) if kind else dimensions.get(symbol) or NUMBER
