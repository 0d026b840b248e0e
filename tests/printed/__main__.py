"""`python -P -m tests.printed --draws 200`: so many variants of every problem, each line of each read back.

A draw that the door refuses is counted apart. Every misprint is told once, with the variant that has it.
"""

from __future__ import annotations

import argparse
import random
import signal
import sys
import time
from collections import Counter

from derive.errors import DeriveError
from tests.printed.draws import PROBLEMS, check_variant, drawn
from tests.printed.lines import Count


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -P -m tests.printed", description=__doc__)
    parser.add_argument("--draws", type=int, default=20, help="variants of each problem")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--limit", type=int, default=25, help="seconds of the processor for one variant")
    parser.add_argument("problems", nargs="*", default=PROBLEMS)
    chosen = parser.parse_args()
    count, outcomes = Count(), Counter[str]()
    signal.signal(signal.SIGVTALRM, _too_long)
    for n in range(chosen.draws):
        for problem in chosen.problems:
            source = random.Random(f"{chosen.seed} {n} {problem}")
            variant = drawn(problem, source)
            started, known = time.monotonic(), len(count.misprints)
            signal.setitimer(signal.ITIMER_VIRTUAL, chosen.limit)
            try:
                lines = check_variant(variant, count)
                outcome = "read"
            except DeriveError as error:
                lines, outcome = 0, "refused"
                print(f"{variant}: refused: {str(error).splitlines()[0]}", flush=True)
            except TimeoutError:
                lines, outcome = 0, "too long"
            except Exception as error:
                lines, outcome = 0, "crashed"
                print(f"{variant}: CRASHED: {type(error).__name__}: {error}", flush=True)
            finally:
                signal.setitimer(signal.ITIMER_VIRTUAL, 0)
            outcomes[outcome] += 1
            outcomes["lines"] += lines
            print(f"{variant}: {outcome}, {lines} lines, {time.monotonic() - started:.1f} s", flush=True)
            for text, where in list(count.misprints.items())[known:]:
                print(f"MISPRINT {where}\n    {text}", flush=True)
    print(dict(outcomes), dict(count.read), f"{len(count.misprints)} misprints")
    return 1 if count.misprints else 0


def _too_long(*_: object) -> None:
    raise TimeoutError


if __name__ == "__main__":
    sys.exit(main())
