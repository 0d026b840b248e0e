"""Integrals over a body, worked out line by line as in a written calculation.

The integrand is a sum of products. Each product separates into integrals that share no variable: integrals of one
variable if the limits are constant, nested integrals if a limit depends on an outer variable. The lines show the
separated integrals, the innermost antiderivatives in brackets, the values of these brackets, and so on outwards. Then
a line shows the product of the values. The last line groups density times volume, which is the mass, in a bracket.

Suppose that the radius of a solid of revolution varies with its height, or that the coordinates for this solid are
Cartesian. The integral is then first over the disc at each height, then along the axis. In Cartesian coordinates the
integral over the disc is along the chords of the disc.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from sympy import Add, Expr, Integer, Integral, Mul, Poly, Pow, Rational, Symbol, cos, factor_terms, pi, sin

from derive.algebra.expressions import Bracket, Factors, Group, Terms, bound, explicit
from derive.algebra.integrals import antiderivative, definite
from derive.algebra.tidy import tidied
from derive.mechanics.bodies.regions import Region, coordinates
from derive.steps.step import Form, Level

OneVariable = tuple[Symbol, Expr, Expr]


@dataclass(frozen=True)
class Nested:
    """An integral that is a factor of a term: its integrand and its limits, outermost first."""

    integrand: Expr
    limits: tuple[OneVariable, ...]

    @property
    def innermost(self) -> OneVariable:
        return self.limits[-1]

    @property
    def is_plain(self) -> bool:
        return self.integrand == 1 and len(self.limits) == 1

    def written(self) -> Expr:
        """The integral, with each factor of the integrand moved as far outwards as its variables allow."""
        return _wrapped(self._parts(len(self.limits)), self.limits, Integer(1))

    def with_bracket(self) -> Expr:
        """The integral with the innermost antiderivative in a bracket; unevaluated if no antiderivative is found."""
        x, lower, upper = self.innermost
        *outside, own = self._parts(len(self.limits))
        whole = antiderivative(own, x)
        if whole is None:
            return self.written()
        return _wrapped(outside, self.limits[:-1], Bracket(whole, x, lower, upper))

    def carried_out(self) -> Nested | Expr:
        """The integral that remains after the innermost one is evaluated, or the value if none remains."""
        value = definite(self.integrand, (self.innermost,))
        if value is None:
            value = explicit(Integral(self.integrand, self.innermost))
        if len(self.limits) == 1:
            return value
        return Nested(factor_terms(value), self.limits[:-1])

    def _parts(self, depth: int) -> list[Expr]:
        """One product of factors of the integrand for each variable of integration, the outermost variable first. A
        factor belongs to the innermost variable that it contains, or to the outermost variable if it contains none."""
        found = [Integer(1)] * depth
        for part in Mul.make_args(self.integrand):
            place = max((i for i, limit in enumerate(self.limits) if part.has(limit[0])), default=0)
            found[place] *= part
        return found


def _wrapped(parts: Sequence[Expr], limits: Sequence[OneVariable], inner: Expr) -> Expr:
    """Wrap the integrals around the inner expression, the innermost first; each integral also contains its part of the
    integrand."""
    for part, limit in reversed(list(zip(parts, limits, strict=True))):
        factors = [Group(f) if isinstance(f, Integral) else f for f in (part, inner) if f != 1]
        whole = factors[0] if len(factors) == 1 else Factors(*factors) if factors else Integer(1)
        inner = Integral(whole, limit)
    return inner


Separated = tuple[Nested | Expr, ...]


def worked_integral(region: Region, weight: Expr, rho: Expr, volume: Expr) -> list[Form]:
    """The lines from rho times the integral of `weight` to the value in terms of the mass, M = rho V. If rho is 1, the
    lines do not mention the mass."""
    integrand = (weight * region.element).expand()
    if integrand == 0:
        return []
    terms = Add.make_args(integrand)
    sign = -1 if len(terms) == 1 and terms[0].could_extract_minus_sign() else 1
    front = sign * rho
    if region.section is not None or _has_chords(region):
        lines = _over_discs(region, sign * integrand, front)
    else:
        lines = _outwards([_separated(sign * term, region.limits) for term in terms], front)
    if rho == 1:
        return lines
    return [*lines, *_mass_collected(region, integrand, sign, rho, volume, len(terms) > 1)]


def _separated(term: Expr, limits: Sequence[OneVariable]) -> Separated:
    """The term as a product of integrals, one for each group of variables. The constant factors are in the first
    integral whose variables the term contains, or in the first integral if the term is constant."""
    number, rest = term.as_coeff_Mul()
    groups = _groups(limits)
    found = [Mul(*(f for f in Mul.make_args(rest) if any(f.has(x) for x, _, _ in group))) for group in groups]
    constant = number * Mul(*(f for f in Mul.make_args(rest) if not any(f.has(x) for x, _, _ in limits)))
    if constant != 1:
        first = next((i for i, f in enumerate(found) if f != 1), 0)
        found[first] = constant * found[first]
    return tuple(Nested(f, tuple(group)) for f, group in zip(found, groups, strict=True))


def _groups(limits: Sequence[OneVariable]) -> list[list[OneVariable]]:
    """Groups of limits that depend on each other; independent groups keep their order."""
    groups: list[list[OneVariable]] = []
    for limit in limits:
        related = [g for g in groups if any(end.has(x) for x, _, _ in g for end in limit[1:])]
        for group in related:
            groups.remove(group)
        groups.append([*(known for group in related for known in group), limit])
    return groups


def _outwards(terms: list[Separated], front: Expr) -> list[Form]:
    """The lines from the innermost integrals outwards: antiderivatives, then their values at the limits."""
    nested = _are_nested(terms)
    # If there is only one term and it is nested, the line "split" differs little from the line before it, so "split"
    # appears at full level only.
    level = Level.FULL if nested and len(terms) == 1 else Level.STANDARD
    lines = [_line(front, terms, Nested.written, "split" if nested else "separate", level)]
    while _are_nested(terms):
        lines.append(_line(front, terms, Nested.with_bracket, "antiderivative", Level.STANDARD))
        terms = [_collected(tuple(_one_further(part) for part in term)) for term in terms]
        lines.append(_line(front, terms, Nested.written, "limits", Level.STANDARD))
    values = [tuple(_one_further(part) for part in sorted(term, key=_is_plain, reverse=True)) for term in terms]
    return [
        *lines,
        _line(front, terms, Nested.with_bracket, "antiderivative", Level.STANDARD),
        _line(front, values, Nested.written, "limits", Level.FULL),
        Form(_times(front, _lasting([Mul(*term) for term in values])), "multiplied", Level.STANDARD),
    ]


def _lasting(values: list[Expr]) -> list[Expr]:
    return [value for value in values if value != 0] or values[:1]


def _are_nested(terms: list[Separated]) -> bool:
    return any(isinstance(part, Nested) and len(part.limits) > 1 for term in terms for part in term)


def _one_further(part: Nested | Expr) -> Nested | Expr:
    return part.carried_out() if isinstance(part, Nested) else part


def _collected(term: Separated) -> Separated:
    front: Expr = Integer(1)
    rest: list[Nested | Expr] = []
    for part in term:
        if isinstance(part, Nested):
            outside, inside = part.integrand.as_independent(*(x for x, _, _ in part.limits), as_Add=False)
            front *= outside
            rest.append(Nested(inside, part.limits))
        else:
            front *= part
    return (front, *rest) if front != 1 else tuple(rest)


def _line(front: Expr, terms: list[Separated], how: Callable[[Nested], Expr], because: str, level: Level) -> Form:
    return Form(_times(front, [_product(term, how) for term in terms]), because, level)


def _product(term: Separated, how: Callable[[Nested], Expr]) -> Expr:
    """The product of the factors of a term. In a line with brackets, the factors that need no bracket come first:
    values, and integrals with the integrand 1, each written as the upper minus the lower limit. If the first integrand
    has a negative coefficient, the minus sign is in front of the product."""
    first = term[0]
    if isinstance(first, Nested) and first.integrand.as_coeff_Mul()[0].is_negative:
        return -_product((replace(first, integrand=-first.integrand), *term[1:]), how)
    if how is Nested.written:
        return Factors(*(how(part) if isinstance(part, Nested) else part for part in term))
    plain = [_length(part) if isinstance(part, Nested) else part for part in term if _is_plain(part)]
    return Factors(*plain, *(how(part) for part in term if isinstance(part, Nested) and not part.is_plain))


def _is_plain(part: Nested | Expr) -> bool:
    return part.is_plain if isinstance(part, Nested) else True


def _length(part: Nested) -> Expr:
    _, lower, upper = part.innermost
    return upper - lower


def _times(rho: Expr, terms: list[Expr]) -> Expr:
    front = [] if rho == 1 else [rho]
    factors = [*front, *_flat(terms[0])] if len(terms) == 1 else [*front, Terms(*terms)]
    return factors[0] if len(factors) == 1 else Factors(*factors)


def _flat(term: Expr) -> tuple[Expr, ...]:
    return term.args if isinstance(term, Factors) else (term,)


# --- a solid of revolution in Cartesian coordinates ---


def _has_chords(region: Region) -> bool:
    """Whether the innermost limits are the ends of a chord: the upper limit contains a square root of an expression
    with a variable other than the outermost."""
    roots = (power for power in region.limits[-1][2].atoms(Pow) if power.exp == Rational(1, 2))
    return any(root.has(*region.names[1:]) for root in roots)


def _over_discs(region: Region, integrand: Expr, front: Expr) -> list[Form]:
    """The lines of an integral over a solid of revolution: first over the disc at each height, then along the axis."""
    z_limit, *within = region.limits
    by_chords = _by_chords(region, integrand, front) if region.element == 1 else []
    discs = list(Add.make_args(explicit(Integral(integrand, *reversed(within))).expand()))
    along = [bound(disc, dict([region.section] if region.section else [])) for disc in discs]
    split = [_collected((Nested(_from_the_tip(disc, z_limit), (z_limit,)),)) for disc in along]
    return [
        *by_chords,
        Form(_times(front, [Integral(_sum(discs), z_limit)]), "discs", Level.STANDARD),
        _line(front, split, Nested.written, "section", Level.STANDARD),
        _line(front, split, _with_power_bracket, "antiderivative", Level.FULL),
        Form(
            _times(front, _lasting([Mul(*(_one_further(part) for part in term)) for term in split])),
            "multiplied",
            Level.STANDARD,
        ),
    ]


def _by_chords(region: Region, integrand: Expr, front: Expr) -> list[Form]:
    """The lines of an integral over a disc in Cartesian coordinates: along its chords, then, if each integrand allows
    it, with y = r sin u."""
    z_limit, y_limit, x_limit = region.limits
    chords = [factor_terms(c) for c in Add.make_args(factor_terms(explicit(Integral(integrand, x_limit))).expand())]
    turned = [_by_angle(chord, y_limit, region) for chord in chords]
    return [
        Form(_times(front, [Integral(_sum(chords), y_limit, z_limit)]), "chords", Level.FULL),
        *([Form(_times(front, [Integral(_sum(turned), z_limit)]), "turned", Level.FULL)] if all(turned) else []),
    ]


def _by_angle(chord: Expr, limit: OneVariable, region: Region) -> Expr | None:
    """The integral of c y^m (r^2 - y^2)^(k/2) over y from -r to r, with y = r sin u; None for any other integrand."""
    y, _, r = limit
    outside, inside = chord.as_independent(y, as_Add=False)
    powers = dict(factor.as_base_exp() for factor in Mul.make_args(inside))
    m = powers.pop(y, Integer(0))
    if len(powers) != 1 or (next(iter(powers)) - r**2 + y**2).expand() != 0:
        return None
    n = 2 * next(iter(powers.values())) + 1
    (u,) = coordinates("u", region.limits[0][2].free_symbols | r.free_symbols)
    return Factors(outside * r ** (m + n), Integral(sin(u) ** m * cos(u) ** n, (u, -pi / 2, pi / 2)))


def _from_the_tip(value: Expr, limit: OneVariable) -> Expr:
    """Write an even power with a positive base: (h - z)^4, not (z - h)^4."""
    z, lower, _ = limit
    return value.replace(
        lambda e: e.is_Pow and e.base.is_Add and e.exp.is_even and e.base.subs(z, lower).is_negative,
        lambda e: Pow(-e.base, e.exp),
    )


def _sum(terms: list[Expr]) -> Expr:
    return terms[0] if len(terms) == 1 else Terms(*terms)


def _with_power_bracket(part: Nested) -> Expr:
    """The bracket of an antiderivative: one power for c (p + q z)^n, otherwise term by term."""
    z, lower, upper = part.innermost
    constant, rest = part.integrand.as_independent(z, as_Add=False)
    base, exponent = rest.as_base_exp()
    if isinstance(base, Add) and exponent.is_Integer and Poly(base, z).degree() == 1:
        return Bracket(constant * base ** (exponent + 1) / ((exponent + 1) * base.diff(z)), z, lower, upper)
    return part.with_bracket()


# --- the mass ---


def _mass_collected(region: Region, integrand: Expr, sign: int, rho: Expr, volume: Expr, is_sum: bool) -> list[Form]:
    """The lines that group density times volume in a bracket, for example 13/3 (6 a^3 rho) a^2, before the result 13/3
    M a^2.
    """
    whole = region.with_section_put_in()
    value = tidied(Integral(integrand, *reversed(whole.limits)))
    if value == 0:
        return []
    number, rest = tidied(value / volume).primitive()
    if rest.could_extract_minus_sign():
        number, rest = -number, -rest
    number_part = [number] if number != 1 else []
    return [
        *([Form(rho * value, "added", Level.FULL)] if is_sum else []),
        Form(Factors(*number_part, Group(volume * rho), rest), "mass_collected", Level.FULL),
    ]
