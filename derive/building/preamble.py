"""The common beginning of documents as a TeX format, so that TeX reads classes and packages only once.

A line of the template marks the end of the preamble, the common beginning. TeX loads the preamble and dumps a format,
which is stored in the cache of the builds. In the source of a document, the lines of the preamble become comments, so
that line numbers do not change. If TeX cannot dump a format, documents are typeset without one.

Source: *The TeXbook*, ch. 24 (the command that dumps a format), and the package mylatexformat.
"""

from __future__ import annotations

import functools
import gzip
import os
import shutil
import subprocess
import zlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from derive.building.cache import Cache, digest
from derive.building.files import write
from derive.building.scratch import Scratch

if TYPE_CHECKING:
    from derive.page.template import Templates

__all__ = ["DIFFERS", "NAME", "at_hand", "beginning", "without_preamble"]

DIFFERS = "%% derive: from here on documents differ\n"
NAME = "preamble"  # the format's name in the folder where TeX runs
PACKED = b"\x1f\x8b"
ROOM = 64 * 1024 * 1024  # with fewer free bytes, the disk counts as full
CANNOT = b""  # stored in place of a format if the engine cannot dump this preamble

Environment = Mapping[str, str]


def beginning(templates: Templates, detail: str | None, font_size: str | None = None) -> str:
    """Return the preamble that all documents of this level and font size share; it may be empty."""
    from derive.render.printing.templates import filled_above
    from derive.steps.level import Level

    facts = {"detail": Level(detail or "standard").value, "font_size": (font_size or "").replace(" ", "")}
    above = filled_above(templates, "document.tex.j2", DIFFERS, facts)
    return above + DIFFERS if above else ""


@functools.cache
def at_hand() -> Scratch:
    """Return the temporary folder for the formats of this process and its workers."""
    return Scratch()


def without_preamble(
    tex: str, engine: str, identity: str, options: Sequence[str], cache: Cache, place: Path, environment: Environment
) -> str | None:
    """Return a source whose preamble is turned into comments, and put the format of the preamble into `place`.

    Return None if there is no format.
    """
    above, differs, below = tex.partition(DIFFERS)
    if not differs or cache.folder is None:
        return None
    key = digest("format", above, identity)
    file, own = Path(at_hand().name, key), place / f"{NAME}.fmt"
    if not file.is_file():
        made = cache.get(key)
        if made is None:
            made = _dumped(above, [engine, "-ini", *options], environment, place)
            if made != CANNOT or shutil.disk_usage(place).free > ROOM:  # a failure on a full disk is not stored
                cache.keep(key, made)
        if made == CANNOT:
            return None
        own.write_bytes(made)
        os.replace(own, file)
    try:
        os.link(file, own)
    except OSError:  # not all disks support links
        shutil.copyfile(file, own)
    return "".join(f"%{line}" for line in above.splitlines(keepends=True)) + differs + below


def _dumped(above: str, command: Sequence[str], environment: Environment, place: Path) -> bytes:
    source, made = place / f"{NAME}.tex", place / f"{NAME}.fmt"
    write(source, above + "\\dump\n")
    try:
        run = subprocess.run(
            [*command, "&pdflatex", source.name], cwd=place, env=environment, timeout=60,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        content = made.read_bytes() if run.returncode == 0 else CANNOT
        return gzip.decompress(content) if content.startswith(PACKED) else content
    except (OSError, EOFError, zlib.error, subprocess.TimeoutExpired):
        return CANNOT
