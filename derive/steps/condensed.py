"""The lines of a step with what some of their names stand for put in, when a page does not show the steps behind these.

A line that is written so is compared with the line that it was, by the values that `establish` kept with the step:
it is as much a checked line as any other.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from derive.algebra.equality import Compared, Evidence, equal
from derive.algebra.expressions import Truncated, bound, explicit
from derive.steps.chain import refused, without_repeats
from derive.steps.step import NUMBERS, Form, Step


def condensed(step: Step, known: Mapping[Any, Any]) -> Step:
    """The step with these names replaced in its lines, and the evidence that each line still says the same."""
    if not known:
        return step
    written = [_put_in(form, known) for form in step.chain]
    evidence = [
        _same(step, i, form, was) for i, (form, was) in enumerate(zip(written, step.chain, strict=True)) if form != was
    ]
    chain = without_repeats(written, step.symbol)
    return replace(step, chain=tuple(chain), evidence=(*step.evidence, *evidence))


def _put_in(form: Form, known: Mapping[Any, Any]) -> Form:
    """Numbers stay as they were read, and so does a series, of which the order is counted in its letters."""
    if form.because in NUMBERS or isinstance(form.expr, Truncated):
        return form
    return replace(form, expr=bound(form.expr, known))


def _same(step: Step, i: int, form: Form, was: Form) -> Evidence:
    names = dict(step.names)
    new, old = (explicit(bound(each.expr, names)) for each in (form, was))
    verdict = equal(old, new)
    if not verdict:
        raise refused(step.key, f"line {i + 1} is not what it was, with the values put in", old, new, verdict)
    return Evidence(f"line {i + 1} with values put in", Compared.LINES, verdict.grade, verdict.detail)
