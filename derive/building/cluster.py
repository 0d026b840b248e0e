"""Jobs on a cluster of Dask, in place of processes on this machine.

The workers of the cluster need the same version of derive, and the folder of the course at the same path. Dask repeats
the job of a lost worker on another worker. derive does not limit the time or the memory of these jobs.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent import futures
from contextlib import suppress
from importlib import import_module
from typing import Any

from derive.building.cache import engine_digest
from derive.building.workers import Bug, Job, Outcome
from derive.errors import BuildFailed, Complaint, DeriveError, Misused

INSTALL = "install the client of Dask: `pip install 'derive-mechanics[cluster]'`"
PATIENCE = 15  # seconds to wait for the scheduler and its first worker


class Cluster:
    """The workers of a Dask scheduler such as `tcp://10.0.0.1:8786`; used like `workers.Crew`."""

    def __init__(self, address: str, tick: Callable[[Mapping[str, float]], None]):
        try:
            self._dask = import_module("distributed")
        except ImportError:
            raise Misused(
                Complaint("scheduler", "`--scheduler` needs the package `distributed`", help=INSTALL)
            ) from None
        try:
            self._client = self._dask.Client(address, timeout=PATIENCE, set_as_default=False)
            self._client.wait_for_workers(1, timeout=PATIENCE)
        except (OSError, ValueError, TimeoutError) as error:
            help_line = (
                "name the scheduler as `dask scheduler` shows it, such as tcp://10.0.0.1:8786, and start workers"
            )
            raise Misused(
                Complaint("scheduler", f"no worker of `{address}` answers: {error}", help=help_line)
            ) from None
        logging.getLogger("distributed.client").setLevel(logging.CRITICAL)  # derive reports a lost connection itself
        self._address = address
        self._tick, self._ended = tick, self._dask.as_completed(loop=self._client.loop)
        self._jobs: dict[Any, tuple[Job, float]] = {}

    def __enter__(self) -> Cluster:
        own = engine_digest()
        others = [worker for worker, found in self._client.run(engine_digest).items() if found != own]
        if others:
            self._client.close()
            help_line = "install the same version of derive on each machine"
            message = f"the worker `{others[0]}` has a different version of derive"
            raise Misused(Complaint("scheduler", message, help=help_line))
        return self

    def __exit__(self, *_: object) -> None:
        with suppress(Exception):  # the scheduler may be lost
            self._client.cancel(list(self._jobs))
            self._client.close()

    def put(self, job: Job) -> None:
        future = self._client.submit(job.work, pure=False)
        self._jobs[future] = job, time.monotonic()
        self._ended.add(future)

    def outcomes(self) -> Iterator[Outcome]:
        """Yield the outcome of each job when it ends; jobs may be added meanwhile."""
        while self._jobs:
            future, value, error = self._next()
            job, begun = self._jobs.pop(future)
            now = time.monotonic()
            self._tick({each.name: now - at for each, at in self._jobs.values()})
            yield Outcome(job, value, None if error is None else self._told(job, error), now - begun)

    def _next(self) -> tuple[Any, Any, BaseException | None]:
        """Return the next job that has ended, its value, and its error or None. Raise an error if the connection to the
        scheduler was lost: Dask then cancels all jobs."""
        try:
            future = next(self._ended)
            error = future.exception()
            return future, future.result() if error is None else None, error
        except (futures.CancelledError, asyncio.CancelledError):
            message = f"the connection to the scheduler `{self._address}` was lost"
            help_line = "start the scheduler and its workers again, and repeat the command; finished documents are kept"
            raise BuildFailed(Complaint("scheduler", message, help=help_line)) from None

    def _told(self, job: Job, error: BaseException) -> DeriveError | Bug:
        if isinstance(error, DeriveError):
            return error
        if isinstance(error, self._dask.KilledWorker):
            return BuildFailed(
                Complaint("worker-died", f"{job.name}: each worker of the cluster that began this job was lost")
            )
        return Bug(f"{type(error).__name__}: {error}", "on a worker of the cluster")
