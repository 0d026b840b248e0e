"""A verified step, the quantity that it yields, and small functions on values for every verb.

A `Step` is data: keys and expressions, no sentence and no TeX. Only `derive.steps.establish` makes a step.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar, NoReturn, TypeVar

from sympy import Basic, Expr, MatrixBase, ShapeError, Symbol
from sympy.core.symbol import Str

from derive.algebra.equality import LEAST_SURE_FIRST, Compared, Evidence, Grade, Verdict
from derive.algebra.expressions import AXES, Relation, explicit
from derive.algebra.kinds import kind_with_article
from derive.algebra.normal_form import vanishes
from derive.errors import Complaint, Rejected, Unverified
from derive.steps.level import ON_ITS_OWN, Display
from derive.steps.level import Level as Level  # modules that make forms import `Level` from here
from derive.steps.rule import TRIALS, Theorem
from derive.steps.subject import NOTHING, Subject

NUMBERS = ("value", "rounded")  # reasons of the last forms of a chain: the number in a unit, exact or rounded
ONLY_ABOUT = ("limit", "series")  # reasons of forms that are only approximately equal to the form before


@dataclass(frozen=True)
class Form:
    """One line of a chain: an expression, and the reason why it follows from the line before.

    `because` is a key that `templates/phrases` puts into words. A form with the reason `rounded`, `limit` or `series`
    only approximately equals the form before it. The factors `nonzero` may have been divided out: they do not vanish in
    the case considered, and are positive in an inequality.
    """

    expr: Any
    because: str
    level: Level = Level.BRIEF
    nonzero: tuple[Any, ...] = ()


@dataclass(frozen=True)
class Step:
    """An established result: the symbol, the chain that leads to its value, and the evidence.

    `coordinates` are the coordinates in the step, with their kinds. `stands_for` are keys of steps that would exist in
    another case, such as the second root of an equation that has only one root here. `names` are the names that earlier
    steps introduced and that occur in the lines, with their values. `motion` contains the values of rates that follow
    from the equations of motion; a line that uses them holds only for motions that satisfy these equations. `law_at` is
    the place of the law in the code, such as `derive/mechanics/rotation/vectors.py:120`.

    For a limit or a series, `approximates` is the symbol of the exact result, or the key of the exact equation. `about`
    is true for other results that are derived from a limit or a series.

    Three fields come from the rule. `display` is how a page shows the step. `theorems` are the theorems that the step
    uses, and `law_in` are the names of the theorems that state the law of the step.
    """

    key: str
    rule: str
    symbol: Any
    chain: tuple[Form, ...]
    inputs: tuple[str, ...]
    roles: tuple[tuple[str, Any], ...]
    outcome: str
    evidence: tuple[Evidence, ...]
    kind: str | None = None
    words: tuple[tuple[str, str], ...] = ()
    coordinates: tuple[tuple[Symbol, str], ...] = ()
    stands_for: tuple[str, ...] = ()
    names: tuple[tuple[Any, Any], ...] = ()
    motion: tuple[tuple[Symbol, Any], ...] = ()
    law_at: str = field(default="", compare=False)
    approximates: Any = None
    about: bool = False
    display: Display = field(default=ON_ITS_OWN, compare=False)
    theorems: tuple[Theorem, ...] = field(default=(), compare=False)
    law_in: tuple[str, ...] = field(default=(), compare=False)

    @property
    def exact(self) -> bool:
        """Whether the result is exact: neither a limit or a series nor derived from one."""
        return self.approximates is None and not self.about

    @property
    def breaks_off(self) -> bool:
        """Whether the last line of this step is the limit or the series."""
        return self.approximates is not None and self.chain[-1].because in ONLY_ABOUT

    @property
    def result(self) -> Any:
        return self.chain[-1].expr

    @property
    def grade(self) -> Grade:
        """Return the lowest of these grades: the grades of the lines, the grade of the test at trial numbers, and the
        best grade of the other routes and checks."""
        needed = [e for e in self.evidence if e.compared is Compared.LINES or e.claim == TRIALS]
        routes = [e.grade for e in self.evidence if e not in needed]
        surest = [max(routes, key=LEAST_SURE_FIRST.index)] if routes else []
        return min([*(e.grade for e in needed), *surest], key=LEAST_SURE_FIRST.index)


class Fact:
    """Data that a quantity carries in addition to its value, for the verbs that need such data.

    The text `missing` completes the message about a quantity without such a fact.
    """

    missing: ClassVar[str] = "is not of the kind that is needed here"
    eliminates: tuple[Symbol, ...] = ()  # coordinates of the parents on which the quantity no longer depends


class Witness(Fact, ABC):
    """A fact that contains the described system of a quantity; steps are tested on the motion of this system."""

    @abstractmethod
    def testimony(self, quantity: Quantity, judged: Any, outcome: str) -> Verdict | None:
        """Test numerically whether a step is true of the motion; return None if this step has no test."""


F = TypeVar("F", bound=Fact)


@dataclass(frozen=True, eq=False)
class Quantity:
    """A value with the step that made it, the quantities on which this step depends, its facts and its subject.

    Arithmetic on a quantity would lose its history, so it is rejected. Use the verb `let`, which makes a step.
    """

    value: Any
    step: Step
    parents: tuple[Quantity, ...] = ()
    facts: tuple[Fact, ...] = ()
    subject: Subject = NOTHING

    @property
    def symbol(self) -> Any:
        return self.step.symbol

    @property
    def key(self) -> str:
        return self.step.key

    @property
    def exact(self) -> bool:
        """Whether the value is exact: neither a limit or a series nor derived from one."""
        return self.step.exact

    @cached_property
    def coordinates(self) -> Mapping[Symbol, str]:
        """Return the coordinates on which the value may depend, with their kinds."""
        gone = {q for fact in self.facts for q in fact.eliminates}
        known = {q: kind for parent in self.parents for q, kind in parent.coordinates.items() if q not in gone}
        return {**dict(self.step.coordinates), **known}

    @property
    def named_values(self) -> list[tuple[Any, Any]]:
        """Return each scalar symbol that the step introduces, with its value: none, one, or several such as r_0 and
        theta_0."""
        if isinstance(self.symbol, MatrixBase) and isinstance(self.value, MatrixBase):
            return list(zip(self.symbol, self.value, strict=True))
        return [(self.symbol, self.value)] if isinstance(self.symbol, Symbol) else []

    def fact(self, kind: type[F]) -> F | None:
        """Return the fact of this kind that the quantity carries, or None."""
        return next((fact for fact in self.facts if isinstance(fact, kind)), None)

    def needed(self, kind: type[F]) -> F:
        """Return the fact of this kind that the quantity carries; reject a quantity without such a fact."""
        found = self.fact(kind)
        if found is None:
            raise Rejected(Complaint("wrong-argument", f"`{self.key}` {kind.missing}"))
        return found

    def parent(self, role: str) -> Quantity:
        """Return the quantity that the step of this quantity took in a role, such as the `force` of a lost contact."""
        wanted = dict(self.step.roles)[role]
        return next(each for each in self.parents if name_or_key(each) == wanted)

    def ancestors(self) -> Iterator[Quantity]:
        """Yield the quantity itself, then every quantity on which it depends."""
        seen: set[int] = set()
        waiting = [self]
        while waiting:
            quantity = waiting.pop()
            if id(quantity) not in seen:
                seen.add(id(quantity))
                yield quantity
                waiting += quantity.parents

    def rests_on(self, other: Quantity) -> bool:
        return any(ancestor.step == other.step for ancestor in self.ancestors())

    def __repr__(self) -> str:
        return f"Quantity({self.key}: {self.symbol} = {self.value})"

    def _no_arithmetic(self, *_: Any) -> NoReturn:
        raise Unverified(
            Complaint(
                "plain-arithmetic",
                f"arithmetic on `{self.key}` would lose the steps behind it",
                help=f'write it as a step: let("name", lambda x: ..., {self.key})',
            )
        )

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = _no_arithmetic
    __truediv__ = __rtruediv__ = __pow__ = __rpow__ = __neg__ = __matmul__ = _no_arithmetic


def name_or_key(quantity: Quantity) -> Any:
    """Return the symbol of a quantity, or its key if it has no symbol."""
    return Str(quantity.key) if quantity.symbol is None else quantity.symbol


def lettered(quantity: Quantity) -> Quantity:
    """Return the quantity with its symbol as its value: results contain the symbol until values are substituted."""
    return replace(quantity, value=quantity.symbol, parents=(quantity,))


Law = Callable[..., Any]


Route = Callable[[Any], tuple[Any, Any] | Verdict]


def compared_with(other: Callable[[], Any]) -> Route:
    """Return a second route that compares the result with the value of another derivation."""
    found: list[Any] = []

    def both(result: Any) -> tuple[Any, Any]:
        if not found:
            found.append(other())
        return result, found[0]

    return both


def same_value(one: Any, other: Any) -> bool:
    """Whether two values, or tuples of values, are equal."""
    try:
        if isinstance(one, tuple) and isinstance(other, tuple):
            return len(one) == len(other) and all(same_value(a, b) for a, b in zip(one, other, strict=True))
        if isinstance(one, Basic | MatrixBase) and isinstance(other, Basic | MatrixBase):
            return is_zero(one - other)
    except (TypeError, ShapeError):
        return False
    return False


def require_kind(verb: str, role: str, quantity: Any, kind: str) -> None:
    """Reject an argument that is not a quantity of this kind, such as a tensor in place of a vector."""
    if isinstance(quantity, Quantity) and quantity.step.kind == kind:
        return
    got = (
        f"`{quantity.key}` is {kind_with_article(quantity.step.kind or 'number')}"
        if isinstance(quantity, Quantity)
        else f"it is {type(quantity).__name__}"
    )
    wanted = kind_with_article(kind)
    raise Rejected(Complaint("wrong-argument", f"`{verb}` needs {wanted} as its `{role}`, but {got}"))


def value_behind(given: Any) -> Any:
    """Return the value of a quantity; return any other argument unchanged."""
    return given.value if isinstance(given, Quantity) else given


def approximations_among(*given: Any) -> list[Quantity]:
    """Return those arguments of a verb that are approximate quantities."""
    return [each for each in given if isinstance(each, Quantity) and not each.exact]


def entry_name(name: str, i: int, j: int) -> Symbol:
    """Return the symbol of an entry of a tensor, such as J_xy."""
    return Symbol(f"{name}_{AXES[i]}{AXES[j]}", real=True)


def is_zero(value: Any) -> bool:
    value = explicit(value)
    if isinstance(value, Relation):
        return False
    entries: list[Expr] = list(value) if hasattr(value, "shape") else [value]
    return all(vanishes(entry) for entry in entries)
