"""Equations by Newton's laws, and checks of the methods that a problem states."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from derive.course.parts import ANGULAR_MOMENTUM, BOTH, ENERGY, LAGRANGE, NEWTON
from derive.course.unused import needed_for
from derive.course.yaml_tree import Word
from derive.errors import rejected
from derive.mechanics import Coordinate, System, second_law, torque_law
from derive.mechanics.kinematics.coordinates import OfCoordinate
from derive.mechanics.newton.single_bodies import body_of
from derive.steps.derivation import returned_quantities, with_ancestors
from derive.steps.step import Quantity


def by_newton(system: System, q: Coordinate, key: str, about: str = "", at_rest: bool = False) -> Quantity:
    """Return Newton's second law along a coordinate, or the torque law if the coordinate rotates its body."""
    if body_of(system, q.symbol).turn(q.symbol) != 0:
        return torque_law(system, q, key, about, at_rest)
    return second_law(system, q, key, at_rest)


ABOUT: Mapping[str, str] = {
    NEWTON: "",
    BOTH: "",
    ANGULAR_MOMENTUM: "contact",
}  # method -> the argument `about` of `torque_law`
LAWS = ("newton.second_law", "newton.torque_law")
OF_IMPACTS = ("impacts.momentum_law", "impacts.angular_momentum_law")
RULES: Mapping[str, tuple[str, ...]] = {  # method -> the rules by which it derives an equation
    NEWTON: (*LAWS, *OF_IMPACTS),
    BOTH: ("newton.agreement_of_laws",),
    ENERGY: ("newton.energy_equation", "newton.total_energy"),
    ANGULAR_MOMENTUM: ("newton.torque_law", *OF_IMPACTS),
}
OF_A_LAGRANGIAN = (
    "lagrangian", "momenta", "momentum", "conserved", "constant", "energy_function_rate", "hamiltonian",
    "hamilton_equations", "routhian", "effective_potential",
)  # fmt: skip


def laws_of(steps: Sequence[Quantity], system: System, part: Any) -> list[str]:
    """Return the keys of the steps that state Newton's laws for one particle or body."""
    laws = [each for each in steps if each.step.rule in LAWS]
    return [each.key for each in laws if body_of(system, each.needed(OfCoordinate).coordinate.symbol).part == part]


def check_available(method: Word | None, asked: Sequence[Word], made: Mapping[Word, tuple[Word, ...]]) -> None:
    """Reject an answer that is derived from a Lagrangian if the method uses no Lagrangian."""
    if method is None or method in (LAGRANGE, BOTH):
        return
    for name in asked:
        of = next((each for each in needed_for([name], made) if _is_of_a_lagrangian(each)), None)
        if of is not None:
            message = f"`{of}` is derived from a Lagrangian, which `method: {method}` does not use"
            rejected("method", message, name.place, "let a part with `method: lagrange` ask for it")


def _is_of_a_lagrangian(name: str) -> bool:
    return any(name == each or name.startswith(f"{each}_") for each in OF_A_LAGRANGIAN)


def check_effect(method: Word | None, answers: Mapping[str, object]) -> None:
    """Reject a method that has no effect on the answers."""
    if method is None or method == LAGRANGE or not answers:
        return
    steps = with_ancestors(returned_quantities(list(answers.values())))
    if not any(each.step.rule in RULES[method] for each in steps.values()):
        if method == BOTH:
            message = "`method: both` shows Lagrange's equations only among the `equations_of_motion`"
            help_line = "ask for `equations_of_motion` in a part with this method, or write `method: newton`"
            rejected("method", f"{message}, and no part with this method asks for these", method.place, help_line)
        message = f"no answer here is derived by `method: {method}`, so it has no effect"
        rejected("method", message, method.place, "leave it out")


def check_one_law_for_each_key(found: Mapping[str, object], methods: Sequence[Word]) -> None:
    """Reject parts that derive the same step by different methods."""
    steps: dict[str, Quantity] = {}
    for answer in found.values():
        for each in with_ancestors(returned_quantities(answer)).values():
            if steps.setdefault(each.key, each).step != each.step:
                message = f"two parts derive `{each.key}` by different methods"
                rejected("method", message, methods[-1].place, "use one method for the problem, or `method: both`")
