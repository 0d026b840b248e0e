"""`derive list`: the problems of a course, or all names that the parts of one problem may ask for."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from derive.cli.problem_ids import new_id_of, problem_id_of, root_of, root_with, warn_of_names
from derive.cli.running import waiting
from derive.cli.terminal import complain, table
from derive.errors import Complaint, DeriveError, Misused, did_you_mean


def list_problems(arguments: argparse.Namespace) -> int:
    from derive.course.problem_set import found_path, known_set, problem_paths, topic_of

    root = root_with(arguments, new_id_of(arguments.set).partition("/")[0]) if arguments.set else root_of(arguments)
    if arguments.answers:
        return _list_answers(arguments, root)
    warn_of_names(root)
    if arguments.set and found_path(root, problem_id := problem_id_of(arguments.set)):
        message, help_line = f"`{problem_id}` is a problem", "`--answers` lists what its parts may ask for"
        raise Misused(Complaint("no-such-set", message, help=help_line))
    within = f"{known_set(root, new_id_of(arguments.set))}/" if arguments.set else ""
    paths = {problem: path for problem, path in sorted(problem_paths(root).items()) if problem.startswith(within)}
    topics = {problem: topic_of(path) for problem, path in paths.items()}
    if arguments.topic and arguments.topic not in topics.values():
        known = sorted({topic for topic in topics.values() if topic})
        every = f"the topics are {', '.join(known)}" if known else "topics are folders within a set, and none was found"
        help_line = did_you_mean(arguments.topic, known) or every
        raise Misused(Complaint("no-such-topic", f"no topic is called `{arguments.topic}`", help=help_line))
    ids = [problem for problem, topic in topics.items() if arguments.topic in (None, topic)]
    found = ((problem, topics[problem], *told) for problem, told in zip(ids, _headlines(root, ids, paths), strict=True))
    rows = [("problem", "topic", "points", "title"), *found]
    without = [(row[0], *row[2:]) for row in rows]
    print(table(rows if any(topics.values()) else without))
    _warn_of_sets(root, dict.fromkeys(problem.partition("/")[0] for problem in paths))
    return 0


def _warn_of_sets(root: Path, names: Iterable[str]) -> None:
    """Report errors in the files of the sets as warnings, because the list itself does not need these files."""
    from derive.course.problem_set import problem_set, set_ids

    found = list[Complaint]()
    known = set_ids(root)
    for name in names:
        try:
            problem_set(root, name) if name in known else None
        except DeriveError as error:
            found += error.complaints
    complain(dict.fromkeys(replace(each, severity="warning") for each in found))


def _list_answers(arguments: argparse.Namespace, root: Path) -> int:
    from derive.course.problem_set import path_of

    if not arguments.set or "/" not in (problem_id := problem_id_of(arguments.set)):
        message = "`--answers` lists the answers of one problem"
        raise Misused(Complaint("no-such-problem", message, help="for example `derive list hw9/block --answers`"))
    path_of(root, problem_id)
    from derive.building.answers import answers_of
    from derive.building.workers import done, job_of

    with waiting(f"deriving {problem_id}"):
        work = partial(answers_of, root, problem_id)
        rows = done(job_of(root, problem_id, work, arguments.time_limit))
    print(table(rows))
    return 0


def _headlines(root: Path, ids: Sequence[str], paths: Mapping[str, str]) -> list[tuple[str, str]]:
    """Return the points and title of each problem. One worker reads all problems; if this worker fails, each half of
    the list is read by a worker of its own."""
    from derive.building.headline import headline
    from derive.building.workers import done, job_of

    def told(problem_id: str) -> tuple[str, str]:
        try:
            return headline(root, problem_id, paths[problem_id])
        except DeriveError as error:
            return _does_not_read(error)

    half = len(ids) // 2
    try:
        limit = 10 + len(ids) / 10
        return done(job_of(root, ids[0], lambda: [told(each) for each in ids], limit)) if ids else []
    except DeriveError as error:
        return (
            [*_headlines(root, ids[:half], paths), *_headlines(root, ids[half:], paths)]
            if half
            else [_does_not_read(error)]
        )


def _does_not_read(error: DeriveError) -> tuple[str, str]:
    return "", f"(cannot be read: {error.complaints[0].message})"
