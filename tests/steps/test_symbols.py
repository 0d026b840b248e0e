"""Letters: one with an index that means nothing is refused, and one that stands for another kind of value."""

from __future__ import annotations

import pytest
from sympy import ImmutableDenseMatrix, Integer, Symbol

from derive.algebra.expressions import scalar, tensor, vector
from derive.errors import Unverified
from derive.steps.symbols import check_symbol, is_notation

VECTOR = ImmutableDenseMatrix([1, 2, 3])


@pytest.mark.parametrize("name", ["I", "omega_x", "U_eff", "x_dot", "J'", "p_phi_dot", "K_2"])
def test_a_letter_with_indices_is_notation(name: str) -> None:
    assert is_notation(name)


@pytest.mark.parametrize("name", ["0_x", "None_z", "omega_None", "I_", "_x", "", "I__x"])
def test_an_empty_index_is_not_notation(name: str) -> None:
    assert not is_notation(name)
    with pytest.raises(Unverified, match="not a letter with indices"):
        check_symbol("it", Symbol(name), Integer(1))


def test_the_letter_of_a_tensor_is_not_that_of_a_vector() -> None:
    check_symbol("it", vector("L"), VECTOR)
    with pytest.raises(Unverified, match="denotes a tensor"):
        check_symbol("it", tensor("L"), VECTOR)


def test_the_letter_of_a_vector_is_not_that_of_a_number() -> None:
    with pytest.raises(Unverified, match="denotes a vector"):
        check_symbol("it", vector("L"), Integer(1))
    with pytest.raises(Unverified, match="denotes a number"):
        check_symbol("it", scalar("L"), VECTOR)


def test_several_results_have_a_name_each() -> None:
    two = ImmutableDenseMatrix([Symbol("x"), Symbol("y")])
    check_symbol("it", two, ImmutableDenseMatrix([1, 2]))
    with pytest.raises(Unverified, match="does not name each"):
        check_symbol("it", two, VECTOR)
