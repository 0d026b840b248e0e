"""A substitute for the workers of a build, for tests that are about something else."""

from __future__ import annotations

import heapq
import pickle
import sys
import time
from collections.abc import Iterator
from contextlib import redirect_stdout
from traceback import format_exc
from typing import Any
from unittest.mock import patch

from derive.building.workers import Bug, Crew, Job, Outcome
from derive.errors import DeriveError


class InThisProcess(Crew):
    """A substitute for the workers: each job runs in this process, because a fork of the large process of the tests
    takes longer than the job. Limits of time and memory do not apply."""

    def start(self) -> None:
        """Start nothing: a job runs when its outcome is asked for."""

    def outcomes(self) -> Iterator[Outcome]:
        while self._waiting:
            job = heapq.heappop(self._waiting)[2]
            self._tick({job.name: 0.0})
            began = time.monotonic()
            value, error = self._result(job)
            yield Outcome(job, pickle.loads(pickle.dumps(value)), error, time.monotonic() - began)

    def _result(self, job: Job) -> tuple[Any, DeriveError | Bug | None]:
        with redirect_stdout(sys.stderr), patch("tempfile.tempdir", self._scratch.name):
            try:
                return job.work(), None
            except DeriveError as stopped:
                return None, stopped
            except Exception as bug:
                return None, Bug(f"{type(bug).__name__}: {bug}", format_exc())
