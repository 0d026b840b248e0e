"""Where the answer of a command goes."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from derive.cli.output import check_output, deliver
from derive.errors import DeriveError, Misused
from derive.render.formats import WRITTEN


@pytest.mark.parametrize("output", [None, "-", "new.txt", "old.txt"])
def test_an_answer_may_go_where_nobody_wrote(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, output: str) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "old.txt").write_text("an answer of before")
    check_output(output, tmp_path)


@pytest.mark.parametrize(
    ("output", "why"),
    [
        ("", "`-o` needs the name of a file"),
        ("a\0b", "`-o` needs the name of a file"),
        ("notes.md", "`notes.md` is not replaced, because it may be written by hand"),
        ("problems/one.txt", "`problems/one.txt` is not replaced, because it may be written by hand"),
        ("problems", "`problems` is a folder"),
        ("linked.txt", "`linked.txt` is a link, and its target is not replaced"),
    ],
)
def test_what_somebody_wrote_is_not_replaced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, output: str, why: str
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "problems").mkdir()
    for name in ("notes.md", "problems/one.txt"):
        (tmp_path / name).write_text("mine")
    (tmp_path / "linked.txt").symlink_to("notes.md")
    with pytest.raises(Misused, match=re.escape(why)):
        check_output(output, tmp_path)


def test_a_file_is_written_and_a_folder_is_not(tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    deliver(b"answer", str(tmp_path / "new.txt"))
    deliver(b"answer", "-")
    assert (tmp_path / "new.txt").read_bytes() == capfdbinary.readouterr().out == b"answer"
    with pytest.raises(DeriveError):
        deliver(b"answer", str(tmp_path))


def test_a_page_that_derive_wrote_may_be_written_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("page.md").write_text(f"<!-- {WRITTEN} from problems/hw1/one.yaml -->\n\n# One\n")
    check_output("page.md", tmp_path)
    Path("page.md").write_text(f"# One\n\n{WRITTEN} by somebody\n")
    with pytest.raises(Misused, match="is not replaced, because it may be written by hand"):
        check_output("page.md", tmp_path)
