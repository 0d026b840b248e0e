r"""The headings and the formulas of a document, in order.

A display is a block of rows. A row that begins with a relation continues the chain of the row before it. A row that
begins with a sign after an alignment mark continues the last side of the row before it. So does a row if the row before
it ends with an operator or a relation, or has an open bracket. A statement is a chain of sides, such as `a = b = c`;
words and commas separate the statements of a row.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cached_property
from itertools import islice

from derive.documents.macros import Macro, argument_at, end_of_group, expanded, macros_of
from derive.documents.source import Format, Source, Span
from derive.documents.tokens import Kind, Token, TooLarge, tokens_of, without_spaces
from derive.units import UNIT_NAMES

ALIGNED = frozenset(
    [
        "IEEEeqnarray",
        "align",
        "alignat",
        "aligned",
        "alignedat",
        "displaymath",
        "dmath",
        "empheq",
        "eqnarray",
        "equation",
        "flalign",
        "gather",
        "gathered",
        "math",
        "multline",
        "split",
        "subequations",
    ]
)
SYSTEMS = ("cases", "dcases", "rcases", "empheq")
RELATIONS = {
    "=": "=", "<": "<", ">": ">",
    "leq": "<=", "le": "<=", "leqslant": "<=", "geq": ">=", "ge": ">=", "geqslant": ">=", "lt": "<", "gt": ">",
    "approx": "~", "simeq": "~", "cong": "~", "sim": "~", "approxeq": "~", "doteq": "~", "propto": "prop",
    "lesssim": "<", "gtrsim": ">", "lessapprox": "<", "gtrapprox": ">", "asymp": "~", "ll": "<<",
    "gg": ">>", "neq": "!=", "ne": "!=", "equiv": ":=", "coloneqq": ":=", "triangleq": ":=", "in": "in", "to": "to",
    "rightarrow": "to", "longrightarrow": "to", "mapsto": "to", "leftarrow": "to", "leftrightarrow": "to",
}  # fmt: skip
ARROWS = {
    "Rightarrow": "implies", "implies": "implies", "Longrightarrow": "implies", "therefore": "implies", "iff": "and",
    "Leftrightarrow": "and", "Longleftrightarrow": "and", "because": "since", "Leftarrow": "since", "land": "and",
    "lor": "or", "leadsto": "implies",
}  # fmt: skip
WIDE = {"quad", "qquad", "qq", "hspace", "hfill", "hskip"}
# Commands of the package physics that print a word, such as `\qthen`.
SPOKEN = {
    "qif": "if", "qthen": "then", "qelse": "else", "qotherwise": "otherwise", "qunless": "unless", "qgiven": "given",
    "qusing": "using", "qassume": "assume", "qsince": "since", "qlet": "let", "qfor": "for", "qall": "all",
    "qand": "and", "qor": "or", "qas": "as", "qwhere": "where", "qwith": "with", "qthus": "thus", "qwhile": "while",
}  # fmt: skip
WORDS = {"text", "textrm", "mbox", "textnormal", "intertext", "shortintertext", "textit", "textbf", "hbox", "textsf"}


SIGNS_OF_NOTES = ("dagger", "ddagger", "star", "ast", "square", "checkmark", "blacksquare")
MOST_FORMULAS = 20_000
NEAR = 400  # number of characters before a formula that are kept as its context
LONGEST_INLINE = 2_000  # the greatest number of characters of a formula in a sentence


class Cue(StrEnum):
    """Words near a formula that say where the formula comes from."""

    GIVEN = "given"
    DEFINED = "let"
    SINCE = "since"
    USING = "using"
    PUT_IN = "put in"
    APPROXIMATE = "to first order"
    CONSTANT = "constant"
    INCORRECT = "not"
    OTHER = "another equation"
    ZERO = "set to zero"
    LEAVES = "a force vanishes"
    LAW = "law"
    REPEATED = "repeated"


CUES = {
    Cue.APPROXIMATE: r"\bapproximat\w*|(?<!\\)\bsmall\b|\b(?:first|second|lowest|leading) order\b"
    r"|\bexpand\w*|\blineari[sz]\w*|\bneglect\w*|\bTaylor\b|\bignor\w+|\broughly\b|\babout\s*(?:\$?[\d.]|$)|\bseries\b",
    Cue.DEFINED: r"\blet\b|\bdefin\w+|\bdenot\w+|\bcall\b|\bcalled\b|\bintroduc\w+"
    r"|\bchoose\b|\bwrite\b|\bset\b|\bsetting\b",
    Cue.GIVEN: r"\bassum\w+|\bsuppos\w+|\bgiven\b|\bconsider\b|\bif\b|\bwhen\b|\bfor\b|\bat\b"
    r"|\bcases?\b|\blimit\w*",
    Cue.SINCE: r"\bsince\b|\bbecause\b|\bas\b|\brecall\w*|\bknow\b|\bremember\b",
    Cue.USING: r"\busing\b|\bwith\b|\bwhere\b|\bfrom\b|\bby\b|\buse\b|\bfollow\w*",
    Cue.PUT_IN: r"\bsubstitut\w+|\bplug\w*|\binsert\w*|\breplac\w+|\bput\b",
    Cue.CONSTANT: r"\bconstant\b|\bconst\b",
    Cue.ZERO: r"\bzero\b|\bvanish\w*|\bstationary\b|\bextrem\w+|\bminimum\b",
    Cue.LEAVES: r"\bleaves\b|\bloses contact\b|\blifts off\b|\bslack\b",
    Cue.LAW: r"\blaws?\b|\bprinciples?\b|\btheorem\b|\bdefinition\b|\bconserv\w+|\bconstrain\w+|\bansatz\b"
    r"|\bequations? of motion\b"
    r"|\bconditions?\b|\bNewton\w*|\bLagrange\w*|\bHamilton\w*|\bEuler\w*|\bidentit\w+|\btry\b|\bformula\b|\bmodel\w*",
    Cue.REPEATED: r"\brepeat\w*|\bonce more\b|\brecall\w*|\bwe (?:already )?found\b|\bfound (?:above|earlier|before)\b"
    r"|\bfrom (?:above|before|part)\b|\bcopied\b",
    Cue.OTHER: r"\b(?:homogeneous|complementary|unperturbed) (?:differential )?(?:equation|solution|part|motion)s?\b",
    Cue.INCORRECT: r"\bincorrect\b|\bwrong\b|\bnot true\b|\bguess\b|\bmistak\w+|\bcontradict\w+",
}
_CUES = {cue: re.compile(pattern, re.IGNORECASE) for cue, pattern in CUES.items()}


@dataclass(frozen=True)
class Side:
    tokens: tuple[Token, ...]
    span: Span


@dataclass
class Statement:
    """A chain of sides and the relations between them; `follows` is the statement whose last side this statement
    continues."""

    sides: list[Side]
    relations: list[str]
    span: Span
    row: Row
    link: str = ""
    words: str = ""
    follows: Statement | None = None
    listed: list[Side] = field(default_factory=list)  # further values of the last side: `x = 1, 2`


@dataclass
class Row:
    """A row of a display, or the formula of a sentence."""

    number: int
    span: Span
    line: int
    latex: str
    block: Block
    tag: str = ""
    label: str = ""
    statements: list[Statement] = field(default_factory=list)
    fault: tuple[str, Span] | None = None


@dataclass
class Block:
    """A display, or a formula in a sentence; `before` is the text between the previous formula and this one."""

    display: bool
    environment: str
    span: Span
    before: str
    sentence: str
    heading: int
    rows: list[Row] = field(default_factory=list)
    part: int = 0  # how many headings, items and marks such as (a) come before the block
    near: str = ""  # the last characters of the text before the block, with formulas

    @cached_property
    def cues(self) -> frozenset[Cue]:
        near = self.before[-400:]
        return frozenset(
            cue
            for cue, pattern in _CUES.items()
            if pattern.search(
                near if cue in (Cue.APPROXIMATE, Cue.ZERO, Cue.LEAVES) and self.display else self.sentence
            )
        )


@dataclass(frozen=True)
class Heading:
    text: str
    level: int
    span: Span


@dataclass
class Document:
    source: Source
    macros: dict[str, Macro]
    headings: list[Heading]
    blocks: list[Block]

    @property
    def rows(self) -> list[Row]:
        return [row for block in self.blocks for row in block.rows]


_SKIPPED = re.compile(
    r"^[ \t]*(?P<ticks>```+|~~~+)[^\n]*\n"
    r"|(?P<code>(?<!`)`[^`\n]+`(?!`))"
    r"|(?P<html><!--)"
    r"|\\begin\{(?P<verbatim>verbatim|lstlisting|minted|tikzpicture|comment|asy|python|thebibliography)\*?\}",
    re.MULTILINE,
)
_COMMENT = re.compile(r"(?<!\\)%[^\n]*")
_OPENING = re.compile(
    r"\\begin\{(?P<env>[A-Za-z]+)(?P<star>\*?)\}|(?P<dollars>(?<!\\)\$\$)|(?P<dollar>(?<!\\)\$)"
    r"|(?P<bracket>(?<!\\)\\\[)|(?P<paren>(?<!\\)\\\()"
)
PROBLEM_WORDS = (
    r"\b(?:problem|problema|problème|exercise|ejercicio|exercício|esercizio|exercice|question|aufgabe|example|beispiel"
    r"|ejemplo|esempio|exemple|opgave|oppgave|uppgift|zadanie|задача|упражнение|пример)s?\b|[第例]\s*\w*\s*题|例題|問題|문제"
)
_HEADING = re.compile(
    r"^(?P<marks>\#{1,6})[ \t]+(?P<words>[^\n]+)|\\(?P<level>part|chapter|section|subsection|subsubsection|paragraph)"
    r"\*?(?:\[[^\]]*\])?\{(?P<title>[^\n]*)\}|^\s*\\begin\{(?P<problem>problem|exercise|question|solution|example)\}"
    r"|^\s*\\begin\{(?P<numbered>proof)\}[\[{](?:\\textbf\{)?[^\n\]}]*\d"
    rf"|^\s*(?:\*\*|__|(?:\\noindent\s*)?\\textbf\{{)\s*(?P<bold>(?:{PROBLEM_WORDS})[^\n*}}]*)",
    re.MULTILINE | re.IGNORECASE,
)
_PART = re.compile(
    r"\\item\b|\\begin\{(?:solution|proof|problem|exercise|example)\}|^[ \t]*\*\*\w+"
    r"|^[ \t]*(?:[*_]{0,2}|\\textbf\{)\(?[a-h]\)"
    r"|^[ \t]*(?:\\(?:big|med|small)skip)?\\noindent\\textbf\{|^:::+\s*\{|^[ \t]*\d+\.\s",
    re.MULTILINE,
)
_LEVELS = {"part": 0, "chapter": 0, "section": 1, "subsection": 2, "subsubsection": 3, "paragraph": 4}
_LINE_BREAK = re.compile(r"\n[ \t]*\n")
_CARRIED_ON = re.compile(r"\$[ ~{}]*=[ ~{}]*\$[^$\n]+\$")  # a relation between two formulas of a sentence: `$a$~=~$b$`


def read_document(source: Source) -> Document:
    """Return the formulas, headings and macros of a document."""
    text, (own, definitions) = source.text, macros_of(source.text)
    macros = macros_of(source.included)[0] | own
    hidden = list(_skipped(text)) + definitions
    begins = text.find(r"\begin{document}")
    if begins >= 0:
        hidden.append(Span(0, begins))
    if source.format is Format.TEX:
        hidden += [Span(*found.span()) for found in _COMMENT.finditer(text)]
    hidden.sort()
    headings = [
        Heading(*_title(found), Span(*found.span()))
        for found in _HEADING.finditer(text)
        if not _covered(hidden, found.start())
    ]
    reading = _Reading(source, macros, hidden, headings)
    return Document(source, macros, headings, reading.blocks())


def _skipped(text: str) -> Iterator[Span]:
    """Yield the places of code, comments and pictures; an opening without its end is ignored."""
    position = 0
    missing: set[str] = set()
    while opening := _SKIPPED.search(text, position):
        position = opening.end()
        if opening["code"]:
            yield Span(*opening.span())
            continue
        closing = "-->" if opening["html"] else opening["ticks"] or f"\\end{{{opening['verbatim']}"
        close = -1 if closing in missing else text.find(closing, position)
        if close < 0:
            missing.add(closing)
            continue
        line_end = text.find("\n", close)
        inside = opening["html"] or opening["verbatim"]
        position = close + len(closing) if inside else (line_end if line_end >= 0 else len(text))
        yield Span(opening.start(), position)


def _title(found: re.Match[str]) -> tuple[str, int]:
    if found["marks"]:
        return found["words"].strip(), len(found["marks"])
    if found["problem"] or found["bold"]:
        return found["problem"] or found["bold"], 3
    if found["numbered"]:
        return "problem", 3
    return found["title"], _LEVELS[found["level"]]


def _covered(spans: Sequence[Span], position: int) -> Span | None:
    at = bisect_right(spans, Span(position, 1 << 60)) - 1
    for span in spans[max(0, at - 3) : at + 1]:
        if span.start <= position < span.end:
            return span
    return None


class _Reading:
    def __init__(self, source: Source, macros: dict[str, Macro], hidden: list[Span], headings: list[Heading]):
        self.source, self.text, self.macros, self.hidden, self.headings = source, source.text, macros, hidden, headings
        self.count = 0
        self.last: Statement | None = None
        self.main: Statement | None = None  # the statement that a row with a relation at its beginning continues
        self.parts = sorted([*(each.span.start for each in headings), *(m.start() for m in _PART.finditer(self.text))])

    def blocks(self) -> list[Block]:
        found: list[Block] = []
        done = 0
        for outer, inner, display, environment in islice(self.formulas(), MOST_FORMULAS):
            before = self.text[max(done, outer.start - 2000) : outer.start]
            starts = [heading.span.start for heading in self.headings]
            heading = bisect_right(starts, outer.start) - 1
            if heading >= 0 and self.headings[heading].span.end > done:
                before = self.text[max(self.headings[heading].span.end, outer.start - 2000) : outer.start]
            block = Block(display, environment, outer, before, self.sentence(outer, display), heading)
            block.part = bisect_right(self.parts, outer.start)
            block.near = self.text[max(0, outer.start - NEAR) : outer.start]
            self.read_rows(block, inner)
            found.append(block)
            done = outer.end
        return found

    def sentence(self, outer: Span, display: bool) -> str:
        before = self.text[max(0, outer.start - 600) : outer.start]
        before = re.split(r"[.!?]\s+(?=[A-Z$\\])|\n[ \t]*\n(?=\S)|\$\$\s*(?=[A-Z])", before.rstrip() + " ")[-1]
        if not before.strip() or len(before.strip()) < 3:
            paragraphs = self.text[max(0, outer.start - 600) : outer.start].rstrip().split("\n\n")
            before = paragraphs[-1][-200:]
        after = "" if display else re.split(r"[.!?]\s|\n\n", self.text[outer.end : outer.end + 200])[0]
        return re.sub(r"\$[^$]*\$", " ", before + " " + after)

    def formulas(self) -> Iterator[tuple[Span, Span, bool, str]]:
        unclosed: dict[str, int] = {}
        position = 0
        while opening := _OPENING.search(self.text, position):
            if covering := _covered(self.hidden, opening.start()):
                position = max(covering.end, opening.start() + 1)
                continue
            position = opening.end()
            if opening["env"]:
                if opening["env"] not in ALIGNED:
                    continue
                name = opening["env"] + opening["star"]
                close = self.text.find(f"\\end{{{name}}}", position)
                if close < 0:
                    continue
                outer = Span(opening.start(), close + len(f"\\end{{{name}}}"))
                yield outer, outer, True, opening["env"]
                position = outer.end
                continue
            closing, display = {
                "dollars": (r"(?<!(?<!\\)\\)\$\$", True),
                "dollar": (r"(?<!(?<!\\)\\)\$", False),
                "bracket": (r"(?<!\\)\\\]", True),
                "paren": (r"(?<!\\)\\\)", False),
            }[str(opening.lastgroup)]
            if unclosed.get(closing, 0) > position:
                continue
            reach = len(self.text) if display else min(len(self.text), position + LONGEST_INLINE)
            close_at = re.compile(closing).search(self.text, position, reach)
            if close_at is None:
                unclosed[closing] = reach  # no sign before this position closes a formula of this kind
                continue
            if not display and _LINE_BREAK.search(self.text, position, close_at.start()):
                continue  # this dollar sign does not open a formula
            end, after = close_at.span()
            while opening["dollar"] and (more := _CARRIED_ON.match(self.text, end)):
                end, after = more.end() - 1, more.end()
            yield Span(opening.start(), after), Span(position, end), display, ""
            position = after

    def read_rows(self, block: Block, inner: Span) -> None:
        try:
            written = _without_definitions(tokens_of(self.text, inner.start, inner.end))
            written = [each for each in written if block.display or not each.is_mark("$")]
            tokens = _simplified(expanded(written, self.macros))
        except TooLarge as error:
            row = self.row(block, inner)
            row.fault = (str(error), error.span)
            return
        for cells, tag, label in rows_of(tokens):
            last = "".join(each.text for each in without_spaces(cells[-1]))
            if len(cells) > 1 and re.fullmatch(r"\(\d+\w?\)", last):  # the number of an equation in its own cell
                tag = tag or last[1:-1]
                del cells[-1]
            flat = [token for cell in cells for token in cell]
            if not without_spaces(flat):
                continue
            if begun := self.begun_side(block, cells):
                first, *others = filter(without_spaces, cells)
                cells = [[*begun, *_without_indent(first)], *others]
            flat = [token for cell in cells for token in cell]
            rest, after = self.rest_of_side(block, cells)
            solid = without_spaces(flat)
            if not any(map(_is_relation, solid)) and _is_mark_in_text(solid):
                continue
            row = rest or self.row(block, Span(solid[0].span.start, solid[-1].span.end))
            row.tag, row.label = tag or row.tag, label or row.label
            if rest is not None:
                row.latex += " " + self.text[flat[0].span.start : flat[-1].span.end]
                cells = [after]
            before = self.main if block.display and (rest is not None or block.rows[:-1]) else None
            for statement in statements_of(cells, row, before):
                row.statements.append(statement)
                self.last = statement
            self.main = _main(row.statements) or self.main

    def row(self, block: Block, span: Span) -> Row:
        self.count += 1
        row = Row(self.count, span, self.source.line_of(span.start), self.text[span.start : span.end].strip(), block)
        block.rows.append(row)
        return row

    def begun_side(self, block: Block, cells: list[list[Token]]) -> list[Token]:
        """Remove the previous rows in which the left side of a row begins, and return their tokens."""
        begun: list[Token] = []
        tokens = _without_indent([token for cell in cells for token in cell])
        if not any(map(_is_relation, _outside_brackets(tokens))):
            return []
        while block.display and block.rows and len(block.rows[-1].statements) == 1:
            (before,) = block.rows[-1].statements
            first = next(iter([*begun, *tokens]))
            goes_on = first.is_mark("+", "-", "(", "[") or first.is_command("left", "times", "cdot")
            if before.relations or block.rows[-1].fault or not (goes_on or _is_open(before.sides[0].tokens)):
                break
            begun = [*before.sides[0].tokens, *begun]
            block.rows.pop()
            self.last = None
        return begun

    def rest_of_side(self, block: Block, cells: list[list[Token]]) -> tuple[Row | None, list[Token]]:
        """Add the tokens before the first relation to the last side of the previous row if they continue it. Return
        this row and the other tokens, or None and no tokens."""
        tokens = _without_indent([token for cell in cells for token in cell])
        if not block.rows or not block.rows[-1].statements or self.last is None or not tokens:
            return None, []
        row, last = block.rows[-1], self.last.sides[-1]
        written = [each for each in last.tokens if not each.is_command(*WIDE, ",", ";", " ", "!", ":")]
        open_end = bool(written) and (
            written[-1].is_mark("+", "-", "*", "/") or written[-1].is_command("cdot", "times", "pm", "mp")
        )
        open_end = open_end or _is_open(last.tokens) or not last.tokens
        begins = tokens[0].is_mark("+", "-") or tokens[0].is_command("times", "cdot", "pm", "mp")
        second_cell = len(cells) > 1 and not without_spaces(cells[0])
        one_formula = block.environment.startswith("multline")
        if not open_end and not (begins and (second_cell or one_formula)):
            return None, []
        after: list[Token] = []
        outside = [] if _is_open(last.tokens) else _outside_brackets(tokens)
        relation = next((each for each in outside if _is_relation(each)), None)
        if relation is not None:
            aligned = (
                self.text[: row.span.start].rstrip().endswith("&")
            )  # then the row before begins in its second cell
            if not self.last.relations or not begins or aligned or row.latex.endswith((",", ".", ";")):
                return None, []
            at = tokens.index(relation)
            tokens, after = tokens[:at], tokens[at:]
        start = last.span.start if last.tokens else tokens[0].span.start
        joined = Side((*last.tokens, *tokens), Span(start, tokens[-1].span.end))
        self.last.sides[-1] = joined
        self.last.span = Span(self.last.span.start, joined.span.end)
        return row, after


def _without_indent(tokens: list[Token]) -> list[Token]:
    """Return the tokens of a row without the horizontal space at its beginning."""
    tokens = without_spaces(tokens)
    while tokens and tokens[0].is_command("quad", "qquad", ",", ";", " ", "!", ":", "hspace", "phantom", "hphantom"):
        skip = argument_at(tokens, 1)[1] if tokens[0].text in ("hspace", "phantom", "hphantom") else 1
        tokens = tokens[skip:]
    return tokens


def _is_mark_in_text(tokens: list[Token]) -> bool:
    """Whether a formula is only a part of the text: degrees after a number, `3_{rd}`, or a sign such as `(*)`."""
    if tokens[0].kind is Kind.SCRIPT:
        return True
    if all(each.is_mark("(", ")", "*") or each.is_command(*SIGNS_OF_NOTES) for each in tokens):
        return True
    written = "".join(each.text for each in tokens if each.kind not in (Kind.OPEN, Kind.CLOSE))
    return bool(re.fullmatch(r"\w+[_^](?:st|nd|rd|th)", written))


def _without_definitions(tokens: list[Token]) -> list[Token]:
    """Leave out the definitions of commands inside a formula; these commands are already known."""
    found: list[Token] = []
    at = 0
    while at < len(tokens):
        token = tokens[at]
        at += 1
        if not token.is_command("newcommand", "renewcommand", "providecommand", "DeclareMathOperator"):
            found.append(token)
            continue
        _, at = argument_at(tokens, at)
        while at < len(tokens) and tokens[at].is_mark("["):
            at = next((i + 1 for i in range(at, len(tokens)) if tokens[i].is_mark("]")), len(tokens))
        _, at = argument_at(tokens, at)
    return found


def _simplified(tokens: list[Token]) -> list[Token]:
    r"""Leave out frames around equations and lines between rows, and write words and relations in one form.

    `\qq{so}` of the package physics becomes `\text{so}`, and `\stackrel{(1)}{=}` becomes `=`.
    """
    found: list[Token] = []
    at = 0
    double_bars = _has_double_bars(tokens)
    while at < len(tokens):
        token = tokens[at]
        at += 1
        if double_bars and token.is_mark("|"):
            found.append(replace(token, kind=Kind.COMMAND, text="Vert"))
            at += 1
        elif token.is_mark(".") and all(each.is_mark(".") for each in tokens[at - 1 : at + 2]) and at + 1 < len(tokens):
            found.append(replace(token, kind=Kind.COMMAND, text="ldots"))
            at += 2
        elif token.kind is Kind.OPEN and (number := _with_decimal_comma(found, tokens[at : at + 3])) is not None:
            found[-1] = number
            at += 3
        elif token.is_command("not") and at < len(tokens) and tokens[at].kind is Kind.SPACE:
            tokens = [*tokens[:at], *without_spaces(tokens[at:])]
            at -= 1
        elif token.is_command("not") and at < len(tokens) and tokens[at].is_mark("="):
            found.append(replace(token, text="neq"))
            at += 1
        elif token.is_command("displaybreak"):
            at = _bracket_at(tokens, at)[1] if at < len(tokens) and tokens[at].is_mark("[") else at
        elif token.is_command("boxed", "fbox", "tightboxed", "Aboxed"):
            inner, at = argument_at(tokens, at)
            found += _simplified(inner)
        elif token.is_command("underline", "ensuremath", "textcolor", "colorbox") and _has_relation(
            argument_at(tokens, argument_at(tokens, at)[1] if token.text.endswith("color") else at)[0]
        ):
            if token.text.endswith("color"):
                _, at = argument_at(tokens, at)
            inner, at = argument_at(tokens, at)
            found += _simplified(inner)
        elif token.is_command("left") and (system := _system_at(tokens, at - 1)) is not None:
            inner, at = system
            found += [*_environment_sign(token, "begin", "cases"), *inner, *_environment_sign(token, "end", "cases")]
        elif token.is_command("mqty", "pmqty", "bmqty", "vmqty", "smqty") and at < len(tokens):
            inner, at = _bracket_at(tokens, at)
            name = "vmatrix" if token.text == "vmqty" else "pmatrix"
            found += [*_environment_sign(token, "begin", name), *inner, *_environment_sign(token, "end", name)]
        elif token.is_command("eval") and at < len(tokens) and tokens[at].is_command("cdot"):
            while at < len(tokens) and not tokens[at].is_command(*ARROWS, "\\\\", "qc", "quad", "qquad"):
                at += 1  # the note `| \cdot 2` says that both sides are multiplied by 2
        elif token.is_command("hline", "midrule", "toprule", "bottomrule", "centering"):
            continue
        elif token.is_command("qq"):
            if at < len(tokens) and tokens[at].is_mark("*"):
                at += 1
            found.append(replace(token, text="text"))
        elif token.is_command("qc", "qcomma"):
            found += [replace(token, kind=Kind.MARK, text=","), replace(token, text="quad")]
        elif token.kind is Kind.COMMAND and (word := SPOKEN.get(token.text.removesuffix("*"))):
            found += [
                replace(token, text="text"),
                replace(token, kind=Kind.OPEN, text="{"),
                *(replace(token, kind=Kind.LETTER, text=letter) for letter in word),
                replace(token, kind=Kind.CLOSE, text="}"),
            ]
        elif token.is_command("stackrel", "overset", "underset"):
            _, after = argument_at(tokens, at)
            inner, after = argument_at(tokens, after)
            if len(without_spaces(inner)) == 1 and _is_relation(without_spaces(inner)[0]):
                found += without_spaces(inner)
                at = after
            else:
                found.append(token)
        else:
            found.append(token)
    return _without_outer_braces(found)


def _has_double_bars(tokens: list[Token]) -> bool:
    """Whether a norm is written with `||`: all bars appear in pairs, and not as in `|a||b|`."""
    bars = [each for each in tokens if each.is_mark("|")]
    pairs = list(zip(bars[::2], bars[1::2], strict=False))
    return len(bars) >= 4 and len(bars) % 4 == 0 and all(one.span.end == other.span.start for one, other in pairs)


def _with_decimal_comma(before: list[Token], rest: list[Token]) -> Token | None:
    """Return `0{,}25`, with its comma in braces, as the number 0.25; None if the tokens are not such a number."""
    if not before or before[-1].kind is not Kind.NUMBER or len(rest) < 3 or "." in before[-1].text:
        return None
    if not (rest[0].is_mark(",") and rest[1].kind is Kind.CLOSE and rest[2].kind is Kind.NUMBER):
        return None
    return replace(before[-1], text=f"{before[-1].text}.{rest[2].text}", span=before[-1].span.to(rest[2].span))


def _system_at(tokens: list[Token], at: int) -> tuple[list[Token], int] | None:
    r"""Return the rows of `\left\{ \begin{array}{l} ... \end{array} \right.` and the position after it, or None."""
    head = without_spaces(tokens[at : at + 8])
    if len(head) < 3 or not head[1].is_command("{", "lbrace") or not head[2].is_command("begin"):
        return None
    begin = next(i for i in range(at, len(tokens)) if tokens[i] is head[2])
    name, after = _environment(tokens, begin + 1)
    end = next((i for i in range(after, len(tokens)) if tokens[i].is_command("end")), None)
    if name not in ("array", "align", "align*", "aligned", "gathered", "split") or end is None:
        return None
    last, close = _environment(tokens, end + 1)
    rest = without_spaces(tokens[close : close + 4])
    if last != name or len(rest) < 2 or not rest[0].is_command("right") or not rest[1].is_mark("."):
        return None
    if name == "array":
        _, after = argument_at(tokens, after)
    stop = next(i for i in range(close, len(tokens)) if tokens[i] is rest[1])
    return tokens[after:end], stop + 1


def _bracket_at(tokens: list[Token], at: int) -> tuple[list[Token], int]:
    """Return the tokens inside the bracket or the braces at a position, and the position after the closing one."""
    if not tokens[at].is_mark("(", "["):
        return argument_at(tokens, at)
    for end, (token, depth) in enumerate(depths(tokens[at:])):
        if end and depth == 0 and token.is_mark(")", "]"):
            return tokens[at + 1 : at + end], at + end + 1
    return tokens[at + 1 :], len(tokens)


def _environment_sign(token: Token, sign: str, name: str) -> list[Token]:
    return [
        replace(token, text=sign),
        replace(token, kind=Kind.OPEN, text="{"),
        *(replace(token, kind=Kind.LETTER, text=letter) for letter in name),
        replace(token, kind=Kind.CLOSE, text="}"),
    ]


def _without_outer_braces(tokens: list[Token]) -> list[Token]:
    """Leave out braces around a whole formula with a relation."""
    solid = without_spaces(tokens)
    if len(solid) < 3 or solid[0].kind is not Kind.OPEN or solid[-1].kind is not Kind.CLOSE:
        return tokens
    inner, after = argument_at(solid, 0)
    return inner if after == len(solid) and any(map(_is_relation, inner)) else tokens


def _depth_change(token: Token) -> int:
    if token.kind is Kind.OPEN or token.is_mark("(", "[") or token.is_command("left", "begin", "{", "langle", "lbrace"):
        return 1
    if token.kind is Kind.CLOSE or token.is_mark(")", "]") or token.is_command("right", "end", "}", "rangle", "rbrace"):
        return -1
    return 0


def depths(tokens: Sequence[Token]) -> Iterator[tuple[Token, int]]:
    r"""Yield each token with the depth of the brackets around it; a bracket after `\left` is part of `\left`."""
    depth = 0
    before: Token | None = None
    for token in tokens:
        after_size = before is not None and before.is_command("left", "right")
        change = 0 if after_size else _depth_change(token)
        depth = max(0, depth + min(0, change))
        yield token, depth
        depth += max(0, change)
        before = token


def _is_open(tokens: Sequence[Token]) -> bool:
    """Whether a bracket is not closed, so that the next row continues inside it."""
    return sum(each.is_mark("(", "[") - each.is_mark(")", "]") for each in tokens) > 0


def _outside_brackets(tokens: Sequence[Token]) -> list[Token]:
    return [token for token, depth in depths(tokens) if depth == 0]


def _environment(tokens: Sequence[Token], at: int) -> tuple[str, int]:
    name, after = argument_at(tokens, at)
    return "".join(each.text for each in name), after


def rows_of(tokens: Sequence[Token]) -> list[tuple[list[list[Token]], str, str]]:
    r"""Return the rows of a display: their cells, tag and label. The rows of a matrix, and of a `cases` that is not a
    system of equations, are not separated.
    """
    rows: list[tuple[list[list[Token]], str, str]] = []
    cells: list[list[Token]] = [[]]
    tag = label = ""
    inside = depth = at = 0  # `inside` counts open environments that are not split, `depth` counts open braces
    system = False  # whether the rows are the equations of a system behind a brace
    while at < len(tokens):
        token = tokens[at]
        at += 1
        if token.is_command("begin", "end"):
            name, after = _environment(tokens, at)
            bare = name.rstrip("*")
            splits = bare in ALIGNED or (bare == "array" and not inside and _is_alignment(tokens, at - 1))
            if bare in SYSTEMS and not inside and not splits:
                begins = token.text == "begin" and not without_spaces([each for cell in cells for each in cell])
                splits = system if token.text == "end" else begins and _is_alignment(tokens, at - 1)
                system = splits and token.text == "begin"
            if splits and not inside:
                if token.text == "begin" and bare in ("alignat", "alignedat", "array", "IEEEeqnarray"):
                    _, after = argument_at(tokens, after)
                elif token.text == "begin" and after < len(tokens) and tokens[after].is_mark("["):
                    close = next((i for i in range(after, len(tokens)) if tokens[i].is_mark("]")), after)
                    after = close + 1
                at = after
                continue
            inside = max(0, inside + (1 if token.text == "begin" else -1))
            cells[-1] += tokens[at - 1 : after]
            at = after
            continue
        if inside == 0 and depth == 0:
            if token.is_command("\\", "newline", "cr"):
                while at < len(tokens) and tokens[at].kind is Kind.SPACE:
                    at += 1
                if at < len(tokens) and tokens[at].is_mark("["):
                    near = range(at, min(at + 8, len(tokens)))
                    at = next((i + 1 for i in near if tokens[i].is_mark("]")), at)
                rows.append((cells, tag, label))
                cells, tag, label = [[]], "", ""
                continue
            if token.kind is Kind.CELL:
                cells.append([])
                continue
        if token.is_command("tag", "label", "eqref", "ref"):
            if token.text == "tag" and at < len(tokens) and tokens[at].is_mark("*"):
                at += 1
            value, at = argument_at(tokens, at)
            written = "".join(each.text for each in value)
            tag, label = (written, label) if token.text == "tag" else (tag, written if token.text == "label" else label)
            continue
        if token.is_command("nonumber", "notag", "displaystyle", "textstyle", "scriptstyle", "limits", "nolimits"):
            continue
        depth = max(0, depth + (token.kind is Kind.OPEN) - (token.kind is Kind.CLOSE))
        cells[-1].append(token)
    rows.append((cells, tag, label))
    return rows


def _is_alignment(tokens: Sequence[Token], begin: int) -> bool:
    r"""Whether an `array` aligns equations: it contains a relation, and no `\left` with a bracket is before it."""
    before = [each for each in tokens[max(0, begin - 3) : begin] if each.kind is not Kind.SPACE]
    if len(before) >= 2 and before[-2].is_command("left"):
        return False
    if tokens[begin].text == "end":
        return True
    depth = 0
    for at in range(begin, len(tokens)):
        if tokens[at].is_command("begin"):
            depth += 1
        elif tokens[at].is_command("end"):
            depth -= 1
            if depth == 0:
                return False
        elif depth == 1 and (tokens[at].is_mark("=", "<", ">") or tokens[at].is_command(*RELATIONS)):
            return True
    return False


def statements_of(cells: list[list[Token]], row: Row, before: Statement | None) -> list[Statement]:
    """Return the statements of a row; a row that begins with a relation continues the statement before it."""
    found: list[Statement] = []
    for column in _columns(cells):
        for tokens, link, words in _pieces(column):
            statement = _chain(tokens, row, link, words)
            if statement is None:
                continue
            if not statement.sides[0].tokens:
                previous = _main(found) or before
                if previous is None or not statement.sides[1:]:
                    statement.sides, statement.relations = statement.sides[1:], statement.relations[1:]
                    if not statement.sides:
                        continue
                else:
                    # a relation at the end of a row is repeated at the beginning of the next row
                    if len(previous.sides) > 1 and not previous.sides[-1].tokens:
                        del previous.sides[-1], previous.relations[-1]
                    statement.follows = previous
                    statement.sides[0] = previous.sides[-1]
            if found and not statement.relations and statement.link == "list" and found[-1].relations:
                found[-1].listed.append(statement.sides[0])
                continue
            found.append(statement)
    return found


def _main(statements: list[Statement]) -> Statement | None:
    main, aside = None, False
    for each in statements:
        aside = each.link in ("where", "if", "since") or (aside and each.link in ("and", "list"))
        main = main if aside else each
    return main


def _columns(cells: list[list[Token]]) -> Iterator[list[Token]]:
    """Yield the tokens of each equation of a row of `align`; every second `&` separates two equations, if both have a
    relation sign."""
    column: list[Token] = []
    for number, cell in enumerate(cells):
        begins = next((each for each in cell if each.kind is not Kind.SPACE), None)
        relation = begins is not None and (begins.is_mark(*RELATIONS) or begins.is_command(*RELATIONS))
        if (
            number >= 2
            and number % 2 == 0
            and not relation
            and _has_relation(column)
            and _has_relation(cell, cells, number)
        ):
            yield column
            column = []
        column += cell
    yield column


def _has_relation(cell: list[Token], cells: list[list[Token]] | None = None, number: int = 0) -> bool:
    tokens = cell if cells is None else [token for each in cells[number : number + 2] for token in each]
    return any(each.is_mark(*RELATIONS) or each.is_command(*RELATIONS) for each in _outside_brackets(tokens))


def _pieces(tokens: list[Token]) -> Iterator[tuple[list[Token], str, str]]:
    """Split a row where words, arrows, wide spaces, semicolons or commas separate statements."""
    piece: list[Token] = []
    link, words = "", ""
    at = 0
    levels = list(depths(tokens))
    while at < len(tokens):
        token, depth = levels[at]
        if depth == 0 and token.is_command(*WORDS):
            value, after = argument_at(tokens, at + 1)
            said = "".join(" " if each.kind is Kind.SPACE else each.text for each in value).strip()
            solid = without_spaces(piece)
            if _is_unit_or_label(said, piece) or (solid and _is_relation(solid[-1])):
                piece += tokens[at:after]
                at = after
                continue
            yield piece, link, words
            piece, link, words = [], _link(said), said
            at = after
            continue
        if depth == 0 and token.is_command(*ARROWS):
            yield piece, link, words
            piece, link, words = [], ARROWS[token.text], ""
            at += 1
            continue
        if depth == 0 and (token.is_mark(",", ";") or token.is_command("quad", "qquad")) and piece:
            rest = tokens[at + 1 :]
            separates = token.is_mark(";") or _has_relation(_next_piece(rest))
            if token.is_mark(",") or separates:
                yield piece, link, words
                piece, link, words = [], "and" if separates else "list", ""
                at += 1
                continue
        piece.append(token)
        at += 1
    yield piece, link, words


def _is_relation(token: Token) -> bool:
    return token.is_mark(*RELATIONS) or token.is_command(*RELATIONS)


def _next_piece(tokens: list[Token]) -> list[Token]:
    """Return the tokens up to the next comma, semicolon, word or arrow outside of brackets."""
    found = []
    for token, depth in depths(tokens):
        if depth == 0 and (token.is_mark(",", ";") or token.is_command(*WORDS, *ARROWS)):
            break
        found.append(token)
    return found


def _is_unit_or_label(said: str, piece: list[Token]) -> bool:
    if not said or not piece:
        return False
    if piece[-1].kind is Kind.SCRIPT:
        return True
    solid = [each for each in piece if not each.is_command(",", ";", " ", "!", ":")]
    piece = solid or piece
    if piece[-1].kind is Kind.NUMBER:
        return bool(re.fullmatch(r"[A-Za-zµΩ°/.^\d\s²³⁻·-]{1,12}", said))
    return "/" in said and all(each in UNIT_NAMES for each in re.split(r"[/\s.·]+", said) if each)


def _link(said: str) -> str:
    said = said.lower()
    for word, link in (
        ("or", "or"), ("and", "and"), ("so", "implies"), ("hence", "implies"), ("thus", "implies"), ("where", "where"),
        ("with", "where"), ("using", "where"), ("since", "since"), ("while", "where"), ("if", "if"), ("when", "if"),
        ("for", "if"), ("as", "since"), ("given", "where"), ("let", "where"),
    ):  # fmt: skip
        if re.search(rf"\b{word}\b", said):
            return link
    return "and"


def _without_range(tokens: list[Token]) -> list[Token]:
    r"""Leave out the range of an index after an equation: `\quad (i = 1, 2, \ldots, n)`."""
    if not tokens or not tokens[-1].is_mark(")"):
        return tokens
    begins = [at for at, (token, depth) in enumerate(depths(tokens)) if depth == 0 and token.is_mark("(")]
    if not begins or not begins[-1]:
        return tokens
    inside = tokens[begins[-1] + 1 : -1]
    parts = [each for each in inside if each.is_mark(",") or each.is_command("ldots", "cdots", "dots", "in")]
    if not parts or not any(each.is_mark("=") or each.is_command("in") for each in inside[:6]):
        return tokens
    before = tokens[begins[-1] - 1]
    apart = before.is_command("quad", "qquad", " ", ";", ",", ":") or before.kind in (Kind.CLOSE, Kind.NUMBER)
    rest = tokens[: begins[-1]]
    while rest and rest[-1].is_command("quad", "qquad", " ", ";", ",", ":"):
        rest.pop()
    return rest if apart and any(map(_is_relation, rest)) else tokens


def _chain(tokens: list[Token], row: Row, link: str, words: str) -> Statement | None:
    tokens = without_spaces(tokens)
    while tokens and (
        tokens[-1].is_mark(".", ",", ";", ":")
        or tokens[-1].is_command("quad", "qquad", ",", ";", "!", " ", ":", "qedhere")
    ):
        tokens.pop()
    while tokens and tokens[0].is_command("quad", "qquad", ",", ";", "!", " ", ":"):
        tokens.pop(0)
    if not tokens:
        return None
    tokens = _without_range(tokens)
    sides: list[list[Token]] = [[]]
    relations: list[str] = []
    for at, (token, depth) in enumerate(depths(tokens)):
        relation = RELATIONS.get(token.text) if token.kind in (Kind.MARK, Kind.COMMAND) and depth == 0 else None
        if relation is not None and token.is_mark("=") and at and tokens[at - 1].is_mark(":"):
            sides[-1].pop()
            relation = ":="
        if relation is not None and token.is_mark("=") and sides[-1] and sides[-1][-1].is_mark("!"):
            if len(sides[-1]) < 2 or sides[-1][-2].kind is not Kind.NUMBER:  # not the factorial of a number
                sides[-1].pop()
        if relation is None:
            sides[-1].append(token)
        else:
            relations.append(relation)
            sides.append([])
    if relations[:1] == ["to"] and any(each.is_mark(":") for each in sides[0]):  # `F: A \to B` declares a function
        sides[0] = sides[0][next(i for i, each in enumerate(sides[0]) if each.is_mark(":")) + 1 :]
    for side in sides:
        while len(side) > 1 and side[-1].is_mark(".", ",", ";", ":"):
            side.pop()
    made = []
    at_end = tokens[-1].span.end
    for side in sides:
        span = Span(side[0].span.start, side[-1].span.end) if side else Span(at_end, at_end)
        made.append(Side(tuple(side), span))
    return Statement(made, relations, Span(tokens[0].span.start, at_end), row, link, words)


__all__ = ["Block", "Cue", "Document", "Heading", "Row", "Side", "Statement", "end_of_group", "read_document"]
