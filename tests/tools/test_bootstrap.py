"""The environment in `.venv`: made once, repaired after an interruption, left alone otherwise.

A stand-in for `uv` makes an environment that is a link to this Python, and notes what it is asked for.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.courses import ROOT

UV = """#!/bin/sh
PATH={path}
case "$1" in
  venv) echo "$1 $2" >> uv.log; mkdir -p .venv/bin && ln -s {python} .venv/bin/python ;;
  pip) shift 4; echo "install $*" >> uv.log
    [ -z "$SLOWLY" ] || sleep 1
    [ -z "$FAILING" ] || {{ echo 'Resolving'; echo 'error: no route to https://host.example/simple/sympy'; exit 2; }} ;;
esac
"""


class Checkout:
    def __init__(self, root: Path):
        self.root = root
        (root / "tools").mkdir()
        shutil.copy(ROOT / "tools" / "bootstrap.py", root / "tools" / "bootstrap.py")
        (root / "locks").mkdir()
        for name in ("pyproject.toml", "locks/runtime.txt", "locks/tests.txt"):
            (root / name).write_text(name)
        (root / "bin").mkdir()
        uv = root / "bin" / "uv"
        uv.write_text(UV.format(path=os.defpath, python=sys.executable))
        uv.chmod(0o755)

    def start(self, stamp: str = ".runtime", **environment: str) -> subprocess.Popen[str]:
        command = [sys.executable, "-I", "tools/bootstrap.py", stamp]
        environment = {"PATH": str(self.root / "bin"), **environment}
        pipe = subprocess.PIPE
        return subprocess.Popen(command, cwd=self.root, env=environment, stdout=pipe, stderr=pipe, text=True)

    def set_up(self, stamp: str = ".runtime", **environment: str) -> tuple[int, str, str]:
        run = self.start(stamp, **environment)
        out, err = run.communicate()
        return run.returncode, out, err

    def asked(self) -> list[str]:
        """What was asked of uv since the last call."""
        log = self.root / "uv.log"
        lines = log.read_text().splitlines() if log.is_file() else []
        log.unlink(missing_ok=True)
        return lines

    def has(self, name: str) -> bool:
        return (self.root / ".venv" / name).exists()


CHECKED = "install --quiet --require-hashes --only-binary :all: --requirement locks/runtime.txt"
INSTALLED = [CHECKED, "install --quiet --no-index --no-deps --no-build-isolation --editable ."]
WITH_TESTS = [f"{CHECKED} --requirement locks/tests.txt", INSTALLED[1]]
MADE = ["venv --quiet", *INSTALLED]


@pytest.fixture
def checkout(tmp_path: Path) -> Checkout:
    return Checkout(tmp_path)


def test_the_environment_is_made_of_packages_whose_digests_are_known(checkout: Checkout) -> None:
    code, out, err = checkout.set_up()
    assert (code, err) == (0, "")
    assert out.splitlines() == [
        f"making .venv with Python {sys.version.split()[0]}",
        "installing SymPy and the TeX engine (once, about 100 MB)",
    ]
    assert checkout.asked() == MADE
    assert checkout.has(".runtime")
    assert not checkout.has(".unfinished")


def test_an_environment_that_fits_is_left_alone(checkout: Checkout) -> None:
    checkout.set_up()
    checkout.asked()
    assert checkout.set_up() == (0, "", "")
    assert checkout.asked() == []


@pytest.mark.parametrize("name", ["pyproject.toml", "locks/runtime.txt", "locks/tests.txt"])
def test_a_change_of_what_is_wanted_installs_into_the_same_environment(checkout: Checkout, name: str) -> None:
    checkout.set_up()
    checkout.asked()
    (checkout.root / name).write_text("changed")
    checkout.set_up()
    assert checkout.asked() == INSTALLED


def test_the_tests_need_more_and_bring_the_rest_along(checkout: Checkout) -> None:
    checkout.set_up(".tests")
    assert checkout.asked()[1:] == WITH_TESTS
    assert checkout.set_up(".runtime") == (0, "", "")
    assert checkout.asked() == []


def test_the_tests_are_added_to_an_environment_without_them(checkout: Checkout) -> None:
    checkout.set_up()
    checkout.asked()
    checkout.set_up(".tests")
    assert checkout.asked() == WITH_TESTS


@pytest.mark.long
def test_a_failed_installation_says_why_without_an_address_and_is_repaired(checkout: Checkout) -> None:
    code, out, err = checkout.set_up(FAILING="yes", PIP_NO_INDEX="yes")
    assert code == 1
    failed = "error[install]: cannot install the packages (run `make` again to retry): "
    assert f"{failed}error: no route to (address)\ntrying pip instead of uv\n" in out
    assert err.startswith(failed + "ERROR: ")
    assert not checkout.has(".runtime")
    checkout.asked()
    assert checkout.set_up()[0] == 0
    assert checkout.asked() == MADE


def test_an_installation_that_was_killed_is_repaired(checkout: Checkout) -> None:
    run = checkout.start(SLOWLY="yes")
    while not checkout.has(".unfinished"):
        assert run.poll() is None
    run.kill()
    run.communicate()
    assert not checkout.has(".runtime")
    checkout.asked()
    assert checkout.set_up()[0] == 0
    assert checkout.asked()[-len(MADE) :] == MADE


def test_an_environment_whose_python_is_gone_is_made_again(checkout: Checkout) -> None:
    checkout.set_up()
    checkout.asked()
    python = checkout.root / ".venv" / "bin" / "python"
    python.unlink()
    python.symlink_to("/no/such/python")
    checkout.set_up()
    assert checkout.asked() == MADE


def test_two_at_once_install_once(checkout: Checkout) -> None:
    first, second = checkout.start(SLOWLY="yes"), checkout.start(SLOWLY="yes")
    said = first.communicate()[0] + second.communicate()[0]
    assert (first.returncode, second.returncode) == (0, 0)
    assert "waiting for another make, which is setting up .venv\n" in said
    assert checkout.asked() == MADE


def test_a_python_without_venv_is_told_with_the_mend(checkout: Checkout) -> None:
    hidden = "import sys, importlib.util as u, runpy; f = u.find_spec\n"
    hidden += "u.find_spec = lambda name, *a: None if name == 'ensurepip' else f(name, *a)\n"
    hidden += "sys.argv = ['bootstrap.py', '.runtime']; sys.executable = '/usr/bin/python3'\n"
    hidden += "runpy.run_path('tools/bootstrap.py', run_name='__main__')"
    command = [sys.executable, "-P", "-c", hidden]
    run = subprocess.run(command, cwd=checkout.root, env={"PATH": "/nowhere"}, capture_output=True, text=True)
    assert run.returncode == 1
    fix = "run `apt install python3-venv` or install uv, and then run `make` again"
    assert run.stderr == f"error[venv]: python3 has no working venv module: {fix}\n"


def test_a_folder_that_cannot_be_written_is_one_line(checkout: Checkout) -> None:
    (checkout.root / ".venv.lock").mkdir()
    code, _, err = checkout.set_up()
    assert code == 1
    assert err.startswith("error[cannot-write]: cannot set up .venv: Is a directory")
    assert err.count("\n") == 1
