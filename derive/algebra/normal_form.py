"""Whether an expression is zero, decided exactly.

Sines and cosines, roots, absolute values and other functions become generators of a polynomial ring with the relations
they satisfy; the numerator is then reduced modulo these.

Sources: Cox, Little, O'Shea, *Ideals, Varieties, and Algorithms*, ch. 2 (normal forms modulo relations).
"""

from __future__ import annotations

from functools import lru_cache
from math import comb, prod
from typing import Any

from sympy import (
    Abs,
    Derivative,
    Dummy,
    Expr,
    I,
    Integer,
    Mul,
    Pow,
    Rational,
    S,
    Symbol,
    cos,
    expand_trig,
    factor_list,
    igcd,
    ilcm,
    nan,
    oo,
    sin,
    sqrt,
    sqrtdenest,
    tan,
    together,
    zoo,
)
from sympy.core.function import AppliedUndef
from sympy.polys.polyerrors import PolynomialError
from sympy.polys.rings import sring

from derive.algebra import trig_polynomials
from derive.algebra.expressions import PLUS_MINUS, explicit
from derive.algebra.ranges import settled
from derive.algebra.samples import is_zero_everywhere

LARGEST = 4000  # operations; beyond this an expression is sampled, not expanded
TERMS = 50_000  # that it may have when it is multiplied out
HIGHEST = 500  # power, and multiple of an angle
PRIMES = 2**15  # up to which a number under a root is factored


def vanishes(expr: Expr) -> bool:
    """Whether the expression is zero, decided exactly; False means "not shown", never "not zero"."""
    expr = settled(explicit(expr))
    if expr == 0:
        return True
    if not isinstance(expr, Expr) or expr.has(nan, zoo, oo, -oo):
        return False
    try:
        return trig_polynomials.is_zero(expr)
    except trig_polynomials.Outside:
        return not _is_too_large(expr) and _vanishes_by_relations(expr)


def is_identity(left: Expr, right: Expr) -> bool:
    """Whether two expressions are one polynomial in letters, sines and cosines; False means "not shown"."""
    try:
        return trig_polynomials.are_equal(left, right)
    except trig_polynomials.Outside:
        return False


def _vanishes_by_relations(expr: Expr) -> bool:
    """The same for all that is not a polynomial in letters, sines and cosines."""
    if expr.is_rational_function() and expr.expand() == 0:
        return True
    try:
        return _vanishes_as_polynomial(expr)
    except (PolynomialError, NotImplementedError, ZeroDivisionError, ValueError):  # no polynomial, too high, or 0/0
        return False


@lru_cache(maxsize=4096, typed=True)  # what a verb decides, the door and the words decide again
def _vanishes_as_polynomial(expr: Expr) -> bool:
    tower = _Tower()
    numerator = _numerator(tower.polynomial_in_generators(expr))
    return tower.reduces_to_zero(numerator) and not any(tower.is_zero(divisor) for divisor in tower.divisors)


def _is_too_large(expr: Expr) -> bool:
    """Whether it would take long to multiply out: too many operations, terms, or too high a power."""
    if expr.count_ops() > LARGEST:
        return True
    powers = (abs(power.exp) for power in expr.atoms(Pow) if power.exp.is_Rational)
    return any(power > HIGHEST for power in powers) or _terms(expr) > TERMS


def _terms(expr: Expr) -> int:
    """How many terms there are at most once everything is multiplied out, also below and under roots."""
    if expr.is_Add:
        return sum(map(_terms, expr.args))
    if expr.is_Mul:
        return prod(map(_terms, expr.args))
    if isinstance(expr, Pow) and expr.exp.is_Rational:
        n = int(abs(expr.exp)) + 1 - bool(expr.exp.is_Integer)
        return comb(_terms(expr.base) + n - 1, n) if expr.base.is_Add else n if isinstance(expr.base, sin) else 1
    return 1


class _Tower:
    """Generators that stand for functions and roots, with the relation each one satisfies.

    A relation is stored as (generator, power, what that power equals), later ones possibly in terms of earlier ones:
    s^2 = 1 - c^2 for a sine, r^q = p for a root. Reducing from the last to the first gives a normal form.
    """

    def __init__(self) -> None:
        self.divisors: dict[Expr, Expr] = {}  # what is divided by, and what it is in the generators
        self._known: dict[Expr, Expr] = {}
        self._relations: list[tuple[Symbol, int, Expr]] = []

    def polynomial_in_generators(self, expr: Expr) -> Expr:
        expr = expr.replace(lambda e: isinstance(e, tan), lambda e: sin(e.args[0]) / cos(e.args[0]))
        expr = _with_common_angles(expr)
        if expr.has(nan, zoo):
            raise ZeroDivisionError("a divisor is zero once angles are written alike")
        return self._walk(expr)

    def _walk(self, expr: Expr) -> Expr:
        if expr in self._known:
            return self._known[expr]
        if expr == PLUS_MINUS:
            return self._generator(expr, 2, Integer(1))
        if expr.is_Rational or isinstance(expr, Symbol):
            return expr
        if isinstance(expr, Pow) and expr.exp.is_Rational and not expr.exp.is_Integer:
            return self._root(expr.base, expr.exp)
        if isinstance(expr, Pow) and expr.exp.is_Integer:
            return self._power(expr.base, int(expr.exp))
        if expr.is_Add or expr.is_Mul:
            return expr.func(*(self._walk(arg) for arg in expr.args))
        if expr is I or expr is S.ImaginaryUnit:
            return self._generator(expr, 2, Integer(-1))
        if isinstance(expr, sin | cos):
            return self._circular(expr)
        if isinstance(expr, Abs) and all(part.is_real for part in expr.args[0].as_numer_denom()):
            return self._absolute(expr.args[0])
        return self._opaque(expr)

    def _power(self, base: Expr, n: int) -> Expr:
        walked = self._walk(base)
        if n < 0:
            self.divisors[base] = walked
        return walked**n

    def is_zero(self, divisor: Expr) -> bool:
        """Whether what is divided by is zero everywhere, so that a quotient of normal form 0 is 0/0."""
        if isinstance(divisor, Symbol):
            return False
        everywhere = is_zero_everywhere(divisor)
        return self.reduces_to_zero(_numerator(self.divisors[divisor])) if everywhere is None else everywhere

    def _generator(self, expr: Expr, power: int = 0, equals: Expr = S.Zero) -> Symbol:
        generator = Dummy(f"g{len(self._known)}")
        self._known[expr] = generator
        if power:
            self._relations.append((generator, power, equals))
        return generator

    def _circular(self, expr: Expr) -> Expr:
        angle = expr.args[0]
        cosine = self._known.get(cos(angle)) or self._generator(cos(angle))
        if sin(angle) not in self._known:
            self._generator(sin(angle), 2, 1 - cosine**2)
        return self._known[expr]

    def _absolute(self, inside: Expr) -> Expr:
        """|p| as a product over irreducible factors f: f itself where its sign is known, else g with g^2 = f^2."""
        result: Expr = Integer(1)
        numerator, denominator = together(inside).as_numer_denom()
        for part, sign in ((numerator, 1), (denominator, -1)):
            for factor, power in _irreducible(part):
                factor = -factor if factor.could_extract_minus_sign() else factor
                if factor.is_nonnegative:
                    result *= self._power(factor, sign * power)
                    continue
                key = Abs(factor, evaluate=False)
                generator = self._known.get(key)
                if generator is None:
                    square = self._walk(factor) ** 2
                    generator = self._generator(key, 2, square)
                if sign < 0:
                    self.divisors[factor] = self._walk(factor)
                result *= generator ** (sign * power)
        return result

    def _opaque(self, expr: Expr) -> Expr:
        """A function we know nothing of: equal arguments give equal values, and that is all."""
        for known, generator in self._known.items():
            same_kind = known.func == expr.func and len(known.args) == len(expr.args) and known.args
            if same_kind and not isinstance(expr, AppliedUndef | Derivative):
                if all(_agree(a, b) for a, b in zip(known.args, expr.args, strict=True)):
                    return generator
        return self._generator(expr)

    def _root(self, base: Expr, exponent: Rational) -> Expr:
        """p^(n/q) as a product of roots of irreducible factors, so that sqrt(6) is sqrt(2) sqrt(3)."""
        q = exponent.q
        denested = _denested(base) if q == 2 and base.is_number and base.has(Pow) else None
        if denested is not None:
            return self._power(denested, int(exponent.p))
        result: Expr = Integer(1)
        for factor, power in _factors_under_a_root(base, q):
            whole, rest = divmod(power * exponent.p, q)
            result *= self._power(factor, whole)
            if rest:
                key = Pow(factor, Rational(1, q), evaluate=False)
                generator = self._known.get(key)
                if generator is None:
                    inner = self._walk(factor)
                    generator = self._generator(key, q, inner)
                result *= generator**rest
        return result

    def reduces_to_zero(self, numerator: Expr) -> bool:
        """Reduce modulo the relations, last generator first, all in one polynomial ring."""
        ring, (element, *equals) = sring([numerator, *(equal for _, _, equal in self._relations)])
        for (generator, power, _), equal in reversed(list(zip(self._relations, equals, strict=True))):
            if generator in ring.symbols:
                element = _power_replaced(element, ring.symbols.index(generator), power, equal)
            if element == 0:
                return True
        return bool(element == 0)


def _agree(a: Any, b: Any) -> bool:
    """Whether two arguments of a function are the same; what is no expression, such as a piece of a `Piecewise`, is
    so only if it is written alike."""
    return bool(a == b) or (isinstance(a, Expr) and isinstance(b, Expr) and vanishes(a - b))


def _denested(base: Expr) -> Expr | None:
    """The number of square root sqrt(2) + sqrt(3) for 5 + 2 sqrt(6): its square is the base and it is not negative."""
    found = sqrtdenest(sqrt(base))
    if isinstance(found, Pow) or found.is_nonnegative is not True:
        return None
    return found if (found**2).expand() == base.expand() else None


def _power_replaced(element: Any, index: int, power: int, equal: Any) -> Any:
    """A polynomial with g^power replaced by what it equals, wherever it occurs."""
    total: dict[int, Any] = {}
    for monomial, coefficient in element.terms():
        whole, rest = divmod(monomial[index], power)
        lowered = monomial[:index] + (rest,) + monomial[index + 1 :]
        part = total.setdefault(whole, {})
        part[lowered] = part.get(lowered, 0) + coefficient
    parts = [element.ring.from_dict(part) * equal**whole for whole, part in total.items()]
    return sum(parts, element.ring.zero)


def _numerator(expr: Expr) -> Expr:
    """What must vanish: the numerator over a common denominator, or the whole where nothing is divided by."""
    if all(power.exp.is_nonnegative for power in expr.atoms(Pow)):
        return expr
    return together(expr).as_numer_denom()[0]


def _factors_under_a_root(base: Expr, q: int) -> list[tuple[Expr, int]]:
    """Irreducible factors of the radicand with their powers.

    Only factors that are known to be non-negative may leave a common root; the others stay together.
    """
    numerator, denominator = together(base).as_numer_denom()
    found: list[tuple[Expr, int]] = []
    unsure: Expr = Integer(1)
    for part, sign in ((numerator, 1), (denominator, -1)):
        for factor, power in _irreducible(part):
            if factor.is_nonnegative:
                found.append((factor, sign * power))
            elif q == 2 and factor.is_real and power > 1:
                found.append((Abs(factor), sign * (power - power % 2)))
                unsure *= factor ** (sign * (power % 2))
            else:
                unsure *= factor ** (sign * power)
    if unsure != 1:
        found.append((unsure, 1))
    return found


def _irreducible(part: Expr) -> list[tuple[Expr, int]]:
    if part.is_Integer:
        return _prime_factors(part)
    if part.is_number:
        return [(part, 1)]
    content, factors = factor_list(part)
    found = [(factor, int(power)) for factor, power in factors]
    return _prime_factors(content) + found


def _prime_factors(number: Expr) -> list[tuple[Expr, int]]:
    if not number.is_Rational:
        return [(number, 1)]
    from sympy import factorint

    sign: list[tuple[Expr, int]] = [(Integer(-1), 1)] if number < 0 else []
    primes = {**factorint(abs(number.p), limit=PRIMES), **{p: -e for p, e in factorint(number.q, limit=PRIMES).items()}}
    return sign + [(Integer(p), e) for p, e in primes.items() if p != 1]


def _with_common_angles(expr: Expr) -> Expr:
    """Sines and cosines of sums and multiples, written in those of the smallest angles that occur."""
    functions = expr.atoms(sin, cos)
    if not functions:
        return expr
    units = _smallest_angles(functions)
    replaced = {}
    for function in functions:
        terms = [_as_multiple(term, units) for term in _angle_terms(function.args[0])]
        inner = sum((n * unit for n, unit in terms), Integer(0))
        replaced[function] = expand_trig(function.func(inner))
    expanded = expr.xreplace(replaced)
    return expanded.xreplace({dummy: angle for angle, dummy in units.values()})


def _angle_terms(angle: Expr) -> list[tuple[Rational, Expr]]:
    return [term.as_coeff_Mul(rational=True) for term in angle.expand().as_ordered_terms()]


def _smallest_angles(functions: set[Any]) -> dict[Expr, tuple[Expr, Symbol]]:
    """For each angle up to a rational factor, the largest angle of which all that occur are whole multiples."""
    found: dict[Expr, list[Rational]] = {}
    for function in functions:
        for coefficient, rest in _angle_terms(function.args[0]):
            found.setdefault(rest, []).append(coefficient)
    units = {}
    for rest, coefficients in found.items():
        denominator = ilcm(1, *(c.q for c in coefficients))
        numerator = igcd(0, *(c.p * (denominator // c.q) for c in coefficients)) or 1
        units[rest] = (Mul(Rational(numerator, denominator), rest), Dummy("angle", real=True))
    return units


def _as_multiple(term: tuple[Rational, Expr], units: dict[Expr, tuple[Expr, Symbol]]) -> tuple[Integer, Expr]:
    coefficient, rest = term
    angle, dummy = units[rest]
    multiple = Integer(coefficient / angle.as_coeff_Mul(rational=True)[0])
    if abs(multiple) > HIGHEST:
        raise PolynomialError(f"{multiple} times an angle is too high a multiple to be written out")
    return multiple, dummy
