"""Limiting cases: the leading terms of a result where a symbol is small, large, or near a value."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import islice
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Integer, MatrixBase, MatrixSymbol, Mul, Rational, Symbol, oo

from derive.algebra.collect import by_terms
from derive.algebra.equality import equal
from derive.algebra.expansion import (
    Approach,
    Expansion,
    NoExpansion,
    Series,
    expanded,
    in_ascending_powers,
    tidied_terms,
)
from derive.algebra.expressions import Relation, explicit, rate
from derive.algebra.samples import letters_of, points, value_at
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.answers import claims
from derive.mechanics.answers.approximate import equation_in_limit
from derive.mechanics.in_results import Letter, Value, in_results
from derive.mechanics.motion.claims import arrives_as_told
from derive.mechanics.motion.turning_points import arrivals, common_condition, words_of
from derive.solving.leading import beginnings, entry_by_entry, rest_vanishes, terms_by_arithmetic, to_that_order
from derive.solving.relations import conditions_told
from derive.solving.unknowns import letter_of, meaning, unknown_of
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.known_numbers import with_numbers
from derive.steps.record import assumed, changes, letter_of_limit, named_coordinates
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Form, Level, Quantity, approximations_among, compared_with, is_zero
from derive.steps.subject import EVERYTHING

__all__ = ["case_in_letters", "known_case", "limiting_case"]

# Number of points to try; a number in place of infinity; a small relative step.
MANY, FAR, NEAR = 200, Integer(10) ** 40, Rational(1, 10**12)
BORDERS = {"=": "", ">=": "min", "<=": "max"}  # comparison sign -> index of the bound: x_min for x >= f


LIMITING_CASE = Rule(
    "answers.limiting_case",
    source="Morin, *Introduction to Classical Mechanics*, section 1.1 (special cases)",
    outcomes={
        "finite": claims.limiting_case_finite,
        "vanishes": claims.goes_as(1),
        "diverges": claims.goes_as(-1),
        "small": claims.near(Integer(0)),
        "large": claims.near(oo, -oo),
        "near": claims.near(),
        "exact": claims.nothing_left_out,
    },
    evidence={"arithmetic": CHECK, "numbers": CHECK},
    statements=[claims.goes_where_it_is_said, arrives_as_told],
    named={"place": claims.goes_to, "bound": claims.right_of_a_bound},
)


@in_results(
    "limit",
    "the limiting case; for an equation, its expansion, such as `{limit: motion_x, for: Omega, to: 0, order: 1}`",
    of="limit: an answer, or an equation",
    letter="for: a letter",
    to="to: a value or `infinity`, 0 by default",
    order="order",
    symbol="symbol",
)
def limiting_case(
    of: Quantity,
    letter: Letter,
    to: Value = 0,
    order: int | None = None,
    key: str | None = None,
    symbol: str | None = None,
) -> Quantity:
    """Result in a limiting case, f = c_n e^n + .... For a letter x, the small quantity e is x, 1/x, -1/x, or x - a near
    the value a.

    of       a scalar, a vector or a tensor, any unit. For an equation, or an inequality with >= or <=, that is solved
             for a letter, the limit of the right side is found. Any other equation is expanded by `equation_in_limit`
    letter   the letter that goes to the limit, or a ratio such as h/R that goes to the limit because h changes
    to       the limit: 0 for a small letter, SymPy's `oo` or `-oo` for a large letter, otherwise the value that it is
             near
    order    the highest power of the small quantity that is kept; by default only the leading term

    For a vector or a tensor, the largest entry determines the leading power: smaller entries are negligible. Use
    `put_in` to set letters equal, b = a. If terms are left out, the result has a new symbol: `symbol` or, by default, a
    symbol such as omega_lim for omega. Results computed from this symbol are approximate.
    Check: numerically, on each possible side of the limit, the omitted part is divided by the highest power that is
    kept. This quotient shrinks on the way to the limit. If the terms can also be found without a derivative, by adding,
    multiplying and dividing power series, the two results agree.
    Outcomes: finite, vanishes, diverges (only the leading term); small, large, near (to an order); exact (nothing is
    left out).
    Errors: the result does not contain the letter; the letter changes in the motion and does not go to infinity; the
    motion does not reach the limit; an assumed relation cannot hold near the limit; the result has no such expansion
    (for example because it oscillates near the limit), has different expansions on the two sides, or has no term up to
    the requested order.
    Source: Morin, *Introduction to Classical Mechanics*, section 1.1 (special cases).
    """
    solved = _solved_for(of)
    if isinstance(of.value, Relation) and solved is None:
        if symbol is not None:
            message = f"`{of.key}` is not solved for a letter with =, >= or <=, so its limit has no symbol of its own"
            raise Rejected(Complaint("wrong-argument", message))
        return equation_in_limit(of, letter, to, order, key)
    value = explicit(of.value.right if solved is not None else of.value)
    name = _name(of) if solved is None else solved
    goes, x = _what_goes(letter)
    if not isinstance(value, Expr | MatrixBase):
        raise Rejected(
            Complaint("wrong-argument", f"`limiting_case`: `{of.key}` is not a scalar, a vector or a tensor")
        )
    aim = explicit(to.value if isinstance(to, Quantity) else to)
    _check_letter(of, value, x, is_end=aim in (oo, -oo))
    far = [(x, aim)] if aim in (oo, -oo) else []
    come = arrivals(of, (), far, lambda f: _added_up(beginnings(of, f, x, aim, None), f, x, aim))
    _check_assumed(x, aim)
    place = aim if aim in (oo, -oo) else tidied(aim * x / goes)
    series = beginnings(of, value, x, place, order)
    found = _added_up(series, value, x, place)
    power = Rational(order) if order is not None else max((n for each in series for n in each), default=Rational(0))
    if order is None and power > 0 and is_zero(value - found):  # state the limit 0, not the whole result
        series, power = [{Rational(0): Integer(0)} for _ in series], Rational(0)
        found = _added_up(series, value, x, place)
    exact, is_limit = is_zero(value - found), order is None and power == 0
    again = terms_by_arithmetic(value, series, x, place, power)
    own = _own_letter(name, symbol, x, aim) if not exact else name if symbol is None else Symbol(symbol, real=True)
    return establish(
        LIMITING_CASE,
        own,
        lambda *_: entry_by_entry(lambda f: Expansion(_as_written(f, x, place), x, place, power), value),
        {"quantity": of, "letter": goes, "approach": Approach(goes, aim)},
        lines=Lines(
            law=Level.FULL,
            put_in=None,
            after=[_last_line(_energy_by_terms(found, value, of), series, x, place, exact, is_limit)],
            result=False,
            arranged=lambda _: found,
            means=_means(own, found),
        ),
        routes={
            **({} if again is None else {"arithmetic": lambda result: to_that_order(result, again, exact or is_limit)}),
            "numbers": lambda result: rest_vanishes(value, result, x, place, power),
        },
        outcome="exact" if exact else _sort_of(place) if order is not None else _as_it_goes(power),
        key=key or f"{of.key}_limit",
        kind=of.step.kind,
        phrase_data=PhraseData(
            named={
                **({"place": aim} if aim not in (oo, -oo) else {}),
                **({"bound": value} if solved is not None and of.value.operator != "=" else {}),
            },
            words=words_of(come),
            formulas=conditions_told(reached=common_condition(of, come)),
            outcome_data={"to": place, "value": value, "x": x, "arrivals": come},
        ),
        parents=approximations_among(to),
        scope=Scope(case_of=of) if exact else Scope(approximates=_whole(of, name, Approach(goes, aim))),
    )


def _own_letter(whole: Any, symbol: str | None, x: Symbol, aim: Expr) -> Any:
    """Return the symbol of a limit; reject the symbol of the result whose limit is taken."""
    if symbol is None:
        return letter_of_limit(whole, x, aim)
    if symbol == str(whole):
        message = f"`limiting_case`: {symbol} is the letter of the result itself, so the limit needs a different letter"
        raise Rejected(Complaint("letter-clash", message, help="give a different `symbol`, or none"))
    return Symbol(symbol, real=True)


def _whole(of: Quantity, name: Any, approach: Approach) -> Any:
    """Return the symbol of the result whose limit is taken. If this result is a series for the same limit, return the
    symbol of the result that was expanded into the series."""
    is_series = of.step.approximates is not None and dict(of.step.roles).get("approach") == approach
    return of.step.approximates if is_series else name


def _solved_for(of: Quantity) -> Symbol | None:
    """Return x for an equation x = f without x in f, x_min for x >= f, and x_max for x <= f; otherwise None."""
    if not isinstance(of.value, Relation) or of.value.operator not in BORDERS:
        return None
    left, right = of.value.sides
    if not isinstance(left, Symbol) or left in explicit(right).free_symbols:
        return None
    border = BORDERS[of.value.operator]
    return Symbol(f"{left.name}_{border}", real=True) if border else left


def _what_goes(letter: Any) -> tuple[Expr, Symbol]:
    """Return the expression whose limit the page states, such as h/R, and the symbol that goes to the limit, here h."""
    if isinstance(letter, Mul):
        above = [part for part in Mul.make_args(letter.as_numer_denom()[0]) if isinstance(part, Symbol)]
        if above and above[0] not in (letter / above[0]).free_symbols:
            return letter, above[0]
    x = letter_of(unknown_of("limiting_case", letter))
    return x, x


def _check_letter(of: Quantity, value: Any, x: Symbol, is_end: bool) -> None:
    """Check that the result contains the symbol, and that the symbol is constant or goes to infinity."""
    if x not in value.free_symbols:
        message = f"`limiting_case`: `{of.key}` does not contain {x.name}"
        raise Rejected(Complaint("nothing-to-put-in", message))
    if not is_end and changes(x, {**of.coordinates, **dict.fromkeys(named_coordinates(), "")}) is not None:
        message = f"`limiting_case`: {x.name} changes in the motion, so it does not stay near one value"
        raise Rejected(Complaint("changes", message, help="give a letter that is constant"))


def _check_assumed(x: Symbol, aim: Expr) -> None:
    """Check that all assumed inequalities that contain this symbol can hold near the limit, for some values of the
    other symbols."""
    signs = {">": 1, "<": -1}
    kept = [with_numbers(each.residual * signs[each.operator[0]]) for each in assumed() if each.operator[0] in signs]
    conditions = [each for each in kept if x in each.free_symbols]
    letters = set().union(letters_of(aim) if aim not in (oo, -oo) else (), *map(letters_of, conditions)) - {x}
    for point in islice(points(letters, 0), MANY) if conditions else ():
        for near in _close_to(aim, point):
            if all(value_at(each, {**point, x: near}) > 0 for each in conditions):
                return
    if conditions:
        message = f"`limiting_case`: where {x.name} goes to {aim}, not all assumptions hold"
        help_line = Spelled(
            f"require no relation that contains {x.name}, or give a different limit",
            f"leave a relation that contains {x.name} out of `assume:`, or give a different limit",
        )
        raise Rejected(Complaint("contradiction", message, help=help_line))


def _close_to(aim: Expr, point: Mapping[Any, Any]) -> tuple[Expr, ...]:
    """Return numbers close to the limit: for an infinite limit, a number of very large absolute value; otherwise, one
    number on each side."""
    if aim in (oo, -oo):
        return (FAR if aim == oo else -FAR,)
    there = explicit(aim).xreplace(dict(point))
    little = 1 / FAR if there == 0 else there * NEAR
    return (there + little, there - little)


def _added_up(series: Sequence[Series], value: Any, x: Symbol, place: Expr) -> Any:
    added = [tidied_terms(each, x, place) for each in series]
    return ImmutableDenseMatrix(*value.shape, added) if isinstance(value, MatrixBase) else added[0]


def _last_line(found: Any, series: Sequence[Series], x: Symbol, place: Expr, exact: bool, is_limit: bool) -> Form:
    if exact:
        return Form(found, "result")
    if is_limit:
        return Form(found, "limit")
    return Form(found if isinstance(found, MatrixBase) else in_ascending_powers(series[0], x, place), "series")


def _energy_by_terms(found: Any, value: Any, of: Quantity) -> Any:
    """Write the limit of an energy as a sum of terms, like the energy itself: m l^2 theta_dot^2/2 - m g l cos(theta).
    A sum is treated as an energy if its limit contains the square of a rate."""
    if isinstance(found, Expr) and value.is_Add and any(found.has(rate(q) ** 2) for q in of.coordinates):
        return by_terms(found.expand())
    return found


def _as_written(value: Expr, x: Symbol, place: Expr) -> Expr:
    """Write a product that is a polynomial in x in ascending powers, with the leading term as a factor: 2 pi sqrt(l/g)
    (1 + A^2/16). Return any other value unchanged.
    """
    if place != 0 or x not in value.free_symbols or value.is_Add or not value.is_polynomial(x):
        return value
    try:
        return in_ascending_powers(expanded(value, x, place, Rational(value.as_poly(x).degree())), x, place)
    except NoExpansion:
        return value


def _as_it_goes(power: Rational) -> str:
    return "finite" if power == 0 else "vanishes" if power > 0 else "diverges"


def _sort_of(place: Expr) -> str:
    if place == 0:
        return "small"
    return "large" if place in (oo, -oo) else "near"


def _name(of: Quantity) -> Any:
    if isinstance(of.symbol, Symbol | MatrixSymbol | MatrixBase):
        return of.symbol
    return unknown_of("limiting_case", of.symbol)


def _means(name: Any, found: Any) -> dict[Any, Any]:
    return {} if isinstance(name, Symbol | MatrixSymbol | MatrixBase) else dict(meaning(name, found))


KNOWN_CASE = Rule(
    "answers.known_case",
    source="Morin, *Introduction to Classical Mechanics*, section 1.1 (special cases)",
    evidence={"known": ROUTE},
)


def known_case(found: Quantity, known: Quantity, key: str = "known_case") -> Quantity:
    """Agreement of a limiting case with a known result, f = g.

    found   the result in a limiting or a special case, any unit
    known   the same quantity from an independent derivation

    Second route: the known result, entry by entry.
    Outcomes: generic.
    Errors: the two results are not equal; one of them is derived from the other.
    Source: Morin, *Introduction to Classical Mechanics*, section 1.1 (special cases).
    """
    values = [explicit(q.value.right if _solved_for(q) is not None else q.value) for q in (found, known)]
    if found.rests_on(known) or known.rests_on(found):
        first, other = (found, known) if found.rests_on(known) else (known, found)
        message = f"`{first.key}` is derived from `{other.key}`, so their agreement would prove nothing"
        raise Rejected(Complaint("same-source", message))
    if not equal(*values):
        raise Rejected(Complaint("wrong-limit", f"`{found.key}` is {values[0]}, but `{known.key}` is {values[1]}"))
    return establish(
        KNOWN_CASE,
        found.symbol,
        lambda *_: values[0],
        {},
        routes={"known": compared_with(lambda: values[1])},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        parents=[found, known],
        key=key,
        kind=found.step.kind,
        scope=Scope(case_of=found),
    )


CASE_IN_LETTERS = Rule(
    "answers.case_in_letters",
    source="none needed: substitution",
    evidence={"at_once": CHECK},
)


def case_in_letters(
    found: Quantity, formula: Expr, values: Sequence[Quantity], key: str = "case_in_letters"
) -> Quantity:
    """Limiting case written with the letters of earlier results: 3 g/(2 a S) is M g l/(I_z S).

    found    the result in a limiting or a special case, any unit
    formula  the same result in letters
    values   the results of earlier steps that these letters denote

    Check: the formula with all letters replaced at once equals the limiting case.
    Outcomes: generic.
    Errors: the formula and the limiting case are not equal.
    Source: none needed: substitution.
    """
    value = explicit(found.value.right if _solved_for(found) is not None else found.value)
    return establish(
        CASE_IN_LETTERS,
        found.symbol,
        lambda *_: formula,
        {},
        routes={"at_once": compared_with(lambda: value)},
        lines=Lines(put_in=None, after=[Form(value, "result", Level.FULL)], result=False, arranged=explicit),
        parents=[*values, found],
        key=key,
        kind=found.step.kind,
        scope=Scope(differ=EVERYTHING, case_of=found),
    )
