"""Numerical position maps of bodies: places from variables, and variables from places by Newton's method."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import isfinite, pi
from random import Random

from sympy import Expr, Integer, Rational, Symbol, diff, lambdify

from derive.algebra.expressions import explicit
from derive.algebra.ranges import rational_in_range
from derive.mechanics.bodies.regions import Bounds
from derive.steps.known_numbers import with_numbers

DRAWS = 3  # number of sets of random numbers for one symbol; each other symbol adds FURTHER sets, at most MOST in all
FURTHER, MOST = 12, 48
SCALES = (Rational(1, 60), Rational(1, 8), Integer(1), Integer(8), Integer(60))
NEAR = 160  # number of sampled points of a body; Newton's method starts at the points closest to the sought place
STARTS, TURNS = 10, 30  # number of starts of Newton's method; greatest number of iterations from each start
FAR = 1e6  # an iteration stops when |variable| exceeds this multiple of (1 + the largest |start value|)
BEYOND = 0.1  # a body may extend beyond the sampled points by this fraction of its width
CLOSE = 1e-9

Place = tuple[float, ...]


@dataclass(frozen=True)
class Chart:
    """A numerical position map.

    names    the variables
    place    a function: values of the variables -> the place
    slopes   a function: values of the variables -> the derivatives of the place with respect to each variable
    ends     the limits of each variable, as functions of the outer variables
    """

    names: tuple[Symbol, ...]
    place: Callable[..., list[float]]
    slopes: Callable[..., list[list[float]]]
    ends: tuple[Callable[..., tuple[float, float]], ...]

    @classmethod
    def of(cls, position: Sequence[Expr], limits: Bounds, at: Mapping[Symbol, Expr]) -> Chart:
        names = [x for x, _, _ in limits]
        put = dict(at)
        place = [explicit(x).xreplace(put).evalf() for x in position]
        slopes = [[diff(x, u) for u in names] for x in place]
        ends = [[explicit(end).xreplace(put).evalf() for end in both] for _, *both in limits]
        return cls(
            tuple(names),
            lambdify(names, place, "math"),
            lambdify(names, slopes, "math"),
            tuple(lambdify(names[:i], both, "math") for i, both in enumerate(ends)),
        )

    def points(self, count: int, source: Random, margin: float = 0.04) -> Iterator[Place]:
        """Random values of the variables between their limits, some of them close to a limit."""
        for _ in range(count):
            at: Place = ()
            for ends in self.ends:
                low, high = ends(*at)
                part = margin + (1 - 2 * margin) * source.random()
                if source.random() < 0.4:
                    part = margin / 4 if source.random() < 0.3 else 1 - margin / 4
                at = (*at, low + part * (high - low))
            yield at

    @cached_property
    def known(self) -> list[tuple[list[float], Place]]:
        """Sampled places of the body, each with the values of the variables there."""
        return [(self.place(*at), at) for at in self.points(NEAR, Random(5))]

    @cached_property
    def size(self) -> float:
        """The largest absolute coordinate of the sampled places."""
        return max(abs(x) for place, _ in self.known for x in place)

    @cached_property
    def box(self) -> list[tuple[float, float]]:
        """The range of each coordinate of the sampled places, with a margin."""
        found = []
        for across in zip(*(place for place, _ in self.known), strict=True):
            low, high = min(across), max(across)
            found.append((low - BEYOND * (high - low), high + BEYOND * (high - low)))
        return found

    def sought(self, target: Sequence[float]) -> Iterator[Place]:
        """Values of the variables, within their limits, at which the place is the target. Newton's method starts from
        the closest samples, so some values may be missing, and others may occur more than once."""
        slack = CLOSE * self.size
        if any(x < low - slack or x > high + slack for x, (low, high) in zip(target, self.box, strict=True)):
            return
        near = sorted(self.known, key=lambda each: _distance(each[0], target))
        for _, start in near[:STARTS]:
            found = self._newton(target, start)
            if found is not None and (within := self._within(found)) is not None:
                yield within

    def _newton(self, target: Sequence[float], at: Place) -> Place | None:
        size, far = self.size, FAR * (1 + max(map(abs, at)))
        for _ in range(TURNS):
            left = [goal - x for goal, x in zip(target, self.place(*at), strict=True)]
            if max(map(abs, left)) < CLOSE * size:
                return at
            step = _solved(self.slopes(*at), left)
            if step is None:
                return None
            at = tuple(x + s for x, s in zip(at, step, strict=True))
            if not all(map(isfinite, at)) or max(map(abs, at)) > far:
                return None
        return None

    def _within(self, at: Place) -> Place | None:
        """The values of the variables, with angles shifted by full turns into their limits; None if a value remains
        outside."""
        found: Place = ()
        for i, ends in enumerate(self.ends):
            low, high = ends(*found)
            x, slack = at[i], CLOSE * (abs(low) + abs(high))
            if not low - slack <= x <= high + slack and self._is_round(at, i):
                x = low + (x - low) % (2 * pi)
            if not low - slack <= x <= high + slack:
                return None
            found = (*found, x)
        return found

    def _is_round(self, at: Place, i: int) -> bool:
        turned = self.place(*(x + 2 * pi * (k == i) for k, x in enumerate(at)))
        here = self.place(*at)
        return all(abs(a - b) <= CLOSE * self.size for a, b in zip(turned, here, strict=True))


def _solved(slopes: Sequence[Sequence[float]], left: Sequence[float]) -> list[float] | None:
    """The Newton step by least squares: Cramer's rule for the normal equations; None if these are singular."""
    count = len(slopes[0])
    normal = [[sum(row[i] * row[j] for row in slopes) for j in range(count)] for i in range(count)]
    right = [sum(row[i] * x for row, x in zip(slopes, left, strict=True)) for i in range(count)]
    whole = _determinant(normal)
    if whole == 0 or not isfinite(whole):
        return None
    replaced = (
        [[right[i] if j == k else normal[i][j] for j in range(count)] for i in range(count)] for k in range(count)
    )
    return [_determinant(each) / whole for each in replaced]


def _determinant(m: Sequence[Sequence[float]]) -> float:
    if len(m) == 1:
        return m[0][0]
    if len(m) == 2:
        return m[0][0] * m[1][1] - m[0][1] * m[1][0]
    return sum(
        m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3]) for i in range(3)
    )


def draws(letters: set[Symbol], limits: Sequence[Bounds]) -> Iterator[dict[Symbol, Expr]]:
    """Random values of the symbols, with each lower limit below its upper limit.

    If the problem states a number for a symbol, the symbol has this value.
    """
    source = Random(len(letters))
    ordered = sorted(letters, key=str)
    given = {s: number for s in ordered if not (number := with_numbers(s)).free_symbols}
    free = len(ordered) - len(given)
    for _ in range(min(DRAWS + FURTHER * (free - 1), MOST) if free > 1 else DRAWS if free else 1):
        sizes = {
            s: Rational(source.randint(40, 160), 97) * source.choice(SCALES if free > 1 else SCALES[2:3])
            for s in ordered
        }
        at = {s: given.get(s, rational_in_range(s, size)) for s, size in sizes.items()}
        if all(_are_in_order(each, at) for each in limits):
            yield at


def _are_in_order(limits: Bounds, at: Mapping[Symbol, Expr]) -> bool:
    """Whether each lower limit is below the upper limit, with the outer variables at their midpoints."""
    known = dict(at)
    for x, lower, upper in limits:
        low, high = (explicit(end).xreplace(known).evalf() for end in (lower, upper))
        if not (low.is_real and high.is_real and high > low):
            return False
        known[x] = (low + high) / 2
    return True


def _distance(one: Sequence[float], other: Sequence[float]) -> float:
    return sum((a - b) ** 2 for a, b in zip(one, other, strict=True))
