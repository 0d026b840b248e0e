"""Documents that are typeset outside a build: one solution, or the reports of a check."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from pathlib import Path

from derive.building.scratch import Scratch
from derive.building.set_names import set_folder
from derive.building.tex import by_the_clock, chosen_engine, typeset
from derive.building.workers import Job, done
from derive.course.names import LOGO, REPORT
from derive.course.problem_set import ProblemSet, problem_set
from derive.render.rendered import Files, Rendered


def typeset_standalone(outputs: Path, name: str, tex: str, files: Files, engine: str | None, limit: float) -> bytes:
    """Return the PDF of the document `name`."""
    with Scratch() as folder:
        target = Path(folder) / f"{name}.pdf"
        work = partial(typeset, tex, target, chosen_engine(engine), timeout=limit, log=outputs / "log", included=files)
        done(Job(f"the pages of `{outputs.name}/{name}`", work, by_the_clock(limit)))
        return target.read_bytes()


def reports(root: Path, solved: Mapping[str, Rendered], engine: str | None, limit: float) -> dict[str, bytes]:
    """Return the report of each set as path -> PDF. A report contains the checked problems."""
    from derive.building.set_document import report_document

    found: dict[str, bytes] = {}
    for set_id in dict.fromkeys(problem.partition("/")[0] for problem in solved):
        heading: ProblemSet = done(Job(f"`problems/{set_id}/set.yaml`", partial(problem_set, root, set_id), limit))
        listed = [solved[problem] for problem in heading.problems if problem in solved]
        if not listed:
            continue
        is_single = len(listed) == 1 < len(heading.problems)
        name = f"{listed[0].id.rpartition('/')[2]}-{REPORT}" if is_single else REPORT
        outputs = set_folder(root, set_id)
        tex = report_document(root, heading, listed)
        logo = ((LOGO, heading.logo),) if heading.logo else ()
        found[str(outputs / f"{name}.pdf")] = typeset_standalone(outputs, name, tex, logo, engine, limit)
    return found
