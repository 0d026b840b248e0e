"""Measure the time of equations of motion against the size of the system, as ratios. Run by `make bench`.

    pendulum n    a chain of n rods with a mass at each joint, in a vertical plane
    springs N     N masses on a line between two walls, joined by springs

Three ratios are measured for each system. The first is the time of L and all equations of motion with every check,
divided by the time of SymPy's `LagrangesMethod`, which checks nothing (aim below 1). The second is the time of the laws
alone, without lines, routes and outcomes, divided by the time of `LagrangesMethod` (aim 1/20 from n = 4). The third, if
Maxima is installed, is the time of the laws divided by the time of Maxima (aim 3). Each runs in a separate process.
Times are processor seconds without imports; each is the least of several runs.
"""

from __future__ import annotations

import math
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from typing import Any

PENDULA, SPRINGS = range(2, 11), range(2, 11)
ROUNDS = 3


def everything_imported() -> None:
    """Import the modules that SymPy imports on first use, and `sympy.physics.mechanics`."""
    import sympy.assumptions.wrapper
    import sympy.physics.mechanics
    import sympy.sets.setexpr
    import sympy.tensor.array.expressions.array_expressions
    import sympy.tensor.array.expressions.arrayexpr_derivatives
    import sympy.tensor.tensor  # noqa: F401  SymPy imports it at the first sum


def seconds(work: Callable[[], object]) -> float:
    everything_imported()
    started = time.process_time()
    work()
    return time.process_time() - started


# --- with derive -----------------------------------------------------------------------------------------------------


def described(kind: str, n: int) -> Any:
    from sympy import cos, sin, symbols

    from derive.mechanics import Particle, System, coordinate, point, spring, weight

    masses = symbols(f"m_1:{n + 1}", positive=True)
    if kind == "springs":
        a, *constants = symbols(f"a k_1:{n + 2}", positive=True)
        moving = [coordinate(f"x_{i + 1}", "length") for i in range(n)]
        joints = [point(i * a + (moving[i - 1].symbol if 0 < i <= n else 0), 0) for i in range(n + 2)]
        ends = zip(constants, joints, joints[1:], strict=False)
        return System(*map(Particle, masses, joints[1:]), *(spring(k, u, v, natural=a) for k, u, v in ends))
    at, particles = point(0, 0), []
    for i, (mass, length) in enumerate(zip(masses, symbols(f"l_1:{n + 1}", positive=True), strict=True)):
        angle = coordinate(f"theta_{i + 1}")
        at = at + point(length * sin(angle), -length * cos(angle))
        particles.append(Particle(mass, at))
    return System(*particles, weight(symbols("g", positive=True)))


def derived(kind: str, n: int) -> float:
    from derive.mechanics import equations_of_motion, lagrangian
    from derive.steps.record import recorded

    with recorded():
        return seconds(lambda: equations_of_motion(lagrangian(described(kind, n))))


def laws_alone(kind: str, n: int) -> float:
    """Return the seconds for L = T - U and d/dt dL/dq_dot - dL/dq, collected by accelerations, and nothing else."""
    from sympy import Add, Rational

    import derive.mechanics  # noqa: F401  the time of this import is not counted
    from derive.algebra.collect import by_accelerations
    from derive.algebra.expressions import Partial, TimeRate, bound, explicit, rate
    from derive.steps.record import recorded

    def work() -> list[Any]:
        system = described(kind, n)
        moving = list(system.coordinates)
        speeds = [(p.mass, explicit(TimeRate(c, *moving))) for p in system.particles for c in p.at.components]
        heights = [p.mass * system.gravity * p.at.height for p in system.particles]
        stored = [explicit(bound(each.energy, {each.distance: each.length})) for each in system.between]
        L = Add(*(Rational(1, 2) * m * v**2 for m, v in speeds), *(-u for u in (*heights, *stored)))
        left = [explicit(TimeRate(Partial(L, rate(q)), *moving)) - explicit(Partial(L, q)) for q in moving]
        return [by_accelerations(each, moving) for each in left]

    with recorded():
        return seconds(work)


# --- with others -----------------------------------------------------------------------------------------------------


def by_sympy(kind: str, n: int) -> float:
    from sympy import Add, cos, sin, symbols
    from sympy.physics.mechanics import LagrangesMethod, Lagrangian, Particle, Point, ReferenceFrame, dynamicsymbols

    def work() -> None:
        frame, origin = ReferenceFrame("N"), Point("O")
        origin.set_vel(frame, 0)
        q, masses, g = dynamicsymbols(f"q_1:{n + 1}"), symbols(f"m_1:{n + 1}"), symbols("g")
        if kind == "springs":
            places = [(x, 0) for x in q]
            ends = zip(symbols(f"k_1:{n + 2}"), (0, *q), (*q, 0), strict=True)
            energies = [Add(*(k * (v - u) ** 2 / 2 for k, u, v in ends)), *[0] * (n - 1)]
        else:
            lengths = symbols(f"l_1:{n + 1}")
            steps = [(a * sin(x), -a * cos(x)) for a, x in zip(lengths, q, strict=True)]
            places = [tuple(Add(*(step[k] for step in steps[: i + 1])) for k in (0, 1)) for i in range(n)]
            energies = [m * g * y for m, (_, y) in zip(masses, places, strict=True)]
        particles = []
        for i, (x, y) in enumerate(places):
            at = Point(f"P_{i}")
            at.set_pos(origin, x * frame.x + y * frame.y)
            at.set_vel(frame, at.pos_from(origin).dt(frame))
            particles.append(Particle(f"B_{i}", at, masses[i]))
            particles[-1].potential_energy = energies[i]
        LagrangesMethod(Lagrangian(frame, *particles), q).form_lagranges_equations()

    return seconds(work)


def by_maxima(kind: str, n: int) -> float:
    """Return the seconds that Maxima needs for the laws, with products of sines and cosines written as sums.

    The time is the mean of 20 repetitions, because the clock of Maxima has a resolution of 0.01 s.
    """
    times = 20
    energy = (
        "T: sum(m[i]*diff(x[i],t)^2/2, i, 1, n), U: k[1]*x[1]^2/2 + k[n+1]*x[n]^2/2"
        " + sum(k[i]*(x[i]-x[i-1])^2/2, i, 2, n)"
        if kind == "springs"
        else "T: sum(m[i]*(diff(sum(l[j]*sin(x[j]),j,1,i),t)^2 + diff(sum(l[j]*cos(x[j]),j,1,i),t)^2)/2, i, 1, n),"
        " U: -sum(m[i]*g*sum(l[j]*cos(x[j]),j,1,i), i, 1, n)"
    )
    program = (
        f"n: {n}$ x: makelist(concat(q, i), i, 1, n)$ for i:1 thru n do apply(depends, [x[i], t])$ "
        f"start: elapsed_run_time()$ for round:1 thru {times} do "
        f"({energy}, L: T - U, for i:1 thru n do "
        "left[i]: trigreduce(expand(diff(diff(L, diff(x[i],t)), t) - diff(L, x[i]))))$ "
        "if not freeof(diff(x[1],t,2), left[1]) then "
        f'printf(true, "seconds ~f~%", (elapsed_run_time() - start)/{times})$'
    )
    printed = subprocess.run(["maxima", "--very-quiet", f"--batch-string={program}"], capture_output=True, text=True)
    found = [line.split()[1] for line in printed.stdout.splitlines() if line.startswith("seconds")]
    return float(found[0]) if found else math.nan


WAYS: dict[str, Callable[[str, int], float]] = {"derive": derived, "laws": laws_alone, "sympy": by_sympy}


def timed_apart(way: str, kind: str, n: int) -> float:
    """Return the least time of several processes, each of which starts with empty caches."""
    command = [sys.executable, "-P", __file__, way, kind, str(n)]
    return min(float(subprocess.run(command, check=True, capture_output=True).stdout) for _ in range(ROUNDS))


def exponent(sizes: Sequence[int], times: list[float]) -> float:
    """Return the exponent b of time = a * size^b, from the middle and the largest of the sizes."""
    half = len(times) // 2
    return math.log(times[-1] / times[half]) / math.log(sizes[-1] / sizes[half])


def main() -> None:
    maxima = shutil.which("maxima") is not None
    for kind, sizes in (("pendulum", PENDULA), ("springs", SPRINGS)):
        taken = []
        for n in sizes:
            checked, laws, sympy = (timed_apart(way, kind, n) for way in WAYS)
            taken.append(checked)
            line = f"{kind:8} {n:2}   {checked:6.3f} s   {checked / sympy:5.2f} x LagrangesMethod   aim 1"
            line += f"     laws alone {laws / sympy:5.3f} x   aim 0.05"
            if maxima:
                line += f"     {laws / by_maxima(kind, n):5.1f} x Maxima   aim 3"
            print(line, flush=True)
        print(f"{kind:8}      grows as n^{exponent(sizes, taken):.1f}", flush=True)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(WAYS[sys.argv[1]](sys.argv[2], int(sys.argv[3])))
    else:
        main()
