"""The questions of a set for exports, read from the format `questions` of each problem and from its drawings."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from html import escape
from typing import Any

from derive.render.printing.tex_in_html import IMAGE, formula_html
from derive.render.rendered import Rendered

# the functions that learning platforms know
FUNCTIONS = {"sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log", "sqrt"}
CONSTANTS = {"e", "i", "j"}  # letters that learning platforms read as numbers
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


@dataclass(frozen=True)
class Answer:
    """One answer of a part, or one component of an answer that is a vector.

    sympy    the formula in plain text, in the letters of the problem; empty if plain text cannot express it
    positive the letters of the formula that are positive
    names    the defined quantities in the formula, such as mu, each with its own formula
    latex    the formula in TeX
    value    the number, or None; `unit` is its unit, and `figures` is the number of its significant figures
    """

    key: str
    symbol: str
    sympy: str
    latex: str
    value: float | None
    unit: str
    figures: int | None
    positive: frozenset[str] = frozenset()
    names: tuple[tuple[str, str], ...] = ()
    components: str = ""  # the formulas of all components of the vector in plain text

    @property
    def tolerance(self) -> float:
        """Half a unit of the last printed figure; 0 if there is no number or the number is 0."""
        if self.value is None or not self.value:
            return 0.0
        exponent = f"{self.value:.{(self.figures or 4) - 1}e}".partition("e")[2]
        return 0.5 * 10.0 ** (int(exponent) - (self.figures or 4) + 1)

    @property
    def named(self) -> str:
        """The name of the answer as HTML: its symbol or, for a relation without a symbol, the words of its key."""
        return formula_html(self.symbol) if self.symbol else escape(self.key.replace("_", " "))

    @property
    def sought(self) -> str:
        """The line of a question that names the number that a student types, and its unit, as HTML."""
        unit = f", in {escape(self.unit)}" if self.unit else ""
        return f"<p>{self.named} = ?{unit}</p>"

    @property
    def letters(self) -> set[str] | None:
        """The letters of the formula, or of all components of the vector; None if there are none, or if learning
        platforms cannot compare the formula."""
        text = self.components or self.sympy
        names = set(_NAME.findall(text))
        if not re.fullmatch(r"[A-Za-z0-9_+\-*/() ]+", text) or names & CONSTANTS:
            return None
        letters = names - FUNCTIONS - {"pi"}
        called = {name for name in letters if re.search(rf"\b{name}\(", text)}
        return None if called or not letters else letters


@dataclass(frozen=True)
class Part:
    """A question with its answers; the texts are HTML with formulas in TeX. `cited` contains those equations
    of other parts that the solution cites."""

    label: str
    points: float | None
    question: str
    cited: str
    solution: str
    answers: tuple[Answer, ...]

    @property
    def feedback(self) -> str:
        """The solution for a platform that shows each part separately."""
        return "\n".join(filter(None, [self.cited, self.solution]))

    @property
    def is_numerical(self) -> bool:
        return bool(self.answers) and all(isinstance(answer.value, float) for answer in self.answers)


@dataclass(frozen=True)
class Question:
    """A problem with its statement, remarks, parts, and the files of its drawings by name.

    letters  the letters of the problem and of its answers
    typing   a sentence that says how to type these letters, as HTML
    """

    id: str
    number: int
    title: str
    statement: str
    remarks: str
    parts: tuple[Part, ...]
    files: dict[str, bytes]
    letters: tuple[str, ...] = ()
    typing: str = ""

    @property
    def name(self) -> str:
        return self.id.rpartition("/")[2]

    def heading(self, part: Part) -> str:
        return f"{self.number}{f' ({part.label})' if part.label else ''} {self.title}"


def questions_of(problems: Sequence[Rendered]) -> list[Question]:
    """Return the questions of problems; the problems must have been printed in the format `questions`."""
    return [_question(number, problem) for number, problem in enumerate(problems, 1)]


def _question(number: int, problem: Rendered) -> Question:
    told = json.loads(problem.texts["questions"])
    files = {name: content for name, content in problem.files if name.endswith(".svg")}
    parts = tuple(
        Part(
            part["label"],
            part["points"],
            part["question"],
            part["cited"],
            part["solution"],
            tuple(answer for each in part["answers"] for answer in _answers(each)),
        )
        for part in told["parts"]
    )
    letters = tuple(filter(_NAME.fullmatch, told["letters"]))
    of_problem = told["statement"], told["remarks"], parts, files, letters, told["typing"]
    return Question(problem.id, number, problem.title, *of_problem)


def _answers(told: dict[str, Any]) -> list[Answer]:
    """Return an answer, or the components of an answer that is a vector."""
    number, symbols = told["number"] or {}, told["components"]
    unit, value = number.get("unit", told["unit"]) or "", number.get("value")
    alone = Answer(
        told["key"],
        told["symbol"],
        told["sympy"],
        told["latex"],
        float(value) if isinstance(value, int | float) else None,
        unit,
        number.get("figures"),
        frozenset(told.get("positive", ())),
        tuple(told.get("names", {}).items()),
    )
    entries = re.findall(r"\[([^\[\]]+)\]", told["sympy"])
    values = [float(each) for each in value] if isinstance(value, list) else [None] * len(entries)
    if not symbols or not len(symbols) == len(entries) == len(values):
        return [alone]
    return [
        replace(alone, key=f"{alone.key}_{n}", symbol=symbol, sympy=entry, value=each, components=" ".join(entries))
        for n, (symbol, entry, each) in enumerate(zip(symbols, entries, values, strict=True), 1)
    ]


def with_files(html: str, address: Callable[[str], str], files: dict[str, bytes]) -> tuple[str, list[str]]:
    """Replace the names of files in a text by their addresses; return the new text and the names of the files that it
    uses.
    """
    used = [name for name in files if f"{IMAGE}{name}" in html]
    for name in used:
        html = html.replace(f"{IMAGE}{name}", address(name))
    return html, used
