"""The verbs of mechanics and of numbers by name, for what is derived from a set of verbs."""

from __future__ import annotations

import importlib
from types import SimpleNamespace


def verbs_as_imported() -> SimpleNamespace:
    modules = [importlib.import_module(name) for name in ("derive.mechanics", "derive.steps.numeric")]
    return SimpleNamespace(**{name: v for module in modules for name, v in vars(module).items() if name[0] != "_"})
