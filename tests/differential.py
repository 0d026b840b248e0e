"""Derive the equations of motion of random systems twice: by `derive`, and numerically from positions alone.

The second derivation shares no code with `derive`. A body is represented by a few mass points (two on a rod, four on a
disc) with the second moments of the body. Every position is a function of time along a path q(t), and its acceleration
is a numerical second derivative. The equation of motion of q is d'Alembert's principle: the sum of (m a - F) . dr/dq -
lambda df/dq is zero. Springs, drag, weight and given forces act on positions.

`python -P -m tests.differential --count 300 --seed 1` tries many systems; the suite tries a few.
"""

from __future__ import annotations

import argparse
import random
import re
import signal
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mpmath import mp, mpf
from sympy import Expr, Integer, Symbol, cos, lambdify, sin, sqrt

from derive.course.problem import load_problem, run_solve
from derive.errors import DeriveError
from derive.steps.derivation import returned_quantities, with_ancestors
from derive.steps.record import Run
from tests.courses import ROOT

Place = tuple[Expr, ...]

KINDS = {
    **dict.fromkeys(("m", "M", "mu"), "mass"),
    **dict.fromkeys(("l", "a", "b", "d", "A", "R"), "length"),
    **dict.fromkeys(("k", "kappa"), "spring constant"),
    **dict.fromkeys(("Omega", "omega"), "angular speed"),
    "alpha": "angle in (0, pi/2)",
    "g": "acceleration",
    "w": "acceleration",
    "F": "force",
    "tau": "torque",
    "E_0": "energy",
    "q": "charge",
    "B": "magnetic field",
    "c": "damping constant",
}
ANGLES, LENGTHS = ("theta", "phi", "psi"), ("x", "y", "s")
LETTER = {name: Symbol(name, positive=True) for name in KINDS}
COORDINATE = {name: Symbol(name, real=True) for name in (*ANGLES, *LENGTHS, "r")}
t = Symbol("t", real=True)
STATES, DIGITS = 4, 30  # number of instants that are compared, and digits of the numbers
LIMIT = 30  # seconds for one system


@dataclass
class Drawn:
    """A random system: its text for `derive`, and its positions and forces for the other derivation."""

    kinds: dict[str, str] = field(default_factory=dict)
    axes: str = ""
    lines: list[str] = field(default_factory=list)
    points: list[tuple[Expr, Place]] = field(default_factory=list)
    springs: list[tuple[Expr, Expr, Place, Place]] = field(default_factory=list)
    drags: list[tuple[Expr, Place]] = field(default_factory=list)
    pushes: list[tuple[Place, Place]] = field(default_factory=list)
    weights: list[tuple[Expr, Place]] = field(default_factory=list)
    fields: list[Place] = field(default_factory=list)  # of a charge q; B is along the last axis or towards the reader
    energies: list[Expr] = field(default_factory=list)
    condition: Expr | None = None
    rates: dict[str, Expr] = field(default_factory=dict)  # factors of the rates in a condition that is linear in them

    @property
    def text(self) -> str:
        used = {word for line in (self.axes, *self.lines) for word in re.findall("[a-zA-Z_0]+", line)}
        letters = ", ".join(f"{name}: {_quoted(kind)}" for name, kind in KINDS.items() if name in used)
        coordinates = ", ".join(f"{name}: {kind}" for name, kind in self.kinds.items())
        given = [f"coordinates: {{{coordinates}}}", *([f"axes: {self.axes}"] if self.axes else []), *self.lines]
        return "\n".join(
            [
                "title: A random system",
                "solve: system",
                f"symbols: {{{letters}}}",
                "given:",
                *(f"  {line}" for line in given),
                "statement: A system.",
                "parts:",
                "  - {ask: Find the equations of motion., answer: equations_of_motion}",
                "",
            ]
        )


def _quoted(kind: str) -> str:
    return f"'{kind}'" if "(" in kind else kind


# --- drawing a system -----------------------------------------------------------------------------------------------


def drawn(seed: str) -> Drawn:
    """Draw a system: one to three coordinates; particles, rods, discs; springs, drag, forces, rotating axes, a
    constraint."""
    dice, system = random.Random(seed), Drawn()
    names = dice.sample([*ANGLES, *LENGTHS, "r"], dice.choice((1, 2, 2, 3)))
    system.kinds = {q: "angle" if q in ANGLES else "positive length" if q == "r" else "length" for q in names}
    in_space = dice.random() < 0.3
    if in_space:
        _fill_space(dice, system, names)
    else:
        _fill_plane(dice, system, names)
    if dice.random() < 0.7:
        system.lines.append("gravity: g")
        system.weights = [(mass, place) for mass, place in system.points]
    return system


def _fill_plane(dice: random.Random, system: Drawn, names: Sequence[str]) -> None:
    left = list(names)
    base: Place = (Integer(0), Integer(0))
    ends: list[Place] = []
    particles, bodies = [], []
    masses = dice.sample(["m", "M", "mu"], 3)
    for i, mass in enumerate(masses[: dice.choice((1, 2, 2, 3))]):
        own = [left.pop(0)] if left else [dice.choice(names)]
        if left and (len(left) >= 3 - i or dice.random() < 0.4):
            own.append(left.pop(0))
        start = base if dice.random() < 0.5 or not ends else dice.choice(ends)
        place = start
        for q in own:
            arm = _arm(dice, q)
            if len(own) > 1 and dice.random() < 0.15:
                arm = tuple(c * cos(COORDINATE[other]) for c in arm for other in own if other in ANGLES) or arm
                arm = arm if len(arm) == 2 else _arm(dice, q)
            place = _added(place, arm)
        ends.append(place)
        angle = next((q for q in own if q in ANGLES), None)
        if angle and dice.random() < 0.35:
            bodies.append(_body(dice, system, ("wheel", "plate", "bar")[i], LETTER[mass], place, COORDINATE[angle]))
        else:
            system.points.append((LETTER[mass], place))
            particles.append(f"p_{i}: {{mass: {mass}, at: {_list(place)}}}")
    while left:  # coordinates on which no part depends yet
        q = left.pop(0)
        place = _added(dice.choice(ends), _arm(dice, q))
        ends.append(place)
        system.points.append((LETTER["m"], place))
        particles.append(f"p_{q}: {{mass: m, at: {_list(place)}}}")
    if particles:
        system.lines.append(f"particles: {{{', '.join(particles)}}}")
    if bodies:
        system.lines.append(f"bodies: {{{', '.join(bodies)}}}")
    _connect(dice, system, ends, 2)


def _arm(dice: random.Random, q: str) -> Place:
    """Return the displacement, as a function of the coordinate, from one place to the next."""
    s, (l, a, b, alpha) = COORDINATE[q], (LETTER[name] for name in ("l", "a", "b", "alpha"))
    if q in ANGLES:
        long = dice.choice((l, a, l / 2))
        ways = [
            (long * sin(s), -long * cos(s)),
            (long * sin(s), -long * cos(s)),
            (long * cos(s), long * sin(s)),
            (a * s - a * sin(s), -a + a * cos(s)),
            (b * s, Integer(0)),
            (b * s, a * sin(s)),
            (long * sin(s) ** 3, -long * cos(s) ** 2),
        ]
    elif q == "r":
        ways = [
            (s, Integer(0)),
            (Integer(0), -s),
            (s * cos(alpha), s * sin(alpha)),
            (s * cos(LETTER["Omega"] * t), s * sin(LETTER["Omega"] * t)),
        ]
    else:
        driven = LETTER["A"] * cos(LETTER["omega"] * t)
        ways = [
            (s, Integer(0)),
            (a + s, Integer(0)),
            (Integer(0), -s),
            (Integer(0), -l - s),
            (s * cos(alpha), -s * sin(alpha)),
            (s, s**2 / (2 * b)),
            (s, b * cos(s / b)),
            (s + driven, Integer(0)),
            (Integer(0), s + LETTER["w"] * t**2 / 2),
        ]
    return dice.choice(ways)


def _body(dice: random.Random, system: Drawn, name: str, mass: Expr, centre: Place, angle: Expr) -> str:
    """Add the mass points of a rod or a disc, with its second moments about its centre of mass; return its text."""
    across = (cos(angle), sin(angle))
    if dice.random() < 0.5:
        long = LETTER["b"]
        arms = [long / (2 * sqrt(3)), -long / (2 * sqrt(3))]
        system.points += [(mass / 2, _added(centre, tuple(arm * c for c in across))) for arm in arms]
        shape = "shape: rod, length: b"
    else:
        arm = LETTER["R"] / sqrt(2)
        corners = [across, (-across[1], across[0]), tuple(-c for c in across), (across[1], -across[0])]
        system.points += [(mass / 4, _added(centre, tuple(arm * c for c in each))) for each in corners]
        shape = "shape: disc, radius: R"
    return f"{name}: {{{shape}, mass: {mass}, turned: {angle}, centre: {_list(centre)}}}"


def _fill_space(dice: random.Random, system: Drawn, names: Sequence[str]) -> None:
    Omega, l, R = LETTER["Omega"], LETTER["l"], LETTER["R"]
    angles = [q for q in names if q in ANGLES]
    turns = [("z", dice.choice((Omega, Omega, sqrt(LETTER["k"] / LETTER["m"]))) * t)]
    if angles and dice.random() < 0.4:
        turns = [("z", COORDINATE[angles[0]])] if dice.random() < 0.5 else [*turns, ("x", COORDINATE[angles[0]])]
    turning = {q for _, angle in turns for q in names if angle.has(COORDINATE[q])}
    system.axes = "{frame: [" + ", ".join(f"{{{axis}: {angle}}}" for axis, angle in turns) + "]}"
    inside = [q for q in names if q not in turning]
    by: list[Expr] = [Integer(0), Integer(0), Integer(0)]
    for q in inside:
        s, i = COORDINATE[q], dice.randrange(3)
        if q in ANGLES:
            by[i] += dice.choice((l, R)) * sin(s)
            by[(i + 1) % 3] += -dice.choice((l, R)) * cos(s)
        else:
            by[i] += s
    if not inside or turning or dice.random() < 0.3:
        by[0] += R
    if turns[-1][0] == "x":
        by[1] += R
    place = tuple(by)
    for axis, angle in reversed(turns):
        place = _turned(place, axis, angle)
    system.points.append((LETTER["m"], place))
    system.lines.append(f"particles: {{p: {{mass: m, at: {{in: frame, by: {_list(by)}}}}}}}")
    _connect(dice, system, [place], 3)


def _turned(place: Place, axis: str, angle: Expr) -> Place:
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    found = list(place)
    found[i], found[j] = (
        place[i] * cos(angle) - place[j] * sin(angle),
        place[i] * sin(angle) + place[j] * cos(angle),
    )
    return tuple(found)


def _connect(dice: random.Random, system: Drawn, ends: Sequence[Place], size: int) -> None:
    d, k, zero = LETTER["d"], LETTER["k"], Integer(0)
    on_axis = (zero, d, -d, LETTER["A"] - d, 2 * d)
    walls: list[Place] = [(at, *(zero,) * (size - 1)) for at in on_axis] + [(*(zero,) * (size - 1), d)]
    if dice.random() < 0.6:
        lines = []
        for constant in (k, LETTER["kappa"])[: dice.choice((1, 1, 2))]:
            end = dice.choice(ends)
            start = dice.choice([*walls, *(other for other in ends if other != end)])
            natural = dice.choice((zero, zero, d, LETTER["l"]))
            if all((one - other).expand() == 0 for one, other in zip(start, end, strict=True)):
                continue
            system.springs.append((constant, natural, start, end))
            length = f", length: {natural}" if natural != 0 else ""
            lines.append(f"{{constant: {constant}, from: {_list(start)}, to: {_list(end)}{length}}}")
        if lines:
            system.lines.append(f"springs: [{', '.join(lines)}]")
    if dice.random() < 0.3:
        end = dice.choice(ends)
        system.drags.append((LETTER["c"], end))
        system.lines.append(f"damping: {{constant: c, at: {_list(end)}}}")
    if dice.random() < 0.3:
        end = dice.choice(ends)
        push = [zero] * size
        push[dice.randrange(size)] = LETTER["F"] * dice.choice((Integer(1), cos(LETTER["omega"] * t)))
        system.pushes.append((tuple(push), end))
        system.lines.append(f"forces: {{components: {_list(push)}, at: {_list(end)}}}")
    if dice.random() < 0.15:
        q = dice.choice(list(system.kinds))
        constant = LETTER["c"] * (LETTER["l"] ** 2 if q in ANGLES else 1)
        system.drags.append((constant, (COORDINATE[q],)))
        if not any(line.startswith("damping") for line in system.lines):
            system.lines.append(f"damping: {{constant: {constant}, on: {q}}}")
        else:
            system.drags.pop()
    if dice.random() < 0.15:
        end = dice.choice(ends)
        system.fields.append(end)
        field_of = "B" if size == 2 else "[0, 0, B]"
        system.lines.append(f"charges: {{charge: q, at: {_list(end)}, magnetic: {field_of}}}")
    if dice.random() < 0.2:
        q = dice.choice(list(system.kinds))
        u = COORDINATE[q] if q in ANGLES else COORDINATE[q] / LETTER["a"]
        energy = LETTER["E_0"] * dice.choice((cos(u), u**4 / 4, u**2 * cos(LETTER["omega"] * t), sin(u) * u))
        system.energies.append(energy)
        system.lines.append(f"potential: {energy}")
    if len(system.kinds) > 1 and dice.random() < 0.1:
        one, other = dice.sample(list(system.kinds), 2)
        factors = {q: LETTER["a"] if q in ANGLES else Integer(1) for q in (one, other)}
        factors[one] *= dice.choice((Integer(1), cos(COORDINATE[other] / (1 if other in ANGLES else LETTER["a"]))))
        system.rates = factors
        condition = " + ".join(f"{factor}*{q}_dot" for q, factor in factors.items())
        system.lines.append(f"constraints: {{condition: {condition}, force: Q}}")
    elif len(system.kinds) > 1 and dice.random() < 0.3:
        one, other = dice.sample(list(system.kinds), 2)
        as_lengths = [COORDINATE[q] * (LETTER["a"] if q in ANGLES else 1) for q in (one, other)]
        condition = dice.choice(
            (as_lengths[0] - as_lengths[1], as_lengths[0] + as_lengths[1] / 2, sum(u**2 for u in as_lengths))
        )
        equals = LETTER["l"] ** 2 if condition.as_poly(*as_lengths) and condition.has(as_lengths[0] ** 2) else zero
        system.condition = condition
        told = f", equals: {equals}" if equals != 0 else ""
        system.lines.append(f"constraints: {{condition: {condition}{told}, force: Q}}")


def _added(one: Place, other: Place) -> Place:
    return tuple(a + b for a, b in zip(one, other, strict=True))


def _list(place: Sequence[Expr]) -> str:
    return "[" + ", ".join(str(c) for c in place) + "]"


# --- the other derivation -------------------------------------------------------------------------------------------


class Positions:
    """The residual of the equation of motion of each coordinate, from positions along a path."""

    def __init__(self, system: Drawn, numbers: dict[str, Any]) -> None:
        self.system, self.names = system, list(system.kinds)
        self._numbers = numbers
        self._functions: dict[Place, Any] = {}

    def _at(self, place: Place, q: Sequence[Any], time: Any) -> list[Any]:
        if place not in self._functions:
            letters = {s for c in place for s in c.free_symbols} - {COORDINATE[n] for n in self.names} - {t}
            known = sorted(letters, key=str)
            function = lambdify([*(COORDINATE[n] for n in self.names), t, *known], list(place), "mpmath")
            self._functions[place] = (function, [self._numbers[str(s)] for s in known])
        function, known = self._functions[place]
        return [mpf(x) for x in function(*q, time, *known)]

    def residual(self, j: int, path: Sequence[tuple[Any, Any, Any]], time: Any, multiplier: Any) -> Any:
        """Return the inertial force minus the forces and minus the constraint force, along the j-th coordinate."""
        here = [q for q, _, _ in path]

        def moved(s: Any) -> list[Any]:
            return [q + v * (s - time) + w * (s - time) ** 2 / 2 for q, v, w in path]

        def motion(place: Place, order: int) -> list[Any]:
            return [mp.diff(lambda s, i=i: self._at(place, moved(s), s)[i], time, order) for i in range(len(place))]

        def along(place: Place) -> list[Any]:
            def shifted(x: Any, i: int) -> Any:
                return self._at(place, [x if n == j else q for n, q in enumerate(here)], time)[i]

            return [mp.diff(lambda x, i=i: shifted(x, i), here[j]) for i in range(len(place))]

        def number(value: Expr) -> Any:
            return self._at((value,), here, time)[0]

        def dot(u: Sequence[Any], v: Sequence[Any]) -> Any:
            return sum((a * b for a, b in zip(u, v, strict=True)), mpf(0))

        found = mpf(0)
        for mass, place in self.system.points:
            found += number(mass) * dot(motion(place, 2), along(place))
        for mass, place in self.system.weights:
            found += number(mass) * self._numbers["g"] * along(place)[-1]
        for constant, natural, start, end in self.system.springs:
            one, other = self._at(start, here, time), self._at(end, here, time)
            way = [b - a for a, b in zip(one, other, strict=True)]
            length = mp.sqrt(dot(way, way))
            pull = [number(constant) * (length - number(natural)) * c / length for c in way]
            found += dot(pull, [b - a for a, b in zip(along(start), along(end), strict=True)])
        for constant, place in self.system.drags:
            found += number(constant) * dot(motion(place, 1), along(place))
        for components, place in self.system.pushes:
            found -= dot([number(c) for c in components], along(place))
        for place in self.system.fields:
            v = motion(place, 1)
            strength = self._numbers["q"] * self._numbers["B"]
            found -= dot([strength * v[1], -strength * v[0], mpf(0)][: len(place)], along(place))
        for energy in self.system.energies:
            found += along((energy,))[0]
        for q, factor in self.system.rates.items():
            found -= multiplier * number(factor) if q == self.names[j] else 0
        if self.system.condition is not None:
            found -= multiplier * along((self.system.condition,))[0]
        return found


# --- the comparison -------------------------------------------------------------------------------------------------


@dataclass
class Outcome:
    """The result for one system: "agrees", "disagrees", "refused" or "failed", with the reason."""

    seed: str
    verdict: str
    reason: str = ""
    seconds: float = 0


def compared(seed: str, folder: Path) -> Outcome:
    system, begun = drawn(seed), time.monotonic()
    try:
        with _limited():
            steps, conditions = derived(system, folder)
    except DeriveError as refusal:
        return Outcome(seed, "refused", str(refusal).partition("\n")[0], time.monotonic() - begun)
    except Exception as failure:  # this test looks for internal errors
        return Outcome(seed, "failed", f"{type(failure).__name__}: {failure}", time.monotonic() - begun)
    seconds = time.monotonic() - begun
    with mp.workdps(DIGITS):
        wrong = disagreement(system, steps, conditions, random.Random(seed))
    return Outcome(seed, "disagrees" if wrong else "agrees", wrong, seconds)


@contextmanager
def _limited() -> Iterator[None]:
    def stop(*_: Any) -> None:
        raise TimeoutError(f"more than {LIMIT} seconds")

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(LIMIT)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def derived(system: Drawn, folder: Path) -> tuple[dict[str, Expr], list[Expr]]:
    problems = folder / "problems" / "trial"
    problems.mkdir(parents=True, exist_ok=True)
    (folder / "templates").exists() or (folder / "templates").symlink_to(ROOT / "templates")
    (problems / "set.yaml").write_text("course: C\ntitle: T\nproblems: [one]\n", encoding="utf-8")
    (problems / "one.yaml").write_text(system.text, encoding="utf-8")
    run = Run()
    problem = load_problem(folder, "trial/one")
    steps = with_ancestors(returned_quantities(run_solve(problem, run)))
    found = {q: _residual_of(steps[f"motion_{q}"].value) for q in system.kinds}
    return found, [_residual_of(each) for each in run.assumed if each.operator == ">"]


def _residual_of(relation: Any) -> Expr:
    return (relation.left - relation.right).doit()


def disagreement(system: Drawn, steps: dict[str, Expr], conditions: Sequence[Expr], dice: random.Random) -> str:
    """Return a coordinate whose two equations are not multiples of each other at all instants; empty if there is
    none."""
    numbers = {name: mpf(dice.uniform(0.5, 2)) for name in KINDS} | {"alpha": mpf(dice.uniform(0.3, 1.2))}
    positions = Positions(system, numbers)
    names = list(system.kinds)
    pairs: dict[str, list[tuple[Any, Any]]] = {q: [] for q in names}
    for _ in range(STATES):
        path, time_now, multiplier = _state(system, conditions, numbers, dice)
        known = {**numbers, "t": time_now, "Q": multiplier}
        for q, (value, v, w) in zip(names, path, strict=True):
            known |= {q: value, f"{q}_dot": v, f"{q}_ddot": w}
        for j, q in enumerate(names):
            own = _number(steps[q], known)
            pairs[q].append((own, positions.residual(j, path, time_now, multiplier)))
    for q, both in pairs.items():
        size = max(abs(other) for _, other in both)
        largest = max(abs(own) for own, _ in both)
        if size < mpf(10) ** -12 and largest < mpf(10) ** -12:
            continue
        reference, expected = max(both, key=lambda pair: abs(pair[1]))
        if any(abs(own * expected - reference * other) > mpf(10) ** -10 * largest * size for own, other in both):
            return f"{q}: {steps[q]}"
        if reference == 0:
            return f"{q}: no motion"
    return ""


def _state(system: Drawn, conditions: Sequence[Expr], numbers: dict[str, Any], dice: random.Random) -> Any:
    """Return coordinates, rates and accelerations at one instant at which the assumptions of the page hold."""
    for size in [1.0] * 20 + [0.2] * 20 + [0.05] * 20:
        path = []
        for kind in system.kinds.values():
            q = dice.uniform(0.5, 2) if kind == "positive length" else size * dice.uniform(-2, 2)
            path.append((mpf(q), mpf(dice.uniform(-1, 1)), mpf(dice.uniform(-1, 1))))
        instant = mpf(dice.uniform(0, 3))
        known = {**numbers, "t": instant, **{q: value for q, (value, _, _) in zip(system.kinds, path, strict=True)}}
        if all(_number(each, known) > 0 for each in conditions):
            break
    return path, instant, mpf(dice.uniform(-1, 1))


def _number(value: Expr, known: dict[str, Any]) -> Any:
    letters = sorted(value.free_symbols, key=str)
    return mpf(lambdify(letters, value, "mpmath")(*(known[str(s)] for s in letters)))


# --- many of them ---------------------------------------------------------------------------------------------------


def main() -> int:
    parser = argparse.ArgumentParser(description="Random systems against an independent derivation.")
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--show", help="the text of one system, by its number")
    given = parser.parse_args()
    if given.show is not None:
        print(drawn(f"{given.seed}/{given.show}").text)
        return 0
    outcomes = []
    with tempfile.TemporaryDirectory() as folder:
        for n in range(given.count):
            outcome = compared(f"{given.seed}/{n}", Path(folder))
            outcomes.append(outcome)
            if outcome.verdict != "agrees":
                print(f"{outcome.seed}: {outcome.verdict}: {outcome.reason}", flush=True)
    count = {verdict: sum(each.verdict == verdict for each in outcomes) for verdict in VERDICTS}
    print(", ".join(f"{n} {verdict}" for verdict, n in count.items()), f"of {len(outcomes)}")
    print(f"slowest: {max((each.seconds, each.seed) for each in outcomes)}")
    wrong = count["disagrees"] + count["failed"]
    return 1 if wrong or count["refused"] > MOST_REFUSED * len(outcomes) else 0


VERDICTS = ("agrees", "disagrees", "refused", "failed")
MOST_REFUSED = 0.02

if __name__ == "__main__":
    sys.exit(main())
