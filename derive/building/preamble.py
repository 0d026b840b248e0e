"""What all documents of a set begin with, taken in by TeX once: its classes, packages and commands as a format.

A template says by a line of its own where the documents begin to differ. What stands above it is loaded and dumped, and
the format is kept with all else that a build keeps; a source then has these lines as comments, so that its lines have
the same numbers as before. Where there is no such line, or TeX cannot do it, a document is typeset as it stands.

Source: *The TeXbook*, ch. 27 (formats), and the package mylatexformat.
"""

from __future__ import annotations

import subprocess
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from derive.building.cache import Cache, digest
from derive.building.files import write

__all__ = ["DIFFERS", "NAME", "Shared", "beginning", "shared_by_all"]

DIFFERS = "%% derive: from here on documents differ\n"
NAME = "preamble"  # of the format in the folder where TeX runs
CANNOT = b""  # instead of a format: this engine cannot dump this preamble, and need not be asked again

Environment = Mapping[str, str]


@dataclass(frozen=True)
class Shared:
    """The format of a preamble, and a source that goes without it."""

    format: bytes
    source: str


def beginning(templates: Path) -> str:
    """What all documents begin with, before there is any; nothing if the template must be filled first."""
    with suppress(OSError, ValueError):
        text = (templates / "latex" / "document.tex.j2").read_text(encoding="utf-8")
        above, differs, _ = text.partition(DIFFERS)
        if differs and not any(sign in above for sign in ("<<", "<%", "<#")):
            return above + differs
    return ""


def shared_by_all(
    tex: str, engine: str, identity: str, options: Sequence[str], cache: Cache, place: Path, environment: Environment
) -> Shared | None:
    """The preamble of a source as a format, made in a folder by that engine unless the cache has it; else nothing."""
    above, differs, below = tex.partition(DIFFERS)
    if not differs or cache.folder is None:
        return None
    key = digest("format", above, identity)
    made = cache.recalled(key)
    if made is None:
        made = _dumped(above, [engine, "-ini", *options], environment, place)
        cache.keep(key, made)
    if made == CANNOT:
        return None
    return Shared(made, "".join(f"%{line}" for line in above.splitlines(keepends=True)) + differs + below)


def _dumped(above: str, command: Sequence[str], environment: Environment, place: Path) -> bytes:
    source, made = place / f"{NAME}.tex", place / f"{NAME}.fmt"
    write(source, above + "\\dump\n")
    try:
        run = subprocess.run(
            [*command, "&pdflatex", source.name], cwd=place, env=environment, timeout=60,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        return made.read_bytes() if run.returncode == 0 else CANNOT
    except (OSError, subprocess.TimeoutExpired):
        return CANNOT
