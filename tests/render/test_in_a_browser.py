"""Tests of pages in Chromium, also for readers with assistive technology."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from derive.building.set_document import document_page, index_page, problem_page
from derive.building.solution import rendered
from derive.course.names import ON_A_PAGE, RUBRIC, SHEET
from derive.course.problem_set import problem_set
from tests.browser import barriers, browser_page, overflow
from tests.courses import course_in, kept
from tests.every_page import faults

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = pytest.mark.browser

PROBLEMS = ("euler", "block", "top", "cone", "slab")
PHONE = 360


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    folder = tmp_path_factory.mktemp("pages")
    solved = []
    for name in PROBLEMS:
        root = course_in(folder / name, problem=name)
        solved.append(
            rendered(root, f"hw9/{name}", cache=kept(), draws=True, only=("html",), documents=documents_of(name))
        )
        (folder / f"{name}.html").write_text(problem_page(root, solved[-1], problem_set(root, "hw9")))
    (folder / "index.html").write_text(index_page(root, problem_set(root, "hw9"), solved))
    for kind in ON_A_PAGE:
        having = [each for each in solved if f"{kind}.html" in each.documents]
        (folder / f"{kind}.html").write_text(document_page(root, problem_set(root, "hw9"), having, kind))
    return {name: (folder / f"{name}.html").as_uri() for name in (*PROBLEMS, "index", *ON_A_PAGE)}


def documents_of(name: str) -> tuple[str, ...]:
    return ON_A_PAGE if name == "block" else (SHEET, RUBRIC) if name == "top" else ()


@pytest.fixture(scope="module")
def desk() -> Iterator[Page]:
    with browser_page() as page:
        yield page


@pytest.fixture(scope="module")
def phone() -> Iterator[Page]:
    with browser_page(PHONE, color_scheme="dark") as page:
        yield page


@pytest.mark.parametrize("name", [*PROBLEMS, "index"])
def test_axe_finds_no_barrier_at_a_desk(pages: dict[str, str], desk: Page, name: str) -> None:
    desk.goto(pages[name])
    assert barriers(desk) == []


@pytest.mark.parametrize("name", [*PROBLEMS, "index"])
def test_nothing_is_wider_than_a_phone(pages: dict[str, str], phone: Page, name: str) -> None:
    phone.goto(pages[name])
    phone.evaluate("document.querySelectorAll('details').forEach((each) => { each.open = true; })")
    assert overflow(phone) == 0


@pytest.mark.parametrize("name", ON_A_PAGE)
def test_a_document_has_no_fault_on_a_phone(pages: dict[str, str], phone: Page, name: str) -> None:
    assert faults(phone, pages[name]) == []


def test_a_fault_is_found(tmp_path: Path, phone: Page) -> None:
    page = tmp_path / "page.html"
    wide = '<p style="width: 900px">wide <math style="margin-left: 600px"><mi>x</mi></math></p>'
    page.write_text(f"<html><body><h1></h1>{wide}<script>fails()</script></body></html>")
    found = faults(phone, page.as_uri())
    assert any("fails" in each for each in found) and "out of sight: x" in found
    assert any("wider" in each for each in found) and any(each.startswith("html-has-lang") for each in found)


def test_axe_finds_no_barrier_on_a_phone_in_the_dark(pages: dict[str, str], phone: Page) -> None:
    phone.goto(pages["top"])
    phone.evaluate("document.querySelectorAll('details').forEach((each) => { each.open = true; })")
    assert barriers(phone) == []


def test_the_letters_of_formulas_come_with_the_page_and_brackets_grow(pages: dict[str, str], desk: Page) -> None:
    desk.goto(pages["block"])
    desk.evaluate("document.fonts.ready")
    assert desk.evaluate("document.fonts.check('16px \"derive math\"')")
    tall = desk.evaluate(
        "Math.max(...[...document.querySelectorAll('mo')].filter((each) => each.textContent === '(')"
        ".map((each) => each.getBoundingClientRect().height))"
    )
    assert tall > 60


def test_a_page_is_whole_without_a_script(pages: dict[str, str]) -> None:
    with browser_page(java_script_enabled=False) as page:
        page.goto(pages["cone"])
        assert "principal moments" in page.inner_text("main") and page.locator("math").count() > 50
        assert page.locator("button").count() == 0


def test_the_keyboard_reaches_the_main_part_first_and_then_what_scrolls(pages: dict[str, str], desk: Page) -> None:
    desk.goto(pages["slab"])
    desk.keyboard.press("Tab")
    assert desk.evaluate("document.activeElement.className") == "skip"
    desk.keyboard.press("Enter")
    assert desk.url.endswith("#main")


def test_a_display_can_be_copied_as_latex(pages: dict[str, str]) -> None:
    with browser_page(permissions=["clipboard-read", "clipboard-write"]) as page:
        page.goto(pages["block"])
        page.locator("section > .display > .copy").first.focus()
        page.keyboard.press("Enter")
        page.wait_for_function("document.activeElement.textContent === 'Copied'")
        copied = page.evaluate("navigator.clipboard.readText()")
        assert copied == page.locator("section > .display").first.get_attribute("data-tex")


def test_each_drawing_says_what_it_shows(pages: dict[str, str], desk: Page) -> None:
    desk.goto(pages["block"])
    titles = desk.locator("figure svg title").all_text_contents()
    assert titles and len(titles) == desk.locator("figure svg").count() and min(map(len, titles)) > 20
