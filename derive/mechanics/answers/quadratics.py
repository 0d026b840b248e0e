"""The two roots of a quadratic equation in one formula, the condition under which they are real, and each root.

The coefficients of a x^2 + b x + c = 0 may be general symbols. The values of these symbols in the problem are
substituted after the formula, so the page shows both the general roots and the roots of the problem. If a is zero, the
equation is linear and has one root.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Mul, Symbol, sqrt

from derive.algebra.expressions import PLUS_MINUS, RATES, Factors, Ratio, Relation, Root, Terms, bound, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.answers import claims
from derive.mechanics.answers.conditions import where
from derive.solving.divisors import may_vanish
from derive.solving.presentation import presented
from derive.solving.relations import conditions_told, solved_in_letters
from derive.solving.unknowns import coordinates_of, kind_of_unknown
from derive.steps.claims import sign_is
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.known_numbers import with_numbers
from derive.steps.level import Manner
from derive.steps.rule import CHECK, Rule, Shown
from derive.steps.signs import sign_known
from derive.steps.step import Fact, Level, Quantity, compared_with, is_zero
from derive.steps.subject import EVERYTHING

__all__ = ["discriminant", "real_where", "roots_together"]

FOUR, ZERO = Integer(4), Integer(0)
SIGNS = {1: "positive", -1: "negative", 0: "vanishing", None: "conditional"}


@dataclass(frozen=True)
class Quadratic:
    """The coefficients of a x^2 + b x + c."""

    a: Expr
    b: Expr
    c: Expr

    def with_values(self, values: dict[Any, Any]) -> Quadratic:
        return Quadratic(*(tidied(bound(each, values)) for each in (self.a, self.b, self.c)))

    def at(self, x: Expr) -> Expr:
        return self.a * x**2 + self.b * x + self.c

    @property
    def is_linear(self) -> bool:
        return bool(self.a == 0)

    @property
    def discriminant(self) -> Expr:
        return self.b**2 - FOUR * self.a * self.c

    @property
    def of_terms(self) -> Expr:
        return Terms(self.b**2, -FOUR * self.a * self.c)


@dataclass(frozen=True)
class Roots(Fact):
    """The quadratic equation of the roots: the coefficients in letters, the coefficients with values substituted, the
    unknown, and the substituted values."""

    missing = "is not a root that `roots` returned with `together`"
    general: Quadratic
    quadratic: Quadratic
    unknown: Symbol
    values: tuple[Quantity, ...]

    @property
    def roles(self) -> dict[str, Quantity]:
        return {q.key: q for q in self.values}

    def with_those(self, expr: Expr, those: Sequence[Any]) -> Expr:
        """Substitute names or values for the symbols of the quantities in `values`."""
        return bound(expr, dict(zip((q.symbol for q in self.values), those, strict=True)))


def roots_together(
    equation: Quantity, x: Symbol, values: Sequence[Quantity], key: str, keys: Sequence[str], symbols: Sequence[str]
) -> tuple[Quantity, ...]:
    """Both roots of a quadratic equation in one formula, then each root in a separate step, the smaller in absolute
    value first.

    equation   a x^2 + b x + c = 0, possibly times a factor without x
    x          the unknown of the quadratic equation
    values     quantities whose values replace letters in the coefficients
    key        the key of the step with both roots
    keys       the keys of the separate roots
    symbols    the symbols of the separate roots

    The result has one entry for each key; by default there are two keys, or one for a linear equation. If there is a
    single root or no real root, all entries are the same step.
    Check: each root substituted into the equation; the sum of the roots; the equivalent form of each root,
    2 c/(-b -+ sqrt(b^2 - 4 a c)); if no root is real, the discriminant from the resultant.
    Source: Abramowitz, Stegun, *Handbook of Mathematical Functions*, 3.8.1.
    """
    of, apart = _coefficients(equation, x, values)
    both = _together(equation, of, apart, key, keys)
    if of.quadratic.is_linear:
        return (both,) * max(1, len(keys))
    names = keys or [f"{key}_{i}" for i in (1, 2)]
    real, larger = sign_known(of.quadratic.discriminant), -1 if sign_known(of.quadratic.b) == 1 else 1
    if real == -1:
        return (_none_real(both, names),) * len(names)
    if real == 0:
        return (_one_of_two(both, larger, "coinciding", names[0], None, names[1:]),) * len(names)
    if len(names) != 2:
        message = f"`roots`: `{equation.key}` has 2 roots here, but the number of keys is {len(names)}"
        raise Rejected(Complaint("wrong-argument", message))
    letters = symbols or ("", "")
    words = _by_size(of.quadratic, real)
    return tuple(
        _one_of_two(both, sign, word, name, letter)
        for sign, word, name, letter in zip((-larger, larger), words, names, letters, strict=True)
    )


def _coefficients(equation: Quantity, x: Symbol, values: Sequence[Quantity]) -> tuple[Roots, Expr]:
    """Return the coefficients of a quadratic or linear equation in x, both in letters and with values substituted.

    The second result is the value of the factor of the left side that does not contain x.
    """
    factors = Mul.make_args(presented(equation.value.residual)) if isinstance(equation.value, Relation) else ()
    apart = Mul(*(f for f in factors if x not in f.free_symbols))
    polynomial = Mul(*(f for f in factors if x in f.free_symbols)).as_poly(x)
    if polynomial is None or polynomial.degree() not in (1, 2):
        message = f"`{equation.key}` is not a linear or quadratic equation in {x.name}"
        raise Rejected(Complaint("not-quadratic", message))
    turn = -1 if polynomial.LC().could_extract_minus_sign() else 1
    missing = [ZERO] * (2 - polynomial.degree())
    general = Quadratic(*(turn * each for each in (*missing, *polynomial.all_coeffs())))
    known = {q.symbol: q.value for q in values}
    here, beside = general.with_values(known), tidied(bound(apart, known))
    if is_zero(beside) or (here.a == 0 and here.b == 0):
        message = f"`roots`: `{equation.key}` does not depend on {x.name} here"
        help_line = f"its factor {apart} is zero for these values" if is_zero(beside) else None
        raise Rejected(Complaint("no-roots", message, help=help_line))
    return Roots(general, here, x, tuple(values)), beside


ROOTS_TOGETHER = Rule(
    "answers.roots_together",
    source="Abramowitz, Stegun, *Handbook of Mathematical Functions*, 3.8.1",
    outcomes={
        "two": claims.roots(1),
        "opposite": claims.roots(1, product=-1),
        "none": claims.roots(-1),
        "double": claims.roots(0),
        "conditional": claims.roots(None),
        "linear": claims.linear,
    },
    evidence={"put_back": CHECK, "sum": CHECK},
    statements=[claims.equation_in_its_unknown],
)


def _together(equation: Quantity, of: Roots, apart: Expr, key: str, keys: Sequence[str]) -> Quantity:
    """Roots of a quadratic equation, x = (-b +- sqrt(b^2 - 4 a c))/(2 a); x = -c/b where a is zero.

    equation   a x^2 + b x + c = 0
    of         the coefficients of the equation, and the quantities that replace letters in them
    apart      the factor of the left side that does not contain x
    keys       the requested keys; for a linear equation, all of them denote this step

    Check: each root substituted into the equation; the sum of the two roots is -b/a.
    Outcomes: two, none, double, conditional (the sign of b^2 - 4 a c depends on the symbols), opposite (two roots, one
    of each sign), linear.
    Source: Abramowitz, Stegun, *Handbook of Mathematical Functions*, 3.8.1.
    """
    here, x, linear = of.quadratic, of.unknown, of.quadratic.is_linear
    excluded = may_vanish(apart * (here.b if linear else here.a))
    formula = _linear_formula(of.general) if linear else _formula(of.general)

    def sum_of_both(found: Expr) -> tuple[Expr, Expr]:
        if linear:
            return found, -here.c / here.b
        return found + found.xreplace({PLUS_MINUS: -PLUS_MINUS}), -here.b / here.a

    return establish(
        ROOTS_TOGETHER,
        x,
        lambda _, __, *those: of.with_those(formula, those),
        {"equation": equation, "unknown": x, **of.roles},
        routes={"put_back": lambda found: (here.at(found), ZERO), "sum": sum_of_both},
        outcome="linear" if linear else character(here),
        phrase_data=PhraseData(
            outcome_data={"quadratic": here},
            formulas=conditions_told(excluded=excluded),
            stands_for=keys if linear else (),
        ),
        lines=Lines(put_in=Level.FULL, arranged=lambda found: tidied(found) if linear else _arranged(here, found)),
        key=key,
        facts=[of],
        kind=kind_of_unknown(x, coordinates_of(equation)),
        scope=Scope(differ=EVERYTHING),
    )


def character(of: Quadratic) -> str:
    """Return the outcome for the roots, from the sign of the discriminant and the sign of the product of the roots."""
    sign = sign_known(of.discriminant)
    if sign == 1:
        return "opposite" if sign_known(of.a * of.c) == -1 else "two"
    return "conditional" if sign is None else {-1: "none", 0: "double"}[sign]


def _linear_formula(of: Quadratic) -> Expr:
    return Ratio(of.c, -of.b) if of.b.could_extract_minus_sign() else Ratio(-of.c, of.b)


def _formula(of: Quadratic) -> Expr:
    return Ratio(Terms(-of.b, Factors(PLUS_MINUS, Root(of.of_terms))), 2 * of.a)


def _arranged(of: Quadratic, found: Expr) -> Expr:
    """Write the roots in the form k (u +- sqrt(u^2 - w)). Here u, up to its sign, is the product of the factors of -b
    that contain symbols, but no symbol of a or c. If the sign of the other factors is unknown, only simplify the roots.
    """
    own = [
        f
        for f in Mul.make_args(-of.b)
        if f.free_symbols and not (of.a.has(*f.free_symbols) or of.c.has(*f.free_symbols))
    ]
    u = Mul(*own)
    outside = tidied(-of.b / u)
    if sign_known(outside) == -1:
        u, outside = -u, -outside
    if sign_known(outside) != 1:
        return tidied(found)
    k = tidied(outside / (2 * of.a))
    inside = Add(*(tidied(term) for term in (u**2, -FOUR * of.a * of.c / outside**2)))
    both = Add(u, PLUS_MINUS * sqrt(inside), evaluate=False)
    return Mul(*Mul.make_args(k), both, evaluate=False) if k != 1 else both


def _by_size(quadratic: Quadratic, real: int | None) -> tuple[str, str]:
    if real is None:
        return "smaller_where_real", "larger_where_real"
    return ("nearer", "farther") if sign_known(quadratic.a * quadratic.c) == -1 else ("smaller", "larger")


OF_A_SIGN = ("smaller", "larger", "smaller_where_real", "larger_where_real", "nearer", "farther")
ONE_OF_TWO = Rule(
    "answers.one_of_two",
    source="Abramowitz, Stegun, *Handbook of Mathematical Functions*, 3.8.1",
    outcomes={
        "smaller": claims.whether(True, claims.SMALLER),
        "larger": claims.whether(True, claims.LARGER),
        "smaller_where_real": claims.one_of_two_smaller_where_real,
        "larger_where_real": claims.one_of_two_larger_where_real,
        "nearer": claims.one_of_two_nearer,
        "farther": claims.one_of_two_farther,
        "coinciding": claims.one_of_two_coinciding,
        "none": claims.one_of_two_none,
    },
    evidence={"put_back": CHECK, "other_form": CHECK, "resultant": CHECK},
    statements=[claims.a_root_of_its_sign],
    shown=Shown(result_in=dict.fromkeys(OF_A_SIGN, (ROOTS_TOGETHER.name,))),
)


def _one_of_two(
    both: Quantity, sign: int, outcome: str, key: str, letter: str | None, stands_for: Sequence[str] = ()
) -> Quantity:
    """One of the two roots of a quadratic equation, with the given sign before the square root.

    Check: the root substituted into the equation; the root in the equivalent form 2 c/(-b -+ sqrt(b^2 - 4 a c)).
    Outcomes: smaller, larger, smaller_where_real, larger_where_real, nearer, farther (roots of opposite signs),
    coinciding.
    Source: Abramowitz, Stegun, *Handbook of Mathematical Functions*, 3.8.1.
    """
    of = both.needed(Roots)
    quadratic = of.quadratic

    def other_form() -> Expr:
        return 2 * quadratic.c / (-quadratic.b - sign * sqrt(quadratic.discriminant))

    return establish(
        ONE_OF_TWO,
        scalar(letter or _indexed(of.unknown.name, key)),
        lambda _: _of_sign(both.value, sign),
        {"roots": both},
        lines=Lines(put_in=None, arranged=lambda _: _of_sign(both.value, sign)),
        routes={"put_back": lambda found: (quadratic.at(found), ZERO), "other_form": compared_with(other_form)},
        outcome=outcome,
        phrase_data=PhraseData(
            words={} if outcome == "coinciding" else {"sign": "upper" if sign > 0 else "lower"},
            outcome_data={"quadratic": quadratic},
            stands_for=stands_for,
        ),
        key=key,
        kind=both.step.kind,
        facts=[of],
    )


def _indexed(name: str, key: str) -> str:
    """Return the symbol of a root, with an index from the key of its step: phi_slow_dot for the key slow_precession,
    phi_1_dot for roots_1."""
    return with_index(name, key.rpartition("_")[2] if key[-1].isdigit() else key.partition("_")[0])


def with_index(name: str, index: str | int) -> str:
    """Return the name with an index: theta_1, or phi_1_dot for a rate."""
    order = next((suffix for suffix in RATES[:0:-1] if name.endswith(suffix)), "")
    return f"{name.removesuffix(order)}_{index}{order}"


def _of_sign(both: Expr, sign: int) -> Expr:
    factors = [factor.xreplace({PLUS_MINUS: Integer(sign)}) for factor in Mul.make_args(both)]
    return Mul(*factors, evaluate=False) if len(factors) > 1 else factors[0]


def _none_real(both: Quantity, keys: Sequence[str]) -> Quantity:
    """Statement that there is no real root, b^2 - 4 a c < 0.

    Outcomes: none.
    Check: the resultant gives the same discriminant, and this discriminant is known to be negative.
    Source: Abramowitz, Stegun, *Handbook of Mathematical Functions*, 3.8.1.
    """
    of = both.needed(Roots)

    def by_resultant(found: Relation) -> tuple[Any, Any]:
        other = with_numbers(_by_resultant(of))
        return found, Relation(_by_resultant(of), "<" if sign_known(other) == -1 else ">=", 0)

    return establish(
        ONE_OF_TWO,
        None,
        lambda *those: Relation(of.with_those(of.general.of_terms, those[1:]), "<", 0),
        {"roots": both, **of.roles},
        lines=Lines(arranged=lambda _: Relation(tidied(of.quadratic.discriminant), "<", 0)),
        routes={"resultant": by_resultant},
        outcome="none",
        key=keys[0],
        phrase_data=PhraseData(outcome_data={"quadratic": of.quadratic}, stands_for=keys),
        scope=Scope(differ=EVERYTHING),
        facts=[of],
    )


def _by_resultant(of: Roots) -> Expr:
    """Return the discriminant Delta; the resultant of the polynomial and its derivative is -a Delta."""
    return tidied(-_resultant(of.quadratic) / of.quadratic.a)


def _resultant(here: Quadratic) -> Expr:
    at_none, at_one, at_other = (here.at(Integer(n)) for n in (0, 1, -1))
    second, first = (at_one + at_other) / 2 - at_none, (at_one - at_other) / 2
    slope = [2 * here.a, here.b]
    return ImmutableDenseMatrix([[second, first, at_none], [*slope, ZERO], [ZERO, *slope]]).det(method="laplace")


DISCRIMINANT = Rule(
    "answers.discriminant",
    source="Abramowitz, Stegun, *Handbook of Mathematical Functions*, 3.8.1",
    outcomes={
        "positive": sign_is(1),
        "negative": sign_is(-1),
        "vanishing": sign_is(0),
        "conditional": sign_is(None),
        "linear": claims.linear,
    },
    evidence={"resultant": CHECK},
    shown=Shown(brief=Manner.LEFT_OUT, standard=Manner.LEFT_OUT, outcomes={"linear": (Manner.OWN, Manner.OWN)}),
)


def discriminant(roots: Quantity, symbol: str = "Delta", key: str = "discriminant") -> Quantity:
    """Discriminant of a quadratic equation, Delta = b^2 - 4 a c: the roots are real where it is not negative.

    roots   a root that `roots` returned with `together`

    Check: the resultant of a x^2 + b x + c and its derivative is -a Delta; for a linear equation, b is the difference
    of the values at x = 1 and x = 0.
    Outcomes: positive, negative, vanishing, conditional (the sign depends on the letters); linear (b^2, since a is
    zero).
    Source: Abramowitz, Stegun, *Handbook of Mathematical Functions*, 3.8.1.
    """
    of = roots.needed(Roots)
    here = of.quadratic

    def otherwise(found: Expr) -> tuple[Expr, Expr]:
        if here.is_linear:
            return found, (here.at(Integer(1)) - here.at(ZERO)) ** 2
        return -here.a * found, _resultant(here)

    return establish(
        DISCRIMINANT,
        scalar(symbol),
        lambda *those: of.with_those(of.general.of_terms, those),
        of.roles,
        lines=Lines(put_in=Level.FULL) if here.is_linear or not of.values else Lines(put_in=None, result=False),
        routes={"resultant": otherwise},
        outcome="linear" if here.is_linear else lambda found: SIGNS[sign_known(found)],
        key=key,
        parents=[next((q for q in (roots, *roots.parents) if q.step.rule == "answers.roots_together"), roots)],
        phrase_data=PhraseData(outcome_data={"quadratic": here}),
        scope=Scope(differ=EVERYTHING),
    )


def real_where(roots: Quantity, letter: Any, key: str = "real_where", distinct: bool = False) -> Quantity:
    """Condition under which the roots of a quadratic equation are real, b^2 - 4 a c >= 0, solved for a letter.

    roots      a root that `roots` returned with `together`
    letter     the letter to solve for
    distinct   whether two distinct roots are required, b^2 - 4 a c > 0

    The discriminant is a separate step; for a linear equation it is b^2, which does not vanish. If values were
    substituted in the equation, and the condition can be solved in the original letters, the page shows this condition
    first.
    Check: as `where`.
    Outcomes: as for `where`.
    Source: Abramowitz, Stegun, *Handbook of Mathematical Functions*, 3.8.1.
    """
    of, of_both, mark = roots.needed(Roots), discriminant(roots), ">" if distinct else ">="
    criterion = solved_in_letters(of_both, of.general.discriminant, mark, letter) if of.values else None
    through = (criterion, of.values) if criterion is not None else None
    return where(of_both, mark, 0, letter, key, through=through, for_real=True)
