"""What stands between a line of a chain and the one before it: equals, about equals, tends to."""

from __future__ import annotations

from derive.steps.step import Form

_BY_REASON = {"rounded": "approx", "series": "approx", "limit": "tends"}


def sign_before(form: Form) -> str:
    """The sign, as a page's tree names it: a number that is rounded and a series cut off are only about equal."""
    return _BY_REASON.get(form.because, "equals")
