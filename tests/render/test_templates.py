"""The templates of TeX escape the values that they print, and report errors with their lines."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from derive.course.parts import points_text
from derive.errors import Complaint, Rejected
from derive.page.template import Templates, templates_of, unused_templates
from derive.render.printing.templates import bookmark_text, filled_template
from derive.render.rendered import Tex
from tests.courses import ROOT


def filled(folder: Path, text: str, **facts: Any) -> Tex:
    (folder / "templates" / "latex").mkdir(parents=True)
    (folder / "templates" / "latex" / "set.tex.j2").write_text(text, encoding="utf-8")
    return filled_template(Templates((folder / "templates",)), "set.tex.j2", facts)


def refusal(folder: Path, text: str, **facts: Any) -> Complaint:
    with pytest.raises(Rejected) as caught:
        filled(folder, text, **facts)
    (complaint,) = caught.value.complaints
    return complaint


def test_a_template_of_tex_is_as_bound_as_a_phrase(tmp_path: Path) -> None:
    complaint = refusal(tmp_path, "fine\n<< page.__class__.__mro__ >>\n", page=1)
    assert complaint.code == "template"
    assert complaint.place is not None
    assert complaint.place.line == 2


def test_what_a_template_prints_is_escaped_unless_it_is_tex_of_ours(tmp_path: Path) -> None:
    text = '<< date >> << "%" >> << tex >>'
    tex = filled(tmp_path, text, date=r"\input{x}", tex=Tex(r"\today"))
    assert r"\input" not in tex
    assert tex.endswith(r"{\%} \today")


@pytest.mark.parametrize(
    ("text", "message", "line"),
    [
        ("a\n<< heading.nothing >>\n", "no attribute is called `nothing`", 2),
        ("a\n<< heading.titel >>\n", "no attribute is called `titel`; did you mean `title`?", 2),
        ("a\n<< heading.title >\\par\n", "unexpected character `\\`", 2),
        ("a\n<% if heading.title >>\n", "unexpected character `>`", 2),
        ("<< headin >>\n", "no value is called `headin`", 1),
        ("a\n\n<< 1/0 >>\n", "division by zero", 3),
        ("a\n<% endfor %>\n", "unknown tag 'endfor'", 2),
        ("<% include 'other.j2' %>", "the template `other.j2` does not exist", 0),
    ],
)
def test_a_broken_template_is_told_at_its_line(tmp_path: Path, text: str, message: str, line: int) -> None:
    complaint = refusal(tmp_path, text, heading=SimpleNamespace(title=1))
    assert (complaint.code, message in complaint.message.lower()) == ("template", True)
    place = complaint.place
    assert (place.path, place.line) == ("templates/latex/set.tex.j2", line) if place else line == 0


def test_a_template_that_is_not_there_is_told_with_its_folder(tmp_path: Path) -> None:
    with pytest.raises(Rejected) as caught:
        filled_template(Templates((tmp_path / "templates",)), "cover.tex.j2", {})
    assert caught.value.complaints[0].help == "it belongs in `templates/latex`"


def test_a_fault_of_what_a_template_asks_for_is_ours_and_not_the_templates(tmp_path: Path) -> None:
    with pytest.raises(AttributeError, match="denominator"):
        filled(tmp_path, "<< points('many') >>", points=points_text)


def test_a_bookmark_has_no_mathematics_and_no_letters_that_its_viewer_lacks() -> None:
    assert bookmark_text("50% ω") == r"50{\%} \unichar{969}"


def test_a_template_of_the_course_replaces_the_one_of_the_same_name(tmp_path: Path) -> None:
    """The other templates are those of derive, and an error names the file of the course."""
    own = tmp_path / "templates" / "latex"
    own.mkdir(parents=True)
    (own / "heading.tex.j2").write_text("Course: << heading.course >>")
    templates = templates_of(tmp_path)
    heading = {"course": "A_B"}
    assert filled_template(templates, "heading.tex.j2", {"heading": heading}) == r"Course: A{\_}B"
    assert templates.file("latex/set.tex.j2") == ROOT / "templates" / "latex" / "set.tex.j2"
    (own / "heading.tex.j2").write_text("\n<< heading.course ")
    with pytest.raises(Rejected) as caught:
        filled_template(templates, "heading.tex.j2", {"heading": heading})
    place = caught.value.complaints[0].place
    assert place and (place.path, place.line) == ("templates/latex/heading.tex.j2", 2)


def test_a_template_that_nothing_uses_is_reported(tmp_path: Path) -> None:
    own = tmp_path / "templates" / "latex"
    own.mkdir(parents=True)
    (own / "headng.tex.j2").write_text("x")
    (own / "heading.tex.j2").write_text('<% include "logo.tex.j2" %>')
    (own / "logo.tex.j2").write_text("x")
    (complaint,) = unused_templates(tmp_path)
    assert "templates/latex/headng.tex.j2" in complaint.message
    assert complaint.help == "did you mean `heading.tex.j2`?"
    assert unused_templates(ROOT) == []


@pytest.mark.parametrize(
    ("name", "help_line"),
    [
        ("heading.tex.j2", "put it in `templates/latex`"),
        ("tex/heading.tex.j2", "put it in `templates/latex`"),
        ("latex/own/heading.tex.j2", "put it in `templates/latex`"),
        ("latex/style.css", "put it in `templates/html`"),
        ("phrases/de/own.yml", "rename it to `own.yaml`"),
        ("README.md", None),
    ],
)
def test_a_template_in_a_wrong_place_is_reported(tmp_path: Path, name: str, help_line: str | None) -> None:
    file = tmp_path / "templates" / name
    file.parent.mkdir(parents=True)
    file.write_text("x")
    found = unused_templates(tmp_path)
    assert [(each.message.split("`")[1], each.help) for each in found] == (
        [(f"templates/{name}", help_line)] if help_line else []
    )


def test_phrases_outside_of_the_folder_of_a_language_have_no_effect(tmp_path: Path) -> None:
    for name in ("own.yaml", "phrases/own.yaml", "phrases/dee/a.yaml", "phrases/de/a.yaml"):
        file = tmp_path / "templates" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("labels: {problem: Exercise}\n")
    complaints = unused_templates(tmp_path)
    assert [each.message.split("`")[1] for each in complaints] == [
        "templates/own.yaml", "templates/phrases/dee/a.yaml", "templates/phrases/own.yaml"
    ]  # fmt: skip
    assert complaints[1].help == "put it in `templates/phrases/de`"
