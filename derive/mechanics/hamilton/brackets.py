"""Poisson brackets of functions of coordinates and momenta.

Suppose that a function does not contain the time, and that the Hamiltonian contains all forces. Then the bracket of the
function with the Hamiltonian is the rate of change of the function.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from sympy import Add, Expr, Integer, Mul, Pow, Symbol, cos, diff, sin

from derive.algebra.collect import by_terms
from derive.algebra.expressions import (
    TIME,
    Factors,
    Partial,
    PoissonBracket,
    Terms,
    bound,
    depends_on_time,
    explicit,
    rate,
)
from derive.algebra.length import length
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.arguments import checked
from derive.mechanics.hamilton import claims
from derive.mechanics.hamilton.facts import PhaseSpace
from derive.mechanics.in_results import Functions, in_results
from derive.mechanics.kinematics.coordinates import Coordinate, by_functions_of_time
from derive.mechanics.lagrange.momenta import kind_of_momentum, letter_of_momentum
from derive.mechanics.model.dalembert import Matter
from derive.steps.claims import lasts, vanishes
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Form, Level, Quantity, value_behind

__all__ = ["poisson_bracket"]

ZERO = Integer(0)
WITHOUT_RATES = Spelled(
    "write the momentum of x as `conjugate(x)`; for a step f, use `in_momenta(f, H)`",
    "write the momentum of x as `p_x`",
)
Pairs = Sequence[tuple[Symbol, Symbol]]


POISSON_BRACKET = Rule(
    "hamilton.poisson_bracket",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 9.5",
    outcomes={"generic": lasts, "zero": vanishes, "conserved": claims.poisson_bracket_conserved},
    evidence={"rules": CHECK, "along_the_motion": ROUTE, "given_along_the_motion": ROUTE},
    statements=[claims.bracket_as_told],
)


def poisson_bracket(
    f: Any, g: Any, *coordinates: Coordinate, among: Sequence[Quantity] = (), key: str | None = None
) -> Quantity:
    """Poisson bracket, {f, g} = sum of df/dq dg/dp - df/dp dg/dq.

    f, g          functions of coordinates and momenta: steps, or formulas in coordinates `x` and their momenta
                  `conjugate(x)`
    coordinates   all coordinates; not needed if f or g is a Hamiltonian, or a result derived from a Hamiltonian
    among         steps; if the bracket is a number times the value of such a step, the last line is written with the
                  symbol of this step

    Second route: if g is a Hamiltonian, the bracket plus the partial derivative of f with respect to time is the rate
    of f along every motion. This rate is the derivative of f as a function of t, with accelerations from d'Alembert's
    principle.
    Check: the bracket of the formulas by {q, p} = 1, antisymmetry, and the rules for {f + h, g}, {f h, g} and
    {u(f), g}.
    Outcomes: conserved (g is the Hamiltonian, f does not contain the time and {f, g} = 0), zero ({f, g} = 0 in any
    other case), generic.
    Errors: the coordinates are not given; f or g is not a scalar, or contains a rate.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 9.5.
    """
    known = [of.needed(PhaseSpace) for of in (f, g) if isinstance(of, Quantity) and of.fact(PhaseSpace)]
    of_all = coordinates or (known[0].coordinates if known else ())
    if not of_all:
        help_line = "give the coordinates after the two functions: `poisson_bracket(f, g, x, y)`"
        raise Rejected(Complaint("wrong-argument", "`poisson_bracket` needs the coordinates", help=help_line))
    pairs = [(q.symbol, letter_of_momentum(q)) for q in of_all]
    one, other = (_function(each, pairs) for each in (f, g))
    names = [each.symbol if isinstance(each, Quantity) else each for each in (one, other)]
    flat = [s for pair in pairs for s in pair]
    flow = g.fact(PhaseSpace) if isinstance(g, Quantity) and g.step.rule == "hamilton.hamiltonian" else None

    values = [explicit(value_behind(each)) for each in (one, other)]
    derivatives = _derivatives(values[0], values[1], pairs)

    def law(f: Expr, g: Expr) -> Expr:
        terms = [sign * Factors(Partial(f, u), Partial(g, v)) for sign, u, v in derivatives]
        return Terms(*terms) if terms else ZERO

    def by_rules(found: Expr) -> tuple[Expr, Expr]:
        return found, _by_rules(values[0], values[1], dict(pairs))

    def along_the_motion(found: Expr) -> tuple[Expr, Expr]:
        return _along_the_motion(found, values[0], flow) if flow else (found, found)

    def outcome(found: Expr) -> str:
        if found != 0:
            return "generic"
        return "conserved" if flow and not depends_on_time(values[0]) else "zero"

    value = _written(law(values[0], values[1]))
    worked = [sign * Factors(diff(values[0], u), diff(values[1], v)) for sign, u, v in derivatives]
    plain = isinstance(one, Symbol) or isinstance(other, Symbol)  # a symbol has trivial derivatives
    return establish(
        POISSON_BRACKET,
        PoissonBracket(*names, *flat),
        law,
        {"f": one, "g": other},
        lines=Lines(
            put_in=None,
            law=Level.FULL if plain else Level.STANDARD,
            between=[Form(Terms(*worked), "derivatives", Level.FULL if plain else Level.STANDARD)] if worked else [],
            arranged=_written,
            after=_told_among(value, among),
        ),
        routes={
            "rules": by_rules,
            **(flow.lagrangian.needed(Matter).named({"along_the_motion": along_the_motion}) if flow else {}),
        },
        outcome=outcome,
        phrase_data=PhraseData(
            outcome_data={"momenta": tuple(p for _, p in pairs), "coordinates": tuple(q for q, _ in pairs)}
        ),
        key=key or f"bracket_{_called(f)}_{_called(g)}",
        parents=list(among),
        facts=known[:1],
        scope=Scope(coordinates=_letters(of_all)),
    )


def _letters(coordinates: Sequence[Coordinate]) -> dict[Symbol, str]:
    own = {q.symbol: q.kind for q in coordinates}
    return {**own, **{letter_of_momentum(q): kind_of_momentum(q.kind) or "" for q in coordinates}}


def _called(of: Any) -> str:
    name = of.key if isinstance(of, Quantity) else str(getattr(of, "symbol", of))
    return name if name.isidentifier() else "formula"


def _function(of: Any, pairs: Pairs) -> Any:
    """Return a function of coordinates and momenta; an expression with rates is rejected."""
    found = of.symbol if isinstance(of, Coordinate) else of
    value = value_behind(found)
    if not isinstance(value, Expr):
        raise Rejected(
            Complaint(
                "wrong-argument", f"`poisson_bracket` needs two scalars, but `{getattr(of, 'key', of)}` is not one"
            )
        )
    rates = [v for q, p in pairs for v in (rate(q), rate(p)) if explicit(value).has(v)]
    if rates:
        name = f"`{of.key}`" if isinstance(of, Quantity) else str(value)
        message = f"`poisson_bracket` needs functions of coordinates and momenta, but {name} contains {rates[0].name}"
        raise Rejected(Complaint("wrong-argument", message, help=WITHOUT_RATES))
    return found


def _derivatives(f: Expr, g: Expr, pairs: Pairs) -> list[tuple[Integer, Symbol, Symbol]]:
    """Return those products +-df/du dg/dv in the bracket that are not zero, each as its sign, u and v."""
    found: list[tuple[Integer, Symbol, Symbol]] = []
    for q, p in pairs:
        for sign, u, v in ((Integer(1), q, p), (Integer(-1), p, q)):
            if diff(f, u) != 0 and diff(g, v) != 0:
                found.append((sign, u, v))
    return found


def _written(value: Expr) -> Expr:
    value = explicit(value)
    forms = [tidied(value), by_terms(value.expand())]
    return min(forms, key=length)


def _told_among(value: Expr, among: Sequence[Quantity]) -> list[Form]:
    """Return the line with the result as a number times the symbol of a step; no line if there is no such step."""
    for known in among:
        ratio = tidied(value / explicit(known.value)) if value != 0 else ZERO
        if ratio.is_number and ratio != 0:
            return [Form(ratio * known.symbol, "recognised")]
    return []


def _by_rules(f: Expr, g: Expr, pairs: dict[Symbol, Symbol]) -> Expr:
    """Return the bracket, derived only from {q, p} = 1, linearity, the product rule, the chain rule and
    antisymmetry."""
    letters = {*pairs, *pairs.values()}

    def bracket(f: Expr, g: Expr) -> Expr:
        if not f.free_symbols & letters or not g.free_symbols & letters:
            return ZERO
        if isinstance(f, Symbol):
            return _of_letters(f, g, pairs) if isinstance(g, Symbol) else -bracket(g, f)
        return Add(*(outer * bracket(inner, g) for outer, inner in _parts(f)))

    return bracket(f, g)


def _of_letters(f: Symbol, g: Symbol, pairs: dict[Symbol, Symbol]) -> Expr:
    return Integer(1) if pairs.get(f) == g else Integer(-1) if pairs.get(g) == f else ZERO


def _parts(f: Expr) -> list[tuple[Expr, Expr]]:
    """Return pairs (df/dh, h) for the parts h of f, so that {f, g} is the sum of df/dh {h, g}."""
    if f.is_Add:
        return [(Integer(1), term) for term in f.args]
    if f.is_Mul:
        return [(Mul(*f.args[:i], *f.args[i + 1 :]), factor) for i, factor in enumerate(f.args)]
    if isinstance(f, Pow) and not f.exp.free_symbols:
        return [(f.exp * f.base ** (f.exp - 1), f.base)]
    if isinstance(f, sin):
        return [(cos(f.args[0]), f.args[0])]
    if isinstance(f, cos):
        return [(-sin(f.args[0]), f.args[0])]
    return [(f.diff(s), s) for s in sorted(f.free_symbols, key=str)]


def _along_the_motion(found: Expr, f: Expr, space: PhaseSpace) -> tuple[Expr, Expr]:
    """Return {f, H} plus the partial derivative of f with respect to time, and df/dt along the motion.

    df/dt is the time derivative of f as a function of t, minus the sum of df/dp (m a - F) . dr/dq. This sum vanishes by
    d'Alembert's principle, and subtracting it eliminates the accelerations.
    """
    matter = space.lagrangian.needed(Matter)
    in_rates = space.in_rates
    moving = [q for q, _ in space.pairs]
    by_time = by_functions_of_time(bound(f, in_rates), moving)
    sums = [bound(diff(f, p), in_rates) * (matter.inertia_along(q) - matter.force_along(q)) for q, p in space.pairs]
    return bound(found + diff(f, TIME), in_rates), by_time - Add(*sums)


@in_results(
    "bracket",
    "the Poisson bracket of two answers, or of formulas in coordinates and momenta `p_x`",
    functions="bracket: two answers, or formulas in coordinates and their momenta `p_x`",
    among="results: answers whose symbols may appear in the bracket",
)
def _in_results(
    functions: Functions, key: str, coordinates: Mapping[str, Coordinate], among: Sequence[Quantity] = ()
) -> Quantity:
    f, g = functions
    return checked(poisson_bracket)(f, g, *coordinates.values(), among=among, key=key)
