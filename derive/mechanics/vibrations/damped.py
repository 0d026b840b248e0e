"""Small motions with drag: the exponents s of eta = a e^(s t), if det(M s^2 + C s + K) = 0 factors.
A factor a s^2 + b s + c belongs to one damped oscillator, with the decay rate b/2a and the frequency
sqrt(c/a - b^2/4a^2); a factor a s + b to a displacement that decays at the rate b/a.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from sympy import Dummy, Expr, ImmutableDenseMatrix, MatrixSymbol, Mul, Poly, Symbol, cancel, cos, diff, exp, sqrt
from sympy.matrices import MatrixBase
from sympy.polys.polyerrors import PolynomialError

from derive.algebra.amplitudes import Amplitudes, Determinant, determinant_of
from derive.algebra.collect import spread
from derive.algebra.expressions import Relation, Root, explicit, scalar, stand_in
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.kinematics.coordinates import T
from derive.mechanics.vibrations import claims
from derive.mechanics.vibrations.facts import Linear
from derive.mechanics.vibrations.gyroscopic import outcome_data
from derive.mechanics.vibrations.linearised import factors_of_amplitudes, with_motion
from derive.solving.relations import positive
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.record import free_letter, require_constant
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.signs import sign_for_all
from derive.steps.step import Quantity, is_zero

__all__: list[str] = []

LARGEST = 4  # coordinates
S = Dummy("s")
LETTERS = ("s", "lambda", "sigma", "p")  # of the exponent


@dataclass(frozen=True)
class DampedModes:
    """The results of `normal_modes` with drag."""

    linear: Sequence[Quantity]
    together: Linear
    start: str

    def found(self) -> tuple[Quantity, ...]:
        """Return decay rates, frequencies and shapes, factor by factor."""
        _check(self.together)
        factors = _factors(self.together)
        matrices = (self.together.mass, self.together.turning, self.together.stiffness)
        taken = {s.name for each in matrices for s in each.free_symbols}
        letter = scalar(next((name for name in LETTERS if name not in taken), "s_0"))
        characteristic = _characteristic(self.linear, self.together, factors, letter, self.start)
        found: list[Quantity] = []
        number = 0
        for part, times in factors:
            if is_zero(part.eval(0)):
                found.append(_free(characteristic, self.together, part, times, self.start))
                continue
            number += 1
            found += self._of_factor(characteristic, part, times, number, len(factors) > 1)
        return tuple(found)

    def _of_factor(
        self, characteristic: Quantity, part: Poly, times: int, number: int, several: bool
    ) -> list[Quantity]:
        linear, together, start = self.linear, self.together, self.start
        index = f"_{number}" if several else ""
        own = _rate(characteristic, together, part, index, start)
        found = [own]
        if part.degree() == 2:
            found.append(_frequency(own, characteristic, together, part, index, start))
        column = _column(together, part) if len(linear) > 1 and times == 1 else None
        if column is not None:
            found.append(_shape(linear, together, own, part, column, number, start))
        return found


def _check(together: Linear) -> None:
    for matrix, role in ((together.mass, "mass"), (together.turning, "drag"), (together.stiffness, "stiffness")):
        for entry in matrix:
            require_constant("normal_modes", role, entry)
    if together.mass.shape[0] > LARGEST:
        message = f"the exponents of {together.mass.shape[0]} coordinates with drag are too many to compute"
        raise Rejected(Complaint("too-large", message))


def _factors(together: Linear) -> list[tuple[Poly, int]]:
    """Return the factors of the determinant, each linear or quadratic in s; the factor s comes first."""
    matrix = ImmutableDenseMatrix(together.mass * S**2 + together.turning * S + together.stiffness)
    try:
        found = Poly(determinant_of(matrix), S).factor_list()[1]
    except PolynomialError:
        found = []
    if sum(part.degree() * times for part, times in found) != 2 * together.mass.shape[0]:
        raise Rejected(Complaint("no-closed-form", "the determinant is not a polynomial that could be factored"))
    worst = max(part.degree() for part, _ in found)
    if worst > 2:
        message = (
            f"with this drag the modes do not separate: {worst} exponents are the roots of a polynomial that does "
        )
        help_line = "the modes separate if masses, springs and drags are equal, or drag is proportional to mass"
        raise Rejected(Complaint("no-closed-form", f"{message}not factor", help=help_line))
    plain = [(-part if sign_for_all(part.LC()) == -1 else part, times) for part, times in found]
    return sorted(plain, key=lambda each: (not is_zero(each[0].eval(0)), each[0].degree(), len(str(each[0].as_expr()))))


DAMPED_CHARACTERISTIC = Rule(
    "vibrations.damped_characteristic",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 6.5; Landau, Lifshitz, *Mechanics*, section 25",
    outcomes={"one": claims.damped_characteristic_one, "several": claims.damped_characteristic_several},
    evidence={"trial": ROUTE},
    named={"trial": claims.trial(1, "exponent")},
)


def _characteristic(
    linear: Sequence[Quantity], together: Linear, factors: Sequence[tuple[Poly, int]], letter: Symbol, start: str
) -> Quantity:
    """Characteristic equation, det(M s^2 + C s + K) = 0.

    Outcomes: several, one.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.5; Landau, Lifshitz, *Mechanics*, section 25.
    """
    matrix = together.mass * letter**2 + together.turning * letter + together.stiffness
    tidy = together.rows_of(matrix)
    whole = Determinant(tidy) if len(linear) > 1 else tidy[0]

    def by_trial(found: Relation) -> tuple[Relation, Relation]:
        return found, Relation(determinant_of(factors_of_amplitudes(linear, together, exp(letter * T))), "=", 0)

    product = Mul(*(tidied(part.as_expr()).xreplace({S: letter}) ** times for part, times in factors))
    return establish(
        DAMPED_CHARACTERISTIC,
        None,
        lambda *_: Relation(whole, "=", 0),
        {"exponent": letter},
        lines=Lines(put_in=None, arranged=lambda _: Relation(product, "=", 0)),
        routes={"trial": by_trial},
        outcome="several" if len(linear) > 1 else "one",
        phrase_data=PhraseData(named={"trial": exp(letter * T)}),
        key=f"{start}characteristic_equation",
        parents=linear,
        scope=Scope(coordinates={letter: "angular speed"}),
    )


DAMPED_FREE = Rule(
    "vibrations.damped_free",
    source="that of `normal_modes`",
    evidence={"put_back": CHECK},
)


def _free(characteristic: Quantity, together: Linear, part: Poly, times: int, start: str) -> Quantity:
    """Exponent zero: a displacement without a restoring force.

    Source: that of `normal_modes`.
    """
    letter = characteristic.step.coordinates[-1][0]
    return establish(
        DAMPED_FREE,
        None,
        lambda: Relation(letter, "=", 0),
        {},
        lines=Lines(put_in=None, arranged=explicit),
        routes={"put_back": lambda found: (_left(characteristic).subs(letter, found.right), 0)},
        phrase_data=PhraseData(points_to={"characteristic": characteristic}, outcome_data=outcome_data(together)),
        key=f"{start}exponent_0",
        parents=[characteristic],
    )


def _left(characteristic: Quantity) -> Expr:
    return explicit(characteristic.value).left


DAMPED_RATE = Rule(
    "vibrations.damped_rate",
    source="that of `normal_modes`",
    outcomes={kind: claims.gyroscopic_rate(kind) for kind in ("oscillator", "decay", "growth")},
    evidence={"put_back": CHECK},
)


def _rate(characteristic: Quantity, together: Linear, part: Poly, number: str, start: str) -> Quantity:
    """Decay rate.

    Outcomes: oscillator, decay, growth.
    Source: that of `normal_modes`.
    """
    letter = characteristic.step.coordinates[-1][0]
    coefficients = [tidied(c) for c in part.all_coeffs()]
    twice = len(coefficients) == 3
    value = tidied(coefficients[1] / (coefficients[0] * (2 if twice else 1)))

    def put_back(found: Expr) -> tuple[Expr, Expr]:
        """Substitute the exponent of the motion in the determinant: s = -beta +- sqrt(beta^2 - c/a)."""
        root = sqrt(found**2 - coefficients[2] / coefficients[0]) if twice else 0
        return _remainder_at(characteristic, letter, -found, root), 0

    outcome = "oscillator" if twice else "growth" if sign_for_all(value) == -1 else "decay"
    return establish(
        DAMPED_RATE,
        scalar(free_letter(f"beta{number}")),
        lambda *_: value,
        {},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"put_back": put_back},
        outcome=outcome,
        phrase_data=PhraseData(points_to={"characteristic": characteristic}, outcome_data=outcome_data(together)),
        key=f"{start}decay{number}",
        kind="angular speed",
        parents=[characteristic],
    )


def _remainder_at(characteristic: Quantity, letter: Symbol, middle: Expr, root: Expr) -> Expr:
    """Return the determinant at s = middle + root, without the square root: the even and the odd powers of the root."""
    mark = Symbol("r_mark")
    value = Poly(_left(characteristic).xreplace({letter: middle + mark}).expand(), mark)
    square = root**2 if root != 0 else Poly(0, mark).as_expr()
    even = sum((c * square ** (n // 2) for (n,), c in value.terms() if n % 2 == 0), start=0 * middle)
    odd = sum((c * square ** (n // 2) for (n,), c in value.terms() if n % 2), start=0 * middle)
    weight = Symbol("w_mark", real=True)
    return even + (weight * odd if root != 0 else 0)


DAMPED_FREQUENCY = Rule(
    "vibrations.damped_frequency",
    source="that of `normal_modes`",
    outcomes={"oscillating": claims.damped(1), "conditional": claims.damped(None), "overdamped": claims.damped(-1)},
    evidence={"motion": CHECK},
    statements=[claims.positive_where_real],
)


def _frequency(
    own: Quantity, characteristic: Quantity, together: Linear, part: Poly, number: str, start: str
) -> Quantity:
    """Frequency of a damped oscillation, sqrt(omega_0^2 - beta^2).
    Outcomes: oscillating, conditional, overdamped (half the difference of the two decay rates).
    Source: that of `normal_modes`.
    """
    a, b, c = (tidied(each) for each in part.all_coeffs())
    square = spread(c / a) - spread(b**2 / (4 * a**2))
    sign = sign_for_all(tidied(4 * a * c - b**2))
    turned = -1 if sign == -1 else 1
    condition = positive(tidied(4 * a * c - b**2)) if sign is None else None
    name = free_letter(f"{'gamma' if turned < 0 else 'omega'}{number}")

    def motion(found: Expr) -> tuple[Expr, Expr]:
        """Substitute e^(-beta t) cos(omega t), or a hyperbolic cosine, in a eta_ddot + b eta_dot + c eta."""
        w = stand_in("w", positive=True)
        course = exp(-own.value * T) * (cos(w * T) if turned > 0 else (exp(w * T) + exp(-w * T)) / 2)
        left = (a * diff(course, T, 2) + b * diff(course, T) + c * course) / exp(-own.value * T)
        return left.expand().subs(w**2, turned * (turned * found**2)), 0

    told = {"condition": (condition, Relation(4 * a * c - b**2, ">", 0))} if condition is not None else {}
    return establish(
        DAMPED_FREQUENCY,
        scalar(name),
        lambda *_: Root(turned * square),
        {},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"motion": motion},
        outcome={1: "oscillating", None: "conditional"}.get(sign, "overdamped"),
        phrase_data=PhraseData(
            formulas=told,
            points_to={"rate": own},
            outcome_data=outcome_data(together, [condition] if condition is not None else []) | {"beta": own.value},
        ),
        key=f"{start}frequency{number}",
        kind="angular speed",
        parents=[own],
    )


def _column(together: Linear, part: Poly) -> MatrixBase | None:
    """Return the amplitudes, if they are the same for both exponents of a factor, and so real."""
    matrix = ImmutableDenseMatrix(together.mass * S**2 + together.turning * S + together.stiffness)
    adjugate, size = matrix.adjugate(), matrix.shape[0]
    modulus = part.as_expr()
    for k in range(size):
        entries = [Poly(adjugate[j, k], S).as_expr() for j in range(size)]
        reduced = [_modulo(entry, modulus) for entry in entries]
        first = next((j for j, entry in enumerate(reduced) if not is_zero(entry)), None)
        if first is None:
            continue
        ratios = [cancel(entry / reduced[first]) for entry in reduced]
        if len(part.all_coeffs()) == 2:
            ratios = [cancel(ratio.subs(S, -part.eval(0) / part.LC())) for ratio in ratios]
        return ImmutableDenseMatrix([tidied(r) for r in ratios]) if not any(r.has(S) for r in ratios) else None
    return None


def _modulo(entry: Expr, modulus: Expr) -> Expr:
    return Poly(entry, S, field=True).rem(Poly(modulus, S, field=True)).as_expr()


DAMPED_SHAPE = Rule(
    "vibrations.damped_shape",
    source="that of `normal_modes`",
    outcomes={
        "in_phase": claims.sign_of_product(1),
        "opposite": claims.sign_of_product(-1),
        "generic": claims.damped_shape_generic,
    },
    evidence={"motion": CHECK},
)


def _shape(
    linear: Sequence[Quantity],
    together: Linear,
    own: Quantity,
    part: Poly,
    column: MatrixBase,
    number: int,
    start: str,
) -> Quantity:
    """Amplitudes of one damped motion.

    Outcomes: in_phase, opposite, generic.
    Source: that of `normal_modes`.
    """

    def moving(found: MatrixBase) -> tuple[MatrixBase, MatrixBase]:
        """Check that the residual of the equations is a multiple of the factor, and so vanishes with it."""
        letter = Symbol("s_trial")
        course = exp(letter * T)
        left = [(with_motion(each, together, [a * course for a in found]) / course).expand() for each in linear]
        rest = [Poly(value, letter, field=True) for value in left]
        factor = Poly(part.as_expr().xreplace({S: letter}), letter, field=True)
        values = [each.rem(factor).as_expr() for each in rest]
        return ImmutableDenseMatrix(values), ImmutableDenseMatrix([0 * value for value in values])

    sign = sign_for_all(tidied(column[0] * column[1])) if len(column) == 2 else None
    return establish(
        DAMPED_SHAPE,
        MatrixSymbol(f"a_{number}", len(column), 1),
        lambda _: Amplitudes(*column),
        {"rate": own},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"motion": moving},
        outcome={1: "in_phase", -1: "opposite"}.get(sign, "generic") if sign is not None else "generic",
        phrase_data=PhraseData(points_to={"linear": linear[0]}, outcome_data=outcome_data(together)),
        key=f"{start}mode_{number}",
        parents=[*linear],
    )
