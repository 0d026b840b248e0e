"""What a sentence tells besides its chain is checked: roles, formulas, the point that it names."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from sympy import ImmutableDenseMatrix, Integer, cos, pi, sin, sqrt, symbols, tan, zeros
from sympy.core.symbol import Str

from derive.algebra.expressions import TIME, Relation, rate, scalar
from derive.errors import Unverified
from derive.steps.establish import establish
from derive.steps.rule import RULES, Judged
from derive.steps.subject import Subject
from tests.mechanics.block import known_block
from tests.rules import stated_rightly

R, a, r, z, h, m, g = symbols("R a r z h m g", positive=True)
x, y, q, theta = (scalar(name) for name in ("x", "y", "q", "theta"))

MOMENTUM = known_block()["angular_momentum"]
KEPT = Relation(rate(q), "=", R)
FROM_CENTRE: dict[str, Any] = {
    "symbol": scalar("r_z"), "words": {"start": "centre"}, "subject": Subject(point=SimpleNamespace(name="centre"))
}  # fmt: skip
KEEPING = {"momentum": a * rate(q) + R, "value": g, "coordinate": q}


class Centre:
    name = "centre"


def cylindrical(**changed: Any) -> Judged:
    told = {"x_is": r * cos(theta), "y_is": r * sin(theta), "element": r, "names": [z, theta, r]}
    words = FROM_CENTRE["words"] | {"polar": "centre"}
    return Judged(R * z / h, told | changed, **(FROM_CENTRE | {"words": words}))


@pytest.mark.parametrize(
    "wrong", [{"x_is": -r * cos(theta)}, {"y_is": r}, {"x_is": r * sin(theta), "y_is": r * cos(theta)}]
)
def test_cylindrical_coordinates_are_judged_by_their_element(wrong: dict[str, Any]) -> None:
    assert stated_rightly("bodies.section_radius", "straight", cylindrical())
    assert not stated_rightly("bodies.section_radius", "straight", cylindrical(**wrong))


class Cone:
    ends = (Integer(0), h)

    @staticmethod
    def radius_at(height: Any) -> Any:
        return R * height / h


@pytest.mark.parametrize(("volume", "right"), [(pi * R**2 * h / 3, True), (pi * R**2 * h / 2, False)])
def test_a_volume_is_judged_by_its_cross_sections(volume: Any, right: bool) -> None:
    assert stated_rightly("bodies.volume", "cylindrical", Judged(volume, {}, subject=Subject(body=Cone()))) == right


def test_two_roles_of_a_rotation_cannot_be_exchanged() -> None:
    found = known_block()
    roles = {"inertia": found["inertia_tensor"], "omega": found["spin"]}
    other = {"inertia": found["spin"], "omega": found["inertia_tensor"]}
    assert stated_rightly("rotation.angular_momentum", "generic", Judged(Integer(1), quantities=roles))
    assert not stated_rightly("rotation.angular_momentum", "generic", Judged(Integer(1), quantities=other))


@pytest.mark.parametrize(("named", "right"), [("centre", True), ("corner", False)])
def test_the_point_that_is_named_is_the_one_of_the_result(named: str, right: bool) -> None:
    facts = Judged(Integer(1), subject=Subject(point=Centre()), words={"about": named})
    assert bool(stated_rightly("answers.let", "generic", facts)) is right


def test_two_moments_cannot_have_one_name() -> None:
    names = ImmutableDenseMatrix([scalar("I_1"), scalar("I_3"), scalar("I_3")])
    values = ImmutableDenseMatrix([a, a, R])
    with pytest.raises(Unverified, match="have the same name"):
        establish(RULES["answers.let"], names, lambda: values, {}, key="moments")


@pytest.mark.parametrize(
    ("rule", "right", "wrong"),
    [
        (
            "lagrange.value_kept",
            Judged(Relation(rate(q), "=", (g - R) / a), KEEPING),
            Judged(Relation(rate(q), "=", (g - R) / a), KEEPING | {"value": R}),
        ),
        ("answers.at", Judged(R, {"vector": zeros(3, 1)}), Judged(R, {"vector": R})),
        (
            "rotation.moment_of_inertia",
            Judged(R, subject=Subject(axis="z"), words={"axis": "z"}),
            Judged(R, subject=Subject(axis="z"), words={"axis": "corner"}),
        ),
        (
            "answers.roots_together",
            Judged(R, {"equation": KEPT, "unknown": rate(q)}),
            Judged(R, {"equation": q, "unknown": KEPT}),
        ),
        (
            "answers.roots_together",
            Judged(R, {"equation": KEPT, "unknown": rate(q)}),
            Judged(R, {"equation": KEPT, "unknown": x}),
        ),
        (
            "bodies.centre_component",
            Judged(R, {"along": Str("z")}, **FROM_CENTRE),
            Judged(R, {"along": Str("z")}, **(FROM_CENTRE | {"words": {"start": "corner"}})),
        ),
        (
            "bodies.section_radius",
            Judged(R, **FROM_CENTRE),
            Judged(R, **(FROM_CENTRE | {"words": {"start": "corner"}})),
        ),
    ],
)
def test_what_is_told_is_what_it_is_called(rule: str, right: Judged, wrong: Judged) -> None:
    assert stated_rightly(rule, "generic", right)
    assert not stated_rightly(rule, "generic", wrong)


@pytest.mark.parametrize("wrong", [Relation(R, "<=", 0), Relation(R, "<", a)])
def test_that_no_root_is_real_is_said_of_what_is_below_zero(wrong: Relation) -> None:
    assert stated_rightly("answers.one_of_two", "none", Judged(Relation(R, "<", 0)))
    assert not stated_rightly("answers.one_of_two", "none", Judged(wrong))


def test_a_long_diagonal_is_called_so() -> None:
    right, wrong = (Judged(R, words={"axis": name}) for name in ("diagonal", "corner"))
    assert stated_rightly("bodies.axis_vector", "diagonal", right)
    assert not stated_rightly("bodies.axis_vector", "diagonal", wrong)


@pytest.mark.parametrize("mark", ["<", ">", "!="])
def test_nothing_is_less_than_itself(mark: str) -> None:
    with pytest.raises(Unverified, match="can never hold"):
        establish(RULES["answers.let"], None, lambda: Relation(a, mark, a), {}, key="bound")


def test_the_component_along_the_axis_is_that_along_z() -> None:
    beside = Judged(R, {"along": Str("y")}, **(FROM_CENTRE | {"symbol": scalar("r_y")}))
    assert stated_rightly("bodies.centre_component", "on_axis", Judged(R, {"along": Str("z")}, **FROM_CENTRE))
    assert stated_rightly("bodies.centre_component", "generic", beside)
    assert not stated_rightly("bodies.centre_component", "on_axis", beside)
    assert not stated_rightly("bodies.centre_component", "generic", Judged(R, {"along": Str("y")}, **FROM_CENTRE))


@pytest.mark.parametrize(
    "rule", ["vibrations.period", "vibrations.beats", "rotation.radius_of_gyration", "vibrations.steady_amplitude"]
)
def test_what_is_a_size_is_not_negative(rule: str) -> None:
    of = {"equation": Relation(x, "=", 0), "q": x}
    assert stated_rightly(rule, "generic", Judged(a / R, of))
    assert not stated_rightly(rule, "generic", Judged(-a / R, of))


ROOTS = {"equation": Relation(a * q**2, "=", z), "unknown": q, "positive": Integer(0), "count": Integer(2)}


def test_a_root_is_real_where_it_is_said_to_be_and_nowhere_else() -> None:
    facts = {"symbol": scalar("q_1"), "words": {"asked": "roots"}}
    root = sqrt(x / a)
    assert stated_rightly("answers.roots", "several", Judged(root, ROOTS | {"condition": Relation(x, ">", 0)}, **facts))
    for told in ({}, {"condition": Relation(x, "<", 0)}, {"condition": Relation(a, ">", 0)}):
        assert not stated_rightly("answers.roots", "several", Judged(root, ROOTS | told, **facts))
    assert not stated_rightly("answers.roots", "several", Judged(R, ROOTS, **(facts | {"symbol": q})))


def test_a_motion_starts_as_its_sentence_says() -> None:
    of = {"equation": Relation(x, "=", 0), "q": x}
    start = {"start": Relation(x, "=", R), "start_rate": Relation(rate(x), "=", a)}
    assert stated_rightly("vibrations.solution", "uniform", Judged(R + a * TIME, of | start))
    assert not stated_rightly("vibrations.solution", "uniform", Judged(a + R * TIME, of | start))
    other = of | start | {"q": Relation(x, "=", 0)}
    assert not stated_rightly("vibrations.solution", "uniform", Judged(R + a * TIME, other))


def test_a_comparison_has_the_word_of_its_mark() -> None:
    at_most = {"words": {"comparison": "at_most"}}
    compared = {"quantity": R, "bound": a, "difference": R - a}
    assert stated_rightly("answers.where", "solved", Judged(R, {**compared, "mark": Str("<=")}, **at_most))
    assert not stated_rightly("answers.where", "solved", Judged(R, {**compared, "mark": Str("=")}, **at_most))


def test_a_quantity_is_compared_with_its_bound_and_not_the_other_way_round() -> None:
    turned = {"quantity": Integer(0), "bound": R, "difference": R, "mark": Str(">")}
    assert not stated_rightly("answers.where", "solved", Judged(R, turned, words={"comparison": "greater_than"}))


def test_the_tangent_of_a_lag_is_told_as_such() -> None:
    assert stated_rightly("vibrations.lag", "damped", Judged(R, symbol=tan(theta)))
    assert not stated_rightly("vibrations.lag", "damped", Judged(R, symbol=theta))


def test_the_given_number_fulfils_a_condition_just_where_it_is_said_to() -> None:
    for given, word, right in ((3, "fulfilled", True), (1, "fulfilled", False), (1, "not_fulfilled", True)):
        inputs = {"given": Relation(x, "=", Integer(given)), "condition": Relation(Integer(given), ">", Integer(2))}
        facts = Judged(Relation(x, ">", Integer(2)), inputs, words={"seen": word})
        assert stated_rightly("numeric.value", "measured", facts) == right
    other = {"given": Relation(x, "=", Integer(5)), "condition": Relation(Integer(3), ">", Integer(2))}
    assert not stated_rightly(
        "numeric.value", "measured", Judged(Relation(x, ">", Integer(2)), other, words={"seen": "fulfilled"})
    )
    assert stated_rightly("numeric.value", "measured", Judged(x, {}))
