"""Files that derive writes: each is written completely or not at all.

A finished file gets its name by one rename. A reader therefore finds the old or the new content, even if a build is
killed.
"""

from __future__ import annotations

import errno
import fcntl
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from derive.errors import BuildFailed, Complaint

UNFINISHED = ".part"  # the suffix of a file that is being written

_REASONS = {
    errno.ENOSPC: "the disk is full",
    errno.EDQUOT: "the disk quota is used up",
    errno.EACCES: "permission denied",
    errno.EPERM: "permission denied",
    errno.EROFS: "the disk is read-only",
    errno.ENOTDIR: "a file is where a folder should be",
    errno.EEXIST: "a file is where a folder should be",
    errno.EISDIR: "a folder is where a file should be",
    errno.ENAMETOOLONG: "the name is too long",
    errno.ELOOP: "a link is where a file should be",
    errno.EBADF: "it is closed",
}
_SHORT = {
    errno.EMFILE: "too many files are open",
    errno.ENFILE: "too many files are open",
    errno.ENOMEM: "memory is short",
    errno.EAGAIN: "there are too many processes, or memory is short",
    errno.ENOSPC: "the disk is full",
    errno.EDQUOT: "the disk quota is used up",
    errno.EIO: "the disk or the terminal fails",
}


def shown_path(path: Path) -> str:
    """Return a path as text: relative to the working folder if it is below that folder, otherwise unchanged."""
    try:
        relative = os.path.relpath(path)
    except FileNotFoundError:  # the working folder does not exist any more
        return str(path)
    return str(path) if relative.startswith("..") else relative


def cannot_write(path: Path, error: OSError) -> BuildFailed:
    reason = _REASONS.get(error.errno or 0, (error.strerror or str(error)).lower())
    return BuildFailed(Complaint("cannot-write", f"cannot write `{shown_path(path)}`: {reason}"))


def of_system(error: OSError, what: str = "the system refuses") -> BuildFailed | None:
    """Return a failure that names the resource that the system lacks; None if `error` has another cause."""
    reason = _SHORT.get(error.errno or 0)
    return BuildFailed(Complaint("system", f"{what}: {reason}")) if reason else None


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Raise `BuildFailed` if the system refuses to write `path` in the `with` block."""
    try:
        yield
    except OSError as error:
        raise cannot_write(path, error) from None


def folder(path: Path) -> Path:
    with writing(path):
        path.mkdir(parents=True, exist_ok=True)
    return path


def write(path: Path, content: str | bytes) -> bool:
    """Write `content` to `path`, and return whether the file changed."""
    raw = content.encode() if isinstance(content, str) else content
    folder(path.parent)
    with writing(path):
        if path.is_file() and path.read_bytes() == raw:
            return False
        handle, name = _unfinished(path)
        try:
            with open(handle, "wb") as temporary:
                temporary.write(raw)
                temporary.flush()
                os.fsync(handle)
                os.chmod(name, 0o666 & ~_umask())
                os.replace(name, path)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
    return True


def _unfinished(path: Path) -> tuple[int, str]:
    """Open a temporary file next to `path`, locked by this process."""
    while True:
        handle, name = tempfile.mkstemp(prefix=f".{path.name}.", suffix=UNFINISHED, dir=path.parent)
        if is_held(handle, Path(name)):
            return handle, name
        os.close(handle)  # another build removed the file before it was locked


def is_held(handle: int, path: Path) -> bool:
    """Lock an open file until it is closed or the process ends; return whether `path` still refers to this file."""
    with suppress(OSError):  # the disk does not support locks
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    try:
        return os.path.samestat(os.fstat(handle), os.lstat(path))
    except FileNotFoundError:
        return False


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
