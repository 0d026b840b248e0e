"""Layout to MathML: what `latex` writes, as `math-core` reads it; browsers show it without a script.

Decision 0024 compares the converters. What is not MathML Core, such as a frame, is left to the page's own style.
"""

from __future__ import annotations

from functools import cache
from html import unescape

from math_core import LatexToMathML

from derive.render.notation.breaking import terms_of
from derive.render.notation.latex import SPACING, latex, latex_of_terms
from derive.render.notation.layout import Layout, width
from derive.render.rendered import Html


def mathml(layout: Layout, *, inline: bool = False) -> Html:
    """A formula of its own; inline, its fractions are small or have a stroke."""
    return of_latex(latex(layout, inline=inline), inline=inline)


def in_pieces(
    layout: Layout, *, inline: bool = False, sign: str = "", goes_on: bool = False
) -> list[tuple[float, Html]]:
    """The terms of a sum as formulas of their own, between which a line may end, each with its width in characters.

    Before the first stands a relation, or the sum goes on from another line.
    """
    first, *others = latex_of_terms(layout, inline=inline)
    begun = _going_on(first, inline) if goes_on else of_latex(f"{sign} {first}".strip(), inline=inline)
    formulas = [begun, *(_going_on(other, inline) for other in others)]
    return list(zip(map(width, terms_of(layout)), formulas, strict=True))


def _going_on(formula: str, inline: bool) -> Html:
    """What begins with a sign that stands between it and the formula before it."""
    return Html(of_latex(f"{{}}{formula}", inline=inline).replace("<mrow></mrow><mo", '<mo form="infix"', 1))


@cache
def of_latex(formula: str, inline: bool = False) -> Html:
    """A formula that is LaTeX of ours; one that `latex` writes can always be read.

    What keeps the rows of a column apart is for TeX: a browser's rows are as high as what stands in them.
    """
    for spacing in SPACING:
        formula = formula.replace(spacing, "")
    converted = _converter().convert_with_local_state(formula, displaystyle=not inline)
    # A block is what its row is; a formula by itself stands within one.
    converted = converted.replace('<math display="block">', '<math displaystyle="true">', 1)
    return Html(converted.replace(APPLIED, unescape(APPLIED)))  # XML has no name for that character


APPLIED = "&ApplyFunction;"


@cache
def _converter() -> LatexToMathML:
    return LatexToMathML(fancy_error=False)
