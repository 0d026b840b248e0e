"""Substitution of results and values in an equation or a value."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from functools import partial
from types import MappingProxyType
from typing import Any

from sympy import Abs, Add, Expr, ImmutableDenseMatrix, Integer, MatrixBase, MatrixSymbol, Symbol

from derive.algebra.collect import by_accelerations, by_rates
from derive.algebra.derivatives import derivative
from derive.algebra.expressions import (
    RATES,
    TIME,
    Prescribed,
    Relation,
    TimeRate,
    bound,
    explicit,
    prescribed_in,
    rate,
    scalar,
)
from derive.algebra.ranges import where_positive
from derive.errors import Complaint, Rejected, Spelled, did_you_mean
from derive.mechanics.answers import claims
from derive.mechanics.arguments import checked
from derive.mechanics.hamilton.facts import Constant, SeenWith
from derive.mechanics.in_results import Values, in_results
from derive.mechanics.kinematics.coordinates import AtOneMoment, Coordinate, OfCoordinate
from derive.mechanics.lagrange.facts import FromLagrangian, KeptMomentum, WithMomenta
from derive.mechanics.lagrange.fixed_coordinates import KeptPositions
from derive.mechanics.motion.claims import arrives_as_told, comes_there, turned_first
from derive.mechanics.motion.turning_points import arrivals, common_condition, words_of
from derive.solving.defined_values import check_defined
from derive.solving.presentation import presented, without_positive
from derive.solving.relations import conditions_told
from derive.solving.unknowns import ValueOf, coordinates_of, left_over, letter_of, meaning, unknown_of, with_unknown
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.record import coordinates_in, named_coordinates
from derive.steps.rule import CHECK, Rule, Shown
from derive.steps.signs import sign_for_all
from derive.steps.step import Fact, Level, Quantity, approximations_among, compared_with, is_zero
from derive.steps.subject import EVERYTHING

__all__ = ["put_in"]

Replacement = tuple[Expr, Expr]  # the replaced expression, and its replacement
Rests = Quantity | Mapping[Any, Any] | Sequence[Quantity]


PUT_IN = Rule(
    "answers.put_in",
    source="none needed: substitution",
    outcomes={
        "results": claims.put_in(False),
        "values": claims.put_in(True),
        "zero": claims.put_in_zero,
        "identity": claims.identity,
        "again": claims.put_in_again,
        "turned": turned_first,
    },
    evidence={"at_once": CHECK, "found_before": CHECK},
    statements=[arrives_as_told, claims.fixed_as_told],
    named={"value": claims.names_put_in, "place": comes_there},
    shown=Shown(names_formula=True),
)


def put_in(
    of: Quantity,
    *others: Rests,
    key: str | None = None,
    symbol: str | None = None,
    again: Quantity | None = None,
    fixed_by: KeptPositions | None = None,
    **values: Any,
) -> Quantity:
    """Value or equation in which other results, or values of letters, are substituted: f(x) with x = g is f(g).

    of       a value or an equation
    others   results, each of which replaces its letter, and mappings of letters or coordinates to values. A result may
             be an equation for a letter, for a rate, or for a power, sine, cosine or tangent of a letter
    values   values of letters, by their names: `theta=0`; for a coordinate or a rate, the value at one instant
    again    an earlier result that this substitution must reproduce
    fixed_by the constraints that together fix the substituted values of coordinates; the sentence gives this reason

    The results are substituted one after another, in the given order; the values follow. If a result gives a coordinate
    as a function of other coordinates or of the time, the rates of this coordinate are substituted too. If the value of
    a prescribed function is given, as a function of the time or as a constant, its rates are substituted too.
    Check: all letters of the original replaced at once by their final values; if `again` is given, also equality with
    this earlier result.
    If the motion reaches a place only after turning back, a rate from conservation of energy changes its sign there.
    If the motion reaches the place only under a condition, the sentence states this condition.
    Outcomes: results (at least one result is substituted), values (only values are substituted), zero (only values are
    substituted, and the expression becomes zero), identity (an equation that always holds after the substitution),
    again (an earlier result is reproduced), turned (a rate that has changed its sign).
    Errors: there is nothing to replace; a prescribed function with a value that contains a coordinate; an equation that
    is not solved for a letter; an equation that cannot hold; a place that the motion does not reach.
    Source: none needed: substitution.
    """
    rests, given = _sorted_out(others)
    value = explicit(of.value)
    told: list[Replacement] = []
    for quantity in rests:
        value = _all_put(value, _replacements(quantity, of), quantity.key, of, told)
    there = _values(of, given, values, value)
    moving = coordinates_of(of, *rests)
    varying = {TIME, *moving, *(rate(q) for q in moving)}
    come = arrivals(of, rests, [(target, at) for target, at in [*told, *there] if not at.free_symbols & varying])
    for pair in there:
        rates = _of_prescribed(*pair)
        letters = {letter_of(target) for target, _ in (pair, *rates)}
        if letters & value.free_symbols or pair == there[0]:  # skip a letter that earlier values have removed
            value = _all_put(value, [*rates, pair], str(pair[0]), of, told)
    turned = [each for each in come if each.turned and not is_zero(value)]
    value = -value if turned else value
    result = arranged(value, list(moving))
    _check_holds(of, result)
    name = _name(of, symbol)
    # assume that the square of q_dot is positive, so that |q_dot| is real
    with where_positive(result**2) if isinstance(name, Abs) else nullcontext():
        return establish(
            PUT_IN,
            name,
            lambda *_: value,
            {"original": of, **{f"other_{i + 1}": quantity for i, quantity in enumerate(rests)}},
            lines=Lines(
                law=Level.FULL,
                put_in=None,
                arranged=lambda _: result,
                means=_means(name, result),
            ),
            routes={
                "at_once": lambda found: (-found if turned else found, _at_once(explicit(of.value), told)),
                **({"found_before": compared_with(lambda: again.value)} if again is not None else {}),
            },
            outcome="again" if again is not None else "turned" if turned else _outcome(result, rests),
            key=key or _key_for(of, rests, there),
            kind=of.step.kind,
            phrase_data=PhraseData(
                words=words_of(come) | ({"fixed": "together"} if fixed_by else {}),
                formulas=conditions_told(reached=common_condition(of, come)),
                named={
                    **{f"value_{i + 1}": Relation(target, "=", at) for i, (target, at) in enumerate(there)},
                    **({"place": Relation(turned[0].unknown, "=", turned[0].place)} if turned else {}),
                },
                outcome_data={
                    "replaced": [letter_of(target) for target, _ in told],
                    "arrivals": come,
                    "fixed_by": fixed_by,
                    **({"found": again.value} if again is not None else {}),
                },
                points_to={"found": again} if again is not None else {},
            ),
            parents=[*([again] if again is not None else []), *approximations_among(*given.values(), *values.values())],
            facts=[*_kept_facts(of, rests, there, told), *_at_one_moment(of, rests, there, result)],
            scope=Scope(differ=EVERYTHING, case_of=of),
        )


def _outcome(result: Any, rests: Sequence[Quantity]) -> str:
    if _is_identity(result) or rests:
        return "identity" if _is_identity(result) else "results"
    return "values" if isinstance(result, Relation) or not is_zero(result) else "zero"


def _kept_facts(
    of: Quantity, rests: Sequence[Quantity], there: Sequence[Replacement], told: Sequence[Replacement]
) -> list[Fact]:
    """Return facts about the result that hold after these substitutions."""
    found: list[Fact] = [f for f in of.facts if isinstance(f, OfCoordinate)]
    kept = [fact for rest in rests if (fact := rest.fact(KeptMomentum)) is not None]
    source = of.fact(FromLagrangian)
    if source is not None and isinstance(of.value, Relation) and kept and len(kept) == len(rests) and not there:
        found.append(WithMomenta(source.lagrangian, tuple(kept)))
    seen = of.fact(SeenWith)
    if seen is not None and (fitting := seen.with_values(_final(told))) is not None:
        found.append(fitting)
    return found


def _at_one_moment(
    of: Quantity, rests: Sequence[Quantity], there: Sequence[Replacement], result: Any
) -> list[AtOneMoment]:
    """Return the fact that the result holds only at the instant when a coordinate or a rate has a given value. The
    values may come from this substitution or from an earlier one."""
    moving = coordinates_of(of, *rests)
    every = {rate(q, n) if n else q: q for q in moving for n in range(len(RATES))}
    if of.fact(Constant) is not None and not result.free_symbols & {*every, TIME}:
        return []  # a constant has the same value at all times
    fixed = [
        every[letter_of(s)] for s, value in there if letter_of(s) in every and not value.free_symbols & {*every, TIME}
    ]
    fixed += [q for each in (of, *rests) if (known := each.fact(AtOneMoment)) for q in known.fixed]
    return [AtOneMoment(tuple(dict.fromkeys(fixed)))] if fixed else []


def _sorted_out(others: Sequence[Rests]) -> tuple[list[Quantity], dict[Any, Any]]:
    """Separate the results from the values of symbols."""
    results: list[Quantity] = []
    given: dict[Any, Any] = {}
    for each in others:
        if isinstance(each, Quantity):
            results.append(each)
        elif isinstance(each, Mapping):
            given.update(each)
        else:
            results += each
    return results, given


def _replacements(quantity: Quantity, of: Quantity) -> list[Replacement]:
    """Return the replacements for a result. The value of the result replaces its symbol. If the result gives a
    coordinate or a rate as a function of coordinates, rates or the time, its time derivatives are also replaced.
    A conserved momentum also replaces the rate of its coordinate."""
    kept = quantity.fact(KeptMomentum)
    if kept is not None:
        target, value = rate(kept.coordinate), kept.turning
        return [*_of_rates(target, value, coordinates_of(of, quantity)), (target, value), (kept.momentum, kept.value)]
    if isinstance(quantity.value, Relation):
        target, value = quantity.value.sides
        if quantity.value.operator != "=" or is_zero(quantity.value.residual):
            raise Rejected(Complaint("wrong-argument", f"`put_in`: `{quantity.key}` is not an equation for a letter"))
    else:
        target, value = _letter_replaced(quantity, of), quantity.value
    value = explicit(value)
    if isinstance(value, MatrixBase):
        message = f"`put_in`: `{quantity.key}` is not a number"
        raise Rejected(Complaint("wrong-argument", message, help=Spelled("`at` takes vectors", None)))
    try:
        target = unknown_of("put_in", target)
    except Rejected:
        target = None
    if target is None or left_over(value, target):
        message = f"`put_in`: `{quantity.key}` is not solved for a letter"
        raise Rejected(
            Complaint(
                "wrong-argument",
                message,
                help=Spelled(
                    "`solved_for` solves an equation for a letter",
                    "`solve` under `results` solves an equation for a letter",
                ),
            )
        )
    return [*_of_rates(target, value, coordinates_of(of, quantity)), (target, value)]


def _letter_replaced(quantity: Quantity, of: Quantity) -> Any:
    """Return the symbol that a result replaces. This is the symbol of the result if the original contains it; otherwise
    the unknown of a root, or the symbol of the result that a limit approximates."""
    root, own = quantity.fact(ValueOf), quantity.symbol
    whole = root.unknown if root is not None else quantity.step.approximates
    is_there = isinstance(own, Expr) and own.free_symbols <= explicit(of.value).free_symbols
    return whole if isinstance(whole, Expr) and not is_there else own


def _of_rates(target: Expr, value: Expr, moving: Mapping[Symbol, str]) -> list[Replacement]:
    """Return the replacements for the time derivatives of a coordinate or rate that is given as a function of
    coordinates, rates or the time. The highest derivative is first."""
    order = next((n for q in moving for n in (0, 1) if target == (rate(q, n) if n else q)), None)
    letters = {rate(q, n) if n else q for q in moving for n in range(len(RATES))} | {TIME}
    if order is None or not isinstance(target, Symbol) or not value.free_symbols & letters:
        return []
    found: list[Replacement] = []
    for n in range(1, 3 - order):
        value = explicit(TimeRate(value, *moving))
        found.insert(0, (rate(target, n), value))
    return found


def _of_prescribed(target: Expr, value: Expr) -> list[Replacement]:
    """Return the replacements for the rates of a prescribed function, the highest derivative first. Reject a value that
    is not a function of the time alone."""
    if not isinstance(target, Prescribed):
        return []
    if target.order:
        message = f"`put_in`: {target.name} follows from {target.function.name}, so it cannot have a value of its own"
        help_line = f"give {target.function.name} as a function of the time, such as `a*cos(omega*t)`"
        raise Rejected(Complaint("wrong-argument", message, help=help_line))
    moving = next(iter(coordinates_in(value)), None)
    own = next((s for s in prescribed_in(value) if s.function == target), None)
    if moving is not None or own is not None:
        message = f"`put_in`: {target.name} is a function of the time alone, but its value contains {moving or own}"
        raise Rejected(Complaint("changes", message))
    return [(target.rate(n), derivative(value, *[TIME] * n)) for n in range(len(RATES) - 1, 0, -1)]


def _values(of: Quantity, given: Mapping[Any, Any], named: Mapping[str, Any], value: Any) -> list[Replacement]:
    """Return the symbols, or expressions such as cos(theta), with the values that the caller gave."""
    letters = {s.name: s for s in value.free_symbols}
    letters |= {s.function.name: s.function for s in prescribed_in(value)}
    pairs: list[tuple[Expr, Any]] = [(unknown_of("put_in", target), at) for target, at in given.items()]
    for name, at in named.items():
        if name not in letters:
            message = f"`put_in`: `{of.key}` does not contain {name}"
            raise Rejected(Complaint("nothing-to-put-in", message, help=did_you_mean(name, letters)))
        pairs.append((letters[name], at))
    return [(target, _plain(of, target, at)) for target, at in pairs]


def _plain(of: Quantity, target: Expr, at: Any) -> Expr:
    if isinstance(at, Coordinate):
        return at.symbol
    if isinstance(at, Quantity):
        at = at.value
    if isinstance(at, int) and not isinstance(at, bool):
        return Integer(at)
    if not isinstance(at, Expr) or at.is_Float:
        message = f"`put_in`: the value of {target} must be an exact expression"
        raise Rejected(
            Complaint(
                "wrong-argument",
                message,
                help=Spelled("fractions are written `Rational(1, 2)`", "fractions are written `1/2`"),
            )
        )
    return explicit(at)


def _all_put(value: Any, pairs: Sequence[Replacement], called: str, of: Quantity, told: list[Replacement]) -> Any:
    """Return the value after these replacements, and append to `told` each replacement that changes the value. Reject
    replacements that together leave the value unchanged.
    """
    before = value
    for target, at in pairs:
        put = partial(_replaced, target, at)
        check_defined("put_in", of.key, f"{target} = {at}", value, put)
        after = _mapped(value, target, at)
        if after != value and not isinstance(target, Symbol) and left_over(after, target):
            message = f"`put_in`: `{of.key}` contains {letter_of(target).name} outside {target}"
            raise Rejected(Complaint("wrong-argument", message))
        if after != value:
            told.append((target, at))
        value = after
    if value == before:
        message = f"`put_in`: substituting `{called}` would not change `{of.key}`"
        raise Rejected(Complaint("nothing-to-put-in", message))
    return value


def _replaced(target: Expr, at: Expr, part: Expr) -> Expr:
    return with_unknown(part, target, at)


def _mapped(value: Any, target: Expr, at: Expr) -> Any:
    if isinstance(value, Relation):
        return Relation(with_unknown(value.left, target, at), value.operator, with_unknown(value.right, target, at))
    if isinstance(value, MatrixBase):
        return ImmutableDenseMatrix(value.applyfunc(lambda entry: with_unknown(entry, target, at)))
    return with_unknown(value, target, at)


def _final(told: Sequence[Replacement]) -> dict[Symbol, Expr]:
    """Return the final value of each replaced symbol, after all later substitutions."""
    final: dict[Symbol, Expr] = {}
    for target, at in reversed(told):
        final = {**final, **{letter: bound(v, final) for letter, v in meaning(target, at).items()}}
    return final


def _at_once(value: Any, told: Sequence[Replacement]) -> Any:
    """Substitute the final values of all replaced symbols in the original value, at once."""
    final = _final(told)
    if isinstance(value, Relation):
        return Relation(bound(value.left, final), value.operator, bound(value.right, final))
    return bound(value, final)


def arranged(value: Any, moving: Sequence[Symbol]) -> Any:
    """Simplify a value. Sort an equation of motion by its accelerations. If a relation without accelerations compares a
    value with zero, drop the positive factors of this value.
    """
    if isinstance(value, MatrixBase):
        return ImmutableDenseMatrix(value.applyfunc(presented))
    if not isinstance(value, Relation):
        return _energy_by_terms(value) or presented(value)
    fast = {rate(q, 2) for q in moving}
    if not is_zero(value.right) and all(side.free_symbols & fast for side in value.sides):
        return Relation(by_accelerations(value.residual, moving), value.operator, Integer(0))
    if not is_zero(value.right):
        return Relation(presented(value.left), value.operator, presented(value.right))
    if value.free_symbols & fast:
        return Relation(by_accelerations(value.left, moving), value.operator, Integer(0))
    left = presented(value.left)
    core = without_positive(left) if sign_for_all(left) != 1 else left
    if value.operator == "=" and all(term.could_extract_minus_sign() for term in Add.make_args(core)):
        core = -core  # x = 0, not -x = 0
    return Relation(presented(core), value.operator, Integer(0))


def _energy_by_terms(value: Expr) -> Expr | None:
    """Write an energy with separate terms for T and U: (1/2) m R^2 theta_dot^2 - m g R cos theta, without m R as a
    factor before a bracket. Return None for an expression that is not such a sum."""
    moving = list(coordinates_in(value))
    squares = [rate(q) ** 2 for q in moving if value.has(rate(q))]
    if not squares or value.as_numer_denom()[1].free_symbols:
        return None
    terms = Add.make_args(value.expand())
    kinetic = [term for term in terms if any(term.has(square) for square in squares)]
    if not kinetic or len(kinetic) == len(terms):
        return None
    found: Expr = by_rates(value, moving, 1, halves=True)
    return found


def _is_identity(result: Any) -> bool:
    return isinstance(result, Relation) and result.operator == "=" and is_zero(result.residual)


def _check_holds(of: Quantity, result: Any) -> None:
    """Reject an equation that never holds: the difference of its sides is known not to vanish."""
    if isinstance(result, Relation) and result.operator == "=" and not is_zero(result.residual):
        if explicit(result.residual).is_nonzero:
            message = f"`{of.key}` cannot hold with these values: it would be {result}"
            raise Rejected(Complaint("cannot-hold", message))


def _name(of: Quantity, symbol: str | None) -> Any:
    """Return the symbol of the result: the requested symbol or, by default, the symbol of the original.

    If the original has a symbol that is not a valid unknown, such as a derivative, the key of the original becomes the
    symbol. A relation has no symbol.
    """
    if isinstance(of.value, Relation):
        return None
    if symbol is not None:
        return scalar(symbol)
    if isinstance(of.value, MatrixBase) or isinstance(of.symbol, Symbol | Abs):
        return of.symbol
    try:
        return unknown_of("put_in", of.symbol)
    except Rejected:
        return scalar(of.key)


def _means(name: Any, result: Any) -> dict[Any, Any]:
    """Return the value of the symbol that the name of the result contains, such as theta_dot in theta_dot^2. In
    the name |q_dot|, this symbol is q_dot.
    """
    if isinstance(name, Abs):
        return {name.args[0]: result}
    return {} if name is None or isinstance(name, Symbol | MatrixSymbol) else dict(meaning(name, result))


def _key_for(of: Quantity, rests: Sequence[Quantity], there: Sequence[Replacement]) -> str:
    """Return the default key of the result, such as tension_at_theta or motion_x_with_tension."""
    if there:
        return f"{of.key}_at_" + "_".join(dict.fromkeys(letter_of(target).name for target, _ in there))
    return f"{of.key}_with_" + "_".join(quantity.key for quantity in rests)


NONE: Mapping[str, Expr] = MappingProxyType({})


@in_results(
    "put_in",
    "the answer with these results and values substituted",
    one_of=("results", "values"),
    of="put_in: an answer",
    results="results",
    values="values: `{theta: 0}`",
    symbol="symbol",
)
def _in_results(
    of: Quantity,
    key: str,
    results: Sequence[Quantity] = (),
    values: Values = NONE,
    symbol: str | None = None,
) -> Quantity:
    """Substitute results and the values of a state. The state may contain coordinates and rates that this answer does
    not contain."""
    letters = {s for quantity in (of, *results) for s in explicit(quantity.value).free_symbols}
    there = {s.name for s in letters} | {s.function.name for s in letters if isinstance(s, Prescribed)}
    check_values_used(of.key, values, there)
    needed = {name: value for name, value in values.items() if name in there}
    return checked(put_in)(of, *results, key=key, symbol=symbol, **(needed or values))


def check_values_used(key: str, values: Values, letters: set[str]) -> None:
    """Reject a value of a letter that is not among `letters`, unless this letter is a coordinate, a rate or an
    acceleration."""
    state = {rate(q, n).name if n else q.name for q in named_coordinates() for n in range(3)}
    for name in (name for name in values if name not in letters | state):
        message = f"`{key}` does not contain `{name}`, so a value of `{name}` has no effect"
        raise Rejected(Complaint("unused-value", message, help="leave it out", argument=f"values:{name}"))
