"""A problem as checked values, read from its YAML file and its script.

`load_problem` reports the errors of a file together. Names in prose and the keys of answers are checked later, when the
steps are known.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from collections.abc import Mapping as Table
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from pathlib import Path, PurePosixPath
from posixpath import normpath

from sympy import Integer, Symbol
from sympy.core.random import seed

from derive.algebra.dimensions import Dimension
from derive.algebra.expressions import IN_DEGREES, Amount, Relation, explicit
from derive.algebra.kinds import Asked, about_kind, unit_of_kind
from derive.algebra.order import Order, in_order
from derive.algebra.ranges import Range, within
from derive.course.assumptions import Assumed, check_assumed, narrowed, order_of
from derive.course.declarations import declared_letters
from derive.course.definitions import Defined, read_defined
from derive.course.expression import Declared
from derive.course.given import Given, Measured, read_givens, read_numbers, value_in_prose
from derive.course.own_figure import OwnFigure, read_figure
from derive.course.parts import Question
from derive.course.placement import Placement, case_label, placements
from derive.course.problem_file import MARKS_OF_BODY, SCRIPT, LimitKeys, ProblemKeys, SortOfLetter, written_problem
from derive.course.problem_set import form_of_set, path_of
from derive.course.prose import Prose
from derive.course.schema import THE_KEYS_ARE, read_record
from derive.course.script import Parameter, Script, imported_script, run
from derive.course.stock import Described, Methods, StockScript, stock_names, stock_script
from derive.course.unused import unused_in
from derive.course.variants import Chosen, Variation
from derive.course.yaml_tree import Mapping, Tree, Word, abridged, as_text
from derive.errors import Complaint, Faults, Place, did_you_mean, nearest
from derive.steps.defined import define
from derive.steps.record import Run, assume, recorded

DEFAULT_FIGURES = 4


@dataclass(frozen=True)
class Problem:
    """The checked contents of a problem's file; paths are relative to the root."""

    id: str
    path: str
    root: Path
    title: Prose
    statement: Prose
    symbols: Table[str, Declared]
    givens: tuple[Given, ...]
    measured: tuple[Measured, ...]
    parts: tuple[Question, ...]
    points: Fraction | None
    wording: Table[str, Table[str, Prose]]
    show: Table[str, str]
    figures: int
    drawings: tuple[Placement, ...]
    script: Script | StockScript = field(repr=False)
    script_path: str
    places: Table[str, Place] = field(repr=False)
    described: Described | None = None
    strategy: Prose | None = None
    note: Prose | None = None
    limits: tuple[LimitKeys, ...] = ()
    defined: tuple[Defined, ...] = ()
    uses_natural_quantities: bool = True
    observations: tuple[Word, ...] | None = None
    reference: str = ""
    variations: tuple[Variation, ...] = ()
    is_variant: bool = False
    in_prose: tuple[Given, ...] = ()  # values of a description that prose mentions, as in `<<body.sides>>`
    figure: OwnFigure | None = None
    units: tuple[Word, ...] = ()  # the units of answers that the set prefers
    warnings: tuple[Complaint, ...] = field(default=(), repr=False, compare=False)

    @property
    def set_id(self) -> str:
        return self.id.partition("/")[0]

    @property
    def inputs(self) -> tuple[str, ...]:
        """The problem's file, its script, and the modules that the script imports from its own folder."""
        modules = self.script.modules if isinstance(self.script, Script) else ()
        own = (module.relative_to(self.root).as_posix() for module in modules)
        return (self.path, *filter(None, [self.script_path]), *own)

    @property
    def asked(self) -> tuple[Word, ...]:
        """The names of the steps that parts, limiting cases and plots of curves ask for."""
        return _asked(self.parts, self.limits, self.drawings)

    @property
    def dimensions(self) -> dict[Symbol, Dimension]:
        """The dimension of every letter of `symbols`."""
        return {declared.symbol: declared.dimension for declared in self.symbols.values()}

    @property
    def ranges(self) -> dict[Symbol, Range]:
        """The ranges of letters, as declared and as narrowed by the assumed relations."""
        return narrowed(self._declared_ranges, self.assumed)

    @property
    def _declared_ranges(self) -> dict[Symbol, Range]:
        return {declared.symbol: declared.lies for declared in self.letters if declared.lies}

    @property
    def assumed(self) -> tuple[Assumed, ...]:
        """Relations between letters that are assumed to hold."""
        return self.described.assumed if self.described else ()

    @property
    def order(self) -> Order:
        """The order of letters that follows from the assumed relations."""
        return order_of(self.assumed, self.ranges)

    @property
    def letters(self) -> tuple[Declared, ...]:
        """The declared letters, and the letters that the description introduces."""
        return (*self.symbols.values(), *(self.described.letters.values() if self.described else ()))

    @property
    def amounts(self) -> dict[Symbol, Amount]:
        """The number of each letter that has a number, in the coherent SI unit or in degrees."""
        return self._in_the_si(self.measured)

    def _in_the_si(self, numbers: Iterable[Measured]) -> dict[Symbol, Amount]:
        units = {m.symbol: unit_of_kind(self.symbols[m.symbol.name].kind) for m in numbers}
        return {
            m.symbol: Amount(m.number, m.unit, m.factor)
            if m.unit in IN_DEGREES
            else Amount(m.si, units[m.symbol], Integer(1))
            for m in numbers
        }

    def cases_of(self, part: Question) -> dict[str, dict[Symbol, Amount]]:
        """Return the numbers of each case of a part, by the label of the case."""
        cases = next((placement.cases for placement in self.drawings if placement.key == part.cases), ())
        numbers = (self._in_the_si((*self.measured, *cases[0], *case)) for case in cases)
        return {case_label(i): amounts for i, amounts in enumerate(numbers)}

    @property
    def every_amount(self) -> list[tuple[Symbol, Amount]]:
        """Every letter with each of its numbers, including the numbers in the cases of a part."""
        cases = [case for part in self.parts for case in self.cases_of(part).values()]
        return [pair for numbers in (self.amounts, *cases) for pair in numbers.items()]

    def keys_in_cases(self, part: Question, answers: Iterable[str]) -> list[str]:
        """Return the keys of the numbers of these answers in each case, such as `torque_in_case_ii`."""
        return [f"{answer}_in_case_{case}" for case in self.cases_of(part) for answer in answers]

    @property
    def texts(self) -> tuple[Prose, ...]:
        """All prose of the file that is printed."""
        wording = (prose for by_outcome in self.wording.values() for prose in by_outcome.values())
        captions = (placement.caption for placement in self.drawings if placement.caption)
        around = (prose for prose in (self.strategy, self.note, *(each.why for each in self.limits)) if prose)
        own = [self.figure.alt, *filter(None, [self.figure.caption])] if self.figure else []
        return (self.title, self.statement, *own, *(part.ask for part in self.parts), *around, *wording, *captions)

    def place_of(self, *keys: str) -> Place:
        """Return the place of a key: `place_of("show", "spin")`, `place_of("given")`."""
        return self.places[".".join(keys)]


def load_problem(root: Path, problem_id: str, chosen: Chosen | None = None) -> Problem:
    """Return the problem, or raise one `Rejected` with the errors of its file and its script."""
    problem, faults = problem_and_faults(root, problem_id, chosen)
    faults.stop()
    return problem


def problem_and_faults(root: Path, problem_id: str, chosen: Chosen | None = None) -> tuple[Problem, Faults]:
    """Return the problem, and the errors in its drawings and its figure; these errors do not affect any step. Raise
    `Rejected` if there are other errors.

    chosen   the choices of a variant; by default the values of the file itself
    """
    faults, of_drawings = Faults(), Faults()
    path = path_of(root, problem_id)
    written = written_problem(root, problem_id, faults, chosen=chosen)
    script_path, script = _script(root, path, written.solve, faults)
    points = written.points_in_all(faults)
    if not all(kind.known for kind in written.symbols.values()):
        faults.stop()  # givens with a letter of unknown kind cannot be read
    pinned = pinned_by(written.symbols, written.values, written.given, written.places, script, faults)
    pinned = _by_method(pinned, written, script, faults)
    brought_in = pinned.described.letters if pinned.described else {}
    moving = pinned.described.letters if pinned.described else {}
    defined = read_defined(written.define.formulas, pinned.symbols, moving, faults)
    drawings = placements(written.drawings, {**brought_in, **pinned.symbols}, len(written.parts), of_drawings)
    _check_cases(written.parts, drawings, of_drawings)
    _check_plots(drawings, script, of_drawings)
    figure = read_figure(root, path, written.figure, drawings, of_drawings)
    asked, given = _asked(written.parts, written.limits, drawings), (pinned.givens, pinned.measured, pinned.described)
    warnings = () if faults or of_drawings else unused_in(written, asked, *given)
    if faults:
        faults.take(of_drawings)
        faults.stop()
    assert written.title is not None
    assert written.statement is not None
    assert script is not None
    if not chosen:
        _check_choices(root, problem_id, written, script, faults)
        faults.stop()
    form = form_of_set(root, problem_id.partition("/")[0])
    problem = Problem(
        id=problem_id,
        path=path,
        root=root,
        title=written.title,
        statement=written.statement,
        **vars(pinned),
        parts=written.parts,
        points=points,
        wording=written.wording,
        show=written.show,
        figures=written.figures or (form.figures if form else None) or DEFAULT_FIGURES,
        units=form.units if form else (),
        drawings=drawings,
        script=script,
        script_path=script_path,
        places=written.places,
        strategy=written.strategy,
        note=written.note,
        limits=written.limits,
        defined=defined,
        uses_natural_quantities=written.define.are_used,
        observations=written.observations,
        reference=as_text(written.reference),
        variations=written.variants,
        figure=figure,
        is_variant=bool(chosen),
        warnings=warnings,
    )
    return replace(problem, in_prose=(*_in_prose(problem, written.given),)), of_drawings


def _check_choices(
    root: Path, problem_id: str, written: ProblemKeys, script: Script | StockScript, faults: Faults
) -> None:
    """Report the errors that a choice of one variation causes while all other values are the values in the file. If a
    given value varies, an error at another place of the file is reported at the choice. If a number of `values:`
    varies, an error at another place is left out, because it may depend on other numbers, too."""
    for variation in written.variants:
        known: set[tuple[str, Place]] = set()
        for number in variation.tried:
            own = Faults()
            with own:
                varied = written_problem(root, problem_id, own, chosen={str(variation.name): number})
                if not own:
                    pinned_by(varied.symbols, varied.values, varied.given, varied.places, script, own)
            for each in own.complaints:
                is_here = each.place is not None and variation.contains(number, each.place)
                found = each if is_here else replace(each, place=variation.choices[number].place)
                assert found.place is not None
                if (is_here or variation.name not in written.values) and (found.code, found.place) not in known:
                    known.add((found.code, found.place))
                    faults.add(found)


def _in_prose(problem: Problem, given: Mapping | None) -> Iterator[Given]:
    """Yield the values of a description that prose mentions by their paths, such as `<<body.sides>>`."""
    if given is None or problem.described is None:
        return
    symbols = {**problem.described.letters, **problem.symbols}
    names = {mention.name for prose in problem.texts for mention in prose.mentions if not mention.of}
    for name in sorted(names - {*symbols, *(each.name for each in problem.givens)}):
        node = given.at(name)
        if node is not None and (value := value_in_prose(name, node, symbols, problem.measured)):
            yield value


def _asked(parts: Iterable[Question], limits: Iterable[LimitKeys], drawings: Iterable[Placement]) -> tuple[Word, ...]:
    answers = [answer for part in parts for answer in part.answers]
    limited = [name for each in limits for name in (each.of, each.step, each.known) if name]
    first: dict[str, Word] = {}
    # A diagram also shows equilibria that no part asks for.
    plotted: list[Word] = [each.plot[0] for each in drawings if len(each.plot) == 1 and not each.is_diagram]
    plotted += [name for drawing in drawings for name in drawing.curves]
    for name in (*answers, *limited, *plotted):  # the step of a limit may also be an answer of a part
        first.setdefault(str(name), name)
    return tuple(first.values())


def _by_method(pinned: Pinned, written: ProblemKeys, script: Script | StockScript | None, faults: Faults) -> Pinned:
    """Add to the description of a system the methods that the problem and its parts state."""
    of_names: dict[str, Word] = {}
    for part in written.parts:
        if part.method is not None:
            of_names = {**{str(name): part.method for name in part.answers}, **of_names}
    methods = Methods(written.method, of_names)
    if not methods.stated or pinned.described is None and isinstance(script, StockScript):
        return pinned  # no method is stated, or the description has errors, which have been reported
    if pinned.described is None or not pinned.described.has_methods:
        message = "a `method` leads to equations of motion, so it belongs to `solve: system`"
        faults.error("unused-key", message, methods.stated[0].place, help="leave it out")
        return pinned
    return replace(pinned, described=replace(pinned.described, methods=methods))


def _check_cases(parts: tuple[Question, ...], drawings: tuple[Placement, ...], faults: Faults) -> None:
    known = [placement.key for placement in drawings if placement.cases]
    for cases in (part.cases for part in parts if part.cases):
        if cases not in known:
            help_line = did_you_mean(cases, known) or "name one of `drawings:` that has `cases:`"
            faults.error("unknown-drawing", f"no drawing `{cases}` has cases", cases.place, help=help_line)


def _check_plots(drawings: tuple[Placement, ...], script: Script | StockScript | None, faults: Faults) -> None:
    for drawing in drawings:
        _check_panels(drawing, faults)
        _check_marks_of_body(drawing, script, faults)
        if drawing.is_of_engine and isinstance(script, Script):
            name = "plot" if drawing.plot else "curves"
            message, help_line = (
                f"`{name}` has no effect: the script of the problem draws its plots",
                "call `plot(...)` there",
            )
            faults.error("unused-key", message, (*drawing.plot, *drawing.curves)[0].place, help=help_line)
        elif drawing.plot and drawing.curves:
            message = f"the plot `{drawing.key}` cannot have both `plot` and `curves`"
            help_line = "write all answers under `curves`"
            faults.error("unused-key", message, drawing.curves[0].place, help=help_line)
        elif drawing.levels or (drawing.over and not drawing.is_diagram):
            _check_portrait(drawing, faults)
        elif drawing.is_diagram and len(drawing.over) > 1:
            message = f"the diagram `{drawing.key}` has one vertical axis, so `over` has one coordinate"
            faults.error("wrong-argument", message, drawing.place, help="such as `over: {theta: [-90 deg, 90 deg]}`")
        elif drawing.is_of_engine and (drawing.against is None or drawing.range is None):
            message = f"the plot `{drawing.key}` needs `against` with a letter, and `range` with two ends"
            faults.error(
                "missing-key", message, drawing.place, help="such as `against: theta, range: [-90 deg, 90 deg]`"
            )
        elif drawing.against and not drawing.is_of_engine:
            faults.error("unused-key", "`against` has no effect without `plot` or `curves`", drawing.against.place)


def _check_marks_of_body(drawing: Placement, script: Script | StockScript | None, faults: Faults) -> None:
    known = script.stock.shows if isinstance(script, StockScript) else ()
    for mark in drawing.marks:
        if mark.mark not in MARKS_OF_BODY:
            continue
        if drawing.is_of_engine or drawing.like or mark.mark not in known:
            what = "repeats another drawing" if drawing.like else "is not the drawing of a `body`"
            message = f"the mark `{mark.mark}` has no effect on `{drawing.key}`, which {what}"
            help_line = "leave out `like`" if drawing.like and mark.mark in known else "leave it out"
            faults.error("unused-key", message, mark.places["mark"], help=help_line)
        for name in mark.places.keys() - {"", "mark"}:
            message = f"`{name}` has no effect on the mark `{mark.mark}`"
            faults.error("unused-key", message, mark.places[name], help="leave it out")


def _check_panels(drawing: Placement, faults: Faults) -> None:
    """Report keys that have no effect on this sort of drawing."""
    if drawing.panels and max(len(drawing.cases), len(drawing.curves)) < 2:
        message = f"`panels` has no effect on `{drawing.key}`, which does not have several curves"
        faults.error("unused-key", message, drawing.place, help="leave it out, or add `cases` if this is a plot")
    if drawing.up and (len(drawing.plot) == 2 or drawing.is_diagram or drawing.levels):
        message = f"`up` has no effect on `{drawing.key}`, which is not a plot of curves"
        is_path = len(drawing.plot) == 2
        help_line = "leave it out" if is_path else "leave it out, or give the range of the vertical axis under `over`"
        faults.error("unused-key", message, drawing.up.place, help=help_line)
    if drawing.then and (len(drawing.plot) == 2 or drawing.is_diagram or drawing.levels or drawing.against != "t"):
        message = f"`then` has no effect on `{drawing.key}`, which is not a plot of curves against `t`"
        faults.error("unused-key", message, drawing.then.place, help="leave it out")
    of_plots = [("per", drawing.per), ("energies", drawing.energies)]
    for name, listed in [*of_plots] if not drawing.is_of_engine else [("without", drawing.without)]:
        if listed:
            what = "is a plot" if drawing.is_of_engine else "is not a plot of an answer"
            message = f"`{name}` has no effect on `{drawing.key}`, which {what}"
            faults.error("unused-key", message, listed[0].place, help="leave it out")
    for name, words in (("labels", drawing.labels), ("surfaces", drawing.surfaces)):
        if words and len(drawing.plot) != 2:
            message = f"`{name}` has no effect on `{drawing.key}`, which is not a path"
            faults.error("unused-key", message, words[0].place, help="leave it out")


def _check_portrait(drawing: Placement, faults: Faults) -> None:
    extra = drawing.against or (drawing.range.ends[0] if drawing.range else None)
    if drawing.panels:
        message = f"`panels` has no effect on the phase portrait `{drawing.key}`: each case has its own panel"
        faults.error("unused-key", message, drawing.place, help="leave it out")
    if not drawing.is_portrait:
        message = (
            f"the phase portrait `{drawing.key}` needs `plot` with one answer, `levels`, and `over` with two ranges"
        )
        help_line = "such as `plot: hamiltonian, levels: [m*g*l], over: {theta: [-180 deg, 180 deg], p_theta: [...]}`"
        faults.error("missing-key", message, drawing.place, help=help_line)
    elif extra:
        name = "against" if drawing.against else "range"
        message = f"`{name}` has no effect on the phase portrait `{drawing.key}`: `over` states its ranges"
        faults.error("unused-key", message, extra.place, help="leave it out")


def run_solve(problem: Problem, record: Run | None = None) -> object:
    """Return what the script's `solve()` returns; its steps and assumptions are added to the record."""
    with solving(problem, record or Run()):
        if isinstance(problem.script, StockScript):
            answers = problem.script.stock.answers(problem.described)
            found = answers.solve(problem.asked, problem.drawings)
            answers.mark(problem.drawings)
            return found
        return run(problem.script, {given.name: given.value for given in problem.givens})


@contextmanager
def solving(problem: Problem, record: Run) -> Iterator[None]:
    """Add to `record` the letters, numbers and assumptions of the problem, and then the steps of a `with` block."""
    record.numbers = {letter: explicit(amount) for letter, amount in problem.amounts.items()}
    written = {given.name: problem.places.get(f"given.{given.name}") for given in problem.givens}
    record.places = {name: place for name, place in written.items() if place}
    defined = {each.name: problem.places.get(f"define.{each.name}") for each in problem.defined}
    record.defined_at = {name: place for name, place in defined.items() if place}
    record.letters = _letters_of(problem)
    seed(1)  # SymPy chooses random points when it factors; with the same points, the result and the time do not vary
    with deriving(problem, record):
        for declared in problem.letters:
            _assume_range(declared)
        for each in problem.assumed:
            assume(each.relation)
        record.is_natural = problem.uses_natural_quantities
        define((each.symbol, each.formula) for each in problem.defined)
        yield


@contextmanager
def deriving(problem: Problem, record: Run) -> Iterator[None]:
    """Add the steps of a `with` block to `record`; the ranges and the order of the letters are known in the block."""
    with recorded(record), within(problem.ranges), in_order(problem.order):
        yield


def _letters_of(problem: Problem) -> set[str]:
    own = problem.described.letters if problem.described else {}
    given = {letter.name for each in problem.givens for letter in each.letters}
    named = {each.name for each in problem.defined}
    return {*own, *given, *named, *(measured.symbol.name for measured in problem.measured)}


def _assume_range(declared: Declared) -> None:
    if declared.lies is None:
        return
    least, greatest = declared.lies.least, declared.lies.greatest
    above, below = ("=" * closed for closed in declared.lies.closed)
    if least.is_finite and not (least.is_zero and about_kind(declared.kind).positive):
        assume(Relation(declared.symbol, f">{above}", least))
    if greatest.is_finite:
        assume(Relation(declared.symbol, f"<{below}", greatest))


def _script(root: Path, path: str, name: Word | None, faults: Faults) -> tuple[str, Script | StockScript | None]:
    """Return the path and the script. A script of the engine has the path "". After an error, the script is None."""
    if name is None:
        return "", None
    if name in stock_names():
        return "", StockScript(stock_script(name), name.place)
    shown_as = normpath((PurePosixPath(path).parent / name).as_posix()) if SCRIPT.fullmatch(name) else ""
    if not shown_as.startswith("problems/"):
        of_engine = f"a script of the engine ({', '.join(stock_names())})"
        what = f"a script such as `block.py` or `../hw9/block.py`, or {of_engine}"
        help_line = did_you_mean(name, stock_names())
        faults.error("wrong-type", f"`solve` must be {what}, but it is `{abridged(name)}`", name.place, help=help_line)
    elif not (file := root / shown_as).exists():
        beside = (other.name for other in file.parent.glob("*.py"))
        help_line = did_you_mean(name, [*beside, *stock_names()])
        faults.error("missing-file", f"the script `{name}` does not exist", name.place, help=help_line)
    else:
        with faults:
            module = "derive_problem_" + re.sub(r"\W", "_", f"{path}_{name.removesuffix('.py')}")
            return shown_as, imported_script(file, shown_as, module)
    return "", None


# -- what is given ----------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Pinned:
    """The checked contents of `symbols:`, `given:` and `values:`."""

    symbols: dict[str, Declared]
    givens: tuple[Given, ...]
    measured: tuple[Measured, ...]
    described: Described | None = None


def pinned_by(
    kinds: Table[Word, SortOfLetter],
    numbers: Table[Word, Tree],
    given: Mapping | None,
    places: Table[str, Place],
    script: Script | StockScript | None,
    faults: Faults,
) -> Pinned:
    """Read the keys `symbols:`, `values:` and `given:` of a file."""
    symbols = declared_letters(kinds, faults)
    moving: dict[str, str] = {}
    if isinstance(script, StockScript):
        moving |= dict.fromkeys(_names_under(given, "coordinates") - {*symbols}, "a coordinate")
        moving |= dict.fromkeys(_names_under(given, "functions") - {*symbols}, "a function of the time")
    for name in [name for name in moving if name in numbers]:
        place = next(word.place for word in numbers if word == name)
        message = f"`{name}` is {moving[name]}, so it cannot have a number"
        faults.error("changes", message, place, help="leave it out here")
    values = read_numbers({name: node for name, node in numbers.items() if name not in moving}, symbols, faults)
    if script is None:
        return Pinned(symbols, (), values)
    if isinstance(script, StockScript):
        return _described_by(script, given or Mapping((), script.returns), symbols, values, faults)
    nodes = {name.word: node for name, node in given.pairs} if given else {}
    asked = {parameter.name: parameter for parameter in script.parameters}
    _check_names(nodes, asked, places.get("given", places[""]), faults)
    givens, symbols = read_givens(
        {str(name): value for name, value in nodes.items() if name in asked},
        {name: parameter.kind for name, parameter in asked.items()},
        symbols,
        faults,
        notes={name: parameter.note for name, parameter in asked.items()},
        used=[str(measured.symbol) for measured in values],
        numbers={measured.symbol: measured.si for measured in values},
    )
    return Pinned(symbols, givens, (*values, *(measured for given in givens for measured in given.measured)))


def _names_under(given: Mapping | None, key: str) -> set[str]:
    declared = given.get(key) if given else None
    return {name.text for name, _ in declared.pairs} if isinstance(declared, Mapping) else set()


# codes of errors in one value, which do not depend on other keys
OF_ONE_VALUE = ("undeclared-symbol", "wrong-kind", "wrong-type", "not-positive", "dimension", "changes")


def _are_superfluous_keys(faults: Faults, given: Mapping) -> bool:
    """Return whether the only errors are unknown keys of entries under `given:`, none of which resembles a known
    key."""
    at_top = {name.place for name, _ in given.pairs}
    return all(
        each.code == "unknown-key" and (each.help or "").startswith(THE_KEYS_ARE) and each.place not in at_top
        for each in faults.complaints
    )


def _errors_of_values(reading: Callable[[Faults], object]) -> Faults:
    found = Faults()
    with found:
        reading(found)
    return Faults(each for each in found.complaints if each.code in OF_ONE_VALUE)


def _described_by(
    script: StockScript, given: Mapping, symbols: dict[str, Declared], values: tuple[Measured, ...], faults: Faults
) -> Pinned:
    """Read a description; every declared letter becomes a given, so that prose may mention it."""
    own = Faults()
    written = read_record(script.stock.keys, given, "`given`", own)
    if own:
        faults.take(own)
        if _are_superfluous_keys(own, given):
            faults.take(_errors_of_values(partial(script.stock.read, written, symbols)))
        return Pinned(symbols, (), values)
    described = script.stock.read(written, symbols, faults)
    symbols |= described.chosen
    lies = {letter.symbol: letter.lies for letter in (*symbols.values(), *described.letters.values()) if letter.lies}
    numbers = {measured.symbol: measured.si for measured in (*values, *described.measured)}
    check_assumed(described.assumed, lies, numbers, faults)
    givens = tuple(Given(name, Asked(known.kind), known.symbol) for name, known in symbols.items())
    told = (given for given in described.told if given.name not in symbols)
    return Pinned(symbols, (*givens, *told), (*values, *described.measured), described)


def _check_names(given: Table[Word, Tree], asked: Table[str, Parameter], place: Place, faults: Faults) -> None:
    """Check that the names of the givens are the parameters of `solve()`."""
    missing = [name for name, parameter in asked.items() if parameter.required and name not in given]
    for word in given:
        if word not in asked:
            close = nearest(word, missing)
            if close:
                missing.remove(close)
            help_line = f"did you mean `{close}`?" if close else None
            faults.error("unknown-given", f"`solve()` does not ask for `{word}`", word.place, help=help_line)
    for name in missing:
        faults.error("missing-given", f"`given` lacks `{name}`", place, notes=(asked[name].note,))
