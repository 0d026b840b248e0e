"""What is installed is what was tested: each package at its version, and no file whose digest is unknown."""

from __future__ import annotations

import re
import runpy
import tomllib

from tests.courses import ROOT

entries = runpy.run_path(str(ROOT / "tools" / "locks.py"))["entries"]
LOCKS = {name: (ROOT / "locks" / f"{name}.txt").read_text() for name in ("runtime", "tests")}
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
ELSEWHERE = {"colorama"}  # what only other systems need


def plain(name: str) -> str:
    return re.sub(r"[-_.]+", "-", re.split(r"[^A-Za-z0-9._-]", name)[0]).lower()


def versions() -> dict[str, str]:
    lines = [line.split("==") for line in (ROOT / "constraints.txt").read_text().splitlines() if "==" in line]
    return {plain(name): version for name, version in lines}


def test_the_locks_have_the_packages_of_the_constraints_at_their_versions() -> None:
    found = entries(LOCKS["runtime"]) | entries(LOCKS["tests"])
    locked = {plain(name): re.split("==| ", entry)[1] for name, entry in found.items()}
    assert {name: version for name, version in locked.items() if name not in ELSEWHERE} == versions()


def test_no_package_is_in_both_and_each_has_a_digest() -> None:
    runtime, tests = (entries(text) for text in LOCKS.values())
    assert not runtime.keys() & tests.keys()
    for entry in (*runtime.values(), *tests.values()):
        head, *digests = entry.split(" \\\n    ")
        assert digests and all(re.fullmatch(r"--hash=sha256:[0-9a-f]{64}", each) for each in digests), head


def test_nothing_but_packages_is_in_a_lock() -> None:
    for text in LOCKS.values():
        rest = "".join(line for line in text.splitlines() if not line.startswith("#"))
        assert rest == "".join(entries(text).values()).replace("\n", "")
        assert "://" not in text


def test_what_derive_depends_on_is_locked_where_it_is_needed() -> None:
    assert {plain(name) for name in PROJECT["dependencies"]} <= {plain(name) for name in entries(LOCKS["runtime"])}
    both = {plain(name) for text in LOCKS.values() for name in entries(text)}
    assert {plain(name) for name in PROJECT["optional-dependencies"]["test"]} <= both
    assert {"hatchling", "editables"} <= {plain(name) for name in entries(LOCKS["runtime"])}
