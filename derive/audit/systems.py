"""What follows from several earlier equations together.

An equation counts as a consequence of other equations if, at a few points, it is a linear combination of them. For this
test, the products of the letters that are eliminated are the unknowns of linear equations. Lagrange's and Hamilton's
equations of a function that the document defines also belong to the known equations.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import sympy
from sympy import Expr, Integer, Integral, MatrixBase, Poly, Symbol

from derive.audit.claims import Definition
from derive.audit.fingerprint import CLOSE, is_zero
from derive.audit.knowledge import LAST_EQUATIONS, Known
from derive.audit.numeric import Numbers, at, determined, spanned
from derive.audit.time_limit import FAULTS
from derive.documents.facts import ANGLES, VARIABLES
from derive.documents.meaning import Meaning, Value
from derive.documents.source import Span
from derive.documents.syntax import Letter

MOST_EQUATIONS = 8
POINTS = 2
LARGEST = 300  # an equation with at least this number of operations is left out
LARGEST_LAGRANGIAN = 500
LARGEST_CONSTRAINT = 60
HIGHEST_POWER = 6
MOST_VALUES = 3  # at most this many earlier values are compared with zero
CONSERVED = ("E", "h", "H")
PERIODS = ("tau", "T", "P")


OF_RATES = "the time derivative of an earlier equation"


@dataclass(frozen=True)
class Equation:
    """An expression that vanishes, the claims that it comes from, and its name in the reason of a verdict."""

    value: Expr
    claims: tuple[int, ...]
    name: str = "earlier equations"


def equations_of(
    known: Known, meaning: Meaning, without: Symbol | None = None, sure: bool = False, written: bool = False
) -> list[Equation]:
    """Return the equations that earlier rows give, the last ones first, with definitions substituted.

    sure      whether to leave out conditions in sentences and motions x(t), which may hold in one case only
    written   whether to leave out Lagrange's and Hamilton's equations of a function
    """
    state = (
        len(known.equations),
        sum(map(len, known.definitions.values())),
        without,
        sure,
        written,
        known.here,
        known.moving,
        known.sentence,
    )
    if state not in known.kept:
        if len(known.kept) > 200:
            known.kept.clear()
        known.kept[state] = _equations_of(known, meaning, without, sure, written)
    found: list[Equation] = known.kept[state]
    return found


def _equations_of(known: Known, meaning: Meaning, without: Symbol | None, sure: bool, written: bool) -> list[Equation]:
    found: list[Equation] = []
    seen = set()

    def add(value: Expr, claims: tuple[int, ...], name: str) -> None:
        if value in seen or not value.free_symbols or is_zero(value):
            return
        if sympy.count_ops(value) < LARGEST:
            seen.add(value)
            found.append(Equation(value, claims, name))

    for value, number in reversed(known.equations[-LAST_EQUATIONS:]):
        if value.has(Integral) or (sure and number in known.conditions - known.here) or len(found) == MOST_EQUATIONS:
            continue
        if known.is_elsewhere(number):
            continue
        put_in, used = expanded(known, value, without, sure)
        add(put_in, (*used, number), "earlier equations")
    for value, claims, name in motion(known, meaning) if not written else ():
        put_in, _ = expanded(known, value, without, sure)
        add(put_in, claims, name)
    for each in list(found[:6]):
        at_instant = known.here & set(each.claims) or any(map(known.has_no_rate, each.claims))
        if sympy.count_ops(each.value) > LARGEST_CONSTRAINT or at_instant:
            continue  # an equation that holds at one instant only cannot be differentiated
        if without in each.value.free_symbols and not _may_be_constant(without, meaning):
            continue
        for rate in rates(each.value, meaning, known):
            add(rate, each.claims, OF_RATES)
    return found[: 2 * MOST_EQUATIONS]


def expanded(
    known: Known, value: Expr, without: Symbol | None = None, sure: bool = False
) -> tuple[Expr, tuple[int, ...]]:
    """Return a value after substituting definitions that do not involve the letter `without`, and the claims used."""
    used: list[int] = []
    for _ in range(6):
        found = {}
        for symbol in sorted(value.free_symbols, key=str):
            if symbol == without:
                continue
            definition = known.surely(symbol) if sure else known.latest(symbol)
            if definition is not None and symbol not in definition.value.free_symbols:
                if without is not None and without in definition.value.free_symbols:
                    continue
                if sure and definition.claim not in known.here and _is_solution(symbol, definition.value, known):
                    continue
                found[symbol] = definition.value
                used.append(definition.claim)
        if not found:
            break
        try:
            new = value.xreplace(found)
        except ValueError:  # a letter is the variable of an integral
            return value, tuple(dict.fromkeys(used))
        if new.has(sympy.zoo, sympy.nan) or sympy.count_ops(new) > 4 * LARGEST:
            break
        value = new
    return value, tuple(dict.fromkeys(used))


def _may_be_constant(letter: Symbol | None, meaning: Meaning) -> bool:
    """Whether a letter whose value is not known may be constant: an energy is, a Lagrangian is not."""
    named = meaning.symbols.get(letter)
    return named is None or named.base not in ("L", "T", "U", "V", "K") or bool(named.sub)


def _is_solution(symbol: Symbol, value: Expr, known: Known) -> bool:
    meaning = known.meaning

    def changes(each: Symbol) -> bool:
        letter = meaning.symbols.get(each)
        return letter is not None and (letter.dots > 0 or meaning.facts.changes(letter))

    return changes(symbol) and not any(map(changes, value.free_symbols))


def changing_letters(symbols: set[Symbol], meaning: Meaning) -> tuple[Symbol, ...]:
    """Return the symbols that change with time, are rates, or have names that are usual for angles."""
    return tuple(
        sorted(
            (
                each
                for each in symbols
                if (letter := meaning.symbols.get(each)) is not None
                and (letter.dots or meaning.facts.changes(letter) or letter.base in ANGLES)
            ),
            key=str,
        )
    )


def moving_letters(symbols: set[Symbol], meaning: Meaning) -> tuple[Symbol, ...]:
    """Return the coordinates and rates among symbols: letters that the document writes with dots or as functions of
    time."""
    named = {each: meaning.symbols[each] for each in sorted(symbols, key=str) if each in meaning.symbols}
    return tuple(each for each, letter in named.items() if letter.dots or meaning.facts.changes(letter))


def rates(value: Expr, meaning: Meaning, known: Known) -> Iterator[Expr]:
    """Yield the first time derivative of an equation and, if the equation has no rates, also the second. No zero
    is yielded, and nothing if the equation has second rates or letters whose rates are unknown."""
    letters = [meaning.symbols[each] for each in value.free_symbols if each in meaning.symbols]
    if any(each.dots >= 2 for each in letters) or any(each in meaning.derivatives for each in value.free_symbols):
        return
    still = value.free_symbols - set(moving_letters(value.free_symbols, meaning))
    defined = [known.definitions[each][-1].value for each in still if each in known.definitions]
    if any(moving_letters(each.free_symbols, meaning) for each in defined):
        return  # a letter that is defined by moving letters moves, too, even if the document never writes it with a dot
    time = next((s for s, letter in meaning.symbols.items() if letter.base == "t" and not letter.sub), None)
    time = time if time is not None else Symbol("t", positive=True)
    order = 1 if any(each.dots for each in letters) else 2
    for _ in range(order):
        value = meaning.differentiated(value, time, False)
        if value == 0:
            return
        yield value


def rate_of_first_integral(left: Expr, right: Expr, meaning: Meaning, known: Known) -> Expr | None:
    """Return the time derivative of an equation that may be a first integral, such as the conservation of energy; None
    unless the equation contains a coordinate and its first rate, but no second rates."""
    name = meaning.symbols.get(left.as_base_exp()[0])
    if name is not None and not name.dots and name.base not in CONSERVED:
        return None  # the value of a letter, such as a kinetic energy, may change
    value, _ = expanded(known, left - right, left if left.is_Symbol else None, sure=True)
    letters = {each: meaning.symbols[each] for each in value.free_symbols if each in meaning.symbols}
    if any(each.base == "t" or each.dots > 1 for each in letters.values()) or value.has(Integral):
        return None
    places = {replace(each, dots=0).identity for each in letters.values() if each.dots}
    if not any(each.identity in places and not each.dots for each in letters.values()):
        return None
    return next(rates(value, meaning, known), None)


def linearised(equations: Sequence[Equation], meaning: Meaning) -> list[Equation]:
    """Return equations to the first order in the letters that change with time, and then their parts of order zero,
    which vanish at an equilibrium. An equation without a value where the letters vanish is unchanged.
    """
    found, at_rest = [], []
    for each in equations:
        small = moving_letters(each.value.free_symbols, meaning)
        at_zero = {letter: Integer(0) for letter in small}
        rest = each.value.subs(at_zero)
        terms = [letter * sympy.diff(each.value, letter).subs(at_zero) for letter in small]
        if any(part.has(sympy.zoo, sympy.nan, sympy.oo) for part in (rest, *terms)):
            found.append(each)
            continue
        found.append(replace(each, value=sympy.expand(sympy.Add(rest, *terms))))
        if small and len(sympy.Add.make_args(sympy.expand(rest))) > 1:
            at_rest.append(replace(each, value=rest))
    return found + at_rest


def is_linear(value: Expr, meaning: Meaning) -> bool:
    """Whether all terms of an equation of motion are of the first order in the letters that change with time. False for
    an equation without second rates."""
    small = moving_letters(value.free_symbols, meaning)
    if not any(meaning.symbols[each].dots == 2 for each in small):
        return False
    slopes = [sympy.diff(value, each) for each in small]
    rest = sympy.expand(value - sympy.Add(*(each * slope for each, slope in zip(small, slopes, strict=True))))
    return rest == 0 and not any(slope.free_symbols & set(small) for slope in slopes)


def with_small_factors(equations: Sequence[Equation], meaning: Meaning) -> list[Equation]:
    """Return equations, and the product of each equation at rest with each coordinate that changes with time."""
    everywhere = set().union(*(each.value.free_symbols for each in equations)) if equations else set()
    places = [s for s in moving_letters(everywhere, meaning) if not meaning.symbols[s].dots]
    still = [each for each in equations if not moving_letters(each.value.free_symbols, meaning)]
    return [*equations, *(replace(each, value=place * each.value) for each in still for place in places)]


def lagrange_equations(known: Known, last: int = 1) -> list[tuple[Symbol, Expr, int]]:
    """Return Lagrange's equations of the last values that rows give to each letter L. Each equation is a tuple of its
    coordinate, its left side and the number of the claim."""
    found = []
    for unexpanded, claim in _lagrangians(known, last):
        value, _ = expanded(_before(claim, known), unexpanded, sure=True)
        if ("L", value) not in known.kept:
            known.kept["L", value] = list(_lagrange_equations(value, known.meaning))
        found += [(place, equation, claim) for place, equation in known.kept["L", value]]
    return found


def _before(claim: int, known: Known) -> Known:
    """Return what is known without the values that claims after the given one give to coordinates."""
    moving = moving_letters(set(known.definitions), known.meaning)
    later = {each for each in moving if known.definitions[each][-1].claim > claim}
    if not later:
        return known
    return replace(known, definitions={s: found for s, found in known.definitions.items() if s not in later}, kept={})


def _lagrangians(known: Known, last: int) -> list[tuple[Expr, int]]:
    """Return the last values of each letter L, or T - U if the document states no L. A value such as q B x y' is only a
    part of a Lagrangian."""
    found = []
    for symbol, definitions in list(known.definitions.items()):
        letter = known.meaning.symbols.get(symbol)
        if letter is not None and letter.base == "L" and not letter.dots and not letter.primes:
            whole = [each for each in definitions if not _is_linear_in_rates(each.value, known)]
            found += [(each.value, each.claim) for each in reversed(whole[-last:])]
    difference = difference_of_energies(known)
    return found or ([difference] if difference is not None else [])


def _is_linear_in_rates(value: Expr, known: Known) -> bool:
    rates = list(filter(known.is_rate, value.free_symbols))
    return bool(rates) and not any(sympy.diff(value, each).free_symbols & set(rates) for each in rates)


def difference_of_energies(known: Known) -> tuple[Expr, int] | None:
    """Return T - U and the number of the later of the two claims; None unless the document speaks of Lagrange and gives
    values to both energies."""
    found = energies(known)
    if found is None:
        return None
    kinetic, potential = found
    return kinetic.value - potential.value, max(kinetic.claim, potential.claim)


def energies(known: Known) -> tuple[Definition, Definition] | None:
    """Return the values of the kinetic and of the potential energy; None unless the document speaks of Lagrange and
    gives values to both."""
    found: dict[str, Definition] = {}
    for symbol, definitions in list(known.definitions.items()):
        letter = known.meaning.symbols.get(symbol)
        if letter is None or letter.dots or letter.primes or letter.sub or definitions[-1].claim in known.conditions:
            continue
        if letter.base in ("T", "K", "U", "V"):
            found["kinetic" if letter.base in "TK" else "potential"] = definitions[-1]
    if len(found) < 2 or not known.meaning.facts.has_lagrange:
        return None
    return found["kinetic"], found["potential"]


def _lagrange_equations(value: Expr, meaning: Meaning) -> Iterator[tuple[Symbol, Expr]]:
    if sympy.count_ops(value) > LARGEST_LAGRANGIAN:
        return
    time = meaning.symbol(Letter(Span(0, 0), "t"))
    for symbol in sorted(value.free_symbols, key=str):
        rate = meaning.symbols.get(symbol)
        if rate is None or rate.dots != 1:
            continue
        place = meaning.symbol(replace(rate, dots=0))
        momentum_rate = meaning.differentiated(meaning.differentiated(value, symbol, True), time, False)
        yield place, sympy.expand(momentum_rate - meaning.differentiated(value, place, True))


def motion(known: Known, meaning: Meaning) -> Iterator[tuple[Expr, tuple[int, ...], str]]:
    """Yield Lagrange's equations of each Lagrangian, and Hamilton's equations of each Hamiltonian."""
    of_lagrange = lagrange_equations(known)
    for place, equation, number in of_lagrange:
        if not _has_force(place, equation, known, [each for _, each, _ in of_lagrange]):
            yield equation, (number,), f"Lagrange's equation for `{place}`"
    for symbol, definitions in list(known.definitions.items()):
        letter = meaning.symbols.get(symbol)
        if letter is None or letter.dots or letter.base != "H":
            continue
        value, _ = expanded(known, definitions[-1].value, sure=True)
        if sympy.count_ops(value) > LARGEST:
            continue
        claims = (definitions[-1].claim,)
        for p in sorted(value.free_symbols, key=str):
            momentum = meaning.symbols.get(p)
            if momentum is None or momentum.base != "p" or momentum.dots or not momentum.sub:
                continue
            place = meaning.symbol(Letter(momentum.span, momentum.sub))
            rate_of_place = meaning.symbol(Letter(momentum.span, momentum.sub, dots=1))
            rate_of_p = meaning.symbol(replace(momentum, dots=1))
            yield rate_of_place - meaning.differentiated(value, p, True), claims, "Hamilton's equations"
            yield rate_of_p + meaning.differentiated(value, place, True), claims, "Hamilton's equations"


def _has_force(place: Symbol, equation: Expr, known: Known, all_equations: Sequence[Expr]) -> bool:
    """Whether the document states Lagrange's equation for a coordinate with a force, in general, or because an earlier
    equation has the same acceleration and a term with a letter that no Lagrange's equation contains."""
    named = known.meaning.symbols[place]
    if {"q", named.base} & known.forced:
        return True
    acceleration = known.meaning.symbol(replace(named, dots=2))
    slope = sympy.diff(equation, acceleration)
    letters = set().union(*(each.free_symbols for each in all_equations))
    for stated, number in known.equations[-LAST_EQUATIONS:]:
        if number in known.conditions or acceleration not in stated.free_symbols or stated.has(Integral):
            continue
        value, _ = expanded(known, stated, sure=True)
        if sympy.count_ops(value) < LARGEST_CONSTRAINT and slope != 0:
            rest = sympy.expand(value - sympy.diff(value, acceleration) / slope * equation)
            if rest.free_symbols - letters:
                return True
    return False


def motion_of(place: Value, value: Value, meaning: Meaning) -> dict[Symbol, Expr]:
    """Return a coordinate and its first two rates with their values for a motion x(t), or the rate and its own rate for
    a speed x'(t); nothing for other values."""
    letter = meaning.symbols.get(place) if isinstance(place, Symbol) else None
    time = next((each for each in value.free_symbols if each.name == "t"), None)
    if letter is None or letter.dots > 1 or time is None or isinstance(value, MatrixBase):
        return {}
    rates = [meaning.symbol(replace(letter, dots=dots)) for dots in range(letter.dots, 3)]
    return {rate: sympy.diff(value, time, order) if order else value for order, rate in enumerate(rates)}


def equations_of_motion(place: Value, value: Value, meaning: Meaning, known: Known) -> list[tuple[Expr, int]]:
    """Return the earlier equations that contain rates of the coordinate of a motion, but no rates of other
    coordinates."""
    rates = set(list(motion_of(place, value, meaning))[1:])
    return [
        (each, number)
        for each, number in known.equations[-LAST_EQUATIONS:]
        if number not in known.conditions
        and each.free_symbols & rates
        and not any(map(known.is_rate, each.free_symbols - rates - {place}))
    ]


def root_equation(letter: Symbol, meaning: Meaning, known: Known) -> tuple[Symbol, Expr, int] | None:
    """Return the last earlier equation of which a letter such as w_1 or x_0 may be a root; otherwise None.

    The equation contains the letter without its index, w or x. The result is a tuple of w or x, the equation, and the
    number of the equation's claim.
    """
    named = meaning.symbols.get(letter)
    if named is None or not named.sub or named.dots or named.marks or named.base == "t":
        return None
    if named.sub in VARIABLES:
        return None  # a component, such as v_r or v_theta
    plain = meaning.symbol(replace(named, sub=""))
    of_others = {each.claim for symbol, found in known.definitions.items() if symbol != plain for each in found}
    for value, number in reversed(known.equations[-MOST_EQUATIONS:]):
        if (
            plain not in value.free_symbols
            or number in known.conditions - known.at_rest | of_others
            or value.has(Integral)
        ):
            continue
        found, _ = expanded(known, value, plain, sure=True)
        if any(map(known.is_rate, found.free_symbols)):
            found = value  # a momentum counts as a number, because its definition contains rates
        if plain not in found.free_symbols or len(sympy.Add.make_args(sympy.expand(found))) < 2:
            continue
        if any(known.is_rate(each) for each in found.free_symbols) or found.free_symbols & set(meaning.derivatives):
            continue
        if sympy.count_ops(found) < LARGEST and not _defines(found, plain):
            return plain, found, number
    return None


def values_at_instant(letter: Symbol, meaning: Meaning, known: Known) -> Iterator[tuple[Definition, Definition]]:
    """Yield the values at t_1 that a letter such as v_1 may have, for earlier letters whose values contain t, and the
    definition of t_1."""
    named = meaning.symbols.get(letter)
    if named is None or not named.sub or named.dots or named.marks or named.base == "t":
        return
    instant = known.latest(meaning.symbol(replace(named, base="t")))
    time = next((s for s, each in meaning.symbols.items() if each.base == "t" and not each.sub), None)
    if instant is None or time is None or time in instant.value.free_symbols:
        return
    for definitions in list(known.definitions.values()):
        earlier = definitions[-1]
        if time in earlier.value.free_symbols:
            yield replace(earlier, value=earlier.value.subs(time, instant.value)), instant


def values_at_place(value: Expr, other: Expr, meaning: Meaning) -> Iterator[tuple[Symbol, Expr, Expr]]:
    """Yield the values of an expression where its only coordinate that `other` lacks is zero or, for an angle, a
    quarter or half of a turn. Each result is a tuple of the coordinate, its number, and the value there."""
    if isinstance(value, MatrixBase) or isinstance(other, MatrixBase):
        return
    places = changing_letters(value.free_symbols - other.free_symbols, meaning)
    if len(places) != 1 or meaning.symbols[places[0]].dots or not other.free_symbols:
        return
    is_angle = meaning.symbols[places[0]].base in ANGLES
    for number in (Integer(0), sympy.pi / 2, sympy.pi) if is_angle else (Integer(0),):
        there = value.subs(places[0], number)
        if not there.has(sympy.zoo, sympy.nan, sympy.oo):
            yield places[0], number, there


def zeros_in_time(letter: Symbol, meaning: Meaning, known: Known) -> tuple[Symbol, Expr, int] | None:
    """Return t, the last earlier value that contains t, and the number of its claim, for the name t_1 of an instant;
    otherwise None. A value that vanishes at t_1 is zero there."""
    named = meaning.symbols.get(letter)
    time = next((s for s, each in meaning.symbols.items() if each.base == "t" and not each.sub), None)
    if named is None or named.base != "t" or not named.sub or named.dots or time is None:
        return None
    found = [each[-1] for each in known.definitions.values() if time in expanded(known, each[-1].value)[0].free_symbols]
    last = max(found, key=lambda each: each.claim, default=None)
    return (time, expanded(known, last.value)[0], last.claim) if last is not None else None


def values_with(place: Expr, meaning: Meaning, known: Known, rates: bool) -> list[Definition]:
    """Return the last earlier values that contain a constant letter, or a function of a letter such as cos(theta), and
    that may vanish there: `cos(theta) = 2/3` where the force vanishes.

    rates   whether the value of a rate may vanish, too
    """
    if not (place.is_Symbol or (place.is_Function and len(place.args) == 1 and place.args[0].is_Symbol)):
        return []
    found = []
    for symbol in known.definitions:
        last = known.general_value(symbol)
        if symbol == place or last is None or isinstance(last.value, MatrixBase):
            continue
        if not rates and known.is_rate(symbol):
            continue
        value, _ = expanded(known, last.value, place if place.is_Symbol else None, sure=True)
        if isinstance(place, sympy.cos):
            value = value.subs(sympy.sin(place.args[0]) ** 2, 1 - place**2)
        if value.has(place) and len(sympy.Add.make_args(sympy.expand(value))) > 1:
            found.append(replace(last, value=value))
    return sorted(found, key=lambda each: -each.claim)[:MOST_VALUES]


def frequency_equations(letter: Symbol, meaning: Meaning, known: Known) -> list[tuple[Expr, int]]:
    """Return equations whose roots are the angular frequencies, or the periods, of earlier linear equations of motion,
    and the numbers of their claims; `letter` is the unknown."""
    named = meaning.symbols.get(letter)
    if named is None or named.base not in ("omega", *PERIODS) or named.dots or named.marks:
        return []
    linear = [each for value, number in known.equations[-LAST_EQUATIONS:] for each in _linear(value, number, known)]
    found = []
    for count in (1, 2, 3):
        rows = linear[-count:]
        places = sorted(set().union(*(each.rigidity for each in rows)), key=str)
        if len(rows) == count and len(places) == count:
            squared = 4 * sympy.pi**2 / letter**2 if named.base in PERIODS else letter**2
            matrix = sympy.Matrix(
                [[each.rigidity.get(q, 0) - squared * each.inertia.get(q, 0) for q in places] for each in rows]
            )
            found.append((matrix.det(), rows[-1].claim))
    return [(equation, claim) for equation, claim in found if letter in equation.free_symbols]


@dataclass(frozen=True)
class _Oscillation:
    """The coefficients of the coordinates and of their second rates in a linear equation of motion."""

    rigidity: dict[Symbol, Expr]
    inertia: dict[Symbol, Expr]
    claim: int


def _linear(value: Expr, claim: int, known: Known) -> Iterator[_Oscillation]:
    meaning = known.meaning
    letters = {each: meaning.symbols[each] for each in value.free_symbols if each in meaning.symbols}
    rates = {each: letter for each, letter in letters.items() if letter.dots}
    if not rates or any(letter.dots != 2 for letter in rates.values()) or value.has(Integral):
        return
    if any(letter.base == "t" for letter in letters.values()):
        return
    value, _ = expanded(known, value, sure=True)
    places = {each: meaning.symbol(replace(letter, dots=0)) for each, letter in rates.items()}
    inertia = {place: sympy.diff(value, rate) for rate, place in places.items()}
    coupled = {each for each in moving_letters(value.free_symbols, meaning) if not meaning.symbols[each].dots}
    rigidity = {place: sympy.diff(value, place) for place in coupled.union(places.values())}
    if any(each.free_symbols & {*places, *rigidity} for each in (*inertia.values(), *rigidity.values())):
        return
    rest = value - sum(inertia[place] * rate for rate, place in places.items())
    rest -= sum(slope * place for place, slope in rigidity.items())
    if is_zero(sympy.expand(rest)) or sympy.expand(rest) == 0:
        yield _Oscillation(rigidity, inertia, claim)


def vanishes(equation: Expr, letter: Symbol, value: Expr, meaning: Meaning, known: Known) -> bool | None:
    """Whether an equation holds with a value for a letter; None if the numbers cannot be computed."""
    try:
        for point in range(POINTS):
            basic = numbers(meaning, known, point)
            root = basic.of(value)
            found, elsewhere = (
                at(equation, lambda s, b=basic, r=r: r if s == letter else b.of_symbol(s))  # type: ignore[misc]
                for r in (root, 1.37 * root + 0.11)
            )
            if abs(found) > CLOSE * abs(elsewhere):
                return False
    except FAULTS:
        return None
    return True


def _defines(value: Expr, letter: Symbol) -> bool:
    return value.is_Add and any(each in (letter, -letter) for each in value.args)


def numbers(meaning: Meaning, known: Known, point: int) -> Numbers:
    return Numbers(meaning, lambda symbol: symbol, point)


class System:
    """Earlier equations as rows of coefficients for the unknowns of a new equation."""

    def __init__(
        self,
        wanted: Expr,
        equations: Sequence[Equation],
        meaning: Meaning,
        known: Known,
        letter: Symbol | None,
        rates_only: bool = False,
    ):
        self.wanted, self.meaning, self.known, self.letter, self.rates_only = wanted, meaning, known, letter, rates_only
        self.unknowns = self.choose(equations)
        self.equations: list[Equation] = []
        self.polys: list[Poly] = []
        self.of_wanted = self.poly(wanted)
        if self.of_wanted is None:
            return
        for each in equations:
            if not each.value.free_symbols & set(self.unknowns):
                continue
            poly = self.poly(each.value)
            if poly is not None:
                self.equations.append(each)
                self.polys.append(poly)
        self.connect()

    def choose(self, equations: Sequence[Equation]) -> list[Symbol]:
        if self.rates_only and self.letter is not None:
            both = self.wanted.free_symbols.union(*(each.value.free_symbols for each in equations))
            return sorted({each for each in both if self.known.is_rate(each)} | {self.letter}, key=str)
        letters = self.meaning.symbols
        everywhere = set().union(*(each.value.free_symbols for each in equations)) if equations else set()
        wanted = self.wanted.free_symbols
        found = {
            each
            for each in everywhere
            if each not in wanted or ((letter := letters.get(each)) is not None and letter.dots >= 1)
        }
        rates = {each for each in everywhere if self.known.is_rate(each)}
        for equation in equations:
            for term in sympy.Add.make_args(equation.value) if rates else ():
                if term.free_symbols & rates:  # in a mass times an acceleration, only the acceleration is unknown
                    found -= term.free_symbols - rates
        if self.letter is not None:
            found.add(self.letter)
        if not found & wanted:
            found |= {each for each in wanted if (letter := letters.get(each)) is not None and letter.dots}
        return sorted(found, key=str)

    def poly(self, value: Expr) -> Poly | None:
        inside = [each for each in self.unknowns if each in value.free_symbols]
        if not inside:
            return Poly(value, *self.unknowns) if self.unknowns else None
        try:
            poly = Poly(sympy.expand(value), *self.unknowns)
        except sympy.PolynomialError:
            return None
        return poly if poly.total_degree() <= HIGHEST_POWER else None

    def connect(self) -> None:
        assert self.of_wanted is not None
        reached = {each for each in self.of_wanted.monoms() if any(each)}
        kept: list[int] = []
        grows = True
        while grows:
            grows = False
            for i, poly in enumerate(self.polys):
                monoms = {each for each in poly.monoms() if any(each)}
                if i not in kept and monoms & reached:
                    kept.append(i)
                    reached |= monoms
                    grows = True
        kept = sorted(kept)[:MOST_EQUATIONS]
        self.equations = [self.equations[i] for i in kept]
        self.polys = [self.polys[i] for i in kept]

    @property
    def columns(self) -> list[tuple[int, ...]]:
        assert self.of_wanted is not None
        found = {each for poly in [*self.polys, self.of_wanted] for each in poly.monoms()}
        constant = (0,) * len(self.unknowns)
        return [*sorted(found - {constant}), constant]

    def row(self, poly: Poly, columns: Sequence[tuple[int, ...]], at: Numbers) -> list[complex]:
        values = {monom: at.of(coefficient) for monom, coefficient in poly.terms()}
        return [values.get(each, 0j) for each in columns]

    def consistent(self, columns: Sequence[tuple[int, ...]], at: Numbers) -> list[int]:
        """Return the positions of equations that do not contradict each other; an equation that contradicts earlier
        equations is left out."""
        kept: list[int] = []
        rows: list[list[complex]] = []
        constant = [0j] * (len(columns) - 1) + [1 + 0j]
        for i, poly in enumerate(self.polys):
            row = self.row(poly, columns, at)
            if not spanned([*rows, row], constant):
                rows.append(row)
                kept.append(i)
        return kept

    def follows(self) -> tuple[Equation, ...] | None:
        """Return the equations of which the wanted one is a combination, or None."""
        if self.of_wanted is None or not self.polys:
            return None
        try:
            columns = self.columns
            points = [numbers(self.meaning, self.known, point) for point in range(POINTS)]
            kept = self.consistent(columns, points[0])
            tables = [
                ([self.row(self.polys[i], columns, at) for i in kept], self.row(self.of_wanted, columns, at))
                for at in points
            ]
            if not all(spanned(rows, wanted) for rows, wanted in tables) or self.is_absurd(tables[0][0], columns):
                return None
            needed = list(range(len(kept)))
            for i in reversed(range(len(kept))):
                fewer = [each for each in needed if each != i]
                if all(spanned([rows[j] for j in fewer], wanted) for rows, wanted in tables):
                    needed = fewer
            return tuple(self.equations[kept[i]] for i in needed)
        except FAULTS:
            return None

    def is_absurd(self, rows: Sequence[Sequence[complex]], columns: Sequence[tuple[int, ...]]) -> bool:
        for i, monom in enumerate(columns):
            if sum(monom) == 1 and self.unknowns[monom.index(1)].is_positive:
                if spanned(rows, [complex(j == i) for j in range(len(columns))]):
                    return True
        return False

    def value_of_letter(self) -> list[complex] | None:
        """Return the values of `letter` at the points, or None if the equations do not determine them."""
        if self.of_wanted is None or self.letter is None or not self.polys:
            return None
        monom = tuple(int(each == self.letter) for each in self.unknowns)
        try:
            columns = self.columns
            if monom not in columns:
                return None
            found = []
            for point in range(POINTS):
                at = numbers(self.meaning, self.known, point)
                kept = self.consistent(columns, at)
                value = determined(
                    [self.row(self.polys[i], columns, at) for i in kept], columns.index(monom), len(columns) - 1
                )
                if value is None:
                    return None
                found.append(value)
            return found
        except FAULTS:
            return None
