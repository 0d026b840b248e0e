"""How pages are made, besides from their own files: by which modules, packages, words and templates, and how detailed.

Each ingredient has a name that somebody who is told of it knows, and a digest or a value.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from derive import FOLDER
from derive.building.cache import PACKAGES, digest, engine_digest, file_digest, package_version

MODULES = "the modules of derive"
OPTIONS = DETAIL, EVIDENCE, PAPERS, ENGINE = "--detail", "--evidence", "--only", "--engine"
OWN = "templates of derive"

Recipe = Mapping[str, str]


def recipe_of(root: Path, detail: str | None, evidence: str) -> dict[str, str]:
    """Every ingredient by its name."""
    packages = {name: package_version(name) or "" for name in PACKAGES}
    return {MODULES: engine_digest(), **packages, **_templates(root), DETAIL: detail or "", EVIDENCE: evidence}


def of_documents(recipe: Recipe, engine: str) -> dict[str, str]:
    """The recipe of a document of the set: typeset by this engine, whatever else is made of the problems."""
    return {**recipe, PAPERS: "", ENGINE: engine}


def recipe_digest(recipe: Recipe) -> str:
    return digest(*(part for name in sorted(recipe) for part in (name, recipe[name])))


def _templates(root: Path) -> dict[str, str]:
    """Of each template and file of phrases, of the course and of derive itself."""
    found: dict[str, str] = {}
    for folder in dict.fromkeys(each.resolve() for each in (root, Path(FOLDER), Path(FOLDER).parent)):
        for file in sorted((folder / "templates").rglob("*")):
            if file.is_file() and "__pycache__" not in file.parts:
                within = folder == root.resolve()
                name = f"{'templates' if within else OWN}/{file.relative_to(folder / 'templates').as_posix()}"
                found.setdefault(name, file_digest(file))
    return found
