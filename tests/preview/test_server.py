"""The server of a preview: what it serves, to whom, and how it tells of edits."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Generator, Iterator
from contextlib import closing
from http.client import HTTPConnection
from typing import Any

import pytest

from derive.errors import BuildFailed
from derive.preview.asking import Shown
from derive.preview.server import HOST, Pages, Server, server

FAULT = Shown(complaints=("block.yaml:3:1: error[wrong-kind]",))


class StandIn:
    """A worker that answers at once, as a test says."""

    def __init__(self) -> None:
        self.shown = Shown("<h1>first</h1>")
        self.asked: list[str] = []

    def page(self, problem_id: str, detail: str | None, idle: Callable[[], bool]) -> Shown:
        self.asked.append(problem_id)
        return self.shown


@pytest.fixture
def worker() -> StandIn:
    return StandIn()


@pytest.fixture
def pages(worker: StandIn) -> Pages:
    stand_in: Any = worker
    return Pages(stand_in, "hw9", {"block", "top"})


@pytest.fixture
def served(pages: Pages) -> Iterator[Server]:
    made = server(pages, lambda name, main: f"<title>{name}</title>{main}", "block", 0)
    threading.Thread(target=made.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True).start()
    yield made
    made.shutdown()
    made.server_close()


def got(served: Server, path: str, host: str | None = None) -> tuple[int, str]:
    connection = HTTPConnection(HOST, served.server_address[1], timeout=5)
    with closing(connection):
        connection.request("GET", path, headers={"Host": host} if host else {})
        response = connection.getresponse()
        return response.status, response.read().decode()


def test_the_first_page_and_those_of_the_set_are_served(served: Server) -> None:
    assert got(served, "/") == (200, "<title>block</title><h1>first</h1>")
    assert got(served, "/top.html")[1].startswith("<title>top</title>")


@pytest.mark.parametrize(
    "path",
    [
        "/set.yaml",
        "/../set.yaml",
        "/%2e%2e/set.yaml",
        "/cone.html",
        "/etc/passwd",
        "/block.py",
        "/cone/events",
    ],
)
def test_nothing_else_is_served(served: Server, path: str) -> None:
    assert got(served, path)[0] == 404


@pytest.mark.parametrize("host", ["elsewhere.example", "elsewhere.example:80", "127.0.0.1.elsewhere.example:1", ""])
def test_a_browser_that_came_by_another_name_is_refused(served: Server, host: str) -> None:
    assert got(served, "/", host or "x")[0] == 403


def events(served: Server, name: str) -> Generator[dict[str, Any], None, None]:
    connection = HTTPConnection(HOST, served.server_address[1], timeout=5)
    with closing(connection):
        connection.request("GET", f"/{name}/events")
        with connection.getresponse() as response:
            for line in response:
                if line.startswith(b"data: "):
                    yield json.loads(line.removeprefix(b"data: "))


def test_whoever_looks_is_told_of_each_edit_and_of_each_fault(served: Server, pages: Pages, worker: StandIn) -> None:
    with closing(events(served, "block")) as told:
        assert next(told)["main"] == "<h1>first</h1>"
        worker.shown = FAULT
        pages.edited()
        assert next(told)["complaints"] == [*FAULT.complaints]
        worker.shown = Shown("<h1>second</h1>")
        pages.edited()
        assert next(told) | {"seconds": 0} == {"main": "<h1>second</h1>", "complaints": [], "seconds": 0}


def test_while_a_file_is_faulty_a_new_window_shows_the_last_good_page(
    served: Server, pages: Pages, worker: StandIn
) -> None:
    got(served, "/")
    worker.shown = FAULT
    pages.edited()
    assert "<h1>first</h1>" in got(served, "/")[1]


def test_what_has_not_changed_is_not_derived_again(served: Server, worker: StandIn) -> None:
    got(served, "/")
    got(served, "/block.html")
    assert worker.asked == ["hw9/block"]


def test_a_port_that_is_taken_is_told_with_what_to_do(served: Server, pages: Pages) -> None:
    with pytest.raises(BuildFailed, match="is taken") as refused:
        server(pages, lambda name, main: main, "block", served.server_address[1])
    assert "--port" in str(refused.value)


def test_it_listens_on_this_machine_alone(served: Server) -> None:
    assert served.server_address[0] == "127.0.0.1"
