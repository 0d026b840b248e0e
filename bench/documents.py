"""Measure the reader and the audit of documents of other authors. Run by `make bench`.

    parsed   rows per second, and as a ratio to the walker of pylatexenc, which only splits a row into nodes   aim 1
    audited  rows per second of whole documents                                                                aim 25
    same     over `left.equals(right)` and `simplify(left - right) == 0`, with wrong verdicts                  aim 20

The documents are a few of our own solutions, derived into a temporary folder, or the files given as arguments. The
verdicts on equality are those on the pairs of `tests/algebra/pairs.txt`.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from pylatexenc.latexwalker import LatexWalker, LatexWalkerError
from sympy import MatrixBase, simplify

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from bench.equality import timed
from derive.algebra.expressions import Relation
from derive.audit.auditing import audited, claims_of
from derive.audit.deciding import same
from derive.audit.fingerprint import fingerprint
from derive.documents.layout import Document, read_document
from derive.documents.source import read_source
from tests.algebra.pairs import Pair, kept
from tests.damage import documents

NAMES = ["block_on_incline", "cone", "coupled_pendulums", "hooke_3d", "loop", "two_bodies"]
SECONDS = 40  # for the pairs


def files() -> list[Path]:
    if sys.argv[1:]:
        return [Path(name) for name in sys.argv[1:]]
    return list(documents(only=NAMES).values())


def walked(read: list[Document]) -> int:
    count = 0
    for document in read:
        for row in document.rows:
            try:
                LatexWalker(row.latex).get_latex_nodes()
                count += 1
            except LatexWalkerError:
                continue
    return count


def seconds(work: Callable[[], Any]) -> float:
    started = time.process_time()
    work()
    return time.process_time() - started


def reading() -> None:
    chosen = files()
    read = [read_document(read_source(file)) for file in chosen]
    rows = sum(len(document.rows) for document in read)
    own = min(seconds(lambda: [claims_of(read_document(read_source(file))) for file in chosen]) for _ in range(3))
    walker = min(seconds(lambda: walked(read)) for _ in range(3))
    print(f"documents: parsed     {rows / own:.0f} rows/s, {walker / own:.2f} x pylatexenc ({rows} rows)   aim 1")
    audit = seconds(lambda: [audited(document) for document in read])
    print(f"documents: audited    {rows / audit:.0f} rows/s   aim 25")


def deciding() -> None:
    pairs = [pair for pair in kept() if not isinstance(pair.left, Relation | MatrixBase)]
    ways: dict[str, Callable[[Pair], Any]] = {
        "same": lambda pair: same(pair.left, pair.right),
        "equals": lambda pair: pair.left.equals(pair.right),
        "simplify": lambda pair: simplify(pair.left - pair.right) == 0,
    }
    spent: dict[str, list[float]] = {way: [] for way in ways}
    wrong = {way: [0, 0] for way in ways}  # wrong verdicts, and none
    began, step = time.monotonic(), 7
    for pair in (pairs[n] for start in range(step) for n in range(start, len(pairs), step)):
        if time.monotonic() - began > SECONDS:
            break
        for way, decide in ways.items():
            fingerprint.cache_clear()
            answer, taken = timed(lambda decide=decide, pair=pair: decide(pair))
            spent[way].append(taken)
            wrong[way][0] += answer is (not pair.equal)
            wrong[way][1] += answer is None
    for way in ("equals", "simplify"):
        ratio = statistics.median(b / a for a, b in zip(spent["same"], spent[way], strict=True))
        told = ", ".join(
            f"{name} {bad} wrong and {none} open" for name, (bad, none) in wrong.items() if name in ("same", way)
        )
        print(f"documents: {way:<9}  {ratio:.0f} x same ({len(spent[way])} pairs: {told})   aim 20")


if __name__ == "__main__":
    reading()
    deciding()
