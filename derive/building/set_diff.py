"""The present state of a set, compared with its last build or with a revision of git."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from pathlib import Path

from derive.building.changes import Change
from derive.building.diff import Diff, built_page, since_build, since_revision
from derive.building.manifest import Manifest
from derive.building.revision import course_at
from derive.building.set_names import check_asked, set_folder
from derive.course.parts import points_text
from derive.course.problem_file import written_problem
from derive.course.problem_set import problem_set
from derive.errors import Complaint, Faults, Misused

Points = Mapping[str, Fraction | None]  # points of each problem of a set, in order


@dataclass(frozen=True)
class SetDiff:
    """The changes of a set itself, and of its problems."""

    own: Diff
    problems: Mapping[str, Diff]

    @property
    def changed(self) -> bool:
        return bool(self.own.changes) or any(each.changes for each in self.problems.values())


def set_since_build(root: Path, set_id: str, detail: str | None, limit: float) -> SetDiff:
    """Return what has changed since the last build of the set."""
    after, folder = _written(root, set_id), set_folder(root, set_id)
    built = [f"{set_id}/{name}" for name in Manifest.read(folder).problems]
    if not built:
        message = f"no build of `{set_id}` is recorded, so there is nothing to compare with"
        help_line = f"`derive build {set_id}` builds it; `--rev HEAD` compares with the last commit"
        raise Misused(Complaint("not-built", message, help=help_line))
    pages = {name: built_page(root, name)["points"] for name in built}
    before = {name: None if points is None else Fraction(str(points)) for name, points in pages.items()}
    problems = {name: since_build(root, name, detail, limit) for name in after if name in before}
    return SetDiff(Diff("the last build", tuple(_changes(before, after))), problems)


def set_since_revision(root: Path, set_id: str, revision: str, detail: str | None, limit: float) -> SetDiff:
    """Return the changes since a revision of git. The installed derive derives both states."""
    after = _written(root, set_id)
    with course_at(root, revision, set_id) as old_root:
        before = _written(old_root, set_id)
    since = partial(since_revision, root, revision=revision, detail=detail, limit=limit)
    problems = {name: since(name) for name in after if name in before}
    return SetDiff(Diff(f"`{revision}`", tuple(_changes(before, after))), problems)


def _written(root: Path, set_id: str) -> Points:
    """Return the points of a set's problems, as the files of the set state them."""
    check_asked(root, set_id)
    faults = Faults()
    found = {name: written_problem(root, name, faults) for name in problem_set(root, set_id).problems}
    points = {name: written.points_in_all(faults) for name, written in found.items()}
    faults.stop()
    return points


def _changes(before: Points, after: Points) -> list[Change]:
    come = [Change("problem", name, "", _worth({name: after[name]})) for name in after if name not in before]
    gone = [Change("problem", name, _worth({name: before[name]}), "") for name in before if name not in after]
    was, now = ([name for name in each if name in before and name in after] for each in (before, after))
    order = [Change("order", "problems", " ".join(was), " ".join(now))] if was != now else []
    total = Change("points", "the set", _worth(before), _worth(after))
    return [*([total] if total.before != total.after else []), *come, *gone, *order]


def _worth(points: Points) -> str:
    known = [each for each in points.values() if each is not None]
    return points_text(sum(known, Fraction(0))) if len(known) == len(points) else "no points"
