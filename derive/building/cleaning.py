"""Removal of the files that builds wrote."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from derive.building.cache import CACHE
from derive.building.class_record import RECORD
from derive.building.files import writing
from derive.building.lock import locked
from derive.building.set_names import set_names
from derive.errors import Complaint, Misused, did_you_mean


def cleaned(root: Path, sets: Sequence[str], cache: bool, waiting: Callable[[str], None]) -> list[tuple[Path, int]]:
    """Remove folders, and return each with the size of the removed files in bytes. If a build is running, wait for its
    end. The record of the class of a set stays: without the seed in it, students would get different values.

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
                kept = [folder / RECORD] if outputs.name in set_names(root) else []
                files = [each for each in folder.rglob("*") if not each.is_dir() and each not in kept]
                size = sum(each.lstat().st_size for each in files)
                with writing(folder):
                    _empty(folder, kept)
                if size or not folder.exists():
                    found.append((folder, size))
    return found


def _empty(folder: Path, kept: Sequence[Path]) -> None:
    """Remove the files of a folder, and the folder itself if none of the files `kept` exists."""
    if not any(each.is_file() for each in kept):
        shutil.rmtree(folder)
        return
    for each in folder.iterdir():
        if each not in kept:
            shutil.rmtree(each) if each.is_dir() and not each.is_symlink() else each.unlink()
