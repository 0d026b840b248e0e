"""The nodes of a side as an expression of SymPy, or the reason why they have no value.

A letter and each of its rates are separate symbols: `x`, `x'`, `x''`. The letter of a vector is a column whose
components are new symbols; they depend on the same variables as the vector. The derivative of a letter about which
nothing is known is a symbol, too. Letters without a declared kind are positive unless they change with time, are
functions, or have a name that is usual for an angle, a coordinate or a constant of either sign. Authors rely on this in
sqrt(m^2) = m.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import sympy
from sympy import (
    Abs as AbsoluteValue,
)
from sympy import (
    Add as Total,
)
from sympy import (
    Expr,
    ImmutableDenseMatrix,
    Integer,
    Integral,
    Matrix,
    MatrixBase,
    Rational,
    Symbol,
    cos,
    exp,
    log,
    pi,
    sin,
    sqrt,
)

from derive.algebra.integrals import definite
from derive.documents.facts import ANGLES, Facts
from derive.documents.facts import I as IMAGINARY
from derive.documents.source import Span
from derive.documents.syntax import (
    Abs,
    Add,
    Apply,
    Cases,
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
    Nabla,
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
from derive.errors import DeriveError
from derive.units import read_unit

Value: TypeAlias = Any  # an expression or an immutable matrix: SymPy has no common type for them
LARGEST_POWER = 60
MOST_TERMS = 20  # greatest difference of the limits of a sum or product whose terms are written out
LONGEST_NUMBER = 60
MOST_BITS = 4000  # the greatest number of bits of a power of a number
LARGEST_DETERMINANT = 6
MOST_NESTED_TERMS = 2000  # the greatest number of terms of nested sums and products that are written out


class Meaningless(Exception):
    """A side has no value that derive can find: `reason` says why, `span` where."""

    def __init__(self, reason: str, span: Span):
        super().__init__(reason)
        self.reason, self.span = reason, span


FUNCTIONS: dict[str, Callable[..., Any]] = {
    "sin": sin, "cos": cos, "tan": sympy.tan, "cot": sympy.cot, "sec": sympy.sec, "csc": sympy.csc,
    "arcsin": sympy.asin, "arccos": sympy.acos, "arctan": sympy.atan, "arccot": sympy.acot, "sinh": sympy.sinh,
    "cosh": sympy.cosh, "tanh": sympy.tanh, "coth": sympy.coth, "arcsinh": sympy.asinh, "arccosh": sympy.acosh,
    "arctanh": sympy.atanh, "ln": log, "exp": exp, "sign": sympy.sign, "sech": sympy.sech, "csch": sympy.csch,
    "factorial": sympy.factorial, "Re": sympy.re, "Im": sympy.im,
}  # fmt: skip
INVERSE = {"sin": sympy.asin, "cos": sympy.acos, "tan": sympy.atan, "sinh": sympy.asinh, "cosh": sympy.acosh,
           "tanh": sympy.atanh}  # fmt: skip


@dataclass
class Meaning:
    """Finds the values of nodes; it records the decimals it meets and the symbols it makes for derivatives."""

    facts: Facts
    # the variables of the integrals around a node; those of an integral inside a bracket come last
    variables: tuple[Symbol, ...] = ()
    # each decimal, with the number of digits after the point
    decimals: list[tuple[Expr, int]] = field(default_factory=list)
    units: bool = False
    scope: int = -1
    # Which letters are read as numbers, although they may denote vectors: "" for none, `unmarked` for those without an
    # arrow or bold type, `all` for all of them. `tensors` also includes the letters that denote tensors.
    plain: str = ""
    derivatives: dict[Symbol, tuple[Letter, tuple[tuple[Symbol, int], ...], bool]] = field(default_factory=dict)
    symbols: dict[Symbol, Letter] = field(default_factory=dict)
    parents: dict[Symbol, tuple[Symbol, Symbol]] = field(default_factory=dict)  # derivative -> its operand and variable
    defined: Callable[[Symbol], Any] = lambda _: None  # the value that earlier rows give to a letter
    # the symbol of a value such as U(0) -> the function, its variable and the place
    evaluations: dict[Symbol, tuple[Symbol, Symbol, Expr]] = field(default_factory=dict)
    two_signs: bool = False
    left_out: tuple[Symbol, int] | None = None  # the letter and the order of the terms that are left out: O(x^2)
    # the symbol of a sum that is not written out -> its term, index and range
    sums: dict[Symbol, tuple[Expr, Symbol, str]] = field(default_factory=dict)
    terms: int = 1  # the number of terms into which the sums around the current node are written out

    def of(self, node: Node) -> Value:
        found = self._of(node)
        if isinstance(found, MatrixBase):
            return found.as_immutable()
        return sympy.sympify(found) if not isinstance(found, Expr) else found

    def scalar(self, node: Node) -> Expr:
        found = self.of(node)
        if isinstance(found, MatrixBase):
            raise Meaningless("a vector or matrix appears where a number is needed", node.span)
        return found

    def _of(self, node: Node) -> Any:
        method = getattr(self, f"of_{type(node).__name__.lower()}", None)
        if method is None:
            raise Meaningless("this has no value", node.span)
        return method(node)

    def of_num(self, node: Num) -> Expr:
        if len(node.text) > LONGEST_NUMBER:
            raise Meaningless("this number is too long", node.span)
        if "." in node.text:
            self.decimals.append((Rational(node.text), len(node.text.partition(".")[2])))
        return Rational(node.text)

    def of_letter(self, node: Letter) -> Any:
        if node.base == "pi" and not node.sub and not node.marks:
            return pi
        if node.base == "infty":
            return sympy.oo
        if node.base == "imaginary unit" or (node.identity == IMAGINARY and self.facts.has_imaginary_unit):
            return sympy.I
        if "hat" in node.marks or "bb" in node.marks:
            return self.unit_vector(node)
        if "vec" in node.marks and node.base in "ijk" and not node.sub and self.facts.has_axes:
            return self.unit_vector(node)
        if self.facts.is_tensor(node, self.scope) and self.plain != "tensors":
            return self.components(node, *(self.facts.shape(node, self.scope) or (3, 3)))
        as_number = self.plain in ("all", "tensors") or (self.plain == "unmarked" and "vec" not in node.marks)
        if self.facts.is_vector(node, self.scope) and not as_number:
            rows = (self.facts.shape(node, self.scope) or (3, 1))[0]
            return ImmutableDenseMatrix.zeros(rows, 1) if node.base == "0" else self.components(node, rows, 1)
        return Integer(0) if node.base == "0" else self.symbol(node)

    def unit_vector(self, node: Letter) -> Any:
        axis = {"x": 0, "y": 1, "z": 2, "i": 0, "j": 1, "k": 2}.get(node.base)
        if axis is not None and not node.dots:
            return Matrix([Integer(i == axis) for i in range(3)])
        return self.components(node, 3, 1)

    def components(self, node: Letter, rows: int, columns: int) -> ImmutableDenseMatrix:
        plain = _replaced(node, marks=frozenset())
        if columns == 1:
            entries = [_replaced(plain, sub=_indexed(node.sub, str(i + 1))) for i in range(rows)]
            if variables := self.facts.variables_of(node):
                self.facts.functions.update({each.identity: variables for each in entries})
            if self.facts.changes(node):
                self.facts.timed |= {(each.base, each.sub, each.marks, each.label) for each in entries}
            return ImmutableDenseMatrix([self.symbol(each) for each in entries])
        named = self.facts.entries(plain) if rows == columns == 3 and node.identity in self.facts.tensors else None
        if named is not None:
            return ImmutableDenseMatrix(3, 3, lambda i, j: self.symbol(
                _replaced(plain, sub=named[i][j])
            ) if named[i][j] else Integer(0))  # fmt: skip
        return ImmutableDenseMatrix(rows, columns, lambda i, j: self.symbol(
            _replaced(plain, sub=_indexed(node.sub, f"{i + 1}{j + 1}"))
        ))  # fmt: skip

    def symbol(self, node: Letter) -> Symbol:
        name = node.named() + ("." * node.dots)
        free = node.dots or self.facts.changes(node) or node.base in ANGLES or node.primes
        free = free or node.base in ("x", "y", "z", "q", "p", "u", "w", "X", "Y", "Z", "eta", "xi", "A", "B", "C", "c")
        kind = "" if node.dots else self.facts.kind_of(node)
        if kind == "integer":
            symbol = Symbol(name, integer=True)
        elif kind == "positive" or not (kind == "real" or free or self.facts.is_function(node)):
            symbol = Symbol(name, positive=True)
        else:
            symbol = Symbol(name, real=True)
        self.symbols.setdefault(symbol, node)
        return symbol

    def of_group(self, node: Group) -> Any:
        return self._of(node.inner)

    def of_open(self, node: Open) -> Any:
        return self._of(node.alternatives[0])

    def of_text(self, node: Text) -> Any:
        if node.text.startswith("unit "):
            return self.unit(node)
        if node.text == "degrees":
            return pi / 180
        reason = {
            "...": "dots stand for terms that are left out",
            "?": "the document leaves this open",
        }.get(node.text, f"`{node.text}` is a word")
        raise Meaningless(reason, node.span)

    def unit(self, node: Text) -> Expr:
        """Return the size of a unit in SI units."""
        name = node.text.removeprefix("unit ").strip()
        try:
            unit = read_unit({"sec": "s", "RPM": "rpm"}.get(name, name))
        except DeriveError:
            raise Meaningless(f"`{name}` is not a unit that derive knows", node.span) from None
        self.units = True
        return unit.factor

    def of_add(self, node: Add) -> Any:
        terms = []
        for sign, term in node.terms:
            value = self._of(term)
            if sign in "±∓":
                self.two_signs = True
                value = value * (Symbol("±", real=True) if sign == "±" else -Symbol("±", real=True))
            terms.append(-value if sign == "-" else value)
        if any(isinstance(each, MatrixBase) for each in terms):
            if not all(isinstance(each, MatrixBase) for each in terms):
                zero = [each for each in terms if not isinstance(each, MatrixBase)]
                if any(each != 0 for each in zero):
                    raise Meaningless("a number is added to a vector or a matrix", node.span)
                terms = [each for each in terms if isinstance(each, MatrixBase)]
            if len({each.shape for each in terms}) > 1:
                raise Meaningless("matrices of different shapes are added", node.span)
            total = terms[0]
            for each in terms[1:]:
                total = total + each
            return total
        return Total(*terms)

    def of_mul(self, node: Mul) -> Any:
        """Return a product. Factors side by side are multiplied first, and factors with a dot or a cross between them
        afterwards."""
        parts: list[tuple[str, Any, Span]] = []
        for mark, factor in node.factors:
            new = self._of(factor)
            if parts and not mark:
                before, value, span = parts[-1]
                parts[-1] = (before, self.times(value, new, "", factor.span), span)
            else:
                parts.append((mark, new, factor.span))
        value = parts[0][1]
        for mark, new, span in parts[1:]:
            value = self.times(value, new, mark, span)
        return value

    def times(self, left: Any, right: Any, mark: str, span: Span) -> Any:
        both = isinstance(left, MatrixBase) and isinstance(right, MatrixBase)
        if not both:
            return left * right
        if left.shape == right.shape and left.shape[1] == 1:
            if mark == "times" and left.shape[0] == 3:
                return left.cross(right)
            if mark == "cdot":
                return left.dot(right)
            if mark == "times":
                raise Meaningless("a cross product needs two vectors with three components", span)
            raise Meaningless("two vectors are side by side without `\\cdot` or `\\times`", span)
        if left.shape[1] == right.shape[0]:
            return left * right
        if mark == "cdot" and left.shape[0] == right.shape[0] and left.shape[1] == right.shape[1] == 1:
            return left.dot(right)
        raise Meaningless("the shapes of these matrices do not fit", span)

    def of_frac(self, node: Frac) -> Any:
        top, bottom = self._of(node.top), self._of(node.bottom)
        if isinstance(bottom, MatrixBase):
            raise Meaningless("a denominator is a vector or matrix", node.bottom.span)
        if bottom == 0:
            raise Meaningless("a denominator is zero", node.bottom.span)
        return top / bottom

    def of_pow(self, node: Pow) -> Any:
        base, exponent = self._of(node.base), self._of(node.exponent)
        if isinstance(node.base, Letter) and node.base.base == "e" and not node.base.sub and not node.base.dots:
            if self.facts.alone[node.base.identity] == 0:  # e is Euler's number, unless it is a side of a statement
                base = sympy.E
        if isinstance(exponent, MatrixBase):
            raise Meaningless("an exponent is a vector or matrix", node.exponent.span)
        if isinstance(base, MatrixBase):
            if exponent == 2 and base.shape[1] == 1:
                return base.dot(base)
            if exponent == -1 or (exponent.is_Integer and base.shape[0] == base.shape[1] and abs(exponent) < 6):
                return base**exponent
            raise Meaningless("this power of a vector or matrix cannot be evaluated", node.span)
        if exponent.is_Number and abs(exponent) > LARGEST_POWER:
            raise Meaningless("this power is too high", node.exponent.span)
        if base == 0 and exponent.is_negative:
            raise Meaningless("a denominator is zero", node.span)
        if exponent.is_Number and any(_bits(each) * abs(exponent) > MOST_BITS for each in base.atoms(Rational)):
            raise Meaningless("this power is too high", node.exponent.span)
        return base**exponent

    def of_root(self, node: Root) -> Any:
        inner = self.scalar(node.inner)
        if node.index is None:
            return sqrt(inner)
        return inner ** (1 / self.scalar(node.index))

    def of_fun(self, node: Fun) -> Any:
        if node.name == "degrees":
            return self._of(node.argument) * pi / 180
        if node.name in ("det", "tr"):
            matrix = self._of(node.argument)
            if not isinstance(matrix, MatrixBase):
                raise Meaningless("the matrix is not written out", node.argument.span)
            if node.name == "tr" and matrix.rows != matrix.cols:
                raise Meaningless("only a square matrix has a trace", node.span)
            return _determinant(matrix, node.span) if node.name == "det" else matrix.trace()
        if node.name == "order":
            return self.terms_left_out(node.argument)
        if node.name in ("min", "max"):
            entries = node.argument.entries if isinstance(node.argument, Vec) else (node.argument,)
            values = [self.scalar(each) for each in entries]
            return sympy.Min(*values) if node.name == "min" else sympy.Max(*values)
        argument = self.scalar(node.argument)
        if node.name in ("log", "ln"):
            value = log(argument)
            if node.base is not None:
                value = value / log(self.scalar(node.base))
        elif node.name in FUNCTIONS:
            if node.name == "factorial" and not (argument.is_Integer and 0 <= argument < 50):
                raise Meaningless("only factorials of whole numbers from 0 to 49 are evaluated", node.span)
            value = FUNCTIONS[node.name](argument)
        else:
            raise Meaningless(f"`{node.name}` is not a function that derive knows", node.span)
        if node.power is None:
            return value
        power = self.scalar(node.power)
        if power == -1 and node.name in INVERSE:
            return INVERSE[node.name](argument)
        return value**power

    def of_abs(self, node: Abs) -> Any:
        inner = self._of(node.inner)
        if isinstance(inner, MatrixBase):
            if inner.shape[1] == 1:
                return sqrt(inner.dot(inner))
            return _determinant(inner, node.span)
        return AbsoluteValue(inner)

    def of_mat(self, node: Mat) -> Any:
        if len({len(row) for row in node.rows}) > 1:
            raise Meaningless("the rows of this matrix have different lengths", node.span)
        if node.determinant:
            return self.determinant(node)
        letters = [_letter_in(each) for row in node.rows for each in row]
        if len(node.rows) > 1 and any(letter is not None and "vec" in letter.marks for letter in letters):
            raise Meaningless("an entry of this matrix is a vector or a matrix", node.span)
        entries = [[self.entry(each) for each in row] for row in node.rows]
        matrix = Matrix(entries)
        return matrix.T if matrix.shape[0] == 1 and matrix.shape[1] > 1 else matrix

    def entry(self, node: Node) -> Expr:
        if isinstance(node, Text) and not node.text:
            return Integer(0)
        return self.scalar(node)

    def determinant(self, node: Mat) -> Any:
        """Return a determinant; with unit vectors in its first row, it is a cross product."""
        first = node.rows[0]
        if len(node.rows) != len(first):
            raise Meaningless("this determinant is not square", node.span)
        axes = [_letter_in(each) for each in first]
        if len(first) == 3 and all(axis is not None for axis in axes):
            names = [axis.base for axis in axes if axis is not None]
            if names in (["i", "j", "k"], ["x", "y", "z"]) or all(
                "hat" in axis.marks or "vec" in axis.marks for axis in axes if axis is not None
            ):
                rows = [Matrix([self.entry(each) for each in row]) for row in node.rows[1:]]
                return rows[0].cross(rows[1])
        return _determinant(Matrix([[self.entry(each) for each in row] for row in node.rows]), node.span)

    def of_vec(self, node: Vec) -> Any:
        if len(node.entries) == 2 and (node.brackets == "]" or (node.brackets in "}>" and self.facts.has_brackets)):
            one, other = (str(self._of(each)) for each in node.entries)
            return Symbol(f"bracket({one}, {other})", real=True)  # a commutator, a Poisson bracket or an inner product
        if len(node.entries) not in (2, 3):
            raise Meaningless("only lists of two or three entries are read as vectors", node.span)
        if any(isinstance(each, Condition) for each in node.entries):
            raise Meaningless("these are conditions", node.span)
        return Matrix([self.entry(each) for each in node.entries])

    # Functions with arguments

    def of_apply(self, node: Apply) -> Any:
        head = node.head
        if head.base == "O" and not head.sub and (
            "cal" in head.marks or self.facts.alone[head.identity] == 0 or isinstance(node.arguments[0], Pow)
        ):  # fmt: skip
            return self.terms_left_out(node.arguments[0])
        own = self.facts.variables_of(_replaced(head, dots=0))
        if any(isinstance(each, Text) and each.text == "..." for each in node.arguments):
            return self.function_letter(head)  # y(x_1, ..., x_n)
        values: list[tuple[Node | None, Node]] = []
        for argument in node.arguments:
            if isinstance(argument, Condition):
                values.append((argument.left, argument.right))
            else:
                values.append((None, argument))
        plain = [_letter_in(value) for _, value in values]
        variables = all(letter is not None and (letter.identity in own or len(values) > 1) for letter in plain)
        at_place = any(letter is not None and letter.sub and _whole(letter) in own for letter in plain)
        if variables and not at_place and not any(variable for variable, _ in values):
            return self.function_letter(head)
        if self.facts.is_vector(head, self.scope):
            raise Meaningless("the value of a vector at a place or an instant is not read", node.span)
        numbers = [self.scalar(value) for _, value in values]
        symbol = Symbol(f"{head.named()}{'.' * head.dots}({','.join(map(str, numbers))})", real=True)
        variable = self.variable_of_call(values[0][0], own) if len(values) == 1 else None
        if variable is not None and isinstance(function := self.function_letter(head), Symbol):
            self.evaluations[symbol] = (function, variable, numbers[0])
        return symbol

    def terms_left_out(self, order: Node) -> Expr:
        base, power = self.scalar(order).as_base_exp()
        if isinstance(base, Symbol) and power.is_Integer:
            self.left_out = (base, int(power))
        return Integer(0)

    def variable_of_call(self, named: Node | None, own: Any) -> Symbol | None:
        """Return the variable of a function that is written with a number: theta for U(0) and for U(theta = 0). Return
        None for U(0) if the function does not have exactly one known variable."""
        if named is not None:
            letter = _letter_in(named)
            return self.symbol(letter) if letter is not None else None
        if len(own) != 1:
            return None
        ((base, sub, marks, primes, label),) = own
        return self.symbol(Letter(Span(0, 0), base, sub, marks, 0, primes, label))

    def function_letter(self, head: Letter) -> Any:
        if not head.primes:
            return self.of_letter(head)
        variables = self.facts.variables_of(_replaced(head, primes=0))
        if not variables:
            return self.symbol(head)
        base, sub, marks, primes, label = variables.most_common(1)[0][0]
        by = self.symbol(Letter(head.span, base, sub, marks, 0, primes, label))
        return self.derivative_symbol(_replaced(head, primes=0), ((by, head.primes),), False)

    def derivative_symbol(self, letter: Letter, by: tuple[tuple[Symbol, int], ...], partial: bool) -> Symbol:
        name = f"d{letter.named()}{'.' * letter.dots}/" + "".join(f"d{x}^{n}" if n > 1 else f"d{x}" for x, n in by)
        symbol = Symbol(name, real=True)
        self.derivatives[symbol] = (letter, by, partial)
        return symbol

    # Derivatives

    def of_der(self, node: Der) -> Any:
        if node.of is None:
            raise Meaningless("this derivative has no operand", node.span)
        by: list[tuple[Symbol, int]] = []
        for letter, order in node.by:
            if not isinstance(letter, Letter):
                raise Meaningless("this is not a variable of differentiation", letter.span)
            if self.facts.is_vector(letter, self.scope):
                raise Meaningless("this is a derivative with respect to a vector", letter.span)
            by.append((self.symbol(letter), order))
        of = _inner_letter(node.of)
        if of is not None and not self.facts.is_vector(of, self.scope) and not self.facts.is_tensor(of, self.scope):
            return self.of_lone_letter(of, tuple(by), node.partial)
        value = self._of(node.of)
        if isinstance(value, Symbol) and value in self.evaluations and len(by) == 1:
            function, variable, at = self.evaluations[value]
            head = self.symbols.get(function)
            if head is not None and variable == by[0][0] and not at.has(variable):  # d V(a)/dr is V'(r) at r = a
                return self.evaluated(self.of_lone_letter(head, tuple(by), node.partial), variable, at)
        if isinstance(value, Expr) and value in self.derivatives and len(by) == 1 and by[0][1] == 1:
            return self.rate_of(value, by[0][0], node.partial) or self.derivative_of_symbol(value, by[0][0])
        for symbol, order in by:
            for _ in range(order):
                value = self.differentiated(value, symbol, node.partial)
        return value

    def of_lone_letter(self, letter: Letter, by: tuple[tuple[Symbol, int], ...], partial: bool) -> Any:
        first, order = by[0]
        if len(by) == 1 and first.name == "t" and not partial and self.facts.changes(letter):
            return self.symbol(_replaced(letter, dots=letter.dots + order))
        if len(by) == 1 and self.symbol(letter) == first:
            return Integer(order == 1)
        bare = _replaced(letter, primes=0)
        if letter.primes and len(by) == 1 and not partial:
            variables = self.facts.variables_of(bare)
            if variables and self.is_variable(variables.most_common(1)[0][0], first):
                return self.derivative_symbol(bare, ((first, order + letter.primes),), False)
        return self.derivative_symbol(letter, by, partial)

    def derivative_of_symbol(self, symbol: Symbol, by: Symbol) -> Symbol:
        made = Symbol(f"d({symbol})/d{by}", real=True)
        letter, already, partial = self.derivatives[symbol]
        self.derivatives[made] = (letter, (*already, (by, 1)), partial)
        self.parents[made] = (symbol, by)
        return made

    def is_variable(self, identity: Any, symbol: Symbol) -> bool:
        letter = self.symbols.get(symbol)
        if letter is None:
            return False
        return letter.identity == identity or (bool(letter.label) and letter.base == identity[0])

    def differentiated(self, value: Any, by: Symbol, partial: bool) -> Any:
        if isinstance(value, MatrixBase):
            return value.applyfunc(lambda each: self.differentiated(each, by, partial))
        if primed := self.written_with_prime(value, by):
            return self.differentiated(value.subs(primed, by), by, partial).subs(by, primed)
        total = sympy.diff(value, by)
        for symbol in sorted(value.free_symbols - {by}, key=str):
            rate = self.rate_of(symbol, by, partial)
            if rate != 0:
                total += sympy.diff(value, symbol) * rate
        return total

    def written_with_prime(self, value: Expr, by: Symbol) -> Symbol | None:
        """Return the symbol of dy/dx in an expression if `by` is y', because both denote the same derivative.

        The result is None if `by` has no prime, or if the expression does not contain dy/dx."""
        letter = self.symbols.get(by)
        if letter is None or not letter.primes:
            return None
        plain = _replaced(letter, primes=0).identity
        for symbol in value.free_symbols & self.derivatives.keys():
            of, variables, _ = self.derivatives[symbol]
            if of.identity == plain and sum(order for _, order in variables) == letter.primes:
                return symbol
        return None

    def of_member(self, term: Expr, index: Symbol, by: Symbol) -> Expr:
        """Return the derivative of a sum with respect to a letter that only one term of the sum contains; 0 if no term
        contains it. For example, the derivative of the sum of m_i v_i^2/2 with respect to v_k is m_k v_k."""
        letter = self.symbols.get(by)
        members = [self.symbols.get(each) for each in term.free_symbols if self.has_index(each, index)]
        if letter is None or not any(
            each is not None and each.base == letter.base and each.dots == letter.dots and each.sub == index.name
            for each in members
        ):
            return Integer(0)
        put_in = {}
        for symbol in term.free_symbols:
            if self.has_index(symbol, index):
                member = self.symbols.get(symbol)
                if member is None or symbol == index:
                    raise Meaningless(
                        "the derivative of a sum with respect to a letter of one term is not computed", letter.span
                    )
                put_in[symbol] = self.symbol(_replaced(member, sub=member.sub.replace(index.name, letter.sub)))
        return sympy.diff(term.xreplace(put_in), by)

    def rate_of(self, symbol: Symbol, by: Symbol, partial: bool) -> Expr:
        """Return the derivative of a letter with respect to another letter. It is zero if the first letter is not known
        to depend on the second. Otherwise it is, for example, a rate or a symbol for the derivative."""
        if symbol in self.sums:
            term, index, bounds = self.sums[symbol]
            if self.has_index(by, index):
                return Symbol(f"d({symbol})/d{by}", real=True)
            others = self.summed(self.differentiated(term, by, partial), index, bounds)
            return others + self.of_member(term, index, by)
        if symbol in self.evaluations:
            return self.rate_at_place(symbol, by, partial)
        if symbol in self.derivatives:
            letter, already, was_partial = self.derivatives[symbol]
            if partial and self.facts.is_variable(letter):
                return Integer(0)
            if by.name == "t" or any(self.is_variable(each, by) for each in self.facts.variables_of(letter)):
                if len(already) == 1 and already[0][0] == by:
                    return self.derivative_symbol(letter, ((by, already[0][1] + 1),), was_partial)
                made = Symbol(f"d({symbol})/d{by}", real=True)
                self.derivatives[made] = (letter, (*already, (by, 1)), was_partial)
                self.parents[made] = (symbol, by)
                return made
            return Integer(0)
        found = self.symbols.get(symbol)
        if found is None:
            return Integer(0)
        if by.name == "t" and not partial:
            if self.facts.changes(found):
                return self.symbol(_replaced(found, dots=found.dots + 1))
            return Integer(0)
        if partial and (found.dots or self.facts.is_variable(found)):
            return Integer(0)  # an independent variable of the function, such as y in F(y, y')
        variable = self.symbols.get(by)
        if variable is not None and variable.dots:
            return Integer(0)
        if any(self.is_variable(each, by) for each in self.facts.variables_of(_replaced(found, primes=0, dots=0))):
            return self.derivative_symbol(found, ((by, 1),), partial)
        return Integer(0)

    def rate_at_place(self, symbol: Symbol, by: Symbol, partial: bool) -> Expr:
        """Return the derivative of a value such as U(1/u) by the chain rule; a symbol if U is not known."""
        function, variable, at = self.evaluations[symbol]
        if (rate := self.differentiated(at, by, partial)) == 0:
            return Integer(0)
        value = self.defined(function)
        if value is not None and variable in value.free_symbols:
            return self.differentiated(value, variable, partial).subs(variable, at) * rate
        made = Symbol(f"d({symbol})/d{by}", real=True)
        self.parents[made] = (symbol, by)
        return made

    # Integrals

    def of_int(self, node: Int) -> Any:
        signs: list[tuple[int, Sign]] = []
        pairs: dict[int, Symbol] = {}
        factors: list[Any] = []
        open_signs: list[int] = []
        nodes: list[Node] = []
        for item in node.items:
            if isinstance(item, Sign):
                signs.append((len(signs), item))
                open_signs.append(len(signs) - 1)
            elif isinstance(item, Diff):
                if not open_signs:
                    raise Meaningless("there are more differentials than integral signs", item.span)
                letter = _inner_letter(item.of)
                if letter is None or item.order != 1:
                    raise Meaningless("this differential has no single variable", item.span)
                if self.facts.is_vector(letter, self.scope):
                    raise Meaningless("an integral along a path or over a surface is not evaluated", item.span)
                pairs[open_signs.pop()] = self.symbol(letter)
            else:
                nodes.append(item)
        if open_signs:
            raise Meaningless("an integral sign has no differential", signs[open_signs[-1]][1].span)
        inner = Meaning(
            self.facts,
            (*self.variables, *pairs.values()),
            scope=self.scope,
            plain=self.plain,
            derivatives=self.derivatives,
            symbols=self.symbols,
            parents=self.parents,
            defined=self.defined,
            evaluations=self.evaluations,
            sums=self.sums,
        )
        factors = [inner._of(each) for each in nodes]
        self.decimals += inner.decimals
        factors = [self.along_variables(each, set(pairs.values())) for each in factors]
        value: Any = Integer(1)
        for each in factors:
            value = self.times(value, each, "", node.span) if isinstance(value, MatrixBase) else value * each
        for index, sign in reversed(signs):
            around = {*self.variables, *pairs.values()} - {pairs[index]}
            value = self.integrated(value, pairs[index], sign, around)
        return value

    def along_variables(self, value: Any, variables: set[Symbol]) -> Any:
        """Replace each letter by its definition in an earlier row if the definition contains a variable of integration,
        such as r = R z/h in an integral over z."""
        found = {}
        for symbol in value.free_symbols - variables:
            definition = self.defined(symbol)
            if definition is not None and definition.free_symbols & variables:
                found[symbol] = definition
        return value.xreplace(found) if found else value

    def integrated(self, value: Any, x: Symbol, sign: Sign, around: set[Symbol]) -> Any:
        if isinstance(value, MatrixBase):
            return value.applyfunc(lambda each: self.integrated(each, x, sign, around))
        if sign.lower is None and sign.upper is None:
            return Integral(value, x)
        if sign.lower is None or sign.upper is None or sign.closed:
            raise Meaningless("this integral has no limits that can be substituted", sign.span)
        lower, upper = (
            self.along_variables(self.scalar(each.right if isinstance(each, Condition) else each), around)
            for each in (sign.lower, sign.upper)
        )
        if any(self.depends(each, x) for each in value.free_symbols - {x}):
            return Integral(value, (x, lower, upper))
        finite = not any(each.has(sympy.oo) for each in (value, lower, upper))
        found = definite(value, [(x, lower, upper)]) if finite else None
        return found if found is not None else Integral(value, (x, lower, upper))

    def depends(self, symbol: Symbol, x: Symbol) -> bool:
        """Whether the document writes a letter as a function of the variable of integration, and gives it no value."""
        letter = self.symbols.get(symbol)
        if letter is None or self.defined(symbol) is not None:
            return False
        return any(self.is_variable(each, x) for each in self.facts.variables_of(_replaced(letter, dots=0)))

    def of_diff(self, node: Diff) -> Any:
        letter = _inner_letter(node.of)
        if letter is None:
            raise Meaningless("this differential has no single variable", node.span)
        symbol = Symbol(f"d{letter.named()}", real=True)
        return symbol

    def of_evalbar(self, node: EvalBar) -> Any:
        inner = self._of(node.inner)
        if isinstance(node.lower, Text):
            return self.with_label(inner, node.lower.text)
        if isinstance(inner, MatrixBase):
            raise Meaningless("a matrix has limits", node.span)
        if node.upper is None and isinstance(node.lower, Condition):
            left = _inner_letter(node.lower.left)
            if left is None:
                raise Meaningless("this condition has no single letter", node.lower.span)
            return self.evaluated(inner, self.symbol(left), self.scalar(node.lower.right))
        if node.lower is None or node.upper is None:
            raise Meaningless("a limit is missing", node.span)
        variable = self.variable_of(inner, node)
        ends = [self.scalar(each.right if isinstance(each, Condition) else each) for each in (node.upper, node.lower)]
        return inner.subs(variable, ends[0]) - inner.subs(variable, ends[1])

    def evaluated(self, inner: Expr, variable: Symbol, at: Expr) -> Expr:
        """Return a value at a place; a letter that may depend on the variable becomes a new symbol there."""
        put_in = {}
        for symbol in inner.free_symbols - {variable}:
            letter = self.symbols.get(symbol)
            definition = self.defined(symbol)
            depends = inner == symbol or symbol in self.derivatives or symbol in self.parents
            depends = depends or (definition is not None and variable in definition.free_symbols)
            depends = depends or (letter is not None and any(
                self.is_variable(each, variable) for each in self.facts.variables_of(letter)
            ))  # fmt: skip
            if depends:
                put_in[symbol] = Symbol(f"{symbol.name}({variable}={at})", real=True)
                self.evaluations[put_in[symbol]] = (symbol, variable, at)
        return inner.xreplace(put_in).subs(variable, at)

    def with_label(self, value: Any, label: str) -> Any:
        """Return a new real symbol for a value with a label, such as dL/dt with the label `body`. For a vector or a
        matrix, return one symbol for each entry.
        """
        if isinstance(value, MatrixBase):
            return value.applyfunc(lambda each: self.with_label(each, label))
        symbol = Symbol(f"({value})_{label}", real=True)
        return symbol

    def variable_of(self, inner: Expr, node: EvalBar) -> Symbol:
        if isinstance(node.lower, Condition) and (letter := _inner_letter(node.lower.left)) is not None:
            return self.symbol(letter)
        free = sorted(inner.free_symbols, key=str)
        if len(free) == 1:
            return free[0]
        integrated = [
            each
            for each in free
            if each in self.symbols
            and self.facts.integrated[self.symbols[each].identity]
            and each not in self.variables[:-1]
        ]
        if len(integrated) == 1:
            return integrated[0]
        raise Meaningless("the variable of these limits is not clear", node.span)

    def of_sum(self, node: Sum) -> Any:
        indices = _indices(node)
        if not indices and node.name == "sum" and node.lower is None and isinstance(node.body, Letter):
            return self._of(_replaced(node.body, base=f"sum {node.body.base}"))  # `\sum F_x` is the total force
        if not indices:
            raise Meaningless("this sum or product has no index", node.span)
        if len(indices) == 1 and node.lower is not None and node.upper is not None:
            lower, upper = self.scalar(node.lower), self.scalar(node.upper)
            if lower.is_Integer and upper.is_Integer and 0 <= upper - lower <= MOST_TERMS:
                return self.terms_of(node, indices[0], int(lower), int(upper))
        if node.name != "sum":
            needed = f"one index, and two whole numbers as limits, the upper one 0 to {MOST_TERMS} above the lower one"
            raise Meaningless(f"this product cannot be written out: it needs {needed}", node.span)
        value = self._of(node.body)
        bounds = [self.range_of(each) for each in (node.lower, node.upper)]
        for index in reversed(indices):
            value = self.summed(value, self.symbol(index), "..".join(bounds))
        return value

    def terms_of(self, node: Sum, index: Letter, lower: int, upper: int) -> Any:
        self.terms *= upper - lower + 1
        if self.terms > MOST_NESTED_TERMS:
            raise Meaningless("these sums or products have too many terms", node.span)
        values = [self._of(_with_index(node.body, index, Integer(i))) for i in range(lower, upper + 1)]
        self.terms //= len(values)
        value = values[0]
        for each in values[1:]:
            value = value + each if node.name == "sum" else value * each
        return value

    def range_of(self, bound: Node | None) -> str:
        """Return a bound as a word; empty for 1 and for N, n, d and s, so that such a sum equals a sum without
        bounds."""
        if bound is None or (isinstance(bound, Num) and bound.text == "1"):
            return ""
        letter = _letter_in(bound)
        return "" if letter is not None and letter.base in ("N", "n", "d", "s") else str(self._of(bound))

    def summed(self, value: Any, index: Symbol, bounds: str) -> Any:
        """Return a sum over an index: factors without the index are taken out of it, and the sum of the other factors
        is a symbol."""
        if isinstance(value, MatrixBase):
            return value.applyfunc(lambda each: self.summed(each, index, bounds))
        total: Expr = Integer(0)
        for term in Total.make_args(sympy.expand(value)):
            inside, outside = Integer(1), Integer(1)
            for factor in sympy.Mul.make_args(term):
                if any(self.has_index(each, index) for each in factor.free_symbols):
                    inside *= factor
                else:
                    outside *= factor
            total += outside * self.sum_symbol(inside, index, bounds)
        return total

    def sum_symbol(self, term: Expr, index: Symbol, bounds: str) -> Expr:
        """Return the symbol for the sum of a term; its name does not depend on the letter of the index."""
        depth = 1 + str(term).count("sum[")
        mark = f"#{depth}"
        names = {each: Symbol(self.renamed(each, index, mark), real=True) for each in term.free_symbols
                 if self.has_index(each, index)}  # fmt: skip
        symbol = Symbol(f"sum[{term.xreplace(names)}]{bounds}", real=True)
        self.sums[symbol] = (term, index, bounds)
        return symbol

    def has_index(self, symbol: Symbol, index: Symbol) -> bool:
        if symbol == index:
            return True
        if symbol in self.sums:
            term, inner, _ = self.sums[symbol]
            return inner != index and any(self.has_index(each, index) for each in term.free_symbols)
        if symbol in self.derivatives:
            letter, by, _ = self.derivatives[symbol]
            return _carries(letter, index) or any(self.has_index(each, index) for each, _ in by)
        found = self.symbols.get(symbol)
        return found is not None and _carries(found, index)

    def renamed(self, symbol: Symbol, index: Symbol, mark: str) -> str:
        """Return the name of a symbol with a mark in place of the index in its subscripts."""
        if symbol == index:
            return mark
        letter = self.symbols.get(symbol)
        if letter is not None:
            sub = letter.sub.replace(index.name, mark)
            label = letter.label.replace(index.name, mark)
            return _replaced(letter, sub=sub, label=label).named() + "." * letter.dots
        return str(symbol.name).replace(f"_{index.name}", f"_{mark}")

    def of_nabla(self, node: Nabla) -> Any:
        """Return a gradient, divergence, curl or Laplacian; the derivatives of a letter with respect to x, y and z are
        symbols."""
        axes = [self.symbol(Letter(node.span, each)) for each in "xyz"]
        of = _inner_letter(node.of) or (node.of.head if isinstance(node.of, Apply) else None)
        if isinstance(node.of, Open) and node.of.kind == "apply":
            call = node.of.alternatives[0]
            of = call.head if isinstance(call, Apply) else None
        if of is not None and node.kind == "" and not self.facts.is_vector(of, self.scope):
            return ImmutableDenseMatrix([self.derivative_symbol(of, ((axis, 1),), True) for axis in axes])
        value = self._of(node.of)
        if not value.free_symbols & set(axes) or any(
            (letter := self.symbols.get(each)) is not None and letter.base in ("r", "rho", "s")
            for each in value.free_symbols
        ):
            raise Meaningless("the operand of nabla must depend on x, y or z, and not on r, rho or s", node.span)

        def derivative(entry: Any, axis: Symbol) -> Any:
            return self.differentiated(entry, axis, True)

        if isinstance(value, MatrixBase):
            if node.kind == "cdot" and value.shape == (3, 1):
                return Total(*(derivative(value[i], axes[i]) for i in range(3)))
            if node.kind == "times" and value.shape == (3, 1):
                pairs = ((2, 1), (0, 2), (1, 0))
                return ImmutableDenseMatrix(
                    [derivative(value[i], axes[j]) - derivative(value[j], axes[i]) for i, j in pairs]
                )
        elif node.kind == "":
            return ImmutableDenseMatrix([derivative(value, axis) for axis in axes])
        elif node.kind == "squared":
            return Total(*(derivative(derivative(value, axis), axis) for axis in axes))
        message = "a gradient or a Laplacian needs a scalar, and a divergence or a curl needs a vector"
        raise Meaningless(message, node.span)

    def of_cases(self, node: Cases) -> Any:
        raise Meaningless("a formula with cases has no single value", node.span)

    def of_condition(self, node: Condition) -> Any:
        raise Meaningless("this is a condition", node.span)


def _indices(node: Sum) -> list[Letter]:
    index = node.index
    while isinstance(index, Group):
        index = index.inner
    if isinstance(index, Mul):  # `\sum_{ij}`
        found = [_letter_in(each) for _, each in index.factors]
    else:
        found = [_letter_in(each) for each in (index.entries if isinstance(index, Vec) else (index,)) if each]
    return [] if any(each is None for each in found) else [each for each in found if each is not None]


def _carries(letter: Letter, index: Symbol) -> bool:
    return index.name in letter.sub or index.name in letter.label


def _replaced(letter: Letter, **changes: Any) -> Letter:
    from dataclasses import replace

    return replace(letter, **changes)


def _bits(number: Any) -> int:
    return max(int(number.p).bit_length(), int(number.q).bit_length())


def _determinant(matrix: Any, span: Span) -> Any:
    if matrix.shape[0] != matrix.shape[1]:
        raise Meaningless("this determinant is not square", span)
    if matrix.shape[0] > LARGEST_DETERMINANT:
        raise Meaningless("this determinant is too large", span)
    return matrix.det()


def _indexed(sub: str, index: str) -> str:
    return f"{sub},{index}" if sub else index


def _whole(letter: Letter) -> Any:
    """Return the identity of a letter without its subscript: x for x_0."""
    return _replaced(letter, sub="").identity


def _letter_in(node: Node) -> Letter | None:
    while isinstance(node, Group):
        node = node.inner
    return node if isinstance(node, Letter) else None


_inner_letter = _letter_in


def _with_index(node: Node, index: Letter, value: Integer) -> Node:
    """Return the term of a sum for one value of the index, which may be a letter or part of a subscript."""
    from dataclasses import fields, replace

    if isinstance(node, Letter):
        if node.identity == index.identity:
            return Num(node.span, str(value))
        if index.base in node.sub:
            return replace(node, sub=node.sub.replace(index.base, str(value)))
        return node

    def changed(item: Any) -> Any:
        if isinstance(item, Node):
            return _with_index(item, index, value)
        return tuple(map(changed, item)) if isinstance(item, tuple) else item

    return replace(
        node, **{each.name: changed(getattr(node, each.name)) for each in fields(node) if each.name != "span"}
    )
