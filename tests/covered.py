"""List slow tests that run few lines of their own. The default run leaves these tests out.

    python -P -m tests.covered           of all tests
    python -P -m tests.covered --again   of the tests of the default run, which are added to the list

The tests of all runs are measured line by line, which takes about twice the time of a run. The default run keeps all
tests that take less than `SLOW` seconds, all tests of wrong laws, which each run must refuse, and the tests in the
folders `PROCESSES` that run fewer than `MEASURED` lines, because lines that other processes run are not measured. Then
it takes the test that adds most lines of `derive` per second, and so on, until no test adds `RATE` lines per second. A
line that is run is not a line that is tested, so run all tests (`DERIVE_ALL_TESTS=1 make test`) before a release.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections import Counter, defaultdict
from pathlib import Path

import pytest

LIST = Path(__file__).with_name("covered.txt")
SLOW, RATE = 0.1, 20
PROCESSES = ("tests/building/", "tests/preview/", "tests/cli/", "tests/tools/", "tests/test_i")  # isolated, interrupted
MEASURED = 300
HEAD = "# Slow tests that run few lines of their own: written by `python -P -m tests.covered`.\n"


def covered() -> frozenset[str]:
    """Return the names of the listed tests."""
    return frozenset(LIST.read_text(encoding="utf-8").splitlines()[1:])


class Durations:
    """Plugin of pytest that sums the time of each test, with its setup."""

    def __init__(self) -> None:
        self.of: Counter[str] = Counter()

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self.of[report.nodeid] += report.duration  # type: ignore[assignment]


def lines_by_test(file: Path) -> dict[str, set[tuple[str, int]]]:
    """Return the lines that each test has run, each with its file and number."""
    from coverage import CoverageData

    data = CoverageData(str(file))
    data.read()
    found: dict[str, set[tuple[str, int]]] = defaultdict(set)
    for source in data.measured_files():
        for line, contexts in data.contexts_by_lineno(source).items():
            for context in contexts:
                found[context.rpartition("|")[0]].add((source, line))
    found.pop("", None)
    return found


def superfluous(lines: dict[str, set[tuple[str, int]]], durations: Counter[str]) -> list[str]:
    """Return slow tests that add fewer than `RATE` lines per second to those that the other tests run."""
    chosen = {test for test in lines if durations[test] >= SLOW and not _is_kept(test, lines[test])}
    run = set[tuple[str, int]]().union(*(each for test, each in lines.items() if test not in chosen))
    own = {test: lines[test] - run for test in chosen}

    def rate(test: str) -> float:
        return len(own[test]) / durations[test]

    while own and rate(best := max(own, key=rate)) >= RATE:
        added = own.pop(best)
        for each in own.values():
            each -= added
    return sorted(own)


def _is_kept(test: str, lines: set[tuple[str, int]]) -> bool:
    return "wrong" in test.partition("[")[0] or test.startswith(PROCESSES) and len(lines) < MEASURED


def main() -> None:
    listed = covered() if "--again" in sys.argv else frozenset()
    LIST.write_text(HEAD + "".join(f"{test}\n" for test in sorted(listed)), encoding="utf-8")
    durations = Durations()
    with tempfile.TemporaryDirectory() as folder:
        os.environ["COVERAGE_FILE"] = str(Path(folder) / "coverage")
        options = ["--cov=derive", "--cov-context=test", "--cov-report=", "-p", "no:cacheprovider"]
        status = pytest.main(["-n", "2", "--dist", "worksteal", *options], plugins=[durations])
        lines = lines_by_test(Path(folder) / "coverage")
    chosen = superfluous(lines, durations.of)
    LIST.write_text(HEAD + "".join(f"{test}\n" for test in sorted(listed.union(chosen))), encoding="utf-8")
    saved = sum(durations.of[test] for test in chosen)
    print(f"{len(chosen)} tests are listed, with {saved:.0f} of {durations.of.total():.0f} seconds")
    sys.exit(status)


if __name__ == "__main__":
    main()
