"""`derive variants`: what varies in the problems of a set, and how their answers are distributed."""

from __future__ import annotations

import argparse
from functools import partial
from typing import TYPE_CHECKING

from derive.cli.asked import problem_id_of, root_of
from derive.cli.running import waiting
from derive.cli.terminal import complain, table
from derive.errors import Complaint, Misused

if TYPE_CHECKING:
    from derive.building.variant_check import OfProblem


def variants(arguments: argparse.Namespace) -> int:
    from derive.building.variant_check import checked
    from derive.building.workers import done, job_of
    from derive.course.problem_set import path_of, problem_set

    root, asked = root_of(arguments), problem_id_of(arguments.id)
    if "/" in asked:
        path_of(root, asked)
    ids = [asked] if "/" in asked else list(problem_set(root, asked).problems)
    failed, any_varies = False, False
    for problem_id in ids:
        with waiting(f"drawing variants of {problem_id}"):
            work = partial(checked, root, problem_id, arguments.check, arguments.seed)
            found = done(job_of(root, problem_id, work, arguments.time_limit))
        if not found.variations:
            continue
        any_varies = True
        print(_told(found))
        complain(found.complaints)
        failed = failed or bool(found.complaints)
    if not any_varies:
        message = f"no problem of `{asked}` has `variants:`" if "/" not in asked else f"`{asked}` has no `variants:`"
        raise Misused(Complaint("variants", message, help="such as `variants: {b: 10..30 cm in steps of 2}`"))
    return 1 if failed else 0


def _told(found: OfProblem) -> str:
    from derive.building.variant_check import bars

    lines = [f"{found.id}: {found.possible} different variants"]
    for each in found.variations:
        shown = [each.told(number) for number in range(len(each.choices))]
        lines.append(f"  {each.name}: {', '.join(shown if len(shown) < 8 else [*shown[:3], '...', shown[-1]])}")
    if found.draws:
        derivations = f"{found.structures} different derivations; {found.compared} of the draws derived in full"
        lines.append(f"  {found.draws} draws, {derivations}")
        lines.append(f"  {found.same} pairs of students with the same variant")
        rows = [("answer", "least", "median", "greatest", "unit", "same value", "distribution")]
        for key, answer in found.answers.items():
            values = sorted(answer.values)
            least, median, greatest = (f"{value:.4g}" for value in (values[0], values[len(values) // 2], values[-1]))
            rows.append((key, least, median, greatest, answer.unit, str(found.equal[key]), bars(values)))
        if found.answers:
            lines.append(table(rows))
            lines.append("same value: pairs of different variants whose values are equal to nine figures")
        for key, outcomes in found.outcomes.items():
            if len(outcomes) > 1:
                counted = ", ".join(f"{outcome} in {number} draws" for outcome, number in outcomes.items())
                lines.append(f"  `{key}` has different outcomes: {counted}")
        for why, draws in found.degenerate.items():
            lines.append(f"  {len(draws)} degenerate draws: {why}, for example for {draws[0]}")
    return "\n".join(lines)
