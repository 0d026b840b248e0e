"""What is loaded before workers are forked: all of derive and of its packages that a problem needs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.courses import ROOT, course_in

CODE = """
import sys
from pathlib import Path
from derive.building.preload import preload
from derive.render.formats import formats
preload(Path("."), derives=True, draws=True), formats()
before = set(sys.modules)
from derive.building.solution import rendered
assert rendered(Path("."), "hw9/block", draws=True).files
print(*sorted(name for name in set(sys.modules) - before if name.startswith(("derive.", "matplotlib"))))
"""


@pytest.mark.long
def test_a_worker_need_not_load_what_its_parent_has_loaded(tmp_path: Path) -> None:
    course = course_in(tmp_path)
    command, paths = [sys.executable, "-P", "-c", CODE], {"PYTHONPATH": str(ROOT)}
    run = subprocess.run(command, cwd=course, env=paths, capture_output=True, text=True)
    assert (run.stdout.split(), run.stderr) == ([], "")
