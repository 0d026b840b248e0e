"""Observations about symbols, for example that an answer does not depend on a symbol or vanishes for some value."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from sympy import (
    Abs,
    Add,
    Expr,
    Integer,
    MatrixBase,
    Mul,
    Symbol,
    acos,
    asin,
    atan,
    cos,
    diff,
    expand_trig,
    factor_list,
    pi,
    sin,
    tan,
)
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.expressions import Amount, Relation, explicit, rate
from derive.algebra.ranges import range_of
from derive.algebra.rounding import rounded_form
from derive.algebra.tidy import tidied
from derive.mechanics.lagrange.facts import Energies, ForceOf
from derive.mechanics.observations import claims
from derive.mechanics.observations.view import (
    Observed,
    View,
    numbered,
    observation,
    simple,
    symbols_behind,
)
from derive.mechanics.rest.facts import RestOf, Shape, StableWhere
from derive.solving.relations import solved_for_letter
from derive.steps.establish import PhraseData
from derive.steps.record import defined_quantities
from derive.steps.rule import CHECK, TRIALS, Rule
from derive.steps.signs import sign_for_all
from derive.steps.step import Quantity, is_zero

INVERSE = {cos: acos, sin: asin, tan: atan}
SOLVED = ("answers.roots", "answers.put_in", "answers.solved_for")
FREQUENCIES = ("vibrations.frequency", "vibrations.period")
SIZES = ("mass", "length", "acceleration", "spring constant")  # kinds of symbols that describe a system, not its motion
CHOSEN = ("angle", "time", "speed", "angular speed")  # kinds of symbols that describe a motion
DEGREE = pi / 180

INDEPENDENT = Rule(
    "observations.independent",
    source="Morin, *Introduction to Classical Mechanics*, section 1.1",
    outcomes={
        "generic": claims.names_a_letter,
        "angle": claims.names_a_letter,
        "weight": claims.only_shifts_the_equilibrium,
    },
    evidence={"other_value": CHECK},
    named={"letter": claims.is_free_of},
)


def independent(view: View) -> Observed:
    """Observations that an answer does not contain a given symbol, although the answer was derived from equations that
    contain this symbol."""
    for of in reversed(view.answers):
        solved = isinstance(of.value, Relation)
        value = of.value.right if solved else of.value
        if not isinstance(value, Expr) or not of.exact or is_zero(value) or not _may_be_free(view, of):
            continue
        behind = [q for q in of.ancestors() if q.key != of.key and (isinstance(q.value, Relation) or q in of.parents)]
        others = symbols_behind(behind) - explicit(value).free_symbols - _unknowns(of)
        gone = [s for s in view.in_order(others if solved else others - _scales(view)) if view.letters[s] not in CHOSEN]
        if of.step.rule in FREQUENCIES:
            yield from _weight(view, of, gone, behind)
        elif 0 < len(gone) < 4 and (not solved or any(view.letters[s] == "length" for s in gone)):
            yield _free_of(of, value, gone, behind)


def _may_be_free(view: View, of: Quantity) -> bool:
    """Whether it is worth saying on which symbols an answer does not depend.

    An answer for a special case is left out, because it holds only for the substituted values.
    """
    kept = {*view.of_kind("angular momentum")} & explicit(of.value).free_symbols
    if (of.step.rule, of.step.outcome) == ("answers.put_in", "values") or kept:
        return False
    if isinstance(of.value, Relation):
        return isinstance(of.value.left, cos | sin | tan) and bool(explicit(of.value.right).free_symbols)
    kinds = {of.step.kind, *(view.letters.get(letter) for letter in _unknowns(of))}
    return of.step.rule in FREQUENCIES or of.step.rule in SOLVED and bool(kinds & {"speed", "length", "angular speed"})


def _unknowns(of: Quantity) -> set[Any]:
    return set(getattr(dict(of.step.roles).get("unknown"), "free_symbols", ()))


def _scales(view: View) -> set[Symbol]:
    wholes = [explicit(q.value) for q in view.shown if q.fact(Energies) is not None]
    return {s for s in view.letters for whole in wholes if s in whole.free_symbols and not tidied(whole / s).has(s)}


def _free_of(of: Quantity, value: Expr, gone: Sequence[Symbol], behind: Sequence[Quantity]) -> Quantity:
    solved = isinstance(of.value, Relation)
    return observation(
        INDEPENDENT,
        lambda *_: explicit(value),
        {"of": of},
        routes={"other_value": lambda found: (found.xreplace({s: 2 * s for s in gone}), explicit(value))},
        outcome="angle" if solved else "generic",
        phrase_data=PhraseData(
            named=numbered("letter", gone),
            points_to=numbered("equation", behind),
            words={"seen": "equation" if solved and of.value.operator == "=" else "condition"},
        ),
        key=f"{of.key}_independent",
    )


def _weight(view: View, of: Quantity, gone: Sequence[Symbol], behind: Sequence[Quantity]) -> Iterator[Quantity]:
    """Yield the statement that gravity shifts the equilibrium and does not change the frequency."""
    rests = [q for q in view.shown if q.fact(RestOf) is not None and isinstance(q.value, Expr)]
    for g in (g for g in view.gravity if g in gone and rests and g in explicit(rests[0].value).free_symbols):
        equations = [q for q in behind if q is not rests[0] and isinstance(q.value, Relation)]
        yield _only_shifted(of, g, rests[0], equations)


def _only_shifted(of: Quantity, g: Symbol, rest: Quantity, equations: Sequence[Quantity]) -> Quantity:
    return observation(
        INDEPENDENT,
        lambda *_: explicit(of.value),
        {"of": of, "g": g},
        routes={"other_value": lambda found: (found.xreplace({g: 2 * g}), explicit(of.value))},
        outcome="weight",
        phrase_data=PhraseData(named={"letter_1": g}, points_to={"rest": rest, **numbered("equation", equations)}),
        key=f"{of.key}_independent",
    )


ANGLE = Rule(
    "observations.angle",
    source="none needed: arithmetic",
    outcomes={"generic": claims.names_a_letter},
    evidence={"put_back": CHECK},
    named={"angle": claims.is_pure_angle, "size": claims.is_rounded, "letter": claims.is_free_of},
)


def angle(view: View) -> Observed:
    """An angle with a fixed value, in degrees, and the masses, lengths and other symbols of the system on which the
    angle does not depend."""
    for of in view.answers:
        told = of.value if isinstance(of.value, Relation) else Relation(of.symbol, "=", of.value)
        is_number = isinstance(told.right, Expr) and not explicit(told.right).free_symbols
        if told.operator != "=" or type(told.left) not in INVERSE or not is_number:
            continue
        if isinstance(told.left.args[0], Symbol):
            size = INVERSE[type(told.left)](explicit(told.right))
            if not any(q.step.kind == "angle" and is_zero(q.value - size) for q in view.page):
                yield from _angle(view, of, told, size)


def _angle(view: View, of: Quantity, told: Relation, size: Expr) -> Observed:
    behind = [each for each in of.ancestors() if each.key != of.key and isinstance(each.value, Relation)]
    behind += [each for each in of.parents if each not in behind]
    gone = [s for s in view.in_order(symbols_behind(behind)) if view.letters[s] in SIZES][:4]
    if gone:
        yield _angle_for_all(of, told, size, gone, behind)


def _angle_for_all(
    of: Quantity, told: Relation, size: Expr, gone: Sequence[Symbol], behind: Sequence[Quantity]
) -> Quantity:
    q = told.left.args[0]
    return observation(
        ANGLE,
        lambda *_: size,
        {"of": of},
        routes={"put_back": lambda found: (told.left.xreplace({q: found}), told.right)},
        phrase_data=PhraseData(
            named={"angle": size, "size": _in_degrees(size), **numbered("letter", gone)},
            points_to=numbered("equation", behind),
        ),
        key=f"{of.key}_in_degrees",
    )


def _in_degrees(size: Expr) -> Amount:
    """Return an angle in degrees, rounded to three figures; from 100 degrees on, to four figures."""
    degrees = size / DEGREE
    return Amount(rounded_form(degrees, 4 if abs(degrees) >= 100 else 3), "degree", DEGREE)


ZERO_OF = Rule(
    "observations.zero_of",
    source="Morin, *Introduction to Classical Mechanics*, section 1.1",
    outcomes={
        "changes": claims.vanishes_there(True),
        "equal_masses": claims.vanishes_for_equal_symbols,
        "touches": claims.vanishes_there(False),
        "changes_at_angle": claims.vanishes_there(True),
        "touches_at_angle": claims.vanishes_there(False),
    },
    evidence={"put_in": CHECK},
    named={"place": claims.is_the_result, "size": claims.is_rounded, "letter": claims.is_in_the_result},
)


def zero_of(view: View) -> Observed:
    """Value of a symbol or an angle for which an acceleration, a force or a torque vanishes.

    The force of a surface or a string is left out, because it cannot change its sign: contact is lost, or the string
    goes slack.
    """
    for of in (
        each for each in view.values("acceleration", "force", "torque") if not _is_force_of(each, "surface", "string")
    ):
        for base, power in _factors(explicit(of.value)):
            place = _zero_in(view, base)
            if place is not None and not _is_told(view, place):
                yield _zero(of, place, _change(view, place) if power % 2 else "touches")


def _change(view: View, place: Relation) -> str:
    are_masses = all(view.letters.get(side) == "mass" for side in (place.left, place.right))
    return "equal_masses" if are_masses else "changes"


def _factors(value: Expr) -> list[tuple[Expr, int]]:
    """Return the sums that are factors of a value, with their powers; the value vanishes where one of them vanishes."""
    found: list[tuple[Expr, int]] = []
    for factor in Mul.make_args(tidied(value).as_numer_denom()[0]):
        base, power = factor.as_base_exp()
        inner, times = (base.args[0], Integer(2)) if isinstance(base, Abs) else (base, power)
        try:
            factors = factor_list(inner)[1] if times.is_Integer else []
        except PolynomialError:
            factors = []
        found += [(each, int(times) * n) for each, n in factors if each.is_Add]
    return found


def _zero_in(view: View, base: Expr) -> Relation | None:
    """Return the value of a mass or length in given symbols, or the angle, for which a factor vanishes; None if no such
    value is found."""
    for letter in [s for s in view.in_order(base.free_symbols) if view.letters[s] in ("mass", "length")]:
        found = solved_for_letter(base, letter)
        if (
            found is not None
            and found.free_symbols <= {*view.letters}
            and simple(found, 4)
            and sign_for_all(found) == 1
        ):
            return Relation(letter, "=", found)
    c = Symbol("c")
    for cosine in sorted(base.atoms(cos), key=str):
        found = solved_for_letter(tidied(base.subs(cosine, c)), c)
        if found is not None and found.is_number and abs(found) < 1 and isinstance(cosine.args[0], Symbol):
            return Relation(cosine.args[0], "=", acos(found))
    return None


def _is_told(view: View, place: Relation) -> bool:
    solved = [q.value for q in view.page if isinstance(q.value, Relation) and isinstance(q.value.left, Symbol | cos)]
    solved += [Relation(q.symbol, "=", q.value) for q in view.page if isinstance(q.symbol, cos)]
    return any(is_zero(explicit(told.residual).xreplace({place.left: place.right})) for told in solved)


def _zero(of: Quantity, place: Relation, outcome: str) -> Quantity:
    at_angle = isinstance(place.right, acos)
    return observation(
        ZERO_OF,
        lambda *_: place,
        {"of": of},
        routes={"put_in": lambda found: (explicit(of.value).xreplace({found.left: explicit(found.right)}), Integer(0))},
        outcome=f"{outcome}_at_angle" if at_angle else outcome,
        phrase_data=PhraseData(
            named={
                "place": place,
                **({"size": _in_degrees(place.right)} if at_angle else {}),
                **({"letter": place.left} if outcome == "changes" and not at_angle else {}),
            },
            outcome_data={"angle": place.right} if at_angle else {},
        ),
        key=f"{of.key}_zero",
    )


BRANCHES = Rule(
    "observations.branches",
    source="Taylor, *Classical Mechanics*, example 7.6; Strogatz, *Nonlinear Dynamics and Chaos*, section 3.5",
    outcomes={"generic": claims.branches_off},
    evidence={"both_vanish": CHECK, TRIALS: CHECK},
    named={"border": claims.is_the_result},
)


def branches(view: View) -> Observed:
    """Angular velocity at which an equilibrium becomes unstable and two other equilibria branch off from it."""
    rests = [q for q in view.shown if q.fact(RestOf) is not None and isinstance(q.symbol, Symbol)]
    for of in (q for q in view.answers if q.fact(StableWhere) is not None):
        here = _at(rests, of.needed(StableWhere).place)
        for branch in (q for q in rests if isinstance(explicit(q.value), acos)):
            other, beside = _at(rests, -branch.value), _shape_at(view, branch.value)
            border = _border(view, of, explicit(branch.value).args[0])
            if here is not None and is_zero(here.value) and other is not None and beside and border is not None:
                yield _branching(of, {"here": here, "branch": branch, "other": other, "beside": beside}, border)


def _at(rests: Sequence[Quantity], place: Expr) -> Quantity | None:
    return next((q for q in rests if is_zero(q.value - place)), None)


def _shape_at(view: View, place: Expr) -> Quantity | None:
    return next((q for q in view.shown if (shape := q.fact(Shape)) and is_zero(shape.place - place)), None)


def _border(view: View, of: Quantity, cosine: Expr) -> Relation | None:
    """Return the value of an angular velocity for which both the curvature and 1 - cos(theta) vanish; None if no such
    value is found."""
    for letter in view.of_kind("angular speed"):
        found = solved_for_letter(cosine - 1, letter)
        if found is not None and is_zero(tidied(explicit(of.value).xreplace({letter: found}))):
            return Relation(letter, "=", found)
    return None


def _branching(of: Quantity, steps: dict[str, Quantity], border: Relation) -> Quantity:
    curvature, cosine = explicit(of.value), explicit(steps["branch"].value).args[0]

    def both_vanish(found: Relation) -> tuple[Any, Any]:
        there = {found.left: explicit(found.right)}
        return (curvature.xreplace(there) + (cosine.xreplace(there) - 1) * Symbol("u"), Integer(0))

    return observation(
        BRANCHES,
        lambda *_: border,
        {"of": of},
        routes={"both_vanish": both_vanish},
        phrase_data=PhraseData(
            named={"border": border},
            points_to=steps,
            outcome_data={"cosine": cosine},
        ),
        key=f"{of.key}_branches",
    )


RESONANCE = Rule(
    "observations.resonance",
    source="Taylor, *Classical Mechanics*, sections 5.5 and 5.6",
    outcomes={"generic": claims.grows_without_bound_there},
    evidence={"denominator": CHECK},
    named={"place": claims.is_the_result},
)


def resonance(view: View) -> Observed:
    """Driving frequency at which the undamped amplitude grows without bound: the frequency of the free oscillation."""
    for of in view.answers:
        if (of.step.rule, of.step.outcome) == ("vibrations.steady_amplitude", "undamped"):
            below, square = tidied(of.value).as_numer_denom()[1], _free_frequency(of)
            inner = next((each.args[0] for each in below.atoms(Abs)), below)
            for letter in [s for s in view.of_kind("angular speed") if s in inner.free_symbols]:
                found = solved_for_letter(inner, letter)
                if found is not None and square is not None:
                    yield _resonance(of, inner, Relation(letter, "=", found), square)


def _free_frequency(of: Quantity) -> Expr | None:
    """Return the squared frequency of the free oscillation, from the coefficients of the equation of motion; None if
    there is no such equation."""
    for each in (q for q in of.ancestors() if isinstance(q.value, Relation) and len(q.coordinates) == 1):
        (q,), residual = each.coordinates, explicit(each.value.residual)
        inertia, stiffness = residual.diff(rate(q, 2)), residual.diff(q)
        if inertia != 0 and not stiffness.has(q):
            return tidied(stiffness / inertia)
    return None


def _resonance(of: Quantity, inner: Expr, place: Relation, square: Expr) -> Quantity:
    return observation(
        RESONANCE,
        lambda *_: place,
        {"of": of},
        routes={"denominator": lambda found: (inner.xreplace({found.left: found.right}), Integer(0))},
        phrase_data=PhraseData(named={"place": place}, outcome_data={"square": square}),
        key=f"{of.key}_resonance",
    )


ANYWHERE = Rule(
    "observations.anywhere",
    source="Morin, *Introduction to Classical Mechanics*, section 6.2",
    outcomes={"generic": claims.holds_everywhere},
    evidence={"put_in": CHECK},
    named={"place": claims.is_the_result_by_name},
)


def anywhere(view: View) -> Observed:
    """Value of an angular velocity for which every position is an equilibrium."""
    for of in view.shown:
        if of.step.rule != "rest.condition" or not any(of in q.ancestors() for q in view.answers):
            continue
        residual = explicit(of.value.residual)
        energy = explicit(of.parent("potential").value)
        slopes = [diff(energy, q) for q in of.coordinates]
        if len([slope for slope in slopes if not is_zero(slope)]) != 1:
            continue  # the condition of another coordinate may exclude positions
        for letter in [s for s in view.of_kind("angular speed") if s in residual.free_symbols]:
            for base, _ in _factors(residual):
                found = solved_for_letter(base, letter)
                if found is not None and not found.free_symbols & set(of.coordinates):
                    yield _anywhere(of, Relation(letter, "=", found))


def _anywhere(of: Quantity, place: Relation) -> Quantity:
    residual = explicit(of.value.residual)
    known = [q for q in defined_quantities() if is_zero(explicit(q.value) - place.right)][:1]
    named = Relation(place.left, "=", known[0].symbol) if known else place
    return observation(
        ANYWHERE,
        lambda *_: place,
        {"of": of, **({"known": known[0]} if known else {})},
        routes={"put_in": lambda found: (residual.xreplace({found.left: explicit(found.right)}), Integer(0))},
        phrase_data=PhraseData(named={"place": named}),
        key=f"{of.key}_anywhere",
    )


ONE_SIGN = Rule(
    "observations.one_sign",
    source="none needed: signs of factors",
    outcomes={"generic": claims.has_one_sign},
    evidence={TRIALS: CHECK},
)


def one_sign(view: View) -> Observed:
    """Normal force whose sign is the same at all positions, although its magnitude depends on the position."""
    for of in view.values("force"):
        value = tidied(of.value)
        moving = [q for q in of.coordinates if q in value.free_symbols]
        if len(moving) == 1 and sign_for_all(value) is None and _is_force_of(of, "surface"):
            factors = [f for f in Mul.make_args(value) if moving[0] in f.free_symbols]
            if all(sign_for_all(f) == 1 for f in factors):
                yield _one_sign(of, moving[0], value, Mul(*factors))


def _is_force_of(of: Quantity, *enforcers: str) -> bool:
    """Whether the answer is a constraint force that one of these enforcers exerts, or this force with other results
    substituted.
    """
    facts = [q.fact(ForceOf) for q in of.ancestors() if q.symbol == of.symbol]
    return any(fact is not None and fact.constraint.enforcer in enforcers for fact in facts)


def _one_sign(of: Quantity, q: Symbol, value: Expr, positive: Expr) -> Quantity:
    return observation(
        ONE_SIGN,
        lambda *_: value / positive,
        {"of": of, "q": q},
        key=f"{of.key}_one_sign",
    )


BALANCED = Rule(
    "observations.balanced",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 8",
    outcomes={"generic": claims.balances},
    evidence={"put_in": CHECK, TRIALS: CHECK},
    named={"place": claims.is_an_angle},
)


def balanced(view: View) -> Observed:
    """The angles 0 and 90 degrees, if the bearings need no torque at these angles, but need one at each angle in
    between."""
    for of in view.answers:
        entries = [each for each in explicit(of.value) if each != 0] if isinstance(of.value, MatrixBase) else []
        if of.step.kind == "torque" and len(entries) == 1:
            for letter in [s for s in view.of_kind("angle") if s in entries[0].free_symbols]:
                if _vanishes_only_at_the_ends(entries[0], letter):
                    yield _balanced(of, entries[0], letter, (Integer(0), pi / 2))


def _vanishes_only_at_the_ends(entry: Expr, angle: Symbol) -> bool:
    """Whether 0 and 90 degrees are in the range of the angle, and the entry vanishes at both angles, but not in
    between.

    The entry must be sin(angle) cos(angle) times factors that have one sign for all angles in this range.
    """
    lies = range_of(angle)
    if lies is not None and not (lies.holds(Integer(0)) and lies.holds(pi / 2)):
        return False
    rest = tidied(expand_trig(entry) / (sin(angle) * cos(angle)))
    factors = [factor for factor in Mul.make_args(rest) if angle in factor.free_symbols]
    others = rest.free_symbols - {angle}
    as_numbers = rest.xreplace({sin(angle): Symbol("s"), cos(angle): Symbol("c")})
    is_rational = as_numbers.is_rational_function(*others, Symbol("s"), Symbol("c")) and not as_numbers.has(pi)
    return bool(is_rational) and all(sign_for_all(factor) in (1, -1) for factor in factors)


def _balanced(of: Quantity, entry: Expr, letter: Symbol, found: Sequence[Expr]) -> Quantity:
    return observation(
        BALANCED,
        lambda *_: entry,
        {"of": of, "angle": letter},
        routes={"put_in": lambda e: (Add(*(e.xreplace({letter: each}) ** 2 for each in found)), Integer(0))},
        phrase_data=PhraseData(named=numbered("place", [Relation(letter, "=", each) for each in found])),
        key=f"{of.key}_balanced",
    )


BELOW = Rule(
    "observations.below",
    source="Morin, *Introduction to Classical Mechanics*, section 1.1",
    outcomes={"generic": claims.stays_below_and_approaches},
    evidence={TRIALS: CHECK},
)


def below(view: View) -> Observed:
    """Frequency that is below a given angular velocity; their ratio approaches 1 as the angular velocity grows."""
    for of in view.values("angular speed"):
        value = explicit(of.value)
        for letter in [s for s in view.of_kind("angular speed") if s in value.free_symbols]:
            apart = tidied(letter**2 - value**2)
            if of.step.rule == "vibrations.frequency" and sign_for_all(apart) == 1:
                if tidied(apart / letter**2).xreplace({letter: 1 / letter}).subs(letter, 0) == 0:
                    yield _below(of, letter, apart)


def _below(of: Quantity, letter: Symbol, apart: Expr) -> Quantity:
    return observation(
        BELOW,
        lambda *_: apart,
        {"of": of, "letter": letter},
        key=f"{of.key}_below",
    )


FLAT = Rule(
    "observations.flat",
    source="Kleppner, Kolenkow, *An Introduction to Mechanics*, 2nd edition, chapter 7",
    outcomes={"generic": claims.is_sum_of_the_others},
    evidence={"sum": CHECK},
    named={"sum": claims.adds_the_moments},
)


def flat(view: View) -> Observed:
    """Principal moments of a flat body: the moment about the normal is the sum of the two others."""
    for of in (q for q in view.answers if q.step.kind == "moment of inertia" and isinstance(q.symbol, MatrixBase)):
        names, values = list(of.symbol), [explicit(each) for each in of.value]
        for i in range(len(values) if len(values) == 3 and len(set(values)) == 3 else 0):
            j, k = sorted({0, 1, 2} - {i})
            if is_zero(values[i] - values[j] - values[k]):
                yield _flat(of, Relation(Add(names[j], names[k]), "=", names[i]))


def _flat(of: Quantity, told: Relation) -> Quantity:
    values = dict(zip(of.symbol, explicit(of.value), strict=True))
    return observation(
        FLAT,
        lambda *_: told,
        {"of": of},
        routes={"sum": lambda found: (found.left.xreplace(values), found.right.xreplace(values))},
        phrase_data=PhraseData(named={"sum": told}),
        key=f"{of.key}_flat",
    )
