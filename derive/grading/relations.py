"""The verdict on an equation or an inequality.

An equation may be multiplied by a factor that does not vanish, and an inequality by a positive one. An equation for a
quantity, such as `omega^2 = g/l`, is right if the value of the quantity satisfies it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import sympy
from sympy import Expr, Integer, MatrixBase, Rational, Symbol, acos, asin, atan, cos, cot, csc, pi, sec, sin, tan

from derive.algebra.dimensions import NUMBER
from derive.algebra.equality import equal
from derive.algebra.expressions import PLUS_MINUS, RATES, Relation, rate
from derive.algebra.ranges import never_vanishes_within
from derive.audit.time_limit import FAULTS
from derive.grading.comparing import _Comparison, aligned, factor_is_near, shown, verdict_on_value
from derive.grading.key import Key, Number, Target
from derive.grading.outcomes import Outcome, Verdict, best_of
from derive.grading.reading import Read
from derive.grading.structure import are_equal, are_surely_equal, factor_between, slips_between

STRICT = {"<": "<=", ">": ">=", "<=": "<", ">=": ">"}
TURNED = {"<": ">", ">": "<", "<=": ">=", ">=": "<="}


def verdict_on_relation(left: Read, mark: str, right: Read, target: Target, key: Key) -> Verdict:
    """Compare a typed relation with an answer that is a relation."""
    goal = target.value
    if isinstance(left.value, MatrixBase) or isinstance(right.value, MatrixBase):
        return Verdict(Outcome.DIFFERENT, "a side of this relation is a vector or a matrix")
    comparison = _Comparison(Read(left.node, left.value, (*left.decimals, *right.decimals),
                                  tuple({*left.unknown, *right.unknown})), target, key)  # fmt: skip
    mark = {"~": "=", ":=": "=", "to": "="}.get(mark, mark)
    if mark not in ("=", "!=", "<", ">", "<=", ">="):
        return Verdict(Outcome.DIFFERENT, "this relation is not graded")
    typed = Relation(aligned(left.value, goal), mark, aligned(right.value, goal))
    if typed.residual == 0 or are_surely_equal(typed.left, typed.right):
        return Verdict(Outcome.DIFFERENT, "both sides of this relation are equal")
    if _are_equivalent(typed, goal) or _are_equivalent_with_cosines(typed, goal):
        return Verdict(Outcome.EQUAL, "")
    full = Relation(comparison.expanded(typed.left), mark, comparison.expanded(typed.right))
    expanded = Relation(comparison.expanded(goal.left), goal.operator, comparison.expanded(goal.right))
    if (full, expanded) != (typed, goal) and not _says_nothing(full) and _are_equivalent(full, expanded):
        used = typed.free_symbols & set(key.definitions) - goal.free_symbols - key.allowed
        names = ", ".join(f"`{shown(each, key)}`" for each in sorted(used, key=str))
        if names:
            return Verdict(Outcome.CONVENTION, f"with {names} as defined in the solution")
        return Verdict(Outcome.EQUAL, "with the definitions of the problem")
    if (of_angles := _with_function(typed, goal)) is not None and _are_equivalent(of_angles, goal):
        return Verdict(Outcome.EQUAL, "")
    if (renamed := _renamed(typed, goal, comparison)) is not None:
        return renamed
    if goal.operator == "=" and mark == "=":
        return _wrong_equation(comparison, full, expanded)
    found = [_wrong_inequality(full, expanded, key)]
    return best_of(found + [_wrong_inequality(of_angles, goal, key)] if of_angles is not None else found)


def _says_nothing(relation: Relation) -> bool:
    return bool(relation.residual == 0)


def _are_equivalent(one: Relation, other: Relation) -> bool:
    try:
        return bool(equal(one, other))
    except FAULTS:
        return False


def _are_equivalent_with_cosines(typed: Relation, goal: Relation) -> bool:
    """Whether two equations are equivalent after the denominators of tangents, cotangents, secants and cosecants are
    removed. The correct equation, `goal`, must have no solution where a denominator vanishes."""
    if not (typed.operator == goal.operator == "=" and typed.residual.has(tan, cot, sec, csc)):
        return False
    quotients = (
        typed.residual.replace(tan, lambda x: sin(x) / cos(x)).replace(cot, lambda x: cos(x) / sin(x))
        .replace(sec, lambda x: 1 / cos(x)).replace(csc, lambda x: 1 / sin(x))
    )  # fmt: skip
    above, below = sympy.fraction(sympy.together(quotients))
    ends = {cos: (pi / 2, -pi / 2), sin: (Integer(0), pi)}
    for base in below.as_powers_dict():
        if isinstance(base, sin | cos):
            places = [{base.args[0]: end} for end in ends[type(base)]]
            if not all(never_vanishes_within(goal.residual.xreplace(place)) for place in places):
                return False
    return _are_equivalent(Relation(above, "=", Integer(0)), goal)


def give_the_same(typed: list[Relation], goals: list[Relation]) -> bool:
    """Whether two systems of n equations, linear in n accelerations, give the same accelerations."""
    if any(goal.operator != "=" for goal in goals):
        return False
    unknowns = sorted({s for goal in goals for s in goal.free_symbols if str(s).endswith("_ddot")}, key=str)
    if len(unknowns) != len(goals):
        return False
    solutions = []
    for system in (typed, goals):
        try:
            matrix, column = sympy.linear_eq_to_matrix([each.residual for each in system], unknowns)
            if sympy.expand(matrix.det()) == 0:
                return False
            solutions.append(matrix.inv(method="ADJ") * column)
        except (*FAULTS, sympy.solvers.solveset.NonlinearError):
            return False
    return all(are_surely_equal(one, other) for one, other in zip(*solutions, strict=True))


def _renamed(typed: Relation, goal: Relation, comparison: _Comparison) -> Verdict | None:
    """Accept an inequality that has another name for one letter of the problem. Return None if no letter of the problem
    makes the inequality right.
    """
    unknown = [each for each in comparison.read.unknown if each in typed.free_symbols]
    if goal.operator == "=" or len(unknown) != 1 or len(goal.free_symbols) < 2:  # equations are compared term by term
        return None
    for letter in sorted(goal.free_symbols - typed.free_symbols, key=str)[:8]:
        named = typed.xreplace({unknown[0]: letter})
        for each in filter(None, (named, _with_function(named, goal))):
            other = None if _are_equivalent(each, goal) else _wrong_inequality(each, goal, comparison.key)
            if other is None or other.is_right:
                names = (shown(one, comparison.key) for one in (unknown[0], letter))
                renamed = Verdict(Outcome.CONVENTION, "if `{}` is the problem's `{}`".format(*names))
                return renamed.adding(other.because) if other is not None else renamed
    return None


def _with_function(typed: Relation, goal: Relation) -> Relation | None:
    """Return a condition on an angle as a condition on its tangent, sine or cosine, if the right answer has this form;
    else None."""
    left = goal.left
    if not isinstance(left, sin | cos | tan) or typed.left != left.args[0]:
        return None
    operator = TURNED.get(typed.operator, typed.operator) if isinstance(left, cos) else typed.operator
    return Relation(left, operator, left.func(typed.right))


def angle_of(target: Target, name: Any) -> Target | None:
    """If the right answer is a number for the sine, cosine or tangent of the angle `name`, return the right answer for
    the angle itself; otherwise None."""
    left = target.value.left
    if not isinstance(left, sin | cos | tan) or left.args[0] != name or target.number is None:
        return None
    inverse = {sin: asin, cos: acos, tan: atan}[left.func]
    operator = target.value.operator
    operator = TURNED.get(operator, operator) if isinstance(left, cos) else operator
    exact = inverse(target.number.exact)
    number = Number(exact, "deg", pi / 180, target.number.figures)
    return replace(target, value=Relation(name, operator, exact), kind="angle", dimension=NUMBER, number=number)


def _wrong_inequality(typed: Relation, goal: Relation, key: Key) -> Verdict:
    for operator, because, outcome in (
        (STRICT.get(typed.operator), "the limiting case itself is not judged", Outcome.CONVENTION),
        (TURNED.get(typed.operator), "the inequality has the wrong direction", Outcome.SIGN),
        (STRICT.get(TURNED.get(typed.operator, ""), ""), "the inequality has the wrong direction", Outcome.SIGN),
        (
            "=" if goal.operator == "=" else None,
            "an inequality is typed, but an equation is asked for",
            Outcome.DIFFERENT,
        ),
    ):
        if operator and _are_equivalent(Relation(typed.left, operator, typed.right), goal):
            return Verdict(outcome, because)
    if typed.operator == "=" and goal.operator not in ("=", "!="):
        for operator in ("<", ">", "<=", ">="):
            if _are_equivalent(Relation(typed.left, operator, typed.right), goal):
                return Verdict(Outcome.CONVENTION, f"as the limiting case of the condition {shown(goal, key)}")
    if typed.left == goal.left and isinstance(goal.left, Symbol):
        ratio = factor_between(typed.right, goal.right)
        if ratio is not None and ratio.is_number:
            return Verdict(Outcome.FACTOR, f"the limiting value is {shown(ratio, key)} times the right one")
    is_equation = goal.operator == "=" and typed.operator != "="
    told = "an inequality is typed, but an equation is asked for" if is_equation else "it is another condition"
    return Verdict(Outcome.DIFFERENT, told)


def _wrong_equation(comparison: _Comparison, typed: Relation, goal: Relation) -> Verdict:
    """Return what is wrong with an equation. For the comparison, the equation is scaled so that one of its terms equals
    a term of the right equation."""
    key = comparison.key
    given, wanted = sympy.expand(typed.residual), sympy.expand(goal.residual)
    read = comparison.read
    unknown = [each for each in read.unknown if each in given.free_symbols]
    if unknown and (found := comparison.other_letters(given, wanted)) is not None:
        return found
    for scaled in _scalings(given, wanted):
        renamed = comparison.other_letters(scaled, wanted) if unknown else None
        if renamed is not None:
            return renamed
        if (turned := comparison.turned(scaled, wanted)) is not None:
            return turned
    if unknown:
        names = ", ".join(f"`{shown(each, key)}`" for each in unknown)
        return Verdict(Outcome.DIFFERENT, f"the problem has no {names}")
    for other in (*key.targets, *key.steps):
        if other.is_relation and other.key != comparison.target.key and other.value != comparison.target.value:
            if _are_equivalent(typed, other.value):
                where = f" of part ({other.label})" if other.label else ""
                return Verdict(Outcome.ANOTHER, f"it is another equation{where}: {other.text[:160]}")
    dimensions = _inhomogeneous(comparison, typed)
    if dimensions is not None:
        return dimensions
    best: Verdict | None = None
    for scaled in _scalings(given, wanted):
        for outcome, because in slips_between(scaled, wanted, lambda each: shown(each, key)):
            found = Verdict(outcome, because)
            best = found if best is None or found.rank < best.rank else best
            break
        if best is not None:
            return best
    return Verdict(Outcome.DIFFERENT, "it is another equation")


def _inhomogeneous(comparison: _Comparison, typed: Relation) -> Verdict | None:
    from derive.algebra.kinds import Inhomogeneous, named

    try:
        dimensions = [comparison.dimension(side) for side in typed.sides if side != 0]
        if len(dimensions) == 2 and None not in dimensions and dimensions[0] != dimensions[1]:
            one, other = (named(each) for each in dimensions if each is not None)
            return Verdict(Outcome.DIMENSION, f"the left side is {one}, but the right side is {other}")
    except Inhomogeneous as error:
        term = shown(error.term, comparison.key)
        other = error.other if isinstance(error.other, str) else shown(error.other, comparison.key)
        return Verdict(
            Outcome.DIMENSION, f"`{term}` is {named(error.dimension)}, but `{other}` is {named(error.expected)}"
        )
    return None


def _scalings(given: Expr, wanted: Expr) -> list[Expr]:
    """Return at most four multiples of an equation. The multiple with the most terms of the right equation comes first;
    among equals, the unchanged equation comes first.

    Each multiple has at least one such term. Its factor contains no rate and no coordinate, because M = 0 must not
    count as an equation of motion in which a term is missing.
    """
    letters = {each for each in wanted.free_symbols if isinstance(each, Symbol)}
    moving = {each for each in letters if each.name.endswith(RATES[1:]) or {rate(each), rate(each, 2)} & letters}
    terms = [sympy.Add.make_args(each) for each in (given, wanted)]
    found: dict[Expr, Expr] = {}
    for term in terms[0][:6]:
        for goal in terms[1][:8]:
            ratio = goal / term
            if ratio.free_symbols & moving:
                continue
            if not any(factor.as_base_exp()[0].is_Add for factor in sympy.Mul.make_args(ratio)):
                found.setdefault(ratio, sympy.expand(given * ratio))
    common = [each for each in found if sum(sympy.expand(t * each) in terms[1] for t in terms[0])]
    count = {each: sum(sympy.expand(t * each) in terms[1] for t in terms[0]) for each in common}
    return [found[each] for each in sorted(common, key=lambda each: (-count[each], each != 1))[:4]]


def verdict_on_equation_for(left: Read, right: Read, target: Target, key: Key) -> Verdict | None:
    """Compare an equation with an answer that is a value, such as `omega^2 = g/l` for omega; None for any other
    equation."""
    symbol, value = target.symbol, target.value
    if isinstance(left.value, MatrixBase) or isinstance(right.value, MatrixBase) or not isinstance(value, Expr):
        return None
    residual = left.value - right.value
    if not isinstance(symbol, Symbol):
        return verdict_on_value(right, target, key) if left.value == symbol else None
    if symbol not in residual.free_symbols:
        alone = left.value.free_symbols - right.value.free_symbols
        others = [each for each in alone if isinstance(each, Symbol) and _base(each) == _base(symbol)]
        if isinstance(left.value, sympy.Pow) and left.value.exp == 2:  # `T^2 = ...`, with any name for the answer
            others = others or [each for each in alone if each == left.value.base]
        if len(others) != 1:
            return None
        residual = residual.xreplace({others[0]: symbol})
    comparison = _Comparison(right, target, key)
    full = comparison.expanded(value)
    rest = residual.xreplace({each: of for each, of in key.definitions.items() if each != symbol})
    if rest == 0 or symbol not in rest.free_symbols:
        return None
    put_in = rest.xreplace({symbol: full})
    signs = (1, -1) if PLUS_MINUS in put_in.free_symbols else (1,)
    if all(are_equal(put_in.xreplace({PLUS_MINUS: Integer(s)}), Integer(0)) for s in signs):
        doubled = are_equal(rest.xreplace({symbol: -full}), Integer(0)) and len(signs) == 1
        note = f"the sign of {shown(symbol, key)} is left open" if doubled and not symbol.is_positive else ""
        return Verdict(Outcome.EQUAL, f"as an equation for {shown(symbol, key)}" + (f"; {note}" if note else ""))
    if inexact := (*left.decimals, *right.decimals):
        within = sum(Rational(1, 2) / Integer(10) ** digits / abs(each) for each, digits in inexact if each)
        one, other = (comparison.expanded(side).xreplace({symbol: full}) for side in (left.value, right.value))
        if within < Rational(1, 19) and factor_is_near(one, other, within):
            return Verdict(Outcome.EQUAL, f"as an equation for {shown(symbol, key)}, with rounded numbers")
    return _solved(rest, symbol, left, target, key)


def _solved(rest: Expr, symbol: Symbol, left: Read, target: Target, key: Key) -> Verdict | None:
    """Judge the solutions of a short equation for the symbol of the answer; None if no solution is found."""
    try:
        found = sympy.solve(rest, symbol) if sympy.count_ops(rest) < 80 else []
    except FAULTS:
        return None
    best: Verdict | None = None
    for each in found[:3]:
        verdict = verdict_on_value(Read(left.node, each), target, key)
        best = verdict if best is None or verdict.rank < best.rank else best
    return best.adding(f"solved for {shown(symbol, key)}") if best is not None else None


def _base(symbol: Symbol) -> str:
    from derive.grading.names import parts_of

    base, _, order = parts_of(symbol.name)
    return f"{base}{order}"
