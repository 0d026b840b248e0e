"""Workers: what they return and raise comes back, and whatever ends them is told; none outlives its parent."""

from __future__ import annotations

import fcntl
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

import pytest

from derive.building.workers import (
    Bug,
    Crew,
    Job,
    attempt,
    done,
    job_of,
    memory_limit,
    overtaxed,
    too_long,
    under_way,
)
from derive.errors import BuildFailed, Complaint, DeriveError, Misused
from tests.courses import ROOT


def test_a_worker_that_takes_too_much_memory_is_told_with_its_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DERIVE_MEMORY", "0.5")
    with pytest.raises(BuildFailed, match=r"error\[memory-limit\]: `greedy` took more than 0.5 GiB of memory"):
        done(Job("`greedy`", lambda: bytearray(10**9)))


@pytest.mark.parametrize("text", ["much", "0.1", "-1", "1e3", "nan", "4 GiB"])
def test_a_memory_limit_that_is_none_is_misuse(monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    monkeypatch.setenv("DERIVE_MEMORY", text)
    with pytest.raises(Misused, match="DERIVE_MEMORY must be a number of GiB from"):
        memory_limit()


def imported_loop(folder: Path, body: str) -> Callable[[], Any]:
    script = folder / "problems" / "hw1" / "block.py"
    script.parent.mkdir(parents=True, exist_ok=True)
    script.write_text(f"import ctypes, os, signal\n\n\ndef solve():\n    {body}\n")
    spec = spec_from_file_location("block", script)
    assert spec
    assert spec.loader
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    solve: Callable[[], Any] = module.solve
    return solve


@pytest.mark.parametrize(
    ("body", "code"),
    [
        ("while True: pass", "time-limit"),
        ("return bytearray(10**11)", "memory-limit"),
        ("return solve()", "too-deep"),
        ("ctypes.string_at(0)", "worker-died"),
    ],
)
def test_a_worker_that_gives_no_answer_is_told_at_the_line_of_its_script(tmp_path: Path, body: str, code: str) -> None:
    with pytest.raises(BuildFailed) as caught:
        done(job_of(tmp_path, "hw1/block", imported_loop(tmp_path, body), 1))
    (complaint,) = caught.value.complaints
    assert complaint.code == code
    place = complaint.place
    assert place
    assert (place.path, place.line, place.text.strip()) == ("problems/hw1/block.py", 5, body)


def test_what_a_document_states_is_blamed_on_its_own_file(tmp_path: Path) -> None:
    folder = tmp_path / "problems" / "hw1" / "topic"
    folder.mkdir(parents=True)
    (folder / "block.yaml").write_text("")
    job = job_of(tmp_path, "hw1/block", lambda: None, 1)
    lines = ("/x/sympy/core/mul.py", "/x/derive/course/reference/agreement.py")
    trace = "".join(f'  File "{line}", line 7 in x\n' for line in lines)

    def blamed(trace: str) -> list[str]:
        told = [too_long(job, trace), overtaxed(job, "too-deep", trace), overtaxed(job, "memory-limit", trace)]
        return sorted({complaint.place.path for each in told for complaint in each.complaints if complaint.place})

    own = "problems/hw1/topic/block.yaml"
    assert blamed(trace) == [own], "it states something in its own file"
    (folder.parent / "reference.yaml").write_text("")
    assert blamed(trace) == ["problems/hw1/reference.yaml"]
    assert blamed("") == [own]
    assert blamed(f'  File "{folder}/block.py", line 1 in solve\n{trace}') == ["problems/hw1/topic/block.py"]


def test_a_recursion_says_where_it_began() -> None:
    def deep(n: int) -> int:
        return deep(n + 1)

    def where_it_began() -> int:
        return deep(0)

    ours, theirs = os.pipe()
    assert attempt(Job("a recursion", where_it_began), theirs) == (None, "too-deep")
    told = os.read(ours, 1 << 16).decode()
    assert told.count("test_workers.py") > 80
    lines = [line for line in told.splitlines() if "test_workers.py" in line]
    assert lines[0] != lines[-1]
    os.close(ours)
    os.close(theirs)


def test_a_worker_that_is_killed_is_told_with_its_file(tmp_path: Path) -> None:
    with pytest.raises(BuildFailed) as caught:
        done(job_of(tmp_path, "hw1/block", lambda: os.kill(os.getpid(), 9)))
    assert str(caught.value).startswith("problems/hw1/block.yaml:1:1: error[worker-died]: `hw1/block` ended")


def test_what_the_system_is_short_of_is_a_complaint() -> None:
    def short() -> None:
        raise OSError(24, "Too many open files")

    with pytest.raises(BuildFailed, match=r"error\[system\]: the system refuses: too many files are open"):
        done(Job("x", short))


def test_a_value_that_cannot_cross_to_the_parent_is_a_bug_and_no_hang() -> None:
    with pytest.raises(Bug):
        done(Job("x", lambda: lambda: None))


def test_an_interrupt_during_a_fork_is_not_lost() -> None:
    code = (
        "import os, signal\n"
        "from derive.building.workers import Job, done\n"
        "os.register_at_fork(before=lambda: os.kill(os.getpid(), signal.SIGINT))\n"
        "try: done(Job('x', lambda: 1)); print('lost')\n"
        "except KeyboardInterrupt: print('heard')\n"
    )
    run = subprocess.run([sys.executable, "-P", "-c", code], capture_output=True, text=True, cwd=ROOT)
    assert run.stdout == "heard\n"


def test_a_worker_does_not_hold_the_lock_of_its_build(tmp_path: Path) -> None:
    held: list[bool] = []
    with open(tmp_path / "lock", "w") as lock:
        code = "import fcntl, sys; fcntl.lockf(open(sys.argv[1], 'w'), fcntl.LOCK_EX | fcntl.LOCK_NB)"
        probe = [sys.executable, "-P", "-c", code, str(tmp_path / "lock")]

        def while_it_works(_: list[str]) -> None:
            fcntl.lockf(lock, fcntl.LOCK_EX)
            held.append(subprocess.run(probe, capture_output=True).returncode != 0)
            fcntl.lockf(lock, fcntl.LOCK_UN)
            held.append(subprocess.run(probe, capture_output=True).returncode != 0)

        fcntl.lockf(lock, fcntl.LOCK_EX)
        with Crew(2, while_it_works) as crew:
            crew.put(Job("sleeper", lambda: time.sleep(60)))
            crew.put(Job("next", lambda: None))
            waiting = crew.outcomes()
            assert next(waiting).job.name == "next"
    assert held[:2] == [True, False]


def test_a_worker_returns_its_value_and_raises_its_complaint() -> None:
    assert done(Job("sum", lambda: sum(range(10**5)))) == sum(range(10**5))

    def refuse() -> None:
        raise DeriveError(Complaint("no", "not today"))

    with pytest.raises(DeriveError, match="not today"):
        done(Job("refusal", refuse))
    with pytest.raises(Bug, match="KeyError"):
        done(Job("bug", lambda: {}["x"]))


def test_who_waits_is_told_for_how_long_each_job_has_run() -> None:
    told: list[dict[str, float]] = []
    with Crew(2, lambda running: told.append(dict(running))) as crew:
        for name, seconds in (("long", 0.6), ("short", 0.2)):
            crew.put(Job(name, lambda seconds=seconds: time.sleep(seconds)))
        assert len(list(crew.outcomes())) == 2
    assert told[0].keys() == {"long", "short"}
    assert told[-1].keys() == {"long"} and told[-1]["long"] > 0.4


def test_what_is_under_way_is_named_as_its_set_names_it_and_the_longest_first() -> None:
    running = {"`hw9/top`": 0.6, "the pages of `hw9/block`": 12.3}
    assert under_way(running, "hw9") == "pages of block 12 s, top 1 s"
    assert under_way(running) == "pages of hw9/block 12 s, hw9/top 1 s"


def test_what_waits_begins_by_its_rank_and_then_in_its_order() -> None:
    with Crew(1) as crew:
        for name, rank in (("b", 0.0), ("c", 0.0), ("d", 1.0), ("a", -1.0)):
            crew.put(Job(name, lambda: None, rank=rank))
        begun = []
        for outcome in crew.outcomes():
            begun.append(outcome.job.name)
            if outcome.job.name == "b":
                crew.put(Job("at once", lambda: None, rank=-2.0))
    assert begun == ["a", "b", "at once", "c", "d"]


def test_what_a_killed_worker_leaves_behind_goes_with_its_crew(tmp_path: Path) -> None:
    note = tmp_path / "name"

    def work() -> None:
        note.write_text(tempfile.mkdtemp())
        time.sleep(60)

    with Crew(1) as crew:
        crew.put(Job("sleeper", work))
        crew.start()
        while not (note.is_file() and note.read_text()):
            time.sleep(0.02)
        left = Path(note.read_text())
        assert left.is_dir()
    assert not left.exists()


def test_a_large_value_comes_back_whole() -> None:
    assert len(done(Job("large", lambda: "x" * 3_000_000))) == 3_000_000


def test_killing_a_worker_takes_its_programs_along(tmp_path: Path) -> None:
    note = tmp_path / "pid"

    def work() -> None:
        program = subprocess.Popen(["sleep", "60"])
        note.write_text(str(program.pid))
        program.wait()

    with pytest.raises(BuildFailed, match="time-limit"):
        done(Job("sleeper", work, limit=1))
    assert is_gone(int(note.read_text()))


@pytest.mark.parametrize("body", ["time.sleep(60)", "3 ** (10**9)"])
def test_workers_end_with_a_parent_that_is_killed(tmp_path: Path, body: str) -> None:
    """Also in the middle of one instruction, beside which no thread of Python runs."""
    note = tmp_path / "pid"
    code = (
        "import os, pathlib, sys, time\n"
        "from derive.building.workers import Job, done\n"
        "def work():\n"
        "    pathlib.Path(sys.argv[1]).write_text(str(os.getpid()))\n"
        f"    {body}\n"
        "done(Job('sleeper', work))\n"
    )
    parent = subprocess.Popen([sys.executable, "-P", "-c", code, str(note)])
    for _ in range(500):
        if note.is_file() and note.read_text():
            break
        time.sleep(0.02)
    parent.send_signal(signal.SIGKILL)
    parent.wait()
    assert is_gone(int(note.read_text()))


def is_gone(pid: int, seconds: float = 10) -> bool:
    for _ in range(max(1, round(seconds / 0.02))):
        try:
            os.kill(pid, 0)
        except ProcessLookupError:
            return True
        if Path(f"/proc/{pid}/stat").is_file() and Path(f"/proc/{pid}/stat").read_text().split(") ")[1][0] == "Z":
            return True
        time.sleep(0.02)
    return False
