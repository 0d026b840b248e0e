"""Faults: how one is shown, how many are collected, and which name was meant."""

from __future__ import annotations

import pickle

import pytest

from derive.errors import (
    BuildFailed,
    Complaint,
    DeriveError,
    Faults,
    Misused,
    Place,
    Rejected,
    did_you_mean,
    nearest,
    rejected,
)


def test_a_fault_is_shown_with_its_line_a_caret_and_what_to_do() -> None:
    place = Place("a.yaml", 12, 9, "  mass: a\n", 1)
    fault = Complaint("wrong-kind", "`mass` must be a mass", place, ("why",), "fix it")
    assert fault.shown().splitlines() == [
        "a.yaml:12:9: error[wrong-kind]: `mass` must be a mass",
        "  12 |   mass: a",
        "     |         ^",
        "     = why",
        "     = help: fix it",
    ]


def test_a_fault_without_a_place_or_of_an_empty_line_has_no_caret() -> None:
    assert Complaint("x", "y", severity="warning").shown() == "warning[x]: y"
    assert Complaint("x", "y", Place("a", 1, 1, " \n")).shown() == "a:1:1: error[x]: y"


def test_the_caret_stands_under_a_tab_and_in_a_piece_of_a_long_line() -> None:
    assert Complaint("x", "y", Place("a", 1, 2, "\tb", 1)).shown().splitlines()[1:] == ["  1 |  b", "    |  ^"]
    cut = Complaint("x", "y", Place("a", 1, 1002, "abc", 2, cut=1000)).shown().splitlines()
    assert cut[2] == "    |  ^^"


@pytest.mark.parametrize(("kind", "code"), [(Rejected, 1), (BuildFailed, 1), (Misused, 2)])
def test_an_error_crosses_from_a_worker_to_its_parent_unchanged(kind: type[DeriveError], code: int) -> None:
    error = kind([Complaint("x", "one"), Complaint("y", "two", Place("a", 1))])
    back = pickle.loads(pickle.dumps(error))
    assert (type(back), back.complaints, back.exit_code) == (kind, error.complaints, code)
    assert str(back) == "error[x]: one\na:1:1: error[y]: two"


def test_faults_are_told_once_and_in_the_order_of_the_file() -> None:
    faults = Faults([Complaint("x", "no place")])
    for line in (3, 1, 3):
        faults.error("y", "there", Place("a", line))
    with faults:
        rejected("z", "kept, and what follows goes on", Place("a", 2))
    with pytest.raises(Rejected) as caught:
        faults.stop()
    assert [(c.code, c.place.line if c.place else 0) for c in caught.value.complaints] == [
        ("x", 0),
        ("y", 1),
        ("z", 2),
        ("y", 3),
    ]


def test_no_fault_stops_nothing_and_only_a_rejection_is_kept() -> None:
    faults = Faults()
    faults.stop()
    assert not faults
    with pytest.raises(BuildFailed), faults:
        raise BuildFailed(Complaint("x", "the disk is full"))
    assert not faults


@pytest.mark.parametrize(
    ("name", "meant"),
    [("torqe", "torque"), ("TORQUE", "torque"), ("mas", "mass"), ("zebra", None), ("", None), ("must", None)],
)
def test_the_name_that_was_probably_meant_is_found(name: str, meant: str | None) -> None:
    assert nearest(name, ("mass", "torque")) == meant
    assert did_you_mean(name, iter(("mass", "torque"))) == (f"did you mean `{meant}`?" if meant else None)


@pytest.mark.parametrize(
    ("name", "others"), [("distance", "resistance"), ("bar", "arc"), ("omega", "momenta"), ("ring", "rod")]
)
def test_a_word_that_is_only_alike_was_not_meant(name: str, others: str) -> None:
    assert nearest(name, [others]) is None


def test_a_nearer_word_is_not_hidden_by_a_longer_one() -> None:
    assert [nearest(name, ("disc", "topple", "top")) for name in ("dics", "tpo", "kgs")] == ["disc", "top", None]


def test_among_no_names_none_was_meant() -> None:
    assert nearest("torque", ()) is None
