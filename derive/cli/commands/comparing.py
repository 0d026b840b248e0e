"""`derive diff`: what an edit changed, since the last build or since a revision of git."""

from __future__ import annotations

import argparse
import os
import sys

from derive.cli.asked import problem_id_of, root_of
from derive.cli.running import internal, waiting
from derive.cli.terminal import complain, tell
from derive.errors import DeriveError

SAME, DIFFERS, TROUBLE = 0, 1, 2  # as of `diff`


def diff(arguments: argparse.Namespace) -> int:
    """Whether something changed, as the exit code; what, on standard output."""
    from derive.building.compared import since_build, since_revision
    from derive.building.workers import Bug
    from derive.cli.changes_told import as_json, told

    root, problem_id = root_of(arguments), problem_id_of(arguments.id)
    how = arguments.detail, arguments.time_limit
    try:
        with waiting(f"deriving {problem_id}"):
            if arguments.rev is None:
                compared = since_build(root, problem_id, *how)
            else:
                compared = since_revision(root, problem_id, arguments.rev, *how)
    except DeriveError as error:
        complain(error.complaints)
        return TROUBLE
    except Bug as bug:
        tell("")
        internal(str(bug), bug.trace)
        return TROUBLE
    complain(compared.warnings)
    coloured = sys.stdout.isatty() and not os.environ.get("NO_COLOR")
    print(as_json(problem_id, compared) if arguments.format == "json" else told(problem_id, compared, coloured))
    return DIFFERS if compared.changes else SAME
