"""Equilibria: all values of the coordinates at which the forces vanish, with the conditions under which the equilibria
exist.

The forces come from a potential energy, or from a Lagrangian with the rates set to zero: then V = -L is an effective
potential energy. The values of several coordinates are found one after the other, or together if the forces are linear.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from sympy import Abs, Add, Expr, ImmutableDenseMatrix, Integer, Mul, Symbol, cos, factor, pi, sin
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.amplitudes import Amplitudes
from derive.algebra.collect import by_rates, by_terms
from derive.algebra.derivatives import derivative
from derive.algebra.equality import Verdict
from derive.algebra.expressions import (
    Factors,
    Partial,
    Relation,
    Slope,
    Terms,
    as_expr,
    depends_on_time,
    explicit,
    rate,
    scalar,
    stand_in,
)
from derive.algebra.length import length
from derive.algebra.ranges import range_of
from derive.algebra.relation import sides_without_minus
from derive.algebra.taylor import coefficient_along, slope
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.hamilton.facts import SeenWith
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.mechanics.lagrange.applied_forces import ActedOn
from derive.mechanics.model.dalembert import Matter
from derive.mechanics.model.system import System
from derive.mechanics.rest import claims
from derive.mechanics.rest.both_sides import (
    SidesOpen,
    State,
    how_sides_are_taken,
    keeps_sides,
    on_its_side,
    on_known_sides,
    sides_of,
)
from derive.mechanics.rest.constrained_stability import constraints_of
from derive.mechanics.rest.facts import RestOf, matter_behind
from derive.mechanics.rest.mass_matrix import check_regular
from derive.mechanics.rest.number_of_zeros import is_countable, signs_counted
from derive.solving.attainable import lies_within
from derive.solving.divisors import may_vanish
from derive.solving.zeros import Unsolved, Zero, factors_of, zeros_of
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.record import changes, given_letters
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.signs import sign_for_all
from derive.steps.step import Quantity, Route, compared_with, is_zero, require_kind
from derive.witness.facts import Rest

__all__ = ["equilibria", "potential_at_rest"]

ZERO = Integer(0)
MOST = 32  # largest number of equilibria


POTENTIAL_AT_REST = Rule(
    "rest.potential_at_rest",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 6.1; Landau, Lifshitz, *Mechanics*, section 39",
    outcomes={
        "generic": claims.both(claims.is_at_rest, claims.is_what_the_lagrangian_has),
        "pushed": claims.potential_at_rest_pushed,
    },
    evidence={"work": ROUTE, "given_work": ROUTE},
)


def potential_at_rest(of: Quantity, symbol: str = "V", key: str = "potential_at_rest") -> Quantity:
    """Effective potential energy of a system at rest: -L without the rates, minus F . r for each given constant force.

    Without the rates, -L is U minus the part of T that comes from a prescribed motion; F acts at the position r.

    of   the Lagrangian, J; an energy without rates and without given forces is returned unchanged

    Second route: the work of the forces and of the inertial forces on mass points at rest is -dV for any displacement.
    Outcomes: generic, pushed (constant forces are given).
    Errors: the Lagrangian contains the time explicitly; a given force is not constant, or acts at a point that depends
    on the time.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.1; Landau, Lifshitz, *Mechanics*, section 39.
    """
    require_kind("potential_at_rest", "of", of, "energy")
    if depends_on_time(of.value):
        message = f"an equilibrium needs an energy without the time, but `{of.key}` contains the time explicitly"
        raise Rejected(Complaint("changes", message))
    moving, pushes = list(of.coordinates), _given_pushes(of)
    if not explicit(of.value).free_symbols & {rate(q) for q in moving} and not pushes:
        return of
    still = {rate(q, n): ZERO for q in moving for n in (1, 2)}
    matter = of.needed(Matter)

    def work(found: Expr) -> tuple[Expr, Expr]:
        marks = [stand_in(f"delta_{q.name}") for q in moving]
        lost = (-slope(found, q) * mark for q, mark in zip(moving, marks, strict=True))
        done = (_force_at_rest(matter, q, still) * mark for q, mark in zip(moving, marks, strict=True))
        return Add(*lost), Add(*done)

    def law(L: Expr) -> Expr:
        return Terms(-L, *(-push for push in pushes)) if pushes else Factors(Integer(-1), L)

    return establish(
        POTENTIAL_AT_REST,
        scalar(symbol),
        law,
        {"lagrangian": of},
        lines=Lines(put_in=None, motion=still),
        routes=matter.named({"work": work}),
        outcome="pushed" if pushes else "generic",
        phrase_data=PhraseData(outcome_data={"coordinates": tuple(moving)}),
        key=key,
        kind="energy",
        facts=[matter],
    )


def _given_pushes(of: Quantity) -> list[Expr]:
    """Return the terms of F . r for the given constant forces. Reject a force that is not constant, or that acts at a
    point that depends on the time."""
    acted = of.fact(ActedOn)
    found = []
    for push in acted.forces if acted is not None else ():
        strange = changes(ImmutableDenseMatrix(push.components), of.coordinates)
        if strange is not None or changes(ImmutableDenseMatrix(push.at)) is not None:
            components = ", ".join(map(str, push.components))
            reason = "is not constant" if strange is not None else "acts at a point that depends on the time"
            message = f"the given force ({components}) {reason}, so its potential energy is unknown"
            known = "for a force with a potential energy U, write"
            help_line = Spelled(f"{known} `potential(U)`", f"{known} `potential: U`")
            raise Rejected(Complaint("changes", message, help=help_line))
        found += [Factors(f, at) for f, at in zip(push.components, push.at, strict=True) if f != 0]
    return found


def _force_at_rest(matter: Matter, q: Symbol, still: Mapping[Symbol, Expr]) -> Expr:
    return explicit(matter.force_along(q) - matter.inertia_along(q)).xreplace(dict(still))


def equilibria(of: Quantity, *coordinates: Coordinate) -> tuple[Quantity, ...]:
    """All equilibria, dU/dq = 0 for every coordinate, with the conditions under which they exist.

    of            a potential energy, an effective potential energy or a Lagrangian, J
    coordinates   the unknowns; by default all coordinates that the energy depends on

    An angle without a range is between -pi and pi. A coordinate that is declared positive stays positive, and a
    coordinate with a range stays in this range. If the forces vanish for every value of a coordinate, this coordinate
    has no stated value.
    Keys: condition_x for the equilibrium condition of the coordinate x; for the equilibria, rest_1, rest_2, ..., or
    `rest` if there is only one.
    Second route: the virtual work of forces and inertia gives dU/dq, and vanishes at the equilibrium. Check for one
    coordinate whose range does not include an end: the zeros of the force are counted numerically, for some values of
    the symbols.
    Outcomes: always, where (the equilibrium exists under a condition), only (there is no other equilibrium); for an
    equilibrium condition: generic, zero (no force acts along this coordinate).
    Errors: a zero of the force has no closed form; there is no equilibrium; the symbols leave open whether an
    equilibrium is in the given range; the range of an angle has no limit on one side; the energy contains the time; a
    constraint between the coordinates is maintained by a force; the coordinates are singular at an equilibrium.
    Source: Taylor, *Classical Mechanics*, section 4.6 and example 7.6.
    """
    require_kind("equilibria", "of", of, "energy")
    if depends_on_time(of.value):
        message = f"an equilibrium needs an energy without the time, but `{of.key}` contains the time explicitly"
        raise Rejected(Complaint("changes", message))
    potential = potential_at_rest(of)
    sought = [q.symbol for q in coordinates] or [q for q in potential.coordinates if potential.value.has(q)]
    _check_free(of, [q.symbol for q in coordinates] or list(of.coordinates))
    missing = [q.name for q in sought if not explicit(potential.value).has(q)]
    if missing or not sought:
        message = (
            f"`{of.key}` does not depend on {' and '.join(missing) or 'any coordinate'}, "
            "so any value is possible at equilibrium"
        )
        raise Rejected(Complaint("wrong-argument", message))
    forces = {q: _factored(tidied(derivative(explicit(potential.value), q))) for q in sought}
    others = [q for q in potential.coordinates if q not in sought and any(f.has(q) for f in forces.values())]
    if others:
        message = f"`equilibria`: the forces also depend on {others[0].name}"
        raise Rejected(Complaint("wrong-argument", message, help=f"add {others[0].name} to the coordinates"))
    _check_turns(potential, forces)
    states = _states(of, forces)
    for state in states:
        check_regular("equilibria", all_matter(potential), state.values)
    conditions = [_condition(potential, q, forces[q]) for q in sought]
    names = _names(potential, sought, len(states))
    return tuple(_rest(potential, conditions, sought, state, names, n, states) for n, state in enumerate(states))


def _check_free(of: Quantity, sought: Sequence[Symbol]) -> None:
    """Reject coordinates with a constraint between them, because a constraint force would balance the other forces."""
    tied = next((c for c in constraints_of(of) if any(c.along(q) != 0 for q in sought)), None)
    if tied is not None:
        message = f"`equilibria`: a force maintains the constraint {tied.left} = {tied.right} between the coordinates"
        help_line = "write the positions with fewer coordinates, so that this constraint is not needed"
        raise Rejected(Complaint("constrained", message, help=help_line))


def _check_turns(potential: Quantity, forces: Mapping[Symbol, Expr]) -> None:
    """Reject an angle whose range has no limit on one side, if the force repeats after each turn. Such an angle has
    infinitely many equilibria, and the list for one turn would omit the others, such as 2 pi for a pendulum."""
    for q, force in forces.items():
        known = range_of(q)
        is_limited = known.least.is_finite and known.greatest.is_finite if known is not None else not q.is_positive
        if potential.coordinates.get(q) == "angle" and not is_limited and is_zero(force.subs(q, q + 2 * pi) - force):
            message = f"`equilibria`: the range of the angle {q.name} has no limit on one side, so equilibria repeat"
            help_line = f"give {q.name} a range of one turn or less; an angle without a range is from -pi to pi"
            raise Rejected(Complaint("wrong-argument", message, help=help_line))


def _factored(force: Expr) -> Expr:
    try:
        return min((factor(force), force), key=length)
    except PolynomialError:
        return force


def _states(of: Quantity, forces: Mapping[Symbol, Expr]) -> list[State]:
    try:
        found = _on_all_sides(forces)
    except SidesOpen as fault:
        where = ", ".join(f"{q} = {value}" for q, value in fault.state.values.items())
        message = f"`{of.key}` has an equilibrium {where} only if {fault.state.exists} and {fault.other}"
        help_line = "specify the side: give a coordinate a range, such as `x: positive length`"
        raise Rejected(Complaint("no-closed-form", message, help=help_line)) from None
    except Unsolved as fault:
        message = f"the equilibria of `{of.key}` were not found in closed form, because of {fault.factor}"
        known = "if an answer needs an equilibrium, give a known one, "
        help_line = Spelled(f"{known}`at={{theta: 0}}`", f"{known}`at: {{theta: 0}}`")
        raise Rejected(Complaint("no-closed-form", message, help=help_line)) from None
    found = [state for state in found if _in_range(of, state)]
    if not found:
        ranged = [q.name for q in forces if range_of(q) is not None]
        where = f" for {' and '.join(ranged)} in the given range" if ranged else ""
        raise Rejected(Complaint("no-equilibrium", f"`{of.key}` has no equilibrium: its force vanishes nowhere{where}"))
    if len(found) > MOST:
        raise Rejected(Complaint("too-large", f"`{of.key}` has more than {MOST} equilibria"))
    return found


def _in_range(of: Quantity, state: State) -> bool:
    inside = {q: lies_within(q, value, state.exists) for q, value in state.values.items()}
    open_ = next((q for q, known in inside.items() if known is None), None)
    if open_ is not None:
        message = (
            f"`{of.key}`: whether {open_} = {state.values[open_]} is in the range of {open_} depends on the symbols"
        )
        raise Rejected(Complaint("range", message, help=f"give {open_} a wider range, or no range"))
    return all(inside.values())


def _on_all_sides(forces: Mapping[Symbol, Expr]) -> list[State]:
    found: list[State] = []
    for branches in sides_of(forces):
        solved = _solved([force.xreplace(dict(branches)) for force in forces.values()], list(forces), State({}))
        found += [there for state in solved if (there := on_its_side(state, list(branches.values()))) is not None]
    return [state for state in found if keeps_sides(state)]


def _solved(forces: Sequence[Expr], unknown: list[Symbol], state: State) -> list[State]:
    """Return all states in which the forces vanish; empty if there are none.

    Linear equations are solved together if the solution is unique. Otherwise one equation is solved after another.
    """
    left = [force for force in (tidied(f) for f in forces) if not is_zero(force)]
    if any(not force.has(*unknown) for force in left):
        return []
    if not left:
        return [state]
    together = _linear(left, unknown, state)
    if together is not None:
        return [together]
    for force in left:
        branches = [(f, [q for q in unknown if f.has(q)]) for f in factors_of_any(force, unknown)]
        if all(len(held) == 1 for _, held in branches):
            found: dict[Any, State] = {}
            for part, (q,) in branches:
                for zero in zeros_of(part, q):
                    for each in _with_zero(left, force, unknown, state, q, zero):
                        found.setdefault(frozenset(each.values.items()), each)
            return sorted(found.values(), key=lambda s: s.exists is not None)
    raise Unsolved(left[0])


def factors_of_any(force: Expr, unknown: Sequence[Symbol]) -> list[Expr]:
    """Return the factors of a force that contain at least one of the coordinates."""
    held = [q for q in unknown if force.has(q)]
    if len(held) == 1:
        return list(factors_of(force, held[0]))
    above = _factored(force).as_numer_denom()[0]
    return [f.as_base_exp()[0] for f in Mul.make_args(above) if f.has(*unknown)]


def _with_zero(
    forces: Sequence[Expr], solved: Expr, unknown: list[Symbol], state: State, q: Symbol, zero: Zero
) -> list[State]:
    if state.exists is not None and zero.exists is not None and state.exists != zero.exists:
        raise Unsolved(solved)
    rest = [force.subs(q, zero.value) for force in forces if force is not solved]
    known = State({**state.values, q: zero.value}, zero.exists or state.exists)
    return _solved(rest, [other for other in unknown if other != q], known)


def _linear(forces: Sequence[Expr], unknown: Sequence[Symbol], state: State) -> State | None:
    """Return the unique values of several coordinates for which linear forces vanish. Return None if a force is not
    linear, if the numbers of forces and of coordinates differ, or if the values may not be unique."""
    held = [q for q in unknown if any(force.has(q) for force in forces)]
    if len(held) < 2 or len(held) != len(forces):
        return None
    matrix = ImmutableDenseMatrix([[derivative(force, q) for q in held] for force in forces])
    if matrix.has(*held) or sign_for_all(tidied(matrix.det(method="berkowitz"))) in (None, 0):
        return None
    at_zero = ImmutableDenseMatrix([-force.xreplace(dict.fromkeys(held, ZERO)) for force in forces])
    values = matrix.adjugate() * at_zero / matrix.det(method="berkowitz")
    return State({**state.values, **{q: tidied(v) for q, v in zip(held, values, strict=True)}}, state.exists)


# --- the steps -------------------------------------------------------------------------------------------------------


CONDITION = Rule(
    "rest.condition",
    source="Taylor, *Classical Mechanics*, section 4.6 and example 7.6",
    outcomes={"generic": claims.condition_generic, "zero": claims.condition_zero},
    evidence={"virtual_work": ROUTE, "given_virtual_work": ROUTE},
    statements=[claims.steady_as_its_potential],
    named={"steady": claims.only_coordinate},
)


def _condition(potential: Quantity, q: Symbol, force: Expr) -> Quantity:
    """Equilibrium condition, dU/dq = 0.

    Outcomes: generic, zero.
    Source: the same as for `equilibria`.
    """
    alone = {s for s in potential.coordinates if explicit(potential.value).has(s)} == {q}
    return establish(
        CONDITION,
        None,
        lambda U: Relation(Slope(U, q, Integer(1)) if alone else Partial(U, q), "=", 0),
        {"potential": potential},
        lines=Lines(put_in=None, arranged=lambda _: Relation(_term_by_term(force, q), "=", 0)),
        routes=named_by(
            potential, {"virtual_work": compared_with(lambda: Relation(slope_otherwise(potential, q), "=", 0))}
        ),
        outcome="zero" if force == 0 else "generic",
        phrase_data=PhraseData(outcome_data={"coordinate": q}, named=steady_in(potential, [q])),
        key=f"condition_{q.name}",
    )


def _term_by_term(force: Expr, q: Symbol) -> Expr:
    """Write G M m/r^2 - l^2/(m r^3), not (G M m^2 r - l^2)/(m r^3)."""
    below = force.as_numer_denom()[1]
    if below.has(Abs):
        return by_rates(force, [q])
    return by_terms(force.expand()) if below.has(q) and not below.has(sin, cos) else force


def steady_in(potential: Quantity, sought: Sequence[Symbol]) -> dict[str, Symbol]:
    """Return the only coordinate, under the key `steady`, if U contains conserved momenta. Return an empty mapping if U
    contains none, or if there are several coordinates."""
    seen = potential.fact(SeenWith)
    if seen is None or not seen.constants or len(sought) != 1:
        return {}
    return {"steady": sought[0]}


def all_matter(potential: Quantity) -> Matter | None:
    """Return the mass points and forces to which a potential energy belongs, including magnetic forces, which are not
    in U. Return None if the mass points and forces are unknown."""
    body = potential.subject.body
    seen = potential.fact(SeenWith)
    return body.matter if seen is None and isinstance(body, System) else matter_behind(potential)


def named_by(potential: Quantity, routes: Mapping[str, Route]) -> dict[str, Route]:
    matter = matter_behind(potential)
    return dict(routes) if matter is None else matter.named(routes)


def slope_otherwise(potential: Quantity, q: Symbol) -> Expr:
    """Return dU/dq from the virtual work of the forces and of the inertia of mass points at rest. If mass points and
    forces are unknown, return dU/dq from the first-order change of U in a displacement."""
    matter = matter_behind(potential)
    if matter is not None:
        still = {rate(s, n): ZERO for s in matter.coordinates for n in (1, 2)}
        return -_force_at_rest(matter, q, still)
    return coefficient_along(explicit(potential.value), {q: q}, {q: Integer(1)}, 1)


def _names(potential: Quantity, sought: Sequence[Symbol], count: int) -> dict[Symbol, list[Symbol]]:
    """Return the symbols of the equilibria: theta_0, or theta_1, theta_2, ... for several.

    If a given quantity already has one of these symbols, the symbols are theta_eq, or theta_eq_1, theta_eq_2, ...
    """
    taken = {s.name for s in explicit(potential.value).free_symbols} | given_letters()

    def letters(q: Symbol) -> list[Symbol]:
        numbers = range(1, count + 1) if count > 1 else [0]
        if not taken & {f"{q.name}_{n}" for n in numbers}:
            return [scalar(f"{q.name}_{n}") for n in numbers]
        return [scalar(f"{q.name}_eq_{n}" if count > 1 else f"{q.name}_eq") for n in numbers]

    return {q: letters(q) for q in sought}


def _level_where(force: Expr, q: Symbol) -> Relation | None:
    """Return the condition that no factor without q is zero; otherwise the force would be zero for all values of q.
    Return None if no such factor can be zero.
    """
    factors = (f.as_base_exp()[0] for f in Mul.make_args(_factored(force).as_numer_denom()[0]))
    left = may_vanish(Mul(*(f for f in factors if not f.has(q))))
    if left is None or not left.left.is_Add:
        return left
    more, less = sides_without_minus(left.left)
    return Relation(more, left.operator, less)


def _by_terms_if_shorter(value: Expr) -> Expr:
    """Write l + m g/k, not (m g + k l)/k, if this is shorter and the denominator contains no sum, sine or cosine."""
    if not value.as_numer_denom()[0].is_Add or value.as_numer_denom()[1].atoms(Add, sin, cos):
        return value
    return min((value, by_terms(value.expand())), key=length)


EQUILIBRIUM = Rule(
    "rest.equilibrium",
    source="Taylor, *Classical Mechanics*, section 4.6 and example 7.6",
    outcomes={
        "only": claims.equilibrium_only,
        "always": claims.both(
            claims.anywhere, claims.several, claims.all_are_told, claims.sides_as_told, claims.level_as_told
        ),
        "where": claims.both(
            claims.under_its_condition, claims.all_are_told, claims.sides_as_told, claims.level_as_told
        ),
    },
    evidence={"no_force": CHECK, "counted": CHECK},
    statements=[claims.steady_as_its_potential],
    named={"steady": claims.only_coordinate},
    names_value=True,
)


def _rest(
    potential: Quantity,
    conditions: Sequence[Quantity],
    sought: Sequence[Symbol],
    state: State,
    names: Mapping[Symbol, list[Symbol]],
    n: int,
    states: Sequence[State],
) -> Quantity:
    """The step for one equilibrium.

    Outcomes: always, where, only.
    Source: the same as for `equilibria`.
    """
    held = [q for q in sought if q in state.values]
    values = [_by_terms_if_shorter(state.values[q]) for q in held]
    single = len(held) == 1
    symbol: Any = names[held[0]][n] if single else ImmutableDenseMatrix([names[q][n] for q in held])
    told = {}
    if state.exists is not None:
        told["exists"] = (state.exists, Relation(-state.exists.right, state.exists.operator, -state.exists.left))
    if len(sought) == 1 and (excluded := _level_where(conditions[0].value.left, sought[0])) is not None:
        told["excluded"] = (excluded, Relation(excluded.right, "!=", excluded.left))

    def no_force(found: Any) -> tuple[Expr, Expr]:
        marks = [stand_in(f"u_{i}") for i in range(len(sought))]
        there = dict(zip(held, [found] if single else found, strict=True))
        left = [on_known_sides(slope_otherwise(potential, q).xreplace(there), state.exists) for q in sought]
        return Add(*(tidied(force) * mark for force, mark in zip(left, marks, strict=True))), ZERO

    def counted(found: Any) -> Verdict:
        return signs_counted(potential, sought[0], [(each.values[sought[0]], each.exists) for each in states], found)

    distances = tuple(Integer(i) for i, q in enumerate(held) if q.is_positive)
    outcome = "where" if state.exists is not None else "only" if len(states) == 1 else "always"
    return establish(
        EQUILIBRIUM,
        symbol,
        lambda *_: values[0] if single else Amplitudes(*values),
        {f"condition_{i}": condition for i, condition in enumerate(conditions)},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"no_force": no_force, **({"counted": counted} if is_countable(sought) else {})},
        outcome=outcome,
        phrase_data=PhraseData(
            formulas=told,
            named=steady_in(potential, sought),
            outcome_data={
                "count": Integer(len(states)),
                "distances": distances,
                "sought": tuple(sought),
                "angles": tuple(q for q in sought if potential.coordinates.get(q) == "angle"),
                "states": tuple(tuple(each.values.items()) for each in states),
            },
            words={"seen": how_sides_are_taken(sought)},
        ),
        key=f"rest_{n + 1}" if len(states) > 1 else "rest",
        kind=dict(potential.coordinates)[held[0]] if single else None,
        facts=[Rest(dict(state.values), state.exists), RestOf(potential, tuple(sought))],
        parents=[potential],
    )


def place_given(at: Quantity | Mapping[Any, Expr]) -> dict[Symbol, Expr]:
    """Return the equilibrium value of each coordinate, from a result of `equilibria` or from given values."""
    if isinstance(at, Quantity):
        return dict(at.needed(Rest).values)
    return {q.symbol if isinstance(q, Coordinate) else q: as_expr(value) for q, value in at.items()}
