"""Small motions with gyroscopic forces, which are linear in the rates and do no work.

Such forces act in rotating frames, on tops and on charges in a magnetic field. The equations
M eta_ddot + G eta_dot + K eta = 0 with antisymmetric G have solutions eta = Re(a e^(i omega t)). Here omega is a root
of the determinant of K + i omega G - omega^2 M. This determinant is a polynomial in omega^2. An equilibrium is stable
if all omega^2 are real, positive and distinct. So gyroscopic forces may stabilise an equilibrium at which the potential
energy has no minimum.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from sympy import (
    Add,
    Expr,
    I,
    ImmutableDenseMatrix,
    Integer,
    MatrixSymbol,
    Mul,
    Poly,
    Symbol,
    cancel,
    cos,
    diff,
    discriminant,
    exp,
    factor,
    sin,
)
from sympy.matrices import MatrixBase

from derive.algebra.amplitudes import Amplitudes, Determinant, determinant_of, inverse_of
from derive.algebra.expressions import Relation, explicit, scalar
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import T
from derive.mechanics.vibrations import claims
from derive.mechanics.vibrations.facts import Linear
from derive.mechanics.vibrations.linear_equations import (
    OF_SIGN,
    Equations,
    letter_of_shapes,
    together_for,
)
from derive.solving.linear_systems import OMEGA, CharacteristicRoot, Factor, Gyroscopic, LinearSystem
from derive.solving.relations import border_of, positive
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Form, Level, Quantity, is_zero
from derive.witness.facts import Rest

__all__ = ["linear_stability"]

ZERO = Integer(0)
LARGEST = 200  # greatest number of operations in a condition that is factored


@dataclass(frozen=True)
class TurningModes(Equations[Gyroscopic]):
    """The results of `normal_modes` with gyroscopic forces, which are linear in the rates and do no work."""

    def found(self) -> tuple[Quantity, ...]:
        """Return the frequencies, then the motion for each frequency for which the amplitudes are found."""
        characteristic = _characteristic(self)
        found = [_frequency(self, characteristic, n) for n in range(len(self.system.roots))]
        motions: list[Quantity] = []
        for n, (root, each) in enumerate(zip(self.system.roots, found, strict=True), self.before + 1):
            column = self.system.column(root)
            if column is not None:
                motions.append(_motion(self, each, root, column, n))
        return (*found, *motions)


GYROSCOPIC_CHARACTERISTIC = Rule(
    "vibrations.gyroscopic_characteristic",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 6.2; Landau, Lifshitz, *Mechanics*, section 23",
    outcomes={"generic": claims.has_turning, "plain": claims.gyroscopic_characteristic_plain},
    evidence={"quadrature": ROUTE},
    named={"trial": claims.trial(I, "omega")},
    statements=[claims.coupled_only_to_each_other],
)


def _characteristic(equations: TurningModes) -> Quantity:
    """Characteristic equation, det(K + i omega G - omega^2 M) = 0.

    Outcomes: generic, plain (no term is linear in the rates).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.2; Landau, Lifshitz, *Mechanics*, section 23.
    """
    system, letter = equations.system, equations.letter
    matrix = ImmutableDenseMatrix(equations.matrix(I * letter).applyfunc(_tidy_entry))

    return establish(
        GYROSCOPIC_CHARACTERISTIC,
        None,
        lambda *_: Relation(Determinant(matrix), "=", 0),
        {"omega": letter},
        lines=Lines(put_in=None, arranged=lambda _: Relation(system.written(letter), "=", 0)),
        routes={"quadrature": lambda found: _in_quadrature(found, equations)},
        outcome="plain" if system.is_conservative else "generic",
        phrase_data=PhraseData(
            named={"trial": exp(I * letter * T)},
            points_to=equations.named,
            outcome_data={"turning": tuple(system.turning)},
        ),
        key=f"{equations.start}characteristic_equation{equations.number}",
        parents=equations.linear,
        scope=Scope(coordinates={letter: "angular speed"}),
    )


def _in_quadrature(found: Relation, equations: TurningModes) -> tuple[Relation, Relation]:
    """Compare with a motion of cosines and sines: the determinant of the equations for the real amplitudes of this
    motion is the square of the left side."""
    return Relation(explicit(found).residual ** 2, found.operator, 0), Relation(
        _of_cosines_and_sines(equations), "=", 0
    )


def _tidy_entry(entry: Expr) -> Expr:
    real, imaginary = entry.expand().as_real_imag()
    return tidied(real) + I * tidied(imaginary)


def _of_cosines_and_sines(equations: TurningModes) -> Expr:
    """Return the determinant of the equations for the amplitudes u and v of eta = u cos(omega t) + v sin(omega t).

    Each linear equation gives two equations: the factors of the cosine and of the sine vanish.
    """
    u, v = ([Symbol(f"{name}_{n}", real=True) for n in range(len(equations.linear))] for name in ("u", "v"))
    c, s = cos(equations.letter * T), sin(equations.letter * T)
    rows = []
    for left in equations.with_motion([a * c + b * s for a, b in zip(u, v, strict=True)]):
        rows += [[diff(left.expand().coeff(part), a) for a in (*u, *v)] for part in (c, s)]
    return determinant_of(ImmutableDenseMatrix(rows))


GYROSCOPIC_FREQUENCY = Rule(
    "vibrations.gyroscopic_frequency",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 6.2; Landau, Lifshitz, *Mechanics*, section 23",
    outcomes={
        "oscillating": claims.frequency(1),
        "growing": claims.frequency(-1),
        "free": claims.free,
        "conditional": claims.frequency(None),
    },
    evidence={"put_back": CHECK, "sum_of_squares": CHECK},
)


def _frequency(equations: TurningModes, characteristic: Quantity, n: int) -> Quantity:
    """Frequency of one mode, or its growth rate.

    Outcomes: oscillating, growing, free, conditional.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.2; Landau, Lifshitz, *Mechanics*, section 23.
    """
    system, letter = equations.system, equations.letter
    root, number = system.roots[n], equations.before + n + 1
    turned = -1 if root.sign == -1 else 1

    def put_back(found: Expr) -> tuple[Expr, Expr]:
        left = explicit(characteristic.value).left.expand()
        return _by_square(left, letter, turned * explicit(found) ** 2), ZERO

    def sum_of_squares(found: Expr) -> tuple[Expr, Expr]:
        others = (s for i, s in enumerate(system.roots) if i != n)
        signed = Add(*((-1 if s.sign == -1 else 1) * explicit(s.value) ** 2 * s.times for s in others))
        return turned * explicit(found) ** 2 * root.times + signed, _sum_of_squares(system)

    needs = [need.as_content_primitive()[1] for need in root.needs if system.sign(need) != 1]
    conditions = [positive(need) for need in needs]
    pairs = enumerate(zip(conditions, needs, strict=True), 1)
    told = {f"condition_{i}": (condition, Relation(need, ">", 0)) for i, (condition, need) in pairs}
    return establish(
        GYROSCOPIC_FREQUENCY,
        scalar(f"{'kappa' if root.sign == -1 else letter.name}_{number}"),
        lambda *_: root.value,
        {},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"put_back": put_back, "sum_of_squares": sum_of_squares},
        outcome=OF_SIGN[root.sign],
        phrase_data=PhraseData(
            formulas=told,
            points_to={"characteristic": characteristic},
            outcome_data=equations.judged_by(conditions),
        ),
        key=f"{equations.start}frequency_{number}",
        kind="angular speed",
        parents=[characteristic],
    )


def _by_square(value: Expr, letter: Symbol, square: Expr) -> Expr:
    return Add(*(c * square ** (n // 2) for (n,), c in Poly(value, letter).terms()))


def _sum_of_squares(system: LinearSystem) -> Expr:
    """Return the sum of all omega^2: tr(M^-1 K) - tr((M^-1 G)^2)/2.

    The sum is the trace of -A^2/2, where A is the matrix of the equivalent first-order system.
    """
    inverse = inverse_of(system.mass)
    turning = inverse * system.turning
    return tidied((inverse * system.stiffness).trace() - (turning * turning).trace() / 2)


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
    equations: TurningModes, frequency: Quantity, root: CharacteristicRoot, column: tuple[Expr, ...], n: int
) -> Quantity:
    """Motion of one mode: a cosine or a sine for each coordinate that moves; in a growing mode the same exponential for
    all these coordinates.

    Outcomes: departing, circle_forwards, circle_backwards, ellipse, ellipse_forwards, ellipse_backwards, straight,
    generic.
    Source: Landau, Lifshitz, *Mechanics*, section 39, problem 3.
    """
    linear, system, displacements = equations.linear, equations.system, equations.together.displacements

    def moving(w: Expr) -> list[Expr]:
        if root.sign == -1:
            return [entry.xreplace({OMEGA: w}) * exp(w * T) for entry in column]
        return [_of_time(entry, w, root.turn) for entry in column]

    def in_equations(found: MatrixBase) -> tuple[MatrixBase, MatrixBase]:
        """Check that the motion satisfies the linear equations at all times."""
        left = equations.with_motion(list(explicit(found)))
        return ImmutableDenseMatrix(left), ImmutableDenseMatrix([ZERO] * len(left))

    def energy(found: MatrixBase) -> tuple[Expr, Expr]:
        """Check that T + U is conserved, since the forces linear in the rates do no work."""
        eta = explicit(found)
        rates = eta.applyfunc(lambda value: diff(value, T))
        whole = (rates.T * system.mass * rates + eta.T * system.stiffness * eta)[0]
        return whole, whole.subs(T, 0)

    own = [s.symbol for s, entry in zip(displacements, column, strict=True) if not is_zero(entry)]
    names = dict(zip(("first", "second"), own, strict=False))
    return establish(
        GYROSCOPIC_MOTION,
        MatrixSymbol(f"{letter_of_shapes(system.letters)}_{n}", len(column), 1),
        lambda w: Amplitudes(*moving(w)),
        {"frequency": frequency},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"motion": in_equations, "energy": energy},
        outcome=_outcome(column, root),
        phrase_data=PhraseData(
            named={"displacements": Amplitudes(*(s.symbol for s in displacements)), **names},
            points_to={"linear": linear[0]},
            outcome_data=equations.judged_by(),
        ),
        key=f"{equations.start}mode_{n}",
        parents=[*linear],
        scope=Scope(),
    )


def _of_time(entry: Expr, w: Expr, turn: int) -> Expr:
    """Return the real part of r e^(i omega t), where r is `entry`, real or imaginary, and omega is `turn` times w."""
    if entry.has(I):
        return -turn * (entry / I).xreplace({OMEGA: turn * w}) * sin(w * T)
    return entry.xreplace({OMEGA: turn * w}) * cos(w * T)


def _outcome(column: Sequence[Expr], root: CharacteristicRoot) -> str:
    """Return the outcome of a mode. If two coordinates move, the outcome states the shape of the path and, if it is
    known, the sense of rotation.

    The sense is forwards if the rotation is from the first of these coordinates to the second.
    """
    if root.sign == -1:
        return "departing"
    entries = [entry for entry in column if not is_zero(entry)]
    if not any(entry.has(I) for entry in entries):
        return "straight"
    if len(entries) != 2:
        return "generic"
    size = tidied(-root.turn * (entries[1] / I).xreplace({OMEGA: root.turn * OMEGA}))
    if is_zero(size - 1) or is_zero(size + 1):
        return "circle_forwards" if is_zero(size - 1) else "circle_backwards"
    return {True: "ellipse_forwards", False: "ellipse_backwards", None: "ellipse"}[size.is_positive]


# --- stability -------------------------------------------------------------------------------------------------------


def linear_stability(
    linear: Sequence[Quantity], letter: Expr | None = None, key: str = "stability"
) -> Quantity | tuple[Quantity, ...]:
    """Stability of an equilibrium with gyroscopic forces. The equilibrium is stable if the potential energy has a
    minimum, or if all omega^2 are real, positive and distinct.

    linear   all equations of the system, as `linearised` yields them
    letter   the symbol that a condition is solved for, if possible; by default the symbol that occurs as a square, if
             there is exactly one such symbol

    Gyroscopic forces, which are linear in the rates, may stabilise an equilibrium that is not a minimum of the
    potential energy. If only gyroscopic forces stabilise an equilibrium, drag on every coordinate makes the
    equilibrium unstable.
    Second route: the determinant is also computed by substituting cosines and sines into the equations. Check: on the
    boundary of a condition, two roots of this determinant coincide, or one root vanishes.
    Outcomes: stable, unstable, depends. If there are several conditions, each is a separate step with the outcome
    first, further or last.
    Errors: there is drag; the determinant does not factor, or has a zero or repeated root and U has no minimum.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 3.12 and 5.7.
    """
    together = together_for("linear_stability", linear)
    if not together.is_gyroscopic:
        message = "`linear_stability` needs forces linear in the rates that do no work, but there is also drag"
        raise Rejected(Complaint("wrong-argument", message))
    letter_of_frequency = scalar("omega" if "omega" not in {s.name for s in together.letters} else "Omega")
    block = [i for i in range(len(linear)) if not _oscillates_by_itself(together, i)] or range(len(linear))
    part = together.part(block)
    # `normal_modes` uses the same characteristic equation if all coordinates of `part` are coupled to each other
    is_shared = key == "stability" and not together.is_conservative and len(part.blocks) == 1
    system = part.of_kind(Gyroscopic)
    equations = TurningModes(linear, block, system, letter_of_frequency, "" if is_shared else f"{key}_")
    characteristic = _characteristic(equations)
    needs = _needed(system)
    if any(system.sign(need) == -1 for need in needs):
        return _verdict(equations, characteristic, "unstable", key)
    undecided = [_open(need, system) for need in needs if system.sign(need) != 1]
    if not undecided:
        return _verdict(equations, characteristic, "stable", key)
    conditions = [positive(need, *([letter] if isinstance(letter, Symbol) else [])) for need in undecided]
    found = [
        _condition(equations, characteristic, i, conditions, undecided[i], key if i == 0 else f"{key}_{i + 1}")
        for i in range(len(conditions))
    ]
    return found[0] if len(found) == 1 else tuple(found)


def _oscillates_by_itself(together: Linear, i: int) -> bool:
    """Whether coordinate i is not coupled to any other, and its potential energy has a minimum."""
    part = together.part((i,))
    is_alone = (i,) in together.blocks and part.is_conservative
    return is_alone and part.sign(tidied(part.stiffness[0] / part.mass[0])) == 1


def _told_of_others(equations: TurningModes) -> dict[str, Any]:
    others = (s for s in equations.every[0].needed(Linear).moving if s not in equations.moving)
    return {f"alone_{n}": symbol for n, symbol in enumerate(others, 1)}


def _of_all(equations: TurningModes, conditions: Sequence[Relation] = ()) -> dict[str, Any]:
    whole = equations.every[0].needed(Linear)
    matrices = {"stiffness": whole.stiffness, "turning": whole.turning, "mass": whole.mass}
    return {**equations.judged_by(conditions), **matrices, "displacements": whole.moving}


def _needed(system: Gyroscopic) -> list[Expr]:
    """Return the expressions that must be positive for stability; none at a minimum of the potential energy."""
    if system.is_minimum:
        return []
    free = [part for part in system.factors if part.is_free or part.degree > 2 or part.times > 1]
    if free or any(_may_drift(part, system) for part in system.factors):
        message = (
            "`linear_stability`: the determinant may have a zero or repeated root, "
            "so the linear equations do not determine the stability"
        )
        if any(not part.is_free and part.degree > 2 for part in free):
            message = "`linear_stability`: the determinant has a factor whose roots have no known closed form"
        raise Rejected(Complaint("not-decided", message))
    return [need for part in system.factors for need in part.needs]


def _open(need: Expr, system: Gyroscopic) -> Expr:
    """Drop the factors that are positive where the equilibrium exists; return a long expression unchanged.

    If the equilibrium exists for k > m w^2, (K - m w^2)(k - m w^2) becomes K - m w^2.
    """
    if need.count_ops() > LARGEST:
        return need
    factors = Mul.make_args(factor(need))
    return Mul(*(f / abs(f) if f.is_number else f for f in factors if system.sign(f) != 1))


def _may_drift(part: Factor, system: Gyroscopic) -> bool:
    """Whether a root may be zero although not all stiffnesses vanish. The coordinates may then move uniformly."""
    if not part.mirrored or part.degree != 2 or system.sign(part.coefficients[2]) is not None:
        return any(system.sign(need) == 0 for need in part.needs)
    below = (cancel(entry / part.coefficients[2]).as_numer_denom()[1] for entry in system.stiffness)
    return any(system.sign(tidied(each)) is None for each in below)


GYROSCOPIC_STABILITY = Rule(
    "vibrations.gyroscopic_stability",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, sections 3.12 and 5.7",
    outcomes={
        "stable": claims.always(True),
        "unstable": claims.always(False),
        "depends": claims.gyroscopic_stability_depends,
        "first": claims.gyroscopic_stability_first,
        "further": claims.gyroscopic_stability_further,
        "last": claims.gyroscopic_stability_last,
    },
    evidence={"quadrature": ROUTE, "border": CHECK},
    named={"alone": claims.oscillates_by_itself},
)


def _verdict(equations: TurningModes, characteristic: Quantity, outcome: str, key: str) -> Quantity:
    """Stability that is the same for all values of the symbols.

    Outcomes: stable, unstable.
    Source: the same as for `linear_stability`.
    """
    return establish(
        GYROSCOPIC_STABILITY,
        None,
        lambda equation: equation,
        {"characteristic": characteristic.value},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"quadrature": lambda found: _in_quadrature(found, equations)},
        outcome=outcome,
        phrase_data=PhraseData(
            points_to=_named(characteristic),
            named=_told_of_others(equations),
            outcome_data=_of_all(equations),
        ),
        key=key,
        parents=[characteristic, *_rests(characteristic)],
    )


def _rests(characteristic: Quantity) -> list[Quantity]:
    behind = (each for parent in characteristic.parents for each in parent.parents if each.fact(Rest) is not None)
    return list(dict.fromkeys(behind))


def _named(characteristic: Quantity) -> dict[str, Quantity]:
    return {"characteristic": characteristic, **dict(zip(("rest",), _rests(characteristic), strict=False))}


def _condition(
    equations: TurningModes,
    characteristic: Quantity,
    i: int,
    conditions: Sequence[Relation],
    need: Expr,
    key: str,
) -> Quantity:
    """One of the conditions that stability requires.

    Outcomes: depends, first, further, last.
    Source: the same as for `linear_stability`.
    """
    condition, square = conditions[i], Symbol("z")

    def at_border(found: Relation) -> tuple[Expr, Expr]:
        """Check that two roots of the determinant coincide, or one root is zero, where both sides of the condition are
        equal."""
        by_square = _by_square(_of_cosines_and_sines(equations), equations.letter, square)
        border = border_of(explicit(found))
        meets = _without_squares(by_square, square)
        value = meets * Poly(by_square, square).eval(0)
        residual = value.subs(border.left, border.right) if border is not None else _remainder(value, explicit(found))
        return residual, ZERO

    return establish(
        GYROSCOPIC_STABILITY,
        None,
        lambda *_: Relation(need, ">", 0),
        {},
        lines=Lines(
            put_in=None, law=Level.FULL, result=False, after=[Form(condition, "solved")], arranged=lambda _: condition
        ),
        routes={"border": at_border},
        outcome=_place_among(i, len(conditions)),
        phrase_data=PhraseData(
            points_to=_named(characteristic),
            named=_told_of_others(equations),
            outcome_data=_of_all(equations, conditions),
        ),
        key=key,
        parents=[characteristic, *_rests(characteristic)],
    )


def _place_among(i: int, number: int) -> str:
    if i == number - 1:
        return "last" if i else "depends"
    return "further" if i else "first"


def _without_squares(value: Expr, square: Symbol) -> Expr:
    """Return the discriminant of the square-free part of a polynomial, which vanishes where two roots coincide."""
    found = Poly(value, square).sqf_part()
    return discriminant(found.as_expr(), square)


def _remainder(value: Expr, condition: Relation) -> Expr:
    """Return the remainder after division of the value by the residual of a condition, the difference of its sides. The
    numerator of the value is divided by the numerator of the residual; both are polynomials in one symbol."""
    residual = Poly(condition.residual.as_numer_denom()[0].expand())
    letter = min(residual.gens, key=lambda each: (not each.is_Symbol, str(each)))
    return Poly(value.as_numer_denom()[0].expand(), letter).rem(Poly(residual.as_expr(), letter)).as_expr()
