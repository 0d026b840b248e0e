"""Roots of a polynomial equation in one letter, if the polynomial has factors of degree 1 and 2 only.

For a positive unknown only the roots that can be positive are kept. If a root is real or positive only for some values
of the symbols, the page states the condition next to the root.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from sympy import (
    Add,
    Dummy,
    Expr,
    ImmutableDenseMatrix,
    Integer,
    Mul,
    Poly,
    Symbol,
    cos,
    factor_list,
    resultant,
    sin,
)
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.expressions import Relation, Terms, explicit, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, did_you_mean
from derive.mechanics.answers import claims
from derive.mechanics.answers.quadratics import roots_together, with_index
from derive.mechanics.arguments import checked
from derive.mechanics.in_results import Letter, Symbols, in_results
from derive.solving.attainable import is_out_of_range, within_one
from derive.solving.divisors import may_vanish
from derive.solving.presentation import presented, without_positive
from derive.solving.relations import conditions_told
from derive.solving.root_of_factor import FOUR, RootOf, roots_of
from derive.solving.unknowns import (
    ValueOf,
    coordinates_of,
    factors_elsewhere,
    is_number,
    kind_of_unknown,
    letter_of,
    meaning,
    polynomial_in,
    residual_of,
    unknown_of,
)
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.known_numbers import with_numbers
from derive.steps.rule import CHECK, Rule
from derive.steps.signs import sign_for_all, sign_known
from derive.steps.step import Level, Quantity, is_zero

__all__ = ["roots"]

ZERO, ONE = Integer(0), Integer(1)


def roots(
    equation: Quantity,
    letter: Any,
    *values: Quantity,
    keys: Sequence[str] | None = None,
    symbols: Sequence[str] | None = None,
    together: str | None = None,
    key: str | None = None,
) -> tuple[Quantity, ...]:
    """Roots of an equation in one letter, in ascending order if this order is known. A quadratic factor has the roots
    x = (-b +- sqrt(b^2 - 4 a c))/(2 a), a linear factor the root x = -b/a. If the unknown is positive, only roots that
    can be positive are kept.

    equation   a polynomial equation in the letter; or a result that is not an equation, whose zeros are sought
    letter     the unknown: a letter, a coordinate, a rate, or an expression such as `cos(theta)`
    values     quantities whose values replace letters in the coefficients, in the line after the formula for both roots
    together   key of a step that has the two roots of a quadratic equation in one formula, x = (-b +- ...)/(2 a). A
               separate step follows for each root, the smaller in absolute value first. If there is a single root or no
               real root, the same step is returned for each key
    keys       keys of the steps; by default the letter, or theta_root for `cos(theta)`, with _1, _2 for several roots;
               with `together`, the value of `together` with _1 and _2
    key        the beginning of the default keys, in place of the letter
    symbols    the letters of the roots; by default the unknown, with _1, _2 for several roots of an unknown that is a
               letter

    Check: each root substituted into the equation; by Vieta, the sum and the product of all roots agree with the
    coefficients.
    If cos(theta) is the unknown, a factor such as sin(theta) is split off; the page states the equation sin(theta) = 0
    as a further solution.
    Outcomes: single, double, only (any other root is complex, not positive, or outside the range of the unknown),
    several (the first of several roots), following (a later root), none (no root is real), none_positive, none_reached
    (a sine or a cosine would be greater than 1 or less than -1); for both roots in one formula: two, none, double,
    conditional (the sign of b^2 - 4 a c depends on the symbols), opposite (one of each sign), linear.
    Errors: the equation is not a polynomial in the letter, or has a factor of a degree above two that cannot be split;
    no root is in the range of the unknown.
    Source: Abramowitz, Stegun, *Handbook of Mathematical Functions*, 3.8.1 and 3.8.2.
    """
    unknown = unknown_of("roots", letter)
    if together is not None or values:
        return roots_together(equation, letter_of(unknown), values, together or "roots", keys or (), symbols or ())
    none = [*(keys or []), *([key] if key else []), f"no_{letter_of(unknown).name}"][0]
    left, (x,) = polynomial_in("roots", equation, [unknown], or_value=True)
    polynomial = _polynomial(equation, left, x, unknown)
    every = [root for factor, times in _factors(polynomial, equation, unknown) for root in roots_of(factor, times)]
    real = [root for root in every if len(root.coefficients) == 2 or sign_known(root.discriminant) != -1]
    if not real:
        return (_no_root(equation, unknown, every, False, none),)
    kept = [root for root in real if root.sign_where_real() not in ((-1, 0) if sign_for_all(unknown) == 1 else ())]
    if not kept:
        return (_no_root(equation, unknown, real, True, none),)
    kept = [root for root in kept if not _is_out_of_reach(root, unknown)]
    if not kept:
        return (_not_reached(equation, unknown, real, none),)
    kept = [root for root in kept if not is_out_of_range(unknown, root.value)]
    if not kept:
        message = f"`roots`: no root of `{equation.key}` lies in the range of {letter_of(unknown)}"
        raise Rejected(Complaint("no-root", message))
    kept = _ascending(kept)
    names = list(keys or _names(unknown, len(kept), key))
    if len(names) != len(kept):
        count = f"{len(kept)} root{'s' * (len(kept) > 1)}"
        message = f"`roots`: `{equation.key}` has {count} here, but the number of keys is {len(names)}"
        raise Rejected(Complaint("wrong-argument", message))
    letters = list(symbols or [""] * len(kept))
    if len(letters) != len(kept):
        raise Rejected(Complaint("wrong-argument", "`roots` needs as many symbols as there are roots"))
    return tuple(
        _step(equation, unknown, polynomial, kept, every, i, name, letter)
        for i, (name, letter) in enumerate(zip(names, letters, strict=True))
    )


ROOTS = Rule(
    "answers.roots",
    source="Abramowitz, Stegun, *Handbook of Mathematical Functions*, 3.8.1 and 3.8.2",
    outcomes={
        word: claims.where_the_coefficients_last(predicate)
        for word, predicate in (
            ("single", claims.single),
            ("double", claims.double),
            ("only", claims.only),
            ("several", claims.of_several(True)),
            ("following", claims.of_several(False)),
        )
    },
    evidence={"put_back": CHECK, "vieta": CHECK},
    statements=[claims.as_asked],
)


def _step(
    equation: Quantity,
    unknown: Expr,
    polynomial: Poly,
    kept: Sequence[RootOf],
    every: Sequence[RootOf],
    i: int,
    key: str,
    letter: str,
) -> Quantity:
    root, alone = kept[i], len(kept) == 1
    others = [(each.value, each.times - (each is root)) for each in every]
    name = _name(unknown, letter, 0 if alone else i + 1)

    def vieta(found: Expr) -> tuple[Any, Any]:
        """Compare the sum and the product of all roots with the coefficients."""
        total = found + Add(*(value * n for value, n in others))
        product = found * Mul(*(value**n for value, n in others))
        n, (leading, *rest) = polynomial.degree(), polynomial.all_coeffs()
        return ImmutableDenseMatrix([total, product]), ImmutableDenseMatrix(
            [-rest[0] / leading, (-1) ** n * rest[-1] / leading]
        )

    elsewhere = Mul(*factors_elsewhere(residual_of("roots", equation, or_value=True), unknown))
    condition = _condition(root, unknown)
    told = conditions_told(
        condition=condition,
        excluded=_excluded(_common_factor(polynomial, every) * root.coefficients[0], condition),
        existing=_existing(root, unknown, equation),
        elsewhere=None if elsewhere == 1 else Relation(elsewhere, "=", ZERO),
    )
    return establish(
        ROOTS,
        name,
        lambda *_: root.formula,
        {"equation": equation, "unknown": unknown},
        lines=Lines(
            put_in=None,
            law=Level.FULL,
            arranged=lambda _: root.value,
            means={} if isinstance(name, Symbol) else meaning(name, root.value),
        ),
        routes={
            "put_back": lambda found: (polynomial.as_expr().xreplace({polynomial.gen: found}), ZERO),
            "vieta": vieta,
        },
        outcome=_outcome(root, i, kept, every),
        key=key,
        kind=kind_of_unknown(unknown, coordinates_of(equation)),
        phrase_data=PhraseData(
            words={"asked": _asked(equation), **({} if isinstance(unknown, Symbol) else {"seen": "function"})},
            formulas=told,
            outcome_data={
                "polynomial": polynomial.as_expr(),
                "gen": polynomial.gen,
                "positive": Integer(sign_for_all(unknown) == 1),
                "place": Integer(i),
                "roots": tuple(each.value for each in kept),
                "count": Integer(len(kept)),
            },
        ),
        facts=[root, ValueOf(unknown)],
    )


def _name(unknown: Expr, letter: str, number: int) -> Expr:
    """Return the symbol of a root. For the unknown cos(theta), the symbol is the cosine of `letter`; without a letter,
    it is cos(theta)."""
    if not isinstance(unknown, Symbol):
        return unknown.xreplace({letter_of(unknown): scalar(letter)}) if letter else unknown
    if not letter and not number:
        return unknown
    return scalar(letter or with_index(unknown.name, number), **_assumed(unknown))


def _excluded(divisor: Expr, condition: Relation | None) -> Relation | None:
    """Return the condition that the divisor does not vanish; None if it cannot vanish. Leave out factors that
    `condition` makes nonzero, such as cos(theta_0) if cos(theta_0) > 0."""
    excluded = may_vanish(divisor)
    if excluded is None or condition is None or condition.operator != ">" or not is_zero(condition.right):
        return excluded
    left = [f for f in Mul.make_args(excluded.left) if f not in Mul.make_args(condition.left)]
    return Relation(Mul(*left), "!=", ZERO) if left else None


def _outcome(root: RootOf, i: int, kept: Sequence[RootOf], every: Sequence[RootOf]) -> str:
    if i:
        return "following"
    if len(kept) > 1:
        return "several"
    if len(every) > 1:
        return "only"
    return "double" if root.times > 1 else "single"


ROOTS_ABSENT = Rule(
    "answers.roots_absent",
    source="Abramowitz, Stegun, *Handbook of Mathematical Functions*, 3.8.1 and 3.8.2",
    outcomes={"none": claims.absent, "none_positive": claims.absent, "none_reached": claims.beyond_one},
    evidence={"otherwise": CHECK},
    statements=[claims.as_asked_for],
)


def _no_root(equation: Quantity, unknown: Expr, every: Sequence[RootOf], real: bool, key: str) -> Quantity:
    """State that there is no root, because the discriminant is negative or, for a positive unknown, the largest root is
    not positive."""
    last = _ascending(list(every))[-1] if real else every[0]
    mark = "=" if real and is_zero(last.value) else "<"
    if real:
        decides, otherwise = last.formula, last.value
    else:
        a, b, c = last.coefficients
        decides, otherwise = Terms(b**2, -FOUR * a * c), _by_resultant(last)
    return establish(
        ROOTS_ABSENT,
        None,
        lambda *_: Relation(decides, mark, ZERO),
        {"equation": equation, "unknown": unknown},
        lines=Lines(put_in=None, result=real or not decides.free_symbols),
        routes={"otherwise": lambda found: (found.residual, otherwise)},
        outcome="none_positive" if real else "none",
        phrase_data=PhraseData(words={"asked": _asked(equation)}),
        key=key,
    )


def _asked(equation: Quantity) -> str:
    return "zeros" if is_number(equation) else "roots"


def _common_factor(polynomial: Poly, every: Sequence[RootOf]) -> Expr:
    found = {root.coefficients: root.times for root in every}
    return tidied(polynomial.LC() / Mul(*(c[0] ** times for c, times in found.items())))


def _is_out_of_reach(root: RootOf, unknown: Expr) -> bool:
    return isinstance(unknown, sin | cos) and root.value not in (1, -1) and within_one(root.value)[1]


def _not_reached(equation: Quantity, unknown: Expr, every: Sequence[RootOf], key: str) -> Quantity:
    nearest = min(every, key=lambda root: abs(number) if (number := with_numbers(root.value)).is_number else 1)
    side = 1 if sign_known(nearest.value) == 1 else -1
    return establish(
        ROOTS_ABSENT,
        None,
        lambda *_: Relation(nearest.value, ">" if side > 0 else "<", Integer(side)),
        {"equation": equation, "unknown": unknown},
        lines=Lines(put_in=None),
        routes={"otherwise": lambda found: (found.left, explicit(nearest.formula))},
        outcome="none_reached",
        phrase_data=PhraseData(words={"asked": _asked(equation)}),
        key=key,
    )


def _existing(root: RootOf, unknown: Expr, equation: Quantity) -> Relation | None:
    """Return the condition for an angle with this sine or cosine to exist. Return None if the unknown is not a sine or
    cosine, or if it is known whether the angle exists. The inequality is strict if the equation also contains the other
    function (the cosine for a root that is a sine), because this function vanishes at the bound."""
    if not isinstance(unknown, sin | cos) or root.value in (1, -1):
        return None
    exists, _ = within_one(root.value)
    if exists is None or residual_of("roots", equation, or_value=True).has(cos if isinstance(unknown, sin) else sin):
        return exists
    return Relation(exists.left, f"{exists.operator}=", exists.right)


def _by_resultant(root: RootOf) -> Expr:
    """Return the discriminant D of a quadratic factor; the resultant of the factor and its derivative is -a D."""
    a, b, c = root.coefficients
    x = Dummy("x")
    return -resultant(a * x**2 + b * x + c, 2 * a * x + b, x) / a


def _polynomial(equation: Quantity, left: Expr, x: Symbol, unknown: Expr) -> Poly:
    numerator = tidied(left).as_numer_denom()[0]
    try:
        found = numerator.as_poly(x)
    except PolynomialError:
        found = None
    if found is None or found.degree() < 1:
        is_not = f"does not contain {unknown}" if found is not None else f"is not a polynomial in {unknown}"
        message = f"`{equation.key}` {is_not}"
        raise Rejected(Complaint("no-polynomial", message))
    if found.LC().could_extract_minus_sign():
        found = -found
    return found


def _factors(polynomial: Poly, equation: Quantity, unknown: Expr) -> list[tuple[Poly, int]]:
    x = polynomial.gen
    _, parts = factor_list(polynomial.as_expr(), x) if _is_plain(polynomial) else (1, [(polynomial.as_expr(), 1)])
    found = [(part.as_poly(x), times) for part, times in parts if part.has(x)]
    if any(part is None or part.degree() > 2 for part, _ in found):
        degree = max(part.degree() for part, _ in found if part is not None)
        factor = f"an unsolved factor of degree {degree} in {unknown}"
        message = f"`roots` solves factors up to degree 2, but `{equation.key}` has {factor}"
        raise Rejected(Complaint("not-solved", message, help="choose a case in which all factors have degree 1 or 2"))
    return [(each, times * n) for part, times in found for each, n in _not_doubled(part)]


def _is_plain(polynomial: Poly) -> bool:
    return bool(polynomial.as_expr().count_ops() < 800)


def _not_doubled(polynomial: Poly) -> list[tuple[Poly, int]]:
    if polynomial.degree() == 2:
        a, b, c = polynomial.all_coeffs()
        if is_zero(b**2 - FOUR * a * c):
            return [(Poly([2 * a, b], polynomial.gen), 2)]
    return [(polynomial, 1)]


def _condition(root: RootOf, unknown: Expr) -> Relation | None:
    """Return the condition for the root to be real or, if a positive root is required, to be positive; None if
    no condition is needed."""
    if len(root.coefficients) == 3 and sign_known(root.discriminant) is None and not _sum_of_squares(root):
        _, b, c = root.coefficients
        # If b is 0, the discriminant -4 a c vanishes only for c = 0, where the root is 0. Then the sign ">" is right if
        # c cannot be 0 or if the root must be positive.
        lost = sign_known(c) or sign_for_all(unknown) == 1
        mark = ">" if b == 0 and lost else ">="
        return Relation(presented(without_positive(root.discriminant)), mark, ZERO)
    if sign_for_all(unknown) == 1 and root.sign_where_real() is None:
        return Relation(presented(without_positive(tidied(root.value))), ">", ZERO)
    return None


def _sum_of_squares(root: RootOf) -> bool:
    """Whether the product of the roots is known to be negative; then b^2 - 4 a c is positive."""
    a, _, c = root.coefficients
    return sign_known(a * c) == -1


def _ascending(found: list[RootOf]) -> list[RootOf]:
    """Sort the roots by their numerical values if all values are numbers. Otherwise, only a pair of roots is sorted: it
    is reversed if the first root is known to be greater, or if `_turned` is true."""
    numbers = [with_numbers(root.value) for root in found]
    if all(number.is_real and not number.free_symbols for number in numbers):
        order = sorted(range(len(found)), key=lambda i: numbers[i].evalf(30))
        return [found[i] for i in order]
    if len(found) == 2 and sign_known(found[0].value - found[1].value) == 1 or _turned(found):
        return found[::-1]
    return found


def _turned(found: Sequence[RootOf]) -> bool:
    """Whether these are the two roots of one factor with a negative leading coefficient, and the first root has the
    minus sign before the square root."""
    one_factor = len(found) == 2 and found[0].coefficients == found[1].coefficients and found[0].sign == -1
    return one_factor and sign_known(found[0].coefficients[0]) == -1


def _names(unknown: Expr, count: int, key: str | None) -> list[str]:
    name = key or f"{letter_of(unknown).name}{'' if isinstance(unknown, Symbol) else '_root'}"
    return [name] if count == 1 else [f"{name}_{i + 1}" for i in range(count)]


def _assumed(unknown: Expr) -> dict[str, bool]:
    return {"positive": True} if unknown.is_positive else {}


@in_results(
    "roots",
    "the roots of an equation; for another answer, its zeros",
    equation="roots: an equation, or another answer",
    letter="for: a letter, or `cos(theta)`",
    root="root: which root: `positive`, `negative`, `largest`, `smallest`, or its number, such as `2`",
    symbols="symbol: one for each root",
)
def _in_results(
    equation: Quantity, letter: Letter, key: str, root: str | None = None, symbols: Symbols = ()
) -> tuple[Quantity, ...] | Quantity:
    """Return all roots, or the root that the author chose. The keys of zeros begin with the requested name; the keys of
    the roots of an equation begin with the unknown."""
    begins = None if isinstance(equation.value, Relation) else key
    found = checked(roots)(equation, letter, symbols=tuple(symbols) or None, key=begins)
    return found if root is None else _chosen(found, root)


def _difference(one: Quantity, other: Quantity) -> int | None:
    return sign_known(explicit(one.value) - explicit(other.value))


CHOICES: Mapping[str, Callable[[Quantity, Sequence[Quantity]], bool]] = {
    "positive": lambda root, every: sign_known(explicit(root.value)) == 1,
    "negative": lambda root, every: sign_known(explicit(root.value)) == -1,
    "largest": lambda root, every: all(_difference(root, each) == 1 for each in every if each is not root),
    "smallest": lambda root, every: all(_difference(root, each) == -1 for each in every if each is not root),
}


def _chosen(found: Sequence[Quantity], which: str) -> Quantity:
    if any(isinstance(root.value, Relation) for root in found):
        raise Rejected(Complaint("no-root", f"there is no root that could be `{which}`", argument="root"))
    if which.isdigit():
        if not 1 <= int(which) <= len(found):
            raise _no_choice(
                which, "there is only 1 root" if len(found) == 1 else f"there are {len(found)} roots", found
            )
        return found[int(which) - 1]
    if which not in CHOICES:
        help_line = did_you_mean(which, CHOICES) or f"write {', '.join(f'`{way}`' for way in CHOICES)}, or a number"
        message = f"`{which}` does not say which root is meant"
        raise Rejected(Complaint("wrong-type", message, help=help_line, argument="root"))
    fitting = [root for root in found if CHOICES[which](root, found)]
    if len(fitting) != 1:
        raise _no_choice(
            which,
            "no root is known to have this property" if not fitting else f"{len(fitting)} roots have this property",
            found,
        )
    return fitting[0]


def _no_choice(which: str, why: str, found: Sequence[Quantity]) -> Rejected:
    values = ", ".join(str(explicit(root.value)) for root in found)
    message = f"`root: {which}` does not determine one root: {why}"
    return Rejected(Complaint("no-root", message, help=f"the roots are {values}", argument="root"))
