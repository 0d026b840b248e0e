"""The sign between a line of a chain and the one before it: equals, about equals, tends to."""

from __future__ import annotations

from typing import Any

from sympy.core.symbol import Str

from derive.steps.step import Form, Step

_BY_REASON = {"rounded": "approx", "series": "approx", "limit": "tends"}


def sign_before(form: Form) -> str:
    """Return the sign by its name in the page's tree: rounded numbers and truncated series are only about equal."""
    return _BY_REASON.get(form.because, "equals")


def sign_behind_name(step: Step, form: Form) -> str:
    """Return the sign between the name of a step and a line; results of an approximation are only about equal."""
    sign = sign_before(form)
    return "approx" if sign == "equals" and step.about else sign


def name_before(step: Step) -> Any:
    """Return the left side of a chain: the step's symbol, or before a limit or a series the symbol of the whole."""
    return step.approximates if step.breaks_off and not isinstance(step.approximates, Str) else step.symbol


def sign_of_relation(step: Step, word: str) -> str:
    """Return the sign of an equation: if it follows from an approximation, it holds only about."""
    return "approx" if word == "equals" and not step.exact else word
