"""Measure the time of the derivation of problems, in processor seconds. Run by `make bench`.

    each problem         the seconds, aim 5, and their ratio to `import sympy` in the same run
    a chain of n rods    the exponent b of n^b, from 4 rods to 8; aim 2.7
    a body of n parts    the exponent b of n^b, from 8 parts to 16; aim 2.5

The problems are those of `bench/problems`, and the chains and bodies of this module. Each is derived in a separate
process, without the time of imports; the figure is the smaller time of two processes. One problem has neither a closed
form nor numbers, so derive refuses it, and its time is that until the refusal. `derive --root bench check timed` shows
how many steps each problem has.
"""

from __future__ import annotations

import math
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from bench.scale import seconds

FOLDER = Path(__file__).resolve().parent / "problems" / "timed"
SET = "timed"
ROUNDS, AIM = 2, 5
REFUSED = {"chain_in_letters"}  # its frequencies have no closed form, and it has no numbers
ORDINALS = (
    *("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth"),
    *("ninth", "tenth", "eleventh", "twelfth", "thirteenth", "fourteenth", "fifteenth", "sixteenth"),
)

# --- problems of any size --------------------------------------------------------------------------------------------


def chain_of_rods(n: int) -> str:
    """Return the description of n equal rods in a vertical plane, each hinged to the lower end of the rod above it."""
    across = [f"l*sin(theta_{k + 1})" for k in range(n)]
    down = [f"l*cos(theta_{k + 1})" for k in range(n)]
    hinges = [(" + ".join(across[:k]) or "0", " ".join(f"- {each}" for each in down[:k]) or "0") for k in range(n)]
    rods = [
        f"    {ORDINALS[k]} rod: {{shape: rod, length: l, mass: m, held: end, "
        f"on: ['{x}', '{y}'], turned: theta_{k + 1} + pi}}\n"
        for k, (x, y) in enumerate(hinges)
    ]
    return f"""\
title: A chain of {n} rods
solve: system

symbols: {{m: mass, l: length, g: acceleration}}
given:
  coordinates: {{{", ".join(f"theta_{k + 1}: angle" for k in range(n))}}}
  bodies:
{"".join(rods)}\
  gravity: g

statement: >
  {n} rods of mass <<m>> and length <<l>> hang one below another, joined by hinges, and swing in a vertical plane. The
  acceleration of free fall is <<g>>.

parts:
  - ask: Find the equations of motion.
    answer: equations_of_motion
"""


def body_of_parts(n: int) -> str:
    """Return the description of one body of n balls, cuboids, cylinders and rods, each with separate symbols."""
    shapes = (
        "shape: ball, radius: a_{0}",
        "shape: cuboid, sides: [a_{0}, 2*a_{0}, a_{0}]",
        "shape: cylinder, radius: a_{0}, height: a_{0}",
        "shape: rod, length: a_{0}",
    )
    parts = [
        f"      {ORDINALS[k]} part: {{{shapes[k % 4].format(k)}, mass: m_{k}, at: [0, a_{k}, {100 * k}*a_{k}]}}\n"
        for k in range(n)
    ]
    sizes = ", ".join(f"<<m_{k}>> and <<a_{k}>>" for k in range(n))
    return f"""\
title: A body of {n} parts
solve: body

symbols: {{{", ".join(f"m_{k}: mass, a_{k}: length" for k in range(n))}}}
given:
  body:
    parts:
{"".join(parts)}
statement: >
  A rigid body has {n} uniform parts. Their masses and lengths are {sizes}.

parts:
  - ask: Find the inertia tensor.
    answer: inertia_tensor
"""


# The function that describes the problem of each size, the two sizes that are compared, and the aim for the exponent.
GROWING: dict[str, tuple[Callable[[int], str], tuple[int, int], float]] = {
    "chain_of_rods": (chain_of_rods, (4, 8), 2.7),
    "body_of_parts": (body_of_parts, (8, 16), 2.5),
}


def timed_problems(root: Path) -> list[str]:
    """Copy the files of all timed problems into a course, and return their names."""
    folder = root / "problems" / SET
    shutil.copytree(FOLDER, folder)
    for name, (described, sizes, _) in GROWING.items():
        for n in sizes:
            (folder / f"{name}_{n}.yaml").write_text(described(n))
    return [file.stem for file in sorted(folder.glob("*.yaml")) if file.stem != "set"]


# --- times -----------------------------------------------------------------------------------------------------------


def derivation(root: Path, name: str) -> float:
    """Return the seconds in which this process derives or refuses a problem."""
    import scipy.integrate  # noqa: F401  the witness imports it and NumPy when it first integrates

    from derive.building.preload import preload

    preload(root, derives=True, draws=False)
    started = time.process_time()
    refused = is_refused(root, name)
    taken = time.process_time() - started
    if refused != (name in REFUSED):
        raise AssertionError(f"`{name}` was {'' if refused else 'not '}refused")
    return taken


def is_refused(root: Path, name: str) -> bool:
    """Derive a problem, and return whether it is refused because it has no closed form."""
    from derive.building.solution import derived
    from derive.course.problem import load_problem
    from derive.errors import Rejected

    try:
        derived(load_problem(root, f"{SET}/{name}"))
    except Rejected as error:
        if [each.code for each in error.complaints] != ["no-closed-form"]:
            raise
        return True
    return False


def derived_apart(root: Path, name: str) -> float:
    """Return the least time of several processes, each starting with empty caches."""
    command = [sys.executable, "-P", __file__, str(root), name]
    return min(float(subprocess.run(command, check=True, capture_output=True).stdout) for _ in range(ROUNDS))


def import_of_sympy() -> float:
    command = [sys.executable, "-P", "-c", "import sympy"]
    return min(seconds(lambda: subprocess.run(command, check=True)) for _ in range(2 * ROUNDS))


def growth(sizes: tuple[int, int], times: list[float]) -> float:
    """Return b of time = a size^b, through two sizes."""
    return math.log(times[1] / times[0]) / math.log(sizes[1] / sizes[0])


def main() -> None:
    sympy, times = import_of_sympy(), {}
    with tempfile.TemporaryDirectory() as folder:
        for name in timed_problems(Path(folder)):
            times[name] = taken = derived_apart(Path(folder), name)
            refused = "   (refused)" if name in REFUSED else ""
            print(f"{name:21}{taken:6.2f} s {taken / sympy:6.2f} x import sympy   aim {AIM} s{refused}", flush=True)
    for name, (_, sizes, aim) in GROWING.items():
        exponent = growth(sizes, [times[f"{name}_{n}"] for n in sizes])
        how = f"grows as n^{exponent:.1f} from {sizes[0]} to {sizes[1]}"
        print(f"{name:21}  {how:31} aim {aim}")
    print(f"(import sympy {sympy:.2f} s)")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(derivation(Path(sys.argv[1]), sys.argv[2]))
    else:
        main()
