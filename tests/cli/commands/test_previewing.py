"""`derive preview`: what cannot be shown is told before a server begins."""

from __future__ import annotations

import socket
from pathlib import Path
from typing import Any

import pytest

from derive.cli.options import main
from derive.preview import preview as previewed
from derive.preview.worker_control import Shown
from tests.courses import course_in


@pytest.fixture(autouse=True)
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DERIVE_ROOT", str(course_in(tmp_path)))


def test_a_problem_that_there_is_not_is_wrong_usage(capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["preview", "hw9/blok"]) == 2
    assert "did you mean `hw9/block`?" in capfd.readouterr().err


def test_a_port_that_is_taken_is_told(capfd: pytest.CaptureFixture[str]) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        assert main(["preview", "hw9/block", "--port", str(taken.getsockname()[1])]) == 1
    assert "is taken" in capfd.readouterr().err


@pytest.mark.parametrize("port", ["-1", "70000", "web"])
def test_a_port_is_a_number_that_a_port_can_have(port: str, capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["preview", "hw9/block", "--port", port])
    assert "is not a port" in capfd.readouterr().err


@pytest.mark.parametrize(("options", "lines"), [((), 4), (("-q",), 3)])
def test_quiet_tells_the_address_and_what_is_wrong(
    options: tuple[str, ...], lines: int, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def shows_one_page_and_one_fault(*given: Any) -> None:
        *_, ready, told, _ = given
        ready("http://127.0.0.1:1/block.html")
        told("block", Shown(main="<main>"))
        told("top", Shown(complaints=("error[yaml]: no",)))

    monkeypatch.setattr(previewed, "preview", shows_one_page_and_one_fault)
    assert main(["preview", "hw9/block", *options]) == 0
    said = capfd.readouterr().out.splitlines()
    assert (len(said), said[0][:4], said[-1]) == (lines, "http", "error[yaml]: no")
    assert said[-2] == "hw9/top: not shown (0.00 s)"
