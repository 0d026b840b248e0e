"""What must hold between the value of a step and the facts that it returns with it, by the kind of fact.

Later steps rely on a fact as they rely on a value: what it says is found here once more, from the value and the inputs.
"""

from __future__ import annotations

from itertools import islice
from typing import Any

from sympy import Abs, Add, Expr, Integer, Matrix, MatrixBase, Pow, Rational, Symbol, binomial, diff, factorial

from derive.algebra.expressions import Partial, Relation, explicit, rate
from derive.algebra.samples import NoNumber, SamplePoint, Undefined, letters_of, points, seed_of, value_at
from derive.algebra.tidy import tidied
from derive.mechanics.bodies.facts import CountedFrom
from derive.mechanics.hamilton.effective import Constant
from derive.mechanics.kinematics.coordinates import OfCoordinate
from derive.mechanics.lagrange.constraint_forces import ForceOf
from derive.mechanics.lagrange.kept_momentum import KeptMomentum, WithMomenta
from derive.mechanics.motion.steady import Steady
from derive.mechanics.motion.turning_points import ByEnergy
from derive.mechanics.outcomes.signs import is_so, same_equation
from derive.mechanics.rest.potentials import DerivativeOf, LowestOrder, Shape
from derive.mechanics.rest.stable_where import StableWhere
from derive.mechanics.rotation.perturbed_rotation import Disturbed
from derive.mechanics.vibrations.linearised import Linear
from derive.mechanics.vibrations.modes import Mode
from derive.mechanics.vibrations.oscillations import SquareOf
from derive.solving.root_of_factor import RootOf
from derive.steps.numeric import Extreme
from derive.steps.outcomes import Judged, Naming, handed_on_by
from derive.steps.record import assumed
from derive.steps.step import is_zero
from derive.witness.facts import Rest

TRIED, DIGITS_LEFT = 6, 10**40  # places; values have 60 digits


def _value(facts: Judged, role: str) -> Any:
    return explicit(facts.inputs[role])


def _kept_momentum(facts: Judged, fact: KeptMomentum) -> bool:
    """With the rate that it returns, the momentum has the value that it keeps."""
    momentum, value = _value(facts, "momentum"), _value(facts, "value")
    there = momentum.xreplace({rate(fact.coordinate): fact.turning})
    as_named = (fact.momentum, fact.coordinate) == (facts.quantities["momentum"].symbol, facts.inputs["coordinate"])
    return as_named and is_zero(there - value) and is_zero(fact.value - value)


def _with_momenta(facts: Judged, fact: WithMomenta) -> bool:
    """The rates of the coordinates whose momenta are kept are gone from the equation."""
    return not explicit(facts.result).has(*(rate(kept.coordinate) for kept in fact.kept))


def _of_its_coordinate(facts: Judged, fact: OfCoordinate) -> bool:
    """It is the one by which the left side is a derivative, or which the sentence names."""
    q, symbol = fact.coordinate.symbol, facts.symbol
    if isinstance(symbol, Partial):
        return symbol.args[1] in (q, rate(q))
    if isinstance(symbol, Symbol) and symbol.name.endswith("_ddot"):
        return bool(symbol == rate(q, 2))
    return bool(facts.inputs.get("coordinate", q) == q)


def _does_not_occur(facts: Judged, fact: Constant) -> bool:
    return not _value(facts, "lagrangian").has(fact.coordinate.symbol)


def _force_of_its_constraint(facts: Judged, fact: ForceOf) -> bool:
    return bool(fact.constraint.force == facts.symbol)


def _derivative(facts: Judged, fact: DerivativeOf) -> bool:
    of, q, order = facts.symbol.args
    energy, found = explicit(fact.potential.value), explicit(facts.result)
    if (of, q) != (fact.potential.symbol, fact.coordinate):
        return False
    if energy.has(Abs):
        return _is_slope_in_numbers(energy, q, int(order), found)
    return is_zero(diff(energy, fact.coordinate, int(order)) - found)


def _nearby(point: SamplePoint) -> Expr:
    """A distance that is small beside every number of a point."""
    return min((abs(number) for number in point.values()), default=Integer(1)) / 10**9


def _is_slope_in_numbers(energy: Expr, q: Symbol, order: int, found: Expr) -> bool:
    """Of an energy with distances |x - d|, by central differences at drawn places."""
    seen = 0
    for point in islice(points(letters_of(energy) | letters_of(found), seed_of(energy)), TRIED):
        try:
            near, steps = _nearby(point), range(order + 1)
            there = [value_at(energy, {**point, q: point[q] + (n - Rational(order, 2)) * near}) for n in steps]
            slope = Add(*((-1) ** (order - n) * binomial(order, n) * there[n] for n in steps)) / near**order
            apart, size = slope - value_at(found, point), abs(slope) + 1
        except (Undefined, NoNumber):
            continue
        if abs(apart) > size / 10**6:
            return False
        seen += 1
    return seen > 0


def _curvature(facts: Judged, fact: Extreme) -> bool:
    q, place = facts.inputs["coordinate"], facts.inputs["at"]
    return is_zero(diff(_value(facts, "potential"), q, 2).xreplace({q: place}) - fact.curvature)


def _lowest_order(facts: Judged, fact: LowestOrder) -> bool:
    q, place, n = facts.inputs["coordinate"], facts.inputs["place"], int(fact.order)
    if n == 0:
        return bool(fact.coefficient == 0)
    at = diff(explicit(facts.result), q, n).xreplace({q: place})
    return is_zero(at / factorial(n) - fact.coefficient)


def _shape(facts: Judged, fact: Shape) -> bool:
    """The curvature at the place is the result, and vanishes on the border."""
    q, result, energy = fact.coordinate, explicit(facts.result), explicit(fact.potential.value)
    on_border = fact.border is None or is_zero(result.subs(fact.border.left, fact.border.right))
    if energy.has(Abs):
        return on_border and _is_curvature_in_numbers(facts, energy, fact, result)
    return on_border and is_zero(tidied(diff(energy, q, 2).subs(q, fact.place)) - result)


def _is_curvature_in_numbers(facts: Judged, energy: Expr, fact: Shape, found: Expr) -> bool:
    """Of an energy with distances |x - d| at the place, where this is a state of rest: by a central difference."""
    seen, exists = 0, facts.inputs.get("exists")
    conditions = [each for each in (exists, *assumed()) if each is not None]
    letters = letters_of(energy) | letters_of(found) | {s for c in conditions for s in letters_of(c.residual)}
    for point in islice(points(letters - {fact.coordinate}, seed_of(energy)), 4 * TRIED):
        try:
            if not all(is_so(each, point) for each in conditions):
                continue
            at, near = value_at(fact.place, point), _nearby(point)
            below, there, above = (value_at(energy, {**point, fact.coordinate: at + n * near}) for n in (-1, 0, 1))
            apart = (below - 2 * there + above) / near**2 - value_at(found, point)
        except (Undefined, NoNumber):
            continue
        if abs(there) > near**2 * DIGITS_LEFT:  # the numbers differ so much in size that the difference has no digits
            continue
        if abs(apart) > (abs(value_at(found, point)) + 1) / 10**6:
            return False
        seen += 1
    return seen > 0


def _stable_where(facts: Judged, fact: StableWhere) -> bool:
    there = tidied(diff(fact.energy, fact.coordinate, 2).subs(fact.coordinate, fact.place))
    return fact.condition == facts.inputs["condition"] and is_zero(there - explicit(facts.result))


def _square(facts: Judged, fact: SquareOf) -> bool:
    return isinstance(facts.symbol, Pow) and facts.symbol.base.name == fact.letter and facts.symbol.exp == 2


def _mode(facts: Judged, fact: Mode) -> bool:
    """The square of the frequency is the root, but for the sign of one that grows; each column is in the kernel."""
    root = fact.root
    squared = explicit(facts.result) ** 2
    if not is_zero(squared - root.value) and not (root.sign == -1 and is_zero(squared + root.value)):
        return False
    matrix = Matrix(facts.inputs["stiffness"]) - root.value * Matrix(facts.inputs["mass"])
    return all(is_zero((matrix * column).applyfunc(tidied)) for column in root.columns)


def _linear(facts: Judged, fact: Linear) -> bool:
    """Each coefficient of the equation stands in some row of the matrices, all with one factor."""
    residual = explicit(facts.result).residual
    orders = ((fact.mass, 2), (fact.turning, 1), (fact.stiffness, 0))
    names = [s.symbol for s in fact.displacements]
    places = [(matrix, n, j) for matrix, n in orders for j in range(len(names))]
    for i in range(fact.mass.shape[0]):
        row = [(diff(residual, rate(names[j], n) if n else names[j]), matrix[i, j]) for matrix, n, j in places]
        first = next(((a, b) for a, b in row if b != 0), None)
        if first is not None and first[0] != 0 and all(is_zero(a * first[1] - b * first[0]) for a, b in row):
            return True
    return False


def _rest(facts: Judged, fact: Rest) -> bool:
    result = explicit(facts.result)
    found = list(result) if isinstance(result, MatrixBase) else [result]
    held = [fact.values[q] for q in facts.inputs["sought"] if q in fact.values]
    return len(found) == len(held) and all(is_zero(one - other) for one, other in zip(found, held, strict=True))


def _root(facts: Judged, fact: RootOf) -> bool:
    """It is a root of its factor."""
    value = facts.result.right if isinstance(facts.result, Relation) else facts.result
    powers = range(len(fact.coefficients) - 1, -1, -1)
    return is_zero(sum(c * explicit(value) ** n for c, n in zip(fact.coefficients, powers, strict=True)))


def _by_energy(facts: Judged, fact: ByEnergy) -> bool:
    """The acceleration is half the slope of the square of the rate, which at the start is that of the start."""
    square, q = explicit(facts.result), fact.coordinate
    acceleration = fact.acceleration.subs(rate(q) ** 2, square)
    there = square.subs(q, fact.start) - fact.start_rate**2
    return facts.symbol == rate(q) ** 2 and is_zero(there) and is_zero(diff(square, q) / 2 - acceleration)


def _steady(facts: Judged, fact: Steady) -> bool:
    """What it says of each coordinate is what the sentence says, and some condition is the result."""
    told = {v.left: v.right for role, v in facts.inputs.items() if role.startswith(("stays_", "turns_"))}
    held = {**fact.values, **{rate(s): v for s, v in fact.rates.items()}}
    fits = any(same_equation(each, explicit(facts.result).residual) for each in fact.conditions)
    return fits and all(s in held and is_zero(held[s] - value) for s, value in told.items())


def _counted_from(facts: Judged, fact: CountedFrom) -> bool:
    """The point that the sentence names is the one from which later steps count."""
    return facts.words.get("start", fact.start.name) == fact.start.name


def _disturbed(facts: Judged, fact: Disturbed) -> bool:
    return "xyz"[fact.axis] == facts.words["axis"]


_TABLE: dict[type[Any], Naming] = {
    KeptMomentum: _kept_momentum,
    WithMomenta: _with_momenta,
    OfCoordinate: _of_its_coordinate,
    Constant: _does_not_occur,
    ForceOf: _force_of_its_constraint,
    DerivativeOf: _derivative,
    Extreme: _curvature,
    LowestOrder: _lowest_order,
    Shape: _shape,
    StableWhere: _stable_where,
    SquareOf: _square,
    Mode: _mode,
    Linear: _linear,
    Rest: _rest,
    RootOf: _root,
    ByEnergy: _by_energy,
    Steady: _steady,
    Disturbed: _disturbed,
    CountedFrom: _counted_from,
}

for _kind, _predicate in _TABLE.items():
    handed_on_by(_kind, _predicate)
