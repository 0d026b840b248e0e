"""The bodies of the book's tests that are round, and what can be derived of them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from sympy import symbols

from derive.steps.step import Quantity
from tests.mechanics.block import with_what_they_rest_on

R, h, M, a, m = symbols("R h M a m", positive=True)


def cone_derivation(verbs: SimpleNamespace, radius: Any = R, height: Any = h) -> dict[str, Quantity]:
    cone = verbs.Cone(radius, height, M)
    found = verbs.moved_to(verbs.inertia_tensor(cone, about="apex", key="apex_tensor"), cone.centre)
    from_base = verbs.inertia_tensor(cone, about="base", coordinates="cartesian", symbol="J'", key="base_tensor")
    centre = verbs.centre_of_mass(cone, origin="base", coordinates="cartesian", symbol="r'_C", key="centre_from_base")
    again = verbs.moved_to(from_base, centre, symbol="I'", key="tensor_from_base")
    moments = verbs.principal_moments(found)
    return with_what_they_rest_on([verbs.agreement(found, again), *verbs.principal_axes(moments)])


def top_derivation(verbs: SimpleNamespace) -> dict[str, Quantity]:
    """A disc of mass m and radius a in the middle of a rod of mass m/2 and length a, about the end of the rod."""
    disc, rod = verbs.Disc(a, m).at(0, 0, a / 2), verbs.Rod(a, m / 2).at(0, 0, a / 2)
    top = verbs.symbolic_body(verbs.Composite(disc, rod, points={"pivot": (0, 0, 0)}))
    return with_what_they_rest_on(list(top.values))


def skew_tensor(verbs: SimpleNamespace) -> Quantity:
    return verbs.inertia_tensor(verbs.Plate((2 * a, 3 * a), M), about="corner")  # type: ignore[no-any-return]
