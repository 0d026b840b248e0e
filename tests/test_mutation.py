"""A changed law, second route or choice of words is refused, or the page stays the same.

`make mutants` tries every mutant; these tests try a random sample. `docs/soundness.md` reports the results.
"""

from __future__ import annotations

import os
import pickle
import traceback
from collections.abc import Callable, Iterator, Sequence
from importlib import import_module
from typing import Any

import pytest

from derive.building.preload import DERIVING
from tests.mutation.known import KNOWN
from tests.mutation.mutants import Mutant
from tests.mutation.runs import RUNS as EVERY_RUN
from tests.mutation.trial import Trials, Tried, Verdict, recording
from tests.test_architecture import rules_of_verb, verbs

RUNS = ("block", "euler", "body-cylinder", "slab")
SIZE, SEED = 20, 2026


def in_a_process_of_its_own(found: Callable[[], Iterator[Any]]) -> Iterator[Any]:
    """Yield the results of `found`, computed in another process, so that caches of the trials do not stay in this
    one."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        try:
            with os.fdopen(writing, "wb") as pipe:
                for each in found():
                    pickle.dump(each, pipe)
        except BaseException:
            traceback.print_exc()
            os._exit(1)
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading, "rb") as pipe:
        try:
            while True:
                yield pickle.load(pipe)
        except EOFError:
            assert os.waitpid(child, 0)[1] == 0


@pytest.fixture(scope="module")
def trials() -> Trials:
    """Return the mutants, which are made once for all tests of this module."""
    made = Trials(RUNS)
    assert made.mutants
    return made


@pytest.fixture(scope="module")
def found(trials: Trials) -> list[Tried]:
    def verdicts() -> Iterator[Tried]:
        trials.prepare()
        yield from trials.verdicts(trials.sample(SIZE, SEED), at_most=1)

    return list(in_a_process_of_its_own(verdicts))


def verdicts_on(run: str, modules: Sequence[str], chosen: Callable[[Mutant], bool]) -> Sequence[Tried]:
    """Return the verdicts on chosen mutants of these modules in one run."""

    def verdicts() -> Iterator[Tried]:
        trials = Trials((run,), modules)
        trials.prepare()
        yield from trials.verdicts([mutant for mutant in trials.mutants if chosen(mutant)])

    return list(in_a_process_of_its_own(verdicts))


@pytest.mark.long
def test_no_mutant_prints_another_result_or_another_sentence(found: list[Tried]) -> None:
    survived = [t for t in found if t.verdict is Verdict.SURVIVED and t.nature != "form" and t.id not in KNOWN]
    assert [f"{tried.id}\n{tried.told}" for tried in survived] == []


@pytest.mark.long
def test_every_mutant_of_the_sample_was_tried(found: list[Tried]) -> None:
    assert len(found) == SIZE
    refused = sum(tried.verdict in {Verdict.REFUSED, Verdict.CRASHED} for tried in found)
    assert refused >= SIZE // 4  # many others change nothing on a page


def test_the_law_of_every_verb_has_mutants(trials: Trials) -> None:
    """A definition asserts nothing, so a changed definition is another definition. Every other verb can be made
    wrong."""
    assert {name for name in verbs() if any(rule.evidence for rule in rules_of_verb(name))} <= trials.changed()


def test_a_library_problem_is_another_run_than_the_pinned_one_of_its_name() -> None:
    assert (EVERY_RUN["cone"].id, EVERY_RUN["library/cone"].id) == ("hw9/cone", "library/cone")


@pytest.mark.long
def test_a_second_solution_calls_every_function_that_the_first_has_called() -> None:
    def calls() -> Iterator[set[tuple[str, str]]]:
        for name in DERIVING:  # a module that is loaded during the first solution would call functions of its own
            import_module(name)
        for _ in range(2):
            yield set(recording(EVERY_RUN["library/thrown_plate"]).first)

    first, second = in_a_process_of_its_own(calls)
    assert first == second


def test_a_mutant_is_seen_in_a_function_that_is_called_only_while_the_problem_is_read() -> None:
    module, where = "mechanics.rotation.euler_equations", "RigidBody.__post_init__"
    found = verdicts_on("own/free_top", [module], lambda m: m.where == where and m.change == "comparison")
    assert found
    assert {tried.verdict for tried in found} <= {Verdict.REFUSED, Verdict.CRASHED}


@pytest.mark.long
def test_the_rate_that_follows_from_a_kept_momentum_is_compared_with_the_momentum() -> None:
    found = verdicts_on("own/kept_momentum", ["mechanics.lagrange.kept_momentum"], lambda m: "bound(p" in m.old)
    wrong = [tried for tried in found if tried.verdict is not Verdict.REFUSED and "order" not in tried.id]
    assert len(found) >= 4
    assert wrong == []


PRINTED_SOMETHING_FALSE = {  # run -> the beginnings of the ids of its mutants
    "block": ["steps.numeric:_outcome: outcome: 'exact' -> 'integrated'"],
    "slab": [
        "mechanics.bodies.placed:_across: comparison: getattr(body, 'filling', '') == 'length'",
        "mechanics.rest.potentials:extreme_value: mark: '=' -> '>'",
        "mechanics.answers.conditions:where: role: {'quantity': of, 'bound': bound}",
    ],
    "springs": ["mechanics.model.system:Central.length: mark: '>' -> '<'"],
    "top-rates": [
        "mechanics.answers.quadratics:real_where: mark: '>' -> '<'",
        "mechanics.answers.quadratics:_coefficients: comparison: x not in f.free_symbols",
    ],
    "library/ball_with_hole": ["mechanics.rotation.assembly:_share_of_mass: word: part.body.called"],
    "library/clock_pendulum": ["mechanics.bodies.parts:PlacedPart.turned: sign: turn * self.turn"],
    "library/cue_ball": ["mechanics.answers.roots:_step: role: {'equation': equation, 'unknown': unknown}"],
    "library/drift": ["mechanics.model.forces:Charge.stored: sign: -self.charge -> self.charge"],
    "library/damped_oscillator": ["mechanics.vibrations.linear_motion:_sort: dropped: b ** 2 -> b"],
    "library/kepler": ["mechanics.rest.both_sides:_sides_taken: and/or"],
    "library/power_law": [
        "mechanics.vibrations.about_steady_motion:frequency_squared_about: role: {'potential': about.potential",
        "mechanics.vibrations.oscillations:_rate: outcome: 'unstable' -> 'conditional'",
    ],
    "library/thrown_plate": ["mechanics.rotation.steady:_given: outcome: 'momentary' -> 'generic'"],
    "library/turning_parabola": ["mechanics.rest.equilibria:_level_where: index: 0 -> 1 (2)"],
    "own/conical_pendulum": ["mechanics.answers.roots:_excluded: condition: f not in"],
    "own/damped_carts": ["mechanics.vibrations.damped:_frequency: sign: Root(turned * equations.system.square(root))"],
    "own/solids": [
        "mechanics.bodies.edged_bodies:Triangle.on_base: order: (base, ZERO) -> [ZERO, base]",
        "mechanics.bodies.edged_bodies:Triangle.equilateral: dropped: side * sqrt(3) / 2 -> side",
    ],
}


@pytest.mark.parametrize("run", PRINTED_SOMETHING_FALSE)
def test_mutants_that_printed_something_false_are_refused(run: str) -> None:
    begins = PRINTED_SOMETHING_FALSE[run]
    modules = {each.partition(":")[0]: None for each in begins}
    found = verdicts_on(run, list(modules), lambda mutant: mutant.id.startswith(tuple(begins)))
    assert [begin for begin in begins if not any(tried.id.startswith(begin) for tried in found)] == []
    wrong = [tried.id for tried in found if tried.verdict not in {Verdict.REFUSED, Verdict.CRASHED}]
    assert wrong == []
