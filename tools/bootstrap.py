"""Make or repair the environment in `.venv` if necessary. `make` runs this script; it needs no installed packages.

The installer accepts only wheels with the digests in `locks/`, so it cannot install an unknown package. It then
installs derive itself with the build tools among these packages, without access to any registry.

A stamp file in `.venv` records that the environment fits `pyproject.toml` and `locks/`. The stamp `.runtime` covers
the packages that `derive` needs; `.tests` covers these packages, the linters and the test tools. The file
`.unfinished` exists while packages are being installed. If `.unfinished` exists at the start, an earlier installation
was interrupted or failed, and this script makes the environment from the beginning.
"""

from __future__ import annotations

import fcntl
import hashlib
import importlib.util
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
PYTHON = VENV / "bin" / "python"
UNFINISHED = VENV / ".unfinished"
OLDEST = (3, 11)


class Stopped(Exception):
    """The environment cannot be made; the message states the reason and, if there is one, the fix."""


@contextmanager
def alone() -> Iterator[None]:
    """Allow one installation at a time: a second `make` waits here until the first has finished its installation."""
    lock = os.open(ROOT / ".venv.lock", os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, 0o666)
    try:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            print("waiting for another make, which is setting up .venv", flush=True)
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield
    finally:
        os.close(lock)


def fingerprint() -> str:
    """Return a digest of all files that determine the environment."""
    sources = [ROOT / "pyproject.toml", *(ROOT / lock for lock in LOCKS.values()), Path(__file__)]
    return hashlib.sha256(b"\0".join(path.read_bytes() for path in sources)).hexdigest()


def works(uv: str | None) -> bool:
    """Return whether the Python in `.venv` runs, is new enough, and has `pip` if there is no `uv`."""
    installer = bool(uv) or "importlib.util.find_spec('pip')"
    probe = f"import sys, importlib.util; sys.exit(sys.version_info < {OLDEST} or not {installer})"
    try:
        return subprocess.run([PYTHON, "-I", "-c", probe], capture_output=True).returncode == 0
    except OSError:
        return False


def has_venv() -> bool:
    """Return whether this Python has `venv` and `ensurepip`, which Debian puts into separate packages."""
    return bool(importlib.util.find_spec("venv") and importlib.util.find_spec("ensurepip"))


def check_tools(uv: str | None) -> None:
    name = Path(sys.executable).name or "python3"
    if sys.version_info < OLDEST:
        this = sys.version.split()[0]
        raise Stopped(
            f"error[python]: derive needs Python 3.11 or later, but this is {this}: install a newer one, or uv"
        )
    if not uv and not has_venv():
        fix = f"run `apt install {name}-venv` or install uv, and then run `make` again"
        raise Stopped(f"error[venv]: {name} has no working venv module: {fix}")


def run(command: list[str], failed: str) -> None:
    """Run a command without showing its output; if it fails, raise `Stopped` with the reason, without URLs."""
    done = subprocess.run(command, cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode:
        lines = [line.strip() for line in done.stdout.splitlines() if line.strip()]
        reasons = [line for line in lines if re.match(r"(?i)error|fatal|.*no space left|×", line)] or lines
        reason = re.sub(r"\w+://\S+", "(address)", "; ".join(reasons[-2:]) or f"exit code {done.returncode}")
        raise Stopped(f"error[install]: {failed}: {reason}")


WANTED = {
    ".runtime": "SymPy and the TeX engine (once, about 100 MB)",
    ".tests": "SymPy, the TeX engine and the test tools (once, about 140 MB)",
}
LOCKS = {".runtime": "locks/runtime.txt", ".tests": "locks/tests.txt"}  # tests.txt lists only additional packages
CHECKED = ["--require-hashes", "--only-binary", ":all:"]
ITSELF = ["--no-index", "--no-deps", "--no-build-isolation", "--editable", "."]


def install(stamp: str, uv: str | None) -> None:
    if UNFINISHED.exists() or not works(uv):
        print(f"making .venv with Python {sys.version.split()[0]}", flush=True)
        shutil.rmtree(VENV, ignore_errors=True)
        venv = [uv, "venv", "--quiet", "--python", sys.executable] if uv else [sys.executable, "-I", "-m", "venv"]
        run([*venv, str(VENV)], "cannot make .venv")
    UNFINISHED.touch()
    print(f"installing {WANTED[stamp]}", flush=True)
    # pip would compile the modules on one core, also the tests of the packages
    with_pip = [str(PYTHON), "-I", "-m", "pip", "install", "--no-compile"]
    pip = [uv, "pip", "install", "--python", str(PYTHON)] if uv else with_pip
    locks = list(LOCKS.values())[: 1 + list(LOCKS).index(stamp)]
    files = [word for lock in locks for word in ("--requirement", lock)]
    failed = "cannot install the packages (run `make` again to retry)"
    run([*pip, "--quiet", *CHECKED, *files], failed)
    run([*pip, "--quiet", *ITSELF], failed)
    if not uv:
        options = ["-q", "-j", "0", "-x", r"[/\\]tests?[/\\]"]
        compiling = [str(PYTHON), "-I", "-m", "compileall", *options, str(VENV / "lib")]
        subprocess.run(compiling, capture_output=True)  # if a module cannot be compiled, Python says so at its import
    UNFINISHED.unlink()


def set_up(stamp: str) -> None:
    wanted = fingerprint()
    uv = shutil.which("uv")
    check_tools(uv)
    with alone():
        mark = VENV / stamp
        if not (mark.is_file() and mark.read_text() == wanted and works(uv)) or UNFINISHED.exists():
            try:
                install(stamp, uv)
            except Stopped as stopped:
                if not uv or not has_venv():
                    raise
                print(f"{stopped}\ntrying pip instead of uv", flush=True)  # pip may have settings that uv does not use
                install(stamp, None)
        for name in {stamp, ".runtime"}:
            (VENV / name).write_text(wanted)


def main() -> int:
    try:
        set_up(sys.argv[1])
    except Stopped as stopped:
        print(stopped, file=sys.stderr)
        return 1
    except OSError as error:
        print(f"error[cannot-write]: cannot set up .venv: {error.strerror}: {error.filename}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("interrupted; run `make` again", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
