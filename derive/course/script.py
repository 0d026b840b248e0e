"""The script of a problem is imported as Python, and its failures are reported at lines of the script.

A script is trusted code, but its errors must not look like errors in derive. The report of an error has no traceback;
it shows the innermost line that belongs to the script.
"""

from __future__ import annotations

import ast
import inspect
import re
import sys
import traceback
import warnings
from collections.abc import Callable, Mapping
from contextlib import redirect_stdout
from dataclasses import dataclass, replace
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

from derive.algebra.kinds import ANNOTATIONS, Asked, asked_by_annotation
from derive.course.own_modules import importable, own_modules
from derive.course.yaml_tree import Source, abridged, read_source
from derive.errors import Complaint, DeriveError, Faults, OutOfTime, Place, Rejected, did_you_mean, nearest


@dataclass(frozen=True)
class Parameter:
    """One parameter of `solve()`: the required kind of its value, and its place in the script."""

    name: str
    kind: Asked
    place: Place
    required: bool

    @property
    def note(self) -> str:
        return f"`solve()` asks for it at {self.place.path}:{self.place.line}"


@dataclass(frozen=True)
class Script:
    """An imported script, the signature of its `solve()`, and the modules of its folder that it imports."""

    file: Path
    source: Source
    solve: Callable[..., object]
    parameters: tuple[Parameter, ...]
    returns: Place
    modules: tuple[Path, ...] = ()


class _NoCache(SourceFileLoader):
    """A loader without cached bytecode, so that a script is compiled from its current text."""

    def path_stats(self, path: Any) -> Mapping[str, Any]:
        raise OSError


def imported_script(file: Path, shown_as: str, name: str) -> Script:
    """Return the script with its `solve()` and the parameters of `solve()`, or raise `Rejected` with the script's
    line."""
    source = read_source(file, shown_as)
    definition = _definition(source)
    modules = own_modules(file)
    with importable(file, modules):
        module = _module(file, source, name)
    solve = getattr(module, "solve", None)
    if not callable(solve):
        raise Rejected(Complaint("script", "`solve` is not a function", source.at(definition.lineno)))
    returns = [node for node in ast.walk(definition) if isinstance(node, ast.Return)]
    place = source.at(*_start(returns[-1] if returns else definition), 6 if returns else 3)
    return Script(file, source, solve, _parameters(definition, solve, source), place, modules)


def run(script: Script, values: Mapping[str, Any]) -> object:
    """Return what `solve()` returns; text that the script prints goes to standard error."""
    try:
        with redirect_stdout(sys.stderr), importable(script.file, script.modules):
            return script.solve(**values)
    except DeriveError as error:
        raise _placed(error, script.file, script.source) from error
    except (MemoryError, OutOfTime):
        raise  # a limit is reached; no line of the script is wrong
    except BaseException as error:
        raise Rejected(_failure(error, script.file, script.source)) from error


def _placed(error: DeriveError, file: Path, source: Source) -> DeriveError:
    """Add to the error of a verb the line of the script that calls the verb."""
    place = _innermost(error, file, source)
    if place is None:
        return error
    note = f"the script calls the verb at {place.path}:{place.line}"
    return type(error)(
        replace(c, notes=(*c.notes, note)) if c.place else replace(c, place=place) for c in error.complaints
    )


def _definition(source: Source) -> ast.FunctionDef:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(source.text)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise Rejected(_syntax(error, source)) from None
    functions = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    if "solve" not in functions:
        close = nearest("solve", functions)
        help_line = f"rename `{close}`" if close else "write `def solve(...)`"
        place = source.at(*_start(functions[close])) if close else source.at(1)
        raise Rejected(Complaint("script", "the script has no function `solve`", place, help=help_line))
    return functions["solve"]


def _syntax(error: Exception, source: Source) -> Complaint:
    line, offset = getattr(error, "lineno", None) or 1, getattr(error, "offset", None) or 1
    message = getattr(error, "msg", None) or str(error) or type(error).__name__
    return Complaint("script", f"the script is not Python: {message}", source.at(line, offset))


def _module(file: Path, source: Source, name: str) -> ModuleType:
    spec = spec_from_file_location(name, file, loader=_NoCache(name, str(file)))
    if spec is None or spec.loader is None:
        raise Rejected(Complaint("script", "the script cannot be imported", source.at(1)))
    module = module_from_spec(spec)
    sys.modules[name] = module  # dataclasses and pickle look a module up by its name
    try:
        with redirect_stdout(sys.stderr), warnings.catch_warnings():
            warnings.simplefilter("ignore", SyntaxWarning)
            warnings.simplefilter("ignore", DeprecationWarning)
            spec.loader.exec_module(module)
    except DeriveError as error:
        raise _placed(error, file, source) from error
    except (MemoryError, OutOfTime):
        raise
    except BaseException as error:
        raise Rejected(_failure(error, file, source)) from error
    return module


def _parameters(definition: ast.FunctionDef, solve: Callable[..., object], source: Source) -> tuple[Parameter, ...]:
    faults = Faults()
    written = {arg.arg: arg for arg in ast.walk(definition.args) if isinstance(arg, ast.arg)}
    found = []
    for name, parameter in inspect.signature(solve).parameters.items():
        arg = written.get(name)
        place = source.at(*_start(arg or definition), len(name))
        kind = asked_by_annotation(parameter.annotation)
        if parameter.kind not in (parameter.POSITIONAL_OR_KEYWORD, parameter.KEYWORD_ONLY):
            faults.error("script", f"`{name}` cannot be given by name, so `solve()` cannot ask for it", place)
        elif kind is None:
            annotation = ast.unparse(arg.annotation) if arg and arg.annotation else None
            message = (
                f"the annotation `{annotation}` of `{name}` is not a kind" if annotation else f"`{name}` has no kind"
            )
            close = (
                did_you_mean((annotation or "").strip("'\""), ANNOTATIONS) or f"the kinds are {', '.join(ANNOTATIONS)}"
            )
            faults.error("script", f"{message}, so `given:` cannot give it a value", place, help=close)
        else:
            found.append(Parameter(name, kind, place, parameter.default is parameter.empty))
    faults.stop()
    return tuple(found)


def _start(node: ast.expr | ast.stmt | ast.arg) -> tuple[int, int]:
    return node.lineno, node.col_offset + 1


def _innermost(error: BaseException, file: Path, source: Source) -> Place | None:
    """Return the last line of the script that ran before the error; None if no line of the script ran."""
    frames = [frame for frame in traceback.extract_tb(error.__traceback__) if frame.filename == str(file)]
    if not frames:
        return None
    frame = frames[-1]
    line, first, last = frame.lineno or 1, frame.colno or 0, frame.end_colno or 0
    encoded = source.at(line).text.encode()
    column = len(encoded[:first].decode(errors="ignore")) + 1
    width = last - first if frame.end_lineno == line else len(encoded)
    return source.at(line, column, width)


def _failure(error: BaseException, file: Path, source: Source) -> Complaint:
    if isinstance(error, SystemExit):
        said = "it called exit"
    else:
        detail = abridged(_message(error), 200)
        said = type(error).__name__ + (f": {detail}" if detail else "")
    place = _innermost(error, file, source) or source.at(1)
    return Complaint("script", f"the script failed: {said}", place, help=_meant(error))


def _message(error: BaseException) -> str:
    try:
        return str(error)
    except Exception:  # `__str__` of an exception of the script may fail
        return "an exception that has no message"


def _meant(error: BaseException) -> str | None:
    if isinstance(error, ImportError):
        wanted = re.search(r"cannot import name '(\w+)'", str(error))
        return did_you_mean(wanted[1], dir(sys.modules.get(error.name or ""))) if wanted else None
    name = getattr(error, "name", None)
    if isinstance(error, AttributeError) and name:
        return did_you_mean(name, (n for n in dir(error.obj) if not n.startswith("_")))
    if isinstance(error, NameError) and name and error.__traceback__:
        trace = error.__traceback__
        while trace.tb_next:
            trace = trace.tb_next
        frame = trace.tb_frame
        known = ANNOTATIONS.keys() - frame.f_globals.keys()
        return (
            f"write `from derive.given import {name}` above"
            if name in known
            else did_you_mean(name, (*frame.f_locals, *frame.f_globals))
        )
    return None
