"""Wrong laws of round, thin and composed bodies and of principal axes: see `test_wrong_laws.py`."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

from tests.mechanics.round_bodies import M, R, a, cone_derivation, h, skew_tensor, top_derivation

Verbs = SimpleNamespace
BODIES, SOLIDS, THIN, INERTIA = "mechanics.bodies", "mechanics.solids", "mechanics.thin_bodies", "mechanics.inertia"
CASES = "mechanics.special_cases"
COMPOSED, PRINCIPAL, REGIONS = "mechanics.composed", "mechanics.principal", "mechanics.regions"
INTEGRATION, INTEGRALS = "mechanics.integration", "integrals"


def skew(verbs: Verbs) -> Any:
    return verbs.principal_axes(verbs.principal_moments(skew_tensor(verbs)))


def special_case(verbs: Verbs) -> Any:
    return verbs.isotropic_where(verbs.principal_moments(verbs.inertia_tensor(verbs.Cone(R, h, M))), h)


def moved_out(verbs: Verbs) -> Any:
    block = verbs.Cuboid((a, 2 * a, 3 * a), M)
    return verbs.moved_from_centre(verbs.inertia_tensor(block), block.centre)


RUNS: dict[str, Callable[[Verbs], Any]] = {
    "volume": lambda verbs: verbs.volume(verbs.Cone(R, h, M)),
    "centre_of_mass of a cone": lambda verbs: verbs.Cone(R, h, M).centre,
    "inertia_tensor of a cone": cone_derivation,
    "inertia_tensor of a cylinder": lambda verbs: verbs.inertia_tensor(verbs.Cylinder(R, h, M), "base", "cartesian"),
    "inertia_tensor of a ball": lambda verbs: verbs.inertia_tensor(verbs.Ball(R, M)),
    "inertia_tensor of a hoop": lambda verbs: verbs.inertia_tensor(verbs.Hoop(R, M), "rim"),
    "inertia_tensor of a plate": skew_tensor,
    "moved_to of a cone": cone_derivation,
    "moved_from_centre": moved_out,
    "moment_of_inertia": lambda verbs: verbs.moment_of_inertia(verbs.Plate((R, h), M)),
    "agreement": cone_derivation,
    "principal_moments": cone_derivation,
    "principal_moments of a plate": skew,
    "principal_axes": cone_derivation,
    "principal_axes of a plate": skew,
    "isotropic_where": special_case,
    "total_mass": top_derivation,
    "centre_distance": top_derivation,
    "part_moment": top_derivation,
    "axial_moment": top_derivation,
    "transverse_moment": top_derivation,
}

LAWS: list[tuple[str, str, str, str, str]] = [
    (
        "moment_of_inertia",
        INERTIA,
        "weight = entry_weight(region, (i, i))",
        "weight = entry_weight(region, (0, 0))",
        "moment_of_inertia",
    ),
    (
        "moment_of_inertia",
        INERTIA,
        "weight = entry_weight(region, (i, i))",
        "weight = 2 * entry_weight(region, (i, i))",
        "moment_of_inertia",
    ),
    ("moved_from_centre", INERTIA, "sign = 1 if outward else -1", "sign = -1 if outward else -1", "moved_tensor_xx"),
    (
        "moved_from_centre",
        INERTIA,
        "-sign * Factors(mass, c[i], c[j])",
        "sign * Factors(mass, c[i], c[j])",
        "moved_tensor_xy",
    ),
    ("volume", SOLIDS, "self.radius * z / self.height", "self.radius * z**2 / self.height**2", "volume"),
    (
        "volume",
        REGIONS,
        "(theta, Integer(0), 2 * pi), (r, Integer(0), edge))",
        "(theta, Integer(0), pi), (r, Integer(0), edge))",
        "volume",
    ),
    ("volume", REGIONS, "point), z), r)", "point), z), r**2)", "volume"),
    (
        "centre_of_mass of a cone",
        BODIES,
        "region.integral(region.position[2])",
        "region.integral(region.position[2] / 2)",
        "centre_of_mass_on_axis",
    ),
    (
        "centre_of_mass of a cone",
        BODIES,
        "column(0, 0, height.symbol)",
        "column(0, height.symbol, 0)",
        "centre_of_mass",
    ),
    # a cone about its apex and about its base
    ("inertia_tensor of a cone", INERTIA, "(1, 1): at[(0, 0)]", "(1, 1): at[(2, 2)]", "apex_tensor"),
    ("inertia_tensor of a cone", REGIONS, "chord = sqrt(r**2", "chord = sqrt(4 * r**2", "base_tensor_xx"),
    ("inertia_tensor of a cone", REGIONS, "(y, -r - b, r - b)", "(y, -b, r - b)", "base_tensor_xx"),
    (
        "inertia_tensor of a cone",
        REGIONS,
        "[2] + self.axes[2, 2] * z",
        "[2] - self.axes[2, 2] * z",
        "inertia_tensor_xx",
    ),
    (
        "inertia_tensor of a cone",
        INTEGRATION,
        "Nested(factor_terms(value), self.limits[:-1])",
        "Nested(factor_terms(2 * value), self.limits[:-1])",
        "volume",
    ),
    (
        "inertia_tensor of a cone",
        INTEGRATION,
        "/ ((exponent + 1) * base.diff(z))",
        "/ (exponent + 1)",
        "base_tensor_xx",
    ),
    ("inertia_tensor of a cone", INTEGRATION, "* r ** (m + n)", "* r ** (m + n + 1)", "base_tensor_xx"),
    ("inertia_tensor of a cone", INTEGRATION, "(u, -pi / 2, pi / 2)", "(u, 0, pi / 2)", "base_tensor_xx"),
    (
        "inertia_tensor of a cylinder",
        SOLIDS,
        "Factors(pi, self.radius**2, self.height)",
        "Factors(pi, self.radius, self.height)",
        "density",
    ),
    ("inertia_tensor of a ball", SOLIDS, "sqrt(self.radius**2 - z**2)", "sqrt(self.radius**2 - z**2 / 4)", "density"),
    (
        "inertia_tensor of a hoop",
        REGIONS,
        "2 * pi),), column(*place, -point.position[2]), radius)",
        "2 * pi),), column(*place, -point.position[2]), radius / 2)",
        "density",
    ),
    (
        "inertia_tensor of a hoop",
        REGIONS,
        "return x - start[0], y - start[1]",
        "return x - 2 * start[0], y - start[1]",
        "inertia_tensor_yy",
    ),
    (
        "inertia_tensor of a plate",
        REGIONS,
        "position.append(name if side is not None else -start)",
        "position.append(name if side is not None else name)",
        "inertia_tensor_xx",
    ),
    ("moved_to of a cone", INERTIA, "squares = [c[k] ** 2", "squares = [2 * c[k] ** 2", "inertia_tensor_xx"),
    (
        "moved_to of a cone",
        INERTIA,
        "return Terms(at_start, sign * Factors(mass, shift)) if squares else at_start",
        "return Terms(at_start, sign * Factors(mass, shift)) if squares else 2 * at_start",
        "inertia_tensor_zz",
    ),
    ("agreement", INERTIA, "lambda first, _: first", "lambda first, _: 2 * first", "agreement"),
    ("agreement", INERTIA, "lambda first, _: first", "lambda first, _: first.T * first", "agreement"),
    # principal moments and axes
    (
        "principal_moments",
        PRINCIPAL,
        "column(*(whole[k, k] for k in range(3)))",
        "column(*(whole[0, k] for k in range(3)))",
        "principal_moments",
    ),
    (
        "principal_moments",
        PRINCIPAL,
        "column(*(whole[k, k] for k in range(3)))",
        "column(*(whole[0, 0] for k in range(3)))",
        "principal_moments",
    ),
    ("principal_moments of a plate", PRINCIPAL, "return [-b / a]", "return [b / a]", "principal_moments"),
    (
        "principal_moments of a plate",
        PRINCIPAL,
        "(-b + inside) / (2 * a)]",
        "(b + inside) / (2 * a)]",
        "principal_moments",
    ),
    (
        "principal_axes",
        PRINCIPAL,
        "column(*(int(i == k) for i in range(3))) for k in range(3)]",
        "column(*(int(i != k) for i in range(3))) for k in range(3)]",
        "principal_axis_3",
    ),
    (
        "principal_axes",
        PRINCIPAL,
        "cos(angle) * u + sin(angle) * v",
        "cos(angle) * u - sin(angle) * v",
        "principal_axis_2",
    ),
    (
        "principal_axes",
        PRINCIPAL,
        "i, j = (alone + 1) % 3, (alone + 2) % 3\n        u",
        "i, j = alone % 3, (alone + 2) % 3\n        u",
        "principal_axis_3",
    ),
    (
        "principal_axes of a plate",
        PRINCIPAL,
        "rows[i, :].cross(rows[j, :])",
        "rows[i, :].cross(rows[i, :] + ImmutableDenseMatrix([[1, 1, 1]]))",
        "principal_axis_1",
    ),
    ("principal_axes of a plate", PRINCIPAL, "(rest / length)", "(rest / length**2)", "principal_axis_1"),
    # bodies composed of parts
    ("total_mass", COMPOSED, "        Terms,\n", "        lambda *masses: Terms(masses[0]),\n", "total_mass"),
    ("total_mass", COMPOSED, "        Terms,\n", "        lambda *masses: Terms(*masses, masses[0]),\n", "total_mass"),
    (
        "centre_distance",
        COMPOSED,
        "Ratio(Terms(*(Factors(part.body.mass, part.at)",
        "Ratio(Terms(*(Factors(2, part.body.mass, part.at)",
        "centre_distance",
    ),
    (
        "centre_distance",
        COMPOSED,
        "Ratio(Terms(*(Factors(part.body.mass, part.at)",
        "Ratio(Terms(*(Factors(part.at, part.at)",
        "centre_distance",
    ),
    ("part_moment", COMPOSED, "Factors(Rational(1, 2), along)", "Factors(Rational(1, 3), along)", "disc_moment_x"),
    (
        "part_moment",
        COMPOSED,
        "Factors(density, region.integral(weight))",
        "Factors(2, density, region.integral(weight))",
        "disc_moment_z",
    ),
    ("part_moment", THIN, "Factors(pi, self.radius**2)", "Factors(2, pi, self.radius**2)", "disc_density"),
    ("axial_moment", COMPOSED, "lambda *found: _sum(list(found))", "lambda *found: 2 * found[0]", "axial_moment"),
    ("axial_moment", COMPOSED, "lambda *found: _sum(list(found))", "lambda *found: -found[0]", "axial_moment"),
    (
        "isotropic_where",
        CASES,
        'Relation(found[one], "=", found[other])',
        'Relation(found[one], "=", 2 * found[other])',
        "special_case",
    ),
    (
        "isotropic_where",
        CASES,
        "moments.value[k] / _letters_only(plain)",
        "(k + 1) * moments.value[k] / _letters_only(plain)",
        "special_case",
    ),
    (
        "isotropic_where",
        CASES,
        'Relation(unknown**2, "=", tidied(bound**2))',
        'Relation(unknown**2, "=", tidied(bound))',
        "special_case",
    ),
    ("isotropic_where", CASES, "tidied(-rest / leading)", "tidied(-2 * rest / leading)", "special_case"),
    ("transverse_moment", COMPOSED, "            terms.append(own)\n", "", "transverse_moment"),
    ("transverse_moment", COMPOSED, "Pow(part.at, 2, evaluate", "Pow(part.at, 3, evaluate", "transverse_moment"),
    (
        "transverse_moment",
        COMPOSED,
        "self.body.middle.position - column(0, 0, self.at)",
        "self.body.middle.position + column(0, 0, self.at)",
        "centre_distance",
    ),
]

ROUTES: list[tuple[str, str, str, str, str]] = [
    (
        "moment_of_inertia",
        INERTIA,
        "_entry_from_particles(body, point, (i, i))",
        "_entry_from_particles(body, point, (0, 0))",
        "moment_of_inertia",
    ),
    ("moved_from_centre", INERTIA, "_as_defined(body, target)", "_as_defined(body, body.middle)", "moved_tensor"),
    (
        "isotropic_where",
        CASES,
        ".value.subs(letter, bound))\n    return there",
        ".value.subs(letter, 2 * bound))\n    return there",
        "special_case",
    ),
    ("isotropic_where", CASES, "-rises * Abs(before)", "rises * Abs(before)", "special_case"),
    ("part_moment", COMPOSED, "(m * _squared_distance(centre.", "(2 * m * _squared_distance(centre.", "disc_moment_z"),
    ("volume", SOLIDS, "(r1 + r2 + r3) / 3", "(r1 + r2 + r3) / 2", "volume"),
    (
        "centre_of_mass of a cone",
        SOLIDS,
        "(Rational(4, 5), Rational(3, 4))",
        "(Rational(4, 5), Rational(1, 2))",
        "centre_of_mass_on_axis",
    ),
    (
        "inertia_tensor of a cone",
        SOLIDS,
        "r * self.height, self.radius * z",
        "r * self.height, 2 * self.radius * z",
        "section_radius",
    ),
    (
        "inertia_tensor of a cylinder",
        SOLIDS,
        "(Rational(2, 3), Rational(1, 2))",
        "(Rational(1, 3), Rational(1, 2))",
        "inertia_tensor_xx",
    ),
    (
        "inertia_tensor of a ball",
        SOLIDS,
        "(self.mass / 10, column(*place))",
        "(self.mass / 5, column(*place))",
        "inertia_tensor_xx",
    ),
    (
        "inertia_tensor of a hoop",
        THIN,
        "[(self.mass / 4, column(x, y, 0))",
        "[(self.mass / 2, column(x, y, 0))",
        "inertia_tensor_xx",
    ),
    (
        "inertia_tensor of a plate",
        THIN,
        "(self.mass / 6, column(x, y, 0))",
        "(self.mass / 5, column(x, y, 0))",
        "inertia_tensor_xx",
    ),
    ("agreement", INERTIA, "turn * again.value * turn.T", "2 * turn * again.value * turn.T", "agreement"),
    (
        "principal_moments",
        PRINCIPAL,
        "- t[i, j] * t[j, i] for",
        "- t[i, i] * t[j, i] - t[i, i] for",
        "principal_moments",
    ),
    (
        "principal_axes",
        PRINCIPAL,
        "(tensor.value * e, moments.value[k] * e)",
        "(tensor.value * e, moments.value[k - 1] * e)",
        "principal_axis_3",
    ),
    ("total_mass", COMPOSED, "over_mass(lambda _: Integer(1)", "over_mass(lambda _: Integer(2)", "total_mass"),
    ("centre_distance", COMPOSED, "m * (place[2] - l)", "m * (place[2] + l)", "centre_distance"),
    (
        "axial_moment",
        COMPOSED,
        "(mass * _squared_distance(place, pair) for",
        "(2 * mass * _squared_distance(place, pair) for",
        "axial_moment",
    ),
    (
        "transverse_moment",
        COMPOSED,
        "_squared_distance(r, pair), part.pivot)",
        "_squared_distance(r, pair), part.body.middle)",
        "transverse_moment",
    ),
]
