"""`derive variants`: what varies in the problems of a set, and how their answers are distributed."""

from __future__ import annotations

import argparse
from functools import partial
from typing import TYPE_CHECKING

from derive.cli.problem_ids import problem_id_of, root_of
from derive.cli.running import waiting
from derive.cli.terminal import complain
from derive.errors import Complaint, Misused

if TYPE_CHECKING:
    from derive.building.variant_check import OfProblem


def variants(arguments: argparse.Namespace) -> int:
    from derive.building.variant_check import checked
    from derive.building.workers import done, job_of
    from derive.cli.variant_report import as_html, as_json, as_text
    from derive.course.problem_set import path_of, problem_set

    root, asked = root_of(arguments), problem_id_of(arguments.id)
    if "/" in asked:
        path_of(root, asked)
    ids = [asked] if "/" in asked else list(problem_set(root, asked).problems)
    report: list[OfProblem] = []
    for problem_id in ids:
        with waiting(f"drawing variants of {problem_id}"):
            work = partial(checked, root, problem_id, arguments.check, arguments.seed)
            found = done(job_of(root, problem_id, work, arguments.time_limit))
        if not found.variations:
            continue
        report.append(found)
        if arguments.format == "text":
            print(as_text(found))
        complain(found.complaints)
    if not report:
        message = f"no problem of `{asked}` has `variants:`" if "/" not in asked else f"`{asked}` has no `variants:`"
        raise Misused(Complaint("variants", message, help="such as `variants: {b: 10..30 cm in steps of 2}`"))
    if arguments.format != "text":
        print(as_json(report) if arguments.format == "json" else as_html(root, asked, report))
    return 1 if any(found.complaints for found in report) else 0
