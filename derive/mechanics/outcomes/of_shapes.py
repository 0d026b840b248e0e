"""What must be true for each word that chooses a sentence about bodies told by a map, and about those made of parts."""

from __future__ import annotations

from typing import Any

from derive.algebra.expressions import explicit
from derive.mechanics.bodies.mapping import inside
from derive.mechanics.bodies.parts import turns_right_handed
from derive.mechanics.outcomes.of_bodies import TENSORS
from derive.mechanics.outcomes.signs import lasts, vanishes
from derive.steps.outcomes import Judged, Predicate, outcomes_of, told_by
from derive.steps.step import is_zero


def _with_variables(n: int) -> Predicate:
    return lambda facts: len(facts.inputs["limits"]) == n


def _cell_is_positive(facts: Judged, outcome: str) -> bool:
    """The cell that is told has the square that was found, or is the product or its opposite, and has one sign."""
    size, limits = facts.inputs["cell"], facts.inputs["limits"]
    found = explicit(facts.result)
    squares = (found**2 if outcome == "solid" else found, size**2)
    looked = inside(limits, size.free_symbols)
    return is_zero(squares[0] - squares[1]) and all(bool(size.xreplace(at).evalf() > 0) for at in looked)


def _of_filling(filling: str) -> Predicate:
    return lambda facts: facts.subject.body.filling == filling


def _all_is_added(facts: Judged) -> bool:
    return all(part.sign > 0 for part in facts.subject.body.parts)


def _moved(moved: bool, turned: bool) -> Predicate:
    """Whether there is a way to the part, and whether its axes are not those of the whole."""

    def is_so(facts: Judged) -> bool:
        way, turn = facts.inputs.get("way"), facts.inputs["turn"]
        return (way is not None and not is_zero(way)) == moved and (not turn.is_Identity) == turned

    return is_so


def _beside_the_axis(facts: Judged) -> bool:
    """Whether the mean place of the particles of some part is beside the axis."""
    about, k = facts.subject.point, "xyz".index(str(facts.subject.axis))
    for part in facts.subject.body.parts:
        mean = sum((m * about.seen(r) for m, r in part.particles), start=about.position * 0) / part.mass
        if not is_zero(sum(x**2 for i, x in enumerate(mean) if i != k)):
            return True
    return False


def _with_moments(facts: Judged) -> int:
    return sum(role.startswith("part_") for role in facts.inputs)


def _is_flat(facts: Judged) -> bool:
    """No particle is off the plane that is spoken of, and the moment is about an axis in it."""
    body = facts.subject.body
    return all(is_zero(place[2]) for _, place in body.particles()) and facts.subject.axis in ("x", "y")


def _on_its_axis(facts: Judged) -> bool:
    places = [place for _, place in facts.subject.body.particles()]
    return facts.subject.axis == "z" and all(is_zero(place[0]) and is_zero(place[1]) for place in places)


def _part_of_sign(sign: int) -> Predicate:
    """The part has the name that is told; what is cut out counts as negative."""
    return lambda facts: facts.inputs["sign"] == sign and facts.words["part"] == facts.inputs["part_of"].called


_TABLE: dict[str, dict[str, Predicate]] = {
    "bodies.cell_of": {"curve": _with_variables(1), "surface": _with_variables(2), "solid": _with_variables(3)},
    "bodies.size_by_integration": {word: _of_filling(word) for word in ("length", "area", "volume")},
    "rotation.turned_tensor": TENSORS,
    "rotation.tensor_of_parts": TENSORS,
    "rotation.share_of_mass": {
        "part": _part_of_sign(1),
        "hole": _part_of_sign(-1),
    },
    "rotation.centre_of_parts": {"generic": _all_is_added, "cut_out": lambda facts: not _all_is_added(facts)},
    "rotation.tensor_of_part": {
        "turned_there": _moved(False, True),
        "moved": _moved(True, False),
        "turned_moved": _moved(True, True),
    },
    "rotation.own_moment": {"none": _on_its_axis, "flat": _is_flat},
    "rotation.moment_of_parts": {
        "moved": _beside_the_axis,
        "on_axis": lambda facts: not _beside_the_axis(facts) and _with_moments(facts) != 1,
        "alone": lambda facts: not _beside_the_axis(facts) and _with_moments(facts) == 1,
    },
    "rotation.tensor_entry": {
        "moment": lambda facts: len(set(facts.words["entry"])) == 1,
        "product": lambda facts: len(set(facts.words["entry"])) == 2,
    },
    "rotation.principal_angle": {"generic": lasts, "zero": vanishes},
}

for _rule, _predicates in _TABLE.items():
    outcomes_of(_rule, _predicates)


def _edges_along_the_axes(facts: Judged, outcome: str) -> bool:
    """Where edges are spoken of every coordinate has limits of its own."""
    if "edged" not in facts.words:
        return True
    body = facts.subject.body
    region = body.region(body.point(body.reference))
    ends = {s for _, *limits in region.limits for end in limits for s in end.free_symbols}
    return not ends & set(region.names) and region.element == 1


def _turned_as_told(facts: Judged, outcome: str) -> bool:
    return turns_right_handed(facts.inputs["turn"], facts.words["along"], facts.inputs["angle"])


def _inward(facts: Judged, outcome: str) -> bool:
    """Only of a tensor that is not about the centre of mass it is not said that it is."""
    about_centre = facts.words.get("about") in {"centre", "centre_of_mass"}
    return about_centre != (outcome == "outward") and _edges_along_the_axes(facts, outcome)


_TOLD: dict[str, Any] = {
    "bodies.cell_of": _cell_is_positive,
    "rotation.turned_tensor": _turned_as_told,
    "rotation.inertia_tensor": _edges_along_the_axes,
    "rotation.moved_to": _inward,
}

for _rule, _told in _TOLD.items():
    told_by(_rule, _told)
