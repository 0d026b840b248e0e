"""The kinds of what a problem gives: the annotations of `solve()`, of which a type checker sees SymPy's `Expr`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, TypeAlias, get_args

from sympy import Expr, Integer, pi

from derive.algebra.dimensions import kind_with_article
from derive.algebra.direction import Direction

# Letters of these kinds stand for positive numbers; every other letter is only real.
POSITIVE = {
    "mass",
    "length",
    "time",
    "area",
    "volume",
    "density",
    "surface density",
    "line density",
    "speed",
    "acceleration",
    "angular speed",
    "frequency",
    "spring constant",
    "moment of inertia",
}
# A minus sign on these is a direction (a block turning the other way); on the other positive ones it is a mistake.
SIGNED = {"speed", "acceleration", "angular speed"}


def plural(kind: str) -> str:
    """Moments of inertia, angular speeds."""
    noun, of, rest = kind.partition(" of ")
    return f"{noun}s{of}{rest}"


@dataclass(frozen=True)
class Kind:
    """What a parameter of `solve()` may be: `name` in the script, `each` in `symbols:`, letters for numbers.

    bounds   the least and the greatest angle that it may be
    """

    name: str
    each: str
    letters: tuple[str, ...] = ()
    count: int = 1
    bounds: tuple[Expr, Expr] | None = None

    @property
    def wanted(self) -> str:
        return kind_with_article(self.each) if self.count == 1 else f"{self.count} {plural(self.each)}"


Mass: TypeAlias = Annotated[Expr, Kind("Mass", "mass", ("M", "m"))]
Length: TypeAlias = Annotated[Expr, Kind("Length", "length", ("l", "a", "b", "c", "d"))]
Lengths: TypeAlias = Annotated[tuple[Expr, Expr, Expr], Kind("Lengths", "length", ("a", "b", "c"), 3)]
Time: TypeAlias = Annotated[Expr, Kind("Time", "time", ("t_0", "t_1"))]
Angle: TypeAlias = Annotated[Expr, Kind("Angle", "angle", ("theta", "alpha", "beta", "phi"))]
PolarAngle: TypeAlias = Annotated[
    Expr, Kind("PolarAngle", "angle", ("theta_0", "alpha", "beta"), bounds=(Integer(0), pi))
]
AngularSpeed: TypeAlias = Annotated[Expr, Kind("AngularSpeed", "angular speed", ("omega", "Omega"))]
Frequency: TypeAlias = Annotated[Expr, Kind("Frequency", "frequency", ("f", "nu"))]
Speed: TypeAlias = Annotated[Expr, Kind("Speed", "speed", ("v", "u"))]
Acceleration: TypeAlias = Annotated[Expr, Kind("Acceleration", "acceleration", ("g", "a"))]
Density: TypeAlias = Annotated[Expr, Kind("Density", "density", ("rho", "sigma"))]
SurfaceDensity: TypeAlias = Annotated[Expr, Kind("SurfaceDensity", "surface density", ("sigma", "mu"))]
LineDensity: TypeAlias = Annotated[Expr, Kind("LineDensity", "line density", ("lambda_l", "mu"))]
Force: TypeAlias = Annotated[Expr, Kind("Force", "force", ("F", "P"))]
MomentOfInertia: TypeAlias = Annotated[Expr, Kind("MomentOfInertia", "moment of inertia", ("I_0", "J_0"))]
MomentsOfInertia: TypeAlias = Annotated[
    tuple[Expr, Expr, Expr], Kind("MomentsOfInertia", "moment of inertia", ("A", "B", "C"), 3)
]
SpringConstant: TypeAlias = Annotated[Expr, Kind("SpringConstant", "spring constant", ("k", "K"))]
Number: TypeAlias = Annotated[Expr, Kind("Number", "number", ("n",))]

DIRECTION = Kind("Direction", "direction", (), 3)
_MEASURES = (
    Mass,
    Length,
    Lengths,
    Time,
    Angle,
    PolarAngle,
    AngularSpeed,
    Speed,
    Acceleration,
    Density,
    SurfaceDensity,
    LineDensity,
    Force,
)
_OTHERS = (Frequency, MomentOfInertia, MomentsOfInertia, SpringConstant, Number)
_KINDS = (*(get_args(alias)[1] for alias in (*_MEASURES, *_OTHERS)), DIRECTION)
KINDS: Mapping[str, Kind] = {kind.name: kind for kind in _KINDS}


def kind_of_annotation(annotation: Any) -> Kind | None:
    """The kind that a parameter's annotation names, also when it is a string."""
    if annotation is Direction:
        return DIRECTION
    if isinstance(annotation, str):
        return KINDS.get(annotation.strip().rpartition(".")[2])
    return next((arg for arg in get_args(annotation) if isinstance(arg, Kind)), None)
