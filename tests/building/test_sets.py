"""The build of a set: what is done again, what is left alone, and what a fault leaves behind."""

from __future__ import annotations

import fcntl
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from fake_course import Course, stand_in_course

from derive.building.files import write
from derive.building.manifest import DOCUMENTS, outputs_of
from derive.building.sets import Options, Report, built_set
from derive.building.workers import Bug, Crew, Job, done
from derive.errors import BuildFailed, Complaint, DeriveError, Misused


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Course:
    return stand_in_course(tmp_path, monkeypatch)


def build(course: Course, options: Options | None = None) -> Report:
    return built_set(course.root, "hw1", options or Options(), lambda _: None)


def codes(report: Report) -> list[str]:
    return [complaint.code for complaint in report.complaints]


def test_a_first_build_makes_every_output(course: Course) -> None:
    report = build(course)
    assert set(course.contents()) == {name for part in ("one", "two", *DOCUMENTS) for name in outputs_of(part)}
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
    assert (course.derived(), course.typeset()) == ([], ["problems.tex", "solutions.tex"])
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
    assert course.typeset() == ["one.tex", "problems.tex", "solutions.tex", "two.tex"]


def test_a_reference_that_appears_is_a_change(course: Course) -> None:
    build(course)
    course.derived()
    (course.folder / "reference.yaml").write_text("block: {}\n")
    build(course)
    assert len(course.derived()) == 2


def test_a_file_edited_while_it_is_built_is_read_again(course: Course) -> None:
    future = time.time() + 60
    os.utime(course.folder / "one.yaml", (future, future))
    build(course)
    course.derived()
    build(course)
    assert course.derived() == ["hw1/one None"]


def test_a_failing_problem_keeps_its_outputs_and_stops_no_other(course: Course) -> None:
    build(course)
    before = course.contents()
    course.problem("one", "refuse")
    course.problem("two", "edited")
    report = build(course)
    after = course.contents()
    assert codes(report) == ["wrong-kind"]
    assert {name for name in after if after[name] != before[name]} == {"two.pdf", "two.tex", "two.txt"}


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


def test_a_derivation_that_loops_is_stopped_and_named(course: Course) -> None:
    course.problem("one", "loop")
    report = build(course, Options(limit=2))
    (complaint,) = report.complaints
    assert (complaint.code, complaint.message) == ("time-limit", "`hw1/one` took over 2 s")
    assert (course.outputs / "two.pdf").is_file()


def test_a_worker_that_dies_is_a_complaint(course: Course) -> None:
    course.problem("one", "die")
    (complaint,) = build(course).complaints
    assert (complaint.code, complaint.message) == ("worker-died", "`hw1/one` ended without a word: signal 9")


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
    assert complaint.message == "cannot write `build/hw1`: a file stands where a folder should be"


def test_a_full_disk_leaves_the_earlier_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "page.pdf"
    write(target, "before")

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    monkeypatch.chdir(tmp_path)
    with pytest.raises(BuildFailed, match=r"error\[cannot-write\]: cannot write `page.pdf`: the disk is full"):
        write(target, "after")
    assert [(p.name, p.read_text()) for p in tmp_path.iterdir()] == [("page.pdf", "before")]


def test_a_damaged_record_is_no_obstacle(course: Course) -> None:
    build(course)
    (course.outputs / ".manifest.json").write_text("{")
    (course.outputs / ".derived" / "one.pickle").write_text("?")
    assert build(course).derived == 2


def test_a_kept_derivation_of_another_text_is_not_used(course: Course) -> None:
    build(course)
    record = (course.outputs / ".manifest.json").read_bytes()
    course.problem("one", "edited")
    build(course)
    # as if the second build had been killed before it wrote its record, and the edit then taken back
    (course.outputs / ".manifest.json").write_bytes(record)
    course.problem("one", "first")
    build(course)
    assert "first" in (course.outputs / "one.pdf").read_text()


def test_make_is_told_the_outputs_and_the_options(course: Course) -> None:
    build(course, Options(detail="brief"))
    options, *outputs = (course.outputs / ".outputs").read_text().splitlines()
    assert options == "engine=pdflatex/detail=brief"
    assert "build/hw1/one.pdf" in outputs


def test_make_is_told_nothing_by_a_build_that_failed(course: Course) -> None:
    course.problem("one", "refuse")
    build(course)
    assert not (course.outputs / ".built").exists()


def test_the_stamp_is_as_old_as_the_beginning_of_the_build(course: Course) -> None:
    build(course)
    assert (course.outputs / ".built").stat().st_mtime_ns < (course.outputs / "one.pdf").stat().st_mtime_ns


def test_a_second_build_waits_and_says_so(course: Course) -> None:
    build(course)
    code = "import fcntl, sys; f = open(sys.argv[1], 'w'); fcntl.lockf(f, fcntl.LOCK_EX); print(1, flush=True); input()"
    lock = str(course.outputs / ".lock")
    other = subprocess.Popen([sys.executable, "-c", code, lock], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert other.stdin and other.stdout
    other.stdout.readline()
    said: list[str] = []

    def tell(text: str) -> None:
        said.append(text)
        other.communicate(b"\n")

    built_set(course.root, "hw1", Options(), tell)
    assert said == ["waiting for another build of `hw1`"]


def test_a_worker_does_not_hold_the_lock_of_its_build(course: Course) -> None:
    held: list[bool] = []
    with open(course.root / "lock", "w") as lock:
        code = "import fcntl, sys; fcntl.lockf(open(sys.argv[1], 'w'), fcntl.LOCK_EX | fcntl.LOCK_NB)"
        probe = [sys.executable, "-c", code, str(course.root / "lock")]

        def while_it_works(_: list[str]) -> None:
            fcntl.lockf(lock, fcntl.LOCK_EX)
            held.append(subprocess.run(probe, capture_output=True).returncode != 0)
            fcntl.lockf(lock, fcntl.LOCK_UN)
            held.append(subprocess.run(probe, capture_output=True).returncode != 0)

        fcntl.lockf(lock, fcntl.LOCK_EX)
        with Crew(2, while_it_works) as crew:
            crew.put(Job("sleeper", lambda: time.sleep(60)))
            crew.put(Job("next", lambda: None))
            waiting = crew.outcomes()
            assert next(waiting).job.name == "next"
    assert held[:2] == [True, False]


def test_a_worker_returns_its_value_and_raises_its_complaint() -> None:
    assert done(Job("sum", lambda: sum(range(10**5)))) == sum(range(10**5))

    def refuse() -> None:
        raise DeriveError(Complaint("no", "not today"))

    with pytest.raises(DeriveError, match="not today"):
        done(Job("refusal", refuse))
    with pytest.raises(Bug, match="KeyError"):
        done(Job("bug", lambda: {}["x"]))


def test_a_large_value_comes_back_whole() -> None:
    assert len(done(Job("large", lambda: "x" * 3_000_000))) == 3_000_000


def test_killing_a_worker_takes_its_programs_along(tmp_path: Path) -> None:
    note = tmp_path / "pid"

    def work() -> None:
        program = subprocess.Popen(["sleep", "60"])
        note.write_text(str(program.pid))
        program.wait()

    with pytest.raises(BuildFailed, match="time-limit"):
        done(Job("sleeper", work, limit=1))
    assert is_gone(int(note.read_text()))


def test_workers_end_with_a_parent_that_is_killed(tmp_path: Path) -> None:
    note = tmp_path / "pid"
    code = (
        "import os, pathlib, sys, time\n"
        "from derive.building.workers import Job, done\n"
        "def work():\n"
        "    pathlib.Path(sys.argv[1]).write_text(str(os.getpid()))\n"
        "    time.sleep(60)\n"
        "done(Job('sleeper', work))\n"
    )
    parent = subprocess.Popen([sys.executable, "-c", code, str(note)])
    for _ in range(500):
        if note.is_file() and note.read_text():
            break
        time.sleep(0.02)
    parent.send_signal(signal.SIGKILL)
    parent.wait()
    assert is_gone(int(note.read_text()))


def is_gone(pid: int) -> bool:
    for _ in range(500):
        try:
            os.kill(pid, 0)
        except ProcessLookupError:
            return True
        if Path(f"/proc/{pid}/stat").is_file() and Path(f"/proc/{pid}/stat").read_text().split(") ")[1][0] == "Z":
            return True
        time.sleep(0.02)
    return False


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
