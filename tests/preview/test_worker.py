"""The process that derives pages for a preview: an answer for each question, whatever a problem is like."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.preview.worker import answer
from derive.steps import establish
from tests.courses import course_in

ASKED = {"problem": "hw9/block", "detail": None, "limit": 60}


def test_the_answer_is_the_main_part_of_the_page(tmp_path: Path) -> None:
    main = answer(course_in(tmp_path), ASKED)["main"]
    assert '<h1 id="title">' in main and '<section id="part-a">' in main and "<html" not in main


def test_an_edit_of_words_is_in_the_next_answer(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    answer(root, ASKED)
    file = root / "problems" / "hw9" / "block.yaml"
    file.write_text(file.read_text().replace("A uniform block", "A homogeneous brick"))
    assert "A homogeneous brick" in answer(root, ASKED)["main"]


def test_an_edit_of_a_given_or_of_the_script_derives_only_what_it_touches(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    keys: list[str] = []
    add = establish.record.add
    monkeypatch.setattr(establish.record, "add", lambda q, case: (keys.append(q.key), add(q, case))[1])

    def derived_for(name: str, old: str, new: str) -> set[str]:
        file = root / "problems" / "hw9" / name
        file.write_text(file.read_text().replace(old, new))
        keys.clear()
        assert answer(root, ASKED)["main"]
        return set(keys)

    root = course_in(tmp_path)
    whole = derived_for("block.yaml", "A uniform block", "A homogeneous brick")
    assert {"inertia_tensor", "spin", "torque"} <= whole
    touched = derived_for("block.yaml", "axis: diagonal", "axis: [1, 1, 0]")
    assert "inertia_tensor" not in touched and {"spin", "torque"} <= touched
    touched = derived_for("block.py", "    return I,", '    size = magnitude(L, key="size")\n    return size, I,')
    assert "size" in touched and touched.isdisjoint({"inertia_tensor", "spin", "torque"})


def test_an_edit_of_a_module_beside_the_script_is_in_the_next_answer(tmp_path: Path) -> None:
    script = {"def solve(": "from helper import TIMES\n\n\ndef solve(", "spin(rate,": "spin(TIMES * rate,"}
    root = course_in(tmp_path, script=script)
    module = root / "problems" / "hw9" / "helper.py"
    module.write_text("TIMES = 5\n")
    before = answer(root, ASKED)["main"]
    module.write_text("TIMES = 7\n")
    after = answer(root, ASKED)["main"]
    assert "<mn>175</mn>" in before and "<mn>175</mn>" not in after  # 7/24 of the square of 5


def test_an_edit_of_what_the_set_or_a_document_says_is_in_the_next_answer(tmp_path: Path) -> None:
    root = course_in(tmp_path)
    before = answer(root, ASKED)["main"]
    heading = root / "problems" / "hw9" / "set.yaml"
    heading.write_text(heading.read_text() + "evidence: end\n")
    assert answer(root, ASKED)["main"] != before
    (root / "problems" / "hw9" / "reference.yaml").write_text("entries")
    (complaint,) = answer(root, ASKED)["complaints"]
    assert complaint.startswith("problems/hw9/reference.yaml:1:1: error")


def test_a_fault_is_told_with_its_place_and_not_raised(tmp_path: Path) -> None:
    said = answer(course_in(tmp_path, {"mass: M\n": "mass: a\n"}), ASKED)
    assert "main" not in said
    (complaint,) = said["complaints"]
    assert complaint.startswith("problems/hw9/block.yaml:") and "error[wrong-kind]" in complaint


def test_a_script_that_ends_its_program_does_not_end_the_worker(tmp_path: Path) -> None:
    root = course_in(tmp_path, script={"def solve(": "raise SystemExit(3)\n\n\ndef solve("})
    (complaint,) = answer(root, ASKED)["complaints"]
    assert "the script" in complaint or "SystemExit" in complaint
