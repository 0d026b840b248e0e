"""Whether a constraint force can enforce a condition: the gradient of the condition must not vanish where the condition
holds.

For example, the gradient of (x - y)^2 vanishes where x = y, so no multiple of this gradient is a constraint force.
"""

from __future__ import annotations

import numpy as np

from derive.witness.description import Description
from derive.witness.dynamics import Blueprint
from derive.witness.tape import NotComputable
from derive.witness.trial import Contradiction, Trial

TRIALS, STATES = 2, 3
NO_GRADIENT = 1e-4  # a smaller gradient counts as zero


def without_gradient(of: Description) -> list[int]:
    """The indices of the conditions whose gradients vanish in all tested states."""
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
