"""Mass, length, time and electric current: the dimensions of quantities, their products and powers."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache, reduce
from operator import mul


@dataclass(frozen=True)
class Dimension:
    """Exponents of mass, length, time and current: `M L^2 T^-2` is `Dimension(1, 2, -2)`."""

    mass: Fraction = Fraction(0)
    length: Fraction = Fraction(0)
    time: Fraction = Fraction(0)
    current: Fraction = Fraction(0)

    @cached_property
    def _hash(self) -> int:
        return hash((self.mass, self.length, self.time, self.current))

    def __hash__(self) -> int:
        return self._hash

    @property
    def powers(self) -> dict[str, Fraction]:
        """The exponents of mass, length, time and current, by the letters M, L, T and I."""
        return {"M": self.mass, "L": self.length, "T": self.time, "I": self.current}

    def __mul__(self, other: Dimension) -> Dimension:
        return _multiplied(self, other)

    def __pow__(self, exponent: Fraction | int) -> Dimension:
        return _raised(self, exponent)

    def __truediv__(self, other: Dimension) -> Dimension:
        return self * other**-1

    @property
    def is_number(self) -> bool:
        return self == NUMBER


@lru_cache(maxsize=1024)
def _multiplied(one: Dimension, other: Dimension) -> Dimension:
    return Dimension(*(a + b for a, b in zip(one.powers.values(), other.powers.values(), strict=True)))


@lru_cache(maxsize=1024)
def _raised(base: Dimension, exponent: Fraction | int) -> Dimension:
    return Dimension(*(n * exponent for n in base.powers.values()))


def dimension(mass: int, length: int, time: int, current: int = 0) -> Dimension:
    return Dimension(Fraction(mass), Fraction(length), Fraction(time), Fraction(current))


NUMBER = dimension(0, 0, 0)


def raised(letter: str, power: Fraction) -> str:
    """Return a power of a unit as text: `m`, `m^2`, `m^(3/2)`."""
    if power == 1:
        return letter
    return f"{letter}^{power}" if power.denominator == 1 else f"{letter}^({power})"


def exponents(dimension: Dimension) -> str:
    """Return a dimension as text: `M L^2 T^-2`; `1` for a number."""
    parts = [letter if n == 1 else f"{letter}^{n}" for letter, n in dimension.powers.items() if n]
    return " ".join(parts) or "1"


def product(dimensions: Iterable[Dimension | None]) -> Dimension | None:
    found = list(dimensions)
    return None if None in found else reduce(mul, found, NUMBER)


def quotient(above: Dimension | None, below: Dimension | None) -> Dimension | None:
    return None if above is None or below is None else above / below


def power(base: Dimension | None, exponent: Fraction) -> Dimension | None:
    return None if base is None else base**exponent
