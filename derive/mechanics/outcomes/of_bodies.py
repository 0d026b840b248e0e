"""What must be true for each word that chooses a sentence about a body, a tensor or its principal axes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Integer, diff
from sympy import diag as diagonal

from derive.algebra.expressions import AXES, explicit
from derive.algebra.tidy import tidied
from derive.mechanics.bodies.equimomental import counted_from
from derive.mechanics.outcomes.signs import lasts
from derive.steps.outcomes import Judged, Predicate, outcomes_of
from derive.steps.step import Quantity, is_zero


def _dimensions_of_filling(n: int) -> Predicate:
    def is_so(facts: Judged) -> bool:
        body = facts.subject.body
        return len(body.region(body.point(body.reference)).with_section_put_in().limits) == n

    return is_so


def _has_edges(facts: Judged) -> bool:
    """Whether every coordinate has limits of its own, from zero: a box whose origin is at a corner."""
    body = facts.subject.body
    region = body.region(body.point(body.reference))
    names = set(region.names)
    own = [lower == 0 and not (upper.free_symbols & names) for _, lower, upper in region.limits]
    return len(own) == 3 and all(own) and region.element == 1


def _is_symmetric_about_its_centre(facts: Judged) -> bool:
    """No third moment about the centre of mass is left along a direction of no symmetry, by integration."""
    body = facts.subject.body
    return is_zero(body.over_mass(lambda r: (71 * r[0] + 113 * r[1] + 29 * r[2]) ** 3, body.middle))


def _is_away_from_the_centre(facts: Judged) -> bool:
    return not is_zero(facts.subject.body.over_mass(lambda r: r, facts.subject.point))


def _is_by_integration(facts: Judged) -> bool:
    """Seen from there, the mass has no first moment."""
    subject = facts.subject
    return is_zero(subject.body.over_mass(lambda r: r - facts.result, subject.point))


def _counted_along_one_axis(facts: Judged) -> bool:
    return facts.symbol.name[-1] in AXES


def _on_the_axis(facts: Judged) -> bool:
    return is_zero(facts.result[0]) and is_zero(facts.result[1]) and _is_round(facts)


def _is_of_a_ball(facts: Judged) -> bool:
    """The square of the radius is R^2 less the square of the distance from some place on the axis."""
    square = explicit(facts.result) ** 2
    along = facts.inputs["along"]
    in_powers = square.as_poly(along)
    return in_powers is not None and in_powers.degree() == 2 and bool(in_powers.LC() == -1)


def _along_the_edge(facts: Judged) -> bool:
    named = "xyz".find(facts.words.get("axis", "?"))
    return named >= 0 and all(bool(x == int(k == named)) for k, x in enumerate(facts.result))


def _joins_corners(facts: Judged) -> bool:
    """From the corner at the origin through the centre, as far again: by the region's limits."""
    body = facts.subject.body
    limits = body.region(body.point(body.reference)).limits
    return len(limits) == 3 and all(is_zero(x - (b - a)) for x, (_, a, b) in zip(facts.result, limits, strict=True))


def _entry(*pairs: str, round_body: bool = False) -> Predicate:
    """Which entry of a tensor it is, by its letter; of a round body, that it is round by its particles."""

    def is_so(facts: Judged) -> bool:
        return facts.symbol.name[-2:] in pairs and (not round_body or _is_round(facts))

    return is_so


def _is_mirrored(facts: Judged) -> bool:
    """A moment of a body of which nothing that is odd in x, in y or in z is left by integration."""
    body, point = facts.subject.body, facts.subject.point
    odd = [body.over_mass(lambda r, k=k: r[k] * (1 + 7 * r[k - 1] + 11 * r[k - 2]) ** 2, point) for k in range(3)]
    return bool(_entry("xx", "yy", "zz")(facts)) and all(is_zero(each) for each in odd)


def _is_round(facts: Judged) -> bool:
    """Whether the particles of the body have the same moment about x and y, and no product, seen from its centre."""
    body = facts.subject.body
    centre = body.middle
    places = [(m, counted_from(centre, r)) for m, r in body.particles()]
    across = sum((m * (r[0] ** 2 - r[1] ** 2) for m, r in places), Integer(0))
    products = [sum((m * r[i] * r[j] for m, r in places), Integer(0)) for i, j in ((0, 1), (0, 2), (1, 2))]
    return is_zero(across) and all(is_zero(product) for product in products)


def _different(values: Iterable[Expr]) -> int:
    found: list[Expr] = []
    for value in values:
        if not any(is_zero(value - other) for other in found):
            found.append(value)
    return len(found)


def _products_vanish(tensor: Any) -> bool:
    return all(is_zero(tensor[i, j]) for i in range(3) for j in range(3) if i != j)


def _moments_of(tensor: Any) -> list[Expr]:
    return [tensor[k, k] for k in range(3)]


def _tensor(different: int | None, round_body: bool = False) -> Predicate:
    """A diagonal tensor with so many different moments; None for one that is not diagonal."""

    def is_so(facts: Judged) -> bool:
        tensor = facts.result
        if different is None:
            return not _products_vanish(tensor)
        if round_body and not (is_zero(tensor[0, 0] - tensor[1, 1]) and _is_round(facts)):
            return False
        return _products_vanish(tensor) and _different(_moments_of(tensor)) == different

    return is_so


TENSORS = {"generic": _tensor(None), "diagonal": _tensor(3), "two_equal": _tensor(2), "isotropic": _tensor(1)}


_ROUND_TENSORS = {"round": _tensor(2, round_body=True), "round_isotropic": _tensor(1, round_body=True)}


def _moments(different: int, diagonal: bool) -> Predicate:
    return lambda facts: _different(facts.result) == different and _products_vanish(facts.inputs["inertia"]) == diagonal


def _axis_of(different: int, alone: bool | None = None) -> Predicate:
    """Of how many different moments the axis is; whether its own is the single one of three of which two are equal."""

    def is_so(facts: Judged) -> bool:
        moments, k = facts.inputs["moments"], int(facts.symbol.name[-1]) - 1
        twins = sum(is_zero(moments[k] - other) for other in moments)
        return _different(moments) == different and (alone is None or (twins == 1) == alone)

    return is_so


def _axis_of_symmetry(facts: Judged) -> bool:
    along = all(bool(x == int(k == 2)) for k, x in enumerate(facts.result))
    return bool(_axis_of(2, alone=True)(facts)) and along and _is_round(facts)


def _moments_compared(wanted: str) -> Predicate:
    """Equal moments; or one that is always the greater; else the relation says where they are equal."""

    def is_so(facts: Judged) -> bool:
        moments = facts.inputs["moments"]
        apart = [tidied(a - b) for a in moments for b in moments if not is_zero(a - b)]
        if wanted == "always":
            return not apart
        signed = bool(apart) and all(bool(d.is_positive or d.is_negative) for d in apart)
        if wanted == "never":
            return signed
        letter, value = facts.result.sides
        return bool(apart) and not signed and all(is_zero(d.subs(letter, value)) for d in apart)

    return is_so


_HALF_TURN_ABOUT_X = ImmutableDenseMatrix(diagonal(1, -1, -1))

_TABLE: dict[str, dict[str, Predicate]] = {
    "bodies.density": {
        "along_edges": _has_edges,
        "volume": lambda facts: _dimensions_of_filling(3)(facts) and not _has_edges(facts),
        "area": _dimensions_of_filling(2),
        "length": _dimensions_of_filling(1),
        "derived": lambda facts: isinstance(facts.quantities.get("extent"), Quantity),
    },
    "bodies.volume": {"cylindrical": lambda facts: facts.inputs["element"] == facts.inputs["radius"]},
    "bodies.section_radius": {
        "straight": lambda facts: is_zero(diff(facts.result, facts.inputs["along"], 2)),
        "ball": _is_of_a_ball,
        "curved": lambda facts: not is_zero(diff(facts.result, facts.inputs["along"], 2)),
    },
    "bodies.centre_of_mass": {
        "generic": _is_symmetric_about_its_centre,
        "by_components": lambda facts: _is_by_integration(facts) and not is_zero(facts.result),
        "there": lambda facts: _is_by_integration(facts) and is_zero(facts.result),
        "round": _on_the_axis,
    },
    "bodies.centre_component": {"on_axis": _is_round, "generic": _counted_along_one_axis},
    "bodies.axis_vector": {"diagonal": _joins_corners, "edge": _along_the_edge, "components": lasts},
    "rotation.entry": {
        "moment": _entry("xx", "yy", "zz"),
        "product": _entry("xy", "xz", "yz"),
        "mirrored": _is_mirrored,
        "across": _entry("xx", round_body=True),
        "along": _entry("zz", round_body=True),
    },
    "rotation.entry_moved": {
        "moment": _entry("xx", "yy", "zz"),
        "product": _entry("xy", "xz", "yz"),
        "across": _entry("xx", round_body=True),
        "along": _entry("zz", round_body=True),
        "outward": _entry("xx", "yy", "zz", "xy", "xz", "yz"),
    },
    "rotation.inertia_tensor": {**TENSORS, **_ROUND_TENSORS},
    "rotation.moved_to": {**TENSORS, **_ROUND_TENSORS, "outward": _is_away_from_the_centre},
    "rotation.agreement": {
        "generic": lambda facts: bool(facts.inputs["turn"].is_Identity),
        "turned": lambda facts: facts.inputs["turn"] == _HALF_TURN_ABOUT_X,
    },
    "rotation.principal_moments": {
        "isotropic": _moments(1, diagonal=True),
        "two_equal": _moments(2, diagonal=True),
        "distinct": _moments(3, diagonal=True),
        "two_equal_roots": _moments(2, diagonal=False),
        "roots": _moments(3, diagonal=False),
    },
    "rotation.principal_axis": {
        "single": _axis_of(2, alone=True),
        "symmetry": _axis_of_symmetry,
        "free": _axis_of(2, alone=False),
        "any": _axis_of(1),
        "distinct": _axis_of(3),
    },
    "rotation.isotropic_where": {word: _moments_compared(word) for word in ("special", "always", "never")},
    "rotation.principal_tensor": {"generic": _tensor(3), "two_equal": _tensor(2), "isotropic": _tensor(1)},
}

for _rule, _predicates in _TABLE.items():
    outcomes_of(_rule, _predicates)
