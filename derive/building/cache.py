"""The results that builds store, such as steps, pages, drawings and PDFs: signed values in one folder.

Most values are stored under a digest of their inputs, so that a change of an input leads to a new value. If the folder
becomes too large, old values are removed.
"""

from __future__ import annotations

import functools
import json
import os
from contextlib import suppress
from dataclasses import dataclass, field
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from derive import FOLDER
from derive.building import signatures
from derive.building.files import shown_path
from derive.building.set_names import set_folder
from derive.errors import BuildFailed, Complaint

CACHE = ".derived"  # the folder in which a set stores data between builds
PACKAGES = ("sympy", "mpmath", "jinja2", "pyyaml", "pylatexenc", "matplotlib")
LIMIT = 256 * 1024 * 1024
NOT_KEPT = "not-kept"


def digest(*parts: str | bytes) -> str:
    """Return a digest of the parts; ("ab", "c") and ("a", "bc") have different digests."""
    sha = sha256()
    for part in parts:
        raw = part.encode() if isinstance(part, str) else part
        sha.update(b"%d:" % len(raw) + raw)
    return sha.hexdigest()


def file_digest(path: Path) -> str:
    """Return the digest of the file's content, or an empty text if the file is missing or cannot be read."""
    try:
        return digest(signatures.regular_content(path))
    except OSError:
        return ""


@functools.cache
def engine_digest(*packages: str) -> str:
    """Return the digest of derive's own modules and of the versions of the given packages."""
    versions = [f"{name}=={package_version(name)}" for name in packages]
    return digest(_own_modules(), *versions)


@functools.cache
def _own_modules() -> str:
    return folder_digest(Path(FOLDER), "*.py")


def folder_digest(folder: Path, pattern: str = "*") -> str:
    """Return the digest of the relative paths and the contents of the files below the folder that match `pattern`;
    files in `__pycache__` are left out."""
    files = sorted(p for p in folder.rglob(pattern) if p.is_file() and "__pycache__" not in p.parts)
    return digest(*(part for p in files for part in (str(p.relative_to(folder)), p.read_bytes())))


def package_version(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def not_kept(refused: Complaint, folder: Path | None = None) -> Complaint:
    """Return the warning that the next build will have to do some work again."""
    said = f"cannot write in `{shown_path(folder)}`{refused.message[refused.message.rindex(': ') :]}" if folder else ""
    message = f"results cannot be stored for the next build: {said or refused.message}"
    return Complaint(NOT_KEPT, message, severity="warning")


@dataclass(frozen=True)
class Cache:
    """The values stored in a folder; with `fresh`, no stored value is read."""

    folder: Path | None = None
    fresh: bool = False
    limit: int = LIMIT
    unkept: list[Complaint] = field(
        default_factory=list, compare=False, repr=False
    )  # warnings about values that could not be written

    def get(self, key: str) -> bytes | None:
        """Return the content stored under the key, or None."""
        if self.folder is None or self.fresh:
            return None
        content = signatures.read_signed(self.folder / key, key)
        if content is not None:
            with suppress(OSError):  # the file may belong to another user
                os.utime(self.folder / key, follow_symlinks=False)
        return content

    def get_data(self, key: str) -> Any:
        """Return the JSON data stored under the key, or None."""
        return signatures.data_of(self.get(key))

    def keep(self, key: str, content: bytes) -> None:
        if self.folder is not None:
            try:
                signatures.write_signed(self.folder / key, key, content)
            except BuildFailed as refused:  # the next build must do this work again, but this build succeeds
                self.unkept.append(not_kept(refused.complaints[0], self.folder))

    def evict(self) -> None:
        """Remove old values if the folder is larger than `limit`."""
        if self.folder is None or not self.folder.is_dir():
            return
        room = self.limit
        try:
            facts = sorted(map(_facts, self.folder.iterdir()), reverse=True)
        except OSError:
            return
        for _, size, file in facts:
            if size <= room:
                room -= size
            else:
                with suppress(OSError):
                    file.unlink()

    def keep_data(self, key: str, data: Any) -> None:
        self.keep(key, json.dumps(data).encode())


NO_CACHE = Cache()


def cache_of_set(root: Path, set_id: str) -> Cache:
    """Return the cache of a set. If the set has no folder of outputs, the cache stores nothing."""
    outputs = set_folder(root, set_id)
    return Cache(outputs / CACHE) if outputs.is_dir() else NO_CACHE


@dataclass(frozen=True)
class Kept:
    """A cached value that the next value of the same kind replaces, such as the page numbers of a document."""

    cache: Cache
    key: str

    def get(self) -> bytes | None:
        return self.cache.get(self.key)

    def keep(self, content: bytes) -> None:
        self.cache.keep(self.key, content)


def _facts(file: Path) -> tuple[int, int, Path]:
    """Return the time of last use, the size and the path of a file."""
    try:
        facts = file.lstat()
    except OSError:
        return 0, 0, file
    return facts.st_mtime_ns, facts.st_size, file
