"""What each command of `derive` does, and how whatever stops it is told."""

from __future__ import annotations

import argparse
import json
import os
import signal
import sys
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, NoReturn

from derive.errors import Complaint, DeriveError, Misused
from derive.terminal import complain, table, tell

if TYPE_CHECKING:
    from derive.build import Report
    from derive.drawn import Files
    from derive.solution import Rendered
    from derive.workers import Outcome

_GRADES = ("proved", "sampled", "definition", "approximation")


def exit_code(arguments: argparse.Namespace) -> int:
    """Carry out a command; whatever stops it is told in a few lines, and is not a traceback."""
    try:
        signal.signal(signal.SIGTERM, _terminated)
        code = _COMMANDS[arguments.command](arguments)
        sys.stdout.flush()
        return code
    except DeriveError as error:
        tell("")
        complain(error.complaints)
        return error.exit_code
    except KeyboardInterrupt:
        tell("")
        print("interrupted", file=sys.stderr)
        return 130
    except BrokenPipeError:
        # Whoever read our output has had enough; the interpreter must not complain about it once more.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return 141
    except Exception as error:
        tell("")
        trace = getattr(error, "trace", None)  # a worker's own
        _internal(str(error) if trace else f"{type(error).__name__}: {error}", trace or traceback.format_exc())
        return 1


def _terminated(number: int, _: FrameType | None) -> NoReturn:
    raise SystemExit(128 + number)  # unwinds, so that no worker is left behind


def _internal(summary: str, trace: str) -> None:
    if os.environ.get("DERIVE_DEBUG"):
        print(trace, file=sys.stderr)
    first = (summary.splitlines() or [""])[0]
    print(f"internal error: {first} (DERIVE_DEBUG=1 shows the traceback)", file=sys.stderr)


def _found_root(named: str | None) -> Path | None:
    """The folder that has `problems`: as named, or here or above, or where derive is developed."""
    asked = named or os.environ.get("DERIVE_ROOT")
    here = Path.cwd()
    candidates = [Path(asked)] if asked else [here, *here.parents, Path(__file__).resolve().parent.parent]
    return next((folder.resolve() for folder in candidates if (folder / "problems").is_dir()), None)


def _root(arguments: argparse.Namespace) -> Path:
    root = _found_root(arguments.root)
    if root is None:
        where = f"in `{arguments.root}`" if arguments.root else "here or above"
        raise Misused(
            Complaint("no-root", f"there is no folder `problems` {where}", help="name its folder with `--root`")
        )
    return root


def _problem_id(text: str) -> str:
    """The id, also where a path was completed by the shell: problems/hw9/block.yaml."""
    return text.removeprefix("./").removeprefix("problems/").removesuffix(".yaml").rstrip("/")


def _list(arguments: argparse.Namespace) -> int:
    from derive.problem import problem_ids
    from derive.solution import headline
    from derive.workers import Job, done

    root = _root(arguments)
    rows = [("problem", "points", "title")]
    for problem_id in problem_ids(root):
        try:
            points, title = done(Job(f"`{problem_id}`", partial(headline, root, problem_id), limit=10))
            rows.append((problem_id, points, title))
        except DeriveError as error:
            rows.append((problem_id, "", f"(does not read: {error.complaints[0].message})"))
    print(table(rows))
    return 0


def _solve(arguments: argparse.Namespace) -> int:
    from derive.set_document import problem_document
    from derive.solution import rendered
    from derive.workers import Job, done

    root, problem_id, limit = _root(arguments), _problem_id(arguments.id), arguments.time_limit
    with _waiting(f"deriving {problem_id}"):
        draws = arguments.format == "pdf"
        work = partial(rendered, root, problem_id, arguments.detail, draws=draws)
        solved: Rendered = done(Job(f"`{problem_id}`", work, limit))
    complain(solved.warnings)
    set_id = problem_id.partition("/")[0]
    if arguments.format == "pdf":
        return _solve_pdf(arguments, root, problem_id, problem_document(root, solved, set_id), solved.files)
    text = solved.text if arguments.format == "text" else solved.json
    if arguments.format == "latex":
        text = problem_document(root, solved, set_id)
    _deliver(text.rstrip("\n").encode() + b"\n", arguments.output)
    return 0


def _solve_pdf(arguments: argparse.Namespace, root: Path, problem_id: str, tex: str, files: Files) -> int:
    from tempfile import TemporaryDirectory

    from derive.build import set_folder
    from derive.output import shown_path
    from derive.render.pdf import chosen_engine, typeset
    from derive.workers import Job, done

    engine, limit = chosen_engine(arguments.engine), arguments.time_limit
    set_id, _, name = problem_id.partition("/")
    suffix = f"-{arguments.detail}" if arguments.detail else ""
    outputs = set_folder(root, set_id)
    with _waiting(f"typesetting {problem_id}"), TemporaryDirectory() as folder:
        target = Path(folder) / f"{name}.pdf"
        work = partial(typeset, tex, target, engine, timeout=limit, log=outputs / "log", beside=files)
        done(Job(f"the pages of `{problem_id}`", work, limit + 10))
        pdf = target.read_bytes()
    output = arguments.output or str(outputs / f"{name}{suffix}.pdf")
    _deliver(pdf, output)
    if output != "-":
        print(f"wrote {shown_path(Path(output))}", file=sys.stderr)
    return 0


def _deliver(content: bytes, output: str | None) -> None:
    from derive.output import write, writing

    path = Path(output or "-")
    if output in (None, "-"):
        # Not sys.stdout.buffer, which under PYTHONUNBUFFERED may write a part and say nothing.
        with open(1, "wb", closefd=False) as out:
            out.write(content)
    elif path.exists() and not path.is_file() and not path.is_dir():
        with writing(path):  # a device or a pipe cannot be replaced
            path.write_bytes(content)
    else:
        write(path, content)


@contextmanager
def _waiting(text: str) -> Iterator[None]:
    tell(text)
    try:
        yield
    finally:
        tell("")


def _check(arguments: argparse.Namespace) -> int:
    from derive.build import set_names
    from derive.problem import problem_ids
    from derive.solution import rendered
    from derive.workers import Crew, Job

    root = _root(arguments)
    ids = _selected([_problem_id(name) for name in arguments.ids], problem_ids(root), set_names(root))
    jobs = {
        Job(f"`{problem}`", partial(rendered, root, problem, None), arguments.time_limit): problem for problem in ids
    }
    outcomes: dict[str, Outcome] = {}
    with Crew(arguments.jobs or os.cpu_count() or 1, lambda running: tell(f"checking {', '.join(running)}")) as crew:
        for job in jobs:
            crew.put(job)
        for outcome in crew.outcomes():
            outcomes[jobs[outcome.job]] = outcome
    tell("")
    ordered = [(problem, outcomes[problem]) for problem in ids]
    heading = ("problem", "steps", *_GRADES, "references", "seconds", "verdict")
    print(table([heading, *(_row(problem, outcome) for problem, outcome in ordered)]), flush=True)
    return max([0, *(_verdict_code(outcome) for _, outcome in ordered)])


def _selected(asked: list[str], known: list[str], sets: list[str]) -> list[str]:
    """Every problem, or those named, where a set stands for its problems."""
    named = {name: [name] for name in asked} | {name: [p for p in known if p.startswith(f"{name}/")] for name in sets}
    return list(dict.fromkeys(problem for name in asked for problem in named[name])) if asked else known


def _row(problem_id: str, outcome: Outcome) -> tuple[str, ...]:
    seconds = f"{outcome.seconds:.1f}"
    if outcome.error:
        codes = dict.fromkeys(c.code for c in getattr(outcome.error, "complaints", ())) or ["internal error"]
        return (problem_id, "", *("" for _ in _GRADES), "", seconds, f"failed: {', '.join(codes)}")
    rendered: Rendered = outcome.value
    facts = json.loads(rendered.json)
    grades = [str(rendered.grades.get(grade, 0)) for grade in _GRADES]
    verdict = "ok" if rendered.agreed else "differs from its reference"
    return (problem_id, str(len(facts["steps"])), *grades, str(len(facts["reference"])), seconds, verdict)


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
    from derive.build import Options, built_set, set_names

    root = _root(arguments)
    options = Options(arguments.engine, arguments.detail, arguments.force, arguments.jobs, arguments.time_limit)
    sets = arguments.sets or set_names(root)
    if not sets:
        raise Misused(
            Complaint("no-such-set", "there is no set to build", help="a set is a folder of `problems` with a set.yaml")
        )
    return max(_reported(built_set(root, _problem_id(name), options, tell)) for name in dict.fromkeys(sets))


def _reported(report: Report) -> int:
    from derive.output import shown_path

    tell("")
    complain([*report.warnings, *report.complaints])
    for bug in report.bugs:
        _internal(str(bug), bug.trace)
    pdfs = [shown_path(path) for path in report.changed if path.suffix == ".pdf"]
    said = f"wrote {', '.join(pdfs)}" if pdfs else "no page changed" if report.derived else "up to date"
    if report.failed:
        said = f"failed; {said if pdfs else 'earlier pages are as they were'}"
    print(
        f"{report.set_id}: derived {report.derived} of {report.problems} problems, {said} ({report.seconds:.1f} s)",
        flush=True,
    )
    return 1 if report.failed else 0


def _doctor(arguments: argparse.Namespace) -> int:
    from derive.doctor import findings

    found = findings(_found_root(arguments.root), arguments.engine)
    for finding in found:
        print(finding.shown())
    return 0 if all(finding.good for finding in found) else 1


_COMMANDS: dict[str, Callable[[argparse.Namespace], int]] = {
    "list": _list,
    "solve": _solve,
    "check": _check,
    "build": _build,
    "doctor": _doctor,
}
