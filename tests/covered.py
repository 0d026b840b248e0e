"""List slow tests whose lines are all run by other tests. The default run leaves these tests out.

    python -P -m tests.covered

The tests of a default run are measured line by line, which takes about twice the time of a run. A test is listed if it
takes more than `SLOW` seconds and if each line of `derive` that it runs is run by at least one test that is not listed.
The slowest tests are chosen first. Tests in the folders `PROCESSES` are not listed, because lines that other processes
run are not measured; nor are tests of wrong laws, which each run must refuse. A line that is run is not a line that is
tested, so run all tests (`DERIVE_ALL_TESTS=1 make test`) before a release.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections import Counter, defaultdict
from pathlib import Path

import pytest

LIST = Path(__file__).with_name("covered.txt")
SLOW = 0.1
PROCESSES = ("tests/building/", "tests/preview/", "tests/cli/", "tests/tools/", "tests/test_i")  # isolated, interrupted
HEAD = "# Slow tests, all of whose lines are run by other tests: written by `python -P -m tests.covered`.\n"


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
    """Return slow tests whose lines are all run by tests that are not returned."""
    runs = Counter(line for each in lines.values() for line in each)
    chosen = []
    for test in sorted(lines, key=lambda test: -durations[test]):
        if durations[test] < SLOW:
            break
        if (
            not test.startswith(PROCESSES)
            and "wrong" not in test.partition("[")[0]
            and all(runs[line] > 1 for line in lines[test])
        ):
            runs.subtract(lines[test])
            chosen.append(test)
    return chosen


def main() -> None:
    LIST.write_text(HEAD, encoding="utf-8")
    durations = Durations()
    with tempfile.TemporaryDirectory() as folder:
        os.environ["COVERAGE_FILE"] = str(Path(folder) / "coverage")
        options = ["--cov=derive", "--cov-context=test", "--cov-report=", "-p", "no:cacheprovider"]
        status = pytest.main(["-n", "2", "--dist", "worksteal", *options], plugins=[durations])
        lines = lines_by_test(Path(folder) / "coverage")
    chosen = superfluous(lines, durations.of)
    LIST.write_text(HEAD + "".join(f"{test}\n" for test in sorted(chosen)), encoding="utf-8")
    saved = sum(durations.of[test] for test in chosen)
    print(f"{len(chosen)} tests are listed, with {saved:.0f} of {durations.of.total():.0f} seconds")
    sys.exit(status)


if __name__ == "__main__":
    main()
