"""The tests also pass if interrupts are ignored, as in processes that a script starts in the background."""

from __future__ import annotations

import signal
import subprocess
import sys

import pytest

from tests.courses import ROOT


def test_an_interrupt_reaches_what_the_tests_start() -> None:
    assert signal.getsignal(signal.SIGINT) != signal.SIG_IGN


@pytest.mark.long
def test_tests_that_interrupt_pass_where_an_interrupt_is_ignored() -> None:
    test = "tests/test_interrupted.py::test_an_interrupt_reaches_what_the_tests_start"
    inner = f"{sys.executable} -P -m pytest -q -p no:cacheprovider {test}"
    run = subprocess.run(["bash", "-c", f"trap '' INT; exec {inner}"], cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 0, run.stdout
