"""Which input made an output stale, told in words with the command that fixes it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from derive.building.manifest import Manifest
from derive.building.recipe import recipe_of
from derive.building.sets import Options, built_set
from derive.building.staleness import MOST, Asked, Staleness, asked_about, staleness
from derive.errors import DeriveError, Misused
from tests.fake_course import Course, stand_in_course


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Course:
    course = stand_in_course(tmp_path, monkeypatch)
    (tmp_path / "templates").mkdir()
    (tmp_path / "templates" / "own.j2").write_text("one")
    (course.folder / "reference.yaml").write_text("one")
    built(course)
    return course


def built(course: Course, **options: object) -> None:
    assert not built_set(course.root, "hw1", replace(Options(), **options), lambda _: None).failed


def told(course: Course, what: str, **options: str) -> Staleness:
    return staleness(replace(Asked(course.root, *asked_about(course.root, what)), **options))


@pytest.mark.parametrize("what", ["build/hw1/one.pdf", "build/hw1/one.txt", "hw1/one", "hw1", "build/hw1/index.html"])
def test_what_was_just_built_is_up_to_date(course: Course, what: str) -> None:
    assert told(course, what).shown() == f"{what} is up to date"


def test_an_export_is_older_after_an_edit(course: Course) -> None:
    """A build does not make the export again, so it warns, and names the command."""
    (course.outputs / "one-qti.zip").write_text("an export")
    manifest = Manifest.read(course.outputs)
    inputs = dict(manifest.inputs["one"])
    manifest.was_exported("one-qti.zip", recipe_of(course.root, of_set=manifest.of_set), inputs, manifest.of_set)
    manifest.save()
    assert told(course, "build/hw1/one-qti.zip").shown() == "build/hw1/one-qti.zip is up to date"
    course.problem("one", "edited")
    (warning,) = built_set(course.root, "hw1", Options(), lambda _: None).warnings
    assert (warning.code, warning.help) == ("older", "`derive export hw1/one --format qti` makes it again")
    assert "`one-qti.zip`" in warning.message
    assert (
        "to bring it up to date: `derive export hw1/one --format qti`" in told(course, "build/hw1/one-qti.zip").shown()
    )


def edited(course: Course) -> None:
    course.problem("one", "edited")


def taken_away(course: Course) -> None:
    (course.folder / "reference.yaml").unlink()


def of_words(course: Course) -> None:
    (course.root / "templates" / "own.j2").write_text("two")


def added(course: Course) -> None:
    (course.root / "templates" / "new.j2").write_text("new")


def of_the_set(course: Course) -> None:
    course.heading("two", "one")


def by_hand(course: Course) -> None:
    (course.outputs / "one.pdf").write_text("mine")


def lost(course: Course) -> None:
    (course.outputs / "one.pdf").unlink()


def of_tex(course: Course) -> None:
    with open(course.root / "bin" / "pdflatex", "a") as program:
        program.write("\n")


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (edited, "`problems/hw1/one.yaml` has changed"),
        (taken_away, "`problems/hw1/reference.yaml` is gone"),
        (of_words, "`templates/own.j2` has changed"),
        (added, "`templates/new.j2` is new"),
        (of_the_set, "`problems/hw1/set.yaml` has changed"),
        (by_hand, "`one.pdf` has been edited since the build wrote it"),
        (lost, "`one.pdf` does not exist any more"),
        (of_tex, "the program of the TeX engine pdflatex has changed"),
    ],
)
def test_the_input_that_changed_is_named_and_a_build_fixes_it(
    course: Course, change: Callable[[Course], None], reason: str
) -> None:
    change(course)
    found = told(course, "build/hw1/one.pdf")
    assert found.reasons == (reason,)
    assert found.fixes == ("to bring it up to date: `derive build hw1/one`",)
    built(course)
    assert told(course, "build/hw1/one.pdf").reasons == ()


def test_an_edit_of_one_problem_makes_the_documents_stale_and_no_other_problem(course: Course) -> None:
    edited(course)
    assert told(course, "hw1/two").reasons == ()
    found = told(course, "build/hw1/solutions.pdf")
    assert found.reasons == ("`problems/hw1/one.yaml` has changed",)
    assert found.fixes == ("to bring it up to date: `derive build hw1`",)


def test_other_options_are_told_with_the_command_that_keeps_them(course: Course) -> None:
    built(course, detail="full")
    found = told(course, "build/hw1/one.pdf")
    assert found.reasons == ("it was made with `--detail full`, but would now be made with no `--detail`",)
    assert found.fixes[-1] == "to build as before: `derive build hw1/one --detail full`"
    assert told(course, "build/hw1/one.pdf", detail="full").reasons == ()
    assert "`derive build hw1/one --evidence end`" in told(course, "hw1/one", evidence="end").fixes[0]


def test_another_engine_concerns_pdfs_alone(course: Course) -> None:
    (course.root / "bin" / "lualatex").symlink_to("pdflatex")
    found = told(course, "build/hw1/one.pdf", engine="lualatex")
    assert found.reasons == ("it was typeset by pdflatex, but would now be typeset by lualatex",)
    assert told(course, "build/hw1/one.txt", engine="lualatex").reasons == ()
    assert told(course, "build/hw1/one.pdf", engine="latexmk").reasons != ()


def test_other_modules_and_packages_are_told(course: Course) -> None:
    record = Manifest.read(course.outputs)
    for recipe in record.recipes.values():
        recipe.update({"sympy": "1.0", "the modules of derive": "other"})
    record.save()
    modules, sympy = sorted(told(course, "hw1/one").reasons)
    assert modules == "derive itself has changed"
    assert sympy.startswith("the package sympy is ")
    assert sympy.endswith(", and was 1.0")


def test_what_was_never_built_is_told_so(course: Course) -> None:
    course.problem("three", "third")
    course.heading("one", "two", "three")
    assert told(course, "hw1/three").reasons[-1] == "the problem `hw1/three` has not been built"
    (course.outputs / ".manifest.json").unlink()
    assert told(course, "build/hw1/one.pdf").shown().splitlines() == [
        "build/hw1/one.pdf is out of date:",
        "  `hw1` has not been built here yet",
        "to bring it up to date: `derive build hw1/one`",
    ]


def test_a_fault_keeps_documents_stale_until_it_is_mended(course: Course) -> None:
    course.problem("one", "refuse")
    assert built_set(course.root, "hw1", Options(), lambda _: None).failed
    assert [reason for reason in told(course, "hw1").reasons if "found an error" in reason]
    course.problem("one", "first")
    built(course)
    assert told(course, "hw1").reasons == ()


def test_a_page_that_tex_refused_is_stale_also_in_the_next_build_of_another(course: Course) -> None:
    course.problem("one", "BAD")
    assert built_set(course.root, "hw1", Options(), lambda _: None).failed
    built(course, only=("two",))
    assert told(course, "build/hw1/one.pdf").reasons == ("`problems/hw1/one.yaml` has changed",)


def carried_out(course: Course, found: Staleness) -> None:
    command = found.fixes[0].partition("`derive build ")[2].removesuffix("`").split()
    what, *options = command
    only = (what.partition("/")[2],) if "/" in what else ()
    built(course, only=only, documents=tuple(options[1].split(",")) if options[:1] == ["--only"] else ())


def test_a_document_that_was_never_made_is_told_with_the_command_that_makes_it(course: Course) -> None:
    found = told(course, "build/hw1/key.pdf")
    assert found.reasons == ("the document `key` of `hw1` has not been made",)
    assert found.fixes == ("to bring it up to date: `derive build hw1 --only key`",)
    carried_out(course, found)
    assert told(course, "build/hw1/key.pdf").reasons == ()


@pytest.mark.parametrize("name", ["key.pdf", "key.html", "solutions.pdf", "index.html", "one.pdf"])
def test_the_command_that_is_named_works_for_documents_that_were_asked_for_before(course: Course, name: str) -> None:
    built(course, documents=("key",))
    edited(course)
    found = told(course, f"build/hw1/{name}")
    assert found.reasons == ("`problems/hw1/one.yaml` has changed",)
    carried_out(course, found)
    assert told(course, f"build/hw1/{name}").reasons == ()


def test_what_another_document_alone_was_made_from_says_nothing_of_this_one(course: Course) -> None:
    edited(course)
    built(course, documents=("key",))
    assert told(course, "build/hw1/key.pdf").reasons == told(course, "build/hw1/one.pdf").reasons == ()
    found = told(course, "build/hw1/solutions.pdf")
    assert found.reasons == ("`problems/hw1/one.yaml` has changed",)
    carried_out(course, found)
    assert told(course, "hw1").reasons == ()


def test_a_problem_that_the_set_does_not_list_is_told_so(course: Course) -> None:
    course.problem("three", "third")
    found = told(course, "hw1/three")
    assert found.reasons == ("the set `hw1` does not list `three`",)
    assert found.fixes == (
        "to bring it up to date: list `three` in `problems/hw1/set.yaml`, then `derive build hw1/three`",
    )
    course.heading("one", "two", "three")
    carried_out(course, found)
    assert told(course, "hw1/three").reasons == ()


def test_of_very_many_reasons_the_first_are_told(course: Course) -> None:
    many = Staleness("x", tuple(map(str, range(MOST + 3))))
    assert many.shown().splitlines()[-1] == "  and 3 more"


@pytest.mark.parametrize(
    ("what", "code"),
    [
        ("build/hw1/one.doc", "no-such-output"),
        ("build/hw1/on.pdf", "no-such-problem"),
        ("hw1/on", "no-such-problem"),
        ("hw2", "no-such-set"),
        ("/etc/passwd", "no-such-output"),
        ("build", "no-such-output"),
        ("build/hw2/one.pdf", "no-such-set"),
    ],
)
def test_what_no_build_makes_is_refused(course: Course, what: str, code: str) -> None:
    with pytest.raises(DeriveError) as caught:
        told(course, what)
    assert isinstance(caught.value, Misused)
    assert caught.value.complaints[0].code == code


def test_a_page_is_found_from_where_one_is(course: Course, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(course.outputs)
    assert asked_about(course.root, "one.pdf") == ("hw1", ("one.pdf",))
    assert asked_about(course.root, str(course.outputs / "one.pdf")) == ("hw1", ("one.pdf",))
