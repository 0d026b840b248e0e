"""The described system, followed numerically: each statement about the motion is tested on the motion itself.

Nothing here uses a derived equation or the algebra behind such an equation. A description consists of formulas for
masses, positions, forces and constraints. The positions are differentiated by complex steps. The equations of Newton
and Euler, with the multipliers of constraints, are solved numerically as linear equations, and SciPy integrates the
accelerations.
"""
