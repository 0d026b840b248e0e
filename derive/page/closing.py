"""The limiting and special cases at the end of a page: one sentence each; a result that is a vector or a tensor is
displayed."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from sympy import MatrixBase

from derive.algebra.expansion import Approach
from derive.algebra.expressions import Relation
from derive.course.problem import Problem
from derive.errors import Complaint
from derive.page.numbering import Number
from derive.page.signs import name_before, sign_before
from derive.page.wording import Chain, Inline, Math, Phrases, Ref, Text, around_chain, filled
from derive.steps.derivation import Derivation
from derive.steps.rule import ZERO
from derive.steps.step import Step

Nodes = tuple[Inline, ...]


def limits_left_out(problem: Problem, derivation: Derivation) -> list[Complaint]:
    """Return a warning for each case that is left out, such as a limit of a symbol that the result does not contain."""
    found = []
    for keys, given in zip(derivation.closing, problem.limits, strict=True):
        if not keys:
            of = given.of or given.step
            letters = [str(given.letter)] if given.letter else [str(letter) for letter in given.where]
            on = ("all of " if len(letters) > 1 else "") + ", ".join(f"`{letter}`" for letter in letters)
            message = f"this case is left out: `{of}` does not depend on {on}, or other inputs exclude the case"
            found.append(Complaint("unused-limit", message, given.places[""], severity="warning"))
    return found


def sort_of_cases(problem: Problem, derivation: Derivation) -> str:
    """Return the label of the cases: in a limiting case a symbol goes to a limit, in a special case it has a value.
    A single case has a label in the singular."""
    shown = [given for keys, given in zip(derivation.closing, problem.limits, strict=True) if keys]
    special = [bool(given.where) for given in shown if not given.step]
    alone = len(shown) == 1
    if not special or not any(special):
        return "limit" if alone else "limits"
    if len(special) == len(shown) and all(special):
        return "special_case" if alone else "special_cases"
    return "special_and_limits"


def limiting_cases(
    problem: Problem,
    derivation: Derivation,
    words: Phrases,
    phrase: Callable[[Step], Nodes],
    told: Callable[[Any], Nodes],
    numbers: Mapping[str, Number],
) -> Iterator[Step | Nodes]:
    """Yield the steps that only the limiting cases need. Then yield, for each case, its sentence, or its step and
    further sentences if the result is displayed.

    phrase, told   functions that return the words of a step, and the words of prose that the author wrote
    numbers        numbers of the equations on the page; the caller adds numbers between two sentences
    """
    own = {key for keys in derivation.closing for key in keys}
    shown = {key for keys in (*derivation.parts, *derivation.observed) for key in keys} | own
    yield from (step for step in derivation.steps if step.key not in shown)  # only the limiting cases need these steps
    for keys, given in zip(derivation.closing, problem.limits, strict=True):
        if not keys:  # this case does not apply to the result
            continue
        first, *more = (derivation.step(key) for key in keys)
        said = _in_the_line(first, phrase(first))
        behind = [_agreed(step, derivation, words, numbers) for step in more]
        behind += [told(given.why.pieces)] if given.why else []
        if said is None:
            yield first
        if said is not None or behind:
            yield _with_commas([*([said] if said else []), *behind])


def _agreed(step: Step, derivation: Derivation, words: Phrases, numbers: Mapping[str, Number]) -> Nodes:
    """Return the sentence which states that a limit agrees with a known result."""
    known = derivation.step(step.inputs[-1])
    named: Inline = Ref(known.key) if known.key in numbers or known.symbol is None else Math(known.symbol)
    return filled(words.phrase(step), {"known": named, "formula": Math(step.chain[0].expr)})


def _in_the_line(step: Step, nodes: Nodes) -> Nodes | None:
    """Return the sentence of a step with its result in the text. Return None for a vector or tensor, which is too tall
    for the text, unless the sentence already states that the result is 0."""
    last = step.chain[-1]
    if step.display.names_formula and step.outcome == ZERO:  # the sentence already states the result 0
        said, _ = around_chain(nodes)
        return *said[:-1], Text(said[-1].text.rstrip(" ,")) if isinstance(said[-1], Text) else said[-1]
    if isinstance(last.expr, MatrixBase):
        return None
    return tuple(part for node in nodes for part in (_result(step) if isinstance(node, Chain) else (node,)))


def _result(step: Step) -> Nodes:
    last = step.chain[-1]
    if step.symbol is None or step.display.names_formula:
        return (Math(last.expr),)
    what = dict(step.roles).get("bound", name_before(step))
    match sign_before(last):
        case "tends":
            return (Math(Approach(what, last.expr)),)
        case "approx":
            return Math(what), Text(" ≈ "), Math(last.expr)
    if step.about:
        return Math(what), Text(" ≈ "), Math(last.expr)
    return (Math(Relation(what, "=", last.expr)),)


def _with_commas(parts: Sequence[Nodes]) -> Nodes:
    nodes: list[Inline] = []
    for i, part in enumerate(parts):
        nodes += [Text(", ")] if i else []
        nodes += part
    if isinstance(nodes[-1], Text) and nodes[-1].text.rstrip().endswith("."):
        return tuple(nodes)
    return (*nodes, Text("."))
