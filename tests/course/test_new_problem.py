"""A problem begun: it builds at once, it is listed, and nothing that somebody wrote is lost."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.solution import rendered
from derive.course.new_problem import PATTERNS, begun
from derive.course.problem_set import problem_set
from derive.errors import Misused, Rejected
from derive.page.template import templates_of
from tests.courses import ROOT, course_in

LIKE = [*PATTERNS, "hw9/block"]


def written(root: Path, problem_id: str, like: str) -> dict[str, str]:
    files = begun(root, templates_of(ROOT).file, ROOT / "templates", problem_id, like, root)
    for path, content in files.items():
        (root / path).parent.mkdir(exist_ok=True)
        (root / path).write_text(content)
    return files


@pytest.mark.parametrize("like", LIKE)
def test_what_is_begun_builds_at_once_and_is_listed(tmp_path: Path, like: str) -> None:
    root = course_in(tmp_path)
    written(root, "hw10/wheel", like)
    assert problem_set(root, "hw10").problems == ("hw10/wheel",)
    assert rendered(root, "hw10/wheel", only=("text",)).agreed


def test_an_editor_is_told_of_the_schema(tmp_path: Path) -> None:
    files = written(course_in(tmp_path), "hw10/wheel", "body")
    assert files["problems/hw10/wheel.yaml"].startswith("# yaml-language-server: $schema=")


@pytest.mark.parametrize("listed", ["problems:\n  - block\n", "problems: [block]\n", "problems:\n- block  # first\n"])
def test_the_list_of_a_set_grows_by_one_name_and_keeps_the_rest(tmp_path: Path, listed: str) -> None:
    root = course_in(tmp_path)
    file = root / "problems" / "hw9" / "set.yaml"
    file.write_text(f"# mine\ncourse: M\ntitle: T\n{listed}date: today\n")
    written(root, "hw9/wheel", "body")
    assert problem_set(root, "hw9").problems == ("hw9/block", "hw9/wheel")
    assert "# mine\ncourse: M\n" in file.read_text() and file.read_text().endswith("date: today\n")


def test_a_file_that_is_there_is_never_written_over(tmp_path: Path) -> None:
    with pytest.raises(Misused, match="already"):
        begun(course_in(tmp_path), templates_of(ROOT).file, ROOT / "templates", "hw9/block", "body", tmp_path)


@pytest.mark.parametrize(
    ("name", "like", "said"),
    [
        ("hw10/solutions", "body", "cannot be called"),
        ("hw10/index", "body", "cannot be called"),
        ("hw10", "body", "not a valid name"),
        ("../x/y", "body", "not a valid name"),
        ("hw10/a b", "body", "not a valid name"),
        ("hw10/wheel", "bdy", "did you mean `body`"),
        ("hw10/wheel", "hw9/blok", "did you mean `hw9/block`"),
    ],
)
def test_what_cannot_be_begun_is_told_with_what_can(tmp_path: Path, name: str, like: str, said: str) -> None:
    with pytest.raises(Misused, match=said):
        begun(course_in(tmp_path), templates_of(ROOT).file, ROOT / "templates", name, like, tmp_path)


def test_the_file_of_a_set_with_a_fault_is_told_and_left_alone(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    (root / "problems" / "hw9" / "set.yaml").write_text("course: M\ntitle: T\nproblems: block\n")
    with pytest.raises(Rejected, match="list of names"):
        begun(root, templates_of(ROOT).file, ROOT / "templates", "hw9/wheel", "body", root)


def test_the_file_of_a_new_set_leaves_out_the_course_that_course_yaml_states(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    (root / "course.yaml").write_text("course: Classical Mechanics\n")
    files = begun(root, templates_of(ROOT).file, ROOT / "templates", "fall/wheel", "body", root)
    text = files["problems/fall/set.yaml"]
    assert text.startswith("# yaml-language-server: $schema=") and "set.schema.json" in text
    assert "course:" not in text
    (root / "course.yaml").write_text("term: Fall 2026\n")
    assert "\ncourse: Mechanics\n" in written(root, "hw10/wheel", "body")["problems/hw10/set.yaml"]
