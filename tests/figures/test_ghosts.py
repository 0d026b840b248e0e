"""Tests of dashed outlines at another value of a coordinate."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import symbols

from derive.errors import Rejected
from derive.figures import dashed_at, sketch
from derive.figures.ghosts import Ghost
from derive.mechanics import Plate, System, coordinate, point, weight
from derive.page.depiction import alternative
from derive.page.template import templates_of
from derive.page.wording import phrases
from derive.render.notation.notation import Notation
from derive.render.printing.text_page import inline_text
from derive.steps.record import recorded
from tests.courses import ROOT
from tests.figures.machines import of
from tests.figures.scenery import pieces_of, strokes

a, M, g = symbols("a M g", positive=True)


def tilted(values: Any = None) -> Any:
    with recorded():
        theta = coordinate("theta")
        plate = Plate((4 * a, a), M).placed(theta, point(0, 3 * a))
        system = System(plate, weight(g))
        return sketch("plate", system, dashed_at(system, {theta: 0} if values is None else values))


def test_the_plate_is_dashed_where_it_would_be_level() -> None:
    found = tilted()
    (ghost,) = of(found, Ghost)
    corners = [tuple(corner) for corner in ghost.of.corners]
    assert {y for _, y in corners} == {5 * a / 2, 7 * a / 2}
    assert len({x for x, _ in corners}) == 2
    (dashed,) = [each for each in strokes(pieces_of(found), "trace") if len(each.spots) == 5]
    assert len({round(y, 6) for _, y in dashed.spots}) == 2


def test_it_is_told_where_that_is() -> None:
    told = inline_text(alternative(None, tilted(), None, phrases(templates_of(ROOT))), Notation())  # type: ignore[arg-type]
    assert "a plate dashed where θ is 0" in told


@pytest.mark.parametrize("values", [{}, {a: 0}], ids=["none", "a constant"])
def test_only_a_coordinate_has_another_value(values: Any) -> None:
    with pytest.raises(Rejected, match="one coordinate"):
        tilted(values)
