"""The build of a set: what is done again, what is left alone, and what a fault leaves behind."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

from derive.building.manifest import Manifest, outputs_of
from derive.building.sets import Options, Report, built_set
from derive.errors import BuildFailed, Misused
from tests.fake_course import Course, stand_in_course


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Course:
    return stand_in_course(tmp_path, monkeypatch)


def build(course: Course, options: Options | None = None) -> Report:
    return built_set(course.root, "hw1", options or Options(), lambda _: None)


def codes(report: Report) -> list[str]:
    return [complaint.code for complaint in report.complaints]


def test_a_first_build_makes_every_output(course: Course) -> None:
    report = build(course)
    made = {str(file.relative_to(course.outputs)) for file in course.outputs.rglob("[!.]*") if file.is_file()}
    assert {each for each in made if not each.startswith(".")} == set(Manifest.read(course.outputs).all_outputs())
    assert {*outputs_of("one"), "index.html", "solutions.pdf", "problems.pdf", "report.pdf"} <= set(course.contents())
    assert (report.derived, report.problems, report.failed) == (2, 2, False)
    assert "first" in (course.outputs / "solutions.pdf").read_text()
    assert (course.outputs / "one.txt").read_text() == "first ω\n"


def test_nothing_is_done_when_nothing_changed(course: Course) -> None:
    build(course)
    course.derived(), course.typeset()
    report = build(course)
    assert (course.derived(), course.typeset(), report.derived, report.changed) == ([], [], 0, [])
    assert report.problems == 2


def test_an_edit_derives_and_typesets_only_its_problem_and_the_set(course: Course) -> None:
    build(course)
    course.derived(), course.typeset()
    course.problem("two", "edited")
    build(course)
    assert course.derived() == ["hw1/two None"]
    assert course.typeset() == ["solutions.tex", "two.tex"], "the students' sheet reads as before"
    assert "edited" in (course.outputs / "solutions.pdf").read_text()


def test_an_edit_that_reads_the_same_is_derived_and_not_typeset(course: Course) -> None:
    build(course)
    course.derived(), course.typeset()
    course.problem("two", "second ")
    report = build(course)
    assert (course.derived(), course.typeset(), report.changed) == (["hw1/two None"], [], [])


def test_a_touched_file_is_no_change(course: Course) -> None:
    build(course)
    course.derived()
    os.utime(course.folder / "one.yaml")
    build(course)
    assert course.derived() == []


@pytest.mark.parametrize("name", ["one.pdf", "one.txt", "two.json", "solutions.pdf", "solutions.tex", "problems.pdf"])
def test_a_deleted_output_comes_back(course: Course, name: str) -> None:
    build(course)
    before = course.contents()
    (course.outputs / name).unlink()
    course.derived()
    build(course)
    assert course.contents() == before
    assert course.derived() == []


def test_a_damaged_output_is_made_again(course: Course) -> None:
    build(course)
    before = course.contents()
    (course.outputs / "one.pdf").write_text("half of a PD")
    build(course)
    assert course.contents() == before


def test_an_unchanged_output_is_not_rewritten(course: Course) -> None:
    build(course)
    before = {path: path.stat().st_mtime_ns for path in course.outputs.glob("one.*")}
    course.problem("two", "edited")
    build(course, Options(force=True))
    assert {path: path.stat().st_mtime_ns for path in course.outputs.glob("one.*")} == before


def test_the_order_in_the_set_changes_only_the_set(course: Course) -> None:
    build(course)
    course.derived(), course.typeset()
    course.heading("two", "one")
    build(course)
    assert (course.derived(), course.typeset()) == ([], ["problems.tex", "report.tex", "solutions.tex"])
    assert (course.outputs / "solutions.tex").read_text().index("second") < 40


def test_a_template_an_engine_and_a_detail_each_count_as_a_change(course: Course) -> None:
    build(course)
    (course.root / "templates").mkdir()
    (course.root / "templates" / "page.tex").write_text("new")
    course.derived()
    build(course)
    assert course.derived() == ["hw1/one None", "hw1/two None"]
    build(course, Options(detail="full"))
    assert course.derived() == ["hw1/one full", "hw1/two full"]
    build(course)
    course.typeset()
    shutil.copy(course.root / "bin" / "pdflatex", course.root / "bin" / "lualatex")
    build(course, Options(engine="lualatex"))
    assert course.typeset() == ["one.tex", "problems.tex", "report.tex", "solutions.tex", "two.tex"]


def test_a_reference_that_appears_is_a_change(course: Course) -> None:
    build(course)
    course.derived()
    (course.folder / "reference.yaml").write_text("block: {}\n")
    build(course)
    assert len(course.derived()) == 2


def test_a_file_edited_while_it_is_built_is_read_again(course: Course) -> None:
    course.problem("one", "replaced")
    build(course)
    assert "replaced" in (course.outputs / "one.txt").read_text()
    course.derived()
    build(course)
    assert course.derived() == ["hw1/one None"]
    assert "its successor" in (course.outputs / "one.txt").read_text()


def test_a_file_with_a_time_in_the_future_is_read_once(course: Course) -> None:
    future = time.time() + 60
    os.utime(course.folder / "one.yaml", (future, future))
    build(course)
    course.derived()
    build(course)
    assert course.derived() == []


def test_what_is_made_while_a_template_is_edited_is_made_again(course: Course, monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patched:
        patched.setattr("derive.building.sets.edited_since", lambda *_: True)
        build(course)
    assert not (course.outputs / ".built").exists()
    course.derived()
    build(course)
    assert course.derived() == ["hw1/one None", "hw1/two None"]
    build(course)
    assert course.derived() == []


def test_a_failing_problem_keeps_its_outputs_and_stops_no_other(course: Course) -> None:
    build(course)
    before = course.contents()
    course.problem("one", "refuse")
    course.problem("two", "edited")
    report = build(course)
    after = course.contents()
    assert codes(report) == ["wrong-kind"]
    changed = {name for name in after if after[name] != before[name]}
    assert changed >= {"two.pdf", "two.tex", "two.txt"}
    assert {name.partition(".")[0] for name in changed} == {"two"}


def test_a_fault_taken_back_leaves_no_stale_set(course: Course) -> None:
    build(course)
    course.problem("one", "refuse")
    course.problem("two", "edited")
    build(course)
    course.problem("one", "first")
    build(course)
    assert "edited" in (course.outputs / "solutions.pdf").read_text()


def test_a_fault_is_told_again_until_it_is_mended(course: Course) -> None:
    build(course)
    course.problem("one", "BAD")
    assert codes(build(course)) == ["tex"]
    assert codes(build(course)) == ["tex"]
    course.problem("one", "first")
    assert not build(course).failed


def test_what_tex_refuses_is_told_once_and_leaves_the_earlier_pages(course: Course) -> None:
    build(course)
    before = course.contents()
    course.problem("one", "BAD")
    (complaint,) = build(course).complaints
    assert complaint.message == "TeX failed in hw1/one: Undefined control sequence"
    assert complaint.place and (complaint.place.path, complaint.place.line) == ("build/hw1/log/one.tex", 2)
    assert course.contents() == before


@pytest.mark.usefixtures("workers")
def test_a_derivation_that_loops_is_stopped_and_named(course: Course) -> None:
    course.problem("one", "loop")
    report = build(course, Options(limit=1))
    (complaint,) = report.complaints
    assert (complaint.code, complaint.message) == ("time-limit", "`hw1/one` took over 1 s of processor time")
    assert (course.outputs / "two.pdf").is_file()


@pytest.mark.usefixtures("workers")
def test_a_worker_that_dies_is_a_complaint(course: Course) -> None:
    course.problem("one", "die")
    (complaint,) = build(course).complaints
    assert (complaint.code, complaint.message) == ("worker-died", "`hw1/one` ended without a message: signal 9")


def test_a_bug_is_kept_apart_from_faults_of_the_user(course: Course) -> None:
    course.problem("one", "bug")
    report = build(course)
    (bug,) = report.bugs
    assert str(bug) == "ZeroDivisionError: nobody thought of that"
    assert "fake_course.py" in bug.trace
    assert report.failed
    assert not report.complaints


def test_warnings_are_passed_on(course: Course) -> None:
    course.problem("one", "warn")
    report = build(course)
    assert [w.code for w in report.warnings] == ["unshown"]
    assert not report.failed


def test_an_unknown_set_is_misuse_and_leaves_no_folder(course: Course) -> None:
    with pytest.raises(Misused) as caught:
        built_set(course.root, "hw2", Options(), lambda _: None)
    assert caught.value.complaints[0].help == "did you mean `hw1`?"
    assert not (course.root / "build").exists()


def test_outputs_that_cannot_be_written_are_one_complaint(course: Course) -> None:
    (course.root / "build").write_text("not a folder")
    with pytest.raises(BuildFailed) as caught:
        build(course)
    (complaint,) = caught.value.complaints
    assert complaint.message == "cannot write `build/hw1`: a file is where a folder should be"


def test_make_is_told_the_outputs_and_the_options(course: Course) -> None:
    build(course, Options(detail="brief"))
    options, *outputs = (course.outputs / ".outputs").read_text().splitlines()
    assert options == "engine=pdflatex/detail=brief"
    assert "build/hw1/one.pdf" in outputs


def test_make_is_told_nothing_by_a_build_that_failed(course: Course) -> None:
    course.problem("one", "refuse")
    build(course)
    assert not (course.outputs / ".built").exists()


def test_make_is_told_nothing_while_a_document_is_older_than_its_problem(course: Course) -> None:
    build(course)
    course.problem("one", "edited")
    report = build(course, Options(documents=("key",)))
    (warning,) = report.warnings
    assert warning.message == (
        "out of date, but not made again: `solutions.pdf`, `problems.pdf`, `report.pdf` in `build/hw1`"
    )
    assert warning.help == "`derive build hw1` makes them again"
    assert not (course.outputs / ".built").exists()
    assert build(course).warnings == []
    assert "edited" in (course.outputs / "solutions.pdf").read_text()
    assert (course.outputs / ".built").exists()


def test_a_build_of_one_problem_says_what_it_leaves_older(course: Course) -> None:
    assert build(course, Options(only=("one",))).warnings == [], "there is nothing yet that could be older"
    build(course)
    course.problem("one", "edited")
    course.problem("two", "edited too")
    (warning,) = build(course, Options(only=("one",))).warnings
    assert "`two.pdf`, `solutions.pdf`" in warning.message
    assert not (course.outputs / ".built").exists()


def test_a_document_that_was_asked_for_is_made_again_by_each_later_build(course: Course) -> None:
    build(course, Options(documents=("solutions", "key")))
    course.problem("one", "edited")
    assert build(course).warnings == []
    assert "key of hw1/one" in (course.outputs / "key.pdf").read_text()
    before = course.contents()
    course.typeset()
    assert (build(course, Options(documents=("key",))).changed, course.typeset()) == ([], [])
    course.heading("two", "one")
    build(course)
    after = course.contents()
    assert {name for name in after if before[name] != after[name]} >= {"key.pdf", "key.html", "solutions.pdf"}


def test_a_document_that_was_asked_for_and_is_removed_does_not_come_back(course: Course) -> None:
    build(course, Options(documents=("key",)))
    build(course)
    (course.outputs / "key.pdf").unlink()
    build(course)
    assert not [*course.outputs.glob("key*")]
    assert "build/hw1/key.pdf" not in (course.outputs / ".outputs").read_text()


def test_a_first_build_of_one_document_leaves_the_others_for_the_next(course: Course) -> None:
    build(course, Options(documents=("key",)))
    assert not (course.outputs / ".built").exists()
    assert not (course.outputs / "solutions.pdf").exists()
    build(course)
    assert {"solutions.pdf", "problems.pdf", "report.pdf", "key.pdf"} <= set(course.contents())


def test_a_document_that_the_set_calls_otherwise_leaves_no_older_file(course: Course) -> None:
    build(course)
    file = course.folder / "set.yaml"
    file.write_text(file.read_text() + "documents: {solutions: hw1-solutions}\n")
    build(course)
    assert {name for name in course.contents() if name.endswith(".pdf")} == {"hw1-solutions.pdf", "one.pdf", "two.pdf"}


def test_two_documents_may_not_have_one_name(course: Course) -> None:
    file = course.folder / "set.yaml"
    file.write_text(file.read_text() + "documents: {solutions: key}\n")
    with pytest.raises(Misused, match="two documents of `hw1` would be called `key`"):
        build(course, Options(documents=("key",)))


def test_the_stamp_is_as_old_as_the_beginning_of_the_build(course: Course) -> None:
    build(course)
    assert (course.outputs / ".built").stat().st_mtime_ns < (course.outputs / "one.pdf").stat().st_mtime_ns


def test_a_second_build_waits_and_says_so(course: Course) -> None:
    build(course)
    code = "import fcntl, sys; f = open(sys.argv[1], 'w'); fcntl.lockf(f, fcntl.LOCK_EX); print(1, flush=True); input()"
    lock = str(course.outputs / ".lock")
    other = subprocess.Popen([sys.executable, "-P", "-c", code, lock], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert other.stdin and other.stdout
    other.stdout.readline()
    said: list[str] = []

    def tell(text: str) -> None:
        said.append(text)
        other.communicate(b"\n")

    built_set(course.root, "hw1", Options(), tell)
    assert said == ["waiting for another build of `hw1`"]


def test_drawings_are_written_beside_the_page_and_removed_with_it(course: Course) -> None:
    course.problem("one", "draws")
    build(course)
    assert (course.outputs / "one-axes.pdf").read_text() == "draws"
    course.problem("one", "draws another")
    assert course.outputs / "one.pdf" in build(course).changed, "the page is typeset anew with its drawing"
    course.problem("one", "no more")
    build(course)
    assert not (course.outputs / "one-axes.pdf").exists()


def test_a_drawing_may_not_have_the_name_of_another_output(course: Course) -> None:
    course.heading("one", "one-axes")
    course.problem("one", "draws")
    course.problem("one-axes", "second")
    report = build(course)
    assert codes(report) == ["file-clash"]
    assert "the drawing `one-axes.pdf` of `one` would have the name of another output" in report.complaints[0].message


def test_a_drawing_may_not_have_the_name_of_a_document(course: Course) -> None:
    file = course.folder / "set.yaml"
    file.write_text(file.read_text() + "documents: {solutions: one-axes}\n")
    course.problem("one", "draws")
    report = build(course)
    assert codes(report) == ["file-clash"]
    assert "the drawing `one-axes.pdf` of `one`" in report.complaints[0].message
    assert (course.outputs / "one-axes.pdf").read_text() == "draws"


# --- how much a set tells of its checks ---


def with_evidence(course: Course, word: str) -> None:
    file = course.folder / "set.yaml"
    file.write_text(file.read_text() + f"evidence: {word}\n")


def test_a_set_says_how_much_its_solutions_tell_of_their_checks(course: Course) -> None:
    with_evidence(course, "margin")
    build(course)
    assert course.derived() == ["hw1/one None margin", "hw1/two None margin"]
    build(course)
    assert course.derived() == []


def test_an_option_beats_what_the_set_says_of_evidence(course: Course) -> None:
    with_evidence(course, "margin")
    build(course, Options(evidence="end"))
    assert course.derived() == ["hw1/one None end", "hw1/two None end"]
    build(course)
    assert course.derived() == ["hw1/one None margin", "hw1/two None margin"]


def test_the_report_lies_beside_the_solutions(course: Course) -> None:
    build(course)
    assert b"checks of hw1/one" in course.contents()["report.tex"]


def test_the_detail_and_the_form_of_the_set_are_ingredients_of_its_pages(course: Course) -> None:
    build(course)
    course.derived()
    heading = (course.folder / "set.yaml").read_text()
    for line in ("detail: full\n", "form: {figures: 3}\n", ""):
        (course.folder / "set.yaml").write_text(line + heading)
        build(course)
        assert (len(course.derived()), build(course).derived) == (0 if not line else 2, 0), line
    (course.folder / "set.yaml").write_text("detail: full\n" + heading)
    build(course, Options(detail="full"))
    assert course.derived() == [], "the option and the key have the same effect"
