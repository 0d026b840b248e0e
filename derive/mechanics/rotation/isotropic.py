"""The condition under which all principal moments of a body are equal, so every axis is a principal axis."""

from __future__ import annotations

from typing import Any

from sympy import Abs, Add, Dummy, Expr, ImmutableDenseMatrix, Mul, Rational, Symbol, expand, factor, nan

from derive.algebra.expressions import Relation, explicit
from derive.algebra.tidy import common_factor, tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.rotation import claims
from derive.mechanics.rotation.principal import PrincipalOf, lone_moment
from derive.solving.relations import isolated
from derive.steps.establish import Lines, establish
from derive.steps.rule import CHECK, Rule
from derive.steps.signs import of_the_size
from derive.steps.step import Form, Level, Quantity, is_zero

__all__ = ["isotropic_where"]


ISOTROPIC_WHERE = Rule(
    "rotation.isotropic_where",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 5.4",
    outcomes={word: claims.moments_compared(word) for word in ("special", "always", "never")},
    evidence={"put_back": CHECK, "beside": CHECK, "sign": CHECK},
)


def isotropic_where(moments: Quantity, letter: Expr, key: str = "special_case") -> Quantity:
    """Condition under which all three principal moments are equal, I_1 = I_3, solved for a symbol, for example h = 2R.

    moments   principal moments (3), kg m^2, at least two of them equal
    letter    the symbol of a positive quantity, or an expression such as 2b that contains this symbol

    Check: with the result substituted, the tensor is a multiple of the unit tensor. Also, the difference of the two
    distinct moments has opposite signs for greater and smaller values of the symbol. If no condition on a symbol is
    derived, the sign of this difference is checked instead.
    Outcomes: special (for one value of the symbol), always (the moments are equal for all values of the symbols), never
    (one moment is greater for all values of the symbols).
    Errors: all three moments are distinct; no single positive root for the symbol is found.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 5.4.
    """
    one, other = _two_to_compare(moments)
    difference = tidied(moments.value[one] - moments.value[other])
    if is_zero(difference) or difference.is_positive or difference.is_negative:
        return _of_known_sign(moments, one, other, difference, key)
    unknown, bound, power = _solved(letter, difference, moments)
    common = common_factor([moments.value[one], moments.value[other]])
    plain = common.as_independent(unknown, *_lengths_in(difference), as_Add=False)[0]
    sides = [expand(moments.value[k] / _letters_only(plain)) for k in (one, other)]
    squared = [Form(Relation(unknown**2, "=", tidied(bound**2)), "solved", Level.FULL)] if power == 2 else []
    return establish(
        ISOTROPIC_WHERE,
        None,
        lambda found: Relation(found[one], "=", found[other]),
        {"moments": moments},
        lines=Lines(
            between=[Form(Relation(sides[0], "=", sides[1]), "divided", Level.FULL), *squared],
            after=[Form(Relation(unknown, "=", bound), "positive")],
            result=False,
            arranged=lambda _: Relation(unknown, "=", bound),
        ),
        routes={
            "put_back": lambda found: _tensor_there(moments, found, one),
            "beside": lambda found: _differences_beside(difference, found),
        },
        outcome="special",
        key=key,
    )


def _of_known_sign(moments: Quantity, one: int, other: int, difference: Expr, key: str) -> Quantity:
    """Derive the relation of two moments that are always equal, or of which one is always greater."""
    mark = "=" if is_zero(difference) else ">" if difference.is_positive else "<"
    return establish(
        ISOTROPIC_WHERE,
        None,
        lambda found: Relation(found[one], mark, found[other]),
        {"moments": moments},
        lines=Lines(result=False, arranged=explicit),
        routes={
            "sign": lambda found: (
                ImmutableDenseMatrix([found.residual] * 2),
                ImmutableDenseMatrix(
                    [moments.value[one] - moments.value[other], of_the_size(difference, found.operator)]
                ),
            )
        },
        outcome="always" if mark == "=" else "never",
        key=key,
    )


def _two_to_compare(moments: Quantity) -> tuple[int, int]:
    alone = lone_moment(moments.value)
    if alone is not None:
        return (0 if alone else 1), alone
    if all(is_zero(moments.value[k] - moments.value[0]) for k in (1, 2)):
        return 0, 2
    message = f"the three moments of `{moments.key}` all differ, so one equation cannot make them equal"
    raise Rejected(Complaint("all-different", message))


def _solved(letter: Expr, difference: Expr, moments: Quantity) -> tuple[Symbol, Expr, int]:
    """Return the first symbol in `letter` for which `_root` finds a root of the equation difference = 0, this root, and
    2 or 1 as in `_root`."""
    for symbol in sorted(letter.free_symbols & difference.free_symbols, key=str):
        root = _root(difference, symbol)
        if root is not None:
            return symbol, *root
    message = f"no single positive root for {letter} was found in the equation of the moments of `{moments.key}`"
    raise Rejected(Complaint("no-condition", message, help="solve for another symbol in the moments"))


def _root(difference: Expr, letter: Symbol) -> tuple[Expr, int] | None:
    """Return the only positive root, and 2 if the equation contains only even powers of the symbol, otherwise 1.

    Return None if no such root is found.
    """
    core = difference.as_numer_denom()[0]
    parts = [part for part in Mul.make_args(factor(core)) if part.has(letter) and not part.is_positive]
    found = isolated(parts[0].as_base_exp()[0], letter) if len(parts) == 1 else None
    if found is None or found.power > 2 or found.value == 0:
        return None
    root = tidied(found.value ** Rational(1, found.power))
    is_of_square = is_zero(core - core.subs(letter, -letter))
    return (root, 2 if is_of_square else 1) if root.is_positive else None


def _lengths_in(difference: Expr) -> list[Any]:
    """Return the symbols that determine whether the moments are equal."""
    terms = Add.make_args(expand(difference))
    common = common_factor(list(terms))
    return [letter for letter in difference.free_symbols if (expand(difference) / common).expand().has(letter)]


def _letters_only(factor: Expr) -> Expr:
    return factor.as_coeff_Mul()[1]


def _tensor_there(moments: Quantity, found: Relation, one: int) -> tuple[Any, Any]:
    """Return the tensor and a moment times the unit tensor, with the root substituted; nan for an inequality."""
    if found.operator != "=":
        return nan, nan
    letter, bound = found.sides
    there = ImmutableDenseMatrix(moments.needed(PrincipalOf).tensor.value.subs(letter, bound))
    return there, moments.value[one].subs(letter, bound) * ImmutableDenseMatrix.eye(3)


def _differences_beside(difference: Expr, found: Relation) -> tuple[Any, Any]:
    """Return two columns. The first column contains the difference of the moments above the root, the difference below
    the root, and the root itself. The second column contains the same magnitudes with the required signs."""
    letter, bound = found.sides
    u = Dummy("u", positive=True)
    beyond, before = (tidied(difference.subs(letter, bound * (1 + u) ** sign)) for sign in (1, -1))
    rises = 1 if beyond.is_positive else -1
    expected = [rises * Abs(beyond), -rises * Abs(before), Abs(bound)]  # the last value requires a positive root
    return ImmutableDenseMatrix([beyond, before, bound]), ImmutableDenseMatrix(expected)
