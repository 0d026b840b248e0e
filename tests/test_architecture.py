"""The rules of the code: the place of each module, its allowed imports, and the required docstring of every verb."""

from __future__ import annotations

import ast
import inspect
import re
import tempfile
from collections.abc import Collection, Iterator
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

import derive.mechanics
import derive.steps.numeric
from derive.page.wording import AFTER, AND
from derive.steps.rule import ROUTE, RULES, Rule, judged_facts
from derive.steps.step import Fact, Quantity
from tests.courses import ROOT
from tests.loops import over
from tests.mechanics.block import a, known_block
from tests.page.test_wording import WORDS
from tests.rules import records
from tools.trees import nodes_of, nodes_under, parsed

SOURCE = ROOT / "derive"
MODULES = {
    ".".join(path.relative_to(SOURCE).with_suffix("").parts): path
    for path in sorted(SOURCE.rglob("*.py"))
    if path.name != "__init__.py"
}

# The packages from the lowest level up: a package imports from lower levels, and not from another package of its level.
# Three modules are outside of the packages: `given` for scripts, `notebook` for notebooks, and `__main__`.
LEVELS = (
    ("errors",),
    ("algebra",),
    ("units",),
    ("steps",),
    ("solving",),
    ("witness", "documents"),
    ("mechanics", "course"),
    ("figures",),
    ("stock", "audit"),
    ("page",),
    ("render",),
    ("grading",),
    ("building",),
    ("preview", "exporting"),
    ("cli",),
)
LIKE = {"given": "course", "notebook": "cli", "__main__": "cli"}  # module -> the package whose imports it may have
LEVEL = {package: level for level, packages in enumerate(LEVELS) for package in packages}
ENGINE = {
    name
    for name in MODULES
    if name.partition(".")[0] in {"errors", "algebra", "steps", "solving", "mechanics", "figures"}
}
PRINTING = {"cli.options", "cli.running", "cli.streams", "cli.terminal", "building.doctor"}
VERB_MODULES = sorted(name for name in MODULES if name.startswith("mechanics."))
VAGUE = {"utils", "helpers", "helper", "manager", "process", "data", "misc", "common"}


@cache
def tree(name: str) -> ast.Module:
    return parsed(MODULES[name])


@cache
def nodes(name: str) -> tuple[ast.AST, ...]:
    return nodes_of(MODULES[name])


def dotted(function: ast.AST) -> str:
    """Return the name of a function that is called, such as `Rule` or `ast.parse`; empty if it has none."""
    if isinstance(function, ast.Attribute):
        return f"{dotted(function.value)}.{function.attr}"
    return function.id if isinstance(function, ast.Name) else ""


@cache
def names_called(name: str) -> set[str]:
    """Return the names of the functions that a module calls."""
    return {dotted(node.func) for node in nodes(name) if isinstance(node, ast.Call)}


@cache
def imported(name: str) -> set[str]:
    """Return the modules of derive that a module imports, at its top or within functions."""
    found: set[str] = set()
    for node in nodes(name):
        if isinstance(node, ast.ImportFrom) and (node.module or "").partition(".")[0] == "derive":
            whole = [f"{node.module}.{alias.name}" for alias in node.names]
            found |= {m for m in whole if m.removeprefix("derive.") in MODULES} or {node.module or ""}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names if alias.name.startswith("derive.")}
    return {module.removeprefix("derive.") for module in found} - {"derive"}


def strings(name: str) -> Iterator[ast.Constant]:
    """Yield the string literals of a module, except its docstrings."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    docstrings = {
        id(node.body[0].value)
        for node in nodes(name)
        if isinstance(node, documented) and node.body and isinstance(node.body[0], ast.Expr)
    }
    for node in nodes(name):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docstrings:
            yield node


# --- modules ---


def package(name: str) -> str:
    return name.partition(".")[0]


def test_the_packages_are_these() -> None:
    assert {package(name) for name in MODULES} == set(LEVEL) | set(LIKE)


def test_each_package_says_what_it_is_for() -> None:
    for folder in (path.parent for path in SOURCE.rglob("__init__.py")):
        assert ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))), folder


def test_the_tests_are_in_folders_of_the_packages() -> None:
    """Three more folders have the tests of the manual, of printed pages and of the tools."""
    folders = {path.relative_to(ROOT / "tests").parts[0] for path in (ROOT / "tests").glob("*/**/test_*.py")}
    assert folders - set(LEVEL) == {"manual", "printed", "tools"}


@over(LEVEL)
def test_the_readme_shows_each_package_with_its_sentence(name: str) -> None:
    file = SOURCE / f"{name}.py" if (SOURCE / f"{name}.py").exists() else SOURCE / name / "__init__.py"
    said = (ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))) or "").partition("\n\n")[0]
    assert f"\n{name:10} {said}\n" in (ROOT / "README.md").read_text(encoding="utf-8")


@over(MODULES)
def test_imports_point_down(name: str) -> None:
    own = LIKE.get(name, package(name))
    allowed = {other for other in LEVEL if LEVEL[other] < LEVEL[own]} | {own}
    assert {module for module in imported(name) if package(module) not in allowed} == set()


@over([name for name in MODULES if package(name) in {"page", "render", "building", "preview"}])
def test_a_page_names_no_rule(name: str) -> None:
    """What a page needs to know of a rule is in its record, so a rule of a script is shown in the same way."""
    chapters = {rule.partition(".")[0] for rule in RULES}
    assert [each.value for each in strings(name) if re.fullmatch(rf"({'|'.join(chapters)})\.[a-z_]*", each.value)] == []


# The chapters of mechanics in their order: each imports only from earlier ones.
RECORDS = list(records())
CHAPTERS = (
    "kinematics",
    "bodies",
    "rotation",
    "model",
    "lagrange",
    "newton",
    "hamilton",
    "rest",
    "motion",
    "vibrations",
    "answers",
    "impacts",
    "observations",
)


@over(VERB_MODULES)
def test_a_chapter_of_mechanics_imports_from_those_before_it(name: str) -> None:
    *_, chapter, _ = ("", *name.split("."))
    if chapter == "mechanics":  # modules that all chapters share
        assert not any(module.startswith("mechanics.") and module.count(".") > 1 for module in imported(name))
        return
    allowed = CHAPTERS[: CHAPTERS.index(chapter) + 1]
    others = {module for module in imported(name) if module.startswith("mechanics.") and module.count(".") > 1}
    assert {module for module in others if module.split(".")[1] not in allowed} == set()


SHARED_BY_CLAIMS = {"mechanics.kinematics.coordinates"}  # coordinates as functions of time
CLAIMS = [name for name in VERB_MODULES if name.endswith(".claims")]


@over([name for name in VERB_MODULES if not name.endswith(".claims")])
def test_no_verb_calls_a_predicate(name: str) -> None:
    """A rule lists its predicates; a verb that used one to find its result would be checked by its own code."""
    functions = [node for node in nodes(name) if isinstance(node, ast.FunctionDef)]
    within = {dotted(node.func) for each in functions for node in ast.walk(each) if isinstance(node, ast.Call)}
    assert {each for each in within if each.startswith("claims.")} == set()


@over(CLAIMS)
def test_predicates_share_no_code_with_the_verbs_next_to_them(name: str) -> None:
    """Predicates may read the facts of a result, and the descriptions of bodies and systems."""
    makers = {module for module, _, rule in RECORDS if module.startswith("mechanics.")}
    assert imported(name) & makers - SHARED_BY_CLAIMS == set()


def test_imports_go_in_no_circle() -> None:
    graph = {name: {module for module in imported(name) if module in MODULES} for name in MODULES}
    while leaves := {name for name, needs in graph.items() if not needs & set(graph)}:
        graph = {name: needs for name, needs in graph.items() if name not in leaves}
    assert graph == {}


@over(MODULES)
def test_a_module_says_what_it_is_for_and_has_a_name_that_says_something(name: str) -> None:
    assert ast.get_docstring(tree(name))
    assert not set(re.split(r"[._]", name)) & VAGUE


@over(sorted(ENGINE))
def test_the_engine_holds_no_tex(name: str) -> None:
    assert [node.value for node in strings(name) if "$" in node.value or "\\" in node.value] == []


@over(sorted(ENGINE))
def test_the_engine_holds_no_sentence(name: str) -> None:
    """A message of the engine begins with a small letter and has no full stop. Any other text would be a sentence of a
    page."""
    spoken = [node.value for node in strings(name) if re.search(r"^[A-Z][a-z]+ [a-z]+ |[a-z]{2}[.!?]( |$)", node.value)]
    assert spoken == []


@over(MODULES)
def test_only_the_command_line_prints(name: str) -> None:
    assert "print" not in names_called(name) or name in PRINTING or name.startswith("cli.commands.")


@over(MODULES)
def test_nothing_is_evaluated_from_text(name: str) -> None:
    banned = {"eval", "exec", "sympify", "parse_expr", "parse_latex", "S"}
    allowed = {"exec"} if name == "course.script" else set()  # the script of a problem is trusted code
    assert names_called(name) & banned <= allowed


def test_dependence_on_time_is_decided_by_one_predicate() -> None:
    """`formula.has(TIME)` is false for a prescribed function of the time; `depends_on_time` is true."""
    asked = {
        name: path.read_text(encoding="utf-8")
        for name, path in MODULES.items()
        if not name.startswith(("figures.", "render."))  # what is drawn and the order of terms depend on t itself
    }
    assert [name for name, text in asked.items() if re.search(r"\.has\([^()]*\bTIME\b", text)] == []


def test_modules_of_the_engine_import_no_reader_of_files() -> None:
    for name in ENGINE:
        modules = {alias.name for n in nodes(name) if isinstance(n, ast.Import) for alias in n.names}
        modules |= {n.module or "" for n in nodes(name) if isinstance(n, ast.ImportFrom)}
        assert not modules & {"yaml", "jinja2", "pathlib", "os", "subprocess", "pylatexenc", "io"}


@over(["README.md", "CONTRIBUTING.md", "NOTATION.md", "docs/soundness.md", "docs/json.md"])
def test_what_a_page_says_stands_somewhere_stands_there(page: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    named = re.findall(r"`((?:derive|tests|templates|docs|tools)/[\w./-]+)`", text)
    assert [name for name in named if not (ROOT / name).exists()] == []


def test_nothing_that_is_shipped_names_a_machine() -> None:
    """No folder of the user who runs this test, and no address of a package index."""
    own = "|".join(re.escape(f"{folder}/") for folder in (ROOT, Path.home(), Path(tempfile.gettempdir())))
    for path in (
        p for folder in ("derive", "templates", "problems", "docs", "tools") for p in (ROOT / folder).rglob("*.*")
    ):
        text = path.read_text(encoding="utf-8") if path.suffix in {".py", ".yaml", ".j2", ".md"} else ""
        assert not re.search(rf"{own}|https?://(?!docs\.|www\.bipm|yaml\.org)\S*index", text), path


# --- verbs ---


@cache
@cache
def verbs() -> dict[str, Any]:
    """Return every public function of `derive.mechanics` and `derive.steps.numeric` that yields a quantity by its own
    rule."""
    modules = [
        derive.steps.numeric,
        *(import_module(f"derive.{name}") for name in VERB_MODULES),
    ]
    return {
        name: function
        for module in modules
        for name, function in vars(module).items()
        if inspect.isfunction(function)
        and function.__module__ == module.__name__
        and not name.startswith("_")
        and "Quantity" in str(inspect.signature(function).return_annotation)
        and "rule" not in inspect.signature(function).parameters
    }


@over(verbs())
def test_a_verb_says_its_source(name: str) -> None:
    assert re.search(r"Source: \S", inspect.getdoc(verbs()[name]) or "")


@over(verbs())
def test_a_verb_explains_each_of_its_arguments(name: str) -> None:
    told = inspect.getdoc(verbs()[name]) or ""
    for parameter in inspect.signature(verbs()[name]).parameters:
        if parameter not in {"symbol", "key"} and name != "axis_vector":
            assert re.search(rf"\b{parameter}\b", told), parameter


def test_a_script_can_import_each_verb() -> None:
    of_engine = {"axis_vector", "value_of", "coefficient_of", "comparison_of"}
    assert [name for name in verbs() if not hasattr(derive.mechanics, name) and name not in of_engine] == []


def test_the_notation_names_verbs_that_there_are() -> None:
    table = [line.split("|") for line in (ROOT / "NOTATION.md").read_text(encoding="utf-8").splitlines()]
    named = {name for row in table if len(row) == 7 for name in re.findall(r"`(\w+)`", row[4])}
    assert len(named) > 80
    assert sorted(name for name in named - {*verbs()} if not hasattr(derive.mechanics, name)) == []


def test_a_verb_is_named_for_what_it_yields() -> None:
    assert [name for name in verbs() if re.match(r"(compute|get|make|calculate|find|do)_", name)] == []


# --- rules ---

MARK = re.compile(f"{AND}.*|{AFTER}.*")


def outcomes_with_a_phrase(rule: str) -> set[str]:
    return {MARK.sub("", key) for key in WORDS.rules.get(rule, {})}


def test_a_rule_is_named_for_its_folder_and_by_its_constant() -> None:
    for module, const, rule in RECORDS:
        folder, _, name = rule.name.partition(".")
        assert folder == (module.split(".")[1]), rule.name
        assert name.upper() == const, rule.name
    assert len({rule.name for *_, rule in RECORDS}) == len(RECORDS) > 150


@over([rule for *_, rule in RECORDS])
def test_a_rule_has_a_source_and_a_phrase_for_each_outcome_and_each_claim_and_no_other(rule: Rule) -> None:
    assert rule.source or rule.is_definition
    assert outcomes_with_a_phrase(rule.name) == set(rule.outcomes)
    assert set(WORDS.routes.get(rule.name, {})) == set(rule.evidence)
    for table in (WORDS.setups, WORDS.clauses):
        assert set(table.get(rule.name, {})) <= set(rule.outcomes)


def test_every_phrase_belongs_to_a_rule() -> None:
    rules = {rule.name for *_, rule in RECORDS}
    assert set(WORDS.rules) == rules
    for table in (WORDS.routes, WORDS.setups, WORDS.clauses):
        assert set(table) <= rules


@cache
def uses(module: str) -> dict[str, set[str]]:
    """Return the rules that each top-level function or class of a module passes to `establish`, or to `observation`,
    which calls it, by their constants."""
    return {
        node.name: {
            ast.unparse(call.args[0])
            for call in ast.walk(node)
            if isinstance(call, ast.Call) and dotted(call.func) in ("establish", "observation")
        }
        for node in tree(module).body
        if isinstance(node, ast.FunctionDef | ast.ClassDef)
    }


def test_each_record_is_used_in_its_module() -> None:
    for module, const, rule in RECORDS:
        assert any(const in used for used in uses(module).values()), rule.name


@cache
def functions() -> dict[tuple[str, str], ast.FunctionDef]:
    """Return the functions of the engine by module and name."""
    return {
        (module, node.name): node
        for module in ENGINE
        for node in tree(module).body
        if isinstance(node, ast.FunctionDef)
    }


@cache
def names_from_elsewhere(module: str) -> dict[str, tuple[str, str]]:
    """Return name -> (module, name there) for each name that a module imports."""
    return {
        alias.asname or alias.name: (node.module.removeprefix("derive."), alias.name)
        for node in nodes(module)
        if isinstance(node, ast.ImportFrom) and node.module
        for alias in node.names
    }


@cache
def rules_and_calls(module: str, name: str) -> tuple[frozenset[Rule], frozenset[str]]:
    """Return the rules that a function names itself, and the names that it has from elsewhere."""
    within = list(nodes_under(functions()[module, name]))
    its_own = {n.arg for n in within if isinstance(n, ast.arg)}
    its_own |= {n.id for n in within if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
    found = {rule for where, const, rule in RECORDS if where == module and const in uses(module)[name]}
    return frozenset(found), frozenset({n.id for n in within if isinstance(n, ast.Name)} - its_own)


def rules_of(module: str, name: str, seen: set[tuple[str, str]], but_for: Collection[str]) -> set[Rule]:
    """Return the rules that a function passes to `establish`, directly or through functions other than these."""
    seen.add((module, name))
    its_own, names = rules_and_calls(module, name)
    found = set(its_own)
    for used in names - set(but_for):
        there = names_from_elsewhere(module).get(used, (module, used))
        if there in functions() and there not in seen:
            found |= rules_of(*there, seen, but_for)
    return found


def rules_of_verb(name: str, through_others: bool = False) -> set[Rule]:
    """Return the rules that a verb passes to `establish`, directly or with `through_others` also through other
    verbs."""
    module = verbs()[name].__module__.removeprefix("derive.")
    return rules_of(module, name, set(), () if through_others else set(verbs()))


def called(name: str) -> str:
    """Return the word by which the docstring calls the second derivation, "Second route" or "Check"; empty if it has
    none."""
    found = re.search(r"^(Second route|Check): ", inspect.getdoc(verbs()[name]) or "", re.MULTILINE)
    return found[1] if found else ""


@over(verbs())
def test_a_docstring_says_second_route_where_one_goes_through_the_physics_and_check_where_none_does(name: str) -> None:
    told = inspect.getdoc(verbs()[name]) or ""
    as_another = re.search(r"(?:Second route|Check): as `(\w+)`", told)
    rules = rules_of_verb(name)
    ways = {way for rule in rules for way in rule.evidence.values()}
    if ways:
        assert called(name) == ("Second route" if ROUTE in ways else "Check")
    elif rules:
        assert "definition" in told
    else:
        assert as_another or called(name) == ""
    if as_another:
        assert called(name) == called(as_another[1])


@over(verbs())
def test_a_docstring_names_outcomes_that_the_rules_of_the_verb_have(name: str) -> None:
    told = re.search(r"Outcomes: (.*?)\.?\n\s*(?:\w+ ?\w*:|$)", inspect.getdoc(verbs()[name]) or "", re.DOTALL)
    listed = re.sub(r"\([^()]*\)", "", told[1]) if told else ""
    words = {word.strip(" `.\n") for word in re.split(r"[,:;]|\band\b", listed)}
    outcomes = {outcome for rule in rules_of_verb(name, through_others=True) for outcome in rule.outcomes}
    assert {word for word in words if re.fullmatch(r"[a-z_]+", word)} <= outcomes or not outcomes


def test_quantities_are_made_by_establish_alone() -> None:
    for name in MODULES:
        assert not names_called(name) & {"Quantity", "Step"} or name in {"steps.establish", "steps.derivation"}, name
    assert isinstance(known_block()["torque"], Quantity)
    assert a.is_positive


def _one_value_twice(pair: ast.AST) -> bool:
    """Whether a pair is (x, x), (x := f, x), (x,) * 2, or an equation and the same with its sides exchanged."""
    if isinstance(pair, ast.BinOp):
        return isinstance(pair.op, ast.Mult) and isinstance(pair.left, ast.Tuple) and ast.unparse(pair.right) == "2"
    if not isinstance(pair, ast.Tuple) or len(pair.elts) != 2:
        return False
    one, other = (set(filter(None, map(ast.unparse, _written(each)))) for each in pair.elts)
    both = [each for each in pair.elts if isinstance(each, ast.Call) and ast.unparse(each.func) == "Relation"]
    turned = len(both) == 2 and len({tuple(sorted(map(ast.unparse, each.args))) for each in both}) == 1
    manners = all(name.startswith("Manner.") for name in one | other)
    return not manners and (bool(one & other) or turned)


def _written(value: ast.expr) -> list[ast.expr]:
    return [value.target, value.value] if isinstance(value, ast.NamedExpr) else [value]


def _pairs_of(name: str) -> Iterator[ast.AST]:
    """Yield the values in dictionaries, among them the pairs of a formula and the same formula by another route."""
    for node in nodes(name):
        if isinstance(node, ast.Dict):
            yield from node.values
        elif (
            isinstance(node, ast.DictComp)
            or isinstance(node, ast.Assign)
            and isinstance(node.targets[0], ast.Subscript)
        ):
            yield node.value


ELSEWHERE = {"mechanics.vibrations.superposition"}  # its start values have a separate second route
SAYING_FORMULAS = [name for name in MODULES if name.startswith("mechanics.") or name == "steps.numeric"]


@over(sorted(set(SAYING_FORMULAS) - ELSEWHERE))
def test_a_formula_is_not_compared_with_itself(name: str) -> None:
    """A formula without a second route belongs under `named`, where a predicate judges it."""
    assert [ast.unparse(pair) for pair in _pairs_of(name) if _one_value_twice(pair)] == []


@pytest.mark.parametrize(
    ("source", "twice"),
    [
        ("(x, x)", True),
        ("((x := f(y)), x)", True),
        ("(g(x),) * 2", True),
        ("(Relation(q, '=', a), Relation(a, '=', q))", True),
        ("(x, y)", False),
        ("(Relation(q, '=', a), Relation(b, '=', q))", False),
    ],
)
def test_one_value_twice_is_found_in_a_pair(source: str, twice: bool) -> None:
    assert _one_value_twice(ast.parse(source, mode="eval").body) is twice


CARRIED = {  # facts about the origin of a value; where they are read, values that do not fit together are rejected
    "bodies and points, which `united` compares": {"OfBody", "AboutPoint", "Integrated", "PrincipalOf"},
    "the matter or the law itself, from which the routes are computed": {
        "Matter",
        "ReducedMatter",
        "Varied",
        "Constrained",
        "Rolling",
        "FromLagrangian",
        "Energies",
        "ActedOn",
        "ForcedMotion",
        "MovedAlone",
        "PhaseSpace",
        "SeenWith",
        "RestOf",
        "KnownCoordinate",
        "Eliminated",
        "MotionOfBody",
        "RateOfMomentum",
        "RateByParticles",
        "RateOfEnergy",
        "RateOfTurning",
        "RateOfSquare",
        "Through",
        "WobbleOf",
        "Acting",
        "Around",
        "Described",
        "Struck",
        "Witness",
    },
    "words about the result, which have predicates": {"AtOneMoment", "Momentary", "Roots", "ValueOf"},
    "numbers that a test of their own compares": {"WholeSwing"},
    "a mark: each use of the symbol is compared with the value": {"NamesValue"},
}


def test_each_kind_of_fact_has_a_predicate_or_a_reason_to_have_none() -> None:
    classes = {c.__name__ for c in judged_facts()}
    reasons = set().union(*CARRIED.values())
    every = {c.__name__ for c in _below(Fact) if c.__module__.startswith("derive.")}
    assert sorted(every - classes - reasons) == []
    assert sorted(reasons - every) == []
    assert classes & reasons == set()


def _below(kind: type) -> set[type]:
    own = set(kind.__subclasses__())
    return own.union(*(_below(each) for each in own))


def test_every_test_has_a_claim_for_a_name_and_none_is_skipped() -> None:
    for path in Path(__file__).parent.rglob("test_*.py"):
        source = path.read_text(encoding="utf-8")
        tests = re.findall(r"^ *def (test_\w+)", source, re.M)
        assert [name for name in tests if name.count("_") < 3] == [], path.name
        assert len(tests) == len(set(tests)), path.name
        assert not re.search(r"\bpytest\.(?:mark\.)?(?:skip|skipif|xfail)\b", source), path.name
