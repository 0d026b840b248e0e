"""What must be true for each word that chooses a sentence about what carries a result on to what is asked."""

from __future__ import annotations

from contextlib import suppress
from itertools import islice
from typing import Any

from sympy import (
    Dummy,
    Expr,
    Integer,
    MatrixBase,
    Poly,
    Rational,
    Symbol,
    cos,
    diff,
    factor_list,
    gcd_list,
    oo,
    sign,
    sin,
)

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from derive.algebra.ranges import range_of
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.algebra.tidy import tidied
from derive.mechanics.outcomes.signs import MARK_OF, points_as_assumed, same_equation
from derive.mechanics.outcomes.signs import is_so as holds_at
from derive.steps.known_numbers import sign_known, with_numbers
from derive.steps.outcomes import Judged, Predicate, outcomes_of
from derive.steps.record import assumed
from derive.steps.step import is_zero

TRIED, LITTLE = 8, 1e-12
_CAN_BE = {"=": (0,), "!=": (1, -1), ">": (1,), "<": (-1,), ">=": (0, 1), "<=": (0, -1)}


def _one_of(alone: bool, first: bool) -> Predicate:
    """Of how many unknowns this is which."""

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


def _single(facts: Judged) -> bool:
    return bool(_polynomial(facts).degree() == 1)


def _double(facts: Judged) -> bool:
    return facts.inputs["count"] == 1 and is_zero(_slope_there(facts))


def _only(facts: Judged) -> bool:
    """Another root is there, at which the polynomial divided by this one vanishes; it is complex or not positive."""
    alone = facts.inputs["count"] == 1 and _polynomial(facts).degree() > 1 and not is_zero(_slope_there(facts))
    return alone and all(_only_there(facts, point) for point in islice(points(_letters(facts), 4099), TRIED))


def _letters(facts: Judged) -> set[Any]:
    return letters_of(_polynomial(facts).as_expr()) - {facts.inputs["gen"]}


def _only_there(facts: Judged, point: Any) -> bool:
    """In numbers no other root is one that could be taken."""
    own = complex(value_at(explicit(facts.result), point))
    there = Poly(_polynomial(facts).as_expr().xreplace(point), facts.inputs["gen"])
    numbers = sorted((complex(root) for root in there.nroots(n=20, maxsteps=200)), key=lambda root: abs(root - own))
    unknown, size = facts.inputs["unknown"], max(map(abs, numbers)) or 1
    known, limited = range_of(unknown), isinstance(unknown, sin | cos)
    for other in numbers[1:]:
        beside = limited and abs(other) > 1 or known is not None and not known.least < other.real < known.greatest
        if abs(other.imag) < LITTLE * size and (other.real > 0 or facts.inputs["positive"] == 0) and not beside:
            return abs(own.imag) > LITTLE * size
    return True


def _of_several(first: bool) -> Predicate:
    def is_so(facts: Judged) -> bool:
        place, roots = int(facts.inputs["place"]), [explicit(root) for root in facts.inputs["roots"]]
        another = all(not is_zero(explicit(facts.result) - root) for n, root in enumerate(roots) if n != place)
        return facts.inputs["count"] > 1 and (place == 0) == first and another

    return is_so


def _where_the_coefficients_last(predicate: Predicate) -> Predicate:
    """Where all coefficients vanish, any number is a root: the sentence excludes that, or its condition does."""

    def is_so(facts: Judged) -> bool:
        known = [facts.inputs[role] for role in ("excluded", "condition") if role in facts.inputs]
        told = [each.left for each in known if each.mark in ("!=", ">")]
        factors = {f for each in told for f, _ in factor_list(each)[1]}
        common = factor_list(gcd_list(_polynomial(facts).coeffs()))[1]
        open_ = [f for f, _ in common if sign_known(f) is None and not f.is_nonzero]
        return bool(predicate(facts)) and all(f in factors or -f in factors for f in open_)

    return is_so


def _absent(facts: Judged) -> bool:
    return isinstance(facts.result, Relation) and sign_known(facts.result.left) in _CAN_BE[facts.result.mark]


def _beyond_one(facts: Judged) -> bool:
    """By numbers for the letters: the cosine is greater than 1, or less than -1."""
    value = with_numbers(facts.result.left)
    letters = {letter: Rational(7, 5) for letter in value.free_symbols}
    there = value.xreplace(letters).evalf(20)
    return bool(there > 1 if facts.result.mark == ">" else there < -1)


def _put_in(only_values: bool) -> Predicate:
    def is_so(facts: Judged) -> bool:
        identity = isinstance(facts.result, Relation) and facts.result.mark == "=" and is_zero(facts.result.residual)
        return not identity and only_values == (not any(role.startswith("other_") for role in facts.inputs))

    return is_so


def _identity(facts: Judged) -> bool:
    return isinstance(facts.result, Relation) and facts.result.mark == "=" and is_zero(facts.result.residual)


def _is_divided_as_told(facts: Judged) -> bool:
    """What must not vanish divides the difference, and the quotient still vanishes where the result says."""
    excluded = facts.inputs.get("excluded")
    if excluded is None:
        return True
    left, right = explicit(facts.result).sides
    quotient = tidied(facts.inputs["difference"] / excluded.residual)
    return excluded.mark == "!=" and quotient.has(*left.free_symbols) and is_zero(quotient.subs(left, right))


def _compared(squared: bool) -> Predicate:
    def is_so(facts: Judged) -> bool:
        left, right = facts.result.sides
        unknown = facts.inputs["unknown"]
        alone = left == (unknown**2 if squared else unknown) and not explicit(right).has(left)
        limited = "existing" not in facts.inputs or isinstance(unknown, sin | cos)  # nothing else is between -1 and 1
        return bool(alone) and limited and _is_divided_as_told(facts)

    return is_so


def _always(wanted: bool) -> Predicate:
    """Whether the sign that the difference has for all values of the letters is one that was asked for."""

    def is_so(facts: Judged) -> bool:
        held = facts.inputs["sign"] in _CAN_BE[MARK_OF[facts.words["comparison"]]]
        difference = with_numbers(facts.inputs["difference"])
        letters = sorted(difference.free_symbols, key=str)
        there = difference.subs({letter: Integer(3 + 2 * i) / 4 for i, letter in enumerate(letters)}).evalf(20)
        sign = 0 if is_zero(facts.inputs["difference"]) else (1 if there > 0 else -1)
        return held == wanted and bool(sign == facts.inputs["sign"] or sign in _CAN_BE[facts.result.mark])

    return is_so


def _as_let(equation: bool, reason: bool) -> Predicate:
    """An equation has no letter, and a value has one."""

    def is_so(facts: Judged) -> bool:
        letter = facts.symbol is None if equation else facts.symbol is not None
        return letter and isinstance(facts.result, Relation) == equation and ("because" in facts.words) == reason

    return is_so


def _near(*places: Any) -> Predicate:
    """Whether something is left out, and the letter goes to one of these, or to none of those that have a word."""

    def is_so(facts: Judged) -> bool:
        to = facts.inputs["to"]
        there = to in places if places else to not in (0, oo, -oo)
        return there and not _nothing_left_out(facts)

    return is_so


def _nothing_left_out(facts: Judged) -> bool:
    return is_zero(explicit(facts.inputs["value"]) - facts.result)


def _is_nothing(facts: Judged) -> bool:
    """The limit is zero, and what goes there is not."""
    return is_zero(facts.result) and not _nothing_left_out(facts)


def _goes_as(wanted: int) -> Predicate:
    """By the result alone, which is one power of what is small: it stays, vanishes with it, or grows."""

    def is_so(facts: Judged) -> bool:
        x, to = facts.inputs["x"], facts.inputs["to"]
        small = 1 / x if to in (oo, -oo) else x - to
        entries = list(facts.result) if isinstance(facts.result, MatrixBase) else [facts.result]
        slopes = [tidied(diff(entry, x) / diff(small, x) * small / entry) for entry in entries if entry != 0]
        return (
            not _nothing_left_out(facts)
            and bool(slopes)
            and all(sign(each) == wanted and not each.has(x) for each in slopes)
        )

    return is_so


def _bent(sign: int) -> Predicate:
    """By the values a little to both sides of the place, in numbers: they are below it, or above."""

    def is_so(facts: Judged) -> bool:
        x = Dummy("x", **facts.inputs["letter"].assumptions0)  # that which varies has no number
        varied = {facts.inputs["letter"]: x}
        value, place = (with_numbers(facts.inputs[role].xreplace(varied)) for role in ("value", "place"))
        told = [c for role, c in facts.inputs.items() if role == "condition" or role.startswith("inside_")]
        conditions = [with_numbers(explicit(condition).xreplace(varied)) for condition in (*told, *assumed())]
        letters = {s for e in (value, place, *(c.residual for c in conditions)) for s in letters_of(e)} - {x}
        seen = []
        for point in islice(points(letters, seed_of(value, place)), 40):
            try:
                there = value_at(place, point)
                if all(holds_at(c, {**point, x: there}) for c in conditions):
                    seen.append(_beside(value, x, there, point))
            except (Undefined, NoNumber, TypeError):
                continue
        return bool(seen) and all(sign * apart > 0 for apart in seen[:3])

    return is_so


def _beside(value: Expr, x: Symbol, place: Expr, point: Any) -> Expr:
    near = abs(place) / 10**6 + Rational(1, 10**9)
    there, *others = (value_at(value, {**point, x: place + k * near}) for k in (0, 1, -1))
    return min(there - other for other in others) if there > others[0] else max(there - other for other in others)


def _released(at_rest: bool) -> Predicate:
    return lambda facts: is_zero(facts.inputs["initial"]) == at_rest


def _isochronous(wanted: bool) -> Predicate:
    """The acceleration is proportional to the coordinate, or it is not."""

    def is_so(facts: Judged) -> bool:
        q, a = facts.inputs["coordinate"], facts.inputs["acceleration"]
        return is_zero(a - a.diff(q).subs(q, 0) * q) == wanted

    return is_so


def _free_motion(wanted: str) -> Predicate:
    """By the roots of the characteristic equation, as far as the letters decide."""

    def is_so(facts: Judged) -> bool:
        a, b, c = facts.inputs["linear"]
        if is_zero(a):
            return wanted == ("accumulates" if is_zero(c) else _unless_it_grows("relaxes", c / b))
        if is_zero(c):
            return wanted == ("uniform" if is_zero(b) else _unless_it_grows("slows", b / a))
        stiffness, sign = sign_known(c / a), sign_known((b / a) ** 2 - 4 * c / a)
        if stiffness == -1:
            return wanted == "runs_away"
        if is_zero(b):
            return wanted == "oscillates" and stiffness == 1
        fitting = {-1: "underdamped", 0: "critically_damped", 1: "overdamped"}
        if sign is not None:
            return wanted == fitting[sign]
        return any(
            _is_its_condition(facts, s, (b / a) ** 2 - 4 * c / a) for s, word in fitting.items() if word == wanted
        )

    return is_so


def _is_its_condition(facts: Judged, wanted: int, discriminant: Expr) -> bool:
    """The border of the condition is where the discriminant vanishes; with numbers for the letters it is on the side
    of the border on which the discriminant has this sign."""
    condition = explicit(facts.inputs["condition"])
    if not same_equation(condition.residual, discriminant) or (condition.mark == "=") != (wanted == 0):
        return False
    if wanted == 0:
        return True
    seen = set()
    for point in points_as_assumed(letters_of(condition.residual) | letters_of(discriminant), 0):
        with suppress(Undefined, NoNumber):
            seen.add(holds_at(condition, point) == (value_at(discriminant, point) * wanted > 0))
    return condition.mark in (">", "<") and seen == {True}


def _unless_it_grows(word: str, rate: Expr) -> str:
    return "runs_away" if sign_known(rate) == -1 else word


def _loses(wanted: bool) -> Predicate:
    return lambda facts: is_zero(facts.inputs["loss"]) != wanted


def _in_step(*signs: int | None) -> Predicate:
    """Without loss, with the force or against it by the sign of what is left of the stiffness."""
    return lambda facts: is_zero(facts.inputs["loss"]) and sign_known(facts.inputs["stiff"]) in signs


_TABLE: dict[str, dict[str, Predicate]] = {
    "answers.let": {
        "generic": _as_let(False, False),
        "because": _as_let(False, True),
        "equation": _as_let(True, False),
        "equation_because": _as_let(True, True),
    },
    "answers.solved_for": {
        "alone": _one_of(True, True),
        "several": _one_of(False, True),
        "following": _one_of(False, False),
    },
    "answers.roots": {
        word: _where_the_coefficients_last(predicate)
        for word, predicate in (
            ("single", _single),
            ("double", _double),
            ("only", _only),
            ("several", _of_several(True)),
            ("following", _of_several(False)),
        )
    },
    "answers.roots_absent": {"none": _absent, "none_positive": _absent, "none_reached": _beyond_one},
    "answers.put_in": {
        "results": _put_in(False),
        "values": _put_in(True),
        "zero": lambda facts: _put_in(True)(facts) and is_zero(facts.result),
        "identity": _identity,
        "again": lambda facts: bool(equal(facts.result, facts.inputs["found"])),
    },
    "answers.where": {
        "solved": _compared(False),
        "squared": _compared(True),
        "always": _always(True),
        "never": lambda facts: _always(False)(facts) and not is_zero(facts.inputs["difference"]),
        "equal": lambda facts: _always(False)(facts) and is_zero(facts.inputs["difference"]),
    },
    "answers.limiting_case": {
        "finite": lambda facts: _is_nothing(facts) or _goes_as(0)(facts),
        "vanishes": _goes_as(1),
        "diverges": _goes_as(-1),
        "small": _near(Integer(0)),
        "large": _near(oo, -oo),
        "near": _near(),
        "exact": _nothing_left_out,
    },
    "answers.extremum_place": {"greatest": _bent(1), "least": _bent(-1)},
    "answers.extremum_value": {"greatest": _bent(1), "least": _bent(-1)},
    "motion.energy_kept": {"from_rest": _released(True), "moving": _released(False)},
    "motion.period_by_energy": {"exact": _isochronous(True), "expanded": _isochronous(False)},
    "vibrations.solution": {
        word: _free_motion(word)
        for word in (
            "oscillates",
            "underdamped",
            "critically_damped",
            "overdamped",
            "runs_away",
            "uniform",
            "relaxes",
            "slows",
            "accumulates",
        )
    },
    "vibrations.steady_amplitude": {"damped": _loses(True), "undamped": _loses(False)},
    "vibrations.lag": {"damped": _loses(True), "undamped": _in_step(1, None), "opposite": _in_step(-1)},
}

for _rule, _predicates in _TABLE.items():
    outcomes_of(_rule, _predicates)
