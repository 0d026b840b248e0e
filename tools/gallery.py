"""Write docs/gallery.md. With `--pictures`, also make new pictures of pages that `make library` has built, with
Chromium, and copy the drawings that docs/connections.md shows.

A picture shows the beginning of a problem's page in a browser; the YAML of the problem is below the picture.
"""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DOCUMENT, PICTURES = ROOT / "docs" / "gallery.md", ROOT / "docs" / "gallery"
MANUAL = ROOT / "docs" / "connections.md"
WIDTH, HEIGHT = 860, 1060

# the name of a problem -> what the page of this problem shows
SHOWN = {
    "turning_hoop": "A system on rotating axes: equilibria, and the conditions of their stability",
    "double_pendulum": "Two coordinates, their equations of motion and the normal modes",
    "kepler": "A conserved momentum, an effective potential, a circular orbit and small oscillations about it",
    "tennis_racket": "A rigid body without torque: Euler's equations and the stability of each axis",
    "heavy_top": "A top in Euler's angles, its cyclic coordinates and its effective potential",
    "loop": "A normal force as a Lagrange multiplier, and the speed at which the car stays on the track",
    "bullet": "A collision: the angular velocity after the impact and the energy that is lost",
    "torus": "The density and the moments of inertia of a body, by integration",
}

_BEGINNING = """\
# Gallery

`tools/gallery.py` writes this page; do not edit it. Each picture shows the beginning of a page that a build has
written for a browser. The YAML of the problem is below the picture, without the comparison with a book. No problem of
`problems/library` has a script of its own. `make library` builds these problems, and `derive list` lists them.
`derive new hw10/mine --like library/torus` begins a problem of your own with a copy of `library/torus`.
"""


def document() -> str:
    """Return the whole page."""
    return "\n".join([_BEGINNING, *(_entry(name, shows) for name, shows in SHOWN.items())])


def _entry(name: str, shows: str) -> str:
    file = next((ROOT / "problems" / "library").rglob(f"{name}.yaml"))
    text = file.read_text(encoding="utf-8")
    title = re.search(r"^title: (.*)$", text, re.MULTILINE)
    assert title is not None
    lines = [f"## {title[1]}", "", f"{shows}.", "", f"![The beginning of the page](gallery/{name}.png)", ""]
    return "\n".join([*lines, f"[`{file.name}`](../{file.relative_to(ROOT)})", "", "```yaml", _told(text), "```", ""])


def _told(text: str) -> str:
    """Return the YAML of a problem without the comment for editors and without `reference:`, the results of a book."""
    return re.sub(r"^# yaml-language-server.*\n", "", text.partition("\nreference:")[0], flags=re.MULTILINE).strip()


def take_pictures() -> None:
    from tests.browser import browser_page

    PICTURES.mkdir(exist_ok=True)
    for name in SHOWN:
        with browser_page(WIDTH) as page:
            page.goto((ROOT / "build" / "library" / f"{name}.html").as_uri())
            beginning = {"x": 0, "y": 0, "width": WIDTH, "height": HEIGHT}
            page.screenshot(path=PICTURES / f"{name}.png", full_page=True, clip=beginning)


def drawings_of_manual() -> list[str]:
    """Return the problems whose drawings docs/connections.md shows."""
    return re.findall(r"\]\(connections/(\w+)\.svg\)", MANUAL.read_text(encoding="utf-8"))


def copy_drawings() -> None:
    folder = MANUAL.with_suffix("")
    folder.mkdir(exist_ok=True)
    for name in drawings_of_manual():
        shutil.copyfile(ROOT / "build" / "library" / f"{name}-system.svg", folder / f"{name}.svg")


def main() -> None:
    if "--pictures" in sys.argv:
        take_pictures()
        copy_drawings()
    DOCUMENT.write_text(document(), encoding="utf-8")


if __name__ == "__main__":
    main()
