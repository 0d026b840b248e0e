"""Grading of answers: workers derive the problems and judge the answers to them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from derive.building.cache import cache_of_set
from derive.building.class_record import ClassRecord
from derive.building.workers import TIME_LIMIT, Bug, Crew, Job, job_of
from derive.errors import BuildFailed, Complaint, DeriveError, Misused
from derive.grading.grading import SECONDS, Graded
from derive.grading.outcomes import Outcome, Verdict

_REPORT = "this is a bug in derive: report it with the answer and the files of the problem"
CHUNK = 200  # the greatest number of answers in one job

# the number of the row, the name of the part, the answer, and the student; without a student, the answer is compared
# with the values of the problem itself
Asked = tuple[int, str, str, str | None]


@dataclass(frozen=True)
class NotGraded:
    """The reason why an answer got no verdict."""

    complaint: Complaint


Result = Graded | NotGraded


def grade_answers(
    root: Path,
    asked: Mapping[str, Sequence[Asked]],
    jobs: int,
    limit: float = TIME_LIMIT,
    tick: Callable[[int, Mapping[str, float]], None] = lambda *_: None,
    of_class: ClassRecord | None = None,
) -> dict[int, Result]:
    """Return the result of each row by the number of the row. With a class, each answer is compared with the variant of
    its student.

    If a worker with several answers exceeds a limit or has an internal error, its answers are divided between two
    new jobs.
    """
    found: dict[int, Result] = {}
    waiting: dict[Job, tuple[str, Sequence[Asked]]] = {}

    def put(crew: Crew, problem_id: str, rows: Sequence[Asked]) -> None:
        work = partial(_graded, root, problem_id, rows, of_class)
        job = job_of(root, problem_id, work, limit + SECONDS * len(rows))
        waiting[job] = problem_id, rows
        crew.put(job)

    with Crew(jobs, lambda running: tick(len(found), running)) as crew:
        for problem_id, rows in asked.items():
            for begins in range(0, len(rows), CHUNK):
                put(crew, problem_id, rows[begins : begins + CHUNK])
        for outcome in crew.outcomes():
            problem_id, rows = waiting.pop(outcome.job)
            if outcome.error is None:
                found.update(outcome.value)
            elif len(rows) > 1 and isinstance(outcome.error, BuildFailed | Bug):
                half = len(rows) // 2
                put(crew, problem_id, rows[:half])
                put(crew, problem_id, rows[half:])
            else:
                found.update((number, _failed(outcome.error, part, answer)) for number, part, answer, _ in rows)
    return found


def _failed(error: DeriveError | Bug, part: str, answer: str) -> Result:
    if isinstance(error, DeriveError) and not isinstance(error, BuildFailed):
        return NotGraded(error.complaints[0])
    if isinstance(error, Bug):
        return NotGraded(Complaint("internal", f"internal error: {str(error)[:200]}", help=_REPORT))
    stopped = "the worker that compared this answer was stopped, for example by a limit of time or memory"
    return Graded(part, answer, Verdict(Outcome.UNREADABLE, stopped))


def _graded(root: Path, problem_id: str, rows: Sequence[Asked], of_class: ClassRecord | None) -> dict[int, Result]:
    from derive.building.solution import answer_key
    from derive.course.problem import load_problem
    from derive.course.variants import chosen_for
    from derive.grading.grading import grade
    from derive.grading.key import Key

    set_id, _, problem = problem_id.partition("/")
    cache = cache_of_set(root, set_id)
    with_class = of_class is not None and of_class.set_id == set_id
    variations = load_problem(root, problem_id).variations if with_class else ()
    keys: dict[tuple[tuple[str, int], ...], Key] = {}

    def key_of(student: str | None) -> Key:
        chosen: Mapping[str, int] = {}
        if of_class and variations and student is not None:
            code = of_class.code_of(student)
            if code is None:
                raise Misused(of_class.unknown(student))
            chosen = chosen_for(set_id, problem, variations, code, of_class.seed)
        which = tuple(chosen.items())
        if which not in keys:
            keys[which] = answer_key(root, problem_id, cache, chosen or None)
        return keys[which]

    def results() -> Iterator[tuple[int, Result]]:
        for number, name, answer, student in rows:
            try:
                key = key_of(student)
            except Misused as error:
                yield number, NotGraded(error.complaints[0])
                continue
            part = key.part(name)
            yield (
                number,
                NotGraded(unknown_part(problem_id, name, key.told)) if part is None else grade(answer, part, key),
            )

    return dict(results())


def unknown_part(problem_id: str, name: str, parts: Sequence[tuple[str, str]]) -> Complaint:
    """Return the error for a name that no part of the problem has; with an empty name, the error for a missing name.

    parts   the label and the question of each part of the problem
    """
    shown = name if len(name) <= 40 else name[:40] + " ..."
    message = f"`{problem_id}` has no part `{shown}`" if shown else f"`{problem_id}` has several parts"
    notes = tuple(f"({label}) {ask}" for label, ask in parts)
    return Complaint("no-such-part", message, notes=notes, help="name one of its parts")


def check_part(root: Path, problem_id: str, name: str | None) -> str:
    """Return the name of a part, by default of the only part. Raise `Misused` if the problem has no such part, or has
    several and no name is given."""
    from derive.course.problem import load_problem
    from derive.grading.key import label_in

    problem = load_problem(root, problem_id)
    labels = [chr(ord("a") + i) for i in range(len(problem.parts))]
    if name is None and len(labels) == 1:
        return labels[0]
    if name is None or label_in(labels, name) is None:
        asks = [(label, _in_words(part.ask.text)) for label, part in zip(labels, problem.parts, strict=True)]
        raise Misused(unknown_part(problem_id, name or "", asks))
    return name


def _in_words(ask: str) -> str:
    plain = " ".join(ask.replace("<<", "").replace(">>", "").split())
    return plain if len(plain) <= 80 else f"{plain[:80].rpartition(' ')[0]} ..."
