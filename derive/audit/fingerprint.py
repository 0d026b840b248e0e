"""The values of expressions at a few fixed points. Different values show quickly that two expressions are not equal.

At each point, the number of a letter depends only on the letter's name, so the values of an expression can be cached.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable
from functools import lru_cache, partial
from hashlib import blake2b
from math import prod

import sympy
from sympy import Expr, Symbol

POINTS = 3
CLOSE = 1e-7
SMALL = 1e-12


@lru_cache(maxsize=20_000)
def number_of(name: str, point: int) -> float:
    """Return the number of a letter at a point."""
    digest = blake2b(f"{name}|{point}".encode(), digest_size=6).digest()
    if name == "±":
        return 1.0 if point % 2 else -1.0
    return 0.4 + 1.6 * int.from_bytes(digest, "big") / 2**48


FUNCTIONS: dict[type, Callable[[complex], complex]] = {
    sympy.sin: cmath.sin, sympy.cos: cmath.cos, sympy.tan: cmath.tan, sympy.exp: cmath.exp, sympy.log: cmath.log,
    sympy.sinh: cmath.sinh, sympy.cosh: cmath.cosh, sympy.tanh: cmath.tanh, sympy.asin: cmath.asin,
    sympy.acos: cmath.acos, sympy.atan: cmath.atan, sympy.asinh: cmath.asinh, sympy.acosh: cmath.acosh,
    sympy.atanh: cmath.atanh, sympy.Abs: lambda z: complex(abs(z)),
    sympy.cot: lambda z: 1 / cmath.tan(z), sympy.sec: lambda z: 1 / cmath.cos(z), sympy.csc: lambda z: 1 / cmath.sin(z),
}  # fmt: skip


@lru_cache(maxsize=20_000)
def fingerprint(value: Expr) -> tuple[complex, ...] | None:
    """Return the values of an expression at the fixed points, or None if they cannot be computed."""
    try:
        return tuple(at(value, partial(_number_at, point)) for point in range(POINTS))
    except (ValueError, ZeroDivisionError, OverflowError, KeyError, TypeError):
        return None


def _number_at(point: int, letter: Symbol) -> complex:
    return number_of(letter.name, point)


Number = Callable[[Symbol], complex]  # returns the number of a letter


def at(value: Expr, number: Number) -> complex:
    """Return the value of an expression; `number` returns the number of each letter."""
    return program(value)(number)


def size_at(value: Expr, number: Number) -> float:
    """Return the value of an expression in which each factor, and each term of a sum, is replaced by its absolute
    value."""
    return size_program(value)(number)


@lru_cache(maxsize=4000)
def program(value: Expr) -> Callable[[Number], complex]:
    """Return a function that computes the number of an expression much faster than SymPy does."""
    return _program(value)


@lru_cache(maxsize=4000)
def size_program(value: Expr) -> Callable[[Number], float]:
    return _size_program(value)


def _program(value: Expr) -> Callable[[Number], complex]:
    if value.is_Symbol:
        return lambda number: number(value)
    if value.is_Number or value.is_NumberSymbol or value is sympy.I:
        constant = complex(value)
        return lambda number: constant
    parts = [_program(each) for each in value.args]
    if value.is_Add:
        return lambda number: sum((part(number) for part in parts), 0j)
    if value.is_Mul:
        return lambda number: prod((part(number) for part in parts), start=1 + 0j)
    if value.is_Pow:
        base, exponent = parts
        if value.exp.is_Integer:
            power = int(value.exp)
            return lambda number: complex(base(number) ** power)
        return lambda number: complex(base(number) ** exponent(number))
    function, argument = FUNCTIONS[value.func], parts[0]
    return lambda number: function(argument(number))


def _size_program(value: Expr) -> Callable[[Number], float]:
    if value.is_Add or value.is_Mul:
        parts, join = [_size_program(each) for each in value.args], sum if value.is_Add else prod
        return lambda number: join(part(number) for part in parts)
    inner = _program(value)
    return lambda number: abs(inner(number))


def is_zero(value: Expr) -> bool:
    """Whether an expression vanishes at all fixed points."""
    numbers = fingerprint(value)
    if numbers is None:
        return False
    sizes = [size_at(value, partial(_number_at, point)) for point in range(POINTS)]
    return all(abs(each) <= SMALL * size for each, size in zip(numbers, sizes, strict=True))


def differ(left: Expr, right: Expr) -> bool | None:
    """Whether two expressions certainly differ; None if their values do not show it."""
    one, other = fingerprint(left), fingerprint(right)
    if one is None or other is None:
        return None
    return any(abs(a - b) > CLOSE * max(abs(a), abs(b), 1e-12) for a, b in zip(one, other, strict=True)) or None
