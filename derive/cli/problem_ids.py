"""The folder of the course, the library of derive, and the ids of the problems that a command line names."""

from __future__ import annotations

import argparse
import os
import re
from contextlib import suppress
from pathlib import Path

from derive import FOLDER
from derive.cli.terminal import complain
from derive.errors import Complaint, Misused

LIBRARY = "library"  # the set of problems that is installed with derive


def found_root(named: str | None) -> Path | None:
    """Return the folder that contains `problems`, or None if there is no such folder.

    If `named` is given, only this folder is tried. Otherwise, if DERIVE_ROOT is set, only that folder is tried.
    Otherwise the working folder, the folders above it, and the checkout of derive are tried in this order.
    """
    asked = named or os.environ.get("DERIVE_ROOT")
    try:
        here = Path.cwd()
        candidates = [Path(asked)] if asked else [here, *here.parents, Path(FOLDER).resolve().parent]
        return next((folder.resolve() for folder in candidates if _has_problems(folder)), None)
    except FileNotFoundError:
        message = "the folder that you are in does not exist any more"
        raise Misused(Complaint("no-root", message, help="change to another folder")) from None


def _has_problems(folder: Path) -> bool:
    try:
        return (folder / "problems").is_dir()
    except (OSError, ValueError):  # an invalid name, or a folder that cannot be read
        return False


def root_of(arguments: argparse.Namespace) -> Path:
    root = found_root(arguments.root)
    if root is None:
        asked = arguments.root or os.environ.get("DERIVE_ROOT")
        where = f"in `{asked}`" if asked else "here or above"
        help_line = "`derive init FOLDER` makes a course; or name the folder of your course with `--root`"
        raise Misused(Complaint("no-root", f"no folder `problems` was found {where}", help=help_line))
    return root


def library_root(root: Path | None) -> Path | None:
    """Return the folder whose `problems` contains the library: the course if it has a library of its own, otherwise
    derive itself. Return None if neither has a library."""
    package = Path(FOLDER).resolve()
    for folder in (root, package, package.parent):
        if folder is not None and (folder / "problems" / LIBRARY / "set.yaml").is_file():
            return folder
    return None


def root_with(arguments: argparse.Namespace, set_id: str) -> Path:
    """Return the folder that contains the problems of a set: for the library, the folder from `library_root`; for any
    other set, the course."""
    library = library_root(found_root(arguments.root)) if set_id == LIBRARY else None
    return library or root_of(arguments)


def problem_id_of(text: str) -> str:
    """Return the id of a problem from an id or a path such as problems/hw9/block.yaml; leave out the topic, if any."""
    return re.sub(r"^([^/]+)/[^/]+/([^/]+)$", r"\1/\2", new_id_of(text))


def new_id_of(text: str) -> str:
    """Return the id of a new problem from the id or path that the user wrote.

    A `.yaml` file that exists may be named by any path to it, and a folder by `.` or by a path with `/`. Any other
    path begins with `problems/`.
    """
    with suppress(OSError, ValueError, RuntimeError):  # it is not the path of a file in the folder `problems`
        file, root = Path(text).expanduser(), found_root(None)
        is_folder = file.is_dir() and (text == "." or "/" in text)
        if root is not None and (is_folder or (file.suffix == ".yaml" and file.is_file())):
            text = file.resolve().relative_to((root / "problems").resolve()).as_posix()
    return text.removeprefix("./").removeprefix("problems/").removesuffix(".yaml").rstrip("/")


def warn_of_names(root: Path) -> None:
    from derive.building.set_names import misnamed_sets

    complain(misnamed_sets(root))


def warn_of_templates(root: Path) -> None:
    if (root / "templates").is_dir():
        from derive.page.template import unused_templates

        complain(unused_templates(root))
