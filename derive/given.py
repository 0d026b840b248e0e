"""What a script says of its givens: kinds that annotate `solve()`, and `require` for what must hold between them."""

from __future__ import annotations

from derive.algebra.direction import Direction
from derive.algebra.kinds import (
    Acceleration,
    Angle,
    AngularSpeed,
    Density,
    Force,
    Frequency,
    Length,
    Lengths,
    LineDensity,
    Mass,
    MomentOfInertia,
    MomentsOfInertia,
    Number,
    PolarAngle,
    Speed,
    SpringConstant,
    SurfaceDensity,
    Time,
)
from derive.course.requirement import require

__all__ = [
    "Acceleration",
    "Angle",
    "AngularSpeed",
    "Density",
    "Direction",
    "Force",
    "Frequency",
    "Length",
    "Lengths",
    "LineDensity",
    "Mass",
    "MomentOfInertia",
    "MomentsOfInertia",
    "Number",
    "PolarAngle",
    "Speed",
    "SpringConstant",
    "SurfaceDensity",
    "Time",
    "require",
]
