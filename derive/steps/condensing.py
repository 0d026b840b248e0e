"""Replace the symbols of earlier results by their values in the lines of a step.

Only the symbols of results whose steps have the manner `taken_in` are replaced.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from derive.algebra.equality import Compared, Evidence, equal
from derive.algebra.expressions import Truncated, bound, explicit
from derive.steps.chain import names_in, refused, without_repeats
from derive.steps.step import NUMBERS, Form, Step


def condensed(step: Step, known: Mapping[Any, Step]) -> Step:
    """In the lines of a step, replace the symbols of known steps by the results of these steps. Add evidence that each
    new line equals the line that it replaces."""
    if not known:
        return step
    results = {symbol: each.result for symbol, each in known.items()}
    written = [_put_in(form, results) for form in step.chain]
    own, inherited = dict(step.names), {name: value for each in known.values() for name, value in each.names}
    further = names_in([form.expr for form in written], inherited)
    step = replace(step, names=(*step.names, *(each for each in further if each[0] not in own)))
    evidence = [
        _same(step, i, form, was) for i, (form, was) in enumerate(zip(written, step.chain, strict=True)) if form != was
    ]
    chain = without_repeats(written, step.symbol)
    return replace(step, chain=tuple(chain), evidence=(*step.evidence, *evidence))


def _put_in(form: Form, known: Mapping[Any, Any]) -> Form:
    if form.because in NUMBERS or isinstance(form.expr, Truncated):
        return form
    return replace(form, expr=bound(form.expr, known))


def _same(step: Step, i: int, form: Form, was: Form) -> Evidence:
    names = dict(step.names)
    new, old = (explicit(bound(each.expr, names)) for each in (form, was))
    verdict = equal(old, new)
    if not verdict:
        raise refused(step.key, f"line {i + 1} changes when the values are substituted", old, new, verdict)
    return Evidence(f"line {i + 1} with values substituted", Compared.LINES, verdict.grade, verdict.detail)
