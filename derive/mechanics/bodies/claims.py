"""Predicates of bodies: each decides whether an outcome, or a fact in the sentence of an outcome, is correct."""

from __future__ import annotations

import re
from typing import Any

from sympy import (
    Integer,
    Matrix,
    Symbol,
    diff,
    integrate,
    pi,
)

from derive.algebra.expressions import AXES, explicit
from derive.algebra.tidy import tidied
from derive.mechanics.bodies.equimomental import counted_from
from derive.mechanics.bodies.facts import CountedFrom
from derive.mechanics.bodies.mapping import inside
from derive.steps.claims import both, is_negative, lasts, negated, vanishes
from derive.steps.rule import Judged, Predicate, handed_on_by
from derive.steps.step import Quantity, is_zero


def dimensions_of_filling(n: int) -> Predicate:
    def is_so(facts: Judged) -> bool:
        body = facts.subject.body
        return len(body.region(body.point(body.reference)).with_section_put_in().limits) == n

    return is_so


def has_edges(facts: Judged) -> bool:
    """Whether the body is a box with a corner at the origin: it has three variables, all limits are constant, the lower
    limits are zero, and the volume element is 1."""
    body = facts.subject.body
    region = body.region(body.point(body.reference))
    names = set(region.names)
    own = [lower == 0 and not (upper.free_symbols & names) for _, lower, upper in region.limits]
    return len(own) == 3 and all(own) and region.element == 1


def is_symmetric_about_its_centre(facts: Judged) -> bool:
    """Whether the third moment about the centre of mass vanishes along a generic direction, by integration."""
    body = facts.subject.body
    return is_zero(body.over_mass(lambda r: (71 * r[0] + 113 * r[1] + 29 * r[2]) ** 3, body.middle))


def is_by_integration(facts: Judged) -> bool:
    """Whether the first moment of the mass about the result vanishes, by integration."""
    subject = facts.subject
    return is_zero(subject.body.over_mass(lambda r: r - facts.result, subject.point))


def counted_along_one_axis(facts: Judged) -> bool:
    return facts.symbol.name[-1] in AXES


def on_the_axis(facts: Judged) -> bool:
    return is_zero(facts.result[0]) and is_zero(facts.result[1]) and is_round(facts)


def is_of_a_ball(facts: Judged) -> bool:
    """Whether the square of the result is a quadratic polynomial in z with the leading coefficient -1, as for a
    ball."""
    square = explicit(facts.result) ** 2
    along = facts.inputs["along"]
    in_powers = square.as_poly(along)
    return in_powers is not None and in_powers.degree() == 2 and bool(in_powers.LC() == -1)


def along_the_edge(facts: Judged) -> bool:
    named = "xyz".find(facts.words.get("axis", "?"))
    return named >= 0 and all(bool(x == int(k == named)) for k, x in enumerate(facts.result))


def joins_corners(facts: Judged) -> bool:
    """Whether the result is the vector from the corner at the origin to the opposite corner of the region."""
    body = facts.subject.body
    limits = body.region(body.point(body.reference)).limits
    return len(limits) == 3 and all(is_zero(x - (b - a)) for x, (_, a, b) in zip(facts.result, limits, strict=True))


def is_round(facts: Judged) -> bool:
    """Whether the moments of inertia of the particles about x and y through the centre of mass are equal, and all
    products of inertia vanish."""
    body = facts.subject.body
    centre = body.middle
    places = [(m, counted_from(centre, r)) for m, r in body.particles()]
    across = sum((m * (r[0] ** 2 - r[1] ** 2) for m, r in places), Integer(0))
    products = [sum((m * r[i] * r[j] for m, r in places), Integer(0)) for i, j in ((0, 1), (0, 2), (1, 2))]
    return is_zero(across) and all(is_zero(product) for product in products)


def facts_counted_from(facts: Judged, fact: CountedFrom) -> bool:
    """Whether later steps measure from the point that the sentence names, if it names a point."""
    return facts.words.get("start", fact.start.name) == fact.start.name


def size_of_a_cell(facts: Judged, size: Any) -> bool:
    """Whether the stated size is the size of a cell, and is not known to be negative. For a solid, the result is this
    size up to its sign; otherwise, the result is the square of this size."""
    square = explicit(facts.result) ** 2 if len(facts.inputs["limits"]) == 3 else explicit(facts.result)
    return is_zero(explicit(size) ** 2 - square) and not is_negative(explicit(size))


def mapped_to(facts: Judged, place: Any) -> bool:
    """Whether the result is det(r_i . r_j), or, for a solid, the result squared is this determinant. Here r_i is the
    derivative of the place with respect to variable i."""
    names = [x for x, _, _ in facts.inputs["limits"]]
    slopes = Matrix([[diff(c, x) for x in names] for c in explicit(place)])
    square = explicit(facts.result) ** 2 if len(names) == 3 else explicit(facts.result)
    return is_zero((slopes.T * slopes).det() - square)


def variable_of_the_map(facts: Judged, x: Any) -> bool:
    told = [facts.inputs[f"u_{k}"] for k in range(len(facts.inputs["limits"]))]
    moved = any(not is_zero(diff(c, x)) for c in explicit(facts.inputs["place"]))
    return moved and told == [name for name, _, _ in facts.inputs["limits"]]


def proportional_to(facts: Judged, profile: Any) -> bool:
    ratio = tidied(explicit(facts.result) / explicit(profile))
    return not ratio.free_symbols & {x for x, *_ in facts.subject.body.map()[1]}


def with_variables(n: int) -> Predicate:
    return lambda facts: len(facts.inputs["limits"]) == n


def cell_is_positive(facts: Judged, outcome: str) -> bool:
    """Whether the stated size of a cell is positive at random points. For a solid, the result must be this size up to
    its sign; otherwise, the result must be the square of this size."""
    size, limits = facts.inputs["cell"], facts.inputs["limits"]
    found = explicit(facts.result)
    squares = (found**2 if outcome == "solid" else found, size**2)
    looked = inside(limits, size.free_symbols)
    return is_zero(squares[0] - squares[1]) and all(bool(size.xreplace(at).evalf() > 0) for at in looked)


def of_filling(filling: str) -> Predicate:
    return lambda facts: facts.subject.body.filling == filling


def volume_of_its_sections(facts: Judged, outcome: str) -> bool:
    """Whether the result is the integral of the cross-sectional area over the height."""
    body, z = facts.subject.body, Symbol("z_along", real=True)
    sections = integrate(pi * body.radius_at(z) ** 2, (z, *body.ends))
    return is_zero(sections - explicit(facts.result))


def section_as_told(facts: Judged, outcome: str) -> bool:
    """Whether the sentence names the point from which the result is measured. If the sentence states x = s cos(phi)
    and y = s sin(phi), these formulas must give the area element of the integral, and x = s at phi = 0."""
    if ("polar" in facts.words) != ("x_is" in facts.inputs):
        return False
    if "x_is" in facts.inputs:
        (_, phi, s), x, y = facts.inputs["names"], facts.inputs["x_is"], facts.inputs["y_is"]
        area = diff(x, s) * diff(y, phi) - diff(x, phi) * diff(y, s)
        if not is_zero(area - facts.inputs["element"]) or not is_zero(x.subs(phi, 0) - s):
            return False
    return counted_from_its_point(facts, outcome)


def counted_from_its_point(facts: Judged, outcome: str) -> bool:
    """Whether the sentence names the point from which the result is measured."""
    return facts.words["start"] == getattr(facts.subject.point, "name", facts.words["start"])


def from_its_point_along_the_axis(facts: Judged, outcome: str) -> bool:
    axis = facts.inputs["along"].name
    along = axis in re.split(r"[_,]", facts.symbol.name) and (outcome != "on_axis" or axis == "z")
    return counted_from_its_point(facts, outcome) and along


def axis_as_named(facts: Judged, outcome: str) -> bool:
    return outcome != "diagonal" or facts.words["axis"] == outcome


density_volume: Predicate = both(dimensions_of_filling(3), negated(has_edges))


def density_derived(facts: Judged) -> bool:
    return bool(isinstance(facts.quantities.get("extent"), Quantity))


def volume_cylindrical(facts: Judged) -> bool:
    return bool(facts.inputs["element"] == facts.inputs["radius"])


def section_radius_straight(facts: Judged) -> bool:
    return is_zero(diff(facts.result, facts.inputs["along"], 2))


section_radius_curved: Predicate = negated(section_radius_straight)


centre_of_mass_by_components: Predicate = both(is_by_integration, lasts)


centre_of_mass_there: Predicate = both(is_by_integration, vanishes)


handed_on_by(CountedFrom, facts_counted_from)
