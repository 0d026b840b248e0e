"""Loss of a contact that can only push, or of the tension of a string, at a place that the motion reaches."""

from __future__ import annotations

from itertools import islice

from sympy import Expr, Integer, Mul, Rational

from derive.algebra.equality import Grade, Verdict
from derive.algebra.expressions import Relation, explicit, rate
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.in_results import Letter, Value, in_results
from derive.mechanics.lagrange.facts import ForceOf
from derive.mechanics.model.constraint import Constrained, Constraint
from derive.mechanics.motion import claims
from derive.mechanics.motion.facts import ByEnergy
from derive.mechanics.motion.turning_points import condition_to_reach, part_of_the_way, squared_by_energy
from derive.solving.attainable import existence
from derive.solving.relations import NotLinear, conditions_told, divided_out, number_of, positive, solved_for_unknown
from derive.solving.unknowns import (
    left_over,
    letter_of,
    mark_for,
    meaning,
    unknown_of,
    with_unknown,
    without_factors_beside,
)
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.known_numbers import with_numbers
from derive.steps.rule import CHECK, Rule, Shown
from derive.steps.signs import of_the_size, sign_for_all, sign_known
from derive.steps.step import Form, Level, Quantity, is_zero

__all__ = ["leaves_contact"]

POINTS = 40
# fractions of the way from the start to the place; the last one is beyond the place
ON_THE_WAY = (Rational(1, 20), Rational(2, 5), Rational(3, 4), Rational(99, 100), Rational(101, 100))


LEAVES_CONTACT = Rule(
    "motion.leaves_contact",
    source="Morin, *Introduction to Classical Mechanics*, section 5.3",
    outcomes={
        "lost": claims.lost(later=False),
        "lost_later": claims.lost(later=True),
        "never": claims.leaves_contact_never,
        "turns_back": claims.turned_back,
        "turns_there": claims.turned_back,
    },
    evidence={"on_the_way": CHECK, "in_numbers": CHECK, "size": CHECK},
    named={"from": claims.pushes_there, "place": claims.force_vanishes_there},
    shown=Shown(conditions=("reached", "existing")),
)


@in_results(
    "leaves",
    "where the force vanishes",
    force="leaves: a contact force, or the tension of a string",
    letter="for: a coordinate, or a function of it such as `cos(theta)`",
    start="start",
)
def leaves_contact(force: Quantity, letter: Letter, start: Value, key: str = "leaves_contact") -> Quantity:
    """Place where contact is lost or a string goes slack: N = 0, solved for one unknown.

    force    the normal force, positive while it pushes, in N; or the tension of a string, positive while it pulls
    letter   the unknown: a coordinate, or a function of a coordinate such as `cos(theta)`
    start    the value of the unknown at the start; the force must be positive at the start or just after it

    If the force depends on a squared rate, q_dot^2 = f(q) by conservation of energy, contact is lost at the place only
    if f is positive there. If the sign of f there depends on the symbols, the page states the condition f > 0.
    Factors of the force that are known to be positive, such as sin(theta) for 0 < theta < pi/2, are omitted.
    Check: the force is zero at the place and positive between the start and the place. Witness: the motion of the
    described system is followed from the start until the multiplier vanishes.
    Outcomes: lost; lost_later (the force is zero at the start, and positive just after it); never (the force is always
    positive); turns_back (the motion does not reach the place where the force would vanish);
    turns_there (the force vanishes only where the motion turns back). For a body that rolls without slipping, the
    page states that the body rolls until the contact is lost.
    Errors: static friction with a coefficient, because the body slips before the normal force vanishes; the force may
    have either sign, as on a rail; the force is not positive at the start, or not linear in the unknown; the motion may
    turn back before the place, or does not begin at `start`.
    Source: Morin, *Introduction to Classical Mechanics*, section 5.3.
    """
    value, unknown = tidied(explicit(number_of(force))), unknown_of("leaves_contact", letter)
    enforcer = _enforcer(force)
    if enforcer in ("rail", "rod", "joint", "motor", "friction"):
        of = enforcer if enforcer == "friction" else f"a {enforcer}"
        message = f"`leaves_contact`: `{force.key}` is the force of {of}, which may have either sign"
        raise Rejected(Complaint("no-contact", message, help="give a normal force or the tension of a string"))
    if sign_known(value) == 1:
        return establish(
            LEAVES_CONTACT,
            None,
            lambda v: Relation(v, ">", 0),
            {"force": force},
            lines=Lines(put_in=Level.STANDARD, result=False, arranged=explicit),
            routes={"size": lambda found: (found.residual, of_the_size(value, found.operator))},
            outcome="never",
            key=key,
        )
    rolls = {"rolls": "rolls"} if _friction_beside(force) is not None else {}
    held, pushing = _held(value, unknown)
    begin = explicit(start)
    at_start = tidied(with_unknown(pushing, unknown, begin))
    if left_over(pushing, unknown) and left_over(with_unknown(pushing, unknown, mark_for(unknown)), unknown):
        raise _unsolvable_contact(force, unknown)
    if sign_known(at_start) != 1:
        message = f"`leaves_contact`: `{force.key}` is not known to be positive at {unknown} = {start}"
        raise Rejected(
            Complaint("no-contact", message, help="give a `start` at which the surfaces touch or the string is taut")
        )
    result = _place_of_loss(force, pushing, unknown)
    solved = result.right
    speed = ByEnergy.behind(force, letter_of(unknown))
    if speed is not None:
        _check_starts_there(force, speed, unknown, begin)
    squared = None if speed is None else squared_by_energy(speed)
    there = None if squared is None else tidied(with_unknown(squared, unknown, solved))
    if squared is not None and there is not None and sign_known(there) in (0, -1):
        return _turns_back(force, unknown, (begin, solved), squared, key)
    reached = None if speed is None else condition_to_reach(force, speed, unknown, solved)
    existing = existence(force, result)

    def on_both_sides(found: Relation) -> tuple[object, object]:
        """Check that N divided by its omitted factors vanishes at the place, and is linear in the unknown between the
        place and the start."""
        place = explicit(found.right)
        u = part_of_the_way()
        on_the_way = tidied(with_unknown(pushing, unknown, place + u * (begin - place)))
        at_place = tidied(with_unknown(pushing, unknown, place))
        return Relation(found.left, found.operator, on_the_way + 7 * at_place), Relation(unknown, "=", u * at_start)

    return establish(
        LEAVES_CONTACT,
        None,
        lambda v: Relation(v, "=", 0),
        {"force": force},
        lines=Lines(
            law=Level.STANDARD,
            put_in=Level.FULL,
            after=[Form(result, "solved", nonzero=(*divided_out(value, unknown, solved), *Mul.make_args(held)))],
            result=False,
            arranged=lambda _: result,
        ),
        routes={
            "on_the_way": on_both_sides,
            **({} if held == 1 else {"in_numbers": lambda found: _pushes_until(found, value, unknown, begin)}),
        },
        outcome="lost_later" if _vanishes_at(held, unknown, start) else "lost",
        phrase_data=PhraseData(
            formulas=conditions_told(existing=existing and _as_positive(existing), reached=reached),
            words={**({"enforcer": enforcer} if enforcer else {}), **rolls},
            named={"from": Relation(unknown, "=", start)},
            outcome_data={
                "unknown": unknown,
                "start": begin,
                **({"squared": squared} if squared is not None else {}),
            },
        ),
        key=key,
    )


def _place_of_loss(force: Quantity, pushing: Expr, unknown: Expr) -> Relation:
    try:
        result = solved_for_unknown(force, pushing, "=", unknown)
    except NotLinear:
        result = None
    if result is None or result.left != unknown:
        message = f"`{force.key}` is not linear in {unknown}, so the place where the force vanishes has no closed form"
        help_line = (
            "ask for this force, and plot it under `drawings` to show where it vanishes; `flight` needs a closed form"
        )
        raise Rejected(Complaint("no-condition", message, help=help_line))
    return result


def _enforcer(force: Quantity) -> str:
    """Return the word for the object that exerts the force, such as "surface" or "string"; empty if unknown."""
    known = (each.fact(ForceOf) for each in (force, *force.ancestors()))
    return next((found.constraint.enforcer for found in known if found is not None), "")


def _friction_beside(force: Quantity) -> Constraint | None:
    """Return the constraint that friction enforces at the contact of a normal force; None without such a constraint.

    Errors: this friction has a coefficient, so the body slips before N vanishes.
    """
    of = next((found.constraint for each in (force, *force.ancestors()) if (found := each.fact(ForceOf))), None)
    places = {(each.of, each.at) for each in of.forces if each.of is not None} if of is not None else set()
    kept = next((known for each in force.ancestors() if (known := each.fact(Constrained)) is not None), None)
    for each in kept.constraints if kept is not None else ():
        if each.enforcer != "friction" or not any((one.of, one.at) in places for one in each.forces):
            continue
        if each.limit is not None:
            most = f"{each.limit.coefficient}*{each.limit.normal}"
            message = (
                f"`leaves_contact`: static friction is at most {most}, so the body slips before the force vanishes"
            )
            help_line = "find the first slip with `slips`, or give a contact that prevents slipping, `{rolling: F}`"
            raise Rejected(Complaint("contradiction", message, help=help_line))
        return each
    return None


def _as_positive(condition: Relation) -> Relation:
    return positive(condition.residual if condition.operator in (">", ">=") else -condition.residual)


def _check_starts_there(force: Quantity, speed: Quantity, unknown: Expr, start: Expr) -> None:
    known = speed.needed(ByEnergy)
    begun = unknown.xreplace({known.coordinate: known.start})
    if not is_zero(tidied(begun - start)):
        message = f"`leaves_contact`: `{force.key}` belongs to a motion from {unknown} = {begun}, not from {start}"
        raise Rejected(Complaint("contradiction", message, help=f"give the start of that motion, `start: {begun}`"))


def _turns_back(force: Quantity, unknown: Expr, ends: tuple[Expr, Expr], squared: Expr, key: str) -> Quantity:
    """The step for a motion that turns back before the place where the force would vanish (N > 0), or at this place (N
    >= 0).

    Outcomes: turns_back, turns_there.
    Source: the same as for `leaves_contact`.
    """
    begin, place = ends
    value = tidied(explicit(number_of(force)))
    there = tidied(with_unknown(squared, unknown, place))
    mark = ">=" if sign_known(there) == 0 else ">"
    ((q, angle),) = meaning(unknown, place).items()
    at_angle = squared.xreplace({q: angle})

    def on_the_way(found: Relation) -> tuple[object, object]:
        """Check that the force is positive between the start and the place where it would vanish."""
        u = part_of_the_way()
        between = tidied(with_unknown(value, unknown, place + u * (begin - place)))
        sure = int(sign_known(between) == 1 and found.operator == mark)
        return found.residual * 0 + sure, Integer(1)

    return establish(
        LEAVES_CONTACT,
        None,
        lambda v: Relation(v, mark, 0),
        {"force": force},
        lines=Lines(law=Level.BRIEF, put_in=Level.STANDARD, result=False, arranged=explicit),
        routes={"on_the_way": on_the_way},
        outcome="turns_there" if mark == ">=" else "turns_back",
        phrase_data=PhraseData(
            formulas={"impossible": (Relation(rate(q) ** 2, "=", there), Relation(rate(q) ** 2, "=", at_angle))},
            named={"place": Relation(unknown, "=", place)},
            outcome_data={"unknown": unknown, "start": begin, "squared": squared},
        ),
        key=key,
    )


def _held(value: Expr, unknown: Expr) -> tuple[Expr, Expr]:
    """Split off factors known to be positive: sin(theta) (a cos(theta) - b) gives sin(theta) and a cos(theta) - b.

    The unknown is cos(theta) here. Positive factors that contain the unknown are split off too, such as
    1/sqrt(b^2 + x^2) for the unknown x.
    """
    u = mark_for(unknown)
    rest, beside = without_factors_beside(with_unknown(value, unknown, u), unknown, u)
    within = [factor for factor in Mul.make_args(rest) if factor.has(u)]
    sure = [factor for factor in within if sign_for_all(factor.xreplace({u: unknown})) == 1]
    held, pushing = Mul(*beside, *sure).xreplace({u: unknown}), (rest / Mul(*sure)).xreplace({u: unknown})
    return (held, pushing) if sign_known(held) == 1 and len(sure) < len(within) else (Integer(1), value)


def _vanishes_at(held: Expr, unknown: Expr, start: Expr) -> bool:
    """Whether a factor that is positive during the motion is zero at the start, as sin(theta) at theta = 0."""
    (letter, there) = next(iter(meaning(unknown, explicit(start)).items()))
    return bool(tidied(held.xreplace({letter: there})) == 0)


def _unsolvable_contact(force: Quantity, unknown: Expr) -> Rejected:
    letter = letter_of(unknown)
    factors = f"factors of unknown sign that contain {letter} in a form other than {unknown}"
    message = f"`leaves_contact`: `{force.key}` has {factors}"
    help_line = f"give the coordinate the range in which it moves, `{letter}: angle in (0, pi/2)`"
    return Rejected(Complaint("no-contact", message, help=help_line))


def _pushes_until(found: Relation, value: Expr, unknown: Expr, start: Expr) -> Verdict:
    """Check numerically, along the coordinate, that the force is positive before the place and negative beyond it."""
    letter = letter_of(unknown)
    value, begin, end = (with_numbers(each) for each in (value, start, explicit(found.right)))
    letters = letters_of(value) | letters_of(begin) | letters_of(end)
    seen = 0
    for point in islice(points(letters - {letter}, seed_of(value)), POINTS):
        try:
            first, last = (value_at(_inverse(unknown, each), point) for each in (begin, end))
            if not (first.is_real and last.is_real) or first == last:
                continue
            there = [value_at(value, {**point, letter: first + (last - first) * way}) for way in ON_THE_WAY]
        except (Undefined, NoNumber, TypeError):
            continue
        if not all(force > 0 for force in there[:-1]) or not there[-1] < 0:
            return Verdict(Grade.REFUTED, "the force is not positive before the place, or not negative beyond it")
        seen += 1
    return Verdict(Grade.SAMPLED, f"{seen} points") if seen else Verdict(Grade.REFUTED, "undefined at all points tried")


def _inverse(unknown: Expr, value: Expr) -> Expr:
    return next(iter(meaning(unknown, value).values()))
