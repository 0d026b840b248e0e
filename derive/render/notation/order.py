"""The order in which terms and factors are written.

Terms with accelerations and rates come first. The order of factors is in `Place`: for example, masses come before
lengths.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from fractions import Fraction
from typing import Any

from sympy import Add, Expr, Function, Mul, Pow, Rational, Symbol, cos, exp, fraction

from derive.algebra import expressions as ex
from derive.algebra.dimensions import Dimension, power, product
from derive.algebra.kinds import dimension_of_kind
from derive.render.notation.layout import GREEK_LETTERS
from derive.render.notation.products import Place, positive_first, rank_of_dimension, rank_of_sum, roots_last

DISPLACEMENT = "eta"  # the name of a displacement from an equilibrium
RATE_ENDS = ("_ddot", "_dot")  # suffixes of the names of accelerations and of rates
COEFFICIENTS = ("mu", "e", "beta", "gamma", "epsilon")  # the names of coefficients: 1 + beta, beta m g
# A constant in one of these places is printed after other constants, but before a coordinate: omega_0^2 x.
LATE = {(0, place) for place in (Place.SUM, Place.FORCE, Place.RATE)}
ANGULAR_RATE = "omega"
RATE_OF_TURNING = dimension_of_kind("angular speed")


def ordered_terms(expr: Add, moving: Mapping[str, int]) -> list[Expr]:
    """Return the terms of a sum in the order of print.

    moving   name -> index, for all symbols of the notation; a symbol is a coordinate if the mapping contains its rate
    """
    terms = roots_last(expr.as_ordered_terms())
    if expr.has(ex.Amount):  # 0.2 m + 1/2 (0.05 m), like R + a/2
        return positive_first(sorted(terms, key=lambda term: not isinstance(term, ex.Amount)))
    return positive_first(motion_first(powers_descending(plain_first(terms)), moving))


def powers_descending(terms: list[Any]) -> list[Any]:
    """Sort the terms of a polynomial of three or more terms by descending powers of its unknown: m w^2 - b w - k.

    The unknown is the only symbol with the highest power, at least 2. The order is unchanged if there is no such
    symbol, or if two terms have the same power of the unknown. A sum in which the unknown is the time is unchanged,
    too, because a series in time has ascending powers.
    """
    if len(terms) < 3:
        return terms
    powers: list[Any] = [dict(factor.as_base_exp() for factor in Mul.make_args(term)) for term in terms]
    letters = {base for each in powers for base in each if isinstance(base, Symbol)}
    degrees = {letter: [each.get(letter, 0) for each in powers] for letter in letters}
    highest = {
        letter: max(found) for letter, found in degrees.items() if all(n.is_Integer for n in map(Rational, found))
    }
    most = max(highest.values(), default=0)
    unknowns = [letter for letter, power in highest.items() if power == most and power > 1]
    if len(unknowns) != 1 or unknowns == [ex.TIME] or len({*degrees[unknowns[0]]}) < len(terms):
        return terms
    place = dict(zip(terms, degrees[unknowns[0]], strict=True))
    return sorted(terms, key=lambda term: -place[term])


def plain_first(terms: list[Any]) -> list[Any]:
    """Sort terms so that plain terms come first: 1 + cos a, 2 + sqrt(2), l + m g/k, R^2 + a^2 - 2 R a cos a.

    A term with both signs comes last: -beta +- i omega. A displacement from an equilibrium comes last, too: r_0 + eta.
    """

    is_timed = any(term.has(ex.TIME) for term in terms)
    number_first = is_timed or any(_is_coefficient(term.as_base_exp()[0]) for term in terms)

    def place(term: Any) -> tuple[bool, bool, int, bool, bool, bool, bool]:
        functions = [f for f in term.atoms(Function) if not isinstance(f, exp)]
        changing = any(f.has(ex.TIME) for f in functions)
        is_fraction = bool(fraction(term, exact=True)[1].free_symbols)
        is_displacement = isinstance(term, Symbol) and term.name.partition("_")[0] == DISPLACEMENT  # r_0 + eta
        return (
            is_displacement,
            _has_both_signs(term),
            len(functions[:1]) + changing,
            is_fraction,
            _has_root(term),
            number_first and not term.is_number,
            any(_is_coefficient(factor.as_base_exp()[0]) for factor in term.args),  # m_1 + e^2 m_2
        )

    return sorted(terms, key=place)


def _has_both_signs(term: Expr) -> bool:
    return ex.PLUS_MINUS in term.free_symbols


def _has_root(term: Expr) -> bool:
    return any(not power.exp.is_Integer for power in term.atoms(Pow))


def motion_first(terms: list[Any], moving: Mapping[str, int]) -> list[Any]:
    """Sort terms by the order of the coordinates and by powers: first terms with accelerations, then terms with rates.

    Among the other terms, terms with a coordinate whose acceleration the sum contains come first, and constants come
    last: m y_ddot + k y - m g. Without accelerations, quadratic terms come before linear ones:
    x_dot^2 + y_dot^2 + 2 Omega x y_dot. Squares without functions come before other squares:
    theta_dot^2 + phi_dot^2 sin^2 theta.
    """
    rates = sorted(
        {s for term in terms for s in term.free_symbols if _coordinate(s, moving)},
        key=lambda s: (not _is_acceleration(s), moving.get(_coordinate(s, moving), len(moving)), s.name),
    )
    accelerated = [_coordinate(s, moving) for s in rates if _is_acceleration(s)]

    def degrees(term: Any) -> list[Any]:
        powers = {f.as_base_exp()[0]: f.as_base_exp()[1] for f in Mul.make_args(term)}
        return [-powers.get(s, Rational(0)) for s in rates if powers.get(s, Rational(0)).is_Integer]

    def coordinates(term: Any) -> list[str]:
        return [s.name for s in term.free_symbols if f"{s.name}{RATE_ENDS[1]}" in moving]

    def place(term: Any) -> tuple[Any, ...]:
        powers, here = degrees(term), coordinates(term)
        own = min((accelerated.index(q) for q in here if q in accelerated), default=len(accelerated))
        return (
            not accelerated and sum(powers),
            only_squares and term.has(Function),
            *powers,
            not any(term.has(s) for s in rates),
            own,
            not here,
        )

    only_squares = not accelerated and all(n in (0, -2) for term in terms for n in degrees(term))
    if any(isinstance(term, Symbol) and _is_acceleration(term) for term in terms):
        return sorted(terms, key=place)
    # y + 7 x_dot/(2 Omega): a coordinate by itself is first, unless an acceleration is by itself
    alone = [term for term in terms if isinstance(term, Symbol) and f"{term.name}{RATE_ENDS[1]}" in moving]
    return [*alone, *sorted((term for term in terms if term not in alone), key=place)] if rates else terms


def holds_rates(expr: Expr) -> bool:
    return any(s.name.endswith(RATE_ENDS) for s in expr.free_symbols)


def _is_acceleration(letter: Symbol) -> bool:
    return bool(letter.name.endswith(RATE_ENDS[0]))


def _coordinate(letter: Symbol, moving: Collection[str] = ()) -> str:
    """Return the name of the coordinate of a rate, an acceleration or a momentum; an empty string for any other
    symbol."""
    name: str = letter.name
    found = next((name.removesuffix(end) for end in RATE_ENDS if name.endswith(end)), "")
    momentum = name.removeprefix("p_")
    return found or (momentum if momentum != name and f"{momentum}{RATE_ENDS[1]}" in moving else "")


def ordered_factors(
    factors: list[Expr], dimension_of: Callable[[Any], Dimension | None], moving: Collection[str] = ()
) -> list[Expr]:
    """Return the factors of a product in the order of print; `moving` has the names of all symbols, as in
    `ordered_terms`."""
    ranked = sorted(factors, key=lambda f: rank_of_factor(f, dimension_of, moving))
    ordered = _cyclic(_rates_in_order(ranked, dimension_of, moving), dimension_of)
    return _coordinates_last(ordered, dimension_of, moving)


def _rates_in_order(
    factors: list[Expr], dimension_of: Callable[[Any], Dimension | None], moving: Collection[str]
) -> list[Expr]:
    """Write velocities before angular velocities, and both in the order of the coordinates: x_dot theta_dot."""
    rates = [f for f in factors if f.is_Symbol and str(f).endswith(RATE_ENDS)]
    places = {name: place for place, name in enumerate(moving)}

    def place(factor: Expr) -> tuple[bool, int]:
        dimension = dimension_of(factor)
        return bool(dimension is None or not dimension.length), places.get(_coordinate(factor), len(places))

    ordered = iter(sorted(rates, key=place))
    return [next(ordered) if factor in rates else factor for factor in factors]


def _coordinates_last(
    factors: list[Expr], dimension_of: Callable[[Any], Dimension | None], moving: Collection[str]
) -> list[Expr]:
    """Write a coordinate, or a sum with coordinates, after a force, a constant sum or a constant frequency:
    omega_0^2 x, not x omega_0^2."""
    places = [rank_of_factor(factor, dimension_of, moving)[:2] for factor in factors]
    constant = [p == (0, Place.FORCE) or not _moves(f, moving) for f, p in zip(factors, places, strict=True)]
    is_late = [place in LATE and fixed for place, fixed in zip(places, constant, strict=True)]
    last = max((i for i, late in enumerate(is_late) if late), default=0)
    before = [
        f for f, place, fixed in zip(factors[:last], places, constant, strict=False) if not fixed and not place[0]
    ]
    return [*(f for f in factors[: last + 1] if f not in before), *before, *factors[last + 1 :]] if before else factors


def _moves(factor: Expr, moving: Collection[str]) -> bool:
    """Return whether a factor contains a coordinate, a rate or the time."""
    return any(
        s == ex.TIME or s.name.endswith(RATE_ENDS) or f"{s.name}{RATE_ENDS[1]}" in moving for s in factor.free_symbols
    )


def _cyclic(factors: list[Expr], dimension_of: Callable[[Any], Dimension | None]) -> list[Expr]:
    """Write omega_z omega_x, to match omega_x omega_y and omega_y omega_z in the components of a cross product.

    Next to a product of inertia such as I_xz, the rates keep the order of the two axes.
    """
    names = [factor.name if isinstance(factor, Symbol) else "" for factor in factors]
    for i, name in enumerate(names):
        root = name.removesuffix("_x")
        if root == name or f"{root}_z" not in names or any(n.endswith("xz") for n in names):
            continue
        if f"{root}_y" not in names and dimension_of(factors[i]) == RATE_OF_TURNING:
            k = names.index(f"{root}_z")
            factors[i], factors[k] = factors[k], factors[i]
    return factors


def rank_of_factor(
    factor: Expr, dimension_of: Callable[[Any], Dimension | None], moving: Collection[str] = ()
) -> tuple[int, int, int, str]:
    """Return the rank by which factors are sorted: first symbols in the order of `Place`, then functions. A coordinate
    with the name of a coefficient, such as the angle beta, is not a coefficient.

    Functions are in the order of their angles in the Greek alphabet, and the sine of an angle precedes its cosine:
    sin(alpha) cos(alpha) sin(beta).
    """
    is_root = isinstance(factor, ex.Root) or isinstance(factor, Pow) and factor.exp.is_Rational and factor.exp.q == 2
    base = factor.base if isinstance(factor, Pow) else factor
    if is_root and not base.has(Function):
        return 0, Place.ROOT, 0, str(factor)
    if isinstance(base, Symbol | ex.Amount):
        if isinstance(base, Symbol) and (base.name.endswith(RATE_ENDS) or base == ex.TIME):
            return 0, Place.CHANGING, 0, str(base)
        is_bare = str(base) == ANGULAR_RATE  # 2 omega_0 omega, because omega is the rate that varies
        place = rank_of_dimension(dimension_of(base)) if _moves(base, moving) else _place_of_letter(base, dimension_of)
        return 0, place, 0 if is_bare else -1, str(base)
    if isinstance(base, exp):
        return 0, Place.EXPONENTIAL, 1, str(factor)
    if isinstance(base, Add | ex.Terms):
        place = rank_of_sum(_place_of_term(term, dimension_of) for term in base.args)
        if place is Place.ACCELERATION and not all(term.as_coeff_Mul()[1].is_Symbol for term in base.args):
            place = Place.SUM  # m (a + g) l, but l (g + l omega^2)
        if place is Place.SUM and base.has(Function):
            place = Place.EXPONENTIAL if base.has(ex.TIME) else Place.SWINGING
        if all(f.is_number or _is_coefficient(f.as_base_exp()[0]) for term in base.args for f in Mul.make_args(term)):
            place = Place.COEFFICIENT  # (1 + e) m v
        return 0, place, 2 if base.has(Function, ex.TIME) else 0, str(factor)  # e^(-t/T) (cos w t + ...)
    if isinstance(base, Function) and isinstance(base.args[0], Symbol):
        return 1, _greek_place(base.args[0]), isinstance(base, cos), str(factor)
    return 2 if isinstance(base, ex.Group) else 1, len(GREEK_LETTERS), 0, str(factor)


def _greek_place(letter: Symbol) -> int:
    names = list(GREEK_LETTERS)
    name = letter.name.partition("_")[0]
    return names.index(name) if name in names else -1


def _place_of_letter(letter: Expr, dimension_of: Callable[[Any], Dimension | None]) -> Place:
    dimension = dimension_of(letter)
    is_coefficient = _is_coefficient(letter) and dimension is not None and dimension.is_number
    return Place.COEFFICIENT if is_coefficient else rank_of_dimension(dimension)


def _is_coefficient(letter: Any) -> bool:
    return isinstance(letter, Symbol) and letter.name.partition("_")[0] in COEFFICIENTS


def _place_of_term(term: Expr, dimension_of: Callable[[Any], Dimension | None]) -> Place:
    """Return the `Place` of a product by its dimension."""
    found = [factor.as_base_exp() for factor in Mul.make_args(term)]
    powers = [(letter, n) for letter, n in found if isinstance(letter, Symbol | ex.Amount) and n.is_Rational]
    dimensions = [(dimension_of(letter), n) for letter, n in powers]
    whole = product(power(dimension, Fraction(int(n.p), int(n.q))) for dimension, n in dimensions)
    return rank_of_dimension(whole)
