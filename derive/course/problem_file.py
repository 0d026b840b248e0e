"""The contents of a problem's file, before its script is run and its expressions are read. This module needs no
SymPy."""

from __future__ import annotations

import re
from collections.abc import Iterable
from collections.abc import Mapping as Table
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any

from derive.algebra.kinds import KINDS
from derive.course.parts import (
    METHOD,
    OBSERVATIONS,
    OBSERVATIONS_MEANING,
    PARTS,
    POINTS,
    Question,
    points_in_all,
)
from derive.course.problem_set import mapping_in, path_of
from derive.course.prose import PROSE, PROSE_OR_NOTHING, Prose, read_prose
from derive.course.schema import (
    FIGURES,
    FORMULA,
    SCALAR,
    TEXT,
    Reader,
    Record,
    as_written,
    key,
    list_of,
    mapping_node,
    mapping_of,
    one_of,
    read_record,
    record_of,
    wrong_type,
)
from derive.course.variants import VARIANTS, Chosen, Variation, check_variations, with_choices
from derive.course.yaml_tree import Formula, Mapping, Scalar, Sequence, Tree, Word, as_text, shape_of
from derive.errors import Faults, did_you_mean

ANY_OUTCOME = ""
POSITIVE = "positive"  # the word that may be before a kind
SHOWN = ("full", "result", "hidden")
SCRIPT = re.compile(r"(\.\./){0,2}([A-Za-z0-9_-]{1,64}/){0,2}[A-Za-z0-9_-]{1,64}\.py")
CHAIN = "chain"  # in a sentence, the placeholder for the lines of its step
MARKS_OF_BODY = ("masses", "centre_of_mass", "principal_axes", "direction", "element")
MARKS = ("point", "line", "dashed", "length", "arrow", "angle", "turn", "circle", "cone", "curve", *MARKS_OF_BODY)
SIDES = ("left", "right", "up", "down")
_NUMBERS = "a mapping such as `{R: 20 cm, a: 5 cm}`"


class SortOfLetter(str):
    """The kind of a letter; `ends` is the text after `in`: the range of the letter.

    `positive` is true if the word `positive` is before the kind. If `known` is false, the kind is not valid, and the
    error has been reported.
    """

    ends: Scalar | None = None
    positive: bool = False
    known: bool = True


def sort_of_letter(node: Tree, name: str, faults: Faults, kinds: Iterable[str] = tuple(KINDS)) -> SortOfLetter:
    """Read a kind; for an unknown kind, report an error and return a kind with `known` set to false."""
    text, _, ends = node.text.partition(" in ") if isinstance(node, Scalar) else ("", "", "")
    positive, _, rest = text.strip().partition(" ")
    kind = rest.strip() if positive == POSITIVE else text.strip()
    known = kind in kinds
    if not known:
        help_line = did_you_mean(kind, kinds) or f"the kinds are {', '.join(kinds)}"
        message = f"the kind of `{name}` must be a known kind, but it is {shape_of(node)}"
        faults.error("unknown-kind", message, node.place, help=help_line)
    sort = SortOfLetter(kind if known else next(iter(kinds)))
    sort.known, sort.positive = known, positive == POSITIVE
    if ends and isinstance(node, Scalar):
        sort.ends = node.piece(len(node.text) - len(ends), len(ends))
    return sort


def schema_of_sorts(kinds: Iterable[str]) -> dict[str, Any]:
    """Return the JSON schema of the declaration of a letter."""
    plain = list(kinds)
    pattern = rf"^({POSITIVE} )?({'|'.join(plain)}) in [\[(].+,.+[\])]$"
    return {
        "anyOf": [{"enum": [*plain, *(f"{POSITIVE} {kind}" for kind in plain)]}, {"type": "string", "pattern": pattern}]
    }


def _sentences(node: Tree, name: str, faults: Faults) -> dict[str, Prose]:
    """Read the sentences for a step: one text for each outcome, or one text for all outcomes."""
    entries = [(o.text, n) for o, n in node.pairs] if isinstance(node, Mapping) else [(ANY_OUTCOME, node)]
    read = {outcome: read_prose(entry, name, faults) for outcome, entry in entries}
    found = {outcome: prose for outcome, prose in read.items() if prose}
    for prose in found.values():
        for again in [mention for mention in prose.mentions if mention.name == CHAIN and not mention.of][1:]:
            message = f"`<<{CHAIN}>>` stands for the lines of the step, which are printed once"
            faults.error("twice", message, again.place, help="leave all but one of them out")
    return found


SYMBOLS = mapping_of(Reader(schema_of_sorts(KINDS), sort_of_letter))
GIVEN = mapping_node({"anyOf": [SCALAR.schema, {"type": "array"}, {"type": "object"}]})
VALUES = mapping_of(SCALAR)
_FORMULAS = mapping_of(FORMULA, "a mapping such as `{omega_0: sqrt(k/m)}`, or `none`")
TOGETHER, APART = "together", "apart"  # all curves of a plot in one panel, or each in its own panel
NO_QUANTITIES = "none"  # `define: none`: results keep the letters of the problem


@dataclass(frozen=True)
class Definitions:
    """The contents of `define:`; `are_used` is false if results contain only the letters of the problem."""

    formulas: Table[Word, Formula] = field(default_factory=dict)
    are_used: bool = True


def _definitions(node: Tree, name: str, faults: Faults) -> Definitions:
    if isinstance(node, Scalar) and node.text.strip() == NO_QUANTITIES:
        return Definitions(are_used=False)
    return Definitions(_FORMULAS.read(node, name, faults) or {})


DEFINE = Reader({"anyOf": [{"enum": [NO_QUANTITIES]}, _FORMULAS.schema]}, _definitions, Definitions)
_WORDS = PROSE_OR_NOTHING.schema
_TEXTS = {"type": "object", "additionalProperties": _WORDS}


def _plotted(node: Tree, name: str, faults: Faults) -> tuple[Formula, ...] | None:
    items = node.items if isinstance(node, Sequence) else (node,)
    shown = tuple(item for item in items if isinstance(item, Scalar) and not item.empty)
    if len(shown) == len(items) == (2 if isinstance(node, Sequence) else 1):
        return tuple(map(Formula.of, shown))
    odd = next((item for item in items if item not in shown), node) if len(items) == 2 else node
    wrong_type(faults, f"`{name}`", "an answer, or a list of two answers or formulas", odd, _PATH)
    return None


_PATH = "such as `potential_energy`, or `[path_x, path_z]` for a path"
_PAIR = {"type": "array", "items": SCALAR.schema, "minItems": 2, "maxItems": 2}
PANELS = (TOGETHER, APART)
# directions from which a drawing in space is seen: azimuth and elevation in degrees
VIEWS = {"front": (0.0, 0.0), "side": (-90.0, 0.0), "top": (-90.0, 90.0)}
STEEPEST, ROUND = 90.0, 360.0  # the greatest elevation and azimuth
ENDS = list_of(FORMULA, "the two ends of a range, such as `[-60 deg, 60 deg]`", length=2)
PLOTTED = Reader({"anyOf": [TEXT.schema, _PAIR]}, _plotted)


def _degrees(most: float) -> Reader[float]:
    def read(node: Tree, name: str, faults: Faults) -> float | None:
        number = _DEGREES.fullmatch(node.text.strip()) if isinstance(node, Scalar) else None
        if number is not None and abs(float(number[1])) <= most:
            return float(number[1])
        wrong_type(faults, f"`{name}`", f"an angle from -{most:g} to {most:g} degrees, such as `30`", node)
        return None

    return Reader({"type": ["string", "number"], "pattern": _DEGREES.pattern}, read)


_DEGREES = re.compile(r"^(-?\d+(?:\.\d+)?)( deg)?$", re.ASCII)


@dataclass(frozen=True)
class ViewKeys(Record):
    """The direction from which a drawing in space is seen."""

    azimuth: float | None = key("the angle about z, from x towards y, in degrees", _degrees(ROUND), required=True)
    elevation: float | None = key("the angle above the xy plane, in degrees", _degrees(STEEPEST), required=True)


_VIEW_IS = "{} or a mapping such as `{{azimuth: 30, elevation: 20}}`".format(", ".join(VIEWS))
_VIEW = record_of(ViewKeys, "a view", _VIEW_IS)


def _view(node: Tree, name: str, faults: Faults) -> tuple[float, float] | None:
    if isinstance(node, Mapping):
        read = _VIEW.read(node, name, faults)
        if read is None or read.azimuth is None or read.elevation is None:
            return None
        return read.azimuth, read.elevation
    if isinstance(node, Scalar) and node.text in VIEWS:
        return VIEWS[node.text]
    wrong_type(
        faults, f"`{name}`", _VIEW_IS, node, did_you_mean(node.text, VIEWS) if isinstance(node, Scalar) else None
    )
    return None


VIEW: Reader[tuple[float, float]] = Reader({"anyOf": [{"enum": list(VIEWS)}, _VIEW.schema]}, _view)


_WAY = {"anyOf": [TEXT.schema, {"type": "array", "items": SCALAR.schema, "minItems": 2, "maxItems": 3}]}
_PLACE = {"anyOf": [*_WAY["anyOf"], {"type": "object", "additionalProperties": _WAY}]}
_A_PLACE, _A_WAY = "the name of a place or its components", "a direction: components, `x`, a place or an answer"


@dataclass(frozen=True)
class MarkKeys(Record):
    """The keys of one mark under `marks:` of a drawing."""

    mark: str | None = key(
        "what is drawn: a `point`, a solid `line`, a `dashed` line, a dimension line for a `length`, the `arrow` of a "
        "vector, the arc of an `angle`, the curved arrow of a `turn`, a dashed `circle`, the dashed `cone` that a "
        "drawn vector describes, or a solid `curve`. With `solve: body`, also: the `masses` of its parts, its "
        "`centre_of_mass`, its `principal_axes`, the `direction` of the axis of `moment_about`, or the `element` of "
        "its integrals",
        one_of(MARKS),
        required=True,
    )
    label: Formula | None = key("the letter, formula or answer that names the mark; by default no label", FORMULA)
    at: Tree | None = key(
        "the place of a point, the start of an arrow, the vertex of an angle, the centre of a turn or a circle, or the "
        "moving point of a curve. In a drawing in space, the default is the origin; if a body is given by its "
        "moments, the components are numbers relative to the semi-axes of the drawn ellipsoid",
        as_written(_PLACE, _A_PLACE),
    )
    start: Tree | None = key(
        "the start of a line or of a length; for an angle, the direction of its first side or a place on it",
        as_written(_PLACE, _A_PLACE),
        called="from",
    )
    end: Tree | None = key(
        "the end of a line or of a length; a place on a circle; for a cone, the answer whose arrow the drawing shows; "
        "for an angle, the direction of its second side or a place on it",
        as_written(_PLACE, _A_PLACE),
        called="to",
    )
    along: Tree | None = key(
        "the direction of an arrow, or of the axis of a turn, a circle or a cone: components, `x`, `y` or `z`, or the "
        "name of an answer that is a vector. A turn in a plane is counterclockwise by default, and clockwise with "
        "`[0, 0, -1]`",
        as_written(_WAY, _A_WAY),
    )
    side: str | None = key("the side on which the dimension line of a length is drawn", one_of(SIDES))
    size: Formula | None = key(
        "the length of an arrow, or the radius of a turn or of the arc of an angle, relative to the drawing", FORMULA
    )

    against: Formula | None = key("for a curve: the letter that varies along it", FORMULA)
    between: tuple[Formula, ...] = key(
        "for a curve: the range of the letter under `against`, such as `[-pi, pi]`", ENDS, called="range"
    )

    def has(self, name: str) -> bool:
        """Return whether the file has this key of the mark."""
        return getattr(self, name) not in (None, ())

    @property
    def written(self) -> tuple[str, ...]:
        """Return the contents of the keys of the mark as texts."""
        named = (self.mark, self.label, self.side, self.size, self.against, self.between)
        return *map(str, named), *map(as_text, (self.at, self.start, self.end, self.along))


MARKS_OF_DRAWING = list_of(
    record_of(MarkKeys, "a mark", "a mapping such as `{mark: point, label: S, at: [x, y]}`", "a mark"),
    "a list of marks such as `{mark: point, label: S, at: [x, y]}`",
    each="a mark",
)


@dataclass(frozen=True)
class DrawingKeys(Record):
    """The keys of one drawing under `drawings:`."""

    at: Tree | None = key(
        "where the drawing appears: `statement`, the letter of a part, the key of a step that a part asks for "
        "or shows, or `hidden`",
        as_written(TEXT.schema, "statement, the letter of a part, a step, or hidden"),
    )
    caption: Prose | None = key("what the drawing shows, in prose", PROSE_OR_NOTHING)
    width: Tree | None = key("the width, not counting the labels: `5 cm`", as_written(TEXT.schema, "a length"))
    like: Word | None = key(
        "if `solve` is `system`, `body` or `rotation`: the name of the drawing whose contents this further drawing "
        "repeats, with marks or values of its own",
        TEXT,
    )
    marks: tuple[MarkKeys, ...] = key(
        "if `solve` is `system`, `body` or `rotation`: [marks](#marks) that are drawn in addition, such as a centre of "
        "mass, a length, a velocity or an angle. With `solve: body`, marks under a name that is not the name of the "
        "body make a further drawing of the body",
        MARKS_OF_DRAWING,
    )
    without: tuple[Word, ...] = key(
        "if `solve` is `system`, `body` or `rotation`: labels such as `[x, y]`; the drawing leaves out the marks with "
        "these labels, such as dimension lines in a force diagram",
        list_of(TEXT, "a list of letters such as `[x, y]`", each="a letter"),
    )
    view: tuple[float, float] | None = key(
        "for a drawing in space: the direction from which it is seen, `front` (from x), `side` (from -y), `top` (from "
        "z) or its angles. The default is a view in which vectors and faces are visible, such as `{azimuth: 25, "
        "elevation: 18}`",
        VIEW,
    )
    values: dict[Word, Tree] = key(
        "letters and their values in the drawing: `h: 2*R`, `theta: 40 deg`", mapping_of(SCALAR, _NUMBERS)
    )
    plot: tuple[Formula, ...] | None = key(
        "if `solve` is `system`, `body` or `rotation`: the answer whose curve is drawn, such as `potential_energy`; or "
        "two answers or formulas, such as `[path_x, path_z]`, whose path is drawn. With `equilibria`, a bifurcation "
        "diagram is drawn",
        PLOTTED,
    )
    curves: tuple[Word, ...] = key(
        "if `solve` is `system`, `body` or `rotation`: answers with the same unit, such as `[weak, border, strong]`, "
        "whose curves are drawn in one plot",
        list_of(TEXT, "a list of answers such as `[weak, strong]`", each="a curve"),
    )
    against: Formula | None = key(
        "the coordinate, letter or `t` that varies: along the horizontal axis of curves, or along a path. With "
        "`plot: equilibria`, a letter or a ratio such as `omega/omega_c`",
        FORMULA,
    )
    labels: tuple[Word, ...] = key(
        "the names of the two axes of a path, such as `[x, y]`, in place of its formulas",
        list_of(TEXT, "the names of two axes, such as `[x, y]`", each="the name of an axis", length=2),
    )
    surfaces: tuple[Word, ...] = key(
        "for a path: the surfaces under `given` that are drawn too, such as `[sphere, floor]`",
        list_of(TEXT, "a list of surfaces such as `[sphere, floor]`", each="a surface"),
    )
    levels: tuple[Formula, ...] = key(
        "for a phase portrait: the values of the answer on its curves, such as `[-5 J, m*g*l]`; the curve of a value "
        "with letters is thick",
        list_of(FORMULA, "a list of values such as `[-5 J, m*g*l]`"),
    )
    over: dict[Word, tuple[Formula, ...]] = key(
        "for a phase portrait: a coordinate and its momentum, each with its two ends. For a bifurcation diagram: the "
        "coordinate with its two ends; by default, the vertical axis shows all equilibria",
        mapping_of(ENDS),
    )
    ends: tuple[Formula, ...] | None = key(
        "the two ends of the range of a plot, such as `[-60 deg, 60 deg]` or, with an answer, `[0 s, 2*top_time]`",
        ENDS,
        called="range",
    )
    then: Formula | None = key(
        "for curves against `t`: the answer or the formula whose value the curves keep after the range, such as `v_1`. "
        "The curves must have this value at the end of the range",
        FORMULA,
    )
    up: tuple[Formula, ...] | None = key(
        "the two ends of the vertical axis of curves, such as `[-1 J, 2 J]`; by default, the axis shows whole curves",
        ENDS,
    )
    energies: tuple[Formula, ...] = key(
        "for the curve of a potential energy: energies such as `[-3/8*G*M*m/r_0]`, each drawn as a horizontal line "
        "where a motion with this energy is possible",
        list_of(FORMULA, "a list of energies such as `[m*g*l/2]`", each="an energy"),
    )
    per: tuple[Formula, ...] = key(
        "the quantities by which the two axes of a plot are divided, such as `[r_0, G*M*m/r_0]`: answers or formulas, "
        "the horizontal axis first. `1` leaves an axis in its unit; a phase portrait needs a third quantity, for its "
        "levels",
        list_of(FORMULA, "a list of quantities such as `[r_0, G*M*m/r_0]`", each="a quantity"),
    )
    cases: tuple[dict[Word, Tree], ...] = key(
        "numbers for letters, one mapping for each curve of a plot; a later mapping needs only the numbers that differ "
        "from the numbers of the first mapping",
        list_of(mapping_of(SCALAR, _NUMBERS), "a list of mappings such as `{R: 20 cm, a: 5 cm}`", each="a case"),
    )
    panels: str | None = key(
        "whether several curves or paths are `together` in one panel or `apart`. By default, up to four curves "
        "share a panel; the curves of `cases` share it only if they have comparable sizes and, except for paths, the "
        "same range",
        one_of(PANELS),
    )


@dataclass(frozen=True)
class LimitKeys(Record):
    """The keys of one limit under `limits:`."""

    of: Word | None = key("the step whose limiting or special case is shown, by its key", TEXT)
    letter: Formula | None = key("the letter or the ratio that is small, large or near a value: `S`, `h/R`", FORMULA)
    to: Formula | None = key("the limit of the letter: `infinity` or a value; default 0", FORMULA)
    where: dict[Word, Formula] = key(
        "letters and their values in a special case, such as `{b: a, c: a}`",
        mapping_of(FORMULA, "a mapping such as `{b: a, c: a}`"),
    )
    step: Word | None = key("in place of `of`: the key of a step that is itself the limiting or special case", TEXT)
    stated: Formula | None = key("the result in that case; a wrong result is an error", FORMULA, called="is")
    known: Word | None = key("the key of a step that has the same result by another derivation", TEXT)
    why: Prose | None = key("words added to the sentence, in prose: `as for a disc`", PROSE)


def _limit(node: Tree, name: str, faults: Faults) -> LimitKeys | None:
    """Read an entry of `limits:`, which must have either `of` with `letter`, or `of` with `where`, or only `step`.
    Return None if these keys are missing or have errors."""
    found = _LIMIT.read(node, name, faults)
    if found is None:
        return None
    if any(way in found.values_at and getattr(found, way) is None for way in ("letter", "step", "of")):
        return None  # an error has been reported
    ways = [way for way in ("letter", "where", "step") if getattr(found, way)]
    if len(ways) != 1 or (found.of is None) != (ways == ["step"]):
        message = "a limit needs `of` with `letter`, or `of` with `where`, or only `step`"
        faults.error("missing-key", message, node.place, help="such as `{of: frequency, letter: M, to: infinity}`")
        return None
    if found.to is not None and ways != ["letter"]:
        faults.error("unknown-key", "`to` is allowed only with `letter`", found.places["to"])
    return found


def _way(*keys: str) -> dict[str, Any]:
    """Return the schema of a limit that has these keys and none of the other keys that specify a limit."""
    others = {"of", "letter", "where", "step"} - {*keys}
    return {"required": list(keys), "not": {"anyOf": [{"required": [key]} for key in sorted(others)]}}


_WAYS = {"oneOf": [_way("of", "letter"), _way("of", "where"), _way("step")], "dependencies": {"to": ["letter"]}}
_LIMIT = record_of(LimitKeys, "a limit", "a mapping such as `{of: frequency, letter: M, to: infinity}`", "a limit")
LIMITS = list_of(Reader({**_LIMIT.schema, **_WAYS}, _limit), "a list of limits", each="a limit")

_DRAWING = record_of(DrawingKeys, "a drawing", "a mapping with `at`, `caption` or `width`", "the drawing `{}`")


@dataclass(frozen=True)
class FigureKeys(Record):
    """The keys of `figure:`."""

    file: Word | None = key(
        "a PDF, SVG or PNG file; its path is relative to the folder of the problem", TEXT, required=True
    )
    alt: Prose | None = key("what the figure shows, for a reader who does not see it", PROSE, required=True)
    caption: Prose | None = key("the caption, in prose; with a caption the figure has a number", PROSE)
    width: Tree | None = key(
        "the width, such as `5 cm`; by default the width stated in the file, or less if the page has no room for it",
        as_written(TEXT.schema, "a length"),
    )


_FIGURE = record_of(FigureKeys, "a figure", "a mapping such as `{file: cart.pdf, alt: A cart on a track}`")


@dataclass(frozen=True)
class ProblemKeys(Record):
    """The keys of a problem's file."""

    title: Prose | None = key("the heading of the problem", PROSE, required=True)
    solve: Word | None = key(
        "the Python file whose `solve()` derives the answers, or a script of the engine: `system`, `body`, `rotation`",
        TEXT,
        required=True,
    )
    points: Fraction | None = key("total points; if all parts have points, these must add up to this total", POINTS)
    symbols: dict[Word, SortOfLetter] = key(
        "letters and their kinds, with what is known about the values: `M: mass`, `F: positive force`, "
        "`alpha: angle in (0, pi/2)`",
        SYMBOLS,
    )
    given: Mapping | None = key(
        "the arguments of `solve()`, by the names of its parameters: an expression, `2 cm`, or a list of these. If "
        "`solve` is `system`, `body` or `rotation`: the description of the system, body or rotation",
        GIVEN,
    )
    define: Definitions = key(
        "quantities in which results may be written, each with its formula: `{beta: b/(2*m), omega_0: sqrt(k/m)}`; "
        "with `none`, results contain only the letters of the problem",
        DEFINE,
    )
    values: dict[Word, Tree] = key("numbers for declared letters, substituted at the end: `a: 2 cm`", VALUES)
    variants: tuple[Variation, ...] = key(
        "what differs from student to student: letters of `values` or given values, each with a range, such as "
        "`10..30 cm in steps of 2`, or with a list of values",
        VARIANTS,
    )
    statement: Prose | None = key(
        "the problem in prose; `<<mass>>` stands for the given value `mass`, `$x^2$` is a formula", PROSE, required=True
    )
    strategy: Prose | None = key(
        "one or two sentences at the head of the solution: the method, and the reason for it", PROSE
    )
    method: Word | None = key(
        "the method for the equations of motion of a `system`: `lagrange` (default), `newton`, `energy`, "
        "`angular_momentum`, or `both` for Newton's laws and Lagrange's equations",
        METHOD,
    )
    parts: tuple[Question, ...] = key("the questions", PARTS, required=True)
    wording: Table[str, Table[str, Prose]] = key(
        "sentences that replace the default sentences of a step, by the step's key, or by key and outcome",
        mapping_of(Reader({"anyOf": [_WORDS, _TEXTS]}, _sentences)),
    )
    show: Table[str, str] = key("how much of a step is shown, by the step's key", mapping_of(one_of(SHOWN)))
    figures: int | None = key("significant figures where `form` states none", FIGURES)
    drawings: dict[Word, DrawingKeys] = key(
        "the drawings, by their names: where each appears, its caption, width and numbers, or what it plots",
        mapping_of(_DRAWING),
    )
    figure: FigureKeys | None = key("a figure of your own, which appears with the statement", _FIGURE)
    limits: tuple[LimitKeys, ...] = key("limiting and special cases that check the answers at the end", LIMITS)
    observations: tuple[Word, ...] | None = key(OBSERVATIONS_MEANING, OBSERVATIONS)
    note: Prose | None = key("a remark after the last part, in prose", PROSE)
    reference: Mapping | None = key("what a source states about the same problem", mapping_node({}))

    def points_in_all(self, faults: Faults) -> Fraction | None:
        return points_in_all(self.points, self.values_at.get("points"), self.parts, faults)


def written_problem(
    root: Path, problem_id: str, faults: Faults, quickly: bool = False, chosen: Chosen | None = None
) -> ProblemKeys:
    """Read the file; `faults` collects the errors in its keys and in the shapes of their values.

    chosen   the choices of a variant; by default the values of the file itself
    """
    mapping = mapping_in(root, path_of(root, problem_id), "a problem", quickly)
    if chosen and (node := mapping.get("variants")):
        mapping = with_choices(mapping, VARIANTS.read(node, "variants", Faults()) or (), chosen)
    written = read_record(ProblemKeys, mapping, "a problem", faults)
    check_variations(mapping, written.variants, faults)
    return written
