"""Observations about symbols: what an answer does not depend on, where it vanishes, and where solutions branch off."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from sympy import Abs, Add, Expr, Integer, MatrixBase, Mul, Symbol, acos, asin, atan, cos, factor_list, pi, sin, tan
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.expressions import Amount, Relation, explicit, rate
from derive.algebra.rounding import rounded_form
from derive.algebra.tidy import tidied
from derive.mechanics.lagrange.facts import Energies, ForceOf
from derive.mechanics.observations import claims
from derive.mechanics.observations.view import OF_ANY_SUBJECT, ONE_LINE, View, simple
from derive.mechanics.rest.facts import RestOf, Shape, StableWhere
from derive.solving.relations import solved_for_letter
from derive.steps.establish import PhraseData, establish
from derive.steps.rule import CHECK, Rule
from derive.steps.signs import sign_for_all
from derive.steps.step import Quantity, is_zero

INVERSE = {cos: acos, sin: asin, tan: atan}
SOLVED = ("answers.roots", "answers.put_in", "answers.solved_for")
FREQUENCIES = ("vibrations.frequency", "vibrations.period")
SIZES = ("mass", "length", "acceleration", "spring constant")  # symbols of a system, not of its motion
DEGREE = pi / 180

INDEPENDENT = Rule(
    "observations.independent",
    source="Morin, *Introduction to Classical Mechanics*, section 1.1",
    outcomes={
        "generic": lambda facts: True,
        "angle": lambda facts: True,
        "weight": claims.only_shifts_the_equilibrium,
    },
    evidence={"other_value": CHECK},
    named={"letter": claims.is_free_of},
)


def independent(view: View) -> Iterator[Quantity]:
    """Given symbols that occur in the equations behind an answer, but not in the answer."""
    scale = _scales(view)
    for of in reversed(view.answers):
        solved = isinstance(of.value, Relation)
        value = of.value.right if solved else of.value
        if not isinstance(value, Expr) or not of.exact or is_zero(value) or not _may_be_free(of, solved):
            continue
        behind = [q for q in of.ancestors() if q.step.key != of.step.key and isinstance(q.value, Expr | Relation)]
        equations = [q for q in behind if isinstance(q.value, Relation) or q in of.parents]
        used = {s for q in equations for s in _symbols_in(q)}
        gone = [s for s in view.letters if s in used - explicit(value).free_symbols - scale - _unknowns(of)]
        if of.step.rule in FREQUENCIES:
            yield from _weight(view, of, gone)
        elif gone and len(gone) <= 3 and (not solved or any(view.letters[s] == "length" for s in gone)):
            yield _free_of(of, value, gone, equations, "angle" if solved else "generic")


def _may_be_free(of: Quantity, solved: bool) -> bool:
    """Whether it is worth saying on which symbols an answer does not depend.

    A special case has no other values of the symbols that were replaced. An answer with a conserved momentum may depend
    on every symbol that is in this momentum.
    """
    if (of.step.rule, of.step.outcome) == ("answers.put_in", "values"):
        return False
    if any(q.step.rule == "hamilton.conserved" and q.symbol in explicit(of.value).free_symbols for q in of.ancestors()):
        return False
    if solved:
        left = of.value.left
        return isinstance(left, cos | sin | tan) and bool(explicit(of.value.right).free_symbols)
    return of.step.rule in FREQUENCIES or of.step.rule in SOLVED and of.step.kind in ("speed", "length", "angular speed")


def _symbols_in(q: Quantity) -> set[Any]:
    """Return the symbols in the value of a step, and those of the values that the step substitutes."""
    substituted = [told for role, told in q.step.roles if role.startswith("value_") and isinstance(told, Relation)]
    return {s for value in (q.value, *substituted) for s in explicit(value).free_symbols}


def _unknowns(of: Quantity) -> set[Any]:
    """Return the symbols that were solved for."""
    told = dict(of.step.roles).get("unknown")
    return set(getattr(told, "free_symbols", ()))


def _scales(view: View) -> set[Symbol]:
    """Return the symbols that are factors of a Lagrangian of the page: no motion depends on them."""
    wholes = [explicit(q.value) for q in view.shown if q.fact(Energies) is not None]
    return {s for s in view.letters for whole in wholes if s in whole.free_symbols and not tidied(whole / s).has(s)}


def _free_of(of: Quantity, value: Expr, gone: list[Symbol], equations: list[Quantity], outcome: str) -> Quantity:
    return establish(
        INDEPENDENT,
        None,
        lambda *_: explicit(value),
        {"of": of},
        routes={"other_value": lambda found: (found.xreplace({s: 2 * s for s in gone}), value)},
        outcome=outcome,
        lines=ONE_LINE,
        phrase_data=PhraseData(
            named={f"letter_{i}": s for i, s in enumerate(gone, 1)},
            points_to={f"equation_{i}": q for i, q in enumerate(equations)},
            words={"seen": "equation" if outcome == "angle" and of.value.operator == "=" else "condition"},
        ),
        scope=OF_ANY_SUBJECT,
        key=f"{of.key}_independent",
    )


def _weight(view: View, of: Quantity, gone: list[Symbol]) -> Iterator[Quantity]:
    for g in view.of_kind("acceleration"):
        rest = next((q for q in view.shown if q.fact(RestOf) is not None and isinstance(q.value, Expr)), None)
        if g in gone and rest is not None and g in explicit(rest.value).free_symbols:
            equations = [q for q in of.ancestors() if isinstance(q.value, Relation)]
            yield establish(
                INDEPENDENT,
                None,
                lambda *_: explicit(of.value),
                {"of": of, "g": g},
                routes={"other_value": lambda found, g=g: (found.xreplace({g: 2 * g}), explicit(of.value))},
                outcome="weight",
                lines=ONE_LINE,
                phrase_data=PhraseData(
                    named={"letter_1": g},
                    points_to={"rest": rest, **{f"equation_{i}": q for i, q in enumerate(equations)}},
                ),
                scope=OF_ANY_SUBJECT,
                key=f"{of.key}_independent",
            )


ANGLE = Rule(
    "observations.angle",
    source="none needed: arithmetic",
    outcomes={"generic": lambda facts: True, "whatever": lambda facts: True},
    evidence={"put_back": CHECK},
    named={"angle": claims.is_pure_angle, "size": claims.is_rounded, "letter": claims.is_free_of},
)


def angle(view: View) -> Iterator[Quantity]:
    """An angle that is a pure number, in degrees, and the symbols on which it does not depend."""
    for of in view.answers:
        told = of.value if isinstance(of.value, Relation) else Relation(of.symbol, "=", of.value)
        if told.operator != "=" or type(told.left) not in INVERSE or not isinstance(told.right, Expr):
            continue
        (q,) = told.left.free_symbols or (None,)
        if told.left.args[0] != q or explicit(told.right).free_symbols:
            continue
        size = INVERSE[type(told.left)](explicit(told.right))
        equations = [each for each in of.ancestors() if isinstance(each.value, Relation) and each.key != of.key]
        equations += [each for each in of.parents if each not in equations]
        used = {s for each in equations for s in explicit(each.value).free_symbols}
        gone = [s for s in view.letters if s in used and view.letters[s] in SIZES][:4]
        named = {"angle": size, "size": _in_degrees(size)}
        yield establish(
            ANGLE,
            None,
            lambda *_, size=size: size,
            {"of": of},
            routes={"put_back": lambda found, told=told, q=q: (told.left.xreplace({q: found}), told.right)},
            outcome="whatever" if gone else "generic",
            lines=ONE_LINE,
            phrase_data=PhraseData(
                named={**named, **{f"letter_{i}": s for i, s in enumerate(gone, 1)}},
                points_to={f"equation_{i}": each for i, each in enumerate(equations)},
                outcome_data={"q": q},
            ),
            scope=OF_ANY_SUBJECT,
            key=f"{of.key}_in_degrees",
        )


def _in_degrees(size: Expr) -> Amount:
    """Return an angle in degrees, to one decimal."""
    degrees = size / DEGREE
    return Amount(rounded_form(degrees, 4 if abs(degrees) >= 100 else 3), "degree", DEGREE)


ZERO_OF = Rule(
    "observations.zero_of",
    source="Morin, *Introduction to Classical Mechanics*, section 1.1",
    outcomes={
        "changes": claims.vanishes_there(True),
        "touches": claims.vanishes_there(False),
        "changes_at_angle": claims.vanishes_there(True),
        "touches_at_angle": claims.vanishes_there(False),
    },
    evidence={"put_in": CHECK},
    named={"size": claims.is_rounded, "place": lambda facts, told: True},
)


def zero_of(view: View) -> Iterator[Quantity]:
    """Value of a symbol or an angle for which an acceleration, a force or a torque vanishes."""
    for of in view.values("acceleration", "force", "torque"):
        if not of.exact or of.step.rule in ("answers.limiting_case",):
            continue
        for base, power in _factors(explicit(of.value)):
            place = _zero_in(view, of, base)
            if place is not None and not _is_told(view, of, place):
                yield _zero(of, place, "changes" if power % 2 else "touches")


def _factors(value: Expr) -> list[tuple[Expr, int]]:
    """Return the sums that are factors of a value, with their powers; the value vanishes where one of them vanishes."""
    above = tidied(value).as_numer_denom()[0]
    found = []
    for factor in Mul.make_args(above):
        base, power = factor.as_base_exp()
        inner, times = (base.args[0], Integer(2)) if isinstance(base, Abs) else (base, power)
        if not times.is_Integer:
            continue
        try:
            found += [(each, int(times) * n) for each, n in factor_list(inner)[1] if each.is_Add]
        except PolynomialError:
            continue
    return found


def _zero_in(view: View, of: Quantity, base: Expr) -> Relation | None:
    """Return the value of a mass, a length or an angle for which a factor vanishes."""
    for letter in sorted(base.free_symbols, key=str):
        if view.letters.get(letter) in ("mass", "length"):
            found = solved_for_letter(base, letter)
            if found is not None and simple(found, 4) and sign_for_all(found) == 1:
                return Relation(letter, "=", found)
    for angle_of in base.atoms(cos):
        rest = tidied(base.subs(angle_of, Symbol("c")))
        found = solved_for_letter(rest, Symbol("c"))
        if found is not None and found.is_number and abs(found) < 1 and isinstance(angle_of.args[0], Symbol):
            return Relation(angle_of.args[0], "=", acos(found))
    return None


def _is_told(view: View, of: Quantity, place: Relation) -> bool:
    """Whether the page states this value already."""
    solved = [q.value for q in view.page if isinstance(q.value, Relation) and isinstance(q.value.left, Symbol | cos)]
    solved += [Relation(q.symbol, "=", q.value) for q in view.page if isinstance(q.symbol, cos)]
    there = {place.left: place.right}
    return any(is_zero(explicit(told.residual).xreplace(there)) for told in solved)


def _zero(of: Quantity, place: Relation, outcome: str) -> Quantity:
    named: dict[str, Any] = {"place": place}
    data = {}
    if explicit(place.right).is_number and place.right.has(acos):
        outcome += "_at_angle"
        named["size"] = _in_degrees(place.right)
        data["angle"] = place.right
    return establish(
        ZERO_OF,
        None,
        lambda *_: place,
        {"of": of},
        routes={"put_in": lambda found: (explicit(of.value).xreplace({found.left: explicit(found.right)}), Integer(0))},
        outcome=outcome,
        lines=ONE_LINE,
        phrase_data=PhraseData(named=named, outcome_data=data),
        scope=OF_ANY_SUBJECT,
        key=f"{of.key}_zero",
    )


BRANCHES = Rule(
    "observations.branches",
    source="Taylor, *Classical Mechanics*, section 7.6; Strogatz, *Nonlinear Dynamics and Chaos*, section 3.5",
    outcomes={"generic": claims.branches_off},
    evidence={"both_vanish": CHECK},
    named={"border": lambda facts, told: True},
)


def branches(view: View) -> Iterator[Quantity]:
    """Value of a symbol for which an equilibrium loses its stability and two others branch off."""
    stable = {q.needed(Shape).place: q for q in view.answers if q.fact(StableWhere) is not None}
    rests = [q for q in view.shown if q.fact(RestOf) is not None and isinstance(explicit(q.value), Expr)]
    pairs = [q for q in rests if isinstance(explicit(q.value), acos)]
    for place, of in stable.items():
        here = next((q for q in rests if is_zero(q.value - place)), None)
        for branch in pairs if here is not None and is_zero(place) else ():
            other = next((q for q in rests if is_zero(q.value + branch.value)), None)
            border = _border(view, of, explicit(branch.value).args[0])
            shapes = [q for q in view.shown if q.fact(Shape) is not None]
            beside = next((q for q in shapes if is_zero(q.needed(Shape).place - branch.value)), None)
            if other is not None and border is not None and beside is not None:
                yield _branching(of, here, branch, other, border, beside)


def _border(view: View, of: Quantity, cosine: Expr) -> Relation | None:
    """Return the value of an angular velocity for which both the curvature and 1 - cos(theta) vanish."""
    for letter in view.of_kind("angular speed"):
        found = solved_for_letter(cosine - 1, letter)
        if found is not None and is_zero(tidied(explicit(of.value).xreplace({letter: found}))):
            return Relation(letter, "=", found)
    return None


def _branching(
    of: Quantity, here: Quantity, branch: Quantity, other: Quantity, border: Relation, beside: Quantity
) -> Quantity:
    curvature, cosine = explicit(of.value), explicit(branch.value).args[0]
    return establish(
        BRANCHES,
        None,
        lambda *_: border,
        {"of": of},
        routes={
            "both_vanish": lambda found: (
                (curvature * (1 - cosine) + curvature + 1 - cosine).xreplace({found.left: explicit(found.right)}),
                Integer(0),
            )
        },
        lines=ONE_LINE,
        phrase_data=PhraseData(
            named={"border": border},
            points_to={"here": here, "branch": branch, "other": other},
            outcome_data={"curvature": curvature, "cosine": cosine, "beside": explicit(beside.value)},
        ),
        scope=OF_ANY_SUBJECT,
        key=f"{of.key}_branches",
    )


RESONANCE = Rule(
    "observations.resonance",
    source="Taylor, *Classical Mechanics*, sections 5.5 and 5.6",
    outcomes={"generic": claims.grows_without_bound_there},
    evidence={"denominator": CHECK},
    named={"place": lambda facts, told: True},
)


def resonance(view: View) -> Iterator[Quantity]:
    """Driving frequency at which the amplitude without damping grows without bound: that of the free oscillation."""
    for of in view.answers:
        if of.step.rule != "vibrations.steady_amplitude" or of.step.outcome != "undamped":
            continue
        below = tidied(of.value).as_numer_denom()[1]
        inner = next((each.args[0] for each in below.atoms(Abs)), below)
        for letter in sorted(inner.free_symbols & set(view.of_kind("angular speed")), key=str):
            found = solved_for_letter(inner, letter)
            square = _free_frequency(of)
            if found is not None and square is not None:
                place = Relation(letter, "=", found)
                yield establish(
                    RESONANCE,
                    None,
                    lambda *_, place=place: place,
                    {"of": of},
                    routes={"denominator": lambda p, inner=inner: (inner.xreplace({p.left: p.right}), Integer(0))},
                    lines=ONE_LINE,
                    phrase_data=PhraseData(named={"place": place}, outcome_data={"square": square}),
                    scope=OF_ANY_SUBJECT,
                    key=f"{of.key}_resonance",
                )


def _free_frequency(of: Quantity) -> Expr | None:
    """Return the squared frequency of the free oscillation, from the coefficients of the equation of motion."""
    for each in of.ancestors():
        moving = list(each.coordinates)
        if isinstance(each.value, Relation) and len(moving) == 1:
            left = explicit(each.value.residual)
            inertia, stiffness = left.diff(rate(moving[0], 2)), left.diff(moving[0])
            if inertia != 0 and not stiffness.has(moving[0]):
                return tidied(stiffness / inertia)
    return None


ANYWHERE = Rule(
    "observations.anywhere",
    source="Morin, *Introduction to Classical Mechanics*, section 6.2",
    outcomes={"generic": claims.holds_everywhere},
    evidence={"put_in": CHECK},
    named={"place": lambda facts, told: True},
)


def anywhere(view: View) -> Iterator[Quantity]:
    """Value of an angular velocity for which every position is an equilibrium."""
    for of in view.shown:
        if of.step.rule != "rest.condition" or not any(of in q.ancestors() for q in view.answers):
            continue
        for letter in view.of_kind("angular speed"):
            residual = explicit(of.value.residual)
            for base, _ in _factors(residual) if letter in residual.free_symbols else ():
                found = solved_for_letter(base, letter)
                if found is not None and not found.free_symbols & set(of.coordinates):
                    yield _anywhere(of, Relation(letter, "=", found))


def _anywhere(of: Quantity, place: Relation) -> Quantity:
    residual = explicit(of.value.residual)
    return establish(
        ANYWHERE,
        None,
        lambda *_: place,
        {"of": of},
        routes={"put_in": lambda found: (residual.xreplace({found.left: explicit(found.right)}), Integer(0))},
        lines=ONE_LINE,
        phrase_data=PhraseData(named={"place": place}),
        scope=OF_ANY_SUBJECT,
        key=f"{of.key}_anywhere",
    )


ONE_SIGN = Rule(
    "observations.one_sign",
    source="none needed: signs of factors",
    outcomes={"generic": claims.has_one_sign},
    evidence={"factors": CHECK},
)


def one_sign(view: View) -> Iterator[Quantity]:
    """Force of a contact whose sign does not depend on the position, although its size does."""
    for of in view.values("force"):
        value = tidied(of.value)
        moving = [q for q in of.coordinates if q in value.free_symbols]
        if len(moving) != 1 or sign_for_all(value) is not None or not _is_force_of_contact(of):
            continue
        inner = [f for f in Mul.make_args(value) if moving[0] in f.free_symbols]
        if all(sign_for_all(f) == 1 for f in inner):
            rest = value / Mul(*inner)
            yield establish(
                ONE_SIGN,
                None,
                lambda *_, rest=rest: rest,
                {"of": of, "q": moving[0]},
                routes={"factors": lambda found, value=value, inner=inner: (found * Mul(*inner), value)},
                lines=ONE_LINE,
                scope=OF_ANY_SUBJECT,
                key=f"{of.key}_one_sign",
            )


def _is_force_of_contact(of: Quantity) -> bool:
    """Whether the answer is a normal force, or such a force with other results substituted."""
    facts = [q.fact(ForceOf) for q in of.ancestors() if q.symbol == of.symbol]
    return any(fact is not None and fact.constraint.enforcer == "surface" for fact in facts)


BALANCED = Rule(
    "observations.balanced",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, chapter 8",
    outcomes={"one": claims.balances, "two": claims.balances},
    evidence={"put_in": CHECK},
    named={"place": lambda facts, told: True},
)


def balanced(view: View) -> Iterator[Quantity]:
    """Angles for which no torque of the bearings is needed."""
    for of in view.answers:
        entries = [each for each in explicit(of.value) if each != 0] if isinstance(of.value, MatrixBase) else []
        if of.step.kind != "torque" or len(entries) != 1:
            continue
        for letter in [s for s in view.of_kind("angle") if s in entries[0].free_symbols]:
            ends = (Integer(0), pi / 2)
            found = [end for end in ends if is_zero(entries[0].xreplace({letter: end}))]
            if found:
                yield _balanced(of, letter, found)


def _balanced(of: Quantity, letter: Symbol, found: list[Expr]) -> Quantity:
    entry = next(each for each in explicit(of.value) if each != 0)
    places = {f"place_{i}": Relation(letter, "=", each) for i, each in enumerate(found, 1)}
    return establish(
        BALANCED,
        None,
        lambda *_: entry,
        {"of": of, "angle": letter},
        routes={"put_in": lambda e: (Add(*(e.xreplace({letter: each}) ** 2 for each in found)), Integer(0))},
        outcome="two" if len(found) == 2 else "one",
        lines=ONE_LINE,
        phrase_data=PhraseData(named=places),
        scope=OF_ANY_SUBJECT,
        key=f"{of.key}_balanced",
    )
