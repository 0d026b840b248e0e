"""What a change of the code is tried on: the pinned problems and their variants, solved and printed as text."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from derive.building.solution import derived
from derive.course.problem import Problem, load_problem
from derive.page.document import document_of
from derive.page.template import templates_of
from derive.page.wording import phrases
from derive.render.notation.notation import Notation
from derive.render.printing.text_page import page_text
from derive.steps.derivation import Derivation
from derive.steps.step import Level, Step
from tests.courses import PINNED, ROOT, course_in
from tests.test_transcripts import PAGES

WORDS = phrases(templates_of(ROOT))


@dataclass(frozen=True)
class Solved:
    derivation: Derivation
    values: dict[str, Step]
    problem: Problem
    drawings: Sequence[Any]

    @property
    def steps(self) -> tuple[object, ...]:
        return self.derivation, tuple(self.values.items())

    @property
    def by_key(self) -> dict[str, Step]:
        return {step.key: step for step in self.derivation.steps}

    @property
    def page(self) -> str:
        document, faults = document_of(
            self.problem, self.derivation, self.values, WORDS, Level.FULL, drawings=self.drawings
        )
        if faults:
            raise ValueError(faults)
        return page_text(document, WORDS, Notation(document.dimensions))


@dataclass(frozen=True)
class Run:
    """A pinned problem with edits of its text and of its script, as `course_in` makes them."""

    name: str
    edits: tuple[tuple[str, str], ...] = ()
    script: tuple[tuple[str, str], ...] = ()

    @cached_property
    def _folder(self) -> tempfile.TemporaryDirectory[str]:
        return tempfile.TemporaryDirectory()

    @cached_property
    def course(self) -> Path:
        name = self.name.partition("-")[0]
        return course_in(Path(self._folder.name), dict(self.edits), dict(self.script), problem=name)

    @property
    def id(self) -> str:
        return f"hw9/{self.name.partition('-')[0]}"

    def solved(self) -> Solved:
        forget()
        problem = load_problem(self.course, self.id)
        derivation, values, _, run = derived(problem)
        return Solved(derivation, values, problem, run.drawings)


@dataclass(frozen=True)
class LibraryRun(Run):
    @cached_property
    def course(self) -> Path:
        return ROOT

    @property
    def id(self) -> str:
        return self.name


@dataclass(frozen=True)
class OwnRun(Run):
    @cached_property
    def course(self) -> Path:
        course = Path(self._folder.name)
        (course / "templates").symlink_to(ROOT / "templates")
        (course / "problems").mkdir()
        (course / "problems" / "own").symlink_to(OWN)
        return course

    @property
    def id(self) -> str:
        return self.name


def forget() -> None:
    """Clear every cache of `derive` whose values a changed function may have made.

    The algebra lies below all that is changed and calls none of it, so its caches hold what they would hold again. The
    folder of the preambles is not a value, and is removed at the end.
    """
    for clear in _caches():
        clear.cache_clear()


def _caches() -> Iterator[Any]:
    for name, module in list(sys.modules.items()):
        if name.partition(".")[0] == "derive" and not name.startswith("derive.algebra"):
            for value in list(vars(module).values()):
                of_class = vars(value).values() if isinstance(value, type) else ()
                yield from (each for each in (value, *of_class) if hasattr(each, "cache_clear") and _is_own(each))


def _is_own(function: Any) -> bool:
    """Whether it is defined outside of these modules; another module may have imported it from there."""
    return not str(getattr(function, "__module__", "")).startswith(("derive.algebra", "derive.building.preamble"))


def _of_transcripts() -> dict[str, Run]:
    found: dict[tuple[str, tuple[tuple[str, str], ...]], Run] = {}
    for name, (edits, _) in PAGES.items():
        found.setdefault((name.partition("-")[0], tuple(edits.items())), Run(name, tuple(edits.items())))
    return {run.name: run for run in found.values()}


def _body(name: str, made: str, start: str, axes: Sequence[int] = (), edits: Sequence[tuple[str, str]] = ()) -> Run:
    script = [
        ("mechanics.Ball(radius, mass)", f"mechanics.{made}"),
        ('start, about = "centre"', f'start, about = "{start}"'),
    ]
    answers = "first_tensor, about_x, squared_gyration"
    if start != "centre":
        more = ["inertia_tensor", "principal_moments", *(f"principal_axis_{k}" for k in axes), "moved_tensor"]
        edits = [*edits, (f"answer: [{answers}]", f"answer: [{answers}, {', '.join(more)}]")]
    return Run(f"body-{name}", tuple(edits), tuple(script))


NUMBERS = (("radius: R", "radius: 4 cm"), ("height: h", "height: 10 cm"), ("mass: M", "mass: 300 g"))
SKEW = (
    ("moved = mechanics.moved_to(J, mechanics.centre_of_mass(body, origin=start))", "moved = J"),
    (
        'back = mechanics.moved_from_centre(moved, mechanics.centre_of_mass(body, origin=start), symbol="J\'")',
        "back = J",
    ),
)
BODIES = (
    Run("body"),
    _body("cylinder", "Cylinder(radius, height, mass)", "base", (1, 3)),
    _body("disc", "Disc(radius, mass)", "rim"),
    _body("hoop", "Hoop(radius, mass)", "rim", (), NUMBERS),
    _body("rod", "Rod(height, mass)", "end", (), NUMBERS),
    _body("plate", "Plate((radius, height), mass)", "corner", (1, 2, 3)),
    _body("cuboid", "Cuboid((radius, radius, height), mass)", "corner", (1, 3)),
    Run(
        "body-skew",
        (("answer: [first_tensor", "answer: [principal_moments, principal_axis_1, principal_axis_3, first_tensor"),),
        (
            ("mechanics.Ball(radius, mass)", "mechanics.Plate((2 * radius, 3 * radius), mass)"),
            ('start, about = "centre"', 'start, about = "corner"'),
            *SKEW,
        ),
    ),
)
TOP = (PINNED / "top.yaml").read_text(encoding="utf-8")
RATES = Run(  # the top without its last part, in a third of the time
    "top-rates",
    (
        (TOP[TOP.index("  - ask: >\n      If it spins") : TOP.index("show:")], ""),
        (TOP[TOP.index("  conserved_phi: >-") :], ""),
    ),
    (("    p_phi, p_psi =", "    return slow, fast, condition\n    p_phi, p_psi ="),),
)
LIBRARY = tuple(sorted(path.stem for path in (ROOT / "problems" / "library").rglob("*.yaml") if path.stem != "set"))
OWN = Path(__file__).parent / "problems"  # of verbs that no problem of the library asks for
_found = _of_transcripts()
RUNS: dict[str, Run] = {
    **{run.name: run for run in (*BODIES, RATES)},
    **_found,
    **{f"library/{name}": LibraryRun(f"library/{name}") for name in LIBRARY},
    **{f"own/{path.stem}": OwnRun(f"own/{path.stem}") for path in sorted(OWN.glob("*.yaml")) if path.stem != "set"},
}
