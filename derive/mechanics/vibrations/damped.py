"""Small motions with drag: the exponents s of eta = a e^(s t), if the determinant det(M s^2 + C s + K) factors.

A factor a s^2 + b s + c belongs to one damped oscillator, with the decay rate b/(2 a) and the frequency
sqrt(c/a - b^2/(4 a^2)). A factor a s + b belongs to a displacement that decays at the rate b/a; if b/a is
negative, the displacement grows.
"""

from __future__ import annotations

from dataclasses import dataclass

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, MatrixSymbol, Poly, Symbol, cos, diff, exp
from sympy.matrices import MatrixBase

from derive.algebra.amplitudes import Amplitudes, Determinant, determinant_of
from derive.algebra.expressions import Relation, Root, explicit, scalar, stand_in
from derive.algebra.tidy import tidied
from derive.mechanics.kinematics.coordinates import T
from derive.mechanics.vibrations import claims
from derive.mechanics.vibrations.linear_equations import Equations
from derive.solving.linear_systems import CharacteristicRoot, Damped
from derive.solving.relations import positive
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.record import free_letter
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.step import Quantity

__all__: list[str] = []


@dataclass(frozen=True)
class DampedModes(Equations[Damped]):
    """The results of `normal_modes` with drag."""

    def found(self) -> tuple[Quantity, ...]:
        """Return the steps for each factor of the determinant. A zero exponent gives one step. Any other factor gives
        the decay rate, and the frequency if the factor is quadratic and its roots differ. For several coordinates such
        a factor also gives the shape, if the shape is the same for all exponents of the factor."""
        roots, characteristic = self.system.roots, _characteristic(self)
        found: list[Quantity] = []
        number = self.before
        for root in roots:
            if root.factor.is_free:
                found.append(_free(self, characteristic))
                continue
            number += 1
            index = f"_{number}" if len(roots) > 1 or not self.is_whole else ""
            own = _rate(self, characteristic, root, index)
            found.append(own)
            if root.factor.degree == 2 and root.sign != 0:
                found.append(_frequency(self, own, root, index))
            column = self.system.column(root) if len(self.linear) > 1 else None
            if column is not None:
                found.append(_shape(self, own, root, column, number))
        return tuple(found)


DAMPED_CHARACTERISTIC = Rule(
    "vibrations.damped_characteristic",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 6.5; Landau, Lifshitz, *Mechanics*, section 25",
    outcomes={"one": claims.damped_characteristic_one, "several": claims.damped_characteristic_several},
    evidence={"trial": ROUTE},
    named={"trial": claims.trial(1, "exponent")},
    statements=[claims.coupled_only_to_each_other],
)


def _characteristic(equations: DampedModes) -> Quantity:
    """Characteristic equation, det(M s^2 + C s + K) = 0.

    Outcomes: several (for several coordinates), one (for one coordinate).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.5; Landau, Lifshitz, *Mechanics*, section 25.
    """
    linear, letter = equations.linear, equations.letter
    tidy = equations.matrix(letter)
    whole = Determinant(tidy) if len(linear) > 1 else tidy[0]

    def by_trial(found: Relation) -> tuple[Relation, Relation]:
        return found, Relation(determinant_of(equations.factors_of_amplitudes(exp(letter * T))), "=", 0)

    return establish(
        DAMPED_CHARACTERISTIC,
        None,
        lambda *_: Relation(whole, "=", 0),
        {"exponent": letter},
        lines=Lines(put_in=None, arranged=lambda _: Relation(equations.system.written(letter), "=", 0)),
        routes={"trial": by_trial},
        outcome="several" if len(linear) > 1 else "one",
        phrase_data=PhraseData(named={"trial": exp(letter * T)}, points_to=equations.named),
        key=f"{equations.start}characteristic_equation{equations.number}",
        parents=linear,
        scope=Scope(coordinates={letter: "angular speed"}),
    )


DAMPED_FREE = Rule(
    "vibrations.damped_free",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 6.5; Landau, Lifshitz, *Mechanics*, section 25",
    evidence={"put_back": CHECK},
)


def _free(equations: DampedModes, characteristic: Quantity) -> Quantity:
    """The step for the exponent zero, which belongs to a displacement without a restoring force.

    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.5; Landau, Lifshitz, *Mechanics*, section 25.
    """
    letter = equations.letter
    return establish(
        DAMPED_FREE,
        None,
        lambda: Relation(letter, "=", 0),
        {},
        lines=Lines(put_in=None, arranged=explicit),
        routes={"put_back": lambda found: (_left(characteristic).subs(letter, found.right), 0)},
        phrase_data=PhraseData(points_to={"characteristic": characteristic}, outcome_data=equations.judged_by()),
        key=f"{equations.start}exponent_0{equations.number}",
        parents=[characteristic],
    )


def _left(characteristic: Quantity) -> Expr:
    return explicit(characteristic.value).left


DAMPED_RATE = Rule(
    "vibrations.damped_rate",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 6.5; Landau, Lifshitz, *Mechanics*, section 25",
    outcomes={kind: claims.gyroscopic_rate(kind) for kind in ("oscillator", "critical", "decay", "growth")},
    evidence={"put_back": CHECK},
)


def _rate(equations: DampedModes, characteristic: Quantity, root: CharacteristicRoot, number: str) -> Quantity:
    """Decay rate.

    Outcomes, for a quadratic factor of the characteristic polynomial: oscillator, or critical (its roots are equal, so
    the factor may be the square of a linear one); for a linear factor: decay, or growth (the rate is negative).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.5; Landau, Lifshitz, *Mechanics*, section 25.
    """
    a, _, *rest = root.factor.coefficients
    has_equal_roots = root.sign == 0 if rest else root.times == 2 and len(equations.linear) == 1

    def put_back(found: Expr) -> tuple[Expr, Expr]:
        """Substitute the exponents of the motion into the determinant: s = -beta +- sqrt(beta^2 - c/a) for a quadratic
        factor, s = -beta for a linear factor."""
        square = found**2 - rest[0] / a if rest else Integer(0)
        return _remainder_at(characteristic, equations.letter, -found, square), 0

    return establish(
        DAMPED_RATE,
        scalar(free_letter(f"beta{number}")),
        lambda *_: root.value,
        {},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"put_back": put_back},
        outcome="critical" if has_equal_roots else "oscillator" if rest else "growth" if root.sign == -1 else "decay",
        phrase_data=PhraseData(points_to={"characteristic": characteristic}, outcome_data=equations.judged_by()),
        key=f"{equations.start}decay{number}",
        kind="angular speed",
        parents=[characteristic],
    )


def _remainder_at(characteristic: Quantity, letter: Symbol, middle: Expr, square: Expr) -> Expr:
    """Return an expression without roots that vanishes if the determinant vanishes at s = middle +- sqrt(square).

    One term has the even powers of sqrt(square). The other term has the odd powers, with an extra symbol in place of
    one factor sqrt(square), so both terms must vanish.
    """
    mark, weight = Symbol("r_mark"), Symbol("w_mark", real=True)
    value = Poly(_left(characteristic).xreplace({letter: middle + mark}).expand(), mark)
    even, odd = (Add(*(c * square ** (n // 2) for (n,), c in value.terms() if n % 2 == rest)) for rest in (0, 1))
    return even + (weight * odd if square != 0 else 0)


DAMPED_FREQUENCY = Rule(
    "vibrations.damped_frequency",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 6.5; Landau, Lifshitz, *Mechanics*, section 25",
    outcomes={"oscillating": claims.damped(1), "conditional": claims.damped(None), "overdamped": claims.damped(-1)},
    evidence={"motion": CHECK},
    statements=[claims.positive_where_real],
)


def _frequency(equations: DampedModes, own: Quantity, root: CharacteristicRoot, number: str) -> Quantity:
    """Frequency of a damped oscillation, sqrt(omega_0^2 - beta^2).

    Outcomes: oscillating, conditional, overdamped (the result is half the difference of the two decay rates).
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.5; Landau, Lifshitz, *Mechanics*, section 25.
    """
    a, b, c = root.factor.coefficients
    turned = -1 if root.sign == -1 else 1
    condition = positive(-root.factor.discriminant) if root.sign is None else None
    name = free_letter(f"{'gamma' if turned < 0 else 'omega'}{number}")

    def motion(found: Expr) -> tuple[Expr, Expr]:
        """Substitute e^(-beta t) cos(w t), or e^(-beta t) cosh(w t) if the motion is overdamped, into the equation."""
        w = stand_in("w", positive=True)
        course = exp(-own.value * T) * (cos(w * T) if turned > 0 else (exp(w * T) + exp(-w * T)) / 2)
        left = (a * diff(course, T, 2) + b * diff(course, T) + c * course) / exp(-own.value * T)
        return left.expand().subs(w**2, turned * (turned * found**2)), 0

    told = {"condition": (condition, Relation(4 * a * c - b**2, ">", 0))} if condition is not None else {}
    return establish(
        DAMPED_FREQUENCY,
        scalar(name),
        lambda *_: Root(turned * equations.system.square(root)),
        {},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"motion": motion},
        outcome={1: "oscillating", None: "conditional"}.get(root.sign, "overdamped"),
        phrase_data=PhraseData(
            formulas=told,
            points_to={"rate": own},
            outcome_data=equations.judged_by([condition] if condition is not None else []) | {"beta": own.value},
        ),
        key=f"{equations.start}frequency{number}",
        kind="angular speed",
        parents=[own],
    )


DAMPED_SHAPE = Rule(
    "vibrations.damped_shape",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 6.5; Landau, Lifshitz, *Mechanics*, section 25",
    outcomes={
        "in_phase": claims.sign_of_product(1),
        "opposite": claims.sign_of_product(-1),
        "generic": claims.damped_shape_generic,
    },
    evidence={"motion": CHECK},
)


def _shape(
    equations: DampedModes, own: Quantity, root: CharacteristicRoot, column: MatrixBase, number: int
) -> Quantity:
    """Amplitudes of one damped motion.

    Outcomes: in_phase, opposite, generic.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.5; Landau, Lifshitz, *Mechanics*, section 25.
    """
    linear = equations.linear

    def moving(found: MatrixBase) -> tuple[MatrixBase, MatrixBase]:
        """Check that the residuals are multiples of a factor of the determinant, so they vanish at the roots of this
        factor."""
        letter = Symbol("s_trial")
        course = exp(letter * T)
        left = [(value / course).expand() for value in equations.with_motion([a * course for a in found])]
        factor = Poly(root.factor.at(letter), letter, field=True)
        values = [Poly(value, letter, field=True).rem(factor).as_expr() for value in left]
        return ImmutableDenseMatrix(values), ImmutableDenseMatrix([0 * value for value in values])

    sign = equations.system.sign(tidied(column[0] * column[1])) if len(column) == 2 else None
    return establish(
        DAMPED_SHAPE,
        MatrixSymbol(f"a_{number}", len(column), 1),
        lambda _: Amplitudes(*column),
        {"rate": own},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"motion": moving},
        outcome={1: "in_phase", -1: "opposite"}.get(sign or 0, "generic"),
        phrase_data=PhraseData(points_to={"linear": linear[0]}, outcome_data=equations.judged_by()),
        key=f"{equations.start}mode_{number}",
        parents=[*linear],
    )
