"""Why an output would be made again: what it was made from is compared, one by one, with what there is now.

Nothing is derived for that, and nothing that derives is loaded.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from derive.building.cache import PACKAGES, file_digest
from derive.building.files import shown_path
from derive.building.manifest import Manifest
from derive.building.named import check_asked, set_folder, set_names
from derive.building.recipe import DETAIL, EVIDENCE, MODULES, PAPERS, Recipe, recipe_of
from derive.building.tex import chosen_engine
from derive.course.names import NAME
from derive.errors import Complaint, DeriveError, Misused, did_you_mean

SUFFIXES = {"html", "json", "pdf", "svg", "tex", "txt"}  # of what builds write
MOST = 8  # reasons that are told of one output
_SUCH_AS = "name a page such as `build/hw9/block.pdf`, a problem or a set"


@dataclass(frozen=True)
class Asked:
    """What somebody asks about: outputs of a set, and how they would be built now."""

    root: Path
    set_id: str
    outputs: tuple[str, ...]  # names of files; none: all of the set
    detail: str | None = None
    evidence: str | None = None
    engine: str | None = None


@dataclass(frozen=True)
class Staleness:
    """Why outputs would be made again, in words, and the commands that see to it; no reasons if they would not."""

    of: str
    reasons: tuple[str, ...]
    mends: tuple[str, ...] = ()

    def shown(self) -> str:
        if not self.reasons:
            return f"{self.of} is up to date"
        told = [*self.reasons[:MOST], *([f"and {len(self.reasons) - MOST} more"] if self.reasons[MOST:] else [])]
        return "\n".join([f"{self.of} is out of date:", *(f"  {each}" for each in told), *self.mends])


def asked_about(root: Path, what: str) -> tuple[str, tuple[str, ...]]:
    """The set and the outputs that a path below build/, a problem's id or a set's name stands for."""
    built = _below_build(root, what)
    set_id, _, name = built or what.partition("/")
    if not NAME.fullmatch(set_id):
        raise Misused(Complaint("no-such-output", f"no build makes `{what}`", help=_SUCH_AS))
    if not name:
        check_asked(root, set_id)
        return set_id, ()
    manifest = Manifest.read(set_folder(root, set_id))
    known = {*manifest.outputs, *(file for part in [*manifest.problems, *manifest.documents] for file in
                                  manifest.outputs_of(part))}  # fmt: skip
    if built and name in known:
        return set_id, (name,)
    stem = Path(name).stem if built else name
    if stem in manifest.documents:
        check_asked(root, set_id)
    elif built and Path(name).suffix.removeprefix(".") not in SUFFIXES:
        help_line = did_you_mean(name, sorted(known)) or _SUCH_AS
        raise Misused(Complaint("no-such-output", f"no build makes `{what}`", help=help_line))
    else:
        check_asked(root, set_id, [stem])
    return set_id, (name,) if built else tuple(manifest.outputs_of(stem))


def _below_build(root: Path, what: str) -> tuple[str, str, str] | None:
    """Set, stroke, file: of a path as it is named from here, or from the root."""
    found = [Path(os.path.relpath(os.path.normpath(base / what), root / "build")) for base in (Path.cwd(), root)]
    below = [path.parts for path in found if ".." not in path.parts and len(path.parts) <= 2]
    of_a_set = [parts for parts in below if parts and parts[0] in set_names(root)]
    if of_a_set or below:  # a folder of no set is told as one
        set_id, name = (*(of_a_set or below)[0], "", "")[:2]
        return set_id, "/", name
    return None


def staleness(asked: Asked) -> Staleness:
    """Why these outputs would be made again by `derive build`."""
    folder = set_folder(asked.root, asked.set_id)
    manifest = Manifest.read(folder)
    parts = [*manifest.problems, *manifest.documents]
    outputs = asked.outputs or tuple(file for part in parts for file in manifest.outputs_of(part))
    of = shown_path(folder / outputs[0]) if len(outputs) == 1 else _named(asked, manifest)
    if not manifest.pages:
        return Staleness(of, (f"`{asked.set_id}` has not been built here yet",), (_built_by(asked, manifest),))
    found = tuple(dict.fromkeys(_reasons(asked, manifest, outputs)))
    return Staleness(of, found, tuple(_mends(asked, manifest, outputs)) if found else ())


def _reasons(asked: Asked, manifest: Manifest, outputs: Sequence[str]) -> Iterator[str]:
    """Of files first, which somebody edits; then of what is rarer."""
    problems = _problems_of(manifest, outputs)
    read: Callable[[str], str] = lambda path: file_digest(asked.root / path)  # noqa: E731
    for path, before in manifest.set_inputs.items():
        yield from _of_file(path, before, read(path))
    now = recipe_of(asked.root, asked.detail, asked.evidence or manifest.evidence)
    for problem in problems:
        for path, before in manifest.inputs.get(problem, {}).items():
            yield from _of_file(path, before, read(path))
    for problem in problems:
        if problem not in manifest.pages:
            yield f"the problem `{asked.set_id}/{problem}` has not been built"
        else:
            recipe = manifest.recipes.get(manifest.made_by.get(problem, ""), {})
            yield from _of_recipe(recipe, {**now, PAPERS: recipe.get(PAPERS, "")})
    if any(name.endswith(".pdf") for name in outputs):
        yield from _of_engine(manifest.tex_engine, asked.engine)
    for name in outputs:
        if set(_problems_of(manifest, [name])) <= manifest.pages.keys():
            yield from _of_output(manifest, name)
    if not manifest.complete and any(Path(name).stem in manifest.documents for name in outputs):
        yield f"the last build of `{asked.set_id}` was not of all its problems, was interrupted or found a fault"


def _problems_of(manifest: Manifest, outputs: Sequence[str]) -> list[str]:
    """Those whose pages or drawings the outputs are; all, for a document of the set."""
    own = {name: problem for problem in manifest.pages for name in manifest.outputs_of(problem)}
    parts = dict.fromkeys(own.get(name, Path(name).stem) for name in outputs)
    if parts.keys() & {*manifest.documents}:
        return list(dict.fromkeys([*manifest.problems, *manifest.pages]))
    return list(parts)


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
        if was == is_now:
            continue
        if name in (DETAIL, EVIDENCE):
            yield f"it was made with {_option(name, was)}, and would be with {_option(name, is_now)}"
        elif name == MODULES:
            yield "derive itself has changed"
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
    if was and was != now.name:
        yield f"it was typeset by {was}, and would be by {now.name}"
    elif before and before != now.identity:
        yield f"the program of the TeX engine {was} has changed"


def _of_output(manifest: Manifest, name: str) -> Iterator[str]:
    if name not in manifest.outputs:
        yield f"`{name}` has not been made"
    elif not (manifest.folder / name).exists():
        yield f"`{name}` is not there any more"
    elif not manifest.holds(name):
        yield f"`{name}` is not as the build wrote it: somebody edited it"


def _mends(asked: Asked, manifest: Manifest, outputs: Sequence[str]) -> Iterator[str]:
    yield _built_by(asked, manifest)
    problems = _problems_of(manifest, outputs)
    now = recipe_of(asked.root, asked.detail, asked.evidence or manifest.evidence)
    options: dict[str, str] = {}
    for problem in problems:
        before: Mapping[str, str] = manifest.recipes.get(manifest.made_by.get(problem, ""), {})
        options |= {name: before[name] for name in (DETAIL, EVIDENCE) if before.get(name) and before[name] != now[name]}
    if options:
        said = " ".join(f"{name} {value}" for name, value in options.items())
        yield f"to build as before: `derive build {_named(asked, manifest)} {said}`"


def _built_by(asked: Asked, manifest: Manifest) -> str:
    options = {DETAIL: asked.detail, EVIDENCE: asked.evidence, "--engine": asked.engine}
    said = "".join(f" {name} {value}" for name, value in options.items() if value)
    return f"to bring it up to date: `derive build {_named(asked, manifest)}{said}`"


def _named(asked: Asked, manifest: Manifest) -> str:
    """The problem alone where the outputs are of one."""
    known = {name: problem for problem in manifest.pages for name in manifest.outputs_of(problem)}
    stems = {known.get(name, Path(name).stem) for name in asked.outputs}
    (one,) = stems if len(stems) == 1 else ("",)
    return f"{asked.set_id}/{one}" if one and one not in manifest.documents else asked.set_id
