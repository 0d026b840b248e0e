"""Linear equations solved for unknowns: accelerations, tensions, multipliers or any other symbols."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from sympy import Expr, ImmutableDenseMatrix, Integer, Matrix, Symbol

from derive.algebra.expressions import Ratio, Relation
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.answers import claims
from derive.mechanics.arguments import checked
from derive.mechanics.in_results import Letters, in_results
from derive.solving.divisors import may_vanish
from derive.solving.elimination import Substitution, substitutions
from derive.solving.presentation import presented
from derive.solving.relations import conditions_told
from derive.solving.unknowns import (
    coordinates_of,
    kind_of_unknown,
    letter_of,
    linear_coefficients,
    meaning,
    polynomial_in,
    unknown_of,
)
from derive.steps.claims import says_what_it_divides_by
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.rule import CHECK, Rule
from derive.steps.step import Level, Quantity, is_zero
from derive.steps.subject import EVERYTHING

__all__ = ["solved_for"]

MOST = 6  # greatest number of unknowns
MOST_SUBSTITUTED = 2  # if more substitutions are needed, the sentence states none of them


def solved_for(
    equations: Quantity | Sequence[Quantity], *unknowns: Any, keys: Sequence[str] | None = None
) -> tuple[Quantity, ...]:
    """Solution of n linear equations for n unknowns by Cramer's rule, u_i = det A_i/det A; for one equation, u = -b/a.

    equations   one equation or several
    unknowns    letters, rates, accelerations (`x.acceleration`), or expressions such as `theta.rate**2`, `cos(theta)`
    keys        keys of the steps; by default the names of the unknowns, such as theta_ddot or cos_theta

    Check: all values substituted back into all equations; elimination of the unknowns one after another.
    Outcomes: alone (one equation), several (the first of several unknowns), following (a later unknown).
    Errors: the numbers of equations and of unknowns differ; there are more than six unknowns; the equations are not
    linear in the unknowns, or do not determine the unknowns.
    Source: Boas, *Mathematical Methods in the Physical Sciences*, section 3.3.
    """
    given = (equations,) if isinstance(equations, Quantity) else tuple(equations)
    wanted = [unknown_of("solved_for", each) for each in unknowns]
    _check_count(given, wanted)
    found = [polynomial_in("solved_for", equation, wanted) for equation in given]
    marks = found[0][1]
    residuals = [left.xreplace(dict(zip(own, marks, strict=True))) for left, own in found]
    system = linear_coefficients(residuals, marks)
    if system is None:
        names = ", ".join(str(u) for u in wanted)
        message = f"`solved_for`: {_named(given)} not linear in {names}"
        raise Rejected(Complaint("not-linear", message, help="`roots` solves a quadratic equation in one letter"))
    matrix, right = system
    determinant = tidied(matrix.det(method="berkowitz"))
    if is_zero(determinant):
        names = ", ".join(str(u) for u in wanted)
        message = f"`solved_for`: {_named(given, 'do', 'does')} not determine {names}"
        several = "one of the equations follows from the others, or they contradict each other"
        help_line = several if len(given) > 1 else "the coefficient of the unknown is zero in this equation"
        raise Rejected(Complaint("singular", message, help=help_line))
    values = eliminated(matrix, right)
    below = [tidied(value).as_numer_denom()[1] for value in values]  # the denominators must not vanish, either
    excluded = may_vanish(determinant, *below)
    called = list(keys or [_key_of(unknown) for unknown in wanted])
    if len(called) != len(wanted):
        raise Rejected(Complaint("wrong-argument", "`solved_for` needs as many keys as unknowns"))
    return tuple(
        _solution(given, wanted, i, matrix, right, residuals, marks, values, excluded, called[i])
        for i in range(len(wanted))
    )


SOLVED_FOR = Rule(
    "answers.solved_for",
    source="Boas, *Mathematical Methods in the Physical Sciences*, section 3.3",
    outcomes={
        "alone": claims.one_of(True, True),
        "several": claims.one_of(False, True),
        "following": claims.one_of(False, False),
    },
    evidence={"put_back": CHECK, "elimination": CHECK},
    statements=[says_what_it_divides_by],
    named={"unknown": claims.solved_for},
)


def _solution(
    given: tuple[Quantity, ...],
    wanted: Sequence[Expr],
    i: int,
    matrix: Matrix,
    right: Matrix,
    residuals: Sequence[Expr],
    marks: Sequence[Symbol],
    values: Sequence[Expr],
    excluded: Any,
    key: str,
) -> Quantity:
    above = matrix.copy()
    above[:, i] = right
    unknown = wanted[i]

    def put_back(found: Expr) -> tuple[Any, Any]:
        there = {mark: (found if j == i else values[j]) for j, mark in enumerate(marks)}
        return ImmutableDenseMatrix([each.xreplace(there) for each in residuals]), ImmutableDenseMatrix(
            [Integer(0)] * len(residuals)
        )

    known = coordinates_of(*given)
    told = () if i or not all(isinstance(each, Symbol) for each in wanted) else substitutions(residuals, marks[1:])
    told = told if len(told) <= MOST_SUBSTITUTED else ()
    used = [each.equation for each in told]
    order = [*used, *(n for n in range(len(given)) if n not in used)]
    return establish(
        SOLVED_FOR,
        unknown,
        lambda *_: Ratio(_written(above), _written(matrix)),
        {f"equation_{n}": given[at] for n, at in enumerate(order, 1)},
        lines=Lines(
            put_in=None,
            law=Level.FULL,
            arranged=presented,
            means={} if isinstance(unknown, Symbol) else meaning(unknown, values[i]),
        ),
        routes={"put_back": put_back, "elimination": lambda found: (found, values[i])},
        outcome=_which(len(wanted), i),
        key=key,
        kind=kind_of_unknown(unknown, known),
        phrase_data=PhraseData(
            formulas={
                **conditions_told(excluded=excluded),
                **_told(told, residuals, dict(zip(marks, wanted, strict=True))),
            },
            named={"unknown": unknown},
            outcome_data={"count": Integer(len(wanted)), "place": Integer(i)},
        ),
        parents=list(given),  # the page shows the equations in the given order
        scope=Scope(differ=EVERYTHING),
    )


def _told(
    made: Sequence[Substitution], residuals: Sequence[Expr], named: Mapping[Symbol, Expr]
) -> dict[str, tuple[Relation, Relation]]:
    """Return the substitutions for the sentence, each with the equation from which it follows."""
    done: dict[Symbol, Expr] = {}
    found = {}
    for n, each in enumerate(made, 1):
        row = residuals[each.equation]
        for unknown, value in done.items():
            row = row.xreplace({unknown: value})
        shown = Relation(named[each.unknown], "=", each.value.xreplace(named))
        found[f"gives_{n}"] = (shown, Relation(row.xreplace(named), "=", Integer(0)))
        done[each.unknown] = each.value
    return found


def _which(count: int, i: int) -> str:
    if count == 1:
        return "alone"
    return "several" if i == 0 else "following"


def _written(matrix: Matrix) -> Expr:
    return tidied(matrix.det(method="berkowitz"))


def eliminated(matrix: Matrix, right: Matrix) -> list[Expr]:
    """Solve by Gaussian elimination. For each unknown, choose the unused equation with the simplest coefficient of this
    unknown; then eliminate the unknown from all other equations."""
    rows = [[*(matrix[i, j] for j in range(matrix.cols)), right[i]] for i in range(matrix.rows)]
    n = matrix.cols
    for column in range(n):
        candidates = [k for k in range(column, n) if not is_zero(rows[k][column])]
        pivot = min(candidates, key=lambda k: int(rows[k][column].count_ops()))
        rows[column], rows[pivot] = rows[pivot], rows[column]
        head = rows[column][column]
        rows[column] = [tidied(entry / head) for entry in rows[column]]
        for k in range(n):
            if k != column and rows[k][column] != 0:
                times = rows[k][column]
                rows[k] = [tidied(a - times * b) for a, b in zip(rows[k], rows[column], strict=True)]
    return [row[n] for row in rows]


def _check_count(given: Sequence[Quantity], wanted: Sequence[Expr]) -> None:
    if not wanted or len(given) != len(wanted) or len(set(wanted)) < len(wanted):
        count = f"{len(given)} equation{'s' * (len(given) != 1)}"
        message = f"`solved_for` has {count} for {len(set(wanted))} unknown{'s' * (len(set(wanted)) != 1)}"
        raise Rejected(Complaint("wrong-argument", message, help="give as many equations as unknowns"))
    if len(wanted) > MOST:
        raise Rejected(Complaint("too-many", f"`solved_for` solves for at most {MOST} unknowns at once"))


def _named(given: Sequence[Quantity], several: str = "are", one: str = "is") -> str:
    return " and ".join(f"`{each.key}`" for each in given) + f" {several if len(given) > 1 else one}"


def _key_of(unknown: Expr) -> str:
    """Return the key of an unknown: theta_ddot, theta_dot_squared, cos_theta."""
    if isinstance(unknown, Symbol):
        return str(unknown.name)
    letter = letter_of(unknown)
    if unknown.is_Pow:
        return f"{letter.name}_squared" if unknown.exp == 2 else f"{letter.name}_power_{unknown.exp}"
    return f"{unknown.func}_{letter.name}"


@in_results(
    "solve",
    "the solution of linear equations",
    equations="solve: equations",
    unknowns="for: letters, rates, accelerations, forces",
)
def _in_results(equations: Sequence[Quantity], unknowns: Letters, key: str) -> tuple[Quantity, ...]:
    """The requested name is the key of a single unknown; several unknowns have numbered keys."""
    keys = [key] if len(unknowns) == 1 else [f"{key}_{i + 1}" for i in range(len(unknowns))]
    return checked(solved_for)(tuple(equations), *unknowns, keys=keys)
