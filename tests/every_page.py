"""Check all pages of a build in a real Chromium, before a release: `python -P -m tests.every_page build/library`.

Each page is checked in a wide window in the light scheme and in a phone's window in the dark scheme, with all details
unfolded. Axe-core must find no barrier, nothing may be wider than the window or hidden beside it, and the browser must
report no error and no warning.
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
# Formulas that are out of sight, except in elements that scroll and in the list of parts, which repeats the headings.
HIDDEN = """[...document.querySelectorAll('math')].filter((each) => {
  const { left, right, width } = each.getBoundingClientRect();
  return width && !each.closest('.wide, .parts') && (left < -1 || right > document.documentElement.clientWidth + 1);
}).map((each) => each.textContent)"""


def faults(page: Page, address: str) -> list[str]:
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
    files = sorted(file for folder in folders for file in Path(folder).resolve().glob("*.html"))
    count = 0
    for file in files:
        for width, scheme in WINDOWS:
            with browser_page(width, color_scheme=scheme) as page:
                for fault in faults(page, file.as_uri()):
                    count += 1
                    print(f"{file.parent.name}/{file.name}, {width} pixels, {scheme}: {fault}", flush=True)
    print(f"{len(files)} pages, {count} errors")
    return int(count > 0 or not files)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
