"""The static friction and the normal force of a contact, with the condition |F| <= mu_s N."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import islice

from sympy import Add, Dummy, Expr, Integer, Mul, Symbol, cos, sin, tan, together

from derive.algebra.equality import Grade, Verdict
from derive.algebra.expressions import Relation, explicit
from derive.algebra.order import known_order
from derive.algebra.relation import TURNED
from derive.algebra.samples import NoNumber, Undefined, points, seed_of, value_at
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.model.constraint import Constrained, Constraint, StaticLimit
from derive.solving.presentation import presented
from derive.solving.relations import divided_out, number_of, positive, solved_for_unknown
from derive.solving.unknowns import mark_for
from derive.steps.signs import sign_known
from derive.steps.step import Form, Quantity

POINTS = 40  # number of sets of random numbers for the symbols


@dataclass(frozen=True)
class Friction:
    """The friction F and the normal force N of one contact, and the limit of static friction."""

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
        """The friction in one direction (`side`, 1 or -1) minus its largest possible value: side*F - mu_s*N, in
        newtons."""
        return tidied(side * self.F - self.limit.coefficient * self.N)

    def words(self, side: int) -> dict[str, str]:
        """Return the words of the sentence: the body that would slip, and the direction of the slip if it is known.

        The slip is opposite to the friction on the body; `side` is the sign of F.
        """
        sense = self.constraint.sense(-side)
        return {**self.limit.words, "sense": sense} if sense else self.limit.words


def static_friction(friction: Quantity) -> Constraint:
    """Return the constraint whose force is this friction; the constraint contains the limit mu_s N."""
    for ancestor in friction.ancestors():
        kept = ancestor.fact(Constrained)
        for each in kept.constraints if kept is not None else ():
            if each.force == friction.symbol and each.limit is not None:
                _check_in_plane(each.limit, friction)
                return each
    help_line = "describe the contact with `friction: {static: mu_s, force: F}`, and name F as the friction"
    message = f"`{friction.key}` is not the friction of a contact with a coefficient of static friction"
    raise Rejected(Complaint("no-contact", message, help=help_line))


def _check_in_plane(limit: StaticLimit, friction: Quantity) -> None:
    if limit.in_space:
        message = f"`slips` needs a plane of motion, but {friction.symbol} is only one component of the friction"
        help_line = "leave `slips` out: the page states the condition for the magnitude of the friction"
        raise Rejected(Complaint("wrong-argument", message, help=help_line))


def friction_of(friction: Quantity, normal: Quantity) -> Friction:
    constraint = static_friction(friction)
    assert constraint.limit is not None
    if normal.symbol != constraint.limit.normal:
        message = f"`slips`: `{normal.key}` is not the normal force of this contact"
        raise Rejected(Complaint("different-subjects", message, help=f"give {constraint.limit.normal}"))
    if constraint.limit.of_rail and sign_known(explicit(number_of(normal))) != 1:
        message = f"`slips`: the normal force {constraint.limit.normal} of a rail is not known to be positive"
        help_line = "leave `slips` out: the page states the condition |F| <= mu_s |N|"
        raise Rejected(Complaint("sign", message, help=help_line))
    return Friction(friction, normal, constraint, constraint.limit)


def condition_to_push(N: Expr) -> Relation | None:
    """Return the condition for the surface to push; None if N is known to be positive."""
    unsure = [each.as_base_exp() for each in Mul.make_args(N) if sign_known(each) != 1]
    if unsure and all(power.is_even for _, power in unsure):
        return Relation(Mul(*(base for base, _ in unsure)), "!=", 0)
    return positive(N) if unsure else None


def solved_for_limit(contact: Friction, side: int, mark: str, unknown: Expr) -> Relation:
    """Solve the relation between side*F and mu_s*N for the unknown, where N > 0 and `side` is 1 or -1."""
    if unknown == contact.limit.coefficient:
        return Relation(unknown, TURNED[mark], _with_tangents(presented(side * contact.F / contact.N)))
    excess = _in_terms_of(contact.excess(side), unknown)
    found = solved_for_unknown(contact.friction, excess, mark, unknown)
    return Relation(found.left, found.operator, _with_tangents(found.right))


def solved_line(contact: Friction, result: Relation, excess: Expr) -> Form:
    """Return the line with the solved relation, which is equivalent to the line before."""
    alone, solved = result.sides
    if alone == contact.limit.coefficient:
        # Division by N gives this line from the line before; N is positive, so none of its factors is zero.
        pushing = Mul.make_args(contact.N)
        bases = [each.as_base_exp()[0] for each in pushing if not each.is_number]
        return Form(result, "solved", nonzero=(*pushing, *bases, *(each.expand() for each in pushing if each.is_Pow)))
    factor = tidied(_without_tangents(excess / result.residual))
    sign = sign_known(factor)
    return Form(result, "solved", nonzero=Mul.make_args(factor * sign) if sign else divided_out(excess, alone, solved))


def _in_terms_of(value: Expr, unknown: Expr) -> Expr:
    if not isinstance(unknown, tan) or sign_known(cos(unknown.args[0])) != 1:
        return value
    c, t = Dummy("c", positive=True), mark_for(unknown)
    with_cosines = _without_tangents(tidied(value)).xreplace({sin(unknown.args[0]): t * c, cos(unknown.args[0]): c})
    divided = [each.expand().collect(c) for each in together(with_cosines).as_numer_denom()]
    powers = [[term.as_independent(c)[1] for term in Add.make_args(each)] for each in divided]
    if any(len(set(each)) > 1 for each in powers):
        return value  # the terms contain different powers of the cosine
    above, below = (each.xreplace({c: Integer(1), t: unknown}) for each in divided)
    return above / below


def _with_tangents(value: Expr) -> Expr:
    powers = value.as_powers_dict()
    for base, power in powers.items():
        if isinstance(base, sin) and powers.get(cos(base.args[0])) == -power:
            return value * cos(base.args[0]) ** power / base**power * tan(base.args[0]) ** power
    return value


def _without_tangents(value: Expr) -> Expr:
    return value.replace(tan, lambda angle: sin(angle) / cos(angle))


def numbers_for(letters: set[Symbol], of: Expr) -> Iterator[Mapping[Symbol, Expr]]:
    """Yield sets of numbers for the symbols. Each set satisfies the assumed relations between these symbols."""
    kept = [each for each in known_order().positive if each.free_symbols <= letters]
    tried = islice(points(letters, seed_of(of)), POINTS * (1 if not kept else 25))
    return islice((point for point in tried if all(value_at(each, point) > 0 for each in kept)), POINTS)


def sampled(is_so: Callable[[Mapping[Symbol, Expr]], bool | None], letters: set[Symbol], of: Expr) -> Verdict:
    """Judge a statement with random numbers for the symbols; `is_so` returns None for numbers for which the
    statement has no meaning."""
    seen = 0
    for point in numbers_for(letters, of):
        try:
            verdict = is_so(point)
        except (Undefined, NoNumber, TypeError):
            continue
        if verdict is False:
            where = tuple((str(name), str(value)) for name, value in point.items())
            return Verdict(Grade.REFUTED, "the friction is not as stated", where)
        seen += verdict is True
    return Verdict(Grade.SAMPLED, f"{seen} points") if seen else Verdict(Grade.REFUTED, "undefined at all points tried")
