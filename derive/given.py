"""What a script declares about its givens: kinds that annotate `solve()`, and `require` for conditions between them."""

from derive.algebra.direction import Direction as Direction
from derive.algebra.kinds import *  # each kind is a name of its own there
from derive.course.requirement import require as require
