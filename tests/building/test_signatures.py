"""Signed content is trusted only as what it was signed as, whole, and with the key of this machine."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from derive.building import signatures
from derive.building.cache import digest


def test_content_comes_back_only_as_what_it_was_signed_as(tmp_path: Path) -> None:
    signatures.write_signed(tmp_path / "block", "facts", b"1/2")
    assert signatures.read_signed(tmp_path / "block", "facts") == b"1/2"
    assert signatures.read_signed(tmp_path / "block", "other facts") is None
    assert signatures.read_signed(tmp_path / "top", "facts") is None
    signatures.write_signed(tmp_path / "block", "facts", b"")
    assert signatures.read_signed(tmp_path / "block", "facts") == b""


def test_where_what_it_is_ends_and_the_content_begins_is_signed_too(tmp_path: Path) -> None:
    signatures.write_signed(tmp_path / "block", "fact", b"s1/2")
    assert signatures.read_signed(tmp_path / "block", "facts") is None
    raw = (tmp_path / "block").read_bytes()
    (tmp_path / "block").write_bytes(raw[: signatures.SIGNATURE_BYTES] + raw[signatures.SIGNATURE_BYTES + 1 :])
    assert signatures.read_signed(tmp_path / "block", "facts") is None


def test_what_is_signed_without_the_key_is_not_trusted(tmp_path: Path) -> None:
    file = tmp_path / "block"
    signatures.write_signed(file, "facts", b"1/2")
    own = file.read_bytes()[: signatures.SIGNATURE_BYTES]
    for signature in (own, bytes.fromhex(digest("facts", b"7/2")), b"", bytes(signatures.SIGNATURE_BYTES)):
        file.write_bytes(signature + b"7/2")
        assert signatures.read_signed(file, "facts") is None


@pytest.mark.parametrize("raw", [b"", b"short", b"[]", bytes(1000)])
def test_a_file_of_any_other_content_is_none(tmp_path: Path, raw: bytes) -> None:
    (tmp_path / "block").write_bytes(raw)
    assert signatures.read_signed(tmp_path / "block", "facts") is None


def test_a_pipe_and_a_folder_are_neither_waited_for_nor_read(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "folder").mkdir()
    (tmp_path / "link").symlink_to("pipe")
    for name in ("pipe", "folder", "link"):
        assert signatures.read_signed(tmp_path / name, "facts") is None
        with pytest.raises(OSError, match=r"is not a file|Is a directory"):
            signatures.regular_content(tmp_path / name)


def test_a_file_above_the_limit_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "large").write_bytes(b"12345")
    assert signatures.regular_content(tmp_path / "large", 5) == b"12345"
    with pytest.raises(OSError, match="at most 4 bytes"):
        signatures.regular_content(tmp_path / "large", 4)


@pytest.mark.parametrize(
    ("content", "data"), [(None, None), (b"", None), (b"[1]", [1]), (b"[", None), (b"\xff", None), (b"[" * 10**6, None)]
)
def test_data_that_cannot_be_read_are_none(content: bytes | None, data: object) -> None:
    assert signatures.data_of(content) == data


def fresh_key(monkeypatch: pytest.MonkeyPatch, state: Path) -> Path:
    monkeypatch.setenv("XDG_STATE_HOME", str(state))
    signatures._key.cache_clear()
    return state / "derive" / "cache.key"


@pytest.fixture
def restored_key() -> Iterator[None]:
    yield
    signatures._key.cache_clear()


@pytest.mark.usefixtures("restored_key")
def test_the_key_is_the_users_alone_and_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = fresh_key(monkeypatch, tmp_path / "state")
    key = signatures._key()
    assert (file.read_bytes(), file.stat().st_mode & 0o777) == (key, 0o600)
    signatures._key.cache_clear()
    assert signatures._key() == key
    file.chmod(0o644)  # whoever read it could sign
    signatures._key.cache_clear()
    assert signatures._key() != key
    assert [path.name for path in file.parent.iterdir()] == ["cache.key"]


@pytest.mark.usefixtures("restored_key")
def test_a_key_that_is_a_link_or_cut_short_is_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = fresh_key(monkeypatch, tmp_path / "state")
    file.parent.mkdir(parents=True)
    (tmp_path / "known").write_bytes(bytes(signatures.KEY_BYTES))
    (tmp_path / "known").chmod(0o600)
    file.symlink_to(tmp_path / "known")
    assert signatures._key() != bytes(signatures.KEY_BYTES)
    assert not file.is_symlink()
    file.write_bytes(b"short")
    signatures._key.cache_clear()
    assert signatures._key() == file.read_bytes() != b"short"


@pytest.mark.usefixtures("restored_key")
def test_a_key_that_another_process_made_first_is_taken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = fresh_key(monkeypatch, tmp_path / "state")
    first = bytes(range(signatures.KEY_BYTES))

    def link(_: str, target: Path) -> None:
        target.write_bytes(first)
        target.chmod(0o600)
        raise FileExistsError(target)

    monkeypatch.setattr(os, "link", link)
    assert signatures._key() == first
    assert [path.name for path in file.parent.iterdir()] == ["cache.key"]


@pytest.mark.usefixtures("restored_key")
def test_without_a_place_for_the_key_nothing_kept_is_believed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "state").write_text("a file")
    fresh_key(monkeypatch, tmp_path / "state")
    signatures.write_signed(tmp_path / "kept", "facts", b"1")
    assert signatures.read_signed(tmp_path / "kept", "facts") == b"1"
    signatures._key.cache_clear()  # as in the next process
    assert signatures.read_signed(tmp_path / "kept", "facts") is None
