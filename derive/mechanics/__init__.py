"""The verbs and nouns of mechanics, as a problem's script imports them.

Each module says in its `__all__` what it offers.
"""

from inspect import isfunction

import derive.mechanics.outcomes  # from here on it is known what each word of a step must fulfil
import derive.mechanics.outcomes.told
import derive.mechanics.outcomes.told_of_motion  # noqa: F401
from derive.algebra.direction import Direction as Direction
from derive.mechanics.arguments import checked
from derive.mechanics.bodies.body import *
from derive.mechanics.bodies.components import *
from derive.mechanics.bodies.edged_bodies import *
from derive.mechanics.bodies.general import *
from derive.mechanics.bodies.solids import *
from derive.mechanics.bodies.thin_bodies import *
from derive.mechanics.equations.approximate import *
from derive.mechanics.equations.combination import *
from derive.mechanics.equations.conditions import *
from derive.mechanics.equations.conservation import *
from derive.mechanics.equations.energy_integral import *
from derive.mechanics.equations.equilibria import *
from derive.mechanics.equations.euler_equations import *
from derive.mechanics.equations.extrema import *
from derive.mechanics.equations.forced import *
from derive.mechanics.equations.leaving import *
from derive.mechanics.equations.limits import *
from derive.mechanics.equations.linear_motion import *
from derive.mechanics.equations.linearised import *
from derive.mechanics.equations.minima import *
from derive.mechanics.equations.modes import *
from derive.mechanics.equations.oscillations import *
from derive.mechanics.equations.quadratics import *
from derive.mechanics.equations.roots import *
from derive.mechanics.equations.solving import *
from derive.mechanics.equations.special_cases import *
from derive.mechanics.equations.stability import *
from derive.mechanics.equations.stable_where import *
from derive.mechanics.equations.steady import *
from derive.mechanics.equations.substitution import *
from derive.mechanics.equations.superposition import *
from derive.mechanics.equations.turning_stability import *
from derive.mechanics.equations.unknowns import *
from derive.mechanics.equations.values import *
from derive.mechanics.equations.wobble import *
from derive.mechanics.rotation.added_moments import *
from derive.mechanics.rotation.assembly import *
from derive.mechanics.rotation.cones import *
from derive.mechanics.rotation.inertia import *
from derive.mechanics.rotation.principal import *
from derive.mechanics.rotation.steady import *
from derive.mechanics.rotation.steady_torque import *
from derive.mechanics.rotation.tensors import *
from derive.mechanics.rotation.vectors import *
from derive.mechanics.systems.blow import *
from derive.mechanics.systems.brackets import *
from derive.mechanics.systems.canonical import *
from derive.mechanics.systems.constraint import *
from derive.mechanics.systems.coordinates import *
from derive.mechanics.systems.effective import *
from derive.mechanics.systems.energies import *
from derive.mechanics.systems.energy import *
from derive.mechanics.systems.forced import *
from derive.mechanics.systems.forces import *
from derive.mechanics.systems.given_lagrangian import *
from derive.mechanics.systems.impulses import *
from derive.mechanics.systems.in_letters import *
from derive.mechanics.systems.kept_momentum import *
from derive.mechanics.systems.lagrangian import *
from derive.mechanics.systems.located import *
from derive.mechanics.systems.no_slip import *
from derive.mechanics.systems.phase_space import *
from derive.mechanics.systems.places import *
from derive.mechanics.systems.reactions import *
from derive.mechanics.systems.rigid import *
from derive.mechanics.systems.symmetry import *
from derive.mechanics.systems.system import *

for _name, _verb in list(globals().items()):
    if isfunction(_verb) and _verb is not checked:
        globals()[_name] = checked(_verb)
