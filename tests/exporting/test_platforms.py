"""Sets for learning platforms: the numbers and tolerances are those of the page, and the files are well-formed."""

from __future__ import annotations

import io
import json
import re
import sys
import zipfile
from base64 import b64decode
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from sympy import simplify, symbols, sympify

from derive.building import solution
from derive.building.solution import rendered
from derive.cli.options import main
from derive.errors import BuildFailed
from derive.exporting.canvas import PACKAGE as CANVAS_PACKAGE
from derive.exporting.canvas import QTI as QTI_1
from derive.exporting.canvas import canvas_package
from derive.exporting.moodle import _marks, moodle_xml
from derive.exporting.prairielearn import prairielearn_package
from derive.exporting.qti import PACKAGE, QTI, qti_package
from derive.exporting.questions import Answer, Question, questions_of
from derive.exporting.word import word_document
from tests.courses import ROOT

PROBLEM = """\
title: A bead & a <wire>
solve: system
symbols: {m: mass, g: acceleration, b: length}
values: {b: 20 cm, g: 9.81 m/s^2}
given:
  coordinates: {x: length}
  particles:
    bead: {mass: m, at: [x, x**2/(2*b)]}
  gravity: g
statement: A bead of mass <<m>> on a wire, bent to $y = x^2/(2b)$ with <<b>> < 1 m & more; it falls with <<g>>.
parts:
  - ask: Find the equation of motion.
    answer: equations_of_motion
    points: 2
  - ask: Find the angular frequency.
    answer: frequency
    points: 3
    form: {unit: rad/s, figures: 4}
  - ask: Find the frequency and the period.
    answer: [frequency, period]
    points: 4
    form: {period: {unit: s, figures: 2}, frequency: {unit: rad/s, figures: 4}}
"""


def with_week1(root: Path) -> Path:
    """Write a set `week1` with one problem and return its folder."""
    folder = root / "problems" / "week1"
    folder.mkdir(parents=True)
    (folder / "bead.yaml").write_text(PROBLEM)
    (folder / "set.yaml").write_text("course: A\ntitle: B\nproblems: [bead]\n")
    return folder


@pytest.fixture(scope="module")
def questions(tmp_path_factory: pytest.TempPathFactory) -> list[Question]:
    root = tmp_path_factory.mktemp("course")
    with_week1(root)
    return questions_of([rendered(root, "week1/bead", draws=True, only=("questions",))])


def test_the_solution_of_a_part_shows_the_equations_that_it_cites(questions: list[Question]) -> None:
    """A platform shows each part separately."""
    (question,) = questions
    for part in question.parts:
        cited = set(re.findall(r"(?<!text\{)\((\d+)\)", part.solution))
        assert cited <= set(re.findall(r"\\text\{\((\d+[a-z]?)\)\}", part.feedback))
    first, second, _ = question.parts
    assert first.cited == ""
    assert second.cited.startswith("<p>Part (a) has already given equation (5).</p>")
    assert r"\boxed" not in second.cited
    assert second.cited in ElementTree.fromstring(moodle_xml("A", "B", questions)).findall("question")[2].findtext(
        "generalfeedback/text", ""
    )


def test_moodle_has_a_question_of_the_right_type_for_each_part(questions: list[Question]) -> None:
    quiz = ElementTree.fromstring(moodle_xml("Physics/A", "Week <1>", questions).encode())
    category, *asked = quiz
    assert category.findtext("category/text") == "$course$/top/Physics//A/Week <1>"
    assert [each.get("type") for each in asked] == ["essay", "numerical", "cloze"]
    assert asked[0].findtext("name/text") == "1 (a) A bead & a <wire>"
    assert [each.findtext("defaultgrade") for each in asked] == ["2", "3", None]
    answer = asked[1].find("answer")
    assert answer is not None
    assert (answer.get("fraction"), answer.findtext("text"), answer.findtext("tolerance")) == ("100", "7.004", "0.0005")
    assert (asked[1].find("units"), asked[1].findtext("showunits")) == (None, "3"), "the number is typed without a unit"
    assert "= ?, in rad/s</p>" in (asked[1].findtext("questiontext/text") or "")
    cloze = asked[2].findtext("questiontext/text") or ""
    assert "{2:NUMERICAL:=7.004:0.0005} rad/s" in cloze
    assert "{2:NUMERICAL:=0.9:0.005} s" in cloze
    for each in asked:
        text = each.findtext("questiontext/text") or ""
        assert "&lt; 1\xa0m &amp; more" in text, "the text is HTML"
        assert r"\(" in text
        assert r"\[" in (each.findtext("generalfeedback/text") or "") or each is asked[2]
        (file,) = each.findall("questiontext/file")
        assert f'src="@@PLUGINFILE@@/{file.get("name")}"' in text
        assert b64decode(file.text or "") == questions[0].files[file.get("name") or ""]


def test_the_numerical_answer_is_that_of_the_formula(questions: list[Question]) -> None:
    """sqrt(9.81/0.2) = 7.00357, and 2 pi/7.00357 = 0.89714, worked out by hand."""
    values = {(part.label, each.key): each.value for part in questions[0].parts for each in part.answers}
    assert values["b", "frequency"] == 7.004
    assert values["c", "period"] == 0.9


@pytest.mark.parametrize(
    ("value", "figures", "tolerance"),
    [
        (7.0, 3, 0.005),
        (0.9, 2, 0.005),
        (123.4, 4, 0.05),
        (-123.4, 4, 0.05),
        (1e-5, 3, 0.5e-7),
        (12300.0, 3, 50.0),
        (0.0, 3, 0.0),
    ],
)
def test_the_tolerance_is_half_a_unit_of_the_last_figure(value: float, figures: int, tolerance: float) -> None:
    assert Answer("", "", "", "", value, "", figures).tolerance == pytest.approx(tolerance)


def test_a_package_of_qti_is_complete(questions: list[Question]) -> None:
    content = qti_package("week1", "Week <1>", questions)
    assert content == qti_package("week1", "Week <1>", questions)
    with zipfile.ZipFile(io.BytesIO(content)) as package:
        files = {name: package.read(name) for name in package.namelist()}
    manifest = ElementTree.fromstring(files["imsmanifest.xml"])
    listed = {each.get("href") for each in manifest.iter(f"{{{PACKAGE}}}file")}
    assert listed == files.keys() - {"imsmanifest.xml"}
    items = [ElementTree.fromstring(files[name]) for name in sorted(files) if name.startswith("Q")]
    test = ElementTree.fromstring(files["test.xml"])
    assert {each.get("href") for each in test.iter(f"{{{QTI}}}assessmentItemRef")} == {n for n in files if n[0] == "Q"}
    fields = [len(list(item.iter(f"{{{QTI}}}textEntryInteraction"))) for item in items]
    assert fields == [0, 1, 2]
    for item, number in zip(items, fields, strict=True):
        values = [each.text for each in item.iter(f"{{{QTI}}}value")]
        equal = list(item.iter(f"{{{QTI}}}equal"))
        assert len(equal) == number
        for image in item.iter(f"{{{QTI}}}img"):
            assert image.get("src") in files
        if number == 2:
            assert "7.004" in values and "0.9" in values
            assert [each.get("tolerance") for each in equal] == ["0.0005 0.0005", "0.005 0.005"]
            added = [each.text for each in item.iter(f"{{{QTI}}}baseValue") if each.get("baseType") == "float"]
            assert added == ["2", "2"], "the four points are shared"


def test_a_package_of_canvas_has_a_question_for_each_number_of_a_part(questions: list[Question]) -> None:
    content = canvas_package("week1", "Week <1>", questions)
    assert content == canvas_package("week1", "Week <1>", questions)
    with zipfile.ZipFile(io.BytesIO(content)) as package:
        files = {name: package.read(name) for name in package.namelist()}
    manifest = ElementTree.fromstring(files["imsmanifest.xml"])
    listed = {each.get("href") for each in manifest.iter(f"{{{CANVAS_PACKAGE}}}file")}
    assert listed == files.keys() - {"imsmanifest.xml"}
    (quiz,) = [name for name in files if name.endswith(".xml") and "/" in name and "meta" not in name]
    items = list(ElementTree.fromstring(files[quiz]).iter(f"{{{QTI_1}}}item"))
    assert [item.get("title", "").partition(" A bead")[0] for item in items] == ["1 (a)", "1 (b)", "1 (c)", "1 (c)"]
    assert len({item.get("ident") for item in items}) == 4
    entries = [[each.text for each in item.iter(f"{{{QTI_1}}}fieldentry")] for item in items]
    number = "numerical_question"
    assert entries == [["essay_question", "2"], [number, "3"], [number, "2"], [number, "2"]]
    assert b"<points_possible>9</points_possible>" in files[quiz.replace(quiz.partition("/")[2], "assessment_meta.xml")]
    ranges = [
        [each.text for tag in ("varequal", "vargte", "varlte") for each in item.iter(f"{{{QTI_1}}}{tag}")]
        for item in items
    ]
    assert ranges == [[], *[["7.004", "7.0035", "7.0045"]] * 2, ["0.9", "0.895", "0.905"]]
    for item in items:
        body, solution = (each.text or "" for each in item.iter(f"{{{QTI_1}}}mattext"))
        assert "&lt; 1\xa0m &amp; more" in body and r"\(" in body and r"\[" in solution
        for address in re.findall(r'src="%24IMS-CC-FILEBASE%24/(.*?)"', body):
            assert address in files
    assert ", in rad/s</p>" in ElementTree.tostring(items[1], "unicode").replace("&lt;", "<").replace("&gt;", ">")


def test_hostile_titles_stay_text(questions: list[Question]) -> None:
    evil = [replace(questions[0], title=']]><script>"&amp;</name>')]
    quiz = ElementTree.fromstring(moodle_xml("A", "B", evil).encode())
    assert not list(quiz.iter("script"))
    with zipfile.ZipFile(io.BytesIO(qti_package("w", '"><x>', evil))) as package:
        for name in package.namelist():
            if name.endswith(".xml"):
                assert not list(ElementTree.fromstring(package.read(name)).iter(f"{{{QTI}}}x"))


def test_the_command_writes_the_file(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = with_week1(tmp_path)
    assert main(["--root", str(tmp_path), "export", "week1", "--format", "qti"]) == 0
    assert zipfile.is_zipfile(tmp_path / "build" / "week1" / "week1-qti.zip")
    why = ["--root", str(tmp_path), "why", str(tmp_path / "build" / "week1" / "week1-qti.zip")]
    capfd.readouterr()
    assert main(why) == 0 and capfd.readouterr().out.endswith("week1-qti.zip is up to date\n")
    with monkeypatch.context() as patch:
        patch.setattr(solution, "derived", lambda *_: pytest.fail("the first export has kept the steps"))
        assert main(["--root", str(tmp_path), "export", "week1", "--format", "canvas"]) == 0
    (folder / "bead.yaml").write_text(PROBLEM.replace("Find the frequency and", "Find both the frequency and"))
    assert main(why) == 0 and "`problems/week1/bead.yaml` has changed" in capfd.readouterr().out
    assert main(["--root", str(tmp_path), "export", "week1/bead", "-o", "-"]) == 0
    assert "<quiz>" in capfd.readouterr().out
    assert main(["--root", str(tmp_path), "export", "week2"]) == 2


def test_every_formula_and_drawing_arrives_in_a_document_of_word(questions: list[Question]) -> None:
    content = word_document("Week <1>", questions)
    with zipfile.ZipFile(io.BytesIO(content)) as package:
        text = package.read("word/document.xml").decode()
        pictures = [name for name in package.namelist() if name.endswith(".png")]
    (question,) = questions
    html = [question.statement, question.remarks, *(part.question + part.solution for part in question.parts)]
    displays, inline = (sum(each.count(sign) for each in html) for sign in (r"\[", r"\("))
    assert displays > 5 and inline > 5
    assert text.count("<m:oMathPara>") == displays
    assert text.count("<m:oMath>") == displays + inline
    assert text.count("<pic:pic") == len(pictures) == len(question.files) == 1
    width = int(re.findall(r'<wp:extent cx="(\d+)"', text)[0]) / 12700  # in points
    drawn = re.findall(r'width="([\d.]+)pt"', question.files["bead-system.svg"].decode())[0]
    assert width == pytest.approx(float(drawn), abs=0.1)
    assert "Week &lt;1&gt;" in text
    sheet = zipfile.ZipFile(io.BytesIO(word_document("Week 1", questions, solutions=False)))
    assert "<m:oMathPara>" not in sheet.read("word/document.xml").decode()


def test_a_formula_that_pandoc_cannot_read_is_an_error(questions: list[Question]) -> None:
    wrong = replace(questions[0], statement=r"<p>\(\nosuchcommand{a\)</p>")
    with pytest.raises(BuildFailed, match="nosuchcommand"):
        word_document("Week 1", [wrong])


def test_a_missing_converter_is_named_before_anything_is_derived(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    (with_week1(tmp_path) / "bead.yaml").write_text("a file that would be an error")
    monkeypatch.setitem(sys.modules, "pypandoc", None)
    monkeypatch.setenv("PATH", str(tmp_path))
    command = ["--root", str(tmp_path), "export", "week1", "--format", "docx"]
    for missing in ("Pandoc is not installed", "no converter of drawings is installed"):
        assert main(command) == 2
        shown = capfd.readouterr().err
        assert missing in shown and "derive-mechanics[docx]" in shown
        monkeypatch.setitem(sys.modules, "resvg_py", None)


def test_a_folder_of_prairielearn_has_its_three_files_and_right_answers(questions: list[Question]) -> None:
    content = prairielearn_package("week1", "Week 1", questions)
    assert content == prairielearn_package("week1", "Week 1", questions)
    with zipfile.ZipFile(io.BytesIO(content)) as package:
        files = {name: package.read(name) for name in package.namelist()}
    folders = {name.split("/")[2] for name in files}
    assert folders == {"bead-a", "bead-b", "bead-c"}
    ids = set()
    for folder in folders:
        of = {name.split("/", 3)[3]: text for name, text in files.items() if name.split("/")[2] == folder}
        assert {"info.json", "question.html", "server.py", "clientFilesQuestion/bead-system.svg"} == of.keys()
        info, page = json.loads(of["info.json"]), of["question.html"].decode()
        ids.add(info["uuid"])
        tags = set(re.findall(r"\{\{[^}]*\}\}", page))
        assert tags == {"{{ options.client_files_question_url }}"}, "no formula has a tag of Mustache"
        data: dict[str, dict[str, object]] = {"correct_answers": {}}
        names: dict[str, object] = {}
        exec(compile(of["server.py"], folder, "exec"), names)  # noqa: S102  the file that was just written
        names["generate"](data)  # type: ignore[operator]
        asked = re.findall(r'answers-name="(\w+)"', page)
        assert asked == list(data["correct_answers"])
        assert ("pl-symbolic-input" in page) == (folder == "bead-a") and "gradingMethod" not in info
        if folder == "bead-c":
            assert data["correct_answers"] == {"answer1": 7.004, "answer2": 0.9}
            assert 'digits="2" suffix="s"' in page
    assert len(ids) == 3


@pytest.mark.parametrize("formula", ["", "e*x", "lambda*x"])
def test_a_formula_that_prairielearn_cannot_compare_is_graded_by_a_person(
    questions: list[Question], formula: str
) -> None:
    (question,), (first, *_) = questions, questions[0].parts
    changed = replace(first, answers=(replace(first.answers[0], sympy=formula),))
    content = prairielearn_package("week1", "Week 1", [replace(question, parts=(changed,))])
    with zipfile.ZipFile(io.BytesIO(content)) as package:
        info, page = (package.read(f"questions/week1/bead-a/{file}") for file in ("info.json", "question.html"))
    assert json.loads(info)["gradingMethod"] == "Manual" and b"<pl-rich-text-editor " in page


@pytest.mark.parametrize(
    ("formula", "letters"),
    [
        ("sqrt(g/b)", {"g", "b"}),
        ("2*pi*sqrt(b)/sqrt(g)", {"b", "g"}),
        ("M*a**2*omega**2*sin(2*theta)/4", {"M", "a", "omega", "theta"}),
        ("m*v*(1 - e)", None),
        ("Eq(a, b)", None),
        ("f(t)*a", None),
        ("x + 0.5", None),
        ("m*theta_dot**2 + t", {"m", "theta_dot", "t"}),
        ("x.y__class__[0]", None),
        ("3/4", None),
    ],
)
def test_only_plain_formulas_have_a_field_for_symbols(formula: str, letters: set[str] | None) -> None:
    assert Answer("", "", formula, "", None, "", None).letters == letters


def test_a_formula_in_letters_is_a_question_of_stack(questions: list[Question]) -> None:
    first, *_ = questions[0].parts
    formulas = (
        Answer("frequency", r"\omega_0", "sqrt(g/b)", r"\sqrt{g/b}", None, "rad/s", None, frozenset("gb")),
        Answer("period", r"\tau", "2*pi*sqrt(b)/sqrt(g)**3", "", None, "s", None, frozenset("gb")),
    )
    changed = replace(questions[0], parts=(replace(first, answers=formulas), *questions[0].parts))
    quiz = ElementTree.fromstring(moodle_xml("A", "B", [changed], stack=True).encode())
    _, stack, *others = quiz
    assert [each.get("type") for each in (stack, *others)] == ["stack", "stack", "numerical", "cloze"]
    assert stack.findtext("questionvariables/text") == (
        "assume(b>0, g>0);\nta1: sqrt(g/b);\nta2: 2*%pi*sqrt(b)/sqrt(g)^3;"
    )
    text = stack.findtext("questiontext/text") or ""
    for number in (1, 2):
        assert f"[[input:ans{number}]] [[validation:ans{number}]]" in text
        assert f"[[feedback:prt{number}]]" in (stack.findtext("specificfeedback/text") or "")
    assert [each.findtext("tans") for each in stack.findall("input")] == ["ta1", "ta2"]
    trees = stack.findall("prt")
    assert [each.findtext("node/answertest") for each in trees] == ["AlgEquiv"] * 2
    assert sum(float(each.findtext("value") or 0) for each in trees) == pytest.approx(1)
    assert [(each.findtext("node/truescore"), each.findtext("node/falsescore")) for each in trees] == [("1", "0")] * 2
    assert stack.findtext("assumepositive") == "0", "sqrt(x^2) is not x for a coordinate x"


def test_an_export_for_stack_without_a_formula_says_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = with_week1(tmp_path)
    of_motion = PROBLEM[PROBLEM.index("  - ask: Find the equation") : PROBLEM.index("  - ask: Find the angular")]
    (folder / "bead.yaml").write_text(PROBLEM.replace(of_motion, ""))
    assert main(["--root", str(tmp_path), "export", "week1", "--format", "stack"]) == 0
    assert "no part has only answers that STACK can compare" in capsys.readouterr().out


def test_a_formula_with_a_defined_quantity_is_compared_in_the_letters_of_the_problem(tmp_path: Path) -> None:
    folder = with_week1(tmp_path)
    changed = "".join(line for line in PROBLEM.splitlines(True) if "values:" not in line and "form:" not in line)
    (folder / "bead.yaml").write_text(changed.replace("given:\n", "define: {kappa: g/b}\ngiven:\n"))
    asked = questions_of([rendered(tmp_path, "week1/bead", draws=True, only=("questions",))])
    quiz = ElementTree.fromstring(moodle_xml("A", "B", asked, stack=True).encode())
    stack = quiz[2]
    assert r"\sqrt{\kappa}" in (stack.findtext("generalfeedback/text") or ""), "the page has the defined quantity"
    assert stack.findtext("questionvariables/text") == "assume(b>0, g>0);\nta1: sqrt(g)/sqrt(b);"
    assert stack.findtext("input/allowwords") == "x_ddot, x_dot, kappa"
    assert stack.findtext("prt/feedbackvariables/text") == "sa1: subst([kappa=g/b], ans1);"
    assert stack.findtext("prt/node/sans") == "sa1"
    package = zipfile.ZipFile(io.BytesIO(prairielearn_package("week1", "A", asked)))
    assert 'variables="b, g, m, x, x_ddot, x_dot"' in package.read("questions/week1/bead-b/question.html").decode()


def test_a_formula_with_rates_and_a_solved_equation_of_motion_are_compared(tmp_path: Path) -> None:
    """The formulas are worked out by hand; SymPy reads the exported texts."""
    folder = with_week1(tmp_path)
    changed = PROBLEM.replace("answer: equations_of_motion", "answer: [lagrangian, equations_of_motion]")
    (folder / "bead.yaml").write_text(changed)
    (question,) = questions_of([rendered(tmp_path, "week1/bead", draws=True, only=("questions",))])
    first, second = question.parts[0].answers
    m, g, b, x, v = symbols("m g b x x_dot")
    slope = 1 + x**2 / b**2
    assert simplify(sympify(first.sympy) - m * slope * v**2 / 2 + m * g * x**2 / (2 * b)) == 0
    assert simplify(sympify(second.sympy) + (g * x / b + x * v**2 / b**2) / slope) == 0
    assert (second.symbol, second.letters) == (r"\ddot{x}", {"g", "b", "x", "x_dot"})
    assert first.positive == {"m", "g", "b"}
    quiz = ElementTree.fromstring(moodle_xml("A", "B", [question], stack=True).encode())
    assert quiz[1].get("type") == "stack"
    text = quiz[1].findtext("questiontext/text") or ""
    assert r"x_dot for \(\dot{x}\)" in text and r"\(\ddot{x}\) = [[input:ans2]]" in text
    assert "x_dot" in (quiz[1].findtext("input/allowwords") or "").split(", ")
    package = zipfile.ZipFile(io.BytesIO(prairielearn_package("week1", "A", [question])))
    names: dict[str, Any] = {}
    exec(package.read("questions/week1/bead-a/server.py"), names)  # noqa: S102  the file that was just written
    names["generate"](data := {"correct_answers": {}})
    answer = data["correct_answers"]["answer1"]
    assert answer["_assumptions"]["b"] == {"positive": True} and answer["_assumptions"]["x_dot"] == {"real": True}
    assert r"x_dot for \(\dot{x}\)" in package.read("questions/week1/bead-a/question.html").decode()


def test_an_equation_with_an_unknown_force_is_not_compared() -> None:
    """With the tension S in it, the acceleration has several right forms."""
    (question,) = questions_of([rendered(ROOT, "library/atwood", only=("questions",))])
    forms = [each.sympy for each in question.parts[0].answers]
    assert len(forms) >= 2 and set(forms) == {""}
    assert question.parts[1].answers[0].sympy


PLATE = """\
title: A plate
solve: rotation
symbols: {m: mass, a: length, omega: angular speed}
given:
  body: {shape: plate, sides: [a, 2*a], mass: m}
  rate: omega
  along: [1, 2, 0]
statement: A plate <<a>>, <<m>>, <<omega>>.
parts: [{ask: Find the angular momentum., answer: angular_momentum, points: 3}]
"""


@pytest.mark.parametrize("values", ["", "values: {a: 20 cm, m: 2 kg, omega: 30 rad/s}\n"])
def test_a_vector_has_a_field_for_each_component(tmp_path: Path, values: str) -> None:
    folder = with_week1(tmp_path)
    (folder / "bead.yaml").write_text(PLATE + values)
    asked = questions_of([rendered(tmp_path, "week1/bead", only=("questions",))])
    (part,) = asked[0].parts
    fields = [(each.key, each.symbol) for each in part.answers]
    assert fields == [(f"angular_momentum_{n}", rf"(\bm{{L}})_{{{n}}}") for n in (1, 2, 3)]
    quiz = ElementTree.fromstring(moodle_xml("A", "B", asked, stack=True).encode())
    package = zipfile.ZipFile(io.BytesIO(prairielearn_package("week1", "A", asked)))
    page, server = (package.read(f"questions/week1/bead-a/{file}").decode() for file in ("question.html", "server.py"))
    if values:
        assert [each.value for each in part.answers] == [0.3578, 0.1789, 0.0], "2 a^2 m omega/(6 sqrt(5)) by hand"
        assert [each.get("type") for each in quiz][1:] == ["cloze"]
        assert "{1:NUMERICAL:=0.3578:5e-05} kg m^2/s" in (quiz[1].findtext("questiontext/text") or "")
        assert page.count("<pl-number-input") == 3 and '["answer3"] = 0.0' in server
    else:
        assert [each.get("type") for each in quiz][1:] == ["stack"]
        told = quiz[1].findtext("questionvariables/text") or ""
        assert told.splitlines()[1::2] == ["ta1: sqrt(5)*a^2*m*omega/15;", "ta3: 0;"]
        assert page.count("<pl-symbolic-input") == page.count('variables="a, m, omega"') == 3


def test_a_coordinate_is_not_among_the_positive_letters(questions: list[Question]) -> None:
    positive = {each.key: each.positive for part in questions[0].parts for each in part.answers}
    assert positive == {"motion_x": {"b", "g"}, "frequency": {"b", "g"}, "period": {"b", "g"}}


@pytest.mark.parametrize(
    ("points", "marks"), [(4.0, [2, 2]), (3.0, [2, 1]), (2.0, [1, 1]), (1.0, [1, 1]), (2.5, [1, 1]), (None, [1, 1])]
)
def test_the_marks_of_moodle_are_whole_and_their_sum_is_that_of_the_points(
    questions: list[Question], points: float | None, marks: list[int]
) -> None:
    assert _marks(replace(questions[0].parts[2], points=points)) == marks


def test_the_elements_of_prairielearn_have_closing_tags(questions: list[Question]) -> None:
    with zipfile.ZipFile(io.BytesIO(prairielearn_package("week1", "A", questions))) as package:
        pages = [package.read(name).decode() for name in package.namelist() if name.endswith("question.html")]
    for tag in ("pl-number-input", "pl-rich-text-editor", "pl-symbolic-input"):
        opened, closed = (sum(page.count(mark) for page in pages) for mark in (f"<{tag} ", f"></{tag}>"))
        assert opened == closed
