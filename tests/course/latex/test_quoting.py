"""A document is quoted in its own letters; nothing of it reaches TeX but what is written anew from known commands."""

from __future__ import annotations

import pytest

from derive.course.latex.quoting import LONGEST_QUOTATION, Unquotable, quoted, quoted_formula


@pytest.mark.parametrize(
    ("printed", "tex"),
    [
        (r"\frac{13}{22} M a^{2}", r"\frac {13}{22} M a^{2}"),
        (r"\sqrt[R(h-z)]{h}", r"\sqrt [R(h-z)]{h}"),
        (r"\left|\begin{array}{cc} a & b \end{array}\right|", r"\left |\begin{array}{cc} a & b \end{array}\right |"),
        (r"939.47 \text { or } 15.13", r"939.47 \text{ or } 15.13"),
        (r"\operatorname{Mg}", r"\operatorname {Mg}"),
    ],
)  # fmt: skip
def test_a_formula_is_written_anew_as_it_stands_even_if_it_is_garbled(printed: str, tex: str) -> None:
    assert quoted_formula(printed) == tex


def test_rows_are_aligned_but_not_those_of_a_matrix() -> None:
    assert quoted_formula(r"a & =b \\ & =c") == r"\begin{aligned}a & =b \\ & =c\end{aligned}"
    assert "aligned" not in quoted_formula(r"\begin{pmatrix} a \\ b \end{pmatrix}")


def test_prose_is_words_and_formulas_in_turn() -> None:
    pieces = quoted(r"Which implies $L$ is a constant vector & 100% so")
    assert [(p.text, p.is_formula) for p in pieces] == [
        ("Which implies ", False),
        ("L", True),
        (" is a constant vector & 100% so", False),
    ]


@pytest.mark.parametrize(
    "printed",
    [
        r"\input{/etc/passwd}", r"\write18{ls}", r"\def\x{y}", r"\catcode`\%=0", "a % b", "a # b", "a @ b",
        r"\begin{verbatim}x\end{verbatim}", r"\begin{array}{@{}c}x\end{array}", r"\begin{array}x\end{array}",
        r"\text{\input{x}}", r"\^^69nput", "é", r"\tag{1}", r"\hbox{x}", r"\csname x\endcsname",
    ],
)  # fmt: skip
def test_no_other_command_or_sign_gets_through(printed: str) -> None:
    with pytest.raises(Unquotable):
        quoted_formula(printed)


@pytest.mark.parametrize(
    "printed",
    [
        "a}", "{a", r"\left(a", r"\frac", r"\sqrt", r"\begin{pmatrix}a", r"a\end{pmatrix}",
        r"{\begin{pmatrix}a}\end{pmatrix}",
    ],
)  # fmt: skip
def test_what_does_not_nest_is_refused(printed: str) -> None:
    with pytest.raises(Unquotable):
        quoted_formula(printed)


def test_a_refusal_says_where() -> None:
    with pytest.raises(Unquotable) as refused:
        quoted(r"so $a = \foo$")
    assert refused.value.at == 8
    assert str(refused.value) == r"`\foo` cannot be quoted"


def test_a_formula_ends_and_a_quotation_is_short() -> None:
    for text in ("a $b", "a" * (LONGEST_QUOTATION + 1)):
        with pytest.raises(Unquotable):
            quoted(text)
