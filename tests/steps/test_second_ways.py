"""What is called a second route goes another way through the physics; what puts the result to a test is a check."""

from __future__ import annotations

import ast
import inspect
import re
from functools import cache

import pytest

from derive.algebra.equality import Compared
from derive.steps.second_ways import CHECKS, OTHERWISE, ROUTES, is_decided, sort_of
from tests.page.test_wording import WORDS
from tests.test_house_rules import DEFINITIONS, ENGINE, tree, verbs


@pytest.mark.parametrize("claim", ["put_back", "floats", "beside", "quadrature", "vieta", "resultant", "unit"])
def test_a_root_put_back_a_number_evaluated_anew_a_sign_and_an_identity_are_checks(claim: str) -> None:
    assert sort_of("any.rule", claim) is Compared.CHECK


@pytest.mark.parametrize("claim", ["particles", "virtual_work", "carried_round", "integration", "newton", "trial"])
def test_what_starts_from_other_physics_is_a_route(claim: str) -> None:
    assert sort_of("any.rule", claim) is Compared.ROUTE


def test_nothing_is_both() -> None:
    assert not ROUTES & CHECKS


def test_a_rule_may_mean_something_else_by_a_name() -> None:
    for (rule, claim), sort in OTHERWISE.items():
        assert sort_of(rule, claim) is sort is not sort_of("any.rule", claim)


def test_what_nobody_has_decided_claims_no_more_than_a_check() -> None:
    assert not is_decided("any.rule", "by_magic")
    assert sort_of("any.rule", "by_magic") is Compared.CHECK


# --- what the docstring of a verb calls it ---

FUNCTIONS = {
    (module, node.name): node for module in ENGINE for node in tree(module).body if isinstance(node, ast.FunctionDef)
}


@cache
def imported(module: str) -> dict[str, tuple[str, str]]:
    """What a module has from others: the name that it uses, and where that is a function."""
    return {
        alias.asname or alias.name: (node.module.removeprefix("derive."), alias.name)
        for node in ast.walk(tree(module))
        if isinstance(node, ast.ImportFrom) and node.module
        for alias in node.names
    }


def rules_of(module: str, name: str, seen: set[tuple[str, str]]) -> set[str]:
    """The rules by which a function establishes, itself or by functions that are no verbs."""
    seen.add((module, name))
    function, found = FUNCTIONS[module, name], set[str]()
    nodes = list(ast.walk(function))
    its_own = {n.arg for n in nodes if isinstance(n, ast.arg)}
    its_own |= {n.id for n in nodes if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
    calls = [n for n in nodes if isinstance(n, ast.Call) and ast.unparse(n.func) == "establish"]
    found |= {call.args[0].value for call in calls if isinstance(call.args[0], ast.Constant)}
    for used in {n.id for n in nodes if isinstance(n, ast.Name)} - its_own - set(verbs()):
        there = imported(module).get(used, (module, used))
        if there in FUNCTIONS and there not in seen:
            found |= rules_of(*there, seen)
    return found


def ways_of(name: str) -> set[Compared]:
    """What the second ways of a verb are, as `second_ways` decides; none of a verb that only hands on to another."""
    module = verbs()[name].__module__.removeprefix("derive.")
    rules = rules_of(module, name, set())
    return {sort_of(rule, claim) for rule in rules for claim in WORDS.routes.get(rule, {})}


def called(name: str) -> str:
    """By what word its docstring tells the second way: the first of the two that stands there."""
    found = re.search(r"^(Second route|Check): ", inspect.getdoc(verbs()[name]) or "", re.MULTILINE)
    return found[1] if found else ""


@pytest.mark.parametrize("name", sorted(set(verbs()) - DEFINITIONS))
def test_a_docstring_says_second_route_where_one_goes_through_the_physics_and_check_where_none_does(name: str) -> None:
    told = inspect.getdoc(verbs()[name]) or ""
    as_another = re.search(r"(?:Second route|Check): as `(\w+)`", told)
    if ways := ways_of(name):
        assert called(name) == ("Second route" if Compared.ROUTE in ways else "Check")
    else:
        assert as_another
    if as_another:
        assert called(name) == called(as_another[1])
