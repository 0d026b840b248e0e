"""Drawings that a script describes: `drawing("vectors", outline(block), arrow(omega, ...), ...)`."""

from derive.figures.bodies import *
from derive.figures.elements import *
from derive.figures.forces import *
from derive.figures.ghosts import *
from derive.figures.modes import *
from derive.figures.rigid_bodies import *
from derive.figures.scenes import *
from derive.figures.sketches import *
