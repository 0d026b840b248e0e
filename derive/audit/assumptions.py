"""Equations that the reader of a document assumes, and kinds of letters that the reader declares.

An equation is written as in LaTeX, or in plain characters: `rho = M/(6 a^3)`. The text is read by the parser of
documents; no part of it is executed as code.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from derive.documents.facts import KINDS, Identity
from derive.documents.parser import Unreadable, parsed
from derive.documents.source import Span
from derive.documents.syntax import Group, Letter, Node
from derive.documents.tokens import Token, TooLarge, tokens_of
from derive.documents.vocabulary import FUNCTIONS, GREEK
from derive.errors import Complaint, Misused, did_you_mean

_WORD = re.compile(r"(?<![\\A-Za-z])(?P<word>[A-Za-z]{2,})")
_SUBSCRIPT = re.compile(r"(?<=[A-Za-z])_(?P<sub>[A-Za-z0-9]{2,})")
LONGEST = 2000  # the greatest number of characters in an assumed equation
MOST_SYMBOLS = 1000


@dataclass(frozen=True)
class Assumed:
    """An equation that is assumed to hold in the whole document."""

    left: Node
    right: Node
    text: str


def assumed_of(text: str) -> Assumed:
    """Parse a typed equation, such as `rho = M/(6 a^3)` or `I_1 = \\frac{1}{2} M R^2`."""
    if len(text) > LONGEST:
        raise Misused(Complaint("assumption", f"an assumed equation has at most {LONGEST} characters"))
    if text.count("=") != 1:
        raise Misused(
            Complaint("assumption", f"`{text[:80]}` must contain exactly one `=`", help='such as "rho = M/(6 a^3)"')
        )
    left, right = (_read(side, text) for side in text.split("="))
    return Assumed(left, right, text.strip())


def _read(side: str, whole: str) -> Node:
    try:
        return parsed(_tokens(side))
    except (Unreadable, TooLarge, RecursionError) as error:
        raise Misused(Complaint("assumption", f"`{whole.strip()[:80]}` is not read: {error}")) from None


def _tokens(text: str) -> list[Token]:
    return tokens_of(_as_latex(text.strip().strip("$")))


def _as_latex(text: str) -> str:
    """Return plain characters as LaTeX: `rho` as `\\rho`, `sin(x)` as `\\sin(x)`, `x_cm` as `x_{cm}`."""
    if "\\" in text:
        return text

    def command(found: re.Match[str]) -> str:
        word = found["word"]
        if word == "sqrt":
            return r"\sqrt"
        return f"\\{word} " if word in GREEK or word in FUNCTIONS else word

    text = _SUBSCRIPT.sub(r"_{\g<sub>}", text)
    text = re.sub(r"\^(-?\d{2,}|-\d)", r"^{\1}", text)
    text = _WORD.sub(command, text)
    return re.sub(r"\\sqrt\(([^()]*)\)", r"\\sqrt{\1}", text)


def declared_letters(path: Path) -> dict[Identity, str]:
    """Return the kinds of letters that a YAML file declares: `omega: vector`, `n: integer`, `x: changes`."""
    try:
        with path.open(encoding="utf-8") as file:
            read: Any = yaml.safe_load(file.read(1_000_000))
    except OSError as error:
        raise Misused(Complaint("unreadable", f"`{path}` cannot be read: {error.strerror}")) from None
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise Misused(Complaint("symbols", f"`{path}` is not a YAML file: {str(error).splitlines()[0]}")) from None
    if not isinstance(read, dict) or len(read) > MOST_SYMBOLS:
        message = f"`{path}` must be a mapping of at most {MOST_SYMBOLS} letters, each with its kind"
        raise Misused(Complaint("symbols", message, help="such as `omega: vector`"))
    found: dict[Identity, str] = {}
    for name, kind in read.items():
        if kind not in KINDS:
            known = did_you_mean(str(kind), KINDS) or "the kinds are " + ", ".join(KINDS)
            raise Misused(Complaint("symbols", f"`{kind}` is not a kind of letter", help=known))
        found[_letter(str(name), path).identity] = str(kind)
    return found


def _letter(name: str, path: Path) -> Letter:
    try:
        node = parsed(_tokens(name))
    except (Unreadable, TooLarge, RecursionError):
        node = Group(Span(0, 0), Letter(Span(0, 0), ""), "(")
    if not isinstance(node, Letter):
        raise Misused(Complaint("symbols", f"`{name}` in `{path}` is not a letter", help="such as `omega_1`"))
    return node
