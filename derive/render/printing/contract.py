"""The JSON of `derive solve ID --format json`: the contract with other programs.

Every step contains all its lines, at any level of detail, in plain SymPy text (`derive.render.printing.plain_sympy`).
`names` gives the value of each name in the chain. After SymPy has parsed the lines and these values are substituted,
each line equals the line before it, with these exceptions:

    a number        (`because: rounded`) differs from the last line before the numbers by at most `within`.
    a relation      has a residual, left minus right: the residual of the line before is `factor` times the residual of
                    this line. The factor is not zero if no entry of `nonzero` is zero. In an inequality, these entries
                    are positive, and a negative factor reverses the sign (<, >).
    a series        (`because: series`, or `limit` with order 0) agrees with the line before up to the `order` in its
                    `variable`.
    the motion      (`because: motion`): the two lines are equal after `motion` is substituted in both.

If the left side is a formula (`symbol.formula`), it equals the first line. A step that `approximates` a symbol is a
limit or a series of that symbol. A result derived from such a step is only approximately equal to its first line
(`about`). A step with two roots has a list in place of each text.
"""

from __future__ import annotations

import json
from typing import Any

from sympy import Integer, MatrixBase, Symbol
from sympy.core.symbol import Str

from derive.algebra import expressions as ex
from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.direction import Direction
from derive.algebra.expansion import Expansion
from derive.algebra.kinds import unit_of_dimension, unit_of_kind
from derive.algebra.period_series import SwingTime
from derive.algebra.rounding import Rounded, decimal_text, half_a_unit
from derive.course.parts import points_text
from derive.errors import Complaint
from derive.page.tree import Document, Illustration
from derive.render.formats import Solution
from derive.render.notation.latex import latex
from derive.render.notation.notation import Notation
from derive.render.notation.text import in_one_line
from derive.render.printing.chain_names import Page, StepNames
from derive.render.printing.plain_sympy import sympy_text
from derive.render.printing.text_blocks import Said, named_result
from derive.render.printing.text_page import inline_text
from derive.steps.step import NUMBERS, Step


def contract(solution: Solution) -> str:
    """Return the JSON text of a solution."""
    problem, derivation, values = solution.problem, solution.derivation, solution.values
    document, notation = solution.document, solution.notation
    answered = [derivation.answering(part.answers) for part in problem.parts]
    page = Page([*derivation.steps, *values.values()])
    said = Said(document, notation)
    data = {
        "problem": problem.id,
        "detail": solution.detail,
        "title": inline_text(document.title, notation),
        "points": _points(problem.points),
        "statement": said.text(document.statement),
        "strategy": said.text(document.strategy),
        "given": {given.name: _given(given) for given in problem.givens},
        "parts": [
            {
                "label": page.label,
                "points": _points(page.points),
                "extra": page.extra,
                "answers": [step.key for step in steps],
                "ask": said.text(page.ask),
                "says": said.blocks(page.blocks),
            }
            for page, steps in zip(document.parts, answered, strict=True)
        ],
        "assumed": [sympy_text(condition) for condition in derivation.assumed],
        "answers": {
            step.key: _answer(page.names_of(step), values.get(step.key), document.dimensions.get(step.symbol), notation)
            for steps in answered
            for step in steps
        },
        "observations": [list(keys) for keys in derivation.observed],
        "limits": [list(keys) for keys in derivation.closing],
        "limits_say": said.blocks(document.limits.blocks) if document.limits else [],
        "note": said.text(document.note),
        "drawings": [_drawing(drawing, document, notation) for drawing in document.illustrations],
        "steps": [_step(page.names_of(step), notation) for step in page.steps],
        "reference": [told.facts for told in solution.compared],
        "warnings": [_warning(warning) for warning in solution.warnings],
    }
    return json.dumps(data, indent=2, ensure_ascii=False) + "\n"


def _drawing(drawing: Illustration, document: Document, notation: Notation) -> dict[str, Any]:
    return {
        "key": drawing.key,
        "at": drawing.at,
        "number": drawing.number,
        "caption": inline_text(drawing.caption, notation, document.numbers),
        "alt": inline_text(drawing.alt, notation),
        "files": [f"{drawing.stem}.pdf", f"{drawing.stem}.svg"],
    }


def _warning(warning: Complaint) -> dict[str, Any]:
    return {"code": warning.code, "message": warning.message, "line": warning.place.line if warning.place else None}


def _points(points: Any) -> int | float | None:
    return None if points is None else json.loads(points_text(points))


def _given(given: Any) -> Any:
    """Return an input: a word, or its value as SymPy text, with the measured numbers of its symbols, if any."""
    if given.word is not None:
        return given.word
    value = given.value.components if isinstance(given.value, Direction) else given.value
    text = [sympy_text(v) for v in value] if isinstance(value, tuple) else sympy_text(value)
    if not given.measured:
        return text
    numbers = {str(m.symbol): f"{m.number} {m.unit}" for m in given.measured}
    return {"value": text, "measured": numbers}


def _answer(named: StepNames, value: Step | None, dimension: Dimension | None, notation: Notation) -> dict[str, Any]:
    step = named.step
    forms = [form for form in value.chain if form.because in NUMBERS] if value else []
    first, *others = [number_told(form.expr) for form in forms] or [None]
    return {
        "symbol": _symbol(step, notation),
        "sympy": named.text_of_value(step.result),
        "latex": latex(notation.result(step.result)),
        "text": in_one_line(named_result(step, notation)),
        "unit": unit_of_kind(step.kind) if step.kind else unit_of_dimension(dimension or NUMBER),
        "number": first,
        **({"also": others} if others else {}),
    }


def _symbol(step: Step, notation: Notation) -> str:
    """Return the symbol of a result in LaTeX, or "" for a relation, which has no symbol."""
    return "" if step.symbol is None else latex(notation.layout(step.symbol))


def number_told(value: Any) -> dict[str, Any] | None:
    """Return a number as data; for a relation, return the number on its right side. Return None for a comparison of two
    numbers, and if symbols remain."""
    shown, unit = value.right if isinstance(value, ex.Relation) else value, ""
    if isinstance(value, ex.Relation) and not isinstance(value.left, Symbol):
        return None  # a comparison of two numbers
    if shown.free_symbols:
        return None
    if isinstance(shown, ex.Amount | ex.MatrixAmount):
        shown, unit = shown.args[0], shown.args[1].name
    entries = list(shown) if isinstance(shown, MatrixBase) else [shown]
    texts = [decimal_text(entry) if isinstance(entry, Rounded) else str(entry) for entry in entries]
    figures = next((int(entry.args[1]) for entry in entries if isinstance(entry, Rounded)), None)
    whole = texts[0] if len(texts) == 1 else "(" + ", ".join(texts) + ")"
    numbers = [float(text) for text in texts]
    return {
        "value": numbers[0] if len(numbers) == 1 else numbers,
        "unit": unit,
        "figures": figures,
        "text": f"{whole} {unit}".strip(),
    }


def _step(named: StepNames, notation: Notation) -> dict[str, Any]:
    step = named.step
    return {
        "key": step.key,
        "rule": step.rule,
        "symbol": None if step.symbol is None else _left_side(named, notation),
        "outcome": step.outcome,
        **({} if step.exact else {"approximates": _whole(step, notation), "about": step.about}),
        "inputs": list(step.inputs),
        "names": named.names,
        **({"motion": named.motion} if step.motion else {}),
        "chain": [_form(named, i, notation) for i in range(len(step.chain))],
        "evidence": [
            {"claim": e.claim, "compared": e.compared.value, "grade": e.grade.value, "detail": e.detail}
            for e in step.evidence
        ],
    }


def _whole(step: Step, notation: Notation) -> str | None:
    """Return the LaTeX of the symbol, or the key of the equation, of which the result is a limit or series; None for
    any other result."""
    whole = step.approximates
    return None if whole is None else whole.name if isinstance(whole, Str) else latex(notation.layout(whole))


def _left_side(named: StepNames, notation: Notation) -> dict[str, Any]:
    return {"sympy": named.symbol, "latex": _symbol(named.step, notation), "formula": named.has_formula}


def _form(named: StepNames, i: int, notation: Notation) -> dict[str, Any]:
    form = named.step.chain[i]
    layout = notation.result(form.expr) if form.because == "result" else notation.layout(form.expr)
    return {
        "sympy": named.text(form.expr),
        "latex": latex(layout),
        "text": in_one_line(layout),
        "because": form.because,
        "level": form.level.value,
        **_to_the_line_before(named, i),
    }


def _to_the_line_before(named: StepNames, i: int) -> dict[str, Any]:
    """Return how a line may differ from the line before, such as by rounding or by the factor of a relation."""
    form = named.step.chain[i]
    if form.because == "rounded":
        return {"within": named.text_of_value(_half_units(form.expr))}
    if isinstance(form.expr, ex.Truncated):
        _, x, place, order = form.expr.args
        return {"variable": named.text(x), "place": named.text(place), "order": int(order)}
    if form.because in {"series", "limit"} and i:
        return _of_expansion(named, i)
    if isinstance(form.expr, ex.Relation) and i and form.because not in NUMBERS:
        return {"factor": named.text_of_value(named.factor(i)), "nonzero": [named.text(each) for each in form.nonzero]}
    return {}


def _of_expansion(named: StepNames, i: int) -> dict[str, Any]:
    """Return the variable, centre and order of an expansion; if x tends to infinity, the order is in 1/x."""
    for node in named.step.chain[i - 1].expr.atoms(Expansion, SwingTime):
        x, place = (node.args[1], node.args[2]) if isinstance(node, Expansion) else (node.args[2], Integer(0))
        order = node.args[3]
        told = int(order) if order.is_Integer else str(order)
        return {"variable": named.text(x), "place": named.text(place), "order": told}
    return {}


def _half_units(expr: Any) -> Any:
    """Return the largest rounding error of each number in a line."""
    shown = expr.right if isinstance(expr, ex.Relation) else expr
    return shown.xreplace({number: half_a_unit(number) for number in shown.atoms(Rounded)})
