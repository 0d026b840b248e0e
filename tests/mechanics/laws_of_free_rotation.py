"""Wrong laws of free rotation and of what is conserved: see `test_wrong_laws.py`."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

from sympy import symbols

Verbs = SimpleNamespace
FREE, CONSERVATION, EQUATIONS = "mechanics.free_rotation", "mechanics.conservation", "mechanics.equations"
ROTATION = "mechanics.rotation"
MOMENTS = symbols("I_x I_y I_z", positive=True)
TORQUE = symbols("N_x N_y N_z", real=True)


def momentum(verbs: Verbs) -> tuple[Any, Any, Any]:
    """Body, angular velocity and angular momentum."""
    body, omega = verbs.RigidBody(MOMENTS), verbs.changing_angular_velocity()
    return body, omega, verbs.angular_momentum(body.tensor, omega)


def equations(verbs: Verbs, *torque: Any) -> Any:
    _, omega, L = momentum(verbs)
    return verbs.euler_equations(verbs.rate_in_space(L, omega), *torque)


def seen_from_the_body(verbs: Verbs) -> Any:
    _, omega, L = momentum(verbs)
    return verbs.rate_in_body(L, omega, equations(verbs))


def seen_from_space(verbs: Verbs) -> Any:
    _, omega, L = momentum(verbs)
    return verbs.rate_in_space(L, omega, seen_from_the_body(verbs), key="in_space")


def rate_of_energy(verbs: Verbs) -> Any:
    body, omega, _ = momentum(verbs)
    return verbs.rate_under(verbs.kinetic_energy(body.tensor, omega), equations(verbs))


RUNS: dict[str, Callable[[Verbs], Any]] = {
    "rate_in_space": lambda verbs: verbs.rate_in_space(*momentum(verbs)[:0:-1]),
    "rate_in_space put together": seen_from_space,
    "euler_equations": equations,
    "euler_equations with a torque": lambda verbs: equations(verbs, TORQUE),
    "rate_in_body": seen_from_the_body,
    "rate_under": rate_of_energy,
    "squared_magnitude": lambda verbs: verbs.squared_magnitude(momentum(verbs)[2]),
}

_OWN_OR_SEEN = "BodyRate(momentum, *moving) if seen is None else seen, Cross(omega, momentum)"
_OWN = _OWN_OR_SEEN.partition(", Cross")[0]
LAWS: list[tuple[str, str, str, str, str]] = [
    ("rate_in_space", FREE, _OWN_OR_SEEN, f"{_OWN}, Cross(momentum, omega)", "momentum_rate"),
    ("rate_in_space", FREE, _OWN_OR_SEEN, f"{_OWN}, Cross(omega, omega)", "momentum_rate"),
    (
        "rate_in_space",
        FREE,
        "in_components, Cross(omega.value, ",
        "-in_components, Cross(omega.value, ",
        "momentum_rate",
    ),
    ("rate_in_space put together", FREE, _OWN_OR_SEEN, f"{_OWN}, seen or Cross(omega, momentum)", "in_space"),
    (
        "rate_in_space put together",
        FREE,
        "MatAdd(*parts, Cross(",
        "MatAdd(*parts, *parts, Cross(",
        "in_space",
    ),
    ("euler_equations", FREE, "Component(rate, AXES[i])", "Component(rate, AXES[i - 1])", "euler_x"),
    ("euler_equations", FREE, "Component(rate, AXES[i])", "-Component(rate, AXES[i])", "euler_x"),
    ("euler_equations with a torque", FREE, '"=", acting)', '"=", -acting)', "euler_x"),
    (
        "rate_in_body",
        FREE,
        "Integer(-1), Cross(omega, momentum)",
        "Integer(1), Cross(omega, momentum)",
        "momentum_rate_in_body",
    ),
    (
        "rate_in_body",
        FREE,
        "Integer(-1), Cross(omega, momentum)",
        "Integer(-1), Cross(omega, omega)",
        "momentum_rate_in_body",
    ),
    # a product or a sum that no motion obeys, and one that every motion obeys but that is not the rate of the energy
    ("rate_under", CONSERVATION, "Factors(f, written.left)", "Terms(f, written.left)", "kinetic_energy_euler_x"),
    ("rate_under", CONSERVATION, "Factors(f, written.left)", "Factors(f, f, written.left)", "kinetic_energy_rate"),
    (
        "rate_under",
        CONSERVATION,
        "Terms(*_added(sides[0]))",
        "Terms(quantity.value, *_added(sides[0]))",
        "kinetic_energy_sum",
    ),
    ("rate_under", CONSERVATION, "Terms(*_added(sides[0]))", "Terms(*_added(sides[0][1:]))", "kinetic_energy_rate"),
    (
        "rate_under",
        CONSERVATION,
        "lambda q: TimeRate(q, *moving)",
        "lambda q: TimeRate(q**2, *moving)",
        "kinetic_energy_rate",
    ),
    ("rate_under", CONSERVATION, "tidied(own_rate.expand())", "tidied(2 * own_rate.expand())", "kinetic_energy_rate"),
    ("rate_under", CONSERVATION, "matrix.LUsolve(-rest)", "matrix.LUsolve(rest)", "kinetic_energy_euler_x"),
    (
        "rate_under",
        CONSERVATION,
        "matrix.T.LUsolve(wanted)",
        "matrix.T.LUsolve(wanted[::-1, :])",
        "kinetic_energy_rate",
    ),
    ("squared_magnitude", EQUATIONS, "lambda v: Dot(v, v)", "lambda v: 2 * Dot(v, v)", "squared_magnitude"),
    ("squared_magnitude", EQUATIONS, "lambda v: Dot(v, v)", "lambda v: Norm(v)", "squared_magnitude"),
]
ROUTES: list[tuple[str, str, str, str, str]] = [
    ("rate_in_space", FREE, "Cross(n, w.value)", "Cross(w.value, n)", "momentum_rate"),
    ("rate_in_space", FREE, "CarriedRate(L.value, w.value, *moving)", "CarriedRate(L.value, w.value)", "momentum_rate"),
    ("rate_in_space", FREE, "/ 2 - moment)", "- moment)", "angular_momentum"),
    ("rate_in_space", ROTATION, "r)) + explicit(Cross(omega", "r)) - explicit(Cross(omega", "momentum_rate"),
    ("euler_equations with a torque", FREE, "())[i] - acting", "())[i] + acting", "euler_x"),
    ("euler_equations", FREE, "())[i] - acting", "())[i - 1] - acting", "euler_x"),
    ("rate_in_body", FREE, "*moving)), motion))}", "*moving)), {}))}", "momentum_rate_in_body"),
    (
        "rate_under",
        CONSERVATION,
        "lambda: bound(in_time, motion)",
        "lambda: in_time",
        "kinetic_energy_rate",
    ),
    ("rate_under", CONSERVATION, "in_time - taken_off", "in_time - 2 * taken_off", "kinetic_energy_rate"),
    (
        "rate_under",
        ROTATION,
        "Dot(Cross(omega.value, r), acceleration(r)))",
        "Dot(Cross(omega.value, r), r))",
        "kinetic_energy_rate",
    ),
    ("squared_magnitude", EQUATIONS, "turning(v) ** 2)", "turning(v) ** 3)", "squared_magnitude"),
]
