"""From expressions to textbook layout: 13/12 M a^2, not 13 M a^2/12; dots for rates; masses before lengths.

The engine, which checks the lines, decides which terms are collected, which are one fraction, and what is multiplied
out (`derive.algebra.tidy`, `derive.algebra.collect`). This module, with `products`, `order` and `binding`, decides the
printed form of a line for all formats, such as the order of terms and factors. `latex` and `text` write the layout.

`Notation` contains the only data that depend on a problem: the dimensions, which determine the order of symbols.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from sympy import (
    Abs,
    Add,
    Derivative,
    Expr,
    Function,
    Identity,
    Integral,
    MatAdd,
    MatMul,
    MatrixBase,
    MatrixSymbol,
    Mul,
    Pow,
    Rational,
    Symbol,
    exp,
    fraction,
    oo,
    pi,
)
from sympy.core.function import AppliedUndef
from sympy.core.numbers import Exp1, ImaginaryUnit, Pi

from derive.algebra import expressions as ex
from derive.algebra.amplitudes import Amplitudes, Determinant
from derive.algebra.dimensions import Dimension
from derive.algebra.expansion import Approach, Expansion, FirstOrder
from derive.algebra.ordered_roots import OrderedRoot
from derive.algebra.period_series import SwingTime, SwingTimeOfNumbers
from derive.algebra.rounding import Rounded, decimal_text
from derive.course.transcript import Transcript
from derive.render.notation.binding import Binding, binding, sign_apart, signed, within
from derive.render.notation.layout import (
    CROSS,
    DEGREE_SIGN,
    INNER,
    MINUS,
    PLUS,
    THIN_SPACE,
    Applied,
    Array,
    Bracketed,
    Digits,
    Evaluated,
    Fenced,
    Fraction,
    IntegralSign,
    Layout,
    Lowered,
    Name,
    Operator,
    Raised,
    RootSign,
    Upright,
    begins_with_number,
    holds_fraction,
    layout_of_name,
    row,
    separator_of,
)
from derive.render.notation.order import holds_rates, ordered_factors, ordered_terms
from derive.render.notation.products import (
    Place,
    between_factors,
    decimal,
    gathered,
    number_and_letters,
    present,
    rank_of_dimension,
    root_cancelled,
    rounded_number,
    side_by_side,
    sign_and_size,
    under_one_root,
    unit_behind_number,
)


def _swings(factor: Expr) -> bool:
    """Return whether a factor contains a function of time, such as the sine in v/omega sin(omega t)."""
    return any(each.has(ex.TIME) for each in factor.atoms(Function))


def _is_root_of_quadratic(total: Expr, below: int) -> bool:
    """Return whether a sum divided by `below` looks like the quadratic formula: (b + sqrt(b^2 + c^2))/2.

    The sum must have two terms. If both terms are numbers, at least one of them must have a square root. In all other
    cases exactly one term must be a root of a sum, with a coefficient that is not a multiple of `below`. So the result
    is false for sqrt(b^2 + c^2) + b/2.
    """
    roots = [term for term in total.args if _has_root(term)]
    if len(total.args) != 2 or total.is_number:
        return len(total.args) == 2 and roots != []
    return len(roots) == 1 and bool(roots[0].has(Add)) and roots[0].as_coeff_Mul()[0] % below != 0


def _has_root(term: Expr) -> bool:
    return any(factor.is_Pow and factor.exp == Rational(1, 2) for factor in Mul.make_args(term))


PRINTED_NAMES = {"acos": "arccos", "asin": "arcsin", "atan": "arctan", "log": "ln"}


class Notation:
    """The layout of any expression of the engine.

    dimensions   dimensions of symbols, which determine the order of factors, such as masses before lengths
    flat         whether vectors are printed as lists of components instead of columns, for a short page
    language     the words and signs of formulas in the language of the page (`labels.language` of its phrases)
    """

    def __init__(
        self,
        dimensions: Mapping[Any, Dimension | None] | None = None,
        flat: bool = False,
        language: Mapping[str, str] | None = None,
    ):
        self.known_dimensions, self.flat = dimensions or {}, flat
        self.language = language or {}
        self._places = {str(letter): n for n, letter in enumerate(self.known_dimensions)}
        self._known: dict[Any, Layout] = {}  # a cache: all formats of a page need the same layouts
        self._results: dict[Any, Layout] = {}

    @property
    def sign(self) -> str:
        """Return the decimal sign."""
        return "," if self.language.get("decimal") == "comma" else "."

    def layout(self, expr: Any) -> Layout:
        if expr not in self._known:
            self._known[expr] = self._worked_out(expr)
        return self._known[expr]

    def _worked_out(self, expr: Any) -> Layout:
        if isinstance(expr, MatrixBase):
            return self._matrix(expr)
        if isinstance(expr, Transcript):
            from derive.render.notation.from_latex import layout_of_latex  # needed by few problems

            laid_out = layout_of_latex(expr.tex)
            return laid_out if laid_out != row() else Upright("")
        sign, size = sign_and_size(expr)
        if sign:
            return signed(sign, self.layout(size))
        for kinds, method in self._methods:
            if isinstance(expr, kinds):
                return method(self, expr)
        if isinstance(expr, Function):
            return self._function(expr)
        raise TypeError(f"no notation for {type(expr).__name__}")

    def result(self, expr: Any) -> Layout:
        """Return a result with its common factor in front; a tuple of components becomes a list."""
        if isinstance(expr, tuple):
            return self.list_of(expr)
        if expr not in self._results:
            self._results[expr] = self.layout(expr if isinstance(expr, Transcript) else present(expr))
        return self._results[expr]

    def list_of(self, components: tuple[Any, ...]) -> Layout:
        """Return a list such as (1, 1, 0)."""
        shown = [self.layout(component) for component in components]
        between = separator_of(shown)
        return Fenced(row(*[item for each in shown for item in (between, each)][1:]))

    # --- sums and products ---

    def _sum(self, expr: Any) -> Layout:
        if isinstance(expr, Add):
            content, rest = expr.primitive()
            in_sums = any(f.is_Add for term in rest.args for f in Mul.make_args(term))
            if content != 1 and content.q == 1 and not holds_rates(expr) and not in_sums:
                return self._factors([content, rest])  # 4(b^2 + c^2), not 4 b^2 + 4 c^2
            if content.p == 1 and content.q != 1 and _is_root_of_quadratic(rest, content.q):
                return Fraction(self._terms(self._ordered_terms(rest)), Digits(str(content.q)))
        return self._terms(list(expr.args) if isinstance(expr, ex.Terms) else self._ordered_terms(expr))

    def _ordered_terms(self, expr: Add) -> list[Expr]:
        return ordered_terms(expr, self._places)

    def _terms(self, terms: list[Any]) -> Layout:
        items: list[Layout] = []
        for term in terms:
            sign, size = sign_apart(self.layout(term))
            if items or sign:
                items.append(sign or PLUS)
            items.append(within(size, Binding.OPEN))
        return row(*items)

    def _product(self, expr: Expr) -> Layout:
        above, below = fraction(gathered(expr), exact=expr.has(exp))  # e^(-t) remains in the numerator
        if expr.is_number and (rooted := under_one_root(expr)):
            return self._factors(rooted)
        number_above, letters_above = number_and_letters(above)
        number_below, letters_below = number_and_letters(below)
        number_above, number_below = root_cancelled(number_above, number_below)
        if letters_below:
            bottom = self._factors([*number_below, *self._ordered(letters_below)])
            behind = [f for f in self._ordered(letters_above) if holds_fraction(self.layout(f))]
            if not below.has(ex.TIME):
                behind += [f for f in self._ordered(letters_above) if _swings(f) and f not in behind]
            top = self._factors([*number_above, *self._ordered([f for f in letters_above if f not in behind])])
            return row(Fraction(top, bottom), *map(self._as_factor, behind)) if behind else Fraction(top, bottom)
        letters = self._ordered(letters_above)
        if number_below and len(letters) == 1 and isinstance(letters[0], ex.Amount):
            letters = [ex.Group(letters[0])]
        if not number_below:
            return self._factors([*number_above, *letters])
        if not all(f.is_Rational for f in number_below) and not any(isinstance(f, Add) for f in letters):
            return Fraction(self._factors([*number_above, *letters]), self._factors(number_below))
        if letters and not number_above and self._is_letter_before_functions(letters):
            return self._factors_behind(Fraction(self.layout(letters[0]), self._factors(number_below)), letters[1:])
        if letters and number_above[1:] == [pi]:  # 4/3 pi a^3, but pi/4 a^2
            number_above, letters = number_above[:1], [*number_above[1:], *letters]
        number = Fraction(self._factors(number_above), self._factors(number_below))
        behind = [self._as_factor(each) for each in letters] if len(letters) == 1 else [self._factors(letters)]
        return row(number, *(within(each, Binding.OPEN) for each in behind)) if letters else number

    def _is_letter_before_functions(self, letters: list[Expr]) -> bool:
        """Return whether the factors, divided by a number such as 2, are written a/2 or a/2 sin x, not 1/2 M a^2.

        The first factor must be a letter without dots, and the others must be functions. If there are others, the
        letter must be a length, or its dimension must be unknown.
        """
        first, *others = (self.layout(letter) for letter in letters)
        is_function = all(isinstance(other, Applied) for other in others)
        dimension = self.known_dimensions.get(letters[0])
        is_length = dimension is None or rank_of_dimension(dimension) is Place.LENGTH
        fits = isinstance(first, Name) and first.style == "scalar" and not first.dots and is_function
        return fits and (is_length or not others)

    def _factors_behind(self, first: Layout, others: list[Expr]) -> Layout:
        return side_by_side([first, *(self._as_factor(other) for other in others)]) if others else first

    def _ordered(self, factors: list[Expr]) -> list[Expr]:
        return ordered_factors(factors, self.known_dimensions.get, self._places)

    def _factors(self, factors: list[Any]) -> Layout:
        if not factors:
            return Digits("1")
        if len(factors) == 1:
            return self.layout(factors[0])
        *before, last = factors
        return side_by_side([*(self._as_factor(f, Binding.DOTTED) for f in before), self._as_factor(last)])

    def _as_factor(self, expr: Any, most: Binding = Binding.OPEN) -> Layout:
        """Return a factor for use next to other factors. The factor is in brackets if it binds less strongly than
        `most`, or if it is a number with a unit."""
        inner = self.layout(expr)
        return Fenced(inner) if binding(inner) is Binding.MEASURED else within(inner, most)

    def _as_written(self, expr: ex.Factors) -> Layout:
        """Return factors in the given order, with a dot between two factors that would run together."""
        first, *others = expr.args
        whole = self.layout(first)
        sign, leading = sign_apart(whole)
        items = [within(leading, Binding.MEASURED if others else Binding.OPEN)]
        for i, factor in enumerate(others, 1):
            inner = self._as_factor(factor, Binding.OPEN if i == len(others) else Binding.DOTTED)
            mark = between_factors(whole if sign and i == 1 else items[-1], inner)
            items += [mark] if mark else []
            items.append(inner)
        return signed(sign, row(*items)) if sign else row(*items)

    def _power(self, expr: Pow) -> Layout:
        base, exponent = expr.args
        if exponent.is_Rational and exponent < 0:
            return Fraction(Digits("1"), self.layout(Pow(base, -exponent)))
        if exponent == Rational(1, 2):
            return RootSign(self.layout(base))
        if isinstance(base, Function) and not isinstance(base, AppliedUndef) and exponent.is_Integer:
            name = PRINTED_NAMES.get(base.func.__name__, base.func.__name__)
            return Applied(name, self._argument(base), Digits(str(exponent)))
        inner = self.layout(base)
        return Raised(within(inner, Binding.ATOM), self.layout(exponent))

    def _rational(self, expr: Rational) -> Layout:
        return Digits(str(expr.p)) if expr.q == 1 else Fraction(Digits(str(expr.p)), Digits(str(expr.q)))

    # --- names and functions ---

    def _vector_or_tensor(self, expr: MatrixSymbol) -> Layout:
        style = "vector" if expr.shape[1] == 1 else "tensor"
        plain = layout_of_name(expr.name)
        return Name(plain.base, plain.subscript, plain.dots, style)

    def _function(self, expr: Function) -> Layout:
        if isinstance(expr, AppliedUndef):
            return layout_of_name(expr.func.__name__)
        return Applied(PRINTED_NAMES.get(expr.func.__name__, expr.func.__name__), self._argument(expr))

    def _argument(self, expr: Function) -> Layout:
        if len(expr.args) > 1:
            return self.list_of(expr.args)
        inner = self.layout(expr.args[0])
        return inner if isinstance(inner, Name) else Fenced(inner)

    def _derivative(self, expr: Derivative) -> Layout:
        name, order = layout_of_name(expr.expr.func.__name__), int(expr.derivative_count)
        return Name(name.base, name.subscript, order)

    # --- vectors and tensors ---

    def _matrix(self, value: Any) -> Layout:
        if all(entry == 0 for entry in value):
            return Name("0", style="vector" if value.shape[1] == 1 else "tensor")
        rows, columns = value.shape
        if self.flat and columns == 1:
            return self.list_of(tuple(value))
        return Array(tuple(tuple(self.layout(value[i, j]) for j in range(columns)) for i in range(rows)))

    def _in_determinant(self, value: Any) -> Layout:
        return self._matrix(value) if isinstance(value, MatrixBase) else Fenced(self.layout(value), "(")

    def _matrix_product(self, expr: MatMul) -> Layout:
        scalars = [arg for arg in expr.args if not ex.is_matrix(arg)]
        others = [arg if scalars else present(arg) for arg in expr.args if ex.is_matrix(arg)]
        sign, size = sign_and_size(scalars[0] if len(scalars) == 1 else Mul(*scalars))
        items: list[Layout] = [self._as_factor(size, Binding.DOTTED)] if size != 1 else []
        for i, other in enumerate(others, 1):
            inner = self.layout(other)
            if items or i < len(others):
                inner = self._operand(inner, leads=not items, ends=len(others) == 1)
            items.append(inner)
        placed = side_by_side(items)
        return signed(sign, placed) if sign else placed

    def _operand(self, inner: Layout, *, leads: bool, ends: bool) -> Layout:
        """Return a factor of a product of vectors or tensors, in brackets if needed."""
        if not leads and begins_with_number(inner):
            return Fenced(inner)
        return within(inner, Binding.OPEN if ends else Binding.PRODUCT)

    def _between_vectors(self, mark: Operator, most: Binding, expr: ex.Dot | ex.Cross) -> Layout:
        left, right = (within(self.layout(present(arg)), most) for arg in expr.args)
        return row(left, mark, right)

    def _outer(self, expr: ex.Outer) -> Layout:
        left, right = (self.layout(arg) for arg in expr.args)
        return row(self._operand(left, leads=True, ends=False), self._operand(right, leads=False, ends=False))

    def _norm(self, expr: ex.Norm) -> Layout:
        return Fenced(self.layout(present(expr.args[0])), "|")

    def _rate(self, expr: ex.TimeRate | ex.CarriedRate | ex.BodyRate) -> Layout:
        return self._differentiated("d", expr.args[0], Name("t"))

    def _body_rate(self, expr: ex.BodyRate) -> Layout:
        return Lowered(Fenced(self._rate(expr)), self.language.get("body_frame", "body"))

    def _component(self, expr: ex.Component) -> Layout:
        return Lowered(Fenced(self.layout(expr.args[0])), expr.args[1].name)

    def _partial(self, expr: ex.Partial) -> Layout:
        return self._differentiated("partial", expr.args[0], self.layout(expr.args[1]))

    def _differentiated(self, sign: str, what: Any, by: Layout, order: int = 1) -> Layout:
        """Return dL/dt for a name, and d/dt (...) for a long expression."""
        inner = self.layout(what)
        above, by = (each if order == 1 else Raised(each, Digits(str(order))) for each in (Upright(sign), by))
        below = row(Upright(sign), by)
        if isinstance(inner, Name) or isinstance(what.base if isinstance(what, Pow) else what, ex.Norm):
            return Fraction(row(above, inner), below)
        behind = inner if isinstance(inner, Fraction) and isinstance(what, ex.Partial) else Fenced(inner)
        return row(Fraction(above, below), THIN_SPACE, behind)

    def _slope(self, expr: ex.Slope) -> Layout:
        f, x, order = expr.args
        return self._differentiated("d", f, self.layout(x), order)

    def _at(self, expr: ex.At) -> Layout:
        """Write the values of all variables behind one bar."""
        names: dict[Any, list[Layout]] = {}
        f: Any = expr
        while isinstance(f, ex.At):
            f, x, place = f.args
            names.setdefault(place, []).insert(0, self.layout(x))
        behind: list[Layout] = []
        for place, own in reversed(names.items()):
            chain = [part for x in own for part in (x, Operator("equals"))]
            behind += [*([Operator("comma")] if behind else []), *chain, self.layout(place)]
        return Evaluated(within(self.layout(f), Binding.FACTOR), row(*behind))

    def _relation(self, expr: ex.Relation) -> Layout:
        left, right = (self.side(side) for side in expr.sides)
        return row(left, Operator(expr.word), right)

    def _approach(self, expr: Approach) -> Layout:
        what, to = expr.args
        sign = [MINUS] if to == -oo else []
        place = row(*sign, Name("infty")) if to in (oo, -oo) else self.layout(to)
        return row(self.layout(what), Operator("tends"), place)

    def side(self, expr: Any) -> Layout:
        """Return a side of an equation, in which a numerical factor common to all terms is not factored out."""
        return self._terms(self._ordered_terms(expr)) if isinstance(expr, Add) else self.layout(expr)

    def _identity(self, expr: Identity) -> Layout:
        return Name("1", style="tensor")

    # --- integrals ---

    def _integral(self, expr: Integral) -> Layout:
        signs = [IntegralSign(self.layout(lower), self.layout(upper)) for _, lower, upper in reversed(expr.limits)]
        inside: list[Layout] = [self._as_factor(expr.function)] if expr.function != 1 else []
        for x, *_ in expr.limits:
            inside += [THIN_SPACE] * bool(inside) + [row(Upright("d"), self.layout(x))]
        return row(*signs, *inside)

    def _swing(self, expr: SwingTime) -> Layout:
        """Write the integral of 1/sqrt(f): constant factors of f form a root before the integral sign."""
        f, q, amplitude, _ = expr.args
        sign = IntegralSign(Digits("0"), self.layout(amplitude))
        constant, varying = f.as_independent(q, as_Add=False)
        above, below = fraction(varying)
        differential = row(Upright("d"), self.layout(q))
        before: list[Layout] = [] if constant == 1 else [RootSign(self.layout(1 / constant)), THIN_SPACE]
        if below == 1:
            return row(*before, sign, Fraction(differential, RootSign(self.layout(above))))
        return row(*before, sign, RootSign(self.layout(below / above)), THIN_SPACE, differential)

    def _mass_integral(self, expr: ex.MassIntegral) -> Layout:
        return row(IntegralSign(), self._as_factor(expr.args[0]), THIN_SPACE, Upright("d"), Name("m"))

    def _bracket(self, expr: ex.Bracket) -> Layout:
        antiderivative, _, lower, upper = expr.args
        above, below = fraction(antiderivative)
        whole = self.layout(above) if below == 1 else Fraction(self.layout(above), self.layout(below))
        return Bracketed(whole, self.layout(lower), self.layout(upper))

    # --- as written ---

    def _group(self, expr: ex.Group) -> Layout:
        inner = self.layout(expr.args[0])
        return inner if isinstance(inner, Name | Digits) else Fenced(inner)

    def _ratio(self, expr: ex.Ratio) -> Layout:
        return Fraction(*(self.layout(arg) for arg in expr.args))

    def _root(self, expr: ex.Root) -> Layout:
        inner = self.layout(expr.args[0])
        if expr.index == 2:
            return RootSign(inner)
        return Raised(within(inner, Binding.ATOM), self.layout(Rational(1, expr.index)))

    def _amount(self, expr: ex.Amount | ex.MatrixAmount) -> Layout:
        number, unit, _ = expr.args
        inner = decimal(number, self.sign) if isinstance(number, Rational) else self.layout(number)
        if unit.name in ex.IN_DEGREES:
            return row(inner, DEGREE_SIGN)
        printed = self.language.get(unit.name, unit.name)  # a unit that is a word, such as rpm
        return row(inner, THIN_SPACE, unit_behind_number(printed)) if unit.name else inner

    _methods: tuple[tuple[Any, Callable[[Any, Any], Layout]], ...] = (
        (Rational, _rational),
        (Rounded, lambda self, expr: rounded_number(decimal_text(expr), self.sign)),
        (Symbol, lambda self, expr: layout_of_name(expr.name)),
        (MatrixSymbol, _vector_or_tensor),
        (Pi, lambda self, _: Name("pi")),
        (ImaginaryUnit, lambda self, _: Name("i")),
        (Exp1, lambda self, _: Name("e")),
        (Derivative, _derivative),
        (MatAdd, lambda self, expr: self._terms(list(expr.args))),  # before Add, because MatAdd is a subclass of Add
        (Add | ex.Terms, _sum),
        (MatMul, _matrix_product),
        (Mul, _product),
        (Pow, _power),
        (ex.Factors, _as_written),
        (ex.Group, _group),
        (ex.Ratio, _ratio),
        (ex.Root, _root),
        (ex.Bracket, _bracket),
        (ex.Amount | ex.MatrixAmount, _amount),
        (ex.Dot, lambda self, expr: self._between_vectors(INNER, Binding.DOTTED, expr)),
        (ex.Cross, lambda self, expr: self._between_vectors(CROSS, Binding.PRODUCT, expr)),
        (ex.Outer, _outer),
        (ex.Norm, _norm),
        (exp, lambda self, expr: Raised(Name("e"), self.layout(expr.args[0]))),
        (Abs, lambda self, expr: Fenced(self.layout(expr.args[0]), "|")),
        (ex.CarriedRate | ex.TimeRate, _rate),
        (ex.BodyRate, _body_rate),
        (ex.Component, _component),
        (ex.MassIntegral, _mass_integral),
        (Integral, _integral),
        (Identity, _identity),
        (ex.Partial, _partial),
        (ex.PoissonBracket, lambda self, expr: Fenced(self.list_of(expr.args[:2]).inside, "{")),
        (ex.Slope, _slope),
        (ex.At, _at),
        (SwingTime, lambda self, expr: self._swing(expr)),
        (OrderedRoot, lambda self, expr: self.layout(expr.args[2])),
        (ex.Truncated | Expansion | FirstOrder | SwingTimeOfNumbers, lambda self, expr: self.layout(expr.args[0])),
        (ex.Relation, _relation),
        (Approach, _approach),
        (Determinant, lambda self, expr: Applied("det", self._in_determinant(expr.args[0]))),
        (Amplitudes, lambda self, expr: self._matrix(expr.column)),
    )
