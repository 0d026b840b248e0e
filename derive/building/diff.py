"""The present state of a problem, compared with its last build or with a revision of git; only this problem is
derived."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from derive.building.cache import PACKAGES, cache_of_set, engine_digest
from derive.building.changes import Change, changes
from derive.building.files import shown_path
from derive.building.manifest import Manifest
from derive.building.revision import TEMPLATES, course_at
from derive.building.set_names import set_folder
from derive.building.workers import Bug, Job, done, job_of
from derive.course.problem_set import path_of, problem_paths
from derive.errors import Complaint, DeriveError, Misused

_SAYS = ("detail", "statement", "limits_say", "note", "warnings")  # keys that older versions did not write
Page = Mapping[str, Any]


@dataclass(frozen=True)
class Diff:
    """The changes, the name of the earlier state, and warnings about the comparison itself."""

    since: str
    changes: tuple[Change, ...]
    warnings: tuple[Complaint, ...] = ()


def since_build(root: Path, problem_id: str, detail: str | None, limit: float) -> Diff:
    """Return the changes since the last build, at the level of detail of that build."""
    path_of(root, problem_id)
    before = built_page(root, problem_id)
    if detail and detail != before["detail"]:
        message = f"the last build of `{problem_id}` has the detail `{before['detail']}`, not `{detail}`"
        raise Misused(
            Complaint("other-detail", message, help=f"first build it: `derive build {problem_id} --detail {detail}`")
        )
    after = done(_job(root, root, problem_id, before["detail"], limit))
    recorded = Manifest.read(set_folder(root, problem_id.partition("/")[0])).engine
    warnings = [_other_engine()] if recorded and recorded != engine_digest(*PACKAGES) else []
    return Diff("the last build", tuple(changes(before, after)), tuple(warnings))


def since_revision(root: Path, problem_id: str, revision: str, detail: str | None, limit: float) -> Diff:
    """Return the changes since a revision of git. The installed derive derives both states."""
    path_of(root, problem_id)
    with course_at(root, revision, problem_id.partition("/")[0]) as old_root:
        if problem_id not in problem_paths(old_root):
            raise Misused(Complaint("no-such-problem", f"no problem was called `{problem_id}` at `{revision}`"))
        after = done(_job(root, root, problem_id, detail, limit))
        before, warnings = _derived_at(
            revision, root, old_root, lambda: _job(root, old_root, problem_id, detail, limit)
        )
    return Diff(f"`{revision}`", tuple(changes(before, after)), warnings)


def built_page(root: Path, problem_id: str) -> Page:
    """Return the page that the last build wrote."""
    set_id, _, name = problem_id.partition("/")
    file = set_folder(root, set_id) / f"{name}.json"
    fix = f"`derive build {problem_id}` builds it; `--rev HEAD` compares with the last commit"
    try:
        page = json.loads(file.read_text(encoding="utf-8"))
    except FileNotFoundError:
        message = f"`{problem_id}` has not been built: there is no `{shown_path(file)}` to compare with"
        raise Misused(Complaint("not-built", message, help=fix)) from None
    except (OSError, ValueError):
        message = f"`{shown_path(file)}` cannot be read as a page that a build wrote"
        raise Misused(Complaint("not-built", message, help=fix)) from None
    if not isinstance(page, dict) or any(key not in page for key in _SAYS):
        message = f"`{shown_path(file)}` lacks entries to compare: perhaps an earlier version of derive wrote it"
        raise Misused(Complaint("not-built", message, help=fix))
    return page


def _job(root: Path, of: Path, problem_id: str, detail: str | None, limit: float) -> Job:
    return job_of(of, problem_id, partial(_page, root, of, problem_id, detail), limit)


def _page(root: Path, of: Path, problem_id: str, detail: str | None) -> Page:
    from derive.building.solution import rendered

    cache = cache_of_set(root, problem_id.partition("/")[0])
    page: Page = json.loads(rendered(of, problem_id, detail, cache, only=("json",)).texts["json"])
    return page


def _derived_at(
    revision: str, root: Path, old_root: Path, job: Callable[[], Job]
) -> tuple[Page, tuple[Complaint, ...]]:
    """Return the page at a revision. If this fails with the templates of the revision, use the present templates."""
    try:
        return done(job()), ()
    except (DeriveError, Bug) as error:
        if not (old_root / TEMPLATES).is_dir():
            raise _at(revision, error) from None
        (old_root / TEMPLATES).rename(old_root / f"{TEMPLATES}-of-then")
    if (root / TEMPLATES).is_dir():
        (old_root / TEMPLATES).symlink_to(root / TEMPLATES)
    try:
        page = done(job())
    except (DeriveError, Bug) as error:
        raise _at(revision, error) from None
    message = f"the templates of `{revision}` do not fit the installed derive, so the present templates were used"
    return page, (Complaint("other-templates", message, severity="warning"),)


def _at(revision: str, error: DeriveError | Bug) -> DeriveError | Bug:
    if isinstance(error, Bug):
        return error
    note = f"the error is about the files at `{revision}`, read by the installed derive"
    return type(error)([replace(each, notes=(*each.notes, note)) for each in error.complaints])


def _other_engine() -> Complaint:
    message = "derive or one of its packages has changed since the last build: this may have caused some of the changes"
    return Complaint("other-engine", message, severity="warning")
