"""The places where |F| = mu_s N along a motion of one coordinate, and the first of them that the motion reaches."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import takewhile

from sympy import Expr, Integer, Pow, Rational, Symbol, sqrt

from derive.algebra.equality import Verdict
from derive.algebra.expressions import Relation
from derive.algebra.ranges import range_of
from derive.algebra.samples import NoNumber, Undefined, letters_of, value_at
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.motion.facts import ByEnergy
from derive.mechanics.motion.static_friction import Friction, numbers_for, sampled, solved_for_limit
from derive.mechanics.motion.turning_points import squared_by_energy
from derive.solving.presentation import presented
from derive.solving.relations import unsolvable
from derive.solving.unknowns import left_over, mark_for, meaning, with_unknown, without_factors_beside
from derive.steps.known_numbers import with_numbers
from derive.steps.signs import sign_known
from derive.steps.step import Quantity

PARTS, BEYOND = [Rational(n, 16) for n in range(1, 16)], Rational(101, 100)  # fractions of a distance


@dataclass(frozen=True)
class Motion:
    """The forces of a contact along a motion of one coordinate, from the start of this motion."""

    contact: Friction
    unknown: Expr
    speed: Quantity

    @property
    def q(self) -> Symbol:
        return self.speed.needed(ByEnergy).coordinate

    @property
    def start(self) -> Expr:
        return self.speed.needed(ByEnergy).start

    @cached_property
    def values(self) -> list[Expr]:
        """Return F, mu_s N, the squared rate and the start, with the given numbers substituted."""
        mu_N = self.contact.limit.coefficient * self.contact.N
        return [*map(with_numbers, (self.contact.F, mu_N, squared_by_energy(self.speed), self.start))]

    @cached_property
    def letters(self) -> set[Symbol]:
        return set().union(*map(letters_of, self.values)) - {self.q}

    def place(self, value: Expr) -> Expr:
        return with_numbers(meaning(self.unknown, value)[self.q])

    def margin(self, at: Expr, point: Mapping[Symbol, Expr]) -> Expr:
        """mu_s N - |F| at a place, in newtons."""
        F, most, *_ = self.values
        there = {**point, self.q: at}
        return value_at(most, there) - abs(value_at(F, there))

    def allows(self, here: Expr, point: Mapping[Symbol, Expr]) -> bool:
        """Whether the place is in the range of the coordinate, and the squared rate is not negative there."""
        known = range_of(self.q)
        if not here.is_real or known is not None and not (known.least <= here and here <= known.greatest):
            return False
        return bool(value_at(self.values[2], {**point, self.q: here}) >= 0)

    def reaches(self, at: Expr, point: Mapping[Symbol, Expr]) -> bool:
        """Whether the motion is allowed at the place and at trial places on the way from the start."""
        begin = value_at(self.start, point)
        return all(self.allows(begin + (at - begin) * part, point) for part in (Integer(1), *PARTS))

    def reached(self, side: int, point: Mapping[Symbol, Expr]) -> Iterator[Expr]:
        """Yield trial places on one side of the start, the nearest first, until the motion cannot reach the next
        place."""
        begin = value_at(self.start, point)
        far = (begin + side * (abs(begin) + 1) * part for part in PARTS)
        return takewhile(lambda here: self.allows(here, point), far)


def places_of_limit(motion: Motion) -> tuple[list[Expr], bool]:
    """Return the values of the unknown at which |F| = mu_s N, and whether the equation was squared to find them."""
    contact, unknown = motion.contact, motion.unknown
    found: list[Expr] = []
    for side in (1, -1):
        try:
            found.append(solved_for_limit(contact, side, "=", unknown).right)
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


def index_of_first(motion: Motion, places: Sequence[Expr]) -> int | None:
    """Return the index of the place that the motion reaches first; None if it reaches none of them."""
    seen: set[int | None] = set()
    for point in numbers_for(motion.letters, motion.contact.F):
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
        message = "`slips`: the place where the body slips first depends on the values of the symbols"
        raise Rejected(Complaint("no-condition", message, help="give numbers, or relations under `assume:`"))
    return next(iter(found)) if found else None


def sign_of_friction(motion: Motion, place: Expr) -> int:
    """Return the sign of F at a place."""
    there = tidied(motion.contact.F.xreplace(meaning(motion.unknown, place)))
    sign = sign_known(there)
    if sign in (1, -1):
        return int(sign)
    F, signs = motion.values[0], set()
    for point in numbers_for(motion.letters, motion.contact.F):
        try:
            at = value_at(motion.place(place), point)
            if motion.margin(value_at(motion.start, point), point) > 0 and motion.reaches(at, point):
                signs.add(1 if value_at(F, {**point, motion.q: at}) > 0 else -1)
        except (Undefined, NoNumber, TypeError):
            continue
    if len(signs) != 1:
        message = "`slips`: the direction in which the body slips depends on the values of the symbols"
        raise Rejected(Complaint("no-condition", message, help="give numbers, or relations under `assume:`"))
    return signs.pop()


def is_first(motion: Motion, place: Expr) -> Verdict:
    """Check numerically that |F| < mu_s N from the start to the place, and |F| > mu_s N just beyond the place."""

    def is_so(point: Mapping[Symbol, Expr]) -> bool | None:
        begin, end = value_at(motion.start, point), value_at(motion.place(place), point)
        if not motion.margin(begin, point) > 0 or not motion.reaches(end, point):
            return None
        way = [motion.margin(begin + (end - begin) * part, point) for part in (*PARTS, BEYOND)]
        return all(here > 0 for here in way[:-1]) and bool(way[-1] < 0)

    return sampled(is_so, motion.letters, motion.contact.F)


def is_never_reached(motion: Motion) -> Verdict:
    """Check numerically that |F| < mu_s N at all tried places that the motion reaches from its start."""

    def is_so(point: Mapping[Symbol, Expr]) -> bool | None:
        if not motion.margin(value_at(motion.start, point), point) > 0:
            return None
        return all(motion.margin(here, point) > 0 for side in (1, -1) for here in motion.reached(side, point))

    return sampled(is_so, motion.letters, motion.contact.F)


def unless_sure(condition: Relation | None) -> Relation | None:
    """Return the condition; None if it is known to be always true. Only a condition with exactly one square root is
    examined."""
    if condition is None:
        return None
    more, less = condition.sides if condition.operator[0] == ">" else reversed(condition.sides)
    value = (more - less).expand()
    roots = [each for each in value.atoms(Pow) if each.exp == Rational(1, 2)]
    if len(roots) != 1 or sign_known(rest := value.xreplace({roots[0]: Integer(0)})) != 1:
        return condition
    return None if sign_known((rest**2 - (value - rest).expand() ** 2).expand()) == 1 else condition
