"""A node that is carried out wrongly is refused, and definitions alone have no second route.

Wrong laws and wrong second routes are made by machine: see `tests/mutation`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from sympy import Integer

import derive.mechanics
from derive.algebra import expressions as ex
from derive.algebra import node as node_module
from derive.algebra.equality import Grade
from derive.errors import Unverified
from tests.mechanics.block import block_derivation, known_block
from tests.mechanics.verbs import verbs_as_imported


def test_definitions_alone_have_no_second_route() -> None:
    found = [*known_block().values(), derive.mechanics.let("half", lambda T: T / 2, known_block()["kinetic_energy"])]
    without = {q.step.rule for q in found if {e.grade for e in q.step.evidence} == {Grade.DEFINITION}}
    assert without == {"rotation.any_angular_velocity", "bodies.axis_vector", "rotation.inertia_definition"}
    assert {q.key for q in found if any(e.grade is Grade.DEFINITION for e in q.step.evidence)} == {
        "angular_velocity",
        "axis_vector",
        "corner_tensor_definition",
        "half",
    }


WRONG_NODES: list[tuple[Any, Callable[..., Any]]] = [
    (ex.Dot, lambda self, u, v: 2 * sum(x * y for x, y in zip(u, v, strict=True))),
    (ex.Dot, lambda self, u, v: -sum(x * y for x, y in zip(u, v, strict=True))),
    (ex.Dot, lambda self, u, v: u[0] * v[0] + u[1] * v[1]),
    (ex.Norm, lambda self, v: sum(x**2 for x in v)),
    (ex.Norm, lambda self, v: sum(abs(x) for x in v)),
    (ex.Cross, lambda self, u, v: ex.column(*(-x for x in (ex.Matrix(u).cross(ex.Matrix(v)))))),
    (ex.Cross, lambda self, u, v: 2 * ex.column(*(ex.Matrix(u).cross(ex.Matrix(v))))),
    (ex.Outer, lambda self, u, v: 2 * ex.Matrix(u) * ex.Matrix(v).T),
    (ex.CarriedRate, lambda self, A, w: ex.column(*(ex.Matrix(A).cross(ex.Matrix(w))))),
    (ex.Factors, lambda self, *factors: sum(factors, Integer(0))),
    (ex.Terms, lambda self, *terms: terms[0]),
    (ex.Ratio, lambda self, above, below: above * below),
    (ex.Root, lambda self, inside: inside),
    (ex.Group, lambda self, inner: 2 * inner),
]


@pytest.mark.parametrize(
    ("node", "wrong"), [pytest.param(*row, id=f"{row[0].__name__}-{i}") for i, row in enumerate(WRONG_NODES)]
)
def test_a_node_that_is_carried_out_wrongly_is_refused(
    node: Any, wrong: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    known_block()
    monkeypatch.setattr(node, "_evaluated", wrong)
    node_module._carried_out.cache_clear()
    try:
        with pytest.raises(Unverified):
            block_derivation(verbs_as_imported())
    finally:
        monkeypatch.undo()
        node_module._carried_out.cache_clear()
