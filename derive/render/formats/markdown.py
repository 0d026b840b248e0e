"""A page as Markdown, for a wiki or a learning platform; its drawings are `.svg` files in the same folder."""

from __future__ import annotations

from derive.render.formats import WRITTEN, Format, Solution


def _rendered(solution: Solution) -> str:
    from derive.render.printing.markdown_page import MarkdownPage

    page = MarkdownPage(solution.document, solution.words, solution.notation)
    written = f"<!-- {WRITTEN} from {solution.problem.path}; an edit here is lost when the file is written again. -->"
    pieces = [piece if isinstance(piece, str) else page.drawing(piece) for piece in page.pieces()]
    return "\n\n".join([written, *pieces]) + "\n"


FORMAT = Format("markdown", "md", _rendered, built=False, drawings="svg")
