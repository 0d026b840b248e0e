r"""The commands that a document defines with `\newcommand`, `\def`, `\DeclareMathOperator` and similar commands."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from derive.documents.source import Span
from derive.documents.tokens import DEEPEST_CALLS, MOST_TOKENS, Kind, Token, TooLarge, tokens_of

MOST_MACROS = 2000
ACCENTS = (
    "vec",
    "hat",
    "bar",
    "tilde",
    "dot",
    "ddot",
    "mathbf",
)  # definitions of these commands are ignored, because they change only the appearance
MOST_UNCLOSED = 100  # after more definitions with unclosed braces than this, the search for definitions ends


@dataclass(frozen=True)
class Macro:
    """A command with `count` arguments; `default` is the value of the first argument if the call omits it."""

    name: str
    count: int
    default: tuple[Token, ...] | None
    body: tuple[Token, ...]
    span: Span


_DEFINITION = re.compile(
    r"\\(?:re)?(?:newcommand|providecommand)\*?\s*(?:\{\s*\\(?P<name>[A-Za-z@]+|.)\s*\}|\\(?P<bare>[A-Za-z@]+|.))"
    r"\s*(?:\[(?P<count>\d)\])?\s*(?:\[(?P<default>[^\]]*)\])?\s*(?=\{)"
    r"|\\(?:DeclareRobustCommand)\*?\s*\{?\\(?P<robust>[A-Za-z@]+)\}?\s*(?:\[(?P<robust_count>\d)\])?\s*(?=\{)"
    r"|\\[gex]?def\s*\\(?P<plain>[A-Za-z@]+|.)(?P<parameters>(?:#\d)*)\s*(?=\{)"
    r"|\\(?P<operator>DeclareMathOperator)\*?\s*\{?\\(?P<spoken>[A-Za-z@]+)\}?\s*(?=\{)"
)


def macros_of(text: str) -> tuple[dict[str, Macro], list[Span]]:
    """Return the commands that a document defines, and the places of the definitions."""
    found: dict[str, Macro] = {}
    places = []
    unclosed = 0
    for match in _DEFINITION.finditer(text):
        if len(found) >= MOST_MACROS:
            break
        start = match.end()
        end = end_of_group(text, start)
        if end is None:
            unclosed += 1
            if unclosed > MOST_UNCLOSED:
                break
            continue
        name = match["name"] or match["bare"] or match["robust"] or match["plain"] or match["spoken"]
        count = int(match["count"] or match["robust_count"] or (match["parameters"] or "").count("#"))
        default = tuple(tokens_of(match["default"])) if match["default"] is not None else None
        try:
            body = tuple(tokens_of(text, start + 1, end - 1))
        except TooLarge:
            continue
        if match["operator"]:
            at = Span(start, end)
            body = (
                Token(Kind.COMMAND, "operatorname", at), Token(Kind.OPEN, "{", at), *body, Token(Kind.CLOSE, "}", at)
            )  # fmt: skip
        span = Span(match.start(), end)
        found[name] = Macro(name, count, default, body, span)
        places.append(span)
    return found, places


def end_of_group(text: str, start: int) -> int | None:
    """Return the position after the brace that closes the group at `start`; None if the group is not closed."""
    depth, position = 0, start
    while position < len(text):
        char = text[position]
        if char == "\\":
            position += 1
        elif char == "{":
            depth += 1
        elif char == "}":
            depth -= 1
            if depth == 0:
                return position + 1
        position += 1
    return None


def expanded(tokens: Sequence[Token], macros: Mapping[str, Macro]) -> list[Token]:
    """Return the tokens with each macro replaced by its body. The commands in `ACCENTS`, and a macro within its own
    body, are kept."""
    if not macros:
        return list(tokens)
    return list(_Expansion(macros).of(tokens, 0))


class _Expansion:
    """Expands the macros of one formula; the work of all calls together is bounded."""

    def __init__(self, macros: Mapping[str, Macro]):
        self.macros = macros
        self.handled = 0

    def of(self, tokens: Sequence[Token], depth: int) -> Iterator[Token]:
        at = 0
        while at < len(tokens):
            token = tokens[at]
            at += 1
            self.count(1, token)
            macro = self.macros.get(token.text) if token.kind is Kind.COMMAND else None
            if macro is None or macro.name in (
                *token.origin,
                *ACCENTS,
            ):  # `\vec` within its own definition is the original one
                yield token
                continue
            if depth > DEEPEST_CALLS:
                raise TooLarge(f"the macros of this formula are nested deeper than {DEEPEST_CALLS} levels", token.span)
            values, at = _arguments(tokens, at, macro)
            self.count(sum(map(len, values)) * sum(each.kind is Kind.PARAMETER for each in macro.body), token)
            call = Span(token.span.start, max(token.span.end, tokens[at - 1].span.end))
            yield from self.of(_filled(macro, values, call, (*token.origin, macro.name)), depth + 1)

    def count(self, handled: int, token: Token) -> None:
        self.handled += handled
        if self.handled > 10 * MOST_TOKENS:
            raise TooLarge("this formula is too long after its macros are expanded", token.span)


def _arguments(tokens: Sequence[Token], at: int, macro: Macro) -> tuple[list[list[Token]], int]:
    values: list[list[Token]] = []
    for index in range(macro.count):
        at = _after_space(tokens, at)
        if index == 0 and macro.default is not None:
            if at < len(tokens) and tokens[at].is_mark("["):
                close = next((i for i in range(at, len(tokens)) if tokens[i].is_mark("]")), at)
                values.append(list(tokens[at + 1 : close]))
                at = close + 1
            else:
                values.append(list(macro.default))
            continue
        value, at = argument_at(tokens, at)
        values.append(value)
    return values, at


def _after_space(tokens: Sequence[Token], at: int) -> int:
    while at < len(tokens) and tokens[at].kind is Kind.SPACE:
        at += 1
    return at


def argument_at(tokens: Sequence[Token], at: int) -> tuple[list[Token], int]:
    """Return the tokens of the argument that begins at a position, without its braces, and the position after it."""
    at = _after_space(tokens, at)
    if at >= len(tokens):
        return [], at
    if tokens[at].kind is not Kind.OPEN:
        return [tokens[at]], at + 1
    depth, begins = 0, at + 1
    while at < len(tokens):
        depth += (tokens[at].kind is Kind.OPEN) - (tokens[at].kind is Kind.CLOSE)
        at += 1
        if depth == 0:
            return list(tokens[begins : at - 1]), at
    return list(tokens[begins:]), at


def _filled(macro: Macro, values: list[list[Token]], call: Span, origin: tuple[str, ...]) -> list[Token]:
    found: list[Token] = []
    for token in macro.body:
        if token.kind is Kind.PARAMETER:
            index = int(token.text) - 1
            found += values[index] if index < len(values) else []
        else:
            found.append(replace(token, span=call, origin=origin))
    return found
