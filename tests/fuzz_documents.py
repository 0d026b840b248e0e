r"""Read documents that are broken at random: no input may crash the reader, hang it, or take much memory.

    python -P -m tests.fuzz_documents 100000 --seed 7

An input is a real row with a few mutations, or a row that a small grammar writes, in one of the formats. It is read as
a document, and every `--audited`-th input is also audited. The only exceptions that an input may raise are those of
`derive.errors`, which the command shows as messages.
"""

from __future__ import annotations

import argparse
import json
import random
import resource
import signal
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from derive.audit.auditing import audited, claims_of
from derive.audit.report import as_json
from derive.documents.choices import readings
from derive.documents.layout import read_document
from derive.documents.meaning import Meaning, Meaningless
from derive.documents.source import Format, source_of
from derive.errors import DeriveError

SECONDS = 10.0  # of processor time that one input may take
MEMORY = 3 << 30
FAULTS = (ValueError, TypeError, ZeroDivisionError, AttributeError, NotImplementedError)

ROWS = [
    r"T &= \frac{1}{2}\,m\,(\dot{x}^{2}+\dot{y}^{2}+2\dot x\dot y\cos(\phi-\theta)),\label{a:b} \\",
    r"\frac{d}{dt}\,\frac{\partial L}{\partial \dot{\theta}}-\frac{\partial L}{\partial \theta} &= 0\notag \\",
    r"I = \int_{0}^{\pi} \int_{0}^{R} r^{3}\sin^{2}\theta\,dr\,d\theta = \left[\frac{r^4}{4}\right]_0^R",
    r"\mathbf{I} = \frac{2}{5}ma^2 \begin{pmatrix} 1 & 0 \\ 0 & 1 \end{pmatrix}, \quad \vec L = \mathbf I\vec\omega",
    r"x(t) = x_0 e^{-\beta t}\left(\cos(\omega_1 t) + \frac{\beta}{\omega_1}\sin\omega_1 t\right)",
    r"a \approx 3.1\cdot 10^{-4}\,\text{m}",
    r"\left.\frac{d^2 U_{\mathrm{eff}}}{dr^2}\right|_{r=r_0} = k + \frac{3l^2}{m r_0^4} > 0",
    r"x > 0 \implies \omega^2 = \sum_{i=1}^3 k_i/m",
    r"\vec a \times (\vec b \times \vec c) = \vec b(\vec a\cdot\vec c) - \vec c(\vec a\cdot\vec b)",
    r"\dv[2]{x}{t} = \qty(a + \abs{b})\,\SI{3}{\meter\per\second} \quad \text{where } b = \tfrac12 \sqrt[3]{x'}",
]
# Rows after these may be compared with equations of motion and with vectors.
CONTEXT = (
    "$$ m \\ddot x + k x = 0 $$\n\n$$ \\dot{\\vec a} = A \\vec a $$\n\n"
    "$$ L = \\frac12 m \\dot x^2 - \\frac12 k x^2 $$\n\n"
)
PIECES = [
    *"abcxyzmgltLR0123456789+-=*/^_{}()[]|&$%#~'!,.;:<>\\\n\t \"@",
    *[
        "frac", "sqrt", "int", "sum", "lim", "prod", "vec", "dot", "ddot", "hat", "bar", "mathbf", "mathrm",
        "text", "left", "right", "begin", "end", "sin", "cos", "log", "over", "atop", "partial", "nabla", "cdot",
        "times", "pm", "infty", "alpha", "theta", "omega_", "label", "tag", "notag", "quad", "boxed", "underbrace",
        "overset", "dv", "pdv", "qty", "SI", "def", "newcommand", "input", "include", "catcode", "csname",
        "endcsname", "write18", "verb", "item", "prime", "degree", "ldots", "Bigl(", "limits",
    ],
    "\\\\", "$$", "\\[", "\\]", "\\(", "\\)", "{}", "^{", "_{", "}}", "\\frac{", "\\left(", "\\right)", "\\left.",
    "\\begin{pmatrix}", "\\end{pmatrix}", "\\begin{align}", "\\end{align}", "\\begin{", "\\end{", "\x00", "\ud800",
    "\r\n", "\u202e", "ω", "²", "₁", "½", "∫", "π", "é", "𝛼", "\\def\\a{\\a\\a}", "\\newcommand{\\b}[2]{#1#2\\b}",
    "```", "`", "<!--", "-->", "# ", "9^{9^{9^9}}", "1e999", "10^{-400}", "0^{0}", "1/0", "d", "\\d", "\\,dx", "e^{",
]  # fmt: skip


class Hung(BaseException):
    pass


@contextmanager
def bounded(seconds: float) -> Iterator[None]:
    def stop(*_: object) -> None:
        raise Hung

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def mutated(text: str, random_: random.Random) -> str:
    for _ in range(random_.choice([1, 1, 2, 3, 5, 8])):
        at, to = sorted(random_.randrange(len(text) + 1) for _ in range(2))
        to = min(to, at + random_.choice([1, 2, 5, 20]))
        piece = random_.choice(PIECES)
        piece = "\\" + piece + " " if piece.isalpha() and len(piece) > 1 and random_.random() < 0.8 else piece
        text = random_.choice([
            text[:at] + text[to:],
            text[:at] + piece + text[at:],
            text[:at] + piece + text[to:],
            text[:to] + text[at:],
            text[:at] + text[at:to] * random_.choice([2, 3, 30]) + text[to:],
            text[:at] + text[at:to][::-1] + text[to:],
            text[:at],
        ])[:20_000]  # fmt: skip
    return text


def written(random_: random.Random, depth: int = 0) -> str:
    if depth > 5 or random_.random() < 0.3:
        return random_.choice(["x", "m", "a_1", "\\dot x", "\\theta", "2", "3.5", "\\vec a", "\\pi", "f(x)", "t", "9"])
    one, two = (written(random_, depth + 1) for _ in range(2))
    forms = [
        "{0}+{1}",
        "{0}-{1}",
        "{0} {1}",
        "\\frac{{{0}}}{{{1}}}",
        "\\left({0}\\right)^{{{1}}}",
        "\\sqrt{{{0}}}",
        "\\sin({0})",
        "\\cos {0}",
        "{0}={1}",
        "\\int_0^{{{0}}} {1}\\,dx",
        "\\frac{{d}}{{dt}}({0})",
        "\\frac{{\\partial {0}}}{{\\partial x}}",
        "\\sum_{{i=1}}^{{3}} {0}",
        "\\begin{{pmatrix}} {0} \\\\ {1} \\end{{pmatrix}}",
        "{0}\\cdot {1}",
        "{0}\\times {1}",
        "{{{0}}}^{{{1}}}",
        "[{0}]_0^{{{1}}}",
        "\\left",
        "{0}\\right",
        "",
        "({0},{1})",
        "{0}!",
        "e^{{{0}}}",
        "\\ln {0}",
        "{0}/{1}",
        "x({0})",
        "{0}&={1}\\\\",
    ]
    return random_.choice([each for each in forms if each]).format(one, two)


def inputs(count: int, seed: int, rows: list[str] = ROWS) -> Iterator[tuple[str, Format]]:
    random_ = random.Random(seed)
    for _ in range(count):
        kind = random_.choice(list(Format))
        text = written(random_) if random_.random() < 0.3 else random_.choice(rows)
        opening, closing = random_.choice([
            ("$$ ", " $$"), ("Let $", "$ be."), ("\\begin{align}\n", "\n\\end{align}"), ("\\[", "\\]"), ("", ""),
        ])  # fmt: skip
        text = f"# Problem 1\n\n{random_.choice(['', CONTEXT])}{opening}{text}{closing}\n"
        if random_.random() < 0.9:
            text = mutated(text, random_)
        if kind is Format.NOTEBOOK and random_.random() < 0.8:
            cells = [{"cell_type": "markdown", "source": random_.choice([text, text.splitlines(keepends=True)])}]
            text = json.dumps({"cells": cells}, ensure_ascii=random_.random() < 0.5)
            text = mutated(text, random_) if random_.random() < 0.2 else text
        yield text, kind


def look_at(text: str, kind: Format, audit: bool) -> str:
    """Read one input, and return how it ended; an exception other than those of derive leaves this function."""
    try:
        document = read_document(source_of(text, kind, "fuzzed"))
        if audit:
            as_json(audited(document))
            return "audited"
        claims, facts, _ = claims_of(document)
        for claim in claims:
            for node in (claim.left, claim.right):
                if node is None:
                    continue
                for reading, _ in readings(node, facts)[:1]:
                    try:
                        Meaning(facts).of(reading)
                    except (Meaningless, RecursionError, *FAULTS):
                        continue
    except DeriveError:
        return "rejected"
    return "read"


def fuzz(count: int, seed: int, rows: list[str] = ROWS, every: int = 20) -> tuple[Counter[str], list[tuple[str, str]]]:
    """Return how the inputs ended, and the inputs that crash or hang with the reason."""
    ended: Counter[str] = Counter()
    bad: list[tuple[str, str]] = []
    for number, (text, kind) in enumerate(inputs(count, seed, rows)):
        try:
            with bounded(SECONDS):
                ended[look_at(text, kind, number % every == 0)] += 1
        except Hung:
            bad.append((f"hangs ({kind})", text))
        except Exception as error:  # this is what the fuzzer looks for
            bad.append((f"{type(error).__name__}: {str(error)[:100]} ({kind})", text))
    return ended, bad


def main(arguments: Any = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--audited", type=int, default=20)
    parser.add_argument("--rows", type=Path, help="a folder of .tex files whose rows are mutated, too")
    given = parser.parse_args(arguments)
    rows = list(ROWS)
    for file in sorted(given.rows.glob("*.tex")) if given.rows else []:
        rows += [each for each in file.read_text(encoding="utf-8").splitlines() if "=" in each and len(each) < 600]
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    started = time.process_time()
    ended, bad = fuzz(given.count, given.seed, rows, given.audited)
    for reason, text in bad[:40]:
        print(reason, repr(text[:400]))
    told = ", ".join(f"{count} {how}" for how, count in ended.most_common())
    print(f"{given.count} inputs: {told}; {len(bad)} crash or hang; {time.process_time() - started:.0f} s")
    return int(bool(bad))


if __name__ == "__main__":
    raise SystemExit(main())
