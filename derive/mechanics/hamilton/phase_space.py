"""Rates of coordinates in terms of momenta.

In phase space a momentum p_q is a symbol that is independent of its coordinate q, so steps store p_q as a further
coordinate. The value of a momentum is a function of coordinates and rates, such as m l^2 theta_dot.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from sympy import (
    Expr,
    ImmutableDenseMatrix,
    Integer,
    Matrix,
    Symbol,
    cos,
    sin,
)

from derive.algebra.derivatives import derivative
from derive.algebra.expressions import bound, explicit
from derive.algebra.kinds import dimension_of_kind, kind_of_dimension
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.hamilton import claims
from derive.mechanics.hamilton.inverted_momenta import by_quadratic_form
from derive.mechanics.kinematics.coordinates import Coordinate, OfCoordinate
from derive.mechanics.lagrange.energy_forms import squared_below_roots
from derive.solving.divisors import told_of_divisors
from derive.solving.presentation import by_one_square
from derive.steps.claims import says_what_it_divides_by
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.level import Manner
from derive.steps.rule import CHECK, Rule, Shown
from derive.steps.step import Quantity, lettered

__all__ = ["rates_by_momenta"]

LARGEST = 4  # greatest number of coupled rates
LARGEST_WITH_ANGLES = 2  # greatest number if the coupling contains sines or cosines; with three rates, H fills a page
ZERO = Integer(0)


RATE_BY_MOMENTA = Rule(
    "hamilton.rate_by_momenta",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 8.1",
    outcomes={"alone": claims.rate_by_momenta_alone, "together": claims.rate_by_momenta_together},
    evidence={"put_back": CHECK},
    statements=[says_what_it_divides_by],
    shown=Shown(brief=Manner.LEFT_OUT),
)


def rates_by_momenta(
    of: Quantity, given: Sequence[Quantity], varying: bool = False, key: str = "rate"
) -> tuple[Quantity, ...]:
    """Rates as functions of momenta, solved from p = dL/dq_dot.

    of        the Lagrangian, J
    given     momenta of some coordinates of the Lagrangian; the results contain the symbols of these momenta
    varying   whether these symbols vary in time, as in a Hamiltonian; otherwise they are constant

    Keys: rate_x for the coordinate x, if `key` is "rate"; for constant momenta p_x and p_y, rate_x_by_p_x_p_y.
    Check: the rates substituted in the momenta give the symbols of the momenta.
    Outcomes: alone (one rate), together (several).
    Errors: the momenta do not determine the rates; too many rates are coupled; the momenta are not linear in the rates,
    except if L contains the rates only in linear terms and in one sum of squares.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 8.1.
    """
    own = [p.needed(OfCoordinate).coordinate for p in given]
    solved = _solved({p.symbol: p.value for p in given}, [q.rate for q in own])
    moving = {p.symbol: p.step.kind or "number" for p in given} if varying else {}
    letters = [p.symbol for p in given]
    by = "_".join(letter.name for letter in letters)
    divisors = told_of_divisors(solved.values())

    def put_back(q: Coordinate, found: Expr) -> tuple[ImmutableDenseMatrix, ImmutableDenseMatrix]:
        rates = {**solved, q.rate: found}
        back = [bound(explicit(p.value), rates) for p in given]
        return ImmutableDenseMatrix(back), ImmutableDenseMatrix(letters)

    def of_one(q: Coordinate) -> Quantity:
        return establish(
            RATE_BY_MOMENTA,
            q.rate,
            lambda *names: bound(solved[q.rate], dict(zip(letters, names, strict=False))),
            {f"momentum_{each.symbol.name}": lettered(p) for each, p in zip(own, given, strict=True)},
            lines=Lines(put_in=None, result=False, arranged=explicit),
            routes={"put_back": lambda found: put_back(q, found)},
            outcome="alone" if len(own) == 1 else "together",
            phrase_data=PhraseData(formulas=divisors),
            key=f"{key}_{q.symbol.name}" if varying else f"{key}_{q.symbol.name}_by_{by}",
            kind=kind_of_dimension(dimension_of_kind(q.kind) / dimension_of_kind("time")),
            scope=Scope(coordinates=moving),
        )

    return tuple(of_one(q) for q in own)


def _solved(momenta_of: Mapping[Symbol, Expr], rates: Sequence[Symbol]) -> dict[Symbol, Expr]:
    """Solve for the rates. If the momenta are linear in the rates, solve the equations in blocks of coupled rates.
    Otherwise solve all equations together; then L must contain the rates only in linear terms and in one sum of
    squares."""
    matrix = Matrix([[derivative(explicit(p), v) for v in rates] for p in momenta_of.values()])
    at_rest = dict.fromkeys(rates, ZERO)
    wanted = Matrix([letter - bound(explicit(p), at_rest) for letter, p in momenta_of.items()])
    if matrix.has(*rates):
        by_form = by_quadratic_form(momenta_of, rates)
        if by_form is not None:
            return {v: squared_below_roots(found, list(momenta_of)) for v, found in by_form.items()}
        raise Rejected(
            Complaint(
                "wrong-argument",
                "rates follow from momenta only if the momenta are linear in the rates, or if the Lagrangian contains "
                "the rates only in linear terms and in one sum of squares",
            )
        )
    found: dict[Symbol, Expr] = {}
    for block in _coupled(matrix):
        names = ", ".join(rates[i].name for i in block)
        part = matrix.extract(block, block)
        most = LARGEST_WITH_ANGLES if part.has(sin, cos) else LARGEST
        if len(block) > most:
            message = f"{len(block)} coupled equations must be solved for {names}"
            help_line = (
                f"at most {LARGEST} rates may be coupled, and {LARGEST_WITH_ANGLES} if the coupling depends on angles"
            )
            raise Rejected(Complaint("too-hard", message, help=help_line))
        below = tidied(part.det(method="berkowitz"))
        if below == 0:
            message = f"the momenta do not determine {names}"
            raise Rejected(
                Complaint(
                    "singular",
                    message,
                    help="perhaps two coordinates describe the same motion, or L does not contain one of the rates",
                )
            )
        above = part.adjugate() * wanted.extract(block, [0])
        solved = (by_one_square(tidied(explicit(top) / below)) for top in above)
        found.update(zip((rates[i] for i in block), solved, strict=True))
    return found


def _coupled(matrix: Matrix) -> list[list[int]]:
    blocks: list[set[int]] = []
    for i in range(matrix.rows):
        tied = {i, *(j for j in range(matrix.cols) if matrix[i, j] != 0)}
        joined = [block for block in blocks if block & tied]
        blocks = [block for block in blocks if not block & tied] + [tied.union(*joined)]
    return [sorted(block) for block in blocks]
