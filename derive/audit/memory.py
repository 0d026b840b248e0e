"""What the audit remembers of the claims before the current one."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

import sympy
from sympy import Expr, MatrixBase, Symbol

from derive.audit.assumptions import Assumed
from derive.audit.claims import GOOD, Claim, Definition, Outcome, Verdict
from derive.audit.knowledge import ASSUMED, Known
from derive.audit.nearest_change import Nearness, holds_at, letters_in
from derive.audit.numeric import NoNumber
from derive.audit.reading import ENDS_SENTENCE, scope_of
from derive.audit.systems import (
    energies,
    expanded,
    moving_letters,
    rates,
)
from derive.audit.time_limit import FAULTS, LimitReached, time_limited
from derive.documents.choices import readings
from derive.documents.facts import Facts, shape_of
from derive.documents.layout import Cue, Document
from derive.documents.meaning import Meaning, Meaningless, Value
from derive.documents.source import Span
from derive.documents.syntax import (
    Letter,
    Node,
)

LEAST_SECONDS = 0.4  # the limit never falls below this number of seconds
SPECIAL = frozenset({Cue.GIVEN, Cue.PUT_IN, Cue.ZERO, Cue.APPROXIMATE})  # cues that explain why a row has fewer terms
GIVEN_UP = (LimitReached, RecursionError, Meaningless, NoNumber, *FAULTS)  # a test of a claim ends without a result


class Memory:
    """What the audit knows at one claim of a document: the claims before it, the meaning of the letters, and the
    definitions and equations of the current problem or section."""

    def __init__(self, document: Document, facts: Facts, assumed: Sequence[Assumed] = ()):
        self.document, self.facts, self.assumed = document, facts, assumed
        self.scope: int | None = None
        self.meaning = Meaning(facts)
        self.known = Known(self.meaning)
        self.scopes: dict[int, Known] = {}
        self.claims: list[Claim] = []
        self.explanations: dict[int, list[Claim]] = {}  # by the id of the block of a display
        self.lagrangians: dict[int, tuple[Expr, int]] = {}  # L = T - U, by the number of the claim that it precedes
        self.general: dict[int, bool] = {}  # whether a claim in a sentence always holds
        self.explained: set[int] = set()  # the numbers of claims that explain letters of the display before them

    def enter(self, claim: Claim) -> None:
        """Come to the next claim: find out which earlier claims are valid in its row."""
        self.claims.append(claim)
        scope = self.scope_of(claim)
        if scope != self.scope:
            self.begin(scope)
        self.explain(claim)
        self.known.sentence = self.claims_of_sentence(claim)
        self.known.here = self.conditions_here(claim)
        self.known.moving = frozenset(each.identity for each in letters_in(claim.left, claim.right) if each.dots)
        self.state_lagrangian(claim)

    def scope_of(self, claim: Claim) -> int:
        """Return the number of the heading that begins the problem or section of a claim."""
        return scope_of(self.document, claim.row)

    def reading(self, side: Node) -> Node:
        """Return the most probable reading of a side."""
        return readings(side, self.facts)[0][0]

    def begin(self, scope: int) -> None:
        """Begin a problem or section, and forget the definitions and equations of earlier problems and sections."""
        self.scope = scope
        self.meaning.scope = scope
        self.known = self.scopes[scope] = self.assumptions()

    def return_to(self, claim: Claim) -> None:
        """Return to the problem or section of a claim, with what is known at its end."""
        self.scope = self.meaning.scope = self.scope_of(claim)
        self.known = self.scopes[self.scope]

    def assumptions(self) -> Known:
        known = Known(self.meaning)
        for each in self.assumed:
            try:
                left, right = (self.meaning.of(self.reading(side)) for side in (each.left, each.right))
            except (Meaningless, *FAULTS):
                continue
            if isinstance(left, Symbol) and not isinstance(right, MatrixBase):
                known.assume(left, right)
            elif not isinstance(left, MatrixBase) and not isinstance(right, MatrixBase):
                known.state(sympy.expand(left - right), ASSUMED)
        return known

    def meaning_of(self, scope: int, plain: str = "") -> Meaning:
        """Return the meaning of letters in one scope; all scopes share the letters and derivatives of the document."""
        return Meaning(
            self.facts,
            derivatives=self.meaning.derivatives,
            symbols=self.meaning.symbols,
            parents=self.meaning.parents,
            defined=self.value_of,
            evaluations=self.meaning.evaluations,
            sums=self.meaning.sums,
            scope=scope,
            plain=plain,
        )

    def claims_of_sentence(self, claim: Claim) -> frozenset[int]:
        """Return the claims that precede a display in its sentence and have a good verdict: they hold, at least
        approximately, or define something."""
        found: list[int] = []
        block = claim.row.block
        for each in reversed(self.claims[:-1]) if block.display else ():
            if each.row.block is block:
                continue
            if each.row.block.display or ENDS_SENTENCE.search(self.shown(Span(each.row.span.end, block.span.start))):
                break
            if each.verdict is not None and each.verdict.outcome in GOOD:
                found.append(each.number)
        return frozenset(found)

    def conditions_here(self, claim: Claim) -> frozenset[int]:
        """Return the conditions before a display, in the same sentence, that are used in one of its rows: "with
        `r = l`, this becomes".

        A condition such as `x = 0` is not used in a row that contains `x`, because such a row is about other instants.
        An equation with a rate and several terms, such as `x' + R w = 0`, is used in any row.
        Conditions of equilibrium are used in each row of the same part that contains no rates.
        """
        written = {each.identity for each in letters_in(claim.left, claim.right)}
        conditions = [self.claims[each] for each in self.known.sentence & self.known.conditions - self.known.at_rest]
        here = {each.number for each in conditions if self.is_law(each) or written.isdisjoint(
            letter.identity for letter in letters_in(each.left)
        )}  # fmt: skip
        if any(each.dots for each in letters_in(claim.left, claim.right)):
            return frozenset(here)
        part = claim.row.block.part
        return frozenset(here | {each for each in self.known.at_rest if self.claims[each].row.block.part == part})

    def is_law(self, claim: Claim) -> bool:
        """Whether an equation has several terms, and the rate of a letter in at least one of them."""
        if claim.values is None or claim.left is None or any(isinstance(each, MatrixBase) for each in claim.values):
            return False
        value = sympy.expand(claim.values[0] - claim.values[1])
        rates = any(map(self.known.is_rate, value.free_symbols))
        return rates and len(sympy.Add.make_args(value)) > 1 and not isinstance(claim.left, Letter)

    def state_lagrangian(self, claim: Claim) -> None:
        """State L = T - U before the first display that gives a value to the Lagrangian L without T and U."""
        left = claim.left
        if not claim.row.block.display or claim.before is not None or not isinstance(left, Letter) or left.base != "L":
            return
        symbol, found = self.meaning.symbol(replace(left, dots=0)), energies(self.known)
        letters = {each.base for each in letters_in(claim.right)}
        if left.sub or left.dots or left.marks or letters & set("TKUV") or found is None:
            return
        if symbol not in self.known.definitions:
            kinetic, potential = found
            self.lagrangians[claim.number] = (symbol - kinetic.symbol + potential.symbol, potential.claim)
            self.known.state(symbol - kinetic.value + potential.value, max(kinetic.claim, potential.claim))

    def explain(self, claim: Claim) -> None:
        """Remember the values that the words after this display give to letters: `..., where rho = M/V`."""
        if claim.number in self.explained:
            self.known.forget(claim.number)
        for each in self.explanations.pop(id(claim.row.block), []):
            if each.is_step or each.relation not in ("=", ":=") or each.left is None or each.right is None:
                continue
            with suppress(*GIVEN_UP), time_limited(LEAST_SECONDS):
                letter, value = self.sides(each.left, self.reading(each.right), self.meaning)
                plain = isinstance(value, MatrixBase) or value.as_coeff_Mul()[1].is_Symbol or not value.free_symbols
                if isinstance(letter, Symbol) and not plain and self.known.latest(letter) is None:
                    self.explained.add(each.number)
                    self.known.define(letter, value, each.number, row=each.row, chain=each.number)

    def is_general(self, claim: Claim) -> bool:
        if claim.number not in self.general:
            self.general[claim.number] = self.holds_generally(claim)
        return self.general[claim.number]

    def holds_generally(self, claim: Claim) -> bool:
        """Whether a sentence states an equation that always holds: it restates a known value; or it has several terms,
        it is not the value of a letter without rates, and nothing near it may name a special case."""
        if not claim.row.block.display and self.restates(claim):
            return True
        if claim.values is None or claim.is_step or claim.row.block.display or claim.row.block.cues & SPECIAL:
            return False
        if any(isinstance(each, MatrixBase) for each in claim.values) or self.has_special_case(claim):
            return False
        left, right = claim.values
        is_value = left.as_base_exp()[0].is_Symbol or right.is_number
        has_rates = any(map(self.known.is_rate, left.free_symbols | right.free_symbols))
        count = sum(len(sympy.Add.make_args(sympy.expand(each))) for each in (left, right) if each != 0)
        if count < 2 or (is_value and not has_rates):
            return False
        return not self.may_be_special(claim) or not self.may_hold_specially(claim)

    def restates(self, claim: Claim) -> bool:
        """Whether a claim gives a letter with an index, or a power of it, a value with the same letters as its earlier
        value, so that it is probably not the value at another place. A letter without an index, as in N = m v^2/r + m g
        at the bottom and N = m v^2/r - m g at the top, often has two values.
        """
        if claim.values is None or claim.is_step or any(isinstance(each, MatrixBase) for each in claim.values):
            return False
        letter, value = claim.values[0].as_base_exp()[0], claim.values[1]
        earlier = self.known.surely(letter) if isinstance(letter, Symbol) else None
        named = self.meaning.symbols.get(letter)
        if earlier is None or named is None or named.dots or named.sub in ("", "0") or len(value.free_symbols) < 2:
            return False
        one, other = (expanded(self.known, each, letter, sure=True)[0] for each in (earlier.value, value))
        return set(one.free_symbols) == set(other.free_symbols)

    def has_special_case(self, claim: Claim) -> bool:
        """Whether the sentence of a claim begins with a value of a letter in one case: `With w_y = w, ...`."""
        block = claim.row.block
        earlier = [self.claims[each] for each in self.known.conditions if each < claim.number]
        here = [e for e in earlier if e.row.block.sentence == block.sentence and e.row.block.part == block.part]
        return any(each.values is not None and isinstance(each.values[0], Symbol) for each in here)

    def may_hold_specially(self, claim: Claim) -> bool:
        """Whether a claim may hold in the special cases that sentences of its part name; only numbers refute it."""
        left_side = self.last_good_side(claim)
        if Cue.APPROXIMATE in claim.row.block.cues or left_side is None or claim.right is None:
            return True
        part = claim.row.block.part
        here = {each for each in self.known.conditions if self.claims[each].row.block.part == part}
        with suppress(Meaningless, NoNumber, *FAULTS):
            known = replace(self.known, conditions=self.known.conditions - here, kept={})
            points = Nearness(self.meaning, known, [], self.shown).points()
            return len(points) < 2 or all(holds_at(each, left_side, claim.right) for each in points)
        return True

    def known_without(self, earlier: Claim, claim: Claim, before: bool = False) -> Known:
        """Return the definitions and equations that the rows up to `claim` give without the row `earlier`.

        before   whether `claim` itself gives nothing
        """
        kept, self.known = self.known, self.assumptions()
        try:
            for each in self.claims[: claim.number + 1]:
                if each is not earlier and self.scope_of(each) == self.scope:
                    if each.number in self.lagrangians:
                        self.known.state(*self.lagrangians[each.number])
                    if each is not claim or not before:
                        self.remember(each, believed=each is claim)
            return self.known
        finally:
            self.known = kept

    def shown(self, span: Span) -> str:
        return self.document.source.text[span.start : span.end].strip()

    def may_be_special(self, claim: Claim) -> bool:
        if Cue.APPROXIMATE in claim.row.block.cues:
            return True
        for each in reversed(self.claims[: claim.number]):
            if each.row.block.part != claim.row.block.part:
                break
            if each.row.block.display or each.values is None or each.row is claim.row:
                continue
            right = each.values[1]
            if each.relation not in ("=", ":=") or right.is_number:
                return True
            if isinstance(right, Symbol) and not self.known.is_rate(right):
                return True
        return False

    def expanded(self, value: Value) -> Value:
        found = list(self.known.expanded(value))
        return found[-1][0][0] if found else value

    def value_of(self, symbol: Symbol) -> Value | None:
        found = self.known.definitions.get(symbol)
        return found[-1].value if found else None

    def last_good_side(self, claim: Claim) -> Node | None:
        """Return the left side, or the nearest earlier side of the chain that has a value; None if there is none."""
        asked = claim
        while claim.before is not None and (
            claim.left is None or claim.before.right is None or claim.before.values is None
        ):
            if claim.before.left is None and claim.before.before is None:
                return None
            earlier = claim.before
            asked.from_head = earlier.before is None
            claim = earlier
        return claim.left

    def sides(self, left: Node, right: Node, meaning: Meaning) -> tuple[Value, Value]:
        for letter, other, first in ((left, right, True), (right, left, False)):
            shape = shape_of(other)
            if isinstance(letter, Letter) and shape is not None and any(
                isinstance(each, Letter) and each.identity == letter.identity for each in other.walk()
            ):  # fmt: skip
                value = Meaning(
                    self.facts,
                    derivatives=meaning.derivatives,
                    symbols=meaning.symbols,
                    plain="all",
                    scope=meaning.scope,
                ).of(other)
                named = meaning.components(letter, *shape)
                return (named, value) if first else (value, named)
        return meaning.of(left), meaning.of(right)

    def is_special_case(self, claim: Claim) -> bool:
        """Whether a sentence gives a letter a value in one case only: `if R = a/2`."""
        assert claim.values is not None
        left, right = claim.values
        block = claim.row.block
        if claim.relation not in ("=", ":="):
            return False
        simple = isinstance(left, Symbol) and left in self.known.seen and isinstance(right, sympy.Expr)
        return bool(simple and not block.display and Cue.GIVEN in block.cues and right.as_coeff_Mul()[1].is_Symbol)

    def is_condition(self, claim: Claim, verdict: Verdict, believed: bool = False) -> bool:
        """Whether a claim may hold in one case or at one instant only, as a formula in a sentence may."""
        if verdict.at_place:
            return True
        if believed and self.is_general(claim):
            return False
        if verdict.outcome in (Outcome.HOLDS, Outcome.APPROXIMATES):
            general = self.known.at_rest if claim.row.block.display else set()  # a root is a value, not a condition
            return bool((self.known.conditions - general) & set(verdict.given))
        if claim.row.block.display or claim.number in self.explained:
            return False
        if verdict.outcome is not Outcome.DEFINES or claim.values is None:
            return True
        letter, value = claim.values
        if isinstance(letter, Symbol) and self.is_time(letter):
            return True
        if value == 0 and letter.is_Symbol and letter.name in ("U", "V") and letter not in self.known.seen:
            return False  # the choice of the zero of a potential energy
        if not isinstance(letter, Symbol) or isinstance(value, MatrixBase) or value.is_number:
            return True
        if value.is_Symbol and claim.index + 1 < len(claim.statement.relations):
            return True  # `theta = phi = 0`
        if moving_letters(set(self.known.new_letters(value.free_symbols)), self.meaning):
            return False  # `r = r_0 + eta` introduces another coordinate
        if self.known.is_rate(letter) and moving_letters(value.free_symbols, self.meaning):
            return False  # an equation of motion
        return any(letter in equation.free_symbols for equation, _ in self.known.equations)

    def is_constant(self, claim: Claim) -> bool:
        """Whether a sentence gives a constant value to a coordinate: `x = a`."""
        if claim.values is None or claim.row.block.display or isinstance(claim.values[1], MatrixBase):
            return False
        letter, value = claim.values
        if not isinstance(letter, Symbol) or not moving_letters({letter}, self.meaning) or self.known.is_rate(letter):
            return False
        named = [self.meaning.symbols.get(each) for each in value.free_symbols]
        depends_on_time = any(each is None or each.base == "t" for each in named)
        return not depends_on_time and not moving_letters(value.free_symbols, self.meaning)

    def is_value_at_place(self, claim: Claim) -> bool:
        """Whether a display gives another value to a letter at the place or instant that its sentence names: `At the
        bottom, where theta = 0, N = 3 m g`."""
        if claim.values is None or claim.is_step or not claim.row.block.display:
            return False
        letter = claim.values[0]
        if not isinstance(letter, Symbol):
            return False
        if any(map(self.is_time, claim.values[1].free_symbols)):
            return False  # a motion with these initial values
        places = [each for each in self.known.sentence if each in self.known.conditions and self.is_place(each)]
        is_place = bool(moving_letters({letter}, self.meaning)) and not self.known.is_rate(letter)
        return bool(places) and (is_place or self.known.general_value(letter) is not None)

    def is_place(self, number: int) -> bool:
        """Whether a claim gives a constant value to a coordinate, or to the time."""
        values = self.claims[number].values
        is_time = values is not None and isinstance(values[0], Symbol) and self.is_time(values[0])
        return is_time or number in self.known.instants

    def is_time(self, symbol: Symbol) -> bool:
        named = self.meaning.symbols.get(symbol)
        return named is not None and named.base == "t" and not named.sub

    def is_equilibrium(self, claim: Claim) -> bool:
        """Whether an equation contains one coordinate and no rates, although earlier rows contain rates of this
        coordinate: it holds at an equilibrium only."""
        if claim.values is None or claim.relation != "=" or isinstance(claim.values[0], Symbol | MatrixBase):
            if claim.values is None or claim.values[0] not in self.meaning.derivatives:
                return False
        if isinstance(claim.values[1], MatrixBase):
            return False
        if any(map(self.known.is_rate, claim.values[0].free_symbols | claim.values[1].free_symbols)):
            return False
        value, _ = expanded(self.known, claim.values[0] - claim.values[1], sure=True)
        changing = moving_letters(value.free_symbols, self.meaning)
        if len(changing) != 1 or self.meaning.symbols[changing[0]].dots:
            return False
        rates = {replace(self.meaning.symbols[changing[0]], dots=dots) for dots in (1, 2)}
        return any(self.meaning.symbol(each) in self.known.seen for each in rates)

    def is_constant_length(self, claim: Claim) -> bool:
        """Whether a letter is a sum of multiples of coordinates, and the text calls it constant: `l = x + 2 y`."""
        assert claim.values is not None
        letter, value = claim.values
        if Cue.CONSTANT not in claim.row.block.cues or not isinstance(letter, Symbol) or isinstance(value, MatrixBase):
            return False
        moving = moving_letters(value.free_symbols, self.meaning)
        if not moving or moving_letters({letter}, self.meaning) or any(self.known.is_rate(each) for each in moving):
            return False
        return all(sympy.diff(value, each).is_number for each in moving)

    def remember(self, claim: Claim, believed: bool = False) -> None:
        """Remember the definitions, the equation or the bound that a claim gives for later rows."""
        if claim.values is None or claim.verdict is None:
            return
        if self.is_special_case(claim):
            letter, value = claim.values
            self.known.conditions.add(claim.number)
            self.known.special.setdefault(letter, []).append(Definition(letter, value, claim.number))
            return
        if self.is_condition(claim, claim.verdict, believed) or self.is_value_at_place(claim):
            self.known.conditions.add(claim.number)
        elif self.is_equilibrium(claim):
            self.known.conditions.add(claim.number)
            self.known.at_rest.add(claim.number)
        if self.is_constant(claim):
            self.known.instants[claim.number] = self.meaning.symbols[claim.values[0]].identity
            if len(claim.values[1].free_symbols) > 1:
                self.known.places.add(claim.number)
        self.known.seen |= claim.values[0].free_symbols | claim.values[1].free_symbols
        if claim.relation in ("<<", ">>"):
            small = claim.values[claim.relation == ">>"]
            if isinstance(small, Symbol):
                self.known.small[claim.number] = small
        if claim.relation not in ("=", ":="):
            start = claim
            while start.before is not None:
                start = start.before
            head, bound = start.values[0] if start.values is not None else None, claim.values[1]
            if isinstance(head, Symbol) and bound.is_number:
                self.known.bounds.append((head, claim.relation, bound, claim.number))
            return
        left, right = claim.values
        if claim.row.block.display and claim.verdict.outcome is Outcome.DEFINES and isinstance(left, Symbol):
            self.known.named.add(left)
        number = claim.number
        for rate in rates(claim.values[1], self.meaning, self.known) if self.is_constant_length(claim) else ():
            self.known.state(rate, number)
        first = claim
        while first.before is not None:
            first = first.before
        head = first.values[0] if first.values is not None else left
        wrong = claim.verdict.outcome is Outcome.DIFFERS and not believed
        pairs = [(head, right)] if not isinstance(head, MatrixBase) and not isinstance(right, MatrixBase) else []
        if isinstance(head, MatrixBase) and isinstance(right, MatrixBase) and head.shape == right.shape:
            pairs = list(zip(head, right, strict=True))
        for symbol, value in pairs:
            if isinstance(symbol, Symbol) and wrong:
                self.known.slips[symbol] = Definition(symbol, value, number)
            elif isinstance(symbol, Symbol) and claim.verdict.inherits is None:
                self.known.define(symbol, value, number, row=claim.row, chain=first.number)
                self.known.slips.pop(symbol, None)
        if believed and isinstance(left, MatrixBase) and isinstance(right, MatrixBase) and left.shape == right.shape:
            self.known.state(left - right, number)
        if wrong or any(isinstance(each, MatrixBase) for each in (head, left, right)):
            return
        if claim.verdict.outcome is Outcome.HOLDS and not claim.verdict.given and not isinstance(left, Symbol):
            return  # an identity gives nothing new
        if not claim.row.block.display and isinstance(left, Symbol) and right.is_number and right != 0:
            return  # a number in a sentence, such as `m = 2` for a drawing, is not used as an equation
        difference = sympy.expand(left - right) if sympy.count_ops(left - right) < 600 else left - right
        self.known.forced |= self.known.forced_coordinates(difference)
        self.known.state(difference, number)


class WithMemory:
    """A part of the audit that uses what is known at the current claim."""

    def __init__(self, memory: Memory):
        self.memory = memory

    @property
    def known(self) -> Known:
        return self.memory.known

    @property
    def meaning(self) -> Meaning:
        return self.memory.meaning

    @property
    def claims(self) -> list[Claim]:
        return self.memory.claims
