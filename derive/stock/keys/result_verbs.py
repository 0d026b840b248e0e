"""The verbs of `results:`: which keys each one uses, and what it yields.

The check of a file, the schema for editors and the table of the manual follow from this one table.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any

from derive.course.schema import Record
from derive.errors import Faults, did_you_mean


@dataclass(frozen=True)
class Verb:
    """One verb of `results:`.

    yields        what it finds, for the manual
    needs         the keys that it cannot do without, each with what it holds, for the manual
    uses          the further keys that have an effect
    one_of        keys of which it needs at least one
    excludes      pairs of keys of which the second has no effect beside the first
    of_formulas   whether its own key holds formulas, and not names of answers
    asks          whether it asks for an answer of its own, and is not made of one
    """

    yields: str
    needs: Mapping[str, str] = field(default_factory=dict)
    uses: Mapping[str, str] = field(default_factory=dict)
    one_of: tuple[str, ...] = ()
    excludes: tuple[tuple[str, str], ...] = ()
    of_formulas: bool = False
    asks: bool = False

    @property
    def keys(self) -> tuple[str, ...]:
        return (*self.needs, *self.uses)


_LETTER = {"symbol": ""}

VERBS: Mapping[str, Verb] = {
    "solve": Verb("the solution of linear equations", {"for": "letters, rates, accelerations, forces"}),
    "put_in": Verb(
        "the answer with these substituted",
        uses={"results": "", "values": "`{theta: 0}`", **_LETTER},
        one_of=("results", "values"),
    ),
    "roots": Verb(
        "the roots of an equation; of another answer, where it vanishes",
        {"for": "a letter, or `cos(theta)`"},
        {"root": "one of several: `positive`, `negative`, `largest`, `smallest`, `2`", "symbol": "one for each root"},
    ),
    "limit": Verb(
        "the limiting case; of an equation what is left of it, `{limit: motion_x, for: Omega, to: 0, order: 1}` to the "
        "first order",
        {"for": "a letter"},
        {"to": "a value or `infinity`, 0 by default", "order": "", **_LETTER},
    ),
    "where": Verb(
        "the condition, solved for the letter",
        {"for": "a letter"},
        {"is": "such as `'>'`, `'='` by default", "bound": "0 by default", "results": "an answer as the bound"},
        excludes=(("results", "bound"),),
    ),
    "maximum": Verb(
        "where the answer is greatest, and how large then", {"for": "a letter"}, {"within": "two values, `[0, pi/2]`"}
    ),
    "minimum": Verb(
        "where the answer is least, and how small then", {"for": "a letter"}, {"within": "two values, `[0, pi/2]`"}
    ),
    "leaves": Verb(
        "where a force of contact vanishes", {"for": "what specifies the place, such as `cos(theta)`", "start": ""}
    ),
    "solution": Verb(
        "the motion, from a linear equation; from `normal_modes` the motion of all coordinates, of which `both_x_1` is "
        "one if the result is called `both`",
        uses={
            "for": "a coordinate",
            "start": "",
            "start_rate": "0 by default",
            "values": "from `normal_modes`, in place of these three: `{x_1: A, x_2_dot: v}`, all else zero",
            "case": "",
        },
        one_of=("start", "values"),
        excludes=(("values", "for"), ("values", "start"), ("values", "start_rate")),
    ),
    "amplitude": Verb("the steady state of a driven oscillation", {"for": "a coordinate"}, _LETTER),
    "speed": Verb(
        "its squared rate, from a conserved energy",
        {"for": "a coordinate", "start": ""},
        {"start_rate": "0 by default", "results": "its equation of motion, where the energy alone does not suffice"},
    ),
    "period": Verb("the period, from such a squared rate", uses={"order": "in the amplitude", **_LETTER}),
    "beats": Verb("how often the amplitude of one of two swings comes back, from two frequencies", uses=_LETTER),
    "value": Verb(
        "the value of a formula of answers and of letters: `pi*rate/frequency`, `v - R*w`, `-S` of a force of "
        "constraint; its terms must fit",
        uses=_LETTER,
        of_formulas=True,
    ),
    "rate": Verb("how fast a motion that `solution` found, or another answer, changes"),
    "steady": Verb(
        "from the Lagrangian the condition of a steady motion, which `roots` solves",
        uses={"values": "`{r: r_0}`", "symbol": "letters of the cyclic rates"},
    ),
    "frequency": Verb(
        "from the effective potential small oscillations about a steady motion",
        {"results": "that motion"},
        {"for": "the letter that its condition eliminates", **_LETTER},
    ),
    "bracket": Verb(
        "the Poisson bracket of two answers, or of formulas in coordinates and momenta `p_x`",
        uses={"results": "answers by whose letters it may be written"},
        of_formulas=True,
    ),
    "noether": Verb(
        "from the Lagrangian what is conserved by the symmetry",
        {"values": "the shift of each coordinate, `{x: -y, y: x}`"},
        {"gained": "", **_LETTER},
    ),
    "answer": Verb(
        "of a body the tensor, a moment or radius of gyration, or the centre of mass about another point or axis: "
        "`{answer: moment_of_inertia_z, about: tip}`",
        uses={"about": "a point", "origin": "a point", "direction": "an axis", **_LETTER},
        one_of=("about", "origin", "direction"),
        asks=True,
    ),
}


def check_verb(written: Record, name: str, faults: Faults) -> None:
    """A result has one verb; `faults` takes the keys that have no effect with it, and those that it lacks."""
    named = {f.metadata["called"] or f.name: getattr(written, f.name) for f in fields(written) if f.metadata}
    there = [key for key, value in named.items() if key in written.values_at and value not in ({}, ())]
    found = [key for key in there if key in VERBS]
    if len(found) != 1:
        message = f"`{name}` needs one of {', '.join(f'`{verb}`' for verb in VERBS)}"
        faults.error("missing-key", message, written.places[found[1]] if found else written.places[""])
        return
    verb, keys = found[0], VERBS[found[0]].keys
    uses = f"`{verb}` uses {_listed(keys)}" if keys else f"`{verb}` uses no other key"
    for key in there:
        if key != verb and key not in keys:
            missing = [each for each in VERBS[verb].needs if each not in there]
            help_line = did_you_mean(key, missing) or uses
            faults.error("unused-key", f"`{key}` has no effect on `{verb}`", written.places[key], help=help_line)
    for first, second in VERBS[verb].excludes:
        if first in there and second in there:
            message = f"`{second}` has no effect on a `{verb}` with `{first}`"
            faults.error("unused-key", message, written.places[second], help="leave one of them out")
    for key in VERBS[verb].needs:
        if key not in there:
            faults.error("missing-key", f"`{verb}` needs `{key}`", written.places[verb], help=uses)
    one_of = VERBS[verb].one_of
    if one_of and not {*one_of} & {*there}:
        faults.error("missing-key", f"`{verb}` needs {_listed(one_of, 'or')}", written.places[verb], help=uses)


def schema_of_verbs() -> dict[str, Any]:
    """What a result may hold, verb by verb, as JSON schema."""
    return {"oneOf": [_schema_of(name, verb) for name, verb in VERBS.items()]}


def _schema_of(name: str, verb: Verb) -> dict[str, Any]:
    found: dict[str, Any] = {"required": [name, *verb.needs], "propertyNames": {"enum": [name, *verb.keys]}}
    if verb.one_of:
        found["anyOf"] = [{"required": [key]} for key in verb.one_of]
    if verb.excludes:
        found["not"] = {"anyOf": [{"required": list(pair)} for pair in verb.excludes]}
    return found


def _listed(keys: tuple[str, ...], last: str = "and") -> str:
    *others, final = (f"`{key}`" for key in keys)
    return f"{', '.join(others)} {last} {final}" if others else final
