"""The mutants of a module: each changes one place of its syntax tree.

What is only told to a person of the course, messages and docstrings, is left alone, and so are annotations.
"""

from __future__ import annotations

import ast
import functools
import importlib
from collections import Counter
from collections.abc import Iterable, Iterator
from copy import deepcopy
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from derive.algebra.kinds import KINDS
from tests.courses import ROOT
from tests.rules import records as rules

ONLY_CHECK = {"__init__", "arguments", "landmarks", "claims", "growth", "equilibrium_search", "on_constraints"}
MODULES = (
    *sorted(
        ".".join(path.relative_to(ROOT / "derive").with_suffix("").parts)
        for path in (ROOT / "derive" / "mechanics").rglob("*.py")
        if path.stem not in ONLY_CHECK
    ),
    *sorted(f"solving.{path.stem}" for path in (ROOT / "derive" / "solving").glob("[a-z]*.py")),
    "steps.numeric",
    "steps.signs",
    "steps.chain",
    "steps.establish",
    "steps.record",
    "steps.step",
)
SUMS, PRODUCTS = {"Terms", "Add"}, {"Factors", "Mul"}
NODES = SUMS | PRODUCTS | {"Ratio", "Root", "Dot", "Cross", "Outer", "Norm", "Group", "Pow", "TimeRate", "Slope"}
TOLD = {"Complaint", "Rejected", "Unverified", "TypeError", "ValueError", "AssertionError", "require_kind"}
ORDERLESS = (
    SUMS
    | PRODUCTS
    | {"isinstance", "getattr", "establish", "Lines", "PhraseData", "Scope", "Form", "zip", "range", "dict"}
)
MARKS = {"=": ">", "!=": "=", ">": "<", "<": ">", ">=": ">", "<=": "<"}
COMPARISONS: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Lt: ast.Gt,
    ast.Gt: ast.Lt,
    ast.LtE: ast.GtE,
    ast.GtE: ast.LtE,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
}
ONE_FOR_ANOTHER = {
    "sin": "cos",
    "is_positive": "is_negative",
    "is_nonnegative": "is_nonpositive",
    "x": "y",
    "i": "j",
    "left": "right",
    "above": "below",
    "lower": "upper",
    "first": "last",
    "minimum": "maximum",
    "theta": "phi",
    "slow": "fast",
    "SLOW": "FAST",
    "symbol": "value",
}
ONE_FOR_ANOTHER |= {other: one for one, other in ONE_FOR_ANOTHER.items()}
DROPPED = {"differ", "about", "means", "case_of", "outcome_data", "motion", "nonzero", "words", "facts", "between"}


@dataclass
class Mutant:
    """One change: what is put in the place `name` (and `index`, in a list) of a node of the module's tree.

    where   the function that is changed, or the name that is assigned at the top
    spot    line and column of the innermost statement or lambda around it
    in_function   or else in a table or a constant, which is used by whatever reads it
    """

    module: str
    where: str
    change: str
    old: str
    new: str
    spot: tuple[int, int]
    top: ast.stmt = field(repr=False)
    node: ast.AST = field(repr=False)
    name: str = field(repr=False)
    index: int | None = field(repr=False)
    instead: Any = field(repr=False)
    in_function: bool = True
    count: int = 0

    @property
    def id(self) -> str:
        again = f" ({self.count + 1})" if self.count else ""
        return f"{self.module}:{self.where}: {self.change}: {_short(self.old)} -> {_short(self.new)}{again}"

    def make(self) -> None:
        """Change the tree, for good."""
        if self.index is None:
            setattr(self.node, self.name, self.instead)
        elif self.instead is None:
            del getattr(self.node, self.name)[self.index]
        else:
            getattr(self.node, self.name)[self.index] = self.instead


def path_of(module: str) -> Path:
    return ROOT / "derive" / f"{module.replace('.', '/')}.py"


SOURCES = {module: path_of(module).read_text(encoding="utf-8") for module in MODULES}  # as they are imported


def mutants_of(module: str) -> tuple[ast.Module, list[Mutant]]:
    importlib.import_module("derive.mechanics")
    tree = ast.parse(SOURCES[module])
    records = [rule for name, _, rule in rules() if name == module]
    maker = _Maker(module, tree, {rule.name: tuple(rule.outcomes) for rule in records if len(rule.outcomes) > 1})
    found = list(maker.mutants())
    counted: Counter[str] = Counter()
    for mutant in found:
        alike = mutant.id
        mutant.count = counted[alike]
        counted[alike] += 1
    return tree, found


def _short(text: str) -> str:
    text = " ".join(text.split())
    return text if len(text) <= 70 else f"{text[:33]} ... {text[-32:]}"


def _called(call: ast.Call) -> str:
    match call.func:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name
    return ast.unparse(call.func).rpartition(".")[2]


@functools.lru_cache(maxsize=1)  # as long as its mutants are asked for
def _local_names(top: ast.stmt) -> set[str]:
    names = {n.arg for n in ast.walk(top) if isinstance(n, ast.arg)}
    return names | {n.id for n in ast.walk(top) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}


class _Maker:
    def __init__(self, module: str, tree: ast.Module, outcomes: dict[str, tuple[str, ...]]):
        self.module, self.tree, self.outcomes = module, tree, outcomes
        self.top: ast.stmt = tree.body[0]
        self.where, self.in_function, self.spot = "", True, (0, 0)

    def mutants(self) -> Iterator[Mutant]:
        for statement in self.tree.body:
            self.top = statement
            if isinstance(statement, ast.ClassDef):
                for inner in statement.body:
                    yield from self._of_top(inner, f"{statement.name}.")
            else:
                yield from self._of_top(statement, "")

    def _of_top(self, statement: ast.stmt, prefix: str) -> Iterator[Mutant]:
        self.in_function = isinstance(statement, ast.FunctionDef)
        if isinstance(statement, ast.FunctionDef):
            self.where = f"{prefix}{statement.name}"
            for i, inner in enumerate(statement.body):
                yield from self._below(inner, statement, "body", i)
        elif isinstance(statement, ast.Assign | ast.AnnAssign) and statement.value is not None:
            if isinstance(statement.value, ast.Call) and _called(statement.value) == "Rule":
                return  # it only checks
            target = statement.targets[0] if isinstance(statement, ast.Assign) else statement.target
            if isinstance(target, ast.Name):
                self.where = f"{prefix}{target.id}"
                yield from self._below(statement.value, statement, "value", None)

    def _below(self, node: ast.AST, parent: ast.AST, name: str, index: int | None) -> Iterator[Mutant]:
        outer = self.spot
        if isinstance(node, ast.stmt | ast.Lambda):
            self.spot = node.lineno, node.col_offset
        yield from self._here_and_below(node, parent, name, index)
        self.spot = outer

    def _here_and_below(self, node: ast.AST, parent: ast.AST, name: str, index: int | None) -> Iterator[Mutant]:
        told = isinstance(node, ast.Raise | ast.JoinedStr | ast.Assert) or (
            isinstance(node, ast.Call) and _called(node) in TOLD
        )
        docstring = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
        if told or docstring or (isinstance(node, ast.arguments)):
            return
        for change, instead in self._instead(node, parent, name):
            yield self._mutant(node, parent, name, index, change, instead)
        yield from self._in_place(node)
        for field_name, value in ast.iter_fields(node):
            if field_name in {"annotation", "returns", "args"} and isinstance(node, ast.FunctionDef | ast.AnnAssign):
                continue
            if isinstance(value, ast.AST):
                yield from self._below(value, node, field_name, None)
            elif isinstance(value, list):
                for i, each in enumerate(value):
                    if isinstance(each, ast.AST):
                        yield from self._below(each, node, field_name, i)

    def _mutant(
        self, node: ast.AST, parent: ast.AST, name: str, index: int | None, change: str, instead: Any
    ) -> Mutant:
        old = ast.unparse(node)
        new = "" if instead is None else ast.unparse(instead)
        return Mutant(
            self.module,
            self.where,
            change,
            old,
            new,
            self.spot,
            self.top,
            parent,
            name,
            index,
            instead,
            self.in_function,
        )

    # --- what can stand in the place of a node ---

    def _instead(self, node: ast.AST, parent: ast.AST, name: str) -> Iterator[tuple[str, ast.AST]]:
        if isinstance(node, ast.BinOp):
            yield from _of_binary(node, parent)
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            yield "sign", node.operand
        elif isinstance(node, ast.Call):
            yield from _of_call(node, parent)
        elif isinstance(node, ast.Constant):
            yield from self._of_constant(node, parent, name)
        elif isinstance(node, ast.Compare) and len(node.ops) == 1:
            other = COMPARISONS[type(node.ops[0])]
            yield "comparison", ast.Compare(node.left, [other()], node.comparators)
        elif isinstance(node, ast.BoolOp):
            yield "and/or", ast.BoolOp(ast.Or() if isinstance(node.op, ast.And) else ast.And(), node.values)
        elif isinstance(node, ast.IfExp):
            yield "condition", ast.IfExp(_negated(node.test), node.body, node.orelse)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load) and node.id in ONE_FOR_ANOTHER:
            other = ONE_FOR_ANOTHER[node.id]
            if other in {"sin", "cos"} or other in _local_names(self.top):
                yield "name", ast.Name(other, ast.Load())
        elif isinstance(node, ast.Attribute) and node.attr in ONE_FOR_ANOTHER:
            yield "name", ast.Attribute(node.value, ONE_FOR_ANOTHER[node.attr], ast.Load())
        elif isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Load):
            yield from _of_subscript(node)

    def _of_constant(self, node: ast.Constant, parent: ast.AST, name: str) -> Iterator[tuple[str, ast.AST]]:
        value = node.value
        if isinstance(value, bool) or value is None:
            if isinstance(value, bool):
                yield "condition", ast.Constant(not value)
        elif isinstance(value, int):
            if isinstance(parent, ast.Subscript):
                yield "index", ast.Constant(1 if value == 0 else value - 1)
            else:
                yield "number", ast.Constant(value + 1)
        elif isinstance(value, str):
            is_mark = isinstance(parent, ast.Call) and _called(parent) == "Relation"
            if value in MARKS and (is_mark or isinstance(parent, ast.Compare | ast.Dict | ast.IfExp)):
                yield "mark", ast.Constant(MARKS[value])
                if value in {">", "<"}:
                    yield "mark", ast.Constant(f"{value}=")
            keyword = parent.arg if isinstance(parent, ast.keyword) else ""
            if keyword == "kind" and value in KINDS:
                yield "kind", ast.Constant("mass" if value != "mass" else "length")
            elif keyword != "key" and not (isinstance(parent, ast.Call) and _called(parent) in {"establish", "Form"}):
                if not (isinstance(parent, ast.Dict) and name == "keys"):
                    yield from self._other_outcomes(value)

    def _other_outcomes(self, value: str) -> Iterator[tuple[str, ast.AST]]:
        seen = set()
        for outcomes in self.outcomes.values():
            if value in outcomes:
                for other in outcomes:
                    if other != value and other not in seen:
                        seen.add(other)
                        yield "outcome", ast.Constant(other)

    # --- what is changed within a node ---

    def _in_place(self, node: ast.AST) -> Iterator[Mutant]:
        if isinstance(node, ast.If | ast.While):
            yield self._mutant(node.test, node, "test", None, "condition", _negated(node.test))
        elif isinstance(node, ast.comprehension):
            for i, test in enumerate(node.ifs):
                yield self._mutant(test, node, "ifs", i, "condition", _negated(test))
        elif isinstance(node, ast.Call):
            if _called(node) in SUMS | PRODUCTS and len(node.args) > 1:
                for i, argument in enumerate(node.args):
                    yield self._mutant(argument, node, "args", i, "dropped", None)
            if _called(node) == "establish":
                yield from self._of_establishing(node)
            if _called(node) == "PhraseData":
                yield from self._of_telling(node)
            for i, keyword in enumerate(node.keywords):
                if keyword.arg in DROPPED:
                    yield self._mutant(keyword, node, "keywords", i, "dropped", None)
        elif isinstance(node, ast.List | ast.Tuple) and isinstance(getattr(node, "ctx", None), ast.Load):
            for i, j in _neighbours(node.elts):
                swapped = [*node.elts[:i], node.elts[j], node.elts[i], *node.elts[j + 1 :]]
                whole = ast.List(swapped, ast.Load())
                yield self._mutant_of_list(node, "elts", swapped, "order", whole)

    def _mutant_of_list(self, node: Any, name: str, items: list[Any], change: str, whole: ast.AST) -> Mutant:
        made = self._mutant(node, node, name, None, change, whole)
        made.instead = items
        return made

    def _of_establishing(self, call: ast.Call) -> Iterator[Mutant]:
        tables = [call.args[3]] if len(call.args) > 3 else []
        for what in ("2 * ({})(*given)", "({})(*given[::-1])") if len(call.args) > 3 else ():
            law = ast.parse(f"lambda *given: {what.format(ast.unparse(call.args[2]))}", mode="eval").body
            if "[::-1]" not in what or not isinstance(call.args[3], ast.Dict) or len(call.args[3].keys) > 1:
                yield self._mutant(call.args[2], call, "args", 2, "law", law)
        for table in tables:
            if isinstance(table, ast.Dict):
                for i, j in _neighbours(table.keys):
                    keys = [*table.keys[:i], table.keys[j], table.keys[i], *table.keys[j + 1 :]]
                    whole = ast.Dict(keys, table.values)
                    yield self._mutant_of_list(table, "keys", keys, "role", whole)

    def _of_telling(self, call: ast.Call) -> Iterator[Mutant]:
        for keyword in call.keywords:
            if keyword.arg == "words" and isinstance(keyword.value, ast.Dict):
                for i, value in enumerate(keyword.value.values):
                    other = "corner" if ast.unparse(value) != "'corner'" else "apex"
                    yield self._mutant(value, keyword.value, "values", i, "word", ast.Constant(other))


def _neighbours(items: Iterable[Any]) -> Iterator[tuple[int, int]]:
    told = [ast.unparse(item) if isinstance(item, ast.AST) else "" for item in items]
    for i in range(len(told) - 1):
        if told[i] and told[i + 1] and told[i] != told[i + 1] and "*" not in {told[i][0], told[i + 1][0]}:
            yield i, i + 1


def _negated(test: ast.expr) -> ast.expr:
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        return test.operand
    return ast.UnaryOp(ast.Not(), deepcopy(test))


def _minus(node: ast.expr) -> ast.expr:
    return ast.UnaryOp(ast.USub(), node)


def _of_binary(node: ast.BinOp, parent: ast.AST) -> Iterator[tuple[str, ast.AST]]:
    if isinstance(node.op, ast.Add | ast.Sub):
        other = ast.Sub() if isinstance(node.op, ast.Add) else ast.Add()
        yield "plus/minus", ast.BinOp(node.left, other, node.right)
        yield "dropped", node.left
        yield "dropped", node.right if isinstance(node.op, ast.Add) else _minus(node.right)
    elif isinstance(node.op, ast.Mult | ast.Div):
        yield "dropped", node.left
        if isinstance(node.op, ast.Mult):
            yield "dropped", node.right
        if not isinstance(parent, ast.BinOp | ast.UnaryOp):
            yield "sign", _minus(node)
    elif isinstance(node.op, ast.Pow):
        yield "dropped", node.left


def _of_call(node: ast.Call, parent: ast.AST) -> Iterator[tuple[str, ast.AST]]:
    name = _called(node)
    if name in NODES and not isinstance(parent, ast.UnaryOp) and not any(isinstance(a, ast.Starred) for a in node.args):
        yield "sign", _minus(node)
    if name not in ORDERLESS:
        for i, j in _neighbours(node.args):
            if isinstance(node.args[i], ast.Constant) or isinstance(node.args[j], ast.Constant):
                continue
            args = [*node.args[:i], node.args[j], node.args[i], *node.args[j + 1 :]]
            yield "order", ast.Call(node.func, args, node.keywords)
    if name == "Relation" and len(node.args) == 3:
        args = [node.args[2], node.args[1], node.args[0]]
        if not (isinstance(node.args[1], ast.Constant) and node.args[1].value in {"=", "!="}):
            yield "sides", ast.Call(node.func, args, node.keywords)
        yield "side", ast.Call(node.func, [_minus(node.args[0]), *node.args[1:]], node.keywords)


def _of_subscript(node: ast.Subscript) -> Iterator[tuple[str, ast.AST]]:
    if isinstance(node.slice, ast.Tuple) and len(node.slice.elts) == 2:
        one, other = node.slice.elts
        if ast.unparse(one) != ast.unparse(other):
            yield "index", ast.Subscript(node.value, ast.Tuple([one, one], ast.Load()), ast.Load())
    elif isinstance(node.slice, ast.Name) and node.slice.id in {"i", "j", "k"}:
        yield "index", ast.Subscript(node.value, ast.Constant(0), ast.Load())
