"""Random systems have the equations of motion that follow from positions alone, by a derivation without `derive`."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from mpmath import mp
from sympy import Symbol

from tests.differential import DIGITS, Drawn, compared, derived, disagreement, drawn

COUNT = 12  # `make mutants` tries 300


@pytest.mark.parametrize("number", range(COUNT))
def test_a_random_system_has_the_equations_of_motion_of_its_positions(tmp_path: Path, number: int) -> None:
    outcome = compared(f"suite/{number}", tmp_path)
    assert outcome.verdict == "agrees", outcome


def _pendulum_with_a_cart() -> Drawn:
    return next(system for n in range(100) if len((system := drawn(f"wrong/{n}")).kinds) == 2 and system.springs)


@pytest.mark.parametrize("wrong", ["sign", "term", "factor"])
def test_a_wrong_equation_of_motion_is_found(tmp_path: Path, wrong: str) -> None:
    system = _pendulum_with_a_cart()
    steps, conditions = derived(system, tmp_path)
    q, left = next(iter(steps.items()))
    rate = Symbol(f"{q}_ddot", real=True)
    changed = {"sign": left.subs(rate, -rate), "term": left + rate**2, "factor": left.subs(rate, 2 * rate)}[wrong]
    with mp.workdps(DIGITS):
        assert not disagreement(system, steps, conditions, random.Random("state"))
        assert disagreement(system, {**steps, q: changed}, conditions, random.Random("state"))


def test_systems_of_every_kind_are_drawn() -> None:
    texts = "\n".join(drawn(f"kinds/{n}").text for n in range(200))
    for word in ("shape: rod", "shape: disc", "axes:", "springs:", "damping:", "constraints:", "charges:", "forces:"):
        assert word in texts
