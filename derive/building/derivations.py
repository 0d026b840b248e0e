"""A derivation as stored between builds. A page with new wording uses the stored derivation.

A stored derivation depends on derive's own modules, SymPy and mpmath, on the script and its modules, and on the
reference. It also depends on these entries of the problem:

    - the given values, the symbols, and all other entries that `OF_PAGES`, `IN_PARTS` and `OF_FILES` do not name
    - the answers, forms and cases that parts ask for, and the chosen observations
    - the quantities, ranges, levels, surfaces, curves and labels of plots
    - the marks that the problem adds to drawings

It does not depend on templates, or on prose such as the statement and the questions.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

from derive.building.cache import digest, engine_digest
from derive.course.placement import ON_REQUEST
from derive.course.problem import Problem
from derive.course.reference.comparison import Told
from derive.course.reference.errata import Erratum
from derive.course.reference.quotes import Remark
from derive.course.reference.statements import reference_paths
from derive.figures.encoding import drawings_from_data, drawings_to_data
from derive.figures.marks import Recorded
from derive.steps.derivation import Derivation, from_json, to_json
from derive.steps.step import Step

# Entries of a problem that do not change its steps, or whose relevant parts `steps_key` includes one by one. Any other
# entry is included as a whole.
OF_PAGES = {"title", "statement", "points", "wording", "show", "strategy", "note", "figure", "places", "warnings"}
IN_PARTS = {"parts", "drawings", "observations", "script", "script_path"}
OF_FILES = {"path", "root", "variations", "is_variant"}


@dataclass(frozen=True)
class Solved:
    """The steps of a problem, the numbers of its answers, the comparison with its reference, and its drawings."""

    derivation: Derivation
    values: Mapping[str, Step]
    compared: tuple[Told, ...]
    drawings: tuple[Recorded, ...] = ()

    def to_data(self) -> dict[str, Any]:
        """Return JSON data; raise `ValueError` if an integer is too long for JSON, and `RecursionError` if a value is
        nested too deeply."""
        return {
            "derivation": to_json(self.derivation),
            "answers": list(self.values),
            "values": to_json(Derivation(tuple(self.values.values()), ())),
            "compared": [
                [t.facts, t.here, t.erratum and t.erratum.encoded(), t.remark and t.remark.to_data()]
                for t in self.compared
            ],
            "drawings": drawings_to_data(self.drawings),
        }

    @classmethod
    def from_data(cls, data: Any) -> Solved | None:
        """Return the object that `to_data` encoded; None if the data are not valid."""
        try:
            values = from_json(data["values"])
            told = tuple(
                Told(facts, here, Erratum.decoded(erratum) if erratum else None, Remark(**remark) if remark else None)
                for facts, here, erratum, remark in data["compared"]
            )
            answers = dict(zip(data["answers"], values.steps, strict=True))
            return cls(from_json(data["derivation"]), answers, told, drawings_from_data(data["drawings"]))
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
            return None


def steps_key(problem: Problem) -> str:
    """Return a digest of the inputs of the steps, which the docstring of this module lists."""
    _, *scripts = problem.inputs
    files = [problem.root / path for path in (*scripts, *reference_paths(problem))]
    texts = [file.read_bytes() if file.is_file() else f"is there: {file.exists()}" for file in files]
    forms = [sorted((str(key), form) for key, form in part.forms.items()) for part in problem.parts]
    asked = [(part.answers, form, problem.cases_of(part)) for part, form in zip(problem.parts, forms, strict=True)]
    facts = [getattr(problem, each.name) for each in fields(problem) if each.name not in OF_PAGES | IN_PARTS | OF_FILES]
    observed = (problem.observations, [part.observations for part in problem.parts])
    plots = [
        (d.key, d.plot, d.curves, d.labels, d.surfaces, d.against, d.range, d.then, d.levels, d.over, d.per, d.energies)
        for d in problem.drawings
        if d.is_of_engine or d.key in ON_REQUEST
    ]
    marked = [each for each in problem.drawings if each.marks or each.like or each.without]
    marks = [(d.key, d.like, d.without, [mark.written for mark in d.marks]) for d in marked]
    read = (repr(asked), repr(observed), repr(plots), repr(marks))
    return digest("steps", engine_digest("sympy", "mpmath"), *texts, *read, repr(facts))
