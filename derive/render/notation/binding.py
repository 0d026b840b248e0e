"""How strongly a layout binds, and where brackets and signs are therefore needed.

Brackets depend on what is printed, not on the kind of expression. For example, a product with one negative factor may
be a `Mul`, a `Factors` or a number times a vector. In print it begins with a minus sign, so it gets brackets next to
other factors.
"""

from __future__ import annotations

from enum import IntEnum

from derive.render.notation.layout import (
    Applied,
    Array,
    Bracketed,
    Digits,
    Evaluated,
    Fenced,
    Fraction,
    IntegralSign,
    Layout,
    Lowered,
    Name,
    Operator,
    Raised,
    RootSign,
    Row,
    Sign,
    Upright,
    ends_in_differential,
    is_differential,
    row,
)


class Binding(IntEnum):
    """Kinds of layout, from kinds that never need brackets to kinds that need brackets next to anything.

    PRODUCT    factors side by side: 2 M a
    DOTTED     numbers and letters with a dot between them: M·1/2 a
    MEASURED   a number with its unit: 2 cm
    OPEN       extends over everything that follows: a·b and w x L of vectors, an integral, d/dt (...)
    SIGNED     -M a
    """

    ATOM = 0
    FACTOR = 1
    PRODUCT = 2
    DOTTED = 3
    MEASURED = 4
    OPEN = 5
    SIGNED = 6
    SUM = 7
    RELATION = 8


_MARKS = {
    "plus": Binding.SUM,
    "minus": Binding.SUM,
    "plus_minus": Binding.SUM,
    "comma": Binding.RELATION,
    "semicolon": Binding.RELATION,
}
_MARKS |= {"dot": Binding.DOTTED, "times": Binding.DOTTED, "inner": Binding.OPEN, "cross": Binding.OPEN}
_MARKS |= {"space": Binding.PRODUCT, "open": Binding.PRODUCT, "close": Binding.PRODUCT}
_SIGNS = {"plus", "minus", "plus_minus"}


def binding(layout: Layout) -> Binding:
    match layout:
        case Digits() | Name() | Fenced() | Bracketed() | Array() | Upright():
            return Binding.ATOM
        case Fraction() | RootSign() | Applied() | Raised() | Lowered() | Evaluated():
            return Binding.FACTOR
        case Row(items):
            return max(_of_item(i, items, ends_in_differential(layout)) for i in range(len(items)))
        case Operator(kind):
            return _MARKS.get(kind, Binding.RELATION)
        case IntegralSign():
            return Binding.OPEN
        case Sign():
            return Binding.RELATION
    raise TypeError(f"no binding for {type(layout).__name__}")


def _of_item(i: int, items: tuple[Layout, ...], ended: bool) -> Binding:
    """Return the binding of item `i` of a row.

    ended   whether the row ends in a differential
    """
    item = items[i]
    if isinstance(item, IntegralSign) and ended:
        return Binding.PRODUCT
    if i == 0 and isinstance(item, Operator) and item.kind in _SIGNS:
        return Binding.SIGNED
    if isinstance(item, Operator | IntegralSign):
        return binding(item)
    if isinstance(item, Upright) and item.text not in ("d", "partial"):
        return Binding.MEASURED
    return Binding.OPEN if _is_operator(item) and i + 1 < len(items) else Binding.PRODUCT


def _is_operator(layout: Layout) -> bool:
    """Return whether the layout is an operator such as d/dt or d^2/dx^2, which acts on the layout after it."""
    return isinstance(layout, Fraction) and is_differential(layout.above)


def within(layout: Layout, most: Binding) -> Layout:
    """Return the layout, in brackets if it binds less strongly than `most`."""
    return Fenced(layout) if binding(layout) > most else layout


def sign_apart(layout: Layout) -> tuple[Operator | None, Layout]:
    """Return the leading sign of a layout, or None, and the rest. The sign of the first term of a sum is not split
    off."""
    if isinstance(layout, Row) and isinstance(layout.items[0], Operator) and binding(layout) is Binding.SIGNED:
        return layout.items[0], row(*layout.items[1:])
    return None, layout


def signed(sign: Operator, layout: Layout) -> Layout:
    """Return the layout with this sign in front."""
    return row(sign, within(layout, Binding.OPEN))
