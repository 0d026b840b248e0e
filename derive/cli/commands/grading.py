"""`derive grade`: whether the answers that students typed are right, and what is wrong with them."""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from derive.cli.output import check_output, deliver
from derive.cli.problem_ids import new_id_of, problem_id_of, root_of
from derive.cli.running import waiting
from derive.cli.terminal import complain, table, tell
from derive.errors import Complaint, DeriveError, Misused

if TYPE_CHECKING:
    from derive.building.class_record import ClassRecord
    from derive.building.grading_jobs import Asked, Result
    from derive.grading.table import Row, Table

EXAMPLE = "such as `derive grade hw9/block --part b '7/24 M a^2 omega^2'`"


def grade(arguments: argparse.Namespace) -> int:
    """Grade one answer, or the answers of a table. The exit code is 1 if the answer is not right, or if a row of the
    table got no verdict."""
    if arguments.answers is not None and arguments.answer is not None:
        message = "`derive grade` takes one answer, or `--answers` with a file, but not both"
        raise Misused(Complaint("usage", message, help="leave one of them out"))
    if arguments.answers is not None:
        return _grade_table(arguments)
    if arguments.answer is None:
        message = "`derive grade` needs an answer, or `--answers` with a file of answers"
        raise Misused(Complaint("usage", message, help=EXAMPLE))
    return _grade_one(arguments)


def _grade_one(arguments: argparse.Namespace) -> int:
    from derive.building.grading_jobs import NotGraded, check_part, grade_answers
    from derive.course.problem_set import path_of
    from derive.grading.report import as_data, one_as_text

    root, problem_id = root_of(arguments), problem_id_of(arguments.id)
    check_output(arguments.output, root)
    path_of(root, problem_id)
    part = check_part(root, problem_id, arguments.part)
    of_class = _class_of(arguments, root, problem_id)
    if arguments.student is None and (arguments.seed is not None or arguments.roster is not None):
        message = "`--seed` and `--roster` choose the variant of a student, but no student is named"
        raise Misused(Complaint("usage", message, help="add `--student CODE`"))
    if arguments.student is not None:
        if of_class is None:
            message = f"no class of `{problem_id.partition('/')[0]}` has been made here, so its codes are unknown"
            raise Misused(
                Complaint(
                    "no-class", message, help="give the roster of the class with `--roster`, and its seed with `--seed`"
                )
            )
        if of_class.code_of(arguments.student) is None:
            raise Misused(of_class.unknown(arguments.student))
    with waiting(f"deriving {problem_id}"):
        found = grade_answers(
            root,
            {problem_id: [(0, part, arguments.answer, arguments.student)]},
            1,
            arguments.time_limit,
            of_class=of_class,
        )[0]
    if isinstance(found, NotGraded):
        raise DeriveError(found.complaint)
    text = one_as_text(problem_id, found)
    if arguments.format == "json":
        text = json.dumps({"problem": problem_id, **as_data(found)}, indent=2, ensure_ascii=False)
    elif arguments.format == "csv":
        raise Misused(Complaint("usage", "`--format csv` needs `--answers`", help="use `text` or `json`"))
    deliver(text.encode() + b"\n", arguments.output)
    return 0 if found.verdict.is_right else 1


def _class_of(arguments: argparse.Namespace, root: Path, asked: str) -> ClassRecord | None:
    from derive.building.class_record import class_to_grade
    from derive.building.classes import read_roster

    roster = read_roster(Path(arguments.roster)) if arguments.roster is not None else None
    students = {each.code: each.name for each in roster} if roster is not None else None
    return class_to_grade(root, asked.partition("/")[0], arguments.seed, students)


def _grade_table(arguments: argparse.Namespace) -> int:
    from derive.building.grading_jobs import NotGraded, grade_answers
    from derive.building.preload import preload
    from derive.building.workers import under_way

    root = root_of(arguments)
    check_output(arguments.output, root)
    if arguments.output not in (None, "-") and Path(arguments.output).resolve() == Path(arguments.answers).resolve():
        message = f"`{arguments.output}` is the table of the answers itself, and is not replaced"
        raise Misused(Complaint("output", message, help="name another file"))
    answers, ids = _asked(arguments, root)
    asked: dict[str, list[Asked]] = {}
    for number, (row, problem_id) in enumerate(zip(answers.rows, ids, strict=True)):
        if problem_id is not None and not row.is_split:
            asked.setdefault(problem_id, []).append((number, row.part, row.answer, row.student.strip()))
    if len(asked) > 1:
        preload(root, derives=True, draws=False)

    def tick(done: int, running: Mapping[str, float]) -> None:
        tell(f"{done} of {len(answers.rows)} graded; {under_way(running)}")

    of_class = _class_of(arguments, root, new_id_of(arguments.id))
    found = grade_answers(root, asked, arguments.jobs or os.cpu_count() or 1, arguments.time_limit, tick, of_class)
    tell("")
    unknown = NotGraded(Complaint("no-such-problem", "there is no such problem"))
    split = NotGraded(
        Complaint(
            "csv",
            "the row has more cells than the first line",
            help=f"put an answer that contains `{answers.delimiter}` in double quotes",
        )
    )
    results = [found.get(number, split if row.is_split else unknown) for number, row in enumerate(answers.rows)]
    deliver(_written(arguments, answers, results).encode(), arguments.output)
    lost = [
        (row, each.complaint) for row, each in zip(answers.rows, results, strict=True) if isinstance(each, NotGraded)
    ]
    complain(_at_line(arguments.answers, row, complaint) for row, complaint in lost)
    if not arguments.quiet:
        from derive.grading.report import NOT_GRADED, counted

        told = counted(NOT_GRADED if isinstance(each, NotGraded) else each.verdict.outcome.value for each in results)
        print(
            f"{len(results)} answer{'s' if len(results) != 1 else ''}: {told}" if results else "no answers",
            file=sys.stderr,
        )
    return 1 if lost else 0


def _asked(arguments: argparse.Namespace, root: Path) -> tuple[Table, list[str | None]]:
    """Return the rows of the table, and for each row its problem, or None if the problem does not exist."""
    from derive.course.problem_set import found_path, known_set, path_of
    from derive.grading.table import read_table

    named = problem_id_of(arguments.id)
    is_problem = "/" in named
    if is_problem:
        path_of(root, named)
    else:
        known_set(root, new_id_of(arguments.id))
    path = Path(arguments.answers)
    try:
        content = sys.stdin.buffer.read() if arguments.answers == "-" else path.read_bytes()
    except OSError as error:
        raise Misused(Complaint("unreadable", f"`{path}` cannot be read: {error.strerror}")) from error
    answers = read_table(content, arguments.answers, named if is_problem else "")

    def id_of(row: Row) -> str | None:
        text = row.problem.strip()
        full = problem_id_of(text if "/" in text else f"{named.partition('/')[0]}/{text}")
        return full if len(full) < 200 and found_path(root, full) else None

    return answers, [id_of(row) for row in answers.rows]


def _at_line(path: str, row: Row, complaint: Complaint) -> Complaint:
    message = f"line {row.line} of `{path}`: {complaint.message}"
    if complaint.code == "no-such-problem" and complaint.place is None:
        message = f"line {row.line} of `{path}`: no problem is called `{row.problem[:60]}`"
    return Complaint(complaint.code, message, None, complaint.notes, complaint.help)


def _written(arguments: argparse.Namespace, answers: Table, results: list[Result]) -> str:
    from derive.building.grading_jobs import NotGraded
    from derive.grading.report import NOT_GRADED, as_data, explained, points
    from derive.grading.table import written_table

    form = arguments.format or ("csv" if arguments.output not in (None, "-") else "text")
    if form == "json":
        rows = [
            {
                "student": row.student,
                "problem": row.problem,
                **(
                    {
                        "part": row.part,
                        "answer": row.answer,
                        "verdict": NOT_GRADED,
                        "explanation": each.complaint.message,
                    }
                    if isinstance(each, NotGraded)
                    else {**as_data(each), "part": row.part}
                ),
            }
            for row, each in zip(answers.rows, results, strict=True)
        ]
        return json.dumps({"rows": rows}, indent=2, ensure_ascii=False) + "\n"
    cells = [
        (NOT_GRADED, each.complaint.message, "", "")
        if isinstance(each, NotGraded)
        else (each.verdict.outcome.value, explained(each.verdict), each.verdict.reading, points(each.points))
        for each in results
    ]
    if form == "csv":
        return written_table(answers, cells)
    printed: list[tuple[str, ...]] = [("student", "problem", "part", "verdict", "credit", "explanation")]
    for row, (verdict, because, _, credit) in zip(answers.rows, cells, strict=True):
        printed.append(tuple(map(_in_a_line, (row.student, row.problem, row.part, verdict, credit, because))))
    return table(printed) + "\n"


def _in_a_line(text: str) -> str:
    plain = "".join(c if c.isprintable() else " " for c in text)
    return plain if len(plain) <= 90 else plain[:87] + "..."
