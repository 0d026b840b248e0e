"""Writes a layout as LaTeX, and escapes plain text for TeX."""

from __future__ import annotations

import re
import unicodedata
from functools import cache

from pylatexenc.latexencode import RULE_CALLABLE, UnicodeToLatexConversionRule, UnicodeToLatexEncoder

from derive.algebra.dimensions import Dimension
from derive.errors import Complaint, Rejected
from derive.render.notation.breaking import terms_of
from derive.render.notation.layout import (
    DEGREE_SIGN,
    GREEK_LETTERS,
    SCRIPT_LETTERS,
    SIGNS,
    THIN_SPACE,
    Applied,
    Array,
    Bracketed,
    Digits,
    Evaluated,
    Fenced,
    Fraction,
    IntegralSign,
    Layout,
    Lowered,
    Name,
    Operator,
    Raised,
    RootSign,
    Row,
    Sign,
    Upright,
    begins_with_number,
    first_of,
    is_differential,
    row,
    separator_of,
)

SHORT_SUM = 3  # greatest number of terms of a numerator or denominator in running text: (a + b)/(c + d)
TEX_FUNCTIONS = {"sin", "cos", "tan", "arccos", "arcsin", "arctan", "exp", "ln", "sinh", "cosh", "tanh"}
TEX_OPERATORS = {
    "dot": r"\cdot ",
    "inner": r"\cdot ",
    "times": r"\times ",
    "cross": r"\times ",
    "plus": "+",
    "minus": "-",
    "equals": "=",
    "approx": r"\approx ",
    "unequal": r"\ne ",
    "less": "<",
    "greater": ">",
    "at_most": r"\le ",
    "at_least": r"\ge ",
    "tends": r"\to ",
    "plus_minus": r"\pm ",
    "space": r"\,",
    "comma": r",\ ",
    "semicolon": r";\ ",
    "open": r"\Bigl(",
    "close": r"\Bigr)",
    "start": "",
    "on": r"\qquad ",
    "stroke": "/",
    "next": r",\qquad ",
}
BETWEEN_TERMS = {
    Operator(kind)
    for kind in (
        "plus",
        "minus",
        "plus_minus",
        "equals",
        "approx",
        "unequal",
        "less",
        "greater",
        "at_most",
        "at_least",
        "comma",
        "semicolon",
        "tends",
    )
}
STROKE = Operator("stroke")
# Extra height for columns of fractions: the first string is added to a row, the second between two rows.
SPACING = COLUMN_STRUT, ROW_GAP = r"\rule[-1em]{0pt}{2.6em}", "[4pt]"


def latex(layout: Layout, *, inline: bool = False) -> str:
    """Return the LaTeX of a layout; with `inline`, fractions are a/b where this is unambiguous, and small elsewhere."""
    return _Printer(inline).show(_with_strokes(layout) if inline else layout)


def latex_of_terms(layout: Layout, *, inline: bool = False) -> list[str]:
    """Return the LaTeX of each term of a sum separately, with its sign."""
    return [_Printer(inline).show(term) for term in terms_of(_with_strokes(layout) if inline else layout)]


def _with_strokes(layout: Layout) -> Layout:
    """Write fractions as a/b in running text, where this is unambiguous: R > a/2, dL/dt."""
    if isinstance(layout, Fenced):
        return Fenced(_with_strokes(layout.inside), layout.kind)
    items = _differentiated([_flat(item) for item in (layout.items if isinstance(layout, Row) else (layout,))])
    around = (None, *items, None)
    alone = [
        all(x is None or _parts_terms(x) for x in ((around[i], around[i + 2]), (around[i + 2],))[_is_derivative(item)])
        for i, item in enumerate(items)
    ]
    if any(isinstance(item, Fraction) and not apart for item, apart in zip(items, alone, strict=True)):
        return row(*items)  # all fractions of the row keep their form
    return row(*(_with_stroke(item) if apart else item for item, apart in zip(items, alone, strict=True)))


def with_strokes_in_roots(layout: Layout) -> Layout:
    """Write the fractions inside roots as a/b, also in a product, where `latex` with `inline` keeps their form."""
    items = layout.items if isinstance(layout, Row) else (layout,)
    return row(*(_with_stroke(item) if isinstance(item, RootSign) else item for item in items))


def _is_derivative(item: Layout) -> bool:
    """Return whether an item is a fraction of differentials, such as dg/dx."""
    return (
        isinstance(item, Fraction) and is_differential(first_of(item.below)) and is_differential(first_of(item.above))
    )


def _differentiated(items: list[Layout]) -> list[Layout]:
    """Write d/dt of a derivative in one line: d(dL/dv)/dt."""
    found: list[Layout] = []
    for item in items:
        if _is_derivative(item) and len(found) > 1 and found[-1] == THIN_SPACE:
            before = found[-2]
            if isinstance(before, Fraction) and isinstance(before.above, Upright):
                found[-2:] = [Row((before.above, Fenced(_with_stroke(item)), STROKE, before.below))]
                continue
        found.append(item)
    return found


def _parts_terms(item: Layout) -> bool:
    """Return whether an item separates terms: a sign of a sum, or a relation."""
    return item in BETWEEN_TERMS or isinstance(item, Sign) and SIGNS[item.command].startswith(" ")


def _flat(item: Layout) -> Layout:
    if not isinstance(item, Array) or len(item.rows[0]) > 1:
        return item
    (first,), *others = item.rows
    between = separator_of([first, *(entry for (entry,) in others)])
    return Fenced(row(first, *(each for (entry,) in others for each in (between, entry))))


def _with_stroke(item: Layout) -> Layout:
    """Write the fractions of an item as a/b, if numerator and denominator are simple enough."""
    match item:
        case Fenced():
            return _with_strokes(item)
        case RootSign(inside, degree):
            return RootSign(_with_strokes(inside), degree)
        case Lowered(base, word):
            return Lowered(_with_strokes(base), word)
        case Applied(name, Fenced() as argument, power):
            return Applied(name, _with_strokes(argument), power)
        case Fraction(above, below) if _fits_in_line(above) and _fits_in_line(below):
            is_product = isinstance(below, Row) and not is_differential(first_of(below))
            begins = Fenced(above) if _has_function(above) or _is_sum(above) else above
            return row(begins, STROKE, Fenced(below) if is_product else below)
    return item


def _is_sum(layout: Layout) -> bool:
    return len(terms_of(layout)) > 1


def _fits_in_line(layout: Layout) -> bool:
    """Return whether a numerator or a denominator is short enough for a fraction a/b."""
    terms = terms_of(layout)
    return len(terms) <= SHORT_SUM and all(_are_letters(_unsigned(term)) for term in terms)


def _unsigned(term: Layout) -> Layout:
    """Return a term of a sum without the sign in front of it."""
    is_signed = isinstance(term, Row) and term.items[:1] and isinstance(term.items[0], Operator)
    return row(*term.items[1:]) if is_signed and isinstance(term, Row) else term


def _are_letters(layout: Layout) -> bool:
    return all(
        _are_letters(factor.argument) and not isinstance(factor.argument, Row)
        if isinstance(factor, Applied)
        else isinstance(factor, Digits | Name | Raised | Upright | RootSign)
        or isinstance(factor, Fenced)
        and _is_sum(factor.inside)
        and _fits_in_line(factor.inside)
        for factor in _factors(layout)
    )


def _has_function(layout: Layout) -> bool:
    """Return whether a factor is a function, so that a stroke after it could be ambiguous, as in cos x/2."""
    return any(isinstance(factor, Applied) for factor in _factors(layout))


def _factors(layout: Layout) -> tuple[Layout, ...]:
    return tuple(i for i in layout.items if i != THIN_SPACE) if isinstance(layout, Row) else (layout,)


class _Printer:
    def __init__(self, inline: bool):
        self.inline = inline

    def show(self, layout: Layout) -> str:
        match layout:
            case Digits(digits):
                return digits.replace(",", "{,}")
            case Name():
                return _name(layout)
            case Upright(text):
                if text == "partial":
                    return r"\partial "
                return text if text == "d" else rf"\mathrm{{{_unit(text)}}}"
            case Operator(kind):
                return TEX_OPERATORS[kind]
            case Sign(command):
                return rf"\{command} "
            case Row(items):
                return self._row(items)
            case Fraction(above, below):
                return self._fraction(above, below)
            case Raised(base, Fraction(Digits(above), Digits(below))):
                return f"{self._raised(base)}^{{{above}/{below}}}"
            case Raised(base, power):
                return f"{self._raised(base)}^{{{self.show(power)}}}"
            case Lowered(base, word):
                if isinstance(word, str):
                    subscript = word if len(word) == 1 else rf"\mathrm{{{word}}}"
                else:
                    subscript = self.show(word)
                return f"{self._raised(base)}_{{{subscript}}}"
            case RootSign(inside, degree):
                return rf"\sqrt{f'[{self.show(degree)}]' if degree else ''}{{{self.show(inside)}}}"
            case Fenced(inside, kind):
                left, right = {"(": ("(", ")"), "[": ("[", "]"), "|": ("|", "|"), "{": (r"\{", r"\}")}[kind]
                tall = _is_tall(inside, self.inline)
                return self._fenced(left, self.show(inside), right, tall)
            case Bracketed(inside, lower, upper):
                bounds = f"_{{{self.show(lower)}}}^{{{self.show(upper)}}}"
                return rf"\mathopen{{}}\left[{self.show(inside)}\right]{bounds}"
            case Evaluated(inside, where):
                return rf"\left.{self.show(inside)}\right|_{{{self.show(where)}}}"
            case IntegralSign(lower, upper):
                if lower is None and upper is None:
                    return r"\int "
                limits = [f"{sign}{{{self.show(limit)}}}" for sign, limit in (("_", lower), ("^", upper)) if limit]
                return rf"\int{''.join(limits)} "
            case Applied(name, argument, power):
                raised = f"^{{{self.show(power)}}}" if power else ""
                command = rf"\{name}" if name in TEX_FUNCTIONS else rf"\operatorname{{{name}}}"
                gap = "" if isinstance(argument, Fenced) or raised else " "
                return f"{command}{raised}{gap}{self.show(argument)}"
            case Array(rows):
                return rf"{{\begin{{pmatrix}} {self._rows(rows)} \end{{pmatrix}}}}"
        raise TypeError(f"no LaTeX for {type(layout).__name__}")

    def _raised(self, base: Layout) -> str:
        """Put a name with a prime in braces, because TeX treats the prime as an exponent."""
        shown = self.show(base)
        return f"{{{shown}}}" if isinstance(base, Name) and base.primes else shown

    def _rows(self, rows: tuple[tuple[Layout, ...], ...]) -> str:
        """Return the rows of an array. Fractions are small, except in a column of a displayed formula."""
        if not self.inline and len(rows[0]) == 1 and any(_is_tall(entry, inline=False) for (entry,) in rows):
            return rf" \\{ROW_GAP} ".join(
                rf"{COLUMN_STRUT if _is_tall(entry, inline=False) else ''}\displaystyle {self.show(entry)}"
                for (entry,) in rows
            )
        return r" \\ ".join(" & ".join(_Printer(True).show(entry) for entry in line) for line in rows)

    def _row(self, items: tuple[Layout, ...]) -> str:
        shown: list[str] = []
        for before, item in zip((None, *items), items, strict=False):
            text = self.show(item)
            if before is not None and _runs_into(before, item):
                shown.append(r"\,")
            shown.append(text)
        return "".join(_separated(shown))

    def _fraction(self, above: Layout, below: Layout) -> str:
        command = r"\tfrac" if self.inline else r"\frac"
        return rf"{command}{{{self.show(above)}}}{{{self.show(below)}}}"

    def _fenced(self, left: str, inside: str, right: str, tall: bool) -> str:
        if left == "|":
            return rf"\left|{inside}\right|" if tall else rf"\lvert {inside}\rvert "
        return rf"{{\left{left}{inside}\right{right}}}" if tall else f"{left}{inside}{right}"


def _separated(pieces: list[str]) -> list[str]:
    r"""Insert a space between a command and a letter after it, as in `\pi a`."""
    result: list[str] = []
    for piece in pieces:
        if result and result[-1][-1:].isalpha() and "\\" in result[-1] and piece[:1].isalpha():
            command = result[-1].rpartition("\\")[2]
            if command.isalpha():
                result.append(" ")
        result.append(piece)
    return result


def _runs_into(before: Layout, item: Layout) -> bool:
    """Return whether two factors need a thin space between them."""
    apart = Operator | Sign
    if isinstance(item, apart) or isinstance(before, apart | IntegralSign) or begins_with_number(item):
        return False
    bracket = item.base if isinstance(item, Raised) else item
    return (
        isinstance(before, Fraction | Array | RootSign | Fenced)
        or isinstance(bracket, Array | Fenced)
        and before != Upright("d")
    )


def _is_tall(layout: Layout, inline: bool) -> bool:
    match layout:
        case Fraction():
            return not inline
        case Array() | Bracketed() | Evaluated():
            return True
        case IntegralSign():
            return not inline
        case Row(items):
            return any(_is_tall(item, inline) for item in items)
        case Raised(base, _) | RootSign(base) | Fenced(base, _) | Lowered(base, _):
            return _is_tall(base, inline)
        case Applied(_, argument, _):
            return _is_tall(argument, inline)
    return False


def _name(name: Name) -> str:
    base = name.letter
    letter = rf"\{base}" if base in GREEK_LETTERS else base
    if base in SCRIPT_LETTERS:
        letter = rf"\mathcal{{{base[-1]}}}"
    elif len(base) > 1 and base not in GREEK_LETTERS:
        letter = rf"\mathit{{{base}}}"
    if name.style == "vector":
        letter = rf"\bm{{{letter}}}"
    elif name.style == "tensor":
        letter = rf"\mathbf{{{letter}}}"
    if name.accent:
        letter = rf"\{name.accent}{{{letter}}}"
    if name.dots:
        letter = rf"\{'d' * name.dots}ot{{{letter}}}"
    letter = f"{letter}{name.primes}"
    return f"{letter}_{{{_subscript(name)}}}" if name.subscript else letter


def _subscript(name: Name) -> str:
    if name.subscript in GREEK_LETTERS:
        return rf"\{name.subscript}"
    between, parts = name.below
    return between.join(_part_below(part) for part in parts)


def _part_below(part: str) -> str:
    if part in GREEK_LETTERS:
        return rf"\{part}"
    return part if len(part) <= 2 else rf"\mathrm{{{part}}}"


def unit_latex(text: str) -> str:
    """Return a unit for use in a formula, in upright type: kg m^2/s."""
    return rf"\mathrm{{{_unit(text)}}}"


def dimension_latex(dimension: Dimension) -> str:
    """Return a dimension in upright type: M L^2."""
    parts = [letter if n == 1 else f"{letter}^{{{n}}}" for letter, n in dimension.powers.items() if n]
    return rf"\mathsf{{{chr(32).join(parts)}}}" if parts else "1"


def _unit(text: str) -> str:
    if text == DEGREE_SIGN.text:
        return r"{}^\circ"
    text = text.replace("^{", "^").replace("**", "^").replace("²", "^2").replace("³", "^3").replace("°", r"{}^\circ ")
    text = re.sub(r"\^(?:(-?\d+)|\((\d+/\d+)\))", r"^{\1\2}", text)
    return text.replace("*", r"\,").replace("·", r"\,").replace(" ", r"\,").replace("%", r"\%")


ACCENTS = {  # marks below a letter are added last: TeX sets a mark above only over a letter or over another mark above
    "GRAVE ACCENT": "`",
    "ACUTE ACCENT": "'",
    "CIRCUMFLEX ACCENT": "^",
    "TILDE": "~",
    "MACRON": "=",
    "BREVE": "u",
    "DOT ABOVE": ".",
    "DIAERESIS": '"',
    "CARON": "v",
    "DOT BELOW": "d",
    "COMMA BELOW": "textcommabelow",
}


def _with_accents(text: str, at: int) -> tuple[int, str] | None:
    """Return a letter with any number of accents as nested commands, for the encoder, which knows few such letters."""
    letter, *marks = list(unicodedata.normalize("NFD", text[at]))
    names = [unicodedata.name(mark, "").removeprefix("COMBINING ") for mark in marks]
    if not marks or not letter.isascii() or not all(name in ACCENTS for name in names):
        return None
    written = letter
    for name in sorted(names, key=lambda name: name.endswith("BELOW")):
        written = rf"\{ACCENTS[name]}{{{written}}}"
    return 1, written


@cache
def _encoder() -> UnicodeToLatexEncoder:
    return UnicodeToLatexEncoder(
        conversion_rules=["defaults", UnicodeToLatexConversionRule(RULE_CALLABLE, _with_accents)],
        non_ascii_only=False,
        replacement_latex_protection="braces-all",
        unknown_char_policy="fail",
        unknown_char_warning=False,
    )


def escaped(text: str) -> str:
    """Return plain text that TeX prints unchanged, with every special character escaped."""
    if text.isascii() and not any(c in text for c in "\\{}$&#^_%~<>|\"'`"):
        return text
    try:
        return str(_encoder().unicode_to_latex(text))
    except ValueError as error:
        raise Rejected(Complaint("character", f"`{text}` has a character that cannot be printed")) from error


def unprintable(text: str) -> int | None:
    """Return the index of the first character that the fonts of the page do not have; None if they have all
    characters."""
    return next((i for i, character in enumerate(text) if not _is_printable(character)), None)


@cache
def _is_printable(character: str) -> bool:
    try:
        return "\\cyr" not in escaped(character).lower()
    except Rejected:
        return False
