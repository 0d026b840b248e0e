"""`derive clean` and `derive doctor`."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from derive.cli.options import main
from tests.fake_course import Course


def test_clean_takes_away_what_builds_made(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["build", "--engine", "pdflatex", "hw1"]) == 0
    capfd.readouterr()
    assert main(["clean", "--cache", "build/hw1/"]) == 0
    out, err = capfd.readouterr()
    assert re.fullmatch(r"removed .*build/hw1/\.derived \(\d+\.\d MB\)\n", out)
    assert err == ""
    assert (course.outputs / "one.pdf").exists()
    assert not (course.outputs / ".derived").exists()
    assert main(["build", "--engine", "pdflatex", "hw1"]) == 0, "which still knows that all is current"
    assert main(["clean"]) == 0
    assert not course.outputs.exists()
    assert (course.root / "problems" / "hw1").exists()
    capfd.readouterr()
    assert main(["clean"]) == 0
    assert capfd.readouterr() == ("", "")


def test_clean_knows_no_set_of_another_name(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["clean", "hw"]) == 2
    assert "error[no-such-set]: no set is called `hw`, and `build` has no folder of this name" in capfd.readouterr().err


def test_doctor_names_the_engine_and_where_it_is(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["doctor"]) == 0
    out = capfd.readouterr().out
    assert f"pdflatex from PATH, {Path('bin/pdflatex')}" in out
    assert "problems, with hw1" in out
    assert "build can be written" in out


def test_doctor_says_what_is_missing_with_the_mend(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["doctor", "--engine", "tectonic"]) == 1
    assert "no  TeX       the TeX engine `tectonic` is not installed\n" in capfd.readouterr().out
    (course.root / "build").rmdir()
    (course.root / "build").write_text("")
    assert main(["doctor"]) == 1
    assert "no  outputs" in capfd.readouterr().out


def test_doctor_tries_the_engine(course: Course, capfd: pytest.CaptureFixture[str]) -> None:
    (course.root / "bin" / "pdflatex").write_text("#!/bin/sh\nexit 1\n")
    assert main(["doctor"]) == 1
    assert "no  test page TeX failed" in capfd.readouterr().out
