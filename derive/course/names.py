"""The names of sets and problems, and the names of the documents of a whole set. No problem can have the name of such a
document.

The document "solutions" is for students, "problems" has only the questions, and "report" is for the instructor.
"""

from __future__ import annotations

import re
from enum import StrEnum

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}")
SOLUTIONS, SHEET, REPORT = OF_EVERY_SET = ("solutions", "problems", "report")
# Documents that are made only on request: the key has every line and the points of each step, the hints do not give
# the answers, and the rubric has the points alone.
KEY, HINTS, RUBRIC = MORE = ("key", "hints", "rubric")
DOCUMENTS = (*OF_EVERY_SET, *MORE)
ON_A_PAGE = (SHEET, *MORE)  # each of these documents is also built as a single page for a browser
LOGO = "logo.png"  # the name of the logo where TeX runs
INDEX = "index"  # the page of a set for a browser
# Folders of a set's outputs: the files that students may see, and the documents of a class for the instructor.
STUDENTS, CLASS = "students", "class"


class Paper(StrEnum):
    """The size of the pages of a set's documents."""

    LETTER = "letter"
    A4 = "a4"


class FontSize(StrEnum):
    """The size of the text in the PDFs of a set."""

    SMALL = "10 pt"
    NORMAL = "11 pt"
    LARGE = "12 pt"


class EvidenceShown(StrEnum):
    """How much a solution shows about its verification; the report of its set always shows everything."""

    NONE = "none"  # nothing
    END = "end"  # a note at the end of the solution, which counts the checks
    MARGIN = "margin"  # the note and, next to each display of formulas, its grade and a second route if it fits
