"""Layout to MathML: the output of `latex`, converted by `math-core`; browsers show it without a script.

Decision 0024 compares the converters. The style sheet of the page has what MathML Core lacks, such as frames.
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
    """Return a separate formula; inline, its fractions are small or have a stroke."""
    return of_latex(latex(layout, inline=inline), inline=inline)


def in_pieces(
    layout: Layout, *, inline: bool = False, sign: str = "", goes_on: bool = False
) -> list[tuple[float, Html]]:
    """Return the terms of a sum as separate formulas, between which a line may end, each with its width in characters.

    Before the first there is a relation, or the sum continues from another line.
    """
    first, *others = latex_of_terms(layout, inline=inline)
    begun = _going_on(first, inline) if goes_on else of_latex(f"{sign} {first}".strip(), inline=inline)
    formulas = [begun, *(_going_on(other, inline) for other in others)]
    return list(zip(map(width, terms_of(layout)), formulas, strict=True))


def _going_on(formula: str, inline: bool) -> Html:
    """Return a formula that begins with a sign between it and the formula before it."""
    return Html(of_latex(f"{{}}{formula}", inline=inline).replace("<mrow></mrow><mo", '<mo form="infix"', 1))


@cache
def of_latex(formula: str, inline: bool = False) -> Html:
    """Return the MathML of LaTeX that `latex` writes, which can always be converted.

    The spacing between rows of a column is for TeX only: a browser makes each row as high as its contents.
    """
    for spacing in SPACING:
        formula = formula.replace(spacing, "")
    converted = _converter().convert_with_local_state(formula, displaystyle=not inline)
    # A block becomes its row; a separate formula is within a row.
    converted = converted.replace('<math display="block">', '<math displaystyle="true">', 1)
    return Html(converted.replace(APPLIED, unescape(APPLIED)))  # XML has no name for this character


APPLIED = "&ApplyFunction;"


@cache
def _converter() -> LatexToMathML:
    return LatexToMathML(fancy_error=False)
