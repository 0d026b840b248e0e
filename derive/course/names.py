"""The names of sets and problems, and the names of the documents of a whole set.

The document "solutions" is for students, "problems" has the questions, and "report" is for the instructor.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}")
SOLUTIONS, SHEET, REPORT = OF_EVERY_SET = ("solutions", "problems", "report")
# documents that are made only on request
KEY, HINTS, RUBRIC = MORE = ("key", "hints", "rubric")
DOCUMENTS = (*OF_EVERY_SET, *MORE)
ON_A_PAGE = (SHEET, *MORE)  # each of these documents is also built as a single page for a browser
LOGO = "logo.png"  # the name of the logo in the folder where TeX runs
INDEX = "index"  # the name of the page that shows a set in a browser
# Folders of a set's outputs: the files that students may see, and the documents of a class for the instructor.
STUDENTS, CLASS = "students", "class"


class Paper(StrEnum):
    """The size of the pages of a set's documents."""

    LETTER = "letter"
    A4 = "a4"


class DecimalSign(StrEnum):
    """The sign between the whole part of a number and its decimals."""

    POINT = "point"
    COMMA = "comma"


@dataclass(frozen=True)
class Language:
    """The language of pages. `name` is the folder of its phrases; if `decimal` is None, pages have the usual decimal
    sign of the language."""

    name: str = "en"
    decimal: DecimalSign | None = None


ENGLISH = Language()


class FontSize(StrEnum):
    """The size of the text in the PDFs of a set."""

    SMALL = "10 pt"
    NORMAL = "11 pt"
    LARGE = "12 pt"


class EvidenceShown(StrEnum):
    """How much a solution shows about its verification."""

    NONE = "none"  # nothing
    END = "end"  # at the end of the solution, a note that counts the checks
    # this note and, next to each display of formulas, its grade of evidence; also a second route or a check, if there
    # is room
    MARGIN = "margin"
