"""The subject of a value: the body, mass, point, axes, axis, rotation and position in space to which the value belongs.

A moment of inertia belongs to one body and one point; an angular momentum belongs to one rotation. Every quantity
carries its subject, and `establish` unites the subjects of the inputs. Different bodies, points or rotations in one law
are rejected, unless the law allows them.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, fields
from enum import Enum
from typing import Any

from sympy import Basic, MatrixSymbol, Symbol

from derive.errors import Complaint, Rejected


class Mixed(Enum):
    """The value of a property in which united subjects differ. This value counts as different from every value, also
    from itself. The only exception is two quantities that belong to the whole of one system."""

    SEVERAL = "several"


@dataclass(frozen=True)
class Subject:
    """The known properties of the subject of a value; `None` for a property that is not specified.

    body      the body, as a script made it
    mass      the mass that the value belongs to, in kg; it may be specified without a body
    point     the reference point of moments, momenta and torques
    axes      the axes of the components: by default those of the body
    axis      for a moment of inertia or a radius of gyration: the body axis that is parallel to the reference axis
    rotation  the components of the angular velocity
    place     the components of the position of the centre of mass in space, in m
    """

    body: Any = None
    mass: Any = None
    point: Any = None
    axes: Any = None
    axis: Any = None
    rotation: Any = None
    place: Any = None

    def with_more(self, other: Subject) -> Subject:
        """Return this subject with the known properties of the other subject in place of its own."""
        both = zip(self._all, other._all, strict=True)
        return Subject(*(theirs if theirs is not None else ours for ours, theirs in both))

    @property
    def _all(self) -> tuple[Any, ...]:
        return tuple(getattr(self, each.name) for each in fields(self))


NOTHING = Subject()
EVERYTHING = frozenset(each.name for each in fields(Subject))

_TOGETHER = {
    "body": "must belong to one body",
    "mass": "must belong to one mass",
    "point": "must be about one point",
    "axes": "must have components along the same axes",
    "rotation": "must belong to one rotation",
    "place": "must belong to one motion of the centre of mass",
}


def united(
    key: str, named: Sequence[tuple[str, Subject]], differ: Collection[str], same: Callable[[Any, Any], bool]
) -> Subject:
    """Return the common subject of the inputs of one law.

    key     the key of the step, for the message
    named   the key of each input, and its subject
    differ  the properties in which the inputs may differ, in addition to `axis`
    same    the function that decides whether two values are equal

    Errors: two inputs have different subjects.
    """
    found: dict[str, Any] = {}
    for field in (each.name for each in fields(Subject)):
        first: tuple[str, Any, Any] | None = None
        for name, subject in named:
            value = getattr(subject, field)
            if value is None:
                continue
            if first is None:
                first = name, value, subject.body
            elif value is first[1] is Mixed.SEVERAL and first[2] is subject.body is not None:
                continue  # both belong to the whole of one system
            elif not _agree(first[1], value, same):
                if field not in differ and field != "axis":  # moments of one body may have different axes
                    raise _apart(key, field, first[:2], (name, value))
                first = name, Mixed.SEVERAL, subject.body
        if first is not None:
            found[field] = first[1]
    return Subject(**found)


def _agree(one: Any, other: Any, same: Callable[[Any, Any], bool]) -> bool:
    if isinstance(one, Mixed) or isinstance(other, Mixed):
        return False
    if getattr(one, "called", "") != getattr(other, "called", ""):
        return False  # two bodies of the same shape are still two bodies
    return bool(one is other or one == other or same(one, other))


def with_name(called: str, key: str, symbol: Any) -> tuple[str, Any]:
    """Return the key and the symbol of a result with the name of a body, such as `upper_rod_density` and rho_upper."""
    prefix = called.replace(" ", "_")
    if not key.startswith(f"{prefix}_"):
        key = f"{prefix}_{key}"
    index = f"_{prefix.partition('_')[0]}"
    if isinstance(symbol, Symbol) and not symbol.name.endswith(index):
        symbol = Symbol(symbol.name + index, **symbol.assumptions0)
    elif isinstance(symbol, MatrixSymbol) and not symbol.name.endswith(index):
        symbol = MatrixSymbol(symbol.name + index, *symbol.shape)
    return key, symbol


def _apart(key: str, field: str, one: tuple[str, Any], other: tuple[str, Any]) -> Rejected:
    message = f"`{key}`: `{one[0]}` and `{other[0]}` {_TOGETHER[field]}"
    told = [called(value) for _, value in (one, other)]
    if told[0] != told[1] and all(told):
        message += f", but the first has {told[0]} and the second has {told[1]}"
    return Rejected(Complaint("different-subjects", message))


def called(value: Any) -> str:
    """Return the name by which a message calls a property.

    The result is an empty text for a long expression, and for a value without a name that is neither an expression nor
    text."""
    if isinstance(value, Mixed):
        return "several"
    name = getattr(value, "called", "") or getattr(value, "name", None)
    if isinstance(name, str) and not isinstance(value, Basic):
        article = "" if name.startswith(("a ", "an ")) else "the "
        return f"{article}{name.replace('_', ' ')}"
    if isinstance(value, str):
        return value
    text = str(value) if getattr(value, "free_symbols", None) is not None else ""
    return text if len(text) <= 60 else ""
