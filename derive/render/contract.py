"""The JSON of `derive solve ID --format json`: the contract that other programs read.

`sympy` is plain SymPy text with the symbols' own names. Unevaluated nodes become what SymPy itself has: a mass integral
an `Integral`, a bracket the difference it stands for, a vector's name a `MatrixSymbol`. A name that SymPy would take
for something of its own (`I`, `E`, `S`, `beta`) is written `Symbol('I')`.
"""

from __future__ import annotations

import json
import keyword
from collections.abc import Mapping, Sequence
from typing import Any

import sympy
from sympy import MatrixBase, MatrixSymbol, Symbol
from sympy.printing.str import StrPrinter

from derive import expressions as ex
from derive.derivation import Derivation
from derive.dimensions import unit_of_kind
from derive.document import Document, Illustration
from derive.parts import points_text
from derive.problem import Problem
from derive.render.latex import latex
from derive.render.notation import Notation
from derive.render.text_page import inline_text
from derive.rounding import Rounded, decimal_text
from derive.step import NUMBERS, Form, Step


class _PlainSymPy(StrPrinter):
    """SymPy's own text, with names that cannot be mistaken and nodes lowered to what SymPy knows."""

    def _print_Symbol(self, expr: Symbol) -> str:
        name = expr.name
        clash = hasattr(sympy, name) or keyword.iskeyword(name) or not name.isidentifier() or name in {"lambda"}
        return f"Symbol('{name}')" if clash else name

    def _print_MatrixSymbol(self, expr: MatrixSymbol) -> str:
        return f"MatrixSymbol('{expr.name}', {expr.shape[0]}, {expr.shape[1]})"

    def _print_MatrixBase(self, expr: MatrixBase) -> str:
        rows = ", ".join("[" + ", ".join(self._print(entry) for entry in expr.row(i)) + "]" for i in range(expr.rows))
        return f"Matrix([{rows}])"

    _print_ImmutableDenseMatrix = _print_DenseMatrix = _print_MatrixBase

    def _sum(self, expr: Any) -> str:
        return "(" + " + ".join(f"({self._print(arg)})" for arg in expr.args) + ")"

    def _times(self, expr: Any) -> str:
        return "(" + "*".join(f"({self._print(arg)})" for arg in expr.args) + ")"

    _print_Terms = _print_MatAdd = _sum
    _print_Factors = _print_MatMul = _times

    def _print_Ratio(self, expr: Any) -> str:
        above, below = (self._print(arg) for arg in expr.args)
        return f"(({above})/({below}))"

    def _print_Group(self, expr: Any) -> str:
        return f"({self._print(expr.args[0])})"

    def _print_Root(self, expr: Any) -> str:
        return f"sqrt({self._print(expr.args[0])})"

    def _print_Dot(self, expr: Any) -> str:
        a, b = (self._print(arg) for arg in expr.args)
        return f"(({a}).T*({b}))[0, 0]"

    def _print_Norm(self, expr: Any) -> str:
        a = self._print(expr.args[0])
        return f"sqrt((({a}).T*({a}))[0, 0])"

    def _print_Cross(self, expr: Any) -> str:
        a, b = (self._print_MatrixBase(_entries(arg)) for arg in expr.args)
        return f"{a}.cross({b})"

    def _print_Outer(self, expr: Any) -> str:
        a, b = (self._print(arg) for arg in expr.args)
        return f"({a})*({b}).T"

    def _print_CarriedRate(self, expr: Any) -> str:
        return self._print_Cross(ex.Cross(expr.args[1], expr.args[0]))

    def _print_BodyRate(self, expr: Any) -> str:
        return "zeros(3, 1)"

    def _print_Partial(self, expr: Any) -> str:
        return f"Derivative({', '.join(self._print(arg) for arg in expr.args)})"

    def _print_Slope(self, expr: Any) -> str:
        f, x, order = (self._print(arg) for arg in expr.args)
        return f"Derivative({f}, ({x}, {order}))"

    def _print_At(self, expr: Any) -> str:
        f, x, place = (self._print(arg) for arg in expr.args)
        return f"Subs({f}, {x}, {place})"

    def _print_Truncated(self, expr: Any) -> str:
        return str(self._print(expr.args[0]))

    def _print_TimeRate(self, expr: Any) -> str:
        return f"Derivative({self._print(expr.args[0])}, t)"

    def _print_Relation(self, expr: Any) -> str:
        mark = "==" if expr.mark == "=" else expr.mark
        return f"Rel({self._print(expr.left)}, {self._print(expr.right)}, '{mark}')"

    def _print_Bracket(self, expr: Any) -> str:
        return f"({self._print(expr.doit())})"

    def _print_Identity(self, expr: Any) -> str:
        return f"Identity({expr.shape[0]})"

    def _print_Amount(self, expr: Any) -> str:
        return f"({self._print(expr.doit())})"

    def _print_MatrixAmount(self, expr: Any) -> str:
        return self._print_MatrixBase(ex.explicit(expr))

    def _print_Rounded(self, expr: Any) -> str:
        return str(self._print(expr.args[0]))

    def _print_MassIntegral(self, expr: Any) -> str:
        integrand, r, density, position, jacobian, *limits = expr.args
        at = ex.explicit(integrand.xreplace({r: position}))
        return self._print_MatrixBase(at.applyfunc(lambda f: sympy.Integral(density * f * jacobian, *limits)))


def _entries(vector: Any) -> Any:
    """A vector as an explicit column, a name as the column of its entries."""
    return vector.as_explicit() if isinstance(vector, MatrixSymbol) else ex.explicit(vector)


def sympy_text(expr: Any) -> str:
    """Plain SymPy text of an expression of the engine."""
    return str(_PlainSymPy({"order": None}).doprint(expr))


def contract(
    problem: Problem,
    derivation: Derivation,
    values: Mapping[str, Step],
    document: Document,
    notation: Notation,
    reference: Sequence[Mapping[str, Any]] = (),
) -> str:
    """The JSON text."""
    answers = {key: derivation.step(key) for part in problem.parts for key in part.answers}
    data = {
        "problem": problem.id,
        "title": inline_text(document.title, notation),
        "points": _points(problem.points),
        "given": {given.name: _given(given) for given in problem.givens},
        "parts": [
            {"label": page.label, "points": _points(page.points), "answers": list(part.answers)}
            for page, part in zip(document.parts, problem.parts, strict=True)
        ],
        "answers": {key: _answer(step, values.get(key), notation) for key, step in answers.items()},
        "drawings": [_drawing(drawing, notation) for drawing in document.illustrations],
        "steps": [_step(step, notation) for step in [*derivation.steps, *values.values()]],
        "reference": list(reference),
    }
    return json.dumps(data, indent=2, ensure_ascii=False) + "\n"


def _drawing(drawing: Illustration, notation: Notation) -> dict[str, Any]:
    return {
        "key": drawing.key,
        "at": drawing.at,
        "number": drawing.number,
        "caption": inline_text(drawing.caption, notation),
        "alt": inline_text(drawing.alt, notation),
        "files": [f"{drawing.stem}.pdf", f"{drawing.stem}.svg"],
    }


def _points(points: Any) -> int | float | None:
    return None if points is None else json.loads(points_text(points))


def _given(given: Any) -> Any:
    """The value as SymPy text, with the number behind each letter."""
    if given.word is not None:
        return given.word
    value = given.value.components if given.kind.name == "Direction" else given.value
    text = [sympy_text(v) for v in value] if isinstance(value, tuple) else sympy_text(value)
    if not given.measured:
        return text
    numbers = {str(m.symbol): f"{m.number} {m.unit}" for m in given.measured}
    return {"value": text, "measured": numbers}


def _answer(step: Step, value: Step | None, notation: Notation) -> dict[str, Any]:
    forms = [form for form in value.chain if form.because in NUMBERS] if value else []
    first, *others = [_number(form.expr) for form in forms] or [None]
    return {
        "symbol": _symbol(step, notation),
        "sympy": sympy_text(step.result),
        "latex": latex(notation.result(step.result)),
        "unit": unit_of_kind(step.kind) if step.kind else "",
        "number": first,
        **({"also": others} if others else {}),
    }


def _symbol(step: Step, notation: Notation) -> str:
    """What the page calls the result; a relation has no name."""
    return "" if step.symbol is None else latex(notation.layout(step.symbol))


def _number(value: Any) -> dict[str, Any] | None:
    """The rounded value, or nothing while letters are left in it; of a relation, that on its right."""
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


def _step(step: Step, notation: Notation) -> dict[str, Any]:
    return {
        "key": step.key,
        "rule": step.rule,
        "symbol": _symbol(step, notation),
        "outcome": step.outcome,
        "inputs": list(step.inputs),
        "chain": [_form(form, notation) for form in step.chain],
        "evidence": [{"claim": e.claim, "grade": e.grade.value, "detail": e.detail} for e in step.evidence],
    }


def _form(form: Form, notation: Notation) -> dict[str, Any]:
    layout = notation.result(form.expr) if form.because == "result" else notation.layout(form.expr)
    return {"sympy": sympy_text(form.expr), "latex": latex(layout), "because": form.because, "level": form.level.value}
