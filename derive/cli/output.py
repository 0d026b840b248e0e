"""The output of a command, to standard output or to a file; a file written by hand is not replaced."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from derive import FOLDER
from derive.building.files import writing
from derive.errors import Complaint, Misused
from derive.render.formats import WRITTEN

_WRITTEN_BY_HAND = {".py", ".yaml", ".yml", ".j2", ".toml", ".md"}


def check_output(output: str | None, root: Path) -> None:
    """Before any work, reject a target of `-o` that is a link, a folder or a file written by hand."""
    if output in (None, "-"):
        return
    path = Path(output or "")
    if not output or "\0" in output:
        message = "`-o` needs the name of a file"
    else:
        with writing(path):
            message = _kept_from(path, root)
    if message:
        raise Misused(Complaint("output", message, help="name a file such as `block.txt`; `-` is standard output"))


def _kept_from(path: Path, root: Path) -> str:
    """Return the reason why a path must not be written to; the text is empty if writing is allowed."""
    if os.path.islink(path):
        return f"`{path}` is a link, and its target is not replaced"
    if os.path.isdir(path):
        return f"`{path}` is a folder"
    by_hand = path.suffix in _WRITTEN_BY_HAND and not _is_ours(path)
    written = os.path.isfile(path) and (by_hand or _belongs_to(path, root))
    return f"`{path}` is not replaced, because it may be written by hand" if written else ""


def _is_ours(path: Path) -> bool:
    with suppress(OSError), path.open("rb") as file:
        return WRITTEN.encode() in file.readline(200)
    return False


def _belongs_to(path: Path, root: Path) -> bool:
    """Return whether a file is a Makefile, or is in `problems`, in `templates` or among the code of derive."""
    folders = (root / "problems", root / "templates", Path(FOLDER))
    return path.name == "Makefile" or any(path.resolve().is_relative_to(folder.resolve()) for folder in folders)


def deliver(content: bytes, output: str | None) -> None:
    """Write the requested output; a file is written completely or not at all."""
    from derive.building.files import write

    path = Path(output or "-")
    if output in (None, "-"):
        # Not sys.stdout.buffer: with PYTHONUNBUFFERED it may write only a part and report no error.
        with open(1, "wb", closefd=False) as out:
            out.write(content)
    elif os.path.exists(path) and not os.path.isfile(path) and not os.path.isdir(path):
        with writing(path):  # a device or a pipe cannot be replaced
            path.write_bytes(content)
    else:
        write(path, content)
