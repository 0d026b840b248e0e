"""Small motions with gyroscopic forces, linear in the rates and without work: rotating frames, tops, charges.
Equations M eta_ddot + G eta_dot + K eta = 0 with G antisymmetric have solutions eta = Re(a e^(i omega t)) where
det(K + i omega G - omega^2 M) = 0, a polynomial in omega^2. An equilibrium is stable if all omega^2 are real, positive
and different: gyroscopic forces may stabilise an equilibrium that is not a minimum of the potential energy.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from sympy import (
    Add,
    Expr,
    I,
    ImmutableDenseMatrix,
    Integer,
    MatrixSymbol,
    Poly,
    Symbol,
    cos,
    diff,
    exp,
    sin,
)
from sympy.matrices import MatrixBase

from derive.algebra.amplitudes import Amplitudes, Determinant, determinant_of
from derive.algebra.expressions import Relation, explicit, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import T
from derive.mechanics.vibrations import claims
from derive.mechanics.vibrations.facts import Linear
from derive.mechanics.vibrations.linearised import with_motion
from derive.solving.gyroscopic import OMEGA, GyroscopicPencil, Swing, factored
from derive.solving.relations import positive
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.record import require_constant
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Fact, Quantity, is_zero

__all__: list[str] = []

ZERO = Integer(0)


@dataclass(frozen=True)
class Turning(Fact):
    """The frequency of a motion with gyroscopic forces: the root that it is."""

    missing = "is not the frequency of a motion with forces linear in the rates"
    swing: Swing


@dataclass(frozen=True)
class TurningModes:
    """The results of `normal_modes` with forces linear in the rates that do no work."""

    linear: Sequence[Quantity]
    together: Linear
    letter: Symbol
    start: str

    def found(self) -> tuple[Quantity, ...]:
        """Return the frequencies, and the motions of those that have one shape."""
        linear, together, start, pencil = self.linear, self.together, self.start, self.pencil
        characteristic, name = self.characteristic, self.letter.name
        found = [_frequency(characteristic, together, pencil, n, name, start) for n in range(len(pencil.swings))]
        motions: list[Quantity] = []
        for n, each in enumerate(found, 1):
            column = pencil.column(each.needed(Turning).swing)
            if column is not None:
                motions.append(_motion(linear, together, each, column, n, start))
        return (*found, *motions)

    @cached_property
    def pencil(self) -> GyroscopicPencil:
        return pencil_of(self.together)

    @cached_property
    def characteristic(self) -> Quantity:
        return _characteristic(self.linear, self.together, self.pencil, self.letter, self.start)


def pencil_of(together: Linear) -> GyroscopicPencil:
    """Return the matrices, for forces that do no work and forces with a potential energy."""
    require_turning("normal_modes", together)
    return GyroscopicPencil(together.stiffness, together.turning, together.mass, together.exists)


def require_turning(verb: str, together: Linear) -> None:
    """Require no driving force, a symmetric stiffness matrix, and no work of the forces linear in the rates."""
    if any(force != 0 for force in together.driven):
        message = f"`{verb}` needs equations without a driving force, but a force depends on the time"
        raise Rejected(Complaint("wrong-argument", message))
    symmetric = is_zero((together.stiffness - together.stiffness.T).applyfunc(tidied))
    if not symmetric or not is_zero((together.mass - together.mass.T).applyfunc(tidied)):
        raise Rejected(Complaint("wrong-argument", f"`{verb}` needs forces that have a potential energy"))
    if not is_zero((together.turning + together.turning.T).applyfunc(tidied)):
        message = f"`{verb}` needs forces linear in the rates that do no work, but there is also drag"
        raise Rejected(Complaint("wrong-argument", message))
    for matrix, role in ((together.mass, "mass"), (together.turning, "turning"), (together.stiffness, "stiffness")):
        for entry in matrix:
            require_constant(verb, role, entry)


GYROSCOPIC_CHARACTERISTIC = Rule(
    "vibrations.gyroscopic_characteristic",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 6.2; Landau, Lifshitz, *Mechanics*, section 23",
    outcomes={"generic": claims.has_turning, "plain": claims.gyroscopic_characteristic_plain},
    evidence={"quadrature": ROUTE},
    named={"trial": claims.trial(I, "omega")},
)


def _characteristic(
    linear: Sequence[Quantity], together: Linear, pencil: GyroscopicPencil, letter: Symbol, start: str
) -> Quantity:
    """Characteristic equation, det(K + i omega G - omega^2 M) = 0.

    Outcomes: generic, plain (no term is linear in the rates).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.2; Landau, Lifshitz, *Mechanics*, section 23.
    """
    matrix = ImmutableDenseMatrix(together.rows_of(pencil.at(letter)).applyfunc(_tidy_entry))

    return establish(
        GYROSCOPIC_CHARACTERISTIC,
        None,
        lambda *_: Relation(Determinant(matrix), "=", 0),
        {"omega": letter},
        lines=Lines(put_in=None, arranged=lambda _: Relation(factored(pencil.parts, letter), "=", 0)),
        routes={"quadrature": lambda found: in_quadrature(found, linear, together, letter)},
        outcome="plain" if is_zero(together.turning) else "generic",
        phrase_data=PhraseData(named={"trial": exp(I * letter * T)}, outcome_data={"turning": tuple(together.turning)}),
        key=f"{start}characteristic_equation",
        parents=linear,
        scope=Scope(coordinates={letter: "angular speed"}),
    )


def in_quadrature(
    found: Relation, linear: Sequence[Quantity], together: Linear, letter: Symbol
) -> tuple[Relation, Relation]:
    """Substitute cosines and sines with real amplitudes: the determinant of twice as many equations is the square."""
    whole = of_cosines_and_sines(linear, together, letter)
    return Relation(explicit(found).residual ** 2, found.operator, 0), Relation(whole, "=", 0)


def _tidy_entry(entry: Expr) -> Expr:
    real, imaginary = entry.expand().as_real_imag()
    return tidied(real) + I * tidied(imaginary)


def of_cosines_and_sines(linear: Sequence[Quantity], together: Linear, letter: Symbol) -> Expr:
    """Return the determinant of the equations for eta = u cos(omega t) + v sin(omega t), sorted by cos and sin."""
    size = len(linear)
    u, v = ([Symbol(f"{name}_{n}", real=True) for n in range(size)] for name in ("u", "v"))
    c, s = cos(letter * T), sin(letter * T)
    rows = []
    for equation in linear:
        left = with_motion(equation, together, [a * c + b * s for a, b in zip(u, v, strict=True)]).expand()
        rows += [[diff(left.coeff(part), a) for a in (*u, *v)] for part in (c, s)]
    return determinant_of(ImmutableDenseMatrix(rows))


_OF_SIGN = {1: "oscillating", -1: "growing", 0: "free", None: "conditional"}


GYROSCOPIC_FREQUENCY = Rule(
    "vibrations.gyroscopic_frequency",
    source="that of `normal_modes`",
    outcomes={
        "oscillating": claims.frequency(1),
        "growing": claims.frequency(-1),
        "free": claims.free,
        "conditional": claims.frequency(None),
    },
    evidence={"put_back": CHECK, "sum_of_squares": CHECK},
)


def _frequency(
    characteristic: Quantity, together: Linear, pencil: GyroscopicPencil, n: int, symbol: str, start: str
) -> Quantity:
    """Frequency of one mode, or its growth rate.

    Outcomes: oscillating, growing, free, conditional.
    Source: that of `normal_modes`.
    """
    swing = pencil.swings[n]
    name = f"{'kappa' if swing.sign == -1 else symbol}_{n + 1}"
    letter = characteristic.step.coordinates[-1][0]
    turned = -1 if swing.sign == -1 else 1

    def put_back(found: Expr) -> tuple[Expr, Expr]:
        return _at_square(_polynomial_of(characteristic), letter, turned * explicit(found) ** 2), ZERO

    def sum_of_squares(found: Expr) -> tuple[Expr, Expr]:
        others = ((i, s) for i, s in enumerate(pencil.swings) if i != n)
        signed = Add(*((-1 if s.sign == -1 else 1) * explicit(s.value) ** 2 * s.part.times for _, s in others))
        return turned * explicit(found) ** 2 * swing.part.times + signed, _sum_of_squares(together)

    needs = [need.as_content_primitive()[1] for need in swing.needs if pencil.sign(need) != 1]
    conditions = [positive(need) for need in needs]
    pairs = enumerate(zip(conditions, needs, strict=True), 1)
    told = {f"condition_{i}": (condition, Relation(need, ">", 0)) for i, (condition, need) in pairs}
    return establish(
        GYROSCOPIC_FREQUENCY,
        scalar(name),
        lambda *_: swing.value,
        {},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"put_back": put_back, "sum_of_squares": sum_of_squares},
        outcome=_OF_SIGN[swing.sign],
        phrase_data=PhraseData(
            formulas=told, points_to={"characteristic": characteristic}, outcome_data=outcome_data(together, conditions)
        ),
        key=f"{start}frequency_{n + 1}",
        kind="angular speed",
        parents=[characteristic],
        facts=[Turning(swing)],
    )


def outcome_data(together: Linear, conditions: Sequence[Relation] = ()) -> dict[str, Any]:
    """Return the data for judging an outcome of such a motion: the matrices, and the stated conditions."""
    found: dict[str, Any] = {
        "stiffness": together.stiffness,
        "turning": together.turning,
        "mass": together.mass,
        "conditions": tuple(conditions),
    }
    return {**found, **({"exists": together.exists} if together.exists is not None else {})}


def _polynomial_of(characteristic: Quantity) -> Expr:
    return explicit(characteristic.value).left.expand()


def _at_square(value: Expr, letter: Symbol, square: Expr) -> Expr:
    """Return a polynomial in omega^2 at this value of omega^2."""
    polynomial = Poly(value, letter)
    return Add(*(c * square ** (n // 2) for (n,), c in polynomial.terms()))


def _sum_of_squares(together: Linear) -> Expr:
    """Return the sum of all omega^2: tr(M^-1 K) - tr((M^-1 G)^2)/2, by the square of the first-order matrix."""
    inverse = together.mass.inv()
    turning = inverse * together.turning
    return tidied((inverse * together.stiffness).trace() - (turning * turning).trace() / 2)


# --- how the coordinates move ----------------------------------------------------------------------------------------


GYROSCOPIC_MOTION = Rule(
    "vibrations.gyroscopic_motion",
    source="Landau, Lifshitz, *Mechanics*, section 39, problem 3",
    outcomes={
        "departing": claims.departing,
        "circle_forwards": claims.sense(1, circle=True),
        "circle_backwards": claims.sense(-1, circle=True),
        "ellipse_forwards": claims.sense(1, circle=False),
        "ellipse_backwards": claims.sense(-1, circle=False),
        "ellipse": claims.sense(None, circle=False),
        "straight": claims.straight,
        "generic": claims.gyroscopic_motion_generic,
    },
    evidence={"motion": CHECK, "energy": ROUTE},
    named={"displacements": claims.moves_so, "first": claims.moves_as(0), "second": claims.moves_as(1)},
)


def _motion(
    linear: Sequence[Quantity],
    together: Linear,
    frequency: Quantity,
    column: tuple[Expr, ...],
    n: int,
    start: str,
) -> Quantity:
    """Motion of one mode: a cosine or a sine for each coordinate, or a common growth.

    Outcomes: departing, circle_forwards, circle_backwards, ellipse, ellipse_forwards, ellipse_backwards, straight,
    generic.
    Source: Landau, Lifshitz, *Mechanics*, section 39, problem 3.
    """
    swing = frequency.needed(Turning).swing

    def moving(w: Expr) -> list[Expr]:
        if swing.sign == -1:
            return [entry.xreplace({OMEGA: w}) * exp(w * T) for entry in column]
        return [_of_time(entry, w, swing.turn) for entry in column]

    def in_equations(found: MatrixBase) -> tuple[MatrixBase, MatrixBase]:
        """Substitute the motion in the linear equations, at any time."""
        left = [with_motion(each, together, list(explicit(found))) for each in linear]
        return ImmutableDenseMatrix(left), ImmutableDenseMatrix([ZERO] * len(left))

    def energy(found: MatrixBase) -> tuple[Expr, Expr]:
        """Check that T + U is conserved, since the forces linear in the rates do no work."""
        eta = explicit(found)
        rates = eta.applyfunc(lambda value: diff(value, T))
        whole = (rates.T * together.mass * rates + eta.T * together.stiffness * eta)[0]
        return whole, whole.subs(T, 0)

    own = [s.symbol for s, entry in zip(together.displacements, column, strict=True) if not is_zero(entry)]
    displacements = Amplitudes(*(s.symbol for s in together.displacements))
    names = dict(zip(("first", "second"), own, strict=False))
    return establish(
        GYROSCOPIC_MOTION,
        MatrixSymbol(f"{_letter(together)}_{n}", len(column), 1),
        lambda w: Amplitudes(*moving(w)),
        {"frequency": frequency},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"motion": in_equations, "energy": energy},
        outcome=_outcome(column, swing),
        phrase_data=PhraseData(
            named={"displacements": displacements, **names},
            points_to={"linear": linear[0]},
            outcome_data=outcome_data(together),
        ),
        key=f"{start}mode_{n}",
        parents=[*linear],
        scope=Scope(),
    )


def _of_time(entry: Expr, w: Expr, turn: int) -> Expr:
    """Return the real part of r e^(i omega t), where omega is w or -w, and r is real or imaginary."""
    if entry.has(I):
        return -turn * (entry / I).xreplace({OMEGA: turn * w}) * sin(w * T)
    return entry.xreplace({OMEGA: turn * w}) * cos(w * T)


def _letter(together: Linear) -> str:
    taken = {s.name.partition("_")[0] for each in (together.mass, together.turning, together.stiffness)
             for s in each.free_symbols}  # fmt: skip
    return next((letter for letter in ("a", "A", "b", "u") if letter not in taken), "v")


def _outcome(column: Sequence[Expr], swing: Swing) -> str:
    """Return the shape of the path if two coordinates move, and its sense, from the first to the second."""
    if swing.sign == -1:
        return "departing"
    entries = [entry for entry in column if not is_zero(entry)]
    if not any(entry.has(I) for entry in entries):
        return "straight"
    if len(entries) != 2:
        return "generic"
    size = tidied(-swing.turn * (entries[1] / I).xreplace({OMEGA: swing.turn * OMEGA}))
    if is_zero(size - 1) or is_zero(size + 1):
        return "circle_forwards" if is_zero(size - 1) else "circle_backwards"
    return {True: "ellipse_forwards", False: "ellipse_backwards", None: "ellipse"}[size.is_positive]
