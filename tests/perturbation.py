"""Change every result of a run a little: some second route must refuse the changed result.

`python -P -m tests.perturbation` does this for all results of all runs; the test suite does it for a sample.
"""

from __future__ import annotations

import os
import random
import signal
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any
from unittest.mock import patch

from sympy import Add, Expr, ImmutableDenseMatrix, MatrixBase, Rational

import derive.steps.chain
import derive.steps.establish
from derive.algebra.equality import equal
from derive.algebra.expressions import TIME, Relation, explicit
from derive.errors import DeriveError
from derive.steps.rule import Rule
from derive.steps.step import Route
from tests.mutation.runs import RUNS, Run

MARKS = ("=", "<", ">", "<=", ">=", "!=")
LIMIT = 20  # seconds that the routes may take over one result
SCALE, SHARE = Rational(7, 3), Rational(3, 11)

# (rule, change) -> the reason why no route needs to refuse it
EXCEPTIONS = {
    ("rotation.principal_axis", "sign"): "an axis has a direction and no sign: e and -e are the same axis",
    (
        "rotation.principal_axis",
        "sign of an entry",
    ): "the same, or another axis across the axis of a round body, which is principal too",
    (
        "rotation.principal_axis",
        "order",
    ): "if all moments are equal, every axis is principal; otherwise a route refuses",
    ("rest.equilibrium", "sign"): "the mirror image of an equilibrium is an equilibrium too, if the energy is even",
    **dict.fromkeys(
        [
            (rule, "sign")
            for rule in (
                "vibrations.mode_frequency",
                "vibrations.period",
                "vibrations.beats",
                "vibrations.steady_amplitude",
                "rotation.radius_of_gyration",
                "vibrations.gyroscopic_frequency",
                "vibrations.damped_frequency",
            )
        ],
        "the routes compare its square; the predicate of its outcome requires that it is not negative",
    ),
    **{
        (rule, what): "only the ratios of the amplitudes of a mode matter: it has no size and no sign"
        for rule in ("vibrations.gyroscopic_motion", "vibrations.damped_shape")
        for what in ("sign", "scale", "order")
    },
    **{
        (
            "vibrations.gyroscopic_stability",
            what,
        ): "the route compares the border; the predicate of the outcome decides on which side it is stable"
        for what in ("mark", "sides")
    },
    ("rest.equilibrium", "sign of an entry"): "the angle -pi is pi",
    ("lagrange.change_under_shift", "mark"): "both sides vanish",
    ("rotation.principal_moments", "order"): "the order of the moments of a tensor that is not diagonal is arbitrary",
}


@dataclass(frozen=True)
class Established:
    run: str
    rule: str
    key: str
    result: Any
    routes: Mapping[str, Route]
    moving: frozenset[Any] = frozenset()

    def refuses(self, other: Any) -> bool:
        """Whether some route refuses another result, or `check_can_hold` does because it can never hold."""
        try:
            derive.steps.establish.check_can_hold(self.key, other)
        except DeriveError:
            return True
        for claim, route in self.routes.items():
            try:
                derive.steps.chain.route_evidence(self.key, claim, route(other))
            except DeriveError:
                return True
        return False

    def is_exception(self, what: str, other: Any) -> bool:
        """Whether no route needs to refuse: for a reason above, or because a potential energy is defined up to a
        constant."""
        if self.rule == "lagrange.potential_energy":
            return not (explicit(other - self.result)).expand().free_symbols & {*self.moving, TIME}
        return (self.rule, what) in EXCEPTIONS


def established_in(run: Run) -> list[Established]:
    """Return every result of a run that has second routes, including its numbers."""
    found: list[Established] = []
    evidence_of = derive.steps.establish.evidence_of_routes

    def noted(key: str, rule: Rule, result: Any, routes: Mapping[str, Route]) -> Any:
        asking = sys._getframe(1).f_locals  # the local variables of `establish`
        if routes:
            moving = frozenset(asking["scope"].coordinates)
            found.append(Established(run.name, rule.name, key, result, dict(routes), moving))
        return evidence_of(key, rule, result, routes)

    with patch.object(derive.steps.establish, "evidence_of_routes", noted):
        run.solved()
    return found


@dataclass(frozen=True)
class Perturbed:
    of: Established
    what: str
    result: Any

    @property
    def is_excepted(self) -> bool:
        return self.of.is_exception(self.what, self.result) and not self.of.refuses(self.result)

    @property
    def survives(self) -> bool:
        return not self.of.refuses(self.result) and not self.of.is_exception(self.what, self.result)

    def __str__(self) -> str:
        return f"{self.of.run}: {self.of.key} ({self.of.rule}), {self.what}: {self.of.result} -> {self.result}"


def sample(found: Sequence[Established], size: int, seed: int) -> list[Perturbed]:
    """Return a random sample of all changes of all results; half of the sample changes the operators of relations."""
    drawn = random.Random(seed)
    every = [Perturbed(established, *each) for established in found for each in perturbations(established.result)]
    marks = [each for each in every if each.what == "mark"]
    others = [each for each in every if each.what != "mark"]
    return [*drawn.sample(marks, size // 2), *drawn.sample(others, size - size // 2)]


def perturbations(result: Any) -> Iterator[tuple[str, Any]]:
    """Yield the kind of each change, and the changed result."""
    for what, other in _perturbed(result):
        same = isinstance(result, Relation) and equal(result, other)  # w = 0 is equivalent to 2 w = 0
        if other != result and not same:
            yield what, other


def _perturbed(result: Any) -> Iterator[tuple[str, Any]]:
    if isinstance(result, Relation):
        yield from _of_relation(result)
    elif isinstance(result, MatrixBase):
        yield from _of_entries(result)
    else:
        yield "plus", result + _share(result)
        yield "minus", result - _share(result)
        yield "sign", -result
        yield "scale", SCALE * result
        terms = Add.make_args(result.expand()) if isinstance(result, Expr) else ()
        for term in terms[:4] if len(terms) > 1 else ():
            yield "dropped", result - term


def _of_relation(relation: Relation) -> Iterator[tuple[str, Any]]:
    left, mark, right = relation.left, relation.operator, relation.right
    for other in MARKS:
        yield "mark", Relation(left, other, right)
    yield "left", Relation(left + _share(left), mark, right)
    yield "left", Relation(left - _share(left), mark, right)
    yield "right", Relation(left, mark, right + (_share(right) if right != 0 else _share(left)))
    if right != 0:
        yield "sign", Relation(left, mark, -right)
        yield "right", Relation(left, mark, SCALE * right)
    if mark not in {"=", "!="}:
        yield "sides", Relation(right, mark, left)


def _of_entries(result: Any) -> Iterator[tuple[str, Any]]:
    entries: Sequence[Any] = list(result)

    def made(changed: Sequence[Any]) -> Any:
        return ImmutableDenseMatrix(result.rows, result.cols, list(changed))

    for i, entry in enumerate(entries):
        yield "entry", made([*entries[:i], entry + _share(entry), *entries[i + 1 :]])
        if entry != 0:
            yield "sign of an entry", made([*entries[:i], -entry, *entries[i + 1 :]])
    yield "sign", made([-entry for entry in entries])
    yield "scale", made([SCALE * entry for entry in entries])
    yield "order", made(entries[::-1])
    yield "order", made([*entries[1:], entries[0]])


def _share(value: Any) -> Any:
    """Return a fraction of the first nonzero term, so that the added term has the same dimension."""
    return next((SHARE * term for term in Add.make_args(explicit(value)) if term != 0), SHARE)


def verdict_on(each: Perturbed) -> str:
    """Return the verdict on a changed result; it is open if the routes take too long."""

    def stop(*_: Any) -> None:
        raise TimeoutError

    signal.signal(signal.SIGALRM, stop)
    signal.alarm(LIMIT)
    try:
        return "survived" if each.survives else "excepted" if each.is_excepted else "refused"
    except TimeoutError:
        return "too long"
    finally:
        signal.alarm(0)


def main() -> int:
    os.nice(5)
    counts: Counter[str] = Counter()
    for name in sys.argv[1:] or RUNS:
        for established in established_in(RUNS[name]):
            sort = "relation" if isinstance(established.result, Relation) else "value"
            for each in (Perturbed(established, *other) for other in perturbations(established.result)):
                verdict = verdict_on(each)
                counts[f"{sort}s {verdict}"] += 1
                if verdict == "survived":
                    print(each)
        print(f"after {name}: " + ", ".join(f"{count} {what}" for what, count in sorted(counts.items())), flush=True)
    return int(any("survived" in what for what in counts))


if __name__ == "__main__":
    sys.exit(main())
