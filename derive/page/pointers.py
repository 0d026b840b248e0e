"""Steps whose results are in earlier lines, such as one of two roots written with ±, or a principal moment in a tensor.

Below the level `full` the sentence of such a step points to the earlier lines, and the step has no lines of its own.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from sympy import MatrixBase, Symbol

from derive.algebra.expressions import Relation
from derive.page.chain_lines import listed
from derive.page.wording import Chain, Inline, Math, Phrases, Ref, Text, filled, joined, names_of_step
from derive.steps.derivation import Derivation
from derive.steps.step import Step


def that_have_it(step: Step, derivation: Derivation) -> tuple[Step, ...]:
    """Return the inputs whose lines show the result of the step."""
    inputs = [each for key in step.inputs if (each := derivation.step(key)).rule in step.display.result_in]
    if not isinstance(step.symbol, MatrixBase):
        return tuple(inputs)
    lines = {each.result: each for each in reversed(inputs)}
    values = list(dict.fromkeys(step.result))
    return tuple(lines[value] for value in values) if lines.keys() >= set(values) else ()


def pointed_out(
    sentence: Iterable[Inline], step: Step, having_it: Sequence[Step], words: Phrases, again: bool = False
) -> tuple[Inline, ...]:
    """Return the sentence of a step with a reference to lines of other steps instead of the step's own lines.

    again  whether the sentence before refers to the same lines
    """
    several = isinstance(step.symbol, MatrixBase)
    instead = _names_of_values(step, having_it, words) if several else _clause(step, having_it[0], words, again)
    nodes = [each for node in sentence for each in (instead if isinstance(node, Chain) else (node,))]
    ended = isinstance(nodes[-1], Text) and nodes[-1].text.rstrip().endswith(".")
    return tuple(nodes) if ended else (*nodes, Text("."))


def _names_of_values(step: Step, having_it: Sequence[Step], words: Phrases) -> tuple[Inline, ...]:
    """Return each value with its names and with the symbol of the earlier line: I_1 = I_2 = I_xx
    and I_3 = I_zz.
    """
    letters: dict[object, Symbol] = {each.result: each.symbol for each in having_it}
    lines = listed(step.symbol, step.result)
    return joined([(Math(Relation(line.left, "=", letters[line.right])),) for line in lines], words.labels["and"])


def _clause(step: Step, having_it: Step, words: Phrases, again: bool) -> tuple[Inline, ...]:
    names = {**names_of_step(step, words, None), "shown": Ref(having_it.key), **({"again": True} if again else {})}
    return filled(words.clauses[step.rule][step.outcome], names)
