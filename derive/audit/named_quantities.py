"""The dimensions of letters that the words of a document name: "a rod of mass $m$", "let $r$ be the distance of"."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction

from derive.algebra.kinds import dimension_of_kind, plural
from derive.documents.layout import Block, Document, Row
from derive.documents.parser import Unreadable, parsed
from derive.documents.syntax import Letter, Node

Powers = tuple[Fraction, Fraction, Fraction]  # of mass, length and time
OTHER_NAMES = {  # words that name a kind of quantity
    "radius": "length", "height": "length", "depth": "length", "width": "length", "distance": "length",
    "thickness": "length", "displacement": "length", "diameter": "length", "radii": "length", "heights": "length",
    "semi-axis": "length", "semi-axes": "length", "extension": "length", "azimuth": "angle", "tension": "force",
    "friction": "force", "weight": "force", "work": "energy", "angular velocity": "angular speed",
    "angular velocities": "angular speed", "angular frequency": "angular speed", "angular rate": "angular speed",
    "angular frequencies": "angular speed", "acceleration of free fall": "acceleration", "period": "time",
    "spring of constant": "spring constant", "springs of constant": "spring constant",
    "coefficient of static friction": "number", "coefficient of sliding friction": "number",
    "coefficient of kinetic friction": "number", "coefficient of rolling friction": "number",
}  # fmt: skip
KINDS = (
    "mass", "length", "area", "volume", "speed", "acceleration", "velocity", "angular speed",
    "angular acceleration", "force", "energy", "power", "torque", "momentum", "angular momentum", "moment of inertia",
    "spring constant", "gravitational constant", "coefficient of friction", "angle",
)  # fmt: skip
NAMES: Mapping[str, str] = (
    {kind: kind for kind in KINDS} | {plural(kind): kind for kind in KINDS} | OTHER_NAMES
    | {each + "s": kind for each, kind in OTHER_NAMES.items() if each[-1] not in "sk" and " of " not in each}
)  # fmt: skip
_NAME = "|".join(sorted(map(re.escape, NAMES), key=len, reverse=True))
_ADJECTIVE = (
    "normal|total|kinetic|potential|outer|inner|natural|initial|final|constant|horizontal|vertical|common|whole|same"
    "|smallest|largest|greatest|least|static|radial|tangential|signed|perpendicular|moment"
)
_BEFORE = re.compile(rf"(?<![\w-])(?<!centre of )(?<!center of )(?P<name>{_NAME})(?: (?:is|are))?$")
_OF_SOMETHING = re.compile(r"(?<![\w-])(?P<name>coefficient of \w+ friction)[\w ]* is$")
_AFTER = re.compile(
    rf" (?P<verb>(?:be|is|denotes?) )?(?:the|its|their|an?) (?:(?:{_ADJECTIVE}) )?"
    rf"(?P<name>{_NAME})(?![\w-])(?! (?:per|squared|in units))"
)
_OTHER_MEANING = re.compile(
    r"\bper\b|\bunits?\b|\bratios?\b|\bsquares?\b|\bcubes?\b|\btimes\b|\bproducts?\b|\bnumber\b|\binverse\b|\bdivided\b"
    r"|\brates?\b|\bderivatives?\b|\breciprocal\b|\bfraction\b|\bcomponents?\b|\bfunction\b",
    re.IGNORECASE,
)
_LET = re.compile(r"\b(?:let|where|here|with)\b", re.IGNORECASE)
_AND = re.compile(r",?(?: and)?$")
_PLURAL = re.compile(r"(?<!mas)(?<!radiu)(?<!thicknes)s$|^radii$|^springs of")
NEAR = 40  # the number of characters before a name in which a word such as "square" changes its meaning


def named_quantities(document: Document, scope_of: Callable[[Row], int]) -> dict[int, dict[str, Powers]]:
    """Return the dimensions of letters by scope. A letter with two different dimensions in a scope is left out."""
    found: dict[int, dict[str, set[Powers]]] = defaultdict(lambda: defaultdict(set))
    for block, letter, name in _named(document):
        of = dimension_of_kind(NAMES[name])
        found[scope_of(block.rows[0])][letter.named()].add((of.mass, of.length, of.time))
    return {
        scope: {letter: next(iter(powers)) for letter, powers in letters.items() if len(powers) == 1}
        for scope, letters in found.items()
    }


def _named(document: Document) -> Iterator[tuple[Block, Letter, str]]:
    name = ""
    blocks = document.blocks
    for block, after in zip(blocks, [*(each.before for each in blocks[1:]), ""], strict=False):
        letter = _letter(block)
        if letter is None:
            name = ""
            continue
        before = _plain(block.before).rstrip()
        joined = _AND.match(before) and (before.strip() != "," or _PLURAL.search(name))
        if not (name and joined):
            found = _BEFORE.search(before) or _OF_SOMETHING.search(before)
            name, start = "", found.start() if found else len(before)
            if _OTHER_MEANING.search(before[max(0, start - NEAR) : start]):
                continue
            if found:
                name = found["name"] if found["name"] in NAMES else "coefficient of friction"
        described = _AFTER.match(_plain(after))
        if name:
            yield block, letter, name
        elif described and (described["verb"] or _LET.search(block.sentence)):
            yield block, letter, described["name"]


def _letter(block: Block) -> Letter | None:
    """Return the letter with which a formula in a sentence begins, as in `$l$` and `$l > 0$`."""
    statements = block.rows[0].statements if len(block.rows) == 1 else []
    if block.display or len(statements) != 1 or "=" in statements[0].relations:
        return None
    try:
        side: Node = parsed(statements[0].sides[0].tokens)
    except (Unreadable, RecursionError):
        return None
    return side if isinstance(side, Letter) and not side.dots else None


def _plain(text: str) -> str:
    return re.sub(r"(?:[\s~]|\{~\})+", " ", text)
