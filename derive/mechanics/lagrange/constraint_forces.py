"""Accelerations and constraint forces from the equations of motion and the constraints."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

from sympy import (
    Add,
    Dummy,
    Expr,
    Function,
    ImmutableDenseMatrix,
    Integer,
    Matrix,
    Pow,
    Rational,
    Symbol,
    sqrt,
)
from sympy.core.symbol import Str
from sympy.polys.matrices import DomainMatrix
from sympy.polys.matrices.exceptions import DMError

from derive.algebra.collect import by_accelerations
from derive.algebra.derivatives import derivative
from derive.algebra.expressions import (
    Factors,
    Prescribed,
    Relation,
    Terms,
    TimeRate,
    as_expr,
    constant_ones,
    depends_on_time,
    explicit,
    rate,
    scalar,
    stand_in,
    with_known,
)
from derive.algebra.kinds import dimension_of_kind, kind_of_dimension
from derive.algebra.normal_form import vanishes as vanishes_identically
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.kinematics.coordinates import Coordinate, OfCoordinate, by_functions_of_time
from derive.mechanics.lagrange import claims
from derive.mechanics.lagrange.applied_forces import ForcedMotion
from derive.mechanics.lagrange.facts import ForceOf, FromLagrangian
from derive.mechanics.lagrange.fixed_coordinates import KeptPositions, fixed_together, is_fixed_by, rates_at_rest
from derive.mechanics.model.constraint import Constrained, Constraint
from derive.mechanics.model.dalembert import Matter
from derive.mechanics.model.description import description_behind
from derive.mechanics.model.gradients import gradient_length
from derive.mechanics.model.rigid import by_squares
from derive.solving.divisors import told_of_divisors
from derive.solving.elimination import Isolated, Substitution, isolated_in_order, substitutions
from derive.steps.claims import both, lasts, says_what_it_divides_by, vanishes
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.level import Manner
from derive.steps.record import coordinates_in
from derive.steps.rule import CHECK, ROUTE, Rule, Shown
from derive.steps.signs import sign_known
from derive.steps.step import Level, Quantity, Step, compared_with, is_zero

__all__ = ["accelerations", "constraint_force", "constraint_rate", "multipliers"]

ZERO = Integer(0)
MOST = 9  # greatest number of unknowns in one linear system
MOST_NAMED = 6  # greatest number of equations that a sentence names
MOST_WITH_ROOTS = 250  # greatest number of operations in a solution with several roots of sums, such as sqrt(a + b)
MOST_SUBSTITUTED = 4  # if more substitutions are needed, the sentence states none of them


@dataclass(frozen=True)
class _Problem:
    """Linear equations for accelerations and multipliers: equations of motion, and constraints enforced by forces.

    lagrangian   the Lagrangian of all equations
    equations    the equations of motion, one for each coordinate
    keeping      coordinates whose accelerations remain in the result; the equations of these coordinates are not used
    """

    lagrangian: Quantity
    equations: tuple[Quantity, ...]
    keeping: tuple[Symbol, ...] = ()

    @property
    def moving(self) -> list[Symbol]:
        return [each.needed(OfCoordinate).coordinate.symbol for each in self.equations]

    @property
    def solved(self) -> list[Symbol]:
        return [q for q in self.moving if q not in self.keeping]

    @property
    def used(self) -> list[Quantity]:
        return [each for each in self.equations if each.needed(OfCoordinate).coordinate.symbol not in self.keeping]

    @property
    def constraints(self) -> tuple[Constraint, ...]:
        kept = self.lagrangian.fact(Constrained)
        return kept.constraints if kept else ()

    @property
    def unknowns(self) -> list[Symbol]:
        return [*(rate(q, 2) for q in self.solved), *(each.force for each in self.constraints)]

    @property
    def known(self) -> dict[Symbol, Expr]:
        """Coordinate or rate -> its value, as far as the constraints give one.

        A coordinate is an expression in the other coordinates if one constraint is solved for this coordinate, or a
        constant if several constraints fix it. The rate of the coordinate is the rate of this value. Several
        constraints on rates may also require that some rates vanish.
        """
        constant = {told.left: told.right for told in _together(self.constraints, self.moving).values()}
        found = {**constant, **dict.fromkeys(map(rate, constant), ZERO)}
        still = rates_at_rest(
            [each.residual.xreplace(found) for each in self.constraints if each.in_rates], self.moving
        )
        found |= still
        for each in self.constraints:
            residual = each.residual.xreplace(found)
            slopes = {q: derivative(residual, q) for q in self.moving}
            fit = [q for q, slope in slopes.items() if slope.is_nonzero and slope.is_number]
            if each.in_rates or not fit:
                continue
            q = min(fit, key=self._is_in_forces)
            value = -(residual - slopes[q] * q) / slopes[q]
            new = {q: tidied(value), rate(q): tidied(TimeRate(value, *self.moving))}
            found = {**{letter: old.xreplace(new) for letter, old in found.items()}, **new}
        return found

    def _is_in_forces(self, q: Symbol) -> bool:
        """Whether the derivative of the Lagrangian with respect to q contains a coordinate or a rate."""
        slope = derivative(explicit(self.lagrangian.value), q)
        return not slope.free_symbols.isdisjoint([*self.moving, *map(rate, self.moving)])

    @property
    def residuals(self) -> list[Expr]:
        equations = [explicit(each.value).residual for each in self.used]
        together = _together(self.constraints, self.moving)
        changes = [
            rate(together[i].left, 2) if i in together else each.acceleration(self.moving)
            for i, each in enumerate(self.constraints)
        ]
        return [*equations, *changes]

    @property
    def residuals_known(self) -> list[Expr]:
        return list(map(self.with_known, self.residuals))

    def with_known(self, value: Expr) -> Expr:
        return with_known(value, self.known, self.moving)


def _problem(verb: str, equations: Sequence[Quantity], keeping: Sequence[Coordinate] = ()) -> _Problem:
    if not equations:
        raise Rejected(Complaint("wrong-argument", f"`{verb}` needs equations of motion"))
    found = [_lagrangian_of(verb, each) for each in equations]
    if any(each.step != found[0].step for each in found):
        raise Rejected(Complaint("different-subjects", f"`{verb}` needs the equations of motion of one Lagrangian"))
    problem = _Problem(found[0], tuple(equations), tuple(q.symbol for q in keeping))
    matter = found[0].needed(Matter)
    missing = [q.name for q in matter.coordinates if q not in problem.moving]
    if missing or len(set(problem.moving)) < len(problem.moving):
        what = f"the equation of {missing[0]} is missing" if missing else "one equation is given twice"
        help_line = "`equations_of_motion` returns all equations"
        message = f"`{verb}` needs one equation of motion for each coordinate, but {what}"
        raise Rejected(Complaint("wrong-argument", message, help=help_line))
    if len(problem.unknowns) > MOST:
        message = f"`{verb}` solves for at most {MOST} accelerations and forces, but there are {len(problem.unknowns)}"
        raise Rejected(Complaint("too-hard", message))
    return problem


def _lagrangian_of(verb: str, equation: Quantity) -> Quantity:
    fact = equation.fact(ForcedMotion) or equation.fact(FromLagrangian)
    if fact is None or equation.fact(OfCoordinate) is None or not isinstance(equation.value, Relation):
        raise Rejected(Complaint("wrong-argument", f"`{verb}`: `{equation.key}` is not an equation of motion"))
    return fact.lagrangian


def accelerations(*equations: Quantity) -> tuple[Quantity, ...]:
    """Accelerations q_ddot, from the equations of motion, and from the constraints if there are any.

    equations   the equations of motion, one for each coordinate of one Lagrangian

    Keys: acceleration_x for the coordinate x.
    Outcomes: generic (with constraints), unconstrained, isolated (from the equations that the sentence names),
    eliminated (from these equations, after other unknowns are eliminated), zero.
    Second route: the accelerations and constraint forces satisfy d'Alembert's principle, sum of (m a - F) . dr/dq = 0
    for every coordinate.
    Check: the accelerations satisfy the constraints, differentiated as functions of t.
    Errors: an equation is missing or is given twice; the equations belong to different Lagrangians; there are too many
    unknowns; the constraints contradict one another or are not independent; a coordinate has no inertia; a surface
    would have to pull, or a string would have to push; the solution has too many terms.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4.
    """
    problem = _problem("accelerations", equations)
    return _steps(problem, [rate(q, 2) for q in problem.moving])


def multipliers(*equations: Quantity, keeping: Sequence[Coordinate] = ()) -> tuple[Quantity, ...]:
    """Constraint forces or multipliers lambda, from the equations of motion and the constraints f = 0.

    equations   the equations of motion, one for each coordinate of one Lagrangian
    keeping     coordinates whose accelerations remain in the forces; the equations of these coordinates are not used

    Keys: the symbols of the forces.
    Second route: d'Alembert's principle, as for `accelerations`.
    Outcomes: generic (the multiplier is the constraint force), negative (the multiplier is the constraint force on a
    single body and is known to be negative; the sentence states the direction in which the force acts), multiplier (the
    gradient of f with respect to the position of the particle does not have length 1; the sentence states the length),
    isolated and eliminated (as for `accelerations`), zero.
    Errors: no constraint is enforced by a force; also the errors of `accelerations`.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4.
    """
    problem = _problem("multipliers", equations, keeping)
    if not problem.constraints:
        message = "`multipliers` needs constraints enforced by forces, but this system has none"
        raise Rejected(
            Complaint(
                "wrong-argument",
                message,
                help=Spelled("add `constraint(f, force=...)`", "write a constraint and its force under `constraints`"),
            )
        )
    return _steps(problem, [each.force for each in problem.constraints])


def _with_one_alone(left: Expr, wanted: Set[Symbol]) -> Relation:
    """Return the equation left = 0 solved for a symbol of `wanted` that is a term by itself:
    y_ddot = R phi_ddot. If there is no such symbol and all terms are negative, change all signs."""
    terms = Add.make_args(left)
    others = {term: [each for each in terms if each is not term] for term in terms}
    for term in reversed(terms) if len(terms) > 1 else ():
        sign, symbol = (1, term) if isinstance(term, Symbol) else (-1, -term)
        if symbol in wanted and not any(each.has(symbol) for each in others[term]):
            return Relation(symbol, "=", Add(*(-sign * each for each in others[term]), evaluate=False))
    is_negative = all(term.could_extract_minus_sign() for term in terms)
    return Relation(Add(*(-term for term in terms)) if is_negative else left, "=", ZERO)


def _arranged(left: Expr, moving: Sequence[Symbol]) -> Relation:
    """Return the equation left = 0 with its terms collected by accelerations, solved for an acceleration that is a term
    by itself."""
    solved = _with_one_alone(by_accelerations(left, moving), {rate(q, 2) for q in moving})
    return Relation(solved.left, "=", by_accelerations(solved.right, moving)) if solved.right != 0 else solved


def _told(of: Constraint, moving: Sequence[Symbol]) -> Relation:
    """Return the relation of a constraint, unchanged if its right side is not zero.

    A constraint between rates is solved for a rate that is a term by itself. If no rate is a term by itself, or if the
    constraint is between coordinates, all signs change if the left side begins with a minus sign.
    """
    if of.right != 0:
        return of.relation
    if of.in_rates and (solved := _with_one_alone(of.left.expand(), {rate(q) for q in moving})).right != 0:
        return solved
    return Relation((-of.left).expand(), "=", ZERO) if of.left.could_extract_minus_sign() else of.relation


def _together(constraints: Sequence[Constraint], moving: Sequence[Symbol]) -> dict[int, Relation]:
    """Return a mapping from the index of a constraint to a relation y = a, for constraints that only together give
    coordinates constant values."""
    residuals = {
        i: each.residual for i, each in enumerate(constraints) if not each.in_rates and _fixed(each, moving) is None
    }
    values = fixed_together(list(residuals.values()), moving)
    kept = [i for i, f in residuals.items() if is_fixed_by(f, values)]
    return {i: Relation(q, "=", value) for i, (q, value) in zip(kept, values.items(), strict=True)}


def positions_kept(motion: Quantity) -> KeptPositions:
    """Return the constant coordinates, their values, and the constraints that together fix these values. Some of the
    constraints may fix a coordinate alone.

    motion   one of the equations of motion
    """
    of = _lagrangian_of("positions_kept", motion)
    kept = of.fact(Constrained)
    constraints, moving = kept.constraints if kept else (), list(of.coordinates)
    residuals = [each.residual for each in constraints if not each.in_rates]
    values = fixed_together(residuals, moving) or {
        told.left: told.right for told in _together(constraints, moving).values()
    }
    return KeptPositions(values, tuple(f for f in residuals if is_fixed_by(f, values)))


def _fixed(of: Constraint, moving: Sequence[Symbol]) -> Relation | None:
    """Return y = a for a constraint y - a = 0 or a - y = 0 with a coordinate y and a constant a; otherwise None."""
    contained = [q for q in moving if of.residual.has(q, rate(q))]
    if len(contained) != 1 or of.in_rates or depends_on_time(of.residual):
        return None
    (q,) = contained
    slope = derivative(of.residual, q)
    return Relation(q, "=", tidied(q - of.residual / slope)) if slope in (1, -1) else None


CONSTRAINT_RATE = Rule(
    "lagrange.constraint_rate",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4",
    outcomes={
        "in_rates": claims.constraint_rate_in_rates,
        "in_coordinates": claims.constraint_rate_in_coordinates,
        "constant": claims.constraint_rate_of_constant,
        "together": claims.constraint_rate_together,
    },
    evidence={"functions_of_time": CHECK},
    statements=[claims.names_the_enforcer],
    named={"kept": claims.kept_constant},
    shown=Shown(brief=Manner.LEFT_OUT, outcomes={"constant": (Manner.LEFT_OUT, Manner.LEFT_OUT)}),
)
KEPT = ("surface", "rail", "string", "rod", "joint", "friction")  # enforcers that the sentence names
FORMULA = "formula"  # the word for any other enforcer


def constraint_rate(of: Quantity, number: int = 0, key: str | None = None) -> Quantity:
    """A constraint f = 0, differentiated until it contains accelerations: d^2 f/dt^2 = 0, or df/dt = 0 if f contains
    rates.

    of       the Lagrangian of a system with constraints
    number   the index of the constraint, 0 for the first

    Outcomes: in_rates, in_coordinates, constant (the constraint is y = a, with one coordinate), together (several
    constraints, including this one, are equivalent to relations such as y = a).
    Check: replace each coordinate in f by its Taylor series in t, and differentiate with respect to t.
    Errors: there is no constraint with this index.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4.
    """
    constraints = of.needed(Constrained).constraints
    if number not in range(len(constraints)):
        message = f"`constraint_rate` needs the index of a constraint, 0 to {len(constraints) - 1}"
        raise Rejected(Complaint("wrong-argument", message))
    each, moving = constraints[number], list(of.coordinates)
    order = 1 if each.in_rates else 2

    together = _together(constraints, moving)
    fixed = together.get(number) or _fixed(each, moving)
    condition = together[number].residual if number in together else each.residual
    told = fixed or _told(each, moving)

    def by_time() -> Relation:
        return Relation(by_functions_of_time(condition, moving, order), "=", ZERO)

    def law(f: Expr) -> Relation:
        once = TimeRate(f, *moving)
        return Relation(once if each.in_rates else TimeRate(explicit(once), *moving), "=", ZERO)

    return establish(
        CONSTRAINT_RATE,
        None,
        law,
        {"condition": condition},
        lines=Lines(
            put_in=None,
            law=Level.FULL,
            arranged=lambda found: _arranged(explicit(found.left), moving),
        ),
        routes={"functions_of_time": compared_with(by_time)},
        outcome="together"
        if number in together
        else "in_rates"
        if each.in_rates
        else "constant"
        if fixed
        else "in_coordinates",
        phrase_data=PhraseData(
            formulas={"constraint": (told, Relation(condition, "=", ZERO))},
            words={"enforcer": each.enforcer if each.enforcer in KEPT else FORMULA},
            named={"kept": fixed.left} if fixed else {},
            outcome_data={
                "of": each,
                "kept_together": tuple(together.values()),
                "keeping": tuple(constraints[i].residual for i in together),
            },
        ),
        key=key or f"constraint_{each.force.name}",
        facts=[described] if (described := description_behind(of)) is not None else [],
        scope=Scope(coordinates=of.coordinates),
    )


def _steps(problem: _Problem, wanted: Sequence[Symbol]) -> tuple[Quantity, ...]:
    """Return the steps of these unknowns. If a formula contains other unknowns, these are derived first."""
    rates = [constraint_rate(problem.lagrangian, i) for i in range(len(problem.constraints))]
    forces = {each.force: each for each in problem.constraints}
    order, every = _isolated(problem), [*problem.used, *rates]
    steps: dict[Symbol, Quantity] = {}

    def step(symbol: Symbol) -> Quantity:
        if symbol not in steps:
            isolation = None
            if symbol in order and len(order[symbol].equations) <= MOST_NAMED:
                earlier = {str(u): step(u) for u in order[symbol].earlier}
                isolation = _Isolation(order[symbol], [every[i] for i in order[symbol].equations], earlier, problem)
            if symbol in forces:
                steps[symbol] = _multiplier(forces[symbol], problem, rates, isolation)
            else:
                steps[symbol] = _acceleration(symbol, problem, rates, isolation)
        return steps[symbol]

    return tuple(step(symbol) for symbol in wanted)


@dataclass(frozen=True)
class _Isolation:
    """An `Isolated` unknown with its equations, and the unknowns that were found before it."""

    found: Isolated
    equations: Sequence[Quantity]
    earlier: Mapping[str, Quantity]
    problem: _Problem

    @property
    def outcome(self) -> str:
        return "eliminated" if self.found.eliminated else "isolated"

    @property
    def inputs(self) -> Mapping[str, Quantity]:
        return self.earlier if self.found.value is not None else {}

    def law(self, value: Expr) -> Callable[..., Expr]:
        """Return the unknown as a function of the earlier unknowns, or its value if there is no such formula."""
        formula = self.found.value
        if formula is None or not self.found.earlier:
            return lambda *_: value
        return lambda *values: formula.xreplace(dict(zip(self.found.earlier, values, strict=True)))

    @property
    def pointed(self) -> dict[str, Quantity]:
        hidden = () if self.inputs else self.earlier.values()
        in_words = self._constant
        pointed = [each for each in self._in_use if each not in in_words]
        equations = {f"equation_{i}": each for i, each in enumerate(pointed, 1)}
        return {**equations, **{f"earlier_{i}": each for i, each in enumerate(hidden, 1)}}

    @property
    def _constant(self) -> dict[Quantity, Relation]:
        """Return a mapping from each equation q_ddot = 0 to its constraint q = constant. The mapping is empty if
        unknowns are eliminated, or if all equations have this form."""
        constraints = self.problem.constraints
        first = len(self.problem.used)
        numbers = [i - first for i in self.found.equations if i >= first]
        moving = self.problem.moving
        together = _together(constraints, moving)
        fixed = {i: together.get(i) or _fixed(constraints[i], moving) for i in numbers}
        found = {
            each: relation
            for i, each in zip(self.found.equations, self.equations, strict=True)
            if i >= first and (relation := fixed[i - first])
        }
        return {} if self.found.eliminated or len(found) == len(self.equations) else found

    @cached_property
    def _substituted(self) -> tuple[Substitution, ...]:
        """Return the substitutions that eliminate the other unknowns. The result is empty if there are too many of
        these unknowns, or if their number is not one less than the number of equations."""
        eliminated = self.found.eliminated
        if not 0 < len(eliminated) == len(self.equations) - 1 or len(eliminated) > MOST_SUBSTITUTED:
            return ()
        rows = [self.problem.residuals_known[i] for i in self.found.equations]
        return substitutions(rows, eliminated)

    @property
    def _in_use(self) -> list[Quantity]:
        used = [each.equation for each in self._substituted]
        order = [*used, *(i for i in range(len(self.equations)) if i not in used)]
        return [self.equations[i] for i in order]

    @property
    def formulas(self) -> dict[str, tuple[Relation, Relation]]:
        found, rows = {}, self.problem.residuals_known
        done: dict[Symbol, Expr] = {}
        for n, each in enumerate(self._substituted, 1):
            row = rows[self.found.equations[each.equation]]
            for u, value in done.items():
                row = row.xreplace({u: value})
            found[f"gives_{n}"] = (Relation(each.unknown, "=", each.value), Relation(row, "=", ZERO))
            done[each.unknown] = each.value
        return found

    def as_it_is(self, symbol: Symbol, value: Expr) -> dict[str, tuple[Relation, Relation]]:
        """Return the value of the unknown if an equation of the page already states it, such as x_ddot = A."""
        whole = Relation(symbol, "=", value)
        equations = list(self.pointed.values())
        same = len(equations) == 1 and isinstance(equations[0].value, Relation)
        return {"as_it_is": (whole, equations[0].value)} if same and explicit(equations[0].value) == whole else {}

    @property
    def named(self) -> dict[str, Any]:
        """Return the eliminated unknowns, and the values that constraints give to coordinates, rates and accelerations
        in the equations."""
        eliminated = {f"eliminated_{i}": each for i, each in enumerate(self.found.eliminated, 1)}
        known, moving = self.problem.known, self.problem.moving
        fixed_ones = constant_ones(known, moving)
        values = [explicit(each.value) for each in self.equations]
        present = {s for each in values for s in each.free_symbols}
        left = {s for each in values for s in explicit(each.residual).xreplace(fixed_ones).free_symbols}
        constant = {each.left: each for each in self._constant.values()}
        inside = {q: present if q in fixed_ones else left for q in known}
        used = [q for q in moving if q in constant or (q in known and inside[q] & {q, rate(q)})]
        fixed = [
            relation
            for q in used
            for relation in (
                (constant[q], Relation(rate(q, 2), "=", ZERO)) if q in constant else (Relation(q, "=", known[q]),)
            )
        ]
        still = [rate(q) for q in moving if q not in known and rate(q) in known and rate(q) in present]
        fixed += [Relation(each, "=", known[each]) for each in still]
        return {**eliminated, **{f"fixed_{i}": each for i, each in enumerate(fixed, 1)}}

    @property
    def outcome_data(self) -> dict[str, Any]:
        together = _together(self.problem.constraints, self.problem.moving)
        return {
            "unknowns": self.problem.unknowns,
            "moving": self.problem.moving,
            "constraints": [
                together[i].residual if i in together else each.residual
                for i, each in enumerate(self.problem.constraints)
                if not each.in_rates
            ],
            "between_rates": [each.residual for each in self.problem.constraints if each.in_rates],
        }


@lru_cache(maxsize=16)
def _isolated(problem: _Problem) -> dict[Symbol, Isolated]:
    return isolated_in_order(problem.residuals_known, problem.unknowns)


def _repeated(step: Step) -> str:
    """Return the key of the equation that already gives the acceleration; otherwise an empty text."""
    roles = dict(step.roles)
    return str(roles["equation_1"].name) if "as_it_is" in roles else ""


ACCELERATION = Rule(
    "lagrange.acceleration",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4",
    outcomes={
        "generic": claims.acceleration_with_constraints,
        "unconstrained": claims.acceleration_without_constraints,
        "isolated": both(lasts, claims.isolated),
        "eliminated": both(lasts, claims.eliminated),
        "zero": vanishes,
    },
    evidence={"virtual_work": ROUTE, "constraint": CHECK},
    statements=[claims.a_second_rate, claims.follows_from_these_equations, says_what_it_divides_by],
    named={"eliminated": claims.is_in_these_equations, "fixed": claims.follows_from_a_constraint},
    shown=Shown(repeats=_repeated),
)


def _acceleration(
    symbol: Symbol, problem: _Problem, rates: Sequence[Quantity], isolation: _Isolation | None
) -> Quantity:
    found = _solution(problem)
    q = next(q for q in problem.moving if rate(q, 2) == symbol)
    coordinate = Coordinate(q, problem.lagrangian.coordinates[q])
    value = _gathered(problem, found[symbol])
    together = "generic" if problem.constraints else "unconstrained"
    return establish(
        ACCELERATION,
        symbol,
        isolation.law(value) if isolation else lambda: value,
        isolation.inputs if isolation else {},
        lines=Lines(put_in=None, arranged=lambda _: value),
        routes={
            "virtual_work": lambda value: _virtual_work(problem, {**found, rate(q, 2): value}),
            "constraint": lambda value: _keeps_holding(problem, {**found, rate(q, 2): value}),
        },
        outcome=lambda value: "zero" if value == 0 else isolation.outcome if isolation else together,
        phrase_data=PhraseData(
            formulas={
                **told_of_divisors([value] if isolation else [found[rate(p, 2)] for p in problem.solved]),
                **(isolation.formulas if isolation else {}),
                **(isolation.as_it_is(symbol, value) if isolation else {}),
            },
            points_to={"lagrangian": problem.lagrangian, **(isolation.pointed if isolation else {})},
            named=isolation.named if isolation else {},
            outcome_data=isolation.outcome_data if isolation else {},
        ),
        key=f"acceleration_{q.name}",
        kind=_kind_of_acceleration(coordinate.kind),
        parents=[*problem.used, *rates, *(isolation.earlier.values() if isolation else ())],
        facts=[OfCoordinate(coordinate)],
    )


MULTIPLIER = Rule(
    "lagrange.multiplier",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 2.4",
    outcomes={
        "generic": claims.multiplier_generic,
        "negative": claims.multiplier_negative,
        "multiplier": claims.multiplier_multiplier,
        "isolated": both(claims.multiplier_generic, claims.isolated),
        "eliminated": both(claims.multiplier_generic, claims.eliminated),
        "zero": vanishes,
    },
    evidence={"virtual_work": ROUTE},
    statements=[claims.follows_from_these_equations, says_what_it_divides_by],
    named={"eliminated": claims.is_in_these_equations, "fixed": claims.follows_from_a_constraint},
)


def _multiplier(
    each: Constraint, problem: _Problem, rates: Sequence[Quantity], isolation: _Isolation | None
) -> Quantity:
    found = _solution(problem)
    value = _gathered(problem, found[each.force])
    length = gradient_length(each, problem.lagrangian) if each.enforcer != "motor" else None  # a torque, not a force
    is_force = length is None or is_zero(length - 1)
    shown = {"length": (length, tidied(sqrt(length**2)))} if length is not None and not is_force else {}
    below = is_force and len(each.acting) == 1 and sign_known(explicit(found[each.force])) == -1
    sense = each.acts(-1) if below else ""
    return establish(
        MULTIPLIER,
        each.force,
        isolation.law(value) if isolation else lambda: value,
        isolation.inputs if isolation else {},
        lines=Lines(put_in=None, arranged=lambda _: value),
        routes={"virtual_work": lambda value: _virtual_work(problem, {**found, each.force: value})},
        outcome=lambda value: (
            "zero"
            if value == 0
            else "negative"
            if sense
            else "multiplier"
            if not is_force
            else isolation.outcome
            if isolation
            else "generic"
        ),
        phrase_data=PhraseData(
            words={"sense": sense} if sense else {},
            formulas={
                **told_of_divisors([found[each.force]]),
                **shown,
                **(isolation.formulas if isolation else {}),
            },
            points_to=isolation.pointed if isolation else {},
            named=isolation.named if isolation else {},
            outcome_data={
                **(isolation.outcome_data if isolation else {}),
                "condition": each.residual,
                "positive": each.acting[0].direction if sense else (),
                "enforcer": Str(each.enforcer),
                "gradient": each.gradient,
                "place": _places(problem) if length is not None else (),
            },
        ),
        key=each.force.name,
        kind=each.kind_of_force,
        parents=[*problem.used, *rates, *(isolation.earlier.values() if isolation else ())],
        facts=[ForceOf(each, problem)],
    )


ONE_SIDED = {  # enforcer -> what it would have to do if its force were negative, and a help line
    "surface": ("the surface would have to pull", "put the body on the other side, or describe a rail, `side: both`"),
    "string": ("the string would have to push", "describe a massless rod, which can push"),
}


def _check_one_sided(each: Constraint, value: Expr | None) -> None:
    """Reject a force that is negative in every state, because a surface cannot pull and a string cannot push."""
    if each.enforcer in ONE_SIDED and value is not None and sign_known(explicit(value)) == -1:
        why, help_line = ONE_SIDED[each.enforcer]
        message = f"the force `{each.force}` = {value} is negative in every state, so {why}"
        raise Rejected(Complaint("no-contact", message, help=help_line))


def _places(problem: _Problem) -> tuple[Expr, ...]:
    points = problem.lagrangian.needed(Matter).points
    return points[0].place if len(points) == 1 else ()


def _gathered(problem: _Problem, value: Expr) -> Expr:
    return by_accelerations(value, problem.moving) if problem.keeping else value


CONSTRAINT_FORCE = Rule(
    "lagrange.constraint_force",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, sections 1.4 and 2.4",
    outcomes={"generic": lasts, "zero": vanishes},
    evidence={"newton": ROUTE},
)


def constraint_force(
    forces: Sequence[Quantity], along: Mapping[Any, Expr], symbol: str = "N", key: str = "constraint_force"
) -> Quantity:
    """Component of constraint forces along a displacement, N = sum of lambda df/dq dq, per unit of the displacement,
    where the constraints are f = 0.

    forces   results of `multipliers` for one system
    along    coordinate -> its change per unit of the displacement: `{x: sin(theta), y: cos(theta)}`
    symbol   the symbol of the component, which is a force if the displacement is a length

    Second route: by Newton's law along the displacement, N is the sum of m a . dr over the mass points, minus the work
    of all other forces.
    Outcomes: generic, zero.
    Errors: no force is given; the forces belong to different systems; `along` names something that is not a coordinate
    of the system; a constraint force that is not among `forces` does work in this displacement.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 1.4 and 2.4.
    """
    kept = [force.needed(ForceOf) for force in forces]
    if not kept or any(each.problem.lagrangian.step != kept[0].problem.lagrangian.step for each in kept):
        raise Rejected(Complaint("different-subjects", "`constraint_force` needs one or more forces of one system"))
    problem: _Problem = kept[0].problem
    way = {q.symbol if isinstance(q, Coordinate) else q: as_expr(value) for q, value in along.items()}
    strange = [q for q in way if q not in problem.moving]
    if strange:
        message = f"`constraint_force`: this system has no coordinate {strange[0]}"
        raise Rejected(Complaint("wrong-argument", message, help=f"it has {', '.join(map(str, problem.moving))}"))
    as_given = {getattr(q, "symbol", q): value for q, value in along.items()}  # for the second route
    works = {c: tidied(Add(*(c.along(q) * dq for q, dq in way.items()))) for c in problem.constraints}
    missing = [c for c, work in works.items() if not is_zero(work) and c not in [each.constraint for each in kept]]
    if missing:
        message = f"`constraint_force`: {missing[0].force} is not given, but does work in this displacement"
        raise Rejected(Complaint("wrong-argument", message, help="give all forces from `multipliers`"))
    acting = {f"force_{i}": f for i, (f, k) in enumerate(zip(forces, kept, strict=True)) if works[k.constraint] != 0}
    factors = [works[f.needed(ForceOf).constraint] for f in acting.values()]

    def law(*names: Expr) -> Expr:
        pairs = list(zip(names, factors, strict=True))
        terms = [-Factors(f, -by) if by.could_extract_minus_sign() else Factors(f, by) for f, by in pairs]
        return Terms(*terms) if len(terms) > 1 else Add(*terms)

    return establish(
        CONSTRAINT_FORCE,
        scalar(symbol),
        law,
        acting,
        lines=Lines(put_in=None, arranged=lambda value: by_accelerations(value, problem.moving)),
        routes={"newton": compared_with(lambda: _by_newton(problem, as_given))},
        outcome=lambda value: "zero" if value == 0 else "generic",
        key=key,
        kind={"length": "force", "angle": "torque"}.get("".join({problem.lagrangian.coordinates[q] for q in way})),
        parents=list(forces),
    )


def _by_newton(problem: _Problem, way: Mapping[Symbol, Expr]) -> Expr:
    """Return the sum of m a . dr along the displacement, minus the work of all forces except the constraint forces."""
    matter = problem.lagrangian.needed(Matter)
    total = ZERO
    for q, dq in way.items():
        kept = Add(*(load.work_along(q) for load in matter.others if load.multiplier is not None))
        total += dq * (matter.inertia_along(q) - matter.force_along(q) + kept)
    if not problem.keeping:
        return problem.with_known(total.xreplace(_solution(problem)))
    known = problem.known.items()
    twice = {rate(q, 2): by_functions_of_time(v, problem.moving, 2) for q, v in known if q in problem.moving}
    return problem.with_known(total.xreplace(twice))


def _virtual_work(problem: _Problem, found: Mapping[Symbol, Expr]) -> tuple[Expr, Expr]:
    """Return the two sides of d'Alembert's principle: the virtual work of m a - F, and zero.

    The displacement of each coordinate has its own symbol, so the terms of two coordinates cannot cancel.
    """
    matter = problem.lagrangian.needed(Matter)
    marks = [stand_in(f"delta_{q.name}") for q in problem.solved]
    whole = Add(
        *(
            mark * (matter.inertia_along(q) - matter.force_along(q))
            for q, mark in zip(problem.solved, marks, strict=True)
        )
    )
    return problem.with_known(whole.xreplace(dict(found))), ZERO


def _keeps_holding(problem: _Problem, found: Mapping[Symbol, Expr]) -> tuple[Expr, Expr]:
    total = ZERO
    for i, each in enumerate(problem.constraints):
        changing = by_functions_of_time(each.residual, problem.moving, 1 if each.in_rates else 2)
        total += stand_in(f"delta_{i}") * changing
    return problem.with_known(total.xreplace(dict(found))), ZERO


def _kind_of_acceleration(kind: str) -> str | None:
    if kind == "angle":
        return "angular acceleration"
    return kind_of_dimension(dimension_of_kind(kind) / dimension_of_kind("time") ** 2)


# --- linear equations ------------------------------------------------------------------------------------------------


def _solution(problem: _Problem) -> dict[Symbol, Expr]:
    found = _solved(problem)
    kept = problem.lagrangian.fact(Constrained)
    for each in kept.constraints if kept is not None else ():
        _check_one_sided(each, found.get(each.force))
    return found


@lru_cache(maxsize=16)
def _solved(problem: _Problem) -> dict[Symbol, Expr]:
    unknowns = problem.unknowns
    rows = problem.residuals_known
    matrix = ImmutableDenseMatrix([[derivative(row, u) for u in unknowns] for row in rows])
    right = ImmutableDenseMatrix([-row.xreplace(dict.fromkeys(unknowns, ZERO)) for row in rows])
    whole, names = _in_a_field(matrix.row_join(right))
    count = len(unknowns)
    if _has_no_inverse(whole[:, :count], names):
        raise _undetermined(problem, matrix)
    try:
        solved = _solved_at_once(whole).to_Matrix()
    except DMError:
        raise _undetermined(problem, matrix) from None
    _check_short(solved, names)
    back = {dummy: f for f, dummy in names.items()}
    return {u: by_squares(value.xreplace(back)) for u, value in zip(unknowns, solved, strict=True)}


def _solved_at_once(whole: DomainMatrix) -> DomainMatrix:
    """Return the solution of linear equations, whose right sides are the last column. Fractions are cancelled only at
    the end, because their cancellation takes most of the time."""
    _, rows = whole.clear_denoms_rowwise(convert=True)
    count = whole.shape[0]
    solved, denominator = rows[:, :count].solve_den(rows[:, count:], method="charpoly")
    return solved.convert_to(whole.domain) / whole.domain.convert_from(denominator, solved.domain)


def _check_short(solved: Matrix, names: Mapping[Expr, Dummy]) -> None:
    """Reject long solutions with different roots of sums, such as the lengths of two oblique strings: SymPy needs
    minutes to simplify them."""
    roots = [f for f in names if isinstance(f, Pow) and isinstance(f.base, Add)]
    if len(roots) > 1 and max(value.count_ops() for value in solved) > MOST_WITH_ROOTS:
        message = f"the accelerations contain {roots[0]} and {roots[1]}, and have too many terms"
        help_line = "ask for `equations_of_motion`, which are short because they contain the constraint forces"
        raise Rejected(Complaint("too-hard", message, help=help_line))


def _in_a_field(matrix: ImmutableDenseMatrix) -> tuple[DomainMatrix, dict[Expr, Dummy]]:
    """Return the matrix with symbols in place of sines, cosines, roots, and prescribed functions of time and their
    rates. Also return the symbol of each replaced function."""
    found = sorted(matrix.atoms(Function, Prescribed), key=str)
    powers = sorted((p for p in matrix.atoms(Pow) if not p.exp.is_Integer), key=str)
    bases: dict[Expr, Expr] = {}  # expanded base -> the form of this base in all roots
    roots = {
        p: Pow(bases.setdefault(p.base.expand(), p.base), Rational(1, p.exp.q)) if p.exp.is_Rational else p
        for p in powers
    }
    names = {f: Dummy(f"u_{i}") for i, f in enumerate([*dict.fromkeys(roots.values()), *found])}
    of_roots = {p: names[root] ** (p.exp.p if p.exp.is_Rational else 1) for p, root in roots.items()}
    return DomainMatrix.from_Matrix(Matrix(matrix.xreplace({**names, **of_roots}))).to_field(), names


def _is_singular(matrix: ImmutableDenseMatrix) -> bool:
    return _has_no_inverse(*_in_a_field(matrix))


def _has_no_inverse(matrix: DomainMatrix, names: Mapping[Expr, Dummy]) -> bool:
    det = matrix.domain.to_sympy(matrix.det())
    return vanishes_identically(det.xreplace({dummy: f for f, dummy in names.items()}))


def _undetermined(problem: _Problem, matrix: ImmutableDenseMatrix) -> Rejected:
    count = len(problem.solved)
    held = matrix[count:, :count]
    if len(problem.constraints) and _is_singular(ImmutableDenseMatrix(held * held.T)):
        names = ", ".join(each.force.name for each in problem.constraints)
        message = f"the equations do not determine the constraint forces {names}"
        if _contradict(problem.constraints):
            message = (
                f"two of the constraints enforced by {names} contradict each other, so the forces are not determined"
            )
        return Rejected(
            Complaint("constraints", message, help="remove constraints that follow from the others or contradict them")
        )
    bare = next((q.name for i, q in enumerate(problem.solved) if not any(matrix[i, :count])), None)
    what = f"no mass moves with {bare}" if bare else "the mass matrix is singular"
    return Rejected(Complaint("no-inertia", f"the accelerations are not determined: {what}"))


def _contradict(constraints: Sequence[Constraint]) -> bool:
    """Whether two of the constraints contradict each other: one minus a multiple of the other is not zero, and contains
    no coordinates."""
    for i, one in enumerate(constraints):
        for other in constraints[:i]:
            shared = [q for q in one.coordinates if one.along(q) != 0 and other.along(q) != 0]
            if not shared or one.in_rates != other.in_rates:
                continue
            ratio = tidied(one.along(shared[0]) / other.along(shared[0]))
            apart = tidied(one.residual - ratio * other.residual)
            if apart != 0 and not coordinates_in(apart) and not coordinates_in(ratio):
                return True
    return False
