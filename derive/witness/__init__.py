"""The described system, simulated numerically: statements about the motion are tested on the motion itself.

The simulation does not use derived equations. A description consists of formulas for masses, positions, forces and
constraints, or of a given Lagrangian. The positions are differentiated by complex steps. The equations of Newton and
Euler, with the multipliers of constraints, are linear in the accelerations and are solved numerically. SciPy
integrates the accelerations.
"""
