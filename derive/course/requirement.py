"""What a script requires of what is given: a disc that is mounted on a rod does not lie beyond its end."""

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
    """Refuse what is given if a condition is known to fail, by its letters or by their numbers.

    What neither decides is assumed, and the page says so.

    condition   a comparison of what is given, `disc_at <= rod_length`, or several that all must hold, joined by `&`
    given       the parameter to blame
    must        what it must be, for the message: "must not lie beyond the end of the rod"
    """
    run = record.current_run.get()
    place = run.places.get(given) if run else None
    for each in And.make_args(true if condition is True else false if condition is False else condition):
        known = with_numbers(each)
        if known == false:
            rejected("not-as-required", f"`{given}` {must}", place)
        if known == true:
            continue
        if not isinstance(each, Relational):  # of `a < b or c < d` nobody could say which of them is assumed
            rejected("wrong-argument", f"`require` takes comparisons that all must hold, but not `{each}`", place)
        record.assume(Relation(each.lhs, _MARKS[each.rel_op], each.rhs))
