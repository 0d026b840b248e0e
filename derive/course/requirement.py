"""Conditions that the givens of a script must satisfy."""

from __future__ import annotations

from sympy import false, true
from sympy.core.relational import Relational
from sympy.logic.boolalg import And, Boolean

from derive.algebra.expressions import Relation
from derive.errors import rejected
from derive.steps import record
from derive.steps.known_numbers import with_numbers

_MARKS = {"==": "=", "!=": "!=", "<": "<", ">": ">", "<=": "<=", ">=": ">="}


def require(condition: Boolean | bool, given: str, must: str) -> None:
    """Reject a given value if a condition is known to fail.

    If it is unknown whether the condition holds, the condition is assumed, and the page states this assumption.

    condition   a comparison of givens, such as `disc_at <= rod_length`, or several comparisons joined by `&`
    given       the name of the parameter of `solve()`, for the error
    must        the requirement, for the message: "must not lie beyond the end of the rod"
    """
    run = record.current_run.get()
    place = run.places.get(given) if run else None
    for each in And.make_args(true if condition is True else false if condition is False else condition):
        known = with_numbers(each)
        if known == false:
            rejected("not-as-required", f"`{given}` {must}", place)
        if known == true:
            continue
        if not isinstance(each, Relational):  # `(a < b) | (c < d)` does not say which inequality holds
            rejected("wrong-argument", f"`require` takes comparisons that must all hold, but not `{each}`", place)
        record.assume(Relation(each.lhs, _MARKS[each.rel_op], each.rhs))
