"""A sequence of tokens with the current position."""

from __future__ import annotations

from derive.course.latex.tokens import Argument, Token


class Cursor:
    """A sequence of tokens with a current position; `bars` states for each open bracket whether it is a bar `|`. If the
    innermost open bracket is a bar, the next bar closes it."""

    def __init__(self, tokens: tuple[Token, ...], end: int):
        self.tokens = tokens
        self.end = end
        self.at = 0
        self.bars: list[bool] = []

    @classmethod
    def over(cls, argument: Argument) -> Cursor:
        return cls(argument.tokens, argument.end)

    @property
    def token(self) -> Token | None:
        return self.tokens[self.at] if self.at < len(self.tokens) else None

    @property
    def following(self) -> Token | None:
        return self.tokens[self.at + 1] if self.at + 1 < len(self.tokens) else None

    @property
    def before(self) -> Token:
        return self.tokens[self.at - 1]

    @property
    def inside_bars(self) -> bool:
        return bool(self.bars) and self.bars[-1]

    @property
    def written(self) -> str:
        r"""The text of the current token, with `\` before the name of a command; "" at the end."""
        token = self.token
        if token is None:
            return ""
        return f"\\{token.text}" if token.kind == "command" else token.text

    def replace(self, tokens: tuple[Token, ...]) -> None:
        """Replace the token at the current position by other tokens."""
        self.tokens = self.tokens[: self.at] + tokens + self.tokens[self.at + 1 :]

    def argument_after(self, mark: Token, text: str) -> Argument | None:
        """Return the group that follows a `^` or `_`, or the next token if there are no braces; None at the end."""
        token = self.token
        if token is None:
            return None
        brace = len(text) - len(text[mark.end :].lstrip())
        if text[brace : brace + 1] != "{":
            self.at += 1
            return Argument((token,), token.start, token.end)
        close = _closing_brace(text, brace)
        first = self.at
        while self.token and self.token.start < close:
            self.at += 1
        return Argument(self.tokens[first : self.at], brace, close + 1)


def _closing_brace(text: str, opening: int) -> int:
    depth, at = 0, opening
    while at < len(text):
        if text[at] == "\\":
            at += 2
            continue
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        if depth == 0:
            return at
        at += 1
    return len(text)
