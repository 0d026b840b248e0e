"""Tests of letters as contours in Computer Modern."""

from __future__ import annotations

import json
import subprocess
import sys
from itertools import pairwise

import pytest
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath

from derive.render.drawing.lettering import LETTERS, letters_of
from tests.courses import ROOT

TEXTS = [r"$\frac{3}{2}m\,R^{2}\dot{\theta}$", r"$\sqrt{\frac{g}{l}}$", r"$\sum Q \omega g f$", r"$\mathrm{minimum}$"]


@pytest.mark.parametrize("text", TEXTS)
def test_the_box_of_a_text_is_what_its_curves_fill(text: str) -> None:
    contour, extent = letters_of([text])[text]
    path = TextPath((0, 0), text, size=LETTERS, prop=FontProperties(math_fontfamily="cm"))
    assert extent == pytest.approx(path.get_extents().extents, abs=1e-3)
    assert {letter for letter, _ in contour} <= {"M", "L", "C", "Z"}


def test_a_curve_ends_where_the_font_has_its_end() -> None:
    (contour, _), *_ = letters_of(["$o$"]).values()
    path = TextPath((0, 0), "$o$", size=LETTERS, prop=FontProperties(math_fontfamily="cm"))
    curves = [(before[-1], *spots) for (_, before), (letter, spots) in pairwise(contour) if letter == "C"]
    middles = [[(a[k] + 3 * b[k] + 3 * c[k] + d[k]) / 8 for k in (0, 1)] for a, b, c, d in curves]
    ours = [bezier(0.5) for bezier, code in path.iter_bezier() if code == path.CURVE3]
    assert len(ours) == len(middles) > 0
    for one, other in zip(middles, ours, strict=True):
        assert one == pytest.approx(list(other), abs=1e-3)


def test_letters_are_data_of_json() -> None:
    known = letters_of(TEXTS)
    assert json.loads(json.dumps(known)) == {text: json.loads(json.dumps(each)) for text, each in known.items()}
    assert list(known) == sorted(TEXTS)


def test_setting_letters_starts_no_thread_and_no_window() -> None:
    """A process that will be forked draws letters, so it must not start threads."""
    program = (
        "import sys, os; from derive.render.drawing.lettering import letters_of; letters_of(['$x$']); "
        "alone = not os.path.isdir('/proc/self/task') or len(os.listdir('/proc/self/task')) == 1; "
        "sys.exit(not alone or 'matplotlib.pyplot' in sys.modules or 'matplotlib.figure' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-P", "-c", program], cwd=ROOT).returncode == 0
