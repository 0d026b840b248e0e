"""Descriptions are plain data."""

from __future__ import annotations

from dataclasses import replace

from tests.witness.systems import ON_A_STRING, PENDULUM, S


def test_two_equal_descriptions_are_one_key() -> None:
    assert {PENDULUM: 1}[replace(PENDULUM)] == 1
    assert replace(PENDULUM, gravity=None) != PENDULUM


def test_the_multipliers_are_the_letters_of_what_keeps_conditions() -> None:
    assert ON_A_STRING.multipliers == (S,)
    assert PENDULUM.multipliers == ()
