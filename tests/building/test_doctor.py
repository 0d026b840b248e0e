"""What the doctor finds: each thing that a build needs, with the fix where it is missing."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building import doctor
from derive.building.doctor import Finding, findings
from tests.fake_course import Course, stand_in_course


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Course:
    return stand_in_course(tmp_path, monkeypatch)


def found(course: Course, engine: str | None = None) -> dict[str, Finding]:
    return {finding.what: finding for finding in findings(course.root, engine)}


def test_a_machine_that_can_build_has_nothing_to_mend(course: Course) -> None:
    names = ["Python", "packages", "templates", "TeX", "test page", "problems", "outputs"]
    assert {name: finding.good for name, finding in found(course).items() if name} == dict.fromkeys(names, True)
    assert found(course)["problems"].found.endswith("problems, with hw1")


def test_a_package_that_is_missing_is_named(course: Course, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doctor, "PACKAGES", ("sympy", "no-such-package"))
    finding = found(course)["packages"]
    assert (finding.good, finding.fix) == (False, "missing: no-such-package; run `make`")
    assert finding.found.startswith("sympy 1.")


def test_an_engine_that_is_there_but_makes_no_pdf_is_found_out(course: Course) -> None:
    (course.root / "bin" / "pdflatex").write_text("#!/bin/sh\nexit 1\n")
    assert [found(course)[name].good for name in ("TeX", "test page")] == [True, False]


def test_an_engine_that_is_not_there_is_tried_no_further(course: Course) -> None:
    engines = found(course, "tectonic")
    assert not engines["TeX"].good
    assert "test page" not in engines


def test_a_folder_without_problems_and_one_that_cannot_be_written_are_told(course: Course) -> None:
    (course.root / "build").write_text("a file")
    assert not found(course)["outputs"].good
    (course.folder / "set.yaml").unlink()
    assert found(course)["problems"].found.endswith("with no set")
    assert [(f.what, f.good) for f in findings(None, None)][-1] == ("problems", False)


def test_a_mend_is_shown_only_where_something_is_wrong() -> None:
    assert Finding("TeX", True, "there", "fix").shown() == "ok  TeX       there"
    assert Finding("TeX", False, "none", "fix").shown() == "no  TeX       none\n              fix"
