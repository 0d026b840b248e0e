"""The mutants that print another page, of which somebody has read that it is true; their kinds are in docs/soundness.md.

A survivor of the nature "form" needs no entry: the same values in the same words, only in other lines, each checked.
"""

from __future__ import annotations

from pathlib import Path

KNOWN = frozenset((Path(__file__).parent / "read.txt").read_text(encoding="utf-8").splitlines())
