"""The linear equations of all coordinates as one linear system, and motions substituted into the equations."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Generic

from sympy import Expr, ImmutableDenseMatrix, Integer, Symbol
from sympy.matrices import MatrixBase

from derive.algebra.derivatives import derivative
from derive.algebra.expressions import Relation, explicit, stand_in
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import OfCoordinate, T
from derive.mechanics.vibrations.facts import Linear
from derive.solving.linear_systems import Kind
from derive.steps.record import require_constant
from derive.steps.step import Quantity, is_zero

ZERO = Integer(0)
OF_SIGN = {1: "oscillating", -1: "growing", 0: "free", None: "conditional"}  # sign of a root -> outcome


@dataclass(frozen=True)
class Equations(Generic[Kind]):
    """Linear equations of a group of coordinates that are not coupled to coordinates outside the group, and the linear
    system of these equations.

    every     the equations of the whole system
    block     the indices of the coordinates of the group
    letter    the symbol of the unknown in the characteristic equation
    start     the beginning of all keys
    before    the number of modes of other coordinates; these modes come first in the numbering
    number    the end of the key of the characteristic equation
    """

    every: Sequence[Quantity]
    block: Sequence[int]
    system: Kind
    letter: Symbol
    start: str
    before: int = 0
    number: str = ""

    @property
    def linear(self) -> list[Quantity]:
        """The equations of the group."""
        return [self.every[i] for i in self.block]

    @property
    def together(self) -> Linear:
        return self.every[0].needed(Linear).part(self.block)

    @property
    def moving(self) -> tuple[Symbol, ...]:
        return self.together.moving

    @property
    def is_whole(self) -> bool:
        return len(self.block) == len(self.every)

    @property
    def named(self) -> dict[str, Quantity]:
        """The equations of the group, for a sentence that names them; empty if the group is the whole system."""
        return {} if self.is_whole else {f"equation_{n}": each for n, each in enumerate(self.linear, 1)}

    def with_motion(self, motion: Sequence[Expr]) -> list[Expr]:
        """Substitute a motion of the coordinates of the group into their equations, and return the residuals."""
        return with_motion(self.linear, self.together, motion)

    def factors_of_amplitudes(self, course: Expr) -> MatrixBase:
        """Return the factor of each amplitude in each equation: substitute eta = a course(t) and divide by the
        course."""
        amplitudes = [stand_in(f"a_{n}") for n in range(len(self.block))]
        left = [value / course for value in self.with_motion([a * course for a in amplitudes])]
        return ImmutableDenseMatrix([[derivative(value.expand(), a) for a in amplitudes] for value in left])

    def left_by_drift(self, column: MatrixBase, time: Expr) -> list[Expr]:
        """Return the residuals of all full equations of motion for a uniform motion from equilibrium along `column`."""
        whole = self.every[0].needed(Linear)
        return left_by_drift(self.every, whole.of_all(self.moving, column), time)

    def matrix(self, s: Expr) -> MatrixBase:
        """Return the matrix that multiplies the amplitudes of a motion e^(s t); each row is divided by its common
        factor."""
        return self.together.rows_of(self.system.at(s))

    def judged_by(self, conditions: Sequence[Relation] = ()) -> dict[str, Any]:
        """Return the data for testing an outcome: the matrices, the stated conditions, and the condition under which
        the equilibrium exists, if there is one."""
        system = self.system
        found: dict[str, Any] = {"stiffness": system.stiffness, "turning": system.turning, "mass": system.mass}
        exists = {} if system.exists is None else {"exists": system.exists}
        return {**found, "conditions": tuple(conditions), **exists}


def letter_of_shapes(given: Iterable[Symbol]) -> str:
    """Return a name for the amplitudes that differs from the names of the given symbols."""
    taken = {s.name.partition("_")[0] for s in given}
    return next((letter for letter in ("a", "A", "b", "u") if letter not in taken), "v")


def together_for(verb: str, linear: Sequence[Quantity]) -> Linear:
    """Return the linear system of the equations, or reject the equations.

    All equations of the system must be given, and no driving force may act. The forces that do not depend on the rates
    must have a potential energy, and the matrices must be constant.
    """
    together = linear[0].needed(Linear)
    if len(linear) != len(together.displacements) or any(each.fact(Linear) != together for each in linear):
        message = f"`{verb}` needs all the equations of one call of `linearised`"
        raise Rejected(Complaint("wrong-argument", message))
    if any(force != 0 for force in together.driven):
        message = f"`{verb}` needs equations without a driving force, but a force depends on the time"
        raise Rejected(Complaint("wrong-argument", message))
    if any(not is_zero((each - each.T).applyfunc(tidied)) for each in (together.stiffness, together.mass)):
        raise Rejected(Complaint("wrong-argument", f"`{verb}` needs forces that have a potential energy"))
    rates = "turning" if together.is_gyroscopic else "drag"
    for matrix, role in ((together.mass, "mass"), (together.turning, rates), (together.stiffness, "stiffness")):
        for entry in matrix:
            require_constant(verb, role, entry)
    return together


def with_motion(linear: Sequence[Quantity], together: Linear, motion: Sequence[Expr]) -> list[Expr]:
    """Substitute a motion eta(t) of the coordinates of `together` into each linear equation, and return the
    residuals."""
    put_in: dict[Any, Expr] = {}
    for s, eta in zip(together.displacements, motion, strict=True):
        put_in.update({s.symbol: eta, s.rate: derivative(eta, T), s.acceleration: derivative(eta, T, 2)})
    return [explicit(equation.value).residual.xreplace(put_in) for equation in linear]


def left_by_drift(linear: Sequence[Quantity], column: Sequence[Expr], time: Expr) -> list[Expr]:
    """Return the residuals of the full equations of motion for a uniform motion from equilibrium along `column`."""
    equations = {e.needed(OfCoordinate).coordinate: e for each in linear for e in each.parents if e.fact(OfCoordinate)}
    place, moved = linear[0].needed(Linear).place, {}
    for (q, at), share in zip(place, column, strict=True):
        moved.update({q.symbol: at + share * time, q.rate: share, q.acceleration: ZERO})
    return [explicit(equations[q].value).residual.xreplace(moved) for q, _ in place]
