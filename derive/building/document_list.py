"""The list of documents on the web page of a set."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from derive.building.cache import file_digest
from derive.building.files import write
from derive.building.lock import locked
from derive.building.manifest import EXPORT_SUFFIX, Documents, Manifest
from derive.building.recipe import recipe_of
from derive.building.set_names import set_folder
from derive.course.names import CLASS, INDEX, ON_A_PAGE, STUDENTS
from derive.course.problem_set import language_of
from derive.page.template import templates_of
from derive.page.wording import phrases
from derive.render.printing.templates import filled_html

_LIST = re.compile(r'<ul class="documents">.*?</ul>', re.DOTALL)
_EXPORTED = re.compile(rf"[\w-]+-(?:{'|'.join(EXPORT_SUFFIX)})\.(?:{'|'.join({*EXPORT_SUFFIX.values()})})")


@dataclass(frozen=True)
class Paper:
    """An entry of the list. `files` has a pair for each file: its address and the name of its format; `is_older` says
    whether the document is out of date."""

    name: str
    files: tuple[tuple[str, str], ...]
    is_older: bool = False


def papers_of(root: Path, set_id: str, documents: Documents) -> list[Paper]:
    """Return these documents of a set with their names in the language of the set and the addresses of their files."""
    names = phrases(templates_of(root), language_of(root, set_id)).labels["documents"]
    page = {kind: ((f"{file}.html", "HTML"),) for kind, file in documents if kind in ON_A_PAGE}
    return [Paper(names[kind], ((f"{file}.pdf", "PDF"), *page.get(kind, ()))) for kind, file in documents]


def there_of(outputs: Path, documents: Documents, made: Documents = ()) -> Documents:
    """Return the documents that are being made or have a PDF in the folder of outputs."""
    return [pair for pair in documents if pair in made or (outputs / f"{pair[1]}.pdf").is_file()]


def papers(root: Path, set_id: str, documents: Documents, older: Collection[str] = ()) -> list[Paper]:
    """Return these documents, followed by the page for students, the page of the class and the exports.

    older   the names of the documents and exports that are out of date
    """
    outputs = set_folder(root, set_id)
    words = phrases(templates_of(root), language_of(root, set_id)).labels["web"]
    of_class = (outputs / CLASS / f"{INDEX}.html").is_file()
    folders = [(STUDENTS, words["for_students"]), *([(CLASS, words["class"])] if of_class else [])]
    exported = sorted(each.name for each in outputs.glob("*") if _EXPORTED.fullmatch(each.name))
    of_set = zip(documents, papers_of(root, set_id, documents), strict=True)
    return [
        *(replace(paper, is_older=file in older) for (_, file), paper in of_set),
        *(Paper(name, ((f"{folder}/{INDEX}.html", "HTML"),)) for folder, name in folders),
        *(Paper(name, ((name, name.rpartition(".")[2].upper()),), name in older) for name in exported),
    ]


def listed(root: Path, set_id: str, found: Sequence[Paper]) -> str:
    """Return the list of documents in HTML."""
    words = phrases(templates_of(root), language_of(root, set_id)).labels
    return filled_html(templates_of(root), "papers.html.j2", {"papers": found, "labels": words}).strip()


def list_again(root: Path, set_id: str, record: Callable[[Manifest], None] | None = None) -> None:
    """Update the list of documents on the page of a set, unless a user has edited this page.

    record   a function that records a file that the command wrote; None if the command wrote no file
    """
    outputs = set_folder(root, set_id)
    page = outputs / f"{INDEX}.html"
    if record is None and not page.is_file():
        return
    with locked(outputs, lambda: None):
        manifest = Manifest.read(outputs)
        if record is not None:
            record(manifest)
        update_list(root, set_id, manifest)
        manifest.save()


def older_in(root: Path, manifest: Manifest) -> list[str]:
    """Return the documents and exports of a set that are out of date."""
    recipe, read = recipe_of(root, of_set=manifest.of_set), cache(lambda path: file_digest(root / path))
    named = [*(file for _, file in manifest.documents), *manifest.exports]
    return [name for name in named if manifest.is_older(name, recipe, read)]


def update_list(root: Path, set_id: str, manifest: Manifest) -> None:
    """Update the list of documents on the page of a set, unless a user has edited this page. The list marks the
    documents that are out of date."""
    page = manifest.folder / f"{INDEX}.html"
    if not manifest.holds(page.name):
        return
    older = older_in(root, manifest)
    there = listed(root, set_id, papers(root, set_id, there_of(manifest.folder, manifest.documents), older))
    write(page, _LIST.sub(lambda _: there, page.read_text(encoding="utf-8"), count=1))
    manifest.wrote(page.name)
