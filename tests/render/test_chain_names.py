"""Tests of the names in the lines of a step, and of their values."""

from __future__ import annotations

from dataclasses import replace

import sympy
from sympy import Matrix, Symbol, symbols
from sympy import sympify as sympy_reads  # an independent reader of the texts: the engine never uses `sympify`

from derive.algebra import expressions as ex
from derive.render.printing.chain_names import Page, factor_between
from derive.steps.step import Form
from tests.mechanics.block import a, known_block, omega


def test_a_letter_beside_a_vector_of_the_same_name_is_not_taken_for_it() -> None:
    steps = [quantity.step for quantity in known_block().values()]
    page = Page(steps)
    torque = page.names_of(next(step for step in steps if step.key == "torque"))
    assert torque.text(omega) == "omega"
    assert torque.text(ex.vector("omega")) == "omega_"
    moments = {f"I_{axis * 2}" for axis in "xyz"}
    assert set(torque.names) == {"omega_", "L", "omega_x", "omega_y", "omega_z", *moments}


def test_two_names_that_are_alike_in_one_chain_are_told_apart() -> None:
    letter, tensor = ex.scalar("I"), ex.tensor("I")
    line = ex.scaled(letter, ex.applied(tensor, ex.vector("n")))
    names = ((letter, a), (tensor, ex.explicit(sympy.eye(3))), (ex.vector("n"), ex.column(1, 0, 0)))
    step = replace(known_block()["torque"].step, symbol=None, chain=(Form(line, "law"),), names=names)
    named = Page([step]).names_of(step)
    assert set(named.names) == {"I_", "I__", "n"}
    back = sympy_reads(str(named.text(line)), {name: sympy_reads(str(text)) for name, text in named.names.items()})
    assert back == Matrix([Symbol("a"), 0, 0])


def test_two_roots_are_a_list() -> None:
    root = ex.scalar("u") + ex.PLUS_MINUS * sympy.sqrt(a)
    step = replace(known_block()["density"].step, chain=(Form(root, "law"),), names=())
    both = [sympy_reads(text) for text in Page([step]).names_of(step).text(root)]
    assert both == [Symbol("u") + sympy.sqrt(Symbol("a")), Symbol("u") - sympy.sqrt(Symbol("a"))]


def test_a_left_side_is_written_out_only_if_its_names_say_so() -> None:
    found = known_block()
    page = Page([quantity.step for quantity in found.values()])
    size, cosine = (page.names_of(found[key].step) for key in ("magnitude", "cosine"))
    assert (size.has_formula, size.symbol) == (True, "sqrt((tau.T*tau)[0, 0])")
    assert (cosine.has_formula, cosine.symbol) == (False, "cosine")


def test_the_factor_between_two_relations_is_simple() -> None:
    x, y = symbols("x y", positive=True)
    assert factor_between(3 * x - 3 * y, x - y) == 3
    assert factor_between(x - y, y - x) == -1
    assert factor_between(x**2 - y**2, x - y) == x + y
