"""The layout of formulas, independent of any format: fractions, superscripts, brackets.

`notation.py` decides the layout, and `latex.py` and `text.py` write it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, is_dataclass


@dataclass(frozen=True)
class Digits:
    """A number as a string of digits."""

    digits: str


@dataclass(frozen=True)
class Name:
    """A symbol: its base such as `omega`, a subscript such as `x`, and dots; its style is scalar, vector or tensor.

    `accent` is the LaTeX command of a mark that an author put above the symbol: `hat`, `bar` or `tilde`.
    """

    base: str
    subscript: str = ""
    dots: int = 0
    style: str = "scalar"
    accent: str = ""

    @property
    def letter(self) -> str:
        """Return the base without its primes."""
        return self.base.rstrip("'")

    @property
    def primes(self) -> str:
        return self.base[len(self.letter) :]

    @property
    def below(self) -> tuple[str, tuple[str, ...]]:
        """Return the separator and the parts of the subscript; a comma separates them if a part has more than two
        characters."""
        parts = tuple(self.subscript.split("_"))
        return "," if any(len(part) > 2 for part in parts) else "", parts


@dataclass(frozen=True)
class Upright:
    """A unit or another word, printed upright."""

    text: str


@dataclass(frozen=True)
class Operator:
    """An operator, a relation or a separator, by its name in `TEX_OPERATORS`, such as `plus`, `equals` or `comma`."""

    kind: str


@dataclass(frozen=True)
class Sign:
    """A sign in a quoted formula of the author, by its LaTeX command: `ll`, `infty`, `sum`."""

    command: str


@dataclass(frozen=True)
class Row:
    """Items side by side."""

    items: tuple[Layout, ...]


@dataclass(frozen=True)
class Fraction:
    above: Layout
    below: Layout


@dataclass(frozen=True)
class Raised:
    base: Layout
    power: Layout


@dataclass(frozen=True)
class Lowered:
    """A layout with a word, or with a formula of an author, as its subscript: (dL/dt)_body."""

    base: Layout
    word: str | Layout


@dataclass(frozen=True)
class RootSign:
    inside: Layout
    degree: Layout | None = None


@dataclass(frozen=True)
class Fenced:
    """Brackets of one kind, ( ), [ ], { } or | |, around a layout."""

    inside: Layout
    kind: str = "("


@dataclass(frozen=True)
class Bracketed:
    """An antiderivative in brackets with limits after them: [F]_a^b."""

    inside: Layout
    lower: Layout
    upper: Layout


@dataclass(frozen=True)
class Evaluated:
    """A layout followed by a bar, with the point of evaluation below the bar."""

    inside: Layout
    where: Layout


@dataclass(frozen=True)
class IntegralSign:
    """An integral sign, with limits if there are any."""

    lower: Layout | None = None
    upper: Layout | None = None


@dataclass(frozen=True)
class Applied:
    """A function: its printed name, an exponent if there is one, and its argument."""

    name: str
    argument: Layout
    power: Layout | None = None


@dataclass(frozen=True)
class Array:
    """The entries of a vector or tensor, row by row."""

    rows: tuple[tuple[Layout, ...], ...]


Layout = (
    Digits
    | Name
    | Upright
    | Operator
    | Sign
    | Row
    | Fraction
    | Raised
    | Lowered
    | RootSign
    | Fenced
    | Bracketed
    | Evaluated
    | IntegralSign
    | Applied
    | Array
)

GREEK_LETTERS = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "zeta": "ζ", "eta": "η", "theta": "θ",
    "iota": "ι", "kappa": "κ", "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π", "rho": "ρ", "sigma": "σ",
    "tau": "τ", "upsilon": "υ", "phi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω", "Gamma": "Γ", "Delta": "Δ",
    "Theta": "Θ", "Lambda": "Λ", "Xi": "Ξ", "Pi": "Π", "Sigma": "Σ", "Upsilon": "Υ", "Phi": "Φ", "Psi": "Ψ",
    "Omega": "Ω", "infty": "∞", "ell": "ℓ", "hbar": "ħ",
}  # fmt: skip
SCRIPT_LETTERS = {"calE": "ℰ", "calH": "ℋ", "calL": "ℒ", "calR": "ℛ"}  # for results whose usual symbol is taken

# Signs without a meaning for derive, by their commands; in text, the signs of relations have spaces around them.
SIGNS = {
    "ll": " ≪ ", "gg": " ≫ ", "propto": " ∝ ", "equiv": " ≡ ", "sim": " ∼ ", "to": " → ", "in": " ∈ ",
    "Rightarrow": " ⇒ ", "perp": " ⊥ ", "parallel": " ∥ ", "mp": " ∓ ", "infty": "∞", "ldots": "…", "cdots": "⋯",
    "iint": "∬", "iiint": "∭", "oint": "∮", "sum": "∑", "prod": "∏", "nabla": "∇", "angle": "∠", "prime": "′",
    "langle": "⟨", "rangle": "⟩",
}  # fmt: skip
ACCENTS = {"hat": "\u0302", "bar": "\u0304", "tilde": "\u0303"}

DEGREE_SIGN = Upright("degree")  # the only unit that follows its number without a space
DOT, TIMES, PLUS, MINUS, THIN_SPACE = (Operator(kind) for kind in ("dot", "times", "plus", "minus", "space"))
EITHER_SIGN = Operator("plus_minus")
INNER, CROSS = Operator("inner"), Operator("cross")  # the dot and the cross between two vectors


def holds_fraction(layout: Layout) -> bool:
    """Return whether the layout is a root or a function with a fraction inside; such a layout is too tall for a
    numerator."""
    inside = layout.inside if isinstance(layout, RootSign) else layout.argument if isinstance(layout, Applied) else None
    if isinstance(inside, Fenced):
        inside = inside.inside
    items = inside.items if isinstance(inside, Row) else (inside,)
    return any(isinstance(item, Fraction) or isinstance(item, RootSign) and holds_fraction(item) for item in items)


def row(*items: Layout) -> Layout:
    """Return items side by side, with nested rows flattened."""
    flat: list[Layout] = []
    for item in items:
        flat.extend(item.items if isinstance(item, Row) else [item])
    return flat[0] if len(flat) == 1 else Row(tuple(flat))


def first_of(layout: Layout) -> Layout:
    return first_of(layout.items[0]) if isinstance(layout, Row) and layout.items else layout


def last_of(layout: Layout) -> Layout:
    return last_of(layout.items[-1]) if isinstance(layout, Row) and layout.items else layout


def begins_with_number(layout: Layout) -> bool:
    """Return whether the layout begins with a number, such as `3a`, `3/2 a`, `10^2`, and so needs a dot after another
    factor."""
    first = first_of(layout)
    if isinstance(first, Raised):
        return begins_with_number(first.base)
    if isinstance(first, Fraction):
        return begins_with_number(first.above) and is_numeric(first)
    return isinstance(first, Digits)


def is_numeric(layout: Layout) -> bool:
    """Return whether the layout contains only numbers, such as 2/(3 sqrt(14))."""
    match layout:
        case Fraction(above, below):
            return is_numeric(above) and is_numeric(below)
        case RootSign(inside):
            return is_numeric(inside)
        case Row(items):
            return all(is_numeric(item) for item in items)
    return isinstance(layout, Digits)


def is_number(layout: Layout) -> bool:
    """Return whether the layout is a plain number or a fraction of plain numbers."""
    if isinstance(layout, Fraction):
        return is_number(layout.above) and is_number(layout.below)
    return isinstance(layout, Digits)


def is_differential(layout: Layout) -> bool:
    """Return whether the layout is a sign of differentiation: d, d^2 or a curly d."""
    sign = layout.base if isinstance(layout, Raised) else layout
    return sign in (Upright("d"), Upright("partial"))


def ends_in_differential(layout: Layout) -> bool:
    """Return whether the layout ends in a differential such as dx, which completes an integral."""
    return isinstance(layout, Row) and len(layout.items) > 1 and layout.items[-2] == Upright("d")


def separator_of(items: Iterable[Layout]) -> Operator:
    """Return the sign between the items of a list: a semicolon if a number has a decimal comma, else a comma."""
    return Operator("semicolon" if any(map(_has_decimal_comma, items)) else "comma")


def _has_decimal_comma(layout: object) -> bool:
    if isinstance(layout, Digits):
        return "," in layout.digits
    parts = layout if isinstance(layout, tuple) else vars(layout).values() if is_dataclass(layout) else ()
    return any(map(_has_decimal_comma, parts))


def is_enclosed(layout: Layout) -> bool:
    return isinstance(layout, Fenced | Bracketed | Array)


POSITION = re.compile(r"^r(?P<primes>'*)_(?P<of>[^_]+)_(?P<axis>[xyz])(?=_d*dot$|$)")


def layout_of_name(name: str) -> Name:
    """Split `omega_x`, `theta_dot`, `J_xy` into symbol, subscript and dots; the component `r_C_z` becomes z_C."""
    name = POSITION.sub(r"\g<axis>\g<primes>_\g<of>", name)
    match = re.fullmatch(r"(?P<base>[^_]+)(?:_(?P<sub>.*?))?(?:_(?P<dots>d*dot))?", name)
    if not match:
        return Name(name)
    sub, dots = match["sub"] or "", match["dots"]
    if not dots and re.fullmatch(r"d*dot", sub):
        sub, dots = "", sub
    return Name(match["base"], sub, dots.count("d") if dots else 0)


def width(layout: Layout) -> float:
    """Return the approximate printed width of a layout in characters."""
    match layout:
        case Digits(digits):
            return len(digits)
        case Name(_, subscript):
            return 1.2 + 0.7 * len(subscript)
        case Upright(text):
            return 0.9 * len(text)
        case Operator(kind):
            return {"space": 0.4, "dot": 1.2, "inner": 1.2, "open": 0.8, "close": 0.8}.get(kind, 2)
        case Sign():
            return 2
        case Row(items):
            return sum(width(item) for item in items)
        case Fraction(above, below):
            return max(width(above), width(below)) + 0.6
        case Raised(base, power):
            return width(base) + 0.7 * width(power)
        case Lowered(base, word):
            return width(base) + (0.6 * len(word) if isinstance(word, str) else 0.7 * width(word))
        case RootSign(inside):
            return width(inside) + 1.5
        case Fenced(inside, _):
            return width(inside) + 1.6
        case Bracketed(inside, lower, upper):
            return width(inside) + 1.6 + 0.7 * max(width(lower), width(upper))
        case Evaluated(inside, where):
            return width(inside) + 0.3 + 0.7 * width(where)
        case IntegralSign(lower, upper):
            return 2.0 + (0.5 * max(width(lower), width(upper)) if lower and upper else 0)
        case Applied(name, argument, power):
            return 0.9 * len(name) + 0.5 + width(argument) + (0.7 * width(power) if power else 0)
        case Array(rows):
            columns = [max(width(line[j]) for line in rows) for j in range(len(rows[0]))]
            return sum(columns) + 2.0 * (len(columns) - 1) + 2.6
