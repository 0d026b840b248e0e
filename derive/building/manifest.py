"""What a set's outputs were made from: the record that tells which of them must be made again.

A problem is current while the content of every file it was derived from, the engine and the options are what they
were; a document, while its TeX source, the TeX engine and its own content are. Only content is compared, never times.
"""

from __future__ import annotations

import hashlib
import re
from dataclasses import asdict, dataclass, field, fields
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from derive import FOLDER
from derive.building import sealed
from derive.render.formats import formats

PACKAGES = ("sympy", "mpmath", "jinja2", "pyyaml", "pylatexenc", "matplotlib")
SOLUTIONS, SHEET = DOCUMENTS = ("solutions", "problems")  # of a whole set: with the solutions, and for students
_PLAIN_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*\.([a-z]+)")
MAX_INPUT = 64 * 1024 * 1024


def digest(*parts: str | bytes) -> str:
    sha = hashlib.sha256()
    for part in parts:
        raw = part.encode() if isinstance(part, str) else part
        sha.update(b"%d:" % len(raw) + raw)
    return sha.hexdigest()


def file_digest(path: Path) -> str:
    """Of the file's content; empty if there is none, so that a file which appears counts as a change."""
    try:
        return digest(sealed.regular_content(path, MAX_INPUT))
    except OSError:
        return ""


def package_version(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def engine_digest(root: Path) -> str:
    """Of derive's own modules, the templates, and the packages that decide what is derived."""
    folders = sorted({FOLDER, root / "templates", FOLDER.parent / "templates"})
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
        """What was recorded here; an empty record if there is none, or it is not as it was written."""
        recorded = sealed.recalled(folder / ".manifest.json", _record_of(folder))
        return cls(folder, **recorded) if _is_record(recorded) else cls(folder)

    def save(self) -> None:
        recorded = {name: value for name, value in asdict(self).items() if name != "folder"}
        sealed.keep(self.folder / ".manifest.json", _record_of(self.folder), recorded)

    def remove(self, output: str) -> None:
        """Take an output away if it is a file of this folder and still as it was written."""
        file = self.folder / output
        if _is_plain(output) and not file.is_symlink() and self.holds(output):
            file.unlink(missing_ok=True)
        self.outputs.pop(output, None)
        self.sources.pop(output, None)

    def forget(self, problem: str) -> None:
        """Take away what was made of a problem that the set no longer has."""
        for output in self.outputs_of(problem):
            self.remove(output)
        for table in (self.recipes, self.inputs, self.drawings):
            table.pop(problem, None)
        for file in (self.folder / ".derived").glob(f"{problem}.*.json"):
            file.unlink(missing_ok=True)

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
        """The data of the derived problem as they were kept; nothing if they came of something else."""
        return sealed.recalled(self._store(name), self._origin(name))

    def keep(self, name: str, derived: Any, recipe: str, inputs: dict[str, str]) -> None:
        self.recipes[name], self.inputs[name] = recipe, inputs
        sealed.keep(self._store(name), self._origin(name), derived)

    def _origin(self, name: str) -> str:
        inputs = sorted(self.inputs.get(name, {}).items())
        return digest(name, self.recipes.get(name, ""), *(part for pair in inputs for part in pair))

    def _store(self, name: str) -> Path:
        return self.folder / ".derived" / f"{name}.rendered.json"


def _record_of(folder: Path) -> str:
    return f"the record of {folder.name}"


def _is_record(recorded: Any) -> bool:
    """Whether data are a record: the fields of a manifest and no others, each of its type, with plain file names."""
    empty = Manifest(Path())
    names = {field.name for field in fields(Manifest)} - {"folder"}
    if not isinstance(recorded, dict) or set(recorded) != names:
        return False
    if any(type(value) is not type(getattr(empty, name)) for name, value in recorded.items()):
        return False
    texts = [recorded["set_inputs"], recorded["recipes"], recorded["outputs"], recorded["sources"]]
    lists = [recorded["problems"], *recorded["drawings"].values()]
    return (
        all(isinstance(text, str) for table in [*texts, *recorded["inputs"].values()] for text in _values(table))
        and all(isinstance(each, list) and all(isinstance(text, str) for text in each) for each in lists)
        and all(_is_plain(name) for each in recorded["drawings"].values() for name in each)
        and all(_is_plain(name) for name in [*recorded["outputs"], *recorded["sources"]])
    )


def _is_plain(output: str) -> bool:
    """Whether it is the name of a file that a build may have written."""
    parts = _PLAIN_NAME.fullmatch(output)
    return parts is not None and parts[1] in {"pdf", "svg", "tex", *(form.suffix for form in formats().values())}


def _values(table: Any) -> list[Any]:
    return list(table.values()) if isinstance(table, dict) else [None]


def outputs_of(name: str) -> list[str]:
    """The outputs of a problem, or of a document of the whole set."""
    own = [] if name in DOCUMENTS else [form.suffix for form in formats().values()]
    return [f"{name}.{suffix}" for suffix in ("pdf", "tex", *own)]
