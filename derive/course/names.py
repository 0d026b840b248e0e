"""How sets and problems are called, and what the documents of a whole set are: names that no problem can have."""

from __future__ import annotations

import re

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}")
SOLUTIONS, SHEET = DOCUMENTS = ("solutions", "problems")  # with the solutions, and for students
