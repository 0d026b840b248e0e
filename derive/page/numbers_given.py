"""The numbers of a problem that its prose does not mention: the page adds them, because the answers need them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from sympy import Symbol

from derive.algebra.expressions import IN_DEGREES, Amount
from derive.course.given import Measured
from derive.course.placement import case_label
from derive.course.problem import Problem
from derive.course.transcript import Transcript
from derive.page.wording import EQUALS, Inline, Math, Phrases, Text, filled, joined


def numbers_left(problem: Problem, shown: Sequence[Inline], words: Phrases) -> tuple[Inline, ...]:
    """Return a sentence with the numbers that `shown` does not give; () if `shown` gives all numbers.

    shown   the statement and the questions
    """
    left = _untold(problem.measured, shown)
    return take(joined(map(_stated, left), words.labels["and"]), words) if left else ()


def take(numbers: tuple[Inline, ...], words: Phrases) -> tuple[Inline, ...]:
    """Return the sentence with these numbers, to follow other sentences."""
    return (Text(" "), *filled(words.labels["take"], {"numbers": numbers}))


def are_told(cases: Iterable[Sequence[Measured]], question: Sequence[Inline]) -> bool:
    """Return whether a question states all the numbers of the cases of its plot."""
    return not any(_untold(case, question) for case in cases)


def _untold(measured: Iterable[Measured], shown: Sequence[Inline]) -> list[Measured]:
    told = {*_letters_with_numbers(shown)}
    text = "".join(node.text for node in shown if isinstance(node, Text))
    return [each for each in measured if each.symbol not in told and not _is_in_words(each, text)]


def numbers_of_cases(cases: Iterable[Sequence[Measured]], words: Phrases) -> tuple[Inline, ...]:
    """Return the numbers of the cases of a plot: `M = 1 kg and (i) R = 20 cm, a = 5 cm; (ii) R = 10 cm, a = 30 cm`."""
    first, *later = cases = list(cases)
    if not later:
        return _listed(first)
    changed = {each.symbol for case in later for each in case if each not in first}
    shared = [each for each in first if each.symbol not in changed] if changed else []
    listed = [_listed([each for each in case if each not in shared]) for case in cases]
    labelled = [(Text(f"({case_label(i)}) "), *numbers) for i, numbers in enumerate(listed)]
    own = tuple(node for case in labelled for node in (words.semicolon, *case))[1:]
    return joined([_listed(shared), own], words.labels["and"]) if shared else own


def _listed(numbers: Iterable[Measured]) -> tuple[Inline, ...]:
    return tuple(node for each in numbers for node in (Text(", "), *_stated(each)))[1:]


def _stated(each: Measured) -> tuple[Inline, ...]:
    return Math(each.symbol), EQUALS, Math(Amount(each.number, each.unit, each.factor))


def _letters_with_numbers(shown: Sequence[Inline]) -> Iterator[Symbol]:
    """Yield the letters that prose states with a number, by a mention or in a formula."""
    for letter, sign, value in zip(shown, shown[1:], shown[2:], strict=False):
        if isinstance(letter, Math) and sign == EQUALS and isinstance(value, Math):
            yield letter.expr
    for node in shown:
        if isinstance(node, Math) and isinstance(node.expr, Transcript) and len(node.expr.values) == 2:
            letter, value = node.expr.values
            if isinstance(letter, Symbol) and value.is_number:
                yield letter


def _is_in_words(each: Measured, text: str) -> bool:
    """Return whether the text contains the number with its unit, as in `a mass of 2 kg`."""
    unit = re.escape(each.unit.replace("^2", "²").replace("^3", "³"))
    unit = "(°|deg(rees?)?)" if each.unit in IN_DEGREES else unit
    number = re.escape(f"{float(each.number):.12g}")
    return re.search(rf"(?<![\w.]){number}\s*{unit}(?!\w)", text) is not None
