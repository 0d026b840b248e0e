"""Objects as data: the same again when they are read, with what they share, and never another in their place."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

import pytest
from sympy import Dummy, Symbol, cos, sin, symbols

from derive.algebra.ranges import POSITIVE
from derive.mechanics import Cuboid, Particle, System, coordinate, equation_of_motion, lagrangian, point, weight
from derive.steps.objects import NoDescription, Objects
from derive.steps.record import recorded
from derive.steps.step import Fact, Level, Quantity
from tests.steps.test_establish import sum_of_squares

g, length, m = symbols("g l m", positive=True)
theta = Symbol("theta", real=True)


def again(value: Any, known: Objects | None = None) -> Any:
    here, there = Objects(), known or Objects()
    data, names = here.described(value)
    for name, text in json.loads(json.dumps(here.texts(here.below(names)))):
        there.enter(name, text)
    return there.read(json.loads(json.dumps(data)))


def pendulum() -> tuple[System, Quantity]:
    q = coordinate("theta")
    system = System(Particle(m, point(length * sin(theta), -length * cos(theta))), weight(g))
    return system, equation_of_motion(lagrangian(system), q)


@pytest.mark.parametrize(
    "value",
    [
        None,
        True,
        "corner",
        (1, ("a", ())),
        [1, 2],
        {"a": 1, theta: (g, None)},
        {theta, m},
        frozenset({1}),
        Level.FULL,
        POSITIVE,
        2 * (g + m),
        Quantity,
        lagrangian.__wrapped__,  # type: ignore[attr-defined]
    ],
)
def test_what_is_described_is_read_again(value: Any) -> None:
    found = again(value)
    assert (found, type(found)) == (value, type(value))


def test_a_quantity_keeps_its_step_its_parents_and_what_it_hands_on() -> None:
    with recorded():
        _, motion = pendulum()
        read = again(motion)
    one, other = list(motion.ancestors()), list(read.ancestors())
    assert [q.step for q in one] == [q.step for q in other]
    assert [q.step.law_at for q in one] == [q.step.law_at for q in other]
    assert [q.value for q in one] == [q.value for q in other]
    assert [[type(f) for f in q.facts] for q in one] == [[type(f) for f in q.facts] for q in other]


def test_what_two_share_is_one_object_again() -> None:
    first = sum_of_squares()
    one, other, third = again((first, first, sum_of_squares()))
    assert one is other
    assert one is not third, "although it is alike: quantities are told apart by what they are, not by what they say"


def test_an_object_that_is_known_is_not_made_again() -> None:
    first = sum_of_squares()
    known = Objects()
    known.described(first)
    assert again(first, known) is first


def test_a_name_is_of_the_content_and_the_class() -> None:
    def name(value: Any) -> str:
        return str(Objects().described(value)[0])

    assert name(sum_of_squares()) == name(sum_of_squares())
    assert name(sum_of_squares(key="one")) != name(sum_of_squares(key="other"))
    assert name(Cuboid((g, g, g), m)) != name(Cuboid((g, g, length), m))
    assert name(Symbol("a", positive=True)) != name(Symbol("a", real=True))


def test_what_an_object_finds_when_it_is_asked_is_no_part_of_it_but_is_told() -> None:
    block = Cuboid((g, g, g), m)
    objects = Objects()
    _, names = objects.described(block)
    assert objects.found_once(names) == []
    density = block.density
    assert objects.found_once(names) == [(names[0], "density", density)]
    assert Objects().described(block) == Objects().described(Cuboid((g, g, g), m))
    twin = Cuboid((g, g, g), m)
    other = Objects()
    other.described(twin)
    other.put_found(names[0], "density", density)
    assert twin.density is density


@dataclass(frozen=True)
class OfAScript:
    side: int


@pytest.mark.parametrize("value", [OfAScript(1), lambda: 1, OfAScript, object(), 1j, type("Word", (str,), {})("a")])
def test_what_is_not_of_derive_has_no_description(value: Any) -> None:
    with pytest.raises(NoDescription):
        Objects().described((1, {"a": value}))


def test_a_letter_that_equals_no_other_is_itself_here_and_nobody_elsewhere() -> None:
    u, v = Dummy("u"), Dummy("u")
    objects = Objects()
    data, names = objects.described(u + cos(v) * u)
    assert objects.read(data) == u + cos(v) * u
    assert len(set(names)) == 2
    with pytest.raises(NoDescription):
        objects.texts(names)
    with pytest.raises(NoDescription):
        Objects().read(data)


@pytest.mark.parametrize(
    "data",
    [{"#": "nobody"}, {"code": "os:system"}, {"one": "pathlib:Path", "value": "/"}, {"is": "sympy:Symbol", "with": {}}],
)
def test_nothing_but_what_is_of_derive_is_read(data: Any) -> None:
    with pytest.raises(NoDescription):
        Objects().read(data)


def test_parts_come_before_what_is_made_of_them_however_long_the_chain_is() -> None:
    objects = Objects()
    quantity = sum_of_squares()
    for i in range(3000):
        quantity = Quantity(quantity.value, quantity.step, (quantity,))
        if i % 50 == 0:
            objects.described(quantity)
    _, names = objects.described(quantity)
    found = list(objects.below(names))
    assert found[-1] == names[0]
    assert len(found) > 3000


def test_what_a_quantity_hands_on_is_data_and_no_function() -> None:
    def below(kind: type) -> Iterator[type]:
        for each in kind.__subclasses__():
            yield each
            yield from below(each)

    facts = [each for each in below(Fact) if each.__module__.startswith("derive.") and is_dataclass(each)]
    assert len(facts) > 30
    for each in facts:
        assert not [f.name for f in fields(each) if "Callable" in str(f.type)], each  # type: ignore[arg-type]
