"""The described system, simulated numerically: statements about the motion are tested on the motion itself.

The simulation does not use derived equations. A description has formulas for masses, positions, forces and constraints,
or a given Lagrangian. The equations of Newton and Euler, or Lagrange's equations for a given Lagrangian, contain a
multiplier for each constraint. These equations are solved numerically for the accelerations, and SciPy integrates the
accelerations.
"""
