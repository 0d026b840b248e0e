"""The names with which a script declares its given quantities: the kinds that annotate the parameters of `solve()`, and
`require` for conditions between these quantities."""

from derive.algebra.direction import Direction as Direction
from derive.algebra.kinds import *  # annotations for the usual kinds, such as `Mass`
from derive.course.requirement import require as require
