"""The modules that a script imports from its own folder. They can be imported only while the script is imported or
runs."""

from __future__ import annotations

import ast
import sys
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from importlib import invalidate_caches
from pathlib import Path


def own_modules(script: Path) -> tuple[Path, ...]:
    """Return the files of the modules in the script's folder that the script imports, directly or through other
    modules."""
    found: set[Path] = set()
    waiting = [script]
    while waiting:
        named = _imported(waiting.pop())
        files = {file for name in named for file in _files_of(script.parent, name)} - found - {script}
        found |= files
        waiting += files
    return tuple(sorted(found))


@contextmanager
def importable(script: Path, modules: Collection[Path]) -> Iterator[None]:
    """Make the modules importable within a `with` block. The script's folder is last on the module search path, so that
    no module of a problem hides an installed package."""
    if not modules:
        yield
        return
    before, wrote, folder = {*sys.modules}, sys.dont_write_bytecode, str(script.parent)
    files = {str(file) for file in modules}
    invalidate_caches()
    sys.dont_write_bytecode = True
    sys.path.append(folder)
    try:
        yield
    finally:
        sys.dont_write_bytecode = wrote
        sys.path.remove(folder)
        for name in {*sys.modules} - before:
            if getattr(sys.modules[name], "__file__", None) in files:
                del sys.modules[name]


def _imported(file: Path) -> set[str]:
    """Return the names of the top-level modules and packages that a file imports."""
    try:
        nodes = [*ast.walk(ast.parse(file.read_bytes()))]
    except (OSError, SyntaxError, ValueError, RecursionError, MemoryError):
        return set()
    whole = [alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names]
    parts = [node.module for node in nodes if isinstance(node, ast.ImportFrom) and node.module and not node.level]
    return {name.partition(".")[0] for name in (*whole, *parts)}


def _files_of(folder: Path, name: str) -> Iterator[Path]:
    module = folder / f"{name}.py"
    if module.is_file():
        yield module
    yield from (file for file in (folder / name).rglob("*.py") if file.is_file())
