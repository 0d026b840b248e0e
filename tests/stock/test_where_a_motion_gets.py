"""A result at a place, far away or after a long time says of a motion only what it does."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.solution import rendered
from derive.mechanics.motion import turning_points
from tests.courses import ROOT
from tests.stock.described import complaints, course_with, edited, solved

STONE = """\
title: A stone that is thrown upwards
solve: system
symbols: {m: mass, g: acceleration, u: speed, c: damping constant}
given:
  coordinates: {y: length}
  particles: {stone: {mass: m, at: [0, y]}}
  gravity: g
  results:
    speed: {speed: energy_function, for: y, start: 0, start_rate: u}
    there: {put_in: speed, values: {y: u**2/(4*g)}}
statement: A stone of mass <<m>> <<g>> <<u>> <<c>>.
parts:
  - ask: How fast is it?
    answer: there
"""
LATE = "{limit: speed, for: t, to: infinity}"
ESCAPES = """\
title: A particle that goes away
solve: system
symbols: {m: mass, k: coupling constant, r_0: length, v: speed}
given:
  coordinates: {r: positive length}
  particles: {p: {mass: m, at: [r, 0]}}
  potential: -k/r
  results:
    speed: {speed: energy_function, for: r, start: r_0, start_rate: v}
    far: {limit: speed, for: r, to: infinity}
statement: A particle <<m>> <<k>> <<r_0>> <<v>>.
parts:
  - ask: How fast is it far away?
    answer: far
"""
SWINGS = """\
title: A mass at a spring
solve: system
symbols: {m: mass, k: spring constant, c: damping constant, F: positive force, w: angular speed, A: length}
values: {m: 1 kg, k: 4 N/m, c: 4 kg/s, F: 1 N, w: 2 rad/s, A: 1 m}
given:
  coordinates: {x: length}
  particles: {p: {mass: m, at: [x, 0]}}
  springs: {constant: k, from: [0, 0], to: p}
  forces: {components: [F*cos(w*t), 0], at: p}
  results:
    moves: {solution: motion_x, for: x, start: 0, start_rate: 0}
statement: A mass <<m>> <<k>> <<c>> <<F>> <<w>> <<A>>.
parts:
  - ask: How does it move?
    answer: moves
"""
FORCED, DAMPED = "forces: {components: [F*cos(w*t), 0], at: p}", "damping: {constant: c, at: p}"
WHEEL = """\
title: A wheel on a plank
solve: system
symbols: {m: mass, M: mass, R: length}
given:
  coordinates: {x: length, X: length, theta: angle}
  bodies: {wheel: {shape: disc, mass: m, radius: R, centre: [x, R], turned: -theta}}
  particles: {plank: {mass: M, at: [X, 0]}}
  surfaces: {top: {through: plank, along: [1, 0], of: plank}}
  contacts: {of: wheel, on: top, friction: {rolling: F}}
statement: A wheel <<m>> <<M>> <<R>>.
parts:
  - ask: How does it move?
    answer: equations_of_motion
"""


def refused(folder: Path, text: str) -> tuple[str, int, str]:
    (found,) = complaints(folder, text)
    return found.code, found.place.line, found.message


def test_a_place_that_the_motion_does_not_reach_is_refused(tmp_path: Path) -> None:
    too_high = edited(STONE, ("u**2/(4*g)", "u**2/g"))
    code, line, said = refused(tmp_path, too_high)
    assert (code, line) == ("not-reached", 10)
    assert "does not reach y = u**2/g, since y_dot**2 would be negative" in said


HILL = """\
title: A bead between two hollows
solve: system
symbols: {m: mass, g: acceleration, a: length, h: length, v: speed}
given:
  coordinates: {x: length}
  particles: {bead: {mass: m, at: [x, 0]}}
  potential: m*g*h*(1 - x**2/a**2)**2
  results:
    speed: {speed: energy_function, for: x, start: -a, start_rate: v}
    there: {put_in: speed, values: {x: a}}
statement: A bead <<m>> <<g>> <<a>> <<h>> <<v>>.
parts:
  - ask: How fast is it in the other hollow?
    answer: there
"""


def test_a_place_behind_a_hill_is_refused_unless_the_motion_passes(tmp_path: Path) -> None:
    """The speed in the other hollow would be v; over the hill it gets only for v^2 > 2 g h."""
    code, line, said = refused(tmp_path, HILL)
    assert (code, line) == ("not-reached", 10)
    assert "on the way x_dot**2 can be negative" in said
    fast = edited(HILL, ("  results:", "  assume: v**2 > 2*g*h\n  results:"))
    assert str(solved(tmp_path, fast)["there"].value) == "v**2"


def test_a_place_on_the_way_has_its_speed(tmp_path: Path) -> None:
    assert str(solved(tmp_path, STONE)["there"].value) == "u**2/2"


def page(folder: Path, text: str) -> str:
    return " ".join(rendered(course_with(folder, text), "trial/one", only={"text"}).texts["text"].split())


def test_a_motion_that_need_not_get_far_away_gets_there_under_a_condition(tmp_path: Path) -> None:
    text = page(tmp_path, ESCAPES)
    assert "As r → ∞, which the motion reaches if v² ≥ 2k/(m r_0)," in text
    assert "Assume" not in text


THROWN = edited(
    STONE,
    ("start: 0,", "start: h,"),
    ("u: speed, c: damping constant", "u: speed, h: length, b: length"),
    (
        "there: {put_in: speed, values: {y: u**2/(4*g)}}",
        "v: {square_root: speed}\n    there: {put_in: v, values: {y: 0}}",
    ),
    ("<<c>>", "<<h>> <<b>>"),
)


def test_a_rate_has_the_opposite_sign_where_the_motion_comes_after_it_has_turned(tmp_path: Path) -> None:
    """A stone that is thrown upwards falls at the ground below, and rises at a height above."""
    assert str(solved(tmp_path, THROWN)["there"].value) == "-sqrt(2*g*h + u**2)"
    text = page(tmp_path, THROWN)
    assert "The motion turns back before it comes to y = 0, so there" in text
    assert "has the opposite sign, *" in text
    above = page(tmp_path, edited(THROWN, ("{y: 0}", "{y: 3*h}")))
    assert "For y = 3h, which the motion reaches if u² ≥ 4g h," in above
    assert "= √(u² - 4g h)" in above


def test_a_stone_that_is_thrown_downwards_keeps_its_sign(tmp_path: Path) -> None:
    down = edited(THROWN, ("start_rate: u", "start_rate: -u"))
    assert str(solved(tmp_path, down)["there"].value) == "-sqrt(2*g*h + u**2)"
    never = edited(down, ("{y: 0}", "{y: 2*h}"))
    code, line, said = refused(tmp_path, edited(never, ("  results:", "  assume: u**2 > 2*g*h\n  results:")))
    assert (code, line) == ("sign-of-rate", 12)
    assert "`v` contains y_dot, whose sign at y = 2*h is unknown" in said


def test_a_place_on_an_unknown_side_of_the_start_gives_a_rate_no_sign(tmp_path: Path) -> None:
    unknown = edited(THROWN, ("{y: 0}", "{y: b}"))
    code, line, said = refused(tmp_path, unknown)
    assert (code, line) == ("sign-of-rate", 11)
    assert "whose sign at y = b is unknown" in said
    below = edited(unknown, ("  results:", "  assume: b < h\n  results:"))
    assert str(solved(tmp_path, below)["there"].value) == "-sqrt(-2*b*g + 2*g*h + u**2)"


def test_a_result_that_contains_a_rate_with_a_wrong_sign_is_refused(tmp_path: Path) -> None:
    momentum = edited(THROWN, ("there: {put_in: v,", "p: {value: m*v}\n    there: {put_in: p,"))
    code, line, said = refused(tmp_path, momentum)
    assert (code, line) == ("sign-of-rate", 12)
    assert "the motion turns back before y = 0, so `v` has the opposite sign there" in said


ON_SPRING = """\
title: A mass on a spring
solve: system
symbols: {m: mass, k: spring constant, u: speed, w: velocity, b: length}
given:
  coordinates: {x: length}
  particles: {p: {mass: m, at: [x, 0]}}
  springs: {constant: k, from: [0, 0], to: p}
  results:
    speed: {speed: energy_function, for: x, start: 0, start_rate: u}
    v: {square_root: speed}
    there: {put_in: v, values: {x: b}}
statement: A mass <<m>> <<k>> <<u>> <<w>> <<b>>.
parts:
  - ask: How fast is it?
    answer: there
"""


def test_a_mass_on_a_spring_comes_first_to_a_place_ahead_of_its_start(tmp_path: Path) -> None:
    assert "sqrt" in str(ahead := solved(tmp_path, ON_SPRING)["there"].value) and not ahead.could_extract_minus_sign()
    behind = solved(tmp_path, edited(ON_SPRING, ("{x: b}", "{x: -b}")))["there"].value
    assert str(behind) == str(-ahead)


def test_a_rate_of_unknown_sign_is_a_magnitude_wherever_the_motion_gets(tmp_path: Path) -> None:
    """The square is compared only where it is positive: within the amplitude."""
    found = solved(tmp_path, edited(ON_SPRING, ("start_rate: u", "start_rate: w")))
    assert str(found["v"].symbol) == str(found["there"].symbol) == "Abs(x_dot)"
    assert "sqrt" in str(found["there"].value)


SWUNG = """\
title: A pendulum
solve: system
symbols: {m: mass, g: acceleration, l: length, u: speed}
given:
  coordinates: {theta: angle}
  particles: {bob: {mass: m, at: [l*sin(theta), -l*cos(theta)]}}
  gravity: g
  results:
    speed: {speed: energy_function, for: theta, start: 0, start_rate: u/l}
    rate: {square_root: speed}
    top: {put_in: rate, values: {theta: pi}}
    stops: {roots: speed, for: cos(theta)}
statement: A bob <<m>> <<g>> <<l>> <<u>>.
parts:
  - {ask: How fast is it at the top?, answer: top}
  - {ask: Where does it stop?, answer: stops}
"""


def test_the_condition_of_one_result_is_no_assumption_of_the_page(tmp_path: Path) -> None:
    """The bob gets to the top only if it does not stop below."""
    text = page(
        tmp_path, edited(SWUNG, ("How fast is it at the top?", '"How fast?"'), ("Where does it stop?", '"Where?"'))
    )
    assert "Assume" not in text
    assert "For θ = π, which the motion reaches if u² > 4g l," in text
    assert "vanishes, as long as u² ≤ 4g l, when" in text


def test_a_bob_that_may_go_round_has_no_sign_behind_its_start(tmp_path: Path) -> None:
    behind = edited(SWUNG, ("{theta: pi}", "{theta: -pi/2}"), ("    stops: {roots: speed, for: cos(theta)}\n", ""))
    behind = edited(behind, ("  - {ask: Where does it stop?, answer: stops}\n", ""), ("the top?", "the top"))
    code, line, _ = refused(tmp_path, behind)
    assert (code, line) == ("sign-of-rate", 11)
    slow = edited(behind, ("  results:", "  assume: u**2 < 4*g*l\n  results:"))
    assert solved(tmp_path, slow)["top"].value.could_extract_minus_sign()


def test_a_motion_that_never_gets_far_away_is_refused(tmp_path: Path) -> None:
    slow = edited(ESCAPES, ("start_rate: v", "start_rate: sqrt(k/(m*r_0))"))
    code, line, said = refused(tmp_path, slow)
    assert (code, line) == ("not-reached", 10)
    assert "does not reach r = oo" in said


def test_the_speed_after_a_long_time_is_a_limit(tmp_path: Path) -> None:
    oil = edited(
        STONE,
        ("speed: {speed: energy_function, for: y,", "moves: {solution: motion_y, for: y,"),
        ("there: {put_in: speed, values: {y: u**2/(4*g)}}", f"speed: {{rate: moves}}\n    there: {LATE}"),
        ("gravity: g\n", "gravity: g\n  damping: {constant: c, at: stone}\n"),
    )
    assert str(solved(tmp_path, oil)["there"].value) == "-g*m/c"


def test_a_coordinate_is_not_small_all_the_time(tmp_path: Path) -> None:
    code, line, _ = refused(tmp_path, edited(ESCAPES, ("to: infinity", "to: 0")))
    assert (code, line) == ("changes", 10)


def test_resonance_by_the_given_numbers_is_refused(tmp_path: Path) -> None:
    code, line, said = refused(tmp_path, SWINGS)
    assert (code, line) == ("resonance", 11)
    assert "k - m*w**2 vanishes" in said


def test_the_amplitude_at_resonance_by_the_given_numbers_is_refused(tmp_path: Path) -> None:
    asked = ("moves: {solution: motion_x, for: x, start: 0, start_rate: 0}", "moves: {amplitude: motion_x, for: x}")
    assert refused(tmp_path, edited(SWINGS, asked))[:2] == ("resonance", 11)


def test_critical_damping_by_the_given_numbers_is_refused(tmp_path: Path) -> None:
    code, line, said = refused(tmp_path, edited(SWINGS, (FORCED, DAMPED), ("start: 0", "start: A")))
    assert (code, line) == ("open-case", 11)
    assert "critically damped only if c**2 - 4*k*m = 0" in said


def test_above_the_natural_frequency_by_the_given_numbers_it_is_in_antiphase(tmp_path: Path) -> None:
    asked = ("moves: {solution: motion_x, for: x, start: 0, start_rate: 0}", "moves: {amplitude: motion_x, for: x}")
    found = solved(tmp_path, edited(SWINGS, asked, ("w: 2 rad/s", "w: 3 rad/s")))
    assert str(found["moves_lag"].value) == "pi"


@pytest.mark.parametrize("through", ["[X, 0]", "[2*X, 0]"])
def test_a_surface_that_moves_but_that_nothing_carries_is_refused(tmp_path: Path, through: str) -> None:
    code, line, said = refused(tmp_path, edited(WHEEL, ("through: plank", f"through: {through}"), (", of: plank", "")))
    assert (code, line) == ("which-body", 9)
    assert "the surface moves with X, but no body carries it" in said


def test_a_surface_of_the_plank_is_carried(tmp_path: Path) -> None:
    assert solved(tmp_path, WHEEL)


@pytest.mark.parametrize(("letter", "aim", "holds"), [("k", "infinity", False), ("K", "k", True), ("K", "0", False)])
def test_a_limit_keeps_what_is_assumed(tmp_path: Path, letter: str, aim: str, holds: bool) -> None:
    text = f"""\
title: A mass between two springs
solve: system
symbols: {{m: mass, k: spring constant, K: spring constant}}
given:
  coordinates: {{x: length}}
  particles: {{p: {{mass: m, at: [x, 0]}}}}
  springs: [{{constant: k, from: [0, 0], to: p}}, {{constant: K, from: [0, 0], to: p}}]
  assume: k < K < 4*k
  results:
    there: {{limit: frequency, for: {letter}, to: {aim}}}
statement: A mass <<m>> <<k>> <<K>>.
parts:
  - ask: How fast does it swing?
    answer: there
"""
    if holds:
        assert str(solved(tmp_path, text)["there"].value) == "sqrt(2)*sqrt(k)/sqrt(m)"
    else:
        code, line, said = refused(tmp_path, text)
        assert (code, line) == ("contradiction", 10)
        assert "not all assumptions hold" in said


def test_a_place_that_is_a_result_is_judged_too(tmp_path: Path) -> None:
    """The hollow on the other side is a root, and the bead gets there only over the hill."""
    other = edited(
        HILL,
        ("values: {x: a}", "results: hollow"),
        ("    there:", "    hollow: {roots: force, for: x, root: positive}\n    there:"),
        ("  results:", "  results:\n    force: {value: x**2 - a**2}"),
    )
    code, _, said = refused(tmp_path, other)
    assert code == "not-reached"
    assert "on the way x_dot**2 can be negative" in said


def test_a_contact_is_not_followed_from_another_start_than_the_motion(tmp_path: Path) -> None:
    """Off a sphere: the speed is that of a start on top, so the contact is not judged from elsewhere."""
    sphere = (ROOT / "problems" / "library" / "constraints" / "off_a_sphere.yaml").read_text(encoding="utf-8")
    (found,) = complaints(tmp_path, edited(sphere, ("cos(theta), start: 1}", "cos(theta), start: 9/10}")))
    assert found.code == "contradiction"
    assert "from cos(theta) = 1, not from 9/10" in found.message


def test_an_unstable_equilibrium_is_approached_and_not_reached(tmp_path: Path) -> None:
    """A pendulum with just the energy of the upper position; from any other start the speed there is not zero."""
    quoted = ("How fast is it at the top?", '"How fast?"'), ("Where does it stop?", '"Where?"')
    exact = edited(SWUNG, *quoted, ("start_rate: u/l", "start_rate: 2*sqrt(g/l)"))
    code, _, said = refused(tmp_path, exact)
    assert code == "not-reached" and "does not reach theta = pi in a finite time" in said


def test_a_place_of_rest_is_reached_only_if_the_force_there_is_known_to_point_back(tmp_path: Path) -> None:
    pulled = edited(
        STONE,
        ("{y: length}", "{y: length}\n  potential: (p - q)*y"),
        ("g: acceleration, u: speed, c: damping constant", "p: force, q: force, u: speed"),
        ("  gravity: g\n", ""),
        ("u**2/(4*g)", "m*u**2/(2*(p - q))"),
        ("<<g>> <<u>> <<c>>", "<<p>> <<q>> <<u>>"),
    )
    code, _, said = refused(tmp_path, pulled)
    assert code == "not-reached" and "not known whether the motion reaches" in said
    known = edited(pulled, ("  results:", "  assume: [p > q]\n  results:"))
    assert solved(tmp_path, known)["there"].value == 0


@pytest.mark.parametrize("word", ["contact", "taut"])
def test_a_sentence_about_a_contact_or_a_string_that_the_system_lacks_is_refused(
    word: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert solved(tmp_path, ESCAPES)
    monkeypatch.setattr(turning_points, "_may_end", lambda speed: word)
    (found,) = complaints(tmp_path, ESCAPES)
    assert found.code == "unverified"
