"""What must be true for each word that chooses a sentence about a contact that is lost, or that is not."""

from __future__ import annotations

from contextlib import suppress
from itertools import islice

from sympy import Expr, Rational, Symbol, acos, asin, atan, cos, sin, tan

from derive.algebra.expressions import explicit
from derive.algebra.samples import NoNumber, Undefined, letters_of, seed_of, value_at
from derive.mechanics.outcomes.signs import is_so as holds_at
from derive.mechanics.outcomes.signs import points_as_assumed, sign_is
from derive.steps.known_numbers import with_numbers
from derive.steps.outcomes import Judged, Predicate, outcomes_of

TRIED = 8


def _letter_at(unknown: Expr, start: Expr) -> tuple[Expr, Expr]:
    if isinstance(unknown, Symbol):
        return unknown, start
    if unknown.is_Pow:
        return unknown.base, start ** (1 / unknown.exp)
    return unknown.args[0], {cos: acos, sin: asin, tan: atan}[unknown.func](start)


def _vanishing_force(facts: Judged) -> bool:
    return facts.result.mark == "=" and bool(facts.result.left == facts.inputs["unknown"])


def _lost(later: bool) -> Predicate:
    """By the force at the start, with numbers for the letters: it is positive there, or it is zero."""

    def is_so(facts: Judged) -> bool:
        letter, start = _letter_at(facts.inputs["unknown"], facts.inputs["start"])
        force = with_numbers(explicit(facts.inputs["force"]).subs(letter, start))
        seen = []
        for point in islice(points_as_assumed(letters_of(force), seed_of(force)), 8):
            try:
                seen.append(value_at(force, point))
            except (Undefined, NoNumber):
                continue
        there = [value == 0 if later else value > 0 for value in seen if value.is_real]
        return _vanishing_force(facts) and bool(there) and all(there) and _gets_there_as_told(facts)

    return is_so


def _gets_there_as_told(facts: Judged) -> bool:
    """By numbers for the letters: the squared rate is positive at the place just where its condition holds."""
    told = facts.inputs.get("reached")
    if "squared" not in facts.inputs:
        return told is None
    there = explicit(facts.inputs["squared"]).subs(*_letter_at(*facts.result.sides))
    if told is not None and not explicit(told.residual).free_symbols <= there.free_symbols:
        return False
    value = with_numbers(there)
    for point in islice(points_as_assumed(letters_of(value), seed_of(value)), TRIED):
        with suppress(Undefined, NoNumber):
            number = value_at(value, point)
            if number.is_real and bool(number > 0) != (told is None or holds_at(with_numbers(told), point)):
                return False
    return True


def _turned_back(facts: Judged) -> bool:
    """With numbers for the letters: the force vanishes at the place and the squared rate is negative there, or zero,
    while at the start the force pushes and the squared rate is not negative."""
    just_there = facts.result.mark == ">="
    unknown, squared, force = (facts.inputs[role] for role in ("unknown", "squared", "force"))
    ends = [_letter_at(unknown, end) for end in (facts.inputs["start"], facts.inputs["place"].right)]
    values = [with_numbers(explicit(each).subs(*end)) for end in ends for each in (force, squared)]
    seen = 0
    for point in islice(points_as_assumed(set().union(*map(letters_of, values)), seed_of(*values)), 8):
        try:
            pushing, moving, last, beyond = (value_at(each, point) for each in values)
        except (Undefined, NoNumber):
            continue
        gets_there = abs(beyond) < Rational(1, 10**9)
        if not (pushing > 0 and moving >= 0 and abs(last) < Rational(1, 10**9)) or gets_there != just_there:
            return False
        if not (gets_there or beyond < 0):
            return False
        seen += 1
    return seen > 0


outcomes_of(
    "motion.leaves_contact",
    {
        "lost": _lost(later=False),
        "lost_later": _lost(later=True),
        "never": sign_is(1, lambda facts: facts.inputs["force"]),
        "turns_back": _turned_back,
        "turns_there": _turned_back,
    },
)
