"""Tests of the positions and the descriptions of drawings on a page."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from derive.errors import Rejected
from derive.render.rendered import Rendered
from tests.courses import ROOT, course_in, rendered_once

CAPTION = "  vectors:\n"
WORDS = (
    "caption: <<spin>> and <<angular_momentum>> in their true directions, seen obliquely; "
    "their lengths have no common scale."
)
CUBE = {"[a, 2*a, 3*a]": "[a, a, a]"}


def drawings(solved: Rendered) -> dict[str, dict]:
    return {drawing["key"]: drawing for drawing in json.loads(solved.texts["json"])["drawings"]}


def faults(folder: Path, edits: dict[str, str] | None = None, script: dict[str, str] | None = None) -> list[str]:
    with pytest.raises(Rejected) as caught:
        rendered_once(course_in(folder, edits, script), "hw9/block", only={"text"})
    return [complaint.shown() for complaint in caught.value.complaints]


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> Rendered:
    return rendered_once(course_in(tmp_path_factory.mktemp("block")), "hw9/block", draws=True)


# --- words -----------------------------------------------------------------------------------------------------------


def test_the_contract_says_where_each_drawing_stands_and_what_it_shows(block: Rendered) -> None:
    found = drawings(block)
    assert list(found) == ["axes", "vectors"]
    assert (found["axes"]["at"], found["vectors"]["at"]) == ("statement", "c")
    assert found["vectors"]["files"] == ["block-vectors.pdf", "block-vectors.svg"]
    assert found["axes"]["number"] is None, "only drawings with a caption are numbered"
    assert found["vectors"]["number"] == 1
    assert "true directions" in found["vectors"]["caption"]


def test_the_words_are_made_of_the_derived_values(block: Rendered) -> None:
    told = drawings(block)["vectors"]["alt"]
    assert "edges a, 2a and 3a" in told
    assert "ω⃗ along (1, 2, 3)" in told
    assert "L⃗ along (13, 20, 15)" in told
    assert "the angle θ of 21.6°" in told


def test_a_body_that_is_dashed_at_other_values_of_several_coordinates_is_described_without_them() -> None:
    ball = rendered_once(ROOT, "library/cue_ball")
    assert "a ball dashed, the angle φ" in drawings(ball)["system"]["alt"]


def test_a_caption_may_mention_the_letters_beside_the_marks(tmp_path: Path) -> None:
    cone = rendered_once(ROOT, "hw9/cone")
    assert "its centre of mass C, and a slice" in drawings(cone)["from_apex"]["caption"]
    (fault,) = faults(tmp_path / "block", {"true directions": "true <<C>> directions"})
    assert "nothing on this page is called `C`" in fault, "the drawing has no mark of that name"


def test_a_terminal_shows_the_words_in_the_place_of_the_drawing(block: Rendered) -> None:
    text = " ".join(block.texts["text"].split())
    assert text.index("[figure: A drawing in space of a block") < text.index("(a) Find")
    assert text.index("(c) Find") < text.index("[figure: A drawing in space of a block", 400) < text.index("(d) What")
    assert "Figure 1. ω⃗ and L⃗ in their true directions" in text


def test_the_words_follow_the_given(tmp_path: Path) -> None:
    told = drawings(rendered_once(course_in(tmp_path, CUBE), "hw9/block", only={"json"}))["vectors"]["alt"]
    assert "edges a, a and a" in told
    assert "ω⃗ along (1, 1, 1)" in told
    assert "L⃗ along (1, 1, 1)" in told
    assert "θ" not in told, "there is no angle to see"


def test_a_negative_rate_reverses_the_vectors(tmp_path: Path) -> None:
    told = drawings(rendered_once(course_in(tmp_path, {"rate: omega": "rate: -omega"}), "hw9/block", only={"json"}))[
        "vectors"
    ]["alt"]
    assert "ω⃗ along (-1, -2, -3)" in told
    assert "the angle θ of 21.6°" in told


def test_no_number_is_told_that_depends_on_letters(tmp_path: Path) -> None:
    edits = {"[a, 2*a, 3*a]": "[a, b, c]", "{a: length,": "{a: length, b: length, c: length,"}
    told = drawings(rendered_once(course_in(tmp_path, edits), "hw9/block", only={"json"}))["vectors"]["alt"]
    assert "the angle θ" in told
    assert "°" not in told


def test_prose_may_point_at_a_drawing_by_its_number(tmp_path: Path) -> None:
    edits = {"ask: Find the angle between": "ask: In <<figure vectors>>, find the angle between"}
    assert (
        "(c) In Figure 1, find" in rendered_once(course_in(tmp_path, edits), "hw9/block", only={"text"}).texts["text"]
    )


def test_prose_cannot_point_at_a_drawing_without_a_number(tmp_path: Path) -> None:
    edits = {WORDS: "at: c", "ask: Find the angle between": "ask: In <<figure axes>>, find the angle between"}
    (fault,) = faults(tmp_path, edits)
    assert "error[undefined-name]: no drawing with a caption is called `axes`" in fault
    assert "help: use the name of a drawing, and write its `caption:` under `drawings:`" in fault


# --- places ----------------------------------------------------------------------------------------------------------


def test_a_drawing_stands_where_all_that_it_shows_is_derived(tmp_path: Path) -> None:
    assert drawings(rendered_once(course_in(tmp_path), "hw9/block", only={"json"}))["vectors"]["at"] == "c"


def test_a_drawing_may_stand_later_or_not_at_all(tmp_path: Path) -> None:
    for where, keys in (("d", ["axes", "vectors"]), ("hidden", ["axes"])):
        folder = tmp_path / where
        folder.mkdir()
        assert (
            list(
                drawings(
                    rendered_once(
                        course_in(folder, {CAPTION: CAPTION + f"    at: {where}\n"}), "hw9/block", only={"json"}
                    )
                )
            )
            == keys
        )


@pytest.mark.parametrize(("where", "told"), [("statement", "in the statement"), ("b", "in part b")])
def test_a_drawing_does_not_give_an_answer_away(tmp_path: Path, where: str, told: str) -> None:
    (fault,) = faults(tmp_path, {CAPTION: CAPTION + f"    at: {where}\n"})
    assert fault.startswith("problems/hw9/block.yaml:35:9: error[drawing]: ")
    assert told in fault
    assert "would show `" in fault
    assert "help: write `at: c`, the part that derives" in fault


WITHOUT_THE_ANGLE = {
    "  - ask: Find the angle between <<spin>> and the angular momentum <<angular_momentum>>.\n"
    "    answer: [cosine, angle_between]\n": "  - ask: Find it.\n    answer: [angular_momentum]\n",
    "    form:\n      cosine: {figures: 5}\n      angle_between: {unit: degree, figures: 4}\n": "",
}


def test_a_drawing_of_what_no_part_asks_for_is_left_out(tmp_path: Path) -> None:
    assert "vectors" not in drawings(rendered_once(course_in(tmp_path, WITHOUT_THE_ANGLE), "hw9/block", only={"json"}))


def test_a_drawing_of_what_no_part_asks_for_that_is_given_a_place_is_told(tmp_path: Path) -> None:
    (fault,) = faults(tmp_path, {**WITHOUT_THE_ANGLE, CAPTION: CAPTION + "    at: c\n"})
    assert "the drawing `vectors` shows `angle_between`, on which no answer depends" in fault


def test_a_drawing_may_stand_with_the_step_that_a_part_asks_for(tmp_path: Path) -> None:
    placed = rendered_once(course_in(tmp_path, {CAPTION: CAPTION + "    at: magnitude\n"}), "hw9/block")
    text = placed.texts["text"]
    assert drawings(placed)["vectors"]["at"] == "d"
    assert text.index("|τ⃗| = ") < text.index("Figure 1. ")


def test_a_step_that_there_is_none_of_is_told(tmp_path: Path) -> None:
    (fault,) = faults(tmp_path, {CAPTION: CAPTION + "    at: torqe\n"})
    assert "error[undefined-name]: no step of this problem is called `torqe`" in fault
    assert "did you mean `torque`?" in fault


def test_faults_of_a_placement_are_told_together(tmp_path: Path) -> None:
    found = faults(
        tmp_path, {CAPTION: CAPTION + "    at: e\n    width: 40 cm\n    colour: red\n    values: {a: 1 s}\n"}
    )
    assert ["error[unknown-key]" in f or "error[wrong-type]" in f for f in found].count(True) == 2
    assert any("`width` must be from 1 to 15 cm" in fault for fault in found)
    assert any("`a` must be a length" in fault for fault in found)
    assert len(found) == 4


def test_a_name_that_the_script_does_not_draw_is_told_with_the_nearest(tmp_path: Path) -> None:
    (fault,) = faults(tmp_path, {"  vectors:\n": "  vektors:\n"})
    assert "error[unknown-drawing]: the script draws nothing called `vektors`" in fault
    assert "help: did you mean `vectors`?" in fault


def test_a_letter_that_the_drawing_lacks_is_told(tmp_path: Path) -> None:
    (fault,) = faults(tmp_path, {CAPTION: CAPTION + "    values: {theta: 40 deg}\n"})
    assert "error[unknown-letter]: the drawing `vectors` has no symbol `theta`" in fault


def test_what_cannot_be_drawn_is_told_at_the_line_of_the_script(tmp_path: Path) -> None:
    (fault,) = faults(tmp_path, script={"vectors_in(block, omega, L, ": "vectors_in(block, T, L, "})
    assert fault.startswith("problems/hw9/block.py:")
    assert "a drawing needs a vector or a place here, but `kinetic_energy` is not one" in fault


def test_the_page_of_tex_names_the_files_and_says_what_they_show(block: Rendered) -> None:
    assert r"{block-vectors.pdf}{A drawing in space of a block" in block.latex
    assert block.latex.count(r"\drawingbeside{") == 1
    assert block.latex.count(r"\beside{") == 1


def test_a_value_for_a_letter_that_the_drawing_no_longer_has_is_told_as_a_warning(tmp_path: Path) -> None:
    """`a` is a symbol of the problem, but the drawing does not contain it if the sides are numbers."""
    edits = {
        "[a, 2*a, 3*a]": "[b, b, b]",
        "a: length": "a: length, b: length",
        CAPTION: CAPTION + "    values: {a: 2 cm}\n",
    }
    found = rendered_once(course_in(tmp_path, edits), "hw9/block", only=()).warnings
    assert [w.code for w in found] == ["unused-letter"]


def test_a_caption_does_not_repeat_the_extrema_that_the_plot_shows(tmp_path: Path) -> None:
    found = drawings(rendered_once(ROOT, "library/rod_on_shaft", only={"json"}))
    assert found["system"]["number"] == 1 and found["energy"]["number"] == 2
    assert "minimum" not in found["energy"]["caption"] and "minimum" in found["energy"]["alt"]
    assert found["energy"]["caption"].endswith("Drawn for l = 1 m and g = 9.8 m/s^2."), "U/(m g l) does not depend on m"
