"""Small oscillations about a steady motion, with constant momenta of the cyclic coordinates.

Source: Landau, Lifshitz, *Mechanics*, section 14; Goldstein, Poole, Safko, *Classical Mechanics*, section 3.6.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace

from sympy import Add, Dummy, Expr, ImmutableDenseMatrix, Integer, Symbol, diff, expand, sqrt

from derive.algebra.amplitudes import determinant_of
from derive.algebra.expressions import At, Ratio, Relation, Slope, bound, explicit, rate, scalar
from derive.algebra.length import length
from derive.algebra.taylor import slope
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.arguments import checked
from derive.mechanics.hamilton.facts import ReducedMatter, SeenWith
from derive.mechanics.in_results import Letter, in_results
from derive.mechanics.kinematics.coordinates import OfCoordinate
from derive.mechanics.lagrange.facts import KeptMomentum
from derive.mechanics.model.dalembert import Matter
from derive.mechanics.motion.facts import Steady
from derive.mechanics.rest.facts import RestOf, matter_behind
from derive.mechanics.vibrations import claims
from derive.mechanics.vibrations.facts import SquareOf
from derive.mechanics.vibrations.oscillations import frequency
from derive.solving.presentation import by_one_square, presented
from derive.solving.relations import solved_for_letter
from derive.steps.claims import sign_where_it_exists
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.rule import ROUTE, Rule
from derive.steps.signs import sign_known, sign_where
from derive.steps.step import Quantity, is_zero
from derive.witness.facts import Rest

__all__ = ["frequency_squared_about"]

ZERO = Integer(0)


@dataclass(frozen=True, eq=False)
class About:
    """A potential energy of one coordinate `q`, the mass points and forces of the same system, and the value of `q` at
    rest or in steady motion.

    rates     the rates of the cyclic coordinates in the steady motion
    momenta   for each cyclic momentum, a symbol and its value in the steady motion. The symbol denotes the momentum, or
              occurs in the given formula for the momentum if there is one
    letter    a symbol that the condition of the steady motion determines, and the value of this symbol; may be empty
    instead   a rate expressed by the symbol of a momentum, for a shorter result; may be empty
    """

    potential: Quantity
    matter: Matter
    q: Symbol
    place: Expr
    rates: Mapping[Symbol, Expr]
    momenta: Mapping[Symbol, Expr]
    letter: Mapping[Symbol, Expr]
    instead: Mapping[Symbol, Expr] = field(default_factory=dict)

    def there(self, value: Expr) -> Expr:
        """Return the value at q = `place`, with the rates and accelerations of the coordinates of `matter` set to 0."""
        still = {rate(s, n): ZERO for s in self.matter.coordinates for n in (1, 2)}
        return bound(explicit(value), still).subs(self.q, self.place)

    def known(self, value: Expr) -> Expr:
        """Substitute the values of the momenta, then the values in `letter` and in `instead`."""
        return bound(bound(bound(value, self.momenta), self.letter), self.instead)

    def by_momenta(self) -> Iterator[About]:
        """Yield copies in which `instead` expresses one rate by the symbol of a momentum. For example, from
        w = s + Omega cos(alpha), the rate s is w - Omega cos(alpha)."""
        for momentum, value in self.momenta.items():
            for turning in self.rates.values():
                found = solved_for_letter(momentum - value, turning) if isinstance(turning, Symbol) else None
                if found is not None and momentum in self.potential.value.free_symbols - self.letter.keys():
                    yield replace(self, instead={turning: found})


FREQUENCY_SQUARED_ABOUT = Rule(
    "vibrations.frequency_squared_about",
    source="Landau, Lifshitz, *Mechanics*, section 21; Goldstein, Poole, Safko, *Classical Mechanics*, section 3.6",
    outcomes={
        "stable": sign_where_it_exists(1),
        "unstable": sign_where_it_exists(-1),
        "neutral": claims.frequency_squared_about_neutral,
        "conditional": claims.frequency_squared_about_conditional,
    },
    evidence={"all_coordinates": ROUTE},
    statements=[claims.taken_out_by_its_condition],
    named={
        "momentum": claims.momentum_there,
        "exists": claims.there_where_it_exists,
        "taken_out": claims.taken_out,
    },
)


def frequency_squared_about(
    of: Quantity, at: Quantity, without: Expr | None = None, symbol: str = "omega_0", key: str = "frequency_squared"
) -> Quantity:
    """Square of the frequency of small oscillations of one coordinate, omega_0^2 = U''(q_0)/mu(q_0).

    The kinetic energy is (1/2) mu(q) q_dot^2. The oscillations are about an equilibrium, or about a steady motion with
    the effective potential energy U.

    of        a potential energy, an effective potential energy, or a Lagrangian, J
    at        an equilibrium of `of`, as `equilibria` yields it; or, for an effective potential energy, the condition of
              a steady motion of the same Lagrangian, as `steady_motion` yields it
    without   the symbol to eliminate with the condition of the steady motion; by default the symbol whose elimination
              gives the shortest result

    During the oscillation, the momenta of the cyclic coordinates have the values of the steady motion.
    Second route: d'Alembert's principle gives equations for all coordinates, including the cyclic ones. To first order
    in the displacements, the determinant of these equations vanishes for oscillations of this frequency.
    Outcomes: stable (positive), unstable (negative), neutral (zero), conditional (the sign depends on the symbols).
    Errors: several coordinates remain; the condition is for a different Lagrangian, or cannot be solved for `without`.
    Source: Landau, Lifshitz, *Mechanics*, section 21; Goldstein, Poole, Safko, *Classical Mechanics*, section 3.6.
    """
    about = _about_steady(of, at, without) if at.fact(Steady) is not None else _about_rest(of, at)
    q, energy = about.q, explicit(about.potential.value)
    mass = tidied(about.there(diff(about.matter.momentum_along(q), rate(q))))
    curvature = about.there(diff(energy, q, 2))
    if is_zero(mass):
        raise Rejected(
            Complaint("wrong-argument", f"`{at.key}`: the inertia along {q.name} is zero there, so nothing oscillates")
        )
    forms = {each: by_one_square(presented(each.known(curvature / mass))) for each in (about, *about.by_momenta())}
    about, result = min(forms.items(), key=lambda form: length(form[1]))
    exists = at.needed(Rest).exists if at.fact(Rest) is not None else None
    told = {
        **{f"momentum_{n}": (p, value) for n, (p, value) in enumerate(about.momenta.items(), 1)},
        **dict(zip(("taken_out",), about.letter.items(), strict=False)),
    }
    return establish(
        FREQUENCY_SQUARED_ABOUT,
        scalar(symbol) ** 2,
        lambda U, rest: Ratio(
            At(Slope(U, q, Integer(2)), q, about.place if isinstance(at.value, Relation) else rest), mass
        ),
        {"potential": about.potential, "at": at},
        lines=Lines(
            put_in=None,
            arranged=lambda _: result,
            motion={s: about.known(value) for s, value in (*about.letter.items(), *about.momenta.items())},
            means={scalar(symbol): sqrt(curvature / mass)},
        ),
        routes={"all_coordinates": lambda found: (about.known(_determinant_about(about, found)), ZERO)},
        outcome=_sort(result, exists),
        key=key,
        kind="squared angular speed",
        phrase_data=PhraseData(
            named={
                **{role: Relation(s, "=", v) for role, (s, v) in told.items()},
                **({"exists": exists} if exists is not None else {}),
            },
            points_to={"where": at},
        ),
        facts=[SquareOf(symbol, exists)],
    )


def _sort(value: Expr, exists: Relation | None) -> str:
    sign = sign_known(value)
    sign = sign_where(value, exists) if sign is None else sign
    return "conditional" if sign is None else ("neutral", "stable", "unstable")[sign]


def _about_rest(of: Quantity, at: Quantity) -> About:
    potential = at.needed(RestOf).potential
    if not (of.step == potential.step or potential.rests_on(of)):
        raise Rejected(Complaint("different-subjects", f"`{at.key}` is not an equilibrium of `{of.key}`"))
    matter = _matter(potential)
    q = _only(potential)
    place = at.needed(Rest).values[q]
    rates = dict(matter.rates) if isinstance(matter, ReducedMatter) else {}
    about = About(potential, matter, q, place, {}, {}, {})
    return About(potential, matter, q, place, {s: about.there(v) for s, v in rates.items()}, {}, {})


def _about_steady(of: Quantity, at: Quantity, without: Expr | None) -> About:
    steady, seen = at.needed(Steady), of.needed(SeenWith)
    if seen.lagrangian.step != steady.lagrangian.step:
        message = f"`{at.key}` and `{of.key}` belong to different Lagrangians"
        raise Rejected(Complaint("different-subjects", message))
    q, matter = _only(of), seen.matter
    if {c.needed(OfCoordinate).coordinate.symbol for c in seen.constants} != set(steady.rates):
        message = f"`{of.key}`: not all cyclic coordinates are eliminated"
        raise Rejected(Complaint("wrong-argument", message))
    place = steady.values[q]
    about = About(of, matter, q, place, steady.rates, {}, {})
    going = {rate(s): v for s, v in steady.rates.items()}
    kept = {fact.momentum: fact.value for each in of.ancestors() if (fact := each.fact(KeptMomentum)) is not None}
    momenta: dict[Symbol, Expr] = {}
    for c in seen.constants:
        value = presented(about.there(bound(explicit(c.value), going)))
        given = kept.get(c.symbol)
        momenta.update({c.symbol: value} if given is None else _letter_of_value(given, value, steady.lagrangian, of))
    whole = About(of, matter, q, place, steady.rates, momenta, {})
    mass = about.there(diff(matter.momentum_along(q), rate(q)))
    value = whole.known(about.there(diff(explicit(of.value), q, 2)) / mass)
    letter = _taken_out(steady.conditions[0], value, without, at)
    return About(of, matter, q, place, steady.rates, momenta, letter)


def _matter(potential: Quantity) -> Matter:
    found = matter_behind(potential)
    return found if found is not None and found.coordinates else potential.needed(Matter)


def _only(potential: Quantity) -> Symbol:
    left = _matter(potential).coordinates
    if len(left) != 1:
        names = ", ".join(q.name for q in left)
        message = f"`frequency_squared_about` needs one remaining coordinate, but `{potential.key}` has {names}"
        raise Rejected(Complaint("wrong-argument", message, help="`normal_modes` is for several coordinates"))
    return left[0]


def _taken_out(condition: Expr, value: Expr, without: Expr | None, at: Quantity) -> dict[Symbol, Expr]:
    """Return the symbol `without` with its value; by default, the symbol whose elimination gives the shortest result.

    If the condition is 0 = 0, the result is an empty dictionary.
    """
    if is_zero(condition):
        return {}
    letters = [without] if without is not None else sorted(condition.free_symbols, key=str)
    ways = [
        {s: found} for s in letters if isinstance(s, Symbol) and (found := solved_for_letter(condition, s)) is not None
    ]
    if not ways:
        message = f"`frequency_squared_about`: `{at.key}` cannot be solved for {without or 'any symbol'}"
        others = [
            s.name for s in sorted(condition.free_symbols, key=str) if solved_for_letter(condition, s) is not None
        ]
        help_line = f"the condition can be solved for {' or '.join(others)}" if others else None
        raise Rejected(Complaint("wrong-argument", message, help=help_line))
    if len(ways) == 1:
        return ways[0]
    value = presented(value)
    return min(ways, key=lambda way: (length(tidied(bound(value, way))), str(way)))


def _letter_of_value(given: Expr, value: Expr, lagrangian: Quantity, of: Quantity) -> dict[Symbol, Expr]:
    """Return a symbol of a given momentum with its value in the steady motion.

    For example, if the given momentum C w has the value C (s + Omega cos(a)) in the steady motion, return w with the
    value s + Omega cos(a).
    """
    known = explicit(lagrangian.value).free_symbols | value.free_symbols
    for letter in sorted(given.free_symbols - known, key=str):
        if (found := solved_for_letter(given - value, letter)) is not None:
            return {letter: presented(found)}
    message = (
        f"`frequency_squared_about`: in `{of.key}` the momentum is given as {given}; in the steady motion it is "
        f"{value}, and {given} = {value} cannot be solved for a symbol of {given}"
    )
    help_line = "give this momentum as a separate symbol, or omit its value"
    raise Rejected(Complaint("wrong-argument", message, help=help_line))


def _determinant_about(about: About, found: Expr) -> Expr:
    """Return the determinant of d'Alembert's equations to first order, for displacements e^(s t) with s^2 = -omega^2.

    For a cyclic coordinate the unknown is its rate, so the column of this coordinate has one factor of s fewer. Common
    powers of s are divided out.
    """
    matter = about.matter.whole if isinstance(about.matter, ReducedMatter) else about.matter
    moving = [about.q, *about.rates]
    s = Dummy("s")
    still = {rate(q, n): ZERO for q in moving for n in (1, 2)} | {rate(q): v for q, v in about.rates.items()}

    def entry(i: int, j: int) -> Expr:
        left = explicit(matter.inertia_along(moving[int(i)]) - matter.force_along(moving[int(i)]))
        other = moving[int(j)]
        slopes = [slope(left, rate(other, n) if n else other) for n in range(3)]
        at_place = [_without_angles(each.xreplace({**still, about.q: about.place}), about.rates) for each in slopes]
        if j:  # the unknown is the rate, because a cyclic coordinate itself does not occur
            return at_place[1] + s * at_place[2]
        return at_place[0] + s * at_place[1] + s**2 * at_place[2]

    matrix = ImmutableDenseMatrix(len(moving), len(moving), entry)
    polynomial = expand(determinant_of(matrix)).as_poly(s)
    lowest = min(n for (n,) in polynomial.monoms())
    powers = [(n - lowest, c) for (n,), c in polynomial.terms()]
    return Add(*(c * (s**n if n % 2 else (-found) ** (n // 2)) for n, c in powers))


def _without_angles(value: Expr, cyclic: Iterable[Symbol]) -> Expr:
    """Set the cyclic coordinates to zero if the value does not depend on them, so that most terms vanish."""
    at_zero = value.xreplace(dict.fromkeys(cyclic, ZERO))
    return at_zero if is_zero(value - at_zero) else value


@in_results(
    "frequency",
    "small oscillations about a steady motion, from the effective potential",
    of="frequency: an effective potential energy",
    at="results: the condition of the steady motion",
    without="for: the symbol to eliminate with the condition of the steady motion",
    symbol="symbol",
)
def _in_results(of: Quantity, at: Quantity, key: str, without: Letter = None, symbol: str = "omega_0") -> Quantity:
    squared = checked(frequency_squared_about)(of, at, without, symbol, f"{key}_squared")
    return checked(frequency)(squared, key=key)
