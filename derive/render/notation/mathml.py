"""Writes a layout as MathML: `math-core` converts the output of `latex`; browsers show MathML without a script.

Decision 0024 compares the converters. The page's style sheet adds what MathML Core lacks, such as frames.
"""

from __future__ import annotations

import re
from functools import cache
from html import unescape

from math_core import LatexToMathML

from derive.render.notation.breaking import terms_of
from derive.render.notation.latex import SPACING, latex, latex_of_terms
from derive.render.notation.layout import Layout, width
from derive.render.rendered import Html


def mathml(layout: Layout, *, inline: bool = False) -> Html:
    """Return a layout as one MathML formula; with `inline`, its fractions are small or written a/b."""
    return of_latex(latex(layout, inline=inline), inline=inline)


def in_pieces(
    layout: Layout, *, inline: bool = False, sign: str = "", goes_on: bool = False
) -> list[tuple[float, Html]]:
    """Return each term of a sum as a separate formula with its width in characters; a line may end between two terms.

    The relation `sign`, if any, precedes the first term; with `goes_on`, the terms continue a sum of the line before.
    """
    first, *others = latex_of_terms(layout, inline=inline)
    begun = _going_on(first, inline) if goes_on else of_latex(f"{sign} {first}".strip(), inline=inline)
    formulas = [begun, *(_going_on(other, inline) for other in others)]
    return list(zip(map(width, terms_of(layout)), formulas, strict=True))


def _going_on(formula: str, inline: bool) -> Html:
    """Return a formula whose leading sign has the spacing of a sign between two terms."""
    return Html(of_latex(f"{{}}{formula}", inline=inline).replace("<mrow></mrow><mo", '<mo form="infix"', 1))


@cache
def of_latex(formula: str, inline: bool = False) -> Html:
    """Return the MathML of a formula that `latex` has written.

    The extra height of rows in a column is removed: only TeX needs it, since a browser fits rows to their contents.
    """
    for spacing in SPACING:
        formula = formula.replace(spacing, "")
    converted = _converter().convert_with_local_state(formula, displaystyle=not inline)
    # The page puts a display formula within a row of its own, so the formula is not a block.
    converted = converted.replace('<math display="block">', '<math displaystyle="true">', 1)
    converted = _DECIMAL_COMMA.sub(r"<mn>\1,\2</mn>", converted)
    return Html(converted.replace(APPLIED, unescape(APPLIED)))  # XML does not define the name of this character


# The converter writes 1{,}5 in this form.
_DECIMAL_COMMA = re.compile(r'<mn>(\d+)</mn><mo rspace="0">,</mo><mn>(\d+)</mn>')
APPLIED = "&ApplyFunction;"


@cache
def _converter() -> LatexToMathML:
    return LatexToMathML(fancy_error=False)
