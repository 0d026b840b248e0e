"""Random systems with contacts and strings: each as a description for the engine, and as Newton's and Euler's laws."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from math import cos, hypot, sin
from random import Random

from tests.newton_euler.laws import KNOWN, Body, Equation, Force, Vector, solved

Numbers = dict[str, float]
SHAPES = {"particle": 0.0, "disc": 0.5, "hoop": 1.0, "ball": 0.4, "spherical_shell": 2 / 3}


@dataclass(frozen=True)
class Trial:
    """A description, and a function that yields a random state and the accelerations and forces in this state."""

    name: str
    given: str
    unknowns: tuple[str, ...]
    state: Callable[[Random], tuple[Numbers, Numbers]]


def on_a_surface() -> Iterator[Trial]:
    """A particle or a round body on a plane, on a wedge that moves, or on a circle; smooth, rolling, sliding or held by
    static friction."""
    grounds = ("floor", "incline", "wedge", "outside", "inside")
    for shape, ground, friction in product(SHAPES, grounds, ("none", "rolling", "sliding", "static")):
        if (shape, friction) != ("particle", "rolling"):
            yield _OnSurface(shape, ground, friction).trial()


@dataclass(frozen=True)
class _OnSurface:
    shape: str
    ground: str
    friction: str

    @property
    def is_round(self) -> bool:
        return self.shape != "particle"

    @property
    def is_held(self) -> bool:
        return self.friction in ("rolling", "static")

    @property
    def is_circle(self) -> bool:
        return self.ground in ("outside", "inside")

    def trial(self) -> Trial:
        unknowns = ["x_ddot", "y_ddot", *(["phi_ddot"] if self.is_round else []), "N"]
        unknowns += ["X_ddot"] if self.ground == "wedge" else []
        unknowns += ["F"] if self.is_held else []
        name = f"{self.shape}-{self.ground}-{self.friction}"
        return Trial(name, self.given(), tuple(unknowns), self.state)

    def given(self) -> str:
        coordinates = ["x: length", "y: length", *(["phi: angle"] if self.is_round else [])]
        coordinates += ["X: length"] if self.ground == "wedge" else []
        surface = {
            "floor": "{through: [0, 0], along: [1, 0]}",
            "incline": "{through: [0, 0], normal: [2*sin(alpha), 2*cos(alpha)]}",
            "wedge": "{through: wedge, along: [cos(alpha), -sin(alpha)], of: wedge}",
            "outside": "{centre: [0, 0], radius: R}",
            "inside": "{centre: [0, 0], radius: R, side: inside}",
        }[self.ground]
        friction = {
            "none": "none",
            "rolling": "{rolling: F}",
            "static": "{static: mu, force: F}",
            "sliding": f"{{sliding: mu, direction: [{', '.join(self._slip())}]}}",
        }[self.friction]
        size = "radius: a, " if self.is_round else ""
        one = f"{{shape: {self.shape}, {size}mass: m, centre: [x, y], turned: phi{self._across()}}}"
        lines = [f"  coordinates: {{{', '.join(coordinates)}}}"]
        particles = ["wedge: {mass: M, at: [X, 0]}"] if self.ground == "wedge" else []
        if self.is_round:
            lines.append(f"  bodies: {{one: {one}}}")
        else:
            particles.append("one: {mass: m, at: [x, y]}")
        lines += [f"  particles: {{{', '.join(particles)}}}"] if particles else []
        lines += ["  gravity: g", f"  surfaces: {{ground: {surface}}}"]
        lines += [f"  contacts: {{of: one, on: ground, normal: N, friction: {friction}}}"]
        lines += [f"  forces: {{components: [P, 0], at: {'one' if self.is_round else '[x, y]'}}}"]
        return "\n".join(lines)

    def _across(self) -> str:
        return ", across: z" if self.shape in ("disc", "hoop") else ""

    def _slip(self) -> tuple[str, str]:
        if self.is_circle:
            return ("y", "-x") if self.ground == "outside" else ("-y", "x")
        return ("1", "0") if self.ground == "floor" else ("cos(alpha)", "-sin(alpha)")

    def state(self, random: Random) -> tuple[Numbers, Numbers]:
        v = {name: random.uniform(0.5, 2.0) for name in ("m", "M", "a", "g", "mu", "P")}
        v["alpha"], v["R"] = random.uniform(0.2, 1.2), random.uniform(5.0, 8.0)
        a = v["a"] if self.is_round else 0.0
        speed, spin = random.uniform(0.5, 3.0), random.uniform(-2.0, 2.0)
        speed = 0.0 if self.friction == "static" and not self.is_round else speed
        if self.is_circle:
            at = random.uniform(0.3, 1.2)
            distance = v["R"] + a if self.ground == "outside" else v["R"] - a
            outwards = (sin(at), cos(at)) if self.ground == "outside" else (sin(at), -cos(at))
            place = (distance * outwards[0], distance * outwards[1])
            n = outwards if self.ground == "outside" else (-outwards[0], -outwards[1])
            bent = -(speed**2) / distance if self.ground == "outside" else speed**2 / distance
        else:
            slope = 0.0 if self.ground == "floor" else v["alpha"]
            n, bent = (sin(slope), cos(slope)), 0.0
            along = random.uniform(-1.0, 1.0)
            v["X"] = random.uniform(-1.0, 1.0) if self.ground == "wedge" else 0.0
            place = (v["X"] + along * n[1] + a * n[0], -along * n[0] + a * n[1])
        t = (n[1], -n[0])
        v["x"], v["y"] = place
        moving = random.uniform(-1.0, 1.0) if self.ground == "wedge" else 0.0
        v["X_dot"], v["x_dot"], v["y_dot"] = moving, moving + speed * t[0], speed * t[1]
        v["phi"], v["phi_dot"] = spin, -speed / a if self.is_held and a else spin
        return v, solved(self._laws(v, n, t, bent, a))

    def _laws(self, v: Numbers, n: Vector, t: Vector, bent: float, a: float) -> list[Equation]:
        arm = (-a * n[0], -a * n[1])
        touch = [Force(n, arm, "N")]
        if self.is_held:
            touch.append(Force(t, arm, "F"))
        if self.friction == "sliding":
            touch.append(Force((-v["mu"] * t[0], -v["mu"] * t[1]), arm, "N"))
        moment = SHAPES[self.shape] * v["m"] * a**2
        one = Body(v["m"], "x_ddot", "y_ddot", moment, "phi_ddot" if self.is_round else "")
        found = one.equations([*touch, Force((0.0, -v["m"] * v["g"])), Force((v["P"], 0.0))])
        wedge = "X_ddot" if self.ground == "wedge" else ""
        if wedge:
            back = [Force((-f.direction[0], -f.direction[1]), unknown=f.unknown) for f in touch]
            found += Body(v["M"], wedge).equations(back)
        found.append({"x_ddot": n[0], "y_ddot": n[1], KNOWN: -bent, **({wedge: -n[0]} if wedge else {})})
        if self.is_held:
            turning = {"phi_ddot": a} if self.is_round else {}
            found.append({"x_ddot": t[0], "y_ddot": t[1], **turning, **({wedge: -t[0]} if wedge else {})})
        return found


CURVES: dict[str, tuple[str, Callable[[float, float], tuple[float, float, float]]]] = {
    "bowl": ("y: x**2/(2*R)", lambda x, R: (x**2 / (2 * R), x / R, 1 / R)),
    "hill": ("y: -x**3/R**2", lambda x, R: (-(x**3) / R**2, -3 * x**2 / R**2, -6 * x / R**2)),
    "arch": ("y: R*cos(x/R), side: below", lambda x, R: (R * cos(x / R), -sin(x / R), -cos(x / R) / R)),
    "track": ("y: x**2/(2*R), through: wedge, of: wedge", lambda x, R: (x**2 / (2 * R), x / R, 1 / R)),
}


def on_a_curve() -> Iterator[Trial]:
    """A particle on a curve y = f(x), which may be carried by another particle; smooth, sliding to the right, or held
    by static friction."""
    frictions = {
        "none": "none",
        "sliding": "{sliding: mu, direction: right}",
        "static": "{static: mu, force: F, direction: right}",
    }
    for name, (sort, friction) in product(CURVES, frictions.items()):
        is_carried = name == "track"
        wedge = ("X: length, ", "wedge: {mass: M, at: [X, 0]}, ") if is_carried else ("", "")
        given = (
            f"  coordinates: {{{wedge[0]}x: length, y: length}}\n"
            f"  particles: {{{wedge[1]}one: {{mass: m, at: [x, y]}}}}\n  gravity: g\n"
            f"  surfaces: {{ground: {{{CURVES[name][0]}}}}}\n"
            f"  contacts: {{of: one, on: ground, normal: N, friction: {friction}}}"
        )
        given += "\n  forces: {components: [P, 0], at: [X, 0]}" if is_carried else ""
        unknowns = ("x_ddot", "y_ddot", "N", *(["X_ddot"] if is_carried else []), *(["F"] if sort == "static" else []))
        yield Trial(f"{name}-{sort}", given, unknowns, _on_curve(name, sort))


def _on_curve(name: str, sort: str) -> Callable[[Random], tuple[Numbers, Numbers]]:
    def state(random: Random) -> tuple[Numbers, Numbers]:
        v = _letters(random) | {"X": random.uniform(-1, 1), "X_dot": random.uniform(-1, 1)}
        if name != "track":
            v |= {"X": 0.0, "X_dot": 0.0}
        u, speed = random.uniform(-0.4, 1.2), 0.0 if sort == "static" else random.uniform(0.5, 2.0)
        height, slope, bend = CURVES[name][1](u, v["R"])
        length = hypot(1, slope)
        t, up = (1 / length, slope / length), -1 if name == "arch" else 1
        n = (-up * slope / length, up / length)
        v |= {"x": v["X"] + u, "y": height, "x_dot": v["X_dot"] + speed, "y_dot": slope * speed}
        touch = [Force(n, unknown="N")]
        if sort == "sliding":
            touch.append(Force((-v["mu"] * t[0], -v["mu"] * t[1]), unknown="N"))
        if sort == "static":
            touch.append(Force(t, unknown="F"))
        laws = Body(v["m"], "x_ddot", "y_ddot").equations([*touch, _down(v["m"], v)])
        if sort == "static":
            laws.append({"x_ddot": t[0], "y_ddot": t[1], **({"X_ddot": -t[0]} if name == "track" else {})})
        relative = {"x_ddot": slope, "y_ddot": -1.0, KNOWN: bend * speed**2}
        if name == "track":
            back = [Force((-f.direction[0], -f.direction[1]), unknown=f.unknown) for f in touch]
            laws += Body(v["M"], "X_ddot").equations([*back, Force((v["P"], 0.0))])
            relative["X_ddot"] = -slope
        return v, solved([*laws, relative])

    return state


def with_strings() -> Iterator[Trial]:
    """Masses on strings over fixed and movable pulleys, and pendulums that hang from something that moves."""
    yield Trial("atwood", ATWOOD, ("x_ddot", "y_ddot", "T"), _atwood)
    yield Trial("movable pulley", MOVABLE, ("x_ddot", "y_ddot", "T"), _movable)
    for mu in ("", "mu"):
        given = OVER_THE_EDGE.replace(
            "FRICTION", f"{{sliding: {mu}, direction: [cos(alpha), sin(alpha)]}}" if mu else "none"
        )
        yield Trial(f"over an edge {mu}", given, ("x_ddot", "y_ddot", "z_ddot", "T", "N"), _over_an_edge(bool(mu)))
    yield Trial("oblique string", OBLIQUE, ("x_ddot", "z_ddot", "T"), _oblique)
    for noun in ("strings", "massless_rods"):
        given = HANGING.replace("NOUN", noun).replace("LETTER", "tension" if noun == "strings" else "force")
        yield Trial(f"hanging {noun}", given, ("X_ddot", "x_ddot", "y_ddot", "T"), _hanging)
    yield Trial("yo-yo", YO_YO, ("y_ddot", "phi_ddot", "T"), _yo_yo)
    yield Trial("massive pulley", MASSIVE, ("x_ddot", "y_ddot", "phi_ddot", "T", "S"), _massive)
    yield Trial("two wound discs", TWO_WOUND, ("y_ddot", "phi_ddot", "psi_ddot", "T"), _two_wound)
    yield Trial("pulled roller", PULLED, ("x_ddot", "y_ddot", "phi_ddot", "T", "F"), _pulled)
    yield Trial("pinned rods", RODS, ("theta_ddot", "phi_ddot", "x_ddot", "R_x", "R_y"), _rods)


YO_YO = """\
  coordinates: {y: positive length, phi: angle}
  bodies: {one: {shape: disc, radius: a, mass: m, turned: -phi, centre: [a, -y], across: z}}
  gravity: g
  strings: {from: [0, 0], wound_on: one, tension: T}"""
MASSIVE = """\
  coordinates: {x: positive length, y: positive length, phi: angle}
  particles: {one: {mass: m, at: [-a, -x]}, two: {mass: M, at: [a, -y]}}
  bodies: {pulley: {shape: hoop, radius: a, mass: m, turned: phi, centre: [0, 0], across: z}}
  gravity: g
  strings: [{from: one, wound_on: pulley, tension: T}, {from: two, wound_on: pulley, tension: S}]"""
TWO_WOUND = """\
  coordinates: {y: positive length, phi: angle, psi: angle}
  bodies:
    upper: {shape: hoop, radius: R, mass: M, turned: -phi, centre: [0, 0], across: z}
    lower: {shape: disc, radius: a, mass: m, turned: -psi, centre: [a + R, -y], across: z}
  gravity: g
  strings: {wound_on: [upper, lower], tension: T}"""
PULLED = """\
  coordinates: {x: length, y: positive length, phi: angle}
  bodies: {roller: {shape: disc, radius: a, mass: M, centre: [x, a], turned: -phi, across: z}}
  particles: {weight: {mass: m, at: [9*l, -y]}}
  gravity: g
  surfaces: {table: {through: [0, 0], along: [1, 0]}}
  contacts: {of: roller, on: table, friction: {rolling: F}}
  strings: {from: weight, over: [[9*l, 2*a]], wound_on: roller, tension: T}"""
RODS = """\
  coordinates: {theta: angle, phi: angle, x: length, y: length}
  bodies:
    upper: {shape: rod, length: l, mass: M, from: [0, 0], along: [sin(theta), -cos(theta)]}
    lower: {shape: rod, length: l, mass: m, centre: [x, y], along: [sin(phi), -cos(phi)]}
  gravity: g
  joints: {of: lower.end, to: upper.far_end, force: R}"""

ATWOOD = """\
  coordinates: {x: positive length, y: positive length}
  particles: {one: {mass: m, at: [0, -x]}, two: {mass: M, at: [a, -y]}}
  gravity: g
  strings: {from: one, over: [[0, 0], [a, 0]], to: two, length: l, tension: T}"""
MOVABLE = """\
  coordinates: {x: positive length, y: positive length}
  particles: {one: {mass: m, at: [0, -x]}, pulley: {mass: M, at: [a, -y]}}
  gravity: g
  strings: {from: one, over: [[0, 0], [a, 0], pulley], to: [a, 0], length: l, tension: T}"""
OVER_THE_EDGE = """\
  coordinates: {x: length, y: length, z: positive length}
  particles: {one: {mass: m, at: [x, y]}, two: {mass: M, at: [a, -z]}}
  gravity: g
  surfaces: {slope: {through: [0, 0], along: [cos(alpha), sin(alpha)]}}
  contacts: {of: one, on: slope, normal: N, friction: FRICTION}
  strings: {from: one, over: [[0, 0], [a, 0]], to: two, length: l, tension: T}"""
OBLIQUE = """\
  coordinates: {x: length, z: positive length}
  particles: {one: {mass: m, at: [x, 0]}, two: {mass: M, at: [0, R - z]}}
  gravity: g
  strings: {from: one, over: ['[0, R]'], to: two, length: l, tension: T}""".replace("'", "")
HANGING = """\
  coordinates: {X: length, x: length, y: length}
  particles: {cart: {mass: M, at: [X, 0]}, bob: {mass: m, at: [x, y]}}
  gravity: g
  NOUN: {from: cart, to: bob, length: l, LETTER: T}"""


def _letters(random: Random) -> Numbers:
    return {name: random.uniform(0.5, 2.0) for name in ("m", "M", "a", "g", "mu", "P", "l", "R", "alpha")}


def _down(mass: float, v: Numbers) -> Force:
    return Force((0.0, -mass * v["g"]))


def _atwood(random: Random) -> tuple[Numbers, Numbers]:
    v = _letters(random) | {"x_dot": 0.7, "y_dot": -0.7, "x": 1.0, "y": 1.0}
    laws = [
        *Body(v["m"], y="x_up").equations([_down(v["m"], v), Force((0, 1), unknown="T")]),
        *Body(v["M"], y="y_up").equations([_down(v["M"], v), Force((0, 1), unknown="T")]),
        {"x_up": 1, "x_ddot": 1},
        {"y_up": 1, "y_ddot": 1},
        {"x_ddot": 1, "y_ddot": 1},
    ]
    return v, solved(laws)


def _movable(random: Random) -> tuple[Numbers, Numbers]:
    v = _letters(random) | {"x_dot": 1.0, "y_dot": -0.5, "x": 1.0, "y": 1.0}
    laws = [
        *Body(v["m"], y="x_up").equations([_down(v["m"], v), Force((0, 1), unknown="T")]),
        *Body(v["M"], y="y_up").equations([_down(v["M"], v), Force((0, 2), unknown="T")]),
        {"x_up": 1, "x_ddot": 1},
        {"y_up": 1, "y_ddot": 1},
        {"x_ddot": 1, "y_ddot": 2},
    ]
    return v, solved(laws)


def _over_an_edge(rough: bool) -> Callable[[Random], tuple[Numbers, Numbers]]:
    """The block is below the edge, at a distance s down the slope; the string pulls it up along the slope."""

    def state(random: Random) -> tuple[Numbers, Numbers]:
        v = _letters(random)
        s, speed, alpha = random.uniform(1.0, 2.0), random.uniform(0.5, 1.5), v["alpha"] / 2
        v["alpha"] = alpha
        t, n = (cos(alpha), sin(alpha)), (-sin(alpha), cos(alpha))
        v |= {"x": -s * t[0], "y": -s * t[1], "z": 1.0}
        v |= {"x_dot": speed * t[0], "y_dot": speed * t[1], "z_dot": speed}
        forces = [_down(v["m"], v), Force(t, unknown="T"), Force(n, unknown="N")]
        if rough:
            forces.append(Force((-v["mu"] * t[0], -v["mu"] * t[1]), unknown="N"))
        laws = [
            *Body(v["m"], "x_ddot", "y_ddot").equations(forces),
            *Body(v["M"], y="z_up").equations([_down(v["M"], v), Force((0, 1), unknown="T")]),
            {"z_up": 1, "z_ddot": 1},
            {"x_ddot": n[0], "y_ddot": n[1]},
            {"x_ddot": t[0], "y_ddot": t[1], "z_ddot": -1},
        ]
        return v, solved(laws)

    return state


def _oblique(random: Random) -> tuple[Numbers, Numbers]:
    """A block on a smooth rail is pulled towards a pulley at the height R; the other mass hangs at the depth z."""
    v = _letters(random)
    x, speed = random.uniform(0.5, 2.0), random.uniform(0.5, 1.5)
    d = hypot(x, v["R"])
    towards = (-x / d, v["R"] / d)
    rate = x * speed / d  # of the distance d
    v |= {"x": x, "z": 1.0, "x_dot": speed, "z_dot": -rate}
    bent = (speed**2 - rate**2) / d  # d_ddot = (x/d) x_ddot + bent
    laws = [
        *Body(v["m"], x="x_ddot").equations([Force(towards, unknown="T")]),
        *Body(v["M"], y="z_up").equations([_down(v["M"], v), Force((0, 1), unknown="T")]),
        {"z_up": 1, "z_ddot": 1},
        {"x_ddot": x / d, "z_ddot": 1, KNOWN: bent},
    ]
    return v, solved(laws)


def _hanging(random: Random) -> tuple[Numbers, Numbers]:
    v = _letters(random)
    angle, turn, moving = random.uniform(0.2, 1.2), random.uniform(-2, 2), random.uniform(-1, 1)
    u = (sin(angle), -cos(angle))  # from the cart to the bob
    v |= {"X": 0.3, "x": 0.3 + v["l"] * u[0], "y": v["l"] * u[1], "X_dot": moving}
    v |= {"x_dot": moving + v["l"] * turn * cos(angle), "y_dot": v["l"] * turn * sin(angle)}
    laws = [
        *Body(v["M"], x="X_ddot").equations([Force(u, unknown="T")]),
        *Body(v["m"], "x_ddot", "y_ddot").equations([_down(v["m"], v), Force((-u[0], -u[1]), unknown="T")]),
        {"x_ddot": u[0], "y_ddot": u[1], "X_ddot": -u[0], KNOWN: v["l"] * turn**2},
    ]
    return v, solved(laws)


def _yo_yo(random: Random) -> tuple[Numbers, Numbers]:
    v = _letters(random) | {"y": 1.0, "y_dot": 0.3, "phi": 0.2, "phi_dot": 0.0}
    v["phi_dot"] = v["y_dot"] / v["a"]
    string = Force((0, 1), (-v["a"], 0), "T")
    laws = [
        *Body(v["m"], y="up", moment=v["m"] * v["a"] ** 2 / 2, turn="turn").equations([_down(v["m"], v), string]),
        {"up": 1, "y_ddot": 1},
        {"turn": 1, "phi_ddot": 1},
        {"y_ddot": 1, "phi_ddot": -v["a"]},
    ]
    return v, solved(laws)


def _massive(random: Random) -> tuple[Numbers, Numbers]:
    v = _letters(random) | {"x": 1.0, "y": 1.0, "phi": 0.2, "phi_dot": 0.4}
    a = v["a"]
    v |= {"x_dot": a * v["phi_dot"], "y_dot": -a * v["phi_dot"]}
    rim = [Force((0, -1), (-a, 0), "T"), Force((0, -1), (a, 0), "S")]
    laws = [
        *Body(v["m"], y="x_up").equations([_down(v["m"], v), Force((0, 1), unknown="T")]),
        *Body(v["M"], y="y_up").equations([_down(v["M"], v), Force((0, 1), unknown="S")]),
        *Body(v["m"], moment=v["m"] * a**2, turn="phi_ddot").equations(rim),
        {"x_up": 1, "x_ddot": 1},
        {"y_up": 1, "y_ddot": 1},
        {"x_ddot": 1, "phi_ddot": -a},
        {"y_ddot": 1, "phi_ddot": a},
    ]
    return v, solved(laws)


def _two_wound(random: Random) -> tuple[Numbers, Numbers]:
    v = _letters(random) | {"y": 1.0, "phi": 0.2, "psi": 0.1, "phi_dot": 0.4, "psi_dot": 0.3}
    a, b = v["a"], v["R"]
    v["y_dot"] = b * v["phi_dot"] + a * v["psi_dot"]
    laws = [
        *Body(v["M"], moment=v["M"] * b**2, turn="up_turn").equations([Force((0, -1), (b, 0), "T")]),
        *Body(v["m"], y="up", moment=v["m"] * a**2 / 2, turn="low_turn").equations(
            [_down(v["m"], v), Force((0, 1), (-a, 0), "T")]
        ),
        {"up": 1, "y_ddot": 1},
        {"up_turn": 1, "phi_ddot": 1},
        {"low_turn": 1, "psi_ddot": 1},
        {"y_ddot": 1, "phi_ddot": -b, "psi_ddot": -a},
    ]
    return v, solved(laws)


def _pulled(random: Random) -> tuple[Numbers, Numbers]:
    v = _letters(random) | {"x": 0.0, "y": 1.0, "phi": 0.2, "phi_dot": 0.4}
    a = v["a"]
    v |= {"x_dot": a * v["phi_dot"], "y_dot": 2 * a * v["phi_dot"]}
    on_roller = [Force((1, 0), (0, a), "T"), Force((1, 0), (0, -a), "F")]
    laws = [
        *Body(v["M"], x="x_ddot", moment=v["M"] * a**2 / 2, turn="turn").equations(on_roller),
        *Body(v["m"], y="up").equations([_down(v["m"], v), Force((0, 1), unknown="T")]),
        {"up": 1, "y_ddot": 1},
        {"turn": 1, "phi_ddot": 1},
        {"x_ddot": 1, "phi_ddot": -a},
        {"y_ddot": 1, "phi_ddot": -2 * a},
    ]
    return v, solved(laws)


def _rods(random: Random) -> tuple[Numbers, Numbers]:
    v = _letters(random)
    l, p, q = v["l"], random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2)
    dp, dq = random.uniform(-2, 2), random.uniform(-2, 2)
    u, w = (sin(p), -cos(p)), (sin(q), -cos(q))
    v |= {"theta": p, "phi": q, "theta_dot": dp, "phi_dot": dq}
    v |= {"x": l * u[0] + l / 2 * w[0], "y": l * u[1] + l / 2 * w[1]}
    v["x_dot"] = l * cos(p) * dp + l / 2 * cos(q) * dq
    v["y_dot"] = l * sin(p) * dp + l / 2 * sin(q) * dq
    half_u, half_w = (l / 2 * u[0], l / 2 * u[1]), (l / 2 * w[0], l / 2 * w[1])
    upper = [
        _down(v["M"], v),
        *(Force(way, (-half_u[0], -half_u[1]), f"O_{axis}") for way, axis in (((1, 0), "x"), ((0, 1), "y"))),
        *(Force(way, half_u, f"R_{axis}") for way, axis in (((-1, 0), "x"), ((0, -1), "y"))),
    ]
    lower = [
        _down(v["m"], v),
        *(Force(way, (-half_w[0], -half_w[1]), f"R_{axis}") for way, axis in (((1, 0), "x"), ((0, 1), "y"))),
    ]
    laws = [
        *Body(v["M"], "X", "Y", v["M"] * l**2 / 12, "theta_ddot").equations(upper),
        *Body(v["m"], "x_ddot", "y_ddot", v["m"] * l**2 / 12, "phi_ddot").equations(lower),
        {"X": 1, "theta_ddot": -l / 2 * cos(p), KNOWN: l / 2 * sin(p) * dp**2},
        {"Y": 1, "theta_ddot": -l / 2 * sin(p), KNOWN: -l / 2 * cos(p) * dp**2},
        {"x_ddot": 1, "theta_ddot": -l * cos(p), "phi_ddot": -l / 2 * cos(q),
         KNOWN: l * sin(p) * dp**2 + l / 2 * sin(q) * dq**2},
        {"y_ddot": 1, "theta_ddot": -l * sin(p), "phi_ddot": -l / 2 * sin(q),
         KNOWN: -l * cos(p) * dp**2 - l / 2 * cos(q) * dq**2},
    ]  # fmt: skip
    return v, solved(laws)


SYMBOLS = (
    "{m: mass, M: mass, a: length, R: length, l: length, g: acceleration, P: positive force, mu: positive number, "
    "alpha: 'angle in (0, pi/2)', Omega: angular speed}"
)


def key_of(unknown: str) -> str:
    return f"acceleration_{unknown.removesuffix('_ddot')}" if unknown.endswith("_ddot") else unknown


def problem(trial: Trial) -> str:
    answers = [
        f"acceleration_{name.removesuffix('_ddot')}" if name.endswith("_ddot") else name for name in trial.unknowns
    ]
    return (
        f"title: A trial\nsolve: system\nsymbols: {SYMBOLS}\ngiven:\n{trial.given}\nstatement: A trial.\n"
        f"parts:\n  - ask: Find the accelerations.\n    answer: [{', '.join(answers)}]\n"
    )
