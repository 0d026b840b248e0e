"""Formulas in prose use the symbols of the page, appear in every format, and are rejected if they are wrong."""

from __future__ import annotations

import random
from dataclasses import replace
from pathlib import Path

import pytest
from sympy import MatrixSymbol, Symbol

from derive.algebra.kinds import dimension_of_kind
from derive.building.derivations import Solved
from derive.building.solution import rendered
from derive.course.latex.vocabulary import KNOWN, ONLY_PRINTED
from derive.course.problem import Problem, load_problem
from derive.course.prose import TexFormula
from derive.course.transcript import Transcript
from derive.course.yaml_tree import Scalar, Source
from derive.errors import Complaint, DeriveError
from derive.page.document import document_of
from derive.page.formulas import Formulas
from derive.page.hints import with_hints
from derive.page.template import templates_of
from derive.page.tree import Document, Folded, Paragraph
from derive.page.wording import Math, Text, phrases
from derive.render.notation.latex import latex
from derive.render.notation.layout import Upright
from derive.render.notation.mathml import mathml
from derive.render.notation.notation import Notation
from derive.render.notation.text import in_one_line
from derive.render.printing.text_page import inline_text
from derive.steps.step import Level
from tests.courses import ROOT, course_in, rendered_once, solved_once
from tests.stock.described import course_with, edited

WORDS = phrases(templates_of(ROOT))
TOP = load_problem(ROOT, "hw9/top")
FORCE = Symbol("N", real=True)  # a constraint force, whose dimension is unknown
KNOWN_HERE = {
    **TOP.dimensions,
    FORCE: None,
    MatrixSymbol("L", 3, 1): dimension_of_kind("angular momentum"),
    Symbol("theta", real=True): dimension_of_kind("angle"),
    Symbol("z_C", real=True): dimension_of_kind("length"),
}


def formula(tex: str) -> TexFormula:
    return TexFormula(Scalar(tex, "", 0, len(tex), Source("p.yaml", tex)))


def read(tex: str) -> tuple[str, str, list[Complaint], list[Complaint]]:
    """Return a formula in TeX and as text, its errors and its warnings."""
    formulas = Formulas(TOP, KNOWN_HERE)
    node = formulas.node(formula(tex))
    layout = Notation(KNOWN_HERE).result(node.expr) if isinstance(node, Math) else Upright(node.text)
    return latex(layout, inline=True), in_one_line(layout), [*formulas.faults], [*formulas.warnings]


@pytest.mark.parametrize(
    ("tex", "printed", "text"),
    [
        (r"z_C = a^2/(2a)", r"z_{C}=a^{2}/(2a)", "z_C = a²/(2a)"),
        (r"\frac12 m a^2\dot\theta^2", r"\tfrac{1}{2}\,ma^{2}\dot{\theta}^{2}", "1/2 m a² (θ̇)²"),
        (r"a", "a", "a"),
        (r"\vec{L}", r"\bm{L}", "L⃗"),
        (r"\vartheta", r"\theta", "θ"),
        (r"U(\theta) = mga\cos\theta", r"U(\theta)=mga\cos \theta", "U(θ) = m g a cos θ"),
        (r"a \ll \frac{g}{S^2}", r"a\ll g/S^{2}", "a ≪ g/S²"),
        (r"S \to \infty", r"S\to \infty", "S → ∞"),
        (r"\theta = 45^\circ", r"\theta=45\mathrm{{}^\circ}", "θ = 45°"),
        (r"m = 2\,\mathrm{kg}", r"m=2\,\mathrm{kg}", "m = 2 kg"),
        (r"g = 9.8\,\text{m/s}^2", r"g=9.8\,\mathrm{m/s}^{2}", "g = 9.8 m/s²"),
        (r"g = 9.8\,\mathrm{m\,s^{-2}}", r"g=9.8\,\mathrm{m\,s^{-2}}", "g = 9.8 m s^-2"),
        (r"N = mg", r"N=mg", "N = m g"),
        (r"\sqrt[3]{a^3}", r"\sqrt[3]{a^{3}}", "³√(a³)"),
    ],
)
def test_a_formula_is_read_and_printed_as_it_is_written(tex: str, printed: str, text: str) -> None:
    found_tex, found_text, faults, warnings = read(tex)
    assert (faults, warnings) == ([], [])
    assert (found_tex.strip(), found_text) == (printed, text)


@pytest.mark.parametrize(
    ("tex", "code", "message", "column"),
    [
        (r"a = R", "undeclared-symbol", "`R` is not declared", 5),
        (r"z_C = a^3/m", "dimension", "`z_C` is a length, but `a^3/m` is ", 7),
        (r"z_C + m", "dimension", "`z_C` is a length, but `m` is a mass: they cannot be added", 7),
        (r"a = 5", "dimension", "`a` is a length, but `5` is a number: they cannot be compared", 5),
        (r"a = 11\,\mathrm{cm}", "wrong-number", r"`a` is 10 cm, so it is not `11\,\mathrm{cm}`", 5),
        (r"a\omegaa", "formula-in-prose", r"`\omegaa` is not known", 2),
        (r"\input{x}", "formula-in-prose", r"`\input` is not known", 1),
        (r"\def\x{a}", "formula-in-prose", r"`\def` is not known", 1),
        ("a^{2", "formula-in-prose", "", 1),
        ("α", "formula-in-prose", "`α` ", 1),
    ],
)
def test_a_wrong_formula_is_an_error_at_its_place(tex: str, code: str, message: str, column: int) -> None:
    (fault, *more), warnings = read(tex)[2:]
    assert (more, warnings) == ([], [])
    assert fault.place is not None
    assert (fault.code, fault.place.column, fault.severity) == (code, column, "error")
    assert fault.message.startswith(message)


@pytest.mark.parametrize(
    ("tex", "printed"),
    [
        (r"\sum_i m_i", r"\sum _{i}m_{i}"),
        ("a/2m", "a/2m"),
        (r"\frac{d}{dt}(m a)", r"\tfrac{d}{dt}\,(ma)"),
        (r"a\,dm", "adm"),
        (r"m \propto a", r"m\propto a"),
        (r"\bar{a}_{\theta}", r"\bar{a}_{\theta}"),
    ],
)
def test_what_cannot_be_read_but_is_harmless_is_printed_with_a_warning(tex: str, printed: str) -> None:
    found, _, faults, (warning,) = read(tex)
    assert (found, faults) == (printed, [])
    assert (warning.code, warning.severity) == ("unread-formula", "warning")
    assert warning.message.startswith("this formula is printed, but its letters and dimensions are not checked: ")


def test_whatever_stands_between_dollar_signs_is_printed_or_refused() -> None:
    chosen = random.Random(28)
    commands = [f"\\{name} " for name in sorted(KNOWN | ONLY_PRINTED)]
    signs = [*"amgSz019+-=^_()[]|{}&,./'!:;<>~*%#é", r"\\", r"\,", r"\input", r"\mathrm{m/s}", r"\frac{a}{m}"]
    printed = 0
    for _ in range(1500):
        formulas = Formulas(TOP, KNOWN_HERE)
        node = formulas.node(formula("".join(chosen.choices([*commands, *signs], k=chosen.randint(1, 7)))))
        assert isinstance(node, Text) == bool(formulas.faults)
        if isinstance(node, Math):
            printed += 1
            layout = Notation(KNOWN_HERE).result(node.expr)
            assert "input" not in latex(layout, inline=True)
            assert mathml(layout, inline=True).startswith("<math")
            assert "\\" not in in_one_line(layout)
    assert printed > 300


# --- on a page ---


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> tuple[Problem, Solved]:
    return solved_once(course_in(tmp_path_factory.mktemp("block")), "hw9/block")


def page(block: tuple[Problem, Solved], folder: Path, note: str) -> tuple[Document, list[Complaint]]:
    problem = load_problem(course_in(folder, {"parts:\n": f"note: {note}\nparts:\n"}), "hw9/block")
    solved = block[1]
    return document_of(problem, solved.derivation, solved.values, WORDS, Level.STANDARD, drawings=solved.drawings)


def test_a_note_may_have_formulas_with_results(block: tuple[Problem, Solved], tmp_path: Path) -> None:
    note = r"'About $\vec L$, $T = \frac12 I\omega^2$ and $x$, for $\$ '"
    document, faults = page(block, tmp_path, note.replace(r", for $\$", "").replace(r"$T = \frac12 I\omega^2$", "$T$"))
    assert faults == []
    assert inline_text(document.note, Notation()) == "About L⃗, T and x"
    assert document.warnings == ()


def test_errors_and_warnings_of_formulas_are_those_of_the_page(block: tuple[Problem, Solved], tmp_path: Path) -> None:
    document, faults = page(block, tmp_path, r"'About $M = a$ and $\sum_i M$'")
    assert [fault.code for fault in faults] == ["dimension"]
    assert [warning.code for warning in document.warnings] == ["unread-formula"]


def test_a_hint_does_not_show_a_formula_that_is_an_answer(block: tuple[Problem, Solved]) -> None:
    problem, solved = block
    energy = solved.derivation.answering(problem.parts[1].answers)[0].result
    document, _ = document_of(problem, solved.derivation, solved.values, WORDS, Level.STANDARD)
    plain = with_hints(document, problem, solved.derivation, solved.values, WORDS)
    assert energy not in _values(plain)
    (part,) = [part for part in document.parts if part.label == "b"]
    blocks = tuple(
        replace(block, nodes=(*block.nodes, _written(energy))) if isinstance(block, Paragraph) else block
        for block in part.blocks
    )
    told = replace(document, parts=tuple(replace(p, blocks=blocks) if p is part else p for p in document.parts))
    assert energy not in _values(with_hints(told, problem, solved.derivation, solved.values, WORDS))


def _written(value: object) -> object:
    return Math(Transcript("T", [value]))


def _values(document: Document) -> list[object]:
    folded = [each for part in document.parts for each in part.blocks if isinstance(each, Folded)]
    nodes = [node for each in folded for block in each.blocks if isinstance(block, Paragraph) for node in block.nodes]
    return [v for node in nodes if isinstance(getattr(node, "expr", None), Transcript) for v in node.expr.values]


YOYO = (ROOT / "problems" / "library" / "rolling" / "yoyo.yaml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("edits", "said"),
    [
        ((), None),
        ((("shape: disc", "shape: hoop"),), r"`\ddot y = \frac{2}{3}g` is printed, but the page derives y_ddot = g/2"),
        (((r"\frac{2}{3}g", r"\frac{2}{3}g\cos\phi"),), None),  # a symbol that the result does not contain
    ],
)
def test_a_note_that_remained_while_the_problem_changed_is_reported(
    tmp_path: Path, edits: tuple[tuple[str, str], ...], said: str | None
) -> None:
    warnings = rendered(course_with(tmp_path, edited(YOYO, *edits)), "trial/one", only={"text"}).warnings
    messages = [each.message for each in warnings if each.code == "differs-from-result"]
    assert said in messages if said else not messages


def test_no_note_of_the_library_contradicts_its_page() -> None:
    for name in ("power_law", "yoyo", "driven_oscillator"):
        assert not rendered_once(ROOT, f"library/{name}", only={"text"}).warnings


MACHINE = (ROOT / "problems" / "library" / "constraints" / "atwood_disc.yaml").read_text(encoding="utf-8")


def test_an_equation_of_the_wording_that_remained_while_the_problem_changed_is_reported(tmp_path: Path) -> None:
    """The tensions of a disc differ by M x_ddot/2, those of a hoop by M x_ddot."""
    warnings = rendered(
        course_with(tmp_path, edited(MACHINE, ("shape: disc", "shape: hoop"))), "trial/one", only=()
    ).warnings
    said = [each.message for each in warnings if each.code == "differs-from-result"]
    typed = r"\frac{1}{2}M\ddot x = S_1 - S_2"
    assert f"`{typed}` is printed, but it does not hold for the results of the page" in said
    unchanged = rendered_once(ROOT, "library/atwood_disc", only=()).warnings
    assert not [each for each in unchanged if each.code == "differs-from-result"]


DOUBLE = """title: Two pendulums
solve: system
symbols: {m: mass, l: length, g: acceleration}
given:
  coordinates: {theta: angle, phi: angle}
  places: {A: [l*sin(theta), -l*cos(theta)], B: {from: A, by: [l*sin(phi), -l*cos(phi)]}}
  particles: {upper: {mass: m, at: A}, lower: {mass: m, at: B}}
  gravity: g
statement: A double pendulum.
note: The ratio is $\\omega_2/\\omega_1 = 1 + \\sqrt{2}$.
parts:
  - {ask: Find the modes., answer: normal_modes}
"""


def test_a_ratio_of_roots_of_sums_is_compared_at_trial_numbers(tmp_path: Path) -> None:
    assert not rendered(course_with(tmp_path, DOUBLE), "trial/one", only={"text"}).warnings
    condition = edited(DOUBLE, (r"\omega_2/\omega_1 = 1 + \sqrt{2}", r"\omega^2\omega_1 = \omega\omega_2^2"))
    assert not rendered(course_with(tmp_path / "condition", condition), "trial/one", only={"text"}).warnings
    wrong = edited(DOUBLE, ("1 + ", "2 + "))
    (warning,) = rendered(course_with(tmp_path / "wrong", wrong), "trial/one", only={"text"}).warnings
    assert warning.code == "differs-from-result"


CYLINDER = """\
title: A cylinder
solve: body
symbols: {a: length, h: length, m: mass}
given:
  body: {shape: cylinder, radius: a, height: h, mass: m}
  about: base
statement: A solid cylinder.
strategy: Cut it into rings of radius $r$.
wording:
  inertia_tensor: 'With $y = r\\sin\\phi$ and $r < a$, <<chain>>'
parts:
  - ask: Find the tensor.
    answer: inertia_tensor
"""
WORDING = r"With $y = r\sin\phi$ and $r < a$, <<chain>>"


def test_the_solution_may_mention_variables_of_integration(tmp_path: Path) -> None:
    page = rendered(course_with(tmp_path, CYLINDER), "trial/one", only={"text"})
    assert "Cut it into rings of radius r." in page.texts["text"]
    assert "With y = r sin φ and r < a," in page.texts["text"]
    assert not page.warnings


@pytest.mark.parametrize(
    ("edit", "code", "message"),
    [
        ((r"$r < a$", r"$r < m$"), "dimension", "`r` is a length, but `m` is a mass: they cannot be compared"),
        ((r"$r < a$", r"$\phi < a$"), "dimension", r"`\phi` is a number, but `a` is a length"),
        (("A solid cylinder.", r"Let $r < a$."), "undeclared-symbol", "`r` is not declared"),
        ((r"$r < a$", r"$s < a$"), "undeclared-symbol", "`s` is not declared"),
    ],
)
def test_a_variable_of_integration_has_its_dimension_and_belongs_to_the_solution(
    tmp_path: Path, edit: tuple[str, str], code: str, message: str
) -> None:
    with pytest.raises(DeriveError) as refused:
        rendered(course_with(tmp_path, edited(CYLINDER, edit)), "trial/one", only={"text"})
    assert [(each.code, message in each.message) for each in refused.value.complaints] == [(code, True)]
