"""Predicates that check the outcomes of steps about oscillations, and the expressions in the sentences of these
steps."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

from sympy import (
    Abs,
    Dummy,
    Expr,
    I,
    ImmutableDenseMatrix,
    Integer,
    Matrix,
    Poly,
    Pow,
    Rational,
    Symbol,
    diff,
    re,
    tan,
)
from sympy.matrices import MatrixBase

from derive.algebra.amplitudes import determinant_of
from derive.algebra.expressions import PLUS_MINUS, TIME, Relation, depends_on_time, explicit, rate
from derive.algebra.ordered_roots import OrderedRoot
from derive.algebra.samples import letters_of, value_at
from derive.algebra.tidy import tidied
from derive.mechanics.vibrations.facts import Linear, Mode, SquareOf
from derive.steps.claims import (
    always_sign,
    both,
    has_sign,
    is_a_root_just_where_told,
    lasts,
    negated,
    not_negative,
    nowhere_negative_where_real,
    same_equation,
    sign_where_it_exists,
    vanishes,
    vanishing,
)
from derive.steps.rule import Judged, Naming, Predicate, handed_on_by
from derive.steps.signs import sign_known
from derive.steps.step import is_zero
from derive.steps.trial_numbers import (
    TRIED,
    Point,
    as_rational,
    assumptions_about,
    everywhere,
    holds_at,
    just_where,
    roots_of,
    sign_at,
    signs,
    signs_of,
    trial_points,
)


def free_motion(wanted: str) -> Predicate:
    """Judge the kind of a free motion."""

    def is_so(facts: Judged) -> bool:
        a, b, c = facts.inputs["linear"]
        if is_zero(a):
            return wanted == ("accumulates" if is_zero(c) else _unless_it_grows("relaxes", c / b))
        if is_zero(c):
            return wanted == ("uniform" if is_zero(b) else _unless_it_grows("slows", b / a))
        stiffness, sign = sign_known(c / a), sign_known((b / a) ** 2 - 4 * c / a)
        if stiffness == -1:
            return wanted == "runs_away"
        if is_zero(b):
            return wanted == "oscillates" and stiffness == 1
        if not has_sign(b / a, 1):
            return wanted == "runs_away" and has_sign(b / a, -1) and sign in (0, 1)
        fitting = {-1: "underdamped", 0: "critically_damped", 1: "overdamped"}
        if wanted == "overdamped" and stiffness != 1:
            return False
        if sign is not None:
            return wanted == fitting[sign]
        return any(
            _is_its_condition(facts, s, (b / a) ** 2 - 4 * c / a) for s, word in fitting.items() if word == wanted
        )

    return is_so


def are_exponents(wanted: str) -> Predicate:
    """Judge the kind of motion, and whether the two values of the result are the two roots of a s^2 + b s + c."""
    kind = free_motion(wanted)

    def is_so(facts: Judged) -> bool:
        a, b, c = facts.inputs["linear"]
        both = [explicit(facts.result).xreplace({PLUS_MINUS: Integer(sign)}) for sign in (1, -1)]
        different = is_zero(both[0] - both[1]) == (wanted == "critically_damped")
        return bool(kind(facts)) and different and all(is_zero((a * s**2 + b * s + c).expand()) for s in both)

    return is_so


def is_general_motion(facts: Judged) -> bool:
    """Whether the motion satisfies a q_ddot + b q_dot + c q = f(t) for all values of its two constants, and any initial
    values determine these constants."""
    a, b, c = facts.inputs["linear"]
    motion, constants = explicit(facts.result).right, facts.inputs["constants"]
    first = diff(motion, TIME)
    fulfils = is_zero((a * diff(first, TIME) + b * first + c * motion - facts.inputs["driven"]).expand())
    at_start = Matrix([[diff(value.subs(TIME, 0), C) for C in constants] for value in (motion, first)])
    return facts.result.left == facts.inputs["q"] and fulfils and not is_zero(at_start.det())


def is_driving_term(changes: bool) -> Naming:
    """Check that the term is f(t) in the equation of motion. It must change with time if and only if `changes` is
    true."""

    def is_so(facts: Judged, term: Any) -> bool:
        return bool(term == facts.inputs["driven"]) and term != 0 and depends_on_time(term) == changes

    return is_so


def constants_as_told(facts: Judged, outcome: str) -> bool:
    """Whether the general motion becomes the result if the constants have the values that the sentence states; true if
    no step derives a general motion."""
    if "general" not in facts.quantities:
        return True
    values = {told.left: told.right for told in (facts.inputs["first"], facts.inputs["second"])}
    motion = explicit(facts.quantities["general"].value).right
    return values.keys() == {*facts.inputs["constants"]} and is_zero(motion.xreplace(values) - facts.result)


def _coefficients(facts: Judged) -> tuple[Expr, ...]:
    q, equation = facts.inputs["q"], explicit(facts.inputs["equation"])
    solved_for = facts.quantities["equation"].symbol
    residual = equation.residual if isinstance(equation, Relation) else solved_for - equation
    return tuple(diff(residual, s) for s in (rate(q, 2), rate(q), q))


def is_decay_rate(facts: Judged) -> bool:
    """Whether the value is half the coefficient of the rate, divided by the coefficient of the acceleration."""
    a, b, _ = _coefficients(facts)
    return is_zero(2 * a * explicit(facts.result) - b)


def is_frequency_without_damping(facts: Judged) -> bool:
    """Whether a omega^2 = c, where omega is the value, and a and c are the coefficients of the acceleration and of the
    coordinate."""
    a, _, c = _coefficients(facts)
    return is_zero(a * explicit(facts.result) ** 2 - c)


def is_frequency_with_damping(facts: Judged) -> bool:
    """Whether -b/(2 a) + i omega is a root of the characteristic equation."""
    a, b, c = _coefficients(facts)
    root = -b / (2 * a) + I * explicit(facts.result)
    return is_zero((a * root**2 + b * root + c).expand())


def _is_its_condition(facts: Judged, wanted: int, discriminant: Expr) -> bool:
    """Whether the stated condition holds if and only if the discriminant has the wanted sign."""
    condition = explicit(facts.inputs["condition"])
    if not same_equation(condition.residual, discriminant) or (condition.operator == "=") != (wanted == 0):
        return False
    letters = letters_of(condition.residual) | letters_of(discriminant)
    given = assumptions_about(letters)
    fits = wanted == 0 or just_where([condition], lambda point: sign_at(discriminant, point) == wanted, letters, *given)
    return wanted == 0 or condition.operator in (">", "<") and fits


def _unless_it_grows(word: str, rate: Expr) -> str | None:
    """Return `word` for a positive decay rate, "runs_away" for a negative one, and None if the sign is unknown."""
    return word if has_sign(rate, 1) else "runs_away" if has_sign(rate, -1) else None


def loses(wanted: bool) -> Predicate:
    return lambda facts: is_zero(facts.inputs["loss"]) != wanted


def dies_away(manner: str) -> Predicate:
    """Judge how a free displacement decays, from the sign of the discriminant of a s^2 + b s + c."""
    signs = {"oscillating": -1, "critical": 0, "creeping": 1, "unknown": None}

    def is_so(facts: Judged) -> bool:
        mass, loss, stiff = (facts.inputs[role] for role in ("mass", "loss", "stiff"))
        return has_sign(loss**2 - 4 * mass * stiff, signs[manner])

    return is_so


def in_step(*signs: int | None) -> Predicate:
    """Judge the phase of a motion without damping: c - a omega^2 must have one of the given signs."""
    return lambda facts: is_zero(facts.inputs["loss"]) and sign_known(facts.inputs["stiff"]) in signs


def square(facts: Judged, fact: SquareOf) -> bool:
    return isinstance(facts.symbol, Pow) and facts.symbol.base.name == fact.letter and facts.symbol.exp == 2


def mode(facts: Judged, fact: Mode) -> bool:
    """Whether the squared frequency is the root lambda, or minus lambda for a growing mode, and every column a
    satisfies (K - lambda M) a = 0."""
    root = fact.root
    squared = explicit(facts.result) ** 2
    if not is_zero(squared - root.value) and not (root.sign == -1 and is_zero(squared + root.value)):
        return False
    matrix = Matrix(facts.inputs["stiffness"]) - root.value * Matrix(facts.inputs["mass"])
    return all(is_zero((matrix * column).applyfunc(tidied)) for column in root.columns)


def linear(facts: Judged, fact: Linear) -> bool:
    """Whether the coefficients of the equation are a multiple of one row of the three matrices."""
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


LITTLE = 1e-9


S = Dummy("s")


def _of_equations(facts: Judged) -> tuple[Any, ...]:
    exists = facts.inputs.get("exists")
    letters = set().union(*(facts.inputs[role].free_symbols for role in MATRICES if role in facts.inputs))
    return letters, *([] if exists is None else [exists])


def _points(facts: Judged, tried: int = TRIED) -> list[Point]:
    return trial_points(*_of_equations(facts), tried=tried)


MATRICES = ("stiffness", "turning", "mass")


def _roots(facts: Judged, point: Point) -> list[complex]:
    """Return all distinct exponents s at a trial point."""
    return _roots_of(_exponents(facts, point))


def _exponents(facts: Judged, point: Point) -> Poly:
    """Return the polynomial in s whose roots are the exponents at a trial point."""
    return _polynomial_of(*(ImmutableDenseMatrix(facts.inputs[role].xreplace(dict(point))) for role in MATRICES))


@lru_cache(maxsize=128)
def _polynomial_of(stiffness: MatrixBase, turning: MatrixBase, mass: MatrixBase) -> Poly:
    k, g, m = (each.applyfunc(as_rational) for each in (stiffness, turning, mass))
    return Poly(determinant_of(ImmutableDenseMatrix(k + S * g + S**2 * m)), S)


_roots_of = lru_cache(maxsize=128)(roots_of)


def _is_among(value: complex, roots: list[complex]) -> bool:
    size = max(abs(root) for root in roots) + abs(value)
    return any(abs(value - root) <= LITTLE * size for root in roots)


def frequency(sign: int | None) -> Predicate:
    def is_so(facts: Judged) -> bool:
        def is_so_at(point: Point) -> bool:
            value = complex(value_at(explicit(facts.result), point))
            positive = abs(value.imag) <= LITTLE * abs(value) and value.real > 0
            required = sign is not None or all(holds_at(c, point) for c in facts.inputs["conditions"])
            exponent = value if sign == -1 else 1j * value
            return _is_among(exponent, _roots(facts, point)) and (positive or not required)

        return everywhere(_points(facts), is_so_at)

    return is_so


def free(facts: Judged) -> bool:
    return is_zero(facts.result) and everywhere(_points(facts), lambda point: _is_among(0j, _roots(facts, point)))


def _steady(facts: Judged, point: Point) -> bool:
    roots = _roots(facts, point)
    size = max(abs(root) for root in roots)
    return all(abs(root.real) <= LITTLE * size for root in roots)


def always(steady: bool) -> Predicate:
    return lambda facts: everywhere(_points(facts), lambda point: _steady(facts, point) == steady)


def depends(facts: Judged) -> bool:
    """Whether the stated conditions all hold at exactly those trial points at which no motion grows exponentially.

    The result must be one of the conditions.
    """
    told = just_where(facts.inputs["conditions"], lambda point: _steady(facts, point), *_of_equations(facts))
    return told and facts.result in facts.inputs["conditions"]


def is_among_conditions(facts: Judged, place: int) -> bool:
    """Whether there are several conditions, and the result is the condition with the index `place`."""
    conditions = facts.inputs["conditions"]
    return len(conditions) > 1 and bool(facts.result == conditions[place])


def moving(facts: Judged) -> list[Expr]:
    return [entry for entry in facts.result if not is_zero(entry)]


def _turning_at(facts: Judged, point: Point) -> int:
    """Return the sense of rotation just after the start: 1 if it is from the first to the second of the two moving
    coordinates, otherwise -1."""
    entries = [explicit(entry) for entry in moving(facts)]
    start, later = ([re(value_at(each.subs(TIME, t), point)) for each in entries] for t in (0, Rational(1, 10**6)))
    return 1 if start[0] * later[1] - start[1] * later[0] > 0 else -1


def sense(wanted: int | None, circle: bool) -> Predicate:
    def is_so(facts: Judged) -> bool:
        if len(moving(facts)) != 2:
            return False
        first, second = moving(facts)
        steady = is_zero(explicit(first**2 + second**2).diff(TIME))
        turns = wanted is None or everywhere(_points(facts), lambda point: _turning_at(facts, point) == wanted)
        return steady == circle and turns

    return is_so


def departing(facts: Judged) -> bool:
    """Whether all moving coordinates grow exponentially with the same positive rate."""
    rates = {tidied(entry.diff(TIME) / entry) for entry in map(explicit, moving(facts))}
    (rate, *others) = rates
    return not others and not depends_on_time(rate) and signs(rate, _points(facts)) == {1}


def straight(facts: Judged) -> bool:
    """Whether the ratios of the moving coordinates are constant, so that the motion is along a straight line."""
    first, *others = moving(facts)
    return all(is_zero((other / first).diff(TIME)) for other in others)


def sign_of_product(wanted: int) -> Predicate:
    def is_so(facts: Judged) -> bool:
        if len(facts.result) != 2:
            return False
        return signs(facts.result[0] * facts.result[1], _points(facts)) == {wanted}

    return is_so


def damped(sign: int | None) -> Predicate:
    """Judge whether -beta +- i omega are exponents of the motion; for the sign -1, whether -beta +- omega are
    exponents. Conditions must be stated if and only if `sign` is None, and must hold exactly where the result is real.
    """

    def is_so(facts: Judged) -> bool:
        def is_real(point: Point) -> bool:
            return sign_at(facts.result, point) is not None

        def is_root(point: Point) -> bool:
            beta, value = (complex(value_at(explicit(each), point)) for each in (facts.inputs["beta"], facts.result))
            turned, roots = value if sign == -1 else 1j * value, _roots(facts, point)
            return _is_among(-beta + turned, roots) and _is_among(-beta - turned, roots)

        conditions = facts.inputs["conditions"]
        as_told = bool(conditions) == (sign is None) and just_where(conditions, is_real, *_of_equations(facts))
        return as_told and everywhere(_points(facts), is_root)

    return is_so


def gyroscopic_rate(kind: str) -> Predicate:
    """Judge whether minus the result is an exponent s; a `decay` must be positive, a `growth` negative. For `critical`,
    the result must be positive, and minus the result must be a multiple root. For an `oscillator`, minus the result
    must be half the sum of two exponents."""

    def is_so(facts: Judged) -> bool:
        def is_so_at(point: Point) -> bool:
            value, roots = complex(value_at(explicit(facts.result), point)), _roots(facts, point)
            if kind == "oscillator":
                return _is_among(-value, [(a + b) / 2 for i, a in enumerate(roots) for b in roots[:i]])
            if kind == "critical":
                again = roots_of(_exponents(facts, point).diff(S))
                return value.real > 0 and _is_among(-value, roots) and _is_among(-value, again)
            return _is_among(-value, roots) and (value.real > 0) == (kind == "decay")

        return everywhere(_points(facts), is_so_at)

    return is_so


def has_turning(facts: Judged) -> bool:
    return not all(is_zero(entry) for entry in facts.inputs["turning"])


TINY = Rational(1, 10**15)
FEW = 5  # number of trial points at which a determinant is evaluated


def _polynomial(facts: Judged, point: Point) -> Poly:
    there = (facts.inputs[role].xreplace(dict(point)) for role in ("stiffness", "mass"))
    return _determinant(*map(ImmutableDenseMatrix, there))


@lru_cache(maxsize=64)  # each frequency and each shape of a system needs the same few determinants
def _determinant(stiffness: ImmutableDenseMatrix, mass: ImmutableDenseMatrix) -> Poly:
    unknown = Dummy("lambda")
    return Poly(determinant_of(stiffness - unknown * mass), unknown)


def _vanishes_at(polynomial: Poly, place: Expr) -> bool:
    value = polynomial.eval(place.evalf(40))
    size = sum((Abs(c * place.evalf(40) ** n) for (n,), c in polynomial.terms()), Integer(0))
    return bool(Abs(value) <= TINY * size)


def _is_root(square: Expr, facts: Judged, times: int | None) -> bool:
    """Whether det(K - lambda M) vanishes at lambda = `square`.

    times   1: the derivative must not vanish there; greater than 1: the derivative must vanish there; None: the
            derivative is not tested
    """

    def is_so(point: Point) -> bool:
        polynomial, place = _polynomial(facts, point), value_at(explicit(square), point)
        several = _vanishes_at(polynomial.diff(), place)
        return _vanishes_at(polynomial, place) and (times is None or several == (times > 1))

    return everywhere(_points(facts, FEW), is_so)


def modes_frequency(sign: int | None, repeated: bool) -> Predicate:
    def is_so(facts: Judged) -> bool:
        square = -(facts.result**2) if sign == -1 else facts.result**2
        decided = sign is None or signs(square, _points(facts)) == {sign}
        return decided and _is_not_negative(facts) and _is_root(square, facts, 2 if repeated else 1)

    return is_so


def moves_by_itself(sign: int | None) -> Predicate:
    """Judge the frequency of coordinates that are not coupled to any other: K_ii = omega^2 M_ii for each of them, or
    K_ii = -omega^2 M_ii for a growing motion, and all other entries in their rows and columns vanish."""

    def is_so(facts: Judged) -> bool:
        stiffness, turning, mass = (Matrix(facts.inputs[role]) for role in MATRICES)
        square = -(facts.result**2) if sign == -1 else facts.result**2
        own = facts.inputs["own"]
        fits = all(_is_uncoupled(facts, i) and turning[i, i] == 0 for i in own)
        roots = all(is_zero(stiffness[i, i] - explicit(square) * mass[i, i]) for i in own)
        decided = sign is None or signs(square, _points(facts)) == {sign}
        return bool(own) and fits and roots and decided and _is_not_negative(facts)

    return is_so


def _is_uncoupled(facts: Judged, i: int) -> bool:
    matrices = [Matrix(facts.inputs[role]) for role in MATRICES]
    others = [j for j in range(matrices[0].shape[0]) if j != i]
    return all(is_zero(each[i, j]) and is_zero(each[j, i]) for each in matrices for j in others)


def oscillates_by_itself(facts: Judged, displacement: Any) -> bool:
    """Whether the displacement is not coupled to any other, and oscillates at all trial points."""
    i = facts.inputs["displacements"].index(displacement)
    stiffness, turning, mass = (Matrix(facts.inputs[role])[i, i] for role in MATRICES)
    return _is_uncoupled(facts, i) and turning == 0 and signs(stiffness / mass, _points(facts)) == {1}


def uncoupled_as_told(facts: Judged, outcome: str) -> bool:
    """Whether the word for the coupling is correct, and the sentence names the equations of the coordinates `own`."""
    coupling, own = facts.words["coupling"], list(facts.inputs["own"])
    every = range(Matrix(facts.inputs["mass"]).shape[0])
    if (coupling != "others") != all(_is_uncoupled(facts, i) for i in every):
        return False
    named = [q for role, q in facts.quantities.items() if role.startswith("equation")]
    displaced = next([s.symbol for s in f.displacements] for f in named[0].facts if hasattr(f, "displacements"))
    right = [_in_equation(each) for each in named] == [{displaced[i]} for i in own]
    return right and (coupling == "all") == (len(own) == len(every))


def is_coordinate_of_the_equation(facts: Judged, q: Any) -> bool:
    return bool(facts.inputs["coordinates"][facts.inputs["own"][0]] == q)


def is_in_order(whole: bool) -> Predicate:
    """Judge whether the square of the result is a root of the determinant, numbered correctly in ascending order.

    whole   whether all roots of the determinant are numbered, or only the roots of one of its factors
    """

    def is_so(facts: Judged) -> bool:
        square = facts.result**2
        if not isinstance(square, OrderedRoot):
            return False
        place, size = int(str(square.name).rpartition("_")[2]), facts.inputs["stiffness"].shape[0]
        unknown = Dummy("lambda")

        def is_so_at(point: Point) -> bool:
            factor = Poly([each.xreplace(dict(point)) for each in square.args[0]], unknown)
            below = Rational(str(value_at(explicit(square), point) * (1 - TINY)))
            own = _polynomial(facts, point) if whole else factor
            return bool(own.count_roots(sup=below) == place - 1 and (factor.degree() == size) == whole)

        in_order = everywhere(_points(facts, FEW), is_so_at)
        return in_order and _is_root(square, facts, 1) and signs(square, _points(facts)) == {1}

    return is_so


def _is_not_negative(facts: Judged) -> bool:
    """Whether the frequency is never negative, and never a negative multiple of the imaginary unit."""
    points = _points(facts)
    return -1 not in signs(facts.result, points) | signs(facts.result / I, points)


def of_pair(same: bool) -> Predicate:
    def is_so(facts: Judged) -> bool:
        if len(facts.result) != 2:
            return False
        product = facts.result[0] * facts.result[1]
        return signs(product, _points(facts)) == {1 if same else -1} and oscillates(facts)

    return is_so


def alone(facts: Judged) -> bool:
    moving = [entry for entry in facts.result if not is_zero(entry)]
    return len(facts.result) == 2 and len(moving) == 1 and oscillates(facts)


def oscillates(facts: Judged) -> bool:
    return not is_zero(facts.inputs["squared"]) and always_sign(-1, lambda f: f.inputs["squared"])(facts) is False


def repeated(facts: Judged) -> bool:
    return _is_root(facts.inputs["squared"], facts, 2)


def _displaced(facts: Judged) -> bool:
    return any(not is_zero(value) for value in facts.inputs["place"])


def modes_linear(displaced: bool, lossy: bool | None, driven: bool) -> Predicate:
    """Judge three statements. Each of them must be true if and only if its argument is true.

    displaced   whether an equilibrium value of some coordinate is not zero
    lossy       whether there is drag; None if this is not judged
    driven      whether the right side of the equation is not zero
    """

    def is_so(facts: Judged) -> bool:
        found = _displaced(facts), not is_zero(facts.inputs["loss"]), not is_zero(facts.result.right)
        letters = facts.inputs["displacements"]
        if len(letters) == 1 and explicit(facts.result).left.has(rate(*letters)) != found[1]:
            return False  # for one coordinate, drag is a term with the rate
        return found[0] == displaced and found[2] == driven and lossy in (None, found[1])

    return is_so


def drifts_as_told(facts: Judged, outcome: str) -> bool:
    """If the sentence states that no force acts to any order, whether a uniform motion satisfies the equations;
    otherwise True."""
    if "drift" not in facts.inputs:
        return True
    points = trial_points(set().union(*map(letters_of, facts.inputs["left"])))
    return bool(facts.inputs["left"]) and all(signs(each, points) == {0} for each in facts.inputs["left"])


def _of_square(sign: int | None, of: Callable[[Judged], Expr] = lambda facts: facts.inputs["squared"]) -> Predicate:
    """Judge whether an expression has the sign `sign`, which is None for an unknown sign. The signs 1 and -1 are tested
    with numbers for which the equilibrium exists, and 0 and None with the assumptions and ranges of the symbols."""
    return sign_where_it_exists(sign, of) if sign else always_sign(sign, of)


def rate_of_square(sign: int | None, turned: int) -> Predicate:
    """Judge the sign of the squared frequency, and whether the square of the result is `turned` times the squared
    frequency.

    turned   1 for an oscillation, -1 for a growing motion
    """
    judged = _of_square(sign)
    return lambda facts: judged(facts) and is_zero(explicit(facts.result) ** 2 - turned * facts.inputs["squared"])


SIGNS: dict[str, Predicate] = {
    word: _of_square(sign, lambda facts: facts.result)
    for word, sign in (("stable", 1), ("unstable", -1), ("neutral", 0), ("conditional", None))
}


def oscillates_exactly(facts: Judged, q: Any) -> bool:
    """Whether the equation of motion, with all its terms, describes a harmonic oscillator with this frequency."""
    left = facts.inputs["left"]
    inertia = diff(left, rate(q, 2))
    return not inertia.has(q, rate(q)) and is_zero(left - inertia * (rate(q, 2) + explicit(facts.result) ** 2 * q))


def alone_in_its_equation(facts: Judged, q: Any) -> bool:
    motion = facts.quantities["motion"]
    return {s for s in motion.coordinates if explicit(motion.value).residual.has(s, rate(s), rate(s, 2))} == {q}


def small_function(of: Callable[[Any], Any]) -> Naming:
    def is_so(facts: Judged, value: Any) -> bool:
        motion = explicit(facts.quantities["motion"].value).residual
        return bool(value == of(facts.inputs["alone"])) and motion.has(value)

    return is_so


def nothing_is_left(facts: Judged, drift: Any) -> bool:
    """Whether a uniform motion along the zero mode satisfies the full equations of motion."""
    left = facts.inputs["left"]
    return drift == 0 and bool(left) and all(is_zero(explicit(each)) for each in left)


def root_under_the_sign(facts: Judged, name: Any) -> bool:
    """Whether the square of the result is a numbered root, and the sentence names root number 1, the smallest root."""
    square = facts.result**2
    return isinstance(square, OrderedRoot) and str(name) == f"{str(square.name).rpartition('_')[0]}_1"


def momentum_there(facts: Judged, relation: Any) -> bool:
    """Whether the relation gives the value of a momentum in the steady motion, or the value of a symbol in a given
    momentum."""
    steady = next((f for f in facts.quantities["where"].facts if hasattr(f, "conditions")), None)
    behind = list(facts.quantities["potential"].ancestors())
    if steady is None or relation.operator != "=":
        return False
    kept = [dict(e.step.roles) for e in behind if e.step.rule == "lagrange.value_kept"]
    values = {roles["momentum"]: explicit(roles["value"]) for roles in kept}
    stated = {relation.left: explicit(relation.right)}
    for letter, value in {**values, relation.left: relation.left}.items():
        momenta = [e for e in behind if e.symbol == letter]
        if not momenta or not value.has(relation.left):
            continue
        moving = {rate(s): Integer(0) for s in momenta[0].coordinates}
        moving |= {rate(s): v for s, v in steady.rates.items()} | dict(steady.values)
        found = next((e for e in momenta if not isinstance(e.value, Symbol)), momenta[0])
        return is_zero(explicit(found.value).subs(moving, simultaneous=True) - value.xreplace(stated))
    return False


def there_where_it_exists(facts: Judged, exists: Any) -> bool:
    place = explicit(facts.quantities["where"].value)
    inputs = {"positive": Integer(0), "condition": exists}
    return isinstance(place, MatrixBase) or is_a_root_just_where_told(Judged(place, inputs))


def taken_out(facts: Judged, relation: Any) -> bool:
    """Whether the symbol on the left side of the relation occurs in the condition but not in the result."""
    if relation.operator != "=":
        return False
    held = explicit(facts.quantities["where"].value).free_symbols
    return relation.left in held and relation.left not in explicit(facts.result).free_symbols


def trial(unit: Any, role: str) -> Naming:
    """Check that the trial function starts at 1, and that its rate is the product of the function, `unit` and the
    exponent."""

    def is_so(facts: Judged, value: Any) -> bool:
        return value.subs(TIME, 0) == 1 and is_zero(diff(value, TIME) - unit * facts.inputs[role] * value)

    return is_so


def oscillator(facts: Judged, equation: Any) -> bool:
    """Whether the stated equation, with the result in place of omega_0^2 and multiplied by the inertia, is the linear
    equation."""
    linear = explicit(facts.quantities["linear"].value).residual
    inertia = explicit(facts.inputs.get("inertia", Integer(1)))
    there = equation.left.doit().subs(facts.symbol, explicit(facts.result))
    return is_zero(linear - inertia * there)


def divided_by(facts: Judged, inertia: Any) -> bool:
    q = facts.inputs["q"]
    return is_zero(diff(explicit(facts.quantities["linear"].value).residual, rate(q, 2)) - explicit(inertia))


def its_acceleration(facts: Judged, letter: Any) -> bool:
    return bool(letter == rate(facts.inputs["q"], 2)) and explicit(facts.quantities["linear"].value).has(letter)


def moves_alone(facts: Judged, letter: Any) -> bool:
    moved = [s for s, a in zip(facts.inputs["displacements"], facts.result, strict=True) if not is_zero(a)]
    return bool(moved[0] == letter)


def coupled_only_to_each_other(facts: Judged, outcome: str) -> bool:
    """Whether the equations that the sentence names are coupled to each other and to no other coordinate."""
    named = [q for role, q in facts.quantities.items() if role.startswith("equation_")]
    return not named or _are_one_group(named)


def _in_equation(equation: Any) -> set[Any]:
    displaced = next(f.displacements for f in equation.facts if hasattr(f, "displacements"))
    present = explicit(equation.value).residual.free_symbols
    return {s.symbol for s in displaced if present & {s.symbol, s.rate, s.acceleration}}


def _are_one_group(equations: Sequence[Any]) -> bool:
    """Whether the equations contain as many displacements as there are equations, and any two of the equations are
    coupled, directly or through others."""
    contained = list(map(_in_equation, equations))
    group = contained.pop(0)
    while near := [each for each in contained if each & group]:
        group = group.union(*near)
        contained = [each for each in contained if each not in near]
    return not contained and len(group) == len(equations)


def moves_so(facts: Judged, displacements: Any) -> bool:
    """Whether the stated motions of the displacements satisfy the linear equation that the sentence names."""
    equation = explicit(facts.quantities["linear"].value).residual
    motion: dict[Any, Any] = {}
    for s, course in zip(explicit(displacements), explicit(facts.result), strict=True):
        motion |= {rate(s, n) if n else s: diff(course, TIME, n) for n in range(3)}
    return is_zero(equation.xreplace(motion))


def moves_as(which: int) -> Naming:
    def is_so(facts: Judged, letter: Any) -> bool:
        told = zip(explicit(facts.inputs["displacements"]), explicit(facts.result), strict=True)
        return bool([s for s, course in told if not is_zero(course)][which] == letter)

    return is_so


def starts_as_told(facts: Judged, outcome: str) -> bool:
    """Whether the motion has the stated value and rate at the start."""
    if not _of_an_equation(facts, outcome):
        return False
    told, q = [facts.inputs[role] for role in ("start", "start_rate") if role in facts.inputs], facts.inputs["q"]
    at = [diff(facts.result, TIME, n).subs(TIME, 0) for n in range(len(told))]
    named = [(q, "="), (rate(q), "=")][: len(told)] == [(each.left, each.operator) for each in told]
    return named and all(is_zero(value - each.right) for value, each in zip(at, told, strict=True))


def starts_as_all_are_told(facts: Judged, outcome: str) -> bool:
    """Whether the coordinate and its rate have the stated values at the start. A value that is not stated must be zero,
    and the sentence must say that all others are zero."""
    q = facts.inputs["coordinate"]
    told = {each.left: each.right for role, each in facts.inputs.items() if role.startswith("start_")}
    at_start = {q: facts.result.subs(TIME, 0), rate(q): diff(facts.result, TIME).subs(TIME, 0)}
    others_zero = facts.words["seen"] == "others_zero"
    return all(
        is_zero(value - told[s]) if s in told else others_zero and is_zero(value) for s, value in at_start.items()
    )


def taken_out_by_its_condition(facts: Judged, outcome: str) -> bool:
    """Whether the condition holds with the stated value of the eliminated symbol; true if no symbol is eliminated."""
    told, where = facts.inputs.get("taken_out"), facts.quantities["where"].value
    if told is None or not isinstance(where, Relation):
        return True
    return is_zero(explicit(where).residual.subs(told.left, told.right))


def _of_an_equation(facts: Judged, outcome: str) -> bool:
    """Whether `q` is a symbol, and the input `equation` is either a relation or the value of the rate or the
    acceleration of `q`."""
    q, found = facts.inputs["q"], facts.quantities.get("equation")
    solved_for = isinstance(q, Symbol) and found is not None and found.symbol in (rate(q), rate(q, 2))
    return isinstance(q, Symbol) and (isinstance(facts.inputs["equation"], Relation) or solved_for)


def swings_of_its_equation(facts: Judged, outcome: str) -> bool:
    return not_negative(facts, outcome) and _of_an_equation(facts, outcome)


def positive_where_real(facts: Judged, outcome: str) -> bool:
    """Whether the frequency is not negative at any trial point at which it is real."""
    return nowhere_negative_where_real(facts)


def somewhere_positive(facts: Judged, outcome: str) -> bool:
    """Whether the second frequency is greater than the first for some trial numbers, and not known to be smaller."""
    return not_negative(facts, outcome) and 1 in signs_of(explicit(facts.result))


def lag_as_written(facts: Judged, outcome: str) -> bool:
    """Whether the result is the tangent of the lag with damping, and the lag itself without damping."""
    return (getattr(facts.symbol, "func", None) is tan) == (outcome == "damped")


gyroscopic_characteristic_plain: Predicate = negated(has_turning)


def gyroscopic_motion_generic(facts: Judged) -> bool:
    return bool(len(moving(facts)) > 2)


def gyroscopic_stability_depends(facts: Judged) -> bool:
    return bool(depends(facts) and len(facts.inputs["conditions"]) == 1)


def gyroscopic_stability_first(facts: Judged) -> bool:
    return bool(depends(facts) and is_among_conditions(facts, 0))


def gyroscopic_stability_further(facts: Judged) -> bool:
    return bool(depends(facts) and facts.result in facts.inputs["conditions"][1:-1])


def gyroscopic_stability_last(facts: Judged) -> bool:
    return bool(depends(facts) and is_among_conditions(facts, -1))


def damped_characteristic_one(facts: Judged) -> bool:
    return bool(Poly(facts.result.left, facts.inputs["exponent"]).degree() == 2)


def damped_characteristic_several(facts: Judged) -> bool:
    return bool(Poly(explicit(facts.result.left), facts.inputs["exponent"]).degree() > 2)


def damped_shape_generic(facts: Judged) -> bool:
    return bool(len(facts.result) > 1)


mode_shape_generic: Predicate = both(oscillates, negated(repeated))


mode_shape_uniform: Predicate = vanishing("squared")


mode_shape_departing: Predicate = always_sign(-1, lambda facts: facts.inputs["squared"])


frequency_squared_about_neutral: Predicate = vanishes


frequency_squared_about_conditional: Predicate = lasts


handed_on_by(SquareOf, square)
handed_on_by(Mode, mode)
handed_on_by(Linear, linear)
