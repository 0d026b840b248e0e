"""The kinds of quantity, with their dimensions and units, and the annotations by which a script asks for
given quantities.

An author writes a kind under `symbols:` (`M: mass`). A script annotates parameters of `solve()` with a kind
(`mass: Mass`); for a type checker the annotation is SymPy's `Expr`, or a tuple of three `Expr`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias, get_args

from derive.algebra.dimensions import NUMBER, Dimension, dimension, exponents, raised
from derive.algebra.direction import Direction

if TYPE_CHECKING:
    from sympy import Expr


@dataclass(frozen=True)
class Kind:
    """The properties of a kind.

    unit      the coherent SI unit as text
    positive  whether symbols of this kind are positive; symbols of the other kinds are only real
    signed    whether a minus sign is allowed in the value of a positive kind, where it reverses a direction
    angles    the powers of the radian that a unit of the kind may have: 1 for an angle; 1 or 0 for an angular speed
              (rad/s or 1/s)
    """

    dimension: Dimension
    unit: str
    positive: bool = False
    signed: bool = False
    angles: tuple[int, ...] = (0,)


KINDS: Mapping[str, Kind] = {
    "number": Kind(NUMBER, ""),
    "angle": Kind(NUMBER, "rad", angles=(1,)),
    "mass": Kind(dimension(1, 0, 0), "kg", positive=True),
    "length": Kind(dimension(0, 1, 0), "m", positive=True),
    "time": Kind(dimension(0, 0, 1), "s", positive=True),
    "area": Kind(dimension(0, 2, 0), "m^2", positive=True),
    "volume": Kind(dimension(0, 3, 0), "m^3", positive=True),
    "density": Kind(dimension(1, -3, 0), "kg/m^3", positive=True),
    "surface density": Kind(dimension(1, -2, 0), "kg/m^2", positive=True),
    "line density": Kind(dimension(1, -1, 0), "kg/m", positive=True),
    "speed": Kind(dimension(0, 1, -1), "m/s", positive=True, signed=True),
    "acceleration": Kind(dimension(0, 1, -2), "m/s^2", positive=True, signed=True),
    "velocity": Kind(dimension(0, 1, -1), "m/s"),
    "angular speed": Kind(dimension(0, 0, -1), "rad/s", positive=True, signed=True, angles=(1, 0)),
    "angular acceleration": Kind(dimension(0, 0, -2), "rad/s^2", angles=(1, 0)),
    "squared angular speed": Kind(dimension(0, 0, -2), "1/s^2", angles=(2, 0)),
    "frequency": Kind(dimension(0, 0, -1), "Hz", positive=True),
    "force": Kind(dimension(1, 1, -2), "N"),
    "energy": Kind(dimension(1, 2, -2), "J"),
    "power": Kind(dimension(1, 2, -3), "W"),
    "torque": Kind(dimension(1, 2, -2), "N m"),
    "momentum": Kind(dimension(1, 1, -1), "kg m/s"),
    "angular momentum": Kind(dimension(1, 2, -1), "kg m^2/s"),
    "moment of inertia": Kind(dimension(1, 2, 0), "kg m^2", positive=True),
    "spring constant": Kind(dimension(1, 0, -2), "N/m", positive=True),
    "gravitational constant": Kind(dimension(-1, 3, -2), "N m^2/kg^2", positive=True),
    "coupling constant": Kind(dimension(1, 3, -2), "J m", positive=True),  # the k of an energy k/r
    "coefficient of friction": Kind(NUMBER, "", positive=True),
    "damping constant": Kind(dimension(1, 0, -1), "kg/s", positive=True),
    "current": Kind(dimension(0, 0, 0, 1), "A"),
    "rate of current": Kind(dimension(0, 0, -1, 1), "A/s"),
    "voltage": Kind(dimension(1, 2, -3, -1), "V"),
    "resistance": Kind(dimension(1, 2, -3, -2), "ohm", positive=True),
    "inductance": Kind(dimension(1, 2, -2, -2), "H", positive=True),
    "capacitance": Kind(dimension(-1, -2, 4, 2), "F", positive=True),
    "magnetic flux": Kind(dimension(1, 2, -2, -1), "Wb"),
    "charge": Kind(dimension(0, 0, 1, 1), "C"),
    "electric field": Kind(dimension(1, 1, -3, -1), "V/m"),
    "magnetic field": Kind(dimension(1, 0, -2, -1), "T"),
}
_OF_NONE = Kind(NUMBER, "")


def dimension_of_kind(kind: str) -> Dimension:
    return KINDS[kind].dimension


def unit_of_kind(kind: str) -> str:
    """The coherent SI unit, in plain text: `kg m^2/s`."""
    return KINDS[kind].unit


def about_kind(kind: str | None) -> Kind:
    """The properties of a kind; a quantity without a kind has the properties of the kind "number"."""
    return KINDS.get(kind or "", _OF_NONE)


def kind_with_article(kind: str) -> str:
    return f"{'an' if kind[0] in 'aeiou' else 'a'} {kind}"


def plural(kind: str) -> str:
    """The plural of a kind: moments of inertia, angular speeds."""
    noun, of, rest = kind.partition(" of ")
    if noun.endswith("y"):
        return f"{noun[:-1]}ies{of}{rest}"
    return f"{noun}{'es' if noun.endswith('s') else 's'}{of}{rest}"


def kind_of_dimension(dimension: Dimension) -> str | None:
    """The first kind in `KINDS` with that dimension: energy before torque. None if no kind has it."""
    return next((name for name, kind in KINDS.items() if kind.dimension == dimension), None)


def named(dimension: Dimension) -> str:
    """A dimension in words, such as `a length`, or by its exponents if no kind has that dimension."""
    kind = kind_of_dimension(dimension)
    return kind_with_article(kind) if kind else f"a quantity of dimension {exponents(dimension)}"


class Inhomogeneous(Exception):
    """Two terms of one sum differ in dimension, or a function has an argument that is not a number."""

    def __init__(self, term: Any, dimension: Dimension, other: Any, expected: Dimension):
        self.term, self.dimension, self.other, self.expected = term, dimension, other, expected
        super().__init__(f"`{term}` is {named(dimension)}, but `{other}` is {named(expected)}")


def common(terms: Iterable[Any], of: Callable[[Any], Dimension | None]) -> Dimension | None:
    """The dimension of all terms of a sum; raises `Inhomogeneous` with the first term that has a different dimension.

    A term of unknown dimension, such as zero, fits any other term. None if all dimensions are unknown.
    """
    first: tuple[Any, Dimension] | None = None
    for term in terms:
        dimension = of(term)
        if dimension is None:
            continue
        if first is None:
            first = (term, dimension)
        elif dimension != first[1]:
            raise Inhomogeneous(term, dimension, *first)
    return first[1] if first else None


def unit_of_dimension(dimension: Dimension) -> str:
    """The coherent SI unit of a quantity without a kind. If exactly one kind has this dimension, the result is the unit
    of this kind; else it is a product of units.

    Energy and torque have the same dimension, so a quantity of this dimension has the unit N m, which is correct for
    both.
    """
    kinds = [kind for kind in KINDS.values() if kind.dimension == dimension]
    return kinds[0].unit if len(kinds) == 1 else _product_of_units(dimension)


def _product_of_units(dimension: Dimension) -> str:
    """A product of units: `N m`, `kg m^2/s`, `1/s`."""
    powers = {"kg": dimension.mass, "m": dimension.length, "s": dimension.time, "A": dimension.current}
    if dimension.mass == 1 and dimension.time == -2:
        powers = {"N": Fraction(1), "m": dimension.length - 1, "A": dimension.current}
    above = " ".join(raised(unit, n) for unit, n in powers.items() if n > 0)
    below = "".join(f"/{raised(unit, -n)}" for unit, n in powers.items() if n < 0)
    return (above or "1" * bool(below)) + below


# --- annotations of a script -----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Asked:
    """A parameter of `solve()`: `count` quantities of one kind.

    letters   symbols that a page can use for quantities that are given as numbers
    bounds    the least and the greatest allowed angle, in degrees
    """

    each: str
    letters: tuple[str, ...] = ()
    count: int = 1
    bounds: tuple[int, int] | None = None


Mass: TypeAlias = Annotated["Expr", Asked("mass", ("M", "m"))]
Length: TypeAlias = Annotated["Expr", Asked("length", ("l", "a", "b", "c", "d"))]
Lengths: TypeAlias = Annotated[tuple["Expr", "Expr", "Expr"], Asked("length", ("a", "b", "c"), 3)]
Time: TypeAlias = Annotated["Expr", Asked("time", ("t_0", "t_1"))]
Angle: TypeAlias = Annotated["Expr", Asked("angle", ("theta", "alpha", "beta", "phi"))]
PolarAngle: TypeAlias = Annotated["Expr", Asked("angle", ("theta_0", "alpha", "beta"), bounds=(0, 180))]
AngularSpeed: TypeAlias = Annotated["Expr", Asked("angular speed", ("omega", "Omega"))]
Speed: TypeAlias = Annotated["Expr", Asked("speed", ("v", "u"))]
Acceleration: TypeAlias = Annotated["Expr", Asked("acceleration", ("g", "a"))]
Density: TypeAlias = Annotated["Expr", Asked("density", ("rho", "sigma"))]
SurfaceDensity: TypeAlias = Annotated["Expr", Asked("surface density", ("sigma", "mu"))]
LineDensity: TypeAlias = Annotated["Expr", Asked("line density", ("lambda_l", "mu"))]
Force: TypeAlias = Annotated["Expr", Asked("force", ("F", "P"))]
Energy: TypeAlias = Annotated["Expr", Asked("energy", ("E", "W"))]
AngularMomentum: TypeAlias = Annotated["Expr", Asked("angular momentum", ("L_0", "L_1"))]
Frequency: TypeAlias = Annotated["Expr", Asked("frequency", ("f", "nu"))]
MomentOfInertia: TypeAlias = Annotated["Expr", Asked("moment of inertia", ("I_0", "J_0"))]
MomentsOfInertia: TypeAlias = Annotated[tuple["Expr", "Expr", "Expr"], Asked("moment of inertia", ("A", "B", "C"), 3)]
SpringConstant: TypeAlias = Annotated["Expr", Asked("spring constant", ("k", "K"))]
DampingConstant: TypeAlias = Annotated["Expr", Asked("damping constant", ("c", "b"))]
Charge: TypeAlias = Annotated["Expr", Asked("charge", ("q", "Q"))]
ElectricField: TypeAlias = Annotated["Expr", Asked("electric field", ("E", "E_0"))]
MagneticField: TypeAlias = Annotated["Expr", Asked("magnetic field", ("B", "B_0"))]
Number: TypeAlias = Annotated["Expr", Asked("number", ("n",))]
DIRECTION = Asked("direction", count=3)


def _asked(annotation: Any) -> Asked | None:
    return next((part for part in get_args(annotation) if isinstance(part, Asked)), None)


ANNOTATIONS: Mapping[str, Asked] = {
    **{name: asked for name, alias in list(globals().items()) if (asked := _asked(alias))},
    "Direction": DIRECTION,
}


def asked_by_annotation(annotation: Any) -> Asked | None:
    """Return the quantities that a parameter's annotation asks for, or None if it is not an annotation of this module.
    The annotation may be a string."""
    if isinstance(annotation, str):
        return ANNOTATIONS.get(annotation.strip().rpartition(".")[2])
    return DIRECTION if annotation is Direction else _asked(annotation)
