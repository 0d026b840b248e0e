"""Places and axes of a description: how one leads to another, and what leads nowhere."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import explicit
from tests.stock.described import PENDULUM, edited, loaded, messages, solved

PLACES = "{A: [l*sin(theta), -l*cos(theta)]}"


def test_a_place_may_be_told_from_another(tmp_path: Path) -> None:
    ways = "{A: {from: B, by: [l, 0]}, B: {from: C, by: [0, l*theta]}, C: [l, l]}"
    described = loaded(tmp_path, edited(PENDULUM, (PLACES, ways))).described
    assert [str(c) for c in described.particles["bob"].of[1].components] == ["2*l", "l*theta + l"]  # type: ignore[union-attr]


def test_places_along_axes_that_turn(tmp_path: Path) -> None:
    text = edited(
        PENDULUM,
        (f"  places: {PLACES}", "  axes: {arm: [{z: theta}, {x: omega*t}]}"),
        ("at: A", "at: {in: arm, by: [l, 0, 0]}"),
    )
    described = loaded(tmp_path, text).described
    found = [str(c) for c in described.particles["bob"].of[1].components]  # type: ignore[union-attr]
    assert found == ["l*cos(theta)", "l*sin(theta)", "0"]


@pytest.mark.parametrize(
    ("places", "said"),
    [
        ("{A: {from: B, by: [l, 0]}, B: {from: A, by: [l, 0]}}", "the position of `A` depends on `A` itself"),
        ("{A: {from: A, by: [l, 0]}}", "the position of `A` depends on `A` itself"),
        ("{A: [l, theta*l], B: [l, 0, 0]}", "`B` has 3 components, but `A` has 2"),
        ("{A: {in: hoop, by: [l, 0, 0]}}", "`hoop` is not the name of axes"),
        ("{A: {by: [l, 0], form: B}}", "a place has no key `form`"),
        ("{A: }", "`A` must be a list of components, `{from: A, by: [x, y]}`, or the name of a place, but it is empty"),
        ("{A: [l, m]}", "`a component of A` must be a length, but `m` is a mass"),
        ("{A: [l, 2 kg]}", "`a component of A` must be a length, but `2 kg` is a mass"),
    ],
)
def test_what_leads_nowhere_is_told(places: str, said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, edited(PENDULUM, (PLACES, places)))
    assert any(message.partition(": ")[2] == said for message in found), found


def test_axes_turn_about_one_of_three(tmp_path: Path) -> None:
    text = edited(
        PENDULUM, (f"  places: {PLACES}", "  axes: {arm: [{w: theta}]}"), ("at: A", "at: {in: arm, by: [l, 0, 0]}")
    )
    assert messages(tmp_path, text) == ["6: axes can rotate about x, y or z, not about `w`"]


def test_a_coordinate_is_a_letter(tmp_path: Path) -> None:
    found = messages(tmp_path, edited(PENDULUM, ("{theta: angle}", "{theta: angle, x y: angle, t: length}")))
    assert found == ["5: `x y` is not a valid symbol for a coordinate", "5: `t` is not a valid symbol for a coordinate"]


def test_where_a_particle_is_may_be_called_by_its_name(tmp_path: Path) -> None:
    """A cart between two springs: Goldstein, problem 8.26."""
    text = """\
title: A cart between two springs
solve: system
symbols: {m: mass, k: spring constant, K: spring constant, a: length, b: damping constant}
given:
  coordinates: {x: length}
  places: {left: [0, 0], right: [a, 0]}
  particles: {cart: {mass: m, at: [x, 0]}}
  springs: [{constant: k, from: left, to: cart}, {constant: K, from: cart, to: right}]
  damping: {constant: b, at: cart}
statement: A cart.
parts:
  - ask: How does it move?
    answer: motion_x
reference:
  source: Goldstein, Classical Mechanics, problem 8.26
"""
    m, k, K, a, b = symbols("m k K a b", positive=True)
    x, v, c = symbols("x x_dot x_ddot", real=True)
    left = explicit(solved(tmp_path, text)["motion_x"].value).residual
    assert equal(left, m * c + b * v + (k + K) * x - K * a)
    assert any("`car` is not a named place" in said for said in messages(tmp_path, text.replace("at: cart", "at: car")))
    own = text.replace("at: [x, 0]", "at: cart")
    assert any("`cart` is not a named place" in said for said in messages(tmp_path, own))
