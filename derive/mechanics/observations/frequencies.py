"""Observations about frequencies and periods, such as an equivalent pendulum, closed orbits and exact oscillations."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from sympy import Add, Expr, Integer, Pow, Symbol, cos, expand, pi, powsimp, sin, sqrt, sqrtdenest

from derive.algebra.expressions import TIME, Amount, Factors, Ratio, Relation, Terms, explicit, rate
from derive.algebra.ranges import without_abs
from derive.algebra.rounding import rounded_form
from derive.algebra.tidy import tidied
from derive.mechanics.kinematics.coordinates import OfCoordinate
from derive.mechanics.lagrange.facts import Energies
from derive.mechanics.observations import claims
from derive.mechanics.observations.comparisons import linear_equations
from derive.mechanics.observations.view import Observed, View, numbered, observation, simple
from derive.mechanics.rest.facts import RestOf
from derive.mechanics.vibrations.facts import Linear, Mode
from derive.solving.relations import solved_for_letter
from derive.steps import defined
from derive.steps.establish import PhraseData
from derive.steps.numeric import WholeSwing
from derive.steps.record import coordinates_in, free_letter
from derive.steps.rule import CHECK, TRIALS, Rule
from derive.steps.signs import sign_for_all
from derive.steps.step import Quantity, is_zero

PERIOD = "vibrations.period"
OSCILLATES = ("vibrations.frequency", "vibrations.mode_frequency", "vibrations.uncoupled_frequency")
ROOTS, STEADY = "answers.roots", "motion.steady_motion"

PENDULUM = Rule(
    "observations.pendulum",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 7 (the physical pendulum)",
    outcomes={
        "length": claims.swings_like_a_pendulum,
        "named": claims.swings_like_a_pendulum,
        "field": claims.swings_in_the_field,
    },
    evidence={"pendulum": CHECK},
    named={
        "length": claims.is_a_length_or_its_symbol,
        "equal": claims.is_value_of_the_symbol,
        "field": claims.differs_from_gravity,
    },
)


def pendulum(view: View) -> Observed:
    """Simple pendulum with the same frequency: its length l = g/omega^2 or, for a given length l, the acceleration
    omega^2 l that replaces g."""
    for of in view.values("angular speed", "time"):
        for g in view.gravity if _seen(of) else ():
            found = _like_a_pendulum(view, _squared(of), g)
            if found is not None:
                yield _pendulum(of, g, *found)


def _seen(of: Quantity) -> str:
    """Return the word for a period, the frequency of an oscillation or the rate of a rotation.

    The word is "" for any other answer, such as a growth rate, zero, or a rate with a minus sign.
    """
    if of.step.rule == PERIOD:
        return "period"
    mode = of.fact(Mode)
    stays = of.step.outcome not in ("growing", "unstable", "neutral") and (
        mode is None or mode.root.sign not in (-1, 0)
    )
    if of.step.rule in OSCILLATES and stays:
        return "frequency"
    is_rate = of.step.rule == ROOTS and not of.value.could_extract_minus_sign() and not is_zero(of.value)
    return "rate" if is_rate else ""


def _squared(of: Quantity) -> Expr:
    value = explicit(of.value)
    return tidied(4 * pi**2 / value**2 if of.step.rule == PERIOD else value**2)


def _like_a_pendulum(view: View, square: Expr, g: Symbol) -> tuple[str, dict[str, Any], list[Quantity]] | None:
    """Return the outcome, the data of the sentence, and a list of the steps that the sentence cites; None if there is
    nothing to state. Only a step that introduces the symbol of the length is cited.

    A length that is only a given symbol is not worth a sentence: the system may be a simple pendulum.
    """
    length = tidied(g / square)
    if g not in length.free_symbols:
        worth_it = not isinstance(length, Symbol) and simple(length, 6) and _has_rational_factors(length)
        return ("length", {"length": length}, []) if worth_it else None
    defined_first = sorted(view.shown, key=lambda shown: shown.step.rule != defined.QUANTITY.name)
    for step in defined_first:
        for name, value in step.named_values:
            if isinstance(value, Expr) and not isinstance(value, Symbol) and is_zero(value - length):
                return "named", {"length": name, "equal": length}, [step]
    for letter in view.of_kind("length"):
        field = tidied(square * letter)
        if field.is_Add and letter not in field.free_symbols and g in field.free_symbols and simple(field, 2):
            return "field", {"length": letter, "field": field}, []
    return None


def _pendulum(of: Quantity, g: Symbol, outcome: str, data: dict[str, Any], known: list[Quantity]) -> Quantity:
    square = _squared(of)
    return observation(
        PENDULUM,
        lambda *_: tidied(g / square),
        {"of": of, "g": g},
        routes={"pendulum": lambda found: (found * square, g)},
        outcome=outcome,
        phrase_data=PhraseData(named=data, words={"seen": _seen(of)}, points_to=numbered("known", known)),
        key=f"{of.key}_as_pendulum",
    )


def _has_rational_factors(value: Expr) -> bool:
    roots = [power for power in value.atoms(Pow) if power.base.is_number]
    return not roots and all(number.is_Rational for number in value.atoms() if number.is_number)


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


def orbit(view: View) -> Observed:
    """Ratio of the radial frequency to the orbital rate; a nearly circular orbit closes if this ratio is rational."""
    for of in view.values("angular speed"):
        if of.step.rule in OSCILLATES and _seen(of) and _has_polar_coordinates(view):
            for there, told, step in _orbital_rates(view):
                square = tidied(powsimp(tidied(explicit(of.value) ** 2 / there**2)))
                if square.is_number or simple(square, 8):
                    yield _orbit(of, there, told, step, square)


def _has_polar_coordinates(view: View) -> bool:
    """Whether the page's Lagrangian has exactly two coordinates: a positive length and an angle. A coordinate
    does not count if the page substitutes a constant for it, unless the coordinate is positive."""
    lagrangian = next((q for q in view.shown if q.fact(Energies) is not None), None)
    known = lagrangian.coordinates if lagrangian is not None else {}
    substituted = [told for q in view.shown for role, told in q.step.roles if role.startswith("value_")]
    constant = {told.left for told in substituted if isinstance(told, Relation) and not coordinates_in(told.right)}
    moving = {q: kind for q, kind in known.items() if q.is_positive or q not in constant}
    positive = [kind for q, kind in moving.items() if q.is_positive]
    return positive == ["length"] and sorted(moving.values()) == ["angle", "length"]


def _orbital_rates(view: View) -> Iterator[tuple[Expr, Any, Quantity]]:
    """Yield the orbital rate on the circular orbit, this rate in symbols, and the step that introduces the symbols."""
    turning = [q for q in view.shown if q.step.rule == "hamilton.rate_by_momenta" and q.step.kind == "angular speed"]
    rests = [q for q in view.shown if q.fact(RestOf) is not None and isinstance(q.symbol, Symbol)]
    if len(turning) == len(rests) == 1:
        (radius,) = rests[0].needed(RestOf).coordinates
        if radius.is_positive and radius in turning[0].value.free_symbols:
            value = tidied(explicit(turning[0].value).xreplace({radius: explicit(rests[0].value)}))
            told = Relation(turning[0].symbol, "=", turning[0].value.xreplace({radius: rests[0].symbol}))
            yield value, told, rests[0]
    for each in (q for q in view.shown if q.step.rule == ROOTS and q.step.kind == "angular speed"):
        if sign_for_all(each.value) == 1 and any(parent.step.rule == STEADY for parent in each.parents):
            yield explicit(each.value), each.symbol, each


def _orbit(of: Quantity, there: Expr, told: Any, step: Quantity, square: Expr) -> Quantity:
    ratio = without_abs(sqrt(square))
    outcome = {1: "one", 2: "two"}.get(ratio, "letters")
    if ratio.is_number and outcome == "letters":
        outcome = "rational" if ratio.is_Rational else "irrational"
    special = {"same": _closing(square, 1), "double": _closing(square, 4)} if outcome == "letters" else {}
    return observation(
        ORBIT,
        lambda *_: ratio,
        {"of": of},
        routes={"squares": lambda found: (found**2 * there**2, explicit(of.value) ** 2)},
        outcome=outcome,
        phrase_data=PhraseData(
            named={"on_circle": told, **{role: value for role, value in special.items() if value is not None}},
            points_to={"radius": step},
            outcome_data={"orbital_rate": there},
        ),
        key=f"{of.key}_and_orbit",
    )


def _closing(square: Expr, wanted: int) -> Relation | None:
    """Return an equation, symbol = value, for which the squared ratio is `wanted`; None if no such value is found."""
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


def modes(view: View) -> Observed:
    """Ratio of the frequencies of two normal modes; every motion is periodic if all such ratios are rational."""
    every = [each for each in view.values("angular speed") if each.fact(Mode) is not None]
    found = [each for each in every if _seen(each)]
    ratios = [(slow, fast, _ratio(slow, fast)) for slow, fast in pairwise(found)]
    odd = next((each for each in ratios if each[2].is_number and not each[2].is_rational), None)
    linear = linear_equations(every[0]) if every else None
    if odd is not None and linear is not None:
        yield _modes(linear, *odd, "irrational")
    elif linear is not None and len(ratios) == 1 and len(every) == 2 and ratios[0][2].is_Rational:
        yield _modes(linear, *ratios[0], "rational")


def _ratio(slow: Quantity, fast: Quantity) -> Expr:
    return sqrtdenest(sqrt(tidied(explicit(fast.value) ** 2 / explicit(slow.value) ** 2)))


def _modes(linear: Linear, slow: Quantity, fast: Quantity, ratio: Expr, outcome: str) -> Quantity:
    return observation(
        MODES,
        lambda *_: ratio,
        {"slow": slow, "fast": fast},
        routes={"squares": lambda found: (found**2 * explicit(slow.value) ** 2, explicit(fast.value) ** 2)},
        outcome=outcome,
        phrase_data=PhraseData(
            named={"ratio": Relation(Ratio(fast.symbol, slow.symbol), "=", ratio)},
            outcome_data={"system": (linear.mass, linear.stiffness)},
        ),
        key=f"{fast.key}_and_{slow.key}",
    )


ONE_FREQUENCY = Rule(
    "observations.one_frequency",
    source="Taylor, *Classical Mechanics*, section 5.3",
    outcomes={"generic": claims.all_frequencies_are_equal},
    evidence={"squares": CHECK},
)


def one_frequency(view: View) -> Observed:
    """A single frequency for all motions of a particle, so each orbit is an ellipse."""
    speeds = [q for q in view.shown if q.step.rule == "lagrange.squared_speed"]
    of_particle = len(speeds) == 1 and is_zero(
        explicit(speeds[0].value) - Add(*(rate(q) ** 2 for q in speeds[0].coordinates))
    )
    for of in view.values("angular speed") if of_particle else ():
        steps = [q for q in of.ancestors() if q.fact(Linear) is not None]
        is_common = of.step.outcome == "oscillating_repeated" or dict(of.step.words).get("coupling") == "all"
        if steps and is_common and _seen(of) and all("as_it_is" in dict(q.step.roles) for q in steps):
            yield _one_frequency(of, steps[0])


def _one_frequency(of: Quantity, step: Quantity) -> Quantity:
    linear = step.needed(Linear)
    motions = [q for q in step.parents if q.fact(OfCoordinate) is not None]
    return observation(
        ONE_FREQUENCY,
        lambda *_: explicit(of.value) ** 2,
        {"of": of},
        routes={"squares": lambda found: (linear.stiffness, found * linear.mass)},
        phrase_data=PhraseData(
            outcome_data={
                "system": (linear.mass, linear.stiffness),
                "moving": [q.needed(OfCoordinate).coordinate.symbol for q in motions],
                "motions": [explicit(q.value).residual for q in motions],
            }
        ),
        key=f"{of.key}_of_all",
    )


EXACT = Rule(
    "observations.exact",
    source="Landau, Lifshitz, *Mechanics*, section 21, problem 5",
    outcomes={"generic": claims.isochronous},
    evidence={"harmonic": CHECK},
    named={"path": claims.is_the_length_along_the_path, "harmonic": claims.is_harmonic_along_the_path},
)


@dataclass(frozen=True)
class OneCoordinate:
    """A Lagrangian mu(q) q_dot^2/2 - U(q), and the stable equilibrium `lowest`."""

    q: Symbol
    mu: Expr
    energy: Expr
    lowest: Expr

    @property
    def square(self) -> Expr:
        """Return d^2U/ds^2 for ds = sqrt(mu) dq, without an integral: U''/mu - U' mu'/(2 mu^2)."""
        slope, mu = self.energy.diff(self.q), self.mu
        return tidied(slope.diff(self.q) / mu - slope * mu.diff(self.q) / (2 * mu**2))

    def path(self, mass: Symbol) -> Expr | None:
        """Return s with T = m s_dot^2/2 and U = U_0 + m omega^2 s^2/2.

        U - U_0 must be proportional to 1 - cos(q - q_0), where q_0 is the equilibrium; otherwise the result is None.
        """
        turned = self.q - self.lowest
        height = self.energy - self.energy.xreplace({self.q: self.lowest})
        size = tidied(2 * height / (self.square * mass) / (1 - cos(turned)))
        return None if size.has(self.q) else sqrt(2 * size) * sin(turned / 2)


def exact(view: View) -> Observed:
    """Oscillation whose period does not depend on the amplitude at all: d^2U/ds^2 is constant for ds = sqrt(mu) dq."""
    found = _one_coordinate(view)
    oscillates = [q for q in view.answers if q.step.kind in ("time", "angular speed")]
    if found is not None and oscillates and found[1].mu.has(found[1].q):
        square = found[1].square
        for mass in view.of_kind("mass") if not square.has(found[1].q) and sign_for_all(square) == 1 else ():
            if mass in found[1].mu.free_symbols and (path := found[1].path(mass)) is not None:
                yield _exact(*found, mass, path)


def _one_coordinate(view: View) -> tuple[Quantity, OneCoordinate] | None:
    """Return the step of the Lagrangian and the parts of this Lagrangian.

    The Lagrangian must have one coordinate and the form mu(q) q_dot^2/2 - U(q). The page must have the linear equation
    of this coordinate about an equilibrium. Otherwise the result is None.
    """
    linear = next((fact for q in view.shown if (fact := q.fact(Linear)) is not None), None)
    lagrangian = next((q for q in view.shown if q.fact(Energies) is not None), None)
    if linear is None or lagrangian is None or len(linear.place) != 1 or len(lagrangian.coordinates) != 1:
        return None
    q, whole = linear.place[0][0].symbol, explicit(lagrangian.value)
    mu, energy = tidied(whole.diff(rate(q), 2)), -whole.xreplace({rate(q): Integer(0)})
    fits = TIME not in whole.free_symbols and is_zero(whole - mu * rate(q) ** 2 / 2 + energy)
    return (lagrangian, OneCoordinate(q, mu, energy, explicit(linear.place[0][1]))) if fits else None


def _exact(lagrangian: Quantity, motion: OneCoordinate, mass: Symbol, path: Expr) -> Quantity:
    q, mu, energy, square = motion.q, motion.mu, motion.energy, motion.square
    s = Symbol(free_letter("s"), real=True)
    harmonic = Relation(Terms(rate(s, 2), square * s), "=", Integer(0))
    return observation(
        EXACT,
        lambda *_: square,
        {"lagrangian": lagrangian},
        routes={"harmonic": lambda found: ((energy.diff(q) ** 2 / mu).diff(q) / 2, found * energy.diff(q))},
        phrase_data=PhraseData(
            named={"path": Relation(s, "=", path), "harmonic": harmonic},
            outcome_data={"q": q, "mu": mu, "energy": energy, "square": square, "lowest": motion.lowest, "mass": mass},
        ),
        key="exact_oscillation",
    )


PAIR = Rule(
    "observations.pair",
    source="Brown, Gabrielse, *Reviews of Modern Physics* 58, 233 (1986)",
    outcomes={"generic": claims.have_this_sum_and_product},
    evidence={"square": CHECK},
    named={"sum": claims.adds_the_symbols, "product": claims.multiplies_the_symbols},
)


def pair(view: View) -> Observed:
    """Sum and product of two frequencies, if the sum and the product contain no root, but a frequency does."""
    found = [q for q in view.values("angular speed") if q.step.rule == "vibrations.gyroscopic_frequency"]
    for one, other in pairwise(found):
        added = tidied(explicit(one.value) + explicit(other.value))
        multiplied = tidied(expand(explicit(one.value) * explicit(other.value)))
        if _has_root(one.value) and not _has_root(added) and not _has_root(multiplied):
            yield _pair(one, other, added, multiplied)


def _has_root(value: Expr) -> bool:
    return any(not power.exp.is_Integer for power in value.atoms(Pow))


def _pair(one: Quantity, other: Quantity, added: Expr, multiplied: Expr) -> Quantity:
    apart = expand((explicit(other.value) - explicit(one.value)) ** 2)
    return observation(
        PAIR,
        lambda *_: added,
        {"of": one, "other": other},
        routes={"square": lambda found: (found**2 - 4 * multiplied, apart)},
        phrase_data=PhraseData(
            named={
                "sum": Relation(Terms(one.symbol, other.symbol), "=", added),
                "product": Relation(Factors(one.symbol, other.symbol), "=", multiplied),
            }
        ),
        key=f"{one.key}_and_{other.key}",
    )


LONGER = Rule(
    "observations.longer",
    source="Taylor, *Classical Mechanics*, problem 4.38",
    outcomes={"generic": claims.has_an_amplitude},
    evidence={TRIALS: CHECK},
    named={"percent": claims.longer_by, "amplitude": claims.is_the_amplitude},
)
THIRTY_DEGREES = Amount(Integer(30), "degree", pi / 180)


def longer(view: View) -> Observed:
    """How much longer the period is at an amplitude of 30 degrees than at small amplitudes, in percent."""
    for of in view.answers:
        whole = of.fact(WholeSwing)
        letter = whole.time.args[2] if whole is not None else None
        if whole is not None and isinstance(letter, Symbol) and view.letters.get(letter) == "angle":
            part = tidied(explicit(of.value) / explicit(of.value).xreplace({letter: Integer(0)}))
            if part.free_symbols == {letter}:
                yield _longer(of, letter, part, whole)


def _longer(of: Quantity, letter: Symbol, part: Expr, whole: WholeSwing) -> Quantity:
    there = {letter: explicit(THIRTY_DEGREES)}
    excess = 100 * (part.xreplace(there) - 1)
    return observation(
        LONGER,
        lambda *_: excess,
        {"letter": letter},
        phrase_data=PhraseData(
            named={"percent": rounded_form(excess, 2), "amplitude": Relation(letter, "=", THIRTY_DEGREES)},
            outcome_data={"swing": whole.time},
        ),
        parents=of.parents,
        key=f"{of.key}_longer",
    )
