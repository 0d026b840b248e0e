"""The meaning of each symbol on a page, and errors for symbols of a problem that have two meanings.

Steps introduce symbols for results, components, entries, coordinates, their rates, and variables of integration.
Two symbols count as equal if they look the same in print: `z_C` and the component `r_C_z`, but not a bold `I` and `I`.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Any

from sympy import Basic, Integral, MatrixBase, MatrixSymbol, Symbol

from derive.algebra.expressions import AXES, RATES, Bracket, MassIntegral, component_names, rate
from derive.course.problem import Problem
from derive.errors import Complaint, Place
from derive.render.notation.latex import latex
from derive.render.notation.notation import Notation
from derive.steps.defined import QUANTITY
from derive.steps.step import Quantity, Step, entry_name

ANOTHER = "use another symbol"
_NOTATION = Notation()


def letter_clashes(
    problem: Problem, known: Mapping[str, Quantity], coordinates: Collection[Symbol] = ()
) -> list[Complaint]:
    """Return an error for each symbol of the problem whose printed form also means something else.

    `coordinates` are the coordinates that the script names. In a step without coordinates, a variable of integration
    with the symbol of a coordinate is also an error.
    """
    used, defined = letters_in_use(problem), {each.name: each.symbol for each in problem.defined}
    looks = {as_printed(letter): letter for letter in used}
    faults: dict[Symbol, Complaint] = {}
    for letter in used:
        other = looks[as_printed(letter)]
        if other != letter:
            message = f"`{letter.name}` and `{other.name}` look the same in print"
            faults[letter] = Complaint("letter-clash", message, _place(problem, letter), help=ANOTHER)
    for quantity in (quantity for quantity in known.values() if quantity.step.rule != QUANTITY.name):
        written = {defined[key] for key in quantity.step.inputs if key in defined}
        for name, what in meanings(quantity.step, {*problem.dimensions, *written}):
            mine = looks.get(as_printed(name))
            if mine is not None and mine not in faults and name not in written:
                faults[mine] = _clash(problem, mine, name, what)
    return [*faults.values(), *_integrated_coordinates(problem, known, coordinates)]


def _integrated_coordinates(
    problem: Problem, known: Mapping[str, Quantity], coordinates: Collection[Symbol]
) -> list[Complaint]:
    named = {as_printed(q): q for q in coordinates}
    own = [
        (q, quantity.key)
        for quantity in (known.values() if named else ())
        if not quantity.coordinates
        for form in quantity.step.chain
        for variable in _integrated(form.expr)
        if (q := named.get(as_printed(variable))) is not None
    ]
    message = "`{}` is a coordinate, but the step `{}` integrates over a variable of that name"
    place = problem.script.returns if problem.script else None
    help_line = "name the coordinates before the bodies, so that the bodies take other symbols"
    return [
        Complaint("letter-clash", message.format(q.name, key), place, help=help_line) for q, key in dict(own).items()
    ]


def letters_in_use(problem: Problem) -> list[Symbol]:
    """Return the symbols that occur in inputs, have numbers or are defined; a symbol that is only declared is not in
    use."""
    found = [letter for given in problem.givens for letter in given.letters]
    found += [measured.symbol for measured in problem.measured]
    return list(dict.fromkeys([*found, *(each.symbol for each in problem.defined)]))


def as_printed(name: Any) -> str:
    return latex(_NOTATION.layout(name))


def meanings(step: Step, letters: Iterable[Symbol] = ()) -> Iterator[tuple[Any, str]]:
    """Yield every name that a step introduces, with its meaning; `letters` are symbols that the problem declares."""
    yield from _named_by(step)
    for q, _ in step.coordinates:
        yield q, "a coordinate has the same name"
        yield from ((rate(q, n), f"it is a rate of the coordinate `{q.name}`") for n in range(1, len(RATES)))
    own: set[Basic] = {q for q, _ in step.coordinates}
    for form in step.chain:
        own |= {x for whole in form.expr.atoms(MassIntegral) for x, *_ in whole.args[5:]}  # these are not printed
        for variable in _integrated(form.expr):
            own.add(variable)
            yield variable, f"the step `{step.key}` integrates over it"
    free = {name for form in step.chain for name in form.expr.free_symbols if isinstance(name, Symbol)}
    for name in sorted(free - own - set(letters), key=str):
        yield name, f"the step `{step.key}` has another symbol that looks the same"


def _named_by(step: Step) -> Iterator[tuple[Any, str]]:
    symbol, result = step.symbol, f"the step `{step.key}` also uses this symbol for its result"
    if isinstance(symbol, Symbol):
        yield symbol, result
    elif isinstance(symbol, MatrixBase):
        yield from ((entry, result) for entry in symbol if isinstance(entry, Symbol))
    elif isinstance(symbol, MatrixSymbol) and symbol.shape == (3, 1):
        yield symbol, result
        yield from ((name, f"it is a component of `{symbol.name}`") for name in component_names(symbol.name))
    elif isinstance(symbol, MatrixSymbol):
        yield symbol, result
        yield from (
            (entry_name(symbol.name, i, j), f"it is an entry of `{symbol.name}`")
            for i in range(len(AXES))
            for j in range(len(AXES))
        )


def _integrated(expr: Any) -> Iterator[Symbol]:
    """Yield the printed variables of integrals and of antiderivatives in brackets."""
    for whole in expr.atoms(Integral, Bracket):
        if isinstance(whole, Integral):
            yield from whole.variables
        else:
            yield whole.args[1]


def _clash(problem: Problem, letter: Symbol, name: Any, what: str) -> Complaint:
    so = what if name.name == letter.name else f"`{name.name}` looks the same in print: {what}"
    message = f"`{letter.name}` is a symbol of this problem, but {so}"
    declared = any(f"{key}.{letter.name}" in problem.places for key in ("symbols", "define"))
    help_line = ANOTHER if declared else "declare another symbol of its kind under `symbols:`"
    return Complaint("letter-clash", message, _place(problem, letter), help=help_line)


def _place(problem: Problem, letter: Symbol) -> Place | None:
    """Return the place where the symbol is declared or used; None if the file has no such place."""
    given = next((given.name for given in problem.givens if letter in given.letters), "")
    keys = (f"define.{letter.name}", f"symbols.{letter.name}", f"given.{given}", "symbols", "given")
    return next((problem.places[key] for key in keys if key in problem.places), None)
