"""What a whole document shows about its letters: which are functions, vectors or tensors, and which change with time.

Facts are counted over all formulas of the document, because a letter is often explained far from its use.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from itertools import pairwise

from derive.documents.syntax import (
    Add,
    Apply,
    Condition,
    Der,
    Diff,
    EvalBar,
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
    Sum,
    Vec,
)

Identity = tuple[str, str, frozenset[str], int, str]
UNKNOWN: Identity = ("?", "", frozenset(), 0, "")  # the variable of a function of which only a value is written: V(q_r)
VARIABLES = frozenset({"t", "x", "y", "z", "r", "s", "theta", "phi", "q", "u", "tau"})
KINDS = ("positive", "real", "integer", "constant", "changes", "vector", "tensor")
TENSORS = ("I", "J", "Theta")
E, I = (("e", "", frozenset[str](), 0, ""), ("i", "", frozenset[str](), 0, ""))  # the letters e and i
ANGLES = frozenset({"theta", "phi", "psi", "alpha", "beta", "gamma", "chi"})


@dataclass
class Facts:
    functions: defaultdict[Identity, Counter[Identity]] = field(default_factory=lambda: defaultdict(Counter))
    products: Counter[Identity] = field(default_factory=Counter)  # letters before a bracket that is a factor
    timed: set[tuple[str, str, frozenset[str], str]] = field(default_factory=set)
    tensors: set[Identity] = field(default_factory=set)  # bold I, J or Theta before a vector, without a dot or a cross
    marked: set[Identity] = field(default_factory=set)  # letters that an arrow or bold type marks as vectors
    shapes: dict[tuple[int, Identity], tuple[int, int]] = field(default_factory=dict)  # scope and letter -> its shape
    whole_arguments: Counter[Identity] = field(default_factory=Counter)
    alone: Counter[Identity] = field(default_factory=Counter)
    seen: Counter[Identity] = field(default_factory=Counter)
    integrated: Counter[Identity] = field(default_factory=Counter)
    differentiated_by: set[Identity] = field(default_factory=set)  # variables of derivatives, without dots and primes
    subscripts: Counter[str] = field(default_factory=Counter)
    has_brackets: bool = False  # whether {f, g} or <f, g> can be a Poisson bracket or an inner product
    has_lagrange: bool = False  # whether the text speaks of Lagrange's equations
    indices: set[str] = field(default_factory=set)  # indices of sums
    phases: int = 0  # the number of exponents with a factor i, as in e^{i w t}
    declared: dict[Identity, str] = field(default_factory=dict)  # the kinds that the reader of the document declares

    def declare(self, kinds: Mapping[Identity, str]) -> None:
        """Add the kinds of letters that the reader of the document declares."""
        self.declared.update(kinds)
        for (base, sub, marks, _, label), kind in kinds.items():
            if kind == "changes":
                self.timed.add((base, sub, marks, label))
            elif kind in ("constant", "positive", "integer"):
                self.timed.discard((base, sub, marks, label))

    def kind_of(self, letter: Letter) -> str:
        return self.declared.get((letter.base, letter.sub, letter.marks, letter.primes, letter.label), "")

    def is_function(self, letter: Letter) -> bool:
        bare = (letter.base, letter.sub, letter.marks, 0, letter.label)
        found = self.functions.get(letter.identity) or self.functions.get(bare) or Counter()
        return found.total() > self.products[letter.identity]

    def variables_of(self, letter: Letter) -> Counter[Identity]:
        bare = (letter.base, letter.sub, letter.marks, 0, letter.label)
        found = self.functions.get(letter.identity) or self.functions.get(bare) or Counter()
        places = {each for each in found if each[1] and (each[0], "", *each[2:]) in found}  # r_0, if r is a variable
        return Counter({each: count for each, count in found.items() if each != UNKNOWN and each not in places})

    def is_variable(self, letter: Letter) -> bool:
        """Whether the document differentiates with respect to a letter or its rate: y in dF/dy and in dF/dy'."""
        return _unprimed(letter) in self.differentiated_by

    def changes(self, letter: Letter) -> bool:
        """Whether a letter changes with time."""
        if _timeless(letter) in self.timed:
            return True
        if self.kind_of(letter) in ("constant", "integer"):
            return False
        return any(base == "t" for base, *_ in self.variables_of(letter))

    def shape(self, letter: Letter, scope: int) -> tuple[int, int] | None:
        """Return the shape of the list or matrix that a letter is set equal to in a scope, or None."""
        return self.shapes.get((scope, letter.identity))

    def is_vector(self, letter: Letter, scope: int) -> bool:
        if kind := self.kind_of(letter):
            return kind == "vector"
        shape = self.shape(letter, scope)
        if shape is None:
            return "vec" in letter.marks and "hat" not in letter.marks and letter.identity not in self.tensors
        return shape[1] == 1

    @property
    def has_imaginary_unit(self) -> bool:
        """Whether the letter i is the imaginary unit: it is in exponents, and it is neither an index nor a quantity."""
        return self.phases > 0 and "i" not in self.indices and not self.alone[I]

    @property
    def has_axes(self) -> bool:
        """Whether bold i, j and k all occur, so that they are the unit vectors of the axes."""
        return all(self.seen[each, "", frozenset({"vec"}), 0, ""] for each in "ijk")

    def is_tensor(self, letter: Letter, scope: int) -> bool:
        if kind := self.kind_of(letter):
            return kind == "tensor"
        shape = self.shape(letter, scope)
        return letter.identity in self.tensors if shape is None else shape[1] > 1

    def entries(self, letter: Letter) -> list[list[str]] | None:
        """Return the indices with which the document writes the entries of an inertia tensor, such as `xx`.

        The text of an entry that the document never writes is empty, because the entry is zero; for `yy` it is `xx`,
        because the two moments are then equal. The result is None unless the document writes both `I_xx` and `I_zz`, or
        all of `I_1`, `I_2` and `I_3`."""
        written = {sub for base, sub, marks, _, label in self.seen if base == letter.base and not marks and not label}
        if {"xx", "zz"} <= written:
            found = [[a + b if a + b in written else b + a if b + a in written else "" for b in "xyz"] for a in "xyz"]
            found[1][1] = found[1][1] or "xx"
            return found
        if {"1", "2", "3"} <= written:
            return [[a if a == b else "" for b in "123"] for a in "123"]
        return None


def _timeless(letter: Letter) -> tuple[str, str, frozenset[str], str]:
    return letter.base, letter.sub, letter.marks, letter.label


def facts_of(sides: Iterable[Node], equations: Iterable[tuple[Node, Node, int]]) -> Facts:
    """Return the facts that the sides of all statements show. Each of `equations` has two sides and a scope."""
    facts = Facts()
    for side in sides:
        if isinstance(side, Letter):
            facts.alone[side.identity] += 1
        for node in _preferred(side):
            _look_at(node, facts)
        if isinstance(side, Open) and side.kind == "apply":
            call = side.alternatives[0]
            if isinstance(call, Apply) and len(call.arguments) == 1 and isinstance(call.arguments[0], Letter):
                argument = call.arguments[0]
                variable = argument.identity if not argument.sub else UNKNOWN  # `V(q_r)` is only a value of V
                facts.functions[call.head.identity][variable] += 2
    for left, right, scope in equations:
        for one, other in ((left, right), (right, left)):
            one = _bare(one)
            if isinstance(one, Letter) and (shape := shape_of(other)) is not None and not _contains(other, one):
                facts.shapes.setdefault((scope, one.identity), shape)
    return facts


def _contains(node: Node, letter: Letter) -> bool:
    """Whether a list contains the letter on the other side: `a = {a, 2a, 3a}` for a vector and a length."""
    return any(isinstance(each, Letter) and each.identity == letter.identity for each in node.walk())


def shape_of(node: Node) -> tuple[int, int] | None:
    """Return the shape of the only list or matrix that is written out as a factor of a side, or None."""
    node = _bare(node)
    if isinstance(node, Mat) and not node.determinant:
        rows, columns = len(node.rows), max(map(len, node.rows))
        return (columns, 1) if rows == 1 and columns > 1 else (rows, columns)
    if isinstance(node, Vec) and node.brackets in "}>)" and len(node.entries) in (2, 3):
        if any(isinstance(each, Condition) for each in node.entries):
            return None
        return (len(node.entries), 1)
    if isinstance(node, Mul):
        shapes = [shape for _, each in node.factors if (shape := shape_of(each)) is not None]
        return shapes[0] if len(shapes) == 1 else None
    if isinstance(node, Add) and len(node.terms) == 1:
        return shape_of(node.terms[0][1])
    return None


def _bare(node: Node) -> Node:
    while isinstance(node, Group):
        node = node.inner
    return node


def _preferred(node: Node) -> Iterable[Node]:
    yield node
    kids = node.alternatives[:1] if isinstance(node, Open) else node.kids
    if isinstance(node, Open) and node.kind == "apply":  # the reading as a product contains the letter, and no `Apply`
        kids = node.alternatives[1:]
    for kid in kids:
        yield from _preferred(kid)


def _has_phase(node: Node) -> bool:
    """Whether a node is an exponential function whose exponent contains the letter i."""
    if isinstance(node, Pow):
        exponent = node.exponent if isinstance(node.base, Letter) and node.base.identity == E else None
    else:
        exponent = node.argument if isinstance(node, Fun) and node.name == "exp" else None
    return exponent is not None and any(isinstance(each, Letter) and each.identity == I for each in exponent.walk())


def _look_at(node: Node, facts: Facts) -> None:
    facts.phases += _has_phase(node)
    if isinstance(node, Letter):
        facts.seen[node.identity] += 1
        facts.subscripts[node.sub] += 1
        if node.dots:
            facts.timed.add(_timeless(node))
        if "vec" in node.marks:
            facts.marked.add(node.identity)
    elif isinstance(node, Mul):
        for (_, one), (mark, other) in pairwise(node.factors):
            if isinstance(one, Letter) and isinstance(other, Letter) and not mark and one.base in TENSORS:
                if "vec" in one.marks and "vec" in other.marks:
                    facts.tensors.add(one.identity)
    elif isinstance(node, Open) and node.kind == "apply":
        call, product = node.alternatives
        _look_at_call(call, product, facts)
    elif isinstance(node, Apply):
        for argument in node.arguments:
            variable = _bare(argument.left if isinstance(argument, Condition) else argument)
            if isinstance(variable, Letter):
                facts.functions[_unprimed(node.head)][variable.identity] += 2
            else:
                facts.functions[_unprimed(node.head)][UNKNOWN] += 1
    elif isinstance(node, Der):
        for by, _ in node.by:
            if isinstance(by, Letter):
                facts.differentiated_by.add(_unprimed(by))
            of = _bare(node.of) if node.of is not None else None
            if isinstance(by, Letter) and by.base == "t" and isinstance(of, Letter):
                facts.timed.add(_timeless(of))
            if isinstance(by, Letter) and isinstance(of, Letter) and not node.partial and by.base != "t":
                facts.functions[of.identity][by.identity] += 1
    elif isinstance(node, Sum):
        if isinstance(index := _bare(node.index) if node.index is not None else None, Letter):
            facts.indices.add(index.base)
    elif isinstance(node, Diff):
        if isinstance(of := _bare(node.of), Letter):
            facts.integrated[of.identity] += 1
    elif isinstance(node, Fun) and node.name in ("sin", "cos", "tan"):
        if isinstance(argument := _bare(node.argument), Letter):
            facts.whole_arguments[argument.identity] += 1


def _is_single_term(product: Node) -> bool:
    """Whether the bracket after a letter contains one term and has no power, as in U(1/u): a product needs no such
    bracket."""
    group = product.factors[-1][1] if isinstance(product, Mul) else product
    return isinstance(group, Group) and not isinstance(group.inner, Add)


def _unprimed(letter: Letter) -> Identity:
    return letter.base, letter.sub, letter.marks, 0, letter.label


def _look_at_call(call: Node, product: Node, facts: Facts) -> None:
    while isinstance(call, Pow | EvalBar):
        call = call.base if isinstance(call, Pow) else call.inner
    if not isinstance(call, Apply) or len(call.arguments) != 1:
        return
    argument, head = _bare(call.arguments[0]), call.head
    if isinstance(argument, Letter) and argument.base in VARIABLES and argument.identity != head.identity:
        if argument.base == "t" and argument.sub:
            facts.functions[_unprimed(head)][UNKNOWN] += 1  # a value at an instant
        elif argument.base == "t" or head.primes or not argument.sub:
            facts.functions[_unprimed(head)][argument.identity] += 1
    elif not isinstance(argument, Num) and not _is_single_term(product):
        if not any(isinstance(each, Letter) and each.base == "t" for each in argument.walk()):
            facts.products[head.identity] += 1


__all__ = ["ANGLES", "Facts", "Int", "Mul", "facts_of", "shape_of"]
