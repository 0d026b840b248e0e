"""The figures of several problems on a page have consecutive numbers."""

from __future__ import annotations

from derive.render.printing.figure_numbers import OF_PROBLEM, equations_numbered, figure_number, numbered_in_a_row


def test_figures_are_numbered_in_a_row_and_references_with_them() -> None:
    first = f"<p>see {figure_number(2)}</p> {figure_number(1)} {figure_number(2)}"
    assert numbered_in_a_row([first, "none", figure_number(1)]) == ["<p>see 2</p> 1 2", "none", "3"]


def test_equations_have_the_number_of_their_problem_only_if_there_are_several() -> None:
    body = f"({OF_PROBLEM}3)"
    assert equations_numbered([("5", body)]) == ["(3)"]
    assert equations_numbered([("5", body), ("6", body)]) == ["(5.3)", "(6.3)"]
