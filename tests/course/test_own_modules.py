"""Modules beside a script: found by what is imported, read anew each time, and no stand-in for a package."""

from __future__ import annotations

import sys
from pathlib import Path

from derive.course.own_modules import importable, own_modules


def folder(at: Path, **files: str) -> Path:
    for name, text in files.items():
        file = at / f"{name.replace('__', '/')}.py"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
    return at / "script.py"


def test_what_is_imported_is_found_wherever_it_is_imported(tmp_path: Path) -> None:
    text = "import sympy, one.two\n\n\ndef solve():\n    from two import x\n    from . import three\n"
    script = folder(tmp_path, script=text, one="import four, script", two="(", three="", four="", five="", six__in="")
    assert [file.stem for file in own_modules(script)] == ["four", "one", "two"]
    script.write_text("import six")
    assert own_modules(script) == (tmp_path / "six" / "in.py",)
    assert own_modules(tmp_path / "none.py") == ()


def test_each_time_it_is_read_anew_and_nothing_is_left(tmp_path: Path) -> None:
    script = folder(tmp_path, script="import helper_of_a_test", helper_of_a_test="X = 1")
    modules, path = own_modules(script), [*sys.path]
    for x in (1, 2):
        folder(tmp_path, helper_of_a_test=f"X = {x}")
        with importable(script, modules):
            assert x == __import__("helper_of_a_test").X
        assert "helper_of_a_test" not in sys.modules
    assert sys.path == path
    assert not [*tmp_path.rglob("*.pyc")]


def test_a_problem_called_as_a_package_does_not_stand_for_it(tmp_path: Path) -> None:
    script = folder(tmp_path, script="import wave", wave="X = 1")
    sys.modules.pop("wave", None)
    with importable(script, own_modules(script)):
        assert not hasattr(__import__("wave"), "X")
