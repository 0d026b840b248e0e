"""Predicates of equilibria and stability: each checks an outcome, or an expression in the sentence of an outcome."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import combinations_with_replacement
from typing import Any

from mpmath import mp
from sympy import (
    Abs,
    Add,
    Dummy,
    Expr,
    Function,
    Integer,
    Mul,
    Poly,
    Pow,
    Rational,
    Symbol,
    binomial,
    default_sort_key,
    diff,
    factor_list,
    gcd_list,
    lambdify,
    sign,
    together,
)
from sympy.matrices import MatrixBase

from derive.algebra.derivatives import derivative
from derive.algebra.expressions import At, Relation, Slope, explicit, rate
from derive.algebra.ranges import has_meaning, range_of
from derive.algebra.samples import letters_of, value_at
from derive.algebra.tidy import tidied
from derive.mechanics.rest.equilibrium_search import none_is_missing
from derive.mechanics.rest.facts import Shape, StableWhere
from derive.mechanics.rest.growth import grows_always, inertia_is_positive, is_turned_aside, matter_of
from derive.mechanics.rest.on_constraints import signs_on_constraints
from derive.steps.claims import always_sign, negated, same_equation, value_of_role
from derive.steps.claims import both as both
from derive.steps.numeric import Extreme
from derive.steps.record import assumed, assumed_in_words
from derive.steps.rule import Judged, Naming, Predicate, handed_on_by
from derive.steps.signs import sign_known
from derive.steps.step import is_zero
from derive.steps.trial_numbers import (
    Point,
    assumptions_about,
    beside_border,
    decides,
    everywhere,
    holds_at,
    just_where,
    sign_at,
    signs_of,
    trial_points,
)
from derive.witness.facts import Rest


def _entries(value: Any) -> list[Expr]:
    return list(value) if isinstance(value, MatrixBase) else [value]


def _letters(facts: Judged) -> set[Any]:
    found = set().union(*(entry.free_symbols for entry in (*_entries(facts.result), *_sided_forces(facts))))
    found -= set(facts.inputs.get("sought", ()))
    exists = facts.inputs.get("exists")
    return found | (set(exists.free_symbols) if exists is not None else set())


def _is_there(facts: Judged, point: Point) -> bool:
    """Whether the equilibrium exists for these trial numbers.

    All coordinates must be real, coordinates that are distances must be positive, and forces that contain a distance
    |u| must vanish.
    """
    entries, distances = _entries(facts.result), {int(i) for i in facts.inputs["distances"]}
    signs = [sign_at(entry, point) for entry in entries]
    if None in signs or not all(signs[i] == 1 for i in distances):
        return False
    there = dict(zip(facts.inputs["sought"], entries, strict=False))
    return all(sign_at(force.xreplace(there), point) == 0 for force in _sided_forces(facts))


def _sided_forces(facts: Judged) -> list[Expr]:
    sought = facts.inputs.get("sought", ())
    if len(sought) != len(_entries(facts.result)):
        return []
    return [force for i in range(len(sought)) if (force := _force(facts, i)).has(Abs)]


def _force(facts: Judged, i: int) -> Expr:
    return explicit(facts.inputs[f"condition_{i}"].residual)


def anywhere(facts: Judged) -> bool:
    """Whether the equilibrium exists for all trial numbers, and no condition is stated."""
    points = trial_points(_letters(facts))
    return "exists" not in facts.inputs and everywhere(points, lambda point: _is_there(facts, point))


def several(facts: Judged) -> bool:
    return bool(facts.inputs["count"] > 1)


def under_its_condition(facts: Judged) -> bool:
    """Whether the equilibrium exists if and only if the condition holds. The condition must be true for some trial
    numbers and false for others."""
    if "exists" not in facts.inputs:
        return False
    exists, letters = facts.inputs["exists"], _letters(facts)
    fits = just_where([exists], lambda point: _is_there(facts, point), letters)
    return fits and decides(exists, trial_points(letters))


def _can_be_counted(sought: Sequence[Symbol]) -> bool:
    """Whether equilibria can be counted: there is one coordinate, and its range does not include its ends."""
    known = range_of(sought[0])
    return len(sought) == 1 and not (known is not None and any(known.closed))


def all_are_told(facts: Judged) -> bool:
    """Whether no equilibrium is missing. If equilibria can be counted, this predicate is true, because a check of the
    step counts the equilibria."""
    sought = facts.inputs["sought"]
    if _can_be_counted(sought):
        return True
    forces = tuple(_force(facts, i) for i in range(len(sought)))
    return none_is_missing(forces, sought, facts.inputs["angles"], facts.inputs["states"])


def _moving(facts: Judged) -> tuple[Any, ...]:
    return tuple(facts.inputs["coordinates"])


def _letters_here(facts: Judged) -> list[Any]:
    of_energy = facts.inputs["potential_here"].free_symbols | set().union(
        *(value.free_symbols for value in facts.inputs["place"])
    )
    return sorted((_letters(facts) | of_energy) - set(_moving(facts)), key=str)


def _exists(facts: Judged) -> list[Relation]:
    return [facts.inputs["exists"]] if "exists" in facts.inputs else []


def numbers_here(facts: Judged) -> list[Point]:
    """Return trial numbers for which the equilibrium exists."""
    return trial_points(_letters_here(facts), *_exists(facts))


def _signs_by_numbers(facts: Judged, beside: Sequence[Relation] = ()) -> list[tuple[Point, int]]:
    """Return trial points, each with the sign of the change of the energy near the equilibrium, to second order. Some
    of the points are close to the given boundaries."""
    letters, points = _letters_here(facts), numbers_here(facts)
    points += [point for each in beside for point in beside_border(each, points, *_exists(facts))]
    numbers = tuple(tuple(point[s] for s in letters) for point in points)
    signs = _signs_at(facts.inputs["potential_here"], _moving(facts), facts.inputs["place"], tuple(letters), numbers)
    return list(zip(points, signs, strict=True))


@lru_cache(maxsize=16)  # several predicates of one outcome use the same signs
def _signs_at(
    potential: Expr, moving: tuple[Any, ...], there: tuple[Expr, ...], letters: tuple[Any, ...], numbers: Any
) -> list[int]:
    energy = lambdify([*letters, *moving], potential, "mpmath", dummify=True)
    place = lambdify(letters, list(there), "mpmath")
    with mp.workdps(100):
        found = []
        for point in numbers:
            known = [mp.mpf(int(number.p)) / int(number.q) for number in point]
            found.append(_second_order(lambda *at, known=known: energy(*known, *at), place(*known)))
    return found


def signs(facts: Judged) -> set[int]:
    return {sign for _, sign in _signs_by_numbers(facts)}


def _second_order(energy: Callable[..., Any], place: Sequence[Any]) -> int:
    """Return the sign of the change of the energy near the equilibrium, to second order.

    The sign is 1 if the energy rises in all directions, and -1 if it falls in at least one direction. Otherwise the
    energy is constant in at least one direction, and the sign is 0. No formula is differentiated: the matrix of second
    derivatives follows from differences of the energy at nearby points.
    """
    step, here, size = mp.mpf(10) ** -30, energy(*place), len(place)

    def gained(*ways: int) -> Any:
        moved = [x + step * way for x, way in zip(place, ways, strict=True)]
        return (energy(*moved) - here) / step**2

    def twice(i: int, j: int) -> Any:
        """Return the second difference of the energy, divided by the squared step. It is taken along the sum of the
        directions i and j, or along i if i = j."""
        way = [int(k == i) + int(k == j and j != i) for k in range(size)]
        return gained(*way) + gained(*(-w for w in way))

    alone = [mp.re(twice(i, i)) for i in range(size)]
    matrix = mp.matrix(size, size)
    for i, j in combinations_with_replacement(range(size), 2):
        matrix[i, j] = matrix[j, i] = alone[i] if i == j else (mp.re(twice(i, j)) - alone[i] - alone[j]) / 2
    noise = (abs(here) + mp.mpf(10) ** -6) * mp.mpf(10) ** -34
    rough = [max(abs(matrix[i, j]) for j in range(size)) for i in range(size)]
    kept = [i for i in range(size) if rough[i] > noise]
    scaled = mp.matrix(len(kept), len(kept))
    for m, i in enumerate(kept):
        for n, j in enumerate(kept):
            scaled[m, n] = matrix[i, j] / mp.sqrt(rough[i] * rough[j])
    least = min(mp.eigsy(scaled, eigvals_only=True)) if kept else mp.mpf(0)
    if least < -(mp.mpf(10) ** -12):
        return -1
    return 1 if least > mp.mpf(10) ** -12 and len(kept) == size else 0


def always(sign: int) -> Predicate:
    return lambda facts: signs(facts) == {sign}


def runs_away(facts: Judged) -> bool:
    """Whether a displacement grows for every set of trial numbers with which the energy falls in some direction.

    This must be checked because gyroscopic forces could stabilise the equilibrium. If the mass points and forces are
    unknown, the result is true.
    """
    matter = matter_of(facts.quantities["potential"])
    falling = [numbers for numbers, sign in _signs_by_numbers(facts) if sign == -1]
    return matter is None or grows_always(matter, _at_rest(facts), falling)


def kinetic_energy_is_positive(facts: Judged) -> bool:
    """Whether the kinetic energy at equilibrium is not negative for any of a few sets of trial numbers. If the kinetic
    energy can be negative, a minimum of U need not be stable.

    If the mass points and forces are unknown, the result is true.
    """
    matter = matter_of(facts.quantities["potential"])
    there = [numbers for numbers, _ in _signs_by_numbers(facts) if has_meaning(numbers)]
    return matter is None or inertia_is_positive(matter, _at_rest(facts), there)


def falls_as_told(facts: Judged) -> bool:
    """Whether the energy along the stated direction through the equilibrium has the stated, negative curvature."""
    along, told = Dummy("s"), facts.inputs["falling"]
    moved = zip(_moving(facts), facts.inputs["place"], _entries(explicit(facts.inputs["direction"])), strict=True)
    energy = facts.inputs["potential_here"].subs({q: at + along * way for q, at, way in moved}, simultaneous=True)
    curvature = derivative(energy, along, 2).subs(along, 0)
    return is_zero(curvature - told) and bool(always_sign(-1, lambda _: told)(facts))


def nothing_turns_it(facts: Judged) -> bool:
    matter = matter_of(facts.quantities["potential"])
    there = [numbers for numbers, _ in _signs_by_numbers(facts)]
    return matter is None or not is_turned_aside(matter, _at_rest(facts), there)


def _at_rest(facts: Judged) -> dict[Any, Expr]:
    return dict(zip(_moving(facts), facts.inputs["place"], strict=True))


def higher(kind: str) -> Predicate:
    """Judge whether the second derivative of the energy vanishes, and the first nonzero derivative yields the verdict
    `kind`."""

    def is_so(facts: Judged) -> bool:
        if not all(is_zero(entry) for entry in _entries(facts.result)):
            return False
        return len(_moving(facts)) == 1 and kind_of_order(facts.inputs["potential_here"], facts) == kind

    return is_so


def undecided(facts: Judged) -> bool:
    """Whether the stability is undecided. All derivatives up to the eighth must vanish, or the sentence must state the
    first nonzero derivative, whose sign is unknown."""
    return bool(higher("open" if "higher" in facts.inputs else "flat")(facts))


def kind_of_order(value: Expr, facts: Judged) -> str:
    (q,), (place,) = _moving(facts), facts.inputs["place"]
    for order in range(2, 9):
        there = derivative(value, q, order).xreplace({q: place})
        if not is_zero(there):
            signs = signs_of(there)
            if order % 2 or signs == {-1}:
                return "unstable"
            return "stable" if signs == {1} else "open"
    return "flat"


def depends(border: str | None) -> Predicate:
    """Judge whether the stated condition holds if and only if the energy rises to second order. The condition must be
    true for some trial numbers and false for others.

    border   the verdict of the first nonzero derivative on the boundary; None if the sentence states no such derivative
    """

    def is_so(facts: Judged) -> bool:
        condition, where = facts.inputs["condition"], facts.inputs.get("at_border")
        found = _signs_by_numbers(facts, [condition])
        fits = all(holds_at(condition, point) == (sign == 1) for point, sign in found if sign)
        fits &= decides(condition, [point for point, _ in found])
        if border is None or where is None or not fits:
            return fits and where is None and border is None
        there = facts.inputs["potential_here"].subs(where.left, where.right)
        return kind_of_order(there, facts) == border

    return is_so


def bordered(border: str | None) -> Predicate:
    """Judge whether the condition includes its boundary if and only if the equilibrium is stable on the boundary.

    border   the verdict of the first nonzero derivative on the boundary; None if no derivative decides
    """

    def is_so(facts: Judged) -> bool:
        where = facts.inputs.get("at_border")
        if where is None or border is None:
            return where is None and border is None and facts.result.operator in (">", "<")
        there = facts.inputs["potential_here"].subs(where.left, where.right)
        return kind_of_order(there, facts) == border and facts.result.operator.endswith("=") == (border == "stable")

    return is_so


def is_at_rest(facts: Judged) -> bool:
    """Whether the result contains no rate."""
    return not explicit(facts.result).has(*map(rate, facts.inputs["coordinates"]))


def is_what_the_lagrangian_has(facts: Judged) -> bool:
    """Whether V comes from the Lagrangian only: V + L vanishes if all rates and accelerations are zero."""
    moving = [rate(q, n) for q in facts.inputs["coordinates"] for n in (1, 2)]
    whole = explicit(facts.result + facts.inputs["lagrangian"])
    return is_zero(whole.subs(dict.fromkeys(moving, 0)))


def higher_lasts(facts: Judged) -> bool:
    """Whether the stated higher derivative, if there is one, does not vanish."""
    return "higher" not in facts.inputs or not is_zero(facts.inputs["higher"])


def sides_as_told(facts: Judged) -> bool:
    """Whether the sentence states the signs of u in distances |u| if and only if such signs are assumed."""
    above = (each for each in assumed() if each.operator == ">" and range_of(each.left) is None)
    sides = [each for each in above if explicit(each.residual).has(*facts.inputs["sought"])]
    in_words = set(assumed_in_words()).issuperset(sides)
    return facts.words["seen"] == ("any" if not sides else "stretched" if in_words else "one_side")


def level_as_told(facts: Judged) -> bool:
    """Whether the sentence excludes exactly the case in which the force vanishes at all values of the coordinate."""
    told, sought = facts.inputs.get("excluded"), facts.inputs["sought"]
    if len(sought) > 1:
        return told is None
    (q,) = sought
    force = together(explicit(facts.inputs["condition_0"]).residual).as_numer_denom()[0]
    marks = {f: Dummy() for f in sorted(force.atoms(Function, Pow), key=default_sort_key, reverse=True) if f.has(q)}
    common = gcd_list(Poly(force.xreplace(marks).xreplace({q: marks.get(q, q)}), q, *marks.values()).coeffs())
    open_ = Mul(*(f for f, _ in factor_list(common)[1] if sign_known(f) is None and not f.is_nonzero))
    if not open_.free_symbols:
        return told is None
    return told is not None and told.operator == "!=" and same_equation(told.residual, open_)


# Largest accepted ratio of an energy to a difference of energies. Energies are computed to 60 digits or more, so 20
# digits of the difference remain.
DIGITS_LEFT = 10**40


def is_its_derivative(facts: Judged, outcome: str) -> bool:
    """Whether the result is the derivative of the potential energy, of the order that the symbol of the result
    shows."""
    of, q, order = facts.symbol.args
    potential, found = facts.quantities["potential"], explicit(facts.result)
    energy = explicit(potential.value)
    if energy.has(Abs):
        return of == potential.symbol and _is_slope_in_numbers(energy, q, int(order), found)
    return of == potential.symbol and is_zero(diff(energy, q, int(order)) - found)


def _nearby(point: Point) -> Expr:
    return min((abs(number) for number in point.values()), default=Integer(1)) / 10**9


def _is_slope_in_numbers(energy: Expr, q: Symbol, order: int, found: Expr) -> bool:
    """Check the derivative of an energy with distances |x - d|, by central differences at random values of x."""

    def is_so(point: Point) -> bool:
        near, steps = _nearby(point), range(order + 1)
        there = [value_at(energy, {**point, q: point[q] + (n - Rational(order, 2)) * near}) for n in steps]
        slope = Add(*((-1) ** (order - n) * binomial(order, n) * there[n] for n in steps)) / near**order
        return bool(abs(slope - value_at(found, point)) <= (abs(slope) + 1) / 10**6)

    return everywhere(trial_points(letters_of(energy) | letters_of(found)), is_so)


def curvature(facts: Judged, fact: Extreme) -> bool:
    q, place = facts.inputs["coordinate"], facts.inputs["at"]
    return is_zero(diff(value_of_role(facts, "potential"), q, 2).xreplace({q: place}) - fact.curvature)


def shape(facts: Judged, fact: Shape) -> bool:
    """Whether the result is the curvature at the equilibrium, and vanishes on the boundary if there is one."""
    q, result, energy = fact.coordinate, explicit(facts.result), explicit(fact.potential.value)
    on_border = fact.border is None or is_zero(result.subs(fact.border.left, fact.border.right))
    if energy.has(Abs):
        return on_border and _is_curvature_in_numbers(facts, energy, fact, result)
    return on_border and is_zero(tidied(diff(energy, q, 2).subs(q, fact.place)) - result)


def _is_curvature_in_numbers(facts: Judged, energy: Expr, fact: Shape, found: Expr) -> bool:
    """Check the curvature of an energy with distances |x - d| at an equilibrium, by a central difference."""
    exists = facts.inputs.get("exists")
    conditions = [each for each in (exists, *assumed()) if each is not None]
    letters = letters_of(energy) | letters_of(found) | {s for c in conditions for s in letters_of(c.residual)}

    def is_so(point: Point) -> bool | None:
        at, near = value_at(fact.place, point), _nearby(point)
        below, there, above = (value_at(energy, {**point, fact.coordinate: at + n * near}) for n in (-1, 0, 1))
        expected = value_at(found, point)
        if abs(there) > near**2 * DIGITS_LEFT:  # no digits are left in the difference of such numbers
            return None
        return bool(abs((below - 2 * there + above) / near**2 - expected) <= (abs(expected) + 1) / 10**6)

    return everywhere(trial_points(letters - {fact.coordinate}, *conditions), is_so)


def stable_where(facts: Judged, fact: StableWhere) -> bool:
    there = tidied(diff(fact.energy, fact.coordinate, 2).subs(fact.coordinate, fact.place))
    return fact.condition == facts.inputs["condition"] and is_zero(there - explicit(facts.result))


def rest(facts: Judged, fact: Rest) -> bool:
    result = explicit(facts.result)
    found = list(result) if isinstance(result, MatrixBase) else [result]
    held = [fact.values[q] for q in facts.inputs["sought"] if q in fact.values]
    return len(found) == len(held) and all(is_zero(one - other) for one, other in zip(found, held, strict=True))


def order_of(*orders: int, more: bool = False) -> Predicate:
    def is_so(facts: Judged) -> bool:
        symbol = facts.symbol
        order = int(symbol.args[2]) if isinstance(symbol, Slope) else 0
        return order > max(orders) if more else order in orders

    return is_so


def shaped(shape: str, at_bound: bool) -> Predicate:
    """Judge by differentiation whether the first nonzero derivative, from the second on, yields this shape.

    The step must have a special case as input if and only if `at_bound` is true. If `at_bound` is true, the second
    derivative must also vanish.
    """

    def is_so(facts: Judged) -> bool:
        q, place = facts.inputs["coordinate"], facts.inputs["place"]
        level = is_zero(diff(facts.result, q, 2).subs(q, place))
        if at_bound != ("case" in facts.inputs) or at_bound and not level:
            return False
        for n in range(2, 9):
            there = tidied(diff(facts.result, q, n).subs(q, place))
            if not is_zero(there):
                return shape == _shape_by(n, there)
        return shape == "flat"

    return is_so


def _shape_by(order: int, derivative: Expr) -> str:
    if order % 2:
        return "inflection"
    return "minimum" if derivative.is_positive else "maximum" if derivative.is_negative else "conditional"


def bent(sign: int | None) -> Predicate:
    """Judge whether the second derivative of the energy at the given value of the coordinate has this sign."""

    def curvature(facts: Judged) -> Expr:
        q, at = facts.inputs["coordinate"], facts.inputs["at"]
        return diff(explicit(facts.inputs["potential"]), q, 2).subs(q, at)

    return always_sign(sign, curvature)


def only_coordinate(facts: Judged, q: Any) -> bool:
    """Whether q is the only coordinate in the potential energy."""
    of = facts.quantities.get("potential") or facts.quantities["condition_0"].parent("potential")
    return {s for s in of.coordinates if explicit(of.value).has(s)} == {q}


def level_there(role: str) -> Naming:
    """Check that the slope of the energy vanishes at the named value of the coordinate."""

    def is_so(facts: Judged, place: Any) -> bool:
        slope = diff(value_of_role(facts, role), place.left).subs(place.left, explicit(place.right))
        return place.operator == "=" and (_vanishes_as_assumed(slope) if slope.has(sign) else is_zero(slope))

    return is_so


def _vanishes_as_assumed(slope: Expr) -> bool:
    """Whether the slope vanishes numerically under the assumptions of the page, such as u > 0 for a distance |u|."""
    letters = letters_of(slope)
    return signs_of(slope, *assumptions_about(letters)) == {0}


def extreme_there(facts: Judged, place: Any) -> bool:
    there = value_of_role(facts, "potential").subs(place.left, explicit(place.right))
    return level_there("potential")(facts, place) and is_zero(there - explicit(facts.result))


def flat_in_that_case(facts: Judged, case: Any) -> bool:
    """Whether the curvature vanishes in the named case, and the symbol of the result shows this case."""
    q, place = facts.inputs["coordinate"], facts.inputs["place"]
    curvature = explicit(At(value_of_role(facts, "potential"), case.left, case.right)).diff(q, 2).subs(q, place)
    return case.operator == "=" and is_zero(curvature) and facts.symbol.args[1:] == (case.left, case.right)


def _there_on_constraints(facts: Judged) -> dict[Any, Any]:
    return dict(zip(facts.inputs["coordinates"], facts.inputs["place"], strict=True))


def on_the_constraints(facts: Judged, named: Any) -> bool:
    """Whether the equilibrium satisfies all constraints, and the named expression is the list of the coordinates, an
    equation with their equilibrium values, or a constraint."""
    there = _there_on_constraints(facts)
    kept = all(is_zero(explicit(residual).xreplace(there)) for residual in facts.inputs["constraints"])
    if not isinstance(named, Relation):
        return kept and list(explicit(named)) == list(there)
    if isinstance(explicit(named.left), MatrixBase):
        return kept and dict(zip(explicit(named.left), explicit(named.right), strict=True)) == there
    return kept and any(is_zero(explicit(named).residual - explicit(each)) for each in facts.inputs["constraints"])


def along_the_constraints(facts: Judged, way: Any) -> bool:
    """Whether a displacement in this direction satisfies every constraint to first order."""
    there = _there_on_constraints(facts)
    slopes = [
        sum(diff(explicit(residual), q) * dq for q, dq in zip(there, explicit(way), strict=True)).xreplace(there)
        for residual in facts.inputs["constraints"]
    ]
    return all(map(is_zero, slopes))


def falls_along(facts: Judged, _: Any) -> bool:
    """Whether the second derivative of the energy along the stated direction has the stated value."""
    s = Symbol("s_along", real=True)
    names, way = explicit(facts.inputs["moving"]), explicit(facts.inputs["direction"])
    line = {q: p + s * u for q, p, u in zip(names, facts.inputs["place"], way, strict=True)}
    energy = value_of_role(facts, "potential_here").subs(line, simultaneous=True)
    return is_zero(diff(energy, s, 2).subs(s, 0) - explicit(facts.inputs["falling"]))


def at_its_place(facts: Judged, state: Any) -> bool:
    """Whether the stated equation gives each coordinate its equilibrium value. For one coordinate, the right side may
    also be the symbol of the equilibrium."""
    moving, place = facts.inputs["coordinates"], facts.inputs["place"]
    if state.operator != "=":
        return False
    if len(moving) > 1:
        pairs = zip(state.right.args, place, strict=True)
        return state.left.args == tuple(moving) and all(is_zero(one - other) for one, other in pairs)
    rest = getattr(facts.quantities.get("at"), "symbol", None)
    return state.left == moving[0] and (state.right == rest or is_zero(state.right - place[0]))


def steady_as_its_potential(facts: Judged, outcome: str) -> bool:
    """Whether the sentence calls a state a steady motion only if coordinates were eliminated with conserved momenta.

    The eliminated coordinates still move, so such a state is not an equilibrium at rest. If the potential energy itself
    results from this elimination, a sentence about one coordinate must call the state a steady motion.
    """
    of = facts.quantities.get("potential") or facts.quantities["condition_0"].parent("potential")
    reduced = [
        e for e in of.ancestors() if (e.step.rule, e.step.outcome) == ("hamilton.effective_potential", "reduced")
    ]
    told = "steady" in facts.inputs
    return bool(reduced) if told else of not in reduced or isinstance(facts.result, MatrixBase)


def about_an_energy(facts: Judged, outcome: str) -> bool:
    return not isinstance(facts.inputs["potential"], MatrixBase)


potential_at_rest_pushed: Predicate = both(is_at_rest, lambda facts: not is_what_the_lagrangian_has(facts))


def condition_zero(facts: Judged) -> bool:
    return is_zero(facts.result.residual)


condition_generic: Predicate = negated(condition_zero)


equilibrium_only: Predicate = both(
    anywhere, lambda facts: not several(facts), all_are_told, sides_as_told, level_as_told
)


stability_of_several_depends: Predicate = both(lambda facts: len(signs(facts)) > 1, runs_away)


def _signs_are(signs: set[int]) -> Predicate:
    return lambda facts: signs_on_constraints(facts, numbers_here(facts)) == signs


STABILITY_ON_CONSTRAINTS: dict[str, Predicate] = {
    "stable": _signs_are({1}),
    "unstable": _signs_are({-1}),
    "level": _signs_are({0}),
    "depends": lambda facts: len(signs_on_constraints(facts, numbers_here(facts))) > 1,
}


handed_on_by(Extreme, curvature)
handed_on_by(Shape, shape)
handed_on_by(StableWhere, stable_where)
handed_on_by(Rest, rest)
