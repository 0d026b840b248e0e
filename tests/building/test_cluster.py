"""The documents of a class on a cluster: the same files, also if a worker is lost."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from concurrent import futures
from pathlib import Path

import pytest

from derive.building.classes import Student, made_class
from derive.building.cluster import INSTALL, Cluster
from derive.building.workers import Job
from derive.errors import BuildFailed, Misused
from tests.course.test_variants import bead


def test_without_the_client_of_dask_the_error_names_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    bead(tmp_path, "{b: [10 cm, 20 cm]}")
    with pytest.raises(Misused) as caught:
        made_class(tmp_path, "week1", [Student("Ada", "A1")], scheduler="tcp://127.0.0.1:1")
    assert caught.value.complaints[0].help == INSTALL


def test_a_scheduler_that_is_lost_is_an_error_with_its_address() -> None:
    class Lost:
        def exception(self) -> None:
            """Return None, as Dask does for a cancelled job."""

        def result(self) -> None:
            raise futures.CancelledError

    cluster, lost = Cluster.__new__(Cluster), Lost()
    cluster._address, cluster._tick, cluster._ended = "tcp://127.0.0.1:1", lambda _: None, iter([lost])
    cluster._jobs = {lost: (Job("x", dict), 0.0)}
    with pytest.raises(BuildFailed, match=r"the connection to the scheduler `tcp://127\.0\.0\.1:1` was lost"):
        next(cluster.outcomes())


@pytest.mark.long
@pytest.mark.filterwarnings("default")
def test_a_class_is_complete_after_one_of_two_workers_was_killed(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    bead(tmp_path, "{b: [10 cm, 16 cm, 27 cm, 33 cm, 48 cm, 54 cm]}")
    students = [Student(f"Student {number}", f"S{number}") for number in range(24)]
    cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None)
    made = tmp_path / "build" / "week1" / "class" / ".made"

    killed: list[int] = []

    def kill_one() -> None:
        until = time.monotonic() + 60
        while not made.is_dir() and time.monotonic() < until:
            time.sleep(0.05)
        killed.append(next(iter(cluster.workers.values())).pid)
        os.kill(killed[0], signal.SIGKILL)

    killer = threading.Thread(target=kill_one, daemon=True)
    killer.start()
    with cluster:
        report = made_class(tmp_path, "week1", students, scheduler=cluster.scheduler_address)
    killer.join()
    assert killed and (report.made, report.complaints, report.bugs) == (24, [], [])
    assert len(list((tmp_path / "build" / "week1" / "students").glob("*.pdf"))) == 24
    assert made_class(tmp_path, "week1", students, jobs=1).made == 0, "a run on this machine finds nothing to do"
