"""The key that signs what is kept belongs to the tests: nothing is written to the folders of whoever runs them."""

from __future__ import annotations

import gc
import os
import signal
from collections.abc import Generator, Iterator

import pytest
from hypothesis import settings

import derive  # noqa: F401  before SymPy is imported, whose cache it sets
from tests.browser import chromium

# A shell that starts `make test` in the background of a script has whatever it starts ignore an interrupt: processes of
# the tests would inherit that, and some are interrupted.
if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

settings.register_profile("any machine", deadline=None)  # how long one example takes goes by what else runs
settings.load_profile("any machine")


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Nothing that is collected is ever let go, so it is not looked through time and again for what could be."""
    gc.disable()
    found = yield
    gc.freeze()
    gc.enable()
    return found


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Tests of pages in a browser are left out where there is none."""
    if chromium() is None:
        left_out = [item for item in items if item.get_closest_marker("browser")]
        config.hook.pytest_deselected(items=left_out)
        items[:] = [item for item in items if not item.get_closest_marker("browser")]


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    if chromium() is None:
        terminalreporter.write_line(
            "left out: what a real browser shows, since there is none (Debian's package `chromium`)", yellow=True
        )


@pytest.fixture(autouse=True, scope="session")
def own_key(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """One for all workers, so that each can take the derivations that another has kept."""
    before = os.environ.get("XDG_STATE_HOME")
    own = tmp_path_factory.getbasetemp()
    os.environ["XDG_STATE_HOME"] = str((own.parent if "PYTEST_XDIST_WORKER" in os.environ else own) / "state")
    yield
    if before is None:
        del os.environ["XDG_STATE_HOME"]
    else:
        os.environ["XDG_STATE_HOME"] = before
