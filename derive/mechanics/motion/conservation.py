"""The rate of change of a quantity by the equations of motion, and whether the quantity is conserved.
As in a textbook, each equation is multiplied by a factor, and the products are added. If the quantity Q is conserved,
the sum is the rate of change of Q, up to a constant number. The factors follow from the highest rates in the equations,
usually accelerations. The rate dQ/dt is linear in the highest rates, and the sum of the products must have the same
coefficients, up to the same number.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Matrix, Symbol, diff, gcd_list

from derive.algebra.collect import by_products
from derive.algebra.expressions import Factors, Relation, Terms, TimeRate, bound, explicit, rate
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import by_functions_of_time, kind_of_rate, require_all_times
from derive.mechanics.motion import claims
from derive.mechanics.motion.trajectory import followed
from derive.mechanics.rotation.facts import RateByParticles
from derive.mechanics.rotation.vectors import Acting
from derive.solving.highest_rates import _equation, highest_rates
from derive.steps.claims import as_told, lasts, vanishes
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.level import Manner
from derive.steps.rule import CHECK, ROUTE, Rule, Shown
from derive.steps.step import Form, Level, Quantity, compared_with

__all__ = ["rate_under"]


RATE_UNDER = Rule(
    "motion.rate_under",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 2.7",
    outcomes={"conserved": vanishes, "changes": lasts},
    evidence={"any_axes": ROUTE, "followed": CHECK, "functions_of_time": ROUTE, "sum": CHECK, "matter": ROUTE},
)


def rate_under(quantity: Quantity, equations: Sequence[Quantity], key: str | None = None) -> Quantity:
    """Rate of change dQ/dt of a quantity along every motion that obeys the equations.

    quantity    a scalar Q in coordinates and their rates; the unit of the result is the unit of Q per second
    equations   equations of motion that are linear in the highest rates, one for each highest rate

    For each equation whose factor is not zero, a step derives the product of the equation and the factor. If there are
    several products, another step adds them.
    Second route: differentiate Q as a function of time and substitute the highest rates from the equations. If Q
    belongs to a rotating body, also sum the contributions of the particles of the body, and derive dQ/dt from the
    torque along arbitrary body axes. Checks: subtract the sum of the products from dQ/dt without substituting the
    highest rates, and integrate one motion numerically.
    Outcomes: conserved (the rate is zero), changes.
    Errors: the equations do not determine the highest rates; dQ/dt contains rates of higher order than the equations.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 2.7.
    """
    require_all_times("rate_under", quantity)
    moving = _moving([quantity, *equations])
    motion = highest_rates(equations, moving)
    own_rate = explicit(TimeRate(quantity.value, *moving))
    common, factors = _multipliers(own_rate, equations, list(motion))
    of_body = quantity.fact(RateByParticles)
    acting = next((torque for equation in equations if (torque := equation.fact(Acting))), None)
    needed = [(equation, factor) for equation, factor in zip(equations, factors, strict=True) if factor != 0]
    products = [_product(quantity, equation, factor, motion, len(needed)) for equation, factor in needed]
    known = [_sum(quantity, products, needed, motion)] if len(products) > 1 else products

    in_time = by_functions_of_time(quantity.value, moving)
    taken_off = common * Add(*(_equation(equation).residual for equation in known))  # zero along the motion

    return establish(
        RATE_UNDER,
        TimeRate(quantity.symbol, *moving),
        lambda q: TimeRate(q, *moving),
        {"quantity": quantity},
        lines=Lines(
            between=[Form(tidied(own_rate.expand()), "chain_rule", Level.BRIEF)], put_in=Level.FULL, motion=motion
        ),
        routes={
            "functions_of_time": compared_with(lambda: bound(in_time, motion)),
            "sum": compared_with(lambda: in_time - taken_off),
            **({"matter": lambda value: (value + taken_off, of_body.rate())} if of_body else {}),
            **({"any_axes": lambda value: (value, of_body.in_any_axes(acting.torque))} if of_body and acting else {}),
            "followed": lambda value: followed(quantity.value, value, motion),
        },
        outcome=lambda value: "conserved" if value == 0 else "changes",
        parents=known,
        key=key or f"{quantity.key}_rate",
        kind=kind_of_rate(quantity.step.kind) if quantity.step.kind else None,
    )


def _moving(quantities: Sequence[Quantity]) -> list[Symbol]:
    return list(dict.fromkeys(q for quantity in quantities for q in quantity.coordinates))


def _multipliers(own_rate: Expr, equations: Sequence[Quantity], unknown: Sequence[Symbol]) -> tuple[Expr, list[Expr]]:
    """Return a common number, and one factor for each equation.
    The sum of the equations, each times the number and its factor, has the same terms with highest rates as dQ/dt. The
    page omits the number.
    """
    matrix = Matrix([[diff(_equation(equation).residual, a) for a in unknown] for equation in equations])
    wanted = Matrix([diff(own_rate, a) for a in unknown])
    if wanted.has(*unknown) or own_rate.has(*(rate(a) for a in unknown)):
        raise Rejected(Complaint("wrong-argument", "the rate of the quantity contains higher rates than the equations"))
    factors = [tidied(factor) for factor in matrix.T.LUsolve(wanted)]
    common = gcd_list([factor.as_coeff_Mul()[0] for factor in factors if factor != 0] or [Integer(1)])
    return common, [factor / common for factor in factors]


PRODUCT = Rule(
    "motion.product",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 2.7",
    outcomes={"alone": claims.product_alone, "one_of_several": claims.product_one_of_several},
    evidence={"motion": CHECK, "divided": CHECK},
    shown=Shown(brief=Manner.LEFT_OUT, standard=Manner.LEFT_OUT),
)


def _product(
    quantity: Quantity, equation: Quantity, factor: Expr, motion: Mapping[Symbol, Expr], of_many: int
) -> Quantity:
    """Equation of motion times a factor, expanded.

    Outcomes: alone, one_of_several (products that are added).
    """
    written = equation.value
    return establish(
        PRODUCT,
        None,
        lambda f, _: Relation(Factors(f, written.left), "=", _times(f, written.right)),
        {"factor": factor, "quantity": quantity},
        lines=Lines(
            arranged=lambda value: _by_sides(value, _moving([quantity, equation])), law=Level.FULL, put_in=None
        ),
        routes={
            "motion": lambda value: _sides(value, motion),
            "divided": lambda value: _divided(value, factor, written, motion),
        },
        outcome="alone" if of_many == 1 else "one_of_several",
        phrase_data=PhraseData(outcome_data={"written": written, "of_many": Integer(of_many)}),
        parents=[equation],
        key=f"{quantity.key}_{equation.key}",
    )


def _divided(found: Relation, factor: Expr, written: Relation, motion: Mapping[Symbol, Expr]) -> tuple[Any, Any]:
    """Divide both sides by the factor and compare them with the equation: first the coefficients of the highest rates,
    then the other terms."""

    def parts(relation: Relation, divisor: Expr) -> list[Expr]:
        at_rest = dict.fromkeys(motion, Integer(0))
        sides = [explicit(side) for side in relation.sides]
        return [x / divisor for side in sides for x in (*(diff(side, a) for a in motion), bound(side, at_rest))]

    mark = {"=": Integer(1)}.get(found.operator, Integer(0))
    return ImmutableDenseMatrix([*parts(found, factor), mark]), ImmutableDenseMatrix([*parts(written, Integer(1)), 1])


def _one_by_one(found: Relation, products: Sequence[Quantity]) -> tuple[Any, Any]:
    """Subtract the sides of all products from the sum, one after another, to compare the difference with zero."""
    left = [explicit(side) for side in found.sides]
    for product in products:
        left = [side - explicit(other) for side, other in zip(left, product.value.sides, strict=True)]
    mark = {"=": Integer(0)}.get(found.operator, Integer(1))
    return ImmutableDenseMatrix([*left, mark]), ImmutableDenseMatrix([0, 0, 0])


def _times(factor: Expr, side: Expr) -> Expr:
    return Integer(0) if side == 0 else Factors(factor, side)


SUM = Rule(
    "motion.sum",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 2.7",
    outcomes={word: claims.sum_left(word) for word in ("plain", "cancel", "remain")},
    evidence={"motion": CHECK, "one_by_one": CHECK},
    statements=[claims.sum_of_the_equations_times_their_factors],
    named={"factor": as_told(claims.sum_of_the_equations_times_their_factors)},
    shown=Shown(each_worked_out=True),
)


def _sum(
    quantity: Quantity,
    products: Sequence[Quantity],
    of: Sequence[tuple[Quantity, Expr]],
    motion: Mapping[Symbol, Expr],
) -> Quantity:
    """Sum of the products, with like terms collected.

    Outcomes: plain (every term contains a highest rate), cancel (the other terms cancel), remain (some other terms
    remain).
    """
    sides = [[product.value.sides[i] for product in products] for i in (0, 1)]
    moving = _moving([quantity, *products])
    return establish(
        SUM,
        None,
        lambda: Relation(Terms(*_added(sides[0])), "=", Terms(*_added(sides[1]))),
        {},
        lines=Lines(
            between=_gathered(of, moving, list(motion)) if not any(sides[1]) else [],
            arranged=lambda value: _by_sides(value, moving),
            law=Level.FULL,
            put_in=None,
        ),
        routes={
            "motion": lambda value: _sides(value, motion),
            "one_by_one": lambda value: _one_by_one(value, products),
        },
        outcome=_left_over(sides[0], list(motion)),
        phrase_data=PhraseData(
            named={f"factor_{i}": factor for i, (_, factor) in enumerate(of, 1)},
            points_to={f"equation_{i}": equation for i, (equation, _) in enumerate(of, 1)},
            outcome_data={"highest": list(motion), "products": sides[0]},
        ),
        parents=[*(equation for equation, _ in of), *products],
        key=f"{quantity.key}_sum",
    )


def _gathered(of: Sequence[tuple[Quantity, Expr]], moving: Sequence[Symbol], highest: Sequence[Symbol]) -> list[Form]:
    """Return the line "terms with highest rates = (c_1 + c_2 + ...) P" if all other terms are multiples of one
    product P. Otherwise return an empty list."""
    with_rates, rest = [], []
    for equation, factor in of:
        number, moved = factor.as_independent(*moving, as_Add=False)
        for term in Add.make_args(equation.value.left):
            if term.has(*highest):
                with_rates.append(factor * term)
                continue
            own, product = term.as_independent(*moving, as_Add=False)
            rest.append((-own if number == 1 else Factors(number, -own), moved * product))
    if len({product for _, product in rest}) != 1:
        return []
    right = Factors(Terms(*(coefficient for coefficient, _ in rest)), rest[0][1])
    return [Form(Relation(by_products(Add(*with_rates), moving), "=", right), "gathered", Level.STANDARD)]


def _added(sides: Sequence[Expr]) -> list[Expr]:
    return [term for side in sides for term in side.as_ordered_terms() if term != 0] or [Integer(0)]


def _left_over(sides: Sequence[Expr], unknown: Sequence[Symbol]) -> str:
    without = [bound(side, dict.fromkeys(unknown, Integer(0))).expand() for side in sides]
    if all(rest == 0 for rest in without):
        return "plain"
    return "cancel" if Add(*without).expand() == 0 else "remain"


def _sides(value: Relation, motion: Mapping[Symbol, Expr]) -> tuple[Expr, Expr]:
    left, right = (bound(explicit(side), motion) for side in value.sides)
    return left, right


def _by_sides(value: Relation, moving: Sequence[Symbol]) -> Relation:
    """Expand and collect both sides, with the terms that contain rates first."""
    left, right = (by_products(explicit(side), moving) for side in value.sides)
    return Relation(left, value.operator, right)
