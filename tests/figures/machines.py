"""Systems for the tests of drawings, and functions that return their drawn pieces."""

from __future__ import annotations

from typing import Any

from sympy import Expr, Symbol, cos, sin, tan

from derive.algebra.expressions import scalar
from derive.figures import sketch
from derive.figures.marks import Drawing, Mark
from derive.figures.pieces import Piece
from derive.mechanics import (
    Particle,
    System,
    Z,
    central,
    contact,
    coordinate,
    massless_rod,
    plane,
    point,
    space,
    spring,
    string,
    t,
    weight,
    wire,
)
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


def _rods(*pairs: tuple[Any, Any]) -> list[Any]:
    return [part for start, end in pairs for part in massless_rod(start, end)]


def _bead(place: Any) -> list[Any]:
    bead = Particle(m, place)
    return [bead, wire(bead), W]


def _systems() -> dict[str, System]:
    theta, phi = coordinate("theta"), coordinate("phi")
    x, y, s = (coordinate(name, "length") for name in "xys")
    r = coordinate("r", "length", positive=True)
    polar = point(r * cos(phi), r * sin(phi))
    top, stretched = hung(l1, theta), hung(r, theta)
    d = letter("d")
    one, two = point(a + x, 0), point(2 * a + y, 0)
    ends = ORIGIN, point(3 * a, 0)
    bob, upper, lower = Particle(m, hung(l, theta)), Particle(m1, top), Particle(m2, top + hung(l2, phi))
    cart, below = Particle(M, point(x, 0)), Particle(m, point(x, 0) + hung(l, theta))
    crank = point(a * cos(omega * t), a * sin(omega * t))
    turned = Particle(m, crank + hung(l, theta))
    shaken, moving = point(a * cos(omega * t), 0), Particle(m, point(a * cos(omega * t), 0) + hung(l, theta))
    in_space = Particle(m, point(l * sin(theta) * cos(phi), l * sin(theta) * sin(phi), -l * cos(theta)))
    on_table, hangs = Particle(m1, point(x - l, 0)), Particle(m2, point(0, -x))
    wedge, block = Particle(M, point(x, 0)), Particle(m, point(x + s * cos(alpha), h - s * sin(alpha)))
    sliding = Particle(m, point(s * cos(alpha), -s * sin(alpha)))
    face = plane(point(x, h), along=point(cos(alpha), -sin(alpha)), of=wedge)
    floor = plane(ORIGIN, along=point(1, 0))
    rail = plane(ORIGIN, along=point(1, 0), is_two_sided=True)
    return {
        "pendulum": System(bob, *_rods((ORIGIN, bob)), W),
        "double": System(upper, lower, *_rods((ORIGIN, upper), (upper, lower)), W),
        "elastic": System(Particle(m, stretched), spring(k, ORIGIN, stretched, l), W),
        "coupled": System(
            Particle(m, one),
            Particle(m, two),
            spring(k, ends[0], one, a),
            spring(k, one, two, a),
            spring(k, two, ends[1]),
        ),
        "table": System(on_table, hangs, *contact(on_table, floor), *string(on_table, hangs, over=[ORIGIN]), W),
        "incline": System(sliding, *contact(sliding, plane(ORIGIN, along=point(cos(alpha), -sin(alpha)))), W),
        "wedge": System(wedge, block, *contact(wedge, floor), *contact(block, face), W),
        "cart": System(cart, below, *contact(cart, rail), *_rods((cart, below)), W),
        "driven": System(moving, *_rods((shaken, moving)), W),
        "crank": System(turned, *_rods((crank, turned)), W),
        "hoop": System(*_bead(space.turned(Z, omega * t).place(R * sin(theta), 0, -R * cos(theta)))),
        "spherical": System(in_space, *_rods((point(0, 0, 0), in_space)), W),
        "bowl": System(Particle(m, point(r * cos(phi), r * sin(phi), r**2 / a)), W),
        "turning_rod": System(*_bead(point(r * cos(omega * t), r * sin(omega * t)))),
        "parabola": System(*_bead(point(x, x**2 / a))),
        "free": System(Particle(m, point(x, y)), W),
        "planet": System(Particle(m, polar), central(-G * M * m / d, d, ORIGIN, polar)),
        "hanging": System(Particle(m, point(0, -l - y)), spring(k, ORIGIN, point(0, -l - y), l), W),
        "bent": System(*_bead(point(a * tan(theta / 2) / 4, a * cos(theta) ** 2))),
    }


with recorded():
    SYSTEMS = _systems()
    SKETCHES = {name: sketch(name, system) for name, system in SYSTEMS.items()}
