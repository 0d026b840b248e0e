"""A wrong law is refused at its own step, and so is a wrong second route: the check can fail both ways.

Each row replaces one piece of a verb's source and names the step that must refuse. A verb that is a definition asserts
nothing, so it has no wrong law; the others must all be here.
"""

from __future__ import annotations

import inspect
from types import SimpleNamespace
from typing import Any

import pytest
from sympy import Integer, pi

import derive.mechanics
import derive.mechanics.integration
import derive.numbers
from alteration import a, altered, amounts, block_derivation
from derive.errors import Unverified
from derive.step import Quantity

BODIES, INERTIA, ROTATION = "mechanics.bodies", "mechanics.inertia", "mechanics.rotation"
EQUATIONS, INTEGRATION, NUMBERS = "mechanics.equations", "mechanics.integration", "numbers"

# verb, module, a piece of its source, what is put there, the step that must refuse
LAWS = [
    ("density", BODIES, "Ratio(mass, sides)", "Ratio(2 * mass, sides)", "density"),
    ("density", BODIES, "Ratio(mass, sides)", "Ratio(sides, mass)", "density"),
    ("density", BODIES, "return Factors(*sides)", "return Factors(*sides[:2])", "density"),
    ("centre_of_mass", BODIES, "MatMul(Pow(mass, -1), whole", "MatMul(Pow(mass, -2), whole", "centre_of_mass"),
    ("centre_of_mass", BODIES, "MatMul(Pow(mass, -1), whole", "MatMul(2, Pow(mass, -1), whole", "centre_of_mass"),
    (
        "centre_of_mass",
        BODIES,
        'body.mass_integral(vector("r"), body.corner',
        'body.mass_integral(vector("r"), body.middle',
        "centre_of_mass",
    ),
    # the inertia tensor, its entries
    ("inertia_tensor", INERTIA, "enumerate(at) if k != i)", "enumerate(at) if k == i)", "corner_tensor_xx"),
    ("inertia_tensor", INERTIA, "sum((x**2 for k, x", "sum((x**3 for k, x", "corner_tensor_xx"),
    ("inertia_tensor", INERTIA, "else -at[i] * at[j]\n    integral", "else at[i] * at[j]\n    integral", "corner_tensor_xy"),
    ("inertia_tensor", INERTIA, "else -at[i] * at[j]\n    integral", "else -at[i]**2\n    integral", "corner_tensor_xy"),
    ("inertia_tensor", INERTIA, "Factors(-rho, integral", "Factors(rho, integral", "corner_tensor_xy"),
    ("inertia_tensor", INERTIA, "body.integral(weight, point", "body.integral(weight, body.middle", "corner_tensor_xx"),
    # and as a whole
    ("inertia_tensor", INERTIA, "Integer(-1), Outer(r, r)", "Integer(1), Outer(r, r)", "corner_tensor"),
    ("inertia_tensor", INERTIA, "Dot(r, r), Identity(3)", "2 * Dot(r, r), Identity(3)", "corner_tensor"),
    ("inertia_tensor", INERTIA, "at[(min(i, j), max(i, j))]", "at[tuple(sorted((2 - i, 2 - j)))]", "corner_tensor"),
    ("inertia_tensor", INERTIA, "at[(min(i, j), max(i, j))]", "(-1) ** (i != j) * at[(min(i, j), max(i, j))]", "corner_tensor"),
    # worked integrals, line by line
    ("worked_integral", INTEGRATION, "Integral(f, limit) for f", "Integral(2 * f, limit) for f", "corner_tensor_xx"),
    ("worked_integral", INTEGRATION, "if f.has(limit[0])))", "if not f.has(limit[0])))", "corner_tensor_xx"),
    ("worked_integral", INTEGRATION, "factors[first] = (number * ", "factors[first] = (", "corner_tensor_xy"),
    ("worked_integral", INTEGRATION, "Bracket(integrate(f, x), x, lower", "Bracket(f, x, lower", "corner_tensor_xx"),
    ("worked_integral", INTEGRATION, "x, lower, upper) for f", "x, upper, lower) for f", "corner_tensor_xx"),
    ("worked_integral", INTEGRATION, "values = [integrate(f, limit)", "values = [integrate(f**2, limit)", "corner_tensor_xx"),
    ("worked_integral", INTEGRATION, "Mul(*(integrate(f, limit)", "Mul(*(integrate(2 * f, limit)", "corner_tensor_xx"),
    ("worked_integral", INTEGRATION, "Form(rho * value,", "Form(rho * value / 2,", "corner_tensor_xx"),
    ("worked_integral", INTEGRATION, "Group(volume * rho), rest", "Group(volume * rho), rest**2", "corner_tensor_xx"),
    ("worked_integral", INTEGRATION, "return Factors(rho, *_flat", "return Factors(-rho, *_flat", "corner_tensor_xy"),
    # parallel axes
    ("moved_to", INERTIA, "c[k] ** 2 for k in range(3) if k != i", "c[k] ** 2 for k in range(3)", "inertia_tensor_xx"),
    ("moved_to", INERTIA, "-Factors(mass, Terms(", "Factors(mass, Terms(", "inertia_tensor_xx"),
    ("moved_to", INERTIA, "Factors(mass, c[i], c[j])", "-Factors(mass, c[i], c[j])", "inertia_tensor_xy"),
    ("moved_to", INERTIA, "Factors(mass, c[i], c[j])", "Factors(mass, c[i], c[i])", "inertia_tensor_xy"),
    ("moved_to", INERTIA, "name, key, pair) for pair in PAIRS}\n    return", "name, key, (0, 0)) for pair in PAIRS}\n    return", "x"),
    # rotation
    ("spin", ROTATION, "w / Norm(d), d)", "w, d)", "spin"),
    ("spin", ROTATION, "w / Norm(d), d)", "-w / Norm(d), d)", "spin"),
    ("spin", ROTATION, "w / Norm(d), d)", "2 * w / Norm(d), d)", "spin"),
    ("spin", ROTATION, "scaled(w / Norm(d), d)", "scaled(w, column(0, 0, 1))", "spin"),
    ("spin", ROTATION, "Ratio(rate, tidied(Norm(along.value)))", "Ratio(rate, 2)", "spin"),
    ("kinetic_energy", ROTATION, "Factors(Rational(1, 2), Dot(w, ", "Factors(Rational(1, 3), Dot(w, ", "kinetic_energy"),
    ("kinetic_energy", ROTATION, "Dot(w, applied(tensor, w))", "Dot(w, w)", "kinetic_energy"),
    ("kinetic_energy", ROTATION, "Dot(omega.value, product)", "Dot(omega.value, omega.value)", "kinetic_energy"),
    ("angular_momentum", ROTATION, "\n        applied,", "\n        lambda t, w: scaled(-1, applied(t, w)),", "angular_momentum"),
    ("angular_momentum", ROTATION, "\n        applied,", "\n        lambda t, w: applied(t, applied(t, w)),", "angular_momentum"),
    ("angular_momentum", ROTATION, "\n        applied,", "\n        lambda t, w: w,", "angular_momentum"),
    ("cosine_between", ROTATION, "Ratio(Dot(u, v), Factors(Norm(u), Norm(v)))", "Ratio(Dot(u, v), Norm(u) ** 2)", "cosine"),
    ("cosine_between", ROTATION, "Ratio(Dot(u, v), Factors", "Ratio(-Dot(u, v), Factors", "cosine"),
    ("cosine_between", ROTATION, "Ratio(Dot(u, v), Factors", "Ratio(Norm(Cross(u, v)), Factors", "cosine"),
    ("cosine_between", ROTATION, "Factors(*lengths)), \"lengths\"", "Factors(*lengths[:1])), \"lengths\"", "cosine"),
    ("angle_between", ROTATION, "acos(cosine.value)", "acos(-cosine.value)", "angle_between"),
    ("angle_between", ROTATION, "acos(cosine.value)", "2 * acos(cosine.value)", "angle_between"),
    ("angle_between", ROTATION, "acos(cosine.value)", "acos(cosine.value) - pi / 2", "angle_between"),
    ("torque", ROTATION, "\n        Cross,\n        {", "\n        lambda w, L: Cross(L, w),\n        {", "torque"),
    ("torque", ROTATION, "\n        Cross,\n        {", "\n        lambda w, L: Cross(w, w),\n        {", "torque"),
    ("torque", ROTATION, "tidied(f * g), Cross(u, v)", "tidied(f * f), Cross(u, v)", "torque"),
    ("torque", ROTATION, "CarriedRate(momentum.symbol, omega.symbol)", "CarriedRate(omega.symbol, momentum.symbol)", "torque"),
    # plain algebra
    ("at", EQUATIONS, "name: Group(v) for name", "name: Group(2 * v) for name", "energy_about_axis"),
    ("at", EQUATIONS, "zip(names, vector, strict", "zip(names[::-1], vector, strict", "energy_about_axis"),
    ("at", EQUATIONS, "*([outside] if outside != 1 else []), ", "", "energy_about_axis"),
    ("magnitude", EQUATIONS, "lambda v: Root(Dot(v, v))", "lambda v: Dot(v, v)", "magnitude"),
    ("magnitude", EQUATIONS, "lambda v: Root(Dot(v, v))", "lambda v: -Root(Dot(v, v))", "magnitude"),
    ("magnitude", EQUATIONS, "squares = [entry**2 for", "squares = [entry for", "magnitude"),
    ("magnitude", EQUATIONS, "Factors(size, Root", "Factors(size**2, Root", "magnitude"),
    # numbers
    ("value_of", NUMBERS, "lambda: substituted,", "lambda: substituted**2,", "magnitude_value"),
    ("value_of", NUMBERS, "amounts[letter] for letter in letters}", "amounts[letter].args[0] for letter in letters}", "magnitude_value"),
    ("value_of", NUMBERS, "rounded_form(exact / factor, figures)", "rounded_form(exact, figures)", "angle_between_value"),
    ("value_of", NUMBERS, "rounded_form(exact / factor, figures)", "rounded_form(exact / factor * 1001 / 1000, figures)", "magnitude_value"),
    ("coefficient_of", NUMBERS, "lambda: answer.value,", "lambda: 2 * answer.value,", "magnitude_value"),
    ("coefficient_of", NUMBERS, "rounded_form(number, figures), letters", "rounded_form(2 * number, figures), letters", "magnitude_value"),
    ("coefficient_of", NUMBERS, "rounded_form(number, figures), letters", "rounded_form(number, 2).doit(), letters", "magnitude_value"),
]

# verb, module, a piece of its second route, what is put there, the step that must refuse
ROUTES = [
    ("density", BODIES, "(body.integral(rho, body", "(body.integral(2 * rho, body", "density"),
    ("centre_of_mass", BODIES, "total + mass * place", "total + 2 * mass * place", "centre_of_mass"),
    ("inertia_tensor", BODIES, "side / (2 * sqrt(3)), side / 2 +", "side / (2 * sqrt(2)), side / 2 +", "centre_of_mass"),
    ("inertia_tensor", INERTIA, "arm = explicit(Cross(n, place - point.position))", "arm = n", "corner_tensor_xx"),
    ("inertia_tensor", INERTIA, "return explicit(Dot(n, tensor * n)), ", "return explicit(Dot(n, n)), ", "corner_tensor"),
    ("moved_to", INERTIA, "body.integral(weight, body.middle", "body.integral(weight, body.corner", "inertia_tensor_xx"),
    ("spin", ROTATION, "(length_by_turning(omega), size)", "(length_by_turning(omega), size + 1)", "spin"),
    ("spin", ROTATION, "rate * tidied(Norm(along.value)))", "2 * rate * tidied(Norm(along.value)))", "spin"),
    ("kinetic_energy", ROTATION, "Cross(omega.value, r))) / 2", "Cross(omega.value, r)))", "kinetic_energy"),
    ("angular_momentum", ROTATION, "Cross(r, Cross(omega.value, r))", "Cross(r, Cross(r, omega.value))", "angular_momentum"),
    ("cosine_between", ROTATION, "beside[1] ** 2 - opposite**2", "beside[1] ** 2 + opposite**2", "cosine"),
    ("cosine_between", ROTATION, "length_by_turning(u - v)", "length_by_turning(u + v)", "cosine"),
    ("angle_between", ROTATION, "cos(theta) * across", "cos(theta) * along", "angle_between"),
    ("torque", ROTATION, "CarriedRate(momentum.value, omega.value)", "CarriedRate(omega.value, momentum.value)", "torque"),
    ("at", EQUATIONS, "particular.symbol: particular.value", "particular.symbol: 2 * particular.value", "energy_about_axis"),
    ("magnitude", EQUATIONS, "length_by_turning(of.value)", "length_by_turning(2 * of.value)", "magnitude"),
    ("value_of", NUMBERS, "max(errors) < 1e-12", "max(errors) < -1", "magnitude_value"),
]

DEFINITIONS = {"any_angular_velocity", "let"}


def everything(verbs: SimpleNamespace) -> None:
    """The block about its diagonal, and the numbers of its answers."""
    found = block_derivation(verbs)
    verbs.coefficient_of(found["magnitude"], 4)
    verbs.value_of(found["magnitude"], amounts(), "N m", Integer(1), 4)
    verbs.value_of(found["angle_between"], {}, "degree", pi / 180, 4)


@pytest.mark.parametrize(("verb", "module", "old", "new", "key"), LAWS)
def test_a_wrong_law_is_refused_at_its_step(verb: str, module: str, old: str, new: str, key: str) -> None:
    assert refusing_step(module, old, new) == key


@pytest.mark.parametrize(("verb", "module", "old", "new", "key"), ROUTES)
def test_a_wrong_second_route_is_refused_at_its_step(verb: str, module: str, old: str, new: str, key: str) -> None:
    assert refusing_step(module, old, new) == key


def refusing_step(module: str, old: str, new: str) -> str | None:
    """The step that refuses when one piece of the source is replaced, if one does."""
    with altered(module, old, new) as verbs:
        try:
            everything(verbs)
        except Unverified as refusal:
            return refusal.complaints[0].message.split("`")[1]
    return None
