"""What a script says of its givens: kinds that annotate `solve()`, and `require` for what must hold between them."""

from derive.algebra.direction import Direction as Direction
from derive.algebra.kinds import *  # each kind is a name of its own there
from derive.course.requirement import require as require
