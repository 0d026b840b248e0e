"""Impulses and collisions as YAML describes them, and what is wrong with some."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.stock.described import complaints, edited, messages

BULLET = """\
title: A bullet and a rod
solve: system
symbols: {m: mass, M: mass, l: length, b: length, v: speed, J: momentum, e: 'number in [0, 1]'}
given:
  coordinates: {x: length, theta: angle}
  places: {B: [x, -b], A: [b*sin(theta), -b*cos(theta)]}
  particles: {bullet: {mass: m, at: B}}
  bodies: {rod: {shape: rod, length: l, mass: M, held: end, on: [0, 0], turned: theta + pi}}
  impact:
    at: {x: 0, theta: 0}
    before: {x_dot: v}
    collisions: {from: B, to: A}
statement: A bullet gets stuck.
parts:
  - ask: How fast is the rod?
    answer: theta_dot_after
"""
HIT = "collisions: {from: B, to: A}"
ALONG = "collisions: {from: B, to: A, along: [1, 0]"


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        ((HIT, "collisions: []"), "12: `collisions` must be a list of mappings, a collision each, but it is empty"),
        ((HIT, "collisions: {from: B}"), "12: a collision needs `from` and `to`, or `at`"),
        ((HIT, "collisions: {from: B, at: A}"), "12: a collision needs `from` and `to`, or `at`"),
        ((HIT, f"{ALONG}}}"), "12: a collision along a normal needs its `restitution`"),
        (("[1, 0]", "[l, 0]"), "12: `a component` must be a number, but `l` is a length"),
        (("restitution: e", "restitution: e, impulse: v"), "12: `v` already denotes something else"),
        ((HIT, "collisions: {from: B, to: A, impulse: '2'}"), "12: `2` is not a valid symbol for an impulse"),
        ((HIT, "impulses: {components: [J, 0]}"), "12: an impulse needs `components` and `at`, or `angular` and `on`"),
        ((HIT, "impulses: {components: [v, 0], at: A}"), "12: `a component` must be a momentum, but `v` is a speed"),
        ((HIT, "impulses: {components: [J, 0], at: A, of: x}"), "12: `x` is not a body or particle of this system"),
        ((HIT, "collisions: {at: A, of: x}"), "12: `x` is not a body or particle of this system"),
        (("{x_dot: v}", "{x: v}"), "11: `x` is not a rate of this system"),
        (("{x: 0, theta: 0}", "{y: 0, theta: 0}"), "10: `y` is not a coordinate of this system"),
        (("{x_dot: v}", "{x_dot: b}"), "11: `x_dot` must be a speed, but `b` is a length"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_an_impact(edit: tuple[str, str], message: str, tmp_path: Path) -> None:
    text = BULLET if edit[0] in BULLET else edited(BULLET, (HIT, f"{ALONG}, restitution: e}}"))
    assert messages(tmp_path, edited(text, edit)) == [message]


def test_what_a_verb_refuses_is_told_where_it_is_described(tmp_path: Path) -> None:
    text = edited(BULLET, ("{x: 0, theta: 0}", "{theta: 0}"))
    assert messages(tmp_path, text) == ["10: the two places of this collision do not meet"]


def test_all_faults_of_an_impact_are_told_at_once(tmp_path: Path) -> None:
    collision = "collisions: {from: C, to: [b*sin(thta), 0], along: [1, 0], restitution: l}"
    text = edited(BULLET, ("{x: 0, theta: 0}", "{x: 0, phi: 0}"), ("{x_dot: v}", "{x_dot: b}"), (HIT, collision))
    assert messages(tmp_path, text) == [
        "10: `phi` is not a coordinate of this system",
        "11: `x_dot` must be a speed, but `b` is a length",
        "12: `C` is not a named place",
        "12: `thta` is not declared",
        "12: `restitution` must be a number, but `l` is a length",
    ]


def test_the_former_name_of_the_key_is_an_error_that_says_what_to_write(tmp_path: Path) -> None:
    (found,) = complaints(tmp_path, edited(BULLET, ("  impact:\n", "  blow:\n")))
    assert (found.message, found.help) == (
        "`given` has no key `blow`",
        "write `impact`: impulses and collisions at one instant",
    )
