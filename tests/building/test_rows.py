"""Nothing of a page is cut: TeX's own log of all problems at every level, and rows that are too long made smaller."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
from pypdf import PageObject, PdfReader

from derive.building.set_document import set_document
from derive.building.tex import chosen_engine
from derive.course.problem_set import problem_set
from derive.render.rendered import Rendered
from tests.courses import course_in, rendered_once

PROBLEMS, LEVELS = ("block", "cone", "euler", "slab", "top"), ("brief", "standard", "full")
LEAST_SCALE = 0.75  # below which letters are too small to read
TOLERATED = 1.0  # points

Logged = tuple[str, Path]


def typeset_with_log(folder: Path, tex: str) -> Logged:
    source = folder / "page.tex"
    source.write_text(tex, encoding="utf-8")
    run = [*chosen_engine("tinytex").command(source.name)]
    subprocess.run(run, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=True, timeout=120)
    return (folder / "page.log").read_text(encoding="utf-8", errors="replace"), folder / "page.pdf"


def outside(log: str) -> list[str]:
    found = re.findall(r"Overfull \\[hv]box \(([\d.]+)pt too (?:wide|high)\).*", log)
    return [width for width in found if float(width) > TOLERATED]


def scales(log: str) -> list[float]:
    rows = re.findall(r"derive: a row is ([\d.]+)pt wide and has ([\d.]+)pt", log)
    return [float(room) / float(width) for width, room in rows]


@pytest.fixture(scope="module")
def logged(tmp_path_factory: pytest.TempPathFactory) -> Logged:
    pages: list[Rendered] = []
    for name in PROBLEMS:
        root = course_in(tmp_path_factory.mktemp(name), problem=name)
        pages += [rendered_once(root, f"hw9/{name}", level, only=()) for level in LEVELS]
    return typeset_with_log(tmp_path_factory.mktemp("tex"), set_document(root, problem_set(root, "hw9"), pages))


def test_nothing_stands_outside_the_text(logged: Logged) -> None:
    assert outside(logged[0]) == []
    assert outside("Overfull \\hbox (1.01pt too wide) detected\nOverfull \\vbox (0.9pt too high) has") == ["1.01"]


def test_no_row_of_the_problems_is_too_small_to_read(logged: Logged) -> None:
    assert [scale for scale in scales(logged[0]) if scale < LEAST_SCALE] == []


def places(page: PageObject) -> list[tuple[float, float]]:
    found: list[tuple[float, float]] = []
    page.extract_text(visitor_text=lambda text, _, at, *__: found.append((at[4], at[5])) if text.strip() else None)
    return found


def test_every_letter_stands_on_the_paper(logged: Logged) -> None:
    for number, page in enumerate(PdfReader(logged[1]).pages[:4], 1):
        width, height = float(page.mediabox.width), float(page.mediabox.height)
        assert places(page)
        assert [(x, y) for x, y in places(page) if not (0 < x < width and 0 < y < height)] == [], number


@pytest.mark.parametrize(("formula", "smaller"), [(r"\sqrt{%s}", True), ("%s", True), (r"x\mbox{%.0s}", False)])
def test_a_row_that_does_not_fit_is_made_smaller(formula: str, smaller: bool, tmp_path: Path) -> None:
    row = formula % "+".join(["a^{2}"] * 26)
    tex = set_document(course_in(tmp_path), problem_set(tmp_path, "hw9"), [])
    rows = rf"\chain{{\row{{T}}{{= {row}}}{{.}}{{\why{{since}}}}{{\eqnumber{{1}}}}}}"
    framed = rf"\chain{{\framedrow{{T}}{{T = {row}}}{{.}}{{}}{{\eqnumber{{2}}}}}}"
    log, _ = typeset_with_log(tmp_path, tex.replace(r"\end{document}", rows + framed + r"\end{document}"))
    assert outside(log) == []
    assert len(scales(log)) == (2 if smaller else 0)


@pytest.mark.parametrize("terms", [3, 30])
def test_numbers_are_beside_the_rows_of_their_frame(terms: int, tmp_path: Path) -> None:
    """With 30 terms the frame is made smaller to fit."""
    tex = set_document(course_in(tmp_path), problem_set(tmp_path, "hw9"), [])
    right = "+".join(["a^{2}"] * terms)
    rows = r"\nextlistrow ".join(rf"\listrow{{Z}}{{= {right}}}{{}}{{\eqnumber{{{70 + n}}}}}" for n in range(4))
    _, pdf = typeset_with_log(
        tmp_path, tex.replace(r"\end{document}", rf"\chain{{\framedlist{{{rows}}}{{.}}}}\end{{document}}")
    )
    heights: dict[str, list[float]] = {"Z": [], "7": []}

    def note(text: str, page: list[float], at: list[float], *_: object) -> None:
        if text.strip().strip("(")[:1] in heights:
            heights[text.strip().strip("(")[:1]].append(page[5] + page[3] * at[5])

    PdfReader(pdf).pages[-1].extract_text(visitor_text=note)
    assert len(heights["Z"]) == 4
    assert heights["7"] == pytest.approx(heights["Z"], abs=1.0)


def test_the_words_of_a_row_beside_a_drawing_are_printed_once(tmp_path: Path) -> None:
    """The passage after the drawing does not fit beside it, so TeX tries its lines before it prints them."""
    tex = set_document(course_in(tmp_path), problem_set(tmp_path, "hw9"), [])
    row = r"\chain{\row{T}{= \frac{1}{2}mv^{2}+\rule{11cm}{1pt}}{.}{}{\eqnumber{1}}}"
    passage = rf"\passage{{%s\wordstodisplay{{thus}}{row}}}"
    before = passage % r"\todisplay{Some words}\chain{\row{U}{= 0}{,}{}{}}"
    after = passage % r"\todisplay{Other words}\chain{\row{U}{= \rule{1pt}{4cm}}{,}{}{}}"
    beside = rf"\drawingbeside{{none.pdf}}{{A drawing.}}{{Figure 1.}}{{A caption.}}{{{before}}}{{{after}}}"
    _, pdf = typeset_with_log(tmp_path, tex.replace(r"\end{document}", rf"{beside}\end{{document}}"))
    assert PdfReader(pdf).pages[0].extract_text().count("thus") == 2


def test_the_lines_of_a_caption_are_balanced_and_break_no_formula(tmp_path: Path) -> None:
    tex = set_document(course_in(tmp_path), problem_set(tmp_path, "hw9"), [])
    caption = r"The length of the spring after the release, drawn for $m = 1$, $k = 98$, $l = 3$ and $g = 9$."
    widths = range(50, 90, 4)
    drawings = [
        rf"\renewcommand{{\captionwidth}}{{{width}mm}}\drawing{{none.pdf}}{{A.}}{{Figure 1.}}{{{caption}}}\par"
        for width in widths
    ]
    _, pdf = typeset_with_log(tmp_path, tex.replace(r"\end{document}", rf"{''.join(drawings)}\end{{document}}"))
    lines = [line.strip() for page in PdfReader(pdf).pages for line in page.extract_text().splitlines()]
    assert sum(line.endswith("9.") for line in lines) == len(widths)
    assert not [line for line in lines if line.startswith("=") or line.endswith("=")]
    assert not [line for line in lines if line.endswith("9.") and len(line) < 12]
