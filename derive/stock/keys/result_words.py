"""What a result says under its keys, read in letters: names of answers, values, ends, an order."""

from __future__ import annotations

from sympy import Expr

from derive.course.declared import INFINITE
from derive.course.expression import names_in
from derive.course.stock import InLetters
from derive.course.yaml_tree import Scalar, Sequence, Tree, Word
from derive.errors import did_you_mean, rejected


def nodes(node: Tree | None) -> tuple[Tree, ...]:
    return () if node is None else node.items if isinstance(node, Sequence) else (node,)


def names(node: Tree | None) -> tuple[Word, ...]:
    """The names that stand there, one or several."""
    found = []
    for item in nodes(node):
        if not isinstance(item, Scalar) or item.empty:
            rejected("wrong-type", "an answer is told by its name", item.place)
        found.append(item.word)
    return tuple(found)


def value_put_in(letter: Word, node: Tree, letters: InLetters) -> tuple[Word, Expr]:
    """A letter, a coordinate or a rate, and its value."""
    if letter not in letters.letters:
        help_line = did_you_mean(letter, letters.letters) or "it is a letter, a coordinate or a rate"
        rejected("undeclared-symbol", f"`{letter}` is not declared", letter.place, help_line)
    return letter, value_or_infinity(node, letters)


def value_or_infinity(node: Tree, letters: InLetters) -> Expr:
    """An expression, or infinity."""
    if isinstance(node, Scalar) and node.text.strip() in INFINITE:
        return INFINITE[node.text.strip()]
    return letters.read(node, "a value")[0]


def whole_order(word: Word | None) -> int | None:
    if word is None:
        return None
    if not word.isdigit() or len(word) > 2:
        rejected("wrong-type", f"`order` must be a whole number, but it is `{word}`", word.place)
    return int(word)


def function_or_name(node: Tree, letters: InLetters) -> Word | Expr:
    """The name of an answer, or a formula in letters, coordinates and momenta."""
    if isinstance(node, Scalar) and not node.empty and [*names_in(node)] == [node.text.strip()]:
        if node.text.strip() not in letters.letters:
            return node.word
    return letters.read(node, "a function")[0]
