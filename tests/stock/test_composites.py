"""Bodies made of parts that swing, and the points of bodies by their names."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import Rational, symbols

from derive.algebra.equality import equal
from derive.building.solution import rendered
from derive.errors import DeriveError
from derive.render.notation.notation import Notation
from derive.render.notation.text import in_one_line
from tests.stock.described import complaints, course_with, edited, solved

g, l, m, M, R = symbols("g l m M R", positive=True)

DISC_WITH_HOLE = """\
title: A disc with a hole swings
solve: system
symbols: {R: length, M: mass, g: acceleration}
given:
  coordinates: {theta: angle}
  bodies:
    plate:
      mass: M
      parts:
        disc: {shape: disc, radius: R, at: [0, 0, 0]}
        hole: {shape: disc, radius: R/2, at: [0, R/2, 0], cut_out: true}
      points: {rim: [0, R, 0]}
      held: rim
      turned: theta
      across: z
  gravity: g
statement: A disc.
parts:
  - ask: Find the frequency.
    answer: [moment_of_inertia, frequency]
"""

T_OF_RODS = """\
title: A T of two rods swings
solve: system
symbols: {l: length, m: mass, g: acceleration}
given:
  coordinates: {theta: angle}
  bodies:
    T:
      parts:
        stem: {shape: rod, length: l, mass: m, turned: {x: pi/2}, at: [0, -l/2, 0]}
        bar: {shape: rod, length: l, mass: m, turned: {y: pi/2}, at: [0, -l, 0]}
      held: [0, 0, 0]
      turned: theta
      across: z
  gravity: g
statement: A T.
parts:
  - ask: Find the frequency.
    answer: frequency
"""


def test_a_disc_with_a_hole_swings_about_a_point_of_its_rim(tmp_path: Path) -> None:
    """By parallel axes, Morin, *Introduction to Classical Mechanics*, section 8.3: 4/3 M (3/2 R^2) - 1/3 M (3/8 R^2)
    is 15/8 M R^2, and the centre of mass is 7/6 R below."""
    found = solved(tmp_path, DISC_WITH_HOLE)
    assert equal(found["moment_of_inertia"].value, Rational(15, 8) * M * R**2)
    assert equal(found["frequency"].value ** 2, Rational(28, 45) * g / R)
    assert found["disc_mass"].value == Rational(4, 3) * M  # which the page shows


def test_a_t_of_rods_swings_about_its_foot(tmp_path: Path) -> None:
    """1/3 m l^2 + 13/12 m l^2, Morin, *Introduction to Classical Mechanics*, section 8.3."""
    assert equal(solved(tmp_path, T_OF_RODS)["frequency"].value ** 2, Rational(18, 17) * g / l)


def test_a_body_of_parts_that_is_not_drawn_is_no_fault(tmp_path: Path) -> None:
    page = rendered(course_with(tmp_path, T_OF_RODS), "trial/one", only={"text"})
    assert not page.warnings


def test_what_the_engine_does_not_draw_is_no_fault_of_a_script(tmp_path: Path) -> None:
    text = T_OF_RODS + "drawings:\n  sketch: {width: 4 cm}\n"
    with pytest.raises(DeriveError) as refused:
        rendered(course_with(tmp_path, text), "trial/one", only={"text"})
    assert "the engine draws nothing called `sketch`" in str(refused.value)


def test_a_wrong_mass_of_what_is_cut_out_changes_the_frequency(tmp_path: Path) -> None:
    text = edited(DISC_WITH_HOLE, ("radius: R/2, at: [0, R/2, 0]", "radius: R/4, at: [0, R/2, 0]"))
    assert not equal(solved(tmp_path, text)["frequency"].value ** 2, Rational(28, 45) * g / R)


def half_disc(held: str) -> str:
    return f"""\
title: A half-cylinder rocks on a table
solve: system
symbols: {{R: length, M: mass, g: acceleration}}
given:
  coordinates: {{theta: angle}}
  places: {{O: [R*theta, R]}}
  bodies:
    half: {{shape: half_disc, radius: R, mass: M, turned: pi - theta, held: {held}, on: O, across: z}}
  gravity: g
statement: A half-cylinder.
parts:
  - ask: Find the energy.
    answer: potential_energy
"""


def test_the_centre_of_a_half_disc_is_asked_back(tmp_path: Path) -> None:
    (found,) = complaints(tmp_path, half_disc("centre"))
    assert found.message == "`centre` of a half-disc could be `centre_of_mass` or `circle_centre`"


def test_where_nothing_drives_it_back_there_is_no_period(tmp_path: Path) -> None:
    text = half_disc("centre_of_mass").replace("potential_energy", "period")
    (found,) = complaints(tmp_path, text)
    assert found.message == "nothing drives the system back to this state, so there is no oscillation about it"


@pytest.mark.parametrize(("held", "is_constant"), [("centre_of_mass", True), ("circle_centre", False)])
def test_each_of_its_centres_has_a_name(held: str, is_constant: bool, tmp_path: Path) -> None:
    """Held by the centre of its circle it has U = -4/(3 pi) M g R cos(theta) + M g R."""
    found = solved(tmp_path, half_disc(held))["potential_energy"].value
    assert bool(equal(found, M * g * R)) == is_constant


def test_the_tensor_of_a_half_disc_is_told_about_its_centre_of_mass(tmp_path: Path) -> None:
    text = """\
title: A half-disc
solve: body
symbols: {R: length, M: mass}
given: {body: {shape: half_disc, radius: R, mass: M}}
statement: A half-disc.
parts:
  - ask: Find its moment of inertia.
    answer: moment_of_inertia_z
"""
    assert "the origin at the centre of mass" in " ".join(
        rendered(course_with(tmp_path, text), "trial/one", only={"text"}).texts["text"].split()
    )


DUMBBELL = """\
title: A dumbbell
solve: body
symbols: {R: length, l: length, M: mass, m: mass}
given:
  body:
    parts:
      stick: {shape: rod, length: l, mass: m, at: [0, 0, -l/2]}
      ball: {shape: ball, radius: R, mass: M, at: [0, 0, -l - R]}
    points: {pivot: [0, 0, 0]}
  about: pivot
statement: A dumbbell.
parts:
  - ask: Find the moment about a horizontal axis.
    answer: moment_of_inertia_x
"""


def test_distances_of_parallel_axes_are_written_without_minus_signs(tmp_path: Path) -> None:
    moment = solved(tmp_path, DUMBBELL)["moment_of_inertia_x"].step.chain[0].expr
    text = in_one_line(Notation().layout(moment))
    assert "(l/2)²" in text and "(R + l)²" in text
