"""Systems for the tests of drawings, and what is drawn of them with numbers."""

from __future__ import annotations

from typing import Any

from sympy import Expr, Symbol, cos, sin, tan

from derive.algebra.expressions import scalar
from derive.figures import sketch
from derive.figures.marks import Drawing, Mark
from derive.figures.pieces import Piece
from derive.mechanics import Particle, System, Z, central, coordinate, point, space, spring, t, weight
from derive.render.drawing.camera import Numbers, with_coordinates
from derive.render.drawing.picture import picture
from derive.steps.record import recorded


def letter(name: str) -> Symbol:
    return scalar(name, positive=True)


l, l1, l2, a, h, R, m, m1, m2, M, k, g, alpha, beta, omega, G = (
    letter(name)
    for name in ["l", "l_1", "l_2", "a", "h", "R", "m", "m_1", "m_2", "M", "k", "g", "alpha", "beta", "omega", "G"]
)
W = weight(g)
ORIGIN = point(0, 0)
UNITS = dict.fromkeys((l, l1, l2, a, h, R, omega), 1.0) | {alpha: 0.6, beta: 0.6}


def seen(found: Drawing, width: float = 5.0, height: float = 4.2, **numbers: float) -> list[Piece]:
    """The pieces of a drawing, lengths of one and the coordinates as it says, or as is said here."""
    said = {q: numbers[q.name] for q, _ in found.coordinates if q.name in numbers}
    chosen = {each for each, _ in found.values}
    known = {each: value for each, value in UNITS.items() if each not in chosen} | said
    return picture(found, Numbers(with_coordinates(found, known, 1.0)), width, height)


def of(found: Drawing, kind: type[Any]) -> list[Any]:
    return [mark for mark in found.marks if type(mark) is kind]


def at(column: Any) -> list[Expr]:
    return list(column)


def labels(found: Drawing, kind: type[Mark]) -> list[str]:
    return [str(mark.label) for mark in of(found, kind)]


def hung(length: Any, angle: Any) -> Any:
    return point(length * sin(angle), -length * cos(angle))


def _systems() -> dict[str, System]:
    theta, phi = coordinate("theta"), coordinate("phi")
    x, y, s = (coordinate(name, "length") for name in "xys")
    r = coordinate("r", "length", positive=True)
    polar = point(r * cos(phi), r * sin(phi))
    top, stretched = hung(l1, theta), hung(r, theta)
    d = letter("d")
    one, two = point(a + x, 0), point(2 * a + y, 0)
    ends = ORIGIN, point(3 * a, 0)
    return {
        "pendulum": System(Particle(m, hung(l, theta)), W),
        "double": System(Particle(m1, top), Particle(m2, top + hung(l2, phi)), W),
        "elastic": System(Particle(m, stretched), spring(k, ORIGIN, stretched, l), W),
        "coupled": System(
            Particle(m, one),
            Particle(m, two),
            spring(k, ends[0], one, a),
            spring(k, one, two, a),
            spring(k, two, ends[1]),
        ),
        "atwood": System(Particle(m1, point(-R, -x)), Particle(m2, point(R, x - l)), W),
        "one_line": System(Particle(m1, point(0, -x)), Particle(m2, point(0, x - l)), W),
        "table": System(Particle(m1, point(x - l, 0)), Particle(m2, point(0, -x)), W),
        "roof": System(
            Particle(m1, point(-x * cos(alpha), -x * sin(alpha))),
            Particle(m2, point((l - x) * cos(beta), -(l - x) * sin(beta))),
            W,
        ),
        "incline": System(Particle(m, point(s * cos(alpha), -s * sin(alpha))), W),
        "wedge": System(Particle(M, point(x, 0)), Particle(m, point(x + s * cos(alpha), h - s * sin(alpha))), W),
        "cart": System(Particle(M, point(x, 0)), Particle(m, point(x, 0) + hung(l, theta)), W),
        "driven": System(Particle(m, point(a * cos(omega * t), 0) + hung(l, theta)), W),
        "hoop": System(Particle(m, space.turned(Z, omega * t).place(R * sin(theta), 0, -R * cos(theta))), W),
        "spherical": System(
            Particle(m, point(l * sin(theta) * cos(phi), l * sin(theta) * sin(phi), -l * cos(theta))), W
        ),
        "bowl": System(Particle(m, point(r * cos(phi), r * sin(phi), r**2 / a)), W),
        "turning_rod": System(Particle(m, point(r * cos(omega * t), r * sin(omega * t)))),
        "parabola": System(Particle(m, point(x, x**2 / a)), W),
        "free": System(Particle(m, point(x, y)), W),
        "planet": System(Particle(m, polar), central(-G * M * m / d, d, ORIGIN, polar)),
        "hanging": System(Particle(m, point(0, -l - y)), spring(k, ORIGIN, point(0, -l - y), l), W),
        "bent": System(Particle(m, point(a * tan(theta / 2) / 4, a * cos(theta) ** 2)), W),
    }


with recorded():
    SYSTEMS = _systems()
    SKETCHES = {name: sketch(name, system) for name, system in SYSTEMS.items()}
