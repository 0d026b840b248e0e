"""The small change after which a claim that does not follow would follow from the rows before it."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from time import process_time

import sympy
from sympy import Expr, MatrixBase, Symbol

from derive.audit.claims import Claim, Verdict
from derive.audit.deciding import degree, order_of_error, same
from derive.audit.fingerprint import is_zero
from derive.audit.knowledge import Known
from derive.audit.memory import SPECIAL, Memory, WithMemory
from derive.audit.nearest_change import Nearness, letters_in, terms_in
from derive.audit.slips import Edit, edits_of_side, nearest_edit
from derive.audit.systems import (
    changing_letters,
    equations_of_motion,
    expanded,
    frequency_equations,
    is_linear,
    motion_of,
    moving_letters,
    root_equation,
    values_at_instant,
    values_with,
    zeros_in_time,
)
from derive.audit.time_limit import FAULTS
from derive.documents.facts import ANGLES, Identity
from derive.documents.layout import Cue
from derive.documents.meaning import Meaningless, Value
from derive.documents.syntax import (
    EvalBar,
    Letter,
    Node,
)

SECONDS_OF_SEARCH = 2.0  # seconds of processor time for the search for a change that makes a claim right
MOST_INDICES = 12
MOST_LOST = 6  # at most this many missing letters are tried as corrections of a row
MOST_ROWS = 10  # at most this many of the last equations and displayed claims are searched for lost letters and terms
FEWEST_OPERATIONS = 3  # only earlier values with at least this number of operations are compared with a later value
DISTINCT = ("sign", "exponent", "function")  # changes that do not lead from one special case to another
PLAIN = ("", "unmarked", "all", "tensors")
REFERENCE = re.compile(r"\\(?:eq)?ref\{([^{}]+)\}")


class Changes(WithMemory):
    """The search for one small change of a claim after which it would follow."""

    def __init__(self, memory: Memory, written: Counter[Identity]):
        super().__init__(memory)
        self.written = written  # how many claims of the document contain a letter

    def letters_of_one_claim(self) -> set[str]:
        """Return the letters that only one claim of the document contains, as they are written."""
        return {
            self.memory.shown(each.span) for each in self.meaning.symbols.values() if self.written[each.identity] == 1
        }

    def change_of_approximation(self, claim: Claim) -> Edit | None:
        """Return one change of the right side after which it would have the leading terms of the left side where the
        letters that change are small, as in `cos x ~ 1 - x^2`; None if no change is found."""
        assert claim.values is not None and claim.right is not None
        left, right = claim.values
        if isinstance(left, MatrixBase) or isinstance(right, MatrixBase):
            return None
        small = changing_letters(left.free_symbols, self.meaning)
        if not small or left.free_symbols != right.free_symbols:
            return None
        node = self.memory.reading(claim.right)
        for edit in edits_of_side(node, letters_in(node), self.memory.shown):
            with suppress(*FAULTS, Meaningless):
                value = self.meaning.of(edit.node)
                found = order_of_error(left, value, self.meaning, [small])
                if found is not None and found[1] > degree(value, small) > 0:
                    return edit
        return None

    def change_of_value(self, claim: Claim) -> Edit | None:
        """Return one change of the right side after which a letter would have its earlier value."""
        assert claim.values is not None and claim.right is not None
        value = self.known.definitions[claim.values[0]][-1].value
        return self.change_to(claim, value)

    def change_to(self, claim: Claim, value: Expr, fewest: int = FEWEST_OPERATIONS) -> Edit | None:
        """Return one change of the right side after which it would have the given value."""
        assert claim.right is not None
        if sympy.count_ops(value) < fewest:
            return None  # each short value is one change away from other values
        right_node = self.memory.reading(claim.right)
        return Nearness(self.meaning, self.known, letters_in(right_node), self.memory.shown).of_value(right_node, value)

    def change_at_instant(self, claim: Claim) -> Edit | None:
        """Return one change of the right side after which a letter such as v_1 would have the value at t_1 of v, of a
        velocity x', or of a letter to whose row the sentence refers."""
        assert claim.values is not None
        for earlier, _ in values_at_instant(claim.values[0], self.meaning, self.known):
            label = earlier.row.label if earlier.row is not None else ""
            if self.may_be_values_of_one(claim.values[0], earlier.symbol) or (
                label and label in REFERENCE.findall(claim.row.block.sentence)
            ):
                edit = self.change_to(claim, expanded(self.known, earlier.value)[0], fewest=2)
                if edit is not None:
                    return edit
        return None

    def may_be_values_of_one(self, value: Symbol, function: Symbol) -> bool:
        """Whether a letter is probably the value of a function of time at an instant: y_2 of y, v_1 of v or x'."""
        named, of = self.meaning.symbols.get(value), self.meaning.symbols.get(function)
        if named is None or of is None:
            return False
        velocity = named.base == ("omega" if of.base in ANGLES else "v")
        return (velocity and of.dots == 1) or (named.base == of.base and named.dots == of.dots)

    def with_other_indices(self, letters: list[Letter]) -> list[Letter]:
        """Return the given letters and further letters of the document that differ from them only in the index."""
        bases = {(each.base, each.dots) for each in letters if each.sub}
        known = {(each.identity, each.dots) for each in letters}
        more = [each for each in self.meaning.symbols.values() if (each.base, each.dots) in bases]
        return letters + [each for each in more if (each.identity, each.dots) not in known][:MOST_INDICES]

    def strange_letters(self, claim: Claim) -> set[str]:
        """Return the letters that only this claim of the document contains, as they are written."""
        letters = letters_in(claim.left if claim.before is None else None, claim.right)
        return {self.memory.shown(each.span) for each in letters if self.written[each.identity] == 1}

    def letters_for_strange(self, claim: Claim, written: list[Letter]) -> list[Letter]:
        """Return letters of the document that resemble a letter of a claim which no other claim contains."""
        strange = [each for each in written if self.written[each.identity] == 1]
        known = {(each.identity, each.dots) for each in written}
        return [
            each
            for each in self.meaning.symbols.values()
            if (each.identity, each.dots) not in known
            and any(each.base.lower() == odd.base.lower() or each.sub == odd.sub for odd in strange)
        ][:MOST_INDICES]

    def lost_letters(self, claim: Claim, written: list[Letter]) -> list[Letter]:
        """Return letters that a row lacks, although the earlier rows from which it should follow contain them."""
        assert claim.values is not None
        left = claim.values[0]
        behind = set(left.free_symbols | self.memory.expanded(left).free_symbols) if claim.is_step else set()
        if isinstance(left, Symbol) and not claim.is_step:
            equations = [each for each, _ in self.known.equations[-MOST_ROWS:] if left in each.free_symbols]
            behind = set().union(*(expanded(self.known, each, left, sure=True)[0].free_symbols for each in equations))
        known = {(each.identity, each.dots) for each in written}
        found = [replace(each, dots=dots) for each in letters_in(claim.left, claim.right) for dots in range(each.dots)]
        found += [self.meaning.symbols[each] for each in sorted(behind, key=str) if each in self.meaning.symbols]
        return [each for each in found if (each.identity, each.dots) not in known][:MOST_LOST]

    def is_motion(self, claim: Claim) -> bool:
        """Whether a display states an equation of motion, which holds in later parts, too."""
        letters = letters_in(claim.left, claim.right)
        return claim.row.block.display and any(each.dots == 2 for each in letters)

    def near_edit(self, claim: Claim, known: Known, lost: list[Node] | None = None) -> Edit | None:
        """Return one change of a side after which a claim would follow from other rows; None if no change is found.

        lost   terms that the claim may have lost
        """
        left_side = self.memory.last_good_side(claim)
        if claim.right is None or left_side is None or claim.values is None:
            return None
        right_node, left_node = self.memory.reading(claim.right), self.memory.reading(left_side)
        if all(isinstance(each, Letter) and not each.dots for each in (left_node, right_node)):
            return None  # "at theta = theta_1" names a place
        letter = claim.values[0] if isinstance(claim.values[0], Symbol) and not claim.is_step else None
        letters = self.with_other_indices(letters_in(left_node, right_node))
        letters += self.lost_letters(claim, letters) if known is self.known else []
        letters += self.letters_for_strange(claim, letters)
        letters += [each for each in lost or () if isinstance(each, Letter) and each not in letters]
        terms = self.terms_before(claim) if known is self.known and not self.memory.may_be_special(claim) else lost
        near = Nearness(
            self.meaning, known, [each for each in letters if letter is None or self.meaning.symbol(each) != letter],
            self.memory.shown, known is not self.known, terms=terms,
        )  # fmt: skip
        if letter is not None and (at_root := root_equation(letter, self.meaning, known)) is not None:
            unknown, equation, _ = at_root
            letters = self.with_letters_of(equation, near.letters)
            near.letters = [each for each in letters if self.meaning.symbol(each) != unknown]
            return near.of_root(right_node, unknown, equation)
        edit = None
        if letter is not None:
            edit = self.near_zero(claim, near, right_node, letter) or self.near_motion(claim, near, right_node, letter)
        edit = edit or self.near_vanishing(claim, near, right_node)
        if edit is None and letter is not None and self.may_be_other_mode(claim):
            return None
        edit = edit or self.near_equation(claim, near, left_node, right_node, letter)
        return None if edit is not None and claim.is_step and self.repeats_a_side(claim, edit.node) else edit

    def near_zero(self, claim: Claim, near: Nearness, right_node: Node, letter: Symbol) -> Edit | None:
        """Return one change after which an earlier function of time would vanish at the time t_1 of a claim."""
        if Cue.ZERO not in claim.row.block.cues or near.written:
            return None
        at_zero = zeros_in_time(letter, self.meaning, near.known)
        edit = near.of_root(right_node, at_zero[0], at_zero[1]) if at_zero is not None else None
        return edit if edit is not None and edit.kind in DISTINCT else None

    def near_vanishing(self, claim: Claim, near: Nearness, right_node: Node) -> Edit | None:
        """Return one change after which an earlier value would vanish at the place that a claim gives; None if an
        earlier value vanishes at this place."""
        assert claim.values is not None
        left, right = claim.values
        if (
            not claim.row.block.cues & {Cue.ZERO, Cue.LEAVES}
            or near.written
            or claim.is_step
            or motion_of(left, right, self.meaning)
        ):
            return None
        rates = Cue.ZERO in claim.row.block.cues
        values = [each.value for each in values_with(left, self.meaning, near.known, rates)]
        if any(is_zero(value.xreplace({left: right})) for value in values):
            return None
        for edit in near.edits(right_node) if values else ():
            with suppress(*FAULTS, Meaningless):
                place = self.meaning.of(edit.node)
                if any(is_zero(value.xreplace({left: place})) for value in values):
                    return edit
        return None

    def near_equation(
        self, claim: Claim, near: Nearness, left_node: Node, right_node: Node, letter: Symbol | None
    ) -> Edit | None:
        """Return one change after which a claim would follow from earlier equations, also with the constraints of its
        part, or after which it would be a first integral."""
        near.linear = Cue.APPROXIMATE in claim.row.block.cues or self.is_linear(claim)
        edit = near.of_claim(left_node, right_node, letter, claim.is_step)
        if edit is not None or near.written or not claim.row.block.display or claim.is_step:
            return edit
        known, constant = near.known, self.constraints_of_part(claim)
        constraints = {each for each in constant if self.is_constraint(self.claims[each], claim)}
        if constraints - known.here:
            near.known = replace(known, here=known.here | constraints, kept={})
            edit = near.of_claim(left_node, right_node, letter, claim.is_step)
        near.known = replace(known, here=known.here | constant, kept={})
        return edit or near.of_first_integral(left_node, right_node)

    def constraints_of_part(self, claim: Claim) -> frozenset[int]:
        """Return the conditions in sentences of the same part that give a constant value to a coordinate: `r = l`, or
        `r = 0` if the claim does not contain r."""
        found, written = [], {each.identity for each in letters_in(claim.left, claim.right)}
        for each in self.claims[: claim.number]:
            if each.number not in self.known.conditions or each.row.block.part != claim.row.block.part:
                continue
            if each.values is None or not isinstance(each.values[0], Symbol) or isinstance(each.values[1], MatrixBase):
                continue
            letter, value = each.values
            constant = value.is_Symbol or (value.is_number and self.meaning.symbols[letter].identity not in written)
            if constant and moving_letters({letter}, self.meaning) and not moving_letters({value}, self.meaning):
                found.append(each.number)
        return frozenset(found)

    def is_constraint(self, claim: Claim, later: Claim) -> bool:
        """Whether a claim `r = l` is a constraint for a later claim: its part also states that a rate of r is zero, and
        the later claim does not contain r."""
        assert claim.values is not None
        coordinate = self.meaning.symbols[claim.values[0]]
        if any(each.identity == coordinate.identity for each in letters_in(later.left, later.right)):
            return False
        rates = {self.meaning.symbol(replace(coordinate, dots=dots)) for dots in (1, 2)}
        return any(
            each.values is not None and each.values[0] in rates and each.values[1] == 0
            for each in self.claims
            if each.row.block.part == claim.row.block.part
        )

    def near_motion(self, claim: Claim, near: Nearness, right_node: Node, letter: Symbol) -> Edit | None:
        """Return one change after which a frequency, a period or a motion would follow from an equation of motion, or
        None."""
        assert claim.values is not None
        for equation, number in reversed(frequency_equations(letter, self.meaning, near.known)):
            edit = near.of_root(right_node, letter, equation)
            if edit is not None and edit.meant != "1":  # a factor such as 2 in 2k may be right: two springs
                if self.may_change(edit, claim, self.claims[number]):
                    return edit
        for equation, number in reversed(equations_of_motion(*claim.values, self.meaning, near.known)):
            if self.has_older_motion(equation.free_symbols, claim):
                continue
            if self.belongs_to(claim, self.claims[number]) or self.is_motion(self.claims[number]):
                near.letters = self.with_letters_of(equation, near.letters)
                edit = near.of_motion(right_node, letter, equation)
                return edit if edit is not None and self.may_change(edit, claim, self.claims[number]) else None
        return None

    def may_be_other_mode(self, claim: Claim) -> bool:
        """Whether a claim states a motion, and an earlier display states a motion of another coordinate."""
        assert claim.values is not None
        moving = moving_letters(set(self.known.definitions), self.meaning)
        return bool(motion_of(*claim.values, self.meaning)) and self.has_older_motion(set(moving), claim)

    def has_older_motion(self, symbols: set[Symbol], claim: Claim) -> bool:
        """Whether an earlier display gives one of these letters, other than the letter of a claim, as a function of
        time: perhaps the claim is about another mode."""
        assert claim.values is not None
        named = self.meaning.symbols.get(claim.values[0])
        for each in moving_letters(symbols, self.meaning):
            found = self.known.definitions.get(each, ())
            if found and (named is None or self.meaning.symbols[each].identity != named.identity):
                row = found[-1].row
                is_older = row is not None and row.block.display and row.block is not claim.row.block
                if is_older and motion_of(each, found[-1].value, self.meaning):
                    return True
        return False

    def change_of_motions(self, claim: Claim) -> tuple[Claim, Edit] | None:
        """Return one change of a motion, or of the value of another coordinate in the same sentence, after which both
        satisfy the equations of motion that contain no other coordinates; None if they satisfy them already, or if no
        change is found."""
        assert claim.values is not None
        place, motion = claim.values[0], motion_of(*claim.values, self.meaning)
        for other in reversed(self.claims[: claim.number] if motion else []):
            if other.row.block.sentence != claim.row.block.sentence or other.row.block.part != claim.row.block.part:
                break
            if other.values is None or other.is_step or not moving_letters({other.values[0]}, self.meaning):
                continue
            if other.values[0] == place or other.values[1].is_number:
                continue
            equations = self.equations_of_both(place, other.values[0])
            motion_of_other = motion_of(*other.values, self.meaning)
            if not equations or self.are_satisfied(equations, motion | motion_of_other):
                continue
            for changed, fixed in ((claim, motion_of_other), (other, motion)):
                assert changed.right is not None and changed.values is not None
                side = self.memory.reading(changed.right)
                letters = [*letters_in(claim.right, other.right)]
                for edit in Nearness(self.meaning, self.known, letters, self.memory.shown).edits(side):
                    with suppress(*FAULTS, Meaningless):
                        new = motion_of(changed.values[0], self.meaning.of(edit.node), self.meaning)
                        if new and fixed and self.are_satisfied(equations, new | fixed):
                            return changed, edit
        return None

    def equations_of_both(self, one: Symbol, other: Symbol) -> list[Expr]:
        """Return the earlier equations with rates of one of two coordinates, and of no other coordinate; the list is
        empty if no equation contains both coordinates."""
        letters = {self.meaning.symbols[each].identity for each in (one, other) if each in self.meaning.symbols}
        found, are_coupled = [], False
        for equation, number in self.known.equations:
            moving = [self.meaning.symbols[each] for each in moving_letters(equation.free_symbols, self.meaning)]
            if number in self.known.conditions or not any(each.dots for each in moving):
                continue
            if {each.identity for each in moving} <= letters:
                found.append(equation)
                are_coupled = are_coupled or len({each.identity for each in moving}) == 2
        return found if are_coupled else []

    def are_satisfied(self, equations: Sequence[Expr], motion: dict[Symbol, Expr]) -> bool:
        values = [each.xreplace(motion) for each in equations]
        return all(any(is_zero(expanded(self.known, each, sure=sure)[0]) for sure in (True, False)) for each in values)

    def may_change(self, edit: Edit, claim: Claim, motion: Claim) -> bool:
        """Whether a change that an equation of motion suggests is probably right; in another part, a number may be
        different."""
        return self.belongs_to(claim, motion) or edit.kind in (*DISTINCT, "factor")

    def with_letters_of(self, equation: Expr, letters: Sequence[Letter]) -> list[Letter]:
        """Return the given letters and the letters of an equation, without those that have dots."""
        found = [self.meaning.symbols.get(each) for each in sorted(equation.free_symbols, key=str)]
        return [*letters, *(each for each in found if each is not None and not each.dots and each not in letters)]

    def belongs_to(self, claim: Claim, earlier: Claim) -> bool:
        """Whether an earlier row is in the same part as a claim, or the sentence of the claim refers to its label."""
        block = claim.row.block
        return earlier.row.block.part == block.part or earlier.row.label in REFERENCE.findall(block.sentence)

    def terms_before(self, claim: Claim) -> list[Node]:
        """Return the terms and the letters of the last claims in displays, up to this claim."""
        rows = [each for each in self.claims[: claim.number + 1] if each.row.block.display]
        sides = [side for each in reversed(rows[-MOST_ROWS:]) for side in (each.left, each.right) if side is not None]
        return terms_in(sides, self.memory.shown)

    def repeats_a_side(self, claim: Claim, node: Node) -> bool:
        """Whether a changed side repeats an earlier side of its chain: `a = b = a` says nothing."""
        value, before = self.meaning.of(node), claim.before
        while before is not None:
            if before.values is not None and value in before.values:
                return True
            before = before.before
        return False

    def suggest(self, claim: Claim, left_side: Node, verdict: Verdict) -> None:
        """Suggest the nearest change of the right side after which the claim holds, or else a lost term."""
        assert claim.right is not None and claim.values is not None
        right_node = self.memory.reading(claim.right)
        until = process_time() + SECONDS_OF_SEARCH
        if not self.find_edit(claim, claim.values[0], right_node, left_side, verdict, until):
            self.find_lost_term(claim, verdict)

    def find_lost_term(self, claim: Claim, verdict: Verdict) -> None:
        """Suggest a term of the left side that is missing on the right side."""
        at_place = any(isinstance(each, EvalBar) for each in claim.left.walk()) if claim.left is not None else False
        if claim.values is None or (claim.row.block.cues & SPECIAL and not at_place):
            return
        left, right = (self.memory.expanded(each) for each in claim.values)
        if isinstance(left, MatrixBase) or isinstance(right, MatrixBase) or right == 0:
            return
        lost = sympy.expand(left - right)
        terms = sympy.Add.make_args(sympy.expand(left))
        if lost in terms and len(terms) > 1 and lost.free_symbols & right.free_symbols:
            verdict.suggestion, verdict.why_plausible = f"with the term {lost}", "a term was lost"

    def find_edit(
        self,
        claim: Claim,
        left: Value,
        right_node: Node,
        left_side: Node,
        verdict: Verdict,
        until: float = float("inf"),
    ) -> bool:
        text = self.memory.document.source.text
        letters = {
            (each.identity, each.dots): each
            for side in (left_side, right_node)
            for each in side.walk()
            if isinstance(each, Letter)
        }
        expanded_left = self.memory.expanded(left)
        for symbol in left.free_symbols | expanded_left.free_symbols:
            if (letter := self.meaning.symbols.get(symbol)) is not None:
                letters.setdefault((letter.identity, letter.dots), letter)

        def is_right(node: Node) -> bool:
            if process_time() > until:
                return False
            for plain in PLAIN[:2]:
                meaning = self.memory.meaning_of(self.meaning.scope, plain)
                try:
                    value = meaning.of(node)
                    if isinstance(value, MatrixBase) != isinstance(left, MatrixBase):
                        continue
                    if same(left, value) or same(expanded_left, self.memory.expanded(value)):
                        return True
                except (Meaningless, *FAULTS):
                    continue
            return False

        edit = nearest_edit(
            right_node, list(letters.values()), is_right, lambda span: text[span.start : span.end].strip()
        )
        if edit is None:
            return False
        verdict.suggest(edit)
        return True

    def is_linear(self, claim: Claim) -> bool:
        assert claim.values is not None
        left, right = claim.values
        return isinstance(left, Expr) and isinstance(right, Expr) and is_linear(left - right, self.meaning)
