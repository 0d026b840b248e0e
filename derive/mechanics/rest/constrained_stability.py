"""Stability of an equilibrium with constraints f_a = 0 that constraint forces maintain.

Only displacements z with grad f_a . z = 0 are allowed. At equilibrium grad U = sum of lambda_a grad f_a. So the change
of the potential energy along the constraints is, to second order, (1/2) z . (U'' - sum of lambda_a f_a'') z.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Matrix, MatrixBase, Symbol

from derive.algebra.amplitudes import Amplitudes, inverse_of
from derive.algebra.definite import leading_minors, sign_of_form
from derive.algebra.derivatives import derivative
from derive.algebra.expressions import Relation, depends_on_time, explicit, scalar
from derive.algebra.taylor import coefficient_along
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.model.constraint import Constrained, Constraint
from derive.mechanics.model.system import System
from derive.mechanics.rest import claims
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.rule import ROUTE, Rule, Shown
from derive.steps.signs import sign_for_all
from derive.steps.step import Quantity, is_zero

__all__: list[str] = []

MOST = 3  # largest number of directions that a sentence can list


def constraints_of(of: Quantity) -> tuple[Constraint, ...]:
    """Return the constraints that constraint forces maintain in the system of an energy or an equation of motion."""
    kept, body = of.fact(Constrained), of.subject.body
    return kept.constraints if kept is not None else body.constraints if isinstance(body, System) else ()


@dataclass(frozen=True)
class Allowed:
    """The potential energy, the constraints, and the equilibrium values of the coordinates."""

    energy: Expr
    constraints: tuple[Constraint, ...]
    place: Mapping[Symbol, Expr]

    @property
    def coordinates(self) -> list[Symbol]:
        return list(self.place)

    def there(self, value: Expr) -> Expr:
        return tidied(value.xreplace(dict(self.place)))

    @cached_property
    def gradients(self) -> MatrixBase:
        """Return the gradients of the constraints at equilibrium, one row for each constraint."""
        rows = [[self.there(derivative(c.residual, q)) for q in self.coordinates] for c in self.constraints]
        return ImmutableDenseMatrix(rows)

    @cached_property
    def ways(self) -> list[MatrixBase]:
        """Return a basis of the displacements that the constraints allow."""
        columns = Matrix(self.gradients).nullspace(iszerofunc=is_zero)
        return [ImmutableDenseMatrix(column.applyfunc(tidied)) for column in columns]

    @cached_property
    def multipliers(self) -> list[Expr] | None:
        """Return the multipliers in grad U = sum of lambda grad f; None if the forces do not balance along the allowed
        displacements.
        """
        slopes = ImmutableDenseMatrix([self.there(derivative(self.energy, q)) for q in self.coordinates])
        if any(not is_zero((way.T * slopes)[0]) for way in self.ways):
            return None
        normal = self.gradients
        found = inverse_of(normal * normal.T) * normal * slopes
        return [tidied(value) for value in found]

    @cached_property
    def matrix(self) -> MatrixBase:
        """Return a . (U'' - sum of lambda f'') b for each pair a, b of basis displacements."""
        assert self.multipliers is not None
        terms = (m * c.residual for m, c in zip(self.multipliers, self.constraints, strict=True))
        whole = self.energy - Add(*terms)
        moving = self.coordinates
        second = Matrix([[self.there(derivative(whole, p, q)) for q in moving] for p in moving])
        return ImmutableDenseMatrix([[tidied((a.T * second * b)[0]) for b in self.ways] for a in self.ways])

    def along_curves(self) -> MatrixBase:
        """Return the same matrix as `matrix`, without multipliers: from the energy along curves that satisfy the
        constraints."""
        count = len(self.ways)
        squares = {}
        for i, j in product(range(count), repeat=2):
            way = self.ways[i] if i == j else self.ways[i] + self.ways[j]
            squares[i, j] = 2 * self._along(way)
        entries = [
            [
                tidied(squares[i, i] if i == j else (squares[i, j] - squares[i, i] - squares[j, j]) / 2)
                for j in range(count)
            ]
            for i in range(count)
        ]
        return ImmutableDenseMatrix(entries)

    def _along(self, way: MatrixBase) -> Expr:
        """Return the coefficient of s^2 in the energy for a displacement s z + s^2 w that satisfies the constraints."""
        moved = dict(zip(self.coordinates, way, strict=True))
        bent = ImmutableDenseMatrix([coefficient_along(c.residual, self.place, moved, 2) for c in self.constraints])
        normal = self.gradients
        turn = -normal.T * inverse_of(normal * normal.T) * bent
        straight = coefficient_along(self.energy, self.place, moved, 2)
        aside = coefficient_along(self.energy, self.place, dict(zip(self.coordinates, turn, strict=True)), 1)
        return tidied(straight + aside)


STABILITY_ON_CONSTRAINTS = Rule(
    "rest.stability_on_constraints",
    source=(
        "Goldstein, Poole, Safko, *Classical Mechanics*, sections 2.4 and 6.1; Luenberger, *Linear and "
        "Nonlinear Programming*, section 11.5"
    ),
    outcomes=claims.STABILITY_ON_CONSTRAINTS,
    evidence={"along_curves": ROUTE},
    named={
        "state": claims.on_the_constraints,
        "moving": claims.on_the_constraints,
        "constraint": claims.on_the_constraints,
        "way": claims.along_the_constraints,
    },
    shown=Shown(verdicts=frozenset(claims.STABILITY_ON_CONSTRAINTS)),
)


@dataclass(frozen=True)
class OnConstraints:
    """An equilibrium of a system whose coordinates satisfy constraints.

    potential     the potential energy, J
    constraints   the constraints between the coordinates, with their forces
    place         the equilibrium values of the coordinates
    """

    potential: Quantity
    constraints: tuple[Constraint, ...]
    place: Mapping[Symbol, Expr]

    def stability(self, key: str) -> Quantity:
        """Stability of an equilibrium under constraints, from the second-order change of U in allowed displacements.

        Second route: the energy along curves that satisfy the constraints, to second order.
        Outcomes: stable, unstable, level, depends.
        Errors: a constraint depends on the rates or on the time; a value is missing, or the values do not satisfy a
        constraint; at these values the forces do not balance along the allowed displacements; the constraints are not
        independent, or allow no displacement or more than three directions.
        Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 2.4 and 6.1; Luenberger, *Linear and Nonlinear
        Programming*, section 11.5.
        """
        allowed = _allowed(self.potential, self.constraints, self.place)
        minors = list(leading_minors(allowed.matrix))
        sign = sign_of_form(allowed.matrix, sign_for_all)
        names = [scalar(f"D_{n + 1}") for n in range(len(minors))]
        alone = len(minors) == 1
        state = Relation(Amplitudes(*allowed.coordinates), "=", Amplitudes(*allowed.place.values()))
        moved = Amplitudes(*allowed.coordinates)
        named: dict[str, Any] = {"state": state, "moving": moved}
        named |= {f"way_{n}": Amplitudes(*way) for n, way in enumerate(allowed.ways, 1)}
        for constraint in self.constraints[:1]:
            named["constraint"] = constraint.relation

        def along_curves(found: Any) -> tuple[Any, Any]:
            curved = list(leading_minors(allowed.along_curves()))
            return found, curved[0] if alone else ImmutableDenseMatrix(curved)

        return establish(
            STABILITY_ON_CONSTRAINTS,
            names[0] if alone else ImmutableDenseMatrix(names),
            lambda *_: minors[0] if alone else Amplitudes(*minors),
            {"potential": self.potential},
            lines=Lines(
                put_in=None, result=False, arranged=lambda _: minors[0] if alone else ImmutableDenseMatrix(minors)
            ),
            routes={"along_curves": along_curves},
            outcome={1: "stable", 0: "level", -1: "unstable", None: "depends"}[sign],
            phrase_data=PhraseData(
                named=named,
                outcome_data={
                    "coordinates": tuple(allowed.coordinates),
                    "place": tuple(allowed.place.values()),
                    "potential_here": allowed.energy,
                    "constraints": tuple(c.residual for c in self.constraints),
                },
            ),
            key=key,
            parents=[self.potential],
            scope=Scope(),
        )


def _allowed(potential: Quantity, constraints: Sequence[Constraint], place: Mapping[Symbol, Expr]) -> Allowed:
    energy = explicit(potential.value)
    for each in constraints:
        if each.in_rates or depends_on_time(each.residual):
            message = f"`stability` needs constraints between coordinates only, not {each.left} = {each.right}"
            raise Rejected(Complaint("constrained", message, help="ask for the equations of motion"))
    needed = {q for each in constraints for q in each.coordinates} | {q for q in potential.coordinates if energy.has(q)}
    missing = sorted(q.name for q in needed - set(place))
    if missing:
        message = f"`stability`: the value of {missing[0]} at equilibrium is unknown"
        raise Rejected(Complaint("wrong-argument", message, help=f"add the value to `at`, such as `{missing[0]}: 0`"))
    allowed = Allowed(energy, tuple(constraints), place)
    where = ", ".join(f"{q} = {value}" for q, value in allowed.place.items())
    for each in constraints:
        if not is_zero(allowed.there(each.residual)):
            message = f"`stability`: {where} does not satisfy the constraint {each.left} = {each.right}"
            raise Rejected(Complaint("no-equilibrium", message))
    if len(allowed.ways) != len(allowed.coordinates) - len(constraints):
        message = f"`stability`: at {where} the gradients of the constraints are not independent"
        raise Rejected(Complaint("constrained", message, help="write each constraint once, and f = 0, not f**2 = 0"))
    if not allowed.ways:
        message = "`stability`: the constraints allow no displacement"
        raise Rejected(Complaint("constrained", message))
    if len(allowed.ways) > MOST:
        message = f"`stability`: the constraints allow {len(allowed.ways)} directions, which are too many to list"
        raise Rejected(Complaint("too-large", message))
    if allowed.multipliers is None:
        message = f"`stability`: at {where} the forces do not balance along the allowed displacements"
        raise Rejected(Complaint("no-equilibrium", message, help="give values at which the forces balance"))
    return allowed
