"""Predicates of rotation: each checks an outcome, or a statement in the sentence of an outcome."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from math import prod
from typing import Any

from sympy import (
    Expr,
    ImmutableDenseMatrix,
    Integer,
    Matrix,
    MatrixBase,
    Symbol,
    cos,
    diff,
    sin,
)
from sympy import diag as diagonal

from derive.algebra.expressions import AXES, Cross, Dot, explicit, rate
from derive.algebra.tidy import tidied
from derive.mechanics.bodies.claims import is_round
from derive.mechanics.bodies.facts import CountedFrom
from derive.mechanics.bodies.parts import turns_right_handed
from derive.mechanics.rotation.facts import Disturbed
from derive.steps.claims import both, lasts, letters_in, negated, never_vanishes, vanishes, vanishing
from derive.steps.rule import Judged, Naming, Predicate, handed_on_by
from derive.steps.step import is_zero

# moments of uniform bodies that tables give: words -> the point, the axes, and a function that returns the moment
# divided by the mass. The arguments of this function are the sizes, in the order of `measures`
_TABLE: Mapping[str, tuple[str, str, Callable[..., Expr]]] = {
    "rod_about_its_end": ("end", "xy", lambda length: length**2 / 3),
    "rod_about_its_centre": ("centre", "xy", lambda length: length**2 / 12),
    "disc_about_its_axis": ("centre", "z", lambda radius: radius**2 / 2),
    "hoop_about_its_axis": ("centre", "z", lambda radius: radius**2),
    "cylinder_about_its_axis": ("centre", "z", lambda radius, height: radius**2 / 2),
    "cylindrical_shell_about_its_axis": ("centre", "z", lambda radius, height: radius**2),
    "ball_about_a_diameter": ("centre", "xyz", lambda radius: 2 * radius**2 / 5),
    "spherical_shell_about_a_diameter": ("centre", "xyz", lambda radius: 2 * radius**2 / 3),
    "plate_about_its_normal": ("centre", "z", lambda sides: (sides[0] ** 2 + sides[1] ** 2) / 12),
}


def is_standard_moment(facts: Judged) -> bool:
    """Whether the result is the moment that tables give for this body and axis.

    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, section 7.3.
    """
    body, words = facts.subject.body, facts.words.get("standard", "")
    if words not in _TABLE or not words.startswith(f"{body.id}_about_"):
        return False
    point, axes, moment = _TABLE[words]
    is_there = facts.subject.point.name == point and facts.subject.axis in axes
    return is_there and is_zero(explicit(facts.result) - body.mass * moment(*body.measures.values()))


def is_away_from_the_centre(facts: Judged) -> bool:
    return not is_zero(facts.subject.body.over_mass(lambda r: r, facts.subject.point))


def entry(*pairs: str, round_body: bool = False) -> Predicate:
    """Judge whether the index of the result's symbol is one of these pairs, so that the result is this entry of a
    tensor. With `round_body`, the particles must also show that the body is round."""

    def is_so(facts: Judged) -> bool:
        return facts.symbol.name[-2:] in pairs and (not round_body or is_round(facts))

    return is_so


def is_mirrored(facts: Judged) -> bool:
    """Whether the result is a diagonal entry, and every function that is odd in x, y or z integrates to zero over the
    mass. One such function is tested for each axis."""
    body, point = facts.subject.body, facts.subject.point
    odd = [body.over_mass(lambda r, k=k: r[k] * (1 + 7 * r[k - 1] + 11 * r[k - 2]) ** 2, point) for k in range(3)]
    return bool(entry("xx", "yy", "zz")(facts)) and all(is_zero(each) for each in odd)


def is_across_flat(facts: Judged) -> bool:
    """Whether the result is the moment about the z axis through the point, and all of the mass is in the plane through
    the point and normal to z."""
    body, point = facts.subject.body, facts.subject.point
    return bool(entry("zz")(facts)) and is_zero(body.over_mass(lambda r: r[2] ** 2, point))


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


def tensor(different: int | None, round_body: bool = False) -> Predicate:
    """Judge whether the result is a diagonal tensor with this number of distinct moments; if no number is given,
    whether the result is a tensor that is not diagonal. With `round_body`, the moments about x and y must also be
    equal, and the particles must show that the body is round."""

    def is_so(facts: Judged) -> bool:
        tensor = facts.result
        if different is None:
            return not _products_vanish(tensor)
        if round_body and not (is_zero(tensor[0, 0] - tensor[1, 1]) and is_round(facts)):
            return False
        return _products_vanish(tensor) and _different(_moments_of(tensor)) == different

    return is_so


TENSORS = {"generic": tensor(None), "diagonal": tensor(3), "two_equal": tensor(2), "isotropic": tensor(1)}


ROUND_TENSORS = {"round": tensor(2, round_body=True), "round_isotropic": tensor(1, round_body=True)}


def moments(different: int, diagonal: bool) -> Predicate:
    return lambda facts: _different(facts.result) == different and _products_vanish(facts.inputs["inertia"]) == diagonal


def characteristic_equation(facts: Judged, equation: Any) -> bool:
    """Whether the equation is det(I - x 1) = p(x) = 0 for the tensor I, and the moments are the roots of p."""
    (determinant, polynomial), zero = equation.left.sides, equation.right
    unknown = next(iter(determinant.args[0].free_symbols - {facts.quantities["inertia"].symbol}))
    tensor = Matrix(explicit(facts.inputs["inertia"]))
    named = determinant.args[0].xreplace({facts.quantities["inertia"].symbol: ImmutableDenseMatrix(tensor)})
    is_matrix = is_zero(explicit(named) - (tensor - unknown * Matrix.eye(3)))
    product = prod(moment - unknown for moment in explicit(facts.result))
    return zero == 0 and is_matrix and bool(is_zero((explicit(polynomial) - product).expand()))


def axis_of(different: int, alone: bool | None = None) -> Predicate:
    """Judge whether there are exactly `different` distinct moments. If `alone` is given, also judge whether the moment
    of this axis differs from all others if and only if `alone` is true."""

    def is_so(facts: Judged) -> bool:
        moments, k = facts.inputs["moments"], int(facts.symbol.name[-1]) - 1
        twins = sum(is_zero(moments[k] - other) for other in moments)
        return _different(moments) == different and (alone is None or (twins == 1) == alone)

    return is_so


def axis_of_symmetry(facts: Judged) -> bool:
    along = all(bool(x == int(k == 2)) for k, x in enumerate(facts.result))
    return bool(axis_of(2, alone=True)(facts)) and along and is_round(facts)


def moments_compared(wanted: str) -> Predicate:
    """Judge how the moments compare.

    With `wanted="always"`, all moments must be equal. With `wanted="never"`, they must not be equal for any values of
    the symbols. This is so if every difference that is not identically zero has a fixed sign, and there is at least one
    such difference. With any other word, the moments must be equal for the value of a symbol that the result states,
    and neither "always" nor "never" may be true.
    """

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


HALF_TURN_ABOUT_X = ImmutableDenseMatrix(diagonal(1, -1, -1))


def disturbed(facts: Judged, fact: Disturbed) -> bool:
    return "xyz"[fact.axis] == facts.words["axis"]


def about_that_axis(facts: Judged, letter: Any) -> bool:
    along = facts.inputs["along"]
    return bool(facts.words["axis"] == letter.name) and along.name.rpartition("_")[2] == letter.name


def steady_component(facts: Judged, along: Any) -> bool:
    """Whether the equation `slow` contains the rate of the component along the axis, and the linear equation does not
    contain this component. The rate of this component is of second order."""
    return explicit(facts.quantities["slow"].value).has(rate(along)) and not explicit(facts.result).has(along)


def to_first_order(facts: Judged, speed: Any) -> bool:
    """Whether the linear equation consists of the first-order terms in the small components, if the component along the
    axis has this speed."""
    exact, small = explicit(facts.quantities["motion"].value).residual, Symbol("s_small", real=True)
    across = [facts.inputs["small_1"], facts.inputs["small_2"]]
    along = facts.inputs["along"]
    there = {w: small * w for w in across} | {rate(w): small * rate(w) for w in across}
    there |= {along: speed, rate(along): Integer(0)}
    first = diff(exact.xreplace(there), small).subs(small, 0)
    return is_zero(first - explicit(facts.result).residual)


def another_component(facts: Judged, letter: Any) -> bool:
    """Whether the two small components and the component along the axis are distinct, and the named component and these
    three belong to the same vector."""
    components = [facts.inputs[role] for role in ("along", "small_1", "small_2")]
    return len(set(components)) == 3 and len({each.name.rpartition("_")[0] for each in (*components, letter)}) == 1


def small_one(which: str) -> Naming:
    """Judge whether the equation with the role `which` contains the rate of the named component."""
    return lambda facts, letter: explicit(facts.quantities[which].value).has(rate(letter))


def moment_across(facts: Judged, moment: Any) -> bool:
    """Whether the result times this moment has the magnitude of the angular momentum."""
    L = explicit(facts.inputs["momentum"])
    return is_zero((explicit(facts.result) * explicit(moment)) ** 2 - sum((c**2 for c in L), Integer(0)))


def turned_by(facts: Judged, angle: Any) -> bool:
    """Whether the result is the tensor along axes rotated by this angle about the named axis."""
    i = AXES.index(facts.words["along"])
    turn = Matrix.eye(3)
    j, k = (i + 1) % 3, (i + 2) % 3
    turn[j, j], turn[k, k], turn[j, k], turn[k, j] = cos(angle), cos(angle), -sin(angle), sin(angle)
    return is_zero((turn.T * explicit(facts.inputs["inertia"]) * turn - explicit(facts.result)).applyfunc(tidied))


def of_its_equation(facts: Judged, _: Any) -> bool:
    return rates_of_its_equations(facts, "")


def across(facts: Judged) -> Any:
    return explicit(Cross(facts.inputs["omega"], facts.result))


def turns(wanted: str) -> Predicate:
    """Judge whether `wanted` is "left" if and only if the component of the result along the axis is known to be
    negative."""

    def is_so(facts: Judged) -> bool:
        along = tidied(explicit(Dot(facts.result, facts.inputs["axis"])))
        return (wanted == "left") == bool(along.is_negative)

    return is_so


def cosine_is(wanted: int | None, of: Callable[[Any], Any] = lambda cosine: cosine) -> Predicate:
    """Judge whether the cosine is `wanted`: 1 (parallel), -1 (opposite), 0 (perpendicular), or None for any other
    value."""

    def is_so(facts: Judged) -> bool:
        cosine = of(facts.result)
        if wanted is not None:
            return is_zero(cosine - wanted)
        return not any(is_zero(cosine - special) for special in (1, -1, 0))

    return is_so


def rotation_cos(angle: Expr) -> Expr:
    from sympy import cos

    return cos(angle)


def rate_is(in_space: bool | None, in_body: bool | None) -> Predicate:
    """Judge whether the rate in space vanishes if and only if `in_space` is true, and the rate in the body vanishes if
    and only if `in_body` is true. With `in_body=None`, the rate in the body may have any value. If this rate is
    unknown, `in_space` must be None."""

    def is_so(facts: Judged) -> bool:
        seen = facts.inputs.get("in_body")
        if seen is None:
            return in_space is None
        return in_space == is_zero(facts.result) and (in_body is None or in_body == is_zero(seen))

    return is_so


def euler(torque: bool, coupled: str) -> Predicate:
    """Judge whether a torque acts if and only if `torque` is true, and whether products of components of omega remain
    where `coupled` says.

    coupled   "here": in this equation; "elsewhere": in another equation, but not in this one; "nowhere": in no
              equation; empty: the products are not examined
    """

    def is_so(facts: Judged) -> bool:
        acting = facts.inputs["torque"]
        driven = not is_zero(acting)
        rates = facts.inputs["rate"]
        components = facts.inputs["moving"]
        mixed = [
            not all(is_zero(diff(entry, u, v)) for u in components for v in components if u != v) for entry in rates
        ]
        here = mixed["xyz".index(facts.words["axis"])]
        where = "here" if here else "elsewhere" if any(mixed) else "nowhere"
        return driven == torque and (not coupled or where == coupled)

    return is_so


def given_as(sort: str) -> Predicate:
    """Judge whether the name of the function in the script begins with the word `sort`, and the result has the given
    components and is not zero."""

    def is_so(facts: Judged) -> bool:
        given = all(is_zero(one - other) for one, other in zip(facts.result, facts.inputs["given"], strict=True))
        return lasts(facts) and given and facts.inputs["verb"].name.startswith(sort)

    return is_so


def all_is_added(facts: Judged) -> bool:
    return all(part.sign > 0 for part in facts.subject.body.parts)


def moved(moved: bool, turned: bool) -> Predicate:
    """Judge whether the part is displaced if and only if `moved` is true. The axes of the part must differ from the
    axes of the whole body if and only if `turned` is true."""

    def is_so(facts: Judged) -> bool:
        way, turn = facts.inputs.get("way"), facts.inputs["turn"]
        return (way is not None and not is_zero(way)) == moved and (not turn.is_Identity) == turned

    return is_so


def beside_the_axis(facts: Judged) -> bool:
    """Whether the centre of mass of some part is off the axis. The centre is computed from particles."""
    about, k = facts.subject.point, "xyz".index(str(facts.subject.axis))
    for part in facts.subject.body.parts:
        mean = sum((m * about.seen(r) for m, r in part.particles), start=about.position * 0) / part.mass
        if not is_zero(sum(x**2 for i, x in enumerate(mean) if i != k)):
            return True
    return False


def with_moments(facts: Judged) -> int:
    return sum(role.startswith("part_") for role in facts.inputs)


def is_flat(facts: Judged) -> bool:
    """Whether all particles are in the x-y plane, and the moment is about the x or y axis."""
    body = facts.subject.body
    return all(is_zero(place[2]) for _, place in body.particles()) and facts.subject.axis in ("x", "y")


def on_its_axis(facts: Judged) -> bool:
    places = [place for _, place in facts.subject.body.particles()]
    return facts.subject.axis == "z" and all(is_zero(place[0]) and is_zero(place[1]) for place in places)


def part_of_sign(sign: int) -> Predicate:
    """Judge whether the part has this sign, which is negative for a cavity, and whether it has the stated name."""
    return lambda facts: facts.inputs["sign"] == sign and facts.words["part"] == facts.inputs["part_of"].called


def edges_along_the_axes(facts: Judged, outcome: str) -> bool:
    """Whether the coordinates are Cartesian with constant limits; true if the sentence does not mention edges."""
    if "edged" not in facts.words:
        return True
    body = facts.subject.body
    region = body.region(body.point(body.reference))
    ends = {s for _, *limits in region.limits for end in limits for s in end.free_symbols}
    return not ends & set(region.names) and region.element == 1


def turned_as_told(facts: Judged, outcome: str) -> bool:
    return turns_right_handed(facts.inputs["turn"], facts.words["along"], facts.inputs["angle"])


def inward(facts: Judged, outcome: str) -> bool:
    """Whether the sentence names the right point: the centre of mass, but another point for the outcome "outward". The
    sentence may mention edges only if the edges are along the axes."""
    about_centre = facts.words.get("about") in {"centre", "centre_of_mass"}
    return about_centre != (outcome == "outward") and edges_along_the_axes(facts, outcome)


def _sign(value: Expr) -> int | None:
    value = tidied(value)
    if is_zero(value):
        return 0
    return 1 if value.is_positive else -1 if value.is_negative else None


def order_is(wanted: str) -> Predicate:
    """Judge whether the moment about the axis compares with the other two moments as `wanted` states.

    wanted   "greatest" or "least"; "unstable": between the other two; "marginal": equal to one of them, or to both;
             "symmetric": different from the other two, which are equal; "conditional": the order depends on the symbols
    """

    def is_so(facts: Judged) -> bool:
        moments, axis = list(facts.inputs["moments"]), int(facts.inputs["axis_index"])
        about = moments.pop(axis)
        signs = [_sign(about - other) for other in moments]
        if 0 in signs:
            return wanted == "marginal"
        if _sign(moments[0] - moments[1]) == 0:
            return wanted == "symmetric"
        if None in signs:
            return wanted == "conditional"
        if signs[0] != signs[1]:
            return wanted == "unstable"
        return wanted == ("greatest" if signs[0] == 1 else "least")

    return is_so


def excess_is(sign: int | None) -> Predicate:
    return lambda facts: _sign(facts.inputs["excess"]) == sign and not vanishes(facts)


def root_is(grows: bool, *squares: str) -> Predicate:
    """Judge two conditions: the square of the rate is negative if and only if `grows` is true, and the step that
    derives the square has one of these outcomes. A square of unknown sign counts as not negative."""

    def is_so(facts: Judged) -> bool:
        word = facts.quantities["squared"].step.outcome
        return (_sign(facts.inputs["squared"]) == -1) == grows and word in squares

    return is_so


_KINDS = {"omega": "angular speed", "inertia": "moment of inertia", "momentum": "angular momentum"}


def of_their_kinds(facts: Judged, outcome: str) -> bool:
    """Whether the inputs with the roles "omega", "inertia" and "momentum" have the kinds of quantity that `_KINDS`
    lists."""
    return all(q.step.kind == _KINDS.get(role, q.step.kind) for role, q in facts.quantities.items())


def of_their_kinds_by_euler(facts: Judged, outcome: str) -> bool:
    """Whether the inputs have the kinds that `_KINDS` lists, and the sentence names Euler's equations if and only if
    the axes are principal axes."""
    along_principal_axes = is_zero(facts.inputs["inertia"] - Matrix.diag(*facts.inputs["inertia"].diagonal()))
    return of_their_kinds(facts, outcome) and along_principal_axes == ("euler" in facts.words)


def vanish_again(facts: Judged, outcome: str) -> bool:
    """Whether the word of the sentence is "first", or is "kept" and an earlier, different tensor also has no products
    of inertia."""
    tensor = facts.quantities["inertia"]
    before = [e.value for e in tensor.ancestors() if isinstance(e.value, MatrixBase) and e.value.shape == (3, 3)]
    again = any(each.is_diagonal() and each != tensor.value for each in before)
    return facts.words["seen"] == "first" or again and facts.words["seen"] == "kept"


def rate_of_the_component(facts: Judged, outcome: str) -> bool:
    return "rate" in facts.quantities and rate(facts.inputs["component"]) in letters_in(facts.result)


def inward_or_outward(facts: Judged, outcome: str) -> bool:
    """Whether the sentence names the point from which the centre is measured, and the outcome is "outward" if and only
    if the shift begins at the centre of mass."""
    if facts.words["start"] != facts.quantities["centre"].needed(CountedFrom).start.name:
        return False
    if "entry" not in facts.quantities:  # no step derives the entry, because it is a product of inertia that is zero
        return outcome == "outward"
    point = facts.quantities["entry"].subject.point
    return point is None or (point.name in {"centre", "centre_of_mass"}) == (outcome == "outward")


def names_the_axis_of_the_whole(facts: Judged, outcome: str) -> bool:
    """Whether the axis of the whole body that the sentence names is the index of the symbol, as in I_z, and is parallel
    to the axis of the part. If there is no parallel axis, or if the moment is not the moment of a part, the sentence
    must not name an axis of the whole body."""
    seen, whole, turn = facts.words.get("seen"), facts.words.get("whole"), facts.inputs.get("turn")
    if turn is None:
        in_its_way = seen != "mapped" or not facts.subject.body.is_of_particles
        return whole is None and seen != "part" and in_its_way
    by_letter, own = facts.symbol.name.partition("_")[2], "xyz".index(facts.words["axis"])
    parallel = {"xyz"[k] for k in range(3) if is_zero(turn[own, k] ** 2 - 1)}
    return by_letter == whole and {whole} == parallel if parallel else by_letter == "axial" and whole is None


def component_of_its_letter(facts: Judged, outcome: str) -> bool:
    """Whether the result is the component of the vector along the axis in the index of the symbol, as in v_x."""
    index = facts.symbol.name.rpartition("_")[2]
    return index in AXES and is_zero(explicit(facts.inputs["vector"])[AXES.index(index)] - explicit(facts.result))


def rates_of_its_equations(facts: Judged, outcome: str) -> bool:
    """Whether each of the three named equations contains the rate of its component."""
    letters = (facts.inputs["around"], facts.inputs["beside"], facts.inputs["along"])
    named = [facts.quantities[role].value for role in ("first", "second", "third")]
    return all(rate(w) in explicit(equation).free_symbols for w, equation in zip(letters, named, strict=True))


def agreement_generic(facts: Judged) -> bool:
    return bool(facts.inputs["turn"].is_Identity)


def agreement_turned(facts: Judged) -> bool:
    return bool(facts.inputs["turn"] == HALF_TURN_ABOUT_X)


def angular_momentum_parallel(facts: Judged) -> bool:
    return is_zero(across(facts))


def angular_momentum_generic(facts: Judged) -> bool:
    return never_vanishes(across(facts))


angular_momentum_in_general: Predicate = both(negated(angular_momentum_parallel), negated(angular_momentum_generic))


def torque_generic(facts: Judged) -> bool:
    return never_vanishes(facts.result)


torque_in_general: Predicate = both(lasts, negated(torque_generic))


rate_in_body_in_general: Predicate = both(lasts, vanishing("torque"))


rate_in_body_driven: Predicate = negated(vanishing("torque"))


centre_of_parts_cut_out: Predicate = negated(all_is_added)


def moment_of_parts_on_axis(facts: Judged) -> bool:
    return bool(not beside_the_axis(facts) and with_moments(facts) != 1)


def moment_of_parts_alone(facts: Judged) -> bool:
    return bool(not beside_the_axis(facts) and with_moments(facts) == 1)


def tensor_entry_moment(facts: Judged) -> bool:
    return bool(len(set(facts.words["entry"])) == 1)


def tensor_entry_product(facts: Judged) -> bool:
    return bool(len(set(facts.words["entry"])) == 2)


handed_on_by(Disturbed, disturbed)
