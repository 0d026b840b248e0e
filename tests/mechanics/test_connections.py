"""Contacts, strings and massless rods: compared with Newton's and Euler's laws in random states."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest
from sympy import Expr, Symbol

from derive.algebra.expressions import explicit
from tests.newton_euler.random_systems import Trial, key_of, on_a_surface, problem, with_strings
from tests.stock.described import solved

TRIALS = [*on_a_surface(), *with_strings()]
STATES = 3


@pytest.mark.parametrize("trial", TRIALS, ids=lambda trial: trial.name)
def test_accelerations_and_forces_are_those_of_newton_and_euler(trial: Trial, tmp_path: Path) -> None:
    steps = solved(tmp_path, problem(trial))
    keys = {name: key_of(name) for name in trial.unknowns}
    for seed in range(STATES):
        numbers, wanted = trial.state(Random(f"{trial.name} {seed}"))
        found = {name: value_at(explicit(steps[key].value), numbers) for name, key in keys.items()}
        assert found == pytest.approx({name: wanted[name] for name in trial.unknowns}, rel=1e-6, abs=1e-6)


def value_at(value: Expr, numbers: dict[str, float]) -> float:
    letters: dict[Symbol, float] = {letter: numbers[letter.name] for letter in value.free_symbols}
    return float(value.evalf(subs=letters))
