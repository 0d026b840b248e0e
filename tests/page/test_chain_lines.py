"""Tests of the lines of a step on a page, and of two steps in one row."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from sympy import Matrix, Symbol, sqrt

from derive.page.chain_lines import ChainLine, ChainWriter, Equations, _share_a_sum_or_root
from derive.page.repeated_formulas import results
from derive.page.template import templates_of
from derive.page.wording import Ref, phrases
from derive.steps.step import Level, Step
from tests.courses import ROOT, course_in, rendered_once, solved_once

WORDS = phrases(templates_of(ROOT))
x, y = Symbol("x"), Symbol("y")


def test_only_the_first_line_has_the_left_side(tmp_path: Path) -> None:
    _, solved = solved_once(course_in(tmp_path), "hw9/block")
    writer = ChainWriter(solved.derivation, solved.values, WORDS, {}, {})
    step = solved.derivation.step("torque")
    first, *others = writer.of(step)
    assert first.left == step.symbol
    assert [line.left for line in others] == [None] * len(others)
    (alone,) = writer.of(step, "result")
    assert (alone.left, alone.right) == (step.symbol, step.result)


def test_the_only_line_of_a_scalar_has_tangents_as_a_result_has(tmp_path: Path) -> None:
    _, solved = solved_once(course_in(tmp_path), "hw9/block")
    writer = ChainWriter(solved.derivation, solved.values, WORDS, {}, {})
    step = next(step for step in solved.derivation.steps if isinstance(step.symbol, Symbol))
    alone = replace(step, chain=(replace(step.chain[-1], because="law"),))
    assert [line.presented for line in writer.of(alone)] == [True]


def test_a_reason_names_each_number_once(tmp_path: Path) -> None:
    """Two steps that share a row have one number."""
    _, solved = solved_once(course_in(tmp_path), "hw9/block")
    step = solved.derivation.step("torque")
    for numbers, named in (({"spin": 3, "angular_momentum": 4}, 2), ({"spin": 3, "angular_momentum": 3}, 1)):
        writer = ChainWriter(solved.derivation, solved.values, WORDS, {}, numbers)
        counts = [sum(isinstance(node, Ref) for node in line.reason) for line in writer.of(step)]
        assert max(counts) == named
    silent = ChainWriter(solved.derivation, solved.values, WORDS, {}, {})
    assert not any(isinstance(node, Ref) for line in silent.of(step) for node in line.reason)


def test_equations_beside_each_other_have_the_number_of_the_first() -> None:
    one, other = (Equations(name, (ChainLine(Symbol(name), "equals", x),), i) for i, name in enumerate("ab", 1))
    both = one.beside(other)
    assert (both.key, both.number) == ("a", 1)
    assert [line.beside for line in both.lines] == [False, True]


def test_decimals_are_the_result_with_what_they_are_of(tmp_path: Path) -> None:
    _, solved = solved_once(course_in(tmp_path), "hw9/block")
    step = solved.derivation.step("torque")
    exact, numeric = ChainLine(None, "equals", x), ChainLine(None, "approx", y, numeric=True)
    assert results(step, (exact,)) == 1
    assert results(step, (exact, exact, numeric)) == 2


def test_a_reason_names_the_entries_of_a_vector_that_is_not_shown_but_only_those_it_uses(tmp_path: Path) -> None:
    _, solved = solved_once(course_in(tmp_path, problem="cone"), "hw9/cone")
    keys = {step.symbol: step.key for step in solved.derivation.steps if step.rule == "bodies.centre_component"}
    (component, *_) = keys.values()
    across, along = (solved.derivation.step(f"inertia_tensor_{axis}") for axis in ("xx", "zz"))
    numbers = {"apex_tensor_xx": 1, "apex_tensor_zz": 2, component: 3}
    writer = ChainWriter(solved.derivation, solved.values, WORDS, {}, numbers)

    def named(step: Step) -> set[str]:
        return {node.key for line in writer.of(step) for node in line.reason if isinstance(node, Ref)}

    assert named(across) == {"apex_tensor_xx", component}
    assert component not in named(along), "the axis is the same: no distance occurs"


def test_a_reason_may_name_the_equation_of_a_role(tmp_path: Path) -> None:
    _, solved = solved_once(course_in(tmp_path, problem="centred"), "hw9/centred")
    numbers = {"inertia_tensor": 1, "spin": 2, "angular_momentum": 3}
    writer = ChainWriter(solved.derivation, solved.values, WORDS, {}, numbers)
    torque = solved.derivation.step("torque")
    standard = replace(torque, chain=tuple(form for form in torque.chain if Level.STANDARD.shows(form.level)))
    last = [line.reason for line in writer.of(standard) if line.reason][-1]
    assert [node.key for node in last if isinstance(node, Ref)] == ["inertia_tensor", "spin"]


def test_a_sum_that_all_components_share_is_in_front_of_the_vector() -> None:
    """The special case of a vector has only one line, and its left side is on this line."""
    page = rendered_once(ROOT, "hw9/block", only={"text"}).texts["text"]
    assert "= M a c (a² - c²) ω²/(12(2a² + c²)) (1, -1, 0)" in page


def test_a_root_that_all_components_share_is_printed_in_front_of_the_vector() -> None:
    assert _share_a_sum_or_root(Matrix([-1 / sqrt(2), 1 / sqrt(2), 0]))
    assert not _share_a_sum_or_root(Matrix([x / 2, y / 2, 0]))
    assert not _share_a_sum_or_root(Matrix([0, sqrt(2), 0]))
