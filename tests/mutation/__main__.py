"""`python -P -m tests.mutation [--module M] [--sample N --seed S]`: every mutant or a sample, and what became of it."""

from __future__ import annotations

import argparse
import json
import os
import random
import sys
import time
from collections import Counter
from dataclasses import asdict

from tests.mutation.known import KNOWN
from tests.mutation.mutants import MODULES
from tests.mutation.runs import RUNS
from tests.mutation.trial import Trials, Verdict


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -P -m tests.mutation", description=__doc__)
    parser.add_argument(
        "--module", action="append", choices=MODULES, help="only this module, such as mechanics.rest.stability"
    )
    parser.add_argument("--run", action="append", choices=RUNS, help="only on this run")
    parser.add_argument("--sample", type=int, help="a sample of so many")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", help="a file with the ids of those to try, one a line, or an earlier `--out`")
    parser.add_argument("--change", help="only changes of this sort, such as law")
    parser.add_argument("--share", default="1/1", help="2/4: the second quarter, so that several can work at once")
    parser.add_argument("--minutes", type=float, help="stop after so long")
    parser.add_argument("--chunk", type=int, default=2000, help="so many are tried on all runs before the next ones")
    parser.add_argument(
        "--out", help="a file to which each verdict is appended, as a line of JSON; what it has is not tried again"
    )
    given = parser.parse_args()
    os.nice(5)
    begun = time.monotonic()
    trials = Trials(given.run or list(RUNS), given.module or MODULES)
    trials.prepare(lambda told: print(told, file=sys.stderr, flush=True))
    chosen = trials.sample(given.sample, given.seed)
    if given.only:
        wanted = _ids_in(given.only)
        chosen = [mutant for mutant in chosen if mutant.id in wanted]
    if given.out:
        done = _ids_in(given.out)
        chosen = [mutant for mutant in chosen if mutant.id not in done]
    if given.change:
        chosen = [mutant for mutant in chosen if mutant.change == given.change]
    which, shares = (int(n) for n in given.share.split("/"))
    random.Random(given.seed).shuffle(chosen)  # so that what is done of it when it is stopped is a fair sample too
    chosen = chosen[which - 1 :: shares]
    print(
        f"{len(trials.mutants)} mutants, {len(trials.used())} used, {len(chosen)} to try", file=sys.stderr, flush=True
    )
    counts: dict[str, Counter[str]] = {}
    chunks = (chosen[i : i + given.chunk] for i in range(0, len(chosen), given.chunk))
    for number, tried in enumerate((t for chunk in chunks for t in trials.verdicts(chunk)), 1):
        counts.setdefault(tried.module, Counter())[tried.verdict] += 1
        if given.out:
            with open(given.out, "a", encoding="utf-8") as out:
                out.write(json.dumps(asdict(tried)) + "\n")
        if tried.verdict is Verdict.SURVIVED and tried.nature != "form" and tried.id not in KNOWN:
            print(f"survived ({tried.nature}) on {tried.run}: {tried.id}\n{tried.told}\n", flush=True)
        if number % 100 == 0:
            print(f"{number} of {len(chosen)}", file=sys.stderr, flush=True)
        if given.minutes and time.monotonic() - begun > given.minutes * 60:
            break
    print(f"{'module':28}" + "".join(f"{verdict:>10}" for verdict in Verdict))
    for module, found in sorted(counts.items()):
        print(f"{module:28}" + "".join(f"{found[verdict]:>10}" for verdict in Verdict))
    return 0


def _ids_in(name: str) -> set[str]:
    if not os.path.exists(name):
        return set()
    with open(name, encoding="utf-8") as file:
        return {json.loads(line)["id"] if line.startswith("{") else line.strip() for line in file}


if __name__ == "__main__":
    sys.exit(main())
