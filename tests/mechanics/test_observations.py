"""Observations: each is found on a page, and the predicate of each refuses false variants."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from sympy import Expr, ImmutableDenseMatrix, Integer, Rational, Symbol, cos, eye, pi, sin, symbols

import derive.steps.establish as establishing
from derive.algebra.equality import Grade
from derive.algebra.expressions import Amount, Relation, explicit, rate
from derive.algebra.rounding import Rounded
from derive.building.solution import derived, rendered
from derive.course.problem import deriving, load_problem
from derive.mechanics import Particle, System, coordinate, lagrangian, point
from derive.mechanics.observations.frequencies import _has_polar_coordinates
from derive.mechanics.observations.selection import MOST, OBSERVATIONS
from derive.mechanics.observations.view import View
from derive.steps.record import Run, recorded
from derive.steps.rule import RULES, Judged, Rule
from tests.courses import ROOT
from tests.stock.described import course_with, edited

FOUND = [  # problem, part, rule, outcome
    ("library/kepler", 3, "orbit", "one"),
    ("library/oscillator_2d", 2, "orbit", "two"),
    ("library/table_with_hole", 3, "orbit", "letters"),
    ("library/cycloid", 2, "exact", "generic"),
    ("library/rod_pendulum", 2, "pendulum", "length"),
    ("library/spring_pendulum", 3, "pendulum", "named"),
    ("library/elevator", 3, "pendulum", "field"),
    ("library/turning_hoop", 3, "branches", "generic"),
    ("library/turning_parabola", 1, "anywhere", "generic"),
    ("library/parabolic_hill", 2, "one_sign", "generic"),
    ("library/leaning_rod", 1, "balanced", "generic"),
    ("library/race", 1, "order", "generic"),
    ("library/two_bodies", 2, "reduced", "generic"),
    ("hw9/euler", 0, "polhode", "generic"),
    ("library/ball_on_turntable", 1, "circling", "generic"),
    ("library/off_a_sphere", 2, "angle", "generic"),
    ("library/hoop_oscillations", 2, "below", "generic"),
    ("library/penning_trap", 1, "pair", "generic"),
    ("library/simple_pendulum", 3, "longer", "generic"),
    ("library/driven_support", 4, "resonance", "generic"),
    ("library/coupled_pendulums", 2, "unaffected", "spring"),
    ("library/triatomic_molecule", 2, "unaffected", "mass"),
    ("library/yoyo", 1, "familiar", "fall"),
    ("library/disc_incline", 1, "familiar", "incline"),
    ("library/sliding_to_rolling", 2, "independent", "generic"),
    ("library/ladder", 3, "independent", "angle"),
    ("library/hanging_mass", 2, "independent", "weight"),
    ("library/struck_rods", 1, "multiple", "generic"),
    ("library/hooke_3d", 1, "one_frequency", "generic"),
    ("library/double_pendulum", 3, "modes", "irrational"),
    ("library/hinge_force", 2, "zero_of", "changes_at_angle"),
    ("library/atwood", 1, "zero_of", "equal_masses"),
    ("library/plate_on_diagonal", 2, "zero_of", "touches"),
    ("library/triangular_plate", 2, "flat", "generic"),
]


@cache
def observed(problem_id: str) -> tuple[list[list[Any]], dict[tuple[str, str], tuple[Rule, Judged, dict[str, Any]]]]:
    """Return the observations of each part, and what the predicates of each of them judged."""
    judged: dict[tuple[str, str], tuple[Rule, Judged, dict[str, Any]]] = {}
    check = establishing._check_outcome
    named = establishing._check_named

    def of_outcome(key: str, rule: Rule, outcome: str, facts: Judged, may_be_zero: bool) -> None:
        check(key, rule, outcome, facts, may_be_zero)
        judged[rule.name, outcome] = (rule, facts, {})

    def of_names(key: str, rule: Rule, facts: Judged, told: Any) -> None:
        named(key, rule, facts, told)
        last = next(reversed(judged))
        judged[last] = (rule, facts, dict(told))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(establishing, "_check_outcome", of_outcome)
        patch.setattr(establishing, "_check_named", of_names)
        problem = load_problem(ROOT, problem_id)
        # derive chooses in all parts, also where the author wants no observations
        parts = tuple(replace(part, observations=None) for part in problem.parts)
        derivation, *_ = derived(replace(problem, parts=parts, observations=None))
    return [[derivation.step(key) for key in keys] for keys in derivation.observed], judged


@pytest.mark.parametrize(("problem_id", "part", "name", "outcome"), FOUND)
def test_a_page_states_this_observation(problem_id: str, part: int, name: str, outcome: str) -> None:
    parts, _ = observed(problem_id)
    assert (f"observations.{name}", outcome) in [(step.rule, step.outcome) for step in parts[part]]
    assert sum(map(len, parts)) <= MOST


def spoiled(value: Any) -> Iterator[Any]:
    """Yield false variants of an object that a sentence names."""
    if isinstance(value, Relation):
        changed = explicit(value.right) * Rational(11, 10) if explicit(value.right) != 0 else Integer(1)
        yield Relation(value.left, "=", changed)
    elif isinstance(value, Amount):
        number, figures = value.args[0].args
        yield Amount(Rounded(number + Rational(1, 10), figures), "degree", value.args[2])
    elif isinstance(value, Rounded):
        yield Rounded(value.args[0] + 1, value.args[1])
    elif isinstance(value, Symbol):
        yield Symbol("elsewhere", positive=True)
    elif isinstance(value, Expr):
        yield value * Rational(11, 10)


JUDGED_BY_NAMES = {
    "independent",
    "angle",
    "longer",
    "flat",
    "polhode",
}  # the outcome only requires that the names exist


@pytest.mark.parametrize(("problem_id", "part", "name", "outcome"), FOUND)
def test_false_variants_of_an_observation_are_refused(problem_id: str, part: int, name: str, outcome: str) -> None:
    rule, facts, told = observed(problem_id)[1][f"observations.{name}", outcome]
    with deriving(load_problem(ROOT, problem_id), Run()):
        _check_refused(rule, facts, told, name, outcome)


def _check_refused(rule: Rule, facts: Judged, told: dict[str, Any], name: str, outcome: str) -> None:
    assert rule.verdict(outcome, facts)
    refused = 0
    for role, value in told.items():
        for wrong in spoiled(value):
            changed = replace(facts, inputs={**facts.inputs, role: wrong})
            wrongly = rule.wrongly_named(changed, {**told, role: wrong})
            assert wrongly is not None or not rule.verdict(outcome, changed), (role, wrong)
            refused += 1
    for wrong in (
        spoiled(facts.result) if outcome != "field" and name not in {*JUDGED_BY_NAMES, *WITHOUT_RESULT} else ()
    ):
        assert not rule.verdict(outcome, replace(facts, result=wrong)), wrong
        refused += 1
    for wrong in SEEDED.get(name, lambda facts: [])(facts):
        assert not rule.verdict(outcome, wrong)
        refused += 1
    assert refused


WITHOUT_RESULT = {"exact", "one_frequency", "unaffected", "one_sign", "balanced", "pair", "below"}


def _with(facts: Judged, **inputs: Any) -> Judged:
    return replace(facts, inputs={**facts.inputs, **inputs})


def _other(facts: Judged, role: str, **changes: Any) -> Judged:
    """Return facts in which the quantity of a role has another value or step."""
    old = facts.quantities[role]
    known = {"value": old.value, "step": old.step, "symbol": old.symbol, "coordinates": old.coordinates}
    return replace(facts, quantities={**facts.quantities, role: SimpleNamespace(**{**known, **changes})})


def _uneven(facts: Judged) -> Judged:
    mass, stiffness = facts.inputs["system"]
    return _with(facts, system=(mass, stiffness + ImmutableDenseMatrix.diag(stiffness[0, 0], 0, 0)))


def _first(facts: Judged) -> ImmutableDenseMatrix:
    size = len(facts.quantities["shape"].value)
    return ImmutableDenseMatrix([Integer(n == 0) for n in range(size)])


def _one_sided(facts: Judged) -> Judged:
    """A force that changes its sign along the curve, as for a hill that becomes steeper."""
    of, q = facts.quantities["of"], facts.inputs["q"]
    b = next(s for s in of.value.free_symbols if str(s) == "b")
    return _other(facts, "of", value=explicit(of.value) * (q - b))


def _growing(facts: Judged) -> Judged:
    """Equations whose roots have the other sign, so that the two rates are growth rates."""
    mass, stiffness = facts.inputs["system"]
    return _with(facts, system=(mass, -stiffness))


@pytest.mark.parametrize(
    ("problem_id", "name", "grade"),
    [("library/parabolic_hill", "one_sign", Grade.SAMPLED), ("library/struck_rods", "multiple", Grade.PROVED)],
)
def test_a_statement_that_only_its_predicate_tests_is_not_called_proved(
    problem_id: str, name: str, grade: Grade
) -> None:
    steps = [step for part in observed(problem_id)[0] for step in part if step.rule == f"observations.{name}"]
    assert [step.grade for step in steps] == [grade]


def _with_further_zeros(facts: Judged) -> Judged:
    """A torque that also vanishes at two neighbouring angles, both about half a degree."""
    sine, value = sin(facts.inputs["angle"]), facts.quantities["of"].value
    factor = (sine - Rational(1, 100)) * (sine - Rational(101, 10**4))
    return _other(facts, "of", value=explicit(value) * factor)


SEEDED: dict[str, Any] = {
    "modes": lambda facts: [_growing(facts)],
    "exact": lambda facts: [
        _with(facts, energy=facts.inputs["energy"] + facts.inputs["energy"] ** 2 / 7),  # an anharmonic force
        _with(facts, square=facts.inputs["square"] * 2),
    ],
    "one_frequency": lambda facts: [
        _uneven(facts),
        _with(facts, motions=[facts.inputs["motions"][0] + facts.inputs["moving"][0] ** 3, *facts.inputs["motions"]]),
    ],
    "unaffected": lambda facts: [
        _other(
            facts, "shape", value=ImmutableDenseMatrix([1, *[Integer(-2)] * (len(facts.quantities["shape"].value) - 1)])
        )
    ],
    "one_sign": lambda facts: [_one_sided(facts)],
    "balanced": lambda facts: [
        _with(facts, place_3=Relation(facts.inputs["angle"], "=", Integer(1))),
        _with(facts, place_2=Relation(facts.inputs["angle"], "=", pi / 4)),
        _with_further_zeros(facts),
    ],
    "pair": lambda facts: [_with(facts, product=Relation(facts.inputs["product"].left, "=", Integer(1)))],
    "below": lambda facts: [_with(facts, letter=Symbol("v", positive=True))],
    "flat": lambda facts: [_other(facts, "of", value=eye(3))],
    "order": lambda facts: [
        replace(
            facts,
            quantities={**facts.quantities, "case_1": facts.quantities["case_2"], "case_2": facts.quantities["case_1"]},
        )
    ],
}


def test_every_kind_of_observation_is_on_some_page() -> None:
    names = {name for _, _, name, _ in FOUND}
    assert {rule.rpartition(".")[2] for rule in RULES if rule.startswith("observations.")} == names
    assert {kind.found.__name__ for kind in OBSERVATIONS} == names


@pytest.mark.parametrize("problem_id", ["library/steady_precession", "library/two_balls", "library/pendulum_canonical"])
def test_a_page_without_a_true_and_useful_observation_has_none(problem_id: str) -> None:
    assert not any(observed(problem_id)[0])


NAIL = """\
title: A bead at a nail
solve: system
symbols: {m: mass, k: spring constant, b: length}
given:
  coordinates: {x: length, y: length}
  particles: {bead: {mass: m, at: [x, y]}}
  potential: k*(x**2 + y**2)/2 + k*x**4/b**2
statement: A bead of mass <<m>>.
parts:
  - ask: Find the frequency.
    answer: [equations_of_motion, frequency]
"""


@pytest.mark.parametrize(("force", "said"), [("", True), (" + k*x**4/b**2", False)])
def test_only_orbits_of_an_exactly_linear_motion_are_ellipses(tmp_path: Path, force: str, said: bool) -> None:
    """A force of third order leaves the small oscillations as they are, but changes each orbit."""
    text = edited(NAIL, (" + k*x**4/b**2", force))
    page = rendered(course_with(tmp_path, text), "trial/one", only={"text"}).texts["text"]
    assert ("every orbit is an ellipse" in page) is said


@pytest.mark.parametrize(("places", "said"), [("", True), (", z", False)])
def test_only_a_motion_in_polar_coordinates_of_a_plane_has_a_closed_orbit(places: str, said: bool) -> None:
    """The radius and the angle alone do not decide whether a motion in space closes."""
    with recorded():
        r, z = coordinate("r", "length", positive=True).symbol, coordinate("z", "length").symbol
        phi = coordinate("phi").symbol
        along = (r * cos(phi), r * sin(phi), *([z] if places else []))
        found = lagrangian(System(Particle(symbols("m", positive=True), point(*along))))
    assert _has_polar_coordinates(View((), (found,), (found,), {})) is said


MACHINE = """\
title: A machine
solve: system
symbols: {m_1: mass, m_2: mass, l: length, g: acceleration}
given:
  coordinates: {x: length}
  particles: {one: {mass: m_1, at: [0, -x]}, other: {mass: m_2, at: [1, x - l]}}
  gravity: g
  assume: [m_1 < m_2]
statement: Two masses <<m_1>> and <<m_2>>.
parts:
  - ask: Find the acceleration.
    answer: acceleration_x
"""


@pytest.mark.parametrize(("relation", "said"), [("m_1 < m_2", False), ("m_1 < 2*m_2", True)])
def test_a_value_that_the_assumptions_exclude_is_not_stated(tmp_path: Path, relation: str, said: bool) -> None:
    """The acceleration vanishes for m_1 = m_2; a page that assumes m_1 < m_2 does not say so."""
    text = edited(MACHINE, ("assume: [m_1 < m_2]", f"assume: [{relation}]"), ("at: [1, x - l]", "at: [l, x - l]"))
    page = rendered(course_with(tmp_path, text), "trial/one", only={"text"}).texts["text"]
    assert ("vanishes; if they differ" in page) is said


HELIX = """\
title: A charge in a magnetic field
solve: system
symbols: {m: mass, q: charge, B: magnetic field}
given:
  coordinates: {x: length, y: length, z: length}
  particles: {ion: {mass: m, at: [x, y, z]}}
  charges: {charge: q, at: [x, y, z], magnetic: [0, 0, B]}
statement: An ion of mass <<m>> and charge <<q>> moves in the field <<B>>.
parts:
  - ask: Find the accelerations.
    answer: accelerations
"""


@pytest.mark.parametrize("flat", [False, True])
def test_a_charge_that_may_move_along_the_field_does_not_describe_a_circle(tmp_path: Path, flat: bool) -> None:
    """The path is a helix; in a plane perpendicular to the field it is a circle."""
    plane = [
        ("y: length, z: length", "y: length"),
        ("mass: m, at: [x, y, z]", "mass: m, at: [x, y, 0]"),
        ("charge: q, at: [x, y, z]", "charge: q, at: [x, y, 0]"),
    ]
    text = edited(HELIX, *plane) if flat else HELIX
    page = rendered(course_with(tmp_path, text), "trial/one", only={"text"}).texts["text"]
    assert ("circular motion" in page) is flat, page


LEANING = (ROOT / "problems" / "library" / "rotation" / "leaning_rod.yaml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("lies", "said"), [(" in [0, pi/2]", True), (" in (0, pi/2)", False), (" in [0, pi/4]", False), ("", True)]
)
def test_a_rod_is_balanced_only_at_angles_in_the_declared_range(tmp_path: Path, lies: str, said: bool) -> None:
    greatest = LEANING[LEANING.index("  - ask: At which angle is the torque greatest") : LEANING.index("note: >")]
    words = LEANING[LEANING.index("  greatest_alpha: >-") : LEANING.index("  angular_momentum: >-")]
    result = "  results:\n    greatest: {maximum: torque_size, for: alpha, within: [0, pi/2]}\n"
    lie = ("angle in [0, pi/2]", f"angle{lies}")
    text = edited(LEANING, lie, (greatest, ""), (words, ""), (result, ""), ("points: 8", "points: 7"))
    page = rendered(course_with(tmp_path, text), "trial/one", only={"text"}).texts["text"]
    assert ("The torque vanishes for α = 0 and for α = π/2, and for no angle between them." in page) is said


def _case(facts: Judged, **changes: Any) -> Judged:
    """Return facts of an order in which one value of the first case has changed."""
    step = facts.quantities["case_1"].step
    return _other(facts, "case_1", step=SimpleNamespace(rule=step.rule, roles=(*step.roles, *changes.items())))


def test_the_first_body_to_arrive_is_stated_only_for_one_symbol_that_does_not_change_the_path() -> None:
    """With a second value, or a length as the symbol, the cases may differ in the distance."""
    rule, facts, _ = observed("library/race")[1]["observations.order", "generic"]
    with deriving(load_problem(ROOT, "library/race"), Run()):
        assert rule.verdict("generic", facts)
        assert not rule.verdict("generic", _case(facts, value_2=Relation(Symbol("l"), "=", Integer(2))))
        assert not rule.verdict("generic", _with(facts, kind="length"))


def test_a_force_with_a_rate_has_no_known_sign() -> None:
    rule, facts, _ = observed("library/parabolic_hill")[1]["observations.one_sign", "generic"]
    of = facts.quantities["of"]
    assert rule.verdict("generic", facts)
    assert not rule.verdict("generic", _other(facts, "of", value=explicit(of.value) + rate(facts.inputs["q"]) ** 2))


def test_a_period_that_becomes_longer_is_not_stated_with_a_negative_percentage() -> None:
    rule, facts, told = observed("library/simple_pendulum")[1]["observations.longer", "generic"]
    name, percent = next((role, value) for role, value in told.items() if isinstance(value, Rounded))
    assert rule.wrongly_named(facts, told) is None
    for wrong in (-percent.args[0], percent.args[0] + Rational(1, 10), Integer(0)):
        assert rule.wrongly_named(facts, {**told, name: Rounded(wrong, percent.args[1])}) is not None
