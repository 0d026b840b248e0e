"""Sentences of the project drawn at random, for a reader to judge: `python -P -m tests.sentences NUMBER SEED`.

A sentence comes from the documentation, the phrases, or a docstring, comment or message of the code. A reader who has
not seen the project marks each sentence as clear at first reading, to be read twice, or wrong.
"""

from __future__ import annotations

import random
import re
import sys
from collections.abc import Iterator
from inspect import cleandoc
from pathlib import Path

from tests.courses import ROOT
from tests.style import PROSE, files, texts_of_code

FEWEST_WORDS = 5
# parts of a docstring: the meaning of an argument, with its indented lines, and what follows a label
ARGUMENT = r"^(\w[\w., ]*?)[ ]{2,}(\S.*(?:\n[ ]+.*)*)$"
LABEL = r"^(?=(?:Second routes?|Checks?|Outcomes|Errors|Source|Witness): )"


def paragraphs(path: Path) -> Iterator[str]:
    if path.suffix == ".py":
        for _, text in texts_of_code(path):
            apart = re.sub(ARGUMENT, r"\n\1: \2\n", cleandoc(text), flags=re.MULTILINE)
            for part in re.split(r"\n\s*\n", re.sub(LABEL, "\n", apart, flags=re.MULTILINE)):
                yield re.sub(r"^#:?\s*", "", part)
    else:
        without_code = re.sub(r"^```.*?^```$", "", path.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
        yield from re.split(r"\n\s*\n|\n(?=[-|*#] ?)|(?<=\w): (?=['\"])", without_code)


def sentences(path: Path) -> Iterator[str]:
    for paragraph in paragraphs(path):
        for sentence in re.split(r"(?<=[.!?])\s+(?=[A-Z`])", " ".join(paragraph.split())):
            words = re.findall(r"[A-Za-z]{2,}", sentence)
            if len(words) >= FEWEST_WORDS and sentence[0] not in "|$<{\\" and "://" not in sentence:
                yield sentence


def drawn(number: int, seed: int) -> list[str]:
    """Return this number of different sentences, each with its file."""
    found = [
        f"{path.relative_to(ROOT)}: {each}"
        for path in files("derive", "tools", "problems", *PROSE)
        for each in sentences(path)
    ]
    return random.Random(seed).sample(sorted(set(found)), number)


if __name__ == "__main__":
    print(*drawn(int(sys.argv[1]), int(sys.argv[2])), sep="\n")
