"""Facts that results carry in addition to their value, for later steps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, reduce

from sympy import (
    Expr,
    ImmutableDenseMatrix,
    Integer,
    Mul,
    Symbol,
    factor,
    lcm,
    together,
)
from sympy.matrices import MatrixBase

from derive.algebra.expressions import Relation
from derive.algebra.tidy import common_factor, tidied
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.solving.linear_systems import CharacteristicRoot, LinearSystem
from derive.steps.step import Fact


@dataclass(frozen=True)
class Linear(LinearSystem, Fact):
    """All linear equations of a system, M eta_ddot + (G + C) eta_dot + K eta = f(t), as matrices.

    The fact also contains the condition under which the equilibrium exists, the displacements eta, the driving forces
    f, and the value of each coordinate at equilibrium. `exact` contains the left sides of the equations of motion in
    terms of eta if all of them are linear without approximation; otherwise it is empty.
    """

    missing = "is not an equation of motion to first order"
    displacements: tuple[Coordinate, ...] = ()
    driven: tuple[Expr, ...] = ()
    place: tuple[tuple[Coordinate, Expr], ...] = ()
    exact: tuple[Expr, ...] = ()

    @property
    def moving(self) -> tuple[Symbol, ...]:
        """The symbols of the displacements."""
        return tuple(s.symbol for s in self.displacements)

    @cached_property
    def blocks(self) -> tuple[tuple[int, ...], ...]:
        """The groups of coordinates that are coupled to each other, by their indices. A coordinate that is not coupled
        to any other is a group by itself."""
        size, groups = range(self.mass.shape[0]), [{i} for i in range(self.mass.shape[0])]
        for i, j in ((i, j) for i in size for j in size if i != j):
            if any(matrix[i, j] != 0 for matrix in (self.mass, self.turning, self.stiffness)):
                met = [group for group in groups if group & {i, j}]
                groups = [group for group in groups if group not in met] + [set().union(*met)]
        return tuple(sorted(tuple(sorted(group)) for group in groups))

    def part(self, block: Sequence[int]) -> Linear:
        """Return the equations of some coordinates that are not coupled to the others."""
        rows = list(block)
        mass, turning, stiffness = (each.extract(rows, rows) for each in (self.mass, self.turning, self.stiffness))
        return Linear(
            mass,
            turning,
            stiffness,
            self.exists,
            tuple(self.displacements[i] for i in rows),
            tuple(self.driven[i] for i in rows),
            tuple(self.place[i] for i in rows),
            tuple(self.exact[i] for i in rows if self.exact),
        )

    def of_all(self, moving: Sequence[Symbol], column: MatrixBase) -> MatrixBase:
        """Return the amplitudes of all coordinates: for the coordinates `moving` the entries of the column, for all
        others zero."""
        known = dict(zip(moving, column, strict=True))
        return ImmutableDenseMatrix([known.get(s, Integer(0)) for s in self.moving])

    def rows_of(self, matrix: MatrixBase) -> MatrixBase:
        """Return the matrix with each row divided by the common factor of the equation that belongs to this row."""
        size = range(matrix.shape[0])
        return ImmutableDenseMatrix([[tidied(matrix[i, j] / self.common(i)) for j in size] for i in size])

    def common(self, i: int) -> Expr:
        """Return the common factor of all terms of one equation, such as m l for m l^2 theta_ddot + m g l theta.

        The factor contains no rational number, and no part that may be zero or negative.
        """
        entries = [entry for matrix in (self.mass, self.turning, self.stiffness) for entry in matrix.row(i)]
        parts = [together(entry).as_numer_denom() for entry in (*entries, self.driven[i]) if entry != 0]
        if len(parts) == 1:
            return Integer(1)  # I theta_ddot = 0 remains unchanged
        found = common_factor([above for above, _ in parts])
        if all(below.free_symbols for _, below in parts):
            found /= factor(reduce(lcm, (below for _, below in parts)))
        return Mul(*(part for part in Mul.make_args(found) if part.is_positive and not part.is_Rational))


@dataclass(frozen=True)
class Mode(Fact):
    """The root lambda = omega^2 that gives the frequency or growth rate of a mode.

    root     the root, with its sign and its shapes
    moving   the coordinates whose amplitudes are the entries of a shape
    """

    missing = "is not the frequency of a normal mode"
    root: CharacteristicRoot
    moving: tuple[Symbol, ...]


@dataclass(frozen=True)
class SquareOf(Fact):
    """The symbol of a frequency whose square is the result, and the condition under which the equilibrium exists.

    `exact` is the displacement, and the left side of its equation of motion, if this equation is linear without
    approximation.
    """

    missing = "is not the square of a frequency"
    letter: str
    exists: Relation | None = None
    exact: tuple[Symbol, Expr] | None = None
