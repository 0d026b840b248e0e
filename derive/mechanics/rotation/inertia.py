"""The inertia tensor about a point by integration, and about other points by the parallel-axis theorem.

I_ij = integral of (r.r delta_ij - r_i r_j) dm, in kg m^2, is a symmetric (3, 3) tensor along the body axes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

from sympy import Expr, Identity, ImmutableDenseMatrix, Integer, MatAdd, MatrixBase, MatrixSymbol, cos, sin

from derive.algebra.expressions import (
    AXES,
    Cross,
    Dot,
    Factors,
    Outer,
    Terms,
    column,
    component_names,
    explicit,
    scalar,
    scaled,
    tensor,
    vector,
)
from derive.algebra.length import length
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.body import Body
from derive.mechanics.bodies.components import over_mass
from derive.mechanics.bodies.equimomental import squared_distance
from derive.mechanics.bodies.facts import AboutPoint, CountedFrom, Integrated, OfBody
from derive.mechanics.bodies.regions import Point, Region
from derive.mechanics.rotation import claims
from derive.mechanics.rotation.tensors import shape_of
from derive.mechanics.theorems import PARALLEL_AXES
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.level import Level, Manner
from derive.steps.rule import CHECK, GENERIC, ROUTE, Quote, Rule, Shown, anything
from derive.steps.step import Quantity, compared_with, entry_name, is_zero
from derive.steps.subject import Subject

__all__ = ["agreement", "inertia_tensor", "moment_of_inertia", "moved_from_centre", "moved_to"]

Moment: TypeAlias = Quantity
Pair = tuple[int, int]

PAIRS: tuple[Pair, ...] = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))  # moments of inertia, then products
MIRRORED: tuple[Pair, ...] = PAIRS[:3]  # the entries that remain if the planes normal to the axes are mirror planes
ACROSS_PLANE: Pair = (2, 2)  # the moment of a body in the x-y plane about the normal of this plane
ROUND: tuple[Pair, ...] = ((0, 0), (2, 2))  # the distinct entries that remain by symmetry about the z axis


INERTIA_TENSOR = Rule(
    "rotation.inertia_tensor",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
    outcomes={**claims.TENSORS, **claims.ROUND_TENSORS},
    evidence={"definition": CHECK, "balanced": CHECK, "particles": ROUTE, "quadrature": CHECK},
    statements=[claims.edges_along_the_axes],
    shown=Shown(brief=Manner.LEFT_OUT, standard=Manner.LEFT_OUT),
)


def inertia_tensor(
    body: Body,
    about: str = "centre",
    coordinates: str | None = None,
    symbol: str | None = None,
    key: str | None = None,
) -> Quantity:
    """Inertia tensor about a point, J = integral of (r.r 1 - r r) dm.

    body         a body with mass M
    about        a named point of the body: "centre", "corner", "apex", ...
    coordinates  the coordinates of integration, "cartesian" or "cylindrical", if the body has both

    The axes are the body axes. In general, a step derives each of the six entries. If the body is round about z and the
    point is on this axis, steps derive only the two distinct entries that symmetry leaves. If three mirror planes
    through the point are normal to the axes, steps derive only the moments. For a composite body, the tensors of its
    parts are added instead.
    Second route: the moment about any axis n is the sum of m |n x r|^2 over equimomental particles. For a body defined
    by a position map, a check takes the place of this route: a numerical sum over the cells of the body.
    Checks: these particles or cells have the centre of mass of the body. Unless a position map defines the body, the
    tensor is also equal to the integral that defines it.
    Outcomes: isotropic (the same about every axis), two_equal (diagonal, two moments equal), diagonal, generic; round
    or round_isotropic, if steps derive only two entries.
    Errors: the body has no such point or no such coordinates.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3.
    """
    point = body.point(about)
    name = symbol or ("I" if about == "centre" else "J")
    key = key or "inertia_tensor"
    in_its_way = body.derived_tensor(point, name, key)
    if in_its_way is not None:
        return in_its_way
    region = body.within(point, coordinates)
    by_definition = _definition(body, point, region, name, key)
    pairs = pairs_left_by_symmetry(body, point)
    entries: dict[Pair, Quantity] = {}
    for pair in pairs:
        if pair == ACROSS_PLANE and (1, 1) in entries and _lies_in_plane(body, point):
            entries[pair] = _entry_of_flat(body, point, name, key, entries)
        else:
            entries[pair] = _entry_by_integration(body, point, region, name, key, pair, by_definition)
    n, place = column(*component_names("n")), point.seen(body.middle.position)
    (balanced,) = body.another_way(lambda r: r, point, of=lambda _: body.mass * place).values()
    return establish(
        INERTIA_TENSOR,
        tensor(name),
        lambda *found: _assembled(pairs, found),
        _by_pair(entries),
        routes={
            **({"definition": compared_with(lambda: by_definition.value)} if body.is_of_particles else {}),
            "balanced": balanced,
            **body.another_way(lambda r: squared_distance(r, n), point, of=lambda found: explicit(Dot(n, found * n))),
        },
        outcome=_round_shape if pairs == ROUND else shape_of,
        kind="moment of inertia",
        lines=Lines(law=Level.FULL, put_in=None),
        facts=[OfBody(body), AboutPoint(point)],
        phrase_data=PhraseData(words={"about": point.name, **_edged(body), **_mirrored(pairs)}),
        key=key,
        scope=Scope(about=Subject(body=body, point=point)),
    )


def _mirrored(pairs: tuple[Pair, ...]) -> dict[str, str]:
    """Return the word `mirrored` for the sentence if mirror symmetry leaves only the moments."""
    return {"mirrored": "centre"} if pairs == MIRRORED else {}


def _edged(body: Body) -> dict[str, str]:
    """Return the word `edged` for the sentence if the axes of the body are along edges from a corner."""
    return {"edged": "corner"} if body.reference == "corner" else {}


def moment_of_inertia(
    body: Body, axis: str = "z", about: str = "centre", symbol: str = "I", key: str = "moment_of_inertia"
) -> Quantity:
    """Moment of inertia about an axis through a point, I = integral of d^2 dm with the distance d from the axis.

    body    a body with mass M
    axis    "x", "y" or "z": the moment is about an axis parallel to this body axis
    about   a named point of the body on the axis of the moment

    Second route: the sum of m d^2 over equimomental particles. Check: for a body defined by a position map, a numerical
    sum over its cells takes the place of the second route.
    The moment of a composite body is derived from its parts.
    Errors: there is no such axis; the body has no such point.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, section 7.3.
    """
    if axis not in AXES:
        message = f'the axis of a moment of inertia must be "x", "y" or "z", not "{axis}"'
        raise Rejected(Complaint("no-such-axis", message))
    return moment_seen(body, axis, about, symbol, key, {"seen": "own" if body.is_of_particles else "mapped"})


MOMENT_OF_INERTIA = Rule(
    "rotation.moment_of_inertia",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, section 7.3",
    outcomes={"generic": anything, "quoted": claims.is_standard_moment},
    evidence={"particles": ROUTE, "quadrature": CHECK},
    statements=[claims.names_the_axis_of_the_whole],
    shown=Shown(brief=Manner.TOLD, quoted=frozenset({"quoted"})),
)
# (shape, point of the axis, axes) -> the body and its axis in words, for moments that a textbook quotes
STANDARD = {
    ("rod", "end", "xy"): "rod_about_its_end",
    ("rod", "centre", "xy"): "rod_about_its_centre",
    ("disc", "centre", "z"): "disc_about_its_axis",
    ("hoop", "centre", "z"): "hoop_about_its_axis",
    ("cylinder", "centre", "z"): "cylinder_about_its_axis",
    ("cylindrical_shell", "centre", "z"): "cylindrical_shell_about_its_axis",
    ("ball", "centre", "xyz"): "ball_about_a_diameter",
    ("spherical_shell", "centre", "xyz"): "spherical_shell_about_a_diameter",
    ("plate", "centre", "z"): "plate_about_its_normal",
}
QUOTED_SHAPES = frozenset(shape for shape, *_ in STANDARD)


def moment_seen(
    body: Body,
    axis: str,
    about: str,
    symbol: str,
    key: str,
    seen: Mapping[str, str],
    turn: MatrixBase | None = None,
) -> Moment:
    """Moment of inertia about an axis, with words that specify how the sentence names this axis.

    seen   words for the sentence, by name. The word under "seen" specifies the axis: "own" for a body axis, "mapped"
           for an axis of a body that a position map defines, "across_plane" for the normal of the plane of motion,
           "part" for an axis of a part. The word under "whole", for a part only, is the parallel axis of the whole body
    turn   the matrix whose columns are the axes of the whole body, in components along the axes of the part

    Source: the same as for `moment_of_inertia`.
    """
    point, i = body.point(about), "xyz".index(axis)
    in_its_way = body.derived_moment(axis, point, symbol, key)
    if in_its_way is not None:
        return in_its_way
    region = body.within(point, None)
    weight = entry_weight(region, (i, i))
    integral = over_mass(body, region, weight)
    standard = quoted(body, about, axis) if seen["seen"] in ("across_plane", "part") else {}
    return establish(
        MOMENT_OF_INERTIA,
        scalar(symbol),
        integral.law,
        integral.inputs,
        lines=integral.lines,
        routes=body.another_way(lambda r: _entry_by_moments(r, (i, i)), point),
        kind="moment of inertia",
        outcome="quoted" if standard else GENERIC,
        parents=[body.density, *body.radii(point, region)],
        facts=[Integrated.over(region)],
        key=key,
        phrase_data=PhraseData(
            formulas=_told_square(region, (i, i), weight),
            words={"about": point.name, "axis": axis, **seen, **standard},
            outcome_data={} if turn is None else {"turn": turn},
        ),
        scope=Scope(about=Subject(body=body, mass=body.mass, point=point, axis=axis)),
    )


def quoted(body: Body, about: str, axis: str) -> dict[str, str]:
    """Return the words for a body and an axis whose moment is quoted; empty if the moment is integrated."""
    for (shape, point, axes), words in STANDARD.items():
        if (shape, point) == (body.id, about) and axis in axes and not body.is_integrated:
            return {"standard": words}
    return {}


def pairs_left_by_symmetry(body: Body, point: Point) -> tuple[Pair, ...]:
    """Return the entries that need steps of their own; the other entries follow from the symmetry of the body.

    For a round body about a point on its axis, I_yy = I_xx and the products vanish. The products also vanish if, for
    each axis, the plane through the point and normal to this axis is a mirror plane of the body.
    """
    if body.is_round and point.position[0] == point.position[1] == 0:
        return ROUND
    is_one_region = body.is_of_particles and not hasattr(body, "parts")
    return MIRRORED if is_one_region and body.region(point).has_mirrors else PAIRS


INERTIA_DEFINITION = Rule(
    "rotation.inertia_definition",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
    shown=Shown(brief=Manner.LEFT_OUT, standard=Manner.LEFT_OUT),
)


def _definition(body: Body, point: Point, region: Region, name: str, key: str) -> Quantity:
    """Define the symbol J = integral of (r.r 1 - r r) dm, where r is measured from the point."""
    return establish(
        INERTIA_DEFINITION,
        tensor(name),
        lambda _: _law(region, body.front),
        {"r": vector("r")},
        kind="moment of inertia",
        parents=[body.density, *body.radii(point, region)],
        facts=[Integrated.over(region)],
        lines=Lines(put_in=None, result=False),
        phrase_data=PhraseData(words={"about": point.name}),
        key=f"{key}_definition",
        scope=Scope(about=Subject(body=body, point=point)),
    )


def _law(region: Region, density: Expr) -> Any:
    r = vector("r")
    integrand = MatAdd(scaled(Dot(r, r), Identity(3)), scaled(Integer(-1), Outer(r, r)))
    return region.with_section_put_in().mass_integral(integrand, density)


def _as_defined(body: Body, point: Point) -> Any:
    return explicit(_law(body.region(point), body.mass / body.size))


def _by_pair(entries: dict[Pair, Quantity]) -> dict[str, Quantity]:
    return {"xyz"[i] + "xyz"[j]: quantity for (i, j), quantity in entries.items()}


def _assembled(pairs: tuple[Pair, ...], found: Sequence[Any]) -> Any:
    at = dict(zip(pairs, found, strict=True))
    if pairs == ROUND:
        at |= {(1, 1): at[(0, 0)]}
    return ImmutableDenseMatrix(3, 3, lambda i, j: at.get((min(i, j), max(i, j)), Integer(0)))


def _round_shape(tensor: Any) -> str:
    return "round_isotropic" if tensor[0, 0] == tensor[2, 2] else "round"


def _entry_outcome(pair: Pair, pairs: tuple[Pair, ...]) -> str:
    if pairs == ROUND:
        return "along" if pair == (2, 2) else "across"
    return "moment" if pair[0] == pair[1] else "product"


ENTRY = Rule(
    "rotation.entry",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
    outcomes={
        "moment": claims.entry("xx", "yy", "zz"),
        "product": claims.entry("xy", "xz", "yz"),
        "mirrored": claims.is_mirrored,
        "across": claims.entry("xx", round_body=True),
        "along": claims.entry("zz", round_body=True),
        "flat": claims.is_across_flat,
    },
    evidence={"particles": ROUTE, "quadrature": CHECK},
    shown=Shown(result_again=Level.BRIEF),
)


def _entry_by_integration(
    body: Body, point: Point, region: Region, name: str, key: str, pair: Pair, definition: Quantity
) -> Quantity:
    """Derive one entry, J_xx = rho integral of (y^2 + z^2) dV or J_xy = -rho integral of x y dV."""
    named = f"{'xyz'[pair[0]]}{'xyz'[pair[1]]}"
    weight, pairs = entry_weight(region, pair), pairs_left_by_symmetry(body, point)
    integral = over_mass(body, region, weight)
    return establish(
        ENTRY,
        entry_name(name, *pair),
        integral.law,
        integral.inputs,
        lines=integral.lines,
        routes=body.another_way(lambda r: _entry_by_moments(r, pair), point),
        outcome="mirrored" if pairs == MIRRORED else _entry_outcome(pair, pairs),
        kind="moment of inertia",
        parents=[definition, body.density, *body.radii(point, region)],
        facts=[Integrated.over(region)],
        key=f"{key}_{named}",
        phrase_data=PhraseData(formulas=_told_square(region, pair, weight), words={"about": point.name}),
        scope=Scope(about=Subject(body=body, point=point, axis=named)),
    )


def _lies_in_plane(body: Body, point: Point) -> bool:
    return getattr(body, "flat_across", None) == "z" and is_zero(point.seen(body.middle.position)[2])


def _entry_of_flat(body: Body, point: Point, name: str, key: str, entries: Mapping[Pair, Quantity]) -> Quantity:
    """Derive the moment of a flat body about the normal of its plane, J_zz = J_xx + J_yy."""
    named = "zz"
    return establish(
        ENTRY,
        entry_name(name, *ACROSS_PLANE),
        lambda x, y: Terms(x, y),
        {"first": entries[0, 0], "second": entries[1, 1]},
        routes=body.another_way(lambda r: _entry_by_moments(r, ACROSS_PLANE), point),
        outcome="flat",
        kind="moment of inertia",
        lines=Lines(put_in=None),
        key=f"{key}_{named}",
        phrase_data=PhraseData(words={"about": point.name}),
        scope=Scope(about=Subject(body=body, point=point, axis=named), differ={"axis"}),
    )


def entry_weight(region: Region, pair: Pair) -> Expr:
    """Return the integrand of an entry: the squared distance from the axis, or minus the product of two coordinates."""
    i, j = pair
    at = region.position
    weight = sum((x**2 for k, x in enumerate(at) if k != i), Integer(0)) if i == j else -at[i] * at[j]
    return _without_angles(weight)


def _without_angles(weight: Expr) -> Expr:
    """Write r^2 cos^2 + r^2 sin^2 as r^2. If the integrand still depends on an angle, return the shorter of two forms:
    the given form and the tidied form."""
    if not weight.atoms(sin, cos):
        return weight
    plain = weight.expand().replace(
        lambda e: e.is_Pow and isinstance(e.base, cos) and e.exp == 2, lambda e: 1 - sin(e.base.args[0]) ** 2
    )
    plain = plain.expand()
    term_by_term = tidied(weight).replace(lambda e: e.is_Add, tidied)
    weight = min((weight, term_by_term), key=length)
    return weight if plain.atoms(sin, cos) else plain


def _told_square(region: Region, pair: Pair, weight: Expr) -> dict[str, tuple[Any, Any]]:
    """For a moment of inertia, return the squared distance from the axis, and |e x r|^2 for the unit vector e along the
    axis. These two must be equal. For a product of inertia, return an empty mapping."""
    if pair[0] != pair[1]:
        return {}
    across = Cross(column(*(int(k == pair[0]) for k in range(3))), region.position)
    return {"square": (weight, explicit(Dot(across, across)))}


def _entry_by_moments(r: Any, pair: Pair) -> Any:
    """Return the entry I_ij of a unit mass at r from moments about axes: 2 I_ij = n.I n - I_ii - I_jj with
    n = e_i + e_j."""
    axes = [column(*(int(k == axis) for k in range(3))) for axis in pair]
    if pair[0] == pair[1]:
        return squared_distance(r, axes[0])
    both, *alone = (explicit(squared_distance(r, n)) for n in (axes[0] + axes[1], *axes))
    return (both - sum(alone)) / 2


def moved_to(tensor_there: Quantity, centre: Quantity, symbol: str = "I", key: str = "inertia_tensor") -> Quantity:
    """Inertia tensor about the centre of mass, I = J - M (c.c 1 - c c), from J about another point of the body.

    tensor_there    tensor J (3, 3), kg m^2, about a point of the body
    centre          vector c (3), m: the position of the centre of mass relative to the point of J, along the same axes

    Second route: each entry, and the whole tensor, integrated about the centre of mass. Check: the trace is twice the
    integral of r.r dm.
    Outcomes: the same as those of `inertia_tensor`.
    Errors: the tensor is already about the centre of mass; the centre is not measured from the point of the tensor; no
    step derives the entries of the tensor.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3 (parallel axes).
    """
    body: Body = tensor_there.needed(OfBody).body
    start = tensor_there.needed(AboutPoint).point
    if start.position == body.middle.position:
        message = f"`{tensor_there.key}` is already about the centre of mass"
        raise Rejected(
            Complaint("already-there", message, help="start from a tensor about another point, or use this tensor")
        )
    _check_start(tensor_there, centre, start)
    return _moved(tensor_there, centre, replace(body.middle, axes=start.axes), symbol, key)


def moved_from_centre(inertia: Quantity, centre: Quantity, symbol: str = "J", key: str = "moved_tensor") -> Quantity:
    """Inertia tensor about another point of the body, J = I + M (c.c 1 - c c), from I about its centre of mass.

    inertia   tensor I (3, 3), kg m^2, about the centre of mass
    centre    vector c (3), m: the position of the centre of mass relative to the other point, along the same axes

    Second route: each entry, and the whole tensor, integrated about the other point. Check: the trace is twice the
    integral of r.r dm.
    Outcomes: outward.
    Errors: the tensor is not about the centre of mass; the tensor and the vector have different axes; no step derives
    the entries of the tensor.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3 (parallel axes).
    """
    body: Body = inertia.needed(OfBody).body
    target = centre.needed(CountedFrom).start
    if inertia.needed(AboutPoint).point != replace(body.middle, axes=target.axes):
        message = f"`{inertia.key}` is not about the centre of mass, or its axes are not the axes of `{centre.key}`"
        help_line = f"start from the tensor about the centre of mass, along the axes of `{centre.key}`"
        raise Rejected(Complaint("another-origin", message, help=help_line))
    return _moved(inertia, centre, target, symbol, key)


MOVED_TO = Rule(
    "rotation.moved_to",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3 (parallel axes)",
    outcomes={**claims.TENSORS, **claims.ROUND_TENSORS, "outward": claims.is_away_from_the_centre},
    evidence={"integration": ROUTE, "trace": CHECK},
    statements=[claims.inward],
    shown=Shown(brief=Manner.LEFT_OUT, standard=Manner.LEFT_OUT),
)


def _moved(there: Quantity, centre: Quantity, target: Point, symbol: str, key: str) -> Quantity:
    """Derive the tensor about another point by the parallel-axis theorem; one of the two points is the centre of mass.

    Outcomes: isotropic, two_equal, diagonal, generic; round, round_isotropic; outward (from the centre of mass to
    another point).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3 (parallel axes).
    """
    body: Body = there.needed(OfBody).body
    other = centre.needed(CountedFrom).start
    pairs = pairs_left_by_symmetry(body, other)
    entries = {pair: _entry_moved(there, centre, target, symbol, key, pair) for pair in pairs}
    inward = _round_shape if pairs == ROUND else shape_of
    return establish(
        MOVED_TO,
        tensor(symbol),
        lambda *found: _assembled(pairs, found),
        _by_pair(entries),
        routes={
            "integration": compared_with(lambda: _as_defined(body, target)),
            "trace": lambda result: (result.trace(), 2 * body.over_mass(lambda r: Dot(r, r), target)),
        },
        outcome="outward" if target == other else inward,
        kind="moment of inertia",
        parents=[body.density],
        lines=Lines(law=Level.FULL, put_in=None),
        facts=[OfBody(body), AboutPoint(target)],
        phrase_data=PhraseData(words={"about": target.name, "start": other.name, **_edged(body)}),
        key=key,
        scope=Scope(about=Subject(body=body, point=target)),
    )


def _check_start(tensor_there: Quantity, centre: Quantity, start: Point) -> None:
    """Reject a position of the centre of mass that is not measured from the point of the tensor."""
    counted = centre.fact(CountedFrom)
    if counted is None or counted.start != start:
        told = f"from the {counted.start.name}" if counted else "from another point"
        message = f"`{tensor_there.key}` is about the {start.name}, but `{centre.key}` is measured {told}"
        help_line = f'use centre_of_mass(body, origin="{start.name}")'
        raise Rejected(Complaint("another-origin", message, help=help_line))


def _components(v: Any) -> tuple[Any, ...]:
    return component_names(v.name) if isinstance(v, MatrixSymbol) else tuple(v)


ENTRY_MOVED = Rule(
    "rotation.entry_moved",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3 (parallel axes)",
    outcomes={
        "moment": claims.entry("xx", "yy", "zz"),
        "product": claims.entry("xy", "xz", "yz"),
        "across": claims.entry("xx", round_body=True),
        "along": claims.entry("zz", round_body=True),
        "outward": claims.entry("xx", "yy", "zz", "xy", "xz", "yz"),
    },
    evidence={"integration": ROUTE},
    statements=[claims.inward_or_outward],
    shown=Shown(result_again=Level.BRIEF),
    quotes=[Quote(PARALLEL_AXES, frozenset({"moment", "outward", "product"}))],
)


def _entry_moved(there: Quantity, centre: Quantity, target: Point, name: str, key: str, pair: Pair) -> Quantity:
    """Derive one entry by the parallel-axis theorem: I_xx = J_xx - M (y^2 + z^2), I_xy = J_xy + M x y.

    The centre of mass is at (x, y, z). For a shift from the centre of mass to another point, the signs are opposite.
    """
    i, j = pair
    body: Body = there.needed(OfBody).body
    other = centre.needed(CountedFrom).start
    outward = target == other
    sign = 1 if outward else -1
    pairs = pairs_left_by_symmetry(body, other)
    entry = next((parent for parent in there.parents if parent.key.endswith(f"_{'xyz'[i]}{'xyz'[j]}")), None)
    if entry is None and (i == j or not is_zero(there.value[i, j])):
        message = f"no step derives the entry {'xyz'[i]}{'xyz'[j]} of `{there.key}`"
        help_line = '`inertia_tensor(body, about="...")` derives the entries of a body without parts'
        raise Rejected(Complaint("no-entries", message, help=help_line))
    # If c is measured from a point on the axis of a round body, only the component of c along the axis is not zero.
    apart = [k for k in range(3) if k != i and not (pairs == ROUND and centre.value[k] == 0)]

    def law(mass: Expr, c: Any, *at_start: Expr) -> Expr:
        c = _components(c)
        if i == j:
            squares = [c[k] ** 2 for k in apart]
            shift = squares[0] if len(squares) == 1 else Terms(*squares)
            return Terms(*at_start, sign * Factors(mass, shift)) if squares else at_start[0]
        return Terms(*at_start, -sign * Factors(mass, c[i], c[j])) if at_start else -sign * Factors(mass, c[i], c[j])

    def directly() -> Expr:
        return body.over_mass(lambda at: sum((x**2 for x in at), Integer(0)) * int(i == j) - at[i] * at[j], target)

    return establish(
        ENTRY_MOVED,
        entry_name(name, i, j),
        law,
        {"mass": body.mass, "centre": centre, **({"entry": entry} if entry is not None else {})},
        routes={"integration": compared_with(directly)},
        outcome="outward" if outward else _entry_outcome(pair, pairs),
        kind="moment of inertia",
        lines=Lines(put_in=Level.STANDARD),
        parents=[there],
        phrase_data=PhraseData(words={"start": other.name}),
        key=f"{key}_{'xyz'[i]}{'xyz'[j]}",
        scope=Scope(about=Subject(body=body, point=target), differ={"point"}),
    )


AGREEMENT = Rule(
    "rotation.agreement",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3",
    outcomes={"generic": claims.agreement_generic, "turned": claims.agreement_turned},
    evidence={"other_way": CHECK},
)


def agreement(found: Quantity, again: Quantity, key: str = "agreement") -> Quantity:
    """Agreement of two derivations of the same tensor, I' = I.

    found   tensor (3, 3), kg m^2
    again   the tensor of the same body about the same point by another derivation, possibly along rotated axes

    Check: `again`, rotated to the axes of `found`, is equal to `found`.
    Outcomes: generic (the axes are the same), turned (the axes of `again` are rotated by half a turn about x).
    Errors: the tensors belong to different bodies or points.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.3.
    """
    points = [tensor.needed(AboutPoint).point for tensor in (found, again)]
    if found.needed(OfBody) != again.needed(OfBody) or points[0].position != points[1].position:
        message = f"`{found.key}` and `{again.key}` are not tensors of the same body about the same point"
        raise Rejected(Complaint("not-the-same", message))
    turn = points[0].axes.T * points[1].axes
    return establish(
        AGREEMENT,
        again.symbol,
        lambda first, _: first,
        {"found": found, "again": again},
        routes={"other_way": compared_with(lambda: turn * again.value * turn.T)},
        outcome="generic" if turn.is_Identity else "turned",
        kind="moment of inertia",
        lines=Lines(put_in=None),
        facts=found.facts,
        phrase_data=PhraseData(words={"about": points[0].name}, outcome_data={"turn": turn}),
        key=key,
        scope=Scope(about=found.subject, differ={"point", "axes"}),
    )
