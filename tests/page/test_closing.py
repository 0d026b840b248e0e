"""Tests of the limiting cases at the end of a page."""

from __future__ import annotations

from pathlib import Path

from derive.building.solution import derived
from derive.page.closing import limiting_cases
from derive.page.template import templates_of
from derive.page.wording import Math, Ref, Text, filled, names_of_step, phrases
from derive.steps.step import Step
from tests.courses import ROOT
from tests.stock.described import edited, loaded
from tests.stock.keys.test_limits import CART

WORDS = phrases(templates_of(ROOT))


def test_a_number_stands_in_the_line_with_its_sign_and_what_is_added(tmp_path: Path) -> None:
    problem = loaded(tmp_path, CART)
    derivation, *_ = derived(problem)
    found = list(
        limiting_cases(
            problem,
            derivation,
            WORDS,
            lambda step: (Text(step.outcome), Text(" ")),
            lambda pieces: (Text("why"),),
            {},
        )
    )
    assert [type(each) for each in found] == [tuple] * 3
    assert found[0] == (Text("finite"), Text(" "), Text(", "), Text("why"), Text("."))
    whole = list(limiting_cases(problem, derivation, WORDS, told_in_full, lambda pieces: (), {"alone": 7}))
    assert [str(node.expr) for node in whole[0] if isinstance(node, Math)][-1].startswith("Approach(omega_0")


def told_in_full(step: Step) -> tuple[object, ...]:
    return filled(WORDS.phrase(step), names_of_step(step, WORDS, None))


def test_what_is_known_is_named_by_its_number(tmp_path: Path) -> None:
    known = edited(
        CART,
        ("  gravity: g\n", "  gravity: g\n  results:\n    alone: {value: sqrt(g/l), symbol: Omega}\n"),
        ("is: sqrt(g/l), ", "known: alone, "),
    )
    problem = loaded(tmp_path, known)
    derivation, *_ = derived(problem)
    steps, sentences = [], []
    for each in limiting_cases(problem, derivation, WORDS, told_in_full, lambda pieces: (), {"alone": 7}):
        (steps if isinstance(each, Step) else sentences).append(each)
    assert [step.key for step in steps] == ["alone"], "what only the comparison rests on is told first"
    assert Ref("alone") in sentences[0]


def test_what_is_known_but_not_shown_is_named_by_its_letter(tmp_path: Path) -> None:
    known = edited(
        CART,
        ("  gravity: g\n", "  gravity: g\n  results:\n    alone: {value: sqrt(g/l), symbol: Omega}\n"),
        ("is: sqrt(g/l), ", "known: alone, "),
    )
    problem = loaded(tmp_path, known)
    derivation, *_ = derived(problem)
    limits = limiting_cases(problem, derivation, WORDS, told_in_full, lambda pieces: (), {})
    sentence = next(each for each in limits if not isinstance(each, Step))
    assert Math(derivation.step("alone").symbol) in sentence and Ref("alone") not in sentence


def test_what_vanishes_in_a_case_is_told_in_words_alone(tmp_path: Path) -> None:
    problem = loaded(tmp_path, edited(CART, ("where: {m: M}, is: sqrt(2*g/l)}", "where: {g: 0}, why: without weight}")))
    derivation, *_ = derived(problem)
    *_, last = limiting_cases(problem, derivation, WORDS, told_in_full, lambda pieces: (Text("as <<it>> must"),), {})
    assert [node.text for node in last if isinstance(node, Text)] == [
        "For ",
        ", ",
        " vanishes",
        ", ",
        "as <<it>> must",
        ".",
    ]
    assert [str(node.expr) for node in last if isinstance(node, Math)] == ["g = 0", "omega_0"]
