"""The table of shapes in the documentation is made from the shapes themselves."""

from __future__ import annotations

import runpy

from derive.stock.keys.bodies import shapes
from tests.courses import ROOT

MADE = runpy.run_path(str(ROOT / "tools" / "shapes.py"))


def test_the_table_in_the_documentation_is_up_to_date() -> None:
    text = MADE["DOCUMENT"].read_text(encoding="utf-8")
    assert MADE["updated"](text) == text, "run `python -P -m tools.shapes`"


def test_every_shape_has_its_line_with_its_centre_of_mass() -> None:
    lines = {line.split("`")[1]: line for line in MADE["table"]().splitlines()[2:]}
    assert lines.keys() == shapes().keys()
    assert "`circle_centre` (0, 0, 0), `centre_of_mass` (0, 4*R/(3*pi), 0)" in lines["half_disc"]
    assert "`end` (0, 0, 0), `far_end` (0, 0, l), `centre_of_mass` (0, 0, l/2)" in lines["rod"]
