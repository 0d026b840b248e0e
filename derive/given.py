"""What a script declares about the given quantities: the kinds that annotate `solve()`, and `require` for conditions
between these quantities."""

from derive.algebra.direction import Direction as Direction
from derive.algebra.kinds import *  # an annotation for each kind, such as `Mass`
from derive.course.requirement import require as require
