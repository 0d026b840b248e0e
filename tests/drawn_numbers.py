"""Derive every problem of hw9 and the library with random numbers for its letters: none may end in an internal error.

`python -P -m tests.drawn_numbers --draws 4 --seed 1` derives and prints all of them, and lists those that are refused
or end in an internal error. The numbers are in the declared ranges and satisfy the assumptions of the page; some are
very large or very small.
"""

from __future__ import annotations

import argparse
import re
import sys
import tempfile
import traceback
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

from sympy import Rational, Symbol, pi

from derive.algebra.expressions import TIME, Relation, explicit
from derive.algebra.kinds import unit_of_kind
from derive.building.solution import derived, rendered
from derive.course.arithmetic import Declared
from derive.course.problem import Problem, load_problem
from derive.errors import DeriveError
from tests.courses import ROOT

SETS = ("hw9", "library")
ORDINARY = ("0.3", "0.7", "1", "1.5", "2", "2.5", "3", "5", "9.8", "12", "40", "0.02")
EXTREME = ("8.0e37", "6e24", "1.5e11", "6.67e-11", "1.2e-9", "9.11e-31")
ANGLES = ("5", "20", "30", "40", "45", "60", "75")
NUMBERS = ("0.5", "1.5", "2", "3", "0.2")
SHARES = (Rational(1, 7), Rational(1, 4), Rational(1, 3), Rational(1, 2), Rational(5, 8), Rational(9, 10))
SPREAD = (Rational(1), Rational(6, 5), Rational(3, 2), Rational(19, 10))  # ratios of moments of inertia of one body
ODDS = 0.15  # probability of an extreme number
TRIES = 200  # most draws until the assumptions hold
GOOD, REFUSED, INTERNAL = "printed", "refused", "internal error"


@dataclass(frozen=True)
class Outcome:
    problem: str
    draw: int
    sort: str
    values: Mapping[str, str]
    told: str = ""


def problems() -> list[str]:
    """Return the names of the problems of all sets, such as `library/simple_pendulum`."""
    names = (f"{name}/{file.stem}" for name in SETS for file in sorted((ROOT / "problems" / name).rglob("*.yaml")))
    return [name for name in names if not name.endswith(("/set", "/reference"))]


def tried(name: str, draws: int, seed: int) -> Iterator[Outcome]:
    """Yield the result for one problem with each of several draws of numbers."""
    source = Random(f"{name} {seed}")
    problem = load_problem(ROOT, name)
    with tempfile.TemporaryDirectory() as folder:
        root = _course(Path(folder))
        conditions = _conditions(problem)
        for draw in range(draws):
            values = drawn(problem, conditions, source)
            (root / problem.path).write_text(with_values(_text_of(problem), values), encoding="utf-8")
            sort, told = GOOD, ""
            try:
                rendered(root, name, only=("text", "latex"))
            except DeriveError as refusal:
                sort, told = REFUSED, str(refusal)
            except Exception:
                sort, told = INTERNAL, traceback.format_exc()
            yield Outcome(name, draw, sort, values, told)


def _course(folder: Path) -> Path:
    (folder / "templates").symlink_to(ROOT / "templates")
    for name in SETS:
        for file in (ROOT / "problems" / name).rglob("*.*"):
            to = folder / file.relative_to(ROOT)
            to.parent.mkdir(parents=True, exist_ok=True)
            to.write_bytes(file.read_bytes())
    return folder


def _conditions(problem: Problem) -> list[Relation]:
    """Return the assumptions of the page of the problem without numbers."""
    *_, run = derived(problem, None)
    return list(run.assumed)


def drawn(problem: Problem, conditions: Sequence[Relation], source: Random) -> dict[str, str]:
    """Return a number with its unit for each declared letter that has none, such that the conditions hold."""
    letters = [each for each in problem.symbols.values() if each.symbol not in {*problem.amounts, TIME}]
    used = [each for each in letters if each.name in _text_of(problem)]
    for _ in range(TRIES):
        found = {each.name: _number(each, source) for each in used} | _moments(used, source)
        known = {each.symbol: value for each in used for _, value in [found[each.name]]}
        known |= {letter: explicit(amount) for letter, amount in problem.amounts.items()}
        if all(_may_hold(condition, known) for condition in conditions):
            return {name: written for name, (written, _) in found.items()}
    return {}


def _moments(letters: Sequence[Declared], source: Random) -> dict[str, tuple[str, Any]]:
    """Return moments of inertia such that none is greater than the sum of two others."""
    base = Rational(source.choice(ORDINARY + EXTREME))
    found = {}
    for letter in (each for each in letters if each.kind == "moment of inertia"):
        size = f"{float(base * source.choice(SPREAD)):.4g}".replace("e+", "e")
        found[letter.name] = (f"{size} {unit_of_kind(letter.kind)}", Rational(size))
    return found


def _text_of(problem: Problem) -> str:
    return (ROOT / problem.path).read_text(encoding="utf-8")


def _number(letter: Declared, source: Random) -> tuple[str, Any]:
    """Return a number as text with its unit, and its value."""
    unit = unit_of_kind(letter.kind)
    if letter.lies is not None and letter.lies.least.is_finite and letter.lies.greatest.is_finite:
        share = source.choice(SHARES)
        value = letter.lies.least + share * (letter.lies.greatest - letter.lies.least)
        if letter.kind == "angle":
            degrees = Rational(round(float(value * 180 / pi) * 10), 10)
            return f"{float(degrees):g} deg", degrees * pi / 180
        size = Rational(str(round(float(value), 3)))
        return f"{float(size):g} {unit}".strip(), size
    if letter.kind == "angle":
        degrees = Rational(source.choice(ANGLES))
        return f"{degrees} deg", degrees * pi / 180
    sizes = NUMBERS if letter.kind == "number" else EXTREME if source.random() < ODDS else ORDINARY
    text = source.choice(sizes)
    if letter.lies is not None and not letter.lies.least <= Rational(text) <= letter.lies.greatest:
        text = str(letter.lies.near(Rational(text)))
    return f"{text} {unit}".strip(), Rational(text)


def _may_hold(condition: Relation, known: Mapping[Symbol, Any]) -> bool:
    difference = explicit(condition.residual).xreplace(dict(known))
    if difference.free_symbols:
        return True
    value = difference.evalf(20)
    return bool(
        {">": value > 0, "<": value < 0, ">=": value >= 0, "<=": value <= 0}.get(condition.operator, value != 0)
    )


def with_values(text: str, values: Mapping[str, str]) -> str:
    """Return the text of the file with these entries added under `values:`."""
    lines = "".join(f"  {name}: {value}\n" for name, value in values.items())
    if not values:
        return text
    if re.search(r"^values:\n", text, flags=re.M):
        return re.sub(r"^values:\n", lambda _: f"values:\n{lines}", text, count=1, flags=re.M)
    flow = re.search(r"^values: \{", text, flags=re.M)
    if flow:
        entries = ", ".join(f"{name}: {value}" for name, value in values.items())
        return f"{text[: flow.end()]}{entries}, {text[flow.end() :]}"
    return f"{text.rstrip()}\nvalues:\n{lines}"


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -P -m tests.drawn_numbers", description=__doc__)
    parser.add_argument("--draws", type=int, default=4)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("names", nargs="*", help="problems; all of them unless given")
    asked = parser.parse_args(arguments)
    count: Counter[str] = Counter()
    for name in asked.names or problems():
        for outcome in tried(name, asked.draws, asked.seed):
            count[outcome.sort] += 1
            if outcome.sort != GOOD:
                print(f"--- {name}, draw {outcome.draw}: {outcome.sort}\n{dict(outcome.values)}\n{outcome.told}")
    print(", ".join(f"{count[sort]} {sort}" for sort in (GOOD, REFUSED, INTERNAL)))
    return int(count[INTERNAL] > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
