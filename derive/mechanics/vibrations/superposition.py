"""The motion of coupled coordinates from their initial values, as a sum of normal modes.

The shapes are orthogonal with respect to M. So the motion along each shape a is the motion of one oscillator. The mass
of this oscillator is a.M a, its stiffness is a.K a and, if drag does not mix the modes, its drag is a.C a. The initial
value of the oscillator is a.M eta(0)/(a.M a).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, cos, cosh, diff, factor_terms, sin, sinh
from sympy.matrices import MatrixBase

from derive.algebra.expressions import TIME, Relation, Terms, explicit
from derive.algebra.length import length
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.arguments import checked
from derive.mechanics.in_results import Value, Values, in_results
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.mechanics.vibrations import claims, linear_motion
from derive.mechanics.vibrations.facts import Linear, Mode
from derive.mechanics.vibrations.general_motion import LinearCoefficients
from derive.mechanics.vibrations.linear_equations import with_motion
from derive.solving.linear_systems import Conservative, in_order
from derive.steps.claims import lasts, vanishes
from derive.steps.derivation import with_ancestors
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.record import require_constant
from derive.steps.rule import CHECK, Rule
from derive.steps.step import Form, Quantity, approximations_among, is_zero, value_behind

__all__ = ["motions_by_modes"]

ZERO = Integer(0)


@dataclass(frozen=True)
class ExcitedMode:
    """One mode in a motion: the shape, the initial values of the oscillator along the shape, and the frequency.

    column      the shape of the mode: one amplitude for each coordinate
    first       the initial displacement of the oscillator
    initial     the initial rate of this displacement
    frequency   the step that derives the frequency; None with drag
    sign        the sign of omega^2; None if it is unknown
    damped      the motion of the oscillator with drag; not used without drag
    """

    column: MatrixBase
    first: Expr
    initial: Expr
    frequency: Quantity | None
    sign: int | None = 1
    damped: Expr = ZERO

    @property
    def is_there(self) -> bool:
        return bool(self.first != 0 or self.initial != 0)

    def course(self, w: Expr) -> Expr:
        """Return the motion of the oscillator: cosine and sine, or the functions for a free, growing or damped mode."""
        if self.frequency is None:
            return self.damped
        if self.sign == 0:
            return self.first + self.initial * TIME
        even, odd = (cosh, sinh) if self.sign == -1 else (cos, sin)
        return self.first * even(w * TIME) + self.initial / w * odd(w * TIME)


def motions_by_modes(
    modes: Sequence[Quantity],
    start: Mapping[Coordinate, Expr],
    start_rate: Mapping[Coordinate, Expr] | None = None,
    case: str | None = None,
    key: str = "",
) -> tuple[Quantity, ...]:
    """Motion of all coordinates from their start, eta(t) = sum of a_n (A_n cos(omega_n t) + B_n sin(omega_n t)).

    modes        the modes, as `normal_modes` yields them
    start        the values of the displacements at t = 0; a displacement that is not listed is 0
    start_rate   the rates of the displacements at t = 0; a rate that is not listed is 0
    case         `underdamped`, `critically_damped` or `overdamped`, if the symbols leave the case open

    The formula is for modes that oscillate without drag; other modes contribute the motions of their oscillators.
    Keys: of_t_x for a coordinate x; a given `key` replaces of_t.
    Check: the motion is substituted back into all linear equations; the motion has the given values and rates at t = 0.
    Outcomes: generic, zero (this coordinate does not move).
    Errors: drag mixes the modes; gyroscopic forces act; an initial value is not constant, or does not belong to a
    displacement.
    Source: Taylor, *Classical Mechanics*, sections 11.2 and 11.3; Goldstein, Poole, Safko, *Classical Mechanics*,
    section 6.3.
    """
    equations = _equations(modes)
    together = equations[0].needed(Linear)
    first, initial = _start(start, together), _start(start_rate or {}, together)
    excited = [s for s in _excited(modes, together, first, initial, case) if s.is_there]
    motion = [tidied_motion(Add(*(_part(s, i) for s in excited))) for i in range(len(first))]
    equations += approximations_among(*start.values(), *(start_rate or {}).values())
    return tuple(_motion(equations, together, excited, motion, i, (first, initial), key) for i in range(len(first)))


def _equations(modes: Sequence[Quantity]) -> list[Quantity]:
    found = [q for q in with_ancestors(tuple(modes)).values() if q.fact(Linear) is not None]
    if not found:
        raise Rejected(Complaint("wrong-argument", "`motions_by_modes` needs the modes that `normal_modes` yields"))
    together = found[-1].needed(Linear)
    return [q for q in found if q.fact(Linear) == together]


def _check_displaced(given: Mapping[Coordinate, Expr], together: Linear) -> None:
    for q in given:
        if all(s.symbol != q.symbol for s in together.displacements):
            names = ", ".join(s.symbol.name for s in together.displacements)
            message = f"`motions_by_modes` needs values of the displacements {names}, but {q.symbol.name} is not one"
            raise Rejected(Complaint("wrong-argument", message))


def _start(given: Mapping[Coordinate, Expr], together: Linear) -> list[Expr]:
    _check_displaced(given, together)
    for q, value in given.items():
        require_constant("motions_by_modes", f"start of {q.symbol.name}", value)
    by_name = {q.symbol: explicit(value_behind(value)) for q, value in given.items()}
    return [by_name.get(s.symbol, ZERO) for s in together.displacements]


def _excited(
    modes: Sequence[Quantity], together: Linear, first: Sequence[Expr], initial: Sequence[Expr], case: str | None
) -> list[ExcitedMode]:
    M, C = together.mass, together.turning
    parts = map(together.part, together.blocks)
    roots = [(part, root) for part in parts for root in part.of_kind(Conservative).roots]
    roots.sort(key=lambda each: in_order(each[1]))
    columns = [together.of_all(part.moving, column) for part, root in roots for column in root.columns]
    known = [(q, mode) for q in modes if (mode := q.fact(Mode)) is not None]
    frequencies = {together.of_all(m.moving, c): (q, m.root.sign) for q, m in known for c in m.root.columns}
    if len(columns) == 1:
        frequencies = {columns[0]: (modes[0], roots[0][1].sign)}
    if not is_zero(C) and (is_zero(C + C.T) or not _separates(C, columns)):
        message = "forces that depend on the rates mix the modes, so the shapes without these forces do not apply"
        help_line = (
            "drag does not mix the modes if it is proportional to the masses or to the springs; "
            "gyroscopic forces always mix them"
        )
        raise Rejected(Complaint("no-closed-form", message, help=help_line))
    found = []
    for column in columns:
        mass = (column.T * M * column)[0]
        own = [
            tidied((column.T * M * ImmutableDenseMatrix(values))[0] / mass)
            for values in ([[v] for v in first], [[v] for v in initial])
        ]
        if is_zero(C):
            frequency, sign = frequencies[column]
            found.append(ExcitedMode(column, own[0], own[1], frequency, sign))
        elif any(own):
            found.append(ExcitedMode(column, own[0], own[1], None, 1, _damped(together, column, own, case)))
    return found


def _separates(drag: MatrixBase, columns: Sequence[MatrixBase]) -> bool:
    pairs = ((one, other) for i, one in enumerate(columns) for other in columns[:i])
    return drag == drag.T and all(is_zero((one.T * drag * other)[0]) for one, other in pairs)


def _damped(together: Linear, column: MatrixBase, own: Sequence[Expr], case: str | None) -> Expr:
    a, b, c = (tidied((column.T * each * column)[0]) for each in (together.mass, together.turning, together.stiffness))
    return linear_motion.free_motion(LinearCoefficients(a, b, c, ZERO), own[0], own[1], case)


def _part(mode: ExcitedMode, i: int) -> Expr:
    w = ZERO if mode.frequency is None else explicit(mode.frequency.value)
    return mode.column[i] * mode.course(w)


def tidied_motion(motion: Expr) -> Expr:
    forms = (motion, factor_terms(motion.expand()), factor_terms(motion))
    return min(forms, key=length)


SUPERPOSITION = Rule(
    "vibrations.superposition",
    source=(
        "Taylor, *Classical Mechanics*, sections 11.2 and 11.3; Goldstein, Poole, Safko, *Classical "
        "Mechanics*, section 6.3"
    ),
    outcomes={"generic": lasts, "zero": vanishes},
    evidence={"put_back": CHECK, "start": CHECK},
    statements=[claims.starts_as_all_are_told],
)


def _motion(
    equations: Sequence[Quantity],
    together: Linear,
    excited: Sequence[ExcitedMode],
    motion: Sequence[Expr],
    i: int,
    started: tuple[Sequence[Expr], Sequence[Expr]],
    key: str,
) -> Quantity:
    """Coordinate as a function of the time.

    Outcomes: generic, zero.
    Source: the same as for `motions_by_modes`.
    """
    q = together.displacements[i]
    own = [s for s in excited if not is_zero(s.column[i])]
    named = {s.frequency.key: s.frequency for s in own if s.frequency is not None and s.sign != 0}

    def law(*letters: Expr) -> Expr:
        by_key = dict(zip(named, letters, strict=True))
        parts = [
            s.column[i] * s.course(by_key.get(s.frequency.key, ZERO) if s.frequency is not None else ZERO) for s in own
        ]
        terms = [term for part in parts for term in Add.make_args(part.expand() if named else part)]
        return Terms(*terms) if len(terms) > 1 else terms[0] if terms else ZERO

    def put_back(found: Expr) -> tuple[Any, Any]:
        whole = [found if j == i else value for j, value in enumerate(motion)]
        left = with_motion([each for each in equations if each.fact(Linear) is not None], together, whole)
        return ImmutableDenseMatrix([value.expand() for value in left]), ImmutableDenseMatrix([ZERO for _ in left])

    def from_the_start(found: Expr) -> tuple[Any, Any]:
        at = [found.subs(TIME, 0), diff(found, TIME).subs(TIME, 0)]
        return ImmutableDenseMatrix(at), ImmutableDenseMatrix([each[i] for each in started])

    product = _as_product(own, i)
    told = {**_told(together, started), "coordinate": (q.symbol, q.symbol)}
    return establish(
        SUPERPOSITION,
        q.symbol,
        law,
        named,
        lines=Lines(
            put_in=None,
            result=not named,
            between=[Form(product, "product")] if product is not None else [],
            arranged=lambda _: motion[i],
        ),
        routes={"put_back": put_back, "start": from_the_start},
        outcome="zero" if is_zero(motion[i]) else "generic",
        phrase_data=PhraseData(
            formulas=told,
            words={"seen": "all_told" if all(value != 0 for _, value in _starts(together, started)) else "others_zero"},
        ),
        key=f"{key or 'of_t'}_{q.symbol.name}",
        kind=q.kind,
        parents=list(equations),
    )


def _told(together: Linear, started: tuple[Sequence[Expr], Sequence[Expr]]) -> dict[str, tuple[Any, Any]]:
    pairs = [(s, value) for s, value in _starts(together, started) if value != 0]
    return {f"start_{n}": (Relation(s, "=", value), Relation(value, "=", s)) for n, (s, value) in enumerate(pairs, 1)}


def _starts(together: Linear, started: tuple[Sequence[Expr], Sequence[Expr]]) -> list[tuple[Expr, Expr]]:
    letters = [*(s.symbol for s in together.displacements), *(s.rate for s in together.displacements)]
    return list(zip(letters, [*started[0], *started[1]], strict=True))


def _as_product(excited: Sequence[ExcitedMode], i: int) -> Expr | None:
    """Write A cos(w_1 t) + A cos(w_2 t) as 2 A cos((w_2 - w_1) t/2) cos((w_1 + w_2) t/2), which shows the beats.

    Write A cos(w_1 t) - A cos(w_2 t) as 2 A sin((w_2 - w_1) t/2) sin((w_1 + w_2) t/2). In both products the frequencies
    are symbols. Return None for any other sum.
    """
    plain = [s for s in excited if s.frequency is not None and s.sign != 0 and s.sign != -1 and s.initial == 0]
    if len(excited) != 2 or len(plain) != 2:
        return None
    one, other = (tidied(s.column[i] * s.first) for s in plain)
    slow, fast = (s.frequency.symbol for s in plain if s.frequency is not None)
    half = (fast - slow) * TIME / 2, (slow + fast) * TIME / 2
    if is_zero(one - other):
        return 2 * one * cos(half[0]) * cos(half[1])
    return 2 * one * sin(half[0]) * sin(half[1]) if is_zero(one + other) else None


NONE: Mapping[str, Expr] = MappingProxyType({})


@in_results(
    "solution",
    "the motion for a linear equation; for `normal_modes` the motions of all coordinates: if the result is called "
    "`both`, `both_x_1` is the motion of `x_1`",
    one_of=("start", "values"),
    excludes=(("values", "for"), ("values", "start"), ("values", "start_rate")),
    motions="solution: a linear equation of motion, or `normal_modes`",
    q="for: a coordinate",
    start="start",
    start_rate="start_rate: 0 by default",
    values=(
        "values: from `normal_modes`, in place of `for`, `start` and `start_rate`: `{x_1: A, x_2_dot: v}`, "
        "all other values zero"
    ),
    case="case",
)
def _in_results(
    motions: Sequence[Quantity],
    key: str,
    coordinates: Mapping[str, Coordinate],
    q: Coordinate | None = None,
    start: Value = None,
    start_rate: Value = None,
    values: Values = NONE,
    case: str | None = None,
) -> Quantity | tuple[Quantity, ...]:
    """Return, from initial values, the motion of one coordinate, or all motions as sums of modes."""
    if start is None and len(motions) > 1:
        return checked(motions_by_modes)(motions, *_start_by_name(values, coordinates), case, key)
    for argument, name, value in (("q", "for", q), ("start", "start", start)):
        if value is None:
            message = f"`solution` of one equation needs `{name}`"
            raise Rejected(Complaint("missing-key", message, argument=argument))
    if len(motions) != 1:
        message = f"`solution` needs one equation, but {len(motions)} are given"
        raise Rejected(Complaint("wrong-argument", message))
    assert q is not None
    return checked(linear_motion.solution)(motions[0], q, start, start_rate, case, key)


def _start_by_name(
    values: Mapping[str, Expr], coordinates: Mapping[str, Coordinate]
) -> tuple[dict[Coordinate, Expr], dict[Coordinate, Expr]]:
    """Return the initial values of the coordinates and the initial values of the rates."""
    places = {coordinates[name]: value for name, value in values.items() if name in coordinates}
    rates = {q: value for name, value in values.items() for q in coordinates.values() if q.rate.name == name}
    known = {*(q.symbol.name for q in places), *(q.rate.name for q in rates)}
    strange = next((name for name in values if name not in known), None)
    if strange is not None:
        message = f"the start is given by values of coordinates and rates, but `{strange}` is neither"
        raise Rejected(Complaint("no-such-coordinate", message, argument=f"values:{strange}"))
    return places, rates
