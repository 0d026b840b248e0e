"""Derive a problem in a notebook or at Python's prompt, and show the answers and drawings of its page.

problem = open_problem("hw9/block")
problem.answer("torque")       # shown as a formula; .value is the SymPy expression
problem.drawing("vectors")     # shown as a drawing
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from derive.building.derivations import Solved
from derive.building.pages import Wanted, printed
from derive.building.solution import derived
from derive.cli.problem_ids import found_root, problem_id_of
from derive.course.problem import Problem, load_problem
from derive.errors import Complaint, Misused, did_you_mean
from derive.page.signs import name_before, sign_before, sign_behind_name
from derive.render.notation.latex import latex
from derive.render.notation.layout import Layout, Operator, row
from derive.render.notation.notation import Notation
from derive.render.notation.text import plain
from derive.render.printing.chain_names import Page
from derive.render.printing.contract import number_told
from derive.steps.homogeneity import dimension_table
from derive.steps.step import NUMBERS, Step

__all__ = ["open_problem"]


def open_problem(problem_id: str, root: str | Path | None = None) -> Opened:
    """Open a problem by its id, such as `hw9/block`. By default `root` is the course that the command line would find,
    such as the course in or above the working folder."""
    folder = found_root(None if root is None else str(root))
    if folder is None:
        help_line = "name the folder that contains `problems`: `open_problem(..., root=...)`"
        raise Misused(Complaint("no-root", "no folder `problems` was found", help=help_line))
    return Opened(load_problem(folder, problem_id_of(problem_id)))


@dataclass(frozen=True)
class Answer:
    """One result of a derived problem.

    value   the SymPy expression that the page prints; for a relation, the whole relation
    sympy   the expression as plain SymPy text, which can be read without derive; for two roots, a list of two texts
    number  the numerical value with its unit as text; empty if there is none
    grade   the grade of its evidence: proved, sampled, definition or approximation
    """

    key: str
    value: Any
    sympy: str | list[str]
    number: str
    grade: str
    formula: Layout

    def __repr__(self) -> str:
        return plain(self.formula)

    def _repr_latex_(self) -> str:
        return rf"$\displaystyle {latex(self.formula)}$".replace(r"\bm{", r"\boldsymbol{")


@dataclass(frozen=True)
class Drawn:
    """A drawing as SVG text; it shows the problem as it was when `open_problem` read it."""

    svg: str

    def _repr_svg_(self) -> str:
        return self.svg


class Opened:
    """A problem that is derived once, when its answers or drawings are first requested."""

    def __init__(self, problem: Problem):
        self._problem = problem

    def __repr__(self) -> str:
        return f"{self._problem.id}: {', '.join(self.answers)}"

    @property
    def answers(self) -> tuple[str, ...]:
        """The keys of the answers that the parts of the problem ask for."""
        derivation = self._solved.derivation
        steps = [step for part in self._problem.parts for step in derivation.answering(part.answers)]
        return tuple(dict.fromkeys(step.key for step in steps))

    def answer(self, key: str) -> Answer:
        """Return the result with this key: the answer to a part, or the result of any other step. Raise `Misused` for
        an unknown key."""
        derivation, values = self._solved.derivation, self._solved.values
        steps = {step.key: step for step in derivation.steps}
        if key not in steps:
            answers = ", ".join(f"`{each}`" for each in self.answers)
            help_line = did_you_mean(key, steps) or f"the answers of the problem are {answers}"
            raise Misused(Complaint("no-such-step", f"no step is called `{key}`", help=help_line))
        step, forms = steps[key], values[key].chain if key in values else ()
        numbers = [form for form in forms if form.because in NUMBERS]
        told = number_told(numbers[0].expr) if numbers else None
        return Answer(
            key,
            step.result,
            Page([*derivation.steps, *values.values()]).names_of(step).text_of_value(step.result),
            told["text"] if told else "",
            step.grade.value,
            self._formula(step, [(sign_before(form), form.expr) for form in numbers]),
        )

    def drawing(self, key: str) -> Drawn:
        """Return the drawing with this key, as the page shows it; raise `Misused` for an unknown key."""
        name = f"{self._problem.id.rpartition('/')[2]}-{key}.svg"
        if name not in self._drawings:
            keys = [file.partition("-")[2].removesuffix(".svg") for file in self._drawings]
            message = f"no drawing is called `{key}`"
            raise Misused(Complaint("no-such-drawing", message, help=did_you_mean(key, keys)))
        return Drawn(self._drawings[name].decode())

    @cached_property
    def _solved(self) -> Solved:
        derivation, values, _, run = derived(self._problem)
        return Solved(derivation, values, (), tuple(run.drawings))

    @cached_property
    def _drawings(self) -> dict[str, bytes]:
        files = printed(self._problem, self._solved, Wanted(draws=True, only=())).files
        return {name: content for name, content in files if name.endswith(".svg")}

    @cached_property
    def _notation(self) -> Notation:
        every = [*self._solved.derivation.steps, *self._solved.values.values()]
        return Notation(dimension_table(self._problem.dimensions, every)[0])

    def _formula(self, step: Step, numbers: list[tuple[str, Any]]) -> Layout:
        """Return the formula of a result with its numbers, such as `theta = arccos(...) ~ 21.64 deg`."""
        lettered = step.symbol is not None
        sign = sign_behind_name(step, step.chain[-1])
        before = [self._notation.layout(name_before(step)), Operator(sign)] if lettered else []
        behind = [item for sign, expr in numbers for item in (Operator(sign), self._notation.result(expr))]
        return row(*before, self._notation.result(step.result), *behind)
