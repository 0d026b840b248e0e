"""Tests of the functions for the parts of machines: arguments, errors, descriptions and encoding."""

from __future__ import annotations

import json

import pytest
from sympy import pi

import derive.mechanics
from derive.errors import Rejected
from derive.figures import (
    angle_mark,
    arrow,
    axes,
    block,
    bodies,
    cart,
    ceiling,
    drawing,
    elements,
    fixed_end,
    floor,
    gravity_mark,
    length_mark,
    particle,
    pivot,
    point_mark,
    rod,
    rope,
    scenes,
    sketches,
    spring_mark,
    wall,
    way,
    wedge,
    wheel,
)  # fmt: skip
from derive.figures.encoding import drawings_from_data, drawings_to_data
from derive.figures.marks import PLANE, SPACE, Drawing
from derive.mechanics import coordinate, point
from derive.page.depiction import alternative
from derive.page.template import templates_of
from derive.page.wording import phrases
from derive.render.notation.notation import Notation
from derive.render.printing.text_page import inline_text
from derive.steps.record import recorded
from tests.courses import ROOT
from tests.figures.machines import ORIGIN, M, a, hung, k, l, m, seen
from tests.mechanics.block import known_block

TOP = point(0, 1)


def told(found: Drawing) -> str:
    return inline_text(alternative(None, found, None, phrases(templates_of(ROOT))), Notation())  # type: ignore[arg-type]


def test_a_pendulum_is_told_in_words() -> None:
    theta = coordinate("theta")
    bob = hung(l, theta)
    found = drawing("one", pivot(ORIGIN), rod(ORIGIN, bob, l), angle_mark(ORIGIN, "down", bob, theta), particle(bob, m))
    assert told(found) == ("A plane drawing of a pivot, a rod of length l, the angle θ and a particle m.")


def test_every_element_is_told_in_words_and_kept_as_data() -> None:
    disc = wheel(TOP, a)
    found = drawing(
        "all", cart(ORIGIN, M), block(TOP, m), spring_mark(ORIGIN, TOP, k), rope(ORIGIN, disc, point(1, 0), label=l),
        disc, wedge(ORIGIN, TOP, point(1, 0)), floor(ORIGIN, TOP), wall(ORIGIN, TOP),
        ceiling(ORIGIN, TOP), fixed_end(TOP, ORIGIN), way(point(l, 0), l),
        gravity_mark(), length_mark(ORIGIN, TOP, a),
    )  # fmt: skip
    assert told(found) == (
        "A plane drawing of a cart M, a block m, a spring k, a string l, a wheel, a wedge, hatched "
        "ground, a wall, a ceiling, a fixed end, a dashed curve, an arrow g downwards and "
        "the length a."
    )
    assert list(drawings_from_data(json.loads(json.dumps(drawings_to_data([found]))))) == [found]


def test_a_place_with_two_components_puts_the_drawing_into_its_plane() -> None:
    assert drawing("one", particle(ORIGIN)).view == PLANE
    assert drawing("one", particle(point(0, 0, 0))).view == SPACE
    assert drawing("one", axes(ORIGIN), arrow(point(1, 0), at=ORIGIN)).view == PLANE


def test_older_marks_take_the_places_of_a_system() -> None:
    assert [str(axis.label) for axis in axes(ORIGIN, l)] == ["x", "y"]
    assert len(axes(point(0, 0, 0))) == 3
    assert list(point_mark(point(l, 0)).at) == [l, 0]  # type: ignore[attr-defined]


def test_coordinates_of_the_run_are_drawn_at_angles_that_differ() -> None:
    with recorded():
        theta, phi, x = coordinate("theta"), coordinate("phi"), coordinate("x", "length")
        found = drawing("one", particle(hung(l, theta) + hung(l, phi) + point(x, 0)), values={x: l / 4})
    assert dict(found.coordinates) == {theta.symbol: "angle", phi.symbol: "angle", x.symbol: "length"}
    assert dict(found.values) == {theta.symbol: 34 * pi / 180, phi.symbol: 52 * pi / 180, x.symbol: l / 4}


def test_a_mark_rests_on_the_steps_behind_its_places() -> None:
    torque = known_block()["torque"]
    assert rod(torque, torque).keys == ("torque", "torque")
    assert particle(torque).keys == ("torque",)
    assert drawing("one", particle(ORIGIN)).keys == ()


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: rope(ORIGIN), "a rope needs two places or more"),
        (lambda: wedge(ORIGIN, TOP), "a wedge needs three corners or more"),
        (lambda: way(point(l, 0), a), "`letter` of `way` must be a symbol in `place`, but a is not"),
        (lambda: rod(ORIGIN, point(0, 0, 1)), "some places of a drawing have two components, and some have three"),
        (lambda: particle(l), "a drawing needs a vector or a place here, but the value is of type Symbol"),
        (lambda: angle_mark(ORIGIN, "below", TOP, "theta"), 'a drawing has no side "below"'),
    ],
)
def test_what_does_not_fit_is_refused(wrong: object, message: str) -> None:
    with pytest.raises(Rejected) as refused:
        wrong()  # type: ignore[operator]
    assert refused.value.complaints[0].message == message


def test_no_word_of_drawings_is_one_of_mechanics() -> None:
    """A script imports both: `point` is a place, and `point_mark` draws a point."""
    modules = (elements, scenes, sketches, bodies)
    words = {name for module in modules for name in module.__all__}
    assert {name for name in words if hasattr(derive.mechanics, name)} == set()


def test_a_drawing_of_parts_alone_fills_its_room() -> None:
    pieces = seen(drawing("one", particle(ORIGIN, m), particle(TOP), spring_mark(ORIGIN, TOP, k)))
    ys = [y for piece in pieces for _, y in piece.spots]
    assert max(ys) - min(ys) == pytest.approx(4.2 * 72 / 2.54, abs=0.1)
