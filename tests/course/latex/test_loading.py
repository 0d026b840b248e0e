"""The LaTeX reader is loaded only by what reads LaTeX, and the code that draws only by what draws."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from derive.building.cache import Cache
from derive.building.solution import rendered
from tests.courses import ROOT, course_in

REFERENCE = r"""
- problem: body
  symbols: {R: length, M: mass, h: length}
  given: {radius: R, height: h, mass: M}
  entries: [{answer: about_x, latex: '\frac{2}{5} M R^2'}]
"""

LOADED = """
import sys
from pathlib import Path
from derive.building.cache import NO_CACHE, Cache
from derive.building.solution import rendered

root = Path(sys.argv[1])
for kept, reference in ((Cache(root / "kept"), True), (NO_CACHE, False), (NO_CACHE, True)):
    text = (root / "reference.yaml").read_text()
    (root / "problems/hw9/reference.yaml").write_text(text if reference else "[]")
    found = rendered(root, "hw9/body", None, kept)
    assert found.agreed and not found.files
    assert "matplotlib" not in sys.modules and "numpy" not in sys.modules
    print(any(name.startswith(("derive.course.latex", "derive.documents")) for name in sys.modules))
"""


def test_what_is_kept_and_what_has_no_reference_loads_no_grammar_of_latex(tmp_path: Path) -> None:
    edits = {"[first_tensor, about_x, squared_gyration]": "about_x"}
    course_in(tmp_path, edits, {"J, moment, gyration\n    moved": "moment\n    moved"}, problem="body")
    for folder in (tmp_path, tmp_path / "problems" / "hw9"):
        (folder / "reference.yaml").write_text(REFERENCE)
    assert rendered(tmp_path, "hw9/body", None, Cache(tmp_path / "kept")).compared == 1
    done = subprocess.run([sys.executable, "-P", "-c", LOADED, str(tmp_path)], capture_output=True, text=True, cwd=ROOT)
    assert done.stdout.split() == ["False", "False", "True"], done.stderr
