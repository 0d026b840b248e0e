"""`derive clean` and `derive doctor`: remove the files of builds, and check what builds need."""

from __future__ import annotations

import argparse

from derive.cli.problem_ids import found_root, root_of
from derive.cli.terminal import tell


def clean(arguments: argparse.Namespace) -> int:
    from derive.building.cleaning import cleaned
    from derive.building.files import shown_path

    sets = [name.removeprefix("build/").rstrip("/") for name in arguments.sets]
    for folder, size in cleaned(root_of(arguments), sets, arguments.cache, lambda name: tell(f"waiting for `{name}`")):
        tell("")
        print(f"removed {shown_path(folder)} ({size / 1e6:.1f} MB)")
    return 0


def doctor(arguments: argparse.Namespace) -> int:
    from derive.building.doctor import findings

    found = findings(found_root(arguments.root), arguments.engine)
    for finding in found:
        print(finding.shown())
    return 0 if all(finding.good for finding in found) else 1
