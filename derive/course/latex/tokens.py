"""The tokens of a formula and their places: the nodes of pylatexenc as a flat sequence, with groups resolved.

A brace that only groups is not printed and has no meaning here: `{ab}^2` is read as `ab^2`, as it is printed.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

from pylatexenc.latexwalker import (
    LatexCharsNode,
    LatexEnvironmentNode,
    LatexGroupNode,
    LatexMacroNode,
    LatexWalker,
    LatexWalkerParseError,
)
from pylatexenc.macrospec import EnvironmentSpec, LatexContextDb, MacroSpec

from derive.course.arithmetic import Arithmetic
from derive.course.latex.vocabulary import (
    ALIGNMENTS,
    ARGUMENTS,
    CLOSING,
    INSTEAD,
    KNOWN,
    MATRICES,
    ONLY_PRINTED,
    OPENING,
    REFUSED,
    SIZES,
    SPACES,
    WORDS,
)
from derive.errors import did_you_mean, nearest

LONGEST_FORMULA = 3000
DEEPEST_FORMULA = 40
MAX_TOKENS = 1500

_PIECE = re.compile(r"(?P<number>\d+(?:\.\d+)?|\.\d+)|(?P<letter>[A-Za-z])|(?P<space>[\s~]+)|(?P<mark>.)", re.DOTALL)
_STRUT = re.compile(
    r"\\rule\s*(\[[^]]*\])?\s*\{0(pt|em|ex|mm|cm|in)?\}\s*\{[^{}]*\}"
)  # a rule without width is invisible
_LENGTH = re.compile(r"\[\s*-?(\d+\.?\d*|\.\d+)\s*(pt|em|ex|mm|cm|in)\s*\]")
_MARKS = {
    **dict.fromkeys("+-*/=<>,.'", "mark"),
    **dict.fromkeys("^_", "script"),
    **dict.fromkeys("([", "open"),
    **dict.fromkeys(")]", "close"),
    "|": "bar",
    "&": "cell",
}


@dataclass(frozen=True)
class Token:
    """One token of a formula; `kind` is number, letter, mark, script, open, close, bar, cell, row, word, command or
    matrix.

    Only a command has arguments; only a matrix and an argument contain other tokens.
    """

    kind: str
    text: str
    start: int
    end: int
    arguments: tuple[Argument | None, ...] = ()
    inside: tuple[Token, ...] = ()


@dataclass(frozen=True)
class Argument:
    """The argument of a command."""

    tokens: tuple[Token, ...]
    start: int
    end: int


@cache
def _known_to_the_walker() -> LatexContextDb:
    known = LatexContextDb()
    macros = [MacroSpec(name, spec) for name, spec in ARGUMENTS.items()] + [
        MacroSpec("\\", "["),
        MacroSpec("rule", "[{{"),
    ]
    known.add_context_category("mathematics", macros=macros, environments=[EnvironmentSpec("array", "{")])
    known.set_unknown_macro_spec(MacroSpec(""))
    known.set_unknown_environment_spec(EnvironmentSpec(""))
    return known


def tokens_of(reader: Arithmetic) -> tuple[Token, ...]:
    """Return every token of the reader's text, or reject the first token that is not recognized."""
    text = reader.text
    if not text.strip():
        reader.refuse("latex", "a formula is missing", 0)
    if len(text) > LONGEST_FORMULA:
        reader.refuse("too-large", f"this formula has {len(text)} characters; {LONGEST_FORMULA} are allowed", 0)
    _check_depth(reader)
    walker = LatexWalker(text, latex_context=_known_to_the_walker(), tolerant_parsing=False)
    try:
        nodes = walker.get_latex_nodes(parsing_state=walker.make_parsing_state(in_math_mode=True))[0]
    except LatexWalkerParseError as error:
        message, help_line = _in_our_words(str(error.msg))
        reader.refuse("latex", message, min(error.pos or 0, len(text) - 1), help=help_line)
    read_to = nodes[-1].pos + nodes[-1].len if nodes else 0
    if text[read_to:].strip():  # pylatexenc drops a lone `\` at the end
        reader.refuse("latex", "this `\\` has no command after it", read_to)
    tokens = tuple(_joined(reader, list(_Tokens(reader).of(nodes))))
    if len(tokens) > MAX_TOKENS:
        reader.refuse(
            "too-large", f"this formula has more than {MAX_TOKENS} letters and signs", tokens[MAX_TOKENS].start
        )
    return tokens


def _check_depth(reader: Arithmetic) -> None:
    """Check the depth of nesting before the text is parsed, because the parser of pylatexenc is recursive."""
    depth = 0
    for found in re.finditer(r"\\begin|\\end|\\?[{}\[\]]", reader.text):
        depth += 1 if found[0][-1] in "{[n" else -1
        if depth > DEEPEST_FORMULA:
            reader.refuse("too-large", f"this formula is nested more than {DEEPEST_FORMULA} levels deep", found.start())


def _in_our_words(said: str) -> tuple[str, str | None]:
    if "mismatching closing brace" in said:
        return "this `}` was never opened", None
    if "closing environment" in said:
        return "this `\\end` has no `\\begin`", None
    if "Bad \\begin" in said or "Bad \\end" in said:
        return "the name of the environment is missing", None
    if found := re.search(r"arguments of macro \"(.*?)\"|arguments.*?`(.*?)'", said):
        name = found[1] or found[2]
        count = ARGUMENTS.get(name, "{").count("{")
        return f"`\\{name}` needs {'two values' if count == 2 else 'a value'} in braces", None
    if found := re.search(r"expecting '?(\S+?)'?$", said):
        return f"`{found[1]}` is missing", None
    return "this is not LaTeX that can be read", None


class _Tokens:
    """Converts the nodes of pylatexenc to tokens, one after another."""

    def __init__(self, reader: Arithmetic):
        self.reader = reader

    def of(self, nodes: Any) -> Iterator[Token]:
        for node in nodes:
            if isinstance(node, LatexCharsNode):
                yield from self.characters(node)
            elif isinstance(node, LatexGroupNode):
                yield from self.of(node.nodelist)
            elif isinstance(node, LatexMacroNode):
                yield from self.command(node)
            elif isinstance(node, LatexEnvironmentNode):
                yield from self.environment(node)
            elif node is not None:
                self.foreign(node)

    def characters(self, node: Any) -> Iterator[Token]:
        for piece in _PIECE.finditer(node.chars):
            start, end = node.pos + piece.start(), node.pos + piece.end()
            kind = str(piece.lastgroup)
            if kind == "mark":
                kind = _MARKS.get(piece[0]) or self.odd_character(piece[0], start)
            if kind != "space":
                yield Token(kind, piece[0], start, end)

    def odd_character(self, char: str, start: int) -> str:
        instead = INSTEAD.get(char)
        if greek := re.fullmatch(r"GREEK (SMALL|CAPITAL) LETTER ([A-Z]+)", unicodedata.name(char, "")):
            instead = "\\" + (greek[2].lower() if greek[1] == "SMALL" else greek[2].capitalize())
        help_line = f"write `{instead}`" if instead else None
        self.reader.refuse("latex", f"`{char}` is not part of a formula", start, help=help_line)

    def command(self, node: Any) -> Iterator[Token]:
        name, start, end = node.macroname, node.pos, node.pos + node.len
        end = start + len(self.reader.text[start:end].rstrip())
        if name in SPACES or name in SIZES:
            return
        if name == "rule" and _STRUT.match(self.reader.text, start):
            return
        if name in ("\\", "cr"):
            self.space_below(node)
            yield Token("row", name, start, end)
        elif name in ("{", "}", "|"):
            yield Token({"{": "open", "}": "close"}.get(name, "bar"), name, start, end)
        elif name not in KNOWN:
            self.unknown(name, start)
        elif name in WORDS:
            yield Token("command", name, start, end, (self.word(node),))
        else:
            yield Token("command", name, start, end, self.arguments(node, name, start))

    def space_below(self, node: Any) -> None:
        """Accept a length in brackets at the end of a row: the space below the row."""
        for argument in (node.nodeargd.argnlist if node.nodeargd else None) or ():
            if argument is None:
                continue
            end = argument.pos + argument.len
            if not _LENGTH.fullmatch(self.reader.text[argument.pos : end]):
                message = "brackets after the end of a row must contain a length, such as `[3pt]`"
                self.reader.refuse("latex", message, argument.pos, end)

    def unknown(self, name: str, start: int) -> None:
        if name in ONLY_PRINTED and name not in REFUSED:
            self.reader.refuse("latex", f"`\\{name}` cannot be read", start, start + 1 + len(name))
        close = nearest(name, sorted(KNOWN, key=str.swapcase))
        suggested = f"did you mean `\\{close}`?" if close else None
        message, help_line = REFUSED.get(name, (f"`\\{name}` is not known", suggested))
        self.reader.refuse("latex", message, start, start + 1 + len(name), help_line)

    def arguments(self, node: Any, name: str, start: int) -> tuple[Argument | None, ...]:
        wanted = ARGUMENTS.get(name, "")
        found = tuple(node.nodeargd.argnlist or ()) if node.nodeargd else ()
        if len(found) != len(wanted) or any(a is None for a, spec in zip(found, wanted, strict=True) if spec == "{"):
            message = f"`\\{name}` needs {'two values' if wanted == '{{' else 'a value'} in braces"
            self.reader.refuse("latex", message, start, start + 1 + len(name))
        return tuple(self.argument(a) if a is not None else None for a in found)

    def argument(self, node: Any) -> Argument:
        tokens = tuple(_joined(self.reader, list(self.of([node]))))
        return Argument(tokens, node.pos, node.pos + node.len)

    def word(self, node: Any) -> Argument:
        """Return the text in the braces after a command, unchanged and as one token."""
        found = tuple(node.nodeargd.argnlist or ()) if node.nodeargd else ()
        if len(found) != 1 or found[0] is None:
            self.reader.refuse("latex", f"`\\{node.macroname}` needs a value in braces", node.pos)
        inner = found[0]
        text = self.reader.text[inner.pos : inner.pos + inner.len].strip().removeprefix("{").removesuffix("}").strip()
        return Argument((Token("word", text, inner.pos, inner.pos + inner.len),), inner.pos, inner.pos + inner.len)

    def environment(self, node: Any) -> Iterator[Token]:
        name, start = node.environmentname, node.pos
        if name in ALIGNMENTS:
            yield from self.of(node.nodelist)
        elif name in MATRICES:
            inside = tuple(_joined(self.reader, list(self.of(node.nodelist))))
            yield Token("matrix", name, start, start + node.len, inside=inside)
        else:
            message = "a determinant cannot be read" if name in ("vmatrix", "Vmatrix") else f"`{name}` is not known"
            help_line = did_you_mean(name, (*MATRICES, *ALIGNMENTS)) if "known" in message else None
            self.reader.refuse("latex", message, start, start + len(f"\\begin{{{name}}}"), help_line)

    def foreign(self, node: Any) -> None:
        if node.latex_verbatim().startswith("%"):
            self.reader.refuse("latex", "a comment is not part of a formula", node.pos, help="leave it out")
        self.reader.refuse("latex", "the whole text is a formula", node.pos, help="leave out the `$`")


def _joined(reader: Arithmetic, tokens: list[Token]) -> Iterator[Token]:
    r"""Join `\left` and `\right` with their brackets, and turn commands such as `\lvert` into brackets."""
    at = 0
    while at < len(tokens):
        token = tokens[at]
        at += 1
        if token.kind == "command" and token.text in ("left", "right"):
            bracket = tokens[at] if at < len(tokens) else None
            table, kind = (OPENING, "open") if token.text == "left" else (CLOSING, "close")
            if bracket is None or bracket.text not in table:
                found = f"`{bracket.text}` is not allowed" if bracket else "a bracket is missing"
                reader.refuse("latex", f"{found} after `\\{token.text}`", token.start, token.end)
            at += 1
            yield Token(kind, bracket.text, token.start, bracket.end)
        elif token.kind == "command" and token.text in ("lvert", "lbrace", "rvert", "rbrace"):
            yield Token("open" if token.text in OPENING else "close", token.text, token.start, token.end)
        else:
            yield token
