"""Steps that no problem of the library asks for, each for its words alone."""

from sympy import cos, sin

from derive import mechanics
from derive.algebra.expressions import Relation
from derive.given import Acceleration, Length, Mass
from derive.mechanics import coordinate, let, point


def equation(key, left):
    return let(key, lambda: Relation(left, "=", 0))


def solve(a: Length, b: Length, c: Length, m: Mass, g: Acceleration):
    theta, x = coordinate("theta"), coordinate("x", "length")
    r = coordinate("r", "length", positive=True)

    named = let("sum", lambda: a + b, symbol="s")
    because = let("twice", lambda: a - b, symbol="d", because="both are at rest")
    level = let("level", lambda: Relation(x.symbol, "=", a))
    same = let("same", lambda: Relation(x.symbol, "=", b), because="nothing pulls")

    double = mechanics.roots(equation("squared", (x.symbol - a) ** 2), x, keys=["double"])
    none = mechanics.roots(equation("never", x.symbol**2 + a**2), x, keys=["none"])
    beyond = mechanics.roots(equation("beyond", (r.symbol + a) * (r.symbol + b)), r)
    reached = mechanics.roots(equation("too_far", cos(theta.symbol) - 2), cos(theta.symbol))

    size = let("size", lambda: x.symbol**2 - a**2, symbol="w")
    apart = mechanics.where(size, ">", 0, x.symbol, key="apart")
    unit = let("unit", lambda: sin(theta.symbol) ** 2 + cos(theta.symbol) ** 2 - 1, symbol="z")
    equal = mechanics.where(unit, ">", 0, theta.symbol, key="equal")
    push = let("push", lambda: 3 * m * g, symbol="N", kind="force")
    never = mechanics.leaves_contact(push, cos(theta.symbol), 1, key="never_lost")

    energy = let("energy_there", lambda: m * g * (x.symbol**2 / a - 2 * x.symbol), symbol="E", kind="energy")
    least = mechanics.minimum(energy, x.symbol)

    places = mechanics.components(point(a * sin(theta.symbol), a * cos(theta.symbol)), names=("X", "Y"))
    flat = mechanics.principal_moments(mechanics.inertia_tensor(mechanics.Disc(a, m)))
    case = mechanics.isotropic_where(flat, a, key="case")
    return (named, because, level, same, *double, *none, *beyond, *reached, apart, equal, never, *least, *places, case)
