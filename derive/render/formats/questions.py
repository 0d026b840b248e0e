"""A problem as data for learning platforms: statement, questions, answers and solutions, with formulas in TeX."""

from __future__ import annotations

from typing import TYPE_CHECKING

from derive.render.formats import Format, Solution

if TYPE_CHECKING:
    from derive.render.notation.notation import Notation
    from derive.steps.step import Step


def _rendered(solution: Solution) -> str:
    import json

    from derive.render.printing.contract import contract
    from derive.render.printing.tex_in_html import TexInHtml

    page, document = TexInHtml(solution.document, solution.words, solution.notation), solution.document
    derivation = solution.derivation
    known = json.loads(contract(solution))
    parts = [
        {
            "label": part.label,
            "points": told["points"],
            "question": page.question(part),
            "cited": page.cited(part, derivation.steps),
            "solution": page.solution(part),
            "answers": [
                {
                    "key": step.key,
                    "positive": _is_of_positive_letters(step),
                    "components": _components(step, solution.notation),
                    **known["answers"][step.key],
                }
                for step in derivation.answering(asked.answers)
            ],
        }
        for part, told, asked in zip(document.parts, known["parts"], solution.problem.parts, strict=True)
    ]
    data = {
        "problem": known["problem"],
        "title": known["title"],
        "statement": page.statement(),
        "remarks": page.remarks(),
        "parts": parts,
    }
    return json.dumps(data, ensure_ascii=False, indent=1)


def _is_of_positive_letters(step: Step) -> bool:
    """Return whether all letters of an answer are positive: a platform may then take sqrt(x^2) for x."""
    return all(letter.is_positive for letter in getattr(step.result, "free_symbols", ()))


def _components(step: Step, notation: Notation) -> list[str]:
    """Return the symbols of the components of a vector in TeX; an empty list for any other answer.

    A vector that is known up to a factor, such as the amplitudes of a mode, and a set in any order have no components.
    """
    from sympy import MatrixBase

    from derive.render.notation.latex import latex

    value, symbol = step.result, step.symbol
    if not isinstance(value, MatrixBase) or value.cols != 1 or step.kind in (None, "number") or symbol is None:
        return []
    if isinstance(symbol, MatrixBase):
        is_set = len({str(each).partition("_")[0] for each in symbol}) == 1
        return [] if is_set else [latex(notation.layout(each)) for each in symbol]
    whole = latex(notation.layout(symbol))
    return [rf"({whole})_{{{number}}}" for number in range(1, value.rows + 1)]


FORMAT = Format("questions", "json", _rendered, built=False, drawings="svg")
