"""A small course for tests of the build: real sets and files, with substitutes for the derivation and for TeX.

The text of a problem's file decides its result: with `loop`, `refuse`, `bug` or `die` its derivation ends in that way;
any other text becomes its solution. The substitute for TeX copies its source and notes each run.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

import derive.building
from derive.course.problem_set import path_of
from derive.errors import Complaint, Place, Rejected
from derive.render.formats import formats
from derive.render.rendered import Html, Rendered, Tex

if TYPE_CHECKING:
    from derive.building.document_list import Paper

TEX = """#!/bin/sh
case "$*" in *-ini*) exit 1 ;; esac  # it makes no formats
for source; do :; done
echo "$source" >> "$TEX_RUNS"
text=$(cat "$source")
case "$text" in
  *SLOW*) sleep 60 ;;
  *BAD*)
    line=$(grep -n BAD "$source")
    echo "./$source:${line%%:*}: Undefined control sequence." > "${source%.tex}.log"
    exit 1 ;;
esac
printf '%s\\n' '%PDF-1.5' "$text" startxref '%%EOF' > "${source%.tex}.pdf"
"""


COUNTS = {
    **{"steps_proved": 6, "steps_sampled": 0, "steps_approximation": 0, "steps_definition": 1},
    **{"lines": 9, "routes": 4, "checks": 2, "claims_sampled": 1},
}


def rendered(
    root: Path,
    problem_id: str,
    detail: str | None = None,
    cache: object = None,
    draws: bool = False,
    only: tuple[str, ...] | None = None,
    evidence: str = "none",
    documents: tuple[str, ...] = (),
    width: float | None = None,
) -> Rendered:
    path = path_of(root, problem_id)
    said = (root / path).read_text(encoding="utf-8").strip()
    if said == "loop":
        while True:
            pass
    if said == "refuse":
        raise Rejected(Complaint("wrong-kind", "`mass` must be a mass", Place(path, 1, 1, said, 6)))
    if said == "bug":
        raise ZeroDivisionError("nobody thought of that")
    if said == "die":
        os.kill(os.getpid(), signal.SIGKILL)
    if said == "replaced":  # by another program, while the problem is derived
        successor = root / "successor"
        successor.write_text("its successor")
        os.utime(successor, (0, 0))
        os.replace(successor, root / path)
    if said == "print":
        print("chatter of the script")
    warnings = (Complaint("unshown", "`spin` is never shown", severity="warning"),) if said == "warn" else ()
    with open(root / "derived.txt", "a") as notes:
        notes.write(f"{problem_id} {detail}\n" if evidence == "none" else f"{problem_id} {detail} {evidence}\n")
    return Rendered(
        id=problem_id,
        detail="standard",
        title=said,
        points="3",
        texts={**dict.fromkeys(formats(), f"{said} ω\n"), "json": '{"steps": [{}, {}], "reference": []}\n'},
        latex=Tex(said),
        title_latex=Tex(said),
        sheet=Tex(said),
        report=Tex(said),
        source=Tex("quoted"),
        html=Html(said),
        title_html=Html(said),
        card_html=Html(said),
        warnings=warnings,
        inputs=(path,),
        grades={"proved": 2, "definition": 1},
        counts=COUNTS,
        steps=7,
        compared=3,
        agreed=said != "differs",
        source_faults=(("erratum", "12", "x²", "x", "a slip"), ("remark", "14", "so", "", "why"))
        if said == "slips"
        else (),
        files=((f"{problem_id.rpartition('/')[2]}-axes.pdf", said.encode()),)
        if draws and said.startswith("draws")
        else (),
    )


def headline(root: Path, problem_id: str, path: str = "") -> tuple[str, str]:
    found = rendered(root, problem_id, None)
    return found.points, found.title


def explain(root: Path, problem_id: str, key: str | None, as_json: bool) -> str | list[tuple[str, ...]]:
    said = rendered(root, problem_id, None).title
    return f"{key}: {said} {as_json}" if key else [("step", "part"), ("torque", said)]


def preload(root: Path, derives: bool, draws: bool, set_id: str = "") -> None:
    """Load nothing: the substitutes need no SymPy, which takes most of the time of a command."""


def problem_document(root: Path, problem: Rendered, heading: object) -> str:
    return f"%% derive: {problem.id}\n{problem.latex}\n"


def set_document(root: Path, heading: object, problems: list[Rendered]) -> str:
    return "".join(problem_document(root, problem, heading) for problem in problems)


def sheet_document(root: Path, heading: object, problems: list[Rendered]) -> str:
    return "".join(f"questions of {problem.id}\n" for problem in problems)


def report_document(root: Path, heading: object, problems: list[Rendered]) -> str:
    return "".join(f"checks of {problem.id}\n" for problem in problems)


def document_on_request(root: Path, heading: object, problems: list[Rendered], kind: str) -> str:
    return "".join(f"{kind} of {problem.id}\n" for problem in problems)


def the_document(kind: str) -> Callable[[Path, object, list[Rendered]], str]:
    known = {"solutions": set_document, "problems": sheet_document, "report": report_document}
    return known.get(kind) or partial(document_on_request, kind=kind)


def document_page(root: Path, heading: object, problems: list[Rendered], kind: str) -> str:
    return f"<!-- {kind} -->{document_on_request(root, heading, problems, kind)}"


def problem_page(root: Path, problem: Rendered, heading: object) -> str:
    return f"<!-- {problem.id} -->{problem.html}\n"


def index_page(root: Path, heading: Any, problems: list[Rendered], papers: Sequence[Paper] = (), **_: object) -> str:
    from derive.building.document_list import listed  # which loads SymPy

    return "".join(f"<!-- {problem.id} -->\n" for problem in problems) + listed(root, heading.id, papers)


class Course:
    def __init__(self, root: Path):
        self.root = root
        self.folder = root / "problems" / "hw1"
        self.outputs = root / "build" / "hw1"
        self.folder.mkdir(parents=True)
        self.heading("one", "two")
        self.problem("one", "first")
        self.problem("two", "second")

    def heading(self, *names: str) -> None:
        listed = "".join(f"  - {name}\n" for name in names)
        (self.folder / "set.yaml").write_text(f"course: Physics\ntitle: Homework\nproblems:\n{listed}")

    def problem(self, name: str, said: str) -> None:
        (self.folder / f"{name}.yaml").write_text(said + "\n", encoding="utf-8")

    def derived(self) -> list[str]:
        """Return the problems that were derived since the last call."""
        return self._noted("derived.txt")

    def typeset(self) -> list[str]:
        """Return the sources that were typeset since the last call, sorted."""
        return sorted(self._noted("runs.txt"))

    def _noted(self, name: str) -> list[str]:
        notes = self.root / name
        lines = notes.read_text().splitlines() if notes.is_file() else []
        notes.unlink(missing_ok=True)
        return sorted(lines)

    def contents(self) -> dict[str, bytes]:
        """Return name -> content of every visible output."""
        return {p.name: p.read_bytes() for p in self.outputs.iterdir() if p.is_file() and not p.name.startswith(".")}


def stand_in_course(root: Path, monkeypatch: Any) -> Course:
    """Return the course, with the substitutes for the derivation, for the workers and for TeX."""
    from tests.jobs_here import InThisProcess

    course = Course(root)
    replace_derivation(monkeypatch)
    for module in ("workers", "sets"):
        monkeypatch.setattr(f"derive.building.{module}.Crew", InThisProcess)
    programs = root / "bin"
    programs.mkdir()
    (programs / "pdflatex").write_text(TEX)
    (programs / "pdflatex").chmod(0o755)
    monkeypatch.setenv("PATH", f"{programs}:{os.environ['PATH']}")
    monkeypatch.setenv("TEX_RUNS", str(root / "runs.txt"))
    monkeypatch.setenv("DERIVE_ENGINE", "pdflatex")
    monkeypatch.chdir(root)
    return course


class Lasting:
    """Replaces things like `pytest.MonkeyPatch`, until the process ends; pytest takes long to load."""

    setattr = staticmethod(lambda target, name, value, raising=True: setattr(target, name, value))
    setitem = staticmethod(lambda found, name, value: found.update({name: value}))


def replace_derivation(monkeypatch: Any) -> None:
    documents = (
        problem_document,
        set_document,
        sheet_document,
        report_document,
        problem_page,
        index_page,
        document_page,
        the_document,
    )
    modules = {
        **{"solution": (rendered,), "headline": (headline,), "explain": (explain,)},
        **{"preload": (preload,), "set_document": documents},
    }
    for name, functions in modules.items():
        fake = ModuleType(f"derive.building.{name}")
        for function in functions:
            setattr(fake, function.__name__, function)
        monkeypatch.setitem(sys.modules, fake.__name__, fake)
        monkeypatch.setattr(derive.building, name, fake, raising=False)
