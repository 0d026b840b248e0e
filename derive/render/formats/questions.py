"""A problem as data for learning platforms: statement, questions, answers and solutions, with formulas in TeX."""

from __future__ import annotations

from derive.render.formats import Format, Solution


def _rendered(solution: Solution) -> str:
    import json

    from derive.render.printing.contract import contract
    from derive.render.printing.tex_in_html import TexInHtml

    page, document = TexInHtml(solution.document, solution.words, solution.notation), solution.document
    known = json.loads(contract(solution))
    parts = [
        {
            "label": part.label,
            "points": told["points"],
            "question": page.question(part),
            "cited": page.cited(part, solution.derivation.steps),
            "solution": page.solution(part),
            "answers": [
                {"key": key, "positive": _is_of_positive_letters(solution, key), **known["answers"][key]}
                for key in told["answers"]
            ],
        }
        for part, told in zip(document.parts, known["parts"], strict=True)
    ]
    data = {
        "problem": known["problem"],
        "title": known["title"],
        "statement": page.statement(),
        "remarks": page.remarks(),
        "parts": parts,
    }
    return json.dumps(data, ensure_ascii=False, indent=1)


def _is_of_positive_letters(solution: Solution, key: str) -> bool:
    """Return whether all letters of an answer are positive: a platform may then take sqrt(x^2) for x."""
    step = next(step for step in solution.derivation.steps if step.key == key)
    return all(letter.is_positive for letter in getattr(step.result, "free_symbols", ()))


FORMAT = Format("questions", "json", _rendered, built=False, drawings="svg")
