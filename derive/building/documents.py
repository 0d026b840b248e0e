"""The documents of a set: the documents that its file lists, and the documents that a command requests with `--only`.

A document that was requested once is made again by later builds of the whole set, until you remove its PDF.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

from derive.building.manifest import Documents, Manifest
from derive.course.names import DOCUMENTS
from derive.errors import Complaint, Misused

if TYPE_CHECKING:
    from derive.course.problem_set import ProblemSet


def with_asked(documents: Documents, asked: Collection[str]) -> list[list[str]]:
    """Return these documents and the documents that were requested in addition."""
    named = [kind for kind, _ in documents]
    return [*map(list, documents), *([kind, kind] for kind in asked if kind not in named)]


def still_there(documents: Documents, record: Manifest, asked: Collection[str]) -> list[list[str]]:
    """Return the documents. A document that an earlier `--only` requested is left out if its PDF has been removed."""
    earlier = {*record.asked} - {*asked}
    return [list(pair) for pair in documents if pair[0] not in earlier or (record.folder / f"{pair[1]}.pdf").exists()]


def named_documents(heading: ProblemSet, record: Manifest, asked: Collection[str]) -> list[list[str]]:
    """Update and return the documents of the set; remove the files of documents that the set no longer has.

    If the record is empty, for example because another user built the set, each PDF with the name of a document counts
    as requested. Otherwise no later build would update these PDFs.
    """
    own = [kind for kind, _ in heading.documents]
    others = {*(file for _, file in heading.documents), *(each.rpartition("/")[2] for each in heading.problems)}
    there = [kind for kind in DOCUMENTS if kind not in others and (record.folder / f"{kind}.pdf").is_file()]
    earlier = record.asked if record.documents else there
    requested = [kind for kind in dict.fromkeys([*earlier, *asked]) if kind not in own]
    named = with_asked(heading.documents, requested)
    files = [file for _, file in named]
    if twice := [file for file in files if files.count(file) > 1]:
        message = f"two documents of `{heading.id}` would be called `{twice[0]}`"
        help_line = f"choose another name in `documents:` of `{heading.inputs[0]}`"
        raise Misused(Complaint("document-name", message, help=help_line))
    documents = [*map(list, heading.documents), *still_there(named[len(own) :], record, asked)]
    record.replace_documents(documents)
    record.asked = [kind for kind in requested if [kind, kind] in documents]
    return documents
