"""The spinning top as the book's tests know it: a disc on a rod, its motion, and what it sleeps by."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from sympy import Symbol

Verbs = SimpleNamespace
a, g, m, S = (Symbol(name, positive=True) for name in "agmS")


def top_of(verbs: Verbs) -> Any:
    """A disc in the middle of a rod of half its mass and of the length of its radius."""
    disc, rod = verbs.Disc(a, m), verbs.Rod(a, m / 2)
    body = verbs.Composed(verbs.Part("disc", disc, at=a / 2), verbs.Part("rod", rod, at=a / 2))
    mass = verbs.total_mass(body)
    return verbs.Top(mass, verbs.centre_distance(body, mass), verbs.transverse_moment(body), verbs.axial_moment(body))


def lagrangian_of(verbs: Verbs) -> SimpleNamespace:
    top, angles = top_of(verbs), verbs.euler_angles()
    omega = verbs.turning_rate(angles)
    T = verbs.top_kinetic_energy(top, omega)
    U = verbs.weight_energy(top.in_letters().mass, g, [verbs.centre_height(top, angles)])
    return SimpleNamespace(top=top, angles=angles, omega=omega, T=T, U=U, L=verbs.lagrangian(T, U))


def motion_of(verbs: Verbs) -> SimpleNamespace:
    all_of = lagrangian_of(verbs)
    turning = verbs.conserved_momentum(all_of.L, all_of.angles.psi)
    spin = verbs.constant_spin(all_of.omega, S, turning, all_of.top)
    equation = verbs.equation_of_motion(all_of.L, all_of.angles.theta)
    all_of.tilt = verbs.tilt_equation(equation, spin, all_of.top, g)
    return all_of


def potential_of(verbs: Verbs) -> tuple[Any, Any]:
    all_of = motion_of(verbs)
    rate = verbs.upright_rate(verbs.conserved_momentum(all_of.L, all_of.angles.phi), all_of.tilt)
    return all_of, verbs.tilt_potential(rate, all_of.T, all_of.U)


def curvature_here(verbs: Verbs) -> Any:
    all_of, V = potential_of(verbs)
    curvature = verbs.curvature_at(verbs.slope(V, 2))
    return all_of, V, verbs.with_values(curvature, *all_of.top.values, key="curvature_here")


def sleeping(verbs: Verbs) -> Any:
    all_of, V, here = curvature_here(verbs)
    stable = verbs.positive_where(here, S)
    potential = verbs.with_values(V, *all_of.top.values, key="potential_here")
    return verbs.sleeping_spin(stable, verbs.leading_order(potential, where=verbs.boundary_case(stable)), V)
