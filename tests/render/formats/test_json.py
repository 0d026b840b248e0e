"""SymPy alone reads the JSON: after the names are substituted, each line of a chain follows from the line before.

The checks do not use `derive`. They read the text of a page and count the compared lines.
"""

from __future__ import annotations

import json
import random
import re
from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from mpmath import mp
from sympy import Abs, Derivative, Float, Integral, MatrixBase, Pow, Symbol, diff, integrate, lambdify, sympify
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from tests.courses import course_in, rendered_once
from tests.test_transcripts import PAGES

# page -> the least number of compared pairs of lines, and the reasons that must occur among them
PAIRS: dict[str, tuple[int, set[str]]] = {
    "block": (75, {"equal", "left side", "rounded"}),
    "cone": (70, {"equal", "relation"}),
    "euler": (30, {"equal", "left side", "relation", "motion"}),
    "slab": (36, {"equal", "left side", "relation", "series"}),
    "slab-numbers": (36, {"equal", "left side", "relation", "rounded"}),
    "top": (55, {"equal", "left side", "relation", "rounded"}),
}
TURNED = {"Gt(": "Lt(", "Lt(": "Gt(", "Ge(": "Le(", "Le(": "Ge("}
WAYS = ("rounded", "series", "limit", "motion")


def roots(text: Any) -> list[str]:
    return text if isinstance(text, list) else [text]


@cache
def parsed(text: str) -> Any:
    return sympify(text)


def read(text: Any, names: dict[str, Any], motion: dict[Any, Any], root: int) -> Any:
    line = sympify(roots(text)[root % len(roots(text))], names)
    line = line.lhs - line.rhs if isinstance(line, Relational) else line
    line = line.replace(Integral, integrated).doit(integrals=False)
    return line.subs(motion) if motion else line


def integrated(f: Any, *limits: Any) -> Any:
    for i, limit in enumerate(limits):
        if f.has(Integral) or any(power.has(limit[0]) and not power.exp.is_Integer for power in f.atoms(Pow)):
            return Integral(f, *limits[i:])
        f = integrate(f.doit().expand(), limit)
    return f


def by_quadrature(f: Any, *limits: Any) -> Any:
    (y, low, high), (z, bottom, top) = limits
    f, low, high = (lambdify([z, y], each, "mpmath") for each in (f, low, high))

    def chord(z: Any) -> Any:
        return mp.quad(lambda y: mp.re(f(z, y)), [low(z, 0), high(z, 0)], maxdegree=5)

    return Float(mp.quad(chord, [bottom, top], method="gauss-legendre", maxdegree=3), 15)


def at(expr: Any, seed: int) -> list[Any]:
    entries = list(expr) if isinstance(expr, MatrixBase) else [expr]
    letters = {x for e in entries for x in e.atoms(Derivative) | e.atoms(AppliedUndef) | e.free_symbols}
    point = {x: Float(random.Random(f"{seed}{x}").uniform(0.2, 1.4), 40) for x in letters}
    for kind in (Derivative, AppliedUndef, Symbol):
        entries = [e.xreplace({x: value for x, value in point.items() if isinstance(x, kind)}) for e in entries]
    return [e.replace(Integral, by_quadrature).evalf(30) for e in entries]


def agree(left: Any, right: Any, within: Any = 0) -> bool:
    exact = not left.has(Integral) and not right.has(Integral)
    for seed in range(3 if exact else 1):
        p, q = at(left, seed), at(right, seed)
        half = at(within, seed) if within else [0] * len(p)
        noise = 1e-20 if exact else 1e-9
        if any(Abs(a - b) > w * 1.000001 + noise * (1 + Abs(a)) for a, b, w in zip(p, q, half, strict=True)):
            return False
    return True


def same(before: Any, here: Any, form: dict[str, Any], how: str, root: int) -> bool:
    if how == "rounded":
        return agree(before, here, read(form["within"], {}, {}, root))
    if how == "relation":
        factor = read(form["factor"], {}, {}, root)
        return agree(before, factor * here) and all(at(factor, seed) != [0] for seed in range(3))
    if how in ("series", "limit"):
        x, place = (sympify(form[key]) for key in ("variable", "place"))
        rest = [diff(before - here, x, n).subs(x, place) for n in range(form["order"] + 1)]
        return all(agree(each, each * 0) for each in rest)
    return agree(before, here)


def marks_fit(before: dict[str, Any], form: dict[str, Any], root: int) -> bool:
    """Whether the relation sign is unchanged, or reversed if an inequality was multiplied by a negative factor."""
    left, right = (roots(each["sympy"])[root % len(roots(each["sympy"]))][:3] for each in (before, form))
    if not {left, right} & {"Eq(", "Ne(", *TURNED}:
        return True
    negative = left in TURNED and "factor" in form and at(read(form["factor"], {}, {}, root), 0)[0] < 0
    return right == (TURNED[left] if negative else left)


def pairs(step: dict[str, Any]) -> Iterator[tuple[Any, dict[str, Any], str]]:
    chain = step["chain"]
    if step["symbol"] and step["symbol"]["formula"]:
        yield step["symbol"], chain[0], "left side"
    before = chain[0]
    for form in chain[1:]:
        relation = "factor" in form
        yield before, form, "relation" if relation else form["because"] if form["because"] in WAYS else "equal"
        before = before if form["because"] in ("value", "rounded") else form


def differing(page: dict[str, Any], compared: Counter[str]) -> Iterator[str]:
    for step in page["steps"]:
        for root in range(number_of_roots(step)):
            names = {name: parsed(roots(text)[root % len(roots(text))]) for name, text in step["names"].items()}
            motion = {parsed(rate): parsed(value) for rate, value in step.get("motion", {}).items()}
            for before, form, how in pairs(step):
                put_in = motion if form["because"] == "motion" and how != "left side" else {}
                left, right = (read(each["sympy"], names, put_in, root) for each in (before, form))
                compared[how] += 1
                if not same(left, right, form, how, root) or not marks_fit(before, form, root):
                    yield f"{step['key']}: {form['because']}"


def number_of_roots(step: dict[str, Any]) -> int:
    return max(len(roots(form["sympy"])) for form in step["chain"])


@cache
def json_of(name: str) -> str:
    problem, (edits, detail) = name.partition("-")[0], PAGES[name]
    with TemporaryDirectory() as folder:
        return rendered_once(
            course_in(Path(folder), edits, problem=problem), f"hw9/{problem}", detail, only={"json"}
        ).texts["json"]


@pytest.mark.parametrize("name", PAIRS)
def test_every_line_follows_from_the_one_before(name: str) -> None:
    page, (least, ways) = json.loads(json_of(name)), PAIRS[name]
    compared: Counter[str] = Counter()
    assert list(differing(page, compared)) == []
    lines = [(len(step["chain"]) - 1) * number_of_roots(step) for step in page["steps"]]
    assert compared.total() - compared["left side"] == sum(lines)
    assert compared.total() >= least
    assert ways <= set(compared)
    assert all(form["latex"] for step in page["steps"] for form in step["chain"])
    assert all(step["symbol"]["latex"] for step in page["steps"] if step["symbol"])


def altered(text: str) -> Iterator[str]:
    for number in re.finditer(r"(?<![\w.'])\d+(?=\*)|(?<=/)\d+(?![\w.'])|(?<=\*\*)\d+", text):
        yield f"{text[: number.start()]}{int(number[0]) + 1}{text[number.end() :]}"


@pytest.mark.parametrize("name", ["euler", pytest.param("slab", marks=pytest.mark.long)])
def test_one_altered_number_in_any_line_is_found(name: str) -> None:
    page, tried = json.loads(json_of(name)), 0
    for step in page["steps"]:
        if not list(pairs(step)):
            continue
        for form in step["chain"]:
            true = form["sympy"]
            for form["sympy"] in altered(true):
                assert any(differing({"steps": [step]}, Counter())), f"{step['key']}: {form['sympy']}"
                tried += 1
            form["sympy"] = true
    assert tried > 35


@pytest.mark.parametrize("mark", ["Ge(", "Lt(", "Eq("])
def test_another_mark_is_found(mark: str) -> None:
    page = json.loads(json_of("slab"))
    step = next(step for step in page["steps"] if step["key"] == "stability")
    assert list(differing({"steps": [step]}, Counter())) == []
    step["chain"][-1]["sympy"] = mark + step["chain"][-1]["sympy"].removeprefix("Gt(")
    assert list(differing({"steps": [step]}, Counter())) == ["stability: divided"]


def test_a_sign_that_was_lost_is_found_in_one_of_two_roots() -> None:
    page = json.loads(json_of("top"))
    step = next(step for step in page["steps"] if number_of_roots(step) == 2)
    first, _ = step["chain"][-1]["sympy"]
    assert list(differing({"steps": [step]}, Counter())) == []
    step["chain"][-1]["sympy"] = [first, first]
    assert list(differing({"steps": [step]}, Counter())) == [f"{step['key']}: {step['chain'][-1]['because']}"]
