"""The names that the parts of a problem may ask for, with their meanings and values."""

from __future__ import annotations

from pathlib import Path

from derive.course.problem import Problem, load_problem, solving
from derive.course.script import run
from derive.course.stock import StockScript
from derive.course.yaml_tree import abridged
from derive.errors import DeriveError
from derive.render.notation.notation import Notation
from derive.render.notation.text import plain
from derive.render.printing.text_blocks import named_result
from derive.steps.derivation import returned_quantities, with_ancestors
from derive.steps.homogeneity import dimension_table
from derive.steps.record import Run
from derive.steps.step import Quantity, Step
from derive.stock.answering.meanings import meaning_of

WIDEST = 60
Rows = list[tuple[str, ...]]


def answers_of(root: Path, problem_id: str) -> Rows:
    """Return the table of the names that parts of a problem may ask for: a row of headings, then a row for each name.

    The answers come first, then the other steps, and last the answers that cannot be derived for this problem.
    """
    problem = load_problem(root, problem_id)
    record = Run()
    with solving(problem, record):
        offered = _offered(problem)
    found = {name: each for name, each in offered.items() if isinstance(each, tuple)}
    steps = with_ancestors_of_each(found)
    dimensions, _ = dimension_table(problem.dimensions, [quantity.step for quantity, _ in steps.values()])
    notation = Notation(dimensions)
    of_name = {name: (name, _meaning(name, problem), _values(each, notation)) for name, each in offered.items()}
    rows = [of_name[name] for name in found]
    rows += [
        (key, _on_the_way(quantity.step, leading), _value(quantity.step, notation))
        for key, (quantity, leading) in steps.items()
        if key not in offered
    ]
    return [("answer", "is", "value"), *rows, *(row for name, row in of_name.items() if name not in found)]


def _offered(problem: Problem) -> dict[str, tuple[Quantity, ...] | DeriveError]:
    if isinstance(problem.script, StockScript):
        return problem.script.stock.answers(problem.described).every()
    returned = returned_quantities(run(problem.script, {given.name: given.value for given in problem.givens}))
    return {quantity.key: (quantity,) for quantity in returned}


def with_ancestors_of_each(found: dict[str, tuple[Quantity, ...]]) -> dict[str, tuple[Quantity, str]]:
    """Return the steps of the answers and all steps on which these depend, by key. Each step has the name of the first
    answer that needs it."""
    steps: dict[str, tuple[Quantity, str]] = {}
    for name, quantities in found.items():
        for key, quantity in with_ancestors(quantities).items():
            steps.setdefault(key, (quantity, name))
    return steps


def _meaning(name: str, problem: Problem) -> str:
    made = problem.described.made if problem.described is not None else {}
    uses = next((uses for result, uses in made.items() if result == name), None)
    if uses is not None:
        return f"a result, computed from {', '.join(f'`{each}`' for each in uses)}" if uses else "a result"
    if not isinstance(problem.script, StockScript):
        return "an answer of the script"
    prefixes = problem.described.several if problem.described is not None else ()
    own = next((prefix for prefix in prefixes if name.startswith(f"{prefix}_")), None)
    return f"{meaning_of(name.removeprefix(f'{own}_'))}, of the {own}" if own else meaning_of(name)


def _on_the_way(step: Step, leading: str) -> str:
    called = step.rule.rpartition(".")[2].replace("_", " ")
    return f"a step of `{leading}`: {called}"


def _values(found: tuple[Quantity, ...] | DeriveError, notation: Notation) -> str:
    if isinstance(found, DeriveError):
        return f"(not derived: {abridged(found.complaints[0].message, WIDEST)})"
    if len(found) > 1:
        return ", ".join(quantity.key for quantity in found)
    return _value(found[0].step, notation)


def _value(step: Step, notation: Notation) -> str:
    """Return the value in one line. If the value takes several lines, return only the symbol of the step, or an empty
    text if the step has no symbol."""
    told = plain(named_result(step, notation))
    if "\n" in told:
        return plain(notation.layout(step.symbol)) if step.symbol is not None else ""
    return abridged(told, WIDEST)
