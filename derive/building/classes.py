"""The documents of a class: for each student a sheet, a key and solutions with the values of the student's variant.

`students/` has the sheets and nothing else. `class/` has what only the instructor sees: the solutions, the keys and the
table of all answers. What was made is recorded for each student, so a later run makes only documents whose inputs have
changed, also after a run that was killed.
"""

from __future__ import annotations

import base64
import csv
import hashlib
import io
import json
import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

from derive.building.cache import Cache, digest, file_digest, folder_digest
from derive.building.files import folder, write
from derive.building.lock import locked
from derive.building.preload import preload
from derive.building.recipe import recipe_digest, recipe_of
from derive.building.set_names import set_folder
from derive.building.tex import Engine, chosen_engine, typeset
from derive.building.workers import Bug, Crew, Job, done
from derive.course.names import KEY, LOGO, NAME, SHEET, SOLUTIONS
from derive.course.problem_set import ProblemSet, problem_set
from derive.errors import Complaint, DeriveError, Faults, Place, Rejected
from derive.grading.table import harmless

STUDENTS, CLASS = "students", "class"  # folders of a set's outputs
CACHE, MADE = ".derived", ".made"
ANSWERS = "answers"
KINDS = (SHEET, KEY, SOLUTIONS)
COLUMNS = ("student", "name", "problem", "part", "answer", "formula", "value", "unit", "figures")
AT_ONCE = 10  # students in one job, so that what a process has loaded and derived serves several of them
LONGEST_ROSTER = 2_000_000  # bytes


@dataclass(frozen=True)
class Student:
    """A student, and the code in the names of the student's files."""

    name: str
    code: str


@dataclass
class ClassReport:
    """How many students there are, for how many documents were made, and what went wrong."""

    students: int = 0
    made: int = 0
    complaints: list[Complaint] = field(default_factory=list)
    warnings: list[Complaint] = field(default_factory=list)
    bugs: list[Bug] = field(default_factory=list)
    seconds: float = 0.0

    @property
    def failed(self) -> bool:
        return bool(self.complaints or self.bugs)


def read_roster(path: Path) -> tuple[Student, ...]:
    """Return the students of a CSV file with a column `name` and, if wanted, a column `code`; raise `Rejected` with all
    errors of the file."""
    shown, faults = str(path), Faults()
    try:
        if path.stat().st_size > LONGEST_ROSTER:
            raise Rejected(Complaint("roster", f"`{shown}` is larger than {LONGEST_ROSTER // 10**6} MB"))
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeError) as error:
        raise Rejected(Complaint("roster", f"`{shown}` cannot be read: {error}")) from None
    lines = text.splitlines()
    delimiter = ";" if lines and ";" in lines[0] and "," not in lines[0] else ","
    table = csv.DictReader(io.StringIO(text), delimiter=delimiter)
    columns = {(name or "").strip().lower(): name for name in table.fieldnames or ()}
    if "name" not in columns:
        place = Place(shown, 1, 1, lines[0] if lines else "", 1)
        raise Rejected(Complaint("roster", "the roster has no column `name`", place, help="its first line names them"))
    found: list[Student] = []
    taken: dict[str, int] = {}
    for row in table:
        line = table.line_num
        place = Place(shown, line, 1, lines[line - 1] if line <= len(lines) else "", 1)
        name = " ".join((row[columns["name"]] or "").split())
        code = (row[columns["code"]] or "").strip() if "code" in columns else ""
        if not name:
            faults.error("roster", "this line has no name", place)
            continue
        code = code or code_of(name)
        if not NAME.fullmatch(code):
            faults.error("roster", f"`{code}` cannot be a code: use letters, digits, `-` and `_`", place)
        elif code.lower() in taken:
            help_line = "give each student a code of its own, in a column `code`"
            faults.error("roster", f"line {taken[code.lower()]} has the same code, `{code}`", place, help=help_line)
        else:
            taken[code.lower()] = line
            found.append(Student(name, code))
    if not found and not faults:
        faults.error("roster", "the roster has no student", Place(shown, 1))
    faults.stop()
    return tuple(found)


def code_of(name: str) -> str:
    """Return a code of six letters and digits that depends on the name only."""
    return base64.b32encode(hashlib.sha256(name.encode()).digest()).decode()[:6]


@dataclass(frozen=True)
class ClassDocuments:
    """What the documents of a class have in common."""

    root: Path
    set_id: str
    heading: ProblemSet
    seed: str
    engine: Engine
    limit: float

    @property
    def outputs(self) -> Path:
        return set_folder(self.root, self.set_id)

    def file(self, student: Student, kind: str) -> Path:
        if kind == SHEET:
            return self.outputs / STUDENTS / f"{student.code}.pdf"
        return self.outputs / CLASS / f"{student.code}-{kind}.pdf"


@dataclass(frozen=True)
class Made:
    """The documents of one student: the rows of the table of answers, or the errors of the student's variant."""

    code: str
    answers: tuple[tuple[str, ...], ...] = ()
    complaints: tuple[Complaint, ...] = ()
    warnings: tuple[Complaint, ...] = ()


def made_class(
    root: Path,
    set_id: str,
    students: Sequence[Student],
    seed: str = "",
    engine: str | None = None,
    jobs: int = 0,
    limit: float = 120,
    tell: Callable[[str], None] = lambda _: None,
) -> ClassReport:
    """Make the documents of each student whose inputs have changed. An error in one variant stops no other student."""
    begun, chosen = time.monotonic(), chosen_engine(engine)
    heading = done(Job(f"`problems/{set_id}/set.yaml`", partial(problem_set, root, set_id), limit))
    shared = ClassDocuments(root, set_id, heading, seed, chosen, limit)
    report = ClassReport(len(students))
    with locked(folder(shared.outputs), lambda: tell(f"waiting for another build of `{set_id}`")):
        record = _Record(shared, students)
        waiting = [student for student in students if not record.is_current(student)]
        if waiting:
            preload(root, derives=True, draws=True, set_id=set_id)
        groups = [waiting[start : start + AT_ONCE] for start in range(0, len(waiting), AT_ONCE)]

        def tick(_: Mapping[str, float]) -> None:
            tell(f"{set_id}: documents of {report.made} of {len(waiting)} students ({time.monotonic() - begun:.0f} s)")

        with Crew(jobs or os.cpu_count() or 1, tick) as crew:
            for number, group in enumerate(groups):
                work = partial(_documents_of, shared, group)
                crew.put(Job(f"documents {number + 1} of {len(groups)}", work, limit * len(group)))
            for outcome in crew.outcomes():
                if isinstance(outcome.error, DeriveError):
                    report.complaints += outcome.error.complaints
                elif outcome.error:
                    report.bugs.append(outcome.error)
                for made in outcome.value or ():
                    report.complaints += made.complaints
                    report.warnings += [each for each in made.warnings if each not in report.warnings]
                    if not made.complaints:
                        report.made += 1
                        record.add(made)
                record.save()
        record.finish()
        Cache(shared.outputs / CACHE).evict()
    report.seconds = time.monotonic() - begun
    return report


def _documents_of(shared: ClassDocuments, students: Sequence[Student]) -> list[Made]:
    return [_documents_of_one(shared, student) for student in students]


def _documents_of_one(shared: ClassDocuments, student: Student) -> Made:
    from derive.building.set_document import document_page, the_document
    from derive.building.solution import rendered
    from derive.course.problem import problem_and_faults
    from derive.course.variants import chosen_for

    told, pages, cache = "", [], Cache(shared.outputs / CACHE)
    try:
        for problem_id in shared.heading.problems:
            variations = problem_and_faults(shared.root, problem_id)[0].variations
            chosen = chosen_for(shared.set_id, problem_id.rpartition("/")[2], variations, student.code, shared.seed)
            told = ", ".join(f"{each.name} = {each.told(chosen[each.name])}" for each in variations)
            page = rendered(
                shared.root, problem_id, None, cache, True, ("latex", "html", "json"),
                shared.heading.evidence, (KEY, SHEET), chosen,
            )  # fmt: skip
            pages.append(page)
        own = replace(shared.heading, student=f"{student.name} ({student.code})")
        drawings = [file for page in pages for file in page.files if file[0].endswith(".pdf")]
        logo = [(LOGO, own.logo)] if own.logo else []
        for kind in KINDS:
            tex = the_document(kind)(shared.root, own, pages)
            typeset(
                tex, shared.file(student, kind), shared.engine, timeout=shared.limit,
                log=shared.outputs / "log", included=[*drawings, *logo], formats=replace(cache, fresh=False),
            )  # fmt: skip
        write(shared.file(student, SHEET).with_suffix(".html"), document_page(shared.root, own, pages, SHEET))
    except DeriveError as error:
        note = f"in the variant of {student.name} ({student.code})" + (f": {told}" if told else "")
        complaints = (replace(each, notes=(*each.notes, note)) for each in error.complaints)
        return Made(student.code, complaints=tuple(complaints))
    rows = [row for page in pages for row in _rows(student, page.id, json.loads(page.texts["json"]))]
    return Made(student.code, tuple(rows), warnings=tuple(warning for page in pages for warning in page.warnings))


def _rows(student: Student, problem: str, page: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """Return a row of the table of answers for each answer of a page."""
    rows = list[tuple[str, ...]]()
    for part in page["parts"]:
        for key in part["answers"]:
            answer = page["answers"][key]
            number = answer["number"] or {}
            value, unit = str(number.get("value", "")), number.get("unit", answer["unit"])
            of_part = (student.code, student.name, problem, part["label"], key)
            rows.append((*of_part, answer["sympy"], value, unit, str(number.get("figures") or "")))
    return rows


class _Record:
    """What was made for each student: the key of the inputs, the digest of each file, and the rows of the answers."""

    def __init__(self, shared: ClassDocuments, students: Sequence[Student]):
        self.shared, self.students = shared, students
        self.file = shared.outputs / CLASS / MADE
        recipe = recipe_of(shared.root, None, shared.heading.evidence)
        inputs = [file_digest(shared.root / path) for path in shared.heading.inputs]
        course = folder_digest(shared.root / "problems" / shared.set_id, "*")
        self.common = digest("class", recipe_digest(recipe), shared.engine.identity, shared.seed, course, *inputs)
        try:
            read = json.loads(self.file.read_bytes())
        except (OSError, ValueError):
            read = {}
        known = read.items() if isinstance(read, dict) else ()  # its names are names of files
        self.made: dict[str, Any] = {code: made for code, made in known if NAME.fullmatch(code)}

    def _key(self, student: Student) -> str:
        return digest(self.common, student.name, student.code)

    def _files(self, student: Student) -> list[Path]:
        sheet = self.shared.file(student, SHEET).with_suffix(".html")
        return [sheet, *(self.shared.file(student, kind) for kind in KINDS)]

    def is_current(self, student: Student) -> bool:
        """Whether the inputs of the student's documents are as they were, and the documents are as they were made."""
        known = self.made.get(student.code)
        return (
            isinstance(known, dict)
            and known.get("key") == self._key(student)
            and known.get("files") == [file_digest(file) for file in self._files(student)]
        )

    def add(self, made: Made) -> None:
        student = next(each for each in self.students if each.code == made.code)
        files = [file_digest(file) for file in self._files(student)]
        self.made[made.code] = {"key": self._key(student), "files": files, "answers": made.answers}

    def save(self) -> None:
        write(self.file, json.dumps(self.made))

    def finish(self) -> None:
        """Remove the documents of those who are no longer in the roster, and write the table of answers."""
        codes = {student.code for student in self.students}
        for code in [code for code in self.made if code not in codes]:
            for file in self._files(Student("", code)):
                file.unlink(missing_ok=True)
            del self.made[code]
        self.save()
        table = io.StringIO()
        rows = csv.writer(table)
        rows.writerow(COLUMNS)
        for student in self.students:
            if known := self.made.get(student.code):
                rows.writerows([plain(cell) for cell in row] for row in known["answers"])
        write(self.shared.outputs / CLASS / f"{ANSWERS}.csv", table.getvalue())


def plain(cell: str) -> str:
    """Return a number unchanged, and any other cell so that no spreadsheet runs it as a formula."""
    return cell if _is_number(cell) else harmless(cell)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
