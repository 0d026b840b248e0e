"""Systems as `given:` describes them: coordinates, places, bodies, what acts on them, and results."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import chain
from typing import Any

from sympy import Expr, Symbol

from derive.algebra.expressions import scalar
from derive.algebra.kinds import kind_of_dimension
from derive.algebra.ranges import Range
from derive.course.assumptions import Assumed, read_assumed
from derive.course.expression import Declared
from derive.course.problem_file import SortOfLetter
from derive.course.schema import SCALAR, TEXT, Record, as_written, key, mapping_of, one_or_more
from derive.course.stock import Described, InLetters, attempted, each
from derive.course.yaml_tree import Scalar, Tree, Word
from derive.course.yaml_tree import Sequence as Listed
from derive.errors import Faults, Place, rejected
from derive.mechanics import landing_surface, potential
from derive.mechanics.kinematics.coordinates import kind_of_rate
from derive.mechanics.kinematics.places import Location
from derive.mechanics.lagrange.momenta import kind_of_momentum
from derive.stock.keys.connections import (
    CONTACTS,
    DASHPOTS,
    JOINTS,
    MASSLESS_RODS,
    MOTORS,
    PULLEYS,
    STRINGS,
    SURFACES,
    WIRES,
    Connected,
    ContactKeys,
    DashpotKeys,
    JointKeys,
    MasslessRodKeys,
    MotorKeys,
    PulleyKeys,
    StringKeys,
    SurfaceKeys,
    wire_on,
)
from derive.stock.keys.deferred import Deferred, Material
from derive.stock.keys.formulas import FoundLetter
from derive.stock.keys.impacts import IMPACT, DescribedImpact, ImpactKeys
from derive.stock.keys.parts import (
    CENTRAL,
    CHARGES,
    CONSTRAINTS,
    DAMPING,
    FORCES,
    PARTICLES,
    SPRINGS,
    CentralKeys,
    ChargeKeys,
    ConstraintKeys,
    DampingKeys,
    ForceKeys,
    ParticleKeys,
    SpringKeys,
)
from derive.stock.keys.placed_bodies import BODIES, MovingBodyKeys
from derive.stock.keys.places import (
    COORDINATES,
    FUNCTIONS,
    PLACES,
    TURNS,
    Places,
    WrittenPlace,
    check_known,
    coordinate_letters,
    function_letters,
    is_letter,
)
from derive.stock.keys.results import RESULTS, names, read_results, written_in

STATE = mapping_of(SCALAR)
RELATIONS = as_written(one_or_more(SCALAR.schema), "a relation such as `l < r_0`, or a list of them")
POSITIVE_CONSTANT = "positive"  # the word before the symbol of a constant momentum, as in `phi: positive l`
INDIFFERENT_TO_STATES = (
    "kinetic_energy", "potential_energy", "lagrangian", "equations_of_motion", "momenta", "energy_function",
    "energy_function_rate", "hamiltonian", "hamilton_equations", "no_slip", "angular_velocity", "accelerations",
    "multipliers",
)  # fmt: skip
REPLACED_BY_LAGRANGIAN = (
    "axes", "places", "particles", "bodies", "gravity", "springs", "central", "potential", "charges",
    "constraints", "impact", "surfaces", "contacts", "pulleys", "wires", "strings", "massless_rods",
    "joints", "motors", "dashpots",
)  # fmt: skip
OF_CYCLIC = ("conserved", "routhian", "effective_potential", "equilibria")


@dataclass(frozen=True)
class SystemKeys(Record):
    """The keys of a system."""

    coordinates: Mapping[Word, SortOfLetter] = key(
        "the coordinates: `theta: angle`, `x: length`, `r: positive length`, `beta: angle in (0, pi/2)`",
        COORDINATES,
        required=True,
    )
    functions: Mapping[Word, SortOfLetter] = key(
        "prescribed functions of the time, such as the place of a shaken support: `X: length`, `L: positive length`; "
        "`X_dot` and `X_ddot` are the rates of X",
        FUNCTIONS,
    )
    axes: Mapping[Word, tuple[Mapping[Word, Tree], ...]] = key(
        "rotating axes, by the rotations that lead to them from the axes fixed in space: `hoop: [{z: omega*t}]`", TURNS
    )
    points: Mapping[Word, WrittenPlace] = key(
        "places by name: `A: [l*sin(theta), -l*cos(theta)]`, `B: {from: A, by: [x, y]}`; the last component is upwards",
        PLACES,
        called="places",
    )
    particles: Mapping[Word, ParticleKeys] = key("particles by name", PARTICLES)
    bodies: Mapping[Word, MovingBodyKeys] = key("rigid bodies by name", BODIES)
    gravity: Tree | None = key("the acceleration of free fall, downwards; without gravity nothing has weight", SCALAR)
    springs: Sequence[SpringKeys] = key("springs without mass", SPRINGS)
    central: Sequence[CentralKeys] = key("potential energies that depend on the distance between two places", CENTRAL)
    lagrangian: Tree | None = key(
        "the Lagrangian itself, given as a formula of coordinates, their rates and `t`, in place of all bodies: "
        "`-m*c**2*sqrt(1 - x_dot**2/c**2)`; only torques and drag with `on` may be added",
        SCALAR,
    )
    potential: Tree | None = key("a further potential energy, as a function of the coordinates", SCALAR)
    forces: Sequence[ForceKeys] = key("given forces and torques", FORCES)
    damping: Sequence[DampingKeys] = key("drag that is proportional to a velocity and opposite to it", DAMPING)
    charges: Sequence[ChargeKeys] = key("charges in uniform fields", CHARGES)
    constraints: Sequence[ConstraintKeys] = key("conditions that constraint forces enforce", CONSTRAINTS)
    surfaces: Mapping[Word, SurfaceKeys] = key("surfaces that bodies touch, by name", SURFACES)
    contacts: Sequence[ContactKeys] = key(
        "bodies that touch a surface, with the normal force and friction: `{of: disc, on: road, friction: rolling}`",
        CONTACTS,
        instead_of="rolling",
    )
    pulleys: Mapping[Word, PulleyKeys] = key("massless frictionless pulleys with a radius, by name", PULLEYS)
    wires: Sequence[Word] = key(
        "particles that are threaded on a smooth wire: each has one coordinate, and the wire is the curve on which the "
        "particle moves when this coordinate changes",
        WIRES,
    )
    strings: Sequence[StringKeys] = key("massless inextensible strings", STRINGS)
    massless_rods: Sequence[MasslessRodKeys] = key("rigid rods without mass", MASSLESS_RODS)
    joints: Sequence[JointKeys] = key("hinges, ball joints and rigid joints", JOINTS)
    motors: Sequence[MotorKeys] = key("motors that prescribe an angle at each time", MOTORS)
    dashpots: Sequence[DashpotKeys] = key("dampers between two points", DASHPOTS)
    impact: ImpactKeys | None = key("impulses and collisions at one instant", IMPACT, instead_of="blow")
    conserved: Mapping[Word, Tree] = key(
        "symbols for the constant momenta of cyclic coordinates, `phi: l`, `phi: positive l`, or their values, "
        "`psi: C*s`",
        mapping_of(SCALAR),
    )
    assume: Tree | None = key(
        "inequalities that hold between constant symbols: `[l < r_0, a < b < c, v_0**2 < g*R]`", RELATIONS
    )
    at: Tree | None = key(
        "the state about which equations are linearised and stability is decided: `{theta: 0}`, or an equilibrium by "
        "its name, `rest_3`. By default, stability is decided at all equilibria. Equations are by default linearised "
        "where all coordinates are 0 or, if a constant momentum or a given force shifts the equilibrium, at the "
        "shifted equilibrium",
        as_written({"anyOf": [TEXT.schema, STATE.schema]}, "a state such as `{theta: 0}`, or the name of one"),
    )
    results: Mapping[Word, Record] = key("quantities computed from answers, by names that you choose", RESULTS)


@dataclass(frozen=True)
class DescribedSystem(Described):
    """A described system, whose values are expressions in its symbols.

    coordinates   the name of each coordinate, its kind, and whether it is positive
    particles, bodies   the particles and the bodies by name, in the order of the file
    acting        all other parts of the system, grouped by kind
    surfaces      the surfaces by name
    pulleys       the massless pulleys by name
    gravity       the acceleration of free fall; None if nothing has weight
    conserved     each cyclic coordinate whose constant momentum has a symbol, with this symbol
    kept          each cyclic coordinate whose constant momentum has a given value, with this value
    at, at_rest   the state about which motions are linearised: values of coordinates, or the name of an equilibrium
    impact        impulses and collisions at one instant
    brought       the symbols of constraint forces and of constant momenta, with their positions in the file
    named         the places that have names
    places        the reader of places, by their names or components
    given         a Lagrangian that replaces all bodies, and its kind
    """

    has_methods = True
    coordinates: tuple[tuple[str, str, bool], ...] = ()
    particles: Mapping[str, Deferred[Any]] = field(default_factory=dict)
    bodies: Mapping[str, Deferred[Any]] = field(default_factory=dict)
    acting: tuple[Deferred[Any], ...] = ()
    surfaces: Mapping[str, Deferred[Any]] = field(default_factory=dict)
    pulleys: Mapping[str, Deferred[Any]] = field(default_factory=dict)
    gravity: Expr | None = None
    conserved: tuple[tuple[str, Symbol], ...] = ()
    kept: tuple[tuple[str, Expr], ...] = ()
    at: tuple[tuple[str, Expr], ...] = ()
    at_rest: Word | None = None
    impact: DescribedImpact | None = None
    brought: Mapping[str, Place] = field(default_factory=dict, repr=False, compare=False)
    place: Place | None = field(default=None, repr=False, compare=False)
    named: tuple[Location | Material, ...] = ()
    places: Places | None = field(default=None, repr=False, compare=False)
    given: tuple[Expr, str | None] | None = None


def read(written: SystemKeys, symbols: Mapping[str, Declared], faults: Faults) -> DescribedSystem:
    """Return the description with its values as expressions in the declared symbols and the coordinates."""
    letters = coordinate_letters(written.coordinates, symbols, faults)
    functions = function_letters(written.functions, symbols, letters, faults)
    known = InLetters({**symbols, **functions, **letters})
    carried = {name: one.at for name, one in written.particles.items()}
    places = Places(written.points, written.axes, known, carried, written.bodies)
    named = attempted(faults, places.all_named) or {}
    parts = _parts(written, places, known, faults)
    given = attempted(faults, _lagrangian, written, known)
    gravity = attempted(faults, _value, known.value, written.gravity, "gravity", "acceleration")
    energy = attempted(faults, _value, known.of_kind, written.potential, "potential", "energy")
    if energy is not None:
        parts["acting"] += (Deferred(potential, (energy,), place=written.values_at["potential"]),)
    brought = _brought(written, places.axes_of_motion)
    attempted(faults, _check_different, brought)
    kept = attempted(faults, _kept, written.conserved, letters, known) or ()
    forces = _multipliers(parts["acting"])
    own = {**letters, **functions, **forces, **_constants(written.conserved, letters, known, faults)}
    names = [*map(str, (*written.bodies, *written.particles))]
    impact = attempted(faults, written.impact.read, letters, forces, names, places, known) if written.impact else None
    own |= impact.letters if impact else {}
    own |= attempted(faults, _steady_rates, written, letters, known) or {}
    momenta = _momenta(written.coordinates, letters, given[1] if given is not None else "energy")
    with_own = known.also({**momenta, **symbols, **own})
    results = read_results(written.results, with_own, faults)
    moving = {**letters, **functions}
    constants = {name: letter for name, letter in {**symbols, **own}.items() if name not in {*moving, *forces}}
    assumed = attempted(faults, _assumed, written.assume, constants, moving) or ()
    rest = written.at.word if isinstance(written.at, Scalar) and not written.at.empty else None
    return DescribedSystem(
        assumed=assumed,
        letters=own,
        without=_without(written, [*own], [*impact.letters] if impact else []),
        chosen=known.chosen,
        measured=tuple(known.numbers.measured),
        coordinates=tuple(
            (str(n), letters[n].kind, bool(letters[n].symbol.is_positive)) for n in written.coordinates if n in letters
        ),
        **parts,
        gravity=gravity,
        conserved=tuple((str(q), own[n].symbol) for q, (n, _) in _symbols(written.conserved).items() if n in own),
        kept=kept,
        at=_state(None if rest else written.at, letters, with_own, faults),
        at_rest=rest,
        results=results,
        impact=impact,
        brought={str(name): name.place for name in brought},
        place=written.places[""],
        named=tuple(named.values()),
        places=places,
        given=given,
    )


def _parts(written: SystemKeys, places: Places, known: InLetters, faults: Faults) -> dict[str, Any]:
    """Return the fields of `DescribedSystem` for the parts of the system."""

    def of_each(keys: Sequence[Any], *more: Any) -> list[Any]:
        return attempted(faults, each, [partial(one.part, *more) for one in keys]) or []

    def by_name(keys: Mapping[Word, Any], *more: Any) -> dict[str, Any]:
        found = attempted(faults, each, [partial(one.part, name, *more) for name, one in keys.items()]) or []
        return {str(name): one for name, one in zip(keys, found, strict=False)}

    particles = by_name(written.particles, places, known)
    several: list[Sequence[Any]] = [written.springs, written.central, written.charges, written.constraints]
    acting = [*chain(*(of_each(keys, places, known) for keys in several))]
    bodies = by_name(written.bodies, len(written.bodies) == 1, places, known)
    names = {str(name) for name in (*written.bodies, *written.particles)}
    surfaces = by_name(written.surfaces, places, known, names)
    pulleys = by_name(written.pulleys, places, known)
    rolling = sum(each.friction == "rolling" for each in written.contacts)
    connected = Connected(names, surfaces, pulleys, places, known, rolling)
    acting += pulleys.values()
    if len(surfaces) == len(written.surfaces) and len(pulleys) == len(written.pulleys):
        acting += of_each(_connections(written), connected)
        for name, point in filter(None, (one.touched_by(connected) for one in written.contacts)):
            places.contacts.setdefault(name, []).append(point)
    for i, name in enumerate(written.wires):
        if name in written.wires[:i]:
            faults.error("twice", f"`{name}` is on a wire twice", name.place, help="name it once")
    acting += attempted(faults, each, [partial(wire_on, name, connected) for name in written.wires]) or []
    _check_surfaces_used(written, faults)
    _check_pulleys(written, faults)
    acting += [Deferred(landing_surface, (one,)) for name, one in surfaces.items() if name in _landed_on(written)]
    with_friction = known.also(_multipliers(acting))  # friction is proportional to a constraint force
    acting += of_each([*written.forces, *written.damping], places, with_friction, names)
    own = {"particles": particles, "bodies": bodies, "surfaces": surfaces, "pulleys": pulleys}
    return {**own, "acting": tuple(acting)}


def _landed_on(written: SystemKeys) -> set[str]:
    """Return the names of the surfaces on which a flight ends and that no contact names."""
    named = {str(held["on"]) for result in written.results.values() if "on" in (held := written_in(result))}
    return named - {str(each.on) for each in written.contacts}


def _check_surfaces_used(written: SystemKeys, faults: Faults) -> None:
    used = {str(each.on) for each in written.contacts} | _landed_on(written)
    if used <= {str(name) for name in (*written.surfaces, *written.bodies)}:
        for name in written.surfaces:
            if name not in used:
                help_line = (
                    "describe the contact under `contacts`, name the surface under `on` of `lands`, or leave it out"
                )
                faults.error("unused-key", f"no contact uses the surface `{name}`", name.place, help=help_line)


def _check_pulleys(written: SystemKeys, faults: Faults) -> None:
    over = {str(place.name) for each in written.strings for place in each.over if place.name is not None}
    known = {*written.pulleys, *written.bodies, *written.particles, *written.points}
    for name in written.pulleys:
        if name in {*written.bodies, *written.particles, *written.points}:
            message = f"`{name}` is the name of a pulley and of a body, a particle or a place"
            faults.error("twice", message, name.place, help="give the pulley another name")
        elif name not in over and {each.partition(".")[0] for each in over} <= known:
            help_line = "name it under `over` of a string, or leave the pulley out"
            faults.error("unused-key", f"no string runs over the pulley `{name}`", name.place, help=help_line)


def _connections(written: SystemKeys) -> list[Any]:
    lines = [*written.strings, *written.massless_rods]
    return [*written.contacts, *lines, *written.joints, *written.motors, *written.dashpots]


def _lagrangian(written: SystemKeys, letters: InLetters) -> tuple[Expr, str | None] | None:
    """Return the formula of a given Lagrangian and the kind of its values, which is None if no kind has this dimension.
    Return None if no Lagrangian is given."""
    if written.lagrangian is None:
        return None
    beside = next((name for name in REPLACED_BY_LAGRANGIAN if name in written.places), None)
    if beside is not None:
        message = f"`{beside}` cannot be combined with `lagrangian`, which replaces bodies and forces"
        rejected(
            "given-lagrangian",
            message,
            written.places[beside],
            f"leave `{beside}` out: the formula alone describes the system",
        )
    value, dimension = letters.read(written.lagrangian, "lagrangian", "a formula of coordinates and rates")
    return value, kind_of_dimension(dimension)


def _without(written: SystemKeys, found: Sequence[str], impulses: Sequence[str]) -> tuple[tuple[Word, set[str]], ...]:
    """Return the keys `at`, `conserved` and `impact`, if the author wrote them, each with answers that do not depend on
    it."""
    of_each = ("motion", "momentum", "acceleration")
    one = {f"{name}_{q}" for name in of_each for q in written.coordinates}
    general = one | {*found, *INDIFFERENT_TO_STATES}
    of_state = general | {f"{name}_{q}" for name in ("conserved", "constant") for q in written.coordinates}
    of_rest = {"stability", "linearised", "normal_modes", "frequency", "period"}
    found_for = {
        "at": {*of_state, *OF_CYCLIC},
        "conserved": general,
        "impact": {*of_state, *OF_CYCLIC, *of_rest} - {*impulses},
    }
    return tuple(
        (Word.at(key, written.places[key]), names) for key, names in found_for.items() if key in written.values_at
    )


def _value(reading: Callable[..., Expr], node: Tree | None, name: str, kind: str) -> Expr | None:
    return reading(node, name, kind) if node is not None else None


def _assumed(
    written: Tree | None, constants: Mapping[str, Declared], coordinates: Mapping[str, Declared]
) -> tuple[Assumed, ...]:
    nodes = written.items if isinstance(written, Listed) else (written,)
    entries = each([partial(read_assumed, node, constants, coordinates) for node in nodes if node is not None])
    return tuple(chain(*entries))


def _momenta(
    written: Mapping[Word, str], coordinates: Mapping[str, Declared], lagrangian: str | None
) -> dict[str, Declared]:
    """Return the symbols of momenta, for functions of coordinates and momenta such as `x*p_y - y*p_x`."""
    kinds = {f"p_{q}": kind_of_momentum(coordinates[q].kind, lagrangian) for q in written if q in coordinates}
    return {name: Declared(name, scalar(name), kind) for name, kind in kinds.items() if kind is not None}


def _multipliers(keeping: Iterable[Deferred[Any]]) -> dict[str, Declared]:
    names = [name for one in keeping for name in one.forces]
    return {name: FoundLetter(name, scalar(name), "force") for name in names}


def _brought(written: SystemKeys, axes: str) -> list[Word]:
    """Return the symbols that the description introduces for constraint forces and for constant momenta.

    axes    the axes along which the forces have components
    """
    forces = [one.force for one in written.constraints]
    forces += [symbol for one in _connections(written) for symbol in one.symbols(axes)]
    return [*(force for force in forces if force), *(symbol for symbol, _ in _symbols(written.conserved).values())]


def _symbols(written: Mapping[Word, Tree]) -> dict[Word, tuple[Word, bool]]:
    """Return the symbols of constant momenta, each with `True` if it is declared positive."""
    found = {}
    for q, node in written.items():
        word = node.word if isinstance(node, Scalar) else ""
        name = word.removeprefix(f"{POSITIVE_CONSTANT} ").strip()
        if is_letter(name):
            found[q] = (Word.at(name, node.place), name != word)
    return found


def _check_different(brought: Sequence[Word]) -> None:
    for i, word in enumerate(brought):
        if word in brought[:i]:
            message = f"`{word}` already denotes something else"
            rejected("letter-clash", message, word.place, "use another symbol")


def _steady_rates(written: SystemKeys, letters: Mapping[str, Declared], known: InLetters) -> dict[str, Declared]:
    """Return the symbols for the rates of steady motions."""
    found = {}
    for result in written.results.values():
        held = written_in(result)
        if "steady" in held:
            placed = {str(letter) for letter, _ in held["values"].items()} if "values" in held else set()
            turning = [q for q in written.coordinates if q in letters and q not in placed]
            for q, name in zip(turning, names(held.get("symbol")), strict=False):
                known.unused(name, "leave it out of `symbols`, or give the rate another symbol")
                found[str(name)] = Declared(str(name), scalar(name, positive=True), kind_of_rate(letters[q].kind))
    return found


def constant(name: str, positive: bool = False) -> Symbol:
    """Return the symbol of a constant momentum, which is nonzero or, if declared so, positive."""
    return scalar(name, positive=True) if positive else Symbol(name, real=True, nonzero=True)


def _constants(
    written: Mapping[Word, Tree], letters: Mapping[str, Declared], known: InLetters, faults: Faults
) -> dict[str, Declared]:
    found = {}
    for q in written:
        attempted(faults, check_known, q, letters, "coordinate")
    for q, (name, is_positive) in _symbols(written).items():
        if q in letters:
            attempted(faults, known.unused, name, "leave it out of `symbols`, or give the momentum another symbol")
            found[str(name)] = Declared(str(name), constant(name, positive=is_positive), _momentum(letters[q]))
    return found


def _kept(
    written: Mapping[Word, Tree], letters: Mapping[str, Declared], known: InLetters
) -> tuple[tuple[str, Expr], ...]:
    """Return the values of constant momenta that are given by an expression, `psi: C*s`."""
    values = {q: node for q, node in written.items() if q in letters and q not in _symbols(written)}
    of_each = {q: (node, f"the momentum of {q}", _momentum(letters[q])) for q, node in values.items()}
    return tuple((str(q), known.of_kind(*of)) for q, of in of_each.items())


def _momentum(q: Declared) -> str:
    return "angular momentum" if q.kind == "angle" else "momentum"


def _state(
    written: Tree | None, coordinates: Mapping[str, Declared], letters: InLetters, faults: Faults
) -> tuple[tuple[str, Expr], ...]:
    def one(q: Word, node: Tree) -> tuple[str, Expr]:
        check_known(q, coordinates, "coordinate")
        value = letters.of_kind(node, str(q), coordinates[q].kind)
        _check_range(q, value, coordinates[q].lies)
        return str(q), value

    values = (STATE.read(written, "at", faults) or {}) if written else {}
    return tuple(attempted(faults, each, [partial(one, q, node) for q, node in values.items()]) or ())


def _check_range(q: Word, value: Expr, lies: Range | None) -> None:
    """Reject a number that is not inside the range of its coordinate, because small displacements need room on both
    sides."""
    if lies is not None and value.is_number and not (lies.least < value and value < lies.greatest):
        message = f"`{q}` must be between {lies.least} and {lies.greatest}, so it cannot be {value} in a state"
        rejected("range", message, q.place, help=f"give `{q}` a wider range, or none")
