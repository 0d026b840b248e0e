"""The command line of `derive`: its options. `--help` imports little more than argparse."""

from __future__ import annotations

import argparse
import gc
import sys
from collections.abc import Sequence

from derive.course.names import PAPERS
from derive.render.formats import TYPESET, formats

DETAILS = ("brief", "standard", "full")
EVIDENCE = ("none", "end", "margin")
_TIME_LIMIT = 120.0

_ENVIRONMENT = """\
environment:
  DERIVE_ENGINE  the TeX engine, as --engine
  DERIVE_ROOT    the folder that has problems/, as --root
  DERIVE_MEMORY  how many GiB one problem may take (default 4)
  DERIVE_DEBUG   1 shows the traceback of an internal error
  NO_COLOR       anything turns colours off

exit codes: 0 fine, 1 a check or a build failed, 2 wrong usage
"""


def main(argv: Sequence[str] | None = None) -> int:
    arguments = _parser().parse_args(argv)
    gc.set_threshold(300_000)  # modules stay: to look for garbage among them took an eighth of their loading
    try:
        from derive.cli.running import exit_code
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 130
    return exit_code(arguments)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="derive",
        description="Worked solutions of mechanics problems: derived, checked line by line, typeset.",
        epilog=_ENVIRONMENT,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="show the version and exit")
    parser.add_argument("--root", metavar="FOLDER", help="the folder that has problems/ (default: here or above)")
    commands = parser.add_subparsers(metavar="COMMAND", required=True)

    def command(name: str, help: str) -> argparse.ArgumentParser:
        sub = commands.add_parser(name, help=help, description=help[0].upper() + help[1:] + ".")
        sub.set_defaults(command=name)
        return sub

    listed = command("list", "list the problems")
    listed.add_argument("--topic", metavar="TOPIC", help="only those of a topic, a folder within a set")
    solve = command("solve", "derive one problem and show its solution")
    solve.add_argument("id", metavar="ID", help="such as hw9/block")
    solve.add_argument("--format", choices=sorted([*formats(), *TYPESET]), default="text")
    solve.add_argument("-o", dest="output", metavar="FILE", help="where to write; - is standard output")
    explain = command("explain", "tell of one line why it is there, how it was checked, and how to change it")
    explain.epilog = "example: derive explain hw9/block torque"
    explain.add_argument("id", metavar="ID", help="such as hw9/block")
    explain.add_argument("key", nargs="?", metavar="STEP", help="the key of a step (default: list them)")
    explain.add_argument("--format", choices=("text", "json"), default="text")
    diff = command("diff", "tell what an edit changed, since the last build or a revision of git")
    diff.epilog = "example: derive diff hw9/block --rev HEAD; exit codes: 0 the same, 1 changed, 2 cannot compare"
    diff.add_argument("id", metavar="ID", help="such as hw9/block")
    diff.add_argument("--rev", metavar="REVISION", help="compare with this revision of git (default: the last build)")
    diff.add_argument("--format", choices=("text", "json"), default="text")
    check = command("check", "derive problems, verify every line, compare with the reference")
    check.add_argument("ids", nargs="*", metavar="ID|SET", help="default: every problem")
    check.add_argument(
        "--report", action="store_true", help="also write build/SET/report.pdf: how each step was checked"
    )
    build = command("build", "typeset sets of problems; only what changed is done again")
    build.add_argument("sets", nargs="*", metavar="SET|ID", help="default: every set")
    how = build.add_mutually_exclusive_group()
    how.add_argument("--force", action="store_true", help="do everything again")
    how.add_argument("--watch", action="store_true", help="build again at each edit, until Ctrl-C")
    build.add_argument("--only", type=_papers, default=(), metavar="PAPERS", help=f"of {', '.join(PAPERS)}")
    preview = command("preview", "show a problem in the browser while you write it, until Ctrl-C")
    preview.epilog = "example: derive preview hw9/block"
    preview.add_argument("id", metavar="ID|SET", help="such as hw9/block")
    preview.add_argument("--port", type=_port, default=8311, metavar="N", help="of this machine (default 8311; 0: any)")
    preview.add_argument("--open", action="store_true", help="open the browser too")
    new = command("new", "begin a problem: files that build at once")
    new.epilog = "example: derive new hw10/wheel --like body"
    new.add_argument("id", metavar="SET/PROBLEM", help="what it shall be called; the set may be new too")
    new.add_argument(
        "--like",
        default="system",
        metavar="LIKE",
        help="system (default), body, rotation, script, or a problem: hw9/top",
    )
    schema = command("schema", "write the JSON schemas by which editors complete and check what you write")
    schema.add_argument("sort", nargs="?", choices=("problem", "set", "reference"), help="print this one only")
    clean = command("clean", "remove what builds made; what you wrote stays")
    clean.add_argument("sets", nargs="*", metavar="SET", help="default: every set")
    clean.add_argument("--cache", action="store_true", help="only what is kept for the next build; documents stay")
    doctor = command("doctor", "show what a build needs and what is missing")
    for sub in (solve, diff, build, preview):
        sub.add_argument("--detail", choices=DETAILS, help="how much algebra to show")
    for sub in (solve, build):
        sub.add_argument(
            "--evidence", choices=EVIDENCE, help="how much to tell of the checks (default: as set.yaml says)"
        )
    for sub in (solve, check, build, doctor):
        sub.add_argument("--engine", metavar="NAME", help="tinytex (default), latexmk, pdflatex, lualatex or tectonic")
    for sub in (solve, explain, diff, check, build, preview):
        sub.add_argument("--time-limit", type=_positive, default=_TIME_LIMIT, metavar="SECONDS", help="for one problem")
    for sub in (check, build):
        sub.add_argument("-j", dest="jobs", type=_count, default=0, metavar="N", help="problems at once")
    return parser


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from importlib.metadata import PackageNotFoundError, version

        try:
            print(f"derive {version('derive')}")
        except PackageNotFoundError:
            print("derive (not installed)")
        parser.exit()


def _positive(text: str) -> float:
    seconds = float(text)
    if not 0 < seconds < float("inf"):
        raise ValueError(text)
    return seconds


def _count(text: str) -> int:
    if int(text) < 1:
        raise ValueError(text)
    return int(text)


def _papers(text: str) -> tuple[str, ...]:
    papers = tuple(text.split(","))
    if not set(papers) <= set(PAPERS):
        raise ValueError(text)
    return papers


def _port(text: str) -> int:
    if not 0 <= int(text) < 65536:
        raise ValueError(text)
    return int(text)


# argparse names the type in its message
_positive.__name__, _port.__name__ = "time limit", "port"
_count.__name__, _papers.__name__ = "count", "list of papers"
