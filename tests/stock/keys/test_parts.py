"""Parts of a described system: springs, central forces, forces, damping, charges, constraints; and their faults."""

from __future__ import annotations

from pathlib import Path

import pytest
from sympy import cos, symbols

from derive.algebra.equality import equal
from derive.algebra.expressions import Relation, explicit
from tests.stock.described import PENDULUM, edited, loaded, messages, solved

l, m, g, k = symbols("l m g k", positive=True)
x, x_dot, x_ddot = symbols("x x_dot x_ddot", real=True)

SLIDER = edited(
    PENDULUM,
    ("{theta: angle}", "{x: length}"),
    ("[l*sin(theta), -l*cos(theta)]", "[x, 0]"),
    ("omega: angular speed}", "omega: angular speed, c: damping constant, F: force, q: charge, E: electric field}"),
    ("  gravity: g\n", "  MORE\n"),
)


def motion(folder: Path, more: str) -> Relation:
    found: Relation = explicit(solved(folder, edited(SLIDER, ("MORE", more)))["motion_x"].value)
    return found


@pytest.mark.parametrize(
    ("more", "force"),
    [
        ("springs: {constant: k, from: [0, 0], to: A}", "-k*x"),
        ("springs: [{constant: k, from: [0, -l], to: A, length: 0}]", "-k*x"),
        ("central: {energy: k*d**2/2, distance: d, from: [0, -l], to: A}", "-k*x"),
        ("potential: k*x**2/2", "-k*x"),
        ("forces: [{components: [F*cos(omega*t), 0], at: A}]", "F*cos(omega*t)"),
        ("damping: {constant: c, at: A}", "-c*x_dot"),
        ("damping: {constant: c, on: x}", "-c*x_dot"),
        ("charges: {charge: q, at: A, electric: [E, 0]}", "q*E"),
    ],
)
def test_what_acts_on_a_particle(more: str, force: str, tmp_path: Path) -> None:
    c, F, q, E, omega = symbols("c F q E omega")
    pulls = {
        "-k*x": -k * x,
        "F*cos(omega*t)": F * cos(omega * symbols("t")),
        "-c*x_dot": -c * x_dot,
        "q*E": q * E,
    }
    found = motion(tmp_path, more)
    by_name = {s: symbols(s.name) for s in found.residual.free_symbols}
    expected = (m * x_ddot - pulls[force]).xreplace({s: symbols(s.name) for s in {m, k, x, x_dot, x_ddot}})
    assert equal(Relation(found.residual.xreplace(by_name), "=", 0), Relation(expected, "=", 0))


def test_a_constraint_is_kept_by_a_force(tmp_path: Path) -> None:
    text = edited(
        PENDULUM,
        ("{theta: angle}", "{x: length, y: length}"),
        ("[l*sin(theta), -l*cos(theta)]", "[x, y]"),
        ("  gravity: g\n", "  gravity: g\n  constraints: {condition: y, equals: l, force: N}\n"),
        ("equations_of_motion", "multipliers"),
    )
    assert equal(solved(tmp_path, text)["N"].value, m * g)


def test_a_constraint_force_may_have_the_name_of_a_particle(tmp_path: Path) -> None:
    text = edited(
        PENDULUM,
        ("{theta: angle}", "{x: length, y: length}"),
        ("[l*sin(theta), -l*cos(theta)]", "[x, y]"),
        ("{bob:", "{N:"),
        ("  gravity: g\n", "  gravity: g\n  constraints: {condition: y, equals: l, force: N}\n"),
        ("equations_of_motion", "multipliers"),
    )
    assert equal(solved(tmp_path, text)["N"].value, m * g)


def test_a_number_in_the_energy_of_a_central_force_is_kept(tmp_path: Path) -> None:
    energy = "central: {energy: (5 N)*d, distance: d, from: [0, -l], to: A}"
    (force,) = loaded(tmp_path, edited(SLIDER, ("MORE", energy))).measured
    assert (force.number, force.unit) == (5, "N")


def test_a_description_reads_the_same_in_each_process(tmp_path: Path) -> None:
    """The digest of a problem is that of its text, so an address in it would lose every kept step."""
    more = "forces: [{components: [F, 0], at: A}]\n  results: {slow: {limit: lagrangian, for: m, to: 0}}"
    text = repr(loaded(tmp_path, edited(SLIDER, ("MORE", more))).described)
    assert "force(" in text and "slow" in text and " at 0x" not in text


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("forces: {components: [F, 0]}", "a force needs `components` and `at`, or `torque` and `on`"),
        ("damping: {constant: c}", "damping needs either `at` or `on`"),
        ("springs: {constant: c, from: A, to: [0, 0]}", "`constant` must be a spring constant, but `c` is a damping"),
        ("central: {energy: k*m**2/2, distance: m, from: A, to: [0, 0]}", "`m` already denotes something else"),
        (
            "constraints: {condition: l}",
            "`constraint` needs a formula in the coordinates, but l contains no coordinate",
        ),
        ("constraints: {condition: x, equals: m}", "`condition` and `equals` have different dimensions"),
        ("springs: {konstant: k, from: A, to: A}", "a spring has no key `konstant`"),
        ("charges: {charge: q, at: B}", "`B` is not a named place"),
        ("springs: soft", "a spring must be a mapping, but it is `soft`"),
    ],
)
def test_a_part_that_cannot_be_meant_is_told(more: str, said: str, tmp_path: Path) -> None:
    found = messages(tmp_path, edited(SLIDER, ("MORE", more)))
    assert any(said in message for message in found), found
