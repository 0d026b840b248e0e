"""Principal moments and principal axes: for a rotation about a principal axis, L is parallel to omega.

An inertia tensor has three perpendicular principal axes, I e_k = I_k e_k. If two moments are equal, every axis in the
plane of their axes is a principal axis; if all three are equal, every axis is a principal axis.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from sympy import (
    Expr,
    Identity,
    ImmutableDenseMatrix,
    Integer,
    MatAdd,
    MatMul,
    MatrixBase,
    MatrixSymbol,
    Poly,
    Pow,
    Symbol,
    cos,
    sin,
    sqrt,
)

from derive.algebra.amplitudes import Determinant
from derive.algebra.expressions import Dot, Factors, Relation, Terms, column, explicit, scalar, vector
from derive.algebra.tidy import factored_matrix, tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.bodies.facts import OfBody
from derive.mechanics.rotation import claims
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.rule import CHECK, Rule, Shown
from derive.steps.step import Fact, Quantity, is_zero, require_kind

__all__ = ["principal_axes", "principal_moments"]


@dataclass(frozen=True)
class PrincipalOf(Fact):
    """The tensor from which principal moments were derived."""

    missing = "is not a result of `principal_moments`"
    tensor: Quantity


PRINCIPAL_MOMENTS = Rule(
    "rotation.principal_moments",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.4",
    outcomes={
        "isotropic": claims.moments(1, diagonal=True),
        "two_equal": claims.moments(2, diagonal=True),
        "distinct": claims.moments(3, diagonal=True),
        "two_equal_roots": claims.moments(2, diagonal=False),
        "roots": claims.moments(3, diagonal=False),
    },
    evidence={"invariants": CHECK, "axis_by_axis": CHECK},
    statements=[claims.vanish_again],
    named={"equation": claims.characteristic_equation},
    shown=Shown(
        result_in=dict.fromkeys(("isotropic", "two_equal", "distinct"), ("rotation.entry", "rotation.entry_moved"))
    ),
)


def principal_moments(inertia: Quantity, symbol: str = "I", key: str = "principal_moments") -> Quantity:
    """Principal moments of inertia: the three roots of det(I - lambda 1) = 0.

    inertia   symmetric tensor (3, 3), kg m^2

    The moments of a diagonal tensor are in the order of the axes. Other moments are in the order of their values with
    every symbol equal to 1, the smallest first.
    Check: I_1 + I_2 + I_3, I_1 I_2 + I_1 I_3 + I_2 I_3 and I_1 I_2 I_3 are the invariants of the tensor. For a diagonal
    tensor, also I e = I_k e for the unit vector e of each axis.
    Outcomes: isotropic (all equal), two_equal, distinct; if the tensor is not diagonal, two_equal_roots, roots.
    Errors: the characteristic polynomial is a cubic without a rational factor, so its roots have no useful closed form;
    `inertia` is not an inertia tensor.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.4.
    """
    require_kind("principal_moments", "inertia", inertia, "moment of inertia")
    roots = _roots(inertia)
    names = column(*(scalar(f"{symbol}_{k}") for k in (1, 2, 3)))

    def law(tensor: Any) -> Any:
        if not inertia.value.is_diagonal():
            return roots
        whole = _by_entries(inertia) if isinstance(tensor, MatrixSymbol) else tensor
        return column(*(whole[k, k] for k in range(3)))

    def axis_by_axis(found: Any) -> tuple[Any, Any]:
        """Compare the tensor times the unit vector of each axis with the moment times this vector."""
        units = ImmutableDenseMatrix.eye(3)
        return inertia.value * units, ImmutableDenseMatrix.hstack(*(found[k] * units[:, k] for k in range(3)))

    return establish(
        PRINCIPAL_MOMENTS,
        names,
        law,
        {"inertia": inertia},
        routes={
            "invariants": lambda found: (column(*_symmetric_sums(found)), column(*_invariants(inertia.value))),
            **({"axis_by_axis": axis_by_axis} if inertia.value.is_diagonal() else {}),
        },
        parents=[parent for parent in inertia.parents if parent.symbol in _by_entries(inertia).free_symbols],
        outcome=_multiplicity if inertia.value.is_diagonal() else _multiplicity_of_roots,
        kind="moment of inertia",
        lines=Lines(put_in=None),
        phrase_data=PhraseData(
            words={"seen": "kept" if _was_diagonal(inertia) else "first"},
            named={} if inertia.value.is_diagonal() else {"equation": _characteristic_equation(inertia, roots)},
        ),
        facts=[*inertia.facts, PrincipalOf(inertia)],
        key=key,
    )


def _characteristic_equation(inertia: Quantity, roots: Any) -> Relation:
    """Return det(I - lambda 1) = product = 0 for a tensor that is not diagonal.

    If one axis is principal, the product has one factor for this axis and one for the plane of the other two axes.
    Otherwise the polynomial is factored as far as its coefficients permit.
    """
    before = [inertia, *inertia.ancestors()]
    taken = {getattr(letter, "name", "") for each in before for form in each.step.chain for letter in _letters(form)}
    unknown = scalar(next(name for name in ("lambda", "kappa", "xi") if name not in taken))
    tensor = inertia.value

    def minus_unknown(moment: Expr) -> Expr:
        return Terms(moment, -unknown)

    alone = next((k for k in range(3) if all(tensor[k, i] == 0 for i in range(3) if i != k)), None)
    if alone is not None:
        i, j = (k for k in range(3) if k != alone)
        diagonal = _product([minus_unknown(tensor[i, i]), minus_unknown(tensor[j, j])])
        factors = [minus_unknown(tensor[alone, alone]), Terms(diagonal, -tidied(tensor[i, j] ** 2))]
    else:
        plain = [root for root in roots if not _has_root(root)]
        factors = [minus_unknown(root) for root in plain]
        if len(plain) == 1:
            one, other = (root for root in roots if _has_root(root))
            factors.append(Terms(unknown**2, -tidied(one + other) * unknown, tidied(one * other)))
    matrix = MatAdd(inertia.symbol, MatMul(-unknown, Identity(3)))
    return Relation(Relation(Determinant(matrix), "=", _product(factors)), "=", Integer(0))


def _letters(form: Any) -> set[Any]:
    return getattr(form.expr, "free_symbols", set())


def _has_root(value: Expr) -> bool:
    return any(not power.exp.is_Integer for power in value.atoms(Pow))


def _product(factors: Sequence[Expr]) -> Expr:
    found = [
        Pow(factor, factors.count(factor), evaluate=False) if factors.count(factor) > 1 else factor
        for factor in dict.fromkeys(factors)
    ]
    return Factors(*found) if len(found) > 1 else found[0]


def _was_diagonal(inertia: Quantity) -> bool:
    """Whether the tensor was derived from a diagonal tensor about another point of a round body."""
    return inertia.step.rule == "rotation.moved_to" and inertia.step.outcome in {"round", "round_isotropic"}


def principal_axes(
    moments: Quantity, symbol: str = "e", key: str = "principal_axis"
) -> tuple[Quantity, Quantity, Quantity]:
    """Principal axes, a right-handed set of unit vectors with I e_k = I_k e_k.

    moments   the principal moments of a tensor

    If two moments are equal, the unit vectors of their axes contain a free angle; if all three are equal, any three
    perpendicular axes are principal axes.
    Check: each vector satisfies I e = I_k e; the vectors have length 1, are perpendicular and right-handed.
    Outcomes: single (the axis of the moment that differs from two equal ones), symmetry (this axis of a round body),
    free (an axis of one of the two equal moments), any (all three moments are equal), distinct.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.4.
    """
    found, angle = _frame(moments)
    alone = lone_moment(moments.value)
    first = alone if alone is not None else 0
    order = [first, *(k for k in range(3) if k != first)]
    axes: dict[int, Quantity] = {}
    for place, k in enumerate(order):
        axes[k] = _axis(moments, found[k], angle, k, place, list(axes.values()), symbol, key)
    return axes[0], axes[1], axes[2]


PRINCIPAL_AXIS = Rule(
    "rotation.principal_axis",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.4",
    outcomes={
        "single": claims.axis_of(2, alone=True),
        "symmetry": claims.axis_of_symmetry,
        "free": claims.axis_of(2, alone=False),
        "any": claims.axis_of(1),
        "distinct": claims.axis_of(3),
    },
    evidence={"put_back": CHECK, "unit": CHECK, "perpendicular": CHECK, "right_handed": CHECK},
)


def _axis(
    moments: Quantity,
    direction: Any,
    angle: Symbol,
    k: int,
    place: int,
    before: list[Quantity],
    symbol: str,
    key: str,
) -> Quantity:
    tensor = moments.needed(PrincipalOf).tensor
    is_free = direction.has(angle)
    return establish(
        PRINCIPAL_AXIS,
        vector(f"{symbol}_{k + 1}"),
        lambda *_: direction,
        {"moments": moments, **({"angle": angle} if is_free else {})},
        routes={
            "put_back": lambda e: (tensor.value * e, moments.value[k] * e),
            "unit": lambda e: (Dot(e, e), Integer(1)),
            "perpendicular": lambda e: (column(*_products(e, before)), column(0, 0, 0)),
            **({"right_handed": lambda e: (_volume(k, e, before), Integer(1))} if len(before) == 2 else {}),
        },
        outcome=_axis_outcome(moments, place),
        kind="number",
        lines=Lines(put_in=None),
        parents=[tensor, *before],
        scope=Scope(coordinates={angle: "angle"} if is_free else {}),
        key=f"{key}_{k + 1}",
    )


def _axis_outcome(moments: Quantity, place: int) -> str:
    different = _number_of_different(moments.value)
    if different == 1:
        return "any"
    if different == 3:
        return "distinct"
    if place:
        return "free"
    return "symmetry" if _is_round(moments) else "single"


def _is_round(moments: Quantity) -> bool:
    """Whether the body is round about z, and z is the axis of the moment that differs from the two equal ones."""
    of, tensor = moments.fact(OfBody), moments.needed(PrincipalOf).tensor.value
    return (
        of is not None
        and tensor.is_diagonal()
        and getattr(of.body, "is_round", False)
        and lone_moment(moments.value) == 2
    )


def _products(e: Any, before: list[Quantity]) -> list[Expr]:
    found = [explicit(Dot(e, other.value)) for other in before]
    return [*found, *[Integer(0)] * (3 - len(found))]


def _volume(k: int, e: Any, before: list[Quantity]) -> Expr:
    """Return e_1 . (e_2 x e_3), which is 1 for right-handed, perpendicular unit vectors."""
    named = {int(other.symbol.name[-1]) - 1: other.value for other in before} | {k: e}
    return explicit(ImmutableDenseMatrix.hstack(*(ImmutableDenseMatrix(named[i]) for i in range(3)))).det()


def _number_of_different(moments: Any) -> int:
    different: list[Expr] = []
    for moment in moments:
        if not any(is_zero(moment - other) for other in different):
            different.append(moment)
    return len(different)


def _multiplicity(moments: Any) -> str:
    return {1: "isotropic", 2: "two_equal"}.get(_number_of_different(moments), "distinct")


def _multiplicity_of_roots(moments: Any) -> str:
    return "two_equal_roots" if _number_of_different(moments) == 2 else "roots"


def lone_moment(moments: Any) -> int | None:
    """Return the index of the moment that differs from the two equal ones; None if there is no such moment."""
    if _number_of_different(moments) != 2:
        return None
    for k in range(3):
        i, j = (other for other in range(3) if other != k)
        if is_zero(moments[i] - moments[j]):
            return k
    return None


def _by_entries(inertia: Quantity) -> Any:
    formula = inertia.step.chain[0].expr
    return formula if isinstance(formula, MatrixBase) else inertia.value


def _symmetric_sums(m: Any) -> tuple[Expr, Expr, Expr]:
    return m[0] + m[1] + m[2], m[0] * m[1] + m[0] * m[2] + m[1] * m[2], m[0] * m[1] * m[2]


def _invariants(t: Any) -> tuple[Expr, Expr, Expr]:
    """Return trace, sum of the principal minors, and determinant: the invariants under rotations of the axes."""
    minors = sum((t[i, i] * t[j, j] - t[i, j] * t[j, i] for i, j in ((0, 1), (0, 2), (1, 2))), Integer(0))
    return t.trace(), minors, explicit(ImmutableDenseMatrix(t)).det(method="berkowitz")


def _roots(inertia: Quantity) -> Any:
    """Return the eigenvalues, for a diagonal tensor in the order of its axes, otherwise in the order of `_size`."""
    if inertia.value.is_diagonal():
        return column(*(inertia.value[k, k] for k in range(3)))
    common, rest = factored_matrix(inertia.value)
    unknown = Symbol("lambda_root", real=True)
    polynomial = (rest - unknown * ImmutableDenseMatrix.eye(3)).det(method="berkowitz")
    found: list[Expr] = []
    for part, times in Poly(polynomial, unknown).factor_list()[1]:
        if part.degree() > 2:
            message = f"the principal moments of `{inertia.key}` are roots of a cubic without a rational factor"
            raise Rejected(Complaint("no-closed-form", message, help="use a tensor about a point of higher symmetry"))
        found += [common * root for root in _of_low_degree(part) for _ in range(times)]
    return column(*sorted((tidied(root) for root in found), key=_size))


def _of_low_degree(part: Poly) -> list[Expr]:
    if part.degree() == 1:
        a, b = part.all_coeffs()
        return [-b / a]
    a, b, c = part.all_coeffs()
    inside = sqrt(b**2 - 4 * a * c)
    return [(-b - inside) / (2 * a), (-b + inside) / (2 * a)]


def _size(root: Expr) -> tuple[float, str]:
    """Return a sort key: the value with every symbol equal to 1, then the text."""
    return _number(root), str(root)


def _number(value: Expr) -> float:
    return float(value.subs(dict.fromkeys(value.free_symbols, 1)))


def _frame(moments: Quantity) -> tuple[list[Any], Symbol]:
    """Return three principal unit vectors, and the free angle that two of them contain if their moments are equal."""
    tensor = moments.needed(PrincipalOf).tensor.value
    taken = {letter.name for letter in tensor.free_symbols}
    angle = scalar(next(name for name in ("phi", "psi", "chi", "alpha") if name not in taken))
    if tensor.is_diagonal():
        frame = [column(*(int(i == k) for i in range(3))) for k in range(3)]
    else:
        frame = _eigenvectors(tensor, moments.value)
    alone = lone_moment(moments.value)
    if alone is not None:
        i, j = (alone + 1) % 3, (alone + 2) % 3
        u, v = frame[i], frame[j]
        frame[i], frame[j] = cos(angle) * u + sin(angle) * v, -sin(angle) * u + cos(angle) * v
    return [ImmutableDenseMatrix(e) for e in frame], angle


def _eigenvectors(tensor: Any, moments: Any) -> list[Any]:
    """Return the unit eigenvectors.

    The eigenvector of a moment that equals no other moment is perpendicular to the rows of I - I_k 1.
    """
    alone = lone_moment(moments)
    first = alone if alone is not None else 0
    i, j = (first + 1) % 3, (first + 2) % 3
    frame: dict[int, Any] = {first: _null_vector(tensor, moments[first])}
    if alone is None:
        frame[i] = _null_vector(tensor, moments[i])
    else:
        frame[i] = _unit(next(v for v in (_across(frame[first], a) for a in range(3)) if not is_zero(v)))
    frame[j] = ImmutableDenseMatrix(frame[first].cross(frame[i]).applyfunc(tidied))
    if alone is None:
        last = _null_vector(tensor, moments[j])
        frame[j] = last if _number(last.dot(frame[j])) > 0 else -last
    return [frame[k] for k in range(3)]


def _across(e: Any, axis: int) -> Any:
    return ImmutableDenseMatrix(e.cross(column(*(int(k == axis) for k in range(3)))))


def _null_vector(tensor: Any, moment: Expr) -> Any:
    rows = (tensor - moment * ImmutableDenseMatrix.eye(3)).applyfunc(tidied)
    for i, j in ((0, 1), (0, 2), (1, 2)):
        v = ImmutableDenseMatrix(rows[i, :].cross(rows[j, :]).T.applyfunc(tidied))
        if not is_zero(v):
            return _unit(v)
    raise AssertionError("for a single root I_k, two rows of I - I_k 1 are independent")


def _unit(v: Any) -> Any:
    _, rest = factored_matrix(v)
    length = sqrt(sum((x**2 for x in rest), Integer(0)))
    return ImmutableDenseMatrix((rest / length).applyfunc(tidied))
