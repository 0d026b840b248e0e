"""The standard streams of a command, and output that is printed before a command runs."""

from __future__ import annotations

import argparse
import codecs
import os
import sys
from collections.abc import Callable
from contextlib import redirect_stdout
from io import StringIO, TextIOWrapper


def read(parse: Callable[[], argparse.Namespace]) -> argparse.Namespace:
    """Return the parsed command line; if parsing prints a text and exits, as for the version, check that the text is
    written."""
    _open_streams()
    shown = StringIO()
    try:
        with redirect_stdout(shown):
            return parse()
    except SystemExit:
        try:
            print(shown.getvalue(), end="", flush=True)
        except BrokenPipeError:
            silence(1)
            raise SystemExit(141) from None
        except OSError as error:
            silence(1)
            raise SystemExit(_unwritten(error)) from None
        raise


def _unwritten(error: OSError) -> int:
    from pathlib import Path

    from derive.building.files import cannot_write
    from derive.cli.terminal import complain

    failed = cannot_write(Path("standard output"), error)
    complain(failed.complaints)
    return failed.exit_code


def silence(descriptor: int) -> None:
    """Discard all further output to a descriptor, also buffered output."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), descriptor)


def _open_streams() -> None:
    """Open a substitute for each closed standard stream: otherwise another file could get its descriptor, and output
    would be written to that file. Also set the encoding of the output."""
    for descriptor, mode in ((0, os.O_RDONLY), (1, os.O_RDONLY), (2, os.O_WRONLY)):
        try:
            os.fstat(descriptor)
        except OSError:
            os.open(os.devnull, mode)  # descriptor 1 is opened for reading, so that writing to it fails
    sys.stdout = sys.stdout or open(1, "w", closefd=False)  # noqa: SIM115
    sys.stderr = sys.stderr or open(2, "w", closefd=False)  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            # Without a language setting the encoding is ASCII, but the output needs UTF-8.
            ascii_only = codecs.lookup(stream.encoding).name == "ascii"
            stream.reconfigure(encoding="utf-8" if ascii_only else None, errors="backslashreplace")
