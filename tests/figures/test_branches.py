"""The branches of a bifurcation diagram, and their comparison with the potential energy."""

from __future__ import annotations

from dataclasses import replace

import pytest
from sympy import Integer, Symbol, cos, pi, sin, sqrt

from derive.algebra.expressions import Relation
from derive.errors import Rejected, Unverified
from derive.figures.branches import bifurcations_of
from derive.figures.marks import Branch, Diagram

X = Symbol("x", real=True)
Q = Symbol("q", real=True)
M = Symbol("m", positive=True)
POSITIVE, NEGATIVE = Relation(X, ">", 0), Relation(X, "<", 0)
PITCHFORK = Diagram(
    (
        Branch(Symbol("q_1"), Integer(0), None, NEGATIVE, "rest_1"),
        Branch(Symbol("q_2"), sqrt(X), POSITIVE, True, "rest_2"),
        Branch(Symbol("q_3"), -sqrt(X), POSITIVE, True, "rest_3"),
    ),
    M * (Q**4 / 4 - X * Q**2 / 2),
    Q,
    X,
)


def test_a_branch_begins_and_another_changes_where_the_conditions_do() -> None:
    found = bifurcations_of(PITCHFORK, X, (-1.0, 4.0), {})
    assert [(line.of, line.is_stable) for line in found.lines] == [(0, True), (0, False), (1, True), (2, True)]
    (change,) = found.changes
    assert change.at == pytest.approx(0, abs=1e-9)
    assert change.places == pytest.approx((0,), abs=1e-4)
    assert (found.low, found.high) == pytest.approx((-2, 2))
    assert found.lines[2].points[-1] == pytest.approx((4, 2))


def test_a_line_ends_at_the_end_of_the_axis() -> None:
    found = bifurcations_of(PITCHFORK, X, (-1.0, 4.0), {}, (-0.5, 1.0))
    upper = next(line for line in found.lines if line.of == 1)
    assert upper.points[-1] == pytest.approx((1, 1), abs=1e-2)


def test_nothing_changes_in_a_range() -> None:
    with pytest.raises(Rejected, match="changes its stability for values of the parameter from 1 to 4"):
        bifurcations_of(PITCHFORK, X, (1.0, 4.0), {})


@pytest.mark.parametrize(
    ("branches", "said"),
    [
        ((replace(PITCHFORK.branches[0], stable=POSITIVE), *PITCHFORK.branches[1:]), "has a minimum there"),
        ((PITCHFORK.branches[0], replace(PITCHFORK.branches[1], stable=False), PITCHFORK.branches[2]), "a minimum"),
        (PITCHFORK.branches[:2], "2 equilibria, but the slope of the potential energy has 3 zeros"),
        ((PITCHFORK.branches[0], replace(PITCHFORK.branches[1], exists=None), PITCHFORK.branches[2]), ""),
        (
            (PITCHFORK.branches[0], replace(PITCHFORK.branches[1], place=X), PITCHFORK.branches[2]),
            "an equilibrium where the potential energy is not stationary",
        ),
    ],
)
def test_wrong_branches_are_refused(branches: tuple[Branch, ...], said: str) -> None:
    if not said:  # a value that is not real is not drawn
        assert bifurcations_of(replace(PITCHFORK, branches=branches), X, (-1.0, 4.0), {}).changes
        return
    with pytest.raises(Unverified, match=said):
        bifurcations_of(replace(PITCHFORK, branches=branches), X, (-1.0, 4.0), {})


def test_angles_that_differ_by_a_turn_are_one() -> None:
    """U = -cos q - x sin(q)^2/2 has the equilibria 0 and pi, and for x > 1 two others."""
    from sympy import acos

    more = Relation(X, ">", 1)
    branches = (
        Branch(Symbol("q_1"), Integer(0), None, Relation(X, "<", 1), "rest_1"),
        Branch(Symbol("q_2"), pi, None, False, "rest_2"),
        Branch(Symbol("q_3"), acos(1 / X), more, True, "rest_3"),
        Branch(Symbol("q_4"), -acos(1 / X), more, True, "rest_4"),
    )
    diagram = Diagram(branches, -cos(Q) - X * sin(Q) ** 2 / 2, Q, X)
    assert len(bifurcations_of(diagram, X, (0.1, 3.0), {}, is_angle=True).changes) == 1
    twice = replace(diagram, branches=(*branches, Branch(Symbol("q_5"), -pi, None, False, "rest_5")))
    assert bifurcations_of(twice, X, (0.1, 3.0), {}, is_angle=True).lines
    with pytest.raises(Unverified):
        bifurcations_of(replace(diagram, branches=branches[:3]), X, (0.1, 3.0), {}, is_angle=True)
