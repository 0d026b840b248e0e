"""Solve linear equations of motion with constant coefficients, a q_ddot + b q_dot + c q = f(t), for initial values.

The roots of a s^2 + b s + c give the free motion. The driving force, a sum of powers of t, exponentials, sines and
cosines, gives a particular motion. The solution is substituted back into the equation; the initial values make this
solution unique.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sympy import (
    Add,
    Dummy,
    Expr,
    ImmutableDenseMatrix,
    Integer,
    Matrix,
    Mul,
    Pow,
    cos,
    cosh,
    diff,
    exp,
    expand,
    factor_terms,
    log,
    sin,
    sinh,
)
from sympy.simplify.fu import TR8

from derive.algebra.collect import by_terms
from derive.algebra.derivatives import derivative
from derive.algebra.expressions import TIME, Relation, Terms, depends_on_time, explicit, prescribed_in, rate, stand_in
from derive.algebra.length import length
from derive.algebra.natural import compared
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.mechanics.vibrations import claims
from derive.mechanics.vibrations.general_motion import (
    LinearCoefficients,
    Sought,
    basis_of,
    general_motion,
    put_back,
)
from derive.mechanics.vibrations.oscillator_constants import oscillator_constants
from derive.solving.divisors import check_no_resonance, different_from_zero
from derive.solving.presentation import presented
from derive.solving.relations import conditions_told
from derive.solving.unknowns import coordinates_of, is_number, residual_of
from derive.steps.claims import as_told
from derive.steps.establish import Lines, PhraseData, establish
from derive.steps.record import assume, require_constant
from derive.steps.rule import CHECK, Rule
from derive.steps.signs import sign_known
from derive.steps.step import Level, Quantity, approximations_among, is_zero, value_behind

__all__ = ["solution"]

ZERO, ONE = Integer(0), Integer(1)
CASES = {"underdamped": -1, "critically_damped": 0, "overdamped": 1}  # case -> sign of b^2 - 4 a c


SOLUTION = Rule(
    "vibrations.solution",
    source="Taylor, *Classical Mechanics*, sections 5.4 to 5.6",
    outcomes={
        word: claims.free_motion(word)
        for word in (
            "oscillates",
            "underdamped",
            "critically_damped",
            "overdamped",
            "runs_away",
            "uniform",
            "relaxes",
            "slows",
            "accumulates",
        )
    },
    evidence={"put_back": CHECK, "start": CHECK},
    statements=[claims.starts_as_told, claims.constants_as_told],
    named={"start": as_told(claims.starts_as_told), "start_rate": as_told(claims.starts_as_told)},
)


def solution(
    equation: Quantity,
    q: Coordinate,
    start: Expr | Quantity,
    start_rate: Expr | Quantity | None = None,
    case: str | None = None,
    key: str | None = None,
) -> Quantity:
    """Motion q(t) that satisfies a linear equation with constant coefficients and initial values. If a s^2 + b s + c
    has two different roots s_1 and s_2, then q = C_1 e^(s_1 t) + C_2 e^(s_2 t) + a particular motion.

    equation     a q_ddot + b q_dot + c q = f(t), where f is a sum of powers of t, exponentials, sines and cosines. The
                 equation may be of first order, a = 0, or solved for q_ddot or q_dot
    q            the coordinate of the equation of motion
    start        the value of q at t = 0
    start_rate   the rate of q at t = 0, for an equation of second order; 0 by default
    case         `underdamped`, `critically_damped` or `overdamped`, if the symbols leave the case open

    The steps that lead to the motion are the characteristic equation, its roots and the general motion with two
    constants; for an oscillation without damping, only the general motion. An equation of first order or with c = 0 has
    no such steps.
    Second route: the trial e^(s t) is substituted into the equation, which gives the characteristic equation. Check:
    the motion is substituted back into the equation, and has the given value and rate at t = 0.
    Outcomes: oscillates (without damping), underdamped, critically_damped, overdamped, runs_away (a free motion grows,
    for example because c/a is negative), uniform (no force depends on position or rate), slows (no force depends on
    position: the rate decays), relaxes (first order), accumulates (first order, without q).
    Errors: the equation is not linear with constant coefficients; the case depends on the symbols and `case` is not
    given, or the case is known and differs from `case`; the driving force f(t) has a different form.
    Source: Taylor, *Classical Mechanics*, sections 5.4 to 5.6.
    """
    linear = linear_equation(equation, q)
    for role, value in (("start", start), ("start_rate", start_rate)):
        if value is not None:
            require_constant("solution", role, value)
    first = explicit(value_behind(start))
    initial = None if linear.order == 1 else explicit(value_behind(ZERO if start_rate is None else start_rate))
    if linear.order == 1 and start_rate is not None:
        message = (
            f"`solution`: `{equation.key}` is of first order, so the rate of {q.symbol.name} "
            "at the start follows from the equation"
        )
        raise Rejected(Complaint("wrong-argument", message))
    sort, condition = _sort(linear, case, equation)
    basis = basis_of(linear, sort)
    particular = _particular(linear, equation)
    values = _constants(basis, particular, first, initial)
    free = _free(basis, values, linear, sort)
    found = _joined(free, particular)
    found = _by_powers(found) if sort == "uniform" else found  # such as v t - g t^2/2
    excluded, proposals = _excluded(linear), []
    if linear.order == 2:
        proposals = list(oscillator_constants(equation, q.symbol, linear.a, linear.b, linear.c))
    sought = Sought(equation, q, linear, sort, condition, excluded, particular, proposals)
    general = general_motion(sought)

    def from_the_start(motion: Expr) -> tuple[Any, Any]:
        asked = [start, *([] if linear.order == 1 else [start_rate or ZERO])]
        at = [diff(motion, TIME, n).subs(TIME, 0) for n in range(len(asked))]
        return ImmutableDenseMatrix(at), ImmutableDenseMatrix([explicit(value_behind(each)) for each in asked])

    return establish(
        SOLUTION,
        q.symbol,
        lambda *_: Terms(Add(*(C * e for C, e in zip(values, basis, strict=True))), particular),
        {"equation": equation, "q": q.symbol},
        lines=Lines(law=Level.FULL, put_in=None, arranged=lambda _: found),
        routes={"put_back": lambda motion: (put_back(equation, q, motion), ZERO), "start": from_the_start},
        outcome=sort,
        key=key or f"{q.symbol.name}_of_t",
        kind=q.kind,
        phrase_data=PhraseData(
            formulas={
                **conditions_told(excluded=excluded, condition=condition),
                **(general.told(found, basis, particular, values) if general else {}),
            },
            named=_start(q, first, initial),
            points_to={"general": general.step} if general else {},
            outcome_data={
                **sought.coefficients,
                "case": bool(condition),
                **({"constants": general.constants} if general else {}),
            },
        ),
        parents=[*approximations_among(start, start_rate), *([general.step] if general else [])],
        proposals=proposals,
    )


def _by_powers(motion: Expr) -> Expr:
    powers = motion.as_poly(TIME) if motion.is_polynomial(TIME) else None
    if powers is None:
        return by_terms(motion.expand())
    terms = ((n, presented(c)) for (n,), c in powers.terms())
    return Add(*(by_terms(c.expand()) if c.is_Add and n == 0 else c * TIME**n for n, c in terms))


def free_motion(linear: LinearCoefficients, first: Expr, initial: Expr, case: str | None) -> Expr:
    """Return the free motion with the given initial value and rate, and assume the condition of the case, if any."""
    sort, condition = _sort(linear, case, None)
    if condition is not None:
        assume(condition)
    basis = basis_of(linear, sort)
    return _free(basis, _constants(basis, ZERO, first, initial), linear, sort)


def _start(q: Coordinate, first: Expr, initial: Expr | None) -> dict[str, Relation]:
    at_rest = {} if initial is None else {"start_rate": Relation(q.rate, "=", initial)}
    return {"start": Relation(q.symbol, "=", first), **at_rest}


def linear_equation(equation: Quantity, q: Coordinate) -> LinearCoefficients:
    left = _left_of(equation, q).expand()
    state = (q.acceleration, q.rate, q.symbol)
    a, b, c = (tidied(derivative(left, s)) for s in state)
    rest = left.xreplace(dict.fromkeys(state, ZERO))
    _check_alone(equation, left, q)
    if a == 0 and c == 0 and depends_on_time(b) and not rest.has(*state) and is_zero(left - b * state[1] - rest):
        return LinearCoefficients(ZERO, ONE, ZERO, tidied(-rest / b))
    constant = not any(k.has(*state) or depends_on_time(k) for k in (a, b, c))
    whole = is_zero(left - a * state[0] - b * state[1] - c * state[2] - rest)
    if not constant or not whole or (a == 0 and b == 0):
        message = f"`{equation.key}` is not a linear differential equation in {q.symbol.name} alone"
        message += " with constant coefficients"
        raise Rejected(Complaint("not-linear", message))
    sign = -1 if (a if a != 0 else b).could_extract_minus_sign() else 1
    return LinearCoefficients(sign * a, sign * b, sign * c, -sign * rest)


def _left_of(equation: Quantity, q: Coordinate) -> Expr:
    """Return the left side minus the right side of the equation. If `equation` is the value of the rate or of the
    acceleration of q, return the rate or the acceleration minus this value."""
    if equation.symbol in (q.acceleration, q.rate) and is_number(equation):
        return equation.symbol - explicit(equation.value)
    return residual_of("solution", equation)


def _check_alone(equation: Quantity, left: Expr, q: Coordinate) -> None:
    """Reject an equation that contains another moving coordinate, or the rate or acceleration of another coordinate."""
    others = [rate(s, n) if n else s for s in coordinates_of(equation) if s != q.symbol for n in range(3)]
    other = next((s for s in others if left.has(s)), None)
    if other is not None:
        message = f"`{equation.key}` is not an equation in {q.symbol.name} alone: it also contains {other.name}"
        help_line = f"substitute the value of {other.name} from another equation"
        raise Rejected(Complaint("not-linear", message, help=help_line))


def _sort(linear: LinearCoefficients, case: str | None, equation: Quantity | None) -> tuple[str, Relation | None]:
    """Return the outcome, which names the kind of motion, and the condition for this kind.

    The condition is None unless `case` decides between the kinds of damped oscillation.
    """
    a, b, c = linear.a, linear.b, linear.c
    key = "the motion along a mode" if equation is None else f"`{equation.key}`"
    if case is not None and case not in CASES:
        message = f"`solution`: there is no case `{case}`"
        raise Rejected(Complaint("wrong-argument", message, help=f"the cases are {', '.join(CASES)}"))
    if linear.order == 1:
        return ("accumulates" if c == 0 else "relaxes" if _is_positive(c / b, key) else "runs_away"), None
    if c == 0:
        return ("uniform" if b == 0 else "slows" if _is_positive(b / a, key) else "runs_away"), None
    if b == 0:
        return ("oscillates" if _is_positive(c / a, key) else "runs_away"), None
    sign = sign_known(linear.discriminant)
    known = next((name for name, wanted in CASES.items() if wanted == sign), None)
    if known is None and case is None:
        message = f"{key}: the sign of {linear.discriminant} is unknown"
        cases = ", ".join(CASES)
        help_line = Spelled(f'give `case="..."`: {cases}', f"give `case: ...`: {cases}")
        raise Rejected(Complaint("open-case", message, help=help_line))
    if known is not None and case not in (None, known):
        raise Rejected(Complaint("open-case", f"{key} is {known.replace('_', ' ')}, not {str(case).replace('_', ' ')}"))
    if (known or case) == "overdamped" and not _is_positive(c / a, key):
        return "runs_away", None
    if not _is_positive(b / a, key):
        if known in (None, "underdamped"):
            message = f"{key}: the damping is negative, so the motion grows, and no case of `solution` applies"
            raise Rejected(Complaint("open-case", message, help="check the sign of the damping"))
        return "runs_away", None
    if (known or case) == "critically_damped" and not is_zero(linear.discriminant):  # zero for the given numbers only
        message = f"{key} is critically damped only if {linear.discriminant} = 0"
        raise Rejected(Complaint("open-case", message, help="substitute this condition first, with `put_in`"))
    if known is not None:
        return known, None
    mark = "<" if case == "underdamped" else ">"
    return str(case), compared(tidied(b**2), mark, tidied(4 * a * c))


def _is_positive(value: Expr, key: str) -> bool:
    """Whether a value is positive; reject zero and a value of unknown sign."""
    sign = sign_known(value)
    if not sign:
        open_value = "the sign of {} is unknown" if sign is None else "{} is 0 for the given numbers"
        message = f"{key}: {open_value.format(tidied(value))}"
        help_line = "declare its symbols as positive, or give them ranges or other numbers"
        raise Rejected(Complaint("open-case", message, help=help_line))
    return sign > 0


# --- the driving force ---


def _particular(linear: LinearCoefficients, equation: Quantity) -> Expr:
    """Return a particular motion under the driving force: the sum of the particular motions under its terms."""
    if linear.driven == 0:
        return ZERO
    check_no_function("solution", linear.driven, equation)
    terms = [_particular_of(linear, term, equation) for term in Add.make_args(_driving(linear.driven))]
    return Add(*(tidied(term) for term in terms))


def check_no_function(verb: str, driven: Expr, equation: Quantity) -> None:
    """Reject a driving force with a prescribed function, whose formula is unknown."""
    for each in prescribed_in(driven):
        message = f"`{verb}`: the driving force in `{equation.key}` contains {each.name}, whose formula is unknown"
        help_line = f"substitute a formula for {each.function.name} first, with `put_in`"
        raise Rejected(Complaint("unknown-driving", message, help=help_line))


def _driving(driven: Expr) -> Expr:
    value = expand(driven)
    return TR8(value).expand() if len([f for f in value.atoms(sin, cos) if depends_on_time(f)]) > 1 else value


def _particular_of(linear: LinearCoefficients, term: Expr, equation: Quantity) -> Expr:
    outside, inside = term.as_independent(TIME, as_Add=False)
    swings = [f for f in Mul.make_args(inside) if isinstance(f, sin | cos)]
    if linear.order == 1 and linear.c == 0:
        return tidied(outside / linear.b) * _accumulated(inside, equation)
    if inside == 1 or inside.is_polynomial(TIME):
        return outside * _of_power(linear, inside)
    if isinstance(inside, exp) and is_linear_in_time(inside.args[0]):
        return outside * inside * _under_exponential(linear, diff(inside.args[0], TIME))
    if len(swings) == 1 and inside == swings[0] and is_linear_in_time(swings[0].args[0]):
        return outside * _under_swing(linear, swings[0])
    raise _unknown_driving(equation, term)


def is_linear_in_time(angle: Expr) -> bool:
    return not depends_on_time(diff(angle, TIME))


def _unknown_driving(equation: Quantity, term: Expr) -> Rejected:
    message = f"`solution`: the driving force in `{equation.key}` contains {term}"
    help_line = "a driving force may contain powers of t, exponentials, sines and cosines"
    return Rejected(Complaint("unknown-driving", message, help=help_line))


def _of_power(linear: LinearCoefficients, power: Expr) -> Expr:
    """Return the motion under a force that is a polynomial in t, by the method of undetermined coefficients.

    The motion is a polynomial in t. The polynomial has the factor t if c = 0 but b is not zero, and the factor t^2 if
    b = c = 0.
    """
    degree = power.as_poly(TIME).degree() if depends_on_time(power) else 0
    lowest = 0 if linear.c != 0 else 1 if linear.b != 0 else 2
    unknown = [stand_in(f"u_{n}") for n in range(degree + 1)]
    trial = Add(*(u * TIME ** (n + lowest) for n, u in enumerate(unknown)))
    free = LinearCoefficients(linear.a, linear.b, linear.c, power)
    rows = expand(free.residual(trial)).as_poly(TIME).all_coeffs()
    matrix = Matrix([[diff(row, u) for u in unknown] for row in rows])
    right = Matrix([-row.xreplace(dict.fromkeys(unknown, ZERO)) for row in rows])
    kept = [i for i in range(matrix.rows) if any(entry != 0 for entry in matrix.row(i))]
    values = matrix.extract(kept, list(range(len(unknown)))).LUsolve(right.extract(kept, [0]))
    return trial.xreplace(dict(zip(unknown, values, strict=True)))


def _under_exponential(linear: LinearCoefficients, k: Expr) -> Expr:
    """Return the response to e^(k t), divided by e^(k t): 1/P(k), where P(s) = a s^2 + b s + c.

    If k is a single root of P, the response is t/P'(k); if k is a double root, the response is t^2/P''(k).
    """
    for power, value in enumerate(
        (linear.a * k**2 + linear.b * k + linear.c, 2 * linear.a * k + linear.b, 2 * linear.a)
    ):
        if not is_zero(value):
            return TIME**power / value
    raise Rejected(Complaint("unknown-driving", "the equation has no response to this exponential"))


def _under_swing(linear: LinearCoefficients, swing: Expr) -> Expr:
    """Return the forced oscillation; at the frequency of an undamped free motion, the oscillation grows with time."""
    (angle,) = swing.args
    w = diff(angle, TIME)
    stiff, loss = tidied(linear.c - linear.a * w**2), tidied(linear.b * w)
    quarter_on = sin(angle) if isinstance(swing, cos) else -cos(angle)
    if stiff == 0 and loss == 0:
        return TIME * quarter_on / (2 * linear.a * w)
    return (stiff * swing + loss * quarter_on) / (stiff**2 + loss**2)


def _excluded(linear: LinearCoefficients) -> Relation | None:
    """Return the condition against resonance: no free motion has the frequency or the rate of the driving force. The
    result is None if no condition is needed."""
    found: dict[Relation, None] = {}
    for term in Add.make_args(_driving(linear.driven)):
        for f in term.atoms(sin, cos, exp):
            w = diff(f.args[0], TIME)
            if w == 0 or linear.order == 1 and linear.c == 0 or not isinstance(f, exp) and linear.b != 0:
                continue
            below = linear.a * w**2 + linear.b * w if isinstance(f, exp) else -linear.a * w**2
            below = tidied(linear.c + below)
            check_no_resonance(below)
            condition = None if is_zero(below) else different_from_zero(below)
            if condition is not None:
                found[condition] = None
    if len(found) < 2:
        return next(iter(found), None)
    return Relation(Mul(*(each.residual for each in found)), "!=", ZERO)


def _accumulated(inside: Expr, equation: Quantity) -> Expr:
    """Return the antiderivative with respect to time of a power of a + b t, an exponential, a sine or a cosine."""
    if inside == 1:
        return TIME
    base, power = inside.as_base_exp()
    if isinstance(inside, exp | sin | cos) and is_linear_in_time(inside.args[0]):
        rate = diff(inside.args[0], TIME)
        whole = {exp: inside, sin: -cos(inside.args[0]), cos: sin(inside.args[0])}[inside.func]
        return whole / rate
    if is_linear_in_time(base) and not depends_on_time(power):
        rate = diff(base, TIME)
        if power == -1:
            start = base.subs(TIME, 0)
            if rate.could_extract_minus_sign():
                return log(start / base) / -rate
            return log(base / start) / rate
        return Pow(base, power + 1) / (rate * (power + 1))
    raise _unknown_driving(equation, inside)


# --- the initial values ---


def _constants(basis: Sequence[Expr], particular: Expr, first: Expr, initial: Expr | None) -> list[Expr]:
    rows = [[e.subs(TIME, 0) for e in basis]]
    right = [first - particular.subs(TIME, 0)]
    if initial is not None:
        rows.append([diff(e, TIME).subs(TIME, 0) for e in basis])
        right.append(initial - diff(particular, TIME).subs(TIME, 0))
    return [tidied(value) for value in Matrix(rows).LUsolve(Matrix(right))]


def _free(basis: Sequence[Expr], values: Sequence[Expr], linear: LinearCoefficients, sort: str) -> Expr:
    common = exp(tidied(-linear.b / (2 * linear.a)) * TIME) if sort in ("underdamped", "critically_damped") else ONE
    inside = Add(*(presented(C) * (e / common) for C, e in zip(values, basis, strict=True)))
    inside = min((factor_terms(inside.expand()), factor_terms(inside), inside), key=length)
    return Mul(common, inside, evaluate=False) if common != 1 and inside.is_Add else common * inside


def _joined(free: Expr, particular: Expr) -> Expr:
    """Add the free motion and the particular motion, in the shortest form.

    If a constant particular motion cancels the free motion at t = 0, the sum is written like v_t (1 - e^(-t/T)).
    """
    if not depends_on_time(particular) and particular != 0 and not free.is_Add:
        outside, inside = free.as_independent(TIME, as_Add=False)
        if is_zero(outside + particular):
            return Mul(presented(particular), 1 - inside, evaluate=False)
    whole = free + particular
    marks = {f: Dummy(str(f)) for f in whole.atoms(sin, cos, exp, cosh, sinh) if depends_on_time(f)}
    back = {mark: f for f, mark in marks.items()}
    factored = presented(whole.xreplace(marks)).xreplace(back)
    forms = (whole, factor_terms(whole.expand()), factor_terms(whole), factored)
    return min(forms, key=length)
