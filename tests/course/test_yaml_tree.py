"""YAML with places: what is refused, and where a complaint points."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from derive.course.yaml_tree import Mapping, Scalar, Sequence, Source, as_text, read_yaml, yaml_tree
from derive.errors import Complaint, Faults, Rejected, nearest
from tests.courses import ROOT


def tree(text: str) -> Mapping:
    node = yaml_tree(Source("p.yaml", text))
    assert isinstance(node, Mapping)
    return node


def scalar(text: str, key: str = "a") -> Scalar:
    node = tree(text).get(key)
    assert isinstance(node, Scalar)
    return node


def complaints(text: str) -> tuple[Complaint, ...]:
    with pytest.raises(Rejected) as caught:
        yaml_tree(Source("p.yaml", text))
    return caught.value.complaints


def codes(text: str) -> list[str]:
    return [complaint.code for complaint in complaints(text)]


def underlined(place: object) -> str:
    assert hasattr(place, "text")
    return str(place.text[place.column - 1 : place.column - 1 + place.width])


def test_scalars_are_text_and_never_numbers_or_booleans() -> None:
    assert [scalar(f"a: {text}\n").text for text in ("yes", "1.50", "0o7", "2020-01-01")] == [
        "yes",
        "1.50",
        "0o7",
        "2020-01-01",
    ]


@pytest.mark.parametrize(
    ("text", "code", "marked", "help_line"),
    [
        ("a:\tb\n", "tab", "\t", "replace it with a space"),
        ("a: b\t\nc: d\n", "tab", "\t", "replace it with a space"),
        ("a:\n  b: 1\n\u00a0\u00a0c: 2\n", "yaml", "\u00a0", "replace it with a space, or delete it"),
        ("a:\u00a0b\nc: d\n", "yaml", "\u00a0", "replace it with a space, or delete it"),
        ("\u200ba: b\n", "yaml", "\u200b", "replace it with a space, or delete it"),
        ("a: {x:length}\n", "yaml", ":", "put a space after the `:`"),
    ],
)
def test_what_looks_like_a_space_is_named(text: str, code: str, marked: str, help_line: str) -> None:
    (found,) = complaints(text)
    assert (found.code, underlined(found.place), found.help) == (code, marked, help_line)


def test_spaces_of_other_kinds_may_be_in_a_text() -> None:
    assert scalar("a: 5\u00a0cm wide\n").text == "5\u00a0cm wide"
    assert [key.text for key, _ in tree('a: {"x:y": }\n').pairs] == ["a"]


@pytest.mark.parametrize("text", ["", "null", "~", "# a comment\n", "---\n"])
def test_a_file_that_says_nothing_is_empty(text: str) -> None:
    assert codes(text) == ["empty"]


def test_what_stands_for_nothing_is_as_nothing() -> None:
    assert [scalar(f"a: {text}\n").left_empty for text in ("", "null", "~", "Null", "NULL")] == [True] * 5
    assert [scalar(f"a: {text}\n").left_empty for text in ("nil", "none", "''", '"null"', "' '")] == [False] * 5
    assert list(tree("null: 1").get("null").text) == ["1"]  # type: ignore[union-attr]


def test_a_question_mark_within_brackets_asks_for_quotes() -> None:
    (complaint,) = complaints("parts:\n- {ask: How fast?, answer: speed}\n")
    assert (complaint.message, complaint.help) == ("a `?` ends the text within brackets", "put the text in quotes")
    assert complaint.place and (complaint.place.line, complaint.place.column) == (2, 17)


def test_every_node_knows_its_line_and_column() -> None:
    node = tree("a: 1\nb:\n  - x\n  - c: yy\n")
    items = node.get("b")
    assert isinstance(items, Sequence)
    inner = items.items[1]
    assert isinstance(inner, Mapping)
    value = inner.get("c")
    assert isinstance(value, Scalar)
    assert (value.place.line, value.place.column, value.place.width) == (4, 8, 2)
    assert (inner.pairs[0][0].place.line, inner.pairs[0][0].place.column) == (4, 5)


def test_a_tab_is_named_with_its_line() -> None:
    (tab,) = complaints("a:\n  b: 1\n\tc: 2\n \td: 3\n")
    assert (tab.code, tab.place and (tab.place.line, tab.place.column)) == ("tab", (3, 1))
    assert tab.notes == ("2 lines are indented by tabs",)


def test_a_tab_inside_text_is_no_fault() -> None:
    assert scalar("a: 'x\ty'\n").text == "x\ty"


def test_a_duplicate_key_tells_where_it_was_first() -> None:
    (twice,) = complaints("a: 1\nb: 2\na: 3\n")
    assert (twice.code, twice.place and twice.place.line, twice.notes) == (
        "duplicate-key",
        3,
        ("it was first given on line 1",),
    )


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("a: *b\n", "alias"),
        ("a: *b + c\n", "alias"),
        ("a: &b c\n", "anchor"),
        ("<<: {a: 1}\n", "merge-key"),
        ("a: !!python/object/apply:os.system [x]\n", "tag"),
        ("a: 1\n---\nb: 2\n", "documents"),
        ("", "empty"),
        ("# nothing\n", "empty"),
        ("? [a]\n: b\n", "key"),
        ("a: [1, 2\n", "yaml"),
        ("a: {b: 1\n", "yaml"),
        ("a: 'x\n", "yaml"),
        ("a: b: c\n", "yaml"),
        ("a: 1\n b: 2\n", "yaml"),
        ("a: @x\n", "yaml"),
        ('a: "\\w"\n', "yaml"),
        ("a: 'x' y\n", "yaml"),
        ("a\x07: 1\n", "control-character"),
        ("a: '\u202e'\n", "control-character"),
        ('a: "\\x1b[2J"\n', "control-character"),
        ("[" * 21 + "]" * 21, "too-deep"),
    ],
)
def test_clever_or_broken_yaml_is_one_complaint(text: str, code: str) -> None:
    assert codes(text) == [code]


def test_an_alias_is_met_with_the_help_to_quote_it() -> None:
    assert complaints("a: *b\n")[0].help == "quote an expression that begins with `*`"


def test_several_faults_are_told_together_and_in_the_order_of_the_file() -> None:
    assert codes("a: 1\na: &x 2\nb: !t 3\na: *x\n") == ["duplicate-key", "anchor", "tag", "duplicate-key", "alias"]


def test_nesting_up_to_the_limit_is_read() -> None:
    assert isinstance(yaml_tree(Source("p.yaml", "[" * 19 + "x" + "]" * 19)), Sequence)


def rejected_file(path: Path) -> list[str]:
    with pytest.raises(Rejected) as caught:
        read_yaml(path, "problems/x.yaml")
    return [complaint.code for complaint in caught.value.complaints]


def test_a_file_that_is_missing_huge_or_no_text_is_refused(tmp_path: Path) -> None:
    huge, latin, folder = tmp_path / "huge.yaml", tmp_path / "latin.yaml", tmp_path / "folder.yaml"
    huge.write_text("a: " + "x" * (256 * 1024))
    latin.write_bytes("a: 1\nb: caf\xe9\n".encode("latin-1"))
    folder.mkdir()
    assert rejected_file(tmp_path / "none.yaml") == ["missing-file"]
    assert rejected_file(huge) == ["too-large"]
    assert rejected_file(latin) == ["encoding"]
    assert rejected_file(folder) == ["unreadable"]


def test_a_byte_that_is_not_utf8_is_placed(tmp_path: Path) -> None:
    file = tmp_path / "latin.yaml"
    file.write_bytes(b"a: 1\nb: caf\xe9\n")
    with pytest.raises(Rejected) as caught:
        read_yaml(file, "p.yaml")
    place = caught.value.complaints[0].place
    assert place is not None
    assert (place.line, place.column) == (2, 7)


def test_a_mark_at_the_start_and_windows_line_ends_change_no_place(tmp_path: Path) -> None:
    file = tmp_path / "dos.yaml"
    file.write_bytes(b"\xef\xbb\xbfa: 1\r\nb: {c: 2}\r\n")
    node = read_yaml(file, "p.yaml")
    assert isinstance(node, Mapping)
    assert (node.pairs[1][1].place.line, node.pairs[1][1].place.text) == (2, "b: {c: 2}")


def test_a_long_line_is_cut_so_that_a_message_stays_readable() -> None:
    place = scalar("a: " + "x" * 10_000 + "\n").place
    assert len(place.text) < 250
    assert underlined(place) == "x" * 40


WORDS = ["mass", "and", "<<rate>>", "it's", 'a"b', "end", "ü", "c\\d"]


@pytest.mark.parametrize(
    "text",
    [
        "a: mass and <<rate>> it's a\"b end ü c\\d\n",
        "a: mass and <<rate>>\n  it's a\"b\n\n  end ü c\\d\n",
        "a: 'mass and <<rate>> it''s a\"b\n\n   end ü c\\d'\n",
        'a: "mass and <<rate>>\n  it\'s a\\"b \\\n end \\u00fc c\\\\d"\n',
        "a: >\n  mass and\n  <<rate>> it's\n\n  a\"b end\n  ü c\\d\n",
        "a: |  # kept as it is\n  mass and\n    <<rate>> it's\n  a\"b end\n\n  ü c\\d\n",
        "a: >-\n  mass and <<rate>>\n  it's a\"b\n  end ü c\\d",
    ],
)
def test_a_word_is_found_in_the_file_however_the_text_is_written(text: str) -> None:
    value = scalar(text)
    assert value.text.split() == WORDS
    for word in WORDS:
        place = value.place_within(value.text.index(word), len(word))
        written = underlined(place).replace("''", "'")
        if value.style == '"':
            written = written.replace('\\"', '"').replace("\\\\", "\\").replace("\\u00fc", "ü")
        assert written == word


@given(st.text(max_size=80))
def test_any_text_is_read_or_rejected(text: str) -> None:
    with suppress(Rejected):
        yaml_tree(Source("p.yaml", text))


@example(["a", "\r\n", "\r\n", "\r\n", "a"])
@given(st.lists(st.sampled_from([*"abA:-?[]{},#&*!|>'\"%@` \n\t<", "\\x", "- ", ": ", "<<", "\r\n"]), max_size=60))
def test_any_shuffle_of_yaml_marks_is_read_or_rejected(marks: list[str]) -> None:
    with suppress(Rejected):
        node = yaml_tree(Source("p.yaml", "".join(marks)))
        for value in [node, *(child for pair in getattr(node, "pairs", ()) for child in pair)]:
            for offset in range(len(value.text) + 1 if isinstance(value, Scalar) else 0):
                place = value.place_within(offset, 2)
                assert place.column - 1 <= len(place.text)


def test_the_nearest_name_is_found_whatever_its_case_and_only_if_it_is_near() -> None:
    assert nearest("Diagnal", ["x", "diagonal"]) == "diagonal"
    assert nearest("mass", ["Mass", "length"]) == "Mass"
    assert nearest("torque", ["mass", "length"]) is None


def test_faults_are_collected_once_and_let_other_errors_through() -> None:
    faults = Faults()
    place = Source("p.yaml", "a: 1\n").place(0)
    for _ in range(2):
        with faults:
            raise Rejected(Complaint("x", "said once", place))
    with pytest.raises(ZeroDivisionError), faults:
        raise ZeroDivisionError
    with pytest.raises(Rejected) as caught:
        faults.stop()
    assert [complaint.message for complaint in caught.value.complaints] == ["said once"]


@pytest.mark.parametrize("path", sorted((ROOT / "problems").rglob("*.yaml")), ids=lambda path: path.name)
def test_what_is_only_looked_at_reads_the_same(path: Path) -> None:
    quick, slow = read_yaml(path, "x.yaml", quickly=True), read_yaml(path, "x.yaml")
    assert as_text(quick) == as_text(slow)


@pytest.mark.parametrize(
    "text", ["a: [1", "a: *b", "a: &b c", "a: !t b", "<<: {a: b}", "a: b\na: c", "--- a\n--- b", "[[" * 20]
)
def test_what_is_only_looked_at_has_the_complaints_of_what_is_read(tmp_path: Path, text: str) -> None:
    (tmp_path / "x.yaml").write_text(text)
    said = []
    for quickly in (True, False):
        with pytest.raises(Rejected) as caught:
            read_yaml(tmp_path / "x.yaml", "x.yaml", quickly)
        said.append(str(caught.value))
    assert said[0] == said[1]


def test_a_decimal_comma_within_braces_does_not_split_a_number(tmp_path: Path) -> None:
    (tmp_path / "x.yaml").write_text("a: {b: 1,2 m, c: 0,8..1,6 m in steps of 0,1, d: [1,2,3]}\n")
    assert as_text(read_yaml(tmp_path / "x.yaml", "x.yaml")) == (
        "{'a': {'b': '1,2 m', 'c': '0,8..1,6 m in steps of 0,1', 'd': ['1', '2', '3']}}"
    )
