"""The files of a new course: they build at once, and nothing of the author's is overwritten."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
import yaml

from derive.cli.options import parser_of_commands
from derive.course.new_course import FILES, begun_course
from derive.course.problem_set import problem_set
from derive.errors import Misused
from derive.page.template import templates_of
from tests.courses import ROOT

TITLES = ["Mechanics", 'A "course": #1', "Mécanique\\", "- no list", "{title}"]


def begin(folder: Path, title: str = "Mechanics") -> dict[str, str]:
    texts = begun_course(folder, title, templates_of(ROOT).file)
    for path, text in texts.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text, encoding="utf-8")
    return texts


@pytest.mark.parametrize("title", TITLES)
def test_the_course_has_the_name_that_was_given(tmp_path: Path, title: str) -> None:
    begin(tmp_path, title)
    assert problem_set(tmp_path, "week1").course == title


def test_a_folder_that_is_a_course_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "problems").mkdir()
    with pytest.raises(Misused, match="is a course already"):
        begin(tmp_path)


@pytest.mark.parametrize("path", FILES)
def test_no_file_is_overwritten(tmp_path: Path, path: str) -> None:
    if path.startswith("problems/"):
        return
    (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / path).write_text("mine")
    with pytest.raises(Misused, match="already exists"):
        begin(tmp_path)
    assert (tmp_path / path).read_text() == "mine"


def commands_in(text: str) -> list[list[str]]:
    return [found.split() for found in re.findall(r"(?:^|[\s`;-])derive((?: [\w./-]+)+)", text, re.MULTILINE)]


@pytest.mark.parametrize("path", ["README.md", "Makefile", ".github/workflows/course.yml", ".gitlab-ci.yml"])
def test_the_commands_that_the_files_name_exist(tmp_path: Path, path: str) -> None:
    text = begin(tmp_path)[path]
    found = [words for words in commands_in(text) if words[0] not in ("runs",)]
    assert found
    for words in found:
        assert parser_of_commands(words).parse_args(words).command == words[0]


@pytest.mark.parametrize("path", [".github/workflows/course.yml", ".gitlab-ci.yml"])
def test_a_workflow_publishes_the_sheets_only(tmp_path: Path, path: str) -> None:
    text = begin(tmp_path)[path]
    steps = yaml.safe_load(text)
    if path.startswith(".github"):
        published = [
            step["with"]["path"] for step in steps["jobs"]["build"]["steps"] if "pages" in step.get("uses", "")
        ]
        assert published == ["public"]
        versions = dict(re.findall(r"uses: actions/(\S+)@v(\d+)", text))
        least = {"checkout": 5, "setup-python": 6, "upload-artifact": 6, "upload-pages-artifact": 5, "deploy-pages": 5}
        assert versions.keys() == least.keys(), "GitHub removed Node 20, which earlier versions of these actions need"
        assert all(int(versions[action]) >= least[action] for action in least)
    else:
        assert steps["pages"]["artifacts"]["paths"] == ["public"]
        assert steps["build"]["artifacts"]["access"] == "developer"
    copied = re.findall(r"build/\*/(\S+?)[\s;]", text)
    assert copied == ["students"]


def test_the_image_runs_as_a_plain_user(tmp_path: Path) -> None:
    lines = begin(tmp_path)["Containerfile"].splitlines()
    first = {line.partition(" ")[0]: number for number, line in reversed(list(enumerate(lines))) if line[:1].isupper()}
    assert first["FROM"] < first["USER"] < first["ENTRYPOINT"]
    (user,) = re.findall(r"useradd .*--uid (\d+)", "\n".join(lines))
    assert lines[first["USER"]] == f"USER {user}"
    assert f"--userns=keep-id:uid={user},gid={user} " in lines[first["FROM"] - 2], "the user can write in the course"
    name = re.search(r'^name = "(.+)"', (ROOT / "pyproject.toml").read_text(), re.MULTILINE)
    assert name and f"pip install --no-cache-dir {name[1]}" in "\n".join(lines)
