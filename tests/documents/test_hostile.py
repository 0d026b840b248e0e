r"""Hostile documents end in messages: bounded in size, depth, tokens, time and memory; no file is opened."""

from __future__ import annotations

import json
import time
from pathlib import Path

import pytest

from derive.documents.source import Format, read_source, source_of
from derive.documents.tokens import Kind, tokens_of
from derive.errors import DeriveError
from tests.documents.reading import audit
from tests.fuzz_documents import fuzz, look_at

SECONDS = 12  # of processor time, on a slow machine

HOSTILE = {
    "a macro that calls itself twice": r"\def\a{\a\a} $$ \a = 1 $$",
    "macros that double": "\n".join(
        rf"\newcommand{{\m{chr(97 + i)}}}{{\m{chr(98 + i)}\m{chr(98 + i)}}}" for i in range(24)
    ) + "\n$$ \\ma = 1 $$",
    "macros that double their argument": "\n".join(
        rf"\newcommand{{\m{chr(97 + i)}}}[1]{{\m{chr(98 + i)}{{#1#1#1#1}}}}" for i in range(24)
    ) + "\n$$ \\ma{x} = 1 $$",
    "two macros that call each other": r"\def\a{\b x}\def\b{\a y} $$ \a = 1 $$",
    "deep brackets": "$$ " + "(" * 100_000 + "x" + ")" * 100_000 + " = 1 $$",
    "deep braces": "$$ " + "{" * 100_000 + "x" + "}" * 100_000 + " = 1 $$",
    "deep fractions": "$$ " + r"\frac{1}{" * 5_000 + "x" + "}" * 5_000 + " = 1 $$",
    "deep roots": "$$ " + r"\sqrt{" * 50 + "x" + "}" * 50 + " = y $$",
    "deep powers": "$$ " + "x^{" * 50 + "x" + "}" * 50 + " = 1 $$",
    "deep environments": r"\begin{align}" * 20_000 + "x = 1" + r"\end{align}" * 20_000,
    "a tower of numbers": r"$$ 9^{9^{9^{9}}} = x $$",
    "a power of a power": r"$$ ((((((9^{60})^{60})^{60})^{60})^{60})^{60})^{60} = x $$",
    "a root of a tower": r"$$ \sqrt[9]{(10^{60})^{60}} + 2^{0.333333333333} = x $$",
    "factorials": r"$$ 49!!!!!! = x $$",
    "a huge number": "$$ " + "9" * 200_000 + " = 1 $$",
    "a huge decimal": "$$ 0." + "9" * 200_000 + " = 1 $$",
    "a huge exponent": "$$ 2^{" + "9" * 50 + "} = e^{" + "9" * 50 + "} = 1 $$",
    "a gigantic matrix": r"$$ \begin{pmatrix} " + (r"x & " * 300 + r"y \\ ") * 300 + r"\end{pmatrix} = 1 $$",
    "a matrix to a power": r"$$ \begin{pmatrix} a & b & c \\ d & f & g \\ h & j & k \end{pmatrix}^{5} = 0 $$",
    "a determinant": r"$$ \begin{vmatrix} "
    + r" \\ ".join(" & ".join(f"a_{{{i}{j}}}" for j in range(12)) for i in range(12))
    + r"\end{vmatrix} = 0 $$",
    "nested sums": r"$$ " + "".join(rf"\sum_{{{c}=1}}^{{20}} " for c in "ijklnpq") + " a_{i} b_{j} = 1 $$",
    "nested integrals": r"$$ " + r"\int_0^1 " * 60 + " x " + "dx " * 60 + " = 1 $$",
    "a row of a million characters": "$$ " + "x + " * 250_000 + "x = 1 $$",
    "a long product": "$$ " + "(x + y)" * 4000 + " = 1 $$",
    "a long power": "$$ (a + b + c + d + f + g + h)^{60} = (a - b)^{60} $$",
    "many dollars": "$" * 200_001,
    "many open formulas": r"\[" * 5_000 + r"\(" * 5_000,
    "many equals signs": "$$ " + "x = " * 5_000 + "x $$",
    "many primes": "$$ x" + "'" * 20_000 + " = 1 $$",
    "many scripts": "$$ x" + "_a" * 6_000 + " = 1 $$",
    "many open readings": "$$ " + " + ".join(rf"f_{{{i}}}(a+b)\sin 2 a b" for i in range(200)) + " = 1 $$",
    "unclosed environments": r"\begin{align} x = 1 \\ \begin{pmatrix} 1 & 2",
    "unclosed dollars": "$$ x = 1",
    "an end without a begin": r"\end{align} $x = 1$ \end{pmatrix}",
    "NULs": "$$ x\x00 = \x00 1 $$",
    "lone surrogates": "$$ x\ud800 = \udfff 1 $$",
    "carriage returns": "# A\r\n\r\n$$\r\nx = 1 \\\\\r\n= 1\r\n$$\r\n",
    "many headings": "# a\n" * 20_000 + "$x = 1$",
    "backticks": "`" * 30_000 + "$x = 1$",
    "comments that do not end": "<!--" * 50_000 + "$x = 1$",
    "verbatim that does not end": r"\begin{verbatim}" * 5_000 + "$x = 1$",
    "spaces": "$$ x" + " " * 500_000 + "= 1 $$",
    "definitions that do not end": r"\newcommand{\a}[1]{" * 3_000 + "$x = 1$",
}  # fmt: skip


@pytest.mark.parametrize("text", list(HOSTILE.values()), ids=list(HOSTILE))
def test_hostile_text_ends_in_a_message(text: str) -> None:
    begins = time.process_time()
    assert look_at(text, Format.MARKDOWN, audit=True) in ("audited", "rejected")
    assert look_at(text, Format.TEX, audit=False) in ("read", "rejected")
    assert time.process_time() - begins < SECONDS


@pytest.mark.parametrize(
    "text",
    [r"$\qty = 1$", r"$\dd = 1$", r"$x = f(xxx)!$", r"$\ddot{\qty } = 1$", r"$\left = 1$", r"$\dv = \SI = 1$"],
)
def test_what_the_fuzzer_found_is_unreadable_and_not_fatal(text: str) -> None:
    assert look_at(text, Format.MARKDOWN, audit=True) == "audited"


@pytest.mark.parametrize("name", ["/etc/passwd", "../../secret.tex", "secret"])
def test_no_other_file_is_opened(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "secret.tex").write_text("$s = 12345$", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    read = audit(f"\\input{{{name}}} \\include{{{name}}} $x = 1$ $\\input{{{name}}} = 2$", Format.TEX)
    assert "12345" not in "".join(row.latex for row in read.document.rows) and "root:" not in read.document.source.text


def test_bytes_that_are_not_utf_8_are_refused_with_their_position(tmp_path: Path) -> None:
    file = tmp_path / "worked.md"
    file.write_bytes(b"$x = 1$ \xff\xfe $y = 2$")
    with pytest.raises(DeriveError, match="position 8"):
        read_source(file)


def test_carriage_returns_do_not_move_the_lines(tmp_path: Path) -> None:
    file = tmp_path / "worked.tex"
    file.write_bytes(b"first\r\n\r\n$x = 1$\r\n")
    source = read_source(file)
    assert source.line_of(source.text.index("x")) == 3


def test_a_notebook_with_a_surrogate_pair_keeps_its_places() -> None:
    cells = [{"cell_type": "markdown", "source": ["an emoji 😀 and\n", "$x = 1$"]}]
    text = json.dumps({"cells": cells})
    assert "\\ud83d\\ude00" in text
    source = source_of(text, Format.NOTEBOOK, "worked.ipynb")
    assert "😀" in source.text
    assert (
        source.place(source_span(source.text, "x")).text[source.place(source_span(source.text, "x")).column - 1] == "x"
    )


def source_span(text: str, char: str):  # type: ignore[no-untyped-def]
    from derive.documents.source import Span

    at = text.index(f"${char}") + 1
    return Span(at, at + 1)


def test_a_lone_surrogate_of_a_notebook_is_kept() -> None:
    text = '{"cells": [{"cell_type": "markdown", "source": "a \\ud800 $x = 1$"}]}'
    assert look_at(text, Format.NOTEBOOK, audit=True) in ("audited", "rejected")


def test_a_number_of_any_length_is_one_token() -> None:
    (token,) = tokens_of("9" * 10_000)
    assert token.kind is Kind.NUMBER


def test_random_inputs_do_not_crash_the_reader() -> None:
    _, bad = fuzz(400, seed=17, every=10)
    assert bad == []
