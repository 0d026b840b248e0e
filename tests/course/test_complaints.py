"""Golden complaints: each bad problem in `complaints/` is told in exactly the words of the text beside it."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from derive.building.solution import rendered
from derive.errors import DeriveError
from tests.courses import ROOT

FOLDER = Path(__file__).parents[1] / "complaints"
BAD = sorted(file.stem for file in FOLDER.glob("*.yaml"))


def complaint_of(name: str, root: Path) -> str:
    folder = root / "problems" / "hw9"
    folder.mkdir(parents=True)
    shutil.copy(FOLDER / f"{name}.yaml", folder)
    (root / "templates").symlink_to(ROOT / "templates")
    for script in FOLDER.glob("*.py"):
        shutil.copy(script, folder)
    # Not Python, and so not named as Python where the linters look.
    (folder / "script_syntax.py").write_text("def solve(sides):\n    return (sides\n")
    with pytest.raises(DeriveError) as caught:
        rendered(root, f"hw9/{name}")
    assert caught.value.exit_code == 1
    return f"{caught.value}\n"


def test_each_bad_file_is_told_in_the_words_on_record(tmp_path: Path) -> None:
    told = {name: complaint_of(name, tmp_path / name) for name in BAD}
    assert told == {name: (FOLDER / f"{name}.txt").read_text(encoding="utf-8") for name in BAD}


def test_every_text_on_record_has_its_bad_file() -> None:
    assert sorted(file.stem for file in FOLDER.glob("*.txt")) == BAD


def test_no_complaint_begins_with_a_capital_or_ends_with_a_full_stop() -> None:
    for file in FOLDER.glob("*.txt"):
        for line in file.read_text(encoding="utf-8").splitlines():
            if ": error[" in line:
                message = line.partition("]: ")[2]
                assert not message[:1].isupper(), line
                assert not message.endswith("."), line
