"""Maximum and minimum of a result: the place where the slope vanishes, the value there, and the sign of the
curvature."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import islice
from typing import Any

from sympy import Abs, Dummy, Expr, Integer, MatrixSymbol, Rational, Symbol

from derive.algebra.equality import Grade, Verdict
from derive.algebra.expressions import TIME, At, Norm, Relation, explicit, scalar
from derive.algebra.ranges import range_of
from derive.algebra.relation import sides_without_minus
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.answers import claims
from derive.mechanics.in_results import Ends, Letter, in_results
from derive.solving.presentation import as_one_root, presented
from derive.solving.relations import positive
from derive.solving.unknowns import coordinates_of, kind_of_unknown, letter_of, unknown_of
from derive.solving.zeros import Unsolved, Zero, zeros_nearby, zeros_of
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.known_numbers import with_numbers
from derive.steps.record import assumed
from derive.steps.rule import CHECK, Rule
from derive.steps.signs import holds, sign_for_all, sign_known, truth_known
from derive.steps.step import Level, Quantity

__all__ = ["maximum", "minimum"]

POINTS, BESIDE = 6, 9
Within = tuple[Expr, Expr]


@in_results(
    "maximum",
    "where the answer is greatest, and its greatest value",
    of="maximum: an answer",
    letter="for: a letter",
    within="within: two values, `[0, pi/2]`",
)
def maximum(of: Quantity, letter: Letter, within: Ends = None, key: str = "maximum") -> tuple[Quantity, Quantity]:
    """Place and value of the maximum of a result: f'(x) = 0 and f''(x) < 0.

    of       a scalar, any unit
    letter   the variable, such as an angle, a frequency or a length
    within   the interval of the letter; by default all values that the letter can have

    A place that always exists is preferred to a place that exists only under a condition.
    Check: the slope vanishes at the place; numerically, no value at other places is greater (less, for a minimum).
    Outcomes: greatest, or least for `minimum`. If the extremum exists only for some values of the letters, the sentence
    states a condition for these values.
    Errors: the result is not a value that depends on the letter; no place with zero slope can be the extremum, or
    several can and none is preferred; the places with zero slope have no closed form; the place is at a time before the
    start.
    Source: Boas, *Mathematical Methods in the Physical Sciences*, section 4.8.
    """
    return _extremum(of, letter, within, key, "maximum", -1)


@in_results(
    "minimum",
    "where the answer is least, and its least value",
    of="minimum: an answer",
    letter="for: a letter",
    within="within: two values, `[0, pi/2]`",
)
def minimum(of: Quantity, letter: Letter, within: Ends = None, key: str = "minimum") -> tuple[Quantity, Quantity]:
    """Place and value of the minimum of a result: f'(x) = 0 and f''(x) > 0.

    of       a scalar, any unit
    letter   the variable, such as an angle, a frequency or a length
    within   the interval of the letter; by default all values that the letter can have

    Check: as `maximum`.
    Errors: as `maximum`.
    Source: Boas, *Mathematical Methods in the Physical Sciences*, section 4.8.
    """
    return _extremum(of, letter, within, key, "minimum", 1)


EXTREMUM_PLACE = Rule(
    "answers.extremum_place",
    source="Boas, *Mathematical Methods in the Physical Sciences*, section 4.8",
    outcomes={"greatest": claims.bent(1), "least": claims.bent(-1)},
    evidence={"slope": CHECK, "beside": CHECK},
    statements=[claims.there_where_told],
    named={"letter": claims.slope_vanishes_by},
)


EXTREMUM_VALUE = Rule(
    "answers.extremum_value",
    source="Boas, *Mathematical Methods in the Physical Sciences*, section 4.8",
    outcomes={"greatest": claims.bent(1), "least": claims.bent(-1)},
    evidence={"beside": CHECK},
)


def _extremum(
    of: Quantity, letter: Any, within: Within | None, key: str, verb: str, curved: int
) -> tuple[Quantity, Quantity]:
    value, x = explicit(of.value), letter_of(unknown_of(verb, letter))
    if not isinstance(value, Expr) or isinstance(value, Relation) or x not in value.free_symbols:
        raise Rejected(Complaint("wrong-argument", f"`{verb}`: `{of.key}` is not a value that depends on {x.name}"))
    slope, curvature = tidied(value.diff(x)), value.diff(x, 2)
    within = (explicit(within[0]), explicit(within[1])) if within else _range_as_interval(x)
    try:
        places = _places(slope, x, within)
    except Unsolved as unsolved:
        message = f"`{verb}`: the places where the slope of `{of.key}` vanishes have no closed form"
        help_line = f"the zeros of {unsolved.factor} are unknown"
        raise Rejected(Complaint("no-closed-form", message, help=help_line)) from None
    inside = [(zero.value, zero.exists, _inside(zero.value, zero.exists, within, x)) for zero in places]
    found = [(place, _conditions(real, room)) for place, real, room in inside if room is not None]
    signs = [sign_known(curvature.subs(x, place)) for place, _ in found]
    sure = [pair for pair, sign in zip(found, signs, strict=True) if sign == curved]
    fitting = sure or [pair for pair, sign in zip(found, signs, strict=True) if sign is None]
    fitting = [pair for pair in fitting if not pair[1]] or fitting  # prefer a place without a condition
    if len(fitting) != 1:
        raise _not_one(of, x, verb, len(fitting), slope.has(x) and not found)
    ((place, conditions),) = fitting
    if x == TIME and sign_known(place) == -1:
        message = f"`{verb}`: the only possible {verb} of `{of.key}` is before the motion begins, at t = {place}"
        raise Rejected(Complaint("no-extremum", message, help="the extreme value may be at the start, t = 0"))
    name = scalar(f"{x.name}_{verb[:3]}", **({"positive": True} if x.is_positive else {}))
    at = establish(
        EXTREMUM_PLACE,
        name,
        lambda *_: place,
        {"quantity": of},
        lines=Lines(put_in=None, law=Level.BRIEF, arranged=lambda _: place),
        routes={
            "slope": lambda p: (slope.subs(x, p), Integer(0)),
            "beside": lambda p: _not_exceeded(value, x, value.subs(x, p), within, conditions, curved, p),
        },
        outcome="greatest" if curved < 0 else "least",
        key=f"{key}_{x.name}",
        kind=kind_of_unknown(x, coordinates_of(of)),
        phrase_data=PhraseData(
            formulas={role: (_apart(each), each) for role, each in conditions.items()},
            named={"letter": x},
            outcome_data={"value": value, "place": place, **({"within": within} if within else {})},
        ),
        scope=Scope(coordinates={}),
    )
    top = establish(
        EXTREMUM_VALUE,
        scalar(key if (name_of := _letter_of(of)) is None else f"{name_of}_{verb[:3]}"),
        lambda f, p: At(f, x, p),
        {"quantity": of, "place": at},
        lines=Lines(put_in=Level.FULL, law=Level.FULL, arranged=presented),
        routes={"beside": lambda top: _not_exceeded(value, x, top, within, conditions, curved, place)},
        outcome="greatest" if curved < 0 else "least",
        key=key,
        kind=of.step.kind,
        phrase_data=PhraseData(outcome_data={"value": value, "letter": x, "place": place, **conditions}),
    )
    return at, top


def _letter_of(of: Quantity) -> str | None:
    """Return the name of the symbol of a quantity or, for the length of a vector, the name of the vector. Return None
    if the symbol is another formula."""
    symbol = of.symbol.args[0] if isinstance(of.symbol, Norm) else of.symbol
    return str(symbol.name) if isinstance(symbol, Symbol | MatrixSymbol) else None


def _not_one(of: Quantity, x: Symbol, verb: str, count: int, elsewhere: bool) -> Rejected:
    """Return the error for no suitable place, or for more than one."""
    message = f"`{verb}`: `{of.key}` has {count} places with zero slope where a {verb} is possible"
    only_one = "give an interval that contains only one of them"
    help_line: str = Spelled(f"{only_one}, `within=(..., ...)`", f"{only_one}, `within: [0, pi/2]`")
    if not count:
        curvature = "negative" if verb == "maximum" else "positive"
        message = f"`{verb}`: `{of.key}` has no allowed place with zero slope and {curvature} curvature"
        help_line = f"the {verb} may be at an end of the interval: `put_in` gives the value there"
    if not count and elsewhere:
        message = f"`{verb}`: `{of.key}` is not stationary for any allowed {x.name}"
    return Rejected(Complaint("no-extremum", message, help=help_line))


def _range_as_interval(x: Symbol) -> Within | None:
    """Return the interval of values of the symbol, if its declared range, or the assumed relations such as b < l, give
    exactly one lower and one upper bound; otherwise None."""
    known = range_of(x)
    if known is not None and known.least.is_finite and known.greatest.is_finite:
        return known.least, known.greatest
    below, above = _bounds(x)
    return (below[0], above[0]) if len(below) == len(above) == 1 else None


def _bounds(x: Symbol) -> tuple[list[Expr], list[Expr]]:
    """Return the lower and the upper bounds of the symbol, from its declared range and from assumed relations. The
    bound 0 of a declared range is left out if there is another lower bound. A positive symbol without a lower bound has
    the lower bound 0."""
    bounds = [(each.operator[0], *each.sides) for each in assumed()]
    below = [low for mark, low, high in bounds if high == x and mark == "<"]
    below += [low for mark, high, low in bounds if high == x and mark == ">"]
    above = [high for mark, low, high in bounds if low == x and mark == "<"]
    above += [high for mark, high, low in bounds if low == x and mark == ">"]
    known = range_of(x)
    if known is not None:
        below += [known.least] if known.least.is_finite and (known.least != 0 or not below) else []
        above += [known.greatest] if known.greatest.is_finite else []
    return below or ([Integer(0)] if x.is_positive else []), above


def _conditions(real: Relation | None, room: Sequence[Relation]) -> dict[str, Relation]:
    found = {} if real is None else {"condition": real}
    return {**found, **{f"inside_{n}": each for n, each in enumerate(dict.fromkeys(room), 1)}}


def _inside(place: Expr, real: Relation | None, within: Within | None, x: Symbol) -> list[Relation] | None:
    """Return the conditions for the place to lie between the ends of the interval. The list is empty if the place
    always lies between them. Return None if the place never lies between them, or not for the given numbers."""
    below, above = ([within[0]], [within[1]]) if within else _bounds(x)
    if real is not None and below in ([], [0]) and not above:  # every real place is allowed
        return []
    found = []
    width = above[0] - below[0] if len(below) == len(above) == 1 else Integer(1)
    for ahead in (*(place - low for low in below), *(high - place for high in above)):
        sure = _sign_of_distance(ahead, width)
        if sure in (0, -1) or sure is None and sign_known(ahead) in (0, -1):
            return None
        if sure is None:
            found.append(positive(ahead))
    return found


def _sign_of_distance(ahead: Expr, width: Expr) -> int | None:
    """Return the sign of the distance from an end of the interval; None if no sign holds for all values of the symbols.
    The width of the interval is assumed to be positive.
    """
    signs = (sign_for_all(tidied(part)) for part in (ahead, ahead / width))
    return next((sign for sign in signs if sign is not None), None)


def _apart(condition: Relation) -> Relation:
    """Move subtracted terms to the other side: write (k m - b^2/2)/m^2 > 0 as b^2 < 2 k m."""
    above, below = condition.left.as_numer_denom()
    more, less = sides_without_minus((above / abs(above.as_content_primitive()[0])).expand())
    return Relation(less, "<", more) if below.is_positive and more != 0 and less != 0 else condition


def _places(slope: Expr, x: Symbol, within: Within | None) -> list[Zero]:
    """Return zeros of the slope. A zero is left out if its condition is known to be false, for example for the given
    numbers. If x is an angle and there is no interval, the zeros are within one turn. With an interval, only some of
    the zeros of a periodic slope are found."""
    find = zeros_of if within is None else zeros_nearby
    found = find(slope, x) if slope.has(x) else []
    return [Zero(as_one_root(zero.value), zero.exists) for zero in found if truth_known(zero.exists) is not False]


def _with_numbers_beside(expr: Expr, x: Symbol) -> Expr:
    varied = Dummy("x", **x.assumptions0)
    return with_numbers(expr.xreplace({x: varied})).xreplace({varied: x})


# --- the check of the extreme value ---


def _not_exceeded(
    value: Expr,
    x: Symbol,
    top: Expr,
    within: Within | None,
    told: Mapping[str, Relation],
    curved: int,
    place: Expr,
) -> Verdict:
    """Check that no value at places spread over the interval is beyond the extreme value. Without an interval, use
    places on both sides of the extremum."""
    value, top, place = (_with_numbers_beside(e, x) for e in (value, top, place))
    letters = (letters_of(value) | letters_of(top) | letters_of(place)) - {x}
    conditions = [*told.values(), *assumed()]
    letters |= {s for each in conditions for s in letters_of(each.residual)}
    seen = 0
    for point in islice(points(letters, seed_of(value)), 60):
        try:
            if not all(holds(value_at(with_numbers(each.residual), point), each.operator) for each in conditions):
                continue
            best, centre = value_at(top, point), value_at(place, point)
            ends = [value_at(with_numbers(e), point) for e in within] if within else [centre / 2, centre * 2]
            if within is None and not x.is_positive:
                ends = [centre - 1, centre + 1]
            if not ends[0] <= centre <= ends[1]:
                continue
            others = [
                value_at(value, {**point, x: ends[0] + (ends[1] - ends[0]) * Rational(2 * k + 1, 2 * BESIDE)})
                for k in range(BESIDE)
            ]
            own = value_at(value, {**point, x: centre})
        except (Undefined, NoNumber, TypeError):
            continue
        seen += 1
        slack = Rational(1, 10**18) * (1 + Abs(best))
        if any(curved * (best - other) > slack for other in others) or Abs(own - best) > slack:
            where = tuple((str(name), str(number)) for name, number in point.items())
            return Verdict(Grade.REFUTED, "the value at the place is not the extreme value", where)
        if seen == POINTS:
            break
    if not seen:
        return Verdict(Grade.REFUTED, "undefined at every tested point")
    return Verdict(Grade.SAMPLED, f"{seen} points, {BESIDE} places each")
