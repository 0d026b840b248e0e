"""A law, a second route or a choice of words that is changed is refused, or prints what it printed.

`make mutants` tries every mutant; here is a fair sample. What was found is told in `docs/soundness.md`.
"""

from __future__ import annotations

import os
import pickle
from collections.abc import Iterator

import pytest

from tests.mutation.known import KNOWN
from tests.mutation.trial import Trials, Tried, Verdict
from tests.test_house_rules import DEFINITIONS, verbs

RUNS = ("block", "euler", "body-cylinder", "slab")
SIZE, SEED = 20, 2026


def in_a_process_of_its_own(trials: Trials) -> Iterator[Tried]:
    """The verdicts, without a trace of what the trials remember."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        try:
            trials.prepare()
            with os.fdopen(writing, "wb") as pipe:
                for tried in trials.verdicts(trials.sample(SIZE, SEED), at_most=1):
                    pickle.dump(tried, pipe)
        finally:
            os._exit(0)
    os.close(writing)
    with os.fdopen(reading, "rb") as pipe:
        try:
            while True:
                yield pickle.load(pipe)
        except EOFError:
            os.waitpid(child, 0)


@pytest.fixture(scope="module")
def trials() -> Trials:
    """The mutants themselves, made once for all tests here."""
    made = Trials(RUNS)
    assert made.mutants
    return made


@pytest.fixture(scope="module")
def found(trials: Trials) -> list[Tried]:
    return list(in_a_process_of_its_own(trials))


def test_no_mutant_prints_another_result_or_another_sentence(found: list[Tried]) -> None:
    survived = [t for t in found if t.verdict is Verdict.SURVIVED and t.nature != "form" and t.id not in KNOWN]
    assert [f"{tried.id}\n{tried.told}" for tried in survived] == []


def test_every_mutant_of_the_sample_was_tried(found: list[Tried]) -> None:
    assert len(found) == SIZE
    refused = sum(tried.verdict in {Verdict.REFUSED, Verdict.CRASHED} for tried in found)
    assert refused >= SIZE // 4  # of others many change nothing that a page shows


def test_the_law_of_every_verb_has_mutants(trials: Trials) -> None:
    """A definition asserts nothing, so a change of it is another definition; every other verb can be made wrong."""
    assert set(verbs()) - DEFINITIONS <= trials.changed()


def test_a_known_survivor_is_a_mutant_that_can_still_be_made(trials: Trials) -> None:
    assert set(KNOWN) - {mutant.id for mutant in trials.mutants} == set()
