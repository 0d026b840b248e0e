"""Letters of a document and the declared names they stand for."""

from __future__ import annotations

import pytest
from sympy import Symbol

from derive.algebra.kinds import dimension_of_kind
from derive.course.arithmetic import Declared
from derive.course.latex.letters import Letter, Letters, letter_at, subscript_of, term_of
from tests.course.latex.test_tokens import tokens


def declared(*names: str) -> Letters:
    return Letters({name: Declared(name, Symbol(name, real=True), "length") for name in names})


def named(letters: Letters, base: str, subscript: str = "") -> str | None:
    found = letters.named(Letter(base, 0, 1, subscript))
    return found.name if found else None


def test_a_subscript_is_known_without_the_marks_in_it() -> None:
    letters = declared("r_C_x", "a")
    assert named(letters, "r", "C,x") == named(letters, "r", "Cx") == named(letters, "r", "C_x") == "r_C_x"
    assert named(letters, "r") is named(letters, "r", "C") is None
    assert ("a" in letters, "r" in letters) == (True, False)


def test_a_letter_that_could_be_two_names_is_neither() -> None:
    assert named(declared("r_ab", "r_a_b"), "r", "ab") is None


@pytest.mark.parametrize(
    ("text", "letter"),
    [
        ("a", Letter("a", 0, 1)),
        (r"\omega", Letter("omega", 0, 6)),
        (r"\imath", Letter("i", 0, 6)),
        (r"\ddot{\omega}", Letter("omega", 0, 13, dots=2)),
        (r"\dot{\omega_x}", Letter("omega", 0, 14, "x", 1)),
        (r"\vec{a}", Letter("a", 0, 7, vector=True)),
        (r"\hat{\mathbf{a}}", Letter("a", 0, 16, hat=True, vector=True)),
        (r"\mathrm{mass}", Letter("mass", 0, 13)),
        ("2", None),
        (r"\sin", None),
        (r"\vec{}", None),
        (r"\dot{a+b}", None),
    ],
)
def test_a_letter_is_read_with_what_decorates_it(text: str, letter: Letter | None) -> None:
    assert letter_at(tokens(text)[0]) == letter


def test_the_end_of_a_formula_is_no_letter() -> None:
    assert letter_at(None) is None


@pytest.mark.parametrize(
    ("text", "axis"),
    [(r"\hat{x}", 0), (r"\vec{k}", 2), (r"\hat{k}", 2), (r"\vec{x}", None), ("i", None), (r"\dot{\hat{z}}", None)],
)
def test_a_unit_vector_is_told_by_its_decoration(text: str, axis: int | None) -> None:
    letter = letter_at(tokens(text)[0])
    assert letter
    assert letter.axis == axis


@pytest.mark.parametrize(
    ("text", "subscript"),
    [
        ("C,x", "C,x"),
        ("12", "12"),
        (r"\text{upper rod}", "upper_rod"),
        (r"\omega x", "omegax"),
        ("a+b", None),
        ("", None),
    ],
)
def test_only_letters_digits_words_and_commas_are_part_of_a_name(text: str, subscript: str | None) -> None:
    assert subscript_of(tokens(text) if text else ()) == subscript


def test_a_dot_makes_a_rate_with_the_dimension_of_one() -> None:
    x = Declared("x", Symbol("x", real=True), "length")
    still, moving = term_of(Letter("x", 0, 1), x), term_of(Letter("x", 0, 1, dots=2), x)
    assert (still.expr, still.kind) == (x.symbol, "length")
    assert (moving.expr.name, moving.kind) == ("x_ddot", None)
    assert moving.dimension == dimension_of_kind("acceleration")
