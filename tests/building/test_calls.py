"""Calls of verbs kept between builds: an edit derives what depends on it, and the page is the one derived afresh."""

from __future__ import annotations

import multiprocessing
from pathlib import Path
from typing import Any

import pytest

from derive.building import calls
from derive.building.cache import Cache
from derive.building.calls import Calls, calls_of
from derive.building.solution import derived, rendered
from derive.course.problem import load_problem
from derive.errors import DeriveError
from derive.steps import establish
from derive.steps.derivation import Derivation
from tests.courses import course_in


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    keys: list[str] = []
    add = establish.record.add
    monkeypatch.setattr(establish.record, "add", lambda q, case: (keys.append(q.key), add(q, case))[1])
    return keys


def change(course: Path, name: str, old: str, new: str) -> None:
    file = course / "problems" / "hw9" / name
    text = file.read_text()
    assert text.count(old) == 1
    file.write_text(text.replace(old, new))


def derive(course: Path, cache: Cache, problem: str = "block") -> Derivation:
    with calls_of(f"hw9/{problem}", cache) as memory:
        return derived(load_problem(course, f"hw9/{problem}"), memory)[0]


def page(course: Path, problem: str, cache: Cache) -> Any:
    try:
        return rendered(course, problem, None, cache).to_data()
    except DeriveError as error:
        return [str(complaint) for complaint in error.complaints]


PINS_THE_SIDES = """\
- problem: block
  symbols: {a: length, M: mass, omega: angular speed}
  given: {sides: [a, 2*a, 3*a], mass: M, axis: diagonal, rate: omega}
  entries:
    - {answer: kinetic_energy_about_axis, states: 7/24*M*a**2*omega**2}
"""
EDITS = [
    ("block", "[a, 2*a, 3*a]", "[a, 2*a, 4*a]"),
    ("block", "mass: M\n", "mass: 2 kg\n"),
    ("double", "gravity: g", "gravity: 2*g"),
]


@pytest.mark.parametrize("problem", [pytest.param("block", marks=pytest.mark.long), "double"])
def test_after_an_edit_the_page_is_the_one_derived_afresh(tmp_path: Path, problem: str) -> None:
    course = course_in(tmp_path, problem=problem)
    file = course / "problems" / "hw9" / f"{problem}.yaml"
    text = file.read_text()
    cache = Cache(tmp_path / "kept")
    derive(course, cache, problem)
    for old, new in [(old, new) for name, old, new in EDITS if name == problem]:
        assert text.count(old) == 1
        file.write_text(text.replace(old, new))
        found = page(course, f"hw9/{problem}", cache)
        assert found == page(course, f"hw9/{problem}", Cache()), new


def of_verbs(keys: list[str]) -> set[str]:
    return {key for key in keys if key not in {"axis_vector", "centre_of_mass"} and not key.endswith("_value")}


def test_what_an_edit_does_not_touch_is_not_derived(tmp_path: Path, made: list[str]) -> None:
    course, cache = course_in(tmp_path), Cache(tmp_path / "kept")
    derive(course, cache)
    everything = len(made)
    made.clear()
    change(course, "block.yaml", "axis: diagonal", "axis: x")
    derive(course, cache)
    assert {"spin", "angular_momentum"} <= set(made)
    assert not any("corner_tensor" in key or "inertia" in key for key in made)
    assert 0 < len(made) < everything / 2
    made.clear()
    change(course, "block.yaml", "axis: x", "axis: diagonal")
    derive(course, cache)
    assert not of_verbs(made), "an edit that is taken back finds all"


def test_what_a_reference_pins_otherwise_is_recalled_too(tmp_path: Path, made: list[str]) -> None:
    course, cache = course_in(tmp_path), Cache(tmp_path / "kept")
    (course / "problems" / "hw9" / "reference.yaml").write_text(PINS_THE_SIDES)
    change(course, "block.yaml", "[a, 2*a, 3*a]", "[a, 2*a, 4*a]")
    rendered(course, "hw9/block", None, cache, only=())
    assert made.count("torque") == 2, "of what is given, and of what is pinned"
    made.clear()
    change(course, "block.yaml", "[a, 2*a, 4*a]", "[a, 2*a, 5*a]")
    assert rendered(course, "hw9/block", None, cache, only=()).compared == 1
    assert made.count("torque") == 1


WEDGE = """\
title: A block that slides on a wedge
solve: system
symbols: {m: mass, M: mass, g: acceleration, h: length, alpha: 'angle in (0, pi/2)'}
given:
  coordinates: {x: length, s: length}
  places: {wedge: [x, 0]}
  particles:
    wedge: {mass: M, at: wedge}
    block: {mass: m, at: {from: wedge, by: [s*cos(alpha), h - s*sin(alpha)]}}
  gravity: g
  results:
    heavy: {limit: acceleration_s, for: M, to: infinity}
    steep: {put_in: acceleration_s, values: {alpha: pi/2}}
statement: A block slides on a wedge.
parts:
  - ask: Find the accelerations.
    answer: [accelerations, heavy, steep]
"""


def test_calls_that_results_makes_are_recalled(tmp_path: Path, made: list[str]) -> None:
    course, cache = course_in(tmp_path), Cache(tmp_path / "kept")
    (course / "problems" / "hw9" / "block.py").unlink()
    (course / "problems" / "hw9" / "block.yaml").write_text(WEDGE)
    derive(course, cache)
    assert {"heavy", "steep"} <= set(made)
    made.clear()
    derive(course, cache)
    assert not {"heavy", "steep"} & set(made)
    change(course, "block.yaml", "{alpha: pi/2}", "{alpha: pi/4}")
    made.clear()
    assert page(course, "hw9/block", cache) == page(course, "hw9/block", Cache())
    assert made.count("steep") == 2, "once with the cache and once without"
    assert made.count("heavy") == 1, "without the cache alone"


def test_a_part_that_is_added_derives_itself_alone(tmp_path: Path, made: list[str]) -> None:
    course, cache = course_in(tmp_path), Cache(tmp_path / "kept")
    derive(course, cache)
    made.clear()
    change(course, "block.py", "    return I,", '    size = magnitude(L, key="size")\n    return size, I,')
    derive(course, cache)
    assert of_verbs(made) == {"size"}


def test_a_script_that_fails_keeps_what_it_made_before(tmp_path: Path, made: list[str]) -> None:
    course, cache = course_in(tmp_path), Cache(tmp_path / "kept")
    change(course, "block.py", "    return I,", "    1 / 0\n    return I,")
    with pytest.raises(DeriveError):
        derive(course, cache)
    made.clear()
    change(course, "block.py", "    1 / 0\n", "")
    assert derive(course, cache) == derive(course, Cache())
    assert made.index("magnitude") <= 3, "what comes behind the fault"


def test_a_build_that_is_forced_derives_everything(tmp_path: Path, made: list[str]) -> None:
    course = course_in(tmp_path)
    derive(course, Cache(tmp_path / "kept"))
    everything = list(made)
    made.clear()
    derive(course, Cache(tmp_path / "kept", fresh=True))
    assert made == everything


def test_without_a_cache_nothing_is_remembered(tmp_path: Path) -> None:
    with calls_of("hw9/block", Cache()) as memory:
        assert memory is None
    _, _, _, run = derived(load_problem(course_in(tmp_path), "hw9/block"))
    assert run.memory is None


def test_what_was_used_last_is_kept_and_of_what_was_not_as_much_as_there_is_room_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(calls, "ROOM", 10)

    def use(*keys: str) -> list[str]:
        calls = Calls(Cache(tmp_path), "one")
        before = list(calls.earlier)
        for key in keys:
            calls.get(key) or calls.keep(key, key * 5)
        calls.save()
        return before

    assert use("a", "b") == []
    assert use("b", "c") == ["a", "b"]
    assert use("c") == ["b", "c", "a"]
    assert use("d") == ["b", "c", "a"], "nothing was new, so nothing was written"
    assert use() == ["d", "b", "c"]


def build(course: Path, problem: str) -> None:
    derive(course, Cache(course / "kept"), problem)


def test_builds_at_once_share_what_is_kept(tmp_path: Path) -> None:
    course = course_in(tmp_path)
    for name in ("block.yaml", "block.py"):
        text = (course / "problems" / "hw9" / name).read_text().replace("block.py", "other.py")
        other = course / "problems" / "hw9" / name.replace("block", "other")
        other.write_text(text.replace("[a, 2*a, 3*a]", "[a, a, 2*a]"))
    change(course, "set.yaml", "- block", "- block\n  - other")
    forked = multiprocessing.get_context("fork")
    crew = [forked.Process(target=build, args=(course, name)) for name in ("block", "block", "other")]
    for each in crew:
        each.start()
    for each in crew:
        each.join()
    assert [each.exitcode for each in crew] == [0, 0, 0]
    cache = Cache(course / "kept")
    files = sorted(file.name for file in (course / "kept").iterdir())
    assert all(cache.get(name) is not None for name in files), "each is whole, and nothing lies beside them"
    for name in ("block", "other"):
        assert derive(course, cache, name) == derive(course, Cache(), name)
