"""A derivation kept from one build to the next, so that a reworded page is not derived again.

The key is everything that a derivation depends on: derive's own modules and SymPy, the script, what is given, which
steps answer the parts and in what form, and the reference. Words, points and templates are not among it. Only builds
use it; `derive solve` and `derive check` derive.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from derive.derivation import Derivation, from_json, to_json
from derive.errata import Erratum
from derive.figures.kept import drawings_from_data, drawings_to_data
from derive.figures.marks import Recorded
from derive.manifest import digest, package_version
from derive.output import write
from derive.problem import Problem
from derive.reference import Told
from derive.stated import reference_path
from derive.step import Step


@dataclass(frozen=True)
class Solved:
    """A problem's steps, those that give its answers their numbers, what its reference says of them, its drawings."""

    derivation: Derivation
    values: Mapping[str, Step]
    compared: tuple[Told, ...]
    drawings: tuple[Recorded, ...] = ()


def key_of(problem: Problem) -> str:
    """A digest of everything that the steps depend on."""
    package = Path(__file__).parent
    modules = [part for p in sorted(package.rglob("*.py")) for part in (p.name, p.read_bytes())]
    files = [problem.root / problem.script_path, problem.root / reference_path(problem)]
    texts = [file.read_bytes() if file.is_file() else b"" for file in files]
    asked = [(part.answers, sorted((str(key), form) for key, form in part.forms.items())) for part in problem.parts]
    facts = repr((problem.id, problem.givens, problem.symbols, problem.measured, problem.figures, asked))
    return digest(*modules, f"{package_version('sympy')}", *texts, facts)


def recalled(file: Path, key: str) -> Solved | None:
    """What was kept under this key; nothing if it was kept under another, was altered, or cannot be read."""
    try:
        sealed = json.loads(file.read_text(encoding="utf-8"))
        if sealed["key"] != key or sealed["seal"] != digest(key, sealed["steps"]):
            return None
        kept = json.loads(sealed["steps"])
        values = from_json(kept["values"])
        told = tuple(Told(f, here, Erratum.decoded(e) if e else None) for f, here, e in kept["compared"])
        answers = dict(zip(kept["answers"], values.steps, strict=True))
        return Solved(from_json(kept["derivation"]), answers, told, drawings_from_data(kept["drawings"]))
    except (OSError, ValueError, KeyError, TypeError):
        return None


def keep(file: Path, key: str, solved: Solved) -> None:
    kept: dict[str, Any] = {
        "derivation": to_json(solved.derivation),
        "answers": list(solved.values),
        "values": to_json(Derivation(tuple(solved.values.values()), ())),
        "compared": [[t.facts, t.here, t.erratum and t.erratum.encoded()] for t in solved.compared],
        "drawings": drawings_to_data(solved.drawings),
    }
    steps = json.dumps(kept)
    write(file, json.dumps({"key": key, "seal": digest(key, steps), "steps": steps}))
