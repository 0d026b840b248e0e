"""What must be true for each word that chooses a sentence, by rule.

Verbs choose the word; here it is judged, by other means where there are any: the sign of a root by numbers, symmetry
of a body by its particles, the shape of a potential by its derivatives. `establish` refuses a word that is not true.
"""

from derive.mechanics.outcomes import of_answers as of_answers
from derive.mechanics.outcomes import of_approximations as of_approximations
from derive.mechanics.outcomes import of_bodies as of_bodies
from derive.mechanics.outcomes import of_conditions as of_conditions
from derive.mechanics.outcomes import of_contact as of_contact
from derive.mechanics.outcomes import of_equilibria as of_equilibria
from derive.mechanics.outcomes import of_facts as of_facts
from derive.mechanics.outcomes import of_gyroscopic as of_gyroscopic
from derive.mechanics.outcomes import of_impulses as of_impulses
from derive.mechanics.outcomes import of_lagrangians as of_lagrangians
from derive.mechanics.outcomes import of_modes as of_modes
from derive.mechanics.outcomes import of_motion as of_motion
from derive.mechanics.outcomes import of_named_axes as of_named_axes
from derive.mechanics.outcomes import of_names as of_names
from derive.mechanics.outcomes import of_rotation as of_rotation
from derive.mechanics.outcomes import of_shapes as of_shapes
from derive.mechanics.outcomes import of_steady as of_steady
from derive.mechanics.outcomes import of_systems as of_systems
from derive.mechanics.outcomes import of_wobble as of_wobble
