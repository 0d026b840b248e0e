"""The symbols that a solution has for places on the horizontal axis of a plot."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from sympy import Integer, sqrt, symbols

from derive.figures.marks import Plot
from derive.figures.places import with_places

r, k, m, r_0, r_1, v = symbols("r k m r_0 r_1 v", positive=True)


def test_a_place_is_the_variable_with_a_subscript_whose_value_depends_on_letters() -> None:
    plot = Plot("energy", v, k * r**2, r, Integer(0), Integer(1), "energy", "length")
    steps: list[Any] = [
        SimpleNamespace(symbol=symbol, result=value, names=names)
        for symbol, value, names in [
            (r_0, sqrt(k / m), ()), (r_1, Integer(2), ()), (v, k, ()), (symbols("r_2"), r + k, ()),
            (symbols("r_3"), v, ((v, 3 * m),)),
        ]
    ]  # fmt: skip
    found = with_places(plot, steps)
    assert isinstance(found, Plot)
    assert found.places == ((r_0, sqrt(k / m)), (symbols("r_3"), 3 * m))
