"""The verbs of mechanics with one piece of their source replaced: how a wrong law is seeded.

The whole package is imported afresh from the altered source, so that every module sees the wrong law, and the real one
is put back afterwards.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, SourceFileLoader
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

from sympy import Integer, Symbol, symbols

import derive

HERE = Path(derive.__file__).parent
a, M, omega = symbols("a M omega", positive=True)


def path_of(module: str) -> Path:
    return HERE / (module.replace(".", "/") + ".py")


class _Altered(SourceFileLoader):
    """Loads a file with one piece of text replaced."""

    def __init__(self, name: str, path: str, old: str, new: str):
        super().__init__(name, path)
        self.old, self.new = old, new

    def get_data(self, path: str) -> bytes:
        source = Path(path).read_text(encoding="utf-8")
        assert source.count(self.old) == 1, f"`{self.old}` occurs {source.count(self.old)} times in {Path(path).name}"
        return source.replace(self.old, self.new).encode()

    def get_code(self, fullname: str) -> Any:  # never from the cache of compiled files, nor into it
        return self.source_to_code(self.get_data(self.path), self.path)


class _Finder(MetaPathFinder):
    def __init__(self, module: str, old: str, new: str):
        self.name, self.loader_of = f"derive.{module}", lambda name, path: _Altered(name, path, old, new)
        self.path = str(path_of(module))

    def find_spec(self, fullname: str, path: Any, target: ModuleType | None = None) -> ModuleSpec | None:
        return ModuleSpec(fullname, self.loader_of(fullname, self.path), origin=self.path) if fullname == self.name else None


@contextmanager
def altered(module: str, old: str, new: str) -> Iterator[SimpleNamespace]:
    """The verbs, freshly imported, with `old` replaced by `new` in `derive/<module>`."""
    ours = [name for name in sys.modules if name.startswith("derive.mechanics") or name == "derive.numbers"]
    kept = {name: sys.modules.pop(name) for name in ours}
    attributes = {name: getattr(derive, name) for name in ("mechanics", "numbers") if hasattr(derive, name)}
    finder = _Finder(module, old, new)
    sys.meta_path.insert(0, finder)
    try:
        verbs = {**vars(importlib.import_module("derive.mechanics")), **vars(importlib.import_module("derive.numbers"))}
        yield SimpleNamespace(**{name: value for name, value in verbs.items() if not name.startswith("__")})
    finally:
        sys.meta_path.remove(finder)
        for name in [n for n in sys.modules if n.startswith("derive.mechanics") or n == "derive.numbers"]:
            del sys.modules[name]
        sys.modules.update(kept)
        for name, value in attributes.items():
            setattr(derive, name, value)


def block_derivation(
    verbs: Any,
    sides: tuple[Any, ...] = (a, 2 * a, 3 * a),
    axis: str | tuple[Any, ...] = "diagonal",
    rate: Any = omega,
    start: str = "corner",
) -> dict[str, Any]:
    """Everything that can be derived of the block, by key; as `problems/hw9/block.py`, but pinned here."""
    block = verbs.Cuboid(sides, M)
    direction = verbs.Direction(axis) if isinstance(axis, str) else verbs.Direction(None, axis)
    if start == "corner":
        there = verbs.inertia_tensor(block, about="corner", key="corner_tensor")
        I = verbs.moved_to(there, block.centre)
    else:
        there = I = verbs.inertia_tensor(block, about="centre")
    T = verbs.kinetic_energy(I, verbs.any_angular_velocity())
    w = verbs.spin(rate, along=block.direction(direction))
    at_axis = verbs.at(T, w, key="energy_about_axis")
    L = verbs.angular_momentum(I, w)
    theta = verbs.angle_between(w, L)
    tau = verbs.torque(w, L)
    size = verbs.magnitude(tau)
    found = [block.density, there, *there.parents, I, *I.parents, T, w, at_axis, L, *theta.parents, theta, tau, size]
    found += [block.centre] if start == "corner" else []
    return {quantity.key: quantity for quantity in found}


def amounts() -> dict[Symbol, Any]:
    """Numbers with units for the letters of the block."""
    from derive.expressions import Amount

    return {
        a: Amount(Integer(2), "cm", Integer(1) / 100),
        M: Amount(Integer(3), "kg", Integer(1)),
        omega: Amount(Integer(900), "rpm", __import__("sympy").pi / 30),
    }
