"""Standard moments of inertia: quoted on the page, but derived and checked like every result."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.building.solution import rendered
from derive.errors import DeriveError
from derive.mechanics.rotation import claims
from derive.mechanics.rotation.inertia import STANDARD
from tests.courses import ROOT
from tests.stock.described import complaints, course_with, edited, solved

DISC = (ROOT / "problems" / "library" / "rolling" / "disc_incline.yaml").read_text(encoding="utf-8")
CONE = (ROOT / "problems" / "library" / "rolling" / "rolling_cone.yaml").read_text(encoding="utf-8")
DERIVED = edited(DISC, ("shape: disc", "derive: true, shape: disc"))


def page(folder: Path, text: str) -> str:
    return rendered(course_with(folder, text), "trial/one", only={"text"}).texts["text"]


def test_a_page_quotes_the_moment_of_a_disc(tmp_path: Path) -> None:
    text = page(tmp_path, DISC)
    assert "The moment of inertia of a uniform disc about its axis is" in text and "∫" not in text and "σ" not in text
    evidence = {each.claim for each in solved(tmp_path, DISC)["moment_of_inertia"].step.evidence}
    assert "particles" in evidence


RODS = """title: Two rods
solve: system
symbols: {m: mass, l: length, g: acceleration}
given:
  coordinates: {theta: angle, phi: angle}
  bodies:
    upper: {shape: rod, length: l, mass: m, from: [0, 0], along: [sin(theta), -cos(theta)]}
    middle: {shape: rod, length: l, mass: m, from: upper.far_end, along: [sin(phi), -cos(phi)]}
    lower: {shape: rod, length: l, mass: m, from: upper.far_end, along: [sin(phi), -cos(phi)]}
  gravity: g
statement: Two rods.
parts:
  - {ask: Find the kinetic energy., answer: kinetic_energy}
"""


def test_a_moment_that_was_quoted_is_not_quoted_again(tmp_path: Path) -> None:
    text = " ".join(page(tmp_path, RODS).split())
    assert text.count("uniform rod about its centre") == 1
    assert "and that of a uniform rod about its centre is I_middle" in text
    assert "and likewise I_lower = 1/12 m l²" in text


def test_an_author_can_ask_for_the_integral(tmp_path: Path) -> None:
    text = page(tmp_path, DERIVED)
    assert "∫" in text and "where σ = M/(π R²)" in text


def test_a_wrong_entry_of_the_table_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(
        claims._TABLE, "disc_about_its_axis", ("centre", "z", lambda radius: radius**2)
    )  # that of a hoop
    with pytest.raises(DeriveError, match="could not be confirmed"):
        solved(tmp_path, DISC)


def test_each_standard_moment_is_in_the_table() -> None:
    assert set(STANDARD.values()) == set(claims._TABLE)


def test_the_key_has_an_effect_only_on_a_standard_shape(tmp_path: Path) -> None:
    text = edited(CONE, ("shape: cone", "derive: true, shape: cone"))
    assert any("`derive` has no effect" in each.message for each in complaints(tmp_path, text))


CLOCK = (ROOT / "problems" / "library" / "bodies" / "clock_pendulum.yaml").read_text(encoding="utf-8")


def test_the_moments_of_parts_are_quoted_too_unless_the_author_asks_for_the_integral(tmp_path: Path) -> None:
    text = page(tmp_path, CLOCK)
    assert "The moment of inertia of a uniform rod about its centre is" in text and "∫" not in text
    one = page(tmp_path / "one", edited(CLOCK, ("shape: disc, radius", "derive: true, shape: disc, radius")))
    assert "λ" not in one and "where σ_disc = M/(π R²)" in one


def test_the_key_has_an_effect_only_on_a_standard_part(tmp_path: Path) -> None:
    text = edited(CLOCK, ("{shape: disc, radius: R,", "{shape: cone, radius: R, height: R, derive: true,"))
    assert any("`derive` has no effect" in each.message for each in complaints(tmp_path, text))


def test_a_fraction_has_no_fraction_in_its_numerator(tmp_path: Path) -> None:
    assert "(M + m/2)" not in page(tmp_path, CLOCK)
