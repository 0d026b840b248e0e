"""A wrong law is refused at its own step, and so is a wrong second route: the check can fail both ways.

Each row replaces one piece of the source of a verb and names the step that must refuse. The verb is then called
on the block of sides a, 2a, 3a about its diagonal, all that it rests on being right. A definition asserts nothing, so
it has no wrong law; every other verb must be here.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from sympy import Integer, pi

import derive.mechanics
import derive.numbers
from derive import expressions as ex
from derive.errors import Unverified
from derive.evidence import Grade
from tests.mechanics.alteration import altered, verbs_as_imported
from tests.mechanics.block import AMOUNTS, M, a, block_derivation, known_block, omega
from tests.mechanics.slab import known_slab

Verbs = SimpleNamespace

BODIES, INERTIA, ROTATION = "mechanics.bodies", "mechanics.inertia", "mechanics.rotation"
EQUATIONS, INTEGRATION, NUMBERS = "mechanics.equations", "mechanics.integration", "numbers"
REGIONS = "mechanics.regions"
DEFINITIONS = {"any_angular_velocity", "changing_angular_velocity", "principal_tensor", "let"}


def block_of(verbs: Verbs) -> Any:
    return verbs.Cuboid((a, 2 * a, 3 * a), M)


def moved(verbs: Verbs) -> Any:
    block = block_of(verbs)
    return verbs.moved_to(verbs.inertia_tensor(block, about="corner", key="corner_tensor"), block.centre)


def along_the_diagonal(verbs: Verbs) -> Any:
    return verbs.spin(omega, along=block_of(verbs).direction(derive.mechanics.Direction("diagonal")))


def of_known(verb: str, *keys: str) -> Callable[[Verbs], Any]:
    """The verb called on quantities that were derived by the laws as they are."""
    return lambda verbs: getattr(verbs, verb)(*(known_block()[key] for key in keys))


RUNS: dict[str, Callable[[Verbs], Any]] = {
    "density": lambda verbs: block_of(verbs).density,
    "centre_of_mass": lambda verbs: block_of(verbs).centre,
    "inertia_tensor": lambda verbs: verbs.inertia_tensor(block_of(verbs), about="corner", key="corner_tensor"),
    "inertia_tensor at once": lambda verbs: verbs.inertia_tensor(block_of(verbs), about="centre"),
    "moved_to": moved,
    "spin": along_the_diagonal,
    "kinetic_energy": of_known("kinetic_energy", "inertia_tensor", "angular_velocity"),
    "angular_momentum": of_known("angular_momentum", "inertia_tensor", "spin"),
    "cosine_between": of_known("cosine_between", "spin", "angular_momentum"),
    "angle_between": of_known("angle_between", "spin", "angular_momentum"),
    "torque": of_known("torque", "spin", "angular_momentum"),
    "at": of_known("at", "kinetic_energy", "spin"),
    "magnitude": of_known("magnitude", "torque"),
    "value_of": lambda verbs: verbs.value_of(known_block()["magnitude"], AMOUNTS, "N m", Integer(1), 4),
    "value_of in degrees": lambda verbs: verbs.value_of(known_block()["angle_between"], {}, "degree", pi / 180, 4),
    "coefficient_of": lambda verbs: verbs.coefficient_of(known_block()["magnitude"], 4),
}

# what is called, module, a piece of its source, what is put there, the step that must refuse
LAWS = [
    ("density", BODIES, "Ratio(mass, extent),", "Ratio(2 * mass, extent),", "density"),
    ("density", BODIES, "Ratio(mass, extent),", "Ratio(extent, mass),", "density"),
    ("density", BODIES, "return Factors(*self.sides)", "return Factors(*self.sides[:2])", "density"),
    ("centre_of_mass", BODIES, "Pow(mass, -1), whole", "Pow(mass, -2), whole", "centre_of_mass"),
    ("centre_of_mass", BODIES, "Pow(mass, -1), whole", "2, Pow(mass, -1), whole", "centre_of_mass"),
    ("centre_of_mass", BODIES, "region = body.within(start, ", "region = body.within(body.middle, ", "centre_of_mass"),
    # the entries of the inertia tensor
    ("inertia_tensor", INERTIA, "enumerate(at) if k != i)", "enumerate(at) if k == i)", "corner_tensor_xx"),
    ("inertia_tensor", INERTIA, "sum((x**2 for k, x", "sum((x**3 for k, x", "corner_tensor_xx"),
    ("inertia_tensor", INERTIA, "else -at[i] * at[j]", "else at[i] * at[j]", "corner_tensor_xy"),
    ("inertia_tensor", INERTIA, "else -at[i] * at[j]", "else -at[i] ** 2", "corner_tensor_xy"),
    ("inertia_tensor", INERTIA, "Factors(-rho, region", "Factors(rho, region", "corner_tensor_xy"),
    (
        "inertia_tensor",
        INERTIA,
        "region = body.within(point, ",
        "region = body.within(body.middle, ",
        "corner_tensor_xx",
    ),
    # and the whole of it
    ("inertia_tensor", INERTIA, "Integer(-1), Outer(r, r)", "Integer(1), Outer(r, r)", "corner_tensor"),
    ("inertia_tensor", INERTIA, "Dot(r, r), Identity(3)", "2 * Dot(r, r), Identity(3)", "corner_tensor"),
    ("inertia_tensor", INERTIA, "at[(min(i, j), max(i, j))]", "at[(2 - max(i, j), 2 - min(i, j))]", "corner_tensor"),
    ("inertia_tensor", INERTIA, "at[(min(i, j), ", "(-1) ** int(bool(i > j)) * at[(min(i, j), ", "corner_tensor"),
    ("inertia_tensor at once", REGIONS, "-start, side - start)", "-start, side)", "inertia_tensor_xx"),
    ("inertia_tensor at once", BODIES, "*(side / 2 for side", "*(side / 3 for side", "inertia_tensor"),
    # an integral's lines, one by one
    (
        "inertia_tensor",
        INTEGRATION,
        "_separated(sign * term, region",
        "_separated(2 * sign * term, region",
        "corner_tensor_xx",
    ),
    (
        "inertia_tensor",
        INTEGRATION,
        "Mul(*(f for f in Mul.make_args(rest) if any(",
        "Mul(*(f**2 for f in Mul.make_args(rest) if any(",
        "corner_tensor_xx",
    ),
    (
        "inertia_tensor",
        INTEGRATION,
        "Bracket(whole, x, lower, upper)",
        "Bracket(own, x, lower, upper)",
        "corner_tensor_xx",
    ),
    (
        "inertia_tensor",
        INTEGRATION,
        "Bracket(whole, x, lower, upper)",
        "Bracket(whole, x, upper, lower)",
        "corner_tensor_xx",
    ),
    ("inertia_tensor", INTEGRATION, "values = [tuple(_one", "values = [tuple(2 * _one", "corner_tensor_xx"),
    (
        "inertia_tensor",
        INTEGRATION,
        "[Mul(*term) for term in values]",
        "[Mul(2, *term) for term in values]",
        "corner_tensor_xx",
    ),
    ("inertia_tensor", INTEGRATION, "Form(rho * value,", "Form(rho * value / 2,", "corner_tensor_xx"),
    ("inertia_tensor", INTEGRATION, "Group(volume * rho), rest", "Group(volume * rho), rest**2", "corner_tensor_xx"),
    (
        "inertia_tensor",
        INTEGRATION,
        "number, rest = -number, -rest",
        "number, rest = number, -rest",
        "corner_tensor_xy",
    ),
    (
        "inertia_tensor",
        INTEGRATION,
        "front = [] if rho == 1 else [rho]",
        "front = [] if rho == 1 else [-rho]",
        "corner_tensor_xx",
    ),
    # parallel axes, entry by entry and as a whole
    ("moved_to", INERTIA, "for k in range(3) if k != i and not", "for k in range(3) if not", "inertia_tensor_xx"),
    ("moved_to", INERTIA, "sign * Factors(mass, shift)", "-sign * Factors(mass, shift)", "inertia_tensor_xx"),
    ("moved_to", INERTIA, "-sign * Factors(mass, c[i], c[j])", "sign * Factors(mass, c[i], c[j])", "inertia_tensor_xy"),
    ("moved_to", INERTIA, "Factors(mass, c[i], c[j])", "Factors(mass, c[i], c[i])", "inertia_tensor_xy"),
    ("moved_to", BODIES, "*(side / 2 for side", "*(side / 3 for side", "corner_tensor"),
    # rotation
    ("spin", ROTATION, "scaled(w / Norm(d), d)", "scaled(w, d)", "spin"),
    ("spin", ROTATION, "scaled(w / Norm(d), d)", "scaled(-w / Norm(d), d)", "spin"),
    ("spin", ROTATION, "scaled(w / Norm(d), d)", "scaled(2 * w / Norm(d), d)", "spin"),
    ("spin", ROTATION, "scaled(w / Norm(d), d)", "scaled(w, column(0, 0, 1))", "spin"),
    ("spin", ROTATION, "Ratio(rate, length), along", "Ratio(rate, 2), along", "spin"),
    ("kinetic_energy", ROTATION, "Rational(1, 2), Dot(w, ", "Rational(1, 3), Dot(w, ", "kinetic_energy"),
    ("kinetic_energy", ROTATION, "Dot(w, applied(tensor, w))", "Dot(w, w)", "kinetic_energy"),
    ("kinetic_energy", ROTATION, "Dot(omega.value, product)", "Dot(omega.value, omega.value)", "kinetic_energy"),
    (
        "angular_momentum",
        ROTATION,
        "\n        applied,",
        "\n        lambda i, w: scaled(-1, applied(i, w)),",
        "angular_momentum",
    ),
    (
        "angular_momentum",
        ROTATION,
        "\n        applied,",
        "\n        lambda i, w: applied(i, applied(i, w)),",
        "angular_momentum",
    ),
    ("angular_momentum", ROTATION, "\n        applied,", "\n        lambda i, w: w,", "angular_momentum"),
    ("cosine_between", ROTATION, "Factors(Norm(u), Norm(v))", "Norm(u) ** 2", "cosine"),
    ("cosine_between", ROTATION, "Ratio(Dot(u, v), Factors", "Ratio(-Dot(u, v), Factors", "cosine"),
    ("cosine_between", ROTATION, "Ratio(Dot(u, v), Factors", "Ratio(Norm(Cross(u, v)), Factors", "cosine"),
    ("cosine_between", ROTATION, "Factors(*lengths))", "Factors(*lengths[:1]))", "cosine"),
    ("cosine_between", ROTATION, "Terms(*products))", "Terms(*products[1:]))", "cosine"),
    ("cosine_between", ROTATION, "Factors(size, Root(Terms(*squares)))", "Root(Terms(*squares))", "cosine"),
    ("angle_between", ROTATION, "acos(cosine.value)", "acos(-cosine.value)", "angle_between"),
    ("angle_between", ROTATION, "acos(cosine.value)", "2 * acos(cosine.value)", "angle_between"),
    ("angle_between", ROTATION, "acos(cosine.value)", "pi / 2 - acos(cosine.value)", "angle_between"),
    ("angle_between", ROTATION, "acos(cosine.value)", "acos(cosine.value) - pi", "angle_between"),
    ("torque", ROTATION, "\n        Cross,\n        {", "\n        lambda w, L: Cross(L, w),\n        {", "torque"),
    ("torque", ROTATION, "\n        Cross,\n        {", "\n        lambda w, L: Cross(w, w),\n        {", "torque"),
    ("torque", ROTATION, "tidied(f * g), Cross(u, v)", "tidied(f * f), Cross(u, v)", "torque"),
    ("torque", ROTATION, "momentum.symbol, omega.symbol)", "omega.symbol, momentum.symbol)", "torque"),
    ("torque", ROTATION, "Cross(omega.symbol, momentum.symbol))", "Cross(momentum.symbol, omega.symbol))", "torque"),
    # plain algebra
    ("at", EQUATIONS, "name: Group(v) for name", "name: Group(2 * v) for name", "kinetic_energy_at_spin"),
    ("at", EQUATIONS, "zip(names, vector, strict", "zip(names[::-1], vector, strict", "kinetic_energy_at_spin"),
    ("at", EQUATIONS, "*([outside] if outside != 1 else []), ", "", "kinetic_energy_at_spin"),
    ("magnitude", EQUATIONS, "lambda v: Root(Dot(v, v))", "lambda v: Dot(v, v)", "magnitude"),
    ("magnitude", EQUATIONS, "lambda v: Root(Dot(v, v))", "lambda v: -Root(Dot(v, v))", "magnitude"),
    ("magnitude", EQUATIONS, "squares = [entry**2 for", "squares = [entry**4 for", "magnitude"),
    ("magnitude", EQUATIONS, "Factors(size, Root", "Factors(size**2, Root", "magnitude"),
    # numbers
    ("value_of", NUMBERS, "lambda: within(substituted),", "lambda: within(substituted**2),", "magnitude_value"),
    (
        "value_of",
        NUMBERS,
        "amounts[letter] for letter in letters}\n    if isinstance",
        "amounts[letter].args[0] for letter in letters}\n    if isinstance",
        "magnitude_value",
    ),
    (
        "value_of",
        NUMBERS,
        "rounded_form(exact / factor, ",
        "rounded_form(exact * Rational(1001, 1000), ",
        "magnitude_value",
    ),
    ("value_of in degrees", NUMBERS, "rounded_form(exact / factor, ", "rounded_form(exact, ", "angle_between_value"),
    ("coefficient_of", NUMBERS, "lambda: answer.value,", "lambda: 2 * answer.value,", "magnitude_value"),
    (
        "coefficient_of",
        NUMBERS,
        "rounded_form(number, figures)",
        "rounded_form(2 * number, figures)",
        "magnitude_value",
    ),
    ("coefficient_of", NUMBERS, "rounded_form(number, figures)", "Rational(23, 100)", "magnitude_value"),
]

# what is called, module, a piece of its second route, what is put there, the step that must refuse
ROUTES = [
    ("density", BODIES, "(region.integral(rho), body", "(region.integral(2 * rho), body", "density"),
    ("centre_of_mass", BODIES, "mass * start.seen(place)", "2 * mass * start.seen(place)", "centre_of_mass"),
    ("inertia_tensor", BODIES, "self.mass / 6, column", "self.mass / 8, column", "corner_tensor_xx"),
    (
        "inertia_tensor",
        INERTIA,
        "Cross(n, point.seen(place))",
        "Cross(n, 2 * point.seen(place))",
        "corner_tensor_xx",
    ),
    ("inertia_tensor", INERTIA, "explicit(Dot(n, tensor * n))", "explicit(Dot(n, n))", "corner_tensor"),
    ("moved_to", INERTIA, "- at[i] * at[j], target)", "- at[i] * at[j], other)", "inertia_tensor_xx"),
    ("spin", ROTATION, "(length_by_turning(omega), size)", "(length_by_turning(omega), size + 1)", "spin"),
    ("spin", ROTATION, "along.value)), rate * length)", "along.value)), 2 * rate * length)", "spin"),
    ("kinetic_energy", ROTATION, "Cross(omega.value, r))) / 2", "Cross(omega.value, r)))", "kinetic_energy"),
    (
        "angular_momentum",
        ROTATION,
        "Cross(r, Cross(omega.value, r))",
        "Cross(r, Cross(r, omega.value))",
        "angular_momentum",
    ),
    ("cosine_between", ROTATION, "beside[1] ** 2 - opposite**2", "beside[1] ** 2 + opposite**2", "cosine"),
    ("cosine_between", ROTATION, "length_by_turning(u - v)", "length_by_turning(u + v)", "cosine"),
    ("angle_between", ROTATION, "cos(theta) * across", "cos(theta) * along", "angle_between"),
    (
        "torque",
        ROTATION,
        "momentum.value, omega.value)\n    return",
        "omega.value, momentum.value)\n    return",
        "torque",
    ),
    (
        "at",
        EQUATIONS,
        "particular.symbol: particular.value",
        "particular.symbol: -2 * particular.value",
        "kinetic_energy_at_spin",
    ),
    ("magnitude", EQUATIONS, "length_by_turning(of.value)", "length_by_turning(2 * of.value)", "magnitude"),
    ("value_of", NUMBERS, "_by_floats(value, letters", "_by_floats(value**2, letters", "magnitude_value"),
    (
        "coefficient_of",
        NUMBERS,
        "_by_floats(number, set(), {}, result",
        "_by_floats(number, set(), {}, 2 * result",
        "magnitude_value",
    ),
]

for topic in sorted(Path(__file__).parent.glob("laws_of_*.py")):  # the tables of the other topics
    module = import_module(f"tests.mechanics.{topic.stem}")
    RUNS.update(module.RUNS)
    LAWS += module.LAWS
    ROUTES += module.ROUTES


def named(row: tuple[str, ...]) -> str:
    return f"{row[0]}: {row[3].strip()}"


@pytest.mark.parametrize(("run", "module", "old", "new", "key"), [pytest.param(*row, id=named(row)) for row in LAWS])
def test_a_wrong_law_is_refused_at_its_step(run: str, module: str, old: str, new: str, key: str) -> None:
    assert refusing_step(RUNS[run], module, old, new) == key


@pytest.mark.parametrize(("run", "module", "old", "new", "key"), [pytest.param(*row, id=named(row)) for row in ROUTES])
def test_a_wrong_second_route_is_refused_at_its_step(run: str, module: str, old: str, new: str, key: str) -> None:
    assert refusing_step(RUNS[run], module, old, new) == key


def refusing_step(run: Callable[[Verbs], Any], module: str, old: str, new: str) -> str | None:
    """The step that refuses when one piece of the source is replaced, if one does."""
    known_block(), known_slab(), known_slab(radius=a / 4)  # by the laws as they are
    with altered(module, old, new) as verbs:
        try:
            run(verbs)
        except Unverified as refusal:
            return refusal.complaints[0].message.split("`")[1]
    return None


def test_the_laws_as_they_are_are_refused_nowhere() -> None:
    with altered(ROTATION, "acos(cosine.value)", "acos(cosine.value)") as verbs:
        for run in RUNS.values():
            assert run(verbs) is not None


def test_every_verb_has_wrong_laws_and_a_wrong_second_route() -> None:
    verbs = {name for name, verb in vars(verbs_as_imported()).items() if _is_verb(verb)}
    for table, at_least in ((LAWS, 2), (ROUTES, 1)):
        covered = [row[0].partition(" ")[0] for row in table]
        assert set(covered) == verbs - DEFINITIONS
        assert {verb for verb in covered if covered.count(verb) < at_least} == set()


def _is_verb(value: Any) -> bool:
    """A public function of mechanics or of numbers that yields a quantity."""
    own = inspect.isfunction(value) and value.__module__.startswith(("derive.mechanics", "derive.numbers"))
    return bool(own and "Quantity" in str(inspect.signature(value).return_annotation))


def test_definitions_alone_have_no_second_route() -> None:
    found = [*known_block().values(), derive.mechanics.let("half", lambda T: T / 2, known_block()["kinetic_energy"])]
    without = {q.step.rule for q in found if {e.grade for e in q.step.evidence} == {Grade.DEFINITION}}
    assert without == {"rotation.any_angular_velocity", "bodies.axis_vector", "inertia.definition"}
    assert {q.key for q in found if any(e.grade is Grade.DEFINITION for e in q.step.evidence)} == {
        "angular_velocity",
        "axis_vector",
        "corner_tensor_definition",
        "half",
    }


WRONG_NODES: list[tuple[Any, Callable[..., Any]]] = [
    (ex.Dot, lambda self, u, v: 2 * sum(x * y for x, y in zip(u, v, strict=True))),
    (ex.Dot, lambda self, u, v: -sum(x * y for x, y in zip(u, v, strict=True))),
    (ex.Dot, lambda self, u, v: u[0] * v[0] + u[1] * v[1]),
    (ex.Norm, lambda self, v: sum(x**2 for x in v)),
    (ex.Norm, lambda self, v: sum(abs(x) for x in v)),
    (ex.Cross, lambda self, u, v: ex.column(*(-x for x in (ex.Matrix(u).cross(ex.Matrix(v)))))),
    (ex.Cross, lambda self, u, v: 2 * ex.column(*(ex.Matrix(u).cross(ex.Matrix(v))))),
    (ex.Outer, lambda self, u, v: 2 * ex.Matrix(u) * ex.Matrix(v).T),
    (ex.CarriedRate, lambda self, A, w: ex.column(*(ex.Matrix(A).cross(ex.Matrix(w))))),
    (ex.Factors, lambda self, *factors: sum(factors, Integer(0))),
    (ex.Terms, lambda self, *terms: terms[0]),
    (ex.Ratio, lambda self, above, below: above * below),
    (ex.Root, lambda self, inside: inside),
    (ex.Group, lambda self, inner: 2 * inner),
]


@pytest.mark.parametrize(
    ("node", "wrong"), [pytest.param(*row, id=f"{row[0].__name__}-{i}") for i, row in enumerate(WRONG_NODES)]
)
def test_a_node_that_is_carried_out_wrongly_is_refused(
    node: Any, wrong: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nodes serve law and second route alike, so this shows that the two do not stand on the same ones."""
    known_block()
    monkeypatch.setattr(node, "_evaluated", wrong)
    ex._carried_out.cache_clear()
    try:
        with pytest.raises(Unverified):
            block_derivation(verbs_as_imported())
    finally:
        monkeypatch.undo()
        ex._carried_out.cache_clear()
