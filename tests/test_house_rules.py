"""The rules of the house: where a module stands, what it may import, and what every verb must say of itself."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import derive.mechanics
import derive.numbers
from derive.step import Quantity
from tests.course import ROOT
from tests.mechanics.block import a, known_block
from tests.test_wording import VARIANTS, WORDS

SOURCE = ROOT / "derive"
MODULES = {
    ".".join(path.relative_to(SOURCE).with_suffix("").parts): path
    for path in sorted(SOURCE.rglob("*.py"))
    if path.name != "__init__.py"
}
TREES = {name: ast.parse(path.read_text(encoding="utf-8")) for name, path in MODULES.items()}

# Imports point downwards, or sideways without a circle. A package stands for its modules.
LAYERS = (
    ("errors", "dimensions"),
    ("expressions", "integrals", "exact", "evidence", "tidy", "rounding", "measured"),
    ("step", "derivation", "encoding", "homogeneity", "numbers"),
    ("mechanics", "figures"),
    (
        "source",
        "units",
        "terms",
        "reading",
        "latex",
        "prose",
        "schema",
        "parts",
        "script",
        "given",
        "placement",
        "problem",
        "stated",
        "verdicts",
        "errata",
        "reference",
    ),
    ("wording", "references", "checks", "curves", "depiction", "document"),
    ("output", "render"),
    (
        "solution",
        "set_document",
        "stored",
        "drawn",
        "manifest",
        "workers",
        "build",
        "doctor",
        "terminal",
        "commands",
        "cli",
        "bootstrap",
        "__main__",
    ),
)
LAYER = {name: level for level, names in enumerate(LAYERS) for name in names}
ENGINE = {name for name in MODULES if LAYER[name.partition(".")[0]] <= 3}
PRINTING = {"cli", "commands", "terminal", "doctor", "bootstrap"}
VERB_MODULES = sorted({name.partition(".")[2] for name in MODULES if name.startswith("mechanics.")})
DEFINITIONS = {"any_angular_velocity", "changing_angular_velocity", "principal_tensor", "let", "axis_vector"}
VAGUE = {"utils", "helpers", "helper", "manager", "process", "data", "misc", "common"}


def imported(name: str) -> set[str]:
    """The modules of ours that a module imports, anywhere in it."""
    found: set[str] = set()
    for node in ast.walk(TREES[name]):
        if isinstance(node, ast.ImportFrom) and (node.module or "").partition(".")[0] == "derive":
            whole = [f"{node.module}.{alias.name}" for alias in node.names]
            found |= {m for m in whole if m.removeprefix("derive.") in MODULES} or {node.module or ""}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names if alias.name.startswith("derive.")}
    return {module.removeprefix("derive.") for module in found} - {"derive"}


def strings(name: str) -> Iterator[ast.Constant]:
    """The string literals of a module but for its docstrings."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    docstrings = {
        id(node.body[0].value)
        for node in ast.walk(TREES[name])
        if isinstance(node, documented) and node.body and isinstance(node.body[0], ast.Expr)
    }
    for node in ast.walk(TREES[name]):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docstrings:
            yield node


# --- modules ---


def test_every_module_has_its_layer_and_every_layer_its_modules() -> None:
    assert {name.partition(".")[0] for name in MODULES} == set(LAYER)


@pytest.mark.parametrize("name", MODULES)
def test_imports_point_down(name: str) -> None:
    own = LAYER[name.partition(".")[0]]
    upwards = {module for module in imported(name) if LAYER[module.partition(".")[0]] > own}
    assert upwards == set()


def test_imports_go_in_no_circle() -> None:
    graph = {name: {module for module in imported(name) if module in MODULES} for name in MODULES}
    while leaves := {name for name, needs in graph.items() if not needs & set(graph)}:
        graph = {name: needs for name, needs in graph.items() if name not in leaves}
    assert graph == {}


@pytest.mark.parametrize("name", MODULES)
def test_a_module_can_be_read_at_one_sitting(name: str) -> None:
    assert len(MODULES[name].read_text(encoding="utf-8").splitlines()) <= 450


@pytest.mark.parametrize("name", MODULES)
def test_a_module_says_what_it_is_for_and_has_a_name_that_says_something(name: str) -> None:
    assert ast.get_docstring(TREES[name])
    assert not set(re.split(r"[._]", name)) & VAGUE


@pytest.mark.parametrize("name", sorted(ENGINE))
def test_the_engine_holds_no_tex(name: str) -> None:
    assert [node.value for node in strings(name) if "$" in node.value or "\\" in node.value] == []


@pytest.mark.parametrize("name", sorted(ENGINE))
def test_the_engine_holds_no_sentence(name: str) -> None:
    """A message of the engine begins with a small letter and has no full stop; what does not is meant for the page."""
    spoken = [node.value for node in strings(name) if re.search(r"^[A-Z][a-z]+ [a-z]+ |[a-z]{2}[.!?]( |$)", node.value)]
    assert spoken == []


@pytest.mark.parametrize("name", MODULES)
def test_only_the_command_line_prints(name: str) -> None:
    prints = [n for n in ast.walk(TREES[name]) if isinstance(n, ast.Call) and ast.unparse(n.func) == "print"]
    assert not prints or name in PRINTING


@pytest.mark.parametrize("name", MODULES)
def test_nothing_is_evaluated_from_text(name: str) -> None:
    banned = {"eval", "exec", "sympify", "parse_expr", "parse_latex", "S"}
    called = {ast.unparse(n.func) for n in ast.walk(TREES[name]) if isinstance(n, ast.Call)}
    allowed = {"exec"} if name == "script" else set()  # a problem's own script is code, and trusted
    assert called & banned <= allowed


def test_modules_of_the_engine_import_no_reader_of_files() -> None:
    for name in ENGINE:
        modules = {alias.name for n in ast.walk(TREES[name]) if isinstance(n, ast.Import) for alias in n.names}
        modules |= {n.module or "" for n in ast.walk(TREES[name]) if isinstance(n, ast.ImportFrom)}
        assert not modules & {"yaml", "jinja2", "pathlib", "os", "subprocess", "pylatexenc", "io"}


def test_nothing_that_is_shipped_names_this_machine() -> None:
    kept = [*SOURCE.rglob("*.py"), *(ROOT / "templates").rglob("*.*"), *(ROOT / "problems").rglob("*.*")]
    for path in kept:
        text = path.read_text(encoding="utf-8") if path.suffix in {".py", ".yaml", ".j2"} else ""
        assert not re.search(r"/home/|/work/|/tmp/|https?://(?!docs\.|www\.bipm|yaml\.org)\S*index", text), path


# --- verbs ---


def verbs() -> dict[str, Any]:
    """Every public function of mechanics and numbers that yields a quantity."""
    modules = [
        derive.numbers,
        *(getattr(derive.mechanics, name) for name in VERB_MODULES),
    ]
    return {
        name: function
        for module in modules
        for name, function in vars(module).items()
        if inspect.isfunction(function)
        and function.__module__ == module.__name__
        and not name.startswith("_")
        and "Quantity" in str(inspect.signature(function).return_annotation)
    }


@pytest.mark.parametrize("name", verbs())
def test_a_verb_says_its_source_and_its_second_route(name: str) -> None:
    told = inspect.getdoc(verbs()[name]) or ""
    assert re.search(r"Source: \S", told)
    assert "Second route: " in told or name in DEFINITIONS
    if name in DEFINITIONS:
        assert "definition" in told


@pytest.mark.parametrize("name", verbs())
def test_a_verb_explains_each_of_its_arguments(name: str) -> None:
    told = inspect.getdoc(verbs()[name]) or ""
    for parameter in inspect.signature(verbs()[name]).parameters:
        if parameter not in {"symbol", "key"} and name != "axis_vector":
            assert re.search(rf"\b{parameter}\b", told), parameter


@pytest.mark.parametrize("name", verbs())
def test_a_verb_can_be_found_in_the_notation(name: str) -> None:
    notation = (ROOT / "NOTATION.md").read_text(encoding="utf-8")
    of_engine = {"axis_vector", "value_of", "coefficient_of", "comparison_of"}
    assert name in derive.mechanics.__all__ or name in of_engine
    assert re.search(rf"`{name}\b", notation) or name in of_engine


def test_a_verb_is_named_for_what_it_yields() -> None:
    assert [name for name in verbs() if re.match(r"(compute|get|make|calculate|find|do)_", name)] == []


# --- words ---


def establishing_calls() -> Iterator[tuple[str, str, ast.Call]]:
    """Module, rule and call of every `establish(...)` in the engine."""
    for name in sorted(ENGINE):
        for node in ast.walk(TREES[name]):
            if (
                isinstance(node, ast.Call)
                and ast.unparse(node.func) == "establish"
                and isinstance(node.args[0], ast.Constant)
            ):
                yield name, node.args[0].value, node


def written_outcomes(module: str, call: ast.Call) -> set[str]:
    """The outcomes that can be read off the source: constants, the branches of a choice, the values of a table."""
    given = next((keyword.value for keyword in call.keywords if keyword.arg == "outcome"), ast.Constant("generic"))
    functions = {n.name: n for n in ast.walk(TREES[module]) if isinstance(n, ast.FunctionDef)}
    roots: list[ast.AST] = [given]
    roots += [functions[n.id] for n in ast.walk(given) if isinstance(n, ast.Name) and n.id in functions]
    found: set[str] = set()
    for root in roots:
        for node in ast.walk(root):
            branches: list[Any] = []
            if isinstance(node, ast.IfExp):
                branches = [node.body, node.orelse]
            elif isinstance(node, ast.Return | ast.Lambda):
                branches = [node.value if isinstance(node, ast.Return) else node.body]
            elif isinstance(node, ast.Dict):
                branches = node.values
            elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith(".get"):
                branches = node.args[1:]
            found |= {b.value for b in [*branches, given] if isinstance(b, ast.Constant) and isinstance(b.value, str)}
    return found


def documented_outcomes(module: str, call: ast.Call) -> set[str]:
    """The outcomes that the docstring of the verb names, without what it says of them in brackets."""
    functions = [n for n in TREES[module].body if isinstance(n, ast.FunctionDef)]
    verb = next((n for n in functions if n.lineno <= call.lineno <= (n.end_lineno or 0)), None)
    told = re.search(r"Outcomes: (.*?)\.?\n\s*(?:\w+ ?\w*:|$)", (verb and ast.get_docstring(verb)) or "", re.DOTALL)
    listed = re.sub(r"\([^()]*\)", "", told[1]) if told else ""
    return {
        word.strip(" `.\n")
        for word in re.split(r"[,:;]|\band\b", listed)
        if re.fullmatch(r"[\s`]*[a-z_]+[\s`.]*", word)
    }


def reached_outcomes() -> dict[str, set[str]]:
    """The outcomes that the variants of the block reach, by rule."""
    found: dict[str, set[str]] = {}
    for variant in VARIANTS:
        for quantity in known_block(**variant).values():
            found.setdefault(quantity.step.rule, set()).add(quantity.step.outcome)
    return found


def test_every_rule_has_a_phrase_for_each_outcome() -> None:
    rules = {rule for _, rule, _ in establishing_calls()}
    impossible = {("rotation.angular_momentum", "zero")}  # it says `parallel` where the vector product vanishes
    missing = {
        (rule, outcome)
        for module, rule, call in establishing_calls()
        for outcome in written_outcomes(module, call)
        | documented_outcomes(module, call)
        | reached_outcomes().get(rule, set())
        if outcome not in WORDS.rules.get(rule, {})
    }
    assert missing <= impossible
    assert rules == set(WORDS.rules)


def test_no_phrase_is_for_an_outcome_that_cannot_be() -> None:
    possible = {rule: set(outcomes) for rule, outcomes in reached_outcomes().items()}
    for module, rule, call in establishing_calls():
        possible.setdefault(rule, set()).update(written_outcomes(module, call), documented_outcomes(module, call))
    spare = {(rule, outcome) for rule, told in WORDS.rules.items() for outcome in told if outcome not in possible[rule]}
    assert spare == set()


def test_every_rule_has_words_for_each_second_route() -> None:
    claims = {
        (rule, key.value)
        for _, rule, call in establishing_calls()
        for keyword in call.keywords
        if keyword.arg == "routes"
        for table in ast.walk(keyword.value)
        if isinstance(table, ast.Dict)
        for key in table.keys
        if isinstance(key, ast.Constant)
    }
    told = {(rule, claim) for rule, routes in WORDS.routes.items() for claim in routes}
    assert claims == told


def test_a_definition_is_a_definition_and_everything_else_has_a_route() -> None:
    for _, rule, call in establishing_calls():
        named = {keyword.arg for keyword in call.keywords}
        assert ("routes" in named) != ("definition" in named), rule


def test_quantities_are_made_by_establish_alone() -> None:
    for name in MODULES:
        made = [
            n for n in ast.walk(TREES[name]) if isinstance(n, ast.Call) and ast.unparse(n.func) in {"Quantity", "Step"}
        ]
        assert not made or name in {"step", "derivation"}, name
    assert isinstance(known_block()["torque"], Quantity)
    assert a.is_positive


def test_every_test_has_a_claim_for_a_name_and_none_is_skipped() -> None:
    for path in Path(__file__).parent.rglob("test_*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        tests = [n.name for n in ast.walk(tree) if isinstance(n, ast.FunctionDef) and n.name.startswith("test_")]
        assert [name for name in tests if name.count("_") < 3] == [], path.name
        assert len(tests) == len(set(tests)), path.name
        marks = {ast.unparse(n) for n in ast.walk(tree) if isinstance(n, ast.Attribute)}
        assert not marks & {
            "pytest.mark.skip",
            "pytest.mark.xfail",
            "pytest.mark.skipif",
            "pytest.skip",
            "pytest.xfail",
        }
