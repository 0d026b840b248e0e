"""A set served while it is edited: its files are watched, its pages are made again, and browsers are informed."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Protocol

from watchfiles import watch

from derive.building.set_document import live_page
from derive.building.set_names import check_asked
from derive.course.problem_set import COURSE, problem_set
from derive.errors import DeriveError
from derive.page.template import templates_of
from derive.preview.server import HOST, Pages, Server, server
from derive.preview.worker_control import Shown, Warm


class Ending(Protocol):
    """An event that is set when the preview should end."""

    def is_set(self) -> bool: ...


WRITTEN = (".yaml", ".py", ".j2", ".css", ".js")
SETTLED = 20  # an edit is complete if nothing else changes for this number of milliseconds


def preview(
    root: Path,
    set_id: str,
    name: str,
    port: int,
    detail: str | None,
    limit: float,
    ready: Callable[[str], None],
    told: Callable[[str, Shown], None],
    ending: Ending,
) -> None:
    """Serve the pages of a set until the user interrupts or `ending` is set. The function `ready` is called with the
    address, and `told` with each shown page or its errors."""
    check_asked(root, set_id, [name] if name else ())
    heading = problem_set(root, set_id)
    first = name or heading.problems[0].rpartition("/")[2]
    warm = Warm(root, limit)
    pages = Pages(warm, set_id, {*heading.numbers, first}, detail, told)

    def whole(of: str, main: str) -> str:
        return live_page(root, heading, of, main)

    served = server(pages, whole, first, port)
    try:
        warm.begun()  # the worker loads its modules while the browser is opened
        with _serving(served) as at:
            ready(f"http://{HOST}:{at}/{first}.html")
            for _ in _edits(root, ending):
                with suppress(DeriveError, OSError):  # keep the old heading if the new one cannot be read
                    heading = problem_set(root, set_id)
                pages.names = {*heading.numbers, first}
                pages.edited()
    finally:
        warm.end()


@contextmanager
def _serving(served: Server) -> Iterator[int]:
    """Serve in a second thread, so that the calling thread can watch for edits; yield the port."""
    thread = threading.Thread(target=served.serve_forever, kwargs={"poll_interval": 0.1}, daemon=True)
    thread.start()
    try:
        yield served.server_address[1]
    finally:
        served.shutdown()
        served.server_close()


def _edits(root: Path, ending: Ending) -> Iterator[object]:
    """Yield after each edit of a problem, script or set, of the file of the course, of a template or of a phrase."""
    yield from watch(
        root / "problems",
        *templates_of(root).folders,
        *(each for each in (root / COURSE,) if each.is_file()),
        watch_filter=lambda _, path: path.endswith(WRITTEN),
        step=SETTLED,
        debounce=400,
        stop_event=ending,
    )
