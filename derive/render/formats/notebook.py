"""A page as a Jupyter notebook without stored output; the cells derive the problem again."""

from __future__ import annotations

from derive.render.formats import Format, Solution


def _rendered(solution: Solution) -> str:
    from derive.render.printing.notebook_page import notebook

    return notebook(solution)


FORMAT = Format("notebook", "ipynb", _rendered, built=False)
