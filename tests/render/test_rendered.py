"""A page is encoded as JSON and decoded without change; data of another structure are rejected."""

from __future__ import annotations

import dataclasses
import json
from typing import Any

import pytest

from derive.errors import Complaint, Place
from derive.render.rendered import Html, Rendered, Tex

TOLD = Complaint("x", "y", Place("one.yaml", 1, 2, "text", 3), notes=("z",), help="fix it", severity="warning")
PAGE = Rendered(
    id="hw1/one",
    detail="standard",
    title="A top",
    points="",
    latex=Tex(r"$\omega$"),
    title_latex=Tex("A top"),
    sheet=Tex("?"),
    report=Tex("!"),
    source=Tex("quoted"),
    html=Html("<p>"),
    title_html=Html("<i>"),
    card_html=Html("<b>"),
    texts={"text": "ω", "json": "{}"},
    warnings=(TOLD, Complaint("a", "b")),
    inputs=("one.yaml", "one.py"),
    grades={"proved": 3},
    counts={"lines": 2},
    steps=4,
    compared=3,
    agreed=False,
    files=(("one-axes.pdf", b"\0\xff"),),
)


def test_a_kept_page_comes_back_the_same() -> None:
    assert Rendered.from_data(json.loads(json.dumps(PAGE.to_data()))) == PAGE


def test_what_comes_back_is_tex_where_it_was_and_nowhere_else() -> None:
    back = Rendered.from_data(PAGE.to_data())
    assert back
    names = {field.name for field in dataclasses.fields(PAGE) if isinstance(getattr(back, field.name), Tex)}
    assert names == {"latex", "title_latex", "sheet", "report", "source"}


@pytest.mark.parametrize("data", [None, [], {}, "page", 3])
def test_data_of_another_shape_are_no_page(data: object) -> None:
    assert Rendered.from_data(data) is None


@pytest.mark.parametrize(
    "damage",
    [
        {"latex": 3},
        {"title": None},
        {"files": [[1]]},
        {"files": [["a.pdf", "a"]]},
        {"counts": {"lines": "many"}},
        {"grades": [1]},
        {"steps": "some"},
        {"inputs": [3]},
        {"warnings": [{}]},
        {"warnings": None},
    ],
)
def test_one_field_of_another_type_makes_it_no_page(damage: dict[str, Any]) -> None:
    assert Rendered.from_data({**PAGE.to_data(), **damage}) is None


def test_a_page_agrees_only_if_the_data_say_so() -> None:
    back = Rendered.from_data({**PAGE.to_data(), "agreed": 1})
    assert back
    assert back.agreed is False
