"""What a document states, as it is written: groups, letters, figures and units, and what is none of these."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.course.problem import load_problem
from derive.course.reference.statements import Entry, stated_groups
from derive.errors import Rejected
from tests.course.reference.stated import HEAD, PRINTED, Compared
from tests.courses import ROOT, course_in

GOLDEN = ROOT / "tests" / "complaints" / "reference"
BAD = sorted(file.stem for file in GOLDEN.glob("*.yaml"))


def test_two_letters_of_the_document_are_not_one_of_ours(compared: Compared) -> None:
    """Else I_1 - I_2 would be zero."""
    with pytest.raises(Rejected) as refused:
        compared(whole=PRINTED.replace("I_2: I_yy", "I_2: I_xx") + "    - {answer: cosine, latex: '1'}\n")
    (complaint,) = refused.value.complaints
    assert complaint.code == "letter-clash"
    assert complaint.message == "`I_1` and `I_2` both stand for `I_xx`, so one could be taken for the other"


@pytest.mark.parametrize("name", BAD)
def test_a_bad_reference_is_told_in_the_words_on_record(compared: Compared, name: str) -> None:
    with pytest.raises(Rejected) as caught:
        compared(whole=(GOLDEN / f"{name}.yaml").read_text(encoding="utf-8"))
    assert f"{caught.value}\n" == (GOLDEN / f"{name}.txt").read_text(encoding="utf-8")


def test_every_text_on_record_has_its_bad_reference() -> None:
    assert sorted(file.stem for file in GOLDEN.glob("*.txt")) == BAD


def test_faults_about_another_problem_are_told_when_that_is_derived(compared: Compared, tmp_path: Path) -> None:
    (tmp_path / "problems" / "hw9" / "cone.yaml").touch()
    assert compared(whole="- {problem: cone, given: {}, entries: nonsense}\n") == ()


def stated(folder: Path, *entries: str, head: str = HEAD) -> list[Entry]:
    root = course_in(folder)
    text = head + "".join(f"    - {{{entry}}}\n" for entry in entries)
    (root / "problems" / "hw9" / "reference.yaml").write_text(text, encoding="utf-8")
    ((_, found),) = stated_groups(load_problem(root, "hw9/block"))
    return found


def test_a_value_keeps_its_shape_its_dimensions_and_how_it_was_written(tmp_path: Path) -> None:
    scalar, vector, tensor = stated(
        tmp_path, "answer: x, states: M*a", "answer: y, states: [a, 2*a, 0]",
        "answer: z, states: [[M, 0, 0], [0, M, 0], [0, 0, M]]",
    )  # fmt: skip
    shapes = [entry.states.sides[0].shape for entry in (scalar, vector, tensor)]
    assert shapes == [(), (3, 1), (3, 3)]
    assert [len(entry.states.sides[0].entries) for entry in (scalar, vector, tensor)] == [1, 3, 9]
    ((_, dimension),) = scalar.states.sides[0].entries
    assert (dimension.mass, dimension.length, vector.states.text) == (1, 1, "[a, 2*a, 0]")


def test_no_more_is_assumed_of_a_letter_than_that_it_is_real(tmp_path: Path) -> None:
    (entry,) = stated(tmp_path, "answer: x, states: M*a")
    assert {(letter.name, letter.is_real, letter.is_positive) for letter in entry.states.letters} == {
        ("M", True, None),
        ("a", True, None),
    }


def test_a_chain_has_a_side_for_each_value_and_a_branch_for_each_sign(tmp_path: Path) -> None:
    chain, signs = stated(tmp_path, r"answer: x, latex: 'M = 2 M = 3 M'", r"answer: y, latex: '\pm a'")
    assert ([side.text for side in chain.states.sides], chain.states.marks) == (["M", "2 M", "3 M"], ("", "=", "="))
    assert len(signs.states.sides[0].branches) == 2


def test_figures_are_of_all_entries_or_of_each(tmp_path: Path) -> None:
    found = stated(tmp_path, "answer: x, states: 1, to: 4", "answer: y, states: [1, 2, 3], to: [4, 4, 3]")
    assert [entry.figures for entry in found] == [(4,), (4, 4, 3)]
    with pytest.raises(Rejected, match="`to` has 2 numbers, but the value has 3 entries"):
        stated(tmp_path / "odd", "answer: y, states: [1, 2, 3], to: [4, 4]")


def test_only_a_letter_with_a_number_has_it_put_in(tmp_path: Path) -> None:
    head = HEAD.replace("  entries:\n", "  values: {a: 10 cm}\n  entries:\n")
    (entry,) = stated(tmp_path, "answer: x, states: M, with: [a]", head=head)
    assert entry.put_in == ("a",)
    with pytest.raises(Rejected, match="`M` has no number to substitute"):
        stated(tmp_path / "odd", "answer: x, states: M, with: M", head=head)


def test_what_states_nothing_or_in_two_notations_is_refused(tmp_path: Path) -> None:
    with pytest.raises(Rejected) as caught:
        stated(tmp_path, "answer: x", "answer: y, states: 1, latex: '1'", "answer: z, states: [1, 2]")
    assert [complaint.code for complaint in caught.value.complaints] == ["missing-key", "two-values", "wrong-length"]


def test_a_set_without_a_reference_states_nothing(tmp_path: Path) -> None:
    assert stated_groups(load_problem(course_in(tmp_path), "hw9/block")) == []
