"""The general motion of one coordinate with the equation a q_ddot + b q_dot + c q = f(t).

The trial q = e^(s t) gives a s^2 + b s + c = 0. The two roots give two free motions. The general motion is the sum of
these free motions, each multiplied by a constant, and of a particular motion. The initial values determine the
constants.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sympy import Add, Expr, I, Integer, Mul, Symbol, cos, cosh, diff, exp, expand, sin, sinh, sqrt

from derive.algebra.expressions import PLUS_MINUS, TIME, Relation, Terms, depends_on_time, explicit, scalar
from derive.algebra.kinds import dimension_of_kind, kind_of_dimension
from derive.algebra.length import shortest
from derive.algebra.taylor import slope
from derive.algebra.tidy import tidied
from derive.mechanics.kinematics.coordinates import Coordinate
from derive.mechanics.vibrations import claims
from derive.solving.relations import conditions_told
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.level import Manner
from derive.steps.natural import Proposal
from derive.steps.record import given_letters, is_taken, result_called, results_of
from derive.steps.rule import CHECK, ROUTE, Rule, Shown
from derive.steps.step import Quantity

ZERO, ONE = Integer(0), Integer(1)
LETTERS_OF_EXPONENT = ("s", "lambda", "sigma", "p")
LETTERS_OF_CONSTANTS = (("A", "B"), ("C", "D"), ("C_1", "C_2"))
LETTERS = {scalar(name) for pair in LETTERS_OF_CONSTANTS for name in pair}
BY_EXPONENTS = ("underdamped", "critically_damped", "overdamped", "runs_away")
TERM = {"driving": claims.is_driving_term(True), "constant": claims.is_driving_term(False)}
EXPLAINS = Shown(brief=Manner.LEFT_OUT, only_explains=True)


@dataclass(frozen=True)
class LinearCoefficients:
    """The coefficients of a q_ddot + b q_dot + c q = f(t)."""

    a: Expr
    b: Expr
    c: Expr
    driven: Expr

    @property
    def discriminant(self) -> Expr:
        return tidied(self.b**2 - 4 * self.a * self.c)

    @property
    def order(self) -> int:
        return 2 if self.a != 0 else 1

    def at(self, s: Expr) -> Expr:
        """Return the characteristic polynomial a s^2 + b s + c."""
        return self.a * s**2 + self.b * s + self.c

    def residual(self, motion: Expr) -> Expr:
        """Return the residual of the equation for the motion q(t)."""
        first = diff(motion, TIME)
        return self.a * diff(first, TIME) + self.b * first + self.c * motion - self.driven


@dataclass(frozen=True)
class Sought:
    """A linear equation whose motion is to be found.

    sort        the kind of motion, an outcome of `solution`
    condition   the condition for this kind, if the symbols do not determine the kind
    excluded    the condition against resonance, if there is one
    particular  a motion under the driving force, or 0 without a driving force
    proposals   the usual constants of an oscillator
    """

    equation: Quantity
    q: Coordinate
    linear: LinearCoefficients
    sort: str
    condition: Relation | None
    excluded: Relation | None
    particular: Expr
    proposals: Sequence[Proposal]

    @property
    def coefficients(self) -> dict[str, Any]:
        """The data with which an outcome is judged."""
        linear = self.linear
        return {"linear": (linear.a, linear.b, linear.c), "driven": linear.driven}

    @property
    def key(self) -> str:
        """The beginning of the keys of the steps that lead to the motion."""
        return f"{self.equation.key}_{self.sort}" if self.condition is not None else self.equation.key

    def put_back(self, motion: Expr) -> Expr:
        return put_back(self.equation, self.q, motion)

    def driving(self) -> dict[str, Expr]:
        """The term f(t) for a sentence that mentions it, as `driving` or, if f is constant, as `constant`."""
        driven = self.linear.driven
        return {} if driven == 0 else {"driving" if depends_on_time(driven) else "constant": driven}


@dataclass(frozen=True)
class GeneralMotion:
    """The step with the general motion, and the two constants of this motion."""

    step: Quantity
    constants: tuple[Symbol, Symbol]

    def told(self, motion: Expr, basis: Sequence[Expr], particular: Expr, values: Sequence[Expr]) -> dict[str, Any]:
        """Return two values of each constant: the given value, and the value from the motion by Cramer's rule."""
        one, other = basis
        free = motion - particular
        at = [explicit(each).subs(TIME, 0) for each in (one, other, free, *(diff(f, TIME) for f in (one, other, free)))]
        u, v, f, u_rate, v_rate, f_rate = at
        whole = u * v_rate - v * u_rate
        again = (f * v_rate - v * f_rate) / whole, (u * f_rate - f * u_rate) / whole
        given = zip(("first", "second"), self.constants, values, again, strict=True)
        return {role: (Relation(C, "=", value), Relation(C, "=", twice)) for role, C, value, twice in given}


def put_back(equation: Quantity, q: Coordinate, motion: Expr) -> Expr:
    """Substitute a motion q(t) into the original form of an equation, and return the residual."""
    state = (q.symbol, q.rate, q.acceleration)
    value = explicit(equation.value)
    left = value.residual if isinstance(value, Relation) else equation.symbol - value
    first = slope(motion, TIME)
    return expand(left.xreplace(dict(zip(state, (motion, first, slope(first, TIME)), strict=True))))


def basis_of(linear: LinearCoefficients, sort: str) -> list[Expr]:
    """Return the independent free motions: one for an equation of first order, otherwise two."""
    a, b, c, t = linear.a, linear.b, linear.c, TIME
    if linear.order == 1:
        return [exp(tidied(-c / b) * t)]
    if sort == "uniform":
        return [ONE, t]
    if c == 0:
        return [ONE, exp(tidied(-b / a) * t)]
    decay = exp(tidied(-b / (2 * a)) * t)
    if sort == "critically_damped":
        return [decay, t * decay]
    half = _half_difference(linear, sort)
    if sort in ("oscillates", "underdamped"):
        return [decay * cos(half * t), decay * sin(half * t)]
    if b == 0:
        return [cosh(half * t), sinh(half * t)]
    return [exp((tidied(-b / (2 * a)) + half) * t), exp((tidied(-b / (2 * a)) - half) * t)]


def _half_difference(linear: LinearCoefficients, sort: str) -> Expr:
    """Return half the difference of the two roots, divided by i if the roots are complex."""
    sign = -1 if sort in ("oscillates", "underdamped") else 1
    return _root_over(sign * linear.discriminant, 2 * linear.a)


def _root_over(inside: Expr, below: Expr) -> Expr:
    """Return sqrt(inside)/below in its shortest form, with one root as in sqrt(k/m - b^2/(4 m^2)) or with a
    quotient."""
    forms = [tidied(sqrt(inside) / below), sqrt(tidied(inside / below**2)), sqrt(expand(inside / below**2))]
    return shortest(forms)


def general_motion(sought: Sought) -> GeneralMotion | None:
    """Return the general motion, with the steps that lead to this motion. Return None for an equation of first order or
    with c = 0, because its motion is found without these steps."""
    if sought.sort != "oscillates" and (sought.sort not in BY_EXPONENTS or 0 in (sought.linear.a, sought.linear.c)):
        return None
    known = _known(sought, f"{sought.key}_general", HARMONIC_MOTION, GENERAL_MOTION)
    if known is not None:
        first, second = (letter for letter, _ in known.step.coordinates if letter in LETTERS)
        return GeneralMotion(known, (first, second))
    constants = _constants_for(sought.equation)
    free = _free_with(constants, sought.linear, sought.sort)
    if sought.sort == "oscillates":
        return GeneralMotion(_harmonic(sought, free, constants), constants)
    characteristic = _known(sought, f"{sought.equation.key}_characteristic", CHARACTERISTIC_POLYNOMIAL)
    exponents = _exponents(sought, characteristic or _characteristic(sought))
    return GeneralMotion(_general(sought, exponents, free, constants), constants)


def _known(sought: Sought, key: str, *rules: Rule) -> Quantity | None:
    """Return a step that an earlier motion of the same equation needed, or None."""
    found = (each for each in results_of(*(rule.name for rule in rules)) if each.key == key)
    return next((each for each in found if sought.equation in each.parents), None)


def _free_with(constants: tuple[Symbol, Symbol], linear: LinearCoefficients, sort: str) -> Expr:
    A, B = constants
    decay, half, t = exp(tidied(-linear.b / (2 * linear.a)) * TIME), _half_difference(linear, sort), TIME
    if sort == "critically_damped":
        inside = A + B * t
    elif sort in ("oscillates", "underdamped"):
        inside = A * cos(half * t) + B * sin(half * t)
    elif linear.b == 0:
        inside = A * cosh(half * t) + B * sinh(half * t)
    else:
        inside = A * exp(half * t) + B * exp(-half * t)
    return Mul(decay, inside, evaluate=False) if decay != 1 else inside


def _constants_for(equation: Quantity) -> tuple[Symbol, Symbol]:
    """Return two symbols for the constants of a motion, if possible unused ones."""
    used = {s.name for s in explicit(equation.value).free_symbols}
    pairs = (pair for pair in LETTERS_OF_CONSTANTS if not any(is_taken(name) or name in used for name in pair))
    first, second = next(pairs, LETTERS_OF_CONSTANTS[-1])
    return scalar(first), scalar(second)


CHARACTERISTIC_POLYNOMIAL = Rule(
    "vibrations.characteristic_polynomial",
    source="Taylor, *Classical Mechanics*, section 5.4",
    evidence={"trial": ROUTE},
    named={"trial": claims.trial(1, "exponent"), **TERM},
    shown=EXPLAINS,
)


def _characteristic(sought: Sought) -> Quantity:
    """Characteristic equation of one linear equation, a s^2 + b s + c = 0.

    Source: Taylor, *Classical Mechanics*, section 5.4.
    """
    s = scalar(next(filter(_may_be_exponent, LETTERS_OF_EXPONENT), "s_0"))

    linear = sought.linear
    terms = [s**2, tidied(linear.b / linear.a) * s, tidied(linear.c / linear.a)]
    left = Relation(Terms(*(term for term in terms if term != 0)), "=", 0)

    def by_trial(found: Relation) -> tuple[Relation, Relation]:
        motion = exp(s * TIME)
        free = ((sought.put_back(motion) - sought.put_back(ZERO)) / motion).expand()
        return found, Relation((free / free.coeff(s, 2)).expand(), "=", 0)

    return establish(
        CHARACTERISTIC_POLYNOMIAL,
        None,
        lambda *_: left,
        {"exponent": s, "q": sought.q.symbol},
        lines=Lines(put_in=None, result=False, arranged=lambda _: left),
        routes={"trial": by_trial},
        phrase_data=PhraseData(
            named={"trial": exp(s * TIME), **sought.driving()},
            points_to={"equation": sought.equation},
            outcome_data=sought.coefficients,
        ),
        key=f"{sought.equation.key}_characteristic",
        parents=[sought.equation],
        scope=Scope(coordinates={s: "angular speed"}),
        proposals=sought.proposals,
    )


def _may_be_exponent(name: str) -> bool:
    """Whether this symbol denotes nothing on the page, or only the exponents of another motion."""
    known = result_called(name)
    return name not in given_letters() and (known is None or known.step.rule == EXPONENTS.name)


EXPONENTS = Rule(
    "vibrations.exponents",
    source="Taylor, *Classical Mechanics*, section 5.4",
    outcomes={word: claims.are_exponents(word) for word in BY_EXPONENTS},
    evidence={"put_back": CHECK, "sum": CHECK},
    shown=EXPLAINS,
)


def _exponents(sought: Sought, characteristic: Quantity) -> Quantity:
    """Roots of the characteristic equation, s = -b/(2 a) +- sqrt(b^2 - 4 a c)/(2 a).

    Outcomes: underdamped, critically_damped, overdamped, runs_away.
    Source: Taylor, *Classical Mechanics*, section 5.4.
    """
    linear, sort = sought.linear, sought.sort
    present = characteristic.value.free_symbols  # a coordinate of the system with the name s is not among them
    (s,) = (q for q in characteristic.coordinates if q in present and q.name in (*LETTERS_OF_EXPONENT, "s_0"))
    middle = tidied(-linear.b / (2 * linear.a))
    unit = {"critically_damped": ZERO, "underdamped": I}.get(sort, ONE)
    apart = PLUS_MINUS * unit * _half_difference(linear, sort)
    value = Terms(middle, apart) if unit != 0 and middle != 0 else middle + apart

    def both(found: Expr) -> list[Expr]:
        return [explicit(found).xreplace({PLUS_MINUS: Integer(sign)}) for sign in (1, -1)]

    def at_both(found: Expr) -> tuple[Expr, Expr]:
        weight = scalar("u_mark")
        return Add(*(w * linear.at(each).expand() for w, each in zip((ONE, weight), both(found), strict=True))), ZERO

    return establish(
        EXPONENTS,
        s,
        lambda *_: value,
        {},
        lines=Lines(put_in=None, result=False, arranged=lambda value: value),
        routes={"put_back": at_both, "sum": lambda found: (Add(*both(found)), -linear.b / linear.a)},
        outcome=sort,
        phrase_data=PhraseData(
            formulas=conditions_told(condition=sought.condition),
            points_to={"characteristic": characteristic},
            outcome_data={**sought.coefficients, "case": sought.condition is not None},
        ),
        key=f"{sought.key}_exponents",
        kind="angular speed",
        parents=[characteristic],
        scope=Scope(coordinates={s: "angular speed"}),
        proposals=sought.proposals,
    )


GENERAL_MOTION = Rule(
    "vibrations.general_motion",
    source="Taylor, *Classical Mechanics*, section 5.4",
    outcomes={"generic": claims.is_general_motion},
    evidence={"put_back": CHECK},
    named=TERM,
    shown=EXPLAINS,
)
HARMONIC_MOTION = Rule(
    "vibrations.harmonic_motion",
    source="Taylor, *Classical Mechanics*, section 5.2",
    outcomes={"generic": claims.is_general_motion},
    evidence={"put_back": CHECK},
    named=TERM,
    shown=Shown(brief=Manner.LEFT_OUT, only_explains=True, first_only=True),
)


def _general(sought: Sought, exponents: Quantity, free: Expr, constants: tuple[Symbol, Symbol]) -> Quantity:
    """General motion, from the roots of the characteristic equation.

    Source: Taylor, *Classical Mechanics*, section 5.4.
    """
    motion = Relation(sought.q.symbol, "=", sought.particular + free)
    given = _of_motion(sought, constants, [exponents])
    return establish(GENERAL_MOTION, None, lambda *_: motion, {"q": sought.q.symbol}, **given)


def _harmonic(sought: Sought, free: Expr, constants: tuple[Symbol, Symbol]) -> Quantity:
    """General motion of a harmonic oscillator, q = A cos(omega t) + B sin(omega t).

    Source: Taylor, *Classical Mechanics*, section 5.2.
    """
    motion = Relation(sought.q.symbol, "=", sought.particular + free)
    given = _of_motion(sought, constants, [])
    return establish(HARMONIC_MOTION, None, lambda *_: motion, {"q": sought.q.symbol}, **given)


def _of_motion(sought: Sought, constants: tuple[Symbol, Symbol], parents: Sequence[Quantity]) -> dict[str, Any]:
    """Return the arguments of `establish` for a general motion."""
    return {
        "lines": Lines(put_in=None, result=False, arranged=explicit),
        "routes": {"put_back": lambda found: (sought.put_back(explicit(found).right), ZERO)},
        "phrase_data": PhraseData(
            named=sought.driving(),
            formulas=conditions_told(excluded=sought.excluded),
            points_to={"equation": sought.equation},
            outcome_data={**sought.coefficients, "constants": constants},
        ),
        "key": f"{sought.key}_general",
        "parents": [sought.equation, *parents],
        "scope": Scope(coordinates=_kinds_of_constants(sought, constants)),
        "proposals": sought.proposals,
    }


def _kinds_of_constants(sought: Sought, constants: tuple[Symbol, Symbol]) -> Mapping[Symbol, str]:
    """Return the kinds of the constants; in (A + B t) e^(-b t/(2 a)) the constant B has the kind of a rate."""
    own = sought.q.kind
    rate = kind_of_dimension(dimension_of_kind(own) / dimension_of_kind("time"))
    return dict(zip(constants, (own, (rate or "") if sought.sort == "critically_damped" else own), strict=True))
