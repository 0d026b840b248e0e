"""The layout of a formula quoted in LaTeX, so that a terminal shows it like the formulas of a page.

A quoted formula may contain errors, so it is laid out without interpretation: fractions, roots, indices, and letters
in the order in which they are printed. `course/latex/quoting.py` has checked that every command is known and correctly
nested.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import accumulate

from derive.course.latex.quoting import Quoted, quoted
from derive.course.latex.vocabulary import (
    ALIGNMENTS,
    ARROW_COMMANDS,
    BOLD_COMMANDS,
    DOTS,
    FONTS,
    FRACTIONS,
    GREEK_COMMANDS,
    LATEX_FUNCTIONS,
    MATRICES,
    RELATIONS,
)
from derive.render.notation.layout import (
    ACCENTS,
    DEGREE_SIGN,
    SIGNS,
    THIN_SPACE,
    Applied,
    Array,
    Bracketed,
    Digits,
    Fenced,
    Fraction,
    IntegralSign,
    Layout,
    Lowered,
    Name,
    Operator,
    Raised,
    RootSign,
    Row,
    Sign,
    Upright,
    row,
)
from derive.render.notation.text import in_one_line

DEEPEST = 40  # greatest depth of nested braces; a deeper formula is printed unchanged
_TOKEN = re.compile(r"\\text\{[^{}]*\}|\\[A-Za-z]+|\\.|\d+(?:\.\d+)?|.", re.DOTALL)
_KINDS = {"=": "equals", "<": "less", ">": "greater", "<=": "at_most", ">=": "at_least", "!=": "unequal", "~": "approx"}
_OPERATORS = {
    **{mark: _KINDS[meaning] for mark, meaning in RELATIONS.items()},
    **{"+": "plus", "-": "minus", "\\cdot": "dot", "\\times": "cross", "\\pm": "plus_minus", ",": "comma"},
    **{"/": "stroke", "\\to": "tends"},
}
_UPRIGHT = {"\\partial": "partial", "\\circ": "°", "\\min": "min", "\\max": "max", "\\lim": "lim"}
_PRIMES = (Sign("prime"), Upright("'"))
_OTHER_LETTERS = {"imath": "i", "jmath": "j"}
_OPENING = {"(": "(", "[": "[", "\\{": "{", "\\lbrace": "{", "|": "|", "\\lvert": "|", "\\|": "|"}
_CLOSING = frozenset([")", "]", "\\}", "\\rbrace", "|", "\\rvert", "\\|", "."])
_NOTHING = Row(())


def in_plain_text(text: str) -> str:
    """Return prose with formulas between dollar signs as plain text for a terminal."""
    return "".join(_formula(piece) if piece.is_formula else piece.text for piece in quoted(text))


def _formula(piece: Quoted) -> str:
    depths = [0]
    for brace in re.findall(r"[{}]", piece.text):
        depths.append(depths[-1] + (1 if brace == "{" else -1))
    return in_one_line(layout_of_latex(piece.text)) if max(depths) <= DEEPEST else piece.text


def layout_of_latex(tex: str) -> Layout:
    """Return the layout of one formula that contains only quotable commands."""
    return _Reader(_TOKEN.findall(tex)).whole()


class _Reader:
    def __init__(self, tokens: Sequence[str]):
        self.tokens = [token for token in tokens if token.strip() and token not in ("~", "\\ ")]
        self.at = 0

    @property
    def next(self) -> str:
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def taken(self) -> str:
        token = self.next
        self.at += 1
        return token

    def whole(self) -> Layout:
        found: list[Layout] = []
        while self.next:
            found.append(self.until(lambda token: False))
            if self.next:
                self.at += 1
        return row(*found)

    def until(self, ends: Callable[[str], bool]) -> Layout:
        items: list[Layout] = []
        while self.next and not ends(self.next):
            item = self.scripted(self.atom())
            if item == Upright("'") and items and isinstance(items[-1], Name):
                items[-1] = replace(items[-1], base=f"{items[-1].base}'")
                continue
            if _is_of_letters(item) and items and isinstance(items[-1], Name):
                items.append(Operator("start"))  # U(x) is a function, so no space follows U
            word = item.base if isinstance(item, Raised) else item
            if isinstance(word, Upright) and word.text[:1].isalpha() and items and _ends_in_number(items[-1]):
                items.append(THIN_SPACE)  # between a number and its unit
            if item == Upright("d") and any(isinstance(each, IntegralSign) for each in items[:-1]):
                items.append(THIN_SPACE)  # between an integrand and its differential
            items += [] if item is None else [item]
        return row(*items) if items else _NOTHING

    def group(self) -> Layout:
        if self.next != "{":
            if len(self.next) > 1 and self.next[0].isdigit():  # TeX takes one digit: \frac12 is 1/2
                self.tokens[self.at : self.at + 1] = [self.next[0], self.next[1:]]
            return (self.atom() or _NOTHING) if self.next else _NOTHING
        self.at += 1
        inside = self.until("}".__eq__)
        self.at += 1
        return inside

    def atom(self) -> Layout | None:
        token = self.taken()
        if token.startswith("\\text{"):
            word = token[len("\\text{") : -1].strip()
            # A number after a word is not a factor: it belongs to the word.
            return Upright(f"{word} {self.taken()}" if self.next[:1].isdigit() else word)
        command = token.removeprefix("\\") if token.startswith("\\") else ""
        if token == "{":
            self.at -= 1
            return self.group()
        if token in _OPERATORS:
            return Operator(_OPERATORS[token])
        if token == ")":
            return Operator("close")
        if token in _UPRIGHT:
            return Upright(_UPRIGHT[token])
        if command in SIGNS:
            return Sign(command)
        if token in _OPENING and token != "|":
            return self.fenced(token)
        if token[0].isdigit():
            return Digits(token)
        if not command:
            return self.letter(token) if token.isalpha() else None if token in "&}^_" else Upright(token)
        if command in GREEK_COMMANDS | {"pi", "infty"} | _OTHER_LETTERS.keys():
            return Name(_OTHER_LETTERS.get(command, command.removeprefix("var")))
        return self.applied(command)

    def letter(self, token: str) -> Layout:
        """Return a letter; a d before another letter is the sign of a differential."""
        before_letter = re.fullmatch(r"[A-Za-z]|\\[a-zA-Z]+", self.next) and self.next[1:] not in ("right", "end")
        return Upright("d") if token == "d" and before_letter else Name(token)

    def applied(self, command: str) -> Layout | None:
        """Return a command with its arguments, or None for a command that only sets spacing."""
        if command in FRACTIONS:
            return Fraction(self.group(), self.group())
        if command == "sqrt":
            return self.root()
        if command in DOTS:
            return _named(self.group(), dots=DOTS[command])
        if command in ARROW_COMMANDS | BOLD_COMMANDS:
            return _named(self.group(), style="vector")
        if command in ACCENTS:
            return _named(self.group(), accent=command)
        if command in FONTS:
            return self.words()
        if command in LATEX_FUNCTIONS:
            return self.function(command)
        if command == "int":
            lower, upper = self.scripts()
            return IntegralSign(lower, upper)
        if command == "left":
            return self.fenced(self.taken()) if self.next else None
        if command == "begin":
            return self.environment()
        return Upright(";") if command == "\\" else None

    def root(self) -> Layout:
        degree: Layout | None = None
        if self.next == "[":
            self.at += 1
            degree = self.until("]".__eq__)
            self.at += 1
        return RootSign(self.group(), degree)

    def words(self) -> Layout:
        """Return the argument of a command for upright text."""
        rest = self.tokens[self.at :]
        depths = list(accumulate({"{": 1, "}": -1}.get(token, 0) for token in rest))
        end = depths.index(0) + 1 if 0 in depths else 0
        text = "".join({"\\,": " ", "{": "", "}": ""}.get(token, token) for token in rest[:end]).strip()
        if re.fullmatch(r"[A-Za-z0-9 /^-]+", text):
            self.at += end
            return Upright(text)
        return self.group()

    def function(self, name: str) -> Layout:
        """Return a function with its argument."""
        _, power = self.scripts()
        if not self.next or self.next in _OPERATORS or self.next in _CLOSING | {"}"}:
            return Upright(name)
        argument = self.scripted(self.atom()) or _NOTHING
        if isinstance(argument, Digits) and re.fullmatch(r"[A-Za-z]|\\[a-z]+", self.next):
            argument = Fenced(row(argument, self.scripted(self.atom()) or _NOTHING))
        return Applied(name, argument, power)

    def scripts(self) -> tuple[Layout | None, Layout | None]:
        """Return the subscript and the superscript, either of which may be None."""
        found: dict[str, Layout] = {}
        while self.next in ("_", "^") and self.next not in found:
            sign = self.taken()
            found[sign] = self.group()
        return found.get("_"), found.get("^")

    def scripted(self, base: Layout | None) -> Layout | None:
        below, above = self.scripts()
        if base is None or below is None and above is None:
            return base
        if isinstance(base, Fenced) and below is not None and above is not None:
            return Bracketed(base.inside, below, above)
        if below is not None:
            subscript = _subscript(below)
            base = replace(base, subscript=subscript) if isinstance(base, Name) and subscript else Lowered(base, below)
        if above is None:
            return base
        if above in _PRIMES and isinstance(base, Name):
            return replace(base, base=f"{base.base}'")
        return row(base, DEGREE_SIGN) if above == Upright("°") else Raised(base, above)

    def fenced(self, opening: str) -> Layout:
        inside = self.until(lambda token: token in _CLOSING | {"\\right", "}", "&", "\\\\", "\\end"})
        self.at += self.next == "\\right"
        if self.next not in _CLOSING:
            return row(Operator("open"), inside)
        self.at += 1
        return inside if isinstance(inside, Array) else Fenced(inside, _OPENING.get(opening, "("))

    def environment(self) -> Layout:
        """Return the rows of a matrix, or aligned lines one after the other."""
        name = self.braced()
        if name == "array" and self.next == "{":
            self.braced()
        rows: list[list[Layout]] = [[]]
        while self.next and self.next != "\\end":
            rows[-1].append(self.until(lambda token: token in {"&", "\\\\", "\\end"}))
            if self.next == "\\\\":
                rows.append([])
            self.at += self.next != "\\end"
        self.at += 1
        self.braced()
        if name in ALIGNMENTS or name not in MATRICES:
            return row(*[item for line in rows for item in (Upright(";"), *line)][1:])
        filled = [line for line in rows if line]
        columns = max(map(len, filled), default=0)
        return Array(tuple((*line, *(_NOTHING,) * (columns - len(line))) for line in filled)) if columns else _NOTHING

    def braced(self) -> str:
        """Return the plain text of an argument in braces."""
        found = ""
        if self.next == "{":
            end = self.tokens.index("}", self.at)
            found, self.at = "".join(self.tokens[self.at + 1 : end]), end + 1
        return found


def _ends_in_number(item: Layout) -> bool:
    """Return whether an item is a number or a power of a number: 9.8, 10^{11}."""
    return isinstance(item.base if isinstance(item, Raised) else item, Digits)


def _is_of_letters(item: Layout | None) -> bool:
    """Return whether a layout is a list of letters or numbers in brackets, as the arguments of a function: (r, t)."""
    if not isinstance(item, Fenced) or item.kind != "(":
        return False
    arguments = item.inside.items if isinstance(item.inside, Row) else (item.inside,)
    lone = all(isinstance(each, Name | Digits) for each in arguments[::2])
    return bool(arguments) and lone and all(each == Operator("comma") for each in arguments[1::2])


def _named(inside: Layout, dots: int = 0, style: str = "", accent: str = "") -> Layout:
    if not isinstance(inside, Name):
        return inside
    style, accent = style or inside.style, accent or inside.accent
    return replace(inside, dots=inside.dots + dots, style=style, accent=accent)


def _subscript(below: Layout) -> str:
    """Return a subscript as the text in a `Name`: letters, digits and commas, or one Greek letter; else ""."""
    if isinstance(below, Name) and not below.subscript:
        return below.base
    text = in_one_line(below).replace(" ", "")
    return text if re.fullmatch(r"[A-Za-z0-9,]+", text) else ""
