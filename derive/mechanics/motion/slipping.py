"""Static friction reaches its largest value: |F| = mu_s N, for constant forces or along a motion of one coordinate."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice

from sympy import Abs, Add, Dummy, Expr, Integer, Mul, Pow, Rational, Symbol, cos, sin, sqrt, tan, together

from derive.algebra.equality import Grade, Verdict
from derive.algebra.expressions import Factors, Relation, explicit
from derive.algebra.ranges import range_of
from derive.algebra.samples import NoNumber, Undefined, letters_of, points, seed_of, value_at
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.model.constraint import Constrained, Constraint, StaticLimit
from derive.mechanics.motion import claims
from derive.mechanics.motion.facts import ByEnergy
from derive.mechanics.motion.turning_points import condition_to_reach, squared_by_energy
from derive.solving.attainable import existence
from derive.solving.presentation import presented
from derive.solving.relations import (
    TURNED,
    conditions_told,
    divided_out,
    number_of,
    positive,
    solved_for_unknown,
    unsolvable,
)
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
from derive.steps.record import changes, named_coordinates
from derive.steps.rule import CHECK, Rule
from derive.steps.signs import holds, sign_for_all, sign_known
from derive.steps.step import Form, Level, Quantity, is_zero

__all__ = ["slips"]

POINTS, PARTS = 40, [Rational(n, 16) for n in range(1, 16)]  # sets of numbers, and parts of the distance to a place
BEYOND = Rational(101, 100)
HELP = "describe the contact with `friction: {static: mu_s, force: F}`, and give F, or F with results substituted"

SLIPS = Rule(
    "motion.slips",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, section 3.4",
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
    statements=[claims.friction_and_normal_of_one_contact, claims.slips_in_the_stated_sense],
    named={"from": claims.start_of_motion},
)


@dataclass(frozen=True)
class _Friction:
    """The friction F and the normal force N of one contact, as functions of the same letters."""

    friction: Quantity
    normal: Quantity
    constraint: Constraint
    limit: StaticLimit

    @property
    def F(self) -> Expr:
        return tidied(explicit(number_of(self.friction)))

    @property
    def N(self) -> Expr:
        return tidied(explicit(number_of(self.normal)))

    @property
    def roles(self) -> dict[str, Quantity | Expr]:
        return {"friction": self.friction, "normal": self.normal, "coefficient": self.limit.coefficient}

    def excess(self, side: int) -> Expr:
        """How much the friction, in one sense, exceeds its largest value, N."""
        return tidied(side * self.F - self.limit.coefficient * self.N)

    def sense(self, side: int) -> dict[str, str]:
        """Return in words where the body would slip, if F has this sign: against the friction on the body."""
        force = next((each for each in self.constraint.forces if each.of is not None), None)
        signs = [sign_known(-side * c) for c in force.direction] if force is not None else []
        if len(signs) == 2 and signs[1] is not None and (signs[1] != 0 or signs[0]):
            words = {1: "up", -1: "down"} if signs[1] else {1: "right", -1: "left"}
            return {"sense": words[signs[1] or signs[0]]}
        return {}


def slips(friction: Quantity, normal: Quantity, letter: Symbol | Expr, key: str = "slips") -> tuple[Quantity, ...]:
    """Condition for static friction to suffice, |F| <= mu_s N, solved for one letter; or the place where it ends.

    friction   the friction F of a contact with a coefficient mu_s of static friction, N
    normal     the normal force N of the same contact in the same state, N
    letter     the unknown: a letter, or a function of a letter such as `tan(alpha)`
    If the letter is the coordinate of a motion whose forces follow from conservation of energy, the result is the first
    place with |F| = mu_s N that the motion reaches from its start. Otherwise the result is the condition |F| <= mu_s N;
    if the sign of F depends on the symbols, there is a condition for each sense, F <= mu_s N and -F <= mu_s N. The
    sentence states the sense of the slip: the body slips against the friction that acts on it. Since |F| <= mu_s N, the
    body slips before N vanishes, unless F = 0.
    Check: at random numbers, the result and |F| <= mu_s N are both true or both false; along a motion, |F| < mu_s N
    from the start to the place, and |F| > mu_s N beyond the place. Witness: the motion of the described system.
    Outcomes: sticks, always, cannot (the condition is never true); needs_none (F = 0); slips, slips_squared (solved
    after squaring), at_once (at the start |F| > mu_s N), stays (the motion does not reach such a place).
    Errors: no coefficient of static friction; the surface does not push; no solution in closed form; the place depends
    on the values of the symbols.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, section 3.4.
    """
    contact, unknown = _friction_of(friction, normal), unknown_of("slips", letter)
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


def _friction_of(friction: Quantity, normal: Quantity) -> _Friction:
    constraint = static_friction(friction)
    assert constraint.limit is not None
    if normal.symbol != constraint.limit.normal:
        message = f"`slips`: `{normal.key}` is not the normal force of this contact"
        raise Rejected(Complaint("different-subjects", message, help=f"give {constraint.limit.normal}"))
    return _Friction(friction, normal, constraint, constraint.limit)


def static_friction(friction: Quantity) -> Constraint:
    """Return the constraint whose force is this friction, with its largest value."""
    for ancestor in friction.ancestors():
        kept = ancestor.fact(Constrained)
        for each in kept.constraints if kept is not None else ():
            if each.force == friction.symbol and each.limit is not None:
                return each
    message = f"`{friction.key}` is not the friction of a contact with a coefficient of static friction"
    raise Rejected(Complaint("no-contact", message, help=HELP))


def _speed_behind(forces: Sequence[Quantity], unknown: Expr) -> Quantity | None:
    """Return the step q_dot^2 = f(q), by conservation of energy, if q is the letter of the unknown; or None."""
    q, behind = letter_of(unknown), (ancestor for force in forces for ancestor in force.ancestors())
    return next((each for each in behind if (known := each.fact(ByEnergy)) and known.coordinate == q), None)


# --- in one state ---


def _needs_none(contact: _Friction, key: str) -> Quantity:
    return establish(
        SLIPS,
        None,
        lambda F, *_: Relation(F, "=", 0),
        contact.roles,
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"size": lambda found: (found.residual, Integer(0))},
        outcome="needs_none",
        key=key,
    )


def _condition(contact: _Friction, unknown: Expr, side: int, key: str, alone: bool) -> Quantity:
    """Return the condition for the body not to slip in one sense: side F <= mu_s N."""
    excess = contact.excess(side)
    known = sign_for_all(excess)
    mark = ">" if known == 1 else "<="
    result = _solved(contact, side, mark, unknown) if known is None else None
    moving = changes(contact.F - contact.N, named_coordinates())
    return establish(
        SLIPS,
        None,
        lambda F, N, mu: Relation(side * F, mark, Factors(mu, N)),
        contact.roles,
        lines=Lines(
            law=Level.STANDARD,
            put_in=Level.STANDARD,
            after=[] if result is None else [_solution(contact, result, excess)],
            result=False,
            arranged=explicit if result is None else lambda _: result,
        ),
        routes={"points": lambda found: _same_truth(found, contact, side, mark)},
        outcome="sticks" if known is None else "cannot" if known == 1 else "always",
        phrase_data=PhraseData(
            words={**contact.sense(side), **({"seen": "state"} if moving is not None else {})},
            formulas=conditions_told(pushing=_pushing(contact.N)),
            outcome_data={"side": Integer(side), "alone": Integer(alone)},
        ),
        key=key,
    )


def _pushing(N: Expr) -> Relation | None:
    """Return the condition for the surface to push; None if it always does."""
    unsure = [each.as_base_exp() for each in Mul.make_args(N) if sign_known(each) != 1]
    if unsure and all(power.is_even for _, power in unsure):
        return Relation(Mul(*(base for base, _ in unsure)), "!=", 0)
    return positive(N) if unsure else None


def _solved(contact: _Friction, side: int, mark: str, unknown: Expr) -> Relation:
    """Solve the relation between side F and mu_s N for the unknown, where N > 0."""
    if unknown == contact.limit.coefficient:
        return Relation(unknown, TURNED[mark], _with_tangents(presented(side * contact.F / contact.N)))
    excess = _in_terms_of(contact.excess(side), unknown)
    found = solved_for_unknown(contact.friction, excess, mark, unknown)
    return Relation(found.left, found.operator, _with_tangents(found.right))


def _solution(contact: _Friction, result: Relation, excess: Expr) -> Form:
    """Return the last line; it differs from the line before by a factor that does not vanish, such as N > 0."""
    alone, solved = result.sides
    if alone == contact.limit.coefficient:
        pushing = Mul.make_args(contact.N)
        return Form(result, "solved", nonzero=(*pushing, *(each.expand() for each in pushing if each.is_Pow)))
    factor = tidied(_without_tangents(excess / result.residual))
    sign = sign_known(factor)
    return Form(result, "solved", nonzero=Mul.make_args(factor * sign) if sign else divided_out(excess, alone, solved))


def _in_terms_of(value: Expr, unknown: Expr) -> Expr:
    """Return a value with the same sign that contains the unknown; for tan(alpha), divide by powers of cos(alpha)."""
    if not isinstance(unknown, tan) or sign_known(cos(unknown.args[0])) != 1:
        return value
    c, t = Dummy("c", positive=True), mark_for(unknown)
    with_cosines = _without_tangents(tidied(value)).xreplace({sin(unknown.args[0]): t * c, cos(unknown.args[0]): c})
    divided = [each.expand().collect(c) for each in together(with_cosines).as_numer_denom()]
    powers = [[term.as_independent(c)[1] for term in Add.make_args(each)] for each in divided]
    if any(len(set(each)) > 1 for each in powers):
        return value  # not the same power of the cosine in each term
    above, below = (each.xreplace({c: Integer(1), t: unknown}) for each in divided)
    return above / below


def _with_tangents(value: Expr) -> Expr:
    """Write sin(a)/cos(a) as tan(a)."""
    powers = value.as_powers_dict()
    for base, power in powers.items():
        if isinstance(base, sin) and powers.get(cos(base.args[0])) == -power:
            return value * cos(base.args[0]) ** power / base**power * tan(base.args[0]) ** power
    return value


def _without_tangents(value: Expr) -> Expr:
    return value.replace(tan, lambda angle: sin(angle) / cos(angle))


def _same_truth(found: Relation, contact: _Friction, side: int, mark: str) -> Verdict:
    """Check at random points that the result and side F <= mu_s N (or >) are both true or both false, where N > 0."""
    F, N, mu, difference = map(with_numbers, (contact.F, contact.N, contact.limit.coefficient, found.residual))

    def is_so(point: Mapping[Symbol, Expr]) -> bool | None:
        if not value_at(mu * N, point) > 0:
            return None
        wanted = holds(value_at(side * F - mu * N, point), mark)
        return holds(value_at(difference, point), found.operator) == wanted

    return _sampled(is_so, letters_of(F) | letters_of(N) | letters_of(mu) | letters_of(difference), contact.F)


# --- along a motion ---


@dataclass(frozen=True)
class _Motion:
    """The forces of a contact along a motion of one coordinate, from its start."""

    contact: _Friction
    unknown: Expr
    speed: Quantity

    @property
    def q(self) -> Symbol:
        return self.speed.needed(ByEnergy).coordinate

    @property
    def start(self) -> Expr:
        return self.speed.needed(ByEnergy).start

    @property
    def values(self) -> list[Expr]:
        """Return F, mu_s N, the squared rate and the start, with the given numbers."""
        mu_N = self.contact.limit.coefficient * self.contact.N
        return [*map(with_numbers, (self.contact.F, mu_N, squared_by_energy(self.speed), self.start))]

    @property
    def letters(self) -> set[Symbol]:
        return set().union(*map(letters_of, self.values)) - {self.q}

    def place(self, value: Expr) -> Expr:
        return with_numbers(meaning(self.unknown, value)[self.q])

    def margin(self, at: Expr, point: Mapping[Symbol, Expr]) -> Expr:
        """mu_s N - |F| at a place, N."""
        F, most, *_ = self.values
        there = {**point, self.q: at}
        return value_at(most, there) - abs(value_at(F, there))

    def reaches(self, at: Expr, point: Mapping[Symbol, Expr]) -> bool:
        """Whether the place is in the range of the coordinate, and the motion does not turn back before it."""
        known, begin = range_of(self.q), value_at(self.start, point)
        if not at.is_real or known is not None and not (known.least <= at and at <= known.greatest):
            return False
        way = [begin + (at - begin) * part for part in (*PARTS, Integer(1))]
        return all(value_at(self.values[2], {**point, self.q: here}) >= 0 for here in way)


def _along_motion(contact: _Friction, unknown: Expr, speed: Quantity, key: str) -> Quantity:
    motion = _Motion(contact, unknown, speed)
    at_start = [tidied(contact.excess(side).xreplace({motion.q: motion.start})) for side in (1, -1)]
    signs = [sign_known(each) for each in at_start]
    if 0 in signs:
        message = f"`slips`: at the start of the motion `{contact.friction.key}` has its largest value already"
        raise Rejected(Complaint("no-contact", message, help="give the motion another start"))
    if 1 in signs:
        return _at_once(motion, 1 if signs[0] == 1 else -1, key)
    places, squared = _borders(motion)
    first = _first(motion, places)
    if first is None:
        return _stays(motion, key)
    solved = places[first]
    result = Relation(unknown, "=", solved)
    side = _side_at(motion, solved)
    open_ = [-each for each, sign in zip(at_start, signs, strict=True) if sign is None]
    told = conditions_told(
        existing=_unless_sure(existence(contact.friction, result)),
        reached=_unless_sure(condition_to_reach(contact.friction, speed, unknown, solved)),
        starts=positive(Mul(*open_)) if open_ else None,
    )
    law = Relation(side * contact.friction.symbol, "=", Factors(contact.limit.coefficient, contact.normal.symbol))
    return establish(
        SLIPS,
        None,
        (lambda *_: result) if squared else (lambda F, N, mu: Relation(side * F, "=", Factors(mu, N))),
        contact.roles,
        lines=Lines(
            law=Level.STANDARD,
            put_in=None if squared else Level.FULL,
            after=[] if squared else [_solution(contact, result, contact.excess(side))],
            result=False,
            arranged=lambda _: result,
        ),
        routes={"on_the_way": lambda found: _first_there(motion, found.right)},
        outcome="slips_squared" if squared else "slips",
        phrase_data=PhraseData(
            formulas={**told, **({"border": (law, law)} if squared else {})},
            words=contact.sense(side),
            named={"from": Relation(motion.q, "=", motion.start)},
            outcome_data=_data(motion, side),
        ),
        key=key,
        parents=[speed],
    )


def _unless_sure(condition: Relation | None) -> Relation | None:
    """Return a condition, but None if it always holds: a > b sqrt(c) for positive a with a^2 > b^2 c."""
    if condition is None:
        return None
    more, less = condition.sides if condition.operator[0] == ">" else reversed(condition.sides)
    value = (more - less).expand()
    roots = [each for each in value.atoms(Pow) if each.exp == Rational(1, 2)]
    if len(roots) != 1 or sign_known(rest := value.xreplace({roots[0]: Integer(0)})) != 1:
        return condition
    return None if sign_known((rest**2 - (value - rest).expand() ** 2).expand()) == 1 else condition


def _data(motion: _Motion, side: int = 0) -> dict[str, Expr]:
    return {
        "unknown": motion.unknown,
        "coordinate": motion.q,
        "begin": motion.start,
        "start": motion.unknown.xreplace({motion.q: motion.start}),
        "squared": squared_by_energy(motion.speed),
        "side": Integer(side),
    }


def _at_once(motion: _Motion, side: int, key: str) -> Quantity:
    """The friction would exceed its largest value at the start."""
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
            words=contact.sense(side),
            named={"from": Relation(motion.q, "=", motion.start)},
            outcome_data=_data(motion, side),
        ),
        key=key,
        parents=[motion.speed],
    )


def _stays(motion: _Motion, key: str) -> Quantity:
    """The motion reaches no place where the friction has its largest value."""
    contact = motion.contact
    return establish(
        SLIPS,
        None,
        lambda F, N, mu: Relation(Abs(F), "<", Factors(mu, N)),
        contact.roles,
        lines=Lines(law=Level.BRIEF, put_in=None, result=False, arranged=explicit),
        routes={"on_the_way": lambda found: _always_there(motion)},
        outcome="stays",
        phrase_data=PhraseData(
            named={"from": Relation(motion.q, "=", motion.start)}, outcome_data=_data(motion)
        ),
        key=key,
        parents=[motion.speed],
    )


def _borders(motion: _Motion) -> tuple[list[Expr], bool]:
    """Return the values of the unknown at which |F| = mu_s N, and whether the equation was squared to find them."""
    contact, unknown = motion.contact, motion.unknown
    found: list[Expr] = []
    for side in (1, -1):
        try:
            found.append(_solved(contact, side, "=", unknown).right)
        except Rejected:
            continue
    if found:
        return found, False
    u = mark_for(unknown)
    squares = tidied(contact.limit.coefficient**2 * contact.N**2 - contact.F**2)
    written, _ = without_factors_beside(with_unknown(squares, unknown, u), unknown, u)
    above = written.as_numer_denom()[0].expand()
    polynomial = above.as_poly(u) if not left_over(written, unknown) else None
    if polynomial is None or polynomial.degree() not in (1, 2) or polynomial.has(unknown):
        raise unsolvable(contact.friction, unknown)
    *leading, b, c = polynomial.all_coeffs()
    if not leading:
        return [presented(-c / b)], True
    (a,) = leading
    root = sqrt(tidied(b**2 - 4 * a * c))
    return [presented(tidied((-b + sign * root) / (2 * a))) for sign in (1, -1)], True


def _first(motion: _Motion, places: Sequence[Expr]) -> int | None:
    """Return the index of the place that the motion reaches first; None if it reaches none of them.

    Numbers decide, which must agree. Numbers with which the body slips at the start do not count.
    """
    seen: set[int | None] = set()
    for point in _points(motion.letters, motion.contact.F):
        try:
            begin = value_at(motion.start, point)
            if not motion.margin(begin, point) > 0:
                continue
            at = {i: value_at(motion.place(place), point) for i, place in enumerate(places)}
            reached = [i for i, there in at.items() if motion.reaches(there, point)]
        except (Undefined, NoNumber, TypeError):
            continue
        seen.add(min(reached, key=lambda i, at=at, begin=begin: abs(at[i] - begin)) if reached else None)  # type: ignore[misc]
    found = seen - {None}
    if len(found) > 1:
        message = "`slips`: the place where the body slips first depends on the values of the letters"
        raise Rejected(Complaint("no-condition", message, help="give numbers, or relations under `assume:`"))
    return next(iter(found)) if found else None


def _side_at(motion: _Motion, place: Expr) -> int:
    """Return the sign of F at a place."""
    there = tidied(motion.contact.F.xreplace(meaning(motion.unknown, place)))
    sign = sign_known(there)
    if sign in (1, -1):
        return int(sign)
    F, signs = motion.values[0], set()
    for point in _points(motion.letters, motion.contact.F):
        try:
            at = value_at(motion.place(place), point)
            if motion.margin(value_at(motion.start, point), point) > 0 and motion.reaches(at, point):
                signs.add(1 if value_at(F, {**point, motion.q: at}) > 0 else -1)
        except (Undefined, NoNumber, TypeError):
            continue
    if len(signs) != 1:
        message = "`slips`: the sense in which the body slips depends on the values of the letters"
        raise Rejected(Complaint("no-condition", message, help="give numbers, or relations under `assume:`"))
    return signs.pop()


def _first_there(motion: _Motion, place: Expr) -> Verdict:
    """Check numerically that |F| < mu_s N from the start to the place, and |F| > mu_s N beyond it."""

    def is_so(point: Mapping[Symbol, Expr]) -> bool | None:
        begin, end = value_at(motion.start, point), value_at(motion.place(place), point)
        if not motion.margin(begin, point) > 0 or not motion.reaches(end, point):
            return None
        way = [motion.margin(begin + (end - begin) * part, point) for part in (*PARTS, BEYOND)]
        return all(here > 0 for here in way[:-1]) and bool(way[-1] < 0)

    return _sampled(is_so, motion.letters, motion.contact.F)


def _always_there(motion: _Motion) -> Verdict:
    """Check numerically that |F| < mu_s N wherever the motion gets from its start."""

    def is_so(point: Mapping[Symbol, Expr]) -> bool | None:
        begin = value_at(motion.start, point)
        if not motion.margin(begin, point) > 0:
            return None
        far = [begin + side * (abs(begin) + 1) * part for part in PARTS for side in (1, -1)]
        return all(motion.margin(here, point) > 0 for here in far if motion.reaches(here, point))

    return _sampled(is_so, motion.letters, motion.contact.F)


def _points(letters: set[Symbol], of: Expr) -> Iterator[Mapping[Symbol, Expr]]:
    return islice(points(letters, seed_of(of)), POINTS)


def _sampled(is_so: Callable[[Mapping[Symbol, Expr]], bool | None], letters: set[Symbol], of: Expr) -> Verdict:
    """Return the verdict on a statement at random points; None means that the statement has no meaning at a point."""
    seen = 0
    for point in _points(letters, of):
        try:
            verdict = is_so(point)
        except (Undefined, NoNumber, TypeError):
            continue
        if verdict is False:
            where = tuple((str(name), str(value)) for name, value in point.items())
            return Verdict(Grade.REFUTED, "the friction is not as stated", where)
        seen += verdict is True
    return Verdict(Grade.SAMPLED, f"{seen} points") if seen else Verdict(Grade.REFUTED, "undefined at all points tried")
