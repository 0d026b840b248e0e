"""The record of a run: what was established in it, one meaning for each letter, and what moves."""

from __future__ import annotations

from typing import Any

import pytest
from sympy import cos, symbols

from derive.algebra.expressions import TIME, Relation, column, component_names, rate, scalar, vector
from derive.errors import Rejected, Unverified
from derive.mechanics import let
from derive.steps.establish import Scope, establish
from derive.steps.record import (
    Run,
    assume,
    changes,
    coordinate_named,
    coordinates_in,
    current_run,
    recorded,
    require_constant,
)
from tests.rules import made_up
from tests.steps.test_establish import a, b, sum_of_squares

q, w = symbols("q w", real=True)


def named(key: str, value: Any, **more: Any) -> Any:
    return establish(made_up(f"test.{key}"), scalar("s"), lambda: value, {}, **more)


def test_everything_established_within_is_recorded_and_nothing_else() -> None:
    sum_of_squares(key="outside")
    with recorded() as run:
        sum_of_squares(key="first")
        with pytest.raises(Unverified):
            sum_of_squares(key="wrong", law=lambda p, q: p)
        sum_of_squares(key="second")
    sum_of_squares(key="outside")
    assert [quantity.key for quantity in run.established] == ["first", "second"]


def test_a_run_ends_with_its_block_also_by_an_error_and_gives_back_the_one_around_it() -> None:
    def fail() -> None:
        with recorded(Run()):
            raise ZeroDivisionError

    with recorded() as outer:
        with pytest.raises(ZeroDivisionError):
            fail()
        assert current_run.get() is outer
    assert current_run.get() is None


def test_one_letter_is_one_thing_in_a_run() -> None:
    with recorded():
        named("first", a + b)
        named("again", b + a)
        with pytest.raises(Rejected, match="`first` and `second` are both called s, but they are different quantities"):
            named("second", a - b)
    named("second", a - b)


def test_a_case_of_a_thing_may_have_its_letter() -> None:
    with recorded():
        general = named("general", a + b)
        assert named("case", 2 * a, scope=Scope(case_of=general)).value == 2 * a


def test_a_case_may_have_the_letter_of_what_is_the_same_as_its_general_case() -> None:
    with recorded():
        named("definition", a + b)
        general = named("general", b + a)
        assert named("case", 2 * a, scope=Scope(case_of=general)).value == 2 * a
    with recorded():
        named("other", a + b)
        with pytest.raises(Rejected, match="are both called s"):
            named("case", 2 * a, scope=Scope(case_of=sum_of_squares(key="another")))


def test_the_letter_of_a_coordinate_may_be_given_a_value_in_one_motion() -> None:
    with recorded():
        coordinate_named(q, "angle")
        for key, value in (("here", a), ("there", b)):
            establish(made_up(f"test.{key}"), q, lambda value=value: value, {})


def test_an_assumption_that_contradicts_an_earlier_one_is_refused() -> None:
    with recorded():
        assume(Relation(a, ">", b))
        assume(Relation(a, ">", 0))
        with pytest.raises(Rejected, match="a < b, which contradicts the assumptions of the page"):
            assume(Relation(a, "<", b))


def test_an_assumption_is_noted_once_and_nowhere_outside_a_run() -> None:
    condition = Relation(a, "<", b)
    assume(condition)
    with recorded() as run:
        assume(condition)
        assume(Relation(a, "<", b))
    assert run.assumed == [condition]


def test_a_coordinate_is_found_by_itself_and_by_its_rates() -> None:
    assert coordinates_in(q) == {}
    with recorded():
        coordinate_named(q, "angle")
        coordinate_named(w, "length")
        assert coordinates_in(a * cos(q)) == {q: "angle"}
        assert coordinates_in(rate(q, 2) + w) == {q: "angle", w: "length"}
        assert coordinates_in(a) == {}


def test_what_changes_is_the_time_a_coordinate_or_a_rate() -> None:
    assert changes(a * TIME) == TIME
    assert changes(a * q) is None
    assert changes(a * q, [q]) == q
    assert changes(a * rate(q), [q]) == rate(q)


def test_what_changes_is_refused_where_a_law_is_one_for_constants() -> None:
    require_constant("spin", "rate", a)
    with pytest.raises(Rejected, match=r"`spin` needs a constant rate, but .* depends on the time t"):
        require_constant("spin", "rate", a * TIME)
    with recorded():
        coordinate_named(q, "angle")
        with pytest.raises(Rejected, match="`spin` needs a constant rate, but `turning` depends on q"):
            require_constant("spin", "rate", let("turning", lambda: 2 * q))


def test_a_vector_of_names_alone_may_become_any_vector_of_its_letter() -> None:
    def vector_v(key: str, value: Any) -> None:
        establish(made_up(f"test.{key}"), vector("v"), lambda: value, {})

    with recorded():
        vector_v("open", column(*component_names("v")))
        vector_v("known", column(a, 0, 0))
        with pytest.raises(Rejected, match="`known` and `other` are both called v"):
            vector_v("other", column(b, 0, 0))
