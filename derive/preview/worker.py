"""The process that derives the pages of a preview: it keeps running, and answers one question after another.

The process keeps its loaded modules and its caches, so that an edit of words needs little work.

    python -P -m derive.preview.worker ROOT MEMORY QUESTIONS ANSWERS TRACE LIFELINE

MEMORY is the limit of memory in bytes. The other words in capitals, except ROOT, are file descriptors. QUESTIONS and
ANSWERS have one JSON object per line. At the time limit, the lines of code that are running are written to TRACE.
LIFELINE closes when the server ends.
"""

from __future__ import annotations

import gc
import json
import os
import sys
from collections.abc import Sequence
from functools import cache, partial
from pathlib import Path
from typing import IO, Any

from derive.building.cache import engine_digest
from derive.building.preload import preload
from derive.building.workers import TIME, Bug, attempt, confine, job_of


def main(arguments: Sequence[str]) -> None:
    root, (memory, questions, answers, trace, lifeline) = Path(arguments[0]), map(int, arguments[1:])
    for descriptor in (questions, answers, trace, lifeline):
        os.set_inheritable(descriptor, False)  # programs that a script starts do not inherit the descriptors
    confine(lifeline, trace, memory)
    os.dup2(2, 1)  # a script's output goes to standard error: it is for the user, not an answer
    told = os.fdopen(answers, "w", encoding="utf-8")
    for packages in (("sympy", "mpmath"), ("matplotlib",)):
        engine_digest(*packages)  # compute the digests before the modules are loaded: a later edit must not change them
    preload(root, derives=True, draws=False)
    for question in os.fdopen(questions, encoding="utf-8"):
        asked = json.loads(question)
        _tell(told, {"number": asked["number"], **answer(root, asked, trace)})
        _settle(root)


@cache
def _settle(root: Path) -> None:
    """Load the drawing code while the user reads the first page; exclude loaded objects from garbage collection."""
    preload(root, derives=True, draws=True)
    gc.freeze()
    gc.set_threshold(100_000, 50, 50)


def answer(root: Path, question: dict[str, Any], trace: int = 2) -> dict[str, Any]:
    """Return the page of a problem, or its errors, as plain data."""
    problem = question["problem"]
    work = partial(main_part, root, problem, question["detail"])
    main, error = attempt(job_of(root, problem, work, question["limit"]), trace)
    if error is None:
        return {"main": main}
    if isinstance(error, str):
        return {"limit": error}
    if isinstance(error, Bug):
        return {"complaints": [f"internal error: {error}"], "trace": error.trace}
    ends = any(each.code == TIME for each in error.complaints)
    return {"complaints": [each.shown() for each in error.complaints], "ends": ends}


def main_part(root: Path, problem_id: str, detail: str | None) -> str:
    """Return the main part of a problem's page for a browser."""
    from derive.building.cache import CACHE, Cache
    from derive.building.set_document import problem_main
    from derive.building.set_names import set_folder
    from derive.building.solution import rendered
    from derive.course.problem_set import problem_set
    from derive.render.formats import HTML

    set_id = problem_id.partition("/")[0]
    heading = problem_set(root, set_id)
    kept = Cache(set_folder(root, set_id) / CACHE)
    solved = rendered(
        root, problem_id, detail or heading.detail, kept, draws=True, only=(HTML,), evidence=heading.evidence
    )
    return problem_main(root, solved, heading)


def _tell(answers: IO[str], said: dict[str, Any]) -> None:
    answers.write(json.dumps(said) + "\n")
    answers.flush()


if __name__ == "__main__":
    main(sys.argv[1:])
