"""The contents of brackets and bars: grouped values, triples, absolute values, antiderivatives between limits,
matrices."""

from __future__ import annotations

from abc import abstractmethod
from typing import NoReturn

from derive.course.arithmetic import Term
from derive.course.latex.arguments import Functions
from derive.course.latex.cursor import Cursor
from derive.course.latex.grids import Grid, TermOrGrid, spanning
from derive.course.latex.integrals import bracket_of
from derive.course.latex.tokens import Argument, Token
from derive.course.latex.vocabulary import CLOSING, OPENING

MAX_SIDE = 6


class Brackets(Functions):
    """The base class of `Formula` for brackets; `Formula` defines `sum`, `closed_sum` and `unexpected`."""

    def bracketed(self, cursor: Cursor, opening: Token, depth: int) -> TermOrGrid:
        """Read the contents of brackets or bars, with limits or a subscript after them."""
        first = cursor.at
        bars = opening.kind == "bar"
        closing = "|" if bars else OPENING[opening.text]
        cursor.bars.append(bars)
        values = [self.sum(cursor, depth + 1)]
        while cursor.token and cursor.written == ",":
            cursor.at += 1
            values.append(self.sum(cursor, depth + 1))
        cursor.bars.pop()
        token = cursor.token
        if token is None or not (token.kind == "close" or (token.kind == "bar" and closing == "|")):
            if token is not None:
                self.unexpected(cursor)
            self.refuse("latex", f"this `{opening.text}` is never closed", opening.start, opening.end)
        found = "|" if token.kind == "bar" else CLOSING[token.text]
        if found != closing:
            self.refuse("latex", f"`{opening.text}` is closed by `{token.text}`", token.start, token.end)
        cursor.at += 1
        if opening.text == "." and not (cursor.token and cursor.token.kind == "script"):
            self.refuse("latex", "limits are missing after this bar", token.start, token.end)
        if len(values) > 1:
            return self.triple(values, opening.start, token.end)
        inner = spanning(values[0], opening.start, token.end)
        if cursor.written == "_" or self.both_scripts(cursor):
            return self.with_limits(cursor, inner, first, depth)
        return self.size_of(inner, opening.start, token.end) if closing == "|" else inner

    def both_scripts(self, cursor: Cursor) -> bool:
        """Return whether both an upper and a lower limit follow."""
        at, found = cursor.at, []
        while cursor.token and cursor.token.kind == "script" and cursor.written not in found:
            found.append(cursor.written)
            self.script(cursor)
        cursor.at = at
        return len(found) == 2

    def with_limits(self, cursor: Cursor, inner: TermOrGrid, first: int, depth: int) -> TermOrGrid:
        named = self.named_as_a_whole(cursor, first) if cursor.written == "_" else None
        if named is not None:
            return named
        assert cursor.token is not None
        lower, upper, variable = self.limits(cursor, depth, cursor.token)
        return bracket_of(self, inner, lower, upper, variable, cursor.before.end)

    def triple(self, values: list[TermOrGrid], start: int, end: int) -> Grid:
        entries = tuple((self.scalar_in(value, "a component"),) for value in values)
        if len(entries) != 3:
            self.refuse("shape", f"a vector has 3 components, but this has {len(entries)}", start, end)
        return Grid(entries, start, end)

    def matrix(self, token: Token, depth: int) -> TermOrGrid:
        rows: list[list[list[Token]]] = [[[]]]
        for inner in token.inside:
            if inner.kind == "row":
                rows.append([[]])
            elif inner.kind == "cell":
                rows[-1].append([])
            else:
                rows[-1][-1].append(inner)
        if rows[-1] == [[]]:
            rows.pop()
        if max(len(rows), *map(len, rows), 0) > MAX_SIDE:
            said = f"a matrix has at most {MAX_SIDE} rows and {MAX_SIDE} columns"
            self.refuse("shape", said, token.start, token.end)
        if not rows or len({len(row) for row in rows}) > 1:
            told = ", ".join(str(len(row)) for row in rows) or "no"
            self.refuse("shape", f"rows of {told} entries do not make a matrix", token.start, token.end)
        entries = tuple(tuple(self.entry(cell, token, depth) for cell in row) for row in rows)
        return entries[0][0] if len(entries) == len(entries[0]) == 1 else Grid(entries, token.start, token.end)

    def entry(self, cell: list[Token], matrix: Token, depth: int) -> Term:
        if not cell:
            self.refuse("shape", "an entry of this matrix is empty", matrix.start, matrix.end)
        value = self.closed_sum(Cursor(tuple(cell), cell[-1].end), depth + 1)
        return self.scalar_in(value, "an entry")

    # -- limits -------------------------------------------------------------------------------------------------------

    def limits(self, cursor: Cursor, depth: int, sign: Token) -> tuple[Term, Term, Term | None]:
        """Return the lower limit, the upper limit, and the variable if the lower limit names it: `_{z=0}^{z=h}`."""
        found: dict[str, tuple[Term, Term | None]] = {}
        while cursor.token and cursor.token.kind == "script" and cursor.token.text not in found:
            script = cursor.token.text
            found[script] = self.limit(self.script(cursor), depth)
        if len(found) < 2:
            missing = "^" if "_" in found else "_"
            self.refuse("integral", f"the limit after `{missing}` is missing", sign.start, sign.end)
        return found["_"][0], found["^"][0], found["_"][1]

    def limit(self, argument: Argument, depth: int) -> tuple[Term, Term | None]:
        inner = Cursor.over(argument)
        named = None
        if any(token.text == "=" for token in argument.tokens):
            named = self.letter(inner)
            if named is None or inner.written != "=":
                self.unexpected(inner)
            inner.at += 1
        value = self.scalar_in(self.closed_sum(inner, depth + 1), "a limit")
        return value, named

    # -- given by the grammar ---------------------------------------------------------------------------------------

    @abstractmethod
    def sum(self, cursor: Cursor, depth: int) -> TermOrGrid:
        """Read a sum of products."""

    @abstractmethod
    def closed_sum(self, cursor: Cursor, depth: int) -> TermOrGrid:
        """Read a sum; reject anything after it."""

    @abstractmethod
    def unexpected(self, cursor: Cursor) -> NoReturn:
        """Reject the next token."""
