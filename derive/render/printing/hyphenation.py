"""Hyphenation of documents that are not in English, with the dictionaries of Pyphen.

TeX hyphenates words by the patterns of their language, and the engine that derive installs has only the English
patterns. The document therefore contains a list of its words with their hyphenation points.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from derive.render.notation.latex import escaped

SHORTEST = 5  # letters; shorter words are not hyphenated
_ACCENTED = {escaped(letter): letter for letter in "äöüßáàâéèêëíìîïóòôúùûçñæœÄÖÜÁÀÂÉÈÊËÍÌÎÏÓÒÔÚÙÛÇÑÆŒ"}
_ACCENT = re.compile("|".join(map(re.escape, sorted(_ACCENTED, key=len, reverse=True))))
_WORD = re.compile(rf"(?<![\\\w])[^\W\d_]{{{SHORTEST},}}")


def divided_words(tex: str, language: str) -> str:
    """Return the words of a document in LaTeX that can be divided, with a hyphen at each place where a line may end.

    The language is a code such as `de`. The result is empty if Pyphen has no dictionary for it.
    """
    from pyphen import Pyphen, language_fallback

    known = language_fallback(language)
    if known is None:
        return ""
    dictionary = Pyphen(lang=known)
    divided = (dictionary.inserted(word) for word in sorted(set(_words(tex))))
    return " ".join(word for word in divided if "-" in word)


def _words(tex: str) -> Iterator[str]:
    plain = _ACCENT.sub(lambda found: _ACCENTED[found[0]], tex.partition(r"\begin{document}")[2])
    yield from (word.lower() for word in _WORD.findall(plain))
