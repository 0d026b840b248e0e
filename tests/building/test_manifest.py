"""The record of a set: what its outputs were made from, believed only as it was written."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path
from typing import Any

import pytest

from derive.building import signatures
from derive.building.cache import digest
from derive.building.manifest import Manifest, outputs_of, outputs_of_document
from derive.building.sets import Options, Report, built_set
from tests.fake_course import Course, stand_in_course


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Course:
    return stand_in_course(tmp_path, monkeypatch)


def built(course: Course) -> Report:
    return built_set(course.root, "hw1", Options(), lambda _: None)


def signed_again(course: Course, **changes: Any) -> None:
    """The record as it would be if derive itself had written it."""
    record = dataclasses.asdict(Manifest.read(course.outputs)) | changes
    del record["folder"]
    signatures.write_signed(course.outputs / ".manifest.json", "the record of hw1", json.dumps(record).encode())


@pytest.mark.parametrize("name", ["../../victim.txt", "/victim.txt", ".lock", "a/b.pdf", "victim", "x.py", ""])
def test_a_record_names_plain_outputs_or_is_none(course: Course, name: str) -> None:
    victim = course.root / "victim.txt"
    victim.write_text("mine")
    built(course)
    signed_again(course, drawings={"one": [name]})
    course.problem("one", "edited")
    assert not built(course).failed
    assert victim.read_text() == "mine"


@pytest.mark.parametrize(
    "field",
    [
        "problems",
        "complete",
        "set_inputs",
        "inputs",
        "outputs",
        "drawings",
        "pages",
        "typeset_by",
        "typeset_from",
        "asked",
        "made_by",
        "recipes",
    ],
)
@pytest.mark.parametrize("value", [3, None, [1], {"one": 3}, "text"])
def test_a_record_with_a_field_of_another_type_counts_as_none(course: Course, field: str, value: object) -> None:
    folder = course.outputs
    folder.mkdir(parents=True)
    Manifest(folder).save()
    if type(value) is type(getattr(Manifest(folder), field)) and isinstance(value, str):
        value = 3.5
    signed_again(course, **{field: value})
    assert Manifest.read(folder) == Manifest(folder)


def test_a_problem_that_leaves_the_set_takes_its_outputs_along_and_no_other_file(course: Course) -> None:
    course.problem("two", "draws")
    built(course)
    (course.outputs / "two.notes").write_text("mine")
    (course.outputs / "two.txt").write_text("edited by hand")
    course.heading("one")
    assert not built(course).failed
    assert {file.name for file in course.outputs.glob("two*")} == {"two.notes", "two.txt"}
    assert (course.outputs / "one.pdf").is_file()


def test_a_damaged_record_is_no_obstacle(course: Course) -> None:
    built(course)
    (course.outputs / ".manifest.json").write_text("{")
    assert built(course).derived == 2


def test_a_kept_derivation_of_another_text_is_not_used(course: Course) -> None:
    built(course)
    record = (course.outputs / ".manifest.json").read_bytes()
    course.problem("one", "edited")
    built(course)
    # as if the second build had been killed before it wrote its record, and the edit then taken back
    (course.outputs / ".manifest.json").write_bytes(record)
    course.problem("one", "first")
    built(course)
    assert "first" in (course.outputs / "one.pdf").read_text()


def test_a_record_is_read_as_it_was_saved_and_only_in_its_own_folder(tmp_path: Path) -> None:
    (tmp_path / "hw1").mkdir()
    record = Manifest(
        tmp_path / "hw1", ["one"], True, "modules", {"set.yaml": "1"}, {"one": {"one.yaml": "1"}}, {"one": "2"}
    )
    record.save()
    assert Manifest.read(tmp_path / "hw1") == record
    (tmp_path / "hw1").rename(tmp_path / "hw2")
    assert Manifest.read(tmp_path / "hw2") == Manifest(tmp_path / "hw2")


def test_a_page_is_of_its_recipe_and_of_each_of_its_files() -> None:
    record = Manifest(Path(), inputs={"one": {"a": "", "b": ""}, "two": {"a": "", "b": ""}})
    read = {"a": "1", "b": "2"}.__getitem__
    keys = {
        record.page_key("one", "recipe", read),
        record.page_key("one", "another", read),
        record.page_key("one", "recipe", {"a": "2", "b": "1"}.__getitem__),
        record.page_key("two", "recipe", read),
        record.page_key("none", "recipe", read),
    }
    assert len(keys) == 5


def test_what_a_page_was_made_from_is_noted_and_recipes_of_no_page_are_forgotten(tmp_path: Path) -> None:
    record = Manifest(tmp_path / "hw1", inputs={"one": {"a": "", "b": ""}})
    (tmp_path / "hw1").mkdir()
    first = record.made("one", {"sympy": "1"}, {"a": "1", "b": "2"}.__getitem__)
    assert record.inputs == {"one": {"a": "1", "b": "2"}}
    assert record.recipes[record.made_by["one"]] == {"sympy": "1"}
    assert record.made("one", {"sympy": "2"}, {"a": "1", "b": "2"}.__getitem__) != first == first
    record.save()
    assert list(Manifest.read(tmp_path / "hw1").recipes.values()) == [{"sympy": "2"}]


def test_nothing_is_current_before_a_build_came_to_its_end(tmp_path: Path) -> None:
    assert not Manifest(tmp_path).is_current({}, "tex", str, ())
    assert not Manifest(tmp_path, complete=True).is_current({}, "tex", str, ()), "the documents of the set are missing"


def test_a_document_is_older_as_soon_as_a_file_of_any_of_its_problems_or_a_word_is_another(tmp_path: Path) -> None:
    record = Manifest(tmp_path, ["one", "two"], set_inputs={"set": "1"}, inputs={"one": {"a": "1"}, "two": {"b": "1"}})
    record.pages = {"one": "page", "two": "page"}
    words = {"templates/words": "1"}
    for name in ("one", "solutions"):
        record.was_typeset(name, {**words, "--detail": "full"}, "tex")
        (tmp_path / f"{name}.pdf").touch()

    def older(recipe: dict[str, str], **now: str) -> list[str]:
        read = {"set": "1", "a": "1", "b": "1", **now}.__getitem__
        return [name for name in ("one", "solutions", "key") if record.is_older(name, recipe, read)]

    assert older(words) == [], "how much is shown is not asked"
    assert older(words, b="2") == ["solutions"]
    assert older(words, a="2") == older(words, set="2") == older({"templates/words": "2"}) == ["one", "solutions"]


def test_a_document_that_the_set_no_longer_has_is_taken_away(tmp_path: Path) -> None:
    record = Manifest(tmp_path, documents=[["solutions", "hw1"], ["key", "key"]])
    for name in ("hw1.pdf", "hw1.tex", "key.pdf"):
        (tmp_path / name).write_text("ours")
        record.outputs[name] = digest("ours")
    record.replace_documents([["solutions", "solutions"], ["key", "key"]])
    assert [file.name for file in tmp_path.iterdir()] == ["key.pdf"]
    assert record.document_files == ["solutions", "key", "index"]


def test_an_output_is_taken_away_only_as_it_was_written(tmp_path: Path) -> None:
    outside = tmp_path / "outside.txt"
    outside.write_text("mine")
    (tmp_path / "hw1").mkdir()
    for name in ("own.txt", "edited.txt"):
        (tmp_path / "hw1" / name).write_text("ours")
    record = Manifest(
        tmp_path / "hw1", outputs={name: digest("ours") for name in ("own.txt", "edited.txt", "link.txt")}
    )
    (tmp_path / "hw1" / "edited.txt").write_text("mine")
    (tmp_path / "hw1" / "link.txt").symlink_to(tmp_path / "ours.txt")
    (tmp_path / "ours.txt").write_text("ours")
    for name in ("own.txt", "edited.txt", "link.txt", "../outside.txt"):
        record.remove(name)
    assert {file.name for file in (tmp_path / "hw1").iterdir()} == {"edited.txt", "link.txt"}
    assert outside.exists()
    assert record.outputs == {}


def test_a_document_of_the_set_has_no_text_and_no_json() -> None:
    assert outputs_of_document("solutions", "hw9") == ["hw9.pdf", "hw9.tex"]
    assert outputs_of_document("hints", "hw9-hints") == ["hw9-hints.pdf", "hw9-hints.tex", "hw9-hints.html"]
    own = outputs_of("block")
    assert {"block.pdf", "block.tex", "block.json", "block.txt"} <= set(own)
    assert Manifest(Path(), drawings={"block": ["block-axes.svg"]}).outputs_of("block") == [*own, "block-axes.svg"]
