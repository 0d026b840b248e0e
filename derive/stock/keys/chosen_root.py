"""Which of several roots a result is: `root: positive`, `root: largest`, `root: 2`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NoReturn

from derive.algebra.expressions import Relation, explicit
from derive.course.yaml_tree import Word
from derive.errors import did_you_mean, rejected
from derive.steps.known_numbers import sign_known
from derive.steps.step import Quantity

Fits = Callable[[Quantity, Sequence[Quantity]], bool]


def _difference(one: Quantity, other: Quantity) -> int | None:
    return sign_known(explicit(one.value) - explicit(other.value))


WAYS: Mapping[str, Fits] = {
    "positive": lambda root, every: sign_known(explicit(root.value)) == 1,
    "negative": lambda root, every: sign_known(explicit(root.value)) == -1,
    "largest": lambda root, every: all(_difference(root, each) == 1 for each in every if each is not root),
    "smallest": lambda root, every: all(_difference(root, each) == -1 for each in every if each is not root),
}


def chosen_root(found: Sequence[Quantity], which: Word) -> Quantity:
    """The one that is meant, of those that there are."""
    if any(isinstance(root.value, Relation) for root in found):
        rejected("no-root", f"there is no root that could be `{which}`", which.place)
    if which.isdigit():
        if not 1 <= int(which) <= len(found):
            _refuse(which, f"there {'is' if len(found) == 1 else 'are'} {len(found)}", found)
        return found[int(which) - 1]
    if which not in WAYS:
        help_line = did_you_mean(which, WAYS) or f"it is {', '.join(f'`{way}`' for way in WAYS)}, or a number"
        rejected("wrong-type", f"`{which}` says nothing of a root", which.place, help_line)
    fitting = [root for root in found if WAYS[which](root, found)]
    if len(fitting) != 1:
        _refuse(which, "none is known to be so" if not fitting else f"{len(fitting)} are so", found)
    return fitting[0]


def _refuse(which: Word, why: str, found: Sequence[Quantity]) -> NoReturn:
    values = ", ".join(str(explicit(root.value)) for root in found)
    rejected("no-root", f"`root: {which}` does not say which root: {why}", which.place, f"the roots are {values}")
