"""A spinning top: at which rates it precesses steadily, and how fast it must spin to be stable when upright."""

from sympy import pi

from derive.figures import plot, sketch
from derive.given import *
from derive.mechanics import *


def solve(
    disc_mass: Mass,
    radius: Length,
    disc_at: Length,
    rod_mass: Mass,
    rod_length: Length,
    spin: AngularSpeed,
    tilt: PolarAngle,
    gravity: Acceleration,
):
    require(disc_at <= rod_length, "disc_at", "must not lie beyond the end of the rod")
    phi, theta, psi = euler_angles()
    disc, rod = Disc(radius, disc_mass).at(0, 0, disc_at), Rod(rod_length, rod_mass).at(0, 0, rod_length / 2)
    top = symbolic_body(Composite(disc, rod, points={"pivot": (0, 0, 0)}), about="pivot")  # M, l, I_x, I_z

    axes = space.turned(Z, phi).turned(X, theta).turned(Z, psi)
    spinning = System(top.held(axes, at="pivot"), weight(gravity))
    sketch("top", spinning, values={theta: tilt}, weights=True)

    L = lagrangian(spinning)
    S = conserved(L, psi, value=top.moments[2] * spin, key="constant_spin")  # psi is cyclic
    tilting = put_in(equation_of_motion(L, theta), S, key="tilt_equation")
    steady = steady_motion(tilting, key="steady_precession")

    here = let("tilt", lambda: tilt, symbol="theta", kind="angle")
    keys = ("slow_precession", "fast_precession")
    slow, fast = roots(steady, phi.rate, here, *top.values, together="precession_rates", keys=keys)
    condition = real_where(slow, spin, distinct=True, key="precession_condition")

    p_phi, p_psi = conserved(L, phi), conserved(L, psi)
    upright = put_in(p_phi, S, {theta: 0}, key="upright_momentum")  # phi is cyclic: p_phi = I_z S at every tilt
    V = put_in(effective_potential(L, p_phi, p_psi), upright, S, key="tilt_potential")
    letters = {each.symbol: each.value for each in top.values}
    well = V.value - V.value.subs(theta.symbol, 0)  # relative to the upright top, so that all spins fit in one panel
    weigh = top.mass * gravity * top.middle.position[2]
    plot(
        "well", V, theta.symbol, (-pi / 3, pi / 3), shown=well.subs(letters), above=0, per=(weigh, weigh.subs(letters))
    )
    sleeps = stable_where(stability(V, {theta: 0}, spin))
    sleeping = put_in(sleeps, *top.values, key="sleeping_spin")

    return slow, fast, condition, sleeps, sleeping
