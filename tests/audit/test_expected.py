"""The audit compares a document with the answers of a derivation, and takes assumptions and kinds of letters."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from derive.audit.assumptions import assumed_of
from derive.audit.auditing import Audit, audited
from derive.audit.expected import Expected, Status
from derive.audit.report import as_data, as_text, exit_code
from derive.cli.options import main
from derive.errors import Misused
from tests.documents.reading import document

FREQUENCY = Expected("set/rod", "frequency", r"\omega_{0}=\sqrt{\frac{3g}{2l}}")
INERTIA = Expected("set/rod", "inertia", r"I=\frac{1}{3}\,Ml^{2}")
WRONG_METHOD = r"""
The inertia about the end is $I = \frac{1}{12} M l^2$.

$$ I \ddot\theta = -\frac{1}{2} M g l \theta $$

$$ \omega_0^2 = \frac{M g l}{2 I}, \qquad \omega_0 = \sqrt{\frac{6 g}{l}} $$
"""


def compare(text: str, *expected: Expected) -> Audit:
    return audited(document(text), expected=expected)


def test_a_wrong_method_with_correct_algebra_is_found() -> None:
    found = compare(WRONG_METHOD, FREQUENCY, INERTIA)
    assert [each.status for each in found.compared] == [Status.DIFFERS, Status.DIFFERS]
    told = as_text(found, every=False)
    assert "the derivation of set/rod gives" in told and exit_code(found) == 1
    assert "the row is 2 times the derived result" in told and "the row is 1/4 times the derived result" in told
    assert exit_code(audited(document(WRONG_METHOD))) == 0


def test_a_right_result_is_found_in_another_form_and_after_definitions() -> None:
    text = WRONG_METHOD.replace(r"\frac{1}{12}", r"\frac{1}{3}").replace(r"\sqrt{\frac{6 g}{l}}", r"\sqrt{1.5 g/l}")
    found = compare(text, FREQUENCY, INERTIA)
    assert [each.status for each in found.compared] == [Status.FOUND, Status.FOUND]


def test_an_equation_of_motion_is_found_up_to_a_factor() -> None:
    expected = Expected("set/rod", "motion", r"\frac{1}{3}\,Ml^{2}\ddot{\theta}+\frac{1}{2}\,Mgl\sin \theta=0")
    (found,) = compare(r"$$ \ddot\theta = -\frac{3 g}{2 l} \sin\theta $$", expected).compared
    assert found.status is Status.FOUND
    (found,) = compare(r"$$ \ddot\theta = -\frac{g}{2 l} \sin\theta $$", expected).compared
    assert found.status is Status.MISSING


def test_a_condition_is_found_in_another_form() -> None:
    expected = Expected("set/slab", "stable", r"R>\frac{a}{2}")
    (found,) = compare("$$ M g (2 R - a) > 0 $$", expected).compared
    assert found.status is Status.FOUND
    (found,) = compare("$$ M g (2 R - a) < 0 $$", expected).compared
    assert found.status is Status.MISSING


def test_a_general_formula_and_a_special_case_do_not_contradict_an_answer() -> None:
    text = (
        r"In general $\omega_0 = \sqrt{k/m}$. Here $\omega_0 = \sqrt{3 g/(2 l)}$. For $l = g$ we get $\omega_0 = 1.22$."
    )
    (found,) = compare(text, FREQUENCY).compared
    assert found.status is Status.FOUND


def test_the_answers_are_part_of_the_data() -> None:
    data = as_data(compare(WRONG_METHOD, FREQUENCY))
    assert data["answers"][0]["status"] == "differs" and data["answers"][0]["line"] == 6


def test_a_document_is_compared_with_a_problem(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "worked.md"
    file.write_text(
        r"$$ (m_1 + m_2) \ddot x = (m_1 - m_2) g $$" + "\n\n" + r"$$ S = \frac{m_1 m_2 g}{m_1 + m_2} $$",
        encoding="utf-8",
    )
    assert main(["audit", str(file), "--problem", "library/atwood"]) == 1
    told = capsys.readouterr().out
    assert "differs in line 3: S" in told and "a factor was lost" in told
    assert "found in line 1" not in told and "1 found, 1 differs" in told


DENSITY = r"""
$$ J = \int_0^a \rho\, 6 a^2 x^2 \, dx = \frac{1}{3} M a^2 $$
"""


def test_an_assumption_decides_a_row(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "worked.md"
    file.write_text(DENSITY, encoding="utf-8")
    main(["audit", str(file), "--format", "json"])
    assert "holds" not in [row["verdict"] for row in json.loads(capsys.readouterr().out)["rows"]]
    assert main(["audit", str(file), "--assume", "rho = M/(6 a^3)", "-v"]) == 0
    assert "1 hold" in capsys.readouterr().out
    assert main(["audit", str(file), "--assume", "rho = M/(3 a^3)"]) == 1


@pytest.mark.parametrize("text", ["rho", "a = b = c", "a = ", "__import__('os') = 1 +", "a = \\write18{x}"])
def test_an_assumption_that_is_not_an_equation_is_an_error(text: str) -> None:
    with pytest.raises(Misused):
        assumed_of(text)


def test_the_kinds_of_letters_are_declared(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, symbols = tmp_path / "worked.md", tmp_path / "letters.yaml"
    file.write_text(r"$\frac{d}{dt} (m u^2) = 2 m u \dot u$ and $\cos k\pi = (-1)^k$", encoding="utf-8")
    symbols.write_text("k: integer\nu: changes\nm: constant\n", encoding="utf-8")
    assert main(["audit", str(file), "--symbols", str(symbols)]) == 0
    assert "2 hold" in capsys.readouterr().out
    symbols.write_text("k: number\n", encoding="utf-8")
    assert main(["audit", str(file), "--symbols", str(symbols)]) == 2
    assert "not a kind" in capsys.readouterr().err


STEPS = (
    Expected("set/block", "motion", r"m\ddot{x}=mg\sin \alpha-F"),
    Expected("set/block", "kinetic_energy", r"T=\frac{1}{2}\,m\,(\dot{x}^{2}+\omega^{2}x^{2})", asked=False),
    Expected("set/block", "lagrangian", r"L=\frac{1}{2}\,m\,(\dot{x}^{2}+\omega^{2}x^{2})+mgx\sin \alpha", asked=False),
    Expected("set/block", "speed", r"v_{1}=\sqrt{2gh-2\mu gl}"),
    Expected("set/block", "friction", r"F\approx \mu mg", asked=False),
)


def outcomes(text: str, *expected: Expected) -> list[str]:
    return [str(each.verdict.outcome) for each in compare(text, *expected).claims if each.verdict is not None]


@pytest.mark.parametrize(
    ("right", "slip"),
    [
        (r"m \ddot x = m g \sin\alpha - F", r"m \ddot x = m g \cos\alpha - F"),
        (r"m \ddot x = m g \sin\alpha - F", r"m \ddot x = m g \sin\alpha + F"),
        (r"m \ddot x = m g \sin\alpha - F", r"m \ddot x = m g \sin\alpha"),
        (r"F = m (g \sin\alpha - \ddot x)", r"F = m (g \cos\alpha - \ddot x)"),
        (r"T = \frac12 m \dot x^2 + \frac12 m \omega^2 x^2", r"T = \frac12 m \dot x^2 + \frac12 m \omega x^2"),
        (r"L = T + m g x \sin\alpha", r"L = T - m g x \sin\alpha"),
        (r"v_1 = \sqrt{2 g (h - \mu l)}", r"v_1 = \sqrt{2 g (h + \mu l)}"),
    ],
)
def test_a_row_that_no_other_row_shows_is_compared_with_the_derivation(right: str, slip: str) -> None:
    assert outcomes(f"$$ {right} $$", *STEPS)[0] != "differs"
    assert outcomes(f"$$ {slip} $$")[0] != "differs"
    found = compare(f"$$ {slip} $$", *STEPS)
    verdict = found.claims[0].verdict
    assert verdict is not None and verdict.outcome == "differs" and "the derivation of set/block" in verdict.because
    assert verdict.suggestion


@pytest.mark.parametrize(
    "other",
    [
        r"$$ v_2 = \sqrt{2 g h + 2 \mu g l} $$",  # another instant
        r"If there is no friction, $v_1 = \sqrt{2 g h}$ at the end.",
        r"For $\mu = 0$ and $h = 0$, $T = \frac12 m \dot x^2$.",
        r"$$ F = \mu m g \cos\alpha $$",  # the derivation gives an approximation only
        r"$$ m \ddot x = m g \sin\alpha - F - c \dot x - k x $$",
    ],
)
def test_a_row_about_something_else_does_not_contradict_a_derivation(other: str) -> None:
    text = f"$$ v_1 = \\sqrt{{2 g (h - \\mu l)}} $$\n\n$$ m \\ddot x = m g \\sin\\alpha - F $$\n\n{other}"
    assert "differs" not in outcomes(text, *STEPS)


def test_a_row_that_agrees_with_the_derivation_is_not_suspected() -> None:
    steps = (
        Expected("set/wire", "speed", r"v^{2}=\dot{r}^{2}+\omega^{2}r^{2}", asked=False),
        Expected("set/wire", "energy", r"T=\frac{1}{2}\,m\,(\dot{r}^{2}+\omega^{2}r^{2})", asked=False),
        Expected("set/wire", "lagrangian", r"L=\frac{1}{2}\,m\,(\dot{r}^{2}+\omega^{2}r^{2})"),
    )
    text = r"""
$$ v^2 = \dot r^2 + \omega^2 r^2 $$

$$ T = \frac12 m v^2 $$

$$ U = 0, \qquad L = T - U = \frac12 m \dot r^2 $$
"""
    (alone,) = (each.verdict for each in compare(text).claims if each.verdict and each.verdict.outcome == "differs")
    assert "or the slip is in line 4" in alone.because
    (known,) = (
        each.verdict for each in compare(text, *steps).claims if each.verdict and each.verdict.outcome == "differs"
    )
    assert "or the slip" not in known.because


@pytest.mark.parametrize(
    ("before", "status"),
    [
        ("Another way is", Status.DIFFERS),
        (r"This has the form $\ddot\theta + \omega_0^2 \theta = 0$, so the frequency is", Status.DIFFERS),
        (r"For $l = 2 a$ the frequency of the other rod is", Status.FOUND),
    ],
)
def test_a_second_value_of_an_answer_is_compared_unless_it_may_hold_in_a_special_case(
    before: str, status: Status
) -> None:
    right = r"$$ I \ddot\theta = - k l \theta $$ Hence $$ \omega_0 = \sqrt{\frac{3 g}{2 l}} $$"
    text = right + f"\n\n{before}\n" + r"$$ \omega_0 = \sqrt{\frac{6 g}{l}} $$"
    (found,) = compare(text, FREQUENCY).compared
    assert found.status is status


@pytest.mark.parametrize(("number", "status"), [("1.932", Status.FOUND), ("1.732", Status.DIFFERS)])
def test_an_answer_that_is_stated_again_may_be_rounded(number: str, status: Status) -> None:
    expected = Expected("set/string", "speed", r"v_{p}=\sqrt{(2+\sqrt{3})\,gl}")
    text = r"$$ v_p = \sqrt{(2+\sqrt{3}) g l} $$ so that $$ v_p = NUMBER \sqrt{g l} $$".replace("NUMBER", number)
    (found,) = compare(text, expected).compared
    assert found.status is status
