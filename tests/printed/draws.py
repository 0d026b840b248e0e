"""Variants of every problem, drawn: letters, multiples, sums and differences, numbers with units, directions, signs.

A variant is a problem's YAML with other givens. What the door refuses is no variant; what it lets in is derived, and
every line of it is read back.
"""

from __future__ import annotations

import random
import re
import tempfile
from dataclasses import dataclass
from pathlib import Path

from derive.building.solution import derived
from derive.course.problem import load_problem
from derive.page.document import document_of
from derive.page.template import templates_of
from derive.page.wording import phrases
from derive.render.notation.notation import Notation
from derive.steps.step import Level, Step
from tests.courses import PINNED, ROOT, course_in
from tests.printed.lines import Count, check_line

PROBLEMS = ("block", "cone", "euler", "slab", "top")

LETTERS = {
    **dict.fromkeys(["a", "b", "c", "h", "R", "l", "r", "s_1"], "length"),
    **dict.fromkeys(["M", "m", "I", "m_1"], "mass"),
    **dict.fromkeys(["omega", "Omega", "nu", "S", "omega_1"], "angular speed"),
    **dict.fromkeys(["A", "B", "C", "I_x", "I_y", "I_z", "J", "I_1"], "moment of inertia"),
    **dict.fromkeys(["alpha", "beta", "theta_0"], "angle"),
    **dict.fromkeys(["g", "g_0"], "acceleration"),
    **dict.fromkeys(["n", "k"], "number"),
}
LENGTHS = ["a", "b", "c", "h", "R", "l", "s_1", "2*a", "3*b/2", "a/3", "a + b", "b - a", "R - a/2", "sqrt(2)*a"]
LENGTHS += ["2 cm", "12.5 mm", "1.2 m", "a*b/(a + b)", "n*a", "(a - b)/2", "a*cos(alpha)", "sqrt(a**2 + b**2)", "pi*a"]
MASSES = ["M", "m", "2*M", "M/3", "M + m", "M - m", "I", "m_1", "1.5 kg", "300 g", "n*M", "3*(M + m)/2", "M*m/(M + m)"]
RATES = ["omega", "-omega", "2*omega", "-omega/3", "omega - Omega", "omega + Omega", "-(omega + Omega)", "900 rpm"]
RATES += [
    "30 rad/s",
    "-12 rad/s",
    "n*omega",
    "-n*omega",
    "omega*sqrt(3)",
    "-omega_1",
    "(Omega - omega)/2",
    "omega**2/nu",
]
MOMENTS = ["A", "B", "C", "I_x", "I_y", "I_z", "I_1", "2*A", "A/2", "A + B", "A - B", "3*(A + C)/4", "2 kg m^2", "J"]
ANGLES = ["theta_0", "45 deg", "120 deg", "30 deg", "pi/3", "theta_0/2", "alpha", "0.3 rad", "alpha - beta", "100 deg"]
GRAVITIES = ["g", "9.8 m/s^2", "g_0", "g/6", "2*g", "g - g_0"]
COMPONENTS = [
    "0",
    "1",
    "-1",
    "2",
    "-3",
    "1/2",
    "sqrt(2)",
    "-sqrt(3)",
    "cos(alpha)",
    "-sin(alpha)",
    "n",
    "1 - n",
    "-n",
    "n/3",
]
COMPONENTS += ["sqrt(5)/2", "n + k", "-(n + k)", "sqrt(n**2 + 1)"]

GIVENS = {
    "block": {"sides": "lengths", "mass": "mass", "axis": "axis", "rate": "rate"},
    "cone": {"radius": "length", "height": "length", "mass": "mass"},
    "euler": {"moments": "moments"},
    "slab": {"radius": "length", "thickness": "length", "mass": "mass", "inertia": "moment", "gravity": "gravity"},
    "top": {
        "disc_mass": "mass", "radius": "length", "disc_at": "length", "rod_mass": "mass", "rod_length": "length",
        "spin": "rate", "tilt": "angle", "gravity": "gravity",
    },
}  # fmt: skip
POOLS = {"length": LENGTHS, "mass": MASSES, "rate": RATES, "moment": MOMENTS, "angle": ANGLES, "gravity": GRAVITIES}


@dataclass(frozen=True)
class Variant:
    problem: str
    givens: tuple[tuple[str, str], ...]

    def __str__(self) -> str:
        return f"{self.problem}: " + ", ".join(f"{name}: {value}" for name, value in self.givens)


def drawn(problem: str, source: random.Random) -> Variant:
    """One or two of the givens are drawn at will, the others are plain letters, so that something can be derived."""
    names = list(GIVENS[problem])
    at_will = source.sample(names, min(len(names), source.choice([1, 1, 2])))
    letters: set[str] = set()
    givens = []
    for name in names:
        value = _value(GIVENS[problem][name], source, name not in at_will)
        while name not in at_will and value in letters:
            value = _value(GIVENS[problem][name], source, True)
        letters.add(value)
        givens.append((name, value))
    return Variant(problem, tuple(givens))


def _value(kind: str, source: random.Random, plain: bool) -> str:
    if kind == "lengths":
        return f"[{', '.join(_value('length', source, plain) for _ in range(3))}]"
    if kind == "moments":
        first, second, third = (_value("moment", source, plain) for _ in range(3))
        chosen = source.choice([(first, second, third), (first, first, third), (first, first, first)])
        return f"[{', '.join(chosen)}]"
    if kind == "axis":
        if plain or source.random() < 0.3:
            return source.choice(["diagonal", "x", "y", "z"])
        components = [source.choice(["0", "1", "-1"]) for _ in range(3)]
        for i in source.sample(range(3), source.choice([1, 1, 2])):
            components[i] = source.choice(COMPONENTS)
        return f"[{', '.join(components)}]"
    pool = [text for text in POOLS[kind] if re.fullmatch(r"\w+", text)] if plain else POOLS[kind]
    return source.choice(pool)


def yaml_of(variant: Variant) -> dict[str, str]:
    text = (PINNED / f"{variant.problem}.yaml").read_text(encoding="utf-8")
    edits = {}
    used = set(re.findall(r"[A-Za-z]\w*", " ".join(value for _, value in variant.givens)))
    (line,) = re.findall(r"^symbols: .*$", text, re.M)
    edits[line] = "symbols: {" + ", ".join(f"{name}: {kind}" for name, kind in LETTERS.items() if name in used) + "}"
    for name, value in variant.givens:
        (line,) = re.findall(rf"^  {name}: .*$", text, re.M)
        edits[line] = f"  {name}: {value}"
    for section in re.findall(r"^values: .*$|^limits:\n(?: +.*\n)+", text, re.M):
        edits[section] = ""
    return edits


def steps_of(variant: Variant) -> tuple[list[Step], Notation]:
    with tempfile.TemporaryDirectory() as folder:
        root = course_in(Path(folder), yaml_of(variant), problem=variant.problem)
        problem = load_problem(root, f"hw9/{variant.problem}")
        derivation, values, known, _ = derived(problem)
        document, _ = document_of(problem, derivation, values, phrases(templates_of(ROOT)), Level.FULL)
    steps = {step.key: step for step in [*(q.step for q in known.values()), *values.values()]}
    return list(steps.values()), Notation(document.dimensions)


def check_variant(variant: Variant, count: Count) -> int:
    steps, notation = steps_of(variant)
    lines = 0
    for step in steps:
        forms = [form.expr for form in step.chain] + ([] if _is_several(step.symbol) else [step.symbol])
        for expr in forms:
            check_line(expr, notation, count, f"{variant}\n    {step.key}")
            lines += 1
    return lines


def _is_several(symbol: object) -> bool:
    return symbol is None or isinstance(symbol, tuple)
