"""Conditions for a quantity to be greater than, less than or equal to a bound, solved for one letter."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice
from typing import Any

from sympy import Abs, Add, Dummy, Expr, ImmutableDenseMatrix, Integer, Mul, sqrt
from sympy.core.symbol import Str

from derive.algebra.equality import Grade, Verdict
from derive.algebra.expressions import Relation, explicit
from derive.algebra.expressions import bound as with_those
from derive.algebra.relation import TURNED
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.answers import claims
from derive.mechanics.arguments import checked
from derive.mechanics.in_results import Letter, Value, in_results
from derive.solving.attainable import existence
from derive.solving.divisors import may_vanish
from derive.solving.relations import conditions_told, divided_out, number_of, solved_for_unknown, unsolvable
from derive.solving.unknowns import unknown_of, with_unknown
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.known_numbers import with_numbers
from derive.steps.rule import CHECK, Rule
from derive.steps.signs import holds, sign_for_all, sign_known
from derive.steps.step import Form, Level, Quantity, value_behind

__all__ = ["where"]

WORDS = {
    "=": "equal_to",
    "!=": "different_from",
    ">": "greater_than",
    "<": "less_than",
    ">=": "at_least",
    "<=": "at_most",
}
REAL = {("answers.discriminant", mark) for mark in (">=", ">")}  # conditions for real roots: rule and comparison sign
POINTS = 40
ZERO = Integer(0)


WHERE = Rule(
    "answers.where",
    source="none needed: algebra of inequalities",
    outcomes={
        "solved": claims.compared(False),
        "squared": claims.compared(True),
        "always": claims.always(True),
        "never": claims.where_never,
        "equal": claims.where_equal,
    },
    evidence={"beside": CHECK, "points": CHECK},
    statements=[claims.word_of_its_mark],
)


def where(
    of: Quantity,
    mark: str,
    bound: Expr | Quantity,
    letter: Any,
    key: str = "condition",
    through: tuple[Relation, Sequence[Quantity]] | None = None,
    for_real: bool = False,
) -> Quantity:
    """Condition for a quantity to be greater than, less than or equal to a bound, solved for one letter: v > 0 where
    R > a/2.

    of        a scalar, any unit
    mark      the comparison sign: one of =, !=, <, >, <=, >=
    bound     the bound, of the same unit: an expression such as 0, or another quantity
    letter    the unknown: a letter, a rate, or an expression such as `cos(theta)`. Apart from positive factors,
              quantity minus bound must be linear in the unknown or in its square. For a sum or product such as 2b, the
              relation is solved for one of the letters in it
    through   a pair for an intermediate line: the same condition in other letters, and the results that these letters
              denote
    for_real  whether the quantity is a discriminant and the condition is for real roots

    Check: quantity minus bound is zero if the unknown equals the right side of the solved relation. If the sign of this
    difference is known for greater values of the unknown, the original and the solved relation agree above, at and
    below the right side. If the two relations differ by a factor of unknown sign, they are also compared at random
    points. At each point both relations are true, or both are false. A relation that holds for all values of the
    letters is tested at random points only.
    A divisor of both sides of an equation must not vanish: the page states this condition if it is not known to hold.
    The sign of a divisor of an inequality must be known from the letters, their ranges or their numbers.
    Outcomes: solved, squared (solved for the square of the letter only); for all values of the letters: always, never,
    equal (the two sides are equal, so the requested <, > or != never holds).
    Errors: the relation cannot be solved for the letter; an unknown comparison sign.
    Source: none needed: algebra of inequalities.
    """
    if mark not in TURNED:
        message = f"`where`: `{mark}` is not a comparison sign"
        raise Rejected(Complaint("wrong-argument", message, help=f"the comparison signs are {' '.join(TURNED)}"))
    bound = Integer(bound) if isinstance(bound, int) else bound
    difference = tidied(explicit(number_of(of)) - explicit(value_behind(bound)))
    sign = sign_for_all(difference)
    if sign is not None:
        return _of_known_sign(of, mark, bound, difference, sign, key)
    unknown, result = _solved_for_one_of(of, difference, mark, letter)
    alone, solved = result.sides
    if _settled_by_its_letter(alone, solved):
        return _of_known_sign(of, mark, bound, difference, 1 if result.operator == mark else -1, key)
    existing, excluded = existence(of, result), _excluded(difference, result)

    def same_truth(found: Relation) -> Verdict:
        return _same_truth(found, difference, mark, unknown)

    return establish(
        WHERE,
        None,
        lambda v, b: Relation(v, mark, b),
        {"quantity": of, "bound": bound},
        lines=Lines(
            law=Level.FULL,
            put_in=Level.STANDARD if through is None else Level.FULL,
            between=_by_way_of(*through, difference) if through is not None else (),
            after=_in_steps(difference, result, excluded),
            result=False,
            arranged=lambda _: result,
        ),
        routes={
            "beside": lambda found: _beside(found, difference, mark),
            # If the original and the solved relation differ by a factor of known sign, the route "beside" suffices.
            **({} if divided_out(difference, alone, solved) else {"points": same_truth}),
        },
        outcome="squared" if alone != unknown else "solved",
        phrase_data=PhraseData(
            words={"comparison": WORDS[mark], "seen": "radicand" if (of.step.rule, mark) in REAL else "quantity"},
            formulas=conditions_told(excluded=excluded, existing=existing),
            outcome_data={"unknown": unknown, "mark": Str(mark), "difference": difference, "for_real": for_real},
        ),
        key=key,
        parents=through[1] if through is not None else (),
    )


def _by_way_of(criterion: Relation, stands_for: Sequence[Quantity], difference: Expr) -> list[Form]:
    """Return the line with the condition in the symbols of the quantities `stands_for`; in the next line their values
    are substituted."""
    residual = explicit(with_those(criterion.residual, {q.symbol: q.value for q in stands_for}))
    return [Form(criterion, "solved", nonzero=divided_out(difference, residual, Integer(0)))]


def _of_known_sign(of: Quantity, mark: str, bound: Expr | Quantity, difference: Expr, sign: int, key: str) -> Quantity:
    """For a difference of known sign, return the step with the relation that is true for all values of the symbols."""
    is_true = holds(sign, mark)
    fact = mark if is_true else {1: ">", -1: "<", 0: "="}[sign]
    return establish(
        WHERE,
        None,
        lambda v, b: Relation(v, fact, b),
        {"quantity": of, "bound": bound},
        lines=Lines(put_in=Level.STANDARD if sign else None, result=False, arranged=explicit),
        routes={
            "points": lambda found: _same_truth(Relation(Integer(1), "=", 1), found.residual, found.operator, None)
        },
        outcome="always" if is_true else "never" if sign else "equal",
        phrase_data=PhraseData(
            words={"comparison": WORDS[mark]},
            outcome_data={"difference": difference, "sign": Integer(sign), "mark": Str(mark)},
        ),
        key=key,
    )


def _solved_for_one_of(of: Quantity, difference: Expr, mark: str, letter: Any) -> tuple[Expr, Relation]:
    """Solve for the unknown. For a sum or product such as 2b, solve for the first of its symbols for which a solution
    is possible."""
    given = explicit(value_behind(letter)) if isinstance(letter, Quantity | Expr) else None
    if not isinstance(given, Add | Mul):
        unknown = unknown_of("where", letter)
        return unknown, solved_for_unknown(of, difference, mark, unknown)
    for one in sorted(given.free_symbols & difference.free_symbols, key=str):
        try:
            return one, solved_for_unknown(of, difference, mark, one)
        except Rejected:
            continue
    raise unsolvable(of, given)


def _settled_by_its_letter(alone: Expr, solved: Expr) -> bool:
    """Whether the signs of `alone` and `solved` suffice to show that `alone` is greater than `solved` for all
    values."""
    return bool(alone.is_positive and solved.is_nonpositive) or bool(alone.is_nonnegative and solved.is_negative)


def _excluded(difference: Expr, result: Relation) -> Relation | None:
    """Return the condition that the divisor of both sides of a relation with = or != does not vanish. Return None for
    the other comparison signs, or if it is known that the divisor does not vanish."""
    if result.operator not in ("=", "!="):
        return None
    factor = tidied(difference / result.residual)
    return None if sign_known(factor) else may_vanish(factor.as_numer_denom()[0])


def _in_steps(difference: Expr, result: Relation, excluded: Relation | None) -> list[Form]:
    """Return the lines of the solution: one line, or first a line for the square of a positive symbol and then a line
    for the symbol itself."""
    alone, solved = result.sides
    divided = divided_out(difference, alone, solved)
    if excluded is not None:
        return [Form(result, "solved", nonzero=(*divided, *Mul.make_args(excluded.left)))]
    squares = Relation(alone**2, result.operator, tidied(solved**2))
    are_positive = bool(alone.is_positive and solved.is_positive)
    if divided or not are_positive:
        has_letters = any(factor.free_symbols for factor in divided)
        because = "divided" if has_letters else "solved"
        if are_positive and tidied(difference).diff(alone).has(alone):
            because = "root"
        return [Form(result, because, nonzero=divided)]
    return [Form(squares, "solved", nonzero=divided_out(difference, *squares.sides)), Form(result, "root")]


def _beside(found: Relation, difference: Expr, mark: str) -> tuple[Any, Any]:
    """Return two numbers or two vectors that are equal if the solved relation is right."""
    alone, place = found.sides
    d = Dummy("d", positive=True)
    if alone.is_positive and sign_known(place) == -1:  # a positive symbol is never the negative root of x^2 = a
        return Integer(1), Integer(0)
    unknown, power = (alone.base, 2) if alone.is_Pow else (alone, 1)
    above = tidied(with_unknown(difference, unknown, _nth(place + d, power)))
    at_place = tidied(with_unknown(difference, unknown, _nth(place, power)))
    sign = sign_known(above)
    if sign is None:
        return at_place, Integer(0)
    says = [Integer(holds(side, found.operator)) for side in (1, 0, -1)]
    is_so = [Integer(holds(side * sign, mark)) for side in (1, 0, -1)]  # below the bound the sign is opposite
    there, expected = [at_place, above, *says], [Integer(0), sign * Abs(above), *is_so]
    return ImmutableDenseMatrix(there), ImmutableDenseMatrix(expected)


def _nth(value: Expr, power: int) -> Expr:
    return value if power == 1 else sqrt(value)


def _same_truth(found: Relation, difference: Expr, mark: str, unknown: Expr | None) -> Verdict:
    """Check at random points that the original and the solved relation are both true or both false; without an unknown,
    check that the original relation is true."""
    seen = 0
    difference, residual = with_numbers(difference), with_numbers(found.residual)
    letters = letters_of(difference) | letters_of(residual)
    for point in islice(points(letters, seed_of(difference)), POINTS):
        try:
            here = holds(value_at(difference, point), mark)
            there = holds(value_at(residual, point), found.operator) if unknown is not None else True
        except (Undefined, NoNumber, TypeError):
            continue
        seen += 1
        if here != there:
            where_apart = tuple((str(name), str(value)) for name, value in point.items())
            return Verdict(Grade.REFUTED, "one of the relations holds and the other does not", where_apart)
    if not seen:
        return Verdict(Grade.REFUTED, "undefined at every tested point")
    return Verdict(Grade.SAMPLED, f"{seen} points")


@in_results(
    "where",
    "the condition, solved for the letter",
    excludes=(("results", "bound"),),
    of="where: an answer",
    letter="for: a letter",
    mark="is: a comparison sign such as `'>'`, `'='` by default",
    bound="bound: 0 by default",
    other="results: an answer as the bound",
)
def _in_results(
    of: Quantity, letter: Letter, key: str, mark: str = "=", bound: Value = ZERO, other: Quantity | None = None
) -> Quantity:
    return checked(where)(of, mark, bound if other is None else other, letter, key=key)
