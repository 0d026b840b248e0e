"""Wrong laws of coordinates and of motion: see `test_wrong_laws.py`."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

from sympy import Integer, Rational, Symbol, cos, sin

from derive.expressions import Amount
from tests.mechanics.slab import I, M, R, a, g, known_slab

Verbs = SimpleNamespace
COORDINATES, LAGRANGIAN, ROLLING = "mechanics.coordinates", "mechanics.lagrangian", "mechanics.rolling"
OSCILLATIONS, CONDITIONS, POTENTIALS = "mechanics.oscillations", "mechanics.conditions", "mechanics.potentials"
CONSTRAINTS, NUMBERS = "mechanics.constraints", "numbers"


def height(verbs: Verbs) -> Any:
    """Of a point on a rolling body: R(theta sin theta + cos theta)."""
    from derive.step import establish

    theta = verbs.coordinate("theta")
    q = theta.symbol
    return establish(
        "equations.let",
        Symbol("y", real=True),
        lambda: R * (q * sin(q) + cos(q)),
        {},
        key="y",
        definition=True,
        kind="length",
        coordinates=theta.letters,
    )


def of_slab(verb: str, *keys: str, **named: Any) -> Callable[[Verbs], Any]:
    """The verb called on quantities of the slab that were derived by the laws as they are."""
    return lambda verbs: getattr(verbs, verb)(*(known_slab()[key] for key in keys), **named)


def of_angle(verb: str, key: str) -> Callable[[Verbs], Any]:
    return lambda verbs: getattr(verbs, verb)(known_slab()[key], verbs.coordinate("theta"))


def energy_of_motion(verbs: Verbs) -> Any:
    found, theta = known_slab(), verbs.coordinate("theta")
    return verbs.plane_kinetic_energy(M, (found["x_rate"], found["y_rate"]), (found["x"], found["y"]), I, theta)


def energy_of_a_particle(verbs: Verbs) -> Any:
    found = known_slab()
    return verbs.plane_kinetic_energy(M, (found["x_rate"], found["y_rate"]), (found["x"], found["y"]))


def energy_of_the_weight(verbs: Verbs) -> Any:
    return verbs.weight_energy(M, g, (known_slab()["x"], known_slab()["y"]))


def free(verbs: Verbs) -> Any:
    x, y = verbs.coordinate("x", "length"), verbs.coordinate("y", "length")
    return verbs.free_lagrangian(M, g, I, (x, y), verbs.coordinate("theta"))


def ties(verbs: Verbs) -> Any:
    found = known_slab()
    return tuple(verbs.tie(verbs.coordinate(name, "length"), found[name]) for name in ("x", "y"))


def with_multipliers(name: str) -> Callable[[Verbs], Any]:
    kind = "angle" if name == "theta" else "length"
    return lambda verbs: verbs.equation_with_multipliers(
        known_slab()["free_lagrangian"], verbs.coordinate(name, kind), ties(verbs)
    )


def force_up(verbs: Verbs) -> Any:
    return verbs.force_of_constraint(known_slab()["motion_y"], ties(verbs)[1])


def eliminated(verbs: Verbs) -> Any:
    found = known_slab()
    forces = (found["force_x"], found["force_y"])
    return verbs.multipliers_eliminated(found["motion_theta"], forces, found["equation_of_motion"])


def contact(verbs: Verbs) -> Any:
    found = known_slab()
    forces, place = (found["force_x"], found["force_y"]), (found["x"], found["y"])
    return verbs.contact_forces(forces, place, verbs.coordinate("theta"), found["equation_of_motion"])


def unstable(verbs: Verbs) -> Any:
    return verbs.frequency(known_slab(radius=a / 4)["frequency_squared"])


def never(verbs: Verbs) -> Any:
    return verbs.positive_where(known_slab(radius=a / 4)["frequency_squared"], a / 4)


def where_squared(verbs: Verbs) -> Any:
    """A speed squared that is positive where R^2 > a^2/4."""
    square = verbs.let("square", lambda: g * (4 * R**2 - a**2) / a)
    return verbs.positive_where(square, R)


def on_the_border(verbs: Verbs) -> Any:
    found = known_slab()
    return verbs.leading_order(found["potential_energy"], where=verbs.boundary_case(found["minimum"]))


def compared(verbs: Verbs) -> Any:
    """R > a/2 for R = 20 cm and a = 5 cm."""
    amounts = {R: Amount(Integer(20), "cm", Rational(1, 100)), a: Amount(Integer(5), "cm", Rational(1, 100))}
    return verbs.comparison_of(known_slab()["stability"], amounts)


RUNS: dict[str, Callable[[Verbs], Any]] = {
    "rate_of": lambda verbs: verbs.rate_of(height(verbs)),
    "rolled_centre": lambda verbs: verbs.rolled_centre(R, a / 2, verbs.coordinate("theta")),
    "plane_kinetic_energy": energy_of_motion,
    "plane_kinetic_energy of a particle": energy_of_a_particle,
    "weight_energy": energy_of_the_weight,
    "lagrangian": of_slab("lagrangian", "kinetic_energy", "potential_energy"),
    "generalized_force": of_angle("generalized_force", "lagrangian"),
    "generalized_momentum": of_angle("generalized_momentum", "lagrangian"),
    "momentum_rate": of_angle("momentum_rate", "momentum_theta"),
    "equation_of_motion": of_angle("equation_of_motion", "lagrangian"),
    "linearised": of_slab("linearised", "equation_of_motion"),
    "frequency_squared": of_slab("frequency_squared", "linearised"),
    "frequency": of_slab("frequency", "frequency_squared"),
    "frequency of nothing stable": unstable,
    "positive_where": of_slab("positive_where", "frequency_squared", letter=R),
    "positive_where squared": where_squared,
    "positive_where never": never,
    "slope": of_slab("slope", "potential_energy"),
    "slope twice": of_slab("slope", "potential_energy", order=2),
    "curvature_at": of_slab("curvature_at", "potential_energy_curvature"),
    "leading_order": on_the_border,
    "free_lagrangian": free,
    "equation_with_multipliers of x": with_multipliers("x"),
    "equation_with_multipliers of theta": with_multipliers("theta"),
    "force_of_constraint": force_up,
    "multipliers_eliminated": eliminated,
    "contact_forces": contact,
    "comparison_of": compared,
}
LAWS: list[tuple[str, str, str, str, str]] = [
    ("rate_of", COORDINATES, "lambda x: TimeRate(x, *moving)", "lambda x: 2 * TimeRate(x, *moving)", "y_rate"),
    ("rate_of", COORDINATES, "lambda x: TimeRate(x, *moving)", "lambda x: TimeRate(x**2, *moving)", "y_rate"),
    # where a rolling body is: the arc forwards, no arc at all, half the height, slipping, upside down
    ("rolled_centre", ROLLING, "Factors(above, sin(q)), -behind_x", "Factors(above, sin(q)), behind_x", "x"),
    ("rolled_centre", ROLLING, "Factors(above, sin(q)), -behind_x)", "Factors(above, sin(q)))", "x"),
    ("rolled_centre", ROLLING, "Factors(above, cos(q)), behind_y)", "Factors(above, cos(q)), -behind_y)", "x"),
    ("rolled_centre", ROLLING, "Factors(above, cos(q)), behind_y)", "Factors(above, cos(q)))", "x"),
    ("rolled_centre", ROLLING, "above = Terms(radius, height)", "above = Terms(radius, 2 * height)", "y"),
    ("rolled_centre", ROLLING, "radius * q * cos(q), radius * q", "2 * radius * q * cos(q), 2 * radius * q", "x"),
    ("rolled_centre", ROLLING, "radius * q * cos(q), radius * q", "height * q * cos(q), height * q", "x"),
    # energies
    (
        "plane_kinetic_energy",
        LAGRANGIAN,
        "moving = Factors(Rational(1, 2), m,",
        "moving = Factors(m,",
        "kinetic_energy",
    ),
    (
        "plane_kinetic_energy",
        LAGRANGIAN,
        "[Factors(Rational(1, 2), i, Pow(turning",
        "[Factors(i, Pow(turning",
        "kinetic_energy",
    ),
    ("plane_kinetic_energy", LAGRANGIAN, "Terms(*spinning, moving)", "Terms(*spinning, -moving)", "kinetic_energy"),
    (
        "plane_kinetic_energy",
        LAGRANGIAN,
        "return Terms(*spinning, moving) if spinning",
        "return moving if spinning",
        "kinetic_energy",
    ),
    (
        "plane_kinetic_energy",
        LAGRANGIAN,
        "(Pow(v, 2) for v in speeds)",
        "(Pow(v, 2) for v in speeds[:1])",
        "kinetic_energy",
    ),
    (
        "plane_kinetic_energy of a particle",
        LAGRANGIAN,
        "(Pow(v, 2) for v in speeds)",
        "(v for v in speeds)",
        "kinetic_energy",
    ),
    (
        "weight_energy",
        LAGRANGIAN,
        "lambda m, g, y: Factors(m, g, y)",
        "lambda m, g, y: -Factors(m, g, y)",
        "potential_energy",
    ),
    (
        "weight_energy",
        LAGRANGIAN,
        "lambda m, g, y: Factors(m, g, y)",
        "lambda m, g, y: Factors(2, m, g, y)",
        "potential_energy",
    ),
    ("weight_energy", LAGRANGIAN, "height = place[-1]", "height = place[0]", "potential_energy"),
    ("lagrangian", LAGRANGIAN, "lambda t, u: Terms(t, -u)", "lambda t, u: Terms(t, u)", "lagrangian"),
    ("lagrangian", LAGRANGIAN, "lambda t, u: Terms(t, -u)", "lambda t, u: Terms(u, -t)", "lagrangian"),
    ("lagrangian", LAGRANGIAN, "lambda t, u: Terms(t, -u)", "lambda t, u: Terms(2 * t, -u)", "lagrangian"),
    # Lagrange's equation
    (
        "generalized_force",
        LAGRANGIAN,
        "Partial(of.symbol, q.symbol),\n        lambda L: Partial(L, q.symbol)",
        "Partial(of.symbol, q.symbol),\n        lambda L: -Partial(L, q.symbol)",
        "force_theta",
    ),
    (
        "generalized_force",
        LAGRANGIAN,
        "Partial(of.symbol, q.symbol),\n        lambda L: Partial(L, q.symbol)",
        "Partial(of.symbol, q.symbol),\n        lambda L: Partial(L, q.rate)",
        "force_theta",
    ),
    (
        "generalized_force",
        LAGRANGIAN,
        "Partial(of.symbol, q.symbol),\n        lambda L: Partial(L, q.symbol)",
        "Partial(of.symbol, q.symbol),\n        lambda L: Partial(L.subs(q.rate, 0), q.symbol)",
        "force_theta",
    ),
    (
        "generalized_momentum",
        LAGRANGIAN,
        "\n        lambda L: Partial(L, q.rate),",
        "\n        lambda L: 2 * Partial(L, q.rate),",
        "momentum_theta",
    ),
    (
        "generalized_momentum",
        LAGRANGIAN,
        "\n        lambda L: Partial(L, q.rate),",
        "\n        lambda L: Partial(L, q.symbol),",
        "momentum_theta",
    ),
    (
        "momentum_rate",
        LAGRANGIAN,
        "lambda p: TimeRate(p, *moving)",
        "lambda p: q.acceleration * Partial(p, q.rate)",
        "momentum_theta_rate",
    ),
    (
        "momentum_rate",
        LAGRANGIAN,
        "lambda p: TimeRate(p, *moving)",
        "lambda p: -TimeRate(p, *moving)",
        "momentum_theta_rate",
    ),
    (
        "equation_of_motion",
        LAGRANGIAN,
        "Terms(TimeRate(Partial(L, q.rate), *moving), -Partial",
        "Terms(TimeRate(Partial(L, q.rate), *moving), Partial",
        "equation_of_motion",
    ),
    (
        "equation_of_motion",
        LAGRANGIAN,
        "Terms(TimeRate(Partial(L, q.rate), *moving), -Partial",
        "Terms(TimeRate(Partial(L, q.rate), *moving), -2 * Partial",
        "equation_of_motion",
    ),
    (
        "equation_of_motion",
        LAGRANGIAN,
        "Terms(first, -Group(second))",
        "Terms(first, Group(second))",
        "equation_of_motion",
    ),
    (
        "equation_of_motion",
        LAGRANGIAN,
        "by_accelerations(relation.left, moving)",
        "by_accelerations(relation.left.subs(q.rate, 0), moving)",
        "equation_of_motion",
    ),
    # small oscillations: the wrong sign, one term twice, what the second order leaves
    ("linearised", OSCILLATIONS, "spread(diff(left, q)) * q]", "-spread(diff(left, q)) * q]", "linearised"),
    ("linearised", OSCILLATIONS, "spread(diff(left, q)) * q]", "2 * spread(diff(left, q)) * q]", "linearised"),
    ("linearised", OSCILLATIONS, "place + small * q,", "place + small * q / 2,", "linearised"),
    (
        "linearised",
        OSCILLATIONS,
        "rate(q, 2): small * rate(q, 2)}",
        "rate(q, 2): small * rate(q, 2) / 2}",
        "linearised",
    ),
    ("frequency_squared", OSCILLATIONS, "Ratio(stiffness, mass)", "Ratio(mass, stiffness)", "frequency_squared"),
    ("frequency_squared", OSCILLATIONS, "Ratio(stiffness, mass)", "Ratio(-stiffness, mass)", "frequency_squared"),
    ("frequency_squared", OSCILLATIONS, "Ratio(stiffness, mass)", "Ratio(stiffness, 2 * mass)", "frequency_squared"),
    ("frequency", OSCILLATIONS, "lambda square: Root(", "lambda square: -Root(", "frequency"),
    ("frequency", OSCILLATIONS, "lambda square: Root(", "lambda square: 2 * Root(", "frequency"),
    ("frequency", OSCILLATIONS, "Root(-square if grows else square)", "(-square if grows else square)", "frequency"),
    ("frequency of nothing stable", OSCILLATIONS, "Root(-square if grows", "Root(square if grows", "frequency"),
    ("frequency of nothing stable", OSCILLATIONS, "lambda square: Root(", "lambda square: -Root(", "frequency"),
    # conditions: turned the wrong way, another bound, a factor of unknown sign divided out
    ("positive_where", CONDITIONS, "turned = mark if (rising > 0)", "turned = mark if (rising < 0)", "condition"),
    ("positive_where", CONDITIONS, "tidied(-rest / leading)", "tidied(-2 * rest / leading)", "condition"),
    ("positive_where", CONDITIONS, "tidied(-rest / leading)", "tidied(-leading / rest)", "condition"),
    (
        "positive_where",
        CONDITIONS,
        'lambda v: Relation(v, mark, 0),\n        {"quantity": of},\n        put_in=Level.STANDARD,\n        between',
        'lambda v: Relation(-v, mark, 0),\n        {"quantity": of},\n        put_in=Level.STANDARD,\n        between',
        "condition",
    ),
    (
        "positive_where squared",
        CONDITIONS,
        "bound = tidied(sqrt(bound))",
        "bound = 2 * tidied(sqrt(bound))",
        "condition",
    ),
    ("positive_where squared", CONDITIONS, "tidied(bound**2)", "tidied(bound)", "condition"),
    ("positive_where never", CONDITIONS, '"never", "<"', '"never", ">"', "condition"),
    # the shape of a potential
    (
        "slope",
        POTENTIALS,
        "lambda energy: Slope(energy, q, Integer(order))",
        "lambda energy: -Slope(energy, q, Integer(order))",
        "potential_energy_slope",
    ),
    (
        "slope",
        POTENTIALS,
        "lambda energy: Slope(energy, q, Integer(order))",
        "lambda energy: Slope(energy, q, Integer(order + 1))",
        "potential_energy_slope",
    ),
    (
        "slope twice",
        POTENTIALS,
        "lambda energy: Slope(energy, q, Integer(order))",
        "lambda energy: Slope(energy, q, Integer(order)) / 2",
        "potential_energy_curvature",
    ),
    (
        "curvature_at",
        POTENTIALS,
        "lambda second, _: At(second, q, place)",
        "lambda second, _: At(second, q, place) / 2",
        "curvature",
    ),
    (
        "curvature_at",
        POTENTIALS,
        "lambda second, _: At(second, q, place)",
        "lambda second, _: At(second, q, place + 1)",
        "curvature",
    ),
    (
        "curvature_at",
        POTENTIALS,
        "lambda second, _: At(second, q, place)",
        "lambda second, _: At(potential.value, q, place)",
        "curvature",
    ),
    ("leading_order", POTENTIALS, "Terms(constant, leading * Pow", "Terms(constant, -leading * Pow", "leading_order"),
    (
        "leading_order",
        POTENTIALS,
        "constant = tidied(value.subs(q, place))",
        "constant = 2 * tidied(value.subs(q, place))",
        "leading_order",
    ),
    ("leading_order", POTENTIALS, "        if coefficient != 0:", "        if coefficient == 0:", "leading_order"),
    ("leading_order", POTENTIALS, "range(2, HIGHEST + 1):", "range(5, HIGHEST + 1):", "leading_order"),
    # constraints kept by forces
    ("free_lagrangian", CONSTRAINTS, "moving, -Factors(m, g, y))", "moving, Factors(m, g, y))", "free_lagrangian"),
    ("free_lagrangian", CONSTRAINTS, "moving, -Factors(m, g, y))", "moving, -Factors(m, g, x))", "free_lagrangian"),
    (
        "free_lagrangian",
        CONSTRAINTS,
        "Pow(rate(x), 2), Pow(rate(y), 2)",
        "Pow(rate(x), 2), -Pow(rate(y), 2)",
        "free_lagrangian",
    ),
    ("free_lagrangian", CONSTRAINTS, "Terms(Factors(Rational(1, 2), i,", "Terms(Factors(i,", "free_lagrangian"),
    (
        "equation_with_multipliers of x",
        CONSTRAINTS,
        '*moving), -Partial(L, q.symbol)), "=", on_q)',
        '*moving), -Partial(L, q.symbol)), "=", -on_q)',
        "motion_x",
    ),
    (
        "equation_with_multipliers of theta",
        CONSTRAINTS,
        "diff(f, q.symbol) for force, f",
        "-diff(f, q.symbol) for force, f",
        "motion_theta",
    ),
    (
        "equation_with_multipliers of theta",
        CONSTRAINTS,
        "diff(f, q.symbol) for force, f in forces",
        "diff(f, q.symbol) for force, f in forces[:1]",
        "motion_theta",
    ),
    (
        "equation_with_multipliers of theta",
        CONSTRAINTS,
        "self.free.symbol - self.at.value",
        "self.free.symbol + self.at.value",
        "motion_theta",
    ),
    ("force_of_constraint", CONSTRAINTS, "lambda a: mass * a + applied", "lambda a: mass * a - applied", "force_y"),
    ("force_of_constraint", CONSTRAINTS, "lambda a: mass * a + applied", "lambda a: -mass * a + applied", "force_y"),
    ("force_of_constraint", CONSTRAINTS, "lambda a: mass * a + applied", "lambda a: mass * a", "force_y"),
    (
        "force_of_constraint",
        CONSTRAINTS,
        "acceleration = rate_of(rate_of(tied.at))",
        "acceleration = rate_of(tied.at)",
        "force_y",
    ),
    (
        "multipliers_eliminated",
        CONSTRAINTS,
        "Relation(left - right.xreplace",
        "Relation(left + right.xreplace",
        "multipliers_eliminated",
    ),
    (
        "multipliers_eliminated",
        CONSTRAINTS,
        "zip(forces, names, strict=False)",
        "zip(forces[::-1], names, strict=False)",
        "multipliers_eliminated",
    ),
    (
        "contact_forces",
        CONSTRAINTS,
        "Factors(x, n[0]), Factors(y, n[1])",
        "Factors(x, n[0]), -Factors(y, n[1])",
        "normal_force",
    ),
    (
        "contact_forces",
        CONSTRAINTS,
        "Factors(x, n[0]), Factors(y, n[1])",
        "Factors(x, n[1]), Factors(y, n[0])",
        "normal_force",
    ),
    (
        "contact_forces",
        CONSTRAINTS,
        "Factors(x, t[0]), -Factors(y, n[0])",
        "Factors(x, t[0]), Factors(y, n[0])",
        "tangent_force",
    ),
    (
        "contact_forces",
        CONSTRAINTS,
        "Factors(x, t[0]), -Factors(y, n[0])",
        "-Factors(x, t[0]), Factors(y, n[0])",
        "tangent_force",
    ),
    # whether a condition is fulfilled
    ("comparison_of", NUMBERS, '">" if difference.is_positive', '"<" if difference.is_positive', "stability_value"),
    ("comparison_of", NUMBERS, "explicit(left) - explicit(right)", "explicit(left) * 0", "stability_value"),
]
ROUTES: list[tuple[str, str, str, str, str]] = [
    ("rate_of", COORDINATES, "for _ in range(order):", "for _ in range(order + 1):", "y_rate"),
    ("rolled_centre", ROLLING, "turning = across[0]", "turning = across[1]", "x"),
    ("rolled_centre", ROLLING, "name_y: radius * cos(q)}", "name_y: 2 * radius * cos(q)}", "x"),
    ("rolled_centre", ROLLING, "one(name_y, radius + height)", "one(name_y, radius - height)", "y"),
    (
        "plane_kinetic_energy",
        LAGRANGIAN,
        "(matter.kinetic_energy)",
        "(lambda: 2 * matter.kinetic_energy())",
        "kinetic_energy",
    ),
    (
        "plane_kinetic_energy",
        LAGRANGIAN,
        "for x in place], moment, angle",
        "for x in place], 2 * moment, angle",
        "kinetic_energy",
    ),
    ("weight_energy", LAGRANGIAN, "-diff(potential, q) * mark", "diff(potential, q) * mark", "potential_energy"),
    (
        "weight_energy",
        LAGRANGIAN,
        "-value_behind(mass) * gravity",
        "-value_behind(mass) * gravity / 2",
        "potential_energy",
    ),
    ("lagrangian", LAGRANGIAN, "kinetic.value + potential.value", "kinetic.value - potential.value", "lagrangian"),
    (
        "generalized_force",
        LAGRANGIAN,
        "matter.force_along(q.symbol) + matter",
        "matter.force_along(q.symbol) - matter",
        "force_theta",
    ),
    (
        "generalized_force",
        LAGRANGIAN,
        "matter.force_along(q.symbol) + matter",
        "0 * matter.force_along(q.symbol) + matter",
        "force_theta",
    ),
    (
        "generalized_momentum",
        LAGRANGIAN,
        "lambda: matter.momentum_along(q.symbol)",
        "lambda: -matter.momentum_along(q.symbol)",
        "momentum_theta",
    ),
    (
        "momentum_rate",
        LAGRANGIAN,
        "by_functions_of_time(momentum.value, moving)",
        "by_functions_of_time(momentum.value, moving, 2)",
        "momentum_theta_rate",
    ),
    (
        "equation_of_motion",
        LAGRANGIAN,
        "matter.inertia_along(q.symbol) - matter",
        "matter.inertia_along(q.symbol) + matter",
        "equation_of_motion",
    ),
    ("linearised", OSCILLATIONS, "-energies.diff(q, 2)", "energies.diff(q, 2)", "linearised"),
    ("linearised", OSCILLATIONS, "energies.diff(rate(q), 2)", "2 * energies.diff(rate(q), 2)", "linearised"),
    ("frequency_squared", OSCILLATIONS, "swing = cos(trial * T)", "swing = cos(2 * trial * T)", "frequency_squared"),
    ("frequency", OSCILLATIONS, "/ motion + squared.value", "/ motion - squared.value", "frequency"),
    (
        "frequency of nothing stable",
        OSCILLATIONS,
        "exp(trial * T) if grows else cos(trial * T)",
        "cos(trial * T)",
        "frequency",
    ),
    ("positive_where", CONDITIONS, "beyond=True, sign=above", "beyond=False, sign=above", "condition"),
    ("positive_where", CONDITIONS, "beyond=False, sign=-above", "beyond=False, sign=above", "condition"),
    ("positive_where never", CONDITIONS, "lambda _: (value, size)", "lambda _: (value, -size)", "condition"),
    (
        "slope",
        POTENTIALS,
        "q, q, order) * factorial(order)",
        "q, q, order) * factorial(order + 1)",
        "potential_energy_slope",
    ),
    ("curvature_at", POTENTIALS, "2 * _coefficient(", "_coefficient(", "curvature"),
    ("leading_order", POTENTIALS, "expected = leading * factorial(order)", "expected = leading", "leading_order"),
    (
        "free_lagrangian",
        CONSTRAINTS,
        "matter.kinetic_energy() + mass * gravity * y",
        "matter.kinetic_energy() - mass * gravity * y",
        "free_lagrangian",
    ),
    (
        "equation_with_multipliers of x",
        CONSTRAINTS,
        "own = kept.multiplier if kept",
        "own = -kept.multiplier if kept",
        "motion_x",
    ),
    (
        "equation_with_multipliers of theta",
        CONSTRAINTS,
        "else -sum((t.multiplier",
        "else sum((t.multiplier",
        "motion_theta",
    ),
    ("force_of_constraint", CONSTRAINTS, "moving), moving) + applied", "moving), moving) - applied", "force_y"),
    (
        "multipliers_eliminated",
        CONSTRAINTS,
        "compared_with(lambda: found.value)",
        "compared_with(lambda: equation.value)",
        "multipliers_eliminated",
    ),
    ("contact_forces", CONSTRAINTS, "mass * a[i] - matter.loads[0]", "mass * a[i] + matter.loads[0]", "normal_force"),
    ("contact_forces", CONSTRAINTS, "arm[1] * reaction[0] - arm[0]", "arm[1] * reaction[0] + arm[0]", "tangent_force"),
    ("frequency", OSCILLATIONS, "return value, Abs(value)", "return value, -Abs(value)", "frequency"),
    ("leading_order", POTENTIALS, "n).subs(q, place)) != 0)", "n).subs(q, place)) == 0)", "leading_order"),
    ("comparison_of", NUMBERS, "1 if x > y else -1", "1 if x < y else -1", "stability_value"),
]
