"""Drawings are encoded as JSON and decoded without change; other data are rejected."""

from __future__ import annotations

import json

import pytest

from derive.algebra.expressions import column
from derive.figures import drawing, outline, plot, point_mark
from derive.figures.annotations import PointMark
from derive.figures.encoding import drawings_from_data, drawings_to_data
from derive.figures.marks import Drawing
from tests.figures.scenery import CONE, SLAB, a, h, leaning, vectors_of_block
from tests.mechanics.block import known_block


def test_drawings_go_to_json_and_back_unchanged() -> None:
    scenes = [
        vectors_of_block(),
        drawing("cone", outline(CONE), point_mark(column(0, 0, h / 4), "C")),
        leaning(weights=True),
        SLAB,
        plot("torque", known_block()["magnitude"], a, (1, 2), of="length"),
    ]
    assert list(drawings_from_data(json.loads(json.dumps(drawings_to_data(scenes))))) == scenes


def test_data_are_plain_json_and_every_mark_says_what_it_is() -> None:
    (data,) = drawings_to_data([drawing("one", point_mark(column(0, 0, h / 4), "C"))])
    assert (data["is"], data["key"], [mark["is"] for mark in data["marks"]]) == ("Drawing", "one", ["PointMark"])
    assert json.loads(json.dumps(data)) == data


def test_what_cannot_be_kept_is_no_part_of_a_drawing() -> None:
    with pytest.raises(TypeError, match="set has no encoding"):
        drawings_to_data([Drawing("one", (PointMark(column(0, 0, 0), label={1}),))])
