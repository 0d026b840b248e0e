"""The documents of a set: those that its file names, and those that `--only` has asked for.

A document that was asked for once is made again by each later build of the whole set, so that it is never older than
the problems. To stop this, remove its PDF.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

from derive.building.manifest import Manifest, Papers
from derive.errors import Complaint, Misused

if TYPE_CHECKING:
    from derive.course.problem_set import ProblemSet


def with_asked(papers: Papers, asked: Collection[str]) -> list[list[str]]:
    """Return these documents, and also those that are asked for."""
    named = [paper for paper, _ in papers]
    return [*map(list, papers), *([paper, paper] for paper in asked if paper not in named)]


def still_there(papers: Papers, record: Manifest, asked: Collection[str]) -> list[list[str]]:
    """Return the documents without those that an earlier `--only` asked for and whose PDF was removed since."""
    earlier = {*record.asked} - {*asked}
    return [list(pair) for pair in papers if pair[0] not in earlier or (record.folder / f"{pair[1]}.pdf").exists()]


def named_papers(heading: ProblemSet, record: Manifest, asked: Collection[str]) -> list[list[str]]:
    """Return the documents of the set from now on; remove the files of those that it no longer has."""
    own = [paper for paper, _ in heading.papers]
    besides = [paper for paper in dict.fromkeys([*record.asked, *asked]) if paper not in own]
    named = with_asked(heading.papers, besides)
    files = [file for _, file in named]
    if twice := [file for file in files if files.count(file) > 1]:
        message = f"two documents of `{heading.id}` would be called `{twice[0]}`"
        help_line = f"choose another name in `papers:` of `{heading.inputs[0]}`"
        raise Misused(Complaint("paper-name", message, help=help_line))
    papers = [*map(list, heading.papers), *still_there(named[len(own) :], record, asked)]
    record.replace_papers(papers)
    record.asked = [paper for paper in besides if [paper, paper] in papers]
    return papers
