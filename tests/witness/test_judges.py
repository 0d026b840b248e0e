"""The witness is independent, and each of its tests belongs to a rule that there is."""

from __future__ import annotations

import ast
from pathlib import Path

from derive.mechanics import Particle, System, coordinate, lagrangian, point, weight
from derive.steps.record import recorded
from derive.steps.rule import Judged
from derive.witness import judges
from tests.courses import ROOT
from tests.rules import records
from tests.witness.systems import PENDULUM, g, m

WITNESS = sorted((ROOT / "derive" / "witness").glob("*.py"))
# The letters of coordinates, rates and functions of the time, what a node stands for, the range of a letter, and the
# words of a verdict. NumPy works out a root in order here.
ALLOWED = {
    "derive.algebra.equality": {"Grade", "Verdict"},
    "derive.algebra.expressions": {"TIME", "Prescribed", "Relation", "depends_on_time", "explicit", "rate"},
    "derive.algebra.ordered_roots": {"OrderedRoot"},
    "derive.algebra.ranges": {"POSITIVE", "known_ranges", "range_of"},
    "derive.steps.rule": {"Judged"},
    "derive.steps.step": {"Fact", "Quantity"},
}


def imports(path: Path) -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("derive"):
            found.setdefault(str(node.module), set()).update(alias.name for alias in node.names)
    return found


def test_the_witness_shares_no_algebra_and_no_mechanics_with_what_it_judges() -> None:
    for path in WITNESS:
        for module, names in imports(path).items():
            assert module.startswith("derive.witness") or names <= ALLOWED[module], (path.name, module, names)


def test_every_rule_that_is_judged_is_established_somewhere() -> None:
    assert judges.JUDGES.keys() <= {rule.name for *_, rule in records()}


def test_a_formula_that_cannot_be_computed_is_not_witnessed() -> None:
    def cannot(_: object) -> None:
        raise judges.NotComputable("f")

    with recorded():
        x = coordinate("x")
        L = lagrangian(System(Particle(m, point(x.symbol, 0)), weight(g)))
        assert judges.testimony(cannot, PENDULUM, L, Judged(L.value), "generic", {}, ()) is None


def test_one_description_is_compiled_once() -> None:
    assert judges.blueprint(PENDULUM) is judges.blueprint(PENDULUM)
