"""`derive why`: what made an output stale."""

from __future__ import annotations

import argparse

from derive.cli.asked import problem_id_of, root_of


def why(arguments: argparse.Namespace) -> int:
    """Say what would be made again, because of what, and by which command; that is an answer and no failure."""
    from derive.building.staleness import Asked, asked_about, staleness

    root = root_of(arguments)
    named = problem_id_of(arguments.what) if arguments.what.endswith(".yaml") else arguments.what.rstrip("/")
    set_id, outputs = asked_about(root, named)
    options = arguments.detail, arguments.evidence, arguments.engine
    print(staleness(Asked(root, set_id, outputs, *options)).shown())
    return 0
