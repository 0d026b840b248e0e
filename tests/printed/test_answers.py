"""Every format of a problem has the same answers: JSON, text, LaTeX, HTML, Markdown, a notebook, a fragment."""

from __future__ import annotations

import json
import re
from collections import Counter
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from derive.render.rendered import Rendered
from tests.courses import ROOT, course_in, rendered_once
from tests.printed.answers import (
    bare,
    boxed,
    characters_of_tex,
    framed,
    framed_in_text,
    of_html,
    of_notebook,
    shown_in_html,
)
from tests.printed.test_levels import PROBLEMS
from tests.test_transcripts import PAGES

FORMATS = {"json", "text", "latex", "html", "markdown", "notebook", "fragment"}
# page -> how many answers it has
ANSWERS = {"block": 6, "block-numbers": 6, "cone": 5, "slab": 5, "top": 5, "euler": 2}
WITHOUT_GROUPS = str.maketrans("", "", "{}")  # which lines that are broken have besides
LISTED = {"principal_moments", "principal_directions", "agreement"}  # entry by entry, or on full pages alone


@cache
def page(name: str) -> Rendered:
    problem, (edits, detail) = name.partition("-")[0], PAGES[name]
    with TemporaryDirectory() as folder:
        course = course_in(Path(folder), edits, problem=problem)
        return rendered_once(course, f"hw9/{problem}", detail, only=FORMATS)


@pytest.mark.parametrize("name", ANSWERS)
def test_what_is_framed_is_the_same_in_all_formats_that_write_latex(name: str) -> None:
    found = page(name)
    wanted = bare(framed(found.latex))
    assert len(wanted) > 10 * ANSWERS[name]
    assert bare(boxed(found.texts["markdown"])) == wanted
    assert bare(of_notebook(found.texts["notebook"])) == wanted
    assert bare(boxed(found.texts["fragment"])) == wanted
    assert bare(of_html(found.html)) == wanted


@pytest.mark.parametrize("name", ANSWERS)
def test_a_browser_shows_what_is_framed_on_paper(name: str) -> None:
    found = page(name)
    assert shown_in_html(found.html) == "".join(map(characters_of_tex, framed(found.latex)))


@pytest.mark.parametrize("name", ANSWERS)
def test_the_answers_of_the_json_stand_in_the_frames_of_paper_and_of_text(name: str) -> None:
    found = page(name)
    answers = json.loads(found.texts["json"])["answers"]
    on_paper = "".join(map(characters_of_tex, framed(found.latex)))
    in_lines, with_matrices = framed_in_text(found.texts["text"])
    assert len(answers) >= ANSWERS[name]
    for key, answer in answers.items():
        if answer["number"]:
            said = [significant(number) for number in re.findall(r"[\d.]+", answer["number"]["text"])]
        else:
            said = [characters_of_tex(answer["latex"])] if key not in LISTED else []
        for each in said:
            assert each in on_paper, key
            assert each in in_lines or Counter(with_matrices) >= Counter(each), key


def significant(number: str) -> str:
    return number.replace(".", "").lstrip("0")


@pytest.mark.parametrize("format", ["markdown", "fragment"])
def test_a_changed_digit_is_seen(format: str) -> None:
    found = page("block").texts[format]
    assert r"\frac{7}{24}" in found
    assert bare(boxed(found.replace(r"\frac{7}{24}", r"\frac{7}{25}"))) != bare(boxed(found))


@pytest.mark.parametrize("problem_id", [each for each in PROBLEMS if each.startswith("library/")])
def test_a_page_of_the_library_has_the_same_answers_on_paper_and_in_a_browser(problem_id: str) -> None:
    found = rendered_once(ROOT, problem_id, only={"latex", "html", "markdown"})
    on_paper, in_browser, in_markdown = framed(found.latex), of_html(found.html), boxed(found.texts["markdown"])
    wanted = bare(on_paper).translate(WITHOUT_GROUPS)
    assert wanted
    assert bare(in_browser).translate(WITHOUT_GROUPS) == wanted
    assert bare(in_markdown).translate(WITHOUT_GROUPS) == wanted
