"""The last step of an answer: numbers are substituted, and the value is rounded once, with its unit."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sympy import (
    Add,
    Dummy,
    Expr,
    ImmutableDenseMatrix,
    Integer,
    MatrixBase,
    Mul,
    Rational,
    Symbol,
    Tuple,
    cos,
    lambdify,
    pi,
    preorder_traversal,
    sign,
    sin,
    tan,
)

from derive.algebra.expressions import (
    IN_DEGREES,
    Amount,
    Factors,
    MatrixAmount,
    Ratio,
    Relation,
    Root,
    bound,
    explicit,
    scaled,
)
from derive.algebra.normal_form import vanishes
from derive.algebra.period_series import SwingTime, SwingTimeOfNumbers
from derive.algebra.rounding import rounded_form
from derive.algebra.samples import value_at
from derive.algebra.tidy import factored_matrix, tidied
from derive.errors import Complaint, Rejected
from derive.steps.claims import (
    as_told,
    bends,
    given_as_the_condition_has_it,
    numbers_fulfil,
    of_numbers,
    value_integrated,
)
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.natural import NATURAL
from derive.steps.rule import CHECK, Rule
from derive.steps.step import Fact, Form, Level, Quantity

DIGITS = 20  # digits of the values that a check compares; `_error` allows the last five to differ
HALF = Rational(1, 2)
# operator of a relation -> the signs >, = or < between its two numbers for which the relation is true
FULFILLED = {">": ">", ">=": ">=", "<": "<", "<=": "<=", "=": "="}
SHORT = 9  # with more numbers than this, only the level `full` shows the formula with the numbers substituted


@dataclass(frozen=True)
class Extreme(Fact):
    """The second derivative of a function where its slope vanishes; its sign distinguishes a minimum from a maximum."""

    missing = "is not the value of a function where its slope vanishes"
    curvature: Expr


@dataclass(frozen=True)
class WholeSwing(Fact):
    """The exact period that a series approximates: `factor` times the integral `time`."""

    missing = "is not a series for a period"
    factor: Expr
    time: SwingTime


VALUE = Rule(
    "numeric.value",
    source="Bureau International des Poids et Mesures, *The International System of Units*, section 5.4",
    outcomes={
        "exact": of_numbers("exact"),
        "measured": of_numbers("measured"),
        "integrated": value_integrated,
        "minimum": bends(1),
        "maximum": bends(-1),
    },
    evidence={"floats": CHECK},
    statements=[given_as_the_condition_has_it],
    named={"given": as_told(given_as_the_condition_has_it)},
)


def value_of(
    answer: Quantity,
    amounts: Mapping[Symbol, Amount],
    unit: str,
    factor: Expr,
    figures: int,
    key: str | None = None,
    more: Sequence[tuple[str, Expr]] = (),
    case: str = "",
) -> Quantity | None:
    """The value of an answer in a unit, rounded to significant figures.

    Return None if symbols remain in the value, if it is not real, or if it needs no rounding: it is zero, or consists
    of whole numbers. Return None also for a relation whose left side is not a single symbol.

    answer    any quantity; in a relation with a single symbol on its left side, the right side gets the number
    amounts   symbol -> its number with a unit
    unit      the name of the unit
    factor    the value of this unit in SI units
    more      other units for the same value, each with its factor
    case      the name of the case with these numbers, if there are several cases

    Check: the expression, evaluated again from the numbers of its symbols, with extra digits against cancellation.
    For a condition on a symbol with a given number, the step states whether this number satisfies the condition. A
    period that is known as a series gets its number from the integral that the series approximates.
    Outcomes: measured (numbers were substituted), exact; integrated, for a period whose number is an integral; minimum
    or maximum, for the value of a function at zero slope.
    Source: Bureau International des Poids et Mesures, *The International System of Units*, section 5.4.
    """
    value, within = _valued(answer.value)
    letters = _free(value)
    if not letters <= set(amounts) or value == 0:
        return None
    if not letters and all(entry.is_Integer for entry in _entries(value)):
        return None
    whole = answer.fact(WholeSwing)
    if whole is not None and _free(whole.time) - {*whole.time.variables} <= set(amounts):
        return _period_of(answer, amounts, unit, factor, figures, key, more, case)
    _check_series(answer, amounts, figures)
    turning = _only_turning(value)
    numbers = {letter: amounts[letter] if letter in turning else in_radians(amounts[letter]) for letter in letters}
    if isinstance(value, MatrixBase):
        common, rest = factored_matrix(value)
        substituted = bound(rest, numbers) if common == 1 else scaled(bound(common, numbers), bound(rest, numbers))
    else:
        substituted = bound(_under_one_root(value), numbers)
    exact = explicit(substituted)
    if any(entry.is_real is False for entry in _entries(exact)):
        return None

    def floats(result: Any) -> tuple[Any, Any]:
        if isinstance(answer.value, Relation):  # the number must change neither the left side nor the relation sign
            asked, found = (getattr(each, "args", ())[:2] for each in (answer.value, result))
            if asked != found:
                return Integer(1), Integer(0)
        return _by_floats(value, letters, amounts, _valued(explicit(result))[0])

    units = ((unit, factor), *more)
    shown = [_with_unit(exact, *each, figures) for each in units]
    given = _given_beside(answer, amounts, units[-1], figures)
    return establish(
        VALUE,
        answer.symbol,
        lambda: within(substituted),
        {},
        routes={"floats": floats},
        outcome=_outcome(_bent(answer, amounts).get("curvature"), bool(letters)),
        phrase_data=PhraseData(
            words={**({"case": case} if case else {}), **given.words},
            named=given.named,
            outcome_data={"letters": letters, **_bent(answer, amounts), **given.outcome_data},
        ),
        scope=Scope(about=answer.subject, case_of=answer),
        key=key or f"{answer.key}_value",
        kind=answer.step.kind,
        lines=Lines(
            put_in=None,
            result=False,
            law=Level.BRIEF if _amounts_in(substituted) <= SHORT else Level.FULL,
            after=[Form(within(each), "value" if explicit(each) == exact else "rounded") for each in shown],
            arranged=tidied if within is _as_it_is else explicit,
            means={letter: explicit(amount) for letter, amount in numbers.items()},
        ),
        parents=[answer],
    )


def _period_of(
    series: Quantity,
    amounts: Mapping[Symbol, Amount],
    unit: str,
    factor: Expr,
    figures: int,
    key: str | None,
    more: Sequence[tuple[str, Expr]],
    case: str,
) -> Quantity:
    """The numerical value of a period, computed from the integral: the series is accurate for small amplitudes only.

    Check: the integral by Gauss-Legendre quadrature; the result itself is computed as a mean of equidistant values.
    """
    whole = series.needed(WholeSwing)
    time = _with_numbers(series, amounts)
    exact = explicit(whole.factor * time)

    def by_gauss(result: Any) -> tuple[Any, Any]:
        found = whole.factor * _quarter_by_gauss(whole.time, amounts)
        return _error(found, result), Integer(0)

    return establish(
        VALUE,
        series.step.approximates,
        lambda: Factors(whole.factor, time),
        {},
        routes={"floats": by_gauss},
        outcome="integrated",
        phrase_data=PhraseData(
            words={"case": case} if case else {},
            outcome_data={"letters": time.args[1], "integral": whole.time, "numbers": time.args[2]},
        ),
        scope=Scope(about=series.subject, case_of=series),
        key=key or f"{series.key}_value",
        kind=series.step.kind,
        lines=Lines(
            put_in=None,
            result=False,
            after=[Form(_with_unit(exact, *each, figures), "rounded") for each in ((unit, factor), *more)],
            arranged=explicit,
        ),
        parents=series.parents,
    )


def _with_numbers(series: Quantity, amounts: Mapping[Symbol, Amount]) -> SwingTimeOfNumbers:
    time = series.needed(WholeSwing).time
    letters = sorted(_free(time) - {*time.variables}, key=str)
    numbers: SwingTimeOfNumbers = SwingTimeOfNumbers(
        time, Tuple(*letters), Tuple(*(in_radians(amounts[letter]) for letter in letters))
    )
    if not explicit(numbers).is_Rational:
        message = f"`{series.key}`: with these numbers the motion does not oscillate between two turning points"
        raise Rejected(Complaint("no-oscillation", message, help="give a smaller amplitude"))
    return numbers


def _quarter_by_gauss(time: SwingTime, amounts: Mapping[Symbol, Amount]) -> Expr:
    """Return the integral of dq/sqrt(f) from 0 to the amplitude A, with q = A (1 - s^2), by Gauss-Legendre
    quadrature."""
    from mpmath import mp

    f, q, amplitude, _ = time.args
    at = {letter: explicit(amounts[letter]) for letter in _free(time) - {q}}
    with mp.workdps(4 * DIGITS):
        square, a = lambdify(q, f.xreplace(at), "mpmath"), mp.mpf(amplitude.xreplace(at).evalf(mp.dps))
        found = mp.quad(lambda s: 2 * a * s / mp.sqrt(square(a * (1 - s * s))), [0, 1], method="gauss-legendre")
        return Rational(str(found))


def _check_series(answer: Quantity, amounts: Mapping[Symbol, Amount], figures: int) -> None:
    """Reject a result derived from a series that is not accurate to the requested number of figures."""
    waiting, seen = list(answer.parents if answer.step.about else ()), set[int]()
    while waiting:
        quantity = waiting.pop()
        if quantity.exact or id(quantity) in seen:
            continue
        seen.add(id(quantity))
        waiting += quantity.parents if quantity.step.approximates is None else ()
        whole = quantity.fact(WholeSwing)
        if whole is None or not _free(whole.time) - {*whole.time.variables} <= set(amounts):
            continue
        exact = whole.factor * explicit(_with_numbers(quantity, amounts))
        there = value_at(explicit(quantity.value), {s: explicit(amounts[s]) for s in _free(quantity.value)})
        if 20 * abs(there / exact - 1) > Rational(1, 10**figures):
            called = f"`{answer.key}` is derived from the series of `{quantity.key}`"
            message = f"{called}, which is not accurate to {figures} figures"
            help_line = f"ask for fewer `figures`, or give `{quantity.key}` a higher `order`"
            raise Rejected(Complaint("too-few-figures", message, help=help_line))


def _given_beside(
    condition: Quantity, amounts: Mapping[Symbol, Amount], unit: tuple[str, Expr], figures: int
) -> PhraseData:
    """For a condition such as S > 23.55 rad/s, return the given number S = 900 rpm and whether it satisfies the
    condition."""
    relation = condition.value
    if (
        not isinstance(relation, Relation)
        or relation.operator not in {*FULFILLED} - {"="}
        or relation.left not in amounts
    ):
        return PhraseData()
    at = {letter: explicit(amount) for letter, amount in amounts.items()}
    difference = explicit(relation.residual).subs(at)
    mark = "=" if vanishes(difference) else ">" if difference.is_positive else "<"
    name, factor = unit
    number = explicit(at[relation.left] / factor)
    written = (
        Amount(number, name, factor) if number.is_Integer and name else _with_unit(at[relation.left], *unit, figures)
    )
    told = Relation(relation.left, "=", written)
    return PhraseData(
        words={"seen": "fulfilled" if mark in FULFILLED[relation.operator] else "not_fulfilled"},
        named={"given": told},
        outcome_data={"condition": Relation(at[relation.left], relation.operator, explicit(relation.right).subs(at))},
    )


def _bent(answer: Quantity, amounts: Mapping[Symbol, Amount]) -> dict[str, Expr]:
    known = answer.fact(Extreme)
    return {} if known is None else {"curvature": explicit(bound(known.curvature, dict(amounts)))}


def _outcome(curvature: Expr | None, has_letters: bool) -> str:
    if curvature is not None and curvature.is_nonzero and not curvature.free_symbols:
        return "minimum" if curvature > 0 else "maximum"
    return "measured" if has_letters else "exact"


def is_plain(answer: Quantity) -> bool:
    """Whether the number of an answer, alone or in front of symbols, is clearer unchanged than in decimals, as pi/2 and
    sqrt(2) are."""
    value, _ = _valued(answer.value)
    if isinstance(value, MatrixBase):
        return all(_is_plain_number(entry) or (entry**2).is_Rational for entry in value)
    number, _ = value.as_independent(*value.free_symbols, as_Add=False)
    return _is_plain_number(number)


def _is_plain_number(number: Expr) -> bool:
    return bool(number.is_number and ((number / pi).is_Rational or number.is_Rational or (number**2).is_Integer))


def _as_it_is(value: Any) -> Any:
    return value


def _valued(value: Any) -> tuple[Any, Callable[[Any], Any]]:
    """Return the part of a result that gets a number, such as the right side of R > a/2. Also return the function that
    puts the number into the result."""
    if not isinstance(value, Relation):
        return value, _as_it_is
    if isinstance(value.left, Symbol) and not value.right.has(value.left):
        return value.right, lambda number: Relation(value.left, value.operator, number)
    return Integer(0), _as_it_is


def _under_one_root(value: Expr) -> Expr:
    """Write sqrt(M) sqrt(g)/sqrt(I) as sqrt(M g/I), so that numbers are substituted under one root."""
    roots = [f.as_base_exp() for f in Mul.make_args(value)]
    above = [base ** (2 * power) for base, power in roots if power == HALF or _is_fourth_root(base, power)]
    below = [base for base, power in roots if power == -HALF]
    if len(above) + len(below) < 2:
        return value
    others = [base**power for base, power in roots if abs(power) != HALF and not _is_fourth_root(base, power)]
    over = Factors(*above) if above else Integer(1)
    inside = Ratio(over, Factors(*below)) if below else over
    return Factors(*others, Root(inside)) if others else Root(inside)


def _is_fourth_root(base: Expr, power: Expr) -> bool:
    return bool(base.is_Integer and power == HALF / 2)


COMPARISON = Rule(
    "numeric.comparison",
    source=VALUE.source,
    outcomes={"fulfilled": numbers_fulfil(True), "not_fulfilled": numbers_fulfil(False)},
    evidence={"floats": CHECK},
)


def comparison_of(condition: Quantity, amounts: Mapping[Symbol, Amount], key: str | None = None) -> Quantity | None:
    """The comparison of the two sides of a condition with the numbers substituted, such as 20 cm > 2.5 cm.

    Return None if the condition has no symbols, has a symbol without a number, or has the operator `!=`.

    condition   an inequality or an equation between given quantities, such as a result of `where`
    amounts     symbol -> its number with a unit

    Check: both sides and the sign of their difference, evaluated again as for `value_of`.
    Outcomes: fulfilled, not_fulfilled.
    Source: the same as for `value_of`.
    """
    relation = condition.value
    if not isinstance(relation, Relation) or relation.operator not in FULFILLED:
        return None
    letters = _free(relation)
    if not letters or not letters <= set(amounts):
        return None
    numbers = {letter: amounts[letter] for letter in letters}
    left, right = (bound(side, numbers) for side in relation.sides)
    difference = explicit(left) - explicit(right)
    mark = "=" if vanishes(difference) else ">" if difference.is_positive else "<"

    def anew(found: Relation) -> tuple[Any, Any]:
        at = {letter: explicit(number) for letter, number in numbers.items()}
        marked = {">": 1, "=": 0, "<": -1}.get(found.operator, 2)
        shown = [rounded_form(value_at(explicit(side), {}), DIGITS) for side in found.sides]
        taken = [rounded_form(value_at(side, at), DIGITS) for side in relation.sides]
        apart = sign(value_at(relation.residual, at))
        return ImmutableDenseMatrix([marked, *shown]), ImmutableDenseMatrix([apart, *taken])

    return establish(
        COMPARISON,
        None,
        lambda _: Relation(left, mark, right),
        {"condition": relation},
        routes={"floats": anew},
        outcome="fulfilled" if mark in FULFILLED[relation.operator] else "not_fulfilled",
        key=key or f"{condition.key}_value",
        lines=Lines(put_in=None, result=False, arranged=explicit),
        parents=[condition],
    )


def coefficient_of(answer: Quantity, figures: int, of_vectors: bool = False) -> Quantity | None:
    """Round the irrational number in front of the symbols: sqrt(2 - sqrt(2)) omega becomes 0.7654 omega.

    Return None if there is no such number, for a relation, for symbols in a sum, and for a result in the symbols of
    other quantities. Without `of_vectors`, only a number that contains a sum is rounded.

    answer       a quantity, usually a scalar with symbols
    figures      the number of significant figures
    of_vectors   whether products of roots and pi, and vectors whose components are numbers times the same symbols, are
                 rounded, too

    Check: the answer divided by its symbols, evaluated again as for `value_of`.
    Outcomes: exact.
    Source: the same as for `value_of`.
    """
    value = answer.value
    if answer.step.chain[-1].because == NATURAL:
        return None  # its last line, such as sqrt(2 - sqrt(2)) omega_0, contains symbols that `value` does not
    if isinstance(value, Relation) or not value.free_symbols or (isinstance(value, MatrixBase) and not of_vectors):
        return None
    common, rest = factored_matrix(value) if isinstance(value, MatrixBase) else (value, Integer(1))
    number, letters = common.as_independent(*value.free_symbols, as_Add=False)
    number = number * rest
    if letters.has(Add) or number.free_symbols or getattr(number, "is_Rational", False):
        return None
    if not of_vectors and not number.has(Add):
        return None
    rounded = rounded_form(number, figures)
    return establish(
        VALUE,
        answer.symbol,
        lambda: value,
        {},
        routes={"floats": lambda result: _by_floats(number, set(), {}, result / letters)},
        outcome="exact",
        phrase_data=PhraseData(outcome_data={"letters": ()}),
        scope=Scope(about=answer.subject, case_of=answer),
        key=f"{answer.key}_value",
        kind=answer.step.kind,
        lines=Lines(
            after=[Form(scaled(letters, rounded) if rest != 1 else Factors(rounded, letters), "rounded")],
        ),
        parents=[answer],
    )


def in_radians(amount: Amount) -> Amount:
    """Convert an amount from degrees to radians, 5 degrees to pi/36 rad; return any other amount unchanged."""
    return Amount(explicit(amount), "rad", Integer(1)) if amount.args[1].name in IN_DEGREES else amount


def _only_turning(value: Any) -> set[Symbol]:
    """Return the symbols that occur only in sines, cosines and tangents, so that their numbers may stay in degrees."""
    angles: dict[Expr, Expr] = {f: Dummy() for entry in _entries(value) for f in entry.atoms(sin, cos, tan)}
    left = {letter for entry in _entries(value) for letter in entry.xreplace(angles).free_symbols}
    return _free(value) - left


def _amounts_in(expr: Any) -> int:
    return sum(isinstance(node, Amount) for node in preorder_traversal(expr))


def _entries(value: Any) -> list[Expr]:
    return list(value) if isinstance(value, MatrixBase) else [value]


def _free(value: Any) -> set[Symbol]:
    return {symbol for symbol in value.free_symbols if isinstance(symbol, Symbol)}


def _with_unit(exact: Any, unit: str, factor: Expr, figures: int) -> Any:
    rounded = rounded_form(exact / factor, figures)
    if isinstance(exact, MatrixBase):
        return MatrixAmount(rounded, unit, factor) if unit else rounded
    return Amount(rounded, unit, factor) if unit and rounded != 0 else rounded


def _by_floats(value: Any, letters: set[Symbol], amounts: Mapping[Symbol, Amount], exact: Any) -> tuple[Expr, Expr]:
    """Return the largest relative error of the exact entries, and zero, for a check to compare."""
    numbers = {letter: explicit(amounts[letter]) for letter in letters}
    errors = [_error(value_at(v, numbers), e) for v, e in zip(_entries(value), _entries(exact), strict=True)]
    return max(errors), Integer(0)


def _error(number: Expr, exact: Expr) -> Expr:
    """Return the relative difference of the two numbers; 0 if it is only a rounding error."""
    if number == 0:
        return Integer(0) if vanishes(exact) else Integer(1)
    error = abs(exact.evalf(5 * DIGITS) / number - 1)  # SymPy keeps no spare digits for the arguments of functions
    return Integer(0) if error < Rational(1, 10 ** (DIGITS - 5)) else Rational(error.evalf(6))
