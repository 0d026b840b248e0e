"""The server of a preview: what it serves, to whom, and how it tells of edits."""

from __future__ import annotations

import json
import socket
import struct
import threading
import time
from base64 import b64encode
from collections.abc import Callable, Generator, Iterator
from contextlib import ExitStack, closing, suppress
from hashlib import sha256
from http.client import HTTPConnection, RemoteDisconnected
from typing import Any

import pytest

from derive.errors import BuildFailed
from derive.preview.server import HOST, MOST, Pages, Server, policy_of, server
from derive.preview.worker_control import Shown
from tests.waiting import until

FAULT = Shown(complaints=("block.yaml:3:1: error[wrong-kind]",))


class StandIn:
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


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "localhost:8311", "LOCALHOST", "127.0.0.1:80"])
def test_a_browser_of_this_machine_is_answered_with_the_port_and_without(served: Server, host: str) -> None:
    assert got(served, "/", host)[0] == 200


@pytest.mark.parametrize(
    "host",
    [
        "elsewhere.example",
        "elsewhere.example:80",
        "127.0.0.1.elsewhere.example:1",
        "",
        "localhost.elsewhere.example",
        "127.0.0.1@elsewhere.example",
        "localhost:",
        "localhost:x",
        "[::1]",
        "127.0.0.1:1:2",
    ],
)
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


# --- who leaves, who is slow, who are many ---


def opened(served: Server, said: bytes = b"") -> socket.socket:
    connection = socket.create_connection(served.server_address[:2], timeout=10)  # type: ignore[arg-type]
    connection.sendall(said)
    return connection


def busy(served: Server) -> int:
    return MOST - served._free._value


def test_half_a_request_is_not_waited_for_however_it_trickles(served: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("derive.preview.server.PROMPT", 0.5)
    with opened(served, b"GET / HTTP/1.1\r\n") as connection:
        started = time.monotonic()
        with suppress(ConnectionError):
            while time.monotonic() - started < 5:
                connection.sendall(b"x")
                time.sleep(0.05)
        assert time.monotonic() - started < 3
    until(lambda: busy(served) == 0)


@pytest.mark.long
def test_many_who_ask_nothing_hold_few_threads_and_keep_nobody_out_for_long(
    served: Server, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("derive.preview.server.PROMPT", 4.0)
    with ExitStack() as many:
        for _ in range(3 * MOST):
            many.enter_context(opened(served, b"GET / HTTP/1.1\r\nHost: loc"))
        until(lambda: busy(served) == MOST)
        until(lambda: busy(served) == 0)
        assert got(served, "/")[0] == 200


def test_a_browser_that_leaves_in_the_middle_is_no_traceback(
    served: Server, pages: Pages, worker: StandIn, capfd: pytest.CaptureFixture[str]
) -> None:
    worker.shown = Shown("x" * 10**7)
    for path in ("/block.html", "/block/events", "/nothing"):
        connection = opened(served, f"GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))  # as one that is killed
        connection.close()
    pages.edited()
    until(lambda: busy(served) == 0)
    assert capfd.readouterr() == ("", "")


def test_what_nobody_foresaw_is_told_in_a_line(
    served: Server, pages: Pages, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    told: list[Shown] = []
    pages.told = lambda name, shown: told.append(shown)
    monkeypatch.setattr(served.RequestHandlerClass, "whole", staticmethod(lambda name, main: 1 / 0))
    with pytest.raises(RemoteDisconnected):
        got(served, "/")
    assert told[-1].complaints == ("internal error: ZeroDivisionError: division by zero",)
    assert capfd.readouterr() == ("", "")


def test_a_template_that_cannot_be_read_is_an_answer(served: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(name: str, main: str) -> str:
        raise OSError(24, "Too many open files")

    monkeypatch.setattr(served.RequestHandlerClass, "whole", staticmethod(refused))
    status, said = got(served, "/")
    assert status == 503
    assert "too many files are open" in said


# --- what a page may do ---


def test_a_page_may_run_its_own_scripts_and_none_that_came_with_its_main_part() -> None:
    policy = policy_of("<style>p {}</style><script>\nshow()\n</script>")
    assert "default-src 'none'" in policy and "connect-src 'self'" in policy
    digest = b64encode(sha256(b"\nshow()\n").digest()).decode()
    assert f"script-src 'sha256-{digest}';" in policy
    assert "script-src 'none'" in policy_of("<p>none</p>")
    assert "unsafe-inline" not in policy.partition("script-src")[2].partition(";")[0]


def test_every_answer_has_a_policy(served: Server, worker: StandIn) -> None:
    worker.shown = Shown("<h1>first</h1><script>taken()</script>")
    for path in ("/", "/nothing"):
        with closing(HTTPConnection(HOST, served.server_address[1], timeout=5)) as connection:
            connection.request("GET", path)
            with connection.getresponse() as response:
                policy = response.headers["Content-Security-Policy"]
        assert policy.startswith("default-src 'none'")
        assert "sha256" not in policy
