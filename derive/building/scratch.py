"""Temporary folders. A process removes its own folders; the next build removes the folders of killed processes.

A lock is released when its process ends, so a locked folder is in use, and an unlocked folder can be removed.
"""

from __future__ import annotations

import fcntl
import os
import re
import shutil
import tempfile
from contextlib import suppress
from functools import cache
from pathlib import Path

from derive.building.files import UNFINISHED, is_held, writing

PREFIX, HELD = "derive-scratch-", ".held"
_NAME = re.compile(rf"{PREFIX}\w{{8}}")


class Scratch:
    """A temporary folder with the path `name`."""

    def __init__(self) -> None:
        with writing(Path(tempfile.gettempdir())):
            self._folder = tempfile.TemporaryDirectory(prefix=PREFIX, ignore_cleanup_errors=True)
            whole = Path(self._folder.name)
            self._lock = os.open(whole / "lock", os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
            is_held(self._lock, whole / "lock")
            os.rename(whole / "lock", whole / HELD)  # the file is locked before it gets this name
            self.name = str(whole / "work")
            os.mkdir(self.name)

    def cleanup(self) -> None:
        self._folder.cleanup()
        with suppress(OSError):
            os.close(self._lock)

    def __enter__(self) -> str:
        return self.name

    def __exit__(self, *_: object) -> None:
        self.cleanup()


@cache  # a process sweeps the same folders only once, even if it builds often
def sweep(*folders: Path) -> None:
    """Remove unfinished files in these folders, and scratch folders of this user that no process uses."""
    for folder in folders:
        with suppress(OSError), os.scandir(folder) as entries:
            for entry in entries:
                if entry.name.startswith(".") and entry.name.endswith(UNFINISHED) and _is_left(Path(entry.path)):
                    os.unlink(entry.path)
    with suppress(OSError), os.scandir(tempfile.gettempdir()) as entries:
        for entry in entries:
            if _NAME.fullmatch(entry.name) and entry.is_dir(follow_symlinks=False):
                if entry.stat(follow_symlinks=False).st_uid == os.getuid() and _is_left(Path(entry.path, HELD)):
                    shutil.rmtree(entry.path, ignore_errors=True)


def _is_left(file: Path) -> bool:
    """Return whether the file exists and no process has locked it."""
    try:
        handle = os.open(file, os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError:
        return False
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return is_held(handle, file)
    except OSError:
        return False
    finally:
        os.close(handle)
