r"""Prose as an instructor writes it: plain text with mentions and formulas.

- `<<name>>` is a symbol, a given value or a derived result.
- `<<body.sides>>` is the value at this path of `given:`.
- `<<eq torque>>` is the equation number of the step `torque`.
- `<<figure axes>>` is the number of the drawing `axes`.
- `<<problem top>>` is the word "Problem" with the number of another problem of the set.
- `$y = x^2/(2b)$` is a formula in LaTeX; between double dollar signs, a formula has a line of its own.
- `\$` is a dollar sign.

A formula is parsed when the page is made (`derive.page.formulas`); its letters are the letters of the problem.

Prose has no template commands; it is escaped when it is printed.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

from derive.course.schema import LEFT_EMPTY, TEXT, Reader, quotes_needed, refuse_comment, wrong_type
from derive.course.yaml_tree import Scalar, Tree, abridged, shape_of
from derive.errors import Complaint, Faults, Place

EQUATION, PROBLEM, FIGURE = "eq", "problem", "figure"
LONGEST_IN_PROSE = 400

# A dollar sign next to a digit may be the sign of a price: "2$a$" has a formula, "5$ each" has none.
_PIECE = re.compile(
    r"(?P<dollar>\\\$)"
    r"|(?P<displayed>\$\$[^$]+\$\$)"
    r"|(?P<formula>\$(?:(?<!\d\$)(?=[^\d$])|(?=[A-Za-z\\({]))[^$]*\$|\$(?=\d)[^$]*[^$\s]\$(?!\d))"
    r"|<<\s*(?:(?P<of>eq|figure)\s+)?(?P<name>[A-Za-z][A-Za-z0-9_]*(?:\.[A-Za-z][A-Za-z0-9_]*)*)\s*>>"
    r"|<<\s*problem\s+(?P<problem>[A-Za-z0-9][\w-]*)\s*>>"
    r"|(?P<odd><<[^<>\n]{0,40}>{0,2}|<%|<#)",
    re.ASCII,
)
_PRICE = re.compile(r"\d\s?\$|\$\s?\d", re.ASCII)
_LATEX = re.compile(r"\\[A-Za-z]+(?:\{\w*\})*|\\[(\[]|\w(?P<power>\^)[\w{(+-]+|\b[A-Za-z](?P<below>_)[\w{]+", re.ASCII)
_LETTER = re.compile(r"\\?((?<=\\)[A-Za-z]+|[A-Za-z])\}?(?:_(\{[^{}]*\}|\\?\w))?", re.ASCII)
_HOW = "write one name, as `<<mass>>`, `<<eq torque>>`, `<<figure axes>>` or `<<problem top>>`"
_DOLLAR = "write a formula between two dollar signs, `$x^2$`; write `\\$` for a dollar sign"


@dataclass(frozen=True)
class Mention:
    """A `<<name>>` and its place; `of` is the word before the name, if any: `eq`, `problem` or `figure`."""

    name: str
    place: Place
    of: str = ""


@dataclass(frozen=True)
class TexFormula:
    """A formula of the author: the LaTeX between dollar signs, with its place in the file.

    displayed   whether it has a line of its own
    """

    scalar: Scalar
    displayed: bool = False

    @property
    def tex(self) -> str:
        return " ".join(self.scalar.text.split())

    @property
    def names(self) -> set[str]:
        """The names that the letters of the formula may have, found without parsing it: `I_{zz}` may be `I_zz`."""
        found = _LETTER.findall(self.scalar.text)
        return {f"{base}_{'_'.join(re.findall('[A-Za-z0-9]+', below))}" if below else base for base, below in found}


@dataclass(frozen=True)
class Prose:
    """Text with mentions and formulas; `pieces` is the whole text in order.

    `part(index, width)` returns the `width` characters that begin at `index` in the text, with their place in the file.
    `gap` is the break between paragraphs, which differs between folded and literal text.
    """

    text: str
    place: Place
    part: Callable[[int, int], Scalar] = field(repr=False, compare=False)
    gap: str = "\n"

    def place_within(self, index: int, width: int) -> Place:
        return self.part(index, width).place

    @cached_property
    def pieces(self) -> tuple[str | Mention | TexFormula, ...]:
        pieces: list[str | Mention | TexFormula] = []
        end = 0
        for match in _PIECE.finditer(self.text):
            pieces.append(self.text[end : match.start()])
            pieces.append(self._piece(match))
            end = match.end()
        pieces.append(self.text[end:])
        return tuple(piece for piece in pieces if piece)

    @cached_property
    def paragraphs(self) -> tuple[tuple[str | Mention | TexFormula, ...], ...]:
        found: list[list[str | Mention | TexFormula]] = [[]]
        *pieces, last = self.pieces or ("",)
        for piece in (*pieces, last.rstrip("\n") if isinstance(last, str) else last):
            first, *others = re.split(f"{self.gap}\\s*", piece) if isinstance(piece, str) else [piece]
            found[-1] += [first] if first else []
            found += [[each] if each else [] for each in others]
        return tuple(tuple(each) for each in found if each)

    def _piece(self, match: re.Match[str]) -> str | Mention | TexFormula:
        start, end = match.span()
        if match["dollar"]:
            return "$"
        if match["formula"]:
            return TexFormula(self.part(start + 1, end - start - 2))
        if match["displayed"]:
            return TexFormula(self.part(start + 2, end - start - 4), displayed=True)
        of = PROBLEM if match["problem"] else match["of"] or ""
        return Mention(match["name"] or match["problem"] or "", self.place_within(start, end - start), of)

    @property
    def mentions(self) -> tuple[Mention, ...]:
        return tuple(piece for piece in self.pieces if isinstance(piece, Mention))

    @property
    def formulas(self) -> tuple[TexFormula, ...]:
        return tuple(piece for piece in self.pieces if isinstance(piece, TexFormula))

    @property
    def plain(self) -> str | None:
        """The text if it has no mention and no formula; otherwise None."""
        if any(not match["dollar"] for match in _PIECE.finditer(self.text)):
            return None
        return " ".join(self.text.replace("\\$", "$").split())

    def place_of(self, name: str) -> Place:
        """Return the place where the text first mentions a name; if there is no mention, the place of the text."""
        return next((mention.place for mention in self.mentions if mention.name == name), self.place)


def read_prose(node: Tree, what: str, faults: Faults) -> Prose | None:
    """Return the prose of a node, or None if the node is not text."""
    if not isinstance(node, Scalar):
        message = f"`{what}` must be text, but it is {shape_of(node)}"
        faults.error("wrong-type", message, node.place, help=quotes_needed(node))
        return None
    for match in _PIECE.finditer(node.text):
        if odd := match["odd"]:
            place = node.place_within(match.start(), len(odd))
            faults.error("mention", f"`{abridged(odd)}` is not a mention", place, help=_HOW)
    prose = Prose(node.text, node.place, node.piece, "\n\n" if node.style == "|" else "\n")
    for formula in prose.formulas:
        _check_formula(formula, node.style, faults)
    _check_dollars(node, faults)
    refuse_comment(node, faults)
    return prose


def _check_formula(formula: TexFormula, style: str, faults: Faults) -> None:
    """Report errors that are visible without parsing the formula."""
    inner = formula.scalar
    if inner.empty:
        faults.error("formula-in-prose", "there is no formula between these dollar signs", inner.place, help=_DOLLAR)
    elif len(inner.text) > LONGEST_IN_PROSE:
        message = (
            f"this formula has {len(inner.text)} characters; a formula in prose may have at most {LONGEST_IN_PROSE}"
        )
        faults.error("too-large", message, inner.place_within(0), help="split it into shorter formulas")
    elif (at := inner.text.find("<<")) >= 0:
        help_line = "write the letter itself, or end the formula before the mention"
        faults.error(
            "formula-in-prose", "a formula cannot contain a mention", inner.place_within(at, 2), help=help_line
        )
    elif style == '"' and any(found[1].isalpha() for found in re.finditer(r"\\(.)", inner.raw)):
        message = "in double quotes, YAML reads a `\\` and a letter as one character: `\\t` is a tab"
        faults.error("formula-in-prose", message, inner.place, help="put the text in single quotes, or write `\\\\`")


def _check_dollars(node: Scalar, faults: Faults) -> None:
    """Report the first dollar sign that belongs neither to a formula nor to a price."""
    rest = _PIECE.sub(lambda match: " " * len(match[0]), node.text)
    prices = {i for found in _PRICE.finditer(rest) for i in range(*found.span())}
    lone = next((found.start() for found in re.finditer(r"\$", rest) if found.start() not in prices), None)
    if lone is not None:
        message = "this `$` belongs neither to a formula nor to a price"
        if node.text[lone : lone + 2] == "$$":
            message = "this `$$` does not begin a formula"
        faults.error("formula-in-prose", message, node.place_within(lone), help=_DOLLAR)


def _some_prose(node: Tree, what: str, faults: Faults) -> Prose | None:
    if isinstance(node, Scalar) and node.empty:
        wrong_type(faults, f"`{what}`", "text", node)
    return read_prose(node, what, faults)


def latex_in(prose: Prose) -> Complaint | None:
    """Return a warning about the first LaTeX outside of dollar signs; None if there is none."""
    found = [*_LATEX.finditer(_PIECE.sub(_blanked, prose.text))]
    if not found:
        return None
    start, end = found[0].span()
    if before := re.search(r"<[<%#][^<]*>?$", prose.text[: start + 1]) if prose.text[start] != found[0][0][0] else None:
        start = before.start()  # the power of a mention
    shown = prose.text[start:end]
    notes = (f"{len(found) - 1} more in this text",) * bool(found[1:])
    is_formula = shown == found[0][0] and shown[-1] not in "(["
    return Complaint(
        "latex-in-prose",
        f"LaTeX is read only between dollar signs: `{abridged(shown)}` is printed unchanged",
        prose.place_within(start, end - start),
        notes,
        f"write `${shown}$`" if is_formula else "write a formula between dollar signs: `$x^2$`",
        severity="warning",
    )


def _blanked(match: re.Match[str]) -> str:
    """Replace formulas and dollar signs by blanks, and a mention by letters, because `<<x>>^2` contains LaTeX."""
    return (" " if match["formula"] or match["displayed"] or match["dollar"] else "x") * len(match[0])


PROSE = Reader(TEXT.schema, _some_prose)
PROSE_OR_NOTHING = Reader({"type": [*TEXT.schema["type"], LEFT_EMPTY]}, read_prose)
