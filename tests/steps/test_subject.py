"""What values are about: brought together where they fit, refused where they do not."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from sympy import MatrixSymbol, Symbol, symbols

from derive.algebra.expressions import column
from derive.errors import Rejected
from derive.steps.step import same_value
from derive.steps.subject import EVERYTHING, NOTHING, Mixed, Subject, called, united, with_name

a, b = symbols("a b", positive=True)
ROD, DISC = SimpleNamespace(called="upper rod"), SimpleNamespace(called="disc")


def together(*subjects: Subject, differ: Any = ()) -> Subject:
    return united("torque", [(f"input_{n}", subject) for n, subject in enumerate(subjects)], differ, same_value)


def test_what_is_about_nothing_fits_everything() -> None:
    known = Subject(body=ROD, point="centre", mass=a)
    assert together(NOTHING, known, NOTHING) == known
    assert together() == NOTHING


def test_values_that_are_equal_in_another_form_are_about_one_thing() -> None:
    one, other = Subject(mass=a * (a + b), place=column(a, 0, 0)), Subject(mass=a**2 + a * b, place=column(a, 0, 0))
    assert together(one, other) == one


@pytest.mark.parametrize(
    ("one", "other", "message"),
    [
        (
            Subject(body=ROD),
            Subject(body=DISC),
            "must belong to one body, but the first has the upper rod and the second has the disc",
        ),
        (
            Subject(point="apex"),
            Subject(point="base"),
            "must be about one point, but the first has apex and the second has base",
        ),
        (Subject(mass=a), Subject(mass=b), "must belong to one mass, but the first has a and the second has b"),
        (Subject(rotation=(a,)), Subject(rotation=(b,)), "must belong to one rotation"),
    ],
)
def test_two_different_things_are_refused_with_both(one: Subject, other: Subject, message: str) -> None:
    with pytest.raises(Rejected) as caught:
        together(one, other)
    assert caught.value.complaints[0].message.startswith(f"`torque`: `input_0` and `input_1` {message}")


def test_a_law_about_two_things_is_about_several_and_that_fits_no_other() -> None:
    several = together(Subject(point="apex"), Subject(point="base"), differ={"point"})
    assert several == Subject(point=Mixed.SEVERAL)
    with pytest.raises(Rejected, match="must be about one point, but the first has several and the second has apex"):
        together(several, Subject(point="apex"))
    assert together(several, several, differ=EVERYTHING).point is Mixed.SEVERAL


def test_moments_about_two_axes_belong_together() -> None:
    assert together(Subject(axis="x"), Subject(axis="y")).axis is Mixed.SEVERAL


def test_two_bodies_of_one_shape_are_two_by_their_names() -> None:
    class Rod(SimpleNamespace):
        def __eq__(self, other: object) -> bool:
            return True

        __hash__ = None  # type: ignore[assignment]

    assert together(Subject(body=Rod(called="rod")), Subject(body=Rod(called="rod"))).body
    with pytest.raises(Rejected, match="must belong to one body"):
        together(Subject(body=Rod(called="rod")), Subject(body=Rod(called="other")))


def test_more_that_is_said_goes_before_what_was_known() -> None:
    assert Subject(body=ROD, point="apex").with_more(Subject(point="base")) == Subject(body=ROD, point="base")


def test_what_belongs_to_a_named_body_has_its_name_once() -> None:
    rho = Symbol("rho", positive=True)
    key, symbol = with_name("upper rod", "density", rho)
    assert (key, symbol) == ("upper_rod_density", Symbol("rho_upper", positive=True))
    assert with_name("upper rod", key, symbol) == (key, symbol)
    assert with_name("disc", "spin", MatrixSymbol("omega", 3, 1))[1] == MatrixSymbol("omega_disc", 3, 1)
    assert with_name("disc", "sum", None) == ("disc_sum", None)


def test_a_message_calls_things_by_name_and_leaves_long_values_out() -> None:
    assert called(SimpleNamespace(called="a disc")) == "a disc"
    assert called(SimpleNamespace(name="centre_of_mass")) == "the centre of mass"
    assert called(a) == "a"
    assert called(sum(symbols("x:40"))) == ""
    assert called(3.5) == ""
