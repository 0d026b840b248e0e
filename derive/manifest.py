"""What a set's outputs were made from: the record that tells which of them must be made again.

A problem is current while the content of every file it was derived from, the engine and the options are what they
were; a document, while its TeX source, the TeX engine and its own content are. Only content is compared, never times.
"""

from __future__ import annotations

import hashlib
import json
import pickle
from dataclasses import asdict, dataclass, field
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from derive.output import write

PACKAGES = ("sympy", "mpmath", "jinja2", "pyyaml", "pylatexenc", "matplotlib")
SOLUTIONS, SHEET = DOCUMENTS = ("solutions", "problems")  # of a whole set: with the solutions, and for students
_PACKAGE = Path(__file__).parent


def digest(*parts: str | bytes) -> str:
    sha = hashlib.sha256()
    for part in parts:
        raw = part.encode() if isinstance(part, str) else part
        sha.update(b"%d:" % len(raw) + raw)
    return sha.hexdigest()


def file_digest(path: Path) -> str:
    """Of the file's content; empty if there is none, so that a file which appears counts as a change."""
    try:
        return digest(path.read_bytes())
    except OSError:
        return ""


def package_version(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def engine_digest(root: Path) -> str:
    """Of derive's own modules, the templates, and the packages that decide what is derived."""
    folders = sorted({_PACKAGE, root / "templates", _PACKAGE.parent / "templates"})
    files = sorted(p for f in folders for p in f.rglob("*") if p.is_file() and "__pycache__" not in p.parts)
    modules = [part for p in files for part in (p.name, p.read_bytes())]
    return digest(*modules, *(f"{name}=={package_version(name)}" for name in PACKAGES))


@dataclass
class Manifest:
    """The record of one set, kept in its folder of outputs."""

    folder: Path
    problems: list[str] = field(default_factory=list)
    complete: bool = False  # whether the last build came to its end without a fault
    tex_engine: str = ""
    set_inputs: dict[str, str] = field(default_factory=dict)
    recipes: dict[str, str] = field(default_factory=dict)  # problem -> digest of engine and options
    inputs: dict[str, dict[str, str]] = field(default_factory=dict)  # problem -> path -> digest of content
    outputs: dict[str, str] = field(default_factory=dict)  # file name -> digest of content
    sources: dict[str, str] = field(default_factory=dict)  # pdf -> digest of its TeX and engine
    drawings: dict[str, list[str]] = field(default_factory=dict)  # problem -> the files of its drawings

    @classmethod
    def read(cls, folder: Path) -> Manifest:
        """What was recorded; an empty record if there is none, or it does not read."""
        try:
            recorded: dict[str, Any] = json.loads((folder / ".manifest.json").read_bytes())
            return cls(folder, **recorded)
        except (OSError, ValueError, TypeError):
            return cls(folder)

    def save(self) -> None:
        fields = {name: value for name, value in asdict(self).items() if name != "folder"}
        write(self.folder / ".manifest.json", json.dumps(fields, indent=1, sort_keys=True) + "\n")

    def is_derived(self, name: str, recipe: str, root: Path) -> bool:
        """Whether what was derived for that problem still holds, whatever became of its outputs."""
        inputs = self.inputs.get(name)
        return bool(inputs) and self.recipes.get(name) == recipe and self._unchanged(inputs or {}, root)

    def is_current(self, recipe: str, root: Path) -> bool:
        """Whether nothing at all need be done for the set."""
        return (
            self.complete
            and self._unchanged(self.set_inputs, root)
            and all(self.is_derived(name, recipe, root) for name in self.problems)
            and all(self.holds(name) for part in [*self.problems, *DOCUMENTS] for name in self.outputs_of(part))
        )

    def outputs_of(self, problem: str) -> list[str]:
        """All outputs of a problem, those that every problem has and its drawings."""
        return [*outputs_of(problem), *self.drawings.get(problem, [])]

    def holds(self, output: str) -> bool:
        """Whether that output is there and as it was written."""
        return self.outputs.get(output, "") != "" and file_digest(self.folder / output) == self.outputs[output]

    def _unchanged(self, inputs: dict[str, str], root: Path) -> bool:
        return all(file_digest(root / path) == content for path, content in inputs.items())

    def kept(self, name: str) -> Any:
        """The derived problem as it was stored; nothing if that does not read, or came of something else."""
        try:
            recipe, inputs, derived = pickle.loads(self._store(name).read_bytes())
        except Exception:  # whatever a damaged pickle raises, the mend is to derive again
            return None
        return derived if (recipe, inputs) == (self.recipes.get(name), self.inputs.get(name)) else None

    def keep(self, name: str, derived: Any, recipe: str, inputs: dict[str, str]) -> None:
        write(self._store(name), pickle.dumps((recipe, inputs, derived)))
        self.recipes[name], self.inputs[name] = recipe, inputs

    def _store(self, name: str) -> Path:
        return self.folder / ".derived" / f"{name}.pickle"


def outputs_of(name: str) -> list[str]:
    """The outputs of a problem, or of a document of the whole set."""
    suffixes = ("pdf", "tex") if name in DOCUMENTS else ("pdf", "tex", "txt", "json")
    return [f"{name}.{suffix}" for suffix in suffixes]
