"""When two equations, or two inequalities, say the same."""

from __future__ import annotations

from itertools import product

import pytest
from sympy import Expr, ImmutableMatrix, Integer, Rational, Symbol, cos, nan, sin, sqrt

from derive.algebra.equality import Grade, equal
from derive.algebra.expressions import Dot, Relation, column
from derive.algebra.kinds import Inhomogeneous, dimension_of_kind

a, b, k = (Symbol(name, positive=True) for name in "abk")
x, y, theta = (Symbol(name, real=True) for name in ("x", "y", "theta"))


def says(left: object, mark: str, right: object) -> Relation:
    return Relation(left, mark, right)


SAME = [
    (says(x, "=", y), says(y, "=", x)),
    (says(k * x - k * y, "=", 0), says(x, "=", y)),
    (says(x, ">", y), says(y, "<", x)),
    (says(-k * x, ">", -k * y), says(x, "<", y)),
    (says(a / (b + k), ">=", 0), says(a, ">=", 0)),
    (says(x * (sin(theta) ** 2 + cos(theta) ** 2), "=", y), says(x, "=", y)),
    (says(sin(2 * theta), "=", x), says(2 * sin(theta) * cos(theta) - x, "=", 0)),
    (says(a**2, ">", b**2), says(a, ">", b)),
    (says(k * a**2 - 3 * k * b, ">=", 0), says(a, ">=", sqrt(3) * sqrt(b))),
    (says(a, ">=", sqrt(b / k)), says(0, ">=", b / k - a**2)),
]


@pytest.mark.parametrize(("left", "right"), SAME, ids=[f"{a}  {b}" for a, b in SAME])
def test_relations_that_follow_from_each_other_are_equal(left: Relation, right: Relation) -> None:
    assert equal(left, right).grade is Grade.PROVED
    assert equal(right, left).grade is Grade.PROVED


DIFFERENT = [
    (says(x, "=", y), says(x, "=", 2 * y)),
    (says(x, ">", y), says(x, "<", y)),
    (says(x, ">", y), says(x, ">=", y)),
    (says(x, ">", y), says(x, "=", y)),
    (says(x * theta, "=", y * theta), says(x, "=", y)),
    (says(x * theta, ">", y * theta), says(x, ">", y)),
    (says(x**2, ">", y**2), says(x, ">", y)),
    (says(a**2, ">", b), says(a, ">", b)),
    (says(-k * a**2 + k * b, ">=", 0), says(a, ">=", sqrt(b))),
    (says(x, "=", 0), x),
]


@pytest.mark.parametrize(("left", "right"), DIFFERENT, ids=[f"{a}  {b}" for a, b in DIFFERENT])
def test_relations_that_do_not_are_different(left: Relation, right: object) -> None:
    assert equal(left, right).grade is Grade.REFUTED
    assert equal(right, left).grade is Grade.REFUTED


def test_a_factor_may_be_divided_out_once_it_is_known_not_to_vanish() -> None:
    assert equal(says(x * theta, "=", y * theta), says(x, "=", y), [theta])


# --- every mark, side and sign ---------------------------------------------------------------------------------------

MARKS = ("=", "!=", "<", ">", "<=", ">=")
HOLDS = {
    "=": lambda d: d == 0,
    "!=": lambda d: d != 0,
    "<": lambda d: d < 0,
    ">": lambda d: d > 0,
    "<=": lambda d: d <= 0,
    ">=": lambda d: d >= 0,
}
SIZES = (Rational(1, 3), Rational(1))  # so small a choice that both sides often are the same
BOTH_SIGNS = (-Rational(1), Integer(0), Rational(1, 3))

NEIGHBOURS = [
    (x, y),
    (k * x, k * y),
    (a, b),
    (a**2, b**2),
    (x**2, y**2),
    (a * x, b),
    (x * y, y),
    (a / b, Integer(1)),
    (x, Integer(0)),
    (x**2, Integer(0)),
    (x**2 + 1, Integer(0)),
    (sqrt(a), sqrt(b)),
]


def changed(left: Expr, mark: str, right: Expr) -> list[Relation]:
    sides = [(left, right), (right, left), (-left, -right), (-left, right), (left, -right), (2 * left, right)]
    sides += [(left**2, right**2), (x * left, x * right), (a * left, a * right)]
    near = {"=": "=!", "!": "!=", "<": "<>", ">": "<>"}[mark[0]]
    return [says(u, other, v) for u, v in sides for other in MARKS if other == mark or other[0] in near]


def truth(relation: Relation) -> list[bool]:
    """Whether the relation holds at each of some points, in exact numbers."""
    residual = relation.left - relation.right
    letters = (a, b, k, x, y)
    used = [letter for letter in letters if letter in residual.free_symbols]
    every = product(*(SIZES if letter.is_positive else BOTH_SIGNS for letter in letters))
    values: dict[tuple[Expr, ...], bool] = {}
    found = []
    for point in every:
        own = tuple(value for letter, value in zip(letters, point, strict=True) if letter in used)
        if own not in values:
            values[own] = bool(HOLDS[relation.operator](residual.xreplace(dict(zip(used, own, strict=True)))))
        found.append(values[own])
    return found


@pytest.mark.parametrize(("left", "right"), NEIGHBOURS, ids=[f"{a}  {b}" for a, b in NEIGHBOURS])
@pytest.mark.parametrize("mark", MARKS)
def test_a_relation_that_is_not_so_at_the_same_points_is_never_said_to_be_the_same(
    left: Expr, right: Expr, mark: str
) -> None:
    first = says(left, mark, right)
    same = truth(first)
    for other in changed(left, mark, right):
        if equal(first, other):
            assert truth(other) == same, f"{other}"


@pytest.mark.parametrize(("left", "right"), NEIGHBOURS[:3], ids=str)
@pytest.mark.parametrize("mark", MARKS)
def test_another_mark_a_squared_side_or_a_factor_of_unknown_sign_is_refuted(left: Expr, right: Expr, mark: str) -> None:
    first = says(left, mark, right)
    for other in MARKS:
        if other != mark:
            assert equal(first, says(left, other, right)).grade is Grade.REFUTED
    assert equal(first, says(x * left, mark, x * right)).grade is Grade.REFUTED
    assert equal(first, says(left, mark, -right)).grade is Grade.REFUTED
    if not left.is_positive:
        assert equal(first, says(left**2, mark, right**2)).grade is Grade.REFUTED
    turned = {"=": "=", "!=": "!=", "<": ">", ">": "<", "<=": ">=", ">=": "<="}[mark]
    for same in (says(right, turned, left), says(-left, turned, -right), says(a * left, mark, a * right)):
        assert equal(first, same).grade is Grade.PROVED


SAYS_NOTHING = [says(x, mark, x) for mark in MARKS]


@pytest.mark.parametrize("nothing", SAYS_NOTHING, ids=str)
def test_what_has_the_same_on_both_sides_is_no_other_relation(nothing: Relation) -> None:
    hidden = says(sin(x) ** 2 + cos(x) ** 2, nothing.operator, Integer(1))
    for mark in MARKS:
        assert not equal(nothing, says(x, mark, y))
        assert not equal(hidden, says(x, mark, y))
        assert bool(equal(hidden, says(y, mark, y))) is (mark == nothing.operator)
        assert bool(equal(hidden, says(0, mark, sin(y) ** 2 + cos(y) ** 2 - 1))) is (mark == nothing.operator)


def test_a_factor_that_may_be_undefined_is_none_that_may_be_divided_out() -> None:
    assert not equal(says(y / x, "=", 0), says(y, "=", 0))
    assert equal(says(y / x, "=", 0), says(y, "=", 0), [x])
    assert not equal(says(y / (a - b) ** 2, ">", 0), says(y, ">", 0))


def test_what_is_undefined_says_nothing() -> None:
    undefined = says(x, "=", nan)
    assert not equal(undefined, undefined)


def test_equations_of_vectors_are_compared_entry_by_entry() -> None:
    u, v = ImmutableMatrix([x, y]), ImmutableMatrix([x * (sin(y) ** 2 + cos(y) ** 2), y])
    zero = ImmutableMatrix([0, 0])
    assert equal(says(u, "=", zero), says(v, "=", zero)).grade is Grade.PROVED
    assert equal(says(u, "=", zero), says(zero, "=", v)).grade is Grade.PROVED
    for other in (says(u, "!=", zero), says(2 * u, "=", zero), says(u, "=", v), says(x, "=", 0)):
        assert not equal(says(u, "=", zero), other)


# --- the node itself -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("mark", "word", "text"),
    [("=", "equals", "Eq"), ("!=", "unequal", "Ne"), ("<", "less", "Lt"), (">=", "at_least", "Ge")],
)
def test_a_relation_has_a_word_for_its_mark_and_is_one_to_sympy(mark: str, word: str, text: str) -> None:
    relation = says(x, mark, 2)
    assert (relation.word, str(relation)) == (word, f"x {mark} 2")
    assert relation.lowered(str) == f"{text}(x, 2, evaluate=False)"


def test_its_sides_are_exact_numbers_and_are_carried_out() -> None:
    relation = says(Dot(column(x, 0, 0), column(y, 0, 0)), "<", 3)
    assert relation.right == Integer(3)
    assert relation.doit() == says(x * y, "<", 3) != relation
    assert relation.doit().residual == x * y - 3
    assert relation.operator == relation.doit().operator == "<"


def test_both_sides_have_one_dimension() -> None:
    of = {a: dimension_of_kind("length"), b: dimension_of_kind("length"), k: dimension_of_kind("mass")}.get
    assert says(a, "=", b).dimension(of) == dimension_of_kind("length")
    with pytest.raises(Inhomogeneous, match="`k` is a mass, but `a` is a length"):
        says(a, "=", k).dimension(of)
