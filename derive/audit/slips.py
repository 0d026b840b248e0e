"""The nearest single change that makes a wrong side right, and the slip of the author that this change corrects."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from itertools import islice
from typing import Any

from derive.documents.source import Span
from derive.documents.syntax import Add, Diff, Frac, Fun, Group, Int, Letter, Mul, Node, Num, Pow, Sign

MOST_EDITS = 1500
OTHER_FUNCTION = {"sin": "cos", "cos": "sin", "sinh": "cosh", "cosh": "sinh", "tan": "sin"}


WHY = {
    "number": "a number was mistyped",
    "sign": "a sign was lost or reversed",
    "index": "one index was written for another",
    "letter": "one letter was written for another",
    "exponent": "an exponent was lost or mistyped",
    "factor": "a factor was lost",
    "extra factor": "a factor was written twice, or is superfluous",
    "term": "a superfluous term was written",
    "lost term": "a term was lost",
    "function": "one function was written for another",
    "differential": "the d of a differential was lost",
    "dots": "a dot was lost or added",
    "fraction": "numerator and denominator were exchanged",
}


@dataclass(frozen=True)
class Edit:
    """One change of a side. `node` is the side after the change, `was` is the text at `span`, and `meant` is the text
    that would be right."""

    node: Node
    span: Span
    was: str
    meant: str
    kind: str
    cost: float

    @property
    def suggestion(self) -> str:
        return f"{self.meant} instead of {self.was}" if self.meant else f"without {self.was}"

    @property
    def why(self) -> str:
        return WHY[self.kind]


def nearest_edit(
    side: Node, letters: Sequence[Letter], is_right: Callable[[Node], bool], shown: Callable[[Span], str]
) -> Edit | None:
    """Return the cheapest change of a side that `is_right` accepts, or None."""
    found = sorted(islice(edits_of_side(side, letters, shown), MOST_EDITS), key=lambda each: each.cost)
    for edit in found:
        if is_right(edit.node):
            return edit
    return None


def edits_of_side(node: Node, letters: Sequence[Letter], shown: Callable[[Span], str]) -> Iterator[Edit]:
    """Yield the single changes of a side, including a reversed sign of the whole side."""
    if not isinstance(node, Add):
        was = shown(node.span)
        yield Edit(Add(node.span, (("-", node),)), node.span, was, f"-{was}", "sign", 1.0)
    yield from edits_of(node, letters, shown)


def with_term(node: Node, term: Node, shown: Callable[[Span], str]) -> Iterator[Edit]:
    """Yield the changes that add a missing term to a side."""
    was = shown(node.span)
    terms = node.terms if isinstance(node, Add) else (("+", node),)
    written = [shown(each.span) for _, each in terms]
    for sign in "+-" if shown(term.span) not in written else "":
        new = Add(node.span, (*terms, (sign, term)))
        yield Edit(new, node.span, was, f"{was} {sign} {shown(term.span)}", "lost term", 2.5)
    for each in fields(node):
        for new, edit in _with_term_inside(getattr(node, each.name), term, shown):
            yield replace(edit, node=replace(node, **{each.name: new}))


def _with_term_inside(value: Any, term: Node, shown: Callable[[Span], str]) -> Iterator[tuple[Any, Edit]]:
    if isinstance(value, Add | Group):
        for edit in with_term(value, term, shown):
            yield edit.node, edit
    elif isinstance(value, Node):
        for each in fields(value):
            for new, edit in _with_term_inside(getattr(value, each.name), term, shown):
                node = replace(value, **{each.name: new})
                yield node, replace(edit, node=node)
    elif isinstance(value, tuple):
        for i, item in enumerate(value):
            for new, edit in _with_term_inside(item, term, shown):
                yield (*value[:i], new, *value[i + 1 :]), edit


def edits_of(node: Node, letters: Sequence[Letter], shown: Callable[[Span], str]) -> Iterator[Edit]:
    """Yield the single changes of a node and of the nodes inside it."""
    yield from _here(node, letters, shown)
    for each in fields(node):
        value = getattr(node, each.name)
        for new, edit in _inside(value, letters, shown):
            yield replace(edit, node=replace(node, **{each.name: new}))


def _inside(value: Any, letters: Sequence[Letter], shown: Callable[[Span], str]) -> Iterator[tuple[Any, Edit]]:
    if isinstance(value, Node):
        for edit in edits_of(value, letters, shown):
            yield edit.node, edit
    elif isinstance(value, tuple):
        for i, item in enumerate(value):
            for new, edit in _inside(item, letters, shown):
                yield (*value[:i], new, *value[i + 1 :]), edit


def _here(node: Node, letters: Sequence[Letter], shown: Callable[[Span], str]) -> Iterator[Edit]:
    was = shown(node.span)
    if isinstance(node, Num):
        for number in _other_numbers(node.text):
            yield Edit(replace(node, text=number), node.span, was, number, "number", 1 + 0.01 * len(number))
    elif isinstance(node, Letter):
        yield from _of_letter(node, letters, was)
    elif isinstance(node, Add):
        yield from _of_sum(node, shown)
    elif isinstance(node, Mul):
        for i, (_, factor) in enumerate(node.factors):
            rest = node.factors[:i] + node.factors[i + 1 :]
            if rest and not isinstance(factor, Diff | Sign):
                left_out = replace(node, factors=(("", rest[0][1]), *rest[1:]))
                yield Edit(left_out, factor.span, shown(factor.span), "", "extra factor", 2.0)
    elif isinstance(node, Pow) and isinstance(node.exponent, Num):
        yield Edit(node.base, node.span, was, shown(node.base.span), "exponent", 0.95)
    elif isinstance(node, Frac):
        turned = f"\\frac{{{shown(node.bottom.span)}}}{{{shown(node.top.span)}}}"
        yield Edit(replace(node, top=node.bottom, bottom=node.top), node.span, was, turned, "fraction", 2.2)
    elif isinstance(node, Fun):
        yield from _of_function(node, shown)
    if isinstance(node, Int):
        for i, item in enumerate(node.items):
            if isinstance(item, Letter):
                items = (*node.items[:i], Diff(item.span, item), *node.items[i + 1 :])
                yield Edit(
                    replace(node, items=items),
                    item.span,
                    shown(item.span),
                    f"d {shown(item.span)}",
                    "differential",
                    0.8,
                )
    if not isinstance(node, Num | Sign | Diff):
        for letter in letters:
            for factor, written in (
                (letter, letter.named()),
                (Pow(node.span, letter, Num(node.span, "2")), f"{letter.named()}^2"),
            ):
                times = Mul(node.span, (("", factor), ("", node)))
                yield Edit(times, node.span, was, f"{written} {was}", "factor", 1.6 if factor is letter else 1.9)
        if not isinstance(node, Letter):
            for number in ("2", "3", "4"):
                times = Mul(node.span, (("", Num(node.span, number)), ("", node)))
                yield Edit(times, node.span, was, f"{number} {was}", "factor", 1.7)
                yield Edit(
                    Frac(node.span, node, Num(node.span, number)), node.span, was, f"{was}/{number}", "factor", 1.75
                )
    if isinstance(node, Letter):
        for number in ("2", "3"):
            yield Edit(Pow(node.span, node, Num(node.span, number)), node.span, was, f"{was}^{number}", "exponent", 1.3)


def _of_function(node: Fun, shown: Callable[[Span], str]) -> Iterator[Edit]:
    was = shown(node.span)
    if node.name in OTHER_FUNCTION:
        name = OTHER_FUNCTION[node.name]
        yield Edit(replace(node, name=name), node.span, was, f"\\{name}", "function", 1.3)
    if node.power is None:
        squared = replace(node, power=Num(node.span, "2"))
        yield Edit(squared, node.span, was, f"\\{node.name}^2 {shown(node.argument.span)}", "exponent", 1.3)
    elif isinstance(node.power, Num):
        bare = replace(node, power=None)
        yield Edit(bare, node.span, was, f"\\{node.name} {shown(node.argument.span)}", "exponent", 0.95)


def _of_letter(node: Letter, letters: Sequence[Letter], was: str) -> Iterator[Edit]:
    for other in letters:
        if other.identity == node.identity and other.dots == node.dots:
            continue
        new = replace(other, span=node.span)
        if other.identity == node.identity:
            yield Edit(new, node.span, was, new.named(), "dots", 1.2)
        elif other.base == node.base and other.dots == node.dots:
            yield Edit(new, node.span, was, new.named(), "index", 1.1)
        else:
            yield Edit(new, node.span, was, new.named(), "letter", 1.5)


def _of_sum(node: Add, shown: Callable[[Span], str]) -> Iterator[Edit]:
    for i, (sign, term) in enumerate(node.terms):
        turned = {"+": "-", "-": "+", "±": "∓", "∓": "±"}[sign]
        terms = (*node.terms[:i], (turned, term), *node.terms[i + 1 :])
        yield Edit(
            replace(node, terms=terms),
            term.span,
            f"{sign}{shown(term.span)}",
            f"{turned}{shown(term.span)}",
            "sign",
            1.0,
        )
        if len(node.terms) > 1:
            rest = node.terms[:i] + node.terms[i + 1 :]
            yield Edit(replace(node, terms=rest), term.span, shown(term.span), "", "term", 2.0)


def _other_numbers(text: str) -> Iterator[str]:
    seen = {text}
    for i, char in enumerate(text):
        if char.isdigit():
            for digit in "0123456789":
                new = text[:i] + digit + text[i + 1 :]
                if new not in seen and new.lstrip("0"):
                    seen.add(new)
                    yield new
    if text.isdigit():
        value = int(text)
        others = [value + 1, value - 1, 2 * value, 10 * value, *([value // 2] if value % 2 == 0 else [])]
        others += [int(text[:i] + text[i + 1 :]) for i in range(len(text)) if len(text) > 1]
        for other in others:
            if other > 0 and str(other) not in seen:
                seen.add(str(other))
                yield str(other)
