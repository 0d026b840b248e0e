"""`derive why`: the reasons why an output is out of date."""

from __future__ import annotations

import argparse
from pathlib import Path

from derive.cli.problem_ids import problem_id_of, root_of


def why(arguments: argparse.Namespace) -> int:
    """Print what would be made again, why, and by which command. The exit code is 0 even if an output is out of
    date."""
    from derive.building.staleness import Asked, asked_about, staleness
    from derive.course.names import CLASS, STUDENTS

    root = root_of(arguments)
    named = problem_id_of(arguments.what) if arguments.what.endswith(".yaml") else arguments.what.rstrip("/")
    if Path(named).parent.name in (CLASS, STUDENTS):
        from derive.building.classes import why_of_class

        if (of_class := why_of_class(root, Path(named).absolute(), arguments.engine)) is not None:
            print(of_class)
            return 0
    set_id, outputs = asked_about(root, named)
    options = arguments.detail, arguments.evidence, arguments.engine
    print(staleness(Asked(root, set_id, outputs, *options)).shown())
    return 0
