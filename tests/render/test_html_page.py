"""Tests of pages for a browser, which contain every formula of a page."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import pytest
from sympy import Integer

from derive.algebra.amounts import Amount
from derive.building.document_list import papers_of
from derive.building.set_document import document_page, index_page, problem_page
from derive.building.solution import rendered
from derive.course.names import MORE, SHEET
from derive.course.problem_set import problem_set
from derive.page.chain_lines import ChainLine, Equations
from derive.page.wording import EQUALS, Math, Text
from derive.render.printing.html_page import HtmlPage
from derive.render.rendered import Rendered
from tests.courses import course_in, kept, rendered_once
from tests.render.pages import NOTATION, WORDS, M, T, a, display, page

VOID = {"meta", "br", "hr", "img", "link", "mspace", "path", "input", "wbr"}


class Tags(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.faults: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.headings: list[int] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        own = dict(attrs)
        self.ids += [own["id"]] if own.get("id") else []
        self.links += [own["href"]] if own.get("href") else []
        self.headings += [int(tag[1])] if re.fullmatch("h[1-6]", tag) else []
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        if tag in VOID:
            return
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}>")


def page_of(tmp_path: Path, problem: str = "block", edits: dict[str, str] | None = None) -> tuple[str, Rendered]:
    root = course_in(tmp_path, edits, problem=problem)
    solved = rendered_once(root, f"hw9/{problem}", draws=True, only=("html",))
    return problem_page(root, solved, problem_set(root, "hw9")), solved


def read(page: str) -> Tags:
    tags = Tags()
    tags.feed(page)
    return tags


@pytest.mark.parametrize("problem", ["euler", "block", "top", "cone", "slab"])
def test_a_page_is_well_formed_and_each_of_its_links_leads_somewhere(tmp_path: Path, problem: str) -> None:
    page, _ = page_of(tmp_path, problem)
    tags = read(page)
    assert (tags.open, tags.faults) == ([], [])
    assert len(tags.ids) == len(set(tags.ids))
    inside = [link.removeprefix("#") for link in tags.links if link.startswith("#")]
    assert inside and set(inside) <= set(tags.ids)
    assert tags.headings[0] == 1 and all(b <= a + 1 for a, b in zip(tags.headings, tags.headings[1:], strict=False))


def test_a_page_is_one_file_that_asks_for_nothing_else(tmp_path: Path) -> None:
    page, _ = page_of(tmp_path)
    assert not re.search(r'(?:src|href)="(?:https?:|//)|@import|url\((?!"data:)', page)
    assert "<svg" in page and "<title>A drawing in space" in page


def test_text_of_an_instructor_is_text_and_no_html(tmp_path: Path) -> None:
    page, _ = page_of(tmp_path, edits={"A uniform block of": "A <b onclick='x()'>uniform</b> &amp; block of"})
    assert "&lt;b onclick=&#x27;x()&#x27;&gt;uniform&lt;/b&gt; &amp;amp; block" in page
    assert "<b onclick" not in page


def test_an_answer_stands_in_a_frame_and_the_others_do_not(tmp_path: Path) -> None:
    page, _ = page_of(tmp_path)
    rows = re.findall(r'<div class="row".*?</div>', page)
    framed = [row for row in rows if 'class="answer"' in row]
    assert framed and len(framed) < len(rows)


def test_answers_one_after_the_other_share_a_frame() -> None:
    steps = [Equations(key, (ChainLine(T, "equals", M * a),), n, n != 4) for n, key in enumerate("abcdef", 1)]
    shown = replace(display("mass"), groups=tuple(steps))
    rows = "".join(HtmlPage(page(shown), WORDS, NOTATION).steps(shown))
    joined = re.findall(r'<div class="row([^"]*)"', rows)
    assert joined == [" leads", " follows leads", " follows", "", " leads", " follows"]


def test_each_display_says_what_it_is_in_latex(tmp_path: Path) -> None:
    page, _ = page_of(tmp_path)
    said = re.findall(r'data-tex="(.*?)"', page, re.DOTALL)
    assert len(said) == page.count('class="display"')
    assert any(r"\boxed{" in each for each in said)


def test_the_page_of_a_set_leads_to_its_problems_and_to_what_can_be_printed(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    solved = rendered_once(root, "hw9/block", draws=True, only=("html",))
    heading = problem_set(root, "hw9")
    page = index_page(root, heading, [solved], papers_of(root, "hw9", heading.documents))
    assert "A uniform block of mass" in page and "<svg" in page, "its statement and its drawing"
    tags = read(page)
    assert (tags.open, tags.faults) == ([], [])
    assert {"block.html", "solutions.pdf", "problems.pdf", "problems.html", "report.pdf"} <= set(tags.links)


@pytest.mark.parametrize("kind", [SHEET, *MORE])
def test_documents_are_well_formed_and_each_place_of_them_is_there_once(tmp_path: Path, kind: str) -> None:
    parts = []
    for problem in ("block", "top"):
        root = course_in(tmp_path / problem, problem=problem)
        parts.append(rendered(root, f"hw9/{problem}", cache=kept(), only=(), documents=(kind,)))
    tags = read(document_page(root, problem_set(root, "hw9"), parts, kind))
    assert (tags.open, tags.faults) == ([], [])
    assert len(tags.ids) == len(set(tags.ids)) and {"block", "top"} <= set(tags.ids)
    assert {link[1:] for link in tags.links if link.startswith("#")} <= set(tags.ids)
    assert tags.headings[0] == 1 and all(b <= a + 1 for a, b in zip(tags.headings, tags.headings[1:], strict=False))


def test_a_page_of_several_parts_leads_to_each_of_them(tmp_path: Path) -> None:
    page, _ = page_of(tmp_path)
    tags = read(page)
    assert [link for link in tags.links if link.startswith("#part")] == ["#part-a", "#part-b", "#part-c", "#part-d"]
    few, _ = page_of(tmp_path / "few", "cone")
    assert "#part-a" not in read(few).links, "two parts need no list"


def test_of_many_problems_a_page_leads_to_the_next_ones_and_to_the_ends(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    solved = rendered_once(root, "hw9/block", only=("html",))
    heading = problem_set(root, "hw9")
    many = replace(heading, problems=(*(f"hw9/p{i}" for i in range(20)), *heading.problems, "hw9/q", "hw9/r", "hw9/s"))
    links = read(problem_page(root, solved, many)).links
    assert [link for link in links if link.endswith(".html")][1:] == [
        "p0.html",
        "p19.html",
        "block.html",
        "q.html",
        "s.html",
    ]


def test_a_line_may_end_before_a_term_of_a_wide_side_and_never_before_its_punctuation(tmp_path: Path) -> None:
    page, _ = page_of(tmp_path, "slab")
    rows = re.findall(r'<div class="row".*?</div>', page, re.DOTALL)
    assert any('<wbr><math displaystyle="true"><mo form="infix">' in row for row in rows)
    prose = re.sub(r"<nav.*?</nav>", "", page, flags=re.DOTALL)  # the list of parts has no elements in its formulas
    assert not re.search(r"</(?:math|span)>[.,;:](?!</span>)", prose)
    stops = [stop for row in rows for stop in re.findall(r'(.{7})<span class="stop">', row)]
    assert stops and set(stops) <= {"</math>", "</span>"}


def test_no_line_begins_with_a_measured_value() -> None:
    mass = (Math(M), EQUALS, Math(Amount(Integer(2), "kg", Integer(1))), Text(". It rests."))
    shown = HtmlPage(page(), WORDS, NOTATION).inline(mass)
    assert shown.startswith('<span class="ended"><span class="ended"><math>')
    assert shown.endswith(".</span> It rests.")
