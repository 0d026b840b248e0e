r"""Left sides that only name the next side: `U(\theta) =`, `U^{\prime\prime} =`, `\frac{\partial L}{\partial\theta} =`.

Such a name has no value to compare; the `answer` of the entry says which step it names.
"""

from __future__ import annotations

import re

from derive.course.latex.cursor import Cursor
from derive.course.latex.letters import letter_at
from derive.course.latex.tokens import Token
from derive.course.latex.vocabulary import FRACTIONS, RELATIONS


def without_title(cursor: Cursor) -> None:
    """Skip a left side that is a derivative, a letter with primes, or a letter with its arguments in brackets."""
    tokens = cursor.tokens
    relations = [i for i, token in enumerate(tokens) if _written(token) in RELATIONS and not _within(tokens, i)]
    if not relations:
        return
    title = cursor.tokens[: relations[0]]
    derivatives = 0
    while derivatives < len(title) and is_derivative(title[derivatives]):
        derivatives += 1
    rest = title[derivatives:]
    if (derivatives and not rest) or _is_function(rest, derivatives > 0):
        cursor.at = relations[0]


def is_derivative(token: Token) -> bool:
    r"""Return whether a token is `\frac{d}{dt}`, `\frac{dU}{d\theta}` or `\frac{\partial L}{\partial\theta}`."""
    if token.kind != "command" or token.text not in FRACTIONS:
        return False
    firsts = [a.tokens[0].text for a in token.arguments if a and a.tokens]
    return firsts in (["d", "d"], ["partial", "partial"])


def _written(token: Token) -> str:
    return f"\\{token.text}" if token.kind == "command" else token.text


def _within(tokens: tuple[Token, ...], i: int) -> bool:
    """Return whether token i is inside brackets: the `=` in `U(\\theta=0)` does not separate sides of the chain."""
    kinds = [token.kind for token in tokens[:i]]
    return kinds.count("open") > kinds.count("close")


def _is_function(tokens: tuple[Token, ...], differentiated: bool) -> bool:
    """Return whether the tokens are a letter with primes or arguments; after a derivative, the letter may be alone."""
    if not tokens or letter_at(tokens[0]) is None:
        return False
    at = 1
    while at < len(tokens) and (tokens[at].text in ("'", "prime") or tokens[at].kind == "script"):
        at += 1
    primes = any(token.text in ("'", "prime") for token in tokens[1:at])
    return _are_arguments(tokens[at:]) or (at == len(tokens) and (primes or differentiated))


def _are_arguments(tokens: tuple[Token, ...]) -> bool:
    """Return whether these are letters in brackets, `(\\theta, t)` or `(\\theta=0)`; other brackets could be a
    factor."""
    if len(tokens) < 3 or (tokens[0].text, tokens[-1].text) != ("(", ")"):
        return False
    kinds = "".join("L" if letter_at(t) else "N" if t.kind == "number" else t.text for t in tokens[1:-1])
    return re.fullmatch(r"L(=N)?(,L(=N)?)*", kinds) is not None
