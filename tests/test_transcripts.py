"""The plain-text page of each pinned problem, for a reviewer; for variants of it only the lines that differ.

So a sentence that all pages share is in one file only. After an intended change, `python -P -m tests.test_transcripts`
writes the files again: then read the difference.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from difflib import SequenceMatcher
from pathlib import Path

import pytest

from tests.courses import course_in, rendered_once

FOLDER = Path(__file__).parent / "transcripts"
# page -> edits of the pinned problem with which its name begins, and the level of detail
PAGES: dict[str, tuple[dict[str, str], str | None]] = {
    "block": ({}, None),
    "block-brief": ({}, "brief"),
    "block-full": ({}, "full"),
    "block-cube": ({"[a, 2*a, 3*a]": "[a, a, a]"}, None),
    "block-numbers": (
        {"[a, 2*a, 3*a]": "[2 cm, 4 cm, 6 cm]", "mass: M\n": "mass: 1.5 kg\n", "rate: omega": "rate: 900 rpm"},
        None,
    ),
    "centred": ({}, None),
    "centred-brief": ({}, "brief"),
    "centred-full": ({}, "full"),
    "centred-cube": ({"[a, 2*a, 3*a]": "[a, a, a]"}, None),
    "centred-edge": ({"axis: diagonal": "axis: z"}, None),
    "cone": ({}, None),
    "cone-brief": ({}, "brief"),
    "cone-isotropic": ({"height: h": "height: 2*R"}, None),
    "cone-numbers": ({"radius: R": "radius: 4 cm", "height: h": "height: 10 cm", "mass: M": "mass: 300 g"}, "brief"),
    "euler": ({}, None),
    "euler-full": ({}, "full"),
    "euler-symmetric": ({"moments: [I_x, I_y, I_z]": "moments: [I_x, I_x, I_z]"}, None),
    "euler-isotropic": ({"moments: [I_x, I_y, I_z]": "moments: [I_x, I_x, I_x]"}, None),
    "euler-numbers": ({"moments: [I_x, I_y, I_z]": "moments: [2 kg m^2, 3 kg m^2, 4 kg m^2]"}, None),
    "slab": ({}, None),
    "slab-full": ({}, "full"),
    "slab-width": (
        {
            "inertia: I   ": "width: b     ",
            "I: moment of inertia": "b: length",
            "Its moment of inertia about the axis through its centre of mass that is parallel to\n": "Its width\n",
            "the cylinder's is <<inertia>>": "is <<width>>",
        },
        None,
    ),
    "slab-thick": ({"radius: R\n": "radius: a/4\n"}, None),
    "slab-stable": ({"radius: R\n": "radius: 2*a\n"}, None),
    "slab-border": ({"radius: R\n": "radius: a/2\n"}, None),
    "slab-numbers": (
        {
            "radius: R\n": "radius: 20 cm\n",
            "thickness: a\n": "thickness: 5 cm\n",
            "mass: M\n": "mass: 1 kg\n",
            "inertia: I ": "inertia: 0.0035 kg m^2 ",
            "gravity: g\n": "gravity: 9.8 m/s^2\n",
        },
        None,
    ),
    "double": ({}, None),
    "springs": ({}, None),
    "top": ({}, None),
    "top-slow": ({"900 rpm": "200 rpm"}, "brief"),
    "top-horizontal": ({"45 deg": "90 deg"}, "brief"),
    "top-beyond": ({"45 deg": "120 deg"}, "brief"),
    "top-letters": (
        {
            "tilt: 45 deg": "tilt: theta_0",
            "spin: 900 rpm": "spin: S",
            "fast_precession]\n    form: {unit: [rad/s, rpm]}": "fast_precession]",
        },
        "brief",
    ),
}


def page(name: str, folder: Path) -> str:
    edits, detail = PAGES[name]
    problem = name.partition("-")[0]
    course = course_in(folder, edits, problem=problem)
    return rendered_once(course, f"hw9/{problem}", detail, only={"text"}).texts["text"]


def differences(base: str, variant: str) -> str:
    """Return the lines of a variant that differ from its base, at each place with the number of lines that they
    replace."""
    before, after = base.splitlines(), variant.splitlines()

    def places() -> Iterator[str]:
        for change, i, j, k, l in SequenceMatcher(None, before, after, autojunk=False).get_opcodes():
            if change != "equal":
                gone = [f"- {j - i} lines\n"] if j > i else []
                yield "".join([*gone, *(f"+ {line}".rstrip() + "\n" for line in after[k:l])])

    return "\n".join(places())


def pinned(name: str, folder: Path) -> str:
    base = name.partition("-")[0]
    made = page(name, folder / name)
    return made if base == name else differences(page(base, folder / base), made)


@pytest.mark.parametrize("name", PAGES)
def test_the_page_reads_as_its_transcript(name: str, tmp_path: Path) -> None:
    assert pinned(name, tmp_path) == (FOLDER / f"{name}.txt").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("base", "variant", "expected"),
    [
        ("a\nb\nc\n", "a\nB\nc\n", "- 1 lines\n+ B\n"),
        ("a\nb\nc\n", "b\nc\nd\n", "- 1 lines\n\n+ d\n"),
        ("a\n", "a\n", ""),
    ],
)
def test_only_lines_that_differ_are_kept(base: str, variant: str, expected: str) -> None:
    assert differences(base, variant) == expected


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        os.environ["XDG_STATE_HOME"] = temporary
        for each in PAGES:
            (FOLDER / f"{each}.txt").write_text(pinned(each, Path(temporary) / f"of-{each}"), encoding="utf-8")
