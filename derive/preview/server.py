"""A server for this machine alone: the pages of one set, and their changes while the set is edited.

    /, /index.html    the page that the preview was started for
    /NAME.html        the page of the problem NAME of the set
    /NAME/events      messages to the page NAME.html: its new content, or its errors

Nothing else is served, and no file can be requested by its name. A request that does not use a local name of this
machine is rejected. So no page of another site can read the content of these pages.
"""

from __future__ import annotations

import json
import re
import sys
import threading
import time
from base64 import b64encode
from collections.abc import Callable, Collection
from dataclasses import dataclass, field
from errno import EADDRINUSE
from functools import partial
from hashlib import sha256
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from io import BufferedReader, RawIOBase
from socket import socket
from typing import Any

from derive.building.files import of_system
from derive.errors import BuildFailed, Complaint, DeriveError
from derive.preview.worker_control import Shown, Warm

HOST = "127.0.0.1"
_LOCAL = re.compile(r"(127\.0\.0\.1|localhost)(:\d{1,5})?", re.ASCII | re.IGNORECASE)
ALIVE = 15.0  # seconds after which a message is sent even without news, so that a closed browser is noticed
PROMPT = 5.0  # seconds within which a browser must send the next request on an open connection
TAKEN = 30.0  # seconds within which a browser must receive an answer
MOST = 64  # the largest number of connections at a time; each page open in a browser uses one connection
FULL = 0.1  # seconds to wait for free descriptors
CACHED = "no-store"
NONE = "'none'"
NOTHING_ELSE = "default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"


@dataclass
class Pages:
    """The last pages of a set, and the browsers that wait for new pages."""

    warm: Warm
    set_id: str
    names: Collection[str]
    detail: str | None = None
    told: Callable[[str, Shown], None] = lambda name, shown: None
    _last: dict[str, Shown] = field(default_factory=dict)
    _good: dict[str, str] = field(default_factory=dict)  # for each page, the last `Shown.main` without errors
    _edition: int = 0
    _changed: threading.Condition = field(default_factory=threading.Condition)
    _asking: threading.Lock = field(default_factory=threading.Lock)
    _stale: set[str] = field(default_factory=set)

    def now(self, name: str) -> Shown:
        """Return the current page; first derive it if it is new or a file has been edited."""
        with self._asking:
            if name not in self._last or name in self._stale:
                self._renew(name)
            return self._last.get(name, Shown())

    def last_good(self, name: str) -> str:
        return self._good.get(name, "")

    def edited(self) -> None:
        """Record that files have changed: pages in view are made again at once, other pages when they are viewed
        again."""
        with self._changed:
            self._edition += 1
            self._stale = set(self._last)
            self._changed.notify_all()

    def next(self, name: str, seen: int, timeout: float) -> tuple[int, Shown | None]:
        """Wait for an edition after `seen`; return its number and content, or `seen` and None after `timeout`."""
        with self._changed:
            self._changed.wait_for(lambda: self._edition > seen, timeout)
            edition = self._edition
        return (edition, self.now(name)) if edition > seen else (seen, None)

    @property
    def edition(self) -> int:
        return self._edition

    def _is_edited_since(self, edition: int) -> bool:
        return self._edition > edition

    def _renew(self, name: str) -> None:
        while True:
            edition = self._edition
            self._stale.discard(name)
            shown = self.warm.page(f"{self.set_id}/{name}", self.detail, partial(self._is_edited_since, edition))
            if shown is not None or not self._is_edited_since(edition):
                break
        if shown is None:  # the preview is over
            return
        self._last[name] = shown
        if shown.main:
            self._good[name] = shown.main
        self.told(name, shown)


class Handler(BaseHTTPRequestHandler):
    """Answers the requests on one connection of a browser."""

    pages: Pages
    whole: Callable[[str, str], str]  # makes a page from a problem's name and the page's main part
    first: str
    protocol_version = "HTTP/1.1"
    server_version = "derive"

    def setup(self) -> None:
        super().setup()
        self._prompt = _Prompt(self.connection)
        self.rfile = BufferedReader(self._prompt)

    def handle_one_request(self) -> None:
        self._prompt.until = time.monotonic() + PROMPT
        super().handle_one_request()

    def do_GET(self) -> None:
        try:
            self._answer()
        except (ConnectionError, TimeoutError):  # the browser has gone
            self.close_connection = True
        except (DeriveError, OSError) as error:
            known = of_system(error) if isinstance(error, OSError) else None
            self._plain(HTTPStatus.SERVICE_UNAVAILABLE, str(known or error))

    def _answer(self) -> None:
        if not self._is_local():
            self._plain(HTTPStatus.FORBIDDEN, "only for this machine")
            return
        path = self.path.partition("?")[0]
        page = re.fullmatch(r"/(?:([A-Za-z0-9][A-Za-z0-9_-]*)\.html)?", path)
        events = re.fullmatch(r"/([A-Za-z0-9][A-Za-z0-9_-]*)/events", path)
        name = (page and (page[1] or self.first)) or (events and events[1]) or ""
        if page and page[1] == "index":
            name = self.first
        if name not in self.pages.names:
            self._plain(HTTPStatus.NOT_FOUND, "this preview has no such page")
        elif events:
            self._events(name)
        else:
            self._page(name)

    def _is_local(self) -> bool:
        """Return whether the request uses a local name of this machine; pages of other sites use other names."""
        return bool(_LOCAL.fullmatch(self.headers.get("Host") or ""))

    def _page(self, name: str) -> None:
        main = self.pages.now(name).main or self.pages.last_good(name)
        whole = type(self).whole
        policy = policy_of(whole(name, ""))
        self._sent(HTTPStatus.OK, "text/html; charset=utf-8", whole(name, main).encode(), policy)

    def _events(self, name: str) -> None:
        """Send messages as long as the browser listens."""
        self.close_connection = True
        self.send_response(HTTPStatus.OK)
        for header, value in (
            ("Content-Type", "text/event-stream"),
            ("Cache-Control", CACHED),
            ("Connection", "close"),
        ):
            self.send_header(header, value)
        self.end_headers()
        seen = self.pages.edition
        self._message(self.pages.now(name))
        while True:
            seen, shown = self.pages.next(name, seen, ALIVE)
            if shown is not None:
                self._message(shown)
            else:
                self._write(b": still here\n\n")

    def _message(self, shown: Shown) -> None:
        said = {"main": shown.main, "complaints": shown.complaints, "seconds": round(shown.seconds, 2)}
        self._write(f"data: {json.dumps(said)}\n\n".encode())

    def _write(self, raw: bytes) -> None:
        self.wfile.write(raw)
        self.wfile.flush()

    def _plain(self, status: HTTPStatus, text: str) -> None:
        self._sent(status, "text/plain; charset=utf-8", f"{text}\n".encode())

    def _sent(self, status: HTTPStatus, kind: str, content: bytes, policy: str = NOTHING_ELSE) -> None:
        self.send_response(status)
        for header, value in (
            ("Content-Type", kind),
            ("Content-Length", str(len(content))),
            ("Cache-Control", CACHED),
            ("X-Content-Type-Options", "nosniff"),
            ("Content-Security-Policy", policy),
        ):
            self.send_header(header, value)
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, format: str, *args: Any) -> None:
        """Write no log of requests, because nobody reads it."""


class _Prompt(RawIOBase):
    """The bytes that a browser sends; each request must be complete within a time limit."""

    def __init__(self, connection: socket):
        self.connection, self.until = connection, 0.0

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: Any) -> int:
        self.connection.settimeout(max(0.001, self.until - time.monotonic()))
        try:
            return self.connection.recv_into(buffer)
        finally:
            self.connection.settimeout(TAKEN)


def policy_of(page: str) -> str:
    """Return the security policy of a page: the page may run only its own scripts, and may connect only to this
    server."""
    found = re.findall(r"<script>(.*?)</script>", page, re.DOTALL)
    scripts = " ".join(f"'sha256-{b64encode(sha256(each.encode()).digest()).decode()}'" for each in found)
    own = "connect-src 'self'; style-src 'unsafe-inline'; font-src data:; img-src data:"
    return f"{NOTHING_ELSE}; script-src {scripts or NONE}; {own}"


class Server(ThreadingHTTPServer):
    """A server whose threads end with the program; the number of threads is limited."""

    daemon_threads = True
    allow_reuse_address = True
    request_queue_size = MOST

    def __init__(self, address: tuple[str, int], handler: type[Handler]):
        self._free = threading.BoundedSemaphore(MOST)
        super().__init__(address, handler)

    def process_request(self, request: Any, client_address: Any) -> None:
        if not self._free.acquire(blocking=False):
            self.shutdown_request(request)
            return
        try:
            super().process_request(request, client_address)
        except BaseException:  # no thread could be started
            self._free.release()
            raise

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        try:
            super().process_request_thread(request, client_address)
        finally:
            self._free.release()

    def get_request(self) -> tuple[Any, Any]:
        try:
            return super().get_request()
        except OSError:  # too few descriptors: the browser waits until some are free
            time.sleep(FULL)
            raise

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Report an unforeseen error in one line; a closed connection is not reported."""
        error = sys.exc_info()[1]
        if not isinstance(error, ConnectionError | TimeoutError):
            said = f"internal error: {type(error).__name__}: {error}"
            self.RequestHandlerClass.pages.told("preview", Shown(complaints=(said,)))  # type: ignore[attr-defined]


def server(pages: Pages, whole: Callable[[str, str], str], first: str, port: int) -> Server:
    """Return a server that is ready; with `port` 0 it uses any free port."""
    handler = type("Handler", (Handler,), {"pages": pages, "whole": staticmethod(whole), "first": first})
    try:
        return Server((HOST, port), handler)
    except OSError as error:
        help_line = "name another port with `--port`, or 0 for any free port"
        message = f"port {port} {'is taken' if error.errno == EADDRINUSE else 'may not be used'}"
        raise BuildFailed(Complaint("port", message, help=help_line)) from None
