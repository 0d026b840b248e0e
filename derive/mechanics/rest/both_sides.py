"""Distances along a line: |u| is u if u > 0 and -u if u < 0; both cases are solved separately."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product

from sympy import Abs, Expr, Mul, Symbol

from derive.algebra.expressions import Relation
from derive.algebra.ranges import range_of
from derive.algebra.tidy import tidied
from derive.solving.relations import positive
from derive.solving.zeros import Unsolved
from derive.steps.record import assumed, assumed_in_words
from derive.steps.signs import sign_for_all, sign_where

MOST = 4  # largest number of distances for which both signs are tried


@dataclass(frozen=True)
class State:
    """Values of coordinates at equilibrium; coordinates that are not listed may have any value."""

    values: Mapping[Symbol, Expr]
    exists: Relation | None = None


class SidesOpen(Unsolved):
    """Raised if an equilibrium exists only under two conditions on the symbols."""

    def __init__(self, state: State, other: Relation):
        super().__init__(other.residual)
        self.state, self.other = state, other


def sides_of(forces: Mapping[Symbol, Expr]) -> Iterator[Mapping[Expr, Expr]]:
    """Yield each choice of u or -u for every distance |u| in the forces; `on_its_side` excludes u = 0."""
    sizes = sorted({size for f in forces.values() for size in f.atoms(Abs) if size.has(*forces)}, key=str)
    if len(sizes) > MOST:
        raise Unsolved(Mul(*sizes))
    for signs in product((1, -1), repeat=len(sizes)):
        yield {size: sign * size.args[0] for size, sign in zip(sizes, signs, strict=True)}


def on_its_side(state: State, lengths: Sequence[Expr]) -> State | None:
    """Return the state with the condition that all these lengths are positive; None if a length is known to be zero or
    negative."""
    for each in lengths:
        there = tidied(each.xreplace(dict(state.values)))
        sign = sign_where(there, state.exists)
        if sign in (-1, 0):
            return None
        if sign is None:
            exists = positive(there)
            if state.exists is not None and not _follows(state.exists, exists):
                raise SidesOpen(state, exists)
            state = replace(state, exists=exists)
    return state


def _follows(condition: Relation, other: Relation) -> bool:
    """Whether `condition` is true wherever `other` is true."""
    return sign_where(condition.residual, other) == (1 if condition.operator[0] == ">" else -1)


def keeps_sides(state: State) -> bool:
    """Whether every distance that the page assumes to be positive can be positive at this equilibrium."""
    lengths = [each.residual for each in _sides_taken(tuple(state.values))]
    return all(sign_for_all(tidied(u.xreplace(dict(state.values)))) not in (-1, 0) for u in lengths)


def how_sides_are_taken(coordinates: Sequence[Symbol]) -> str:
    """Return the word for the assumed signs of distances.

    The word is "any" if no sign is assumed, "stretched" if a step states all assumed signs in words, and "one_side"
    otherwise.
    """
    taken = _sides_taken(coordinates)
    if not taken:
        return "any"
    return "stretched" if all(each in assumed_in_words() for each in taken) else "one_side"


def _sides_taken(coordinates: Sequence[Symbol]) -> list[Relation]:
    """Return the assumed signs of distances; the bound of a range is not such a sign."""
    taken = (each for each in assumed() if each.operator == ">" and each.residual.has(*coordinates))
    return [each for each in taken if range_of(each.left) is None]


def on_known_sides(value: Expr, exists: Relation | None) -> Expr:
    """Replace |u| by u or -u wherever the condition of existence determines the sign of u."""
    if exists is None:
        return value
    sides = {size: sign * size.args[0] for size in value.atoms(Abs) if (sign := sign_where(size.args[0], exists))}
    return value.xreplace(sides)
