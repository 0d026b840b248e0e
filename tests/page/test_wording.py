"""Phrases contain verified results only, and every step has the phrases that it needs."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from sympy import Integer, Symbol

from derive.algebra.equality import Compared
from derive.algebra.expressions import Relation
from derive.algebra.kinds import dimension_of_kind
from derive.course.names import Language
from derive.course.prose import Mention
from derive.errors import Place, Rejected
from derive.page.template import templates_of
from derive.page.wording import (
    AXIS_NAMES,
    Chain,
    DimensionMark,
    Math,
    Text,
    UnitMark,
    filled,
    joined,
    letters_put_equal,
    names_asked,
    names_compared,
    names_of_step,
    phrases,
    told,
)
from derive.steps.step import Quantity
from derive.stock.keys.bodies import shapes
from tests.courses import ROOT
from tests.mechanics.block import a, b, c, known_block, omega

WORDS = phrases(templates_of(ROOT))
ONE, NIL = Integer(1), Integer(0)
VARIANTS: list[dict[str, Any]] = [
    {},
    {"sides": (a, a, a)},
    {"sides": (a, a, 2 * a)},
    {"axis": "z"},
    {"axis": (ONE, ONE, NIL)},
    {"rate": -omega},
    {"sides": (a, b, c)},
]


def every_step() -> list[Quantity]:
    return [quantity for variant in VARIANTS for quantity in known_block(**variant).values()]


# --- filling ---


def test_a_phrase_is_text_and_the_nodes_of_its_names() -> None:
    nodes = filled("The size is <<size>>, <<chain>>", {"size": Math(a), "chain": Chain()})
    assert nodes == (Text("The size is "), Math(a), Text(", "), Chain())


def test_a_name_may_stand_for_several_nodes() -> None:
    several = (Text("the axis along "), Math(a))
    assert filled("about <<axis>>", {"axis": several}) == (Text("about "), *several)


def test_blank_ends_of_a_phrase_are_taken_off() -> None:
    assert filled("  so <<chain>> \n", {"chain": Chain()}) == (Text("so "), Chain())


@pytest.mark.parametrize("template", ["<<unheard_of>>", "a <<torque.x>>", "<% if unheard_of %>x<% endif %>"])
def test_a_name_that_nothing_established_is_an_error(template: str) -> None:
    with pytest.raises(Rejected) as refusal:
        filled(template, {"torque": Math(a)})
    assert refusal.value.complaints[0].code == "undefined-name"


@pytest.mark.parametrize("template", ["<<", "<% if %>", "<<torque", "<<torque +>>"])
def test_a_phrase_that_cannot_be_read_is_an_error(template: str) -> None:
    with pytest.raises(Rejected) as refusal:
        filled(template, {"torque": Math(a)})
    assert refusal.value.complaints[0].code == "bad-phrase"


@pytest.mark.parametrize("text", ["100% & $5 {x} \\input", "a < b", "{{ torque }} {% raw %}", "#1"])
def test_characters_that_mean_something_elsewhere_are_only_text(text: str) -> None:
    assert filled(text, {}) == (Text(text),)


@pytest.mark.parametrize("template", ["<< ''.__class__ >>", "<< chain.__class__.__mro__ >>", "<< names.__globals__ >>"])
def test_a_phrase_cannot_reach_into_the_program(template: str) -> None:
    with pytest.raises(Rejected):
        filled(template, {"names": filled})


def test_a_mention_in_prose_becomes_what_it_names() -> None:
    missing: list[str] = []
    pieces = ["turns at\n  ", Mention("rate", Place("x.yaml", 1)), " about it"]
    nodes = told(pieces, {"rate": Math(omega)}, lambda name, place: missing.append(name))
    assert nodes == (Text("turns at "), Math(omega), Text(" about it"))
    assert missing == []


def test_an_unknown_mention_is_reported_with_its_place_and_left_out() -> None:
    missing: list[tuple[str, Place]] = []
    place = Place("x.yaml", 3, 7)
    nodes = told(["a ", Mention("rat", place)], {"rate": Math(omega)}, lambda *fault: missing.append(fault))
    assert nodes == (Text("a "),)
    assert missing == [("rat", place)]


@pytest.mark.parametrize(
    ("count", "text"), [(0, ""), (1, "x"), (2, "x and x"), (3, "x, x and x"), (4, "x, x, x and x")]
)
def test_items_are_joined_as_in_english(count: int, text: str) -> None:
    nodes = joined([Text("x")] * count)
    assert "".join(node.text for node in nodes if isinstance(node, Text)) == text


def test_the_names_that_a_phrase_asks_for_are_known_before_it_is_filled() -> None:
    assert names_asked("from <<refs>> on, <% if part %>of <<part>><% endif %>") == {"refs", "part"}
    assert names_asked("refs are references") == set()


def test_a_phrase_compares_words_and_prints_their_terms() -> None:
    assert names_compared('<% if seen == "kept" %>Again, <% endif %><<about>>') == {"seen"}
    assert names_compared("<% if case is defined %><<case>><% endif %>") == set()
    own = replace(WORDS, rules={"bat.blow": {"generic": '<% if kind == "soft" %>Softly,<% endif %> <<chain>>'}})
    assert own.compared("bat.blow") == {"kind"}, "a script's own word is compared like any other"


# --- the words of every step ---


def test_every_step_of_every_variant_has_its_sentence() -> None:
    for quantity in every_step():
        names = names_of_step(quantity.step, WORDS, dimension_of_kind(quantity.step.kind or "number"))
        page = {name: Math(Symbol(name)) for name in known_block()} | {"angular_velocity": Math(a)}
        nodes = filled(WORDS.phrase(quantity.step), {**page, **names})
        assert sum(isinstance(node, Chain) for node in nodes) == 1


def test_every_second_route_has_its_words() -> None:
    for quantity in every_step():
        for evidence in quantity.step.evidence:
            if evidence.compared is Compared.ROUTE:
                assert WORDS.route(quantity.step, evidence.claim), f"{quantity.step.rule}: {evidence.claim}"


def test_every_grade_has_its_words() -> None:
    for quantity in every_step():
        assert all(WORDS.grades[evidence.grade] for evidence in quantity.step.evidence)


def test_every_word_of_a_step_has_its_term() -> None:
    words = {word for quantity in every_step() for _, word in quantity.step.words}
    assert words <= set(WORDS.terms)
    assert {"corner", "centre", "diagonal"} <= words


def test_every_body_has_its_words() -> None:
    assert {id for id in shapes() if id not in WORDS.bodies} == set()


def test_a_body_of_ones_own_is_told_by_its_id() -> None:
    assert (WORDS.body("thick_shell"), WORDS.body("octahedron")) == ("a hollow ball", "an octahedron")
    assert (WORDS.size("semi_axes"), WORDS.size("wall_thickness")) == ("semi-axes", "wall thickness")


def test_an_outcome_without_a_phrase_is_an_error_that_names_both() -> None:
    odd = replace(known_block()["torque"].step, outcome="sideways")
    with pytest.raises(
        Rejected, match=r"`torque`: no phrase for `rotation\.torque` with the outcome `sideways`"
    ) as caught:
        WORDS.phrase(odd)
    (complaint,) = caught.value.complaints
    assert complaint.place
    assert (complaint.place.path, complaint.place.text) == ("templates/phrases/en/rotation.yaml", "  rotation.torque:")
    assert complaint.help
    assert all(f"`{outcome}`" in complaint.help for outcome in (*WORDS.rules["rotation.torque"], "sideways"))


@pytest.mark.parametrize("language", ["en", "de"])
def test_a_rule_without_phrases_is_told_with_what_to_write_where(language: str) -> None:
    odd = replace(known_block()["torque"].step, rule="sling.pull", outcome="generic")
    with pytest.raises(Rejected) as caught:
        phrases(templates_of(ROOT), Language(language)).phrase(odd)
    (complaint,) = caught.value.complaints
    assert (
        complaint.help == f"write `rules: {{sling.pull: {{generic: ...}}}}` in templates/phrases/{language}/sling.yaml"
    )


def test_what_goes_on_from_an_alike_step_has_the_words_for_that() -> None:
    first, second, product = (known_block()[f"corner_tensor_{pair}"].step for pair in ("xx", "yy", "xy"))
    assert first.outcome == second.outcome != product.outcome
    assert WORDS.phrase(second) == WORDS.phrase(first) != WORDS.phrase(second, before=first) == "<<chain>>"
    assert WORDS.phrase(product, before=second) == WORDS.phrase(product)


def test_an_alike_outcome_of_another_rule_changes_no_words() -> None:
    first, second = (known_block()[f"corner_tensor_{pair}"].step for pair in ("xx", "yy"))
    assert WORDS.phrase(second, before=replace(first, rule="rotation.entry_moved")) == WORDS.phrase(second)


def test_the_words_of_the_torque_change_when_it_vanishes() -> None:
    said = {WORDS.phrase(known_block(**variant)["torque"].step) for variant in VARIANTS[:2]}
    assert len(said) == 2


def test_a_reason_of_the_rule_beats_the_general_one() -> None:
    step = known_block()["corner_tensor_xx"].step
    own, general = (WORDS.reason(s, "by_mass", "law") for s in (step, known_block()["spin"].step))
    assert own and own != general


def test_a_line_without_a_reason_has_none() -> None:
    assert WORDS.reason(known_block()["spin"].step, "unheard_of", "law") == ""


def test_a_step_offers_its_roles_its_unit_and_its_dimension() -> None:
    step = known_block()["torque"].step
    names = names_of_step(step, WORDS, dimension_of_kind("torque"))
    assert names["omega"] == Math(known_block()["spin"].symbol)
    assert names["momentum"] == Math(known_block()["angular_momentum"].symbol)
    assert names["unit"] == UnitMark("N m")
    assert names["dimension"] == DimensionMark(dimension_of_kind("torque"))
    assert names["x"] == AXIS_NAMES["x"]


def test_a_number_offers_no_unit() -> None:
    assert "unit" not in names_of_step(known_block()["cosine"].step, WORDS, None)


def test_a_step_of_a_certain_other_rule_before_it_may_change_its_words() -> None:
    factor = known_block()["torque"].step
    total = replace(factor, rule="motion.sum", outcome="cancel")
    product = replace(factor, rule="motion.product", outcome="one_of_several")
    assert WORDS.phrase(total, before=factor) == WORDS.phrase(total) != WORDS.phrase(total, before=product)


def test_letters_that_are_put_equal_to_one_are_told_together() -> None:
    def told_as(*values: Relation) -> list[str]:
        roles = [("original", a), *((f"value_{i}", value) for i, value in enumerate(values, 1))]
        found = dict(letters_put_equal(roles))
        assert found.pop("original") == a
        assert list(found) == [f"value_{i}" for i in range(1, len(found) + 1)]
        return [str(value) for value in found.values()]

    assert told_as(Relation(b, "=", a), Relation(c, "=", a)) == ["b = c = a"]
    assert told_as(Relation(b, "=", a), Relation(c, "=", omega)) == ["b = a", "c = omega"]
    assert told_as(Relation(b, "=", NIL), Relation(c, "=", NIL)) == ["b = 0", "c = 0"]
