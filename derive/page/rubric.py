"""A rubric: the points of a part divided among its steps, in halves or quarters if possible.

The author may specify points in a part, `rubric: {lagrangian: 2, motion_theta: 1}`; the other steps divide the rest in
proportion to their shares. A step has one share and an answer has two. The points are rounded by the method of largest
remainders. If an answer has a formula and a number, the formula has the two shares, and the number is worth at most
half a point.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from derive.course.yaml_tree import Word
from derive.errors import Complaint, did_you_mean
from derive.page.chain_lines import ChainLine, Equations
from derive.page.tree import Display, Document, PartPage
from derive.steps.step import Step

UNITS = (Fraction(1, 2), Fraction(1, 4))  # in points; quarters are used if there are too few halves
ANSWER, STEP, NUMBER = 2, 1, 0  # numbers of shares; a number that follows its formula has no share


@dataclass(frozen=True)
class Weighed:
    """A step and its number of shares."""

    equations: Equations
    weight: int


@dataclass(frozen=True)
class Credit:
    """The points of one step, with the equations of the step on the page, and what a student does in the step."""

    equations: Equations
    points: Fraction
    task: str

    @property
    def results(self) -> tuple[ChainLine, ...]:
        """Return the last line of each chain, with the left side of the chain."""
        return tuple(_with_left_side(chain) for chain in self.equations.chains)


def _with_left_side(chain: Sequence[ChainLine]) -> ChainLine:
    return replace(chain[-1], left=next((line.left for line in reversed(chain) if line.left is not None), None))


def credits_of(
    document: Document,
    said: Mapping[str, Mapping[Word, Fraction]],
    tasks: Mapping[str, str],
    values: Iterable[Step] = (),
) -> dict[str, tuple[Credit, ...]]:
    """Return the rubric of each part that is not an extra question, by label; `said` are the points that the problem
    specifies, by label.

    `tasks` states in words what a student does in each step, by key. `values` are the steps that substitute numbers.
    """
    into = {value.key: value.inputs for value in values}
    asked = [part for part in document.parts_shown if not part.extra]
    named = [part for part in asked if part.points is not None]
    open_parts = [part for part in asked if part.points is None]
    left = (document.points or Fraction(0)) - sum((part.points or Fraction(0) for part in named), Fraction(0))
    points: dict[str, Fraction] = {}
    for parts, worth in (*(([part], part.points or Fraction(0)) for part in named), (open_parts, left)):
        own = {str(key): share for part in parts for key, share in said.get(part.label, {}).items()}
        others = [group for part in parts for group in _weighed(part, into) if group.equations.key not in own]
        points |= {**_shared(worth - sum(own.values(), Fraction(0)), others), **own}
    found = {
        part.label: tuple(
            Credit(group, share, tasks.get(group.key, ""))
            for group in _groups(part)
            if (share := points.get(group.key))
        )
        for part in asked
    }
    return {label: rubric for label, rubric in found.items() if rubric}


def _weighed(part: PartPage, into: Mapping[str, Collection[str]]) -> list[Weighed]:
    """Return the steps of a part with their shares."""
    groups = _groups(part)
    keys = {group.key for group in groups}
    formulas = {group.key: keys & set(into.get(group.key, ())) for group in groups}
    answers = {key for found in formulas.values() for key in found}

    def weight(group: Equations) -> int:
        if formulas[group.key]:
            return NUMBER
        return ANSWER if group.framed or group.key in answers else STEP

    return [Weighed(group, weight(group)) for group in groups]


def _shared(points: Fraction, groups: Sequence[Weighed]) -> dict[str, Fraction]:
    numbers = [group.equations.key for group in groups if group.weight == NUMBER]
    others = [group for group in groups if group.weight != NUMBER]
    worth = UNITS[0] if points >= UNITS[0] * len(groups) else Fraction(0)
    shares = _by_weight(points - worth * len(numbers), others)
    return shares | (dict.fromkeys(numbers, worth) if worth else {})


def _by_weight(points: Fraction, groups: Sequence[Weighed]) -> dict[str, Fraction]:
    """Divide points by the method of largest remainders."""
    if not groups or points <= 0:
        return {}
    weights = [group.weight for group in groups]
    unit = next((unit for unit in UNITS if points / unit >= max(1, weights.count(ANSWER))), UNITS[-1])
    exact = [points / unit * weight / sum(weights) for weight in weights]
    counts = [int(share) for share in exact]
    order = sorted(range(len(groups)), key=lambda i: (exact[i] - counts[i], weights[i], i), reverse=True)
    for i in order[: int(points / unit) - sum(counts)]:
        counts[i] += 1
    shares = {group.equations.key: unit * count for group, count in zip(groups, counts, strict=True)}
    shares[groups[-1].equations.key] += points - sum(shares.values(), Fraction(0))  # the rest is less than one unit
    return {key: share for key, share in shares.items() if share}


def faults_of_rubric(document: Document, said: Mapping[str, Mapping[Word, Fraction]]) -> list[Complaint]:
    """Return an error for each step that is under `rubric:` of a part but does not belong to this part."""
    faults = []
    for part in document.parts_shown:
        steps = [group.key for group in _groups(part)]
        for key in said.get(part.label, {}):
            if key not in steps:
                names = f"has {', '.join(f'`{step}`' for step in steps)}" if steps else "shows no step"
                help_line = did_you_mean(key, steps) or f"the part {names}"
                message = f"part ({part.label}) has no step `{key}` that could have points"
                faults.append(Complaint("no-such-step", message, key.place, help=help_line))
    return faults


def _groups(part: PartPage) -> list[Equations]:
    return [group for block in part.blocks if isinstance(block, Display) for group in block.groups]
