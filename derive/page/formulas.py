"""The formulas in an author's prose, parsed with the symbols of the problem; the symbols and the dimensions are
checked.

A formula in prose is data: derive prints it in the order in which the author wrote it and does not prove it. But an
equation of the solution (in `strategy:`, `wording:` or `note:`) that contains results is compared with the results of
the page. If the two disagree, for example because only the problem was changed, the author is warned. An equation that
may be a condition on a result causes no warning. The author is also warned of a formula that is printed but cannot be
parsed.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import islice, pairwise, product
from typing import TYPE_CHECKING, Any

from sympy import Add, Expr, Integer, MatrixBase, MatrixSymbol, Pow, Symbol, oo

from derive.algebra.dimensions import NUMBER, Dimension
from derive.algebra.equality import equal
from derive.algebra.expressions import AXES, TIME, Relation, bound, explicit, rate, scalar
from derive.algebra.kinds import named
from derive.course.expression import Declared
from derive.course.problem import Problem
from derive.course.prose import TexFormula
from derive.course.transcript import Transcript
from derive.errors import Complaint, Rejected
from derive.page.wording import Math, Text
from derive.steps.chain import short
from derive.steps.homogeneity import variables_of_integrals
from derive.steps.step import Step, is_zero
from derive.steps.trial_numbers import assumptions_about, everywhere, trial_points

if TYPE_CHECKING:
    from derive.course.latex import ReadMath, Side

_WRONG = {"undeclared-symbol", "dimension", "division-by-zero", "not-real", "too-large", "wrong-number"}
FORCES = ("force", "torque")  # kinds of unknowns that vary in time like coordinates, but for which the page has values
TRIALS, DIGITS = 3, 30  # number of trial points, and of digits, to test whether an expression with roots is zero
DEEPEST = 4  # the largest number of successive substitutions: omega_2 is given by omega_0, and omega_0 by k and m
MOST_COMBINATIONS = 16  # largest number of combinations of values, if a formula contains several results
_INEQUALITIES = ("<", ">", "<=", ">=")
_VARIANTS = ("epsilon", "theta", "rho", "sigma", "phi")  # `\varphi` is another shape of `\phi`
_LETTER = re.compile(
    r"(\\d*dot|(?P<arrow>\\(vec|overrightarrow|boldsymbol|bm|mathbf)))?[{ ]*(\\[A-Za-z]+|[A-Za-z])\}?"
    r"(_(\w|\\[A-Za-z]+|\{[\w, ]+\}|\{\\[a-z]+(\{\w+\})?\}))?\}?"
)


@dataclass(frozen=True)
class _Derived(Declared):
    """A symbol that the steps introduce, with its dimension, which need not be the dimension of a known kind."""

    derived: Dimension = NUMBER

    @property
    def dimension(self) -> Dimension:
        return self.derived


class Formulas:
    """Reads the formulas of one page and collects their errors and warnings.

    known   the dimensions of all symbols of the page; None for a symbol whose dimension is unknown
    steps   the steps of the page
    """

    def __init__(self, problem: Problem, known: Mapping[Any, Dimension | None], steps: Iterable[Step] = ()):
        self.letters = _letters(problem, known)
        self.unknown = {symbol for symbol, dimension in known.items() if dimension is None}
        self.scalars = {*known, *(letter.symbol for letter in problem.letters)}
        self.vectors = {name.name: name for name in known if isinstance(name, MatrixSymbol)}
        self.numbers = {measured.symbol: measured for measured in problem.measured}
        self.given = {letter.symbol for letter in problem.symbols.values()}
        steps = list(steps)
        moving = {q for step in steps for q, kind in step.coordinates if kind not in FORCES}
        self.frequencies = {q for step in steps for q, kind in step.coordinates if kind == "angular speed"}  # unknowns
        self.varying = {each for q in moving for each in (q, rate(q))}
        results = _results(steps, self.varying)
        unknown = {step.symbol for step in steps}  # these symbols include tensions, which are declared but derived
        self.results = {
            symbol: values for symbol, values in results.items() if symbol in unknown or symbol not in self.given
        }
        self.given -= self.results.keys()
        self.integrated = {step.key: variables_of_integrals(step, known) for step in steps}
        for name in (name for variables in self.integrated.values() for name in variables):
            self.vectors |= {name.name: name} if isinstance(name, MatrixSymbol) else {}
            self.scalars |= {name} if isinstance(name, Symbol) else set()
        self.faults: dict[Complaint, None] = {}
        self.warnings: dict[Complaint, None] = {}
        self.stated: list[Relation] = []  # the inequalities that the statement and the questions contain

    def in_solution(self, formula: TexFormula, key: str = "") -> Math | Text:
        """Return a formula of the solution, with a warning if it disagrees with the results of the page.

        key     the step whose `wording:` contains the formula, if any. If a letter is the variable of several
                integrals, its dimension is taken from the integral of this step
        """
        return self.node(formula, self._with_variables(key))

    def in_question(self, formula: TexFormula) -> Math | Text:
        """Return a formula of the statement or of a question, and note the inequalities in it."""
        try:
            read = self._read(formula, None)
        except Rejected:
            return self.node(formula)
        values = [value for side in read.sides for entries in side.branches for value, _ in entries]
        if len(values) == len(read.sides):
            inequalities = zip(pairwise(values), read.marks[1:], strict=True)
            self.stated += [
                Relation(left, mark, right) for (left, right), mark in inequalities if mark in _INEQUALITIES
            ]
        return self.node(formula)

    def node(self, formula: TexFormula, of_solution: Mapping[str, Declared] | None = None) -> Math | Text:
        """Return the formula for the page; if it cannot be printed, its characters as text.

        of_solution     the letters that the formula may contain, if it belongs to the solution
        """
        from derive.course.latex.quoting import quoted_formula  # imported here, because few problems need it

        try:
            read = self._read(formula, of_solution)
        except Rejected as error:
            is_printable = self._complain(formula, error.complaints)
            return Math(Transcript(quoted_formula(formula.tex))) if is_printable else Text(formula.tex)
        values = [value for side in read.sides for entries in side.branches for value, _ in entries]
        if len(values) == 1 and isinstance(values[0], Symbol) and (lone := _LETTER.fullmatch(formula.tex)):
            return Math(self._letter(values[0], bool(lone["arrow"])))
        letters = {letter.name for value in values for letter in value.free_symbols}
        vectors = [vector for name, vector in self.vectors.items() if name in letters]
        return Math(Transcript(quoted_formula(formula.tex), [*values, *vectors]))

    def _with_variables(self, key: str) -> Mapping[str, Declared]:
        found: dict[Any, Dimension | None] = {}
        for variables in self.integrated.values():
            for name, dimension in variables.items():
                found[name] = dimension if found.get(name, dimension) == dimension else None
        return {**_by_name({**found, **self.integrated.get(key, {})}), **self.letters}

    def _letter(self, symbol: Symbol, is_vector: bool) -> Any:
        """Return a lone letter as the page prints it: as a scalar or as a vector."""
        vector = self.vectors.get(symbol.name)
        return vector if vector is not None and (is_vector or symbol not in self.scalars) else symbol

    def _read(self, formula: TexFormula, of_solution: Mapping[str, Declared] | None) -> ReadMath:
        from derive.course.latex import read_latex
        from derive.course.latex.quoting import Unquotable, quoted_formula

        letters = self.letters if of_solution is None else of_solution
        try:
            read = read_latex(formula.scalar, letters, in_prose=True)
        except Rejected as error:
            if not self.unknown or error.complaints[0].code != "dimension":
                raise
            read = read_latex(formula.scalar, letters, in_prose=True, homogeneous=False)
            if not self._has_unknown(read):
                raise
        else:
            for (left, right), mark in zip(pairwise(read.sides), read.marks[1:], strict=True):
                if not self._has_unknown(read):
                    _compare(left, right)
                self._check_number(left, right, mark)
                if of_solution is not None and mark == "=":
                    self._check_result(left, right)
                    self._check_result(right, left)
                    self._check_equation(left, right)
        try:
            quoted_formula(formula.scalar.text)
        except Unquotable as error:
            raise Rejected(_unquotable(formula, error)) from None
        return read

    def _check_number(self, left: Side, right: Side, mark: str) -> None:
        """Reject `$m = 2\\,\\mathrm{kg}$` if the file gives a different number for m."""
        one, other = left.branches[0][0][0], right.branches[0][0][0]
        if mark == "=" and one in self.numbers and other.is_number and other != self.numbers[one].si:
            known = self.numbers[one]
            message = f"`{left.text}` is {known.number} {known.unit}".rstrip() + f", so it is not `{right.text}`"
            help_line = "correct the number, or leave it out: the page adds the numbers that the statement lacks"
            raise Rejected(Complaint("wrong-number", message, right.place, (), help_line))

    def _check_result(self, left: Side, right: Side) -> None:
        """Warn if the left side is the symbol of a result, and the page does not derive the right side for it.

        A condition, such as omega = omega_0 for resonance, causes no warning.
        """
        one, other = left.branches[0][0][0], right.branches[0][0][0]
        values = self.results.get(one, ())
        said = list(self._in_givens(other))
        is_derived = any(equal(one, other) for value in values for one in self._in_givens(value) for other in said)
        is_condition = isinstance(other, Symbol) or isinstance(-other, Symbol) or other == 0
        known = {*self.results, *self.given}.union(*(value.free_symbols for value in values))
        if not values or is_derived or is_condition or not explicit(other).free_symbols <= known:
            return
        message = f"`{left.text} = {right.text}` is printed, but the page derives {one} = {short(values[-1])}"
        help_line = "correct the formula; if it is about a special case, you can ignore the warning"
        self.warnings[Complaint("differs-from-result", message, right.place, (), help_line, severity="warning")] = None

    def _check_equation(self, left: Side, right: Side) -> None:
        """Warn if an equation with at least two results does not hold for the results of the page.

        A condition on a single result, such as v^2 = g R, causes no warning. Nor does an equation for a frequency that
        is the unknown of a characteristic equation or of a steady motion.
        """
        one, other = left.branches[0][0][0], right.branches[0][0][0]
        if any(isinstance(side, Symbol | MatrixBase) for side in (one, other)):
            return
        apart = explicit(one - other)
        used = self.results.keys() & apart.free_symbols
        values = [value for symbol in used for value in self.results[symbol]]
        known = {*self.results, *self.given, *self.varying}.union(*(value.free_symbols for value in values))
        is_condition = len(used) < 2 or apart.free_symbols & self.frequencies
        if is_condition or not apart.free_symbols <= known or any(map(_seems_zero, self._in_givens(apart))):
            return
        message = f"`{left.text} = {right.text}` is printed, but it does not hold for the results of the page"
        help_line = "correct the equation; if it is about a special case, you can ignore the warning"
        self.warnings[Complaint("differs-from-result", message, right.place, (), help_line, severity="warning")] = None

    def _in_givens(self, value: Any, depth: int = DEEPEST) -> Iterator[Any]:
        """Yield the expression with the symbols of results replaced by their values, for combinations of these values.

        depth   the greatest number of successive replacements
        """
        symbols = [symbol for symbol in self.results if symbol in explicit(value).free_symbols]
        if not symbols or not depth:
            yield explicit(value)
            return
        for values in islice(product(*(self.results[symbol] for symbol in symbols)), MOST_COMBINATIONS):
            known = dict(zip(symbols, values, strict=True))
            replaced = explicit(bound(explicit(value), known)).xreplace(known)
            yield from islice(self._in_givens(replaced, depth - 1), MOST_COMBINATIONS)

    def _has_unknown(self, read: ReadMath) -> bool:
        entries = [value for side in read.sides for branch in side.branches for value, _ in branch]
        return any(self.unknown & value.free_symbols for value in entries)

    def _complain(self, formula: TexFormula, reasons: tuple[Complaint, ...]) -> bool:
        """Record errors, or a warning that the formula is printed without being checked; return whether it is
        printed."""
        from derive.course.latex.quoting import Unquotable, quoted_formula

        wrong = [each for each in reasons if each.code in _WRONG]
        first = reasons[0]
        if wrong:
            self.faults.update(dict.fromkeys(wrong))
            return False
        try:
            quoted_formula(formula.scalar.text)
        except Unquotable as error:
            refused = first if first.code != "latex" or "not known" in first.message else _unquotable(formula, error)
            self.faults[replace(refused, code="formula-in-prose")] = None
            return False
        message = f"this formula is printed, but its letters and dimensions are not checked: {first.message}"
        help_line = first.help if first.code == "ambiguous" else None
        self.warnings[Complaint("unread-formula", message, first.place, (), help_line, severity="warning")] = None
        return True


def _results(steps: Iterable[Step], varying: set[Any]) -> dict[Any, list[Any]]:
    """Return the values that the steps derive for each symbol; coordinates and rates vary, so they are left out."""
    found: dict[Any, list[Any]] = {}
    for step in steps:
        symbol, value = step.symbol, explicit(step.result)
        if isinstance(symbol, MatrixBase) and isinstance(value, MatrixBase):
            pairs = list(zip(symbol, value, strict=True))
        elif symbol is None and isinstance(value, Relation) and value.operator == "=":
            pairs = [value.sides]
        else:
            pairs = [(symbol, value)]
        for name, its_value in pairs:
            if isinstance(name, Symbol) and isinstance(its_value, Expr) and its_value not in found.get(name, ()):
                found.setdefault(name, []).append(its_value)
    return {name: values for name, values in found.items() if name not in varying}


def _unquotable(formula: TexFormula, error: Any) -> Complaint:
    message = str(error).replace("be quoted", "be printed")
    return Complaint("formula-in-prose", message, formula.scalar.place_within(error.at))


def _compare(left: Side, right: Side) -> None:
    """Reject two sides of a chain that differ in shape or in dimension; zero and infinity fit every dimension."""
    if left.shape != right.shape:
        message = f"`{left.text}` and `{right.text}` must both be scalars, or vectors or matrices of the same size"
        raise Rejected(Complaint("dimension", message, right.place))
    for mine, others in zip(left.branches[0], right.branches[0], strict=True):
        (one, dimension), (other, its_dimension) = mine, others
        if dimension != its_dimension and not {one, other} & {Integer(0), oo, -oo}:
            message = f"`{left.text}` is {named(dimension)}, but `{right.text}` is {named(its_dimension)}"
            raise Rejected(Complaint("dimension", f"{message}: they cannot be compared", right.place))


def _letters(problem: Problem, known: Mapping[Any, Dimension | None]) -> dict[str, Declared]:
    """Return the symbols that a formula may contain, by name."""
    found: dict[str, Declared] = {axis: Declared(axis, scalar(axis), "length") for axis in AXES}
    found[TIME.name] = Declared(TIME.name, TIME, "time")
    found.update(_by_name(known))
    found.update({each.name: each for each in problem.letters})
    variants = {f"var{name}": found[name] for name in found if name.partition("_")[0] in _VARIANTS}
    return {**variants, **found}


def _by_name(known: Mapping[Any, Dimension | None]) -> dict[str, Declared]:
    vectors = [symbol for symbol in known if isinstance(symbol, MatrixSymbol)]
    found = {each.name: _derived(Symbol(each.name, real=True), known[each]) for each in vectors}
    return {**found, **{each.name: _derived(each, known[each]) for each in known if isinstance(each, Symbol)}}


def _derived(symbol: Symbol, dimension: Dimension | None) -> _Derived:
    return _Derived(symbol.name, symbol, "", derived=dimension or NUMBER)


def _seems_zero(value: Any) -> bool:
    """Whether a value is zero. A value with roots of sums, which have no normal form, is also tested at trial
    numbers."""
    if is_zero(value):
        return True
    roots = any(not power.exp.is_integer and power.base.has(Pow, Add) for power in value.atoms(Pow))
    points = trial_points(value.free_symbols, *assumptions_about(value.free_symbols), tried=TRIALS)
    return roots and everywhere(points, lambda point: abs(value.xreplace(point).evalf(DIGITS)) < 10 ** (5 - DIGITS))
