"""Round bodies that roll on planes in space: Newton's and Euler's laws for a rigid body with an unknown reaction."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import cos, sin, sqrt
from random import Random

from mpmath import lu_solve, matrix

from tests.newton_euler.laws import KNOWN, Equation, solved
from tests.newton_euler.random_systems import Numbers, Trial

Vector = tuple[float, float, float]
X, Y, Z = AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
# The moments about a diameter and about the axis; for the cylinder, of height 2 a, the diameter is at half the height.
MOMENTS = {"ball": (0.4, 0.4), "disc": (0.25, 0.5), "cylinder": (7 / 12, 0.5)}
REACTIONS = ("F_x", "F_y", "N")

GIVEN = """\
  coordinates: {x: length, y: length, z: length, phi: angle, theta: 'angle in (0, pi)', psi: angle}
  axes: {body: [{z: phi}, {x: theta}, {z: psi}], table: [{z: Omega*t}]}
  bodies: {one: {shape: SHAPE, radius: a, mass: m, centre: [x, y, z], turned: body}}
  gravity: g
  surfaces: {ground: GROUND}
  contacts: {of: one, on: ground, normal: N, friction: {rolling: F}}
  forces: {components: [P, 0, 0], at: one}"""
GROUNDS = {
    "floor": "{through: [0, 0, 0], normal: [0, 0, 1]}",
    "incline": "{through: [0, 0, 0], normal: [sin(alpha), 0, cos(alpha)]}",
    "turntable": "{through: [0, 0, 0], normal: [0, 0, 1], in: table}",
}


def in_space() -> Iterator[Trial]:
    pairs = (("ball", "floor"), ("ball", "incline"), ("ball", "turntable"), ("disc", "floor"), ("cylinder", "floor"))
    for shape, ground in pairs:
        given = GIVEN.replace("SHAPE", shape).replace("GROUND", GROUNDS[ground])
        if shape == "cylinder":  # it touches the floor with the rim of its lower end
            given = given.replace("(0, pi)", "(0, pi/2)").replace("cylinder,", "cylinder, height: 2*a,")
        if ground != "turntable":
            given = given.replace(", table: [{z: Omega*t}]", "")
        yield Trial(
            f"{shape}-{ground}-in space", given, ("x_ddot", "y_ddot", "z_ddot", *REACTIONS), _rolls(shape, ground)
        )


def _rolls(shape: str, ground: str) -> Callable[[Random], tuple[Numbers, Numbers]]:
    def state(random: Random) -> tuple[Numbers, Numbers]:
        v = {name: random.uniform(0.5, 2.0) for name in ("m", "a", "g", "P", "Omega")}
        v |= {"alpha": random.uniform(0.2, 1.2), "theta": random.uniform(0.3, 1.4 if shape == "cylinder" else 2.8)}
        v |= {name: random.uniform(-1.5, 1.5) for name in ("phi", "psi", "x", "y")}
        slope = v["alpha"] if ground == "incline" else 0.0
        n = (sin(slope), 0.0, cos(slope))
        down = (cos(slope), 0.0, -sin(slope))
        p, q, a = v["phi"], v["theta"], v["a"]
        axis = (sin(p) * sin(q), -cos(p) * sin(q), cos(q))
        spin = tuple(random.uniform(-2.0, 2.0) for _ in AXES)
        edge, edge_rate = (n, (0.0, 0.0, 0.0)) if shape == "ball" else _edge(n, axis, cross(spin, axis))
        if shape == "cylinder":
            edge, edge_rate = plus(edge, axis), plus(edge_rate, cross(spin, axis))
        arm, arm_rate = times(-a, edge), times(-a, edge_rate)
        away = -dot(arm, n)  # of the centre from the plane
        v["z"] = (away - v["x"] * n[0]) / n[2]
        turn = v["Omega"] if ground == "turntable" else 0.0
        foot = plus((v["x"], v["y"], v["z"]), arm)
        velocity = plus(times(-1, cross(spin, arm)), times(turn, cross(Z, foot)))
        v |= dict(zip(("x_dot", "y_dot", "z_dot"), velocity, strict=True))
        nodes = (cos(p), sin(p), 0.0)
        rates = lu_solve(matrix([[Z[i], nodes[i], axis[i]] for i in range(3)]), matrix(list(spin)))
        v |= {name: float(rate) for name, rate in zip(("phi_dot", "theta_dot", "psi_dot"), rates, strict=True)}
        of_ground = times(turn, cross(Z, plus(velocity, arm_rate)))
        bent = plus(cross(spin, arm_rate), times(-1, of_ground))
        return v, solved(_laws(v, MOMENTS[shape], axis, spin, arm, (down, Y, n), bent))

    return state


def _edge(n: Vector, axis: Vector, axis_rate: Vector) -> tuple[Vector, Vector]:
    """The unit vector along the component of n in the plane of a disc, and its rate."""
    w = plus(n, times(-dot(n, axis), axis))
    rate = plus(times(-dot(n, axis_rate), axis), times(-dot(n, axis), axis_rate))
    size = sqrt(dot(w, w))
    return times(1 / size, w), plus(times(1 / size, rate), times(-dot(w, rate) / size**3, w))


def _laws(
    v: Numbers, moments: Sequence[float], axis: Vector, spin: Vector, arm: Vector, ways: Sequence[Vector], bent: Vector
) -> Iterator[Equation]:
    """Newton's law, Euler's law about the centre, and the acceleration of the particle in contact, along each axis."""
    across, along = (share * v["m"] * v["a"] ** 2 for share in moments)

    def inertia(u: Vector) -> Vector:
        return plus(times(across, u), times((along - across) * dot(u, axis), axis))

    gyration = cross(spin, inertia(spin))
    weight_and_push = (v["P"], 0.0, -v["m"] * v["g"])
    for i, letter in enumerate("xyz"):
        reaction = {name: way[i] for name, way in zip(REACTIONS, ways, strict=True)}
        torque = {name: cross(arm, way)[i] for name, way in zip(REACTIONS, ways, strict=True)}
        turning = {f"turn_{k}": -inertia(AXES[k])[i] for k in range(3)}
        moving = {f"turn_{k}": cross(AXES[k], arm)[i] for k in range(3)}
        yield {f"{letter}_ddot": -v["m"], **reaction, KNOWN: weight_and_push[i]}
        yield {**turning, **torque, KNOWN: -gyration[i]}
        yield {f"{letter}_ddot": 1.0, **moving, KNOWN: bent[i]}


def dot(u: Sequence[float], w: Sequence[float]) -> float:
    return sum(a * b for a, b in zip(u, w, strict=True))


def plus(u: Sequence[float], w: Sequence[float]) -> Vector:
    return (u[0] + w[0], u[1] + w[1], u[2] + w[2])


def times(factor: float, u: Sequence[float]) -> Vector:
    return (factor * u[0], factor * u[1], factor * u[2])


def cross(u: Sequence[float], w: Sequence[float]) -> Vector:
    return (u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0])


SLIDING = """\
  coordinates: {x: length, y: length, z: lengthTURNS}
  axes: {AXES}
  PARTS
  gravity: g
  surfaces: {ground: GROUND}
  contacts: {of: one, on: ground, normal: N, friction: {sliding: mu}}
  forces: {components: [P, 0, 0], at: WHERE}"""


def sliding_in_space() -> Iterator[Trial]:
    """A particle or a ball that slides in any direction: on a floor, on a turntable, on a disc that may turn freely."""
    for shape in ("particle", "ball"):
        for ground in ("floor", "turntable", "free disc"):
            axes = {"floor": [], "turntable": ["table: [{z: Omega*t}]"], "free disc": ["table: [{z: chi}]"]}[ground]
            axes = [*axes, *(["body: [{z: phi}, {x: theta}, {z: psi}]"] if shape == "ball" else [])]
            bodies = ["one: {shape: ball, radius: a, mass: m, centre: [x, y, z], turned: body}"] * (shape == "ball")
            if ground == "free disc":
                bodies.append("disc: {shape: disc, radius: R, mass: M, centre: [0, 0, 0], turned: table}")
            parts = [f"bodies: {{{', '.join(bodies)}}}"] if bodies else []
            parts += ["particles: {one: {mass: m, at: [x, y, z]}}"] if shape == "particle" else []
            turns = [", phi: angle, theta: 'angle in (0, pi)', psi: angle"] * (shape == "ball")
            turns += [", chi: angle"] * (ground == "free disc")
            carried = {"floor": "", "turntable": ", in: table", "free disc": ", of: disc"}[ground]
            given = (
                SLIDING.replace("TURNS", "".join(turns))
                .replace("  axes: {AXES}\n", f"  axes: {{{', '.join(axes)}}}\n" if axes else "")
                .replace("PARTS", "\n  ".join(parts))
                .replace("GROUND", f"{{through: [0, 0, 0], normal: [0, 0, 1]{carried}}}")
                .replace("WHERE", "one" if shape == "ball" else "[x, y, z]")
            )
            unknowns = ("x_ddot", "y_ddot", "N", *(["chi_ddot"] if ground == "free disc" else []))
            yield Trial(f"{shape}-{ground}-sliding in space", given, unknowns, _slides(shape, ground))


def _slides(shape: str, ground: str) -> Callable[[Random], tuple[Numbers, Numbers]]:
    def state(random: Random) -> tuple[Numbers, Numbers]:
        v = {name: random.uniform(0.5, 2.0) for name in ("m", "M", "R", "a", "g", "P", "Omega", "mu")}
        v |= {name: random.uniform(-1.5, 1.5) for name in ("x", "y", "phi", "psi", "chi", "x_dot", "y_dot", "chi_dot")}
        v |= {name: random.uniform(-1.5, 1.5) for name in ("phi_dot", "theta_dot", "psi_dot")}
        v |= {"theta": random.uniform(0.3, 2.8), "z_dot": 0.0}
        a = v["a"] if shape == "ball" else 0.0
        v["z"] = a
        p, q = v["phi"], v["theta"]
        spin = plus(times(v["phi_dot"], Z), times(v["theta_dot"], (cos(p), sin(p), 0.0)))
        spin = plus(spin, times(v["psi_dot"], (sin(p) * sin(q), -cos(p) * sin(q), cos(q))))
        arm, foot = times(-a, Z), (v["x"], v["y"], 0.0)
        turn = {"floor": 0.0, "turntable": v["Omega"], "free disc": v["chi_dot"]}[ground]
        slip = plus((v["x_dot"], v["y_dot"], 0.0), plus(cross(spin, arm), times(-turn, cross(Z, foot))))
        rubbing = times(-v["mu"] / sqrt(dot(slip, slip)), slip)  # per normal force
        laws: list[Equation] = [
            {"x_ddot": -v["m"], "N": rubbing[0], KNOWN: v["P"]},
            {"y_ddot": -v["m"], "N": rubbing[1]},
            {"N": 1.0, KNOWN: -v["m"] * v["g"]},
        ]
        if ground == "free disc":
            laws.append({"chi_ddot": -v["M"] * v["R"] ** 2 / 2, "N": -cross(foot, rubbing)[2]})
        return v, solved(laws)

    return state
