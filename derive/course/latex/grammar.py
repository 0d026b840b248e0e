r"""The grammar of a formula: chains of sides, sums, products, factors.

    chain    relation? side (relation side)*         side    sum ("or" sum)?
    sum      sign? product (sign product)*           sign    + - \pm \mp
    product  factor ((\cdot | \times)? factor)* ("/" factor)?    with integral signs and differentials among the factors
    factor   atom power?                             atom    number, letter, fraction, root, function, bracket, matrix

A formula with two possible readings is rejected, such as `a/2b`, `\sin x^2`, `2\frac12`, `U(\theta)`, and `\sin a b` if
both letters are dimensionless. The help of the error shows how to write the formula clearly.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NoReturn

from sympy import Integer, Rational, exp, oo, pi, sqrt

from derive.algebra.dimensions import NUMBER
from derive.course.arithmetic import Term
from derive.course.latex.brackets import Brackets
from derive.course.latex.cursor import Cursor
from derive.course.latex.grids import Grids, TermOrGrid, spanning
from derive.course.latex.integrals import Sign, differential_behind, differential_of, integrated, is_d
from derive.course.latex.letters import letter_at
from derive.course.latex.titles import is_derivative, without_title
from derive.course.latex.tokens import DEEPEST_FORMULA, Argument, Token
from derive.course.latex.vocabulary import FRACTIONS, LATEX_FUNCTIONS, RELATIONS, RELATIONS_IN_PROSE

_TIMES = ("\\cdot", "\\times", "*")
_SIGNS = {"+": (1, 1), "-": (-1, -1), "\\pm": (1, -1), "\\mp": (-1, 1)}


class _Parts:
    """The factors of a product: factors without a sign between them are multiplied first, then dot and cross products
    are taken from left to right."""

    def __init__(self, reader: Grids):
        self.reader = reader
        self.parts: list[TermOrGrid] = []
        self.signs: list[str] = []

    def take(self, factor: TermOrGrid, times: str) -> None:
        if self.parts and not times:
            self.parts[-1] = self.reader.product_of(self.parts[-1], factor, "")
        else:
            self.parts.append(factor)
            self.signs.append(times)

    def product(self) -> TermOrGrid:
        whole = self.parts[0]
        for part, sign in zip(self.parts[1:], self.signs[1:], strict=True):
            whole = self.reader.product_of(whole, part, sign)
        return whole


class Formula(Brackets):
    """Reads one text in one branch of its double signs: `\\pm` is + in the first branch and - in the second branch."""

    branch = 0
    branches = 1  # number of branches of the current side: 2 if it has a double sign

    # -- chains ---------------------------------------------------------------------------------------------------

    def chain(self, cursor: Cursor) -> tuple[list[tuple[list[TermOrGrid], int, Token, Token]], list[str]]:
        """Return the sides, and the relation sign before each side. A side has its alternatives, its number of
        branches, and its first and last token. The first sign is "" if there is none before the first side."""
        without_title(cursor)
        sides, marks = [], [self.relation(cursor) or ""]
        while True:
            first = cursor.token
            self.branches = 1
            alternatives = [self.sum(cursor, 0)]
            while self.alternative(cursor):
                alternatives.append(self.sum(cursor, 0))
            assert first is not None
            if len(alternatives) > 2 or (len(alternatives) == 2 and self.branches == 2):
                self.refuse("latex", "a value can have two branches at most", first.start, first.end)
            sides.append((alternatives, self.branches, first, cursor.before))
            mark = self.relation(cursor)
            if mark is None:
                break
            marks.append(mark)
        if cursor.token:
            self.unexpected(cursor)
        return sides, marks

    def relation(self, cursor: Cursor) -> str | None:
        token = cursor.token
        known = RELATIONS_IN_PROSE if self.in_prose else RELATIONS
        if token and (mark := known.get(cursor.written)):
            cursor.at += 1
            return mark
        return None

    def alternative(self, cursor: Cursor) -> bool:
        token = cursor.token
        if token and token.kind == "command" and token.arguments and token.arguments[0]:
            inside = token.arguments[0].tokens
            if "".join(t.text for t in inside) == "or":
                cursor.at += 1
                return True
        return False

    # -- sums and products ----------------------------------------------------------------------------------------

    def sign(self, cursor: Cursor) -> str | None:
        if cursor.token is None or cursor.written not in _SIGNS:
            return None
        both = _SIGNS[cursor.written]
        if both[0] != both[1]:
            self.branches = 2
        cursor.at += 1
        return "+" if both[self.branch] > 0 else "-"

    def sum(self, cursor: Cursor, depth: int) -> TermOrGrid:
        if depth > DEEPEST_FORMULA:
            here = cursor.token or cursor.before
            self.refuse("too-large", f"this formula is nested more than {DEEPEST_FORMULA} levels deep", here.start)
        first = cursor.token
        sign = self.sign(cursor)
        left = self.product(cursor, depth)
        if sign == "-" and first:
            left = self.minus(left, first.start)
        while sign := self.sign(cursor):
            left = self.sum_of(left, self.product(cursor, depth), sign)
        return left

    def product(self, cursor: Cursor, depth: int) -> TermOrGrid:
        outside, inside = _Parts(self), _Parts(self)
        signs: list[Sign] = []
        alone: Token | None = None  # the previous factor, if it is one token
        while True:
            times = self.times(cursor) if signs or outside.parts else ""
            if cursor.token and any(sign.variable is None for sign in signs):
                cursor.replace(differential_behind(cursor.token, self.d_is_a_letter))
            if self.is_differential(cursor, signs):
                differential_of(self, signs, self.differential(cursor))
            elif cursor.written == "\\int":
                signs.append(self.integral_sign(cursor, depth))
            elif self.begins_factor(cursor):
                first = cursor.at
                factor = self.factor(cursor, depth)
                self.check_side_by_side(alone if not times else None, cursor.tokens[first], factor)
                alone = cursor.before if cursor.at == first + 1 else None
                (inside if signs else outside).take(factor, times)
            elif times:
                self.missing(cursor)
            elif cursor.written == "/":
                divided = inside if signs else outside
                if not divided.parts:
                    self.missing(cursor)
                divided.parts[-1] = self.divided(cursor, depth, divided.parts[-1], signs)
            else:
                break
        if signs:
            one = Term(Integer(1), NUMBER, signs[0].start, signs[-1].end)
            whole = integrated(self, inside.product() if inside.parts else one, signs, outside.parts)
            outside.take(whole, "")
        elif not outside.parts:
            self.missing(cursor)
        return outside.product()

    def times(self, cursor: Cursor) -> str:
        if cursor.token is None or cursor.written not in _TIMES:
            return ""
        cursor.at += 1
        return cursor.before.text if cursor.before.kind == "mark" else f"\\{cursor.before.text}"

    def divided(self, cursor: Cursor, depth: int, above: TermOrGrid, signs: list[Sign]) -> TermOrGrid:
        """Read `a/b`; reject a factor or a `/` after it, because `a/2b` could mean a/(2b) or (a/2)b."""
        slash = cursor.token
        assert slash is not None
        cursor.at += 1
        if not self.begins_factor(cursor):
            self.missing(cursor)
        below = self.factor(cursor, depth)
        following = cursor.token
        if following and not self.is_differential(cursor, signs):
            if self.begins_factor(cursor) or cursor.written in (*_TIMES, "/", "\\int"):
                help_line = "write `\\frac{...}{...}`"
                self.refuse(
                    "ambiguous",
                    "it is not clear where the denominator of this `/` ends",
                    slash.start,
                    slash.end,
                    help_line,
                )
        return self.quotient_of(above, below)

    def check_side_by_side(self, before: Token | None, token: Token, factor: TermOrGrid) -> None:
        """Reject two adjacent numbers, which may be one number, a mixed number or an error. Reject `a2`, which may have
        lost its subscript mark."""
        if before is None:
            return
        if token.kind == "number" and before.kind == "number":
            help_line = "write `\\cdot` between them"
            self.refuse("ambiguous", "two numbers are side by side", before.start, token.end, help_line)
        if token.kind == "number" and before.kind == "letter" and before.end == token.start:
            help_line = f"write `{token.text}{before.text}`, or `{before.text}_{token.text}` for a subscript"
            self.refuse("ambiguous", "a number follows this letter", before.start, token.end, help_line)
        if before.kind == "number" and token.text in FRACTIONS and isinstance(factor, Term):
            if factor.expr.is_number and all(a and all(t.kind == "number" for t in a.tokens) for a in token.arguments):
                help_line = "write `\\cdot` for a product, or one fraction"
                self.refuse("ambiguous", "this could be a mixed number", before.start, token.end, help_line)

    # -- integrals ------------------------------------------------------------------------------------------------

    def integral_sign(self, cursor: Cursor, depth: int) -> Sign:
        sign = cursor.token
        assert sign is not None
        cursor.at += 1
        lower, upper, named = self.limits(cursor, depth, sign)
        return Sign(lower, upper, sign.start, cursor.before.end, named)

    def is_differential(self, cursor: Cursor, signs: list[Sign]) -> bool:
        """Return whether a `d` and a letter follow while an integral lacks its differential; an upright d is never a
        letter."""
        token = cursor.token
        if token is None or all(sign.variable for sign in signs):
            return False
        return is_d(token, self.d_is_a_letter) and letter_at(cursor.following) is not None

    def differential(self, cursor: Cursor) -> Term:
        cursor.at += 1
        letter = self.letter(cursor)
        assert letter is not None
        return letter

    # -- factors --------------------------------------------------------------------------------------------------

    def begins_factor(self, cursor: Cursor) -> bool:
        token = cursor.token
        if token is None:
            return False
        if token.kind == "bar":
            return not cursor.inside_bars
        if token.kind in ("number", "letter", "open", "matrix"):
            return True
        if self.unit_at(cursor) or self.in_prose and token.text == "infty":
            return True
        names = FRACTIONS | {"sqrt", "pi"} | set(LATEX_FUNCTIONS)
        return token.kind == "command" and (token.text in names or letter_at(token) is not None)

    def factor(self, cursor: Cursor, depth: int) -> TermOrGrid:
        base = self.atom(cursor, depth)
        token = cursor.token
        if token and self.is_prime(cursor):
            self.refuse("latex", "primes cannot be read", token.start, help="write what the derivative is equal to")
        if token is None or token.kind != "script":
            return base
        if token.text == "_":
            help_line = "limits are written `_{...}^{...}`"
            self.refuse("latex", "only a letter has a subscript", token.start, token.end, help_line)
        return self.raised_to(base, self.script(cursor), depth, cursor)

    def is_prime(self, cursor: Cursor) -> bool:
        return cursor.written == "'" or (
            cursor.written == "^" and [t.text for t in self.script_ahead(cursor).tokens][:1] == ["prime"]
        )

    def raised_to(self, base: TermOrGrid, script: Argument, depth: int, cursor: Cursor) -> TermOrGrid:
        if [token.text for token in script.tokens] == ["circ"]:
            degrees = self.scalar_in(base, "an angle in degrees")
            if degrees.dimension != NUMBER or not degrees.expr.is_number:
                self.refuse("latex", "only a number has degrees", base.start, base.end)
            return replace(degrees, expr=degrees.expr * pi / 180, end=script.end)
        if cursor.token and cursor.token.kind == "script":
            self.refuse("latex", "this has two powers", cursor.token.start, help="put the first power in brackets")
        exponent = self.scalar_in(self.closed_sum(Cursor.over(script), depth + 1), "an exponent")
        if base is self.euler:
            term = self.applied("exp", exp, exponent, base.start, script.end)
            return term
        return self.power_of(base, replace(exponent, start=script.start, end=script.end))

    def script(self, cursor: Cursor) -> Argument:
        """Read the text after `^` or `_`: a group, or the single token that TeX would take."""
        mark = cursor.token
        assert mark is not None
        cursor.at += 1
        argument = cursor.argument_after(mark, self.text)
        if argument is None or not argument.tokens:
            self.refuse("latex", f"nothing follows `{mark.text}`", mark.start, mark.end)
        bare = self.text[argument.start] != "{" and len(argument.tokens) == 1
        if bare and argument.tokens[0].kind == "number" and len(argument.tokens[0].text) > 1:
            number = argument.tokens[0]
            help_line = f"write `{mark.text}{{{number.text}}}`"
            self.refuse("ambiguous", "only the first digit would be taken by TeX", number.start, number.end, help_line)
        return argument

    def atom(self, cursor: Cursor, depth: int) -> TermOrGrid:
        token = cursor.token
        assert token is not None
        if unit := self.unit_at(cursor):
            return self.unit(unit, cursor)
        if (letter := self.letter_or_axis(cursor)) is not None:
            return letter
        cursor.at += 1
        if token.kind == "number":
            return self.number(token.text, token.start, token.end)
        if token.kind == "matrix":
            return self.matrix(token, depth)
        if token.kind in ("open", "bar"):
            return self.bracketed(cursor, token, depth)
        if token.text == "infty" and self.in_prose:
            return Term(oo, NUMBER, token.start, token.end)
        if token.text == "pi":
            return Term(pi, NUMBER, token.start, token.end)
        if token.text in FRACTIONS:
            self.check_not_a_derivative(token)
            above, below = (self.inside(argument, depth) for argument in token.arguments)
            return spanning(self.quotient_of(above, below), token.start, token.end)
        if token.text == "sqrt":
            return self.root(token, depth)
        return self.function(cursor, token, depth)

    def check_not_a_derivative(self, token: Token) -> None:
        if is_derivative(token) and not self.d_is_a_letter:
            help_line = "transcribe the value that the derivative is equal to"
            self.refuse("latex", "a derivative cannot be read", token.start, token.end, help_line)

    def inside(self, argument: Argument | None, depth: int) -> TermOrGrid:
        assert argument is not None
        value = self.closed_sum(Cursor.over(argument), depth + 1)
        return spanning(value, argument.start, argument.end)

    def closed_sum(self, cursor: Cursor, depth: int) -> TermOrGrid:
        """Read a sum that extends to the last token of the cursor; reject anything after it."""
        value = self.sum(cursor, depth)
        if cursor.token:
            self.unexpected(cursor)
        return value

    def root(self, token: Token, depth: int) -> TermOrGrid:
        degree, radicand = token.arguments
        inner = self.scalar_in(self.inside(radicand, depth), "a radicand")
        if degree is None:
            return self.applied("sqrt", sqrt, inner, token.start, token.end)
        number = self.scalar_in(self.closed_sum(Cursor.over(degree), depth + 1), "the degree of a root")
        if not number.expr.is_Integer or number.expr < 2:
            self.refuse("latex", "the degree of a root must be a whole number, at least 2", degree.start, degree.end)
        exponent = replace(number, expr=Rational(1, number.expr))
        return spanning(self.raised(inner, exponent), token.start, token.end)

    # -- errors ---------------------------------------------------------------------------------------------------

    def unexpected(self, cursor: Cursor) -> NoReturn:
        token = cursor.token
        assert token is not None
        if token.kind in ("cell", "row"):
            self.refuse("latex", "only one formula can be read at a time", token.start, token.end)
        self.refuse("latex", f"`{self.text[token.start : token.end]}` is not expected here", token.start, token.end)

    def missing(self, cursor: Cursor) -> NoReturn:
        token = cursor.token
        if token and cursor.written == "\\partial":
            help_line = "transcribe the value that the derivative is equal to"
            self.refuse("latex", "a derivative cannot be read", token.start, token.end, help_line)
        if token and token.kind in ("cell", "row", "word"):
            self.unexpected(cursor)
        where = f"before `{self.text[token.start : token.end]}`" if token else "at the end"
        start = token.start if token else cursor.end - 1
        self.refuse("latex", f"something is missing {where}", start, token.end if token else None)
