"""The spinning top as the book's tests know it: a disc on a rod, its motion, and what it sleeps by."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from sympy import Symbol

from derive.algebra.expressions import scalar
from derive.steps.record import Run, recorded

Verbs = SimpleNamespace
a, g, m, S = (Symbol(name, positive=True) for name in "agmS")


def motion_of(verbs: Verbs, spin: Any = S) -> SimpleNamespace:
    """A disc in the middle of a rod of half its mass and of the length of its radius."""
    with recorded(Run()):
        disc, rod = verbs.Disc(a, m).at(0, 0, a / 2), verbs.Rod(a, m / 2).at(0, 0, a / 2)
        top = verbs.symbolic_body(verbs.Composite(disc, rod, points={"pivot": (0, 0, 0)}))
        phi, theta, psi = (verbs.coordinate(name) for name in ("phi", "theta", "psi"))
        axes = verbs.space.turned(verbs.Z, phi).turned(verbs.X, theta).turned(verbs.Z, psi)
        L = verbs.lagrangian(verbs.System(top.held(axes, at="pivot"), verbs.weight(g)))
        kept = verbs.conserved(L, psi, value=top.moments[2] * spin, key="constant_spin")
        tilting = verbs.put_in(verbs.equation_of_motion(L, theta), kept, key="tilt_equation")
        steady = verbs.steady_motion(tilting, key="steady_precession")
        return SimpleNamespace(top=top, L=L, phi=phi, theta=theta, psi=psi, kept=kept, tilting=tilting, steady=steady)


def rates_of(verbs: Verbs, motion: SimpleNamespace, tilt: Any, numbers: Any = None) -> SimpleNamespace:
    with recorded(Run(numbers=numbers or {})):
        here = verbs.let("tilt", lambda: tilt, symbol="theta", kind="angle")
        keys = ("slow_precession", "fast_precession")
        slow, fast = verbs.roots(
            motion.steady, scalar("phi_dot"), here, *motion.top.values, together="precession_rates", keys=keys
        )
        together = next(q for q in (slow, *slow.parents) if q.key == "precession_rates")
        condition = verbs.real_where(slow, S, key="precession_condition")
        return SimpleNamespace(together=together, slow=slow, fast=fast, condition=condition)


def sleeping(verbs: Verbs) -> SimpleNamespace:
    all_of = motion_of(verbs)
    with recorded(Run(coordinates={q.symbol: "angle" for q in (all_of.phi, all_of.theta, all_of.psi)})):
        p_phi, p_psi = verbs.conserved(all_of.L, all_of.phi), verbs.conserved(all_of.L, all_of.psi)
        upright = verbs.put_in(p_phi, all_of.kept, {all_of.theta: 0}, key="upright_momentum")
        V = verbs.put_in(verbs.effective_potential(all_of.L, p_phi, p_psi), upright, all_of.kept, symbol="V")
        stable = verbs.stability(V, {all_of.theta: 0}, S)
        condition = verbs.stable_where(stable)
        here = verbs.put_in(condition, *all_of.top.values, key="sleeping_spin")
        return SimpleNamespace(upright=upright, V=V, stable=stable, condition=condition, here=here)
