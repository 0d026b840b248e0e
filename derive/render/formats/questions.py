"""A problem as data for learning platforms: statement, questions, answers and solutions, with formulas in TeX."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from derive.render.formats import Format, Solution

if TYPE_CHECKING:
    from sympy import Symbol

    from derive.render.notation.notation import Notation
    from derive.render.printing.chain_names import StepNames
    from derive.steps.step import Step


def _rendered(solution: Solution) -> str:
    import json

    from derive.render.printing.chain_names import Page
    from derive.render.printing.contract import contract
    from derive.render.printing.tex_in_html import TexInHtml

    page, document = TexInHtml(solution.document, solution.words, solution.notation), solution.document
    derivation = solution.derivation
    known, names = json.loads(contract(solution)), Page(derivation.steps)
    letters = {declared.symbol for declared in solution.problem.letters}
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
                    **_in_letters(names.names_of(step), letters),
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
    """Return whether all letters of an answer are positive: a platform may then replace sqrt(x^2) by x."""
    values = [of for name, of in step.names if name in getattr(step.result, "free_symbols", ())]
    letters = (getattr(each, "free_symbols", ()) for each in (step.result, *values))
    return all(letter.is_positive for found in letters for letter in found)


def _in_letters(named: StepNames, letters: set[Symbol]) -> dict[str, Any]:
    """Return an answer in the letters of the problem, and the quantities, such as mu, that its formula on the page
    contains. The mapping is empty if there are no such quantities. A platform that compares formulas does not know
    these quantities."""
    from sympy import Expr, Symbol

    from derive.algebra.node import explicit

    step = named.step
    used: set[Any] = getattr(explicit(step.result), "free_symbols", set()) - letters
    values = {
        name: explicit(of)
        for name, of in step.names
        if isinstance(name, Symbol) and isinstance(of, Expr) and name in used
    }
    if not values:
        return {}
    names = {str(named.text_of_value(name)): named.text_of_value(of) for name, of in values.items()}
    return {"sympy": named.text_of_value(explicit(step.result).xreplace(values)), "names": names}


def _components(step: Step, notation: Notation) -> list[str]:
    """Return the symbols of the components of a vector in TeX; an empty list for any other answer.

    There are no components if only the ratios of the entries have a meaning, as for the amplitudes of a mode, or if the
    answer is a list of values in any order.
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
