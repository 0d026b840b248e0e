"""Modules and data that the workers of a build need, loaded once before the workers are forked."""

from __future__ import annotations

from contextlib import suppress
from importlib import import_module
from pathlib import Path

from derive.errors import DeriveError

__all__ = ["preload"]

PRINTING = ("derive.building.set_document", "derive.building.solution", "derive.render.printing.contract")
DERIVING = (
    "derive.course.latex",
    "derive.given",
    "derive.mechanics",
    "derive.stock.body",
    "derive.stock.rotation",
    "derive.stock.system",
    "derive.witness.judges",
    "scipy.integrate",  # the witness needs it to follow a motion
    "sympy.tensor.array.expressions",
    "sympy.tensor.tensor",
)
DRAWING = ("derive.render.drawing.picture", "derive.render.drawing.plotting")


def preload(root: Path, derives: bool, draws: bool, set_id: str = "") -> None:
    """Load the phrases, the templates and the modules that workers need.

    With `derives` and `set_id`, also read the reference of this set.
    """
    for name in (*PRINTING, *(DERIVING if derives else ()), *(DRAWING if draws else ())):
        import_module(name)
    from derive.course.problem_set import language_of
    from derive.page.template import templates_of
    from derive.page.wording import phrases
    from derive.render.printing.templates import compile_templates

    if derives and set_id:
        from derive.course.reference.statements import read_ahead

        with suppress(DeriveError):  # each problem shows the error itself
            read_ahead(root, set_id)
    with suppress(DeriveError):  # each problem reports such errors itself
        phrases(templates_of(root), language_of(root, set_id))
        compile_templates(templates_of(root))
    if draws:
        from derive.render.drawing.lettering import letters_of

        letters_of(["$x$"])  # one letter is enough to load all modules that typeset letters
