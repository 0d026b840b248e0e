"""The components of a centre of mass that do not vanish."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Integer, pi, symbols

import derive.mechanics.bodies.components as components
from derive.algebra.equality import equal
from derive.errors import Rejected, Unverified
from derive.mechanics import Cone, HalfDisc, HemisphericalShell, Plate, Triangle, centre_component, centre_of_mass
from derive.steps.derivation import with_ancestors

R, a, b, M = symbols("R a b M", positive=True)
ZERO = Integer(0)


@pytest.mark.parametrize(
    ("body", "found"),
    [
        (HalfDisc(R, M), {"y": 4 * R / (3 * pi)}),
        (HemisphericalShell(R, M), {"z": R / 2}),
        (Triangle(((ZERO, ZERO), (a, ZERO), (ZERO, b)), M), {"x": a / 3, "y": b / 3}),
        (Plate((a, b), M), {}),
    ],
)
def test_each_that_does_not_vanish_is_an_integral(body: Any, found: dict[str, Any]) -> None:
    """Fowles, section 8.1; a plate, which is its own image about its middle, needs none."""
    steps = with_ancestors((centre_of_mass(body),))
    names = {key.rpartition("_")[2]: step for key, step in steps.items() if key.startswith("centre_of_mass_")}
    assert set(names) == set(found)
    assert all(equal(names[axis].value, value) for axis, value in found.items())


def test_a_triangle_with_equal_sides_is_no_image_of_itself() -> None:
    assert centre_of_mass(Triangle(((ZERO, ZERO), (a, ZERO), (ZERO, a)), M)).step.outcome == "by_components"


def test_a_wrong_density_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(components, "Ratio", lambda above, below: 2 * above / below)
    with pytest.raises(Unverified):
        centre_of_mass(HalfDisc(R, M))


def test_one_component_alone() -> None:
    assert equal(centre_component(Cone(R, a, M), "z", origin="base").value, a / 4)
    with pytest.raises(Rejected, match="along"):
        centre_component(HalfDisc(R, M), "w")
