"""`derive class`: a sheet, a key and solutions for each student of a class."""

from __future__ import annotations

import argparse
from pathlib import Path

from derive.cli.commands.building import Voice
from derive.cli.problem_ids import new_id_of, root_of, warn_of_templates
from derive.cli.running import internal
from derive.cli.terminal import complain


def make_class(arguments: argparse.Namespace) -> int:
    from derive.building.classes import made_class, named_students, read_roster
    from derive.building.files import shown_path
    from derive.building.set_names import check_asked, set_folder
    from derive.course.names import CLASS, STUDENTS

    root, set_id = root_of(arguments), new_id_of(arguments.set)
    check_asked(root, set_id)
    warn_of_templates(root)
    students = read_roster(Path(arguments.roster))
    voice = Voice(arguments.quiet, arguments.verbose)
    seed, engine, limit = arguments.seed, arguments.engine, arguments.time_limit
    report = made_class(
        root,
        set_id,
        students,
        seed,
        engine,
        arguments.jobs,
        limit,
        voice.tell,
        arguments.scheduler,
        arguments.reseed,
        voice.ended,
    )
    voice.tell("")
    complain([*report.warnings, *report.complaints])
    for bug in report.bugs:
        internal(str(bug), bug.trace)
    outputs = shown_path(set_folder(root, set_id))
    without = f"; an error prevented those of {named_students(report.without)}" if report.without else ""
    voice.say(
        f"{set_id}: made the documents of {report.made} of {report.students} students in {report.seconds:.1f} s; "
        f"those of {report.kept} were up to date{without}. The sheets are in {outputs}/{STUDENTS}; "
        f"the solutions, keys and answers are in {outputs}/{CLASS}"
    )
    return 1 if report.failed else 0
