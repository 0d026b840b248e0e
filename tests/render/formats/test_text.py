"""Tests of the page for a terminal, whose module is imported only when a page is rendered."""

from __future__ import annotations

import subprocess
import sys
from types import SimpleNamespace
from typing import Any

from derive.render.formats.text import FORMAT
from derive.render.printing.text_page import page_text
from tests.courses import ROOT
from tests.render.pages import NOTATION, WHOLE, WORDS


def test_a_page_is_rendered_as_a_terminal_shows_it() -> None:
    solution: Any = SimpleNamespace(document=WHOLE, words=WORDS, notation=NOTATION)
    assert FORMAT.render(solution) == page_text(WHOLE, WORDS, NOTATION)
    assert FORMAT.render(solution).endswith("Nothing.\n")


def test_to_list_the_formats_needs_no_mathematics() -> None:
    program = "import sys; from derive.render.formats import formats; formats(); sys.exit('sympy' in sys.modules)"
    run = subprocess.run([sys.executable, "-P", "-c", program], cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
