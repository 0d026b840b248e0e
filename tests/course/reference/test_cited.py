"""A document of the set, cited by its lines: which formula is meant, and what is told where none is."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from derive.building.derivations import steps_key
from derive.course.problem import load_problem
from derive.course.reference.comparison import Comparison
from derive.course.reference.statements import reference_paths
from derive.errors import Rejected
from tests.course.reference.stated import PRINTED

DOCUMENT = r"""# The block

### 1.1 The energy

The energy is $T=\frac{7}{24} M a^{2} \omega^{2}$ and is constant.

$$
\begin{aligned}
T & =\frac{1}{24} M a^{2}\left(13 \omega_{1}^{2}+10 \omega_{2}^{2}+5 \omega_{3}^{2}\right) \\
& =\frac{1}{24} M a^{2} \omega^{2}\left(\frac{13}{14}+\frac{40}{14}+\frac{45}{14}\right) \\
& =\frac{7}{24} M a^{2} \omega^{2}
\end{aligned}
$$

### 1.2 The angle

$$
\cos \theta=\frac{\omega \cdot L}{|\omega||L|}=\frac{\frac{14}{24}}{\sqrt{\frac{397}{1008}}}=0.92951
$$

Hence
$$
\theta=21.64^{0}
$$

Of $a=1$ and $b=2$ nothing follows.

$$
T=\frac{7}{24} M a^{2 \omega^{2}
$$

$$
T=M \left[ a \right)
$$
"""
NAMED = "- document: block.md\n" + PRINTED
Cites = Callable[..., tuple[Comparison, ...]]


@pytest.fixture
def cites(compared: Callable[..., tuple[Comparison, ...]], tmp_path: Path) -> Cites:
    def cite(*entries: str, head: str = NAMED) -> tuple[Comparison, ...]:
        (tmp_path / "problems" / "hw9" / "block.md").write_text(DOCUMENT, encoding="utf-8")
        return compared(whole=head + "".join(f"    - {{{entry}}}\n" for entry in entries))

    return cite


def told(cites: Cites, entry: str) -> str:
    with pytest.raises(Rejected) as caught:
        cites(entry)
    return str(caught.value)


@pytest.mark.parametrize(
    ("entry", "outcomes"),
    [
        ("lines: 10-11, answer: kinetic_energy_about_axis", ["agrees"] * 2),
        ("lines: [10, 11], answer: kinetic_energy_about_axis", ["agrees"] * 2),
        ("line: 9, answer: kinetic_energy", ["agrees"]),
        ("lines: 5, answer: kinetic_energy_about_axis", ["agrees"]),
        ("lines: 18, side: 3, answer: cosine", ["agrees"]),
        ("lines: 18, side: [3, 4], answer: cosine, to: 5", ["agrees to 5 figures"] * 2),
        ("lines: 23, answer: angle_between, to: 4", ["agrees to 4 figures"]),
        ("lines: 23, answer: angle_between, in: degree, to: 4", ["agrees to 4 figures"]),
        ("lines: 9, document: block.md, answer: kinetic_energy", ["agrees"]),
    ],
)
def test_a_formula_is_read_at_its_lines(cites: Cites, entry: str, outcomes: list[str]) -> None:
    assert [found.outcome for found in cites(entry)] == outcomes


def test_a_chain_of_a_section_is_compared_with_the_step_of_its_letter(cites: Cites) -> None:
    found = cites("lines: 1.1")
    assert [(each.entry.answer, each.outcome) for each in found] == [
        ("kinetic_energy", "agrees"),
        ("kinetic_energy_about_axis", "agrees"),
        ("kinetic_energy_about_axis", "agrees"),
    ]
    assert found[0].facts()["line"] == 9


def test_what_the_document_prints_is_quoted_from_it(cites: Cites) -> None:
    erratum, remark = cites(
        "lines: 11, erratum: {why: said twice, right: '$0$'}", "lines: 5, remark: said before it is shown"
    )
    quoted = erratum.told().erratum
    assert quoted is not None and quoted.quote == r"$\frac{7}{24} M a^{2} \omega^{2}$"
    assert remark.entry.remark is not None and remark.entry.remark.quote == quoted.quote


@pytest.mark.parametrize(
    ("entry", "message", "place"),
    [
        ("lines: 12, answer: cosine", "`problems/hw9/block.md` has no formula at line 12", "reference.yaml:8:15"),
        ("lines: 90, answer: cosine", "`problems/hw9/block.md` has no formula at line 90", "reference.yaml:8:15"),
        ("lines: 26, answer: cosine", "there are 2 formulas in sentences at line 26", "reference.yaml:8:15"),
        ("lines: 9, side: 4, answer: cosine", "the formula at this line has 2 sides", "reference.yaml:8:15"),
        ("lines: 33, answer: cosine", "`[` is closed by `)`", "block.md:33:14"),
        ("lines: 3.1", "`problems/hw9/block.md` has no section 3.1", "reference.yaml:8:15"),
        ("lines: 1.1, answer: cosine", "an entry with a section cannot have `answer`", "reference.yaml:8:20"),
        ("lines: 9-7, answer: cosine", "`lines` must be a line, a range such as `123-130`", "reference.yaml:8:15"),
        ("line: 5, quote: 'is not constant', remark: no", "does not have this text in line 5", "reference.yaml:8:24"),
        ("lines: 29, answer: cosine", "this `{` is never closed", "block.md:29:20"),
    ],
)
def test_what_cannot_be_cited_is_told_at_its_place(cites: Cites, entry: str, message: str, place: str) -> None:
    found = told(cites, entry)
    assert message in found and place in found, found


def test_a_document_elsewhere_is_not_read(cites: Cites, tmp_path: Path) -> None:
    (tmp_path / "block.md").write_text(DOCUMENT, encoding="utf-8")
    for name in ("../../block.md", "/etc/hostname", "sub/block.md", "other.md", "block.yaml"):
        found = told(cites, f"lines: 9, answer: kinetic_energy, document: {name}")
        assert f"`problems/hw9` has no document `{name}`" in found
    (tmp_path / "problems" / "hw9" / "linked.md").symlink_to(tmp_path / "block.md")
    assert "has no document" in told(cites, "lines: 9, answer: kinetic_energy, document: linked.md")


def test_an_edit_of_the_document_makes_the_comparison_again(cites: Cites, tmp_path: Path) -> None:
    assert cites("lines: 9, answer: kinetic_energy")[0].outcome == "agrees"
    problem = load_problem(tmp_path, "hw9/block")
    assert reference_paths(problem) == ["problems/hw9/reference.yaml", "problems/hw9/block.md"]
    before = steps_key(problem)
    (tmp_path / "problems" / "hw9" / "block.md").write_text(DOCUMENT.replace("13", "14"), encoding="utf-8")
    assert steps_key(problem) != before


def test_a_vector_of_the_document_has_components_here(cites: Cites) -> None:
    head = NAMED.replace("  letters: {", "  letters: {L: [I_xx*omega_x, I_yy*omega_y, I_zz*omega_z], ")
    head = head.replace("omega_3: omega_z}", "omega_3: omega_z, w_1: omega_x, w_2: omega_y, w_3: omega_z}")
    with pytest.raises(Rejected, match="both stand for `omega_x`"):
        cites(r"answer: kinetic_energy, latex: '\frac{1}{2} w \cdot L'", head=head)
    head = NAMED.replace("  letters: {", "  letters: {L: [I_xx*omega_x, I_yy*omega_y, I_zz*omega_z], ")
    (found,) = cites(r"answer: kinetic_energy, latex: '\frac{1}{2} \vec{\omega} \cdot \vec{L}'", head=head)
    assert found.outcome == "agrees"
