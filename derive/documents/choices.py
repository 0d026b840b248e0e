"""For each `Open` node, the alternative that the facts of the document select, and the rule behind this choice."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from itertools import islice
from typing import Any

from derive.documents.facts import ANGLES, Facts
from derive.documents.source import Span
from derive.documents.syntax import Apply, Diff, EvalBar, Fun, Group, Letter, Mul, Node, Num, Open, Pow, Root

MOST_READINGS = 6
GREEK_INDICES = frozenset({"mu", "nu", "rho", "sigma", "lambda", "kappa", "alpha", "beta"})


@dataclass(frozen=True)
class Choice:
    """The choice of one alternative of an `Open` node: its `index`, and the `rule` that selects it.

    sure   whether the other alternatives need not be tried
    """

    kind: str
    span: Span
    index: int
    rule: str
    sure: bool


def readings(node: Node, facts: Facts) -> list[tuple[Node, tuple[Choice, ...]]]:
    """Return the readings of a side, the likeliest first."""
    return list(islice(_readings(node, facts), MOST_READINGS))


def _readings(node: Node, facts: Facts) -> Iterator[tuple[Node, tuple[Choice, ...]]]:
    if isinstance(node, Open):
        first = choice_of(node, facts)
        for chosen, choices in _readings(node.alternatives[first.index], facts):
            yield chosen, (first, *choices)
        if not first.sure:
            for index, alternative in enumerate(node.alternatives):
                if index == first.index:
                    continue
                other = replace(first, index=index, rule="another reading")
                for chosen, choices in _readings(alternative, facts):
                    yield chosen, (other, *choices)
        return
    kids = [(each.name, value) for each in fields(node) if _has_open(value := getattr(node, each.name))]
    if not kids:
        yield node, ()
        return
    for values, choices in _combined([value for _, value in kids], facts):
        yield replace(node, **{name: value for (name, _), value in zip(kids, values, strict=True)}), choices


def _has_open(value: Any) -> bool:
    if isinstance(value, Node):
        return any(isinstance(each, Open) for each in value.walk())
    return isinstance(value, tuple) and any(map(_has_open, value))


def _combined(values: list[Any], facts: Facts) -> Iterator[tuple[list[Any], tuple[Choice, ...]]]:
    if not values:
        yield [], ()
        return
    for value, choices in islice(_of_value(values[0], facts), MOST_READINGS):
        for rest, more in islice(_combined(values[1:], facts), MOST_READINGS):
            yield [value, *rest], (*choices, *more)


def _of_value(value: Any, facts: Facts) -> Iterator[tuple[Any, tuple[Choice, ...]]]:
    if isinstance(value, Node):
        yield from _readings(value, facts)
    elif isinstance(value, tuple) and _has_open(value):
        for values, choices in _combined(list(value), facts):
            yield tuple(values), choices
    else:
        yield value, ()


def choice_of(node: Open, facts: Facts) -> Choice:
    index, rule, sure = RULES[node.kind](node, facts)
    return Choice(node.kind, node.span, index, rule, sure)


def _apply(node: Open, facts: Facts) -> tuple[int, str, bool]:
    call = node.alternatives[0]
    while isinstance(call, Pow | EvalBar | Fun):
        call = call.base if isinstance(call, Pow) else call.inner if isinstance(call, EvalBar) else call.argument
    if not isinstance(call, Apply):
        return 1, "a product", True
    head, argument = call.head, call.arguments[0]
    inner = getattr(argument, "inner", argument)
    bare = replace(head, dots=0, primes=0)
    variables = facts.variables_of(bare)
    if head.base == "O" and not head.sub and ("cal" in head.marks or isinstance(inner, Pow)):
        return 0, "terms that are left out", True
    if head.primes and facts.is_function(bare):
        return 0, "a derivative with its argument", True
    if not facts.is_function(bare):
        if isinstance(inner, Letter) and inner.base == "t" and head.base != "t":
            return 0, "a function of time", False
        if isinstance(inner, Num):
            return 0, "a value of a function, because a product rarely has brackets around a number", False
        is_sure = head.base not in ("f", "F", "y", "U", "V", "u", "h")
        return 1, "elsewhere a factor at least as often as a function", is_sure
    letters = {each.identity for each in argument.walk() if isinstance(each, Letter)}
    if letters & set(variables):
        return 0, "a function that the document writes with this argument", facts.products[head.identity] == 0
    if isinstance(inner, Num):
        return 0, "a value of a function", False
    return 0, "a function elsewhere", False


def _extent(node: Open, facts: Facts) -> tuple[int, str, bool]:
    """Choose how far an argument without brackets reaches; the last alternative is the shortest."""
    shortest = len(node.alternatives) - 1
    fun = _function_in(node.alternatives[shortest])
    argument = fun.argument
    letters = [each for each in argument.walk() if isinstance(each, Letter)]
    longest = _function_in(node.alternatives[0])
    all_letters = [each for each in longest.argument.walk() if isinstance(each, Letter)]
    if letters and (letters[0].base in ANGLES or facts.whole_arguments[letters[0].identity] > 0):
        return shortest, "an angle", letters[0].base in ANGLES and not any(each.base == "t" for each in all_letters)
    if any(each.base == "t" for each in all_letters):
        for index, alternative in enumerate(node.alternatives):
            last = [each for each in _function_in(alternative).argument.walk() if isinstance(each, Letter)][-1]
            if last.base == "t":
                return index, "a rate times the time", False
    return 0, "the whole product", False


def _function_in(node: Node) -> Fun:
    if isinstance(node, Fun):
        return node
    assert isinstance(node, Mul)
    first = node.factors[0][1]
    assert isinstance(first, Fun)
    return first


def _superscript(node: Open, facts: Facts) -> tuple[int, str, bool]:
    first, second = node.alternatives
    if isinstance(first, Fun):
        return 0, "degrees: a number is not raised to zero", False
    if isinstance(first, Pow) and isinstance(first.exponent, Letter) and isinstance(second, Letter):
        index = first.exponent.base
        if index in facts.indices and second.base != "e":
            return 1, "an index of a sum", False
        if index in GREEK_INDICES and facts.subscripts[index] and second.base != "e":
            return 1, "an index, which is a subscript elsewhere", True
    return 0, "a power", False


def _letter_d(node: Open, facts: Facts) -> tuple[int, str, bool]:
    d = ("d", "", frozenset[str](), 0, "")
    if facts.alone[d] > 0:
        return 1, "the document has a letter d", False
    inner = node.alternatives[0]
    of = inner.of if isinstance(inner, Diff) else None
    if isinstance(of, Letter) and facts.integrated[of.identity] > 0:
        return 0, "a variable of integration", True
    return 0, "no letter d elsewhere", False


def _word(node: Open, facts: Facts) -> tuple[int, str, bool]:
    product = node.alternatives[1]
    assert isinstance(product, Mul)
    if all(isinstance(each, Letter) and facts.seen[each.identity] > 1 for _, each in product.factors):
        return 1, "each of its letters also occurs elsewhere", False
    return 0, "a name", True


def _slash(node: Open, facts: Facts) -> tuple[int, str, bool]:
    far = node.alternatives[1]
    top = getattr(far, "top", None)
    near = node.alternatives[0]
    bottom = near.factors[0][1].bottom if isinstance(near, Mul) and hasattr(near.factors[0][1], "bottom") else None
    if _is_numerical(top) and isinstance(bottom, Num):
        return 0, "a fraction of numbers", False
    return 1, "a denominator of several factors", False


def _is_numerical(node: Node | None) -> bool:
    """Whether a node is a number, or the root of a number."""
    if isinstance(node, Fun) and node.name == "sqrt":
        return _is_numerical(node.argument)
    if isinstance(node, Group | Root):
        return _is_numerical(node.inner)
    return isinstance(node, Num)


RULES = {
    "apply": _apply,
    "extent": _extent,
    "superscript": _superscript,
    "letter d": _letter_d,
    "word": _word,
    "slash": _slash,
}
