"""Bodies of a description: every shape of the engine, position maps, parts; and what cannot be meant."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path
from typing import Any

import pytest
from sympy import Rational, symbols

from derive.algebra.equality import equal
from derive.mechanics.bodies.body import Body
from derive.stock.keys.bodies import OTHER_NAMES, SIZES, DescribedBody, ShapeKeys, shapes, ways_to_tell
from tests.stock.bodies import CONE, CONE_IS
from tests.stock.described import complaints, edited, loaded, messages, solved

R, h, M, m = symbols("R h M m", positive=True)

WAYS = {
    "annulus": "inner: R, outer: 2*R",
    "arc": "radius: R, half_angle: pi/2",
    "ball": "radius: R",
    "cone": "radius: R, height: h",
    "conical_shell": "radius: R, height: h",
    "cuboid": "sides: [R, R, h]",
    "cylinder": "radius: R, height: h",
    "cylindrical_shell": "radius: R, height: h",
    "disc": "radius: R",
    "ellipsoid": "semi_axes: [R, R, h]",
    "half_cylinder": "radius: R, height: h",
    "half_disc": "radius: R",
    "hemisphere": "radius: R",
    "hemispherical_shell": "radius: R",
    "hoop": "radius: R",
    "plate": "sides: [R, h]",
    "rod": "length: h",
    "spherical_shell": "radius: R",
    "tetrahedron": "corners: [[0, 0, 0], [R, 0, 0], [0, R, 0], [0, 0, h]]",
    "thick_shell": "inner: R, outer: 2*R",
    "torus": "radius: 2*R, section: R",
    "triangle": "base: R, height: h",
    "tube": "inner: R, outer: 2*R, height: h",
    "wedge": "corners: [[0, 0], [R, 0], [0, R]], length: h",
}


def described(folder: Path, body: str) -> DescribedBody:
    problem: Any = loaded(folder, edited(CONE, (CONE_IS, body), ("  about: apex\n", "")))
    found: DescribedBody = problem.described.bodies[0].described
    return found


def faults(folder: Path, body: str) -> list[str]:
    return messages(folder, edited(CONE, (CONE_IS, body), ("  about: apex\n", "")))


def test_every_shape_of_the_engine_can_be_told() -> None:
    assert set(shapes()) == {*WAYS, "particle"}
    assert set(OTHER_NAMES.values()) <= set(shapes())
    assert {size for shape in shapes().values() for way in ways_to_tell(shape) for size in way} == set(SIZES)
    assert {f.name for f in fields(ShapeKeys) if f.metadata} - set(SIZES) == {
        "shape", "mass", "position", "limits", "density",
    }  # fmt: skip


@pytest.mark.parametrize("name", sorted(WAYS))
def test_a_shape_is_the_body_of_that_name(name: str, tmp_path: Path) -> None:
    found = described(tmp_path, f"{{shape: {name}, {WAYS[name]}, mass: M}}").body()
    assert type(found) is shapes()[name]
    assert found.mass == M


@pytest.mark.parametrize(
    ("told", "area"),
    [("side: R", Rational(1, 4) * 3 ** Rational(1, 2) * R**2), ("base: R, height: h, foot: R", R * h / 2)],
)
def test_a_triangle_has_other_ways(told: str, area: Any, tmp_path: Path) -> None:
    found: Body = described(tmp_path, f"{{shape: triangle, {told}, mass: M}}").body()
    assert equal(found.size, area)


def test_a_point_of_a_body_may_have_a_name(tmp_path: Path) -> None:
    """A disc that hangs from a point of its rim: I + M R^2."""
    hung = "{shape: disc, radius: R, mass: M, points: {pivot: [R, 0, 0]}}"
    text = edited(
        CONE,
        (CONE_IS, hung),
        ("about: apex", "about: pivot"),
        ("answer: inertia_tensor", "answer: moment_of_inertia_z"),
    )
    assert equal(solved(tmp_path, text)["moment_of_inertia_z"].value, Rational(3, 2) * M * R**2)


def test_parts_lie_where_they_are_told(tmp_path: Path) -> None:
    """A rod along x from the origin, a particle at its far end: (M/3 + m) h^2."""
    whole = (
        "{parts: {rod: {shape: rod, length: h, mass: M, of: end, at: [0, 0, 0], turned: {y: pi/2}},"
        " bead: {shape: particle, mass: m, at: [h, 0, 0]}}, points: {pivot: [0, 0, 0]}}"
    )
    text = edited(
        CONE, (CONE_IS, whole), ("about: apex", "about: pivot"), ("answer: inertia_tensor", "answer: inertia_tensor_zz")
    )
    assert equal(solved(tmp_path, text)["inertia_tensor_zz"].value, (M / 3 + m) * h**2)


def test_what_is_cut_out_has_its_share_of_the_mass(tmp_path: Path) -> None:
    whole = "{mass: M, parts: {disc: {shape: disc, radius: R}, hole: {shape: disc, radius: R/2, cut_out: true}}}"
    text = edited(
        CONE, (CONE_IS, whole), ("  about: apex\n", ""), ("answer: inertia_tensor", "answer: inertia_tensor_zz")
    )
    assert equal(solved(tmp_path, text)["inertia_tensor_zz"].value, Rational(5, 8) * M * R**2)


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("{shape: block, sides: [R, R, R], mass: M}", "5: `block` is not a known shape"),
        ("{shape: cone, radius: R, mass: M}", "5: a cone needs `height`"),
        ("{shape: disc, radius: R, height: h, mass: M}", "5: a disc has no `height`"),
        ("{shape: cone, radius: R, height: h}", "5: a cone needs `mass`"),
        ("{shape: cone, radius: R, height: M, mass: M}", "5: `height` must be a length, but `M` is a mass"),
        ("{shape: cone, radius: -R, height: h, mass: M}", "5: `radius` must be positive, but `-R` is not"),
        ("{shape: cone, radius: R, height: 3, mass: M}", "5: `height` must be a length, but `3` is a number"),
        (
            "{shape: disc, radius: R, mass: M, density: M/R**2}",
            "5: a disc is a uniform body of fixed shape, so the key `density` is not allowed",
        ),
        ("{shape: plate, sides: [R, R, R], mass: M}", "5: a plate needs 2 lengths as `sides`, not 3"),
        (
            "{shape: triangle, corners: [[0, 0], [R, 0]], mass: M}",
            "5: a triangle needs 3 corners with 2 components each",
        ),
        (
            "{shape: triangle, corners: [[0, 0], [R, 0], [h, 0]], mass: M}",
            "5: the three corners of this triangle are on one line",
        ),
        (
            "{shape: tube, inner: R, outer: R, height: h, mass: M}",
            "5: a tube needs an outer radius that is greater than its inner radius",
        ),
        ("{mass: M}", "5: a body needs `shape` or `position` or `parts`"),
        ("{mass: M, parts: {}}", "5: a body needs `shape` or `position` or `parts`"),
        (
            "{shape: disc, radius: R, mass: M, position: [R, 0]}",
            "5: a body needs either `shape` or `position`, not both",
        ),
        (
            "{position: [x, 0], limits: {x: [h, 0]}, mass: M}",
            "5: the limits of `x` are h and 0, but the first must be less than the second",
        ),
        ("{position: [x, 0], limits: {x: [0, M]}, mass: M}", "5: `a limit of x` must be a length, but `M` is a mass"),
        (
            "{position: [R, 0], limits: {x: [0, h]}, mass: M}",
            "5: the position of this `Wire` does not vary independently with each of its variables",
        ),
        ("{position: [x, 0], mass: M}", "5: `position` needs one, two or three symbols with limits, not 0"),
        ("{position: [x, 0], limits: {x: [0, h]}}", "5: a body specified by `position` needs `mass` or `density`"),
        (
            "{position: [R, 0], limits: {R: [0, h]}, mass: M}",
            "5: `R` is declared under `symbols`, but is also a variable of this body",
        ),
        (
            "{position: [x, 0], limits: {x: [0, h]}, mass: M, radius: R}",
            "5: a body specified by `position` has no `radius`",
        ),
        (
            "{position: [x, 0], limits: {x: [0, h]}, density: M}",
            "5: `density` must be a line density, but `M` is a mass",
        ),
        ("{parts: {rod: {shape: rod, length: h, mass: M, at: [0, 0, 0], of: ned}}}", "5: a rod has no point `ned`"),
        (
            "{parts: {rod: {shape: rod, length: h, mass: M, of: end}}}",
            "5: `rod` has `of`, so it needs `at`, the position of that point",
        ),
        (
            "{parts: {rod: {shape: rod, length: h, mass: M, turned: {w: pi}}}}",
            '5: a rotation must be about "x", "y" or "z"',
        ),
        (
            "{mass: M, parts: {rod: {shape: rod, length: h, mass: M}}}",
            "5: the mass of the whole body is divided among its parts, so `mass` of `rod` is not allowed",
        ),
        ("{parts: {Rod: {shape: rod, length: h, mass: M}}}", "5: `Rod` is not a valid name for a body"),
        (
            "{radius: R, parts: {rod: {shape: rod, length: h, mass: M}}}",
            "5: a body made of parts has no `radius` of its own",
        ),
        (
            "{shape: disc, radius: R, mass: M, points: {centre: [0, 0, 0]}}",
            "5: a body with `points` already has a point `centre`",
        ),
    ],
)
def test_a_fault_is_told_at_its_place(body: str, said: str, tmp_path: Path) -> None:
    assert faults(tmp_path, body)[0] == said


def test_all_faults_are_told_at_once(tmp_path: Path) -> None:
    assert len(faults(tmp_path, "{shape: cone, radius: M, height: h*M, mass: R, base: h}")) == 4
    assert len(faults(tmp_path, "{parts: {rod: {shape: rod, mass: h}, disc: {shape: disc, radius: M, mass: M}}}")) == 3


def test_what_was_meant_is_told(tmp_path: Path) -> None:
    def help_for(shape: str) -> str | None:
        text = edited(CONE, (CONE_IS, f"{{shape: {shape}, radius: R, mass: M}}"), ("  about: apex\n", ""))
        help_line: str | None = complaints(tmp_path, text)[0].help
        return help_line

    assert help_for("sphere") == "write `ball`"
    assert help_for("dics") == "did you mean `disc`?"
