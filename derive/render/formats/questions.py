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
            "solution": page.solution(part),
            "answers": [{"key": key, **known["answers"][key]} for key in told["answers"]],
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


FORMAT = Format("questions", "json", _rendered, built=False, drawings="svg")
