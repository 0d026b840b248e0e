"""The problems and sets that exist, and the contents of the files of a course and of a set."""

from __future__ import annotations

import os
from collections.abc import Sequence as List
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from derive.course.names import (
    DOCUMENTS,
    ENGLISH,
    INDEX,
    NAME,
    OF_EVERY_SET,
    DecimalSign,
    EvidenceShown,
    FontSize,
    Language,
    Paper,
)
from derive.course.parts import FORM_OF_SET, AnswerForm
from derive.course.schema import LINE, TEXT, Reader, Record, key, keys_of, list_of, one_of, read_record, wrong_type
from derive.course.yaml_tree import Mapping, Scalar, Sequence, Tree, Word, read_yaml, shape_of
from derive.errors import Complaint, DeriveError, Faults, Misused, Rejected, did_you_mean, nearest
from derive.steps.level import Level

COURSE = "course.yaml"  # the file with the keys that all sets of a course share
LARGEST_LOGO = 2_000_000  # bytes
PNG = b"\x89PNG\r\n\x1a\n"  # the first bytes of a PNG file
_NOT_PROBLEMS = ("set", "reference")


# the default documents of a set, each with the name of its files
THOSE_OF_EVERY_SET = tuple((kind, kind) for kind in OF_EVERY_SET)


@dataclass(frozen=True)
class ProblemSet:
    """What a set and its course state: the heading, the ids of the problems (`hw9/block`) in order, and settings."""

    id: str
    course: str
    title: str
    problems: tuple[str, ...]
    inputs: tuple[str, ...]
    institution: str | None = None
    instructor: str | None = None
    term: str | None = None
    date: str | None = None
    logo: bytes | None = None
    evidence: EvidenceShown = EvidenceShown.NONE
    documents: tuple[tuple[str, str], ...] = THOSE_OF_EVERY_SET
    paper: Paper = Paper.LETTER
    language: Language = ENGLISH
    font_size: FontSize | None = None
    detail: str | None = None
    form: AnswerForm | None = None
    student: str = ""  # the student for whom a document is made

    @property
    def facts(self) -> list[str]:
        """The lines of a title page about the course and the document, in the order in which they are printed."""
        known = (self.course, self.institution, self.instructor, self.term, self.date, self.student)
        return [fact for fact in known if fact]

    @property
    def form_in_words(self) -> str:
        """The default form of answers as text; empty if neither the set nor its course states one."""
        units, figures = (self.form.units, self.form.figures) if self.form else ((), None)
        return ", ".join([*units, *([f"{figures} figures"] if figures else [])])

    @property
    def numbers(self) -> dict[str, int]:
        """The number of each problem in the set, by its name."""
        return {full.partition("/")[2]: number for number, full in enumerate(self.problems, 1)}


DOCUMENTS_SCHEMA = {
    "anyOf": [
        {"type": "array", "items": {"enum": list(DOCUMENTS)}, "minItems": 1},
        {
            "type": "object",
            "additionalProperties": False,
            "minProperties": 1,
            "properties": {kind: {"type": "string", "pattern": f"^{NAME.pattern}$"} for kind in DOCUMENTS},
        },
    ]
}


def _documents(node: Tree, name: str, faults: Faults) -> dict[Word, Word] | None:
    """Read `[solutions, hints]`, or `{solutions: hw9-solutions}` with names of files."""
    pairs: list[tuple[Tree, Tree]] = []
    if isinstance(node, Mapping) and node.pairs:
        pairs = [(kind, file) for kind, file in node.pairs]
    elif isinstance(node, Sequence) and node.items:
        pairs = [(item, item) for item in node.items]
    else:
        wrong_type(faults, f"`{name}`", "a list of documents, or a mapping of documents to names of files", node)
    found: dict[Word, Word] = {}
    for kind, file in pairs:
        if not isinstance(kind, Scalar) or not isinstance(file, Scalar):
            wrong_type(faults, "a document", "a name", file if isinstance(kind, Scalar) else kind)
        elif kind.text not in DOCUMENTS:
            help_line = did_you_mean(kind.text, DOCUMENTS) or f"the documents are {', '.join(DOCUMENTS)}"
            faults.error("no-such-document", f"`{kind.text}` is not a document of a set", kind.place, help=help_line)
        elif not NAME.fullmatch(file.text):
            faults.error("document-name", f"`{file.text}` cannot be the name of a file", file.place)
        else:
            found[kind.word] = file.word
    return found


@dataclass(frozen=True)
class CourseKeys(Record):
    """The keys of `course.yaml`, which all sets of the course share."""

    course: Word | None = key("the name of the course", LINE)
    institution: Word | None = key("the university, the department or the school", LINE)
    instructor: Word | None = key("the instructor of the course", LINE)
    term: Word | None = key("the term as it is to be printed", LINE)
    logo: Word | None = key("a PNG file in the folder of the course, for the title of each document of a set", TEXT)
    evidence: str | None = key("how much solutions show about their verification", one_of(tuple(EvidenceShown)))
    paper: str | None = key("the size of the pages, by default `letter`", one_of(tuple(Paper)))
    language: Word | None = key("the language of the pages: a folder of `templates/phrases`, by default `en`", TEXT)
    decimal: str | None = key("the decimal sign, by default the sign of the language", one_of(tuple(DecimalSign)))
    font_size: str | None = key(
        "the size of the text in PDFs, by default `11 pt`, and `10 pt` at the detail `brief`", one_of(tuple(FontSize))
    )
    detail: str | None = key("how much algebra pages show if `--detail` is not given", one_of(tuple(Level)))
    form: AnswerForm | None = key(
        "units and significant figures of the answers whose part states none: `{unit: [degree, cm], figures: 3}`; each "
        "answer uses the first unit that fits",
        FORM_OF_SET,
    )


@dataclass(frozen=True)
class SetKeys(CourseKeys):
    """The keys of a set's file."""

    title: Word | None = key("the heading of the set", LINE, required=True)
    date: Word | None = key("the date as it is to be printed", LINE)
    documents: dict[Word, Word] = key(
        "the documents to build, or a mapping from each document to the name of its files",
        Reader(DOCUMENTS_SCHEMA, _documents, dict),
        instead_of="papers",
    )
    problems: tuple[Word, ...] = key(
        "names of the problems in order", list_of(TEXT, "a list of names", each="a problem of the set"), required=True
    )


def problem_ids(root: Path) -> list[str]:
    """Return the ids, such as `hw9/block`, of all problem files below the root."""
    return sorted(problem_paths(root))


def ids_in_order(root: Path) -> list[str]:
    """Return the ids of all problems, set by set, each set in the order of its list. Unlisted problems come last in
    their set."""
    listed: list[str] = []
    for set_id in set_ids(root):
        with suppress(DeriveError):
            listed += problem_set(root, set_id).problems
    place = {full: number for number, full in enumerate(listed)}
    return sorted(problem_ids(root), key=lambda full: (full.partition("/")[0], place.get(full, len(place)), full))


def problem_paths(root: Path) -> dict[str, str]:
    """Return the file of each problem by the problem's id. Paths are relative to the root, such as
    `problems/hw9/block.yaml` or `problems/library/rotation/wheel.yaml`; files without a valid name are left out."""
    top = root / "problems"
    files = [file for depth in ("*/*.yaml", "*/*/*.yaml") for file in sorted(top.glob(depth), reverse=True)]
    found = [file.relative_to(top) for file in files if file.stem not in _NOT_PROBLEMS]
    named_well = (file for file in found if all(NAME.fullmatch(name) for name in (*file.parent.parts, file.stem)))
    return {f"{file.parts[0]}/{file.stem}": f"problems/{file.as_posix()}" for file in named_well}


def found_path(root: Path, problem_id: str) -> str | None:
    """Return the file of one problem, relative to the root; None if it does not exist."""
    set_id, _, name = problem_id.partition("/")
    if not (NAME.fullmatch(set_id) and NAME.fullmatch(name)) or name in _NOT_PROBLEMS:
        return None
    folder = root / "problems" / set_id
    files = [folder / f"{name}.yaml", *sorted(folder.glob(f"*/{name}.yaml"), reverse=True)]
    named_well = [file for file in files if file.parent == folder or NAME.fullmatch(file.parent.name)]
    there = [file for file in named_well if os.path.lexists(file)]
    return f"problems/{there[-1].relative_to(root / 'problems').as_posix()}" if there else None


def topic_of(path: str) -> str:
    """Return the folder of a problem's file within its set; "" for a file next to `set.yaml`."""
    parts = path.split("/")
    return parts[2] if len(parts) > 3 else ""


def path_of(root: Path, problem_id: str) -> str:
    """Return the problem's file, relative to the root; raise `Misused` if the problem does not exist."""
    if path := found_path(root, problem_id):
        return path
    paths = problem_paths(root)
    if own := sorted(each for each in paths if each.startswith(f"{problem_id}/")):
        help_line = f"name one of its problems: {', '.join(own)}"
        raise Misused(Complaint("no-such-problem", f"`{problem_id}` is a set", help=help_line))
    help_line = _meant(problem_id, list(paths))
    raise Misused(Complaint("no-such-problem", f"no problem is called `{problem_id}`", help=help_line))


def _meant(problem_id: str, known: list[str]) -> str:
    by_name = {full.partition("/")[2]: full for full in reversed(known)}
    close = nearest(problem_id, known) or by_name.get(nearest(problem_id.rpartition("/")[2], by_name) or "")
    return f"did you mean `{close}`?" if close else "`derive list` shows the problems"


def set_ids(root: Path) -> list[str]:
    """Return the names of the folders in `problems/` that have the file of a set and a valid name."""
    folders = sorted(file.parent.name for file in (root / "problems").glob("*/set.yaml"))
    return [name for name in folders if NAME.fullmatch(name)]


def known_set(root: Path, set_id: str) -> str:
    """Return the name of the set; raise `Misused` if the set does not exist."""
    known = set_ids(root)
    if set_id not in known:
        folder = root / "problems" / set_id
        problems = sorted(file.stem for file in folder.glob("*.yaml")) if NAME.fullmatch(set_id) else []
        of_folder = f"write `problems/{set_id}/set.yaml` with `problems: [{', '.join(problems)}]`" if problems else None
        help_line = of_folder or did_you_mean(set_id, known) or "`derive list` shows the sets"
        raise Misused(Complaint("no-such-set", f"no set is called `{set_id}`", help=help_line))
    return set_id


def problem_set(root: Path, set_id: str) -> ProblemSet:
    """Return the set. Raise `Misused` if it does not exist. Raise one `Rejected` if its file or the file of the course
    has errors."""
    path = f"problems/{known_set(root, set_id)}/set.yaml"
    faults = Faults()
    of_course = _course(root, faults)
    node = mapping_in(root, path, "a set")
    written = read_record(SetKeys, node, "a set", faults)
    problems = _listed(written.problems, set_id, problem_ids(root), faults)
    logo_path = written.logo or of_course.logo
    logo = _logo(root, logo_path, faults) if logo_path else None
    _clashes(written.documents, [full.partition("/")[2] for full in problems], faults)
    misspelt = any(nearest(name.text, ["course"]) for name, _ in node.pairs if name.text not in keys_of(SetKeys))
    if not (written.course or of_course.course or misspelt) and node.get("course") is None:
        help_line = f"write it here, or in `{COURSE}` for all sets of the course"
        faults.error("missing-key", "a set needs `course`: the name of the course", node.place, help=help_line)
    faults.stop()

    def own(name: str) -> str | None:
        """Return the value of a key of the set or, if the set does not have this key, of the course. Return None if
        both lack the key."""
        found: str | None = getattr(written, name) or getattr(of_course, name)
        return found

    return ProblemSet(
        set_id,
        own("course") or "",
        written.title or "",
        problems,
        (path, *((COURSE,) if (root / COURSE).is_file() else ()), *((str(logo_path),) if logo_path else ())),
        own("institution"),
        own("instructor"),
        own("term"),
        written.date,
        logo,
        EvidenceShown(own("evidence") or EvidenceShown.NONE),
        tuple((str(kind), str(file)) for kind, file in written.documents.items()) or THOSE_OF_EVERY_SET,
        Paper(own("paper") or Paper.LETTER),
        language_of(root, set_id),
        FontSize(size) if (size := own("font_size")) else None,
        own("detail"),
        written.form or of_course.form,
    )


def language_of(root: Path, set_id: str) -> Language:
    """Return the language of the pages of a set. The file of the set may be missing, or have errors in other keys."""
    found = _shared(root, set_id, "language", "decimal")
    decimal = found.get("decimal")
    return Language(found.get("language", Language.name), DecimalSign(decimal) if decimal else None)


def form_of_set(root: Path, set_id: str) -> AnswerForm | None:
    """Return the default form of answers in a set; None if no file states one, or if it cannot be read. Errors are not
    reported here, but when the set is read."""
    with suppress(DeriveError):
        form: AnswerForm | None = _shared(root, set_id, "form").get("form")
        return form
    return None


def logo_of_set(root: Path, set_id: str) -> str | None:
    """Return the path of the logo that the set or its course names; None if neither names one, or if a file cannot be
    read."""
    with suppress(DeriveError):
        logo: str | None = _shared(root, set_id, "logo").get("logo")
        return logo
    return None


def _shared(root: Path, set_id: str, *names: str) -> dict[str, Any]:
    """Read the keys with these names from the set or, if the set does not have them, from the course. Other keys are
    not read."""
    faults, keys = Faults(), keys_of(CourseKeys)
    found: dict[str, Any] = {}
    for path in (COURSE, f"problems/{set_id}/set.yaml"):
        node = mapping_in(root, path, "the file", quickly=True) if (root / path).is_file() else None
        for name in names:
            under = node.get(name) if node else None
            value = keys[name].reader.read(under, name, faults) if under is not None else None
            found |= {name: value} if value else {}
    faults.stop()
    return found


def _logo(root: Path, path: Word, faults: Faults) -> bytes | None:
    """Return the content of a logo, which must be a small PNG file of the course; after an error, None."""
    file = root / path
    help_line = "name a PNG file in the folder of the course, such as `logo.png`"
    if not file.resolve().is_relative_to(root.resolve()) or not file.is_file():
        faults.error("logo", f"the course has no file `{path}`", path.place, help=help_line)
    elif file.stat().st_size > LARGEST_LOGO:
        message = f"the logo is larger than {LARGEST_LOGO // 1_000_000} MB"
        faults.error("logo", message, path.place, help="make it smaller: each page for a browser contains it")
    elif not (content := file.read_bytes()).startswith(PNG):
        faults.error("logo", f"`{path}` is not a PNG file", path.place, help=help_line)
    else:
        return content
    return None


def _course(root: Path, faults: Faults) -> CourseKeys:
    if not (root / COURSE).is_file():
        return CourseKeys({}, {})
    return read_record(CourseKeys, mapping_in(root, COURSE, "a course"), "a course", faults)


def _clashes(documents: dict[Word, Word], problems: List[str], faults: Faults) -> None:
    for n, file in enumerate(documents.values()):
        others = [*list(documents.values())[:n], *problems, INDEX]
        if file in others:
            message = f"`{file}` is already the name of another file of this set"
            faults.error("document-name", message, file.place, help="choose another name")


def mapping_in(root: Path, path: str, what: str, quickly: bool = False) -> Mapping:
    """Return the contents of a file, or raise `Rejected` if they are not a mapping."""
    node = read_yaml(root / path, path, quickly)
    if not isinstance(node, Mapping):
        raise Rejected(Complaint("wrong-type", f"{what} must be a mapping, but this is {shape_of(node)}", node.place))
    return node


def _listed(written: tuple[Word, ...], set_id: str, known: List[str], faults: Faults) -> tuple[str, ...]:
    names = [full.partition("/")[2] for full in known if full.startswith(f"{set_id}/")]
    found: list[str] = []
    for item in written:
        if item in (*DOCUMENTS, INDEX, *_NOT_PROBLEMS):
            of_set = "file" if item in _NOT_PROBLEMS else "document"
            message = f"a problem cannot be called `{item}`, because a {of_set} of the set has that name"
            faults.error("reserved-name", message, item.place, help="rename its files")
        elif item not in names:
            begun = f"`derive new {set_id}/{item}` begins this problem" if NAME.fullmatch(item) else None
            help_line = did_you_mean(item.rpartition("/")[2].removesuffix(".yaml"), names) or begun
            message = f"no problem of this set is called `{item}`"
            if item in known and not item.startswith(f"{set_id}/"):
                message = f"`{item}` is a problem of another set"
                help_line = f"copy its files to `problems/{set_id}/` and list it by its name alone"
            faults.error("no-such-problem", message, item.place, help=help_line)
        elif f"{set_id}/{item}" in found:
            faults.error("duplicate-problem", f"`{item}` is listed twice", item.place)
        else:
            found.append(f"{set_id}/{item}")
    return tuple(found)
