"""Formulas in the remarks of the homework that the page does not derive: they agree with the results of the page."""

from __future__ import annotations

from math import acos, degrees, log

import pytest
from sympy import Expr, Symbol, cos, diff, pi, simplify, solve, sqrt

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
    ratio = S * I_z / (2 * sqrt(I_x * M * g * l))  # the spin over the critical spin
    lowest, turning = 2 * ratio - 1, 2 * ratio**2 - 1  # cos^2(theta/2) = ratio, and cos(theta/2) = ratio
    assert simplify(diff(in_c, c).subs(c, lowest)) == 0
    assert simplify(in_c.subs(c, turning) - in_c.subs(c, 1)) == 0
    known = {each: NUMBERS[each.name] for each in (S, M, l, g, I_z, I_x)}
    assert [degrees(acos(each.subs(known))) for each in (lowest, turning)] == pytest.approx([64.6, 88.8], abs=0.05)
    assert degrees(acos(turning.subs({**known, S: 27}))) == pytest.approx(31, abs=0.5)


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
    assert simplify(F - M * g * tilt * (I + M * a * R / 2) / (I + M * a**2 / 4)) == 0


def test_in_the_fast_precession_the_socket_pushes_with_35_times_the_weight() -> None:
    """The centre of mass moves uniformly on a horizontal circle."""
    _, solved = solved_once(ROOT, "hw9/top")
    rate = explicit(solved.derivation.step("fast_precession").result)
    found = float(rate.subs({letter(rate, "S"): 30 * pi, letter(rate, "g"): 9.8, letter(rate, "a"): 0.1}))
    across = found**2 * NUMBERS["l"] * float(cos(pi / 4))
    assert across == pytest.approx(342, abs=0.5) and across / NUMBERS["g"] == pytest.approx(35, abs=0.2)


def test_the_multipliers_give_the_equation_of_motion_as_the_page_says() -> None:
    _, solved = solved_once(ROOT, "hw9/slab")
    turning, *forces = (
        explicit(solved.derivation.step(key).result) for key in ("motion_theta", "lambda_x", "lambda_y")
    )
    right = turning.right.expand()
    arms = [right.coeff(letter(right, name)) for name in ("lambda_x", "lambda_y")]
    R, a, theta = (letter(right, name) for name in ("R", "a", "theta"))
    M, rate = letter(forces[0], "M"), letter(forces[0], "theta_dot")
    assert simplify(arms[0] ** 2 + arms[1] ** 2 - R**2 * theta**2 - a**2 / 4) == 0
    squared = sum(arm * force.expand().coeff(rate, 2) for arm, force in zip(arms, forces, strict=True))
    assert simplify(squared + M * R**2 * theta) == 0


@pytest.mark.parametrize(("one", "other", "sign"), [("x", "y", 1), ("y", "x", -1)])
def test_a_symmetric_body_precesses_freely_at_the_stated_rate(one: str, other: str, sign: int) -> None:
    _, solved = solved_once(ROOT, "hw9/euler")
    left = explicit(solved.derivation.step(f"euler_{one}").result).left
    I_x, I_y, I_z, z = (letter(left, name) for name in ("I_x", "I_y", "I_z", "omega_z"))
    rate, across = letter(left, f"omega_{one}_dot"), letter(left, f"omega_{other}")
    assert simplify((left - I_x * rate - sign * (I_z - I_x) * z * across).subs(I_y, I_x)) == 0


def test_the_slab_slips_long_before_its_potential_energy_is_greatest() -> None:
    _, solved = solved_once(ROOT, "hw9/slab")
    motion, N, F = (
        explicit(solved.derivation.step(key).result) for key in ("equation_of_motion", "normal_force", "tangent_force")
    )
    theta = letter(N, "theta")
    rate, turning = Symbol("rate"), Symbol("turning")

    def at_rest(expr: Expr) -> Expr:
        free = {each.name: each for each in expr.free_symbols}
        names = {free[name]: new for name, new in (("theta_dot", rate), ("theta_ddot", turning)) if name in free}
        return expr.xreplace(names).subs(rate, 0)

    found = solve(at_rest(motion.left), turning)[0]
    needed = at_rest(F).subs(turning, found) / at_rest(N).subs(turning, found)
    slab = {"M": 1.0, "g": 9.8, "R": 0.2, "a": 0.05, "I": (0.05**2 + 0.6**2) / 12}
    known = {each: slab[each.name] for each in needed.free_symbols if each.name in slab}
    assert float(needed.subs(known).subs(theta, 21.3 * pi / 180)) == pytest.approx(0.5, abs=0.005)
    drawn = {"M": 1.0, "g": 9.8, "R": 1.0, "a": 0.5, "I": (3.5**2 + 0.5**2) / 12}
    known = {each: drawn[each.name] for each in needed.free_symbols if each.name in drawn}
    assert float(needed.subs(known).subs(theta, pi / 6)) == pytest.approx(0.75, abs=0.005)


def test_the_angular_momentum_of_a_long_bar_is_nearly_perpendicular_to_it() -> None:
    _, solved = solved_once(ROOT, "hw9/block")
    tensor, spin = (
        explicit(solved.derivation.step(key).result) for key in ("general_block_inertia_tensor", "general_block_spin")
    )
    a, b, c = (next(each for each in tensor.free_symbols if each.name == name) for name in "abc")
    L = tensor * spin
    cosine = (L.dot(spin) / (L.norm() * spin.norm())).subs(b, a)
    assert float(
        (cosine / (2 * sqrt(2) * a / c)).subs({a: 1, c: 1e4, **dict.fromkeys(cosine.free_symbols - {a, c}, 1)})
    ) == (pytest.approx(1, rel=1e-4))


def test_an_unstable_slab_and_a_slab_of_four_radii_move_as_the_remarks_say() -> None:
    """Slab (ii), 60 cm long, tips: a small tilt doubles every 0.24 s. A thin slab of the length 4R has the frequency
    sqrt(3g/(4R))."""
    _, solved = solved_once(ROOT, "hw9/slab")
    squared = explicit(solved.derivation.step("frequency_squared").result)
    M, R, a, g, I = (letter(squared, name) for name in ("M", "R", "a", "g", "I"))
    slab = {M: 1.0, g: 9.8, R: 0.1, a: 0.3, I: (0.3**2 + 0.6**2) / 12}
    assert log(2) / sqrt(-float(squared.subs(slab))) == pytest.approx(0.24, abs=0.005)
    assert simplify(squared.subs({a: 0, I: M * (4 * R) ** 2 / 12}) - 3 * g / (4 * R)) == 0
