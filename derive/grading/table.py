"""Many answers at once, as CSV: a row for each answer, and the same rows with their verdicts.

A spreadsheet runs a cell that begins with a sign such as `=` as a formula, so an apostrophe is written before such a
cell.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from derive.errors import Complaint, Place, Rejected

LARGEST, MOST_ROWS, LONGEST_CELL = 20_000_000, 100_000, 100_000  # bytes, rows, characters
NEEDED, SET_NEEDED = ("part", "answer"), ("problem", "part", "answer")
ADDED = ("verdict", "explanation", "reading", "credit")
_RUNS = ("=", "+", "-", "@", "\t", "\r", "|", "%")


@dataclass(frozen=True)
class Row:
    """One answer, with all cells of its row and its line number in the file.

    is_split   whether the row has text beyond the last column of the first line; its answer may then be cut
    """

    line: int
    cells: tuple[str, ...]
    student: str
    problem: str
    part: str
    answer: str
    is_split: bool = False


@dataclass
class Table:
    heading: tuple[str, ...]
    rows: list[Row] = field(default_factory=list)
    delimiter: str = ","


def read_table(content: bytes, path: str, problem: str = "") -> Table:
    """Read the answers; `problem` is the problem of each row that does not name one."""
    cells = read_cells(content, path)
    columns = _columns(cells.heading, path, cells.first, not problem)
    rows = [_row(line, row, columns, len(cells.heading), problem) for line, row in cells.rows]
    return Table(cells.heading, rows, cells.delimiter)


@dataclass(frozen=True)
class Cells:
    """The cells of a CSV file; `first` is the text of its first line, and each row has the number of its line."""

    heading: tuple[str, ...]
    first: str
    delimiter: str
    rows: list[tuple[int, list[str]]]


def read_cells(content: bytes, path: str) -> Cells:
    """Return the cells of a CSV file in UTF-8, without its empty rows. The separator is `,`, `;` or a tab."""
    if len(content) > LARGEST:
        raise Rejected(Complaint("too-large", f"`{path}` has more than {LARGEST // 1_000_000} million bytes"))
    try:
        text = content.decode("utf-8-sig").replace("\0", "\ufffd")
    except UnicodeDecodeError as error:
        message = f"`{path}` is not in UTF-8; the first byte that does not fit is at position {error.start}"
        raise Rejected(Complaint("encoding", message, help="save it as CSV in UTF-8")) from error
    first = text.partition("\n")[0].rstrip("\r")
    delimiter = max(",;\t", key=first.count)
    csv.field_size_limit(LARGEST)
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True)
    line, rows = 1, list[tuple[int, list[str]]]()
    try:
        heading = tuple(cell.strip() for cell in next(reader, []))
        line = reader.line_num + 1  # a cell in quotes may contain line breaks
        for cells in reader:
            if any(cell.strip() for cell in cells):
                rows.append((line, cells))
            line = reader.line_num + 1
            if len(rows) > MOST_ROWS:
                raise Rejected(Complaint("too-large", f"`{path}` has more than {MOST_ROWS} rows"))
    except csv.Error:
        shown = "".join(text.splitlines(keepends=True)[line - 1 : line]).rstrip()
        help_line = "put quotes around each cell that contains a quotation mark, and write this mark twice"
        message = "the quotation marks of this row do not match"
        raise Rejected(Complaint("csv", message, Place(path, line, 1, shown, 1), help=help_line)) from None
    return Cells(heading, first, delimiter, rows)


def _columns(heading: tuple[str, ...], path: str, first: str, with_problem: bool) -> dict[str, int]:
    found = {name.lower(): i for i, name in reversed([*enumerate(heading)])}
    if missing := [name for name in (SET_NEEDED if with_problem else NEEDED) if name not in found]:
        message = f"`{path}` has no column {' and no column '.join(f'`{name}`' for name in missing)}"
        place = Place(path, 1, 1, first[:120], max(1, min(len(first), 120)))
        columns = ", ".join(("student", *SET_NEEDED) if with_problem else ("student", *NEEDED))
        raise Rejected(Complaint("csv", message, place, help=f"the first line names the columns: {columns}"))
    return found


def _row(line: int, cells: Sequence[str], columns: dict[str, int], width: int, problem: str) -> Row:
    padded = [cell[:LONGEST_CELL] for cell in (*cells, *[""] * (width - len(cells)))][:width]

    def cell(name: str) -> str:
        text = padded[columns[name]] if name in columns else ""
        return text[1:] if text.startswith("'") and text[1:].lstrip().startswith(_RUNS) else text

    named = cell("problem").strip()
    is_split = any(each.strip() for each in cells[width:])
    return Row(line, tuple(padded), cell("student"), named or problem, cell("part"), cell("answer"), is_split)


def written_table(table: Table, verdicts: Iterable[Sequence[str]]) -> str:
    """Return the rows with the columns of `ADDED`; a column that the table already has is replaced."""
    kept = [i for i, name in enumerate(table.heading) if name.lower() not in ADDED]
    out = io.StringIO()
    writer = csv.writer(out, delimiter=table.delimiter, lineterminator="\n")
    writer.writerow([*(harmless(table.heading[i]) for i in kept), *ADDED])
    for row, (*texts, credit) in zip(table.rows, verdicts, strict=True):
        writer.writerow([*(harmless(row.cells[i]) for i in kept), *map(harmless, texts), credit])
    return out.getvalue()


def harmless(text: str) -> str:
    """Return a text with an apostrophe before it if a spreadsheet would run it as a formula."""
    return f"'{text}" if text.lstrip().startswith(_RUNS) or text.startswith(_RUNS) else text
