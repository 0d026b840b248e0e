"""`derive build`: typesets sets, once or after each edit."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from derive.cli.problem_ids import problem_id_of, root_of, warn_of_names, warn_of_templates
from derive.cli.running import internal
from derive.cli.terminal import complain, note, tell
from derive.errors import Complaint, Misused

if TYPE_CHECKING:
    from derive.building.sets import Options, Report
    from derive.building.workers import Ended


@dataclass(frozen=True)
class Voice:
    """The messages of a build in addition to errors and warnings: with `quiet` there are none, and with `verbose` each
    finished piece of work is shown."""

    quiet: bool = False
    verbose: bool = False

    def tell(self, text: str) -> None:
        if not self.quiet:
            tell(text)

    def ended(self, piece: Ended) -> None:
        if self.verbose:
            note(piece.how, piece.of, piece.seconds)

    def say(self, text: str) -> None:
        if not self.quiet:
            print(text, flush=True)


def build(arguments: argparse.Namespace) -> int:
    from derive.building.set_names import check_asked, outputs_without_set, set_names
    from derive.building.sets import Options, built_set

    root = root_of(arguments)
    warn_of_templates(root)
    if not arguments.sets:
        warn_of_names(root)
        complain(outputs_without_set(root))
    options = Options(
        arguments.engine,
        arguments.detail,
        arguments.force,
        arguments.jobs,
        arguments.time_limit,
        evidence=arguments.evidence,
        documents=arguments.only,
    )
    asked = _sets_asked(arguments.sets or set_names(root))
    if not asked:
        raise Misused(
            Complaint("no-such-set", "no set was found", help="a set is a folder in `problems` with a file `set.yaml`")
        )
    for name, only in asked.items():
        check_asked(root, name, only)
    voice = Voice(arguments.quiet, arguments.verbose)
    if arguments.watch:
        return _watched(root, asked, options, voice)
    return max(
        _reported(built_set(root, name, replace(options, only=only), voice.tell, None, voice.ended), voice)
        for name, only in asked.items()
    )


def _sets_asked(asked: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """Map the names of sets to their requested problems; an empty tuple means all problems of the set."""
    found: dict[str, dict[str, None]] = {}
    for set_id, _, name in (problem_id_of(each).partition("/") for each in asked):
        found.setdefault(set_id, {})[name] = None
    return {set_id: () if "" in names else tuple(names) for set_id, names in found.items()}


def _watched(root: Path, asked: Mapping[str, tuple[str, ...]], options: Options, voice: Voice) -> int:
    from derive.building.files import shown_path
    from derive.building.watch import Shown, watch

    failed: dict[str, bool] = {}  # set -> whether its last build failed; if so, its next success is reported

    def wrote(path: Path, seconds: float) -> None:
        tell("")
        voice.say(f"wrote {shown_path(path)} ({seconds:.1f} s)")

    def built(report: Report) -> None:
        if report.derived or report.changed or report.failed or failed.get(report.set_id, True):
            _reported(report, voice)
        failed[report.set_id] = report.failed

    def refused(complaints: Sequence[Complaint]) -> None:
        tell("")
        complain(complaints)

    with suppress(KeyboardInterrupt):
        watch(root, asked, options, Shown(voice.tell, wrote, built, refused, voice.ended))
    tell("")
    return 0


def _reported(report: Report, voice: Voice) -> int:
    from derive.building.files import shown_path

    tell("")
    complain([*report.warnings, *report.complaints])
    for bug in report.bugs:
        internal(str(bug), bug.trace)
    pages = [shown_path(path) for path in report.changed if path.suffix in (".html", ".pdf")]
    said = f"wrote {_listed(pages)}" if pages else "no page changed" if report.derived else "up to date"
    if report.failed:
        said = f"failed; {said if pages else 'earlier pages are unchanged'}"
    derived = f"derived {report.derived} of {report.problems} problems"
    voice.say(f"{report.set_id}: {derived}, {said} ({report.seconds:.1f} s)")
    return 1 if report.failed else 0


def _listed(paths: Sequence[str], most: int = 12) -> str:
    """Return all paths if they are few, else the last paths, which belong to the whole set, and the number of the other
    paths."""
    if len(paths) <= most:
        return ", ".join(paths)
    last = paths[-3:]
    return f"{', '.join(last)} and {len(paths) - len(last)} other files"
