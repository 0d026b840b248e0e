"""The lines of a step as a page shows them: left side, relation, right side, and the reason for the line."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

from sympy import Expr, Integral, MatrixBase, Mul, Symbol, preorder_traversal

from derive.algebra.expressions import Relation
from derive.algebra.tidy import common_factor
from derive.page.abbreviations import shortened
from derive.page.assumptions import MIRRORED
from derive.page.numbering import Number
from derive.page.signs import name_before, sign_before, sign_behind_name, sign_of_relation
from derive.page.wording import Inline, Math, Phrases, Ref, filled, joined, names_asked
from derive.steps.derivation import Derivation
from derive.steps.step import NUMBERS, ONLY_ABOUT, Form, Step

EQUATION_OF = "equation_of_"  # in a reason, <<equation_of_ROLE>> prints the numbers of the equations with this role


@dataclass(frozen=True)
class ChainLine:
    """`left relation right` with a reason; `left` is None if the line continues a chain of expressions or decimals."""

    left: Any | None
    relation: str
    right: Any
    reason: tuple[Inline, ...] = ()
    presented: bool = False
    numeric: bool = False
    beside: bool = False  # whether this line may share the row of the line before
    # the `because` of this line in the step's chain; empty for a condition and for a line of a list of results
    because: str = ""


@dataclass(frozen=True)
class Equations:
    """The lines of one step, or of steps that share a row, and the number of the equation. The last `framed` lines are
    framed as an answer."""

    key: str
    lines: tuple[ChainLine, ...]
    number: Number
    framed: int = 0

    @property
    def chains(self) -> tuple[tuple[ChainLine, ...], ...]:
        """Return the lines of each chain; in a list of results each line is a separate chain."""
        starts = [i for i, l in enumerate(self.lines) if not i or l.beside or (l.left is not None and not l.because)]
        return tuple(self.lines[i:j] for i, j in pairwise([*starts, len(self.lines)]))

    def beside(self, other: Equations) -> Equations:
        """Return the lines of both steps under one number; the steps share a row if there is room."""
        first, *others = other.lines
        lines = (*self.lines, replace(first, beside=True), *others)
        return replace(self, lines=lines, framed=len(lines) if other.framed else self.framed)


class ChainWriter:
    """Writes the lines of each step of a page.

    names    names that prose may mention on this page
    numbers  the numbers of the equations that are already on the page
    drawn    the names of the curves in the plots of the page
    """

    def __init__(
        self,
        derivation: Derivation,
        values: Mapping[str, Step],
        words: Phrases,
        names: Mapping[str, Any],
        numbers: Mapping[str, Number],
        drawn: Iterable[Any] = (),
    ):
        self.values, self.words, self.names, self.numbers = values, words, names, numbers
        self.steps = {step.key: step for step in derivation.steps}
        self.symbols = {step.key: step.symbol for step in derivation.steps}
        self._short = shortened(derivation.steps)
        self._used = _letters_used(derivation.steps, values, drawn)

    def of(self, step: Step, mode: str = "") -> tuple[ChainLine, ...]:
        """Return the lines of a step; decimals follow an exact answer. If `mode` is `result` or `hidden`, lines before
        the result are left out."""
        forms = [form for form in step.chain if form.expr != step.symbol]
        if mode in ("result", "hidden"):
            forms = [step.chain[-1]]
        if names_results(step.symbol) and isinstance(step.result, MatrixBase):
            return listed(step.symbol, step.result)
        result = len(forms) - 1
        forms += self._decimals(step)
        before = [None, *(form.because for form in forms)]
        forms = [replace(form, expr=self._short(step, form.expr)) for form in forms]
        lines = [self._line(step, form, because) for form, because in zip(forms, before, strict=False)]
        last = lines[result]
        is_matrix = isinstance(last.right, MatrixBase)
        if not is_matrix or last.left is None or last.right.shape[1] > 1 or _share_a_sum_or_root(last.right):
            lines[result] = replace(last, presented=True)  # a common factor is in front, and tan a replaces sin a/cos a
        return tuple(lines)

    def _decimals(self, step: Step) -> list[Form]:
        """Return the decimals of an answer that contains no symbols."""
        value = self.values.get(step.key)
        exact = value is not None and value.outcome == "exact"
        return [form for form in value.chain if form.because in NUMBERS] if value is not None and exact else []

    def _line(self, step: Step, form: Form, before: str | None) -> ChainLine:
        stands_alone = before is None and not isinstance(form.expr, Relation)
        template = "" if stands_alone else self.words.reason(step, form.because, before or "")
        reason = self._reason(step, form, template)
        numeric = form.because in NUMBERS
        if isinstance(form.expr, Relation) and numeric and before is not None:
            return ChainLine(None, sign_before(form), form.expr.right, reason, numeric=True, because=form.because)
        if isinstance(form.expr, Relation):
            left, right, word = form.expr.left, form.expr.right, sign_of_relation(step, form.expr.word)
            if step.about and word != "approx" and not reason:  # an inequality has no sign for "about"
                reason = filled(self.words.labels["approximately"], {})
            return ChainLine(left, word, right, reason, numeric=numeric, because=form.because)
        own = step.breaks_off and form.because in ONLY_ABOUT and step.symbol in self._used
        return ChainLine(
            left=name_before(step) if before is None else None,
            relation=sign_behind_name(step, form) if before is None else sign_before(form),
            right=Relation(step.symbol, "=", form.expr) if own else form.expr,
            reason=reason,
            presented=form.because == "result",
            numeric=numeric,
            because=form.because,
        )

    def _reason(self, step: Step, form: Form, template: str) -> tuple[Inline, ...]:
        if not template:
            return ()
        direct = [None, *(symbol for _, symbol in step.roles)]
        near = [key for key in step.inputs if self.symbols.get(key) in direct]
        keys = self._numbered({each for key in near for each in self._having(key, step)})
        found = {"refs": keys, "equations": [key for key in keys if self.symbols[key] is None]}
        called = {f"{EQUATION_OF}{role}": symbol for role, symbol in step.roles}
        found |= {
            name: self._numbered({key for key in near if self.symbols[key] == called[name]})
            for name in names_asked(template) & called.keys()
        }
        if any(not found[name] for name in names_asked(template) & found.keys()):
            return ()
        is_plain = template in self.words.reasons["general"].values()
        if is_plain and self._are_just_before(
            step, [key for name in names_asked(template) & found.keys() for key in found[name]]
        ):
            return ()
        own = {role: Math(symbol) for role, symbol in step.roles if symbol is not None}
        inner = [whole.variables[0] for whole in form.expr.atoms(Integral) if not whole.function.has(Integral)]
        own |= {"variable": Math(inner[0])} if inner else {}
        found = {name: self._one_of_each_row(keys) for name, keys in found.items()}
        references = {
            name: joined([Ref(key) for key in keys], self.words.labels["and"]) for name, keys in found.items()
        }
        return filled(template, {**self.names, **own, **references})

    def _are_just_before(self, step: Step, keys: Collection[str]) -> bool:
        """Return whether all these equations have one of the last two numbers before the step. The reader has just read
        them, so a note that only names them says nothing new."""
        if not keys or step.key not in self.numbers:
            return False
        earlier = sorted({each for each in self.numbers.values() if each < self.numbers[step.key]})
        return {self.numbers[key] for key in keys} <= set(earlier[-2:])

    def _numbered(self, keys: Collection[str]) -> list[str]:
        return sorted(self.numbers.keys() & keys, key=self.numbers.__getitem__)

    def _one_of_each_row(self, keys: Sequence[str]) -> list[str]:
        return list({self.numbers[key]: key for key in reversed(keys)}.values())[::-1]

    def _having(self, key: str, of: Step) -> list[str]:
        """Return the key itself. But for a vector or tensor that the page does not show, return the keys of its inputs
        whose symbols are in the lines of the step `of`."""
        step = self.steps.get(key)
        if key in self.numbers or step is None or not isinstance(step.result, MatrixBase):
            return [key]
        letters = {letter for form in of.chain for letter in getattr(form.expr, "free_symbols", ())}
        return [each for each in step.inputs if self.symbols.get(each) in letters]


def without_inserted(lines: Sequence[ChainLine], shown: Collection[Any]) -> tuple[ChainLine, ...]:
    """Drop I phi'' = r F before m r^2 phi'' = r F if the page has shown I = m r^2.

    shown   the symbols of the equations that the page has shown
    """
    follow = [*lines[1:], None]
    return tuple(line for line, after in zip(lines, follow, strict=True) if not _is_inserted(line, after, shown))


def _is_inserted(line: ChainLine, after: ChainLine | None, shown: Collection[Any]) -> bool:
    if after is None or not (isinstance(line.left, Expr) and isinstance(after.left, Expr)):
        return False
    lost = line.left.free_symbols - after.left.free_symbols
    same = line.relation == after.relation and line.right == after.right and getattr(line.right, "free_symbols", ())
    return bool(same and lost) and lost <= set(shown)


def conditions_of(step: Step) -> tuple[ChainLine, ...]:
    """Return a line for each condition under which the answer holds. If the conditions are a lower and then an upper
    bound of one quantity, they share a line."""
    told = dict(step.roles)
    found = [told[role] for role in step.display.conditions if role in told]
    if len(found) == 2 and found[0].left == found[1].left and found[0].operator in MIRRORED:
        lower, upper = found  # 2 g l < v^2 < 5 g l
        found = [Relation(Relation(lower.right, MIRRORED[lower.operator], lower.left), upper.operator, upper.right)]
    return tuple(ChainLine(each.left, each.word, each.right, beside=True) for each in found)


def _letters_used(steps: Sequence[Step], values: Mapping[str, Step], drawn: Iterable[Any]) -> set[Any]:
    """Return the symbols of limits and series that the page must introduce."""
    own = {step.symbol for step in steps if step.breaks_off and step.symbol is not None}
    found = {*drawn, *(step.symbol for step in values.values())} & own
    for step in steps if own else ():
        shown = [form.expr for form in step.chain]
        shown += [step.symbol] if step.symbol not in own else [name_before(step)]
        shown += [] if step.breaks_off else [told for _, told in step.roles]
        found |= own & {part for expr in shown if expr is not None for part in preorder_traversal(expr)}
    return found


def _share_a_sum_or_root(vector: MatrixBase) -> bool:
    """Return whether all entries except zeros share a factor or denominator that is an irrational number or a power of
    a sum. If such a factor is in front of the vector, it is printed only once."""
    present = [entry for entry in vector if entry != 0]
    factors = Mul.make_args(common_factor(present))
    return len(present) > 1 and any(each.as_base_exp()[0].is_Add or each.is_irrational for each in factors)


def names_results(symbol: Any) -> bool:
    """Return whether the symbol is a list of names, one for each result, rather than the symbol of a vector."""
    return isinstance(symbol, MatrixBase) and all(isinstance(name, Symbol) for name in symbol)


def listed(names: Any, values: Any) -> tuple[ChainLine, ...]:
    """Return a line for each distinct value with all its names, such as I_1 = I_2 = a and I_3 = b; the lines share a
    row if there is room."""
    found: dict[Any, Any] = {}
    for name, value in zip(names, values, strict=True):
        found[value] = Relation(found[value], "=", name) if value in found else name
    return tuple(
        ChainLine(left, "equals", value, presented=True, beside=i > 0) for i, (value, left) in enumerate(found.items())
    )
