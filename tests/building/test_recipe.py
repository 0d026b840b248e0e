"""How pages are made: every template and file of phrases by its name, modules, packages, options."""

from __future__ import annotations

import os
import time
from pathlib import Path

from derive.building.cache import PACKAGES
from derive.building.recipe import DETAIL, EVIDENCE, MODULES, OWN, edited_since, recipe_digest, recipe_of


def test_each_ingredient_has_its_name(tmp_path: Path) -> None:
    (tmp_path / "templates" / "latex").mkdir(parents=True)
    (tmp_path / "templates" / "latex" / "set.tex.j2").write_text("one")
    found = recipe_of(tmp_path, "full", "none")
    assert {MODULES, DETAIL, EVIDENCE, *PACKAGES, "templates/latex/set.tex.j2"} <= found.keys()
    assert any(name.startswith(f"{OWN}/phrases/en/") for name in found)
    assert (found[DETAIL], found[EVIDENCE]) == ("full", "none")


def test_a_template_written_since_then_counts_whatever_its_text_and_its_date(tmp_path: Path) -> None:
    file = tmp_path / "templates" / "latex" / "set.tex.j2"
    file.parent.mkdir(parents=True)
    file.write_text("one")
    time.sleep(0.02)
    began = time.time_ns()
    assert not edited_since(tmp_path, began)
    time.sleep(0.02)
    file.write_text("one")
    os.utime(file, (0, 0))
    assert edited_since(tmp_path, began)


def test_an_edit_changes_one_ingredient_and_the_digest(tmp_path: Path) -> None:
    file = tmp_path / "templates" / "own.j2"
    file.parent.mkdir()
    file.write_text("one")
    before = recipe_of(tmp_path, None, "none")
    file.write_text("two")
    after = recipe_of(tmp_path, None, "none")
    assert {name for name in before if before[name] != after[name]} == {"templates/own.j2"}
    assert recipe_digest(before) != recipe_digest(after)
    assert recipe_digest(before) == recipe_digest(dict(reversed(before.items())))
