"""Whether a row that does not follow would follow after one small change. If it would, it probably contains a slip.

A change is tried with numbers, at points where the earlier equations hold. A row is reported as wrong if one
change makes it right at all points.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice

from sympy import Add as Add_
from sympy import Expr, Integral, Symbol, expand

from derive.audit.fingerprint import is_zero
from derive.audit.knowledge import Known
from derive.audit.numeric import NoNumber, Numbers, at, close
from derive.audit.points import OF_EITHER_SIGN, Surface
from derive.audit.slips import Edit, edits_of_side, with_term
from derive.audit.systems import (
    OF_RATES,
    equations_of,
    expanded,
    linearised,
    motion_of,
    moving_letters,
    rate_of_first_integral,
)
from derive.audit.time_limit import FAULTS
from derive.documents.meaning import Meaning, Meaningless
from derive.documents.syntax import Add, Der, Frac, Fun, Group, Letter, Mul, Node, Num, Root

POINTS = 3
SMALL = 1e-7  # the greatest relative error of an equation that holds
LEAST_TERM = 1e-4  # the size of the smallest term of a changed row, relative to the greatest
SMALLEST = 1e-6  # sides whose terms are smaller than this are not compared
MOST_CHANGES = 4000
MOST_TERMS = 60
MOST_TERMS_OF_EQUATION = 8
TOO_EASY = ("term", "extra factor")  # changes that are not tried in a special case, where x_0 cos(w t) may become x_0
Shown = Callable[..., str]


@dataclass
class Nearness:
    """The search for one change of a side after which a claim would follow."""

    meaning: Meaning
    known: Known
    letters: Sequence[Letter]
    shown: Shown
    written: bool = False  # whether only the equations that the document writes are used
    linear: bool = False  # whether the claim may hold to the first order in small letters
    terms: Sequence[Node] | None = None  # terms that may be lost; None if the row may hold in a special case only

    def points(self, letter: Symbol | None = None) -> list[Numbers]:
        """Return points where the earlier equations hold; `letter` is a letter whose own value is not used."""
        equations = equations_of(self.known, self.meaning, letter, sure=True, written=self.written)
        if self.linear:
            equations = linearised(equations, self.meaning)
        state = ("points", tuple(each.value for each in equations))
        if state not in self.known.kept:
            surface = Surface(equations, self.meaning).find(POINTS)
            # A row that later rows contradict is reported as wrong only if all other rows agree with each other.
            agree = [*surface.kept, *surface.special]
            places = set(self.known.instants)  # `x = x_0` may hold at the beginning only
            refused = [e for e in equations if e not in agree and e.name != OF_RATES and not places & set(e.claims)]
            self.known.kept[state] = [] if self.written and refused else surface.points
        return [
            Numbers(self.meaning, self.defined(letter), point, fixed)
            for point, fixed in enumerate(self.known.kept[state])
        ]

    @cached_property
    def bare(self) -> Numbers:
        """A point with numbers for the letters; earlier rows need not hold there."""
        return Numbers(self.meaning, lambda symbol: symbol, POINTS)

    def defined(self, letter: Symbol | None) -> Callable[[Symbol], Expr]:
        kept: dict[Symbol, Expr] = {}

        def value(symbol: Symbol) -> Expr:
            if symbol not in kept:
                kept[symbol] = symbol if symbol == letter else expanded(self.known, symbol, letter, sure=True)[0]
            return kept[symbol]

        return value

    def edits(self, side: Node, other: Node | None = None, complete: bool = True) -> list[Edit]:
        """Return the possible changes of a side."""
        if isinstance(side, Num):
            return []
        easy = self.terms is not None and complete
        found = [each for each in edits_of_side(side, self.letters, self.shown) if easy or each.kind not in TOO_EASY]
        if not self.written:  # r_0 may be the value of r in a special case
            found = [each for each in found if each.kind != "index" or ("_" in each.was and "_" in each.meant)]
        sides = {self.shown(each.span) for each in (side, other) if each is not None}
        at_rest = not any(each.dots for each in letters_in(side, other))
        for term in self.terms or () if easy else ():
            if self.shown(term.span) not in sides and not (at_rest and any(each.dots for each in letters_in(term))):
                found += with_term(side, term, self.shown)
        return sorted(islice(found, MOST_CHANGES), key=lambda each: each.cost)

    def of_claim(self, left: Node, right: Node, letter: Symbol | None, is_step: bool) -> Edit | None:
        """Return the cheapest change of a side after which a claim would follow; None if it already follows, or if no
        change is found."""
        points = self.points(letter)
        written = [self.meaning.symbol(each) for each in letters_in(left, right) if each.base not in OF_EITHER_SIGN]
        if len(points) < 2 or any(points[0].fixed.get(each) == 0 for each in written):
            return None  # if a letter of the claim vanishes, too many changes are possible
        functions = all(any(isinstance(each, Fun) for each in side.walk()) for side in (left, right))

        def holds(one: Node, other: Node) -> bool:
            with suppress(*FAULTS, NoNumber, Meaningless):
                if all(holds_at(p, one, other) for p in points):
                    identity = close(self.bare.of_node(one), self.bare.of_node(other))
                    # cosh(a + d) = cosh(a - d) is an equation for d, and no identity with a slip.
                    return is_step or not identity or (functions and self.meaning.of(one) != self.meaning.of(other))
            return False

        if holds(left, right):
            return None
        one, other = self.letters_behind(left, letter), self.letters_behind(right, letter)
        lost = [self.meaning.symbols.get(each) for each in one - other]
        moving = {each.identity for each in letters_in(right) if each.dots}
        # A coordinate whose rate is in the row is not zero, so its terms were lost.
        complete = other <= one and all(each is not None and each.identity in moving for each in lost) if is_step else (
            one | other <= set(points[0].fixed)
        )  # fmt: skip
        for edit, first in self.edits_of_both(left, right, complete):
            sides = (edit.node, right) if first else (left, edit.node)
            if holds(*sides) and any(shows_terms(point, *sides) for point in points):
                # A later row shows which of two roots is right.
                return None if not self.written and is_other_root(edit, left, right) else edit
        return None

    def of_value(self, side: Node, value: Expr) -> Edit | None:
        """Return the cheapest change after which a side would have a value; None if no change is found."""
        with suppress(*FAULTS, NoNumber, Meaningless):
            wanted = [(point, point.of(value)) for point in self.points()]
            for edit in self.edits(side) if len(wanted) > 1 else ():
                with suppress(*FAULTS, NoNumber, Meaningless):
                    if all(close(point.of_node(edit.node), number) for point, number in wanted):
                        return edit
        return None

    def lost_term(self, difference: Expr) -> Expr | None:
        """Return the missing term with which an equation would be a multiple of an earlier equation; None if no such
        term is found."""
        if self.terms is None or difference.has(Integral):
            return None
        wanted = expand(expanded(self.known, difference, sure=True)[0])
        count = len(Add_.make_args(wanted))
        if count < 2:
            return None
        rates = any(map(self.known.is_rate, difference.free_symbols))
        equations = equations_of(self.known, self.meaning, sure=True, written=self.written)
        for each in linearised(equations, self.meaning) if self.linear else equations:
            terms = Add_.make_args(expand(each.value))
            if len(terms) != count + 1 or len(terms) > MOST_TERMS_OF_EQUATION:
                continue
            for term in terms:
                ratio = Add_.make_args(wanted)[0] / term
                if any(map(self.is_rate, ratio.free_symbols)):
                    continue
                lost = expand(wanted - ratio * each.value)
                if not rates and not lost.free_symbols <= wanted.free_symbols:
                    continue  # at rest, or in another special case, terms are missing
                if not lost.is_Add and lost != 0 and -lost in map(expand, (ratio * other for other in terms)):
                    return -lost
        return None

    def is_rate(self, symbol: Symbol) -> bool:
        return self.known.is_rate(symbol) or symbol in self.meaning.derivatives

    def letters_behind(self, side: Node, letter: Symbol | None) -> set[Symbol]:
        """Return the letters of a side after substituting definitions, without `letter`."""
        value = self.defined(letter)
        found = [value(self.meaning.symbol(each)).free_symbols for each in letters_in(side)]
        behind: set[Symbol] = set().union(*found)
        return behind - {letter}

    def of_root(self, side: Node, letter: Symbol, equation: Expr) -> Edit | None:
        """Return the cheapest change after which a side would be a root of an equation for `letter`; None if no change
        is found."""
        value = self.defined(letter)

        def fixed(symbol: Symbol) -> Expr:  # a momentum counts as a number, because its definition contains rates
            return symbol if any(map(self.known.is_rate, value(symbol).free_symbols)) else value(symbol)

        points = [Numbers(self.meaning, fixed, point) for point in range(POINTS)]
        for edit in self.edits(side):
            try:
                for point in points:
                    root = point.of_node(edit.node)
                    found, elsewhere = (
                        at(equation, _at_root(point, letter, each)) for each in (root, 1.37 * root + 0.11)
                    )
                    if abs(found) > SMALL * abs(elsewhere):
                        break
                else:
                    return edit
            except (*FAULTS, NoNumber, Meaningless):
                continue
        return None

    def of_motion(self, side: Node, letter: Symbol, equation: Expr) -> Edit | None:
        """Return the cheapest change after which a motion x(t) would satisfy an equation; None if it satisfies the
        equation already, or if no change is found."""

        def satisfies(node: Node) -> bool:
            motion = motion_of(letter, self.meaning.of(node), self.meaning)
            at_motion = equation.xreplace(motion)
            # Another coordinate in the equation may have a motion from a sentence.
            return bool(motion) and any(
                is_zero(expanded(self.known, at_motion, sure=sure)[0]) for sure in (True, False)
            )

        for edit in (None, *self.edits(side)):
            with suppress(*FAULTS, Meaningless):
                if satisfies(edit.node if edit is not None else side):
                    return edit
        return None

    def of_first_integral(self, left: Node, right: Node) -> Edit | None:
        """Return the cheapest change after which the time derivative of an equation follows from the equations of
        motion; None if it follows already, or if no change is found."""
        points = self.points()
        if len(points) < 2 or not self.is_complete(self.meaning.of(left), self.meaning.of(right)):
            return None

        def is_conserved(one: Node, other: Node) -> bool:
            sides = self.meaning.of(one), self.meaning.of(other)
            rate = rate_of_first_integral(*sides, self.meaning, self.known)
            if rate is None or not any(map(self.is_acceleration, rate.free_symbols)):
                return False
            terms = Add_.make_args(expand(rate))
            return all(abs(p.of(rate)) <= SMALL * sum(abs(p.of(term)) for term in terms) for p in points)

        if is_conserved(left, right):
            return None
        for edit, first in self.edits_of_both(left, right, complete=False):
            with suppress(*FAULTS, NoNumber, Meaningless):
                if is_conserved(edit.node, right) if first else is_conserved(left, edit.node):
                    return None if is_other_root(edit, left, right) else edit
        return None

    def is_complete(self, left: Expr, right: Expr) -> bool:
        """Whether the equations of motion for the coordinates of an equation contain no other coordinate that is not
        constant."""
        rate = rate_of_first_integral(left, right, self.meaning, self.known)
        if rate is None:
            return False
        equations = equations_of(self.known, self.meaning, sure=True, written=self.written)
        moving = [set(moving_letters(each.value.free_symbols, self.meaning)) for each in equations]
        constant = {letter for letters in moving if len(letters) == 1 for letter in letters}
        accelerations = set(filter(self.is_acceleration, rate.free_symbols))
        needed = set().union(*(letters for letters in moving if letters & accelerations))
        return bool(needed) and needed - constant <= set(rate.free_symbols)

    def is_acceleration(self, symbol: Symbol) -> bool:
        letter = self.meaning.symbols.get(symbol)
        return letter is not None and letter.dots == 2

    def edits_of_both(self, left: Node, right: Node, complete: bool) -> Iterator[tuple[Edit, bool]]:
        both = [(each, False) for each in self.edits(right, left, complete)]
        if not isinstance(left, Letter):
            both += [(each, True) for each in self.edits(left, right, complete)]
        yield from sorted(both, key=lambda pair: pair[0].cost)


def _at_root(point: Numbers, letter: Symbol, value: complex) -> Callable[[Symbol], complex]:
    return lambda symbol: value if symbol == letter else point.basic(symbol)


def letters_in(*sides: Node | None) -> list[Letter]:
    found: dict[object, Letter] = {}
    for side in sides:
        for each in side.walk() if side is not None else ():
            if isinstance(each, Letter):
                found.setdefault((each.identity, each.dots), each)
    return list(found.values())


def is_other_root(edit: Edit, *sides: Node) -> bool:
    """Whether a change reverses the sign of a square root, or of the side that is equal to a square root.

    Either sign may be right, because the text may choose one of two solutions.
    """
    roots = [each.span.start for side in sides for each in side.walk() if isinstance(each, Root)]
    inside = any(edit.span.start <= each < edit.span.end for each in roots)
    return edit.kind == "sign" and bool(inside or (roots and any(edit.span == side.span for side in sides)))


def holds_at(point: Numbers, left: Node, right: Node) -> bool:
    """Whether two sides are equal at a point; False if all their terms are very small."""
    size = sum(abs(point.of_node(term)) for each in (left, right) for term in terms_of(each))
    return size >= SMALLEST and abs(point.of_node(left) - point.of_node(right)) <= SMALL * size


def shows_terms(point: Numbers, left: Node, right: Node) -> bool:
    """Whether each term of two sides is large enough at a point to be compared: x'^8 may be too small."""
    sizes = [abs(point.of_node(term)) for each in (left, right) for term in terms_of(each)]
    return all(each >= LEAST_TERM * max(sizes) for each in sizes if each)


def terms_of(side: Node) -> list[Node]:
    """Return the terms of a sum, also of a sum that is a factor, as in m l (x'' + g x)."""
    if isinstance(side, Group) and side.brackets != "|":
        return terms_of(side.inner)
    if isinstance(side, Add):
        return [inner for _, term in side.terms for inner in terms_of(term)]
    if isinstance(side, Frac):
        return [replace(side, top=term) for term in terms_of(side.top)]
    if isinstance(side, Mul):
        for i, (sign, factor) in enumerate(side.factors):
            inside = terms_of(factor)
            if len(inside) > 1:
                return [replace(side, factors=(*side.factors[:i], (sign, e), *side.factors[i + 1 :])) for e in inside]
    return [side]


def terms_in(sides: Sequence[Node], shown: Shown) -> list[Node]:
    """Return the terms and the letters of these sides."""
    found: dict[str, Node] = {}
    for side in sides:
        if not isinstance(side, Add | Num) and not any(isinstance(each, Der) for each in side.walk()):
            found.setdefault(shown(side.span), side)
        for each in side.walk():
            for _, term in each.terms if isinstance(each, Add) else ():
                if not any(isinstance(inner, Der) for inner in term.walk()):
                    found.setdefault(shown(term.span), term)
    for side in sides:
        for letter in letters_in(side):
            found.setdefault(shown(letter.span), letter)
    return list(found.values())[:MOST_TERMS]


__all__ = ["TOO_EASY", "Nearness", "letters_in", "terms_in"]
