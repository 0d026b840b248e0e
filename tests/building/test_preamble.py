"""The preamble as a format: the same pages, made once, and given up where TeX cannot."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from jinja2 import meta
from pypdf import PdfReader

from derive.building import preamble
from derive.building.cache import Cache, Kept, digest
from derive.building.preamble import DIFFERS, beginning
from derive.building.set_document import COUNTED, problem_document, report_document, set_document, sheet_document
from derive.building.tex import Engine, chosen_engine, prepare, typeset
from derive.course.problem_set import ProblemSet
from derive.errors import BuildFailed
from derive.page.template import Templates, environment, templates_of
from derive.render.rendered import Html, Rendered, Tex
from derive.steps.level import Level
from tests.courses import ROOT

ABOVE = r"""\documentclass{article}
\usepackage[T1]{fontenc}\usepackage{lmodern,amsmath}
\newcommand{\mass}{M}
"""
BELOW = r"""\newcommand{\own}[1]{of #1}
\begin{document}
%% derive: hw9/block part b
A block \own{two}: $\mass a^2$ %s
\end{document}
"""
PAGE = Rendered(
    id="hw1/one", detail="standard", title="One", points="3", texts={}, latex=Tex("solved"), title_latex=Tex("One"),
    sheet=Tex("asked"), report=Tex("checked"), source=Tex(""), html=Html(""), title_html=Html(""),
    card_html=Html(""), warnings=(), inputs=(), grades={},
    counts=dict.fromkeys(COUNTED, 1), steps=1, compared=0, agreed=True,
)  # fmt: skip


@pytest.fixture
def target(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    preamble.at_hand().cleanup(), preamble.at_hand.cache_clear()
    monkeypatch.delenv("DERIVE_ENGINE", raising=False)
    return tmp_path / "block.pdf"


def document(more: str = "", above: str = ABOVE, differs: str = DIFFERS) -> str:
    return above + differs + BELOW.replace("%s", more)


def text_of(pdf: Path) -> str:
    return "".join(page.extract_text() for page in PdfReader(pdf).pages)


def test_the_pages_are_the_same_and_the_format_is_made_once(target: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = Cache(target.parent / "kept")
    typeset(document(), target, chosen_engine(None))
    plain = text_of(target)
    assert "of two" in plain
    dumps = []
    dumped = preamble._dumped
    monkeypatch.setattr(preamble, "_dumped", lambda *given: dumps.append(1) or dumped(*given))
    for more in ("", "again"):
        typeset(document(more), target, chosen_engine(None), formats=kept)
        assert text_of(target).split() == [*plain.split()[:-1], *([more] if more else []), plain.split()[-1]]
    assert dumps == [1]
    assert kept.folder
    assert max(file.stat().st_size for file in kept.folder.iterdir()) > 1_000_000, "what TeX dumped"


def test_a_mistake_is_told_as_without_a_format(target: Path) -> None:
    told = []
    for formats in (Cache(), Cache(target.parent / "kept")):
        with pytest.raises(BuildFailed) as caught:
            typeset(document(r"\nosuch"), target, chosen_engine(None), formats=formats)
        told.append([each.shown() for each in caught.value.complaints])
    assert told[0] == told[1]
    assert r"Undefined control sequence \nosuch" in told[0][0]


@pytest.mark.parametrize(
    "tex",
    [
        document(differs=""),
        document(above=ABOVE + "\\AtBeginDocument{}\\everyjob{\\stop}\n"),
    ],
    ids=["no such line", "a format that stops"],
)
def test_where_it_cannot_be_done_the_document_is_typeset_as_it_stands(target: Path, tex: str) -> None:
    typeset(tex, target, chosen_engine(None), formats=Cache(target.parent / "kept"))
    assert "of two" in text_of(target)


def test_what_cannot_be_dumped_is_not_tried_again(target: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = Cache(target.parent / "kept")
    tex = document(above=ABOVE + "\\gdef\\mass{M}\\begingroup\n").replace(DIFFERS, DIFFERS + "\\endgroup")
    typeset(tex, target, chosen_engine(None), formats=kept)
    assert "of two" in text_of(target)
    monkeypatch.setattr(preamble, "_dumped", lambda *_: pytest.fail("tried again"))
    typeset(tex.replace("two", "three"), target, chosen_engine(None), formats=kept)
    assert "of three" in text_of(target)


def test_the_documents_of_a_set_say_where_they_differ() -> None:
    template = (Path(__file__).parents[2] / "templates" / "latex" / "document.tex.j2").read_text()
    above, differs, below = template.partition(DIFFERS)
    assert differs
    asked = meta.find_undeclared_variables(environment().parse(above))
    assert asked == {"detail", "font_size"}, "what else differs stands below the line"
    assert "\\usepackage" not in below


@pytest.mark.parametrize("detail", [None, *Level])
def test_what_the_documents_of_the_template_begin_with_is_known_before_there_is_one(detail: Level | None) -> None:
    begins = beginning(templates_of(ROOT), detail)
    assert begins.startswith("% Written by derive")
    assert begins.endswith(DIFFERS)
    assert "<<" not in begins
    assert "<%" not in begins
    heading = ProblemSet("hw1", "Physics", "Homework", (), ())
    problems = [replace(PAGE, detail=detail.value)] if detail else []
    kinds: list[Callable[[Path, ProblemSet, list[Rendered]], str]] = [sheet_document]
    if problems:
        kinds += [set_document, report_document, lambda root, of, pages: problem_document(root, pages[0], of)]
    for kind in kinds:
        assert kind(ROOT, heading, problems).startswith(begins)


def test_a_brief_page_has_a_class_of_its_own() -> None:
    brief, *others = (beginning(templates_of(ROOT), level) for level in Level)
    assert r"\documentclass[10pt]{article}" in brief
    assert all(r"\documentclass[11pt]{article}" in each for each in others)
    assert len({*others}) == 1, "they share a format"


@pytest.mark.parametrize("text", [None, "no such line", "<< labels.title >>" + DIFFERS])
def test_what_a_template_must_be_filled_for_is_not_known_before(tmp_path: Path, text: str | None) -> None:
    (tmp_path / "latex").mkdir()
    if text:
        (tmp_path / "latex" / "document.tex.j2").write_text(text)
    assert beginning(Templates((tmp_path,)), Level.STANDARD) == ""


def test_a_format_that_is_made_before_is_that_of_the_documents(target: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = Cache(target.parent / "kept")
    prepare(ABOVE + DIFFERS, chosen_engine(None), kept)
    monkeypatch.setattr(preamble, "_dumped", lambda *_: pytest.fail("made again"))
    typeset(document(), target, chosen_engine(None), formats=kept)
    assert "of two" in text_of(target)


def test_page_numbers_that_are_not_known_are_found_by_a_run_without_a_pdf(
    target: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept, runs = Cache(target.parent / "kept"), []
    command = Engine.command
    monkeypatch.setattr(Engine, "command", lambda *given: runs.append("-draftmode" in given) or command(*given))
    for more in ("", "again"):
        tex = document(rf"on \pageref{{there}} {more}\newpage\label{{there}}there")
        typeset(tex, target, chosen_engine(None), formats=kept, numbers=Kept(kept, digest("numbers")))
        assert "on 2" in text_of(target)
    assert runs == [True, False, False], "the second time they are known"


def test_the_anchor_of_a_problem_is_on_the_page_of_its_heading(target: Path) -> None:
    """The problems have different heights, so some headings do not fit on the page on which the problem before ends."""
    names, rule = [f"p{k}" for k in range(40)], r"\rule{{1pt}}{{{}pt}}"
    pages = [
        replace(PAGE, id=f"hw1/{name}", title_latex=Tex(f"Heading {name}."), latex=Tex(rule.format(83 + 17 * k)))
        for k, name in enumerate(names)
    ]
    heading = ProblemSet("hw1", "Physics", "Homework", tuple(f"hw1/{name}" for name in names), ())
    typeset(set_document(ROOT, heading, pages), target, chosen_engine(None))
    found = PdfReader(target)
    for name in names:
        page = found.get_destination_page_number(found.named_destinations[f"hw1.{name}"])
        body = found.pages[page].extract_text().split("\n", 1)[1]  # without the heading of the page
        assert f"Heading {name}." in body, name
