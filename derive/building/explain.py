"""The explanation of one step of a problem, or one line about each step, as text or as JSON."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from itertools import zip_longest
from pathlib import Path
from textwrap import wrap

from derive.building.solution import derived
from derive.course.problem import load_problem
from derive.course.problem_set import language_of
from derive.course.yaml_tree import abridged
from derive.errors import Complaint, Misused, did_you_mean
from derive.page.explanation import Explanation, Section, explanation_of, told_of
from derive.page.template import templates_of
from derive.page.wording import Phrases, phrases
from derive.render.notation.notation import Notation
from derive.render.notation.text import plain
from derive.render.printing.text_blocks import named_result
from derive.render.printing.text_page import inline_text
from derive.steps.derivation import standing_in
from derive.steps.homogeneity import dimension_table
from derive.steps.step import Step

WIDTH, INDENT = 100, 10
Rows = list[tuple[str, ...]]


def explain(root: Path, problem_id: str, key: str | None, as_json: bool) -> str | Rows:
    """Return the explanation of the step with that key; without a key, a table with a row for each step."""
    problem = load_problem(root, problem_id)
    words = phrases(templates_of(root), language_of(root, problem.set_id))
    derivation, values, *_ = derived(problem)
    steps = {step.key: step for step in [*derivation.steps, *values.values()]}
    notation = Notation(dimension_table(problem.dimensions, steps.values())[0], language=words.labels["language"])
    found = {each: explanation_of(steps[each], problem, derivation, values, words) for each in _wanted(key, steps)}
    if as_json:
        facts = [explanation.facts() for explanation in found.values()]
        return json.dumps(facts if key is None else facts[0], indent=2, ensure_ascii=False)
    if key is not None:
        (explanation,) = found.values()
        return f"{_value(explanation.step, notation)}\n\n{_text(told_of(explanation, words), notation)}"
    rows = [_row(explanation, words, notation) for explanation in found.values()]
    return [tuple(words.labels["explain_columns"]), *rows]


def _wanted(key: str | None, steps: Mapping[str, Step]) -> Iterable[str]:
    if key is None:
        return steps
    of_verbs = {step.rule.rpartition(".")[2]: step.key for step in reversed(list(steps.values()))}
    known = {**of_verbs, **standing_in(steps.values()), **{each: each for each in steps}}
    if key not in known:
        listed = "`derive explain` without a step lists the steps of the problem"
        raise Misused(Complaint("no-such-step", f"no step is called `{key}`", help=did_you_mean(key, known) or listed))
    return [known[key]]


def _row(explanation: Explanation, words: Phrases, notation: Notation) -> tuple[str, ...]:
    step, value = explanation.step, _value(explanation.step, notation)
    shown = plain(notation.layout(step.symbol)) if "\n" in value and step.symbol is not None else abridged(value, 60)
    return step.key, explanation.part, words.grades[step.grade], shown


def _value(step: Step, notation: Notation) -> str:
    return plain(named_result(step, notation))


def _text(sections: list[Section], notation: Notation) -> str:
    lines = []
    for heading, told in sections:
        texts = [line for each in told for line in _wrapped(inline_text(each, notation))]
        lines += [f"{head:{INDENT}}{text}" for head, text in zip_longest([heading], texts, fillvalue="")]
    return "\n".join(lines)


def _wrapped(text: str) -> list[str]:
    return wrap(text, WIDTH - INDENT, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False)
