"""The tidied text of a document, and the places of its characters in the file."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from derive.documents.source import Format, Span, read_source, source_of
from derive.errors import DeriveError


def test_escapes_of_markdown_in_formulas_are_undone_and_logged() -> None:
    source = source_of("One_two, $a\\_1 \\* b$\nand $c\\_2$", Format.MARKDOWN)
    assert source.text == "One_two, $a_1 * b$\nand $c_2$"
    assert [(edit.line, edit.was, edit.reads) for edit in source.edits] == [
        (1, "\\_", "_"),
        (1, "\\*", "*"),
        (2, "\\_", "_"),
    ]


def test_a_place_is_that_of_the_file_after_edits() -> None:
    source = source_of("$a\\_1 \\* b$", Format.MARKDOWN)
    at = source.text.index("b")
    place = source.place(Span(at, at + 1))
    assert (place.line, place.column, place.text) == (1, 10, "$a\\_1 \\* b$")


def test_double_backslashes_before_brackets_are_read_as_delimiters() -> None:
    assert source_of("so \\\\(x = 1\\\\)", Format.MARKDOWN).text == "so \\(x = 1\\)"


def test_a_formula_in_a_quotation_has_no_marks_of_the_quotation() -> None:
    source = source_of("So\n\n> \\begin{equation}\n> a\\_1 > b\n> \\end{equation}\n", Format.MARKDOWN)
    assert source.text == "So\n\n\\begin{equation}\na_1 > b\n\\end{equation}\n"


def test_the_cells_of_a_notebook_have_places_in_its_file() -> None:
    cells = [
        {"cell_type": "code", "source": ["x = 1\n"]},
        {"cell_type": "markdown", "source": ["# A\n", "so $E = \\frac{m}{2} v^2$ holds"]},
    ]
    written = json.dumps({"cells": cells, "metadata": {}}, indent=1)
    source = source_of(written, Format.NOTEBOOK)
    at = source.text.index("\\frac")
    assert "x = 1" not in source.text
    place = source.place(Span(at, at + 5))
    assert written.split("\n")[place.line - 1][place.column - 1 :].startswith("\\\\frac")


@pytest.mark.parametrize(("name", "content"), [("a.docx", b""), ("b.tex", b"\xff\xfe"), ("c.ipynb", b"{")])
def test_a_file_that_cannot_be_read_is_refused_with_a_reason(tmp_path: Path, name: str, content: bytes) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(DeriveError, match=r"is not a document|is not in UTF-8|is not a notebook"):
        read_source(tmp_path / name)


@pytest.mark.parametrize(
    ("declared", "encoding"),
    [("", "latin-1"), ("[latin1]", "latin-1"), ("[latin9]", "iso8859-15"), ("[applemac]", "mac-roman")],
)
def test_an_old_file_in_another_encoding_is_read(tmp_path: Path, declared: str, encoding: str) -> None:
    text = f"\\usepackage{declared}{{inputenc}}\nThe work is for the mass, naïvely, $W = \\frac{{1}}{{2}} k x^2$.\n"
    (tmp_path / "old.tex").write_bytes(text.encode(encoding))
    assert read_source(tmp_path / "old.tex").text == text


def test_macros_of_included_files_in_the_folder_are_read(tmp_path: Path) -> None:
    from derive.documents.layout import read_document

    paper = tmp_path / "paper"
    (paper / "parts").mkdir(parents=True)
    (paper / "letters.sty").write_text("\\newcommand{\\mass}{M}")
    (paper / "parts" / "more.tex").write_text("\\input{parts/more}\\newcommand{\\radius}{R}")  # includes itself
    (tmp_path / "outside.tex").write_text("\\newcommand{\\secret}{S}")
    main = "\\usepackage{amsmath, letters}\n\\input{parts/more}\\input{../outside}\\input{/dev/zero}\n% \\input{x}\n"
    (paper / "main.tex").write_text(main)
    assert set(read_document(read_source(paper / "main.tex")).macros) == {"mass", "radius"}


def test_a_chapter_has_the_macros_of_its_main_document(tmp_path: Path) -> None:
    from derive.documents.layout import read_document

    (tmp_path / "parts").mkdir()
    (tmp_path / "other.tex").write_text("\\documentclass{book}\\newcommand{\\other}{O}")
    (tmp_path / "book.tex").write_text("\\documentclass{book}\\newcommand{\\mass}{M}\\include{parts/one}")
    chapter = tmp_path / "parts" / "one.tex"
    chapter.write_text("The momentum is $p = \\mass v$.")
    assert set(read_document(read_source(chapter)).macros) == {"mass"}
