"""The words of a document with the places where they may be divided."""

from __future__ import annotations

import pytest

from derive.render.printing.hyphenation import divided_words

BODY = r"% Above the document, even Comment is not a word of it. \begin{document}"


@pytest.mark.parametrize(
    ("language", "text", "told"),
    [
        ("de", r"Das Tr{\"a}gheitsmoment, \textbf{Winkelrate} und Zeit", "träg-heits-mo-ment win-kel-ra-te"),
        ("fr", r"l'{\'e}quation \frac{a}{b} \displaystyle", "équa-tion"),
        ("tlh", "Winkelgeschwindigkeit", ""),
    ],
)
def test_words_are_divided_by_the_dictionary_of_the_language(language: str, text: str, told: str) -> None:
    assert divided_words(BODY + text, language) == told
