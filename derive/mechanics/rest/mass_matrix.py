"""The mass matrix of a system at given coordinates: whether it has an inverse, and whether it is positive definite.

M_ij is the factor of the rate of q_j in the momentum p_i. If M has an inverse in general, but not at some values of the
coordinates, the coordinates are singular there. They then do not determine how the system leaves these values.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from mpmath import mp
from sympy import Expr, ImmutableDenseMatrix, Integer, MatrixBase, Rational, Symbol, re

from derive.algebra.amplitudes import determinant_of
from derive.algebra.definite import leading_minors
from derive.algebra.derivatives import derivative
from derive.algebra.expressions import explicit, rate
from derive.algebra.ranges import rational_in_range
from derive.algebra.singular import has_no_value
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.lagrange.facts import Varied
from derive.mechanics.model.dalembert import Matter
from derive.steps.signs import taken_positive
from derive.steps.step import is_zero

DIGITS = 40
SMALL = 25  # a determinant counts as zero below 10^-SMALL times the product of the largest entries of all rows


def mass_matrix(matter: Matter, coordinates: Sequence[Symbol]) -> MatrixBase:
    """Return the mass matrix dp_i/dq_dot_j at rest."""
    still = {rate(q): Integer(0) for q in matter.coordinates}
    momenta = [explicit(matter.momentum_along(q)) for q in coordinates]
    return ImmutableDenseMatrix([[derivative(p, rate(q)).xreplace(still) for q in coordinates] for p in momenta])


def check_regular(verb: str, matter: Matter | None, place: Mapping[Symbol, Expr]) -> None:
    """Reject values of the coordinates at which the coordinates are singular.

    A coordinate without a value in `place` may have any value and is not checked.
    """
    held = [q for q in place if matter is not None and q in matter.coordinates]
    if matter is None or not held:
        return
    matrix = mass_matrix(matter, held)
    there = ImmutableDenseMatrix(matrix.xreplace(dict(place)))
    if not has_no_value(there):
        if not _may_be_singular(there) or not is_zero(determinant_of(there.applyfunc(tidied))):
            return
        if _may_be_singular(matrix):  # M has no inverse anywhere, because a coordinate has no inertia
            return
    where = ", ".join(f"{q} = {value}" for q, value in place.items())
    message = f"`{verb}`: the coordinates are singular at {where}: the mass matrix has no inverse there"
    help_line = "use coordinates that are regular there, such as Cartesian coordinates"
    raise Rejected(Complaint("singular-coordinates", message, help=help_line))


def _may_be_singular(matrix: MatrixBase) -> bool:
    letters = sorted(matrix.free_symbols, key=str)
    numbers = {s: rational_in_range(s, Rational(11 + 7 * i, 13 + 3 * i)) for i, s in enumerate(letters)}
    with mp.workdps(DIGITS):
        entries = [mp.mpf(str(re(entry.xreplace(numbers).evalf(DIGITS)))) for entry in matrix]
        size = matrix.shape[0]
        found = mp.matrix([entries[size * i : size * (i + 1)] for i in range(size)])
        scales = [max(abs(found[i, j]) for j in range(size)) for i in range(size)]
        return not all(scales) or bool(abs(mp.det(found)) <= mp.fprod(scales) * mp.mpf(10) ** -SMALL)


def has_positive_inertia(matter: Matter, place: Mapping[Symbol, Expr]) -> bool:
    """Whether the kinetic energy is positive for every motion through the given values of the coordinates.

    The kinetic energy of a `System` is taken to be positive, because its masses are positive. For a given Lagrangian
    the sign may depend on the symbols; then the kinetic energy is taken to be positive, and the page states this
    condition.
    """
    if not isinstance(matter, Varied):
        return True
    matrix = mass_matrix(matter, matter.coordinates).xreplace(dict(place)).applyfunc(tidied)
    return all(taken_positive(minor) == 1 for minor in leading_minors(matrix))
