"""Quadratic equations and potentials of all sorts, each for its words alone."""

from sympy import Rational

from derive import mechanics
from derive.algebra.expressions import Relation
from derive.given import Acceleration, Length, Mass
from derive.mechanics import Particle, System, coordinate, let, point, weight


def quadratic(name, p, q, s, g):
    """Both roots of p v^2 + q v + s = 0 of a velocity, and each by itself."""
    x = coordinate(name, "length")
    of = let(f"{name}_equation", lambda: Relation(p * x.rate**2 + q * x.rate + s, "=", 0))
    return mechanics.roots(of, x.rate, together=f"{name}_both", keys=[f"{name}_1", f"{name}_2"])


def near(name, height, m, g, **border):
    """The potential energy of a bead on a wire of this height, near x = 0."""
    x = coordinate("x", "length")
    of = mechanics.potential_energy_of(System(Particle(m, point(x.symbol, height(x.symbol))), weight(g)), name, name)
    return mechanics.leading_order(of, key=f"{name}_near", **border)


def solve(a: Length, b: Length, c: Length, m: Mass, g: Acceleration):
    real = quadratic("r", Rational(1), -3 * (g * a) ** Rational(1, 2), g * a, g)
    maybe = quadratic("w", Rational(1), -((g * b) ** Rational(1, 2)), g * a, g)
    opposite = quadratic("o", Rational(1), (g * b) ** Rational(1, 2), -g * a, g)
    double = quadratic("d", Rational(1), -2 * (g * a) ** Rational(1, 2), g * a, g)
    none = quadratic("n", Rational(1), (g * a) ** Rational(1, 2), g * a, g)
    cubic = near("U_3", lambda x: x**3 / b**2, m, g)
    open_ = near("U_2", lambda x: (1 / a - 1 / b) * x**2, m, g)
    tenth = near("U_9", lambda x: x**10 / b**9, m, g)
    stable = near("U_4", lambda x: (1 / a - 1 / b) * x**2 + x**4 / c**3, m, g, where=Relation(b, "=", a))
    falls = near("U_5", lambda x: (1 / a - 1 / b) * x**2 + x**3 / c**2, m, g, where=Relation(b, "=", a))
    flat = near("U_6", lambda x: (1 / a - 1 / b) * x**2, m, g, where=Relation(b, "=", a))
    return *real, *maybe, *opposite, double[0], none[0], cubic, open_, tenth, stable, falls, flat
