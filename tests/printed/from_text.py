"""A line of the text page read back as `derive.render.notation.text` says that it is meant.

    sum       sign? product ((" + " | " - " | " ± ") product)*
    product   run ("·" | "×" | " × ") run ...        from left to right: scalar, dot and cross products
    run       factor (" "? factor | "/" factor)*     from left to right: `1/2 M a` is ((1/2) M) a
    factor    atom power?                            `a²`, `(a + b)^(3/2)`, `a^n`
    atom      number, name, unit, (sum), (a, b, c), |a|, √a, sin a, [F](a..b), d/dt factor, dL/dt, a matrix of lines

A number never stands behind another factor without a dot, and a sign only at the beginning of a sum.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import reduce
from typing import Any

from sympy import (
    Abs,
    E,
    Expr,
    ImmutableDenseMatrix,
    Integer,
    Integral,
    MatrixBase,
    acos,
    asin,
    atan,
    cos,
    cosh,
    exp,
    eye,
    log,
    pi,
    sin,
    sinh,
    sqrt,
    tan,
    tanh,
)

from derive.algebra import expressions as ex
from derive.algebra.expressions import explicit
from derive.course.arithmetic import rational
from derive.render.notation.text import TextBox
from tests.printed.meaning import differentiated, in_unit, over_the_mass, taken_at
from tests.printed.names import Misprint

EULER = r"e(?=\^|[⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺])"  # with its power: a letter e would be in the names
FUNCTIONS: Mapping[str, Any] = {
    "sin": sin, "cos": cos, "tan": tan, "arcsin": asin, "arccos": acos, "arctan": atan, "sinh": sinh, "cosh": cosh,
    "tanh": tanh, "exp": exp, "ln": log,
}  # fmt: skip
RELATIONS = {" = ": "=", " ≈ ": "~", " ≠ ": "!=", " < ": "<", " > ": ">", " ≤ ": "<=", " ≥ ": ">="}
RAISED = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+", strict=True))
NUMBER = re.compile(r"\d+(?:\.\d+)?")
PART_OF_A_NAME = re.compile("[^\\W⁰¹²³⁴⁵⁶⁷⁸⁹]|['\u0307\u0308\u20d7\u20e1]")


class TextReader:
    def __init__(
        self,
        text: str,
        names: Mapping[str, Any],
        units: Iterable[str] = (),
        bound: Iterable[Any] = (),
        positions: list[Any] | None = None,
        sign: int = 1,
    ):
        self.text, self.at, self.sign = text, 0, sign
        known = {"1\u20e1": ImmutableDenseMatrix(eye(3)), **names}
        self.names = dict(sorted(known.items(), key=lambda item: -len(item[0])))
        shown = {unit: "°" if unit in ("deg", "degree") else unit for unit in units}
        self.units = dict(sorted(((text, unit) for unit, text in shown.items()), key=lambda item: -len(item[0])))
        self.bound, self.positions = list(bound), positions or []

    # -- the text ----------------------------------------------------------------------------------------------

    def wrong(self, message: str) -> Misprint:
        return Misprint(f"{message}: {self.text[: self.at]}⟨here⟩{self.text[self.at :]}")

    def ahead(self, *pieces: str) -> str:
        return next((piece for piece in pieces if self.text.startswith(piece, self.at)), "")

    def take(self, *pieces: str) -> str:
        piece = self.ahead(*pieces)
        self.at += len(piece)
        return piece

    def need(self, piece: str) -> None:
        if not self.take(piece):
            raise self.wrong(f"`{piece}` is missing")

    def matched(self, pattern: str) -> re.Match[str] | None:
        found = re.compile(pattern).match(self.text, self.at)
        self.at = found.end() if found else self.at
        return found

    def name_ahead(self) -> str:
        for text in self.names:
            end = self.at + len(text)
            if self.text.startswith(text, self.at) and not PART_OF_A_NAME.match(self.text[end : end + 1] or " "):
                return text
        return ""

    def unit_ahead(self) -> str:
        return next((u for u in self.units if re.compile(re.escape(u) + r"(?!\w)").match(self.text, self.at)), "")

    # -- chains and sums ---------------------------------------------------------------------------------------

    def chain(self) -> tuple[list[Any], list[str]]:
        sides, marks = [self.sum()], []
        while mark := self.take(*RELATIONS):
            marks.append(RELATIONS[mark])
            sides.append(self.sum())
        if self.at < len(self.text):
            raise self.wrong("this is not expected")
        return sides, marks

    def sum(self) -> Any:
        leading = self.take("-", "± ", "±")
        whole = self.signed(leading, self.product())
        while mark := self.take(" + ", " - ", " ± "):
            whole = whole + self.signed(mark.strip(), self.product())
        return whole

    def signed(self, mark: str, value: Any) -> Any:
        return {"-": -1, "±": self.sign}.get(mark.strip(), 1) * value

    # -- products ----------------------------------------------------------------------------------------------

    def product(self) -> Any:
        whole = self.run()
        while mark := self.take("·", " × ", "×"):
            right = self.run()
            vectors = [isinstance(side, MatrixBase) and side.shape == (3, 1) for side in (whole, right)]
            if all(vectors):
                whole = (ex.Dot if mark == "·" else ex.Cross)(whole, right).doit()
            elif any(vectors) and mark == " × ":
                raise self.wrong("a cross between a scalar and a vector")
            else:
                whole = whole * right
        return whole

    def run(self) -> Any:
        if self.ahead("∫"):
            return self.integral()
        whole = self.factor()
        while True:
            before = self.at
            if self.take("/"):
                whole = whole / self.factor()
                continue
            if self.ahead(" + ", " - ", " ± ", " × ", *RELATIONS):
                return whole
            self.take(" ")
            if self.ahead("∫"):
                return self.times(whole, self.integral())
            if not self.begins_factor():
                self.at = before
                return whole
            if NUMBER.match(self.text, self.at) and not self.name_ahead():
                raise self.wrong("a number behind another factor")
            whole = self.times(whole, self.factor())

    def times(self, left: Any, right: Any) -> Any:
        if all(isinstance(side, MatrixBase) and side.shape == (3, 1) for side in (left, right)):
            return left * right.T  # a dyad
        return left * right

    def begins_factor(self) -> bool:
        if self.ahead("(", "[", "√", "∂", "⟦") or NUMBER.match(self.text, self.at):
            return True
        if self.ahead("|"):
            return not self.bars or self.text[self.at - 1] == " "  # a bar that closes follows what it encloses
        return bool(self.name_ahead() or self.unit_ahead() or self.special_ahead())

    bars = 0

    def special_ahead(self) -> bool:
        pattern = rf"(?:{'|'.join(FUNCTIONS)})[⁰¹²³⁴⁵⁶⁷⁸⁹⁻( ]|d[²³]?\S*/d|π|{EULER}"
        return re.compile(pattern).match(self.text, self.at) is not None

    # -- integrals ---------------------------------------------------------------------------------------------

    def integral(self) -> Any:
        """Signs, differentials and factors in any order; each sign reaches to the end of the product."""
        self.need("∫")
        if not self.ahead("("):
            self.need(" ")
            value = self.until_mass()
            return over_the_mass(value, self.positions[0])
        self.need("(")
        lower = self.sum()
        self.need("..")
        upper = self.sum()
        self.need(") ")
        inside: list[Any] = []
        variable: Any = None
        while True:
            start = self.at
            if variable is None and (found := self.differential()) is not None:
                variable = found
            elif self.ahead("∫"):
                inside.append(self.integral())
            elif self.take("/"):
                inside.append(1 / self.factor())
            elif self.begins_factor():
                inside.append(self.factor())
            else:
                self.at = start
                break
            start = self.at
            if self.ahead(" + ", " - ", " ± ", " × ", *RELATIONS):
                break
            self.take("·", " ")
        if variable is None:
            raise self.wrong("an integral without its differential")
        integrand = reduce(self.times, inside, Integer(1))
        return explicit(Integral(integrand, (variable, lower, upper)))

    def differential(self) -> Any:
        if not self.ahead("d"):
            return None
        self.at += 1
        name = self.name_ahead()
        if not name:
            self.at -= 1
            return None
        self.at += len(name)
        return self.names[name]

    def until_mass(self) -> Any:
        value = self.factor()
        while not self.ahead(" dm"):
            self.take(" ")
            value = self.times(value, self.factor())
        self.need(" dm")
        return value

    # -- factors -----------------------------------------------------------------------------------------------

    def factor(self) -> Any:
        base = self.atom()
        if (power := self.power()) is not None:
            if isinstance(base, MatrixBase):
                raise self.wrong("a power of a vector")
            base = base**power
        return self.place_of(base) if self.ahead("|(") and not self.bars else base

    def place_of(self, value: Any) -> Any:
        self.need("|(")
        letter = self.atom()
        self.need(" = ")
        place = self.sum()
        self.need(")")
        return taken_at(value, letter, place)

    def power(self) -> Any:
        if self.take("^("):
            value = self.sum()
            self.need(")")
            return value
        if self.take("^"):
            return self.atom()
        found = self.matched(f"[{''.join(RAISED)}]+")
        return Integer("".join(RAISED[c] for c in found[0])) if found else None

    def atom(self) -> Any:
        if unit := self.unit_ahead():
            self.at += len(unit)
            return in_unit(self.units[unit])
        if name := self.name_ahead():
            self.at += len(name)
            return self.names[name]
        if found := self.matched(NUMBER.pattern):
            return rational(found[0])
        if self.take("π"):
            return pi
        if self.matched(EULER):
            return E
        if found := self.matched(r"(?=[d∂])"):
            return self.derivative()
        if self.take("√"):
            return sqrt(self.atom())
        if self.take("⟦"):
            return self.matrix()
        if self.take("("):
            return self.bracketed()
        if self.take("["):
            return self.between_limits()
        if self.take("|"):
            return self.size()
        if self.matched("(0\u20d7|𝟎)"):
            return ImmutableDenseMatrix.zeros(3, 1)
        for name in sorted(FUNCTIONS, key=len, reverse=True):
            if self.take(name):
                return self.applied(FUNCTIONS[name])
        raise self.wrong("something is missing")

    def applied(self, function: Any) -> Expr:
        power = self.power()
        self.take(" ")
        value = function(self.atom())
        return value if power is None else value**power

    def bracketed(self) -> Any:
        bars, self.bars = self.bars, 0
        values = [self.sum()]
        while self.take(", "):
            values.append(self.sum())
        self.bars = bars
        self.need(")")
        if len(values) > 1 and isinstance(values[0], MatrixBase):
            values = [ImmutableDenseMatrix([list(value) for value in values])]
        elif len(values) > 1:
            values = [ImmutableDenseMatrix(values)]
        if found := self.matched(r"_(body|[xyz])(?!\w)"):
            if found[1] != "body":
                return values[0]["xyz".index(found[1])]
            return values[0].xreplace({s: _in_body(s) for s in values[0].free_symbols})
        return values[0]

    def size(self) -> Expr:
        self.bars += 1
        value = self.sum()
        self.bars -= 1
        self.need("|")
        return sqrt(sum(entry**2 for entry in value)) if isinstance(value, MatrixBase) else Abs(value)

    def between_limits(self) -> Expr:
        inside = self.sum()
        self.need("](")
        lower = self.sum()
        self.need("..")
        upper = self.sum()
        self.need(")")
        (x,) = [letter for letter in self.bound if inside.has(letter)] or [None]
        return inside if x is None else inside.subs(x, upper) - inside.subs(x, lower)

    def matrix(self) -> Any:
        end = self.text.index("⟧", self.at)
        rows = [cells.split(";") for cells in self.text[self.at : end].split("\n")]
        self.at = end + 1
        return ImmutableDenseMatrix([[self.cell(cell) for cell in row] for row in rows])

    def cell(self, text: str) -> Any:
        inner = TextReader(text.strip(), self.names, (), self.bound, self.positions, self.sign)
        inner.units = self.units
        (value,), _ = inner.chain()
        return value

    # -- derivatives -------------------------------------------------------------------------------------------

    def derivative(self) -> Any:
        d = self.take("d", "∂")
        order = self.power() or 1
        what = None if self.ahead("/") else self.factor()
        self.need(f"/{d}")
        name = self.name_ahead()
        if not name and not self.ahead("t"):
            raise self.wrong("a derivative by nothing")
        by = "t" if not name else str(self.names[name])
        self.at += len(name) or 1
        if order != (self.power() or 1):
            raise self.wrong("a derivative of two orders")
        if what is None:
            self.need(" ")
            what = self.factor()
        for _ in range(int(order)):
            what = differentiated(what, by)
        return what


def _in_body(letter: Any) -> Any:
    return type(letter)(letter.name.replace("/d(t)", "/d(t in the body)"), real=True)


def in_one_line(box: TextBox) -> str:
    lines = [_columns(line) for line in box.lines]
    line = lines[box.middle]
    result, at = "", 0
    while at < len(line):
        if line[at] in ("⎛", "⎜", "⎝"):
            result += "("
        elif line[at] in ("⎞", "⎟", "⎠"):
            result += ")"
        elif line[at] in ("⎡", "⎢", "⎣"):
            end = next(i for i in range(at, len(line)) if line[i] in ("⎤", "⎥", "⎦"))
            rows = [other for other in lines if other[at] in ("⎡", "⎢", "⎣")]
            cells = [re.split(r"\s{2,}", "".join(other[at + 1 : end]).strip()) for other in rows]
            result += "⟦" + "\n".join(";".join(row) for row in cells) + "⟧"
            at = end
        else:
            result += line[at]
        at += 1
    return result.rstrip()


def _columns(line: str) -> list[str]:
    return re.findall("[^\u0300-\u036f\u20d0-\u20ff][\u0300-\u036f\u20d0-\u20ff]*", line)


def read_text(
    box: TextBox, names: Mapping[str, Any], units: Iterable[str] = (), bound: Iterable[Any] = (), positions: Any = None
) -> tuple[list[list[Any]], list[str]]:
    text = in_one_line(box)
    branches, marks = [], []
    for sign in (1, -1) if "±" in text else (1,):
        sides, marks = TextReader(text, names, units, bound, positions, sign).chain()
        branches.append(sides)
    return branches, marks
