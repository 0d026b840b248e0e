"""Pictures of normal modes: directions and lengths of the arrows, against eigenvectors that numpy finds."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import hypot
from pathlib import Path
from typing import Any

import numpy
import pytest
from sympy import Symbol

from derive.building.solution import rendered
from derive.figures.encoding import drawings_from_data, drawings_to_data
from derive.figures.marks import Drawing
from derive.figures.modes import DisplacementArrow, RotationArrow
from derive.figures.parts import BLOCK, BarMark, ConnectionMark, ParticleMark, SpringMark
from derive.figures.pieces import Stroke
from derive.figures.surroundings import FixedEnd
from derive.render.drawing.camera import FLAT, Numbers, with_coordinates
from derive.render.drawing.hidden_lines import OnPaper
from derive.render.drawing.picture import picture
from tests.figures.test_connected import drawings
from tests.stock.described import course_with, edited

CHAIN = """\
title: Two blocks between walls
solve: system
symbols: {m: mass, k: spring constant, a: length}
given:
  coordinates: {x_1: length, x_2: length}
  particles: {one: {mass: m, at: [a + x_1, 0]}, two: {mass: 2*m, at: [2*a + x_2, 0]}}
  springs:
    - {constant: k, length: a, from: [0, 0], to: one}
    - {constant: k, length: a, from: one, to: two}
    - {constant: 5*k, length: a, from: two, to: [3*a, 0]}
  surfaces: {floor: {through: [0, 0], along: [1, 0]}}
  contacts: [{of: one, on: floor}, {of: two, on: floor}]
statement: Two blocks.
parts:
  - ask: Find the modes.
    answer: normal_modes
"""
PENDULUMS = """\
title: Two pendulums and a spring
solve: system
symbols: {m: mass, k: spring constant, l: length, d: length, g: acceleration}
given:
  coordinates: {u: angle, v: angle}
  places: {A: [l*sin(u), -l*cos(u)], B: [d + l*sin(v), -l*cos(v)]}
  particles: {one: {mass: m, at: A}, two: {mass: m, at: B}}
  massless_rods: [{from: [0, 0], to: one}, {from: [d, 0], to: two}]
  springs: {constant: k, length: d, from: one, to: two}
  gravity: g
statement: Two pendulums.
parts:
  - ask: Find the modes.
    answer: normal_modes
"""
MOLECULE = """\
title: A molecule
solve: system
symbols: {m: mass, M: mass, k: spring constant, a: length}
given:
  coordinates: {x: length, y: length, z: length}
  particles: {one: {mass: m, at: [x - a, 0]}, two: {mass: M, at: [y, 0]}, three: {mass: m, at: [a + z, 0]}}
  springs: [{constant: k, length: a, from: one, to: two}, {constant: k, length: a, from: two, to: three}]
statement: A molecule.
parts:
  - ask: Find the modes.
    answer: normal_modes
"""
UNEQUAL = edited(
    CHAIN,
    ("symbols: {m: mass,", "symbols: {m: mass, M: mass, q: spring constant, K: spring constant,"),
    ("mass: 2*m", "mass: M"),
    ("{constant: k, length: a, from: one", "{constant: q, length: a, from: one"),
    ("5*k", "K"),
)
ROD = """\
title: A rod on an axle, and a mass below its end
solve: system
symbols: {m: mass, k: spring constant, l: length, d: length}
given:
  coordinates: {theta: angle, y: length}
  bodies: {bar: {shape: rod, length: 2*l, mass: m, centre: [0, 0], along: [cos(theta), sin(theta)]}}
  particles: {bob: {mass: m, at: [l, y - d]}}
  springs:
    - {constant: k, length: d, from: bob, to: bar.far_end}
    - {constant: k, length: d, from: [l, -2*d], to: bob}
statement: A rod.
parts:
  - ask: Find the modes.
    answer: normal_modes
"""
WEDGE = """\
title: A block on a wedge
solve: system
symbols: {m: mass, M: mass, k: spring constant, a: length, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {X: length, s: length}
  places: {W: [X, 0], P: {from: W, by: [(a + s)*cos(alpha), (a + s)*sin(alpha)]}}
  particles: {wedge: {mass: M, at: W}, block: {mass: m, at: P}}
  springs: {constant: k, length: a, from: W, to: block}
  surfaces: {face: {through: W, along: [cos(alpha), sin(alpha)], of: wedge}, floor: {through: [0, 0], along: [1, 0]}}
  contacts: [{of: block, on: face}, {of: wedge, on: floor}]
statement: A wedge.
parts:
  - ask: Find the modes.
    answer: normal_modes
"""


def modes(folder: Path, text: str) -> list[Drawing]:
    return [each for each in drawings(folder, text).values() if each.mode is not None]


def arrows(drawing: Drawing, numbers: Mapping[str, float] | None = None) -> list[tuple[float, float]]:
    """The arrows of a drawing, in points; (0, 0) for a mass without an arrow."""
    known = {s: (numbers or {}).get(s.name, 1.0) for s in drawing.letters if s not in dict(drawing.coordinates)}
    paper = OnPaper(Numbers(with_coordinates(drawing, known, 1.0)), FLAT, 60.0)
    found = []
    for mark in (mark for mark in drawing.marks if isinstance(mark, DisplacementArrow)):
        pieces = [piece for piece in mark.pieces(paper) if isinstance(piece, Stroke)]
        (x, y), (u, v) = pieces[0].spots if pieces else ((0.0, 0.0), (0.0, 0.0))
        found.append((u - x, v - y))
    return found


def is_mode(across: Sequence[float], mass: Sequence[float], stiffness: Any, tolerance: float = 1e-6) -> bool:
    """Whether displacements along a line are an eigenvector of K a = omega^2 M a."""
    a, m, k = numpy.array(across), numpy.diag(mass), numpy.array(stiffness)
    square = (a @ k @ a) / (a @ m @ a)
    return bool(numpy.abs(k @ a - square * m @ a).max() < tolerance * numpy.abs(a).max())


def of_chain(drawing: Drawing) -> bool:
    return is_mode([x for x, _ in arrows(drawing)], [1, 2], [[2, -1], [-1, 6]])


# --- directions and lengths ------------------------------------------------------------------------------------------


def test_the_arrows_of_each_mode_of_a_chain_are_an_eigenvector(tmp_path: Path) -> None:
    slow, fast = modes(tmp_path, CHAIN)
    assert [each.key for each in (slow, fast)] == ["mode_1", "mode_2"]
    assert of_chain(slow) and of_chain(fast)
    ((x, y), (u, v)), ((p, _), (q, _)) = arrows(slow), arrows(fast)
    assert x > 0 and u > 0 and y == v == 0 and p * q < 0


def test_a_wrong_shape_is_noticed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from derive.figures import modes as module

    slow, _ = modes(tmp_path / "right", CHAIN)
    first, *_ = _own(slow)
    others = [mark for mark in slow.marks if mark is not first]
    assert not of_chain(replace(slow, marks=(replace(first, value=-first.value), *others)))

    def exchanged(self: Any) -> dict[Symbol, Any]:
        entries = list(self.shape.value.doit())
        return {q.symbol: entry for (q, _), entry in zip(self.linear.place, entries[::-1], strict=True)}

    monkeypatch.setattr(module._InMode, "amplitudes", property(exchanged))
    assert not any(of_chain(each) for each in modes(tmp_path / "wrong", CHAIN))


def _own(drawing: Drawing) -> list[DisplacementArrow]:
    return [mark for mark in drawing.marks if isinstance(mark, DisplacementArrow)]


def test_the_arrows_of_pendulums_are_below_the_spring_and_the_rods_are_displaced(tmp_path: Path) -> None:
    same, opposite = modes(tmp_path, PENDULUMS)
    assert arrows(same) == [pytest.approx((42, 0)), pytest.approx((42, 0))]
    assert arrows(opposite) == [pytest.approx((42, 0)), pytest.approx((-42, 0))]
    assert all(list(mark.side) == [0, -1] for each in (same, opposite) for mark in _own(each))
    values = {q.name: v for q, v in opposite.values}
    assert values["u"] == -values["v"] and 0.2 < float(values["u"]) < 0.4
    assert not any(mark.label for mark in opposite.marks)
    sorts = {type(mark) for mark in opposite.marks}
    assert sorts == {SpringMark, BarMark, ParticleMark, FixedEnd, ConnectionMark, DisplacementArrow}


def test_a_free_motion_has_equal_arrows_and_a_mass_at_rest_has_none(tmp_path: Path) -> None:
    free, symmetric, antisymmetric = modes(tmp_path, MOLECULE)
    assert free.mode is not None and free.mode.sort == "free"
    assert arrows(free) == 3 * [pytest.approx((42, 0))]
    (x, _), middle, (u, _) = arrows(symmetric)
    assert x == pytest.approx(-u) and middle == (0, 0)
    across = [x for x, _ in arrows(antisymmetric, {"m": 1.0, "M": 1.5})]
    assert is_mode(across, [1, 1.5, 1], [[1, -1, 0], [-1, 2, -1], [0, -1, 1]])


@pytest.mark.long
def test_the_signs_of_two_unequal_masses_are_known_for_all_letters(tmp_path: Path) -> None:
    slow, fast = modes(tmp_path, UNEQUAL)
    for m, mass, k, q, stiff in ((1.0, 4.0, 1.0, 0.5, 2.0), (3.0, 1.0, 5.0, 1.0, 1.0)):
        numbers = {"m": m, "M": mass, "k": k, "q": q, "K": stiff}
        (a, _), (b, _) = arrows(slow, numbers)
        (c, _), (d, _) = arrows(fast, numbers)
        assert a * b > 0 > c * d
    assert slow.mode is not None and slow.mode.lengths == "of_letters"
    assert [str(letter) for letter in slow.mode.letters] == ["K", "M", "k", "m", "q"]


def test_a_rod_that_only_rotates_has_an_arc(tmp_path: Path) -> None:
    together, against = modes(tmp_path, ROD)
    for mode, way in ((together, 1), (against, -1)):
        (arc,) = (mark for mark in mode.marks if isinstance(mark, RotationArrow))
        (stroke,) = arc.pieces(OnPaper(Numbers({}), FLAT, 60.0))
        assert isinstance(stroke, Stroke) and stroke.head
        turns = stroke.spots[0][0] - stroke.spots[-1][0]  # a counterclockwise arrow above the centre is to the left
        ((x, y),) = arrows(mode)
        assert x == 0 and turns * y * way > 0


def test_a_very_small_displacement_has_no_arrow_and_the_caption_says_so(tmp_path: Path) -> None:
    _, fast = modes(tmp_path, edited(CHAIN, ("mass: 2*m", "mass: 20*m")))
    (x, _), (u, _) = arrows(fast)
    assert u == 0 != x
    assert fast.mode is not None and fast.mode.lengths == "without_small"


# --- which modes are drawn -------------------------------------------------------------------------------------------


def test_a_mode_whose_directions_depend_on_letters_is_left_out_and_then_free_motions_are_too(tmp_path: Path) -> None:
    found = drawings(tmp_path, WEDGE)
    assert "system" in found and not [key for key in found if key.startswith("mode")]


def test_damped_modes_one_coordinate_and_systems_in_space_have_no_picture(tmp_path: Path) -> None:
    alone = edited(
        MOLECULE, ("x: length, y: length, z: length", "y: length"), ("[x - a, 0]", "[-a, 0]"), (" + z, 0", ", 0")
    )
    damped = edited(
        CHAIN,
        ("symbols: {m", "symbols: {b: damping constant, m"),
        ("mass: 2*m", "mass: m"),
        ("5*k", "k"),
        (
            "  surfaces",
            "  dashpots: [{constant: b, from: [0, 0], to: one}, {constant: b, from: two, to: [3*a, 0]}]\n  surfaces",
        ),
    )
    places = ("[x - a, 0]", "[y, 0]", "[a + z, 0]")
    space = edited(MOLECULE, *((place, place.replace("0]", "0, 0]")) for place in places))
    for name, text in {"alone": alone, "damped": damped, "space": space}.items():
        assert not modes(tmp_path / name, text), name


# --- the page --------------------------------------------------------------------------------------------------------


def page_of(folder: Path, text: str) -> dict[str, dict[str, Any]]:
    found = rendered(course_with(folder, text), "trial/one", only={"json"}).texts["json"]
    return {drawing["key"]: drawing for drawing in json.loads(found)["drawings"]}


def test_the_second_sentence_of_the_caption_is_stated_once(tmp_path: Path) -> None:
    found = page_of(tmp_path, MOLECULE)
    assert found["mode_1"]["caption"] == (
        "Mode with ω_1 = 0. The arrows show the directions and the relative sizes of the displacements."
    )
    assert found["mode_2"]["caption"] == "Mode of frequency ω_2."
    assert found["mode_3"]["caption"] == (
        "Mode of frequency ω_3. The arrows show the directions of the displacements, whose ratio depends on M and m."
    )
    assert [found[f"mode_{n}"]["number"] for n in (1, 2, 3)] == [1, 2, 3]
    assert found["mode_2"]["alt"] == (
        "A plane drawing of the system displaced in this mode: from left to right, the mass m moves to the right, the "
        "mass M is at rest and the mass m moves to the left."
    )


def test_the_problem_can_hide_a_mode_and_change_its_caption_and_numbers(tmp_path: Path) -> None:
    keys = "drawings:\n  mode_1: {at: hidden}\n  mode_3: {caption: Out of step., width: 3 cm, values: {M: 4 kg}}\n"
    found = page_of(tmp_path, MOLECULE + keys)
    assert "mode_1" not in found
    assert found["mode_2"]["caption"].endswith("the relative sizes of the displacements.")
    assert found["mode_3"]["caption"] == "Out of step."


def test_the_drawings_follow_the_last_mode(tmp_path: Path) -> None:
    text = rendered(course_with(tmp_path, CHAIN), "trial/one", only={"text"}).texts["text"]
    assert text.count("[figure: A plane drawing of the system displaced") == 2
    after = text.split("Figure 1.")[0]
    assert "a⃗_1" in after and "a⃗_2" in after


def test_the_drawings_of_three_modes_are_in_one_row(tmp_path: Path) -> None:
    found = rendered(course_with(tmp_path, MOLECULE), "trial/one")
    (row,) = re.findall(r'<div class="figures">.*?</div>', found.html, flags=re.S)
    assert row.count("<figcaption>") == 3
    assert found.latex.count(r"\begin{drawings}\narrowcaptions") == 1


def test_a_drawing_of_a_mode_is_reduced_and_kept(tmp_path: Path) -> None:
    slow, _ = modes(tmp_path, CHAIN)
    assert drawings_from_data(json.loads(json.dumps(drawings_to_data([slow])))) == (slow,)
    known = {s: 1.0 for s in slow.letters if s not in dict(slow.coordinates)}
    pieces = picture(slow, Numbers(with_coordinates(slow, known, 1.0)), 4.0, 3.0)
    spots = [spot for piece in pieces for spot in piece.spots]
    assert max(x for x, _ in spots) - min(x for x, _ in spots) < 4.01 * 72 / 2.54
    block = next(p for p in pieces if isinstance(p, Stroke) and p.pen == "edge" and len(p.spots) == 5)
    assert hypot(block.spots[1][0] - block.spots[0][0], 0) == pytest.approx(0.7 * BLOCK[0])
