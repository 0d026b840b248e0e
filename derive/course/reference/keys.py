"""The keys of `problems/<set>/reference.yaml`, and of `reference:` in a problem's own file."""

from __future__ import annotations

from dataclasses import dataclass

from derive.course.parts import UNIT
from derive.course.problem_file import GIVEN, SYMBOLS, VALUES, SortOfLetter
from derive.course.reference.quotes import LINE, LINES, QUOTATION, SIDES, Lines
from derive.course.schema import (
    FIGURES,
    MAX_FIGURES,
    SCALAR,
    TEXT,
    Reader,
    Record,
    as_written,
    key,
    list_of,
    mapping_of,
    one_or_more,
    record_of,
)
from derive.course.yaml_tree import Mapping, Tree, Word

SCALAR_TEXT = Reader(SCALAR.schema, TEXT.read)
_ENTRY_OR_ROW = {"anyOf": [SCALAR.schema, {"type": "array", "items": SCALAR.schema, "minItems": 3, "maxItems": 3}]}
_ANY_VALUE = as_written(
    {"anyOf": [SCALAR.schema, {"type": "array", "items": _ENTRY_OR_ROW, "minItems": 3, "maxItems": 3}]},
    "an expression, a list of 3, or 3 rows of 3",
)
_OUR_LETTER = {"anyOf": [TEXT.schema, {"type": "array", "items": SCALAR.schema, "minItems": 3, "maxItems": 3}]}
_OUR_LETTERS = mapping_of(as_written(_OUR_LETTER, "a letter of the problem"), "a mapping such as `I_1: I_xx`")


@dataclass(frozen=True)
class ErratumKeys(Record):
    """The keys of `erratum:`."""

    why: Word | None = key("what is wrong, in a few words", QUOTATION, required=True)
    right: Tree | None = key("the value that the document should state", _ANY_VALUE, required=True)


@dataclass(frozen=True)
class EntryKeys(Record):
    """The keys of one entry of `entries:`."""

    part: Word | None = key("the part of the document that has the value, such as `1`", SCALAR_TEXT)
    line: int | None = key("the line of the document", LINE)
    lines: Lines | None = key(
        "the lines of the document from which the formula is read, or the number of a section", LINES
    )
    side: tuple[int, ...] = key("the numbers of the compared sides of the cited formula; the first side is 1", SIDES)
    document: Word | None = key("the document of this entry, if it differs from the document that the file names", TEXT)
    answer: Word | None = key("the key of the step that has this value", TEXT)
    states: Tree | None = key("the value: an expression, a list of 3, or 3 rows of 3", _ANY_VALUE)
    latex: Tree | None = key(
        "the value as the document prints it, in LaTeX; every side of a chain `a = b` is compared",
        as_written(SCALAR.schema, "a formula in LaTeX"),
    )
    to: Tree | None = key(
        "significant figures to which decimals agree; a list has a number for each entry or for each of two branches",
        as_written(one_or_more(FIGURES.schema), f"a whole number from 1 to {MAX_FIGURES}, or a list of them"),
    )
    unit: Word | None = key("the unit of the stated value", Reader(UNIT, TEXT.read), called="in")
    put_in: Tree | None = key(
        "letters that the document has replaced by numbers; their numbers are substituted in both compared values",
        as_written(one_or_more(TEXT.schema), "letters that have numbers"),
        called="with",
    )
    times: Tree | None = key("the factor by which the document has multiplied the derived equation", SCALAR)
    quote: Word | None = key("what the document prints, words with formulas between `$`", QUOTATION)
    remark: Word | None = key(
        "a comment on a claim that is wrong, right by luck, incomplete or not a formula", QUOTATION
    )
    erratum: ErratumKeys | None = key(
        "the document is wrong here", record_of(ErratumKeys, "an erratum", "a mapping with `why` and `right`", "`{}`")
    )


_ENTRY = record_of(EntryKeys, "an entry", "a mapping with `answer` and `states` or `latex`")


@dataclass(frozen=True)
class GroupKeys(Record):
    """The keys of a group."""

    problem: Word | None = key("the problem of this set that the document solves", TEXT, required=True)
    symbols: dict[Word, SortOfLetter] = key(
        "letters of the document and their kinds, including letters that steps introduce", SYMBOLS
    )
    given: Mapping | None = key(
        "the input of the document, as under `given:` in the problem's file", GIVEN, required=True
    )
    letters: dict[Word, Tree] = key(
        "letters of the document that have another name here, `I_1: I_xx`, or are vectors, `L: [I_x*omega_x, 0, 0]`",
        _OUR_LETTERS,
    )
    values: dict[Word, Tree] = key(
        "numbers for letters; if a stated value does not contain one of these letters, the number of this letter is "
        "substituted in the derived value",
        VALUES,
    )
    entries: tuple[EntryKeys, ...] = key(
        "the values that the document states", list_of(_ENTRY, "a list of entries"), required=True
    )


@dataclass(frozen=True)
class DocumentKeys(Record):
    """The first item of the list in `reference.yaml`, if it names the document."""

    document: Word | None = key("the name of the document whose values the groups below state", TEXT, required=True)


@dataclass(frozen=True)
class OwnKeys(Record):
    """The keys of `reference:` in a problem's own file."""

    source: Word | None = key("the book and its section, or the document", TEXT, required=True)
    symbols: dict[Word, SortOfLetter] = key("letters that steps introduce, and their kinds", SYMBOLS)
    letters: dict[Word, Tree] = key(
        "letters of the source that have another name here: `I_1: I_xx`",
        _OUR_LETTERS,
    )
    entries: tuple[EntryKeys, ...] = key("the values that the source states", list_of(_ENTRY, "a list of entries"))
