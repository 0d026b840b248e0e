"""Equations of motion to first order about an equilibrium, in any number of coordinates.

The equations are M eta_ddot + G eta_dot + K eta = f(t), with the displacements eta and the driving forces f. The
matrices are the coefficients of the equations of motion at equilibrium. The second route differentiates the momenta of
the mass points and the generalized forces, including drag and given forces.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from sympy import Add, Expr, ImmutableDenseMatrix, Integer, Symbol, cos, nan, sin, zoo
from sympy.matrices import MatrixBase

from derive.algebra.collect import by_accelerations, spread, with_differences_of_coordinates
from derive.algebra.derivatives import derivative
from derive.algebra.expansion import FirstOrder
from derive.algebra.expressions import TIME, Relation, Terms, depends_on_time, explicit, rate, scalar
from derive.algebra.squares import with_squares
from derive.algebra.taylor import slope
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled
from derive.mechanics.kinematics.coordinates import Coordinate, OfCoordinate
from derive.mechanics.model.dalembert import Matter
from derive.mechanics.rest.constrained_stability import constraints_of
from derive.mechanics.rest.equilibria import place_given
from derive.mechanics.rest.mass_matrix import check_regular
from derive.mechanics.vibrations import claims
from derive.mechanics.vibrations.facts import Linear
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.rule import ROUTE, Rule, Shown
from derive.steps.signs import sign_known
from derive.steps.step import Form, Level, Quantity, Step, compared_with, is_zero
from derive.witness.facts import Around, Rest

__all__ = ["linearised"]

ZERO = Integer(0)
EQUILIBRIUM = Spelled(
    "`equilibria` finds the equilibria",
    "`at: rest` chooses the equilibrium with this name; the answer `equilibria` finds the equilibria",
)
MOST_TOLD = 2  # largest number of terms of higher order that a sentence can list


def linearised(
    motion: Quantity | Sequence[Quantity],
    at: Quantity | Mapping[Any, Expr] | Expr | None = None,
    key: str = "linearised",
    others: Sequence[Quantity] = (),
) -> Quantity | tuple[Quantity, ...]:
    """Equations of motion to first order in the displacements from equilibrium, M eta_ddot + G eta_dot + K eta = f(t).

    motion   the equations, as `equations_of_motion` yields them; or a single equation for one coordinate
    at       the equilibrium: as `equilibria` yields it, or `{theta: 0, phi: pi}`; by default all coordinates are 0. For
             a single equation, `at` may also be the value of its coordinate
    key      the beginning of the keys; with the default the key for theta is linearised_theta. A single equation has
             the key `key` itself if `at` is a value or is omitted
    others   the other equilibria, which the page states together with `at`

    Forces linear in the rates, such as drag, give G. Terms that depend only on the time give the driving forces f. If a
    coordinate is not 0 at equilibrium, its displacement is called eta, or eta_1, eta_2, ... if there are several such
    coordinates.
    Second route: M, G and K are derivatives of the momenta of the mass points and of the generalized forces.
    Outcomes: generic, displaced (some coordinate is not 0 at equilibrium); with drag: damped, displaced_damped; with a
    driving force: driven, displaced_driven.
    Errors: a force remains at the given equilibrium; the value or the equation of a coordinate is missing; the
    coefficients depend on the time; the equilibrium does not exist for the given numbers.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 6.2.
    """
    if isinstance(motion, Quantity) and not isinstance(at, Mapping | Quantity):
        q = motion.needed(OfCoordinate).coordinate
        return _together((motion,), {q: ZERO if at is None else at}, [key])[0]
    equations = (motion,) if isinstance(motion, Quantity) else tuple(motion)
    keys = [f"{key}_{each.needed(OfCoordinate).coordinate.symbol.name}" for each in equations]
    return _together(equations, at, keys, others)


def _together(
    equations: Sequence[Quantity], at: Any, keys: Sequence[str], others: Sequence[Quantity] = ()
) -> tuple[Quantity, ...]:
    moving = [equation.needed(OfCoordinate).coordinate for equation in equations]
    _check_whole(equations, moving)
    place = _place_of(equations, moving, at)
    _check_exists(at)
    check_regular("linearised", equations[0].needed(Matter), place)
    _check_rest(equations, moving, place)
    eta = _displacements(moving, place)
    exists = at.needed(Rest).exists if isinstance(at, Quantity) else None
    mass, turning, stiffness = (_coefficients(equations, moving, place, order) for order in (2, 1, 0))
    driven = tuple(-_at_rest(explicit(equation.value).residual, moving, place) for equation in equations)
    rest = tuple((q, place[q.symbol]) for q in moving)
    linear = Linear(mass, turning, stiffness, exists, eta, driven, rest, _exact(equations, moving, place, eta))
    rests = [at, *others] if isinstance(at, Quantity) else []
    return tuple(_one(equations, i, moving, place, linear, rests, key) for i, key in enumerate(keys))


def _if_linear(step: Step) -> str:
    """Return the key of the equation of motion if this equation is already linear, otherwise an empty text."""
    roles = dict(step.roles)
    return str(roles["motion"].name) if "as_it_is" in roles else ""


LINEARISED = Rule(
    "vibrations.linearised",
    source="Goldstein, Poole, Safko, *Classical Mechanics*, section 6.2",
    outcomes={
        "generic": claims.modes_linear(displaced=False, lossy=False, driven=False),
        "displaced": claims.modes_linear(displaced=True, lossy=False, driven=False),
        "damped": claims.modes_linear(displaced=False, lossy=True, driven=False),
        "displaced_damped": claims.modes_linear(displaced=True, lossy=True, driven=False),
        "driven": claims.modes_linear(displaced=False, lossy=None, driven=True),
        "displaced_driven": claims.modes_linear(displaced=True, lossy=None, driven=True),
    },
    evidence={"second_order": ROUTE, "given_second_order": ROUTE},
    named={
        "alone": claims.alone_in_its_equation,
        "sine": claims.small_function(sin),
        "cosine": claims.small_function(cos),
    },
    shown=Shown(repeats=_if_linear),
)


def _one(
    equations: Sequence[Quantity],
    i: int,
    moving: list[Coordinate],
    place: Mapping[Symbol, Expr],
    linear: Linear,
    rests: Sequence[Quantity],
    key: str,
) -> Quantity:
    """Linear equation of one coordinate.

    Outcomes: generic, displaced, damped, displaced_damped, driven, displaced_driven.
    Source: the same as for `linearised`.
    """
    eta = linear.displacements
    ordered = [
        (matrix, [rate(s.symbol, n) if n else s.symbol for s in eta])
        for matrix, n in ((linear.mass, 2), (linear.turning, 1), (linear.stiffness, 0))
    ]
    if any(matrix[i, j].has(nan, zoo) for matrix, _ in ordered for j in range(len(eta))):
        message = f"`{key}`: the equation of motion is not differentiable at the equilibrium"
        raise Rejected(Complaint("no-value", message, help="a force such as sqrt(x_dot**2) has a corner there"))
    common = linear.common(i)
    terms = [
        with_squares(spread(tidied(matrix[i, j] / common))) * s
        for matrix, letters in ordered
        for j, s in enumerate(letters)
    ]
    restoring = with_differences_of_coordinates(Add(*terms[-len(eta) :]), [s.symbol for s in eta])
    terms = [*terms[: -len(eta)], *Add.make_args(restoring)]
    left = Add(*(term for term in terms if term != 0), evaluate=False)
    displaced = {s.symbol: q.symbol for q, s in zip(moving, eta, strict=True)}
    away = [(q, s) for s, q in displaced.items() if q != s]
    named = _letters_of(rests[:1])
    counted = {
        f"counted_{n}": (
            Relation(q, "=", Terms(*Add.make_args(named.get(q, place[q])), s)),
            Relation(s, "=", q - named.get(q, place[q])),
        )
        for n, (q, s) in enumerate(away, 1)
    }
    whole = Relation(left, "=", tidied(linear.driven[i] / common))
    if not away and is_zero(explicit(equations[i].value).residual - whole.residual):
        counted["as_it_is"] = (whole, equations[i].value)
    if linear.exact:
        counted["exact"] = (whole, Relation(linear.exact[i] / common, "=", ZERO))
    small = None if away or "as_it_is" in counted else _with_small_angles(equations[i], moving, common)
    alone: dict[str, Expr] = {}
    if len(moving) == 1:
        alone = {"alone": moving[0].symbol, **_functions_of(equations[i], moving[0], small)}
        counted.update(_dropped(moving[0], small))
    return establish(
        LINEARISED,
        None,
        lambda *_: whole,
        {},
        lines=Lines(before=_before(small, moving), put_in=None, result=False, arranged=explicit),
        routes=equations[i]
        .needed(Matter)
        .named({"second_order": compared_with(lambda: _of_second_order(equations, i, moving, place, eta))}),
        outcome=_outcome(linear, i, bool(away)),
        phrase_data=PhraseData(
            points_to=_pointed(equations, i),
            outcome_data={
                "place": tuple(place.values()),
                "displacements": tuple(s.symbol for s in eta),
                **_loss(linear),
            },
            formulas=counted,
            named=alone,
        ),
        key=key,
        parents=[*equations, *rests],
        facts=[linear, OfCoordinate(eta[i]), Around(dict(place), linear.exists, displaced)],
        scope=Scope(coordinates={s.symbol: s.kind for s in eta}),
    )


def _exact(
    equations: Sequence[Quantity], moving: Sequence[Coordinate], place: Mapping[Symbol, Expr], eta: Sequence[Coordinate]
) -> tuple[Expr, ...]:
    """Return the left sides in terms of the displacements if no equation has a term of higher order; otherwise an empty
    tuple."""
    put = {q.symbol: place[q.symbol] + s.symbol for q, s in zip(moving, eta, strict=True)}
    for q, s in zip(moving, eta, strict=True):
        put.update({q.rate: s.rate, q.acceleration: s.acceleration})
    letters = [letter for s in eta for letter in (s.symbol, s.rate, s.acceleration)]
    found = tuple(explicit(equation.value).residual.xreplace(put).expand() for equation in equations)
    powers = [left.as_poly(*letters) for left in found]
    return found if all(power is not None and power.total_degree() == 1 for power in powers) else ()


def _with_small_angles(equation: Quantity, moving: Sequence[Coordinate], common: Expr) -> Expr | None:
    """Return the left side, divided by `common`, with sin(u) = u and cos(u) = 1.

    Return None if there is no sine or cosine, or if an argument u does not vanish where all coordinates are 0.
    """
    left = explicit(equation.value).residual / common
    angles = left.atoms(sin, cos)
    letters = {q.symbol for q in moving}
    if not angles or any(f.args[0].xreplace(dict.fromkeys(letters, ZERO)) != 0 for f in angles):
        return None
    put = {f: f.args[0] if isinstance(f, sin) else Integer(1) for f in angles}
    return by_accelerations(left.expand().xreplace(put), list(letters))


def _before(small: Expr | None, moving: Sequence[Coordinate]) -> list[Form]:
    if small is None:
        return []
    letters = [letter for q in moving for letter in (q.symbol, q.rate, q.acceleration)]
    return [Form(Relation(FirstOrder(small, *letters), "=", ZERO), "small_angles", Level.FULL)]


def _functions_of(equation: Quantity, q: Coordinate, small: Expr | None) -> dict[str, Expr]:
    """Return the sine and the cosine of the coordinate that occur in the equation; none if `small` is None."""
    functions = {"sine": sin(q.symbol), "cosine": cos(q.symbol)} if small is not None else {}
    return {role: f for role, f in functions.items() if explicit(equation.value).residual.has(f)}


def _dropped(q: Coordinate, small: Expr | None) -> dict[str, tuple[Expr, Expr]]:
    if small is None:
        return {}
    told: dict[str, tuple[Expr, Expr]] = {}
    letters = (q.symbol, q.rate, q.acceleration)
    powers = [(term, term.as_poly(*letters)) for term in Add.make_args(small.expand())]
    terms = [term for term, power in powers if power is None or power.total_degree() > 1]
    if 0 < len(terms) <= MOST_TOLD and all(power is not None for _, power in powers):
        told.update({f"dropped_{n}": (tidied(term), term) for n, term in enumerate(terms, 1)})
    return told


def _letters_of(rests: Sequence[Quantity]) -> dict[Symbol, Expr]:
    """Return the symbols that the page uses for the equilibrium values, such as r_0 for r."""
    found: dict[Symbol, Expr] = {}
    for rest in rests:
        names = [rest.symbol] if isinstance(rest.symbol, Symbol) else list(rest.symbol or ())
        held = list(rest.needed(Rest).values)
        found.update(zip(held, names, strict=True) if len(names) == len(held) else ())
    return found


def _outcome(linear: Linear, own: int, displaced: bool) -> str:
    if linear.driven[own] != 0:
        return "displaced_driven" if displaced else "driven"
    if _loss(linear)["loss"] != 0:
        return "displaced_damped" if displaced else "damped"
    return "displaced" if displaced else "generic"


def _loss(linear: Linear) -> dict[str, Expr]:
    """Return the rate at which small motions lose energy, with the key `loss`. This rate depends only on the symmetric
    part of G."""
    rates = [s.rate for s in linear.displacements]
    return {"loss": Add(*(linear.turning[i, j] * u * v for i, u in enumerate(rates) for j, v in enumerate(rates)))}


def _check_whole(equations: Sequence[Quantity], moving: Sequence[Coordinate]) -> None:
    known = {q.symbol for q in moving}
    for equation in equations:
        value = explicit(equation.value).residual
        others = [q for q in equation.coordinates if q not in known and value.has(q, rate(q), rate(q, 2))]
        kept = next((q for q in others if any(q == c.force for c in constraints_of(equation))), None)
        if kept is not None:
            message = f"`linearised`: `{equation.key}` contains {kept.name}, the multiplier of a constraint"
            help_line = "write the positions with fewer coordinates, so that this constraint is not needed"
            raise Rejected(Complaint("constrained", message, help=help_line))
        if others:
            message = f"`linearised`: `{equation.key}` also contains {others[0].name}, for which no equation is given"
            help_line = "give all equations together, as `equations_of_motion` yields them"
            raise Rejected(Complaint("wrong-argument", message, help=help_line))


def _place_of(equations: Sequence[Quantity], moving: Sequence[Coordinate], at: Any) -> dict[Symbol, Expr]:
    """Return the equilibrium value of each coordinate. The value is 0 if `at` is None, or if `at` has no value for a
    coordinate that occurs only through its rates."""
    known = dict.fromkeys((q.symbol for q in moving), ZERO) if at is None else place_given(at)
    strange = [s for s in known if s not in {q.symbol for q in moving}]
    if strange:
        message = f"`linearised`: these equations have no coordinate {strange[0]}"
        raise Rejected(Complaint("wrong-argument", message))
    left = [explicit(equation.value).residual for equation in equations]
    for q in moving:
        if q.symbol not in known and any(value.has(q.symbol) for value in left):
            message = f"`linearised`: the value of {q.symbol.name} at equilibrium is unknown"
            raise Rejected(
                Complaint("wrong-argument", message, help=f"add the value to `at`, such as `{q.symbol.name}: 0`")
            )
    return {q.symbol: known.get(q.symbol, ZERO) for q in moving}


def _at_rest(value: Expr, moving: Sequence[Coordinate], place: Mapping[Symbol, Expr]) -> Expr:
    still = {letter: ZERO for q in moving for letter in (q.rate, q.acceleration)}
    return tidied(value.xreplace({**still, **place}))


def _check_exists(at: Any) -> None:
    exists = at.needed(Rest).exists if isinstance(at, Quantity) else None
    sign = sign_known(exists.residual) if exists is not None else None
    if exists is not None and sign is not None and sign != (1 if exists.operator == ">" else -1):
        message = (
            f"`{at.key}` exists only for {exists.left} {exists.operator} {exists.right}, "
            "which the given values do not satisfy"
        )
        raise Rejected(Complaint("no-equilibrium", message, help="give other values, or another equilibrium"))


def _check_rest(equations: Sequence[Quantity], moving: Sequence[Coordinate], place: Mapping[Symbol, Expr]) -> None:
    """Check that the coefficients do not depend on the time. Also check that the given values of the coordinates are an
    equilibrium: without motion, only driving forces remain in the equations."""
    where = ", ".join(f"{s} = {value}" for s, value in place.items())
    for equation in equations:
        value = explicit(equation.value).residual
        letters = [s for q in moving for s in (q.symbol, q.rate, q.acceleration)] if depends_on_time(value) else []
        slopes = [derivative(value, s) for s in letters]
        if any(depends_on_time(_at_rest(slope, moving, place)) for slope in slopes):
            message = f"the coefficients of `{equation.key}` depend on the time, but they must be constant"
            raise Rejected(Complaint("changes", message))
        left = lasting(_at_rest(value, moving, place))
        if left.has(nan, zoo):
            message = f"`{equation.key}` has no value at {where}, where a distance or a denominator is zero"
            raise Rejected(Complaint("no-equilibrium", message, help=EQUILIBRIUM))
        if not is_zero(left):
            message = f"`{equation.key}` does not hold at rest at {where}: one side minus the other is {left}, not 0"
            raise Rejected(Complaint("no-equilibrium", message, help=EQUILIBRIUM))


def lasting(value: Expr) -> Expr:
    """Return the terms of a sum that do not depend on the time."""
    if not depends_on_time(value):
        return value
    return Add(*(term for term in Add.make_args(value.expand()) if not depends_on_time(term)))


def _coefficients(
    equations: Sequence[Quantity], moving: Sequence[Coordinate], place: Mapping[Symbol, Expr], order: int
) -> MatrixBase:
    """Return the coefficients, at equilibrium, of the accelerations (order 2), the rates (1) or the coordinates (0)."""

    def entry(i: int, j: int) -> Expr:
        q = moving[int(j)].symbol
        left = explicit(equations[int(i)].value).residual
        return _at_rest(derivative(left, rate(q, order) if order else q), moving, place)

    return ImmutableDenseMatrix(len(equations), len(moving), entry)


def _displacements(moving: Sequence[Coordinate], place: Mapping[Symbol, Expr]) -> tuple[Coordinate, ...]:
    """Return the displacement of each coordinate: the coordinate itself if it is 0 at equilibrium, otherwise eta.

    Several displacements that are not coordinates themselves are called eta_1, eta_2, ...
    """
    away = [q for q in moving if place[q.symbol] != 0]
    names = {q: "eta" if len(away) == 1 else f"eta_{n + 1}" for n, q in enumerate(away)}
    return tuple(Coordinate(scalar(names[q]), q.kind) if q in names else q for q in moving)


def _pointed(equations: Sequence[Quantity], i: int) -> dict[str, Quantity]:
    """Return the equations that the sentence names: equation i and, if there are several equations, another equation.
    For the first of more than two equations, the sentence names two other equations."""
    others = {"other": equations[i - 1]} if len(equations) > 1 else {}
    middle = {"middle": equations[1]} if len(equations) > 2 and i == 0 else {}
    return {"motion": equations[i], **others, **middle}


def _of_second_order(
    equations: Sequence[Quantity],
    i: int,
    moving: Sequence[Coordinate],
    place: Mapping[Symbol, Expr],
    eta: Sequence[Coordinate],
) -> Relation:
    """Derive the equation from mass points: differentiate momentum and generalized force at equilibrium.

    Momenta and forces are used, because the kinetic energy does not give the forces if cyclic coordinates are
    eliminated.
    """
    matter, q = equations[i].needed(Matter), moving[i]
    momentum = explicit(matter.momentum_along(q.symbol))
    pushed = explicit(matter.turning_along(q.symbol) + matter.force_along(q.symbol))
    in_time, terms = slope(momentum, TIME), []
    for other, s in zip(moving, eta, strict=True):
        mass = slope(momentum, other.rate)
        turning = slope(momentum, other.symbol) - slope(pushed, other.rate)
        stiffness = slope(in_time, other.symbol) - slope(pushed, other.symbol)
        for value, letter in ((mass, s.acceleration), (turning, s.rate), (stiffness, s.symbol)):
            terms.append(_at_rest(value, moving, place) * letter)
    driving = pushed - in_time
    return Relation(Add(*terms), "=", _at_rest(driving, moving, place))
