"""`derive diff`: what an edit changed, since the last build or since a revision of git."""

from __future__ import annotations

import argparse
import os
import sys
from typing import TYPE_CHECKING

from derive.cli.problem_ids import problem_id_of, root_of
from derive.cli.running import internal, waiting
from derive.cli.terminal import complain, tell
from derive.errors import DeriveError

if TYPE_CHECKING:
    from derive.building.diff import Diff
    from derive.building.set_diff import SetDiff

SAME, DIFFERS, TROUBLE = 0, 1, 2  # the exit codes of `diff`


def diff(arguments: argparse.Namespace) -> int:
    """Print the changes; the exit code is 1 if there are changes, and 2 if the comparison fails."""
    from derive.building.set_diff import SetDiff
    from derive.building.workers import Bug

    asked = problem_id_of(arguments.id)
    try:
        with waiting(f"deriving {asked}"):
            found = _found(arguments, asked)
    except DeriveError as error:
        complain(error.complaints)
        return TROUBLE
    except Bug as bug:
        tell("")
        internal(str(bug), bug.trace)
        return TROUBLE
    each = [*found.problems.values(), found.own] if isinstance(found, SetDiff) else [found]
    complain([*dict.fromkeys(warning for one in each for warning in one.warnings)])
    print(_told(asked, found, arguments.format == "json"))
    return DIFFERS if any(one.changes for one in each) else SAME


def _found(arguments: argparse.Namespace, asked: str) -> Diff | SetDiff:
    """Return the changes of the named problem; if only a set is named, return the changes of this set."""
    from derive.building import diff, set_diff

    root, detail, limit = root_of(arguments), arguments.detail, arguments.time_limit
    if "/" not in asked and arguments.rev is None:
        return set_diff.set_since_build(root, asked, detail, limit)
    if "/" not in asked:
        return set_diff.set_since_revision(root, asked, arguments.rev, detail, limit)
    if arguments.rev is None:
        return diff.since_build(root, asked, detail, limit)
    return diff.since_revision(root, asked, arguments.rev, detail, limit)


def _told(asked: str, found: Diff | SetDiff, as_data: bool) -> str:
    from derive.building.set_diff import SetDiff
    from derive.cli.change_report import as_json, set_as_json, told, told_of_set

    coloured = sys.stdout.isatty() and not os.environ.get("NO_COLOR")
    if isinstance(found, SetDiff):
        return set_as_json(asked, found) if as_data else told_of_set(asked, found, coloured)
    return as_json(asked, found) if as_data else told(asked, found, coloured)
