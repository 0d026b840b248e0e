r"""The tokens of a formula and their places.

A token from a macro has the place of the call in the text, and `origin` names the chain of calls. The lexer treats all
commands in the same way: `\frac` and `\foo` are both tokens of kind command.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from enum import StrEnum

from derive.documents.source import Span

MOST_TOKENS = 20_000  # tokens of a formula before its macros are expanded; the expansion may handle ten times as many
DEEPEST_CALLS = 30  # nested calls of macros


class Kind(StrEnum):
    COMMAND = "command"  # text without the backslash
    LETTER = "letter"
    NUMBER = "number"
    OPEN = "open"  # { of a group
    CLOSE = "close"
    MARK = "mark"
    SCRIPT = "script"  # ^ or _
    CELL = "cell"  # &
    SPACE = "space"  # a run of spaces, which counts only inside text
    PARAMETER = "parameter"  # #1 in the body of a macro


@dataclass(frozen=True)
class Token:
    kind: Kind
    text: str
    span: Span
    origin: tuple[str, ...] = ()

    def is_command(self, *names: str) -> bool:
        return self.kind is Kind.COMMAND and self.text in names

    def is_mark(self, *marks: str) -> bool:
        return self.kind is Kind.MARK and self.text in marks


class TooLarge(Exception):
    """A formula has too many tokens, or its macros expand too far."""

    def __init__(self, message: str, span: Span):
        super().__init__(message)
        self.span = span


_PIECE = re.compile(
    r"(?P<comment>(?<!\\)%[^\n]*\n?[ \t]*)"
    r"|\\(?P<command>[A-Za-z@]+\*?|.)"
    r"|(?P<number>\d+(?:\.\d+)?|\.\d+)"
    r"|(?P<letter>[^\W\d_])"
    r"|(?P<open>\{)|(?P<close>\})"
    r"|(?P<script>[\^_])"
    r"|(?P<cell>&)"
    r"|\#(?P<parameter>\d)"
    r"|(?P<space>[\s~]+)"
    r"|(?P<mark>.)",
    re.DOTALL,
)
_STARRED = {"operatorname*"}  # for any other command the star is a separate token: `a\cdot*` is rare, `\omega*t` is not
GREEK_LETTERS = {
    "α": "alpha", "β": "beta", "γ": "gamma", "δ": "delta", "ε": "epsilon", "ϵ": "epsilon", "ζ": "zeta", "η": "eta",
    "θ": "theta", "ϑ": "vartheta", "ι": "iota", "κ": "kappa", "λ": "lambda", "μ": "mu", "µ": "mu", "ν": "nu",
    "ξ": "xi", "π": "pi", "ρ": "rho", "σ": "sigma", "τ": "tau", "υ": "upsilon", "φ": "phi", "ϕ": "phi", "χ": "chi",
    "ψ": "psi", "ω": "omega", "Γ": "Gamma", "Δ": "Delta", "Θ": "Theta", "Λ": "Lambda", "Ξ": "Xi", "Π": "Pi",
    "Σ": "Sigma", "Φ": "Phi", "Ψ": "Psi", "Ω": "Omega", "∂": "partial", "ℓ": "ell", "ħ": "hbar", "∇": "nabla",
    "∞": "infty", "√": "sqrt",
}  # fmt: skip
SIGNS = {
    "−": "-", "–": "-", "·": r"\cdot", "⋅": r"\cdot", "×": r"\times", "≈": r"\approx", "≃": r"\simeq", "≤": r"\leq",
    "≥": r"\geq", "≠": r"\neq", "≡": r"\equiv", "±": r"\pm", "∓": r"\mp", "→": r"\to", "⇒": r"\Rightarrow",
    "′": "'", "″": "''", "∗": "*", "∝": r"\propto", "≪": r"\ll", "≫": r"\gg", "°": r"\degree",
    "∫": r"\int", "∑": r"\sum",
}  # fmt: skip
RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻ⁿ", "0123456789-n")
LOWERED = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
_RAISED = re.compile("[⁰¹²³⁴⁵⁶⁷⁸⁹⁻ⁿ]+")
_LOWERED = re.compile("[₀₁₂₃₄₅₆₇₈₉]+")

_SCRIPTS = ((_RAISED, "^", RAISED), (_LOWERED, "_", LOWERED))


def tokens_of(text: str, start: int = 0, end: int | None = None) -> list[Token]:
    """Return the tokens of a part of a text, without comments; each run of spaces is one token."""
    found: list[Token] = []
    position, end = start, len(text) if end is None else end
    while position < end:
        for pattern, script, table in () if text[position].isascii() else _SCRIPTS:
            if raised := pattern.match(text, position, end):
                span = Span(raised.start(), raised.end())
                found += [Token(Kind.SCRIPT, script, span), Token(Kind.OPEN, "{", span)]
                found += [replace(each, span=span) for each in tokens_of(raised[0].translate(table))]
                found.append(Token(Kind.CLOSE, "}", span))
                position = raised.end()
                break
        else:
            piece = _PIECE.match(text, position, end)
            if piece is None:
                break
            position = piece.end()
            found += _of_piece(piece)
        if len(found) > MOST_TOKENS:
            raise TooLarge(f"this formula has more than {MOST_TOKENS} tokens", found[-1].span)
    return found


def _of_piece(piece: re.Match[str]) -> list[Token]:
    kind, span = str(piece.lastgroup), Span(piece.start(), piece.end())
    text = piece[kind]
    if kind == "comment":
        return []
    if kind == "command" and text.isspace():
        return [Token(Kind.COMMAND, " ", span)]
    if kind == "command" and text.endswith("*") and len(text) > 1 and text not in _STARRED:
        return [
            Token(Kind.COMMAND, text[:-1], Span(span.start, span.end - 1)),
            Token(Kind.MARK, "*", Span(span.end - 1, span.end)),
        ]
    if kind in ("letter", "mark"):
        if text in GREEK_LETTERS:
            return [Token(Kind.COMMAND, GREEK_LETTERS[text], span)]
        if text in SIGNS:
            return [replace(each, span=span) for each in tokens_of(SIGNS[text])]
    return [Token(Kind(kind), text, span)]


def without_spaces(tokens: list[Token]) -> list[Token]:
    return [each for each in tokens if each.kind is not Kind.SPACE]
