"""Moments of inertia of any body that is told by its position map, by integration over its cells."""

from __future__ import annotations

from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Integer, Symbol

from derive.algebra.expressions import Factors, scalar, tensor
from derive.algebra.tidy import tidied
from derive.mechanics.bodies.facts import AboutPoint, OfBody
from derive.mechanics.bodies.integration import worked_integral
from derive.mechanics.bodies.quadrature import agrees, squared_distance
from derive.mechanics.bodies.regions import Point, Region
from derive.steps.establish import Lines, Scope, Telling, establish
from derive.steps.step import Form, Level, Quantity, entry_name
from derive.steps.subject import Subject

__all__: list[str] = []

PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


class Integrated:
    """What finds the moments of a body by integrals over its cells."""

    def derived_tensor(self, point: Point, symbol: str, key: str) -> Quantity:
        return _tensor_by_integration(self, point, symbol, key)

    def derived_moment(self, axis: str, point: Point, symbol: str, key: str) -> Quantity:
        return _moment_by_integration(self, axis, point, symbol, key)


def _tensor_by_integration(body: Any, point: Point, symbol: str, key: str) -> Quantity:
    """Inertia tensor of any body about a point, its entries rho integral of (r.r delta_ij - x_i x_j) dV, step by step.

    body    a body told by its position map
    point   the point, and the axes
    Second route: the sum over cells in numbers, their sizes by the scalar products of their edges.
    Outcomes: isotropic, two_equal, diagonal, generic.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3.
    """
    region = body.region(point)
    entries = {pair: _entry(body, point, region, symbol, key, pair) for pair in PAIRS}
    position, limits = body.map()
    share = tidied(body.mass / body.size) * body.profile
    place = point.seen(position)
    weights = [share * squared_distance(place, i, j) for i in range(3) for j in range(3)]

    def assembled(*found: Any) -> Any:
        at = dict(zip(PAIRS, found, strict=True))
        return ImmutableDenseMatrix(3, 3, lambda i, j: at[(min(i, j), max(i, j))])

    return establish(
        "general.inertia_tensor",
        tensor(symbol),
        assembled,
        {"xyz"[i] + "xyz"[j]: entry for (i, j), entry in entries.items()},
        key=key,
        kind="moment of inertia",
        routes={"quadrature": lambda found: agrees(found, weights, position, limits)},
        outcome=shape_of,
        lines=Lines(put_in=None),
        facts=[OfBody(body), AboutPoint(point)],
        telling=Telling(words={"about": point.name}),
        scope=Scope(about=Subject(body=body, point=point)),
    )


def shape_of(found: Any) -> str:
    """What one sees of a tensor: whether it is diagonal, and how many moments are equal."""
    if not found.is_diagonal():
        return "generic"
    return {1: "isotropic", 2: "two_equal"}.get(len({found[i, i] for i in range(3)}), "diagonal")


def _moment_by_integration(body: Any, axis: str, point: Point, symbol: str, key: str) -> Quantity:
    """Moment of inertia about one axis through a point, rho integral of the squared distance from it dV.

    body    a body told by its position map
    axis    "x", "y" or "z"
    point   through which it goes
    Second route: the sum over cells in numbers, their sizes by the scalar products of their edges.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, section 7.3.
    """
    i = "xyz".index(axis)
    region = body.region(point)
    weight, lines = _worked(body, region, (i, i))
    return establish(
        "general.moment_of_inertia",
        scalar(symbol),
        lambda: _integrated(body, region, weight),
        {},
        key=key,
        kind="moment of inertia",
        parents=[body.density],
        routes={"quadrature": lambda found: _summed(body, point, (i, i), found)},
        lines=lines,
        telling=Telling(words={"about": point.name, "axis": axis}),
        scope=Scope(about=Subject(body=body, mass=body.mass, point=point, axis=axis)),
    )


def _entry(body: Any, point: Point, region: Region, name: str, key: str, pair: tuple[int, int]) -> Quantity:
    """One entry, a moment or a product of inertia with its minus sign."""
    i, j = pair
    weight, lines = _worked(body, region, pair)
    return establish(
        "general.entry",
        entry_name(name, i, j),
        lambda: _integrated(body, region, weight),
        {},
        key=f"{key}_{'xyz'[i]}{'xyz'[j]}",
        kind="moment of inertia",
        parents=[body.density],
        routes={"quadrature": lambda found: _summed(body, point, pair, found)},
        outcome="moment" if i == j else "product",
        lines=lines,
        telling=Telling(words={"about": point.name}),
        scope=Scope(about=Subject(body=body, point=point, axis=f"{'xyz'[i]}{'xyz'[j]}")),
    )


def _front(body: Any) -> Expr:
    """The letter of a uniform density that was found, else what stands before the integral."""
    if body.given_mass is not None and body.is_uniform:
        letter: Symbol = body.density.symbol
        return letter
    front: Expr = body.front
    return front


def _integrated(body: Any, region: Region, weight: Expr) -> Expr:
    front = _front(body)
    if weight == 0:
        return Integer(0)
    if weight.could_extract_minus_sign():
        return Factors(-front, region.integral(-weight))
    return Factors(front, region.integral(weight))


def _worked(body: Any, region: Region, pair: tuple[int, int]) -> tuple[Expr, Lines]:
    """The weight of each cell, and the lines to its integral: then by the mass, where that was found from a density."""
    weight = tidied(squared_distance(region.position, *pair))
    if weight == 0:
        return weight, Lines(put_in=None)
    between = worked_integral(region, weight, _front(body), body.size)
    if body.given_mass is not None:
        return weight, Lines(between=between, put_in=None)
    between = [form for form in between if form.because != "mass_collected"]
    value = tidied(region.integral(weight) / body.size)
    by_mass = [Form(tidied(body.density.symbol * value), "by_mass", Level.BRIEF)] if value != 0 else []
    return weight, Lines(between=between, put_in=None, after=by_mass)


def _summed(body: Any, point: Point, pair: tuple[int, int], found: Any) -> Any:
    position, limits = body.map()
    share = body.mass / body.size * body.profile
    return agrees(found, [share * squared_distance(point.seen(position), *pair)], position, limits)
