"""The build of a set of problems: only changed problems are derived, and only changed documents are typeset.

If a problem fails, its earlier outputs stay, the other problems are built, and the documents of the whole set stay
unchanged.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING

from derive.building.cache import CACHE, NOT_KEPT, PACKAGES, Cache, Kept, digest, engine_digest, file_digest, not_kept
from derive.building.class_record import RECORD
from derive.building.documents import named_documents, still_there, with_asked
from derive.building.files import folder, write, writing
from derive.building.lock import locked
from derive.building.manifest import INDEX_PAGES, Documents, Manifest, outputs_of, outputs_of_document
from derive.building.preamble import at_hand, beginning
from derive.building.preload import preload
from derive.building.recipe import (
    DETAIL,
    EDITED,
    EVIDENCE,
    MODULES,
    ONLY,
    Recipe,
    edited_since,
    input_digest,
    recipe_digest,
    recipe_of,
    stated_by,
)
from derive.building.scratch import sweep
from derive.building.set_names import check_asked, set_folder
from derive.building.signatures import regular_content
from derive.building.staleness import left_older
from derive.building.template_line import own_templates
from derive.building.tex import (
    Engine,
    by_the_clock,
    chosen_engine,
    chosen_name,
    prepare,
    typeset,
)
from derive.building.workers import TIME_LIMIT, Bug, Crew, Ended, Job, Outcome, done, job_of, under_way
from derive.course.names import (
    INDEX,
    LOGO,
    ON_A_PAGE,
    REPORT,
    SHEET,
    SOLUTIONS,
    STUDENTS,
    EvidenceShown,
)
from derive.errors import Complaint, DeriveError, Misused
from derive.render.formats import built_formats
from derive.render.rendered import Files, Rendered

if TYPE_CHECKING:
    from derive.course.problem_set import ProblemSet

FIRST, LAST = -float("inf"), float("inf")  # ranks of jobs that begin before or after all derivations


@dataclass(frozen=True)
class Options:
    """The options of a build, with the defaults of `derive build`."""

    engine: str | None = None
    detail: str | None = None
    force: bool = False
    jobs: int = 0  # the number of jobs at a time; 0 means the number of processors
    limit: float = TIME_LIMIT
    only: tuple[str, ...] = ()  # problems to build; empty: all problems of the set
    documents: tuple[str, ...] = ()  # documents to make; if empty, the documents of the set, see `building.documents`
    evidence: str | None = None  # how much solutions show of their checks; by default as the set states


class Superseded(Exception):
    """Files were edited during their build, so the unfinished work of that build is useless."""


@dataclass(frozen=True)
class Edits:
    """The functions through which a build detects edits and reports finished PDFs."""

    edited: Callable[[], bool]  # whether there were edits since this build began
    wrote: Callable[[Path], None]  # called with the PDF of a problem as soon as the PDF has changed


@dataclass
class Report:
    """The results of a build."""

    set_id: str
    problems: int = 0
    derived: int = 0
    changed: list[Path] = field(default_factory=list)
    complaints: list[Complaint] = field(default_factory=list)
    warnings: list[Complaint] = field(default_factory=list)
    bugs: list[Bug] = field(default_factory=list)
    seconds: float = 0.0

    @property
    def failed(self) -> bool:
        return bool(self.complaints or self.bugs)


def built_set(
    root: Path,
    set_id: str,
    options: Options,
    tell: Callable[[str], None],
    edits: Edits | None = None,
    ended: Callable[[Ended], None] = lambda _: None,
) -> Report:
    """Build one set. `tell` shows the user the work under way, and `ended` is called for each finished piece of work.
    With `edits` the build may raise `Superseded`."""
    engine = chosen_engine(options.engine)
    check_asked(root, set_id, options.only)
    outputs = folder(set_folder(root, set_id))
    with locked(outputs, lambda: tell(f"waiting for another build of `{set_id}`")):
        sweep(outputs, outputs / CACHE)
        return _Build(root, set_id, options, engine, outputs, tell, edits, ended).report()


class _Build:
    def __init__(
        self,
        root: Path,
        set_id: str,
        options: Options,
        engine: Engine,
        outputs: Path,
        tell: Callable[[str], None],
        edits: Edits | None,
        ended: Callable[[Ended], None],
    ):
        self.root, self.set_id, self.options, self.engine, self.outputs = root, set_id, options, engine, outputs
        self.edits, self.ended = edits, ended
        self.started = time.time_ns()
        self.cache = Cache(outputs / CACHE, fresh=options.force)
        self.manifest = Manifest.read(outputs)
        self.documents = with_asked(self.manifest.documents, options.documents)
        self.made_by = recipe_of(root, options.detail, options.evidence, self.manifest.of_set)
        self.made_by[ONLY] = self._kinds_of_each_problem()
        self.anew = options.force or self.manifest.engine != engine_digest(*PACKAGES)
        self.result = Report(set_id)
        self.derived: dict[str, Rendered] = {}
        self.names: list[str] = []
        self.heading: ProblemSet
        self.whole_failed: Outcome | None = None
        self.then: dict[Job, Callable[[Outcome], None]] = {}
        self.tell = tell
        self.crew = Crew(options.jobs or os.cpu_count() or 1, self._tick)

    def report(self) -> Report:
        manifest, result = self.manifest, self.result
        if self._is_current(self._wanted()) and not self.options.force:
            self.names = manifest.problems
        else:
            self._rebuild()
        result.problems = len(self.names)
        if not result.failed:
            if self._is_current(self.documents) and EDITED not in self._recipe().values():
                self._keep(self._stamp)
            names = [*self.names, *(file for _, file in self.documents)]
            result.warnings += self._of_class()
            result.warnings += left_older(manifest, self.set_id, names, self.made_by, cache(self._digest))
        result.warnings += dict.fromkeys(self.cache.unkept)
        result.seconds = (time.time_ns() - self.started) / 1e9
        return result

    def _of_class(self) -> list[Complaint]:
        if not (self.outputs / RECORD).is_file():
            return []
        from derive.building.classes import class_is_older

        return class_is_older(self.root, self.set_id, self.engine)

    def _keep(self, saved: Callable[[], None]) -> None:
        try:
            saved()
        except DeriveError as error:
            self.cache.unkept.extend(map(not_kept, error.complaints))

    def _is_current(self, documents: Documents) -> bool:
        there = documents == still_there(documents, self.manifest, self.options.documents)
        return there and self.manifest.is_current(self.made_by, self.engine.identity, cache(self._digest), documents)

    def _rebuild(self) -> None:
        from derive.course.problem_set import problem_set

        self.manifest.complete = False
        with writing(self.outputs):  # without `.built`, `make` builds the set again
            (self.outputs / ".built").unlink(missing_ok=True)
        self.prepares = not os.listdir(at_hand().name)  # all workers share the TeX formats in this folder
        reading = partial(problem_set, self.root, self.set_id)
        heading = done(Job(f"`problems/{self.set_id}/set.yaml`", reading, self.options.limit))
        self.manifest.of_set = stated_by(heading)
        self.documents = named_documents(heading, self.manifest, self.options.documents)
        options = {DETAIL: self.options.detail, EVIDENCE: self.options.evidence}
        self.made_by |= self.manifest.of_set | {name: value for name, value in options.items() if value}
        self.made_by[ONLY] = self._kinds_of_each_problem()
        shown = EvidenceShown(self.made_by[EVIDENCE])
        self.heading = replace(heading, evidence=shown)
        self.names = [problem.rpartition("/")[2] for problem in heading.problems]
        if unlisted := [name for name in self.options.only if name not in self.names]:
            message = f"the set `{self.set_id}` does not list `{unlisted[0]}`"
            raise Misused(Complaint("no-such-problem", message, help=f"list it in `{heading.inputs[0]}`"))
        with self.crew:
            try:
                for name in self.manifest.pages.keys() - set(self.names):
                    self.manifest.forget(name)
                self.manifest.problems = self.names
                self.manifest.set_inputs = {path: self._input_digest(path) for path in heading.inputs}
                asked = [name for name in self.names if name in self.options.only or not self.options.only]
                keys = {name: self.manifest.page_key(name, recipe_digest(self.made_by), self._digest) for name in asked}
                edited = {name: key for name, key in keys.items() if self.manifest.pages.get(name) != key}
                self._pages(edited)
                if self.edits:
                    self._finish()
                self._pages({name: key for name, key in keys.items() if name not in edited})
                self._whole()
                self._finish()
                if self.whole_failed and not self.result.failed:  # otherwise another error is already reported
                    self._took(self.whole_failed)
                if not self.result.failed:
                    if len(self.derived) < len(self.names):
                        from derive.building.document_list import update_list

                        update_list(self.root, self.set_id, self.manifest)
                    self.manifest.engine = engine_digest(*PACKAGES)
                    self.manifest.complete = len(self.derived) == len(self.names)
            finally:
                # An interrupted build saves its finished work, and is marked as incomplete.
                self._keep(self.manifest.save)
                self.cache.evict()

    def _kinds_of_each_problem(self) -> str:
        return ",".join(sorted(kind for kind, _ in self.documents if kind in ON_A_PAGE))

    def _wanted(self) -> list[list[str]]:
        return [pair for pair in self.documents if not self.options.documents or pair[0] in self.options.documents]

    def _finish(self) -> None:
        """Wait for each job under way and continue with its outcome, which may start more jobs."""
        for outcome in self.crew.outcomes():
            self.then.pop(outcome.job)(outcome)

    def _tick(self, running: Mapping[str, float]) -> None:
        if self.edits and self.edits.edited():
            raise Superseded
        done = f"{len(self.derived)} of {len(self.names)} derived ({(time.time_ns() - self.started) // 10**9} s)"
        self.tell(f"{self.set_id}: {done}; {under_way(running, self.set_id)}")

    def _put(self, job: Job, then: Callable[[Outcome], None]) -> None:
        self.then[job] = then
        self.crew.put(job)

    def _took(self, outcome: Outcome) -> bool:
        """Return whether the job succeeded; if not, add its error to the report."""
        if isinstance(outcome.error, DeriveError):
            self.result.complaints += outcome.error.complaints
        elif outcome.error:
            self.result.bugs.append(outcome.error)
        return outcome.error is None

    def _pages(self, keys: Mapping[str, str]) -> None:
        """Use the stored pages, and derive the other problems.

        keys   name of a problem -> key under which its page is stored
        """
        kept = {name: page for name, key in keys.items() if (page := Rendered.from_data(self.cache.get_data(key)))}
        self._derive([name for name in keys if name not in kept])
        for name, page in kept.items():
            self.ended(Ended("kept", f"{self.set_id}/{name}"))
            told_before = self.manifest.pages.get(name) == keys[name]
            self.manifest.made(name, self._recipe(), self._input_digest)
            self._take(name, page, () if told_before else page.warnings)

    def _derive(self, names: Sequence[str]) -> None:
        if not names:
            return
        if self.anew:  # TeX reads the preamble while this process loads the modules that derive problems
            self._prepare()
        several, again = len(names) > 1, bool(self.edits)
        read = self.set_id if several else ""
        preload(self.root, derives=several or again, draws=self.anew or again, set_id=read)
        from derive.building.solution import rendered

        self._prepare()
        shown = EvidenceShown(self.made_by[EVIDENCE])
        more = [kind for kind, _ in self.documents if kind in ON_A_PAGE]
        for name in names:
            problem = f"{self.set_id}/{name}"
            work = partial(rendered, self.root, problem, self.made_by[DETAIL] or None, self.cache, draws=True)
            work = partial(work, evidence=shown, documents=more)
            self._put(job_of(self.root, problem, work, self.options.limit), partial(self._was_derived, name))
        self.crew.start()

    def _prepare(self) -> None:
        """Start a job in which TeX reads the common beginning of the documents."""
        from derive.page.template import templates_of

        if self.prepares:
            begins = partial(beginning, templates_of(self.root), self.made_by[DETAIL], self.heading.font_size)
            work = lambda: prepare(begins(), self.engine, self.cache)  # noqa: E731
            self._put(Job("the beginning of all documents", work, self.options.limit, rank=FIRST), lambda _: None)
            self.crew.start()
        self.prepares = False

    def _was_derived(self, name: str, outcome: Outcome) -> None:
        self.ended(Ended("failed" if outcome.error else "derived", f"{self.set_id}/{name}", outcome.seconds))
        if not self._took(outcome):
            return
        page: Rendered = outcome.value
        self.result.derived += 1
        inputs = sorted({*page.inputs, f"problems/{self.set_id}/reference.yaml"})
        self.manifest.inputs[name] = dict.fromkeys(inputs, "")
        kept = replace(page, warnings=tuple(each for each in page.warnings if each.code != NOT_KEPT))
        self.cache.keep_data(self.manifest.made(name, self._recipe(), self._input_digest), kept.to_data())
        self._take(name, page, page.warnings)
        self._whole()

    def _take(self, name: str, page: Rendered, warnings: Sequence[Complaint]) -> None:
        """Add a page, derived now or by an earlier build, to the set, with its warnings and outputs."""
        self.result.warnings += warnings
        self.derived[name] = page
        self._check_files(name, page)
        self._document(name)

    def _check_files(self, name: str, derived: Rendered) -> None:
        """Remove drawings that the problem no longer has; report an error if two outputs would have the same name."""
        files = [file for file, _ in derived.files]
        of_documents = [output for kind, file in self.documents for output in outputs_of_document(kind, file)]
        others = {*(output for other in self.names for output in outputs_of(other)), *of_documents, *INDEX_PAGES}
        for file in self.manifest.drawings.get(name, []):
            if file not in {*files, *others}:
                self.manifest.remove(file)
        self.manifest.drawings[name] = files
        for file in others & set(files):
            message = f"the drawing `{file}` of `{name}` would have the name of another output"
            help_line = "rename the drawing, the problem or the document"
            self.result.complaints.append(Complaint("file-clash", message, help=help_line))

    def _recipe(self) -> Recipe:
        """Return the recipe of pages. If modules of derive, templates or phrases were edited since the build began,
        `EDITED` replaces the digest of the modules."""
        if edited_since(self.root, self.started):
            self.made_by[MODULES] = EDITED
        return self.made_by

    def _digest(self, path: str) -> str:
        return file_digest(self.root / path)

    def _input_digest(self, path: str) -> str:
        return input_digest(self.root / path, self.started)

    def _document(self, name: str) -> None:
        from derive.building.set_document import problem_document, problem_page

        derived = self.derived[name]
        texts = {f"{name}.{form.suffix}": derived.texts[form.name] for form in built_formats().values()}
        texts |= self._page(name, lambda: problem_page(self.root, derived, self.heading))
        if self._record(dict(derived.files)):
            document = partial(problem_document, self.root, derived, self.heading)
            self._typeset(name, document, texts, derived.files, FIRST)

    def _whole(self) -> None:
        """Make the documents of the set, if all its problems are derived and nothing has failed."""
        if len(self.derived) < len(self.names) or self.result.failed:
            return
        from derive.building.document_list import older_in, papers, papers_of, there_of
        from derive.building.set_document import document_page, index_page, the_document

        parts = [self.derived[name] for name in self.names]
        files = tuple(file for part in parts for file in part.files)
        logo = ((LOGO, self.heading.logo),) if self.heading.logo else ()
        there = there_of(self.outputs, self.documents, self._wanted())
        older = {*older_in(self.root, self.manifest)} - {file for _, file in self._wanted()}
        index = partial(index_page, self.root, self.heading, parts)
        pages = self._page(INDEX, partial(index, papers(self.root, self.set_id, there, older)))
        sheets = papers_of(self.root, self.set_id, [pair for pair in there if pair[0] == SHEET])
        pages |= self._page(f"{STUDENTS}/{INDEX}", partial(index, sheets, for_students=True))
        if self._record(pages):
            self._was_made(INDEX)
        for kind, file in self._wanted():
            # With known page numbers, one run of TeX is enough.
            numbers = Kept(self.cache, digest("numbers", kind, self.engine.identity))
            document = partial(the_document(kind), self.root, self.heading, parts)
            of_set = partial(document_page, self.root, self.heading, parts, kind)
            page = self._page(file, of_set) if kind in ON_A_PAGE else {}
            if kind == SHEET:
                page |= {f"{STUDENTS}/{name}": text for name, text in page.items()}
            rank = FIRST if kind == SOLUTIONS else LAST
            beside = (*(files if kind != REPORT else ()), *logo)
            self._typeset(file, document, page, beside, rank, numbers if kind not in (SHEET, REPORT) else None)

    def _page(self, name: str, page: Callable[[], str]) -> dict[str, str]:
        """Return the text of a web page by file name; if the page cannot be made, report the error and return {}."""
        try:
            return {f"{name}.html": page()}
        except DeriveError as error:
            self.result.complaints += error.complaints
            return {}

    def _typeset(
        self,
        name: str,
        document: Callable[[], str],
        texts: Mapping[str, str | bytes],
        files: Files,
        rank: float,
        numbers: Kept | None = None,
    ) -> None:
        pdf = f"{name}.pdf"
        try:
            tex = document()
        except DeriveError as error:
            self.result.complaints += error.complaints
            return
        source = digest("pdf", tex, self.engine.identity, *(content for _, content in files))
        texts = {f"{name}.tex": tex, **texts}
        kept = self.cache.get(source)
        if kept is not None:
            if self._record({pdf: kept, **self._for_students(name, kept), **texts}):
                self._was_made(name)
            return
        limit = self.options.limit
        included = [file for file in files if file[0].endswith((".pdf", ".png"))]
        work = partial(
            typeset, tex, self.outputs / pdf, self.engine,
            timeout=limit, numbers=numbers, included=included, formats=replace(self.cache, fresh=False),
            templates=own_templates(self.root),
        )  # fmt: skip
        job = Job(f"the pages of `{self.set_id}/{name}`", work, by_the_clock(limit), rank=rank)
        self._put(job, partial(self._was_typeset, pdf, source, texts))

    def _was_typeset(self, pdf: str, source: str, texts: Mapping[str, str | bytes], outcome: Outcome) -> None:
        """Write the TeX source and the texts only after the PDF was made, so that these files belong together."""
        self.ended(Ended("failed" if outcome.error else "typeset", f"{self.set_id}/{pdf}", outcome.seconds))
        name = pdf.removesuffix(".pdf")
        if name in [file for _, file in self.documents] and outcome.error:
            self.whole_failed = outcome
            return
        if not self._took(outcome):
            return
        if outcome.value:
            self._changed(pdf)
        with suppress(OSError):  # another process may have just removed the PDF
            content = regular_content(self.outputs / pdf)
            self.cache.keep(source, content)
            texts = {**self._for_students(name, content), **texts}
        self.manifest.outputs[pdf] = file_digest(self.outputs / pdf)
        if self._record(texts):
            self._was_made(name)

    def _for_students(self, name: str, pdf: bytes) -> dict[str, str | bytes]:
        """Return the PDF of the sheet under its name in the students' folder; return nothing for other documents."""
        return {f"{STUDENTS}/{name}.pdf": pdf} if (SHEET, name) in map(tuple, self.documents) else {}

    def _was_made(self, name: str) -> None:
        self.manifest.was_typeset(name, self._recipe(), self.engine.identity)

    def _changed(self, output: str) -> None:
        self.result.changed.append(self.outputs / output)
        if self.edits and output in (f"{name}.pdf" for name in self.names):
            self.edits.wrote(self.outputs / output)

    def _record(self, contents: Mapping[str, str | bytes]) -> bool:
        try:
            for name, content in contents.items():
                if write(self.outputs / name, content) and not name.startswith(f"{STUDENTS}/"):
                    self._changed(name)
                self.manifest.outputs[name] = file_digest(self.outputs / name)
        except DeriveError as error:
            self.result.complaints += error.complaints
            return False
        return True

    def _stamp(self) -> None:
        """Record for `make` the outputs of this set and the files outside of its folder that its problems read. Set the
        time of `.built` to the beginning of this build."""
        outputs = [f"build/{self.set_id}/{name}" for name in self.manifest.all_outputs()]
        options = f"engine={chosen_name(self.options.engine)}/detail={self.options.detail or ''}"
        read = {path for inputs in self.manifest.inputs.values() for path in inputs}
        elsewhere = sorted(path for path in read if not path.startswith(f"problems/{self.set_id}/"))
        write(self.outputs / ".outputs", "\n".join([options, *outputs, *elsewhere, ""]))
        write(self.outputs / ".built", "")
        os.utime(self.outputs / ".built", ns=(self.started, self.started))
