"""Predicates of observations.

Most of them compare numbers at trial points. Some of them evaluate not only the answer but also the first line of its
derivation, which is not yet simplified.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import reduce
from itertools import pairwise
from typing import Any

from sympy import (
    Expr,
    Integer,
    Poly,
    Rational,
    Symbol,
    cos,
    diff,
    expand,
    expand_trig,
    fraction,
    gcd,
    minimal_polynomial,
    nan,
    pi,
    quo,
    sin,
    sqrt,
    together,
)
from sympy.polys.polyerrors import BasePolynomialError

from derive.algebra.expressions import TIME, Amount, Relation, bound, depends_on_time, explicit, rate
from derive.algebra.period_series import half_swing
from derive.algebra.ranges import range_of
from derive.algebra.rounding import half_a_unit
from derive.algebra.samples import NoNumber, Undefined, letters_of, value_at
from derive.steps.known_numbers import with_numbers
from derive.steps.record import assumed
from derive.steps.rule import Judged, Naming, Predicate
from derive.steps.step import Quantity
from derive.steps.trial_numbers import Point, assumptions_about, everywhere, holds_at, real_at, trial_points

CLOSE = Rational(1, 10**15)


def forms(quantity: Quantity) -> list[Expr]:
    """Return the value of a quantity and the first line of its derivation, if this line is an expression."""
    first = quantity.step.chain[0].expr
    lines = [quantity.value] + ([bound(first, dict(quantity.step.names))] if isinstance(first, Expr) else [])
    return [explicit(line) for line in lines]


def same(one: Expr, other: Expr) -> bool:
    """Whether two numbers agree within the precision of the computation."""
    return bool(abs(one - other) <= CLOSE * (abs(one) + abs(other)))


def numbers(values: Iterable[Any], *more: Any, tried: int = 12) -> list[Point]:
    """Return trial points for all symbols of these values."""
    letters = {s for value in (*values, *more) for s in letters_of(explicit(value))}
    return trial_points(letters, *assumptions_about(letters), tried=tried)


def for_each_form(quantity: Quantity, is_so: Callable[[Expr, Point], bool | None], *others: Any) -> bool:
    """Whether a statement about a quantity is true of its value. At points where the first line of its derivation can
    be evaluated, the statement must also be true of this line."""
    value, *lines = forms(quantity)
    points = numbers([value], *others)
    return everywhere(points, lambda point: is_so(value, point)) and all(
        _nowhere_false(numbers([line], *others), line, is_so) for line in lines
    )


def _nowhere_false(points: Iterable[Point], line: Expr, is_so: Callable[[Expr, Point], bool | None]) -> bool:
    def verdicts() -> Iterator[bool | None]:
        for point in points:
            try:
                yield is_so(line, point)
            except (Undefined, NoNumber):
                yield None

    return all(verdict is not False for verdict in verdicts())


# --- frequencies ---


def squared_rate(facts: Judged, number: Expr) -> Expr:
    """Return the squared angular frequency from the value of the answer, which is an angular frequency or a period."""
    return 4 * pi**2 / number**2 if facts.words["seen"] == "period" else number**2


def swings_like_a_pendulum(facts: Judged) -> bool:
    """Whether omega^2 l = g for the result l."""
    of, length, g = facts.quantities["of"], facts.result, facts.inputs["g"]

    def is_so(line: Expr, point: Point) -> bool:
        square = squared_rate(facts, value_at(line, point)).evalf(30)
        return same(square * value_at(length, point), value_at(g, point))

    return for_each_form(of, is_so, length, g)


def is_a_length_or_its_symbol(facts: Judged, told: Any) -> bool:
    """Whether the stated length is the result and does not contain g, or is a symbol. For a symbol, the sentence must
    also state its value, which another predicate checks, or an acceleration, which the outcome checks."""
    if told == facts.result:
        return facts.inputs["g"] not in told.free_symbols
    return isinstance(told, Symbol) and bool({"equal", "field"} & set(facts.inputs))


def is_value_of_the_symbol(facts: Judged, found: Expr) -> bool:
    """Whether the length is the value of the symbol that the sentence names."""
    told = facts.inputs["length"]
    values = [explicit(value) for q in facts.quantities.values() for name, value in q.named_values if name == told]
    return found == facts.result and any(_agree(value, found) for value in values)


def _agree(one: Expr, other: Expr) -> bool:
    return everywhere(numbers([one, other]), lambda point: same(value_at(one, point), value_at(other, point)))


def swings_in_the_field(facts: Judged) -> bool:
    """Whether omega^2 l is the stated acceleration for the stated length l."""
    of, length, field = facts.quantities["of"], facts.inputs["length"], facts.inputs["field"]

    def is_so(line: Expr, point: Point) -> bool:
        square = squared_rate(facts, value_at(line, point)).evalf(30)
        return same(square * value_at(length, point), value_at(field, point))

    return for_each_form(of, is_so, field, length)


def differs_from_gravity(facts: Judged, field: Expr) -> bool:
    """Whether the stated acceleration contains g, is not g itself, and does not contain the length."""
    g, length = facts.inputs["g"], facts.inputs["length"]
    return g in field.free_symbols and length not in field.free_symbols and not _agree(field, g)


def orbital(facts: Judged, ratio: Expr, at: Mapping[Any, Expr] | None = None) -> bool:
    """Whether the radial frequency is `ratio` times the orbital rate at the radius of the circular orbit.

    at   values of symbols for a special case
    """
    of, rate = facts.quantities["of"], facts.inputs["orbital_rate"]
    special = {s: explicit(v) for s, v in (at or {}).items()}

    def is_so(line: Expr, point: Point) -> bool:
        there = {**point, **{s: value_at(v, point) for s, v in special.items()}}
        return same(value_at(line, there), value_at(ratio, there) * abs(value_at(rate, there)))

    return for_each_form(of, is_so, rate, ratio, *special.values())


def orbital_ratio(wanted: Callable[[Expr], bool]) -> Predicate:
    """Judge whether the result is the ratio of the radial frequency to the orbital rate, and satisfies `wanted`."""

    def is_so(facts: Judged) -> bool:
        return wanted(facts.result) and orbital(facts, facts.result)

    return is_so


def closes_for(ratio: int) -> Naming:
    """Judge whether the radial frequency is `ratio` times the orbital rate for the stated value of a symbol."""

    def is_so(facts: Judged, told: Relation) -> bool:
        return orbital(facts, Integer(ratio), {told.left: told.right})

    return is_so


def rate_on_the_circle(facts: Judged, told: Any) -> bool:
    """Whether the rate in symbols, such as l/(m r_0^2), is the orbital rate on the circular orbit."""
    names = dict(entry for q in facts.quantities.values() for entry in q.named_values)
    letters = told.right if isinstance(told, Relation) else told
    return _agree(explicit(bound(letters, names)), facts.inputs["orbital_rate"])


def ratio_of_modes(rational: bool) -> Predicate:
    """Judge whether the result is the ratio of two frequencies, and is a rational number if and only if `rational` is
    true. With more than two coordinates, `rational=True` is never accepted."""

    def is_so(facts: Judged) -> bool:
        slow, fast = (facts.quantities[role] for role in ("slow", "fast"))
        ratio = facts.result
        degree = Poly(minimal_polynomial(ratio, Symbol("z"))).degree()

        def agrees(line: Expr, point: Point) -> bool:
            number = value_at(slow.value, point)
            oscillate = all(_is_a_frequency(facts, each, point) for each in (number, value_at(line, point)))
            return oscillate and same(value_at(line, point), ratio.evalf(30) * number)

        mass, stiffness = facts.inputs["system"]
        if rational and mass.shape[0] > 2:
            return False  # a third mode may have a different ratio
        return (degree == 1) == rational and for_each_form(fast, agrees, slow.value, *mass, *stiffness)

    return is_so


def _is_a_frequency(facts: Judged, number: Expr, point: Point) -> bool:
    """Whether det(K - omega^2 M) = 0. A growth rate does not satisfy this equation."""
    mass, stiffness = (matrix.applyfunc(lambda e: value_at(e, point)) for matrix in facts.inputs["system"])
    found, size = ((stiffness - sign * number**2 * mass).det() for sign in (1, -1))
    return bool(abs(found) <= abs(size) / 10**9)  # the determinant loses digits


def is_ratio_of(above: str, below: str) -> Naming:
    """Judge whether the left side of an equation is the ratio of two answers, and the right side is the result."""

    def is_so(facts: Judged, told: Relation) -> bool:
        ratio = explicit(told.left)
        symbols = [facts.quantities[role].symbol for role in (above, below)]
        return bool(ratio == symbols[0] / symbols[1]) and told.right == facts.result

    return is_so


def all_frequencies_are_equal(facts: Judged) -> bool:
    """Whether the equations of motion are linear without any approximation and have only one frequency.

    M^-1 K is then a multiple of the unit matrix at all trial points.
    """
    linear, of = facts.inputs["system"], facts.quantities["of"]
    mass, stiffness = linear
    size = mass.shape[0]

    def is_so(line: Expr, point: Point) -> bool:
        square = value_at(line, point) ** 2
        return all(
            same(value_at(stiffness[i, j], point), square * value_at(mass[i, j], point))
            if stiffness[i, j] != 0 or mass[i, j] != 0
            else True
            for i in range(size)
            for j in range(size)
        )

    moving = [rate(q, n) if n else q for q in facts.inputs["moving"] for n in (0, 1, 2)]
    curved = [residual.diff(a).diff(b) for residual in facts.inputs["motions"] for a in moving for b in moving]
    is_linear = everywhere(numbers(curved), lambda point: all(value_at(each, point) == 0 for each in curved))
    return size > 1 and is_linear and for_each_form(of, is_so, *mass, *stiffness)


def isochronous(facts: Judged) -> bool:
    """Whether mu depends on q, and d^2U/ds^2 = omega^2 at all trial points, where T = mu q_dot^2/2 and ds = sqrt(mu)
    dq.

    The derivatives are difference quotients of the energies.
    """
    q, mu, energy, square = (facts.inputs[role] for role in ("q", "mu", "energy", "square"))
    step = Rational(1, 10**9)

    def force(point: Point, at: Expr) -> Expr:
        ahead, behind = (value_at(energy, {**point, q: at + s * step}) for s in (1, -1))
        return (ahead - behind) / (2 * step) / sqrt(value_at(mu, {**point, q: at}))

    def is_so(point: Point) -> bool:
        small = {**point, q: point[q] / (1 + abs(point[q]))}
        at, apart = small[q], Rational(1, 10**5)
        slope = (force(small, at + apart) - force(small, at - apart)) / (2 * apart) / sqrt(value_at(mu, small))
        return bool(abs((slope / value_at(square, small)).evalf(30) - 1) < Rational(1, 10**6))

    curved = not everywhere(
        numbers([mu]), lambda point: same(value_at(mu, point), value_at(mu, {**point, q: Integer(0)}))
    )
    return curved and everywhere(numbers([q, mu, energy, square]), is_so)


def is_the_length_along_the_path(facts: Judged, told: Relation) -> bool:
    """Whether m s_dot^2/2 is the kinetic energy, and m omega^2 s^2/2 the potential energy above its least value."""
    q, mu, energy, square, mass = (facts.inputs[role] for role in ("q", "mu", "energy", "square", "mass"))
    s = told.right
    low = energy.xreplace({q: facts.inputs["lowest"]})

    def is_so(point: Point) -> bool:
        small = {**point, q: point[q] / (1 + abs(point[q]))}
        kinetic = same(value_at(s.diff(q), small) ** 2 * value_at(mass, small), value_at(mu, small))
        height = value_at(energy - low, small)
        return kinetic and same(value_at(s, small) ** 2 * value_at(mass * square, small) / 2, height)

    return everywhere(numbers([q, mu, energy, square, s, mass]), is_so)


def is_harmonic_along_the_path(facts: Judged, told: Relation) -> bool:
    """Whether the sentence states the equation s_ddot + omega^2 s = 0, where s is the length along the path."""
    s, square = facts.inputs["path"].left, facts.inputs["square"]
    left = explicit(told.left)
    stiffness = left.coeff(s)
    return (
        explicit(told.right) == 0
        and left.coeff(rate(s, 2)) == 1
        and len(left.as_ordered_terms()) == 2
        and everywhere(numbers([stiffness, square]), lambda p: same(value_at(stiffness, p), value_at(square, p)))
    )


# --- dependence ---


def is_the_result(facts: Judged, told: Any) -> bool:
    """Whether the stated value is the result and agrees with the assumptions of the page. The outcome judges the result
    itself."""
    return bool(told == facts.result) and _is_allowed(told)


def is_the_result_by_name(facts: Judged, told: Any) -> bool:
    """Whether the stated value is the result, if each defined symbol in it is replaced by its formula."""
    names = {q.symbol: explicit(q.value) for q in facts.quantities.values() if isinstance(q.value, Expr)}
    return is_the_result(facts, Relation(told.left, told.operator, explicit(bound(told.right, names))))


def _is_allowed(place: Relation) -> bool:
    """Whether the assumptions hold for the stated value of a symbol, with suitable numbers for the other symbols."""
    there = {place.left: explicit(place.right)}
    about = [each for each in map(explicit, map(with_numbers, assumed())) if each.has(place.left)]
    apart = [Relation(expand(each.residual.xreplace(there)), each.operator, 0) for each in about]
    others = {s for each in apart for s in letters_of(each.left)}
    return any(
        all(holds_at(each, point) for each in apart) for point in trial_points(others, *assumptions_about(others))
    )


def names_a_letter(facts: Judged) -> bool:
    """Whether the sentence names at least one symbol; another predicate judges each of these symbols."""
    return "letter_1" in facts.inputs


def _may_vary(letter: Symbol, point: Point) -> Point:
    """Return the point with a different number for this symbol only."""
    return {**point, letter: point[letter] * Rational(8, 7)}


def is_free_of(facts: Judged, letter: Symbol) -> bool:
    """Whether the answer does not depend on the symbol, although a line in the steps that lead to the answer depends on
    it."""
    of = facts.quantities["of"]
    value = explicit(of.value.right if isinstance(of.value, Relation) else of.value)
    points = numbers([value, letter])
    unchanged = everywhere(points, lambda p: same(value_at(value, p), value_at(value, _may_vary(letter, p))))
    behind = [form.expr for role, q in facts.quantities.items() if role != "of" for form in q.step.chain]
    return unchanged and any(_depends_on(letter, line) for line in behind if isinstance(line, Expr | Relation))


def _depends_on(letter: Symbol, value: Any) -> bool:
    inner = explicit(value.residual if isinstance(value, Relation) else value)
    if letter not in inner.free_symbols:
        return False
    return not everywhere(numbers([inner]), lambda p: same(value_at(inner, p), value_at(inner, _may_vary(letter, p))))


def only_shifts_the_equilibrium(facts: Judged) -> bool:
    """Whether the gravitational acceleration changes the equilibrium position, but not the frequency or period."""
    return is_free_of(facts, facts.inputs["g"]) and _depends_on(facts.inputs["g"], facts.quantities["rest"].value)


def is_pure_angle(facts: Judged, angle: Expr) -> bool:
    """Whether the stated angle is a number that satisfies the equation of the answer."""
    of = facts.quantities["of"]
    left, right = of.value.sides if isinstance(of.value, Relation) else (of.symbol, of.value)
    (moving,) = left.free_symbols
    number = value_at(left.xreplace({moving: angle}), {})
    return not explicit(right).free_symbols and same(number, value_at(explicit(right), {}))


def is_rounded(facts: Judged, told: Amount) -> bool:
    """Whether the number of degrees differs from the angle by at most half a unit of the last place."""
    rounded = told.args[0]
    number = value_at(rounded.args[0], {})
    return bool(abs(value_at(facts.inputs["angle"], {}) * 180 / pi - number).evalf(30) <= half_a_unit(rounded))


def vanishes_there(sign_changes: bool) -> Predicate:
    """Judge whether the answer vanishes for the stated value of a symbol or an angle. It must change its sign at this
    value if and only if `sign_changes` is true."""

    def is_so(facts: Judged) -> bool:
        of, place = facts.quantities["of"], facts.result

        def at(line: Expr, point: Point) -> bool:
            there = value_at(explicit(place.right), point)
            little = abs(there) / 10**6 + (Rational(1, 10**6) if there == 0 else 0)
            at_place, before, after = (value_at(line, {**point, place.left: there + k * little}) for k in (0, -1, 1))
            scale = value_at(line, point)
            is_zero = abs(at_place) <= CLOSE * (abs(scale) + abs(before))
            return bool(is_zero and (before * after < 0) == sign_changes and before != 0 and after != 0)

        value = explicit(of.value)
        return everywhere(numbers([value, place.right]), lambda point: at(value, point))

    return is_so


def vanishes_for_equal_symbols(facts: Judged) -> bool:
    """Whether the answer vanishes if two symbols are equal, and changes its sign there."""
    is_symbol = isinstance(facts.result.left, Symbol) and isinstance(facts.result.right, Symbol)
    return is_symbol and bool(vanishes_there(True)(facts))


def is_in_the_result(facts: Judged, told: Any) -> bool:
    """Whether the stated symbol is the left side of the result."""
    return bool(told == facts.result.left)


def grows_without_bound_there(facts: Judged) -> bool:
    """Whether the amplitude grows strongly as the symbol approaches the stated value, and this value is the angular
    frequency of the free oscillation."""
    of, place, square = facts.quantities["of"], facts.result, facts.inputs["square"]

    def is_so(point: Point) -> bool:
        there = value_at(explicit(place.right), point)
        far, near = (
            abs(value_at(explicit(of.value), {**point, place.left: there * (1 + e)})) for e in (CLOSE, CLOSE**2)
        )
        return bool(near > 10**9 * far) and same(there**2, value_at(square, point))

    return everywhere(numbers([explicit(of.value), place.right, square]), is_so)


def branches_off(facts: Judged) -> bool:
    """Whether, at the stated value of the symbol, an equilibrium becomes unstable and two others appear. Just below
    this value only the first equilibrium exists, and it is stable. Just above, the first is unstable, and the two
    others are stable."""
    curvature, beside = (explicit(facts.quantities[role].value) for role in ("of", "beside"))
    cosine, border = facts.inputs["cosine"], facts.result
    here, branch, other = (explicit(facts.quantities[role].value) for role in ("here", "branch", "other"))
    if here != 0 or not _agree(cos(branch), cosine) or not _agree(branch, -other):
        return False

    def is_so(point: Point) -> bool:
        there = value_at(explicit(border.right), point)
        below, above = ({**point, border.left: there * (1 + e)} for e in (-Rational(1, 100), Rational(1, 100)))
        stable = value_at(curvature, below) > 0 > value_at(curvature, above)
        exist = value_at(cosine, below) > 1 > value_at(cosine, above) > 0
        return bool(stable and exist and value_at(beside, above) > 0)

    return everywhere(numbers([curvature, cosine, beside, border.right]), is_so)


def is_this_multiple(facts: Judged) -> bool:
    """Whether the first answer is the result times the second one. The result must be a rational number greater than 1
    or less than -1."""
    of, other = (explicit(facts.quantities[role].value) for role in ("of", "other"))
    ratio = facts.result
    agrees = everywhere(numbers([of, other]), lambda p: same(value_at(of, p), ratio * value_at(other, p)))
    return agrees and bool(ratio.is_Rational) and abs(ratio) > 1


def are_in_order(facts: Judged) -> bool:
    """Whether several values decrease from each to the next, and the first divided by the last is the stated ratio."""
    count = sum(role.startswith("case_") for role in facts.quantities)
    values = [explicit(facts.quantities[f"case_{i}"].value) for i in range(1, count + 1)]

    def is_so(point: Point) -> bool:
        found = [value_at(value, point) for value in values]
        falling = all(one > other for one, other in pairwise(found))
        return bool(falling) and same(found[0], facts.result * found[-1])

    return len(values) > 1 and everywhere(numbers(values), is_so)


def first_to_arrive(facts: Judged) -> bool:
    """Whether the accelerations are constant, and decrease from each case to the next.

    If two bodies are released together from rest, the body with the greater acceleration then arrives first. The cases
    must differ in the value of one symbol, a mass or a moment of inertia, so their paths are the same.
    """
    cases = [q for role, q in facts.quantities.items() if role.startswith("case_")]
    told = [[value for role, value in q.step.roles if role.startswith("value_")] for q in cases]
    if any(len(each) != 1 for each in told):
        return False
    letters = {each[0].left for each in told}
    differ = len({each[0].right for each in told}) == len(cases)
    constant = all(_is_constant(explicit(q.value), q) for q in cases)
    same_path = facts.inputs["kind"] in ("mass", "moment of inertia")
    return len(letters) == 1 and differ and constant and same_path and are_in_order(facts)


def is_case_of_the_first(facts: Judged, told: Any) -> bool:
    """Whether a stated special value was substituted in the first answer."""
    return told in dict(facts.quantities["case_1"].step.roles).values()


def is_case_of_the_last(facts: Judged, told: Any) -> bool:
    """Whether a stated special value was substituted in the last answer."""
    last = sum(role.startswith("case_") for role in facts.quantities)
    return told in dict(facts.quantities[f"case_{last}"].step.roles).values()


def is_in_both(facts: Judged, letter: Symbol) -> bool:
    """Whether both answers depend on the symbol."""
    return all(_depends_on(letter, facts.quantities[role].value) for role in ("of", "other"))


def is_fraction_of_the_familiar(facts: Judged) -> bool:
    """Whether, at all trial points, the magnitude of the acceleration is the result times the magnitude of the familiar
    acceleration. The result must be a rational number between 0 and 1."""
    of, familiar = explicit(facts.quantities["of"].value), facts.inputs["familiar"]
    part = facts.result
    agrees = everywhere(
        numbers([of, familiar]), lambda p: same(abs(value_at(of, p)), part * abs(value_at(familiar, p)))
    )
    return agrees and bool(part.is_Rational) and 0 < part < 1


def free_fall(facts: Judged) -> bool:
    return is_fraction_of_the_familiar(facts) and facts.inputs["familiar"] == facts.inputs["g"]


def slides_freely(facts: Judged) -> bool:
    """Whether the acceleration is the stated fraction of g sin(alpha)."""
    familiar, g, alpha = (facts.inputs[role] for role in ("familiar", "g", "alpha"))
    return is_fraction_of_the_familiar(facts) and familiar == g * sin(alpha)


def _pulling_springs(facts: Judged) -> int:
    """Return how many springs of the system pull with a force that depends on this constant."""
    behind = facts.quantities["of"].ancestors()
    systems = {q.subject.body for q in behind if q.step.rule == "lagrange.potential_energy"}
    letter = facts.inputs["letter"]
    return max((sum(diff(s.pull, letter) != 0 for s in each.between if s.is_spring) for each in systems), default=0)


def keep_the_springs(facts: Judged) -> bool:
    return _pulling_springs(facts) > 1 and _energy_is_kept(facts)


def keeps_the_spring(facts: Judged) -> bool:
    return _pulling_springs(facts) < 2 and _energy_is_kept(facts)


def _energy_is_kept(facts: Judged) -> bool:
    """Whether the energy of the springs with this constant does not change to second order along the mode.

    The stiffness matrix of these springs is the difference between the stiffness matrices for two values of the
    constant.
    """
    letter, shape = facts.inputs["letter"], explicit(facts.quantities["shape"].value)
    stiffness = facts.inputs["stiffness"]

    def is_so(point: Point) -> bool:
        more = {**point, letter: 2 * point[letter]}
        size = range(stiffness.shape[0])
        terms = [
            value_at(shape[i], point)
            * value_at(shape[j], point)
            * (value_at(stiffness[i, j], more) - value_at(stiffness[i, j], point))
            for i in size
            for j in size
        ]
        return bool(abs(sum(terms)) <= CLOSE * sum(map(abs, terms)) and any(t != 0 for t in terms))

    return everywhere(numbers([*stiffness, *shape, letter]), is_so)


def stays_at_rest(facts: Judged) -> bool:
    """Whether this mass is in only one entry of the mass matrix, on the diagonal, and the mode does not move the
    coordinate of this entry."""
    letter, shape = facts.inputs["letter"], explicit(facts.quantities["shape"].value)
    mass, at = facts.inputs["mass"], int(facts.inputs["at"])

    def is_so(point: Point) -> bool:
        more = {**point, letter: 2 * point[letter]}
        size = range(mass.shape[0])
        changed = [
            (i, j) for i in size for j in size if not same(value_at(mass[i, j], more), value_at(mass[i, j], point))
        ]
        return changed == [(at, at)] and value_at(shape[at], point) == 0

    return everywhere(numbers([*mass, *shape, letter]), is_so)


def circles(facts: Judged) -> bool:
    """Whether the acceleration is the velocity turned by a right angle, multiplied by a constant rate."""
    rate_, (u, v) = facts.result, facts.inputs["rates"]
    if not _is_constant(rate_, facts.quantities["of"]) or not _others_are_fixed(facts.quantities["of"], u, v):
        return False
    along, across = (explicit(facts.quantities[role].value) for role in ("of", "other"))

    def is_so(point: Point) -> bool:
        ax, ay, x, y = (value_at(each, point) for each in (along, across, u, v))
        turning = x * ay - y * ax
        return bool(abs(x * ax + y * ay) <= CLOSE * (abs(x * ax) + abs(y * ay))) and same(
            abs(turning), abs(value_at(rate_, point)) * (x**2 + y**2)
        )

    return everywhere(numbers([along, across, rate_, u, v]), is_so)


def _is_constant(value: Expr, of: Quantity) -> bool:
    moving = {s for q in of.coordinates for s in (q, rate(q), rate(q, 2))}
    return not depends_on_time(value) and not explicit(value).free_symbols & {TIME, *moving}


def _others_are_fixed(of: Quantity, *rates: Symbol) -> bool:
    """Whether the derived constraints give z_ddot = 0 for each distance z whose rate is not among `rates`."""
    others = [q for q, kind in of.coordinates.items() if kind == "length" and rate(q) not in rates]
    constraints = [each for each in of.ancestors() if each.step.rule == "lagrange.constraint_rate"] if others else []
    fixed = {s for each in constraints if len(found := explicit(each.value).residual.free_symbols) == 1 for s in found}
    return all(rate(q, 2) in fixed for q in others)


def is_reduced_mass(facts: Judged) -> bool:
    """Whether the coefficient of the acceleration in both equations is m with 1/m = 1/m_1 + 1/m_2."""
    mass, (one, other) = facts.result, facts.inputs["masses"]
    equations = [facts.quantities[role].value.residual for role in ("of", "other")]
    accelerations = facts.inputs["accelerations"]

    def is_so(point: Point) -> bool:
        m = value_at(mass, point)
        told = same(1 / m, 1 / value_at(one, point) + 1 / value_at(other, point))
        return told and all(
            same(_slope(explicit(equation), a, point), m) for equation, a in zip(equations, accelerations, strict=True)
        )

    return everywhere(numbers([*equations, mass]), is_so)


def _slope(value: Expr, letter: Symbol, point: Point) -> Expr:
    """Return the coefficient of a symbol in a linear expression, from two values."""
    return value_at(value, {**point, letter: Integer(1)}) - value_at(value, {**point, letter: Integer(0)})


def stays_on_both_surfaces(facts: Judged) -> bool:
    """Whether T and |L|^2 do not change to first order in a short time, with the rates from Euler's equations."""
    spins, euler = facts.inputs["spins"], facts.inputs["euler"]
    values = [explicit(facts.quantities[role].value) for role in ("energy", "square")]
    h = Rational(1, 10**12)

    def is_so(point: Point) -> bool:
        rates = [
            -value_at(explicit(q.value.residual), {**point, rate(w): Integer(0)})
            / _slope(explicit(q.value.residual), rate(w), point)
            for q, w in zip(euler, spins, strict=True)
        ]
        moved = [{**point, **{w: point[w] + s * h * v for w, v in zip(spins, rates, strict=True)}} for s in (1, -1)]
        change = [abs(value_at(value, moved[0]) - value_at(value, moved[1])) for value in values]
        sizes = [abs(value_at(value, point)) for value in values]
        return any(v != 0 for v in rates) and all(c < 10**3 * h**2 * n for c, n in zip(change, sizes, strict=True))

    return everywhere(numbers([*values, *(q.value.residual for q in euler)]), is_so)


def _with_momentum(facts: Judged, value: Expr, point: Point) -> Expr:
    components = [explicit(each) for each in facts.quantities["momentum"].value]
    known = {s: value_at(each, point) for s, each in zip(facts.inputs["names"], components, strict=True)}
    return value_at(explicit(value), {**point, **known})


def is_the_energy_in_momenta(facts: Judged, told: Relation) -> bool:
    """Whether the left side, with the components of L substituted, is the kinetic energy."""
    energy = facts.quantities["energy"]
    points = numbers([energy.value, *facts.quantities["momentum"].value])
    return told.right == energy.symbol and everywhere(
        points, lambda p: same(_with_momentum(facts, told.left, p), value_at(explicit(energy.value), p))
    )


def is_the_squared_length(facts: Judged, told: Relation) -> bool:
    """Whether the left side, with the components of L substituted, is the squared magnitude of L."""
    square = facts.quantities["square"]
    points = numbers([square.value, *facts.quantities["momentum"].value])
    return told.right == square.symbol and everywhere(
        points, lambda p: same(_with_momentum(facts, told.left, p), value_at(explicit(square.value), p))
    )


# --- statements about all positions or all angles ---


def is_only_condition(of: Quantity) -> bool:
    """Whether the energy from which a condition of equilibrium follows depends on one coordinate only."""
    return len(explicit(of.parent("potential").value).free_symbols & set(of.coordinates)) == 1


def holds_everywhere(facts: Judged) -> bool:
    """Whether the condition of equilibrium holds at all tried positions for the stated value of a symbol, but not for
    twice this value. The energy behind the condition must depend on one coordinate only."""
    place, condition = facts.result, explicit(facts.quantities["of"].value.residual)
    if not is_only_condition(facts.quantities["of"]):
        return False

    def is_so(point: Point) -> bool:
        there = value_at(explicit(place.right), point)
        number, beside = (value_at(condition, {**point, place.left: v}) for v in (there, there * 2))
        return bool(abs(number) <= CLOSE * abs(beside) and beside != 0)

    return everywhere(numbers([condition, place.right]), is_so)


def has_one_sign(facts: Judged) -> bool:
    """Whether the sign of the force is the same for all values of the coordinate that are tried, but depends on the
    values of the given symbols."""
    of, q = explicit(facts.quantities["of"].value), facts.inputs["q"]
    seen = set()
    if not _is_constant(of.xreplace({q: Integer(1)}), facts.quantities["of"]):
        return False  # a rate changes along the motion

    def is_so(point: Point) -> bool:
        found = {value_at(of, {**point, q: point[q] * k}) > 0 for k in (Rational(1, 50), -3, 1, 40)}
        seen.update(found)
        return len(found) == 1

    return everywhere(numbers([of]), is_so) and seen == {True, False}


def balances(facts: Judged) -> bool:
    """Whether the torque vanishes at 0 and 90 degrees and at no angle between them, and both angles are in the
    declared range.
    """
    torque = [each for each in map(explicit, facts.quantities["of"].value) if each != 0]
    angle, u = facts.inputs["angle"], Symbol("u")
    told = [each.right for role, each in facts.inputs.items() if role.startswith("place_")]
    lies = range_of(angle)
    if told != [0, pi / 2] or lies is not None and not all(map(lies.holds, told)):
        return False
    half = {sin(angle): 2 * u / (1 + u**2), cos(angle): (1 - u**2) / (1 + u**2)}

    def only_there(point: Point) -> bool:
        others = {letter: number for letter, number in point.items() if letter != angle}
        parts = [expand_trig(each).xreplace(half).xreplace(others) for each in torque]
        common = reduce(gcd, (Poly(fraction(together(each))[0], u, domain="QQ") for each in parts))
        own = common
        if own.is_zero:
            return False
        while own.eval(0) == 0 or own.eval(1) == 0:
            own = quo(own, Poly(u if own.eval(0) == 0 else u - 1, u))
        return bool(common.eval(0) == 0 and common.eval(1) == 0 and own.count_roots(0, 1) == 0)

    try:
        return bool(torque) and everywhere(numbers(torque, tried=3), only_there)
    except BasePolynomialError:  # a coefficient is not rational
        return False


def is_an_angle(facts: Judged, told: Relation) -> bool:
    """Whether the statement gives a number for the angle; the outcome judges this number."""
    return told.left == facts.inputs["angle"] and bool(told.right.is_number)


# --- sums, products, percentages and limits ---


def have_this_sum_and_product(facts: Judged) -> bool:
    """Whether two frequencies have the stated sum and the stated product."""
    of, other = (facts.quantities[role] for role in ("of", "other"))
    added, multiplied = (facts.inputs[role].right for role in ("sum", "product"))

    def is_so(line: Expr, point: Point) -> bool:
        one, two = value_at(line, point), value_at(explicit(other.value), point)
        return same(one + two, value_at(added, point)) and same(one * two, value_at(multiplied, point))

    return for_each_form(of, is_so, explicit(other.value), added, multiplied)


def adds_the_symbols(facts: Judged, told: Relation) -> bool:
    one, other = (facts.quantities[role].symbol for role in ("of", "other"))
    return bool(explicit(told.left) == one + other)


def multiplies_the_symbols(facts: Judged, told: Relation) -> bool:
    one, other = (facts.quantities[role].symbol for role in ("of", "other"))
    return bool(explicit(told.left) == one * other)


def has_an_amplitude(facts: Judged) -> bool:
    """Whether the stated symbol is the amplitude in the integral for the period."""
    return bool(facts.inputs["swing"].args[2] == facts.inputs["letter"])


def is_the_amplitude(facts: Judged, told: Relation) -> bool:
    return bool(told.left == facts.inputs["letter"] and explicit(told.right).is_number)


def longer_by(facts: Judged, told: Expr) -> bool:
    """Whether the integral for the period at the stated amplitude exceeds its value at a very small amplitude by this
    percentage, to the figures that are shown. The percentage must be less than 5."""
    f, q, letter, _ = facts.inputs["swing"].args
    letters = letters_of(explicit(f)) - {q, letter}

    def time(point: Point, at: Expr) -> Expr:
        found = half_swing(explicit(f).xreplace({**point, letter: at}), q, at, 20)
        return found / 2 if found is not None else nan

    def is_so(point: Point) -> bool:
        percent = 100 * (time(point, facts.inputs["amplitude"].right.doit()) / time(point, Rational(1, 10**3)) - 1)
        return bool(0 < told.args[0] < 5 and abs(percent - told.args[0]) <= half_a_unit(told))

    return everywhere(trial_points(letters, tried=3), is_so)


def stays_below_and_approaches(facts: Judged) -> bool:
    """Whether the frequency, where it is real, is below the given angular velocity, and their ratio approaches 1 as the
    velocity grows."""
    of, letter = facts.quantities["of"], facts.inputs["letter"]

    def is_so(line: Expr, point: Point) -> bool | None:
        number = real_at(line, point)
        far = value_at(line, {**point, letter: Integer(10) ** 9}) / 10**9
        return None if number is None else bool(number < point[letter] and abs(far - 1) < Rational(1, 10**6))

    return for_each_form(of, is_so, letter)


def is_sum_of_the_others(facts: Judged) -> bool:
    """Whether one principal moment is the sum of the two others."""
    values = [explicit(each) for each in facts.quantities["of"].value]

    def is_so(point: Point) -> bool:
        found = sorted(value_at(each, point) for each in values)
        return same(found[0] + found[1], found[2])

    return len(values) == 3 and everywhere(numbers(values), is_so)


def adds_the_moments(facts: Judged, told: Relation) -> bool:
    """Whether the equation holds for the values of the principal moments."""
    of = facts.quantities["of"]
    known = dict(zip(of.symbol, explicit(of.value), strict=True))
    left, right = (side.xreplace(known) for side in told.sides)
    return len(told.left.args) == 2 and _agree(left, right)
