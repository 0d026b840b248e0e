"""The expression reader: what it reads, what it refuses, and that it is bounded."""

from __future__ import annotations

from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sympy import Expr, Integer, Rational, Symbol, atan, cos, cosh, exp, log, pi, sin, sqrt, sstr, tan

from derive.algebra.dimensions import NUMBER
from derive.algebra.kinds import dimension_of_kind
from derive.course.expression import Declared, read_expression
from derive.course.given import symbol_of_kind
from derive.course.yaml_tree import Scalar, Source
from derive.errors import Complaint, Rejected

KINDS = {
    "a": "length",
    "b": "length",
    "M": "mass",
    "omega": "angular speed",
    "theta": "angle",
    "n": "number",
    "tau": "torque",
    "E_0": "energy",
}
SYMBOLS = {name: Declared(name, symbol_of_kind(name, kind), kind) for name, kind in KINDS.items()}
a, b, M, omega, theta, n = (SYMBOLS[name].symbol for name in ("a", "b", "M", "omega", "theta", "n"))
LENGTH = dimension_of_kind("length")


def scalar(text: str) -> Scalar:
    return Scalar(text, "", 0, len(text), Source("p.yaml", text))


def value(text: str) -> Expr:
    return read_expression(scalar(text), SYMBOLS)[0]


def complaint(text: str) -> Complaint:
    with pytest.raises(Rejected) as caught:
        read_expression(scalar(text), SYMBOLS)
    (only,) = caught.value.complaints
    return only


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("2*a", 2 * a),
        ("1.5", Rational(3, 2)),
        ("1e-3", Rational(1, 1000)),
        (".5e1", Integer(5)),
        ("0.1 + 0.2", Rational(3, 10)),
        ("-a**2", -(a**2)),
        ("(-a)**2", a**2),
        ("2**-1", Rational(1, 2)),
        ("2**3**2/2**9", Integer(1)),
        ("sin(30 deg)", Rational(1, 2)),
        ("90° - theta", pi / 2 - theta),
        ("2*arctan(n)", 2 * atan(n)),
        ("acos(1/2)", pi / 3),
        ("ln(n)*cosh(theta)", log(n) * cosh(theta)),
        ("a - b - a", -b),
        ("a/b*b/a", Integer(1)),
        ("a/2/b", a / (2 * b)),
        ("--+a", a),
        ("2 * ( a + b )", 2 * a + 2 * b),
        ("sqrt(a**2 + b**2)", sqrt(a**2 + b**2)),
        ("a**(1/3)", a ** Rational(1, 3)),
        ("sin(theta)*cos(pi/4)*tan(n)*exp(-n)", sin(theta) * sqrt(2) / 2 * tan(n) * exp(-n)),
        ("0**0", Integer(1)),
    ],
)
def test_an_expression_is_read_exactly_and_with_the_usual_precedence(text: str, expected: Expr) -> None:
    assert value(text) == expected


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("a + b", "length"),
        ("a*b", "area"),
        ("M*a**2", "moment of inertia"),
        ("sqrt(a*b)", "length"),
        ("a/b", "number"),
        ("a*omega**2", "acceleration"),
        ("M*a**2*omega", "angular momentum"),
        ("tau + E_0", "energy"),
        ("sin(a/b)", "number"),
        ("a**-3*M", "density"),
    ],
)
def test_the_dimension_follows_the_walk(text: str, kind: str) -> None:
    assert read_expression(scalar(text), SYMBOLS)[1] == dimension_of_kind(kind)


def test_unlike_kinds_are_not_added_and_the_caret_is_under_the_second() -> None:
    found = complaint("a + 2*M")
    assert found.code == "dimension"
    assert found.message == "`a` is a length, but `2*M` is a mass: they cannot be added"
    assert found.place is not None
    assert (found.place.column, found.place.width) == (5, 3)


@pytest.mark.parametrize(
    ("text", "code", "column", "said"),
    [
        ("a - 2", "dimension", 5, "`2` is a number: they cannot be subtracted"),
        ("sin(a)", "dimension", 5, "`sin` takes an angle or a number, but `a` is a length"),
        ("2**a", "dimension", 4, "the exponent `a`"),
        ("a^2", "expression", 2, "write `**` for a power"),
        ("2a", "expression", 2, "write `2*a`"),
        ("a b", "expression", 3, "write `a*b`"),
        ("2(a)", "expression", 2, "write `2*(...)`"),
        ("2 sin(n)", "expression", 3, "write `2*sin(...)`"),
        ("(a)(b)", "expression", 4, "write `*` for a product"),
        ("a(b)", "expression", 1, "write `a*(...)`"),
        ("sin n", "expression", 1, "write `sin(...)`"),
        ("sin(n, n)", "expression", 6, "`sin` takes one value"),
        ("a.__class__", "expression", 2, "a dot is allowed only"),
        ("__import__('os')", "expression", 1, "unknown function `__import__`"),
        ("sine(n)", "expression", 1, "did you mean `sin`?"),
        ("'a'", "expression", 1, "quotes are not allowed"),
        ("a == b", "expression", 3, "a comparison is not allowed"),
        ("a[0]", "expression", 2, "write `(`"),
        ("(a", "expression", 1, "never closed"),
        ("a)", "expression", 2, "`)` is not expected"),
        ("a +", "expression", 4, "something is missing at the end"),
        ("a//b", "expression", 3, "something is missing before `/`"),
        ("ω*a", "expression", 1, "write `omega`"),
        ("Ω", "expression", 1, "write `Omega`"),
        ("2·a", "expression", 2, "write `*`"),
        ("a²", "expression", 2, "write `**2`"),
        ("\\omega", "expression", 1, "write `omega`, not `\\omega`"),
        ("٣", "expression", 1, "not part of an expression"),
        ("", "expression", 1, "an expression is missing"),
        ("2*omgea", "undeclared-symbol", 3, "did you mean `omega`?"),
        ("2*q", "undeclared-symbol", 3, "declare it under `symbols:`"),
        ("a/0", "division-by-zero", 3, "division by zero"),
        ("a/(b - b)", "division-by-zero", 3, "`(b - b)` is 0"),
        ("1/((a+b)**2 - a**2 - 2*a*b - b**2)", "division-by-zero", 3, "is 0"),
        ("0**-1", "division-by-zero", 1, "`0` is 0"),
        ("tan(pi/2)", "division-by-zero", 1, "is infinite"),
        ("sqrt(-a)", "not-real", 1, "`sqrt(-a)` is not a real number"),
        ("(-2)**(1/2)", "not-real", 1, "is not a real number"),
        ("9**9**9**9", "too-large", 7, "an exponent must be from -12 to 12"),
        ("((9**12)**12)**12", "too-large", 1, "too large to evaluate"),
        ("((a+b)**12)**12", "too-large", 1, "too large to evaluate"),
        ("(a+b)**7*(a+b)**7*(a+b)**7", "too-large", 1, "too large to evaluate"),
        ("a**(1/13)", "too-large", 4, "an exponent must be from -12 to 12"),
        ("3 cm + a", "expression", 1, "a number with a unit, `3 cm`, is not allowed within an expression"),
        ("arcsin(2)", "not-real", 1, "is not a real number"),
        ("ln(0)", "division-by-zero", 1, "is infinite"),
        ("arctan(a)", "dimension", 8, "`arctan` takes a number, but `a` is a length"),
        ("exp(1000)", "too-large", 5, "the argument of `exp` must be from -100 to 100"),
        ("exp(exp(99))", "too-large", 5, "the argument of `exp` must be from -100 to 100"),
        ("1e51", "too-large", 1, "a power of ten from -50 to 50"),
        ("1e" + "9" * 200, "too-large", 1, "a power of ten from -50 to 50"),
        ("1" * 31, "too-large", 1, "30 digits"),
        ("-" * 50 + "a", "too-large", 42, "more than 40 levels deep"),
        ("(" * 50 + "a" + ")" * 50, "too-large", 42, "more than 40 levels deep"),
        ("a+" * 5000 + "a", "too-large", 1, "10001 characters"),
    ],
)
def test_what_is_no_expression_is_refused_at_its_column(text: str, code: str, column: int, said: str) -> None:
    found = complaint(text)
    assert (found.code, found.place and found.place.column) == (code, column)
    assert said in f"{found.message} {found.help}"


@pytest.mark.parametrize(
    ("text", "message"),
    [("2*q", "a number is expected here, but `q` is not a number"), ("2 + 3 cm", "a number with a unit, `3 cm`")],
)
def test_where_no_letter_is_allowed_none_is_to_be_declared(text: str, message: str) -> None:
    with pytest.raises(Rejected) as caught:
        read_expression(scalar(text), None)
    (found,) = caught.value.complaints
    assert found.message.startswith(message) and found.help is None
    assert read_expression(scalar("2*pi/3"), None)[0] == 2 * pi / 3


def test_all_undeclared_names_of_an_expression_are_told_together() -> None:
    with pytest.raises(Rejected) as caught:
        value("p + q*a + r")
    assert [c.message for c in caught.value.complaints] == [f"`{name}` is not declared" for name in "pqr"]


def test_every_name_is_a_symbol_and_none_a_value_of_python_or_sympy() -> None:
    names = {name: Declared(name, Symbol(name, real=True), "number") for name in ("I", "E", "S", "N", "gamma", "beta")}
    expr, _ = read_expression(scalar("I*E + S*N + gamma*beta"), names)
    assert expr.free_symbols == {declared.symbol for declared in names.values()}


@given(st.text(max_size=40))
def test_any_text_is_read_or_rejected(text: str) -> None:
    with suppress(Rejected):
        value(text)


PIECES = [
    "a",
    "b",
    "n",
    "M",
    "theta",
    "pi",
    "sqrt(",
    "sin(",
    "exp(",
    "(",
    ")",
    "+",
    "-",
    "*",
    "/",
    "**",
    "2",
    "0",
    "1.5",
    " ",
]


@given(st.lists(st.sampled_from(PIECES), max_size=25))
def test_any_shuffle_of_the_grammar_is_read_or_rejected(pieces: list[str]) -> None:
    with suppress(Rejected):
        assert value("".join(pieces)).is_real is not False


numbers = st.fractions(min_value=-20, max_value=20, max_denominator=12).map(
    lambda f: Rational(f.numerator, f.denominator)
)
numeric = st.recursive(
    numbers | st.sampled_from([n, theta, pi, a / b]),
    lambda inner: (
        st.tuples(inner, inner).map(lambda pair: pair[0] + pair[1])
        | st.tuples(inner, inner).map(lambda pair: pair[0] * pair[1])
        | st.tuples(inner, st.integers(0, 3)).map(lambda pair: pair[0] ** pair[1])
        | inner.map(lambda x: sqrt(1 + x**2))
        | inner.map(sin)
        | inner.map(cos)
    ),
    max_leaves=5,
)


@given(numeric)
def test_a_printed_expression_reads_back_as_itself(expr: Expr) -> None:
    text = sstr(expr)
    try:
        back, dimension = read_expression(scalar(text), SYMBOLS)
    except Rejected as rejected:
        # Only what is beyond the bounds may fail.
        assert {c.code for c in rejected.complaints} == {"too-large"}  # noqa: PT017
        return
    assert dimension == NUMBER
    assert back == expr or (back - expr).equals(0)
