"""One mutant after another on what uses it, each in a process of its own that is forked just before it is needed.

A run is read and solved once to see which lines it uses and when each function is first called. It is then read and
solved again, and before the step in which a changed function is called for the first time, a child is forked: it takes
over the changed code, goes on to the end of the run, and reports. Both times begin without anything that the engine
remembers, so no function is skipped because an earlier solution has called it. Only what equality decides is
remembered, with the ranges of the letters, as equality is not changed.
"""

from __future__ import annotations

import ast
import contextlib
import difflib
import functools
import hashlib
import os
import pickle
import resource
import signal
import sys
import types
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from importlib import import_module
from typing import Any

import derive.algebra.equality
import derive.algebra.expressions
import derive.algebra.normal_form
import derive.algebra.tidy
import derive.mechanics
import derive.steps.record
from derive.algebra.ranges import known_ranges, taken_as_positive
from derive.errors import Rejected, Unverified
from derive.steps.step import Step
from tests.mutation.mutants import MODULES, SOURCES, Mutant, mutants_of, path_of
from tests.mutation.runs import RUNS, Run, Solved

LIMIT = 20  # seconds of processor time that a mutant may take beyond its run


class Verdict(StrEnum):
    REFUSED = "refused"  # a complaint of ours
    CRASHED = "crashed"  # another exception
    TIME = "time"
    IDENTICAL = "identical"  # the same steps
    UNSEEN = "unseen"  # steps that differ in what no page shows
    SURVIVED = "survived"  # another page
    UNUSED = "unused"  # no run comes there


ENDS = {Verdict.REFUSED, Verdict.CRASHED, Verdict.TIME, Verdict.SURVIVED}  # after these no other run is tried


@dataclass(frozen=True)
class Tried:
    """A mutant on one run: what became of it, the message or the lines of the page that differ, and in what.

    nature   of a survivor: "result", "words", "steps"; or "form": the same written otherwise, each line checked
    """

    id: str
    module: str
    run: str
    verdict: Verdict
    told: str = ""
    nature: str = ""


def remember(module: types.ModuleType, name: str) -> None:
    original = getattr(module, name)
    found: dict[Any, Any] = {}

    @functools.wraps(original)
    def kept(*args: Any, **named: Any) -> Any:
        try:
            plain = tuple(tuple(a) if isinstance(a, list) else a for a in args)
            key = (plain, tuple(named.items()), tuple(known_ranges().items()), taken_as_positive())
            hash(key)
        except TypeError:
            return original(*args, **named)
        if key not in found:
            found[key] = original(*args, **named)
        return found[key]

    for other in list(sys.modules.values()):
        if getattr(other, "__name__", "").startswith("derive") and getattr(other, name, None) is original:
            setattr(other, name, kept)


@dataclass
class Recording:
    """A run as the code is: its solution, the spots that it comes to, and when each function is first called."""

    run: Run
    solved: Solved
    page: str
    spots: dict[str, set[tuple[int, int]]]
    first: dict[tuple[str, str], int]


class _Marked(ast.NodeTransformer):
    def __init__(self, module: str, tree: ast.Module):
        self.module, self.tree = module, tree

    def functions(self) -> ast.Module:
        for holder in [self.tree, *(node for node in self.tree.body if isinstance(node, ast.ClassDef))]:
            for node in holder.body:
                if isinstance(node, ast.FunctionDef):
                    where = f"{holder.name}.{node.name}" if isinstance(holder, ast.ClassDef) else node.name
                    node.body = [self._mark(node, where), *self._marked(node.body)]
        return ast.fix_missing_locations(self.tree)

    def _marked(self, body: list[ast.stmt]) -> list[Any]:
        return [each for statement in body for each in (self._mark(statement), self.visit(statement))]

    def _mark(self, node: Any, where: str = "") -> ast.Expr:
        return ast.Expr(self._call(node, where))

    def _call(self, node: Any, where: str) -> ast.Call:
        told = [ast.Constant(each) for each in (self.module, where, node.lineno, node.col_offset)]
        return ast.Call(ast.Name("_come_to", ast.Load()), told, [])

    def generic_visit(self, node: ast.AST) -> ast.AST:
        for name, value in ast.iter_fields(node):
            if isinstance(value, list) and value and isinstance(value[0], ast.stmt):
                setattr(node, name, self._marked(value))
            elif isinstance(value, list):
                setattr(node, name, [self.visit(each) if isinstance(each, ast.AST) else each for each in value])
            elif isinstance(value, ast.AST):
                setattr(node, name, self.visit(value))
        return node

    def visit_Lambda(self, node: ast.Lambda) -> ast.AST:
        self.generic_visit(node)
        both = ast.Tuple([self._call(node, ""), node.body], ast.Load())
        node.body = ast.Subscript(both, ast.Constant(1), ast.Load())
        return node


@functools.cache
def _watching(module: str) -> dict[str, types.CodeType]:
    return _codes_of(module, _Marked(module, ast.parse(SOURCES[module])).functions())


@contextlib.contextmanager
def _watched(modules: Sequence[str], come_to: Callable[[str, str, int, int], None]) -> Iterator[None]:
    kept = []
    for name in modules:
        module = import_module(f"derive.{name}")
        vars(module)["_come_to"] = come_to
        for where, code in _watching(name).items():
            function = _function(module, where)
            if isinstance(function, types.FunctionType):
                kept.append((function, function.__code__))
                function.__code__ = code
    try:
        yield
    finally:
        for function, code in kept:
            function.__code__ = code


def recording(run: Run, modules: Sequence[str] = MODULES) -> Recording:
    spots: dict[str, set[tuple[int, int]]] = {module: set() for module in modules}
    first: dict[tuple[str, str], int] = {}
    count = 0

    def counted(_: Any) -> None:
        nonlocal count
        count += 1

    def come_to(module: str, where: str, line: int, column: int) -> None:
        spots[module].add((line, column))
        if where:
            first.setdefault((module, where), count)

    with each_step(counted), _watched(modules, come_to):
        solved = run.solved()
    return Recording(run, solved, solved.page, spots, first)


@contextlib.contextmanager
def each_step(then: Callable[[Any], None]) -> Iterator[None]:
    class Watched(list[Any]):
        def append(self, quantity: Any) -> None:
            super().append(quantity)
            then(quantity)

    made = derive.steps.record.Run
    derive.steps.record.Run = lambda **fields: made(Watched(), **fields)  # type: ignore[misc, assignment]
    try:
        yield
    finally:
        derive.steps.record.Run = made  # type: ignore[misc]


def uses(recorded: Recording, mutant: Mutant) -> bool:
    """Whether a run comes to what is changed; tables and constants are taken to be used."""
    return not mutant.in_function or mutant.spot in recorded.spots[mutant.module]


# --- one run with several mutants -------------------------------------------------------------------------------------


def tried_on(recorded: Recording, mutants: Sequence[Mutant], trees: dict[str, Any]) -> Iterator[Tried]:
    waiting: dict[int, list[Mutant]] = {}
    for mutant in mutants:
        waiting.setdefault(_first_use(recorded, mutant), []).append(mutant)
    reading, writing = os.pipe()
    runner = os.fork()
    if runner == 0:
        os.close(reading)
        with contextlib.suppress(BaseException):
            _run_with(recorded, waiting, trees, writing)
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading, "rb") as pipe:
        while True:
            try:
                yield pickle.load(pipe)
            except EOFError:
                break
    os.waitpid(runner, 0)


def _first_use(recorded: Recording, mutant: Mutant) -> int:
    return recorded.first.get((mutant.module, mutant.where), 0)


def _run_with(recorded: Recording, waiting: dict[int, list[Mutant]], trees: dict[str, Any], pipe: int) -> None:
    count = 0
    changed: list[Mutant] = []

    def fork_those_of(number: int) -> None:
        for mutant in waiting.get(number, ()):
            if changed:
                return
            child = os.fork()
            if child == 0:
                changed.append(mutant)
                _limit_time()
                take_over(mutant, trees[mutant.module])
                return
            _, status = os.waitpid(child, 0)
            if status != 0:
                verdict = Verdict.TIME if os.WIFSIGNALED(status) and _is_time(os.WTERMSIG(status)) else Verdict.CRASHED
                _report(pipe, Tried(mutant.id, mutant.module, recorded.run.name, verdict, f"status {status}"))

    def after_step(_: Any) -> None:
        nonlocal count
        if not changed:
            count += 1
            fork_those_of(count)

    verdict, told, nature = Verdict.IDENTICAL, "", ""
    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 1)
    os.dup2(silent, 2)
    try:
        fork_those_of(0)
        with each_step(after_step):
            solved = recorded.run.solved()
        if changed and solved.steps != recorded.solved.steps:
            page = solved.page
            verdict = Verdict.UNSEEN if page == recorded.page else Verdict.SURVIVED
            told = "\n".join(_differing(recorded.page, page))
            nature = _nature(recorded.solved, solved)
    except (Rejected, Unverified) as refusal:
        told = refusal.complaints[0].message
        verdict = Verdict.CRASHED if told.startswith("the script failed") else Verdict.REFUSED
    except BaseException as crash:
        verdict, told = Verdict.CRASHED, f"{type(crash).__name__}: {crash}"[:200]
    if changed:
        _report(pipe, Tried(changed[0].id, changed[0].module, recorded.run.name, verdict, told, nature))
    os._exit(0)


def _is_time(signum: int) -> bool:
    return signum in {signal.SIGXCPU, signal.SIGKILL, signal.SIGALRM}


def _limit_time() -> None:
    used = resource.getrusage(resource.RUSAGE_SELF)
    spent = int(used.ru_utime + used.ru_stime)
    resource.setrlimit(resource.RLIMIT_CPU, (spent + LIMIT, spent + LIMIT + 5))
    resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))
    sys.setrecursionlimit(2000)


def _report(pipe: int, tried: Tried) -> None:
    os.write(pipe, pickle.dumps(tried))


def _nature(before: Solved, after: Solved) -> str:
    pairs = []
    for one, other in ((before.by_key, after.by_key), (before.values, after.values)):
        if one.keys() != other.keys():
            return "steps"
        pairs += [(step, other[key]) for key, step in one.items()]
    if any(not _says_the_same(one.result, other.result) for one, other in pairs):
        return "result"
    return "words" if any(_spoken(one) != _spoken(other) for one, other in pairs) else "form"


def _says_the_same(one: Any, other: Any) -> bool:
    return bool(one == other or derive.algebra.equality.equal(one, other))


def _spoken(step: Step) -> tuple[Any, ...]:
    return step.symbol, step.rule, step.outcome, step.words, step.roles, step.kind, step.coordinates


def _differing(one: str, other: str) -> list[str]:
    found = difflib.unified_diff(one.splitlines(), other.splitlines(), lineterm="", n=0)
    return [line for line in found if not line.startswith(("---", "+++", "@@"))][:12]


# --- the changed code in place of the code ----------------------------------------------------------------------------


def take_over(mutant: Mutant, tree: Any) -> None:
    mutant.make()
    module = import_module(f"derive.{mutant.module}")
    ast.fix_missing_locations(tree)
    if isinstance(mutant.top, ast.Assign | ast.AnnAssign):
        _assign(module, mutant.top)
        return
    codes = _codes_of(mutant.module, tree)
    class_attribute = mutant.where not in codes
    if class_attribute:
        _assign_in_class(module, mutant)
    else:
        function = _function(module, mutant.where)
        function.__code__ = codes[mutant.where]
    for value in vars(module).values():
        if hasattr(value, "cache_clear"):
            value.cache_clear()


def _codes_of(module: str, tree: Any) -> dict[str, types.CodeType]:
    compiled = compile(tree, str(path_of(module)), "exec")
    made = {code.co_qualname: code for code in _codes(compiled)}
    return {name: code for name, code in made.items() if not name.endswith(">") and code.co_flags & 1}


def _codes(code: types.CodeType) -> Iterator[types.CodeType]:
    for each in code.co_consts:
        if isinstance(each, types.CodeType) and "<locals>" not in each.co_qualname:
            yield each
            yield from _codes(each)


def _function(module: types.ModuleType, where: str) -> Any:
    holder: Any = module
    for name in where.split("."):
        holder = vars(holder)[name]
    for wrapped in ("fget", "func", "__func__"):
        holder = getattr(holder, wrapped, holder) if not isinstance(holder, types.FunctionType) else holder
    return getattr(holder, "__wrapped__", holder)


def _assign(module: types.ModuleType, statement: Any) -> None:
    """A table or a constant at the top of a module, for all that have it."""
    target = statement.targets[0] if isinstance(statement, ast.Assign) else statement.target
    old = vars(module)[target.id]
    code = compile(ast.Module([statement], []), str(module.__file__), "exec")
    exec(code, vars(module))  # noqa: S102  our own source, changed in one place
    new = vars(module)[target.id]
    for other in list(sys.modules.values()):
        if getattr(other, "__name__", "").startswith("derive") and vars(other).get(target.id) is old:
            setattr(other, target.id, new)


def _assign_in_class(module: types.ModuleType, mutant: Mutant) -> None:
    owner, _, name = mutant.where.partition(".")
    found = next(
        s.value
        for s in mutant.top.body  # type: ignore[attr-defined]
        if isinstance(s, ast.AnnAssign | ast.Assign)
        and s.value is not None
        and ast.unparse(s.target if isinstance(s, ast.AnnAssign) else s.targets[0]) == name
    )
    value = eval(compile(ast.Expression(found), str(module.__file__), "eval"), vars(module))  # noqa: S307
    setattr(vars(module)[owner], name, value)


def _rank(mutant: Mutant, seed: int) -> bytes:
    return hashlib.sha256(f"{seed}:{mutant.id}".encode()).digest()


# --- many ------------------------------------------------------------------------------------------------------------


@dataclass
class Trials:
    runs: Sequence[str]
    modules: Sequence[str] = MODULES
    recordings: list[Recording] = field(default_factory=list)

    @functools.cached_property
    def _made(self) -> dict[str, tuple[ast.Module, list[Mutant]]]:
        return {module: mutants_of(module) for module in self.modules}

    @property
    def trees(self) -> dict[str, ast.Module]:
        return {module: tree for module, (tree, _) in self._made.items()}

    @property
    def mutants(self) -> list[Mutant]:
        return [mutant for _, found in self._made.values() for mutant in found]

    def prepare(self, note: Callable[[str], None] = lambda _: None) -> None:
        for module, name in (
            (derive.algebra.equality, "equal"),
            (derive.algebra.tidy, "tidied"),
            (derive.algebra.normal_form, "vanishes"),
            (derive.algebra.expressions, "explicit"),
        ):
            remember(module, name)
        for name in self.runs:
            note(f"solving {name}")
            self.recordings.append(recording(RUNS[name], self.modules))
        self.recordings.sort(key=lambda each: len(each.solved.derivation.steps))  # a short run is tried first

    def changed(self) -> set[str]:
        of_laws = {"sign", "number", "dropped", "order", "plus/minus", "name", "index", "side", "mark"}
        return {mutant.where for mutant in self.mutants if mutant.change in of_laws}

    def used(self) -> list[Mutant]:
        return [mutant for mutant in self.mutants if any(uses(each, mutant) for each in self.recordings)]

    def sample(self, size: int | None, seed: int) -> list[Mutant]:
        """A fair draw of those that some run comes to, in the order of the text; a change of the code keeps most."""
        found = self.used()
        if size is None or size >= len(found):
            return found
        drawn = {mutant.id for mutant in sorted(found, key=lambda mutant: _rank(mutant, seed))[:size]}
        return [mutant for mutant in found if mutant.id in drawn]

    def verdicts(self, mutants: Iterable[Mutant], at_most: int = 3) -> Iterator[Tried]:
        so_far: dict[str, Tried] = {}
        left: dict[str, int] = {}
        planned: list[list[Mutant]] = [[] for _ in self.recordings]
        for mutant in mutants:
            using = [n for n, recorded in enumerate(self.recordings) if uses(recorded, mutant)][:at_most]
            left[mutant.id] = len(using)
            for n in using:
                planned[n].append(mutant)
            if not using:
                yield Tried(mutant.id, mutant.module, "", Verdict.UNUSED)
        for recorded, mine in zip(self.recordings, planned, strict=True):
            mine = [mutant for mutant in mine if left[mutant.id]]
            for tried in tried_on(recorded, mine, self.trees) if mine else ():
                left[tried.id] -= 1
                known = so_far.get(tried.id)
                if tried.verdict in ENDS:
                    left[tried.id] = 0
                if known is None or tried.verdict in ENDS or tried.verdict is Verdict.UNSEEN:
                    so_far[tried.id] = tried
                if not left[tried.id]:
                    yield so_far[tried.id]
