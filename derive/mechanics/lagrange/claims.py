"""Predicates of Lagrangian mechanics: each judges whether an outcome, or a statement in its sentence, is correct."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations
from typing import Any

from sympy import (
    Add,
    Dummy,
    Expr,
    ImmutableDenseMatrix,
    Integer,
    Matrix,
    Rational,
    Symbol,
    diff,
    hessian,
)

from derive.algebra.derivatives import derivative
from derive.algebra.equality import equal
from derive.algebra.expressions import TIME, Partial, Relation, bound, depends_on_time, explicit, rate, with_known
from derive.algebra.samples import letters_of, value_at
from derive.algebra.taylor import slope
from derive.algebra.tidy import tidied
from derive.mechanics.kinematics.coordinates import by_functions_of_time
from derive.mechanics.lagrange.facts import Energies, ForceOf, KeptMomentum, WithMomenta, energies_of
from derive.mechanics.model.constraint import Constrained
from derive.mechanics.model.dalembert import Matter
from derive.steps.claims import both as both
from derive.steps.claims import lasts, letters_in, negated, parallel, value_of_role
from derive.steps.record import assumed, assumed_in_words, coordinates_in
from derive.steps.rule import Judged, Naming, Predicate, handed_on_by
from derive.steps.step import Quantity, is_zero
from derive.steps.trial_numbers import Point, as_rational, assumptions_about, everywhere, sign_found, trial_points


def kept_momentum(facts: Judged, fact: KeptMomentum) -> bool:
    """Whether the fact names the momentum and the coordinate of the step, and the momentum has its conserved value if
    the rate in the fact is substituted."""
    momentum, value = value_of_role(facts, "momentum"), value_of_role(facts, "value")
    there = momentum.xreplace({rate(fact.coordinate): fact.turning})
    as_named = (fact.momentum, fact.coordinate) == (facts.quantities["momentum"].symbol, facts.inputs["coordinate"])
    return as_named and is_zero(there - value) and is_zero(fact.value - value)


def with_momenta(facts: Judged, fact: WithMomenta) -> bool:
    """Whether the equation contains no rate of a coordinate with a conserved momentum."""
    return not explicit(facts.result).has(*(rate(kept.coordinate) for kept in fact.kept))


def force_of_its_constraint(facts: Judged, fact: ForceOf) -> bool:
    return bool(fact.constraint.force == facts.symbol)


def _in_rates(facts: Judged) -> Expr:
    """Return the result with the symbols of the momenta replaced by the momenta of the mass points."""
    L: Quantity = facts.quantities["lagrangian"]
    matter = L.needed(Matter)
    letters = {q.name: q for q in matter.coordinates}
    present = {s: s.name.removeprefix("p_") for s in facts.result.free_symbols if s.name.startswith("p_")}
    momenta = {p: matter.momentum_along(letters[name]) for p, name in present.items() if name in letters}
    return bound(explicit(facts.result), momenta)


def _is_conserved(facts: Judged) -> bool:
    """Whether the rate of the result along the motion vanishes. D'Alembert's principle eliminates the accelerations."""
    L = facts.quantities["lagrangian"]
    matter, kept = L.needed(Matter), L.fact(Constrained)
    along = [rate(q) * (matter.inertia_along(q) - matter.force_along(q)) for q in matter.coordinates]
    along += [c.multiplier * c.velocity(list(matter.coordinates)) for c in (kept.constraints if kept else ())]
    return bool(equal(by_functions_of_time(_in_rates(facts), matter.coordinates), Add(*along)))


def _is_energy(facts: Judged) -> bool:
    L = facts.quantities["lagrangian"]
    whole = L.needed(Matter).kinetic_energy() + explicit(L.needed(Energies).potential.value)
    return bool(equal(_in_rates(facts), whole))


def _is_worked_on(facts: Judged) -> bool:
    L = facts.quantities["lagrangian"]
    matter, kept = L.needed(Matter), L.fact(Constrained)
    power = Add(*(rate(q) * matter.other_force_along(q) for q in matter.coordinates))
    power -= Add(*(c.multiplier * c.velocity(list(matter.coordinates)) for c in (kept.constraints if kept else ())))
    return not is_zero(power)


def _energy(conserved: bool, whole: bool, worked: bool = False) -> Predicate:
    return lambda facts: (_is_conserved(facts), _is_energy(facts), _is_worked_on(facts)) == (conserved, whole, worked)


def _given(conserved: bool, worked: bool) -> Predicate:
    """Judge the outcome for a given Lagrangian, which is not a difference of two energies."""

    def is_so(facts: Judged) -> bool:
        L = facts.quantities["lagrangian"]
        is_given = energies_of(L) is None
        return is_given and (_is_conserved(facts), _is_worked_on(facts)) == (conserved, worked)

    return is_so


ENERGIES = {
    "given_conserved": _given(True, False),
    "given_changing": _given(False, False),
    "given_work": _given(False, True),
    "energy": _energy(True, True),
    "conserved": _energy(True, False),
    "changing_energy": _energy(False, True),
    "changing": _energy(False, False),
    "work_energy": _energy(False, True, True),
    "work": _energy(False, False, True),
}


def rate_by(*, in_time: bool | None, worked: bool, lost: bool | None = None) -> Predicate:
    """Judge the right side of an equation for a rate of energy.

    in_time   whether the right side contains -dL/dt; None if the right side is zero
    worked    whether the right side contains the power of forces
    lost      whether the right side is known never to be positive; None to skip this test
    """

    def is_so(facts: Judged) -> bool:
        if facts.result.operator != "=" or is_zero(facts.result.right) != (in_time is None):
            return False
        found, by_time = explicit(facts.result.right), -diff(explicit(facts.inputs["lagrangian"]), TIME)
        if in_time is None:
            return True
        told = (not is_zero(by_time), not is_zero(found - by_time))
        return told == (in_time, worked) and (lost is None or _never_gains(found, facts.inputs["moving"]) == lost)

    return is_so


def _never_gains(power: Expr, moving: tuple[Symbol, ...]) -> bool:
    """Whether the power vanishes at rest, is even in the rates and is concave in the rates; then the power is never
    positive. The power is concave if its matrix of second derivatives, times -1, has no negative principal minor."""
    rates = [rate(q) for q in moving]
    at_rest = power.xreplace(dict.fromkeys(rates, Integer(0)))
    turned = power.xreplace({v: -v for v in rates})
    bent = -hessian(power, rates)
    chosen = [rows for n in range(len(rates)) for rows in combinations(range(len(rates)), n + 1)]
    minors = [tidied(bent.extract(rows, rows).det()) for rows in chosen]
    return is_zero(at_rest) and is_zero(turned - power) and all(bool(each.is_nonnegative) for each in minors)


def noether_symmetry(facts: Judged) -> bool:
    """Whether the shift leaves L unchanged: L gains no time derivative."""
    return is_zero(facts.inputs["gain"])


def shifted_as_told(facts: Judged, outcome: str) -> bool:
    """Whether the right side is the derivative, with respect to epsilon at epsilon = 0, of L at coordinates shifted by
    epsilon xi."""
    L, small = facts.quantities["lagrangian"], Dummy("epsilon")
    moving = L.needed(Matter).coordinates
    shifted: dict[Symbol, Expr] = {}
    for role, q in facts.inputs.items():
        if not role.startswith("q_"):
            continue
        x = facts.inputs.get(role.replace("q", "xi"), Integer(1))
        shifted.update({q: q + small * x, rate(q): rate(q) + small * by_functions_of_time(x, moving)})
    change = diff(bound(explicit(L.value), shifted), small).subs(small, 0)
    return bool(equal(change, explicit(facts.result.right)))


def cyclic(facts: Judged) -> bool:
    return is_zero(slope(explicit(facts.inputs["lagrangian"]), facts.inputs["coordinate"]))


not_cyclic: Predicate = negated(cyclic)


def by_its_coordinate(facts: Judged, outcome: str) -> bool:
    """Whether the symbol is a derivative with respect to the coordinate that the sentence names."""
    return isinstance(facts.symbol, Partial) and facts.symbol.args[1] == facts.inputs["coordinate"]


def parts_of_the_kinetic_energy(facts: Judged, _: str) -> bool:
    """Whether the value of the word `made` (`any`, `both`, `axis` or `point`) fits the parts of the kinetic energy."""
    system, made = facts.subject.body, facts.words["made"]
    if made == "any":
        return True
    (placed,) = system.bodies
    centre_at_rest = all(is_zero(c) for c in _rates_of(placed.centre.components, system))
    if made == "both":
        return not system.particles and "inertia_0" in facts.inputs and not centre_at_rest
    held_apart = placed.is_held and "speed_0" not in facts.inputs
    return not system.particles and (held_apart or centre_at_rest) and (made == "axis") == (placed.across is not None)


def _rates_of(place: Any, system: Any) -> list[Expr]:
    moving = list(system.coordinates)
    return [by_functions_of_time(explicit(c), moving) for c in place]


def on_the_sides_that_are_assumed(facts: Judged) -> bool:
    """Whether the energy is not zero, and the page assumes u > 0 for each distance |u| that a step replaces by u.
    The sentence must mention stretched springs if and only if such a distance is the length of a spring."""
    sides = [Relation(u, ">", 0) for u in facts.inputs["branches"]]
    of_springs = any(side in assumed_in_words() for side in sides)
    return lasts(facts) and set(sides) <= set(assumed()) and of_springs == (facts.words["seen"] == "stretched")


def equation_of(facts: Judged, q: Any) -> bool:
    """Whether the factors of the accelerations are proportional to the second derivatives of L with respect to q_dot
    and each rate."""
    L, moving = value_of_role(facts, "lagrangian"), facts.quantities["lagrangian"].coordinates
    residual = explicit(facts.result).residual
    inertia = {s: diff(L, rate(q), rate(s)) for s in moving}
    if all(is_zero(value) for value in inertia.values()):  # a coordinate without inertia
        return q in moving and (q in residual.free_symbols or rate(q) in residual.free_symbols)
    return q in moving and parallel({s: diff(residual, rate(s, 2)) for s in moving}, inertia)


def differentiated_by(facts: Judged, q: Any) -> bool:
    return bool(facts.symbol.args[1] == q)


def has_applied(facts: Judged) -> bool:
    return "applied" in facts.inputs and not is_zero(facts.inputs["applied"])


def has_kept(facts: Judged) -> bool:
    return any(facts.result.has(letter) for letter in facts.inputs["letters"])


def has_rates(condition: Expr) -> bool:
    return any(condition.has(rate(q)) for q in coordinates_in(condition))


def is_stretched(facts: Judged) -> bool:
    """Whether the symbol of the result is a multiplier that differs from the constraint force.

    The symbol is the force if |df/dr| is equal to the input `gradient`, for the condition f and the position r of
    the particle.
    """
    place, condition = (facts.inputs.get(role) for role in ("place", "condition"))
    if not place or condition is None:
        return False
    moving = sorted(coordinates_in(ImmutableDenseMatrix([*place, condition])), key=str)
    J = Matrix([[diff(c, q) for q in moving] for c in place])
    divided = explicit(facts.inputs["gradient"])
    a = Matrix([diff(condition, q) for q in moving])

    def is_unit(point: Point) -> bool:
        there = {letter: value.evalf(30) for letter, value in point.items()}
        jacobian, slopes = J.xreplace(there).evalf(30), a.xreplace(there).evalf(30)
        steepest = (jacobian * jacobian.T).inv() * jacobian * slopes
        return bool(abs(steepest.norm() - divided.xreplace(there)) <= Rational(1, 10**9))

    return not everywhere(trial_points(letters_of(condition).union(*map(letters_of, place)), tried=4), is_unit)


Told = Callable[[Judged, str], bool]


def of_its_coordinate(facts: Judged, outcome: str) -> bool:
    """Whether the equation sets the momentum equal to the stated value, up to a common factor, and contains the rate of
    the coordinate of this momentum."""
    moving = rate(facts.inputs["coordinate"]) in letters_in(facts.result)
    return (
        moving
        and facts.result.operator == "="
        and is_zero(
            (facts.result.left - facts.result.right)
            * diff(explicit(facts.inputs["momentum"]), rate(facts.inputs["coordinate"]))
            / diff(facts.result.left, rate(facts.inputs["coordinate"]))
            - explicit(facts.inputs["momentum"])
            + explicit(facts.inputs["value"])
        )
    )


def difference(facts: Judged, outcome: str) -> bool:
    roles = ("kinetic", "potential", "magnetic")
    kinetic, potential, magnetic = (explicit(facts.inputs.get(role, Integer(0))) for role in roles)
    return is_zero(explicit(facts.result) - kinetic + potential - magnetic)


def a_second_rate(facts: Judged, outcome: str) -> bool:
    return bool(facts.symbol.name.endswith("_ddot"))


def functions_of_its_constraints(facts: Judged, outcome: str) -> bool:
    """Whether the factors of the constraint forces in the equation agree with the functions that the sentence states.

    The factor of each force must be the derivative of a stated function with respect to the coordinate of the equation.
    """
    told = {role[9:]: explicit(value.right) for role, value in facts.inputs.items() if role.startswith("function_")}
    stated = {role[11:]: v for role, v in facts.inputs.items() if role.startswith("multiplier_")}
    multipliers = {number: explicit(v.right) for number, v in stated.items() if isinstance(v, Relation)}
    residual = explicit(facts.result).residual + explicit(facts.inputs.get("applied", Integer(0)))
    works = [(_slope(f, facts.inputs["coordinate"]), multipliers.get(number)) for number, f in told.items()]

    def is_stated(letter: Symbol) -> bool:
        shares = (slope if own is None else slope * diff(own, letter) for slope, own in works)
        return any(is_zero(diff(residual, letter) + share) for share in shares)

    kinds = {has_rates(function) for function in told.values()}
    word = "both" if len(kinds) > 1 else "rates" if True in kinds else "coordinates"
    if len(told) == 1:
        word = f"{word}_once"
    return facts.words.get("between") == word and all(map(is_stated, facts.inputs["letters"]))


def _slope(function: Expr, q: Any) -> Expr:
    """The derivative of a constraint function with respect to a coordinate; with respect to the rate of the coordinate,
    if the function contains rates."""
    slope: Expr = diff(function, rate(q) if has_rates(function) else q)
    return slope


def multiplier_of(i: int) -> Naming:
    """Return the predicate for the multiplier of the i-th function in a sentence."""

    def is_so(facts: Judged, letter: Any) -> bool:
        q = facts.inputs["coordinate"]
        function = explicit(facts.inputs[f"function_{i}"].right)
        residual = explicit(facts.result).residual + explicit(facts.inputs.get("applied", Integer(0)))
        factor = diff(residual, letter)
        return any(is_zero(factor + diff(function, by)) for by in (q, rate(q)))

    return is_so


def change_under_shift_none(facts: Judged) -> bool:
    return bool(facts.result.operator == "=" and is_zero(facts.result.right))


def change_under_shift_gain(facts: Judged) -> bool:
    return bool(facts.result.operator == "=" and not is_zero(facts.result.right))


noether_with_gain: Predicate = negated(noether_symmetry)


def _has_speed(facts: Judged, places: list[tuple[Expr, ...]]) -> bool:
    moving = list(facts.subject.body.coordinates)
    squares = [Add(*(by_functions_of_time(c, moving) ** 2 for c in place)) for place in places]
    letters = explicit(facts.result).free_symbols
    possible = [square for square in squares if letters <= square.free_symbols]
    return any(equal(facts.result, square) for square in sorted(possible, key=lambda s: len(s.free_symbols)))


def speed_of_particle(facts: Judged) -> bool:
    return _has_speed(facts, [particle.at.components for particle in facts.subject.body.particles])


def speed_of_centre(facts: Judged) -> bool:
    return _has_speed(facts, [placed.centre.components for placed in facts.subject.body.bodies])


def magnetic_term_alone(facts: Judged) -> bool:
    return bool(facts.inputs["fields"] == 1)


def magnetic_term_several(facts: Judged) -> bool:
    return bool(facts.inputs["fields"] > 1)


def lagrangian_generic(facts: Judged) -> bool:
    return bool("magnetic" not in facts.inputs)


lagrangian_in_field: Predicate = negated(lagrangian_generic)


def constraint_rate_in_rates(facts: Judged) -> bool:
    return bool(has_rates(facts.inputs["condition"]))


def constraint_rate_together(facts: Judged) -> bool:
    """Whether the constraints together fix the stated values of coordinates, and the result is that the acceleration of
    one of these coordinates vanishes."""
    values = {told.left: told.right for told in facts.inputs["kept_together"]}
    kept = Matrix(facts.inputs["keeping"])
    if not values or not all(is_zero(f.xreplace(values)) for f in kept):
        return False
    slopes = kept.jacobian(list(values)).xreplace(values)
    is_own = any(is_zero(facts.inputs["condition"] - q + value) for q, value in values.items())
    return slopes.is_square and not is_zero(slopes.det()) and is_own and _keeps_one_constant(facts)


def names_the_enforcer(facts: Judged, outcome: str) -> bool:
    """Whether the object that the sentence names, such as a string, enforces the constraint. A sentence with the
    word "formula" names no object, so it is accepted."""
    of, word = facts.inputs["of"], facts.words.get("enforcer")
    if word == "formula" or outcome == "together":  # a sentence about all the constraints
        return True
    is_own = is_zero(of.residual - facts.inputs["condition"])
    acts = bool(of.forces) or word == "joint"
    return bool(word == of.enforcer and acts and is_own and (word != "friction" or of.in_rates))


def _keeps_one_constant(facts: Judged) -> bool:
    """Whether the result is that the acceleration of one coordinate vanishes, and the constraint does not contain the
    time."""
    result, condition = explicit(facts.result), facts.inputs["condition"]
    vanishes = result.left in {rate(q, 2) for q in condition.free_symbols} and result.right == 0
    return vanishes and not depends_on_time(condition)


def kept_constant(facts: Judged, q: Any) -> bool:
    """Whether the result sets the acceleration of this coordinate equal to a value."""
    return bool(explicit(facts.result).left == rate(q, 2))


constraint_rate_in_coordinates: Predicate = both(negated(constraint_rate_in_rates), negated(_keeps_one_constant))


constraint_rate_of_constant: Predicate = both(
    negated(constraint_rate_in_rates),
    _keeps_one_constant,
    lambda facts: is_zero(facts.inputs["of"].residual - facts.inputs["condition"]),
)


def _is_constrained(facts: Judged) -> bool:
    kept = facts.quantities["lagrangian"].fact(Constrained)
    return bool(kept and kept.constraints)


acceleration_with_constraints: Predicate = both(lasts, _is_constrained)


acceleration_without_constraints: Predicate = both(lasts, negated(_is_constrained))


def follows_from_these_equations(facts: Judged, outcome: str) -> bool:
    """Whether the named equations and the earlier unknowns give the result; true if the sentence names no equations.

    With trial numbers for the other symbols, these equations are linear in the unknowns.
    """
    equations = [q for role, q in facts.quantities.items() if role.startswith("equation_")]
    if not equations:
        return True
    named = [q for role, q in facts.quantities.items() if not role.startswith("equation_") and role != "lagrangian"]
    earlier = {q.symbol: explicit(q.value) for q in named}
    present = {s for q in equations for s in explicit(q.value).free_symbols} - earlier.keys()
    unknowns = [facts.symbol, *(u for u in facts.inputs["unknowns"] if u in present and u != facts.symbol)]
    rows = [explicit(q.value.residual).xreplace(earlier) for q in equations]
    rows = [explicit(with_known(row, _values_by_constraints(facts), facts.inputs["moving"])) for row in rows]
    letters = {s for row in [*rows, explicit(facts.result)] for s in letters_of(row)} - {*unknowns}
    zero = dict.fromkeys(unknowns, Integer(0))

    def gives(point: Point) -> bool:
        at_zero = [value_at(row, {**point, **zero}) for row in rows]
        slopes = [
            [value_at(row, {**point, **zero, u: Integer(1)}) - rest for u in unknowns]
            for row, rest in zip(rows, at_zero, strict=True)
        ]
        try:
            found = Matrix(slopes).gauss_jordan_solve(-Matrix(at_zero))[0][0]
        except ValueError:
            return False
        number = value_at(explicit(facts.result), point)
        if found.free_symbols:
            return False  # too few equations
        # A result of zero is a difference of terms with rounding errors, so the tolerance also depends on the size of
        # these terms.
        terms = max(abs(each) for each in at_zero) / max(abs(each) for row in slopes for each in row)
        apart = as_rational(found - number)
        return bool(abs(apart) <= (abs(found) + abs(number) + terms) / 10**12)

    return everywhere(trial_points(letters, *assumptions_about(letters), tried=4), gives)


def _values_by_constraints(facts: Judged) -> dict[Symbol, Expr]:
    """Return the values of the coordinates, and of their rates, that the sentence takes from constraints."""
    fixed = [explicit(told) for role, told in facts.inputs.items() if role.startswith("fixed_")]
    moving = facts.inputs["moving"]
    rates = {rate(told.left): by_functions_of_time(told.right, moving, 1) for told in fixed if told.left in moving}
    return {**{told.left: told.right for told in fixed}, **rates}


def _constants(facts: Judged) -> dict[Symbol, Expr]:
    """Return the values of the coordinates that a constraint q = constant fixes."""
    found = {}
    for each in map(explicit, facts.inputs["constraints"]):
        inside = [q for q in facts.inputs["moving"] if each.has(q)]
        if len(inside) == 1 and (slope := derivative(each, inside[0])).is_number and slope.is_nonzero:
            found[inside[0]] = -each.xreplace({inside[0]: Integer(0)}) / slope
    return found


def follows_from_a_constraint(facts: Judged, told: Relation) -> bool:
    """Whether a stated value of a coordinate, a rate or an acceleration follows from a constraint. For a coordinate, a
    constraint that contains it must hold after all stated values are substituted. An acceleration must be the second
    derivative of a stated value, and a rate must be zero by the constraints between rates."""
    moving = facts.inputs["moving"]
    if told.left in map(rate, moving):
        return bool(is_zero(told.right)) and told.left in _rates_at_rest(facts)
    values = {s: v for s, v in _values_by_constraints(facts).items() if s in moving}
    accelerated = {rate(q, 2): q for q in values}
    q = accelerated.get(told.left, told.left)
    if q is not told.left and not is_zero(by_functions_of_time(values[q], moving, 2) - told.right):
        return False
    known = {**_constants(facts), **values}
    about = [explicit(each) for each in facts.inputs["constraints"] if each.has(q)]
    return any(is_zero(with_known(each, known, moving)) for each in about)


def _rates_at_rest(facts: Judged) -> set[Symbol]:
    """Return the rates in the constraints between rates if these constraints hold only where all the rates are zero."""
    values = {s: v for s, v in _values_by_constraints(facts).items() if s in facts.inputs["moving"]}
    rows = [with_known(explicit(each), values, facts.inputs["moving"]) for each in facts.inputs["between_rates"]]
    rates = [rate(q) for q in facts.inputs["moving"] if any(row.has(rate(q)) for row in rows)]
    slopes = Matrix(rows).jacobian(rates) if rows and rates else Matrix()
    homogeneous = all(is_zero(row.xreplace(dict.fromkeys(rates, Integer(0)))) for row in rows)
    return set(rates) if homogeneous and slopes.is_square and not is_zero(slopes.det()) else set()


def eliminated(facts: Judged) -> bool:
    """Whether the sentence names equations and an unknown that is eliminated."""
    return "equation_1" in facts.quantities and "eliminated_1" in facts.inputs


def isolated(facts: Judged) -> bool:
    """Whether the sentence names equations, but no unknown that is eliminated."""
    return "equation_1" in facts.quantities and "eliminated_1" not in facts.inputs


def is_in_these_equations(facts: Judged, symbol: Symbol) -> bool:
    """Whether an unknown that the sentence calls eliminated occurs in at least two of the named equations."""
    equations = [q for role, q in facts.quantities.items() if role.startswith("equation_")]
    return len([q for q in equations if explicit(q.value).has(symbol)]) > 1


multiplier_generic: Predicate = both(lasts, negated(is_stretched))


def multiplier_negative(facts: Judged) -> bool:
    """Whether the result is a force that is negative at trial numbers, and acts on the body in the stated direction."""
    x, y = facts.inputs["positive"]
    word, of_slope, _ = facts.words["sense"].partition("_slope")
    across, beside, wanted = {"up": (y, x, 1), "down": (y, x, -1), "right": (x, y, 1), "left": (x, y, -1)}[word]
    is_so = str(facts.inputs["enforcer"]) == "friction" and not is_zero(beside) if of_slope else is_zero(beside)
    acts = sign_found(facts.result * across) == wanted
    return lasts(facts) and not is_stretched(facts) and is_so and sign_found(facts.result) == -1 and acts


multiplier_multiplier: Predicate = both(lasts, is_stretched)


forced_equation_applied: Predicate = both(has_applied, negated(has_kept))


forced_equation_kept: Predicate = both(has_kept, negated(has_applied))


forced_equation_both: Predicate = both(has_kept, has_applied)


forced_equation_free: Predicate = both(negated(has_kept), negated(has_applied))


handed_on_by(KeptMomentum, kept_momentum)
handed_on_by(WithMomenta, with_momenta)
handed_on_by(ForceOf, force_of_its_constraint)
