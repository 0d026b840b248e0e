"""Lines with the value of a name put in: each is compared with the line it was, and a wrong value is refused."""

from __future__ import annotations

from dataclasses import replace

import pytest
from sympy import Integer, Symbol

from derive.algebra.equality import Compared, Grade
from derive.algebra.expressions import Truncated
from derive.errors import Unverified
from derive.steps.condensing import condensed
from derive.steps.step import NUMBERS, Form, Step
from tests.courses import course_in, solved_once


@pytest.fixture(scope="module")
def steps(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Step]:
    _, solved = solved_once(course_in(tmp_path_factory.mktemp("slab"), problem="slab"), "hw9/slab")
    return {step.key: step for step in solved.derivation.steps}


def test_the_value_stands_where_the_letter_stood(steps: dict[str, Step]) -> None:
    square, energy = steps["squared_speed"], steps["kinetic_energy"]
    written = condensed(energy, {square.symbol: square})
    assert any(form.expr.has(square.symbol) for form in energy.chain)
    assert not any(form.expr.has(square.symbol) for form in written.chain)
    assert written.result == energy.result


def test_lines_that_have_become_the_same_stand_once(steps: dict[str, Step]) -> None:
    square, energy = steps["squared_speed"], steps["kinetic_energy"]
    written = condensed(energy, {square.symbol: square})
    assert len({form.expr for form in written.chain}) == len(written.chain) < len(energy.chain)


def test_each_line_that_was_changed_has_evidence_of_its_own(steps: dict[str, Step]) -> None:
    square, energy = steps["squared_speed"], steps["kinetic_energy"]
    written = condensed(energy, {square.symbol: square})
    (added,) = written.evidence[len(energy.evidence) :]
    assert (added.compared, added.grade) == (Compared.LINES, Grade.PROVED)


def test_a_value_that_the_name_does_not_have_is_refused(steps: dict[str, Step]) -> None:
    square, energy = steps["squared_speed"], steps["kinetic_energy"]
    with pytest.raises(Unverified, match="changes when the values are substituted"):
        condensed(energy, {square.symbol: replace(square, chain=(Form(2 * square.result, "law"),))})


def test_nothing_is_changed_where_nothing_is_put_in(steps: dict[str, Step]) -> None:
    square, energy = steps["squared_speed"], steps["kinetic_energy"]
    assert condensed(energy, {}) is energy
    assert condensed(energy, {steps["potential_energy"].symbol: square}) == replace(energy)


@pytest.mark.parametrize("because", [None, *sorted(NUMBERS)])
def test_numbers_stay_as_they_were_read_and_so_does_a_series(steps: dict[str, Step], because: str | None) -> None:
    square, energy = steps["squared_speed"], steps["kinetic_energy"]
    first = energy.chain[0].expr
    series = Truncated(first, square.symbol, Integer(0), Integer(1))
    line = Form(first, because) if because else Form(series, "series")
    assert line.expr.has(square.symbol)
    written = condensed(replace(energy, chain=(line, *energy.chain)), {square.symbol: square})
    assert written.chain[0] == line


def test_a_name_in_the_value_keeps_its_meaning(steps: dict[str, Step]) -> None:
    square, energy = steps["squared_speed"], steps["kinetic_energy"]
    half = Symbol("half", real=True)
    with_half = replace(square, chain=(Form(2 * half, "law"),), names=(*square.names, (half, square.result / 2)))
    assert dict(condensed(energy, {square.symbol: with_half}).names)[half] == square.result / 2
