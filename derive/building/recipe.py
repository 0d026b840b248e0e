"""Recipes: the inputs of a page or document other than the files of its problems.

These inputs are the modules of derive, packages, phrases, templates and options. A recipe maps the name of each input
to its digest or value.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from derive import FOLDER
from derive.building.cache import PACKAGES, digest, engine_digest, file_digest, package_version

if TYPE_CHECKING:
    from derive.course.problem_set import ProblemSet

MODULES = "the modules of derive"
EDITED = "edited during the build"  # instead of a digest
OPTIONS = DETAIL, EVIDENCE, ONLY, ENGINE = "--detail", "--evidence", "--only", "--engine"
FORM = "the `form` of the set"
OWN = "templates of derive"
LANGUAGE = "the language of the set"

Recipe = Mapping[str, str]


def recipe_of(
    root: Path, detail: str | None = None, evidence: str | None = None, of_set: Mapping[str, str] | None = None
) -> dict[str, str]:
    """Return the recipe of pages.

    of_set   the entries that the files of the set and of the course state; options have precedence
    """
    stated = of_set or {}
    options = {
        DETAIL: detail or stated.get(DETAIL, ""),
        EVIDENCE: evidence or stated.get(EVIDENCE, ""),
        FORM: stated.get(FORM, ""),
        LANGUAGE: stated.get(LANGUAGE, ""),
    }
    packages = {name: package_version(name) or "" for name in PACKAGES}
    return {MODULES: engine_digest(), **packages, **_templates(root), **options}


def stated_by(heading: ProblemSet) -> dict[str, str]:
    """Return the entries of a recipe that the files of a set and of its course state."""
    language = f"{heading.language.name} {heading.language.decimal or ''}".strip()
    return {
        DETAIL: heading.detail or "",
        EVIDENCE: heading.evidence,
        FORM: heading.form_in_words,
        LANGUAGE: language,
    }


def of_documents(recipe: Recipe, engine: str) -> dict[str, str]:
    """Return the recipe of a document that is typeset."""
    return {**recipe, ONLY: "", ENGINE: engine}


def input_digest(file: Path, started: int) -> str:
    """Return the digest of an input file. If the file was edited after `started`, return `EDITED`, so that the output
    counts as older than the file."""
    is_edited = file.exists() and file.stat().st_ctime_ns > started  # a moved file may have an old mtime
    return EDITED if is_edited else file_digest(file)


def recipe_digest(recipe: Recipe) -> str:
    return digest(*(part for name in sorted(recipe) for part in (name, recipe[name])))


def edited_since(root: Path, time: int) -> bool:
    """Return whether a module of derive, a template or a file of phrases was written since a time in nanoseconds."""
    below = [str(folder / "templates") for folder in _folders(root)]
    return any(_has_changed(top, time) for top in (FOLDER, *below) if os.path.isdir(top))


def _has_changed(folder: str, time: int) -> bool:
    try:
        with os.scandir(folder) as entries:
            return any(
                _has_changed(entry.path, time) if entry.is_dir() else entry.stat().st_ctime_ns > time
                for entry in entries
                if entry.name != "__pycache__"
            )
    except FileNotFoundError:  # an editor has just replaced the file
        return True


def _folders(root: Path) -> list[Path]:
    return list(dict.fromkeys(each.resolve() for each in (root, Path(FOLDER), Path(FOLDER).parent)))


def _templates(root: Path) -> dict[str, str]:
    """Return the digest of each template and each file of phrases in the course and in derive itself."""
    found: dict[str, str] = {}
    for folder in _folders(root):
        for file in sorted((folder / "templates").rglob("*")):
            if file.is_file() and "__pycache__" not in file.parts:
                within = folder == root.resolve()
                name = f"{'templates' if within else OWN}/{file.relative_to(folder / 'templates').as_posix()}"
                found.setdefault(name, file_digest(file))
    return found
