"""A derivation kept from one build to the next, so that a reworded page is not derived again.

The key is everything that a derivation depends on: derive's own modules and SymPy, the script, what is given, which
steps answer the parts and in what form, and the reference. Words, points and templates are not among it. Only builds
use it; `derive solve` and `derive check` derive.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from derive import FOLDER
from derive.building import sealed
from derive.building.manifest import digest, package_version
from derive.course.problem import Problem
from derive.course.reference.comparison import Remark
from derive.course.reference.errata import Erratum
from derive.course.reference.statements import reference_path
from derive.figures.encoding import drawings_from_data, drawings_to_data
from derive.figures.marks import Recorded
from derive.steps.derivation import Derivation, from_json, to_json
from derive.steps.step import Step


@dataclass(frozen=True)
class Solved:
    """A problem's steps, those that give its answers their numbers, what its reference says of them, its drawings."""

    derivation: Derivation
    values: Mapping[str, Step]
    compared: tuple[Remark, ...]
    drawings: tuple[Recorded, ...] = ()


def key_of(problem: Problem) -> str:
    """A digest of everything that the steps depend on."""
    modules = [part for p in sorted(FOLDER.rglob("*.py")) for part in (p.name, p.read_bytes())]
    files = [problem.root / problem.script_path, problem.root / reference_path(problem)]
    texts = [file.read_bytes() if file.is_file() else f"is there: {file.exists()}" for file in files]
    asked = [(part.answers, sorted((str(key), form) for key, form in part.forms.items())) for part in problem.parts]
    facts = repr((problem.id, problem.givens, problem.symbols, problem.measured, problem.figures, asked))
    return digest(*modules, f"{package_version('sympy')}", *texts, facts)


def recalled(file: Path, key: str) -> Solved | None:
    """What was kept under this key; nothing if it was kept under another, was altered, or cannot be read."""
    kept = sealed.recalled(file, key)
    try:
        values = from_json(kept["values"])
        told = tuple(Remark(f, here, Erratum.decoded(e) if e else None) for f, here, e in kept["compared"])
        answers = dict(zip(kept["answers"], values.steps, strict=True))
        return Solved(from_json(kept["derivation"]), answers, told, drawings_from_data(kept["drawings"]))
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None


def keep(file: Path, key: str, solved: Solved) -> None:
    try:
        kept: dict[str, Any] = {
            "derivation": to_json(solved.derivation),
            "answers": list(solved.values),
            "values": to_json(Derivation(tuple(solved.values.values()), ())),
            "compared": [[t.facts, t.here, t.erratum and t.erratum.encoded()] for t in solved.compared],
            "drawings": drawings_to_data(solved.drawings),
        }
    except (ValueError, RecursionError):  # numbers or expressions that JSON cannot hold: derived again next time
        return
    sealed.keep(file, key, kept)
