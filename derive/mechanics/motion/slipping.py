"""The condition for static friction to suffice, and the place of the first slip along a motion of one coordinate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from sympy import Abs, Expr, Integer, Mul, Symbol

from derive.algebra.equality import Verdict
from derive.algebra.expressions import Factors, Relation, explicit
from derive.algebra.samples import letters_of, value_at
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.motion import claims
from derive.mechanics.motion.facts import ByEnergy
from derive.mechanics.motion.first_slip import (
    Motion,
    index_of_first,
    is_first,
    is_never_reached,
    places_of_limit,
    sign_of_friction,
    unless_sure,
)
from derive.mechanics.motion.static_friction import (
    Friction,
    condition_to_push,
    friction_of,
    sampled,
    solved_for_limit,
    solved_line,
)
from derive.mechanics.motion.turning_points import condition_to_reach, squared_by_energy
from derive.solving.attainable import existence
from derive.solving.relations import conditions_told, positive
from derive.solving.unknowns import letter_of, unknown_of
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.known_numbers import with_numbers
from derive.steps.record import changes, named_coordinates
from derive.steps.rule import CHECK, Rule
from derive.steps.signs import holds, sign_for_all, sign_known
from derive.steps.step import Level, Quantity, is_zero

__all__ = ["slips"]

SLIPS = Rule(
    "motion.slips",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 3",
    outcomes={
        "needs_none": claims.needs_no_friction,
        "sticks": claims.sticks_where(None),
        "always": claims.sticks_where(True),
        "cannot": claims.sticks_where(False),
        "slips": claims.slips_first,
        "slips_squared": claims.slips_first,
        "at_once": claims.slips_at_once,
        "stays": claims.never_slips,
    },
    evidence={"points": CHECK, "on_the_way": CHECK, "size": CHECK},
    statements=[
        claims.friction_and_normal_of_one_contact,
        claims.slips_in_the_stated_sense,
        claims.names_its_slider,
    ],
    named={"from": claims.start_of_motion},
)


def slips(friction: Quantity, normal: Quantity, letter: Symbol | Expr, key: str = "slips") -> tuple[Quantity, ...]:
    """Condition for static friction to suffice, |F| <= mu_s N, solved for one symbol; or the place of the first slip.

    friction   the friction F of a contact with a coefficient mu_s of static friction, in newtons
    normal     the normal force N of the same contact in the same state, in newtons
    letter     the unknown: a symbol, or a function of a symbol such as `tan(alpha)`

    Along a motion with conservation of energy, the unknown may be the coordinate, or a function of the coordinate. The
    result is then the first place with |F| = mu_s N that the motion reaches. In other cases the result is the condition
    |F| <= mu_s N. If the sign of F depends on the symbols, there is one condition for each direction of F, F <= mu_s N
    and -F <= mu_s N. The sentence states the direction of the slip if this direction is known.
    Check: for random numbers, the result and the unsolved relation between F and mu_s N are both true or both false.
    Along a motion, |F| < mu_s N from the start to the place, and |F| > mu_s N just beyond the place. Witness: the
    condition is tested in states of the described system, or the motion is followed until the body begins to slip.
    Outcomes: sticks (the condition depends on the symbols), always (it is always true), cannot (it is never true);
    needs_none (F = 0); slips (the first place with |F| = mu_s N), slips_squared (the same, found after squaring),
    at_once (at the start |F| > mu_s N), stays (the motion reaches no place with |F| = mu_s N).
    Errors: no coefficient of static friction; the surface does not push; no solution in closed form; the place depends
    on the values of the symbols; the friction has its largest value at the start of the motion.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 3.
    """
    contact, unknown = friction_of(friction, normal), unknown_of("slips", letter)
    if is_zero(contact.F):
        return (_needs_none(contact, key),)
    speed = _speed_behind((friction, normal), unknown)
    if speed is not None:
        return (_along_motion(contact, unknown, speed, key),)
    sign = sign_known(contact.N)
    if sign in (0, -1):
        message = f"`slips`: the surface does not push, since `{normal.key}` is not positive"
        raise Rejected(Complaint("no-contact", message))
    sign = sign_known(contact.F)
    if sign is not None:
        return (_condition(contact, unknown, sign, key, alone=True),)
    return tuple(_condition(contact, unknown, side, f"{key}_{n}", alone=False) for n, side in ((1, 1), (2, -1)))


def _speed_behind(forces: Sequence[Quantity], unknown: Expr) -> Quantity | None:
    """Return the step q_dot^2 = f(q) from which a force was derived, if the unknown contains q; otherwise None."""
    q, behind = letter_of(unknown), (ancestor for force in forces for ancestor in force.ancestors())
    return next((each for each in behind if (known := each.fact(ByEnergy)) and known.coordinate == q), None)


# --- in one state ---


def _needs_none(contact: Friction, key: str) -> Quantity:
    return establish(
        SLIPS,
        None,
        lambda F, *_: Relation(F, "=", 0),
        contact.roles,
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"size": lambda found: (found.residual, Integer(0))},
        outcome="needs_none",
        phrase_data=PhraseData(words=contact.limit.words),
        key=key,
    )


def _condition(contact: Friction, unknown: Expr, side: int, key: str, alone: bool) -> Quantity:
    """Return the condition for the body not to slip in one direction: side*F <= mu_s*N, where `side` is 1 or -1. If
    this is known to be false, return side*F > mu_s*N instead."""
    excess = contact.excess(side)
    known = sign_for_all(excess)
    result = solved_for_limit(contact, side, "<=", unknown) if known is None else None
    if result is not None and (found := _sign_of_difference(result)) is not None:
        known, result = -1 if holds(Integer(found), result.operator) else 1, None  # such as mu <= -1
    mark = ">" if known == 1 else "<="
    moving = changes(contact.F - contact.N, named_coordinates())
    return establish(
        SLIPS,
        None,
        lambda F, N, mu: Relation(side * F, mark, Factors(mu, N)),
        contact.roles,
        lines=Lines(
            law=Level.STANDARD,
            put_in=Level.STANDARD,
            after=[] if result is None else [solved_line(contact, result, excess)],
            result=False,
            arranged=explicit if result is None else lambda _: result,
        ),
        routes={"points": lambda found: _same_truth(found, contact, side, mark)},
        outcome="sticks" if known is None else "cannot" if known == 1 else "always",
        phrase_data=PhraseData(
            words={**contact.words(side), **({"seen": "state"} if moving is not None else {})},
            formulas=conditions_told(pushing=condition_to_push(contact.N)),
            outcome_data={"side": Integer(side), "alone": Integer(alone)},
        ),
        key=key,
    )


def _sign_of_difference(relation: Relation) -> int | None:
    left, right = (sign_for_all(tidied(explicit(side))) for side in relation.sides)
    if {left, right} == {1, -1}:
        return left
    return sign_for_all(tidied(relation.residual))


def _same_truth(found: Relation, contact: Friction, side: int, mark: str) -> Verdict:
    """Check for random numbers that the result is equivalent to side*F <= mu_s*N; if `mark` is ">", to
    side*F > mu_s*N."""
    F, N, mu, difference = map(with_numbers, (contact.F, contact.N, contact.limit.coefficient, found.residual))

    def is_so(point: Mapping[Symbol, Expr]) -> bool | None:
        if not value_at(mu * N, point) > 0:
            return None
        wanted = holds(value_at(side * F - mu * N, point), mark)
        return holds(value_at(difference, point), found.operator) == wanted

    return sampled(is_so, letters_of(F) | letters_of(N) | letters_of(mu) | letters_of(difference), contact.F)


# --- along a motion ---


def _along_motion(contact: Friction, unknown: Expr, speed: Quantity, key: str) -> Quantity:
    motion = Motion(contact, unknown, speed)
    if sign_known(tidied(contact.N.xreplace({motion.q: motion.start}))) in (0, -1):
        message = f"`slips`: the surface does not push at the start, since `{contact.normal.key}` is not positive there"
        raise Rejected(Complaint("no-contact", message))
    at_start = [tidied(contact.excess(side).xreplace({motion.q: motion.start})) for side in (1, -1)]
    signs = [sign_known(each) for each in at_start]
    if 0 in signs:
        message = f"`slips`: at the start of the motion `{contact.friction.key}` already has its largest possible value"
        raise Rejected(Complaint("no-contact", message, help="give the motion a different start"))
    if 1 in signs:
        return _at_once(motion, 1 if signs[0] == 1 else -1, key)
    places, squared = places_of_limit(motion)
    first = index_of_first(motion, places)
    open_ = [-each for each, sign in zip(at_start, signs, strict=True) if sign is None]
    starts = positive(Mul(*open_)) if open_ else None
    if first is None:
        return _stays(motion, starts, key)
    solved = places[first]
    result = Relation(unknown, "=", solved)
    side = sign_of_friction(motion, solved)
    told = conditions_told(
        existing=unless_sure(existence(contact.friction, result)),
        reached=unless_sure(condition_to_reach(contact.friction, speed, unknown, solved)),
        starts=starts,
    )
    held, most = side * contact.friction.symbol, Factors(contact.limit.coefficient, contact.normal.symbol)
    border = (Relation(held, "=", most), Relation(held - explicit(most), "=", 0)) if squared else None
    return establish(
        SLIPS,
        None,
        (lambda *_: result) if squared else (lambda F, N, mu: Relation(side * F, "=", Factors(mu, N))),
        contact.roles,
        lines=Lines(
            law=Level.STANDARD,
            put_in=None if squared else Level.FULL,
            after=[] if squared else [solved_line(contact, result, contact.excess(side))],
            result=False,
            arranged=lambda _: result,
        ),
        routes={"on_the_way": lambda found: is_first(motion, found.right)},
        outcome="slips_squared" if squared else "slips",
        phrase_data=PhraseData(
            formulas={**told, **({"border": border} if border is not None else {})},
            words=contact.words(side),
            named={"from": Relation(motion.q, "=", motion.start)},
            outcome_data=_data(motion, side),
        ),
        key=key,
        parents=[speed],
    )


def _data(motion: Motion, side: int = 0) -> dict[str, Expr]:
    return {
        "unknown": motion.unknown,
        "coordinate": motion.q,
        "begin": motion.start,
        "start": motion.unknown.xreplace({motion.q: motion.start}),
        "squared": squared_by_energy(motion.speed),
        "side": Integer(side),
    }


def _at_once(motion: Motion, side: int, key: str) -> Quantity:
    contact, start = motion.contact, {motion.q: motion.start}
    F, N = (tidied(each.xreplace(start)) for each in (contact.F, contact.N))
    return establish(
        SLIPS,
        None,
        lambda v, n, mu: Relation(side * v, ">", Factors(mu, n)),
        contact.roles,
        lines=Lines(law=Level.BRIEF, put_in=None, result=False, arranged=explicit),
        routes={"on_the_way": lambda found: (found.residual.xreplace(start), side * F - contact.limit.coefficient * N)},
        outcome="at_once",
        phrase_data=PhraseData(
            words=contact.words(side),
            named={"from": Relation(motion.q, "=", motion.start)},
            outcome_data=_data(motion, side),
        ),
        key=key,
        parents=[motion.speed],
    )


def _stays(motion: Motion, starts: Relation | None, key: str) -> Quantity:
    """The step for a body that never slips: the motion reaches no place where the friction has its largest value."""
    contact = motion.contact
    return establish(
        SLIPS,
        None,
        lambda F, N, mu: Relation(Abs(F), "<", Factors(mu, N)),
        contact.roles,
        lines=Lines(law=Level.BRIEF, put_in=None, result=False, arranged=explicit),
        routes={"on_the_way": lambda found: is_never_reached(motion)},
        outcome="stays",
        phrase_data=PhraseData(
            words=contact.limit.words,
            formulas=conditions_told(starts=starts),
            named={"from": Relation(motion.q, "=", motion.start)},
            outcome_data=_data(motion),
        ),
        key=key,
        parents=[motion.speed],
    )
