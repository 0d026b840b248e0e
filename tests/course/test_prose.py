"""Prose: its mentions in their places, and what only looks like one."""

from __future__ import annotations

import pytest

from derive.course.prose import EQUATION, FIGURE, PROBLEM, Mention, Prose, TexFormula, latex_in, read_prose
from derive.course.yaml_tree import Mapping, Scalar, Source, yaml_tree
from derive.errors import Complaint, Faults, Rejected


def read(text: str) -> tuple[Prose | None, tuple[Complaint, ...]]:
    tree = yaml_tree(Source("x.yaml", text))
    assert isinstance(tree, Mapping)
    faults = Faults()
    prose = read_prose(tree.pairs[0][1], "title", faults)
    try:
        faults.stop()
    except Rejected as rejected:
        return prose, rejected.complaints
    return prose, ()


def prose(text: str) -> Prose:
    found, faults = read(text)
    assert found is not None
    assert faults == ()
    return found


def test_text_and_mentions_come_in_their_order() -> None:
    found = prose("title: A top of <<mass>>, by <<eq torque>> and << problem hw-1 >> of <<figure axes>>")
    pieces = [(p.of, p.name) if isinstance(p, Mention) else p for p in found.pieces]
    assert pieces == [
        "A top of ",
        ("", "mass"),
        ", by ",
        (EQUATION, "torque"),
        " and ",
        (PROBLEM, "hw-1"),
        " of ",
        (FIGURE, "axes"),
    ]
    assert [mention.name for mention in found.mentions] == ["mass", "torque", "hw-1", "axes"]


@pytest.mark.parametrize("mark", [">", "|"])
def test_a_paragraph_may_begin_with_a_mention(mark: str) -> None:
    gap = "\n\n\n" if mark == ">" else "\n\n"
    found = prose(f"title: {mark}\n  A top.{gap}  <<figure axes>> shows\n  <<mass>>.\n").paragraphs
    texts = [[piece if isinstance(piece, str) else "..." for piece in paragraph] for paragraph in found]
    line_end = " " if mark == ">" else "\n"
    assert texts == [["A top."], ["...", f" shows{line_end}", "...", "."]]


def test_a_mention_stands_where_it_is_written() -> None:
    found = prose("title: A top of <<mass>>, <<mass>> and <<rate>>")
    assert (found.place_of("mass").column, found.place_of("mass").width) == (17, 8)
    assert found.place_of("rate").column == 40
    assert found.place_of("nothing") == found.place


@pytest.mark.parametrize("text", ["'plain % \\textbf{a} {{b}} {% if %}'", "a < b", "a > b >> c"])
def test_other_signs_are_text(text: str) -> None:
    assert prose(f"title: {text}").pieces == (text.strip("'"),)


@pytest.mark.parametrize("odd", ["<<a b>>", "<<1>>", "<<>>", "<<a.>>", "<<a", "<< c", "<%if%>", "<# a #>", "<<é>>"])
def test_what_is_almost_a_mention_is_told_at_its_place(odd: str) -> None:
    _, faults = read(f'title: "say {odd}"')
    assert [(fault.code, fault.place and fault.place.column) for fault in faults] == [("mention", 13)]


def test_a_comment_that_cuts_a_text_short_is_told_and_one_in_quotes_is_text() -> None:
    for cut in ("sheet #3", "sheet # 3", "sheet #three"):
        assert [fault.code for fault in read(f"title: {cut}")[1]] == ["comment-in-text"]
    assert prose("title: sheet  # for 3 weeks").text == "sheet"
    assert prose("title: 'sheet #3'").text == "sheet #3"
    assert prose("title: sheet#3").text == "sheet#3"


def test_a_list_is_no_text() -> None:
    found, faults = read("title: [a, b]")
    assert found is None
    assert faults[0].message == "`title` must be text, but it is a list"


def test_pieces_of_prose_are_all_of_it_in_order() -> None:
    text = "a << mass >>b<<rate>> >> c"
    prose = read_prose(Scalar(text, "", 0, len(text), Source("p.yaml", text)), "ask", Faults())
    assert prose is not None
    said = [piece.name if isinstance(piece, Mention) else piece for piece in prose.pieces]
    assert said == ["a ", "mass", "b", "rate", " >> c"]


@pytest.mark.parametrize(
    ("text", "printed", "help_line"),
    [
        (r"a rate \alpha of", r"\alpha", r"write `$\alpha$`"),
        (r"about \frac{1}{2} of it", r"\frac{1}{2}", r"write `$\frac{1}{2}$`"),
        ("starts with v_0 at <<x_0>>", "v_0", "write `$v_0$`"),
        ("the curve y = x^2", "x^2", "write `$x^2$`"),
        ("the square <<x>>^2", "<<x>>^2", "write a formula between dollar signs: `$x^2$`"),
        (r"of \(x\)", r"\(", "write a formula between dollar signs: `$x^2$`"),
    ],
)
def test_latex_outside_of_dollar_signs_is_printed_unchanged_with_a_warning(
    text: str, printed: str, help_line: str
) -> None:
    warning = latex_in(prose(f"title: '{text}'"))
    assert warning is not None
    assert (warning.code, warning.severity, warning.help) == ("latex-in-prose", "warning", help_line)
    place = warning.place
    assert place is not None
    assert f"title: '{text}'"[place.column - 1 :].startswith(printed[-place.width :])


@pytest.mark.parametrize(
    "text", ["a ticket of $5 and one of $7", "$5/$7 each", "of <<v_0>> m/s", "one \\ other", "5$", "$x^2$"]
)
def test_a_price_a_mention_and_a_formula_are_not_loose_latex(text: str) -> None:
    assert latex_in(prose(f"title: '{text}'")) is None


def test_one_warning_tells_of_all_latex_of_a_text() -> None:
    warning = latex_in(prose(r"title: 'of v_0 and x^2, and \alpha'"))
    assert warning is not None
    assert warning.notes == ("2 more in this text",)


@pytest.mark.parametrize(
    ("text", "pieces"),
    [
        ("a wire $y = x^2/(2b)$ here", ["a wire ", ["y = x^2/(2b)"], " here"]),
        ("$ x $, $y$", [["x"], ", ", ["y"]]),
        ("sides $a$, 2$a$ and 3$a$", ["sides ", ["a"], ", 2", ["a"], " and 3", ["a"]]),
        (r"it costs \$ a", ["it costs ", "$", " a"]),
        ("from $5 to $7", ["from $5 to $7"]),
        ("$5/$7 each, of $m$", ["$5/$7 each, of ", ["m"]]),
        ("5$ or 7$", ["5$ or 7$"]),
        (r"$2\pi$ and $0.5 a$", [[r"2\pi"], " and ", ["0.5 a"]]),
        ("<<x>>$x$<<y>>", ["x", ["x"], "y"]),
    ],
)
def test_a_formula_is_between_dollar_signs_and_a_price_is_text(text: str, pieces: list[object]) -> None:
    found = [
        piece.name if isinstance(piece, Mention) else [piece.tex] if isinstance(piece, TexFormula) else piece
        for piece in prose(f"title: '{text}'").pieces
    ]
    assert found == pieces


def test_a_formula_keeps_its_place_in_folded_text() -> None:
    text = "title: >-\n  A wire bent to\n  the curve $y =\n  x^2$ and\n  its axis $z$\n"
    (first, second) = prose(text).formulas
    assert (first.tex, first.scalar.place.line, first.scalar.place.column) == ("y = x^2", 3, 14)
    assert (second.scalar.place.line, second.scalar.place.column) == (5, 13)
    place = first.scalar.place_within(4)
    assert (place.line, place.column) == (4, 3)


@pytest.mark.parametrize(
    ("text", "column", "message"),
    [
        ("'a $ b'", 11, "this `$` belongs neither to a formula nor to a price"),
        ("'a $$x b'", 11, "this `$$` does not begin a formula"),
        ("'a $ $ b'", 12, "there is no formula between these dollar signs"),
        ("'a $x = <<x>>$ b'", 16, "a formula cannot contain a mention"),
        (r'"a $\theta$ b"', 12, "in double quotes, YAML reads a `\\` and a letter as one character: `\\t` is a tab"),
        ("'$" + "x + " * 100 + "x$'", 10, "this formula has 401 characters; a formula in prose may have at most 400"),
    ],
)
def test_a_formula_without_end_is_an_error_at_its_place(text: str, column: int, message: str) -> None:
    _, (fault,) = read(f"title: {text}")
    assert fault.place is not None
    assert (fault.message, fault.place.column) == (message, column)
    assert fault.help is not None


def test_two_backslashes_in_double_quotes_are_one() -> None:
    assert prose(r'title: "a $\\theta$ b"').formulas[0].tex == r"\theta"


def test_a_formula_between_double_dollar_signs_has_a_line_of_its_own() -> None:
    pieces = prose("title: 'so $$x = a$$. With $b$ it'").pieces
    assert [(piece.tex, piece.displayed) for piece in pieces if isinstance(piece, TexFormula)] == [
        ("x = a", True),
        ("b", False),
    ]
