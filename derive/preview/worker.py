"""What derives the pages of a preview: a process that stays, asked for one page after another.

It keeps what it has loaded and printed, so that an edit of words costs little more than the words; and it can be killed
at any moment, since it writes nothing but what builds keep of their work.

    python -P -m derive.preview.worker ROOT     a question a line on standard input, an answer a line on standard output
"""

from __future__ import annotations

import gc
import json
import os
import sys
import traceback
from collections.abc import Sequence
from dataclasses import asdict
from functools import cache
from pathlib import Path
from typing import IO, Any

from derive.building.loaded import load
from derive.errors import DeriveError


def main(arguments: Sequence[str]) -> None:
    root = Path(arguments[0])
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what a script prints is for the person at the terminal, and no answer
    load(root, draws=False)
    for question in sys.stdin:
        _tell(answers, answer(root, json.loads(question)))
        _settle(root)


@cache
def _settle(root: Path) -> None:
    """While the first page is read, load what draws; all that is loaded is not looked through for garbage again."""
    load(root, draws=True)
    gc.freeze()
    gc.set_threshold(100_000, 50, 50)


def answer(root: Path, question: dict[str, Any]) -> dict[str, Any]:
    """The page of a problem, or what is wrong with it, as plain data."""
    try:
        return {"main": main_part(root, question["problem"], question["detail"])}
    except DeriveError as error:
        return {"complaints": [{**asdict(each), "shown": each.shown()} for each in error.complaints]}
    except (MemoryError, RecursionError):
        message = "the problem goes deeper than Python can follow, or takes more memory than there is"
        return {"complaints": [{"message": message, "shown": f"error[too-deep]: {message}"}]}
    except BaseException as bug:  # of a script too, which may well end its program
        summary = f"internal error: {type(bug).__name__}: {bug}"
        return {"complaints": [{"message": summary, "shown": summary}], "trace": traceback.format_exc()}


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
