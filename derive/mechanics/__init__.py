"""The verbs (laws) and nouns (bodies, systems) of mechanics that the script of a problem imports.

The `__all__` of each module lists its verbs and nouns.
"""

from inspect import isfunction

from derive.algebra.direction import Direction as Direction
from derive.mechanics.answers.approximate import *
from derive.mechanics.answers.combination import *
from derive.mechanics.answers.conditions import *
from derive.mechanics.answers.extrema import *
from derive.mechanics.answers.limits import *
from derive.mechanics.answers.linear_equations import *
from derive.mechanics.answers.quadratics import *
from derive.mechanics.answers.roots import *
from derive.mechanics.answers.slipping_in_state import *
from derive.mechanics.answers.substitution import *
from derive.mechanics.answers.values import *
from derive.mechanics.arguments import checked
from derive.mechanics.bodies.body import *
from derive.mechanics.bodies.components import *
from derive.mechanics.bodies.edged_bodies import *
from derive.mechanics.bodies.mapped_bodies import *
from derive.mechanics.bodies.solids import *
from derive.mechanics.bodies.thin_bodies import *
from derive.mechanics.hamilton.brackets import *
from derive.mechanics.hamilton.canonical import *
from derive.mechanics.hamilton.effective import *
from derive.mechanics.hamilton.phase_space import *
from derive.mechanics.impacts.impact import *
from derive.mechanics.impacts.impulses import *
from derive.mechanics.impacts.momentum_laws import *
from derive.mechanics.kinematics.coordinates import *
from derive.mechanics.kinematics.places import *
from derive.mechanics.lagrange.applied_forces import *
from derive.mechanics.lagrange.constraint_forces import *
from derive.mechanics.lagrange.energies import *
from derive.mechanics.lagrange.energy_function import *
from derive.mechanics.lagrange.given_lagrangian import *
from derive.mechanics.lagrange.kept_momentum import *
from derive.mechanics.lagrange.lagrangian import *
from derive.mechanics.lagrange.momenta import *
from derive.mechanics.lagrange.symmetry import *
from derive.mechanics.model.constraint import *
from derive.mechanics.model.contacts import *
from derive.mechanics.model.forces import *
from derive.mechanics.model.joints import *
from derive.mechanics.model.no_slip import *
from derive.mechanics.model.positions import *
from derive.mechanics.model.rigid import *
from derive.mechanics.model.strings import *
from derive.mechanics.model.surfaces import *
from derive.mechanics.model.system import *
from derive.mechanics.motion.conservation import *
from derive.mechanics.motion.energy_integral import *
from derive.mechanics.motion.flight import *
from derive.mechanics.motion.leaving import *
from derive.mechanics.motion.slipping import *
from derive.mechanics.motion.steady import *
from derive.mechanics.newton.agreement_of_laws import *
from derive.mechanics.newton.energy import *
from derive.mechanics.newton.second_law import *
from derive.mechanics.newton.torque_law import *
from derive.mechanics.rest.equilibria import *
from derive.mechanics.rest.potentials import *
from derive.mechanics.rest.stability import *
from derive.mechanics.rest.stable_where import *
from derive.mechanics.rotation.added_moments import *
from derive.mechanics.rotation.assembly import *
from derive.mechanics.rotation.cones import *
from derive.mechanics.rotation.euler_equations import *
from derive.mechanics.rotation.inertia import *
from derive.mechanics.rotation.isotropic import *
from derive.mechanics.rotation.perturbed_rotation import *
from derive.mechanics.rotation.principal import *
from derive.mechanics.rotation.steady import *
from derive.mechanics.rotation.steady_torque import *
from derive.mechanics.rotation.symbolic_body import *
from derive.mechanics.rotation.tensors import *
from derive.mechanics.rotation.vectors import *
from derive.mechanics.vibrations.about_steady_motion import *
from derive.mechanics.vibrations.driven import *
from derive.mechanics.vibrations.gyroscopic import *
from derive.mechanics.vibrations.linear_motion import *
from derive.mechanics.vibrations.linearised import *
from derive.mechanics.vibrations.modes import *
from derive.mechanics.vibrations.oscillations import *
from derive.mechanics.vibrations.superposition import *

for _name, _verb in list(globals().items()):
    if isfunction(_verb) and _verb is not checked:
        globals()[_name] = checked(_verb)
