"""`derive check`: derives and verifies problems, and compares them with their references."""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Mapping
from contextlib import nullcontext
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from derive.cli.check_table import check_table
from derive.cli.problem_ids import problem_id_of, root_of, warn_of_names, warn_of_templates
from derive.cli.running import delivered, internal, waiting
from derive.cli.terminal import complain, faults_of_source, note, tell
from derive.errors import DeriveError
from derive.render.formats import TYPESET

if TYPE_CHECKING:
    from derive.building.workers import Outcome


def check(arguments: argparse.Namespace) -> int:
    from derive.building.document_list import list_again
    from derive.building.preload import preload
    from derive.building.set_names import check_asked, set_names
    from derive.building.solution import rendered
    from derive.building.standalone import reports
    from derive.building.workers import Crew, job_of, under_way
    from derive.course.problem_set import ids_in_order

    root = root_of(arguments)
    warn_of_names(root)
    warn_of_templates(root)
    asked = [problem_id_of(name) for name in arguments.ids]
    for set_id, stroke, name in (each.partition("/") for each in asked):
        check_asked(root, set_id, [name] if stroke else ())
    ids = _selected(asked, ids_in_order(root), set_names(root))
    if len(ids) > 1:
        preload(root, derives=True, draws=False)
    wanted = TYPESET if arguments.report else ()
    jobs = {
        job_of(root, problem, partial(rendered, root, problem, only=wanted), arguments.time_limit): problem
        for problem in ids
    }
    outcomes: dict[str, Outcome] = {}
    started = time.monotonic()

    def tick(running: Mapping[str, float]) -> None:
        if not arguments.quiet:
            done = f"{len(outcomes)} of {len(jobs)} checked ({time.monotonic() - started:.0f} s)"
            tell(f"{done}; {under_way(running)}")

    with Crew(arguments.jobs or os.cpu_count() or 1, tick) as crew:
        for job in jobs:
            crew.put(job)
        for outcome in crew.outcomes():
            outcomes[jobs[outcome.job]] = outcome
            if arguments.verbose:
                note("failed" if outcome.error else "checked", jobs[outcome.job], outcome.seconds)
    tell("")
    ordered = [(problem, outcomes[problem]) for problem in ids]
    if not arguments.quiet:
        print(check_table(ordered), flush=True)
    solved = {problem: outcome.value for problem, outcome in ordered if not outcome.error}
    for problem, page in solved.items():
        if page.source_faults and not arguments.quiet:
            print(f"\n{faults_of_source(problem, page.source_faults)}", flush=True)
    code = max([0, *(_verdict_code(outcome) for _, outcome in ordered)])
    if arguments.report:
        with nullcontext() if arguments.quiet else waiting("typesetting the report"):
            written = reports(root, solved, arguments.engine, arguments.time_limit)
        for output, pdf in written.items():
            delivered(pdf, output, arguments.quiet)
            list_again(root, Path(output).parent.name)
    return code


def _selected(asked: list[str], known: list[str], sets: list[str]) -> list[str]:
    """Return the named problems, or all if none is named; the name of a set means all its problems."""
    named = {name: [name] for name in asked} | {name: [p for p in known if p.startswith(f"{name}/")] for name in sets}
    return list(dict.fromkeys(problem for name in asked for problem in named[name])) if asked else known


def _verdict_code(outcome: Outcome) -> int:
    """Return the exit code for this problem, and print its errors and warnings on standard error."""
    if isinstance(outcome.error, DeriveError):
        complain(outcome.error.complaints)
        return outcome.error.exit_code
    if outcome.error:
        internal(str(outcome.error), outcome.error.trace)
        return 1
    complain(outcome.value.warnings)
    return 0 if outcome.value.agreed else 1
