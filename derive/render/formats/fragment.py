"""A page as LaTeX without preamble, for `\\input`; its first lines list the packages that it needs."""

from __future__ import annotations

from derive.render.formats import Format, Solution


def _rendered(solution: Solution) -> str:
    from derive.page.template import templates_of
    from derive.render.printing.fragment_page import fragment

    templates = templates_of(solution.problem.root)
    return fragment(solution.document, solution.words, solution.notation, templates, solution.width)


FORMAT = Format("fragment", "tex", _rendered, built=False, drawings="pdf")
