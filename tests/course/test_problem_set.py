"""Which problems and sets there are: by their files, and what was meant by a name that there is none of."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.course.problem import load_problem
from derive.course.problem_set import found_path, problem_ids, problem_paths, problem_set, set_ids, topic_of
from derive.errors import DeriveError, Misused, Rejected
from tests.course.problem_file import PROBLEM, at


def test_ids_are_the_problem_files_and_nothing_beside_them(tmp_path: Path) -> None:
    folder = at(tmp_path) / "problems" / "hw9"
    (folder / "reference.yaml").write_text("")
    (folder / "odd name.yaml").write_text("")
    (tmp_path / "problems" / "stray.yaml").write_text("")
    assert (problem_ids(tmp_path), set_ids(tmp_path)) == (["hw9/block"], ["hw9"])


def test_a_folder_within_a_set_is_a_topic(tmp_path: Path) -> None:
    folder = at(tmp_path) / "problems" / "hw9"
    (folder / "rotation").mkdir()
    (folder / "rotation" / "wheel.yaml").write_text(PROBLEM.replace("block.py", "../block.py"))
    paths = problem_paths(tmp_path)
    assert paths == {"hw9/block": "problems/hw9/block.yaml", "hw9/wheel": "problems/hw9/rotation/wheel.yaml"}
    assert [topic_of(path) for path in paths.values()] == ["", "rotation"]
    assert load_problem(tmp_path, "hw9/wheel").script_path == "problems/hw9/block.py"


@pytest.mark.parametrize(
    ("wanted", "help_line"),
    [
        ("hw9/blok", "did you mean `hw9/block`?"),
        ("block", "did you mean `hw9/block`?"),
        ("hw9/BLOCK", "did you mean `hw9/block`?"),
        ("hw9/set", "`derive list` shows the problems"),
        ("hw9/../hw9/block", "did you mean `hw9/block`?"),
        ("../../etc/passwd", "`derive list` shows the problems"),
        ("", "`derive list` shows the problems"),
    ],
)
def test_a_problem_that_does_not_exist_is_met_with_the_nearest(wanted: str, help_line: str, tmp_path: Path) -> None:
    with pytest.raises(Misused) as caught:
        load_problem(at(tmp_path), wanted)
    (complaint,) = caught.value.complaints
    assert (complaint.code, complaint.help, caught.value.exit_code) == ("no-such-problem", help_line, 2)


def test_a_set_lists_its_problems_in_order(tmp_path: Path) -> None:
    at(tmp_path, heading="course: P\ntitle: T\ndate: 2026-11-21\ninstructor: N. N.\nproblems: [top, block]\n")
    (tmp_path / "problems" / "hw9" / "top.yaml").write_text(PROBLEM)
    found = problem_set(tmp_path, "hw9")
    assert (found.problems, found.date, found.inputs) == (
        ("hw9/top", "hw9/block"),
        "2026-11-21",
        ("problems/hw9/set.yaml",),
    )


@pytest.mark.parametrize(
    ("written", "code", "help_line"),
    [
        (
            "title: A #1\nproblems: [block]\n",
            "comment-in-text",
            "put the whole text in quotes; in a comment, a space and a word follow the `#`",
        ),
        ("title: {A}\nproblems: [block]\n", "wrong-type", "quote text that begins with `{`"),
        ("title: A\nproblems: [hw9/block]\n", "no-such-problem", "did you mean `block`?"),
        ("title: A\nproblems: [problems/hw9/block.yaml]\n", "no-such-problem", "did you mean `block`?"),
        ("title: A\nproblems: [set]\n", "reserved-name", "rename its files"),
    ],
)
def test_an_error_in_the_file_of_a_set_says_what_to_write(
    tmp_path: Path, written: str, code: str, help_line: str
) -> None:
    at(tmp_path, heading=f"course: P\n{written}")
    with pytest.raises(Rejected) as caught:
        problem_set(tmp_path, "hw9")
    assert [(c.code, c.help) for c in caught.value.complaints] == [(code, help_line)]


def test_every_fault_of_a_set_is_told_at_once(tmp_path: Path) -> None:
    at(tmp_path, heading="corse: P\ntitle:\nproblems: [blok, block, block, [x]]\nday: x\n")
    with pytest.raises(Rejected) as caught:
        problem_set(tmp_path, "hw9")
    assert [c.code for c in caught.value.complaints] == [
        "unknown-key",
        "missing-value",
        "no-such-problem",
        "duplicate-problem",
        "wrong-type",
        "unknown-key",
    ]


def test_a_set_that_does_not_exist_is_met_with_the_nearest(tmp_path: Path) -> None:
    with pytest.raises(DeriveError, match="did you mean `hw9`") as caught:
        problem_set(at(tmp_path), "hw8")
    assert caught.value.exit_code == 2


def test_a_folder_without_its_file_and_a_listed_problem_without_its_file_are_begun(tmp_path: Path) -> None:
    root = at(tmp_path, heading="course: P\ntitle: T\nproblems: [wheel, 'a b']\n")
    with pytest.raises(Rejected) as caught:
        problem_set(root, "hw9")
    assert [each.help for each in caught.value.complaints] == ["`derive new hw9/wheel` begins this problem", None]
    (root / "problems" / "hw9" / "set.yaml").unlink()
    with pytest.raises(Misused) as missing:
        problem_set(root, "hw9")
    assert missing.value.complaints[0].help == "write `problems/hw9/set.yaml` with `problems: [block]`"


def test_a_set_says_how_much_its_solutions_tell_of_their_checks(tmp_path: Path) -> None:
    root = tmp_path
    file = at(root) / "problems" / "hw9" / "set.yaml"
    text = "course: Physics 311\ntitle: Homework 9\nproblems: [block]\n"
    told = {}
    for line in ("", "evidence: end\n"):
        file.write_text(text + line, encoding="utf-8")
        told[line] = str(problem_set(root, "hw9").evidence)
    assert told == {"": "none", "evidence: end\n": "end"}
    file.write_text(text + "evidence: below\n", encoding="utf-8")
    with pytest.raises(Rejected) as refused:
        problem_set(root, "hw9")
    assert refused.value.complaints[0].message == "`evidence` must be none, end or margin, but it is `below`"


def test_one_problem_is_found_where_the_list_of_all_has_it(tmp_path: Path) -> None:
    top = tmp_path / "problems"
    for name in ("hw1/one", "hw1/topic/two", "hw1/one/one", "hw1/a/two", "hw1/b c/three", "hw1/x/y/four", "hw1/set"):
        (top / name).parent.mkdir(parents=True, exist_ok=True)
        (top / f"{name}.yaml").write_text("")
    listed = problem_paths(tmp_path)
    assert len(listed) == 2
    for name in (*listed, *["hw1/three", "hw1/four", "hw1/set", "hw1/no", "hw2/one", "hw1", "hw1/*", "../hw1/one"]):
        assert found_path(tmp_path, name) == listed.get(name)
