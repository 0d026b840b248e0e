"""Settings of the test run. The tests have their own key for the cache and write nothing to the folders of the user."""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections import Counter
from collections.abc import Generator, Iterator
from pathlib import Path

import pytest
from hypothesis import settings

import derive  # noqa: F401  before SymPy is imported, whose cache it sets
from derive.building.workers import Crew
from tests.browser import chromium
from tests.covered import covered

# If a script starts `make test` in the background, the shell makes it ignore interrupts. Processes that the tests start
# would inherit this, but some tests interrupt them.
if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# Compiled modules are kept, as in the Makefile, even where the environment says not to. Otherwise each worker compiles
# all tests, and each started command compiles derive.
sys.dont_write_bytecode = False
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

settings.register_profile("any machine", deadline=None)  # the time of one example depends on other processes
settings.load_profile("any machine")


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Disable garbage collection during the collection of tests: none of the collected objects is ever freed. Collect
    rarely afterwards, because the caches of SymPy grow and are kept."""
    gc.disable()
    found = yield
    gc.freeze()
    gc.set_threshold(100_000, 50, 50)
    gc.enable()
    return found


# number of cases of a test -> one case of how many is tried; all cases of tests with fewer than 4. Cases often have a
# period of 4, 5 or 10 (shapes, surfaces), so the strides have no factor in common with these.
SAMPLED = {4: 13, 50: 37}


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out tests of pages in a browser if none is installed, long tests, most cases of tests with many cases, and
    slow tests that run few lines of their own.

    `DERIVE_ALL_TESTS=1 make test` tries all cases; so does a run that names single files or tests.
    """
    kept = items if chromium() is not None else [item for item in items if not item.get_closest_marker("browser")]
    names_files = any(Path(each.partition("::")[0]).suffix == ".py" for each in config.args)
    if not names_files and not os.environ.get("DERIVE_ALL_TESTS"):
        listed = covered()
        kept = _sampled([item for item in kept if not item.get_closest_marker("long")])
        kept = [item for item in kept if item.nodeid not in listed]
    chosen = set(kept)
    config.hook.pytest_deselected(items=[item for item in items if item not in chosen])
    items[:] = kept


def _sampled(items: list[pytest.Item]) -> list[pytest.Item]:
    """Return the first of every few cases of each test with many cases, and all other tests.

    The mark `every_case` keeps all cases of a test.
    """
    sizes = Counter(item.nodeid.partition("[")[0] for item in items if not item.get_closest_marker("every_case"))
    seen: Counter[str] = Counter()
    kept = []
    for item in items:
        family = item.nodeid.partition("[")[0]
        every = max((each for cases, each in SAMPLED.items() if sizes[family] >= cases), default=1)
        if seen[family] % every == 0:
            kept.append(item)
        seen[family] += 1
    return kept


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    if chromium() is None:
        terminalreporter.write_line(
            "left out: tests in a real browser, because none is installed (Debian's package `chromium`)", yellow=True
        )


@pytest.fixture(autouse=True, scope="session")
def own_key(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Use one key for all workers, so that each can use the derivations that another worker has stored."""
    before = os.environ.get("XDG_STATE_HOME")
    own = tmp_path_factory.getbasetemp()
    os.environ["XDG_STATE_HOME"] = str((own.parent if "PYTEST_XDIST_WORKER" in os.environ else own) / "state")
    yield
    if before is None:
        del os.environ["XDG_STATE_HOME"]
    else:
        os.environ["XDG_STATE_HOME"] = before


@pytest.fixture
def workers(course: object, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in ("workers", "sets"):
        monkeypatch.setattr(f"derive.building.{module}.Crew", Crew)
