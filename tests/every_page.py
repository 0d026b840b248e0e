"""Every page that builds have written, in a real Chromium, for releases: `python -P -m tests.every_page build/library`.

Each is looked at on a desk and, in the dark, on a phone, with all unfolded: axe-core finds no barrier, nothing is wider
than its window or hidden beside it, and the browser has nothing to complain of.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from tests.browser import barriers, browser_page, overflow

if TYPE_CHECKING:
    from playwright.sync_api import Page

WINDOWS = ((1280, "light"), (360, "dark"))
UNFOLD = "document.querySelectorAll('details').forEach((each) => { each.open = true; })"
# What scrolls can be reached; a list of contents says no more than the headings.
HIDDEN = """[...document.querySelectorAll('math')].filter((each) => {
  const { left, right, width } = each.getBoundingClientRect();
  return width && !each.closest('.wide, .parts') && (left < -1 || right > document.documentElement.clientWidth + 1);
}).map((each) => each.textContent)"""


def faults(page: Page, address: str) -> list[str]:
    """What is wrong with a page in the window that it is shown in."""
    found: list[str] = []

    def complain(what: object) -> None:
        found.append(f"the browser says: {what}")

    page.on("pageerror", complain)
    page.on("console", lambda told: complain(told.text) if told.type in ("error", "warning") else None)
    page.goto(address)
    page.evaluate(UNFOLD)
    page.evaluate("document.fonts.ready")
    found += barriers(page)
    found += [f"{beyond} pixels wider than the window"] if (beyond := overflow(page)) else []
    found += [f"out of sight: {formula}" for formula in page.evaluate(HIDDEN)]
    return found


def main(folders: list[str]) -> int:
    """All pages in these folders; those that have faults are told."""
    files = sorted(file for folder in folders for file in Path(folder).resolve().glob("*.html"))
    count = 0
    for file in files:
        for width, scheme in WINDOWS:
            with browser_page(width, color_scheme=scheme) as page:
                for fault in faults(page, file.as_uri()):
                    count += 1
                    print(f"{file.parent.name}/{file.name}, {width} pixels, {scheme}: {fault}", flush=True)
    print(f"{len(files)} pages, {count} faults")
    return int(count > 0 or not files)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
