r"""The tokens of a formula that an author wrote, or the reason why the formula is rejected before it is parsed.

An author can correct a formula, so unknown commands, brackets that do not match and odd characters are errors here,
each at its place.
"""

from __future__ import annotations

import re
import unicodedata

from derive.course.arithmetic import Arithmetic
from derive.course.latex.vocabulary import (
    ALIGNMENTS,
    ARGUMENTS,
    CLOSING,
    FRACTIONS,
    INSTEAD,
    KNOWN,
    MATRICES,
    ONLY_PRINTED,
    OPENING,
    REFUSED,
    SIZES,
    SPACES,
)
from derive.documents.macros import argument_at
from derive.documents.tokens import Kind, Token, tokens_of
from derive.errors import did_you_mean, nearest

LONGEST_FORMULA = 3000
DEEPEST_FORMULA = 40
MAX_TOKENS = 1500
_MARKS = frozenset("+-*/=<>,.'()[]|")
_ALLOWED = KNOWN | SPACES | SIZES | {"\\", "cr", "{", "}", "|", "begin", "end", "rule", "\n"}
_DROPPED = frozenset(["enspace", "/", "\n", "mathopen", "mathclose", "mathord", "rm", "it"]) | SIZES
_STRUT = re.compile(r"\\rule\s*(\[[^]]*\])?\s*\{0(pt|em|ex|mm|cm|in)?\}\s*\{[^{}]*\}")  # without width, so invisible
_LENGTH = re.compile(r"\[\s*-?(\d+\.?\d*|\.\d+)\s*(pt|em|ex|mm|cm|in)\s*\]")
_ENVIRONMENT = re.compile(r"\\(?P<which>begin|end)\s*(?:\{(?P<name>[^{}]*)\})?")


def checked_tokens(reader: Arithmetic) -> list[Token]:
    """Return the tokens of the reader's text, or reject it at its first error."""
    text = reader.text
    if not text.strip():
        reader.refuse("latex", "a formula is missing", 0)
    if len(text) > LONGEST_FORMULA:
        reader.refuse("too-large", f"this formula has {len(text)} characters; {LONGEST_FORMULA} are allowed", 0)
    _check_depth(reader)
    if found := re.search(r"(?<!\\)(?:\\\\)*%", text):
        reader.refuse("latex", "a comment is not allowed in a formula", found.end() - 1, help="leave it out")
    if text.rstrip(" ").endswith("\\") and not re.search(r"\\\\\s*$|\\ \s*$", text):
        reader.refuse("latex", "this `\\` has no command after it", len(text.rstrip()) - 1)
    struts = [found.span() for found in _STRUT.finditer(text)]
    tokens = [
        token
        for token in tokens_of(text)
        if token.kind is not Kind.SPACE and not any(start <= token.span.start < end for start, end in struts)
    ]
    if len(tokens) > MAX_TOKENS:
        at = tokens[MAX_TOKENS].span.start
        reader.refuse("too-large", f"this formula has more than {MAX_TOKENS} letters and signs", at)
    _Check(reader, tokens).run()
    return [token for token in tokens if not (token.kind is Kind.COMMAND and token.text in _DROPPED)]


def _check_depth(reader: Arithmetic) -> None:
    """Check the depth of nesting before the text is parsed, because the parser is recursive."""
    depth = 0
    for found in re.finditer(r"\\begin|\\end|\\?[{}\[\]()]", reader.text):
        depth += 1 if found[0][-1] in "{[(n" else -1
        if depth > DEEPEST_FORMULA:
            reader.refuse("too-large", f"this formula is nested more than {DEEPEST_FORMULA} levels deep", found.start())


class _Check:
    def __init__(self, reader: Arithmetic, tokens: list[Token]):
        self.reader, self.tokens = reader, tokens
        # for each open bracket, brace or environment: the text that closes it, the token that opens it, and the
        # position after its opening
        self.open: list[tuple[str, Token, int]] = []

    def refuse(self, message: str, token: Token, end: int | None = None, help: str | None = None) -> None:
        self.reader.refuse("latex", message, token.span.start, end or token.span.end, help)

    def run(self) -> None:
        at = 0
        while at < len(self.tokens):
            at = self.one(at)
        if self.open:
            _, token, end = self.open[-1]
            shown = self.reader.text[token.span.start : end].removeprefix("\\left")
            self.refuse(f"this `{shown}` is never closed", token, end)

    def one(self, at: int) -> int:
        """Check one token, and return the position of the next one."""
        token = self.tokens[at]
        if token.kind is Kind.MARK:
            self.mark(token)
            self.two_signs(at)
        elif token.kind is Kind.OPEN:
            self.open.append(("}", token, token.span.end))
        elif token.kind is Kind.CLOSE:
            if not self.open or self.open[-1][1].kind is not Kind.OPEN:
                if any(opened.kind is Kind.OPEN for _, opened, _ in self.open):
                    opened, end = self.open[-1][1:]
                    self.refuse(f"this `{opened.text}` is never closed", opened, end)
                self.refuse("this `}` was never opened", token)
            self.open.pop()
        elif token.kind is Kind.SCRIPT:
            self.script(at)
        elif token.kind is Kind.PARAMETER:
            self.refuse("`#` is not allowed in a formula", token)
        elif token.kind is Kind.COMMAND:
            return self.command(at)
        elif not self.reader.text[token.span.start].isascii():
            self.odd_character(token)
        return at + 1

    def two_signs(self, at: int) -> None:
        token, before = self.tokens[at], self.tokens[at - 1] if at else None
        if before is not None and _is_sign(token) and (_is_sign(before) or before.is_command("cdot", "times")):
            self.refuse(f"something is missing before `{token.text}`", token)

    def mark(self, token: Token) -> None:
        if token.text not in _MARKS or not self.reader.text[token.span.start].isascii():
            self.odd_character(token)
        if token.text in "([":
            self.open.append((OPENING[token.text], token, token.span.end))
        elif token.text in ")]":
            self.close(token.text, token, token.span.end)

    def close(self, closing: str, token: Token, end: int) -> None:
        if not self.open or self.open[-1][1].kind is Kind.OPEN or self.open[-1][1].text == "begin":
            shown = self.reader.text[token.span.start : end]
            self.refuse(f"`{shown}` is not expected here", token, end)
        wanted, opened, _ = self.open.pop()
        if wanted != closing:
            bracket = "{" if opened.text == "lbrace" else opened.text
            bracket = self.tokens[self.tokens.index(opened) + 1].text if bracket == "left" else bracket
            shown = self.reader.text[token.span.start : end].removeprefix("\\right").strip()
            self.refuse(f"`{bracket}` is closed by `{shown}`", token, end)

    def odd_character(self, token: Token) -> None:
        char = self.reader.text[token.span.start]
        if char == "$":
            self.refuse("the whole text is a formula", token, help="leave out the `$`")
        instead = INSTEAD.get(char)
        if greek := re.fullmatch(r"GREEK (SMALL|CAPITAL) LETTER ([A-Z]+)", unicodedata.name(char, "")):
            instead = "\\" + (greek[2].lower() if greek[1] == "SMALL" else greek[2].capitalize())
        help_line = f"write `{instead}`" if instead else None
        self.refuse(f"`{char}` is not allowed in a formula", token, token.span.start + 1, help_line)

    def script(self, at: int) -> None:
        value, after = argument_at(self.tokens, at + 1)
        following = self.tokens[at + 1] if at + 1 < len(self.tokens) else None
        if not value or following is None or following.kind in (Kind.CLOSE, Kind.CELL, Kind.SCRIPT):
            self.refuse(f"nothing follows `{self.tokens[at].text}`", self.tokens[at])
        number = value[0] if len(value) == 1 and after == at + 2 else None
        if number is not None and number.kind is Kind.NUMBER and len(number.text) > 1:
            help_line = f"write `{self.tokens[at].text}{{{number.text}}}`"
            start, end = number.span.start, number.span.end
            self.reader.refuse("ambiguous", "only the first character would be taken by TeX", start, end, help_line)

    def command(self, at: int) -> int:
        token = self.tokens[at]
        name = token.text
        if not self.reader.text[token.span.start].isascii():
            self.odd_character(token)
        if name in ("begin", "end"):
            return self.environment(at)
        if name not in _ALLOWED:
            self.unknown(token)
        if name in ("pm", "mp"):
            self.two_signs(at)
        if name in ("\\", "cr"):
            return self.row_end(at)
        if name in ("left", "right"):
            return self.sized(at)
        if name in ("lvert", "lbrace", "{"):
            self.open.append((OPENING.get(name, "|"), token, token.span.end))
        elif name in ("rvert", "rbrace", "}"):
            self.close(CLOSING.get(name, "|"), token, token.span.end)
        elif name in ARGUMENTS:
            self.arguments(at)
        elif name == "rule":
            self.refuse("`\\rule` is not known", token)
        return at + 1

    def unknown(self, token: Token) -> None:
        name = token.text
        if name in ONLY_PRINTED and name not in REFUSED:
            self.refuse(f"`\\{name}` cannot be read", token)
        close = nearest(name, sorted(KNOWN, key=str.swapcase))
        suggested = f"did you mean `\\{close}`?" if close else None
        message, help_line = REFUSED.get(name, (f"`\\{name}` is not known", suggested))
        self.refuse(message, token, help=help_line)

    def arguments(self, at: int) -> None:
        wanted, token, after = ARGUMENTS[self.tokens[at].text], self.tokens[at], at + 1
        for each in wanted:
            if each == "[":
                if after < len(self.tokens) and self.tokens[after].is_mark("["):
                    ends = (i for i in range(after, len(self.tokens)) if self.tokens[i].is_mark("]"))
                    after = next(ends, after) + 1
                continue
            following = self.tokens[after] if after < len(self.tokens) else None
            value, after = argument_at(self.tokens, after)
            digits = following is not None and following.kind is Kind.NUMBER and len(following.text) > 1
            if digits and following is not None and following.text.isdigit():
                after -= 1  # `\frac12` takes one digit for each argument
                if wanted.count("{") == 2:
                    break
            has_own = following is not None and following.kind is Kind.COMMAND and following.text in ARGUMENTS
            lacks = has_own and token.text in FRACTIONS or following is not None and following.text[:1] == "."
            if not value or following is None or following.kind in (Kind.CLOSE, Kind.CELL, Kind.MARK) or lacks:
                message = f"`\\{token.text}` needs {'two values' if wanted == '{{' else 'a value'} in braces"
                self.refuse(message, token)

    def sized(self, at: int) -> int:
        token = self.tokens[at]
        table = OPENING if token.text == "left" else CLOSING
        bracket = self.tokens[at + 1] if at + 1 < len(self.tokens) else None
        if bracket is None or bracket.text not in table:
            found = f"`{bracket.text}` is not allowed" if bracket else "a bracket is missing"
            self.refuse(f"{found} after `\\{token.text}`", token)
        assert bracket is not None
        if token.text == "left":
            self.open.append((OPENING[bracket.text], token, bracket.span.end))
        else:
            self.close(CLOSING[bracket.text], token, bracket.span.end)
        return at + 2

    def row_end(self, at: int) -> int:
        """After the end of a row, remove a length such as `[3pt]`, which is the space below the row. Reject other
        brackets there. Return the position of the next token."""
        following = self.tokens[at + 1] if at + 1 < len(self.tokens) else None
        if following is None or not following.is_mark("["):
            return at + 1
        length = _LENGTH.match(self.reader.text, following.span.start)
        close = next((i for i in range(at, len(self.tokens)) if self.tokens[i].is_mark("]")), None)
        if close is None:
            return at + 1
        if length is None:
            message = "brackets after the end of a row must contain a length, such as `[3pt]`"
            self.refuse(message, following, self.tokens[close].span.end)
        del self.tokens[at + 1 : close + 1]
        return at + 1

    def environment(self, at: int) -> int:
        token = self.tokens[at]
        found = _ENVIRONMENT.match(self.reader.text, token.span.start)
        assert found is not None
        name = found["name"]
        if name is None:
            self.refuse("the name of the environment is missing", token)
        end = found.end()
        after = argument_at(self.tokens, at + 1)[1]
        if found["which"] == "end":
            if not self.open or self.open[-1][0] != f"\\end{{{name}}}":
                if not any(opened.text == "begin" for _, opened, _ in self.open):
                    self.refuse("this `\\end` has no `\\begin`", token, end)
                _, opened, its_end = self.open[-1]
                self.refuse(f"this `{self.reader.text[opened.span.start : its_end]}` is never closed", opened, its_end)
            self.open.pop()
            return after
        if name not in MATRICES | ALIGNMENTS:
            message = "a determinant cannot be read" if name in ("vmatrix", "Vmatrix") else f"`{name}` is not known"
            help_line = did_you_mean(str(name), (*MATRICES, *ALIGNMENTS)) if "known" in message else None
            self.refuse(message, token, end, help_line)
        if name in ("array", "alignedat"):
            after = argument_at(self.tokens, after)[1]
        self.open.append((f"\\end{{{name}}}", token, end))
        return after


def _is_sign(token: Token) -> bool:
    return token.is_mark("+", "-") or token.is_command("pm", "mp")


__all__ = ["DEEPEST_FORMULA", "LONGEST_FORMULA", "MAX_TOKENS", "checked_tokens"]
