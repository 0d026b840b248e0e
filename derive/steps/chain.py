"""The lines of a step: the values of the names in them, and the evidence that each line follows from the one before."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from sympy import Expr, MatrixBase, MatrixSymbol, Symbol, diff, preorder_traversal

from derive.algebra.equality import Compared, Evidence, Grade, Verdict, equal
from derive.algebra.expansion import Expansion
from derive.algebra.expressions import Relation, Truncated, bound, component_names, explicit
from derive.algebra.normal_form import vanishes
from derive.errors import Complaint, Unverified
from derive.steps.rule import Rule
from derive.steps.step import NUMBERS, ONLY_ABOUT, Form, Level, Quantity, Route

BY_MOTION = "by the equations of motion"  # end of a claim that is true only for motions that satisfy these equations


def without_repeats(forms: Sequence[Form], symbol: Any) -> list[Form]:
    """Merge successive forms with the same expression, except a rounded form, and leave out forms that are only the
    symbol of the step. If no other form exists, the last one is kept."""
    kept: list[Form] = []
    for form in [form for form in forms if form.expr != symbol] or forms[-1:]:
        if kept and kept[-1].expr == form.expr and form.because != "rounded":
            level = min(kept[-1].level, form.level, key=list(Level).index)
            kept[-1] = replace(kept[-1], level=level)
        else:
            kept.append(form)
    return kept


def bindings_of(quantities: Sequence[Quantity]) -> dict[Any, Any]:
    """Return the values of these quantities, and the components of vectors, by their symbols."""
    values: dict[Any, Any] = {}
    for quantity in quantities:
        if quantity.symbol is None:
            continue
        values[quantity.symbol] = quantity.value
        if isinstance(quantity.symbol, MatrixSymbol) and quantity.symbol.shape == (3, 1):
            names = component_names(quantity.symbol.name)
            values.update(zip(names, list(quantity.value), strict=True))
        elif isinstance(quantity.symbol, MatrixBase):  # several results of one step, such as I_1, I_2, I_3
            values.update(zip(quantity.symbol, quantity.value, strict=True))
    # A name whose value is the name itself is left out (a general omega has the components omega_x, omega_y, omega_z).
    return {name: value for name, value in values.items() if name != value}


def left_side_evidence(key: str, symbol: Any, first: Form, bindings: Mapping[Any, Any]) -> list[Evidence]:
    """Check that the left side equals the first line. A left side that is only a name is not checked, and nothing is
    checked if the first line is a relation."""
    is_name = symbol is None or isinstance(symbol, Symbol | MatrixSymbol | MatrixBase)
    if is_name or isinstance(first.expr, Relation):
        return []
    left, right = (bound(explicit(bound(each, bindings)), bindings) for each in (symbol, first.expr))
    verdict = equal(left, right)
    if not verdict:
        raise refused(key, f"its left side {symbol} does not equal its first line", left, right, verdict)
    return [Evidence("line 1 equals the left side", Compared.LINES, verdict.grade, verdict.detail)]


def check_last_line(
    key: str, chain: Sequence[Form], result: Any, bindings: Mapping[Any, Any], motion: Mapping[Symbol, Expr]
) -> None:
    """Check that the result equals the last line that is neither a number in a unit nor a truncated series."""
    last = next(
        form for form in reversed(chain) if form.because not in NUMBERS and not isinstance(form.expr, Truncated)
    )
    shown = explicit(bound(last.expr, bindings))
    if last.expr == result or bound(shown, motion) == bound(explicit(result), motion):
        return
    verdict = equal(bound(shown, motion), bound(result, motion), [explicit(bound(f, bindings)) for f in last.nonzero])
    if not verdict:
        raise refused(key, "its result does not equal its last line", shown, result, verdict)


def evidence_of_routes(key: str, rule: Rule, result: Any, routes: Mapping[str, Route]) -> list[Evidence]:
    unknown = sorted(routes.keys() - rule.evidence.keys())
    if unknown:
        message = f"`{key}`: the rule `{rule.name}` does not list the claim `{unknown[0]}` under `evidence`"
        raise Unverified(Complaint("unverified", message, help="add the claim to its `evidence`: a ROUTE or a CHECK"))
    return [route_evidence(key, claim, route(result), rule.evidence[claim]) for claim, route in routes.items()]


def names_in(exprs: Sequence[Any], bindings: Mapping[Any, Any]) -> tuple[tuple[Any, Any], ...]:
    """Return the names that occur in any of the expressions, with their values."""
    parts = {part for expr in exprs if expr is not None for part in preorder_traversal(expr)}
    return tuple((name, value) for name, value in bindings.items() if name in parts)


def line_evidence(
    key: str, chain: Sequence[Form], i: int, bindings: Mapping[Any, Any], motion: Mapping[Symbol, Expr]
) -> Evidence:
    form, before = chain[i], chain[i - 1]
    if form.because in NUMBERS:  # compare each number with the symbolic result, not with the number before it
        before = next(other for other in reversed(chain[:i]) if other.because not in NUMBERS)
    left, right = (explicit(bound(each.expr, bindings)) for each in (before, form))
    claim = f"line {i + 1} equals line {i}"
    if form.because == "rounded":
        return _rounding_evidence(key, claim, left, form.expr)
    if isinstance(form.expr, Truncated):
        return _series_evidence(key, claim, left, form.expr)
    if form.because == "motion":
        claim = f"{claim} {BY_MOTION}"
        left, right = bound(left, motion), bound(right, motion)
    _check_sign(key, i, before, form)
    verdict = equal(left, right, [explicit(bound(factor, bindings)) for factor in form.nonzero])
    if not verdict:
        raise refused(key, f"line {i + 1} ({form.because}) does not follow from line {i}", left, right, verdict)
    return Evidence(claim, Compared.LINES, verdict.grade, verdict.detail)


def _check_sign(key: str, i: int, before: Form, form: Form) -> None:
    """Check a line without expansions that follows a line with expansions. An equals sign is allowed only if the lines
    are exactly equal. A limit must not contain the symbol that goes to its limit."""
    cut = before.expr.atoms(Expansion) if not form.expr.has(Expansion) else set()
    if not cut:
        return
    if form.because == "limit" and form.expr.free_symbols & {each.args[1] for each in cut}:
        raise Unverified(Complaint("unverified", f"`{key}`: line {i + 1} contains the letter that goes to its limit"))
    whole = before.expr.xreplace({each: each.args[0] for each in cut})
    if form.because not in ONLY_ABOUT and not equal(explicit(whole), explicit(form.expr)):
        raise Unverified(Complaint("unverified", f"`{key}`: line {i + 1} is only approximately equal to line {i}"))


def _series_evidence(key: str, claim: str, whole: Any, series: Any) -> Evidence:
    """Check a truncated series: at the point of expansion, its value and derivatives must equal those of the whole
    expression. The series must have no term beyond its order."""
    polynomial, x, place, order = series.args
    if not vanishes(diff(explicit(polynomial), x, int(order) + 1)):
        raise Unverified(Complaint("unverified", f"`{key}`: the series has terms beyond order {order} in {x}"))
    rest = whole - explicit(polynomial)
    for n in range(int(order) + 1):
        if not vanishes(diff(rest, x, n).subs(x, place)):
            raise Unverified(Complaint("unverified", f"`{key}`: the series is wrong at order {n} in {x}"))
    return Evidence(claim, Compared.LINES, Grade.APPROXIMATION, f"to order {order} in {x}")


def _rounding_evidence(key: str, claim: str, exact: Any, rounded: Any) -> Evidence:
    """Check that a rounded value differs from the exact value by at most half a unit of its last digit."""
    from derive.algebra.rounding import off_by_more_than_half_a_unit

    offender = off_by_more_than_half_a_unit(exact, rounded)
    if offender:
        raise Unverified(Complaint("unverified", f"`{key}`: {offender[0]} is not {offender[1]} rounded"))
    return Evidence(claim, Compared.LINES, Grade.APPROXIMATION, "within half a unit of the last place")


def approximation_evidence(
    key: str, symbol: Any, chain: Sequence[Form], whole: Any, rests: Sequence[Quantity]
) -> tuple[Any, bool, list[Evidence]]:
    """Return three values for a result that may be approximate.

    The first value is the symbol or the key of the exact result that this result approximates, or None. The second
    value is whether the result is derived from another approximation. The third value is the evidence.

    The symbol of a limit or a series must differ from the symbol of the exact result, unless the last line is a
    `Truncated` series.
    """
    last = chain[-1]
    if last.because in ONLY_ABOUT and not isinstance(last.expr, Truncated) and (whole is None or whole == symbol):
        message = f"`{key}`: an approximation needs an exact result with a letter other than {symbol}"
        raise Unverified(Complaint("unverified", message))
    if whole is not None:
        return whole, False, []
    found = [quantity for quantity in rests if not quantity.exact]
    same = [q for q in found if not q.step.about and symbol is not None and q.symbol == symbol]
    if len(found) == len(same):
        return (same[0].step.approximates if same else None), False, []
    claim = f"rests on the approximation `{next(q.key for q in found if q not in same)}`"
    return None, True, [Evidence(claim, Compared.LINES, Grade.APPROXIMATION, "as exact as this approximation")]


def route_evidence(
    key: str, claim: str, found: tuple[Any, Any] | Verdict, compared: Compared = Compared.ROUTE
) -> Evidence:
    """Return the evidence of a route or a check; `found` is a pair of values to compare, or a verdict. Raise
    `Unverified` if the values differ or the verdict is negative."""
    if isinstance(found, Verdict):
        left = right = None
        verdict = found
    else:
        left, right = (explicit(value) for value in found)
        verdict = equal(left, right)
    if not verdict:
        what = "second route" if compared is Compared.ROUTE else "check"
        raise refused(key, f"its {what} `{claim}` disagrees", left, right, verdict)
    return Evidence(claim, compared, verdict.grade, verdict.detail)


def refused(key: str, what: str, left: Any, right: Any, verdict: Verdict) -> Unverified:
    notes = [f"by the law     {short(left)}", f"otherwise      {short(right)}"]
    at = ", ".join(f"{name} = {value}" for name, value in verdict.point)
    notes.append(f"they differ: {verdict.detail}" + (f" at {at}" if at else ""))
    return Unverified(Complaint("unverified", f"`{key}`: {what}", notes=tuple(notes)))


def short(value: Any) -> str:
    text = str(value)
    return text if len(text) <= 300 else text[:300] + " ..."
