"""The record of the inputs from which the outputs of a set were made. It decides which outputs must be made again.

A problem is up to date if its input files and its recipe are unchanged; the module `derive.building.recipe` describes
recipes. An output is up to date if its own content is also unchanged. Contents are compared, not times.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any

from derive.building import signatures
from derive.building.cache import digest, file_digest
from derive.building.recipe import OPTIONS, Recipe, of_documents, recipe_digest
from derive.course.names import INDEX, ON_A_PAGE, SHEET, STUDENTS
from derive.render.formats import built_formats

Documents = Sequence[Sequence[str]]  # pairs: the kind of a document, and the name of its files

_PLAIN_NAME = re.compile(rf"(?:{STUDENTS}/)?[A-Za-z0-9][A-Za-z0-9_-]*\.([a-z]+)")
EXPORT_SUFFIX = {"moodle": "xml", "stack": "xml", "qti": "zip", "canvas": "zip", "docx": "docx", "prairielearn": "zip"}
INDEX_PAGES = (f"{INDEX}.html", f"{STUDENTS}/{INDEX}.html")


@dataclass
class Manifest:
    """The record of one set, kept in its folder of outputs."""

    folder: Path
    problems: list[str] = field(default_factory=list)
    complete: bool = False  # whether the last build made all problems without an error
    engine: str = ""  # digest of the modules and packages with which the problems were derived
    set_inputs: dict[str, str] = field(default_factory=dict)
    inputs: dict[str, dict[str, str]] = field(default_factory=dict)  # problem -> digests of its input files
    pages: dict[str, str] = field(default_factory=dict)  # problem -> digest of all inputs of its page
    outputs: dict[str, str] = field(default_factory=dict)  # file name -> digest of content
    drawings: dict[str, list[str]] = field(default_factory=dict)  # problem -> the files of its drawings
    documents: list[list[str]] = field(default_factory=list)  # the documents of the set, see `Documents`
    asked: list[str] = field(default_factory=list)  # documents that `--only` requested and the set does not list
    of_set: dict[str, str] = field(default_factory=dict)  # entries of recipes that the set's file and course.yaml state
    made_by: dict[str, str] = field(default_factory=dict)  # problem -> digest of the recipe of its page
    typeset_from: dict[str, dict[str, str]] = field(default_factory=dict)  # document -> digests of its input files
    typeset_by: dict[str, str] = field(default_factory=dict)  # document -> digest of its recipe
    recipes: dict[str, dict[str, str]] = field(default_factory=dict)  # digest of a recipe -> this recipe

    @classmethod
    def read(cls, folder: Path) -> Manifest:
        """Return the record of this folder; an empty record if there is no valid one."""
        recorded = signatures.data_of(signatures.read_signed(folder / ".manifest.json", _record_of(folder)))
        return cls(folder, **recorded) if _is_record(recorded) else cls(folder)

    def save(self) -> None:
        used = {*self.made_by.values(), *self.typeset_by.values()}
        self.recipes = {key: recipe for key, recipe in self.recipes.items() if key in used}
        recorded = {name: value for name, value in asdict(self).items() if name != "folder"}
        signatures.write_signed(self.folder / ".manifest.json", _record_of(self.folder), json.dumps(recorded).encode())

    def remove(self, output: str) -> None:
        """Remove an output if it is a file of this folder and has not changed since the build wrote it."""
        file = self.folder / output
        if _is_plain(output) and not file.is_symlink() and self.holds(output):
            file.unlink(missing_ok=True)
        self.outputs.pop(output, None)

    def wrote(self, output: str) -> None:
        """Record the present content of an output."""
        self.outputs[output] = file_digest(self.folder / output)

    def forget(self, name: str) -> None:
        """Remove the outputs of a problem or document that the set no longer has."""
        for output in self.outputs_of(name):
            self.remove(output)
        for table in (self.pages, self.inputs, self.drawings, self.made_by, self.typeset_from, self.typeset_by):
            table.pop(name, None)

    def replace_documents(self, documents: list[list[str]]) -> None:
        """Replace the list of the set's documents, and remove the files of documents that are no longer in it."""
        files = {file for _, file in documents}
        for kind, file in self.documents:
            if [kind, file] not in documents and file not in files:
                self.forget(file)
        self.documents = documents

    def page_key(self, problem: str, recipe: str, read: Callable[[str], str]) -> str:
        """Return the key of a problem's page; `read` returns the digest of an input."""
        inputs = self.inputs.get(problem, {})
        return digest("page", problem, recipe, *(part for path in inputs for part in (path, read(path))))

    def made(self, problem: str, recipe: Recipe, read: Callable[[str], str]) -> str:
        """Record the recipe and the inputs of a page, and return the key under which the page is stored."""
        made_by = recipe_digest(recipe)
        self.recipes[made_by] = {**recipe}
        self.made_by[problem] = made_by
        self.inputs[problem] = {path: read(path) for path in self.inputs.get(problem, {})}
        self.pages[problem] = self.page_key(problem, made_by, self.inputs[problem].__getitem__)
        return self.pages[problem]

    def was_typeset(self, name: str, recipe: Recipe, engine: str) -> None:
        """Record the recipe and the input files of a document."""
        recipe = of_documents(recipe, engine)
        self.typeset_by[name] = recipe_digest(recipe)
        self.recipes[self.typeset_by[name]] = recipe
        self.typeset_from[name] = dict(self.set_inputs)
        for problem in [name] if name in self.pages else self.problems:
            self.typeset_from[name] |= self.inputs[problem]

    def was_exported(self, file: str, recipe: Recipe, inputs: dict[str, str], of_set: dict[str, str]) -> None:
        """Record an export, with its recipe and its input files, under the name of its file."""
        self.of_set = of_set
        self.typeset_by[file] = recipe_digest(recipe)
        self.recipes[self.typeset_by[file]] = {**recipe}
        self.typeset_from[file] = inputs
        self.wrote(file)

    @property
    def exports(self) -> list[str]:
        """The file names of the exports."""
        return [name for name in self.typeset_by if Path(name).suffix]

    def is_current(self, recipe: Recipe, engine: str, read: Callable[[str], str], documents: Documents) -> bool:
        """Return whether the outputs of all problems, of these documents and of the index are up to date."""
        page, document = recipe_digest(recipe), recipe_digest(of_documents(recipe, engine))
        names = [*self.problems, *(file for _, file in documents), INDEX]
        of_set = [output for kind, file in documents for output in outputs_of_document(kind, file)]
        return (
            self.complete
            and all(read(path) == content for path, content in self.set_inputs.items())
            and all(self.pages.get(name) == self.page_key(name, page, read) for name in self.problems)
            and all(self.typeset_by.get(name) == document and self._reads_so(name, read) for name in names)
            and all(self.holds(name) for name in [*self._outputs_of_problems(), *of_set, *INDEX_PAGES])
        )

    def _reads_so(self, document: str, read: Callable[[str], str]) -> bool:
        return all(read(path) == content for path, content in self.typeset_from.get(document, {}).items())

    def is_older(self, document: str, recipe: Recipe, read: Callable[[str], str]) -> bool:
        """Return whether the PDF of a document, or an export, exists but its inputs have changed since it was made."""
        before = self.recipes.get(self.typeset_by.get(document, ""), {})
        was, is_now = ({k: v for k, v in each.items() if k not in OPTIONS} for each in (before, recipe))
        file = document if document in self.exports else f"{document}.pdf"
        return (self.folder / file).is_file() and not (was == is_now and self._reads_so(document, read))

    @property
    def document_files(self) -> list[str]:
        """The file names, without suffixes, of the documents of the whole set and of its web page."""
        return [*(file for _, file in self.documents), INDEX]

    def all_outputs(self) -> list[str]:
        of_set = [output for kind, file in self.documents for output in outputs_of_document(kind, file)]
        return [*self._outputs_of_problems(), *of_set, *INDEX_PAGES]

    def _outputs_of_problems(self) -> list[str]:
        return [output for name in self.problems for output in self.outputs_of(name)]

    def outputs_of(self, name: str) -> list[str]:
        """Return all outputs of a problem or of a document."""
        if name == INDEX:
            return [*INDEX_PAGES]
        if kind := next((kind for kind, file in self.documents if file == name), None):
            return outputs_of_document(kind, name)
        return [*outputs_of(name), *self.drawings.get(name, [])]

    def holds(self, output: str) -> bool:
        """Return whether that output exists and is unchanged since the build wrote it."""
        return self.outputs.get(output, "") != "" and file_digest(self.folder / output) == self.outputs[output]


def _record_of(folder: Path) -> str:
    return f"the record of {folder.name}"


def _is_record(recorded: Any) -> bool:
    empty = Manifest(Path())
    names = {field.name for field in fields(Manifest)} - {"folder"}
    if not isinstance(recorded, dict) or set(recorded) != names:
        return False
    if any(type(value) is not type(getattr(empty, name)) for name, value in recorded.items()):
        return False
    tables = [recorded[name] for name in ("set_inputs", "pages", "outputs", "of_set", "made_by", "typeset_by")]
    tables += [each for name in ("inputs", "recipes", "typeset_from") for each in recorded[name].values()]
    lists = [recorded["problems"], recorded["asked"], *recorded["documents"], *recorded["drawings"].values()]
    if not all(isinstance(each, dict) for each in tables):
        return False
    texts = [text for table in tables for text in table.values()]
    return (
        all(isinstance(each, list) for each in lists)
        and all(isinstance(text, str) for text in [*texts, *(text for each in lists for text in each)])
        and all(_is_plain(name) for each in recorded["drawings"].values() for name in each)
        and all(_is_plain(name) for name in recorded["outputs"])
    )


def _is_plain(output: str) -> bool:
    """Return whether this is a file name that a build may have written."""
    parts = _PLAIN_NAME.fullmatch(output)
    return parts is not None and parts[1] in {
        "html",
        "pdf",
        "svg",
        "tex",
        *EXPORT_SUFFIX.values(),
        *(form.suffix for form in built_formats().values()),
    }


def outputs_of(name: str) -> list[str]:
    """Return the outputs of a problem, except its drawings."""
    return [f"{name}.{suffix}" for suffix in ("pdf", "tex", "html", *(f.suffix for f in built_formats().values()))]


def outputs_of_document(kind: str, file: str) -> list[str]:
    """Return the outputs of a document of the whole set."""
    found = [f"{file}.{suffix}" for suffix in ("pdf", "tex", *(("html",) if kind in ON_A_PAGE else ()))]
    return [*found, *(f"{STUDENTS}/{file}.{suffix}" for suffix in ("pdf", "html") if kind == SHEET)]
