"""References by number to equations, drawings and problems: `<<eq torque>>`, `<<figure axes>>`, `<<problem top>>`."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence

from derive.course.prose import FIGURE, PROBLEM, Mention
from derive.errors import Complaint, did_you_mean
from derive.page.numbering import Number
from derive.page.wording import FigureRef, Inline, Phrases, ProblemRef, Ref, Text, filled, joined, name_of
from derive.steps.step import Step


class References:
    """The references of one page, which are checked at the end because prose may refer to a later equation.

    others   numbers of the set's problems, by their names
    figures  numbers of the figures that have a caption, by their names
    away     the equations of the parts that the page leaves out, by the keys of their steps; they have no numbers
    faults   the list to which errors are added
    """

    def __init__(
        self,
        set_id: str,
        others: Mapping[str, int],
        figures: Mapping[str, int],
        away: Mapping[str, Inline],
        words: Phrases,
        faults: list[Complaint],
    ):
        self.set_id, self.others, self.figures, self.away = set_id, others, figures, away
        self.words, self.faults = words, faults
        self.equations: list[Mention] = []

    def node(self, mention: Mention) -> Inline | None:
        """Return the reference that a mention prints: to a problem, a figure or an equation. Return the equation itself
        if the page leaves out its part, and None if the problem or figure is unknown."""
        if mention.of == PROBLEM:
            return self._problem(mention)
        if mention.of == FIGURE:
            return self._figure(mention)
        if mention.name in self.away:
            return self.away[mention.name]
        self.equations.append(mention)
        return Ref(mention.name)

    def note(self, pieces: Iterable[str | Mention], names: Mapping[str, object]) -> None:
        """Record the mentions that print an equation number."""
        mentions = (piece for piece in pieces if isinstance(piece, Mention) and not piece.of)
        self.equations += [mention for mention in mentions if isinstance(names.get(mention.name), Ref)]

    @property
    def named(self) -> set[str]:
        """Return the keys of the steps to whose equations prose refers."""
        return {mention.name for mention in self.equations}

    def check_title(self, mentions: Iterable[Mention], names: Mapping[str, object]) -> None:
        """Reject references by number in the title, because the title also appears in lists and page headers."""
        for mention in mentions:
            if mention.of or isinstance(names.get(mention.name), Ref):
                message = "a title cannot refer to an equation, a figure or a problem"
                self.faults.append(Complaint("mention", message, mention.place, help="refer to it in the statement"))

    def _problem(self, mention: Mention) -> Inline | None:
        if mention.name in self.others:
            text = f"{self.words.labels['problem']} {self.others[mention.name]}"
            return ProblemRef(f"{self.set_id}/{mention.name}", text)
        help_line = did_you_mean(mention.name, self.others) or "use the name of a problem that `set.yaml` lists"
        message = f"`{mention.name}` is not a problem of this set"
        self.faults.append(Complaint("no-such-problem", message, mention.place, help=help_line))
        return None

    def _figure(self, mention: Mention) -> Inline | None:
        if mention.name in self.figures:
            number = self.figures[mention.name]
            return FigureRef(f"{self.words.labels['figure']}\u00a0{number}", mention.name, number)
        message = f"no drawing with a caption is called `{mention.name}`"
        help_line = (
            did_you_mean(mention.name, self.figures)
            or "use the name of a drawing, and write its `caption:` under `drawings:`"
        )
        self.faults.append(Complaint("undefined-name", message, mention.place, help=help_line))
        return None

    def check(self, numbers: Mapping[str, Number], known: Collection[str]) -> None:
        """Check that every equation that prose mentions has a number; `known` are the keys of all steps, shown or
        hidden."""
        for mention in self.equations:
            if mention.name in numbers:
                continue
            code, message = "undefined-name", f"no step on this page is called `{mention.name}`"
            help_line = did_you_mean(mention.name, numbers) or "use the key of a step on which the answers depend"
            if mention.name in known:
                code, message = "not-shown", f"the equation of `{mention.name}` is not shown, so it has no number"
                help_line = f"change `{mention.name}: hidden` under `show`, or write `<<{mention.name}>>`"
            self.faults.append(Complaint(code, message, mention.place, help=help_line))


def found_before(steps: Iterable[Step], shown_in: Mapping[str, str], words: Phrases) -> list[tuple[Inline, ...]]:
    """Return a sentence for each earlier part that derived some of these steps, with references to the equations."""
    found: dict[str, list[tuple[Inline, ...]]] = {}
    for step in (each for each in steps if each.key in shown_in):
        names = {"name": name_of(step), "has_symbol": step.symbol is not None, "ref": Ref(step.key)}
        found.setdefault(shown_in[step.key], []).append(filled(words.labels["found"], names))
    return [
        filled(words.labels["found_before"], {"part": part, "results": joined(items, words.labels["and"])})
        for part, items in found.items()
    ]


def each_number_once(nodes: Sequence[Inline], numbers: Mapping[str, Number]) -> tuple[Inline, ...]:
    """Replace `(4), (5) and (5)` by `(4) and (5)`: each number appears once among adjacent references."""
    found: list[Inline] = []
    for node in nodes:
        if not _repeats(found[-2:], node, numbers):
            found.append(node)
            continue
        between = found.pop()
        if len(found) > 2 and isinstance(found[-3], Ref):
            found[-2] = between
    return tuple(found)


def _repeats(before: Sequence[Inline], node: Inline, numbers: Mapping[str, Number]) -> bool:
    """Return whether only a comma or a word separates this reference from a reference with the same number."""
    match (*before, node):
        case (Ref(one), Text(between), Ref(other)):
            return len(between.split()) == 1 and numbers[one] == numbers[other]
    return False
