"""The names of sets and problems, and the documents of a whole set, whose names no problem can have.

The solutions are for students, the sheet has only the questions, and the report is for the instructor.
"""

from __future__ import annotations

import re
from enum import StrEnum

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}")
SOLUTIONS, SHEET, REPORT = OF_EVERY_SET = ("solutions", "problems", "report")
# Further documents, made only on request: every line with the points of each step, hints without the answers, the
# points alone.
KEY, HINTS, RUBRIC = MORE = ("key", "hints", "rubric")
DOCUMENTS = (*OF_EVERY_SET, *MORE)
ON_A_PAGE = (SHEET, *MORE)  # documents that are also built as one page each for a browser
INDEX = "index"  # the page of a set for a browser


class EvidenceShown(StrEnum):
    """How much a solution shows about its verification; the report of its set always shows everything."""

    NONE = "none"  # states that the solution was checked, and where the evidence is
    END = "end"  # a note at the end of the solution has the numbers of checks
    MARGIN = "margin"  # the note, and next to each display its grade and its second route
