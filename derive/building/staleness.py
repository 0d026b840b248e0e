"""The reasons why an output would be made again: each input of the output is compared with its state at the last build.

The comparison derives nothing, and loads no module that derives.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from derive.building.cache import PACKAGES, file_digest
from derive.building.files import shown_path
from derive.building.manifest import Manifest
from derive.building.recipe import DETAIL, ENGINE, EVIDENCE, FORM, LANGUAGE, MODULES, ONLY, Recipe, recipe_of
from derive.building.set_names import check_asked, set_folder, set_names
from derive.building.tex import chosen_engine
from derive.course.names import DOCUMENTS, INDEX, NAME
from derive.errors import Complaint, DeriveError, Misused, did_you_mean

SUFFIXES = {"html", "json", "pdf", "svg", "tex", "txt"}  # suffixes of files that builds write
MOST = 8  # the largest number of reasons or documents that a message lists
_SUCH_AS = "name a page such as `build/hw9/block.pdf`, a problem or a set"


@dataclass(frozen=True)
class Asked:
    """The outputs of a set that a user asks about, and the options with which they would be built now."""

    root: Path
    set_id: str
    outputs: tuple[str, ...]  # names of files; empty: all outputs of the set
    detail: str | None = None
    evidence: str | None = None
    engine: str | None = None


@dataclass(frozen=True)
class Staleness:
    """The reasons why outputs would be made again, in words, and the commands that make the outputs."""

    of: str
    reasons: tuple[str, ...]
    fixes: tuple[str, ...] = ()

    def shown(self) -> str:
        if not self.reasons:
            return f"{self.of} is up to date"
        told = [*self.reasons[:MOST], *([f"and {len(self.reasons) - MOST} more"] if self.reasons[MOST:] else [])]
        return "\n".join([f"{self.of} is out of date:", *(f"  {each}" for each in told), *self.fixes])


def left_older(
    record: Manifest, set_id: str, documents: Sequence[str], recipe: Recipe, read: Callable[[str], str]
) -> list[Complaint]:
    """Return warnings about PDFs and exports whose inputs have changed since they were made."""
    built = [f"`{name}.pdf`" for name in documents if record.is_older(name, recipe, read)]
    exported = [name for name in record.exports if record.is_older(name, recipe, read)]
    found = {f"`derive build {set_id}` makes them again": built} if built else {}
    found |= {f"`{_export(set_id, name)}` makes it again": [f"`{name}`"] for name in exported}
    return [_older(files, record.folder, help_line) for help_line, files in found.items()]


def _older(files: Sequence[str], folder: Path, help_line: str) -> Complaint:
    told = [*files[:MOST], *([f"and {len(files) - MOST} more"] if files[MOST:] else [])]
    message = f"out of date, but not made again: {', '.join(told)} in `{shown_path(folder)}`"
    return Complaint("older", message, help=help_line, severity="warning")


def _export(set_id: str, file: str) -> str:
    """Return the command that makes an export again."""
    name, _, form = Path(file).stem.rpartition("-")
    return f"derive export {set_id if name == set_id else f'{set_id}/{name}'} --format {form}"


def asked_about(root: Path, what: str) -> tuple[str, tuple[str, ...]]:
    """Return the set and the outputs to which a path below build/, a problem's id or a set's name refers."""
    built = _below_build(root, what)
    set_id, _, name = built or what.partition("/")
    if not NAME.fullmatch(set_id):
        raise Misused(Complaint("no-such-output", f"no build makes `{what}`", help=_SUCH_AS))
    if not name:
        check_asked(root, set_id)
        return set_id, ()
    manifest = Manifest.read(set_folder(root, set_id))
    parts = [*manifest.problems, *manifest.document_files]
    known = {*manifest.outputs, *manifest.exports, *(file for part in parts for file in manifest.outputs_of(part))}
    if built and name in known:
        return set_id, (name,)
    stem = Path(name).stem if built else name
    if stem in manifest.document_files or stem in DOCUMENTS:
        check_asked(root, set_id)
    elif built and Path(name).suffix.removeprefix(".") not in SUFFIXES:
        help_line = did_you_mean(name, sorted(known)) or _SUCH_AS
        raise Misused(Complaint("no-such-output", f"no build makes `{what}`", help=help_line))
    else:
        check_asked(root, set_id, [stem])
    return set_id, (name,) if built else tuple(manifest.outputs_of(stem))


def _below_build(root: Path, what: str) -> tuple[str, str, str] | None:
    """Split a path below build/ into the set, "/" and the file; return None for any other path."""
    found = [Path(os.path.relpath(os.path.normpath(base / what), root / "build")) for base in (Path.cwd(), root)]
    below = [path.parts for path in found if ".." not in path.parts and len(path.parts) <= 3]
    of_a_set = [parts for parts in below if parts and parts[0] in set_names(root)]
    if of_a_set or below:  # the caller reports a folder without a set
        set_id, *names = (of_a_set or below)[0] or ("",)
        return set_id, "/", "/".join(names)
    return None


def staleness(asked: Asked) -> Staleness:
    """Return why these outputs would be made again by `derive build`."""
    folder = set_folder(asked.root, asked.set_id)
    manifest = Manifest.read(folder)
    parts = [*manifest.problems, *manifest.document_files]
    outputs = asked.outputs or tuple(file for part in parts for file in manifest.outputs_of(part))
    of = shown_path(folder / outputs[0]) if len(outputs) == 1 else _named(asked, manifest)
    if not manifest.pages and not {*outputs} & {*manifest.exports}:
        why = f"`{asked.set_id}` has not been built here yet"
        return Staleness(of, (why,), (_built_by(asked, manifest, outputs),))
    found = tuple(dict.fromkeys(_reasons(asked, manifest, outputs)))
    return Staleness(of, found, tuple(_fixes(asked, manifest, outputs)) if found else ())


def _reasons(asked: Asked, manifest: Manifest, outputs: Sequence[str]) -> Iterator[str]:
    read: Callable[[str], str] = cache(lambda path: file_digest(asked.root / path))
    now = recipe_of(asked.root, asked.detail, asked.evidence, manifest.of_set)
    documents = _documents(manifest, outputs)
    made = [name for name in documents if name in manifest.typeset_by]
    for name in made:
        for path, before in manifest.typeset_from[name].items():
            yield from _of_file(path, before, read(path))
    for name in documents:
        if name not in made:
            yield _not_made(asked, manifest, name)
    recipes = {name: manifest.recipes.get(manifest.typeset_by[name], {}) for name in made}
    for recipe in recipes.values():
        yield from _of_recipe(recipe, now)
    for name in outputs:
        recipe = recipes.get(_document_of(manifest, name), {})
        if name.endswith(".pdf") and recipe:
            yield from _of_engine(recipe.get(ENGINE, ""), asked.engine)
    for name in outputs:
        if _document_of(manifest, name) in made:
            yield from _of_output(manifest, name)
    if not manifest.complete and any(name in manifest.document_files for name in documents):
        yield f"the last build of `{asked.set_id}` left out problems, was interrupted or found an error"


def _not_made(asked: Asked, manifest: Manifest, name: str) -> str:
    if name in manifest.document_files or name in DOCUMENTS:
        return f"the document `{name}` of `{asked.set_id}` has not been made"
    if _is_unlisted(asked, manifest, name):
        return f"the set `{asked.set_id}` does not list `{name}`"
    return f"the problem `{asked.set_id}/{name}` has not been built"


def _is_unlisted(asked: Asked, manifest: Manifest, name: str) -> bool:
    edited = any(file_digest(asked.root / path) != before for path, before in manifest.set_inputs.items())
    return not edited and name not in [*manifest.problems, *manifest.document_files, *DOCUMENTS]


def _documents(manifest: Manifest, outputs: Sequence[str]) -> list[str]:
    return list(dict.fromkeys(_document_of(manifest, name) for name in outputs))


def _document_of(manifest: Manifest, output: str) -> str:
    if output in manifest.exports:
        return output
    of_drawings = (problem for problem, files in manifest.drawings.items() if output in files)
    return next(of_drawings, Path(output).stem)


def _of_file(path: str, before: str, now: str) -> Iterator[str]:
    if before == now:
        return
    if not now:
        yield f"`{path}` is gone"
    elif not before:
        yield f"`{path}` is new"
    elif len(before) != len(now):
        yield f"`{path}` was edited while the build read it"
    else:
        yield f"`{path}` has changed"


def _of_recipe(before: Recipe, now: Recipe) -> Iterator[str]:
    for name in sorted({*before, *now}):
        was, is_now = before.get(name, ""), now.get(name, "")
        if was == is_now or name in (ONLY, ENGINE):
            continue
        if name in (DETAIL, EVIDENCE):
            yield f"it was made with {_option(name, was)}, but would now be made with {_option(name, is_now)}"
        elif name == MODULES:
            yield "derive itself has changed"
        elif name in (FORM, LANGUAGE):
            yield f"{name} has changed"
        elif name in PACKAGES:
            yield f"the package {name} is {is_now or 'gone'}, and was {was or 'not there'}"
        else:
            yield from _of_file(name, was, is_now)


def _option(name: str, value: str) -> str:
    return f"`{name} {value}`" if value else f"no `{name}`"


def _of_engine(before: str, named: str | None) -> Iterator[str]:
    try:
        now = chosen_engine(named)
    except DeriveError as error:
        yield error.complaints[0].message
        return
    was = before.partition(":")[0]
    if was != now.name:
        yield f"it was typeset by {was}, but would now be typeset by {now.name}"
    elif before != now.identity:
        yield f"the program of the TeX engine {was} has changed"


def _of_output(manifest: Manifest, name: str) -> Iterator[str]:
    if name not in manifest.outputs:
        yield f"`{name}` has not been made"
    elif not (manifest.folder / name).exists():
        yield f"`{name}` does not exist any more"
    elif not manifest.holds(name):
        yield f"`{name}` has been edited since the build wrote it"


def _fixes(asked: Asked, manifest: Manifest, outputs: Sequence[str]) -> Iterator[str]:
    yield _built_by(asked, manifest, outputs)
    now = recipe_of(asked.root, asked.detail, asked.evidence, manifest.of_set)
    options: dict[str, str] = {}
    for name in _documents(manifest, outputs):
        before: Mapping[str, str] = manifest.recipes.get(manifest.typeset_by.get(name, ""), {})
        options |= {name: before[name] for name in (DETAIL, EVIDENCE) if before.get(name) and before[name] != now[name]}
    if options:
        said = " ".join(f"{name} {value}" for name, value in options.items())
        yield f"to build as before: `derive build {_named(asked, manifest)} {said}`"


def _built_by(asked: Asked, manifest: Manifest, outputs: Sequence[str]) -> str:
    documents = _documents(manifest, outputs)
    if exported := next((name for name in documents if name in manifest.exports), None):
        return f"to bring it up to date: `{_export(asked.set_id, exported)}`"
    kinds = [name for name in documents if name in DOCUMENTS and name not in manifest.document_files]
    only = ",".join(kinds) if kinds and manifest.pages else ""
    options = {DETAIL: asked.detail, EVIDENCE: asked.evidence, ENGINE: asked.engine, ONLY: only}
    said = "".join(f" {name} {value}" for name, value in options.items() if value)
    unlisted = [name for name in documents if _is_unlisted(asked, manifest, name)] if manifest.pages else []
    first = f"list `{unlisted[0]}` in `problems/{asked.set_id}/set.yaml`, then " if unlisted else ""
    return f"to bring it up to date: {first}`derive build {_named(asked, manifest)}{said}`"


def _named(asked: Asked, manifest: Manifest) -> str:
    documents = _documents(manifest, asked.outputs)
    (one,) = documents if len(documents) == 1 else ("",)
    of_set = one in (*manifest.document_files, *DOCUMENTS, INDEX)
    return f"{asked.set_id}/{one}" if one and not of_set else asked.set_id
