"""`results:` of a description: quantities computed from answers, each under a name of its own.

Each key belongs to an argument of a verb and is stated next to the verb. This module defines how each sort of key is
read, and the verb `answer`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, make_dataclass
from functools import partial
from itertools import groupby
from typing import Any

from sympy import Expr

import derive.mechanics  # noqa: F401  registers the verbs of `results:`
from derive.algebra.expressions import Prescribed
from derive.course.declarations import INFINITE
from derive.course.expression import names_in
from derive.course.schema import SCALAR, TEXT, Reader, Record, as_written, key, mapping_of, one_or_more, record_of
from derive.course.stock import InLetters, each, told_at
from derive.course.yaml_tree import Scalar, Tree, Word
from derive.course.yaml_tree import Sequence as Items
from derive.errors import Faults, Place, did_you_mean, rejected
from derive.mechanics import Coordinate, conjugate
from derive.mechanics.in_results import RESULT_VERBS, Axis, Holds, Name, Point, ResultKey, ResultVerb, in_results
from derive.mechanics.lagrange.momenta import letter_of_momentum
from derive.steps.step import Quantity
from derive.stock.keys.bodies import ENDS
from derive.stock.keys.directions import DIRECTION, Directions
from derive.stock.keys.formulas import Formula, FoundLetter, formula

NAMES = as_written(one_or_more(TEXT.schema), "the name of an answer, or a list of names")
EXPRESSIONS = as_written(one_or_more(SCALAR.schema), "an expression, or a list of them")
WORD = Reader(SCALAR.schema, TEXT.read)
PAIR = as_written({"type": "array", "items": SCALAR.schema, "minItems": 2, "maxItems": 2}, "a list of two entries")
Answers = Callable[[Word], tuple[Quantity, ...]]


@in_results(
    "answer",
    "the inertia tensor, a moment of inertia, a radius of gyration or the centre of mass of a body, for another point "
    "or axis: "
    "`{answer: moment_of_inertia_z, about: tip}`",
    one_of=("about", "origin", "direction"),
    answer="answer: the name of an answer of a body",
    about="about: a point",
    origin="origin: a point",
    direction="direction: an axis",
    symbol="symbol",
)
def _of_a_body(
    answer: Name,
    key: str,
    elsewhere: Callable[..., Quantity] | None = None,
    about: Point = None,
    origin: Point = None,
    direction: Axis = None,
    symbol: str | None = None,
) -> Quantity:
    if elsewhere is None:
        rejected("wrong-argument", "`answer` is for another point or axis of a body and needs `solve: body`", None)
    return elsewhere(answer, key, about, origin, direction, symbol)


# --- the sorts of keys -----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Sort:
    """A sort of key: how its value in the file is read, and how the argument of the verb is made from it.

    read   a function of the verb, the key, the written value and the symbols; it returns the value in symbols
    made   a function of the result, the key, the value in symbols and the surroundings; it returns the argument of the
           verb
    uses   a function of the value in symbols; it returns the names of the answers that the value contains
    """

    shape: Reader[Any]
    read: Callable[[ResultVerb, ResultKey, Any, InLetters], Any]
    made: Callable[[Result, ResultKey, Any, Surroundings], Any] = lambda result, key, value, around: value
    uses: Callable[[Any], Iterable[Word]] = lambda value: ()


@dataclass(frozen=True)
class Surroundings:
    """The context of a result: answers by name, coordinates, the function for other points of a body, and surfaces."""

    answers: Answers
    coordinates: Mapping[str, Coordinate]
    elsewhere: Callable[..., Quantity] | None = None
    surfaces: Mapping[str, Any] = field(default_factory=dict)

    def one(self, name: Word) -> Quantity:
        """Return the answer that a name denotes. Among several answers, the name must be the key of one of them; reject
        any other name."""
        found = self.answers(name)
        found = tuple(quantity for quantity in found if quantity.key == name) or found
        if len(found) != 1:
            rejected("wrong-argument", f"`{name}` denotes {len(found)} answers, not one", name.place)
        return found[0]

    def momenta_named(self, names: Iterable[str]) -> None:
        """Record that the momenta with these names change in time."""
        held = set(names)
        for q in self.coordinates.values():
            if letter_of_momentum(q).name in held:
                conjugate(q)


def _nodes(node: Tree) -> tuple[Tree, ...]:
    return node.items if isinstance(node, Items) else (node,)


def names(node: Tree | None) -> tuple[Word, ...]:
    found = []
    for item in _nodes(node) if node is not None else ():
        if not isinstance(item, Scalar) or item.empty:
            rejected("wrong-type", "an answer must be given by its name", item.place)
        found.append(item.word)
    return tuple(found)


def value_or_infinity(node: Tree, letters: InLetters) -> Expr:
    if isinstance(node, Scalar) and node.text.strip() in INFINITE:
        return INFINITE[node.text.strip()]
    return letters.read(node, "a value")[0]


def _value(verb: ResultVerb, key: ResultKey, node: Tree, letters: InLetters) -> Expr:
    return value_or_infinity(node, letters)


def _letters(verb: ResultVerb, key: ResultKey, node: Tree, letters: InLetters) -> tuple[Expr, ...]:
    return tuple(letters.read(each, key.name)[0] for each in _nodes(node))


def _letter(verb: ResultVerb, key: ResultKey, node: Tree, letters: InLetters) -> Expr:
    found = _letters(verb, key, node, letters)
    if len(found) != 1:
        rejected("missing-key", f"`{verb.name}` needs one symbol as its `{key.name}`", node.place)
    return found[0]


def _values(verb: ResultVerb, key: ResultKey, written: Mapping[Word, Tree], letters: InLetters) -> dict[Word, Expr]:
    def one(letter: Word, value: Tree) -> tuple[Word, Expr]:
        if letter not in letters.letters:
            help_line = did_you_mean(letter, letters.letters) or "use a symbol, a coordinate or a rate"
            rejected("undeclared-symbol", f"`{letter}` is not declared", letter.place, help_line)
        known = letters.letters[letter].symbol
        if isinstance(known, Prescribed) and not known.order:  # the value replaces the function at all times
            return letter, letters.of_kind(value, str(letter), known.sort)
        return letter, value_or_infinity(value, letters)

    return dict(each([partial(one, letter, value) for letter, value in written.items()]))


def _order(verb: ResultVerb, key: ResultKey, word: Word, letters: InLetters) -> int:
    if not word.isdigit() or len(word) > 2:
        rejected("wrong-type", f"`{key.name}` must be a whole number from 0 to 99, but it is `{word}`", word.place)
    return int(word)


def _symbol(verb: ResultVerb, key: ResultKey, node: Tree, letters: InLetters) -> Word:
    found = names(node)
    if len(found) > 1:
        rejected(
            "wrong-argument", f"`{verb.name}` finds one quantity, so its `{key.name}` must be one name", found[1].place
        )
    return found[0]


def _functions(verb: ResultVerb, key: ResultKey, node: Tree, letters: InLetters) -> tuple[Word | Expr, ...]:
    """Return each function, as the name of an answer or as a formula."""

    def one(item: Tree) -> Word | Expr:
        is_name = isinstance(item, Scalar) and not item.empty and [*names_in(item)] == [item.text.strip()]
        if is_name and isinstance(item, Scalar) and item.text.strip() not in letters.letters:
            return item.word
        return letters.read(item, "a function")[0]

    if len(_nodes(node)) != 2:
        rejected("wrong-type", f"`{verb.name}` needs two functions, not {len(_nodes(node))}", node.place)
    return tuple(one(item) for item in _nodes(node))


def _one_answer(result: Result, key: ResultKey, found: tuple[Word, ...], around: Surroundings) -> Quantity:
    of = [quantity for name in found for quantity in around.answers(name)]
    if len(of) > 1 and len(found) == 1:
        of = [quantity for quantity in of if quantity.key == found[0]] or of
    if len(of) != 1:
        rejected("wrong-argument", f"`{result.verb.name}` needs one answer, not {len(of)}", result.place)
    return of[0]


def _all_answers(result: Result, key: ResultKey, found: tuple[Word, ...], around: Surroundings) -> tuple[Quantity, ...]:
    return tuple(quantity for name in found for quantity in around.answers(name))


def _coordinate(result: Result, key: ResultKey, letter: Expr, around: Surroundings) -> Coordinate:
    found = next((q for q in around.coordinates.values() if q.symbol == letter), None)
    if found is None:
        message = f"`{result.verb.name}` needs a coordinate as its `{key.name}`"
        rejected("wrong-argument", message, result.places.get(key.name))
    return found


def _functions_made(
    result: Result, key: ResultKey, found: tuple[Word | Expr, ...], around: Surroundings
) -> tuple[Any, ...]:
    around.momenta_named(s.name for each in found if isinstance(each, Expr) for s in each.free_symbols)
    return tuple(around.one(each) if isinstance(each, Word) else each for each in found)


def _place(verb: ResultVerb, key: ResultKey, node: Tree, letters: InLetters) -> tuple[Expr, ...]:
    if len(_nodes(node)) != 2:
        rejected("wrong-type", f"`{key.name}` needs the two components of a place", node.place)
    return tuple(letters.of_kind(item, key.name, "length") for item in _nodes(node))


def _surface(result: Result, key: ResultKey, name: Word, around: Surroundings) -> Any:
    if name not in around.surfaces:
        help_line = did_you_mean(name, around.surfaces) or "describe it under `surfaces`"
        rejected("no-such-surface", f"`{name}` is not a surface of this system", name.place, help_line)
    return around.surfaces[name]


def _plain_values(result: Result, key: ResultKey, found: Mapping[Word, Expr], around: Surroundings) -> dict[str, Expr]:
    """Return the values with plain strings as keys. A `Word` also has its position in the file, and a call of a verb
    with such keys cannot be stored."""
    return {str(name): value for name, value in found.items()}


def _formula_made(result: Result, key: ResultKey, written: Formula, around: Surroundings) -> Any:
    around.momenta_named(map(str, names_in(written.node)))
    return written.with_answers(around.one)


SORTS: Mapping[Holds, Sort] = {
    Holds.ANSWER: Sort(NAMES, lambda verb, key, node, letters: names(node), _one_answer, lambda found: found),
    Holds.ANSWERS: Sort(NAMES, lambda verb, key, node, letters: names(node), _all_answers, lambda found: found),
    Holds.NAME: Sort(NAMES, _symbol),
    Holds.LETTER: Sort(EXPRESSIONS, _letter),
    Holds.LETTERS: Sort(EXPRESSIONS, _letters),
    Holds.COORDINATE: Sort(EXPRESSIONS, _letter, _coordinate),
    Holds.VALUE: Sort(SCALAR, _value),
    Holds.VALUES: Sort(mapping_of(SCALAR), _values, _plain_values),
    Holds.ENDS: Sort(ENDS, lambda verb, key, ends, letters: tuple(value_or_infinity(each, letters) for each in ends)),
    Holds.ORDER: Sort(WORD, _order),
    Holds.WORD: Sort(WORD, lambda verb, key, word, letters: str(word)),
    Holds.SYMBOL: Sort(NAMES, lambda verb, key, node, letters: str(_symbol(verb, key, node, letters))),
    Holds.SYMBOLS: Sort(NAMES, lambda verb, key, node, letters: tuple(map(str, names(node)))),
    Holds.POINT: Sort(TEXT, lambda verb, key, word, letters: word),
    Holds.FORMULA: Sort(
        SCALAR,
        lambda verb, key, node, letters: formula(node, letters.letters),
        _formula_made,
        lambda made: made.answers,
    ),
    Holds.FUNCTIONS: Sort(PAIR, _functions, _functions_made, lambda found: (f for f in found if isinstance(f, Word))),
    Holds.PLACE: Sort(PAIR, _place),
    Holds.SURFACE: Sort(TEXT, lambda verb, key, word, letters: word, _surface),
    Holds.AXIS: Sort(DIRECTION, lambda verb, key, node, letters: Directions(letters).axis(node, key.name)),
}


# --- the keys of all verbs together ----------------------------------------------------------------------------------


def _meaning(name: str) -> str:
    """Return the meaning of a key from the hints of the verbs."""
    if name in RESULT_VERBS:
        return f"{RESULT_VERBS[name].own.hint}; finds {RESULT_VERBS[name].yields}"
    hints = [
        (verb.keys[name].hint or ALIKE.get(name, ""), verb.name) for verb in RESULT_VERBS.values() if name in verb.keys
    ]
    together = groupby(sorted(hints), key=lambda hint: hint[0])
    return "; ".join(f"{hint} ({', '.join(f'`{verb}`' for _, verb in verbs)})" for hint, verbs in together)


ALIKE = {  # the meaning of a key, unless a verb states another meaning
    "symbol": "the symbol of the result, or a list of symbols for several results",
    "results": "answers that are substituted",
    "order": "the highest order",
    "start": "the value at the start",
    "case": "`underdamped`, `critically_damped` or `overdamped`, if the symbols do not decide the case",
    "gained": "the function F, if the shift of the coordinates adds epsilon dF/dt to the Lagrangian; by default zero",
}


def _every_key() -> Iterator[ResultKey]:
    """Yield each key once."""
    verbs = sorted(RESULT_VERBS.values(), key=lambda verb: verb.name)
    every = [*(verb.own for verb in verbs), *(each for verb in verbs for each in verb.keys.values())]
    yield from {each.name: each for each in reversed(every)}.values()


ResultKeys: type[Record] = make_dataclass(
    "ResultKeys",
    [
        (f"{each.name}_", Any, key(_meaning(each.name), SORTS[each.holds].shape, called=each.name))
        for each in sorted(_every_key(), key=lambda each: (each.name not in RESULT_VERBS, each.name))
    ],
    bases=(Record,),
    frozen=True,
)
_RESULT: Reader[Any] = record_of(ResultKeys, "a result", "a mapping such as `{limit: lagrangian, for: m, to: 0}`")


def _result(node: Tree, name: str, faults: Faults) -> Record | None:
    found: Record | None = _RESULT.read(node, name, faults)
    if found is not None:
        _check_verb(found, name, faults)
    return found


def written_in(written: Record) -> dict[str, Any]:
    """Return the written values of the keys of a result."""
    held = {name: getattr(written, f"{name}_") for name in (each.name for each in _every_key())}
    return {name: value for name, value in held.items() if name in written.values_at and value not in ({}, ())}


def verb_of(written: Record) -> ResultVerb:
    """Return the verb of a result whose keys were checked."""
    return next(verb for name, verb in RESULT_VERBS.items() if name in written_in(written))


def _check_verb(written: Record, name: str, faults: Faults) -> None:
    """Check that a result has one verb, the keys that this verb needs, and no key that it does not use."""
    there = [*written_in(written)]
    found = [each for each in there if each in RESULT_VERBS]
    if len(found) != 1:
        message = f"`{name}` needs exactly one of {', '.join(f'`{verb}`' for verb in sorted(RESULT_VERBS))}"
        faults.error("missing-key", message, written.places[found[1]] if found else written.places[""])
        return
    verb = RESULT_VERBS[found[0]]
    keys = tuple(verb.keys)
    uses = f"`{verb.name}` uses {_listed(keys)}" if keys else f"`{verb.name}` uses no other key"
    for other in there:
        if other != verb.name and other not in keys:
            missing = [needed for needed in verb.needs if needed not in there]
            message, help_line = f"`{other}` has no effect on `{verb.name}`", did_you_mean(other, missing) or uses
            faults.error("unused-key", message, written.places[other], help=help_line)
    for first, second in verb.excludes:
        if first in there and second in there:
            message = f"`{second}` has no effect on a `{verb.name}` with `{first}`"
            faults.error("unused-key", message, written.places[second], help=f"leave `{first}` or `{second}` out")
    for needed in verb.needs:
        if needed not in there:
            faults.error("missing-key", f"`{verb.name}` needs `{needed}`", written.places[verb.name], help=uses)
    if verb.one_of and not {*verb.one_of} & {*there}:
        message = f"`{verb.name}` needs {_listed(verb.one_of, 'or')}"
        faults.error("missing-key", message, written.places[verb.name], help=uses)


def _listed(keys: Sequence[str], last: str = "and") -> str:
    *others, final = (f"`{key}`" for key in keys)
    return f"{', '.join(others)} {last} {final}" if others else final


def _schema_of(verb: ResultVerb) -> dict[str, Any]:
    found: dict[str, Any] = {
        "required": [verb.name, *verb.needs],
        "propertyNames": {"enum": [verb.name, *verb.keys]},
    }
    if verb.one_of:
        found["anyOf"] = [{"required": [key]} for key in verb.one_of]
    if verb.excludes:
        found["not"] = {"anyOf": [{"required": list(pair)} for pair in verb.excludes]}
    return found


RESULTS = mapping_of(Reader({**_RESULT.schema, "oneOf": [_schema_of(verb) for verb in RESULT_VERBS.values()]}, _result))


# --- one result ------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Result:
    """One quantity that is computed from answers.

    values   argument of the verb -> the value of its key, in symbols
    places   argument of the verb, or `values:x` for one of the `values` -> its position in the file
    """

    name: Word
    verb: ResultVerb
    values: Mapping[str, Any]
    places: Mapping[str, Place] = field(default_factory=dict, repr=False, compare=False)
    place: Place | None = field(default=None, repr=False, compare=False)

    def made(
        self,
        answers: Answers,
        coordinates: Mapping[str, Coordinate],
        elsewhere: Callable[..., Quantity] | None = None,
        surfaces: Mapping[str, Any] | None = None,
    ) -> Any:
        """Compute the result with its verb; an error about an argument is reported at the key of this argument."""
        around = Surroundings(answers, coordinates, elsewhere, surfaces or {})
        keys = self.verb.arguments
        given = {
            argument: SORTS[keys[argument].holds].made(self, keys[argument], value, around)
            for argument, value in self.values.items()
        }
        further: dict[str, Any] = {
            "coordinates": coordinates,
            "elsewhere": elsewhere,
            "ask": None if self.place is None else self._ask(around),
        }
        given |= {argument: value for argument, value in further.items() if self.verb.takes(argument)}
        with told_at(self.place, self.places):
            return self.verb.function(**given, key=str(self.name))

    def _ask(self, around: Surroundings) -> Callable[[str], Quantity]:
        assert self.place is not None
        place = self.place
        return lambda name: around.one(Word.at(name, place))

    @property
    def uses(self) -> tuple[Word, ...]:
        """Return the names of the answers from which the result is computed."""
        keys = self.verb.arguments
        return tuple(
            name for argument, value in self.values.items() for name in SORTS[keys[argument].holds].uses(value)
        )


def read_result(written: Record, name: Word, letters: InLetters, faults: Faults) -> Result | None:
    """Return a result in symbols, or None after an error."""
    with faults:
        known = letters.letters.get(name)
        if known is not None and not isinstance(known, FoundLetter):
            message = f"`{name}` is already a symbol of this problem, so a result cannot have this name"
            rejected("letter-clash", message, name.place, "give the result another name")
        verb, held = verb_of(written), written_in(written)
        readings = [
            partial(_reading, verb, argument, key, held[key.name], letters)
            for argument, key in verb.arguments.items()
            if key.name in held
        ]
        values = dict(each(readings))
        places = {argument: written.values_at[key.name] for argument, key in verb.arguments.items() if key.name in held}
        places |= {f"values:{letter}": letter.place for letter in values.get("values", ()) if isinstance(letter, Word)}
        return Result(name, verb, values, places, name.place)
    return None


def read_results(written: Mapping[Word, Record], letters: InLetters, faults: Faults) -> tuple[Result, ...]:
    """Return all results in symbols, except results with an error."""
    found = (read_result(keys, name, letters, faults) for name, keys in written.items())
    return tuple(result for result in found if result is not None)


def _reading(verb: ResultVerb, argument: str, key: ResultKey, node: Any, letters: InLetters) -> tuple[str, Any]:
    return argument, SORTS[key.holds].read(verb, key, node, letters)
