"""Steps of plain algebra: a result with values substituted, the length of a vector, and definitions by `let`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from sympy import Add, Expr, Integer, MatrixSymbol, Mul, Pow
from sympy import Eq as Equality
from sympy.logic.boolalg import BooleanAtom

from derive.algebra.collect import by_rates, by_terms
from derive.algebra.expressions import (
    Dot,
    Factors,
    Group,
    Norm,
    Relation,
    Root,
    Terms,
    bound,
    component_names,
    explicit,
    scalar,
)
from derive.algebra.kinds import KINDS
from derive.algebra.tidy import size_and_rest, tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.answers import claims
from derive.mechanics.model.dalembert import Matter
from derive.mechanics.rotation.facts import RateByParticles
from derive.mechanics.rotation.vectors import RateOfSquare, Through, length_by_turning
from derive.steps.claims import lasts, vanishes
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.level import Manner
from derive.steps.record import coordinates_in
from derive.steps.rule import CHECK, Rule, Shown
from derive.steps.step import Fact, Form, Level, Quantity, compared_with
from derive.steps.subject import EVERYTHING, Subject

__all__ = ["at", "let", "magnitude", "squared_magnitude", "with_values"]


AT = Rule(
    "answers.at",
    source="none needed: substitution",
    evidence={"law": CHECK},
    statements=[claims.for_a_vector],
)


def at(general: Quantity, particular: Quantity, key: str | None = None) -> Quantity:
    """Value of a general result for a particular vector.

    general      a result for a vector with unspecified components
    particular   the vector to substitute; it has the symbol and the axes of the unspecified vector

    Check: the law of the general result, evaluated with the particular vector from the start.
    Errors: the general result does not contain the components of the unspecified vector; the two vectors have different
    kinds, or belong to rotations about different points.
    Source: none needed: substitution.
    """
    _check_same_kind(general, particular)
    names = component_names(particular.symbol.name)
    if not general.value.free_symbols & set(names):
        message = f"`{general.key}` does not depend on the components of `{particular.key}`"
        raise Rejected(Complaint("nothing-to-put-in", message))
    others = {q.symbol: q.value for q in general.parents if q.symbol != particular.symbol}
    law = general.step.chain[0].expr

    def anew() -> Any:
        return explicit(bound(law, {**others, particular.symbol: particular.value}))

    def value(general_value: Any, vector: Any) -> Any:
        if isinstance(vector, MatrixSymbol):
            return general_value
        return _put_in(general_value, {name: Group(v) for name, v in zip(names, vector, strict=True)})

    return establish(
        AT,
        general.symbol,
        lambda _, vector: value(general.value, vector),
        {"general": general, "vector": particular},
        routes={"law": compared_with(anew)},
        key=key or f"{general.key}_at_{particular.key}",
        kind=general.step.kind,
        scope=Scope(differ={"rotation"}, about=Subject(rotation=particular.subject.rotation), case_of=general),
    )


def _check_same_kind(general: Quantity, particular: Quantity) -> None:
    """Check that the unspecified and the particular vector have the same kind; two rotations must be about the same
    point."""
    opened = next((q for q in general.ancestors() if q is not general and q.symbol == particular.symbol), None)
    if opened is None:
        return
    if opened.step.kind != particular.step.kind:
        message = f"`at`: `{particular.key}` is not of the same kind as `{opened.key}`"
        raise Rejected(Complaint("wrong-argument", message))
    there, here = (q.fact(Through) for q in (opened, particular))
    if there and here and there != here:
        message = (
            f"`at`: the rotation of `{opened.key}` is about the {there.point}, "
            f"but that of `{particular.key}` is about the {here.point}"
        )
        raise Rejected(Complaint("wrong-point", message))


def _put_in(value: Expr, values: dict[Any, Any]) -> Expr:
    sums = [f for f in Mul.make_args(value) if isinstance(f, Add)]
    outside = bound(Mul(*(f for f in Mul.make_args(value) if not isinstance(f, Add))), values)
    kept = [Terms(*_nonzero(bound(term, values) for term in f.as_ordered_terms())) for f in sums]
    return Factors(*([outside] if outside != 1 else []), *kept) if kept else outside


def _nonzero(terms: Iterable[Expr]) -> list[Expr]:
    kept = [term for term in terms if explicit(term) != 0]
    return kept or [Integer(0)]


WITH_VALUES = Rule(
    "answers.with_values",
    source="none needed: substitution",
    evidence={"law": CHECK},
)


def with_values(general: Quantity, *values: Quantity, key: str | None = None) -> Quantity:
    """Value of a general result for given values of some of its symbols.

    general   a scalar result that contains symbols, in any unit
    values    quantities; the value of each quantity replaces its symbol in the general result

    Check: the law of the general result, evaluated with these values from the start.
    Errors: the general result is an equation or an inequality; it contains none of these symbols, or uses one of them
    for another quantity.
    Source: none needed: substitution.
    """
    known = {q.symbol: q.value for q in values}
    if isinstance(general.value, Relation):
        message = f"`with_values` needs a value, but `{general.key}` is an equation or an inequality"
        raise Rejected(Complaint("wrong-argument", message))
    for value in values:
        meant = next((q for q in general.ancestors() if q.symbol == value.symbol), None)
        if meant is not None and meant.step != value.step:
            message = f"`{general.key}` depends on `{meant.key}`, not on `{value.key}`: both are called {value.symbol}"
            raise Rejected(Complaint("different-subjects", message))
    if not general.value.free_symbols & set(known):
        names = " and ".join(f"`{q.key}`" for q in values)
        raise Rejected(Complaint("nothing-to-put-in", f"`{general.key}` does not depend on {names}"))

    def anew() -> Any:
        behind = {q.symbol: bound(explicit(q.value), known) for q in general.parents if q.symbol not in known}
        return explicit(bound(bound(general.step.chain[0].expr, behind), known))

    return establish(
        WITH_VALUES,
        general.symbol,
        lambda _, *those: bound(general.value, dict(zip(known, those, strict=True))),
        {"general": general, **{q.key: q for q in values}},
        lines=Lines(put_in=None, law=Level.FULL, arranged=by_terms),
        routes={"law": compared_with(anew)},
        key=key or f"{general.key}_here",
        kind=general.step.kind,
        facts=general.facts,
        scope=Scope(case_of=general),
    )


MAGNITUDE = Rule(
    "answers.magnitude",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 1",
    outcomes={"generic": lasts, "zero": vanishes},
    evidence={"turned": CHECK},
)


def magnitude(of: Quantity, key: str = "magnitude") -> Quantity:
    """Length of a vector, |v| = sqrt(v.v).

    of      vector (3), any unit

    Check: turn the vector until it lies along one axis and read off the component along this axis.
    Outcomes: zero, generic.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 1.
    """
    size, rest = size_and_rest(of.value)
    squares = [entry**2 for entry in rest if entry != 0]
    worked = [] if len(squares) < 2 else [Form(Factors(size, Root(Terms(*squares))), "squares", Level.STANDARD)]
    return establish(
        MAGNITUDE,
        Norm(of.symbol),
        lambda v: Root(Dot(v, v)),
        {"vector": of},
        lines=Lines(between=worked, put_in=Level.FULL),
        routes={"turned": compared_with(lambda: length_by_turning(of.value))},
        outcome=lambda length: "zero" if length == 0 else "generic",
        key=key,
        kind=of.step.kind,
    )


SQUARED_MAGNITUDE = Rule(
    "answers.squared_magnitude",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 1",
    outcomes={"generic": lasts, "zero": vanishes},
    evidence={"turned": CHECK},
)


def squared_magnitude(of: Quantity, key: str = "squared_magnitude") -> Quantity:
    """Square of a vector's length, |v|^2 = v.v.

    of      vector (3), any unit

    Check: turn the vector until it lies along one axis and square the component along this axis.
    Outcomes: zero, generic.
    Source: Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 1.
    """
    v = of.value
    return establish(
        SQUARED_MAGNITUDE,
        Pow(Norm(of.symbol), 2),
        lambda v: Dot(v, v),
        {"vector": of},
        lines=Lines(put_in=Level.FULL),
        routes={"turned": compared_with(lambda: length_by_turning(v) ** 2)},
        outcome=lambda square: "zero" if square == 0 else "generic",
        key=key,
        facts=_rate_of_square(of),
    )


def _rate_of_square(of: Quantity) -> list[RateOfSquare]:
    """Return the fact that yields d(v.v)/dt = 2 v.dv/dt; an empty list if the rate of the vector is unknown."""
    known = of.fact(RateByParticles)
    return [] if known is None else [RateOfSquare(of.value, known)]


LET = Rule(
    "answers.let",
    source="none needed: a definition",
    outcomes={
        "generic": claims.as_let(False, False),
        "because": claims.as_let(False, True),
        "equation": claims.as_let(True, False),
        "equation_because": claims.as_let(True, True),
    },
    shown=Shown(brief=Manner.TOLD, standard=Manner.TOLD),
)


def let(
    key: str,
    law: Callable[..., Any],
    *quantities: Quantity,
    symbol: str | None = None,
    kind: str | None = None,
    because: str | None = None,
) -> Quantity:
    """Definition by the author: a new symbol for an expression in quantities, or an equation between quantities.

    key          the key of the step
    law          a function of the quantities that returns an expression, or an equation as SymPy's `Eq(left, right)`
    kind         the kind of the result, such as "force" or "time"; by default only the dimension of the result is known
    because      the reason, in the words of the script: "by Newton's second law"

    If the quantities belong to only one body, the result belongs to this body, too. If they have only one reference
    point, or only one angular velocity of a rotation, the result has this point or this angular velocity, too. The
    result varies in time if it contains a coordinate or the time. If the mass points and forces behind every quantity
    are known, the result belongs to all of them. No check shows that the result has the meaning of its letter, so the
    grade of the step is "definition".
    Outcomes: generic, because (with the given reason), equation, equation_because.
    Errors: an unknown kind; an expression that is not a scalar; an equation for which a symbol or a kind is given; an
    equation that always or never holds.
    Source: none needed: a definition.
    """
    if kind is not None and kind not in KINDS:
        raise Rejected(
            Complaint("unknown-kind", f"`let`: there is no kind `{kind}`", help=f"the kinds are {', '.join(KINDS)}")
        )

    def scalar_law(*those: Any) -> Any:
        value = law(*those)
        if isinstance(value, Equality):
            return Relation(value.lhs, "=", value.rhs)
        if isinstance(value, BooleanAtom):
            message = f"`let`: the sides of `{key}` are {'always' if value else 'never'} equal"
            raise Rejected(Complaint("wrong-argument", message))
        if type(value) is int:
            value = Integer(value)
        if not isinstance(value, Expr | Relation):
            needed, found = "a number, an expression or an equation", type(value).__name__
            message = f"`let` needs {needed}, but the law of `{key}` returns a {found}"
            fraction = Spelled("fractions are written `Rational(1, 2)`", "fractions are written `1/2`")
            help_line = fraction if isinstance(value, float) else None
            raise Rejected(Complaint("wrong-argument", message, help=help_line))
        return value

    is_equation = isinstance(scalar_law(*(q.symbol for q in quantities)), Relation)
    if is_equation and (symbol or kind):
        message = f"`let`: `{key}` is an equation, so it has neither a symbol nor a kind"
        raise Rejected(Complaint("wrong-argument", message))
    reason = {"because": because} if because else {}
    return establish(
        LET,
        None if is_equation else scalar(symbol or key),
        scalar_law,
        {q.key: q for q in quantities},
        key=key,
        kind=kind,
        outcome=_sort_of(is_equation, bool(because)),
        lines=Lines(arranged=explicit if is_equation else _by_rates if kind == "energy" else tidied),
        phrase_data=PhraseData(words=reason),
        facts=_facts_of(quantities),
        scope=Scope(differ=EVERYTHING),
    )


def _by_rates(value: Expr) -> Expr:
    """Write an energy with separate terms: (1/2) m R^2 theta_dot^2 + m g R cos(theta)."""
    moving = list(coordinates_in(value))
    return by_rates(explicit(value), moving, halves=True) if moving else tidied(value)


def _sort_of(is_equation: bool, has_reason: bool) -> str:
    if is_equation:
        return "equation_because" if has_reason else "equation"
    return "because" if has_reason else "generic"


def _facts_of(quantities: Sequence[Quantity]) -> list[Fact]:
    known = [matter for q in quantities if (matter := q.fact(Matter)) is not None]
    return [sum(known[1:], known[0])] if known and len(known) == len(quantities) else []
