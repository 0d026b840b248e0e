"""On a page of several problems, the first problem that uses a theorem states it, and later problems refer to it."""

from __future__ import annotations

from derive.render.printing.theorems_once import theorem, told_in, told_once

AGAIN = f"For levers see {told_in('Problem')}."
LEVERS = f"<p>{theorem('levers', 'Levers balance.', AGAIN)}So this one does.</p>"
TOLD = "<p>Levers balance.</p>\n<p>So this one does.</p>"


def test_the_first_problem_tells_a_theorem_in_a_paragraph_of_its_own() -> None:
    assert told_once([("seesaw", "1", LEVERS)]) == [TOLD]


def test_later_ones_say_which_has_told_it_and_lead_there() -> None:
    plain, first, later = told_once(
        [("wheel", "1", "<p>It turns.</p>"), ("seesaw", "2", LEVERS), ("crane", "3", LEVERS)]
    )
    again = '<p>For levers see <a href="#seesaw">Problem 2</a>. So this one does.</p>'
    assert (plain, first, later) == ("<p>It turns.</p>", TOLD, again)


def test_each_theorem_has_its_own_first_problem() -> None:
    other = f"<p>{theorem('wheels', 'Wheels roll.', AGAIN)}</p>"
    _, later = told_once([("seesaw", "1", LEVERS), ("cart", "2", other + LEVERS)])
    assert later == '<p>Wheels roll.</p><p>For levers see <a href="#seesaw">Problem 1</a>. So this one does.</p>'


def test_what_a_theorem_says_is_no_pattern() -> None:
    odd = r"\1 \g<0>"
    assert told_once([("one", "1", f"<p>{theorem('odd', odd, 'again')}</p>")]) == [f"<p>{odd}</p>"]
