"""The operands and options of each command."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable, Iterable
from contextlib import suppress
from typing import Any

from derive.course.names import DOCUMENTS
from derive.render.formats import TYPESET, formats

DETAILS = ("brief", "standard", "full")
EVIDENCE = ("none", "end", "margin")
SHELLS = ("bash", "zsh", "fish")
_TIME_LIMIT = 120.0
_IN_CM = {"cm": 1.0, "mm": 0.1, "in": 2.54, "pt": 2.54 / 72.27}

_WHERE = """\
Print the script by which a shell completes names and options.
To use it, add the line for your shell to the file on the left:
  ~/.bashrc                   eval "$(derive completion bash)"
  ~/.zshrc, after compinit    eval "$(derive completion zsh)"
  ~/.config/fish/config.fish  derive completion fish | source"""


def add_options(name: str, command: argparse.ArgumentParser) -> None:
    """Give the parser of a command its operands and options."""
    _OPTIONS[name](command)


# --- each command -----------------------------------------------------------------------------------------------------


def _init(init: argparse.ArgumentParser) -> None:
    init.add_argument("folder", metavar="FOLDER", help="a new or empty folder; . is the working folder")
    init.add_argument("--title", default="Mechanics", metavar="TITLE", help="name of the course (default Mechanics)")


def _new(new: argparse.ArgumentParser) -> None:
    named(new.add_argument("id", metavar="SET/PROBLEM", help="name of the problem; its set may be new"), "new")
    like = new.add_argument(
        "--like",
        default="system",
        metavar="LIKE",
        help="system (default), body, rotation, script, or a problem: library/bead",
    )
    named(like, "like")


def _preview(preview: argparse.ArgumentParser) -> None:
    named(preview.add_argument("id", metavar="ID|SET", help="such as hw9/block; end with Ctrl-C"), "ids and sets")
    preview.add_argument("--port", type=_port, default=8311, metavar="N", help="port to use (default 8311; 0: any)")
    preview.add_argument("--open", action="store_true", help="open the browser too")
    _detail(preview)
    _time_limit(preview)
    preview.add_argument("-q", "--quiet", action="store_true", help="show only the address and errors")


def _build(build: argparse.ArgumentParser) -> None:
    named(build.add_argument("sets", nargs="*", metavar="SET|ID", help="default: every set"), "ids and sets")
    how = build.add_mutually_exclusive_group()
    how.add_argument("--force", action="store_true", help="do everything again")
    how.add_argument("--watch", action="store_true", help="build again at each edit, until Ctrl-C")
    build.add_argument("--only", type=_documents, default=(), metavar="DOCUMENTS", help=", ".join(DOCUMENTS))
    _detail(build)
    _evidence(build)
    _engine(build)
    _time_limit(build)
    _jobs_and_messages(build)


def _variants(variants: argparse.ArgumentParser) -> None:
    named(variants.add_argument("id", metavar="SET|ID", help="a set, or one problem"), "ids and sets")
    variants.add_argument("--check", type=_count, default=100, metavar="N", help="draw N variants (default 100)")
    variants.add_argument("--seed", default="", metavar="TEXT", help="the seed of `derive class`")
    variants.add_argument("--format", choices=("text", "json", "html"), default="text", help="html has histograms")
    _time_limit(variants)


def _class(of_class: argparse.ArgumentParser) -> None:
    named(of_class.add_argument("set", metavar="SET", help="a set with `variants:` in its problems"), "sets")
    of_class.add_argument(
        "--roster", required=True, metavar="FILE", help="CSV with a column `name` and, if you like, `code`"
    )
    of_class.add_argument("--seed", metavar="TEXT", help="text that determines the variants; kept for later runs")
    of_class.add_argument("--reseed", action="store_true", help="replace a class that was made with a different seed")
    of_class.add_argument("--scheduler", default="", metavar="ADDRESS", help="of a Dask cluster: tcp://10.0.0.1:8786")
    _engine(of_class)
    _time_limit(of_class, "processor time of the documents of one student")
    _jobs_and_messages(of_class, "jobs at once, each for up to ten students")


def _export(export: argparse.ArgumentParser) -> None:
    named(export.add_argument("id", metavar="SET|ID", help="a set, or one problem"), "ids and sets")
    known = ("moodle", "stack", "qti", "canvas", "prairielearn", "docx")
    told = "default moodle; stack: Moodle with STACK; qti: QTI 2.1; canvas: QTI 1.2"
    export.add_argument("--format", choices=known, default="moodle", help=told)
    export.add_argument("-o", dest="output", metavar="FILE", help="file to write; - is standard output")
    _time_limit(export)


def _check(check: argparse.ArgumentParser) -> None:
    named(check.add_argument("ids", nargs="*", metavar="ID|SET", help="default: every problem"), "ids and sets")
    check.add_argument("--report", action="store_true", help="also make build/SET/report.pdf")
    _engine(check)
    _time_limit(check)
    _jobs_and_messages(check)


def _audit(audit: argparse.ArgumentParser) -> None:
    audit.add_argument("file", metavar="FILE", help="a .tex, .md, .ipynb or .txt file")
    audit.add_argument("--format", choices=("text", "json", "html"), default="text", help="(default text)")
    audit.add_argument("-v", "--verbose", action="store_true", help="show every row, not only probable slips")
    compared = audit.add_argument(
        "--problem", action="append", default=[], metavar="ID", help="compare with this problem (may be repeated)"
    )
    named(compared, "ids")
    audit.add_argument(
        "--assume", action="append", default=[], metavar="EQUATION", help='such as "rho = M/(6 a^3)" (may be repeated)'
    )
    audit.add_argument("--symbols", metavar="FILE", help="YAML file with kinds of letters: `omega: vector`")
    _time_limit(audit, "with --problem, processor time of one problem")


def _grade(grade: argparse.ArgumentParser) -> None:
    named(
        grade.add_argument("id", metavar="ID|SET", help="such as hw9/block; a set only with --answers"), "ids and sets"
    )
    grade.add_argument("answer", nargs="?", metavar="ANSWER", help="a formula, or a number with its unit")
    grade.add_argument("--part", metavar="PART", help="such as b; b(2) is its second answer")
    grade.add_argument("--answers", metavar="FILE", help="CSV with the columns student, problem, part, answer")
    grade.add_argument("--student", metavar="CODE", help="a student of `derive class`, whose variant is used")
    grade.add_argument("--roster", metavar="FILE", help="the roster of a class that was made on another machine")
    grade.add_argument("--seed", metavar="TEXT", help="with --roster, the seed of this class")
    grade.add_argument("-o", "--output", dest="output", metavar="FILE", help="file to write; - is standard output")
    told = "(default text; csv with --answers and -o FILE)"
    grade.add_argument("--format", choices=("text", "json", "csv"), help=told)
    _time_limit(grade)
    grade.add_argument("-j", dest="jobs", type=_count, default=0, metavar="N", help="problems at once")
    grade.add_argument("-q", "--quiet", action="store_true", help="show only errors and warnings")
    _with_answer(grade)


def _with_answer(grade: argparse.ArgumentParser) -> None:
    """Let the answer begin with a minus sign: argparse would take `-omega^2` for an option."""
    options = {name: action for action in grade._actions for name in action.option_strings}
    parse = grade.parse_known_args

    def parse_known_args(args: Any = None, namespace: Any = None) -> Any:
        words, positions, at = list(args or ()), [], 0
        while at < len(words):
            word = words[at]
            if word in options:
                at += 1 if options[word].nargs == 0 else 2
                continue
            if word != "--" and not word.startswith("--") and not re.fullmatch(r"-j\d+", word):
                positions.append(at)
            at += 1
        if len(positions) != 2:
            return parse(words, namespace)
        answer = words.pop(positions[1])
        found, others = parse([each for each in words if each != "--"], namespace)
        found.answer = answer
        return found, others

    grade.parse_known_args = parse_known_args  # type: ignore[method-assign]


def _solve(solve: argparse.ArgumentParser) -> None:
    named(solve.add_argument("id", metavar="ID", help="such as hw9/block"), "ids")
    typed = sorted([*formats(), *TYPESET])
    solve.add_argument("--format", choices=typed, default="text", metavar="F", help=", ".join(typed))
    solve.add_argument("-o", dest="output", metavar="FILE", help="file to write; - is standard output")
    solve.add_argument("--width", metavar="LENGTH", type=_width, help="text width for a fragment, such as 10.8cm")
    _detail(solve)
    _evidence(solve)
    _engine(solve)
    _time_limit(solve)


def _explain(explain: argparse.ArgumentParser) -> None:
    named(explain.add_argument("id", metavar="ID", help="such as hw9/block"), "ids")
    key = explain.add_argument("key", nargs="?", metavar="STEP", help="the key of a step (default: list all steps)")
    named(key, "steps")
    _text_or_json(explain)
    _time_limit(explain)


def _diff(diff: argparse.ArgumentParser) -> None:
    named(diff.add_argument("id", metavar="ID|SET", help="such as hw9/block"), "ids and sets")
    diff.add_argument("--rev", metavar="REVISION", help="compare with this revision of git (default: the last build)")
    _text_or_json(diff)
    _detail(diff)
    _time_limit(diff)


def _why(why: argparse.ArgumentParser) -> None:
    named(why.add_argument("what", metavar="FILE|ID|SET", help="a page below build/, a problem, a set"), "outputs")
    _detail(why)
    _evidence(why)
    _engine(why)


def _list(listed: argparse.ArgumentParser) -> None:
    of = listed.add_argument("set", nargs="?", metavar="SET|ID", help="only this set; with --answers, one problem")
    named(of, "ids and sets")
    listed.add_argument("--answers", action="store_true", help="list all names that a problem's parts may ask for")
    named(listed.add_argument("--topic", metavar="TOPIC", help="only this topic, which is a folder in a set"), "topics")
    _time_limit(listed)


def _schema(schema: argparse.ArgumentParser) -> None:
    sorts = ("problem", "set", "course", "reference")
    schema.add_argument("sort", nargs="?", choices=sorts, metavar="SORT", help=f"print one only: {', '.join(sorts)}")


def _clean(clean: argparse.ArgumentParser) -> None:
    named(clean.add_argument("sets", nargs="*", metavar="SET", help="default: every set"), "sets")
    clean.add_argument("--cache", action="store_true", help="remove only data stored for the next build")


def _completion(completion: argparse.ArgumentParser) -> None:
    completion.add_argument("shell", choices=SHELLS, metavar="SHELL", help=", ".join(SHELLS))
    completion.description = _WHERE


# --- options of several commands --------------------------------------------------------------------------------------


def _detail(command: argparse.ArgumentParser) -> None:
    command.add_argument("--detail", choices=DETAILS, help="how much algebra to show")


def _evidence(command: argparse.ArgumentParser) -> None:
    command.add_argument("--evidence", choices=EVIDENCE, help="how much of the checks to show")


def _engine(command: argparse.ArgumentParser) -> None:
    command.add_argument("--engine", metavar="NAME", help="TeX engine; `derive doctor` lists those it finds")


def _time_limit(command: argparse.ArgumentParser, told: str = "processor time of one problem") -> None:
    command.add_argument("--time-limit", type=_positive, default=_TIME_LIMIT, metavar="SECONDS", help=told)


def _text_or_json(command: argparse.ArgumentParser) -> None:
    command.add_argument("--format", choices=("text", "json"), default="text", help="(default text)")


def _jobs_and_messages(command: argparse.ArgumentParser, of_jobs: str = "problems at once") -> None:
    command.add_argument("-j", dest="jobs", type=_count, default=0, metavar="N", help=of_jobs)
    told = command.add_mutually_exclusive_group()
    told.add_argument("-v", "--verbose", action="store_true", help="show each finished job, with its time")
    told.add_argument("-q", "--quiet", action="store_true", help="show only errors and warnings")


_OPTIONS: dict[str, Callable[[argparse.ArgumentParser], None]] = {
    "init": _init,
    "new": _new,
    "preview": _preview,
    "build": _build,
    "variants": _variants,
    "class": _class,
    "export": _export,
    "check": _check,
    "audit": _audit,
    "grade": _grade,
    "solve": _solve,
    "explain": _explain,
    "diff": _diff,
    "why": _why,
    "list": _list,
    "schema": _schema,
    "clean": _clean,
    "doctor": _engine,
    "completion": _completion,
}

# --- allowed values of options ----------------------------------------------------------------------------------------


def named(action: argparse.Action, names: str) -> None:
    """Let the shell complete an operand or option with names from the course."""

    def completer(prefix: str, parsed_args: argparse.Namespace, **_: object) -> Iterable[str]:
        from derive.cli.completing import offered

        return offered(names, prefix, parsed_args.root, getattr(parsed_args, "id", None) or "")

    setattr(action, "completer", completer)  # noqa: B010  argcomplete reads this attribute


def _positive(text: str) -> float:
    with suppress(ValueError):
        if 0 < (seconds := float(text)) < 1e6:
            return seconds
    raise argparse.ArgumentTypeError(f"`{text}` is not a positive time in seconds below 1000000, such as 60")


def _count(text: str) -> int:
    if not re.fullmatch("0*[1-9][0-9]{0,8}", text):
        raise argparse.ArgumentTypeError(f"`{text}` is not a whole number from 1 to 999999999, such as 4")
    return int(text)


def _documents(text: str) -> tuple[str, ...]:
    documents = tuple(text.split(","))
    if odd := [kind for kind in documents if kind not in DOCUMENTS]:
        message = f"`{odd[0]}` is not a document: choose from {', '.join(DOCUMENTS)}, and put commas between several"
        raise argparse.ArgumentTypeError(message)
    return documents


def _width(text: str) -> float:
    found = re.fullmatch(r"([\d.]+)\s*(cm|mm|in|pt)", text)
    width = float(found[1]) * _IN_CM[found[2]] if found else 0.0
    if not 4 <= width <= 40:
        raise argparse.ArgumentTypeError(f"`{text}` is not a width from 4 cm to 40 cm, such as 10.8cm, 4.5in or 300pt")
    return width


def _port(text: str) -> int:
    if not re.fullmatch("[0-9]{1,5}", text) or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"`{text}` is not a port, which is a whole number from 0 to 65535")
    return int(text)
