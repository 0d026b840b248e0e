"""What is kept between builds, sealed with a key of this machine's own: only what derive itself wrote is believed.

Everything kept is read as data. The key lies in the user's state folder, outside every course: who can
write a course's `build` cannot seal. Where no key can be kept there is one for this process alone, so that nothing
that another process kept is believed and everything is derived.
"""

from __future__ import annotations

import hmac
import json
import os
import secrets
import stat
import tempfile
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

from derive.building.files import write

KEY_BYTES = SEAL_BYTES = 32
MAX_BYTES = 64 * 1024 * 1024


def seal(file: Path, what: str, content: bytes) -> None:
    """Write content with the seal that it is derive's, and `what` it is."""
    write(file, _seal(what, content) + content)


def unsealed(file: Path, what: str) -> bytes | None:
    """The content that was sealed as this; nothing if it is something else, was altered, or cannot be read."""
    try:
        raw = regular_content(file)
    except OSError:
        return None
    content = raw[SEAL_BYTES:]
    return content if hmac.compare_digest(raw[:SEAL_BYTES], _seal(what, content)) else None


def data_of(content: bytes | None) -> Any:
    """The data of JSON that were sealed; nothing if there are none."""
    try:
        return json.loads(content or b"null")
    except (ValueError, RecursionError):
        return None


def regular_content(file: Path, limit: int = MAX_BYTES) -> bytes:
    """The content of a file of a bearable size; what is no file, such as a pipe, is never waited for."""
    with open(os.open(file, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as opened:
        facts = os.fstat(opened.fileno())
        if not stat.S_ISREG(facts.st_mode) or facts.st_size > limit:
            raise OSError(f"{file} is not a file of at most {limit} bytes")
        return opened.read(limit + 1)


def _seal(what: str, content: bytes) -> bytes:
    return hmac.digest(_key(), b"%d:%s" % (len(what.encode()), what.encode()) + content, "sha256")


def key_file() -> Path | None:
    """Where the key of this machine lies; nowhere if the user has no folder of their own."""
    state = os.environ.get("XDG_STATE_HOME", "")
    try:
        folder = Path(state) if os.path.isabs(state) else Path.home() / ".local" / "state"
    except RuntimeError:
        return None
    return folder / "derive" / "cache.key"


@cache
def _key() -> bytes:
    """The key, made at its first use."""
    file = key_file()
    key = _read_key(file) if file else None
    if file and key is None:
        _make_key(file)
        key = _read_key(file)
    return key or secrets.token_bytes(KEY_BYTES)


def _read_key(file: Path) -> bytes | None:
    """The key, if it is whole and nobody else could have read or written it."""
    try:
        facts = os.lstat(file)
        private = stat.S_ISREG(facts.st_mode) and facts.st_uid == os.getuid() and not facts.st_mode & 0o077
        key = regular_content(file, KEY_BYTES) if private else b""
    except OSError:
        return None
    return key if len(key) == KEY_BYTES else None


def _make_key(file: Path) -> None:
    """Put a new key there, whole or not at all; if another process was first, its key stays."""
    with suppress(OSError):  # no key is kept, or another process was first
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        if os.path.lexists(file):  # damaged, or open to others: whatever it sealed is derived anew
            file.unlink()
        with tempfile.NamedTemporaryFile(prefix=f".{file.name}.", dir=file.parent) as temporary:  # its owner's alone
            temporary.write(secrets.token_bytes(KEY_BYTES))
            temporary.flush()
            os.fsync(temporary.fileno())
            os.link(temporary.name, file)
