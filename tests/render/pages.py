"""A page for tests that contains every kind of element of a page."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from sympy import Symbol

from derive.algebra.equality import Grade
from derive.course.placement import STATEMENT
from derive.page.chain_lines import ChainLine, Equations
from derive.page.checks import Checks
from derive.page.template import templates_of
from derive.page.tree import Display, Document, Illustration, Paragraph, PartPage
from derive.page.wording import Math, ProblemRef, Ref, Text, phrases
from derive.render.notation.notation import Notation
from tests.courses import ROOT

WORDS, NOTATION = phrases(templates_of(ROOT)), Notation({})
T, M, a = (Symbol(name, positive=True) for name in ("T", "M", "a"))

LINES = (
    ChainLine(T, "equals", M * (a + T) ** 2, (Text("from "), Ref("mass"))),
    ChainLine(None, "equals", 2 * M * a**2, (Text("tidied"),)),
)
AXES = Illustration("axes", "one-axes", (Text("Some axes 50% of "), Math(a)), None, (), STATEMENT)
VECTORS = Illustration("vectors", "one-vectors", (Text("Two vectors"),), 1, (Text("Both & true."),), "a")


def display(*keys: str, routes: tuple[str, ...] = (), end: str = ".", framed: int = 0) -> Display:
    groups = tuple(Equations(key, LINES if key == "energy" else LINES[1:], NUMBERS[key], framed) for key in keys)
    return Display(groups, frozenset({Grade.PROVED}), routes, end)


NUMBERS = {"mass": 1, "energy": 2}


def page(*blocks: Any, **changed: Any) -> Document:
    part = PartPage("a", (Text("Find "), Math(T), Text(" as in "), Ref("energy")), Fraction(5, 2), blocks)
    known: dict[str, Any] = {
        "strategy": (),
        "id": "hw9/one",
        "title": (Text("A block & its "), Math(T)),
        "points": Fraction(3),
        "statement": (Text("See "), ProblemRef("hw9/two", "Problem 2"), Text(" first.")),
        "illustrations": (AXES,),
        "parts": (part,),
        "note": (),
        "checks": Checks({}, {}, {}, {}, (), 0, 0, ()),
        "closing": (Text("Nothing."),),
        "numbers": NUMBERS,
        "symbols": {"mass": M, "energy": T, "law": None},
        "shown_in": {"mass": "a", "energy": "a"},
        "dimensions": {},
    }
    return Document(**{**known, **changed})


WHOLE = page(
    Paragraph((Text("So "),)),
    display("mass", "energy", routes=("by halves",)),
    VECTORS,
    strategy=(Text("Mind every step."),),
    limits=PartPage("", (Text("Limiting cases"),), None, (Paragraph((Text("A light one flies."),)),)),
    note=(Text("Mind the gap."),),
)
