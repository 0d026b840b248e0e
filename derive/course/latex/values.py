r"""Evaluates the syntax tree of a formula: each node becomes a value with a dimension, in the declared letters.

A formula with two possible readings is rejected: `a/2b`, `\sin x^2`, `2\frac12`, `U(\theta)`, and `\sin a b` if both
letters are dimensionless. The help of the error shows how to write the formula clearly.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, NoReturn

from sympy import Dummy, Integer, Rational, exp, oo, pi, sqrt

from derive.algebra.dimensions import NUMBER
from derive.algebra.expressions import RATES, rate
from derive.algebra.kinds import dimension_of_kind
from derive.course.arithmetic import Declared, Term
from derive.course.latex import integrals
from derive.course.latex.grids import Grid, Grids, TermOrGrid, spanning
from derive.course.latex.vocabulary import FONTS, LATEX_FUNCTIONS, WORDS
from derive.course.yaml_tree import Scalar
from derive.documents.source import Span
from derive.documents.syntax import (
    Abs,
    Add,
    Apply,
    Condition,
    Der,
    Diff,
    EvalBar,
    Frac,
    Fun,
    Group,
    Int,
    Letter,
    Mat,
    Mul,
    Node,
    Num,
    Open,
    Pow,
    Root,
    Sign,
    Sum,
    Text,
    Vec,
)
from derive.errors import Complaint, Rejected, did_you_mean
from derive.units import read_unit

MAX_SIDE = 6  # greatest number of rows or columns of a matrix
MOST_DOTS = len(RATES) - 1
_AXES = {"i": 0, "j": 1, "k": 2, "x": 0, "y": 1, "z": 2}
_SUBSCRIPT = re.compile(r"[A-Za-z0-9_,]+")
_UPRIGHT = re.compile(rf"\\(?:{'|'.join(sorted(FONTS | WORDS))})\s*\{{(?P<word>(?:[^{{}}]|\{{[^{{}}]*\}})*)\}}")
_VARIANT = re.compile(r"\\(?:dot|ddot|dddot|hat|vec|bm|boldsymbol|\{|\s)*\\?(var[a-z]+)")
_NO_BRACES = str.maketrans("", "", "{}")
_DIFFERENTIAL = re.compile(r"(\s|\\[,!])*\\?[A-Za-z]")
COMPONENTS = (("x", "y", "z"), ("1", "2", "3"))


class Letters:
    """The declared names. A name is found by its letter and its subscript."""

    def __init__(self, declared: Mapping[str, Declared]):
        self.declared = declared
        self._names: dict[tuple[str, str], list[str]] = {}
        for name in declared:
            base, _, subscript = name.partition("_")
            self._names.setdefault((base, _bare(subscript)), []).append(name)

    def named(self, base: str, subscript: str) -> Declared | None:
        found = self._names.get((base, _bare(subscript)), [])
        return self.declared[found[0]] if len(found) == 1 else None

    def components(self, base: str, subscript: str) -> tuple[Declared, ...] | None:
        """Return the components of the vector with this name; None if not all three are declared."""
        for names in COMPONENTS:
            found = [self.named(base, f"{subscript}_{name}") for name in names]
            if all(found):
                return tuple(each for each in found if each)
        return None

    def __contains__(self, base: str) -> bool:
        return (base, "") in self._names


def _bare(subscript: str) -> str:
    return subscript.replace("_", "").replace(",", "")


@dataclass(frozen=True)
class _Unit:
    """A unit in prose, as plain text, and the node that it comes from."""

    text: str
    node: Node


class _Parts:
    """The factors of a product. Dot and cross products are formed last."""

    def __init__(self, reader: Grids):
        self.reader = reader
        self.parts: list[TermOrGrid] = []
        self.signs: list[str] = []

    def take(self, factor: TermOrGrid, mark: str) -> None:
        if self.parts and not mark:
            self.parts[-1] = self.reader.product_of(self.parts[-1], factor, "")
        else:
            self.parts.append(factor)
            self.signs.append({"cdot": "\\cdot", "times": "\\times"}.get(mark, mark))

    def product(self) -> TermOrGrid:
        whole = self.parts[0]
        for part, sign in zip(self.parts[1:], self.signs[1:], strict=True):
            whole = self.reader.product_of(whole, part, sign)
        return whole


class Values(Grids):
    """Finds the values of nodes in one branch of the double signs: `\\pm` is + in the first branch and - in the
    second."""

    def __init__(self, scalar: Scalar, letters: Letters, homogeneous: bool, in_prose: bool = False, branch: int = 0):
        super().__init__(scalar, homogeneous)
        self.letters = letters
        self.in_prose = in_prose
        self.branch = branch
        self.branches = 1  # number of branches of the current side: 2 if it has a double sign
        self.d_is_a_letter = "d" in letters
        self.undeclared: list[Complaint] = []

    def of(self, node: Node) -> TermOrGrid:
        method: Callable[[Any], TermOrGrid] = getattr(self, f"of_{type(node).__name__.lower()}")
        return method(node)

    def scalar_of(self, node: Node, what: str) -> Term:
        return self.scalar_in(self.of(node), what)

    def at(self, node: Node, code: str, message: str, help: str | None = None) -> NoReturn:
        self.refuse(code, message, node.span.start, node.span.end, help)

    def written(self, node: Node) -> str:
        return self.text[node.span.start : node.span.end]

    # -- numbers and letters --------------------------------------------------------------------------------------

    def of_num(self, node: Num) -> TermOrGrid:
        return self.number(node.text, node.span.start, node.span.end)

    def of_letter(self, node: Letter) -> TermOrGrid:
        start, end = node.span.start, node.span.end
        if node.base == "pi" and not (node.sub or node.dots or node.marks or node.primes):
            return Term(pi, NUMBER, start, end)
        if node.base == "infty" and self.in_prose:
            return Term(oo, NUMBER, start, end)
        if (unit := self.unit_of(node, False)) is not None:
            return self.size_of_unit(unit)
        if node.label:
            at = self.text.find("^", start)
            message = f"the superscript of `{self.text[start:at].strip()}` is not a power"
            self.refuse("latex", message, at + 1, end)
        declared = self.declared(node)
        is_vector, has_hat = "vec" in node.marks, "hat" in node.marks
        axis = _AXES.get(node.base) if has_hat or (is_vector and node.base in "ijk") else None
        if axis is not None and not node.sub and not node.dots and (declared is None or has_hat):
            one, zero = (Term(Integer(n), NUMBER, start, end) for n in (1, 0))
            return Grid(tuple((one if i == axis else zero,) for i in range(3)), start, end)
        if has_hat:
            self.at(node, "latex", f"`{self.written(node)}` is a unit vector that cannot be read")
        if node.primes:
            at = min(i for i in (self.text.find(each, start) for each in ("'", "^")) if i >= 0)
            self.refuse("latex", "primes cannot be read", at, help="write what the derivative is equal to")
        if not self.in_prose and (declared is None or is_vector):
            components = self.letters.components(node.base, node.sub)
            if components is not None:
                terms = [self.term_of(node, each) for each in components]
                return Grid(tuple((term,) for term in terms), start, end)
        if declared is None:
            self.undeclared.append(self.not_declared(node))
            self.homogeneous = False  # the letter's dimension is unknown, so dimensions are not compared from here on
            return Term(Dummy(node.base, real=True), NUMBER, start, end)
        if is_vector:
            self.vectors.append(start)
        return self.term_of(node, declared)

    def declared(self, node: Letter) -> Declared | None:
        variant = _VARIANT.match(self.text, node.span.start)
        found = self.letters.named(variant[1], node.sub) if variant else None
        return found or self.letters.named(node.base, node.sub)

    def term_of(self, node: Letter, declared: Declared) -> Term:
        """Return the declared symbol with its dimension, or the rate of this symbol if the letter has dots."""
        symbol, dimension, start, end = declared.symbol, declared.dimension, node.span.start, node.span.end
        if not node.dots:
            self.dimensions[symbol] = dimension
            return Term(symbol, dimension, start, end, kind=declared.kind)
        if node.dots + next(n for n in (3, 2, 1, 0) if symbol.name.endswith(RATES[n])) > MOST_DOTS:
            help_line = "declare a letter for this rate"
            self.at(node, "latex", f"the order of this rate is higher than {MOST_DOTS}", help_line)
        symbol, dimension = rate(symbol, node.dots), dimension / dimension_of_kind("time") ** node.dots
        self.dimensions[symbol] = dimension
        return Term(symbol, dimension, start, end)

    @property
    def help_for_unit(self) -> str | None:
        return None if self.in_prose else "write the unit of a value under `in:`"

    def not_declared(self, node: Letter) -> Complaint:
        written, start, end = self.written(node), node.span.start, node.span.end
        if not _SUBSCRIPT.fullmatch(node.sub or "x"):
            at = self.text.find("_", start) + 1
            message = f"the subscript of `{self.text[start : at - 1].strip()}` is not a name"
            return self.complaint("latex", message, at, end, None)
        if len(node.base) > 1 and written.startswith(tuple(f"\\{font}" for font in FONTS)):
            message = f"`{node.base}` is not declared"
            return self.complaint("undeclared-symbol", message, start, end, self.help_for_unit)
        name = (f"{node.base}_{node.sub}" if node.sub else node.base).replace(",", "_")
        if self.in_prose and name == "d" and _DIFFERENTIAL.match(self.text, end):
            message = "a differential is read only with its integral sign"
            return self.complaint("latex", message, start, end, None)
        help_line = did_you_mean(name, self.letters.declared) or "declare it under `symbols:`"
        if name in ("d", "e"):
            rest = "its exponent, `e^{...}`" if name == "e" else "the whole derivative or integral"
            help_line = f"declare it under `symbols:`, or write {rest}"
        return self.complaint("undeclared-symbol", f"`{name}` is not declared", start, end, help_line)

    # -- words and units ------------------------------------------------------------------------------------------

    def of_text(self, node: Text) -> TermOrGrid:
        if (unit := self.unit_of(node, False)) is not None:
            return self.size_of_unit(unit)
        if node.text == "degrees":
            self.at(node, "latex", "a degree sign is allowed only after a number")
        if node.text == "partial":
            help_line = "transcribe the value that the derivative is equal to"
            self.at(node, "latex", "a derivative cannot be read", help_line)
        if node.text.startswith("unit "):
            message = f"`{node.text.removeprefix('unit ')}` is not declared"
            self.at(node, "undeclared-symbol", message, self.help_for_unit)
        if _UPRIGHT.match(self.text, node.span.start):
            self.at(node, "latex", "words are not part of a formula")
        self.at(node, "latex", f"`{self.written(node)}` is not expected here")

    def unit_of(self, node: Node, after_number: bool) -> _Unit | None:
        r"""Return a node as a unit, `\mathrm{m/s^2}` or `\text{ kg}`; None if the node is not a unit.

        Units are read only in prose.
        """
        inner, power = (node.base, self.written(node.exponent)) if isinstance(node, Pow) else (node, "")
        if not self.in_prose or not isinstance(inner, Letter | Text | Open):
            return None
        found = _UPRIGHT.match(self.text, inner.span.start)
        if found is None or found.end() < inner.span.end:
            return None
        word = inner.text if isinstance(inner, Text) and inner.text.startswith("unit ") else found["word"]
        text = re.sub(r"\\[, ]|~", " ", word.removeprefix("unit ").translate(_NO_BRACES)).strip()
        if text in self.letters.declared and not after_number:
            return None
        text += f"^{power.translate(_NO_BRACES)}" if power else ""
        try:
            read_unit(text)
        except Rejected:
            return None
        return _Unit(text, node)

    def size_of_unit(self, unit: _Unit) -> Term:
        read = read_unit(unit.text)
        return Term(read.factor, read.dimension, unit.node.span.start, unit.node.span.end)

    # -- sums and products ----------------------------------------------------------------------------------------

    def of_add(self, node: Add) -> TermOrGrid:
        whole: TermOrGrid | None = None
        for sign, term in node.terms:
            if sign in "±∓":
                self.branches = 2
                sign = "+-"[self.branch] if sign == "±" else "-+"[self.branch]
            value = self.of(term)
            if whole is not None:
                whole = self.sum_of(whole, value, sign)
            else:
                whole = self.minus(value, node.span.start) if sign == "-" else value
        assert whole is not None
        return whole

    def of_mul(self, node: Mul) -> TermOrGrid:
        parts = _Parts(self)
        for number, (mark, factor) in enumerate(node.factors):
            before = node.factors[number - 1][1] if number else None
            if before is not None:
                self.check_side_by_side(before, mark, factor)
            if isinstance(factor, Int):
                parts.take(self.integral(factor, parts.parts), mark)
            elif (unit := self.unit_of(factor, isinstance(before, Num))) is not None:
                parts.take(self.size_of_unit(unit), mark)
            else:
                parts.take(self.of(factor), mark)
        return parts.product()

    def check_side_by_side(self, before: Node, mark: str, factor: Node) -> None:
        """Reject adjacent factors whose meaning is unclear, such as two numbers, or `a/b` followed by a factor."""
        span = before.span.to(factor.span)
        if _is_slashed(before, self.text):
            self.unclear_slash(before)
        last = before.exponent if isinstance(before, Pow) else before
        power, factor = factor, factor.base if isinstance(factor, Pow) else factor
        touches = not mark and isinstance(factor, Num) and last.span.end == factor.span.start
        if touches and isinstance(last, Num) and isinstance(before, Pow):
            self.only_first_digit(last.span.start, factor.span.end)
        if touches and isinstance(before, Letter) and before.sub and self.text[factor.span.start - 1].isdigit():
            self.only_first_digit(factor.span.start - 1, factor.span.end)
        if mark:
            return
        if isinstance(before, Num) and isinstance(factor, Num) and power is factor:
            help_line = "write `\\cdot` between them"
            self.refuse("ambiguous", "two numbers are side by side", span.start, span.end, help_line)
        if touches and isinstance(before, Letter) and isinstance(factor, Num) and self.written(before) == before.base:
            help_line = f"write `{factor.text}{before.base}`, or `{before.base}_{factor.text}` for a subscript"
            self.refuse("ambiguous", "a number follows this letter", span.start, span.end, help_line)
        if isinstance(before, Num) and is_fraction_of_numbers(factor) and power is factor:
            help_line = "write `\\cdot` for a product, or a single fraction"
            self.refuse("ambiguous", "this could be a mixed number", span.start, span.end, help_line)
        if isinstance(before, Fun) and not self.has_brackets(before):
            is_unit = self.unit_of(power, True) is not None
            if isinstance(before.argument, Num) and (is_unit or isinstance(factor, Group)):
                self.unclear_argument(before)
            if is_fraction_of_numbers(factor) and power is factor:
                self.may_be_a_part(before.argument, factor.span.end)

    def only_first_digit(self, start: int, end: int) -> NoReturn:
        help_line = f"write `{self.text[start - 1]}{{{self.text[start:end]}}}`"
        self.refuse("ambiguous", "only the first digit would be taken by TeX", start, end, help_line)

    def of_group(self, node: Group) -> TermOrGrid:
        return spanning(self.of(node.inner), node.span.start, node.span.end)

    def of_frac(self, node: Frac) -> TermOrGrid:
        if _is_slashed(node, self.text):
            if _is_slashed(node.top, self.text):
                self.unclear_slash(node.top)
            unit = self.unit_of(node.bottom, True)
            below = self.size_of_unit(unit) if unit is not None else self.of(node.bottom)
        else:
            below = spanning(self.of(node.bottom), *self.braces(node.bottom))
        return spanning(self.quotient_of(self.of(node.top), below), node.span.start, node.span.end)

    def braces(self, node: Node) -> tuple[int, int]:
        start, end = node.span.start, node.span.end
        before, after = self.text[:start].rstrip(), self.text[end:].lstrip()
        if before.endswith("{") and after.startswith("}"):
            return len(before) - 1, len(self.text) - len(after) + 1
        return start, end

    def unclear_slash(self, fraction: Node) -> NoReturn:
        frac = fraction if isinstance(fraction, Frac) else None
        start = fraction.span.start if frac is None else frac.top.span.end
        at = self.text.find("/", start)
        message = "it is not clear where the denominator of this `/` ends"
        self.refuse("ambiguous", message, at, at + 1, "write `\\frac{...}{...}`")

    def of_pow(self, node: Pow) -> TermOrGrid:
        if (unit := self.unit_of(node, True)) is not None:
            return self.size_of_unit(unit)
        base = node.base
        if isinstance(base, Group) and base.brackets == "{":
            return self.of(_with_power_at_the_end(base.inner, node.exponent))
        exponent = self.scalar_of(node.exponent, "an exponent")
        place = replace(exponent, start=self.braces(node.exponent)[0], end=self.braces(node.exponent)[1])
        if isinstance(base, Letter) and self.is_euler(base):
            return self.applied("exp", exp, exponent, node.span.start, node.span.end)
        return self.power_of(self.of(base), place)

    def is_euler(self, node: Letter) -> bool:
        """Return whether the base of a power is the number e."""
        return self.written(node) == "e" and self.declared(node) is None

    def of_root(self, node: Root) -> TermOrGrid:
        inner = self.scalar_of(node.inner, "a radicand")
        start, end = node.span.start, node.span.end
        if node.index is None:
            return self.applied("sqrt", sqrt, inner, start, end)
        number = self.scalar_of(node.index, "the degree of a root")
        if not number.expr.is_Integer or number.expr < 2:
            self.at(node.index, "latex", "the degree of a root must be a whole number, at least 2")
        return spanning(self.raised(inner, replace(number, expr=Rational(1, number.expr))), start, end)

    # -- functions ------------------------------------------------------------------------------------------------

    def of_fun(self, node: Fun) -> TermOrGrid:
        if node.name == "degrees":
            degrees = self.scalar_of(node.argument, "an angle in degrees")
            if degrees.dimension != NUMBER or not degrees.expr.is_number:
                self.at(node.argument, "latex", "a degree sign is allowed only after a number")
            return replace(degrees, expr=degrees.expr * pi / 180, end=node.span.end)
        if node.base is not None:
            self.at(node.base, "latex", f"`\\{node.name}` cannot have a subscript")
        if node.name not in LATEX_FUNCTIONS:
            self.at(node, "latex", f"`{node.name}` cannot be read")
        return self.of_function(node, self.argument_of(node))

    def of_function(self, node: Fun, inner: Term) -> TermOrGrid:
        power = self.power_of_function(node)
        value = self.applied(node.name, LATEX_FUNCTIONS[node.name], inner, node.span.start, node.span.end)
        return self.power_of(value, power) if power else value

    def power_of_function(self, node: Fun) -> Term | None:
        if node.power is None:
            return None
        if node.power.span.start > node.argument.span.start:  # `\sin(x)^2`
            self.unclear_power(node.argument, node.power)
        power = self.scalar_of(node.power, "an exponent")
        if power.expr.is_negative:
            inverse = f"`\\arc{node.name}` or " if f"arc{node.name}" in LATEX_FUNCTIONS else ""
            help_line = f"write {inverse}`1/\\{node.name}`"
            start, end = self.braces(node.power)
            self.refuse("ambiguous", "this could be the inverse function", start, end, help_line)
        return power

    def unclear_power(self, argument: Node, power: Node) -> NoReturn:
        message = "this power could belong to the function or to its argument"
        start, caret = argument.span.start, self.text.rfind("^", argument.span.start, power.span.start)
        start -= self.text[:start].endswith("(")
        self.refuse("ambiguous", message, start, caret + 1, "write `\\sin^2 x` or `\\sin(x^2)`")

    def has_brackets(self, node: Fun) -> bool:
        between = self.text[node.span.start : node.argument.span.start].rstrip()
        return between.endswith(("(", "[", "{", "|")) or isinstance(node.argument, Group | Vec | Abs)

    def argument_of(self, node: Fun) -> Term:
        if self.has_brackets(node):
            inner = self.scalar_of(node.argument, "the argument of a function")
            start, end = node.argument.span.start, node.argument.span.end
            around = self.text[start - 1 : start] == "(" and self.text[end : end + 1] == ")"
            if isinstance(node.argument, Num) and self.text[start - 1 : start] == "{":  # braces are not printed
                self.unclear_argument(node)
            return replace(inner, start=start - around, end=end + around)
        argument = node.argument
        if isinstance(argument, Add):  # `\sin -\theta`
            self.unclear_argument(node)
        if isinstance(argument, Pow):
            self.unclear_power(argument.base, argument.exponent)
        if _is_slashed(argument, self.text):
            assert isinstance(argument, Frac)
            end = self.text.find("/", argument.top.span.end) + 1
            self.may_be_a_part(argument.top, end)
        if isinstance(argument, Open) and argument.kind == "apply":  # `\sin\theta(t)`
            self.unclear_argument(node)
        inner = self.scalar_of(node.argument, "the argument of a function")
        if self.homogeneous and inner.dimension != NUMBER:
            self.unclear_argument(node)
        return inner

    def unclear_argument(self, node: Fun) -> NoReturn:
        message = f"the argument of `\\{node.name}` is not clear"
        self.at(node.argument, "ambiguous", message, "put it in brackets")

    def may_be_a_part(self, argument: Node, end: int) -> NoReturn:
        message = f"`{self.written(argument)}` could be only a part of the argument"
        help_line = "put the argument in brackets"
        self.refuse("ambiguous", message, argument.span.start, end, help_line)

    def open_argument(self, node: Open) -> TermOrGrid:
        r"""Read a function whose argument has no brackets. The argument is the shortest run of factors that is
        dimensionless and not a plain number."""
        shortest_first = list(reversed(node.alternatives))
        for number, alternative in enumerate(shortest_first):
            fun, rest = _function_first(alternative)
            told, homogeneous = len(self.undeclared), self.homogeneous
            inner = self.scalar_of(fun.argument, "the argument of a function")
            fits = inner.dimension == NUMBER and not (inner.expr.is_number and not inner.expr.has(pi))
            if not fits and number + 1 < len(shortest_first):
                del self.undeclared[told:]
                self.homogeneous = homogeneous
                continue
            if not fits and self.homogeneous:
                self.unclear_argument(fun)
            if rest and self.is_a_number(rest[0]):
                self.may_be_a_part(fun.argument, rest[0].span.end)
            parts = _Parts(self)
            parts.take(self.of_function(fun, inner), "")
            for each in rest:
                parts.take(self.of(each), "")
            return parts.product()
        raise AssertionError(node.kind)

    def is_a_number(self, node: Node) -> bool:
        told, homogeneous = len(self.undeclared), self.homogeneous
        value = self.of(node)
        del self.undeclared[told:]
        self.homogeneous = homogeneous
        return isinstance(value, Term) and value.dimension == NUMBER

    # -- what can be read in several ways -------------------------------------------------------------------------

    def of_open(self, node: Open) -> TermOrGrid:
        if node.kind == "extent":
            return self.open_argument(node)
        if node.kind == "slash":
            product = node.alternatives[0]
            assert isinstance(product, Mul)
            self.unclear_slash(product.factors[0][1])
        if node.kind == "word":
            return self.word(node)
        if node.kind == "apply":
            return self.call_or_product(node)
        if node.kind == "superscript":
            first, second = node.alternatives
            return self.of(second if isinstance(first, Fun) else first)
        if not self.d_is_a_letter and node.kind == "letter d":
            product = node.alternatives[1]
            assert isinstance(product, Mul)
            return self.of(product)
        return self.of(node.alternatives[1])

    def word(self, node: Open) -> TermOrGrid:
        r"""Read a word such as `\mathit{mass}` as one letter, or as a product if only its single letters are
        declared."""
        name, product = node.alternatives
        assert isinstance(name, Letter) and isinstance(product, Mul)
        if (unit := self.unit_of(node, False)) is not None:
            return self.size_of_unit(unit)
        letters = [each for _, each in product.factors if isinstance(each, Letter)]
        if self.declared(name) is None and all(self.declared(each) for each in letters):
            return spanning(self.of_mul(product), node.span.start, node.span.end)
        if self.written(node).startswith(tuple(f"\\{word}" for word in WORDS)):
            self.at(node, "latex", "words are not part of a formula")
        return self.of_letter(name)

    def call_or_product(self, node: Open) -> TermOrGrid:
        """Read a product such as `a(b + c)`; reject `U(\\theta)`, which could be a function."""
        call, product = node.alternatives
        while isinstance(call, Pow | EvalBar):
            call = call.base if isinstance(call, Pow) else call.inner
        if isinstance(call, Apply) and isinstance(call.arguments[0], Letter):
            help_line = "write a product without brackets, and a function without its argument"
            end = self.text.find(")", call.arguments[0].span.end) + 1
            whole = self.text[node.span.start : end]
            self.refuse("ambiguous", f"`{whole}` could be a function", node.span.start, end, help_line)
        return self.of(product)

    def of_apply(self, node: Apply) -> TermOrGrid:
        if isinstance(node.arguments[0], Condition):
            self.at(node.arguments[0], "latex", f"`{self.written(node.arguments[0])}` is not expected here")
        values = [self.of(each) for each in node.arguments]
        return self.product_of(self.of(node.head), self.triple(values, node), "")

    # -- brackets and bars ----------------------------------------------------------------------------------------

    def of_abs(self, node: Abs) -> TermOrGrid:
        return self.size_of(self.of(node.inner), node.span.start, node.span.end)

    def of_vec(self, node: Vec) -> TermOrGrid:
        return self.triple([self.of(each) for each in node.entries], node)

    def triple(self, values: list[TermOrGrid], node: Node) -> Grid:
        entries = tuple((self.scalar_in(value, "a component"),) for value in values)
        if len(entries) != 3:
            self.at(node, "shape", f"a vector has 3 components, but this has {len(entries)}")
        return Grid(entries, node.span.start, node.span.end)

    def of_mat(self, node: Mat) -> TermOrGrid:
        if node.determinant and any(len(row) > 1 for row in node.rows):
            self.at(node, "shape", "a determinant cannot be read")
        if max(len(node.rows), *map(len, node.rows)) > MAX_SIDE:
            self.at(node, "shape", f"a matrix has at most {MAX_SIDE} rows and {MAX_SIDE} columns")
        if len({len(row) for row in node.rows}) > 1:
            told = ", ".join(str(len(row)) for row in node.rows)
            self.at(node, "shape", f"rows of {told} entries do not make a matrix")
        if any(isinstance(cell, Text) and not cell.text for row in node.rows for cell in row):
            self.at(node, "shape", "an entry of this matrix is empty")
        entries = tuple(tuple(self.scalar_of(cell, "an entry") for cell in row) for row in node.rows)
        start, end = node.span.start, node.span.end
        whole = entries[0][0] if len(entries) == len(entries[0]) == 1 else Grid(entries, start, end)
        return self.size_of(whole, start, end) if node.determinant else whole

    def of_evalbar(self, node: EvalBar) -> TermOrGrid:
        if node.lower is None and node.upper is None:
            self.at(node, "latex", "limits are missing after this bar")
        inner = self.of(node.inner)
        lower, upper, named = self.limits(node.lower, node.upper, node)
        end = max(self.braces(each)[1] for each in (node.lower, node.upper) if each is not None)
        return integrals.bracket_of(self, inner, lower, upper, named, end)

    def limits(self, lower: Node | None, upper: Node | None, node: Node) -> tuple[Term, Term, Term | None]:
        """Return the two limits, and the variable if the lower limit names it: `_{z=0}^{z=h}`."""
        if lower is None or upper is None:
            missing = "_" if lower is None else "^"
            self.at(node, "integral", f"the limit after `{missing}` is missing")
        (start, named), (end, _) = self.limit(lower), self.limit(upper)
        return start, end, named

    def limit(self, node: Node) -> tuple[Term, Term | None]:
        if isinstance(node, Text):
            self.at(node, "integral", "this limit cannot be read")
        if not isinstance(node, Condition):
            return replace(self.scalar_of(node, "a limit"), start=node.span.start, end=node.span.end), None
        if not isinstance(node.left, Letter):
            self.at(node.left, "latex", "the variable of an integral is one letter")
        named = self.scalar_of(node.left, "a variable")
        return self.scalar_of(node.right, "a limit"), named

    # -- integrals ------------------------------------------------------------------------------------------------

    def of_int(self, node: Int) -> TermOrGrid:
        return self.integral(node, [])

    def integral(self, node: Int, outside: list[TermOrGrid]) -> TermOrGrid:
        """Return the value of a product with integral signs; `outside` contains the factors before the first sign."""
        signs: list[integrals.Sign] = []
        inside = _Parts(self)
        for item in node.items:
            if isinstance(item, Sign):
                lower, upper, named = self.limits(item.lower, item.upper, item)
                ends = [each.span.end for each in (item.lower, item.upper) if each is not None]
                signs.append(integrals.Sign(lower, upper, item.span.start, max(ends), named))
            elif isinstance(item, Diff):
                self.differential(item, signs, inside)
            else:
                inside.take(self.of(item), "")
        one = Term(Integer(1), NUMBER, signs[0].start, signs[-1].end)
        return integrals.integrated(self, inside.product() if inside.parts else one, signs, outside)

    def differential(self, node: Diff, signs: list[integrals.Sign], inside: _Parts) -> None:
        if not isinstance(node.of, Letter) or node.order != 1:
            self.at(node, "integral", "a differential must be `d` and one letter, such as `dx`")
        d_end = node.span.start + 1
        plain = self.text[node.span.start : d_end] == "d"
        if plain and (self.d_is_a_letter or all(sign.variable for sign in signs)):
            inside.take(self.of(Letter(Span(node.span.start, d_end), "d")), "")
            inside.take(self.of(node.of), "")
            return
        if all(sign.variable for sign in signs):
            self.at(node, "integral", "there are more differentials than integral signs")
        integrals.differential_of(self, signs, self.scalar_of(node.of, "a variable"))

    # -- what is not read -----------------------------------------------------------------------------------------

    def of_der(self, node: Der) -> NoReturn:
        if is_dotted(node):
            self.at(node, "latex", "a dot is allowed only over a letter")
        self.at(node, "latex", "a derivative cannot be read", "transcribe the value that the derivative is equal to")

    def of_diff(self, node: Diff) -> NoReturn:
        self.at(node, "latex", "a differential is read only with its integral sign")

    def of_sum(self, node: Sum) -> NoReturn:
        self.at(node, "latex", "a sum over an index cannot be read", "write its terms")

    def of_condition(self, node: Condition) -> NoReturn:
        self.at(node, "latex", f"`{self.written(node)}` is not expected here")


def _with_power_at_the_end(node: Node, exponent: Node) -> Node:
    """Return `{ab}^2` as `ab^2`, because the braces of a group are not printed."""
    if isinstance(node, Mul):
        mark, last = node.factors[-1]
        return replace(node, factors=(*node.factors[:-1], (mark, _with_power_at_the_end(last, exponent))))
    if isinstance(node, Add):
        sign, last = node.terms[-1]
        return replace(node, terms=(*node.terms[:-1], (sign, _with_power_at_the_end(last, exponent))))
    return Pow(node.span.to(exponent.span), node, exponent)


def _is_slashed(node: Node, text: str) -> bool:
    return isinstance(node, Frac) and "/" in text[node.top.span.end : node.bottom.span.start]


def is_fraction_of_numbers(node: Node) -> bool:
    return isinstance(node, Frac) and isinstance(node.top, Num) and isinstance(node.bottom, Num)


def is_dotted(node: Der) -> bool:
    r"""Return whether a derivative is written with dots, as in `\dot{ab}`."""
    (by, _), *_ = node.by
    return by.span.start == node.span.start


def _function_first(node: Node) -> tuple[Fun, list[Node]]:
    if isinstance(node, Fun):
        return node, []
    assert isinstance(node, Mul)
    (_, fun), *rest = node.factors
    assert isinstance(fun, Fun)
    return fun, [each for _, each in rest]
