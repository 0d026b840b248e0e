r"""Letters and functions in a formula: the meaning of a name, and where the argument of a function ends.

Without brackets, an argument is the shortest run of factors that is an angle or a number and contains a letter, `\pi`
or degrees: `\sin 2\theta`, `\cos\theta M g`, `\sin\omega t`. If there is no such run, as in `\sin 2`, the argument is
all factors before the next sign. If the next factor could also belong to the argument, the formula is rejected.
"""

from __future__ import annotations

import re
from abc import abstractmethod
from dataclasses import replace

from sympy import Dummy, E, Integer, pi

from derive.algebra.dimensions import NUMBER
from derive.course.arithmetic import Term
from derive.course.latex.cursor import Cursor
from derive.course.latex.grids import Grid, Grids, TermOrGrid
from derive.course.latex.letters import MOST_DOTS, Letter, Letters, dots_of, letter_at, subscript_of, term_of
from derive.course.latex.tokens import Argument, Token
from derive.course.latex.vocabulary import FONTS, FRACTIONS, LATEX_FUNCTIONS, WORDS
from derive.course.yaml_tree import Scalar
from derive.errors import Complaint, Rejected, did_you_mean
from derive.units import read_unit

_SPACES = re.compile(r"\\[, ]|~")
_NO_BRACES = str.maketrans("", "", "{}")
_DIFFERENTIAL = re.compile(r"(\s|\\[,!])*\\?[A-Za-z]")


class Functions(Grids):
    """The base class of `Formula` for letters and functions; `Formula` defines `atom`, `script`, `inside`,
    `raised_to`."""

    def __init__(self, scalar: Scalar, letters: Letters, homogeneous: bool, in_prose: bool = False):
        super().__init__(scalar, homogeneous)
        self.in_prose = in_prose
        self.letters = letters
        self.d_is_a_letter = "d" in letters
        self.undeclared: list[Complaint] = []
        self.euler = Term(E, NUMBER, 0, 0)

    # -- letters --------------------------------------------------------------------------------------------------

    def letter_or_axis(self, cursor: Cursor) -> TermOrGrid | None:
        letter = self.read_letter(cursor)
        if letter is None:
            return None
        declared = self.letters.named(letter)
        if letter.axis is not None and (declared is None or letter.hat):
            one, zero = (Term(Integer(n), NUMBER, letter.start, letter.end) for n in (1, 0))
            return Grid(tuple((one if i == letter.axis else zero,) for i in range(3)), letter.start, letter.end)
        if declared is None and letter.name == "e" and cursor.written == "^":
            self.euler = replace(self.euler, start=letter.start, end=letter.end)
            return self.euler
        if letter.hat:
            what = self.text[letter.start : letter.end]
            self.refuse("latex", f"`{what}` is a unit vector that cannot be read", letter.start, letter.end)
        self.check_not_a_function(letter, cursor)
        return self.value_of(letter)

    def letter(self, cursor: Cursor) -> Term | None:
        letter = self.read_letter(cursor)
        return None if letter is None else self.value_of(letter)

    def value_of(self, letter: Letter) -> Term:
        declared = self.letters.named(letter)
        if declared is None:
            self.undeclared.append(self.not_declared(letter))
            self.homogeneous = False  # the letter's dimension is unknown, so dimensions are no longer compared
            return Term(Dummy(letter.name, real=True), NUMBER, letter.start, letter.end)
        if dots_of(letter, declared) > MOST_DOTS:
            message = f"a letter has at most {MOST_DOTS} dots"
            self.refuse("latex", message, letter.start, letter.end, help="declare a letter for this rate")
        term = term_of(letter, declared)
        if letter.vector:
            self.vectors.append(letter.start)
        self.dimensions[term.expr] = term.dimension
        return term

    def read_letter(self, cursor: Cursor) -> Letter | None:
        token = cursor.token
        letter = letter_at(token)
        if token is None or letter is None:
            if token and token.kind == "command" and token.text in WORDS | FONTS:
                self.refuse("latex", "words are not part of a formula", token.start, token.end)
            return None
        cursor.at += 1
        if cursor.written != "_" or letter.subscript:
            return letter
        below = self.script(cursor)
        subscript = subscript_of(below.tokens)
        if subscript is None:
            message = f"the subscript of `{self.text[letter.start : letter.end]}` is not a name"
            self.refuse("latex", message, below.start, below.end)
        return replace(letter, subscript=subscript, end=below.end)

    def not_declared(self, letter: Letter) -> Complaint:
        written = self.text[letter.start : letter.end]
        if len(letter.base) > 1 and written.startswith(tuple(f"\\{font}" for font in FONTS)):
            message, help_line = f"`{letter.base}` is not declared", "write the unit of a value under `in:`"
            return self.complaint("undeclared-symbol", message, letter.start, letter.end, help_line)
        name = letter.name.replace(",", "_")
        if self.in_prose and name == "d" and _DIFFERENTIAL.match(self.text, letter.end):
            message = "a differential is read only with its integral sign"
            return self.complaint("latex", message, letter.start, letter.end, None)
        help_line = did_you_mean(name, self.letters.declared) or "declare it under `symbols:`"
        if letter.name in ("d", "e"):
            rest = "its exponent, `e^{...}`" if letter.name == "e" else "the whole derivative or integral"
            help_line = f"declare it under `symbols:`, or write {rest}"
        return self.complaint("undeclared-symbol", f"`{name}` is not declared", letter.start, letter.end, help_line)

    def check_not_a_function(self, letter: Letter, cursor: Cursor) -> None:
        r"""Reject `U(\theta)`, which looks like a function: a product is not written as `a(b)`."""
        three = cursor.tokens[cursor.at : cursor.at + 3]
        if len(three) == 3 and three[0].text == "(" and three[2].text == ")" and letter_at(three[1]):
            whole = self.text[letter.start : three[2].end]
            help_line = "leave out the brackets, both for a product and for a function"
            self.refuse("ambiguous", f"`{whole}` could be a function", letter.start, three[2].end, help_line)

    def named_as_a_whole(self, cursor: Cursor, first: int) -> Term | None:
        r"""Read `\left(I_z\right)_{disc}` as the letter `I_z_disc`; return None if the brackets contain more than a
        letter, or if the subscript is a limit."""
        inner = Cursor(cursor.tokens[first : cursor.at - 1], cursor.before.start)
        letter = self.read_letter(inner)
        at = cursor.at
        below = self.script(cursor)
        subscript = subscript_of(below.tokens)
        if letter is None or inner.token or subscript is None or cursor.written == "^":
            cursor.at = at
            return None
        joined = f"{letter.subscript}_{subscript}" if letter.subscript else subscript
        return self.value_of(replace(letter, subscript=joined, end=below.end))

    # -- units ----------------------------------------------------------------------------------------------------

    def unit_at(self, cursor: Cursor) -> str:
        r"""Return the unit at the cursor, `\mathrm{m/s^2}` or `\text{ kg}`, as plain text; "" without a unit.

        Units are read only in prose. An upright word that is also a declared letter is a unit only after a number.
        """
        token = cursor.token
        if not self.in_prose or token is None or token.kind != "command" or token.text not in FONTS | WORDS:
            return ""
        inside = token.arguments[0]
        text = _SPACES.sub(" ", self.text[inside.start : inside.end].translate(_NO_BRACES)).strip() if inside else ""
        is_letter = text in self.letters.declared and not (cursor.at and cursor.before.kind == "number")
        return "" if is_letter or self.size_of_unit(text, token) is None else text

    def size_of_unit(self, text: str, token: Token) -> Term | None:
        try:
            unit = read_unit(text)
        except Rejected:
            return None
        return Term(unit.factor, unit.dimension, token.start, token.end)

    def unit(self, text: str, cursor: Cursor) -> Term:
        r"""Return the size in the SI of the unit at the cursor. A power after it, as in `\text{m/s}^2`, belongs to the
        last factor of the unit."""
        token = cursor.token
        assert token is not None
        cursor.at += 1
        if cursor.written == "^":
            text += "^" + "".join(each.text for each in self.script(cursor).tokens)
        size = self.size_of_unit(text, token)
        if size is None:
            self.refuse("latex", f"`{text}` is not a unit", token.start, cursor.before.end)
        return size

    # -- functions ------------------------------------------------------------------------------------------------

    def function(self, cursor: Cursor, token: Token, depth: int) -> TermOrGrid:
        name = token.text
        if name not in LATEX_FUNCTIONS:
            self.refuse("latex", f"`\\{name}` is not expected here", token.start, token.end)
        power = self.power_of_function(cursor, token, depth)
        inner = self.in_brackets(cursor, depth) if self.opens(cursor) else self.without_brackets(cursor, token, depth)
        value = self.applied(name, LATEX_FUNCTIONS[name], inner, token.start, inner.end)
        return self.power_of(value, power) if power else value

    def power_of_function(self, cursor: Cursor, token: Token, depth: int) -> Term | None:
        if cursor.written != "^":
            return None
        script = self.script(cursor)
        power = self.scalar_in(self.inside(script, depth), "an exponent")
        if power.expr.is_negative:
            help_line = f"write `\\arc{token.text}`, or `1/\\{token.text}`"
            self.refuse("ambiguous", "this could be the inverse function", script.start, script.end, help_line)
        return power

    def opens(self, cursor: Cursor) -> bool:
        return cursor.token is not None and cursor.token.kind == "open" and cursor.token.text in ("(", "[")

    def in_brackets(self, cursor: Cursor, depth: int) -> Term:
        inner = self.scalar_in(self.atom(cursor, depth), "the argument of a function")
        self.check_power(cursor, inner)
        return inner

    def check_power(self, cursor: Cursor, inner: Term) -> None:
        if cursor.written == "^":
            token = cursor.token
            assert token is not None
            message = "this power could belong to the function or to its argument"
            self.refuse("ambiguous", message, inner.start, token.end, "write `\\sin^2 x` or `\\sin(x^2)`")

    def without_brackets(self, cursor: Cursor, function: Token, depth: int) -> Term:
        argument: Term | None = None
        while self.is_plain(cursor.token):
            argument, complete = self.longer(argument, cursor, depth)
            if complete:
                break
        if argument is None:
            place = cursor.token or function
            message = f"the argument of `\\{function.text}` is missing"
            self.refuse("latex", message, place.start, place.end)
        unfit = self.homogeneous and argument.dimension != NUMBER
        if unfit or (self.opens(cursor) and self.is_only_a_number(argument)):
            message = f"the argument of `\\{function.text}` is not clear"
            self.refuse("ambiguous", message, argument.start, argument.end, "put it in brackets")
        self.check_end(cursor, argument, depth)
        return argument

    def longer(self, argument: Term | None, cursor: Cursor, depth: int) -> tuple[Term, bool]:
        """Return the argument with one more factor, and whether the argument is now complete."""
        factor = self.scalar_in(self.atom(cursor, depth), "the argument of a function")
        degrees = cursor.written == "^" and [t.text for t in self.script_ahead(cursor).tokens] == ["circ"]
        if degrees:
            value = self.raised_to(factor, self.script(cursor), depth, cursor)
            factor = self.scalar_in(value, "an angle in degrees")
        else:
            self.check_power(cursor, factor)
        argument = factor if argument is None else self.multiplied(argument, factor)
        return argument, degrees or (argument.dimension == NUMBER and not self.is_only_a_number(argument))

    def script_ahead(self, cursor: Cursor) -> Argument:
        at = cursor.at
        script = self.script(cursor)
        cursor.at = at
        return script

    def is_plain(self, token: Token | None) -> bool:
        r"""Return whether a token may be part of an argument without brackets: a number, a letter, `\pi` or a
        fraction."""
        if token is None:
            return False
        return token.kind == "number" or token.text in FRACTIONS | {"pi"} or letter_at(token) is not None

    def is_only_a_number(self, term: Term) -> bool:
        return bool(term.expr.is_number) and not term.expr.has(pi)

    def check_end(self, cursor: Cursor, argument: Term, depth: int) -> None:
        """Reject an argument if the next factor or a `/` could also belong to the argument."""
        token = cursor.token
        if token is None:
            return
        unclear = cursor.written == "/"
        if self.is_plain(token) and not (token.kind == "letter" and token.text == "d" and not self.d_is_a_letter):
            at, told = cursor.at, len(self.undeclared)
            following = self.atom(cursor, depth)
            cursor.at = at
            del self.undeclared[told:]
            unclear = isinstance(following, Term) and following.dimension == NUMBER
        if unclear:
            message = f"`{self.shown(argument)}` could be only a part of the argument"
            self.refuse("ambiguous", message, argument.start, token.end, "put the argument in brackets")

    # -- given by the grammar ---------------------------------------------------------------------------------------

    @abstractmethod
    def atom(self, cursor: Cursor, depth: int) -> TermOrGrid:
        """Read the next factor."""

    @abstractmethod
    def script(self, cursor: Cursor) -> Argument:
        """Read what follows `^` or `_`."""

    @abstractmethod
    def inside(self, argument: Argument | None, depth: int) -> TermOrGrid:
        """Read the contents of an argument."""

    @abstractmethod
    def raised_to(self, base: TermOrGrid, script: Argument, depth: int, cursor: Cursor) -> TermOrGrid:
        """Return the value raised to the exponent."""
