"""The frequencies of coordinates that are not coupled to any other: each of these coordinates moves by itself.

The equation m eta_ddot + k eta = 0 of such a coordinate contains no other coordinate, and the coordinate occurs in no
other equation. So omega^2 = k/m, without a determinant.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from sympy import Expr, ImmutableDenseMatrix, Integer, Symbol, cos, exp
from sympy.matrices import MatrixBase

from derive.algebra.expressions import explicit, scalar, stand_in
from derive.mechanics.kinematics.coordinates import T
from derive.mechanics.vibrations import claims
from derive.mechanics.vibrations.facts import Linear, Mode
from derive.mechanics.vibrations.linear_equations import OF_SIGN, left_by_drift, with_motion
from derive.mechanics.vibrations.oscillations import told_where_positive
from derive.solving.linear_systems import CharacteristicRoot, Conservative, in_order, root_of
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.record import defined_as, given_letters, result_called
from derive.steps.rule import CHECK, Rule
from derive.steps.step import Quantity, is_zero, same_value

ZERO = Integer(0)

UNCOUPLED_FREQUENCY = Rule(
    "vibrations.uncoupled_frequency",
    source="Taylor, *Classical Mechanics*, section 5.3",
    outcomes={word: claims.moves_by_itself(sign) for sign, word in OF_SIGN.items()},
    evidence={"motion": CHECK},
    statements=[claims.uncoupled_as_told, claims.positive_where_real, claims.drifts_as_told],
    named={"q": claims.is_coordinate_of_the_equation, "drift": claims.nothing_is_left},
)


@dataclass(frozen=True)
class UncoupledModes:
    """The frequencies, or the growth rates, of coordinates that are not coupled to any other.

    linear   the equations of the whole system
    alone    the indices of these coordinates
    letter   the symbol of a frequency, without its index
    start    the beginning of all keys
    before   the count of the modes of coupled coordinates, which come first in the numbering
    """

    linear: Sequence[Quantity]
    alone: Sequence[int]
    letter: Symbol
    start: str
    before: int

    def found(self) -> list[Quantity]:
        """Return a frequency for each of these coordinates. If no coordinates of the system are coupled, and all
        frequencies are equal, return a single frequency."""
        whole = self.linear[0].needed(Linear)
        roots = {i: whole.part((i,)).of_kind(Conservative).roots[0] for i in self.alone}
        order = sorted(self.alone, key=lambda i: in_order(roots[i]))
        first = roots[order[0]]
        is_all = len(self.alone) == len(self.linear)
        if is_all and all(is_zero(root.value - first.value) for root in roots.values()):
            return [_frequency(self, self.alone, first, 1, "all")]
        words = ["none" if n == 0 else "told" for n in range(len(order))] if is_all else ["others"] * len(order)
        numbers = range(self.before + 1, self.before + len(order) + 1)
        return [_frequency(self, (i,), roots[i], n, word) for i, n, word in zip(order, numbers, words, strict=True)]


def _frequency(
    modes: UncoupledModes, own: Sequence[int], root: CharacteristicRoot, number: int, coupling: str
) -> Quantity:
    """Frequency of coordinates that are not coupled to any other, omega = sqrt(k/m), or their growth rate.

    own        the indices of the coordinates with this frequency
    coupling   a word of the sentence: none (no equations are coupled), told (an earlier sentence states that none are
               coupled), all (no equations are coupled, and all coordinates have the same frequency), others (some
               equations are coupled)

    Check: the motion of each coordinate by itself satisfies all linear equations.
    Outcomes: oscillating, growing, free, conditional.
    Source: Taylor, *Classical Mechanics*, section 5.3.
    """
    linear, letter = modes.linear, modes.letter
    whole = linear[0].needed(Linear)
    turned = -1 if root.sign == -1 else 1
    value = root_of(turned * root.value)
    defined = defined_as(value)
    coordinates = [whole.place[i][0].symbol for i in own]
    columns = [whole.of_all((whole.moving[i],), ImmutableDenseMatrix([1])) for i in own]

    def motion(found: Expr) -> tuple[MatrixBase, MatrixBase]:
        w, marks = stand_in("w", positive=True), [stand_in(f"u_{i}") for i in own]
        course = {0: 1 + T, -1: exp(w * T)}.get(root.sign if root.sign is not None else 1, cos(w * T))
        eta = sum(
            (mark * column for mark, column in zip(marks, columns, strict=True)),
            ImmutableDenseMatrix.zeros(len(linear), 1),
        )
        left = [(each / course).expand() for each in with_motion(linear, whole, [a * course for a in eta])]
        values = [each.subs(w**2, explicit(found) ** 2) for each in left]
        return ImmutableDenseMatrix(values), ImmutableDenseMatrix([ZERO] * len(values))

    left = _left_by_drift(linear, columns) if root.sign == 0 else ()
    pointed = {"equation": linear[own[0]]}
    if coupling == "all":
        pointed = {f"equation_{n}": linear[i] for n, i in enumerate(own, 1)}
    return establish(
        UNCOUPLED_FREQUENCY,
        defined.symbol if defined else _symbol(value, "kappa" if root.sign == -1 else letter.name, coordinates, number),
        lambda *_: value,
        {},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"motion": motion},
        outcome=OF_SIGN[root.sign],
        phrase_data=PhraseData(
            words={"coupling": coupling},
            points_to=pointed,
            formulas=told_where_positive(root.value) if root.sign is None else {},
            named={"q": coordinates[0], **({"drift": ZERO} if left else {})},
            outcome_data={
                "own": tuple(own),
                "coordinates": tuple(q.symbol for q, _ in whole.place),
                "stiffness": whole.stiffness,
                "turning": whole.turning,
                "mass": whole.mass,
                "left": left,
                **({} if whole.exists is None else {"exists": whole.exists}),
            },
        ),
        key=f"{modes.start}frequency_{number}",
        kind="angular speed",
        parents=[*linear, *([defined] if defined else [])],
        facts=[Mode(CharacteristicRoot(root.value, root.sign, root.factor, tuple(columns)), whole.moving)],
    )


def _left_by_drift(linear: Sequence[Quantity], columns: Sequence[MatrixBase]) -> tuple[Expr, ...]:
    """Return the residuals of the full equations of motion for uniform motions of the coordinates. Return an empty
    tuple if one of these residuals does not vanish."""
    left = [value for column in columns for value in left_by_drift(linear, column, stand_in("s"))]
    return tuple(left) if all(map(is_zero, left)) else ()


def _symbol(value: Expr, letter: str, coordinates: Sequence[Symbol], number: int) -> Symbol:
    """Return the symbol of a frequency: omega_x for the coordinate x, omega_2 for x_2, and omega_0 for several
    coordinates. If this symbol has another meaning, the index is the number of the frequency."""
    index = "0" if len(coordinates) > 1 else coordinates[0].name.rpartition("_")[2]
    for name in (f"{letter}_{index}", f"{letter}_{number}"):
        known = result_called(name)
        if name not in given_letters() and (known is None or same_value(known.value, value)):
            return scalar(name)
    return scalar(f"{letter}_{number}")
