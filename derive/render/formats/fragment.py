"""A page as LaTeX without preamble, for `\\input`; its first lines list the packages that it needs."""

from __future__ import annotations

from derive.render.formats import Format, Solution


def _rendered(solution: Solution) -> str:
    from derive.page.template import template_folder
    from derive.render.printing.fragment_page import fragment

    folder = template_folder(solution.problem.root)
    return fragment(solution.document, solution.words, solution.notation, folder)


FORMAT = Format("fragment", "tex", _rendered, built=False, drawings="pdf")
