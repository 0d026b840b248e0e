"""What derives the pages of a preview: a process that stays, asked for one page after another.

It keeps what it has loaded and printed, so that an edit of words costs little more than the words; and it can be killed
at any moment, since it writes nothing but what builds keep of their work.

    python -P -m derive.preview.worker ROOT MEMORY QUESTIONS ANSWERS TRACE LIFELINE

MEMORY is the most that it may take, in bytes; the others are file descriptors: a question a line, an answer a line, and
those of a build's worker.
"""

from __future__ import annotations

import gc
import json
import os
import sys
import traceback
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import IO, Any

from derive.building.cache import engine_digest
from derive.building.loaded import load
from derive.building.time_limit import limited
from derive.building.workers import confine, job_of, told_to, too_long, trail_of
from derive.errors import DeriveError, OutOfTime


def main(arguments: Sequence[str]) -> None:
    root, (memory, questions, answers, trace, lifeline) = Path(arguments[0]), map(int, arguments[1:])
    for descriptor in (questions, answers, trace, lifeline):
        os.set_inheritable(descriptor, False)  # no program that a script starts has them
    confine(lifeline, trace, memory)
    os.dup2(2, 1)  # what a script prints is for the person at the terminal, and no answer
    told = os.fdopen(answers, "w", encoding="utf-8")
    for packages in (("sympy", "mpmath"), ("matplotlib",)):
        engine_digest(*packages)  # of the modules as they are now, before they are loaded
    load(root, derives=True, draws=False)
    for question in os.fdopen(questions, encoding="utf-8"):
        asked = json.loads(question)
        _tell(told, {"number": asked["number"], **answer(root, asked, trace)})
        _settle(root)


@cache
def _settle(root: Path) -> None:
    """While the first page is read, load what draws; all that is loaded is not looked through for garbage again."""
    load(root, derives=True, draws=True)
    gc.freeze()
    gc.set_threshold(100_000, 50, 50)


def answer(root: Path, question: dict[str, Any], trace: int = 2) -> dict[str, Any]:
    """The page of a problem, or what is wrong with it, as plain data; by which limit it was stopped, and where, it says
    as a build's worker does."""
    problem, limit = question["problem"], question["limit"]
    try:
        with limited(limit, trace):
            return {"main": main_part(root, problem, question["detail"])}
    except DeriveError as error:
        return {"complaints": [each.shown() for each in error.complaints]}
    except OutOfTime as late:
        stopped = too_long(job_of(root, problem, lambda: None, limit), trail_of(late), late)
        return {"complaints": [each.shown() for each in stopped.complaints], "ends": True}
    except (MemoryError, RecursionError) as short:
        return {"limit": told_to(trace, short)}
    except BaseException as bug:  # of a script too, which may well end its program
        return {"complaints": [f"internal error: {type(bug).__name__}: {bug}"], "trace": traceback.format_exc()}


def main_part(root: Path, problem_id: str, detail: str | None) -> str:
    """What a page for a browser has of a problem."""
    from derive.building.cache import Cache
    from derive.building.named import set_folder
    from derive.building.set_document import problem_main
    from derive.building.sets import CACHE
    from derive.building.solution import rendered
    from derive.course.problem_set import problem_set
    from derive.render.formats import HTML

    set_id = problem_id.partition("/")[0]
    heading = problem_set(root, set_id)
    kept = Cache(set_folder(root, set_id) / CACHE)
    solved = rendered(root, problem_id, detail, kept, draws=True, only=(HTML,), evidence=heading.evidence)
    return problem_main(root, solved, heading)


def _tell(answers: IO[str], said: dict[str, Any]) -> None:
    answers.write(json.dumps(said) + "\n")
    answers.flush()


if __name__ == "__main__":
    main(sys.argv[1:])
