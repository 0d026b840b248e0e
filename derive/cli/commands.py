"""What each command of `derive` does, and how whatever stops it is told."""

from __future__ import annotations

import argparse
import errno
import os
import re
import signal
import sys
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, NoReturn

from derive import FOLDER
from derive.building.files import cannot_write, of_system
from derive.cli.check_table import check_table
from derive.cli.output import check_output, deliver
from derive.cli.terminal import complain, faults_of_source, table, tell
from derive.errors import BuildFailed, Complaint, DeriveError, Misused, did_you_mean
from derive.render.formats import TYPESET

if TYPE_CHECKING:
    from derive.building.sets import Options, Report
    from derive.building.workers import Outcome
    from derive.course.problem_set import ProblemSet
    from derive.render.rendered import Files, Rendered

_REPORT = "   = help: this is a fault of derive: report it with the traceback and the files of the problem"
_UNWRITTEN = {errno.EBADF, errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO}


def exit_code(arguments: argparse.Namespace) -> int:
    """Carry out a command; whatever stops it is told in a few lines, and is not a traceback."""
    try:
        _open_streams()
        signal.signal(signal.SIGTERM, _terminated)
        code = _COMMANDS[arguments.command](arguments)
        sys.stdout.flush()
        return code
    except DeriveError as error:
        return _told(error)
    except KeyboardInterrupt:
        tell("")
        print("interrupted", file=sys.stderr)
        return 130
    except BrokenPipeError:
        # Whoever read our output has had enough; the interpreter must not complain about it once more.
        _silence(1)
        return 141
    except MemoryError:
        return _told(BuildFailed(Complaint("system", "the system refuses: memory is short")))
    except Exception as error:
        if isinstance(error, OSError) and error.filename is None and error.errno in _UNWRITTEN:
            _silence(1)
            return _told(cannot_write(Path("standard output"), error))
        known = of_system(error) if isinstance(error, OSError) else None
        if known:
            return _told(known)
        tell("")
        trace = getattr(error, "trace", None)  # a worker's own
        _internal(str(error) if trace else f"{type(error).__name__}: {error}", trace or traceback.format_exc())
        return 1


def _told(error: DeriveError) -> int:
    tell("")
    complain(error.complaints)
    return error.exit_code


def _silence(descriptor: int) -> None:
    """What is still to be written there goes nowhere."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), descriptor)


def _open_streams() -> None:
    """A standard stream that is closed stays so, but no other file may take its place and be written to."""
    for descriptor, mode in ((0, os.O_RDONLY), (1, os.O_RDONLY), (2, os.O_WRONLY)):
        try:
            os.fstat(descriptor)
        except OSError:
            os.open(os.devnull, mode)  # to write to the second fails, as it should
    sys.stdout = sys.stdout or open(1, "w", closefd=False)  # noqa: SIM115
    sys.stderr = sys.stderr or open(2, "w", closefd=False)  # noqa: SIM115


def _terminated(number: int, _: FrameType | None) -> NoReturn:
    raise SystemExit(128 + number)  # unwinds, so that no worker is left behind


def _internal(summary: str, trace: str) -> None:
    if os.environ.get("DERIVE_DEBUG"):
        print(trace, file=sys.stderr)
    first = (summary.splitlines() or [""])[0]
    print(f"internal error: {first} (DERIVE_DEBUG=1 shows the traceback)\n{_REPORT}", file=sys.stderr)


def _found_root(named: str | None) -> Path | None:
    """The folder that has `problems`: as named, or here or above, or where derive is developed."""
    asked = named or os.environ.get("DERIVE_ROOT")
    try:
        here = Path.cwd()
        candidates = [Path(asked)] if asked else [here, *here.parents, FOLDER.resolve().parent]
        return next((folder.resolve() for folder in candidates if _has_problems(folder)), None)
    except FileNotFoundError:
        message = "the folder that you are in is no more"
        raise Misused(Complaint("no-root", message, help="change to another folder")) from None


def _has_problems(folder: Path) -> bool:
    try:
        return (folder / "problems").is_dir()
    except (OSError, ValueError):  # a name that no folder can have
        return False


def _root(arguments: argparse.Namespace) -> Path:
    root = _found_root(arguments.root)
    if root is None:
        where = f"in `{arguments.root}`" if arguments.root else "here or above"
        raise Misused(
            Complaint("no-root", f"there is no folder `problems` {where}", help="name its folder with `--root`")
        )
    return root


def _problem_id(text: str) -> str:
    """The id, also where a path was completed by the shell: problems/hw9/block.yaml, with a topic or without."""
    text = text.removeprefix("./").removeprefix("problems/").removesuffix(".yaml").rstrip("/")
    return re.sub(r"^([^/]+)/[^/]+/([^/]+)$", r"\1/\2", text)


def _list(arguments: argparse.Namespace) -> int:
    from derive.course.problem_set import problem_paths, topic_of

    root = _root(arguments)
    _warn_of_names(root)
    topics = {problem_id: topic_of(path) for problem_id, path in sorted(problem_paths(root).items())}
    if arguments.topic and arguments.topic not in topics.values():
        known = sorted({topic for topic in topics.values() if topic})
        help_line = did_you_mean(arguments.topic, known) or f"the topics are {', '.join(known) or 'none'}"
        raise Misused(Complaint("no-such-topic", f"there is no topic `{arguments.topic}`", help=help_line))
    ids = [problem for problem, topic in topics.items() if arguments.topic in (None, topic)]
    found = ((problem, topics[problem], *told) for problem, told in zip(ids, _headlines(root, ids), strict=True))
    rows = [("problem", "topic", "points", "title"), *found]
    without = [(row[0], *row[2:]) for row in rows]
    print(table(rows if any(topics.values()) else without))
    return 0


def _headlines(root: Path, ids: Sequence[str]) -> list[tuple[str, str]]:
    """The points and title of each problem, read by one worker; if it comes to no end, each half by one of its own."""
    from derive.building.headline import headline
    from derive.building.workers import done, job_of

    def told(problem_id: str) -> tuple[str, str]:
        try:
            return headline(root, problem_id)
        except DeriveError as error:
            return _does_not_read(error)

    half = len(ids) // 2
    try:
        return done(job_of(root, ids[0], lambda: [told(each) for each in ids], limit=10)) if ids else []
    except DeriveError as error:
        return [*_headlines(root, ids[:half]), *_headlines(root, ids[half:])] if half else [_does_not_read(error)]


def _does_not_read(error: DeriveError) -> tuple[str, str]:
    return "", f"(does not read: {error.complaints[0].message})"


def _warn_of_names(root: Path) -> None:
    from derive.building.named import misnamed_sets

    complain(misnamed_sets(root))


def _solve(arguments: argparse.Namespace) -> int:
    from derive.building.set_document import problem_document
    from derive.building.solution import rendered
    from derive.building.workers import done, job_of
    from derive.course.names import EvidenceShown
    from derive.course.problem_set import problem_set

    root, problem_id, limit = _root(arguments), _problem_id(arguments.id), arguments.time_limit
    check_output(arguments.output, root)
    set_id, form = problem_id.partition("/")[0], arguments.format

    def told() -> tuple[Rendered, ProblemSet]:
        heading = problem_set(root, set_id)
        heading = replace(heading, evidence=EvidenceShown(arguments.evidence or heading.evidence))
        options = {"draws": form == "pdf", "only": (form,), "evidence": heading.evidence}
        return rendered(root, problem_id, arguments.detail, **options), heading

    with _waiting(f"deriving {problem_id}"):
        solved, heading = done(job_of(root, problem_id, told, limit))
    complain(solved.warnings)
    text = solved.texts.get(arguments.format, "")
    if arguments.format in TYPESET:
        text = problem_document(root, solved, heading)
    if arguments.format == "pdf":
        return _solve_pdf(arguments, root, problem_id, text, solved.files)
    deliver(text.rstrip("\n").encode() + b"\n", arguments.output)
    return 0


def _explain(arguments: argparse.Namespace) -> int:
    from derive.building.explained import explained
    from derive.building.workers import done, job_of

    root, problem_id = _root(arguments), _problem_id(arguments.id)
    with _waiting(f"deriving {problem_id}"):
        work = partial(explained, root, problem_id, arguments.key, arguments.format == "json")
        found = done(job_of(root, problem_id, work, arguments.time_limit))
    print(found if isinstance(found, str) else table(found), flush=True)
    return 0


def _solve_pdf(arguments: argparse.Namespace, root: Path, problem_id: str, tex: str, files: Files) -> int:
    from derive.building.alone import typeset_alone
    from derive.building.named import set_folder

    set_id, _, name = problem_id.partition("/")
    suffix = f"-{arguments.detail}" if arguments.detail else ""
    outputs = set_folder(root, set_id)
    with _waiting(f"typesetting {problem_id}"):
        pdf = typeset_alone(outputs, name, tex, files, arguments.engine, arguments.time_limit)
    _delivered(pdf, arguments.output or str(outputs / f"{name}{suffix}.pdf"))
    return 0


def _delivered(pdf: bytes, output: str) -> None:
    from derive.building.files import shown_path

    deliver(pdf, output)
    if output != "-":
        print(f"wrote {shown_path(Path(output))}", file=sys.stderr)


@contextmanager
def _waiting(text: str) -> Iterator[None]:
    tell(text)
    try:
        yield
    finally:
        tell("")


def _check(arguments: argparse.Namespace) -> int:
    from derive.building.alone import reports
    from derive.building.loaded import load
    from derive.building.named import set_names
    from derive.building.solution import rendered
    from derive.building.workers import Crew, job_of
    from derive.course.problem_set import ids_in_order

    root = _root(arguments)
    _warn_of_names(root)
    ids = _selected([_problem_id(name) for name in arguments.ids], ids_in_order(root), set_names(root))
    if len(ids) > 1:
        load(root, draws=False)
    wanted = TYPESET if arguments.report else ()
    jobs = {
        job_of(root, problem, partial(rendered, root, problem, only=wanted), arguments.time_limit): problem
        for problem in ids
    }
    outcomes: dict[str, Outcome] = {}
    with Crew(arguments.jobs or os.cpu_count() or 1, lambda running: tell(f"checking {', '.join(running)}")) as crew:
        for job in jobs:
            crew.put(job)
        for outcome in crew.outcomes():
            outcomes[jobs[outcome.job]] = outcome
    tell("")
    ordered = [(problem, outcomes[problem]) for problem in ids]
    print(check_table(ordered), flush=True)
    solved = {problem: outcome.value for problem, outcome in ordered if not outcome.error}
    for problem, page in solved.items():
        if page.source_faults:
            print(f"\n{faults_of_source(problem, page.source_faults)}", flush=True)
    code = max([0, *(_verdict_code(outcome) for _, outcome in ordered)])
    if arguments.report:
        with _waiting("typesetting the report"):
            written = reports(root, solved, arguments.engine, arguments.time_limit)
        for output, pdf in written.items():
            _delivered(pdf, output)
    return code


def _selected(asked: list[str], known: list[str], sets: list[str]) -> list[str]:
    """Every problem, or those named, where a set stands for its problems."""
    named = {name: [name] for name in asked} | {name: [p for p in known if p.startswith(f"{name}/")] for name in sets}
    return list(dict.fromkeys(problem for name in asked for problem in named[name])) if asked else known


def _verdict_code(outcome: Outcome) -> int:
    """The exit code that this problem asks for; says on standard error what was wrong."""
    if isinstance(outcome.error, DeriveError):
        complain(outcome.error.complaints)
        return outcome.error.exit_code
    if outcome.error:
        _internal(str(outcome.error), outcome.error.trace)
        return 1
    complain(outcome.value.warnings)
    return 0 if outcome.value.agreed else 1


def _build(arguments: argparse.Namespace) -> int:
    from derive.building.named import set_names
    from derive.building.sets import Options, built_set

    root = _root(arguments)
    if not arguments.sets:
        _warn_of_names(root)
    options = Options(
        arguments.engine,
        arguments.detail,
        arguments.force,
        arguments.jobs,
        arguments.time_limit,
        evidence=arguments.evidence,
    )
    asked = _sets_asked(arguments.sets or set_names(root))
    if not asked:
        raise Misused(
            Complaint("no-such-set", "there is no set to build", help="a set is a folder of `problems` with a set.yaml")
        )
    if arguments.watch:
        return _watched(root, asked, options)
    return max(_reported(built_set(root, name, replace(options, only=only), tell)) for name, only in asked.items())


def _sets_asked(asked: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """The sets by name, and those of their problems that are asked for; none if that is all of them."""
    found: dict[str, dict[str, None]] = {}
    for set_id, _, name in (_problem_id(each).partition("/") for each in asked):
        found.setdefault(set_id, {})[name] = None
    return {set_id: () if "" in names else tuple(names) for set_id, names in found.items()}


def _watched(root: Path, asked: Mapping[str, tuple[str, ...]], options: Options) -> int:
    """Builds at each edit until somebody interrupts, which is its only end and no failure."""
    from derive.building.files import shown_path
    from derive.building.watch import Shown, watch

    failed: dict[str, bool] = {}  # if a set that failed is as it was before, that is news

    def wrote(path: Path, seconds: float) -> None:
        tell("")
        print(f"wrote {shown_path(path)} ({seconds:.1f} s)", flush=True)

    def built(report: Report) -> None:
        if report.derived or report.changed or report.failed or failed.get(report.set_id, True):
            _reported(report)
        failed[report.set_id] = report.failed

    def refused(complaints: Sequence[Complaint]) -> None:
        tell("")
        complain(complaints)

    with suppress(KeyboardInterrupt):
        watch(root, asked, options, Shown(tell, wrote, built, refused))
    tell("")
    return 0


def _preview(arguments: argparse.Namespace) -> int:
    """A page served until somebody interrupts, which is its only end and no failure."""
    from derive.preview.asking import Shown
    from derive.preview.preview import preview

    set_id, _, name = _problem_id(arguments.id).partition("/")

    def ready(address: str) -> None:
        print(f"{address} (Ctrl-C ends it)", flush=True)
        if arguments.open:
            import webbrowser

            webbrowser.open(address)

    def told(of: str, shown: Shown) -> None:
        said = "shown" if shown.main else "not shown: "
        print(
            f"{set_id}/{of}: {said if shown.main else said + shown.complaints[0]} ({shown.seconds:.2f} s)", flush=True
        )

    with suppress(KeyboardInterrupt):
        preview(_root(arguments), set_id, name, arguments.port, arguments.detail, arguments.time_limit, ready, told)
    return 0


def _reported(report: Report) -> int:
    from derive.building.files import shown_path

    tell("")
    complain([*report.warnings, *report.complaints])
    for bug in report.bugs:
        _internal(str(bug), bug.trace)
    pdfs = [shown_path(path) for path in report.changed if path.suffix == ".pdf"]
    said = f"wrote {_listed(pdfs)}" if pdfs else "no page changed" if report.derived else "up to date"
    if report.failed:
        said = f"failed; {said if pdfs else 'earlier pages are as they were'}"
    print(
        f"{report.set_id}: derived {report.derived} of {report.problems} problems, {said} ({report.seconds:.1f} s)",
        flush=True,
    )
    return 1 if report.failed else 0


def _listed(paths: Sequence[str], most: int = 12) -> str:
    """The last ones, which are those of the whole set, and how many others."""
    if len(paths) <= most:
        return ", ".join(paths)
    last = paths[-3:]
    return f"{', '.join(last)} and {len(paths) - len(last)} others beside {'them' if len(last) > 1 else 'it'}"


def _clean(arguments: argparse.Namespace) -> int:
    from derive.building.cleaning import cleaned
    from derive.building.files import shown_path

    sets = [name.removeprefix("build/").rstrip("/") for name in arguments.sets]
    for folder, size in cleaned(_root(arguments), sets, arguments.cache, lambda name: tell(f"waiting for `{name}`")):
        tell("")
        print(f"removed {shown_path(folder)} ({size / 1e6:.1f} MB)")
    return 0


def _doctor(arguments: argparse.Namespace) -> int:
    from derive.building.doctor import findings

    found = findings(_found_root(arguments.root), arguments.engine)
    for finding in found:
        print(finding.shown())
    return 0 if all(finding.good for finding in found) else 1


_COMMANDS: dict[str, Callable[[argparse.Namespace], int]] = {
    "list": _list,
    "solve": _solve,
    "explain": _explain,
    "check": _check,
    "build": _build,
    "clean": _clean,
    "preview": _preview,
    "doctor": _doctor,
}
