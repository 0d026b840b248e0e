"""The described system, followed numerically: each statement about the motion is tested on the motion itself.

Nothing here uses a derived equation or the algebra behind one. A description says what is there: masses, places, forces
and constraints, as formulas. Places are differentiated by complex steps, the equations of Newton and Euler with the
multipliers of constraints are solved as linear equations in numbers, and SciPy integrates them.
"""
