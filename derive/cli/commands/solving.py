"""`derive solve` and `derive explain`: one problem, and one step of it."""

from __future__ import annotations

import argparse
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from derive.cli.output import check_output, deliver
from derive.cli.problem_ids import found_root, problem_id_of, root_with
from derive.cli.running import delivered, waiting
from derive.cli.terminal import complain, table
from derive.errors import Complaint, Misused
from derive.render.formats import TYPESET, formats

if TYPE_CHECKING:
    from derive.course.problem_set import ProblemSet
    from derive.render.rendered import Files, Rendered


def solve(arguments: argparse.Namespace) -> int:
    from derive.building.set_document import problem_document
    from derive.building.solution import rendered
    from derive.building.workers import done, job_of
    from derive.course.names import EvidenceShown
    from derive.course.problem_set import path_of, problem_set

    problem_id, limit = problem_id_of(arguments.id), arguments.time_limit
    root = root_with(arguments, problem_id.partition("/")[0])
    for option, form in (("width", "fragment"), ("engine", "pdf")):
        if getattr(arguments, option) and arguments.format != form:
            message = f"`--{option}` has no effect without `--format {form}`"
            raise Misused(Complaint("usage", message, help="leave it out"))
    check_output(arguments.output, root)
    path_of(root, problem_id)
    set_id, form = problem_id.partition("/")[0], arguments.format
    beside = formats()[form].drawings if form in formats() and arguments.output not in (None, "-") else ""

    def told() -> tuple[Rendered, ProblemSet]:
        heading = problem_set(root, set_id)
        heading = replace(heading, evidence=EvidenceShown(arguments.evidence or heading.evidence))
        draws, evidence = form == "pdf" or bool(beside), heading.evidence
        detail = arguments.detail or heading.detail
        made = partial(rendered, root, problem_id, detail, draws=draws, only=(form,), evidence=evidence)
        return made(width=arguments.width), heading

    with waiting(f"deriving {problem_id}"):
        solved, heading = done(job_of(root, problem_id, told, limit))
    complain(solved.warnings)
    text = solved.texts.get(arguments.format, "")
    if arguments.format in TYPESET:
        text = problem_document(root, solved, heading)
    if arguments.format == "pdf":
        return _solve_pdf(arguments, problem_id, text, solved.files)
    deliver(text.rstrip("\n").encode() + b"\n", arguments.output)
    if beside:
        _deliver_drawings(arguments.output, tuple(file for file in solved.files if file[0].endswith(f".{beside}")))
    return 0


def _deliver_drawings(output: str, files: Files) -> None:
    for name, content in files:
        deliver(content, str(Path(output).parent / name))


def explain(arguments: argparse.Namespace) -> int:
    from derive.building.explain import explain
    from derive.building.workers import done, job_of

    problem_id = problem_id_of(arguments.id)
    root = root_with(arguments, problem_id.partition("/")[0])
    with waiting(f"deriving {problem_id}"):
        work = partial(explain, root, problem_id, arguments.key, arguments.format == "json")
        found = done(job_of(root, problem_id, work, arguments.time_limit))
    print(found if isinstance(found, str) else table(found), flush=True)
    return 0


def _solve_pdf(arguments: argparse.Namespace, problem_id: str, tex: str, files: Files) -> int:
    from derive.building.set_names import set_folder
    from derive.building.standalone import typeset_standalone

    set_id, _, name = problem_id.partition("/")
    suffix = f"-{arguments.detail}" if arguments.detail else ""
    outputs = set_folder(found_root(arguments.root) or Path.cwd(), set_id)  # never in the folder of derive itself
    with waiting(f"typesetting {problem_id}"):
        pdf = typeset_standalone(outputs, name, tex, files, arguments.engine, arguments.time_limit)
    delivered(pdf, arguments.output or str(outputs / f"{name}{suffix}.pdf"))
    return 0
