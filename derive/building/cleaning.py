"""Removal of the files that builds wrote."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from derive.building.cache import CACHE
from derive.building.files import writing
from derive.building.lock import locked
from derive.building.set_names import set_names
from derive.errors import Complaint, Misused, did_you_mean


def cleaned(root: Path, sets: Sequence[str], cache: bool, waiting: Callable[[str], None]) -> list[tuple[Path, int]]:
    """Remove folders, and return each with its size in bytes. If a build is running, wait for its end.

    sets      the sets whose folders are removed; if empty, every folder in `build`
    cache     whether only the data stored for later builds are removed
    waiting   a function that is called before the wait, with the name of the set
    """
    build = root / "build"
    folders = [path for path in sorted(build.glob("*")) if path.is_dir() and not path.is_symlink()]
    known = {*set_names(root), *(path.name for path in folders)}
    for name in sets:
        if name not in known:
            help_line = did_you_mean(name, known)
            message = f"no set is called `{name}`, and `build` has no folder of this name"
            raise Misused(Complaint("no-such-set", message, help=help_line))
    meant = [path for path in folders if not sets or path.name in sets]
    found = []
    for outputs in meant:
        with locked(outputs, partial(waiting, outputs.name)):
            folder = outputs / CACHE if cache else outputs
            if folder.is_dir() and not folder.is_symlink():
                size = sum(each.lstat().st_size for each in folder.rglob("*") if not each.is_dir())
                with writing(folder):
                    shutil.rmtree(folder)
                found.append((folder, size))
    return found
