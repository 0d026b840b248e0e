"""A page as LaTeX for another document: it uses amsmath, labels, and the equation numbers of that document.

A drawing does not float. If the drawing has a caption, it also has a figure number.
"""

from __future__ import annotations

from collections.abc import Sequence

from derive.page.numbering import Number
from derive.page.template import Templates
from derive.page.tree import Display, Document, Illustration
from derive.page.wording import DisplayedMath, FigureRef, Inline, Phrases, ProblemRef
from derive.render.notation.latex import escaped, latex
from derive.render.notation.layout import width as width_of
from derive.render.notation.notation import Notation
from derive.render.printing.amsmath import display_rows
from derive.render.printing.latex_page import END_OF_DISPLAY, LatexPage
from derive.render.printing.lines import Printed, reason_width
from derive.render.printing.templates import filled_template
from derive.render.rendered import Tex

WIDTH, ARTICLE = 46.0, 12.1  # a line of the class `article`: its number of characters, and its width in centimetres
LEAST = 16.0  # least number of characters for which a line has room
# Packages, in the order of loading, with the commands that need them.
PACKAGES = {
    r"\usepackage[T1]{fontenc}": (r"\textquotedbl", r"\guill", r"\k{", r"\DJ", r"\dj"),
    r"\usepackage{amsmath}": ("",),
    r"\usepackage{bm}": (r"\bm{",),
    r"\usepackage{graphicx}": (r"\includegraphics", r"\resizebox"),
}


def fragment(
    document: Document, words: Phrases, notation: Notation, templates: Templates, width: float | None = None
) -> Tex:
    """Return a page for another document.

    width   the width of the text in centimetres at the size 10 pt; by default the width of the class `article`
    """
    page = FragmentPage(document, words, notation, WIDTH * (width or ARTICLE) / ARTICLE)
    body = filled_template(templates, "fragment.tex.j2", {"page": page})
    needed = [package for package, signs in PACKAGES.items() if any(sign in body for sign in signs)]
    return filled_template(
        templates, "fragment_head.tex.j2", {"page": page, "packages": [Tex(each) for each in needed], "body": body}
    )


class FragmentPage(LatexPage):
    """A page without custom commands."""

    def __init__(self, document: Document, words: Phrases, notation: Notation, width: float = WIDTH):
        super().__init__(document, words, notation)
        self._width = max(width, LEAST)
        self._keys: dict[Number, str] = {}
        for key, number in document.numbers.items():
            self._keys.setdefault(number, key)
        self._labelled: set[Number] = set()

    def whole_worth(self) -> Tex:
        return Tex(escaped(self.words.worth(self.document.points)))

    def files(self) -> Sequence[Tex]:
        """Return the file names of the drawings, which are in the folder of the document."""
        return [Tex(f"{drawing.stem}.pdf") for drawing in self.document.illustrations]

    def labels(self) -> Sequence[Tex]:
        """Return the labels of equations and of drawings with a caption."""
        equations = [self._label(number) for number in self._keys if number in self._labelled]
        figures = [drawing.key for drawing in self.document.illustrations if drawing.number is not None]
        return [Tex(label) for label in (*equations, *map(self._figure, figures))]

    def drawing(self, drawing: Illustration) -> Tex:
        """Return the drawing, with its caption if it has a figure number."""
        natural = rf"\includegraphics{{{drawing.stem}.pdf}}"
        shown = _fitted(natural)
        if drawing.number is None:
            return Tex(shown)
        number = rf"\refstepcounter{{figure}}\label{{{self._figure(drawing.key)}}}"
        label = rf"\textbf{{{escaped(self.words.labels['figure'])}~\thefigure.}}"
        caption = rf"{{\small\leavevmode{number}{label} {self.inline(drawing.caption)}}}"
        return Tex(rf"{shown}\par\nobreak\smallskip{caption}")  # no page ends between a drawing and its caption

    def display(self, display: Display) -> Tex:
        """Return the rows of a display; each numbered line has the next equation number of the surrounding document."""
        *rows, last = display_rows(display, self.notation, self._width, self._ending)
        return Tex("".join(f"{row} \\\\\n" for row in rows) + str(last))

    def _node(self, node: Inline) -> str:
        match node:
            case ProblemRef(text=text):
                return escaped(text)
            case DisplayedMath(expr) if width_of(layout := self.notation.result(expr)) > self._width:
                formula = rf"$\displaystyle {latex(layout)}$"
                return rf"\[{_fitted(formula, '.95')}{END_OF_DISPLAY}"
            case FigureRef(key=key, is_alone=is_alone):
                label = "" if is_alone else rf"{escaped(self.words.labels['figure'])}~"
                return rf"{label}\ref{{{self._figure(key)}}}"
        return super()._node(node)

    def _reference(self, key: str) -> str:
        return rf"\eqref{{{self._label(self.document.numbers[key])}}}"

    def _ending(self, line: Printed) -> str:
        reason = rf"\quad\text{{\footnotesize[{self.inline(line.reason)}]}}" if line.reason else ""
        number = r"\notag"
        if line.number is not None and line.number not in self._labelled:
            self._labelled.add(line.number)
            number = rf"\label{{{self._label(line.number)}}}"
        if reason and line.width + reason_width(line.reason) > self._width:  # the reason has a row of its own
            return f"{number} \\\\\n&{reason}\\notag"
        return f"{reason}{number}"

    def _figure(self, key: str) -> str:
        return f"{self.document.id}:figure:{key}"

    def _label(self, number: Number) -> str:
        return f"{self.document.id}:{self._keys[number]}"


def _fitted(tex: str, share: str = "") -> str:
    """Return TeX that is reduced if it is wider than this share of the line."""
    room = rf"{share}\linewidth"
    return rf"\sbox0{{{tex}}}\ifdim\wd0>{room}\resizebox{{{room}}}{{!}}{{\usebox0}}\else\usebox0\fi"
