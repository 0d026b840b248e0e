"""A worker as the server sees it: it stays warm, and one that hangs or dies is replaced."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from derive.preview.worker_control import Shown, Warm
from tests.building.test_workers import is_gone
from tests.courses import PINNED, ROOT, course_in

ENDLESS = "while True:\n        pass"
DYING = "import os\n\n    os._exit(1)"
GREEDY = "bytearray(10**11)"
DEEP = "deep = lambda: deep()\n    deep()"
# In one instruction of the interpreter, beside which no thread of it runs.
BUSY = "3 ** (10**9)"


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Warm]:
    asked = Warm(course_in(tmp_path_factory.mktemp("course")), limit=30)
    yield asked
    asked.end()


@pytest.fixture
def warm(shared: Warm) -> Warm:
    """One for all tests here, since a process takes a second to start; each test begins with the good script."""
    begins_with(shared, "")
    shared.limit = 30
    return shared


def begins_with(warm: Warm, lines: str) -> None:
    good = (PINNED / "block.py").read_text()
    head = re.search(r"def solve\(.*?\):\n", good, re.DOTALL)
    assert head
    bad = f"{good[: head.end()]}    {lines}\n{good[head.end() :]}"
    (warm.root / "problems" / "hw9" / "block.py").write_text(bad if lines else good)


def asked(warm: Warm) -> Shown:
    shown = warm.page("hw9/block", None)
    assert shown is not None
    return shown


def test_one_process_answers_one_question_after_another(warm: Warm) -> None:
    assert asked(warm).main
    first = warm._worker
    assert asked(warm).main and warm._worker is first


@pytest.mark.parametrize(
    ("lines", "code", "said"),
    [
        (ENDLESS, "time-limit", "`hw9/block` took over 1 s"),
        (BUSY, "time-limit", "`hw9/block` took over 1 s of processor time"),
        (GREEDY, "memory-limit", "`hw9/block` took more than 0.5 GiB of memory"),
        (DEEP, "script", "the script failed: RecursionError"),
        (DYING, "worker-died", "`hw9/block` ended without a message: exit code 1"),
    ],
)
def test_what_gives_no_answer_is_told_at_its_line_as_in_a_build_and_the_next_question_is_answered(
    warm: Warm, monkeypatch: pytest.MonkeyPatch, lines: str, code: str, said: str
) -> None:
    if code == "memory-limit":
        monkeypatch.setenv("DERIVE_MEMORY", "0.5")
        warm._end()
    warm.limit = 1 if code == "time-limit" else 30
    begins_with(warm, lines)
    (complaint,) = asked(warm).complaints
    assert f"error[{code}]: {said}" in complaint
    place = "problems/hw9/block.yaml:1:1:" if code == "worker-died" else "problems/hw9/block.py:"
    assert complaint.startswith(place)
    warm.limit = 30
    begins_with(warm, "")
    assert asked(warm).main


def test_a_script_that_reads_or_writes_whatever_is_open_disturbs_no_answer(warm: Warm) -> None:
    begins_with(warm, "import os, sys\n    print('chatter')\n    os.write(1, b'{}\\n')\n    sys.stdin.read()")
    assert asked(warm).main


@pytest.mark.parametrize("garbage", ['{"number": 7, "main": "x"}\\n', pytest.param("chatter", marks=pytest.mark.long)])
def test_what_a_script_writes_into_a_descriptor_is_no_answer(warm: Warm, garbage: str) -> None:
    write = "for each in range(3, 40):\n        try: os.write(each, b'" + garbage + "')\n        except OSError: pass"
    begins_with(warm, f"import os\n    {write}")
    assert "`hw9/block` has written into the file descriptor" in asked(warm).complaints[0]
    begins_with(warm, "")
    assert asked(warm).main


@pytest.mark.long
def test_half_an_answer_is_not_waited_for_without_end(warm: Warm) -> None:
    warm.limit = 1
    half = "for each in range(3, 40):\n        try: os.write(each, b'half')\n        except OSError: pass"
    begins_with(warm, f"import os\n    {half}\n    {ENDLESS}")
    assert "`hw9/block` has written into the file descriptor" in asked(warm).complaints[0]


def test_after_its_end_there_is_no_worker_and_no_answer(tmp_path: Path) -> None:
    warm = Warm(course_in(tmp_path), limit=30)
    begins_with(warm, ENDLESS)
    found: list[Shown | None] = []
    thread = threading.Thread(target=lambda: found.append(warm.page("hw9/block", None)))
    thread.start()
    time.sleep(1)
    worker = warm._worker
    warm.end()
    thread.join(10)
    assert found == [None]
    assert worker and is_gone(worker.process)
    assert warm.page("hw9/block", None) is None
    assert warm._worker is None


@pytest.mark.long
def test_with_too_few_descriptors_there_is_a_complaint_and_none_is_lost(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    warm = Warm(course_in(tmp_path), limit=30)

    def refused(*_: object, **__: object) -> None:
        raise OSError(24, "Too many open files")

    before = len(os.listdir("/proc/self/fd"))
    monkeypatch.setattr(subprocess, "Popen", refused)
    assert "too many files are open" in asked(warm).complaints[0]
    monkeypatch.undo()
    pipes = iter([os.pipe(), os.pipe()])
    monkeypatch.setattr(os, "pipe", lambda: next(pipes, None) or refused())
    assert "too many files are open" in asked(warm).complaints[0]
    monkeypatch.undo()
    assert len(os.listdir("/proc/self/fd")) == before
    assert asked(warm).main
    warm.end()


# A server with a worker at work, of which it says the number.
SERVER = """
import sys, threading, time
from pathlib import Path
from derive.preview.worker_control import Warm
warm = Warm(Path(sys.argv[1]), 60)
threading.Thread(target=lambda: warm.page("hw9/block", None), daemon=True).start()
time.sleep(1.5)
print(warm._worker.process, flush=True)
time.sleep(60)
"""


@pytest.mark.long
@pytest.mark.parametrize(("lines", "signum"), [(ENDLESS, signal.SIGHUP), (BUSY, signal.SIGKILL)])
def test_a_worker_ends_with_a_server_that_is_killed(tmp_path: Path, signum: int, lines: str) -> None:
    begins_with(Warm(course_in(tmp_path), limit=60), lines)
    command = [sys.executable, "-P", "-c", SERVER, str(tmp_path)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout
        worker = int(server.stdout.readline())
        assert not is_gone(worker, 0.1)
        server.send_signal(signum)
    assert is_gone(worker)


def test_what_is_idle_by_a_newer_edit_is_given_up(warm: Warm) -> None:
    begins_with(warm, ENDLESS)
    assert warm.page("hw9/block", None, lambda: True) is None
