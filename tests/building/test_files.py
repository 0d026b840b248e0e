"""Files are written whole or not at all, and what the disk refuses is one complaint."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from derive.building.files import folder, of_system, shown_path, write
from derive.errors import BuildFailed


def test_a_full_disk_leaves_the_earlier_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "page.pdf"
    write(target, "before")

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    monkeypatch.chdir(tmp_path)
    with pytest.raises(BuildFailed, match=r"error\[cannot-write\]: cannot write `page.pdf`: the disk is full"):
        write(target, "after")
    assert [(p.name, p.read_text()) for p in tmp_path.iterdir()] == [("page.pdf", "before")]


def test_a_file_is_written_only_if_its_content_changes(tmp_path: Path) -> None:
    target = tmp_path / "new" / "page.txt"
    assert write(target, "ω")
    os.utime(target, (0, 0))
    assert not write(target, "ω".encode())
    assert target.stat().st_mtime == 0
    assert write(target, "other")
    assert target.read_text() == "other"


def test_a_written_file_has_the_permissions_of_any_other(tmp_path: Path) -> None:
    before = os.umask(0o027)
    try:
        write(tmp_path / "page.txt", "1")
    finally:
        os.umask(before)
    assert (tmp_path / "page.txt").stat().st_mode & 0o777 == 0o640


def test_a_link_and_a_pipe_are_replaced_and_not_written_through(tmp_path: Path) -> None:
    (tmp_path / "victim").write_text("mine")
    (tmp_path / "link").symlink_to("victim")
    os.mkfifo(tmp_path / "pipe")
    for name in ("link", "pipe"):
        assert write(tmp_path / name, "ours")
        assert (tmp_path / name).read_text() == "ours"
    assert (tmp_path / "victim").read_text() == "mine"


def test_what_stands_in_the_way_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("")
    (tmp_path / "page.txt").mkdir()
    with pytest.raises(BuildFailed, match=r"cannot write `page\.txt`: a folder is where a file should be"):
        write(tmp_path / "page.txt", "1")
    with pytest.raises(BuildFailed, match="cannot write `file`: a file is where a folder should be"):
        folder(tmp_path / "file")
    assert {path.name for path in tmp_path.iterdir()} == {"file", "page.txt"}, "nothing half written is left"


def test_a_path_is_shown_as_the_user_would_write_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    assert shown_path(tmp_path / "here" / "build" / "x.pdf") == "build/x.pdf"
    assert shown_path(tmp_path / "x.pdf") == str(tmp_path / "x.pdf")
    (tmp_path / "here").rmdir()
    assert shown_path(tmp_path / "x.pdf") == str(tmp_path / "x.pdf")


def test_only_what_the_system_is_short_of_is_a_complaint_of_the_system() -> None:
    assert "too many files are open" in str(of_system(OSError(24, "x")))
    assert "cannot start a process: memory is short" in str(of_system(OSError(12, "x"), "cannot start a process"))
    assert of_system(OSError(2, "no such file")) is None
