"""What is called a second route goes another way through the physics; what puts the result to a test is a check."""

from __future__ import annotations

import pytest

from derive.algebra.equality import Compared
from derive.steps.second_ways import CHECKS, OTHERWISE, ROUTES, is_decided, sort_of


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
