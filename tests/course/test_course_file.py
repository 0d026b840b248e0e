"""`course.yaml`: what all sets of a course share, and what a set says differently."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.solution import rendered
from derive.course.names import ENGLISH, DecimalSign, EvidenceShown, Language, Paper
from derive.course.problem_set import PNG, ProblemSet, problem_set
from derive.errors import Rejected
from tests.course.test_variants import BEAD


def read(root: Path, of_course: str | None, of_set: str) -> ProblemSet:
    folder = root / "problems" / "week1"
    folder.mkdir(parents=True)
    (folder / "bead.yaml").write_text("title: A bead\n")
    (folder / "set.yaml").write_text(f"title: Week 1\n{of_set}problems: [bead]\n")
    if of_course is not None:
        (root / "course.yaml").write_text(of_course)
    return problem_set(root, "week1")


def test_a_set_has_the_keys_of_its_course(tmp_path: Path) -> None:
    found = read(
        tmp_path, "course: Mechanics\ninstitution: Physics\nterm: Fall\npaper: a4\nevidence: end\n", "date: 3 May\n"
    )
    assert found.facts == ["Mechanics", "Physics", "Fall", "3 May"]
    assert (found.paper, found.evidence) == (Paper.A4, EvidenceShown.END)
    assert found.inputs == ("problems/week1/set.yaml", "course.yaml"), "an edit of the course makes the pages old"


def test_a_key_of_the_set_overrides_the_key_of_its_course(tmp_path: Path) -> None:
    found = read(tmp_path, "course: Mechanics\npaper: a4\n", "course: Waves\npaper: letter\n")
    assert (found.course, found.paper) == ("Waves", Paper.LETTER)


@pytest.mark.parametrize(
    ("of_course", "of_set", "language"),
    [
        ("", "", ENGLISH),
        ("language: de\n", "", Language("de")),
        ("language: de\n", "language: fr\n", Language("fr")),
        ("language: de\ndecimal: point\n", "", Language("de", DecimalSign.POINT)),
        ("decimal: comma\n", "language: de\n", Language("de", DecimalSign.COMMA)),
    ],
)
def test_the_language_and_the_decimal_sign(tmp_path: Path, of_course: str, of_set: str, language: Language) -> None:
    assert read(tmp_path, f"course: Waves\n{of_course}", of_set).language == language


def test_without_the_file_of_a_course_the_set_names_the_course(tmp_path: Path) -> None:
    found = read(tmp_path, None, "course: Waves\n")
    assert (found.course, found.inputs) == ("Waves", ("problems/week1/set.yaml",))


@pytest.mark.parametrize(
    ("of_course", "of_set", "codes"),
    [
        (None, "", [("missing-key", "problems/week1/set.yaml")]),
        ("term: Fall\n", "", [("missing-key", "problems/week1/set.yaml")]),
        ("course: [\n", "", [("yaml", "course.yaml")]),
        ("- course\n", "", [("wrong-type", "course.yaml")]),
        (
            "course: A\npaper: a5\ncourze: B\n",
            "paper: b\n",
            [("wrong-type", "course.yaml"), ("unknown-key", "course.yaml"), ("wrong-type", "problems/week1/set.yaml")],
        ),
    ],
)
def test_all_errors_of_both_files_are_reported(
    tmp_path: Path, of_course: str | None, of_set: str, codes: list[tuple[str, str]]
) -> None:
    with pytest.raises(Rejected) as caught:
        read(tmp_path, of_course, of_set)
    assert sorted((each.code, each.place.path) for each in caught.value.complaints if each.place) == sorted(codes)


def test_a_logo_is_a_png_file_of_the_course(tmp_path: Path) -> None:
    (tmp_path / "logo.png").write_bytes(PNG + b"more")
    found = read(tmp_path, "course: A\nlogo: logo.png\n", "")
    assert found.logo == PNG + b"more"
    assert "logo.png" in found.inputs


@pytest.mark.parametrize(
    ("path", "content", "message"),
    [
        ("none.png", PNG, "the course has no file `none.png`"),
        ("../secret.png", PNG, "the course has no file"),
        ("linked.png", PNG, "the course has no file"),
        ("logo.png", b"%PDF-1.5", "is not a PNG file"),
        ("logo.png", PNG + bytes(2_000_000), "larger than 2 MB"),
        ("problems", PNG, "the course has no file"),
    ],
)
def test_any_other_logo_is_an_error_at_its_line(tmp_path: Path, path: str, content: bytes, message: str) -> None:
    course = tmp_path / "course"
    course.mkdir()
    (course / "logo.png").write_bytes(content)
    (tmp_path / "secret.png").write_bytes(PNG)
    (course / "linked.png").symlink_to(tmp_path / "secret.png")
    with pytest.raises(Rejected, match=message) as caught:
        read(course, f"course: A\nlogo: {path}\n", "")
    (complaint,) = caught.value.complaints
    assert complaint.place and (complaint.place.path, complaint.place.line) == ("course.yaml", 2)


def test_the_default_form_of_answers_is_that_of_the_set_or_of_the_course(tmp_path: Path) -> None:
    """sqrt(9.81/0.2) rad/s = 7.0036 rad/s = 66.879 rpm, worked out by hand."""
    problem = BEAD.replace("VARIANTS\n", "").replace("    form: {unit: rad/s}\n", "")
    found = read(tmp_path, "course: A\nform: {unit: [cm, rpm], figures: 3}\n", "font_size: 12 pt\ndetail: full\n")
    assert (found.font_size, found.detail, found.form_in_words) == ("12 pt", "full", "cm, rpm, 3 figures")
    folder = tmp_path / "problems" / "week1"

    def value(written: str) -> str:
        (folder / "bead.yaml").write_text(written)
        return rendered(tmp_path, "week1/bead", only=("text",)).texts["text"].rpartition("≈ ")[2].partition("  ")[0]

    assert value(problem) == "66.9 rpm"
    assert value(problem.rstrip() + "\n    form: {unit: rev/s}\n") == "1.11 rev/s"
    assert value(problem + "figures: 2\n") == "67 rpm"
    (folder / "set.yaml").write_text("title: A\nform: {figures: 5}\nproblems: [bead]\n")
    assert value(problem) == "7.0036 rad/s", "the form of the set takes the place of that of the course"


@pytest.mark.parametrize(
    ("of_set", "code"),
    [
        ("form: {}\n", "unused-key"),
        ("form: {figures: 3, units: cm}\n", "unknown-key"),
        ("form: {unit: parsnip}\n", "unknown-unit"),
        ("figures: 3\n", "unknown-key"),
        ("font_size: 13 pt\n", "wrong-type"),
        ("detail: long\n", "wrong-type"),
    ],
)
def test_a_key_without_effect_is_an_error(tmp_path: Path, of_set: str, code: str) -> None:
    with pytest.raises(Rejected) as caught:
        read(tmp_path, "course: A\n", of_set)
    assert [each.code for each in caught.value.complaints] == [code]
