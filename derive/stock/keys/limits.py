"""`limits:` of a problem: limiting and special cases that check answers; each case is a verified step."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

from sympy import Expr, MatrixBase, Symbol

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, bound, explicit
from derive.course.declarations import INFINITE
from derive.course.expression import Declared, read_expression
from derive.course.problem import Problem, deriving
from derive.course.problem_file import LimitKeys
from derive.course.stock import told_at
from derive.course.yaml_tree import Formula, Word
from derive.errors import Faults, did_you_mean, rejected
from derive.mechanics import case_in_letters, known_case, limiting_case, put_in
from derive.steps.homogeneity import dimension_table
from derive.steps.record import Run
from derive.steps.step import Quantity
from derive.stock.keys.formulas import OfKnownDimension


def limits_of(problem: Problem, known: Mapping[str, Quantity], run: Run) -> list[list[Quantity]]:
    """Return the steps of each case; the list of a case is empty if the case does not apply to the current inputs.

    Each case is derived in a `Run` of its own, so that the limits of one quantity can have the same symbol.
    """
    if not problem.limits:
        return []
    letters = _letters(problem, known)
    found: list[list[Quantity]] = []
    faults, keys = Faults(), set(known)
    for given in problem.limits:
        general = [quantity for quantity, case_of in zip(run.established, run.cases, strict=True) if case_of is None]
        beside = replace(run, established=general, cases=[None] * len(general))
        with faults, deriving(problem, beside):
            if _is_of_another_case(given, problem, known, letters, run) or not _is_there(given, known, letters):
                found.append([])
                continue
            case = _case(given, known, letters, keys)
            keys.add(case.key)
            stated = _as_stated(given, case, letters, known, keys)
            found.append([case, *stated, *_compared(given, case, known, keys)])
    faults.stop()
    return found


def _is_of_another_case(
    given: LimitKeys, problem: Problem, known: Mapping[str, Quantity], letters: Mapping[str, Declared], run: Run
) -> bool:
    """Return whether the limiting case does not apply to the current inputs."""
    together = {key for quantity in known.values() if quantity.step.stands_for for key in quantity.step.stands_for}
    if given.of in together or (given.of in known and known[str(given.of)].step.stands_for):
        return True
    said = [node for node in (given.letter, given.to, given.stated, *given.where.values()) if node is not None]
    needed = {letter for node in said for letter in _read(node, letters).free_symbols}
    moving = _read(given.letter, letters).free_symbols if given.letter else set()
    changed = (q for q in known.values() if q.symbol in needed - moving and str(q.symbol) not in problem.symbols)
    if any(explicit(q.value).free_symbols & moving for q in changed if isinstance(q.value, Expr)):
        return True
    return bool(({letter.name for letter in needed} & set(problem.symbols)) - set(run.letters))


def _letters(problem: Problem, known: Mapping[str, Quantity]) -> dict[str, Declared]:
    """Return the symbols of the problem, and those symbols of its steps whose dimension is known."""
    table, _ = dimension_table(problem.dimensions, [quantity.step for quantity in known.values()])
    of_steps = {
        letter.name: OfKnownDimension(letter.name, letter, "", has=dimension)
        for letter, dimension in table.items()
        if isinstance(letter, Symbol) and dimension is not None
    }
    return {**of_steps, **{letter.name: letter for letter in problem.letters}}


def _case(given: LimitKeys, known: Mapping[str, Quantity], letters: Mapping[str, Declared], keys: set[str]) -> Quantity:
    if given.step is not None:
        return _named(given.step, known)
    assert given.of is not None
    of = _named(given.of, known)
    key = _free(f"{of.key}_limit" if given.letter else f"{of.key}_case", keys)
    with told_at(given.of.place):
        if given.where:
            become = {_letter(x, letters): _read(value, letters) for x, value in given.where.items()}
            return put_in(of, become, key=key)
        assert given.letter is not None
        to = _read(given.to, letters) if given.to else 0
        return limiting_case(of, _read(given.letter, letters), to, key=key)


def _is_there(given: LimitKeys, known: Mapping[str, Quantity], letters: Mapping[str, Declared]) -> bool:
    """Return whether the result contains the symbols of the case; with changed inputs these symbols may be absent."""
    if given.of is None:
        return True
    told = _read(given.letter, letters).free_symbols if given.letter else {_letter(x, letters) for x in given.where}
    return bool(told <= explicit(_named(given.of, known).value).free_symbols)


def _letter(name: Word, letters: Mapping[str, Declared]) -> Symbol:
    if name not in letters:
        rejected("undeclared", f"`{name}` is not a symbol of this problem", name.place, did_you_mean(name, letters))
    return letters[name].symbol


def _named(name: Word, known: Mapping[str, Quantity]) -> Quantity:
    if name not in known:
        help_line = did_you_mean(name, known) or "use the key of an answer, or of a step on which an answer depends"
        rejected("no-such-answer", f"no step of the solution is called `{name}`", name.place, help_line)
    return known[name]


def _free(key: str, taken: Iterable[str]) -> str:
    """Return the key if it is free, or else the first free one of key_2, key_3, ..."""
    number, found = 1, key
    while found in set(taken):
        number += 1
        found = f"{key}_{number}"
    return found


def _read(formula: Formula, letters: Mapping[str, Declared]) -> Expr:
    return INFINITE[formula] if formula in INFINITE else read_expression(formula.scalar, letters)[0]


def _as_stated(
    given: LimitKeys, case: Quantity, letters: Mapping[str, Declared], known: Mapping[str, Quantity], keys: set[str]
) -> list[Quantity]:
    """Check the result that the file states for a case; return an additional step if the result contains symbols of
    other steps."""
    if given.stated is None:
        return []
    stated, value = _read(given.stated, letters), explicit(case.value)
    value = value.right if isinstance(value, Relation) else value
    if isinstance(value, MatrixBase):
        message = f"`{case.key}` is not a scalar; compare a vector or a tensor with another step, under `known`"
        rejected("wrong-type", message, given.stated.place)
    if equal(value, stated):
        return []
    stand_for = [q for q in known.values() if q.symbol in stated.free_symbols and isinstance(q.value, Expr)]
    if not equal(value, explicit(bound(stated, {q.symbol: q.value for q in stand_for}))):
        rejected("wrong-limit", f"`{given.of or given.step}` is {value} in this case, not {stated}", given.stated.place)
    key = _free(f"{case.key}_in_letters", keys)
    keys.add(key)
    return [case_in_letters(case, stated, stand_for, key=key)]


def _compared(given: LimitKeys, case: Quantity, known: Mapping[str, Quantity], keys: set[str]) -> list[Quantity]:
    if given.known is None:
        return []
    other = _named(given.known, known)
    key = _free(f"{case.key}_known", keys)
    keys.add(key)
    with told_at(given.known.place):
        return [known_case(case, other, key=key)]
