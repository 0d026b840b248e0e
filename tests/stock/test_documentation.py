"""What parts may ask for stands in the documentation."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from derive.steps.record import recorded
from derive.stock import body, rotation
from derive.stock.answering import of_systems
from tests.courses import ROOT
from tests.stock.described import PENDULUM, loaded

TEXT = (ROOT / "docs" / "yaml-alone.md").read_text(encoding="utf-8")


def section(name: str) -> set[str]:
    """The words in code of one section."""
    found = TEXT.split(f"\n## `{name}`")[1].split("\n## ")[0]
    return set(re.findall(r"`([a-z_]+)`", found))


def without_axes(name: str) -> str:
    """One axis stands for the others, and one pair of axes too."""
    return re.sub(r"_(xx|xy|xz|yy|yz|zz)$", "_xy", re.sub(r"_[xyz]$", "_z", name))


@pytest.mark.parametrize(("name", "module"), [("body", body), ("rotation", rotation)])
def test_the_asks_of_bodies_and_rotations_are_documented(name: str, module: Any) -> None:
    nothing: Any = rotation.DescribedRotation() if name == "rotation" else body.Asked(body.DescribedBody("", (), True))
    asks = {without_axes(ask) for ask in module.Answers(nothing).asks()}
    assert asks <= section(name), asks - section(name)


def test_the_asks_of_systems_are_documented(tmp_path: Path) -> None:
    described: Any = loaded(tmp_path, PENDULUM).described
    with recorded():
        found = of_systems.Answers(described).asks()
    asks = {ask.replace("acceleration_theta", "acceleration_x").replace("d_theta", "d_phi") for ask in found}
    assert asks <= section("system"), asks - section("system")
