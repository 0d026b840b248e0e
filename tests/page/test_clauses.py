"""Tests of clauses that define symbols after the lines in which the symbols appear."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.solution import rendered
from derive.page.clauses import Clauses
from derive.page.template import templates_of
from derive.page.wording import Inline, Math, Text, phrases
from derive.steps.step import Step
from tests.courses import ROOT, course_in, solved_once
from tests.stock.described import course_with

WORDS = phrases(templates_of(ROOT))


@pytest.fixture(scope="module")
def density(tmp_path_factory: pytest.TempPathFactory) -> Step:
    _, solved = solved_once(course_in(tmp_path_factory.mktemp("block")), "hw9/block")
    return solved.derivation.step("density")


def written(nodes: tuple[Inline, ...]) -> str:
    return "".join(node.text if isinstance(node, Text) else str(getattr(node, "expr", "")) for node in nodes)


def test_it_waits_for_the_lines_that_have_its_letter_and_is_told_once(density: Step) -> None:
    clauses = Clauses(WORDS)
    clauses.waiting.append(density)
    assert clauses.behind((Math(density.result),)) == ()
    assert clauses.told == set()
    assert written(clauses.behind((Math(density.symbol),))).startswith("where rho = ")
    assert clauses.told == {density.key}
    assert clauses.behind((Math(density.symbol),)) == ()


def test_a_sentence_that_goes_on_from_the_lines_comes_first(density: Step) -> None:
    for sentence, order in (("so that it turns.", 1), ("It turns.", -1)):
        clauses = Clauses(WORDS)
        clauses.waiting.append(density)
        text = written(clauses.around((Text(sentence),), (Math(density.symbol),)))
        assert (text.index("rho") - text.index(sentence)) * order > 0
    assert written(Clauses(WORDS).around((Text("It turns."),), (Math(density.symbol),))) == "It turns."


def test_what_the_lines_say_themselves_is_not_said_again(density: Step) -> None:
    clauses = Clauses(WORDS)
    clauses.waiting.append(density)
    assert clauses.behind((Math(density.symbol), Math(density.result))) == ()
    assert clauses.told == {density.key}


def test_what_is_set_up_is_said_before_the_next_sentence_once() -> None:
    clauses = Clauses(WORDS)
    assert clauses.begun() == ()
    clauses.set_up.append(Text("Take axes."))
    assert written(clauses.begun()) == "Take axes. "
    assert clauses.begun() == ()


def test_each_clause_has_its_definition_or_points_to_one() -> None:
    for rule, outcomes in WORDS.clauses.items():
        for outcome, phrase in outcomes.items():
            assert "<<definition>>" in phrase or "<<shown>>" in phrase, (rule, outcome)
            assert outcome in WORDS.rules[rule]
    assert Path(ROOT / "templates" / "phrases").is_dir()


ROD = """\
title: A rod as a pendulum
solve: system
symbols: {m: mass, l: length, g: acceleration}
given:
  coordinates: {theta: angle}
  bodies: {rod: {shape: rod, length: l, mass: m, from: [0, 0], along: [sin(theta), -cos(theta)]}}
  gravity: g
statement: A rod.
show: {moment_of_inertia: hidden}
parts:
  - ask: Find the kinetic energy.
    answer: kinetic_energy
"""


@pytest.mark.parametrize("detail", ["brief", "standard", "full"])
def test_the_symbol_of_a_hidden_step_is_defined_where_it_is_used(tmp_path: Path, detail: str) -> None:
    text = rendered(course_with(tmp_path, ROD), "trial/one", detail, only={"text"}).texts["text"]
    assert "where I = 1/3 m l²." in text


def test_a_symbol_that_the_author_introduces_is_not_defined_again(tmp_path: Path) -> None:
    told = ROD + "wording: {kinetic_energy: 'With $I = ml^2/3$ about its end, <<chain>>'}\n"
    text = rendered(course_with(tmp_path, told), "trial/one", only={"text"}).texts["text"]
    assert "With I = m l²/3 about its end," in text and "where I" not in text


THIN_ROD = """\
title: A rod on a shaft
solve: rotation
symbols: {l: length, M: mass, alpha: angle, omega: angular speed}
given:
  body: {shape: rod, length: l, mass: M}
  rate: omega
  along: [sin(alpha), 0, cos(alpha)]
statement: A rod.
show: {inertia_tensor_definition: hidden}
parts:
  - ask: Find the torque.
    answer: torque
"""


@pytest.mark.parametrize("detail", ["brief", "standard"])
def test_if_the_first_step_with_a_symbol_is_hidden_another_one_introduces_it(tmp_path: Path, detail: str) -> None:
    text = rendered(course_with(tmp_path, THIN_ROD), "trial/one", detail, only={"text"}).texts["text"]
    assert "I⃡ = 1/12 M l²" in text


def test_a_moment_without_a_step_has_the_symbol_of_an_equal_moment(tmp_path: Path) -> None:
    text = rendered(course_with(tmp_path, THIN_ROD), "trial/one", "full", only={"text"}).texts["text"]
    assert "((I_zz - I_xx) ω_y ω_z, (I_xx - I_zz) ω_z ω_x, 0)" in text


def test_a_hidden_tensor_is_defined_by_its_meaning(tmp_path: Path) -> None:
    hidden = THIN_ROD.replace("definition: hidden}", "definition: hidden, inertia_tensor: hidden}")
    text = rendered(course_with(tmp_path, hidden), "trial/one", only={"text"}).texts["text"]
    assert "I⃡ is the inertia tensor about the centre" in " ".join(text.split())
