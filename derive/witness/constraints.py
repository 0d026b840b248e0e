"""Whether a constraint force can enforce a condition: the gradient does not vanish where the condition holds.

The gradient of (x - y)^2 vanishes where the condition holds, so no multiple of it gives a force there.
"""

from __future__ import annotations

import numpy as np

from derive.witness.description import Description
from derive.witness.dynamics import Blueprint
from derive.witness.tape import NotComputable
from derive.witness.trial import Contradiction, Trial

TRIALS, STATES = 2, 3
NO_GRADIENT = 1e-4  # symbols are of order one, and a position at a double zero is found to 1e-5


def without_gradient(of: Description) -> list[int]:
    """The numbers of the conditions whose gradient vanishes wherever all conditions hold."""
    vanishing: list[set[int]] = []
    try:
        blueprint = Blueprint(of)
        for number in range(TRIALS):
            trial = Trial(blueprint, number)
            for which in range(STATES):
                try:
                    _, gradients = trial.dynamics.gradients(trial.state((), which))
                except Contradiction:
                    continue
                sizes = np.linalg.norm(gradients, axis=1)
                vanishing.append({i for i, size in enumerate(sizes) if size < NO_GRADIENT})
    except NotComputable:
        return []
    return sorted(set.intersection(*vanishing)) if vanishing else []
