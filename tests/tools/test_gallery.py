"""The gallery shows problems as they are, and each has its picture."""

from __future__ import annotations

import runpy

from tests.courses import ROOT

MADE = runpy.run_path(str(ROOT / "tools" / "gallery.py"))


def test_it_is_up_to_date() -> None:
    assert MADE["document"]() == MADE["DOCUMENT"].read_text(encoding="utf-8"), "run `python -P -m tools.gallery`"


def test_each_problem_has_a_picture_and_no_picture_is_spare() -> None:
    assert {path.stem for path in MADE["PICTURES"].glob("*.png")} == set(MADE["SHOWN"])


def test_each_drawing_of_the_manual_is_there_and_none_is_spare() -> None:
    assert {path.stem for path in MADE["MANUAL"].with_suffix("").glob("*.svg")} == set(MADE["drawings_of_manual"]())
