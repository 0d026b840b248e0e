"""The statements of an answer as expressions in the symbols of the problem.

A formula such as `g/2l` may have several readings; the likeliest are kept, the best one first. A letter that the
problem does not have stays in the expression and is reported.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from itertools import islice, pairwise
from typing import Any

import sympy
from sympy import Expr, Integer, MatrixBase, Rational, Symbol

from derive.algebra.expressions import PLUS_MINUS, TIME, rate
from derive.audit.time_limit import FAULTS
from derive.documents.choices import readings
from derive.documents.facts import Facts
from derive.documents.meaning import Meaning, Meaningless
from derive.documents.parser import Unreadable, parsed
from derive.documents.source import Span
from derive.documents.syntax import Apply, Frac, Fun, Letter, Mat, Mul, Node, Num, Open, Pow, Vec
from derive.grading.names import Names, bare
from derive.grading.typed_text import Typed, TypedSide, TypedStatement, Unread

MOST_BITS = 3000  # the greatest number of bits of a number
HIGHEST_POWER, HIGHEST_POWER_OF_TEN = 40, 300
MOST_TERMS = 3000  # the greatest number of terms of an expanded power of a sum
MOST_READINGS = 6
_SIGN = Symbol("±", real=True)  # the symbol that `derive.documents` uses for ±


@dataclass(frozen=True)
class Read:
    """One reading of a side: its node and its value.

    decimals   each decimal, with the number of its digits after the point
    unknown    the letters that the problem does not have
    notes      remarks on letters that are read as other letters
    """

    node: Node
    value: Any
    decimals: tuple[tuple[Expr, int], ...] = ()
    unknown: tuple[Symbol, ...] = ()
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class ReadStatement:
    """The readings of each side of a statement."""

    sides: tuple[tuple[Read, ...], ...]
    relations: tuple[str, ...]
    written: TypedStatement = field(repr=False, compare=False, default=TypedStatement(()))


@dataclass
class Reader:
    """Reads statements in the symbols of a problem. `wholes` are the values of vectors and tensors by their names."""

    names: Names
    wholes: Mapping[tuple[str, str], MatrixBase] = field(default_factory=dict)

    def statements(self, answer: Typed) -> list[ReadStatement]:
        return [
            ReadStatement(tuple(self.side(each) for each in one.sides), one.relations, one) for one in answer.statements
        ]

    def side(self, side: TypedSide) -> tuple[Read, ...]:
        """Return the readings of a side; raise `Unread` if it has no reading."""
        try:
            node = parsed(side.tokens)
        except Unreadable as error:
            raise Unread(error.message, error.span if error.span.end else side.span) from None
        found: list[Read] = []
        fault: Unread | None = None
        near = _Near(side).of(node)
        variants = [node] if near == node else [near, node]
        nodes = [each for one in variants for each, _ in islice(readings(one, self.facts), MOST_READINGS)]
        for each in nodes:
            try:
                read = self.value(_with_products(each, self.names))
            except Meaningless as error:
                fault = fault or Unread(error.reason, error.span)
                continue
            except FAULTS:
                fault = fault or Unread("this has no value", side.span)
                continue
            if all(other.value != read.value for other in found):
                found.append(read)
        if not found:
            raise fault or Unread("this has no value", side.span)
        return tuple(found)

    def value(self, node: Node) -> Read:
        meaning = _InProblem(self.facts, names=self.names, wholes=self.wholes)
        value = meaning.of(node)
        value = value.xreplace({_SIGN: PLUS_MINUS})
        _check_size(value, node.span)
        if value.has(sympy.nan, sympy.zoo, sympy.oo, -sympy.oo):
            raise Meaningless("this is not a finite number", node.span)
        unknown = tuple(sorted(meaning.unknown & value.free_symbols, key=str))
        return Read(node, value, tuple(meaning.decimals), unknown, tuple(dict.fromkeys(meaning.notes)))

    @property
    def facts(self) -> Facts:
        facts = Facts()
        for base, sub, order in self.names.symbols:
            if order:
                facts.timed.add((base, sub, frozenset(), ""))
        for letter in ("d", "e"):
            if self.names.has(letter, ""):
                facts.alone[letter, "", frozenset(), 0, ""] = 1
        return facts


@dataclass
class _InProblem(Meaning):
    names: Names = field(default_factory=Names)
    wholes: Mapping[tuple[str, str], MatrixBase] = field(default_factory=dict)
    unknown: set[Symbol] = field(default_factory=set)
    notes: list[str] = field(default_factory=list)

    def symbol(self, node: Letter) -> Symbol:
        found, instead = self.names.meant(node)
        if found is None:
            order = node.dots + node.primes
            name = node.base + (f"_{bare(node.sub)}" if node.sub else "") + (f"_{node.label}" if node.label else "")
            found = Symbol(name, real=True)
            found = rate(found, order) if 0 < order <= 3 else found
            self.unknown.add(found)
        elif instead:
            self.notes.append(f"`{node.base}` is read as {instead.partition('_')[0]}")
        self.symbols.setdefault(found, node)
        return found

    def of_letter(self, node: Letter) -> Any:
        whole = self.wholes.get((node.base, bare(node.sub)))
        if whole is not None and not node.dots and ("vec" in node.marks or not self.names.has(node.base, node.sub)):
            return whole
        if node.base == "0":  # a bold zero
            return Integer(0)
        if node.marks & {"hat", "bb"} and node.base in "ijkxyz":
            return self.unit_vector(node)
        if node.base in ("pi", "infty") or not node.marks:
            return super().of_letter(node)
        return self.symbol(node)

    def of_num(self, node: Num) -> Expr:
        if len(node.text) > 40:
            raise Meaningless("too large: this number has more than 40 characters", node.span)
        return super().of_num(node)

    def of_vec(self, node: Vec) -> Any:
        if not 1 < len(node.entries) <= 9:
            raise Meaningless("this list does not have 2 to 9 entries", node.span)
        return sympy.Matrix([self.entry(each) for each in node.entries])

    def of_pow(self, node: Pow) -> Any:
        base, exponent = self._of(node.base), self._of(node.exponent)
        if isinstance(base, MatrixBase) and isinstance(node.exponent, Letter) and node.exponent.base == "T":
            return base.T
        most = HIGHEST_POWER_OF_TEN if base == 10 else HIGHEST_POWER
        if isinstance(exponent, Expr) and exponent.is_Number and abs(exponent) > most:
            raise Meaningless(f"too large: this exponent must be from -{most} to {most}", node.exponent.span)
        if isinstance(base, Rational) and exponent.is_Number and _bits(base) * abs(exponent) > MOST_BITS:
            raise Meaningless("too large: this number has too many digits", node.span)
        if base == 10 and exponent.is_Integer:
            return Integer(10) ** exponent
        return super().of_pow(node)

    def of_open(self, node: Open) -> Any:
        return self._of(node.alternatives[0])

    def of_lone_letter(self, letter: Letter, by: tuple[tuple[Symbol, int], ...], partial: bool) -> Any:
        (first, order), *more = by
        if first == TIME and not more and not partial and letter.base != "t":
            return self.symbol(Letter(letter.span, letter.base, letter.sub, letter.marks, letter.dots + order))
        return super().of_lone_letter(letter, by, partial)

    def rate_of(self, symbol: Symbol, by: Symbol, partial: bool) -> Expr:
        """Return the derivative of a symbol. A total derivative with respect to time is a rate if the symbol changes
        with time, else 0. Any other derivative is 1 if the two symbols are equal, else 0."""
        if by != TIME or partial:
            return Integer(1) if symbol == by else Integer(0)
        letter = self.symbols.get(symbol)
        if letter is None or not self.facts.changes(letter):
            return Integer(0)
        return self.symbol(Letter(letter.span, letter.base, letter.sub, letter.marks, letter.dots + 1, letter.primes))


def _with_products(node: Any, names: Names) -> Any:
    """Return a node in which `x(t)` is x, `omega^2 (1, 0, 0)` is a product, and `diag(1, 2, 3)` is a matrix."""
    if isinstance(node, tuple):
        return tuple(_with_products(each, names) for each in node)
    if not isinstance(node, Node):
        return node
    call = node.base if isinstance(node, Pow) and isinstance(node.base, Apply) else node
    if isinstance(call, Apply):
        head, arguments = call.head, _with_products(call.arguments, names)
        power = replace(node, base=head) if isinstance(node, Pow) else head
        if len(arguments) == 1 and isinstance(arguments[0], Letter) and arguments[0].base == "t" and head.base != "t":
            return power
        if head.base == "diag":
            return _diagonal(node.span, arguments)
        if len(arguments) > 1 and names.meant(head)[0] is not None:
            return Mul(node.span, (("", power), ("", _with_products(Vec(node.span, arguments), names))))
    node = replace(node, **{
        each.name: _with_products(getattr(node, each.name), names) for each in fields(node) if each.name != "span"
    })  # fmt: skip
    if isinstance(node, Vec) and all(isinstance(each, Vec) for each in node.entries):
        return Mat(node.span, tuple(each.entries for each in node.entries if isinstance(each, Vec)))
    if isinstance(node, Mul):
        for i, ((_, one), (_, other)) in enumerate(pairwise(node.factors)):
            name = one.alternatives[0] if isinstance(one, Open) else one
            if isinstance(name, Letter) and name.base == "diag" and isinstance(other, Vec):
                diagonal = _diagonal(other.span, other.entries)
                factors = (*node.factors[:i], (node.factors[i][0], diagonal), *node.factors[i + 2 :])
                return replace(node, factors=factors)
    return node


class _Near:
    """Ends an argument or a denominator without brackets as soon as possible: `sin a/b` is (sin a)/b,
    `sin a (b + c)` is a product, and `a/b (c + d)` is a/b times a bracket."""

    def __init__(self, side: TypedSide):
        self.strokes = [token.span.start for token in side.tokens if token.is_mark("/")]
        self.brackets = [
            token.span.start for token in side.tokens if token.is_mark("(", "[") or token.is_command("left", "{")
        ]

    def of(self, node: Any) -> Any:
        if isinstance(node, tuple):
            return tuple(map(self.of, node))
        if not isinstance(node, Node):
            return node
        if isinstance(node, Fun) and not self.any_in(self.brackets, node.span.start, _start(node.argument)):
            argument = node.argument
            if isinstance(argument, Frac) and self.has_stroke(argument):
                return Frac(node.span, self.of(replace(node, argument=argument.top)), self.of(argument.bottom))
            if (split := _split(argument)) is not None:
                return Mul(node.span, (("", replace(node, argument=split[0])), ("", self.of(split[1]))))
        if isinstance(node, Frac) and self.has_stroke(node) and (split := _split(node.bottom)) is not None:
            return Mul(node.span, (("", Frac(node.span, self.of(node.top), split[0])), ("", self.of(split[1]))))
        return replace(node, **{
            each.name: self.of(getattr(node, each.name)) for each in fields(node) if each.name != "span"
        })  # fmt: skip

    def has_stroke(self, node: Frac) -> bool:
        return self.any_in(self.strokes, node.top.span.end, node.bottom.span.start)

    @staticmethod
    def any_in(places: list[int], start: int, end: int) -> bool:
        return any(start <= each < end for each in places)


def _start(node: Node) -> int:
    return min((each.span.start for each in node.walk() if each.span.end), default=node.span.start)


def _split(node: Node) -> tuple[Node, Node] | None:
    """Return the letter and the bracket of `a(b + c)`, which may be a product or a call; otherwise None."""
    if isinstance(node, Apply) and len(node.arguments) > 1:
        return node.head, Vec(node.span, node.arguments)
    if not isinstance(node, Open) or node.kind != "apply":
        return None
    product = node.alternatives[1]
    if not isinstance(product, Mul) or len(product.factors) != 2:
        return None
    call = node.alternatives[0]
    if isinstance(call, Apply) and len(call.arguments) == 1:
        only = call.arguments[0]
        if isinstance(only, Letter) and only.base == "t":
            return None
    return product.factors[0][1], product.factors[1][1]


def _diagonal(span: Span, entries: tuple[Node, ...]) -> Mat:
    zero = Num(span, "0")
    return Mat(span, tuple(tuple(e if i == j else zero for j, _ in enumerate(entries)) for i, e in enumerate(entries)))


def _bits(number: Rational) -> int:
    return int(max(abs(number.p).bit_length(), number.q.bit_length()))


def _check_size(value: Any, span: Span) -> None:
    """Raise `Meaningless` if numbers, powers or expanded powers are too large to compare."""
    for entry in value if isinstance(value, MatrixBase) else (value,):
        for node in sympy.preorder_traversal(entry):
            if isinstance(node, Rational) and _bits(node) > MOST_BITS:
                raise Meaningless("too large: this number has too many digits", span)
            if node.is_Pow and node.exp.is_Number:
                power, terms = abs(node.exp), len(node.base.args) if node.base.is_Add else 1
                if power > HIGHEST_POWER and not node.base.is_Number:
                    most = HIGHEST_POWER
                    raise Meaningless(f"too large: this exponent must be from -{most} to {most}", span)
                if terms > 1 and sympy.binomial(int(power) + terms, terms) > MOST_TERMS:
                    raise Meaningless("too large: this power of a sum has too many terms", span)
