"""The shape of a potential energy: slope, curvature, and the kind of extremum where the slope vanishes."""

from __future__ import annotations

from sympy import Add, Dummy, Expr, Integer, Pow, Symbol, factorial

from derive.algebra.collect import spread_or_by_terms
from derive.algebra.derivatives import derivative
from derive.algebra.expressions import At, Relation, Slope, Terms, Truncated, explicit, stand_in
from derive.algebra.ranges import strict_sign_within
from derive.algebra.taylor import coefficient_along
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import Coordinate, only_coordinate
from derive.mechanics.rest import claims
from derive.mechanics.rest.facts import Shape
from derive.solving.presentation import presented
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.level import Manner
from derive.steps.numeric import Extreme
from derive.steps.record import require_constant
from derive.steps.rule import CHECK, Rule, Shown
from derive.steps.step import Form, Level, Quantity, compared_with, is_zero

__all__ = ["extreme_value", "leading_order", "slope"]

HIGHEST = 8  # the highest order of the derivatives that are tried


SLOPE = Rule(
    "rest.slope",
    source="Taylor, *Classical Mechanics*, section 4.6",
    outcomes={"slope": claims.order_of(1), "curvature": claims.order_of(2), "higher": claims.order_of(2, more=True)},
    evidence={"expanded": CHECK},
    statements=[claims.is_its_derivative],
    shown=Shown(brief=Manner.LEFT_OUT, told_along=frozenset({"generic", "curvature"})),
)


def slope(potential: Quantity, order: int = 1, key: str | None = None, by: Symbol | None = None) -> Quantity:
    """Derivative of a potential energy with respect to its coordinate, U' = dU/dq or U'' = d^2U/dq^2.

    potential   a potential energy, J
    order       the order n of the derivative: 1, 2, ...
    by          the coordinate; needed if the potential energy depends on several

    Check: U(q + u) is expanded about an arbitrary point q; the derivative is n! times the coefficient of u^n.
    Outcomes: slope, curvature, higher.
    Errors: `by` is missing, and the potential energy depends on several coordinates or on none.
    Source: Taylor, *Classical Mechanics*, section 4.6.
    """
    q = by or only_coordinate(potential)
    named = {1: "slope", 2: "curvature"}.get(order, f"derivative_{order}")
    return establish(
        SLOPE,
        Slope(potential.symbol, q, Integer(order)),
        lambda energy: Slope(energy, q, Integer(order)),
        {"potential": potential},
        lines=Lines(
            put_in=Level.FULL,
            law=Level.FULL,
            arranged=lambda value: spread_or_by_terms(value, _of_each_term(potential.value, q, order)),
        ),
        routes={"expanded": compared_with(lambda: _coefficient(potential.value, q, q, order) * factorial(order))},
        outcome=named if order < 3 else "higher",
        key=key or f"{potential.key}_{named}",
    )


def _of_each_term(value: Expr, q: Symbol, order: int) -> Expr:
    return Add(*(tidied(derivative(term, q, order)) for term in Add.make_args(value)))


def _coefficient(value: Expr, q: Symbol, place: Expr, order: int) -> Expr:
    return coefficient_along(explicit(value), {q: place}, {q: Integer(1)}, order)


def _check_lasts(verb: str, potential: Quantity, q: Symbol) -> None:
    """Reject a potential that changes with time: its shape does not determine equilibria."""
    require_constant(
        verb,
        "potential energy at each value of its coordinate",
        potential.value.xreplace({q: Dummy("q", real=True)}),
    )


def _check_level(value: Expr, q: Symbol, place: Expr, potential: Quantity) -> None:
    if tidied(derivative(value, q).xreplace({q: place})) != 0:
        message = f"`{potential.key}` is not stationary at {q.name} = {place}"
        raise Rejected(Complaint("no-equilibrium", message))


EXTREME_VALUE = Rule(
    "rest.extreme_value",
    source="Taylor, *Classical Mechanics*, section 4.6",
    outcomes={
        "minimum": claims.bent(1),
        "maximum": claims.bent(-1),
        "level": claims.bent(0),
        "conditional": claims.bent(None),
    },
    evidence={"expanded": CHECK},
    named={"place": claims.extreme_there},
)


def extreme_value(
    potential: Quantity, by: Coordinate | Symbol | None = None, at: Expr | None = None, key: str = "extreme_value"
) -> Quantity:
    """Value U(q_0) of a potential energy where its slope vanishes; U''(q_0) decides between minimum and maximum.

    potential   a function of one coordinate, J
    by          the coordinate; by default the only coordinate on which the potential energy depends
    at          the value q_0 of the coordinate; 0 by default

    Check: the term of order zero in the expansion of U about q_0.
    Outcomes: minimum, maximum, level (U'' vanishes too), conditional (the sign of U'' is unknown).
    Errors: U' does not vanish at q_0; the potential energy depends on the time.
    Source: Taylor, *Classical Mechanics*, section 4.6.
    """
    q = by.symbol if isinstance(by, Coordinate) else by or only_coordinate(potential)
    place = explicit(at) if at is not None else Integer(0)
    value = explicit(potential.value)
    _check_lasts("extreme_value", potential, q)
    _check_level(value, q, place, potential)
    curvature = tidied(derivative(value, q, 2).xreplace({q: place}))
    sort = {1: "minimum", -1: "maximum", None: "conditional"}
    return establish(
        EXTREME_VALUE,
        At(potential.symbol, q, place),
        lambda energy: At(energy, q, place),
        {"potential": potential},
        lines=Lines(put_in=None, law=Level.FULL, arranged=presented),
        routes={"expanded": compared_with(lambda: _coefficient(value, q, place, 0))},
        outcome="level" if curvature == 0 else sort[strict_sign_within(curvature)],
        phrase_data=PhraseData(
            outcome_data={"coordinate": q, "at": place},
            named={"place": Relation(q, "=", place)},
        ),
        key=key,
        kind=potential.step.kind,
        facts=[Extreme(curvature)],
        scope=Scope(case_of=potential),
    )


LEADING_ORDER = Rule(
    "rest.leading_order",
    source="Arnold, *Mathematical Methods of Classical Mechanics*, section 22",
    outcomes={
        **{
            shape: claims.shaped(shape, at_bound=False)
            for shape in ("minimum", "maximum", "inflection", "conditional", "flat")
        },
        **{
            f"{shape}_at_bound": claims.shaped(shape, at_bound=True)
            for shape in ("minimum", "maximum", "inflection", "conditional", "flat")
        },
    },
    evidence={"derivatives": CHECK, "lowest": CHECK},
    named={"case": claims.flat_in_that_case},
)


def leading_order(
    of: Quantity, where: Relation | None = None, at: Expr | None = None, key: str = "leading_order"
) -> Quantity:
    """Potential energy near an equilibrium to the lowest order that decides, U = U(q_0) + c_n (q - q_0)^n.

    of         a potential energy of one coordinate, J; or the curvature at an equilibrium, as `stability` yields it,
               which determines q_0 and the boundary
    where      an equation, symbol = value, for which the curvature of this potential energy vanishes at q_0
    at         the value q_0 of the coordinate; 0 by default

    Check: among the first n derivatives of U at q_0, only the n-th does not vanish.
    Outcomes: minimum, maximum, inflection, conditional, flat (no order up to the eighth decides), and for a symbol
    with its value on the boundary: minimum_at_bound, maximum_at_bound, inflection_at_bound, conditional_at_bound,
    flat_at_bound.
    Errors: U' does not vanish at q_0; the curvature does not vanish for the value in `where`; the potential energy
    depends on the time.
    Source: Arnold, *Mathematical Methods of Classical Mechanics*, section 22.
    """
    shape = of.fact(Shape)
    if shape is not None:
        potential, q, place, where = shape.potential, shape.coordinate, shape.place, shape.border
    else:
        potential, q, place = of, only_coordinate(of), at if at is not None else Integer(0)
    _check_lasts("leading_order", potential, q)

    def in_case(energy: Expr) -> Expr:
        return At(energy, where.left, where.right) if where else energy

    value = explicit(in_case(potential.value))
    _check_level(value, q, place, potential)
    _check_border(value, q, place, potential, where)
    order, leading = _first_that_decides(value, q, place)
    constant = tidied(value.xreplace({q: place}))
    truncated = Terms(constant, leading * Pow(q - place, order))

    def by_derivatives(found: Expr) -> tuple[Expr, Expr]:
        """Add the derivatives, each with its own factor, so that they cannot cancel each other."""
        orders = range(1, (order or HIGHEST) + 1)
        marks = {n: stand_in(f"u_{n}") for n in orders}
        expected = leading * factorial(order) * marks[order] if order else Integer(0)
        return Add(*(derivative(found, q, n).xreplace({q: place}) * marks[n] for n in orders)), expected

    def lowest(found: Expr) -> tuple[Expr, Expr]:
        orders = (n for n in range(1, HIGHEST + 1) if tidied(derivative(found, q, n).xreplace({q: place})) != 0)
        return Integer(order), Integer(next(orders, 0))

    return establish(
        LEADING_ORDER,
        in_case(potential.symbol),
        lambda energy, *_: in_case(energy),
        {"potential": potential},
        phrase_data=PhraseData(
            named={"case": where} if where else {},
            outcome_data={"coordinate": q, "place": place},
        ),
        lines=Lines(
            put_in=None,
            law=Level.FULL,
            after=[Form(Truncated(truncated, q, place, Integer(order)), "series")] if order else [],
            arranged=spread_or_by_terms,
        ),
        routes={"derivatives": by_derivatives, "lowest": lowest},
        outcome=_shape(order, leading, at_bound=where is not None),
        key=key,
        kind=potential.step.kind,
        parents=[of] if shape is not None else [],
        scope=Scope(case_of=potential),
    )


def _check_border(value: Expr, q: Symbol, place: Expr, potential: Quantity, where: Relation | None) -> None:
    """Check that the curvature of this potential vanishes on the boundary."""
    if where is not None and not is_zero(derivative(value, q, 2).xreplace({q: place})):
        message = f"the curvature of `{potential.key}` does not vanish at {where}, so this value is not a boundary"
        help_line = "omit `where`, or give the symbol with its value on the boundary"
        raise Rejected(Complaint("wrong-border", message, help=help_line))


def _first_that_decides(value: Expr, q: Symbol, place: Expr) -> tuple[int, Expr]:
    """Return the lowest order from 2 to 8 with a nonzero coefficient, and this coefficient; (0, 0) if all vanish."""
    for n in range(2, HIGHEST + 1):
        coefficient = tidied(_coefficient(value, q, place, n))
        if coefficient != 0:
            return n, coefficient
    return 0, Integer(0)


def _shape(order: int, leading: Expr, at_bound: bool) -> str:
    even = {1: "minimum", -1: "maximum"}.get(strict_sign_within(leading) or 0, "conditional")
    shape = "flat" if order == 0 else "inflection" if order % 2 else even
    return f"{shape}_at_bound" if at_bound else shape
