"""What a result says under its keys."""

from __future__ import annotations

import pytest
from sympy import oo, pi, symbols

from derive.course.expression import Declared
from derive.course.given import symbol_of_kind
from derive.course.stock import InLetters
from derive.course.yaml_tree import Mapping, Source, Tree, Word, yaml_tree
from derive.errors import Rejected
from derive.stock.keys.result_words import function_or_name, names, value_or_infinity, value_put_in, whole_order

LETTERS = InLetters({"l": Declared("l", symbol_of_kind("l", "length"), "length")})
l = symbols("l", positive=True)


def node(text: str) -> Tree:
    written = yaml_tree(Source("k.yaml", f"key: {text}\n"))
    assert isinstance(written, Mapping)
    found = written.get("key")
    assert found is not None
    return found


def test_one_name_or_several_may_stand_there() -> None:
    assert (names(node("motion_x")), names(node("[a, b]")), names(None)) == (("motion_x",), ("a", "b"), ())


def test_a_name_is_no_mapping() -> None:
    with pytest.raises(Rejected, match="an answer is told by its name"):
        names(node("[{a: b}]"))


def test_a_value_may_be_infinite() -> None:
    assert [value_or_infinity(node(text), LETTERS) for text in ("infinity", "-infinity", "pi*l")] == [oo, -oo, pi * l]


def test_a_value_is_that_of_a_letter_with_its_place() -> None:
    letter, value = value_put_in(Word.at("l", node("l").place), node("2*l"), LETTERS)
    assert (letter, letter.place.column, value) == ("l", 6, 2 * l)
    with pytest.raises(Rejected, match="`k` is not declared"):
        value_put_in(Word.at("k", node("k").place), node("0"), LETTERS)


def test_an_order_is_a_whole_number() -> None:
    assert (whole_order(None), whole_order(Word.at("4", node("4").place))) == (None, 4)
    with pytest.raises(Rejected, match="must be a whole number"):
        whole_order(Word.at("2.5", node("2.5").place))


def test_a_function_is_an_answer_or_a_formula_of_letters() -> None:
    assert function_or_name(node("hamiltonian"), LETTERS) == "hamiltonian"
    assert function_or_name(node("l"), LETTERS) == l
    assert function_or_name(node("2*l"), LETTERS) == 2 * l
