"""Observations that compare answers with each other or with a familiar motion."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import Any

from sympy import Add, Expr, Symbol, sin

from derive.algebra.expressions import Ratio, Relation, component_names, explicit, rate
from derive.algebra.tidy import tidied
from derive.mechanics.observations import claims
from derive.mechanics.observations.view import OF_ANY_SUBJECT, ONE_LINE, View
from derive.mechanics.vibrations.facts import Linear, Mode
from derive.steps.establish import PhraseData, establish
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


def multiple(view: View) -> Iterator[Quantity]:
    """Two velocities of one part whose ratio is a number other than 1 and -1."""
    found = [q for q in view.values() if _is_rate(q) and not is_zero(q.value)]
    for one, other in combinations(found, 2):
        ratio = tidied(explicit(one.value) / explicit(other.value))
        of, to = (one, other) if ratio.is_number and abs(ratio) > 1 else (other, one)
        ratio = tidied(explicit(of.value) / explicit(to.value))
        both = [s for s in view.letters if s in explicit(of.value).free_symbols & explicit(to.value).free_symbols]
        if ratio.is_Rational and abs(ratio) > 1 and one.symbol != other.symbol and 0 < len(both) < 5:
            yield establish(
                MULTIPLE,
                None,
                lambda *_, ratio=ratio: ratio,
                {"of": of, "other": to},
                routes={"product": lambda r, of=of, to=to: (r * explicit(to.value), explicit(of.value))},
                lines=ONE_LINE,
                phrase_data=PhraseData(
                    named={
                        "ratio": Relation(Ratio(of.symbol, to.symbol), "=", ratio),
                        **{f"letter_{i}": s for i, s in enumerate(both, 1)},
                    }
                ),
                scope=OF_ANY_SUBJECT,
                key=f"{of.key}_multiple",
            )


def _is_rate(q: Quantity) -> bool:
    parents = any(parent.step.kind in RATES for parent in q.parents)
    is_value = q.step.kind in RATES or q.step.rule == "answers.combination" and parents
    return is_value and q.fact(Mode) is None and not q.step.rule.startswith("vibrations.")


ORDER = Rule(
    "observations.order",
    source="none needed: comparison of numbers",
    outcomes={"race": claims.first_to_arrive, "generic": claims.are_in_order},
    evidence={"product": CHECK},
    named={"most": claims.is_case_of("case_0"), "least": claims.is_case_of_the_last},
)


def order(view: View) -> Iterator[Quantity]:
    """Answers for several special cases in the order of their size, if the ratios are numbers."""
    cases = [q for q in view.values() if q.step.rule == PUT_IN and q.step.outcome == "values"]
    for symbol in {q.symbol for q in cases}:
        own = [q for q in cases if q.symbol == symbol]
        ratios = [tidied(explicit(q.value) / explicit(own[0].value)) for q in own if not is_zero(own[0].value)]
        if len(own) < 2 or not all(r.is_Rational and r > 0 for r in ratios) or len(set(ratios)) < len(own):
            continue
        together = all(_is_constant(q) for q in own) and own[0].step.kind == "acceleration"
        falling = [q for _, q in sorted(zip(ratios, own, strict=True), key=lambda pair: -pair[0])]
        ratio = tidied(explicit(falling[0].value) / explicit(falling[-1].value))
        yield establish(
            ORDER,
            None,
            lambda *_, ratio=ratio: ratio,
            {},
            routes={"product": lambda r, q=falling: (r * explicit(q[-1].value), explicit(q[0].value))},
            outcome="race" if together else "generic",
            lines=ONE_LINE,
            phrase_data=PhraseData(
                points_to={f"case_{i}": q for i, q in enumerate(falling)},
                named={"most": _case(falling[0]), "least": _case(falling[-1])},
            ),
            scope=OF_ANY_SUBJECT,
            key=f"{falling[0].key}_greatest",
        )


def _is_constant(q: Quantity) -> bool:
    return not explicit(q.value).free_symbols & {s for each in q.coordinates for s in (each, rate(each))}


def _case(q: Quantity) -> Any:
    return next(told for role, told in q.step.roles if role.startswith("value_"))


FAMILIAR = Rule(
    "observations.familiar",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, chapter 7",
    outcomes={"fall": claims.free_fall, "incline": claims.slides_freely},
    evidence={"product": CHECK},
    named={"letter": claims.is_free_of},
)


def familiar(view: View) -> Iterator[Quantity]:
    """Acceleration that is a fixed fraction of that of free fall, or of a block on an incline without friction."""
    for of in view.values("acceleration"):
        value = explicit(of.value)
        for g in view.of_kind("acceleration"):
            angles = [s for s in value.free_symbols if view.letters.get(s) == "angle"]
            known = g * sin(angles[0]) if angles else g
            part = abs(tidied(value / known))
            if part.is_Rational and 0 < part < 1 and of.step.rule == "lagrange.acceleration":
                yield _familiar(view, of, part, known, g, angles)


def _familiar(view: View, of: Quantity, part: Expr, known: Expr, g: Symbol, angles: list[Symbol]) -> Quantity:
    equations = [q for q in of.ancestors() if isinstance(q.value, Relation)]
    used = {s for q in equations for s in explicit(q.value).free_symbols}
    gone = [s for s in view.letters if s in used - explicit(of.value).free_symbols and view.letters[s] in ("mass", "length")]
    return establish(
        FAMILIAR,
        None,
        lambda *_: part,
        {"of": of, "g": g, **({"alpha": angles[0]} if angles else {})},
        routes={"product": lambda found: ((found * known) ** 2, explicit(of.value) ** 2)},
        outcome="incline" if angles else "fall",
        lines=ONE_LINE,
        phrase_data=PhraseData(
            named={f"letter_{i}": s for i, s in enumerate(gone, 1)},
            points_to={f"equation_{i}": q for i, q in enumerate(equations)},
            outcome_data={"familiar": known},
        ),
        scope=OF_ANY_SUBJECT,
        key=f"{of.key}_familiar",
    )


UNAFFECTED = Rule(
    "observations.unaffected",
    source="Taylor, *Classical Mechanics*, sections 11.2 and 11.4",
    outcomes={"spring": claims.keeps_the_spring, "mass": claims.stays_at_rest},
    evidence={"other_value": CHECK},
)


def unaffected(view: View) -> Iterator[Quantity]:
    """Mode whose frequency does not depend on a spring constant or a mass, and the reason in its shape."""
    shapes = [q for q in view.answers if q.step.rule == "vibrations.mode_shape"]
    frequencies = [q for q in view.answers if q.fact(Mode) is not None]
    others = {s for q in frequencies for s in explicit(q.value).free_symbols}
    for of, shape in zip(frequencies, shapes, strict=False):
        if is_zero(of.value):
            continue
        linear = next((q.fact(Linear) for q in of.ancestors() if q.fact(Linear) is not None), None)
        for letter in sorted(others - explicit(of.value).free_symbols, key=str) if linear is not None else ():
            kind = view.letters.get(letter)
            if kind == "spring constant" and letter in linear.stiffness.free_symbols:
                yield _unaffected(of, shape, letter, "spring", {"stiffness": linear.stiffness})
            at = [i for i in range(linear.mass.shape[0]) if letter in linear.mass[i, i].free_symbols]
            if kind == "mass" and len(at) == 1 and letter not in linear.stiffness.free_symbols:
                data = {"mass": linear.mass, "at": at[0]}
                yield _unaffected(of, shape, letter, "mass", data)


def _unaffected(of: Quantity, shape: Quantity, letter: Symbol, outcome: str, data: dict[str, Any]) -> Quantity:
    return establish(
        UNAFFECTED,
        None,
        lambda *_: explicit(of.value),
        {"of": of, "letter": letter},
        routes={"other_value": lambda found: (found.xreplace({letter: 2 * letter}), explicit(of.value))},
        outcome=outcome,
        lines=ONE_LINE,
        phrase_data=PhraseData(points_to={"shape": shape}, outcome_data=data),
        scope=OF_ANY_SUBJECT,
        key=f"{of.key}_unaffected",
    )


CIRCLING = Rule(
    "observations.circling",
    source="Taylor, *Classical Mechanics*, section 2.7",
    outcomes={"generic": claims.circles},
    evidence={"turned": CHECK},
)


def circling(view: View) -> Iterator[Quantity]:
    """Accelerations that are the velocity turned by a right angle: the motion is uniform in a circle."""
    moving = {q.symbol: q for q in view.values("acceleration") if isinstance(q.symbol, Symbol)}
    names = [s.name.removesuffix("_ddot") for s in moving if s.name.endswith("_ddot")]
    for one, other in combinations(names, 2):
        u, v = (rate(Symbol(name, real=True)) for name in (one, other))
        first, second = (moving[rate(Symbol(name, real=True), 2)] for name in (one, other))
        turning = tidied(explicit(second.value) / u)
        if turning.free_symbols & {u, v} or is_zero(turning) or not is_zero(explicit(first.value) + turning * v):
            continue
        yield establish(
            CIRCLING,
            None,
            lambda *_, turning=turning: turning,
            {"of": first, "other": second},
            routes={"turned": lambda w, first=first, v=v: (-w * v, explicit(first.value))},
            lines=ONE_LINE,
            phrase_data=PhraseData(outcome_data={"rates": (u, v)}),
            scope=OF_ANY_SUBJECT,
            key=f"{first.key}_circling",
        )


REDUCED = Rule(
    "observations.reduced",
    source="Taylor, *Classical Mechanics*, section 8.3",
    outcomes={"generic": claims.is_reduced_mass},
    evidence={"sum": CHECK},
)


def reduced(view: View) -> Iterator[Quantity]:
    """Equations of relative motion that are those of one particle with the reduced mass."""
    masses = view.of_kind("mass")
    equations = [q for q in view.answers if q.step.rule == "lagrange.equation_of_motion"]
    if len(masses) != 2:
        return
    mass = masses[0] * masses[1] / (masses[0] + masses[1])
    found = []
    for q in equations:
        residual = explicit(q.value.residual)
        own = [s for s in residual.free_symbols if s.name.endswith("_ddot")]
        if len(own) == 1 and is_zero(tidied(residual.diff(own[0]) - mass)):
            found.append((q, own[0]))
    if len(found) == 2:
        (one, a), (other, b) = found
        yield establish(
            REDUCED,
            None,
            lambda *_: mass,
            {"of": one, "other": other},
            routes={"sum": lambda m: (1 / m, 1 / masses[0] + 1 / masses[1])},
            lines=ONE_LINE,
            phrase_data=PhraseData(outcome_data={"masses": tuple(masses), "accelerations": (a, b)}),
            scope=OF_ANY_SUBJECT,
            key=f"{one.key}_reduced",
        )


POLHODE = Rule(
    "observations.polhode",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.6; Landau, Lifshitz, *Mechanics*, section 37",
    outcomes={"generic": claims.stays_on_both_surfaces},
    evidence={"energy": CHECK},
    named={"ellipsoid": claims.is_the_energy_in_momenta, "sphere": claims.is_the_squared_length},
)


def polhode(view: View) -> Iterator[Quantity]:
    """Constant kinetic energy and constant |L|: in the body, the tip of L stays on an ellipsoid and on a sphere."""
    kept = [q for q in view.shown if q.step.rule == "motion.rate_under" and is_zero(q.value)]
    energy = _conserved(kept, "rotation.kinetic_energy")
    square = _conserved([q for q in kept if q in view.answers], "answers.squared_magnitude")
    momentum = next((q for q in view.shown if q.step.rule == "rotation.angular_momentum"), None)
    if energy is None or square is None or momentum is None:
        return
    names = component_names(momentum.symbol.name)
    spins = {rate_of for rate_of in explicit(energy.value).free_symbols if energy.coordinates.get(rate_of)}
    euler = [q for q in view.shown if q.step.rule == "rotation.euler_equation"]
    pairs = list(zip(names, list(explicit(momentum.value)), strict=True))
    spins_in_order = [next(iter(value.free_symbols & spins), None) for _, value in pairs]
    if len(euler) < 3 or None in spins_in_order:
        return
    in_momenta = Add(
        *(name**2 * tidied(energy.value.diff(w, 2)) / (2 * value.diff(w) ** 2) for (name, value), w in zip(pairs, spins_in_order, strict=True))
    )
    yield establish(
        POLHODE,
        None,
        lambda *_: in_momenta,
        {},
        routes={"energy": lambda found: (found.xreplace(dict(pairs)), explicit(energy.value))},
        lines=ONE_LINE,
        phrase_data=PhraseData(
            points_to={"energy": energy, "square": square, "momentum": momentum},
            named={
                "ellipsoid": Relation(in_momenta, "=", energy.symbol),
                "sphere": Relation(Add(*(name**2 for name in names)), "=", square.symbol),
            },
            outcome_data={"euler": tuple(euler), "spins": tuple(spins_in_order), "names": names},
        ),
        scope=OF_ANY_SUBJECT,
        key=f"{square.key}_and_energy",
    )


def _conserved(kept: list[Quantity], rule: str) -> Quantity | None:
    """Return the quantity of this rule whose rate of change was found to vanish."""
    return next((p for q in kept for p in q.ancestors() if p.step.rule == rule), None)
