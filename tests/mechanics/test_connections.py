"""Contacts, strings and massless rods: compared with Newton's and Euler's laws in random states."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import pytest
from sympy import Expr, Integer, Pow, Symbol, cos, lambdify, sin, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import explicit
from derive.course.problem import run_solve
from derive.errors import DeriveError
from derive.mechanics.bodies.placed import PlacedBody
from derive.mechanics.model import contact_points, contacts, joints, strings, surfaces
from derive.mechanics.model.contacts import Contact
from derive.mechanics.model.surfaces import Curve
from derive.steps.record import Run
from tests.courses import ROOT
from tests.newton_euler.in_space import in_space, sliding_in_space
from tests.newton_euler.laws import solved as newton
from tests.newton_euler.random_systems import Trial, key_of, on_a_curve, on_a_surface, problem, with_strings
from tests.stock.described import complaints, edited, loaded, messages, solved


def on_a_surface_called(name: str) -> Trial:
    return next(trial for trial in on_a_surface() if trial.name == name)


TRIALS = [*on_a_surface(), *on_a_curve(), *with_strings(), *in_space(), *sliding_in_space()]
STATES = 4


@pytest.mark.parametrize("trial", TRIALS, ids=lambda trial: trial.name)
def test_accelerations_and_forces_are_those_of_newton_and_euler(trial: Trial, tmp_path: Path) -> None:
    steps = solved(tmp_path, problem(trial))
    keys = {name: key_of(name) for name in trial.unknowns}
    for seed in range(STATES):
        numbers, wanted = trial.state(Random(f"{trial.name} {seed}"))
        found = {name: value_at(explicit(steps[key].value), numbers) for name, key in keys.items()}
        assert found == pytest.approx({name: wanted[name] for name in trial.unknowns}, rel=1e-6, abs=1e-6)


def value_at(value: Expr, numbers: dict[str, float]) -> float:
    letters = sorted(value.free_symbols, key=str)
    return float(lambdify(letters, value, "math")(*(numbers[letter.name] for letter in letters)))


WEDGE = on_a_surface_called("disc-wedge-rolling")
SLIDES = on_a_surface_called("ball-floor-sliding")
MOVABLE = next(trial for trial in TRIALS if trial.name == "movable pulley")


def refused(folder: Path, trial: Trial) -> str:
    with pytest.raises(DeriveError) as error:
        solved(folder, problem(trial))
    return str(error.value)


def test_a_contact_without_the_opposite_force_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pair = Contact.pair
    monkeypatch.setattr(Contact, "pair", lambda *given: pair(*given)[:1])
    assert "`virtual_work` disagrees" in refused(tmp_path, WEDGE)


def test_friction_at_the_centre_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class AtCentre(Contact):
        def __init__(self, *given: Any, **named: Any) -> None:
            super().__init__(*given, **named)
            object.__setattr__(self, "at", self.of.centre)

    monkeypatch.setattr(contacts, "Contact", AtCentre)
    assert "not on the surface of the body" in refused(tmp_path, SLIDES)


def test_a_normal_that_is_not_a_unit_vector_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(surfaces, "unit", lambda verb, along: along)
    assert "not a unit vector" in refused(tmp_path, on_a_surface_called("disc-incline-none"))


def test_rolling_without_the_velocity_of_the_surface_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    velocity = contacts.velocity_at
    still = lambda of, at: velocity(of if isinstance(of, PlacedBody) else None, at)  # noqa: E731
    monkeypatch.setattr(contacts, "velocity_at", still)
    assert "not the relative velocity" in refused(tmp_path, WEDGE)


def trial_called(name: str) -> Trial:
    return next(trial for trial in TRIALS if trial.name == name)


def test_a_normal_of_a_curve_that_is_not_a_unit_vector_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    normal = Curve.normal
    long = lambda self, at: self.gradient(at) * normal(self, at)  # noqa: E731
    monkeypatch.setattr(Curve, "normal", long)
    assert "not a unit vector" in refused(tmp_path, trial_called("bowl-none"))
    monkeypatch.setattr(contacts, "_check", lambda touch: None)
    assert "its sentence has a wrong `multiplier_1`" in refused(tmp_path, trial_called("bowl-none"))


def test_a_multiplier_of_a_curve_that_is_called_its_force_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    normal = contacts._normal
    monkeypatch.setattr(contacts, "_normal", lambda *given: replace(normal(*given), gradient=Integer(1)))
    assert "`virtual_work` disagrees" in refused(tmp_path, trial_called("bowl-none"))


def test_friction_at_the_centre_of_a_ball_in_space_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pair = Contact.pair

    def at_centre(touch: Contact, size: Expr, direction: Any) -> Any:
        one, other = pair(touch, size, direction)
        return (replace(one, at=one.of.centre) if size.name.startswith("F") else one), other

    monkeypatch.setattr(Contact, "pair", at_centre)
    assert "`virtual_work` disagrees" in refused(tmp_path, trial_called("ball-floor-in space"))


def test_rolling_in_space_without_the_velocity_of_the_table_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    velocity = contacts.velocity_at
    still = lambda of, at: velocity(of if isinstance(of, PlacedBody) else None, at)  # noqa: E731
    monkeypatch.setattr(contacts, "velocity_at", still)
    assert "not the relative velocity" in refused(tmp_path, trial_called("ball-turntable-in space"))


def test_an_edge_of_a_disc_that_is_not_its_lowest_point_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lowest, theta = contact_points.lowest, Symbol("theta", real=True)

    def inside(of: Any, on: Any) -> Any:
        place = of.centre + sin(theta) * (lowest(of, on)[0] - of.centre)
        return place, on.distance(place)

    monkeypatch.setattr(contact_points, "lowest", inside)
    assert "could not be shown to be the lowest point" in refused(tmp_path, trial_called("disc-floor-in space"))
    monkeypatch.setattr(contact_points, "_check_lowest", lambda *_: None)
    assert "`virtual_work` disagrees" in refused(tmp_path, trial_called("disc-floor-in space"))


def test_a_disc_that_is_slightly_nearer_to_the_plane_than_its_gap_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A proof detects any difference; numbers at a few points would not detect a billionth of a billionth."""
    lowest = contact_points.lowest

    def farther(of: Any, on: Any) -> Any:
        place, gap = lowest(of, on)
        return place, gap + (of.centre - place).components[2] / Integer(10) ** 18

    monkeypatch.setattr(contact_points, "lowest", farther)
    assert "could not be shown to be the lowest point" in refused(tmp_path, trial_called("disc-floor-in space"))


def test_the_upper_end_of_a_cylinder_is_not_its_place_of_contact(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(contact_points, "_lower", lambda of, one, other: other)
    assert "could not be shown to be the lowest point" in refused(tmp_path, trial_called("cylinder-floor-in space"))


def test_different_tensions_on_the_two_sides_of_a_pulley_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pulls = strings.Piece.pulls

    def twice_at_one_end(piece: Any, tension: Any) -> Any:
        first, other = pulls(piece, tension)
        return replace(first, size=2 * tension), other

    monkeypatch.setattr(strings.Piece, "pulls", twice_at_one_end)
    assert "`virtual_work` disagrees" in refused(tmp_path, MOVABLE)


def test_a_joint_that_pulls_at_the_wrong_point_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    force = joints.PointForce
    at_end = lambda size, way, at, of: force(size, way, of.centre if of is not None else at, of)  # noqa: E731
    monkeypatch.setattr(joints, "PointForce", at_end)
    with pytest.raises(DeriveError, match="`virtual_work` disagrees"):
        solved(tmp_path, RODS)


def test_in_a_plane_the_force_of_a_joint_has_no_component_r_z(tmp_path: Path) -> None:
    declared = edited(RODS, ("g: acceleration}", "g: acceleration, R_z: spring constant}"))
    with_spring = edited(
        declared, ("  gravity: g\n", "  gravity: g\n  springs: {constant: R_z, from: [0, 0], to: [x, y]}\n")
    )
    energy = solved(tmp_path, with_spring)["potential_energy"].value
    assert "R_z" in {letter.name for letter in energy.free_symbols}
    with pytest.raises(DeriveError, match="`R_y`"):
        solved(tmp_path, with_spring.replace("R_z", "R_y"))


RODS = """\
title: Two rods
solve: system
symbols: {m: mass, l: length, g: acceleration}
given:
  coordinates: {theta: angle, phi: angle, x: length, y: length}
  bodies:
    upper: {shape: rod, length: l, mass: m, from: [0, 0], along: [sin(theta), -cos(theta)]}
    lower: {shape: rod, length: l, mass: m, centre: [x, y], along: [sin(phi), -cos(phi)]}
  gravity: g
  joints: {of: lower.end, to: upper.far_end, force: R}
statement: Two rods.
parts:
  - ask: Find the equations of motion.
    answer: equations_of_motion
"""


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("of: one, on: ground, normal: N", "of: two, on: ground, normal: N", "`two` is not a body or particle"),
        ("on: ground", "on: groun", "`groun` is not a surface or a body"),
        ("normal: N, ", "", "a normal force must keep it there"),
        ("{sliding: mu, direction: [1, 0]}", "{sliding: mu}", "needs the direction"),
        ("{sliding: mu, direction: [1, 0]}", "{sliding: mu, direction: [0, 1]}", "must be along the surface"),
        (
            "{sliding: mu, direction: [1, 0]}",
            "{direction: [1, 0]}",
            "needs exactly one of `rolling`, `sliding` and `static`",
        ),
        ("{sliding: mu, direction: [1, 0]}", "rolling", "rolling needs a friction force with a symbol"),
        ("{sliding: mu, direction: [1, 0]}", "{static: mu}", "needs the symbol of its force"),
        ("{sliding: mu, direction: [1, 0]}", "{rolling: F, force: G}", "`force` is the symbol of the static friction"),
        ("{sliding: mu, direction: [1, 0]}", "{static: mu, rolling: F}", "needs exactly one of"),
        ("{sliding: mu, direction: [1, 0]}", "{static: -mu, force: F}", "is not known to be positive"),
        (
            "normal: N, friction: {sliding: mu, direction: [1, 0]}",
            "friction: {static: mu, force: F}",
            "must keep it there",
        ),
        ("{through: [0, 0], along: [1, 0]}", "{through: [0, 0]}", "do not specify its shape"),
        ("on: ground, normal", "on: one, normal", "no contact uses the surface `ground`"),
        ("along: [1, 0]}", "along: [1, 0], velocity: [g*t, 0]}", "the velocity of a surface must be constant"),
        ("along: [1, 0]}", "along: [1, 0], velocity: [0, sqrt(g*a)]}", "must be along the surface"),
        (
            "{through: [0, 0], along: [1, 0]}",
            "{through: [x, 0], along: [1, 0]}",
            "moves with x, but no body carries it",
        ),
        (
            "{through: [0, 0], along: [1, 0]}",
            "{centre: [0, -R], radius: R, velocity: [sqrt(g*a), 0]}",
            "its material moves with its centre",
        ),
        ("{through: [0, 0], along: [1, 0]}", "{through: [0, 0], along: [x, 1]}", "different dimensions"),
        (
            "{through: [0, 0], along: [1, 0]}",
            "{through: [0, 0], along: [1, 0], side: inside}",
            "a plane has no side `inside`",
        ),
        ("centre: [x, y]", "centre: [x, a]", "keep the body on the surface"),
        (
            "shape: ball, radius: a",
            "shape: cone, radius: a, height: a, across: x",
            "is not round in the plane of motion",
        ),
    ],
)
def test_a_contact_that_cannot_be_meant_is_told(old: str, new: str, said: str, tmp_path: Path) -> None:
    (message, *_) = messages(tmp_path, edited(problem(SLIDES), (old, new)))
    assert said in message


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("to: [a, 0], length: l", "to: [a, 0], length: x", "`length`"),
        ("from: one", "from: oen", "`oen` is not a named place"),
        ("x: positive length", "x: length", "the sign of x is unknown"),
    ],
)
def test_a_string_that_cannot_be_meant_is_told(old: str, new: str, said: str, tmp_path: Path) -> None:
    (message, *_) = messages(tmp_path, edited(problem(MOVABLE), (old, new)))
    assert said in message


def test_a_driven_wedge_carries_the_cylinder_that_rolls_on_it(tmp_path: Path) -> None:
    """In the frame of the wedge gravity has the components (-A, -g), so F = m (A cos alpha - g sin alpha)/3."""
    text = edited(
        problem(on_a_surface_called("disc-incline-rolling")),
        ("through: [0, 0], normal", "through: [P/M*t**2/2, 0], normal"),
        ("forces: {components: [P, 0], at: one}", "assume: a < R"),
    )
    value = explicit(solved(tmp_path, text)["F"].value)
    numbers = {"m": 2.0, "P": 3.0, "M": 5.0, "g": 7.0, "alpha": 0.4}
    wanted = 2.0 * (3.0 / 5.0 * float(cos(0.4)) - 7.0 * float(sin(0.4))) / 3
    assert value_at(value, numbers) == pytest.approx(wanted)


def test_a_pulley_may_be_at_a_place_that_moves_with_a_particle(tmp_path: Path) -> None:
    text = """\
title: A block on a cart
solve: system
symbols: {m: mass, M: mass, g: acceleration, d: length, l: length}
given:
  coordinates: {X: length, x: positive length, y: positive length}
  particles: {cart: {mass: M, at: [X, 0]}, block: {mass: m, at: [X - x, d]}, w: {mass: m, at: [X, d - y]}}
  gravity: g
  strings: {from: block, over: [{from: cart, by: [0, d]}], to: w, length: l, tension: T}
statement: A block on a cart.
parts:
  - ask: Find the tension.
    answer: [T, acceleration_X]
"""
    steps = solved(tmp_path, text)
    numbers = {"m": 2.0, "M": 5.0, "g": 7.0}
    rows = [  # M X'' = -T - S ..., with the unknown horizontal force S of the cart on the weight
        {"X": 5.0, "T": 1.0, "S": 1.0},
        {"X": 2.0, "x": -2.0, "T": -1.0},
        {"X": 2.0, "S": -1.0},
        {"y": 2.0, "T": 1.0, "": -2.0 * 7.0},
        {"x": 1.0, "y": 1.0},
    ]
    wanted = newton(rows)
    assert value_at(explicit(steps["T"].value), numbers) == pytest.approx(wanted["T"])
    assert value_at(explicit(steps["acceleration_X"].value), numbers) == pytest.approx(wanted["X"])
    (said,) = messages(tmp_path, edited(text, ("{from: cart, by: [0, d]}", "[X, d]")))
    assert "moves with X, but it does not belong to a body or particle" in said


def assumptions(folder: Path, text: str) -> set[str]:
    run = Run()
    run_solve(loaded(folder, text), run)
    return {str(each) for each in run.assumed}


def test_the_direction_of_slip_is_an_assumption_of_the_page(tmp_path: Path) -> None:
    assert any(
        "x_dot" in each and "phi_dot" in each and "> 0" in each for each in assumptions(tmp_path, problem(SLIDES))
    )


def test_a_direction_of_slip_that_is_false_at_the_start_is_refused(tmp_path: Path) -> None:
    """The ball is thrown to the right without rotation, so its lowest point slips to the right."""
    text = (ROOT / "problems" / "library" / "contacts" / "sliding_to_rolling.yaml").read_text(encoding="utf-8")
    assert "far" in solved(tmp_path, text)
    (said,) = messages(tmp_path, edited(text, ("direction: [1, 0]", "direction: [-1, 0]")))
    assert "but the direction of slip requires" in said


def test_a_length_of_string_that_may_change_its_sign_is_an_assumption(tmp_path: Path) -> None:
    given = problem(MOVABLE)
    text = edited(given, ("x: positive length", "x: length"), ("at: [0, -x]", "at: [0, -P/M - x]")).replace(
        "P: positive force", "P: length"
    )
    text = text.replace("-P/M - x", "-P - x")
    assert any("P + x > 0" in each for each in assumptions(tmp_path, text))


CARTS = """\
title: Two carts and a dashpot
solve: system
symbols: {m: mass, M: mass, c: damping constant, d: length, g: acceleration}
given:
  coordinates: {x: length, y: length, z: length}
  particles: {one: {mass: m, at: [x, 0]}, two: {mass: M, at: [d + y, z]}}
  dashpots: {constant: c, from: one, to: two}
statement: Two carts.
parts:
  - ask: Find the motion.
    answer: equations_of_motion
"""


def test_a_dashpot_that_acts_on_one_end_only_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    solved(tmp_path, CARTS)
    loads = joints.DragAlong.other_loads
    monkeypatch.setattr(joints.DragAlong, "other_loads", lambda *given: loads(*given)[:1])
    with pytest.raises(DeriveError, match="disagrees"):
        solved(tmp_path, CARTS)


def test_a_dashpot_ends_at_bodies_or_at_the_ground(tmp_path: Path) -> None:
    (said,) = messages(tmp_path, edited(CARTS, ("to: two", "to: [d + y, 0]")))
    assert "moves with y, but it does not belong to a body or particle" in said
    solved(tmp_path, edited(CARTS, ("to: two", "to: [-d, 0]")))


def test_a_dashpot_and_a_spring_in_series(tmp_path: Path) -> None:
    """The force of the spring and the force of the dashpot are equal at their joint, k z = c (y_dot - z_dot)."""
    joint = (
        "from: one, to: two}",
        "from: [z, 0], to: two, massless: true}\n  springs: {constant: k, from: [0, 0], to: [z, 0], massless: true}",
    )
    text = edited(CARTS, joint, ("at: [d + y, z]", "at: [y, 0]"), ("d: length, g: acceleration", "k: spring constant"))
    steps = solved(tmp_path, text)
    k, c = symbols("k c", positive=True)
    z, z_dot, y_dot = symbols("z z_dot y_dot", real=True)
    assert equal(explicit(steps["motion_z"].value).residual, k * z + c * (z_dot - y_dot))


ROD = """\
title: A rod on a hinge
solve: system
symbols: {M: mass, l: length, J: momentum, k: spring constant, q: charge, E: electric field, d: length}
given:
  coordinates: {theta: angle}
  bodies: {rod: {shape: rod, length: l, mass: M, from: [0, 0], along: [sin(theta), -cos(theta)]}}
  ACTS
statement: A rod.
parts:
  - ask: Find the motion.
    answer: equations_of_motion
"""
M, l, J, k, q, E, d = symbols("M l J k q E d", positive=True)
theta, theta_ddot = symbols("theta theta_ddot", real=True)


@pytest.mark.parametrize(
    ("acts", "torque"),
    [
        ("charges: {charge: q, at: rod.far_end, electric: [E, 0]}", q * E * l * cos(theta)),
        ("forces: {components: [q*E, 0], at: rod.far_end}", q * E * l * cos(theta)),
        ("springs: {constant: k, from: rod.far_end, to: [d, -l]}", k * l * (d * cos(theta) - l * sin(theta))),
        ("damping: {constant: k*d/d, at: rod.end}", 0),
    ],
)
def test_what_acts_at_a_point_of_a_body_turns_the_body(acts: str, torque: Expr, tmp_path: Path) -> None:
    unit = "kg/s" if "damping" in acts else "spring constant"
    text = edited(ROD, ("ACTS", acts), ("k: spring constant", f"k: {'damping constant' if unit == 'kg/s' else unit}"))
    found = solved(tmp_path, text)["motion_theta"].value
    letters = {each.name: each for each in explicit(found.residual).free_symbols}
    known = {s: letters[s.name] for s in (M, l, k, q, E, d, theta, theta_ddot) if s.name in letters}
    wanted = (M * l**2 / 3 * theta_ddot - torque).xreplace(known)
    ratio = (explicit(found.residual) / wanted).simplify() if torque != 0 else 1
    assert not ratio.has(letters["theta"], letters["theta_ddot"]) if torque != 0 else "theta_dot" not in letters


def test_an_impulse_at_a_point_of_a_body_acts_on_the_body(tmp_path: Path) -> None:
    """M l^2/3 theta_dot = l J."""
    text = edited(
        ROD,
        ("ACTS", "impact: {impulses: {components: [J, 0], at: rod.far_end}, at: {theta: 0}}"),
        ("equations_of_motion", "rates_after"),
    )
    value = explicit(solved(tmp_path, text)["theta_dot_after"].value)
    assert {letter.name for letter in value.free_symbols} == {"J", "M", "l"}
    assert value_at(value, {"J": 2.0, "M": 3.0, "l": 5.0}) == pytest.approx(3 * 2 / (3 * 5))


CURVE = """\
title: A bead on a curve
solve: system
symbols: {m: mass, b: length, g: acceleration, c: length, mu: positive number, V: speed}
given:
  coordinates: {x: length, y: length}
  particles: {bead: {mass: m, at: [x, y]}}
  gravity: g
  surfaces: {bowl: {y: x**2/(2*b)}}
  contacts: {of: bead, on: bowl, normal: N}
statement: A bead.
parts:
  - ask: Find the motion.
    answer: N
"""
SLIDING = ("normal: N}", "normal: N, friction: {sliding: mu, direction: right}}")


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ([("x**2/(2*b)", "x**2")], "`y` must be a length"),
        ([("x**2/(2*b)", "x**2/(2*b) + V*t")], "contains t, but a curve has a constant shape"),
        ([("x**2/(2*b)", "x**2/(2*b) + y/7")], "contains y, but a curve has a constant shape"),
        ([("x**2/(2*b)}", "x**2/(2*b), side: inside}")], "no side `inside`"),
        ([("x**2/(2*b)}", "x**2/(2*b), radius: b}")], "`radius` does not belong to a curve"),
        ([("x**2/(2*b)}", "x**2/(2*b), velocity: [V, 0]}")], "a curve is allowed only for motion in a plane"),
        ([("x**2/(2*b)}", "x**2/(2*b), through: [y, 0]}")], "moves with y, but no body carries it"),
        ([("at: [x, y]", "at: [x, x**2/(2*b)]")], "keep the body on the surface"),
        ([("x**2/(2*b)}", "x**2/(2*b), side: both}"), SLIDING], "may have either sign"),
        (
            [("{y: x**2/(2*b)}", "{centre: [0, 0], radius: b, side: above}")],
            "no side `above`",
        ),
        ([("coordinates: {x: length", "coordinates: {u: length"), ("at: [x", "at: [u"), ("mu:", "x: length, mu:")],
         "is under `symbols` too"),
        (
            [("particles: {bead: {mass: m, at: [x, y]}}", "bodies: {bead: {shape: ball, radius: b, mass: m, "
              "centre: [x, y], turned: 0}}")],
            "the place where a ball touches the curve is unknown",
        ),
    ],
)  # fmt: skip
def test_a_curve_that_cannot_be_meant_is_told(changes: list[tuple[str, str]], said: str, tmp_path: Path) -> None:
    (message, *_) = messages(tmp_path, edited(CURVE, *changes))
    assert said in message


ROUND = """\
title: A disc in a bowl
solve: system
symbols: {m: mass, a: length, b: length, g: acceleration, mu_s: positive number}
given:
  coordinates: {alpha: "angle in (-pi/2, pi/2)", h: positive length, phi: angle}
  bodies:
    disc:
      shape: disc
      radius: a
      mass: m
      centre: [b*tan(alpha) - h*sin(alpha), b*tan(alpha)**2/2 + h*cos(alpha)]
      turned: phi
  gravity: g
  surfaces: {bowl: {y: x**2/(2*b)}}
  contacts: {of: disc, on: bowl, normal: N, friction: {static: mu_s, force: F}}
statement: A disc.
parts:
  - ask: Find the forces.
    answer: [N, F]
"""


def test_a_disc_on_a_curve_is_pressed_by_its_weight_and_by_its_acceleration(tmp_path: Path) -> None:
    """The centre of the disc moves along a curve with the radius of curvature b/cos^3(alpha) - a. Along the tangent,
    rolling has the friction m g sin(alpha)/3 for any curve."""
    found = solved(tmp_path, ROUND)
    at = {"m": 2.0, "a": 0.3, "b": 1.7, "g": 9.8, "alpha": 0.6, "alpha_dot": 1.3}
    centripetal = 2 * (1.7 / math.cos(0.6) ** 3 - 0.3) * 1.3**2
    assert value_at(explicit(found["N"].value), at) == pytest.approx(2 * 9.8 * math.cos(0.6) + centripetal)
    assert value_at(explicit(found["F"].value), at) == pytest.approx(2 * 9.8 * math.sin(0.6) / 3)


def test_a_disc_beside_the_normal_of_a_curve_is_refused(tmp_path: Path) -> None:
    (message, *_) = messages(tmp_path, edited(ROUND, ("- h*sin(alpha)", "- h*sin(2*alpha)")))
    assert "touches the curve is unknown" in message


def test_the_force_of_a_wire_has_either_sign_and_is_never_lost(tmp_path: Path) -> None:
    text = edited(CURVE, ("x**2/(2*b)}", "x**2/(2*b), side: both}"))
    solved(tmp_path, text)
    text = edited(
        text, ("statement", "  results: {off: {leaves: N, for: x, start: 0}}\nstatement"), (": N\n", ": off\n")
    )
    (message, *_) = messages(tmp_path, text)
    assert "is the force of a rail, which may have either sign" in message


@pytest.mark.long
def test_a_particle_leaves_a_hill_where_its_normal_force_vanishes(tmp_path: Path) -> None:
    """From rest at the top of y = -x^3/c^2, N is proportional to c^4 - 3 x^4."""
    hill = "-x**3/c**2"
    results = f"""\
  results:
    on_it: {{put_in: energy_function, values: {{y: {hill}, y_dot: -3*x**2*x_dot/c**2}}}}
    speed: {{speed: on_it, for: x, start: 0, results: acceleration_x}}
    force: {{put_in: N, results: [speed]}}
    off: {{leaves: force, for: x**4, start: 0}}
statement"""
    text = edited(
        CURVE, ("x**2/(2*b)", hill), ("statement", results), (": N\n", ": off\n"), ("{x: length", "{x: positive length")
    )
    value = explicit(solved(tmp_path, text)["off"].value)
    c = next(iter(value.right.free_symbols))
    assert value.operator == "=" and value.right == c**4 / 3
    with pytest.raises(DeriveError) as error:
        solved(tmp_path, edited(text, ("for: x**4", "for: x")))
    assert error.value.complaints[0].help == "write `x**4` in place of `x`"


def test_a_coordinate_on_the_curve_needs_no_normal_force(tmp_path: Path) -> None:
    text = edited(CURVE, ("{x: length, y: length}", "{x: length}"), ("at: [x, y]", "at: [x, x**2/(2*b)]"))
    text = edited(text, (", normal: N", ""), (": N\n", ": motion_x\n"))
    assert "motion_x" in solved(tmp_path, text)


def test_the_impulse_of_a_curve_is_along_its_unit_normal(tmp_path: Path) -> None:
    """A horizontal impulse P at x = c: J_N = P c/sqrt(b^2 + c^2), against the component of P along the normal."""
    impact = "  impact: {impulses: {components: [m*V, 0], at: bead}, at: {x: c, y: c**2/(2*b)}}\nstatement"
    text = edited(CURVE, ("statement", impact), (": N\n", ": [J_N, rates_after]\n"))
    value = explicit(solved(tmp_path, text)["J_N"].value)
    assert value_at(value, {"m": 2.0, "V": 3.0, "b": 4.0, "c": 3.0}) == pytest.approx(2.0 * 3.0 * 3.0 / 5.0)


ROLLING = problem(trial_called("disc-floor-in space"))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("normal: [0, 0, 1]", "normal: [1, 1, 1]", "could not be shown to be the lowest point"),
        ("theta: 'angle in (0, pi)'", "theta: angle", "the sign of sin(theta) is unknown"),
        ("{through: [0, 0, 0], normal: [0, 0, 1]}", "{centre: [0, 0, -R], radius: R}", "is known only for a plane"),
        ("{x: theta}, {z: psi}", "{z: psi}", "lies flat on the plane"),
        ("symbols: {m: mass", "symbols: {F_x: force, m: mass", "`F_x` already denotes something else"),
        ("{rolling: F}", "rolling", "rolling needs a friction force with a symbol"),
        (
            "shape: disc",
            "shape: cylinder, height: a",
            "it is unknown which end of a cylinder touches the plane: the sign",
        ),
        ("shape: disc", "shape: hemisphere", "is not a ball"),
    ],
)
def test_rolling_in_space_that_cannot_be_meant_is_told(old: str, new: str, said: str, tmp_path: Path) -> None:
    (message, *_) = messages(tmp_path, edited(ROLLING, (old, new)))
    assert said in message


@pytest.mark.parametrize(
    ("edits", "said", "helped"),
    [
        ([], "the sign of a*(sin(theta) - cos(theta)) decides", "give `theta` a narrower range"),
        (
            [
                ("theta: 'angle in (0, pi)', ", ""),
                ("{x: theta}", "{x: beta}"),
                ("symbols: {", "symbols: {beta: 'angle in (0, pi/2)', "),
            ],
            "the sign of a*(sin(beta) - cos(beta)) decides",
            "as `assume: [0 < a*(sin(beta) - cos(beta))]`",
        ),
    ],
)
def test_the_help_for_the_end_of_a_cone_names_what_is_missing(
    edits: list[tuple[str, str]], said: str, helped: str, tmp_path: Path
) -> None:
    """An angle that has a range needs a narrower one; constants need a relation between them."""
    cone = edited(ROLLING, ("shape: disc", "shape: cone, height: a"), *edits)
    (complaint, *_) = complaints(tmp_path, cone)
    assert said in complaint.message and helped in str(complaint.help), complaint


def test_the_direction_along_a_surface_needs_a_known_inclination(tmp_path: Path) -> None:
    """On a circle the surface faces upwards or downwards, so the direction to the right is not decided."""
    text = edited(CURVE, SLIDING, ("{y: x**2/(2*b)}", "{centre: [0, 0], radius: b}"))
    (message, *_) = messages(tmp_path, text)
    assert "points to the right is unknown" in message


ON_ITS_SIDE = """\
title: A cone
solve: system
symbols: {M: mass, h: length, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {phi: angle, psi: angle}
  axes: {body: [{z: phi}, {y: pi/2 - alpha}, {z: psi}]}
  bodies: {cone: {shape: cone, radius: h*tan(alpha), height: h, mass: M, held: apex, turned: body}}
  surfaces: {table: {through: [0, 0, 0], normal: [0, 0, 1]}}
  contacts: {of: cone, on: table, friction: rolling}
statement: A cone <<M>> <<h>> <<alpha>>.
parts:
  - ask: How does it roll?
    answer: [no_slip, kinetic_energy]
"""


def test_a_cone_that_lies_on_its_side_rolls_about_its_apex(tmp_path: Path) -> None:
    """Landau and Lifshitz, *Mechanics*, section 32, problem 7."""
    steps = solved(tmp_path, ON_ITS_SIDE)
    M, h, alpha = symbols("M h alpha", positive=True)
    phi_dot, psi_dot = symbols("phi_dot psi_dot", real=True)
    rolling = explicit(steps["no_slip"].value)
    assert (rolling.left - rolling.right).subs(psi_dot, -phi_dot / sin(alpha)).simplify() == 0
    wanted = 3 * M * h**2 * phi_dot**2 * (1 + 5 * cos(alpha) ** 2) / 40
    assert (explicit(steps["kinetic_energy"].value) - wanted).simplify() == 0


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (
            [("held: apex", "centre: [3*h/4*cos(alpha)*cos(phi), 3*h/4*cos(alpha)*sin(phi), 3*h/4*sin(alpha)]")],
            "a line",
        ),
        (
            [("shape: cone, radius: h*tan(alpha)", "shape: cylinder, radius: h"), ("held: apex", "held: base")],
            "partly behind the surface",
        ),
        ([("pi/2 - alpha", "beta"), ("h: length", "h: length, beta: 'angle in (0, pi/2)'")], "it is unknown which end"),
    ],
)
def test_a_contact_along_a_line_needs_a_held_end(changes: list[tuple[str, str]], said: str, tmp_path: Path) -> None:
    (message, *_) = messages(tmp_path, edited(ON_ITS_SIDE, *changes))
    assert said in message


IN_A_HOLLOW = """\
title: A disc in a hollow
solve: system
symbols: {m: mass, R: length, b: length, g: acceleration}
given:
  coordinates: {x: length, phi: angle}
  bodies:
    disc:
      {shape: disc, radius: R, mass: m, turned: phi,
       centre: [x - R*x/(b*sqrt(1 + x**2/b**2)), x**2/(2*b) + R/sqrt(1 + x**2/b**2)]}
  gravity: g
  surfaces: {bowl: {y: x**2/(2*b)}}
  contacts: {of: disc, on: bowl, friction: {rolling: F}}
statement: A disc <<m>> <<R>> <<b>> <<g>>.
parts:
  - ask: How does it move?
    answer: equations_of_motion
"""


@pytest.mark.long
def test_a_disc_in_a_hollow_is_assumed_to_be_smaller_than_its_radius_of_curvature(tmp_path: Path) -> None:
    """The radius of curvature is b (1 + x^2/b^2)^(3/2). A hill, in place of the hollow, needs no assumption."""
    assert "(b**2 + x**2)**(3/2) > R*b**2" in assumptions(tmp_path, IN_A_HOLLOW)
    hill = edited(IN_A_HOLLOW, ("[x - R*x", "[x + R*x"), ("x**2/(2*b) + R/", "-x**2/(2*b) + R/"), ("y: x", "y: -x"))
    assert not any("R" in each for each in assumptions(tmp_path, hill))


ROPE = """\
title: A rope
solve: system
symbols: {M: mass, l: length, g: acceleration}
given:
  coordinates: {x: positive length}
  particles: {rope: {mass: M, at: [x - l, 0]}}
  strings: {from: [x - l, 0], over: [[0, 0]], to: [0, -x], length: l, mass_of: rope}
  gravity: g
statement: A rope <<M>> <<l>> <<g>>.
parts:
  - ask: How does it move?
    answer: acceleration_x
"""


ON_TWO_STRINGS = """\
title: A ball on two strings
solve: system
symbols: {m: mass, l: length, g: acceleration, Omega: positive angular speed}
given:
  coordinates: {x: positive length, z: length}
  axes: {shaft: [{z: Omega*t}]}
  particles: {ball: {mass: m, at: {in: shaft, by: [x, 0, z]}}}
  strings:
    - {from: [0, 0, l/2], to: ball, length: l, tension: T_1}
    - {from: [0, 0, -l/2], to: ball, length: l, tension: T_2}
  gravity: g
statement: A ball <<m>> on two strings <<l>> turns at <<Omega>>.
parts:
  - {ask: Find the tensions., answer: equilibria}
"""


def test_the_tensions_of_two_strings_hold_where_both_strings_pull(tmp_path: Path) -> None:
    """T_1 = m (l Omega^2/2 + g) is positive, and T_2 = m (l Omega^2/2 - g) has to be."""
    assert assumptions(tmp_path, ON_TWO_STRINGS) >= {"Omega**2 > 2*g/l"}
    asked = (
        ("gravity: g\n", "gravity: g\n  results: {taut: {where: rest_T_2, is: '>', for: Omega}}\n"),
        ("equilibria", "taut"),
    )
    assert not any("Omega" in each for each in assumptions(tmp_path, edited(ON_TWO_STRINGS, *asked)))


def test_each_string_has_its_own_fraction_in_an_equation_of_motion(tmp_path: Path) -> None:
    right = solved(tmp_path, ON_TWO_STRINGS)["motion_z"].value.right
    assert all(sum(power.base.is_Add for power in term.atoms(Pow)) <= 1 for term in right.args)


def test_a_rope_over_an_edge_moves_as_the_particle_with_its_mass(tmp_path: Path) -> None:
    """Each piece has the same speed: M x_ddot is the weight M g x/l of the hanging piece."""
    x, g, l = symbols("x g l", positive=True)
    assert (solved(tmp_path, ROPE)["acceleration_x"].value - g * x / l).simplify() == 0


def test_gravity_acts_on_the_pieces_of_a_rope_on_both_sides_of_a_peg(tmp_path: Path) -> None:
    """If x hangs on one side and l - x on the other, M x_ddot is the difference of the weights, M g (2 x - l)/l."""
    over_a_peg = edited(ROPE, ("from: [x - l, 0]", "from: [0, x - l]"), ("at: [x - l, 0]", "at: [x - l, 3*l]"))
    x, g, l = symbols("x g l", positive=True)
    assert (solved(tmp_path, over_a_peg)["acceleration_x"].value - g * (2 * x - l) / l).simplify() == 0


IN_A_TUBE = (
    ("{M: mass, l: length, g", "{M: mass, h: length, b: length, g"),
    ("x: positive length", "x: length"),
    ("at: [x - l, 0]", "at: [x, 0]"),
    ("<<l>>", "<<h>> <<b>>"),
)


@pytest.mark.parametrize("length", ["length: 2*h + 2*b, ", ""])
def test_a_liquid_in_a_tube_has_the_length_of_its_three_pieces(tmp_path: Path, length: str) -> None:
    """The signs of h + x and h - x are unknown, but each is a length where x = 0: x_ddot = -2 g x/(2 h + 2 b)."""
    tube = f"{{from: [-b, h + x], over: [[-b, 0], [b, 0]], to: [b, h - x], {length}mass_of: rope}}"
    own = ("{from: [x - l, 0], over: [[0, 0]], to: [0, -x], length: l, mass_of: rope}", tube)
    b, g, h = symbols("b g h", positive=True)
    found = solved(tmp_path, edited(ROPE, *IN_A_TUBE, own))["acceleration_x"].value
    assert (found + g * Symbol("x", real=True) / (b + h)).simplify() == 0


def test_the_length_of_a_rope_is_not_guessed(tmp_path: Path) -> None:
    """Whether the tube is a U or an inverted U depends on the sign of h - b, so the motion is stable or unstable."""
    tube = "{from: [-b, h - b + x], over: [[-b, 0], [b, 0]], to: [b, h - b - x], mass_of: rope}"
    own = ("{from: [x - l, 0], over: [[0, 0]], to: [0, -x], length: l, mass_of: rope}", tube)
    with pytest.raises(DeriveError, match="but the sign of b - h is unknown"):
        solved(tmp_path, edited(ROPE, *IN_A_TUBE, own))
    x, b, g, h = Symbol("x", real=True), *symbols("b g h", positive=True)
    for assumed, total in (("h > b", 2 * h), ("h < b", 4 * b - 2 * h)):
        text = edited(ROPE, *IN_A_TUBE, own, ("gravity: g", f"gravity: g\n  assume: [{assumed}]"))
        found = solved(tmp_path, text)["acceleration_x"].value
        sense = -2 if assumed == "h > b" else 2
        assert (found - sense * g * x / total).simplify() == 0


def test_gravity_changes_nothing_for_a_rope_whose_pieces_keep_their_height(tmp_path: Path) -> None:
    level = edited(ROPE, ("to: [0, -x]", "to: [x, 0]"))
    assert solved(tmp_path, level)["acceleration_x"].value == 0


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ([("at: [x - l, 0]", "at: [2*x, 0]")], "the speed of the rope differs from the speed of the particle"),
        ([("at: [x - l, 0]", "at: [0, -x]")], "moves up or down"),
        (
            [("from: [x - l, 0], over: [[0, 0]], to: [0, -x]", "from: [0, 0], to: [l*sin(x/l), -l*cos(x/l)]")],
            "must move along themselves",
        ),
        ([("length: l, mass_of", "length: l, tension: S, mass_of")], "so the force `S` does not appear"),
        ([("gravity: g", "gravity: g\n  potential: -M*g*x**2/(2*l)")], "which the weight already includes"),
        ([("mass_of: rope", "mass_of: roap")], "`roap` is not a body or particle of this system"),
    ],
)
def test_a_rope_that_cannot_be_meant_is_told(changes: list[tuple[str, str]], said: str, tmp_path: Path) -> None:
    assert said in messages(tmp_path, edited(ROPE, *changes))[0]
