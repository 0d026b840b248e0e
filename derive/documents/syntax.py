r"""The nodes of a formula as the author wrote it: signs, brackets and differentials are kept.

An `Open` node has several readings; its `kind` says what is open:

    apply        a function of the bracket after a letter, or a product of the letter and the bracket
    extent       how far the argument of `\sin` reaches
    superscript  a power, a label or degrees
    letter d     a differential, or a letter
    word         one name, or a product of letters
    slash        how far a denominator reaches
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields

from derive.documents.source import Span


@dataclass(frozen=True)
class Node:
    span: Span

    @property
    def kids(self) -> Iterator[Node]:
        """Yield the nodes directly inside this one."""
        for each in fields(self):
            yield from _nodes_in(getattr(self, each.name))

    def walk(self) -> Iterator[Node]:
        yield self
        for kid in self.kids:
            yield from kid.walk()


def _nodes_in(value: object) -> Iterator[Node]:
    if isinstance(value, Node):
        yield value
    elif isinstance(value, tuple):
        for each in value:
            yield from _nodes_in(each)


@dataclass(frozen=True)
class Num(Node):
    text: str


@dataclass(frozen=True)
class Letter(Node):
    """A letter with its subscript and marks; its `identity` does not depend on its dots."""

    base: str
    sub: str = ""
    marks: frozenset[str] = frozenset()
    dots: int = 0
    primes: int = 0
    label: str = ""  # a superscript that is a label

    @property
    def identity(self) -> tuple[str, str, frozenset[str], int, str]:
        return self.base, self.sub, self.marks, self.primes, self.label

    def named(self) -> str:
        """Return the letter as a word: `omega_1`, `vec a`, `x'`."""
        name = self.base + (f"_{self.sub}" if self.sub else "") + (f"^{self.label}" if self.label else "")
        return " ".join([*sorted(self.marks), name]) + "'" * self.primes


@dataclass(frozen=True)
class Add(Node):
    terms: tuple[tuple[str, Node], ...]  # the sign, one of + - ± ∓, and the term


@dataclass(frozen=True)
class Mul(Node):
    factors: tuple[tuple[str, Node], ...]  # the sign before the factor: nothing, `cdot` or `times`


@dataclass(frozen=True)
class Frac(Node):
    top: Node
    bottom: Node


@dataclass(frozen=True)
class Pow(Node):
    base: Node
    exponent: Node


@dataclass(frozen=True)
class Root(Node):
    inner: Node
    index: Node | None = None


@dataclass(frozen=True)
class Fun(Node):
    name: str
    argument: Node
    power: Node | None = None
    base: Node | None = None  # the base of a logarithm


@dataclass(frozen=True)
class Apply(Node):
    head: Letter
    arguments: tuple[Node, ...]


@dataclass(frozen=True)
class Condition(Node):
    """An argument with a value: `U(\\theta=0)`."""

    left: Node
    right: Node


@dataclass(frozen=True)
class Der(Node):
    """A derivative of `of` with respect to letters, each with its order; an operator alone has no `of`.

    partial   whether the d is curly
    """

    partial: bool
    by: tuple[tuple[Node, int], ...]
    of: Node | None


@dataclass(frozen=True)
class Diff(Node):
    of: Node
    order: int = 1
    partial: bool = False


@dataclass(frozen=True)
class Nabla(Node):
    """A gradient, divergence (`cdot`), curl (`times`) or Laplacian (`squared`)."""

    kind: str
    of: Node


@dataclass(frozen=True)
class Cases(Node):
    """Values, each with the words or the formula of its condition."""

    values: tuple[Node, ...]
    conditions: tuple[str, ...]


@dataclass(frozen=True)
class Sign(Node):
    """One integral sign with its limits."""

    lower: Node | None
    upper: Node | None
    closed: bool = False


@dataclass(frozen=True)
class Int(Node):
    """Integral signs, differentials and the factors of integrands, in the order in which they are written."""

    items: tuple[Node, ...]


@dataclass(frozen=True)
class Sum(Node):
    """A sum or product over an index, or over a list of indices."""

    name: str  # sum or prod
    index: Node | None
    lower: Node | None
    upper: Node | None
    body: Node


@dataclass(frozen=True)
class Mat(Node):
    rows: tuple[tuple[Node, ...], ...]
    determinant: bool = False


@dataclass(frozen=True)
class Vec(Node):
    entries: tuple[Node, ...]
    brackets: str = "("


@dataclass(frozen=True)
class Group(Node):
    inner: Node
    brackets: str


@dataclass(frozen=True)
class Abs(Node):
    inner: Node


@dataclass(frozen=True)
class EvalBar(Node):
    """A value, or a difference of values, of an expression: `[F]_a^b`, `f|_{x=0}`."""

    inner: Node
    lower: Node | None
    upper: Node | None


@dataclass(frozen=True)
class Text(Node):
    text: str


@dataclass(frozen=True)
class Open(Node):
    kind: str
    alternatives: tuple[Node, ...]
