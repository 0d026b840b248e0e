r"""The grammar of a formula: chains of sides, sums, products, factors.

    chain    relation? side (relation side)*         side    sum ("or" sum)?
    sum      sign? product (sign product)*           sign    + - \pm \mp
    product  factor ((\cdot | \times)? factor)* ("/" factor)?    with integral signs and differentials among the factors
    factor   atom power?                             atom    number, letter, fraction, root, function, bracket, matrix

Where paper leaves two readings open, the formula is refused and the help says how to write either: `a/2b`, `\sin a b`
of two numbers, `\sin x^2`, `2\frac12`, `U(\theta)`.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NoReturn

from sympy import Integer, Rational, exp, pi, sqrt

from derive.algebra.dimensions import NUMBER
from derive.course.arithmetic import Term
from derive.course.latex.brackets import Brackets
from derive.course.latex.grids import Grids, Value, between
from derive.course.latex.integrals import Sign, differential_behind, differential_of, integrated, is_d
from derive.course.latex.letters import letter_at
from derive.course.latex.runs import Run
from derive.course.latex.titles import is_derivative, without_title
from derive.course.latex.tokens import MAX_DEPTH, Argument, Token
from derive.course.latex.vocabulary import FRACTIONS, FUNCTIONS, RELATIONS

_TIMES = ("\\cdot", "\\times", "*")
_SIGNS = {"+": (1, 1), "-": (-1, -1), "\\pm": (1, -1), "\\mp": (-1, 1)}


class _Parts:
    """The factors of a product: what stands side by side first, then the dots and crosses from left to right."""

    def __init__(self, reader: Grids):
        self.reader = reader
        self.parts: list[Value] = []
        self.signs: list[str] = []

    def take(self, factor: Value, times: str) -> None:
        if self.parts and not times:
            self.parts[-1] = self.reader.product_of(self.parts[-1], factor, "")
        else:
            self.parts.append(factor)
            self.signs.append(times)

    def product(self) -> Value:
        whole = self.parts[0]
        for part, sign in zip(self.parts[1:], self.signs[1:], strict=True):
            whole = self.reader.product_of(whole, part, sign)
        return whole


class Formula(Brackets):
    """Reads one text in one branch: `\\pm` is + in the first and - in the second."""

    branch = 0
    branches = 1  # how many the side now being read has

    # -- chains ---------------------------------------------------------------------------------------------------

    def chain(self, run: Run) -> tuple[list[tuple[list[Value], int, Token, Token]], list[str]]:
        """The sides, each with its alternatives, branches, first and last token; and the marks before them, or ""."""
        without_title(run)
        sides, marks = [], [self.relation(run) or ""]
        while True:
            first = run.token
            self.branches = 1
            alternatives = [self.sum(run, 0)]
            while self.alternative(run):
                alternatives.append(self.sum(run, 0))
            assert first is not None
            if len(alternatives) > 2 or (len(alternatives) == 2 and self.branches == 2):
                self.refuse("latex", "a value has two branches at most", first.start, first.end)
            sides.append((alternatives, self.branches, first, run.before))
            mark = self.relation(run)
            if mark is None:
                break
            marks.append(mark)
        if run.token:
            self.unexpected(run)
        return sides, marks

    def relation(self, run: Run) -> str | None:
        token = run.token
        if token and (mark := RELATIONS.get(run.written)):
            run.at += 1
            return mark
        return None

    def alternative(self, run: Run) -> bool:
        token = run.token
        if token and token.kind == "command" and token.arguments and token.arguments[0]:
            inside = token.arguments[0].tokens
            if "".join(t.text for t in inside) == "or":
                run.at += 1
                return True
        return False

    # -- sums and products ----------------------------------------------------------------------------------------

    def sign(self, run: Run) -> str | None:
        if run.token is None or run.written not in _SIGNS:
            return None
        both = _SIGNS[run.written]
        if both[0] != both[1]:
            self.branches = 2
        run.at += 1
        return "+" if both[self.branch] > 0 else "-"

    def sum(self, run: Run, depth: int) -> Value:
        if depth > MAX_DEPTH:
            here = run.token or run.before
            self.refuse("too-large", f"this formula is nested more than {MAX_DEPTH} deep", here.start)
        first = run.token
        sign = self.sign(run)
        left = self.product(run, depth)
        if sign == "-" and first:
            left = self.minus(left, first.start)
        while sign := self.sign(run):
            left = self.sum_of(left, self.product(run, depth), sign)
        return left

    def product(self, run: Run, depth: int) -> Value:
        outside, inside = _Parts(self), _Parts(self)
        signs: list[Sign] = []
        alone: Token | None = None  # the factor before, if it is one token
        while True:
            times = self.times(run) if signs or outside.parts else ""
            if run.token and any(sign.variable is None for sign in signs):
                run.replace(differential_behind(run.token, self.d_is_a_letter))
            if self.is_differential(run, signs):
                differential_of(self, signs, self.differential(run))
            elif run.written == "\\int":
                signs.append(self.integral_sign(run, depth))
            elif self.begins_factor(run):
                first = run.at
                factor = self.factor(run, depth)
                self.check_side_by_side(alone if not times else None, run.tokens[first], factor)
                alone = run.before if run.at == first + 1 else None
                (inside if signs else outside).take(factor, times)
            elif times:
                self.missing(run)
            elif run.written == "/":
                divided = inside if signs else outside
                if not divided.parts:
                    self.missing(run)
                divided.parts[-1] = self.divided(run, depth, divided.parts[-1], signs)
            else:
                break
        if signs:
            one = Term(Integer(1), NUMBER, signs[0].start, signs[-1].end)
            whole = integrated(self, inside.product() if inside.parts else one, signs, outside.parts)
            outside.take(whole, "")
        elif not outside.parts:
            self.missing(run)
        return outside.product()

    def times(self, run: Run) -> str:
        if run.token is None or run.written not in _TIMES:
            return ""
        run.at += 1
        return run.before.text if run.before.kind == "mark" else f"\\{run.before.text}"

    def divided(self, run: Run, depth: int, above: Value, signs: list[Sign]) -> Value:
        """`a/b`, where nothing may follow: `a/2b` is a/(2b) to one reader and (a/2)b to the next."""
        slash = run.token
        assert slash is not None
        run.at += 1
        if not self.begins_factor(run):
            self.missing(run)
        below = self.factor(run, depth)
        following = run.token
        if following and not self.is_differential(run, signs):
            if self.begins_factor(run) or run.written in (*_TIMES, "/", "\\int"):
                help_line = "write `\\frac{...}{...}`"
                self.refuse("ambiguous", "it is not clear how far this `/` reaches", slash.start, slash.end, help_line)
        return self.quotient_of(above, below)

    def check_side_by_side(self, before: Token | None, token: Token, factor: Value) -> None:
        """Two numbers side by side are one number, a mixed number or a slip; `a2` is half a subscript."""
        if before is None:
            return
        if token.kind == "number" and before.kind == "number":
            help_line = "write `\\cdot` between them"
            self.refuse("ambiguous", "two numbers stand side by side", before.start, token.end, help_line)
        if token.kind == "number" and before.kind == "letter" and before.end == token.start:
            help_line = f"write `{token.text}{before.text}`, or `{before.text}_{token.text}` for a subscript"
            self.refuse("ambiguous", "a number follows this letter", before.start, token.end, help_line)
        if before.kind == "number" and token.text in FRACTIONS and isinstance(factor, Term):
            if factor.expr.is_number and all(a and all(t.kind == "number" for t in a.tokens) for a in token.arguments):
                help_line = "write `\\cdot` for a product, or one fraction"
                self.refuse("ambiguous", "this could be a mixed number", before.start, token.end, help_line)

    # -- integrals ------------------------------------------------------------------------------------------------

    def integral_sign(self, run: Run, depth: int) -> Sign:
        sign = run.token
        assert sign is not None
        run.at += 1
        lower, upper, named = self.limits(run, depth, sign)
        return Sign(lower, upper, sign.start, run.before.end, named)

    def is_differential(self, run: Run, signs: list[Sign]) -> bool:
        """Whether a `d` and a letter stand here, and an integral waits for them; an upright d is no letter of ours."""
        token = run.token
        if token is None or all(sign.variable for sign in signs):
            return False
        return is_d(token, self.d_is_a_letter) and letter_at(run.following) is not None

    def differential(self, run: Run) -> Term:
        run.at += 1
        letter = self.letter(run)
        assert letter is not None
        return letter

    # -- factors --------------------------------------------------------------------------------------------------

    def begins_factor(self, run: Run) -> bool:
        token = run.token
        if token is None:
            return False
        if token.kind == "bar":
            return not run.inside_bars
        if token.kind in ("number", "letter", "open", "matrix"):
            return True
        names = FRACTIONS | {"sqrt", "pi"} | set(FUNCTIONS)
        return token.kind == "command" and (token.text in names or letter_at(token) is not None)

    def factor(self, run: Run, depth: int) -> Value:
        base = self.atom(run, depth)
        token = run.token
        if token and self.is_prime(run):
            self.refuse("latex", "a prime is not read", token.start, help="transcribe what the derivative is equal to")
        if token is None or token.kind != "script":
            return base
        if token.text == "_":
            help_line = "limits are written `_{...}^{...}`"
            self.refuse("latex", "only a letter has a subscript", token.start, token.end, help_line)
        return self.raised_to(base, self.script(run), depth, run)

    def is_prime(self, run: Run) -> bool:
        return run.written == "'" or (
            run.written == "^" and [t.text for t in self.script_ahead(run).tokens][:1] == ["prime"]
        )

    def raised_to(self, base: Value, script: Argument, depth: int, run: Run) -> Value:
        if [token.text for token in script.tokens] == ["circ"]:
            degrees = self.scalar_in(base, "an angle in degrees")
            if degrees.dimension != NUMBER or not degrees.expr.is_number:
                self.refuse("latex", "only a number has degrees", base.start, base.end)
            return replace(degrees, expr=degrees.expr * pi / 180, end=script.end)
        if run.token and run.token.kind == "script":
            self.refuse("latex", "this has two powers", run.token.start, help="put the first one in brackets")
        exponent = self.scalar_in(self.closed_sum(Run.over(script), depth + 1), "an exponent")
        if base is self.euler:
            term = self.applied("exp", exp, exponent, base.start, script.end)
            return term
        return self.power_of(base, replace(exponent, start=script.start, end=script.end))

    def script(self, run: Run) -> Argument:
        """What stands after `^` or `_`: a group, or the one thing that TeX would take."""
        mark = run.token
        assert mark is not None
        run.at += 1
        argument = run.argument_after(mark, self.text)
        if argument is None or not argument.tokens:
            self.refuse("latex", f"nothing stands after `{mark.text}`", mark.start, mark.end)
        bare = self.text[argument.start] != "{" and len(argument.tokens) == 1
        if bare and argument.tokens[0].kind == "number" and len(argument.tokens[0].text) > 1:
            number = argument.tokens[0]
            help_line = f"write `{mark.text}{{{number.text}}}`"
            self.refuse("ambiguous", "only the first digit would stand there", number.start, number.end, help_line)
        return argument

    def atom(self, run: Run, depth: int) -> Value:
        token = run.token
        assert token is not None
        if (letter := self.letter_or_axis(run)) is not None:
            return letter
        run.at += 1
        if token.kind == "number":
            return self.number(token.text, token.start, token.end)
        if token.kind == "matrix":
            return self.matrix(token, depth)
        if token.kind in ("open", "bar"):
            return self.bracketed(run, token, depth)
        if token.text == "pi":
            return Term(pi, NUMBER, token.start, token.end)
        if token.text in FRACTIONS:
            self.check_not_a_derivative(token)
            above, below = (self.inside(argument, depth) for argument in token.arguments)
            return between(self.quotient_of(above, below), token.start, token.end)
        if token.text == "sqrt":
            return self.root(token, depth)
        return self.function(run, token, depth)

    def check_not_a_derivative(self, token: Token) -> None:
        if is_derivative(token) and not self.d_is_a_letter:
            help_line = "transcribe what it is equal to"
            self.refuse("latex", "a derivative is not read", token.start, token.end, help_line)

    def inside(self, argument: Argument | None, depth: int) -> Value:
        assert argument is not None
        value = self.closed_sum(Run.over(argument), depth + 1)
        return between(value, argument.start, argument.end)

    def closed_sum(self, run: Run, depth: int) -> Value:
        """A sum that is all there is between two braces."""
        value = self.sum(run, depth)
        if run.token:
            self.unexpected(run)
        return value

    def root(self, token: Token, depth: int) -> Value:
        degree, radicand = token.arguments
        inner = self.scalar_in(self.inside(radicand, depth), "what stands under a root")
        if degree is None:
            return self.applied("sqrt", sqrt, inner, token.start, token.end)
        number = self.scalar_in(self.closed_sum(Run.over(degree), depth + 1), "the degree of a root")
        if not number.expr.is_Integer or number.expr < 2:
            self.refuse("latex", "the degree of a root is a whole number from 2", degree.start, degree.end)
        exponent = replace(number, expr=Rational(1, number.expr))
        return between(self.raised(inner, exponent), token.start, token.end)

    # -- what is not there ----------------------------------------------------------------------------------------

    def unexpected(self, run: Run) -> NoReturn:
        token = run.token
        assert token is not None
        if token.kind in ("cell", "row"):
            self.refuse("latex", "one formula is read at a time", token.start, token.end)
        self.refuse("latex", f"`{self.text[token.start : token.end]}` is not expected here", token.start, token.end)

    def missing(self, run: Run) -> NoReturn:
        token = run.token
        if token and run.written == "\\partial":
            help_line = "transcribe what it is equal to"
            self.refuse("latex", "a derivative is not read", token.start, token.end, help_line)
        if token and token.kind in ("cell", "row", "word"):
            self.unexpected(run)
        where = f"before `{self.text[token.start : token.end]}`" if token else "at the end"
        start = token.start if token else run.end - 1
        self.refuse("latex", f"something is missing {where}", start, token.end if token else None)
