"""The verdict on an answer of a part: each statement is matched with one of the answers that the part asks for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import sympy
from sympy import Abs, Expr, Matrix, MatrixBase, MatrixSymbol, Rational, Symbol, acos, asin, atan, cos, sin, tan

from derive.algebra.dimensions import NUMBER
from derive.algebra.expressions import PLUS_MINUS, Relation
from derive.algebra.order import in_order
from derive.algebra.ranges import within
from derive.audit.slips import nearest_edit
from derive.audit.time_limit import FAULTS, LimitReached, time_limited
from derive.documents.meaning import Meaningless
from derive.documents.source import Source, Span
from derive.documents.syntax import Letter, Node, Num
from derive.documents.tokens import TooLarge
from derive.grading.comparing import DIFFERS, shown, verdict_of_entries, verdict_on_value
from derive.grading.decimals import components_of, figures_of, verdict_on_number, with_units
from derive.grading.key import Key, Number, Part, Target
from derive.grading.names import parts_of
from derive.grading.outcomes import Outcome, Verdict, best_of, share_of
from derive.grading.reading import Read, Reader, ReadStatement
from derive.grading.reading_latex import RELATIONS, latex_of
from derive.grading.relations import angle_of, give_the_same, verdict_on_equation_for, verdict_on_relation
from derive.grading.structure import are_equal, are_surely_equal
from derive.grading.typed_text import TypedStatement, Unread, typed

EQUALS = ("=", "~", ":=", "to")
SECONDS = 4.0  # seconds of processor time for one answer


@dataclass(frozen=True)
class Graded:
    """The verdict on an answer of a part, the verdict on each answer that the part asks for, and the points."""

    part: str
    answer: str
    verdict: Verdict
    each: tuple[Verdict, ...] = ()
    points: Fraction = Fraction(0)
    most: Fraction = Fraction(0)


def grade(answer: str, part: Part, key: Key, seconds: float = SECONDS) -> Graded:
    """Grade an answer. If the answer is not readable or takes too long, the verdict says so."""
    most = sum((target.whole for target in part.targets), Fraction(0))
    try:
        with time_limited(seconds), within(key.ranges), in_order(key.order):
            return replace(_Grading(answer, part, key).graded(), most=most)
    except Unread as error:
        verdict = Verdict(Outcome.UNREADABLE, error.message, marked=_marked(error))
    except TooLarge:
        verdict = Verdict(Outcome.UNREADABLE, "too large: the answer has too many tokens")
    except LimitReached:
        verdict = Verdict(Outcome.UNREADABLE, f"too large: it takes more than {seconds:g} s to compare")
    except RecursionError:
        verdict = Verdict(Outcome.UNREADABLE, "too large: it is nested too deeply")
    except MemoryError:
        verdict = Verdict(Outcome.UNREADABLE, "too large: it takes too much memory")
    except FAULTS as error:
        verdict = Verdict(Outcome.UNREADABLE, f"it cannot be compared: {str(error)[:80] or type(error).__name__}")
    return Graded(part.label, answer, verdict, (), Fraction(0), most)


def _marked(error: Unread) -> str:
    """Return the line of the answer with a caret under the place of the error."""
    if error.source is None or error.span is None:
        return ""
    place = error.source.place(error.span)
    text = place.text.rstrip("\n").replace("\t", " ")
    start = max(0, place.column - 40)
    width = min(max(1, place.width), 40, max(1, len(text) - place.column + 1))
    return f"{text[start : start + 80]}\n{' ' * (place.column - 1 - start)}{'^' * width}"


@dataclass
class _Statement:
    """A statement with its readings, and the text of each side, from which numbers with units are read."""

    read: ReadStatement | None
    texts: tuple[str, ...]
    relations: tuple[str, ...]
    fault: Unread | None = None
    head: tuple[Read, ...] = ()  # the readings of the first side, if another side cannot be read

    @property
    def last(self) -> tuple[Read, ...]:
        return self.read.sides[-1] if self.read is not None else ()

    @property
    def first(self) -> tuple[Read, ...]:
        return self.read.sides[0] if self.read is not None else self.head

    @property
    def is_single(self) -> bool:
        return not self.relations

    @property
    def is_equation(self) -> bool:
        return all(each in EQUALS for each in self.relations)

    @property
    def name(self) -> Any:
        """The letter before the first relation sign, if the left side is only a letter or its magnitude; else None."""
        if self.is_single or not self.first:
            return None
        left = self.first[0].value
        for each in self.first:  # `x(t)` is read as a function, and as a product
            left = each.value if isinstance(each.value, Symbol) else left
        if isinstance(left, Abs):
            left = left.args[0]
        if isinstance(left, sympy.Pow) and left.exp == sympy.Rational(1, 2):
            return None
        return left if isinstance(left, Symbol | MatrixSymbol) else None


class _Grading:
    def __init__(self, answer: str, part: Part, key: Key):
        self.answer, self.part, self.key = answer, part, key
        self.reader = Reader(key.names, key.wholes)
        self.left_out: list[str] = []
        self.cache: dict[tuple[int, str], Verdict] = {}

    def graded(self) -> Graded:
        written = typed(self.answer, self.key.names)
        self.text = written.source.text
        try:
            statements = self.statements(written)
        except Unread as error:
            error.source = written.source
            raise
        self.remarks = [*written.notes, *dict.fromkeys(note for each in statements for note in self.notes_of(each))]
        self.remarks += [f"the left side `{each}` is ignored; only the right side is graded" for each in self.left_out]
        found = self.matched(statements)
        return self.summed(found, statements)

    def notes_of(self, statement: _Statement) -> Iterator[str]:
        for side in statement.read.sides if statement.read is not None else ():
            yield from side[0].notes

    def statements(self, written: Any) -> list[_Statement]:
        found = []
        for each in written.statements:
            texts = tuple(self.text_of(side.span, written.source) for side in each.sides)
            try:
                read = ReadStatement(tuple(self.reader.side(side) for side in each.sides), each.relations, each)
                found.append(_Statement(read, texts, each.relations))
            except Unread as error:
                if (alone := self.without_left_side(each, texts)) is not None:
                    found.append(alone)
                    continue
                if next(with_units(texts[-1]), None) is None:
                    raise
                found.append(_Statement(None, texts, each.relations, error, self.head_of(each)))
        count = len(self.part.targets)
        if len(found) > count:
            found = self.with_own_letters(found)
        if len(found) < count:
            found = [one for each in found for one in self.of_each_name(each)]
        found = self.with_results_of_others(found)
        vectors = [self.entries_of(each) for each in found]
        if len(found) < count and not any(_has_two_signs(each.value) for each in self.part.targets):
            found = [one for each in found for one in self.of_each_sign(each)]
        if len(found) == 1 and vectors[0] and count > 1 and not any(t.scaled or _is_list(t) for t in self.part.targets):
            return vectors[0]
        return found

    def with_own_letters(self, statements: list[_Statement]) -> list[_Statement]:
        """Leave out statements that only define a letter of another statement, as in `2 pi/w, w = sqrt(g/l)`, and
        substitute these definitions in the other statements."""
        asked = [target.symbol for target in self.part.targets]
        found = statements
        for own in map(self.solved_for_letter, statements):
            name = own.name
            others = [each for each in found if each.read is None or own.read is None or (
                each.read.written is not own.read.written
            )]  # fmt: skip
            if own.read is None or own.relations != ("=",) or name is None or name in asked:
                continue
            sides = [side for each in others if each.read is not None for side in each.read.sides]
            if not any(name in read.value.free_symbols for side in sides for read in side):
                continue
            value = own.last[0]
            if not isinstance(value.value, Expr) or name in value.value.free_symbols:
                continue
            found = [self.put_in(each, name, value) for each in others]
        return found

    def solved_for_letter(self, statement: _Statement) -> _Statement:
        """Return `w = sqrt(g/l)` for `w^2 = g/l`, if the problem has no w."""
        if statement.read is None or statement.relations != ("=",):
            return statement
        left = statement.first[0]
        if not isinstance(left.value, sympy.Pow) or left.value.exp != 2:
            return statement
        if left.value.base not in left.unknown or not isinstance(statement.last[0].value, Expr):
            return statement
        right = replace(statement.last[0], value=sympy.sqrt(statement.last[0].value))
        sides = ((replace(left, value=left.value.base),), (right,))
        return replace(statement, read=replace(statement.read, sides=sides))

    def of_each_name(self, statement: _Statement) -> list[_Statement]:
        """Return a statement; for a chain of equations, also return an equation for each answer named inside the chain:
        `x'' = -y'' = a` also gives `y'' = -a`."""
        asked = [target.symbol for target in self.part.targets]
        found = [statement]
        if statement.read is None or not statement.is_equation:
            return found
        for side in statement.read.sides[1:-1]:
            for sign, name in ((1, side[0].value), (-1, -side[0].value)):
                if name in asked:
                    last = tuple(replace(each, value=sign * each.value) for each in statement.last)
                    sides = ((replace(side[0], value=name),), last)
                    found.append(_Statement(
                        ReadStatement(sides, ("=",), statement.read.written), statement.texts[-1:], ("=",)
                    ))  # fmt: skip
        return found

    def with_results_of_others(self, statements: list[_Statement]) -> list[_Statement]:
        """Return the statements after the results of other statements are substituted: with `x'' = a`, `y'' = -x''`
        becomes `y'' = -a`."""
        if any(target.is_relation for target in self.part.targets):
            return statements
        allowed = {each for target in self.part.targets for each in getattr(target.value, "free_symbols", ())}
        found = list(statements)
        for own in statements:
            if own.name is None or own.name in allowed or own.relations != ("=",) or len(statements) < 2:
                continue
            value = own.last[0] if own.last else None
            if value is not None and isinstance(value.value, Expr) and own.name not in value.value.free_symbols:
                found = [each if each.name == own.name else self.put_in_right(each, own.name, value) for each in found]
        return found

    def put_in_right(self, statement: _Statement, name: Symbol, value: Read) -> _Statement:
        """Replace a letter by its value; in an equation, only in the right side."""
        new = self.put_in(statement, name, value)
        if statement.read is None or new.read is None or statement.is_single or new.read == statement.read:
            return new
        sides = (*statement.read.sides[:-1], new.read.sides[-1])
        return replace(new, read=replace(new.read, sides=sides))

    @staticmethod
    def put_in(statement: _Statement, name: Symbol, value: Read) -> _Statement:
        if statement.read is None:
            return statement

        def new(read: Read) -> Read:
            if name not in read.value.free_symbols:
                return read
            unknown = tuple(each for each in (*read.unknown, *value.unknown) if each != name)
            return replace(read, value=read.value.xreplace({name: value.value}), unknown=unknown)

        sides = tuple(tuple(map(new, side)) for side in statement.read.sides)
        return replace(statement, read=replace(statement.read, sides=sides))

    def without_left_side(self, written: TypedStatement, texts: tuple[str, ...]) -> _Statement | None:
        """Return the right side of an equation whose left side cannot be read, such as `d²U/dy²|(y = y_0)`. Return None
        if the right side cannot be read either, if the statement is not a single equation, or if a relation is asked
        for."""
        if written.relations != ("=",) or any(target.is_relation for target in self.part.targets):
            return None
        try:
            right = self.reader.side(written.sides[1])
        except Unread:
            return None
        self.left_out.append(texts[0])
        return _Statement(ReadStatement((right,), (), written), texts[1:], ())

    def head_of(self, written: TypedStatement) -> tuple[Read, ...]:
        """Return the readings of the left side of a statement such as `v = 3 m/s`; () if this side is missing or
        unreadable."""
        if len(written.sides) < 2:
            return ()
        try:
            return self.reader.side(written.sides[0])
        except Unread:
            return ()

    @staticmethod
    def of_each_sign(statement: _Statement) -> list[_Statement]:
        """Return a statement with ± as two statements, and any other statement alone."""
        if statement.read is None or not any(
            _has_two_signs(read.value) for side in statement.read.sides for read in side
        ):
            return [statement]

        def signed(sign: int) -> _Statement:
            assert statement.read is not None
            put_in = {PLUS_MINUS: sympy.Integer(sign)}
            sides = tuple(
                tuple(replace(read, value=read.value.xreplace(put_in)) for read in side)
                for side in statement.read.sides
            )
            return replace(statement, read=replace(statement.read, sides=sides))

        return [signed(1), signed(-1)]

    def entries_of(self, statement: _Statement) -> list[_Statement]:
        if not statement.is_single or not statement.last or not isinstance(statement.last[0].value, MatrixBase):
            return []
        read = statement.last[0]
        return [_Statement(ReadStatement(((replace(read, value=entry),),), ()), ("",), ()) for entry in read.value]

    @staticmethod
    def text_of(span: Span, source: Source) -> str:
        if not source.origins or span.end <= span.start:
            return ""
        last = source.origins[span.end - 1]
        ends = next((each for each in source.origins[span.end :] if each > last), len(source.written))
        return source.written[source.origins[span.start] : ends].strip(" \n\t$.,;")

    # --- which statement answers which question -----------------------------------------------------------------------

    def matched(self, statements: list[_Statement]) -> dict[str, tuple[Verdict, list[_Statement]]]:
        targets = list(self.part.targets)
        found: dict[str, tuple[Verdict, list[_Statement]]] = {}
        rest = list(statements)
        for target in [each for each in targets if isinstance(each.symbol, MatrixBase) and not each.of_set]:
            if (listed := self.of_list(rest, target)) is not None:
                found[target.key] = listed
                rest = [each for each in rest if each not in listed[1]]
        for target in [each for each in targets if each.of_set]:
            if (of_set := self.of_set(rest, target)) is not None:
                verdict, used = of_set
                found[target.key] = (replace(verdict, target=target.key), used)
                rest = [each for each in rest if each not in used]
        for statement in list(rest):
            named = [each for each in targets if each.key not in found and self.is_named(statement, each)]
            if len(named) == 1:
                found[named[0].key] = (self.verdict(statement, named[0]), [statement])
                rest.remove(statement)
        found = self.renumbered(found)
        open_targets = [each for each in targets if each.key not in found]
        pairs = sorted(
            ((self.verdict(s, t), i, t.key) for i, s in enumerate(rest) for t in open_targets),
            key=lambda each: (each[0].rank, each[1]),
        )
        if (together := self.as_system(open_targets, rest)) is not None:
            self.left_over = []
            return found | together
        taken: set[int] = set()
        for verdict, i, name in pairs:
            if i not in taken and name not in found:
                taken.add(i)
                found[name] = (verdict, [rest[i]])
        self.left_over = [each for i, each in enumerate(rest) if i not in taken]
        return found

    def as_system(
        self, targets: list[Target], statements: list[_Statement]
    ) -> dict[str, tuple[Verdict, list[_Statement]]] | None:
        """Judge equations of motion together: other equations are right if they give the same accelerations. Return
        None if they give other accelerations, if each equation is right alone, or if they cannot be judged together.
        """
        if not 1 < len(targets) == len(statements) or not all(target.is_relation for target in targets):
            return None
        alone = [any(self.verdict(one, target).is_right for one in statements) for target in targets]
        if all(alone) or any(one.is_single or not one.is_equation or one.read is None for one in statements):
            return None
        typed_ones = [Relation(one.first[0].value, "=", one.last[0].value) for one in statements]
        if not give_the_same(typed_ones, [target.value for target in targets]):
            return None
        verdict = Verdict(Outcome.EQUAL, "the equations together are equivalent to the equations of the problem")
        return {
            target.key: (self.with_reading(replace(verdict, target=target.key), one, one.last[0]), [one])
            for target, one in zip(targets, statements, strict=True)
        }

    def is_named(self, statement: _Statement, target: Target) -> bool:
        name = statement.name
        return name is not None and _is_letter(target) and str(name) == target.symbol.name

    def renumbered(self, found: dict[str, Any]) -> dict[str, Any]:
        """Accept right values whose names are numbered in another order, such as omega_1 and omega_2, if the shapes of
        the modes are numbered in the same order."""
        for pairs in _numbered_alike([each for each in self.part.targets if each.key in found]):
            values = [pair for pair in pairs if isinstance(pair[0].symbol, Symbol)]
            wrong = [pair for pair in values if all(found[each.key][0].outcome is Outcome.ANOTHER for each in pair)]
            moved = [*wrong, *(pair for pair in pairs if pair not in values)] if wrong or not values else []
            swapped = [(a, b, self.verdict(found[b.key][1][0], a)) for pair in moved for a, b in (pair, pair[::-1])]
            if not all(verdict.is_right for *_, verdict in swapped):
                continue
            statements = {a.key: found[a.key][1] for a, *_ in swapped}
            for a, b, verdict in swapped:
                one, other = sorted((shown(a.symbol, self.key), shown(b.symbol, self.key)))
                told = f"if {one} and {other} are numbered the other way round"
                found[a.key] = (replace(verdict, outcome=Outcome.CONVENTION, because=told), statements[b.key])
        return found

    def of_list(self, statements: list[_Statement], target: Target) -> tuple[Verdict, list[_Statement]] | None:
        """Judge the entries of a list that several statements give by name, such as `r = ..., theta = ...`; None unless
        exactly one statement gives each entry."""
        used = []
        for symbol in target.symbol:
            base = parts_of(str(symbol))[0]
            named = [each for each in statements if each.name is not None and parts_of(str(each.name))[0] == base]
            if len(named) != 1 or not named[0].last or not isinstance(named[0].last[0].value, Expr):
                return None
            used += named
        read = replace(used[0].last[0], value=Matrix([each.last[0].value for each in used]))
        return replace(verdict_on_value(read, target, self.key), target=target.key), used

    def of_set(self, statements: list[_Statement], target: Target) -> tuple[Verdict, list[_Statement]] | None:
        """Judge a set of values, such as the principal moments, that one or several statements give; None if no
        statement gives a value.
        """
        names = {each: i for i, each in enumerate(target.symbol)}
        used, values = [], []
        for statement in statements:
            if not statement.last or not statement.is_equation:
                continue
            value = statement.last[0].value
            given = [side[0].value for side in (statement.read.sides[:-1] if statement.read else ())]
            if isinstance(value, MatrixBase):
                if value.shape[1] == 1 and len(value) == len(target.value) and statement.is_single:
                    return self.verdict(statement, target), [statement]
                continue
            if given and not any(each in names for each in given):
                continue
            used.append(statement)
            values += [value] * max(1, len(given))
        if not values:
            return None
        wanted = list(target.value)
        if len(values) < len(wanted):  # a value that occurs twice may be given once
            distinct = list(dict.fromkeys(wanted))
            values = _repeated(values, distinct, wanted)
        if len(values) != len(wanted):
            return Verdict(
                Outcome.MISSING, f"the part asks for {len(wanted)} values, but the answer gives {len(values)}"
            ), used
        read = replace(used[0].last[0], value=Matrix(values))
        return verdict_on_value(read, target, self.key), used

    # --- one statement and one answer ---------------------------------------------------------------------------------

    def verdict(self, statement: _Statement, target: Target) -> Verdict:
        known = self.cache.get((id(statement), target.key))
        if known is None:
            known = replace(self.compared(statement, target), target=target.key)
            self.cache[id(statement), target.key] = known
        return known

    def compared(self, statement: _Statement, target: Target) -> Verdict:
        number = self.as_number(statement, target)
        if number is not None and number.is_right:
            return number
        if statement.read is None:
            if number is not None:
                return number
            assert statement.fault is not None
            raise statement.fault
        found = self.as_relation(statement, target) if target.is_relation else self.as_value(statement, target)
        rounded = found.is_right and not _is_plain_decimal(statement.texts[-1])  # such as arccos(0.93)
        if number is not None and (number.rank <= found.rank or not (_has_letters(statement) or rounded)):
            return number
        return found

    def as_value(self, statement: _Statement, target: Target) -> Verdict:
        if not statement.is_equation:
            return Verdict(Outcome.DIFFERENT, "a condition is typed, but a value is asked for")
        verdicts: list[Verdict] = []
        if not statement.is_single and statement.name is None:
            for left in statement.first[:2]:
                for right in statement.last[:3]:
                    found = verdict_on_equation_for(left, right, target, self.key)
                    if found is not None:
                        verdicts.append(self.with_reading(found, statement, right))
        for read in statement.last:
            if verdicts and min(each.rank for each in verdicts) == 0:
                break
            verdicts.append(self.with_reading(verdict_on_value(read, target, self.key), statement, read))
            if verdicts[-1].is_right:
                break
        found = best_of(verdicts)
        if found.is_right and (side := self.unequal_side(statement)) is not None:
            told = (
                f"one side of the equation is not equal to the last side: {latex_of(side.node, self.key.names)[:160]}"
            )
            return replace(found, outcome=Outcome.DIFFERENT, because=told)
        if found.because == DIFFERS and len(self.part.targets) == 1:
            return found.adding(self.nearest(statement.last[0], target))
        return found

    def nearest(self, read: Read, target: Target) -> str:
        """Return the single change that would make a formula right, as the audit of documents finds it; else ""."""
        if not isinstance(target.value, Expr) or not isinstance(read.value, Expr) or read.unknown:
            return ""
        letters = {each.identity: each for each in read.node.walk() if isinstance(each, Letter)}

        def is_right(node: Node) -> bool:
            try:
                return are_surely_equal(self.reader.value(node).value, target.value)
            except (Meaningless, *FAULTS):
                return False

        try:
            with time_limited(SECONDS / 4):
                edit = nearest_edit(read.node, list(letters.values()), is_right, self.text_at)
        except LimitReached:
            return ""
        if edit is None:
            return ""
        change = f"with {edit.meant} instead of {edit.was}" if edit.meant else f"without {edit.was}"
        return f"it would be right {change}"

    def text_at(self, span: Span) -> str:
        return self.text[span.start : span.end].strip()

    def unequal_side(self, statement: _Statement) -> Read | None:
        """Return a side of an equation, other than a name, that differs from the last side; None if no side does. A
        side is not compared if it has no letters, or letters that the last side lacks. In a chain of more than two
        sides, the first side is not compared."""
        if statement.is_single or statement.read is None:
            return None
        first = 0 if statement.name is None and len(statement.read.sides) == 2 else 1
        last = statement.last
        for side in statement.read.sides[first:-1]:
            values = [each.value for each in side]
            known = all(isinstance(each, Expr) and each.free_symbols <= _free(last) for each in values)
            if known and values[0].free_symbols and not isinstance(values[0], Symbol) and not any(
                are_equal(value, other.value) for value in values for other in last if isinstance(other.value, Expr)
            ):  # fmt: skip
                return side[0]
        return None

    def as_relation(self, statement: _Statement, target: Target) -> Verdict:
        goal = target.value
        asked = "an equation" if goal.operator == "=" else "a condition"
        verdicts: list[Verdict] = []
        if statement.is_single:
            for read in statement.last:
                zero = Read(Num(Span(0, 0), "0"), sympy.Integer(0))
                if not isinstance(read.value, Expr):
                    return Verdict(Outcome.DIFFERENT, f"it is a vector or a matrix, but {asked} is asked for")
                if isinstance(goal.left, Symbol) and not goal.right.has(goal.left):
                    alone = replace(
                        target, symbol=goal.left, value=goal.right, dimension=self.key.dimensions.get(goal.left)
                    )
                    found = verdict_on_value(read, alone, self.key)
                    if found.is_right and goal.operator != "=":
                        found = Verdict(Outcome.CONVENTION, f"as the limiting case of the condition {target.text}")
                    verdicts.append(self.with_reading(found, statement, read))
                elif (
                    goal.operator == "=" and isinstance(goal.left, sympy.Function) and are_equal(read.value, goal.right)
                ):
                    found = Verdict(Outcome.CONVENTION, f"as the right side of {target.text}")
                    verdicts.append(self.with_reading(found, statement, read))
                elif isinstance(read.value, acos | asin | atan) and isinstance(goal.left, cos | sin | tan):
                    angle = Read(read.node, goal.left.args[0])
                    verdicts.append(
                        self.with_reading(verdict_on_relation(angle, "=", read, target, self.key), statement, read)
                    )
                elif goal.operator == "=":
                    found = verdict_on_relation(read, "=", zero, target, self.key)
                    verdicts.append(
                        self.with_reading(found.adding("read as an equation whose other side is zero"), statement, read)
                    )
        else:
            mark = next((each for each in statement.relations if each not in EQUALS), "=")
            for left in statement.first[:3]:
                for right in statement.last[:4]:
                    found = verdict_on_relation(left, mark, right, target, self.key)
                    verdicts.append(self.with_reading(found, statement, right, left))
                    if found.is_right:
                        return verdicts[-1]
        if not verdicts:
            return Verdict(Outcome.DIFFERENT, f"{asked} is asked for, but a value is given")
        return best_of(verdicts)

    def as_number(self, statement: _Statement, target: Target) -> Verdict | None:
        """Judge a number, with or without a unit. Return None if the statement is not compared as a number, for example
        if the problem gives no number, or if the number is zero without a unit.
        """
        if target.is_relation and (angle := angle_of(target, self.angle_in(statement, target))) is not None:
            target = angle
        if not statement.is_equation and not target.is_relation:
            return None
        of_function = target.is_relation and statement.first and statement.first[0].value == target.value.left
        if not statement.is_single and statement.name is None and statement.read is not None and not of_function:
            return None
        if target.number is None:
            return self.as_components(statement, target) if target.numbers else None
        text = statement.texts[-1]
        for number, unit in with_units(text):
            try:
                inner = typed(number, self.key.names).statements
                reads = self.reader.side(inner[0].sides[0])
            except Unread:
                continue
            read = next((each for each in reads if each.value.is_number), None)
            if read is not None and len(inner) == 1:
                shown = f"{latex_of(read.node, self.key.names)}\\,\\mathrm{{{unit.text}}}"
                found = self.of_number(read, number, unit, target, target.number)
                return self.with_direction(replace(found, reading=self.named(statement, shown)), statement, target)
        for read in statement.last:
            if read.value == 0:
                return None  # zero needs no unit and is compared exactly
            if isinstance(read.value, Expr) and read.value.is_number and (read.decimals or target.number.unit or
                                                                          isinstance(read.node, Num)):  # fmt: skip
                found = self.of_number(read, text, None, target, target.number)
                found = replace(found, reading=self.named(statement, latex_of(read.node, self.key.names)))
                return self.with_direction(found, statement, target)
        return None

    @staticmethod
    def angle_in(statement: _Statement, target: Target) -> Any:
        """The name of a typed angle. A number without a name is the angle in `cos(theta) = 2/3` if it has a unit of
        angle."""
        arguments = target.value.left.args
        if statement.is_single and arguments:
            unit = next((unit for _, unit in with_units(statement.texts[-1])), None)
            if unit is not None and unit.dimension == NUMBER and unit.angles:
                return arguments[0]
        return statement.name

    def as_components(self, statement: _Statement, target: Target) -> Verdict | None:
        """Judge a vector of decimals, with or without a unit. Return None if no such vector is typed, or if all its
        components are zero and no unit is typed.
        """
        text = statement.texts[-1]
        number, unit = next(with_units(text), (text, None))
        components = components_of(number, len(target.numbers))
        if not components or (unit is None and not any(map(Rational, components))):
            return None  # zero needs no unit and is compared exactly
        verdicts = [
            verdict_on_number(value, True, figures_of(each), unit, target, right, _places(value, each))
            for each, right in zip(components, target.numbers, strict=True)
            for value in [Rational(each)]
        ]
        shown = f"({', '.join(components)})" + (f"\\,\\mathrm{{{unit.text}}}" if unit else "")
        found = verdict_of_entries(verdicts, target.value.shape)
        return replace(found, reading=self.named(statement, shown))

    def with_direction(self, found: Verdict, statement: _Statement, target: Target) -> Verdict:
        if not target.is_relation or not found.is_right or target.value.operator == "=":
            return found
        mark, goal = statement.relations[-1] if statement.relations else "", target.value.operator
        if mark in ("", "=", "~"):
            told = f"as the limiting case of the condition {target.text}"
            return replace(found, outcome=Outcome.CONVENTION, because=told)
        if mark[0] != goal[0]:
            is_turned = {mark[0], goal[0]} == {"<", ">"}
            told = "the inequality has the wrong direction" if is_turned else "it is another condition"
            return replace(found, outcome=Outcome.SIGN, because=told)
        if mark != goal:
            told = "the limiting case itself is not judged"
            return replace(found, outcome=Outcome.CONVENTION, because=told)
        return found

    def of_number(self, read: Read, text: str, unit: Any, target: Target, number: Number) -> Verdict:
        single = len(read.decimals) <= 1 and _is_plain_decimal(text)
        places = _places(read.value, text) if single else 0
        figures = figures_of(text) if single else 0
        return verdict_on_number(read.value, single, figures, unit, target, number, places)

    # --- what is shown ------------------------------------------------------------------------------------------------

    def with_reading(self, verdict: Verdict, statement: _Statement, right: Read, left: Read | None = None) -> Verdict:
        shown = latex_of(right.node, self.key.names)
        return replace(verdict, reading=self.named(statement, shown, left))

    def named(self, statement: _Statement, shown: str, left: Read | None = None) -> str:
        """Return the reading of a whole statement; `shown` is the reading of its last side, and `left`
        is the reading of its first side."""
        if statement.is_single or not statement.first:
            return shown
        middle = statement.read.sides[1:-1] if statement.read is not None else ()
        before = [left or statement.first[0], *(side[0] for side in middle)]
        if len(before) != len(statement.relations):
            return shown
        texts = [latex_of(each.node, self.key.names) for each in before]
        marks = [RELATIONS.get(each, each) for each in statement.relations]
        return " ".join(text for pair in zip([*texts], marks, strict=True) for text in pair) + f" {shown}"

    def reading_of(self, statement: _Statement) -> str:
        if statement.read is None:
            return statement.texts[-1]
        return self.named(statement, latex_of(statement.last[0].node, self.key.names))

    def summed(self, found: dict[str, tuple[Verdict, list[_Statement]]], statements: Sequence[_Statement]) -> Graded:
        targets = self.part.targets
        verdicts = [found[each.key][0] for each in targets if each.key in found]
        points = sum(
            (share_of(found[t.key][0].outcome, t.own, t.whole) for t in targets if t.key in found), Fraction(0)
        )
        judged = [found[target.key] for target in targets if target.key in found]
        readings = list(dict.fromkeys(one.reading or "; ".join(map(self.reading_of, of)) for one, of in judged))
        reading = "; ".join(readings) + (f" ({'; '.join(self.remarks)})" if self.remarks else "")
        worst = max(verdicts, key=lambda each: each.rank)
        told = [self.told(target, found[target.key][0]) for target in targets if target.key in found]
        because = "; ".join(dict.fromkeys(filter(None, told)))
        if missing := [each for each in targets if each.key not in found]:
            given = f"{len(targets) - len(missing)} of {len(targets)} answers given"
            none_to = f"{given}, no answer to: {', '.join(map(_short_name, missing))}"
            because = "; ".join(filter(None, [because, none_to]))
            worst = max(worst, Verdict(Outcome.MISSING, ""), key=lambda each: each.rank)
        if self.left_over and not missing:
            more = "; ".join(self.reading_of(each) for each in self.left_over)[:200]
            if (extra := self.contradicts(found)) is not None:
                why = f"it gives more than one answer, and this one is wrong: {self.reading_of(extra)[:200]}"
                refused = Verdict(Outcome.DIFFERENT, why, reading)
                return Graded(self.part.label, self.answer, refused, tuple(verdicts))
            because = "; ".join(filter(None, [because, f"not asked for: {more}"]))
        overall = replace(worst, because=because, reading=reading)
        return Graded(self.part.label, self.answer, overall, tuple(verdicts), points)

    def contradicts(self, found: dict[str, tuple[Verdict, list[_Statement]]]) -> _Statement | None:
        """Return a wrong second answer to a question, or None; a result with another name does not count."""
        names = {each.name for _, of in found.values() for each in of}
        for statement in self.left_over:
            own = statement.name is None or statement.name in names
            own = own or any(self.is_named(statement, target) for target in self.part.targets)
            if own and not any(self.verdict(statement, target).is_right for target in self.part.targets):
                return statement
        return None

    def told(self, target: Target, verdict: Verdict) -> str:
        several = len(self.part.targets) > 1
        because = verdict.because or ("" if verdict.outcome is Outcome.EQUAL and not several else verdict.outcome.value)
        return f"{_short_name(target)}: {because}" if several else because


def _free(reads: tuple[Read, ...]) -> set[Any]:
    return {symbol for read in reads for symbol in getattr(read.value, "free_symbols", ())}


def _is_letter(target: Target) -> bool:
    return isinstance(target.symbol, Symbol | MatrixSymbol)


def _numbered_alike(targets: Sequence[Target]) -> list[list[tuple[Target, Target]]]:
    """Return the pairs of targets whose letters differ only in their numbers, such as omega_1 and omega_2; pairs with
    the same two numbers are in one list."""
    found: dict[tuple[str, str], list[tuple[Target, Target]]] = {}
    named = [(each, *parts_of(each.symbol.name)[:2]) for each in targets if _is_letter(each)]
    for a, base, first in named:
        for b, same, second in named:
            if base == same and first.isdigit() and second.isdigit() and first < second:
                found.setdefault((first, second), []).append((a, b))
    return list(found.values())


def _short_name(target: Target) -> str:
    sides = target.text.split(" = ")
    names = (" = ".join(sides[:n]) for n in range(1, len(sides)))
    name = next((each for each in names if each.count("(") == each.count(")")), "")  # `U|(theta = 0)` is one name
    return name if name and len(name) < 20 and not target.is_relation else target.key


def _is_list(target: Target) -> bool:
    return isinstance(target.value, MatrixBase)


def _has_two_signs(value: Any) -> bool:
    return PLUS_MINUS in getattr(value, "free_symbols", ())


def _has_letters(statement: _Statement) -> bool:
    return any(read.value.free_symbols for read in statement.last if hasattr(read.value, "free_symbols"))


def _repeated(values: list[Expr], distinct: list[Expr], wanted: list[Expr]) -> list[Expr]:
    """Repeat the values that are wanted several times, if each wanted value is given once."""
    found: list[Expr] = []
    for value in values:
        same = next((each for each in distinct if are_surely_equal(value, each)), None)
        found += [value] * (wanted.count(same) if same is not None and len(values) == len(distinct) else 1)
    return found


def _is_plain_decimal(text: str) -> bool:
    """Whether a text is a single decimal number, with or without a power of ten."""
    import re

    plain = re.sub(r"\\times|\\cdot|[×·*xX]", "*", text.replace(" ", "").replace("\\,", "").strip("$"))
    return re.fullmatch(r"[-+−]?[\d.,]+(?:[eE][-+]?\d+|\*10(?:\^|\*\*)[{(]?[-−+]?\d+[})]?)?", plain) is not None


def _places(value: Expr, text: str) -> int:
    import re

    number = re.search(r"\d[\d,]*(?:\.(\d*))?|\.(\d+)", text.replace(" ", ""))
    digits = len(number[1] or number[2] or "") if number else 0
    if number and not number[1] and "," in number[0] and re.fullmatch(r"\d+,\d{1,2}|0,\d+|\d+,\d{4,}", number[0]):
        digits = len(number[0].partition(",")[2])
    power = re.search(r"(?:[eE]|10\s*(?:\^|\*\*)\s*[{(]?\s*)([-−+]?\d+)", text)
    return digits - (int(power[1].replace("−", "-")) if power else 0)


__all__ = ["Graded", "grade"]
