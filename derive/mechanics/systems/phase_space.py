"""Coordinates and their momenta: letters, the rates that belong to momenta, and how functions of them are written.

A momentum p_q is a plain name beside its coordinate q. In phase space both are free, so both count as coordinates of
what depends on them; as functions of coordinates and rates momenta are values, m l^2 theta_dot.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, permutations, product

from sympy import (
    Add,
    Dummy,
    Expr,
    ImmutableDenseMatrix,
    Integer,
    Matrix,
    Mul,
    Pow,
    Rational,
    Symbol,
    cos,
    expand,
    factor,
    factor_terms,
    sin,
    together,
)
from sympy.polys.polyerrors import PolynomialError
from sympy.simplify.fu import TR5, TR6

from derive.algebra.collect import by_rates, spread, with_weights_in_front
from derive.algebra.derivatives import derivative
from derive.algebra.expressions import Partial, Terms, bound, explicit, rate, scalar
from derive.algebra.kinds import dimension_of_kind, kind_of_dimension
from derive.algebra.length import length
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected
from derive.mechanics.systems.coordinates import Coordinate, OfCoordinate, coordinate, required
from derive.mechanics.systems.dalembert import Matter
from derive.mechanics.systems.inverted_momenta import by_quadratic_form, roots_together
from derive.mechanics.systems.lagrangian import FromLagrangian, coordinates_of, energies_of
from derive.steps.establish import Lines, PhraseData, Scope, establish
from derive.steps.known_numbers import told_of_divisors
from derive.steps.step import Fact, Form, Quantity, compared_with, lettered

__all__ = ["conjugate", "conjugate_momentum", "momenta", "rates_by_momenta"]

LARGEST = 4  # momenta that are solved together for rates
LARGEST_WITH_ANGLES = 2  # where sines and cosines couple them: the Hamiltonian of three is a page long
LONGEST_SQUARED = 120  # operations of a quadratic form whose squares are completed
ZERO = Integer(0)


@dataclass(frozen=True)
class PhaseSpace(Fact):
    """What is a function of coordinates and momenta, and the Lagrangian whose momenta they are."""

    missing = "is not a function of coordinates and their momenta"
    coordinates: tuple[Coordinate, ...]
    momenta: tuple[Quantity, ...]
    lagrangian: Quantity

    @property
    def pairs(self) -> tuple[tuple[Symbol, Symbol], ...]:
        return tuple((q.symbol, letter_of_momentum(q)) for q in self.coordinates)

    @property
    def in_rates(self) -> dict[Symbol, Expr]:
        """Each momentum as it depends on the rates, which the mass points have confirmed."""
        return {p.symbol: explicit(p.value) for p in self.momenta}


def letter_of_momentum(q: Coordinate) -> Symbol:
    return scalar(f"p_{q.symbol.name}")


def kind_of_momentum(kind: str, lagrangian: str | None = "energy") -> str | None:
    """A length has a momentum, an angle an angular momentum; what has another dimension may have one without a name,
    as where the Lagrangian is no energy."""
    if lagrangian is None:
        return None
    return kind_of_dimension(
        dimension_of_kind(lagrangian) * dimension_of_kind("time") / dimension_of_kind(kind),
    )


def conjugate(of: Coordinate) -> Coordinate:
    """The momentum p_q as a letter of its own beside the coordinate, to write functions of both: `x*p_y - y*p_x`.

    of   the coordinate, an angle or a length
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 8.1.
    """
    kind = kind_of_momentum(of.kind)
    if kind is None:
        raise Rejected(Complaint("no-such-kind", f"the momentum of a quantity of the kind `{of.kind}` has no name"))
    return coordinate(letter_of_momentum(of).name, kind)


def conjugate_momentum(of: Quantity, q: Coordinate, symbol: str | None = None, key: str | None = None) -> Quantity:
    """Momentum that belongs to a coordinate, p_q = dL/dq_dot.

    of   the Lagrangian, J
    q    one of its coordinates
    Second route: the sum of m v . dr/dq over the mass points.
    Outcomes: generic, zero.
    Errors: L does not depend on q.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, sections 2.6 and 8.1.
    """
    required(of.coordinates, q, "conjugate_momentum", of)
    matter = of.needed(Matter)
    letter = scalar(symbol) if symbol else letter_of_momentum(q)
    return establish(
        "canonical.conjugate_momentum",
        letter,
        lambda L: Partial(L, q.rate),
        {"lagrangian": of},
        lines=Lines(put_in=None, arranged=lambda value: written_momentum(value, of)),
        routes=matter.named({"along_the_motion": compared_with(lambda: matter.momentum_along(q.symbol))}),
        outcome=lambda value: "zero" if value == 0 else "generic",
        key=key or letter.name,
        kind=kind_of_momentum(q.kind, of.step.kind),
        facts=[FromLagrangian(of), OfCoordinate(q)],
    )


def written_momentum(value: Expr, of: Quantity) -> Expr:
    """By rates; of a Lagrangian that is given term by term where that is shorter, as beside a root."""
    forms = [by_rates(value, list(of.coordinates))]
    if energies_of(of) is None:
        forms.append(Add(*(tidied(term) for term in Add.make_args(explicit(value)))))
    return _shortest(forms)


def momenta(of: Quantity) -> tuple[Quantity, ...]:
    """Momenta of all coordinates, p_q = dL/dq_dot.

    of   the Lagrangian, J
    Keys: p_ and the name of the coordinate.
    Second route: as `conjugate_momentum`.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 8.1.
    """
    return tuple(conjugate_momentum(of, q) for q in coordinates_of(of))


# --- the rates that belong to momenta --------------------------------------------------------------------------------


def rates_by_momenta(
    of: Quantity, given: Sequence[Quantity], varying: bool = False, key: str = "rate"
) -> tuple[Quantity, ...]:
    """Rates as functions of momenta, solved from p = dL/dq_dot, which is linear in the rates.

    of        the Lagrangian, J
    given     momenta of some of its coordinates, each known from now on by its letter
    varying   whether those letters vary as coordinates do, and are not constant
    Keys: rate_ and the name of the coordinate, _by_ and the letters.
    Check: the rates put back into the momenta.
    Outcomes: alone, together.
    Errors: the momenta do not determine the rates, or too many would have to be solved together.
    Source: Goldstein, Poole, Safko, *Classical Mechanics*, section 8.1.
    """
    own = [p.needed(OfCoordinate).coordinate for p in given]
    solved = _solved({p.symbol: p.value for p in given}, [q.rate for q in own])
    moving = {p.symbol: p.step.kind or "number" for p in given} if varying else {}
    letters = [p.symbol for p in given]
    by = "_".join(letter.name for letter in letters)
    divisors = told_of_divisors(solved.values())

    def put_back(q: Coordinate, found: Expr) -> tuple[ImmutableDenseMatrix, ImmutableDenseMatrix]:
        rates = {**solved, q.rate: found}
        back = [bound(explicit(p.value), rates) for p in given]
        return ImmutableDenseMatrix(back), ImmutableDenseMatrix(letters)

    def of_one(q: Coordinate) -> Quantity:
        return establish(
            "canonical.rate_by_momenta",
            q.rate,
            lambda *names: bound(solved[q.rate], dict(zip(letters, names, strict=False))),
            {f"momentum_{each.symbol.name}": lettered(p) for each, p in zip(own, given, strict=True)},
            lines=Lines(put_in=None, result=False, arranged=explicit),
            routes={"put_back": lambda found: put_back(q, found)},
            outcome="alone" if len(own) == 1 else "together",
            phrase_data=PhraseData(formulas=divisors),
            key=f"{key}_{q.symbol.name}" if varying else f"{key}_{q.symbol.name}_by_{by}",
            kind=kind_of_dimension(dimension_of_kind(q.kind) / dimension_of_kind("time")),
            scope=Scope(coordinates=moving),
        )

    return tuple(of_one(q) for q in own)


def _solved(momenta_of: Mapping[Symbol, Expr], rates: Sequence[Symbol]) -> dict[Symbol, Expr]:
    """Linear equations for the rates, those that are coupled solved together."""
    matrix = Matrix([[derivative(explicit(p), v) for v in rates] for p in momenta_of.values()])
    at_rest = dict.fromkeys(rates, ZERO)
    wanted = Matrix([letter - bound(explicit(p), at_rest) for letter, p in momenta_of.items()])
    if matrix.has(*rates):
        by_form = by_quadratic_form(momenta_of, rates)
        if by_form is not None:
            return {v: squared_below_roots(found, list(momenta_of)) for v, found in by_form.items()}
        raise Rejected(
            Complaint(
                "wrong-argument",
                "rates can be solved from momenta only where these are linear in them, or where the Lagrangian holds "
                "the rates by one sum of squares",
            )
        )
    found: dict[Symbol, Expr] = {}
    for block in _coupled(matrix):
        names = ", ".join(rates[i].name for i in block)
        part = matrix.extract(block, block)
        most = LARGEST_WITH_ANGLES if part.has(sin, cos) else LARGEST
        if len(block) > most:
            message = f"{len(block)} momenta would have to be solved together for {names}"
            help_line = (
                f"at most {LARGEST} rates may be coupled, and {LARGEST_WITH_ANGLES} where that depends on angles"
            )
            raise Rejected(Complaint("too-hard", message, help=help_line))
        below = tidied(part.det(method="berkowitz"))
        if below == 0:
            message = f"the momenta do not determine {names}"
            raise Rejected(Complaint("singular", message, help="one motion is described by two coordinates"))
        above = part.adjugate() * wanted.extract(block, [0])
        solved = (by_one_square(tidied(explicit(top) / below)) for top in above)
        found.update(zip((rates[i] for i in block), solved, strict=True))
    return found


def _coupled(matrix: Matrix) -> list[list[int]]:
    """The indices that entries off the diagonal tie together, set by set."""
    blocks: list[set[int]] = []
    for i in range(matrix.rows):
        tied = {i, *(j for j in range(matrix.cols) if matrix[i, j] != 0)}
        joined = [block for block in blocks if block & tied]
        blocks = [block for block in blocks if not block & tied] + [tied.union(*joined)]
    return [sorted(block) for block in blocks]


# --- how functions of letters are written ----------------------------------------------------------------------------


def by_letters(value: Expr, letters: Sequence[Symbol]) -> Expr:
    """A polynomial in the letters: squares completed where that is shorter, else by products, else one fraction."""
    value = explicit(value)
    present = [p for p in letters if value.has(p)]
    if not present:
        return tidied(value)
    try:
        gathered = value.expand().as_poly(*present)
    except PolynomialError:
        gathered = None
    if gathered is None or gathered.total_degree() > 2:
        return tidied(value)
    parts: dict[int, list[tuple[Expr, Expr]]] = {}
    for powers, c in gathered.terms():
        parts.setdefault(sum(powers), []).append((Mul(*(p**n for p, n in zip(present, powers, strict=True))), c))
    quadratic = _written([(m, spread(c)) for m, c in parts.get(2, [])])
    linear = _shortest([_added((m, spread(c)) for m, c in parts.get(1, [])), tidied(_added(parts.get(1, [])))])
    rest = tidied(Add(*(c for _, c in parts.get(0, []))))
    apart = Add(*(by_one_square(part) for part in (quadratic, linear, rest)))
    if not parts.get(1) or len(present) > LARGEST:
        return apart
    return _shortest([apart, _squares(chain(*parts.values()), present)])  # (p - q A)^2, with what is linear in p


def by_one_square(value: Expr) -> Expr:
    """m_1 + m_2 sin^2 a, not m_1 + m_2 - m_2 cos^2 a; and below a fraction no sum that begins with a minus."""
    if not value.has(sin, cos):
        return value
    if value.is_Add:
        value = _shortest([value, *(expand(square(value)) for square in (TR5, TR6))])
    if value.is_Add:
        return Add(*(by_one_square(term) for term in value.args))
    sign: Expr = Integer(1)
    factors: list[Expr] = []
    for part in Mul.make_args(value):
        if part.is_Mul:
            part = by_one_square(part)
        base, power = part.as_base_exp()
        if base.is_Add and power.is_Integer:
            base = _shortest([base, *(factor_terms(expand(square(base))) for square in (TR5, TR6))])
            if power.is_negative and base.could_extract_minus_sign():
                base, sign = -base, sign * Integer(-1) ** power
        factors.append(base**power)
    return _without_minus(sign * Mul(*factors))


def _without_minus(value: Expr) -> Expr:
    """(b - a) c, not -(a - b) c."""
    number, rest = value.as_coeff_Mul()
    turned = next((f for f in Mul.make_args(rest) if f.is_Add and any(map(_is_taken_off, f.args))), None)
    if not number.is_negative or turned is None:
        return value
    return -number * Mul(-turned, *(f for f in Mul.make_args(rest) if f is not turned))


def _is_taken_off(term: Expr) -> bool:
    return bool(term.could_extract_minus_sign())


def _written(terms: Sequence[tuple[Expr, Expr]]) -> Expr:
    """A quadratic form as products, as one fraction, or with its squares completed, whichever is shortest."""
    mixed = {p for monomial, _ in terms if monomial.is_Mul for p in monomial.free_symbols}
    if not mixed:
        return _added(terms)
    together = [term for term in terms if term[0].free_symbols & mixed]
    coupled = _added(together)
    alone = _added(term for term in terms if not term[0].free_symbols & mixed)
    orders = permutations(sorted(mixed, key=str)) if len(mixed) <= 3 and coupled.count_ops() <= LONGEST_SQUARED else ()
    return alone + _shortest([coupled, tidied(coupled), *(_squares(together, order) for order in orders)])


def _squares(terms: Iterable[tuple[Expr, Expr]], order: Sequence[Symbol]) -> Expr:
    """a (p + b q/a)^2 + ..., letter after letter, each bracket with no denominator of its own."""
    squares: list[Expr] = []
    rest = {_letters_in(monomial): c for monomial, c in terms}
    for p in order:
        a = tidied(rest.pop((p, p), ZERO))
        if a == 0:
            continue
        beside = {_without(p, letters): tidied(rest.pop(letters) / (2 * a)) for letters in list(rest) if p in letters}
        above, below = tidied(p + Add(*(Mul(*others, c) for others, c in beside.items()))).as_numer_denom()
        squares.append(spread(a / below**2) * above**2)
        for (one, b), (other, c) in product(beside.items(), repeat=2):
            letters = tuple(sorted(one + other, key=str))
            rest[letters] = rest.get(letters, ZERO) - a * b * c
        rest = {letters: tidied(c) for letters, c in rest.items()}
    return Add(*squares, tidied(Add(*(Mul(*letters, c) for letters, c in rest.items()))))


def _letters_in(monomial: Expr) -> tuple[Symbol, ...]:
    """p, p for p^2; p, q for p q."""
    powers = sorted(monomial.as_powers_dict().items(), key=str) if monomial != 1 else []
    return tuple(sorted((p for p, n in powers for _ in range(int(n))), key=str))


def _without(p: Symbol, letters: tuple[Symbol, ...]) -> tuple[Symbol, ...]:
    at = letters.index(p)
    return letters[:at] + letters[at + 1 :]


def _added(terms: Iterable[tuple[Expr, Expr]]) -> Expr:
    return Add(*(m * c for m, c in terms))


def _shortest(forms: Sequence[Expr]) -> Expr:
    return min(forms, key=length)


def beside_potential(
    value: Expr, of: Quantity, letters: Sequence[Symbol], moving: Sequence[Symbol] = (), sign: int = 1
) -> Expr:
    """An energy as a sum: what is kinetic by squares of rates and of letters, and the potential energy as it was found.

    of        the Lagrangian
    letters   momenta, constant or not; `moving` are coordinates whose rates still occur
    sign      that of the potential energy: -1 in a Lagrangian
    """
    energies = energies_of(of)
    if energies is None:
        return of_given(value, letters, moving)
    potential = explicit(energies.potential.value)
    at_rest = bound(value, {rate(q): ZERO for q in moving})
    kinetic = by_one_square(by_rates(tidied(value - at_rest), list(moving), halves=True)) if moving else ZERO
    kinetic = with_weights_in_front(kinetic, list(moving), of.needed(Matter).weights)
    return Add(kinetic, sign * (by_letters(sign * at_rest - potential, letters) + potential))


def of_given(value: Expr, letters: Sequence[Symbol], moving: Sequence[Symbol]) -> Expr:
    """An energy of a Lagrangian that is given, where nothing tells which part of it is potential."""
    fast = [*letters, *(rate(q) for q in moving)]
    terms = Add.make_args(explicit(value).expand())
    alone = tidied(Add(*(term for term in terms if not term.has(*fast))))
    whole = Add(*(term for term in terms if term.has(*fast)))
    forms = [roots_together(whole), tidied(whole), by_letters(whole, letters), factor(together(whole)), whole]
    if moving:
        forms.append(by_rates(whole, list(moving), halves=True))
    return squared_below_roots(_shortest([explicit(form) for form in forms]), letters) + alone


def squared_below_roots(value: Expr, letters: Sequence[Symbol]) -> Expr:
    """sqrt((p_x + b y)^2 + m^2 c^2), its squares completed where that is shorter."""
    roots = {
        power: by_letters(power.base, letters) ** power.exp
        for power in value.atoms(Pow)
        if power.exp.is_Rational and not power.exp.is_Integer
    }
    return value.xreplace(roots)


def kinetic_first(value: Expr, names: Sequence[Symbol]) -> list[Form]:
    """The last line of an energy: its terms in the order of the names in them, what has none of these last."""

    def rank(term: Expr) -> tuple[bool, int, bool, bool, str]:
        first = next((i for i, name in enumerate(names) if term.has(name)), len(names))
        linear = first < len(names) and not any(derivative(term, a, b) != 0 for a in names for b in names)
        mixed = first < len(names) and derivative(term, names[first], 2) == 0
        return linear, first, mixed, term.could_extract_minus_sign(), str(term)

    terms = sorted(Add.make_args(value), key=rank)
    return [Form(Terms(*terms) if len(terms) > 1 else value, "result")]


def part_of_degree(value: Expr, rates: Sequence[Symbol], degree: int) -> Expr:
    """The part of a quadratic expression that is homogeneous in the rates of degree 0, 1 or 2."""
    u = Dummy("u")
    scaled = bound(explicit(value), {v: u * v for v in rates})
    halved = Rational(1, 2) if degree == 2 else Integer(1)
    for _ in range(degree):
        scaled = derivative(scaled, u)
    return halved * bound(scaled, {u: ZERO})
