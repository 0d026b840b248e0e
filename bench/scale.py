"""Measure how the work grows with the size of the problem, in processor seconds. Run by `make bench`.

    a set of N problems      Copies of short problems of the library. The time of a build from nothing, with a
                             substitute for TeX, is divided by that of N sets of one problem (aim below 1). The times
                             of a build with nothing changed and of a build with one title changed are divided by
                             that of the build from nothing; they should grow at most in proportion to N.
    a body of N parts        The time of its centre of mass and its inertia tensor, with every step and check, divided
                             by that of the same sum multiplied out by SymPy. For equal rods on a line the time grows
                             as N^1, and also for rods with separate masses and positions if the tensor is about the
                             origin. About their centre of mass, the answer has N^2 terms.
    an identity in n angles  (sum l_i cos a_i)^2 + (sum l_i sin a_i)^2 in sums of angles, n^2 terms, and cos(a_1 + ... +
                             a_n) in products, 2^(n - 1) terms. derive decides that the two sides are equal, and that
                             they are unequal if one sign is changed. Both times are divided by that of SymPy's
                             `expand(trig=True)`, which decides only the second identity (aim below 1).

The growth is given as the exponent b of n^b, from the upper half of the sizes.
"""

from __future__ import annotations

import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from bench.systems import exponent

ROOT = Path(__file__).resolve().parent.parent
SETS, PARTS, ANGLES = (12, 25, 50), (10, 18, 32, 56, 100), range(2, 9)
PARTS_ABOUT_CENTRE = (3, 4, 6, 8, 10)
TEX = "#!/bin/sh\nfor source; do :; done\n{ echo '%PDF-1.5'; echo startxref; echo '%%EOF'; } > \"${source%.tex}.pdf\"\n"


def seconds(work: Callable[[], object]) -> float:
    """Return the processor seconds of `work`, including processes that it waits for."""

    def used() -> float:
        children = resource.getrusage(resource.RUSAGE_CHILDREN)
        return time.process_time() + children.ru_utime + children.ru_stime

    started = used()
    work()
    return used() - started


def told(what: str, sizes: Sequence[int], times: list[float], least: list[float], than: str) -> None:
    for n, taken, fewest in zip(sizes, times, least, strict=True):
        print(f"{what:34} {n:4}  {taken:7.3f} s   {taken / fewest:6.2f} x {than}")
    print(f"{what:34}       grows as n^{exponent(sizes, times):.1f}", flush=True)


# --- sets ------------------------------------------------------------------------------------------------------------


def course(folder: Path, size: int) -> Path:
    """Make a course with one set of copied problems and a substitute for TeX."""
    problems = folder / "problems" / "many"
    problems.mkdir(parents=True)
    (folder / "templates").symlink_to(ROOT / "templates")
    files = sorted(
        (file for file in (ROOT / "problems" / "library").rglob("*.yaml") if "<<problem" not in file.read_text()),
        key=lambda file: (len(file.read_text()), file.name),
    )[2:12]
    for number in range(size):
        shutil.copy(files[number % len(files)], problems / f"p{number:03}.yaml")
    names = "".join(f"  - p{number:03}\n" for number in range(size))
    (problems / "set.yaml").write_text(f"course: Mechanics\ntitle: Many\nproblems:\n{names}")
    (folder / "bin").mkdir()
    (folder / "bin" / "pdflatex").write_text(TEX)
    (folder / "bin" / "pdflatex").chmod(0o755)
    return folder


def of_sets() -> None:
    def build(at: Path) -> float:
        paths = {"PATH": f"{at / 'bin'}:{os.environ['PATH']}", "PYTHONPATH": str(ROOT), "XDG_STATE_HOME": str(at)}
        command = [sys.executable, "-P", "-m", "derive", "build", "many"]
        environment = {**os.environ, **paths, "DERIVE_ENGINE": "pdflatex"}
        return seconds(lambda: subprocess.run(command, cwd=at, env=environment, check=True, capture_output=True))

    fresh, again, edited = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        alone = sum(build(course(Path(folder) / f"one-{number}", 1)) for number in range(2)) / 2
        for size in SETS:
            at = course(Path(folder) / str(size), size)
            fresh.append(build(at))
            again.append(build(at))
            file = at / "problems" / "many" / "p000.yaml"
            file.write_text(re.sub(r"^title: .*$", "title: Once more", file.read_text(), count=1, flags=re.MULTILINE))
            edited.append(build(at))
    told("a set of problems", SETS, fresh, [size * alone for size in SETS], "as many sets of one")
    told("   with nothing changed", SETS, again, fresh, "the build from nothing")
    told("   with one problem retitled", SETS, edited, fresh, "the build from nothing")


# --- bodies ----------------------------------------------------------------------------------------------------------


def called(number: int) -> str:
    """Return a different word for each number."""
    return "".join(chr(ord("a") + number // 26**k % 26) for k in range(3))


def of_bodies(what: str, sizes: Sequence[int], alike: bool, about: str) -> None:
    from sympy import Matrix, expand, eye, symbols, zeros

    from derive.mechanics import Composite, Rod, centre_of_mass, inertia_tensor
    from derive.steps.record import recorded

    a, m = symbols("a m", positive=True)
    times, least = [], []
    for size in sizes:
        masses = [m] * size if alike else symbols(f"m_1:{size + 1}", positive=True)
        places = [k * a for k in range(size)] if alike else symbols(f"l_1:{size + 1}", positive=True)
        rods = [
            Rod(a, mass).named(called(k)).at(x, 0, 0) for k, (mass, x) in enumerate(zip(masses, places, strict=True))
        ]

        def derived(rods: Any = rods) -> None:
            with recorded():
                whole = Composite(*rods)
                centre_of_mass(whole)
                inertia_tensor(whole, about)

        def summed(masses: Any = masses, places: Any = places) -> None:
            whole = sum(masses)
            middle = sum(mass * x for mass, x in zip(masses, places, strict=True)) / whole
            total = zeros(3, 3)
            for mass, x in zip(masses, places, strict=True):
                d = Matrix([x - (middle if about == "centre" else 0), 0, 0])
                total += mass * (d.dot(d) * eye(3) - d * d.T)
            total.applyfunc(expand)

        times.append(seconds(derived))
        least.append(seconds(summed))
    told(what, sizes, times, least, "the sum in SymPy")


# --- identities ------------------------------------------------------------------------------------------------------


def speed(n: int) -> tuple[Any, list[Any]]:
    """Return the square of a sum of vectors, and the terms of the other side."""
    from sympy import Add, cos, sin, symbols

    lengths, angles = symbols(f"l_1:{n + 1}", positive=True), symbols(f"a_1:{n + 1}", real=True)
    pairs = list(zip(lengths, angles, strict=True))
    left = Add(*(s * cos(x) for s, x in pairs)) ** 2 + Add(*(s * sin(x) for s, x in pairs)) ** 2
    squares = [s**2 for s in lengths]
    return left, [*squares, *(2 * s * r * cos(x - y) for i, (s, x) in enumerate(pairs) for r, y in pairs[:i])]


def cosine(n: int) -> tuple[Any, list[Any]]:
    from sympy import Add, Integer, cos, sin, symbols

    real, imaginary = [Integer(1)], []
    angles = symbols(f"a_1:{n + 1}", real=True)
    for x in angles:
        real, imaginary = (
            [*(term * cos(x) for term in real), *(-term * sin(x) for term in imaginary)],
            [*(term * cos(x) for term in imaginary), *(term * sin(x) for term in real)],
        )
    return cos(Add(*angles)), real


def of_identities() -> None:
    from sympy import Add, Integer, Symbol, cos, expand, sin

    from derive.algebra.equality import equal

    def decided(n: int, left: Any, terms: list[Any], sign: int) -> float:
        right = Add(*terms[:-1], sign * terms[-1])
        found: list[bool] = []
        taken = seconds(lambda: found.append(bool(equal(left, right))))
        if found != [sign > 0]:
            raise AssertionError(f"an identity in {n} angles was decided wrong")
        return taken

    x = Symbol("x", real=True)
    equal(cos(x) ** 2 + sin(x) ** 2, Integer(1))  # this imports modules, so their loading is not counted below
    for what, sides in (("square of a sum of n vectors", speed), ("cosine of a sum of n angles", cosine)):
        same, slip, least = [], [], []
        for n in ANGLES:
            left, terms = sides(n)
            least.append(seconds(lambda left=left, terms=terms: expand(left - Add(*terms), trig=True)))  # type: ignore[misc]
            same.append(decided(n, left, terms, 1))
            slip.append(decided(n, left, terms, -1))
        told(what, ANGLES, same, least, "expand(trig=True)")
        told("   with one wrong sign", ANGLES, slip, least, "expand(trig=True)")


def main() -> None:
    of_identities()
    of_bodies("rods of one mass, about the centre", PARTS, True, "centre")
    of_bodies("rods in letters, about the origin", PARTS, False, "origin")
    of_bodies("rods in letters, about the centre", PARTS_ABOUT_CENTRE, False, "centre")
    of_sets()


if __name__ == "__main__":
    main()
