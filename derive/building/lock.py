"""A lock, so that only one build of a set runs at a time."""

from __future__ import annotations

import fcntl
import os
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from derive.building.files import shown_path, writing
from derive.errors import BuildFailed, Complaint


@contextmanager
def locked(outputs: Path, waiting: Callable[[], None]) -> Iterator[None]:
    """Lock a set's folder during the `with` block. The system releases the lock if this process is killed."""
    path = outputs / ".lock"
    with writing(path):  # do not follow a link, and do not wait for a pipe
        lock = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, 0o666)
    try:
        if not stat.S_ISREG(os.fstat(lock).st_mode):
            raise BuildFailed(Complaint("cannot-write", f"`{shown_path(path)}` is not a file", help="remove it"))
        try:
            fcntl.lockf(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            waiting()
            fcntl.lockf(lock, fcntl.LOCK_EX)
        yield
    finally:
        os.close(lock)
