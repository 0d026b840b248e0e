"""Whether some part of the described system moves in the same way as a given position.

Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 4.9 (velocities in a rigid body).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from derive.witness.description import Description, Force, Vector
from derive.witness.dynamics import Blueprint
from derive.witness.geometry import Placed, Reals
from derive.witness.tape import NotComputable
from derive.witness.trial import Trial

TRIALS, STATES = 2, 2
SAME = 1e-8


def moving_alone(of: Description, places: Sequence[Vector]) -> list[int]:
    """The indices of the positions that do not move like any part of the system.

    The parts are the particles, the bodies, massless rods that end at a particle, and the ground.
    """
    zero = tuple(0 * c for c in places[0]) if places else ()
    asked = replace(of, forces=tuple(Force(zero, place) for place in places), drags=(), charges=(), conditions=())
    fitting: list[set[str] | None] = [None] * len(places)
    try:
        blueprint = Blueprint(asked)
        for number in range(TRIALS):
            trial = Trial(blueprint, number)
            for which in range(STATES):
                at = trial.dynamics.placed(trial.drawn_state(which))
                for i, place in enumerate(at.forces):
                    found = _moves_like(at, place.at, place.jacobian)
                    before = fitting[i]
                    fitting[i] = found if before is None else before & found
    except NotComputable:
        return []
    return [i for i, names in enumerate(fitting) if names is not None and not names]


def _moves_like(at: Placed, place: Reals, jacobian: Reals) -> set[str]:
    """The names of all parts that move like the position in this state."""
    found = {"ground"} if np.max(np.abs(jacobian), initial=0.0) < SAME else set()
    for i, particle in enumerate(at.particles):
        apart = jacobian - particle.jacobian
        if np.max(np.abs(apart), initial=0.0) < SAME:
            found.add(f"particle {i}")
        if np.max(np.abs((place - particle.at) @ apart), initial=0.0) < SAME:
            found.add(f"rod to particle {i}")
    for i, body in enumerate(at.bodies):
        if np.max(np.abs(jacobian - body.jacobian_at(place)), initial=0.0) < SAME:
            found.add(f"body {i}")
    return found
