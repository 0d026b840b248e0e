"""Predicates that test the outcomes of computed answers, and the values that their sentences name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from sympy import (
    Dummy,
    Expr,
    Integer,
    Matrix,
    MatrixBase,
    Mul,
    Poly,
    Rational,
    Symbol,
    acos,
    asin,
    cos,
    diff,
    factor_list,
    gcd_list,
    oo,
    pi,
    sign,
    sin,
    tan,
)

from derive.algebra.equality import equal
from derive.algebra.expansion import Approach
from derive.algebra.expressions import PLUS_MINUS, TIME, Prescribed, Relation, depends_on_time, explicit
from derive.algebra.ranges import range_of
from derive.algebra.samples import NoNumber, letters_of, value_at
from derive.algebra.tidy import tidied
from derive.solving.root_of_factor import RootOf
from derive.steps.claims import (
    MARK_OF,
    both,
    has_sign,
    is_a_root_just_where_told,
    letters_in,
    may_be_zero,
    negated,
    same_equation,
    sign_is,
    value_of_role,
    vanishes,
    vanishing,
)
from derive.steps.known_numbers import with_numbers
from derive.steps.record import assumed
from derive.steps.rule import Judged, Predicate, handed_on_by
from derive.steps.signs import sign_known
from derive.steps.step import is_zero
from derive.steps.trial_numbers import (
    ALLOWED,
    Point,
    assumptions_about,
    everywhere,
    holds_at,
    real_at,
    roots_of,
    signs_of,
    trial_points,
)

LITTLE = 1e-12


def one_of(alone: bool, first: bool) -> Predicate:
    """Return a predicate for the position of the unknown: the only one (`alone`), the first of several (`first`), or a
    later one (neither)."""

    def is_so(facts: Judged) -> bool:
        count = sum(role.startswith("equation_") for role in facts.inputs)
        place = 0 if facts.inputs["place"] == 0 else 1
        return (count == 1) == alone and (alone or (place == 0) == first)

    return is_so


def _polynomial(facts: Judged) -> Poly:
    return Poly(facts.inputs["polynomial"], facts.inputs["gen"])


def _slope_there(facts: Judged) -> Any:
    polynomial = _polynomial(facts)
    return polynomial.diff(polynomial.gen).as_expr().xreplace({polynomial.gen: facts.result})


def single(facts: Judged) -> bool:
    return bool(_polynomial(facts).degree() == 1)


def double(facts: Judged) -> bool:
    return facts.inputs["count"] == 1 and is_zero(_slope_there(facts))


def only(facts: Judged) -> bool:
    """Whether this is the only root that is kept. Wherever this root is real, each other root of the polynomial must be
    complex, outside the range of the unknown, or not positive for a positive unknown."""
    alone = facts.inputs["count"] == 1 and _polynomial(facts).degree() > 1 and not is_zero(_slope_there(facts))
    return alone and everywhere(trial_points(_letters(facts)), lambda point: _only_there(facts, point))


def _letters(facts: Judged) -> set[Any]:
    return letters_of(_polynomial(facts).as_expr()) - {facts.inputs["gen"]}


def _only_there(facts: Judged, point: Point) -> bool:
    """Whether no other root is a possible value of the unknown at these trial numbers. Also return True if the root of
    the step is complex at these numbers."""
    own = complex(value_at(explicit(facts.result), point))
    there = Poly(_polynomial(facts).as_expr().xreplace(dict(point)), facts.inputs["gen"])
    numbers = sorted(roots_of(there), key=lambda root: abs(root - own))
    unknown, size = facts.inputs["unknown"], max(map(abs, numbers)) or 1
    known, limited = range_of(unknown), isinstance(unknown, sin | cos)
    for other in numbers[1:]:
        beside = limited and not _is_reached(unknown, other)
        beside = beside or known is not None and not known.least < other.real < known.greatest
        if abs(other.imag) < LITTLE * size and (other.real > 0 or facts.inputs["positive"] == 0) and not beside:
            return abs(own.imag) > LITTLE * size
    return True


def _is_reached(unknown: Expr, number: complex) -> bool:
    """Whether an angle in the range of its symbol has this sine or cosine."""
    if abs(number) > 1:
        return False
    known, angle = (
        range_of(unknown.args[0]),
        float(acos(number.real) if isinstance(unknown, cos) else asin(number.real)),
    )
    same = (angle, -angle) if isinstance(unknown, cos) else (angle, float(pi) - angle)
    turns = (each + 2 * n * float(pi) for each in same for n in range(-2, 3))
    return known is None or any(known.least < each < known.greatest for each in turns)


def of_several(first: bool) -> Predicate:
    def is_so(facts: Judged) -> bool:
        place, roots = int(facts.inputs["place"]), [explicit(root) for root in facts.inputs["roots"]]
        another = all(not is_zero(explicit(facts.result) - root) for n, root in enumerate(roots) if n != place)
        return facts.inputs["count"] > 1 and (place == 0) == first and another

    return is_so


def where_the_coefficients_last(predicate: Predicate) -> Predicate:
    """Return the predicate with a further test: the sentence must exclude the case that all coefficients vanish, since
    any number would then be a root."""

    def is_so(facts: Judged) -> bool:
        known = [facts.inputs[role] for role in ("excluded", "condition") if role in facts.inputs]
        told = [each.left for each in known if each.operator in ("!=", ">")]
        factors = {f for each in told for f, _ in factor_list(each)[1]}
        common = factor_list(gcd_list(_polynomial(facts).coeffs()))[1]
        open_ = [f for f, _ in common if may_be_zero(f) and not f.is_nonzero]
        return bool(predicate(facts)) and all(f in factors or -f in factors for f in open_)

    return is_so


def absent(facts: Judged) -> bool:
    if not isinstance(facts.result, Relation):
        return False
    return any(has_sign(facts.result.left, sign) for sign in ALLOWED[facts.result.operator])


def beyond_one(facts: Judged) -> bool:
    """Whether the left side of the result is beyond 1 at all trial numbers: greater than 1 for an inequality with >,
    less than -1 for any other inequality."""
    side = 1 if facts.result.operator == ">" else -1
    return signs_of(side * with_numbers(facts.result.left) - 1) == {1}


def put_in(only_values: bool) -> Predicate:
    def is_so(facts: Judged) -> bool:
        identity = (
            isinstance(facts.result, Relation) and facts.result.operator == "=" and is_zero(facts.result.residual)
        )
        return not identity and only_values == (not any(role.startswith("other_") for role in facts.inputs))

    return is_so


def identity(facts: Judged) -> bool:
    return isinstance(facts.result, Relation) and facts.result.operator == "=" and is_zero(facts.result.residual)


def _is_divided_as_told(facts: Judged) -> bool:
    """Whether the sentence states the right condition "factor != 0". The difference of quantity and bound is divided by
    this factor. The quotient must contain the unknown, and must vanish if the result is substituted. True without a
    condition."""
    excluded = facts.inputs.get("excluded")
    if excluded is None:
        return True
    left, right = explicit(facts.result).sides
    quotient = tidied(facts.inputs["difference"] / excluded.residual)
    return excluded.operator == "!=" and quotient.has(*left.free_symbols) and is_zero(quotient.subs(left, right))


def compared(squared: bool) -> Predicate:
    def is_so(facts: Judged) -> bool:
        left, right = facts.result.sides
        unknown = facts.inputs["unknown"]
        alone = left == (unknown**2 if squared else unknown) and not explicit(right).has(left)
        # a condition for the existence of an angle fits only if the unknown is its sine or cosine
        limited = "existing" not in facts.inputs or isinstance(unknown, sin | cos)
        return bool(alone) and limited and _is_divided_as_told(facts)

    return is_so


def always(wanted: bool) -> Predicate:
    """Judge whether, at all trial numbers, the difference has the stated sign or satisfies the relation of the result.
    The requested comparison must allow the stated sign if and only if `wanted` is true."""

    def is_so(facts: Judged) -> bool:
        held = facts.inputs["sign"] in ALLOWED[MARK_OF[facts.words["comparison"]]]
        difference = with_numbers(facts.inputs["difference"])
        found = signs_of(difference, *assumptions_about(letters_of(difference)))
        allowed = {facts.inputs["sign"], *ALLOWED[facts.result.operator]}
        return held == wanted and bool(found) and found <= allowed

    return is_so


def as_let(equation: bool, reason: bool) -> Predicate:
    """If `equation` is true, judge whether the step is an equation without a symbol; otherwise, whether the step is a
    value with a symbol. The step must state a reason if and only if `reason` is true."""

    def is_so(facts: Judged) -> bool:
        letter = facts.symbol is None if equation else facts.symbol is not None
        return letter and isinstance(facts.result, Relation) == equation and ("because" in facts.words) == reason

    return is_so


def near(*places: Any) -> Predicate:
    """Judge whether terms are left out and the symbol goes to one of the limits `places`. If `places` is empty, the
    symbol must go to a finite value other than zero."""

    def is_so(facts: Judged) -> bool:
        to = facts.inputs["to"]
        there = to in places if places else to not in (0, oo, -oo)
        return there and not nothing_left_out(facts)

    return is_so


def nothing_left_out(facts: Judged) -> bool:
    return is_zero(explicit(facts.inputs["value"]) - facts.result)


def is_nothing(facts: Judged) -> bool:
    """Whether the limit is zero, but the original value is not."""
    return is_zero(facts.result) and not nothing_left_out(facts)


def goes_as(wanted: int) -> Predicate:
    """Judge whether terms are left out and each nonzero entry of the result is one power of the small quantity, up to a
    factor. In the limit these entries must stay finite (`wanted` is 0), vanish (1) or diverge (-1)."""

    def is_so(facts: Judged) -> bool:
        x, to = facts.inputs["x"], facts.inputs["to"]
        small = 1 / x if to in (oo, -oo) else x - to
        entries = list(facts.result) if isinstance(facts.result, MatrixBase) else [facts.result]
        slopes = [tidied(diff(entry, x) / diff(small, x) * small / entry) for entry in entries if entry != 0]
        return (
            not nothing_left_out(facts)
            and bool(slopes)
            and all(sign(each) == wanted and not each.has(x) for each in slopes)
        )

    return is_so


def bent(sign: int) -> Predicate:
    """Judge numerically whether the place is a maximum (sign 1) or a minimum (sign -1). The values just before and just
    after the place must both be smaller, or both larger."""

    def is_so(facts: Judged) -> bool:
        x = Dummy("x", **facts.inputs["letter"].assumptions0)  # a Dummy, so that no given number replaces it
        varied = {facts.inputs["letter"]: x}
        value, place = (with_numbers(facts.inputs[role].xreplace(varied)) for role in ("value", "place"))
        told = [c for role, c in facts.inputs.items() if role == "condition" or role.startswith("inside_")]
        conditions = [with_numbers(explicit(condition).xreplace(varied)) for condition in (*told, *assumed())]
        letters = {s for e in (value, place, *(c.residual for c in conditions)) for s in letters_of(e)} - {x}
        there = [condition.xreplace({x: place}) for condition in conditions]

        def is_so_at(point: Point) -> bool:
            return bool(sign * _beside(value, x, value_at(place, point), point) > 0)

        return everywhere(trial_points(letters, *there), is_so_at)

    return is_so


def _beside(value: Expr, x: Symbol, place: Expr, point: Point) -> Expr:
    near = abs(place) / 10**6 + Rational(1, 10**9)
    there, *others = (value_at(value, {**point, x: place + k * near}) for k in (0, 1, -1))
    if any(each.is_real is False for each in (there, *others)):
        raise NoNumber
    return min(there - other for other in others) if there > others[0] else max(there - other for other in others)


def exact(facts: Judged) -> bool:
    return is_zero(facts.inputs["value"] - facts.inputs["kept"]) and _says_what_is_kept(facts)


def _says_what_is_kept(facts: Judged) -> bool:
    """Whether the equation states that the kept terms are zero, up to a factor that contains no rate and no
    acceleration.
    """
    residual = explicit(facts.result).residual
    moving = [s for s in residual.free_symbols if s.name.endswith(("_dot", "_ddot"))]
    ratio = facts.inputs["kept"] / residual
    return all(is_zero(ratio.diff(s)) for s in moving)


def leading(*places: Any) -> Predicate:
    """Judge whether no order is requested, terms are left out, and the symbol goes to one of the limits `places`.
    If `places` is empty, the symbol must go to a finite value other than zero."""

    def is_so(facts: Judged) -> bool:
        to = facts.inputs["to"]
        there = to in places if places else to not in (0, oo, -oo)
        return there and facts.inputs["order"] == -1 and not exact(facts) and _says_what_is_kept(facts)

    return is_so


def to_order(wanted: int | None) -> Predicate:
    def is_so(facts: Judged) -> bool:
        order = int(facts.inputs["order"])
        fits = order == wanted if wanted is not None else order not in (-1, 1)
        return fits and not exact(facts) and _says_what_is_kept(facts)

    return is_so


def roots_fit(test: Callable[[Expr, Expr, Expr], Any]) -> Predicate:
    """Judge whether `test` accepts this root, the other root and the coefficient b at all trial numbers with a positive
    discriminant. Symbols with a given number keep this number."""

    def is_so(facts: Judged) -> bool:
        quadratic = facts.inputs["quadratic"]
        other = -quadratic.b / quadratic.a - facts.result
        values = [with_numbers(each) for each in (facts.result, other, quadratic.b, quadratic.discriminant)]
        points = trial_points(set().union(*map(letters_of, values)), Relation(values.pop(), ">", 0))
        return everywhere(points, lambda point: bool(test(*(value_at(each, point) for each in values))))

    return is_so


SMALLER = roots_fit(lambda this, other, b: abs(this) < abs(other) and this * other > 0)


LARGER = roots_fit(lambda this, other, b: abs(this) > abs(other) and this * other > 0)


def whether(real: bool, predicate: Predicate) -> Predicate:
    """Return the predicate with a further test: the discriminant must be known to be positive if and only if `real` is
    true."""
    return lambda facts: (sign_known(_discriminant(facts)) == 1) == real and predicate(facts)


def _discriminant(facts: Judged) -> Expr:
    return facts.inputs["quadratic"].discriminant


def roots(discriminant: int | None, product: int | None = 1) -> Predicate:
    """Judge whether the discriminant has the sign `discriminant`; None requires that the sign is unknown. If
    `discriminant` is 1, the product of the roots must be known to be negative if and only if `product` is -1."""

    def is_so(facts: Judged) -> bool:
        q = facts.inputs["quadratic"]
        if is_zero(q.a) or not has_sign((q.b / q.a) ** 2 - 4 * q.c / q.a, discriminant):
            return False
        opposite = has_sign(q.c / q.a, -1)
        return discriminant != 1 or opposite == (product == -1)

    return is_so


def linear(facts: Judged) -> bool:
    return is_zero(facts.inputs["quadratic"].a)


def root(facts: Judged, fact: RootOf) -> bool:
    """Whether the value is a root of the polynomial with the coefficients of `fact`."""
    value = facts.result.right if isinstance(facts.result, Relation) else facts.result
    powers = range(len(fact.coefficients) - 1, -1, -1)
    return is_zero(sum(c * explicit(value) ** n for c, n in zip(fact.coefficients, powers, strict=True)))


def solved_for(facts: Judged, unknown: Any) -> bool:
    return bool(unknown == facts.symbol)


def slope_vanishes_by(facts: Judged, letter: Any) -> bool:
    slope = diff(value_of_role(facts, "quantity"), letter)
    return letter != facts.symbol and is_zero(slope.subs(letter, explicit(facts.result)))


def names_put_in(facts: Judged, value: Any) -> bool:
    """Whether `value` is an equation whose left side has no minus sign in front, and whether substituting the stated
    values in the original gives the result. Equivalent equations are accepted.

    If a rate has changed its sign, the result must be the negative of the value that the substitution gives. The result
    is not compared if other results or rates are also replaced, if an expression such as cos(theta) is
    replaced, or if a value contains a replaced symbol.
    """
    told = {v.left: v.right for role, v in facts.inputs.items() if role.rpartition("_")[0] == "value"}
    others = [role for role in facts.quantities if role.rpartition("_")[0] == "other"]
    if value.operator != "=" or value.left.could_extract_minus_sign():
        return False
    plain = all(isinstance(letter, Symbol) for letter in told)
    if others or not plain or any(explicit(at).has(*told) for at in told.values()):
        return True
    before, after = explicit(facts.inputs["original"]), explicit(facts.result)
    names = {s.name for s in before.free_symbols}
    of_time = [letter for letter in told if isinstance(letter, Prescribed)]
    if any({f"{letter.name}_dot", f"{letter.name}_ddot"} & names for letter in told if letter not in of_time):
        return True  # the rates of this coordinate are replaced, too
    rates = {letter.rate(n): diff(explicit(told[letter]), TIME, n) for letter in of_time for n in (1, 2, 3)}
    there = before.xreplace({**{letter: explicit(at) for letter, at in told.items()}, **rates})
    if isinstance(after, Relation):
        return isinstance(there, Relation) and same_equation(there.residual, after.residual)
    has_turned = any(each.turned for each in facts.inputs["arrivals"])
    return bool(equal(-there if has_turned else there, after))


def small_there(facts: Judged, small: Any) -> bool:
    x, to = facts.inputs["letter"], facts.inputs["to"]
    if to in (oo, -oo):
        return is_zero(small * x - 1)
    return is_zero(small.subs(x, to)) and is_zero(diff(small, x) - 1)


def near_that(facts: Judged, place: Any) -> bool:
    """Whether the small quantity that the sentence names is zero when the symbol has the value `place`."""
    return is_zero(facts.inputs["small"].subs(facts.inputs["letter"], place))


def highest_power(facts: Judged, power: Any) -> bool:
    """Whether the power is the requested order and, for a finite limit, no higher power of the small quantity is kept.
    Also return True if no order is requested."""
    order, x, to = (facts.inputs[role] for role in ("order", "letter", "to"))
    if order == -1 or to in (oo, -oo):
        return order in (-1, power)
    return order == power and is_zero(diff(explicit(facts.inputs["kept"]), x, int(power) + 1))


def for_short_times(facts: Judged, time: Any) -> bool:
    """Whether the stated time is the inverse of the small letter, and the terms that are left out depend on t."""
    left_out = tidied(explicit(facts.inputs["value"]) - explicit(facts.inputs["kept"]))
    return is_zero(time * facts.inputs["letter"] - 1) and depends_on_time(left_out)


def goes_to(facts: Judged, place: Any) -> bool:
    """Whether the value that the sentence names is the value to which the symbol goes in the step."""
    approach = facts.inputs["approach"]
    return isinstance(approach, Approach) and is_zero(approach.args[1] - place)


def right_of_a_bound(facts: Judged, bound: Any) -> bool:
    of = facts.quantities["quantity"].value
    return isinstance(of, Relation) and of.operator != "=" and is_zero(explicit(of.right) - bound)


def for_a_vector(facts: Judged, outcome: str) -> bool:
    return getattr(facts.inputs["vector"], "shape", None) == (3, 1)


def equation_in_its_unknown(facts: Judged, outcome: str) -> bool:
    equation, unknown = facts.inputs["equation"], facts.inputs["unknown"]
    excluded = unknown in letters_in(facts.inputs.get("excluded", Integer(0)))
    return isinstance(equation, Relation) and unknown in letters_in(equation) and not excluded


def _says_its_bound(facts: Judged, outcome: str) -> bool:
    """Whether, for the outcome `none`, the result is the condition "... < 0". The sign "<=" would be wrong, because a
    double root belongs to "= 0". The test is true for any other outcome."""
    return outcome != "none" or (facts.result.operator == "<" and is_zero(facts.result.right))


def a_root_of_its_sign(facts: Judged, outcome: str) -> bool:
    """Whether the formula for both roots gives the root of the step with the sign that the sentence names."""
    if "sign" not in facts.words:
        return _says_its_bound(facts, outcome)
    sign = {"upper": 1, "lower": -1}[facts.words["sign"]]
    return is_zero(explicit(facts.inputs["roots"]).xreplace({PLUS_MINUS: Integer(sign)}) - explicit(facts.result))


def as_asked_for(facts: Judged, outcome: str) -> bool:
    """Whether the sentence says "roots" for an equation and "zeros" for any other result. If the sentence names further
    factors that may vanish, the whole expression must vanish wherever one of these factors vanishes."""
    given = facts.inputs["equation"]
    beside, whole = facts.inputs.get("elsewhere"), explicit(given)
    whole = whole.residual if isinstance(whole, Relation) else whole
    vanishes = beside is None or all(is_zero(whole.subs(factor, 0)) for factor in Mul.make_args(beside.left))
    return vanishes and facts.words["asked"] == ("roots" if isinstance(given, Relation) else "zeros")


def as_asked(facts: Judged, outcome: str) -> bool:
    is_letter = isinstance(facts.inputs["unknown"], Symbol)
    numbered = facts.inputs["count"] == 1 or facts.symbol != facts.inputs["unknown"]
    if not is_letter:  # for the unknown cos(theta), the symbol of the root must also be a cosine
        numbered = getattr(facts.symbol, "func", None) == facts.inputs["unknown"].func
    limited = "existing" not in facts.inputs or isinstance(facts.inputs["unknown"], sin | cos)
    unknown = explicit(facts.inputs["unknown"])
    held = explicit(facts.inputs["equation"]).has(unknown, *((sin(unknown.args[0]),) if unknown.func is tan else ()))
    return numbered and limited and held and as_asked_for(facts, outcome) and is_a_root_just_where_told(facts)


def word_of_its_mark(facts: Judged, outcome: str) -> bool:
    """Whether the word fits the comparison sign of the first line, such as "at most" for <=, and whether the solved
    difference is quantity minus bound. The sentence may call the quantity a radicand only if it is a discriminant."""
    difference = explicit(facts.inputs["quantity"]) - explicit(facts.inputs["bound"])
    mark = str(facts.inputs["mark"])
    right_word = MARK_OF.get(facts.words["comparison"]) == mark
    if facts.inputs.get("for_real"):  # > for distinct real roots, >= for real roots
        right_word &= mark in (">", ">=") and facts.quantities["quantity"].step.rule == "answers.discriminant"
    radicand = (
        facts.words.get("seen") == "radicand" and facts.quantities["quantity"].step.rule != "answers.discriminant"
    )
    return right_word and not radicand and is_zero(difference - facts.inputs["difference"])


def there_where_told(facts: Judged, outcome: str) -> bool:
    """Whether the conditions in the sentence are exact. They must hold if and only if the place of the extremum is real
    and lies between the ends of the interval."""
    told = replace(facts, inputs={"positive": Integer(0), **facts.inputs})
    return is_a_root_just_where_told(told) and _between_the_ends_just_where_told(facts)


def _between_the_ends_just_where_told(facts: Judged) -> bool:
    if "within" not in facts.inputs:
        return True
    place, ends = explicit(facts.result), facts.inputs["within"]
    inside = [each for role, each in facts.inputs.items() if role.startswith("inside_")]
    real = [each for role, each in facts.inputs.items() if role == "condition"]
    letters = letters_of(place).union(*map(letters_of, ends), *(letters_of(each.residual) for each in inside))

    def is_so(point: Point) -> bool | None:
        found: list[Any] = [real_at(each, point) for each in (ends[0], place, ends[1])]
        if None in found:
            return None
        low, there, high = found
        at = {**point, facts.inputs["letter"]: there}
        if not low < high or not all(holds_at(each, at) for each in (*real, *assumed())):
            return None
        return bool(low < there < high) == all(holds_at(each, point) for each in inside)

    return everywhere(trial_points(letters), is_so)


def goes_where_it_is_said(facts: Judged, outcome: str) -> bool:
    """Whether the sentence names the right limit of a letter, or of a ratio such as h/R. The letter or ratio must
    go to this limit when the symbol of the expansion, here h, goes to the limit of the step."""
    goes, approach, to = (facts.inputs[role] for role in ("letter", "approach", "to"))
    if not isinstance(approach, Approach) or approach.args[0] != goes:
        return False
    aim = approach.args[1]
    return aim == to if aim in (oo, -oo) else is_zero(aim * facts.inputs["x"] / goes - to)


put_in_zero: Predicate = both(put_in(True), vanishes)


def fixed_as_told(facts: Judged, outcome: str) -> bool:
    """Whether the constraints that the sentence names as the reason fix the values of their coordinates: they hold at
    these values and at no other values nearby. Values that are substituted for these coordinates must be the fixed
    values."""
    kept = facts.inputs["fixed_by"]
    if kept is None:
        return "fixed" not in facts.words
    told = {v.left: v.right for role, v in facts.inputs.items() if role.rpartition("_")[0] == "value"}
    constraints = Matrix(kept.residuals)
    slopes = constraints.jacobian(list(kept.values)).xreplace(kept.values)
    is_own = any(q in told for q in kept.values) and all(told.get(q, at) == at for q, at in kept.values.items())
    is_held = all(is_zero(tidied(f.xreplace(kept.values))) for f in constraints)
    return is_own and is_held and slopes.is_square and not is_zero(slopes.det())


def put_in_again(facts: Judged) -> bool:
    return bool(equal(facts.result, facts.inputs["found"]))


where_never: Predicate = both(always(False), negated(vanishing("difference")))


where_equal: Predicate = both(always(False), vanishing("difference"))


def limiting_case_finite(facts: Judged) -> bool:
    return bool(is_nothing(facts) or goes_as(0)(facts))


one_of_two_smaller_where_real: Predicate = whether(False, roots_fit(lambda this, other, b: abs(this) < abs(other)))


one_of_two_larger_where_real: Predicate = whether(False, roots_fit(lambda this, other, b: abs(this) > abs(other)))


one_of_two_nearer: Predicate = roots_fit(lambda this, other, b: this * other < 0 and abs(this) < abs(other))


one_of_two_farther: Predicate = roots_fit(lambda this, other, b: this * other < 0 and abs(this) > abs(other))


one_of_two_coinciding: Predicate = sign_is(0, _discriminant)


one_of_two_none: Predicate = sign_is(-1, _discriminant)


def combination_generic(facts: Judged) -> bool:
    return bool(facts.inputs)


combination_named: Predicate = negated(combination_generic)


handed_on_by(RootOf, root)
