"""Runs a command. An error that stops the command is reported in a few lines; DERIVE_DEBUG=1 adds the traceback of an
internal error."""

from __future__ import annotations

import argparse
import errno
import os
import signal
import sys
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from types import FrameType
from typing import NoReturn

from derive.building.files import cannot_write, of_system
from derive.cli.output import deliver
from derive.cli.streams import silence
from derive.cli.terminal import complain, paced, tell
from derive.errors import BuildFailed, Complaint, DeriveError

_REPORT = "   = help: this is a bug in derive: report it with the traceback and the files of the problem"
_UNWRITTEN = {errno.EBADF, errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO}

# The module and the function of each command; only the module of the requested command is loaded.
COMMANDS = {
    "list": "listing.list_problems",
    "solve": "solving.solve",
    "explain": "solving.explain",
    "diff": "comparing.diff",
    "check": "checking.check",
    "audit": "auditing.audit",
    "grade": "grading.grade",
    "build": "building.build",
    "preview": "previewing.preview_pages",
    "init": "beginning.init",
    "new": "beginning.new",
    "variants": "variants.variants",
    "class": "classes.make_class",
    "export": "exporting.export",
    "schema": "beginning.schema",
    "clean": "keeping.clean",
    "doctor": "keeping.doctor",
    "why": "staleness.why",
    "completion": "shells.completion",
}


def exit_code(arguments: argparse.Namespace) -> int:
    """Run a command and return its exit code; report an error that stops the command."""
    try:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if signal.getsignal(number) != signal.SIG_IGN:  # a signal that is ignored, as under `nohup`, stays ignored
                signal.signal(number, _signaled)
        with paced():
            code = _command(arguments.command)(arguments)
        sys.stdout.flush()
        return code
    except DeriveError as error:
        return _told(error)
    except KeyboardInterrupt:
        tell("")
        print("interrupted", file=sys.stderr)
        return 130
    except BrokenPipeError:
        # The program that reads our output has closed the pipe; the interpreter must not report this error again.
        silence(1)
        return 141
    except MemoryError:
        return _told(BuildFailed(Complaint("system", "there is too little memory")))
    except Exception as error:
        if isinstance(error, OSError) and error.filename is None and error.errno in _UNWRITTEN:
            silence(1)
            return _told(cannot_write(Path("standard output"), error))
        known = of_system(error) if isinstance(error, OSError) else None
        if known:
            return _told(known)
        tell("")
        trace = getattr(error, "trace", None)  # an error inside a worker
        internal(str(error) if trace else f"{type(error).__name__}: {error}", trace or traceback.format_exc())
        return 1


def _command(name: str) -> Callable[[argparse.Namespace], int]:
    module, _, function = COMMANDS[name].partition(".")
    found: Callable[[argparse.Namespace], int] = getattr(import_module(f"derive.cli.commands.{module}"), function)
    return found


def _told(error: DeriveError) -> int:
    tell("")
    complain(error.complaints)
    return error.exit_code


class Ending:
    """The number of the signal that asked this process to end; 0 without such a signal. A server checks this number,
    because a library may lose the exception that the signal handler raises."""

    number = 0

    def is_set(self) -> bool:
        return self.number != 0


ending = Ending()


class _Interrupted(KeyboardInterrupt):
    """The exception for Ctrl-C. After a KeyboardInterrupt in `exec` of a string, Python kills the process when it
    exits, even if the exception was caught. A subclass of KeyboardInterrupt does not have this effect."""


def _signaled(number: int, _: FrameType | None) -> NoReturn:
    """Raise an exception that unwinds the stack, so that every worker is stopped."""
    ending.number = number
    raise _Interrupted if number == signal.SIGINT else SystemExit(128 + number)


def internal(summary: str, trace: str) -> None:
    if os.environ.get("DERIVE_DEBUG"):
        print(trace, file=sys.stderr)
    first = (summary.splitlines() or [""])[0]
    print(f"internal error: {first} (DERIVE_DEBUG=1 shows the traceback)\n{_REPORT}", file=sys.stderr)


@contextmanager
def waiting(text: str) -> Iterator[None]:
    tell(text)
    try:
        yield
    finally:
        tell("")


def delivered(pdf: bytes, output: str, quiet: bool = False) -> None:
    from derive.building.files import shown_path

    deliver(pdf, output)
    if output != "-" and not quiet:
        print(f"wrote {shown_path(Path(output))}", file=sys.stderr)
