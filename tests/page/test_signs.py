"""Tests of the signs between the lines of a chain."""

from __future__ import annotations

import pytest
from sympy import Integer

from derive.page.signs import sign_before
from derive.steps.step import Form


@pytest.mark.parametrize(
    ("because", "sign"),
    [("law", "equals"), ("result", "equals"), ("rounded", "approx"), ("series", "approx"), ("limit", "tends")],
)
def test_only_what_is_not_equal_has_another_sign(because: str, sign: str) -> None:
    assert sign_before(Form(Integer(1), because)) == sign
