"""What must be true for each word that chooses a sentence, by rule.

Verbs choose the word; here it is judged, by other means where there are any: the sign of a root by numbers, symmetry
of a body by its particles, the shape of a potential by its derivatives. `establish` refuses a word that is not true.
"""

from derive.mechanics.outcomes import of_answers, of_bodies, of_conditions, of_motion, of_rotation

__all__ = ["of_answers", "of_bodies", "of_conditions", "of_motion", "of_rotation"]
from derive.mechanics.outcomes import of_bodies, of_conditions, of_modes, of_motion, of_rotation
from derive.mechanics.outcomes import of_bodies, of_conditions, of_equilibria, of_modes, of_motion, of_rotation

__all__ = ["of_bodies", "of_conditions", "of_equilibria", "of_modes", "of_motion", "of_rotation"]
