"""The command line of `derive`: its commands. `--help` imports little more than argparse."""

from __future__ import annotations

import argparse
import gc
import os
import re
import sys
from collections.abc import Container, Sequence
from typing import NoReturn

# Each command with its purpose, its operands, and an example of operands and options.
_COMMANDS = {
    "init": ("begin a course in a new folder", "FOLDER", "mycourse --title Mechanics"),
    "new": ("begin a problem that you can build at once", "SET/PROBLEM", "hw10/wheel --like library/rod_pendulum"),
    "preview": ("show a problem in the browser while you write it", "ID|SET", "hw9/block"),
    "build": ("typeset sets of problems; unchanged pages are kept", "[SET|ID ...]", "hw9 --detail full"),
    "variants": ("draw variants of problems, and show their answers", "SET|ID", "hw10 --check 1000"),
    "class": ("make a sheet, a key and solutions for each student", "SET", "hw10 --roster students.csv"),
    "export": ("write a set for a learning platform such as Moodle, or for Word", "SET|ID", "hw10 --format qti"),
    "check": ("verify every line, and compare with the reference", "[ID|SET ...]", "hw9/block -v"),
    "audit": ("read a worked document, and find the rows that do not follow", "FILE", "solutions.tex"),
    "grade": (
        "say whether the answers of students are right, and what is wrong",
        "ID|SET [ANSWER]",
        "hw9/block --part b 7/24*M*a^2*w^2",
    ),
    "solve": ("derive one problem and show its solution", "ID", "hw9/block --format pdf"),
    "explain": ("show what a step is derived from, and how it was checked", "ID [STEP]", "hw9/block torque"),
    "diff": ("show what has changed since the last build or a revision", "ID|SET", "hw9/block --rev HEAD"),
    "why": ("show why a page is out of date, and how to update it", "FILE|ID|SET", "build/hw9/block.pdf"),
    "list": ("list the problems, or all answers of one problem", "[SET|ID]", "hw9/block --answers"),
    "schema": ("write the schemas with which editors check your files", "[SORT]", "problem"),
    "clean": ("remove the outputs of builds; your files stay", "[SET ...]", "hw9 --cache"),
    "doctor": ("show what a build needs and what is missing", "", "--engine lualatex"),
    "completion": ("print the script by which a shell completes names", "SHELL", "fish"),
}

# Commands that are rarely needed: one line of the list of commands names them, so that the list fits a screen.
_ALSO = ("why", "schema", "doctor", "clean", "completion")

_AFTERWARDS = """\
also: why (a page is old), schema, doctor (what is missing), clean, completion
example: derive new hw10/wheel --like body, then derive preview hw10/wheel
environment: DERIVE_ENGINE, DERIVE_ROOT, DERIVE_MEMORY, DERIVE_DEBUG, NO_COLOR
options: --version, --root FOLDER; exit codes: 0 fine, 1 failure, 2 wrong usage
"""


def main(argv: Sequence[str] | None = None) -> int:
    words = sys.argv[1:] if argv is None else argv
    if "_ARGCOMPLETE" in os.environ:
        from derive.cli.completing import offer

        offer(parser_of_commands())
    gc.set_threshold(300_000)  # so that little time is spent on collecting garbage while modules are loaded
    try:
        from derive.cli.streams import read

        arguments = read(lambda: parser_of_commands(words).parse_args(words))
        from derive.cli.running import exit_code
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 130
    return exit_code(arguments)


class _Screen(argparse.RawDescriptionHelpFormatter):
    """Help that fits a screen: each option on one line if possible, without `--help` and the commands in `_ALSO`."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, max_help_position=34)

    def add_argument(self, action: argparse.Action) -> None:
        if isinstance(action, argparse._SubParsersAction):
            for each in action._get_subactions():
                if each.dest not in _ALSO:
                    super().add_argument(each)
        elif not isinstance(action, argparse._HelpAction):
            super().add_argument(action)


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        """Say which command or value the user may have meant, and exit."""
        written, _, choices = message.partition(" (choose from ")
        if choices:
            from derive.errors import did_you_mean

            hint = did_you_mean(written.rpartition(" ")[2].strip("'"), re.findall(r"[\w-]+", choices))
            message = f"{message}{f'; {hint}' if hint else ''}"
        super().error(message)


def parser_of_commands(words: Container[str] | None = None) -> argparse.ArgumentParser:
    """Return the parser of all commands; if `words` are given, commands that are not among them get no options."""
    parser = _Parser(
        prog="derive",
        usage="%(prog)s [--root FOLDER] COMMAND ...   (derive COMMAND --help explains it)",
        description="Worked solutions of mechanics problems: derived, checked line by line, typeset.",
        epilog=_AFTERWARDS,
        formatter_class=_Screen,
    )
    parser.add_argument("--version", action=_Version, nargs=0, help=argparse.SUPPRESS)
    parser.add_argument("--root", metavar="FOLDER", help=argparse.SUPPRESS)
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True, prog="derive")
    for name, (help, operands, example) in _COMMANDS.items():
        command = commands.add_parser(
            name,
            help=help,
            usage=f"derive {name} [options] {operands}".rstrip(),
            description=help[0].upper() + help[1:] + ".",
            epilog=f"example: derive {name} {example}",
            formatter_class=_Screen,
        )
        command.set_defaults(command=name)
        if words is None or name in words:
            from derive.cli.command_options import add_options

            add_options(name, command)
    return parser


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from importlib.metadata import PackageNotFoundError, version

        try:
            print(f"derive {version('derive-mechanics')}")
        except PackageNotFoundError:
            print("derive (not installed)")
        parser.exit()
