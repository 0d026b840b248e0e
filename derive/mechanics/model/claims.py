"""Predicates of models: each decides whether an outcome, or a fact in the sentence of an outcome, is correct."""

from __future__ import annotations

from sympy import eye

from derive.steps.claims import both, negated
from derive.steps.rule import Judged, Predicate
from derive.steps.step import is_zero


def along_space(facts: Judged) -> bool:
    return is_zero(facts.inputs["frame"] - eye(3))


def along_body(facts: Judged) -> bool:
    return is_zero(facts.inputs["frame"] - facts.inputs["in_space"])


def of_a_centre(facts: Judged) -> bool:
    return "centre" in facts.inputs and is_zero(facts.result - facts.inputs["centre"])


def of_a_spring(facts: Judged, several: bool) -> bool:
    """Whether the result is the length of the only spring of the system; if `several`, the length of one of several
    springs."""
    springs = [each for each in facts.subject.body.between if each.is_spring]
    return (len(springs) > 1) == several and any(is_zero(each.length - facts.result) for each in springs)


def distance_spring(facts: Judged) -> bool:
    return bool(of_a_spring(facts, several=False))


def distance_springs(facts: Judged) -> bool:
    return bool(of_a_spring(facts, several=True))


def distance_other(facts: Judged) -> bool:
    return bool(not any(of_a_spring(facts, several) for several in (False, True)))


def component_place(facts: Judged) -> bool:
    return bool("centre" not in facts.inputs)


angular_velocity_body: Predicate = both(along_body, negated(along_space))


angular_velocity_following: Predicate = both(negated(along_body), negated(along_space))
