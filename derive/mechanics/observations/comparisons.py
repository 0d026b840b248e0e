"""Observations that compare answers with each other or with a familiar motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Any

from sympy import Expr, Symbol, sin

from derive.algebra.expressions import Ratio, Relation, Terms, component_names, explicit, rate
from derive.algebra.tidy import tidied
from derive.mechanics.observations import claims
from derive.mechanics.observations.view import Observed, View, numbered, observation, symbols_behind
from derive.mechanics.vibrations.facts import Linear, Mode
from derive.steps.establish import PhraseData
from derive.steps.rule import CHECK, Rule
from derive.steps.step import Quantity, is_zero

PUT_IN = "answers.put_in"
RATES = ("speed", "angular speed")

MULTIPLE = Rule(
    "observations.multiple",
    source="none needed: division",
    outcomes={"generic": claims.is_this_multiple},
    evidence={"product": CHECK},
    named={"ratio": claims.is_ratio_of("of", "other"), "letter": claims.is_in_both},
)


def multiple(view: View) -> Observed:
    """Two velocities or angular velocities among the answers of one part, if their ratio is a rational number other
    than 1 and -1."""
    found = [q for q in view.values() if _is_rate(q) and not is_zero(q.value)]
    for pair in combinations(found, 2):
        ratios = [tidied(explicit(of.value) / explicit(other.value)) for of, other in (pair, pair[::-1])]
        if all(ratio.is_Rational for ratio in ratios) and ratios[0] not in (1, -1) and pair[0].symbol != pair[1].symbol:
            of, other = pair if abs(ratios[0]) > 1 else pair[::-1]
            both = view.in_order(explicit(of.value).free_symbols & explicit(other.value).free_symbols)
            if 0 < len(both) < 5:
                yield _multiple(of, other, max(ratios, key=abs), both)


def _is_rate(q: Quantity) -> bool:
    """Whether an answer is a velocity or an angular velocity, or a combination of answers of which at least one is a
    velocity or an angular velocity. Frequencies of vibrations do not count."""
    adds_rates = q.step.rule == "answers.combination" and any(parent.step.kind in RATES for parent in q.parents)
    return (q.step.kind in RATES or adds_rates) and q.step.rule.partition(".")[0] != "vibrations"


def _multiple(of: Quantity, other: Quantity, ratio: Expr, both: Sequence[Symbol]) -> Quantity:
    return observation(
        MULTIPLE,
        lambda *_: ratio,
        {"of": of, "other": other},
        routes={"product": lambda found: (found * explicit(other.value), explicit(of.value))},
        phrase_data=PhraseData(
            named={"ratio": Relation(Ratio(of.symbol, other.symbol), "=", ratio), **numbered("letter", both)}
        ),
        key=f"{of.key}_multiple",
    )


ORDER = Rule(
    "observations.order",
    source="none needed: comparison of numbers",
    outcomes={"generic": claims.first_to_arrive},
    evidence={"product": CHECK},
    named={"most": claims.is_case_of_the_first, "least": claims.is_case_of_the_last},
)


def order(view: View) -> Observed:
    """Constant accelerations in several special cases of one acceleration, sorted by size, if their ratios are positive
    rational numbers.
    """
    cases = [
        q
        for q in view.values("acceleration")
        if (q.step.rule, q.step.outcome) == (PUT_IN, "values") and _is_constant(q)
    ]
    for general in dict.fromkeys(_parents(q) for q in cases):
        own = [q for q in cases if _parents(q) == general]
        kind = _kind_of_the_letter(view, own)
        ratios = [tidied(explicit(q.value) / explicit(own[0].value)) for q in own]
        if kind and len(own) > 1 and all(r.is_Rational and r > 0 for r in ratios) and len(set(ratios)) == len(own):
            yield _in_order([q for _, q in sorted(zip(ratios, own, strict=True), key=lambda pair: -pair[0])], kind)


def _parents(q: Quantity) -> tuple[str, ...]:
    return tuple(parent.key for parent in q.parents)


def _kind_of_the_letter(view: View, cases: Sequence[Quantity]) -> str:
    """Return the kind of the symbol that has one value in each case; "" if the cases have values of several symbols, or
    if a case has several values.
    """
    told = [value for q in cases for role, value in q.step.roles if role.startswith("value_")]
    letters = {each.left for each in told}
    return view.letters.get(letters.pop(), "") if len(letters) == 1 and len(told) == len(cases) else ""


def _is_constant(q: Quantity) -> bool:
    moving = {s for each in q.coordinates for s in (each, rate(each))}
    return not is_zero(q.value) and not explicit(q.value).free_symbols & moving


def _in_order(falling: Sequence[Quantity], kind: str) -> Quantity:
    most, least = (explicit(q.value) for q in (falling[0], falling[-1]))
    return observation(
        ORDER,
        lambda *_: tidied(most / least),
        {},
        routes={"product": lambda found: (found * least, most)},
        phrase_data=PhraseData(
            points_to=numbered("case", falling),
            named={"most": _case(falling[0]), "least": _case(falling[-1])},
            outcome_data={"kind": kind},
        ),
        key=f"{falling[0].key}_greatest",
    )


def _case(q: Quantity) -> Any:
    return next(told for role, told in q.step.roles if role.startswith("value_"))


FAMILIAR = Rule(
    "observations.familiar",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 7",
    outcomes={"fall": claims.free_fall, "incline": claims.slides_freely},
    evidence={"product": CHECK},
    named={"letter": claims.is_free_of},
)


def familiar(view: View) -> Observed:
    """Acceleration that is a fixed fraction of g, or of g sin(alpha), the acceleration on an incline without
    friction."""
    for of in view.values("acceleration"):
        angles = [s for s in view.of_kind("angle") if s in explicit(of.value).free_symbols]
        for g in view.gravity if of.step.rule == "lagrange.acceleration" and len(angles) < 2 else ():
            known = g * sin(angles[0]) if angles else g
            part = abs(tidied(explicit(of.value) / known))
            if part.is_Rational and 0 < part < 1:
                yield _familiar(view, of, part, known, {"g": g, **({"alpha": angles[0]} if angles else {})})


def _familiar(view: View, of: Quantity, part: Expr, known: Expr, symbols: Mapping[str, Symbol]) -> Quantity:
    equations = [q for q in of.ancestors() if isinstance(q.value, Relation)]
    gone = [s for s in view.in_order(symbols_behind(equations)) if view.letters[s] in ("mass", "length")]
    return observation(
        FAMILIAR,
        lambda *_: part,
        {"of": of, **symbols},
        routes={"product": lambda found: ((found * known) ** 2, explicit(of.value) ** 2)},
        outcome="incline" if "alpha" in symbols else "fall",
        phrase_data=PhraseData(
            named=numbered("letter", gone),
            points_to=numbered("equation", equations),
            outcome_data={"familiar": known},
        ),
        key=f"{of.key}_familiar",
    )


UNAFFECTED = Rule(
    "observations.unaffected",
    source="Taylor, *Classical Mechanics*, sections 11.2 and 11.4",
    outcomes={"spring": claims.keeps_the_spring, "springs": claims.keep_the_springs, "mass": claims.stays_at_rest},
    evidence={"other_value": CHECK},
)


def unaffected(view: View) -> Observed:
    """Mode whose frequency does not depend on a spring constant or a mass, and the reason: the shape of the mode."""
    shapes = [q for q in view.answers if q.step.rule == "vibrations.mode_shape"]
    frequencies = [q for q in view.answers if q.step.rule == "vibrations.mode_frequency"]
    used = {s for q in frequencies for s in explicit(q.value).free_symbols}
    for of in frequencies:
        shape = next((each for each in shapes if of.key in each.step.inputs), None)
        whole = linear_equations(of)
        if shape is None or whole is None or is_zero(of.value):
            continue
        linear = whole.part([whole.moving.index(s) for s in of.needed(Mode).moving])
        for letter in view.in_order((used & linear.letters) - explicit(of.value).free_symbols):
            outcome, data = _reason(linear, letter, view.letters[letter])
            outcome = "springs" if outcome == "spring" and springs_with(of, letter) > 1 else outcome
            if outcome:
                yield _unaffected(of, shape, letter, outcome, data)


def linear_equations(of: Quantity) -> Linear | None:
    """Return the linear equations from which a frequency was derived; None if it was not derived from linear
    equations."""
    return next((fact for q in of.ancestors() if (fact := q.fact(Linear)) is not None), None)


def springs_with(of: Quantity, letter: Symbol) -> int:
    """Return how many springs with this constant contribute to the potential energy from which a result was derived."""
    energies = [q.subject.body for q in of.ancestors() if q.step.rule == "lagrange.potential_energy"]
    return max(
        (sum(explicit(each.energy).has(letter) for each in body.between if each.is_spring) for body in energies),
        default=0,
    )


def _reason(linear: Linear, letter: Symbol, kind: str) -> tuple[str, dict[str, Any]]:
    """Return the outcome and its data. The outcome is empty unless the symbol is a spring constant in the stiffness
    matrix, or the mass of a single coordinate. Such a mass must not occur in the stiffness matrix."""
    at = [i for i in range(linear.mass.shape[0]) if letter in linear.mass[i, i].free_symbols]
    if kind == "spring constant" and letter in linear.stiffness.free_symbols:
        return "spring", {"stiffness": linear.stiffness}
    if kind == "mass" and len(at) == 1 and letter not in linear.stiffness.free_symbols:
        return "mass", {"mass": linear.mass, "at": at[0]}
    return "", {}


def _unaffected(of: Quantity, shape: Quantity, letter: Symbol, outcome: str, data: Mapping[str, Any]) -> Quantity:
    return observation(
        UNAFFECTED,
        lambda *_: explicit(of.value),
        {"of": of, "letter": letter},
        routes={"other_value": lambda found: (found.xreplace({letter: 2 * letter}), explicit(of.value))},
        outcome=outcome,
        phrase_data=PhraseData(points_to={"shape": shape}, outcome_data=data),
        key=f"{of.key}_unaffected",
    )


CIRCLING = Rule(
    "observations.circling",
    source="Taylor, *Classical Mechanics*, section 2.7",
    outcomes={"generic": claims.circles},
    evidence={"turned": CHECK},
)


def circling(view: View) -> Observed:
    """Acceleration that is a constant times the velocity turned by a right angle, so the particle moves uniformly on a
    circle.
    """
    moving = {q.symbol: q for q in view.values("acceleration")}
    coordinates = dict.fromkeys(q for each in moving.values() for q in each.coordinates if rate(q, 2) in moving)
    for x, y in combinations(sorted(coordinates, key=str), 2):
        first, second = moving[rate(x, 2)], moving[rate(y, 2)]
        turning = tidied(explicit(second.value) / rate(x))
        constant = not is_zero(turning) and not turning.free_symbols & {x, y, rate(x), rate(y)}
        if constant and is_zero(explicit(first.value) + turning * rate(y)):
            yield _circling(first, second, turning, (rate(x), rate(y)))


def _circling(first: Quantity, second: Quantity, turning: Expr, rates: tuple[Symbol, Symbol]) -> Quantity:
    return observation(
        CIRCLING,
        lambda *_: turning,
        {"of": first, "other": second},
        routes={"turned": lambda found: (-found * rates[1], explicit(first.value))},
        phrase_data=PhraseData(outcome_data={"rates": rates}),
        key=f"{first.key}_circling",
    )


REDUCED = Rule(
    "observations.reduced",
    source="Taylor, *Classical Mechanics*, section 8.3",
    outcomes={"generic": claims.is_reduced_mass},
    evidence={"sum": CHECK},
)


def reduced(view: View) -> Observed:
    """Equations of relative motion that are the equations of one particle with the reduced mass."""
    masses = view.of_kind("mass")
    if len(masses) != 2:
        return
    mass = masses[0] * masses[1] / (masses[0] + masses[1])
    found = []
    for q in (q for q in view.answers if q.step.rule == "lagrange.equation_of_motion"):
        own = [rate(x, 2) for x in q.coordinates if rate(x, 2) in explicit(q.value).free_symbols]
        if len(own) == 1 and is_zero(tidied(explicit(q.value.residual).diff(own[0]) - mass)):
            found.append((q, own[0]))
    if len(found) == 2:
        yield _reduced([q for q, _ in found], mass, masses, [a for _, a in found])


def _reduced(equations: Sequence[Quantity], mass: Expr, masses: Sequence[Symbol], along: Sequence[Symbol]) -> Quantity:
    return observation(
        REDUCED,
        lambda *_: mass,
        {"of": equations[0], "other": equations[1]},
        routes={"sum": lambda found: (1 / found, 1 / masses[0] + 1 / masses[1])},
        phrase_data=PhraseData(outcome_data={"masses": tuple(masses), "accelerations": tuple(along)}),
        key=f"{equations[0].key}_reduced",
    )


POLHODE = Rule(
    "observations.polhode",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.6; Landau, Lifshitz, *Mechanics*, section 37",
    outcomes={"generic": claims.stays_on_both_surfaces},
    evidence={"energy": CHECK},
    named={"ellipsoid": claims.is_the_energy_in_momenta, "sphere": claims.is_the_squared_length},
)


def polhode(view: View) -> Observed:
    """Constant kinetic energy and constant |L|, so the tip of L, seen from the body, stays on an ellipsoid and on a
    sphere."""
    kept = [q for q in view.shown if q.step.rule == "motion.rate_under" and is_zero(q.value)]
    energy = _conserved(kept, "rotation.kinetic_energy")
    square = _conserved([q for q in kept if q in view.answers], "answers.squared_magnitude")
    momentum = next((q for q in view.shown if q.step.rule == "rotation.angular_momentum"), None)
    euler = [q for q in view.shown if q.step.rule == "rotation.euler_equation"]
    if energy is not None and square is not None and momentum is not None and len(euler) == 3:
        yield _polhode(energy, square, momentum, euler)


def _conserved(kept: Sequence[Quantity], rule: str) -> Quantity | None:
    """Return the quantity that this rule derived, if its rate of change was found to vanish; otherwise None."""
    return next((p for q in kept for p in q.ancestors() if p.step.rule == rule), None)


def _polhode(energy: Quantity, square: Quantity, momentum: Quantity, euler: Sequence[Quantity]) -> Quantity:
    names, value = component_names(momentum.symbol.name), explicit(energy.value)
    components = dict(zip(names, list(explicit(momentum.value)), strict=True))
    spins = [next(w for w in momentum.coordinates if w in each.free_symbols) for each in components.values()]
    in_momenta = Terms(
        *(
            name**2 * tidied(value.diff(w, 2)) / (2 * components[name].diff(w) ** 2)
            for name, w in zip(names, spins, strict=True)
        )
    )
    return observation(
        POLHODE,
        lambda *_: in_momenta,
        {},
        routes={"energy": lambda found: (explicit(found).xreplace(components), value)},
        phrase_data=PhraseData(
            points_to={"energy": energy, "square": square, "momentum": momentum},
            named={
                "ellipsoid": Relation(in_momenta, "=", energy.symbol),
                "sphere": Relation(Terms(*(name**2 for name in names)), "=", square.symbol),
            },
            outcome_data={"euler": tuple(euler), "spins": tuple(spins), "names": names},
        ),
        key=f"{square.key}_and_energy",
    )
