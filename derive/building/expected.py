"""The results of a problem as LaTeX: `derive audit --problem` compares a document with them."""

from __future__ import annotations

from pathlib import Path

from derive.audit.expected import Expected
from derive.building.solution import derived
from derive.course.problem import load_problem
from derive.render.notation.latex import latex
from derive.render.notation.notation import Notation
from derive.render.printing.text_blocks import named_result
from derive.steps.homogeneity import dimension_table


def expected_results(root: Path, problem_id: str) -> list[Expected]:
    """Derive a problem and return its steps; the steps that answer a part are marked as asked. A result that several
    steps give, such as an equation of motion by two methods, is returned once."""
    problem = load_problem(root, problem_id)
    derivation, *_ = derived(problem)
    notation = Notation(dimension_table(problem.dimensions, derivation.steps)[0])
    asked = {step.key for part in problem.parts for step in derivation.answering(part.answers)}
    found: dict[str, Expected] = {}
    for step in derivation.steps:
        written = latex(named_result(step, notation))
        if written not in found or (step.key in asked and not found[written].asked):
            found[written] = Expected(problem_id, step.key, written, step.key in asked)
    return list(found.values())
