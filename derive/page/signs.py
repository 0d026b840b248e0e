"""The sign between two lines of a chain: equals, approximately equals, tends to."""

from __future__ import annotations

from typing import Any

from sympy.core.symbol import Str

from derive.steps.step import Form, Step

_BY_REASON = {"rounded": "approx", "series": "approx", "limit": "tends"}


def sign_before(form: Form) -> str:
    """Return the name of the sign before a line: for example `approx` before a rounded number, or `tends` before a
    limit."""
    return _BY_REASON.get(form.because, "equals")


def sign_behind_name(step: Step, form: Form) -> str:
    """Return the sign between the symbol of a step and a line: approximately equal if the result is approximate."""
    sign = sign_before(form)
    return "approx" if sign == "equals" and step.about else sign


def name_before(step: Step) -> Any:
    """Return the left side of a chain: the symbol of the step, or for a limit or a series the symbol of the exact
    result."""
    return step.approximates if step.breaks_off and not isinstance(step.approximates, Str) else step.symbol


def sign_of_relation(step: Step, word: str) -> str:
    """Return the sign of an equation: approximately equal if the equation follows from an approximation."""
    return "approx" if word == "equals" and not step.exact else word
