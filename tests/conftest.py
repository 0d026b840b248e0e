"""The key that seals what is kept belongs to the tests: nothing is written to the folders of whoever runs them."""

from __future__ import annotations

import gc
import os
from collections.abc import Generator, Iterator

import pytest
from hypothesis import settings

import derive  # noqa: F401  before SymPy is imported, whose cache it sets

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
