"""What our printer writes, the reader of documents reads back equal: every scalar line of every library problem."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import pytest
from sympy import Expr, I, MatrixBase, Pow, Symbol, preorder_traversal, zoo

from derive.algebra import expressions as ex
from derive.algebra.equality import Grade, equal
from derive.audit.fingerprint import fingerprint
from derive.building.solution import derived
from derive.course.problem import load_problem
from derive.documents.choices import readings
from derive.documents.facts import facts_of
from derive.documents.meaning import Meaning, Meaningless
from derive.documents.parser import Unreadable, parsed
from derive.documents.syntax import Letter
from derive.documents.tokens import tokens_of
from derive.page.document import document_of
from derive.page.template import templates_of
from derive.page.wording import phrases
from derive.render.notation.latex import latex
from derive.render.notation.notation import Notation
from derive.steps.step import Level
from tests.courses import ROOT
from tests.printed.meaning import meaning
from tests.printed.names import Misprint, names_in

EVERY = 1 if os.environ.get("DERIVE_ALL_TESTS") else 6  # a derivation takes seconds
PROBLEMS = sorted(file.stem for file in (ROOT / "problems" / "library").glob("*/*.yaml"))[::EVERY]
FEWEST = 0.8  # share of the scalar lines that must be read; the rest are opaque derivatives and values at a place
HIGHEST_RATE = 3
SMALL = 1e-9
OPAQUE = (ex.TimeRate, ex.BodyRate, ex.CarriedRate, ex.Partial, ex.At, ex.MassIntegral, ex.Slope, ex.Component)


def lines_of(name: str) -> tuple[list[Any], Notation]:
    problem = load_problem(ROOT, f"library/{name}")
    derivation, values, known, _ = derived(problem)
    document, _ = document_of(problem, derivation, values, phrases(templates_of(ROOT)), Level.FULL)
    steps = {step.key: step for step in [*(q.step for q in known.values()), *values.values()]}
    return [form.expr for step in steps.values() for form in step.chain], Notation(document.dimensions)


def read(text: str, letters: Iterable[str] = ()) -> tuple[Any, Meaning]:
    """Read a formula of a page that introduces these letters: d is then a distance, and e is not Euler's number."""
    node = parsed(tokens_of(text))
    facts = facts_of([node, *(parsed(tokens_of(letter)) for letter in letters)], [])
    found = Meaning(facts)
    return found.of(readings(node, facts)[0][0]), found


def in_letters(value: Expr, found: Meaning, names: dict[Any, Any]) -> Expr:
    """Return what was read with the letters of the derivation in place of those of the reader."""
    put_in: dict[Symbol, Any] = {}
    for name, meant in names.items():
        if isinstance(meant, MatrixBase):
            continue
        alone, _ = read(latex(name))
        letter = next((each for symbol, each in found.symbols.items() if symbol.name == str(alone)), None)
        letter = letter or next((each for each in found.symbols.values() if _plain(each) == str(alone)), None)
        if letter is None:
            continue
        if letter.dots:
            put_in[found.symbol(letter)] = meant
            continue
        for dots in range(HIGHEST_RATE):
            read_as = found.symbol(replace(letter, dots=dots))
            put_in[read_as] = ex.rate(meant, dots) if dots else meant
    return value.xreplace(put_in)


def _plain(letter: Letter) -> str:
    return letter.named()


def _numbers(value: Expr) -> tuple[complex, ...]:
    return fingerprint(value) or ()


def check(expr: Any, notation: Notation) -> str:
    """Return how a line came back: `equal`, `unread`, `skipped`, or both expressions if they differ."""
    if not isinstance(expr, Expr) or any(isinstance(part, OPAQUE) for part in preorder_traversal(expr)):
        return "skipped"
    try:
        wanted = meaning(expr)
        names = names_in(expr, notation)
    except (Misprint, AttributeError, TypeError, NotImplementedError):
        return "skipped"
    if not isinstance(wanted, Expr) or wanted.has(zoo) or any(isinstance(n, MatrixBase) for n in names.values()):
        return "skipped"
    text = latex(notation.layout(expr))
    try:
        value, found = read(text, map(latex, names))
    except (Unreadable, Meaningless) as error:
        return f"unread {text}: {error}"
    back = in_letters(value, found, names)
    if wanted.has(I):
        back = back.subs({each: I for each in back.free_symbols if each.name == "i"})
    positive = {each: Symbol(each.name, positive=True) for each in wanted.free_symbols | back.free_symbols}
    back, wanted = back.xreplace(positive), wanted.xreplace(positive)
    if not wanted.has(I) and any(abs(each.imag) > SMALL for power in wanted.atoms(Pow) for each in _numbers(power)):
        return "skipped"  # the root of a negative number has two values
    if equal(back, wanted).grade is Grade.REFUTED or back.free_symbols - wanted.free_symbols:
        return f"{text}\n    is read as {back}\n    but is     {wanted}"
    return "equal"


@pytest.mark.parametrize("name", PROBLEMS)
def test_what_is_printed_is_read_back(name: str) -> None:
    lines, notation = lines_of(name)
    found = [check(expr, notation) for expr in lines]
    wrong = [each for each in found if not each.startswith(("equal", "unread", "skipped"))]
    assert wrong == []
    unread = [each for each in found if each.startswith("unread")]
    assert len(unread) <= (1 - FEWEST) * len(found), unread
