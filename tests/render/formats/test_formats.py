"""A new module in the folder of formats defines a format for `--format`, for rendering, and for builds."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import derive.render.formats
from derive.cli.options import main
from derive.render.formats import built_formats, formats
from tests.courses import course_in, rendered_once
from tests.fake_course import stand_in_course

MARKDOWN = """
from derive.render.formats import Format, Solution


def _rendered(solution: Solution) -> str:
    from derive.render.notation.latex import latex
    from derive.render.printing.text_page import inline_text

    page, notation = solution.document, solution.notation
    results = [solution.derivation.step(key).result for part in solution.problem.parts for key in part.answers]
    return "\\n".join(
        [f"# {inline_text(page.title, notation)}", *(f"- ${latex(notation.result(each))}$" for each in results), ""]
    )


FORMAT = Format("stand_in", "si", _rendered)
"""


@pytest.fixture
def stand_in(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    folder = tmp_path / "more"
    folder.mkdir()
    (folder / "stand_in.py").write_text(MARKDOWN, encoding="utf-8")
    monkeypatch.setattr(derive.render.formats, "__path__", [*derive.render.formats.__path__, str(folder)])
    yield
    sys.modules.pop("derive.render.formats.stand_in", None)


def test_formats_are_known_by_their_names() -> None:
    known = {name: form.suffix for name, form in formats().items()}
    assert known.items() >= {"json": "json", "text": "txt"}.items()
    built = [form.suffix for form in built_formats().values()]
    assert len({*built, "tex", "pdf", "html", "svg"}) == len(built) + 4, "no two outputs of a build have one name"
    assert {"markdown": "md", "notebook": "ipynb", "fragment": "tex"}.items() <= known.items()
    assert not {"markdown", "notebook", "fragment"} & set(built_formats())


@pytest.mark.usefixtures("stand_in")
def test_a_page_is_rendered_in_a_format_that_was_added(tmp_path: Path) -> None:
    title, *answers = rendered_once(course_in(tmp_path / "course"), "hw9/block").texts["stand_in"].splitlines()
    assert title == "# A block turning about a long diagonal"
    assert len(answers) > 3
    assert all(answer.startswith("- $") for answer in answers)


@pytest.mark.usefixtures("stand_in")
def test_the_command_line_and_a_build_have_a_format_that_was_added(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    course = stand_in_course(tmp_path / "course", monkeypatch)
    assert main(["solve", "hw1/one", "--format", "stand_in"]) == 0
    assert capfd.readouterr().out == "first ω\n"
    assert main(["build", "hw1"]) == 0
    assert course.contents()["one.si"] == "first ω\n".encode()
    assert "solutions.si" not in course.contents(), "a document of the whole set is typeset"
    course.heading("two")
    assert main(["build", "hw1"]) == 0
    assert [name for name in course.contents() if name.endswith(".si")] == ["two.si"]
