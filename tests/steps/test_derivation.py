"""The walk back from the answers, and a derivation as JSON."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest
from sympy import Integer

from derive.algebra.expressions import Relation, scalar
from derive.errors import Rejected
from derive.steps.derivation import answering, derivation_of, from_json, returned_quantities, to_json, with_ancestors
from derive.steps.establish import establish
from derive.steps.numeric import value_of
from derive.steps.record import Run, recorded
from derive.steps.step import Quantity
from tests.mechanics.block import AMOUNTS, a, known_block
from tests.mechanics.slab import known_slab
from tests.rules import made_up


def made(key: str, *parents: Quantity, value: Any = a) -> Quantity:
    return establish(made_up("test.made"), scalar(key), lambda: value, {}, key=key, parents=parents)


# A small tree: `top` and `side` both rest on `shared`, which rests on `root`.
ROOT = made("root")
SHARED = made("shared", ROOT)
TOP = made("top", SHARED)
SIDE = made("side", SHARED, ROOT)


def test_parents_come_before_what_rests_on_them() -> None:
    assert list(with_ancestors([TOP])) == ["root", "shared", "top"]


def test_what_two_answers_rest_on_comes_once() -> None:
    assert list(with_ancestors([TOP, SIDE])) == ["root", "shared", "top", "side"]


def test_a_part_shows_what_no_earlier_part_has_shown() -> None:
    derivation = derivation_of([["top"], ["side"], ["shared"]], with_ancestors([TOP, SIDE]))
    assert derivation.parts == (("root", "shared", "top"), ("side",), ())
    assert derivation.keys == ("root", "shared", "top", "side")


def test_parts_in_another_order_show_each_step_where_it_is_first_needed() -> None:
    derivation = derivation_of([["side"], ["top"]], with_ancestors([TOP, SIDE]))
    assert derivation.parts == (("root", "shared", "side"), ("top",))


def test_what_no_answer_rests_on_is_not_shown_but_named() -> None:
    derivation = derivation_of([["top"]], with_ancestors([TOP, SIDE]), Run([ROOT, SHARED, TOP, SIDE, SIDE]))
    assert derivation.unshown == ("side",)
    assert "side" not in derivation.keys


def test_a_step_answers_for_itself_and_for_those_it_stands_for_each_once() -> None:
    both = replace(TOP, step=replace(TOP.step, stands_for=("fast", "slow", "side")))
    derivation = derivation_of([["top", "side"]], with_ancestors([both, SIDE]))
    assert [step.key for step in derivation.answering(["slow", "fast", "side"])] == ["top", "side"]


def test_every_step_of_the_block_comes_after_its_inputs() -> None:
    keys = list(with_ancestors(known_block().values()))
    for key in keys:
        assert all(keys.index(name) < keys.index(key) for name in known_block()[key].step.inputs)


def test_two_different_steps_of_one_name_are_refused() -> None:
    with pytest.raises(Rejected) as refusal:
        with_ancestors([TOP, made("root", value=2 * a)])
    (complaint,) = refusal.value.complaints
    assert complaint.code == "key-clash"
    assert complaint.message == "two different steps are both called `root`"


def test_the_same_step_made_twice_is_one() -> None:
    again = made("top", made("shared", made("root")))
    assert list(with_ancestors([TOP, again])) == ["root", "shared", "top"]


@pytest.mark.parametrize(
    "returned", [TOP, (TOP, SIDE), [TOP, [SIDE, (ROOT,)]], {"first": TOP, "second": SIDE}, (TOP, {"more": [SIDE]})]
)
def test_answers_may_be_returned_in_tuples_lists_and_mappings(returned: Any) -> None:
    found = returned_quantities(returned)
    assert found[0] is TOP
    assert all(isinstance(quantity, Quantity) for quantity in found)


@pytest.mark.parametrize(
    ("returned", "got"),
    [
        (None, "nothing"),
        ((), "nothing"),
        (3, "an `int`"),
        ("I", "a `str`"),
        ((TOP, a), "a `Symbol`"),
        ([TOP, None], "nothing"),
    ],
)
def test_anything_else_that_is_returned_is_refused(returned: Any, got: str) -> None:
    with pytest.raises(Rejected) as refusal:
        returned_quantities(returned)
    assert refusal.value.complaints[0].message.endswith(f"but it returned {got}")


def block_derivation() -> Any:
    with recorded() as run:
        extra = made("never_asked_for")
    known = with_ancestors(known_block().values())
    value = value_of(known["magnitude"], AMOUNTS, "N m", Integer(1), 4)
    assert value is not None
    known[value.key] = value
    run = replace(run, established=[*run.established, extra], assumed=[Relation(a, "<", 2 * a)])
    return derivation_of([["inertia_tensor"], ["torque", "magnitude_value"]], known, run)


def test_a_derivation_goes_to_json_and_comes_back_unchanged() -> None:
    derivation = block_derivation()
    assert from_json(to_json(derivation)) == derivation


def test_json_there_and_back_and_there_is_the_same_text() -> None:
    text = to_json(block_derivation())
    assert to_json(from_json(text)) == text


def slab_derivation(**variant: Any) -> Any:
    return derivation_of([list(known_slab(**variant))], known_slab(**variant))


@pytest.mark.parametrize("variant", [{}, {"radius": a / 4}, {"radius": a / 2}])
def test_equations_conditions_and_series_go_to_json_and_come_back_unchanged(variant: dict[str, Any]) -> None:
    derivation = slab_derivation(**variant)
    assert from_json(to_json(derivation)) == derivation
    assert to_json(from_json(to_json(derivation))) == to_json(derivation)
    assert "\\" not in json.dumps(json.loads(to_json(derivation)), ensure_ascii=False)


def test_the_json_holds_no_sentence_and_no_tex() -> None:
    text = json.dumps(json.loads(to_json(block_derivation())), ensure_ascii=False)
    assert "\\" not in text
    assert "$" not in text


def test_claims_are_counted_by_how_they_were_decided() -> None:
    derivation = block_derivation()
    grades = derivation.grades()
    assert sum(grades.values()) == sum(len(step.evidence) for step in derivation.steps)
    assert grades["approximation"] == 1
    assert grades["sampled"] == 0
    assert "refuted" not in grades


def test_a_step_is_found_by_its_key() -> None:
    assert block_derivation().step("torque").rule == "rotation.torque"


def nested(depth: int) -> list[Any]:
    found: list[Any] = []
    for _ in range(depth):
        found = [found]
    return found


def within_itself() -> list[Any]:
    found: list[Any] = []
    found.append(found)
    return found


@pytest.mark.parametrize(
    ("value", "got"),
    [
        (within_itself(), "lists that are too long or nested too deeply"),
        (nested(10_000), "lists that are too long or nested too deeply"),
        (Quantity.__new__(Quantity), "a `Quantity`"),
        ([], "a `list`"),
        (None, "nothing"),
    ],
    ids=["itself", "deep", "empty quantity", "empty list", "none"],
)
def test_what_is_no_answer_is_refused_whatever_it_is(value: Any, got: str) -> None:
    with pytest.raises(Rejected, match=f"but it returned {got}"):
        returned_quantities(value)


def test_a_name_asks_for_all_of_its_group_also_where_one_of_them_has_that_name() -> None:
    """`stability` is a condition, and the further ones that hold with it: one alone would say too much."""
    steps = [made(key).step for key in ("stability", "stability_2", "period")]
    groups = {"stability": ("stability", "stability_2"), "period": ("tau_1", "tau_2")}
    assert list(answering(["stability"], steps, groups)) == ["stability", "stability_2"]
    assert list(answering(["stability_2", "period"], steps, groups)) == ["stability_2", "period"]
