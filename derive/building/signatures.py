"""Data stored between builds. A signature with a key of this machine shows that derive wrote them.

Stored content is read as data, not executed. The key is in the state folder of the user, so other people who can write
in the `build` folder of a course cannot sign. If no key can be stored, the data of earlier builds are not used.
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

KEY_BYTES = SIGNATURE_BYTES = 32
MAX_BYTES = 64 * 1024 * 1024


def write_signed(file: Path, what: str, content: bytes) -> None:
    """Write the content with a signature that is valid for the purpose `what` only."""
    write(file, _signature(what, content) + content)


def read_signed(file: Path, what: str) -> bytes | None:
    """Return the content if it was signed for the purpose `what`, otherwise None."""
    try:
        raw = regular_content(file)
    except OSError:
        return None
    content = raw[SIGNATURE_BYTES:]
    return content if hmac.compare_digest(raw[:SIGNATURE_BYTES], _signature(what, content)) else None


def data_of(content: bytes | None) -> Any:
    """Return the data of signed JSON; None if the content is missing or not JSON."""
    try:
        return json.loads(content or b"null")
    except (ValueError, RecursionError):
        return None


def regular_content(file: Path, limit: int = MAX_BYTES) -> bytes:
    """Return the content of a regular file that is not larger than `limit`."""
    with open(os.open(file, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as opened:
        facts = os.fstat(opened.fileno())
        if not stat.S_ISREG(facts.st_mode) or facts.st_size > limit:
            raise OSError(f"{file} is not a file of at most {limit} bytes")
        return opened.read(limit + 1)


def _signature(what: str, content: bytes) -> bytes:
    return hmac.digest(_key(), b"%d:%s" % (len(what.encode()), what.encode()) + content, "sha256")


def key_file() -> Path | None:
    """Return the path of this machine's key; None if the state folder of the user is unknown."""
    state = os.environ.get("XDG_STATE_HOME", "")
    try:
        folder = Path(state) if os.path.isabs(state) else Path.home() / ".local" / "state"
    except RuntimeError:
        return None
    return folder / "derive" / "cache.key"


@cache
def _key() -> bytes:
    """Return the key, which is made at its first use; if it cannot be stored, it is valid for this process only."""
    file = key_file()
    key = _read_key(file) if file else None
    if file and key is None:
        _make_key(file)
        key = _read_key(file)
    return key or secrets.token_bytes(KEY_BYTES)


def _read_key(file: Path) -> bytes | None:
    """Return the key in the file; None if the file is missing, incomplete, owned by another user, or accessible to
    others."""
    try:
        facts = os.lstat(file)
        private = stat.S_ISREG(facts.st_mode) and facts.st_uid == os.getuid() and not facts.st_mode & 0o077
        key = regular_content(file, KEY_BYTES) if private else b""
    except OSError:
        return None
    return key if len(key) == KEY_BYTES else None


def _make_key(file: Path) -> None:
    with suppress(OSError):  # no key can be stored, or another process was first
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        if os.path.lexists(file) and _read_key(file) is None:  # replace a key that `_read_key` rejects
            file.unlink()
        # only its owner can read the temporary file
        with tempfile.NamedTemporaryFile(prefix=f".{file.name}.", dir=file.parent) as temporary:
            temporary.write(secrets.token_bytes(KEY_BYTES))
            temporary.flush()
            os.fsync(temporary.fileno())
            os.link(temporary.name, file)
