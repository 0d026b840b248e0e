"""Letters of a formula and the declared names they stand for, and vectors that are named by a letter."""

from __future__ import annotations

import pytest
from sympy import Matrix, Symbol, sin

from derive.algebra.expressions import explicit
from derive.algebra.kinds import dimension_of_kind
from derive.course.arithmetic import Declared
from derive.course.latex import read_latex
from derive.course.latex.values import Letters
from derive.course.yaml_tree import Scalar, Source
from derive.errors import Rejected
from tests.course.latex.formula import complaint, dimension, letter, marked, read, value

a, b, theta = letter("a"), letter("b"), letter("theta")
omega = Matrix([letter(f"omega_{axis}") for axis in "xyz"])


def declared(*names: str) -> Letters:
    return Letters({name: Declared(name, Symbol(name, real=True), "length") for name in names})


def named(letters: Letters, base: str, subscript: str = "") -> str | None:
    found = letters.named(base, subscript)
    return found.name if found else None


def test_a_subscript_is_known_without_the_marks_in_it() -> None:
    letters = declared("r_C_x", "a")
    assert named(letters, "r", "C,x") == named(letters, "r", "Cx") == named(letters, "r", "C_x") == "r_C_x"
    assert named(letters, "r") is named(letters, "r", "C") is None
    assert ("a" in letters, "r" in letters) == (True, False)


def test_a_letter_that_could_be_two_names_is_neither() -> None:
    assert named(declared("r_ab", "r_a_b"), "r", "ab") is None


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        (r"\omega_{\text{x}}", omega[0]),
        (r"\mathrm{a}", a),
        (r"\mathit{a}", a),
        (r"\operatorname{ab}", a * b),  # a product that is set as the name of a function
        (r"\vec{a}", a),
        (r"\vec{\omega}", omega),
        (r"\boldsymbol{\omega}^2", omega.dot(omega)),
        (r"\vec\omega\cdot\{a,b,0\}", omega.dot(Matrix([a, b, 0]))),
        (r"\dot{\vec{\omega}}", Matrix([Symbol(f"omega_{axis}_dot", real=True) for axis in "xyz"])),
        (r"\hat{x}", Matrix([1, 0, 0])),
        (r"\vec{k}", Matrix([0, 0, 1])),
        (r"a\sin\theta(b+b)", 2 * a * b * sin(theta)),
        (r"\sin\frac{1}{2}\theta", sin(theta / 2)),
    ],
)
def test_a_letter_is_read_with_what_decorates_it(text: str, meant: object) -> None:
    assert value(text) == meant


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (r"\hat{\theta}", r"`\hat{\theta}` is a unit vector that cannot be read"),
        (r"\omega_{a+b}", r"the subscript of `\omega` is not a name"),
        (r"a^{\text{in}}", "the superscript of `a` is not a power"),
        (r"\vec{a}\times\vec{b}", "the product of two vectors can be read only from their components"),
        (r"\vec{\omega}\times\vec{b}", "the product of two vectors can be read only from their components"),
        (r"\sin\theta(n)", r"the argument of `\sin` is not clear"),
    ],
)
def test_a_letter_that_is_not_clear_is_refused(text: str, message: str) -> None:
    assert message in complaint(text).message


def test_a_dot_makes_a_rate_with_the_dimension_of_one() -> None:
    assert value(r"\ddot{x}").name == "x_ddot"
    assert dimension(r"\ddot{x}") == dimension_of_kind("acceleration")
    assert marked(r"\dot{\ddot{\dot{x}}}")[0] == "latex"


def test_a_vector_of_the_document_is_known_by_its_components_in_prose_only_by_its_name() -> None:
    letters = {"L": Declared("L", Symbol("L", real=True), "length")}
    letters |= {f"L_{axis}": Declared(f"L_{axis}", Symbol(f"L_{axis}", real=True), "length") for axis in "xyz"}
    text = r"\vec{L}"
    scalar = Scalar(text, "", 0, len(text), Source("f.yaml", text))
    assert read_latex(scalar, letters).sides[0].shape == (3, 1)
    assert read_latex(scalar, letters, in_prose=True).sides[0].shape == ()


@pytest.mark.parametrize(("text", "meant"), [(r"2\,\mathrm{s}", 2), (r"2\,\text{ km}", 2000), (r"3\,\text{m/s}^2", 3)])
def test_prose_has_units(text: str, meant: int) -> None:
    scalar = Scalar(text, "", 0, len(text), Source("f.yaml", text))
    ((expr, _),) = read_latex(scalar, {}, in_prose=True).sides[0].branches[0]
    assert explicit(expr) == meant
    with pytest.raises(Rejected):
        read(text)
