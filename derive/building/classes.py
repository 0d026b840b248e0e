"""The documents of a class: for each student a sheet, a key and solutions with the values of the student's variant.

The folder `students/` contains the sheets. The folder `class/` contains the files for the instructor: the solutions,
the keys and the table of all answers. A later run makes only the documents that are out of date.
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
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any
from unicodedata import normalize

from derive.building.cache import CACHE, Cache, digest, file_digest, folder_digest
from derive.building.class_record import ClassRecord
from derive.building.cluster import Cluster
from derive.building.document_list import list_again
from derive.building.files import folder, shown_path, write
from derive.building.lock import locked
from derive.building.manifest import Manifest
from derive.building.preload import preload
from derive.building.recipe import recipe_digest, recipe_of, stated_by
from derive.building.set_names import set_folder
from derive.building.staleness import MOST, Asked, staleness
from derive.building.template_line import own_templates
from derive.building.tex import Engine, chosen_engine, typeset
from derive.building.workers import Bug, Crew, Ended, Job, done
from derive.course.names import CLASS, INDEX, KEY, LOGO, NAME, SHEET, SOLUTIONS, STUDENTS
from derive.course.problem_set import ProblemSet, problem_set
from derive.errors import Complaint, DeriveError, Faults, Misused, Place, Rejected
from derive.grading.table import harmless, read_cells

MADE = ".made"
ANSWERS = "answers"
KINDS = (SHEET, KEY, SOLUTIONS)
COLUMNS = ("student", "name", "problem", "part", "answer", "formula", "value", "unit", "figures")
AT_ONCE = 10  # the greatest number of students in one job
RESEED = "leave out `--seed`; with `--reseed`, students get values that differ from those on their present sheets"


@dataclass(frozen=True)
class Student:
    """A student, and the code in the names of the student's files."""

    name: str
    code: str

    @property
    def named(self) -> str:
        return f"{self.name} ({self.code})"


def named_students(students: Sequence[Student]) -> str:
    """Return the names and codes of the first students, and the number of the others."""
    more = [f"and {len(students) - MOST} more"] if students[MOST:] else []
    return ", ".join([*(each.named for each in students[:MOST]), *more])


@dataclass
class ClassReport:
    """The outcome of a run of `derive class`.

    made     the number of students whose documents were made
    kept     the number of students whose documents were already up to date
    without  the students whose documents could not be made because of an error
    """

    students: int = 0
    made: int = 0
    kept: int = 0
    without: list[Student] = field(default_factory=list)
    complaints: list[Complaint] = field(default_factory=list)
    warnings: list[Complaint] = field(default_factory=list)
    bugs: list[Bug] = field(default_factory=list)
    seconds: float = 0.0

    @property
    def failed(self) -> bool:
        return bool(self.complaints or self.bugs)

    def add(self, made: Made) -> None:
        """Add the outcome for one student. Errors that differ only in their notes are reported once."""
        self.warnings += [each for each in made.warnings if each not in self.warnings]
        if made.error is None:
            self.made += 1
            return
        self.without.append(made.student)
        if isinstance(made.error, Bug):
            self.bugs.append(made.error)
            return
        known = {(each.code, each.message, each.place) for each in self.complaints}
        self.complaints += [
            each for each in made.error.complaints if (each.code, each.message, each.place) not in known
        ]


def read_roster(path: Path) -> tuple[Student, ...]:
    """Return the students of a CSV file with the column `name`, and optionally `code`; raise `Rejected` with the errors
    of the file."""
    shown, faults = str(path), Faults()
    try:
        cells = read_cells(path.read_bytes(), shown)
    except OSError as error:
        message, help_line = f"`{shown}` cannot be read: {error.strerror}", "give the path of a readable CSV file"
        raise Rejected(Complaint("roster", message, help=help_line)) from None
    columns = [name.lower() for name in cells.heading]
    if "name" not in columns:
        place = Place(shown, 1, 1, cells.first, 1)
        raise Rejected(
            Complaint("roster", "the roster has no column `name`", place, help="name the columns in the first line")
        )
    found: list[Student] = []
    taken: dict[str, int] = {}
    for line, row in cells.rows:
        place = Place(shown, line, 1, cells.delimiter.join(row), 1)
        of_column = dict(zip(columns, row, strict=False))
        name = normalize("NFC", " ".join(of_column.get("name", "").split()))
        code = of_column.get("code", "").strip()
        if any(cell.strip() for cell in row[len(columns) :]):
            help_line = f"put a cell that contains `{cells.delimiter}` in double quotes"
            faults.error("roster", "this line has more cells than the first line", place, help=help_line)
            continue
        if not name:
            faults.error("roster", "this line has no name", place)
            continue
        code = code or code_of(name)
        if not NAME.fullmatch(code):
            help_line = "use at most 64 letters, digits, `-` and `_`; begin with a letter or a digit"
            faults.error("roster", f"`{code}` cannot be a code", place, help=help_line)
        elif code.lower() in taken:
            help_line = "give each student a different code, in a column `code`"
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
class MadeFrom:
    """The record of the documents of one student: the digest of their inputs, the digests of the files, and the
    student's rows of the table of answers."""

    key: str
    files: list[str]
    answers: list[list[str]]


@dataclass(frozen=True)
class ClassDocuments:
    """The data that the documents of all students of a class share.

    inputs   the digest of all inputs that the students share
    """

    root: Path
    set_id: str
    heading: ProblemSet
    seed: str
    engine: Engine
    limit: float
    inputs: str

    @property
    def outputs(self) -> Path:
        return set_folder(self.root, self.set_id)

    def file(self, student: Student, kind: str) -> Path:
        if kind == SHEET:
            return self.outputs / STUDENTS / f"{student.code}.pdf"
        return self.outputs / CLASS / f"{student.code}-{kind}.pdf"

    def files(self, student: Student) -> list[Path]:
        return [self.file(student, SHEET).with_suffix(".html"), *(self.file(student, kind) for kind in KINDS)]

    def record(self, student: Student) -> Path:
        return self.outputs / CLASS / MADE / f"{student.code}.json"

    def key(self, student: Student) -> str:
        return digest(self.inputs, student.name, student.code)

    def answers(self, student: Student) -> list[list[str]] | None:
        """Return the student's rows of the table of answers; None if the documents are out of date."""
        made = self.made(student)
        is_current = made is not None and made.key == self.key(student)
        if made is None or not is_current or made.files != [file_digest(file) for file in self.files(student)]:
            return None
        return made.answers

    def made(self, student: Student) -> MadeFrom | None:
        """Return the record of the student's documents; None if there is no valid record."""
        try:
            known = json.loads(self.record(student).read_bytes())
            answers = [[str(cell) for cell in row] for row in known["answers"]]
            return MadeFrom(str(known["key"]), [str(file) for file in known["files"]], answers)
        except (OSError, ValueError, KeyError, TypeError):
            return None


@dataclass(frozen=True)
class Made:
    """The outcome for one student: the warnings, or the error of the student's variant."""

    student: Student
    error: DeriveError | Bug | None = None
    warnings: tuple[Complaint, ...] = ()
    seconds: float = 0.0

    @property
    def ended(self) -> Ended:
        return Ended("failed" if self.error else "made", self.student.named, self.seconds)


def made_class(
    root: Path,
    set_id: str,
    students: Sequence[Student],
    seed: str | None = None,
    engine: str | None = None,
    jobs: int = 0,
    limit: float = 120,
    tell: Callable[[str], None] = lambda _: None,
    scheduler: str = "",
    reseed: bool = False,
    ended: Callable[[Ended], None] = lambda _: None,
) -> ClassReport:
    """Make the documents of the students, except documents that are up to date. An error in the variant of one student
    does not stop the work for other students.

    seed        by default the seed with which the class was made before
    reseed      whether `seed` may differ from the seed with which the class was made before
    scheduler   the address of a Dask scheduler, whose workers do the jobs; by default, processes of this machine do the
                jobs
    ended       is called for each student whose documents are made or whose variant has an error
    """
    root = root.resolve()
    begun, chosen = time.monotonic(), chosen_engine(engine)
    heading = done(Job(f"`problems/{set_id}/set.yaml`", partial(problem_set, root, set_id), limit))
    _check_codes(students, heading)
    before = ClassRecord.read(root, set_id)
    if before is not None and not reseed:
        before.check_seed(seed, RESEED)
    seed = seed if seed is not None else before.seed if before else ""
    shared = ClassDocuments(root, set_id, heading, seed, chosen, limit, _inputs(root, set_id, heading, chosen, seed))
    report = ClassReport(len(students))
    waiting: dict[Job, Sequence[Student]] = {}
    with locked(folder(shared.outputs), lambda: tell(f"waiting for another build of `{set_id}`")):
        ClassRecord(set_id, seed, {each.code: each.name for each in students}).save(root)
        unmade = [student for student in students if shared.answers(student) is None]
        report.kept = len(students) - len(unmade)
        if unmade and not scheduler:
            preload(root, derives=True, draws=True, set_id=set_id)

        def put(crew: Crew | Cluster, group: Sequence[Student]) -> None:
            job = Job(f"the documents of {group[0].code}", partial(_documents_of, shared, group), limit * len(group))
            waiting[job] = group
            crew.put(job)

        def tick(_: Mapping[str, float]) -> None:
            count = report.made + len(report.without)
            tell(f"{set_id}: documents of {count} of {len(unmade)} students ({time.monotonic() - begun:.0f} s)")

        with Cluster(scheduler, tick) if scheduler else Crew(jobs or os.cpu_count() or 1, tick) as crew:
            for start in range(0, len(unmade), AT_ONCE):
                put(crew, unmade[start : start + AT_ONCE])
            for outcome in crew.outcomes():
                group = waiting.pop(outcome.job)
                if outcome.error is not None and len(group) > 1:  # the job failed, so each student gets a separate job
                    for student in group:
                        put(crew, [student])
                    continue
                failed = [Made(group[0], _about(group[0], outcome.error), seconds=outcome.seconds)]
                for made in outcome.value if outcome.error is None else failed:
                    ended(made.ended)
                    report.add(made)
        report.warnings += _remove_others(shared, students, before)
        current = {each.code for each in students if shared.answers(each) is not None}
        older = [each for each in students if each.code not in current and any(map(Path.exists, shared.files(each)))]
        if older:
            report.warnings.append(_older(shared, older))
        report.warnings += _older_set(root, set_id, engine)
        report.warnings += _same_for_all(shared)
        _write_answers(shared, students)
        _write_page(shared, students, current)
        Cache(shared.outputs / CACHE).evict()
    list_again(root, set_id)
    report.seconds = time.monotonic() - begun
    return report


def _older(shared: ClassDocuments, students: Sequence[Student]) -> Complaint:
    message = f"documents from an earlier run remain for {named_students(students)}"
    help_line = f"correct the errors; until then `{CLASS}/{INDEX}.html` does not link to these documents"
    return Complaint("older", message, help=help_line, severity="warning")


def _older_set(root: Path, set_id: str, engine: str | None) -> list[Complaint]:
    if (
        not Manifest.read(set_folder(root, set_id)).pages
        or not staleness(Asked(root, set_id, (), engine=engine)).reasons
    ):
        return []
    message = f"outputs of the set in `{shown_path(set_folder(root, set_id))}` are out of date"
    return [Complaint("older", message, help=f"`derive build {set_id}` makes them again", severity="warning")]


def _check_codes(students: Sequence[Student], heading: ProblemSet) -> None:
    names = {INDEX, *(file.lower() for _, file in heading.documents)}
    for student in students:
        if student.code.lower() in names:
            message = f"the code `{student.code}` of {student.name} is the name of a document of the set"
            raise Misused(Complaint("roster", message, help="give this student a different code"))


def class_is_older(root: Path, set_id: str, engine: Engine) -> list[Complaint]:
    """Return a warning if an input of documents of a class has changed, or if only some of the documents were made."""
    record = ClassRecord.read(root, set_id)
    if record is None:
        return []
    shared = _shared(root, record, engine)
    students = [Student(name, code) for code, name in record.students.items()]
    made = {student: found.key for student in students if (found := shared.made(student))}
    where = f"documents of the class in `{shown_path(shared.outputs)}`"
    help_line = f"`derive class {set_id}`, with the same roster, makes them again"
    if any(key != shared.key(student) for student, key in made.items()):
        return [Complaint("older", f"{where} are out of date", help=help_line, severity="warning")]
    if made and len(made) < len(students):
        missing = [student for student in students if student not in made]
        message = f"the {where} are incomplete: those of {named_students(missing)} were not made"
        return [Complaint("older", message, help=help_line, severity="warning")]
    return []


def why_of_class(root: Path, built: Path, engine: str | None) -> str | None:
    """Return a text that says whether, and why, a document of a student is out of date; None if no class has such a
    document."""
    folder_of, set_id = built.parent.name, built.parent.parent.name
    record = ClassRecord.read(root, set_id)
    if record is None or folder_of not in (CLASS, STUDENTS) or not NAME.fullmatch(set_id):
        return None
    names = {code: [code, *(f"{code}-{kind}" for kind in KINDS)] for code in record.students}
    code = next((code for code, stems in names.items() if built.stem in stems), None)
    if code is None:
        return None
    shown, student = f"build/{set_id}/{folder_of}/{built.name}", Student(record.students[code], code)
    shared = _shared(root, record, chosen_engine(engine))
    if shared.answers(student) is not None:
        return f"{shown} is up to date"
    again = f"to bring it up to date: `derive class {set_id}`, with the same roster"
    return f"{shown} is out of date:\n  {_why(shared, student)}\n{again}"


def _why(shared: ClassDocuments, student: Student) -> str:
    made = shared.made(student)
    if made is None:
        return "the last run did not finish these documents, or they were removed"
    if made.key != shared.key(student):
        return "an input of the class has changed"
    return "a file was edited or removed"


def _shared(root: Path, record: ClassRecord, engine: Engine) -> ClassDocuments:
    heading = problem_set(root, record.set_id)
    inputs = _inputs(root, record.set_id, heading, engine, record.seed)
    return ClassDocuments(root, record.set_id, heading, record.seed, engine, 0, inputs)


def _inputs(root: Path, set_id: str, heading: ProblemSet, engine: Engine, seed: str) -> str:
    recipe = recipe_of(root, of_set=stated_by(heading))
    files = [file_digest(root / path) for path in heading.inputs]
    course = folder_digest(root / "problems" / set_id, "*")
    return digest("class", recipe_digest(recipe), engine.identity, seed, course, *files)


def _documents_of(shared: ClassDocuments, students: Sequence[Student]) -> list[Made]:
    made = []
    for student in students:
        begun = time.monotonic()
        made.append(replace(_documents_of_one(shared, student), seconds=time.monotonic() - begun))
    return made


def _documents_of_one(shared: ClassDocuments, student: Student) -> Made:
    from derive.building.set_document import document_page, the_document
    from derive.building.solution import rendered
    from derive.course.problem_file import written_problem
    from derive.course.variants import chosen_for
    from derive.render.notation.latex import unprintable

    if shared.answers(student) is not None:
        return Made(student)
    told, pages, cache = "", [], Cache(shared.outputs / CACHE)
    try:
        for problem_id in shared.heading.problems:
            variations = written_problem(shared.root, problem_id, Faults()).variants
            chosen = chosen_for(shared.set_id, problem_id.rpartition("/")[2], variations, student.code, shared.seed)
            told = ", ".join(f"{each.name} = {each.told(chosen[each.name])}" for each in variations)
            page = rendered(
                shared.root, problem_id, shared.heading.detail, cache, True, ("latex", "html", "json"),
                shared.heading.evidence, (KEY, SHEET), chosen,
            )  # fmt: skip
            pages.append(page)
        own = replace(shared.heading, student=student.named)
        drawings = [file for page in pages for file in page.files if file[0].endswith(".pdf")]
        logo = [(LOGO, own.logo)] if own.logo else []
        in_pdf = own if unprintable(student.name) is None else replace(own, student=student.code)
        for kind in KINDS:
            tex = the_document(kind)(shared.root, in_pdf, pages)
            typeset(
                tex, shared.file(student, kind), shared.engine, timeout=shared.limit,
                log=shared.outputs / "log", included=[*drawings, *logo], formats=replace(cache, fresh=False),
                templates=own_templates(shared.root),
            )  # fmt: skip
        write(shared.file(student, SHEET).with_suffix(".html"), document_page(shared.root, own, pages, SHEET))
    except DeriveError as error:
        return Made(student, _about(student, error, told))
    rows = [row for page in pages for row in _rows(student, page.id, json.loads(page.texts["json"]))]
    files = [file_digest(file) for file in shared.files(student)]
    write(shared.record(student), json.dumps({"key": shared.key(student), "files": files, "answers": rows}))
    warnings = [warning for page in pages for warning in page.warnings]
    if in_pdf is not own:
        name, code = student.name, student.code
        message = f"the fonts of the PDF lack a letter of `{name}`, so the PDF has only the code `{code}`"
        help_line = "write the name in Latin letters in the roster, or use the page for a browser, which shows the name"
        warnings.append(Complaint("character", message, help=help_line, severity="warning"))
    return Made(student, warnings=tuple(warnings))


def _about(student: Student, error: DeriveError | Bug | None, choices: str = "") -> DeriveError | Bug | None:
    """Return an error with a note that names the student."""
    if not isinstance(error, DeriveError):
        return error
    note = f"in the variant of {student.named}" + (f": {choices}" if choices else "")
    return type(error)(replace(each, notes=(*each.notes, note)) for each in error.complaints)


def _rows(student: Student, problem: str, page: Mapping[str, Any]) -> list[tuple[str, ...]]:
    rows = list[tuple[str, ...]]()
    for part in page["parts"]:
        for key in part["answers"]:
            answer = page["answers"][key]
            number = answer["number"] or {}
            value, unit = _number_told(number.get("value", "")), number.get("unit", answer["unit"])
            of_part = (student.code, student.name, problem, part["label"], key)
            rows.append((*of_part, answer["text"], value, unit, str(number.get("figures") or "")))
    return rows


def _number_told(value: float | str | Sequence[float]) -> str:
    """Return a number, or the components of a vector in the form in which `derive grade` reads them."""
    return f"({', '.join(map(str, value))})" if isinstance(value, list) else str(value)


def _same_for_all(shared: ClassDocuments) -> list[Complaint]:
    """Return a warning if no problem of the set has variants."""
    from derive.course.problem_file import written_problem

    with suppress(DeriveError):  # the errors of the problems are already reported
        if not any(written_problem(shared.root, each, Faults()).variants for each in shared.heading.problems):
            message = f"no problem of `{shared.set_id}` has `variants:`, so all students have the same values"
            return [Complaint("variants", message, severity="warning")]
    return []


def _remove_others(shared: ClassDocuments, students: Sequence[Student], before: ClassRecord | None) -> list[Complaint]:
    """Remove the documents of students who are no longer in the class, even if the user has removed the folder
    `class/`. Return a warning that names the students."""
    known = dict(before.students) if before else {}
    earlier = {record.stem for record in (shared.outputs / CLASS / MADE).glob("*.json")}
    earlier |= {code for code in known if NAME.fullmatch(code)}
    others = [Student(known.get(code, ""), code) for code in sorted(earlier - {student.code for student in students})]
    for student in others:
        for file in (*shared.files(student), shared.record(student)):
            file.unlink(missing_ok=True)
    if not others:
        return []
    message = f"not in the roster any more, so their documents were removed: {named_students(others)}"
    help_line = "if only a name changed, give the student the earlier code in a column `code`"
    return [Complaint("roster", message, help=help_line, severity="warning")]


def _write_answers(shared: ClassDocuments, students: Sequence[Student]) -> None:
    table = io.StringIO()
    rows = csv.writer(table)
    rows.writerow(COLUMNS)
    for student in students:
        rows.writerows([plain(cell) for cell in row] for row in shared.answers(student) or ())
    write(shared.outputs / CLASS / f"{ANSWERS}.csv", table.getvalue())


def _write_page(shared: ClassDocuments, students: Sequence[Student], current: set[str]) -> None:
    from derive.building.set_document import class_page

    folder = shared.outputs / CLASS
    shown = []
    for student in students:
        files = [(kind, shared.file(student, kind)) for kind in KINDS]
        links = [(kind, os.path.relpath(file, folder)) for kind, file in files if student.code in current]
        shown.append({"name": student.name, "code": student.code, "files": links})
    write(folder / f"{INDEX}.html", class_page(shared.root, shared.heading, shown))


def plain(cell: str) -> str:
    """Return a number unchanged, and any other cell in a form that no spreadsheet runs as a formula."""
    return cell if _is_number(cell) else harmless(cell)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
