"""A real Chromium for tests of pages. If none is installed, these tests are left out and the summary says so."""

from __future__ import annotations

import atexit
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
CRITERIA = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "best-practice"]


@cache
def chromium() -> str | None:
    """Return the path of the browser that is installed, or None."""
    return next((found for name in NAMES if (found := shutil.which(name))), None)


@cache
def _browser() -> Browser:
    """Return the browser that all tests of a process share until the process ends."""
    from playwright.sync_api import sync_playwright

    playwright = sync_playwright().start()
    browser = playwright.chromium.launch(executable_path=chromium(), args=["--no-sandbox"])
    atexit.register(playwright.stop)
    atexit.register(browser.close)
    return browser


@contextmanager
def browser_page(width: int = 1000, **options: Any) -> Iterator[Page]:
    context = _browser().new_context(viewport={"width": width, "height": 800}, **options)
    try:
        yield context.new_page()
    finally:
        context.close()


def barriers(page: Page) -> list[str]:
    """Return the violations of WCAG 2.1 AA and of good practice that axe-core finds.

    Formulas are excluded: they contain only letters, thousands on a page, in the colour of the surrounding text.
    """
    from axe_playwright_python.sync_playwright import Axe

    options = {"runOnly": {"type": "tag", "values": CRITERIA}, "resultTypes": ["violations"]}
    found = Axe().run(page, context={"exclude": [["math"]]}, options=options).response["violations"]
    return [f"{each['id']}: {each['nodes'][0]['html'][:120]}" for each in found]


def overflow(page: Page) -> int:
    """Return by how many pixels the page is wider than its window."""
    return int(page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth"))
