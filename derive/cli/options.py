"""The command line of `derive`: its options. `--help` imports little more than argparse."""

from __future__ import annotations

import argparse
import gc
import os
import sys
from collections.abc import Iterable, Sequence

from derive.course.names import PAPERS
from derive.render.formats import TYPESET, formats

DETAILS = ("brief", "standard", "full")
EVIDENCE = ("none", "end", "margin")
SHELLS = ("bash", "zsh", "fish")
_TIME_LIMIT = 120.0

_AFTERWARDS = """\
example: derive new hw10/wheel --like body, then derive preview hw10/wheel
options: --version, --root FOLDER (that has problems/; default: here or above)
environment: DERIVE_ENGINE, DERIVE_ROOT, DERIVE_MEMORY, DERIVE_DEBUG, NO_COLOR
exit codes: 0 fine, 1 a check or a build failed, 2 wrong usage
"""

_WHERE = """\
Print what has a shell complete names and options. It belongs in
  ~/.bashrc                   eval "$(derive completion bash)"
  ~/.zshrc, behind compinit   eval "$(derive completion zsh)"
  ~/.config/fish/config.fish  derive completion fish | source"""


def main(argv: Sequence[str] | None = None) -> int:
    parser = parser_of_commands()
    if "_ARGCOMPLETE" in os.environ:
        from derive.cli.completing import offer

        offer(parser)
    gc.set_threshold(300_000)  # modules stay: to look for garbage among them took an eighth of their loading
    try:
        from derive.cli.running import exit_code, read
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 130
    return exit_code(read(lambda: parser.parse_args(argv)))


class _Screen(argparse.RawDescriptionHelpFormatter):
    """Help that fits a screen: each option on a line where it can be, and commands without a heading of their own."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, max_help_position=34)

    def add_argument(self, action: argparse.Action) -> None:
        if isinstance(action, argparse._SubParsersAction):
            for each in action._get_subactions():
                super().add_argument(each)
        elif not isinstance(action, argparse._HelpAction):
            super().add_argument(action)


def parser_of_commands() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="derive",
        usage="%(prog)s [--root FOLDER] COMMAND ...   (derive COMMAND --help tells of one)",
        description="Worked solutions of mechanics problems: derived, checked line by line, typeset.",
        epilog=_AFTERWARDS,
        formatter_class=_Screen,
    )
    parser.add_argument("--version", action=_Version, nargs=0, help=argparse.SUPPRESS)
    parser.add_argument("--root", metavar="FOLDER", help=argparse.SUPPRESS)
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True, prog="derive")

    def command(name: str, help: str, operands: str = "", example: str = "") -> argparse.ArgumentParser:
        sub = commands.add_parser(
            name,
            help=help,
            usage=f"derive {name} [options] {operands}".rstrip(),
            description=help[0].upper() + help[1:] + ".",
            epilog=f"example: derive {name} {example}".rstrip(),
            formatter_class=_Screen,
        )
        sub.set_defaults(command=name)
        return sub

    new = command("new", "begin a problem: files that build at once", "SET/PROBLEM", "hw10/wheel --like body")
    named(new.add_argument("id", metavar="SET/PROBLEM", help="what it shall be called; the set may be new too"), "new")
    like = new.add_argument(
        "--like",
        default="system",
        metavar="LIKE",
        help="system (default), body, rotation, script, or a problem: hw9/top",
    )
    named(like, "like")
    preview = command("preview", "show a problem in the browser while you write it", "ID|SET", "hw9/block")
    named(preview.add_argument("id", metavar="ID|SET", help="such as hw9/block; Ctrl-C ends it"), "ids and sets")
    preview.add_argument("--port", type=_port, default=8311, metavar="N", help="of this machine (default 8311; 0: any)")
    preview.add_argument("--open", action="store_true", help="open the browser too")
    build = command("build", "typeset sets of problems; only what changed is done", "[SET|ID ...]", "hw9 --detail full")
    named(build.add_argument("sets", nargs="*", metavar="SET|ID", help="default: every set"), "ids and sets")
    how = build.add_mutually_exclusive_group()
    how.add_argument("--force", action="store_true", help="do everything again")
    how.add_argument("--watch", action="store_true", help="build again at each edit, until Ctrl-C")
    build.add_argument("--only", type=_papers, default=(), metavar="PAPERS", help=", ".join(PAPERS))
    check = command("check", "verify every line, compare with the reference", "[ID|SET ...]", "hw9/block -v")
    named(check.add_argument("ids", nargs="*", metavar="ID|SET", help="default: every problem"), "ids and sets")
    check.add_argument("--report", action="store_true", help="also build/SET/report.pdf: how each was checked")
    solve = command("solve", "derive one problem and show its solution", "ID", "hw9/block --format pdf")
    named(solve.add_argument("id", metavar="ID", help="such as hw9/block"), "ids")
    typed = sorted([*formats(), *TYPESET])
    solve.add_argument("--format", choices=typed, default="text", metavar="F", help=", ".join(typed))
    solve.add_argument("-o", dest="output", metavar="FILE", help="where to write; - is standard output")
    explain = command("explain", "why a line is there, and how it was checked", "ID [STEP]", "hw9/block torque")
    named(explain.add_argument("id", metavar="ID", help="such as hw9/block"), "ids")
    key = explain.add_argument("key", nargs="?", metavar="STEP", help="the key of a step (default: list them)")
    named(key, "steps")
    explain.add_argument("--format", choices=("text", "json"), default="text", help="(default text)")
    diff = command("diff", "what an edit changed since the last build, or a revision", "ID|SET", "hw9/block --rev HEAD")
    named(diff.add_argument("id", metavar="ID|SET", help="such as hw9/block"), "ids and sets")
    diff.add_argument("--rev", metavar="REVISION", help="compare with this revision of git (default: the last build)")
    diff.add_argument("--format", choices=("text", "json"), default="text", help="(default text)")
    why = command("why", "what made a page stale, and what mends it", "FILE|ID|SET", "build/hw9/block.pdf")
    named(why.add_argument("what", metavar="FILE|ID|SET", help="a page below build/, a problem, a set"), "outputs")
    listed = command("list", "list the problems, or what can be asked of one", "[SET|ID]", "hw9/block --answers")
    of = listed.add_argument("set", nargs="?", metavar="SET|ID", help="only those of a set; with --answers, a problem")
    named(of, "ids and sets")
    listed.add_argument("--answers", action="store_true", help="every name that parts of a problem may ask for")
    named(listed.add_argument("--topic", metavar="TOPIC", help="only those of a topic, a folder in a set"), "topics")
    schema = command("schema", "schemas by which editors complete and check", "[SORT]", "problem")
    sorts = ("problem", "set", "reference")
    schema.add_argument("sort", nargs="?", choices=sorts, metavar="SORT", help=f"print one only: {', '.join(sorts)}")
    clean = command("clean", "remove what builds made; what you wrote stays", "[SET ...]", "hw9 --cache")
    named(clean.add_argument("sets", nargs="*", metavar="SET", help="default: every set"), "sets")
    clean.add_argument("--cache", action="store_true", help="only what is kept for the next build; documents stay")
    doctor = command("doctor", "show what a build needs and what is missing", "", "--engine lualatex")
    completion = command("completion", "print what has a shell complete names and options", "SHELL", "fish")
    completion.add_argument("shell", choices=SHELLS, metavar="SHELL", help=", ".join(SHELLS))
    completion.description = _WHERE
    for sub in (solve, diff, build, preview, why):
        sub.add_argument("--detail", choices=DETAILS, help="how much algebra")
    for sub in (solve, build, why):
        sub.add_argument("--evidence", choices=EVIDENCE, help="how much is told of the checks")
    for sub in (solve, check, build, doctor, why):
        sub.add_argument("--engine", metavar="NAME", help="of TeX; `derive doctor` lists them")
    for sub in (solve, explain, diff, check, build, preview, listed):
        sub.add_argument("--time-limit", type=_positive, default=_TIME_LIMIT, metavar="SECONDS", help="for one problem")
    for sub in (check, build):
        sub.add_argument("-j", dest="jobs", type=_count, default=0, metavar="N", help="problems at once")
        told = sub.add_mutually_exclusive_group()
        told.add_argument("-v", "--verbose", action="store_true", help="tell each piece that is done, with its time")
        told.add_argument("-q", "--quiet", action="store_true", help="tell what is wrong, and nothing else")
    preview.add_argument("-q", "--quiet", action="store_true", help="tell the address and what is wrong, nothing else")
    return parser


def named(action: argparse.Action, names: str) -> None:
    """Have a shell complete it by names of the course; which they are, `derive/cli/completing.py` knows."""

    def completer(prefix: str, parsed_args: argparse.Namespace, **_: object) -> Iterable[str]:
        from derive.cli.completing import offered

        return offered(names, prefix, parsed_args.root, getattr(parsed_args, "id", None) or "")

    setattr(action, "completer", completer)  # noqa: B010  where argcomplete looks for it


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
    if odd := [paper for paper in papers if paper not in PAPERS]:
        message = f"there is no paper `{odd[0]}`: name some of {', '.join(PAPERS)}, with commas between them"
        raise argparse.ArgumentTypeError(message)
    return papers


def _port(text: str) -> int:
    if not 0 <= int(text) < 65536:
        raise ValueError(text)
    return int(text)


# argparse names the type in its message
_positive.__name__, _port.__name__ = "time limit", "port"
_count.__name__ = "count"
