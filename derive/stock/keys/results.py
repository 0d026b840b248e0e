"""What is made of answers: put in, solved for, limiting cases, conditions, motions; each under a name of its own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from sympy import Expr, Integer

from derive.algebra.expressions import Relation, explicit
from derive.course.expression import names_in
from derive.course.schema import SCALAR, TEXT, Reader, Record, as_written, key, mapping_of, one_or_more, record_of
from derive.course.stock import InLetters, each, told_at
from derive.course.yaml_tree import Tree, Word
from derive.errors import Faults, Place, rejected
from derive.mechanics import (
    Coordinate,
    beats,
    conjugate,
    frequency,
    frequency_squared_about,
    leaves_contact,
    limiting_case,
    maximum,
    minimum,
    noether,
    period_by_energy,
    poisson_bracket,
    put_in,
    rate_of,
    roots,
    solution,
    solved_for,
    speed_from_energy,
    steady_amplitude,
    steady_motion,
    unknown,
    where,
)
from derive.mechanics.kinematics.coordinates import kind_of_rate
from derive.mechanics.lagrange.momenta import letter_of_momentum
from derive.mechanics.model.dalembert import Matter
from derive.steps.step import Quantity
from derive.stock.keys.bodies import ENDS
from derive.stock.keys.chosen_root import chosen_root
from derive.stock.keys.directions import DIRECTION, Axis, Directions
from derive.stock.keys.formulas import Formula, FoundLetter, formula
from derive.stock.keys.result_verbs import VERBS, check_verb, schema_of_verbs
from derive.stock.keys.result_words import function_or_name, names, nodes, value_or_infinity, value_put_in, whole_order
from derive.stock.keys.starts import from_start

TEXT_OF_ANSWER = as_written(TEXT.schema, "the name of an answer")
NAMES = as_written(one_or_more(TEXT.schema), "the name of an answer, or a list of names")
EXPRESSIONS = as_written(one_or_more(SCALAR.schema), "an expression, or a list of them")


@dataclass(frozen=True)
class ResultKeys(Record):
    """The keys of one of `results:`: one verb with the answers that it is about, and what that verb needs."""

    solve: Tree | None = key("equations that are solved, for what `for` names", NAMES)
    put_in: Tree | None = key("an answer into which `results` and `values` are put", NAMES)
    roots: Tree | None = key(
        "an equation whose roots are wanted, or a result whose zeros are, in the letter of `for`, or in `cos(theta)`",
        NAMES,
    )
    limit: Tree | None = key("an answer in the limiting case that the letter of `for` goes `to` a value", NAMES)
    where: Tree | None = key(
        "an answer that is to be in the relation `is` to `bound`, solved for the letter of `for`", NAMES
    )
    maximum: Tree | None = key("an answer that is greatest for some value of the letter of `for`", NAMES)
    minimum: Tree | None = key("an answer that is least for some value of the letter of `for`", NAMES)
    leaves: Tree | None = key(
        "a force of contact that vanishes where contact is lost, for `for`, from `start` on", NAMES
    )
    solution: Tree | None = key(
        "a linear equation of motion of `for`, solved from `start` and `start_rate`; or `normal_modes`, for the motion "
        "of all coordinates from their `values` at the start, `{x_1: A, x_2_dot: v}`",
        NAMES,
    )
    amplitude: Tree | None = key("a driven linear equation of motion of `for`, in its steady state", NAMES)
    speed: Tree | None = key("a conserved energy, which gives the rate of `for` from `start` and `start_rate`", NAMES)
    period: Tree | None = key("a squared rate, as `speed` gives it, to the `order` in the amplitude", NAMES)
    beats: Tree | None = key("two frequencies, the slower first, of oscillations that are added", NAMES)
    value: Tree | None = key("a formula of answers by their names and of letters, such as `pi*rate/frequency`", SCALAR)
    rate: Tree | None = key(
        "a motion such as `solution` finds, or another answer whose rate of change is wanted", NAMES
    )
    steady: Tree | None = key(
        "a Lagrangian whose steady motion is wanted, with the places that stay and the rates of cyclic coordinates as "
        "`values`: `{r: r_0}`, and letters for the others of these rates as `symbol`",
        NAMES,
    )
    frequency: Tree | None = key(
        "an effective potential energy, for small oscillations about the steady motion that `results` names; `for` the "
        "letter that its condition takes out",
        NAMES,
    )
    bracket: Tree | None = key(
        "two answers, or formulas of coordinates and their momenta `p_x`, whose Poisson bracket is wanted",
        as_written({"type": "array", "items": SCALAR.schema, "minItems": 2, "maxItems": 2}, "a list of two functions"),
    )
    noether: Tree | None = key(
        "a Lagrangian, for what is conserved because the shift of coordinates by `values` leaves it as it is: "
        "`{x: -y, y: x}`",
        NAMES,
    )
    answer: Tree | None = key("of a body, an answer about another point or axis than the one given", TEXT_OF_ANSWER)
    about: Word | None = key("the point of `answer`", TEXT)
    origin: Word | None = key("the point from which the centre of mass of `answer` is measured", TEXT)
    direction: Tree | None = key("the axis of `answer: moment_about`", DIRECTION)
    gained: Tree | None = key("of `noether`: of which function the Lagrangian gains the rate; by default none", SCALAR)
    unknowns: Tree | None = key("a letter, a rate such as `theta_dot`, or several", EXPRESSIONS, called="for")
    results: Tree | None = key("answers that are put in", NAMES)
    values: Mapping[Word, Tree] = key("values of letters and coordinates that are put in", mapping_of(SCALAR))
    to: Tree | None = key("where the letter goes: 0, `infinity`, or a value", SCALAR)
    order: Word | None = key("to which order", Reader(SCALAR.schema, TEXT.read))
    relation: Word | None = key("`>`, `>=`, `<`, `<=`, `=` or `!=`", TEXT, called="is")
    bound: Tree | None = key("what it is compared with; by default zero", SCALAR)
    start: Tree | None = key("the value at the start", SCALAR)
    start_rate: Tree | None = key("the rate at the start; by default zero", SCALAR)
    within: tuple[Tree, ...] = key("between which values it is sought, such as `[0, pi/2]`", ENDS)
    case: Word | None = key("`underdamped`, `critically_damped` or `overdamped`, where the letters leave it open", TEXT)
    root: Word | None = key(
        "which of several roots: `positive`, `negative`, `largest`, `smallest`, or its number, `2`",
        Reader(SCALAR.schema, TEXT.read),
    )
    symbol: Tree | None = key("the letter of what is found, or one for each of several", NAMES)

    def read(self, name: Word, letters: InLetters, faults: Faults) -> Result | None:
        """What is to be done, in letters; nothing after a complaint."""
        with faults:
            known = letters.letters.get(name)
            if known is not None and not isinstance(known, FoundLetter):
                message = f"`{name}` is a letter of this problem already, so no result can be called so"
                rejected("letter-clash", message, name.place, "give the result another name")
            verb = next(verb for verb in VERBS if getattr(self, verb) is not None)
            written = formula(self.value, letters.letters) if self.value else None
            return Result(
                name=name,
                verb=verb,
                of=() if VERBS[verb].of_formulas else names(getattr(self, verb)),
                functions=tuple(function_or_name(node, letters) for node in nodes(self.bracket)),
                gained=value_or_infinity(self.gained, letters) if self.gained else None,
                formula=written,
                results=names(self.results),
                unknowns=tuple(letters.read(node, "for")[0] for node in nodes(self.unknowns)),
                values=tuple(
                    each([partial(value_put_in, letter, node, letters) for letter, node in self.values.items()])
                ),
                to=value_or_infinity(self.to, letters) if self.to else None,
                order=whole_order(self.order),
                relation=str(self.relation or "="),
                bound=value_or_infinity(self.bound, letters) if self.bound else None,
                start=value_or_infinity(self.start, letters) if self.start else None,
                start_rate=value_or_infinity(self.start_rate, letters) if self.start_rate else None,
                within=tuple(value_or_infinity(node, letters) for node in self.within),
                case=str(self.case) if self.case else None,
                root=self.root,
                about=self.about,
                origin=self.origin,
                direction=Directions(letters).axis(self.direction, "direction") if self.direction else None,
                symbols=names(self.symbol),
                place=name.place,
            )
        return None


_RESULT = record_of(ResultKeys, "a result", "a mapping such as `{limit: lagrangian, for: m, to: 0}`")


def _result(node: Tree, name: str, faults: Faults) -> ResultKeys | None:
    """One of `results:`, whose keys go together."""
    found = _RESULT.read(node, name, faults)
    if found is not None:
        check_verb(found, name, faults)
    return found


RESULTS = mapping_of(Reader({**_RESULT.schema, **schema_of_verbs()}, _result))


@dataclass(frozen=True)
class Result:
    """One thing that is made of answers."""

    name: Word
    verb: str
    of: tuple[Word, ...]
    formula: Formula | None = None
    functions: tuple[Word | Expr, ...] = ()
    gained: Expr | None = None
    results: tuple[Word, ...] = ()
    unknowns: tuple[Expr, ...] = ()
    values: tuple[tuple[Word, Expr], ...] = ()
    to: Expr | None = None
    order: int | None = None
    relation: str = "="
    bound: Expr | None = None
    start: Expr | None = None
    start_rate: Expr | None = None
    within: tuple[Expr, ...] = ()
    case: str | None = None
    root: Word | None = None
    about: Word | None = None
    origin: Word | None = None
    direction: Axis | None = None
    symbols: tuple[Word, ...] = ()
    place: Place | None = field(default=None, repr=False, compare=False)

    def made(
        self,
        answers: Callable[[Word], tuple[Quantity, ...]],
        coordinates: Mapping[str, Coordinate],
        elsewhere: Callable[[Result], Quantity] | None = None,
    ) -> Any:
        """By the verb, of the answers of those names; `elsewhere` asks about another point or axis."""
        if VERBS[self.verb].asks:
            if elsewhere is None:
                message = f"`{self.verb}` asks about another point of a body, which is for `solve: body`"
                rejected("wrong-argument", message, self.place)
            with told_at(self.place):
                return elsewhere(self)
        self._momenta_named(coordinates)
        if self.formula is not None:
            with told_at(self.place):
                return self.formula.made(partial(_one_of, answers), self.name, self.symbol.get("symbol"))
        of = [quantity for name in self.of for quantity in answers(name)]
        more = [quantity for name in self.results for quantity in answers(name)]
        if self.verb == "bracket":
            both: list[Any] = [_one_of(answers, f) if isinstance(f, Word) else f for f in self.functions]
            if len(both) != 2:
                rejected("wrong-type", f"`bracket` is of two functions, but these are {len(both)}", self.place)
            with told_at(self.place):
                return poisson_bracket(both[0], both[1], *coordinates.values(), among=more, key=self.name)
        if self.verb == "speed" and not self.results:
            more = self._motion_for_speed(of, answers, coordinates)
        with told_at(self.place):
            return _MAKERS[self.verb](self, of, more, coordinates)

    def _motion_for_speed(
        self, of: list[Quantity], answers: Callable[[Word], tuple[Quantity, ...]], coordinates: Mapping[str, Coordinate]
    ) -> list[Quantity]:
        """The equation of motion, where the energy does not tell by itself which forces act."""
        q = self.coordinate(coordinates)
        matter = self.only(of).fact(Matter)
        if self.place is None or matter is not None and tuple(matter.coordinates) == (q.symbol,):
            return []
        return list(answers(Word.at(f"motion_{q.symbol.name}", self.place)))

    def _momenta_named(self, coordinates: Mapping[str, Coordinate]) -> None:
        """From here on the momenta that stand in its formulas are known to move."""
        held = {str(name) for name in (names_in(self.formula.node) if self.formula is not None else ())}
        held |= {s.name for each in self.functions if isinstance(each, Expr) for s in each.free_symbols}
        for q in coordinates.values():
            if letter_of_momentum(q).name in held:
                conjugate(q)

    def only(self, of: list[Quantity]) -> Quantity:
        """The one answer; of several of one name that whose key this name is."""
        if len(of) > 1 and len(self.of) == 1:
            of = [quantity for quantity in of if quantity.key == self.of[0]] or of
        if len(of) != 1:
            rejected("wrong-argument", f"`{self.verb}` is about one answer, but these are {len(of)}", self.place)
        return of[0]

    @property
    def uses(self) -> tuple[Word, ...]:
        """The names of the answers that it is made of."""
        of_formula = self.formula.answers if self.formula is not None else ()
        return (*self.of, *self.results, *of_formula, *(f for f in self.functions if isinstance(f, Word)))

    @property
    def letter(self) -> Expr:
        if len(self.unknowns) != 1:
            rejected("missing-key", f"`{self.verb}` needs one letter as its `for`", self.place)
        return self.unknowns[0]

    def coordinate(self, coordinates: Mapping[str, Coordinate]) -> Coordinate:
        found = next((q for q in coordinates.values() if q.symbol == self.letter), None)
        if found is None:
            rejected("wrong-argument", f"`{self.verb}` needs a coordinate as its `for`", self.place)
        return found

    @property
    def symbol(self) -> dict[str, Any]:
        """The letter of what is found, if one is given."""
        if len(self.symbols) > 1:
            rejected("wrong-argument", f"`{self.verb}` finds one thing, with one letter", self.symbols[1].place)
        return {"symbol": str(self.symbols[0])} if self.symbols else {}

    def named(self, extra: Mapping[str, Any]) -> dict[str, Any]:
        """What is given of the further arguments of a verb."""
        return {name: value for name, value in extra.items() if value is not None and value != ()}

    @property
    def keys(self) -> list[str]:
        """The name alone where there is one unknown, else one for each."""
        count = len(self.unknowns)
        return [self.name] if count == 1 else [f"{self.name}_{i + 1}" for i in range(count)]


def _solve(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    return solved_for(tuple(of), *result.unknowns, keys=result.keys)


def _put_in(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    original = result.only(of)
    there = {s.name for quantity in (original, *more) for s in explicit(quantity.value).free_symbols}
    state = {s.name for one in q.values() for s in (one.symbol, one.rate, one.acceleration)}
    for name in (name for name, _ in result.values if name not in there | state):
        message = f"`{original.key}` does not contain `{name}`, so its value has no effect"
        rejected("unused-value", message, name.place, "leave it out")
    values = {str(name): value for name, value in result.values if name in there}  # a state may say more
    return put_in(original, *more, key=result.name, **result.symbol, **(values or dict(result.values)))


def _roots(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    only = result.only(of)
    key = None if isinstance(only.value, Relation) else result.name  # zeros are called as what they were asked by
    found = roots(only, result.letter, **result.named({"symbols": tuple(map(str, result.symbols)), "key": key}))
    return found if result.root is None else chosen_root(found, result.root)


def _limit(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    given = result.named({"to": result.to, "order": result.order})
    return limiting_case(result.only(of), result.letter, key=result.name, **given, **result.symbol)


def _where(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    bound = more[0] if more else result.bound if result.bound is not None else Integer(0)
    return where(result.only(of), result.relation, bound, result.letter, key=result.name)


def _maximum(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    return maximum(result.only(of), result.letter, key=result.name, **result.named({"within": result.within}))


def _minimum(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    return minimum(result.only(of), result.letter, key=result.name, **result.named({"within": result.within}))


def _leaves(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    return leaves_contact(result.only(of), result.letter, _started(result), key=result.name)


def _solution(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    if len(of) > 1 and result.start is None:
        return from_start(of, result.values, q, result.name, result.case)
    extra = result.named({"start_rate": result.start_rate, "case": result.case})
    return solution(result.only(of), result.coordinate(q), _started(result), key=result.name, **extra)


def _amplitude(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    return steady_amplitude(result.only(of), result.coordinate(q), key=result.name, **result.symbol)


def _speed(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    extra = result.named({"start_rate": result.start_rate, "motion": more[0] if more else None})
    return speed_from_energy(result.only(of), result.coordinate(q), _started(result), key=result.name, **extra)


def _period(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    extra = result.named({"order": result.order})
    return period_by_energy(result.only(of), key=result.name, **result.symbol, **extra)


def _rate(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    return rate_of(result.only(of), key=result.name)


def _steady(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    places = {q[name]: value for name, value in result.values if name in q}
    rates = {one: value for name, value in result.values for one in q.values() if one.rate.name == name}
    known = {*(one.symbol.name for one in places), *(one.rate.name for one in rates)}
    strange = next((name for name, _ in result.values if name not in known), None)
    if strange is not None:
        message = f"`steady` has values of coordinates and rates, but `{strange}` is none"
        rejected("no-such-coordinate", message, strange.place)
    L = result.only(of)
    turning = [one for one in q.values() if one.symbol not in explicit(L.value).free_symbols and one not in rates]
    if len(result.symbols) > len(turning):
        message = f"`steady` has letters for the rates of {len(turning)} cyclic coordinates"
        rejected("wrong-argument", message, result.symbols[-1].place)
    for one, letter in zip(turning, result.symbols, strict=False):
        rates[one] = unknown(str(letter), kind_of_rate(one.kind) or "number", positive=True)
    return steady_motion(L, rates, places, key=result.name)


def _frequency(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    if len(more) != 1:
        rejected("missing-key", "`frequency` needs the steady motion that it is about as its `results`", result.place)
    without = result.named({"without": result.letter if result.unknowns else None})
    squared = frequency_squared_about(
        result.only(of), more[0], key=f"{result.name}_squared", **result.symbol, **without
    )
    return frequency(squared, key=result.name)


def _noether(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    strange = next((name for name, _ in result.values if name not in q), None)
    if strange is not None:
        rejected("no-such-coordinate", f"`noether` shifts coordinates, but `{strange}` is none", strange.place)
    shift = {q[name]: value for name, value in result.values}
    return noether(result.only(of), shift, key=result.name, **result.named({"gained": result.gained}), **result.symbol)


def _one_of(answers: Callable[[Word], tuple[Quantity, ...]], name: Word) -> Quantity:
    """The one answer of a name, or that whose key the name is."""
    found = answers(name)
    found = tuple(quantity for quantity in found if quantity.key == name) or found
    if len(found) != 1:
        rejected("wrong-argument", f"`{name}` stands for {len(found)} answers", name.place)
    return found[0]


def _beats(result: Result, of: list[Quantity], more: list[Quantity], q: Mapping[str, Coordinate]) -> Any:
    if len(of) != 2:
        rejected("wrong-argument", f"`beats` is about two frequencies, but these are {len(of)}", result.place)
    slow, fast = of
    return beats(slow, fast, key=result.name, **result.symbol)


_MAKERS: Mapping[str, Callable[..., Any]] = {
    "solve": _solve,
    "put_in": _put_in,
    "roots": _roots,
    "limit": _limit,
    "where": _where,
    "maximum": _maximum,
    "minimum": _minimum,
    "leaves": _leaves,
    "solution": _solution,
    "amplitude": _amplitude,
    "speed": _speed,
    "period": _period,
    "beats": _beats,
    "rate": _rate,
    "steady": _steady,
    "noether": _noether,
    "frequency": _frequency,
}


def _started(result: Result) -> Expr:
    if result.start is None:
        rejected("missing-key", f"`{result.verb}` needs `start`, the value at the start", result.place)
    return result.start
