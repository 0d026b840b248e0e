"""The documents of a set: contents, pages, bookmarks, references by number, the students' sheet, how it was checked."""

from __future__ import annotations

import json
import re
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from pypdf import PdfReader

from derive.building import tex as engine_runs
from derive.building.cache import Cache, Kept
from derive.building.set_document import COUNTED, problem_document, report_document, set_document, sheet_document
from derive.building.solution import rendered
from derive.building.tex import chosen_engine, typeset
from derive.course.names import Language, Paper
from derive.course.problem_set import problem_set
from derive.errors import Rejected
from derive.render.rendered import Rendered, Tex
from tests.building.test_pages import squeezed
from tests.courses import ROOT, course_in, rendered_once

HEADING = "course: Physics 311\ntitle: Homework 9\ndate: Fall 2015\ninstructor: E. Noether\n"
REFERENCE = """
- problem: block
  symbols: {a: length, M: mass, omega: angular speed}
  given: {sides: [a, 2*a, 3*a], mass: M, axis: diagonal, rate: omega}
  entries:
    - {part: 2, answer: kinetic_energy_about_axis, states: 7/24*M*a**2*omega**2}
    - {part: 3, answer: angle_between, states: 22.64, in: degree, to: 4, erratum: {why: 22 for 21, right: 21.64}}
    - part: 1
      answer: centre_of_mass
      states: [1/2*a, a, 5/2*a]
      erratum: {why: the last entry has 5 for 3, right: [1/2*a, a, 3/2*a]}
"""


def set_of(root: Path, *problems: str) -> None:
    listed = "".join(f"  - {name}\n" for name in problems)
    (root / "problems" / "hw9" / "set.yaml").write_text(f"{HEADING}problems:\n{listed}", encoding="utf-8")


def also(root: Path, name: str, edits: dict[str, str]) -> None:
    folder = root / "problems" / "hw9"
    text = (folder / "block.yaml").read_text(encoding="utf-8")
    for old, new in edits.items():
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    (folder / f"{name}.yaml").write_text(text, encoding="utf-8")


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    edits = {"It turns at": "As <<problem cube>> it turns at", "magnitude]": "magnitude, angle_between]"}
    root = course_in(tmp_path_factory.mktemp("course"), edits)
    cube = {"[a, 2*a, 3*a]": "[a, a, a]", "title: A block": "title: A cube", "As <<problem cube>> it": "It"}
    also(root, "cube", cube)
    (root / "problems" / "hw9" / "reference.yaml").write_text(REFERENCE, encoding="utf-8")
    set_of(root, "cube", "block")
    return root


@pytest.fixture(scope="module")
def solved(course: Path) -> list[Rendered]:
    return [rendered_once(course, problem_id) for problem_id in problem_set(course, "hw9").problems]


@pytest.fixture(scope="module")
def solutions(course: Path, solved: list[Rendered]) -> PdfReader:
    target = course / "solutions.pdf"
    tex = set_document(course, problem_set(course, "hw9"), solved)
    typeset(tex, target, chosen_engine(None), numbers=numbers_in(course))
    return PdfReader(target)


PLAIN = r"\documentclass{article}\usepackage[T1]{fontenc}\usepackage{lmodern}\def\told{honest}"
PLAIN += r"\begin{document}\told\end{document}"


def numbers_in(course: Path) -> Kept:
    return Kept(Cache(course / "kept"), "numbers")


def page_of(reader: PdfReader, name: str) -> int:
    return int(reader.get_destination_page_number(reader.named_destinations[name])) + 1  # type: ignore[arg-type]


def outline(entries: list[Any]) -> list[Any]:
    return [outline(entry) if isinstance(entry, list) else entry.title for entry in entries]


# --- the document with the solutions ---


def test_the_contents_give_the_pages_on_which_the_problems_begin(solutions: PdfReader) -> None:
    cover = re.sub(r"[ .]+", " ", solutions.pages[0].extract_text())
    for number, name, title in ((1, "hw9.cube", "A cube turning"), (2, "hw9.block", "A block turning")):
        assert re.search(rf"{number} {title} about a long diagonal 10 {page_of(solutions, name)}\n", cover)
    assert "How this was checked" not in cover
    assert re.search(r"Total 20\n", cover)
    assert "E Noether" in cover


def test_a_problem_follows_the_one_before_on_its_page(
    course: Path, solved: list[Rendered], solutions: PdfReader
) -> None:
    assert page_of(solutions, "hw9.cube") == page_of(solutions, "hw9.cube.a") == 1
    short = replace(solved[0], latex=Tex("A short solution. " * 20))
    target = course / "short.pdf"
    typeset(set_document(course, problem_set(course, "hw9"), [short, solved[1]]), target, chosen_engine(None))
    reader = PdfReader(target)
    above = reader.pages[page_of(reader, "hw9.block") - 1].extract_text().partition("A uniform block")[0]
    assert len(above.split()) > 40, "the end of the problem before it"


def test_the_head_of_a_page_names_the_problem_that_continues_there(solutions: PdfReader) -> None:
    heads = [page.extract_text().splitlines()[0] for page in solutions.pages]
    block = page_of(solutions, "hw9.block")
    assert all("Homework 9" in head for head in heads)
    assert "A cube turning" in heads[block - 2]
    assert "A block turning" in heads[block]
    assert "How this was checked" not in heads[-1]


def test_bookmarks_name_problems_and_parts(solutions: PdfReader) -> None:
    cube, parts, *_ = outline(solutions.outline)
    assert cube == "1. A cube turning about a long diagonal"
    assert parts[0] == "(a) Find the inertia tensor about the centre."
    assert parts[2] == "(c) Find the angle between ω⃗ and the angular momentum L⃗."


def test_every_link_leads_somewhere_in_the_document(solutions: PdfReader) -> None:
    links = [a.get_object() for page in solutions.pages for a in page.get("/Annots", [])]
    targets = {str(link["/A"]["/D"]) for link in links if "/A" in link and "/D" in link["/A"]}
    assert {"hw9.cube", "hw9.block"} <= targets
    assert targets <= set(solutions.named_destinations)


@pytest.mark.long
def test_kept_page_numbers_save_a_run_and_change_nothing(
    course: Path, solved: list[Rendered], solutions: PdfReader, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs: list[str] = []
    run = engine_runs.subprocess.run
    monkeypatch.setattr(engine_runs.subprocess, "run", lambda *a, **k: runs.append("run") or run(*a, **k))
    tex, engine = set_document(course, problem_set(course, "hw9"), solved), chosen_engine(None)
    numbers = numbers_in(course)
    assert not typeset(tex, course / "solutions.pdf", engine, numbers=numbers), "the same pages"
    assert len(runs) == 1
    numbers.keep(b"\\undefined\n")
    assert not typeset(tex, course / "solutions.pdf", engine, numbers=numbers), "another document's are no obstacle"


def test_page_numbers_that_somebody_wrote_are_not_run(tmp_path: Path) -> None:
    """They are TeX: what is appended to the kept file must not come onto a page."""
    numbers, target, engine = numbers_in(tmp_path), tmp_path / "page.pdf", chosen_engine(None)

    def told() -> str:
        typeset(PLAIN, target, engine, numbers=numbers)
        return PdfReader(target).pages[0].extract_text().split()[0]

    assert told() == "honest"
    file = tmp_path / "kept" / numbers.key
    file.write_bytes(file.read_bytes() + b"\\gdef\\told{forged}\n")
    assert told() == "honest"
    numbers.keep(b"\\relax\n\\gdef\\told{ours}\n")
    assert told() == "ours"  # what was kept by us is what TeX reads


def test_one_problem_alone_needs_one_run_and_has_its_bookmarks(
    course: Path, solved: list[Rendered], monkeypatch: pytest.MonkeyPatch
) -> None:
    runs: list[str] = []
    run = engine_runs.subprocess.run
    monkeypatch.setattr(engine_runs.subprocess, "run", lambda *a, **k: runs.append("run") or run(*a, **k))
    target = course / "block.pdf"
    typeset(problem_document(course, solved[1], problem_set(course, "hw9")), target, chosen_engine(None))
    assert len(runs) == 1
    assert outline(PdfReader(target).outline)[0] == "2. A block turning about a long diagonal"


def test_a_problem_gets_its_number_where_it_is_listed_and_nothing_in_it_is_replaced(
    course: Path, solved: list[Rendered]
) -> None:
    typed = Tex("as typed: @NUMBER@, << listed.number >> and 2")
    problem = replace(solved[1], latex=typed, sheet=typed)
    heading = problem_set(course, "hw9")
    for document in (problem_document(course, problem, heading), sheet_document(course, heading, [solved[0], problem])):
        assert document.count(typed) == 1
        assert r"\problem{2}{A block turning about a long{~}diagonal}{10 points}" in document


def test_only_a_document_that_is_not_in_english_lists_its_divided_words(course: Path, solved: list[Rendered]) -> None:
    english = problem_set(course, "hw9")
    french = replace(english, language=Language("fr"))
    told = {heading.language.name: problem_document(course, solved[1], heading) for heading in (english, french)}
    assert r"\hyphenation" not in told["en"]
    assert " an-gu-lar " in told["fr"].partition(r"\hyphenation{")[2].partition("}")[0]


# --- how it was checked ---


def test_the_last_page_counts_steps_lines_routes_and_references(solved: list[Rendered]) -> None:
    counts = solved[1].counts
    assert set(counts) == {*COUNTED, "claims_sampled"}
    assert (counts["agree"], counts["agree_to_figures"], counts["errata"]) == (1, 0, 2)
    assert sum(counts[f"steps_{grade}"] for grade in ("proved", "sampled", "approximation", "definition")) == 29
    assert counts["steps_definition"] == 3
    assert counts["routes"] == counts["routes_proved"] > 15
    assert counts["checks"] > 5


def test_errata_are_told_with_what_is_printed_and_what_is_right(solved: list[Rendered]) -> None:
    told = solved[1].source
    assert r"\theta = 22.64\mathrm{{}^\circ}" in told
    assert r"\theta = 21.64\mathrm{{}^\circ}" in told
    assert "22 for 21" in told
    assert r"\told{printed}{$\bm{r}_{C} = (" in told and r"\ \tfrac{5}{2}\,a)$}" in told
    assert solved[0].counts["errata"] == 0
    assert solved[0].source == "" and "Errata" not in solved[1].report


def test_second_routes_are_told_by_result(solved: list[Rendered]) -> None:
    (row,) = [line for line in solved[1].report.splitlines() if r"{J_{xx}}" in line]
    assert r"\cell{component of the tensor}" in row and r"{J_{yz}}" in row
    assert r"equimomental" in row and r"& \cell{--} \tabularnewline" in row


def test_kept_steps_tell_the_same_errata(course: Path, solved: list[Rendered]) -> None:
    kept = Cache(course / "kept")
    assert rendered(course, "hw9/block", None, kept) == solved[1]
    assert rendered(course, "hw9/block", None, kept) == solved[1]


def test_the_report_has_a_table_of_each_problem_and_the_errata(course: Path, solved: list[Rendered]) -> None:
    target = course / "report.pdf"
    typeset(report_document(course, problem_set(course, "hw9"), solved), target, chosen_engine(None))
    reader = PdfReader(target)
    text = squeezed(target)
    for told in ("Report", "StepWhatitisGradeLinesSecondrouteChecks", "bydefinition", "Errataofthesource", "22for21"):
        assert told in text, told
    assert text.index("22for21") < text.index("StepWhatitis") < text.index("Provedmeans"), (
        "errata first, the legend last"
    )
    width = float(reader.pages[0].mediabox.width)
    ends: list[float] = []
    for page in reader.pages:
        page.extract_text(visitor_text=lambda text, _, matrix, *__: ends.append(matrix[4]) if text.strip() else None)
    assert max(ends) < width - 30, "nothing begins where the sheet ends"


# --- the students' sheet ---


def test_the_sheet_has_the_questions_and_nothing_that_is_derived(course: Path, solved: list[Rendered]) -> None:
    target = course / "problems.pdf"
    tex = sheet_document(course, problem_set(course, "hw9"), solved)
    typeset(tex, target, chosen_engine(None))
    text = squeezed(target)
    for question in ("Findtheinertiatensoraboutthecentre", "1Acubeturning", "2Ablockturning", "10points", "3points"):
        assert question in text
    for leaked in ("2779", "21.64", "0.2315", "proved", "principal", "density", "Howthiswaschecked"):
        assert leaked not in text
    assert "(1)" not in text, "no equation is numbered"
    assert len(PdfReader(target).pages) == 1


def test_a_sheet_has_each_question_once_wherever_its_drawing_has_no_room(tmp_path: Path) -> None:
    """Passages beside a drawing are put together first; without room for the drawing they are set below it."""
    root = course_in(tmp_path, {"drawings:\n": "drawings:\n  axes: {caption: The axes.}\n"})
    solution = rendered_once(root, "hw9/block", draws=True)
    tex = sheet_document(root, problem_set(root, "hw9"), [solution])
    drawings = [each for each in solution.files if each[0].endswith(".pdf")]
    asked = ["inertiatensorabout", "kineticenergy,ingeneral", "anglebetween", "torquemust"]
    places = set()
    for height in (0, 9, 12, 15, 18):
        target = tmp_path / f"{height}.pdf"
        above = Tex(tex.replace(r"\drawingbeside{block", rf"\vspace*{{{height}cm}}\drawingbeside{{block"))
        typeset(above, target, chosen_engine(None), included=drawings)
        text = squeezed(target)
        assert [text.count(question) for question in asked] == [1] * len(asked), height
        places.add(text.index("Figure1") < text.index(asked[0]))
    assert places == {False}, "the drawing is beside the questions, or below them"


def test_on_a_sheet_a_problem_begins_where_its_drawing_has_room(tmp_path: Path) -> None:
    root = course_in(tmp_path, {"drawings:\n": "drawings:\n  axes: {caption: The axes.}\n"})
    solution = rendered_once(root, "hw9/block", draws=True)
    tex = sheet_document(root, problem_set(root, "hw9"), [solution])
    drawings = [each for each in solution.files if each[0].endswith(".pdf")]
    target = tmp_path / "sheet.pdf"
    head = r"\headwithroom{block"
    first = {}
    for height in (2, 18):
        lower = Tex(tex.replace(head, rf"\noindent\rule{{1pt}}{{{height}cm}}\par {head}"))
        typeset(lower, target, chosen_engine(None), included=drawings)
        pages = [page.extract_text() for page in PdfReader(target).pages]
        first[height] = next(i for i, page in enumerate(pages) if "A block turning" in page)
        assert "Figure 1" in pages[first[height]]
    assert first == {2: 0, 18: 1}


def test_the_sheet_refers_to_a_part_where_the_solution_has_an_equation(tmp_path: Path) -> None:
    root = course_in(tmp_path, {"What torque must": "With <<spin>> from <<eq spin>>, what torque must"})
    solution = rendered_once(root, "hw9/block")
    assert r"from \hyperlink{hw9.block.17}{\eqnumber{17}}, what torque" in solution.latex
    assert r"from part (b), what torque" in solution.sheet
    assert "With ω⃗ from (17), what torque" in solution.texts["text"]


def test_a_caption_may_refer_to_a_later_equation_in_every_format(tmp_path: Path) -> None:
    text = (ROOT / "problems" / "hw9" / "top.yaml").read_text(encoding="utf-8")
    assert "<<eq sleeping_spin>>" in text.partition("drawings:")[2]
    solution = rendered_once(ROOT, "hw9/top")
    (well,) = [each for each in json.loads(solution.texts["json"])["drawings"] if each["key"] == "well"]
    assert "the critical spin of (29)." in well["caption"]


def test_the_sheet_is_the_same_however_much_is_derived(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    assert rendered_once(root, "hw9/block", "brief").sheet == rendered_once(root, "hw9/block", "full").sheet


@pytest.mark.parametrize(("paper", "size"), [(Paper.A4, (595, 842)), (Paper.LETTER, (612, 792))])
def test_paper_has_the_size_of_the_set(
    course: Path, solved: list[Rendered], paper: Paper, size: tuple[int, int]
) -> None:
    target = course / f"{paper}.pdf"
    heading = replace(problem_set(course, "hw9"), paper=paper)
    typeset(sheet_document(course, heading, solved), target, chosen_engine(None))
    box = PdfReader(target).pages[0].mediabox
    assert (round(box.width), round(box.height)) == size


def test_figures_are_numbered_in_a_row(tmp_path: Path) -> None:
    """The figures of the first problem count before those of the second."""
    root = course_in(tmp_path, {"<<spin>> and <<angular_momentum>> in": "See <<figure vectors>>, vectors in"})
    also(root, "cube", {"title: A block": "title: A cube"})
    set_of(root, "cube", "block")
    parts = [rendered_once(root, f"hw9/{name}", draws=True) for name in ("cube", "block")]
    target = tmp_path / "solutions.pdf"
    typeset(set_document(root, problem_set(root, "hw9"), parts), target, chosen_engine(None))
    assert re.findall(r"Figure(\d)", squeezed(target)) == ["1", "1", "2", "2"]


# --- references ---


def test_another_problem_is_referred_to_by_its_number_in_the_set(course: Path, solved: list[Rendered]) -> None:
    assert "As Problem 1 it turns" in " ".join(solved[1].texts["text"].split())
    assert r"As \problemlink{hw9.cube}{Problem 1} it turns" in solved[1].latex
    assert "problems/hw9/set.yaml" in solved[1].inputs, "another order is another number"
    assert "problems/hw9/set.yaml" not in solved[0].inputs


def test_what_an_earlier_part_has_answered_is_referred_to(solved: list[Rendered]) -> None:
    assert "Part (c) has already given θ, equation (21)." in solved[1].texts["text"]


@pytest.mark.parametrize(
    ("edit", "message", "help_line"),
    [
        ("<<eq torqe>>", "no step on this page is called `torqe`", "did you mean `torque`?"),
        (
            "<<eq mass>>",
            "no step on this page is called `mass`",
            "use the key of a step on which the answers depend",
        ),
        (
            "<<eq spin>>",
            "the equation of `spin` is not shown, so it has no number",
            "change `spin: hidden` under `show`, or write `<<spin>>`",
        ),
        ("<<problem blok>>", "`blok` is not a problem of this set", "did you mean `block`?"),
        (
            "<<part a>>",
            "`<<part a>>` is not a mention",
            "write one name, as `<<mass>>`, `<<eq torque>>`, `<<figure axes>>` or `<<problem top>>`",
        ),
    ],
)
def test_a_reference_to_what_is_not_there_is_told(tmp_path: Path, edit: str, message: str, help_line: str) -> None:
    root = course_in(tmp_path, {"It turns at": f"{edit} It turns at"})
    with open(root / "problems" / "hw9" / "block.yaml", "a", encoding="utf-8") as file:
        file.write("show: {spin: hidden}\n")
    with pytest.raises(Rejected) as caught:
        rendered_once(root, "hw9/block")
    (complaint,) = caught.value.complaints
    assert (complaint.message, complaint.help) == (message, help_line)


def test_a_title_refers_to_no_equation(tmp_path: Path) -> None:
    with pytest.raises(Rejected, match="a title cannot refer to an equation, a figure or a problem"):
        rendered_once(course_in(tmp_path, {"title: A block": "title: By <<eq torque>> a block"}), "hw9/block")


# --- the list of problems ---


def test_a_set_may_have_one_problem_without_points(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    text = (root / "problems" / "hw9" / "block.yaml").read_text(encoding="utf-8")
    (root / "problems" / "hw9" / "block.yaml").write_text(re.sub(r" *points: \d+\n", "", text), encoding="utf-8")
    solution = rendered_once(root, "hw9/block")
    assert "Total" not in set_document(root, problem_set(root, "hw9"), [solution])
    assert "points" not in sheet_document(root, problem_set(root, "hw9"), [solution]).partition(r"\begin{document}")[2]


@pytest.mark.parametrize(
    ("listed", "message"),
    [
        (("block", "block"), "`block` is listed twice"),
        (("blok",), "no problem of this set is called `blok`"),
        (("hw8/top",), "`hw8/top` is a problem of another set"),
        (("solutions",), "a problem cannot be called `solutions`, because a document of the set has that name"),
    ],
)
def test_a_problem_that_cannot_be_listed_is_told(tmp_path: Path, listed: tuple[str, ...], message: str) -> None:
    root = course_in(tmp_path)
    (root / "problems" / "hw8").mkdir()
    shutil.copy(root / "problems" / "hw9" / "block.yaml", root / "problems" / "hw8" / "top.yaml")
    set_of(root, *listed)
    with pytest.raises(Rejected) as caught:
        problem_set(root, "hw9")
    assert [c.message for c in caught.value.complaints] == [message]


def test_an_empty_set_is_told_to_be_empty(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    (root / "problems" / "hw9" / "set.yaml").write_text(f"{HEADING}problems: []\n", encoding="utf-8")
    with pytest.raises(Rejected, match="`problems` must be a list of names, but it is empty"):
        problem_set(root, "hw9")


def test_solutions_have_no_closing_note_by_default(solutions: PdfReader) -> None:
    assert not any("checked" in page.extract_text().lower() for page in solutions.pages)


def test_the_caption_of_a_statement_is_under_its_drawing_also_if_the_drawing_is_higher(tmp_path: Path) -> None:
    """The statement has one line, so the drawing is higher; the caption must not move under the statement."""
    root = course_in(tmp_path, {"drawings:\n": "drawings:\n  axes: {at: statement, caption: The axes.}\n"})
    solution = rendered_once(root, "hw9/block", draws=True)
    drawings = [each for each in solution.files if each[0].endswith(".pdf")]
    name = Path(drawings[0][0]).name
    drawn = rf"\beside{{One line.}}{{{name}}}{{words}}{{Figure 1.}}{{The axes.}}"
    beside = rf"\begin{{statement}}{drawn}\end{{statement}}\strategy{{Plan.}}{{Go.}}"
    target = tmp_path / "statement.pdf"
    tex = problem_document(root, replace(solution, latex=Tex(beside)), problem_set(root, "hw9"))
    typeset(tex, target, chosen_engine(None), included=drawings)
    page, places = PdfReader(target).pages[0], {}

    def note(text: str, _: Any, at: Any, *more: Any) -> None:
        places.update({word: (at[4], at[5]) for word in ("One line", "Figure 1") if word in text})

    page.extract_text(visitor_text=note)
    assert places["Figure 1"][0] > float(page.mediabox.width) / 2 > places["One line"][0]
    assert places["Figure 1"][1] < places["One line"][1]


def test_a_drawing_beside_a_long_strategy_is_larger(tmp_path: Path) -> None:
    root = course_in(tmp_path, {"drawings:\n": "drawings:\n  axes: {at: statement, caption: The axes.}\n"})
    solution = rendered_once(root, "hw9/block", draws=True)
    drawings = [each for each in solution.files if each[0].endswith(".pdf")]
    drawn = rf"\beside{{One line.}}{{{Path(drawings[0][0]).name}}}{{words}}{{Figure 1.}}{{The axes.}}"
    statement = rf"\newpage\begin{{statement}}{drawn}\end{{statement}}"
    long = rf"\strategyfollows{{\strategytext{{Plan.}}{{{'Go on. ' * 150}}}}}"
    tex = problem_document(
        root, replace(solution, latex=Tex(rf"\mbox{{}}{statement}{long}{statement}")), problem_set(root, "hw9")
    )
    typeset(tex, tmp_path / "statement.pdf", chosen_engine(None), included=drawings)
    heights = []

    def note(text: str, _: Any, at: Any, *more: Any) -> None:
        heights.extend([at[5]] if "Figure 1" in text else [])

    for page in PdfReader(tmp_path / "statement.pdf").pages[1:]:
        page.extract_text(visitor_text=note)
    usual, with_room = heights
    assert with_room < usual - 10


def test_words_before_a_display_appear_once_beside_a_drawing(tmp_path: Path) -> None:
    """A passage that is too high begins beside the drawing; TeX sets it without displays to measure its first lines."""
    solution = rendered_once(course_in(tmp_path), "hw9/block", draws=True)
    drawings = [each for each in solution.files if each[0].endswith(".pdf")]
    row = r"\row{x}{= y}{.}{}{}"
    first = rf"\passage{{\todisplay{{{'A line of words. ' * 6}}}\chain{{{row}}}}}"
    high = (
        rf"\passage{{\todisplay{{{'More words. ' * 70}}}\chain{{{row * 8}}}\wordstodisplay{{so it is}}\chain{{{row}}}}}"
    )
    beside = rf"\drawingbeside{{{Path(drawings[0][0]).name}}}{{words}}{{Figure 1.}}{{The axes.}}{{}}{{{first}{high}}}"
    tex = problem_document(tmp_path, replace(solution, latex=Tex(beside)), problem_set(tmp_path, "hw9"))
    typeset(tex, tmp_path / "beside.pdf", chosen_engine(None), included=drawings)
    assert PdfReader(tmp_path / "beside.pdf").pages[0].extract_text().count("so it is") == 1
