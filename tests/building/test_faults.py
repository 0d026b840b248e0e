"""What comes from outside is never run, never lost and never an internal error: fields, caches, names, outputs."""

from __future__ import annotations

import dataclasses
import json
import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

import pytest
from fake_course import Course, stand_in_course
from pypdf import PdfReader

from derive.building import sealed, workers
from derive.building import sets as build
from derive.building.manifest import Manifest, digest
from derive.building.set_document import problem_document, set_document, sheet_document
from derive.building.sets import Options, Report, built_set
from derive.building.tex import chosen_engine, typeset
from derive.building.workers import Job, done, job_of, memory_limit
from derive.cli.options import main
from derive.cli.terminal import complain
from derive.course import problem_set as sets_of_problems
from derive.course.problem_set import ProblemSet, problem_set
from derive.errors import BuildFailed, Complaint, DeriveError, Misused, Rejected
from derive.page.phrasebook import read_phrases
from derive.page.wording import phrases
from derive.render.rendered import Rendered
from tests.courses import ROOT, course_in, rendered_once

EVIL = (
    r"Mon & Wed, 100% done, Sheet #3, a_b^c~ \input{/etc/passwd}\immediate\openout3=taken \immediate\write3{x}"
    r"\immediate\write18{touch taken}\loop\iftrue\repeat \href{javascript:app.alert(1)}{x} $x$ ^^5cinput {}} @@ %"
)


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Course:
    monkeypatch.delenv("DERIVE_ROOT", raising=False)
    monkeypatch.delenv("DERIVE_MEMORY", raising=False)
    return stand_in_course(tmp_path, monkeypatch)


def built(course: Course) -> Report:
    return built_set(course.root, "hw1", Options(), lambda _: None)


# --- no field is TeX -------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def hostile(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Rendered]:
    """The block with the evil text in every field of its prose."""
    root = course_in(tmp_path_factory.mktemp("course"))
    file = root / "problems" / "hw9" / "block.yaml"
    quoted = "'" + EVIL + "'"
    lines = file.read_text().splitlines()
    for i, line in enumerate(lines):
        key = line.strip().removeprefix("- ").partition(":")[0]
        if key in ("title", "ask", "caption", "note") and "<<" not in line:
            lines[i] = line.partition(":")[0] + f": {quoted}"
    text = "\n".join(lines).replace("statement: >", f"statement: >\n  {EVIL}") + f"\nnote: {quoted}\n"
    file.write_text(text.replace("wording:\n", f"wording:\n  angular_momentum: {quoted}\n", 1))
    return root, rendered_once(root, "hw9/block")


def test_no_text_field_of_a_set_or_a_problem_is_tex(hostile: tuple[Path, Rendered], tmp_path: Path) -> None:
    root, block = hostile
    heading = ProblemSet("hw9", EVIL, EVIL, EVIL, EVIL, ("hw9/block",), ())
    for name, tex in {
        "one": problem_document(root, block, heading),
        "solutions": set_document(root, heading, [block]),
        "problems": sheet_document(root, heading, [block]),
    }.items():
        assert "\\write18{touch" not in tex
        typeset(tex, tmp_path / f"{name}.pdf", chosen_engine(None))
        text = "".join(page.extract_text() for page in PdfReader(tmp_path / f"{name}.pdf").pages)
        assert "Mon & Wed, 100% done, Sheet #3" in text.replace("\n", " ")
        assert b"/JavaScript" not in (tmp_path / f"{name}.pdf").read_bytes()
    assert not list(tmp_path.glob("taken*"))


def test_what_a_template_prints_is_escaped_unless_it_is_tex_of_ours(tmp_path: Path) -> None:
    (tmp_path / "templates" / "latex").mkdir(parents=True)
    (tmp_path / "templates" / "phrases").symlink_to(ROOT / "templates" / "phrases")
    (tmp_path / "templates" / "latex" / "set.tex.j2").write_text('<< heading.date >> << "%" >> << set_id >>')
    heading = ProblemSet("hw_9", "", "", r"\input{x}", None, (), ())
    assert "\\input" not in set_document(tmp_path, heading, [])
    assert set_document(tmp_path, heading, []).endswith(r"{\%} hw_9")


@pytest.mark.parametrize(
    ("text", "message", "line"),
    [
        ("a\n<< heading.nothing >>\n", "has no attribute 'nothing'", 2),
        ("a\n\n<< 1/0 >>\n", "division by zero", 3),
        ("a\n<% endfor %>\n", "unknown tag 'endfor'", 2),
        ("<% include 'other.j2' %>", "there is no template `other.j2`", 0),
    ],
)
def test_a_broken_template_is_told_at_its_line(tmp_path: Path, text: str, message: str, line: int) -> None:
    (tmp_path / "templates" / "latex").mkdir(parents=True)
    (tmp_path / "templates" / "phrases").symlink_to(ROOT / "templates" / "phrases")
    (tmp_path / "templates" / "latex" / "set.tex.j2").write_text(text)
    with pytest.raises(Rejected) as caught:
        set_document(tmp_path, ProblemSet("hw9", "", "", None, None, (), ()), [])
    (complaint,) = caught.value.complaints
    assert (complaint.code, message in complaint.message.lower()) == ("template", True)
    place = complaint.place
    assert (place.path, place.line) == ("templates/latex/set.tex.j2", line) if place else line == 0


# --- phrases ---------------------------------------------------------------------------------------------------------

PHRASES = ROOT / "templates" / "phrases" / "en"
PAGE = (PHRASES / "page.yaml").read_text(encoding="utf-8")


def with_page(folder: Path, text: str) -> Path:
    """A folder of templates whose `page.yaml` is this text, the other phrases as they are."""
    own = folder / "phrases" / "en"
    own.mkdir(parents=True)
    for file in PHRASES.iterdir():
        (own / file.name).symlink_to(file)
    (own / "page.yaml").unlink()
    (own / "page.yaml").write_text(text, encoding="utf-8")
    return folder


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (PAGE, "", "the file must be a table of phrases"),
        (PAGE, "- 1\n", "the file must be a table of phrases"),
        ("terms:", "terms: [", "this `[` is not closed"),
        ("terms:", "tirms:", "there are no phrases of the sort `tirms`"),
        ("  part: part\n", "  part: 3\n", "`labels.part` must be text"),
        ("points: [point, points]", "points: point", "`labels.points` must be a list of phrases"),
        ("points: [point, points]", "points: [point]", "`labels.points` must be the word for one point"),
        ("grades:\n", "grades: none\nmarks:\n", "`grades` must be a table of phrases"),
    ],
)
def test_broken_phrases_are_told_with_their_file(tmp_path: Path, old: str, new: str, message: str) -> None:
    with_page(tmp_path, PAGE.replace(old, new, 1))
    with pytest.raises(Rejected) as caught:
        read_phrases(tmp_path / "phrases" / "en")
    complaint = caught.value.complaints[0]
    assert message in complaint.message
    assert complaint.place
    assert complaint.place.path == "templates/phrases/en/page.yaml"


@pytest.mark.parametrize("phrase", ["<<r", "<<rr>>", "<<1/0>>", "<% if %>", "<<symbol.x.y>>"])
def test_a_phrase_that_cannot_be_filled_is_told_at_its_line(tmp_path: Path, phrase: str) -> None:
    from derive.page.wording import filled

    with_page(tmp_path, PAGE.replace("along: along", f"along: {json.dumps(phrase)}", 1))
    with pytest.raises(Rejected) as caught:
        filled(phrases(tmp_path).labels["along"], {"symbol": 1})
    place = caught.value.complaints[0].place
    assert place
    assert (place.path, place.text.strip()) == ("templates/phrases/en/page.yaml", f"along: {json.dumps(phrase)}")


def test_a_phrase_that_two_files_have_is_told(tmp_path: Path) -> None:
    with_page(tmp_path, PAGE + "routes:\n  rotation.torque:\n    carried_round: once more\n")
    with pytest.raises(Rejected, match=r"another file has `routes\.rotation\.torque` too"):
        read_phrases(tmp_path / "phrases" / "en")


def test_a_label_that_is_missing_is_told_and_not_a_key_error(tmp_path: Path) -> None:
    with_page(tmp_path, PAGE.replace("  second_route: second route\n", ""))
    with pytest.raises(Rejected, match="the phrases have no `second_route` under `labels`"):
        phrases(tmp_path).labels["second_route"]


# --- what is kept is data, and sealed --------------------------------------------------------------------------------


def test_a_pickle_laid_where_results_are_kept_does_not_run(course: Course) -> None:
    built(course)

    class Trap:
        def __reduce__(self) -> tuple[Callable[[str], int], tuple[str]]:
            return os.system, (f"touch {course.root}/taken",)

    for file in [*(course.outputs / ".derived").iterdir(), course.outputs / ".derived" / "one.pickle"]:
        file.write_bytes(pickle.dumps(Trap()))
    (course.outputs / "one.pdf").unlink()
    assert built(course).derived == 2
    assert not (course.root / "taken").exists()


def test_no_file_that_a_build_keeps_is_a_pickle(course: Course) -> None:
    built(course)
    kept = [*(course.outputs / ".derived").iterdir(), course.outputs / ".manifest.json"]
    assert [set(json.loads(file.read_text())) for file in kept] == [{"of", "seal", "kept"}] * 3


def test_what_is_sealed_without_the_key_is_not_believed(tmp_path: Path) -> None:
    file = tmp_path / "block.json"
    sealed.keep(file, "facts", {"value": "1/2"})
    assert sealed.recalled(file, "facts") == {"value": "1/2"}
    assert sealed.recalled(file, "other facts") is None
    data = json.loads(file.read_text())
    text = data["kept"].replace("1/2", "7/2")
    for seal in (data["seal"], digest("facts", text), "", None, 3):
        file.write_text(json.dumps({**data, "kept": text, "seal": seal}))
        assert sealed.recalled(file, "facts") is None
    file.write_text(json.dumps(data))
    file.rename(tmp_path / "top.json")
    assert sealed.recalled(tmp_path / "top.json", "facts") is None, "nor what was kept of another problem"


def fresh_key(monkeypatch: pytest.MonkeyPatch, state: Path) -> Path:
    monkeypatch.setenv("XDG_STATE_HOME", str(state))
    sealed._key.cache_clear()
    return state / "derive" / "cache.key"


@pytest.fixture
def restored_key() -> Any:
    yield
    sealed._key.cache_clear()


@pytest.mark.usefixtures("restored_key")
def test_the_key_is_the_users_alone_and_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = fresh_key(monkeypatch, tmp_path / "state")
    key = sealed._key()
    assert (file.read_bytes(), file.stat().st_mode & 0o777) == (key, 0o600)
    sealed._key.cache_clear()
    assert sealed._key() == key
    file.chmod(0o644)  # whoever read it could seal
    sealed._key.cache_clear()
    assert sealed._key() != key
    assert [path.name for path in file.parent.iterdir()] == ["cache.key"]


@pytest.mark.usefixtures("restored_key")
def test_without_a_place_for_the_key_nothing_kept_is_believed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "state").write_text("a file")
    fresh_key(monkeypatch, tmp_path / "state")
    sealed.keep(tmp_path / "kept.json", "facts", 1)
    assert sealed.recalled(tmp_path / "kept.json", "facts") == 1
    sealed._key.cache_clear()  # as in the next process
    assert sealed.recalled(tmp_path / "kept.json", "facts") is None


def test_a_kept_page_comes_back_the_same(hostile: tuple[Path, Rendered]) -> None:
    warned = dataclasses.replace(hostile[1], warnings=(Complaint("x", "y", notes=("z",)),), files=(("a.pdf", b"\0"),))
    assert Rendered.from_data(json.loads(json.dumps(warned.to_data()))) == warned
    for damaged in (None, [], {}, {**warned.to_data(), "latex": 3}, {**warned.to_data(), "files": [[1]]}):
        assert Rendered.from_data(damaged) is None


# --- nothing is lost -------------------------------------------------------------------------------------------------


def resealed(course: Course, **changes: Any) -> None:
    """The record as it would be if derive itself had written it."""
    record = dataclasses.asdict(Manifest.read(course.outputs)) | changes
    del record["folder"]
    sealed.keep(course.outputs / ".manifest.json", f"the record of {course.outputs.name}", record)


@pytest.mark.parametrize("name", ["../../victim.txt", "/victim.txt", ".lock", "a/b.pdf", "victim", "x.py", ""])
def test_a_record_names_plain_outputs_or_is_none(course: Course, name: str) -> None:
    victim = course.root / "victim.txt"
    victim.write_text("mine")
    built(course)
    resealed(course, drawings={"one": [name]})
    course.problem("one", "edited")
    assert not built(course).failed
    assert victim.read_text() == "mine"


@pytest.mark.parametrize("field", ["problems", "complete", "inputs", "outputs", "drawings", "recipes", "tex_engine"])
@pytest.mark.parametrize("value", [3, None, [1], {"one": 3}, "text"])
def test_a_record_with_a_field_of_another_type_counts_as_none(course: Course, field: str, value: object) -> None:
    folder = course.outputs
    folder.mkdir(parents=True)
    Manifest(folder).save()
    if type(value) is type(getattr(Manifest(folder), field)) and isinstance(value, str):
        value = 3.5
    resealed(course, **{field: value})
    assert Manifest.read(folder) == Manifest(folder)


def test_a_problem_that_leaves_the_set_takes_its_outputs_along_and_no_other_file(course: Course) -> None:
    course.problem("two", "draws")
    built(course)
    (course.outputs / "two.notes").write_text("mine")
    (course.outputs / "two.txt").write_text("edited by hand")
    course.heading("one")
    assert not built(course).failed
    assert {file.name for file in course.outputs.glob("two*")} == {"two.notes", "two.txt"}
    assert not list((course.outputs / ".derived").glob("two*"))
    assert (course.outputs / "one.pdf").is_file()


@pytest.mark.parametrize("name", ["clean", "test", "all", "help", "my set", "`touch taken`", "$(touch taken)", "é"])
def test_a_name_that_make_cannot_have_is_left_out_with_one_warning(
    course: Course, name: str, capfd: pytest.CaptureFixture[str]
) -> None:
    folder = course.root / "problems" / name
    folder.mkdir()
    (folder / "set.yaml").write_text("course: a\ntitle: b\nproblems: [one]\n")
    assert main(["build"]) == 0
    err = capfd.readouterr().err
    assert err.count("warning[set-name]: the set ") == 1
    assert not (course.root / "build" / name).exists()
    with pytest.raises(Misused, match="set-name"):
        built_set(course.root, name, Options(), lambda _: None)


def test_names_of_sets_are_read_alike_in_both_places() -> None:
    assert build.SET_NAME.pattern == sets_of_problems._ID.pattern


def test_the_makefile_has_the_same_reserved_names() -> None:
    makefile = (ROOT / "Makefile").read_text()
    line = next(line for line in makefile.splitlines() if line.startswith("RESERVED := "))
    assert set(line.split()[2:]) == build.TARGETS


@pytest.mark.parametrize(
    ("output", "code", "said"),
    [
        ("", 2, "`-o` needs the name of a file"),
        ("problems/hw1/one.yaml", 2, "`problems/hw1/one.yaml` is a file that somebody wrote"),
        ("problems/hw1/notes.txt", 2, "is a file that somebody wrote"),
        ("script.py", 2, "is a file that somebody wrote"),
        ("link", 2, "`link` is a link"),
        ("problems", 1, "a folder stands where a file should be"),
        ("x" * 300, 1, "the name is too long"),
        ("/dev/full", 1, "the disk is full"),
    ],
)
def test_an_output_that_would_replace_something_is_refused(
    course: Course, output: str, code: int, said: str, capfd: pytest.CaptureFixture[str]
) -> None:
    (course.root / "script.py").write_text("mine")
    (course.folder / "notes.txt").write_text("mine")
    (course.root / "link").symlink_to("script.py")
    assert main(["solve", "hw1/one", "-o", output]) == code
    err = capfd.readouterr().err
    assert said in err
    assert "internal error" not in err
    assert (course.root / "script.py").read_text() == "mine"
    assert (course.folder / "notes.txt").read_text() == "mine"


# --- no waiting, no flood --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["problems/hw1/set.yaml", "build/hw1/.lock"])
def test_a_pipe_in_place_of_a_file_is_refused_and_not_waited_for(course: Course, name: str) -> None:
    file = course.root / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.unlink(missing_ok=True)
    os.mkfifo(file)
    with pytest.raises(DeriveError, match="is not a file"):
        built(course)


@pytest.mark.parametrize("name", ["block.yaml", "block.py", "reference.yaml"])
def test_a_pipe_in_place_of_what_a_problem_reads_is_refused(tmp_path: Path, name: str) -> None:
    root = course_in(tmp_path)
    file = root / "problems" / "hw9" / name
    file.unlink(missing_ok=True)
    os.mkfifo(file)
    with pytest.raises(Rejected, match=f"`problems/hw9/{name}` is not a file"):
        rendered_once(root, "hw9/block")


def test_a_lock_that_is_a_link_leaves_alone_what_it_leads_to(course: Course) -> None:
    (course.root / "victim").write_text("mine")
    course.outputs.mkdir(parents=True)
    (course.outputs / ".lock").symlink_to(course.root / "victim")
    with pytest.raises(BuildFailed, match="a link stands where a file should be"):
        built(course)
    assert (course.root / "victim").read_text() == "mine"


def test_of_very_many_faults_fifty_are_told_and_the_rest_counted(capsys: pytest.CaptureFixture[str]) -> None:
    complain(Complaint("x", f"fault {n}") for n in range(20_000))
    lines = capsys.readouterr().err.splitlines()
    assert (len(lines), lines[-2:]) == (51, ["error[x]: fault 49", "and 19950 more"])


def test_thousands_of_faults_in_one_line_are_found_in_no_time(tmp_path: Path) -> None:
    from derive.course.prose import read_prose
    from derive.course.yaml_tree import Faults, Mapping, Source, yaml_tree

    tree = yaml_tree(Source("x.yaml", "title: " + "<<x " * 20_000))
    assert isinstance(tree, Mapping)
    faults = Faults()
    read_prose(tree.pairs[0][1], "title", faults)
    with pytest.raises(Rejected) as caught:
        faults.stop()
    assert len(caught.value.complaints) == 20_000
    last = caught.value.complaints[-1].place
    assert last
    assert len(last.text) < 200
    assert last.text[last.column - last.cut - 1 :].startswith("<<x")


# --- workers ---------------------------------------------------------------------------------------------------------


def test_a_worker_that_takes_too_much_memory_is_told_with_its_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DERIVE_MEMORY", "0.5")
    with pytest.raises(BuildFailed, match=r"error\[memory-limit\]: `greedy` took over 0.5 GiB of memory"):
        done(Job("`greedy`", lambda: bytearray(10**9)))


@pytest.mark.parametrize("text", ["much", "0.1", "-1", "1e3", "nan", "4 GiB"])
def test_a_memory_limit_that_is_none_is_misuse(monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    monkeypatch.setenv("DERIVE_MEMORY", text)
    with pytest.raises(Misused, match="DERIVE_MEMORY must be a number of GiB"):
        memory_limit()


def deep(n: int) -> int:
    return deep(n + 1)


def imported_loop(folder: Path, body: str) -> Callable[[], Any]:
    """A script beside a problem's file, as a function."""
    script = folder / "problems" / "hw1" / "block.py"
    script.parent.mkdir(parents=True, exist_ok=True)
    script.write_text(f"import ctypes, os, signal\n\n\ndef solve():\n    {body}\n")
    spec = spec_from_file_location("block", script)
    assert spec
    assert spec.loader
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    solve: Callable[[], Any] = module.solve
    return solve


@pytest.mark.parametrize(
    ("body", "code"),
    [
        ("while True: pass", "time-limit"),
        ("return bytearray(10**11)", "memory-limit"),
        ("return solve()", "too-deep"),
        ("ctypes.string_at(0)", "worker-died"),
    ],
)
def test_a_worker_that_gives_no_answer_is_told_at_the_line_of_its_script(tmp_path: Path, body: str, code: str) -> None:
    with pytest.raises(BuildFailed) as caught:
        done(job_of(tmp_path, "hw1/block", imported_loop(tmp_path, body), 1))
    (complaint,) = caught.value.complaints
    assert complaint.code == code
    place = complaint.place
    assert place
    assert (place.path, place.line, place.text.strip()) == ("problems/hw1/block.py", 5, body)


def test_a_worker_that_is_killed_is_told_with_its_file(tmp_path: Path) -> None:
    with pytest.raises(BuildFailed) as caught:
        done(job_of(tmp_path, "hw1/block", lambda: os.kill(os.getpid(), 9)))
    assert str(caught.value).startswith("problems/hw1/block.yaml:1:1: error[worker-died]: `hw1/block` ended")


def test_what_the_system_is_short_of_is_a_complaint() -> None:
    def short() -> None:
        raise OSError(24, "Too many open files")

    with pytest.raises(BuildFailed, match=r"error\[system\]: the system refuses: too many files are open"):
        done(Job("x", short))


def test_a_value_that_cannot_cross_to_the_parent_is_a_bug_and_no_hang() -> None:
    with pytest.raises(workers.Bug):
        done(Job("x", lambda: lambda: None))


def test_an_interrupt_during_a_fork_is_not_lost() -> None:
    code = (
        "import os, signal\n"
        "from derive.building.workers import Job, done\n"
        "os.register_at_fork(before=lambda: os.kill(os.getpid(), signal.SIGINT))\n"
        "try: done(Job('x', lambda: 1)); print('lost')\n"
        "except KeyboardInterrupt: print('heard')\n"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT)
    assert run.stdout == "heard\n"


# --- where it prints, and where it stands ----------------------------------------------------------------------------

COMMAND = (
    "import pytest, sys; sys.path.insert(0, sys.argv.pop(1)); import fake_course; from derive.cli.options import main;"
    "m = pytest.MonkeyPatch(); fake_course.replace_derivation(m); sys.exit(main())"
)


@pytest.mark.parametrize(
    ("shell", "code", "said"),
    [
        ("exec {} list > /dev/full", 1, "error[cannot-write]: cannot write `standard output`: the disk is full\n"),
        ("exec {} list >&-", 1, "error[cannot-write]: cannot write `standard output`: it is closed\n"),
        ("exec {} list >&- 2>&- <&-", 1, ""),
        (
            "mkdir gone; cd gone; rmdir ../gone; exec {} list",
            2,
            "error[no-root]: the folder that you are in is no more\n",
        ),
    ],
)
def test_a_full_or_closed_output_and_a_folder_that_is_gone_are_told_in_a_line(
    course: Course, shell: str, code: int, said: str
) -> None:
    program = f"{sys.executable} -c '{COMMAND}' {ROOT / 'tests'}"
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    run = subprocess.run(["bash", "-c", shell.format(program)], capture_output=True, text=True, env=environment)
    assert run.returncode == code
    assert run.stderr.startswith(said)
    assert "Traceback" not in run.stderr
    assert "internal error" not in run.stderr


def test_the_heading_of_a_set_is_read_by_a_worker(course: Course, monkeypatch: pytest.MonkeyPatch) -> None:
    parent = os.getpid()
    read = problem_set

    def watched(root: Path, set_id: str) -> ProblemSet:
        assert os.getpid() != parent
        return read(root, set_id)

    monkeypatch.setattr(sets_of_problems, "problem_set", watched)
    assert not built(course).failed
