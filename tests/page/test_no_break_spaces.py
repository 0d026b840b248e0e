"""Numbers and their units in running text."""

import pytest

from derive.page.no_break_spaces import unbroken
from derive.page.wording import Text
from derive.render.notation.latex import escaped


@pytest.mark.parametrize(
    ("written", "printed"),
    [
        ("a rod of 10 cm and 3.0 rad/s", "a rod of 10\u00a0cm and 3.0\u00a0rad/s"),
        ("a torque of 3 N m acts", "a torque of 3\u00a0N\u00a0m acts"),
        ("in about 433 days", "in about 433\u00a0days"),
        ("1.7 % longer", "1.7% longer"),
        ("the 2 masses in 3 seasons", "the 2 masses in 3 seasons"),
        ("equation 2 in part 3", "equation 2 in part 3"),
    ],
)
def test_a_number_keeps_its_unit(written, printed):
    assert unbroken(written) == printed


def test_every_text_of_a_page_is_unbroken():
    assert Text("10 cm").text == "10\u00a0cm"


def test_tex_has_a_tie_between_number_and_unit():
    assert escaped(Text("10 cm").text) == "10{~}cm"
