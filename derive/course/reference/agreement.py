"""The comparison of one statement of a document with the derived step.

A letter that is not in the step's value may mean the result of an earlier step: `rho`, `J_xx`, or the component
`omega_x` of a spin.
"""

from __future__ import annotations

from collections.abc import Iterable
from collections.abc import Mapping as Table
from dataclasses import replace
from typing import Any

from sympy import Add, Expr, Integer, MatrixSymbol, Pow, Rational, Symbol, factor_terms

from derive.algebra.dimensions import Dimension
from derive.algebra.equality import Grade, Verdict, equal
from derive.algebra.expressions import AXES, PLUS_MINUS, Relation, component_names, explicit
from derive.algebra.kinds import dimension_of_kind, kind_with_article, named
from derive.algebra.normal_form import vanishes
from derive.algebra.rounding import Rounded, off_by_more_than_half_a_unit
from derive.algebra.samples import is_zero_everywhere
from derive.course.problem import Problem
from derive.course.reference.statements import Entry, Stated, Statement
from derive.steps.derivation import with_ancestors
from derive.steps.step import Quantity
from derive.units import read_unit

NOT_MULTIPLIED = "a factor needs two equations, or two relations with `!=`"


def given_values(problem: Problem) -> dict[str, Any]:
    return {given.name: given.value for given in problem.givens}


def verdict_on(statement: Statement, step: Quantity, entry: Entry, pinned: Problem) -> Verdict:
    """Compare a statement with a step: a relation as a whole, a value entry by entry and branch by branch."""
    derived = explicit(step.value)
    meanings = _meanings(statement, entry.times, step, derived, pinned)
    if entry.times is not None and not isinstance(derived, Relation):
        verdict = Verdict(Grade.REFUTED, NOT_MULTIPLIED)
    elif isinstance(derived, Relation):
        verdict = _of_relation(statement, derived, entry, pinned, meanings)
    elif len(statement.sides) > 1 or statement.marks[0] not in {"", "=", "~"}:
        verdict = Verdict(Grade.REFUTED, "a relation against a value")
    else:
        verdict = _of_value(statement.sides[0], derived, step.step.kind, entry, pinned, meanings)
    names = ", ".join(sorted(letter.name for letter, value in meanings.items() if not _is_called(value, letter.name)))
    return replace(verdict, detail=f"{verdict.detail}, for {names} as derived") if verdict and names else verdict


def _is_called(value: Expr, name: str) -> bool:
    return isinstance(value, Symbol) and value.name == name


def _of_value(
    stated: Stated, derived: Any, kind: str | None, entry: Entry, pinned: Problem, meanings: Table[Symbol, Expr]
) -> Verdict:
    shape = tuple(int(n) for n in getattr(derived, "shape", ()))
    if shape != stated.shape:
        return Verdict(Grade.REFUTED, f"{_named_shape(stated.shape)} against {_named_shape(shape)}")
    branches = [_entries_of(derived.xreplace({PLUS_MINUS: sign})) for sign in _signs(derived)]
    stated_values = [[explicit(expr.xreplace(meanings)) for expr, _ in entries] for entries in stated.branches]
    kept = {letter for values in stated_values for value in values for letter in value.free_symbols}
    numbers = _numbers(pinned, kept, entry)
    if len(stated.branches) > len(branches):
        return Verdict(Grade.REFUTED, "two values against one")

    def of_branch(i: int, j: int) -> Verdict:
        worst = Verdict(Grade.PROVED, "identical")
        for n, (value, right) in enumerate(zip(stated_values[i], branches[j], strict=True)):
            dimension = stated.branches[i][n][1] if stated.homogeneous else None
            figures = entry.figures[(n if shape else i) % len(entry.figures)] if entry.figures else None
            verdict = _of_entry(value.xreplace(numbers), right.xreplace(numbers), dimension, kind, figures, entry)
            if not verdict:
                return replace(verdict, detail=_named_entry(n, shape) + verdict.detail)
            if worst.grade is Grade.PROVED and verdict.detail != "identical":
                worst = verdict
        return worst

    # The order of two branches has no meaning, and the document may state only one branch.
    orders = [[0], [1]] if len(stated.branches) < len(branches) else [list(range(len(branches)))]
    if len(stated.branches) == 2:
        orders.append([1, 0])
    found = [_least_sure(of_branch(i, j) for i, j in enumerate(order)) for order in orders]
    return next((verdict for verdict in found if verdict), found[0])


def _of_entry(
    value: Expr, right: Expr, dimension: Dimension | None, kind: str | None, figures: int | None, entry: Entry
) -> Verdict:
    unit = entry.unit or read_unit("rad")
    verdict = _of_kind(dimension * unit.dimension, value, kind) if dimension is not None else None
    if verdict is None and figures:
        verdict = _to_figures(value, right / unit.factor, figures)
    return equal(value * unit.factor, right) if verdict is None else verdict


def _least_sure(verdicts: Iterable[Verdict]) -> Verdict:
    worst: Verdict | None = None
    for verdict in verdicts:
        if not verdict:
            return verdict
        if worst is None or (worst.grade is Grade.PROVED and verdict.detail != "identical"):
            worst = verdict
    assert worst is not None
    return worst


def _of_relation(
    statement: Statement, derived: Relation, entry: Entry, pinned: Problem, meanings: Table[Symbol, Expr]
) -> Verdict:
    """Compare the document's relation with the derived relation. If the entry states a factor, the derived equation is
    first multiplied by it."""
    sides = statement.sides
    if any(side.shape for side in sides):
        return Verdict(Grade.REFUTED, f"{_named_shape(sides[0].shape)} against a relation")
    if len(sides) > 2 or statement.marks[-1] == "~" or any(len(side.branches) > 1 for side in sides):
        return Verdict(Grade.REFUTED, "this is not a single exact relation")
    if len(sides) == 1:  # an equation may be stated as an expression that vanishes
        sides = (sides[0], replace(sides[0], branches=(((Integer(0), sides[0].entries[0][1]),),)))
    mark = statement.marks[1] if len(statement.sides) == 2 else "="
    left, right = (_in_its_unit(side.entries[0][0].xreplace(meanings), side.entries[0][1], entry) for side in sides)
    if all(side.homogeneous for side in sides) and 0 not in (left[0], right[0]) and left[1] != right[1]:
        return Verdict(Grade.REFUTED, f"{named(left[1])} against {named(right[1])}")
    kept = left[0].free_symbols | right[0].free_symbols
    numbers = _numbers(pinned, kept, entry)
    stated = explicit(Relation(left[0], mark, right[0]).xreplace(numbers))
    ours = explicit(derived.xreplace(numbers))
    if ours != derived and vanishes(ours.residual) and not vanishes(derived.residual):
        return Verdict(
            Grade.REFUTED, "with these numbers both sides of the derived relation are equal, so nothing can be compared"
        )
    if entry.figures:
        return _bound_to_figures(stated, ours, entry)
    if entry.times is None:
        return equal(stated, ours)
    if stated.operator != ours.operator or ours.operator not in {"=", "!="}:
        return Verdict(Grade.REFUTED, NOT_MULTIPLIED)
    factor = explicit(entry.times.sides[0].entries[0][0].xreplace(meanings).xreplace(numbers))
    if vanishes(factor) or is_zero_everywhere(factor) is not False:
        return Verdict(Grade.REFUTED, "`times` is zero or may be zero, so any statement could agree")
    verdict = equal(stated.residual, factor * ours.residual)
    if not verdict:
        turned = equal(stated.residual, -factor * ours.residual)  # the two sides may be exchanged
        verdict = turned if turned else verdict
    return verdict


def _in_its_unit(expr: Expr, dimension: Dimension, entry: Entry) -> tuple[Expr, Dimension]:
    """Return an expression and its dimension. A nonzero number is multiplied by the unit of the entry."""
    if entry.unit is None or not expr.is_number or expr == 0:
        return expr, dimension
    return expr * entry.unit.factor, dimension * entry.unit.dimension


def _bound_to_figures(stated: Relation, ours: Relation, entry: Entry) -> Verdict:
    """Compare the decimal in a relation such as `S > 28` with the derived number."""
    if stated.left != ours.left or stated.operator != ours.operator or stated.right.free_symbols:
        return Verdict(Grade.REFUTED, f"`{stated}` against `{ours}`")
    factor = entry.unit.factor if entry.unit else Integer(1)
    return _to_figures(stated.right / factor, ours.right / factor, entry.figures[0])


def _signs(derived: Any) -> tuple[int, ...]:
    return (Integer(1), Integer(-1)) if PLUS_MINUS in derived.free_symbols else (Integer(1),)


def _entries_of(value: Any) -> list[Expr]:
    return list(value) if hasattr(value, "shape") else [value]


def _numbers(pinned: Problem, kept: set[Symbol], entry: Entry) -> dict[Symbol, Expr]:
    """Return the numbers to substitute for letters that the statement lacks or replaces by numbers."""
    return {m.symbol: m.si for m in pinned.measured if m.symbol not in kept or m.symbol.name in entry.put_in}


def _named_shape(shape: tuple[int, ...]) -> str:
    names = {(): "a scalar", (3, 1): "a vector", (3, 3): "a tensor"}
    return names.get(shape) or f"a matrix of {shape[0]} by {shape[1]}"


def _named_entry(i: int, shape: tuple[int, ...]) -> str:
    if not shape:
        return ""
    if shape not in {(3, 1), (3, 3)}:
        return f"entry {i + 1}: "
    return f"{AXES[i]}: " if shape[1] == 1 else f"{AXES[i // 3]}{AXES[i % 3]}: "


def _meanings(
    stated: Statement, times: Statement | None, step: Quantity, derived: Any, pinned: Problem
) -> dict[Symbol, Expr]:
    """Return the meaning of each letter of a statement: the same letter, or the result of an earlier step."""
    own = {letter.name: letter for letter in derived.free_symbols}
    given = {
        letter.name: letter for expr in _expressions(given_values(pinned).values()) for letter in expr.free_symbols
    }
    behind = list(with_ancestors(step.parents).values())
    found = {name: values for name, values in _found_before(behind).items() if name not in {*own, *given}}
    wanted = stated.letters | (times.letters if times else set())
    known = {**{m.symbol.name: m.symbol for m in pinned.measured}, **given, **own}
    if any(letter.name not in known and len(found.get(letter.name, ())) != 1 for letter in wanted):
        known = {**_letters_of(behind), **known}
    # A name with two meanings in earlier steps, such as the inertia tensors of two bodies, is not replaced.
    return {
        letter: values[0] if len(values := found.get(letter.name, [])) == 1 else known.get(letter.name, letter)
        for letter in wanted
    }


def _letters_of(steps: Iterable[Quantity]) -> dict[str, Symbol]:
    letters = {letter for step in steps for letter in getattr(explicit(step.value), "free_symbols", ())}
    return {letter.name: letter for letter in sorted(letters, key=lambda x: (not x.is_nonzero, x.name))}


def _expressions(values: Any) -> list[Expr]:
    return [expr for v in values for expr in (v if isinstance(v, tuple) else (v,)) if isinstance(expr, Expr)]


def _found_before(steps: Iterable[Quantity]) -> dict[str, list[Any]]:
    """Map the name of each result, or of each component of a vector, to its distinct values in these steps."""
    found: dict[str, list[Any]] = {}
    for quantity in steps:
        names: tuple[Symbol, ...] = (quantity.symbol,) if isinstance(quantity.symbol, Symbol) else ()
        values = [quantity.value]
        if isinstance(quantity.symbol, MatrixSymbol) and quantity.symbol.shape == (3, 1):
            names, values = component_names(quantity.symbol.name), list(quantity.value)
        for name, value in zip(names, values, strict=False):
            if value != name and value not in found.setdefault(name.name, []):
                found[name.name].append(value)
    return found


def _of_kind(dimension: Dimension, value: Expr, kind: str | None) -> Verdict | None:
    if kind is None or value == 0 or dimension == dimension_of_kind(kind):
        return None
    return Verdict(Grade.REFUTED, f"{named(dimension)} against {kind_with_article(kind)}")


def _to_figures(stated: Expr, derived: Expr, figures: int) -> Verdict:
    """Judge whether each printed decimal agrees with the derived number within half a unit of the decimal's last
    digit."""
    printed, exact = _coefficients(stated), _coefficients(derived)
    if printed.keys() != exact.keys():
        return Verdict(Grade.REFUTED, f"{stated} against {derived}")
    for letters, number in printed.items():
        decimal = Rounded(Rational(str(number.evalf(40))), Integer(figures))
        if off_by_more_than_half_a_unit(exact[letters], decimal):
            return Verdict(Grade.REFUTED, f"{number.evalf(figures)} against {exact[letters].evalf(figures + 2)}")
    return Verdict(Grade.APPROXIMATION, "within half a unit of the last place")


def _coefficients(expr: Expr) -> dict[Expr, Expr]:
    """Map products of letters to their coefficients."""
    found: dict[Expr, Expr] = {}
    opened = expr.replace(
        lambda e: isinstance(e, Pow) and not e.exp.is_Integer, lambda e: factor_terms(e.base) ** e.exp
    )
    for term in Add.make_args(opened.expand()):
        number, letters = term.as_independent(*expr.free_symbols, as_Add=False)
        if number != 0:
            found[letters] = found.get(letters, Integer(0)) + number
    return found
