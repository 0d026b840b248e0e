"""Labels are next to the things that they name and cover nothing else."""

from __future__ import annotations

from itertools import combinations
from math import cos, hypot, sin
from typing import Any

import pytest

from derive.figures.pieces import Bullet, Patch, Stroke, Tag
from derive.render.drawing.labels import STACKED, Placed, placed
from tests.figures.scenery import SCENES, pieces_of

WIDTH, HEIGHT = 12.0, 8.0


def labels(*pieces: Any) -> list[Placed]:
    return placed(pieces, lambda _: (WIDTH, HEIGHT))


def middle(label: Placed) -> tuple[float, float]:
    left, below, right, above = label.extent
    return (left + right) / 2, (below + above) / 2


def covers(label: Placed, x: float, y: float) -> bool:
    left, below, right, above = label.extent
    return left < x < right and below < y < above


def test_a_label_alone_stands_on_the_side_that_was_asked_for() -> None:
    for towards in ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0)):
        (label,) = labels(Tag("a", (0.0, 0.0), towards))
        x, y = middle(label)
        assert x * towards[0] + y * towards[1] > 0
        assert abs(x * towards[1] - y * towards[0]) < 1e-9
        assert not covers(label, 0, 0)
        assert label.corner == label.extent[:2]
        assert (label.extent[2] - label.extent[0], label.extent[3] - label.extent[1]) == (WIDTH, HEIGHT)


def test_a_label_evades_a_line_and_stays_near() -> None:
    line = Stroke(((-100.0, 9.0), (100.0, 9.0)), "edge")
    (label,) = labels(line, Tag("a", (0.0, 0.0), (0.0, 1.0)))
    assert not any(covers(label, x, 9.0) for x in range(-100, 101))
    assert hypot(*middle(label)) < 30


def test_a_label_evades_a_point() -> None:
    (free,) = labels(Tag("a", (0.0, 0.0), (1.0, 0.0)))
    spot = middle(free)
    (label,) = labels(Bullet(spot), Tag("a", (0.0, 0.0), (1.0, 0.0)))
    assert not covers(label, *spot)


def test_the_first_label_chooses_first_and_no_two_overlap() -> None:
    tags = [Tag(name, (0.0, 0.0), (1.0, 0.0)) for name in "abc"]
    found = labels(*tags)
    assert found[0] == labels(tags[0])[0]
    assert [label.label for label in found] == ["a", "b", "c"]
    for i, one in enumerate(found):
        for other in found[:i]:
            apart = [one.extent[n] >= other.extent[n + 2] or other.extent[n] >= one.extent[n + 2] for n in (0, 1)]
            assert any(apart)


def test_a_larger_gap_is_further_away() -> None:
    near, far = (labels(Tag("a", (0.0, 0.0), (1.0, 0.0), gap))[0] for gap in (3.0, 10.0))
    assert middle(far)[0] - middle(near)[0] == 7.0


def test_without_labels_nothing_is_placed() -> None:
    assert labels(Bullet((0.0, 0.0))) == []


@pytest.mark.parametrize("scene", SCENES)
def test_no_label_stands_on_another_and_every_label_is_near_what_it_names(scene: str) -> None:
    pieces = pieces_of(SCENES[scene]())
    labels = placed(pieces, lambda label: (6.0 * len(str(label)), 8.0))
    for one, other in combinations((label.extent for label in labels), 2):
        assert one[2] <= other[0] or other[2] <= one[0] or one[3] <= other[1] or other[3] <= one[1]
    tags = sorted((p for p in pieces if isinstance(p, Tag)), key=lambda tag: str(tag.label))
    for tag, _ in zip(tags, labels, strict=True):
        assert min(away(tag.spot, label) for label in labels if label.label == tag.label) < 25


def away(spot: tuple[float, float], label: Placed) -> float:
    left, below, right, above = label.extent
    x, y = spot
    return hypot(max(left - x, 0, x - right), max(below - y, 0, y - above))


def test_a_label_on_what_it_names_moves_aside_for_a_line() -> None:
    tag = Tag("a", (0.0, 0.0), (8.0, 0.0), on=True)
    (still,) = labels(tag)
    assert still.corner == (-still.extent[2], -still.extent[3])
    (moved,) = labels(Stroke(((0.0, -9.0), (0.0, 9.0)), "edge"), tag)
    assert abs(middle(moved)[0]) == 8.0


def test_what_a_surface_hides_is_in_the_way_of_no_label() -> None:
    line = Stroke(((0.0, -9.0), (0.0, 9.0)), "edge")
    cover = Patch(((-20.0, -20.0), (20.0, -20.0), (20.0, 20.0), (-20.0, 20.0)))
    tag = Tag("a", (0.0, 0.0), (8.0, 0.0), on=True)
    assert labels(line, cover, tag) == labels(tag)
    assert labels(cover, line, tag) != labels(tag)


@pytest.mark.parametrize("angle", [0.2, 0.8, 1.3, 2.4])
def test_the_label_of_a_line_does_not_touch_it(angle: float) -> None:
    end = 40 * cos(angle), 40 * sin(angle)
    tag = Tag("a", (end[0] / 2, end[1] / 2), (-sin(angle), cos(angle)), 3.0, (end[0] / 2, end[1] / 2))
    (label,) = labels(Stroke(((0.0, 0.0), end), "edge"), tag)
    left, below, right, above = label.extent
    corners = [(x, y) for x in (left, right) for y in (below, above)]
    sides = [-x * sin(angle) + y * cos(angle) for x, y in corners]
    assert min(sides) == pytest.approx(3.0)


def test_the_label_of_a_line_slides_along_it_past_another_label() -> None:
    line = Tag("a", (20.0, 0.0), (0.0, 1.0), 3.0, (40.0, 0.0))
    blocked = [Tag("b", (20.0, y), (8.0, 0.0), on=True) for y in (6.0, -6.0)]
    found = labels(*blocked, line)[-1]
    assert abs((found.extent[0] + found.extent[2]) / 2 - 20.0) > 3


def test_labels_with_few_places_choose_first_where_otherwise_something_would_be_covered() -> None:
    """The label of a line between two walls has one possible place. The label of a point next to the line would also
    choose this place."""
    walls = [Stroke(((x, -30.0), (x, 30.0)), "edge") for x in (-17.0, 17.0)]
    point, line = Tag("p", (0.0, 20.0), (0.0, -1.0)), Tag("q", (0.0, -4.0), (0.0, 1.0), 3.0, (0.0, 0.1))
    blocked = Stroke(((-17.0, -6.0), (17.0, -6.0)), "edge")
    found = {each.label: each for each in labels(*walls, blocked, point, line)}
    one, other = found["p"].extent, found["q"].extent
    assert one[1] >= other[3] or other[1] >= one[3] or one[0] >= other[2] or other[0] >= one[2]
    assert not any(covers(found["q"], x, -6.0) for x in range(-17, 18))


def test_the_label_of_a_line_stands_nearer_to_it_than_to_another() -> None:
    """At its preferred place, the label would be close to another line."""
    own, other = Stroke(((-50.0, 0.0), (50.0, 0.0)), "edge"), Stroke(((-50.0, 13.0), (50.0, 13.0)), "edge")
    tag = Tag("a", (0.0, 0.0), (0.0, 1.0), way=(40.0, 0.0))
    (alone,) = labels(own, tag)
    (beside,) = labels(own, other, tag)
    assert middle(alone)[1] > 0 > middle(beside)[1]


def test_a_label_does_not_touch_the_edge_of_a_wide_line() -> None:
    rod, tag = Stroke(((-100.0, 0.0), (100.0, 0.0)), "rod"), Tag("a", (0.0, 10.0), (0.0, -1.0), 0.0)
    (label,) = placed((rod, tag), lambda _: (WIDTH, 6.0), lambda _: 8.0)
    assert label.extent[1] > 4.0 or label.extent[3] < -4.0


def test_two_labels_in_one_row_are_so_far_apart_that_they_do_not_read_as_a_product() -> None:
    one, other = labels(Tag("a", (0.0, 0.0), (1.0, 0.0)), Tag("b", (16.0, 0.0), (1.0, 0.0)))
    apart = max(one.extent[0], other.extent[0]) - min(one.extent[2], other.extent[2])
    assert apart >= 7.0 or abs(middle(one)[1] - middle(other)[1]) > HEIGHT / 2


def test_a_label_that_has_no_room_on_its_block_is_above_the_block() -> None:
    edges = [Stroke(((-11.0, y), (11.0, y)), "edge") for y in (-2.0, 2.0)]
    (label,) = labels(*edges, Tag("M", (0.0, 0.0), (6.0, 0.0), on=True, outside=5.0))
    assert label.extent[1] > 2.0


def test_labels_above_one_another_do_not_look_like_a_fraction() -> None:
    """The lower label moves away, although its preferred position is free."""
    tags = [Tag("a", (0.0, 0.0), (0.0, 1.0)), Tag("b", (0.0, 20.0), (0.0, -1.0))]
    one, other = (each.extent for each in placed(tags, lambda _: (6.0, 6.0)))
    is_apart = max(one[1], other[1]) - min(one[3], other[3]) >= STACKED
    assert is_apart or min(one[2], other[2]) - max(one[0], other[0]) <= 3.0


def test_the_cost_of_a_label_on_a_line_is_greater_than_that_of_a_free_label() -> None:
    (free,) = placed([Tag("a", (0.0, 0.0), (0.0, 1.0))], lambda _: (6.0, 6.0))
    fence = [Stroke(((x, -40.0), (x, 40.0)), "edge") for x in range(-40, 41, 4)]
    (fenced,) = placed([*fence, Tag("a", (0.0, 0.0), (0.0, 1.0))], lambda _: (6.0, 6.0))
    assert free.cost == 0 and fenced.cost > 10
