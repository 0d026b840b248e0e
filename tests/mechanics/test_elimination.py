"""The order in which linear equations give their unknowns, and the sentences that name the equations."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from unicodedata import normalize

import pytest
from sympy import Integer, Symbol, symbols

import derive.steps.establish as establishing
from derive.building.solution import derived, rendered
from derive.course.problem import deriving, load_problem
from derive.mechanics.lagrange.claims import follows_from_these_equations, names_the_enforcer
from derive.mechanics.model.connection import PointForce
from derive.mechanics.model.constraint import Constraint
from derive.solving.elimination import Substitution, isolated_in_order, substitutions
from derive.steps.record import Run
from derive.steps.rule import Judged
from tests.courses import ROOT, rendered_once
from tests.figures.test_connected import BALL
from tests.stock.described import course_with

x, y, N, S = symbols("x_ddot y_ddot N S", real=True)
M, m, g, mu = symbols("M m g mu", positive=True)


def test_an_equation_with_one_unknown_comes_first_and_the_next_one_uses_it() -> None:
    """M x'' = mu N, M y'' = N - M g, y'' = 0."""
    found = isolated_in_order([M * x - mu * N, M * y - N + M * g, y], [x, y, N])
    assert list(found) == [N, x]
    assert found[N].equations == (1, 2) and found[N].value == M * g
    assert found[x].equations == (0,) and found[x].earlier == (N,) and found[x].value == mu * N / M


def test_coupled_equations_are_eliminated_for_the_first_unknown() -> None:
    """An Atwood machine: m x'' = m g - S, M y'' = M g - S, x'' + y'' = 0."""
    found = isolated_in_order([m * x - m * g + S, M * y - M * g + S, x + y], [x, y, S])
    assert list(found) == [x, y, S]
    assert found[x].eliminated == (y, S) and found[x].equations == (0, 1, 2)
    assert (found[y].equations, found[y].value) == ((2,), -x)
    assert (found[S].equations, found[S].value) == ((0,), m * (g - x))


def test_the_other_unknowns_are_substituted_one_after_the_other() -> None:
    """An Atwood machine: y'' = -x'', then S = m (g - x''), and only x'' is left."""
    found = substitutions([m * x - m * g + S, M * y - M * g + S, x + y], [y, S])
    assert found == (Substitution(2, y, -x), Substitution(0, S, m * (g - x)))
    assert substitutions([(M - m) * y + x, y - x * g], [y])[0].value == g * x
    assert substitutions([(M - m) * y + x, (M - m) * y - x * g], [y]) == ()


def test_no_step_divides_by_a_value_that_may_vanish() -> None:
    """(M - m) x'' = m g gives no acceleration for M = m."""
    assert isolated_in_order([(M - m) * x - m * g], [x]) == {}


def judged(problem_id: str, rule: str, root: Path = ROOT) -> list[Judged]:
    """Return what the predicates of the steps of a rule judged, if their sentences name equations."""
    found = []
    check = establishing._check_outcome

    def kept(key: str, own: object, outcome: str, facts: Judged, may_be_zero: bool) -> None:
        check(key, own, outcome, facts, may_be_zero)  # type: ignore[arg-type]
        if getattr(own, "name", "") == rule and "equation_1" in facts.quantities:
            found.append(facts)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(establishing, "_check_outcome", kept)
        derived(load_problem(root, problem_id))
    return found


@pytest.mark.parametrize(
    ("problem_id", "rule"),
    [("library/yoyo", "lagrange.acceleration"), ("library/yoyo", "lagrange.multiplier")],
)
def test_equations_that_do_not_give_the_result_are_refused(problem_id: str, rule: str) -> None:
    every = judged(problem_id, rule)
    assert every
    with deriving(load_problem(ROOT, problem_id), Run()):
        for facts in every:
            assert follows_from_these_equations(facts, "")
            assert not follows_from_these_equations(replace(facts, result=2 * facts.result), "")
            one = next(role for role in facts.quantities if role.startswith("equation_"))
            fewer = {role: q for role, q in facts.quantities.items() if role != one}
            if any(role.startswith("equation_") for role in fewer):
                assert not follows_from_these_equations(replace(facts, quantities=fewer), "")


def test_a_page_solves_equation_by_equation(tmp_path: Path) -> None:
    text = " ".join(rendered_once(ROOT, "library/sliding_to_rolling", only={"text"}).texts["text"].split())
    assert normalize("NFD", "With y = a and ÿ = 0, equation (2) gives * N = M g") in text
    assert normalize("NFD", "φ̈ = 5μ N/(2M a) * φ̈ = 5μ g/(2a)") in text


HINGED = """\
title: A rod on a hinge
solve: system
method: newton
symbols: {M: mass, l: length, g: acceleration}
given:
  coordinates: {x: length, y: length, theta: angle}
  bodies: {rod: {shape: rod, length: l, mass: M, centre: [x, y], along: [sin(theta), cos(theta)]}}
  gravity: g
  joints: {of: rod.end, to: [0, 0], force: R}
statement: A rod of mass <<M>> and length <<l>> is hinged to the ground at its lower end.
parts:
  - ask: Find the accelerations and the force of the hinge.
    answer: [acceleration_x, acceleration_theta, R_x, R_y]
"""


@pytest.mark.long
def test_a_sentence_names_the_earlier_unknowns_that_its_equations_contain(tmp_path: Path) -> None:
    """The torque about the centre of the rod contains both components of the force at the hinge."""
    root = course_with(tmp_path, HINGED)
    text = " ".join(rendered(root, "trial/one", only={"text"}).texts["text"].split())
    assert "and R_y from (2), (3) and (5) and substituting R_x gives" in text
    facts = next(each for each in judged("trial/one", "lagrange.acceleration", root) if "earlier_1" in each.quantities)
    without = {role: q for role, q in facts.quantities.items() if role != "earlier_1"}
    with deriving(load_problem(root, "trial/one"), Run()):
        assert follows_from_these_equations(facts, "")
        assert not follows_from_these_equations(replace(facts, quantities=without), "")


def test_a_constraint_is_differentiated_after_its_reason(tmp_path: Path) -> None:
    rolling = rendered(course_with(tmp_path, BALL), "trial/one", only={"text"})
    for page, reason in (
        (rendered_once(ROOT, "library/atwood", only={"text"}), "The length of the string is constant, "),
        (rolling, "At the contact the body and the surface have the same velocity, "),
    ):
        text = " ".join(page.texts["text"].split())
        assert reason in text and "Differentiating this" in text, text


def test_another_enforcer_than_that_of_the_constraint_is_refused() -> None:
    of = Constraint(x, Integer(0), N, in_rates=False, forces=(PointForce(N, (Integer(0), Integer(1)), None, None),))
    facts = Judged(None, {"condition": x, "of": replace(of, enforcer="surface")}, words={"enforcer": "surface"})
    assert names_the_enforcer(facts, "")
    for word in ("string", "friction"):
        assert not names_the_enforcer(replace(facts, words={"enforcer": word}), "")


def test_equations_that_an_acceleration_of_zero_links_are_all_named() -> None:
    """A block on a block on the floor: Y'' = 0 and Y'' - y'' = 0 give y'' = 0, and m y'' = P - m g gives P."""
    Y, P = symbols("Y_ddot P", real=True)
    found = isolated_in_order([m * y - P + m * g, M * Y - N + P + M * g, Y, Y - y], [y, Y, N, P])
    assert found[P].equations == (0, 2, 3) and found[P].value == m * g
    assert found[N].equations == (1, 2) and found[N].earlier == (P,)


def test_an_unknown_of_one_equation_is_not_eliminated() -> None:
    """The second equation gives x'' if a does not vanish, which is unknown; the first one alone contains S."""
    a = Symbol("a", real=True)
    assert isolated_in_order([m * x - S, a * x - g * a], [x, S]) == {}


BLOCKS = """\
title: Two blocks
solve: system
method: newton
symbols: {m: mass, M: mass, g: acceleration, h: length}
given:
  coordinates: {x: length, y: length, X: length, Y: length}
  particles: {upper: {mass: m, at: [x, y]}, lower: {mass: M, at: [X, Y]}}
  gravity: g
  surfaces: {floor: {through: [0, 0], along: [1, 0]}, top: {through: lower, along: [1, 0], of: lower}}
  contacts: [{of: upper, on: top, normal: P}, {of: lower, on: floor, normal: N}]
statement: A particle of mass <<m>> lies on one of mass <<M>>.
parts:
  - ask: Find the forces.
    answer: [N, P]
"""


def test_a_block_on_a_block(tmp_path: Path) -> None:
    text = " ".join(rendered(course_with(tmp_path, BLOCKS), "trial/one", only={"text"}).texts["text"].split())
    assert "P = m g" in text and "(M + m) g" in text, text
