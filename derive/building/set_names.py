"""Which sets exist, and which of them can be built."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from derive.course.names import NAME
from derive.errors import Complaint, Misused

# names that a set cannot have, because the Makefile uses them
TARGETS = frozenset(
    [
        "all",
        "always",
        "bench",
        "build",
        "check",
        "clean",
        "derive",
        "help",
        "mutants",
        "problems",
        "schemas",
        "templates",
        "test",
        "tests",
        "tools",
    ]
)


def set_folder(root: Path, set_id: str) -> Path:
    return root / "build" / set_id


def set_names(root: Path) -> list[str]:
    """Return the sets below the root that have a valid name, without reading their files."""
    folders = sorted(path.parent.name for path in (root / "problems").glob("*/set.yaml"))
    return [name for name in folders if not wrong_set_name(name)]


def wrong_set_name(name: str) -> str:
    """Return why a set cannot have that name; empty if the name is valid."""
    if not NAME.fullmatch(name):
        return "the name of a set has at most 64 letters, digits, `-` and `_`, and begins with a letter or a digit"
    return "`make` has a target of that name" if name in TARGETS else ""


def misnamed_sets(root: Path) -> list[Complaint]:
    """Return a warning about each folder that contains a set.yaml but whose name is not valid for a set."""
    folders = sorted(path.parent.name for path in (root / "problems").glob("*/set.yaml"))
    return [
        Complaint("set-name", f"the set {name!r} is left out: {why}", help="rename its folder", severity="warning")
        for name in folders
        if (why := wrong_set_name(name))
    ]


def outputs_without_set(root: Path) -> list[Complaint]:
    """Return a warning about each folder of outputs whose set has no set.yaml any more."""
    built = sorted(path.parent.name for path in (root / "build").glob("*/.manifest.json"))
    return [
        Complaint(
            "older",
            f"`build/{name}` has the outputs of a set that does not exist any more",
            help=f"`derive clean {name}` removes them",
            severity="warning",
        )
        for name in built
        if not (root / "problems" / name / "set.yaml").is_file()
    ]


def check_asked(root: Path, set_id: str, problems: Collection[str] = ()) -> None:
    """Check that a set and the problems that are asked for exist and can be built."""
    if set_id not in set_names(root):
        from derive.course.problem_set import problem_set

        if (root / "problems" / set_id / "set.yaml").is_file() and (why := wrong_set_name(set_id)):
            raise Misused(Complaint("set-name", f"a set cannot be called {set_id!r}: {why}", help="rename its folder"))
        problem_set(root, set_id)  # raises the error, which suggests the nearest name
    for name in problems:
        from derive.course.problem_set import path_of

        path_of(root, f"{set_id}/{name}")
