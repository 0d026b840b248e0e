"""The frequencies and shapes of normal modes, in which all coordinates oscillate with the same frequency.

Linear equations M eta_ddot + K eta = 0 have the solutions eta = a cos(omega t) if det(K - omega^2 M) = 0. A root
omega^2 = 0 belongs to a free motion, and a negative root belongs to a displacement that grows.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from sympy import Add, Expr, I, ImmutableDenseMatrix, Integer, MatrixSymbol, Symbol, cos, diff, exp, pi, sin
from sympy.matrices import MatrixBase

from derive.algebra.amplitudes import Amplitudes, Determinant, expanded_by_rows
from derive.algebra.expressions import Ratio, Relation, Terms, explicit, scalar, stand_in
from derive.algebra.ranges import strict_sign_within
from derive.algebra.squares import with_squares
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.arguments import checked
from derive.mechanics.in_results import in_results
from derive.mechanics.kinematics.coordinates import T
from derive.mechanics.vibrations import claims
from derive.mechanics.vibrations.damped import DampedModes
from derive.mechanics.vibrations.facts import Linear, Mode
from derive.mechanics.vibrations.gyroscopic import TurningModes
from derive.mechanics.vibrations.linear_equations import (
    OF_SIGN,
    Equations,
    letter_of_shapes,
    together_for,
)
from derive.mechanics.vibrations.oscillations import frequency, frequency_squared, told_where_positive
from derive.mechanics.vibrations.uncoupled import UncoupledModes
from derive.solving.linear_systems import CharacteristicRoot, Conservative, Damped, Gyroscopic, root_of
from derive.steps.claims import nowhere_negative
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.known_numbers import have_numbers
from derive.steps.record import defined_as, free_letter
from derive.steps.rule import CHECK, ROUTE, Rule
from derive.steps.signs import sign_known
from derive.steps.step import Level, Quantity, is_zero, require_kind

__all__ = ["beats", "normal_modes", "period"]

ZERO = Integer(0)
LETTERS = ("omega", "Omega")  # symbols of a frequency: the second is used if the first is a given quantity
LETTERS_OF_EXPONENT = ("s", "lambda", "sigma", "p")


def normal_modes(linear: Sequence[Quantity], symbol: str | None = None, key: str = "") -> tuple[Quantity, ...]:
    """Normal modes of M eta_ddot + K eta = 0: eta = a cos(omega t), det(K - omega^2 M) = 0, (K - omega^2 M) a = 0.

    linear   the equations, as `linearised` yields them
    symbol   the symbol of the frequencies, by default omega; for one coordinate by default omega_0; not used with drag
    key      the beginning of the keys; a second set of modes on a page needs a `key` and its own `symbol`

    Keys: characteristic_equation; frequency_1, frequency_2, ...; mode_1, mode_2, ... for the shapes. Without forces
    linear in the rates, the frequencies of coordinates that are coupled to each other are in ascending order, and roots
    without a formula come last. If the order depends on the symbols, it is the order for one set of numbers.
    A coordinate that is not coupled to any other has its own frequency, without a determinant and without a shape. The
    symbol of this frequency is by default omega_x for the coordinate x, and omega_2 for x_2. If no coordinates are
    coupled and all frequencies are equal, the only step is `frequency_1`, by default with the symbol omega_0. If only
    some coordinates are coupled, these have the lower numbers. Each group of coupled coordinates has its own
    determinant; with several groups, the keys are characteristic_equation_1, characteristic_equation_2, ...
    Only the ratios of the entries of a shape have a meaning. For one coordinate without drag the steps are
    `frequency_squared`, for omega_0^2, and `frequency`; only the step `frequency` is returned. With gyroscopic forces,
    which are linear in the rates and do no work, each mode is a motion in time, not a shape. With drag the
    keys are decay_1, decay_2, ... for the decay rates, and frequency_1, frequency_2, ... for the quadratic factors of
    the determinant. If the determinant of the whole system has only one factor, the keys are `decay` and `frequency`.
    Second route: the trial a cos(omega t) is substituted into the equations, which gives the characteristic equation.
    For each frequency with a formula, Rayleigh's quotient of stiffness and mass for one of its shapes is omega^2.
    Check: the motion satisfies the linear equations, the shapes are orthogonal with respect to M, and the sum of all
    omega^2 is the trace of M^-1 K.
    Outcomes: oscillating, growing (omega^2 < 0; kappa is the rate), free (omega = 0), conditional (the sign of omega^2
    depends on the symbols); if two or more modes have the same frequency: oscillating_repeated, growing_repeated,
    free_repeated, conditional_repeated; for a root without a formula: ordered (numbered among all roots), ordered_part
    (numbered among the roots of one factor).
    For a shape: in_phase, opposite, alone (the other coordinate is at rest), generic, uniform (free motion), departing
    (growing), any_of_several (repeated).
    With drag: the characteristic equation has the outcome several (several coordinates) or one (one coordinate).
    Errors: an equation is missing; a driving force acts; the roots have no closed form and cannot be numbered; with
    drag the determinant has a factor of a degree above two; there are too many coordinates or too many symbols.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 6.2 and 6.3.
    """
    together = together_for("normal_modes", linear)
    start = f"{key}_" if key else ""
    if len(linear) == 1 and together.is_conservative:
        letter = _letter_of_frequency(together, None)
        defined = defined_as(root_of(together.of_kind(Conservative).roots[0].value))
        own = defined.symbol.name if defined else f"{letter.name}_0"
        squared = frequency_squared(linear[0], symbol or own, f"{start}frequency_squared")
        return (frequency(squared, key=f"{start}frequency", condition=True),)
    is_alone = [len(block) == 1 and together.part(block).is_conservative for block in together.blocks]
    coupled = [block for block, alone in zip(together.blocks, is_alone, strict=True) if not alone]
    found: list[Quantity] = []
    before, name = 0, free_letter("lambda") if have_numbers(together.stiffness, together.mass) else ""
    for n, block in enumerate(coupled, 1):
        number = f"_{n}" if len(coupled) > 1 else ""
        found += _of_block(linear, block, symbol, start, before, number, name)
        name = "" if any(each.step.outcome.startswith("ordered") for each in found) else name
        before += len(block)
    alone = [i for block, alone in zip(together.blocks, is_alone, strict=True) if alone for i in block]
    if not alone:
        return tuple(found)
    letter = _letter_of_frequency(together, symbol)
    return (*UncoupledModes(linear, alone, letter, start, before).found(), *found)


def _letter_of_frequency(together: Linear, symbol: str | None) -> Symbol:
    given = {s.name for s in together.letters}
    free = next((name for name in LETTERS if name not in given), LETTERS[0])
    letter = scalar(symbol or free)
    if letter.name in given:
        message = f"`normal_modes` would call the frequency {letter}, but {letter} denotes a given quantity"
        other = Spelled('give another symbol, `symbol="Omega"`', "use another symbol")
        raise Rejected(Complaint("letter-clash", message, help=other))
    return letter


def _of_block(
    linear: Sequence[Quantity],
    block: Sequence[int],
    symbol: str | None,
    start: str,
    before: int,
    number: str,
    name: str,
) -> tuple[Quantity, ...]:
    """Return the frequencies and the shapes or motions of coordinates that are coupled only to each other."""
    whole = linear[0].needed(Linear)
    part = whole.part(block)
    if not part.is_gyroscopic:
        given = {s.name for s in whole.letters}
        exponent = scalar(next((name for name in LETTERS_OF_EXPONENT if name not in given), "s_0"))
        return DampedModes(linear, block, part.of_kind(Damped), exponent, start, before, number).found()
    letter = _letter_of_frequency(whole, symbol)
    if not part.is_conservative:
        return TurningModes(linear, block, part.of_kind(Gyroscopic), letter, start, before, number).found()
    system = part.of_kind(Conservative, name=name)
    equations = Equations(linear, block, system, letter, start, before, number)
    characteristic = _characteristic(equations)
    frequencies = [_frequency(equations, characteristic, n) for n in range(len(system.roots))]
    shapes: list[Quantity] = []
    for found in frequencies:
        for column in found.needed(Mode).root.columns:
            shapes.append(_shape(equations, found, column, shapes))
    return (*frequencies, *shapes)


CHARACTERISTIC = Rule(
    "vibrations.characteristic",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, sections 6.2 and 6.3",
    evidence={"trial": ROUTE},
    statements=[claims.coupled_only_to_each_other],
)


def _characteristic(equations: Equations[Conservative]) -> Quantity:
    """Characteristic equation, det(K - omega^2 M) = 0.

    Source: the same as for `normal_modes`.
    """
    letter = equations.letter
    matrix = equations.matrix(I * letter)
    factored = equations.system.written(letter).replace(lambda e: e.is_Add and not e.has(letter), with_squares)

    def by_trial(found: Relation) -> tuple[Relation, Relation]:
        """Compare with the determinant of the equations after substituting eta = a cos(omega t)."""
        return found, Relation(expanded_by_rows(equations.factors_of_amplitudes(cos(letter * T))), "=", 0)

    return establish(
        CHARACTERISTIC,
        None,
        lambda *_: Relation(Determinant(matrix), "=", 0),
        {"omega": letter},
        lines=Lines(put_in=None, arranged=lambda _: Relation(factored, "=", 0)),
        routes={"trial": by_trial},
        phrase_data=PhraseData(
            points_to=equations.named,
            formulas={"factor": (-(letter**2), diff(cos(letter * T), T, 2) / cos(letter * T))},
        ),
        key=f"{equations.start}characteristic_equation{equations.number}",
        parents=equations.linear,
        scope=Scope(coordinates={letter: "angular speed"}),
    )


def _drift(equations: Equations[Conservative], root: CharacteristicRoot) -> dict[str, Any]:
    """Substitute a uniform motion along a mode of frequency zero into the full equations of motion.

    If all residuals vanish, no force acts to any order, and the result contains these residuals; otherwise the result
    is empty.
    """
    if root.sign != 0:
        return {}
    time = stand_in("s")
    left = [value for column in root.columns for value in equations.left_by_drift(column, time)]
    return {"drift": ZERO, "left": tuple(left)} if all(map(is_zero, left)) else {}


MODE_FREQUENCY = Rule(
    "vibrations.mode_frequency",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, sections 6.2 and 6.3",
    outcomes={
        f"{word}{suffix}": claims.modes_frequency(sign, repeated)
        for word, sign in (("oscillating", 1), ("growing", -1), ("free", 0), ("conditional", None))
        for suffix, repeated in (("", False), ("_repeated", True))
    }
    | {"ordered": claims.is_in_order(whole=True), "ordered_part": claims.is_in_order(whole=False)},
    evidence={"put_back": CHECK, "rayleigh": ROUTE, "trace": CHECK},
    statements=[claims.drifts_as_told, claims.positive_where_real],
    named={"drift": claims.nothing_is_left, "root": claims.root_under_the_sign},
)


def _frequency(equations: Equations[Conservative], characteristic: Quantity, n: int) -> Quantity:
    """Frequency of one mode, or its growth rate.

    Outcomes: oscillating, growing, free, conditional, oscillating_repeated, growing_repeated, free_repeated,
    conditional_repeated, ordered, ordered_part.
    Source: the same as for `normal_modes`.
    """
    system, letter = equations.system, equations.letter
    root, number = system.roots[n], equations.before + n + 1
    turned = -1 if root.sign == -1 else 1

    def put_back(found: Expr) -> tuple[Expr, Expr]:
        square = {letter**2: turned * found**2}
        return characteristic.value.left.xreplace(square).subs(square), ZERO

    def rayleigh(found: Expr) -> tuple[Expr, Expr]:
        column = root.columns[0]
        stiffness, mass = ((column.T * each * column)[0] for each in (system.stiffness, system.mass))
        return turned * found**2 * mass, stiffness

    def trace(found: Expr) -> tuple[Expr, Expr]:
        others = Add(*(r.value * r.times for i, r in enumerate(system.roots) if i != n))
        return turned * found**2 * root.times + others, _trace(system.mass, system.stiffness)

    outcome = OF_SIGN[root.sign] + ("_repeated" if root.times > 1 else "")
    routes = {"put_back": put_back, "rayleigh": rayleigh, "trace": trace}
    drift, named = _drift(equations, root), {}
    if not root.has_formula:
        outcome = "ordered" if root.factor.degree == len(equations.block) else "ordered_part"
        named = {"root": scalar(f"{system.name}_1")}  # the sentence introduces the first root
        del routes["rayleigh"]
    return establish(
        MODE_FREQUENCY,
        scalar(f"{'kappa' if root.sign == -1 else letter.name}_{number}"),
        lambda *_: root_of(turned * root.value),
        {},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes=routes,
        outcome=outcome,
        phrase_data=PhraseData(
            points_to={"characteristic": characteristic},
            outcome_data={**equations.judged_by(), "left": drift.pop("left", ())},
            formulas=told_where_positive(root.value) if root.sign is None else {},
            named={**drift, **named},
        ),
        key=f"{equations.start}frequency_{number}",
        kind="angular speed",
        parents=[characteristic],
        facts=[Mode(root, equations.moving)],
    )


@lru_cache(maxsize=8)  # the trace is the same for all frequencies of a system
def _trace(mass: MatrixBase, stiffness: MatrixBase) -> Expr:
    """Return the trace of M^-1 K: the sum of K_ij times the cofactor of M_ij, divided by det M."""
    size = range(mass.shape[0])
    cofactors = (stiffness[i, j] * mass.cofactor(i, j) for i in size for j in size if stiffness[i, j] != 0)
    return tidied(Add(*cofactors) / mass.det())


MODE_SHAPE = Rule(
    "vibrations.mode_shape",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, sections 6.2 and 6.3",
    outcomes={
        "in_phase": claims.of_pair(same=True),
        "opposite": claims.of_pair(same=False),
        "alone": claims.alone,
        "generic": claims.mode_shape_generic,
        "uniform": claims.mode_shape_uniform,
        "departing": claims.mode_shape_departing,
        "any_of_several": claims.repeated,
    },
    evidence={"motion": CHECK, "orthogonal": CHECK},
    statements=[claims.drifts_as_told],
    named={"moving": claims.moves_alone, "drift": claims.nothing_is_left},
)


def _shape(
    equations: Equations[Conservative], frequency: Quantity, column: MatrixBase, before: Sequence[Quantity]
) -> Quantity:
    """Amplitudes of one mode.

    Outcomes: in_phase, opposite, alone, generic, uniform, departing, any_of_several.
    Source: the same as for `normal_modes`.
    """
    linear, root, n = equations.linear, frequency.needed(Mode).root, equations.before + len(before) + 1
    drift = _drift(equations, root)

    def moving(found: MatrixBase) -> tuple[MatrixBase, MatrixBase]:
        """Check that the motion satisfies the linear equations at all times."""
        w = stand_in("w", positive=True)
        course = {1: cos(w * T), None: cos(w * T), 0: 1 + T, -1: exp(w * T)}[root.sign]
        square = {w**2: -root.value if root.sign == -1 else root.value}
        left = [value / course for value in equations.with_motion([a * course for a in found])]
        values = [value.expand().subs(square) if root.sign != 0 else value for value in left]
        return ImmutableDenseMatrix(values), ImmutableDenseMatrix([ZERO] * len(values))

    def across(found: MatrixBase) -> tuple[Expr, Expr]:
        marks = [stand_in(f"u_{i}") for i in range(len(before))]
        products = [(other.value.T * equations.system.mass * found)[0] for other in before]
        return Add(*(mark * product for mark, product in zip(marks, products, strict=True))), ZERO

    entries = zip(equations.together.displacements, column, strict=True)
    moved = next(s.symbol for s, entry in entries if not is_zero(entry))
    row, ratio = _ratio(equations, frequency, column)
    return establish(
        MODE_SHAPE,
        MatrixSymbol(f"{letter_of_shapes(column.free_symbols)}_{n}", len(column), 1),
        lambda _: Amplitudes(*column),
        {"frequency": frequency},
        lines=Lines(put_in=None, result=False, arranged=explicit),
        routes={"motion": moving, "orthogonal": across},
        outcome=_shape_outcome(root, column),
        phrase_data=PhraseData(
            points_to=row or {"linear": linear[0]},
            formulas=ratio,
            outcome_data={
                "squared": root.value,
                **equations.judged_by(),
                "left": drift.pop("left", ()),
                "displacements": equations.moving,
            },
            named={"moving": moved, **drift},
        ),
        key=f"{equations.start}mode_{n}",
        parents=[*linear, *before],
    )


def _ratio(
    equations: Equations[Conservative], frequency: Quantity, column: MatrixBase
) -> tuple[dict[str, Quantity], dict[str, tuple[Relation, Relation]]]:
    """Return the equation that determines the ratio of two amplitudes, and this ratio in terms of the frequency.

    The result is empty for more than two coordinates, for a repeated or free root, and for a coordinate at rest.
    """
    root = frequency.needed(Mode).root
    if len(column) != 2 or root.times > 1 or root.sign == 0 or any(map(is_zero, column)):
        return {}, {}
    letter, square = equations.letter, frequency.symbol**2
    here = {letter**2: -square if root.sign == -1 else square}
    rows = equations.matrix(I * letter)
    # The coefficient in the denominator must not vanish for this mode.
    usable = [i for i in (0, 1) if not is_zero(tidied(rows[i, 1].subs(letter**2, root.value)))]
    if not usable:
        return {}, {}
    i = min(usable, key=lambda i: (rows[i, 0] / rows[i, 1]).count_ops())
    one, other = equations.moving
    again = equations.factors_of_amplitudes(cos(letter * T))
    given = tidied(-rows[i, 0].xreplace(here) / rows[i, 1].xreplace(here))
    second = tidied(-again[i, 0].expand().xreplace(here) / again[i, 1].expand().xreplace(here))
    name = Ratio(other, one)
    return {"row": equations.linear[i]}, {"ratio": (Relation(name, "=", given), Relation(name, "=", second))}


def _shape_outcome(root: CharacteristicRoot, column: MatrixBase) -> str:
    if root.times > 1:
        return "any_of_several"
    if root.sign in (0, -1):
        return "uniform" if root.sign == 0 else "departing"
    return _pair(*column) if len(column) == 2 else "generic"


def _pair(first: Expr, second: Expr) -> str:
    if is_zero(first) or is_zero(second):
        return "alone"
    ratio = tidied(second / first)
    return {1: "in_phase", -1: "opposite", None: "generic"}[strict_sign_within(ratio)]


PERIOD = Rule(
    "vibrations.period",
    source="Taylor, *Classical Mechanics*, section 5.2",
    evidence={"once_round": CHECK},
    statements=[nowhere_negative],
)


def period(of: Quantity, symbol: str | None = None, key: str = "period") -> Quantity:
    """Period of an oscillation, tau = 2 pi/omega.

    of   the angular frequency of the oscillation, 1/s

    Check: after one period, and not after half a period, cos(omega t) and its rate have the same values again.
    Errors: `of` is not the angular frequency of an oscillation.
    Source: Taylor, *Classical Mechanics*, section 5.2.
    """
    require_kind("period", "of", of, "angular speed")
    mode = of.fact(Mode)
    if of.step.outcome in {"growing", "free", "unstable", "neutral"} or mode is not None and mode.root.sign in (-1, 0):
        raise Rejected(Complaint("no-oscillation", f"`{of.key}` is not the frequency of an oscillation"))

    def same_again(found: Expr) -> tuple[Expr, Expr]:
        """Check the phase after one period: its cosine is 1, its sine 0, and the cosine of half the phase -1."""
        turn = tidied(of.value * found)
        u, v = (stand_in(name) for name in ("u", "v"))
        return cos(turn) + u * sin(turn) + v * cos(turn / 2), 1 - v

    return establish(
        PERIOD,
        scalar(symbol or free_letter("tau")),
        lambda omega: Ratio(2 * pi, omega),
        {"frequency": of},
        lines=Lines(put_in=None, arranged=explicit),
        routes={"once_round": same_again},
        key=key,
        kind="time",
    )


BEATS = Rule(
    "vibrations.beats",
    source="Taylor, *Classical Mechanics*, section 11.3; French, *Vibrations and Waves*, chapter 2",
    evidence={"product": CHECK},
    statements=[claims.somewhere_positive],
)


def beats(slow: Quantity, fast: Quantity, symbol: str = "omega_beat", key: str = "beats") -> Quantity:
    """Frequency of the beats of two oscillations of the same amplitude, omega_beat = omega_2 - omega_1.

    slow, fast   the angular frequencies of two modes, 1/s; in any order if the symbols determine the greater one

    The sum of the oscillations is cos(omega_1 t) + cos(omega_2 t) = 2 cos((omega_2 - omega_1) t/2)
    cos((omega_1 + omega_2) t/2). The amplitude of this product rises and falls with the frequency omega_2 - omega_1.
    Check: the sum of the two oscillations is this product, at any time.
    Errors: a frequency is zero, or the two are equal; an input is not an angular frequency.
    Source: Taylor, *Classical Mechanics*, section 11.3; French, *Vibrations and Waves*, chapter 2.
    """
    for role, each in (("slow", slow), ("fast", fast)):
        require_kind("beats", role, each, "angular speed")
    if sign_known(explicit(fast.value) ** 2 - explicit(slow.value) ** 2) == -1:
        slow, fast = fast, slow
    if 0 in (slow.value, fast.value) or is_zero(fast.value - slow.value):
        raise Rejected(
            Complaint(
                "no-beats",
                f"oscillations with the frequencies `{slow.key}` and `{fast.key}` have no beats",
                help="give two different frequencies other than 0",
            )
        )

    def product(found: Expr) -> tuple[Expr, Expr]:
        middle = (slow.value + fast.value) / 2
        return cos(slow.value * T) + cos(fast.value * T), 2 * cos(found * T / 2) * cos(middle * T)

    return establish(
        BEATS,
        scalar(symbol),
        lambda one, other: Terms(other, -one),
        {"slow": slow, "fast": fast},
        lines=Lines(put_in=Level.STANDARD, arranged=explicit),
        routes={"product": product},
        key=key,
        kind="angular speed",
    )


@in_results(
    "beats",
    "the frequency of the beats, from two frequencies",
    frequencies="beats: two frequencies, the lower first",
    symbol="symbol",
)
def _in_results(frequencies: Sequence[Quantity], key: str, symbol: str = "omega_beat") -> Quantity:
    if len(frequencies) != 2:
        message = f"`beats` needs two frequencies, but {len(frequencies)} are given"
        raise Rejected(Complaint("wrong-argument", message))
    slow, fast = frequencies
    return checked(beats)(slow, fast, symbol, key)
