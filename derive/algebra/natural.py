"""An expression written with named quantities: l/(m r_0^2) for G^2 M^2 m^3/l^3 with r_0 = l^2/(G M m^2).

A named quantity eliminates one symbol of its formula. Several choices of quantities and of eliminated symbols are
tried, and the shortest form is kept. Its length is the number of operations (`length`), plus two for each of its
symbols.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, product
from typing import Any

from sympy import (
    Abs,
    Add,
    Dummy,
    Expr,
    Function,
    I,
    Integer,
    Mul,
    Poly,
    Pow,
    Rational,
    Symbol,
    acos,
    asin,
    atan,
    cancel,
    cos,
    factor_terms,
    fraction,
    igcd,
    sin,
    sqrt,
    tan,
    together,
)
from sympy import pi as _PI
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.expressions import Relation
from derive.algebra.length import length
from derive.algebra.ranges import Range, sign_within, within
from derive.algebra.relation import TURNED
from derive.algebra.tidy import common_factor, tidied

MOST_TOGETHER = 3  # greatest number of quantities that one form may use
SIGNS_OF_A_SYMBOL = 2  # a symbol counts as much as this number of operations
HALF = Rational(1, 2)
LONGEST = 120  # an expression that is longer than this (`_size`) is not rewritten
INVERSES = {acos: cos, asin: sin, atan: tan}


@dataclass(frozen=True)
class Shortened:
    """A shorter form of a value.

    value    the shorter form itself
    used     the symbols of the quantities that the shorter form contains
    nonzero  the factors by which an equation was divided
    """

    value: Any
    used: tuple[Symbol, ...]
    nonzero: tuple[Expr, ...] = ()


def shortened(
    value: Any, quantities: Mapping[Symbol, Expr], kept: Collection[Symbol] = (), only_whole: bool = False
) -> Shortened | None:
    """Replace symbols of an expression or a relation by quantities, and return the shortest form that is found; None if
    no form is shorter.

    quantities   symbol -> its value in other symbols
    kept         symbols that must not be eliminated, such as the coordinates
    only_whole   whether a quantity replaces only its whole formula
    """
    if not isinstance(value, Expr | Relation) or _size(value) > LONGEST:
        return None
    names = {_with_sign(name, known): name for name, known in quantities.items()}
    real = {part: _stand_in("u", part, True) for known in quantities.values() for part in _functions_under_roots(known)}
    named = {dummy: part for part, dummy in real.items()}
    near = {
        dummy: quantities[name].xreplace(real)
        for dummy, name in names.items()
        if quantities[name].free_symbols & value.free_symbols
    }
    kept, least, best = {*kept, *named}, _cost(value), None
    value = value.xreplace(real)
    for some in _some_of(near):
        chosen = {name: near[name] for name in some}
        # a whole formula, such as the formula of a reduced mass, may also be replaced by its quantity
        whole = {value: name for name, value in chosen.items() if not value.free_symbols & set(kept)}
        others = () if only_whole else _eliminations(chosen, kept)
        eliminations = (each for each in others if _brings(each, value, chosen))
        for known in (whole, *eliminations):
            form = _with(value, known, chosen, kept)
            cost = _cost(form.value.xreplace(named))
            if cost < least and _is_natural(form.value, chosen) and not _differ_in(form.value, value, Abs, I):
                best, least = form, cost
    return best and Shortened(
        best.value.xreplace({**names, **named}),
        tuple(map(names.get, best.used)),
        tuple(factor.xreplace(named) for factor in best.nonzero),
    )


def _differ_in(form: Any, value: Any, *signs: Any) -> bool:
    return any(form.has(sign) != value.has(sign) for sign in signs)


def _brings(known: Mapping[Symbol, Expr], value: Any, quantities: Mapping[Symbol, Expr]) -> bool:
    """Whether the substitution can bring every quantity into the value."""
    names = {name for symbol in known.keys() & value.free_symbols for name in known[symbol].free_symbols}
    return {*quantities} <= names | {*value.free_symbols}


def _is_natural(form: Any, quantities: Mapping[Symbol, Expr]) -> bool:
    """Whether a form contains each quantity, and has no sum in which one term is a quantity and another term
    is a symbol of its formula.

    If r_0 = l + m g/k, the difference r_0 - l is not more natural than m g/k.
    """
    if not quantities.keys() <= form.free_symbols:
        return False
    sums = [{term.as_coeff_Mul()[1] for term in each.args} for each in form.atoms(Add)]
    return not any(name in terms and terms & value.free_symbols for name, value in quantities.items() for terms in sums)


def _with_sign(name: Symbol, value: Expr) -> Symbol:
    return _stand_in(name.name, value, is_positive(value))


@lru_cache(maxsize=1024)
def _stand_in(name: str, value: Expr, positive: bool) -> Dummy:
    return Dummy(name, positive=True) if positive else Dummy(name, real=True)


def is_positive(value: Expr) -> bool:
    others = [factor for factor in Mul.make_args(value) if sign_within(factor) != 1]
    return not others or len(others) == 1 and others[0].is_Pow and others[0].exp == HALF


def _functions_under_roots(value: Expr) -> Iterator[Expr]:
    """Yield sin(beta) for sqrt(g sin(beta)/h): this factor is positive wherever the value is real and not zero."""
    if is_positive(value):
        roots = (factor for factor in Mul.make_args(value) if factor.is_Pow and factor.exp in (HALF, -HALF))
        bases = (root.base for root in roots if sign_within(root.base) != 1)
        yield from (base for base in bases if isinstance(base, Function))


def _some_of(names: Mapping[Symbol, Expr]) -> Iterator[tuple[Symbol, ...]]:
    for count in range(1, MOST_TOGETHER + 1):
        yield from combinations(names, count)


def _eliminations(quantities: Mapping[Symbol, Expr], kept: Collection[Symbol]) -> Iterator[dict[Symbol, Expr]]:
    """Yield a mapping, eliminated symbol -> its value, for each choice of one symbol for each quantity."""
    choices = [_solutions(name, value, frozenset(kept)) for name, value in quantities.items()]
    for choice in product(*choices):
        found = _solved_together(choice)
        if found is not None:
            yield found


@lru_cache(maxsize=4096)
def _solutions(name: Symbol, value: Expr, kept: frozenset[Symbol]) -> tuple[tuple[Symbol, Expr], ...]:
    """Return the symbols, except those in `kept`, for which the equation name = formula can be solved, each with its
    value."""
    left, right = name, value
    for sign in (1, -1):
        if function := INVERSES.get(type(sign * value)):
            left, right = function(sign * name), (sign * value).args[0]
    solved = ((symbol, _solved(left, right, symbol)) for symbol in sorted(value.free_symbols - kept, key=str))
    return tuple((symbol, found) for symbol, found in solved if found is not None)


def _solved(left: Expr, right: Expr, symbol: Symbol) -> Expr | None:
    """Solve left = right for a symbol; None if no unique solution is found."""
    order = _order_of_root(right, symbol)
    above, below = fraction(together(cancel(right**order)))
    try:
        equation = Poly(above - left**order * below, symbol)
    except PolynomialError:
        return None
    if equation.degree() < 1 or any(c.has(symbol) for c in equation.all_coeffs()):
        return None
    if equation.degree() == 1:
        return cancel(-equation.nth(0) / equation.nth(1))
    terms = {power for (power,) in equation.monoms()}
    if terms == {0, equation.degree()} and symbol.is_positive:
        return Pow(cancel(-equation.nth(0) / equation.LC()), Rational(1, equation.degree()))
    return None


def _order_of_root(value: Expr, symbol: Symbol) -> int:
    roots = {f.exp.q for f in Mul.make_args(value) if f.is_Pow and f.exp.is_Rational and f.has(symbol)} - {1}
    return int(next(iter(roots))) if len(roots) == 1 else 1


def _solved_together(choice: Sequence[tuple[Symbol, Expr]]) -> dict[Symbol, Expr] | None:
    """Substitute the solutions into each other; None if two of them are for the same symbol, or if a symbol then
    depends on itself."""
    found: dict[Symbol, Expr] = {}
    for symbol, value in choice:
        value = value.subs(found)
        if symbol in found or value.has(symbol):
            return None
        found = {other: known.subs(symbol, value) for other, known in found.items()} | {symbol: value}
    gone = set(found)
    return None if any(known.free_symbols & gone for known in found.values()) else found


def _with(
    value: Any, known: Mapping[Expr, Expr], quantities: Mapping[Symbol, Expr], kept: Collection[Symbol]
) -> Shortened:
    with within(_ranges(quantities)):
        if isinstance(value, Relation):
            return _relation(value, known, quantities, is_motion=not value.free_symbols.isdisjoint(kept))
        return Shortened(_written(value, known), tuple(quantities))


def compared(left: Expr, mark: str, right: Expr, takes_roots: bool = True) -> Relation:
    """Divide both sides by positive common factors; exchange the sides if only the left side is a number. If both sides
    are squares of positive expressions and `takes_roots` is true, write gamma < omega_0, not 4 gamma^2 < 4 omega_0^2.
    """
    shared = common_factor([left, right])
    if shared.is_positive:
        left, right = tidied(left / shared), tidied(right / shared)
    numbers = [side.as_coeff_Mul()[0] for side in (left, right)]
    common = igcd(*(n.p for n in numbers)) if all(n.is_Integer for n in numbers) else 1
    left, right = left / common, right / common
    if left.is_number and not right.is_number:
        left, mark, right = right, TURNED[mark], left
    roots = [tidied(sqrt(side)) for side in (left, right)]
    plain = takes_roots and all(root.is_rational_function() and root.is_positive for root in roots)
    return Relation(roots[0], mark, roots[1]) if plain else Relation(left, mark, right)


def _relation(
    value: Relation, known: Mapping[Expr, Expr], quantities: Mapping[Symbol, Expr], is_motion: bool
) -> Shortened:
    """Rewrite a relation. In an equation for a symbol that is neither replaced nor on the right side, rewrite only the
    right side.

    In any other relation, rewrite both sides. Divide by common factors if the right side of an equation is zero, or if
    both sides of a relation are nonzero. Do not divide an equation of motion with two nonzero sides.
    """
    used = tuple(quantities)
    if value.operator == "=" and value.left.is_Symbol and value.left not in {*known, *value.right.free_symbols}:
        return Shortened(Relation(value.left, "=", _written(value.right, known)), used)
    left, right = (Add(*(_written(term, known) for term in Add.make_args(side))) for side in (value.left, value.right))
    if not (is_motion and value.operator == "=") and left != 0 and right != 0:
        # False if a dummy symbol stands for a function that is only assumed to be positive
        is_sure = not any(formula.atoms(Dummy) for formula in quantities.values())
        return Shortened(compared(left, value.operator, right, is_sure), used)
    if value.operator != "=" or right != 0:
        return Shortened(Relation(left, value.operator, right), used)
    left = factor_terms(left) if left.is_Mul else left
    factors = Mul.make_args(factor_terms(left))
    front = [f for f in factors if f.is_positive and (f.is_Symbol or f.is_Pow or f.is_Rational)]
    front = [f for f in front if all(Mul(*(o for o in factors if o != f)).has(s) for s in f.free_symbols & {*used})]
    divided = Add(*(term / Mul(*front) for term in Add.make_args(left)))
    return Shortened(Relation(divided, "=", Integer(0)), used, tuple(f for f in front if not f.is_Rational))


def _written(value: Expr, known: Mapping[Expr, Expr]) -> Expr:
    """Substitute, and return a short form of the result."""
    put_in = value.replace(lambda part: part.is_Mul, lambda part: _with_factors_replaced(part, known)).subs(known)
    if put_in == value:
        return value
    powers = [factor.as_base_exp() for factor in Mul.make_args(value)]
    if len([base for base, n in powers if base.is_Add and n.is_Integer and n.is_positive]) > 1:
        return Mul(*(_written(factor, known) for factor in Mul.make_args(value)))
    kept = put_in.replace(_is_root, lambda root: Pow(_in_lowest_terms(root.base), root.exp))
    kept = kept.replace(lambda part: isinstance(part, Function), lambda part: part.func(*map(tidied, part.args)))
    by_terms = Add(*map(tidied, Add.make_args(kept.expand(func=False)))) if value.is_Add else kept
    if value.is_Add and len(Add.make_args(by_terms)) <= len(value.args):
        return by_terms
    return min((kept, tidied(kept), factor_terms(kept)), key=_cost)


def _with_factors_replaced(product: Expr, known: Mapping[Expr, Expr]) -> Expr:
    """Write m_1 m_2 v^2/(2 (m_1 + m_2)) as mu v^2/2; `subs` does not find the factors of mu there."""
    plain = product.replace(lambda part: part.is_Add, lambda part: Mul(*part.primitive(), evaluate=False))
    powers = plain.as_powers_dict()
    for whole, name in known.items():
        needed = whole.as_powers_dict() if whole.is_Mul else {}
        if needed and all(powers.get(base) == power for base, power in needed.items()):
            return Mul(*(base**power for base, power in powers.items() if base not in needed), name)
    return product


@lru_cache(maxsize=4096)  # the forms that are compared have most of their radicands in common
def _in_lowest_terms(radicand: Expr) -> Expr:
    return factor_terms(cancel(radicand))


def _is_root(value: Expr) -> bool:
    return value.is_Pow and value.exp.is_Rational and not value.exp.is_Integer and value.base.is_Add | value.base.is_Mul


def _ranges(quantities: Mapping[Symbol, Expr]) -> dict[Symbol, Range]:
    """The ranges of those angles whose formula is an inverse trigonometric function."""
    found = {}
    for name, value in quantities.items():
        if isinstance(value, acos):
            found[name] = Range(Integer(0), _PI)
        elif isinstance(-value, acos):
            found[name] = Range(-_PI, Integer(0))
        elif isinstance(value, asin | atan):
            found[name] = Range(-_PI / 2, _PI / 2)
    return found


def _size(value: Any) -> int:
    sides = (value.left, value.right) if isinstance(value, Relation) else (value,)
    return sum(length(side.replace(lambda part: part.is_Mul, _under_one_root)) for side in sides)


def _under_one_root(value: Expr) -> Expr:
    """Write the square roots of a product as one root, as pages do."""
    roots = [f for f in value.args if f.is_Pow and f.exp in (HALF, -HALF)]
    if len(roots) < 2:
        return value
    inside = Mul(*(f.base ** (2 * f.exp) for f in roots))
    return Mul(*(f for f in value.args if f not in roots), Pow(inside, HALF, evaluate=False), evaluate=False)


def _cost(value: Any) -> tuple[int, int]:
    """The length with the symbols counted, and the number of symbols, which decides between equal lengths."""
    symbols = len(value.free_symbols)
    return _size(value) + SIGNS_OF_A_SYMBOL * symbols, symbols
