"""What comes from outside is never run, never lost and never an internal error: fields, caches, names, outputs."""

from __future__ import annotations

import os
import shlex
import subprocess
from pathlib import Path

import pytest
from pypdf import PdfReader

from derive.building.set_document import problem_document, set_document, sheet_document
from derive.building.set_names import TARGETS
from derive.building.sets import Options, Report, built_set
from derive.building.tex import chosen_engine, typeset
from derive.cli.options import main
from derive.course import problem_set as sets_of_problems
from derive.course.problem_set import ProblemSet, problem_set
from derive.errors import BuildFailed, DeriveError, Misused, Rejected
from derive.render.rendered import Rendered
from tests.cli.started import command
from tests.courses import ROOT, course_in, rendered_once
from tests.fake_course import Course, stand_in_course

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
    heading = ProblemSet("hw9", EVIL, EVIL, ("hw9/block",), (), EVIL, EVIL, EVIL, EVIL)
    for name, tex in {
        "one": problem_document(root, block, heading),
        "solutions": set_document(root, heading, [block]),
        "problems": sheet_document(root, heading, [block]),
    }.items():
        assert "\\write18{touch" not in tex
        if name == "one":  # the set has the same solution
            continue
        typeset(tex, tmp_path / f"{name}.pdf", chosen_engine(None))
        text = "".join(page.extract_text() for page in PdfReader(tmp_path / f"{name}.pdf").pages)
        assert "Mon & Wed, 100% done, Sheet #3" in text.replace("\n", " ")
        assert b"/JavaScript" not in (tmp_path / f"{name}.pdf").read_bytes()
    assert not list(tmp_path.glob("taken*"))


def test_whoever_writes_tex_into_a_text_field_is_warned_of_it(hostile: tuple[Path, Rendered]) -> None:
    places = [w.place.line for w in hostile[1].warnings if w.place and w.code == "latex-in-prose"]
    lines = (hostile[0] / "problems" / "hw9" / "block.yaml").read_text().splitlines()
    assert sorted(places) == [i for i, line in enumerate(lines, 1) if "immediate" in line]


# --- nothing is lost -------------------------------------------------------------------------------------------------


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


def test_the_makefile_has_the_same_reserved_names() -> None:
    makefile = (ROOT / "Makefile").read_text()
    line = next(line for line in makefile.splitlines() if line.startswith("RESERVED := "))
    assert set(line.split()[2:]) == TARGETS


@pytest.mark.parametrize(
    ("output", "code", "said"),
    [
        ("", 2, "`-o` needs the name of a file"),
        ("problems/hw1/one.yaml", 2, "`problems/hw1/one.yaml` is not replaced, because it may be written by hand"),
        ("problems/hw1/notes.txt", 2, "is not replaced, because it may be written by hand"),
        ("script.py", 2, "is not replaced, because it may be written by hand"),
        ("link", 2, "`link` is a link"),
        ("problems", 2, "`problems` is a folder"),
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
    with pytest.raises(BuildFailed, match="a link is where a file should be"):
        built(course)
    assert (course.root / "victim").read_text() == "mine"


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


# --- where it prints, and where it stands ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("shell", "code", "said"),
    [
        ("exec {} list > /dev/full", 1, "error[cannot-write]: cannot write `standard output`: the disk is full\n"),
        ("exec {} list >&-", 1, "error[cannot-write]: cannot write `standard output`: it is closed\n"),
        ("exec {} list >&- 2>&- <&-", 1, ""),
        (
            "mkdir gone; cd gone; rmdir ../gone; exec {} list",
            2,
            "error[no-root]: the folder that you are in does not exist any more\n",
        ),
    ],
)
def test_a_full_or_closed_output_and_a_folder_that_is_gone_are_told_in_a_line(
    course: Course, shell: str, code: int, said: str
) -> None:
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    run = ["bash", "-c", shell.format(shlex.join(command()))]
    done = subprocess.run(run, capture_output=True, text=True, env=environment)
    assert done.returncode == code
    assert done.stderr.startswith(said)
    assert "Traceback" not in done.stderr
    assert "internal error" not in done.stderr


@pytest.mark.usefixtures("workers")
def test_the_heading_of_a_set_is_read_by_a_worker(course: Course, monkeypatch: pytest.MonkeyPatch) -> None:
    parent = os.getpid()
    read = problem_set

    def watched(root: Path, set_id: str) -> ProblemSet:
        assert os.getpid() != parent
        return read(root, set_id)

    monkeypatch.setattr(sets_of_problems, "problem_set", watched)
    assert not built(course).failed
