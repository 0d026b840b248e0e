"""Predicates of motions: each checks an outcome, or an expression in the sentence of an outcome."""

from __future__ import annotations

from itertools import islice
from typing import Any

from sympy import (
    Add,
    Expr,
    Integer,
    Rational,
    Symbol,
    acos,
    asin,
    atan,
    cos,
    diff,
    oo,
    sin,
    sqrt,
    tan,
)

from derive.algebra.expressions import TIME, Relation, depends_on_time, explicit, rate
from derive.algebra.period_series import half_swing
from derive.algebra.samples import letters_of, points, seed_of
from derive.algebra.tidy import tidied
from derive.mechanics.model.constraint import Constrained, Constraint
from derive.mechanics.motion.facts import Arrival, ByEnergy, InFlight, SignedRate, Steady
from derive.steps.claims import is_negative, negated, same_equation, sign_is, value_of_role
from derive.steps.known_numbers import with_numbers
from derive.steps.rule import Judged, Predicate, handed_on_by
from derive.steps.step import Quantity, is_zero
from derive.steps.trial_numbers import (
    SMALL,
    Point,
    assumptions_about,
    everywhere,
    holds_at,
    just_where,
    real_at,
    sign_at,
    sign_found,
    signs,
    signs_of,
    trial_points,
)


def released(at_rest: bool) -> Predicate:
    return lambda facts: is_zero(facts.inputs["initial"]) == at_rest


def moves_off(wanted: int | None) -> Predicate:
    """Judge the sign of the initial rate or, from rest, of the initial acceleration: it must be `wanted`, or neither 1
    nor -1 if `wanted` is None. The result must have a minus sign if and only if `wanted` is -1."""

    def is_so(facts: Judged) -> bool:
        known = facts.inputs["known"]
        q, first = known.coordinate, known.start_rate
        off = first if not is_zero(first) else known.acceleration.subs({q: known.start, rate(q): 0})
        sign = sign_found(off)
        result = {1: 1, -1: -1}.get(wanted or 1, 1) * facts.result
        return (sign == wanted if wanted else sign not in (1, -1)) and not result.could_extract_minus_sign()

    return is_so


TWO_AMPLITUDES = Rational(4, 5), Rational(1, 4)
FAR, SOON = Rational(10) ** 30, Rational(1, 10**6)  # a number in place of infinity, and a small change of a coordinate
AHEAD = [
    *(Rational(n, 8) for n in range(1, 57)),
    *(Rational(10) ** n for n in range(1, 20)),
]  # distances from the start; for a coordinate that is never negative, also divisors of its value at the start


def has_sense(facts: Judged, fact: SignedRate) -> bool:
    """Whether the result is the rate of the coordinate, with the sign that the fact states."""
    return facts.symbol == rate(fact.coordinate) and _is_negative(facts.result) == (fact.sense == -1)


def _is_negative(root: Expr) -> bool:
    return bool(root.could_extract_minus_sign())


def arrives_as_told(facts: Judged, outcome: str) -> bool:
    """Whether, numerically, the motion reaches each place if and only if the stated condition holds. Whether
    the motion reaches a place is not tested if the place was derived from the motion.

    If the result contains the rate with its sign, the place must be ahead of the start, or behind the start if the
    motion turns back first. If a condition is stated and a surface or a string guides the motion, the sentence must
    also name the contact or the tension that has to last.
    """
    kept = [fact for q in facts.quantities.values() for each in q.ancestors() if (fact := each.fact(Constrained))]
    one_sided = {"surface": "contact", "string": "taut"}
    ends = {one_sided[each.enforcer] for fact in kept for each in fact.constraints if each.enforcer in one_sided}
    conditional = any(come.reached is not None for come in facts.inputs["arrivals"])
    lasts = facts.words.get("lasts")
    if conditional and (lasts not in ends if ends else bool(lasts)):
        return False
    return all(
        (come.is_found or _is_reached_just_where(come, facts.inputs.get("reached")))
        and (not come.sense or _side(come) == ({-1} if come.turned else {1}))
        for come in facts.inputs["arrivals"]
    )


def turned_first(facts: Judged) -> bool:
    """Whether, numerically, the motion turns back before it comes to the place. The sign of the result must be opposite
    to the sign of the rate at the start."""
    (come,) = facts.inputs["arrivals"]
    q, squared, start = come.begun.coordinate, with_numbers(come.squared), with_numbers(come.begun.start)

    def turns(point: Point) -> bool | None:
        begin = real_at(start, point)
        if begin is None:
            return None
        ahead = [begin + come.sense * far for far in AHEAD] + [begin / far for far in AHEAD if q.is_nonnegative]
        return any(sign_at(squared, {**point, q: here}) == -1 for here in ahead if not q.is_nonnegative or here > 0)

    return come.turned and _is_negative(facts.result) == (come.sense == 1) and everywhere(_trials_of(come), turns)


def comes_there(facts: Judged, place: Relation) -> bool:
    """Whether the sentence names the place to which the motion comes after turning back."""
    (come,) = facts.inputs["arrivals"]
    return come.turned and place.operator == "=" and place.sides == (come.unknown, come.place)


def _finite(place: Expr) -> Expr:
    return with_numbers({oo: FAR, -oo: -FAR}.get(place, place))


def _is_reached_just_where(come: Arrival, told: Relation | None) -> bool:
    value = with_numbers(come.squared).subs(*_letter_at(come.unknown, _finite(come.place)))
    letters = letters_of(value)

    def is_reached(point: Point) -> bool | None:
        sign = sign_at(value, point)
        if sign == 0 and told is not None and told.operator == ">":
            return None  # the motion may approach the place without reaching it
        return None if sign is None else sign >= 0

    conditions = [] if told is None else [with_numbers(told)]
    return told == come.reached and just_where(conditions, is_reached, letters, *assumptions_about(letters))


def _trials_of(come: Arrival) -> list[Point]:
    values = (come.squared, come.begun.start, _finite(come.place))
    letters = set[Any]().union(*(letters_of(with_numbers(each)) for each in values)) - {come.begun.coordinate}
    reached = [] if come.reached is None else [with_numbers(come.reached)]
    return trial_points(letters, *reached, *assumptions_about(letters))


def _side(come: Arrival) -> set[int | None]:
    """Return the sides of the start on which the place may lie: 1 is ahead, -1 is behind. If no side is found, return
    {1}."""
    q, start = come.begun.coordinate, with_numbers(come.begun.start)
    here, soon = (come.unknown.xreplace({q: each}) for each in (start, start + come.sense * SOON))
    return signs((_finite(come.place) - here) * (soon - here), _trials_of(come)) - {0, None} or {1}


def coordinate_of_rate(facts: Judged, q: Any) -> bool:
    return bool(facts.symbol.has(rate(q)))


def isochronous(wanted: bool) -> Predicate:
    """Judge numerically whether a large swing and a small one take the same time; for `wanted=False`, whether the times
    differ."""

    def is_so(facts: Judged) -> bool:
        q, amplitude, value = (facts.inputs[role] for role in ("coordinate", "amplitude", "value"))
        letters = letters_of(value) - {q, amplitude}
        for point in islice(points(letters, seed_of(value)), 40):
            swings = value.xreplace(dict(point))
            large, small = (half_swing(swings.subs(amplitude, size), q, size, 15) for size in TWO_AMPLITUDES)
            if large is not None and small is not None:
                return bool(abs(large / small - 1) < Rational(1, 10**9)) == wanted
        return False

    return is_so


def _letter_at(unknown: Expr, start: Expr) -> tuple[Expr, Expr]:
    if isinstance(unknown, Symbol):
        return unknown, start
    if unknown.is_Pow:
        return unknown.base, start ** (1 / unknown.exp)
    return unknown.args[0], {cos: acos, sin: asin, tan: atan}[unknown.func](start)


def _vanishing_force(facts: Judged) -> bool:
    return facts.result.operator == "=" and bool(facts.result.left == facts.inputs["unknown"])


def lost(later: bool) -> Predicate:
    """Judge three conditions. The result must be an equation for the unknown. The force at the start must be positive
    numerically, or zero if `later`. The stated condition for reaching the place must be correct."""

    def is_so(facts: Judged) -> bool:
        letter, start = _letter_at(facts.inputs["unknown"], facts.inputs["start"])
        force = with_numbers(explicit(facts.inputs["force"]).subs(letter, start))
        found = signs_of(force, *assumptions_about(letters_of(force))) - {None}
        return _vanishing_force(facts) and found == {0 if later else 1} and _gets_there_as_told(facts)

    return is_so


def _gets_there_as_told(facts: Judged) -> bool:
    """Whether, numerically, the squared rate at the place is positive if and only if the stated condition holds."""
    told = facts.inputs.get("reached")
    if "squared" not in facts.inputs:
        return told is None
    there = explicit(facts.inputs["squared"]).subs(*_letter_at(*facts.result.sides))
    if told is not None and not explicit(told.residual).free_symbols <= there.free_symbols:
        return False
    value, conditions = with_numbers(there), [] if told is None else [with_numbers(told)]
    letters = letters_of(value)

    def is_reached(point: Point) -> bool | None:
        sign = sign_at(value, point)
        return None if sign is None else sign == 1

    return just_where(conditions, is_reached, letters, *assumptions_about(letters))


def turned_back(facts: Judged) -> bool:
    """Whether, numerically, the force is positive at the start, and the motion turns back at the place where the force
    vanishes if the result has the operator >=, or before this place otherwise."""
    just_there = facts.result.operator == ">="
    unknown, squared, force = (facts.inputs[role] for role in ("unknown", "squared", "force"))
    ends = [_letter_at(unknown, end) for end in (facts.inputs["start"], facts.inputs["place"].right)]
    values = [with_numbers(explicit(each).subs(*end)) for end in ends for each in (force, squared)]
    letters = set().union(*map(letters_of, values))

    def is_so(point: Point) -> bool:
        pushing, moving, last, beyond = (sign_at(each, point) for each in values)
        return (pushing, last, beyond) == (1, 0, 0 if just_there else -1) and moving in (0, 1)

    return everywhere(trial_points(letters, *assumptions_about(letters)), is_so)


def by_energy(facts: Judged, fact: ByEnergy) -> bool:
    """Whether the acceleration is (1/2) d(q_dot^2)/dq, and q_dot^2 has the given value at the start."""
    square, q = explicit(facts.result), fact.coordinate
    acceleration = fact.acceleration.subs(rate(q) ** 2, square)
    there = square.subs(q, fact.start) - fact.start_rate**2
    return facts.symbol == rate(q) ** 2 and is_zero(there) and is_zero(diff(square, q) / 2 - acceleration)


def steady(facts: Judged, fact: Steady) -> bool:
    """Whether the steady motion has the constant values that the sentence states, and the result is a condition of this
    motion."""
    told = {v.left: v.right for role, v in facts.inputs.items() if role.startswith(("stays_", "turns_"))}
    held = {**fact.values, **{rate(s): v for s, v in fact.rates.items()}}
    fits = any(same_equation(each, explicit(facts.result).residual) for each in fact.conditions)
    return fits and all(s in held and is_zero(held[s] - value) for s, value in told.items())


def friction_and_normal_of_one_contact(facts: Judged, outcome: str) -> bool:
    """Whether the two forces act at one place, perpendicular to each other, and the coefficient belongs to their
    contact."""
    friction, normal = (_constraint_of(facts.quantities[role]) for role in ("friction", "normal"))
    if friction is None or normal is None or friction.limit is None:
        return False
    along, pushing = (each.forces[0] for each in (friction, normal))
    together = zip(along.at.components, pushing.at.components, strict=True)
    across = zip(along.direction, pushing.direction, strict=True)
    is_one_place = all(is_zero(a - b) for a, b in together) and is_zero(Add(*(a * b for a, b in across)))
    return is_one_place and is_zero(friction.limit.coefficient - facts.inputs["coefficient"])


def _constraint_of(force: Quantity) -> Constraint | None:
    kept = (ancestor.fact(Constrained) for ancestor in force.ancestors())
    every = (each for found in kept if found is not None for each in found.constraints)
    return next((each for each in every if each.force == force.symbol), None)


def slips_in_the_stated_sense(facts: Judged, outcome: str) -> bool:
    """Whether, numerically, the friction on the body is opposite to the direction of slip, if the sentence states a
    direction. The direction must be "up" or "down" if and only if the friction has a vertical component."""
    if "sense" not in facts.words:
        return True
    constraint = _constraint_of(facts.quantities["friction"])
    assert constraint is not None
    x, y = next(each for each in constraint.forces if each.of is not None).direction
    side = facts.inputs["side"]
    across, wanted = {"up": (y, -1), "down": (y, 1), "right": (x, -1), "left": (x, 1)}[facts.words["sense"]]
    has_height = sign_found(y) in (1, -1)  # if not, the sentence states left or right
    return (facts.words["sense"] in ("up", "down")) == has_height and sign_found(side * across) == wanted


def names_its_slider(facts: Judged, outcome: str) -> bool:
    """Whether the sentence uses the name that the contact has for the slipping body, or "body" if there is no such
    name."""
    constraint = _constraint_of(facts.quantities["friction"])
    return (
        constraint is not None
        and constraint.limit is not None
        and facts.words
        == {
            **facts.words,
            "slider": constraint.limit.slider or "body",
        }
    )


def needs_no_friction(facts: Judged) -> bool:
    return is_zero(facts.inputs["friction"]) and facts.result.operator == "=" and is_zero(facts.result.residual)


def sticks_where(wanted: bool | None) -> Predicate:
    """Judge whether, numerically, |F| <= mu_s N if and only if the result holds. For `wanted=True`, |F| <= mu_s N must
    hold for all trial numbers, and for `wanted=False`, for none.

    If the condition is for one of two possible directions of F, friction in the other direction also counts as
    sufficient.
    """

    def is_so(facts: Judged) -> bool:
        F, N, mu = (with_numbers(facts.inputs[role]) for role in ("friction", "normal", "coefficient"))
        side, alone = facts.inputs["side"], facts.inputs["alone"] == 1
        letters = letters_of(F) | letters_of(N) | letters_of(mu)
        conditions = assumptions_about(letters)

        def suffices(point: Point) -> bool | None:
            held, pushed, most = (real_at(each, point) for each in (F, N, mu))
            if held is None or pushed is None or most is None or not pushed > 0:
                return None
            return bool(abs(held) <= most * pushed) or not alone and bool(side * held < 0)

        if not alone and not {1, -1} <= signs_of(F, *conditions):
            return False
        if wanted is None:
            return just_where([with_numbers(facts.result)], suffices, letters, *conditions)
        return everywhere(trial_points(letters, *conditions), lambda point: _as_wanted(wanted, suffices(point)))

    return is_so


def _as_wanted(wanted: bool, verdict: bool | None) -> bool | None:
    return None if verdict is None else verdict == wanted


def _room(facts: Judged, at: Expr, point: Point) -> Expr | None:
    """Return mu_s N - |F| at a place; None if N is not positive at this place, or if a value is not real."""
    there = {**point, facts.inputs["coordinate"]: at}
    F, N, mu = (real_at(with_numbers(facts.inputs[role]), there) for role in ("friction", "normal", "coefficient"))
    return None if F is None or N is None or mu is None or not N > 0 else mu * N - abs(F)


def _turns_back_within(facts: Judged, begin: Expr, end: Expr, point: Point) -> bool:
    """Whether the squared rate is negative at `end`, or at one of several places between `begin` and `end`."""
    q, squared = facts.inputs["coordinate"], with_numbers(facts.inputs["squared"])
    way = (begin + (end - begin) * Rational(n, 7) for n in range(1, 8))
    return any(sign_at(squared, {**point, q: here}) == -1 for here in way)


def _letters_of_motion(facts: Judged) -> set[Any]:
    roles = ("friction", "normal", "coefficient", "squared", "begin")
    found = set[Any]().union(*(letters_of(with_numbers(facts.inputs[role])) for role in roles))
    return found - {facts.inputs["coordinate"]}


def slips_first(facts: Judged) -> bool:
    """Whether, numerically, mu_s N - |F| is positive before the place and zero at the place. The friction F at the
    place must have the stated sign. The stated condition for reaching the place must be correct.

    If the sentence states a condition for sticking at the start, mu_s N - |F| must not be positive at the start for
    numbers that violate this condition. Numbers for which the motion turns back before the place are skipped.
    """
    start, place = with_numbers(facts.inputs["begin"]), with_numbers(_letter_at(*facts.result.sides)[1])
    letters = _letters_of_motion(facts)
    conditions, told = assumptions_about(letters), facts.inputs.get("starts")

    def is_so(point: Point) -> bool | None:
        begin, end = real_at(start, point), real_at(place, point)
        if begin is None or end is None or _turns_back_within(facts, begin, end, point):
            return None
        room = [_room(facts, begin + (end - begin) * Rational(n, 9), point) for n in range(10)]
        if told is not None and not holds_at(with_numbers(told), point):
            return room[0] is None or not room[0] > 0
        F = real_at(with_numbers(facts.inputs["friction"]), {**point, facts.inputs["coordinate"]: end})
        there = room[-1]
        is_border = F is not None and there is not None and abs(there) <= SMALL * abs(F)
        on_the_way = all(each is not None and each > 0 for each in room[:-1])
        return is_border and on_the_way and bool(facts.inputs["side"] * F > 0)

    is_first = _vanishing_force(facts) and everywhere(trial_points(letters, *conditions), is_so)
    return is_first and _gets_there_as_told(facts)


def slips_at_once(facts: Judged) -> bool:
    """Whether, numerically, mu_s N - |F| is negative at the start."""
    letters = _letters_of_motion(facts)

    def is_so(point: Point) -> bool | None:
        begin = real_at(with_numbers(facts.inputs["begin"]), point)
        room = None if begin is None else _room(facts, begin, point)
        return None if room is None else bool(room < 0)

    return everywhere(trial_points(letters, *assumptions_about(letters)), is_so)


def never_slips(facts: Judged) -> bool:
    """Whether, numerically, mu_s N - |F| is positive at all tried places that the motion reaches. If the sentence
    states a condition, mu_s N - |F| must not be positive at the start of the motion for trial numbers
    that violate it."""
    letters, distances = _letters_of_motion(facts), [Rational(n, 5) for n in range(-8, 9)]
    told = facts.inputs.get("starts")

    def is_so(point: Point) -> bool | None:
        begin = real_at(with_numbers(facts.inputs["begin"]), point)
        if begin is None:
            return None
        places = [begin + far for far in distances if not _turns_back_within(facts, begin, begin + far, point)]
        room = [_room(facts, here, point) for here in (begin, *places)]
        if told is not None and not holds_at(with_numbers(told), point):
            return room[0] is None or not room[0] > 0
        return all(each is not None and each > 0 for each in room)

    return everywhere(trial_points(letters, *assumptions_about(letters)), is_so)


def start_of_motion(facts: Judged, place: Any) -> bool:
    """Whether a motion from which the friction or the normal force was derived starts at this place."""
    forces = (facts.quantities["friction"], facts.quantities["normal"])
    found = (ancestor.fact(ByEnergy) for force in forces for ancestor in force.ancestors())
    return any(known.coordinate == place.left and is_zero(known.start - place.right) for known in found if known)


def energy_there(facts: Judged, place: Any) -> bool:
    """Whether the energy at this place with the initial rate is the conserved value."""
    start = {place.left: explicit(place.right), rate(place.left): explicit(facts.inputs["initial"])}
    return place.operator == "=" and is_zero(
        value_of_role(facts, "energy").subs(start, simultaneous=True) - explicit(facts.result).right
    )


def turns_back_there(facts: Judged, amplitude: Any) -> bool:
    return is_zero(value_of_role(facts, "squared").subs(facts.inputs["coordinate"], amplitude))


def pushes_there(facts: Judged, place: Any) -> bool:
    """Whether `place` is an equation for the unknown on the left side of the result. If the unknown is a
    symbol, the force there must not be known to be negative."""
    alone = bool(facts.result.left == place.left) and place.operator == "="
    if not isinstance(place.left, Symbol):
        return alone
    return alone and not is_negative(value_of_role(facts, "force").subs(place.left, explicit(place.right)))


def force_vanishes_there(facts: Judged, place: Any) -> bool:
    """Whether the force is zero at the named place."""
    return place.operator == "=" and is_zero(
        value_of_role(facts, "force").xreplace({place.left: explicit(place.right)})
    )


def stays_and_turns(facts: Judged, relation: Any) -> bool:
    """Whether the result is equivalent to dL/dq = 0 for the constant coordinates and rates that the sentence states.
    Without a Lagrangian, the equation of motion takes the place of dL/dq = 0."""
    told = {v.left: explicit(v.right) for role, v in facts.inputs.items() if role.startswith(("stays_", "turns_"))}
    if relation.operator != "=" or relation.left == relation.right:
        return False
    if "lagrangian" not in facts.quantities:  # the condition is from an equation of motion, which contains the rates
        q = facts.inputs["coordinate"]
        still = {rate(q): Integer(0), rate(q, 2): Integer(0), **told}
        left = explicit(facts.inputs["equation"]).residual.subs(still, simultaneous=True)
        return same_equation(left, explicit(facts.result).residual)
    L, q = value_of_role(facts, "lagrangian"), facts.inputs["coordinate"]
    cyclic = {rate(s) for s in facts.quantities["lagrangian"].coordinates if not L.has(s)}
    still = {rate(s): Integer(0) for s in facts.quantities["lagrangian"].coordinates if rate(s) not in cyclic}
    slope = diff(L, q).subs({**still, **told}, simultaneous=True)
    return same_equation(slope, explicit(facts.result).residual)


def sum_left(wanted: str) -> Predicate:
    """Judge the terms that contain no highest rate: there are none ("plain"), their sum is zero ("cancel"), or their
    sum is not zero ("remain")."""

    def is_so(facts: Judged) -> bool:
        highest = dict.fromkeys(facts.inputs["highest"], Integer(0))
        before = [tidied(side.xreplace(highest)) for side in facts.inputs["products"]]
        left = facts.result.left.xreplace(highest)
        if wanted == "remain":
            return not is_zero(left)
        return is_zero(left) and (wanted == "plain") == all(is_zero(each) for each in before)

    return is_so


def times_its_factor(facts: Judged) -> bool:
    """Whether the left side of the result is the left side of the equation of motion times the factor that the sentence
    names."""
    multiplied = explicit(facts.inputs["factor"]) * explicit(facts.inputs["written"].left)
    return is_zero(explicit(facts.result.left) - multiplied)


def nothing_else_moves(facts: Judged) -> bool:
    """Whether the result contains neither an acceleration nor the rate of the coordinate, and is not 0 = 0."""
    q = facts.inputs["coordinate"]
    moving = {s for s in facts.result.free_symbols if s.name.endswith("_ddot")} | {rate(q)}
    return not is_zero(facts.result.residual) and not moving & facts.result.free_symbols


def sum_of_the_equations_times_their_factors(facts: Judged, outcome: str) -> bool:
    """Whether the sum of the named equations, each times its named factor, is the result."""
    named = [role for role in facts.quantities if role.startswith("equation_")]
    products = (facts.inputs[f"factor_{role[9:]}"] * explicit(facts.quantities[role].value).residual for role in named)
    return is_zero(explicit(facts.result).residual - sum(products, Integer(0)))


leaves_contact_never: Predicate = sign_is(1, lambda facts: facts.inputs["force"])


def product_alone(facts: Judged) -> bool:
    return bool(facts.inputs["of_many"] == 1 and times_its_factor(facts))


def product_one_of_several(facts: Judged) -> bool:
    return bool(facts.inputs["of_many"] > 1 and times_its_factor(facts))


def steady_motion_always(facts: Judged) -> bool:
    return is_zero(facts.result.residual)


steady_motion_generic: Predicate = negated(steady_motion_always)


handed_on_by(ByEnergy, by_energy)
handed_on_by(SignedRate, has_sense)
handed_on_by(Steady, steady)


# --- free flight ---

ON_THE_WAY = tuple(Rational(n, 12) for n in range(1, 12))  # fractions of the time of a flight
LATER = (Rational(1, 50), Rational(1, 3), Integer(1), Integer(4), Integer(50))  # times in units of speed/acceleration


def is_the_place_of_departure(facts: Judged) -> bool:
    """Whether the relation states the place at which contact is lost, with the new symbol instead of the coordinate."""
    lost, q, letter = facts.inputs["lost"], facts.inputs["coordinate"], facts.inputs["letter"]
    back = facts.result.left.xreplace({letter: q})
    return bool(q not in facts.result.free_symbols and back == lost.left) and is_zero(facts.result.right - lost.right)


def speeds_up(wanted: bool) -> Predicate:
    """Judge whether a constant force acts along the axis of this component; for `wanted=False`, whether no force acts
    along this axis."""

    def is_so(facts: Judged) -> bool:
        bend = diff(facts.result, TIME, 2)
        return not depends_on_time(bend) and is_zero(bend) != wanted and is_zero(facts.inputs["other_force"]) != wanted

    return is_so


def in_flight(facts: Judged, fact: InFlight) -> bool:
    """Whether the fact describes a free flight from the curve on which the particle moved.

    At t = 0 the particle is at the place of the departure. Its velocity is along the curve and away from the start, and
    its speed follows from conservation of energy.
    """
    q, angle = fact.coordinate
    before = [fact.in_given_letters(c) for c in fact.path]
    matter, place = fact.matter, [explicit(c) for c in fact.point.place]
    free = [each for each in matter.others if getattr(each, "multiplier", None) not in fact.ended]
    weight = [fact.point.mass * diff(c, TIME, 2) for c in fact.path]
    works = all(
        is_zero(
            Add(*(explicit(each.work_along(s)) for each in (*matter.loads, *free)))
            - Add(*(f * diff(c, s) for f, c in zip(weight, place, strict=True)))
        )
        for s in matter.coordinates
        if any(c.has(s) for c in place)
    )
    shown = any(is_zero(facts.result - c) for c in fact.path)
    return bool(works and shown) and _starts_on_its_curve(fact, q, angle, before)


def _starts_on_its_curve(fact: InFlight, q: Symbol, angle: Expr, path: list[Expr]) -> bool:
    place, residual = [explicit(c) for c in fact.point.place], explicit(fact.kept.residual)
    (s,) = (each for each in fact.matter.coordinates if each != q and any(c.has(each) for c in place))
    held = next(iter(_where_zero(residual, s)))
    there = {s: held, q: angle}
    rates = [diff(c, s) * rate(s) + diff(c, q) * rate(q) for c in place]
    squared = explicit(fact.squared).subs(q, angle)
    wanted = [c.subs({rate(s): 0}).subs(there) for c in rates]
    sign = _sense(angle - fact.start, fact)
    for c, r, w in zip(path, place, wanted, strict=True):
        if not is_zero(tidied(c.subs(TIME, 0) - r.subs(there))):
            return False
        velocity, rated = diff(c, TIME).subs(TIME, 0), w.subs(rate(q), 1)
        if not is_zero(tidied(velocity**2 - rated**2 * squared)) or _opposed(velocity, sign * rated, fact):
            return False
    return not residual.has(q)


def spins_as_it_rolled(facts: Judged) -> bool:
    """Whether the angular velocity is constant, and satisfies the condition of rolling at the departure."""
    speed, turn, q = facts.quantities["speed"], facts.inputs["turn"], facts.inputs["coordinate"]
    held = dict(facts.inputs["held"])
    rates = {
        turn: explicit(facts.result),
        rate(q): facts.inputs["sense"] * explicit(speed.value) / facts.inputs["speed_at"],
    }
    left = explicit(facts.inputs["friction"]).subs({**held, **{rate(s): 0 for s in held}}).subs(rates)
    return not depends_on_time(explicit(facts.result)) and is_zero(tidied(left.subs(q, facts.inputs["place"])))


def _where_zero(residual: Expr, s: Symbol) -> list[Expr]:
    slope = diff(residual, s)
    return [tidied(-residual.subs(s, 0) / slope)]


def _trials(value: Expr, fact: InFlight) -> list[Point]:
    letters = letters_of(value)
    return trial_points(letters, *assumptions_about(letters), *map(with_numbers, fact.conditions))


def _sense(change: Expr, fact: InFlight) -> int:
    found = signs(with_numbers(change), _trials(with_numbers(change), fact)) - {None, 0}
    return 1 if found == {1} else -1 if found == {-1} else 0


def _opposed(velocity: Expr, expected: Expr, fact: InFlight) -> bool:
    """Whether, for some trial numbers, a component of the velocity has the sign opposite to the expected sign."""
    product = with_numbers(velocity * expected)
    return not signs(product, _trials(product, fact)) <= {1, 0, None}


def _away(fact: InFlight, target: Any) -> Expr:
    """The distance from the plane as a function of the time; without a plane, the distance from the circle that the
    particle left. The distance is positive on the free side."""
    x, y = fact.path
    if target is not None:
        (px, py), (nx, ny) = target.through.components, target.unit_normal.components
        return nx * (x - px) + ny * (y - py) - fact.radius
    assert fact.orbit is not None
    (cx, cy), radius = fact.orbit.centre, fact.orbit.radius
    beyond = sqrt((x - cx) ** 2 + (y - cy) ** 2) - radius
    return -beyond if fact.orbit.inside else beyond


def _at_times(facts: Judged, times: tuple[Expr, ...], wanted: int) -> bool:
    """Whether, numerically, the particle is on the free side at these times, or on the surface if `wanted` is 0."""
    fact, target = facts.inputs["flight"], facts.inputs["target"]
    away = _away(fact, target)
    values = [with_numbers(away.subs(TIME, time)) for time in times]
    near = Rational(1, 10**9)

    def is_so(point: Point) -> bool | None:
        for value in values:
            if wanted == 0:
                ends = sign_at(value - near, point), sign_at(value + near, point)
                if None in ends:
                    return None
                if ends != (-1, 1):
                    return False
            elif (sign := sign_at(value, point)) != wanted:
                return None if sign is None else False
        return True

    return everywhere(_trials(Add(*values, evaluate=False), fact), is_so)


def lands(outcome: str) -> Predicate:
    """Judge whether, numerically, the particle reaches the plane or the circle at this time, from the free side."""

    def is_so(facts: Judged) -> bool:
        fact, target, time = facts.inputs["flight"], facts.inputs["target"], explicit(facts.result)
        is_string = fact.kept.enforcer == "string"
        fits = outcome == ("on_plane" if target is not None else "taut" if is_string else "back")
        positive = _sense(time, fact) == 1
        before = tuple(part * time for part in ON_THE_WAY)
        return bool(fits and positive) and _at_times(facts, before, 1) and _at_times(facts, (time,), 0)

    return is_so


def stays_clear(facts: Judged) -> bool:
    """Whether, numerically, the particle is outside the circle at all later times that are tried."""
    fact = facts.inputs["flight"]
    return facts.inputs["target"] is None and not fact.orbit.inside and _at_times(facts, _later(fact), 1)


def misses(facts: Judged) -> bool:
    """Whether, numerically, the particle is on the free side of the plane at all later times that are tried."""
    return facts.inputs["target"] is not None and _at_times(facts, _later(facts.inputs["flight"]), 1)


def _later(fact: InFlight) -> tuple[Expr, ...]:
    speed = sqrt(Add(*(diff(c, TIME).subs(TIME, 0) ** 2 for c in fact.path)))
    pull = sqrt(Add(*(diff(c, TIME, 2) ** 2 for c in fact.path)))
    return tuple(n * speed / pull for n in LATER)


def passes(facts: Judged) -> bool:
    """Whether the condition is equivalent to y(t) = Y, where (X, Y) is the place and t is the time with x(t) = X. This
    time must be numerically positive."""
    fact, (X, Y) = facts.inputs["flight"], facts.inputs["place"]
    x, y = fact.path
    time = tidied((X - x.subs(TIME, 0)) / diff(x, TIME))
    height = tidied(y.subs(TIME, time) - Y)
    return _sense(time, fact) == 1 and same_equation(height, explicit(facts.result).residual)


handed_on_by(InFlight, in_flight)
