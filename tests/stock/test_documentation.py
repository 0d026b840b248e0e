"""What parts may ask for stands in the documentation."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from derive.steps.record import recorded
from derive.stock import body, rotation
from derive.stock.answering.answers import Answers
from derive.stock.system import SystemAnswers
from tests.courses import ROOT
from tests.stock.described import PENDULUM, loaded

TEXT = (ROOT / "docs" / "yaml-alone.md").read_text(encoding="utf-8")


def section(name: str) -> set[str]:
    found = TEXT.split(f"\n## `{name}`")[1].split("\n## ")[0]
    return set(re.findall(r"`([a-z_]+)`", found))


def without_axes(name: str) -> str:
    return re.sub(r"_(xx|xy|xz|yy|yz|zz)$", "_xy", re.sub(r"_[xyz]$", "_z", name))


@pytest.mark.parametrize(
    ("name", "answers"),
    [
        ("body", body.BodyAnswers(body.Asked(body.DescribedBody("", (), True)))),
        ("rotation", rotation.RotationAnswers(rotation.DescribedRotation())),
    ],
)
def test_the_asks_of_bodies_and_rotations_are_documented(name: str, answers: Answers[Any]) -> None:
    asks = {without_axes(ask) for ask in answers.asks()}
    assert asks <= section(name), asks - section(name)


def test_the_asks_of_systems_are_documented(tmp_path: Path) -> None:
    described: Any = loaded(tmp_path, PENDULUM).described
    with recorded():
        found = SystemAnswers(described).asks()
    asks = {ask.replace("acceleration_theta", "acceleration_x").replace("d_theta", "d_phi") for ask in found}
    assert asks <= section("system"), asks - section("system")
