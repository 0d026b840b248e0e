"""Calls that were made before: recalled where they would give the same again, with all they left, else made."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from sympy import Integer, Symbol, pi, symbols

from derive import steps
from derive.algebra.expressions import Relation, rate
from derive.algebra.ranges import Range, take_as_positive, taken_as_positive, within
from derive.errors import Rejected
from derive.mechanics import Cuboid, Particle, System, coordinate, inertia_tensor, lagrangian, point, weight
from derive.steps.establish import Scope
from derive.steps.memory import Memory
from derive.steps.record import Run, assume, current_run, established, free_letter, given_letters, recorded
from derive.steps.signs import sign_known
from derive.steps.step import Quantity
from tests.steps.test_record import named

a, b, g = symbols("a b g", positive=True)
ANY_VERB = named.__globals__["establish"]  # what a call is told by must be of derive


class Texts(dict[str, str]):
    """A store, and what was made because it was not there."""

    def __init__(self) -> None:
        self.made: list[str] = []

    def keep(self, key: str, text: str) -> None:
        self[key] = text

    @contextmanager
    def run(self, **more: Any) -> Iterator[Run]:
        self.made.clear()
        with recorded(Run(memory=Memory(self), **more)) as run:
            yield run

    def called(self, verb: Callable[..., Any], *given: Any) -> Any:
        def make() -> Any:
            self.made.append(verb.__name__)
            return verb(*given)

        run = current_run.get()
        assert run is not None
        assert run.memory is not None
        return run.memory.result(ANY_VERB, {"name": verb.__name__, "given": given}, run, make)


@pytest.fixture
def texts() -> Texts:
    return Texts()


def square(size: Any) -> Quantity:
    return named("square", size**2)


def greater(size: Any) -> Quantity:
    return named("greater", size if sign_known(size - 1) == 1 else 1 / size)


def with_free_letter(size: Any) -> Quantity:
    return named("energy", size * Symbol(free_letter("T"), real=True))


def with_all_letters(size: Any) -> Quantity:
    return named("letters", size + len(given_letters()))


def with_all_steps(size: Any) -> Quantity:
    named("own", size)
    return named("all", size + 0 * len(established()))


def assuming(size: Any) -> Quantity:
    assume(Relation(size, ">", Integer(3)), in_words=True)
    take_as_positive(size - 3)
    return named("assuming", size)


def test_a_call_is_made_once_and_recalled_with_its_step_and_its_place_on_the_record(texts: Texts) -> None:
    with texts.run() as first:
        one = texts.called(square, a)
    assert texts.made == ["square"]
    with texts.run() as second:
        other = texts.called(square, a)
    assert texts.made == []
    assert second.established == [other]
    assert (one.step, one.value, one.subject) == (other.step, other.value, other.subject)
    assert [q.step for q in first.established] == [q.step for q in second.established]


@pytest.mark.parametrize("changed", [(b,), (Symbol("a", real=True),), (2 * a,), (a, ())])
def test_a_call_that_is_given_something_else_is_made(texts: Texts, changed: tuple[Any, ...]) -> None:
    def first_squared(*given: Any) -> Quantity:
        return square(given[0])

    for given in ((a,), changed):
        with texts.run():
            texts.called(first_squared, *given)
        assert texts.made == ["first_squared"]


def test_what_is_known_of_letters_and_coordinates_belongs_to_what_is_given(texts: Texts) -> None:
    def range_known() -> Any:
        return within({a: Range(Integer(0), pi)})

    def coordinate_known() -> Any:
        coordinate("q")

    def assumed() -> Any:
        assume(Relation(a, ">", b))

    def positive() -> Any:
        take_as_positive(a - b)

    with texts.run():
        texts.called(square, a)
    with range_known(), texts.run():
        texts.called(square, a)
        assert texts.made == ["square"]
    for known in (coordinate_known, assumed, positive):
        for times in (["square"], []):
            with texts.run():
                known()
                texts.called(square, a)
                assert texts.made == times, known


def test_numbers_count_for_what_asks_for_them_alone(texts: Texts) -> None:
    def made_with(number: int) -> list[str]:
        with texts.run(numbers={a: Integer(number)}):
            texts.called(square, a)
        made = list(texts.made)
        with texts.run(numbers={a: Integer(number)}):
            found = texts.called(greater, a)
        assert found.value == (a if number > 1 else 1 / a)
        return made + texts.made

    assert made_with(2) == ["square", "greater"]
    assert made_with(2) == []
    assert made_with(0) == ["greater"], "wrong to recall it, for a > 1 no longer"


def test_letters_of_the_problem_count_for_what_asks_for_them(texts: Texts) -> None:
    def made_with(*letters: str) -> list[str]:
        with texts.run(letters=letters):
            energy = texts.called(with_free_letter, a)
        made = list(texts.made)
        with texts.run(letters=letters):
            texts.called(with_all_letters, b)
        assert energy.value == a * Symbol("K" if "T" in letters else "T", real=True)
        return made + texts.made

    assert made_with("g") == ["with_free_letter", "with_all_letters"]
    assert made_with("g") == []
    assert made_with("g", "m") == ["with_all_letters"]
    assert made_with("T") == ["with_free_letter", "with_all_letters"]


def test_own_steps_are_no_answer_of_the_record_and_those_before_are(texts: Texts) -> None:
    for times in (["with_all_steps"], []):
        with texts.run():
            texts.called(with_all_steps, a)
        assert texts.made == times
    with texts.run():
        named("before", a)
        texts.called(with_all_steps, a)
    assert texts.made == ["with_all_steps"]


def test_what_a_call_takes_to_hold_is_taken_again(texts: Texts) -> None:
    left = []
    for _ in range(2):
        with texts.run() as run:
            texts.called(assuming, a)
            left.append((run.assumed, run.in_words, taken_as_positive()))
    assert texts.made == []
    assert left[0] == left[1] == ([Relation(a, ">", Integer(3))], [Relation(a, ">", Integer(3))], (a - 3,))


def test_a_letter_that_is_taken_meanwhile_is_refused_when_a_call_is_recalled_too(texts: Texts) -> None:
    with texts.run():
        texts.called(square, a)
    with texts.run():
        named("other", b)
        with pytest.raises(Rejected, match="`other` and `square` are both called s"):
            texts.called(square, a)


def test_a_case_of_a_quantity_is_one_when_it_is_recalled(texts: Texts) -> None:
    def case(general: Quantity) -> Quantity:
        return named("case", a**2, scope=Scope(case_of=general))

    for times in (["square", "case"], []):
        with texts.run():
            texts.called(case, texts.called(square, a + b))
        assert texts.made == times


def test_a_call_within_another_is_a_part_of_it(texts: Texts) -> None:
    def outer(size: Any) -> Quantity:
        return texts.called(square, size)

    with texts.run():
        texts.called(outer, a)
    assert (texts.made, len(texts)) == (["outer", "square"], 1)


def test_what_is_called_twice_is_made_twice(texts: Texts) -> None:
    for _ in range(2):
        with texts.run() as run:
            one, other = texts.called(square, a), texts.called(square, a)
            assert one is not other
            assert run.established == [one, other]
    assert texts.made == ["square"]


def test_a_function_of_a_script_is_called_and_what_follows_from_it_recalled(texts: Texts) -> None:
    def by_law(law: Callable[[Any], Any]) -> Quantity:
        return named("by_law", law(a))

    def after(quantity: Quantity) -> Quantity:
        return named("after", quantity.value, scope=Scope(case_of=quantity))

    for _ in range(2):
        with texts.run():
            texts.called(after, texts.called(by_law, lambda size: size + 1))
    assert texts.made == ["by_law"]


def test_what_fails_is_not_kept_and_fails_again(texts: Texts) -> None:
    def fails() -> Quantity:
        named("square", a**2)
        raise Rejected([])

    for _ in range(2):
        with texts.run(), pytest.raises(Rejected):
            texts.called(fails)
        assert texts.made == ["fails"]
    assert not texts


@pytest.mark.parametrize("damage", ["", "[", "[]", "3", "n\\t[]\\n[[], []]", '[[[], 3], {"#": "x"}]'])
def test_a_text_that_says_something_else_is_as_good_as_none(texts: Texts, damage: str) -> None:
    with texts.run():
        texts.called(square, a)
    for key in texts:
        texts[key] = damage
    with texts.run():
        assert texts.called(square, a).value == a**2
    assert texts.made == ["square"]


def test_verbs_of_derive_are_called_once(texts: Texts, monkeypatch: pytest.MonkeyPatch) -> None:
    def solve() -> list[Quantity]:
        q = coordinate("y", "length")
        block = Cuboid((a, 2 * a, b), a)
        I = inertia_tensor(block, about="corner")
        return [I, block.density, lagrangian(System(Particle(a, point(0, q, 0)), weight(g)))]

    with texts.run() as first:
        one = solve()
    monkeypatch.setattr("derive.steps.establish.equal", None)  # which no step is made without
    monkeypatch.setattr("derive.steps.chain.equal", None)
    with texts.run() as second:
        other = solve()
    assert [q.step for q in one] == [q.step for q in other]
    assert [q.key for q in first.established] == [q.key for q in second.established]
    assert other[-1].coordinates == {Symbol("y", real=True): "length"}
    assert rate(Symbol("y", real=True)) in other[-1].value.free_symbols


def test_verbs_read_the_record_by_its_questions_and_by_what_every_call_is_told_by() -> None:
    """Else a call could be recalled that would give something else now."""
    engine = Path(steps.__file__).parents[1]
    readers = {
        str(file.relative_to(engine))
        for room in ("algebra", "steps", "mechanics")
        for file in (engine / room).rglob("*.py")
        if "current_run" in file.read_text()
    }
    assert readers == {"steps/record.py", "steps/known_numbers.py", "mechanics/arguments.py"}
