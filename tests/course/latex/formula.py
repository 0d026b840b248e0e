"""Formulas as the tests read them: the declared letters, and a text as if a file held it."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import Expr, ImmutableDenseMatrix, Symbol

from derive.algebra.dimensions import Dimension
from derive.algebra.expressions import explicit
from derive.course.arithmetic import Declared
from derive.course.latex import ReadMath, read_latex
from derive.course.yaml_tree import Scalar, Source
from derive.errors import Complaint, Rejected

KINDS = {
    **dict.fromkeys(["a", "b", "h", "l", "R", "r", "x", "y", "z", "r_C_x"], "length"),
    **dict.fromkeys(["M", "m"], "mass"),
    **dict.fromkeys(["theta", "phi"], "angle"),
    **dict.fromkeys(["omega", "omega_x", "omega_y", "omega_z", "S", "omega_0"], "angular speed"),
    **dict.fromkeys(["I_z", "I_y", "I_zz", "J_11", "I_disc", "I_y_rod"], "moment of inertia"),
    "rho": "density",
    "g": "acceleration",
    "t": "time",
    "n": "number",
}
LETTERS = {name: Declared(name, Symbol(name, real=True), kind) for name, kind in KINDS.items()}


def read(text: str, *, homogeneous: bool = True) -> ReadMath:
    return read_latex(Scalar(text, "", 0, len(text), Source("f.yaml", text)), LETTERS, homogeneous=homogeneous)


def value(text: str, branch: int = 0) -> Any:
    (side,) = read(text).sides
    entries = [explicit(expr) for expr, _ in side.branches[branch]]
    return ImmutableDenseMatrix(*side.shape, entries) if side.shape else entries[0]


def dimension(text: str) -> Dimension:
    ((entry,),) = read(text).sides[0].branches
    return entry[1]


def complaint(text: str) -> Complaint:
    with pytest.raises(Rejected) as caught:
        read(text)
    return caught.value.complaints[0]


def marked(text: str) -> tuple[str, str]:
    found = complaint(text)
    assert found.place is not None
    start = found.place.column - 1
    return found.code, text[start : start + found.place.width]


def letter(name: str) -> Expr:
    return LETTERS[name].symbol
