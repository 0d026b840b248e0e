"""`python -P -m tests.sentences 200 --seed 7` draws sentences at random, for a reader who has not seen the project.

The sentences are those of the documents, the docstrings, the comments, the longer strings of the code and the English
phrases; citations of books are left out. Each one is listed with its file and line, so that the reader can look at the
lines around it.
"""

from __future__ import annotations

import argparse
import ast
import io
import random
import re
import tokenize
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import yaml

from tests.courses import ROOT
from tests.style import PROSE, files

END = re.compile(r"(?<=[.?!:])\s+(?=[A-Z`$<])")
GENERATED = ("docs/errors.md", "docs/yaml.md", "docs/rules.md", "docs/gallery.md", "NOTATION.md")
NOT_READ = (*GENERATED, "templates/phrases/de/", "templates/phrases/fr/")
NO_SENTENCE = re.compile(  # a citation, a heading between rules, a note for a checker of types, a pattern, a style
    r"(?:Source: )?[^*]*, \*[^*]+\*, .*(?:section|chapter|problem|p\.)|---? .* ---?$|type: ignore|noqa"
    r"|.*(?:\(\?[:=!<]|\\[wbsd]\W|[{;] ?[\w-]+:[^/])"
)
SHORTEST = 4  # words


def _comments(source: str) -> Iterator[tuple[int, str]]:
    """Yield the first line and the text of each run of comment lines."""
    tokens = [each for each in tokenize.generate_tokens(io.StringIO(source).readline) if each.type == tokenize.COMMENT]
    first, lines = 0, list[str]()
    for before, token in pairwise([None, *tokens]):
        follows = (
            before is not None
            and token is not None
            and token.start == (before.start[0] + 1, before.start[1])
            and token.line.lstrip().startswith("#")
        )
        if lines and not follows:
            yield first, " ".join(lines)
            lines = []
        if token is not None:
            first = first if lines else token.start[0]
            lines.append(token.string.lstrip("# "))
    if lines:
        yield first, " ".join(lines)


def _strings(source: str) -> Iterator[tuple[int, str]]:
    """Yield each string with its line; "…" is in the place of the values of an f-string."""
    tree = ast.parse(source)
    inside = {id(part) for node in ast.walk(tree) if isinstance(node, ast.JoinedStr) for part in node.values}
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            text = "".join(str(part.value) if isinstance(part, ast.Constant) else "…" for part in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in inside:
            text = node.value
        else:
            continue
        if text.count(" ") >= SHORTEST:
            yield from _paragraphs(text, node.lineno)


def _paragraphs(text: str, line: int = 1) -> Iterator[tuple[int, str]]:
    """Yield the line and the text of each paragraph; lists are split into their items, blocks of code left out."""
    text = re.sub(r"```.*?```", lambda found: "\n" * found[0].count("\n"), text, flags=re.S)
    start = 0
    for gap in [*re.finditer(r"\n\s*(?:\n|(?=[-*|] |\S+(?:, \S+)* {2,}\S))", text), None]:
        piece = text[start : gap.start() if gap else None]
        if piece.strip() and not piece.lstrip().startswith(("|", "#", ">>>", "$")):
            yield line + text[:start].count("\n"), " ".join(piece.split())
        start = gap.end() if gap else start


def _phrases(source: str) -> Iterator[tuple[int, str]]:
    """Yield the line and the text of each value in a file of phrases."""
    waiting = [yaml.compose(source)]
    while waiting:
        node = waiting.pop()
        if isinstance(node, yaml.ScalarNode):
            yield node.start_mark.line + 1, " ".join(node.value.split())
        elif isinstance(node, yaml.SequenceNode):
            waiting += node.value
        elif node is not None:
            waiting += [value for _, value in node.value]


def sentences(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the line of its paragraph, and the text, of each sentence of a file."""
    source = path.read_text(encoding="utf-8")
    of_kind = {
        ".py": lambda: [*_comments(source), *_strings(source)],
        ".yaml": lambda: [*_phrases(source)],
    }
    for line, text in of_kind.get(path.suffix, lambda: [*_paragraphs(source)])():
        for sentence in END.split(text):
            if len(re.findall(r"[A-Za-z]{2,}", sentence)) >= SHORTEST and not NO_SENTENCE.match(sentence):
                yield line, sentence


def main() -> None:
    options = argparse.ArgumentParser(description="Draw sentences of the project at random.")
    options.add_argument("count", type=int)
    options.add_argument("--seed", type=int, required=True)
    asked = options.parse_args()
    written = [path for path in files("derive", *PROSE) if not str(path.relative_to(ROOT)).startswith(NOT_READ)]
    drawn = [(path, line, text) for path in written for line, text in sentences(path)]
    for path, line, text in random.Random(asked.seed).sample(drawn, min(asked.count, len(drawn))):
        print(f"{path.relative_to(ROOT)}:{line}: {text}")


if __name__ == "__main__":
    main()
