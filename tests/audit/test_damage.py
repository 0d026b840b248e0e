"""Damaged rows are blamed at their place: one small document for each way in which a slip used to pass."""

from __future__ import annotations

import pytest

from derive.audit.claims import Claim, Outcome
from derive.audit.named_quantities import named_quantities
from derive.documents.layout import Cue, read_document
from derive.documents.source import Format, source_of
from tests.audit.test_auditing import RIGHT
from tests.damage import damages_of, trials
from tests.documents.reading import audit


def wrong(text: str) -> list[Claim]:
    return [each for each in audit(text).claims if each.verdict and each.verdict.outcome is Outcome.DIFFERS]


LAGRANGIAN = r"""
The energies are
$$ T = \frac{1}{2} m \dot x^2 \qquad U = \frac{1}{2} k x^2 $$
and the Lagrangian is
$$ L = T - U = \frac{1}{2} m \dot x^2 - \frac{1}{2} k x^2. $$
"""
ATWOOD = r"""
The masses $m_1$ and $m_2$ hang on a string with the tension $S$. Newton's second law is
$$ m_1 \ddot x = m_1 g - S $$
$$ m_2 \ddot y = m_2 g - S $$
and the string gives
$$ \ddot x + \ddot y = 0. $$
"""
MODES = (
    LAGRANGIAN
    + r"""
The equation of motion is
$$ m \ddot x + k x = 0. $$
"""
)


@pytest.mark.parametrize(
    ("before", "right", "slip"),
    [
        (LAGRANGIAN, r"$$ m \ddot x + k x = 0 $$", r"$$ m \ddot x - k x = 0 $$"),
        (LAGRANGIAN, r"$$ m \ddot x = -k x $$", r"$$ m \ddot x = -2 k x $$"),
        (
            ATWOOD,
            r"$$ \ddot x = \frac{(m_1 - m_2) g}{m_1 + m_2} $$",
            r"$$ \ddot x = \frac{(m_1 + m_2) g}{m_1 + m_2} $$",
        ),
        (ATWOOD, r"$$ S = \frac{2 m_1 m_2 g}{m_1 + m_2} $$", r"$$ S = \frac{3 m_1 m_2 g}{m_1 + m_2} $$"),
        (
            "The frequencies are the roots of\n$$ \\omega^4 - 4 \\omega^2 b^2 + 2 b^4 = 0 $$\nThey are\n",
            r"$$ \omega_1 = \sqrt{2 - \sqrt{2}}\, b $$",
            r"$$ \omega_1 = \sqrt{2 - \sqrt{3}}\, b $$",
        ),
        (
            "The speed is given by\n$$ v^2 = l^2 \\dot\\theta^2 $$\nand the energy is\n",
            r"$$ T = \frac{1}{2} m v^2 = \frac{1}{2} m l^2 \dot\theta^2 $$",
            r"$$ T = \frac{1}{2} m v^2 = \frac{1}{2} m l \dot\theta^2 $$",
        ),
        (
            "The kinetic energy is\n",
            r"$$ T = \frac12 m v^2 (1 - \cos^2\theta) = \frac12 m v^2 \sin^2\theta $$",
            r"$$ T = \frac12 m v^2 (1 - \cos^2\theta) = \frac12 m v^2 \sin\theta $$",
        ),
        (
            "$$\n\\begin{aligned}\n2 m l \\ddot\\theta + m g \\theta &= 0 \\\\\n",
            "\\ddot\\theta + \\frac{g}{2 l} \\theta &= 0\n\\end{aligned}\n$$",
            "\\ddot\\theta + \\frac{g}{l} \\theta &= 0\n\\end{aligned}\n$$",
        ),
        (LAGRANGIAN[: LAGRANGIAN.index("$$ L")], "$$ L = T - U $$", "$$ L = T + U $$"),
        (LAGRANGIAN[: LAGRANGIAN.index("$$ L")], "$$ L = T - U $$", "$$ L = T - T $$"),
        (
            "The Lagrangian is\n$$ L = \\frac12 m \\dot x^2 - \\frac12 k x^2 + m g x $$\n\nThe motion follows,\n",
            "$$ m \\ddot x + k x - m g = 0 $$",
            "$$ m \\ddot x + k x = 0 $$",
        ),
        ("A small angle has", r" $\cos\theta \approx 1 - \frac12 \theta^2$", r" $\cos\theta \approx 1 - \theta^2$"),
        ("The tensor has", " $I_{31} = I_{13}$", " $I_{31} = I_{31}$"),
        (MODES + "The period is\n", r"$$ \tau = 2\pi \sqrt{\frac{m}{k}} $$", r"$$ \tau = 3\pi \sqrt{\frac{m}{k}} $$"),
        (MODES + "The frequency is\n", r"$$ \omega_0 = \sqrt{\frac{k}{m}} $$", r"$$ \omega_0 = \sqrt{\frac{m}{k}} $$"),
        (MODES + "This is\n", r"$$ \ddot x + \omega_0^2 x = 0 $$", r"$$ \ddot x - \omega_0^2 x = 0 $$"),
        ("$$ m \\ddot y = - m g $$\n", r"$$ y = v t - \frac12 g t^2 $$", r"$$ y = v t - \frac22 g t^2 $$"),
        (
            "$$ L = \\frac12 m l^2 \\dot\\theta^2 + m g l \\cos\\theta $$\nFor small angles\n",
            r"$$ l \ddot\theta + g \theta = 0 $$",
            r"$$ l \ddot\theta - g \theta = 0 $$",
        ),
        (
            LAGRANGIAN[: LAGRANGIAN.index("and the")] + "Lagrange's equation is\n",
            r"$$ m \ddot x + k x = 0 $$",
            r"$$ m \ddot x - k x = 0 $$",
        ),
        (
            "$$ N = m g $$\n$$ M \\ddot x = \\mu N $$\n",
            r"$$ \ddot x = \frac{\mu N}{M} $$",
            r"$$ \ddot x = \frac{\mu}{M} $$",
        ),
        (
            "The area is\n",
            r"$$ A = \int_0^a \int_0^b x^2 \, dx \, dy $$",
            r"$$ A = \int_0^a \int_0^b x^2 \, dx $$",
        ),
        (
            "The momentum is\n$$ m u = (M + m) w. $$\nThe ball sticks, so",
            r" $w = \frac{m}{M + m} u$",
            r" $w = \frac{m}{M + v} u$",
        ),
        (
            "The frequencies are the roots of\n$$ l^2 \\omega^4 - 4 g l \\omega^2 + 2 g^2 = 0 $$\nThey are\n",
            r"$$ \omega_1 = \sqrt{(2 - \sqrt{2}) \frac{g}{l}} $$",
            r"$$ \omega_1 = \sqrt{(2 - \sqrt{2}) \frac{R}{l}} $$",
        ),
        (
            "A small angle has",
            r" $\cos\theta \approx 1 - \frac12 \theta^2$",
            r" $\cos\theta \approx 8 - \frac12 \theta^2$",
        ),
        (
            "The block reaches the floor at $s = h/\\sin\\alpha$. The energies are\n"
            "$$ T = \\frac12 m \\dot s^2 \\qquad U = m g (h - s \\sin\\alpha) $$\nso\n",
            r"$$ L = T - U = \frac12 m \dot s^2 - m g (h - s \sin\alpha) $$",
            r"$$ L = T - U = \frac13 m \dot s^2 - m g (h - s \sin\alpha) $$",
        ),
        (
            "The speed is given by\n$$ v^2 = l^2 \\dot\\theta^2 + \\omega^2 (R + l \\sin\\theta)^2 $$\n"
            "and the energy is\n",
            r"$$ T = \frac12 m v^2 = \frac12 m (l^2 \dot\theta^2 + \omega^2 (R + l \sin\theta)^2) $$",
            r"$$ T = \frac12 m v^2 = \frac12 m (l^2 \dot\theta^2 + \omega^2 (R)^2) $$",
        ),
        (
            "Only the derivatives at $\\theta = 0$ are needed. The impulse gives\n"
            "$$ 3 \\dot y + 4 l \\dot\\theta = J $$\n$$ \\dot y + 2 l \\dot\\theta = 2 J $$\nThe difference of both is",
            r" $\dot y + l \dot\theta = -\frac12 J$.",
            r" $\dot y + l \dot\theta = -\frac72 J$.",
        ),
        (
            "Choose $U = 0$. The energy is\n$$ T = \\frac12 m l^2 \\dot\\phi^2 \\sin^2\\alpha $$\nand the Lagrangian\n"
            "$$ L = T - U = \\frac12 m l^2 \\dot\\phi^2 \\sin^2\\alpha. $$\n"
            "The momentum is\n$$ p_\\phi = \\frac{\\partial L}{\\partial \\dot\\phi} $$\n",
            r"$$ p_\phi = m l^2 \dot\phi \sin^2\alpha $$",
            r"$$ p_\phi = m l^2 \dot\phi \sin^2\phi $$",
        ),
    ],
    ids=[
        "Lagrange", "Lagrange, solved", "a system", "a force", "a root", "a square", "a power of a sine",
        "the row above",
        "a Lagrangian",
        "a letter twice", "a lost term", "an approximation", "an index", "a period", "a frequency", "an oscillation",
        "a motion", "a linear equation", "T - U", "a lost letter", "a differential", "a strange letter",
        "a letter of a root", "a constant term", "a place that is reached", "a term in brackets",
        "a sentence after a condition", "a letter behind a derivative",
    ],
)  # fmt: skip
def test_what_follows_from_earlier_rows_is_compared_with_them(before: str, right: str, slip: str) -> None:
    assert wrong(before + right) == []
    (claim,) = wrong(before + slip)
    assert claim.right_span.end > len(before)


EXPLAINED = (
    "The moment is\n$$ I = \\lambda \\int_0^l x^2 dx = \\frac{1}{3} M l^2, $$\nwhere $\\lambda$ = $M/l$ is the density."
)


def test_the_sentence_after_a_display_explains_its_letters() -> None:
    assert [str(each.verdict.outcome) for each in audit(EXPLAINED).claims if each.verdict][:2] == ["defines", "holds"]
    (claim,) = wrong(EXPLAINED.replace("{3}", "{4}"))
    assert claim.number == 1
    assert len(wrong(EXPLAINED.replace("{3}", "{4}").replace(" = $M/l$", " ={~}$M/l$"))) == 1


def test_the_motion_or_its_velocity_is_wrong() -> None:
    text = r"$$ m \ddot y = - m g $$ $$ y = v t - \frac22 g t^2, \qquad \dot y = v - g t $$"
    assert [each.verdict.or_lines for each in wrong(text) if each.verdict] in ([(1,)], [()])
    assert "instead of" in wrong(text)[0].verdict.because + wrong(text)[0].verdict.suggestion  # type: ignore[union-attr]


def test_only_letters_that_change_or_are_named_are_small() -> None:
    text = "$$ y = a - \\frac{m g}{k} \\cos b $$\n" + "The motion is shown below. " * 20
    text += "So $y = a - \\frac{m g}{k} \\sin b$, approximately."
    assert [str(each.verdict.outcome) for each in audit(text).claims if each.verdict][-1] != "approximates"


def test_a_definition_of_another_letter_has_no_roots() -> None:
    text = "$$ r = \\frac{R z}{h} $$\n\nThe centre is at\n\n$$ z_C = \\frac{3}{4} h $$"
    assert [str(each.verdict.outcome) for each in audit(text).claims if each.verdict] == ["defines", "defines"]


def test_a_right_system_holds() -> None:
    text = ATWOOD + r"$$ \ddot x = \frac{(m_1 - m_2) g}{m_1 + m_2} $$ $$ S = \frac{2 m_1 m_2 g}{m_1 + m_2} $$"
    verdicts = [each.verdict for each in audit(text).claims]
    assert [each.outcome for each in verdicts[-2:] if each] == [Outcome.HOLDS, Outcome.HOLDS]


ENERGY = (
    "$$ I = \\frac{1}{2} M l^2 $$\n\nIts energy is\n\n"
    "$$ T = \\frac12 I \\dot\\theta^2 = \\frac16 M l^2 \\dot\\theta^2 $$"
)


def test_a_definition_is_blamed_if_two_later_rows_show_its_slip() -> None:
    text = ENERGY + "\n\nand the angular momentum is\n\n$$ S = I \\dot\\theta = \\frac13 M l^2 \\dot\\theta $$"
    (claim,) = wrong(text)
    assert claim.row.line == 1 and claim.verdict is not None and claim.verdict.suggestion == "3 instead of 2"


def test_a_definition_is_named_if_one_later_row_may_have_the_slip_instead() -> None:
    text = ENERGY
    (claim,) = wrong(text)
    assert claim.row.line == 5 and claim.verdict is not None and claim.verdict.or_lines == (1,)


def test_a_law_is_blamed_if_a_later_row_shows_its_slip() -> None:
    text = ATWOOD.replace("m_1 g - S", "m_1 g + S") + r"$$ \ddot x = \frac{(m_1 - m_2) g}{m_1 + m_2} $$"
    assert [each.row.line for each in wrong(text)] == [3]


VALUE_BELOW_FORMULA = (
    "The point has the speed $v = l \\dot\\theta$. The energies are\n"
    "$$ T = \\frac12 m v^2 \\qquad U = m g l \\theta^2 $$\n"
    "$$\n\\begin{aligned}\nE &= T + U \\\\\nE &= \\frac12 m l^2 \\dot\\theta^2 + m g l \\theta^2\n"
    "\\end{aligned}\n$$\nSo the power is\n"
    "$$ \\dot E = m l^2 \\dot\\theta \\ddot\\theta + 2 m g l \\theta \\dot\\theta $$"
)


@pytest.mark.parametrize(
    ("right", "slip", "line"), [("E &= T + U", "E &= T", 5), ("+ m g l \\theta^2\n", "+ m g l \\theta^3\n", 6)]
)
def test_a_formula_and_the_value_below_it_agree(right: str, slip: str, line: int) -> None:
    assert wrong(VALUE_BELOW_FORMULA) == []
    (claim,) = wrong(VALUE_BELOW_FORMULA.replace(right, slip))
    assert claim.row.line == line


PLATE = (
    "A disc has the moments of inertia\n$$ I_{xx} = \\frac14 M R^2 $$\nand\n$$ I_{zz} = \\frac12 M R^2. $$\n"
    "Its angular velocity is\n$$ \\bm{\\omega} = \\begin{pmatrix} \\omega \\\\ 0 \\\\ 2 \\omega \\end{pmatrix}, $$\n"
    "so its angular momentum is\n$$ \\bm{L} = \\mathbf{I} \\bm{\\omega} = "
    "\\frac14 M R^2 \\omega \\begin{pmatrix} 1 \\\\ 0 \\\\ 4 \\end{pmatrix} $$\n"
)


def test_a_bold_letter_before_a_vector_is_a_tensor_with_the_entries_of_the_text() -> None:
    assert [str(each.verdict.outcome) for each in audit(PLATE).claims if each.verdict][-1] == "holds"
    for right, slip, line in (("4 \\end", "3 \\end", 8), ("R^2 $$", "R $$", 2)):
        (claim,) = wrong(PLATE.replace(right, slip))
        assert claim.row.line == line


def test_a_formula_of_a_sentence_and_the_display_after_it_agree() -> None:
    text = (
        "The frequency is\n$$ \\omega_0 = \\sqrt{k/m} $$\n"
        "So $y = b \\cos(\\omega_0 t)$, or\n$$ y = b \\cos(\\sqrt{k/m}\\, t) $$"
    )
    assert wrong(text) == []
    (claim,) = wrong(text.replace("y = b \\cos(\\sq", "y = b \\sin(\\sq"))
    assert claim.row.line == 4


def test_a_condition_of_a_sentence_holds_in_the_display_after_it() -> None:
    text = (
        "Newton's law is\n$$ m (\\ddot r - r \\dot\\theta^2) = S - m g \\cos\\theta $$\n"
        "With $r = l$ and $\\ddot r = 0$ this gives\n$$ S = m (g \\cos\\theta - l \\dot\\theta^2) $$"
    )
    assert wrong(text) == []
    (claim,) = wrong(text.replace("\\theta - l", "\\theta + l"))
    assert claim.row.line == 4


def test_a_value_in_another_part_is_doubted_if_one_change_gives_the_earlier_value() -> None:
    text = LAGRANGIAN + "(a) The period is\n$$ \\tau = 2\\pi \\sqrt{m/k} $$\n(b) So\n$$ \\tau = 2\\pi \\sqrt{m/k} $$"
    first, second = text.rsplit("2\\pi", 1)
    outcomes = [str(each.verdict.outcome) for each in audit(first + "3\\pi" + second).claims if each.verdict]
    assert outcomes[-1] == "undecided"
    outcomes = [str(each.verdict.outcome) for each in audit(first + "\\frac{b}{g}" + second).claims if each.verdict]
    assert outcomes[-1] == "defines"


def test_a_row_with_other_dimensions_than_the_rest_is_blamed() -> None:
    text = (
        "A pendulum has the length $l$ and the mass $m$.\n\n$$ T = \\frac12 m l^3 \\dot\\theta^2 $$\n\n"
        "$$ U = - m g l \\cos\\theta $$\n\n$$ E = T + U $$\n\n$$ p = m v $$\n\n$$ v = l \\dot\\theta $$\n\n"
        "$$ F = m g \\sin\\theta $$\n\n$$ \\tau = F l $$"
    )
    (claim,) = wrong(text)
    assert claim.row.line == 3 and claim.verdict is not None and "dimensions" in claim.verdict.because
    assert (
        wrong(text.replace("l^3", "l^2") + "\n\n$$ l = e^{s t} $$\n\n$$ J = m (l^2 + (60\\,\\mathrm{cm})^2) $$") == []
    )


@pytest.mark.parametrize(
    "text",
    [
        "For the disc $I = \\frac12 M R^2$ and for the ring $I = M R^2$.",
        "At first $x = 0$ and $\\dot x = v$. Later $x = v t$.",
        "If $b = l$, then\n$$ \\dot\\theta = 2 b = 2 l $$\nA blow at $b = 0$ gives $\\dot\\theta = 0$.",
        "At $\\theta = \\phi = 0$ the momenta are\n$$ 3 \\dot\\theta + 2 \\dot\\phi = J $$\n"
        "$$ 2 \\dot\\theta + 5 \\dot\\phi = 0 $$\n"
        "If the rod is held, then $\\dot\\phi = 2 J$ and $\\dot\\theta = 3 J$.",
        ATWOOD + "If the masses are equal, $m_1 = m_2$, then\n$$ \\ddot x = 0 $$",
        LAGRANGIAN + "With friction $F$ the equation of motion is\n$$ m \\ddot x = -k x - F $$",
    ],
)
def test_other_cases_are_not_accused(text: str) -> None:
    assert wrong(text) == []


def test_an_equation_of_motion_is_linearised_about_its_equilibrium() -> None:
    text = (
        "The equation of motion is\n$$ m \\ddot r + k r - \\frac{b}{r^2} = 0. $$\nThe bead is at rest at $r_0$, where\n"
        "$$ k r_0 - \\frac{b}{r_0^2} = 0. $$\nLet $r = r_0 + \\eta$. To first order in $\\eta$\n"
        "$$ m \\ddot\\eta + \\frac{3 b}{r_0^3} \\eta = 0 $$"
    )
    assert [str(each.verdict.outcome) for each in audit(text).claims if each.verdict][-1] == "approximates"
    (claim,) = wrong(text.replace("3 b", "2 b"))
    assert claim.row.line == 6


def test_an_equilibrium_is_not_the_motion() -> None:
    text = (
        "The equation of motion is\n$$ \\ddot r - s^2 r + g = 0. $$\n(b) At equilibrium\n$$ g - s^2 r = 0. $$\n"
        "(c) A bead that is released at $r = b$ moves as\n$$ r = \\frac{g}{s^2} + (b - \\frac{g}{s^2}) \\cosh(s t) $$"
    )
    assert wrong(text) == []


CONSTRAINT = "(b) The length of the string is constant, $l = x + y$, so\n$$ \\ddot y = -\\ddot x. $$\n"
ELIMINATED = "Subtraction eliminates the tension: $m_1 \\ddot x - m_2 \\ddot y = (m_1 - m_2) g$."


def test_an_equation_of_a_sentence_is_judged_like_a_display() -> None:
    text = ATWOOD[: ATWOOD.index("and the string")] + CONSTRAINT + ELIMINATED
    outcomes = [str(each.verdict.outcome) for each in audit(text).claims if each.verdict]
    assert outcomes[-2:] == ["holds", "holds"]
    for right, slip, line in (("(m_1 - m_2) g$", "(m_1 - 2 m_2) g$", 7), ("m_1 g - S", "m_1 g + S", 3)):
        (claim,) = wrong(text.replace(right, slip))
        assert claim.row.line == line


def test_an_energy_that_lost_a_term_is_blamed() -> None:
    text = LAGRANGIAN.replace("\\frac{1}{2} k x^2 $$", "\\frac{1}{2} k x^2 + m g x $$").replace(
        "x^2. $$", "x^2 - m g x. $$"
    )
    assert wrong(text) == []
    (claim,) = wrong(text.replace("k x^2 + m g x $$", "k x^2 $$"))
    assert claim.row.line == 3


def test_a_lagrangian_without_energies_is_compared_with_them() -> None:
    text = LAGRANGIAN.replace("T - U = ", "")
    assert wrong(text) == []
    (claim,) = wrong(text.replace("- \\frac{1}{2} k x^2. $$", "- \\frac{1}{3} k x^2. $$"))
    assert claim.row.line == 5


def test_a_speed_is_compared_with_the_equation_of_motion() -> None:
    text = "$$ a \\ddot\\phi = - \\mu g $$\n$$ \\dot\\phi = - \\frac{\\mu g t}{a} $$"
    assert wrong(text) == []
    (claim,) = wrong(text.replace("\\mu g t", "3 \\mu g t"))
    assert claim.row.line == 2


def test_damages_are_of_all_kinds() -> None:
    from random import Random

    side = r"- \frac{1}{2} m l^2 \dot\theta_1 \cos\theta + \int_{0}^{a} x\,dx - 3 m g l"
    kinds = {each.kind for seed in range(9) for each in damages_of(side, Random(seed))}
    assert kinds >= {"digit", "sign", "exponent", "factor", "function", "limit", "letter", "term"}


def test_most_damages_of_a_small_document_are_blamed() -> None:
    found = list(trials({"rod": RIGHT}, 12, seed=3, each=12))
    assert sum(each.result == "silent" for each in found) <= 3
    assert sum(each.result in ("blamed", "named") for each in found) >= 5


@pytest.mark.parametrize(
    "text",
    [
        "The energy is\n$$ U = -m g l \\cos\\phi - 2 m g (l + h) = - 2 m g l - 2 m g h $$",
        "The kinetic energy is\n$$ T = \\frac12 m \\dot x^2 - \\frac12 M \\dot y^2 $$",
        "The momentum is conserved,\n$$ m \\dot x + M \\dot y = m v $$\nand the speeds satisfy\n"
        "$$ \\dot y - \\dot x = e v. $$\nSo\n$$ \\dot x = \\frac{(m + e M) v}{m + M} $$",
    ],
    ids=["a lost term", "a negative energy", "a wrong sign of a solution"],
)
def test_a_slip_that_the_sides_show_is_blamed(text: str) -> None:
    assert len(wrong(text)) == 1


MOTOR = (
    "An arm of mass $M$ and length $b$ is turned through the angle $\\phi$ by a motor with the torque $K$.\n"
    "The acceleration of free fall is $g$.\n"
    "$$ \\frac13 M b^2 \\ddot\\phi = K - \\frac12 M g b \\cos\\phi $$"
)


def test_words_give_the_dimensions_of_letters() -> None:
    assert wrong(MOTOR) == []
    (claim,) = wrong(MOTOR.replace("b^2", "b^3"))
    assert claim.verdict is not None and "dimensions" in claim.verdict.because


def test_words_near_a_letter_may_mean_something_else() -> None:
    text = (
        "A rod of mass per unit length $\\mu$ and angular momentum $l$, with the centre of{~}mass $C$, turns.\n\n"
        "The coefficient of static friction of the floor is $f$. The square of the speed $v$ grows. "
        "Let $r$ and $s$ be the distances of two beads on the wire $W$."
    )
    document = read_document(source_of(text, Format.TEX))
    named = named_quantities(document, lambda row: 0)[0]
    lengths = {letter for letter, powers in named.items() if powers == (0, 1, 0)}
    assert (set(named), lengths) == ({"l", "f", "s"}, {"s"})


def test_a_row_with_the_dimensions_of_an_earlier_slip_is_not_blamed() -> None:
    text = (
        "A bar of mass $M$, length $b$ and width $d$ has\n\n$$ A = b d $$\n\n$$ J = \\frac{M}{3 b} (b^3 - d^3) "
        "= \\frac{M}{3 b} (b^3 - d^2) = \\frac13 M b^2 - \\frac{M d^2}{3 b} $$\n\n$$ F = M g $$"
    )
    assert [each.number for each in wrong(text)] == [2]


CENTRAL = (
    "Lagrange's equations need the energies\n$$ T = \\frac12 m \\dot r^2 $$\nand\n$$ U = - \\frac{k}{r}. $$\n"
    "$$\n\\begin{aligned}\nL &= T - U \\\\\nL &= \\frac12 m \\dot r^2 + \\frac{k}{r}\n\\end{aligned}\n$$\n"
    "The equation of motion is\n$$ m \\ddot r + \\frac{k}{r^2} = 0 $$"
)


def test_a_value_that_later_rows_support_is_right() -> None:
    assert wrong(CENTRAL) == []
    (claim,) = wrong(CENTRAL.replace("= - \\frac{k}", "= \\frac{k}"))
    assert claim.row.line == 4


REFERRED = (
    "(a) The acceleration is\n\\begin{align} \\ddot x = - \\mu g \\label{a} \\end{align}\n\n"
    "(b) By \\eqref{a}, the velocity is\n$$ \\dot x = v - \\mu g t $$"
)


def test_a_row_of_another_part_is_used_if_the_sentence_refers_to_it() -> None:
    slip = REFERRED.replace("v - \\mu g t", "v - 2 \\mu g t")
    assert [each.row.line for each in wrong(slip)] == [5]
    assert wrong(REFERRED) == wrong(slip.replace("By \\eqref{a}, the", "The")) == []


SLIDING = (
    "The position of the block is\n\\begin{align} x = v t - \\frac12 \\mu g t^2 \\label{x} \\end{align}\n"
    "At the time\n$$ t_1 = \\frac{v}{3 \\mu g} $$\nit is, by \\eqref{x},\n$$ x_1 = \\frac{5 v^2}{18 \\mu g} $$"
)


def test_a_value_at_an_instant_is_computed() -> None:
    assert [str(each.verdict.outcome) for each in audit(SLIDING).claims if each.verdict][-1] == "holds"
    (claim,) = wrong(SLIDING.replace("\\frac{5 v", "-\\frac{5 v"))
    assert claim.row.line == 6


LOOP = (
    "The normal force is\n$$ N = \\frac{m v^2}{R} + 3 m g \\cos\\theta - 2 m g $$\n\n"
    "(b) At the top, it is\n$$ N = \\frac{m v^2}{R} - 5 m g $$"
)


def test_a_value_at_a_place_is_computed() -> None:
    assert [str(each.verdict.outcome) for each in audit(LOOP).claims if each.verdict] == ["defines", "holds"]
    (claim,) = wrong(LOOP.replace("- 5 m g", "+ 5 m g"))
    assert claim.row.line == 5
    assert wrong(LOOP.replace("- 5 m g", "- \\frac72 m g")) == []  # at another place


FALL = (
    "(a) On the sphere $r = R$. Newton's law is\n$$ r \\ddot\\theta + 2 \\dot r \\dot\\theta = g \\sin\\theta. $$\n"
    "So the energy is constant,\n$$ E = \\frac12 m R^2 \\dot\\theta^2 + m g R \\cos\\theta $$"
)


@pytest.mark.parametrize("slip", ["m g R \\sin", "2 m g R \\cos"])
def test_the_time_derivative_of_a_conserved_quantity_vanishes(slip: str) -> None:
    assert wrong(FALL) == []
    (claim,) = wrong(FALL.replace("m g R \\cos", slip))
    assert claim.row.line == 4


def test_a_letter_that_appears_once_may_be_a_similar_letter() -> None:
    text = (
        "The angular velocity is\n$$ \\Omega = \\sqrt{k/m} $$\nand the frequency is\n"
        "$$ \\omega_0 = 2 \\sqrt{k/m}. $$\n"
        "Their ratio is\n$$\n\\begin{aligned}\nn &= \\frac{\\omega_0}{\\Omega} \\\\\nn &= 2\n\\end{aligned}\n$$"
    )
    assert wrong(text) == []
    (claim,) = wrong(text.replace("{\\omega_0}", "{\\Omega_0}"))
    assert claim.row.line == 8


CURVATURE = (
    "The potential is\n$$ V = m g R \\cos\\theta - \\frac12 m R^2 w^2 \\sin^2\\theta $$\n"
    "Its second derivative at the top is\n"
    "$$ \\left.\\frac{d^2 V}{d\\theta^2}\\right|_{\\theta=0} = - m g R - m R^2 w^2 $$"
)


def test_a_lost_term_at_a_place_is_found() -> None:
    assert wrong(CURVATURE) == []
    (claim,) = wrong(CURVATURE.replace("- m g R -", "-"))
    assert claim.row.line == 4


def test_a_font_size_is_not_an_approximation() -> None:
    text = "{\\small Figure 1.} The sum is\n$$ a = b + c $$"
    (block,) = read_document(source_of(text, Format.TEX)).blocks
    assert Cue.APPROXIMATE not in block.cues


def test_a_letter_may_have_two_meanings() -> None:
    text = (
        "A string of length $L$ holds a bob of mass $m$ at the distance $r$.\n"
        "The angle is $\\phi$, and the force $S$ is small.\n"
        "$$ A = L r $$\n$$ T = \\frac12 m r^2 \\dot\\phi^2 $$\n$$ L = T $$"
    )
    assert wrong(text) == []


SLIP = (
    "The velocity of slip is\n$$ u = v - \\mu g t - \\frac{\\mu m g t}{M}. $$\n\n"
    "The block stops sliding when it vanishes, at\n$$ t_1 = \\frac{M v}{\\mu (M + m) g} $$"
)


def test_a_quantity_vanishes_at_an_instant() -> None:
    assert [str(each.verdict.outcome) for each in audit(SLIP).claims if each.verdict][-1] == "holds"
    (claim,) = wrong(SLIP.replace("M + m", "M - m"))
    assert claim.row.line == 5


def test_a_value_is_compared_with_the_row_to_which_its_sentence_refers() -> None:
    text = (
        "The speed is\n\\begin{align} w^2 = \\frac{g}{b} (1 - \\cos\\theta) \\end{align}\nand the force is\n"
        "\\begin{align} F = m g \\cos\\theta - m b w^2. \\label{f} \\end{align}\n\n"
        "(b) With this result, \\eqref{f} becomes\n$$ F = m g (2 \\cos\\theta - 1) $$"
    )
    assert wrong(text) == []
    (claim,) = wrong(text.replace("- 1)", "+ 1)"))
    assert claim.row.line == 7


def test_a_letter_whose_usual_dimension_is_wrong_does_not_hide_a_slip() -> None:
    """The letter `l` is an angular momentum here, and not a length."""
    text = (
        "A particle of mass $m$ is at the distance $r$ from the centre. Its speed is "
        "$v = r \\dot\\phi$. The energies are\n"
        "$$ T = \\frac12 m r^2 \\dot\\phi^2 $$\n$$ U = \\frac12 k r^2 $$\n$$ L = T - U $$\n"
        "The angular momentum is\n$$ l = \\frac{\\partial L}{\\partial \\dot\\phi} $$\n"
        "The radius $r_0$ of a circle is given by\n$$ l^2 = m k r_0^4. $$\n"
        "The frequency of small oscillations about it is given by\n"
        "$$ m \\omega^2 = \\frac{3 l^2}{m r_0^4} + k $$\n"
    )
    assert wrong(text) == []
    (claim,) = wrong(text.replace("+ k $", "+ 1 $"))
    assert claim.row.line == 10


@pytest.mark.parametrize(
    "row", ["\\dot{\\vec{x}} = \\vec{A}(t)\\vec{x}", "s = \\exp(\\int_0^T \\operatorname{tr} \\vec{A} \\, dt)"]
)
def test_a_row_without_a_meaning_ends_no_audit(row: str) -> None:
    before = "The motion obeys\n$$ m \\ddot x + k x = 0 $$\nand for vectors\n$$ \\dot{\\vec x} = A \\vec x $$\n"
    claims = audit(f"{before}$$ {row} $$").claims
    assert claims[-1].verdict is not None


def test_a_letter_that_one_other_row_contains_is_wrong_there() -> None:
    text = (
        "The masses are $m_1$ and $m_2$. Newton's second law is\n$$ m_1 \\ddot x = m_1 g - S_1 $$\n"
        "$$ m_2 \\ddot y = m_2 g - S_2 $$\nThe first string pulls with the force $S_1 = m_1 (g - \\ddot x)$."
    )
    assert wrong(text) == []
    (claim,) = wrong(text.replace("m_1 g", "m_1 S"))
    assert claim.row.line == 2 and claim.verdict is not None and claim.verdict.suggestion == "g instead of S"


def test_two_motions_in_a_sentence_satisfy_equations_of_motion_together() -> None:
    text = (
        "The equations are\n$$ \\dot u = -b w $$\n$$ \\dot w = b u $$\nwith a constant $b$. "
        "The solution is $u = a \\cos b t$ and $w = a \\sin b t$."
    )
    assert [str(each.verdict.outcome) for each in audit(text).claims if each.verdict][-1] in ("holds", "defines")
    slip = audit(text.replace("\\sin", "\\cos")).claims[-1].verdict
    assert slip is not None and slip.outcome is Outcome.DIFFERS and slip.suggestion.startswith("\\sin instead of \\cos")


ENERGIES = "The energies are\n$$ T = \\frac12 m \\dot x^2 \\qquad U = \\frac12 k x^2 $$\n"


@pytest.mark.parametrize("start", ["The mass starts at $x = 0$. ", "The mass starts at $x = a$. "])
def test_a_place_in_another_sentence_is_not_put_into_a_row_with_a_rate(start: str) -> None:
    right = "so the Lagrangian is\n$$ L = T - U = \\frac12 m \\dot x^2 - \\frac12 k x^2 $$"
    assert [str(each.verdict.outcome) for each in audit(start + ENERGIES + right).claims if each.verdict][-1] == "holds"
    for slip in (right.replace("\\frac12 k x^2", "\\frac12 k a^2"), right.replace(" - \\frac12 k x^2", "")):
        assert str(audit(start + ENERGIES + slip).claims[-1].verdict.outcome) != "holds"  # type: ignore[union-attr]


def test_a_place_in_the_same_sentence_is_put_in_and_the_rate_does_not_vanish() -> None:
    text = ENERGIES + "At $x = a$ the energy is\n$$ E = T + U = \\frac12 m \\dot x^2 + \\frac12 k a^2 $$"
    assert str(audit(text).claims[-1].verdict.outcome) == "holds"  # type: ignore[union-attr]
    slip = text.replace("+ \\frac12 k", "+ \\frac13 k")
    assert str(audit(slip).claims[-1].verdict.outcome) != "holds"  # type: ignore[union-attr]


COUPLED = (
    "(a) For small angles the equations of motion are\n"
    "$$ m l \\ddot\\theta + m g \\theta + k l (\\theta - \\phi) = 0 $$\n"
    "$$ m l \\ddot\\phi + m g \\phi + k l (\\phi - \\theta) = 0 $$\n\n"
    "(b) The frequencies are\n$$ \\omega_1 = \\sqrt{\\frac{g}{l}} $$\n"
    "$$ \\omega_2 = \\sqrt{\\frac{g}{l} + \\frac{2 k}{m}} $$\n\n"
    "With a weak spring, $\\omega_2^2 = g/l + 2 k/m$ is close to $\\omega_1^2$."
)
SLIDES = (
    "The equation of motion is\n$$ \\ddot x = - \\mu g $$\n\n(b) So the velocity is\n$$ \\dot x = v_0 - \\mu g t $$\n"
    "With the constraint $\\dot x + R \\dot\\phi = 0$ the wheel has the rate\n$$ \\dot\\phi = -\\frac{\\dot x}{R} $$"
)
WEDGE = (
    "The block leaves at the place $s = h/\\sin\\alpha$. Lagrange's equations are\n"
    "$$ (M + m) \\ddot x + m \\ddot s \\cos\\alpha = 0 $$\n"
    "$$ m (\\ddot x \\cos\\alpha + \\ddot s - g \\sin\\alpha) = 0 $$\nand therefore\n"
    "$$ \\ddot x = -\\frac{m g \\sin\\alpha \\cos\\alpha}{M + m \\sin^2\\alpha} $$"
)
PRECESSES = (
    "Euler's equations are\n$$ \\dot\\omega_x = -\\Omega \\omega_y \\qquad \\dot\\omega_y = \\Omega \\omega_x $$\n"
    "so $\\omega_x = a \\cos \\Omega t$ and $\\omega_y = a \\sin \\Omega t$."
)
ENERGIES_OF_PENDULUM = (
    "Lagrange's method needs\n$$ T = \\frac12 m l^2 \\dot\\theta^2 $$\n$$ U = -m g l \\cos\\theta $$\n"
    "$$ L = \\frac12 m l^2 \\dot\\theta^2 + m g l \\cos\\theta $$\n"
    "The momentum is\n$$ p_\\theta = m l^2 \\dot\\theta $$\n"
    "and the Hamiltonian\n$$ H = \\frac{p_\\theta^2}{2 m l^2} - m g l \\cos\\theta $$"
)


ROOTS = (
    "For small angles\n$$ 2 \\ddot\\theta + \\ddot\\phi + 2 b^2 \\theta = 0 $$\n"
    "$$ \\ddot\\theta + \\ddot\\phi + b^2 \\phi = 0 $$ The frequencies are "
    "$$\\begin{aligned}\n\\omega_1 &= \\sqrt{2 - \\sqrt 2}\\, b \\\\\n"
    "\\omega_2 &= \\sqrt{2 + \\sqrt 2}\\, b\n\\end{aligned}$$"
)
STRINGS = (
    "The masses hang on two strings.\n$$ m_1 \\ddot x = m_1 g - S_1 $$\n$$ m_2 \\ddot y = m_2 g - S_2 $$\n"
    "For one string, the tensions are equal."
)
LEAVES = (
    "The particle slides down with\n$$ \\dot\\theta^2 = \\frac{2 g (1 - \\cos\\theta)}{R} $$\n"
    "and the normal force on the sphere is\n$$ N = m g (3 \\cos\\theta - 2) $$\nThe particle leaves the sphere where\n"
    "$$ \\cos\\theta = \\frac{2}{3} $$"
)
SPEEDS = (
    "The velocity of the ball is\n$$ \\dot x = v_0 - \\mu g t $$\nand at the time\n"
    "$$ t_1 = \\frac{2 v_0}{7 \\mu g} $$\nit is\n$$ v_1 = \\frac{5}{7} v_0 $$"
)
ENERGY_FIRST = (
    "Lagrange's equation follows from\n$$ T = \\frac12 m l^2 \\dot\\theta^2 $$\n$$ U = - m g l \\cos\\theta $$\n"
    "$$ L = T - U = \\frac12 m l^2 \\dot\\theta^2 + m g l \\cos\\theta $$\n"
    "It is\n$$ m l^2 \\ddot\\theta + m g l \\sin\\theta = 0 $$"
)


@pytest.mark.parametrize(
    ("right", "written", "slip", "line"),
    [
        (COUPLED, "{l} + \\frac", "{l} - \\frac", 7),
        (COUPLED, "g/l + 2 k/m", "g/l - 2 k/m", 9),
        (SLIDES, "v_0 - \\mu g t", "v_0 - g t", 5),
        (SLIDES, "-\\frac{\\dot x}{R}", "\\frac{\\dot x}{R}", 7),
        (WEDGE, "\\sin\\alpha \\cos\\alpha}{M", "\\sin\\alpha \\sin\\alpha}{M", 5),
        (PRECESSES, "a \\sin", "a \\cos", 3),
        (ENERGIES_OF_PENDULUM, "T = \\frac12", "T = \\frac32", 2),
        (ROOTS, "{2 - \\sqrt", "{2 + \\sqrt", 4),
        (ROOTS, "{2 + \\sqrt", "{2 - \\sqrt", 5),
        (STRINGS, "m_2 \\ddot y", "m_1 \\ddot y", 3),
        (STRINGS, "m_1 \\ddot x", "m_2 \\ddot x", 2),
        (LEAVES, "2}{3", "5}{3", 6),
        (LEAVES, "2}{3", "3}{3", 6),
        (SPEEDS, "5}{7", "3}{7", 6),
        (ENERGY_FIRST, "- m g l \\cos", "m g l \\cos", 3),
        ("The density is $\\lambda = M/l$, and $b = a/(2 c)$.", "M/l", "l/l", 1),
        ("The density is $\\lambda = M/l$, and $b = a/(2 c)$.", "a/(2", "c/(2", 1),
        ("Since $w = 1/u$, $w + w^3 u^2 = w^3 (u^2 + u^2)$.", "w^3 (", "w^2 (", 1),
    ],
)
def test_one_change_makes_a_row_follow(right: str, written: str, slip: str, line: int) -> None:
    assert right.count(written) == 1 and wrong(right) == []
    assert [each.row.line for each in wrong(right.replace(written, slip))] == [line]


@pytest.mark.parametrize(
    "right",
    [
        "At the bottom, the force is $N = \\frac{m v^2}{R} + m g$.\n\n(b) At the top, $N = \\frac{m v^2}{R} - m g$.",
        "(a) The block slides up with $$ a = g (\\sin\\alpha + \\mu \\cos\\alpha) $$\n\n"
        "(b) It slides down with $$ a = g (\\sin\\alpha - \\mu \\cos\\alpha) $$",
        "For the amplitudes we find\n$$\n\\begin{aligned}\n 4 (n^2 - w^2) A - w^2 B &= 0 \\\\\n"
        " -w^2 A + (n^2 - w^2) B &= 0\n\\end{aligned}\n$$",
        "The curve through both points has\n$$ \\cosh\\left(\\frac{a}{c} + d\\right) = "
        "\\cosh\\left(-\\frac{a}{c} + d\\right) $$",
        "Lagrange's equations with the friction $F$ follow from\n"
        "$$ L = \\frac12 M \\dot s^2 + \\frac14 M R^2 \\dot\\phi^2 + M g s \\sin\\alpha $$\n"
        "$$ M \\ddot s = M g \\sin\\alpha - F $$\n$$ \\frac12 M R^2 \\ddot\\phi = R F $$\n\n(b) Rolling means\n"
        "$$ \\ddot s = R \\ddot\\phi $$\nand so $F = \\frac12 M \\ddot s$.",
        "The equations with tensions are\n$$ \\frac{d}{dt} \\frac{\\partial L}{\\partial \\dot x_i} "
        "- \\frac{\\partial L}{\\partial x_i} = S_i $$\n$$ L = \\frac12 m \\dot x_1^2 - m g x_1 $$\n"
        "$$ m \\ddot x_1 + m g = S_1 $$",
        "The energy equation is\n$$ \\frac12 m \\dot r^2 - \\frac12 m r^2 \\Omega^2 = E. $$\n"
        "With the initial conditions $r = a$ and $\\dot r = 0$ when $t = 0$ we get\n"
        "$$ E = -\\frac12 m a^2 \\Omega^2 $$",
        "Two terms:\n\\begin{multline*}\n \\ddot q + u \\dot q = a (b + c) \\\\\n + f = a (b + c) + f\\end{multline*}",
    ],
)
def test_values_and_equations_of_other_cases_are_right(right: str) -> None:
    assert wrong(right) == []


# Rows of right solutions that the audit took for slips.
RIGHT_SOLUTIONS = {
    "another equation with the same letter": r"""
The equation of motion is
$$ \ddot r = \omega^2 r - g \sin\omega t $$
The homogeneous equation $\ddot r = \omega^2 r$ has the solutions $\cosh\omega t$ and $\sinh\omega t$.
""",
    "a growth rate with the name of an angle": r"""
The small displacement $\eta$ obeys
$$ (I + M a^2) \ddot\eta - M g a \eta = 0 $$
where $M$ is the mass of the body and $a$ its radius. The kinetic energy is
$$ T = \frac12 (I + M a^2) \dot\eta^2 $$
The displacement grows like $e^{\gamma t}$ with
$$ \gamma = \sqrt{\frac{M g a}{I + M a^2}} $$
""",
    "an equation holds only if the accelerations vanish": r"""
The equations of motion are
\begin{align} m \ddot x &= q B \dot y \\ m \ddot y &= q E - q B \dot x \end{align}
If $\ddot x = \ddot y = 0$, then
$$ q B \dot y = 0, \qquad q E - q B \dot x = 0 $$

so
$$ \dot x = \frac E B, \qquad \dot y = 0 $$

At the start, $p_x = 0$, so
$$ \dot x = \frac{q B}{m} y $$
Then
$$ \ddot y + \left(\frac{q B}{m}\right)^2 y = \frac{q E}{m} $$
This is an oscillator about the point $y = m E/(q B^2)$. With $y(0) = 0$ and $\dot y(0) = 0$,
$$ y = \frac{m E}{q B^2} \left(1 - \cos\frac{q B t}{m}\right) $$
""",
    "a force has another value at one place": r"""
The equation of motion and the forces are
$$ l \ddot\theta = \frac32 g \sin\theta $$
$$ l \dot\theta^2 = 3 g (1 - \cos\theta) $$
$$ R_x = \frac34 M g (3 \cos\theta - 2) \sin\theta $$
$$ R_y = \frac14 M g (1 - 3 \cos\theta)^2 $$
The horizontal force changes its sign at
$$ \cos\theta = \frac23 $$
where $R_y = \frac14 M g$. The vertical force vanishes at
$$ \cos\theta = \frac13 $$
When the rod hits the ground, at $\theta = \frac{\pi}{2}$,
$$ R_x = -\frac32 M g, \qquad R_y = \frac14 M g $$
In all positions
$$ R_x \sin\theta + R_y \cos\theta = M g \cos\theta - \frac12 M l \dot\theta^2 $$
""",
    "a rate at an instant": r"""
The flight is
$$ y = v_1 t \sin\alpha - \frac12 g t^2 $$
It ends at
$$ t_2 = \frac{4 v_1 \sin\alpha}{g} $$
The velocity is then
$$ \dot y = v_1 \sin\alpha - g t_2 = -3 v_1 \sin\alpha $$
""",
    "a function is small because a length is great": r"""
The motion is steady if
$$ R = \frac{2 g \cot\theta}{3 \Omega^2} - \frac{a}{6} \cos\theta $$
In a large circle, the speed $v = R \Omega$ is related to the inclination by
$$ \cot\theta \approx \frac{3 v^2}{2 g R} $$
""",
    "a constant momentum has two names": r"""
The momentum is
$$ p_\phi = m r^2 \dot\phi = l $$
With $p_\phi = l$ we have
$$ H_r = \frac{p_r^2}{2 m} + U(r), \qquad U = \frac{l^2}{2 m r^2} - \frac{k}{r} $$
The potential is minimal where
$$ U'(r) = -\frac{l^2}{m r^3} + \frac{k}{r^2} = 0, \qquad\text{that is, at}\quad r_c = \frac{l^2}{m k} $$
The energy is
$$ E = U(r_c) = -\frac{k}{2 r_c} = -\frac{m k^2}{2 l^2} $$
""",
}


@pytest.mark.parametrize("case", RIGHT_SOLUTIONS)
def test_a_right_solution_has_no_slips(case: str) -> None:
    assert wrong(RIGHT_SOLUTIONS[case]) == []


SERIES = r"""
The place is
$$ x_1 = \frac{l + \sqrt{l^2 + 8 x_0^2}}{4} $$
CASE,
$$ x_1 \approx \frac{l}{2} + \frac{x_0^2}{l} $$
"""


@pytest.mark.parametrize(
    ("case", "lines"), [(r"For $x_0 \ll l$", [5]), (r"For $l \gg x_0$", [5]), (r"For $l \ll x_0$", []), ("So", [])]
)
def test_an_approximation_is_compared_if_the_sentence_says_which_letter_is_small(case: str, lines: list[int]) -> None:
    text = SERIES.replace("CASE", case)
    assert wrong(text) == []
    assert [each.row.line for each in wrong(text.replace(r"{2} +", "{2} -"))] == lines


def test_a_small_letter_is_not_equal_to_the_greater_one() -> None:
    found = audit("The length is\n$$ b = a + 2 c $$\nFor $a \\ll c$,\n$$ b = 3 c $$").claims[-1].verdict
    assert found is not None and found.outcome is not Outcome.HOLDS


def test_a_homogeneous_body_is_not_a_homogeneous_equation() -> None:
    text = "The homogeneous rod has\n$$ L = \\frac16 M l^2 \\dot\\theta^2 + \\frac12 M g l \\cos\\theta $$\n"
    text += "The equation of motion of the homogeneous rod is\n"
    text += "$$ \\frac13 M l^2 \\ddot\\theta = - \\frac12 M g l \\sin\\theta $$"
    assert wrong(text) == []
    assert [each.row.line for each in wrong(text.replace("- \\frac12", "\\frac12"))] == [4]
