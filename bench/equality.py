"""Measure how much faster derive decides than SymPy whether two expressions are equal. Run by `make bench`.

    equal    over `left.equals(right)`             aim 20
    equal    over `simplify(left - right) == 0`    aim 20

All three methods decide the same pairs of `tests/algebra/pairs.txt`, as many as possible in a fixed time. Before each
decision all caches are emptied, and each decision has the same time limit. The figure is the median of the ratios of
processor times. Wrong and missing answers are counted.
"""

from __future__ import annotations

import signal
import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from sympy import MatrixBase, simplify
from sympy.core.cache import clear_cache

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from derive.algebra import equality, function_ring, node, normal_form, trig_polynomials
from derive.algebra.expressions import Relation
from tests.algebra.pairs import Pair, kept

LIMIT = 2  # seconds allowed for one question
SECONDS = 50  # seconds allowed for all questions
KEEPING = [
    kept_by
    for module in (equality, function_ring, node, normal_form, trig_polynomials)
    for kept_by in vars(module).values()
    if hasattr(kept_by, "cache_clear")
]


def emptied() -> None:
    clear_cache()
    trig_polynomials.KEPT.clear()
    for kept_by in KEEPING:
        kept_by.cache_clear()


def timed(question: Callable[[], Any]) -> tuple[Any, float]:
    """Return the answer to a question and the processor seconds; the answer is None if it takes too long or fails."""

    def stop(*_: Any) -> None:
        raise TimeoutError

    emptied()
    signal.signal(signal.SIGALRM, stop)
    signal.alarm(LIMIT)
    started = time.process_time()
    try:
        answer = question()
    except Exception:  # SymPy fails in many ways
        answer = None
    finally:
        signal.alarm(0)
    return answer, time.process_time() - started


def main() -> None:
    pairs = [pair for pair in kept() if not isinstance(pair.left, Relation | MatrixBase)]
    ways: dict[str, Callable[[Pair], Any]] = {
        "equal": lambda pair: bool(equality.equal(pair.left, pair.right)),
        "equals": lambda pair: pair.left.equals(pair.right),
        "simplify": lambda pair: simplify(pair.left - pair.right) == 0,
    }
    spent: dict[str, list[float]] = {way: [] for way in ways}
    failed = dict.fromkeys(ways, 0)
    began, step = time.monotonic(), 7  # a step of 7 mixes the families of pairs
    for pair in (pairs[n] for start in range(step) for n in range(start, len(pairs), step)):
        if time.monotonic() - began > SECONDS:
            break
        for way, decide in ways.items():
            answer, seconds = timed(lambda decide=decide, pair=pair: decide(pair))
            spent[way].append(seconds)
            failed[way] += answer is not pair.equal
    for way in ("equals", "simplify"):
        ratios = [other / own for own, other in zip(spent["equal"], spent[way], strict=True)]
        told = f"{failed['equal']} and {failed[way]} not decided correctly"
        print(f"equality: {way:<9}   {statistics.median(ratios):.0f} x equal ({len(ratios)} pairs, {told})   aim 20")
    print(f"(equal takes {1000 * statistics.median(spent['equal']):.2f} ms)")


if __name__ == "__main__":
    main()
