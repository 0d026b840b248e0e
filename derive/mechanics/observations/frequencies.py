"""Observations about frequencies: an equivalent pendulum, closed orbits, periodic motions, exact oscillations."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from sympy import Add, Expr, Integer, Pow, Symbol, cos, expand, pi, powsimp, sin, sqrt, sqrtdenest

from derive.algebra.expressions import TIME, Amount, Factors, Ratio, Relation, Terms, explicit, rate
from derive.algebra.rounding import rounded_form
from derive.algebra.tidy import tidied
from derive.mechanics.lagrange.facts import Energies
from derive.mechanics.observations import claims
from derive.mechanics.observations.view import OF_ANY_SUBJECT, ONE_LINE, View, simple
from derive.mechanics.rest.facts import RestOf
from derive.mechanics.vibrations.facts import Linear, Mode
from derive.solving.relations import solved_for_letter
from derive.steps.establish import PhraseData, establish
from derive.steps.numeric import WholeSwing
from derive.steps.record import free_letter
from derive.steps.rule import CHECK, Rule
from derive.steps.signs import sign_for_all
from derive.steps.step import Quantity, is_zero

PERIOD = "vibrations.period"
OSCILLATES = ("vibrations.frequency", "vibrations.mode_frequency")
ROOTS, STEADY = "answers.roots", "motion.steady_motion"

PENDULUM = Rule(
    "observations.pendulum",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, chapter 7 (the physical pendulum)",
    outcomes={
        "length": lambda facts: claims.swings_like_a_pendulum(facts, facts.inputs["length"]),
        "named": lambda facts: claims.swings_like_a_pendulum(facts, facts.inputs["equal"]),
        "field": lambda facts: claims.swings_in_the_field(facts, facts.inputs["field"]),
    },
    evidence={"pendulum": CHECK},
    named={
        "equal": claims.is_value_of_a_symbol,
    },
)


def pendulum(view: View) -> Iterator[Quantity]:
    """Simple pendulum with the same frequency: omega^2 = g/l."""
    for of in view.values("angular speed", "time"):
        seen = _seen(of)
        square = _squared(of) if seen else None
        for g in view.gravity if square is not None else ():
            yield from _pendulum_of(view, of, square, g, seen)


def _seen(of: Quantity) -> str:
    if of.step.rule == PERIOD:
        return "period"
    if of.step.rule in OSCILLATES and of.step.outcome not in ("growing", "free", "unstable", "neutral"):
        return "frequency"
    is_rate = of.step.rule == ROOTS and not of.value.could_extract_minus_sign() and not is_zero(of.value)
    return "rate" if is_rate else ""


def _squared(of: Quantity) -> Expr:
    """Return the squared angular frequency."""
    value = explicit(of.value)
    return tidied(4 * pi**2 / value**2 if of.step.rule == PERIOD else value**2)


def _pendulum_of(view: View, of: Quantity, square: Expr, g: Symbol, seen: str) -> Iterator[Quantity]:
    length = tidied(g / square)
    data: dict[str, Any] = {"g": g}
    outcome, named, parents = "length", {}, []
    if g in length.free_symbols:
        known = next(((q, n) for q in view.shown for n, v in claims.named_values(q) if _is(v, length)), None)
        field = next((each for l in view.of_kind("length") if (each := _field(square, l, g)) is not None), None)
        if known is not None:
            outcome, named, parents = "named", {"equal": length}, [known[0]]
            data["length"] = known[1]
        elif field is not None:
            outcome, data = "field", {**data, "length": field[0], "field": field[1]}
        else:
            return
    elif isinstance(length, Symbol) or not simple(length, 6) or not _has_rational_factors(length):
        return
    else:
        data["length"] = length
    yield establish(
        PENDULUM,
        None,
        lambda *_: length,
        {"of": of, **data},
        routes={"pendulum": lambda found: (found * square, g)},
        outcome=outcome,
        lines=ONE_LINE,
        phrase_data=PhraseData(named=named, words={"seen": seen}, points_to={f"known_{i}": q for i, q in enumerate(parents)}),
        scope=OF_ANY_SUBJECT,
        key=f"{of.key}_as_pendulum",
    )


def _is(value: Any, other: Expr) -> bool:
    return isinstance(value, Expr) and not isinstance(value, Symbol) and is_zero(value - other)


def _field(square: Expr, length: Symbol, g: Symbol) -> tuple[Symbol, Expr] | None:
    """Return a length l and the acceleration omega^2 l if l cancels and the acceleration is a sum that contains g."""
    found = tidied(square * length)
    fits = found.is_Add and length not in found.free_symbols and g in found.free_symbols and simple(found, 2)
    return (length, found) if fits else None


def _has_rational_factors(value: Expr) -> bool:
    """Whether the numbers in a value are rational."""
    return all(number.is_Rational for number in explicit(value).atoms() if number.is_number) and not any(
        power.base.is_number for power in value.atoms(sqrt(2).func)
    )


ORBIT = Rule(
    "observations.orbit",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 3.6; Morin, *Introduction to Classical Mechanics*, "
    "chapter 7",
    outcomes={
        "one": claims.orbital_ratio(lambda ratio: ratio == 1),
        "two": claims.orbital_ratio(lambda ratio: ratio == 2),
        "rational": claims.orbital_ratio(lambda ratio: ratio.is_Rational and ratio not in (1, 2)),
        "irrational": claims.orbital_ratio(lambda ratio: ratio.is_number and not ratio.is_rational),
        "letters": claims.orbital_ratio(lambda ratio: not ratio.is_number),
    },
    evidence={"squares": CHECK},
    named={
        "on_circle": claims.rate_on_the_circle,
        "same": claims.closes_for(1),
        "double": claims.closes_for(2),
    },
)


def orbit(view: View) -> Iterator[Quantity]:
    """Ratio of the radial frequency and the orbital rate: a nearly circular orbit closes if this ratio is rational."""
    for of in view.values("angular speed"):
        if of.step.rule in OSCILLATES and _seen(of):
            for rate_there, on_circle, parents in _orbital_rates(view):
                yield from _orbit_of(of, rate_there, on_circle, parents)


def _orbital_rates(view: View) -> Iterator[tuple[Expr, Any, dict[str, Quantity]]]:
    """Yield the orbital rate on the circular orbit, the same in letters, and the steps in which the letters occur."""
    turning = [q for q in view.shown if q.step.rule == "hamilton.rate_by_momenta" and q.step.kind == "angular speed"]
    rests = [q for q in view.shown if q.fact(RestOf) is not None and isinstance(q.symbol, Symbol)]
    if len(turning) == len(rests) == 1:
        (radius,) = rests[0].needed(RestOf).coordinates
        if radius.is_positive and radius in turning[0].value.free_symbols:
            value = tidied(explicit(turning[0].value).xreplace({radius: explicit(rests[0].value)}))
            told = Relation(turning[0].symbol, "=", turning[0].value.xreplace({radius: rests[0].symbol}))
            yield value, told, {"radius": rests[0]}
    for each in view.shown:
        if each.step.rule == ROOTS and each.step.kind == "angular speed" and sign_for_all(each.value) == 1:
            if any(parent.step.rule == STEADY for parent in each.parents):
                yield explicit(each.value), each.symbol, {"radius": each}


def _orbit_of(of: Quantity, there: Expr, on_circle: Relation, parents: dict[str, Quantity]) -> Iterator[Quantity]:
    square = tidied(powsimp(tidied(explicit(of.value) ** 2 / there**2)))
    ratio = sqrt(square)
    outcome = {1: "one", 2: "two"}.get(ratio, "letters")
    if ratio.is_number and outcome == "letters":
        outcome = "rational" if ratio.is_Rational else "irrational"
    named: dict[str, Any] = {"on_circle": on_circle}
    if outcome == "letters":
        if not simple(square, 8):
            return
        found = {name: told for name, n in (("same", 1), ("double", 4)) if (told := _closing(square, n)) is not None}
        named |= found
    yield establish(
        ORBIT,
        None,
        lambda *_: ratio,
        {"of": of},
        routes={"squares": lambda found: (found**2 * there**2, explicit(of.value) ** 2)},
        outcome=outcome,
        lines=ONE_LINE,
        phrase_data=PhraseData(named=named, points_to=parents, outcome_data={"orbital_rate": there}),
        scope=OF_ANY_SUBJECT,
        key=f"{of.key}_and_orbit",
    )


def _closing(square: Expr, wanted: int) -> Relation | None:
    """Return the value of a symbol for which the squared ratio is this number, if the symbol can have this value."""
    for letter in sorted(square.free_symbols, key=str):
        found = solved_for_letter(square - wanted, letter)
        if found is not None and not (letter.is_positive and sign_for_all(found) != 1):
            return Relation(letter, "=", found)
    return None


MODES = Rule(
    "observations.modes",
    source="Taylor, *Classical Mechanics*, chapter 11",
    outcomes={"rational": claims.ratio_of_modes(True), "irrational": claims.ratio_of_modes(False)},
    evidence={"squares": CHECK},
    named={"ratio": claims.is_ratio_of("fast", "slow")},
)


def modes(view: View) -> Iterator[Quantity]:
    """Ratio of the frequencies of normal modes: every motion is periodic if all ratios are rational."""
    found = [each for each in view.values("angular speed") if each.fact(Mode) is not None and _seen(each)]
    ratios = [(one, other, tidied(explicit(other.value) ** 2 / explicit(one.value) ** 2)) for one, other in pairwise(found)]
    numbers = [each for each in ratios if each[2].is_number]
    odd = [each for each in numbers if not sqrt(each[2]).is_rational]
    if not odd and (len(numbers) < len(ratios) or len(numbers) != 1):
        return
    slow, fast, square = (odd or numbers)[0]
    ratio = sqrtdenest(sqrt(square))
    told = Relation(Ratio(fast.symbol, slow.symbol), "=", ratio)
    yield establish(
        MODES,
        None,
        lambda *_: ratio,
        {"slow": slow, "fast": fast},
        routes={"squares": lambda r: (r**2 * explicit(slow.value) ** 2, explicit(fast.value) ** 2)},
        outcome="irrational" if odd else "rational",
        lines=ONE_LINE,
        phrase_data=PhraseData(named={"ratio": told}),
        scope=OF_ANY_SUBJECT,
        key=f"{fast.key}_and_{slow.key}",
    )


ONE_FREQUENCY = Rule(
    "observations.one_frequency",
    source="Taylor, *Classical Mechanics*, section 5.3",
    outcomes={"generic": claims.all_frequencies_are_equal},
    evidence={"squares": CHECK},
)


def one_frequency(view: View) -> Iterator[Quantity]:
    """One frequency of all motions of a particle: each orbit is an ellipse."""
    speeds = [q for q in view.shown if q.step.rule == "lagrange.squared_speed"]
    if len(speeds) != 1 or not is_zero(explicit(speeds[0].value) - Add(*(rate(q) ** 2 for q in speeds[0].coordinates))):
        return
    for of in view.values("angular speed"):
        linear = next((each.fact(Linear) for each in of.ancestors() if each.fact(Linear) is not None), None)
        if of.step.outcome == "oscillating_repeated" and linear is not None and of.needed(Mode).root.times > 1:
            square = explicit(of.value) ** 2
            yield establish(
                ONE_FREQUENCY,
                None,
                lambda *_, square=square: square,
                {"of": of},
                routes={"squares": lambda found, linear=linear: (linear.stiffness, found * linear.mass)},
                lines=ONE_LINE,
                phrase_data=PhraseData(outcome_data={"system": (linear.mass, linear.stiffness)}),
                scope=OF_ANY_SUBJECT,
                key=f"{of.key}_of_all",
            )


EXACT = Rule(
    "observations.exact",
    source="Landau, Lifshitz, *Mechanics*, section 11, problem 2",
    outcomes={"along": claims.isochronous, "generic": claims.isochronous},
    evidence={"harmonic": CHECK},
    named={"path": claims.is_the_length_along_the_path, "harmonic": claims.is_harmonic_along_the_path},
)


def exact(view: View) -> Iterator[Quantity]:
    """Oscillation whose period does not depend on the amplitude at all.

    With T = mu q_dot^2/2 and ds = sqrt(mu) dq, the motion along s is harmonic if d^2U/ds^2 is constant. This derivative
    is U''/mu - U' mu'/(2 mu^2), so no integral is needed; s follows from U = U_0 + omega^2 s^2/2.
    """
    linear = next((each.fact(Linear) for each in view.shown if each.fact(Linear) is not None), None)
    lagrangian = next((each for each in view.shown if each.fact(Energies) is not None), None)
    for of in view.answers:
        if of.step.kind not in ("time", "angular speed") or linear is None or lagrangian is None:
            continue
        if len(linear.place) == 1 and (found := _one_coordinate(lagrangian, *linear.place[0])) is not None:
            q, mu, energy = found
            square = tidied(energy.diff(q, 2) / mu - energy.diff(q) * mu.diff(q) / (2 * mu**2))
            if mu.diff(q) != 0 and not square.has(q) and sign_for_all(square) == 1:
                yield _exact_for(view, of, q, mu, energy, square, linear.place[0][1])


def _one_coordinate(lagrangian: Quantity, place: Any, _: Expr) -> tuple[Symbol, Expr, Expr] | None:
    """Return q, mu and U of a Lagrangian mu q_dot^2/2 - U with one coordinate."""
    q, whole = place.symbol, explicit(lagrangian.value)
    q_dot = rate(q)
    mu, energy = tidied(whole.diff(q_dot, 2)), -whole.xreplace({q_dot: Integer(0)})
    moving = {s for each in lagrangian.coordinates for s in (each, rate(each))} - {q, q_dot}
    fits = not whole.free_symbols & {TIME, *moving} and is_zero(whole - mu * q_dot**2 / 2 + energy)
    return (q, mu, energy) if fits else None


def _exact_for(
    view: View, of: Quantity, q: Symbol, mu: Expr, energy: Expr, square: Expr, lowest: Expr
) -> Quantity:
    path = _path(view, q, mu, energy, square, lowest)
    named: dict[str, Any] = {}
    data = {"q": q, "mu": mu, "energy": energy, "square": square, "lowest": lowest}
    if path is not None:
        s, value, data["mass"] = path
        named = {
            "path": Relation(s, "=", value),
            "harmonic": Relation(Terms(rate(s, 2), Factors(square, s)), "=", Integer(0)),
        }
    return establish(
        EXACT,
        None,
        lambda *_: square,
        {"of": of},
        routes={"harmonic": lambda found: ((energy.diff(q) ** 2 / mu).diff(q) / 2, found * energy.diff(q))},
        outcome="along" if named else "generic",
        lines=ONE_LINE,
        phrase_data=PhraseData(named=named, outcome_data=data),
        scope=OF_ANY_SUBJECT,
        key=f"{of.key}_exact",
    )


def _path(
    view: View, q: Symbol, mu: Expr, energy: Expr, square: Expr, lowest: Expr
) -> tuple[Symbol, Expr, Symbol] | None:
    """Return s, its value as a function of q, and the mass m with T = m s_dot^2/2; for U that grows as 1 - cos q."""
    mass = next((m for m in view.of_kind("mass") if m in mu.free_symbols and not tidied(mu / m).has(m)), None)
    if mass is None:
        return None
    turned = q - lowest
    size = tidied(2 * (energy - energy.xreplace({q: lowest})) / (square * mass) / (1 - cos(turned)))
    if size.has(q):
        return None
    return Symbol(free_letter("s"), real=True), sqrt(2 * size) * sin(turned / 2), mass


PAIR = Rule(
    "observations.pair",
    source="Brown, Gabrielse, *Reviews of Modern Physics* 58, 233 (1986)",
    outcomes={"generic": claims.have_this_sum_and_product},
    evidence={"square": CHECK},
    named={"sum": lambda facts, told: True, "product": lambda facts, told: True},
)


def pair(view: View) -> Iterator[Quantity]:
    """Sum and product of two frequencies, if these are simpler than the frequencies."""
    found = [q for q in view.values("angular speed") if q.step.rule == "vibrations.gyroscopic_frequency"]
    for one, other in pairwise(found):
        added = tidied(explicit(one.value) + explicit(other.value))
        multiplied = tidied(expand(explicit(one.value) * explicit(other.value)))
        if not one.value.atoms(Pow) or added.has(sqrt(2).func) and any(not p.exp.is_Integer for p in added.atoms(Pow)):
            continue
        if any(not p.exp.is_Integer for p in one.value.atoms(Pow)):
            yield establish(
                PAIR,
                None,
                lambda *_, added=added: added,
                {"of": one, "other": other},
                routes={
                    "square": lambda s, one=one, other=other, product=multiplied: (
                        s**2 - 4 * product,
                        expand((explicit(other.value) - explicit(one.value)) ** 2),
                    )
                },
                lines=ONE_LINE,
                phrase_data=PhraseData(
                    named={
                        "sum": Relation(Terms(one.symbol, other.symbol), "=", added),
                        "product": Relation(Factors(one.symbol, other.symbol), "=", multiplied),
                    }
                ),
                scope=OF_ANY_SUBJECT,
                key=f"{one.key}_and_{other.key}",
            )


LONGER = Rule(
    "observations.longer",
    source="Taylor, *Classical Mechanics*, problem 4.38",
    outcomes={"generic": lambda facts: True},
    evidence={"series": CHECK},
    named={"percent": claims.longer_by, "amplitude": lambda facts, told: told == Relation(facts.inputs["letter"], "=", AT)},
)
AT = Amount(Integer(30), "degree", pi / 180)


def longer(view: View) -> Iterator[Quantity]:
    """Size of the correction to the period for an amplitude of 30 degrees."""
    for of in view.answers:
        whole, value = of.fact(WholeSwing), explicit(of.value)
        letter = whole.time.args[2] if whole is not None else None
        if not isinstance(letter, Symbol) or letter not in value.free_symbols or view.letters.get(letter) != "angle":
            continue
        part = tidied(value / value.xreplace({letter: Integer(0)}))
        if part.free_symbols != {letter}:
            continue
        excess = 100 * (part.xreplace({letter: explicit(AT)}) - 1)
        yield establish(
            LONGER,
            None,
            lambda *_, excess=excess: excess,
            {"letter": letter},
            routes={"series": lambda e, value=value, letter=letter: (
                (1 + e / 100) * value.xreplace({letter: Integer(0)}), value.xreplace({letter: explicit(AT)})
            )},
            lines=ONE_LINE,
            phrase_data=PhraseData(
                named={"percent": rounded_form(excess, 2), "amplitude": Relation(letter, "=", AT)},
                outcome_data={"swing": whole.time},
            ),
            parents=[q for q in of.parents],
            scope=OF_ANY_SUBJECT,
            key=f"{of.key}_longer",
        )
