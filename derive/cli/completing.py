"""The names that a shell completes: sets, problems, topics and pages from file names, and steps from the last build.

The shell runs this code each time that you press Tab. So this module loads no module for derivations. It reads a
page only to complete the keys of steps.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Iterable
from pathlib import Path

from derive.cli.problem_ids import found_root, problem_id_of
from derive.errors import DeriveError

_NOT_PROBLEMS = ("set", "reference")
_PAGES = (".html", ".json", ".pdf", ".svg", ".tex", ".txt")


def offer(parser: argparse.ArgumentParser) -> None:
    """Print the completions for the shell that asks, and exit; options are offered only for a word that begins with
    `-`."""
    from argcomplete import autocomplete

    autocomplete(parser, always_complete_options=False)


def offered(names: str, prefix: str, root: str | None, problem: str = "") -> list[str]:
    """Return the names of this sort that begin with the prefix; without a course, the list is empty. For the sort
    "steps", the names are the keys of the steps of `problem`."""
    try:
        folder = found_root(root)
    except DeriveError:
        return []
    if folder is None:
        return []
    found = _steps(folder, problem_id_of(problem)) if names == "steps" else _NAMES[names](folder)
    return sorted({name for name in found if name.startswith(prefix)})


def _steps(root: Path, problem_id: str) -> list[str]:
    """Return the keys of the steps that the problem's page had when it was last built."""
    try:
        page = json.loads((root / "build" / f"{problem_id}.json").read_bytes())
        return [str(step["key"]) for step in page["steps"]]
    except (OSError, ValueError, LookupError, TypeError):  # the page is not built, or not written by derive
        return []


def _sets(root: Path) -> list[str]:
    return [file.parent.name for file in (root / "problems").glob("*/set.yaml")]


def _files(root: Path) -> list[tuple[str, ...]]:
    """Return the parts of each problem's path: set, topic if it has one, file."""
    top = root / "problems"
    files = [file for depth in ("*/*.yaml", "*/*/*.yaml") for file in top.glob(depth)]
    return [file.relative_to(top).parts for file in files if file.stem not in _NOT_PROBLEMS]


def _ids(root: Path) -> list[str]:
    return [f"{parts[0]}/{Path(parts[-1]).stem}" for parts in _files(root)]


def _topics(root: Path) -> list[str]:
    return [parts[1] for parts in _files(root) if len(parts) > 2]


def _pages(root: Path) -> list[str]:
    pages = [file for file in (root / "build").glob("*/[!.]*") if file.suffix in _PAGES]
    return [file.relative_to(root).as_posix() for file in pages]


_NAMES: dict[str, Callable[[Path], Iterable[str]]] = {
    "sets": _sets,
    "ids": _ids,
    "ids and sets": lambda root: [*_sets(root), *_ids(root)],
    "topics": _topics,
    "new": lambda root: [f"{name}/" for name in _sets(root)],
    "like": lambda root: ["system", "body", "rotation", "script", *_ids(root)],
    "outputs": lambda root: [*_pages(root), *_ids(root), *_sets(root)],
}
