"""A problem as data for learning platforms: statement, questions, answers and solutions, with formulas in TeX."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from derive.render.formats import Format, Solution

if TYPE_CHECKING:
    from sympy import Symbol

    from derive.render.notation.notation import Notation
    from derive.steps.step import Step


def _rendered(solution: Solution) -> str:
    import json

    from derive.render.printing.contract import contract
    from derive.render.printing.plain_sympy import coordinate_of
    from derive.render.printing.tex_in_html import TexInHtml

    page, document = TexInHtml(solution.document, solution.words, solution.notation), solution.document
    derivation = solution.derivation
    contents = json.loads(contract(solution))
    letters = {declared.symbol for declared in solution.problem.letters}
    names = {letter.name for letter in letters}
    moving = {letter for letter in letters if f"{coordinate_of(letter)[0]}_dot" in names}
    known = moving | {declared.symbol for declared in solution.problem.symbols.values()}
    typed = {
        step.key: typed_formula(step, letters, known)
        for asked in solution.problem.parts
        for step in derivation.answering(asked.answers)
    }
    used = set[Any]().union(*(each.letters for each in typed.values() if each is not None))
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
                    "components": _components(step, solution.notation),
                    **contents["answers"][step.key],
                    **_told(typed[step.key], solution.notation),
                }
                for step in derivation.answering(asked.answers)
            ],
        }
        for part, told, asked in zip(document.parts, contents["parts"], solution.problem.parts, strict=True)
    ]
    data = {
        "problem": contents["problem"],
        "title": contents["title"],
        "statement": page.statement(),
        "remarks": page.remarks(),
        "letters": sorted(letter.name for letter in letters | used),
        "typing": page.typing(used),
        "parts": parts,
    }
    return json.dumps(data, ensure_ascii=False, indent=1)


@dataclass(frozen=True)
class Typed:
    """An answer as students type it on a platform that compares formulas.

    symbol   the left side
    text     the formula in plain text; the rate of a coordinate theta is `theta_dot`
    letters  the letters of the formula
    names    the quantities, such as mu, that the formula on the page contains, each with its own formula. A platform
             does not know these quantities, so `text` contains their formulas
    """

    symbol: Any
    text: str
    letters: set[Symbol]
    names: dict[str, str]


def typed_formula(step: Step, letters: set[Symbol], known: set[Symbol]) -> Typed | None:
    """Return an answer as students type it; None if plain text cannot express it, or if its form is not unique.

    letters  the letters of the problem
    known    the letters that a solved equation may contain; with an unknown force, the form of an equation is not
             unique
    """
    from sympy import Expr, I, MatrixBase, Symbol, oo, zoo
    from sympy.core.numbers import NumberSymbol, pi

    from derive.algebra.expressions import PLUS_MINUS, Relation
    from derive.algebra.node import explicit

    symbol, result = _solved(step)
    value = None if result is None else explicit(result)
    if not isinstance(value, Expr | MatrixBase) or value.has(PLUS_MINUS, I, oo, zoo):
        return None
    if any(value.atoms(NumberSymbol) - {pi}):
        return None
    used: set[Any] = value.free_symbols - letters
    values = {
        name: explicit(of)
        for name, of in step.names
        if isinstance(name, Symbol) and isinstance(of, Expr) and name in used
    }
    whole = value.xreplace(values)
    names = {str(name): _plain(of) for name, of in values.items()}
    if isinstance(step.result, Relation) and not whole.atoms(Symbol) <= known:
        return None
    return Typed(symbol, _plain(whole), set(whole.atoms(Symbol)), names)


def _solved(step: Step) -> tuple[Any, Any]:
    """Return the symbol and the value of an answer. An equation is solved for its left side or for its only
    acceleration; any other relation has the value None."""
    from sympy import Symbol, diff

    from derive.algebra.expressions import RATES, Relation, bound
    from derive.algebra.node import explicit
    from derive.algebra.tidy import tidied

    if not isinstance(step.result, Relation):
        return step.symbol, step.result
    relation = explicit(step.result)
    if step.result.operator != "=" or not isinstance(relation, Relation):
        return None, None
    if isinstance(relation.left, Symbol) and not relation.right.has(relation.left):
        return relation.left, relation.right
    residual = relation.residual.expand()
    highest = [letter for letter in residual.atoms(Symbol) if letter.name.endswith(RATES[2])]
    if len(highest) != 1 or (factor := diff(residual, *highest)).has(*highest):
        return None, None
    return highest[0], tidied(-bound(residual, {highest[0]: 0}) / factor)


def _plain(value: Any) -> str:
    """Return the plain text of a formula, in which each letter is printed as its name."""
    import re

    from derive.render.printing.plain_sympy import sympy_text

    return re.sub(r"Symbol\('(\w+)'\)", r"\1", sympy_text(value))


def _told(typed: Typed | None, notation: Notation) -> dict[str, Any]:
    from derive.render.notation.latex import latex

    if typed is None:
        return {"sympy": ""}
    return {
        "symbol": "" if typed.symbol is None else latex(notation.layout(typed.symbol)),
        "sympy": typed.text,
        "positive": sorted(letter.name for letter in typed.letters if letter.is_positive),
        "names": typed.names,
    }


def _components(step: Step, notation: Notation) -> list[str]:
    """Return the symbols of the components of a vector in TeX; an empty list for any other answer.

    There are no components if only the ratios of the entries have a meaning, as for the amplitudes of a mode. The same
    is true if the answer is a list of values in any order.
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
