"""The verbs of mechanics with one piece of their source replaced: how a wrong law is seeded.

The verbs are imported afresh from the altered source, so that each of them sees the wrong law, and the real ones are
put back afterwards.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, SourceFileLoader
from pathlib import Path
from types import CodeType, ModuleType, SimpleNamespace

import derive

HERE = Path(derive.__file__).parent


class _Altered(SourceFileLoader):
    """Loads one file with a piece of its text replaced, without reading or writing compiled files."""

    def __init__(self, name: str, path: str, old: str, new: str):
        super().__init__(name, path)
        self.old, self.new = old, new

    def get_code(self, fullname: str) -> CodeType:
        source = Path(self.path).read_text(encoding="utf-8")
        found = source.count(self.old)
        assert found == 1, f"{self.old!r} occurs {found} times in {Path(self.path).name}"
        return compile(source.replace(self.old, self.new), self.path, "exec")


class _Finder(MetaPathFinder):
    """Finds the one module that is altered; all others are found as usual."""

    def __init__(self, module: str, old: str, new: str):
        path = str(HERE / f"{module.replace('.', '/')}.py")
        self.loader = _Altered(f"derive.{module}", path, old, new)

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        return ModuleSpec(fullname, self.loader) if fullname == self.loader.name else None


@contextmanager
def altered(module: str, old: str, new: str) -> Iterator[SimpleNamespace]:
    """The verbs, freshly imported, with `old` replaced by `new` in `derive/<module>`."""
    kept = {name: sys.modules.pop(name) for name in _modules_of_verbs()}
    attributes = {name: getattr(derive, name) for name in ("mechanics", "numbers") if hasattr(derive, name)}
    finder = _Finder(module, old, new)
    sys.meta_path.insert(0, finder)
    try:
        yield verbs_as_imported()
    finally:
        sys.meta_path.remove(finder)
        for name in _modules_of_verbs():
            del sys.modules[name]
        sys.modules.update(kept)
        for name, value in attributes.items():
            setattr(derive, name, value)


def verbs_as_imported() -> SimpleNamespace:
    """The verbs of mechanics and of numbers, by name."""
    modules = [importlib.import_module(name) for name in ("derive.mechanics", "derive.numbers")]
    return SimpleNamespace(**{name: v for module in modules for name, v in vars(module).items() if name[0] != "_"})


def _modules_of_verbs() -> list[str]:
    return [name for name in sys.modules if name.startswith("derive.mechanics") or name == "derive.numbers"]
