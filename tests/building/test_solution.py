"""The number of an answer has its unit: that of its kind, or else of its dimension."""

from __future__ import annotations

import json
from collections.abc import Collection
from pathlib import Path
from typing import Any

import pytest

from derive.building import solution
from derive.building.cache import Cache
from derive.building.solution import Rendered, rendered
from derive.errors import Complaint, Rejected
from tests.courses import course_in, rendered_once

SCRIPT = '''"""Numbers of a pendulum that are only named."""

from sympy import pi, sqrt

from derive.given import Acceleration, Length
from derive.mechanics import let


def solve(length: Length, gravity: Acceleration):
    return (
        let("period", lambda: 2 * pi * sqrt(length / gravity), symbol="T_0"),
        let("swinging", lambda: sqrt(gravity / length), symbol="w_0"),
        let("odd", lambda: sqrt(length) * gravity, symbol="q"),
        let("share", lambda: (length + 2 * length) / (5 * length), symbol="s"),
        let("square", lambda: length**2 * gravity**2, symbol="Q"),
    )
'''
PROBLEM = """title: A pendulum
solve: pendulum.py
given: {length: 1 m, gravity: 9.8 m/s^2}
statement: A pendulum.
parts:
  - ask: What are they?
    answer: [period, swinging, odd, share, square]
"""


def solved(folder: Path, form: str = "", only: Collection[str] | None = None) -> Rendered:
    problems = folder / "problems" / "set"
    problems.mkdir(parents=True)
    (problems / "pendulum.py").write_text(SCRIPT, encoding="utf-8")
    (problems / "pendulum.yaml").write_text(PROBLEM + form, encoding="utf-8")
    return rendered(folder, "set/pendulum", only=only)


def refused(folder: Path, form: str) -> Complaint:
    with pytest.raises(Rejected) as caught:
        solved(folder, f"    form: {form}\n")
    (complaint,) = caught.value.complaints
    return complaint


def test_steps_are_not_kept_if_their_script_was_edited_while_they_were_derived(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    solved(tmp_path)
    script, cache, derivations = tmp_path / "problems" / "set" / "pendulum.py", Cache(tmp_path / "kept"), []
    derive_it = solution.derived

    def derived_and_edited(*given: Any) -> Any:
        found = derive_it(*given)
        derivations.append(found)
        if len(derivations) == 1:
            script.write_text(script.read_text() + "# edited\n")
        return found

    monkeypatch.setattr(solution, "derived", derived_and_edited)
    for derived_so_far in (1, 2, 2):
        rendered(tmp_path, "set/pendulum", cache=cache)
        assert len(derivations) == derived_so_far


def test_a_number_that_is_only_named_has_the_unit_of_its_dimension(tmp_path: Path) -> None:
    solution = solved(tmp_path)
    units = {key: answer["number"]["unit"] for key, answer in json.loads(solution.texts["json"])["answers"].items()}
    assert units == {"period": "s", "swinging": "1/s", "odd": "m^(3/2)/s^2", "share": "", "square": "m^4/s^4"}
    assert r"\mathrm{m^{3/2}/s^{2}}" in solution.latex


@pytest.mark.parametrize("unit", ["rad/s", "rpm", "Hz"])
def test_a_number_that_is_only_named_is_in_no_unit_that_only_a_kind_has(unit: str, tmp_path: Path) -> None:
    complaint = refused(tmp_path, f"{{swinging: {{unit: {unit}}}}}")
    assert complaint.code == "wrong-unit"
    assert complaint.message == f"`swinging` has no kind, so `{unit}` is not allowed as its unit"
    assert complaint.help == "leave the unit out; in a script, you can give the result a `kind=` instead"


def test_a_unit_of_another_dimension_is_told_where_it_is_written(tmp_path: Path) -> None:
    complaint = refused(tmp_path, "{share: {unit: [m]}, period: {unit: s}}")
    assert complaint.message == "`share` is a number, which is not measured in `m`"
    assert complaint.place
    assert complaint.place.text[complaint.place.column - 1 :].startswith("m]")


def test_an_equation_of_motion_has_no_unit(tmp_path: Path) -> None:
    asked = UNIT_OF_THE_EQUATION.splitlines(keepends=True)[0]
    course_in(tmp_path, {asked: UNIT_OF_THE_EQUATION}, problem="slab")
    with pytest.raises(Rejected, match="is an equation between quantities that vary"):
        rendered_once(tmp_path, "hw9/slab")


UNIT_OF_THE_EQUATION = """\
    answer: [equation_of_motion, frequency, growth_rate]
    form: {equation_of_motion: {unit: [m/s^2]}}
"""


def test_a_letter_of_the_script_that_nobody_gave_is_refused_where_the_script_returns(tmp_path: Path) -> None:
    solved(tmp_path)
    script = tmp_path / "problems" / "set" / "pendulum.py"
    script.write_text(SCRIPT.replace("length / gravity", "Symbol('h') / gravity"), encoding="utf-8")
    script.write_text("from sympy import Symbol\n" + script.read_text(encoding="utf-8"), encoding="utf-8")
    with pytest.raises(Rejected) as caught:
        rendered(tmp_path, "set/pendulum")
    (complaint,) = caught.value.complaints
    assert complaint.code == "unknown-letter"
    assert complaint.message == "`period` contains h, which is neither given nor a coordinate"
    assert complaint.place and complaint.place.text.strip() == "return ("


@pytest.mark.parametrize(
    ("only", "texts", "typeset"), [((), set(), False), (["text"], {"text"}, False), (["pdf"], set(), True)]
)
def test_a_page_is_printed_in_the_formats_that_are_asked_for(
    tmp_path: Path, only: list[str], texts: set[str], typeset: bool
) -> None:
    solution = solved(tmp_path, only=only)
    assert set(solution.texts) == texts
    assert bool(solution.latex) == typeset
    assert solution.title == "A pendulum"
