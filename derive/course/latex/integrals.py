"""Integrals as a document writes them: signs with limits, differentials in any customary place, brackets with limits.

Two sorts of integrals are read: integrals that contain a root, and integrals that are quick to evaluate, such as those
of powers, sines and cosines.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from sympy import Add, Dummy, Expr, Integer, Integral, Mul, Pow, Symbol, cos, expand, sin

from derive.algebra.expressions import Bracket, Group, explicit
from derive.algebra.integrals import Limits, definite, has_root
from derive.course.arithmetic import Term
from derive.course.latex.grids import Grids, TermOrGrid, each

MAX_POWER = 60
MAX_WAVES = 24


@dataclass
class Sign:
    r"""An integral sign in a product, with its limits; its variable is known after its differential is read.

    The sign applies to all later factors of its product: in `\int_0^h z dz \int_0^z dx` the second integral is inside
    the first.
    """

    lower: Term
    upper: Term
    start: int
    end: int
    named: Term | None = None  # as in `_{z=0}`
    variable: Term | None = None


def differential_of(reader: Grids, signs: list[Sign], variable: Term) -> None:
    sign = next(sign for sign in reversed(signs) if sign.variable is None)
    if any(other.variable and other.variable.expr == variable.expr for other in signs):
        message = f"`{reader.shown(variable)}` is already the variable of another integral here"
        reader.refuse("integral", message, variable.start, variable.end)
    if sign.named and sign.named.expr != variable.expr:
        message = f"the limits are those of `{reader.shown(sign.named)}`, not of `{reader.shown(variable)}`"
        reader.refuse("integral", message, variable.start, variable.end)
    sign.variable = variable


def _has(value: TermOrGrid, letter: Expr) -> bool:
    entries = [value] if isinstance(value, Term) else [term for row in value.rows for term in row]
    return any(term.expr.has(letter) for term in entries)


def integrated(reader: Grids, inside: TermOrGrid, signs: list[Sign], outside: list[TermOrGrid]) -> TermOrGrid:
    """Return a product with its integrals, which are not evaluated. The last of `signs` is the innermost."""
    for position in range(len(signs) - 1, -1, -1):
        sign = signs[position]
        if sign.variable is None:
            help_line = "if the integrand is a sum, put it in brackets"
            if reader.d_is_a_letter:
                help_line = "`d` is a letter here, so write `\\mathrm{d}x`"
            reader.refuse("integral", "this integral has no differential", sign.start, sign.end, help_line)
        for part in outside:
            if _has(part, sign.variable.expr):
                message = f"`{reader.shown(sign.variable)}` appears outside its integral"
                reader.refuse("integral", message, part.start, part.end)
        inner = {other.variable.expr for other in signs[position:] if other.variable}
        for limit in (sign.lower, sign.upper):
            if limit.expr.free_symbols & inner:
                message = f"the limit `{reader.shown(limit)}` contains a variable of this integral or of one inside it"
                reader.refuse("integral", message, limit.start, limit.end)
        inside = _one(reader, inside, sign, sign.variable)
    return each(inside, lambda term: _checked(reader, term, signs))


def _one(reader: Grids, inside: TermOrGrid, sign: Sign, variable: Term) -> TermOrGrid:
    check_limits(reader, variable, sign.lower, sign.upper)

    def integral(term: Term) -> Term:
        size, terms = grown(term, variable.expr, sign.lower, sign.upper)
        reader.bound(sign.start, term.end, size, terms)
        x = Dummy(str(variable.expr), real=True)
        inner = term.expr.args[0] if isinstance(term.expr, Group) else term.expr
        function, limits = (inner.function, inner.limits) if isinstance(inner, Integral) else (inner, ())
        renamed = [limit.xreplace({variable.expr: x}) for limit in (function, *limits)]
        whole = Group(Integral(renamed[0], *renamed[1:], (x, sign.lower.expr, sign.upper.expr)))
        dimension = term.dimension * variable.dimension
        return replace(term, expr=whole, dimension=dimension, size=size, terms=terms, kind=None)

    return each(inside, integral)


def _checked(reader: Grids, term: Term, signs: list[Sign]) -> Term:
    integral = term.expr.args[0]
    if not _is_elementary(explicit(integral.function), integral.limits):
        names = " and ".join(f"`{reader.shown(sign.variable)}`" for sign in signs if sign.variable)
        help_line = "integrals of polynomials, roots, sines and cosines can be read"
        reader.refuse("integral", f"this integral over {names} cannot be read", term.start, term.end, help_line)
    return term


def check_limits(reader: Grids, variable: Term, *limits: Term) -> None:
    for limit in limits:
        if not reader.fits(variable, limit):
            message = f"the limit `{reader.shown(limit)}` is {limit.is_a}, but `{reader.shown(variable)}` is"
            reader.refuse("dimension", f"{message} {variable.is_a}", limit.start, limit.end)


def _is_elementary(function: Expr, limits: Limits) -> bool:
    """Return whether the integral can be evaluated by elementary rules or quickly by SymPy, or contains a root."""
    variables = {x for x, *_ in limits}
    ends = [end for _, *both in limits for end in both]
    found = definite(function, limits)
    if found is not None and found.is_finite is not False or any(has_root(part) for part in [function, *ends]):
        return True
    if any(end.free_symbols & variables for end in ends):
        return False
    terms = Add.make_args(expand(function))
    return all(_is_short(term.as_independent(x, as_Add=False)[1], x) for term in terms for x in variables)


def _is_short(product: Expr, x: Symbol) -> bool:
    """Return whether the product has only powers of x, sines and cosines that SymPy integrates quickly."""
    power, waves, arguments = 0, 0, set()
    for factor in Mul.make_args(product):
        base, exponent = factor.as_base_exp() if isinstance(factor, Pow) else (factor, Integer(1))
        if not factor.has(x):
            continue
        if not (exponent.is_Integer and 0 < exponent <= MAX_POWER):
            return False
        if base == x:
            power = int(exponent)
        elif isinstance(base, sin | cos) and not base.args[0].diff(x).has(x):
            waves += int(exponent)
            arguments.add(base.args[0])
        else:
            return False
    return waves == 0 or (power == 0 and len(arguments) == 1 and waves <= MAX_WAVES) or (power <= 3 and waves <= 2)


def bracket_of(reader: Grids, inner: TermOrGrid, lower: Term, upper: Term, variable: Term | None, end: int) -> Term:
    """Return an antiderivative between limits. If `variable` is None, the variable must be clear from the limits."""
    term = reader.scalar_in(inner, "an antiderivative")
    limits = (lower.expr, upper.expr)
    x = variable.expr if variable else _only_letter(reader, term, lower, upper)
    if variable:
        check_limits(reader, variable, lower, upper)
    size, terms = grown(term, x, lower, upper)
    reader.bound(term.start, end, size, terms)
    bound = Dummy(str(x), real=True)
    between = Bracket(term.expr.xreplace({x: bound}), bound, *limits)
    return replace(term, expr=between, end=end, size=size, terms=terms, kind=None)


def grown(term: Term, x: Expr, lower: Term, upper: Term) -> tuple[int, int]:
    """Return bounds for the size and for the number of terms of an antiderivative after its limits are substituted."""
    power = _degree(term.expr, x, term.size) + 1
    terms = term.terms * (lower.terms**power + upper.terms**power)
    return term.size * max(lower.size, upper.size) + 1, terms


def _degree(expr: Expr, x: Expr, most: int) -> int:
    """Return a bound for the power of x after multiplying out; `most` if no smaller bound is known."""
    if not expr.has(x):
        return 0
    if expr.is_Add:
        return max(_degree(arg, x, most) for arg in expr.args)
    if expr.is_Mul:
        return sum(_degree(arg, x, most) for arg in expr.args)
    if isinstance(expr, Pow) and expr.exp.is_Integer and expr.exp > 0:
        return int(expr.exp) * _degree(expr.base, x, most)
    if isinstance(expr, Group):
        return _degree(expr.args[0], x, most)
    if isinstance(expr, Integral):
        (y, *limits), inner = expr.limits[0], expr.function
        return _degree(inner, x, most) + (_degree(inner, y, most) + 1) * max(_degree(at, x, most) for at in limits)
    return 1 if expr == x or isinstance(expr, sin | cos) else most


def _only_letter(reader: Grids, term: Term, lower: Term, upper: Term) -> Symbol:
    outside = lower.expr.free_symbols | upper.expr.free_symbols
    limit = upper if upper.expr != 0 else lower
    free = (s for s in term.expr.free_symbols - outside if s in reader.dimensions)
    found = [s for s in free if limit.expr == 0 or not reader.homogeneous or reader.dimensions[s] == limit.dimension]
    if len(found) != 1:
        told = "no letter fits them" if not found else "it could be " + " or ".join(sorted(f"`{s}`" for s in found))
        help_line = "write the variable with the lower limit: `_{x=0}`"
        reader.refuse("integral", f"the variable of these limits is not clear: {told}", term.start, term.end, help_line)
    return found[0]
