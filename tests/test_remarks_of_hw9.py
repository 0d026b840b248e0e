"""Formulas in the remarks of the homework that the page does not derive: they agree with the results of the page."""

from __future__ import annotations

from math import acos, degrees

import pytest
from sympy import Expr, Symbol, cos, diff, simplify, sqrt

from derive.algebra.expressions import explicit
from tests.courses import ROOT, solved_once

NUMBERS = {"S": 20.0, "M": 1.5, "l": 0.05, "g": 9.8, "I_z": 0.005, "I_x": 2 / 300}  # m = 1 kg, a = 10 cm


def letter(expr: Expr, name: str) -> Symbol:
    return next(each for each in expr.free_symbols if each.name == name)


def test_a_slow_top_turns_back_where_its_potential_energy_is_that_of_the_upright_top() -> None:
    _, solved = solved_once(ROOT, "hw9/top")
    U = explicit(solved.derivation.step("tilt_potential").result)
    S, M, l, g, I_z, I_x, theta = (letter(U, name) for name in ("S", "M", "l", "g", "I_z", "I_x", "theta"))
    c = Symbol("c")
    in_c = U.subs(cos(theta), c)
    lowest, turning = I_z * S / sqrt(I_x * M * g * l) - 1, I_z**2 * S**2 / (2 * I_x * M * g * l) - 1
    assert simplify(diff(in_c, c).subs(c, lowest)) == 0
    assert simplify(in_c.subs(c, turning) - in_c.subs(c, 1)) == 0
    known = {each: NUMBERS[each.name] for each in (S, M, l, g, I_z, I_x)}
    assert [degrees(acos(each.subs(known))) for each in (lowest, turning)] == pytest.approx([64.6, 88.8], abs=0.05)


def test_the_bound_of_the_sleeping_top_is_where_both_rates_of_small_precession_coincide() -> None:
    _, solved = solved_once(ROOT, "hw9/top")
    bounds = [solved.derivation.step(key).chain for key in ("precession_condition", "condition_of_stability")]
    one, other = (next(form.expr for form in chain if form.expr.left.is_Pow) for chain in bounds)
    theta = letter(one.right, "theta")
    assert simplify(explicit(one.right).subs(theta, 0) - explicit(other.right)) == 0


def test_the_friction_that_rocking_needs_is_a_fraction_of_the_weight() -> None:
    _, solved = solved_once(ROOT, "hw9/slab")
    F = explicit(solved.derivation.step("friction_needed").result)
    M, R, a, g, I, tilt = (letter(F, name) for name in ("M", "R", "a", "g", "I", "theta_0"))
    assert simplify(F + M * g * tilt * (I + M * a * R / 2) / (I + M * a**2 / 4)) == 0
