"""Objects of derive written as data and read again: quantities, bodies, systems, and everything that they contain.

An object has a name, which is made from a digest of its content, and appears in the content of other objects by this
name. So an object that two objects share is still one object after reading, and two equal quantities remain two
objects.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Hashable, Iterable, Mapping
from enum import Enum
from functools import cache, cached_property
from hashlib import sha256
from importlib import import_module
from types import FunctionType
from typing import Any

from sympy import Basic, Dummy, MatrixBase

from derive.algebra.encoding import decoded, encoded
from derive.algebra.equality import Evidence
from derive.steps.step import Form, Quantity

PLAIN: tuple[Any, ...] = (str, bool, int, float, type(None))
GATHERED: Mapping[str, Any] = {"list": list, "set": set, "frozenset": frozenset}
VALUES = (Form, Evidence)  # there are too many of these small objects to give each a name


class NoDescription(Exception):
    """An object cannot be described as data, or data does not describe an object."""


class Objects:
    """The objects of a run and its dummy symbols, by their names."""

    def __init__(self) -> None:
        self._objects: dict[str, Any] = {}
        self._names: dict[int, str] = {}
        self._texts: dict[str, str] = {}
        self._parts: dict[str, list[str]] = {}  # name of an object -> names of the objects in it
        self._told: list[str] = []  # names of the objects in the value that is now being described
        self._expressions: dict[Any, tuple[Any, list[str]]] = {}
        self._letters: dict[Dummy, str] = {}
        self._seekers: set[str] = set()  # names of objects whose cached properties may contain steps
        self._met: list[Any] = []  # keeps these objects alive, so that no `id` is used twice

    def described(self, value: Any) -> tuple[Any, list[str]]:
        """Return the value as JSON data in which names replace the objects; also return these names. Raise
        `NoDescription` if the value cannot be described."""
        before, self._told = self._told, []
        try:
            return self._data(value), self._told
        finally:
            self._told = before

    def _data(self, value: Any) -> Any:
        kind = _class_of(value)
        if kind in PLAIN:
            return value
        if isinstance(value, Basic | MatrixBase):
            return {"expr": self._expression(value)}
        if kind is tuple:
            return [self._data(each) for each in value]
        if kind in GATHERED.values():
            found = [self._data(each) for each in value]
            return {"all": kind.__name__, "of": found if kind is list else sorted(found, key=json.dumps)}
        if kind is dict:
            return {"map": [[self._data(key), self._data(each)] for key, each in value.items()]}
        if isinstance(value, Enum):
            return {"one": _place(kind), "value": value.value}
        if isinstance(value, type | FunctionType):
            return {"code": _place(value)}
        if isinstance(value, VALUES):
            return {"is": _place(kind), "with": self._content(value)}
        name = self._name(value)
        self._told.append(name)
        return {"#": name}

    def _content(self, value: Any) -> dict[str, Any]:
        if not hasattr(value, "__dict__") or isinstance(value, str | tuple | list | dict):
            raise NoDescription(f"of {type(value).__name__}")
        lazy = _lazy(_class_of(value))
        return {key: self._data(each) for key, each in sorted(vars(value).items()) if key not in lazy}

    def _expression(self, value: Any) -> Any:
        if value not in self._expressions:
            letters: list[str] = []
            try:
                data = encoded(value, lambda letter: self._letter(letter, letters))
            except TypeError as error:
                raise NoDescription(str(error)) from None
            self._expressions[value] = data, letters
        data, letters = self._expressions[value]
        self._told += letters
        return data

    def _letter(self, letter: Dummy, told: list[str]) -> str:
        """Return a unique name for a dummy symbol."""
        known = self._letters.get(letter)
        if known is None:
            alike = sum(each.name == letter.name for each in self._letters)
            known = f"{json.dumps([letter.name, letter.assumptions0], sort_keys=True)} {alike}"
            self._letters[letter] = known
            self._objects[known], self._parts[known] = letter, []
        told.append(known)
        return known

    def _name(self, value: Any) -> str:
        known = self._names.get(id(value))
        if known is not None:
            return known
        content, parts = self._apart(value)
        kind = _class_of(value)
        text = json.dumps([_place(kind), content])
        name = plain = sha256(text.encode()).hexdigest()[:32]
        count = 0
        while name in self._objects and not _is_its_content(kind):
            count += 1
            name = f"{plain}.{count}"
        self._enter(name, value, text, parts)
        return name

    def _apart(self, value: Any) -> tuple[Any, list[str]]:
        before, self._told = self._told, []
        try:
            return self._content(value), self._told
        finally:
            self._told = before

    def _enter(self, name: str, value: Any, text: str, parts: list[str]) -> None:
        self._met.append(value)
        self._names[id(value)] = name
        self._objects.setdefault(name, value)
        self._texts[name] = text
        self._parts[name] = parts
        if _lazy(_class_of(value)):
            self._seekers.add(name)

    def below(self, names: Iterable[str]) -> dict[str, None]:
        """Return the names of these objects and dummy symbols and of all their parts, parts first."""
        found: dict[str, None] = {}
        waiting = [(name, False) for name in reversed(list(names))]
        while waiting:
            name, is_done = waiting.pop()
            if is_done:
                found[name] = None
            elif name not in found:
                waiting.append((name, True))
                waiting += [(part, False) for part in self._parts[name] if part not in found]
        return found

    def texts(self, names: Iterable[str]) -> list[tuple[str, str]]:
        """Return the names and texts of these objects, from which `enter` makes them. Raise `NoDescription` for dummy
        symbols."""
        for name in names:
            if name not in self._texts:
                raise NoDescription(f"{name} is a dummy symbol, which has no text")
        return [(name, self._texts[name]) for name in names]

    def enter(self, name: str, text: str) -> None:
        """Make the object with this name from its text, unless an object with this name is known."""
        if name in self._objects:
            return
        place, content = json.loads(text)
        value = object.__new__(_at(place))
        parts: list[str] = []
        vars(value).update({key: self.read(each, parts) for key, each in content.items()})
        self._enter(name, value, text, parts)

    def read(self, data: Any, told: list[str] | None = None) -> Any:
        """Return the value that the data describes, and add the names of the objects in it to `told`. Raise an error if
        the data does not describe a value."""
        told = [] if told is None else told
        if isinstance(data, list):
            return tuple(self.read(each, told) for each in data)
        if not isinstance(data, dict):
            return data
        if "expr" in data:
            return decoded(data["expr"], lambda name: self._known(name, told))
        if "#" in data:
            return self._known(data["#"], told)
        if "is" in data:
            return _at(data["is"])(**{key: self.read(each, told) for key, each in data["with"].items()})
        if "all" in data:
            return GATHERED[data["all"]](self.read(each, told) for each in data["of"])
        if "map" in data:
            return {self.read(key, told): self.read(each, told) for key, each in data["map"]}
        return _at(data["one"])(data["value"]) if "one" in data else _at(data["code"])

    def _known(self, name: str, told: list[str]) -> Any:
        if name not in self._objects:
            raise NoDescription(f"nothing is called {name}")
        told.append(name)
        return self._objects[name]

    def found_once(self, names: Iterable[str]) -> list[tuple[str, str, Any]]:
        """Return the cached properties of these objects that contain steps: name of the object, property, value."""
        objects = ((name, self._objects[name]) for name in names if name in self._seekers)
        return [
            (name, key, vars(each)[key])
            for name, each in objects
            for key in _lazy(_class_of(each))
            if key in vars(each) and _holds_steps(vars(each)[key])
        ]

    def put_found(self, name: str, key: str, value: Any) -> None:
        """Set a cached property of an object, unless it already has a value."""
        vars(self._objects[name]).setdefault(key, value)


def _holds_steps(value: Any) -> bool:
    return any(isinstance(each, Quantity) for each in (value.values() if isinstance(value, dict) else [value]))


def _class_of(value: Any) -> Any:
    return type(value)


def _is_its_content(kind: Any) -> bool:
    """Whether the class compares objects by their content, not by identity."""
    return kind.__eq__ is not object.__eq__


@cache
def _lazy(kind: Hashable) -> dict[str, None]:
    classes = kind.__mro__ if isinstance(kind, type) else ()
    return {n: None for each in classes for n, v in vars(each).items() if isinstance(v, cached_property)}


@cache
def _place(code: Any) -> str:
    """Return the module and name of a class or a function of derive."""
    place = f"{code.__module__}:{getattr(code, '__qualname__', '')}"
    if _at(place) is not code:
        raise NoDescription(f"of {place}")
    return place


@cache
def _at(place: str) -> Any:
    """Return the class or function of derive with this module and name."""
    module, _, name = place.partition(":")
    if module.partition(".")[0] != "derive":
        raise NoDescription(f"of {place}")
    found: Any = sys.modules.get(module) or import_module(module)
    for part in name.split("."):
        found = getattr(found, part, None)
    return found
