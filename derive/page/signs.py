"""What stands between a line of a chain and the one before it: equals, about equals, tends to."""

from __future__ import annotations

from typing import Any

from sympy.core.symbol import Str

from derive.steps.step import Form, Step

_BY_REASON = {"rounded": "approx", "series": "approx", "limit": "tends"}


def sign_before(form: Form) -> str:
    """The sign, as a page's tree names it: a number that is rounded and a series cut off are only about equal."""
    return _BY_REASON.get(form.because, "equals")


def sign_behind_name(step: Step, form: Form) -> str:
    """The sign between the name of a step and one of its lines; derived from an approximation they are about equal."""
    sign = sign_before(form)
    return "approx" if sign == "equals" and step.about else sign


def name_before(step: Step) -> Any:
    """What stands on the left of the chain: the letter of the whole, before a limit or a series of it."""
    return step.approximates if step.breaks_off and not isinstance(step.approximates, Str) else step.symbol


def sign_of_relation(step: Step, word: str) -> str:
    """An equation that is derived from an approximation holds only about."""
    return "approx" if word == "equals" and not step.exact else word
