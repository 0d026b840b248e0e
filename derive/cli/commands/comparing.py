"""`derive diff`: what an edit changed, since the last build or since a revision of git."""

from __future__ import annotations

import argparse
import os
import sys
from typing import TYPE_CHECKING

from derive.cli.asked import problem_id_of, root_of
from derive.cli.running import internal, waiting
from derive.cli.terminal import complain, tell
from derive.errors import DeriveError

if TYPE_CHECKING:
    from derive.building.compared import Compared
    from derive.building.compared_sets import ComparedSet

SAME, DIFFERS, TROUBLE = 0, 1, 2  # as of `diff`


def diff(arguments: argparse.Namespace) -> int:
    """Print what changed, and return as the exit code whether something did."""
    from derive.building.compared_sets import ComparedSet
    from derive.building.workers import Bug

    asked = problem_id_of(arguments.id)
    try:
        with waiting(f"deriving {asked}"):
            compared = _compared(arguments, asked)
    except DeriveError as error:
        complain(error.complaints)
        return TROUBLE
    except Bug as bug:
        tell("")
        internal(str(bug), bug.trace)
        return TROUBLE
    each = [*compared.problems.values(), compared.own] if isinstance(compared, ComparedSet) else [compared]
    complain([*dict.fromkeys(warning for one in each for warning in one.warnings)])
    print(_told(asked, compared, arguments.format == "json"))
    return DIFFERS if any(one.changes for one in each) else SAME


def _compared(arguments: argparse.Namespace, asked: str) -> Compared | ComparedSet:
    """Return the changes of a problem, or of a set if no problem of it is named."""
    from derive.building import compared, compared_sets

    root, detail, limit = root_of(arguments), arguments.detail, arguments.time_limit
    if "/" not in asked and arguments.rev is None:
        return compared_sets.set_since_build(root, asked, detail, limit)
    if "/" not in asked:
        return compared_sets.set_since_revision(root, asked, arguments.rev, detail, limit)
    if arguments.rev is None:
        return compared.since_build(root, asked, detail, limit)
    return compared.since_revision(root, asked, arguments.rev, detail, limit)


def _told(asked: str, compared: Compared | ComparedSet, as_data: bool) -> str:
    from derive.building.compared_sets import ComparedSet
    from derive.cli.changes_told import as_json, set_as_json, told, told_of_set

    coloured = sys.stdout.isatty() and not os.environ.get("NO_COLOR")
    if isinstance(compared, ComparedSet):
        return set_as_json(asked, compared) if as_data else told_of_set(asked, compared, coloured)
    return as_json(asked, compared) if as_data else told(asked, compared, coloured)
