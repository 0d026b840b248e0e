"""Mistakes as an author makes them: each has a complaint, an error or a warning, at the line where it was made."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.solution import rendered
from derive.errors import DeriveError
from tests.stock.described import course_with, edited

SYSTEM = """\
title: A pendulum
solve: system
points: 6
symbols: {l: length, m: mass, g: acceleration, k: spring constant}
values: {l: 40 cm, m: 10 g, g: 9.81 m/s^2, k: 2 N/m}
given:
  coordinates: {theta: angle}
  places: {A: [l*sin(theta), -l*cos(theta)]}
  particles: {bob: {mass: m, at: A}}
  gravity: g
  springs: {constant: k, from: [0, -l], to: A}
  at: {theta: 0}
  results:
    gentle: {limit: frequency, for: k, to: 0}
statement: >
  A bob of mass <<m>> hangs by a rod of length <<l>> and is held by a spring <<k>> where the acceleration is <<g>>.
parts:
  - ask: Find the equation of motion.
    answer: [lagrangian, equations_of_motion]
    points: 3
    rubric: {lagrangian: 1}
  - ask: Find the frequency.
    answer: [frequency, gentle]
    points: 3
    form: {frequency: {unit: rad/s, figures: 3}}
wording:
  frequency: The frequency is <<chain>>
show: {lagrangian: full}
limits:
  - {of: frequency, letter: k, to: 0, why: as without the spring}
drawings: {system: {at: statement}}
figures: 4
"""
BODY = """\
title: A cone
solve: body
symbols: {R: length, h: length, M: mass}
given:
  body: {shape: cone, radius: R, height: h, mass: M, points: {rim: [R, 0, h]}}
  about: rim
  direction: x
statement: A cone of mass <<M>>, radius <<R>> and height <<h>>.
parts:
  - ask: Find its tensor.
    answer: [inertia_tensor, moment_about]
"""
ROTATION = """\
title: A block
solve: rotation
symbols: {a: length, M: mass, omega: angular speed}
given:
  body: {shape: cuboid, sides: [a, 2*a, 3*a], mass: M}
  rate: omega
  along: diagonal
statement: A block of mass <<M>> and edges in proportion to <<a>> turns at the rate <<omega>>.
parts:
  - ask: Find the torque.
    answer: torque
"""

IMPACT = "  at: {theta: 0}\n  impact: {impulses: {components: [0, 0], at: A}}\n"

ZERO = "    answer: [inertia_tensor, moment_about]\n    points: 0\n"

MISTAKES = [
    # keys, at each level
    (SYSTEM, "title: A", "titel: A", "did you mean `title`?"),
    (SYSTEM, "points: 6\n", "point: 6\n", "did you mean `points`?"),
    (SYSTEM, "  gravity: g", "  gravty: g", "did you mean `gravity`?"),
    (SYSTEM, "{mass: m, at: A}", "{mas: m, at: A}", "did you mean `mass`?"),
    (SYSTEM, "from: [0, -l]", "form: [0, -l]", "did you mean `from`?"),
    (SYSTEM, "{limit: frequency", "{limt: frequency", "did you mean `limit`?"),
    (SYSTEM, "for: k, to: 0}", "fro: k, to: 0}", "did you mean `for`?"),
    (SYSTEM, "for: k, to: 0}", "for: k, too: 0}", "did you mean `to`?"),
    (SYSTEM, "for: k, to: 0}", "for: k, to: 0, bound: 1}", "`bound` has no effect on `limit`"),
    (SYSTEM, "for: k, to: 0}", "for: k, to: 0, start: 1}", "`start` has no effect on `limit`"),
    (SYSTEM, "answer: [frequency, gentle]", "answers: [frequency, gentle]", "did you mean `answer`?"),
    (SYSTEM, "{unit: rad/s, figures: 3}", "{units: rad/s, figures: 3}", "did you mean `unit`?"),
    (SYSTEM, "letter: k, to: 0, why", "lettr: k, to: 0, why", "did you mean `letter`?"),
    (SYSTEM, "{system: {at: statement}}", "{system: {att: statement}}", "did you mean `at`?"),
    (SYSTEM, "points: 6\n", "points: 6\ntemplate: other\n", "a problem has no key `template`"),
    (SYSTEM, "points: 6\n", "points: 6\npapers: [hint]\n", "a problem has no key `papers`"),
    (SYSTEM, "  gravity: g\n", "  gravity: g\n  bodies: {rod: {shape: rod, mass: m, at: A}}\n", "write `centre`: "),
    # twice
    (SYSTEM, "  gravity: g\n", "  gravity: g\n  gravity: 2*g\n", "`gravity` is given twice"),
    (SYSTEM, "l: length, m: mass", "l: length, l: mass", "`l` is given twice"),
    (SYSTEM, "{theta: angle}", "{theta: angle, theta: length}", "`theta` is given twice"),
    (SYSTEM, "{bob: {mass: m, at: A}}", "{bob: {mass: m, mass: m, at: A}}", "`mass` is given twice"),
    (SYSTEM, "answer: [frequency, gentle]", "answer: [frequency, frequency]", "`frequency` is listed twice"),
    (SYSTEM, "l: 40 cm", "l: 40 cm, l: 1 m", "`l` is given twice"),
    # letters
    (SYSTEM, "l: 40 cm", "L: 40 cm", "`L` is not declared"),
    (SYSTEM, "k: 2 N/m", "k: 2 N/m, b: 3 m", "`b` is not declared"),
    (SYSTEM, "k: 2 N/m", "k: 2 N/m, theta: 3 deg", "`theta` is a coordinate, so it cannot have a number"),
    (SYSTEM, "k: spring constant}", "k: spring constant, b: length}", "`b` is declared, but nothing"),
    (SYSTEM, "  gravity: g\n", "", "`g` is declared, but nothing under `given` uses it"),
    (SYSTEM, "{theta: angle}", "{theta: angle, x: length}", "depends on the coordinate `x`"),
    (SYSTEM, "{mass: m, at", "{mass: mm, at", "`mm` is not declared"),
    (SYSTEM, "{mass: m, at", "{mass: l, at", "`mass` must be a mass"),
    (SYSTEM, "gravity: g", "gravity: l", "`gravity` must be an acceleration"),
    (SYSTEM, "at: {theta: 0}", "at: {thet: 0}", "did you mean `theta`?"),
    (SYSTEM, "at: {theta: 0}", "at: rest_9", "`rest_9` is not one of `equilibria`"),
    (SYSTEM, "for: k, to: 0}", "for: q, to: 0}", "`q` is not declared"),
    (SYSTEM, "letter: k, to: 0, why", "letter: q, to: 0, why", "`q` is not declared"),
    (SYSTEM, "length <<l>>", "length <<ll>>", "nothing on this page is called `ll`"),
    # names
    (
        SYSTEM,
        "answer: [frequency, gentle]",
        "answer: [frequncy, gentle]",
        "has no answer `frequency`",
        "form: {frequency",
    ),
    (SYSTEM, "{limit: frequency", "{limit: frequncy", "did you mean `frequency`?"),
    (SYSTEM, "    gentle: {", "    frequency: {", "`frequency` is already the name of an answer"),
    (SYSTEM, "    gentle: {", "    theta_dot: {", "`theta_dot` is already a symbol of this problem"),
    (SYSTEM, "    gentle: {", "    other: {limit: period, for: k, to: 0}\n    gentle: {", "the result `other`"),
    (SYSTEM, "at: A}}", "at: B}}", "`B` is not a named place"),
    (SYSTEM, "rubric: {lagrangian: 1}", "rubric: {lagrangan: 1}", "`lagrangan`"),
    (SYSTEM, "form: {frequency:", "form: {frequncy:", "did you mean `frequency`?"),
    (SYSTEM, "form: {frequency:", "form: {period:", "this part has no answer `period`"),
    (SYSTEM, "  frequency: The", "  frequncy: The", "`frequncy`"),
    (SYSTEM, "show: {lagrangian", "show: {lagrangan", "`lagrangan`"),
    (SYSTEM, "{of: frequency", "{of: frequncy", "did you mean `frequency`?"),
    (SYSTEM, "letter: k, to: 0, why", "letter: k, known: pendulum, why", "`pendulum`"),
    (SYSTEM, "{of: frequency, letter: k", "{of: kinetic_energy, letter: k", "`kinetic_energy` does not depend on `k`"),
    (SYSTEM, "letter: k, to: 0, why", "where: {k: 0}, to: 0, why", "`to` is allowed only with `letter`"),
    (SYSTEM, "{system: {at", "{sistem: {at", "did you mean `system`?"),
    (SYSTEM, "at: statement}", "at: z}", "`z`"),
    (
        SYSTEM,
        "{system: {at: statement}}",
        "{system: {at: statement, range: [0, 1]}}",
        "`range` has no effect on `system`",
    ),
    (SYSTEM, "{system: {at: statement}}", "{system: {at: statement, cases: [{l: 1 m}]}}", "`cases` has no effect"),
    (SYSTEM, "{system: {at: statement}}", "{system: {at: hidden, caption: A bob.}}", "`caption` has no effect on"),
    (SYSTEM, "{system: {at: statement}}", "{system: {at: hidden, width: 4 cm}}", "`width` has no effect on `system`"),
    (SYSTEM, "  at: {theta: 0}\n", IMPACT, "nothing that is asked for depends on `impact`"),
    # values
    (SYSTEM, "{unit: rad/s,", "{unit: [rad/s, rad/s],", "`rad/s` is listed twice"),
    (SYSTEM, "{constant: k, from", "{constant: 0, from", "`constant` must be positive"),
    (SYSTEM, "points: 3\n    rubric", "points: 0\n    rubric", "points"),
    (SYSTEM, "points: 6\n", "points: 7\n", "`points` is 7"),
    (BODY, "    answer: [inertia_tensor, moment_about]\n", ZERO, "this part carries no points"),
    (SYSTEM, "unit: rad/s", "unit: kg", "`frequency`"),
    (SYSTEM, "unit: rad/s", "unit: rds", "rds"),
    (SYSTEM, "figures: 3", "figures: 0", "a whole number from 1"),
    (SYSTEM, "figures: 4", "figures: four", "a whole number from 1"),
    (SYSTEM, "show: {lagrangian: full}", "show: {lagrangian: fully}", "full, result or hidden"),
    (SYSTEM, "solve: system", "solve: sytem", "did you mean `system`?"),
    (SYSTEM, "{theta: angle}", "{theta: angel}", "did you mean `angle`?"),
    (SYSTEM, "g: 9.81 m/s^2", "g: 9.81 m/s", "`g` must be an acceleration"),
    (SYSTEM, "g: 9.81 m/s^2", "g: -9.81 m/s^2", "`g` must be positive"),
    # bodies and rotations
    (BODY, "shape: cone", "shape: coen", "did you mean `cone`?"),
    (BODY, "radius: R,", "radius: R, length: h,", "a cone has no `length`"),
    (BODY, "about: rim", "about: tip", "has no point `tip`"),
    (
        BODY,
        "answer: [inertia_tensor, moment_about]",
        "answer: [inertia_tensor]",
        "depends on `direction`",
        "direction: x",
    ),
    (BODY, "direction: x", "direction: w", "is not one"),
    (BODY, "  direction: x\n", "  direction: x\n  turned: {z: pi/3}\n", "depends on `turned`"),
    (BODY, "  direction: x\n", "  direction: x\n  origin: rim\n", "depends on `origin`"),
    (BODY, "  direction: x\n", "  direction: x\n  results: {half: {value: mass/2}}\n", "no part asks for the result"),
    (
        ROTATION,
        "  along: diagonal\n",
        "  along: diagonal\n  torque: [0, 0, 0]\n",
        "`torque` has no effect with `along`",
    ),
    (ROTATION, "  along: diagonal\n", "  along: diagonal\n  rates: [omega, 0, 0]\n", "`rates` cannot be combined"),
    (ROTATION, "along: diagonal", "along: digonal", "did you mean `diagonal`?"),
    (ROTATION, "answer: torque", "answer: torqe", "did you mean `torque`?"),
]


def told(folder: Path, text: str) -> list[tuple[int, str]]:
    try:
        found = rendered(course_with(folder, text), "trial/one", only=("text",)).warnings
    except DeriveError as error:
        found = error.complaints
    return [(c.place.line if c.place else 0, f"{c.message}; {c.help}") for c in found]


@pytest.mark.parametrize("text", [SYSTEM, BODY, ROTATION])
def test_nothing_is_told_of_what_is_right(text: str, tmp_path: Path) -> None:
    assert told(tmp_path, text) == []


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda mistake: f"{mistake[2]}".strip()[:40])
def test_a_mistake_is_told_where_it_was_made(mistake: tuple[str, ...], tmp_path: Path) -> None:
    text, old, new, said, *elsewhere = mistake
    changed = edited(text, (old, new))
    at = (
        changed.index(elsewhere[0])
        if elsewhere
        else next((i for i, (a, b) in enumerate(zip(text, changed, strict=False)) if a != b), len(text))
    )
    line = changed[:at].count("\n") + 1
    lines = {*range(line, line + new.count("\n") + 1)}
    if not new:  # what was left out is told of where it was declared
        lines = {4}
    found = told(tmp_path, changed)
    assert any(place in lines and said in message for place, message in found), (line, found)


def test_errors_on_which_no_step_depends_are_reported_with_those_of_the_page(tmp_path: Path) -> None:
    """Errors of drawings, observations, units and prose belong to different stages, but one run reports all."""
    text = """\
title: A pendulum
solve: system
symbols: {l: length, m: mass, g: acceleration}
given:
  coordinates: {theta: angle}
  particles: {bob: {mass: m, at: [l*sin(theta), -l*cos(theta)]}}
  gravity: g
statement: A bob <<nobody>>.
observations: [independant, below]
drawings: {system: {width: 3 kg, at: z}}
parts:
  - ask: Find the frequency <<nothing>>.
    answer: frequency
    form: {frequency: {unit: kg}}
"""
    found = told(tmp_path, text)
    assert [line for line, _ in found] == [8, 9, 9, 10, 10, 12, 14], found


def test_small_motions_need_a_symbol_for_a_constant_momentum(tmp_path: Path) -> None:
    text = """\
title: A planet
solve: system
symbols: {K: positive energy, a: length, m: mass, l: angular momentum}
given:
  coordinates: {r: positive length, phi: angle}
  particles: {planet: {mass: m, at: [r*cos(phi), r*sin(phi)]}}
  potential: -K*a/r
  conserved: {phi: 2*l}
statement: A planet.
parts:
  - ask: Find the frequency.
    answer: frequency
"""
    ((line, said),) = told(tmp_path, text)
    assert line == 12 and "small motions need a symbol for the momentum of phi, but `conserved` gives a value" in said
