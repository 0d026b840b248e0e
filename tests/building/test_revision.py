"""A course as git has it: its files, and what is said where there is no git, no repository, no such revision."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.revision import course_at
from derive.course.problem_set import PNG, problem_set
from derive.errors import Misused
from tests.building.repository import committed, git


def course(root: Path, said: str = "first") -> Path:
    folder = root / "problems" / "hw1"
    folder.mkdir(parents=True)
    (folder / "one.yaml").write_text(said)
    (root / "elsewhere").write_text("of no interest")
    return root


def complaint(root: Path, revision: str, set_id: str = "hw1") -> tuple[str, str]:
    with pytest.raises(Misused) as caught, course_at(root, revision, set_id):
        pass
    (found,) = caught.value.complaints
    return found.code, found.message


def test_the_files_of_the_set_are_as_they_were_and_gone_afterwards(tmp_path: Path) -> None:
    root = committed(course(tmp_path))
    (root / "problems" / "hw1" / "one.yaml").write_text("second")
    with course_at(root, "HEAD", "hw1") as then:
        files = [str(path.relative_to(then)) for path in sorted(then.rglob("*")) if path.is_file()]
        assert files == ["problems/hw1/one.yaml"]
        assert (then / "problems" / "hw1" / "one.yaml").read_text() == "first"
    assert not then.exists()
    assert (root / "problems" / "hw1" / "one.yaml").read_text() == "second"


def test_a_course_below_the_top_of_its_repository_has_its_own_templates(tmp_path: Path) -> None:
    root = course(tmp_path / "teaching" / "mechanics")
    (root / "templates").mkdir()
    (root / "templates" / "words.yaml").write_text("then")
    committed(tmp_path)
    with course_at(root, "HEAD", "hw1") as then:
        assert (then / "templates" / "words.yaml").read_text() == "then"
        assert (then / "problems" / "hw1" / "one.yaml").read_text() == "first"


def test_no_program_that_a_repository_names_is_run(tmp_path: Path) -> None:
    """Such as one that git would pass files through when it puts them into a working tree."""
    root = course(tmp_path)
    (root / ".gitattributes").write_text("* filter=own\n")
    committed(root)
    taken = root / "taken"
    for key in ("filter.own.smudge", "filter.own.process", "core.fsmonitor", "core.pager", "tar.tar.command"):
        git(root, "config", key, f"touch {taken}; cat")
    with course_at(root, "HEAD", "hw1") as then:
        assert (then / "problems" / "hw1" / "one.yaml").read_text() == "first"
    assert not taken.exists()


def test_files_of_any_content_come_as_they_were_committed(tmp_path: Path) -> None:
    root = course(tmp_path)
    contents = {"two.yaml": b"", "three.yaml": b"a\r\n\0b\n\n", "four.yaml": b"$Id$ $Format:%H$"}
    (root / ".gitattributes").write_text("four.yaml export-subst ident\nthree.yaml export-ignore text eol=lf\n")
    for name, content in contents.items():
        (root / "problems" / "hw1" / name).write_bytes(content)
    with course_at(committed(root), "HEAD", "hw1") as then:
        found = {name: (then / "problems" / "hw1" / name).read_bytes() for name in contents}
    assert found == contents | {"three.yaml": b"a\n\0b\n\n"}, "git itself ends lines so when it commits"


def test_a_link_is_left_out(tmp_path: Path) -> None:
    root = course(tmp_path)
    (root / "problems" / "hw1" / "two.yaml").symlink_to("/etc/passwd")
    with course_at(committed(root), "HEAD", "hw1") as then:
        assert [path.name for path in (then / "problems" / "hw1").iterdir()] == ["one.yaml"]


@pytest.mark.parametrize("revision", ["nowhere", "HEAD~3", "", "--help", "HEAD:problems", "a\nb"])
def test_a_revision_that_is_none_is_said(tmp_path: Path, revision: str) -> None:
    assert complaint(committed(course(tmp_path)), revision)[0] == "no-such-revision"


def test_a_set_that_was_not_there_is_said(tmp_path: Path) -> None:
    assert complaint(committed(course(tmp_path)), "HEAD", "hw2") == ("no-such-set", "no set was called `hw2` at `HEAD`")


def test_no_repository_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    assert complaint(course(tmp_path), "HEAD")[0] == "no-repository"


def test_no_git_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root = committed(course(tmp_path))
    monkeypatch.setenv("PATH", str(tmp_path))
    assert complaint(root, "HEAD")[0] == "no-git"


def test_the_file_of_the_course_and_its_logo_are_there_too(tmp_path: Path) -> None:
    root = course(tmp_path)
    (root / "problems" / "hw1" / "set.yaml").write_text("title: T\nproblems: [one]\n")
    (root / "course.yaml").write_text("course: C\nlogo: art/logo.png\n")
    (root / "art").mkdir()
    (root / "art" / "logo.png").write_bytes(PNG)
    with course_at(committed(root), "HEAD", "hw1") as then:
        assert problem_set(then, "hw1").facts == ["C"]
        assert problem_set(then, "hw1").logo == PNG


def test_a_script_of_another_set_is_there_too(tmp_path: Path) -> None:
    root = course(tmp_path)
    (root / "problems" / "hw2").mkdir()
    (root / "problems" / "hw2" / "slab.py").write_text("def solve(): pass\n")
    (root / "problems" / "hw2" / "set.yaml").write_text("course: C\ntitle: T\n")
    with course_at(committed(root), "HEAD", "hw1") as then:
        assert sorted(file.name for file in (then / "problems" / "hw2").iterdir()) == ["slab.py"]
