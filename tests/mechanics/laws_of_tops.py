"""Wrong laws of tops, of their precession and sleep, and of quadratic equations: see `test_wrong_laws.py`."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

from sympy import Symbol, pi

from derive.measured import numbers_known

Verbs = SimpleNamespace
TOPS, CYCLIC, PRECESSION = "mechanics.tops", "mechanics.cyclic", "mechanics.precession"
QUADRATICS, SLEEPING, EQUATIONS = "mechanics.quadratics", "mechanics.sleeping", "mechanics.equations"
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


def rates_of(verbs: Verbs) -> Any:
    return verbs.precession_rates(verbs.steady_precession(motion_of(verbs).tilt), pi / 4)


def each_rate(verbs: Verbs) -> Any:
    rates = rates_of(verbs)
    return verbs.steady_rates(rates, verbs.precession_condition(rates, S))


def too_slow(verbs: Verbs) -> Any:
    """Ten in the SI is less than what the tilt of 45 degrees needs."""
    with numbers_known({a: a / a / 10, g: 98 * g / g / 10, S: 10 * S / S}):
        return each_rate(verbs)


def potential_of(verbs: Verbs) -> tuple[Any, Any]:
    all_of = motion_of(verbs)
    rate = verbs.upright_rate(verbs.conserved_momentum(all_of.L, all_of.angles.phi), all_of.tilt)
    return all_of, verbs.effective_potential(rate, all_of.T, all_of.U)


def curvature_here(verbs: Verbs) -> Any:
    all_of, V = potential_of(verbs)
    curvature = verbs.curvature_at(verbs.slope(V, 2))
    return all_of, V, verbs.with_values(curvature, *all_of.top.values, key="curvature_here")


def sleeping(verbs: Verbs) -> Any:
    all_of, V, here = curvature_here(verbs)
    stable = verbs.positive_where(here, S)
    potential = verbs.with_values(V, *all_of.top.values, key="potential_here")
    return verbs.sleeping_spin(stable, verbs.leading_order(potential, where=verbs.boundary_case(stable)), V)


RUNS: dict[str, Callable[[Verbs], Any]] = {
    "turning_rate": lambda verbs: verbs.turning_rate(verbs.euler_angles()),
    "top_kinetic_energy": lagrangian_of,
    "centre_height": lagrangian_of,
    "conserved_momentum": lambda verbs: (lambda all_of: verbs.conserved_momentum(all_of.L, all_of.angles.psi))(
        lagrangian_of(verbs)
    ),
    "constant_spin": motion_of,
    "tilt_equation": motion_of,
    "steady_precession": rates_of,
    "precession_rates": rates_of,
    "roots_of": rates_of,
    "precession_condition": each_rate,
    "discriminant": each_rate,
    "steady_rates": each_rate,
    "no_steady_precession": too_slow,
    "upright_rate": potential_of,
    "effective_potential": potential_of,
    "with_values": curvature_here,
    "sleeping_spin": sleeping,
}

LAWS: list[tuple[str, str, str, str, str]] = [
    (
        "turning_rate",
        TOPS,
        "column(0, sin(theta.symbol), cos(t",
        "column(0, cos(theta.symbol), sin(t",
        "angular_velocity",
    ),
    (
        "turning_rate",
        TOPS,
        "scaled(theta.rate, column(1, 0, 0))",
        "scaled(theta.rate, column(0, 1, 0))",
        "angular_velocity",
    ),
    ("turning_rate", TOPS, "scaled(phi.rate, vertical)", "scaled(-phi.rate, vertical)", "angular_velocity"),
    ("turning_rate", TOPS, "scaled(psi.rate, column(0, 0, 1))", "scaled(psi.rate, vertical)", "angular_velocity"),
    ("top_kinetic_energy", TOPS, "Terms(Pow(x, 2), Pow(y, 2))", "Terms(Pow(x, 2), Pow(z, 2))", "kinetic_energy"),
    ("top_kinetic_energy", TOPS, "Factors(HALF, along, Pow(z, 2))", "Factors(along, Pow(z, 2))", "kinetic_energy"),
    (
        "top_kinetic_energy",
        TOPS,
        "across, along = top.across.symbol, top",
        "along, across = top.across.symbol, top",
        "kinetic_energy",
    ),
    ("centre_height", TOPS, "l * cos(theta.symbol)", "l * sin(theta.symbol)", "centre_height"),
    ("centre_height", TOPS, "l * cos(theta.symbol)", "-l * cos(theta.symbol)", "centre_height"),
    (
        "conserved_momentum",
        CYCLIC,
        "Relation(TimeRate(p, *moving)",
        "Relation(TimeRate(p**2, *moving)",
        "conserved_psi",
    ),
    ("conserved_momentum", CYCLIC, "Relation(TimeRate(p, *moving)", "Relation(p", "conserved_psi"),
    (
        "constant_spin",
        TOPS,
        'Relation(omega.value[2], "=", rate)',
        'Relation(omega.value[1], "=", rate)',
        "constant_spin",
    ),
    (
        "constant_spin",
        TOPS,
        'Relation(omega.value[2], "=", rate)',
        'Relation(2 * omega.value[2], "=", rate)',
        "constant_spin",
    ),
    (
        "tilt_equation",
        TOPS,
        "rate - phi.rate * cos(theta.symbol)\n",
        "rate + phi.rate * cos(theta.symbol)\n",
        "tilt_equation",
    ),
    ("tilt_equation", TOPS, "rate - phi.rate * cos(theta.symbol)\n", "rate\n", "tilt_equation"),
    (
        "steady_precession",
        PRECESSION,
        "kept = by_rates(-(at_rest / sine)",
        "kept = by_rates(-at_rest",
        "steady_precession",
    ),
    (
        "steady_precession",
        PRECESSION,
        "{theta.acceleration: ZERO, theta",
        "{phi.rate: -phi.rate, theta.acceleration: ZERO, theta",
        "steady_precession",
    ),
    (
        "precession_rates",
        QUADRATICS,
        "of.b**2, -FOUR * of.a * of.c)",
        "of.b**2, FOUR * of.a * of.c)",
        "precession_rates",
    ),
    (
        "precession_rates",
        QUADRATICS,
        "Factors(PLUS_MINUS, Root(_of_terms(of)))",
        "Root(_of_terms(of))",
        "precession_rates",
    ),
    ("roots_of", QUADRATICS, "Ratio(Terms(-of.b, Factors", "Ratio(Terms(of.b, Factors", "precession_rates"),
    ("roots_of", QUADRATICS, "Root(_of_terms(of)))), 2 * of.a)", "Root(_of_terms(of)))), of.a)", "precession_rates"),
    ("roots_of", QUADRATICS, "k = tidied(outside / (2 * of.a))", "k = tidied(outside / of.a)", "precession_rates"),
    (
        "discriminant",
        QUADRATICS,
        "lambda *those: _with_those(_of_terms(general)",
        "lambda *those: _with_those(-_of_terms(general)",
        "discriminant",
    ),
    (
        "discriminant",
        QUADRATICS,
        "lambda *those: _with_those(_of_terms(general)",
        "lambda *those: _with_those(general.b**2 * _of_terms(general)",
        "discriminant",
    ),
    (
        "precession_condition",
        "mechanics.conditions",
        "bound = tidied(-rest / leading)",
        "bound = tidied(-2 * rest / leading)",
        "precession_condition",
    ),
    (
        "precession_condition",
        "mechanics.conditions",
        "turned = mark if (rising",
        "turned = mark if not (rising",
        "precession_condition",
    ),
    (
        "steady_rates",
        PRECESSION,
        "factor.xreplace({PLUS_MINUS: Integer(sign)})",
        "factor.xreplace({PLUS_MINUS: Integer(2 * sign)})",
        "slow_precession",
    ),
    (
        "steady_rates",
        PRECESSION,
        "factor.xreplace({PLUS_MINUS: Integer(sign)})",
        "factor.xreplace({PLUS_MINUS: Integer(-sign)})",
        "slow_precession",
    ),
    (
        "no_steady_precession",
        PRECESSION,
        'Relation(condition.value.left, "<", c',
        'Relation(-condition.value.left, "<", -c',
        "no_steady_precession",
    ),
    (
        "no_steady_precession",
        PRECESSION,
        '"<", condition.value.right)',
        '"<", condition.value.right / 9)',
        "no_steady_precession",
    ),
    (
        "upright_rate",
        SLEEPING,
        "Terms(carried, -carried * cos(theta.symbol))",
        "Terms(carried, carried * cos(theta.symbol))",
        "upright_rate",
    ),
    ("upright_rate", SLEEPING, "carried = along * spin", "carried = across * spin", "upright_rate"),
    (
        "effective_potential",
        SLEEPING,
        "Terms(HALF * top.across.symbol * turning**2",
        "Terms(top.across.symbol * turning**2",
        "effective_potential",
    ),
    ("effective_potential", SLEEPING, "sin(q) ** 2, weight)", "sin(q) ** 2, -weight)", "effective_potential"),
    (
        "with_values",
        EQUATIONS,
        "dict(zip(known, those, strict=True))",
        "dict(zip(reversed(known), those, strict=True))",
        "curvature_here",
    ),
    (
        "with_values",
        EQUATIONS,
        "lambda _, *those: bound(general.value",
        "lambda _, *those: 2 * bound(general.value",
        "curvature_here",
    ),
    (
        "sleeping_spin",
        SLEEPING,
        '">=" if sleeps else ">", least)',
        '">=" if sleeps else ">", least / 2)',
        "sleeping_spin",
    ),
    (
        "sleeping_spin",
        SLEEPING,
        'least = condition.context["bound"]',
        'least = 2 * condition.context["bound"]',
        "sleeping_spin",
    ),
]

ROUTES: list[tuple[str, str, str, str, str]] = [
    (
        "turning_rate",
        TOPS,
        "[0, cos(angle), -sin(angle)], [0, sin",
        "[0, cos(angle), sin(angle)], [0, -sin",
        "angular_velocity",
    ),
    (
        "top_kinetic_energy",
        TOPS,
        "symmetric_body(top.across.symbol, top.along",
        "symmetric_body(top.along.symbol, top.across",
        "kinetic_energy",
    ),
    (
        "centre_height",
        TOPS,
        "Matrix([0, 0, top.distance.symbol])",
        "Matrix([0, top.distance.symbol, 0])",
        "centre_height",
    ),
    (
        "conserved_momentum",
        CYCLIC,
        "inertia_along(q.symbol) - matter",
        "turning_along(q.symbol) - matter",
        "conserved_psi",
    ),
    ("constant_spin", TOPS, "return top.along.symbol * along", "return top.across.symbol * along", "constant_spin"),
    ("tilt_equation", TOPS, "Cross(following, momentum))[0]", "Cross(momentum, following))[0]", "tilt_equation"),
    (
        "steady_precession",
        PRECESSION,
        "column(0, phi.rate * sine, spin)",
        "column(0, phi.rate * sine, -spin)",
        "steady_precession",
    ),
    ("precession_rates", QUADRATICS, "-here.b / here.a\n", "here.b / here.a\n", "precession_rates"),
    ("roots_of", QUADRATICS, "(here.at(found), Integer(0))", "(here.at(-found), Integer(0))", "precession_rates"),
    (
        "discriminant",
        QUADRATICS,
        "resultant(here.at(x), 2 * here.a * x",
        "resultant(here.at(x), here.a * x",
        "discriminant",
    ),
    (
        "precession_condition",
        "mechanics.conditions",
        "beside = bound * (1 + little)",
        "beside = 3 * bound * (1 + little)",
        "precession_condition",
    ),
    ("steady_rates", PRECESSION, "(-quadratic.b - sign * sqrt", "(-quadratic.b + sign * sqrt", "slow_precession"),
    ("no_steady_precession", PRECESSION, "-Abs(here) - Abs(below)", "Abs(here) - Abs(below)", "no_steady_precession"),
    ("upright_rate", SLEEPING, "column(theta.rate, found * sin", "column(theta.rate, -found * sin", "upright_rate"),
    (
        "effective_potential",
        SLEEPING,
        "return found + moving + constant, whole",
        "return found + moving, whole",
        "effective_potential",
    ),
    (
        "with_values",
        EQUATIONS,
        "explicit(bound(bound(general.step",
        "2 * explicit(bound(bound(general.step",
        "curvature_here",
    ),
    (
        "sleeping_spin",
        SLEEPING,
        "axis.cross(Matrix([0, 0, -top.mass",
        "axis.cross(Matrix([0, 0, -2 * top.mass",
        "sleeping_spin",
    ),
]
