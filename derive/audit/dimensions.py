"""The dimensions of the letters of a problem, found from its own equations, and the row that contradicts all others.

All terms of an equation must have the same dimension. Together with the usual meaning of a few letters (t is a time, m
is a mass, g is an acceleration), the equations determine the dimensions of the other letters. A row is reported if it
contradicts the other rows and these agree with each other.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field, replace
from fractions import Fraction

import sympy
from sympy import Expr, MatrixBase, Symbol

from derive.audit.claims import Claim, Outcome
from derive.audit.named_quantities import Powers
from derive.documents.facts import ANGLES
from derive.documents.meaning import Meaning
from derive.documents.syntax import Text
from derive.units import UNIT_NAMES

USUAL = {  # the powers of mass, length and time
    "t": (0, 0, 1), "m": (1, 0, 0), "M": (1, 0, 0), "l": (0, 1, 0), "R": (0, 1, 0), "g": (0, 1, -2),
    "x": (0, 1, 0), "y": (0, 1, 0), "z": (0, 1, 0), "r": (0, 1, 0), "omega": (0, 0, -1), "T": (1, 2, -2),
    "U": (1, 2, -2),
}  # fmt: skip
# l may also name an angular momentum, T a period or a tension, R a resultant force, and x, y, z and r a ratio of
# lengths.
LESS_USUAL = ("l", "T", "R", "x", "y", "z", "r")
# These letters often have a second meaning, such as a length and a Lagrangian, even if words name their dimension.
TWO_MEANINGS = ("E", "H", "L", "T", "U", "V", "p")
MOST_CANDIDATES = 12
FEWEST_CLAIMS = 6
UNDERIVED = (Outcome.DEFINES, Outcome.UNDECIDED)
FOLLOWS = (Outcome.HOLDS, Outcome.APPROXIMATES)
Form = dict[str, Fraction]  # the exponents of the letters in a product


class Unclear(Exception):
    """The error for a side whose dimension cannot be found."""


@dataclass
class Equation:
    """A product of letters with its dimension."""

    source: int  # the number of a claim, or -1 for a dimension from the words or from the name of a letter
    form: Form
    powers: tuple[Fraction, ...] = (Fraction(0),) * 3


@dataclass
class _System:
    pivots: dict[str, tuple[Form, list[Fraction], set[int]]] = field(default_factory=dict)
    conflicts: list[set[int]] = field(default_factory=list)

    def add(self, equation: Equation) -> None:
        form, powers, sources = dict(equation.form), list(equation.powers), {equation.source}
        while True:
            letter = next((each for each in form if each in self.pivots and form[each]), None)
            if letter is None:
                break
            pivot, of_pivot, origins = self.pivots[letter]
            factor = form[letter]
            for each, exponent in pivot.items():
                form[each] = form.get(each, Fraction(0)) - factor * exponent
            powers = [a - factor * b for a, b in zip(powers, of_pivot, strict=True)]
            sources |= origins
        rest = {each: exponent for each, exponent in form.items() if exponent}
        if not rest:
            if any(powers):
                self.conflicts.append(sources - {-1})
            return
        letter = min(rest)
        factor = rest[letter]
        self.pivots[letter] = (
            {each: exponent / factor for each, exponent in rest.items()}, [each / factor for each in powers], sources,
        )  # fmt: skip


def odd_claims(claims: Sequence[Claim], meaning: Meaning, named: Mapping[str, Powers]) -> list[Claim]:
    """Return the claims that may contain an error: without any one of them, all dimensions agree.

    named   the dimensions of letters that the words of the document name
    """
    wrong = {each.number for each in claims if each.verdict is not None and each.verdict.outcome is Outcome.DIFFERS}
    agreed = [each for each in claims if not _repeats_slip(each, wrong)]
    equations = [each for claim in agreed for each in equations_of(claim, meaning)]
    if len({each.source for each in equations}) + len(named) < FEWEST_CLAIMS:
        return []
    equations += usual(equations, meaning, named)
    momenta = {each for equation in equations for each in equation.form if each.startswith("p_")}  # or angular momenta
    unsure = {*TWO_MEANINGS, *momenta, *(each for each in LESS_USUAL if each not in named)}
    if any(not _conflicts(_without_usual({letter}, equations)) for letter in sorted(unsure)):
        return []  # the letter may have a different dimension here: `l` is an angular momentum
    found = _candidates(claims, equations)
    sure = [each for each in _without_usual(unsure, equations) if not any(map(_is_unsure, each.form))]
    if not found and len(only := _candidates(claims, sure)) == 1:
        return only
    return found


def _is_unsure(letter: str) -> bool:
    """Whether a letter may have two meanings, or is a vector, whose bold and plain letters may differ."""
    return letter in TWO_MEANINGS or letter.startswith(("vec ", "hat "))


def _without_usual(letters: Set[str], equations: Sequence[Equation]) -> list[Equation]:
    """Return equations without the dimensions that letters have from words or from their names."""
    return [each for each in equations if each.source != -1 or not letters >= each.form.keys()]


def _candidates(claims: Sequence[Claim], equations: Sequence[Equation]) -> list[Claim]:
    """Return the claims without any one of which the equations agree; none if all equations agree."""
    conflicts = _conflicts(equations)
    if not conflicts:
        return []
    shared = set.intersection(*conflicts)
    candidates = [claim for claim in claims if claim.number in shared]
    for outcomes in (UNDERIVED, FOLLOWS):
        among = [each for each in candidates if each.verdict is not None and each.verdict.outcome in outcomes]
        found = [
            claim
            for claim in among[:MOST_CANDIDATES]
            if not _conflicts([each for each in equations if each.source != claim.number])
        ]
        if found:
            return found
    return []


def _repeats_slip(claim: Claim, wrong: set[int]) -> bool:
    """Whether a claim is wrong, or carries on the slip of a wrong claim."""
    before = claim.before.number if claim.before is not None else -1
    given = {*claim.verdict.given, claim.verdict.inherits} if claim.verdict is not None else set()
    return bool({claim.number, before, *given} & wrong)


def _conflicts(equations: Sequence[Equation]) -> list[set[int]]:
    system = _System()
    for each in equations:
        system.add(each)
    return system.conflicts


def usual(equations: Sequence[Equation], meaning: Meaning, named: Mapping[str, Powers]) -> Iterator[Equation]:
    """Yield the dimensions that the words of the document or, by default, the names of letters give; an angle is
    dimensionless."""
    names = {each for equation in equations for each in equation.form}
    yield Equation(-1, {"t": Fraction(1)}, (Fraction(0), Fraction(0), Fraction(1)))
    for symbol, letter in meaning.symbols.items():
        if symbol.name not in names or letter.dots or letter.marks or letter.primes or letter.label:
            continue
        if symbol.name in named:
            yield Equation(-1, {symbol.name: Fraction(1)}, named[symbol.name])
        elif letter.base in ANGLES - {"gamma"}:  # gamma is often a rate
            yield Equation(-1, {symbol.name: Fraction(1)})
        elif letter.base in USUAL and (not letter.sub or letter.sub in "0123"):
            yield Equation(-1, {symbol.name: Fraction(1)}, tuple(map(Fraction, USUAL[letter.base])))


def equations_of(claim: Claim, meaning: Meaning) -> Iterator[Equation]:
    """Yield the equations which state that all terms of a claim have the same dimension."""
    if claim.values is None or claim.relation not in ("=", ":=", "~", "<", ">", "<=", ">="):
        return
    left, right = claim.values
    if isinstance(left, MatrixBase) and isinstance(right, MatrixBase) and left.shape == right.shape:
        for pair in zip(left, right, strict=True):
            yield from equations_of(replace(claim, values=pair), meaning)
        return
    if isinstance(left, MatrixBase) or isinstance(right, MatrixBase):
        return
    if (left.is_number and left != 0) or (right.is_number and right != 0) or left.atoms(sympy.Float):
        return
    if any(_is_number_with_unit(each) for each in (left, right)) or _has_unit(claim):
        return
    if isinstance(right, sympy.exp):  # `x = e^{st}` is the form of a solution; its constant factor is left out
        return
    found: list[Form] = []
    try:
        first = form_of(left, meaning, found)
        second = form_of(right, meaning, found)
    except Unclear:
        return
    if first is not None and second is not None:
        found.append(_quotient(first, second))
    for form in found:
        rest = {name: exponent for name, exponent in form.items() if exponent}
        if rest:
            yield Equation(claim.number, rest)


def _is_number_with_unit(side: Expr) -> bool:
    """Whether a side may be a number with a unit whose letters are italic: `435g`, `4.2 m/s`."""
    names = [each.name for each in side.free_symbols if each.name != "±"]
    have_numbers = all(each.as_coeff_Mul()[0] != 1 for each in sympy.Add.make_args(side))
    return bool(names) and have_numbers and all(each in UNIT_NAMES for each in names)


def _has_unit(claim: Claim) -> bool:
    """Whether a side contains an upright unit, as in `a^2 + (60 cm)^2`; a number with such a unit is read as a pure
    number.
    """
    sides = [each for each in (claim.left, claim.right) if each is not None]
    return any(isinstance(node, Text) and node.text.startswith("unit ") for side in sides for node in side.walk())


def form_of(value: Expr, meaning: Meaning, found: list[Form]) -> Form | None:
    """Return the form of an expression, None for zero; add to `found` the products that must be dimensionless."""
    if value == 0:
        return None
    if value.is_Number or value.is_NumberSymbol or value is sympy.I:
        return {}
    if value.is_Symbol:
        return of_symbol(value, meaning)
    if value.is_Mul:
        product: Form = {}
        for each in value.args:
            form = form_of(each, meaning, found)
            for name, exponent in (form or {}).items():
                product[name] = product.get(name, Fraction(0)) + exponent
        return product
    if value.is_Add:
        forms = [form for each in value.args if (form := form_of(each, meaning, found)) is not None]
        found.extend(_quotient(forms[0], each) for each in forms[1:])
        return forms[0]
    if value.is_Pow:
        form = form_of(value.base, meaning, found) or {}
        if value.exp.is_Rational:
            power = Fraction(int(value.exp.p), int(value.exp.q))
            return {name: power * exponent for name, exponent in form.items()}
        if value.base is sympy.E or value.base.is_number:
            found.append(form_of(value.exp, meaning, found) or {})
            return {}
        raise Unclear
    if isinstance(value, sympy.exp):
        found.append(form_of(value.args[0], meaning, found) or {})
        return {}
    if isinstance(value, sympy.Integral):
        return _of_integral(value, meaning, found)
    if isinstance(value, sympy.Abs):
        return form_of(value.args[0], meaning, found)
    if isinstance(value, sympy.Function) and len(value.args) == 1:
        found.append(form_of(value.args[0], meaning, found) or {})
        return {}
    raise Unclear


def _of_integral(value: sympy.Integral, meaning: Meaning, found: list[Form]) -> Form:
    product = form_of(value.function, meaning, found) or {}
    for variable, *limits in value.limits:
        of_variable = of_symbol(variable, meaning)
        forms = [form_of(each, meaning, found) for each in limits if each.is_finite is not False]
        found.extend(_quotient(each, of_variable) for each in forms if each is not None)
        product = _quotient(product, {name: -exponent for name, exponent in of_variable.items()})
    return product


def of_symbol(symbol: Symbol, meaning: Meaning) -> Form:
    if symbol.name == "±":
        return {}
    if symbol in meaning.derivatives:
        of, by, _ = meaning.derivatives[symbol]
        form = of_symbol(meaning.symbol(of), meaning)
        for each, order in by:
            for name, exponent in of_symbol(each, meaning).items():
                form = {**form, name: form.get(name, Fraction(0)) - order * exponent}
        return form
    letter = meaning.symbols.get(symbol)
    if letter is None or "(" in symbol.name:
        raise Unclear
    form = {symbol.name.rstrip("."): Fraction(1)}
    if letter.dots:
        form["t"] = form.get("t", Fraction(0)) - letter.dots
    return form


def _quotient(one: Form, other: Form) -> Form:
    return {name: one.get(name, Fraction(0)) - other.get(name, Fraction(0)) for name in {**one, **other}}
