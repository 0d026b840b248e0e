"""Bodies that are described in YAML alone: what parts ask of them."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import ImmutableDenseMatrix, Rational, cos, pi, sin, sqrt, symbols

from derive.algebra.equality import equal
from derive.building.solution import rendered
from tests.stock.bodies import CONE, CONE_IS
from tests.stock.described import complaints, course_with, edited, loaded, messages, solved

R, h, M, m = symbols("R h M m", positive=True)
alpha = symbols("alpha", real=True)


def diagonal(*entries: object) -> ImmutableDenseMatrix:
    return ImmutableDenseMatrix(3, 3, lambda i, j: entries[i] if i == j else 0)


def test_the_cone_about_its_apex(tmp_path: Path) -> None:
    """Landau, section 32."""
    across = Rational(3, 5) * M * (R**2 / 4 + h**2)
    found = solved(tmp_path, CONE)["inertia_tensor"]
    assert equal(found.value, diagonal(across, across, Rational(3, 10) * M * R**2))


@pytest.mark.parametrize(
    ("body", "answer", "key", "value"),
    [
        (CONE_IS, "centre_of_mass", "centre_of_mass", ImmutableDenseMatrix([0, 0, 3 * h / 4])),
        (CONE_IS, "density", "density", 3 * M / (pi * R**2 * h)),
        (CONE_IS, "volume", "volume", pi * R**2 * h / 3),
        (CONE_IS, "moment_of_inertia_z", "moment_of_inertia_z", Rational(3, 10) * M * R**2),
        (CONE_IS, "radius_of_gyration_z", "radius_of_gyration_z", sqrt(Rational(3, 10)) * R),
        (CONE_IS, "inertia_tensor_xy", "inertia_tensor_xy", 0),
        (CONE_IS, "inertia_tensor_zz", "inertia_tensor_zz", Rational(3, 10) * M * R**2),
        (CONE_IS, "parallel_axes", "parallel_axes_zz", Rational(3, 10) * M * R**2),
    ],
)
def test_what_parts_may_ask_of_a_cone(body: str, answer: str, key: str, value: object, tmp_path: Path) -> None:
    """Goldstein, section 5.3; the moments by hand from the density 3 M/(pi R^2 h)."""
    text = edited(CONE, (CONE_IS, body), ("answer: inertia_tensor", f"answer: {answer}"))
    assert equal(solved(tmp_path, text)[key].value, value)


def test_one_component_of_the_centre_of_mass(tmp_path: Path) -> None:
    """Goldstein, section 5.3: 3 h/4 from the apex, on the axis."""
    made = "about: apex\n  results: {part: {value: centre_of_mass_z/h}}"
    edits = ("about: apex", made), ("answer: inertia_tensor", "answer: [part, centre_of_mass_x]")
    found = solved(tmp_path, edited(CONE, *edits))
    assert equal(found["part"].value, Rational(3, 4))
    assert found["centre_of_mass_x"].value == 0


def test_a_hemisphere_that_is_denser_above(tmp_path: Path) -> None:
    """By hand, with rho = k z/R: M = pi k R^3/4, z_C = 8 R/15, and I_z = M R^2/3; the mass is called by its letter."""
    body = (
        "{position: [r*sin(theta)*cos(phi), r*sin(theta)*sin(phi), r*cos(theta)], density: 3*m*r*cos(theta)/(R*h**3), "
        "limits: {r: [0, R], theta: [0, pi/2], phi: [0, 2*pi]}}"
    )
    asks = "[centre_of_mass, radius_of_gyration_z]"
    edits = (CONE_IS, body), ("  about: apex\n", ""), ("M: mass, ", ""), ("answer: inertia_tensor", f"answer: {asks}")
    found = solved(tmp_path, edited(CONE, *edits))
    assert equal(found["centre_of_mass_z"].value, 8 * R / 15)
    assert equal(found["radius_of_gyration_z"].value, R / sqrt(3))
    for key in ("centre_of_mass", "radius_of_gyration_z"):
        assert "M" in {s.name for s in found[key].step.chain[0].expr.free_symbols}


def test_parallel_axes_to_the_centre(tmp_path: Path) -> None:
    text = edited(CONE, ("  about: apex\n", ""), ("answer: inertia_tensor", "answer: parallel_axes"))
    found = solved(tmp_path, text)
    assert equal(found["parallel_axes"].value[0, 0], Rational(3, 20) * M * (R**2 + h**2 / 4))
    assert "apex_tensor" in found


def test_the_plate_and_its_axes(tmp_path: Path) -> None:
    """Of a rectangle R by h about its corner: I_xx = M h^2/3, I_yy = M R^2/3, I_xy = -M R h/4."""
    asks = "[turned_tensor, moment_about, perpendicular_axes, principal_angle]"
    edits = (CONE_IS, "{shape: plate, sides: [R, h], mass: M}"), ("about: apex", "about: corner")
    more = "about: corner\n  direction: [1, 1, 0]\n  turned: {z: alpha}"
    found = solved(
        tmp_path, edited(edited(CONE, *edits), ("about: corner", more), ("answer: inertia_tensor", f"answer: {asks}"))
    )
    assert equal(found["moment_about"].value, M * (R**2 + h**2) / 6 - M * R * h / 4)
    assert equal(found["perpendicular_axes"].value, M * (R**2 + h**2) / 3)
    turned = M * h**2 / 3 * cos(alpha) ** 2 + M * R**2 / 3 * sin(alpha) ** 2 - M * R * h / 2 * sin(alpha) * cos(alpha)
    assert equal(found["turned_tensor"].value[0, 0], turned)


def test_principal_axes_of_a_cube_about_its_corner(tmp_path: Path) -> None:
    """Taylor, example 10.4: M R^2/6, and twice 11/12 M R^2."""
    text = edited(
        CONE,
        (CONE_IS, "{shape: cuboid, sides: [R, R, R], mass: M}"),
        ("about: apex", "about: corner"),
        ("answer: inertia_tensor", "answer: [principal_moments, principal_axes]"),
    )
    found = solved(tmp_path, text)
    moments = found["principal_moments"].value
    assert equal(moments, ImmutableDenseMatrix([M * R**2 / 6, *[Rational(11, 12) * M * R**2] * 2]))
    assert "principal_axis_1" in found


def test_a_wire_whose_density_grows(tmp_path: Path) -> None:
    grows = "{position: [x, 0, 0], limits: {x: [0, h]}, mass: M, density: x}"
    text = edited(CONE, (CONE_IS, grows), ("  about: apex\n", ""), ("answer: inertia_tensor", "answer: centre_of_mass"))
    assert equal(solved(tmp_path, text)["centre_of_mass"].value, ImmutableDenseMatrix([2 * h / 3, 0, 0]))


def test_several_bodies_have_names(tmp_path: Path) -> None:
    both = "bodies: {upper rod: {shape: rod, length: h, mass: M, about: end}, disc: {shape: disc, radius: R, mass: m}}"
    text = edited(
        CONE,
        (f"body: {CONE_IS}", both),
        ("  about: apex\n", ""),
        ("answer: inertia_tensor", "answer: [upper_rod_moment_of_inertia_x, disc_moment_of_inertia_z]"),
    )
    found = solved(tmp_path, text)
    assert equal(found["upper_rod_moment_of_inertia_x"].value, M * h**2 / 3)
    assert equal(found["disc_moment_of_inertia_z"].value, m * R**2 / 2)


def test_the_body_is_drawn(tmp_path: Path) -> None:
    page = rendered(course_with(tmp_path, CONE), "trial/one", only={"text"})
    assert "A drawing in space of a circular cone" in page.texts["text"]


def test_numbers_go_behind_letters(tmp_path: Path) -> None:
    text = edited(CONE, ("radius: R, height: h, mass: M", "radius: 10 cm, height: 20 cm, mass: 3 kg"))
    page = rendered(course_with(tmp_path, text), "trial/one", only={"text"})
    assert "kg m" in page.texts["text"]


@pytest.mark.parametrize(
    ("edit", "said"),
    [
        (("about: apex", "about: apx"), "6: a cone has no point `apx`"),
        (("answer: inertia_tensor", "answer: inertia_tensr"), "10: a body has no answer called `inertia_tensr`"),
        (("answer: inertia_tensor", "answer: mass"), "10: the mass of a cone is given, so no step derives it"),
        (("answer: inertia_tensor", "answer: area"), "10: `area` is not an answer about a cone"),
        (("answer: inertia_tensor", "answer: moment_about"), "10: `moment_about` needs `direction`"),
        (("answer: inertia_tensor", "answer: turned_tensor"), "10: `turned_tensor` needs `turned`"),
        (
            ("answer: inertia_tensor", "answer: perpendicular_axes"),
            "10: the perpendicular-axis theorem needs a flat body, but a cone is not flat",
        ),
        ((f"  body: {CONE_IS}\n", ""), "5: `given` needs either `body` or `bodies`"),
        (("about: apex", "direction: [0, 0, 0]"), "6: `direction` has no direction: every component is zero"),
    ],
)
def test_a_fault_is_told_at_its_place(edit: tuple[str, str], said: str, tmp_path: Path) -> None:
    assert said in messages(tmp_path, edited(CONE, edit))


DISC = "{shape: disc, radius: R, mass: M}"


@pytest.mark.parametrize(
    ("body", "asked", "said", "help_line"),
    [
        (
            CONE_IS,
            "area",
            "`area` is not an answer about a cone",
            "it has a volume: ask for `density`",
        ),
        (
            "{shape: disc, radius: R, mass: M}",
            "area",
            "the area of a disc is known, so no step derives it",
            "ask for `density`",
        ),
        ("{shape: particle, mass: M}", "length", "`length` is not an answer about a particle", "its mass is given"),
        ("{shape: particle, mass: M}", "mass", "`mass` is not an answer about a particle", "its mass is given"),
        ("{parts: {a: CONE}}", "volume", "`volume` is not an answer about this body", "ask for `mass`, the sum"),
        ("{parts: {a: CONE}}", "density", "`density` is not an answer about this body", "ask for `mass`, the sum"),
    ],
)
def test_a_size_that_a_body_does_not_have(body: str, asked: str, said: str, help_line: str, tmp_path: Path) -> None:
    text = edited(CONE, ("  about: apex\n", ""), (CONE_IS, body.replace("CONE", CONE_IS)), ("inertia_tensor", asked))
    (found,) = complaints(tmp_path, text)
    assert found.message == said
    assert found.help.startswith(help_line)


def test_answers_that_do_not_apply_are_told_at_once(tmp_path: Path) -> None:
    found = messages(tmp_path, edited(CONE, ("answer: inertia_tensor", "answer: [mass, turned_tensor]")))
    assert [message.partition(":")[0] for message in found] == ["10", "10"]


@pytest.mark.parametrize("order", ["[inertia_tensor, parallel_axes]", "[parallel_axes, inertia_tensor]"])
def test_a_tensor_is_found_directly_and_by_the_theorem_in_either_order(order: str, tmp_path: Path) -> None:
    """By hand: (3/10) M R^2 about the axis of a cone, wherever on it the point is."""
    found = solved(tmp_path, edited(CONE, ("answer: inertia_tensor", f"answer: {order}")))
    for name in ("inertia_tensor", "parallel_axes"):
        assert equal(found[name].value[2, 2], Rational(3, 10) * M * R**2)


ELSEWHERE = "  results:\n    again: MADE\n"


@pytest.mark.parametrize(
    ("made", "value"),
    [
        ("{answer: moment_of_inertia_x, about: base}", M * (3 * R**2 + 2 * h**2) / 20),
        ("{answer: moment_of_inertia_x, about: centre_of_mass}", 3 * M * (4 * R**2 + h**2) / 80),
        ("{answer: radius_of_gyration_z, about: base, symbol: k_b}", sqrt(Rational(3, 10)) * R),
        ("{answer: moment_about, direction: z}", Rational(3, 10) * M * R**2),
        ("{answer: moment_about, about: base, direction: x}", M * (3 * R**2 + 2 * h**2) / 20),
    ],
)
def test_another_point_or_axis_of_the_same_body_is_asked_about(made: str, value: object, tmp_path: Path) -> None:
    """By hand: about a diameter of the base M (3 R^2 + 2 h^2)/20, about the centre of mass 3 M (4 R^2 + h^2)/80."""
    text = edited(CONE, ("  about: apex\n", "  about: apex\n" + ELSEWHERE.replace("MADE", made)))
    found = solved(tmp_path, edited(text, ("answer: inertia_tensor", "answer: [moment_of_inertia_x, again]")))
    assert equal(found["again"].value, value)
    assert equal(found["moment_of_inertia_x"].value, Rational(3, 20) * M * (R**2 + 4 * h**2))


def test_a_second_tensor_has_its_own_name_and_is_used_in_results(tmp_path: Path) -> None:
    """By hand: the moments across the axis about apex and centre differ by M (3 h/4)^2."""
    made = """{answer: inertia_tensor, about: centre_of_mass}
    first: {answer: moment_of_inertia_x, about: centre_of_mass}
    shift: {value: (moment_of_inertia_x - first)/M}"""
    text = edited(CONE, ("answer: inertia_tensor", "answer: [inertia_tensor, again, shift]"))
    found = solved(tmp_path, edited(text, ("  about: apex\n", "  about: apex\n" + ELSEWHERE.replace("MADE", made))))
    assert equal(found["again"].value[0, 0], 3 * M * (4 * R**2 + h**2) / 80)
    assert equal(found["shift"].value, Rational(9, 16) * h**2)


@pytest.mark.parametrize(
    ("made", "said"),
    [
        ("{answer: moment_of_inertia_x, about: tip}", "has no point `tip`"),
        ("{answer: moment_of_inertia_x, direction: x}", "`moment_of_inertia_x` does not depend on `direction`"),
        ("{answer: centre_of_mass, about: base}", "`centre_of_mass` does not depend on `about`"),
        ("{answer: principal_axes, about: base}", "`answer` cannot derive `principal_axes`"),
        ("{answer: moment_of_inertia_x}", "`answer` needs `about`, `origin` or `direction`"),
    ],
)
def test_what_cannot_be_asked_about_another_point_is_told(made: str, said: str, tmp_path: Path) -> None:
    text = edited(CONE, ("answer: inertia_tensor", "answer: again"))
    text = edited(text, ("  about: apex\n", "  about: apex\n" + ELSEWHERE.replace("MADE", made)))
    found = messages(tmp_path, text)
    assert any(said in message for message in found), found


def test_the_description_of_a_position_map_reads_the_same_in_each_process(tmp_path: Path) -> None:
    by_map = "{position: [x, y, 0], limits: {x: [0, R], y: [0, h]}, mass: M}"
    text = repr(loaded(tmp_path, edited(CONE, ("  about: apex\n", ""), (CONE_IS, by_map))).described)
    assert "Sheet" in text and " at 0x" not in text
