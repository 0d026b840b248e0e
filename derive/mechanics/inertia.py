"""The inertia tensor: by integration about a point, and moved from point to point.

I_ij = integral of (r.r delta_ij - r_i r_j) dm, in kg m^2, a symmetric (3, 3) tensor in the body's axes.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sympy import Expr, Identity, ImmutableDenseMatrix, Integer, MatAdd, MatrixSymbol

from derive.errors import Complaint, Rejected
from derive.expressions import (
    Cross,
    Dot,
    Factors,
    Outer,
    Terms,
    column,
    component_names,
    explicit,
    scaled,
    tensor,
    vector,
)
from derive.mechanics.bodies import Cuboid, Point
from derive.mechanics.integration import worked_integral
from derive.step import Level, Quantity, compared_with, entry_name, establish

PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))  # moments of inertia, then products


def inertia_tensor(body: Cuboid, about: str = "centre", symbol: str | None = None, key: str | None = None) -> Quantity:
    """Inertia tensor about a point, J = integral of (r.r 1 - r r) dm.

    body    mass M, uniform density
    about   "corner" or "centre"; axes along the edges
    Each of the six entries is a step of its own.
    Second route: the moment about any axis n is the sum of m |n x r|^2 over the body's equimomental particles, whose
    centre of mass is the body's.
    Outcomes: isotropic (the same about every axis), two_equal (diagonal, two moments equal), diagonal, generic.
    Errors: no such point.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3.
    """
    point = body.point(about)
    name = symbol or ("I" if about == "centre" else "J")
    key = key or "inertia_tensor"
    by_definition = _definition(body, point, name, key)
    entries = {pair: _entry_by_integration(body, point, name, key, pair, by_definition) for pair in PAIRS}
    return establish(
        "inertia.inertia_tensor",
        tensor(name),
        lambda *six: _symmetric(six),
        _by_pair(entries),
        routes={
            "definition": compared_with(lambda: by_definition.value),
            "particles": lambda tensor: _moment_about_any_axis(tensor, body, point),
            "balanced": lambda _: (_first_moment(body, point), body.mass * (body.middle.position - point.position)),
        },
        outcome=_shape,
        kind="moment of inertia",
        put_in=None,
        context={"body": body, "about": point},
        words={"about": point.name},
        key=key,
    )


def _definition(body: Cuboid, point: Point, name: str, key: str) -> Quantity:
    """J = integral of (r.r 1 - r r) dm, r from the point: what the symbol means."""
    return establish(
        "inertia.definition",
        tensor(name),
        lambda _: _law(body, point, body.density.symbol),
        {"r": vector("r")},
        definition=True,
        kind="moment of inertia",
        parents=[body.density],
        put_in=None,
        show_result=False,
        words={"about": point.name},
        key=f"{key}_definition",
    )


def _law(body: Cuboid, point: Point, density: Expr) -> Any:
    """The integral of (r.r 1 - r r) dm, not carried out."""
    r = vector("r")
    integrand = MatAdd(scaled(Dot(r, r), Identity(3)), scaled(Integer(-1), Outer(r, r)))
    return body.mass_integral(integrand, point.position, density)


def _as_defined(body: Cuboid, point: Point) -> Any:
    return explicit(_law(body, point, body.density.value))


def _by_pair(entries: dict[tuple[int, int], Quantity]) -> dict[str, Quantity]:
    return {"xyz"[i] + "xyz"[j]: quantity for (i, j), quantity in entries.items()}


def _symmetric(six: Any) -> Any:
    at = dict(zip(PAIRS, six, strict=True))
    return ImmutableDenseMatrix(3, 3, lambda i, j: at[(min(i, j), max(i, j))])


def _shape(tensor: Any) -> str:
    if not tensor.is_diagonal():
        return "generic"
    different = len({tensor[i, i] for i in range(3)})
    return {1: "isotropic", 2: "two_equal"}.get(different, "diagonal")


def _entry_outcome(pair: tuple[int, int]) -> str:
    """The first moment and the first product are introduced; the others follow on."""
    kind = "moment" if pair[0] == pair[1] else "product"
    return f"first_{kind}" if pair in ((0, 0), (0, 1)) else kind


def _entry_by_integration(
    body: Cuboid, point: Point, name: str, key: str, pair: tuple[int, int], definition: Quantity
) -> Quantity:
    """One entry, J_xx = rho integral of (y^2 + z^2) dV or J_xy = -rho integral of x y dV."""
    i, j = pair
    at = [limit[0] for limit in body.limits(point.position)]
    weight = sum((x**2 for k, x in enumerate(at) if k != i), Integer(0)) if i == j else -at[i] * at[j]
    integral = body.integral(weight, point.position)
    rho = body.density
    law = _with_sign_in_front(integral)
    return establish(
        "inertia.entry",
        entry_name(name, i, j),
        law,
        {"density": rho},
        between=worked_integral(integral, rho.symbol, body.volume),
        routes={"particles": compared_with(lambda: _entry_from_particles(body, point, pair))},
        outcome=_entry_outcome(pair),
        kind="moment of inertia",
        put_in=None,
        key=f"{key}_{'xyz'[i]}{'xyz'[j]}",
        words={"about": point.name},
        parents=[definition],
    )


def _with_sign_in_front(integral: Any) -> Callable[[Expr], Expr]:
    function = integral.function
    if function.could_extract_minus_sign():
        return lambda rho: Factors(-rho, integral.func(-function, *integral.limits))
    return lambda rho: Factors(rho, integral)


def _moment_from_particles(body: Cuboid, point: Point, n: Any) -> Expr:
    """The moment of inertia about the axis through the point along n: mass times distance squared, summed."""
    total: Expr = Integer(0)
    for mass, place in body.particles():
        arm = explicit(Cross(n, place - point.position))
        total += mass * explicit(Dot(arm, arm))
    return total


def _first_moment(body: Cuboid, point: Point) -> Any:
    """The sum of m r over the particles, r from the point: M times where the centre of mass is seen from there."""
    total = column(0, 0, 0)
    for mass, place in body.particles():
        total = total + mass * (place - point.position)
    return total


def _entry_from_particles(body: Cuboid, point: Point, pair: tuple[int, int]) -> Expr:
    """n.I n at n = e_i + e_j less the two moments is twice the entry I_ij."""
    axes = [column(*(int(k == axis) for k in range(3))) for axis in pair]
    if pair[0] == pair[1]:
        return _moment_from_particles(body, point, axes[0])
    both, *alone = (_moment_from_particles(body, point, n) for n in (axes[0] + axes[1], *axes))
    return (both - sum(alone)) / 2


def _moment_about_any_axis(tensor: Any, body: Cuboid, point: Point) -> tuple[Expr, Expr]:
    n = column(*component_names("n"))
    return explicit(Dot(n, tensor * n)), _moment_from_particles(body, point, n)


def moved_to(tensor_there: Quantity, centre: Quantity, symbol: str = "I", key: str = "inertia_tensor") -> Quantity:
    """Inertia tensor about the centre of mass, I = J - M (c.c 1 - c c), from J about another point of the body.

    tensor_there    tensor (3, 3), kg m^2, about a point of the body
    centre          vector (3), m: the body's centre of mass in its axes
    Second route: each entry, and the tensor as a whole, by direct integration about the centre; the trace as twice the
    integral of r.r dm.
    Outcomes: as `inertia_tensor`.
    Errors: the tensor is already about the centre of mass.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3 (parallel axes).
    """
    body: Cuboid = tensor_there.context["body"]
    start: Point = tensor_there.context["about"]
    if start.position == body.middle.position:
        message = f"`{tensor_there.key}` is already about the centre of mass"
        raise Rejected(Complaint("already-there", message, help="start from another point, or use the tensor as it is"))
    entries = {pair: _entry_moved(tensor_there, centre, symbol, key, pair) for pair in PAIRS}
    return establish(
        "inertia.moved_to",
        tensor(symbol),
        lambda *six: _symmetric(six),
        _by_pair(entries),
        routes={
            "integration": compared_with(lambda: _as_defined(body, body.middle)),
            "trace": lambda result: (result.trace(), 2 * _square_of_distance(body, body.middle)),
        },
        outcome=_shape,
        kind="moment of inertia",
        parents=[body.density],
        put_in=None,
        context={"body": body, "about": body.middle},
        words={"about": "centre", "start": start.name},
        key=key,
    )


def _square_of_distance(body: Cuboid, point: Point) -> Expr:
    """The integral of r.r dm about a point."""
    at = [limit[0] for limit in body.limits(point.position)]
    return body.density.value * explicit(body.integral(sum(x**2 for x in at), point.position))


def _components(v: Any) -> tuple[Any, ...]:
    return component_names(v.name) if isinstance(v, MatrixSymbol) else tuple(v)


def _entry_moved(there: Quantity, centre: Quantity, name: str, key: str, pair: tuple[int, int]) -> Quantity:
    """One entry by parallel axes, I_xx = J_xx - M (y^2 + z^2) or I_xy = J_xy + M x y, at r_C = (x, y, z)."""
    i, j = pair
    body: Cuboid = there.context["body"]
    entry = next(parent for parent in there.parents if parent.key.endswith(f"_{'xyz'[i]}{'xyz'[j]}"))

    def law(at_start: Expr, mass: Expr, c: Any) -> Expr:
        c = _components(c)
        if i == j:
            return Terms(at_start, -Factors(mass, Terms(*(c[k] ** 2 for k in range(3) if k != i))))
        return Terms(at_start, Factors(mass, c[i], c[j]))

    def directly() -> Expr:
        at = [limit[0] for limit in body.limits(body.middle.position)]
        weight = sum((x**2 for x in at), Integer(0)) * int(i == j) - at[i] * at[j]
        return body.density.value * explicit(body.integral(weight, body.middle.position))

    return establish(
        "inertia.entry_moved",
        entry_name(name, i, j),
        law,
        {"entry": entry, "mass": body.mass, "centre": centre},
        routes={"integration": compared_with(directly)},
        outcome=_entry_outcome(pair),
        kind="moment of inertia",
        put_in=Level.STANDARD,
        parents=[there],
        words={"start": there.context["about"].name},
        key=f"{key}_{'xyz'[i]}{'xyz'[j]}",
    )
