"""Static friction: the condition |F| <= mu_s N, and the place where a motion first violates it."""

from __future__ import annotations

import re
from math import cos, sin, sqrt
from pathlib import Path
from typing import Any

import pytest
from sympy import Expr, Symbol

from derive.algebra.expressions import Relation, explicit
from derive.building.solution import rendered
from derive.course.problem import run_solve
from derive.errors import DeriveError
from derive.mechanics.answers import slipping_in_state
from derive.mechanics.model import contacts
from derive.mechanics.model.constraint import Constraint, StaticLimit
from derive.mechanics.motion import slipping
from derive.mechanics.motion.static_friction import Friction
from derive.steps.record import Run
from derive.witness import runs
from tests.courses import ROOT
from tests.stock.described import course_with, edited, loaded, messages, solved

NUMBERS = {"m": 1.3, "M": 2.1, "g": 9.8, "mu_s": 0.4, "alpha": 0.6, "theta_0": 0.9}

BLOCK = """\
title: A block
solve: system
symbols: {m: mass, M: mass, a: length, g: acceleration, alpha: 'angle in (0, pi/2)', mu_s: positive number, P: force}
given:
  coordinates: {x: length, y: length}
  particles: {block: {mass: m, at: [x, y]}}
  gravity: g
  surfaces: {incline: {through: [0, 0], along: [cos(alpha), -sin(alpha)]}}
  contacts: {of: block, on: incline, normal: N, friction: {static: mu_s, force: F}}
  results:
    slip: {slips: F, for: mu_s}
statement: A block.
parts:
  - ask: Does it slip?
    answer: slip
"""

# a ball rolls from the top of a sphere: N = m g (17 cos(theta) - 10)/7 and F = -2/7 m g sin(theta)
SPHERE = """\
title: A ball on a sphere
solve: system
symbols: {m: mass, a: length, R: length, g: acceleration, mu_s: positive number}
given:
  coordinates: {r: positive length, theta: 'angle in (0, pi/2)', phi: angle}
  bodies: {ball: {shape: ball, radius: a, mass: m, centre: [r*sin(theta), r*cos(theta)], turned: -phi}}
  gravity: g
  surfaces: {sphere: {centre: [0, 0], radius: R}}
  contacts: {of: ball, on: sphere, normal: N, friction: {static: mu_s, force: F}}
  results:
    energy: {put_in: energy_function, values: {r: R + a, r_dot: 0, phi_dot: (R + a)*theta_dot/a}}
    speed: {speed: energy, for: theta, start: 0, results: acceleration_theta}
    slip: {slips: F, results: speed, for: cos(theta)}
statement: A ball on a sphere.
parts:
  - ask: Where does it slip?
    answer: slip
"""

# a ball rolls in a bowl from rest at theta_0: N = m g (17 cos(theta) - 10 cos(theta_0))/7 and F = 2/7 m g sin(theta)
BOWL = """\
title: A ball in a bowl
solve: system
symbols: {m: mass, a: length, b: length, g: acceleration, mu_s: positive number, theta_0: 'angle in (0, pi/2)'}
given:
  coordinates: {r: positive length, theta: 'angle in (-pi/2, pi/2)', phi: angle}
  bodies: {ball: {shape: ball, radius: a, mass: m, centre: [r*sin(theta), -r*cos(theta)], turned: -phi}}
  gravity: g
  surfaces: {bowl: {centre: [0, 0], radius: a + b, side: inside}}
  contacts: {of: ball, on: bowl, normal: N, friction: {static: mu_s, force: F}}
  results:
    energy: {put_in: energy_function, values: {r: b, r_dot: 0, phi_dot: -b*theta_dot/a}}
    speed: {speed: energy, for: theta, start: theta_0, results: acceleration_theta}
    slip: {slips: F, results: speed, for: cos(theta)}
statement: A ball in a bowl.
parts:
  - ask: Where does it slip?
    answer: slip
"""


def library(name: str) -> str:
    return (ROOT / "problems" / "library" / "contacts" / f"{name}.yaml").read_text(encoding="utf-8")


def told(folder: Path, text: str, key: str = "slip") -> tuple[str, Relation, str | None]:
    """Return the outcome, the result, and the sense of the slip."""
    step = solved(folder, text)[key]
    return step.step.outcome, explicit(step.value), dict(step.step.words).get("sense")


def number(value: Expr) -> float:
    return float(value.xreplace({letter: NUMBERS[letter.name] for letter in value.free_symbols}).evalf())


# --- forces in one state ---


def test_the_least_coefficient_for_a_block_at_rest(tmp_path: Path) -> None:
    outcome, result, sense = told(tmp_path, BLOCK)
    assert (outcome, sense) == ("sticks", "down") and str(result) == "mu_s >= tan(alpha)"


def test_the_greatest_angle_for_a_block_at_rest(tmp_path: Path) -> None:
    outcome, result, sense = told(tmp_path, library("block_on_incline"), "steepest")
    assert (outcome, sense) == ("sticks", "down") and str(result) == "tan(alpha) <= mu_s"


def test_the_least_coefficient_for_a_rolling_cylinder(tmp_path: Path) -> None:
    outcome, result, sense = told(tmp_path, library("rough_cylinder"), "needed")
    assert (outcome, sense) == ("sticks", "down") and str(result) == "mu_s >= tan(alpha)/3"


def test_a_ladder_at_rest(tmp_path: Path) -> None:
    outcome, result, sense = told(tmp_path, library("ladder_at_rest"), "flattest")
    assert (outcome, sense) == ("sticks", "right") and str(result) == "tan(theta) >= 1/(2*mu_s)"


PULLED = ("  results:\n", "  forces: {components: [-P*cos(alpha), P*sin(alpha)], at: block}\n  results:\n")


def test_a_friction_of_unknown_sign_has_a_condition_for_each_sense(tmp_path: Path) -> None:
    text = edited(BLOCK, PULLED, ("for: mu_s", "for: P"))
    outcome, up, sense = told(tmp_path, text, "slip_1")
    assert (outcome, sense) == ("sticks", "up")
    weight = NUMBERS["m"] * NUMBERS["g"]
    assert (str(up.left), up.operator) == ("P", "<=")
    assert number(up.right) == pytest.approx(weight * (sin(0.6) + 0.4 * cos(0.6)))
    outcome, down, sense = told(tmp_path, text, "slip_2")
    assert (outcome, sense) == ("sticks", "down")
    assert (str(down.left), down.operator) == ("P", ">=")
    assert number(down.right) == pytest.approx(weight * (sin(0.6) - 0.4 * cos(0.6)))


@pytest.mark.parametrize(
    ("edits", "outcome"),
    [
        ([("along: [cos(alpha), -sin(alpha)]", "along: [1, 0]")], "needs_none"),
        ([("static: mu_s", "static: 2"), ("(0, pi/2)", "(0, pi/4)"), ("for: mu_s", "for: tan(alpha)")], "always"),
        ([("static: mu_s", "static: 1"), ("(0, pi/2)", "(pi/3, pi/2)"), ("for: mu_s", "for: tan(alpha)")], "cannot"),
    ],
)
def test_outcomes_that_need_no_condition(edits: list[tuple[str, str]], outcome: str, tmp_path: Path) -> None:
    assert told(tmp_path, edited(BLOCK, *edits))[0] == outcome


def test_a_block_on_a_plank_that_is_pulled(tmp_path: Path) -> None:
    text = edited(
        BLOCK,
        ("{x: length, y: length}", "{X: length, x: length, y: length}"),
        ("{block: {", "{plank: {mass: M, at: [X, 0]}, block: {"),
        ("through: [0, 0], along: [cos(alpha), -sin(alpha)]", "through: plank, along: [1, 0], of: plank"),
        ("  results:\n", "  forces: {components: [P, 0], at: plank}\n  results:\n"),
        ("P: force", "P: positive force"),
        ("for: mu_s", "for: P"),
    )
    outcome, result, sense = told(tmp_path, text)
    assert (outcome, sense, result.operator) == ("sticks", "left", "<=")
    assert number(result.right) == pytest.approx(0.4 * (1.3 + 2.1) * 9.8)


# --- along a motion ---


@pytest.mark.long
def test_a_rod_slips_over_the_edge_of_a_table(tmp_path: Path) -> None:
    outcome, result, sense = told(tmp_path, library("rod_over_edge"))
    assert (outcome, sense) == ("slips", "down")
    assert str(result) == "tan(theta) = mu_s/2"


def test_a_ball_slips_before_it_leaves_a_sphere(tmp_path: Path) -> None:
    outcome, result, sense = told(tmp_path, SPHERE)
    assert (outcome, sense) == ("slips_squared", "down")
    expected = (170 * 0.4**2 + 2 * sqrt(189 * 0.4**2 + 4)) / (289 * 0.4**2 + 4)
    assert number(result.right) == pytest.approx(expected)


def test_a_ball_in_a_bowl_does_not_slip_if_it_does_not_at_the_start(tmp_path: Path) -> None:
    step = solved(tmp_path, BOWL)["slip"]
    assert step.step.outcome == "stays"
    starts = dict(step.step.roles)["starts"]
    assert starts.operator == ">"
    assert number(starts.residual) == pytest.approx(7 * 0.4 * cos(0.9) - 2 * sin(0.9))


def test_a_ball_that_slips_at_the_start(tmp_path: Path) -> None:
    text = edited(BOWL, ("start: theta_0", "start: pi/3"), ("static: mu_s", "static: 0.1"))
    assert told(tmp_path, text)[0] == "at_once"


# --- wrong laws ---


def page(folder: Path, text: str) -> str:
    return " ".join(rendered(course_with(folder, text), "trial/one", only={"text"}).texts["text"].split())


def refused(folder: Path, text: str) -> str:
    with pytest.raises(DeriveError) as error:
        solved(folder, text)
    return str(error.value)


def test_a_condition_without_the_sign_of_the_friction_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    condition = slipping._condition
    monkeypatch.setattr(
        slipping, "_condition", lambda contact, unknown, side, key, alone: condition(contact, unknown, 1, key, alone)
    )
    assert "sentence for this result could not be confirmed" in refused(tmp_path, BLOCK)


def test_the_normal_force_of_another_contact_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = library("ladder_at_rest")
    beside = slipping_in_state._beside
    monkeypatch.setattr(slipping_in_state, "_beside", lambda friction, _: beside(friction, Symbol("K", real=True)))
    assert "is not the normal force of this contact" in refused(tmp_path, text)


def test_a_limit_by_the_normal_force_of_another_contact_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    limit = contacts.StaticLimit
    other = Symbol("K", real=True)
    monkeypatch.setattr(contacts, "StaticLimit", lambda coefficient, _, **more: limit(coefficient, other, **more))
    text = edited(library("ladder_at_rest"), ("for: tan(theta)", "for: mu_s"))
    assert "could not be confirmed" in refused(tmp_path, text)


def test_a_reversed_condition_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    solution = slipping.solved_for_limit

    def reversed_(*given: Any) -> Relation:
        found = solution(*given)
        return Relation(found.left, {"<=": ">=", ">=": "<="}[found.operator], found.right)

    monkeypatch.setattr(slipping, "solved_for_limit", reversed_)
    assert "does not follow" in refused(tmp_path, BLOCK)


def test_a_law_that_is_reversed_in_all_lines_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    excess = Friction.excess
    monkeypatch.setattr(Friction, "excess", lambda self, side: -excess(self, side))
    text = edited(BLOCK, ("static: mu_s", "static: 2"), ("(0, pi/2)", "(0, pi/4)"), ("for: mu_s", "for: tan(alpha)"))
    assert "`points` disagrees" in refused(tmp_path, text) or "could not be confirmed" in refused(tmp_path, text)


def test_the_opposite_sense_of_the_slip_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sense = Constraint.sense
    monkeypatch.setattr(Constraint, "sense", lambda self, side: sense(self, -side))
    assert "could not be confirmed" in refused(tmp_path, BLOCK)


def test_another_name_for_the_body_that_slips_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(StaticLimit, "words", property(lambda self: {"slider": "ladder"}))
    assert "could not be confirmed" in refused(tmp_path, BLOCK)


def test_the_sentence_names_the_body_as_the_statement_does(tmp_path: Path) -> None:
    named = "The block does not slip down as long as"
    own_words = re.sub(r"^wording:\n(  .*\n)+", "", library("block_on_incline"), flags=re.MULTILINE)
    assert named in page(tmp_path, own_words)
    known, _, statement = own_words.partition("statement:")
    unnamed = f"{known}statement:{statement.replace('block', 'stone')}"
    assert named.replace("block", "body") in page(tmp_path, unnamed), "the statement has no block"


INCLINE = """\
title: A block on a rough incline
solve: system
symbols: {m: mass, g: acceleration, alpha: 'angle in (0, pi/2)', mu_s: positive number}
given:
  coordinates: {x: length, y: length}
  particles: {block: {mass: m, at: [x, y]}}
  gravity: g
  surfaces: {incline: {through: [0, 0], along: [cos(alpha), -sin(alpha)]}}
  contacts: {of: block, on: incline, normal: N, friction: {static: mu_s, force: F}}
statement: A block of mass <<m>> is at rest on an incline at the angle <<alpha>> to the horizontal.
parts:
  - ask: Find the normal force and the friction, positive down the incline.
    answer: [N, F]
"""


def test_a_negative_force_is_said_to_act_the_other_way(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert "The force F is negative: it acts up the slope (Figure 1)." in page(tmp_path, INCLINE)
    sense = Constraint.sense
    monkeypatch.setattr(Constraint, "sense", lambda self, side: sense(self, -side))
    assert "could not be confirmed" in refused(tmp_path, INCLINE)


def test_an_oblique_force_that_is_not_friction_is_not_said_to_act_upwards(tmp_path: Path) -> None:
    """The rail pushes the block along its normal: upwards, but also to the right."""
    rail = edited(
        INCLINE,
        ("along: [cos(alpha), -sin(alpha)]}", "along: [-cos(alpha), sin(alpha)], side: both}"),
        (", friction: {static: mu_s, force: F}", ""),
        (", mu_s: positive number", ""),
        ("normal force and the friction, positive down the incline.", "normal force."),
        ("[N, F]", "N"),
    )
    said = page(tmp_path, rail)
    assert "-m g cos α" in said
    assert "The force N" not in said


def test_a_place_that_is_not_the_first_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(slipping, "index_of_first", lambda motion, places: 1)
    assert "slip" in refused(tmp_path, SPHERE)


def test_the_witness_refutes_another_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The simulated motion slips where |F| reaches mu_s N, here replaced by (mu_s - 1/5) N."""
    margin = runs._margin
    monkeypatch.setattr(runs, "_margin", lambda claim: margin(claim) - claim.judged.quantities["normal"].symbol / 5)
    assert "in the described motion the body begins to slip at" in refused(tmp_path, library("rod_over_edge"))


# --- what the page states, and mistakes ---


def assumed(folder: Path, text: str) -> list[str]:
    run = Run()
    run_solve(loaded(folder, text), run)
    return [str(explicit(each)) for each in run.assumed]


WITHOUT = ("  results:\n    slip: {slips: F, for: mu_s}\n", "")


def test_the_page_states_the_condition_of_a_motion_without_slip(tmp_path: Path) -> None:
    forces = edited(BLOCK, WITHOUT, ("answer: slip", "answer: accelerations"))
    assert "mu_s >= tan(alpha)" in assumed(tmp_path, forces)
    equations = edited(BLOCK, WITHOUT, ("answer: slip", "answer: equations_of_motion"))
    assert "Abs(F) <= N*mu_s" in assumed(tmp_path, equations)
    assert not any("tan" in each for each in assumed(tmp_path, BLOCK))  # a part asks for the condition


def test_a_static_friction_that_is_too_large_is_an_error(tmp_path: Path) -> None:
    steep = edited(BLOCK, WITHOUT, ("answer: slip", "answer: N"), ("static: mu_s", "static: 0.3"))
    steep = steep.replace("alpha)", "60 deg)")
    (said,) = messages(tmp_path, steep)
    assert "9: the body slips: static friction is at most" in said


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("slips: F", "slips: N", "is not the friction of a contact with a coefficient"),
        ("for: mu_s", "for: g", "cannot be solved for g"),
        ("for: mu_s", "for: mu_s, values: {P: 0}", "does not contain `P`"),
        ("for: mu_s", "for: mu_s, results: acceleration_x", "would change neither the friction"),
        ("{static: mu_s, force: F}", "{static: mu_s, force: N}", "already denotes something else"),
        ("at: [x, y]", "at: [x, -x*tan(alpha)]", "does not appear"),
    ],
)
def test_a_question_that_cannot_be_meant_is_told(old: str, new: str, said: str, tmp_path: Path) -> None:
    text = edited(BLOCK, (old, new))
    text = text.replace(", y: length}", "}") if "tan(alpha)]" in new else text
    assert any(said in each for each in messages(tmp_path, text))


def test_only_a_fixed_corner_may_touch_a_body(tmp_path: Path) -> None:
    text = library("rod_over_edge")
    assert any("needs a particle" in each for each in messages(tmp_path, edited(text, ("of: [0, 0]", "of: [d, 0]"))))


def test_a_slip_whose_place_depends_on_the_letters_is_refused(tmp_path: Path) -> None:
    """A falling stick slips backwards if mu_s is small, and forwards if it is large: no closed form either way."""
    text = (ROOT / "tests" / "mechanics" / "falling_stick.yaml").read_text(encoding="utf-8")
    assert any("cannot be solved for cos(theta)" in each for each in messages(tmp_path, text))


CEILING = edited(
    BLOCK,
    ("alpha: 'angle in (0, pi/2)', mu_s: positive number, P: force}", "mu_s: 'number in (0, 1/2)', P: positive force}"),
    ("incline: {through: [0, 0], along: [cos(alpha), -sin(alpha)]}", "incline: {through: [0, 0], along: [-1, 0]}"),
    ("  gravity: g\n", "  gravity: g\n  forces: {components: [P/2, P], at: block}\n"),
    ("for: mu_s", "for: P"),
)


def test_a_bound_that_the_letter_cannot_satisfy_is_not_a_condition(tmp_path: Path) -> None:
    """P/2 <= mu_s (P - m g) means P <= -2 m g mu_s/(1 - 2 mu_s) for mu_s < 1/2, which no positive P satisfies."""
    assert solved(tmp_path, CEILING)["slip"].step.outcome == "cannot"


RAIL = edited(BLOCK, ("-sin(alpha)]}", "-sin(alpha)], side: both}"))


def test_static_friction_on_a_rail_that_is_known_to_push(tmp_path: Path) -> None:
    assert str(solved(tmp_path, RAIL)["slip"].value) == "mu_s >= tan(alpha)"


def test_a_rail_may_also_pull(tmp_path: Path) -> None:
    equations = edited(RAIL, WITHOUT, ("answer: slip", "answer: equations_of_motion"))
    assert "Abs(F) <= mu_s*Abs(N)" in assumed(tmp_path, equations)
    lifted = edited(RAIL, ("  gravity: g\n", "  gravity: g\n  forces: {components: [0, P], at: block}\n"))
    assert any("is not known to be positive" in each for each in messages(tmp_path, lifted))
    without = edited(lifted, WITHOUT, ("answer: slip", "answer: [F, N]"))
    assert "Abs(F) <= mu_s*Abs(N)" in assumed(tmp_path, without)


IN_SPACE = edited(
    BLOCK,
    ("{x: length, y: length}", "{x: length, y: length, z: length}"),
    ("at: [x, y]", "at: [x, y, z]"),
    (
        "{through: [0, 0], along: [cos(alpha), -sin(alpha)]}",
        "{through: [0, 0, 0], normal: [sin(alpha), 0, cos(alpha)]}",
    ),
    WITHOUT,
    ("answer: slip", "answer: [F_x, F_y, N]"),
)


def test_the_magnitude_of_static_friction_in_space_has_a_limit(tmp_path: Path) -> None:
    assert "sqrt(F_x**2 + F_y**2) <= N*mu_s" in assumed(tmp_path, IN_SPACE)
    asked = edited(
        IN_SPACE, ("statement: A", "  results: {s: {slips: F_x, for: mu_s}}\nstatement: A"), ("[F_x,", "[s, F_x,")
    )
    assert any("only one component of the friction" in each for each in messages(tmp_path, asked))
    steep = IN_SPACE.replace("static: mu_s", "static: 0.3").replace("(alpha)", "(60 deg)")
    assert any("the square of the static friction is at most" in each for each in messages(tmp_path, steep))


def test_a_friction_that_is_not_along_a_surface_in_space_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = contacts._ways_along
    monkeypatch.setattr(contacts, "_ways_along", lambda touch: {**right(touch), "y": touch.normal})
    with pytest.raises(DeriveError):
        solved(tmp_path, IN_SPACE)


PEG = """\
title: A rod on a peg
solve: system
method: newton
symbols: {m: mass, l: length, h: length, g: acceleration, mu: positive number}
given:
  coordinates: {x: length, y: length, theta: 'angle in (0, pi/2)'}
  bodies: {rod: {shape: rod, length: l, mass: m, along: [cos(theta), sin(theta)], from: [x, y]}}
  gravity: g
  surfaces:
    floor: {through: [0, 0], along: [1, 0]}
    under: {through: rod, along: [-cos(theta), -sin(theta)], of: rod}
  contacts:
    - {of: rod.end, on: floor, normal: N, friction: {static: mu, force: F}}
    - {of: [0, h], on: under, normal: K}
  results:
    slip: {slips: rest_F, for: mu}
statement: A rod leans on a smooth peg and stands on a rough floor.
parts:
  - ask: When does it not slip?
    answer: slip
"""


def test_the_condition_holds_if_only_the_product_of_the_factors_of_n_is_known_to_be_positive(tmp_path: Path) -> None:
    result = solved(tmp_path, PEG)["slip_1"].value
    assert isinstance(result, Relation) and result.operator == ">="
    h, l, theta = 1.0, 2.5, 0.8
    numbers = {"h": h, "l": l, "theta": theta, "x": -h * cos(theta) / sin(theta), "y": 0.0}
    K = l * sin(theta) * cos(theta) / (2 * h)  # the force of the peg in units of m g
    wanted = K * sin(theta) / (1 - K * cos(theta))
    right = explicit(result.right)
    assert float(right.subs({s: numbers[s.name] for s in right.free_symbols})) == pytest.approx(wanted)
