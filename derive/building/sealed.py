"""What is kept between builds, sealed with a key of this machine's own: only what derive itself wrote is believed.

Everything kept is JSON and is read as data. The key lies in the user's state folder, outside every course: who can
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
from functools import cache
from pathlib import Path
from typing import Any

from derive.building.files import write

KEY_BYTES = 32
MAX_BYTES = 64 * 1024 * 1024


def keep(file: Path, what: str, kept: Any) -> None:
    """Keep data of JSON under `what` it was made from."""
    text = json.dumps(kept)
    write(file, json.dumps({"of": what, "seal": _seal(file.name, what, text), "kept": text}))


def recalled(file: Path, what: str) -> Any:
    """What was kept under this; nothing if it was kept under something else, was altered, or cannot be read."""
    try:
        raw = regular_content(file, MAX_BYTES)
        sealed = json.loads(raw)
        if not isinstance(sealed, dict) or sealed.get("of") != what:
            return None
        text, seal = sealed.get("kept"), sealed.get("seal")
        if not isinstance(text, str) or not isinstance(seal, str):
            return None
        if not hmac.compare_digest(seal.encode(), _seal(file.name, what, text).encode()):
            return None
        return json.loads(text)
    except (OSError, ValueError, RecursionError):
        return None


def regular_content(file: Path, limit: int) -> bytes:
    """The content of a file of a bearable size; what is no file, such as a pipe, is never waited for."""
    with open(os.open(file, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as opened:
        facts = os.fstat(opened.fileno())
        if not stat.S_ISREG(facts.st_mode) or facts.st_size > limit:
            raise OSError(f"{file} is not a file of at most {limit} bytes")
        return opened.read(limit + 1)


def _seal(*parts: str) -> str:
    raw = b"".join(b"%d:%s" % (len(part.encode()), part.encode()) for part in parts)
    return hmac.new(_key(), raw, "sha256").hexdigest()


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
    name = ""
    try:
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        if os.path.lexists(file):  # damaged, or open to others: whatever it sealed is derived anew
            file.unlink()
        handle, name = tempfile.mkstemp(prefix=f".{file.name}.", dir=file.parent)  # readable by its owner alone
        with open(handle, "wb") as temporary:
            temporary.write(secrets.token_bytes(KEY_BYTES))
            temporary.flush()
            os.fsync(handle)
        os.link(name, file)
    except OSError:
        pass  # no key is kept, or another process was first
    finally:
        if name:
            Path(name).unlink(missing_ok=True)
