"""How sets and problems are called, and what the documents of a whole set are: names that no problem can have.

The solutions are for students, the sheet has their questions alone, and the report is for whoever must trust both.
"""

from __future__ import annotations

import re
from enum import StrEnum

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}")
SOLUTIONS, SHEET, REPORT = DOCUMENTS = ("solutions", "problems", "report")
# And those that are made where they are asked for: every line with the points of each step, hints without the answers,
# the points alone.
KEY, HINTS, RUBRIC = MORE = ("key", "hints", "rubric")
PAPERS = (*DOCUMENTS, *MORE)
ON_A_PAGE = (SHEET, *MORE)  # those that a browser shows too, each on one page
INDEX = "index"  # the page of a set for a browser


class EvidenceShown(StrEnum):
    """How much a solution tells of how it was checked; the report of its set tells all of it in any case."""

    NONE = "none"  # that it was, and where that is told
    END = "end"  # counts, in a note at its end
    MARGIN = "margin"  # the same, and beside each display how sure it is and by which second route
