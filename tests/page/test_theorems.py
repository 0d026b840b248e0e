"""A page states each theorem once, before the first step that uses it. A brief page does not state theorems."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
from sympy import Symbol, cos, sin, symbols

from derive.algebra.expressions import Relation
from derive.errors import Rejected
from derive.mechanics import Particle, System, constraint, coordinate, equation_of_motion, lagrangian, point, weight
from derive.page.template import templates_of
from derive.page.theorems import Theorems, standalone
from derive.page.tree import Folded, Paragraph, PartPage
from derive.page.wording import Math, Text, ToldIn, ToldOnce, phrases
from derive.steps.record import recorded
from derive.steps.rule import RULES, Quote, Theorem
from derive.steps.step import Level, Step
from tests.courses import ROOT
from tests.render.pages import WHOLE
from tests.rules import made_up, theorems

WORDS = phrases(templates_of(ROOT))


def a_step(rule: str, outcome: str = "generic", between: str = "coordinates") -> Any:
    return SimpleNamespace(**RULES[rule].theorems(outcome, {"between": between}))


@pytest.mark.parametrize("level", [Level.STANDARD, Level.FULL])
def test_a_theorem_is_told_once(level: Level) -> None:
    theorems = Theorems(WORDS, level)
    (told,) = theorems.before(a_step("rotation.torque"))
    assert isinstance(told, ToldOnce) and any(isinstance(node, Math) for node in told.nodes)
    assert any(isinstance(node, ToldIn) for node in told.again)
    assert theorems.before(a_step("rotation.rate_in_space")) == (), "it has been told"
    assert len(theorems.before(a_step("rotation.entry_moved", "moment"))) == 1
    assert theorems.before(a_step("lagrange.forced_equation", "applied")) == ()
    assert len(theorems.before(a_step("lagrange.forced_equation", "both"))) == 1
    assert theorems.before(a_step("lagrange.forced_equation", "both")) == (), "it has been told"
    assert len(theorems.before(a_step("lagrange.forced_equation", "both", "rates"))) == 1, "the form for rates has not"


def held_bob() -> Step:
    (m, l, gravity), tension = symbols("m l g", positive=True), "S"
    with recorded():
        r, theta = coordinate("r", "length", positive=True), coordinate("theta")
        bob = Particle(m, point(r * sin(theta), -r * cos(theta)))
        kept = constraint(l - r, force=tension)
        return equation_of_motion(lagrangian(System(bob, weight(gravity), kept)), r).step


def test_a_law_that_a_theorem_states_is_not_written_again() -> None:
    motion = held_bob()
    theorems = Theorems(WORDS, Level.STANDARD)
    assert theorems.without_law(motion) == motion, "nothing has been told yet"
    assert len(theorems.before(motion)) == 1
    assert theorems.without_law(motion).chain == motion.chain[1:]


def test_a_full_page_has_the_law_in_its_place() -> None:
    motion = held_bob()
    theorems = Theorems(WORDS, Level.FULL)
    theorems.before(motion)
    assert theorems.without_law(motion) == motion


def test_no_sentence_about_a_theorem_is_only_a_pointer() -> None:
    for name, sentence in WORDS.theorems_again.items():
        assert "<<formula>>" in sentence and not sentence.startswith("For "), name
        assert sentence.endswith("(<<problem>>)."), name


def test_a_brief_page_has_only_their_names() -> None:
    assert Theorems(WORDS, Level.BRIEF).before(a_step("rotation.torque")) == ()


def test_each_theorem_has_its_sentence_and_each_sentence_its_theorem() -> None:
    assert {theorem.name for theorem in theorems()} == set(WORDS.theorems) == set(WORDS.theorems_again)
    for theorem in theorems():
        assert "<<formula>>" in WORDS.theorems[theorem.name]


def test_a_theorem_of_a_script_needs_a_sentence_like_any_other() -> None:
    levers = Theorem("levers", Relation(Symbol("a"), "=", Symbol("b")), "Archimedes")
    step: Any = SimpleNamespace(**made_up("test.lever", quotes=[Quote(levers)]).theorems("generic", {}))
    with pytest.raises(Rejected, match="the phrases have no `levers` under `theorems`"):
        Theorems(WORDS, Level.STANDARD).before(step)
    sentence = {"levers": "Levers balance, <<formula>>."}
    own = replace(WORDS, theorems=sentence, theorems_again={"levers": "See <<problem>>."})
    (told,) = Theorems(own, Level.STANDARD).before(step)
    assert isinstance(told, ToldOnce) and Math(levers.formula) in told.nodes


def test_a_page_alone_has_each_theorem_as_a_paragraph_before_its_sentence() -> None:
    levers = ToldOnce("levers", (Text("Levers balance."),), (Text("For levers see above."),))
    sentence = Paragraph((levers, Text("So this one does.")))
    part = PartPage("a", (), None, (sentence, Folded((sentence,)), Paragraph((levers,))))
    told = [Paragraph((Text("Levers balance."),)), Paragraph((Text("So this one does."),))]
    paged = standalone(replace(WHOLE, parts=(part,), limits=part))
    assert paged.parts[0].blocks == (*told, Folded(tuple(told)), told[0])
    assert paged.limits == paged.parts[0]
    assert standalone(paged) == paged
