r"""The text of an answer, tidied: ASCII and Unicode become LaTeX, and the answer is split into statements.

`7/24 M a^2 w^2`, `theta_ddot = -g/l sin(theta)` and `½mv²` become LaTeX that `derive.documents` parses. For each
change, the place in the typed text is recorded.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise

from derive.documents.layout import RELATIONS
from derive.documents.macros import argument_at
from derive.documents.source import Format, Source, Span, source_of
from derive.documents.tokens import GREEK_LETTERS, Kind, Token, tokens_of, without_spaces
from derive.documents.vocabulary import FUNCTIONS, GREEK
from derive.grading.names import INSTEAD, Names, bare

LONGEST = 2000  # characters of an answer
MOST_TOKENS = 1500
MOST_STATEMENTS = 40
DEEPEST = 40  # the greatest depth of nested brackets

TYPED_FUNCTIONS = {name: name for name in FUNCTIONS if name not in ("arg", "det", "tr", "Tr", "min", "max")} | {
    "arccosine": "arccos", "arsinh": "arcsinh", "sqrt": "sqrt", "abs": "abs", "atan": "arctan", "acos": "arccos",
    "asin": "arcsin", "acosh": "arccosh", "asinh": "arcsinh", "atanh": "arctanh",
}  # fmt: skip
GREEK_WORDS = {*GREEK, "infty"} - {"ell", "Re", "Im", "wp", "imath", "jmath"}
_COMMENT = re.compile(r"\b(?:where|with|because|since|for|when|if)\b(?!\s*\})")

_DEFINED = re.compile(
    r"[\s$]*\\?([^\W\d_]+)\s*(?:\^\{?2\}?\s*|²\s*)?="
)  # the letter that an answer itself defines: `where I = ...`


class Unread(Exception):
    """The reason why an answer cannot be read, and the place in the tidied text."""

    def __init__(self, message: str, span: Span | None = None):
        super().__init__(message)
        self.message, self.span = message, span
        self.source: Source | None = None


@dataclass(frozen=True)
class TypedSide:
    tokens: tuple[Token, ...]
    span: Span


@dataclass(frozen=True)
class TypedStatement:
    """One statement of an answer: its sides, and the relations between them."""

    sides: tuple[TypedSide, ...]
    relations: tuple[str, ...] = ()


@dataclass
class Typed:
    source: Source
    statements: list[TypedStatement]
    notes: list[str] = field(default_factory=list)


def typed(text: str, names: Names) -> Typed:
    """Return an answer as statements; raise `Unread` if it is empty, too large or malformed."""
    if len(text) > LONGEST:
        raise Unread(f"too large: an answer has at most {LONGEST} characters, but this one has {len(text)}")
    if not text.strip():
        raise Unread("the answer is empty")
    if odd := re.search(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\ud800-\udfff]", text):
        raise Unread("this character is not allowed in an answer", Span(odd.start(), odd.end()))
    source = source_of(text, Format.PLAIN, "answer")
    try:
        return _typed(source, names)
    except Unread as error:
        error.source = error.source or source
        raise


def _typed(source: Source, names: Names) -> Typed:
    notes: list[str] = []
    _tidy(source, names, notes)
    tokens = tokens_of(source.text)
    if len(tokens) > MOST_TOKENS:
        raise Unread(f"too large: an answer has at most {MOST_TOKENS} tokens")
    tokens = _without_cells(without_spaces(tokens))
    _check_depth(tokens)
    tokens = _wrapped(tokens)
    statements = [each for piece in _pieces(_without_frame(tokens)) if (each := _statement(piece)) is not None]
    if not statements:
        raise Unread("the answer is empty")
    if len(statements) > MOST_STATEMENTS:
        raise Unread(f"too large: an answer has at most {MOST_STATEMENTS} statements")
    return Typed(source, statements, notes)


# --- characters and words ---------------------------------------------------------------------------------------------

_COMBINING = {
    "\u0307": r"\dot",
    "\u0308": r"\ddot",
    "\u20db": r"\dddot",
    "\u20d7": r"\vec",
    "\u20e1": r"\vec",
    "\u0302": r"\hat",
}
_PLAIN = {
    r"[\u200b-\u200f\u2060-\u2064\ufeff\u00ad]": "",
    r"\*\*": "^",
    r"[⁄∕÷]": "/",
    r"º": "°",
    r"<=|=<|⩽": r"\\le ",
    r">=|⩾": r"\\ge ",
    r"!=|<>": r"\\ne ",
    r"==|:=": "=",
    r"\+/-|\+-": r"\\pm ",
    r"√": r"\\sqrt ",
    r"\\\\\[[^\]]{0,12}\]": r"\\\\ ",
    r"\$\$?|\\\(|\\\)|\\\[|\\\]": " ",
    r"\\(?:begin|end)\{(?:align|equation|gather|aligned|split|math|displaymath)\*?\}": " ",
    r"\\(?:text|mathrm|textrm|mbox)\{\s*(?:and|or|,|;)\s*\}": "; ",
    r"(?<![A-Za-z\\])(?:and|or)(?![A-Za-z])": ";",
    r"\\(?:qquad|quad)": "; ",
    r"\\rule(?:\[[^\]]*\])?\{[^{}]*\}\{[^{}]*\}": " ",
}


def _tidy(source: Source, names: Names, notes: list[str]) -> None:
    source.replace("[\U0001d400-\U0001d7ff\uff01-\uff5e\u210e\u00bc-\u00be\u2150-\u215e]", _compatible)
    source.replace("[\u00c0-\u024f\u1e00-\u1eff]", _undotted)
    source.replace(
        "(\\w)([\u0307\u0308\u20db\u20d7\u20e1\u0302])", lambda found: f"{_COMBINING[found[2]]}{{{found[1]}}}"
    )
    for pattern, reads in _PLAIN.items():
        source.replace(pattern, reads)
    if (comment := _COMMENT.search(source.text)) and comment.start() and "\\text" not in source.text:
        cut = comment.start()
        defined = _DEFINED.match(source.text, comment.end())
        if defined and not names.has(GREEK_LETTERS.get(defined[1], defined[1]), ""):
            source.replace(r"(?s)" + comment[0] + "(?=" + re.escape(source.text[comment.end() :]) + r"\Z)", ";")
        else:
            notes.append(f"the words from `{comment[0]}` on are not read")
            source.replace(r"(?s)" + re.escape(source.text[cut:]) + r"\Z", "")
    source.replace(r"(?<=\d)[eE]([+-]?\d{1,9})(?![\w.])", r"\\cdot 10^{\1}")
    source.replace(r"(?<=\d)\s*[x×]\s*(?=10\s*\^)", r"\\cdot ")
    _read_commas(source, notes)
    source.replace(
        r"(?<![A-Za-z\\_{^])([A-Za-z]+|[\u0391-\u03c9\u03d5])(\d{1,2})(?![\d.])",
        lambda found: _numbered(found[1], found[2], names) or found[0],
    )
    source.replace(
        r"(?<![A-Za-z\\])d(\^?\{?2\}?|²)?\s*([^\W\d_]\w*|\\[A-Za-z]+\w*)\s*/\s*"
        r"(?:d\s*t\s*(?:\^?\{?2\}?|²)?|\(\s*d\s*t\s*(?:\^?\{?2\}?|²)?\s*\))",
        _derivative,
    )
    source.replace(
        r"\\(?:text|mathrm|operatorname|rm|textrm|mbox|SI|si|qty|unit|num|mathit)\s*\*?\s*\{[^{}]*\}|\\[A-Za-z]+"
        r"|[A-Za-z]+(?:_[A-Za-z0-9]+)*|[\u0391-\u03c9\u03d5]_[A-Za-z]{2,}",
        lambda found: _word(found[0], names, source.text, found.start()),
    )


def _compatible(found: re.Match[str]) -> str:
    plain = unicodedata.normalize("NFKC", found[0])
    top, stroke, bottom = plain.partition("\u2044")
    return rf"\frac{{{top}}}{{{bottom}}}" if stroke else plain


def _undotted(found: re.Match[str]) -> str:
    plain = unicodedata.normalize("NFD", found[0])
    letter, marks = plain[0], plain[1:]
    return f"{_COMBINING[marks[0]]}{{{letter}}}" if len(marks) == 1 and marks[0] in _COMBINING else found[0]


def _read_commas(source: Source, notes: list[str]) -> None:
    """Read `0,25` as a decimal and `1,500` as thousands, outside of brackets. In a bracket whose entries are separated
    by semicolons, read each comma between digits as a decimal comma."""
    depths, depth = [], 0
    for char in source.text:
        depth += (char in "([{") - (char in ")]}")
        depths.append(depth)

    def without_comma(found: re.Match[str]) -> str:
        if depths[found.start()]:
            return found[0]
        thousands = found[1] != "0" and len(found[2]) == 3
        new = found[1] + ("" if thousands else ".") + found[2]
        notes.append(f"`{found[0]}` is read as {new}")
        return new

    source.replace(r"(?<![\d.,])(\d{1,9}),(\d{1,9})(?![\d.,])", without_comma)
    source.replace(r"[(\[][^()\[\];]*;[^()\[\]]*[)\]]", lambda found: with_points(found[0]).replace(";", ","))


def with_points(entries: str) -> str:
    """Replace decimal commas by decimal points. The entries must not be separated by commas: `1,5; 0; 2`."""
    return re.sub(r"(?<=\d),(?=\d)", ".", entries)


def _numbered(word: str, digits: str, names: Names) -> str:
    """Return `m1` as the letter m_1, if the problem has this letter; otherwise an empty text."""
    base = GREEK_LETTERS.get(word, word)
    is_letter = len(base) == 1 or base in GREEK_WORDS
    known = is_letter and (names.has(base, digits) or names.has(INSTEAD.get(base, base), digits))
    return f"{word}_{digits}" if known else ""


def _derivative(found: re.Match[str]) -> str:
    order = "2" if found[1] else ""
    raised = f"^{order}" if order else ""
    return rf"\frac{{d{raised} {found[2]}}}{{dt{raised}}}"


def _word(word: str, names: Names, text: str, start: int) -> str:
    """Return a command, or a word that was typed without a backslash, as LaTeX."""
    if word.startswith("\\"):
        return word
    base, *subs = word.split("_")
    base = GREEK_LETTERS.get(base, base)
    dots = 0
    if subs and subs[-1] in ("dot", "ddot", "dddot"):
        dots = len(subs.pop()) - 2
    if not subs:
        if dots:
            return f"{_dotted(base, dots)} "
        return "".join(_segments(base, names))
    *before, last = _segments(base, names) or [base]
    sub, rest = _subscript(last.strip().lstrip("\\"), "_".join(subs), names, "\\" in text)
    letter = _dotted(last.strip().lstrip("\\"), dots) if dots else last.rstrip()
    tail = _word(rest, names, text, start) if rest else ""
    return f"{''.join(before)}{letter}_{{{sub}}} {tail}"


def _dotted(base: str, dots: int) -> str:
    letter = rf"\{base}" if base in GREEK_WORDS else base
    return rf"\{'d' * (dots - 1)}dot{{{letter}}}"


def _subscript(base: str, written: str, names: Names, in_latex: bool) -> tuple[str, str]:
    """Split the text after an underscore into the subscript and the letters after it: `v_0t` is v_0 times t."""
    plain = bare(written)
    known = next((size for size in range(len(plain), 0, -1) if names.has(base, plain[:size])), 0)
    digits = re.match(r"\d+", plain)
    size = known or (digits.end() if digits else 1 if in_latex else len(plain))
    rest = written
    for each in plain[:size]:
        rest = rest[rest.index(each) + 1 :]
    return plain[:size], rest.lstrip("_")


def _segments(word: str, names: Names) -> list[str]:
    """Split a run of letters into functions, Greek letters and single letters: `mgsin` is m, g and the sine."""
    found: list[str] = []
    at = 0
    while at < len(word):
        for size in range(min(len(word) - at, 12), 1, -1):
            piece = word[at : at + size]
            if (read := _known_word(piece, names)) is not None:
                found.append(read)
                at += size
                break
        else:
            found.append(f"{word[at]} ")
            at += 1
    return found


def _known_word(piece: str, names: Names) -> str | None:
    if piece == "diag":
        return r"\mathit{diag} "
    if piece in TYPED_FUNCTIONS:
        return rf"\{TYPED_FUNCTIONS[piece]} "
    if piece in GREEK_WORDS or piece == "pi":
        if len(piece) == 2 and piece != "pi" and not names.has_base(piece) and all(map(names.has_base, piece)):
            return None  # `mu` is m times u in a problem with these letters
        return rf"\{piece} "
    for dots in (3, 2, 1):
        base = piece.removesuffix("d" * (dots - 1) + "dot")
        if base != piece and (len(base) == 1 or base in GREEK_WORDS):
            return f"{_dotted(base, dots)} "
    if piece in names.long_bases:
        return rf"\mathit{{{piece}}} "
    return None


# --- tokens -----------------------------------------------------------------------------------------------------------


def _wrapped(tokens: list[Token]) -> list[Token]:
    """Put braces around the argument of a root, a power or a subscript: `sqrt(g/l)`, `x^(1/2)`, `x^-1`, `x^10`."""
    found: list[Token] = []
    at = 0
    while at < len(tokens):
        token = tokens[at]
        at += 1
        found.append(token)
        takes = token.is_command("sqrt") or token.kind is Kind.SCRIPT
        if not takes or at >= len(tokens):
            continue
        if token.is_command("sqrt") and tokens[at].is_mark("["):
            end = next((i for i in range(at, len(tokens)) if tokens[i].is_mark("]")), len(tokens) - 1)
            found += tokens[at : end + 1]
            at = end + 1
            if at >= len(tokens):
                continue
        is_sign = token.text == "_" and tokens[at].is_mark("-", "+")  # `omega_+`
        inner, at_next = ([tokens[at]], at + 1) if is_sign else _inner(tokens, at)
        if inner is not None:
            first, last = (inner[0].span, inner[-1].span) if inner else (token.span, token.span)
            found += [Token(Kind.OPEN, "{", first), *_wrapped(inner), Token(Kind.CLOSE, "}", last)]
            at = at_next
    return found


def _without_cells(tokens: list[Token]) -> list[Token]:
    """Leave out each `&` outside a matrix, because it only aligns rows."""
    found, depth = [], 0
    for token in tokens:
        depth += token.is_command("begin") - token.is_command("end")
        if token.kind is not Kind.CELL or depth:
            found.append(token)
    return found


def _inner(tokens: list[Token], at: int) -> tuple[list[Token] | None, int]:
    """Return the tokens of an argument without the brackets around them, and the position after the argument. If the
    caller need not add braces, return None and the unchanged position."""
    token = tokens[at]
    left = token.is_command("left") and at + 1 < len(tokens) and tokens[at + 1].is_mark("(")
    if token.is_mark("(") or left:
        depth = 0
        for i in range(at + left, len(tokens)):
            depth += tokens[i].is_mark("(") - tokens[i].is_mark(")")
            if depth == 0:
                closes_left = left and tokens[i - 1].is_command("right")
                return tokens[at + 1 + left : i - closes_left], i + 1
        raise Unread("this bracket is not closed", token.span)
    if token.is_mark("-", "+") and at + 1 < len(tokens):
        inner, after = _inner(tokens, at + 1)
        if inner is None:
            inner, after = argument_at(tokens, at + 1)
        return [token, *inner], after
    if token.kind is Kind.NUMBER and len(token.text) > 1:
        return [token], at + 1
    return None, at


def _check_depth(tokens: list[Token]) -> None:
    depth = 0
    opened: list[Token] = []
    for token in tokens:
        if token.kind is Kind.OPEN:
            opened.append(token)
        elif token.kind is Kind.CLOSE:
            if not opened:
                raise Unread("this brace was not opened", token.span)
            opened.pop()
        depth += token.kind is Kind.OPEN or token.is_mark("(", "[")
        depth -= token.kind is Kind.CLOSE or token.is_mark(")", "]")
        if depth > DEEPEST:
            raise Unread(f"too large: brackets are nested more than {DEEPEST} levels deep", token.span)
    if opened:
        raise Unread("this brace is not closed", opened[-1].span)


def _without_frame(tokens: list[Token]) -> list[Token]:
    r"""Leave out `\boxed{...}` or the braces of a set around the whole answer."""
    while tokens:
        if tokens[0].is_command("boxed", "fbox", "ensuremath") and len(tokens) > 1 and tokens[1].kind is Kind.OPEN:
            inner, after = argument_at(tokens, 1)
            if all(each.is_mark(".", ",") for each in tokens[after:]):
                tokens = inner
                continue
        if tokens[0].is_command("{") and tokens[-1].is_command("}"):
            tokens = tokens[1:-1]
            continue
        if tokens[0].kind is Kind.OPEN:
            inner, after = argument_at(tokens, 0)
            if after == len(tokens) and any(each.is_mark(",", ";") for each in inner):
                tokens = inner
                continue
        while tokens and tokens[-1].is_mark(".", ",", ";"):
            tokens = tokens[:-1]
        break
    return tokens


def _pieces(tokens: list[Token]) -> Iterator[list[Token]]:
    """Split the tokens into statements at commas, semicolons and ends of rows outside of brackets."""
    piece: list[Token] = []
    depth = 0
    for token in tokens:
        depth += token.kind is Kind.OPEN or token.is_mark("(", "[") or token.is_command("begin", "left", "{")
        depth -= token.kind is Kind.CLOSE or token.is_mark(")", "]") or token.is_command("end", "right", "}")
        if depth <= 0 and (token.is_mark(",", ";") or token.is_command("\\", ",,", "newline")):
            yield piece
            piece = []
        else:
            piece.append(token)
    yield piece


def _statement(tokens: list[Token]) -> TypedStatement | None:
    sides: list[list[Token]] = [[]]
    relations: list[str] = []
    depth = 0
    for token in tokens:
        depth += token.kind is Kind.OPEN or token.is_mark("(", "[") or token.is_command("begin")
        depth -= token.kind is Kind.CLOSE or token.is_mark(")", "]") or token.is_command("end")
        relation = RELATIONS.get(token.text) if token.kind in (Kind.MARK, Kind.COMMAND) and depth == 0 else None
        if relation is not None:
            relations.append(relation)
            sides.append([])
        else:
            sides[-1].append(token)
    sides = [_shed(side) for side in sides]
    if not any(sides):
        return None
    if not sides[0]:
        sides, relations = sides[1:], relations[1:]
        if relations or len(sides) > 1:
            raise Unread("the side before this sign is empty", sides[0][0].span if sides[0] else None)
    for before, side in pairwise(sides):
        if not side:
            raise Unread("the side after this sign is empty", before[-1].span if before else None)
    return TypedStatement(
        tuple(TypedSide(tuple(side), Span(side[0].span.start, side[-1].span.end)) for side in sides), tuple(relations)
    )


def _shed(tokens: list[Token]) -> list[Token]:
    """Leave out spacing at the ends of a side, and points at its end."""
    while tokens and (tokens[-1].is_mark(".") or tokens[-1].is_command(",", ";", " ", "!", ":")):
        tokens = tokens[:-1]
    while tokens and tokens[0].is_command(",", ";", " ", "!", ":", "displaystyle"):
        tokens = tokens[1:]
    return tokens


__all__ = ["Typed", "TypedSide", "TypedStatement", "Unread", "typed"]
